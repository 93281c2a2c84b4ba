//! Triangles whose corners lie where those of another do, whichever way round they run: of a sheet
//! that was modelled from both sides, or copied onto itself. The first stays.

use super::{Damage, Work, middle, places};

/// Leaves out the triangles that lie where an earlier one does.
pub(super) fn leave_out(work: &mut Work) {
    let place = places(&work.positions);
    let mut by_corners: Vec<([usize; 3], usize)> = Vec::with_capacity(work.triangles.len());
    for (n, corners) in work.triangles.iter().enumerate() {
        let mut places = corners.map(|v| place[v.get()]);
        places.sort_unstable();
        by_corners.push((places, n));
    }
    by_corners.sort_unstable();
    let pairs = by_corners.windows(2).filter(|pair| pair[0].0 == pair[1].0);
    let mut doubled: Vec<usize> = pairs.map(|pair| pair[1].1).collect();
    doubled.sort_unstable();
    let first = doubled.first().map(|&n| middle(work.corners(work.triangles[n])));
    let mut number = 0..;
    work.triangles.retain(|_| number.next().is_some_and(|n| doubled.binary_search(&n).is_err()));
    work.note(Damage::Doubled, doubled.len(), first);
}
