//! Meshes whose facets are folded: divided into the pieces of a net, each laid flat exactly.

use super::part::Part;
use super::{MakeCause, MakeError};
use crate::check::{Finding, FindingKind, Verdict};
use crate::design::PanelMesh;
use crate::flatten::{Aim, Ended, FlattenError, Relaxed, unfold};
use crate::material::Material;
use crate::mesh::Mesh;
use crate::nets::{Coarseness, NetOptions, coarseness, net};
use crate::sheet::{Sheet, cut_along_lines};
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::watch::Watch;

/// A line along which a piece is cut without falling apart: of each step the triangle to its left,
/// and the corners of that at which it starts and ends.
type Slit = Vec<(usize, [usize; 2])>;

/// What a piece of a net is, beside its mesh.
#[derive(Clone, Debug)]
pub(super) struct NetPiece {
    slits: Vec<Slit>,
    /// The number of slits of the pieces before it.
    first_seam: usize,
    /// How coarse the mesh is, if it is folded by itself; told of the first piece alone.
    pub(super) meant: Option<Coarseness>,
}

/// A mesh taken apart into the pieces of its net, and the net of each, in the order of the
/// components.
pub(super) fn divided(
    whole: &Mesh,
    settings: &PanelMesh,
    meant: Option<Coarseness>,
    watch: &mut dyn Watch,
) -> Result<(Sheet, Vec<NetPiece>), MakeCause> {
    let options = NetOptions { within_mm: settings.pieces_within_mm };
    let net = net(whole, &options, watch).ok_or(MakeCause::Flatten(FlattenError::Stopped))?;
    let sheet = net.apart(whole).map_err(|error| MakeCause::Mesh { error, places: Vec::new() })?;
    let apart = sheet.mesh();
    let mut place = vec![(0, 0); whole.triangles().len()];
    for (n, piece) in apart.components().iter().enumerate() {
        for (k, triangle) in piece.triangles.iter().enumerate() {
            place[triangle.get()] = (n, k);
        }
    }
    let mut slits: Vec<Vec<Slit>> = vec![Vec::new(); apart.components().len()];
    for line in net.slits() {
        let steps = line.windows(2).filter_map(|pair| step(whole, [pair[0], pair[1]]));
        let steps: Vec<(usize, [usize; 2])> = steps.collect();
        let Some(&(first, _)) = steps.first() else { continue };
        let in_piece = steps.iter().map(|&(triangle, corners)| (place[triangle].1, corners));
        slits[place[first].0].push(in_piece.collect());
    }
    let mut before = 0;
    let pieces = slits.into_iter().enumerate().map(|(n, slits)| {
        let first_seam = before;
        before += slits.len();
        NetPiece { slits, first_seam, meant: meant.filter(|_| n == 0) }
    });
    let pieces = pieces.collect();
    Ok((sheet, pieces))
}

/// A side by a triangle and its corners at which the side starts and ends.
fn step(mesh: &Mesh, ends: [VertexIndex; 2]) -> Option<(usize, [usize; 2])> {
    let n = mesh.topology().edge_between(ends[0], ends[1])?;
    let triangle = mesh.edges()[n].triangles.into_iter().flatten().next()?.get();
    let corner = |v: VertexIndex| mesh.triangles()[triangle].iter().position(|&c| c == v);
    Some((triangle, [corner(ends[0])?, corner(ends[1])?]))
}

impl NetPiece {
    /// The piece cut along its slits and laid flat.
    pub(super) fn laid(&self, mesh: &Mesh) -> Result<(Sheet, Relaxed), MakeCause> {
        let corner = |triangle: usize, k: usize| mesh.triangles()[triangle][k];
        let line = |slit: &Slit| -> Vec<VertexIndex> {
            let start = slit.first().map(|&(triangle, [from, _])| corner(triangle, from));
            let ends = slit.iter().map(|&(triangle, [_, to])| corner(triangle, to));
            start.into_iter().chain(ends).collect()
        };
        let lines: Vec<Vec<VertexIndex>> = self.slits.iter().map(line).collect();
        let lines: Vec<&[VertexIndex]> = lines.iter().map(Vec::as_slice).collect();
        let sheet = cut_along_lines(mesh, &lines)
            .map_err(|error| MakeCause::Mesh { error, places: Vec::new() })?
            .with_first_seam(self.first_seam);
        let flat = unfold(sheet.mesh()).map_err(MakeCause::Flatten)?;
        Ok((sheet, Relaxed { flat, flipped: 0, ended: Ended::True, steps: 0 }))
    }
}

/// What is done about the facets of a mesh whose settings leave it open.
pub(super) enum Folding {
    /// They are folded: as one surface the mesh would not bend, and its facets are meant.
    Meant(Coarseness),
    /// A note says that they can be: the mesh would not bend, but may sample a smooth shape.
    Offered(Coarseness),
}

/// What is done about the facets of a mesh that was laid flat as a surface, in the parts `smooth`;
/// `None` where settings say how it is laid flat, the sheet does not fold, the mesh bends, or it is
/// a strip.
pub(super) fn folding(
    settings: &PanelMesh,
    material: Option<&Material>,
    whole: &Mesh,
    smooth: &Result<Vec<Part>, MakeError>,
) -> Option<Folding> {
    // A strip lies flat exactly as a surface: what is asked for is how it bends.
    let has_inside = whole.topology().on_border().contains(&false);
    let is_open = settings.facets.is_none()
        && has_inside
        && settings.split_creases.is_none()
        && !settings.darts
        && settings.aim == Aim::Mean;
    if !is_open || !material.is_none_or(Material::folds) || bends(smooth) {
        return None;
    }
    let coarse = coarseness(whole);
    if coarse.is_meant() {
        return Some(Folding::Meant(coarse));
    }
    coarse.has_few().then_some(Folding::Offered(coarse))
}

/// Whether parts bend as surfaces, or fail in a way that a net does not help.
fn bends(smooth: &Result<Vec<Part>, MakeError>) -> bool {
    match smooth {
        Ok(parts) => parts.iter().all(|part| part.checked.verdict != Verdict::WillNotBend),
        Err(error) => !matches!(error.cause, MakeCause::Relax(_)),
    }
}

/// Notes on the first part that does not bend that its facets can be folded.
pub(super) fn offer(parts: &mut [Part], coarse: Coarseness) {
    let will_not = |part: &&mut Part| part.checked.verdict == Verdict::WillNotBend;
    if let Some(part) = parts.iter_mut().find(will_not) {
        let kind = FindingKind::FacetsFew { facets: coarse.facets };
        part.checked.add(Finding::of_whole(kind));
    }
}
