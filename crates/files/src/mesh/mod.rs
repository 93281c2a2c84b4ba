//! Meshes from elsewhere: OBJ, STL, PLY and glTF binary, one module a format.
//!
//! Every reader hands its polygons to a [`Builder`], which sorts them into groups, splits those
//! with more than three corners, welds where the format can't say which corners are one, and leaves
//! out what is no triangle. What remains is for the kernel to judge: whether it is a surface at
//! all.
//!
//! The readers are our own lines. The crates that were tried (tobj 4.0, stl_io 0.8, ply-rs-bw 2.0,
//! gltf 1.4) name no line or offset of what is broken, tobj splits a polygon that is not convex
//! into triangles that overlap, ply-rs-bw takes the memory that a header of 100 bytes asks for, and
//! gltf reads an accessor that leaves its buffer as none at all.

mod build;
mod glb;
mod obj;
mod ply;
mod polygon;
mod scan;
mod stl;

use crate::names::folded;
use crate::reading::{InputError, ReadOptions, display_name, stem};
use build::Builder;
use sheetwright::design::{MeshDesign, MeshGroup};
use sheetwright::index::VertexIndex;
use sheetwright::mesh::MAX_TRIANGLES;
use std::collections::BTreeSet;

/// Formats of meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// Wavefront OBJ, `*.obj`: a panel a group.
    Obj,
    /// STL, `*.stl`, as text or binary: a panel a solid.
    Stl,
    /// PLY, `*.ply`, as text or binary of either order: one panel.
    Ply,
    /// glTF in one binary file, `*.glb`: a panel a node with a mesh.
    Glb,
}

impl MeshFormat {
    /// Every format.
    pub const ALL: [Self; 4] = [Self::Obj, Self::Stl, Self::Ply, Self::Glb];

    /// The ending of its files, in small letters.
    pub const fn ending(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Stl => "stl",
            Self::Ply => "ply",
            Self::Glb => "glb",
        }
    }

    /// The format of an ending in small letters.
    pub fn of_ending(ending: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.ending() == ending)
    }
}

/// What to do about a file that has no surface in it.
const NO_SURFACE: &str =
    "Export the surface as a mesh of triangles or polygons; curves and points can't be laid flat.";

/// The mesh in some bytes, a panel a group and no material. `name` is the name of the file they are
/// from, or `-`.
///
/// # Errors
/// Bytes that are no mesh of this format, or too large a one.
pub(crate) fn read(
    format: MeshFormat,
    bytes: &[u8],
    name: &str,
    options: &ReadOptions,
) -> Result<MeshDesign, InputError> {
    let place = display_name(name);
    let stem = stem(name);
    let mut builder = Builder::new(place, &stem, options.units.unwrap_or_default().in_mm());
    match format {
        MeshFormat::Obj => obj::read(bytes, place, &mut builder)?,
        MeshFormat::Stl => stl::read(bytes, place, &mut builder)?,
        MeshFormat::Ply => ply::read(bytes, place, &mut builder)?,
        MeshFormat::Glb => glb::read(bytes, place, &mut builder)?,
    }
    let built = builder.built()?;
    let mut taken = BTreeSet::new();
    let groups = built.into_iter().map(|group| MeshGroup {
        name: of_its_own(group.name, &mut taken),
        positions: group.positions,
        triangles: group.triangles.into_iter().map(|t| t.map(VertexIndex::new)).collect(),
        left_out: group.left_out,
    });
    Ok(MeshDesign { name: stem, material: None, groups: groups.collect() })
}

/// The name, with a number where another group has it.
fn of_its_own(name: String, taken: &mut BTreeSet<String>) -> String {
    let numbered = (2..).map(|n| format!("{name} {n}"));
    let mut names = std::iter::once(name.clone()).chain(numbered);
    names.find(|name| taken.insert(folded(name))).unwrap_or(name)
}

/// The error for more triangles than are taken.
fn too_many(place: impl Into<String>) -> InputError {
    InputError::at(
        place,
        format!("the mesh has more than {MAX_TRIANGLES} points or triangles"),
        "Export it more coarsely: some ten thousand triangles show most shapes well.",
    )
}

#[cfg(test)]
mod tests;
