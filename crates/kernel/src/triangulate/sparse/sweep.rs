//! Which pairs of blocks can be joined in a triangulation up to a price: the table over blocks, from
//! short runs to long ones for the inner sides and back for the outer ones.

use super::super::{Terms, TriangulateError};
use super::blocks::{ANY, Blocks, Bundle, UNKNOWN};
use crate::cost::QUANTUM;
use crate::watch::Watch;
use std::ops::Range;

/// The pairs of blocks of a level that may be joined, by their first block, and the least that the
/// outer side of a rung between them costs.
pub(super) struct Alive {
    starts: Vec<usize>,
    to: Vec<u32>,
    outside: Vec<f32>,
    /// No rung between them costs less.
    least: Vec<f32>,
}

impl Alive {
    /// No pairs yet.
    pub(super) fn new() -> Self {
        Self { starts: vec![0], to: Vec::new(), outside: Vec::new(), least: Vec::new() }
    }

    /// Adds a pair to the row that is not ended yet.
    pub(super) fn push(&mut self, b: usize, outside: f32, least: f32) {
        self.to.push(b as u32);
        self.outside.push(outside);
        self.least.push(least);
    }

    pub(super) fn end_row(&mut self) {
        self.starts.push(self.to.len());
    }

    /// All pairs of n blocks.
    pub(super) fn all(n: usize) -> Self {
        let mut starts = vec![0];
        let mut to = Vec::new();
        for a in 0..n {
            to.extend((a + 2..n).map(|b| b as u32));
            starts.push(to.len());
        }
        let outside = vec![0.0; to.len()];
        Self { starts, to, least: outside.clone(), outside }
    }

    /// The pairs (a, b): b, and what no rung between them costs less than.
    pub(super) fn row(&self, a: usize) -> impl Iterator<Item = (usize, f32)> + '_ {
        let row = self.starts[a]..self.starts[a + 1];
        row.map(|at| (self.to[at] as usize, self.least[at]))
    }

    /// Whether the pair a < b is one of these or of neighbours.
    pub(super) fn contains(&self, a: usize, b: usize) -> bool {
        let row = &self.to[self.starts[a]..self.starts[a + 1]];
        b <= a + 1 || row.binary_search(&(b as u32)).is_ok()
    }

    /// The samples b > a + 1 of the blocks that sample a, in block `whole`, may be joined with, in
    /// increasing order, and the least that the outer side costs.
    pub(super) fn samples<'a>(
        &'a self,
        blocks: &'a Blocks,
        whole: usize,
        a: usize,
    ) -> impl Iterator<Item = (usize, f32)> + 'a {
        let row = self.starts[whole]..self.starts[whole + 1];
        let near = (whole..blocks.len().min(whole + 2)).map(|b| (b, 0.0));
        let far = row.map(|at| (self.to[at] as usize, self.outside[at]));
        near.chain(far)
            .flat_map(|(b, outside)| blocks.samples(b).map(move |b| (b, outside)))
            .filter(move |&(b, _)| b > a + 1)
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.to.len()
    }

    /// The pairs of blocks (a, b) of the level below that are parts of these, b in increasing order
    /// and neither a nor its neighbour: b, and the least that the outer side costs.
    pub(super) fn parts<'a>(
        &'a self,
        upper: &'a Blocks,
        whole: usize,
        a: usize,
    ) -> impl Iterator<Item = (usize, f32)> + 'a {
        let row = self.starts[whole]..self.starts[whole + 1];
        let near = (whole..upper.len().min(whole + 2)).map(|b| (b, 0.0));
        let far = row.map(|at| (self.to[at] as usize, self.outside[at]));
        near.chain(far)
            .flat_map(|(b, outside)| upper.parts(b).map(move |b| (b, outside)))
            .filter(move |&(b, _)| b > a + 1)
    }
}

/// Makes a number in f32 less by more than a few roundings.
const DOWN: f32 = 1.0 - 1e-6;
/// The same for more.
const UP: f32 = 1.0 + 1e-6;
/// What an entry takes, bytes, while the lists grow.
const BYTES_AN_ENTRY: usize = 3 * 32;

/// Entries that follow one another.
#[derive(Clone, Copy)]
struct Run {
    /// The second block of the first of them.
    first: usize,
    /// The place of the first.
    at: usize,
    len: usize,
}

/// Where the entries of rows stand.
#[derive(Default)]
pub(super) struct Rows {
    to: Vec<u32>,
    runs: Vec<Run>,
    entries: Vec<Range<usize>>,
    runs_of: Vec<Range<usize>>,
}

impl Rows {
    pub(super) fn new(n: usize) -> Self {
        Self { entries: vec![0..0; n], runs_of: vec![0..0; n], ..Self::default() }
    }

    pub(super) fn begin(&mut self, a: usize) {
        self.entries[a] = self.to.len()..self.to.len();
        self.runs_of[a] = self.runs.len()..self.runs.len();
    }

    /// Adds an entry to the row that was begun last.
    pub(super) fn push(&mut self, a: usize, b: usize) {
        let at = self.to.len();
        self.to.push(b as u32);
        self.entries[a].end = at + 1;
        if let Some(run) = self.runs[self.runs_of[a].clone()].last_mut()
            && run.first + run.len == b
        {
            run.len += 1;
        } else {
            self.runs.push(Run { first: b, at, len: 1 });
            self.runs_of[a].end += 1;
        }
    }

    fn runs(&self, a: usize) -> &[Run] {
        &self.runs[self.runs_of[a].clone()]
    }

    /// The places of the entries of a row.
    pub(super) fn entries(&self, a: usize) -> Range<usize> {
        self.entries[a].clone()
    }

    /// The second block of an entry.
    pub(super) fn second(&self, at: usize) -> usize {
        self.to[at] as usize
    }

    /// The places of the runs of a row.
    fn runs_of(&self, a: usize) -> Range<usize> {
        self.runs_of[a].clone()
    }

    /// The place of the entry (a, b).
    fn place(&self, a: usize, b: usize) -> Option<usize> {
        let row = self.entries[a].clone();
        self.to[row.clone()].binary_search(&(b as u32)).ok().map(|n| row.start + n)
    }
}

/// What is known of the rungs of a row, by their second block.
struct Normals {
    mean: [Vec<f32>; 3],
    radius: Vec<f32>,
}

impl Normals {
    fn new(n: usize) -> Self {
        Self { mean: [0, 1, 2].map(|_| vec![0.0; n]), radius: vec![UNKNOWN; n] }
    }

    fn set(&mut self, at: usize, bundle: &Bundle) {
        for axis in 0..3 {
            self.mean[axis][at] = bundle.mean[axis];
        }
        self.radius[at] = bundle.radius;
    }

    fn push(&mut self, bundle: &Bundle) {
        for axis in 0..3 {
            self.mean[axis].push(bundle.mean[axis]);
        }
        self.radius.push(bundle.radius);
    }

    fn at(&self, at: usize) -> Cone {
        Cone { mean: [0, 1, 2].map(|axis| self.mean[axis][at]), radius: self.radius[at] }
    }

    #[inline(always)]
    fn slices(&self, range: Range<usize>) -> ([&[f32]; 3], &[f32]) {
        ([0, 1, 2].map(|axis| &self.mean[axis][range.clone()]), &self.radius[range])
    }
}

#[derive(Clone, Copy)]
struct Cone {
    mean: [f32; 3],
    radius: f32,
}

/// The square of the least distance between two normals.
#[inline(always)]
fn apart(a: [f32; 3], a_radius: f32, b: [f32; 3], b_radius: f32) -> f32 {
    let d = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt() - a_radius - b_radius;
    let length = if length > 0.0 { length } else { 0.0 };
    length * length
}

/// The table over blocks, with only the pairs that matter.
pub(super) struct Sweep {
    n: usize,
    rows: Rows,
    least: Vec<f32>,
    inside: Vec<f32>,
    outside: Vec<f32>,
    normals: Normals,
    /// A sixth of the weight of folds.
    sixth: f32,
    limit: f32,
    /// What outer sides may have been rounded up, as a share and in all.
    rounding: [f32; 2],
}

/// What rounding may add to a sum in f32 over n of m samples' blocks, as a share, and what the
/// quantum may.
fn rounding(n: usize, m: usize) -> [f64; 2] {
    // Each price is a sum of terms that are not negative, at most 2 n deep, and every sum rounds by
    // 2⁻²⁴; folds and twists are rounded to the quantum. Sums of one level are added to those of
    // the next.
    [(n as f64 + 64.0) / f64::from(1u32 << 22), 4.0 * m as f64 * QUANTUM]
}

impl Sweep {
    /// Works out the least price of the inner side of every pair, short runs first; `None` if no
    /// triangulation is as cheap as `bound`, or if it takes more than `memory`.
    pub(super) fn inside(
        terms: &Terms<'_>,
        blocks: &Blocks,
        upper: Option<&Blocks>,
        alive: &Alive,
        bound: f64,
        memory: u64,
        watch: &mut dyn Watch,
    ) -> Result<Option<Self>, TriangulateError> {
        let n = blocks.len();
        let fold = if terms.folds() { terms.prices.options().fold } else { 0.0 };
        let [share, in_all] = rounding(n, terms.prices.len());
        let mut sweep = Self {
            n,
            rows: Rows::new(n),
            least: Vec::new(),
            inside: Vec::new(),
            outside: Vec::new(),
            normals: Normals::new(0),
            sixth: (fold / 6.0) as f32 * DOWN,
            limit: ((bound + in_all) * (1.0 + share)) as f32 * UP,
            rounding: [share as f32, in_all as f32],
        };
        let mut best = vec![0.0; n];
        let mut own = Normals::new(n);
        let registers = pulp::Arch::new();
        let mut whole = upper.map_or(1, Blocks::len) - 1;
        let mut list: Vec<(usize, f32, Bundle)> = Vec::new();
        for a in (0..n - 1).rev() {
            if a % 64 == 0 && watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            list.clear();
            let mut price = |b: usize, outside: f32| {
                if a == 0 && b + 1 == n {
                    list.push((b, 0.0, ANY));
                } else if let Some(bundle) = blocks.bundle(terms, a, b, bound) {
                    list.push((b, outside, bundle));
                }
            };
            match upper {
                Some(upper) => {
                    while upper.parts(whole).start > a {
                        whole -= 1;
                    }
                    alive.parts(upper, whole, a).for_each(|(b, outside)| price(b, outside));
                }
                None => (a + 2..n).for_each(|b| price(b, 0.0)),
            }
            registers.dispatch(
                #[inline(always)]
                || sweep.row(a, &list, &mut best, &mut own),
            );
            if (sweep.rows.to.len() * BYTES_AN_ENTRY) as u64 > memory {
                return Ok(None);
            }
        }
        if n > 2 && sweep.rows.place(0, n - 1).is_none() {
            return Ok(None);
        }
        Ok(Some(sweep))
    }

    #[inline(always)]
    fn row(
        &mut self,
        a: usize,
        list: &[(usize, f32, Bundle)],
        best: &mut [f32],
        own: &mut Normals,
    ) {
        for (b, _, bundle) in list {
            best[*b] = f32::INFINITY;
            own.set(*b, bundle);
        }
        self.rows.begin(a);
        self.keep(a, a + 1, &ANY, 0.0);
        self.look_over(a + 1, 0.0, ANY, best, own);
        for &(b, outside, bundle) in list {
            // Rounded down.
            let least = bundle.least as f32 * DOWN;
            let price = best[b] + least;
            if price + outside <= self.limit {
                let bundle = Bundle { least: f64::from(least), ..bundle };
                self.keep(a, b, &bundle, price);
                self.look_over(b, price, bundle, best, own);
            }
        }
    }

    #[inline(always)]
    fn keep(&mut self, a: usize, b: usize, bundle: &Bundle, inside: f32) {
        self.rows.push(a, b);
        self.least.push(bundle.least as f32);
        self.inside.push(inside);
        self.normals.push(bundle);
    }

    /// Looks at all triangles over the pair (a, c), of this price, and the pairs (c, b).
    #[inline(always)]
    fn look_over(&self, c: usize, price: f32, bundle: Bundle, best: &mut [f32], own: &Normals) {
        if c + 1 >= self.n {
            return;
        }
        for &Run { first, at, len } in self.rows.runs(c) {
            let best = &mut best[first..first + len];
            let inside = &self.inside[at..at + len];
            if self.sixth == 0.0 {
                for n in 0..len {
                    let sum = price + inside[n];
                    best[n] = if sum < best[n] { sum } else { best[n] };
                }
                continue;
            }
            let ([sx, sy, sz], s) = own.slices(first..first + len);
            let ([cx, cy, cz], c) = self.normals.slices(at..at + len);
            let (mean, radius) = (bundle.mean, bundle.radius);
            for n in 0..len {
                let (x, y) = ([sx[n], sy[n], sz[n]], [cx[n], cy[n], cz[n]]);
                let folds = apart(x, s[n], y, c[n])
                    + apart(x, s[n], mean, radius)
                    + apart(y, c[n], mean, radius);
                let sum = price + inside[n] + self.sixth * folds;
                best[n] = if sum < best[n] { sum } else { best[n] };
            }
        }
    }

    /// Works out the least price of the outer side of every pair, long runs first, and which pairs
    /// may be joined.
    pub(super) fn outside(mut self, watch: &mut dyn Watch) -> Result<Alive, TriangulateError> {
        let n = self.n;
        self.outside = vec![f32::INFINITY; self.inside.len()];
        if let Some(root) = self.rows.place(0, n - 1) {
            self.outside[root] = 0.0;
        }
        let mut alive = Alive::new();
        let mut parents = vec![f32::INFINITY; n];
        let mut own = Normals::new(n);
        let mut under = vec![0.0; n];
        let registers = pulp::Arch::new();
        for a in 0..n {
            if a % 64 == 0 && watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            let row = self.rows.entries[a].clone();
            let first = alive.to.len();
            for at in row.clone().rev() {
                let c = self.rows.to[at] as usize;
                let outside = registers.dispatch(
                    #[inline(always)]
                    || self.look_under(at, c, &parents, &own, &mut under),
                );
                self.outside[at] = outside;
                if outside + self.inside[at] <= self.limit {
                    let cone = self.normals.at(at);
                    parents[c] = outside + self.least[at];
                    own.set(c, &Bundle { least: 0.0, mean: cone.mean, radius: cone.radius });
                    if c > a + 1 {
                        let [share, in_all] = self.rounding;
                        let sound = (outside * (1.0 - share) - in_all).max(0.0) * DOWN;
                        alive.push(c, sound, self.least[at]);
                    }
                }
            }
            alive.to[first..].reverse();
            alive.outside[first..].reverse();
            alive.least[first..].reverse();
            alive.end_row();
            for at in row {
                parents[self.rows.to[at] as usize] = f32::INFINITY;
            }
        }
        Ok(alive)
    }

    /// The least price of the outer side of the pair at `at`, with the second block c, under all
    /// pairs (a, b); and what those mean for the pairs (c, b). `under` is for intermediate results.
    #[inline(always)]
    fn look_under(
        &mut self,
        at: usize,
        c: usize,
        parents: &[f32],
        own: &Normals,
        under: &mut [f32],
    ) -> f32 {
        let mut outside = self.outside[at];
        let price = self.inside[at];
        let Cone { mean, radius } = self.normals.at(at);
        let sixth = self.sixth;
        for run in self.rows.runs_of(c) {
            let Run { first, at, len } = self.rows.runs[run];
            let parents = &parents[first..first + len];
            let inside = &self.inside[at..at + len];
            let under = &mut under[..len];
            if sixth == 0.0 {
                under.copy_from_slice(parents);
            } else {
                let ([sx, sy, sz], s) = own.slices(first..first + len);
                let ([cx, cy, cz], r) = self.normals.slices(at..at + len);
                for n in 0..len {
                    let (x, y) = ([sx[n], sy[n], sz[n]], [cx[n], cy[n], cz[n]]);
                    let folds = apart(x, s[n], y, r[n])
                        + apart(x, s[n], mean, radius)
                        + apart(y, r[n], mean, radius);
                    under[n] = parents[n] + sixth * folds;
                }
            }
            let beside = &mut self.outside[at..at + len];
            for n in 0..len {
                let sum = under[n] + price;
                beside[n] = if sum < beside[n] { sum } else { beside[n] };
            }
            let mut least = [f32::INFINITY; 8];
            let (under, under_rest) = under.as_chunks::<8>();
            let (inside, inside_rest) = inside.as_chunks::<8>();
            for (x, y) in under.iter().zip(inside) {
                for n in 0..8 {
                    let sum = x[n] + y[n];
                    least[n] = if sum < least[n] { sum } else { least[n] };
                }
            }
            for (x, y) in under_rest.iter().zip(inside_rest) {
                outside = outside.min(x + y);
            }
            outside = least.into_iter().fold(outside, f32::min);
        }
        outside
    }
}
