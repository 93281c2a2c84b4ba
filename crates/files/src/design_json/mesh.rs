//! Panels whose surface is a mesh: their fields, and the mesh files of a design.

use super::beside::{Kind, file_beside};
use super::grammar::{AimName, MeshFile, PanelFile, SkinName, TrianglesFile, Triple};
use super::source::Source;
use crate::json::json;
use crate::mesh::{Builder, MeshFormat, MeshGroup, groups};
use crate::names::{did_you_mean, shown};
use crate::reading::{InputError, MAX_INPUT_BYTES, read_whole};
use crate::units::Units;
use sheetwright::design::{PanelMesh, PanelShape, Triangles};
use sheetwright::flatten::Aim;
use sheetwright::math::{Point3, from_deg, to_deg};
use sheetwright::mesh::{MAX_MESH_COORDINATE_MM, MAX_TRIANGLES, Skin};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

const MESH: Kind = Kind { word: "mesh", files: "a mesh (.obj, .stl, .ply or .glb)" };

/// Seams, which all panels of one group share.
type Seams = Arc<Vec<Vec<Point3>>>;

/// A group of a mesh file: its name, its triangles, its seams.
type Group = (String, Arc<Triangles>, Seams);

/// The meshes of a design, each read once.
pub(super) struct Meshes<'a> {
    source: &'a Source<'a>,
    units: Units,
    read: BTreeMap<PathBuf, Vec<Group>>,
    /// The bytes left for the other mesh files of the design.
    bytes_left: u64,
}

impl<'a> Meshes<'a> {
    pub(super) fn new(source: &'a Source<'a>, units: Units) -> Self {
        Self { source, units, read: BTreeMap::new(), bytes_left: MAX_INPUT_BYTES }
    }

    /// The mesh that the fields of a panel describe; `None` for a panel that is no mesh. `path` is
    /// the panel's JSON path.
    pub(super) fn shape(
        &mut self,
        file: &mut PanelFile,
        path: &str,
    ) -> Result<Option<PanelShape>, InputError> {
        let at = |field: &str| format!("{path}{field}");
        let Some(mesh) = file.mesh.take() else {
            let given = [
                (".group", file.group.is_some()),
                (".aim", file.aim.is_some()),
                (".split_creases_deg", file.split_creases_deg.is_some()),
                (".darts", file.darts.is_some()),
                (".skin", file.skin.is_some()),
                (".facets", file.facets.is_some()),
                (".pieces_within", file.pieces_within.is_some()),
                (".seams", file.seams.is_some()),
            ];
            if let Some((field, _)) = given.into_iter().find(|(_, given)| *given) {
                let hint = "Add \"mesh\": \"hood.stl\", or leave this field out.";
                return Err(self.source.error(&at(field), "the panel is no mesh", hint));
            }
            return Ok(None);
        };
        self.refuse_curves(file, path)?;
        let (triangles, mut seams) = match &mesh {
            MeshFile::Path(name) => self.of_file(name, file.group.as_deref(), path)?,
            MeshFile::Triangles(_) if file.group.is_some() => {
                let message = "`group` names a group of a mesh file, and there is no file";
                return Err(self.source.error(&at(".group"), message, "Leave `group` out."));
            }
            MeshFile::Triangles(given) => {
                (Arc::new(self.of_list(given, &at(".mesh"))?), Seams::default())
            }
        };
        let own = self.seams(file, &at(".seams"))?;
        if !own.is_empty() {
            Arc::make_mut(&mut seams).extend(own);
        }
        let split_creases = file.split_creases_deg.map(|deg| {
            let is_angle = (1.0..180.0).contains(&deg);
            is_angle.then(|| from_deg(deg)).ok_or_else(|| {
                let message = format!("the crease angle is {deg}°");
                let hint = "Write an angle from 1 to below 180 degrees.";
                self.source.error(&at(".split_creases_deg"), message, hint)
            })
        });
        let within = file.pieces_within.map(|size| {
            let size = size.map(|length| length * self.units.in_mm());
            let is_size = size.iter().all(|&mm| mm > 0.0 && mm.is_finite());
            is_size.then_some(size).ok_or_else(|| {
                let message = "the size of pieces is not above 0";
                let hint = "Write the width and the height of a piece, such as [275, 170].";
                self.source.error(&at(".pieces_within"), message, hint)
            })
        });
        let mesh = PanelMesh {
            triangles,
            aim: match file.aim {
                None | Some(AimName::Mean) => Aim::Mean,
                Some(AimName::Max) => Aim::Max,
                Some(AimName::Seams) => Aim::Seams,
            },
            split_creases: split_creases.transpose()?,
            darts: file.darts.unwrap_or(false),
            skin: file.skin.map(|skin| match skin {
                SkinName::Outer => Skin::Outer,
                SkinName::Inner => Skin::Inner,
            }),
            facets: file.facets,
            pieces_within_mm: within.transpose()?,
            seams,
        };
        Ok(Some(PanelShape::Mesh(self.source.options.mesh.applied(mesh))))
    }

    /// The seams of a panel, mm.
    fn seams(&self, file: &PanelFile, path: &str) -> Result<Vec<Vec<Point3>>, InputError> {
        let given = file.seams.as_deref().unwrap_or_default();
        let points: usize = given.iter().map(Vec::len).sum();
        if points > MAX_TRIANGLES {
            let message = format!("the seams have {points} points");
            let hint = format!("The limit is {MAX_TRIANGLES}, as that of triangles.");
            return Err(self.source.error(path, message, hint));
        }
        if let Some(n) = given.iter().position(|way| way.len() < 2) {
            let hint = "Write two points or more: [[0, 0, 0], [0, 0, 50]].";
            let path = format!("{path}[{n}]");
            return Err(self.source.error(&path, "the seam has fewer than 2 points", hint));
        }
        let unit_mm = self.units.in_mm();
        let point = |n: usize, k: usize, given: &Triple| {
            let [x, y, z] = given.0.map(|c| c * unit_mm);
            // Also where one is no number.
            let fits = [x, y, z].iter().all(|c| c.abs() <= MAX_MESH_COORDINATE_MM);
            fits.then_some(Point3::new(x, y, z)).ok_or_else(|| {
                let message = "a coordinate is not a finite number within ±1e11 mm";
                let hint = "Check the units and the numbers.";
                self.source.error(&format!("{path}[{n}][{k}]"), message, hint)
            })
        };
        let way = |(n, way): (usize, &Vec<Triple>)| {
            way.iter().enumerate().map(|(k, given)| point(n, k, given)).collect()
        };
        given.iter().enumerate().map(way).collect()
    }

    /// Refuses fields that are for panels whose surface is found.
    fn refuse_curves(&self, file: &PanelFile, path: &str) -> Result<(), InputError> {
        let given = [
            ("rails", file.rails.is_some()),
            ("boundary", file.boundary.is_some()),
            ("holes", file.holes.is_some()),
            ("join", file.join.is_some()),
            ("samples", file.samples.is_some()),
            ("tolerance", file.tolerance.is_some()),
            ("method", file.method.is_some()),
            ("goal", file.goal.is_some()),
            ("run_on", file.run_on.is_some()),
            ("slide", file.slide.is_some()),
            ("plane", file.plane.is_some()),
            ("fold", file.fold.is_some()),
            ("effort", file.effort.is_some()),
            ("cut", file.cut.is_some()),
            ("side", file.side.is_some()),
            ("near", file.near.is_some()),
            ("vary", file.vary.is_some()),
        ];
        let Some((field, _)) = given.into_iter().find(|(_, given)| *given) else { return Ok(()) };
        let message = format!("the panel is a mesh and has `{field}`, which is for curves");
        let hint = "Keep one of the two: a mesh is laid flat as it is.";
        Err(self.source.error(path, message, hint))
    }

    /// A group of a mesh file, the only one if none is named.
    fn of_file(
        &mut self,
        name: &str,
        wanted: Option<&str>,
        path: &str,
    ) -> Result<(Arc<Triangles>, Seams), InputError> {
        let at = format!("{path}.mesh");
        let Some(folder) = self.source.folder else {
            let message = "a design from standard input can't take a mesh from a file";
            let hint = "Save the design as a file in the folder of its meshes.";
            return Err(self.source.error(&at, message, hint));
        };
        let source = self.source;
        let file =
            file_beside(folder, name, MESH, &|message, hint| source.error(&at, message, hint))?;
        if !self.read.contains_key(&file) {
            let groups = self.read_anew(&file, name, &at)?;
            self.read.insert(file.clone(), groups);
        }
        let groups = self.read.get(&file).map_or(&[][..], Vec::as_slice);
        let found = match (wanted, groups) {
            (Some(wanted), _) => groups.iter().find(|(name, ..)| name == wanted),
            (None, [only]) => Some(only),
            (None, _) => None,
        };
        let shared = |(_, triangles, seams): &Group| (triangles.clone(), seams.clone());
        found.map(shared).ok_or_else(|| {
            let known: Vec<&str> = groups.iter().map(|(name, ..)| name.as_str()).collect();
            let (message, hint) = match wanted {
                Some(wanted) => (
                    format!("{} has no group {}", shown(name), shown(wanted)),
                    did_you_mean(wanted, &known),
                ),
                None => (
                    format!("{} has {} groups, and none is named", shown(name), groups.len()),
                    format!("Name one with \"group\". {}", did_you_mean("", &known)),
                ),
            };
            self.source.error(&format!("{path}.group"), message, hint)
        })
    }

    fn read_anew(&mut self, file: &Path, name: &str, at: &str) -> Result<Vec<Group>, InputError> {
        let ending = file.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        let Some(format) = MeshFormat::of_ending(&ending.to_lowercase()) else {
            let message = format!("{} is no mesh", shown(name));
            let hint = "Name a file that ends in .obj, .stl, .ply or .glb.";
            return Err(self.source.error(at, message, hint));
        };
        // Errors show the path as the design has it, not the resolved one.
        let bytes = read_whole(file)
            .map_err(|error| InputError { place: Some(name.to_owned()), ..error })?;
        let size = bytes.len() as u64;
        if size > self.bytes_left {
            let message = "the meshes of the design are larger than 256 MiB in total";
            let hint = "Export them with fewer triangles; ten thousand are enough for most shapes.";
            return Err(self.source.error(at, message, hint));
        }
        self.bytes_left -= size;
        let (groups, _) = groups(format, &bytes, name, self.units)?;
        let shared =
            |group: MeshGroup| (group.name, Arc::new(group.triangles), Seams::new(group.seams));
        Ok(groups.into_iter().map(shared).collect())
    }

    /// Triangles that stand in the design itself.
    fn of_list(&self, given: &TrianglesFile, path: &str) -> Result<Triangles, InputError> {
        let place = format!("{}: {path}", self.source.place);
        let mut builder = Builder::new(&place, "mesh", self.units.in_mm());
        for (n, Triple(xyz)) in given.points.iter().enumerate() {
            builder.point(*xyz, || format!("{place}.points[{n}]"))?;
        }
        for (n, corners) in given.triangles.iter().enumerate() {
            let at = || format!("{place}.triangles[{n}]");
            if let Some(corner) = corners.iter().find(|&&corner| corner >= given.points.len()) {
                let message = format!("there is no point {corner}");
                let hint = format!("Points are counted from 0; there are {}.", given.points.len());
                return Err(InputError::at(at(), message, hint));
            }
            builder.polygon(corners, at)?;
        }
        // One group is begun, so `built` returns one, or refuses a mesh without triangles.
        let built = builder.built()?;
        let triangles = built.groups.into_iter().next().map(|group| group.named().triangles);
        let mut triangles = triangles.unwrap_or_default();
        triangles.left_out += given.left_out;
        Ok(triangles)
    }
}

/// The fields of a panel that is a mesh, as the text of its file.
pub(super) fn fields(mesh: &PanelMesh) -> Vec<String> {
    let Triangles { positions, triangles, left_out } = &*mesh.triangles;
    let given = TrianglesFile {
        points: positions.iter().map(|p| Triple([p.x, p.y, p.z])).collect(),
        triangles: triangles.iter().map(|t| t.map(|v| v.get())).collect(),
        left_out: *left_out,
    };
    let mut fields = vec![format!("\"mesh\": {}", json(&given))];
    match mesh.aim {
        Aim::Mean => {}
        Aim::Max => fields.push(format!("\"aim\": {}", json(&AimName::Max))),
        Aim::Seams => fields.push(format!("\"aim\": {}", json(&AimName::Seams))),
    }
    if let Some(crease) = mesh.split_creases {
        fields.push(format!("\"split_creases_deg\": {}", json(&to_deg(crease))));
    }
    if mesh.darts {
        fields.push("\"darts\": true".to_owned());
    }
    let skin = mesh.skin.map(|skin| match skin {
        Skin::Outer => SkinName::Outer,
        Skin::Inner => SkinName::Inner,
    });
    fields.extend(skin.map(|skin| format!("\"skin\": {}", json(&skin))));
    if let Some(facets) = mesh.facets {
        fields.push(format!("\"facets\": {facets}"));
    }
    if let Some(size) = mesh.pieces_within_mm {
        fields.push(format!("\"pieces_within\": {}", json(&size)));
    }
    if !mesh.seams.is_empty() {
        let point = |p: &Point3| Triple([p.x, p.y, p.z]);
        let way = |way: &Vec<Point3>| way.iter().map(point).collect();
        let seams: Vec<Vec<Triple>> = mesh.seams.iter().map(way).collect();
        fields.push(format!("\"seams\": {}", json(&seams)));
    }
    fields
}
