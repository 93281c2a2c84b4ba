//! Readers of meshes: OBJ, STL, PLY and glTF binary, one module per format.
//!
//! Every reader hands its polygons to a [`Builder`], which sorts them into groups, splits those
//! with more than three corners, those that are there twice alike, welds corners where the format
//! does not share them, and leaves out triangles with coinciding corners. The kernel checks whether
//! the rest is a surface.
//!
//! The readers use no crate. The crates that were tried (tobj 4.0, stl_io 0.8, ply-rs-bw 2.0, gltf
//! 1.4) give no line or offset of an error; tobj splits a polygon that is not convex into triangles
//! that overlap; ply-rs-bw allocates any size that a header states; and gltf reads an accessor that
//! leaves its buffer as an absent one.

mod build;
mod doubled;
mod glb;
mod limited;
mod obj;
mod ply;
mod polygon;
mod said;
pub(crate) mod scan;
mod stl;

use crate::names::OwnNames;
use crate::reading::{InputError, ReadOptions, display_name, stem, without_utf16};
use crate::units::Units;
pub(crate) use build::Builder;
use build::{AllBuilt, Built};
pub use said::units_said;
use sheetwright::design::{Design, DesignPanel, PanelMesh, PanelShape, Triangles};
use sheetwright::flatten::Aim;
use sheetwright::index::VertexIndex;
use sheetwright::math::Point3;
use sheetwright::mesh::MAX_TRIANGLES;
use std::sync::Arc;

/// Formats of meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// Wavefront OBJ, `*.obj`: one panel per group.
    Obj,
    /// STL, `*.stl`, as text or binary: one panel per solid.
    Stl,
    /// PLY, `*.ply`, as text or binary of either order: one panel.
    Ply,
    /// glTF in one binary file, `*.glb`: one panel per node with a mesh.
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

/// The hint for a file without a surface.
const NO_SURFACE: &str =
    "Export the surface as a mesh of triangles or polygons; curves and points can't be laid flat.";

/// How designs, reports and the command line name an aim.
pub(crate) const fn aim_name(aim: Aim) -> &'static str {
    match aim {
        Aim::Mean => "mean",
        Aim::Max => "max",
        Aim::Seams => "seams",
    }
}

/// The number of samples of a panel that is a mesh, where it has no meaning.
pub(crate) const NO_SAMPLES: usize = 0;

/// The mesh in some bytes as a design: one panel per group, no material; and how many lines of the
/// file are seams all the way. `name` is the name of their file, or `-`.
///
/// # Errors
/// Bytes that are no mesh of this format, or a mesh above the limits.
pub(crate) fn read(
    format: MeshFormat,
    bytes: &[u8],
    name: &str,
    options: &ReadOptions,
) -> Result<(Design, usize), InputError> {
    let units = options.units.or_else(|| units_said(bytes)).unwrap_or_default();
    let (groups, seam_lines) = groups(format, bytes, name, units)?;
    let panel = |MeshGroup { name, triangles, seams }: MeshGroup| {
        let mesh = PanelMesh { seams: Arc::new(seams), ..PanelMesh::new(triangles) };
        let mesh = options.mesh.applied(mesh);
        DesignPanel::new(name, PanelShape::Mesh(mesh), NO_SAMPLES)
    };
    let panels = groups.into_iter().map(panel).collect();
    let design = Design { name: stem(name), panels, ..Design::default() };
    Ok((design, seam_lines))
}

/// A group of a mesh file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MeshGroup {
    pub(crate) name: String,
    pub(crate) triangles: Triangles,
    /// Ways along sides of its triangles, mm, that are to be cut.
    pub(crate) seams: Vec<Vec<Point3>>,
}

/// The groups of a mesh in some bytes, each with a name of its own; and how many lines of the file
/// are seams all the way.
///
/// # Errors
/// Bytes that are no mesh of this format, or a mesh above the limits.
pub(crate) fn groups(
    format: MeshFormat,
    bytes: &[u8],
    name: &str,
    units: Units,
) -> Result<(Vec<MeshGroup>, usize), InputError> {
    let place = display_name(name);
    let mut builder = Builder::new(place, &stem(name), units.in_mm());
    // Of a binary file, no header begins with the mark of UTF-16.
    let bytes = &*without_utf16(bytes);
    match format {
        MeshFormat::Obj => obj::read(bytes, place, &mut builder)?,
        MeshFormat::Stl => stl::read(bytes, place, &mut builder)?,
        MeshFormat::Ply => ply::read(bytes, place, &mut builder)?,
        MeshFormat::Glb => glb::read(bytes, place, &mut builder)?,
    }
    let mut taken = OwnNames::default();
    let group = |group: Built| {
        let group = group.named();
        MeshGroup { name: taken.take(&group.name, ' '), ..group }
    };
    let AllBuilt { groups, seam_lines } = builder.built()?;
    Ok((groups.into_iter().map(group).collect(), seam_lines))
}

impl Built {
    /// Its name, its triangles and its seams.
    pub(crate) fn named(self) -> MeshGroup {
        let Self { name, positions, triangles, seams, left_out } = self;
        let triangles = triangles.into_iter().map(|t| t.map(VertexIndex::new)).collect();
        let way = |run: Vec<usize>| run.into_iter().map(|n| positions[n]).collect();
        let seams = seams.into_iter().map(way).collect();
        let triangles = Triangles { positions, triangles, left_out };
        MeshGroup { name, triangles, seams }
    }
}

/// The error for a mesh above the limit of points or triangles.
fn too_many(place: impl Into<String>) -> InputError {
    InputError::at(
        place,
        format!("the mesh has more than {MAX_TRIANGLES} points or triangles"),
        "Export it with fewer triangles; ten thousand are enough for most shapes.",
    )
}

#[cfg(test)]
mod tests;
