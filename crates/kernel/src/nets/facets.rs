//! The facets of a mesh, and the hinges at which two of them meet.

use super::planes::face_of_triangles;
use crate::flatten::{LaidFace, laid_face};
use crate::mesh::{Cut, Mesh, MeshEdge, Rounding};
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::{Point2, Point3, Vec3, unit};
use std::collections::{BTreeMap, VecDeque};
use std::ops::Range;

/// A hinge turns by less than this from one of its sides to the next, radians: it is straight but
/// for rounding.
const STRAIGHT: f64 = 0.01;

/// A flat face.
#[derive(Clone, Debug)]
pub(super) struct Facet {
    /// Its vertices, in increasing order.
    pub(super) vertices: Vec<VertexIndex>,
    /// Where they lie in its plane, mm, as seen from the side that it faces.
    pub(super) points: Vec<Point2>,
    /// The sides of its border, by the places of their ends in that list; it lies to their left.
    pub(super) border: Vec<[usize; 2]>,
    /// A point inside, mm.
    pub(super) inside: Point2,
    /// About half of its width, mm: twice its area over the length of its border.
    pub(super) width_mm: f64,
    /// Its unit normal.
    pub(super) normal: Vec3,
    /// Its hinges.
    pub(super) hinges: Vec<usize>,
}

/// A straight line along which two facets meet.
#[derive(Clone, Debug)]
pub(super) struct Hinge {
    /// The vertices along it.
    pub(super) line: Vec<VertexIndex>,
    /// The facet to its left, and that to its right.
    pub(super) facets: [usize; 2],
    /// Where its vertices stand in the lists of both.
    pub(super) places: [Vec<usize>; 2],
    /// Its length, mm.
    pub(super) length_mm: f64,
    /// The angle between both, radians: positive over a mountain.
    pub(super) crease: f64,
    /// Whether it is cut in any case.
    pub(super) is_seam: bool,
}

/// The facets of a mesh.
#[derive(Clone, Debug)]
pub(super) struct Facets {
    pub(super) list: Vec<Facet>,
    pub(super) hinges: Vec<Hinge>,
    /// The facet of each triangle of the mesh.
    pub(super) of_triangle: Vec<usize>,
    /// The number of the first vertex of each facet, counted through all facets.
    first_numbers: Vec<u32>,
    /// Where the vertices of the mesh lie, mm.
    pub(super) positions: Vec<Point3>,
    /// The size of the mesh, mm.
    pub(super) size_mm: f64,
    /// Rounding keeps points that are meant to be one as near as this, mm.
    pub(super) near_mm: f64,
    /// How far sides of a piece must be apart, mm, if that is more than rounding of computing.
    pub(super) apart_mm: f64,
}

impl Facets {
    /// The facets of a mesh that is cut along some sides, which divide flat faces, too, where they
    /// part them; a slit within a face is none.
    pub(super) fn of(mesh: &Mesh, seams: &Cut) -> Self {
        let positions = mesh.positions().to_vec();
        let size_mm = size_of(positions.iter().copied());
        let rounding = Rounding::of(&positions, size_mm);
        let of_triangle = face_of_triangles(mesh, seams, &rounding);
        let count = of_triangle.iter().max().map_or(0, |most| most + 1);
        let mut triangles = vec![Vec::new(); count];
        for (n, &facet) in of_triangle.iter().enumerate() {
            triangles[facet].push(n);
        }
        let facet = |list: Vec<usize>| facet(mesh, list, &of_triangle);
        let list: Vec<Facet> = triangles.into_iter().map(facet).collect();
        let mut next = 0;
        let first = list.iter().map(|facet| {
            next += facet.points.len() as u32;
            next - facet.points.len() as u32
        });
        let first_numbers = first.collect();
        let hinges = Vec::new();
        let near_mm = rounding.between_mm();
        let mut facets = Self {
            list,
            hinges,
            first_numbers,
            positions,
            size_mm,
            near_mm,
            apart_mm: 0.0,
            of_triangle,
        };
        for line in lines(mesh, &facets.of_triangle, seams) {
            facets.add_hinge(mesh, line, seams);
        }
        facets
    }

    /// The numbers that the vertices of a facet have while it is by itself.
    pub(super) fn own_numbers(&self, facet: usize) -> Range<u32> {
        let first = self.first_numbers[facet];
        first..first + self.list[facet].points.len() as u32
    }

    fn add_hinge(&mut self, mesh: &Mesh, line: Vec<VertexIndex>, seams: &Cut) {
        let Some(n) = mesh.topology().edge_between(line[0], line[1]) else { return };
        let edge = &mesh.edges()[n];
        let [Some(first), Some(second)] = edge.triangles else { return };
        // The first triangle of a side lies to the left of the way from its lower end up.
        let sides = if edge.ends[0] == line[0] { [first, second] } else { [second, first] };
        let of = sides.map(|t| self.of_triangle[t.get()]);
        let place = |facet: usize| {
            let at = |v: &VertexIndex| self.list[facet].vertices.binary_search(v).unwrap_or(0);
            line.iter().map(at).collect::<Vec<usize>>()
        };
        let places = of.map(place);
        let [from, to] = [line[0], line[line.len() - 1]].map(|v| mesh.position(v));
        let crease = crate::surface::signed_crease(of.map(|f| self.list[f].normal), to - from);
        let number = self.hinges.len();
        of.iter().for_each(|&f| self.list[f].hinges.push(number));
        let (length_mm, is_seam) = (from.distance(to), seams.contains(&n));
        self.hinges.push(Hinge { places, facets: of, length_mm, crease, is_seam, line });
    }
}

fn facet(mesh: &Mesh, triangles: Vec<usize>, of_triangle: &[usize]) -> Facet {
    let corners = |n: usize| mesh.triangles()[n];
    let LaidFace { vertices, points, area } = laid_face(mesh, &triangles, of_triangle);
    let normal = unit(area).unwrap_or(Vec3::Z);
    let place = |v: VertexIndex| vertices.binary_search(&v).unwrap_or(0);
    let is_own =
        |t: Option<TriangleIndex>, facet: usize| t.is_some_and(|t| of_triangle[t.get()] == facet);
    let mut border = Vec::new();
    for &n in &triangles {
        let t = corners(n);
        for (k, &side) in mesh.topology().edges_of(TriangleIndex::new(n)).iter().enumerate() {
            let facet = of_triangle[n];
            if !mesh.edges()[side].triangles.iter().all(|&t| is_own(t, facet)) {
                border.push([place(t[k]), place(t[(k + 1) % 3])]);
            }
        }
    }
    let [a, b, c] = corners(triangles[0]).map(|v| points[place(v)]);
    let inside = a + ((b - a) + (c - a)) / 3.0;
    let around: f64 = border.iter().map(|side| points[side[0]].distance(points[side[1]])).sum();
    let width_mm = 2.0 * area.length() / around;
    Facet { vertices, points, border, inside, width_mm, normal, hinges: Vec::new() }
}

/// The lines along which two facets meet, each as long as it goes straight on between the same two
/// and is a seam all along or nowhere. Seams within a facet are no such lines.
fn lines(mesh: &Mesh, of_triangle: &[usize], seams: &Cut) -> Vec<Vec<VertexIndex>> {
    let facets = |edge: &MeshEdge| edge.triangles.map(|t| t.map(|t| of_triangle[t.get()]));
    let mut borders = vec![0usize; mesh.positions().len()];
    let mut at: BTreeMap<VertexIndex, Vec<usize>> = BTreeMap::new();
    let mut meeting = Vec::new();
    for (n, edge) in mesh.edges().iter().enumerate() {
        let [a, b] = facets(edge);
        if a != b {
            edge.ends.iter().for_each(|end| borders[end.get()] += 1);
            if a.is_some() && b.is_some() {
                meeting.push(n);
                edge.ends.iter().for_each(|&end| at.entry(end).or_default().push(n));
            }
        }
    }
    // The side that goes straight on at a vertex, where just two facets meet.
    let next = |n: usize, via: VertexIndex| -> Option<usize> {
        let sides = at.get(&via).filter(|_| borders[via.get()] == 2)?;
        let [one, other] = sides[..] else { return None };
        let next = if one == n { other } else { one };
        let mut pairs = [n, next].map(|n| facets(&mesh.edges()[n]));
        pairs.iter_mut().for_each(|pair| pair.sort_unstable());
        let way = |n: usize, from: bool| {
            let [a, b] = mesh.edges()[n].ends;
            let far = if a == via { b } else { a };
            let way = mesh.position(far) - mesh.position(via);
            if from { -way } else { way }
        };
        let turn = sheetwright_geometry::math::angle_between(way(n, true), way(next, false));
        let is_alike = pairs[0] == pairs[1] && seams.contains(&n) == seams.contains(&next);
        (is_alike && turn < STRAIGHT).then_some(next)
    };
    let mut used = vec![false; mesh.edges().len()];
    let mut lines = Vec::new();
    for n in meeting {
        if used[n] {
            continue;
        }
        used[n] = true;
        let [low, high] = mesh.edges()[n].ends;
        let mut line = VecDeque::from([low, high]);
        for forwards in [true, false] {
            let (mut side, mut end) = (n, if forwards { high } else { low });
            while let Some(more) = next(side, end).filter(|&more| !used[more]) {
                used[more] = true;
                let [a, b] = mesh.edges()[more].ends;
                (side, end) = (more, if a == end { b } else { a });
                if forwards { line.push_back(end) } else { line.push_front(end) }
            }
        }
        lines.push(line.into());
    }
    lines
}
