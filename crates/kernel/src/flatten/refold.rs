//! Folding a flat pattern up again and laying it on the surface it came from.
//!
//! A pattern that was written and read back is the last thing before the saw. Its triangles are
//! laid beside one another in space as they lie in the plane, but turned about every rung by the
//! crease that the surface has there. The result is moved, not bent, onto the surface triangle of
//! its root, and the largest distance of a sample from where it belongs is the refold error: it
//! sees a wrong length, a swapped sample, a missing rung, a wrong unit and too few digits alike.

use crate::index::SampleIndex;
use crate::math::{Frame, Point2, Point3, Vec3, turned, unit};
use crate::rung::Rung;
use crate::surface::{Connectivity, ConnectivityError, Surface};
use std::fmt;

/// Why a pattern can't be folded onto a surface.
#[derive(Clone, Debug, PartialEq)]
pub enum RefoldError {
    /// The outline has another number of points than the boundary has samples.
    Outline {
        /// How many points the outline has.
        found: usize,
        /// How many samples the boundary has.
        wanted: usize,
    },
    /// The rungs leave parts of the outline that are no triangles.
    Rungs,
    /// The outline runs clockwise: the pattern is mirrored.
    Mirrored,
    /// The triangles make no surface.
    Surface(ConnectivityError),
    /// A triangle of the pattern, or of the surface, has no area, so nothing can be folded at it.
    NoArea,
}

impl fmt::Display for RefoldError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Outline { found, wanted } => {
                write!(f, "the outline has {found} points where the boundary has {wanted} samples")
            }
            Self::Rungs => write!(f, "the rungs do not cut the outline into triangles"),
            Self::Mirrored => write!(f, "the pattern is mirrored"),
            Self::Surface(error) => write!(f, "{error}"),
            Self::NoArea => write!(f, "a triangle without area can't be folded"),
        }
    }
}

impl std::error::Error for RefoldError {}

/// The largest distance, mm, between a sample of `surface` and where it comes to lie when the
/// pattern is folded. `outline` are the points of the pattern in the order of the samples, mm;
/// `rungs` are its rungs, as they were read.
///
/// # Errors
/// See [`RefoldError`].
pub fn refold(surface: &Surface, outline: &[Point2], rungs: &[Rung]) -> Result<f64, RefoldError> {
    let wanted = surface.positions().len();
    if outline.len() != wanted {
        return Err(RefoldError::Outline { found: outline.len(), wanted });
    }
    let triangles = triangles_between(wanted, rungs).ok_or(RefoldError::Rungs)?;
    let connectivity = Connectivity::new(surface.connectivity().loops(), triangles)
        .map_err(RefoldError::Surface)?;
    let area = |t: &[SampleIndex; 3]| {
        let [a, b, c] = t.map(|s| outline[s.get()]);
        (b - a).perp_dot(c - a)
    };
    if connectivity.triangles().iter().map(area).sum::<f64>() < 0.0 {
        return Err(RefoldError::Mirrored);
    }
    // Creases are those of the surface, looked up by rung; a rung that it does not have is wrong.
    let mut by_rung: Vec<(Rung, f64)> =
        surface.connectivity().hinges().iter().map(|h| (h.rung, surface.crease(h))).collect();
    by_rung.sort_by_key(|entry| entry.0);
    let crease_of = |rung: Rung| {
        by_rung.binary_search_by_key(&rung, |entry| entry.0).ok().map(|n| by_rung[n].1)
    };
    let folded = fold(&connectivity, outline, crease_of)?;
    laid_on(surface, &connectivity, &folded)
}

/// The triangles that the rungs of a loop of m samples leave; `None` if they leave anything else.
fn triangles_between(m: usize, rungs: &[Rung]) -> Option<Vec<[SampleIndex; 3]>> {
    let mut joined: Vec<Vec<usize>> = (0..m).map(|i| vec![(i + 1) % m, (i + m - 1) % m]).collect();
    for rung in rungs {
        let [a, b] = rung.ends().map(SampleIndex::get);
        if b >= m {
            return None;
        }
        joined[a].push(b);
        joined[b].push(a);
    }
    for list in &mut joined {
        list.sort_unstable();
        list.dedup();
    }
    let sides: usize = joined.iter().map(Vec::len).sum();
    if sides != 2 * (2 * m - 3) {
        return None;
    }
    // Below every side i < j there is one triangle, with the corner between them that both join.
    let mut triangles = Vec::with_capacity(m - 2);
    let mut below = vec![(0, m - 1)];
    while let Some((i, j)) = below.pop() {
        if j - i < 2 {
            continue;
        }
        let k = joined[i]
            .iter()
            .copied()
            .filter(|&k| i < k && k < j)
            .rfind(|k| joined[*k].binary_search(&j).is_ok())?;
        triangles.push([i, k, j].map(SampleIndex::new));
        below.extend([(i, k), (k, j)]);
    }
    (triangles.len() == m - 2).then_some(triangles)
}

/// The outline folded along the hinges, in a frame of its own.
fn fold(
    connectivity: &Connectivity,
    outline: &[Point2],
    crease_of: impl Fn(Rung) -> Option<f64>,
) -> Result<Vec<Point3>, RefoldError> {
    let root = largest_triangle(connectivity, outline);
    let hinges = connectivity.hinges_of_triangles();
    let mut placed: Vec<Option<Point3>> = vec![None; outline.len()];
    for sample in connectivity.triangles()[root] {
        let p = outline[sample.get()];
        placed[sample.get()] = Some(Point3::new(p.x, p.y, 0.0));
    }
    let mut waiting = vec![(root, None, Vec3::Z)];
    while let Some((triangle, entered, normal)) = waiting.pop() {
        for &n in hinges[triangle].iter().filter(|&&n| Some(n) != entered) {
            let hinge = connectivity.hinges()[n];
            let crease = crease_of(hinge.rung).ok_or(RefoldError::Rungs)?;
            let [low, high] = hinge.rung.ends();
            let first = hinge.triangles[0].get() == triangle;
            let other = hinge.triangles[usize::from(first)];
            let far = connectivity.far_corner(other, [low, high]);
            let (Some(at_low), Some(at_high)) = (placed[low.get()], placed[high.get()]) else {
                return Err(RefoldError::Rungs);
            };
            let along = unit(at_high - at_low).ok_or(RefoldError::NoArea)?;
            // Over a mountain, the normal turns about low → high on the way from the first.
            let turn = if first { crease } else { -crease };
            let normal = turned(normal, along, turn);
            let (flat_along, flat_across) = flat_coordinates(outline, low, high, far)?;
            let across = normal.cross(along);
            placed[far.get()] = Some(at_low + along * flat_along + across * flat_across);
            waiting.push((other.get(), Some(n), normal));
        }
    }
    placed.into_iter().collect::<Option<Vec<Point3>>>().ok_or(RefoldError::Rungs)
}

/// Where a far corner lies along low → high and to the left of it, in the plane, mm.
fn flat_coordinates(
    outline: &[Point2],
    low: SampleIndex,
    high: SampleIndex,
    far: SampleIndex,
) -> Result<(f64, f64), RefoldError> {
    let [at_low, at_high, at_far] = [low, high, far].map(|s| outline[s.get()]);
    let along = crate::math::unit2(at_high - at_low).ok_or(RefoldError::NoArea)?;
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

/// Moves the folded samples so that they lie on the surface as well as they can at one triangle,
/// and returns the largest distance, mm. The triangle with the largest area gives the frame.
fn laid_on(
    surface: &Surface,
    connectivity: &Connectivity,
    folded: &[Point3],
) -> Result<f64, RefoldError> {
    let area = |t: &[SampleIndex; 3]| {
        let [a, b, c] = t.map(|s| surface.position(s));
        (b - a).cross(c - a).length()
    };
    let largest = connectivity
        .triangles()
        .iter()
        .max_by(|a, b| area(a).total_cmp(&area(b)).then(b.cmp(a)))
        .ok_or(RefoldError::NoArea)?;
    let frame = |at: &dyn Fn(SampleIndex) -> Point3| {
        let [a, b, c] = largest.map(at);
        let z = unit((b - a).cross(c - a))?;
        let x = unit(b - a)?;
        Some(Frame { origin: a, x, y: z.cross(x), z })
    };
    let from = frame(&|s| folded[s.get()]).ok_or(RefoldError::NoArea)?;
    let to = frame(&|s| surface.position(s)).ok_or(RefoldError::NoArea)?;
    let moved = |p: Point3| {
        let way = p - from.origin;
        to.origin + to.x * way.dot(from.x) + to.y * way.dot(from.y) + to.z * way.dot(from.z)
    };
    let distances = folded.iter().zip(surface.positions()).map(|(p, q)| moved(*p).distance(*q));
    Ok(distances.fold(0.0, f64::max))
}
