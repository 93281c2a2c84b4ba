//! The neutral surface of a sheet: where bending changes no length.
//!
//! A drawing may be that of the inside of a duct, and the pattern is that of the fibre that keeps
//! its length, K thicknesses from the inner face. Of a developable surface that is the surface at a
//! fixed distance, which has the rulings of the first and is developable again. Every vertex is
//! moved so that all its triangles lie at that distance from where they lay: by the least vector v
//! with n·v = d for each of their normals n, in the sense of least squares. In a row of facets
//! about a bend, neighbours then still meet, as mitred boards do, and their widths grow by d times
//! the turn.

use crate::design::Dimensions;
use crate::material::{KFactors, Material};
use crate::surface::{Connectivity, Surface};
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::{Vec3, unit};

/// K of a sheet of which no table is known: the middle, as of every large radius.
const MIDDLE: f64 = 0.5;
/// Directions in which the normals of a vertex differ by less than this, squared, do not move it:
/// a share of the turn of a bend that no sampling shows.
const SAME_NORMAL: f64 = 1e-10;

/// K at a bend radius, mm, in a sheet of a thickness, mm: the material's, or that of the middle.
pub(crate) fn k_factor(material: Option<&Material>, radius_mm: f64, thickness_mm: f64) -> f64 {
    let table = material.and_then(|material| material.k_factors.as_ref());
    table.map_or(MIDDLE, |table: &KFactors| table.at(radius_mm / thickness_mm))
}

/// The neutral surface of a drawn one, K thicknesses from its inner face. The inner face is the one
/// on the side that the surface bends towards in all.
pub(crate) fn neutral_surface(
    drawn: &Surface,
    dimensions: Dimensions,
    thickness_mm: f64,
    k: f64,
) -> Surface {
    let connectivity = drawn.connectivity();
    // Mountains have their inner face on the back.
    let outwards = if bends_up(drawn) { -1.0 } else { 1.0 };
    let share = match dimensions {
        Dimensions::Inside => k,
        Dimensions::Mean => k - MIDDLE,
        Dimensions::Outside => k - 1.0,
    };
    moved(drawn, connectivity, outwards * share * thickness_mm)
}

/// Whether a surface bends in all towards the side that it faces, so that its inner face is there.
pub(crate) fn bends_up(drawn: &Surface) -> bool {
    drawn.connectivity().hinges().iter().map(|hinge| drawn.crease(hinge)).sum::<f64>() < 0.0
}

/// The surface at a distance from another along its normals, mm.
fn moved(drawn: &Surface, connectivity: &Connectivity, distance_mm: f64) -> Surface {
    let mut normals: Vec<Vec<Vec3>> = vec![Vec::new(); connectivity.samples()];
    for (n, triangle) in connectivity.triangles().iter().enumerate() {
        let Some(normal) = drawn.normal(TriangleIndex::new(n)) else { continue };
        triangle.iter().for_each(|corner| normals[corner.get()].push(normal));
    }
    let places = drawn.positions().iter().zip(&normals);
    let positions = places.map(|(&at, normals)| at + shift(normals) * distance_mm).collect();
    Surface::new(connectivity.clone(), positions)
}

/// The least vector whose share along each of some unit vectors is 1, in the sense of least
/// squares: along their mean, and in the plane across it, by elimination, since they hardly differ
/// there.
fn shift(normals: &[Vec3]) -> Vec3 {
    let count = normals.len() as f64;
    let Some(mean) = unit(normals.iter().copied().sum()) else { return Vec3::ZERO };
    let across = mean.any_orthonormal_vector();
    let axes = [across, mean.cross(across)];
    let (mut along, mut along_squared) = (0.0, 0.0);
    let mut mixed = [0.0; 2];
    let mut squares = [[SAME_NORMAL, 0.0], [0.0, SAME_NORMAL]];
    for normal in normals {
        let up = normal.dot(mean);
        let side = axes.map(|axis| normal.dot(axis));
        along += up / count;
        along_squared += up * up / count;
        for n in 0..2 {
            mixed[n] += up * side[n] / count;
            squares[n][0] += side[n] * side[0] / count;
            squares[n][1] += side[n] * side[1] / count;
        }
    }
    let left = |n: usize, m: usize| squares[n][m] - mixed[n] * mixed[m] / along_squared;
    let whole = left(0, 0) * left(1, 1) - left(0, 1) * left(1, 0);
    let share = -along / along_squared / whole;
    let sideways = [
        share * (left(1, 1) * mixed[0] - left(0, 1) * mixed[1]),
        share * (left(0, 0) * mixed[1] - left(1, 0) * mixed[0]),
    ];
    let up = (along - mixed[0] * sideways[0] - mixed[1] * sideways[1]) / along_squared;
    let shift = mean * up + axes[0] * sideways[0] + axes[1] * sideways[1];
    if shift.is_finite() { shift } else { mean }
}
