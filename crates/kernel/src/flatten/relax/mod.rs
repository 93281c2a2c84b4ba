//! Laying a mesh flat that need not be developable, with a free border: every length is kept as
//! well as can be, and no triangle is turned over.
//!
//! 1. A first flat form by linear equations ([`start`]).
//! 2. Where that squeezes triangles much, steps that never flatten one bring it near ([`spread`]).
//! 3. Weighted least squares of the sides' relative length errors, by Gauss and Newton's method
//!    ([`springs`]), with the weights that the aim asks for ([`aims`]); triangles that they would
//!    squeeze flat are guarded ([`guard`]).
//!
//! Lengths are all that is read. A surface that can be laid flat exactly is, but for rounding.

mod aims;
mod guard;
mod shape;
mod spread;
mod springs;
mod start;

use super::Flattened;
use super::pose::posed;
use crate::mesh::{Mesh, Topology};
use aims::Run;
use shape::{LEAST_AREA, Shape, corners_of, flipped, shapes};
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::sparse::{Plan, elimination_order};
use sheetwright_geometry::math::{Point2, Vec2};
use sheetwright_geometry::predicate::{first_overlap_of_loops, orientation};
use sheetwright_geometry::watch::Watch;
use spread::{Reference, stretches};
use springs::Form;
use std::fmt;

/// The quantity that flattening minimises where lengths cannot all be true. Errors are relative:
/// the length in the plane less that in space, divided by that in space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Aim {
    /// The mean error, with equal weights: most sides are true, and the errors sit in few places.
    #[default]
    Mean,
    /// The largest error: errors are spread evenly, and most sides have a small one.
    Max,
    /// The border is true (1e-9), so that both sides of every seam are equal, and the squares of
    /// the other sides' errors are least.
    Seams,
}

/// How a mesh is laid flat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RelaxOptions {
    /// The quantity that is minimised.
    pub aim: Aim,
    /// The most steps after the first flat form; each solves a sparse system of twice the number of
    /// vertices. Aims take 10 to 40.
    pub most_steps: usize,
}

impl Default for RelaxOptions {
    fn default() -> Self {
        Self { aim: Aim::Mean, most_steps: 100 }
    }
}

impl RelaxOptions {
    /// One step only, towards the least squares: for following the mouse. It is the first of every
    /// aim's.
    pub const FAST: Self = Self { aim: Aim::Mean, most_steps: 1 };
}

/// How laying flat ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// All lengths are true, but for rounding.
    True,
    /// The quantity is as small as steps make it.
    Least,
    /// The quantity is as small as steps make it, but a triangle is squeezed to a hundredth of its
    /// area, the limit of every step: the surface should be cut open.
    Squeezed,
    /// No steps were left.
    OutOfSteps,
    /// The watcher asked to stop; the form is valid, but not the best.
    Stopped,
}

/// A mesh laid flat.
#[derive(Clone, Debug, PartialEq)]
pub struct Relaxed {
    /// Where its vertices lie.
    pub flat: Flattened,
    /// How many triangles do not run counter-clockwise. Exact; 0, unless the last turn into the
    /// rectangle rounds a needle over.
    pub flipped: usize,
    /// How it ended.
    pub ended: Ended,
    /// How many steps were taken.
    pub steps: usize,
}

/// Why a mesh cannot be laid flat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RelaxError {
    /// It has several components; each is laid flat by itself.
    Components {
        /// How many.
        found: usize,
    },
    /// It is closed, as a sphere is, and must be cut open.
    Closed,
    /// It has handles, as a torus has with a hole in it, and must be cut open.
    Handles {
        /// How many.
        found: usize,
    },
    /// Three lengths that make no triangle.
    NoTriangle {
        /// The triangle.
        triangle: TriangleIndex,
    },
    /// A hole whose edges cannot close.
    Hole,
    /// No flat form was found without a triangle upside down: lengths differ by more than rounding
    /// allows.
    NoStart,
    /// The system of equations does not fit the memory.
    TooLarge,
    /// The watcher asked to stop before there was a flat form.
    Stopped,
}

impl fmt::Display for RelaxError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Components { found } => {
                write!(f, "the mesh has {found} pieces; lay each flat by itself")
            }
            Self::Closed => {
                write!(f, "the mesh is closed and must be cut open before it lies flat")
            }
            Self::Handles { found: 1 } => {
                write!(f, "the mesh has a handle and must be cut open before it lies flat")
            }
            Self::Handles { found } => {
                write!(f, "the mesh has {found} handles and must be cut open before it lies flat")
            }
            Self::NoTriangle { triangle } => {
                write!(f, "the lengths of triangle {triangle} make no triangle")
            }
            Self::Hole => write!(f, "the lengths round a hole can't close"),
            Self::NoStart => write!(f, "no flat form was found without a triangle upside down"),
            Self::TooLarge => write!(f, "the mesh is too large for the memory"),
            Self::Stopped => write!(f, "stopped"),
        }
    }
}

impl std::error::Error for RelaxError {}

/// Lays a mesh of one piece flat. Holes stay open.
///
/// # Errors
/// See [`RelaxError`].
pub fn relax(
    mesh: &Mesh,
    options: &RelaxOptions,
    watch: &mut dyn Watch,
) -> Result<Relaxed, RelaxError> {
    relax_lengths(mesh.topology(), &mesh.lengths(), options, watch)
}

/// Lays a mesh of one piece flat from the lengths of its sides, mm, in the order of
/// [`Topology::edges`]. Holes stay open.
///
/// # Errors
/// See [`RelaxError`].
///
/// # Panics
/// Unless there is one length a side.
pub fn relax_lengths(
    topology: &Topology,
    lengths: &[f64],
    options: &RelaxOptions,
    watch: &mut dyn Watch,
) -> Result<Relaxed, RelaxError> {
    assert_eq!(topology.edges().len(), lengths.len(), "one length a side");
    check(topology)?;
    let shapes =
        shapes(topology, lengths).map_err(|triangle| RelaxError::NoTriangle { triangle })?;
    let pairs: Vec<[usize; 2]> =
        topology.edges().iter().map(|edge| edge.ends.map(|v| v.get())).collect();
    let order = elimination_order(topology.vertices(), &pairs).map_err(|_| RelaxError::TooLarge)?;
    if watch.stop() {
        return Err(RelaxError::Stopped);
    }
    let started = start::start(topology, lengths, &shapes, &order)?;
    let mut points = started.ok_or(RelaxError::NoStart)?;
    let plan = Plan::<2>::new(&order, &pairs).map_err(|_| RelaxError::TooLarge)?;
    let outer = &topology.loops()[0];
    let held = [outer[0].get(), outer[outer.len() / 2].get()];
    let inner = Inner { topology, lengths, shapes: &shapes, held };
    spread::spread(&inner, &plan, &mut points, watch)?;
    let mut run = Run { inner: &inner, plan: &plan, most_steps: options.most_steps, steps: 0 };
    let form = Form::new(&inner, points);
    let (form, mut ended) = run.towards(options.aim, form, watch)?;
    if ended == Ended::Least && inner.is_squeezed(&form.points) {
        ended = Ended::Squeezed;
    }
    watch.progress(1.0);
    let (flat, flipped) = laid_at(topology, &form.points);
    Ok(Relaxed { flat, flipped, ended, steps: run.steps })
}

/// How much a conformal flat form of a mesh of one piece, whose border keeps its lengths, scales
/// at every vertex: the size of the logarithm of the factor, 0 on the border. `None` where no such
/// form is found.
///
/// # Errors
/// See [`RelaxError`].
pub(crate) fn conformal_scales(mesh: &Mesh) -> Result<Option<Vec<f64>>, RelaxError> {
    check(mesh.topology())?;
    let lengths = mesh.lengths();
    let shapes = shapes(mesh.topology(), &lengths)
        .map_err(|triangle| RelaxError::NoTriangle { triangle })?;
    start::scales(mesh.topology(), &lengths, &shapes)
}

/// A mesh that is laid at these points, mm, turned into its rectangle; and how many of its
/// triangles do not run counter-clockwise there.
pub(crate) fn laid_at(topology: &Topology, points: &[Point2]) -> (Flattened, usize) {
    let points = posed(points, &(0..points.len()));
    let flipped = flipped(topology, &points);
    (Flattened { overlap: overlap(topology, &points), points }, flipped)
}

/// The largest and the smallest stretch of a triangle, without unit: how much longer its directions
/// are in the plane than in space. The smallest is negative where it is turned over; both are 1
/// where its lengths are kept. `None` where the lengths, in the order of its sides from the first
/// corner on, make no triangle.
pub(crate) fn triangle_stretches(lengths: [f64; 3], flat: [Point2; 3]) -> Option<[f64; 2]> {
    let shape = Shape::of(lengths)?;
    Some(stretches(Reference::new(&shape, lengths[0]).map(flat)).0)
}

fn check(topology: &Topology) -> Result<(), RelaxError> {
    let [piece] = topology.components() else {
        return Err(RelaxError::Components { found: topology.components().len() });
    };
    if piece.is_closed() {
        return Err(RelaxError::Closed);
    }
    match piece.handles() {
        0 => Ok(()),
        found => Err(RelaxError::Handles { found }),
    }
}

/// Two edges of the border that tell where the pattern overlaps itself.
pub(super) fn overlap(topology: &Topology, points: &[Point2]) -> Option<(usize, usize)> {
    let vertices: Vec<usize> = topology.loops().iter().flatten().map(|v| v.get()).collect();
    let border: Vec<Point2> = vertices.iter().map(|&v| points[v]).collect();
    let mut end = 0;
    let ranges = topology.loops().iter().map(|of_loop| {
        let start = end;
        end += of_loop.len();
        start..end
    });
    let ranges: Vec<std::ops::Range<usize>> = ranges.collect();
    first_overlap_of_loops(&border, &ranges).map(|(a, b)| (vertices[a], vertices[b]))
}

/// A mesh from within: which vertices are joined, and how far apart they are.
struct Inner<'a> {
    topology: &'a Topology,
    lengths: &'a [f64],
    shapes: &'a [Shape],
    /// Two vertices of the border, far from one another on it.
    held: [usize; 2],
}

impl Inner<'_> {
    /// The numbers of a triangle's sides, each from the corner of the same place on.
    fn edges_of(&self, triangle: usize) -> [usize; 3] {
        self.topology.edges_of(TriangleIndex::new(triangle))
    }

    fn corners(&self, triangle: usize, points: &[Point2]) -> [Point2; 3] {
        corners_of(self.topology, triangle, points)
    }

    fn references(&self) -> Vec<Reference> {
        let first = |n: usize| self.lengths[self.edges_of(n)[0]];
        self.shapes.iter().enumerate().map(|(n, shape)| Reference::new(shape, first(n))).collect()
    }

    /// The relative length error of each side, signed.
    fn errors(&self, points: &[Point2]) -> Vec<f64> {
        let error = |(edge, length): (&crate::mesh::MeshEdge, &f64)| {
            let [a, b] = edge.ends.map(|v| points[v.get()]);
            (a.distance(b) - length) / length
        };
        self.topology.edges().iter().zip(self.lengths).map(error).collect()
    }

    fn moved(&self, points: &[Point2], step: &[Vec2], share: f64) -> Vec<Point2> {
        points.iter().zip(step).map(|(&p, &way)| p + way * share).collect()
    }

    /// Whether some triangle has come to the least area that steps leave it, or near.
    fn is_squeezed(&self, points: &[Point2]) -> bool {
        self.shapes.iter().enumerate().any(|(n, shape)| {
            let [a, b, c] = self.corners(n, points);
            (b - a).perp_dot(c - a) < 2.0 * LEAST_AREA * shape.doubled_area
        })
    }

    fn is_unflipped(&self, points: &[Point2]) -> bool {
        (0..self.shapes.len()).all(|n| {
            let [a, b, c] = self.corners(n, points);
            orientation(a, b, c).is_gt()
        })
    }
}
