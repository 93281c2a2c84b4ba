//! The catalogue of quantities that are measured on a surface and its flat pattern.
//!
//! | quantity | meaning | unit |
//! |---|---|---|
//! | twist w of a rung | 1 − cosine of the angle between the tangent planes at its ends | none |
//! | warp angle of a rung | that angle | radians |
//! | resolution of a rung | how much of its warp angle may come from the sampling | radians |
//! | crease of a rung | angle between its two triangles, positive for a mountain | radians |
//! | fold | whether a crease stands alone: a sharp fold, no part of a smooth bend | none |
//! | bend radius at a rung | how tightly the sheet is rolled across it, at its tighter end | mm |
//! | length error of a side | \|flat − space\| / space; of a mesh's, signed | none |
//! | stretch of a triangle | how much longer a direction is flat; largest, smallest | none |
//! | strain of a triangle | by how much its stretches differ from 1 at most | none |
//! | area | of the triangles, in space and flat | mm² |
//! | Gauss image | normals along the rungs, as points on the unit sphere | none |
//! | its area | how much of that sphere they sweep, 0 for a developable surface | steradians |

mod bend;
mod crossing;
mod gauss;
mod mesh;

pub use bend::Apex;
pub(crate) use crossing::crosses_itself;
pub use crossing::first_self_crossing;
pub use gauss::{gauss_area, gauss_area_of_mesh};
pub use mesh::{CutSuggestion, MeshMeasures, cut_suggestion, mesh_measures};

use crate::flatten::{Flattened, Sheet};
use crate::surface::Surface;
use bend::{Rolls, rolls};
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::{Point3, Vec3, to_deg};
use sheetwright_optimum::cost::Prices;
use sheetwright_optimum::rung::Rung;

/// Creases above this angle, degrees, are lines to bend or score along, not parts of a smooth
/// bend: what a bend of 90° has when it is divided into 18, the coarsest that workshops bend by.
pub const SHARP_CREASE_DEG: f64 = 5.0;

/// Creases up to this angle, radians, do not bend the sheet: numbers of 16 digits make such ones on
/// a plate.
const FLAT_CREASE: f64 = 1e-9;

/// What is measured at one rung.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RungMeasures {
    /// The rung.
    pub rung: Rung,
    /// w, without unit, 0 ..= 2; 2 for a rung without tangent planes.
    pub twist: f64,
    /// The warp angle, radians, 0 ..= π; π for a rung without tangent planes.
    pub warp: f64,
    /// How much of the warp angle the sampling can't tell from bending, radians. A rung ends at
    /// samples and not where its ruling would, and on the way to the next sample the tangent plane
    /// turns by the bend: so a perfect cylinder of 24 samples has rungs with a warp angle of 15°.
    /// It is twice the largest crease, folds aside, of the rung and its neighbours (a step from one
    /// sample to the next takes two rungs), or that of any rung that shares a sample with it (where
    /// a fan has its bend at its end). It falls with the spacing of the samples; twist stays.
    pub resolution: f64,
    /// The angle between the two triangles, radians, positive for a mountain as seen from the side
    /// that the surface faces.
    pub crease: f64,
    /// Whether the crease is a fold: above [`SHARP_CREASE_DEG`], and more than twice as large as
    /// those of the rungs around it together, so that no finer sampling would divide it.
    pub is_fold: bool,
    /// The radius that the sheet is rolled to at the end of the rung where it is rolled more
    /// tightly, mm; infinite where flat. Folds and apexes are none of it.
    pub bend_radius_mm: f64,
    /// The unit normals of the tangent planes at its two ends; zero without tangent planes.
    pub normals: [Vec3; 2],
    /// The middle of the rung in space, mm.
    pub middle: Point3,
}

impl RungMeasures {
    /// The warp angle, unless the sampling explains it: then 0. Radians.
    pub fn warp_beyond_sampling(&self) -> f64 {
        if self.warp > self.resolution { self.warp } else { 0.0 }
    }

    /// Whether the sheet bends along it; smaller creases come from rounding.
    pub fn bends(&self) -> bool {
        self.crease.abs() > FLAT_CREASE
    }
}

/// What is measured on one panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Measures {
    /// The rungs, in increasing order: along a strip between two rails, from one end to the other.
    pub rungs: Vec<RungMeasures>,
    /// W: the sum of all w, without unit. It grows with the sampling; people get warp angles.
    pub twist_total: f64,
    /// The largest warp angle, radians; 0 without rungs.
    pub warp_max: f64,
    /// The mean warp angle over the rungs, radians; 0 without rungs.
    pub warp_mean: f64,
    /// The largest angle between two triangles, radians; 0 without rungs.
    pub crease_max: f64,
    /// The smallest bend radius, apexes and folds aside, mm; infinite for a flat surface.
    pub bend_radius_min_mm: f64,
    /// Where rulings run together, in the order of the samples.
    pub apexes: Vec<Apex>,
    /// The area of the Gauss image, steradians: 0 for a developable surface, see [`gauss_area`].
    pub gauss_area_sr: f64,
    /// The area of the surface, mm².
    pub area_space_mm2: f64,
    /// The area of the pattern, mm².
    pub area_flat_mm2: f64,
    /// The largest relative length error of a side, without unit.
    pub length_error_max: f64,
    /// The mean relative length error over all sides, without unit.
    pub length_error_mean: f64,
    /// Two triangles that pass through one another, if any do. Exact.
    pub self_crossing: Option<[TriangleIndex; 2]>,
}

/// Measures a surface and the flat pattern of its sheet. `prices` are those of the boundary that it
/// spans. A rung that is cut is measured as every other: the seam is joined in space.
pub fn measures(surface: &Surface, sheet: &Sheet, flat: &Flattened, prices: &Prices) -> Measures {
    let (rungs, apexes) = rungs_and_apexes(surface, prices);
    let most = |of: fn(&RungMeasures) -> f64| rungs.iter().map(of).fold(0.0, f64::max);
    let count = rungs.len().max(1) as f64;
    let errors = length_errors(sheet, flat);
    Measures {
        twist_total: rungs.iter().map(|r| r.twist).sum(),
        warp_max: most(|r| r.warp),
        warp_mean: rungs.iter().map(|r| r.warp).sum::<f64>() / count,
        crease_max: most(|r| r.crease.abs()),
        bend_radius_min_mm: rungs.iter().map(|r| r.bend_radius_mm).fold(f64::INFINITY, f64::min),
        apexes,
        gauss_area_sr: gauss_area(surface.connectivity(), &rungs),
        area_space_mm2: area_space(surface),
        area_flat_mm2: area_flat(sheet, flat),
        length_error_max: errors.iter().copied().fold(0.0, f64::max),
        length_error_mean: errors.iter().sum::<f64>() / errors.len() as f64,
        self_crossing: first_self_crossing(surface),
        rungs,
    }
}

/// Measures the rungs of a surface alone, in increasing order. `prices` are those of the boundary
/// that it spans.
pub fn rung_measures(surface: &Surface, prices: &Prices) -> Vec<RungMeasures> {
    rungs_and_apexes(surface, prices).0
}

fn rungs_and_apexes(surface: &Surface, prices: &Prices) -> (Vec<RungMeasures>, Vec<Apex>) {
    let connectivity = surface.connectivity();
    let hinges = connectivity.hinges();
    let of_triangles = connectivity.hinges_of_triangles();
    let creases: Vec<f64> = hinges.iter().map(|hinge| surface.crease(hinge)).collect();
    // The rungs at both triangles of a rung, itself aside.
    let around = |n: usize| {
        let triangles = hinges[n].triangles.into_iter();
        let numbers = triangles.flat_map(|t| of_triangles[t.get()].iter().copied());
        numbers.filter(move |&other| other != n)
    };
    // A bend may have all of its crease on every other rung, so folds are compared with the
    // neighbours' neighbours too.
    let is_fold: Vec<bool> = (0..hinges.len())
        .map(|n| {
            if to_deg(creases[n].abs()) <= SHARP_CREASE_DEG {
                return false;
            }
            let mut near: Vec<usize> = around(n).collect();
            near.extend(around(n).flat_map(around).filter(|&other| other != n));
            near.sort_unstable();
            near.dedup();
            let nearby: f64 = near.into_iter().map(|other| creases[other].abs()).sum();
            creases[n].abs() > 2.0 * nearby
        })
        .collect();
    // Folds are no part of a smooth bend.
    let smooth: Vec<f64> =
        (0..hinges.len()).map(|n| if is_fold[n] { 0.0 } else { creases[n] }).collect();
    // All rungs that end at a sample bend together: a fan has its bend where it ends.
    let mut sharpest_at = vec![0.0f64; connectivity.samples()];
    for (hinge, crease) in hinges.iter().zip(&smooth) {
        for sample in hinge.rung.ends() {
            let sharpest = &mut sharpest_at[sample.get()];
            *sharpest = sharpest.max(crease.abs());
        }
    }
    let Rolls { radii_mm, apexes } = rolls(surface, &smooth);
    let bend = |n: usize| smooth[n].abs();
    let rungs = (0..hinges.len())
        .map(|n| {
            let rung = hinges[n].rung;
            let [low, high] = rung.ends();
            let planes = prices.planes(low.get(), high.get());
            RungMeasures {
                rung,
                twist: planes.map_or(2.0, |p| p.twist),
                warp: planes.map_or(std::f64::consts::PI, |p| p.warp()),
                resolution: (2.0 * around(n).map(bend).fold(bend(n), f64::max))
                    .max(sharpest_at[low.get()].max(sharpest_at[high.get()])),
                crease: creases[n],
                is_fold: is_fold[n],
                bend_radius_mm: radii_mm[low.get()].min(radii_mm[high.get()]),
                normals: planes.map_or([Vec3::ZERO; 2], |p| p.at_ends),
                middle: surface.position(low).lerp(surface.position(high), 0.5),
            }
        })
        .collect();
    (rungs, apexes)
}

/// The relative length error of every side of the sheet, edges of its border first, then rungs.
pub fn length_errors(sheet: &Sheet, flat: &Flattened) -> Vec<f64> {
    let surface = sheet.surface();
    surface
        .connectivity()
        .sides()
        .map(|[a, b]| {
            let space = surface.length(a, b);
            (flat.points[a.get()].distance(flat.points[b.get()]) - space).abs() / space
        })
        .collect()
}

/// The area of a surface, mm².
pub fn area_space(surface: &Surface) -> f64 {
    (0..surface.connectivity().triangles().len())
        .map(|n| surface.area_vector(TriangleIndex::new(n)).length())
        .sum()
}

/// The area of a pattern, mm²: of its triangles, so that what overlaps counts twice.
pub fn area_flat(sheet: &Sheet, flat: &Flattened) -> f64 {
    sheet
        .surface()
        .connectivity()
        .triangles()
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|s| flat.points[s.get()]);
            0.5 * (b - a).perp_dot(c - a)
        })
        .sum()
}
