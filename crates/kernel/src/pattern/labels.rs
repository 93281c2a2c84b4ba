//! The texts of a piece, placed together: its name, the names of edges, bend lines and folds, and
//! the texts of marks.

use super::placer::Placer;
use super::settle::{is_settled, settle};
use super::wish::{Instead, Wish, WishAt};
use super::{LabelKind, PathKind, PatternLabel, Piece, Role, Room, bend, edge_names, fold};
use crate::design::BendMarks;
use crate::edge::Edge;
use crate::mesh::{Mesh, MeshEdge};
use crate::sheet::Sheet;
use sheetwright_geometry::math::{Point2, Vec2};
use sheetwright_geometry::predicate::Box2;

/// Ticks are as long as this share of the shorter side of the piece, within 2 to 10 mm.
const TICK_SHARE: f64 = 0.05;
/// Labels are as high as this share of the shorter side of the piece, within 2 to 25 mm.
const LABEL_SHARE: f64 = 0.08;
/// Places inside that are looked at for texts, beside those of a grid.
const PLACES: usize = 60;
/// Texts beside lines are as high as the name times this, before both get standard heights.
const BESIDE_NAME: f64 = 0.4;
/// Letters are no lower than 2.5 mm where there is room for them.
const READABLE_MM: f64 = 2.5;

/// The lengths of ticks and the height of letters of a piece of this size, mm.
pub(super) fn sizes(size: Vec2) -> [f64; 2] {
    let shorter = size.x.min(size.y);
    [(TICK_SHARE * shorter).clamp(2.0, 10.0), (LABEL_SHARE * shorter).clamp(2.0, 25.0)]
}

/// The part that the texts of a piece are about.
pub(crate) struct Labelled<'a> {
    /// Its sheet.
    pub(crate) sheet: &'a Sheet,
    /// Where the vertices of that lie on the pattern.
    pub(crate) flat: &'a [Point2],
    /// Its edges.
    pub(crate) edges: &'a [Edge],
    /// What each edge is joined to, in words, if its name says so.
    pub(crate) joined: &'a [Option<String>],
    /// How bends are marked.
    pub(crate) marks: BendMarks,
    /// Whether it is a net of facets.
    pub(crate) is_net: bool,
}

/// Whether a text is placed here.
fn is_placed(kind: LabelKind) -> bool {
    use LabelKind::{Angle, Bend, Edge, Name, OnFace};
    matches!(kind, Name | Edge | Angle | Bend | OnFace)
}

impl Piece {
    /// Places the texts of a piece anew, those of its marks included: they keep clear of its lines
    /// and of the texts that have their places. Its name is what its label says, if it has one.
    pub(crate) fn label(&mut self, part: &Labelled<'_>, of_marks: &[Wish]) {
        let own = self.labels.iter().find(|label| label.kind == LabelKind::Name);
        let name = own.map_or(&self.name, |label| &label.text).clone();
        self.labels.retain(|label| !is_placed(label.kind));
        self.paths.retain(|path| path.kind != PathKind::Leader);
        let net: Vec<Vec<Point2>> = self.net_loops().map(<[Point2]>::to_vec).collect();
        let net: Vec<&[Point2]> = net.iter().map(|line| &line[..]).collect();
        let around = Box2::of_points(net.iter().copied().flatten().copied());
        let size = around.map_or(Vec2::ZERO, |around| around.max - around.min);
        let [tick_mm, height_mm] = sizes(size);
        let beside_mm = (BESIDE_NAME * height_mm).max(READABLE_MM);
        let places = places(part.sheet.mesh(), part.flat);
        let is_fixed = |label: &&PatternLabel| !is_settled(label.kind);
        let fixed: Vec<PatternLabel> = self.labels.iter().filter(is_fixed).cloned().collect();
        let room = Room::new(net.iter().copied());
        let mut placer = Placer::new(room, &self.paths, &fixed, places);
        settle(&mut self.labels, &self.paths, &net, &mut placer);
        placer.place(&named(name), height_mm);
        for wish in of_marks {
            placer.place(wish, beside_mm);
        }
        if part.is_net {
            let angles = self.bends.iter().filter_map(fold::wish);
            angles.for_each(|wish| placer.place(&wish, beside_mm));
        } else {
            let names = edge_names::wishes(part.edges, part.joined, part.flat, tick_mm);
            names.iter().for_each(|wish| placer.place(wish, beside_mm));
            let bends = bend::wishes(&self.bends, part.marks);
            bends.iter().for_each(|wish| placer.place(wish, beside_mm));
        }
        let Placer { labels, leaders, .. } = placer;
        self.paths.extend(leaders);
        self.labels.splice(0..0, labels);
    }
}

fn named(name: String) -> Wish {
    Wish {
        kind: LabelKind::Name,
        role: Role::Engrave,
        texts: vec![name],
        height_mm: None,
        at: vec![WishAt::Anywhere],
        instead: Instead::Leader,
    }
}

/// Some places far from the outline: the middles of rungs and of triangles.
fn places(mesh: &Mesh, flat: &[Point2]) -> Vec<Point2> {
    let inner = mesh.edges().iter().filter(|edge: &&MeshEdge| !edge.is_border());
    let middle = |edge: &MeshEdge| {
        let [a, b] = edge.ends.map(|v| flat[v.get()]);
        a.lerp(b, 0.5)
    };
    let triangles = mesh.triangles().iter().map(|triangle| {
        let [a, b, c] = triangle.map(|v| flat[v.get()]);
        a + ((b - a) + (c - a)) / 3.0
    });
    let all: Vec<Point2> = inner.map(middle).chain(triangles).collect();
    let step = all.len().div_ceil(PLACES).max(1);
    all.into_iter().step_by(step).collect()
}
