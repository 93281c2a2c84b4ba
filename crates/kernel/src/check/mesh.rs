//! Findings on a mesh that was laid flat, and its verdict: how much it must stretch.

use super::{Checked, EASY_SHARE, Finding, FindingKind, Place, SeamCause};
use crate::material::{Material, stretch_limit};
use crate::mesh::{CutMesh, Mesh, Specks, crease_angles};
use crate::pattern::SCORED_CREASE_DEG;
use sheetwright_geometry::math::{Point3, to_deg};

/// The border is true up to this share of a length.
const TRUE_BORDER: f64 = 1e-9;
/// Length errors below it, as a share, are rounding and no finding: less than any shop can measure.
const UNSEEN: f64 = 1e-6;

/// Everything known of a mesh panel when it is checked.
#[derive(Clone, Copy, Debug)]
pub struct MeshPanel<'a> {
    /// The mesh in space.
    pub mesh: &'a Mesh,
    /// The mesh as it is cut to lie flat.
    pub sheet: &'a CutMesh,
    /// The largest relative length error of a side, flat against space, without its sign.
    pub length_error_max: f64,
    /// The side with that error, by its number among those of the sheet.
    pub worst_edge: Option<usize>,
    /// The largest relative length error of the border's sides, where it was to be true.
    pub border_error: Option<f64>,
    /// A cut that would help, from inside or from a hole to the border: its ends, mm.
    pub cut: Option<[Point3; 2]>,
    /// Two sides of the border, by their first vertices on the sheet, between which it overlaps
    /// itself when it is flat.
    pub overlap: Option<[Point3; 2]>,
    /// Triangles that lie upside down when it is flat.
    pub flipped: usize,
    /// Triangles of the file that were left out, with two corners in one place.
    pub left_out: usize,
    /// Parts of it that were left out because they are too small to be sheet.
    pub specks: Option<Specks>,
    /// Points in which parts of it met that have no side in common there.
    pub contacts: usize,
    /// Cuts that were asked for, from the border to points inside.
    pub darts: usize,
    /// Its material, if one is named.
    pub material: Option<&'a Material>,
}

/// Checks a mesh panel.
pub fn check_mesh(panel: &MeshPanel<'_>) -> Checked {
    let checks = [stretch, border, overlap, flipped, folds, seams, left_out, specks, contacts];
    Checked::of(checks.iter().filter_map(|check| check(panel)).collect())
}

fn stretch(panel: &MeshPanel<'_>) -> Option<Finding> {
    let largest = panel.length_error_max;
    let limit = stretch_limit(panel.material);
    let sheet = panel.material.map(|m| m.title.clone());
    // Also for what is no number.
    let kind = if largest.is_nan() || largest > limit {
        FindingKind::StretchTooLarge {
            largest,
            limit,
            sheet,
            cut: panel.cut,
            has_darts: panel.darts > 0,
            has_creases: sharp_creases(panel).next().is_some(),
        }
    } else if largest > EASY_SHARE * limit {
        FindingKind::StretchHigh { largest, limit, sheet }
    } else if largest > UNSEEN {
        FindingKind::Stretch { largest }
    } else {
        return None;
    };
    let worst = panel.worst_edge.map(|n| {
        let [a, b] = panel.sheet.mesh.edges()[n].ends.map(|v| panel.sheet.mesh.position(v));
        Place::at(a.lerp(b, 0.5))
    });
    Some(Finding::new(kind, worst.unwrap_or_default()))
}

fn border(panel: &MeshPanel<'_>) -> Option<Finding> {
    let largest = panel.border_error.filter(|error| *error > TRUE_BORDER)?;
    Some(Finding::of_whole(FindingKind::BorderNotTrue { largest }))
}

fn overlap(panel: &MeshPanel<'_>) -> Option<Finding> {
    let at = panel.overlap?.to_vec();
    Some(Finding::new(FindingKind::Overlap, Place::Points { at }))
}

fn flipped(panel: &MeshPanel<'_>) -> Option<Finding> {
    let count = panel.flipped;
    (count > 0).then(|| Finding::of_whole(FindingKind::Flipped { count }))
}

/// The angles of all creases to be scored, radians.
fn sharp_creases(panel: &MeshPanel<'_>) -> impl Iterator<Item = f64> {
    let angles = crease_angles(&panel.sheet.mesh);
    angles.into_iter().filter(|&angle| to_deg(angle) > SCORED_CREASE_DEG)
}

fn folds(panel: &MeshPanel<'_>) -> Option<Finding> {
    let sharp: Vec<f64> = sharp_creases(panel).collect();
    let sharpest = sharp.iter().copied().reduce(f64::max)?;
    let stiff = panel.material.filter(|m| !m.folds()).map(|m| m.title.clone());
    Some(Finding::of_whole(FindingKind::Creases { count: sharp.len(), sharpest, stiff }))
}

fn seams(panel: &MeshPanel<'_>) -> Option<Finding> {
    let sheet = panel.sheet;
    let lengths = sheet.seams.iter().map(|seam| seam_length(&sheet.mesh, seam));
    let (count, length_mm) = (lengths.len(), lengths.sum());
    let why = if panel.mesh.loops().is_empty() {
        SeamCause::Closed
    } else if panel.darts > 0 {
        SeamCause::Darts
    } else {
        SeamCause::NotFlat
    };
    let kind = FindingKind::Seams { count, length_mm, why };
    (count > 0).then(|| Finding::new(kind, Place::MeshSeams { count }))
}

/// How long a seam is in space, mm.
pub fn seam_length(sheet: &Mesh, seam: &crate::mesh::MeshSeam) -> f64 {
    let way = seam.sides[0].windows(2);
    way.map(|pair| sheet.position(pair[0]).distance(sheet.position(pair[1]))).sum()
}

fn left_out(panel: &MeshPanel<'_>) -> Option<Finding> {
    let count = panel.left_out;
    (count > 0).then(|| Finding::of_whole(FindingKind::TrianglesLeftOut { count }))
}

fn specks(panel: &MeshPanel<'_>) -> Option<Finding> {
    let Specks { parts: count, first } = panel.specks?;
    Some(Finding::new(FindingKind::PartsLeftOut { count }, Place::at(first)))
}

fn contacts(panel: &MeshPanel<'_>) -> Option<Finding> {
    let count = panel.contacts;
    (count > 0).then(|| Finding::of_whole(FindingKind::PointContacts { count }))
}
