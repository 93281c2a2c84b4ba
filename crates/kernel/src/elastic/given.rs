//! What a real sheet does whose surface was given as a mesh: the strain that decides the verdict.
//!
//! The sheet is that of the pattern, its border held where the mesh has it, by its length on the
//! pattern. So one way judges all surfaces, and how a surface was divided into triangles does not
//! matter.
//!
//! 1. Sharp creases that divide the mesh are scored: the sheet is held along them.
//! 2. A mesh with points inside its border says more of the surface than its border does. Its sheet
//!    may leave it by as much as sheet leaves a ruled surface, and no farther.
//! 3. The pattern of such a mesh may be fitted to its sheet, if that would need force (`fit`).
//! 4. Where no sheet can be computed, a strip (no points inside its border) is judged by the
//!    formula of `screen`, with the turn of its facing along its sides as the warp.
//! 5. Where the triangles of the pattern are stretched by far more than the material takes, or by
//!    more than a theory of small strains holds for, their strain decides. So it does where no
//!    sheet can be computed, with its doubt.

use super::predict::{FLAT, by_nets, stiffness_of, thickest_mm};
use super::screen::by_formula;
use super::{
    Basis, DECIDES, Elastic, ElasticError, ElasticOptions, Predicted, at_share,
    curvature_of_surface, elastic,
};
use crate::flatten::Flattened;
use crate::material::{EASY_SHARE, Limits, Material};
use crate::measure::{Distortion, area_flat};
use crate::mesh::{Mesh, SCORED_CREASE_DEG, crease_angles};
use crate::sheet::{Sheet, split_along_creases};
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::{Vec3, angle_between, from_deg};
use sheetwright_geometry::watch::Watch;
use std::borrow::Cow;

/// How far a sheet may leave a surface that has points inside its border, as a share of its size:
/// as thin sheet leaves ruled surfaces, by 0.2 to 0.5 % in simulations.
const BAND: f64 = 0.005;
/// The largest strain for which a sheet is computed: the theory is one of small strains.
const SMALL: f64 = 0.05;
/// A pattern whose triangles are strained by so many times the limit is not computed either.
const BEYOND: f64 = 4.0;
/// A mesh may take so many times the steps of a surface that was found: it is farther from rest.
const PATIENCE: usize = 2;
/// A mesh is computed in so many pieces at the most: of more, creases are facets that are meant.
const MOST_PIECES: usize = 64;

/// Predicts the strain of a sheet whose surface is a mesh, and whose pattern may be fitted to it so
/// often. `None` where the watcher asks to stop.
pub fn predict_given(
    sheet: &Sheet,
    flat: &Flattened,
    distortion: &Distortion,
    material: Option<&Material>,
    fits: usize,
    watch: &mut dyn Watch,
) -> Option<Predicted> {
    let area = area_flat(sheet, flat);
    let limits_at = |curvature: f64| Limits::of(material, area, curvature);
    let creases = crease_angles(sheet.mesh());
    if distortion.length_error_max <= FLAT && creases.iter().all(|&crease| crease <= FLAT) {
        return Some(Predicted::flat(limits_at(0.0)));
    }
    let strain = distortion.strain_p95(sheet.mesh());
    let most = SMALL.max(BEYOND * limits_at(0.0).strain);
    let folded = folded(sheet, flat).filter(|_| strain <= most);
    let Some((folded, flat)) = folded else {
        return Some(Predicted::of_pattern(limits_at(0.0), strain));
    };
    let curvature = curvature_of(&folded, &flat);
    let limits = limits_at(curvature);
    let size_mm = size_of(folded.mesh().positions().iter().copied());
    let on_border = folded.mesh().topology().on_border();
    let band_mm = on_border.contains(&false).then_some(BAND * size_mm);
    let is_one = folded.mesh().components().len() == 1;
    let fits = if band_mm.is_some() && is_one { fits } else { 0 };
    let mut at_rest =
        |limits: &Limits, options: &ElasticOptions| -> Result<Elastic, ElasticError> {
            let (most_steps, fitted) = (PATIENCE * options.most_steps, limits.strain * EASY_SHARE);
            let options = ElasticOptions { band_mm, most_steps, fits, fitted, ..*options };
            elastic(&folded, &flat, stiffness_of(limits, size_mm), &options, watch)
        };
    let predicted = by_nets(&limits, |options| at_rest(&limits, options));
    match predicted {
        Err(ElasticError::Stopped) => None,
        Err(error) if band_mm.is_none() => {
            Some(strip_by_formula(&folded, limits, curvature, error))
        }
        Err(_) => Some(Predicted::of_pattern(limits, strain)),
        Ok(predicted) if predicted.usage_range()[0] <= 1.0 => Some(predicted),
        Ok(predicted) => {
            let options = ElasticOptions { most_steps: 40, ..ElasticOptions::default() };
            let thickest_mm = thickest_mm(&limits, |limits| at_rest(limits, &options));
            Some(Predicted { thickest_mm, ..predicted })
        }
    }
}

/// Estimates the strain of a sheet whose surface is a mesh without computing one: that of the
/// triangles of the pattern, and of a strip by the formula of `screen`.
pub fn screen_given(
    sheet: &Sheet,
    flat: &Flattened,
    distortion: &Distortion,
    material: Option<&Material>,
) -> Predicted {
    let area = area_flat(sheet, flat);
    let strain = distortion.strain_p95(sheet.mesh());
    if sheet.mesh().topology().on_border().contains(&false) {
        return Predicted::of_pattern(Limits::of(material, area, 0.0), strain);
    }
    let curvature = curvature_of(sheet, flat);
    let limits = Limits::of(material, area, curvature);
    by_formula(limits, curvature, warp_squared(sheet.mesh()))
}

/// The sheet cut along the sharp creases that divide it; `None` where it falls into many pieces.
fn folded<'a>(
    sheet: &'a Sheet,
    flat: &'a Flattened,
) -> Option<(Cow<'a, Sheet>, Cow<'a, Flattened>)> {
    let folded = split_along_creases(sheet.mesh(), from_deg(SCORED_CREASE_DEG)).ok()?;
    match folded.mesh().components().len() {
        1 => Some((Cow::Borrowed(sheet), Cow::Borrowed(flat))),
        pieces if pieces > MOST_PIECES => None,
        _ => {
            let vertices = (0..folded.mesh().positions().len()).map(VertexIndex::new);
            let points = vertices.map(|v| flat.points[folded.origin(v).get()]).collect();
            Some((Cow::Owned(folded), Cow::Owned(Flattened { points, overlap: None })))
        }
    }
}

/// The curvature that 95 % of the area of a surface stays below, 1/mm: on a net, or by its creases
/// where there is none. Of two triangles that meet in a crease, it turns by the angle over half of
/// the width of both, which is their area over the length of the crease.
fn curvature_of(sheet: &Sheet, flat: &Flattened) -> f64 {
    curvature_of_surface(sheet, flat).unwrap_or_else(|| {
        let mesh = sheet.mesh();
        let (mut curvatures, mut areas) = (Vec::new(), Vec::new());
        for (edge, turn) in mesh.edges().iter().zip(crease_angles(mesh)) {
            let [Some(a), Some(b)] = edge.triangles else { continue };
            let area = mesh.area_vector(a).length() + mesh.area_vector(b).length();
            let [from, to] = edge.ends.map(|v| mesh.position(v));
            let bent = if turn > from_deg(SCORED_CREASE_DEG) { 0.0 } else { turn };
            curvatures.push(bent * from.distance(to) / area);
            areas.push(area);
        }
        at_share(&curvatures, &areas, DECIDES)
    })
}

/// What the formula predicts of a strip, whose lengths the pattern keeps.
fn strip_by_formula(
    sheet: &Sheet,
    limits: Limits,
    curvature: f64,
    error: ElasticError,
) -> Predicted {
    let basis = if error == ElasticError::NoNet { Basis::NoNet } else { Basis::NoRest };
    Predicted { basis, ..by_formula(limits, curvature, warp_squared(sheet.mesh())) }
}

/// The mean square of the warp of a strip, radians²: its facing turns by the warp from end to end
/// of a side between two of its triangles.
fn warp_squared(mesh: &Mesh) -> f64 {
    let mut facing = vec![Vec3::ZERO; mesh.positions().len()];
    for (n, corners) in mesh.triangles().iter().enumerate() {
        let normal = mesh.area_vector(TriangleIndex::new(n));
        corners.iter().for_each(|v| facing[v.get()] += normal);
    }
    let (mut squares, mut whole) = (0.0, 0.0);
    for edge in mesh.edges() {
        let [Some(a), Some(b)] = edge.triangles else { continue };
        let area = mesh.area_vector(a).length() + mesh.area_vector(b).length();
        let warp = angle_between(facing[edge.ends[0].get()], facing[edge.ends[1].get()]);
        squares += area * warp * warp;
        whole += area;
    }
    if whole > 0.0 { squares / whole } else { 0.0 }
}
