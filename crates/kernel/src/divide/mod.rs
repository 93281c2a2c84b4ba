//! Parts that are larger than a sheet, divided into pieces that fit one.
//!
//! 1. A part is cut along straight lines on its pattern (`dividing`), so that each piece is a part
//!    with a surface, a pattern and edges, and both sides of a cut are congruent.
//! 2. Lines stand across the long side of the smallest box around it, where they cost least
//!    (`plan`). A part that is too wide as well is first cut along that side, into as many rows as
//!    leave the fewest pieces. Pieces that still do not fit, as arms of a bent one, are divided
//!    again, in boxes of their own.
//! 3. What joins the pieces is a matter of trims: both sides of a cut are mates, so an allowance
//!    makes a lap or a scarf of them, and knobs a puzzle (`make`).

mod dividing;
mod fault;
mod plan;

pub use fault::DivideFault;

pub(crate) use dividing::{Border, Dividing, Vertex};
pub(crate) use plan::Hindrance;

use crate::flatten::{fits_in, long_side};
use plan::Span;
use sheetwright_geometry::math::{Point2, Vec2};
use sheetwright_geometry::predicate::Box2;
use std::collections::BTreeSet;

/// The most pieces of a part.
const MOST_PIECES: usize = 200;
/// The most rows of a part that is too wide.
const MOST_ROWS: usize = 8;
/// Pieces are divided again so often at the most.
const MOST_ROUNDS: usize = 4;

/// The sheets that pieces must fit, and what their joints need.
#[derive(Clone, Debug)]
pub(crate) struct Fitting<'a> {
    /// The room of each sheet, width and height, mm.
    pub(crate) rooms: &'a [[f64; 2]],
    /// The direction that lies along the x of a room, of length 1; `None`: pieces may be turned.
    pub(crate) grain: Option<Vec2>,
    /// How far the material of a joint reaches beyond its line, mm.
    pub(crate) reach_mm: f64,
    /// What joints keep away from.
    pub(crate) hindrances: &'a [Hindrance],
}

impl Fitting<'_> {
    /// Whether points fit a sheet, by their places along the grain, or else the long side, and
    /// across it.
    fn fits(&self, points: &[Point2]) -> bool {
        let Some(around) = Box2::of_points(points.iter().copied()) else { return true };
        let size = around.max - around.min;
        let fits_straight = |[width, height]: [f64; 2]| {
            let rounding = 1e-9 * (width + height);
            size.x <= width + rounding && size.y <= height + rounding
        };
        self.rooms.iter().any(|&room| {
            let [width, height] = room;
            fits_straight(room)
                || self.grain.is_none() && (fits_straight([height, width]) || fits_in(points, room))
        })
    }

    /// Whether a pattern fits a sheet as it is.
    pub(crate) fn fits_whole(&self, points: &[Point2]) -> bool {
        match self.grain {
            Some(grain) => self.fits(&points.iter().map(|&p| placed(p, grain)).collect::<Vec<_>>()),
            None => self.fits(points),
        }
    }

    /// The shortest side of the sheets at the most.
    fn narrowest_mm(&self) -> f64 {
        self.rooms.iter().map(|[width, height]| width.min(*height)).fold(0.0, f64::max)
    }
}

/// Divides a piece of a sheet into pieces that fit; returns their numbers.
///
/// # Errors
/// See [`DivideFault`].
pub(crate) fn divide(
    dividing: &mut Dividing,
    piece: usize,
    fitting: &Fitting<'_>,
) -> Result<Vec<usize>, DivideFault> {
    let mut pieces = vec![piece];
    for _ in 0..MOST_ROUNDS {
        let mut next = Vec::with_capacity(pieces.len());
        let mut is_done = true;
        for &piece in &pieces {
            let steps = steps(dividing, piece, fitting.reach_mm)?;
            let along = way(&steps, fitting);
            if fitting.fits(&turned(&steps, along).concat()) {
                next.push(piece);
                continue;
            }
            is_done = false;
            next.extend(cut(dividing, piece, along, fitting)?);
            if next.len() > MOST_PIECES {
                return Err(DivideFault::NoPlace);
            }
        }
        pieces = next;
        if is_done {
            return Ok(pieces);
        }
    }
    Err(DivideFault::NoPlace)
}

/// The direction that a piece is divided along.
fn way(steps: &[[Point2; 2]], fitting: &Fitting<'_>) -> Vec2 {
    fitting.grain.unwrap_or_else(|| long_side(&steps.concat()))
}

/// The steps of the border of a piece, and those along its joints once more, where the material
/// of the joint reaches to.
fn steps(
    dividing: &Dividing,
    piece: usize,
    reach_mm: f64,
) -> Result<Vec<[Point2; 2]>, DivideFault> {
    let border = dividing.border(piece)?;
    let beside = dividing.beside(piece);
    let mut steps = Vec::new();
    for step in border.steps() {
        let [a, b] = step.map(|v| dividing.flat(v));
        steps.push([a, b]);
        if beside.contains(&[step[1], step[0]]) {
            let out = (b - a).perp() * (-reach_mm / a.distance(b));
            steps.push([a + out, b + out]);
        }
    }
    Ok(steps)
}

/// Points by their places along a direction and across it.
fn turned(steps: &[[Point2; 2]], along: Vec2) -> Vec<[Point2; 2]> {
    steps.iter().map(|step| step.map(|p| placed(p, along))).collect()
}

/// A point by its place along a direction and across it.
fn placed(p: Point2, along: Vec2) -> Point2 {
    Point2::new(p.to_vec().dot(along), p.to_vec().dot(along.perp()))
}

/// Cuts a piece that does not fit; returns the pieces that it falls into.
fn cut(
    dividing: &mut Dividing,
    piece: usize,
    along: Vec2,
    fitting: &Fitting<'_>,
) -> Result<Vec<usize>, DivideFault> {
    let in_rows = |rows: usize| -> Result<Option<(Dividing, Vec<usize>)>, DivideFault> {
        let mut tried = dividing.clone();
        let steps = turned(&steps(&tried, piece, fitting.reach_mm)?, along);
        let ys = || steps.iter().flatten().map(|p| p.y);
        let [low, high] = [ys().fold(f64::INFINITY, f64::min), ys().fold(-f64::INFINITY, f64::max)];
        let between: Vec<f64> =
            (1..rows).map(|n| low + (high - low) * n as f64 / rows as f64).collect();
        let rows = tried.cut(piece, along.perp(), &between);
        let mut pieces = Vec::new();
        for row in rows {
            let Some(places) = across(&tried, row, along, fitting)? else { return Ok(None) };
            pieces.extend(tried.cut(row, along, &places));
        }
        Ok(Some((tried, pieces)))
    };
    let mut best: Option<(Dividing, Vec<usize>)> = None;
    let high = turned(&steps(dividing, piece, fitting.reach_mm)?, along);
    let around = Box2::of_points(high.concat());
    let high_mm = around.map_or(0.0, |around| around.max.y - around.min.y);
    for rows in 1..=MOST_ROWS {
        if let Some(found) = in_rows(rows)?
            && best.as_ref().is_none_or(|(_, least)| found.1.len() < least.len())
        {
            best = Some(found);
        }
        // More rows would only be narrower.
        if high_mm <= rows as f64 * (fitting.narrowest_mm() - 2.0 * fitting.reach_mm) {
            break;
        }
    }
    let (cut, pieces) = best.ok_or(DivideFault::NoPlace)?;
    *dividing = cut;
    Ok(pieces)
}

/// The places of the lines across a piece.
fn across(
    dividing: &Dividing,
    piece: usize,
    along: Vec2,
    fitting: &Fitting<'_>,
) -> Result<Option<Vec<f64>>, DivideFault> {
    let steps = turned(&steps(dividing, piece, fitting.reach_mm)?, along);
    let place = |hindrance: &Hindrance| {
        let xs = || hindrance.points.iter().map(|p| p.to_vec().dot(along));
        let [from, to] = [xs().fold(f64::INFINITY, f64::min), xs().fold(-f64::INFINITY, f64::max)];
        ([from, to], hindrance.weight)
    };
    let span = Span {
        steps: &steps,
        hindrances: fitting.hindrances.iter().map(place).collect(),
        reach_mm: fitting.reach_mm,
        fits: &|points| fitting.fits(points),
    };
    Ok(span.places(MOST_PIECES).map(|(places, _)| places))
}

impl Dividing {
    /// The sides of all pieces but one.
    fn beside(&self, piece: usize) -> BTreeSet<[usize; 2]> {
        self.sides_beside(piece).collect()
    }
}
