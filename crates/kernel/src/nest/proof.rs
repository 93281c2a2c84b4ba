//! The proof of a layout, on the parts as they are cut.
//!
//! Of every two parts on one sheet, no side comes nearer to a side of the other than the gap, and
//! neither has a corner in the other; every part lies inside its sheet by the margin, along the
//! grain where it has to; each is laid as often as it is to be cut.

use super::{Nest, NestForm, NestOptions, NestPart, NestSheet, Placement};
use sheetwright_geometry::math::{Point2, Vec2};
use sheetwright_geometry::predicate::{Box2, inside, segments_touch};
use std::f64::consts::FRAC_PI_2;

/// Rounding may cost this much of a distance, mm.
const ROUNDING_MM: f64 = 2e-3;

/// What is wrong with a layout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NestFault {
    /// Two placements, by their numbers, overlap or come nearer than the gap.
    TooNear(usize, usize),
    /// A placement lies nearer to the edge of its sheet than the margin, or beyond it.
    OffSheet(usize),
    /// A part is not laid as often as it is to be cut.
    Miscounted(usize),
    /// A placement is turned as it may not be.
    Turned(usize),
}

/// The first fault of a layout; `None` if it keeps all that was asked.
pub fn first_fault(
    nest: &Nest,
    parts: &[NestPart],
    sheets: &[NestSheet],
    options: NestOptions,
) -> Option<NestFault> {
    let laid = |it: &Placement| -> Vec<Vec<Point2>> {
        let line = |line: &Vec<Point2>| line.iter().map(|&p| it.lay(p)).collect();
        parts[it.part].loops.iter().map(line).collect()
    };
    let all: Vec<Vec<Vec<Point2>>> = nest.placements.iter().map(laid).collect();
    let bounds: Vec<(Vec2, Vec2)> = all.iter().map(|loops| bounds(&loops[0])).collect();
    // The placements so far on each sheet.
    let mut on: Vec<Vec<usize>> = vec![Vec::new(); nest.sheets.len()];
    for (n, it) in nest.placements.iter().enumerate() {
        for &k in &on[it.sheet] {
            let is_near = (bounds[k].0 - options.gap_mm).cmple(bounds[n].1).all()
                && (bounds[n].0 - options.gap_mm).cmple(bounds[k].1).all();
            if is_near && too_near(&all[k], &all[n], options.gap_mm) {
                return Some(NestFault::TooNear(k, n));
            }
        }
        on[it.sheet].push(n);
        let used = &nest.sheets[it.sheet];
        let margin = options.margin_mm - ROUNDING_MM;
        let is_on = match &sheets[used.kind].form {
            NestForm::Outline(points) => {
                all[n].iter().flatten().all(|&p| inside(points, p))
                    && apart(&all[n], std::slice::from_ref(points)) >= margin
            }
            _ => {
                let [w, h] = used.size;
                bounds[n].0.cmpge(Vec2::splat(margin)).all()
                    && bounds[n].1.cmple(Vec2::new(w, h) - margin).all()
            }
        };
        if !is_on {
            return Some(NestFault::OffSheet(n));
        }
        let turns = &parts[it.part].turns;
        let grain = match sheets[used.kind].form {
            NestForm::Rectangle([w, h]) if h > w => FRAC_PI_2,
            _ => 0.0,
        };
        let off = turns.off(it.turn - grain, it.is_over).abs();
        if off > turns.tolerance + 1e-9 || (it.is_over && !turns.may_turn_over) {
            return Some(NestFault::Turned(n));
        }
    }
    let is_missing = |part: usize| nest.too_large.contains(&part) || nest.left_over.contains(&part);
    (0..parts.len())
        .find(|&part| {
            let mut copies: Vec<usize> =
                nest.placements.iter().filter(|it| it.part == part).map(|it| it.copy).collect();
            copies.sort_unstable();
            copies.dedup();
            let count = nest.placements.iter().filter(|it| it.part == part).count();
            copies.len() != count || (count != parts[part].count && !is_missing(part))
        })
        .map(NestFault::Miscounted)
}

fn bounds(points: &[Point2]) -> (Vec2, Vec2) {
    let around = Box2::of_points(points.iter().copied());
    around.map_or_else(Default::default, |it| (it.min.to_vec(), it.max.to_vec()))
}

fn too_near(a: &[Vec<Point2>], b: &[Vec<Point2>], gap: f64) -> bool {
    let is_in = |p: Point2, of: &[Vec<Point2>]| {
        inside(&of[0], p) && !of[1..].iter().any(|hole| inside(hole, p))
    };
    is_in(a[0][0], b) || is_in(b[0][0], a) || apart(a, b) < gap - 1e-9
}

/// The least distance of the sides of two regions, mm; below 0 where sides touch.
fn apart(a: &[Vec<Point2>], b: &[Vec<Point2>]) -> f64 {
    fn sides(loops: &[Vec<Point2>]) -> impl Iterator<Item = [Point2; 2]> {
        let of = |line: &'_ Vec<Point2>| {
            let line = line.clone();
            (0..line.len()).map(move |k| [line[k], line[(k + 1) % line.len()]])
        };
        loops.iter().flat_map(of)
    }
    let of_b: Vec<[Point2; 2]> = sides(b).collect();
    let mut least = f64::INFINITY;
    for [p, q] in sides(a) {
        for &[r, s] in &of_b {
            if segments_touch(p, q, r, s) {
                return -1.0;
            }
            let ends = [
                p.distance_to_segment([r, s]),
                q.distance_to_segment([r, s]),
                r.distance_to_segment([p, q]),
                s.distance_to_segment([p, q]),
            ];
            least = ends.into_iter().fold(least, f64::min);
        }
    }
    least
}
