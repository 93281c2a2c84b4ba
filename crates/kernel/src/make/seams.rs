//! Meshes with seams that their makers chose.
//!
//! Seams that enclose a part take the mesh apart there. What is left within a piece is cut first of
//! all, and the piece then counts as a surface with that border: it is cut on only where this does
//! not let it lie flat (`opened`).

use super::opened::opened;
use crate::mesh::{Component, Cut, Mesh, MeshError};
use crate::sheet::{Sheet, cut_along};
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::watch::Watch;

/// A side by a triangle and its corners at which the side starts and ends.
pub(super) type Side = (usize, [usize; 2]);

/// The side between two vertices, from the first to the second.
pub(super) fn side(mesh: &Mesh, ends: [VertexIndex; 2]) -> Option<Side> {
    let n = mesh.topology().edge_between(ends[0], ends[1])?;
    let triangle = mesh.edges()[n].triangles.into_iter().flatten().next()?.get();
    let corner = |v: VertexIndex| mesh.triangles()[triangle].iter().position(|&c| c == v);
    Some((triangle, [corner(ends[0])?, corner(ends[1])?]))
}

/// For each triangle of a mesh the component of `apart`, which is that mesh cut, and its place
/// there.
pub(super) fn places(whole: &Mesh, apart: &Mesh) -> Vec<(usize, usize)> {
    let mut places = vec![(0, 0); whole.triangles().len()];
    for (n, piece) in apart.components().iter().enumerate() {
        for (k, triangle) in piece.triangles.iter().enumerate() {
            places[triangle.get()] = (n, k);
        }
    }
    places
}

/// The seams within each component of `apart`, which is a mesh cut along some of its `seams`, by
/// the triangles of the component.
pub(super) fn seams_within(whole: &Mesh, seams: &Cut, apart: &Mesh) -> Vec<Vec<Side>> {
    let mut within: Vec<Vec<Side>> = apart.components().iter().map(|_| Vec::new()).collect();
    if seams.is_empty() {
        return within;
    }
    let places = places(whole, apart);
    let at = |triangle: TriangleIndex| places[triangle.get()];
    for edge in seams.iter().map(|&n| &whole.edges()[n]) {
        let [Some(a), Some(b)] = edge.triangles else { continue };
        if let (true, Some((triangle, ends))) = (at(a).0 == at(b).0, side(whole, edge.ends)) {
            let (piece, triangle) = places[triangle];
            within[piece].push((triangle, ends));
        }
    }
    within
}

/// A mesh of one component as its seams leave it.
pub(super) struct Sewn<'a> {
    mesh: &'a Mesh,
    seams: Cut,
    /// The mesh cut along them; `None` without any.
    cut: Option<Sheet>,
}

impl<'a> Sewn<'a> {
    pub(super) fn of(mesh: &'a Mesh, sides: &[Side]) -> Result<Self, MeshError> {
        let ends = |&(triangle, ends): &Side| ends.map(|k| mesh.triangles()[triangle][k]);
        let sides = sides.iter().map(ends);
        let found = sides.filter_map(|[from, to]| mesh.topology().edge_between(from, to));
        let seams = without_single(mesh, found.collect());
        let cut = (!seams.is_empty()).then(|| cut_along(mesh, &seams)).transpose()?;
        Ok(Self { mesh, seams, cut })
    }

    /// The shape that it has with its seams cut.
    pub(super) fn component(&self) -> &Component {
        &self.cut.as_ref().map_or(self.mesh, Sheet::mesh).components()[0]
    }

    /// Its seams.
    pub(super) fn seams(&self) -> Cut {
        self.seams.clone()
    }

    /// Its seams, and what is cut beside them so that it lies flat.
    pub(super) fn opened(&self, watch: &mut dyn Watch) -> Cut {
        let Some(sheet) = &self.cut else { return opened(self.mesh, watch) };
        let more = opened(sheet.mesh(), watch);
        let ends = more.iter().map(|&n| sheet.mesh().edges()[n].ends.map(|v| sheet.origin(v)));
        let more = ends.filter_map(|[a, b]| self.mesh.topology().edge_between(a, b));
        self.seams.iter().copied().chain(more).collect()
    }
}

/// The cut without sides by themselves inside the mesh: a cut along one side opens nothing.
fn without_single(mesh: &Mesh, mut cut: Cut) -> Cut {
    let mut is_end = mesh.topology().on_border();
    let mut count = vec![0; mesh.positions().len()];
    for &n in &cut {
        mesh.edges()[n].ends.iter().for_each(|end| count[end.get()] += 1);
    }
    count.iter().enumerate().filter(|(_, count)| **count > 1).for_each(|(v, _)| is_end[v] = true);
    cut.retain(|&n| mesh.edges()[n].ends.iter().any(|end| is_end[end.get()]));
    cut
}
