//! Cuts that let a mesh lie flat, as far as they serve \[GuGortlerHoppe2002\].
//!
//! The shortest cut opens a closed mesh, and may be far too short for it to lie flat: two spikes of
//! a scan that stand side by side are joined by a cut of 2 mm. How much a flat form must scale says
//! so before anything is laid flat: the scale of the conformal form, one small linear system
//! (`flatten::conformal_scales`). The cut goes on to the vertex of the largest scale, by the
//! shortest way, until the scale is small or no longer gets smaller. A surface whose border is so
//! small that it is nearly closed is cut likewise.
//!
//! Where all that bends a mesh is a few corners, as of a solid with flat or rolled sides, the cut
//! goes through all of them. Nothing is left to stretch then, and a shorter cut saves little. So it
//! goes to the point of a cone with an open base, which is a disk, if the cone is poor without.

use crate::flatten::conformal_scales;
use crate::mesh::{
    Cut, Mesh, SCORED_CREASE_DEG, angle_defects, crease_angles, cut_through, cut_to_disk,
    worst_points,
};
use crate::sheet::cut_along;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::from_deg;
use sheetwright_geometry::watch::Watch;
use std::f64::consts::LN_10;

/// A form that scales by 1.5 at the most, the logarithm, is near enough to lie flat as it is.
const SMALL: f64 = 0.405;
/// A surface with a border is cut on where its form scales by more than 10, its logarithm.
const NEARLY_CLOSED: f64 = LN_10;
/// The cut goes on so often at the most.
const MOST_ROUNDS: usize = 12;
/// A longer cut is worth it only if the scale without it is larger by this factor.
const WORTH: f64 = 1.1;
/// So few corners are all cut through: as many as those of a prism over an octagon.
const FEW: usize = 16;
/// A vertex is a corner if its angles miss a full turn by more than this, radians: coordinates of
/// six digits make a tenth of it.
const CORNER: f64 = 1e-4;
/// All that bends a cone is its point, if other angles miss less than this share of what its do.
const ROUNDED: f64 = 0.02;

/// The cut of a mesh of one component that is closed or has handles, or, if it has a border, is
/// nearly closed; none for another disk.
pub(super) fn opened(mesh: &Mesh, watch: &mut dyn Watch) -> Cut {
    let is_disk = mesh.components().first().is_some_and(|piece| piece.is_disk());
    let mut cut = cut_to_disk(mesh);
    let mut tried: Vec<(Cut, f64)> = Vec::new();
    while let Some((vertex, scale)) = worst(mesh, &cut) {
        tried.push((cut.clone(), scale));
        let is_fine = scale <= SMALL || (is_disk && tried.len() == 1 && scale <= NEARLY_CLOSED);
        let before = cut.len();
        cut_through(mesh, &mut cut, &[vertex]);
        if is_fine || tried.len() > MOST_ROUNDS || cut.len() == before || watch.stop() {
            break;
        }
    }
    let least = tried.iter().map(|(_, scale)| *scale).fold(f64::INFINITY, f64::min);
    let is_as_good = |(_, scale): &(Cut, f64)| *scale <= SMALL.max(WORTH * least);
    let best = tried.iter().position(is_as_good);
    let mut cut = best.map_or(cut, |n| tried.swap_remove(n).0);
    let corners = worst_points(mesh, CORNER);
    if !is_disk && corners.len() <= FEW {
        cut_through(mesh, &mut cut, &corners);
    }
    cut
}

/// The point of a mesh that is a smooth cone; `None` of any other, and of a pyramid, whose sides
/// are folded.
pub(super) fn smooth_point(mesh: &Mesh) -> Option<VertexIndex> {
    let points = worst_points(mesh, CORNER);
    let (&point, others) = points.split_first()?;
    let defects = angle_defects(mesh);
    let of = |point: VertexIndex| defects[point.get()];
    let is_cone = of(point) > 0.0 && others.iter().all(|&n| of(n).abs() < ROUNDED * of(point));
    let creases = mesh.edges().iter().zip(crease_angles(mesh));
    let mut at_point = creases.filter(|(edge, _)| edge.ends.contains(&point));
    let is_smooth = at_point.all(|(_, crease)| crease <= from_deg(SCORED_CREASE_DEG));
    (is_cone && is_smooth).then_some(point)
}

/// The vertex of the mesh at which the conformal form of its sheet scales most, and the logarithm
/// of that scale; `None` where there is no such form.
fn worst(mesh: &Mesh, cut: &Cut) -> Option<(VertexIndex, f64)> {
    let sheet = cut_along(mesh, cut).ok()?;
    let scales = conformal_scales(sheet.mesh()).ok()??;
    let worst = (0..scales.len()).reduce(|a, b| if scales[b] > scales[a] { b } else { a })?;
    scales[worst].is_finite().then(|| (sheet.origin(VertexIndex::new(worst)), scales[worst]))
}
