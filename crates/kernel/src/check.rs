//! Findings on a part, each with its kind, its place and its severity; and the verdict.

mod bending;
mod brake;
mod bulge;
mod code;
mod finding;
mod kind;
mod numbers;
mod origin;
mod place;
mod remedy;
mod severity;
mod strain;
mod stretching;
mod unfair;
mod verdict;

pub use brake::braking;
pub use finding::{Checked, Finding};
pub use kind::FindingKind;
pub use numbers::{
    Bend, CutWay, Division, Hindrance, MeshSetting, Movement, PointReach, SeamCause, TooTight,
};
pub use place::{BorderSide, LinePlace, Place, SeamPlace};
pub use remedy::Remedy;
pub use severity::Severity;
pub use verdict::Verdict;

pub(crate) use bending::{better_without_plane, no_other_surface, sheet_too_thick, two_surfaces};
pub(crate) use brake::mitred_folds;
pub(crate) use bulge::spline_bulge;
pub(crate) use origin::{
    BoundaryMoved, moved, off_tolerance, ran_on, rounded_corner, smoothed_joints, stayed_straight,
    turned_round,
};
pub(crate) use strain::{bends_divided, divided_in_vain, strain_not_reached};
pub(crate) use unfair::unfair_line;

use crate::elastic::Predicted;
use crate::flatten::Flattened;
use crate::material::Material;
use crate::measure::Measures;
use crate::mesh::{Healing, Mesh, Specks};
use crate::nets::Coarseness;
use crate::sheet::Sheet;
use sheetwright_geometry::boundary::Boundary;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::Point3;
use sheetwright_geometry::tolerance::Tolerance;
use sheetwright_optimum::triangulate::Triangulation;

/// A part with everything that its check needs.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// Its sheet.
    pub sheet: &'a Sheet,
    /// Its flat pattern.
    pub flat: &'a Flattened,
    /// Its measures.
    pub measures: &'a Measures,
    /// The strain that it is predicted to have; `None` of one triangle that was found.
    pub predicted: Option<&'a Predicted>,
    /// Its material, if one is named.
    pub material: Option<&'a Material>,
    /// The boundary or the mesh that it came from.
    pub from: CheckedFrom<'a>,
}

/// The boundary or the mesh of a part.
#[derive(Clone, Copy, Debug)]
pub enum CheckedFrom<'a> {
    /// A boundary, whose surface was found.
    Boundary(&'a Boundary, &'a Triangulation),
    /// A mesh.
    Mesh(MeshOrigin<'a>),
}

/// A mesh, and how it was read and laid flat.
#[derive(Clone, Copy, Debug)]
pub struct MeshOrigin<'a> {
    /// The mesh before it was cut.
    pub mesh: &'a Mesh,
    /// Whether the aim was a border of exact lengths.
    pub keeps_border: bool,
    /// A cut that would help, from inside or from a hole to the border: its ends, mm.
    pub suggested_cut: Option<[Point3; 2]>,
    /// Triangles that lie upside down when it is flat.
    pub flipped: usize,
    /// Triangles of the file that were left out, with two corners in one place.
    pub left_out: usize,
    /// Parts of it that were left out because they are too small to be sheet.
    pub specks: Option<Specks>,
    /// What was wrong with the triangles of its file, and is healed.
    pub healings: &'a [Healing],
    /// What was found of two skins, if it was looked for or found.
    pub skins: Option<&'a FindingKind>,
    /// Points in which parts of it met that have no side in common there.
    pub contacts: usize,
    /// Why it is cut open, if it is.
    pub cut_for: SeamCause,
    /// The net that it is a piece of; `None` of a mesh that is laid flat as a surface.
    pub net: Option<NetOrigin>,
}

/// A piece of a net of facets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NetOrigin {
    /// Why the mesh is folded by itself, if it is; told of its first piece alone.
    pub meant: Option<FacetsMeant>,
}

/// Why the facets of a mesh are folded without being asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacetsMeant {
    /// How coarse it is.
    pub coarse: Coarseness,
    /// Whether as one surface it would bend, but its pattern overlap itself.
    pub overlaps: bool,
}

/// Checks a part.
pub fn check(part: &Subject<'_>) -> Checked {
    Checked::of(match part.from {
        CheckedFrom::Boundary(boundary, triangulation) => {
            bending::findings(&bending::Panel { part, boundary, triangulation })
        }
        CheckedFrom::Mesh(origin) => stretching::findings(&stretching::Panel { part, origin }),
    })
}

/// Checks the strain of a part anew, once a better prediction of it is known.
pub(crate) fn check_strain(
    checked: &mut Checked,
    predicted: &Predicted,
    measures: &Measures,
    material: Option<&Material>,
) {
    checked.predicted_again(strain::findings(Some(predicted), measures, material));
}

/// The finding that a written pattern does not fold back onto its surface; `None` if it does.
/// `error_mm` is its refold error, `size_mm` the size of the boundary, `known_mm` the refold error
/// of the pattern in memory if its lengths are not exact, else 0.
pub fn refolding(error_mm: f64, size_mm: f64, known_mm: f64) -> Option<Finding> {
    let limit_mm = Tolerance::REFOLD.length_mm(size_mm) + known_mm;
    let is_off = error_mm.is_nan() || error_mm > limit_mm;
    is_off.then(|| Finding::of_whole(FindingKind::Refold { error_mm, limit_mm }))
}

/// The title of the material.
fn title(material: Option<&Material>) -> Option<String> {
    material.map(|m| m.title.clone())
}

/// A side of the border, by the vertex of the sheet that it begins at, with the samples that its
/// ends are. Both sides of a cut may begin at one sample, so a side is named by both ends.
fn border_side(sheet: &Sheet, from: usize) -> BorderSide {
    let from = VertexIndex::new(from);
    let ends = [from, sheet.next_on_border(from).unwrap_or(from)];
    BorderSide { corners: ends.map(VertexIndex::get), samples: ends.map(|v| sheet.sample(v)) }
}

/// The finding that a pattern overlaps itself.
fn overlap(part: &Subject<'_>) -> Option<Finding> {
    let (a, b) = part.flat.overlap?;
    let place = match part.from {
        CheckedFrom::Boundary(..) => {
            Place::Sides { sides: [a, b].map(|n| border_side(part.sheet, n)).to_vec() }
        }
        CheckedFrom::Mesh(_) => {
            let at = |n: usize| part.sheet.mesh().position(VertexIndex::new(n));
            Place::Points { at: vec![at(a), at(b)] }
        }
    };
    Some(Finding::new(FindingKind::Overlap, place))
}

/// The finding that the pattern is cut open along seams, and why.
fn seams(part: &Subject<'_>, why: SeamCause) -> Option<Finding> {
    let seams = part.sheet.seams();
    let length_mm = seams.iter().map(|seam| seam.length_mm).sum();
    let kind = FindingKind::Seams { count: seams.len(), length_mm, why };
    (!seams.is_empty()).then(|| Finding::new(kind, Place::seams(part.sheet, |_| true)))
}
