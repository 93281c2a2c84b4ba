//! Curves that meet end to end become one: first those that meet exactly, then, of what is still
//! open, those whose ends lie within a ten-thousandth of the size of the drawing. Ends are joined
//! only where exactly two meet, so that a fork joins nothing by chance.

use super::drawn::Drawn;
use sheetwright::math::{Point3, Vec3};
use std::collections::BTreeMap;

/// Ends this near, as a share of the size of the drawing, meet up to rounding.
const EXACT: f64 = 1e-9;
/// Ends this near are joined as well: 0.1 mm on a metre.
const NEAR: f64 = 1e-4;
/// Gaps below this share of the size are rounding of the file, of which nothing is said.
const UNSEEN: f64 = 1e-6;

/// What chaining makes.
pub(super) struct Chained {
    pub(super) curves: Vec<Drawn>,
    /// The gaps that were closed, mm, each with its place.
    pub(super) gaps: Vec<(f64, Point3)>,
    /// Places at which three ends or more meet.
    pub(super) forks: Vec<Point3>,
}

/// The size of some curves: the diagonal of the box round points of them, mm.
pub(super) fn size_of<'a>(curves: impl IntoIterator<Item = &'a Drawn>) -> f64 {
    let [low, high] = bounds(curves);
    if low.x <= high.x { (high - low).length() } else { 0.0 }
}

/// The corners of the box round points of some curves.
pub(super) fn bounds<'a>(curves: impl IntoIterator<Item = &'a Drawn>) -> [Vec3; 2] {
    let segments = curves.into_iter().flat_map(|curve| &curve.segments);
    let points = segments.flat_map(|segment| {
        let steps: &[f64] = if segment.is_line() {
            &[0.0, 1.0]
        } else {
            &[0.0, 0.125, 0.25, 0.5, 0.75, 0.875, 1.0]
        };
        steps.iter().map(|&t| segment.position(t).to_vec())
    });
    let none = [Vec3::splat(f64::INFINITY), Vec3::splat(f64::NEG_INFINITY)];
    points.fold(none, |[low, high], p| [low.min(p), high.max(p)])
}

/// Chains the curves of a drawing of this size; those of different groups stay apart.
pub(super) fn chained(curves: Vec<Drawn>, size: f64, group: impl Fn(&Drawn) -> String) -> Chained {
    let mut done = Chained { curves, gaps: Vec::new(), forks: Vec::new() };
    for share in [EXACT, NEAR] {
        done.forks.clear();
        let groups: Vec<String> = done.curves.iter().map(&group).collect();
        done = joined(done, &groups, size, share * size);
    }
    done
}

/// One round: joins the ends within `near` of one another where exactly two meet.
fn joined(before: Chained, groups: &[String], size: f64, near: f64) -> Chained {
    let Chained { curves, mut gaps, mut forks } = before;
    let partner = partners(&curves, groups, near, &mut forks);
    let mut left: Vec<Option<Drawn>> = curves.into_iter().map(Some).collect();
    let mut curves = Vec::with_capacity(left.len());
    // Open chains begin at an end without a partner; what is left after them are rings.
    let begins = |end: usize| partner[end].is_none();
    let open = (0..left.len()).filter_map(|n| [2 * n, 2 * n + 1].into_iter().find(|&e| begins(e)));
    let starts: Vec<usize> = open.chain((0..left.len()).map(|n| 2 * n)).collect();
    for start in starts {
        let Some(first) = left[start / 2].take() else { continue };
        let mut chain = directed(first, start);
        let mut leaving = start ^ 1;
        let mut see = |gap: f64, at: Point3| {
            if gap > UNSEEN * size {
                gaps.push((gap, at));
            }
        };
        while let Some(end) = partner[leaving] {
            let Some(here) = chain.end() else { break };
            let Some(next) = left[end / 2].take() else {
                // The ring closes where it began.
                if let (Some(begin), Some(last)) = (chain.start(), chain.segments.last_mut()) {
                    see(here.distance(begin), here);
                    last.move_end(true, begin);
                    chain.closed = true;
                }
                break;
            };
            let mut next = directed(next, end);
            if let Some(first) = next.segments.first_mut() {
                see(first.start().distance(here), here);
                first.move_end(false, here);
            }
            let is_named = |curve: &Drawn| curve.names.iter().any(|name| !name.is_empty());
            if !is_named(&chain) && is_named(&next) {
                (chain.names, chain.layers) = (next.names, next.layers);
            }
            chain.segments.append(&mut next.segments);
            leaving = end ^ 1;
        }
        curves.push(chain);
    }
    Chained { curves, gaps, forks }
}

/// The curve as it is run from an end: the even end of it is its start.
fn directed(mut curve: Drawn, end: usize) -> Drawn {
    if end % 2 == 1 {
        let segments = std::mem::take(&mut curve.segments);
        curve.segments =
            segments.into_iter().rev().map(super::segment::Segment::reversed).collect();
    }
    curve
}

/// The end that each end meets; ends are numbered two for a curve, its start and its end.
fn partners(
    curves: &[Drawn],
    groups: &[String],
    near: f64,
    forks: &mut Vec<Point3>,
) -> Vec<Option<usize>> {
    let ends: Vec<Option<Point3>> = curves
        .iter()
        .flat_map(|curve| match curve.closed {
            true => [None, None],
            false => [curve.start(), curve.end()],
        })
        .collect();
    let low = bounds(curves)[0];
    let cell = |p: Point3| ((p.to_vec() - low) / near.max(f64::MIN_POSITIVE)).to_array();
    let cell = |p: Point3| cell(p).map(|c| c.floor() as i64);
    let mut cells: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
    for (n, end) in ends.iter().enumerate() {
        if let Some(end) = end {
            cells.entry(cell(*end)).or_default().push(n);
        }
    }
    // Two neighbours are enough to know a fork.
    let neighbours = |n: usize, at: Point3| -> Vec<usize> {
        let mut found = Vec::new();
        let [x, y, z] = cell(at);
        for (i, j, k) in (0..27).map(|c| (c / 9 - 1, c / 3 % 3 - 1, c % 3 - 1)) {
            let key = [x.saturating_add(i), y.saturating_add(j), z.saturating_add(k)];
            for &other in cells.get(&key).into_iter().flatten() {
                let is_near = ends[other].is_some_and(|there| there.distance(at) <= near);
                // A stroke as short as a gap does not close onto itself.
                let is_stroke = || other ^ 1 == n && size_of([&curves[n / 2]]) <= 4.0 * near;
                if other != n && is_near && !is_stroke() && groups[other / 2] == groups[n / 2] {
                    found.push(other);
                    if found.len() > 1 {
                        return found;
                    }
                }
            }
        }
        found
    };
    let met: Vec<Vec<usize>> = ends
        .iter()
        .enumerate()
        .map(|(n, end)| end.map_or(Vec::new(), |at| neighbours(n, at)))
        .collect();
    forks
        .extend(met.iter().zip(&ends).filter(|(met, _)| met.len() > 1).filter_map(|(_, end)| *end));
    let only = |n: usize| match met[n][..] {
        [other] if met[other] == [n] => Some(other),
        _ => None,
    };
    (0..ends.len()).map(only).collect()
}
