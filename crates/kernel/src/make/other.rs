//! Whether another surface fits the boundary of a part about as well, see
//! [`sheetwright_optimum::triangulate::other_surface`].
//!
//! Where there is one, both are shown, and a finding says so: only a person knows which is meant.
//! Where both have one pattern, as strips that are twisted a little, the sheet itself decides.
//!
//! It takes searches of its own, so the question waits until a dragged handle rests.

use super::candidate::{Candidate, Setting};
use super::judged::{is_to_judge, judge};
use super::part::{Found, Origin, Other, Part};
use super::{Judging, MakeCause};
use crate::check::{Verdict, two_surfaces};
use crate::material::Material;
use crate::pattern::{PatternOptions, piece};
use sheetwright_geometry::math::{Point2, Vec2, atan2, cos, sin};
use sheetwright_geometry::watch::Watch;
use sheetwright_optimum::triangulate::{
    OtherSurface, TriangulateError, TriangulateOptions, WhichSurface, other_surface,
};

/// Patterns that differ by less, as a share of the size, are one: the sheet goes either way.
const ONE_PATTERN: f64 = 0.001;

/// Looks for another surface through the boundary of a part that was found with these options, and
/// adds it to the part with a finding. Returns whether there is one.
pub(super) fn add_other(
    part: &mut Part,
    options: &TriangulateOptions,
    judging: Judging,
    material: Option<&Material>,
    watch: &mut dyn Watch,
) -> Result<bool, MakeCause> {
    let Origin::Found(found) = &mut part.origin else { return Ok(false) };
    // The other of the other is found as the other of any surface.
    let options = &TriangulateOptions { which: WhichSurface::Cheapest, ..options.clone() };
    let (boundary, plane) = (&found.boundary, found.plane.as_ref());
    let Some(OtherSurface { triangulation, distance_mm }) =
        other_surface(boundary, plane, options, &found.triangulation, watch)?
    else {
        return Ok(false);
    };
    let ends = &found.ends;
    let setting = Setting { boundary, plane, options, material, thick: part.thick, ends };
    let candidate = setting.candidate(&part.name, &triangulation, &[], watch)?;
    let Candidate { surface, sheet, flat, measures, predicted, checked } = candidate;
    let options = PatternOptions { bends: part.bends, ..PatternOptions::default() };
    let piece = piece(&part.name, &sheet, &flat, &[], &measures, &[], &options);
    let origin = Found { surface, triangulation, change: None, other: None, ..(**found).clone() };
    let mut other = Part {
        name: part.name.clone(),
        panel: part.panel.clone(),
        sheet,
        flat,
        measures,
        predicted,
        checked,
        piece,
        thick: part.thick,
        bends: part.bends,
        edges: Vec::new(),
        origin: Origin::Found(Box::new(origin)),
    };
    if is_to_judge(&other, judging) && judge(&mut other, material, watch) {
        return Err(TriangulateError::Stopped.into());
    }
    // What does not bend is no choice.
    if other.checked.verdict == Verdict::WillNotBend {
        return Ok(false);
    }
    let size_mm = boundary.size();
    let pattern_mm = apart_in_plane(&part.flat.points, &other.flat.points);
    let is_one_pattern = pattern_mm <= ONE_PATTERN * size_mm;
    part.checked.add(two_surfaces(distance_mm, is_one_pattern, other.checked.verdict));
    found.other = Some(Other { part: Box::new(other), apart_mm: distance_mm });
    Ok(true)
}

/// How far two flat patterns of the same samples differ, mm: the largest distance of a sample,
/// after one pattern is moved and turned onto the other so that the squares of all are least.
fn apart_in_plane(a: &[Point2], b: &[Point2]) -> f64 {
    let middle = |points: &[Point2]| {
        points.iter().fold(Vec2::ZERO, |sum, p| sum + p.to_vec()) / points.len() as f64
    };
    let (middle_a, middle_b) = (middle(a), middle(b));
    let pairs = || a.iter().zip(b).map(|(p, q)| (p.to_vec() - middle_a, q.to_vec() - middle_b));
    let (along, across) = pairs()
        .fold((0.0, 0.0), |(along, across), (p, q)| (along + p.dot(q), across + q.perp_dot(p)));
    let angle = atan2(across, along);
    let turn = Vec2::new(cos(angle), sin(angle));
    pairs().map(|(p, q)| (turn.rotate(q) - p).length()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_compared_wherever_they_lie() {
        let square = [(0.0, 0.0), (3.0, 0.0), (3.0, 2.0), (0.0, 2.0)];
        let points = |of: &dyn Fn(f64, f64) -> (f64, f64)| -> Vec<Point2> {
            square.iter().map(|&(x, y)| of(x, y)).map(|(x, y)| Point2::new(x, y)).collect()
        };
        let plain = points(&|x, y| (x, y));
        let turned = points(&|x, y| (7.0 - 0.6 * y - 0.8 * x, 1.0 + 0.6 * x - 0.8 * y));
        assert!(apart_in_plane(&plain, &turned) < 1e-12);
        let longer = points(&|x, y| (-1.1 * x, -y));
        assert!((apart_in_plane(&plain, &longer) - 0.15).abs() < 1e-12);
    }
}
