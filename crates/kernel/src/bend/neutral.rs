//! The neutral surface of a sheet: where bending changes no length.
//!
//! A drawing may be that of the inside of a duct, and the pattern is that of the fibre that keeps
//! its length, K thicknesses from the inner face. Of a developable surface that is the surface at a
//! fixed distance, which has the rulings of the first and is developable again. Every vertex is
//! moved so that all its triangles lie at that distance from where they lay: by the least vector v
//! with n·v = d for each of their normals n, in the sense of least squares. In a row of facets
//! about a bend, neighbours then still meet, as mitred boards do, and their widths grow by d times
//! the turn. Where a whole fan of triangles turns at a vertex, those at the border go first: so a
//! square mouth stays square.
//!
//! A mouth lies in a plane, and so do the edges along which pipes are mitred. There it stays, so
//! that it meets the floor, a flange or the next pipe: v is the best vector within that plane, and
//! at a corner between two such edges within both (`plane_edges`).
//!
//! At a sharp fold the vector has a large share along the faces: towards the face beside it where
//! that becomes narrower, by t; so it has at the corners of a square mouth. Samples nearer than t
//! would lie behind it and turn the sheet over there. So the samples of that face move along it,
//! too: by t at the fold, and by less and less up to twice that distance from it, so that their
//! order stays.

use super::plane_edges::EdgePlane;
use crate::design::Dimensions;
use crate::material::{KFactors, Material};
use crate::surface::Surface;
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::{Vec3, unit};
use std::ops::Range;

/// K of a sheet of which no table is known: the middle, as of every large radius.
const MIDDLE: f64 = 0.5;
/// Directions in which the normals of a vertex differ by less than this, squared, do not move it:
/// a share of the turn of a bend that no sampling shows.
const SAME_NORMAL: f64 = 1e-10;
/// How much more the triangles at the border count than those of a fan between them.
const OF_BORDER: f64 = 1e6;

/// How far the move of a fold along its faces reaches, as a multiple of that move.
const REACH: f64 = 2.0;
/// The sheet is folded where its facing turns by more, as a cosine: 20°.
const FOLDED_COS: f64 = 0.94;
/// An edge stays in its plane if the sheet crosses it at least so steeply, as a sine: 15°. Else it
/// would go far to stay there.
const LEAST_CROSSING: f64 = 0.26;

/// K at a bend radius, mm, in a sheet of a thickness, mm: the material's, or that of the middle.
pub(crate) fn k_factor(material: Option<&Material>, radius_mm: f64, thickness_mm: f64) -> f64 {
    let table = material.and_then(|material| material.k_factors.as_ref());
    table.map_or(MIDDLE, |table: &KFactors| table.at(radius_mm / thickness_mm))
}

/// The neutral surface of a drawn one, K thicknesses from its inner face. The inner face is the one
/// on the side that the surface bends towards in all. `planes` holds those in which the edge from
/// each sample to the next stays, see [`super::plane_edges`].
pub(crate) fn neutral_surface(
    drawn: &Surface,
    planes: &[EdgePlane],
    dimensions: Dimensions,
    thickness_mm: f64,
    k: f64,
) -> Surface {
    // Mountains have their inner face on the back.
    let outwards = if bends_up(drawn) { -1.0 } else { 1.0 };
    let share = k - dimensions.share();
    moved(drawn, planes, outwards * share * thickness_mm)
}

/// Whether a surface bends in all towards the side that it faces, so that its inner face is there.
pub(crate) fn bends_up(drawn: &Surface) -> bool {
    drawn.connectivity().hinges().iter().map(|hinge| drawn.crease(hinge)).sum::<f64>() < 0.0
}

/// The surface at a distance from another along its normals, mm.
fn moved(drawn: &Surface, planes: &[EdgePlane], distance_mm: f64) -> Surface {
    let border = Border::new(drawn, planes);
    let shifts = border.shifts();
    let along = border.along_faces(drawn, &shifts, distance_mm);
    let places = drawn.positions().iter().zip(shifts.iter().zip(&along));
    let positions =
        places.map(|(&at, (&shift, &along))| at + shift * distance_mm + along).collect();
    Surface::new(drawn.connectivity().clone(), positions)
}

/// The border of a surface. A step of it runs from a sample to the next one of the loop.
struct Border<'a> {
    loops: &'a [Range<usize>],
    /// The normals of the triangles at each sample.
    normals: Vec<Vec<Vec3>>,
    /// The normal of the triangle at each step.
    faces: Vec<Option<Vec3>>,
    /// The normal of the plane in which each step stays, if it stays in one.
    planes: Vec<Option<Vec3>>,
}

impl<'a> Border<'a> {
    fn new(drawn: &'a Surface, planes: &[EdgePlane]) -> Self {
        let (loops, samples) = (drawn.connectivity().loops(), planes.len());
        let (mut normals, mut faces) = (vec![Vec::new(); samples], vec![None; samples]);
        let mut next: Vec<usize> = (1..=samples).collect();
        loops.iter().for_each(|line| next[line.end - 1] = line.start);
        for (n, triangle) in drawn.connectivity().triangles().iter().enumerate() {
            let Some(normal) = drawn.normal(TriangleIndex::new(n)) else { continue };
            for (k, corner) in triangle.iter().map(|corner| corner.get()).enumerate() {
                normals[corner].push(normal);
                if next[corner] == triangle[(k + 1) % 3].get() {
                    faces[corner] = Some(normal);
                }
            }
        }
        let at = drawn.positions();
        let stays = |n: usize| match (planes[n], faces[n]?) {
            (EdgePlane::Own(plane), face) => {
                Some(plane).filter(|plane| plane.cross(face).length() >= LEAST_CROSSING)
            }
            (EdgePlane::Square, face) => unit(face.cross(at[next[n]] - at[n])),
            (EdgePlane::Free, _) => None,
        };
        let planes = (0..samples).map(stays).collect();
        Self { loops, normals, faces, planes }
    }

    /// By how much each sample moves where the surface moves by 1.
    fn shifts(&self) -> Vec<Vec3> {
        let of_loop = |line: &'a Range<usize>| {
            line.clone().map(|n| {
                let steps = [walked(line, n, line.len() - 1), n];
                let of_border = steps.into_iter().filter_map(|step| self.faces[step]);
                let of_border = of_border.map(|face| (face, OF_BORDER));
                let all = self.normals[n].iter().map(|&normal| (normal, 1.0)).chain(of_border);
                shift(&all.collect::<Vec<_>>(), steps.map(|step| self.planes[step]))
            })
        };
        self.loops.iter().flat_map(of_loop).collect()
    }

    /// By how much the samples beside folds and corners move along their faces, mm, besides their
    /// shifts.
    fn along_faces(&self, drawn: &Surface, shifts: &[Vec3], distance_mm: f64) -> Vec<Vec3> {
        let at = drawn.positions();
        let mut along = vec![Vec3::ZERO; shifts.len()];
        let lines = self.loops.iter().flat_map(|line| line.clone().map(move |n| (line, n)));
        for (line, corner) in lines {
            let back = line.len() - 1;
            for (way, step) in [(1, corner), (back, walked(line, corner, back))] {
                let Some(face) = self.faces[step] else { continue };
                // What the corner moves along the face, which the rest of the face does not.
                let of_face = shift(&[(face, 1.0)], [self.planes[step], None]);
                let slide = (shifts[corner] - of_face) * distance_mm;
                let Some(towards) = unit(slide) else { continue };
                let reach_mm = REACH * slide.length();
                for n in (1..line.len()).map(|k| walked(line, corner, k * way)) {
                    let off_mm = (at[n] - at[corner]).dot(towards);
                    if self.is_folded(n) || !(0.0..reach_mm).contains(&off_mm) {
                        break;
                    }
                    along[n] += slide * (1.0 - off_mm / reach_mm);
                }
            }
        }
        along
    }

    /// Whether the sheet is folded at a sample, which so has a place of its own.
    fn is_folded(&self, sample: usize) -> bool {
        let normals = &self.normals[sample];
        normals.iter().any(|normal| normal.dot(normals[0]) < FOLDED_COS)
    }
}

/// The sample so many steps from another on its loop.
fn walked(line: &Range<usize>, from: usize, steps: usize) -> usize {
    line.start + (from - line.start + steps) % line.len()
}

/// The least vector whose share along each of some unit vectors is 1, in the sense of least
/// squares with weights, within up to two planes: along their mean, and across it, by elimination,
/// since they hardly differ there.
fn shift(normals: &[(Vec3, f64)], planes: [Option<Vec3>; 2]) -> Vec3 {
    let whole_weight: f64 = normals.iter().map(|(_, weight)| weight).sum();
    let sum = normals.iter().map(|&(normal, weight)| normal * weight).sum();
    let Some(mean) = unit(sum) else { return Vec3::ZERO };
    let axes = axes(mean, planes);
    let (mut along, mut along_squared) = (0.0, 0.0);
    let mut mixed = [0.0; 2];
    let mut squares = [[SAME_NORMAL, 0.0], [0.0, SAME_NORMAL]];
    for (normal, weight) in normals {
        let share = weight / whole_weight;
        let [up, side @ ..] = axes.map(|axis| normal.dot(axis));
        along += share * up;
        along_squared += share * up * up;
        for n in 0..2 {
            mixed[n] += share * up * side[n];
            squares[n][0] += share * side[n] * side[0];
            squares[n][1] += share * side[n] * side[1];
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
    let shift = axes[0] * up + axes[1] * sideways[0] + axes[2] * sideways[1];
    if shift.is_finite() { shift } else { mean }
}

/// The direction nearest to another one within up to two planes, and those across it: the first
/// has no share along them. Directions that leave the planes are none, 0.
fn axes(mean: Vec3, planes: [Option<Vec3>; 2]) -> [Vec3; 3] {
    let [first, second] = planes;
    let line = first.zip(second).and_then(|(a, b)| unit(a.cross(b)));
    let line = line.filter(|line| line.dot(mean).abs() >= LEAST_CROSSING);
    if let Some(line) = line {
        return [line * line.dot(mean).signum(), Vec3::ZERO, Vec3::ZERO];
    }
    if let Some(plane) = first.or(second)
        && let Some(up) = unit(mean - plane * plane.dot(mean))
    {
        return [up, plane.cross(up), Vec3::ZERO];
    }
    let across = mean.any_orthonormal_vector();
    [mean, across, mean.cross(across)]
}
