//! The cheapest bridge triangulation: every triangle has an edge of the boundary. Equations (3)
//! and (4).
//!
//! Let D⟨i,j⟩⁺ be the least price of the part of the loop from i on to j, with the rung ⟨i,j⟩ not
//! counted. Its triangle at ⟨i,j⟩ has an edge of the boundary at i or at j:
//!
//! ```text
//! D⟨i,j⟩⁺ = min{ D⟨i+,j⟩⁺ + w⟨i+,j⟩ , D⟨i,j−⟩⁺ + w⟨i,j−⟩ },
//! ```
//!
//! plus the price of that triangle. The part on the other side, ⟨i,j⟩⁻, is the part from j on to i,
//! so one table over (start, length) serves both. It is filled by length; prices are kept for two
//! lengths only, and for the parts that begin or end at sample 0. Every triangulation has a rung at
//! sample 0 or the rung ⟨0−,0+⟩, and equation (2) adds the two sides of that rung.

use super::{Side, Terms, TriangulateError};
use sheetwright_geometry::watch::Watch;

/// Memory of the tables of m samples, bytes: a choice for every start and length.
pub(super) fn memory_needed(m: usize) -> u64 {
    (m as u64) * (m as u64) * size_of::<bool>() as u64
}

/// The parts of two lengths at a time, by their start, and the values needed of all lengths.
struct Parts<'a> {
    terms: &'a Terms<'a>,
    m: usize,
    /// The rungs ⟨i, i + length⟩ of the length before and of this one.
    sides: [Vec<Side>; 2],
    /// D⟨i, i + length⟩⁺ of the length before and of this one.
    least: [Vec<f64>; 2],
    /// Whether the first triangle of a part has its edge of the boundary at the start, at
    /// [length · m + i].
    at_start: Vec<bool>,
    /// D⟨0, length⟩⁺ by length.
    from_first: Vec<f64>,
    /// D⟨j, 0⟩⁺ by j.
    to_first: Vec<f64>,
    /// D⟨1, m − 1⟩⁺.
    cut_off: f64,
}

/// The triangles of the cheapest bridge triangulation; `None` if there is none.
pub(super) fn solve(
    terms: &Terms<'_>,
    watch: &mut dyn Watch,
) -> Result<Option<Vec<[usize; 3]>>, TriangulateError> {
    let m = terms.prices.len();
    if m == 3 {
        return Ok(Some(vec![[0, 1, 2]]));
    }
    let mut parts = Parts::new(terms);
    for length in 2..m - 1 {
        if watch.stop() {
            return Err(TriangulateError::Stopped);
        }
        watch.progress(length as f64 / m as f64);
        parts.fill(length);
    }
    Ok(parts.together())
}

impl<'a> Parts<'a> {
    fn new(terms: &'a Terms<'a>) -> Self {
        let m = terms.prices.len();
        Self {
            terms,
            m,
            sides: [Self::sides(terms, 1), Vec::new()],
            least: [vec![0.0; m], vec![0.0; m]],
            at_start: vec![false; m * m],
            from_first: vec![0.0; m],
            to_first: vec![0.0; m],
            cut_off: 0.0,
        }
    }

    /// The rungs across `length` edges, by their start.
    fn sides(terms: &Terms<'_>, length: usize) -> Vec<Side> {
        let m = terms.prices.len();
        let side = |i: usize| {
            let j = (i + length) % m;
            terms.side(i.min(j), i.max(j))
        };
        (0..m).map(side).collect()
    }

    /// The price of a triangle whose corners follow one another round the loop; the first rung
    /// joins the first two corners, and so on.
    fn triangle(&self, corners: [usize; 3], rungs: [&Side; 3]) -> f64 {
        // The corners in order, and the rungs with them.
        let turn = match corners {
            [i, k, j] if i < k && k < j => 0,
            [_, k, j] if k < j => 1,
            _ => 2,
        };
        let [corners, at] = [corners, [0, 1, 2]].map(|mut list| {
            list.rotate_left(turn);
            list
        });
        self.terms.fold(corners, at.map(|n| rungs[n].mean))
    }

    /// The price of three parts combined.
    fn three(&self, a: f64, b: f64, c: f64) -> f64 {
        self.terms.together(self.terms.together(a, b), c)
    }

    /// All parts of this length, from those that are shorter by one.
    fn fill(&mut self, length: usize) {
        let m = self.m;
        self.sides[1] = Self::sides(self.terms, length);
        for i in 0..m {
            let [i_next, j_before, j] = [i + 1, i + length - 1, i + length].map(|k| k % m);
            let [before, now] = &self.sides;
            // With an edge at the start, the part from i+ to j is left; at the end, from i to j−.
            let start = self.three(
                self.least[0][i_next],
                before[i_next].price,
                self.triangle([i, i_next, j], [&super::EDGE, &before[i_next], &now[i]]),
            );
            let end = self.three(
                self.least[0][i],
                before[i].price,
                self.triangle([i, j_before, j], [&before[i], &super::EDGE, &now[i]]),
            );
            self.at_start[length * m + i] = start <= end;
            self.least[1][i] = if start <= end { start } else { end };
        }
        self.sides.swap(0, 1);
        self.least.swap(0, 1);
        self.from_first[length] = self.least[0][0];
        self.to_first[m - length] = self.least[0][m - length];
        self.cut_off = self.least[0][1];
    }

    /// Equation (2) over the rungs at sample 0 and the rung that cuts it off.
    fn together(&self) -> Option<Vec<[usize; 3]>> {
        let m = self.m;
        let side = |i: usize, j: usize| self.terms.side(i, j);
        let both = |j: usize| self.three(self.from_first[j], self.to_first[j], side(0, j).price);
        let across = side(1, m - 1);
        let rungs = [&super::EDGE, &super::EDGE, &across];
        let cut_off = self.three(
            self.cut_off,
            across.price,
            // From sample m − 1 on, by way of 0.
            self.triangle([m - 1, 0, 1], rungs),
        );
        let best = (2..m - 1).min_by(|&a, &b| both(a).total_cmp(&both(b)).then(a.cmp(&b)));
        let mut triangles = Vec::with_capacity(m - 2);
        match best {
            Some(j) if both(j) <= cut_off => {
                if both(j) == f64::INFINITY {
                    return None;
                }
                self.trace(0, j, &mut triangles);
                self.trace(j, m - j, &mut triangles);
            }
            _ if cut_off == f64::INFINITY => return None,
            _ => {
                triangles.push([m - 1, 0, 1]);
                self.trace(1, m - 2, &mut triangles);
            }
        }
        Some(triangles)
    }

    /// The triangles of the part of this length from `i` on.
    fn trace(&self, mut i: usize, mut length: usize, triangles: &mut Vec<[usize; 3]>) {
        let m = self.m;
        while length >= 2 {
            let [i_next, j_before, j] = [i + 1, i + length - 1, i + length].map(|k| k % m);
            if self.at_start[length * m + i] {
                triangles.push([i, i_next, j]);
                i = i_next;
            } else {
                triangles.push([i, j_before, j]);
            }
            length -= 1;
        }
    }
}
