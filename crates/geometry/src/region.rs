//! Regions of the plane: what is left of some polygons when others are added and taken away.
//!
//! Corners are rounded to whole numbers of a unit far below any cut, and the crate `i_overlay`
//! works in 64-bit integers from there, so the outcome is exact for the rounded corners and has
//! the same bits on every platform. Corners that the polygons came with get their own coordinates
//! back.

use crate::math::Point2;
use crate::predicate::signed_area_doubled;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::{ContourDirection, IntOverlayOptions, Overlay, ShapeType};
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;
use std::collections::BTreeMap;

/// Units to a millimetre: 2³⁰, so that rounding moves a corner by less than 10⁻⁹ mm.
const UNITS: f64 = 1_073_741_824.0;
/// The largest coordinate, mm: more would not fit the integers.
pub const MOST_MM: f64 = 4.0e9;
/// Loops that enclose less are what rounding leaves between polygons that meet, mm².
const LEAST_MM2: f64 = 1e-6;
/// A line turns back along itself where it comes this near to where it was, mm: some units.
const SPIKE_MM: f64 = 1e-7;

/// A connected piece of a region.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Its outline, counter-clockwise, mm.
    pub outline: Vec<Point2>,
    /// Its holes, clockwise, mm.
    pub holes: Vec<Vec<Point2>>,
}

impl Region {
    /// The area of the outline without that of the holes, mm².
    pub fn area_mm2(&self) -> f64 {
        let loops = std::iter::once(&self.outline).chain(&self.holes);
        loops.map(|line| 0.5 * signed_area_doubled(line)).sum()
    }
}

/// What is left of a region that lies to the left of the `lines` when some polygons are added and
/// then others are taken away: its connected pieces, the largest first. The direction of the added
/// and removed polygons means nothing. Points on a straight side are left out. No corner may lie
/// beyond [`MOST_MM`].
pub fn combined(
    lines: &[Vec<Point2>],
    added: &[Vec<Point2>],
    removed: &[Vec<Point2>],
) -> Vec<Region> {
    operated(lines, added, removed, OverlayRule::Difference)
}

/// The area that a region, to the left of the `lines`, and some polygons have in common, mm².
pub fn common_mm2(lines: &[Vec<Point2>], polygons: &[Vec<Point2>]) -> f64 {
    operated(lines, &[], polygons, OverlayRule::Intersect).iter().map(Region::area_mm2).sum()
}

fn operated(
    lines: &[Vec<Point2>],
    added: &[Vec<Point2>],
    others: &[Vec<Point2>],
    rule: OverlayRule,
) -> Vec<Region> {
    let mut known: BTreeMap<[i64; 2], Point2> = BTreeMap::new();
    let options = IntOverlayOptions {
        preserve_input_collinear: false,
        output_direction: ContourDirection::CounterClockwise,
        preserve_output_collinear: false,
        min_output_area: 0,
        ogc: true,
    };
    let mut overlay = Overlay::<i64>::new_custom(0, options, Default::default());
    let mut add = |line: &[Point2], kind: ShapeType, turn: bool| {
        let is_near = |p: &Point2| p.x.abs().max(p.y.abs()) <= MOST_MM;
        debug_assert!(line.iter().all(is_near), "the integers of the region are left");
        let mut units: Vec<IntPoint<i64>> = Vec::with_capacity(line.len());
        for &p in line {
            let at = [p.x, p.y].map(|mm| (mm * UNITS).round() as i64);
            known.entry(at).or_insert(p);
            units.push(IntPoint::new(at[0], at[1]));
        }
        if turn && signed_area_doubled(line) < 0.0 {
            units.reverse();
        }
        overlay.add_contour(&units, kind);
    };
    lines.iter().for_each(|line| add(line, ShapeType::Subject, false));
    added.iter().for_each(|line| add(line, ShapeType::Subject, true));
    others.iter().for_each(|line| add(line, ShapeType::Clip, true));
    let point = |p: &IntPoint<i64>| {
        let mm = || Point2::new(p.x as f64 / UNITS, p.y as f64 / UNITS);
        known.get(&[p.x, p.y]).copied().unwrap_or_else(mm)
    };
    let shapes = overlay.overlay(rule, FillRule::NonZero);
    let mut regions: Vec<Region> = Vec::with_capacity(shapes.len());
    for shape in &shapes {
        let mut loops = shape.iter().map(|line| without_spikes(line.iter().map(point).collect()));
        let Some(outline) = loops.next() else { continue };
        let is_large = |line: &Vec<Point2>| 0.5 * signed_area_doubled(line).abs() > LEAST_MM2;
        if is_large(&outline) {
            regions.push(Region { outline, holes: loops.filter(is_large).collect() });
        }
    }
    let area = |region: &Region| signed_area_doubled(&region.outline);
    regions.sort_by(|a, b| area(b).total_cmp(&area(a)));
    regions
}

/// A closed line without corners at which it turns back along itself, as where rounding has left a
/// crack between two polygons, or a blade of one.
fn without_spikes(mut line: Vec<Point2>) -> Vec<Point2> {
    let (mut n, mut kept) = (0, 0);
    // Once no corner has gone for a whole round, none will.
    while kept < line.len() && line.len() > 2 {
        let m = line.len();
        n %= m;
        let [before, at, after] = [n + m - 1, n, n + 1].map(|k| line[k % m]);
        let off =
            before.distance_to_segment([at, after]).min(after.distance_to_segment([before, at]));
        if (before - at).dot(after - at) >= 0.0 && off < SPIKE_MM {
            line.remove(n);
            (n, kept) = (n + m - 2, 0);
        } else {
            (n, kept) = (n + 1, kept + 1);
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, side: f64) -> Vec<Point2> {
        let at = |a: f64, b: f64| Point2::new(x + a * side, y + b * side);
        vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]
    }

    #[test]
    fn polygons_are_added_and_taken_away() {
        let base = square(0.1, 0.2, 3.0);
        let turned: Vec<Point2> = square(2.1, 1.2, 3.0).into_iter().rev().collect();
        let [one] = &combined(std::slice::from_ref(&base), &[turned], &[])[..] else {
            panic!("one piece")
        };
        assert!((one.area_mm2() - 16.0).abs() < 1e-8 && one.outline.len() == 8);
        assert!(one.outline.contains(&base[0]), "corners keep their bits");
        let with_hole = combined(std::slice::from_ref(&base), &[], &[square(1.0, 1.0, 0.5)]);
        assert_eq!((with_hole.len(), with_hole[0].holes.len()), (1, 1));
        let parted = combined(&[base], &[], &[square(-1.0, 1.0, 1.0), square(0.0, 1.0, 4.0)]);
        assert_eq!(parted.len(), 1, "only a strip below is left: {parted:?}");
    }

    #[test]
    fn a_line_that_turns_back_along_itself_loses_its_spike() {
        let mut line = square(0.0, 0.0, 3.0);
        line.splice(
            1..1,
            [Point2::new(1.0, 0.0), Point2::new(1.0, 2.0), Point2::new(1.0 + 1e-9, 0.0)],
        );
        assert_eq!(without_spikes(line).len(), 6);
        assert_eq!(without_spikes(square(0.0, 0.0, 3.0)), square(0.0, 0.0, 3.0));
    }

    #[test]
    fn holes_stay_empty_and_what_touches_has_nothing_in_common() {
        let hole: Vec<Point2> = square(1.0, 1.0, 1.0).into_iter().rev().collect();
        let lines = [square(0.0, 0.0, 3.0), hole];
        assert!((common_mm2(&lines, &[square(0.0, 0.0, 3.0)]) - 8.0).abs() < 1e-8);
        assert_eq!(common_mm2(&lines, &[square(1.0, 1.0, 1.0), square(3.0, 0.0, 1.0)]), 0.0);
        assert_eq!(common_mm2(&lines, &[square(5e8, 0.0, 1.0)]), 0.0);
    }
}
