//! Which vertices of a mesh are joined: sides, loops and components, without positions.

use super::MeshError;
use crate::surface::Connectivity;
use sheetwright_geometry::disjoint::DisjointSets;
use sheetwright_geometry::index::{SampleIndex, TriangleIndex, VertexIndex};
use std::ops::Range;

/// A side of one triangle or two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshEdge {
    /// Its ends, the lower vertex first.
    pub ends: [VertexIndex; 2],
    /// First the triangle on whose border it runs from the lower vertex to the higher, then the one
    /// on whose border it runs back; on the border of the mesh one of them is missing.
    pub triangles: [Option<TriangleIndex>; 2],
}

impl MeshEdge {
    /// Whether it lies on the border of the mesh.
    pub fn is_border(&self) -> bool {
        self.triangles.contains(&None)
    }
}

/// A connected component of a mesh: triangles joined by shared sides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Component {
    /// Its triangles, in increasing order.
    pub triangles: Vec<TriangleIndex>,
    /// Its vertices, in increasing order.
    pub vertices: Vec<VertexIndex>,
    /// Its loops, as numbers of the mesh's loops, in increasing order.
    pub loops: Vec<usize>,
    /// Euler's number, vertices − sides + triangles: 1 for a disk, 0 for a ring, 2 for a sphere.
    pub euler: isize,
}

impl Component {
    /// The number of handles: 0 for a sphere, a disk and a disk with holes, 1 for a torus.
    pub fn handles(&self) -> usize {
        // Euler's formula for a surface with two sides: 2 − 2 handles − loops.
        let handles = (2 - self.loops.len() as isize - self.euler) / 2;
        usize::try_from(handles).unwrap_or(0)
    }

    /// Whether it is a disk, one loop round it and no handle.
    pub fn is_disk(&self) -> bool {
        self.euler == 1 && self.loops.len() == 1
    }

    /// Whether it has no border, as a sphere or a torus.
    pub fn is_closed(&self) -> bool {
        self.loops.is_empty()
    }
}

/// Triangles over vertices, without positions. Made by [`super::Mesh`] alone, so it is valid.
#[derive(Clone, Debug, PartialEq)]
pub struct Topology {
    vertices: usize,
    triangles: Vec<[VertexIndex; 3]>,
    edges: Vec<MeshEdge>,
    edges_of_triangles: Vec<[u32; 3]>,
    loops: Vec<Vec<VertexIndex>>,
    components: Vec<Component>,
}

/// A side of one triangle.
#[derive(Clone, Copy)]
pub(super) struct HalfEdge {
    /// Its ends, the lower vertex first.
    pub(super) ends: [VertexIndex; 2],
    pub(super) triangle: u32,
    /// The corner of the triangle at which it begins, 0 ..= 2.
    pub(super) at: u8,
    /// Whether the triangle runs from the lower vertex to the higher.
    pub(super) upwards: bool,
}

impl Topology {
    /// The topology of triangles whose corners are three different vertices below `vertices`.
    pub(super) fn new(
        vertices: usize,
        mut triangles: Vec<[VertexIndex; 3]>,
    ) -> Result<Self, MeshError> {
        let sides = sorted_sides(&triangles);
        let neighbours = neighbours(&sides, triangles.len())?;
        check_fans(&sides, &triangles, vertices)?;
        let (component_of, turned) = facing(&triangles, &neighbours)?;
        for (corners, _) in triangles.iter_mut().zip(&turned).filter(|(_, turned)| **turned) {
            corners.swap(1, 2);
        }
        let (edges, edges_of_triangles) = edges(&sides, &triangles, &turned);
        let loops = loops(&edges, vertices);
        let components = components(&component_of, &triangles, &edges, vertices);
        let mut topology =
            Self { vertices, triangles, edges, edges_of_triangles, loops, components };
        topology.give_loops_to_components();
        Ok(topology)
    }

    /// The topology of a surface of one component without interior vertices.
    pub(super) fn of_surface(connectivity: &Connectivity) -> Self {
        let vertex = |sample: SampleIndex| VertexIndex::new(sample.get());
        let triangles: Vec<[VertexIndex; 3]> =
            connectivity.triangles().iter().map(|corners| corners.map(vertex)).collect();
        let (vertices, count) = (connectivity.samples(), triangles.len());
        let (edges, edges_of_triangles) =
            edges(&sorted_sides(&triangles), &triangles, &vec![false; count]);
        let of_loop = |range: &Range<usize>| range.clone().map(VertexIndex::new).collect();
        let loops: Vec<Vec<VertexIndex>> = connectivity.loops().iter().map(of_loop).collect();
        let components = components(&vec![0; count], &triangles, &edges, vertices);
        let mut topology =
            Self { vertices, triangles, edges, edges_of_triangles, loops, components };
        topology.give_loops_to_components();
        topology
    }

    /// How many vertices there are.
    pub fn vertices(&self) -> usize {
        self.vertices
    }

    /// The triangles; the corners of neighbours run the same way round.
    pub fn triangles(&self) -> &[[VertexIndex; 3]] {
        &self.triangles
    }

    /// All sides, in increasing order of their ends.
    pub fn edges(&self) -> &[MeshEdge] {
        &self.edges
    }

    /// The numbers of a triangle's sides among [`Topology::edges`]: each from the corner of the
    /// same place to the next.
    pub fn edges_of(&self, triangle: TriangleIndex) -> [usize; 3] {
        self.edges_of_triangles[triangle.get()].map(|n| n as usize)
    }

    /// The number of the side between two vertices, if they are joined.
    pub fn edge_between(&self, a: VertexIndex, b: VertexIndex) -> Option<usize> {
        let ends = [a.min(b), a.max(b)];
        self.edges.binary_search_by_key(&ends, |edge| edge.ends).ok()
    }

    /// The loops of the border, each in the direction of the triangles that it belongs to and from
    /// its lowest vertex on.
    pub fn loops(&self) -> &[Vec<VertexIndex>] {
        &self.loops
    }

    /// The parts that hang together, by their lowest triangle.
    pub fn components(&self) -> &[Component] {
        &self.components
    }

    /// Euler's number, vertices − sides + triangles.
    pub fn euler(&self) -> isize {
        self.vertices as isize - self.edges.len() as isize + self.triangles.len() as isize
    }

    /// Whether each vertex lies on the border.
    pub fn on_border(&self) -> Vec<bool> {
        let mut on_border = vec![false; self.vertices];
        for vertex in self.loops.iter().flatten() {
            on_border[vertex.get()] = true;
        }
        on_border
    }

    /// Puts the longest loops first; of equal ones, that with the lowest vertex.
    pub(super) fn sort_loops(&mut self, length: impl Fn(VertexIndex, VertexIndex) -> f64) {
        let around = |of_loop: &[VertexIndex]| -> f64 {
            let next = of_loop.iter().cycle().skip(1);
            of_loop.iter().zip(next).map(|(&a, &b)| length(a, b)).sum()
        };
        let mut keyed: Vec<(f64, Vec<VertexIndex>)> =
            self.loops.drain(..).map(|of_loop| (around(&of_loop), of_loop)).collect();
        keyed.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1[0].cmp(&b.1[0])));
        self.loops = keyed.into_iter().map(|(_, of_loop)| of_loop).collect();
        self.give_loops_to_components();
    }

    fn give_loops_to_components(&mut self) {
        let mut component_of = vec![0; self.vertices];
        for (n, component) in self.components.iter_mut().enumerate() {
            component.loops.clear();
            for vertex in &component.vertices {
                component_of[vertex.get()] = n;
            }
        }
        for (n, of_loop) in self.loops.iter().enumerate() {
            self.components[component_of[of_loop[0].get()]].loops.push(n);
        }
    }
}

/// Every side as every triangle has it, in increasing order of ends, then of triangles.
pub(super) fn sorted_sides(triangles: &[[VertexIndex; 3]]) -> Vec<HalfEdge> {
    let mut sides: Vec<HalfEdge> = Vec::with_capacity(3 * triangles.len());
    for (n, corners) in triangles.iter().enumerate() {
        for at in 0..3 {
            let (from, to) = (corners[at], corners[(at + 1) % 3]);
            let ends = [from.min(to), from.max(to)];
            sides.push(HalfEdge { ends, triangle: n as u32, at: at as u8, upwards: from < to });
        }
    }
    sides.sort_unstable_by_key(|side| (side.ends, side.triangle));
    sides
}

/// The sides that belong together.
pub(super) fn groups(sides: &[HalfEdge]) -> impl Iterator<Item = &[HalfEdge]> {
    sides.chunk_by(|a, b| a.ends == b.ends)
}

/// The neighbours of a triangle at its three sides, and whether each runs the same way round.
pub(super) type Neighbours = [Option<(u32, bool)>; 3];

/// The neighbours of each triangle.
pub(super) fn neighbours(
    sides: &[HalfEdge],
    triangles: usize,
) -> Result<Vec<Neighbours>, MeshError> {
    let mut found = vec![[None; 3]; triangles];
    for group in groups(sides) {
        match *group {
            [_] => {}
            [a, b] => {
                let agree = a.upwards != b.upwards;
                found[a.triangle as usize][a.at as usize] = Some((b.triangle, agree));
                found[b.triangle as usize][b.at as usize] = Some((a.triangle, agree));
            }
            _ => {
                let [from, to] = group[0].ends;
                return Err(MeshError::NotManifold { from, to });
            }
        }
    }
    Ok(found)
}

/// Checks that the triangles of every vertex are one fan: their corners there hang together by the
/// sides that end there.
fn check_fans(
    sides: &[HalfEdge],
    triangles: &[[VertexIndex; 3]],
    vertices: usize,
) -> Result<(), MeshError> {
    let mut same = DisjointSets::new(3 * triangles.len());
    let corner = |side: &HalfEdge, vertex: VertexIndex| {
        let corners = triangles[side.triangle as usize];
        let at = corners.iter().position(|&v| v == vertex).unwrap_or(0);
        3 * side.triangle as usize + at
    };
    for group in groups(sides) {
        if let [a, b] = group {
            for vertex in a.ends {
                same.join(corner(a, vertex), corner(b, vertex));
            }
        }
    }
    let mut fan_of: Vec<Option<usize>> = vec![None; vertices];
    for (n, vertex) in triangles.iter().flatten().enumerate() {
        let fan = same.first(n);
        let known = *fan_of[vertex.get()].get_or_insert(fan);
        if known != fan {
            return Err(MeshError::PinchedVertex { vertex: *vertex });
        }
    }
    match fan_of.iter().position(Option::is_none) {
        Some(vertex) => Err(MeshError::Unused { vertex: VertexIndex::new(vertex) }),
        None => Ok(()),
    }
}

/// The piece of every triangle, and whether the triangle is to be turned round.
pub(super) fn facing(
    triangles: &[[VertexIndex; 3]],
    neighbours: &[Neighbours],
) -> Result<(Vec<usize>, Vec<bool>), MeshError> {
    let mut component_of = vec![usize::MAX; triangles.len()];
    let mut turned = vec![false; triangles.len()];
    let mut components = 0;
    for start in 0..triangles.len() {
        if component_of[start] != usize::MAX {
            continue;
        }
        component_of[start] = components;
        let mut reached = vec![start];
        let mut at = 0;
        while at < reached.len() {
            let here = reached[at];
            at += 1;
            for (side, neighbour) in neighbours[here].iter().enumerate() {
                let Some((there, agree)) = *neighbour else { continue };
                let there = there as usize;
                let as_here = turned[here] == agree;
                if component_of[there] == usize::MAX {
                    component_of[there] = components;
                    turned[there] = as_here;
                    reached.push(there);
                } else if turned[there] != as_here {
                    let corners = triangles[here];
                    let (a, b) = (corners[side], corners[(side + 1) % 3]);
                    return Err(MeshError::NotOrientable { from: a.min(b), to: a.max(b) });
                }
            }
        }
        // The first of the component stays as it is; if most others were turned, they are right.
        if 2 * reached.iter().filter(|&&n| turned[n]).count() > reached.len() {
            for n in reached {
                turned[n] = !turned[n];
            }
        }
        components += 1;
    }
    Ok((component_of, turned))
}

/// The sides of the mesh, and the three of every triangle. Those triangles whose flag in `turned`
/// is set have had their last two corners swapped.
fn edges(
    sides: &[HalfEdge],
    triangles: &[[VertexIndex; 3]],
    turned: &[bool],
) -> (Vec<MeshEdge>, Vec<[u32; 3]>) {
    let mut edges: Vec<MeshEdge> = Vec::new();
    let mut of_triangles = vec![[0; 3]; triangles.len()];
    for group in groups(sides) {
        let mut edge = MeshEdge { ends: group[0].ends, triangles: [None; 2] };
        for side in group {
            let triangle = side.triangle as usize;
            let upwards = side.upwards != turned[triangle];
            edge.triangles[usize::from(!upwards)] = Some(TriangleIndex::new(triangle));
            // Of the corners a, b, c the sides ab, bc, ca become ca, bc, ab when b and c swap.
            let at = if turned[triangle] { 2 - side.at } else { side.at };
            of_triangles[triangle][at as usize] = edges.len() as u32;
        }
        edges.push(edge);
    }
    (edges, of_triangles)
}

/// The loops of the border, each from its lowest vertex on, in the order of these.
fn loops(edges: &[MeshEdge], vertices: usize) -> Vec<Vec<VertexIndex>> {
    // One fan at every vertex: at most one edge of the border leaves it.
    let mut next: Vec<Option<VertexIndex>> = vec![None; vertices];
    for edge in edges.iter().filter(|edge| edge.is_border()) {
        let [low, high] = edge.ends;
        let (from, to) = if edge.triangles[0].is_some() { (low, high) } else { (high, low) };
        next[from.get()] = Some(to);
    }
    let mut loops = Vec::new();
    for start in 0..vertices {
        let mut of_loop = Vec::new();
        let mut at = start;
        while let Some(to) = next[at].take() {
            of_loop.push(VertexIndex::new(at));
            at = to.get();
        }
        if !of_loop.is_empty() {
            loops.push(of_loop);
        }
    }
    loops
}

fn components(
    component_of: &[usize],
    triangles: &[[VertexIndex; 3]],
    edges: &[MeshEdge],
    vertices: usize,
) -> Vec<Component> {
    let count = component_of.iter().max().map_or(0, |most| most + 1);
    let empty =
        Component { triangles: Vec::new(), vertices: Vec::new(), loops: Vec::new(), euler: 0 };
    let mut components = vec![empty; count];
    let mut of_vertex = vec![0; vertices];
    for (n, corners) in triangles.iter().enumerate() {
        components[component_of[n]].triangles.push(TriangleIndex::new(n));
        for vertex in corners {
            of_vertex[vertex.get()] = component_of[n];
        }
    }
    for (n, &component) in of_vertex.iter().enumerate() {
        components[component].vertices.push(VertexIndex::new(n));
    }
    for component in &mut components {
        component.euler = (component.vertices.len() + component.triangles.len()) as isize;
    }
    for edge in edges {
        components[of_vertex[edge.ends[0].get()]].euler -= 1;
    }
    components
}
