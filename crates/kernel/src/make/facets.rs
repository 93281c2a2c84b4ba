//! Meshes whose facets are folded: divided into the pieces of a net, each laid flat exactly.

use super::part::Part;
use super::seams::{Side, places, side};
use super::{MakeCause, MakeError};
use crate::check::{FacetsMeant, Finding, FindingKind, MeshSetting, Verdict};
use crate::design::{Design, PanelMesh, PanelShape};
use crate::flatten::{Aim, Ended, FlattenError, Relaxed, is_no_larger, unfold};
use crate::material::Material;
use crate::mesh::{Component, Cut, Mesh, MeshEdge};
use crate::nets::{Beyond, Coarseness, NetOptions, coarseness, net, rounding_mm};
use crate::sheet::{Sheet, cut_along_lines};
use crate::trim::beyond;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::predicate::Box2;
use sheetwright_geometry::watch::Watch;

/// Corners of cut lines are rounded by this share of the size that a piece may have.
const CUT_ROUNDING: f64 = 1e-6;

/// How many times as far apart as rounding explains the sides of a net are, one try after the
/// other: rounding adds up from facet to facet.
const ROUNDINGS_APART: [f64; 2] = [1.0, 4.0];

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
    /// Why its body is folded by itself, if it is; told of the first piece alone.
    pub(super) meant: Option<FacetsMeant>,
}

/// The limits of the net of a panel, which counts what the trims of its design will add.
pub(super) fn net_options(design: &Design, settings: &PanelMesh) -> NetOptions {
    let within_mm = settings.pieces_within_mm;
    let beyond = within_mm.map_or_else(Beyond::default, |_| beyond(&design.trims));
    NetOptions { within_mm, beyond, ..NetOptions::default() }
}

/// A mesh taken apart into the pieces of its net, which is cut along `seams`, and the net of each,
/// in the order of the components. Where it is folded by itself, `meant` says why, for each body.
///
/// Where a piece overlaps itself when it is laid flat, rounding of the file has moved sides that
/// nearly touch. The net is sought again then, with sides that keep farther apart than that; the
/// first one stays where that does not help.
pub(super) fn divided(
    whole: &Mesh,
    seams: &Cut,
    options: &NetOptions,
    meant: &[Option<FacetsMeant>],
    watch: &mut dyn Watch,
) -> Result<(Sheet, Vec<NetPiece>), MakeCause> {
    let first = taken_apart(whole, seams, options, meant, watch)?;
    if !overlaps(&first)? {
        return Ok(first);
    }
    let rounding_mm = rounding_mm(whole);
    for times in ROUNDINGS_APART {
        let options = NetOptions { apart_mm: times * rounding_mm, ..*options };
        let found = taken_apart(whole, seams, &options, meant, watch)?;
        if overlaps(&found) == Ok(false) {
            return Ok(found);
        }
    }
    Ok(first)
}

/// Whether a piece of a net overlaps itself.
fn overlaps((sheet, pieces): &(Sheet, Vec<NetPiece>)) -> Result<bool, MakeCause> {
    let mesh = sheet.mesh();
    for (piece, component) in pieces.iter().zip(mesh.components()) {
        let alone = mesh.part(&component.triangles);
        let alone = alone.map_err(|error| MakeCause::Mesh { error, places: Vec::new() })?.0;
        if piece.laid(&alone)?.1.flat.overlap.is_some() {
            return Ok(true);
        }
    }
    Ok(false)
}

/// As [`divided`], whether pieces overlap themselves or not.
fn taken_apart(
    whole: &Mesh,
    seams: &Cut,
    options: &NetOptions,
    meant: &[Option<FacetsMeant>],
    watch: &mut dyn Watch,
) -> Result<(Sheet, Vec<NetPiece>), MakeCause> {
    let net = net(whole, seams, options, watch).ok_or(MakeCause::Flatten(FlattenError::Stopped))?;
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
    let bodies = super::seams::places(whole, whole);
    let mut meant = meant.to_vec();
    let mut before = 0;
    let pieces = slits.into_iter().zip(apart.components()).map(|(slits, component)| {
        let first_seam = before;
        before += slits.len();
        let faces = component.triangles.iter().map(|&t| net.facet_of(t)).collect();
        let (body, _) = bodies[component.triangles[0].get()];
        let meant = meant.get_mut(body).and_then(Option::take);
        NetPiece { slits, faces, first_seam, meant }
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
    /// Those of some bodies are folded.
    Meant(Vec<BodyWay>),
    /// A note says that they can be: the mesh has a fault, but may sample a smooth shape.
    Offered(Coarseness),
}

/// How a body of a mesh is laid flat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum BodyWay {
    /// As a surface.
    Smooth,
    /// As a net, for this reason: as one surface it has a fault, and its facets are meant. `None`
    /// of one without a fault whose facets are meant, too, beside one that is folded.
    Folded(Option<FacetsMeant>),
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

    /// The worst of each body of a mesh in these parts, which are of these bodies; of bodies that
    /// can't be laid flat as a surface, if a net helps.
    fn of_bodies(
        smooth: &Result<Vec<Part>, MakeError>,
        body_of: &[usize],
        count: usize,
    ) -> Vec<Option<Self>> {
        let parts = match smooth {
            Ok(parts) => parts,
            Err(error) => {
                let helps = matches!(error.cause, MakeCause::Relax(_));
                return vec![helps.then_some(Self::Stiff); count];
            }
        };
        let mut worst = vec![None; count];
        for (part, &body) in parts.iter().zip(body_of) {
            worst[body] = match (worst[body], Self::of(part)) {
                (Some(known), Some(fault)) if known != fault => Some(Self::Stiff),
                (known, fault) => known.or(fault),
            };
        }
        worst
    }
}

/// The bodies of a mesh, in the order of its components.
pub(super) struct Bodies<'a> {
    pub(super) mesh: &'a Mesh,
    /// Of each, whether it is a plate: sheet that bends, however coarse it came.
    pub(super) plates: &'a [bool],
    /// The body of each part that was laid flat as a surface.
    pub(super) of_parts: &'a [usize],
}

impl Bodies<'_> {
    /// How coarse each is.
    fn coarseness(&self) -> impl Iterator<Item = Option<Coarseness>> {
        let bodies = self.mesh.components();
        bodies.iter().map(move |body| match bodies.len() {
            1 => Some(coarseness(self.mesh)),
            _ => Some(coarseness(&self.mesh.part(&body.triangles).ok()?.0)),
        })
    }

    /// Whether each is a strip.
    fn are_strips(&self) -> impl Iterator<Item = bool> {
        let on_border = self.mesh.topology().on_border();
        let is_strip = move |body: &Component| body.vertices.iter().all(|v| on_border[v.get()]);
        self.mesh.components().iter().map(is_strip)
    }
}

/// What is done about the facets of a mesh that was laid flat as a surface, in the parts `smooth`.
/// Each body is judged by itself. `None` where settings say how it is laid flat, the sheet does not
/// fold, the mesh has no fault, or where all bodies with one are plates or strips that bend badly.
pub(super) fn folding(
    settings: &PanelMesh,
    material: Option<&Material>,
    bodies: &Bodies<'_>,
    smooth: &Result<Vec<Part>, MakeError>,
) -> Option<Folding> {
    let is_open = settings.facets.is_none()
        && settings.split_creases.is_none()
        && !settings.darts
        && settings.aim == Aim::Mean;
    if !is_open || !material.is_none_or(Material::folds) {
        return None;
    }
    let count = bodies.plates.len();
    let faults = Fault::of_bodies(smooth, bodies.of_parts, count);
    if faults.iter().all(Option::is_none) {
        return None;
    }
    let known = bodies.coarseness().zip(bodies.are_strips()).zip(bodies.plates);
    let judged = known.zip(faults).map(|(((coarse, is_strip), is_plate), fault)| {
        // A strip lies flat exactly as a surface: what is asked for is how it bends, if it can be
        // cut from one sheet.
        let as_surface = *is_plate || (is_strip && fault != Some(Fault::Overlap));
        (coarse.filter(|_| !as_surface), fault)
    });
    let judged: Vec<(Option<Coarseness>, Option<Fault>)> = judged.collect();
    let reason = |&(coarse, fault): &(Option<Coarseness>, Option<Fault>)| {
        let coarse = coarse.filter(Coarseness::is_meant)?;
        Some(FacetsMeant { coarse, overlaps: fault? == Fault::Overlap })
    };
    if judged.iter().any(|body| reason(body).is_some()) {
        let is_meant = |coarse: Option<Coarseness>| coarse.is_some_and(|coarse| coarse.is_meant());
        let laid = judged.iter().map(|body| match is_meant(body.0) {
            true => BodyWay::Folded(reason(body)),
            false => BodyWay::Smooth,
        });
        return Some(Folding::Meant(laid.collect()));
    }
    // The whole mesh would be folded.
    let known = judged.into_iter().find_map(|(coarse, fault)| fault.and(coarse))?;
    let coarse = if count == 1 { known } else { coarseness(bodies.mesh) };
    coarse.has_few().then_some(Folding::Offered(coarse))
}

/// Notes on the first part with a fault that its facets can be folded.
pub(super) fn offer(parts: &mut [Part], coarse: Coarseness) {
    if let Some(part) = parts.iter_mut().find(|part| Fault::of(part).is_some()) {
        let kind = FindingKind::FacetsFew { facets: coarse.facets };
        part.checked.add(Finding::of_whole(kind));
    }
}

/// Says of a panel which of its settings have no effect on the way in which it was laid flat, with
/// the first of its parts that this is true of.
pub(super) fn say_no_effect(parts: &mut [Part], settings: &PanelMesh) {
    let of_surface = [
        (settings.aim != Aim::Mean, MeshSetting::Aim),
        (settings.split_creases.is_some(), MeshSetting::SplitCreases),
        (settings.darts, MeshSetting::Darts),
    ];
    let of_net = [(settings.pieces_within_mm.is_some(), MeshSetting::PiecesWithin)];
    for (is_net, without) in [(true, &of_surface[..]), (false, &of_net[..])] {
        let asked = without.iter().filter(|(is_asked, _)| *is_asked);
        let settings: Vec<MeshSetting> = asked.map(|(_, setting)| *setting).collect();
        let is_so = |part: &&mut Part| part.given().is_some_and(|given| given.is_net == is_net);
        if let (false, Some(part)) = (settings.is_empty(), parts.iter_mut().find(is_so)) {
            part.checked.add(Finding::of_whole(FindingKind::NoEffect { settings, is_net }));
        }
    }
}

/// Says which pieces of nets are larger than they may be, with all that is added along their edges.
pub(super) fn say_too_large<'a>(parts: impl Iterator<Item = &'a mut Part>, design: &Design) {
    for part in parts {
        let is_said = |finding: &Finding| matches!(finding.kind, FindingKind::PieceTooLarge { .. });
        part.checked.findings.retain(|finding| !is_said(finding));
        let Some(within_mm) = largest_piece_mm(design, part) else { continue };
        let size = part.piece.size;
        if is_no_larger(size, within_mm, CUT_ROUNDING) {
            continue;
        }
        let mesh = part.sheet.mesh();
        let is_inside = |edge: &MeshEdge| edge.is_border() || part.sheet.is_within_face(edge);
        let is_facet = mesh.edges().iter().all(is_inside);
        let net = Box2::of_points(part.flat.points.iter().copied());
        let kind = FindingKind::PieceTooLarge {
            size_mm: [size.x.max(size.y), size.x.min(size.y)],
            within_mm: [within_mm[0].max(within_mm[1]), within_mm[0].min(within_mm[1])],
            is_facet,
            is_trimmed: net
                .is_some_and(|net| is_no_larger(net.max - net.min, within_mm, CUT_ROUNDING)),
        };
        part.checked.add(Finding::of_whole(kind));
    }
}

/// The largest size of a piece of a net, mm, if its panel has one.
fn largest_piece_mm(design: &Design, part: &Part) -> Option<[f64; 2]> {
    let panel = design.panels.iter().find(|panel| panel.name == part.panel)?;
    let PanelShape::Mesh(settings) = &panel.shape else { return None };
    settings.pieces_within_mm.filter(|_| part.given().is_some_and(|given| given.is_net))
}
