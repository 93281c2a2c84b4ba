//! The straight folds of a sheet, and the faces between them.
//!
//! A face is a part of the sheet that hangs together without a fold; what folds two faces together
//! is one line, even where a window interrupts it. A tool makes a line if its folds lie on one
//! straight line and turn by one angle, both faces are flat as far as its tangent lines, and reach
//! beyond them and those of other lines.

use super::crease;
use super::tool::{FoldSize, FoldTool};
use crate::flatten::Flattened;
use crate::mesh::{Mesh, MeshEdge};
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::{Point2, Vec2, Vec3, angle_between, unit2};
use std::collections::BTreeMap;

/// Folds lie on one line if they leave it by less than this share of its length.
const STRAIGHT: f64 = 1e-6;
/// Angles, radians, that differ by less are one: digits of coordinates.
const SAME_ANGLE: f64 = 1e-4;

/// Why a fold is left with its faces meeting as mitred boards do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mitred {
    /// It meets others in a point, where their allowances contradict one another.
    Meets,
    /// It is not straight, ends within the sheet, or has a bend beside it.
    NotFlat,
    /// A face beside it ends before the tangent line of the bend.
    Narrow,
    /// Lengths of the part would not stay true.
    Untrue,
}

/// What folds two faces together.
pub(super) struct Line {
    /// Its faces.
    pub(super) faces: [usize; 2],
    /// Its sides of the mesh.
    pub(super) edges: Vec<usize>,
    /// Its ends, by vertices, in the direction `along`.
    pub(super) ends: [VertexIndex; 2],
    /// Where it begins, mm.
    pub(super) from: Point2,
    /// Its direction on the pattern.
    pub(super) along: Vec2,
    /// From its first face into the second, square to it.
    pub(super) across: Vec2,
    /// A triangle beside it in each face.
    pub(super) beside: [usize; 2],
    /// What it takes of the flat sheet.
    pub(super) size: FoldSize,
    /// Why no tool makes it, if none does.
    pub(super) mitred: Option<Mitred>,
}

impl Line {
    /// Whether it lies between two faces, not within one.
    fn joins_two(&self) -> bool {
        self.faces[0] != self.faces[1]
    }

    /// How long it is on the pattern, mm.
    pub(super) fn length_mm(&self, flat: &[Point2]) -> f64 {
        let [a, b] = self.ends.map(|v| flat[v.get()]);
        a.distance(b)
    }

    /// How far a point lies from it towards one of its faces, and along it from its beginning, mm.
    pub(super) fn place(&self, side: usize, point: Point2) -> [f64; 2] {
        let off = point - self.from;
        let across = if side == 0 { -self.across } else { self.across };
        [off.dot(across), off.dot(self.along)]
    }
}

/// The faces of a sheet.
pub(super) struct Faces {
    /// How many there are.
    pub(super) count: usize,
    /// The triangles of each.
    pub(super) triangles: Vec<Vec<usize>>,
    /// Their corners, each once.
    pub(super) vertices: Vec<Vec<VertexIndex>>,
    /// The lines between them.
    pub(super) lines: Vec<Line>,
    /// The lines of each face, by their numbers.
    pub(super) lines_of: Vec<Vec<usize>>,
}

impl Faces {
    /// The faces of a mesh that is laid flat and folded at some of its sides.
    pub(super) fn of(mesh: &Mesh, flat: &Flattened, is_fold: &[bool], tool: &FoldTool<'_>) -> Self {
        let (of_triangle, count) = faces(mesh, is_fold);
        let mut between: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
        for (n, edge) in mesh.edges().iter().enumerate().filter(|&(n, _)| is_fold[n]) {
            let [Some(a), Some(b)] = edge.triangles else { continue };
            let [a, b] = [a, b].map(|t| of_triangle[t.get()]);
            between.entry([a.min(b), a.max(b)]).or_default().push(n);
        }
        let line = |(faces, edges)| line(mesh, &flat.points, &of_triangle, tool, faces, edges);
        let lines: Vec<Line> = between.into_iter().filter_map(line).collect();
        let (mut triangles, mut lines_of) = (vec![Vec::new(); count], vec![Vec::new(); count]);
        let mut vertices = vec![Vec::new(); count];
        for (n, &face) in of_triangle.iter().enumerate() {
            triangles[face].push(n);
            vertices[face].extend(mesh.triangles()[n]);
        }
        for of_face in &mut vertices {
            of_face.sort_unstable();
            of_face.dedup();
        }
        for (n, line) in lines.iter().enumerate().filter(|(_, line)| line.joins_two()) {
            line.faces.iter().for_each(|&face| lines_of[face].push(n));
        }
        let mut faces = Self { count, triangles, vertices, lines, lines_of };
        faces.check(mesh, &flat.points);
        faces
    }

    /// Notes which lines no tool makes.
    fn check(&mut self, mesh: &Mesh, flat: &[Point2]) {
        for n in 0..self.lines.len() {
            let found = self.lines[n].mitred.or_else(|| {
                let sides = [0, 1].map(|side| self.fault(n, side, mesh, flat));
                sides.into_iter().flatten().next()
            });
            self.lines[n].mitred = found;
        }
    }

    /// Why no tool makes a line, by one of its faces.
    fn fault(&self, n: usize, side: usize, mesh: &Mesh, flat: &[Point2]) -> Option<Mitred> {
        let line = &self.lines[n];
        let face = line.faces[side];
        let off = |v: &VertexIndex| line.place(side, flat[v.get()])[0];
        let normal = |t: usize| mesh.area_vector(TriangleIndex::new(t));
        let beside = normal(line.beside[side]);
        for &t in &self.triangles[face] {
            let is_near = || mesh.triangles()[t].iter().any(|v| off(v) < line.size.setback_mm);
            if is_near() && turned(normal(t), beside) {
                return Some(Mitred::NotFlat);
            }
        }
        let others = self.lines_of[face].iter().filter(|&&m| m != n).map(|&m| &self.lines[m]);
        let is_beyond = |other: &Line| {
            let share = other.across.dot(line.across).abs();
            let needed_mm = line.size.setback_mm + share * other.size.setback_mm;
            let ends = other.ends.iter().filter(|v| !line.ends.contains(v));
            ends.into_iter().all(|v| off(v) >= needed_mm)
        };
        let reach_mm = self.vertices[face].iter().map(off).fold(0.0, f64::max);
        let is_wide = others.into_iter().all(is_beyond) && reach_mm >= line.size.setback_mm;
        (!is_wide).then_some(Mitred::Narrow)
    }
}

/// Whether a triangle is turned against another, by their area vectors.
fn turned(a: Vec3, b: Vec3) -> bool {
    let is_seen = a.length() > 0.0 && b.length() > 0.0;
    is_seen && angle_between(a, b) > SAME_ANGLE
}

/// The face of each triangle, and how many there are.
fn faces(mesh: &Mesh, is_fold: &[bool]) -> (Vec<usize>, usize) {
    let triangles = mesh.triangles().len();
    let mut of_triangle = vec![usize::MAX; triangles];
    let mut count = 0;
    for start in 0..triangles {
        if of_triangle[start] != usize::MAX {
            continue;
        }
        of_triangle[start] = count;
        let mut waiting = vec![start];
        while let Some(t) = waiting.pop() {
            for side in mesh.topology().edges_of(TriangleIndex::new(t)) {
                let both = mesh.edges()[side].triangles.into_iter().flatten();
                for other in both.map(TriangleIndex::get).filter(|_| !is_fold[side]) {
                    if of_triangle[other] == usize::MAX {
                        of_triangle[other] = count;
                        waiting.push(other);
                    }
                }
            }
        }
        count += 1;
    }
    (of_triangle, count)
}

/// What folds two faces together; `None` where it has no length on the pattern.
fn line(
    mesh: &Mesh,
    flat: &[Point2],
    of_triangle: &[usize],
    tool: &FoldTool<'_>,
    faces: [usize; 2],
    edges: Vec<usize>,
) -> Option<Line> {
    let edge = |n: usize| -> &MeshEdge { &mesh.edges()[n] };
    let longest = edges.iter().copied().reduce(|a, b| {
        let length = |n: usize| edge(n).ends.map(|v| flat[v.get()]);
        let [a_mm, b_mm] = [a, b].map(|n| length(n)[0].distance(length(n)[1]));
        if b_mm > a_mm { b } else { a }
    })?;
    let [a, b] = edge(longest).ends.map(|v| flat[v.get()]);
    let along = unit2(b - a)?;
    let by_way = |x: &VertexIndex, y: &VertexIndex| {
        let way = |v: &VertexIndex| (flat[v.get()] - a).dot(along);
        way(x).total_cmp(&way(y)).then(x.cmp(y))
    };
    let vertices = || edges.iter().flat_map(|&n| edge(n).ends);
    let ends = [vertices().min_by(by_way)?, vertices().max_by(by_way)?];
    let from = flat[ends[0].get()];
    let length_mm = from.distance(flat[ends[1].get()]);
    let both = edge(longest).triangles.map(|t| t.map(TriangleIndex::get));
    let [Some(s), Some(t)] = both else { return None };
    let beside = if of_triangle[s] == faces[0] { [s, t] } else { [t, s] };
    let middle = |t: usize| {
        let corners = mesh.triangles()[t].map(|v| flat[v.get()] - a);
        (corners[0] + corners[1] + corners[2]).perp_dot(along)
    };
    let across = if middle(beside[1]) > 0.0 { -along.perp() } else { along.perp() };
    let turn = crease(mesh, edge(longest));
    let is_straight =
        vertices().all(|v| (flat[v.get()] - from).perp_dot(along).abs() <= STRAIGHT * length_mm);
    let is_one = edges.iter().all(|&n| (crease(mesh, edge(n)) - turn).abs() <= SAME_ANGLE);
    let ends_inside = faces[0] == faces[1];
    let is_made = is_straight && is_one && !ends_inside;
    let mitred = (!is_made).then_some(Mitred::NotFlat);
    let size = tool.size(turn);
    Some(Line { faces, edges, ends, from, along, across, beside, size, mitred })
}
