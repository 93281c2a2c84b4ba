//! The area of the Gauss image: how much of the unit sphere the normals sweep, counted without
//! sign.
//!
//! Along a rung from sample i to sample j the normal turns from n_i^j to n_j^i, on a great circle.
//! From one rung of a triangle to the next it turns about the tangents of the boundary, so that the
//! image of a triangle with two rungs is a spherical quadrilateral, and that of an ear a mere arc.
//! By Gauss the area of the image of a patch is the integral of |K| over it, K being the Gaussian
//! curvature, which is 0 for a developable surface. Since rungs end at samples and not where their
//! rulings would, a developable surface has a rest here, which falls with the square of the
//! spacing.
//!
//! Where the warp changes its sign between two rungs, the quadrilateral crosses itself and both of
//! its parts count. The image of a triangle with three rungs has six corners; of it the signed sum
//! counts. Of a mesh, whose triangles are flat, the image is a polygon round each vertex inside,
//! whose area is the angle defect there.

use super::RungMeasures;
use crate::mesh::{Mesh, angle_defects};
use crate::surface::Connectivity;
use sheetwright_geometry::math::{Vec3, atan2, unit};
use sheetwright_optimum::rung::Rung;

/// The area of the Gauss image, steradians: 4 π for the whole sphere once, 0 for a developable
/// surface. `rungs` are all rungs of the surface in increasing order. Triangles with a rung without
/// tangent planes have no image.
pub fn gauss_area(connectivity: &Connectivity, rungs: &[RungMeasures]) -> f64 {
    let areas = connectivity.triangles().iter().map(|&[a, b, c]| {
        let mut image = Vec::with_capacity(6);
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let rung = Rung::new(from.get(), to.get());
            let Ok(n) = rungs.binary_search_by_key(&rung, |r| r.rung) else { continue };
            let [low, high] = rungs[n].normals;
            if low == Vec3::ZERO {
                return 0.0;
            }
            image.extend(if rung.ends()[0] == from { [low, high] } else { [high, low] });
        }
        match image[..] {
            [p, q, r, s] => quadrilateral([p, q, r, s]),
            _ => polygon(&image).abs(),
        }
    });
    areas.sum()
}

/// The area of the Gauss image of a mesh, steradians: 0 for one that lies flat without stretching,
/// but for cones and handles.
pub(super) fn gauss_area_of_mesh(mesh: &Mesh) -> f64 {
    let on_border = mesh.topology().on_border();
    let defects = angle_defects(mesh).into_iter().zip(on_border);
    defects.filter(|(_, on_border)| !on_border).map(|(defect, _)| defect.abs()).sum()
}

/// The area of a spherical quadrilateral, both parts where the second side crosses the fourth.
fn quadrilateral([p, q, r, s]: [Vec3; 4]) -> f64 {
    let side = |a: Vec3, b: Vec3, x: Vec3| a.dot((b - a).cross(x - a));
    let apart = |a, b, x, y| side(a, b, x) * side(a, b, y) < 0.0;
    // p, q are the ends of the one rung and r, s those of the other; q, r lie on one side of the
    // strip, and s, p on the other.
    if apart(q, r, s, p) && apart(s, p, q, r) {
        let (first, second) = (q.cross(r), s.cross(p));
        if let Some(crossing) = unit(first.cross(second)) {
            let crossing = if crossing.dot(q + r) < 0.0 { -crossing } else { crossing };
            return polygon(&[p, q, crossing]).abs() + polygon(&[r, s, crossing]).abs();
        }
    }
    polygon(&[p, q, r, s]).abs()
}

/// The signed area of a spherical polygon, counter-clockwise positive as seen from outside:
/// triangles from its first corner, each by tan (Ω / 2) = det(a, b, c) / (1 + a·b + b·c + c·a)
/// \[VS83\].
fn polygon(corners: &[Vec3]) -> f64 {
    let triangle = |pair: &[Vec3]| {
        let (a, b, c) = (corners[0], pair[0], pair[1]);
        // The determinant of differences: normals are nearly the same.
        let volume = a.dot((b - a).cross(c - a));
        2.0 * atan2(volume, 1.0 + a.dot(b) + b.dot(c) + c.dot(a))
    };
    corners.get(1..).map_or(0.0, |rest| rest.windows(2).map(triangle).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn an_octant_is_an_eighth_of_the_sphere() {
        let octant = [Vec3::X, Vec3::Y, Vec3::Z];
        assert!((polygon(&octant) - PI / 2.0).abs() < 1e-15);
        let turned = [Vec3::X, Vec3::Z, Vec3::Y];
        assert!((polygon(&turned) + PI / 2.0).abs() < 1e-15);
        assert_eq!(polygon(&octant[..2]), 0.0);
        assert_eq!(polygon(&[]), 0.0);
    }

    #[test]
    fn both_parts_of_a_bow_tie_count() {
        // Round +z: the sides from q to r and from s to p cross there.
        let at = |x: f64, y: f64| unit(Vec3::new(x, y, 1.0)).unwrap();
        let [p, q, r, s] = [at(-0.1, 0.1), at(-0.1, -0.1), at(0.1, 0.1), at(0.1, -0.1)];
        let half = polygon(&[p, q, Vec3::Z]).abs();
        assert!(half > 0.009);
        assert!((quadrilateral([p, q, r, s]) - 2.0 * half).abs() < 1e-15);
        assert!(polygon(&[p, q, r, s]).abs() < 1e-15);
        let whole = quadrilateral([p, q, s, r]);
        assert!((whole - polygon(&[p, q, s, r]).abs()).abs() < 1e-15 && whole > 0.03);
    }
}
