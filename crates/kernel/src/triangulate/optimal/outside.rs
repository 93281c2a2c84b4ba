//! What the rest of the loop costs at the least beside a rung: found from long rungs to short ones.
//!
//! The table goes from short rungs to long ones, and keeps what costs little by itself. Short rungs
//! do so wherever they lie: the planes of one are near to the osculating plane of the boundary
//! there. But a triangle beyond it leans away from that plane, and its folds cost more than the
//! whole surface does. The table can't know that; it shows on the way down.
//!
//! 1. Each rung or edge ⟨a,b⟩ of a triangulation is a side of a triangle that lies beyond it. The
//!    side of that which spans the others, the *parent*, is ⟨a,j⟩ with j > b or ⟨i,b⟩ with i < a.
//!    What lies outside of ⟨a,b⟩ is that triangle, its parent, what lies outside of the parent, and
//!    the part below the third side, which costs no less than the third side alone. So the rest of
//!    the loop costs no less than
//!    O(a,b) = min over j of O(a,j) + w(a,j) + F(a,b,j) + w(b,j), and the same over i,
//!    with O = 0 for the edge ⟨0, m−1⟩.
//! 2. With a bound U on the price, only rungs with O + w ≤ U are part of the answer, and only
//!    entries E ≤ U − O of the table. O is an exact sum of prices, as E is, so that ties are kept.
//! 3. Rows of tiles are gone through from the first to the last, those of a row from right to left,
//!    rows of a tile downwards, and all sides ⟨i,k⟩ with k in the tile's own columns from right to
//!    left: then all parents of a rung come before it. O + w never falls from a parent on, so that
//!    what is left of a tile is known before its own rungs are parents. What a triangle i, k, j
//!    says of its sides ⟨i,k⟩ and ⟨k,j⟩ is worked out for 16 j side by side, as in the table. Tiles
//!    are priced when they are first looked at, which most are not.
//!
//! On the cone of 1,600 and of 10,000 samples 396 and 2,921 tiles are left, a half and about a
//! fifth of those that the table keeps without. Far from a developable surface many triangles are
//! cheap, and to look at them takes longer than to fill the table; so it is given up where they are
//! many.

use super::lanes::{are_fused, lowest, of_lane};
use super::open::Open;
use super::store::{Store, Tile};
use super::table::Table;
use crate::cost::{Aligned, Fan, Fans, FarEnds, LANES, Lanes, QUANTUM, Strip};
use crate::triangulate::TriangulateError;
use crate::watch::Watch;
use std::ops::Range;

/// Looks, each at the triangles i, k, j of one side ⟨i,k⟩ and 16 j, at the most for each tile that may
/// have cheap rungs, in the mean, on one thread. On the cone they are 44 at 1,563 samples and 205 at
/// 100,000; on the wavy loop, where the table alone takes less time, 281 at 1,600 and 640 at 10,000.
const MOST_LOOKS: usize = 400;
/// The same where no thinned loop has shown that it is worth it.
const MOST_LOOKS_AT_FIRST: usize = 150;
/// It is worth it where no larger a share of those tiles is left on the first loop that it is tried on. On
/// the cone it is a quarter at 1,563 samples; on the cylinder patch, where the table alone takes less time,
/// more than this up to 10,000.
const MOST_LEFT: f64 = 0.35;

/// What it may take to work O out.
pub(super) struct Limits {
    /// U.
    pub(super) bound: f64,
    /// Looks for each tile that may have cheap rungs, see [`MOST_LOOKS`].
    looks: usize,
    /// The share of those tiles that may be left.
    left: f64,
    /// Bytes, half of which may be taken for longer.
    memory: u64,
}

impl Limits {
    /// `is_sure` says that it was worth it for the thinned loop.
    pub(super) fn new(bound: f64, is_sure: bool, memory: u64) -> Self {
        let (looks, left) =
            if is_sure { (MOST_LOOKS, f64::INFINITY) } else { (MOST_LOOKS_AT_FIRST, MOST_LEFT) };
        Self { bound, looks, left, memory }
    }
}

/// No tile, and one that was priced and has no cheap rung.
const NONE: u32 = u32::MAX;
const EMPTY: u32 = u32::MAX - 1;

/// What is known of a tile.
#[derive(Clone, Copy)]
struct Place {
    /// No rung of it costs less.
    least: f32,
    /// Which of those that are priced it is, [`NONE`] or [`EMPTY`].
    priced: u32,
    /// Which of those with finite O it is, or [`NONE`].
    reached: u32,
}

/// O of the rungs of a tile.
struct Reached {
    rows: Box<Aligned<[Lanes; LANES]>>,
    /// Whether O + w is within the bound for any of them.
    is_left: bool,
}

/// O for the rungs that may belong to a triangulation up to a bound.
pub(super) struct Outside {
    bound: f64,
    places: Vec<Place>,
    /// The prices of rungs, up to the bound, and N, while O is worked out.
    priced: Vec<Tile>,
    reached: Vec<Reached>,
    /// The columns of the tiles of a row that may have cheap rungs, in increasing order.
    beside: Vec<Vec<u32>>,
    open: usize,
    looks: usize,
}

impl Outside {
    /// What it takes before any tile is priced, bytes.
    fn least_bytes(count: usize) -> u64 {
        Store::slots(count) as u64 * size_of::<Place>() as u64
    }

    /// What it takes, bytes.
    pub(super) fn bytes(&self) -> u64 {
        // Lists may have grown by doubling.
        let reached = size_of::<Reached>() + size_of::<Aligned<[Lanes; LANES]>>();
        Self::least_bytes(self.beside.len())
            + 2 * self.open as u64 * size_of::<u32>() as u64
            + self.reached.len() as u64 * reached as u64
            + self.priced.len() as u64 * Tile::bytes(true)
    }

    /// Works it out for a table; `None` where that takes more than it may, or leaves too much.
    pub(super) fn new(
        table: &Table<'_>,
        open: &Open<'_>,
        limits: Limits,
        watch: &mut dyn Watch,
    ) -> Result<Option<Self>, TriangulateError> {
        let count = table.m.div_ceil(LANES);
        if Self::least_bytes(count) > limits.memory {
            return Ok(None);
        }
        let mut outside = Self::unknown(count, open, limits.bound, watch)?;
        if !outside.work_out(table, &limits, watch)? {
            return Ok(None);
        }
        outside.priced = Vec::new();
        let left = outside.reached.iter().filter(|tile| tile.is_left).count();
        let is_worth_it = left as f64 <= limits.left * outside.open as f64;
        // Half of the memory is for the table.
        Ok((is_worth_it && outside.bytes() <= limits.memory / 2).then_some(outside))
    }

    /// Where spans leave the price of rungs below the bound, and no more.
    fn unknown(
        count: usize,
        open: &Open<'_>,
        bound: f64,
        watch: &mut dyn Watch,
    ) -> Result<Self, TriangulateError> {
        let nowhere = Place { least: f32::INFINITY, priced: NONE, reached: NONE };
        let mut outside = Self {
            bound,
            places: vec![nowhere; Store::slots(count)],
            priced: Vec::new(),
            reached: Vec::new(),
            beside: vec![Vec::new(); count],
            open: 0,
            looks: 0,
        };
        for column in 0..count {
            if watch.stop() {
                return Err(TriangulateError::Stopped);
            }
            for row in 0..=column {
                let least = open.least(row, column);
                if least > bound {
                    continue;
                }
                // Rounded down.
                let least = if least > 0.0 { (least as f32).next_down() } else { 0.0 };
                outside.places[Store::slot(row, column)].least = least;
                outside.beside[row].push(column as u32);
                outside.open += 1;
            }
        }
        Ok(outside)
    }

    /// Goes through all tiles; returns whether that took no more than it may.
    fn work_out(
        &mut self,
        table: &Table<'_>,
        limits: &Limits,
        watch: &mut dyn Watch,
    ) -> Result<bool, TriangulateError> {
        let count = self.beside.len();
        let ends: Vec<FarEnds> =
            (0..count).map(|at| table.terms.prices.far_ends(at * LANES)).collect();
        let most = self.open.saturating_mul(limits.looks);
        let root = self.reached_at(0, count - 1);
        self.reached[root].rows[0][(table.m - 1) % LANES] = 0.0;
        self.price(table, &ends, 0, count - 1);
        let mut between = Vec::new();
        for row in 0..count {
            // Rows have as many tiles as there are rows below.
            let below = (count - row) as f64 / count as f64;
            watch.progress(1.0 - below * below);
            self.price(table, &ends, row, row);
            for at in (0..self.beside[row].len()).rev() {
                let column = self.beside[row][at] as usize;
                let Some(least) = self.least_through(row, column) else { continue };
                if watch.stop() {
                    return Err(TriangulateError::Stopped);
                }
                self.price(table, &ends, column, column);
                self.find_between(table, &ends, (row, column), least, &mut between);
                let (to, between) = (&ends[column], &*between);
                let outside = &mut *self;
                table.registers.dispatch(Lowering { outside, table, row, column, to, between });
                if self.looks > most || self.bytes() > limits.memory {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    /// O of the rungs from sample `i` to those of a column of tiles; `None` if no rung of the tile is
    /// part of the answer.
    #[inline(always)]
    pub(super) fn row(&self, i: usize, column: usize) -> Option<&Lanes> {
        let at = self.places[Store::slot(i / LANES, column)].reached;
        (at != NONE).then(|| &self.reached[at as usize].rows[i % LANES])
    }

    /// Whether some rungs of a tile may be part of the answer.
    pub(super) fn has(&self, row: usize, column: usize) -> bool {
        let at = self.places[Store::slot(row, column)].reached;
        at != NONE && self.reached[at as usize].is_left
    }

    /// The number of a tile among those with finite O.
    #[inline(always)]
    fn reached_at(&mut self, row: usize, column: usize) -> usize {
        let place = &mut self.places[Store::slot(row, column)];
        if place.reached == NONE {
            place.reached = self.reached.len() as u32;
            let rows = Box::new(Aligned([[f64::INFINITY; LANES]; LANES]));
            self.reached.push(Reached { rows, is_left: false });
        }
        place.reached as usize
    }

    /// The number of a tile among those that are priced, if it is and has cheap rungs.
    #[inline(always)]
    fn priced_at(&self, row: usize, column: usize) -> Option<usize> {
        let at = self.places[Store::slot(row, column)].priced;
        (at < EMPTY).then_some(at as usize)
    }

    /// Prices a tile, unless it is priced; returns its least price if it has cheap rungs.
    fn price(
        &mut self,
        table: &Table<'_>,
        ends: &[FarEnds],
        row: usize,
        column: usize,
    ) -> Option<f64> {
        let slot = Store::slot(row, column);
        if self.places[slot].priced == NONE {
            let (bound, to, mut tile) = (self.bound, &ends[column], Tile::new(true));
            table.registers.dispatch(Pricing { table, bound, row, to, tile: &mut tile });
            self.places[slot].priced = if tile.is_empty() {
                EMPTY
            } else {
                self.priced.push(tile);
                self.priced.len() as u32 - 1
            };
        }
        self.priced_at(row, column).map(|at| lowest(&self.priced[at].sums.least))
    }

    /// The least O + w of a tile, if that is within the bound; notes that it is.
    fn least_through(&mut self, row: usize, column: usize) -> Option<f64> {
        let place = self.places[Store::slot(row, column)];
        let own = self.priced_at(row, column)?;
        let reached = self.reached.get_mut(place.reached as usize)?;
        let mut least = f64::INFINITY;
        for (rests, prices) in reached.rows.iter().zip(self.priced[own].sums.entries.iter()) {
            let mut through = *rests;
            for n in 0..LANES {
                through[n] += prices[n];
            }
            least = least.min(lowest(&through));
        }
        reached.is_left = least <= self.bound;
        reached.is_left.then_some(least)
    }

    /// Finds the columns that third corners of triangles on the rungs of a tile may lie in, before its
    /// own, and prices the tiles of their other sides.
    fn find_between(
        &mut self,
        table: &Table<'_>,
        ends: &[FarEnds],
        (row, column): (usize, usize),
        least: f64,
        between: &mut Vec<usize>,
    ) {
        between.clear();
        for at in 0..self.beside[row].len() {
            let middle = self.beside[row][at] as usize;
            if middle >= column {
                break;
            }
            let sides = [(row, middle), (middle, column)];
            let of_sides = sides.map(|(a, b)| f64::from(self.places[Store::slot(a, b)].least));
            if least + of_sides[0] + of_sides[1] > self.bound {
                continue;
            }
            let of_sides = sides.map(|(a, b)| self.price(table, ends, a, b));
            if let [Some(a), Some(b)] = of_sides
                && least + a + b <= self.bound
            {
                between.push(middle);
            }
        }
    }

    /// Says of the sides of all triangles on the rungs of a tile what lies outside of them.
    #[inline(always)]
    fn lower<const FUSED: bool>(
        &mut self,
        table: &Table<'_>,
        (row, column): (usize, usize),
        to: &FarEnds,
        between: &[usize],
    ) {
        let Some(own) = self.priced_at(row, column) else { return };
        let reached = self.reached_at(row, column);
        let rows = row * LANES..table.m.min((row + 1) * LANES);
        let none = Aligned([[0.0; LANES]; 3]);
        for i in rows.clone() {
            let r = i - rows.start;
            let mut through = Aligned([0.0; LANES]);
            for n in 0..LANES {
                through[n] = self.reached[reached].rows[r][n] + self.priced[own].sums.entries[r][n];
            }
            if lowest(&through) > self.bound {
                continue;
            }
            let across = self.priced[own].means_from(i).copied().map_or(none, Aligned);
            let offsets = table.terms.prices.offsets(i, to);
            let mut parents =
                Parents { i, to, fans: table.terms.prices.fans(&offsets, &across), through };
            // Sides that end in the tile itself are parents in turn.
            for k in (to.first.max(i + 1)..to.first + LANES - 1).rev() {
                self.look::<FUSED>(table, &parents, k);
                let n = k - to.first;
                parents.through[n] =
                    self.reached[reached].rows[r][n] + self.priced[own].sums.entries[r][n];
            }
            let least = lowest(&parents.through);
            for &middle in between {
                let sides = (self.priced_at(row, middle), self.priced_at(middle, column));
                let (Some(first), Some(second)) = sides else { continue };
                let entries = &self.priced[first].sums.entries[r];
                let mut left = 0u32;
                for n in 0..LANES {
                    let of_sides = entries[n] + self.priced[second].sums.least[n];
                    left |= u32::from(least + of_sides <= self.bound) << n;
                }
                while left != 0 {
                    let k = middle * LANES + left.trailing_zeros() as usize;
                    left &= left - 1;
                    self.look::<FUSED>(table, &parents, k);
                }
            }
        }
    }

    /// Says of the sides ⟨i,k⟩ and ⟨k,j⟩ of the triangles i, k, j of one k and all j what lies outside of
    /// them.
    #[inline(always)]
    fn look<const FUSED: bool>(&mut self, table: &Table<'_>, parents: &Parents<'_>, k: usize) {
        let (i, row, middle, column) =
            (parents.i, parents.i / LANES, k / LANES, parents.to.first / LANES);
        let sides = (self.priced_at(row, middle), self.priced_at(middle, column));
        let (Some(first), Some(second)) = sides else { return };
        let (r, n) = (i % LANES, k % LANES);
        let (first, second) = (&self.priced[first], &self.priced[second]);
        let (entry, entries) = (first.sums.entries[r][n], &second.sums.entries[n]);
        let before = self.row(i, middle).map_or(f64::INFINITY, |row| row[n]);
        let mut rests = self.row(k, column).copied().unwrap_or([f64::INFINITY; LANES]);
        let mut left = [0.0; LANES];
        let mut any = false;
        for lane in 0..LANES {
            let through = parents.through[lane];
            let sum = through + entry + entries[lane];
            let is_lower = (through + entry < rests[lane]) | (through + entries[lane] < before);
            let is_worth = (sum <= self.bound) & is_lower;
            left[lane] = if is_worth { self.bound - sum + QUANTUM } else { 0.0 };
            any |= is_worth;
        }
        if !any {
            return;
        }
        self.looks += 1;
        let (Some(from_i), Some(beyond)) = (first.means_from(i), second.means_from(k)) else {
            return;
        };
        let fan = Fan { side: table.terms.prices.offset(i, k), shared: of_lane(from_i, n), beyond };
        let rungs = table.rungs_of_fan(i, k, parents.to);
        if !parents.fans.may_be_below::<FUSED>(&fan, rungs.least(), &left) {
            return;
        }
        let folds = parents.fans.prices(&fan, rungs);
        let mut of_side = [f64::INFINITY; LANES];
        for lane in 0..LANES {
            let is_within = folds[lane] < left[lane];
            let price = parents.through[lane] + folds[lane];
            let rest = price + entry;
            rests[lane] = if is_within & (rest < rests[lane]) { rest } else { rests[lane] };
            of_side[lane] = if is_within { price + entries[lane] } else { f64::INFINITY };
        }
        let of_side = lowest(&of_side);
        if of_side < f64::INFINITY {
            let beyond = self.reached_at(middle, column);
            self.reached[beyond].rows[n] = rests;
            let own = self.reached_at(row, middle);
            let rest = &mut self.reached[own].rows[r][n];
            *rest = if of_side < *rest { of_side } else { *rest };
        }
    }
}

/// The rungs from sample i to those of a tile, as parents.
struct Parents<'a> {
    i: usize,
    to: &'a FarEnds,
    fans: Fans<'a>,
    /// O + w of each.
    through: Aligned<Lanes>,
}

/// A tile to be priced. A type rather than a closure, as that of the table.
struct Pricing<'a> {
    table: &'a Table<'a>,
    bound: f64,
    row: usize,
    to: &'a FarEnds,
    tile: &'a mut Tile,
}

impl pulp::WithSimd for Pricing<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { table, bound, row, to, tile } = self;
        let rows: Range<usize> = row * LANES..table.m.min((row + 1) * LANES);
        let mut strip = Strip::BLANK;
        for i in rows.clone() {
            table.terms.strip::<true>(i, to, bound, &mut strip);
            for price in strip.prices.iter_mut() {
                *price = if *price <= bound { *price } else { f64::INFINITY };
            }
            let r = i - rows.start;
            tile.sums.entries[r] = *strip.prices;
            tile.sums.least[r] = lowest(&strip.prices);
            if let Some(means) = &mut tile.means {
                means.rows[r] = *strip.means;
            }
        }
    }
}

/// A tile whose rungs are the parents of others.
struct Lowering<'a> {
    outside: &'a mut Outside,
    table: &'a Table<'a>,
    row: usize,
    column: usize,
    to: &'a FarEnds,
    between: &'a [usize],
}

impl pulp::WithSimd for Lowering<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { outside, table, row, column, to, between } = self;
        if are_fused::<S>() {
            outside.lower::<true>(table, (row, column), to, between);
        } else {
            outside.lower::<false>(table, (row, column), to, between);
        }
    }
}

#[cfg(test)]
mod tests;
