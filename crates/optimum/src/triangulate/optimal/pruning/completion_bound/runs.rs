//! The loop in runs of neighbouring samples, and the directions of rungs between two runs.

use crate::triangulate::Terms;
use sheetwright_geometry::math::{Vec3, unit};
use std::ops::Range;

/// Corners are single runs while they are at most one in so many runs: their rungs have a choice of
/// normals, which would loosen the bounds of a longer run.
const RUNS_A_CORNER: usize = 4;
/// Runs of neighbouring samples. The first sample, the last, and each corner are single runs.
pub(in crate::triangulate::optimal) struct Runs {
    /// The first sample of each run, and the number of samples.
    starts: Vec<u32>,
    /// The run of each sample.
    of: Vec<u32>,
}

impl Runs {
    /// Runs of no more than `length` samples, which begin at multiples of it or next to corners.
    pub(super) fn new(terms: &Terms<'_>, length: usize) -> Self {
        let m = terms.prices.len();
        let is_corner: Vec<bool> = (0..m).map(|i| terms.prices.smooth_end(i).2 < 0.0).collect();
        let corners = is_corner.iter().filter(|is| **is).count();
        let apart = |i: usize| {
            let is_apart = is_corner[i] && corners * RUNS_A_CORNER * length <= m;
            i == 0 || i + 1 == m || is_apart
        };
        let starts_here = |i: usize| i.is_multiple_of(length) || apart(i) || apart(i - 1);
        let mut starts: Vec<u32> = (0..m).filter(|&i| starts_here(i)).map(|i| i as u32).collect();
        starts.push(m as u32);
        let mut of = vec![0; m];
        for (run, ends) in starts.windows(2).enumerate() {
            of[ends[0] as usize..ends[1] as usize].fill(run as u32);
        }
        Self { starts, of }
    }

    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    pub(super) fn samples(&self, run: usize) -> Range<usize> {
        self.starts[run] as usize..self.starts[run + 1] as usize
    }

    /// How many edges of the boundary join samples of a run.
    pub(super) fn inner_edges(&self, run: usize) -> usize {
        self.samples(run).len() - 1
    }

    #[inline(always)]
    pub(super) fn of(&self, sample: usize) -> usize {
        self.of[sample] as usize
    }

    /// Memory, bytes.
    pub(super) fn bytes(&self) -> u64 {
        ((self.starts.len() + self.of.len()) * size_of::<u32>()) as u64
    }
}

/// A unit vector, and the largest distance of others from it.
#[derive(Clone, Copy)]
pub(super) struct Direction {
    pub(super) middle: Vec3,
    /// Infinite where no bound is known.
    pub(super) off: f64,
}

impl Direction {
    const ANY: Self = Self { middle: Vec3::ZERO, off: f64::INFINITY };
    /// Limit of the distance, as a share of a length: beyond it, the direction is too uncertain.
    pub(super) const FARTHEST: f64 = 0.7;
    /// For δ of up to [`Self::FARTHEST`] |x|, the unit vectors of x and of x + δ differ by no more
    /// than so many times |δ| / |x|: 2 sin(½ asin(0.7)) / 0.7 is 1.081.
    pub(super) const OFF_OF_SHARE: f64 = 1.1;
    /// Upper bound on the effect of rounding on a direction, far above it.
    pub(super) const LEAST_OFF: f64 = 1e-7;
    /// A triangle with two corners this close to one another, as a share of the size of the loop,
    /// may have a normal that rounding turns by as much as a radian.
    const CLOSE: f64 = 4e-15;

    /// Of all vectors that differ from `middle` by no more than `off`.
    fn around(middle: Vec3, off: f64) -> Self {
        let length = middle.length();
        if off <= Self::FARTHEST * length && length > 0.0 {
            Self {
                middle: middle / length,
                off: Self::OFF_OF_SHARE * off / length + Self::LEAST_OFF,
            }
        } else {
            Self::ANY
        }
    }

    /// Of all vectors a × b with such directions.
    #[inline(always)]
    pub(super) fn across(a: &Self, b: &Self) -> Self {
        let middle = a.middle.cross(b.middle);
        Self::around(middle, a.off + b.off + a.off * b.off)
    }
}

/// The box around some vectors.
#[derive(Clone, Copy)]
struct Extent {
    least: [f64; 3],
    greatest: [f64; 3],
}

impl Extent {
    const NONE: Self = Self { least: [f64::INFINITY; 3], greatest: [f64::NEG_INFINITY; 3] };

    fn include(&mut self, other: &Self) {
        for axis in 0..3 {
            self.least[axis] = self.least[axis].min(other.least[axis]);
            self.greatest[axis] = self.greatest[axis].max(other.greatest[axis]);
        }
    }

    fn of(vectors: impl Iterator<Item = Vec3>) -> Self {
        let mut extent = Self::NONE;
        for vector in vectors {
            let at = vector.to_array();
            extent.include(&Self { least: at, greatest: at });
        }
        extent
    }

    /// The middle, and the largest distance of the vectors from it.
    fn ball(&self) -> (Vec3, f64) {
        let [least, greatest] = [self.least, self.greatest].map(Vec3::from_array);
        ((least + greatest) * 0.5, ((greatest - least) * 0.5).length())
    }
}

/// The directions of rungs from each run to itself and to each later one, by first run.
///
/// The closer of two bounds is taken: one from a ball around each run, good for runs far apart; and
/// one from the edges of the boundary between the ends of a rung, whose sum it is, good where the
/// boundary hardly turns.
pub(super) fn directions(terms: &Terms<'_>, runs: &Runs) -> Vec<Direction> {
    let n = runs.len();
    let at = |i: usize| Vec3::from_array(terms.prices.smooth_end(i).0);
    let balls: Vec<(Vec3, f64)> =
        (0..n).map(|run| Extent::of(runs.samples(run).map(at)).ball()).collect();
    let edge = |i: usize| unit(at(i + 1) - at(i)).unwrap_or(Vec3::ZERO);
    let m = terms.prices.len();
    let close = Direction::CLOSE * 2.0 * Extent::of((0..m).map(at)).ball().1;
    let shortest = (1..m).map(|i| (at(i) - at(i - 1)).length()).fold(f64::INFINITY, f64::min);
    let inner = |run: usize| {
        let samples = runs.samples(run);
        Extent::of((samples.start..samples.end - 1).map(edge))
    };
    let to = |run: usize| {
        let samples = runs.samples(run);
        Extent::of((samples.start - 1..samples.end - 1).map(edge))
    };
    let to: Vec<Extent> = (0..n).map(|run| if run == 0 { Extent::NONE } else { to(run) }).collect();
    let mut directions = vec![Direction::ANY; n * n];
    for a in 0..n {
        let mut edges = inner(a);
        for b in a..n {
            if b > a {
                edges.include(&to[b]);
            }
            let mut direction = Direction::ANY;
            if edges.least[0] <= edges.greatest[0] {
                let (middle, off) = edges.ball();
                direction = Direction::around(middle, off + close / shortest);
            }
            if b > a {
                let ((from, of_from), (end, of_end)) = (balls[a], balls[b]);
                let by_balls = Direction::around(end - from, of_from + of_end + close);
                if by_balls.off < direction.off {
                    direction = by_balls;
                }
            }
            directions[a * n + b] = direction;
        }
    }
    directions
}
