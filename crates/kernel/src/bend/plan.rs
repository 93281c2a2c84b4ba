//! A plan for the press brake: where each bend line lies against the back gauge, and what a brake
//! can't do.
//!
//! At a brake the bend line lies under the punch, and two fingers behind it touch the edge that the
//! sheet is pushed against. So each hit has two distances, square to its line, from a finger's
//! place on the line to the edge: they differ where the edge is no ruling. An edge serves as long
//! as it is straight, lies wholly ahead of the line, where the sheet is still flat, turns from it
//! by no more than 45°, and reaches along enough of it for both fingers; of several, the one that
//! turns least. Without one, the line is marked out from the base line of the box around the piece,
//! and the distances are the heights of both places above it.

use super::BendLine;
use crate::edge::Edge;
use sheetwright_geometry::math::{Point2, unit2};
use sheetwright_geometry::predicate::orientation;
use std::cmp::Ordering;

/// The die opening of most bends, in thicknesses of the sheet.
pub const DIE_THICKNESSES: f64 = 8.0;
/// Lines lie no nearer to one another, and sheet reaches no less beyond them, than this share of
/// the die opening: else the sheet falls into the die.
pub const LEAST_SHARE: f64 = 0.5;
/// An edge is straight that leaves its chord by less than this, mm: less than gauges repeat.
const STRAIGHT_MM: f64 = 0.02;
/// Fingers have an edge to touch along this share of the line at least.
const LEAST_TOUCHED: f64 = 0.2;
/// Where both fingers stand, as shares of the stretch of the line that the edge reaches along.
const FINGERS: [f64; 2] = [0.25, 0.75];

/// What a brake can do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Brake {
    /// The opening of its die, mm, if it is known.
    pub die_mm: Option<f64>,
    /// The longest line that it bends, mm, if it is known.
    pub length_mm: Option<f64>,
}

/// What the distances of a hit are measured from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// An edge of the part, by its number: distances are square to the bend line.
    Edge(usize),
    /// The lower side of the box around the piece: distances are square to it.
    BaseLine,
}

/// What a brake can't do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BrakeFault {
    /// The line comes nearer to the one before than half the die opening.
    Close {
        /// How near, mm.
        apart_mm: f64,
        /// Half the die opening, mm.
        least_mm: f64,
    },
    /// The line is longer than the brake.
    Long {
        /// How long, mm.
        length_mm: f64,
        /// How long the brake is, mm.
        most_mm: f64,
    },
    /// The sheet reaches less far beyond the first or last line than half the die opening.
    Short {
        /// How far, mm.
        beyond_mm: f64,
        /// Half the die opening, mm.
        least_mm: f64,
    },
}

/// One stroke of the brake.
#[derive(Clone, Debug, PartialEq)]
pub struct Hit {
    /// The line that is bent.
    pub line: BendLine,
    /// The sum of the angles of its strip so far, with their signs, radians.
    pub running: f64,
    /// What the distances are measured from.
    pub reference: Reference,
    /// How far both fingers stand from the left end of the line, along it, mm.
    pub fingers_mm: [f64; 2],
    /// The distance of the reference at both fingers, mm.
    pub gauges_mm: [f64; 2],
    /// What the brake can't do.
    pub faults: Vec<BrakeFault>,
}

/// The hits of a part with these bend lines, in their order. `edges` are those of the part, whose
/// vertices lie at `flat` on the pattern.
pub fn hits(lines: &[BendLine], edges: &[Edge], flat: &[Point2], brake: &Brake) -> Vec<Hit> {
    let straight: Vec<(usize, [Point2; 2])> =
        edges.iter().enumerate().filter_map(|(n, edge)| Some((n, straight(edge, flat)?))).collect();
    let mut running = 0.0;
    let hit = |n: usize| {
        let line = &lines[n];
        let before = n.checked_sub(1).map(|n| &lines[n]).filter(|other| other.strip == line.strip);
        let is_last = lines.get(n + 1).is_none_or(|other| other.strip != line.strip);
        running = line.angle + if before.is_some() { running } else { 0.0 };
        let is_only = before.is_none() && is_last;
        let (reference, fingers_mm, gauges_mm) = gauge(line, &straight, is_only);
        let faults = faults(line, before, brake);
        Hit { line: line.clone(), running, reference, fingers_mm, gauges_mm, faults }
    };
    (0..lines.len()).map(hit).collect()
}

/// The ends of an edge on the pattern, if it is straight there.
fn straight(edge: &Edge, flat: &[Point2]) -> Option<[Point2; 2]> {
    let points: Vec<Point2> = edge.run.iter().map(|&v| flat[v]).collect();
    let (&from, &to) = (points.first()?, points.last()?);
    let along = unit2(to - from)?;
    let is_on = |p: &Point2| along.perp_dot(*p - from).abs() <= STRAIGHT_MM;
    points.iter().all(is_on).then_some([from, to])
}

/// The reference of a hit, the places of its fingers and the distances there. Of a line that is the
/// only one of its strip the sheet is flat on both sides.
fn gauge(
    line: &BendLine,
    straight: &[(usize, [Point2; 2])],
    is_only: bool,
) -> (Reference, [f64; 2], [f64; 2]) {
    let length = line.length_mm();
    let along = unit2(line.ends[1] - line.ends[0]).unwrap_or_default();
    let mut best: Option<(f64, Reference, [f64; 2], [f64; 2])> = None;
    for &(edge, ends) in straight {
        let off = ends.map(|p| line.side_mm(p));
        let is_ahead = off.iter().all(|&off| off > 0.0);
        if !(is_ahead || (is_only && off.iter().all(|&off| off < 0.0))) {
            continue;
        }
        let at = ends.map(|p| along.dot(p - line.ends[0]));
        let [low, high] = [at[0].min(at[1]).max(0.0), at[0].max(at[1]).min(length)];
        let aslant = ((off[1] - off[0]) / (at[1] - at[0])).abs();
        let serves = aslant <= 1.0 && high - low >= LEAST_TOUCHED * length;
        if serves && best.is_none_or(|(least, ..)| aslant < least) {
            let fingers = FINGERS.map(|share| low + (high - low) * share);
            let slope = (off[1] - off[0]) / (at[1] - at[0]);
            let gauges = fingers.map(|finger| (off[0] + slope * (finger - at[0])).abs());
            best = Some((aslant, Reference::Edge(edge), fingers, gauges));
        }
    }
    match best {
        Some((_, reference, fingers, gauges)) => (reference, fingers, gauges),
        None => {
            let fingers = FINGERS.map(|share| length * share);
            let heights = FINGERS.map(|share| line.ends[0].lerp(line.ends[1], share).y);
            (Reference::BaseLine, fingers, heights)
        }
    }
}

/// What a brake can't do at a line, after the one `before` it in its strip.
fn faults(line: &BendLine, before: Option<&BendLine>, brake: &Brake) -> Vec<BrakeFault> {
    let mut faults = Vec::new();
    if let Some(die_mm) = brake.die_mm {
        let least_mm = LEAST_SHARE * die_mm;
        if let Some(apart_mm) = before.map(|other| apart_mm(line.ends, other.ends))
            && apart_mm < least_mm
        {
            faults.push(BrakeFault::Close { apart_mm, least_mm });
        }
        let beyond_mm = line.beyond_mm.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        if beyond_mm < least_mm {
            faults.push(BrakeFault::Short { beyond_mm, least_mm });
        }
    }
    if let Some(most_mm) = brake.length_mm
        && line.length_mm() > most_mm
    {
        faults.push(BrakeFault::Long { length_mm: line.length_mm(), most_mm });
    }
    faults
}

/// The least distance of two segments, mm.
fn apart_mm(a: [Point2; 2], b: [Point2; 2]) -> f64 {
    let sides = |[p, q]: [Point2; 2], other: [Point2; 2]| {
        let [first, second] = other.map(|point| orientation(p, q, point));
        first != second && first != Ordering::Equal && second != Ordering::Equal
    };
    if sides(a, b) && sides(b, a) {
        return 0.0;
    }
    let ends =
        a.map(|p| p.distance_to_segment(b)).into_iter().chain(b.map(|p| p.distance_to_segment(a)));
    ends.fold(f64::INFINITY, f64::min)
}
