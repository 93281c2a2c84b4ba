//! Which rungs lie inside the projection of the boundary on its supporting plane.
//!
//! Triangular expansion \[Bungiu2014\], with exact predicates:
//! 1. The domain between the projected loops is cut into triangles (a constrained Delaunay
//!    triangulation, crate `spade`); which triangles does not matter.
//! 2. A sample sees its own triangles. Through the side opposite to it, it looks into the next
//!    triangle, within the window between that side's ends.
//! 3. The far corner of that triangle is seen if it lies strictly inside the window; it splits the
//!    window in two. Otherwise the window passes on one side of it, unchanged.
//! 4. A boundary edge ends the view.
//!
//! Without holes the triangles form a tree, so a sample meets each at most once: O(m) for each
//! sample, O(m²) for all. Round h holes it may meet a triangle from h + 1 sides. A rung that touches
//! the boundary between its ends is not inside.
//!
//! Many rungs can be told to be outside by their ends alone: where one of them leaves into the outside.
//! That takes a few products for each pair, many side by side, and no more is asked at first: if the
//! triangles of the answer do not overlap in the projection, all of its rungs are inside
//! (`triangulate::lying`).

use crate::boundary::Boundary;
use crate::boundary::SupportingPlane;
use crate::math::{Point2, Vec2};
use crate::predicate::orientation;
use spade::{ConstrainedDelaunayTriangulation, Triangulation};
use std::cmp::Ordering;
use std::ops::Range;
use std::sync::OnceLock;

/// Which pairs of samples may be joined: any two, or those whose rung lies inside the projection.
#[derive(Clone, Debug)]
pub struct Visibility {
    seen: Seen,
}

#[derive(Clone, Debug)]
enum Seen {
    Everything,
    Pairs(PairSet),
    /// What is inside at both ends, found out when it is first asked for.
    AtEnds(Vec<Point2>, OnceLock<PairSet>),
}

/// Bits of a word.
const BITS: usize = u64::BITS as usize;

/// A set of unordered pairs of samples: the row of the lower sample, which begins with the word of its
/// own bit, has a bit for each higher one. Bits of that word for lower samples mean nothing, nor do
/// those beyond the last sample.
#[derive(Clone, Debug)]
struct PairSet {
    words: Vec<u64>,
    samples: usize,
}

impl PairSet {
    fn new(m: usize) -> Self {
        let mut pairs = Self { words: Vec::new(), samples: m };
        pairs.words = vec![0; pairs.row(m)];
        pairs
    }

    /// Where the row of a sample begins.
    #[inline(always)]
    fn row(&self, i: usize) -> usize {
        let (block, of_first) = (i / BITS, self.samples.div_ceil(BITS));
        // Blocks have as many rows as a word has bits, each a word shorter than in the block before.
        let in_blocks = BITS * (block * of_first - block * block.saturating_sub(1) / 2);
        in_blocks + i % BITS * (of_first - block)
    }

    /// What it takes for so many samples, bytes.
    fn bytes(m: usize) -> u64 {
        let (blocks, left) = ((m / BITS) as u64, (m % BITS) as u64);
        // Whole blocks, and the last one, with a word a row; rows before it have one more for it.
        let whole = BITS as u64 * (blocks * (blocks + 1) / 2);
        let last = if left > 0 { BITS as u64 * blocks + left } else { 0 };
        (whole + last) * size_of::<u64>() as u64
    }

    /// The word of sample `i` that has the bit of sample `j`, which is no lower.
    #[inline(always)]
    fn word(&self, i: usize, j: usize) -> usize {
        debug_assert!(i <= j, "{i} {j}");
        self.row(i) + j / BITS - i / BITS
    }

    fn insert(&mut self, i: usize, j: usize) {
        let (i, j) = (i.min(j), i.max(j));
        let word = self.word(i, j);
        self.words[word] |= 1 << (j % BITS);
    }

    fn contains(&self, i: usize, j: usize) -> bool {
        let (i, j) = (i.min(j), i.max(j));
        self.words[self.word(i, j)] >> (j % BITS) & 1 == 1
    }
}

impl Visibility {
    /// What a plane lets be seen of a boundary; everything without a plane.
    pub fn new(boundary: &Boundary, plane: Option<&SupportingPlane>) -> Self {
        let inside = |plane: &SupportingPlane| inside_pairs(&plane.projected, boundary.loops());
        Self { seen: plane.map_or(Seen::Everything, |plane| Seen::Pairs(inside(plane))) }
    }

    /// Everything, as without a plane.
    pub(crate) fn everything() -> Self {
        Self { seen: Seen::Everything }
    }

    /// The pairs of samples of one loop whose rung leaves into the inside at both ends, but for those
    /// that rounding leaves open, which are among them: all that see one another, and few others
    /// unless the projection winds. Found in a fraction of the time, and only when it is asked for.
    pub(crate) fn at_ends(plane: &SupportingPlane) -> Self {
        Self { seen: Seen::AtEnds(plane.projected.clone(), OnceLock::new()) }
    }

    /// Who sees whom; nothing if everybody sees everybody.
    #[inline(always)]
    fn pairs(&self) -> Option<&PairSet> {
        match &self.seen {
            Seen::Everything => None,
            Seen::Pairs(pairs) => Some(pairs),
            Seen::AtEnds(polygon, pairs) => Some(pairs.get_or_init(|| pairs_at_ends(polygon))),
        }
    }

    /// What it takes for so many samples where not everything is seen, bytes.
    pub(crate) fn memory_needed(m: usize) -> u64 {
        PairSet::bytes(m)
    }

    /// What it takes once it is asked, bytes.
    pub(crate) fn bytes(&self) -> u64 {
        match &self.seen {
            Seen::Everything => 0,
            Seen::Pairs(pairs) => PairSet::bytes(pairs.samples),
            Seen::AtEnds(polygon, _) => PairSet::bytes(polygon.len()),
        }
    }

    /// Which of the 16 samples from `first` on, a multiple of 16, may be joined with sample `i`, a lower
    /// one: one bit each, the lowest for the first.
    #[inline(always)]
    pub(crate) fn allowed(&self, i: usize, first: usize) -> u16 {
        match self.pairs() {
            None => u16::MAX,
            Some(pairs) => (pairs.words[pairs.word(i, first)] >> (first % BITS)) as u16,
        }
    }

    /// What is seen between the members of a chain of `m`, as `sees` says of two of them, the lower
    /// first.
    pub(crate) fn of_pairs(m: usize, mut sees: impl FnMut(usize, usize) -> bool) -> Self {
        let mut pairs = PairSet::new(m);
        for j in 0..m {
            for i in 0..j {
                if sees(i, j) {
                    pairs.insert(i, j);
                }
            }
        }
        Self { seen: Seen::Pairs(pairs) }
    }

    /// What is seen between some of the samples, or, where that is still to be found out, on the
    /// loop of these samples.
    pub(crate) fn thinned(&self, kept: &[usize]) -> Self {
        let pairs = match &self.seen {
            Seen::Everything => return Self::everything(),
            Seen::Pairs(pairs) => pairs,
            Seen::AtEnds(polygon, _) => {
                let polygon = kept.iter().map(|&i| polygon[i]).collect();
                return Self { seen: Seen::AtEnds(polygon, OnceLock::new()) };
            }
        };
        let mut thinned = PairSet::new(kept.len());
        for (n, &i) in kept.iter().enumerate() {
            for (k, &j) in kept[..n].iter().enumerate() {
                if pairs.contains(i, j) {
                    thinned.insert(n, k);
                }
            }
        }
        Self { seen: Seen::Pairs(thinned) }
    }

    /// Whether samples `i` and `j`, which are no neighbours, may be joined.
    pub fn allows(&self, i: usize, j: usize) -> bool {
        self.pairs().is_none_or(|pairs| pairs.contains(i, j))
    }
}

/// The pairs that see one another inside polygons that do not touch, the outer one running
/// counter-clockwise and the holes clockwise, neighbours included.
fn inside_pairs(points: &[Point2], loops: &[Range<usize>]) -> PairSet {
    let view = Triangles::between(points, loops);
    let mut pairs = PairSet::new(points.len());
    for source in 0..points.len() {
        view.look_from(source, points, &mut |seen| pairs.insert(source, seen));
    }
    pairs
}

/// What rounding may make of the doubled area of a triangle, as a share of its two products: a
/// little more than the (3 + 16 ε) ε of \[Shewchuk1997\].
const ROUNDING: f64 = 4e-16;

/// The pairs of samples whose segment leaves into the inside at both ends, and those for which
/// rounding leaves that open.
fn pairs_at_ends(polygon: &[Point2]) -> PairSet {
    let blocks: Vec<Block> =
        (0..polygon.len()).step_by(BITS).map(|first| Block::new(polygon, first)).collect();
    let mut pairs = PairSet::new(polygon.len());
    let registers = pulp::Arch::new();
    for i in 0..polygon.len() {
        let row = pairs.row(i)..pairs.row(i + 1);
        let from = blocks[i / BITS].corner(i % BITS);
        let blocks = &blocks[i / BITS..];
        registers.dispatch(LookFrom { from, blocks, words: &mut pairs.words[row] });
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

/// As many corners in a row as a word has bits, by coordinates, so that many are looked at side by
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

/// Looks from one corner at the blocks that its row has words for. A type rather than a closure, so
/// that it is compiled for the widest registers.
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

/// A triangulation of the domain, for looking through.
struct Triangles {
    /// Corners of each triangle, counter-clockwise.
    corners: Vec<[usize; 3]>,
    /// The triangle beyond the side opposite to each corner.
    beyond: Vec<[Option<usize>; 3]>,
    /// The triangles at each sample.
    around: Vec<Vec<usize>>,
}

impl Triangles {
    fn between(points: &[Point2], loops: &[Range<usize>]) -> Self {
        // Coordinates too small for the crate only choose other triangles.
        let vertex = |p: &Point2| spade::mitigate_underflow(spade::Point2::new(p.x, p.y));
        let edges: Vec<[usize; 2]> = loops
            .iter()
            .flat_map(|l| l.clone().map(|i| [i, if i + 1 == l.end { l.start } else { i + 1 }]))
            .collect();
        let vertices = points.iter().map(vertex).collect();
        let none = Self { corners: vec![], beyond: vec![], around: vec![vec![]; points.len()] };
        // Nothing is seen of what is no domain; a boundary has passed the door and is one.
        let Ok(all) = ConstrainedDelaunayTriangulation::<spade::Point2<f64>>::try_bulk_load_cdt(
            vertices,
            edges.clone(),
            |_| {},
        ) else {
            return none;
        };
        if all.num_vertices() != points.len() {
            return none;
        }
        // The domain lies to the left of every edge of the boundary; from there it is flooded.
        let mut number = vec![None; all.num_all_faces()];
        let mut found = Vec::new();
        let mut reached: Vec<_> = edges
            .iter()
            .filter_map(|&[a, b]| {
                let handle = spade::handles::FixedVertexHandle::from_index;
                all.get_edge_from_neighbors(handle(a), handle(b))
            })
            .filter_map(|edge| edge.face().as_inner())
            .collect();
        while let Some(face) = reached.pop() {
            let place = &mut number[face.fix().index()];
            if place.is_some() {
                continue;
            }
            *place = Some(found.len());
            found.push(face);
            let inner = face.adjacent_edges().into_iter().filter(|e| !e.is_constraint_edge());
            reached.extend(inner.filter_map(|edge| edge.rev().face().as_inner()));
        }
        let corners: Vec<[usize; 3]> =
            found.iter().map(|face| face.vertices().map(|v| v.fix().index())).collect();
        let beyond = found
            .iter()
            .zip(&corners)
            .map(|(face, corners)| {
                let mut beyond = [None; 3];
                for edge in face.adjacent_edges().into_iter().filter(|e| !e.is_constraint_edge()) {
                    let ends = edge.vertices().map(|v| v.fix().index());
                    if let Some(n) = corners.iter().position(|c| !ends.contains(c)) {
                        beyond[n] = number[edge.rev().face().fix().index()];
                    }
                }
                beyond
            })
            .collect();
        let mut around = vec![Vec::new(); points.len()];
        for (t, corners) in corners.iter().enumerate() {
            for &corner in corners {
                around[corner].push(t);
            }
        }
        Self { corners, beyond, around }
    }

    fn look_from(&self, source: usize, polygon: &[Point2], see: &mut impl FnMut(usize)) {
        let eye = polygon[source];
        // (triangle to look into, side it is entered by, right and left end of the window)
        let mut views: Vec<(usize, [usize; 2], usize, usize)> = Vec::new();
        for &t in &self.around[source] {
            let n = self.corners[t].iter().position(|&c| c == source).unwrap_or(0);
            let (right, left) = (self.corners[t][(n + 1) % 3], self.corners[t][(n + 2) % 3]);
            see(right);
            see(left);
            if let Some(u) = self.beyond[t][n] {
                views.push((u, [right, left], right, left));
            }
        }
        while let Some((t, [side_right, side_left], right, left)) = views.pop() {
            let entered = |c: &usize| *c != side_right && *c != side_left;
            let Some(n) = self.corners[t].iter().position(entered) else { continue };
            let far = self.corners[t][n];
            let from_right = orientation(eye, polygon[right], polygon[far]);
            let from_left = orientation(eye, polygon[far], polygon[left]);
            let opposite = |corner: usize| {
                let k = self.corners[t].iter().position(|&c| c == corner).unwrap_or(0);
                self.beyond[t][k]
            };
            if from_right == Ordering::Greater && from_left == Ordering::Greater {
                see(far);
            }
            // Through the side from the right end to the far corner, which is opposite to the
            // left end: seen if the far corner lies to the left of the window's right edge.
            if from_right == Ordering::Greater
                && let Some(u) = opposite(side_left)
            {
                let new_left = if from_left == Ordering::Greater { far } else { left };
                views.push((u, [side_right, far], right, new_left));
            }
            if from_left == Ordering::Greater
                && let Some(u) = opposite(side_right)
            {
                let new_right = if from_right == Ordering::Greater { far } else { right };
                views.push((u, [far, side_left], new_right, left));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predicate::{first_crossing, segments_touch, signed_area_doubled};

    fn one_loop(polygon: &[Point2]) -> PairSet {
        inside_pairs(polygon, std::slice::from_ref(&(0..polygon.len())))
    }

    /// Seen or not by the definition: the rung leaves into the inside at both ends and touches no
    /// edge but at its ends.
    fn sees(polygon: &[Point2], i: usize, j: usize) -> bool {
        let m = polygon.len();
        let leaves_inside = |i: usize, j: usize| {
            let (a, b, c) = (polygon[(i + m - 1) % m], polygon[i], polygon[(i + 1) % m]);
            let to = polygon[j];
            let (left_in, left_out) =
                (orientation(a, b, to).is_gt(), orientation(b, c, to).is_gt());
            if orientation(a, b, c).is_gt() { left_in && left_out } else { left_in || left_out }
        };
        let touched = (0..m).any(|k| {
            let l = (k + 1) % m;
            ![k, l].contains(&i)
                && ![k, l].contains(&j)
                && segments_touch(polygon[i], polygon[j], polygon[k], polygon[l])
        });
        let through = (0..m).any(|k| {
            k != i && k != j && segments_touch(polygon[i], polygon[j], polygon[k], polygon[k])
        });
        leaves_inside(i, j) && leaves_inside(j, i) && !touched && !through
    }

    fn star_shaped(m: usize, seed: u64, grid: bool) -> Vec<Point2> {
        let mut state = seed;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as f64 / (1u64 << 31) as f64
        };
        (0..m)
            .map(|i| {
                let t = std::f64::consts::TAU * (i as f64 + 0.8 * random()) / m as f64;
                let r = 1.0 + 4.0 * random();
                let p = Point2::new(r * crate::math::cos(t), r * crate::math::sin(t));
                if grid { Point2::new(p.x.round(), p.y.round()) } else { p }
            })
            .collect()
    }

    #[test]
    fn what_is_seen_is_what_the_definition_says() {
        let mut tried = 0;
        let mut more = 0;
        for seed in 0..600 {
            // Some have rows of several words.
            let m = match seed {
                0 => 128,
                200 => 130,
                _ => 4 + (seed % 14) as usize,
            };
            let polygon = star_shaped(m, seed, seed % 2 == 1);
            if first_crossing(&polygon).is_some() || signed_area_doubled(&polygon) <= 0.0 {
                continue;
            }
            tried += 1;
            let pairs = one_loop(&polygon);
            let m = polygon.len();
            let at_ends = pairs_at_ends(&polygon);
            for i in 0..m {
                for j in i + 2..m {
                    if i == 0 && j == m - 1 {
                        continue;
                    }
                    assert!(at_ends.contains(i, j) || !pairs.contains(i, j), "{seed} {i} {j}");
                    more += usize::from(at_ends.contains(i, j) && !pairs.contains(i, j));
                    assert_eq!(pairs.contains(i, j), sees(&polygon, i, j), "{seed} {i} {j}");
                }
            }
        }
        assert!(tried > 300 && more > 0, "{tried} {more}");
    }

    #[test]
    fn every_pair_has_a_bit_of_its_own() {
        for m in [2, 63, 64, 65, 128, 150, 200] {
            let all = || (0..m).flat_map(move |j| (0..=j).map(move |i| (i, j)));
            let mut pairs = PairSet::new(m);
            for (n, (i, j)) in all().enumerate() {
                assert!(!pairs.contains(j, i), "{m}: {i} {j}");
                if n % 3 == 0 {
                    pairs.insert(j, i);
                }
            }
            for (n, (i, j)) in all().enumerate() {
                assert_eq!(pairs.contains(i, j), n % 3 == 0, "{m}: {i} {j}");
            }
            let of_rows = (0..m).map(|i| m.div_ceil(BITS) - i / BITS).sum::<usize>();
            assert_eq!(pairs.words.len(), of_rows, "{m}");
            assert_eq!(PairSet::bytes(m), 8 * of_rows as u64, "{m}");
        }
    }
}
