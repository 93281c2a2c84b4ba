//! From a surface with or without holes to its sheet and flat pattern.

use super::choose::cuts;
use super::close::{closed, gap_mm};
use super::opened::Opened;
use super::pose::posed;
use super::unroll::unroll;
use super::{FlattenError, Flattened};
use crate::sheet::Sheet;
use crate::surface::Surface;
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::{Point2, Point3, Vec2};
use sheetwright_geometry::predicate::{first_overlap_of_loops, signed_area_doubled};
use sheetwright_geometry::tolerance::Tolerance;
use sheetwright_geometry::watch::Watch;
use std::ops::Range;

/// Lays a surface flat, cut open where it must be: as few cuts are left as can be, and round
/// windows in a panel that lies flat by itself there are none. `near` are places in space, mm, at
/// which the user wants the cuts; rungs with their middles nearest to them are taken.
///
/// A cut whose two sides come to lie on one another is closed again. So is one that gapes by no
/// more than [`Tolerance::CLOSING`] of the size, where changing lengths by no more than
/// [`Tolerance::STRETCH`] closes it; or [`Tolerance::MOST_STRETCH`], where the pattern would else
/// overlap itself. Without such cuts, all lengths are exact.
///
/// # Errors
/// See [`FlattenError`].
pub fn lay_flat(
    surface: &Surface,
    near: &[Point3],
    watch: &mut dyn Watch,
) -> Result<(Sheet, Flattened), FlattenError> {
    if surface.connectivity().loops().len() == 1 {
        let flat = unroll(surface.connectivity(), |a, b| surface.length(a, b), watch)?;
        return Ok((Sheet::whole(surface), flat));
    }
    let cuts = cuts(surface, near, Tolerance::CLOSING);
    let opened = Opened::cut(surface, &cuts, 0)?;
    let length = |a: SampleIndex, b: SampleIndex| opened.surface().length(a, b);
    let exact = unroll(opened.surface().connectivity(), length, watch)?;
    let close = |stretch: Tolerance, watch: &mut dyn Watch| {
        closed_within(surface, &cuts, &opened, &exact, stretch, watch)
    };
    let (mut left, mut flat) = match close(Tolerance::STRETCH, watch)? {
        Some(found) => found,
        None => (opened.clone(), exact.clone()),
    };
    if flat.overlap.is_some()
        && let Some(found) = close(Tolerance::MOST_STRETCH, watch)?
        && found.1.overlap.is_none()
    {
        (left, flat) = found;
    }
    Ok((left.sheet(&flat.points), flat))
}

/// The sheet and pattern with those cuts closed that can be without changing a length by more than
/// `most`; `None` if none can.
fn closed_within(
    surface: &Surface,
    cuts: &[usize],
    opened: &Opened,
    exact: &Flattened,
    most: Tolerance,
    watch: &mut dyn Watch,
) -> Result<Option<(Opened, Flattened)>, FlattenError> {
    let size = size_of(surface.positions().iter().copied());
    let gaps: Vec<f64> = opened.cuts().iter().map(|cut| gap_mm(cut, &exact.points)).collect();
    let within = |tolerance: Tolerance, n: usize| gaps[n] <= tolerance.length_mm(size);
    let mut closing: Vec<usize> =
        (0..gaps.len()).filter(|&n| within(Tolerance::CLOSING, n)).collect();
    // Widest last, to be given up first.
    closing.sort_by(|&a, &b| gaps[a].total_cmp(&gaps[b]).then(a.cmp(&b)));
    while let Some(&widest) = closing.last() {
        let found = if within(Tolerance::ROUNDING, widest) {
            Some(exact.clone())
        } else {
            closed(opened, &closing, exact, watch)?
                .filter(|found| stretch(opened, &found.points) <= most.share())
        };
        if let Some(found) = found {
            let left: Vec<usize> =
                (0..cuts.len()).filter(|n| !closing.contains(n)).map(|n| cuts[n]).collect();
            let (sheet, flat) = rejoined(surface, &left, opened, &found)?;
            // A hole that comes to lie counter-clockwise is none: the sheet passes over it twice.
            // Left open, the pattern crosses its own outline, which is found.
            let loops = sheet.surface().connectivity().loops();
            let is_hole = |l: &Range<usize>| signed_area_doubled(&flat.points[l.clone()]) < 0.0;
            if loops[1..].iter().all(is_hole) {
                return Ok(Some((sheet, flat)));
            }
        }
        closing.pop();
    }
    Ok(None)
}

/// The largest relative change of a length.
fn stretch(sheet: &Opened, points: &[Point2]) -> f64 {
    let surface = sheet.surface();
    let errors = surface.connectivity().sides().map(|[a, b]| {
        let space = surface.length(a, b);
        (points[a.get()].distance(points[b.get()]) - space).abs() / space
    });
    errors.fold(0.0, f64::max)
}

/// The sheet with fewer cuts, and the pattern on it; what becomes one sample lies in the middle.
fn rejoined(
    surface: &Surface,
    cuts: &[usize],
    before: &Opened,
    flat: &Flattened,
) -> Result<(Opened, Flattened), FlattenError> {
    let mut sheet = Opened::cut(surface, cuts, 0)?;
    let mut points = carried(before, &flat.points, &sheet);
    // The outline runs counter-clockwise and the holes clockwise, whatever they are in space.
    let loops = sheet.surface().connectivity().loops();
    let area = |n: &usize| signed_area_doubled(&points[loops[*n].clone()]);
    let outer = (0..loops.len()).max_by(|a, b| area(a).total_cmp(&area(b)).then(b.cmp(a)));
    if let Some(outer) = outer.filter(|&outer| outer > 0) {
        let sample = sheet.origin(SampleIndex::new(loops[outer].start)).get();
        let first = surface.connectivity().loops().partition_point(|l| l.end <= sample);
        sheet = Opened::cut(surface, cuts, first)?;
        points = carried(before, &flat.points, &sheet);
    }
    let loops = sheet.surface().connectivity().loops();
    let points = posed(&points, &loops[0]);
    let overlap = first_overlap_of_loops(&points, loops);
    Ok((sheet, Flattened { points, overlap }))
}

/// The points of one sheet on another of the same surface, which has fewer samples.
fn carried(from: &Opened, points: &[Point2], to: &Opened) -> Vec<Point2> {
    let [before, after] = [from, to].map(|sheet| sheet.surface().connectivity());
    // Which samples of the one are which of the other, by the corners of the triangles.
    let mut becomes = vec![0; before.samples()];
    for (b, a) in before.triangles().iter().flatten().zip(after.triangles().iter().flatten()) {
        becomes[b.get()] = a.get();
    }
    let mut sums = vec![(Vec2::ZERO, 0.0); after.samples()];
    for (b, &a) in becomes.iter().enumerate() {
        sums[a].0 += points[b].to_vec();
        sums[a].1 += 1.0;
    }
    sums.into_iter().map(|(sum, count)| Point2::default() + sum / count).collect()
}
