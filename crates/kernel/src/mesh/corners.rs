//! Vertices split where no common side joins their triangles.
//!
//! Every corner of every triangle starts as a vertex of its own; across each side that stays joined
//! the corners at both its ends become one. The two sides of a cut, and parts that meet only in a
//! point, stay apart.

use sheetwright_geometry::disjoint::DisjointSets;
use sheetwright_geometry::index::VertexIndex;
use std::collections::BTreeSet;

/// Triangles whose vertices were taken apart.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Separated {
    /// The triangles, in the order in which they were given.
    pub(crate) triangles: Vec<[VertexIndex; 3]>,
    /// The vertex that each vertex was; those that were one stand beside one another.
    pub(crate) origin: Vec<VertexIndex>,
}

/// Takes triangles apart along the sides for which `is_cut` of their ends, the lower first; and at
/// points in which parts of them meet that have no side in common there.
pub(crate) fn separated(
    triangles: &[[VertexIndex; 3]],
    is_cut: impl Fn([VertexIndex; 2]) -> bool,
) -> Separated {
    // A side by its ends, and the corners at them.
    let mut sides: Vec<([VertexIndex; 2], [usize; 2])> = Vec::with_capacity(3 * triangles.len());
    for (t, corners) in triangles.iter().enumerate() {
        for k in 0..3 {
            let next = (k + 1) % 3;
            let (a, b) = ((corners[k], 3 * t + k), (corners[next], 3 * t + next));
            let (low, high) = if a.0 <= b.0 { (a, b) } else { (b, a) };
            sides.push(([low.0, high.0], [low.1, high.1]));
        }
    }
    sides.sort_unstable();
    let mut of = DisjointSets::new(3 * triangles.len());
    for pair in sides.windows(2) {
        let [(ends, corners), (other_ends, others)] = [pair[0], pair[1]];
        if ends == other_ends && !is_cut(ends) {
            for (a, b) in corners.into_iter().zip(others) {
                of.join(a, b);
            }
        }
    }
    let corner = |n: usize| triangles[n / 3][n % 3];
    let mut classes: BTreeSet<(VertexIndex, usize)> = BTreeSet::new();
    let roots = of.all_first();
    for (n, &root) in roots.iter().enumerate() {
        classes.insert((corner(n), root));
    }
    let classes: Vec<(VertexIndex, usize)> = classes.into_iter().collect();
    // A class has one corner that is its root, so that roots name classes.
    let mut number = vec![0; roots.len()];
    for (n, class) in classes.iter().enumerate() {
        number[class.1] = n;
    }
    let apart = |t: usize| [0, 1, 2].map(|k| VertexIndex::new(number[roots[3 * t + k]]));
    Separated {
        triangles: (0..triangles.len()).map(apart).collect(),
        origin: classes.into_iter().map(|class| class.0).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangles(list: &[[usize; 3]]) -> Vec<[VertexIndex; 3]> {
        list.iter().map(|t| t.map(VertexIndex::new)).collect()
    }

    #[test]
    fn what_meets_in_a_point_is_taken_apart_there() {
        let bow = triangles(&[[0, 1, 2], [2, 3, 4]]);
        let apart = separated(&bow, |_| false);
        assert_eq!(apart.triangles, triangles(&[[0, 1, 2], [3, 4, 5]]));
        assert_eq!(apart.origin.iter().map(|v| v.get()).collect::<Vec<_>>(), [0, 1, 2, 2, 3, 4]);
    }

    #[test]
    fn a_cut_within_a_fan_keeps_its_inner_end() {
        // A fan of four triangles round vertex 0, cut along one spoke: 0 stays one vertex.
        let fan = triangles(&[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]);
        let spoke = [VertexIndex::new(0), VertexIndex::new(1)];
        let apart = separated(&fan, |ends| ends == spoke);
        assert_eq!(apart.origin.iter().map(|v| v.get()).collect::<Vec<_>>(), [0, 1, 1, 2, 3, 4]);
        assert_eq!(separated(&fan, |_| false).triangles, fan);
    }
}
