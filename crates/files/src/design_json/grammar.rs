//! The design as it stands in its file: what serde reads and writes, and the JSON Schema.
//!
//! The doc comments of these types are the descriptions in docs/schema/design.schema.json.

use super::bends::BendsFile;
use super::drawing::DrawingFile;
use super::marks::MarkFile;
use super::sheets::SheetsFile;
use super::trims::{TrimFile, Written};
use crate::json::{Called, Named, Object};
use crate::materials::{MaterialChoice, MaterialFile};
use crate::table::MAX_ROWS;
use crate::units::Units;
use schemars::JsonSchema;
use serde::de::{self, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Serialize, Serializer};
use std::collections::BTreeMap;
use std::fmt;

/// A design of Sheetwright: curves, and the panels between them.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Sheetwright design")]
pub(super) struct DesignFile {
    /// Where this schema lies, for editors; not used otherwise.
    #[serde(rename = "$schema", default)]
    #[allow(dead_code, reason = "editors read it, this program does not")]
    schema: Option<String>,
    /// The version of this format: 1.
    #[schemars(range(min = 1, max = 1))]
    pub(super) sheetwright: u64,
    /// The design's name. Default: the name of the file without its ending.
    #[serde(default)]
    pub(super) name: Option<String>,
    /// The unit of all points, and of the tables that they are taken from. Default: mm, and of a
    /// table of offsets the unit that it names.
    #[serde(default)]
    pub(super) units: Option<Units>,
    /// The sheet it is made from: the name of a material, such as `plywood-4mm`, or what it takes.
    /// Default: a sheet that takes 6° of warp.
    #[serde(default)]
    pub(super) material: Option<MaterialChoice>,
    /// Materials of its own, by name. One with a name of the catalogue takes its place.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, MaterialFile>")]
    pub(super) materials: Named<MaterialFile>,
    /// The curves, by name. Default: none, of a design of meshes.
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, CurveFile>")]
    pub(super) curves: Named<CurveFile>,
    /// The panels; each becomes a piece of sheet.
    #[schemars(with = "Vec<PanelFile>")]
    pub(super) panels: Vec<Object<PanelFile>>,
    /// What may move so that the panels bend better, and how far.
    #[serde(default)]
    #[schemars(with = "Option<VaryFile>")]
    pub(super) vary: Option<Object<VaryFile>>,
    /// Whether curves that several panels share get as many samples on each, so that both sides of
    /// a seam are equally long. They do in any case where something moves. Default: false.
    #[serde(default)]
    pub(super) match_seams: bool,
    /// The trade that it is made for: what is done along its edges, and which files are written.
    /// docs/trades.md lists them. Default: none, bare outlines.
    #[serde(default, rename = "for")]
    pub(super) trade: Option<String>,
    /// What is done along its edges. One with the `kind` and the `on` of a trim of its trade
    /// replaces fields of that.
    #[serde(default)]
    #[schemars(with = "Option<Vec<TrimFile>>")]
    pub(super) trims: Vec<Written>,
    /// What is marked on the faces of its parts: stations, grain, folds, holes, texts.
    #[serde(default)]
    #[schemars(with = "Option<Vec<MarkFile>>")]
    pub(super) marks: Vec<Written>,
    /// The preset that its SVG and DXF files are written for: `generic`, `lightburn`, `glowforge`,
    /// `cricut`, `silhouette`, `plotter` or `wazer`. Default: that of its trade, or generic.
    #[serde(default)]
    pub(super) preset: Option<String>,
    /// The release of its DXF files: `r12` or `r2000`. Default: that of its trade, or of its
    /// preset.
    #[serde(default)]
    pub(super) dxf: Option<String>,
    /// How near the arcs of DXF files stay to the cut lines that they take the place of, in the
    /// units of the design, up to 10 mm. Default: cut lines have straight sides.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub(super) arcs: Option<f64>,
    /// The formats that its files are written in, such as `dxf` and `report`; docs/outputs.md lists
    /// them. Default: those of its trade, or `obj`, `svg`, `dxf`, `pdf` and `report`.
    #[serde(default)]
    pub(super) formats: Vec<String>,
    /// Which face of the sheet the curves lie on: the pattern then is that of the neutral fibre of
    /// a sheet of this thickness. Default: that of the surface through the curves.
    #[serde(default)]
    pub(super) dimensions: Option<DimensionsName>,
    /// How thick the sheet is, in the units of the design. Default: as its material.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub(super) thickness: Option<f64>,
    /// The inner radius of the tool that makes sharp folds, in the units of the design: with
    /// `dimensions`, flat patterns have the bend allowance there. Default: the smallest bend radius
    /// of the material, or the thickness where none is named.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub(super) bend_radius: Option<f64>,
    /// The tolerance of panels that have none of their own and no number of samples, in the units
    /// of the design. Default: a ten-thousandth of the size of the panel, with 400 samples of a
    /// loop or 200 of a rail at the least and twice as many at the most.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub(super) tolerance: Option<f64>,
    /// What its parts are cut from, and how they may lie on it.
    #[serde(default)]
    #[schemars(with = "Option<SheetsFile>")]
    pub(super) sheets: Option<Object<SheetsFile>>,
    /// How bends are marked on the patterns of panels that do not say it themselves.
    #[serde(default)]
    #[schemars(with = "Option<BendsFile>")]
    pub(super) bends: Option<Object<BendsFile>>,
    /// How it is drawn in the editor. Nothing in it changes what is made.
    #[serde(default)]
    #[schemars(with = "Option<DrawingFile>")]
    pub(super) drawing: Option<Object<DrawingFile>>,
}

/// A face of the sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum DimensionsName {
    /// The inner one of its bends, as duct shops give clear sizes.
    Inside,
    /// The middle of the sheet.
    Mean,
    /// The outer one.
    Outside,
}

/// What may move, how far, and what for. Where points have a distance `move`, only those move that
/// do, each by that at the most.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct VaryFile {
    /// How far all samples may move in sum. Default: any distance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub(super) budget: Option<f64>,
    /// How far each sample may move. Default: any distance; or, where nothing says how far anything
    /// may move, a hundredth of the size of the panels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub(super) limit: Option<f64>,
    /// The largest warp angle to be reached, degrees, by the smallest displacements. Default: none;
    /// twist and folds are made as small as can be.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 90))]
    pub(super) warp_deg: Option<f64>,
    /// The largest strain to be reached, as a share of what the sheet takes, by displacements that
    /// are small. Not beside `warp_deg`. Default: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.05, max = 1))]
    pub(super) strain: Option<f64>,
    /// The curves that may move. Default: all those of the panels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) curves: Option<Vec<String>>,
    /// The panels that are to bend better; others follow where they share a curve. Not in a panel.
    /// Default: all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) panels: Option<Vec<String>>,
    /// What moves: the points of the curves, or each sample. Default: points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) by: Option<MovedByName>,
    /// Whether panels stay as they are that are developable already, as far as their samples tell.
    /// Default: true.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) leave_developable: Option<bool>,
}

/// What moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum MovedByName {
    /// The points that curves are made from, so that curves stay as fair as they are drawn.
    Points,
    /// Each sample: curves become splines through them.
    Samples,
}

/// A curve. It has `points`, or a `table` that they are taken from.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CurveFile {
    /// How the points make the curve.
    pub(super) kind: KindName,
    /// Whether it ends where it begins; its last point does not repeat the first. Default: false.
    #[serde(default)]
    pub(super) closed: bool,
    /// Its points, in order.
    #[serde(default)]
    #[schemars(with = "Option<Vec<PointFile>>")]
    pub(super) points: Option<Points>,
    /// A curve table, by a path relative to the design's folder, at or below it.
    #[serde(default)]
    pub(super) table: Option<String>,
    /// Which curve of the table. Default: the only one.
    #[serde(default)]
    pub(super) curve: Option<String>,
}

impl Called for CurveFile {
    const CALLED: &str = "curve";
}

/// How points make a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum KindName {
    /// Straight from point to point; every point is a corner.
    Polyline,
    /// An interpolating cubic spline: natural at open ends and corners, periodic when closed.
    Spline,
    /// A uniform cubic B-spline with the points as control points.
    BSpline,
    /// The points of a closed curve are the samples themselves; tangents are central differences.
    Samples,
}

/// A point: `[x, y, z]`, or an object that says more.
#[derive(Debug, JsonSchema)]
#[schemars(untagged)]
pub(super) enum PointFile {
    /// Where it lies.
    Bare([f64; 3]),
    /// Where it lies, and more.
    Full(FullPoint),
}

/// A point that is a corner, or that may move.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct FullPoint {
    /// Where it lies: `[x, y, z]`.
    #[schemars(with = "[f64; 3]")]
    pub(super) at: Triple,
    /// Whether the curve has a corner here. Default: false.
    #[serde(default)]
    pub(super) corner: bool,
    /// How far it may be moved so that the sheet bends better; 0: not at all, where other points
    /// may. Default: 0.
    #[serde(default, rename = "move")]
    #[schemars(range(min = 0))]
    pub(super) movable: f64,
}

/// A panel. It has two `rails`, or a `boundary` with or without `holes`, or it is a `join`; or its
/// surface is given as a `mesh`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PanelFile {
    /// Its name, which its files get.
    pub(super) name: String,
    /// Two open curves, which may run either way; straight edges join their ends.
    #[serde(default)]
    #[schemars(length(min = 2, max = 2))]
    pub(super) rails: Option<Vec<String>>,
    /// Curves chained end to end to the outer loop; `-name` is reversed.
    #[serde(default)]
    #[schemars(length(min = 1))]
    pub(super) boundary: Option<Vec<String>>,
    /// Loops inside the outer one, each a list of curves.
    #[serde(default)]
    pub(super) holes: Option<Vec<Vec<String>>>,
    /// Other panels whose boundaries are joined along what they share.
    #[serde(default)]
    #[schemars(length(min = 2, max = 100))]
    pub(super) join: Option<Vec<String>>,
    /// How smooth the boundary of a join is made where two panels meet on it. Default: none.
    #[serde(default)]
    pub(super) smooth: Option<SmoothName>,
    /// How far from there it may be changed for that, along the boundary to both sides: a distance,
    /// or a share of the length of its loop. Default: a share of 0.05.
    #[serde(default)]
    pub(super) within: Option<WithinFile>,
    /// Whether the panels that are joined are made too. Default: false, the join takes their place.
    #[serde(default)]
    pub(super) keep_parts: Option<bool>,
    /// Its surface as triangles: a mesh file (.obj, .stl, .ply or .glb), by a path relative to the
    /// design's folder, at or below it and in the design's units; or the triangles themselves.
    #[serde(default)]
    pub(super) mesh: Option<MeshFile>,
    /// Which group of the mesh file. Default: the only one.
    #[serde(default)]
    pub(super) group: Option<String>,
    /// What flattening a mesh makes small where it can't be exact. Default: mean.
    #[serde(default)]
    pub(super) aim: Option<AimName>,
    /// A mesh is divided into parts along creases above this angle, degrees. Default: it is not.
    #[serde(default)]
    #[schemars(range(min = 1, max = 180))]
    pub(super) split_creases_deg: Option<f64>,
    /// Whether a mesh that would have to stretch more than the material takes is cut from its
    /// border to its worst points. Default: false.
    #[serde(default)]
    pub(super) darts: Option<bool>,
    /// Which skin of a plate is laid flat that comes as a closed mesh with two. Default: all of the
    /// mesh.
    #[serde(default)]
    pub(super) skin: Option<SkinName>,
    /// Whether a mesh is folded between its facets, and stretched nowhere, as a paper model is;
    /// false lays it flat as a smooth surface. Default: it is folded where it would not bend as one
    /// surface, its facets are 2,000 or fewer, and they turn sharply.
    #[serde(default)]
    pub(super) facets: Option<bool>,
    /// The width and height of a rectangle that no piece of a folded mesh exceeds, in the units of
    /// the design. Default: no limit.
    #[serde(default)]
    pub(super) pieces_within: Option<[f64; 2]>,
    /// Ways along which a mesh is cut, each by two points or more, in the units of the design: it
    /// goes along sides from the vertex nearest to one point to that nearest to the next. They are
    /// added to the lines of the mesh's file. Default: those lines alone, if any.
    #[serde(default)]
    #[schemars(with = "Option<Vec<Vec<[f64; 3]>>>")]
    pub(super) seams: Option<Vec<Vec<Triple>>>,
    /// Samples of the outer loop, or of each rail. Default: as many as the tolerance takes.
    #[serde(default)]
    #[schemars(range(min = 2, max = 1_000_000))]
    pub(super) samples: Option<u64>,
    /// How near the polygon through its samples stays to its curves, in the units of the design,
    /// where `samples` is not given: no curve lies farther from it, along no edge is it shorter by
    /// more. Default: as the design says.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub(super) tolerance: Option<f64>,
    /// Which triangulations are looked at. Default: optimal.
    #[serde(default)]
    pub(super) method: Option<MethodName>,
    /// What is made as small as can be. Default: price.
    #[serde(default)]
    pub(super) goal: Option<GoalName>,
    /// Whether the rails run on beyond their ends, so that rulings may leave the panel there; its
    /// ends are then curves. Only for rails. Default: false.
    #[serde(default)]
    pub(super) run_on: Option<bool>,
    /// Whether the edges slide along the boundary while the sheet is bent; between rails, nothing
    /// holds its straight ends then. Default: false, every point of an edge is held.
    #[serde(default)]
    pub(super) slide: Option<bool>,
    /// The supporting plane: `auto`, `none` or a normal `[x, y, z]`. Default: auto.
    #[serde(default)]
    pub(super) plane: Option<PlaneFile>,
    /// The weight of the fold price; 0 is twist alone. Default: as the documentation argues.
    #[serde(default)]
    #[schemars(range(min = 0, max = 10))]
    pub(super) fold: Option<f64>,
    /// How much work the search may do where there are holes, as a multiple of the default, which
    /// is a few seconds. Default: 1.
    #[serde(default)]
    #[schemars(range(min = 0.001, max = 1000))]
    pub(super) effort: Option<f64>,
    /// Where the pattern of a panel with holes is to be cut open, if it must be: points `[x, y,
    /// z]`, at the most one a hole. Cuts run from loop to loop, where their middles lie nearest to
    /// the points. Default: where they are shortest.
    #[serde(default)]
    #[schemars(with = "Option<Vec<[f64; 3]>>")]
    pub(super) cut: Option<Vec<Triple>>,
    /// Which surface is meant where two fit the boundary about as well. Default: cheapest.
    #[serde(default)]
    pub(super) side: Option<SideName>,
    /// Points `[x, y, z]` that the surface should pass near: they choose between surfaces that fit
    /// the boundary about as well. Default: none.
    #[serde(default)]
    #[schemars(with = "Option<Vec<[f64; 3]>>")]
    pub(super) near: Option<Vec<Triple>>,
    /// What of this panel may move so that it bends better, and how far.
    #[serde(default)]
    #[schemars(with = "Option<VaryFile>")]
    pub(super) vary: Option<Object<VaryFile>>,
    /// How its bends are marked on its pattern. Default: as the design says.
    #[serde(default)]
    #[schemars(with = "Option<BendsFile>")]
    pub(super) bends: Option<Object<BendsFile>>,
    /// How many of it are cut, up to 100000. Default: 1.
    #[serde(default)]
    #[schemars(range(min = 1, max = 100_000))]
    pub(super) count: Option<u32>,
    /// How many of those are turned over, as of a left and a right. Default: none.
    #[serde(default)]
    pub(super) mirrored: Option<u32>,
}

/// Which triangulations are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum MethodName {
    /// All of them.
    Optimal,
    /// Those whose every triangle has an edge of the boundary.
    Bridge,
    /// Those whose every rung joins the two rails.
    Rails,
}

/// Which of two surfaces that fit a boundary about as well.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum SideName {
    /// The one with the lower price.
    Cheapest,
    /// The other.
    Other,
}

/// The surface of a panel as triangles.
#[derive(Debug, JsonSchema)]
#[schemars(untagged)]
pub(super) enum MeshFile {
    /// The path of a mesh file.
    Path(String),
    /// The triangles.
    Triangles(TrianglesFile),
}

/// Triangles over points.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct TrianglesFile {
    /// Its points `[x, y, z]`, in the design's units.
    #[schemars(with = "Vec<[f64; 3]>")]
    pub(super) points: Vec<Triple>,
    /// Its triangles, each by the numbers of three points from 0, counter-clockwise as seen from
    /// the side that the pattern shows.
    pub(super) triangles: Vec<[usize; 3]>,
    /// How many triangles of the file that it came from were left out, with two corners in one
    /// place. Default: 0.
    #[serde(default, skip_serializing_if = "is_none_left_out")]
    pub(super) left_out: usize,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde hands a reference over")]
fn is_none_left_out(count: &usize) -> bool {
    *count == 0
}

/// One of the two skins of a plate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum SkinName {
    /// The larger one, which lies outside where the plate bends one way.
    Outer,
    /// The other.
    Inner,
}

/// What flattening makes small.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum AimName {
    /// The mean length error.
    Mean,
    /// The largest length error.
    Max,
    /// That of the border, which is kept exact.
    Seams,
}

/// What is made as small as can be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum GoalName {
    /// Twist and folds in all.
    Price,
    /// The largest warp angle first, and of the surfaces that share the smallest, twist and folds
    /// in all. Not for panels with holes.
    WorstWarp,
}

/// How smooth a joint is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(super) enum SmoothName {
    /// As it comes, mostly with a corner.
    #[serde(rename = "none")]
    None,
    /// One tangent.
    G1,
    /// One tangent and one curvature.
    G2,
}

/// How far from a joint.
#[derive(Debug, JsonSchema)]
#[schemars(untagged)]
pub(super) enum WithinFile {
    /// A distance along the boundary, in the design's units.
    Way(#[schemars(range(min = 0))] f64),
    /// A share of the length of the boundary.
    Share(ShareFile),
}

/// A share of a length.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ShareFile {
    /// The share, above 0 and up to 0.5.
    #[schemars(range(min = 0, max = 0.5))]
    pub(super) share: f64,
}

/// The supporting plane.
#[derive(Debug, JsonSchema)]
#[schemars(untagged)]
pub(super) enum PlaneFile {
    /// Whether there is one.
    Named(PlaneName),
    /// Its normal.
    Normal([f64; 3]),
}

/// Whether there is a supporting plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum PlaneName {
    /// The best-fit plane, where the boundary projects onto it without crossing itself.
    Auto,
    /// None.
    None,
}

/// Three numbers; said in one sentence where it is anything else.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triple(pub(super) [f64; 3]);

impl Triple {
    fn from_seq<'de, A: SeqAccess<'de>>(mut seq: A) -> Result<Self, A::Error> {
        let mut numbers = [0.0; 3];
        for (n, number) in numbers.iter_mut().enumerate() {
            *number = seq
                .next_element()?
                .ok_or_else(|| de::Error::custom(format!("found {n} numbers, expected three")))?;
        }
        match seq.next_element::<IgnoredAny>()? {
            None => Ok(Self(numbers)),
            Some(_) => Err(de::Error::custom("found more than three numbers, expected three")),
        }
    }
}

impl<'de> Deserialize<'de> for Triple {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Three;
        impl<'de> Visitor<'de> for Three {
            type Value = Triple;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "three numbers [x, y, z]")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Triple, A::Error> {
                Triple::from_seq(seq)
            }
        }
        deserializer.deserialize_seq(Three)
    }
}

impl<'de> Deserialize<'de> for PointFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Point;
        impl<'de> Visitor<'de> for Point {
            type Value = PointFile;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a point [x, y, z] or an object with `at`")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<PointFile, A::Error> {
                Triple::from_seq(seq).map(|triple| PointFile::Bare(triple.0))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<PointFile, A::Error> {
                FullPoint::deserialize(de::value::MapAccessDeserializer::new(map))
                    .map(PointFile::Full)
            }
        }
        deserializer.deserialize_any(Point)
    }
}

impl Serialize for Triple {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for MeshFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct MeshVisitor;
        impl<'de> Visitor<'de> for MeshVisitor {
            type Value = MeshFile;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "the path of a mesh file or an object with `points` and `triangles`")
            }
            fn visit_str<E: de::Error>(self, path: &str) -> Result<MeshFile, E> {
                Ok(MeshFile::Path(path.to_owned()))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MeshFile, A::Error> {
                TrianglesFile::deserialize(de::value::MapAccessDeserializer::new(map))
                    .map(MeshFile::Triangles)
            }
        }
        deserializer.deserialize_any(MeshVisitor)
    }
}

impl<'de> Deserialize<'de> for WithinFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Within;
        impl<'de> Visitor<'de> for Within {
            type Value = WithinFile;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a distance or an object with `share`")
            }
            fn visit_f64<E: de::Error>(self, way: f64) -> Result<WithinFile, E> {
                Ok(WithinFile::Way(way))
            }
            fn visit_u64<E: de::Error>(self, way: u64) -> Result<WithinFile, E> {
                Ok(WithinFile::Way(way as f64))
            }
            fn visit_i64<E: de::Error>(self, way: i64) -> Result<WithinFile, E> {
                Ok(WithinFile::Way(way as f64))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<WithinFile, A::Error> {
                ShareFile::deserialize(de::value::MapAccessDeserializer::new(map))
                    .map(WithinFile::Share)
            }
        }
        deserializer.deserialize_any(Within)
    }
}

impl<'de> Deserialize<'de> for PlaneFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Plane;
        impl<'de> Visitor<'de> for Plane {
            type Value = PlaneFile;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "\"auto\", \"none\" or a normal [x, y, z]")
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<PlaneFile, E> {
                PlaneName::deserialize(de::value::StrDeserializer::new(text)).map(PlaneFile::Named)
            }
            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<PlaneFile, A::Error> {
                Triple::from_seq(seq).map(|triple| PlaneFile::Normal(triple.0))
            }
        }
        deserializer.deserialize_any(Plane)
    }
}

/// The points of a curve, counted as they are read.
#[derive(Debug)]
pub(super) struct Points(pub(super) Vec<PointFile>);

impl<'de> Deserialize<'de> for Points {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct List;
        impl<'de> Visitor<'de> for List {
            type Value = Points;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a list of points")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Points, A::Error> {
                let mut points = Vec::new();
                while let Some(point) = seq.next_element()? {
                    if points.len() == MAX_ROWS {
                        let text = format!("the curve has more than {MAX_ROWS} points");
                        return Err(de::Error::custom(text));
                    }
                    points.push(point);
                }
                Ok(Points(points))
            }
        }
        deserializer.deserialize_seq(List)
    }
}
