//! Folding a flat pattern up again and laying it on the surface it came from.
//!
//! A pattern that was written and read back is the last thing before the saw. Its triangles are
//! laid beside one another in space as they lie in the plane, but turned about every rung by the
//! crease that the surface has there. The result is moved, not bent, onto the surface triangle of
//! its root, and the largest distance of a sample from where it belongs is the refold error: it
//! sees a wrong length, a swapped sample, a missing rung, a wrong unit and too few digits alike.

use crate::surface::{Connectivity, Surface};
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::{Frame, Point2, Point3, Vec3, turned, unit};
use sheetwright_optimum::rung::Rung;
use std::collections::VecDeque;
use std::fmt;

/// Why a pattern can't be folded onto a surface.
#[derive(Clone, Debug, PartialEq)]
pub enum RefoldError {
    /// The pattern has another number of points than the sheet has samples.
    Outline {
        /// How many points its outline and its holes have.
        found: usize,
        /// How many samples the sheet has.
        wanted: usize,
    },
    /// The rungs are not those of the surface.
    Rungs,
    /// The outline runs clockwise: the pattern is mirrored.
    Mirrored,
    /// A triangle of the pattern, or of the surface, has no area, so nothing can be folded at it.
    NoArea,
}

impl fmt::Display for RefoldError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Outline { found, wanted } => {
                write!(f, "the outline has {found} points where the sheet has {wanted} samples")
            }
            Self::Rungs => write!(f, "the rungs are not those of the surface"),
            Self::Mirrored => write!(f, "the pattern is mirrored"),
            Self::NoArea => write!(f, "a triangle without area can't be folded"),
        }
    }
}

impl std::error::Error for RefoldError {}

/// The largest distance, mm, between a sample of `surface`, which is that of a sheet, and where it
/// comes to lie when the pattern is folded. `points` are those of the pattern in the order of the
/// samples, loop after loop, mm; `rungs` are its rungs, as they were read.
///
/// Triangles that hang together in a cycle, round a hole, are folded along a tree of them; since
/// every corner of every triangle is compared, the others must agree.
///
/// # Errors
/// See [`RefoldError`].
pub fn refold(surface: &Surface, points: &[Point2], rungs: &[Rung]) -> Result<f64, RefoldError> {
    let wanted = surface.positions().len();
    if points.len() != wanted {
        return Err(RefoldError::Outline { found: points.len(), wanted });
    }
    // The rungs decide the triangles: those of the surface if the rungs are.
    let connectivity = surface.connectivity();
    let mut rungs = rungs.to_vec();
    rungs.sort_unstable();
    rungs.dedup();
    if !rungs.iter().eq(connectivity.hinges().iter().map(|hinge| &hinge.rung)) {
        return Err(RefoldError::Rungs);
    }
    let area = |t: &[SampleIndex; 3]| {
        let [a, b, c] = t.map(|s| points[s.get()]);
        (b - a).perp_dot(c - a)
    };
    if connectivity.triangles().iter().map(area).sum::<f64>() < 0.0 {
        return Err(RefoldError::Mirrored);
    }
    laid_on(surface, &fold(surface, points)?)
}

/// The corners of every triangle of the pattern folded along the hinges, in a frame of its own.
fn fold(surface: &Surface, points: &[Point2]) -> Result<Vec<[Point3; 3]>, RefoldError> {
    let connectivity = surface.connectivity();
    let root = largest_triangle(connectivity, points);
    let hinges = connectivity.hinges_of_triangles();
    let mut placed: Vec<Option<[Point3; 3]>> = vec![None; connectivity.triangles().len()];
    placed[root] = Some(connectivity.triangles()[root].map(|sample| {
        let p = points[sample.get()];
        Point3::new(p.x, p.y, 0.0)
    }));
    // Nearest first, so that no way round a hole is longer than need be.
    let mut waiting = VecDeque::from([(root, Vec3::Z)]);
    while let Some((triangle, normal)) = waiting.pop_front() {
        for &n in &hinges[triangle] {
            let hinge = connectivity.hinges()[n];
            let first = hinge.triangles[0].get() == triangle;
            let other = hinge.triangles[usize::from(first)];
            if placed[other.get()].is_some() {
                continue;
            }
            let crease = surface.crease(&hinge);
            let [low, high] = hinge.rung.ends();
            let far = connectivity.far_corner(other, [low, high]);
            let at = |wanted: SampleIndex| {
                let corners = connectivity.triangles()[triangle];
                let corner = corners.iter().position(|&s| s == wanted)?;
                Some(placed[triangle]?[corner])
            };
            let (Some(at_low), Some(at_high)) = (at(low), at(high)) else {
                return Err(RefoldError::Rungs);
            };
            let along = unit(at_high - at_low).ok_or(RefoldError::NoArea)?;
            // Over a mountain, the normal turns about low → high on the way from the first.
            let turn = if first { crease } else { -crease };
            let normal = turned(normal, along, turn);
            let (flat_along, flat_across) = flat_coordinates(points, low, high, far)?;
            let across = normal.cross(along);
            let at_far = at_low + along * flat_along + across * flat_across;
            placed[other.get()] = Some(connectivity.triangles()[other.get()].map(|sample| {
                if sample == low {
                    at_low
                } else if sample == high {
                    at_high
                } else {
                    at_far
                }
            }));
            waiting.push_back((other.get(), normal));
        }
    }
    placed.into_iter().collect::<Option<Vec<[Point3; 3]>>>().ok_or(RefoldError::Rungs)
}

/// Where a far corner lies along low → high and to the left of it, in the plane, mm.
fn flat_coordinates(
    outline: &[Point2],
    low: SampleIndex,
    high: SampleIndex,
    far: SampleIndex,
) -> Result<(f64, f64), RefoldError> {
    let [at_low, at_high, at_far] = [low, high, far].map(|s| outline[s.get()]);
    let along = sheetwright_geometry::math::unit2(at_high - at_low).ok_or(RefoldError::NoArea)?;
    let way = at_far - at_low;
    Ok((way.dot(along), along.perp_dot(way)))
}

/// The triangle to begin with: the largest, whose frame is determined best.
fn largest_triangle(connectivity: &Connectivity, outline: &[Point2]) -> usize {
    let area = |t: &[SampleIndex; 3]| {
        let [a, b, c] = t.map(|s| outline[s.get()]);
        (b - a).perp_dot(c - a)
    };
    let triangles = connectivity.triangles();
    (0..triangles.len())
        .max_by(|&a, &b| area(&triangles[a]).total_cmp(&area(&triangles[b])).then(b.cmp(&a)))
        .unwrap_or(0)
}

/// Moves the folded triangles so that they lie on the surface as well as they can at one of them,
/// and returns the largest distance, mm. The triangle with the largest area gives the frame.
fn laid_on(surface: &Surface, folded: &[[Point3; 3]]) -> Result<f64, RefoldError> {
    let triangles = surface.connectivity().triangles();
    let area = |n: &usize| {
        let [a, b, c] = triangles[*n].map(|s| surface.position(s));
        (b - a).cross(c - a).length()
    };
    let largest = (0..triangles.len())
        .max_by(|a, b| area(a).total_cmp(&area(b)).then(triangles[*b].cmp(&triangles[*a])))
        .ok_or(RefoldError::NoArea)?;
    let frame = |[a, b, c]: [Point3; 3]| {
        let z = unit((b - a).cross(c - a))?;
        let x = unit(b - a)?;
        Some(Frame { origin: a, x, y: z.cross(x), z })
    };
    let from = frame(folded[largest]).ok_or(RefoldError::NoArea)?;
    let to = frame(triangles[largest].map(|s| surface.position(s))).ok_or(RefoldError::NoArea)?;
    let moved = |p: Point3| {
        let way = p - from.origin;
        to.origin + to.x * way.dot(from.x) + to.y * way.dot(from.y) + to.z * way.dot(from.z)
    };
    let corners = triangles.iter().flatten().zip(folded.iter().flatten());
    let distances = corners.map(|(&s, &p)| moved(p).distance(surface.position(s)));
    Ok(distances.fold(0.0, f64::max))
}
