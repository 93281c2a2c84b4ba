//! The cheapest strip between two rails, \[WT05\].
//!
//! Every rung joins sample i of the first rail to sample j of the second, so a strip is a path of
//! steps through the lattice of pairs (i, j), each step a triangle: along the first rail or along
//! the second. The cheapest path to (i, j) continues the cheaper of those to (i − 1, j) and
//! (i, j − 1); of equals, the one along the first rail.

use super::{Side, Terms, TriangulateError};
use sheetwright_geometry::watch::Watch;

/// Memory of the tables of m samples, `first` of them on the first rail, bytes: a price and a
/// choice for every pair across.
pub(super) fn memory_needed(first: usize, m: usize) -> u64 {
    let pairs = (first as u64) * (m.saturating_sub(first) as u64);
    pairs * (size_of::<f64>() + size_of::<bool>()) as u64
}

/// The triangles of the cheapest strip; `None` if there is none.
pub(super) fn solve(
    terms: &Terms<'_>,
    first: usize,
    watch: &mut dyn Watch,
) -> Result<Option<Vec<[usize; 3]>>, TriangulateError> {
    let m = terms.prices.len();
    if first == 0 || first >= m {
        return Err(TriangulateError::Rails);
    }
    let second = m - first;
    // The second rail runs back along the loop.
    let on_second = |j: usize| m - 1 - j;
    let mut cheapest = vec![f64::INFINITY; first * second];
    let mut along_first = vec![false; first * second];
    let mut sides_before: Vec<Side> = Vec::new();
    for i in 0..first {
        if watch.stop() {
            return Err(TriangulateError::Stopped);
        }
        watch.progress(i as f64 / first as f64);
        let sides: Vec<Side> = (0..second).map(|j| terms.side(i, on_second(j))).collect();
        for j in 0..second {
            let here = i * second + j;
            if i == 0 && j == 0 {
                cheapest[here] = sides[0].price;
                continue;
            }
            let mut best = f64::INFINITY;
            if i > 0 {
                let corners = [i - 1, i, on_second(j)];
                let means = [super::EDGE.mean, sides[j].mean, sides_before[j].mean];
                best = terms.together(cheapest[here - second], terms.fold(corners, means));
                along_first[here] = best < f64::INFINITY;
            }
            if j > 0 {
                let corners = [i, on_second(j), on_second(j - 1)];
                let means = [sides[j].mean, super::EDGE.mean, sides[j - 1].mean];
                let price = terms.together(cheapest[here - 1], terms.fold(corners, means));
                if price < best {
                    best = price;
                    along_first[here] = false;
                }
            }
            cheapest[here] = terms.together(best, sides[j].price);
        }
        sides_before = sides;
    }
    if cheapest[first * second - 1] == f64::INFINITY {
        return Ok(None);
    }
    let mut triangles = Vec::with_capacity(m - 2);
    let (mut i, mut j) = (first - 1, second - 1);
    while i > 0 || j > 0 {
        if along_first[i * second + j] {
            triangles.push([i - 1, i, on_second(j)]);
            i -= 1;
        } else {
            triangles.push([i, on_second(j), on_second(j - 1)]);
            j -= 1;
        }
    }
    Ok(Some(triangles))
}
