//! The tiles between the rows and the column of a tile, which hold the sides of its triangles.

use super::Table;
use crate::triangulate::optimal::lanes::lowest;
use crate::triangulate::optimal::normals::{NormalBox, least_fold};
use crate::triangulate::optimal::tile_pool::Tile;

/// The tiles between the rows and the column of a tile that is filled, as far as needed so far.
pub(super) struct Between<'a> {
    pub(super) row: usize,
    column: usize,
    pub(super) found: Vec<Sides<'a>>,
    /// The place, in the list of tiles of these rows, of the first that was not yet read.
    next: usize,
    /// The box around the N of the tile that is filled, as far as it is known.
    normals: NormalBox,
}

/// Two tiles whose rungs are sides of triangles with those of the tile that is filled.
pub(super) struct Sides<'a> {
    /// The columns of the first, which are the rows of the second.
    pub(super) at: usize,
    pub(super) own: &'a Tile,
    pub(super) beyond: &'a Tile,
    /// The least sum of two entries, one of each.
    sums: f64,
    /// Lower bound on the price of a triangle on two such sides: the least sum of two entries, with
    /// the least F.
    pub(super) least: f64,
}

impl<'a> Between<'a> {
    pub(super) fn new(row: usize, column: usize) -> Self {
        Self { row, column, found: Vec::new(), next: 0, normals: NormalBox::ANY }
    }
}

impl Table<'_> {
    /// Finds the next two tiles between; returns whether there are any.
    #[inline(always)]
    pub(super) fn find_next<'a, const FOLDS: bool>(
        &'a self,
        between: &mut Between<'a>,
        together: impl Fn(f64, f64) -> f64,
    ) -> bool {
        while let Some(&at) = self.store.beside(between.row).get(between.next) {
            between.next += 1;
            let at = at as usize;
            let tiles = (self.store.tile(between.row, at), self.store.tile(at, between.column));
            if let (Some(own), Some(beyond)) = tiles {
                let sums = together(lowest(&own.sums.least), lowest(&beyond.sums.least));
                let mut sides = Sides { at, own, beyond, sums, least: sums };
                if FOLDS {
                    sides.least += self.fold_between(&sides, &between.normals);
                }
                between.found.push(sides);
                return true;
            }
        }
        false
    }

    /// Whether no sum below the rungs of the tile can be less than `limit`, for a tile without
    /// edges ⟨i,i+1⟩: a k in its own rows or column needs another finite entry of the tile, and the
    /// first such entry has its k between.
    #[inline(always)]
    pub(super) fn leaves_nothing<'a, const FOLDS: bool>(
        &'a self,
        between: &mut Between<'a>,
        limit: f64,
        together: impl Fn(f64, f64) -> f64 + Copy,
    ) -> bool {
        while self.find_next::<FOLDS>(between, together) {
            if between.found.last().is_some_and(|sides| sides.least < limit) {
                return false;
            }
        }
        true
    }

    /// Updates the bounds by the box around the N of the tile.
    #[inline(always)]
    pub(super) fn know_normals(&self, between: &mut Between<'_>, normals: NormalBox) {
        between.normals = normals;
        for sides in &mut between.found {
            sides.least = sides.sums + self.fold_between(sides, &normals);
        }
    }

    #[inline(always)]
    fn fold_between(&self, sides: &Sides<'_>, normals: &NormalBox) -> f64 {
        let fold = self.terms.prices.options().fold;
        least_fold(fold, [sides.own.normals(), sides.beyond.normals(), normals])
    }
}
