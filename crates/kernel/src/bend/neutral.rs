//! The neutral surface of a sheet: where bending changes no length.
//!
//! A drawing may be that of the inside of a duct, and the pattern is that of the fibre that keeps
//! its length, K thicknesses from the inner face. Of a developable surface that is the surface at a
//! fixed distance, which has the rulings of the first and is developable again. Every vertex is
//! moved so that all its triangles lie at that distance from where they lay: by the least vector v
//! with n·v = d for each of their normals n, in the sense of least squares. In a row of facets
//! about a bend, neighbours then still meet, as mitred boards do, and their widths grow by d times
//! the turn.
//!
//! At a sharp fold the vector has a large share along the faces: towards the face beside it where
//! that becomes narrower, by t. Samples nearer to the fold than t would lie behind it and turn the
//! sheet over there. So the samples beside a fold move along their face, too: by t at the fold, and
//! by less and less up to twice that distance from it, so that their order stays.

use crate::design::Dimensions;
use crate::material::{KFactors, Material};
use crate::measure::RungMeasures;
use crate::surface::Surface;
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::{Vec3, unit};

/// K of a sheet of which no table is known: the middle, as of every large radius.
const MIDDLE: f64 = 0.5;
/// Directions in which the normals of a vertex differ by less than this, squared, do not move it:
/// a share of the turn of a bend that no sampling shows.
const SAME_NORMAL: f64 = 1e-10;

/// How far the move of a fold along its faces reaches, as a multiple of that move.
const REACH: f64 = 2.0;

/// K at a bend radius, mm, in a sheet of a thickness, mm: the material's, or that of the middle.
pub(crate) fn k_factor(material: Option<&Material>, radius_mm: f64, thickness_mm: f64) -> f64 {
    let table = material.and_then(|material| material.k_factors.as_ref());
    table.map_or(MIDDLE, |table: &KFactors| table.at(radius_mm / thickness_mm))
}

/// The neutral surface of a drawn one with these rungs, K thicknesses from its inner face. The
/// inner face is the one on the side that the surface bends towards in all.
pub(crate) fn neutral_surface(
    drawn: &Surface,
    rungs: &[RungMeasures],
    dimensions: Dimensions,
    thickness_mm: f64,
    k: f64,
) -> Surface {
    // Mountains have their inner face on the back.
    let outwards = if bends_up(drawn) { -1.0 } else { 1.0 };
    let share = k - dimensions.share();
    moved(drawn, rungs, outwards * share * thickness_mm)
}

/// Whether a surface bends in all towards the side that it faces, so that its inner face is there.
pub(crate) fn bends_up(drawn: &Surface) -> bool {
    drawn.connectivity().hinges().iter().map(|hinge| drawn.crease(hinge)).sum::<f64>() < 0.0
}

/// The surface at a distance from another along its normals, mm.
fn moved(drawn: &Surface, rungs: &[RungMeasures], distance_mm: f64) -> Surface {
    let connectivity = drawn.connectivity();
    let mut normals: Vec<Vec<Vec3>> = vec![Vec::new(); connectivity.samples()];
    for (n, triangle) in connectivity.triangles().iter().enumerate() {
        let Some(normal) = drawn.normal(TriangleIndex::new(n)) else { continue };
        triangle.iter().for_each(|corner| normals[corner.get()].push(normal));
    }
    let shifts: Vec<Vec3> = normals.iter().map(|normals| shift(normals) * distance_mm).collect();
    let along = along_faces(drawn, rungs, &shifts);
    let places = drawn.positions().iter().zip(shifts.iter().zip(&along));
    let positions = places.map(|(&at, (&shift, &along))| at + shift + along).collect();
    Surface::new(connectivity.clone(), positions)
}

/// By how much the samples beside folds move along their faces, mm, besides their shifts.
fn along_faces(drawn: &Surface, rungs: &[RungMeasures], shifts: &[Vec3]) -> Vec<Vec3> {
    let mut along = vec![Vec3::ZERO; shifts.len()];
    let mut is_on_fold = vec![false; shifts.len()];
    for rung in rungs.iter().filter(|rung| rung.is_fold) {
        rung.rung.ends().into_iter().for_each(|end| is_on_fold[end.get()] = true);
    }
    let at = drawn.positions();
    for line in drawn.connectivity().loops() {
        let count = line.len();
        for fold in line.clone().filter(|&n| is_on_fold[n]) {
            for step in [1, count - 1] {
                let beside = |k: usize| line.start + (fold - line.start + k * step) % count;
                // What the fold moves along the face, which the next sample of the face does not.
                let slide = shifts[fold] - shifts[beside(1)];
                let Some(way) = unit(slide) else { continue };
                let reach_mm = REACH * slide.length();
                for n in (1..count).map(beside).take_while(|&n| !is_on_fold[n]) {
                    let off_mm = (at[n] - at[fold]).dot(way);
                    if !(0.0..reach_mm).contains(&off_mm) {
                        break;
                    }
                    along[n] += slide * (1.0 - off_mm / reach_mm);
                }
            }
        }
    }
    along
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
