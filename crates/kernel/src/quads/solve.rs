//! Symmetric positive definite systems with few entries.
//!
//! The system of a strip of quads is a chain, that of strips that branch a tree, and each hole adds
//! one cycle: elimination from the leaves makes hardly any new entries. The row with the fewest
//! neighbours left is eliminated next, the first of equals (minimum degree).

use std::collections::{BTreeMap, BTreeSet};

/// A symmetric matrix, by its entries that are not zero.
#[derive(Clone, Debug)]
pub(super) struct Symmetric {
    diagonal: Vec<f64>,
    /// The entries of each row off the diagonal; all of them, in both rows.
    rows: Vec<BTreeMap<usize, f64>>,
}

impl Symmetric {
    /// The matrix of zeros of this size.
    pub(super) fn new(size: usize) -> Self {
        Self { diagonal: vec![0.0; size], rows: vec![BTreeMap::new(); size] }
    }

    /// Adds to an entry, and to its mirror image.
    pub(super) fn add(&mut self, i: usize, j: usize, value: f64) {
        if i == j {
            self.diagonal[i] += value;
        } else {
            *self.rows[i].entry(j).or_insert(0.0) += value;
            *self.rows[j].entry(i).or_insert(0.0) += value;
        }
    }

    /// Solves for the right side, with `share` of the largest entry of the diagonal added to each
    /// diagonal entry, so that rows without entries do no harm: their unknowns become nearly 0.
    pub(super) fn solved(mut self, right: &[f64], share: f64) -> Vec<f64> {
        let size = self.diagonal.len();
        let most = self.diagonal.iter().copied().fold(0.0, f64::max);
        let least = (share * most).max(f64::MIN_POSITIVE);
        let mut x = right.to_vec();
        let mut waiting: BTreeSet<(usize, usize)> =
            (0..size).map(|n| (self.rows[n].len(), n)).collect();
        let mut eliminated = Vec::with_capacity(size);
        while let Some((_, n)) = waiting.pop_first() {
            let pivot = (self.diagonal[n] + least).max(least);
            let row: Vec<(usize, f64)> = std::mem::take(&mut self.rows[n]).into_iter().collect();
            for (k, &(i, at_i)) in row.iter().enumerate() {
                waiting.remove(&(self.rows[i].len(), i));
                self.rows[i].remove(&n);
                let factor = at_i / pivot;
                self.diagonal[i] -= factor * at_i;
                x[i] -= factor * x[n];
                for &(j, at_j) in &row[..k] {
                    *self.rows[i].entry(j).or_insert(0.0) -= factor * at_j;
                }
                for &(j, at_j) in &row[k + 1..] {
                    *self.rows[i].entry(j).or_insert(0.0) -= factor * at_j;
                }
            }
            for &(i, _) in &row {
                waiting.insert((self.rows[i].len(), i));
            }
            eliminated.push((n, pivot, row));
        }
        for (n, pivot, row) in eliminated.into_iter().rev() {
            let rest: f64 = row.iter().map(|&(i, value)| value * x[i]).sum();
            x[n] = (x[n] - rest) / pivot;
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_with_a_branch_is_solved() {
        let mut matrix = Symmetric::new(7);
        let sides = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 0), (2, 5), (5, 6)];
        for (n, (i, j)) in sides.into_iter().enumerate() {
            matrix.add(i, j, -1.0 - 0.1 * n as f64);
        }
        for i in 0..7 {
            matrix.add(i, i, 5.0 + i as f64);
        }
        let wanted = [1.0, -2.0, 3.0, 0.5, -1.5, 2.5, 4.0];
        let right: Vec<f64> = (0..7)
            .map(|i| {
                let off: f64 = matrix.rows[i].iter().map(|(&j, value)| value * wanted[j]).sum();
                matrix.diagonal[i] * wanted[i] + off
            })
            .collect();
        let found = matrix.solved(&right, 0.0);
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
        }
    }

    #[test]
    fn a_row_without_entries_does_no_harm() {
        let mut matrix = Symmetric::new(2);
        matrix.add(0, 0, 4.0);
        let found = matrix.solved(&[8.0, 0.0], 1e-12);
        assert!((found[0] - 2.0).abs() < 1e-9 && found[1] == 0.0);
    }
}
