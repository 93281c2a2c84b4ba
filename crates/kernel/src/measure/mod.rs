//! The catalogue of quantities that are measured on a surface and its flat pattern.
//!
//! | quantity | meaning | unit |
//! |---|---|---|
//! | twist w of a rung | 1 − cosine of the angle between the tangent planes at its ends | none |
//! | warp angle of a rung | that angle | radians |
//! | resolution of a rung | how much of its warp angle may come from the sampling | radians |
//! | ruling beside a rung | whether there is one within a sample of it | none |
//! | crease of a rung | angle between its two triangles, positive for a mountain | radians |
//! | fold | whether a crease stands alone: a sharp fold, no part of a smooth bend | none |
//! | bend radius at a rung | how tightly the sheet is rolled across it, at its tighter end | mm |
//! | length error of a side | \|flat − space\| / space; of a mesh's, signed | none |
//! | stretch of a triangle | how much longer a direction is flat; largest, smallest | none |
//! | strain of a triangle | by how much its stretches differ from 1 at most | none |
//! | area | of the triangles, in space and flat | mm² |
//! | Gauss image | normals along the rungs, as points on the unit sphere | none |
//! | its area | how much of that sphere they sweep, 0 for a developable surface | steradians |

mod apex;
mod bend;
mod crossing;
mod distortion;
mod gauss;
mod rulings;

pub use apex::Apex;
pub(crate) use crossing::crosses_itself;
use crossing::first_self_crossing;
pub use distortion::{CutSuggestion, Distortion, cut_suggestion, distortion};
pub use gauss::gauss_area;

use crate::flatten::Flattened;
use crate::mesh::{Mesh, crease_angles};
use crate::sheet::Sheet;
use crate::surface::Surface;
use bend::{Rolls, rolls};
use gauss::gauss_area_of_mesh;
use rulings::Rulings;
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::{Point3, Vec3, to_deg};
use sheetwright_optimum::cost::Prices;
use sheetwright_optimum::rung::Rung;

/// Creases above this angle, degrees, are lines to bend or score along, not parts of a smooth bend:
/// the creases of a bend of 90° divided into 18, the coarsest that workshops make.
pub const SHARP_CREASE_DEG: f64 = 5.0;

/// Creases up to this angle, radians, do not bend the sheet: numbers of 16 digits make such ones on
/// a plate.
const FLAT_CREASE: f64 = 1e-9;

/// The measures of one rung.
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
    /// Whether a ruling lies within a sample of it: one of the four rungs from one of its ends to
    /// a sample beside the other is warped the other way, so that one between is not warped at all;
    /// or it cuts off a single sample. So it is at the rungs of a developable surface, however few
    /// its samples are.
    pub has_ruling_beside: bool,
    /// The angle between the two triangles, radians, positive for a mountain as seen from the side
    /// that the surface faces.
    pub crease: f64,
    /// Whether the crease is a fold: above [`SHARP_CREASE_DEG`], and more than twice as large as
    /// those of the rungs around it together, so that no finer sampling would divide it.
    pub is_fold: bool,
    /// Whether the sheet needs the fold, so that the pattern has it scored. Until a prediction
    /// says more, every fold counts as needed.
    pub is_scored: bool,
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

    /// The warp angle of the surface there, radians: none where a ruling lies beside it.
    pub fn warp_of_surface(&self) -> f64 {
        if self.has_ruling_beside { 0.0 } else { self.warp }
    }

    /// Whether the sheet bends along it; smaller creases come from rounding.
    pub fn bends(&self) -> bool {
        self.crease.abs() > FLAT_CREASE
    }
}

/// The measures of one part. A mesh has no rungs, so the measures of rungs are 0 there;
/// [`Distortion`] is measured of meshes alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Measures {
    /// The rungs, in increasing order: along a strip between two rails, from one end to the other.
    pub rungs: Vec<RungMeasures>,
    /// W: the sum of all w, without unit. It grows with the sampling; reports show warp angles
    /// first.
    pub twist_total: f64,
    /// The largest warp angle, radians; 0 without rungs.
    pub warp_max: f64,
    /// The mean warp angle over the rungs, radians; 0 without rungs.
    pub warp_mean: f64,
    /// The largest angle between two triangles of the sheet, radians; 0 of one triangle.
    pub crease_max: f64,
    /// The smallest bend radius, apexes and folds aside, mm; infinite for a flat surface, and for a
    /// mesh, where it is not measured.
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
    /// Two triangles that pass through one another, if any do. Exact; not looked for in a mesh.
    pub self_crossing: Option<[TriangleIndex; 2]>,
    /// Of a mesh: how far it is from lying flat without stretching.
    pub distortion: Option<Distortion>,
}

impl Measures {
    /// Sets which folds are scored, by their rungs, in increasing order; whether that changes
    /// anything.
    pub(crate) fn score(&mut self, scored: &[usize]) -> bool {
        let mut is_new = false;
        for (n, rung) in self.rungs.iter_mut().enumerate() {
            let is_scored = rung.is_fold && scored.binary_search(&n).is_ok();
            is_new |= is_scored != rung.is_scored;
            rung.is_scored = is_scored;
        }
        is_new
    }
}

/// The surface that a sheet was cut from.
#[derive(Clone, Debug)]
pub enum CutFrom<'a> {
    /// A surface that was found, with the prices of the boundary that it spans.
    Surface(&'a Surface, &'a Prices),
    /// A mesh that was given, with the [`distortion`] of its sheet.
    Mesh(&'a Mesh, Distortion),
}

/// Measures a sheet, its flat pattern, and the surface that it was cut from. A rung that is cut is
/// measured as every other: the seam is joined in space.
pub fn measures(from: CutFrom<'_>, sheet: &Sheet, flat: &Flattened) -> Measures {
    match from {
        CutFrom::Surface(surface, prices) => measures_of_surface(surface, prices, sheet, flat),
        CutFrom::Mesh(mesh, distortion) => measures_of_mesh(mesh, distortion, sheet, flat),
    }
}

fn measures_of_mesh(
    mesh: &Mesh,
    distortion: Distortion,
    sheet: &Sheet,
    flat: &Flattened,
) -> Measures {
    Measures {
        rungs: Vec::new(),
        twist_total: 0.0,
        warp_max: 0.0,
        warp_mean: 0.0,
        crease_max: crease_angles(sheet.mesh()).into_iter().fold(0.0, f64::max),
        bend_radius_min_mm: f64::INFINITY,
        apexes: Vec::new(),
        gauss_area_sr: gauss_area_of_mesh(mesh),
        area_space_mm2: area_space(sheet),
        area_flat_mm2: area_flat(sheet, flat),
        length_error_max: distortion.length_error_max,
        length_error_mean: distortion.length_error_mean,
        self_crossing: None,
        distortion: Some(distortion),
    }
}

fn measures_of_surface(
    surface: &Surface,
    prices: &Prices,
    sheet: &Sheet,
    flat: &Flattened,
) -> Measures {
    let (rungs, apexes) = rungs_and_apexes(surface, prices);
    let most = |of: fn(&RungMeasures) -> f64| rungs.iter().map(of).fold(0.0, f64::max);
    let count = rungs.len().max(1) as f64;
    let errors: Vec<f64> =
        border_first(sheet).map(|ends| length_error(sheet, flat, ends).abs()).collect();
    Measures {
        twist_total: rungs.iter().map(|r| r.twist).sum(),
        warp_max: most(|r| r.warp),
        warp_mean: rungs.iter().map(|r| r.warp).sum::<f64>() / count,
        crease_max: most(|r| r.crease.abs()),
        bend_radius_min_mm: rungs.iter().map(|r| r.bend_radius_mm).fold(f64::INFINITY, f64::min),
        apexes,
        gauss_area_sr: gauss_area(surface.connectivity(), &rungs),
        area_space_mm2: area_space(sheet),
        area_flat_mm2: area_flat(sheet, flat),
        length_error_max: errors.iter().copied().fold(0.0, f64::max),
        length_error_mean: errors.iter().sum::<f64>() / errors.len() as f64,
        self_crossing: first_self_crossing(surface),
        distortion: None,
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
    let rulings = Rulings::new(surface, prices);
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
                has_ruling_beside: rulings.has_one_beside(rung),
                crease: creases[n],
                is_fold: is_fold[n],
                is_scored: is_fold[n],
                bend_radius_mm: radii_mm[low.get()].min(radii_mm[high.get()]),
                normals: planes.map_or([Vec3::ZERO; 2], |p| p.at_ends),
                middle: surface.position(low).lerp(surface.position(high), 0.5),
            }
        })
        .collect();
    (rungs, apexes)
}

/// The relative length error of every side of a sheet, signed, in the order of
/// [`Mesh::edges`]: positive where the pattern is longer.
pub fn length_errors(sheet: &Sheet, flat: &Flattened) -> Vec<f64> {
    sheet.mesh().edges().iter().map(|edge| length_error(sheet, flat, edge.ends)).collect()
}

fn length_error(sheet: &Sheet, flat: &Flattened, [a, b]: [VertexIndex; 2]) -> f64 {
    let space = sheet.mesh().position(a).distance(sheet.mesh().position(b));
    (flat.points[a.get()].distance(flat.points[b.get()]) - space) / space
}

/// The sides of a sheet: round its loops, and then those within. Sums are taken in this order.
fn border_first(sheet: &Sheet) -> impl Iterator<Item = [VertexIndex; 2]> + '_ {
    let within = sheet.mesh().edges().iter().filter(|edge| !edge.is_border());
    sheet.border_steps().chain(within.map(|edge| edge.ends))
}

/// The area of a sheet in space, mm².
pub fn area_space(sheet: &Sheet) -> f64 {
    let mesh = sheet.mesh();
    (0..mesh.triangles().len()).map(|n| mesh.area_vector(TriangleIndex::new(n)).length()).sum()
}

/// The area of a pattern, mm²: of its triangles, so that what overlaps counts twice.
pub fn area_flat(sheet: &Sheet, flat: &Flattened) -> f64 {
    let of_triangle = |t: &[VertexIndex; 3]| {
        let [a, b, c] = t.map(|v| flat.points[v.get()]);
        0.5 * (b - a).perp_dot(c - a)
    };
    sheet.mesh().triangles().iter().map(of_triangle).sum()
}
