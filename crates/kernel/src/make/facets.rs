//! Meshes whose facets are folded: divided into the pieces of a net, each laid flat exactly.

use super::part::Part;
use super::seams::{Side, places, side};
use super::{MakeCause, MakeError};
use crate::check::{FacetsMeant, Finding, FindingKind, Verdict};
use crate::design::PanelMesh;
use crate::flatten::{Aim, Ended, FlattenError, Relaxed, unfold};
use crate::material::Material;
use crate::mesh::{Cut, Mesh};
use crate::nets::{Coarseness, NetOptions, coarseness, net};
use crate::sheet::{Sheet, cut_along_lines};
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::watch::Watch;

/// A line along which a piece is cut without falling apart, side by side.
type Slit = Vec<Side>;

/// What a piece of a net is, beside its mesh.
#[derive(Clone, Debug)]
pub(super) struct NetPiece {
    slits: Vec<Slit>,
    /// The flat face of each of its triangles.
    faces: Vec<usize>,
    /// The number of slits of the pieces before it.
    first_seam: usize,
    /// Why the mesh is folded by itself, if it is; told of the first piece alone.
    pub(super) meant: Option<FacetsMeant>,
}

/// A mesh taken apart into the pieces of its net, which is cut along `seams`, and the net of each,
/// in the order of the components.
pub(super) fn divided(
    whole: &Mesh,
    seams: &Cut,
    settings: &PanelMesh,
    meant: Option<FacetsMeant>,
    watch: &mut dyn Watch,
) -> Result<(Sheet, Vec<NetPiece>), MakeCause> {
    let options = NetOptions { within_mm: settings.pieces_within_mm };
    let net =
        net(whole, seams, &options, watch).ok_or(MakeCause::Flatten(FlattenError::Stopped))?;
    let sheet = net.apart(whole).map_err(|error| MakeCause::Mesh { error, places: Vec::new() })?;
    let apart = sheet.mesh();
    let places = places(whole, apart);
    let mut slits: Vec<Vec<Slit>> = vec![Vec::new(); apart.components().len()];
    for line in net.slits() {
        let steps = line.windows(2).filter_map(|pair| side(whole, [pair[0], pair[1]]));
        let steps: Vec<Side> = steps.collect();
        let Some(&(first, _)) = steps.first() else { continue };
        let in_piece = steps.iter().map(|&(triangle, corners)| (places[triangle].1, corners));
        slits[places[first].0].push(in_piece.collect());
    }
    let mut before = 0;
    let pieces = slits.into_iter().zip(apart.components()).enumerate();
    let pieces = pieces.map(|(n, (slits, component))| {
        let first_seam = before;
        before += slits.len();
        let faces = component.triangles.iter().map(|&t| net.facet_of(t)).collect();
        NetPiece { slits, faces, first_seam, meant: meant.filter(|_| n == 0) }
    });
    let pieces = pieces.collect();
    Ok((sheet, pieces))
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
            .with_first_seam(self.first_seam)
            .with_faces(self.faces.clone());
        let flat = unfold(sheet.mesh(), &self.faces).map_err(MakeCause::Flatten)?;
        Ok((sheet, Relaxed { flat, flipped: 0, ended: Ended::True, steps: 0 }))
    }
}

/// What is done about the facets of a mesh whose settings leave it open.
pub(super) enum Folding {
    /// They are folded: as one surface the mesh has a fault, and its facets are meant.
    Meant(FacetsMeant),
    /// A note says that they can be: the mesh has a fault, but may sample a smooth shape.
    Offered(Coarseness),
}

/// What is wrong with a mesh as one surface that its net may lack.
#[derive(Clone, Copy, PartialEq)]
enum Fault {
    /// It would not bend.
    Stiff,
    /// It bends, and its pattern overlaps itself.
    Overlap,
}

impl Fault {
    fn of(part: &Part) -> Option<Self> {
        match part.checked.verdict {
            Verdict::WillNotBend => Some(Self::Stiff),
            _ => part.flat.overlap.map(|_| Self::Overlap),
        }
    }

    /// That of a mesh in these parts, the worst; of a mesh that can't be laid flat as a surface, if
    /// a net helps.
    fn of_all(smooth: &Result<Vec<Part>, MakeError>) -> Option<Self> {
        match smooth {
            Ok(parts) => {
                let mut faults = parts.iter().filter_map(Self::of);
                let first = faults.next()?;
                Some(if faults.all(|fault| fault == first) { first } else { Self::Stiff })
            }
            Err(error) => matches!(error.cause, MakeCause::Relax(_)).then_some(Self::Stiff),
        }
    }
}

/// What is done about the facets of a mesh that was laid flat as a surface, in the parts `smooth`;
/// `None` where settings say how it is laid flat, the sheet does not fold, the mesh has no fault,
/// or it is a strip.
pub(super) fn folding(
    settings: &PanelMesh,
    material: Option<&Material>,
    whole: &Mesh,
    smooth: &Result<Vec<Part>, MakeError>,
) -> Option<Folding> {
    let is_open = settings.facets.is_none()
        && settings.split_creases.is_none()
        && !settings.darts
        && settings.aim == Aim::Mean;
    let fault =
        Fault::of_all(smooth).filter(|_| is_open && material.is_none_or(Material::folds))?;
    // A strip lies flat exactly as a surface: what is asked for is how it bends.
    if !whole.topology().on_border().contains(&false) {
        return None;
    }
    let coarse = coarseness(whole);
    if coarse.is_meant() {
        return Some(Folding::Meant(FacetsMeant { coarse, overlaps: fault == Fault::Overlap }));
    }
    coarse.has_few().then_some(Folding::Offered(coarse))
}

/// Notes on the first part with a fault that its facets can be folded.
pub(super) fn offer(parts: &mut [Part], coarse: Coarseness) {
    if let Some(part) = parts.iter_mut().find(|part| Fault::of(part).is_some()) {
        let kind = FindingKind::FacetsFew { facets: coarse.facets };
        part.checked.add(Finding::of_whole(kind));
    }
}
