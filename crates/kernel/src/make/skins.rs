//! Plates that come as closed meshes: said so, and one of their skins alone where that is set.

use crate::check::FindingKind;
use crate::mesh::{Mesh, MeshError, Skin, two_skins};
use sheetwright_geometry::index::TriangleIndex;

/// A mesh, of each plate with two skins that skin alone which is set; and what is to be said of it.
///
/// # Errors
/// See [`Mesh::part`].
pub(super) fn with_skin(
    mesh: Mesh,
    laid: Option<Skin>,
) -> Result<(Mesh, Option<FindingKind>), MeshError> {
    let found = mesh.components().iter().map(|component| two_skins(&mesh, component));
    let found: Vec<_> = found.collect();
    let Some(thickness_mm) = found.iter().flatten().map(|skins| skins.thickness_mm).next() else {
        return Ok((mesh, laid.map(|_| FindingKind::NotTwoSkins)));
    };
    let count = found.iter().flatten().count();
    let said = FindingKind::TwoSkins { count, thickness_mm, laid };
    let Some(laid) = laid else { return Ok((mesh, Some(said))) };
    let kept = mesh.components().iter().zip(found).map(|(component, skins)| match (skins, laid) {
        (None, _) => component.triangles.clone(),
        (Some(skins), Skin::Outer) => skins.triangles[0].clone(),
        (Some(skins), Skin::Inner) => skins.triangles[1].clone(),
    });
    let mut kept: Vec<TriangleIndex> = kept.flatten().collect();
    kept.sort_unstable();
    Ok((mesh.part(&kept)?.0, Some(said)))
}
