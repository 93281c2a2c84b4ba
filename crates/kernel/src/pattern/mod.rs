//! The flat pattern as a workshop needs it: paths with roles, marks and labels.

mod alike;
mod bend;
mod crease;
mod dimension;
mod edge_names;
mod fold;
mod kerf;
mod labels;
mod placer;
mod quantity;
mod room;
mod seam;
mod settle;
mod text_box;
mod trims;
mod wish;

pub use alike::{EqualPiece, alike, equal_pieces};
pub use kerf::TooNarrow;
pub use quantity::Quantity;
pub use seam::{EdgeMark, seam_mark, seam_marks};

pub(crate) use text_box::is_text_inside;

pub(crate) use labels::Labelled;
pub(crate) use room::{Room, Spot};
pub(crate) use seam::joint_mark;
pub(crate) use settle::ahead_of_tick_mm;
pub(crate) use wish::Wish;

use crate::bend::{BendLine, bend_lines};
use crate::design::{BendMarks, Bends};
use crate::edge::Edge;
use crate::flatten::Flattened;
use crate::measure::{Measures, RungMeasures};
use crate::sheet::Sheet;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point2, Point3, Vec2};
use sheetwright_geometry::predicate::{Box2, signed_area_doubled};
use sheetwright_optimum::rung::Rung;

/// The work along a path, by a machine or by hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// Cut through along the outline, when everything else is done.
    Cut,
    /// Cut through inside the outline: holes.
    Inner,
    /// Drill, or cut round: small round holes for stitches, rivets and pins.
    Drill,
    /// Score or crease: a sharp fold.
    Score,
    /// The outline and the holes of the finished piece, where trims have moved the cut off them:
    /// sewn, glued or folded along.
    Net,
    /// Mark lightly on the piece: names, ticks at the ends of bend lines.
    Engrave,
    /// To read only: bend lines, dimensions, reference squares. No machine follows these.
    Note,
    /// The edge of the sheet that parts lie on. No machine follows it.
    Sheet,
}

impl Role {
    /// Every role, in the order in which files list them.
    pub const ALL: [Self; 8] = [
        Self::Cut,
        Self::Inner,
        Self::Drill,
        Self::Score,
        Self::Net,
        Self::Engrave,
        Self::Note,
        Self::Sheet,
    ];

    /// Whether the sheet is cut through along it.
    pub fn is_cut(self) -> bool {
        matches!(self, Self::Cut | Self::Inner | Self::Drill)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cut => "cut",
            Self::Inner => "inner",
            Self::Drill => "drill",
            Self::Score => "score",
            Self::Net => "net",
            Self::Engrave => "engrave",
            Self::Note => "note",
            Self::Sheet => "sheet",
        }
    }
}

/// The meaning of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathKind {
    /// The outline as it is cut. Where the piece has no net, its points are the vertices of its
    /// loop on the sheet, in order.
    Outline,
    /// A hole as it is cut, clockwise; likewise.
    Hole,
    /// The outline or a hole of the finished piece, closed: its points are the vertices of its loop
    /// on the sheet, in order. A piece has none, or one for each of its loops, the outline first.
    Net,
    /// A round hole, as a closed polygon around it, clockwise.
    Drill {
        /// Its diameter, mm.
        diameter_mm: f64,
    },
    /// An open line that is cut into the edge.
    Notch,
    /// A line along which an edge is folded: a hem, a flange or a tab.
    TrimFold {
        /// Whether it is a mountain, folded away from the viewer; else a valley.
        mountain: bool,
    },
    /// A tick inside an edge, to match edges by.
    TrimTick,
    /// A rung, by samples of the sheet, from its lower sample to its higher one.
    Rung(Rung),
    /// A sharp crease of a mesh.
    Crease,
    /// A fold between two facets of a net, seen from the side that the mesh faces.
    Fold {
        /// Whether it is a mountain, folded away from the viewer; else a valley.
        mountain: bool,
    },
    /// A bend line, from its left end to its right one.
    Bend {
        /// Whether the sheet is bent up along it, towards the viewer; else down.
        up: bool,
    },
    /// A tick at the end of a bend line, inside the outline: a straightedge is laid from tick to
    /// tick.
    BendTick,
    /// A tick in the middle of a side of a seam, which meets that of the other side.
    SeamTick,
    /// Where the other piece of a lap ends on this one, the taper of a scarf begins or a strap
    /// ends; on a strap, where the pieces meet.
    LapEnd,
    /// A line of a dimension.
    Dimension,
    /// Where a station cuts the part: from edge to edge, or round.
    Station,
    /// An arrow along the grain: its line and then its head, in one stroke.
    Grain,
    /// An edge that lies on the fold of the cloth.
    OnFold,
    /// An arrow that says which way the part lies in space; likewise.
    Arrow,
    /// A line from a text beside the piece to where it belongs.
    Leader,
    /// The edge of a sheet that parts lie on.
    SheetEdge,
}

impl PathKind {
    /// A fold away from the viewer.
    pub const MOUNTAIN: Self = Self::Fold { mountain: true };
    /// A fold towards the viewer.
    pub const VALLEY: Self = Self::Fold { mountain: false };
}

/// A polyline of a pattern.
#[derive(Clone, Debug, PartialEq)]
pub struct PatternPath {
    /// The work along it.
    pub role: Role,
    /// Its meaning.
    pub kind: PathKind,
    /// Its points, mm, two or more.
    pub points: Vec<Point2>,
    /// Whether the last point is joined to the first.
    pub closed: bool,
}

impl PatternPath {
    /// The rung that it is, if it is one.
    pub fn rung(&self) -> Option<Rung> {
        if let PathKind::Rung(rung) = self.kind { Some(rung) } else { None }
    }
}

/// The meaning of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LabelKind {
    /// The name of the piece.
    Name,
    /// How often it is cut, under its name.
    Quantity,
    /// The name of an edge, beside its middle, with what it is joined to.
    Edge,
    /// The mark of a seam or joint, beside the middle of a side of it.
    Mark,
    /// A length with its unit, or the thing that has it.
    Length,
    /// The width or the height of the piece.
    Overall,
    /// A number or an angle of a trim.
    Trim,
    /// The angle of a fold.
    Angle,
    /// The number of a bend line, its way and its angle, or its number alone.
    Bend,
    /// What a mark on the face says.
    OnFace,
}

/// A line of text of a pattern.
#[derive(Clone, Debug, PartialEq)]
pub struct PatternLabel {
    /// Its meaning.
    pub kind: LabelKind,
    /// The work along its strokes.
    pub role: Role,
    /// The middle of its base line, mm.
    pub at: Point2,
    /// Unit direction of its base line.
    pub along: Vec2,
    /// Height of a capital letter, mm.
    pub height_mm: f64,
    /// The text.
    pub text: String,
}

/// One piece of sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// The name of its panel.
    pub name: String,
    /// Its paths: the outline first, then holes, folds, bend lines and marks.
    pub paths: Vec<PatternPath>,
    /// Its texts.
    pub labels: Vec<PatternLabel>,
    /// Width and height of the box around the outline as it is cut, mm.
    pub size: Vec2,
    /// The lower left corner of that box, mm: the origin, unless a trim moves the cut beyond it.
    pub corner: Point2,
    /// The lines that it is bent along, by their numbers from 1, whether they are drawn or not.
    pub bends: Vec<BendLine>,
    /// Where the corners of the net's outline lie in space, mm, in their order.
    pub border: Vec<Point3>,
    /// Whether it is a piece of a mesh whose facets are folded; one of a single facet has no fold.
    pub is_folded: bool,
}

impl Piece {
    /// The piece of a part before it is drawn.
    pub(crate) fn undrawn(name: &str) -> Self {
        let (paths, labels) = (Vec::new(), Vec::new());
        Self {
            name: name.to_owned(),
            paths,
            labels,
            size: Vec2::ZERO,
            corner: Point2::default(),
            bends: Vec::new(),
            border: Vec::new(),
            is_folded: false,
        }
    }

    /// The points of the outline, mm.
    pub fn outline(&self) -> &[Point2] {
        self.paths
            .iter()
            .find(|path| path.kind == PathKind::Outline)
            .map_or(&[], |path| &path.points)
    }

    /// The points of the outline and then of the holes as they are cut, mm, without drilled holes.
    pub fn loops(&self) -> impl Iterator<Item = &[Point2]> {
        let is_loop = |path: &&PatternPath| matches!(path.kind, PathKind::Outline | PathKind::Hole);
        self.paths.iter().filter(is_loop).map(|path| &path.points[..])
    }

    /// Whether trims have moved the cut off the outline or a hole of the finished piece.
    pub fn has_net(&self) -> bool {
        self.paths.iter().any(|path| path.kind == PathKind::Net)
    }

    /// The points of the outline and then of the holes of the finished piece, mm: the loops of the
    /// sheet.
    pub fn net_loops(&self) -> impl Iterator<Item = &[Point2]> {
        let has_net = self.has_net();
        let is_loop = move |path: &&PatternPath| match path.kind {
            PathKind::Net => has_net,
            PathKind::Outline | PathKind::Hole => !has_net,
            _ => false,
        };
        self.paths.iter().filter(is_loop).map(|path| &path.points[..])
    }

    /// The area of the sheet that it takes as it is cut, mm²; small round holes count.
    pub fn area_mm2(&self) -> f64 {
        let mut areas = self.loops().map(|line| 0.5 * signed_area_doubled(line).abs());
        areas.next().unwrap_or(0.0) - areas.sum::<f64>()
    }

    /// The box around everything on the piece, paths and dimensions, mm.
    pub fn extent(&self) -> Box2 {
        let points = self.paths.iter().flat_map(|path| path.points.iter().copied());
        Box2::of_points(points).unwrap_or(Box2 { min: Point2::default(), max: Point2::default() })
    }
}

/// How a pattern is marked.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PatternOptions {
    /// How its bends are.
    pub(crate) bends: Bends,
    /// Whether it is a net of facets: its folds are told apart, with their angles, and edges have
    /// marks instead of names. Default: it is not.
    pub(crate) is_net: bool,
    /// Whether it has no texts, where nobody reads it. Default: it has.
    pub(crate) is_bare: bool,
}

/// The pattern of one part with these edges. `measures` are those of its surface in space, `marks`
/// those of its seams and of the lines along which it is joined to other parts.
pub(crate) fn piece(
    name: &str,
    sheet: &Sheet,
    flat: &Flattened,
    edges: &[Edge],
    measures: &Measures,
    marks: &[EdgeMark],
    options: &PatternOptions,
) -> Piece {
    let bends = bend_lines(sheet, flat, measures, &options.bends, options.is_net);
    piece_bent(name, sheet, flat, edges, measures, marks, (bends, options))
}

/// As [`piece`], with these bend lines: a piece that a part was divided into keeps those of the
/// part.
pub(crate) fn piece_bent(
    name: &str,
    sheet: &Sheet,
    flat: &Flattened,
    edges: &[Edge],
    measures: &Measures,
    marks: &[EdgeMark],
    (bends, options): (Vec<BendLine>, &PatternOptions),
) -> Piece {
    let (mut paths, border) = loops(sheet, flat);
    let outline = paths.first().map_or(&[][..], |path| &path.points);
    let size = Box2::of_points(outline.iter().copied())
        .map_or(Vec2::ZERO, |around| around.max - Point2::default());
    let [tick_mm, height_mm] = labels::sizes(size);
    paths.extend(rungs(sheet, flat, measures, options.bends.marks));
    if options.is_net {
        paths.extend(bends.iter().map(fold::path));
    } else if !sheet.has_rungs() {
        paths.extend(crease::creases(sheet.mesh()).into_iter().map(|chain| PatternPath {
            role: Role::Score,
            kind: PathKind::Crease,
            points: chain.into_iter().map(|v| flat.points[v.get()]).collect(),
            closed: false,
        }));
    }
    if !options.is_net {
        let is_along = |path: &PatternPath, [a, b]: [Point2; 2]| {
            path.role == Role::Score && (path.points == [a, b] || path.points == [b, a])
        };
        let is_scored = |line: &BendLine| {
            let is_drawn = || paths.iter().any(|path| is_along(path, line.ends));
            line.is_fold && (!sheet.has_rungs() || is_drawn())
        };
        let drawn = bend::drawn(&bends, options.bends.marks, is_scored, tick_mm);
        paths.extend(drawn);
    }
    let (mark_paths, mut labels) = seam::drawn(marks, sheet, flat, tick_mm, height_mm);
    paths.extend(mark_paths);
    let (dimension_paths, dimension_labels) = dimension::overall(size, height_mm);
    paths.extend(dimension_paths);
    labels.extend(dimension_labels);
    let (name, corner, is_folded) = (name.to_owned(), Point2::default(), options.is_net);
    let mut piece = Piece { name, paths, labels, size, corner, bends, border, is_folded };
    let (marks, is_net) = (options.bends.marks, options.is_net);
    if !options.is_bare {
        let flat = &flat.points;
        piece.label(&Labelled { sheet, flat, edges, joined: &[], marks, is_net }, &[]);
    }
    piece
}

/// The outline, and then the holes; and where the corners of the outline lie in space.
fn loops(sheet: &Sheet, flat: &Flattened) -> (Vec<PatternPath>, Vec<Point3>) {
    let points = |line: &[VertexIndex]| -> Vec<Point2> {
        line.iter().map(|v| flat.points[v.get()]).collect()
    };
    let mut loops: Vec<&[VertexIndex]> = sheet.loops().iter().map(|line| &line[..]).collect();
    // Where the surface was found, its loops stand in the order of the samples, the outline first.
    // That of a mesh holds all others, so that it encloses most.
    if !sheet.has_rungs() {
        let area = |line: &[VertexIndex]| signed_area_doubled(&points(line)).abs();
        loops.sort_by(|a, b| area(b).total_cmp(&area(a)));
    }
    let space = sheet.mesh().positions();
    let outline = loops.first().copied().unwrap_or_default();
    let border = outline.iter().map(|v| space[v.get()]).collect();
    let path = |(n, line): (usize, &[VertexIndex])| {
        let points = points(line);
        let (role, kind) = match n {
            0 => (Role::Cut, PathKind::Outline),
            _ => (Role::Inner, PathKind::Hole),
        };
        PatternPath { role, kind, points, closed: true }
    };
    (loops.into_iter().enumerate().map(path).collect(), border)
}

/// The rungs that are drawn: where the sheet is scored, and all that are not cut if they are to be
/// shown.
fn rungs(
    sheet: &Sheet,
    flat: &Flattened,
    measures: &Measures,
    marks: BendMarks,
) -> Vec<PatternPath> {
    // A seam of a mesh may end where it begins, which no rung does.
    if !sheet.has_rungs() {
        return Vec::new();
    }
    let cut: Vec<Rung> = sheet.seams().iter().map(|seam| sheet.seam_rung(seam)).collect();
    let is_drawn = |(_, rung): &(&[VertexIndex; 2], &RungMeasures)| {
        (rung.is_scored || marks == BendMarks::Rulings) && !cut.contains(&rung.rung)
    };
    let path = |(ends, rung): (&[VertexIndex; 2], &RungMeasures)| {
        let on_sheet = Rung::new(ends[0].get(), ends[1].get());
        PatternPath {
            role: if rung.is_scored { Role::Score } else { Role::Note },
            kind: PathKind::Rung(on_sheet),
            points: on_sheet.ends().map(|s| flat.points[s.get()]).to_vec(),
            closed: false,
        }
    };
    sheet.rung_ends().iter().zip(&measures.rungs).filter(is_drawn).map(path).collect()
}
