//! From meshes from elsewhere to patterns: [`make_meshes`] derives every stage.
//!
//! A group becomes a panel, or one for each of its parts that hang together and are large enough to
//! be sheet. A panel that is closed or has a handle is cut open; one with holes or open at both
//! ends is laid flat as it stands, and cut from border to border where that leaves less than half
//! of the error.

use super::rebuilt::{Rebuilt, rebuilt};
use super::specks::cleaned;
use crate::check::{Checked, MeshPanel, check_mesh};
use crate::design::{MeshDesign, MeshGroup};
use crate::edge::{Edge, MeshBorder, MeshJoint, PartEdges, edges_of_meshes, join_mates};
use crate::flatten::{Aim, RelaxError, RelaxOptions, Relaxed, relax};
use crate::material::{Material, stretch_limit};
use crate::measure::{MeshMeasures, cut_suggestion, mesh_measures};
use crate::mesh::{
    Cut, CutMesh, Mesh, MeshError, MeshSeam, Specks, cut_along, cut_to_disk, separated,
    split_along_creases,
};
use crate::pattern::{EdgeMark, Piece, joint_mark, mesh_piece, seam_marks};
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::Point3;
use sheetwright_geometry::watch::{Stage, Watch};
use std::collections::BTreeSet;
use std::fmt;

/// A cut that need not be is worth it if it leaves less than this share of the largest length
/// error.
const MUCH_LESS: f64 = 0.5;

/// How meshes are made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshOptions {
    /// What flattening makes small where it can't be exact. Default: the mean length error.
    pub aim: Aim,
    /// Panels are divided along creases above this angle, radians. Default: they are not.
    pub split_creases: Option<f64>,
    /// Whether panels that would have to stretch more than the material takes are cut from their
    /// border to their worst points. Default: they are not.
    pub darts: bool,
}

impl Default for MeshOptions {
    fn default() -> Self {
        Self { aim: Aim::Mean, split_creases: None, darts: false }
    }
}

/// A line along which a panel is joined to another, where a mesh was divided.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// How it is marked on both panels.
    pub mark: String,
    /// The number of the other panel; the panel's own where it is joined to itself.
    pub with: usize,
    /// How long it is in space, mm.
    pub length_mm: f64,
    /// The sides of triangles that it runs along, by vertices of the sheet, which lies to their
    /// left.
    pub steps: Vec<[VertexIndex; 2]>,
}

/// A mesh panel with everything that was derived from it.
#[derive(Clone, Debug, PartialEq)]
pub struct MadeMesh {
    /// Its name.
    pub name: String,
    /// Its surface in space.
    pub mesh: Mesh,
    /// Its surface as it is cut to lie flat: itself where there are no seams.
    pub sheet: CutMesh,
    /// Its sheet laid flat.
    pub flat: Relaxed,
    /// What was measured.
    pub measures: MeshMeasures,
    /// The verdict and its findings.
    pub checked: Checked,
    /// The pattern to cut.
    pub piece: Piece,
    /// The edges of its sheet, in the order of the loops; mates are panels of one [`MadeMeshes`].
    pub edges: Vec<Edge>,
    /// Where it is joined to the panels that it was divided from.
    pub joints: Vec<Joint>,
    /// The surface that its border alone asks for, where meshes are divided along creases and there
    /// is one.
    pub rebuilt: Option<Rebuilt>,
}

impl MadeMesh {
    /// The side with the largest length error, by its number among those of the sheet, the first of
    /// equals.
    pub fn worst_edge(&self) -> Option<usize> {
        worst_edge(&self.measures)
    }
}

fn worst_edge(measures: &MeshMeasures) -> Option<usize> {
    let size = |n: usize| measures.length_errors[n].abs();
    (0..measures.length_errors.len()).reduce(|best, n| if size(n) > size(best) { n } else { best })
}

/// A mesh design with everything that was derived from it.
#[derive(Clone, Debug, PartialEq)]
pub struct MadeMeshes {
    /// Its name.
    pub name: String,
    /// The sheet it is made from, if one is named.
    pub material: Option<Material>,
    /// What flattening made small.
    pub aim: Aim,
    /// Its panels, group after group.
    pub panels: Vec<MadeMesh>,
}

/// Why a mesh can't be made.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshMakeError {
    /// The group or panel.
    pub panel: String,
    /// Why.
    pub cause: MeshCause,
}

/// Why a mesh can't be made.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshCause {
    /// There is no group.
    NoGroups,
    /// Its triangles are no mesh; where, mm, if that can be told.
    Mesh {
        /// What is wrong with them.
        error: MeshError,
        /// The vertices of the error.
        places: Vec<Point3>,
    },
    /// So many parts that do not hang together, which is more than anyone wants as panels.
    Pieces {
        /// How many there are.
        found: usize,
    },
    /// It can't be laid flat.
    Flatten(RelaxError),
}

/// A group falls into so many panels at the most.
pub const MAX_MESH_PANELS: usize = 1000;

impl fmt::Display for MeshMakeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.panel.is_empty() {
            write!(f, "mesh '{}': ", self.panel)?;
        }
        let place =
            |p: &Point3| format!("({:.3}, {:.3}, {:.3}) mm", p.x + 0.0, p.y + 0.0, p.z + 0.0);
        match &self.cause {
            MeshCause::NoGroups => write!(f, "there is no triangle in it"),
            MeshCause::Pieces { found } => write!(
                f,
                "it falls into {found} parts that do not hang together; {MAX_MESH_PANELS} is the most"
            ),
            MeshCause::Mesh { error, places } => match (error, &places[..]) {
                (MeshError::NotManifold { .. }, [a, b]) => write!(
                    f,
                    "the side from {} to {} belongs to more than two triangles",
                    place(a),
                    place(b)
                ),
                (MeshError::NotOrientable { .. }, [a, b]) => write!(
                    f,
                    "it has one side only, as a Möbius strip or a Klein bottle: all round it, front \
                     turns into back, as at the side from {} to {}",
                    place(a),
                    place(b)
                ),
                (MeshError::Degenerate { .. }, [a, b, c]) => write!(
                    f,
                    "a triangle has no area: its corners {}, {} and {} lie on one line",
                    place(a),
                    place(b),
                    place(c)
                ),
                _ => write!(f, "{error}"),
            },
            MeshCause::Flatten(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for MeshMakeError {}

/// Makes a mesh design: the flat pattern, the measures and the verdict of every panel.
///
/// # Errors
/// The first group or panel that can't be made, and why.
pub fn make_meshes(
    design: &MeshDesign,
    options: &MeshOptions,
    watch: &mut dyn Watch,
) -> Result<MadeMeshes, MeshMakeError> {
    if design.groups.is_empty() {
        return Err(MeshMakeError { panel: String::new(), cause: MeshCause::NoGroups });
    }
    let mut taken: BTreeSet<String> =
        design.groups.iter().map(|group| group.name.to_lowercase()).collect();
    let mut parts = Vec::new();
    let mut joints = 0;
    for (group, specks) in cleaned(&design.groups) {
        let failed = |cause| MeshMakeError { panel: group.name.clone(), cause };
        let mut of_group = parts_of(&group, options).map_err(failed)?;
        if let Some(first) = of_group.first_mut() {
            first.specks = specks;
        }
        let found = of_group.len();
        if found + parts.len() > MAX_MESH_PANELS {
            return Err(failed(MeshCause::Pieces { found }));
        }
        let mut numbers = 1..;
        let before = parts.len();
        let of_this = joints;
        for mut part in of_group {
            for joint in &mut part.joints {
                joints = joints.max(of_this + joint.number + 1);
                (joint.number, joint.with) = (of_this + joint.number, before + joint.with);
            }
            let name = if found == 1 {
                group.name.clone()
            } else {
                let mut names = numbers.by_ref().map(|n| format!("{}-{n}", group.name));
                names.find(|name| taken.insert(name.to_lowercase())).unwrap_or_default()
            };
            parts.push(Part { name, ..part });
        }
    }
    let material = design.material.as_ref();
    let made = parts.into_iter().map(|part| make_mesh(part, material, options, watch));
    let panels = with_edges(made.collect::<Result<_, _>>()?);
    let (name, material) = (design.name.clone(), design.material.clone());
    Ok(MadeMeshes { name, material, aim: options.aim, panels })
}

/// A panel without what depends on the panels that it meets: its edges and their names.
struct Judged {
    name: String,
    mesh: Mesh,
    laid: Laid,
    checked: Checked,
    joints: Vec<Joint>,
    rebuilt: Option<Rebuilt>,
}

/// The panels with their edges, the mates of these, and the patterns that name them.
fn with_edges(panels: Vec<Judged>) -> Vec<MadeMesh> {
    let joined = |panel: &Judged| -> Vec<MeshJoint> {
        panel.joints.iter().map(|joint| (joint.with, joint.steps.clone())).collect()
    };
    let joints: Vec<Vec<MeshJoint>> = panels.iter().map(joined).collect();
    let borders = panels.iter().zip(&joints).map(|(panel, joints)| MeshBorder {
        name: &panel.name,
        sheet: &panel.laid.sheet,
        flat: &panel.laid.flat.points,
        joints,
    });
    let mut edges = edges_of_meshes(&borders.collect::<Vec<_>>());
    let parts = panels.iter().zip(&mut edges).map(|(panel, edges)| PartEdges {
        edges,
        space: panel.laid.sheet.mesh.positions(),
        flat: &panel.laid.flat.points,
    });
    join_mates(&mut parts.collect::<Vec<_>>());
    let whole = |(panel, edges): (Judged, Vec<Edge>)| {
        let Judged { name, mesh, laid, checked, joints, rebuilt } = panel;
        let Laid { sheet, flat, measures } = laid;
        let mut marks = seam_marks(&sheet.seams);
        marks.extend(joints.iter().map(|joint| EdgeMark {
            mark: joint.mark.clone(),
            steps: joint.steps.clone(),
            first: true,
        }));
        let piece = mesh_piece(&name, &sheet.mesh, &flat.points, &edges, &marks);
        MadeMesh { name, mesh, sheet, flat, measures, checked, piece, edges, joints, rebuilt }
    };
    panels.into_iter().zip(edges).map(whole).collect()
}

/// A part of a group that hangs together.
struct Part {
    name: String,
    mesh: Mesh,
    left_out: usize,
    specks: Option<Specks>,
    contacts: usize,
    joints: Vec<PartJoint>,
}

/// A joint of a part, by corners of its triangles: those at which each step starts and ends.
struct PartJoint {
    number: usize,
    with: usize,
    steps: Vec<(usize, [usize; 2])>,
}

fn parts_of(group: &MeshGroup, options: &MeshOptions) -> Result<Vec<Part>, MeshCause> {
    let bad = |error: MeshError, at: &dyn Fn(VertexIndex) -> Point3| {
        let corners = |t: TriangleIndex| group.triangles.get(t.get()).copied();
        let places = match error {
            MeshError::NotManifold { from, to } | MeshError::NotOrientable { from, to } => {
                vec![at(from), at(to)]
            }
            MeshError::Degenerate { triangle } => corners(triangle)
                .map(|t| t.iter().map(|v| group.positions[v.get()]).collect())
                .unwrap_or_default(),
            _ => Vec::new(),
        };
        MeshCause::Mesh { error, places }
    };
    let known = |v: &VertexIndex| v.get() < group.positions.len();
    if let Some(n) = group.triangles.iter().position(|corners| !corners.iter().all(known)) {
        let error = MeshError::BadCorner { triangle: TriangleIndex::new(n) };
        return Err(MeshCause::Mesh { error, places: Vec::new() });
    }
    // Points in which parts meet are no fault that anyone should have to mend.
    let apart = separated(&group.triangles, |_| false);
    let contacts: BTreeSet<VertexIndex> =
        apart.origin.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]).collect();
    let positions: Vec<Point3> = apart.origin.iter().map(|v| group.positions[v.get()]).collect();
    let at = |v: VertexIndex| positions[v.get()];
    let mut mesh =
        Mesh::new(positions.clone(), apart.triangles).map_err(|error| bad(error, &at))?;
    let mut seams = Vec::new();
    if let Some(crease) = options.split_creases {
        let split = split_along_creases(&mesh, crease);
        let split = split.map_err(|error| bad(error, &|v| mesh.position(v)))?;
        (mesh, seams) = (split.mesh, split.seams);
    }
    let pieces = mesh.pieces().len();
    if pieces > MAX_MESH_PANELS {
        return Err(MeshCause::Pieces { found: pieces });
    }
    let mut joints = joints_of(&mesh, &seams);
    let mut parts = Vec::with_capacity(pieces);
    for (n, piece) in mesh.pieces().iter().enumerate() {
        let whole = if pieces == 1 {
            mesh.clone()
        } else {
            mesh.part(&piece.triangles).map_err(|error| bad(error, &|v| mesh.position(v)))?.0
        };
        // What was found in the group as a whole is said once.
        let (left_out, contacts) = if n == 0 { (group.left_out, contacts.len()) } else { (0, 0) };
        let joints = std::mem::take(&mut joints[n]);
        let name = String::new();
        parts.push(Part { name, mesh: whole, left_out, specks: None, contacts, joints });
    }
    Ok(parts)
}

/// The joints of every piece of a mesh that was divided along some seams, numbered by the seams; a
/// triangle of a piece is numbered within it.
fn joints_of(mesh: &Mesh, seams: &[MeshSeam]) -> Vec<Vec<PartJoint>> {
    let mut place = vec![(0, 0); mesh.triangles().len()];
    for (n, piece) in mesh.pieces().iter().enumerate() {
        for (k, triangle) in piece.triangles.iter().enumerate() {
            place[triangle.get()] = (n, k);
        }
    }
    let mut joints: Vec<Vec<PartJoint>> = mesh.pieces().iter().map(|_| Vec::new()).collect();
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
        for ([piece, with], side) in [[a, b], [b, a]].into_iter().zip(sides) {
            let steps = side.into_iter().map(|step| step.1).collect();
            joints[piece].push(PartJoint { number, with, steps });
        }
    }
    joints
}

/// A sheet, laid flat.
struct Laid {
    sheet: CutMesh,
    flat: Relaxed,
    measures: MeshMeasures,
}

fn lay(
    mesh: &Mesh,
    cut: &Cut,
    options: &MeshOptions,
    watch: &mut dyn Watch,
) -> Result<Laid, MeshCause> {
    let sheet =
        cut_along(mesh, cut).map_err(|error| MeshCause::Mesh { error, places: Vec::new() })?;
    let relaxing = RelaxOptions { aim: options.aim, ..RelaxOptions::default() };
    let flat = relax(&sheet.mesh, &relaxing, watch).map_err(MeshCause::Flatten)?;
    let measures = mesh_measures(&sheet.mesh, &flat.points);
    Ok(Laid { sheet, flat, measures })
}

fn make_mesh(
    part: Part,
    material: Option<&Material>,
    options: &MeshOptions,
    watch: &mut dyn Watch,
) -> Result<Judged, MeshMakeError> {
    let Part { name, mesh, left_out, specks, contacts, joints } = part;
    let failed = |cause| MeshMakeError { panel: name.clone(), cause };
    watch.begin(&[&name], Stage::Flatten);
    let limit = stretch_limit(material);
    let piece = &mesh.pieces()[0];
    let needs_cut = piece.is_closed() || piece.handles() > 0;
    let mut cut = if needs_cut { cut_to_disk(&mesh) } else { Cut::new() };
    let mut closed = lay(&mesh, &cut, options, watch);
    if !needs_cut && !piece.is_disk() && is_poor(&closed, limit) && !watch.stop() {
        let opened = cut_to_disk(&mesh);
        let open = lay(&mesh, &opened, options, watch);
        if is_better(&open, &closed) {
            (cut, closed) = (opened, open);
        }
    }
    let mut laid = closed.map_err(failed)?;
    let mut darts = 0;
    while options.darts && darts < MOST_DARTS && laid.measures.length_error_max > limit {
        let Some(more) = with_dart(&mesh, &laid, &cut, limit) else { break };
        laid = lay(&mesh, &more, options, watch).map_err(failed)?;
        cut = more;
        darts += 1;
    }
    watch.begin(&[&name], Stage::Check);
    let Laid { sheet, flat, measures } = &laid;
    let suggested = cut_suggestion(&sheet.mesh, measures, limit).and_then(|cut| {
        let ends = [*cut.path.first()?, *cut.path.last()?];
        Some(ends.map(|v| sheet.mesh.position(v)))
    });
    let first_of = |n: usize| sheet.mesh.position(VertexIndex::new(n));
    let checked = check_mesh(&MeshPanel {
        mesh: &mesh,
        sheet,
        length_error_max: measures.length_error_max,
        worst_edge: worst_edge(measures),
        border_error: (options.aim == Aim::Seams).then_some(measures.border_error_max),
        cut: suggested,
        overlap: flat.overlap.map(|(a, b)| [first_of(a), first_of(b)]),
        flipped: flat.flipped,
        left_out,
        specks,
        contacts,
        darts,
        material,
    });
    let joints: Vec<Joint> = joints.into_iter().map(|joint| on_sheet(joint, sheet)).collect();
    let rebuilt = options.split_creases.and_then(|_| rebuilt(&mesh, watch));
    Ok(Judged { name: name.clone(), mesh: mesh.clone(), laid, checked, joints, rebuilt })
}

/// A joint by the vertices of the sheet as it is cut.
fn on_sheet(joint: PartJoint, sheet: &CutMesh) -> Joint {
    let ends = |&(triangle, ends): &(usize, [usize; 2])| {
        ends.map(|corner: usize| sheet.mesh.triangles()[triangle][corner])
    };
    let steps: Vec<[VertexIndex; 2]> = joint.steps.iter().map(ends).collect();
    let length =
        |[a, b]: &[VertexIndex; 2]| sheet.mesh.position(*a).distance(sheet.mesh.position(*b));
    let length_mm = steps.iter().map(length).sum();
    Joint { mark: joint_mark(joint.number), with: joint.with, length_mm, steps }
}

/// Whether a sheet as it stands is worth cutting for.
fn is_poor(laid: &Result<Laid, MeshCause>, limit: f64) -> bool {
    laid.as_ref().map_or(true, |laid| {
        let error = laid.measures.length_error_max;
        error.is_nan() || error > limit || laid.flat.overlap.is_some() || laid.flat.flipped > 0
    })
}

/// Whether a sheet is so much better for its cut that it is worth it.
fn is_better(open: &Result<Laid, MeshCause>, closed: &Result<Laid, MeshCause>) -> bool {
    let (Ok(open), Ok(closed)) = (open, closed) else { return open.is_ok() };
    open.measures.length_error_max < MUCH_LESS * closed.measures.length_error_max
        || (closed.flat.overlap.is_some() && open.flat.overlap.is_none())
}

/// A panel is cut to so many points, at the most: each takes laying it flat again.
const MOST_DARTS: usize = 12;

/// The cut with the one added that the measures of the sheet suggest; `None` where they suggest
/// none that is new.
fn with_dart(mesh: &Mesh, laid: &Laid, cut: &Cut, limit: f64) -> Option<Cut> {
    let suggested = cut_suggestion(&laid.sheet.mesh, &laid.measures, limit)?;
    let way: Vec<VertexIndex> = suggested.path.iter().map(|v| laid.sheet.origin[v.get()]).collect();
    let sides = way.windows(2).map(|pair| mesh.topology().edge_between(pair[0], pair[1]));
    let mut more = cut.clone();
    more.extend(sides.collect::<Option<Vec<usize>>>()?);
    (more.len() > cut.len()).then_some(more)
}
