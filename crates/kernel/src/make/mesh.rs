//! Panels that come as a mesh: divided into parts, cut where they must be, and laid flat.
//!
//! A mesh with seams is taken apart along them first (`seams`). Each connected component then
//! becomes a part. A part that is closed or has a handle is cut open as far as that serves
//! (`opened`); one with holes or open at both ends is laid flat as it is, and cut from border to
//! border where that leaves less than half of the error; a cone, to its point. Where facets are
//! folded, the mesh is divided into the pieces of a net instead ([`super::facets`]).

use super::cleaned::Cleaned;
use super::facets::{self, BodyWay, Folding, NetPiece};
use super::laid::Laid;
use super::opened::smooth_point;
use super::part::{Given, Joint, Origin, Part};
use super::rebuilt::rebuilt;
use super::seams::{Sewn, Side, places, seams_within};
use super::skins::{Skinned, with_skin};
use super::truest::truest;
use super::{Judging, MakeCause, MakeError};
use crate::bend::{FOLDED_DEG, FoldTool, Mitred, crease, rounded};
use crate::check::{
    CheckedFrom, FacetsMeant, FindingKind, MeshOrigin, NetOrigin, SeamCause, Subject, check,
    mitred_folds,
};
use crate::design::{Bends, Design, DesignPanel, PanelMesh, Thick};
use crate::elastic::screen_given;
use crate::flatten::{Aim, FlattenError, RelaxOptions, Relaxed, relax};
use crate::material::{Material, stretch_limit};
use crate::measure::{CutFrom, cut_suggestion, distortion, measures};
use crate::mesh::{
    Before, Cut, Healing, Mesh, MeshError, Specks, crease_angles, cut_of_part, cut_through,
    separated, sides_along,
};
use crate::nets::NetOptions;
use crate::pattern::Piece;
use crate::sheet::{Seam, Sheet, cut_along, split_at};
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::{Point3, from_deg};
use sheetwright_geometry::watch::{Stage, Watch};
use std::collections::{BTreeMap, BTreeSet};

/// A cut that is not necessary is made if it leaves less than this share of the largest length
/// error.
const MUCH_LESS: f64 = 0.5;
/// The most points that a part is cut to: after each cut it is laid flat again.
const MOST_DARTS: usize = 12;

/// The most steps of flattening times vertices: a scan of 100,000 triangles takes some seconds.
/// Steps after the first few hardly lower its errors.
const MOST_WORK: usize = 400_000;
/// So many steps are taken in any case.
const LEAST_STEPS: usize = 8;

/// The most parts of a mesh.
const MAX_MESH_PARTS: usize = 1000;

/// Makes the parts of a panel that is a mesh, whose triangles are `cleaned`. Their edges and their
/// joints are known once all parts of the design are ([`super::joined`]).
pub(super) fn make_mesh(
    design: &Design,
    panel: &DesignPanel,
    settings: &PanelMesh,
    cleaned: &Cleaned,
    judging: Judging,
    watch: &mut dyn Watch,
) -> Result<Vec<Part>, MakeError> {
    let failed = |cause| MakeError::of_panel(&panel.name, cause);
    let whole = Whole::of(cleaned, settings, watch).map_err(failed)?;
    let options = facets::net_options(design, settings);
    let is_net = settings.facets == Some(true);
    let divided = if is_net { None } else { whole.divided(settings).map_err(failed)? };
    let body_of = whole.bodies_of(divided.as_ref());
    let pieces = match is_net {
        true => whole.net(cleaned, &options, &[], watch),
        false => pieces_of(cleaned, &whole, divided.map(|sheet| (sheet, Vec::new()))),
    };
    let mut made = make_parts(design, panel, settings, pieces.map_err(failed)?, judging, watch);
    let bodies = facets::Bodies { mesh: &whole.mesh, plates: &whole.plates, of_parts: &body_of };
    match facets::folding(settings, design.material.as_ref(), &bodies, &made) {
        Some(Folding::Meant(laid)) if !watch.stop() => {
            let ways = (&laid[..], &options);
            let pieces = whole.folded(cleaned, settings, ways, watch).map_err(failed)?;
            made = make_parts(design, panel, settings, pieces, judging, watch);
        }
        Some(Folding::Offered(coarse)) => {
            made.iter_mut().for_each(|parts| facets::offer(parts, coarse));
        }
        _ => {}
    }
    let mut parts = made?;
    facets::say_no_effect(&mut parts, settings);
    Ok(parts)
}

fn make_parts(
    design: &Design,
    panel: &DesignPanel,
    settings: &PanelMesh,
    pieces: Vec<MeshPiece>,
    judging: Judging,
    watch: &mut dyn Watch,
) -> Result<Vec<Part>, MakeError> {
    let material = design.material.as_ref();
    let names = names(design, panel, pieces.len());
    let made = names.into_iter().zip(pieces).map(|(name, piece)| {
        let sheet = (material, design.thick());
        let made = make_part([&panel.name, &name], piece, sheet, (settings, judging), watch);
        let made = made.map(|part| Part { bends: design.bends_of(panel), ..part });
        made.map_err(|cause| MakeError::of_panel(&name, cause))
    });
    made.collect()
}

/// How the parts of a panel are called: as the panel, if it is one part, or with a number, which is
/// counted on where another panel has that name.
fn names(design: &Design, panel: &DesignPanel, count: usize) -> Vec<String> {
    if count == 1 {
        return vec![panel.name.clone()];
    }
    let taken: BTreeSet<String> =
        design.panels.iter().map(|panel| panel.name.to_lowercase()).collect();
    let numbered = (1..).map(|n| format!("{}-{n}", panel.name));
    numbered.filter(|name| !taken.contains(&name.to_lowercase())).take(count).collect()
}

/// A piece of a mesh that hangs together.
struct MeshPiece {
    mesh: Mesh,
    left_out: usize,
    specks: Option<Specks>,
    healings: Vec<Healing>,
    skins: Option<FindingKind>,
    contacts: usize,
    joints: Vec<PieceJoint>,
    /// The seams within it that were chosen.
    seams: Vec<Side>,
    /// What it is as a piece of a net; `None` of a surface.
    net: Option<NetPiece>,
}

/// A joint of a piece, by corners of its triangles: those at which each step starts and ends.
struct PieceJoint {
    number: usize,
    with: usize,
    steps: Vec<(usize, [usize; 2])>,
}

/// The mesh of a panel before it is divided.
struct Whole {
    mesh: Mesh,
    /// In how many points parts met that have no side in common there.
    contacts: usize,
    /// The finding on its two skins, if it is a plate that has them or if one was asked for.
    skins: Option<FindingKind>,
    /// Of each of its bodies, whether it is such a plate.
    plates: Vec<bool>,
    /// The sides along which it is to be cut.
    seams: Cut,
}

impl Whole {
    fn of(cleaned: &Cleaned, settings: &PanelMesh, watch: &dyn Watch) -> Result<Self, MakeCause> {
        let given = &*cleaned.triangles;
        let known = |v: &VertexIndex| v.get() < given.positions.len();
        if let Some(n) = given.triangles.iter().position(|corners| !corners.iter().all(known)) {
            let error = MeshError::BadCorner { triangle: TriangleIndex::new(n) };
            return Err(MakeCause::Mesh { error, places: Vec::new() });
        }
        // Parts that meet in a point are no error: they are separated there.
        let apart = separated(&given.triangles, |_| false);
        let contacts: BTreeSet<VertexIndex> =
            apart.origin.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]).collect();
        let positions: Vec<Point3> =
            apart.origin.iter().map(|v| given.positions[v.get()]).collect();
        let triangles = apart.triangles.clone();
        let Skinned { mesh, said: skins, plates } = Mesh::new(positions.clone(), triangles)
            .and_then(|whole| with_skin(whole, settings.skin))
            .map_err(|error| bad(error, &positions, &apart.triangles))?;
        let before = Before { given: &settings.triangles.positions, healed: &positions };
        let seams = sides_along(&mesh, before, &settings.seams, watch).map_err(MakeCause::Seam)?;
        let seams = seams.ok_or(MakeCause::Flatten(FlattenError::Stopped))?;
        Ok(Self { mesh, contacts: contacts.len(), skins, plates, seams })
    }

    /// The mesh divided along its seams, and along its creases if settings say so.
    fn divided(&self, settings: &PanelMesh) -> Result<Option<Sheet>, MakeCause> {
        let crease = settings.split_creases;
        if crease.is_none() && self.seams.is_empty() {
            return Ok(None);
        }
        let turns = crease.map(|_| crease_angles(&self.mesh)).unwrap_or_default();
        let turns_much = |n: usize| crease.is_some_and(|crease| turns[n] > crease);
        let sheet = split_at(&self.mesh, |n| self.seams.contains(&n) || turns_much(n));
        sheet.map(Some).map_err(|error| self.bad(error))
    }

    /// The body of each piece of the mesh as it was divided.
    fn bodies_of(&self, divided: Option<&Sheet>) -> Vec<usize> {
        let places = places(&self.mesh, &self.mesh);
        let pieces = divided.map_or(&self.mesh, Sheet::mesh).components();
        pieces.iter().map(|piece| places[piece.triangles[0].get()].0).collect()
    }

    /// The pieces of its net; where it is folded by itself, `meant` says why, for some bodies.
    fn net(
        &self,
        cleaned: &Cleaned,
        options: &NetOptions,
        meant: &[Option<FacetsMeant>],
        watch: &mut dyn Watch,
    ) -> Result<Vec<MeshPiece>, MakeCause> {
        let net = facets::divided(&self.mesh, &self.seams, options, meant, watch)?;
        pieces_of(cleaned, self, Some(net))
    }

    /// Its pieces where those bodies are folded that have facets which are meant, and the others
    /// are surfaces; the folded ones come first.
    fn folded(
        &self,
        cleaned: &Cleaned,
        settings: &PanelMesh,
        (laid, options): (&[BodyWay], &NetOptions),
        watch: &mut dyn Watch,
    ) -> Result<Vec<MeshPiece>, MakeCause> {
        let reasons = laid.iter().filter_map(|laid| match laid {
            BodyWay::Smooth => None,
            BodyWay::Folded(meant) => Some(*meant),
        });
        let reasons: Vec<Option<FacetsMeant>> = reasons.collect();
        if reasons.len() == laid.len() {
            return self.net(cleaned, options, &reasons, watch);
        }
        let folds = |n: &usize| laid[*n] != BodyWay::Smooth;
        let mut pieces = self.of_bodies(folds)?.net(cleaned, options, &reasons, watch)?;
        let smooth = self.of_bodies(|n| !folds(n))?;
        let divided = smooth.divided(settings)?.map(|sheet| (sheet, Vec::new()));
        let joints = pieces.iter().flat_map(|piece| &piece.joints).map(|joint| joint.number + 1);
        let (joints, before) = (joints.max().unwrap_or(0), pieces.len());
        for piece in pieces_of(cleaned, &smooth, divided)? {
            let renumbered = |joint: PieceJoint| PieceJoint {
                number: joint.number + joints,
                with: joint.with + before,
                ..joint
            };
            // What is found of the whole mesh is told of its first part.
            pieces.push(MeshPiece {
                joints: piece.joints.into_iter().map(renumbered).collect(),
                left_out: 0,
                specks: None,
                healings: Vec::new(),
                skins: None,
                contacts: 0,
                ..piece
            });
        }
        check_count(pieces.len())?;
        Ok(pieces)
    }

    /// Some of its bodies alone.
    fn of_bodies(&self, is_of: impl Fn(&usize) -> bool) -> Result<Self, MakeCause> {
        let of_these: Vec<usize> = (0..self.plates.len()).filter(is_of).collect();
        let bodies = of_these.iter().map(|&n| &self.mesh.components()[n]);
        let triangles: Vec<TriangleIndex> = bodies.flat_map(|b| b.triangles.clone()).collect();
        let (mesh, vertices) = self.mesh.part(&triangles).map_err(|error| self.bad(error))?;
        let seams = cut_of_part(&self.mesh, &self.seams, &mesh, &vertices);
        let plates = of_these.iter().map(|&n| self.plates[n]).collect();
        Ok(Self { mesh, contacts: self.contacts, skins: self.skins.clone(), plates, seams })
    }

    fn bad(&self, error: MeshError) -> MakeCause {
        bad(error, self.mesh.positions(), self.mesh.triangles())
    }
}

/// An error of a mesh with the places that it names.
fn bad(error: MeshError, positions: &[Point3], triangles: &[[VertexIndex; 3]]) -> MakeCause {
    let at = |v: &VertexIndex| positions.get(v.get()).copied();
    let places = match error {
        MeshError::NotManifold { from, to } | MeshError::NotOrientable { from, to } => {
            [from, to].iter().filter_map(at).collect()
        }
        MeshError::Degenerate { triangle } => {
            triangles.get(triangle.get()).into_iter().flatten().filter_map(at).collect()
        }
        _ => Vec::new(),
    };
    MakeCause::Mesh { error, places }
}

/// Refuses more parts than a mesh may have.
fn check_count(found: usize) -> Result<(), MakeCause> {
    let most = MAX_MESH_PARTS;
    if found > most { Err(MakeCause::Components { found, most }) } else { Ok(()) }
}

/// The pieces of a mesh that hang together: as it is, or as it was divided, with the net of each
/// piece if that was into a net.
fn pieces_of(
    cleaned: &Cleaned,
    whole: &Whole,
    divided: Option<(Sheet, Vec<NetPiece>)>,
) -> Result<Vec<MeshPiece>, MakeCause> {
    let given = &*cleaned.triangles;
    let (divided, nets) = divided.unzip();
    let nets = nets.unwrap_or_default();
    let (mesh, seams) = match &divided {
        Some(sheet) => (sheet.mesh(), sheet.seams()),
        None => (&whole.mesh, &[][..]),
    };
    let count = mesh.components().len();
    check_count(count)?;
    let mut joints = joints_of(mesh, seams);
    // A net is cut along its seams already.
    let mut within = match nets.is_empty() {
        true => seams_within(&whole.mesh, &whole.seams, mesh),
        false => vec![Vec::new(); count],
    };
    let mut nets = nets.into_iter();
    let mut pieces = Vec::with_capacity(count);
    for (n, piece) in mesh.components().iter().enumerate() {
        let alone = if count == 1 {
            mesh.clone()
        } else {
            let part = mesh.part(&piece.triangles);
            part.map_err(|error| bad(error, mesh.positions(), mesh.triangles()))?.0
        };
        // Findings on the whole mesh go to its first part.
        let first = n == 0;
        pieces.push(MeshPiece {
            mesh: alone,
            left_out: if first { given.left_out } else { 0 },
            specks: cleaned.specks.filter(|_| first),
            healings: if first { cleaned.healings.clone() } else { Vec::new() },
            skins: whole.skins.clone().filter(|_| first),
            contacts: if first { whole.contacts } else { 0 },
            joints: std::mem::take(&mut joints[n]),
            seams: std::mem::take(&mut within[n]),
            net: nets.next(),
        });
    }
    Ok(pieces)
}

/// The joints of every piece of a mesh that was divided along some seams, numbered by the seams; a
/// triangle of a piece is numbered within it.
fn joints_of(mesh: &Mesh, seams: &[Seam]) -> Vec<Vec<PieceJoint>> {
    let mut place = vec![(0, 0); mesh.triangles().len()];
    for (n, piece) in mesh.components().iter().enumerate() {
        for (k, triangle) in piece.triangles.iter().enumerate() {
            place[triangle.get()] = (n, k);
        }
    }
    let mut joints: Vec<Vec<PieceJoint>> = mesh.components().iter().map(|_| Vec::new()).collect();
    for (number, seam) in seams.iter().enumerate() {
        // The piece of each side, and its steps.
        let sides = seam.sides.each_ref().map(|side| {
            let steps: Vec<(usize, (usize, [usize; 2]))> = side
                .windows(2)
                .filter_map(|pair| {
                    let n = mesh.topology().edge_between(pair[0], pair[1])?;
                    let triangle = mesh.edges()[n].triangles.into_iter().flatten().next()?;
                    let corners = mesh.triangles()[triangle.get()];
                    let at = |v: VertexIndex| corners.iter().position(|&c| c == v);
                    let ends = [at(pair[0])?, at(pair[1])?];
                    let (piece, k) = place[triangle.get()];
                    // On its border, a triangle lies to the left of its sides.
                    let ends = if (ends[0] + 1) % 3 == ends[1] { ends } else { [ends[1], ends[0]] };
                    Some((piece, (k, ends)))
                })
                .collect();
            steps
        });
        let pieces = sides.each_ref().map(|side| side.first().map(|step| step.0));
        let [Some(a), Some(b)] = pieces else { continue };
        let [first, mut second] = sides;
        // Each runs with its sheet to the left, so the second one runs back.
        second.reverse();
        for ([piece, with], side) in [[a, b], [b, a]].into_iter().zip([first, second]) {
            let steps = side.into_iter().map(|step| step.1).collect();
            joints[piece].push(PieceJoint { number, with, steps });
        }
    }
    joints
}

fn lay(mesh: &Mesh, cut: &Cut, aim: Aim, watch: &mut dyn Watch) -> Result<Laid, MakeCause> {
    let sheet =
        cut_along(mesh, cut).map_err(|error| MakeCause::Mesh { error, places: Vec::new() })?;
    let RelaxOptions { most_steps, .. } = RelaxOptions::default();
    let most_steps = (MOST_WORK / sheet.mesh().positions().len()).clamp(LEAST_STEPS, most_steps);
    let relaxing = RelaxOptions { aim, most_steps };
    let relaxed = relax(sheet.mesh(), &relaxing, watch).map_err(MakeCause::Relax)?;
    let distortion = distortion(sheet.mesh(), &relaxed.flat.points);
    Ok(Laid { sheet, relaxed, distortion })
}

/// A mesh laid flat, cut where that must be or is worth it; with the reason.
fn laid_well(
    mesh: &Mesh,
    seams: &[Side],
    settings: &PanelMesh,
    limit: f64,
    watch: &mut dyn Watch,
) -> Result<(Laid, SeamCause), MakeCause> {
    let aim = settings.aim;
    let sewn =
        Sewn::of(mesh, seams).map_err(|error| MakeCause::Mesh { error, places: Vec::new() })?;
    let piece = sewn.component();
    let needs_cut = piece.is_closed() || piece.handles() > 0;
    let may_be_closed = needs_cut || piece.is_disk();
    let mut cut = if may_be_closed { sewn.opened(watch) } else { sewn.seams() };
    let mut closed = lay(mesh, &cut, aim, watch);
    let more = match piece.is_disk() {
        _ if needs_cut || !is_poor(&closed, limit) || watch.stop() => None,
        false => Some(sewn.opened(watch)),
        true if seams.is_empty() => smooth_point(mesh).map(|point| {
            let mut more = cut.clone();
            cut_through(mesh, &mut more, &[point]);
            more
        }),
        true => None,
    };
    if let Some(more) = more.filter(|more| more.len() > cut.len()) {
        let open = lay(mesh, &more, aim, watch);
        if is_better(&open, &closed) {
            (cut, closed) = (more, open);
        }
    }
    let mut laid = closed?;
    let mut darts = 0;
    while settings.darts && darts < MOST_DARTS && laid.distortion.length_error_max > limit {
        let Some(more) = with_dart(mesh, &laid, &cut, limit) else { break };
        laid = lay(mesh, &more, aim, watch)?;
        cut = more;
        darts += 1;
    }
    let cut_for = if darts > 0 {
        SeamCause::Darts
    } else if !seams.is_empty() && cut == sewn.seams() {
        SeamCause::Chosen
    } else if mesh.loops().is_empty() {
        SeamCause::Closed
    } else {
        SeamCause::NotFlat
    };
    Ok((laid, cut_for))
}

fn make_part(
    [panel, name]: [&str; 2],
    piece: MeshPiece,
    (material, thick): (Option<&Material>, Option<Thick>),
    (settings, judging): (&PanelMesh, Judging),
    watch: &mut dyn Watch,
) -> Result<Part, MakeCause> {
    let MeshPiece { mesh, left_out, specks, healings, skins, contacts, joints, seams, net } = piece;
    watch.begin(&[name], Stage::Flatten);
    let limit = stretch_limit(material);
    let mut mitred = (0, BTreeMap::new());
    let (laid, cut_for) = match &net {
        Some(net) => {
            let (sheet, relaxed) = net.laid(&mesh)?;
            let (sheet, relaxed) = with_tool(sheet, relaxed, material, thick, &mut mitred);
            let distortion = distortion(sheet.mesh(), &relaxed.flat.points);
            (Laid { sheet, relaxed, distortion }, SeamCause::Facets)
        }
        None => laid_well(&mesh, &seams, settings, limit, watch)?,
    };
    watch.begin(&[name], Stage::Check);
    let (laid, predicted) = match &net {
        // Between its folds, a net stays flat.
        Some(_) => (laid, None),
        None if judging == Judging::Quick => {
            let Laid { sheet, relaxed, distortion } = &laid;
            let predicted = screen_given(sheet, &relaxed.flat, distortion, material);
            (laid, Some(predicted))
        }
        None => {
            let (laid, predicted) = truest(laid, settings.aim, material, watch)?;
            (laid, Some(predicted))
        }
    };
    let Relaxed { flat, flipped, ended, .. } = laid.relaxed;
    let sheet = laid.sheet.laid_at(&flat.points);
    let suggested_cut = cut_suggestion(sheet.mesh(), &laid.distortion, limit).and_then(|cut| {
        // Where all points lie on the border, as those of a strip do, nothing leads inwards.
        let [inside, .., border] = cut.path[..] else { return None };
        Some([inside, border].map(|v| sheet.mesh().position(v)))
    });
    let measures = measures(CutFrom::Mesh(&mesh, laid.distortion), &sheet, &flat);
    let mut checked = check(&Subject {
        sheet: &sheet,
        flat: &flat,
        measures: &measures,
        predicted: predicted.as_ref(),
        material,
        from: CheckedFrom::Mesh(MeshOrigin {
            mesh: &mesh,
            keeps_border: settings.aim == Aim::Seams,
            suggested_cut,
            flipped,
            left_out,
            specks,
            healings: &healings,
            skins: skins.as_ref(),
            contacts,
            cut_for,
            net: net.as_ref().map(|net| NetOrigin { meant: net.meant }),
        }),
    });
    mitred_folds(mitred.0, &mitred.1).for_each(|finding| checked.add(finding));
    let joints = joints.into_iter().map(|joint| on_sheet(joint, &sheet)).collect();
    let rebuilt =
        settings.split_creases.filter(|_| net.is_none()).and_then(|_| rebuilt(&mesh, watch));
    let is_net = net.is_some();
    let given = Given { mesh, aim: settings.aim, ended, flipped, joints, rebuilt, is_net };
    // What it is joined to is not known yet, nor how its edges are called.
    let piece = Piece::undrawn(name);
    let (panel, name) = (panel.to_owned(), name.to_owned());
    let (bends, edges) = (Bends::default(), Vec::new());
    let origin = Origin::Given(Box::new(given));
    // A surface that bends is laid flat as it is; thickness counts at the folds of a net.
    let thick = thick.filter(|_| is_net);
    Ok(Part {
        name,
        panel,
        sheet,
        flat,
        measures,
        predicted,
        checked,
        piece,
        thick,
        bends,
        edges,
        origin,
    })
}

/// A piece of a net with its folds made by the tool of its sheet, where the thickness counts. Notes
/// how many folds there are, and which no tool makes.
fn with_tool(
    sheet: Sheet,
    relaxed: Relaxed,
    material: Option<&Material>,
    thick: Option<Thick>,
    mitred: &mut (usize, BTreeMap<Mitred, usize>),
) -> (Sheet, Relaxed) {
    let creases: Vec<f64> = sheet.mesh().edges().iter().map(|e| crease(sheet.mesh(), e)).collect();
    let bends_up = creases.iter().sum::<f64>() < 0.0;
    let tool = thick.and_then(|thick| FoldTool::of_drawn(thick, material, bends_up));
    let Some(tool) = tool else { return (sheet, relaxed) };
    let edges = sheet.mesh().edges().iter().zip(&creases);
    let is_fold = edges
        .map(|(edge, crease)| crease.abs() > from_deg(FOLDED_DEG) && !sheet.is_within_face(edge));
    let is_fold: Vec<bool> = is_fold.collect();
    let made = rounded(sheet, relaxed.flat, &is_fold, &tool);
    *mitred = (made.folds, made.mitred);
    (made.sheet, Relaxed { flat: made.flat, ..relaxed })
}

/// A joint by the vertices of the sheet as it is cut.
fn on_sheet(joint: PieceJoint, sheet: &Sheet) -> Joint {
    let mesh = sheet.mesh();
    let ends = |&(triangle, ends): &(usize, [usize; 2])| {
        ends.map(|corner: usize| mesh.triangles()[triangle][corner])
    };
    let steps: Vec<[VertexIndex; 2]> = joint.steps.iter().map(ends).collect();
    let length = |[a, b]: &[VertexIndex; 2]| mesh.position(*a).distance(mesh.position(*b));
    let length_mm = steps.iter().map(length).sum();
    let (number, with) = (joint.number, joint.with);
    Joint { mark: String::new(), with, length_mm, steps, in_panel: (number, with) }
}

/// Whether a sheet as it stands is worth cutting for.
fn is_poor(laid: &Result<Laid, MakeCause>, limit: f64) -> bool {
    laid.as_ref().map_or(true, |laid| {
        let error = laid.distortion.length_error_max;
        let overlaps = laid.relaxed.flat.overlap.is_some();
        error.is_nan() || error > limit || overlaps || laid.relaxed.flipped > 0
    })
}

/// Whether a sheet is so much better for its cut that it is worth it.
fn is_better(open: &Result<Laid, MakeCause>, closed: &Result<Laid, MakeCause>) -> bool {
    let (Ok(open), Ok(closed)) = (open, closed) else { return open.is_ok() };
    open.distortion.length_error_max < MUCH_LESS * closed.distortion.length_error_max
        || (closed.relaxed.flat.overlap.is_some() && open.relaxed.flat.overlap.is_none())
}

/// The cut with the one added that the measures of the sheet suggest; `None` where they suggest
/// none that is new.
fn with_dart(mesh: &Mesh, laid: &Laid, cut: &Cut, limit: f64) -> Option<Cut> {
    let suggested = cut_suggestion(laid.sheet.mesh(), &laid.distortion, limit)?;
    let way: Vec<VertexIndex> = suggested.path.iter().map(|&v| laid.sheet.origin(v)).collect();
    let sides = way.windows(2).map(|pair| mesh.topology().edge_between(pair[0], pair[1]));
    let mut more = cut.clone();
    more.extend(sides.collect::<Option<Vec<usize>>>()?);
    (more.len() > cut.len()).then_some(more)
}
