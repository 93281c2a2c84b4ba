//! Straps behind butt joints: strips of the whole part to either side of a joint, cut out once
//! more. They follow its outline and bend as it does.

use super::cutout::{Cutout, Division, whole_sheet};
use super::piece::Making;
use crate::divide::{DivideFault, Dividing, Fitting, divide};
use crate::make::part::Part;
use crate::pattern::Room;
use sheetwright_geometry::math::{Point2, Vec2, unit2};
use std::collections::{BTreeMap, BTreeSet};

/// The part whose joints have straps.
pub(super) struct Behind<'a> {
    pub(super) whole: &'a Part,
    /// It as it is divided, and its pieces.
    pub(super) dividing: &'a Dividing,
    pub(super) cutouts: &'a [Cutout<'a>],
    pub(super) fitting: &'a Fitting<'a>,
    /// How far a strap reaches to either side of its joint, mm.
    pub(super) reach_mm: f64,
}

/// A strap, as a piece of the whole that is cut out once more.
pub(super) struct Strap {
    dividing: Dividing,
    piece: usize,
    /// Where the pieces meet.
    joint: Vec<Point2>,
}

impl Behind<'_> {
    /// The straps behind a joint: one, or several where one is longer than the sheet.
    pub(super) fn straps(&self, division: &Division) -> Result<Vec<Strap>, DivideFault> {
        let (Some(first), Some(last)) = (division.steps.first(), division.steps.last()) else {
            return Ok(Vec::new());
        };
        let ends = [first[0], last[1]];
        let [from, to] = ends.map(|v| self.dividing.flat(v));
        let Some(along) = unit2(to - from) else { return Ok(Vec::new()) };
        let across = along.perp();
        let mut strip = whole_sheet(self.whole);
        let at = from.to_vec().dot(across);
        let holds = |strip: &Dividing, pieces: Vec<usize>| {
            let middle = from.lerp(to, 0.5);
            let is_it = |piece: &usize| {
                strip.border(*piece).is_ok_and(|border| {
                    let points = |line: &Vec<usize>| line.iter().map(|&v| strip.flat(v)).collect();
                    let loops: Vec<Vec<Point2>> = border.loops.iter().map(points).collect();
                    Room::new(loops.iter().map(|line| &line[..])).holds(middle)
                })
            };
            pieces.into_iter().find(is_it).ok_or(DivideFault::TooThin)
        };
        let pieces = strip.cut(0, across, &[at - self.reach_mm, at + self.reach_mm]);
        let mut piece = holds(&strip, pieces)?;
        // Where the joint ends at another one, the strap does, too.
        let inner: Vec<f64> = self.ends_inside(ends, along);
        if !inner.is_empty() {
            let pieces = strip.cut(piece, along, &inner);
            piece = holds(&strip, pieces)?;
        }
        let fitting = Fitting { reach_mm: 0.0, ..self.fitting.clone() };
        let pieces = divide(&mut strip, piece, &fitting)?;
        let joint = vec![from, to];
        let strap = |piece| Strap { dividing: strip.clone(), piece, joint: joint.clone() };
        Ok(pieces.into_iter().map(strap).collect())
    }

    /// The ends of a joint that do not lie on the border of the whole, as distances along it, in
    /// increasing order, mm.
    fn ends_inside(&self, ends: [usize; 2], along: Vec2) -> Vec<f64> {
        let steps: BTreeSet<[usize; 2]> =
            self.cutouts.iter().flat_map(|cutout| cutout.border().steps()).collect();
        let is_outer = |step: &[usize; 2]| !steps.contains(&[step[1], step[0]]);
        let outer: BTreeSet<usize> =
            steps.iter().filter(|step| is_outer(step)).flatten().copied().collect();
        let inside = ends.into_iter().filter(|end| !outer.contains(end));
        inside.map(|end| self.dividing.flat(end).to_vec().dot(along)).collect()
    }
}

impl Strap {
    /// It as a part of this name.
    pub(super) fn made(self, whole: &Part, name: &str) -> Result<Part, DivideFault> {
        let cutout = Cutout::new(&self.dividing, self.piece)?;
        let making = Making {
            whole,
            sides: &BTreeMap::new(),
            divisions: &[],
            marks: &[],
            lap_mm: None,
            strap: Some(self.joint),
        };
        making.made(name, &cutout)
    }
}
