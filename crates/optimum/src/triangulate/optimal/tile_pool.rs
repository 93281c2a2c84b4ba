//! The tiles of a table: those that have finite entries.
//!
//! Where a stretch of the boundary lies in a plane, all of its rungs are free, and so is whatever
//! is put together of them: entries of zero that say nothing, as many as the pairs of its samples.
//! Tiles that have no other entries and, where folds cost something, the same bits of N throughout
//! are kept once for each N. In planes along the axes N has the same bits, in others it may differ
//! in the last ones.

use crate::cost::{Aligned, LANES, Lanes};
use std::collections::BTreeMap;

/// [`LANES`] rows by as many columns of the table. A row holds E(k,j) of one k and all j.
pub(super) struct Tile {
    pub(super) sums: Box<Sums>,
    /// N in the same order, by axis; `None` when folds cost nothing.
    pub(super) means: Option<Box<Means>>,
}

pub(super) struct Sums {
    pub(super) entries: Aligned<[Lanes; LANES]>,
    /// The least entry of each row.
    pub(super) least: Aligned<Lanes>,
}

pub(super) type Means = Aligned<[[Lanes; 3]; LANES]>;

impl Tile {
    /// Memory of a tile, bytes, with or without N.
    pub(super) fn bytes(folds: bool) -> u64 {
        // It stands in a list that may have grown by doubling.
        let means = if folds { size_of::<Means>() } else { 0 };
        (2 * size_of::<Self>() + size_of::<Sums>() + means) as u64
    }

    /// A tile without finite entries.
    pub(super) fn new(folds: bool) -> Self {
        let none = [f64::INFINITY; LANES];
        let means = || Box::new(Aligned([[[0.0; LANES]; 3]; LANES]));
        Self {
            sums: Box::new(Sums { entries: Aligned([none; LANES]), least: Aligned(none) }),
            means: folds.then(means),
        }
    }

    /// N of the rungs from sample `i`; `None` when folds cost nothing.
    #[inline(always)]
    pub(super) fn means_from(&self, i: usize) -> Option<&[Lanes; 3]> {
        self.means.as_ref().map(|means| &means[i % LANES])
    }

    /// Whether all entries are infinite.
    pub(super) fn is_empty(&self) -> bool {
        *self.sums.least == [f64::INFINITY; LANES]
    }

    /// N, if it is the same for all rungs and all entries are zero; zero where none is stored.
    fn flat_mean(&self) -> Option<[f64; 3]> {
        // The least first, which decide for most tiles.
        let mut sums = self.sums.least.iter().chain(self.sums.entries.as_flattened());
        if sums.any(|&sum| sum != 0.0) {
            return None;
        }
        let Some(rows) = self.means.as_deref() else { return Some([0.0; 3]) };
        let mean = [0, 1, 2].map(|axis| rows[0][axis][0]);
        let is_one = |row: &[Lanes; 3]| (0..3).all(|axis| row[axis] == [mean[axis]; LANES]);
        rows.iter().all(is_one).then_some(mean)
    }
}

/// Upper bound on the memory of a store of so many rows of tiles and as many columns, bytes: each
/// tile has finite entries and N.
pub(super) fn most_bytes(count: usize) -> u64 {
    least_bytes(count) + TilePool::slots(count) as u64 * (PLACE_BYTES + Tile::bytes(true))
}

/// Lower bound on the memory of a store of so many rows of tiles and as many columns, bytes: the
/// places of tiles, none of which has finite entries.
pub(super) fn least_bytes(count: usize) -> u64 {
    TilePool::slots(count) as u64 * size_of::<u32>() as u64
}

/// Memory of a tile's entry in the list of columns, which may have grown by doubling, bytes.
const PLACE_BYTES: u64 = 2 * size_of::<u32>() as u64;
/// No tile.
const NONE: u32 = u32::MAX;

/// The tiles with finite entries, on and above the diagonal.
pub(super) struct TilePool {
    folds: bool,
    tiles: Vec<Tile>,
    /// The number of the tile at each place, or [`NONE`].
    places: Vec<u32>,
    /// How many places have a tile.
    taken: usize,
    /// Flat tiles, which may stand in many places, by the bits of their N.
    flat: BTreeMap<[u64; 3], u32>,
    /// The columns of the tiles beside one another, in increasing order.
    beside: Vec<Vec<u32>>,
    /// Tiles that were filled and have no finite entries.
    spare: Vec<Tile>,
}

impl TilePool {
    /// Where the tile of these rows and columns stands: the tiles of as many columns follow one
    /// another, from the first row down to the diagonal.
    #[inline(always)]
    pub(super) fn slot(row: usize, column: usize) -> usize {
        column * (column + 1) / 2 + row
    }

    /// How many tiles so many rows of them and as many columns have.
    pub(super) fn slots(count: usize) -> usize {
        Self::slot(0, count)
    }

    /// For so many rows of tiles and as many columns, with or without N.
    pub(super) fn new(count: usize, folds: bool) -> Self {
        Self {
            folds,
            tiles: Vec::new(),
            places: vec![NONE; TilePool::slots(count)],
            taken: 0,
            flat: BTreeMap::new(),
            beside: vec![Vec::new(); count],
            spare: Vec::new(),
        }
    }

    /// A tile to be filled, without finite entries.
    pub(super) fn fresh(&mut self) -> Tile {
        self.spare.pop().unwrap_or_else(|| Tile::new(self.folds))
    }

    /// What it takes, bytes.
    pub(super) fn bytes(&self) -> u64 {
        let places = least_bytes(self.beside.len()) + self.taken as u64 * PLACE_BYTES;
        places + self.tiles.len() as u64 * Tile::bytes(self.folds)
    }

    /// Stores a filled tile. Tiles of a row come from left to right.
    pub(super) fn put(&mut self, row: usize, column: usize, tile: Tile) {
        if tile.is_empty() {
            self.spare.push(tile);
            return;
        }
        let next = self.tiles.len() as u32;
        // Zeros have one sign then.
        let flat = tile.flat_mean().map(|mean| mean.map(|x| (x + 0.0).to_bits()));
        let at = flat.map_or(next, |mean| *self.flat.entry(mean).or_insert(next));
        if at == next {
            self.tiles.push(tile);
        }
        self.places[Self::slot(row, column)] = at;
        self.taken += 1;
        self.beside[row].push(column as u32);
    }

    /// `None` if all entries are infinite.
    #[inline(always)]
    pub(super) fn tile(&self, row: usize, column: usize) -> Option<&Tile> {
        self.tiles.get(self.places[Self::slot(row, column)] as usize)
    }

    /// The columns of the tiles of these rows.
    #[inline(always)]
    pub(super) fn beside(&self, row: usize) -> &[u32] {
        &self.beside[row]
    }

    /// Empties the table.
    pub(super) fn clear(&mut self) {
        for (row, beside) in self.beside.iter_mut().enumerate() {
            for column in beside.drain(..) {
                self.places[Self::slot(row, column as usize)] = NONE;
            }
        }
        self.taken = 0;
        self.flat.clear();
        self.tiles.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::QUANTUM;

    #[test]
    fn tiles_are_packed() {
        let slots =
            (0..3).flat_map(|column| (0..=column).map(move |row| TilePool::slot(row, column)));
        assert!(slots.eq(0..TilePool::slots(3)));
    }

    #[test]
    fn tiles_without_finite_entries_are_not_kept() {
        let mut store = TilePool::new(2, true);
        let (empty, mut tile) = (store.fresh(), store.fresh());
        tile.sums.entries[3][4] = 1.0;
        tile.sums.least[3] = 1.0;
        store.put(0, 0, empty);
        store.put(0, 1, tile);
        assert!(store.tile(0, 0).is_none() && store.tile(0, 1).is_some());
        assert_eq!(store.beside(0), [1]);
        store.clear();
        assert!(store.tile(0, 1).is_none() && store.beside(0).is_empty());
    }

    #[test]
    fn flat_tiles_of_one_normal_are_kept_once() {
        let flat = |folds: bool, mean: [f64; 3]| {
            let mut tile = Tile::new(folds);
            *tile.sums.entries = [[0.0; LANES]; LANES];
            *tile.sums.least = [0.0; LANES];
            if let Some(means) = &mut tile.means {
                ***means = [mean.map(|x| [x; LANES]); LANES];
            }
            tile
        };
        let uneven = |folds: bool| {
            let mut tile = flat(folds, [0.0, 0.0, 1.0]);
            tile.sums.entries[5][6] = QUANTUM;
            tile
        };
        for folds in [false, true] {
            let mut store = TilePool::new(4, folds);
            let mut turned = flat(folds, [0.0, 0.0, 1.0]);
            if let Some(means) = &mut turned.means {
                means[LANES - 1][0][LANES - 1] = 1e-16;
            }
            store.put(0, 1, flat(folds, [0.0, 0.0, 1.0]));
            store.put(0, 2, flat(folds, [-0.0, 0.0, 1.0]));
            store.put(0, 3, flat(folds, [0.0, 0.0, -1.0]));
            store.put(1, 2, uneven(folds));
            store.put(1, 3, turned);
            let at = |row, column| store.tile(row, column).map(std::ptr::from_ref);
            assert_eq!(at(0, 1), at(0, 2));
            assert_eq!([at(0, 3), at(1, 3)].map(|tile| tile == at(0, 1)), [!folds; 2]);
            assert_ne!(at(1, 2), at(0, 1));
            let tiles = if folds { 4 } else { 2 };
            assert_eq!(store.tiles.len(), tiles);
            let places = least_bytes(4) + 5 * PLACE_BYTES;
            assert_eq!(store.bytes(), places + tiles as u64 * Tile::bytes(folds));
            store.clear();
            assert_eq!((store.bytes(), store.tiles.len()), (least_bytes(4), 0));
            // The number of the tile that was flat is that of another now.
            store.put(0, 1, uneven(folds));
            store.put(0, 2, flat(folds, [0.0, 0.0, 1.0]));
            assert_eq!((store.beside(0), store.tiles.len()), (&[1, 2][..], 2));
            let zeros = |column| store.tile(0, column).map(|tile| tile.flat_mean().is_some());
            assert_eq!([zeros(1), zeros(2)], [Some(false), Some(true)]);
        }
    }
}
