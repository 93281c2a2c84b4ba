//! A sheet whose sharp folds are made by a tool with a radius: its faces move together or apart, so
//! that between the tangent lines of each fold there is as much flat sheet as the bend takes.
//!
//! Laid flat as it was drawn, a sheet has two setbacks between the tangent lines of a fold, where a
//! bend takes its allowance. So the second face of a fold moves against the first by the difference
//! δ across it, as a whole and without turning; its vertices on the fold move half as far, and what
//! lies between the fold and a tangent line in proportion, along the sides of the face, so that
//! these stay straight. In space faces do just that within their planes: they stay flat and turned
//! by their angles, so the sheet in space is that of faces shortened (or lengthened) by half of δ
//! at each fold, and the flat sheet still folds up to it without an error. Outside the bends all
//! places on a face are those that were drawn, but for what comes next.
//!
//! Where two folds meet in a point of the border, as at the corner of a tray, the point lies where
//! the middles of their bends cross. The sides of the walls run straight to it from their next
//! vertex, so at its foot a wall is narrower by up to half of δ, where a relief is cut in any
//! case. Where both faces of one fold have sides that slant differently, its end lies half-way
//! between. Where more than two do, or round a point inside the sheet, no place fits all; those
//! folds stay mitred, and are told of.

use super::fold_lines::{Faces, Line, Mitred};
use super::tool::FoldTool;
use crate::flatten::{Flattened, laid_at};
use crate::mesh::Mesh;
use crate::sheet::Sheet;
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::{Point2, Point3, Vec2, Vec3};
use sheetwright_geometry::tolerance::Tolerance;
use std::collections::{BTreeMap, VecDeque};

/// Lines that turn from one another by less than this, as the sine, have no point in common.
const CROSSING: f64 = 0.1;
/// A side of a face that leaves its fold more flatly than this, across over along, keeps its place
/// instead of its direction.
const FLATTEST: f64 = 1.0 / 3.0;

/// A sheet with its folds made by a tool.
pub(crate) struct Rounded {
    /// In space.
    pub(crate) sheet: Sheet,
    /// Laid flat.
    pub(crate) flat: Flattened,
    /// How many folds it has.
    pub(crate) folds: usize,
    /// How many of them are left mitred, by the reason.
    pub(crate) mitred: BTreeMap<Mitred, usize>,
}

impl Rounded {
    /// A sheet whose folds are made by no tool.
    pub(crate) fn none(sheet: Sheet, flat: Flattened) -> Self {
        Self { sheet, flat, folds: 0, mitred: BTreeMap::new() }
    }
}

/// A sheet that is laid flat and folded at some sides of its mesh, with these folds made by a tool.
pub(crate) fn rounded(
    sheet: Sheet,
    flat: Flattened,
    is_fold: &[bool],
    tool: &FoldTool<'_>,
) -> Rounded {
    let mut faces = Faces::of(sheet.mesh(), &flat, is_fold, tool);
    let slopes: Vec<[[f64; 2]; 2]> =
        faces.lines.iter().map(|line| slopes(sheet.mesh(), &flat.points, &faces, line)).collect();
    let mut moved = None;
    // Each round leaves a line mitred, or is the last.
    for _ in 0..=faces.lines.len() {
        match Moves::of(sheet.mesh(), &flat.points, &faces, &slopes) {
            Ok(moves) => {
                moved = moves.made(sheet.mesh(), &flat.points, &faces);
                break;
            }
            Err(unfit) => unfit.into_iter().for_each(|n| {
                faces.lines[n].mitred.get_or_insert(Mitred::Meets);
            }),
        }
    }
    let (sheet, flat) = match moved {
        Some((points, positions)) => {
            let (flat, _) = laid_at(sheet.mesh().topology(), &points);
            let made = faces.lines.iter().filter(|line| line.mitred.is_none());
            let mut sides: Vec<usize> = made.flat_map(|line| line.edges.iter().copied()).collect();
            sides.sort_unstable();
            let sheet = sheet.moved_to(positions).laid_at(&flat.points);
            (sheet.with_tool_folds(tool.radius_mm(), sides), flat)
        }
        None => {
            let made = faces.lines.iter_mut().filter(|line| line.mitred.is_none());
            made.for_each(|line| line.mitred = Some(Mitred::Untrue));
            (sheet, flat)
        }
    };
    let mut mitred = BTreeMap::new();
    for why in faces.lines.iter().filter_map(|line| line.mitred) {
        *mitred.entry(why).or_insert(0) += 1;
    }
    Rounded { sheet, flat, folds: faces.lines.len(), mitred }
}

/// By how much a line moves its faces apart, mm; negative where it moves them together.
fn apart_mm(line: &Line) -> f64 {
    let size = line.size;
    if line.mitred.is_some() { 0.0 } else { size.allowance_mm - 2.0 * size.setback_mm }
}

/// By how much what lies on a sheet moves on its pattern, mm.
struct Moves<'a> {
    /// Each face, beyond the tangent lines.
    faces: Vec<Vec2>,
    /// The lines by which faces are reached from the first one, and whether from their first face.
    tree: Vec<(usize, bool)>,
    /// Vertices on lines, with one of the lines.
    on_lines: BTreeMap<VertexIndex, (usize, Vec2)>,
    /// By how much the side of each face at each end of a line leaves the square to it: along over
    /// across.
    slopes: &'a [[[f64; 2]; 2]],
}

impl<'a> Moves<'a> {
    /// The moves that the lines ask for.
    ///
    /// # Errors
    /// Lines that no moves fit.
    fn of(
        mesh: &Mesh,
        flat: &[Point2],
        faces: &Faces,
        slopes: &'a [[[f64; 2]; 2]],
    ) -> Result<Self, Vec<usize>> {
        let within_mm = Tolerance::ROUNDING.length_mm(size_of(mesh.positions().iter().copied()));
        let FaceMoves { of_faces, tree } = face_moves(faces, within_mm)?;
        let mut moves = Self { faces: of_faces, tree, on_lines: BTreeMap::new(), slopes };
        let mut lines_at: BTreeMap<VertexIndex, Vec<usize>> = BTreeMap::new();
        for (n, line) in faces.lines.iter().enumerate() {
            for end in line.edges.iter().flat_map(|&edge| mesh.edges()[edge].ends) {
                let at = lines_at.entry(end).or_default();
                if !at.contains(&n) {
                    at.push(n);
                }
            }
        }
        for (v, lines) in lines_at {
            let by = moves.of_vertex(&faces.lines, &lines, flat[v.get()], flat);
            let is_off = |&&n: &&usize| {
                let line = &faces.lines[n];
                (by.dot(line.across) - moves.across(line)).abs() > within_mm
            };
            if lines.iter().any(|n| is_off(&n)) {
                return Err(lines);
            }
            moves.on_lines.insert(v, (lines[0], by));
        }
        Ok(moves)
    }

    /// How far a line moves across itself: half as far as both of its faces.
    fn across(&self, line: &Line) -> f64 {
        let both = line.faces.map(|face| self.faces[face].dot(line.across));
        0.5 * (both[0] + both[1])
    }

    /// How far a vertex moves that lies on these lines.
    fn of_vertex(&self, all: &[Line], lines: &[usize], at: Point2, flat: &[Point2]) -> Vec2 {
        let first = &all[lines[0]];
        let crosses = |line: &&Line| line.across.perp_dot(first.across).abs() > CROSSING;
        if let Some(second) = lines[1..].iter().map(|&n| &all[n]).find(crosses) {
            let [a, b] = [first.across, second.across];
            let moved = a.perp() * self.across(second) - b.perp() * self.across(first);
            return moved / a.perp_dot(b);
        }
        // Along the sides of its faces; where both lead elsewhere, half-way between.
        let share = first.place(0, at)[1] / first.length_mm(flat);
        let [a, b] = self.slopes[lines[0]].map(|ends| ends[0] + (ends[1] - ends[0]) * share);
        let slides_mm = -0.25 * apart_mm(first) * (a + b);
        let along_mm = self.faces[first.faces[0]].dot(first.along) + slides_mm;
        first.across * self.across(first) + first.along * along_mm
    }

    /// How far a point of a face moves beside a line, beyond the move of the face.
    fn beside(&self, n: usize, side: usize, line: &Line, at: Point2, length_mm: f64) -> Vec2 {
        let [off_mm, along_mm] = line.place(side, at);
        let setback_mm = line.size.setback_mm;
        if line.mitred.is_some() || !(0.0..setback_mm).contains(&off_mm) {
            return Vec2::ZERO;
        }
        let [start, end] = self.slopes[n][side];
        let share = (along_mm - start * off_mm) / (length_mm + (end - start) * off_mm);
        let rounding = Tolerance::ROUNDING.share();
        if !(-rounding..=1.0 + rounding).contains(&share) {
            return Vec2::ZERO;
        }
        let inwards = if side == 0 { -line.across } else { line.across };
        let way = inwards + line.along * (start + (end - start) * share);
        way * (-0.5 * apart_mm(line) * (1.0 - off_mm / setback_mm))
    }

    /// Where all vertices lie on the pattern and in space, mm; `None` where lengths would not stay
    /// as true as they were, or a triangle would be turned over.
    fn made(
        &self,
        mesh: &Mesh,
        flat: &[Point2],
        faces: &Faces,
    ) -> Option<(Vec<Point2>, Vec<Point3>)> {
        let frame = |line: &Line, side: usize, by: Vec2| {
            let corners = mesh.triangles()[line.beside[side]];
            let [a, b, c] = corners.map(|v| flat[v.get()]);
            let [from, to, tip] = corners.map(|v| mesh.position(v));
            let (ab, ac) = (b - a, c - a);
            let whole = ab.perp_dot(ac);
            (to - from) * (by.perp_dot(ac) / whole) + (tip - from) * (ab.perp_dot(by) / whole)
        };
        let mut in_space = vec![Vec3::ZERO; faces.count];
        for &(n, forth) in &self.tree {
            let line = &faces.lines[n];
            let half = line.across * (0.5 * apart_mm(line));
            let by = frame(line, 0, half) + frame(line, 1, half);
            let [a, b] = line.faces;
            let (from, to, by) = if forth { (a, b, by) } else { (b, a, -by) };
            in_space[to] = in_space[from] + by;
        }
        let (mut points, mut positions) = (flat.to_vec(), mesh.positions().to_vec());
        for (face, vertices) in faces.vertices.iter().enumerate() {
            for &v in vertices.iter().filter(|v| !self.on_lines.contains_key(v)) {
                let at = flat[v.get()];
                points[v.get()] = at + self.faces[face];
                positions[v.get()] = positions[v.get()] + in_space[face];
                for &n in &faces.lines_of[face] {
                    let line = &faces.lines[n];
                    let side = usize::from(line.faces[0] != face);
                    let by = self.beside(n, side, line, at, line.length_mm(flat));
                    points[v.get()] = points[v.get()] + by;
                    positions[v.get()] = positions[v.get()] + frame(line, side, by);
                }
            }
        }
        for (&v, &(n, by)) in &self.on_lines {
            let line = &faces.lines[n];
            let face = line.faces[0];
            let beside = frame(line, 0, by - self.faces[face]);
            points[v.get()] = flat[v.get()] + by;
            positions[v.get()] = positions[v.get()] + in_space[face] + beside;
        }
        is_true(mesh, [flat, &points], &positions).then_some((points, positions))
    }
}

/// Whether lengths are as true as they were before, and no triangle is turned over.
fn is_true(mesh: &Mesh, [before, after]: [&[Point2]; 2], positions: &[Point3]) -> bool {
    let within_mm = Tolerance::ROUNDING.length_mm(size_of(positions.iter().copied()));
    let error_mm = |flat: &[Point2], space: &[Point3], [a, b]: [VertexIndex; 2]| {
        (flat[a.get()].distance(flat[b.get()]) - space[a.get()].distance(space[b.get()])).abs()
    };
    let kept = |ends: [VertexIndex; 2]| {
        let were_mm = error_mm(before, mesh.positions(), ends);
        error_mm(after, positions, ends) <= 2.0 * were_mm + within_mm
    };
    let area = |corners: &[VertexIndex; 3], flat: &[Point2]| {
        let [a, b, c] = corners.map(|v| flat[v.get()]);
        (b - a).perp_dot(c - a)
    };
    let is_turned = |t: &[VertexIndex; 3]| area(t, before) > 0.0 && area(t, after) <= 0.0;
    mesh.edges().iter().all(|edge| kept(edge.ends)) && !mesh.triangles().iter().any(is_turned)
}

/// How faces move.
struct FaceMoves {
    /// By how much each, the first not at all.
    of_faces: Vec<Vec2>,
    /// The lines by which the others are reached, and whether from their first side.
    tree: Vec<(usize, bool)>,
}

/// How faces move.
///
/// # Errors
/// The lines round which faces would move by different ways to different places.
fn face_moves(faces: &Faces, within_mm: f64) -> Result<FaceMoves, Vec<usize>> {
    let mut moves: Vec<Option<Vec2>> = vec![None; faces.count];
    let mut reached_by: Vec<Option<(usize, usize)>> = vec![None; faces.count];
    let (mut tree, mut waiting) = (Vec::new(), VecDeque::from([0]));
    moves[0] = Some(Vec2::ZERO);
    while let Some(face) = waiting.pop_front() {
        let Some(here) = moves[face] else { continue };
        for &n in &faces.lines_of[face] {
            let line = &faces.lines[n];
            let [a, b] = line.faces;
            let (other, apart_mm) =
                if a == face { (b, apart_mm(line)) } else { (a, -apart_mm(line)) };
            let there = here + line.across * apart_mm;
            match moves[other] {
                None => {
                    moves[other] = Some(there);
                    reached_by[other] = Some((n, face));
                    tree.push((n, a == face));
                    waiting.push_back(other);
                }
                Some(moved) if (moved - there).length() > within_mm => {
                    let way = |mut face: usize| {
                        let mut way = vec![n];
                        while let Some((line, before)) = reached_by[face] {
                            way.push(line);
                            face = before;
                        }
                        way
                    };
                    return Err([way(face), way(other)].concat());
                }
                Some(_) => {}
            }
        }
    }
    let of_faces = moves.into_iter().map(Option::unwrap_or_default).collect();
    Ok(FaceMoves { of_faces, tree })
}

/// By how much the sides of both faces leave a line at its ends, along it over across; 0 where the
/// face goes on beyond the end, or has a side that nearly lies along the line.
fn slopes(mesh: &Mesh, flat: &[Point2], faces: &Faces, line: &Line) -> [[f64; 2]; 2] {
    [0, 1].map(|side| {
        line.ends.map(|end| {
            let triangles = faces.triangles[line.faces[side]].iter();
            let sides = triangles.flat_map(|&t| mesh.topology().edges_of(TriangleIndex::new(t)));
            let border = sides.map(|n| &mesh.edges()[n]).filter(|edge| edge.is_border());
            let mut far = border.filter_map(|edge| match edge.ends {
                [a, b] if a == end => Some(b),
                [a, b] if b == end => Some(a),
                _ => None,
            });
            let [from, to] = [Some(end), far.next()]
                .map(|v| v.map_or([0.0; 2], |v| line.place(side, flat[v.get()])));
            let [across, along] = [to[0] - from[0], to[1] - from[1]];
            if across > FLATTEST * along.abs() { along / across } else { 0.0 }
        })
    })
}
