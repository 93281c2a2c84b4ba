use super::overlap::{Apart, Side, is_inside, meet, reaches_into};
use sheetwright_geometry::math::Point2;

/// A closed line of sides through these points, which are vertices of these numbers.
fn ring(points: &[([f64; 2], u32)]) -> Vec<Side> {
    let corner = |n: usize| points[n % points.len()];
    let side = |n: usize| {
        let ends = [corner(n), corner(n + 1)];
        Side { ends: ends.map(|(p, _)| Point2::new(p[0], p[1])), vertices: ends.map(|e| e.1) }
    };
    (0..points.len()).map(side).collect()
}

fn any_meet(a: &[Side], b: &[Side]) -> bool {
    a.iter().any(|a| b.iter().any(|b| meet(a, b, Apart::new(1.0, 0.0))))
}

#[test]
fn facets_may_touch_where_they_share_a_vertex_and_nowhere_else() {
    let square = ring(&[([0., 0.], 0), ([1., 0.], 1), ([1., 1.], 2), ([0., 1.], 3)]);
    // Folded along the side from 1 to 2; and beside it, round vertex 1, with a slit between.
    let beside = ring(&[([1., 0.], 1), ([2., 0.5], 4), ([1., 1.], 2)]);
    assert!(!any_meet(&square, &beside));
    let below = ring(&[([1., 0.], 1), ([0.1, -0.4], 5), ([1., -1.], 6)]);
    assert!(!any_meet(&square, &below));
    // As far apart as rounding, at another vertex: they count as touching.
    let near = ring(&[([1.0 + 1e-12, 0.5], 7), ([2., 0.], 8), ([2., 1.], 9)]);
    assert!(any_meet(&square, &near));
    let apart = ring(&[([1.0 + 1e-6, 0.5], 7), ([2., 0.], 8), ([2., 1.], 9)]);
    assert!(!any_meet(&square, &apart));
    // Along a common side without being joined there, and across.
    let closed = ring(&[([1., 0.], 1), ([1., 1.], 10), ([2., 0.5], 4)]);
    assert!(any_meet(&square, &closed));
    let across = ring(&[([0.5, 0.5], 11), ([3., 0.4], 12), ([3., 0.6], 13)]);
    assert!(any_meet(&square, &across));
}

#[test]
fn a_facet_within_another_is_found_by_a_point_inside() {
    let square = ring(&[([0., 0.], 0), ([3., 0.], 1), ([3., 3.], 2), ([0., 3.], 3)]);
    let within = ring(&[([1., 1.], 4), ([2., 1.], 5), ([1., 2.], 6)]);
    assert!(!any_meet(&square, &within));
    assert!(is_inside(Point2::new(1.2, 1.2), &square));
    assert!(!is_inside(Point2::new(3.5, 1.2), &square));
    // A hole is no inside.
    let pierced = [square, within].concat();
    assert!(!is_inside(Point2::new(1.2, 1.2), &pierced));
}

#[test]
fn a_facet_that_covers_a_hole_with_its_vertices_and_more_is_found() {
    let plate = ring(&[([0., 0.], 0), ([9., 0.], 1), ([9., 9.], 2), ([0., 9.], 3)]);
    let hole = ring(&[([3., 3.], 4), ([4., 5.], 6), ([5., 3.], 5)]);
    let plate = [plate, hole].concat();
    // Folded along the side from 4 to 5; its tip is in the hole, or beyond the hole's.
    let low = ring(&[([3., 3.], 4), ([5., 3.], 5), ([4., 4.9], 7)]);
    let high = ring(&[([3., 3.], 4), ([5., 3.], 5), ([4., 5.1], 7)]);
    assert!(!any_meet(&low, &plate) && !any_meet(&high, &plate));
    assert!(!reaches_into(&low, &plate) && !reaches_into(&plate, &low));
    assert!(reaches_into(&high, &plate));
}
