//! Plates that come as closed meshes: said so, and one of their skins alone where that is set.

use crate::check::FindingKind;
use crate::mesh::{Mesh, MeshError, Skin, two_skins};
use sheetwright_geometry::index::TriangleIndex;

/// A mesh of which plates may have come with two skins.
pub(super) struct Skinned {
    /// The mesh, of each plate that skin alone which is set.
    pub(super) mesh: Mesh,
    /// What is to be said of plates.
    pub(super) said: Option<FindingKind>,
    /// Of each of its bodies, whether it is such a plate.
    pub(super) plates: Vec<bool>,
}

/// A mesh, of each plate with two skins that skin alone which is set.
///
/// # Errors
/// See [`Mesh::part`].
pub(super) fn with_skin(mesh: Mesh, laid: Option<Skin>) -> Result<Skinned, MeshError> {
    let found = mesh.components().iter().map(|component| two_skins(&mesh, component));
    let found: Vec<_> = found.collect();
    let plates: Vec<bool> = found.iter().map(Option::is_some).collect();
    let Some(thickness_mm) = found.iter().flatten().map(|skins| skins.thickness_mm).next() else {
        return Ok(Skinned { mesh, said: laid.map(|_| FindingKind::NotTwoSkins), plates });
    };
    let count = found.iter().flatten().count();
    let bodies = plates.len();
    let said = Some(FindingKind::TwoSkins { count, bodies, thickness_mm, laid });
    let Some(laid) = laid else { return Ok(Skinned { mesh, said, plates }) };
    // Each triangle that is kept, with whether it is of a plate.
    let kept = mesh.components().iter().zip(found).map(|(component, skins)| match (skins, laid) {
        (None, _) => (component.triangles.clone(), false),
        (Some(skins), Skin::Outer) => (skins.triangles[0].clone(), true),
        (Some(skins), Skin::Inner) => (skins.triangles[1].clone(), true),
    });
    let mut kept: Vec<(TriangleIndex, bool)> =
        kept.flat_map(|(kept, plate)| kept.into_iter().map(move |t| (t, plate))).collect();
    kept.sort_unstable();
    let triangles: Vec<TriangleIndex> = kept.iter().map(|&(triangle, _)| triangle).collect();
    let mesh = mesh.part(&triangles)?.0;
    let plates = mesh.components().iter().map(|body| kept[body.triangles[0].get()].1).collect();
    Ok(Skinned { mesh, said, plates })
}
