//! The net of quadratic triangles that an elastic sheet is computed on: a Delaunay triangulation of
//! the flat outline, refined inside until it is fine enough \[Ruppert1995\], whose border sides are
//! as curved as the outline.
//!
//! Of a needle there is no net: sides that fit its area are far longer than it is wide, and the
//! more of them its outline takes, the longer the needle is.

use super::element::{Nodes, values};
use super::hold::{Edges, Stretch};
use super::outline::{Divided, OnBorder, Outline, divided};
use super::surface::{Reading, Surface};
use crate::flatten::Flattened;
use crate::mesh::Component;
use crate::sheet::Sheet;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point2, Point3, Vec3, unit};
use spade::handles::FixedVertexHandle;
use spade::{AngleLimit, ConstrainedDelaunayTriangulation, RefinementParameters, Triangulation};
use std::collections::{BTreeMap, BTreeSet};

/// Circles round triangles have a radius of so many times their shortest side at the most: angles
/// of 25° and more, but at narrow corners of the outline.
const RADIUS_BY_SIDE: f64 = 1.18;
/// A net has so many times the triangles that are asked for at the most.
const MOST_TIMES: usize = 8;
/// The outline is as long as so many sides for each triangle that is asked for at the most. The
/// outline of a strip 100 times as long as wide takes less than one for each, of one 10,000 times
/// as long seven.
const MOST_SIDES: f64 = 8.0;

/// A component narrower than this share of a side of the net is a needle: corners that are nearer
/// to one another are none.
const NEEDLE: f64 = 0.6;
/// Needles are left out up to this share of the area.
const MOST_OF_NEEDLES: f64 = 0.25;

/// A net over a flat sheet.
pub(super) struct Net {
    /// Where its nodes lie flat, mm.
    pub(super) flat: Vec<Point2>,
    /// Where its nodes lie on the surface that the sheet was unrolled from, mm.
    pub(super) space: Vec<Point3>,
    /// Where that surface faces at each inner node; zero on the border.
    pub(super) facing: Vec<Vec3>,
    /// Whether each node lies on the border.
    pub(super) on_border: Vec<bool>,
    /// The edges of the outline, component by component.
    pub(super) stretches: Vec<Vec<Stretch>>,
    /// Its triangles.
    pub(super) elements: Vec<Nodes>,
    /// Its border: loops of corners and middles in turn, the net to the left.
    pub(super) border: Vec<Vec<usize>>,
    /// The triangle of the sheet that the middle of each triangle lies in.
    pub(super) over: Vec<usize>,
}

/// A side that two triangles share.
pub(super) struct InnerSide {
    /// The numbers of the triangles.
    pub(super) elements: [usize; 2],
    /// The corners at its ends, as they come in the first triangle.
    pub(super) ends: [usize; 2],
}

impl Net {
    /// A net of about so many triangles in all, each component of the sheet by itself, perhaps
    /// without those that are needles; `None` where an outline can't be divided so, as where the
    /// pattern overlaps itself or is a needle.
    pub(super) fn new(
        sheet: &Sheet,
        flat: &Flattened,
        held: &Edges,
        triangles: usize,
        outline: Outline,
        (reading, leaves_needles): (Reading, bool),
    ) -> Option<Self> {
        let area = crate::measure::area_flat(sheet, flat);
        // An equilateral triangle with a side s has an area of √3/4 s².
        let side_mm = (4.0 * area / (3.0f64.sqrt() * triangles as f64)).sqrt();
        if !side_mm.is_finite() || side_mm <= 0.0 {
            return None;
        }
        if outline_mm(sheet, flat) > MOST_SIDES * triangles as f64 * side_mm {
            return None;
        }
        let mut net = Self {
            flat: Vec::new(),
            space: Vec::new(),
            facing: Vec::new(),
            on_border: Vec::new(),
            stretches: Vec::new(),
            elements: Vec::new(),
            border: Vec::new(),
            over: Vec::new(),
        };
        let is_needle = needles(sheet, flat, side_mm);
        let components = sheet.mesh().components().iter().zip(is_needle);
        for (component, _) in components.filter(|(_, is_needle)| !(leaves_needles && *is_needle)) {
            let lines = component.loops.iter().map(|&n| &sheet.loops()[n]);
            let loops: Vec<Divided> =
                lines.map(|line| divided(sheet, flat, line, side_mm, outline, held)).collect();
            let first = net.border.len();
            net.fill(&loops, area / triangles as f64, triangles)?;
            let borders = net.border[first..].iter().zip(&loops);
            let stretches = borders.flat_map(|(line, of)| stretches_of(line, of)).collect();
            net.stretches.push(stretches);
        }
        net.lay_on(&Surface::new(sheet, flat, reading));
        Some(net)
    }

    /// Adds the triangles inside loops of corners and middles in turn.
    fn fill(&mut self, loops: &[Divided], area: f64, triangles: usize) -> Option<()> {
        let mut delaunay = ConstrainedDelaunayTriangulation::<spade::Point2<f64>>::new();
        let mut middles: BTreeMap<[usize; 2], OnBorder> = BTreeMap::new();
        let mut corners: BTreeMap<usize, OnBorder> = BTreeMap::new();
        let mut around: Vec<Vec<FixedVertexHandle>> = Vec::new();
        for Divided { points: of_loop, .. } in loops {
            let mut handles: Vec<FixedVertexHandle> = Vec::new();
            for corner in of_loop.iter().step_by(2) {
                let at =
                    spade::mitigate_underflow(spade::Point2::new(corner.flat.x, corner.flat.y));
                let handle = delaunay.insert(at).ok()?;
                // Two corners on one spot are no outline.
                if corners.insert(handle.index(), *corner).is_some() {
                    return None;
                }
                handles.push(handle);
            }
            for (n, &from) in handles.iter().enumerate() {
                let to = handles[(n + 1) % handles.len()];
                if !delaunay.can_add_constraint(from, to) {
                    return None;
                }
                delaunay.add_constraint(from, to);
                middles.insert(ordered([from.index(), to.index()]), of_loop[2 * n + 1]);
            }
            around.push(handles);
        }
        let refined = delaunay.refine(
            RefinementParameters::new()
                .keep_constraint_edges()
                .exclude_outer_faces(true)
                .with_angle_limit(AngleLimit::from_radius_to_shortest_edge_ratio(RADIUS_BY_SIDE))
                .with_max_allowed_area(1.5 * area)
                .with_max_additional_vertices(MOST_TIMES * triangles),
        );
        let outer: BTreeSet<usize> =
            refined.excluded_faces.iter().map(|face| face.index()).collect();
        let mut nodes: BTreeMap<usize, usize> = BTreeMap::new();
        let mut of_sides: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        for face in delaunay.inner_faces().filter(|face| !outer.contains(&face.fix().index())) {
            let vertices = face.vertices().map(|v| (v.fix().index(), v.position()));
            let mut element = [0; 6];
            for (k, (vertex, at)) in vertices.iter().enumerate() {
                let known = corners.get(vertex).copied();
                element[k] = *nodes
                    .entry(*vertex)
                    .or_insert_with(|| self.add(known, Point2::new(at.x, at.y)));
            }
            for k in 0..3 {
                let side = ordered([vertices[k].0, vertices[(k + 1) % 3].0]);
                let (a, b) = (element[k], element[(k + 1) % 3]);
                element[3 + k] = *of_sides.entry(side).or_insert_with(|| {
                    let middle = self.flat[a].lerp(self.flat[b], 0.5);
                    self.add(middles.get(&side).copied(), middle)
                });
            }
            self.elements.push(element);
        }
        for handles in &around {
            let mut of_loop = Vec::new();
            for (from, to) in handles.iter().zip(handles.iter().cycle().skip(1)) {
                of_loop.push(*nodes.get(&from.index())?);
                of_loop.push(*of_sides.get(&ordered([from.index(), to.index()]))?);
            }
            self.border.push(of_loop);
        }
        Some(())
    }

    fn add(&mut self, known: Option<OnBorder>, at: Point2) -> usize {
        self.flat.push(known.map_or(at, |known| known.flat));
        self.space.push(known.map_or(Point3::default(), |known| known.space));
        self.on_border.push(known.is_some());
        self.flat.len() - 1
    }

    /// Lays the inner nodes on the surface.
    fn lay_on(&mut self, surface: &Surface<'_>) {
        self.facing = vec![Vec3::ZERO; self.flat.len()];
        for n in 0..self.flat.len() {
            if !self.on_border[n] {
                (self.space[n], self.facing[n]) = surface.at(self.flat[n]);
            }
        }
        let middle = |nodes: &Nodes| {
            let weights = values(super::element::CENTROID);
            let sum = (0..6).map(|k| self.flat[nodes[k]].to_vec() * weights[k]);
            Point2::default() + sum.fold(sheetwright_geometry::math::Vec2::ZERO, |a, b| a + b)
        };
        self.over = self.elements.iter().map(|nodes| surface.over(middle(nodes))).collect();
    }

    /// The unit normal of the sheet at every corner node of the border, where the nodes lie at
    /// these positions; zero elsewhere.
    pub(super) fn border_normals(&self, positions: &[Point3]) -> Vec<Vec3> {
        let mut normals = vec![Vec3::ZERO; positions.len()];
        for nodes in &self.elements {
            let [a, b, c] = [nodes[0], nodes[1], nodes[2]].map(|n| positions[n]);
            let normal = (b - a).cross(c - a);
            for &n in nodes.iter().take(3).filter(|&&n| self.on_border[n]) {
                normals[n] += normal;
            }
        }
        normals.into_iter().map(|sum| unit(sum).unwrap_or(Vec3::ZERO)).collect()
    }

    /// The sides that two triangles share.
    pub(super) fn inner_sides(&self) -> Vec<InnerSide> {
        let mut first: BTreeMap<[usize; 2], (usize, [usize; 2])> = BTreeMap::new();
        let mut shared = Vec::new();
        for (n, nodes) in self.elements.iter().enumerate() {
            for k in 0..3 {
                let ends = [nodes[k], nodes[(k + 1) % 3]];
                match first.remove(&ordered(ends)) {
                    Some((other, ends)) => shared.push(InnerSide { elements: [other, n], ends }),
                    None => {
                        first.insert(ordered(ends), (n, ends));
                    }
                }
            }
        }
        shared
    }
}

/// The edges of a loop of nodes, from corner to corner of the outline.
fn stretches_of(line: &[usize], divided: &Divided) -> Vec<Stretch> {
    let m = line.len();
    let starts = &divided.edges;
    let stretch = |k: usize| {
        let (from, edge) = starts[k];
        let to = if k + 1 < starts.len() { starts[k + 1].0 } else { starts[0].0 + m };
        Stretch { nodes: (from..=to).map(|n| line[n % m]).collect(), edge }
    };
    (0..starts.len()).map(stretch).collect()
}

/// The ends of a side, the lower first.
pub(super) fn ordered([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// The length of all loops of the pattern, mm.
fn outline_mm(sheet: &Sheet, flat: &Flattened) -> f64 {
    sheet.loops().iter().map(|line| around_mm(line, flat)).sum()
}

fn around_mm(line: &[VertexIndex], flat: &Flattened) -> f64 {
    let next = line.iter().cycle().skip(1);
    let point = |v: &VertexIndex| flat.points[v.get()];
    line.iter().zip(next).map(|(a, b)| point(a).distance(point(b))).sum()
}

/// The components that are narrower than a side of the net, as the facets of a narrow bend between
/// its rulings, where they are a small part of the sheet. They are held all round, and strained as
/// their patterns are.
fn needles(sheet: &Sheet, flat: &Flattened, side_mm: f64) -> Vec<bool> {
    let mesh = sheet.mesh();
    let area = |component: &Component| -> f64 {
        component.triangles.iter().map(|&t| mesh.area_vector(t).length()).sum()
    };
    let is_needle = |component: &Component| {
        let around: f64 = component.loops.iter().map(|&n| around_mm(&sheet.loops()[n], flat)).sum();
        2.0 * area(component) < NEEDLE * side_mm * around
    };
    let components = mesh.components();
    let found: Vec<bool> = components.iter().map(is_needle).collect();
    let [mut of_needles, mut whole] = [0.0; 2];
    for (component, &is_needle) in components.iter().zip(&found) {
        whole += area(component);
        of_needles += if is_needle { area(component) } else { 0.0 };
    }
    if of_needles <= MOST_OF_NEEDLES * whole { found } else { vec![false; components.len()] }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)] // tests panic
mod tests {
    use super::*;
    use crate::mesh::{Cut, Mesh};
    use crate::sheet::cut_along;

    /// The net of 350 triangles of a flat strip of this length and width, mm, in two triangles.
    fn net_of(length: f64, width: f64) -> Option<Net> {
        let flat = [[0.0, 0.0], [length, 0.0], [length, width], [0.0, width]];
        let positions = flat.iter().map(|[x, y]| Point3::new(*x, *y, 0.0)).collect();
        let triangles = [[0, 1, 2], [0, 2, 3]].map(|t| t.map(VertexIndex::new)).to_vec();
        let mesh = Mesh::new(positions, triangles).unwrap();
        let sheet = cut_along(&mesh, &Cut::new()).unwrap();
        let points = flat.iter().map(|[x, y]| Point2::new(*x, *y)).collect();
        let (flat, held) = (Flattened { points, overlap: None }, Edges::default());
        Net::new(&sheet, &flat, &held, 350, Outline::Sampled, (Reading::Facets, false))
    }

    #[test]
    fn a_net_takes_bounded_work_however_narrow_the_outline_is() {
        for exponent in 0..8 {
            let length = (0..exponent).fold(10.0, |length, _| 10.0 * length);
            let net = net_of(length, 10.0);
            // Strips up to 10 m × 1 mm have one.
            assert_eq!(net.is_some(), exponent <= 4, "{length} mm");
            let Some(net) = net else { continue };
            // Corners and middles of at most so many sides, and triangles inside.
            assert!(net.border[0].len() <= 2 * 8 * 350, "{}", net.border[0].len());
            assert!(net.elements.len() <= 2 * (8 + 8) * 350, "{}", net.elements.len());
        }
    }
}
