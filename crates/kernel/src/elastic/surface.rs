//! The surface that a sheet is held at, at any point of its pattern: where it lies, and where it
//! faces.
//!
//! Of a surface that was found, and of a mesh with points inside its border, that is the triangles
//! themselves. A mesh in one row of triangles has creases that are none of the surface that it
//! samples: where it is twisted, they go to and fro by as much as the surface twists across the
//! strip, however fine the row is. A sheet that began on them would begin crumpled, and find a
//! place of rest by chance. So of a strip the smooth surface is taken: each point is moved halfway
//! to where the planes that touch the surface at the corners of its triangle are, by their weights
//! \[BoubekeurAlexa2008\]. Half of the way is exact where the surface is curved evenly. Where it
//! faces at a corner is the mean of the triangles there by their angles, which on a twisted row
//! is that of the plane along the rail. The point of a cone has no such plane, and moves nothing.

use super::places::Places;
use crate::flatten::Flattened;
use crate::mesh::Mesh;
use crate::sheet::Sheet;
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::{Point2, Point3, Vec3, angle_between, unit};

/// How the triangles of a mesh are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reading {
    /// They are the surface.
    #[default]
    Facets,
    /// They sample a smooth surface.
    Smooth,
}

/// So far a point goes to the planes that touch the surface at the corners.
const TO_PLANES: f64 = 0.5;

/// The mean of the facings of triangles at a corner is at least so long, but at the point of a
/// cone, whose sides lean by less than 53° to its axis. On strips that are twisted it is .87 and
/// more.
const LEAST_MEAN: f64 = 0.8;

/// A surface over its pattern.
pub(super) struct Surface<'a> {
    mesh: &'a Mesh,
    places: Places,
    /// Where a smooth surface faces at every vertex.
    facing: Option<Vec<Vec3>>,
}

impl<'a> Surface<'a> {
    pub(super) fn new(sheet: &'a Sheet, flat: &Flattened, reading: Reading) -> Self {
        let mesh = sheet.mesh();
        let triangles = mesh.triangles().iter();
        let places = Places::new(triangles.map(|t| t.map(|v| flat.points[v.get()])));
        let facing = (reading == Reading::Smooth).then(|| facing(mesh));
        Self { mesh, places, facing }
    }

    /// The triangle over a point of the pattern.
    pub(super) fn over(&self, p: Point2) -> usize {
        self.places.located(p).0
    }

    /// Where the surface lies over a point of the pattern, mm, and where it faces there.
    pub(super) fn at(&self, p: Point2) -> (Point3, Vec3) {
        let (t, weights) = self.places.located(p);
        let corners = self.mesh.triangles()[t];
        let weighed = |of: [Vec3; 3]| of[0] * weights[0] + of[1] * weights[1] + of[2] * weights[2];
        let at = Point3::from_vec(weighed(corners.map(|v| self.mesh.position(v).to_vec())));
        let facet = unit(self.mesh.area_vector(TriangleIndex::new(t))).unwrap_or(Vec3::ZERO);
        let Some(facing) = &self.facing else { return (at, facet) };
        let to_planes = corners.map(|v| {
            let normal = facing[v.get()];
            normal * (self.mesh.position(v) - at).dot(normal)
        });
        let normal = unit(weighed(corners.map(|v| facing[v.get()]))).unwrap_or(facet);
        (at + weighed(to_planes) * TO_PLANES, normal)
    }
}

/// Where a smooth surface faces at every vertex: the mean of its triangles by their angles there;
/// zero at the point of a cone.
pub(super) fn facing(mesh: &Mesh) -> Vec<Vec3> {
    let mut sums = vec![(Vec3::ZERO, 0.0); mesh.positions().len()];
    for (n, corners) in mesh.triangles().iter().enumerate() {
        let Some(normal) = unit(mesh.area_vector(TriangleIndex::new(n))) else { continue };
        for k in 0..3 {
            let [here, next, last] = [0, 1, 2].map(|step| corners[(k + step) % 3]);
            let way = |to| mesh.position(to) - mesh.position(here);
            let angle = angle_between(way(next), way(last));
            let (sum, whole) = &mut sums[here.get()];
            *sum += normal * angle;
            *whole += angle;
        }
    }
    let mean = |(sum, whole): (Vec3, f64)| {
        unit(sum).filter(|_| sum.length() >= LEAST_MEAN * whole).unwrap_or(Vec3::ZERO)
    };
    sums.into_iter().map(mean).collect()
}
