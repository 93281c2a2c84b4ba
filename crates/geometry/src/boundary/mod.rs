//! The boundary of a panel: closed loops of samples, validated once, here, and trusted afterwards.
//!
//! The first loop is the outer one and runs counter-clockwise as seen from the side that the
//! surface faces; the others are holes. Samples are counted through all loops from 0.

mod join;
mod outline;
mod plane;
mod smooth;
mod touch;

pub use join::{JoinCause, JoinError, JoinOptions, Joined, join, join_all};
pub use outline::{OnOutline, Outline, Side};
pub use plane::{PlaneChoice, PlaneError, SupportingPlane, supporting_plane};
pub use smooth::{Continuity, SmoothedJoint, Within};

use crate::curve::{MAX_COORDINATE_MM, Sample};
use crate::index::SampleIndex;
use crate::math::{Point3, Vec3, unit};
pub use crate::tolerance::MIN_SIZE_MM;
use crate::tolerance::Tolerance;
use std::fmt;
use std::ops::Range;

/// Samples of all loops at the most: what the typed indices and the solvers are made for.
pub const MAX_SAMPLES: usize = 1_000_000;

/// Closed loops of samples with their tangents.
#[derive(Clone, Debug, PartialEq)]
pub struct Boundary {
    samples: Vec<Sample>,
    loops: Vec<Range<usize>>,
    size: f64,
}

/// Why loops of samples are no boundary. Loops and samples are counted from 0, samples within
/// their loop.
#[derive(Clone, Debug, PartialEq)]
pub enum BoundaryError {
    /// A loop with fewer than three samples.
    TooFewSamples {
        /// The loop.
        of_loop: usize,
        /// How many samples it has.
        found: usize,
    },
    /// More than [`MAX_SAMPLES`] samples.
    TooManySamples {
        /// How many samples there are.
        found: usize,
    },
    /// A coordinate that is no finite number, or beyond [`MAX_COORDINATE_MM`].
    OutOfRange {
        /// The loop.
        of_loop: usize,
        /// The sample.
        sample: usize,
    },
    /// All samples within [`MIN_SIZE_MM`].
    TooSmall,
    /// A sample on the same spot as another, without the two being sides of a seam.
    Repeated {
        /// The loop.
        of_loop: usize,
        /// The sample.
        sample: usize,
        /// The loop of the earlier one.
        other_loop: usize,
        /// The earlier one.
        other: usize,
    },
    /// An edge that is walked twice in the same direction, at samples on the same spot: a band that
    /// closes with a half turn, a Möbius strip, which has one side only.
    OneSided {
        /// The loop.
        of_loop: usize,
        /// The sample.
        sample: usize,
        /// The loop of the earlier one.
        other_loop: usize,
        /// The earlier one.
        other: usize,
    },
    /// All samples of a loop on one straight line.
    OnOneLine {
        /// The loop.
        of_loop: usize,
    },
    /// A loop whose every edge is walked both ways, so that it bounds nothing.
    BoundsNothing {
        /// The loop.
        of_loop: usize,
    },
    /// Two edges that cross or touch.
    Crossing {
        /// The loop.
        of_loop: usize,
        /// The sample that the first edge begins at.
        sample: usize,
        /// The loop of the second edge.
        other_loop: usize,
        /// The sample that the second edge begins at.
        other: usize,
        /// Where the first edge begins, mm; boxed, since errors are small.
        near: Box<Point3>,
    },
}

impl fmt::Display for BoundaryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |of_loop: usize| match of_loop {
            0 => "the outer loop".to_owned(),
            n => format!("hole {n}"),
        };
        match *self {
            Self::TooFewSamples { of_loop, found } => {
                write!(f, "{} has {found} samples and needs at least 3", name(of_loop))
            }
            Self::TooManySamples { found } => {
                write!(f, "the boundary has {found} samples; {MAX_SAMPLES} is the most")
            }
            Self::OutOfRange { of_loop, sample } => write!(
                f,
                "{} has a coordinate at sample {} that is not a number within ±1e9 mm",
                name(of_loop),
                sample + 1
            ),
            Self::TooSmall => write!(f, "all samples lie within a millionth of a millimetre"),
            Self::Repeated { of_loop, sample, other_loop, other } => {
                write!(f, "sample {} of {} lies on ", sample + 1, name(of_loop))?;
                write!(f, "sample {} of {}", other + 1, name(other_loop))
            }
            Self::OneSided { of_loop, sample, other_loop, other } => {
                write!(
                    f,
                    "an edge is walked twice in the same direction, at sample {} of ",
                    sample + 1
                )?;
                write!(f, "{} and sample {} of {}: ", name(of_loop), other + 1, name(other_loop))?;
                write!(f, "the band closes with a half turn and has one side only")
            }
            Self::OnOneLine { of_loop } => {
                write!(f, "all samples of {} lie on one straight line", name(of_loop))
            }
            Self::BoundsNothing { of_loop } => {
                write!(f, "{} runs back along itself and bounds nothing", name(of_loop))
            }
            Self::Crossing { of_loop, sample, other_loop, other, ref near } => {
                write!(f, "{} crosses ", name(of_loop))?;
                match of_loop == other_loop {
                    true => write!(f, "itself")?,
                    false => write!(f, "{}", name(other_loop))?,
                }
                write!(f, " after samples {} and {}, ", sample + 1, other + 1)?;
                write!(f, "near ({:.1}, {:.1}, {:.1}) mm", near.x, near.y, near.z)
            }
        }
    }
}

impl std::error::Error for BoundaryError {}

impl Boundary {
    /// The boundary with these loops, the outer one first.
    ///
    /// # Errors
    /// See [`BoundaryError`]. An edge that is walked both ways is a seam, which is allowed: the
    /// boundary of a tube that is cut open has one.
    pub fn new(loops: Vec<Vec<Sample>>) -> Result<Self, BoundaryError> {
        let found = loops.iter().map(Vec::len).sum();
        if found > MAX_SAMPLES {
            return Err(BoundaryError::TooManySamples { found });
        }
        if loops.is_empty() {
            return Err(BoundaryError::TooFewSamples { of_loop: 0, found: 0 });
        }
        let mut samples = Vec::with_capacity(found);
        let mut ranges = Vec::with_capacity(loops.len());
        for (of_loop, list) in loops.into_iter().enumerate() {
            if list.len() < 3 {
                return Err(BoundaryError::TooFewSamples { of_loop, found: list.len() });
            }
            let in_range = |x: f64| x.abs() <= MAX_COORDINATE_MM;
            let within = |p: Point3| in_range(p.x) && in_range(p.y) && in_range(p.z);
            if let Some(sample) = list.iter().position(|s| !within(s.position)) {
                return Err(BoundaryError::OutOfRange { of_loop, sample });
            }
            ranges.push(samples.len()..samples.len() + list.len());
            samples.extend(list);
        }
        let size = size_of(samples.iter().map(|s| s.position));
        if size < MIN_SIZE_MM {
            return Err(BoundaryError::TooSmall);
        }
        let boundary = Self { samples, loops: ranges, size };
        for (of_loop, range) in boundary.loops.iter().enumerate() {
            if boundary.on_one_line(range.clone()) {
                return Err(BoundaryError::OnOneLine { of_loop });
            }
        }
        touch::refuse_touching(&boundary)?;
        Ok(boundary)
    }

    /// This boundary with one hole, counted from 1, run the other way round. The hole's first
    /// sample stays its first.
    ///
    /// # Panics
    /// If there is no such hole.
    #[must_use]
    pub fn with_hole_turned(&self, hole: usize) -> Self {
        assert!(hole > 0, "the outer loop is no hole");
        let mut turned = self.clone();
        let samples = &mut turned.samples[self.loops[hole].clone()];
        samples[1..].reverse();
        for sample in samples {
            (sample.tangent_in, sample.tangent_out) = (-sample.tangent_out, -sample.tangent_in);
        }
        turned
    }

    /// The outer loop and some of the holes, counted from 1.
    pub fn with_holes(&self, holes: &[usize]) -> Self {
        let loops = std::iter::once(0).chain(holes.iter().copied());
        self.of_lists(loops.map(|n| self.samples[self.loops[n].clone()].to_vec()))
    }

    /// About so many samples of each loop, evenly chosen, with the tangents that they have; at
    /// least three.
    pub fn thinned(&self, samples: usize) -> Self {
        self.of_lists(self.loops.iter().map(|of_loop| {
            let step = (of_loop.len() / samples.max(3)).max(1);
            self.samples[of_loop.clone()].iter().step_by(step).copied().collect()
        }))
    }

    /// A boundary with these loops and as many other samples; not validated.
    pub fn with_samples(&self, samples: Vec<Sample>) -> Self {
        debug_assert_eq!(samples.len(), self.samples.len());
        let size = size_of(samples.iter().map(|s| s.position));
        Self { samples, loops: self.loops.clone(), size }
    }

    fn of_lists(&self, lists: impl Iterator<Item = Vec<Sample>>) -> Self {
        let mut part = Self { samples: Vec::new(), loops: Vec::new(), size: self.size };
        for list in lists {
            part.loops.push(part.samples.len()..part.samples.len() + list.len());
            part.samples.extend(list);
        }
        part
    }

    /// All samples, loop after loop.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// The numbers of the samples of each loop, the outer one first.
    pub fn loops(&self) -> &[Range<usize>] {
        &self.loops
    }

    /// How many samples all loops have.
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// Always false: a boundary has at least three samples.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// How many holes there are.
    pub fn holes(&self) -> usize {
        self.loops.len() - 1
    }

    /// The size of the boundary, mm: the diagonal of the box around it.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// Where a sample lies, mm.
    pub fn position(&self, sample: SampleIndex) -> Point3 {
        self.samples[sample.get()].position
    }

    /// Where all samples lie, mm.
    pub fn positions(&self) -> Vec<Point3> {
        self.samples.iter().map(|s| s.position).collect()
    }

    /// The number of the sample after sample `i` on its loop.
    pub fn next(&self, i: usize) -> usize {
        let range = self.loop_of(i);
        if i + 1 == range.end { range.start } else { i + 1 }
    }

    /// The number of the sample before sample `i` on its loop.
    pub fn previous(&self, i: usize) -> usize {
        let range = self.loop_of(i);
        if i == range.start { range.end - 1 } else { i - 1 }
    }

    fn loop_of(&self, i: usize) -> Range<usize> {
        self.loops[self.loops.partition_point(|range| range.end <= i)].clone()
    }

    /// The loop of sample `i`, and its number within the loop.
    fn within_loop(&self, i: usize) -> (usize, usize) {
        let of_loop = self.loops.partition_point(|range| range.end <= i);
        (of_loop, i - self.loops[of_loop].start)
    }

    /// Half the sum of P_i × P_{i+1} over the outer loop, mm²: its direction is the normal of the
    /// plane onto which the loop projects with the largest area (Newell's normal).
    pub fn area_vector(&self) -> Vec3 {
        let range = self.loops[0].clone();
        let origin = self.samples[range.start].position;
        let doubled: Vec3 = range
            .clone()
            .map(|i| {
                let a = self.samples[i].position - origin;
                a.cross(self.samples[self.next(i)].position - origin)
            })
            .sum();
        doubled * 0.5
    }

    fn on_one_line(&self, range: Range<usize>) -> bool {
        let origin = self.samples[range.start].position;
        let way = |i: usize| self.samples[i].position - origin;
        let farthest = range
            .clone()
            .max_by(|&a, &b| way(a).length_squared().total_cmp(&way(b).length_squared()));
        let Some(line) = farthest.and_then(|i| unit(way(i))) else { return true };
        let enough = Tolerance::SAME_POINT.length_mm(self.size);
        range.into_iter().all(|i| way(i).cross(line).length() <= enough)
    }
}

/// The diagonal of the box around some points, mm.
pub fn size_of(points: impl IntoIterator<Item = Point3>) -> f64 {
    let start = (Vec3::splat(f64::INFINITY), Vec3::splat(f64::NEG_INFINITY));
    let (low, high) = points
        .into_iter()
        .fold(start, |(low, high), p| (low.min(p.to_vec()), high.max(p.to_vec())));
    if low.x > high.x { 0.0 } else { (high - low).length() }
}

/// The samples of a closed loop whose points are the samples themselves: tangents from central
/// differences, one-sided at corners.
pub fn samples_from_points(points: &[crate::curve::CurvePoint]) -> Vec<Sample> {
    let m = points.len();
    let at = |i: usize| points[i % m].at;
    (0..m)
        .map(|i| {
            let arrive = at(i) - at(i + m - 1);
            let leave = at(i + 1) - at(i);
            // A point that repeats its neighbour has no direction; `Boundary::new` refuses it.
            let direction = |v: Vec3| unit(v).unwrap_or(Vec3::ZERO);
            let (tangent_in, tangent_out) = if points[i].corner {
                (direction(arrive), direction(leave))
            } else {
                let central = unit(at(i + 1) - at(i + m - 1)).unwrap_or(direction(leave));
                (central, central)
            };
            Sample { position: at(i), tangent_in, tangent_out }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::CurvePoint;

    fn samples(list: &[[f64; 3]]) -> Vec<Sample> {
        let points: Vec<CurvePoint> =
            list.iter().map(|p| CurvePoint::smooth(Point3::new(p[0], p[1], p[2]))).collect();
        samples_from_points(&points)
    }

    const SQUARE: [[f64; 3]; 4] =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

    fn refused(list: &[[f64; 3]]) -> BoundaryError {
        Boundary::new(vec![samples(list)]).unwrap_err()
    }

    #[test]
    fn a_square_is_a_boundary() {
        let boundary = Boundary::new(vec![samples(&SQUARE)]).unwrap();
        assert_eq!(boundary.len(), 4);
        assert_eq!((boundary.next(3), boundary.previous(0)), (0, 3));
        assert!((boundary.area_vector() - Vec3::Z).length() < 1e-15);
        assert!((boundary.size() - std::f64::consts::SQRT_2).abs() < 1e-15);
    }

    #[test]
    fn everything_is_validated_at_the_door() {
        use BoundaryError as E;
        assert_eq!(refused(&[]), E::TooFewSamples { of_loop: 0, found: 0 });
        assert_eq!(refused(&SQUARE[..2]), E::TooFewSamples { of_loop: 0, found: 2 });
        assert_eq!(
            refused(&[SQUARE[0], SQUARE[1], [f64::NAN, 0.0, 0.0]]),
            E::OutOfRange { of_loop: 0, sample: 2 }
        );
        assert_eq!(
            refused(&[SQUARE[0], [1e300, 0.0, 0.0], SQUARE[2]]),
            E::OutOfRange { of_loop: 0, sample: 1 }
        );
        let tiny = SQUARE.map(|p| p.map(|x| x * 1e-300));
        assert_eq!(refused(&tiny), E::TooSmall);
        assert_eq!(
            refused(&[SQUARE[0], SQUARE[1], SQUARE[1], SQUARE[2]]),
            E::Repeated { of_loop: 0, sample: 2, other_loop: 0, other: 1 }
        );
        assert_eq!(refused(&[[0.0; 3], [1.0; 3], [3.0; 3], [2.0; 3]]), E::OnOneLine { of_loop: 0 });
        assert_eq!(
            refused(&[SQUARE[0], SQUARE[2], SQUARE[1], SQUARE[3]]),
            E::Crossing {
                of_loop: 0,
                sample: 0,
                other_loop: 0,
                other: 2,
                near: Box::new(Point3::new(0.0, 0.0, 0.0))
            }
        );
        let there_and_back = [0, 1, 2, 3, 2, 1].map(|i| SQUARE[i]);
        assert_eq!(refused(&there_and_back), E::BoundsNothing { of_loop: 0 });
        // A figure of eight that passes twice through one sample.
        assert_eq!(
            refused(&[
                [0.0, 0.0, 0.0],
                [1.0, -1.0, 0.0],
                [1.0, 1.0, 0.0],
                [0.0, 0.0, 0.0],
                [-1.0, -1.0, 0.0],
                [-1.0, 1.0, 0.0],
            ]),
            E::Repeated { of_loop: 0, sample: 3, other_loop: 0, other: 0 }
        );
    }

    #[test]
    fn a_tube_cut_open_is_a_boundary() {
        // Two squares one above the other, joined by an edge that is walked down and up.
        let mut list: Vec<[f64; 3]> = SQUARE.to_vec();
        list.push(SQUARE[0]);
        list.extend([4, 3, 2, 1, 0].map(|i: usize| {
            let [x, y, _] = SQUARE[i % 4];
            [x, y, 1.0]
        }));
        assert!(Boundary::new(vec![samples(&list)]).is_ok());
    }

    #[test]
    fn corners_have_two_tangents_and_others_one() {
        let mut points: Vec<CurvePoint> =
            SQUARE.iter().map(|p| CurvePoint::smooth(Point3::new(p[0], p[1], p[2]))).collect();
        points[1].corner = true;
        let samples = samples_from_points(&points);
        assert_eq!(samples[1].tangent_in, Vec3::X);
        assert_eq!(samples[1].tangent_out, Vec3::Y);
        assert!(!samples[0].is_corner());
        assert!((samples[2].tangent_in - Vec3::new(-1.0, 1.0, 0.0) / 2f64.sqrt()).length() < 1e-15);
    }
}
