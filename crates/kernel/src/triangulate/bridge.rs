//! The cheapest bridge triangulation: every triangle has an edge of the boundary. Equations (3)
//! and (4).
//!
//! Let D⟨i,j⟩⁺ be the least price of the part of the loop from i on to j, with the rung ⟨i,j⟩ not
//! counted. Its triangle at ⟨i,j⟩ has an edge of the boundary at i or at j:
//! D⟨i,j⟩⁺ = min{ D⟨i+,j⟩⁺ + w⟨i+,j⟩ , D⟨i,j−⟩⁺ + w⟨i,j−⟩ }, plus the price of that triangle.
//! The part on the other side, ⟨i,j⟩⁻, is the part from j on to i, so one table over (start,
//! length) serves both. Every triangulation has a rung at sample 0 or the rung ⟨0−,0+⟩, and
//! equation (2) puts the two sides of it together.

use super::{Side, Terms, TriangulateError};
use crate::watch::Watch;

/// What the tables of m samples take, bytes.
pub(super) fn memory_needed(m: usize) -> u64 {
    // A price and a choice for every start and length, and the side of every pair.
    let per_part = size_of::<f64>() + size_of::<bool>();
    (m as u64) * (m as u64) * (per_part + size_of::<Side>()) as u64
}

struct Parts<'a> {
    terms: &'a Terms<'a>,
    m: usize,
    sides: Vec<Side>,
    /// D⟨i, i + length⟩⁺ at [length · m + i].
    least: Vec<f64>,
    /// Whether its first triangle has its edge of the boundary at the start.
    at_start: Vec<bool>,
}

/// The triangles of the cheapest bridge triangulation; `None` if there is none.
pub(super) fn solve(
    terms: &Terms<'_>,
    watch: &mut dyn Watch,
) -> Result<Option<Vec<[usize; 3]>>, TriangulateError> {
    let m = terms.prices.len();
    let mut sides = vec![super::EDGE; m * m];
    for i in 0..m {
        if watch.stop() {
            return Err(TriangulateError::Stopped);
        }
        watch.progress(0.5 * i as f64 / m as f64);
        for j in i + 1..m {
            sides[i * m + j] = terms.side(i, j);
            sides[j * m + i] = sides[i * m + j];
        }
    }
    let mut parts =
        Parts { terms, m, sides, least: vec![0.0; m * m], at_start: vec![false; m * m] };
    for length in 2..m {
        if watch.stop() {
            return Err(TriangulateError::Stopped);
        }
        watch.progress(0.5 + 0.5 * length as f64 / m as f64);
        for i in 0..m {
            parts.fill(i, length);
        }
    }
    Ok(parts.together())
}

impl Parts<'_> {
    fn side(&self, i: usize, j: usize) -> Side {
        self.sides[i * self.m + j]
    }

    /// The price of a triangle whose corners follow one another round the loop.
    fn triangle(&self, corners: [usize; 3]) -> f64 {
        let mut sorted = corners;
        sorted.sort_unstable();
        let [i, k, j] = sorted;
        let means = [self.side(i, k).mean, self.side(k, j).mean, self.side(i, j).mean];
        self.terms.fold(sorted, means)
    }

    /// The price of three parts together.
    fn three(&self, a: f64, b: f64, c: f64) -> f64 {
        self.terms.together(self.terms.together(a, b), c)
    }

    fn fill(&mut self, i: usize, length: usize) {
        let m = self.m;
        let [i_next, j_before, j] = [i + 1, i + length - 1, i + length].map(|k| k % m);
        // With an edge at the start, the part from i+ to j is left; at the end, from i to j−.
        let start = self.three(
            self.least[(length - 1) * m + i_next],
            self.side(i_next, j).price,
            self.triangle([i, i_next, j]),
        );
        let end = self.three(
            self.least[(length - 1) * m + i],
            self.side(i, j_before).price,
            self.triangle([i, j_before, j]),
        );
        self.at_start[length * m + i] = start <= end;
        self.least[length * m + i] = if start <= end { start } else { end };
    }

    /// Equation (2) over the rungs at sample 0 and the rung that cuts it off.
    fn together(&self) -> Option<Vec<[usize; 3]>> {
        let m = self.m;
        if m == 3 {
            return Some(vec![[0, 1, 2]]);
        }
        let both = |j: usize| {
            self.three(self.least[j * m], self.least[(m - j) * m + j], self.side(0, j).price)
        };
        let cut_off = self.three(
            self.least[(m - 2) * m + 1],
            self.side(1, m - 1).price,
            self.triangle([m - 1, 0, 1]),
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
