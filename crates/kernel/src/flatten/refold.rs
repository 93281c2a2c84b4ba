//! Folding a flat pattern up again and laying it on the surface it came from.
//!
//! A pattern that was written and read back is the last thing before the saw. Its triangles are
//! laid beside one another in space as they lie in the plane, but turned about every rung by the
//! crease that the surface has there. The result is moved, not bent, onto the surface triangle of
//! its root, and the largest distance of a sample from where it belongs is the refold error: it
//! sees a wrong length, a swapped sample, a missing rung, a wrong unit and too few digits alike.

use crate::mesh::{Mesh, MeshEdge};
use crate::sheet::Sheet;
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::{Frame, Point2, Point3, Vec3, turned, unit, unit2};
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

/// The largest distance, mm, between a vertex of a sheet without interior vertices and where it
/// comes to lie when the pattern is folded. `points` are those of the pattern in the order of the
/// vertices, loop after loop, mm; `rungs` are its rungs, as they were read.
///
/// Triangles that hang together in a cycle, round a hole, are folded along a tree of them; since
/// every corner of every triangle is compared, the others must agree.
///
/// # Errors
/// See [`RefoldError`].
pub fn refold(sheet: &Sheet, points: &[Point2], rungs: &[Rung]) -> Result<f64, RefoldError> {
    let mesh = sheet.mesh();
    let wanted = mesh.positions().len();
    if points.len() != wanted {
        return Err(RefoldError::Outline { found: points.len(), wanted });
    }
    // The rungs decide the triangles: those of the surface if the rungs are.
    let mut rungs = rungs.to_vec();
    rungs.sort_unstable();
    rungs.dedup();
    if !rungs.iter().copied().eq(hinges(mesh).map(|hinge| hinge.rung)) {
        return Err(RefoldError::Rungs);
    }
    let area = |t: &[VertexIndex; 3]| {
        let [a, b, c] = t.map(|v| points[v.get()]);
        (b - a).perp_dot(c - a)
    };
    if mesh.triangles().iter().map(area).sum::<f64>() < 0.0 {
        return Err(RefoldError::Mirrored);
    }
    laid_on(mesh, &fold(mesh, points)?)
}

/// A rung with its ends and the triangles that it joins: first the one on whose border it runs from
/// the lower vertex to the higher.
struct Hinge {
    rung: Rung,
    ends: [VertexIndex; 2],
    triangles: [usize; 2],
}

impl Hinge {
    fn of(edge: &MeshEdge) -> Option<Self> {
        let [Some(first), Some(second)] = edge.triangles else { return None };
        let [low, high] = edge.ends;
        let rung = Rung::new(low.get(), high.get());
        Some(Self { rung, ends: edge.ends, triangles: [first.get(), second.get()] })
    }
}

/// The sides that join two triangles, in increasing order.
fn hinges(mesh: &Mesh) -> impl Iterator<Item = Hinge> + '_ {
    mesh.edges().iter().filter_map(Hinge::of)
}

/// The corners of every triangle of the pattern folded along the hinges, in a frame of its own.
fn fold(mesh: &Mesh, points: &[Point2]) -> Result<Vec<[Point3; 3]>, RefoldError> {
    let triangles = mesh.triangles();
    let root = largest_triangle(triangles, points);
    let hinges: Vec<Hinge> = hinges(mesh).collect();
    let mut of_triangles = vec![Vec::new(); triangles.len()];
    for (n, hinge) in hinges.iter().enumerate() {
        hinge.triangles.iter().for_each(|&t| of_triangles[t].push(n));
    }
    let mut placed: Vec<Option<[Point3; 3]>> = vec![None; triangles.len()];
    placed[root] = Some(triangles[root].map(|vertex| {
        let p = points[vertex.get()];
        Point3::new(p.x, p.y, 0.0)
    }));
    // Nearest first, so that no way round a hole is longer than need be.
    let mut waiting = VecDeque::from([(root, Vec3::Z)]);
    while let Some((triangle, normal)) = waiting.pop_front() {
        for hinge in of_triangles[triangle].iter().map(|&n| &hinges[n]) {
            let first = hinge.triangles[0] == triangle;
            let other = hinge.triangles[usize::from(first)];
            if placed[other].is_some() {
                continue;
            }
            let crease = mesh.crease(hinge.ends, hinge.triangles.map(TriangleIndex::new));
            let [low, high] = hinge.ends;
            let is_far = |corner: &VertexIndex| !hinge.ends.contains(corner);
            let far = triangles[other].into_iter().find(is_far).ok_or(RefoldError::NoArea)?;
            let at = |wanted: VertexIndex| {
                let corner = triangles[triangle].iter().position(|&v| v == wanted)?;
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
            placed[other] = Some(triangles[other].map(|vertex| {
                if vertex == low {
                    at_low
                } else if vertex == high {
                    at_high
                } else {
                    at_far
                }
            }));
            waiting.push_back((other, normal));
        }
    }
    placed.into_iter().collect::<Option<Vec<[Point3; 3]>>>().ok_or(RefoldError::Rungs)
}

/// Where a far corner lies along low → high and to the left of it, in the plane, mm.
fn flat_coordinates(
    outline: &[Point2],
    low: VertexIndex,
    high: VertexIndex,
    far: VertexIndex,
) -> Result<(f64, f64), RefoldError> {
    let [at_low, at_high, at_far] = [low, high, far].map(|v| outline[v.get()]);
    let along = unit2(at_high - at_low).ok_or(RefoldError::NoArea)?;
    let way = at_far - at_low;
    Ok((way.dot(along), along.perp_dot(way)))
}

/// The triangle to begin with: the largest, whose frame is determined best.
fn largest_triangle(triangles: &[[VertexIndex; 3]], outline: &[Point2]) -> usize {
    let area = |t: &[VertexIndex; 3]| {
        let [a, b, c] = t.map(|v| outline[v.get()]);
        (b - a).perp_dot(c - a)
    };
    (0..triangles.len())
        .max_by(|&a, &b| area(&triangles[a]).total_cmp(&area(&triangles[b])).then(b.cmp(&a)))
        .unwrap_or(0)
}

/// Moves the folded triangles so that they lie on the surface as well as they can at one of them,
/// and returns the largest distance, mm. The triangle with the largest area gives the frame.
fn laid_on(mesh: &Mesh, folded: &[[Point3; 3]]) -> Result<f64, RefoldError> {
    let triangles = mesh.triangles();
    let area = |n: &usize| {
        let [a, b, c] = triangles[*n].map(|v| mesh.position(v));
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
    let to = frame(triangles[largest].map(|v| mesh.position(v))).ok_or(RefoldError::NoArea)?;
    let moved = |p: Point3| {
        let way = p - from.origin;
        to.origin + to.x * way.dot(from.x) + to.y * way.dot(from.y) + to.z * way.dot(from.z)
    };
    let corners = triangles.iter().flatten().zip(folded.iter().flatten());
    let distances = corners.map(|(&v, &p)| moved(p).distance(mesh.position(v)));
    Ok(distances.fold(0.0, f64::max))
}
