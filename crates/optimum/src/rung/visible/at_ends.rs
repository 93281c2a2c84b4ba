//! Which rungs leave into the inside of a projected loop at both ends, as far as rounding can tell.
//!
//! A rung that leaves into the outside at one of its ends is not inside. That test takes a few
//! products for each pair, where exact visibility takes a walk through triangles; 64 corners are
//! tested side by side, in the widest registers of the processor (crate `pulp`). On a loop that
//! does not wind, few outside rungs pass it.

use super::pairs::{BITS, PairSet};
use sheetwright_geometry::math::{Point2, Vec2};
use sheetwright_geometry::predicate::orientation;

/// Rounding error of the doubled area of a triangle, as a share of its two products, at most: a
/// little more than the (3 + 16 ε) ε of \[Shewchuk1997\].
const ROUNDING: f64 = 4e-16;

/// The pairs of samples whose segment leaves into the inside at both ends, and those for which
/// rounding leaves that open.
pub(super) fn pairs_at_ends(polygon: &[Point2]) -> PairSet {
    let blocks: Vec<Block> =
        (0..polygon.len()).step_by(BITS).map(|first| Block::new(polygon, first)).collect();
    let mut pairs = PairSet::new(polygon.len());
    let registers = pulp::Arch::new();
    for i in 0..polygon.len() {
        let from = blocks[i / BITS].corner(i % BITS);
        let (blocks, words) = (&blocks[i / BITS..], pairs.row_mut(i));
        registers.dispatch(LookFrom { from, blocks, words });
    }
    pairs
}

/// A corner of a polygon.
#[derive(Clone, Copy)]
struct Corner {
    at: [f64; 2],
    /// The edges towards it and away from it.
    inwards: [f64; 2],
    outwards: [f64; 2],
    is_convex: bool,
}

impl Corner {
    /// Whether the way (dx, dy) from here may leave into the inside.
    #[inline(always)]
    fn leaves(&self, dx: f64, dy: f64) -> bool {
        // Whether a direction surely points to the right of another.
        let right = |[ax, ay]: [f64; 2]| {
            let (one, other) = (ax * dy, ay * dx);
            one - other < -ROUNDING * (one.abs() + other.abs())
        };
        let (first, second) = (right(self.inwards), right(self.outwards));
        (self.is_convex & !first & !second) | (!self.is_convex & !(first & second))
    }
}

/// As many corners in a row as a word has bits, by coordinates, so that many are tested side by
/// side; the last one repeats beyond the end.
struct Block {
    at: [[f64; BITS]; 2],
    inwards: [[f64; BITS]; 2],
    outwards: [[f64; BITS]; 2],
    is_convex: [bool; BITS],
}

impl Block {
    fn new(polygon: &[Point2], first: usize) -> Self {
        let m = polygon.len();
        let corners: [Corner; BITS] = std::array::from_fn(|n| {
            let i = (first + n).min(m - 1);
            let (before, at, after) = (polygon[(i + m - 1) % m], polygon[i], polygon[(i + 1) % m]);
            let way = |way: Vec2| [way.x, way.y];
            Corner {
                at: [at.x, at.y],
                inwards: way(at - before),
                outwards: way(after - at),
                is_convex: orientation(before, at, after).is_gt(),
            }
        });
        Self {
            at: [0, 1].map(|axis| corners.map(|corner| corner.at[axis])),
            inwards: [0, 1].map(|axis| corners.map(|corner| corner.inwards[axis])),
            outwards: [0, 1].map(|axis| corners.map(|corner| corner.outwards[axis])),
            is_convex: corners.map(|corner| corner.is_convex),
        }
    }

    #[inline(always)]
    fn corner(&self, n: usize) -> Corner {
        let of = |lanes: &[[f64; BITS]; 2]| [lanes[0][n], lanes[1][n]];
        Corner {
            at: of(&self.at),
            inwards: of(&self.inwards),
            outwards: of(&self.outwards),
            is_convex: self.is_convex[n],
        }
    }
}

/// Tests the pairs of one corner with the blocks that its row has words for. A type rather than a
/// closure, so that it is compiled for the widest registers.
struct LookFrom<'a> {
    from: Corner,
    blocks: &'a [Block],
    words: &'a mut [u64],
}

impl pulp::WithSimd for LookFrom<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { from, blocks, words } = self;
        for (word, block) in words.iter_mut().zip(blocks) {
            let mut seen = [false; BITS];
            for n in 0..BITS {
                let to = block.corner(n);
                let [dx, dy] = [0, 1].map(|axis| to.at[axis] - from.at[axis]);
                seen[n] = from.leaves(dx, dy) & to.leaves(-dx, -dy);
            }
            *word = seen.iter().rev().fold(0, |word, &bit| word << 1 | u64::from(bit));
        }
    }
}
