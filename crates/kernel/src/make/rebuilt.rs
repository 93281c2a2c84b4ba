//! A mesh panel found again from its border alone: the optimal triangulation of the border, and how
//! far the mesh lies from it. Where it lies near, the panel is developable but for noise, and a
//! design of its border is the better input: it unrolls exactly.

use crate::mesh::Mesh;
use crate::surface::{Connectivity, Surface};
use sheetwright_geometry::boundary::{
    Boundary, PlaneChoice, samples_from_points, supporting_plane,
};
use sheetwright_geometry::curve::{CurvePoint, MAX_COORDINATE_MM};
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::{Point3, Vec3, angle_between, from_deg};
use sheetwright_geometry::triangle::nearest_in_triangle;
use sheetwright_geometry::watch::Watch;
use sheetwright_optimum::triangulate::{TriangulateOptions, triangulate};

/// The most points of a border that is triangulated: more would take minutes.
const MOST_SAMPLES: usize = 1200;
/// The border has a corner where it turns by more than this, degrees.
const CORNER_DEG: f64 = 30.0;
/// The most points of the mesh whose distance is measured.
const MOST_POINTS: usize = 5000;

/// A border farther from the origin than this share of the range of boundaries is shifted.
const FAR: f64 = 0.1;

/// The surface of a border beside the mesh that it is from.
#[derive(Clone, Debug, PartialEq)]
pub struct Rebuilt {
    /// The optimal triangulation of the border.
    pub surface: Surface,
    /// The largest distance of a vertex of the mesh from it, mm.
    pub distance_max_mm: f64,
    /// The mean distance of the vertices of the mesh from it, each weighted by the area round it,
    /// mm.
    pub distance_mean_mm: f64,
}

/// The optimal surface of the border of a mesh with one component. `None` if the mesh has holes or
/// no border, if the border has too many points, or if no triangulation of it is found.
pub(super) fn rebuilt(mesh: &Mesh, watch: &mut dyn Watch) -> Option<Rebuilt> {
    let [border] = mesh.loops() else { return None };
    if border.len() > MOST_SAMPLES
        || !mesh.components().first().is_some_and(|piece| piece.is_disk())
    {
        return None;
    }
    // A mesh far from the origin is shifted there meanwhile.
    let first = mesh.position(border[0]).to_vec();
    let is_far = first.abs().max_element() > FAR * MAX_COORDINATE_MM;
    let shift = if is_far { first } else { Vec3::ZERO };
    let at: Vec<Point3> =
        border.iter().map(|&v| Point3::from_vec(mesh.position(v).to_vec() - shift)).collect();
    let m = at.len();
    let points: Vec<CurvePoint> = (0..m)
        .map(|i| {
            let turn = angle_between(at[i] - at[(i + m - 1) % m], at[(i + 1) % m] - at[i]);
            if turn > from_deg(CORNER_DEG) {
                CurvePoint::corner(at[i])
            } else {
                CurvePoint::smooth(at[i])
            }
        })
        .collect();
    let boundary = Boundary::new(vec![samples_from_points(&points)]).ok()?;
    let plane = supporting_plane(&boundary, PlaneChoice::Auto).ok()?;
    let options = TriangulateOptions::default();
    let found = triangulate(&boundary, plane.as_ref(), &options, watch).ok()?;
    let connectivity = Connectivity::new(boundary.loops(), found.triangles).ok()?;
    let back = boundary.positions().into_iter().map(|p| p + shift).collect();
    let surface = Surface::new(connectivity, back);
    let (distance_max_mm, distance_mean_mm) = distances(mesh, &surface);
    Some(Rebuilt { surface, distance_max_mm, distance_mean_mm })
}

/// The largest and the mean distance of the vertices from the surface, mm.
fn distances(mesh: &Mesh, surface: &Surface) -> (f64, f64) {
    let mut weights = vec![0.0; mesh.positions().len()];
    for (t, corners) in mesh.triangles().iter().enumerate() {
        let share = mesh.area_vector(TriangleIndex::new(t)).length() / 3.0;
        corners.iter().for_each(|v| weights[v.get()] += share);
    }
    let triangles: Vec<[Point3; 3]> = (0..surface.connectivity().triangles().len())
        .map(|t| surface.corners(TriangleIndex::new(t)))
        .collect();
    let step = weights.len().div_ceil(MOST_POINTS).max(1);
    let (mut most, mut sum, mut whole) = (0.0f64, 0.0, 0.0);
    for n in (0..weights.len()).step_by(step) {
        let p = mesh.positions()[n];
        let nearest = triangles
            .iter()
            .map(|&t| p.distance(nearest_in_triangle(t, p)))
            .fold(f64::INFINITY, f64::min);
        most = most.max(nearest);
        sum += weights[n] * nearest;
        whole += weights[n];
    }
    (most, if whole > 0.0 { sum / whole } else { 0.0 })
}
