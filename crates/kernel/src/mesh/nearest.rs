//! The point of a triangle that lies nearest to a point.

use sheetwright_geometry::math::Point3;

/// The point of a triangle that lies nearest to a point: by the region of the triangle's corners,
/// sides and inside that it lies over.
pub(crate) fn nearest_in([a, b, c]: [Point3; 3], p: Point3) -> Point3 {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let whole = va + vb + vc;
    a + ab * (vb / whole) + ac * (vc / whole)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_point_lies_on_the_corner_the_side_or_inside() {
        let p = |x: f64, y: f64, z: f64| Point3::new(x, y, z);
        let triangle = [p(0., 0., 0.), p(4., 0., 0.), p(0., 4., 0.)];
        for (from, nearest) in [
            (p(-1., -1., 2.), p(0., 0., 0.)),
            (p(6., -1., 0.), p(4., 0., 0.)),
            (p(-1., 9., 0.), p(0., 4., 0.)),
            (p(1., -3., 1.), p(1., 0., 0.)),
            (p(-3., 1., 1.), p(0., 1., 0.)),
            (p(3., 3., 0.), p(2., 2., 0.)),
            (p(1., 1., 7.), p(1., 1., 0.)),
        ] {
            assert!(nearest_in(triangle, from).distance(nearest) < 1e-12, "{from:?}");
        }
    }
}
