//! Shortest ways along the sides of a mesh (Dijkstra).

use super::{Mesh, MeshEdge};
use sheetwright_geometry::index::VertexIndex;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Shortest ways along the sides of a mesh from some vertices.
pub(crate) struct Ways {
    /// How long the way to each vertex is, mm; infinite where none was looked for.
    pub(crate) length: Vec<f64>,
    /// The last side of the way to each vertex.
    pub(super) by: Vec<Option<usize>>,
    /// The vertex that was looked for.
    pub(super) found: Option<VertexIndex>,
}

/// A vertex that a way leads to; the nearest is the greatest, of equals the lowest vertex.
#[derive(PartialEq)]
struct Reached(f64, VertexIndex);

impl Eq for Reached {}

impl Ord for Reached {
    fn cmp(&self, other: &Self) -> Ordering {
        other.0.total_cmp(&self.0).then(other.1.cmp(&self.1))
    }
}

impl PartialOrd for Reached {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ways {
    /// Ways to all vertices, or to the nearest for which `is_goal` (Dijkstra).
    pub(crate) fn from(
        mesh: &Mesh,
        sources: &[VertexIndex],
        is_goal: impl Fn(VertexIndex) -> bool,
    ) -> Self {
        let mut search = Search::new(mesh, sources);
        search.ways.found = search.next(is_goal);
        search.ways
    }

    /// The vertices of the way back from a vertex, itself the first.
    pub(crate) fn vertices_back(&self, mesh: &Mesh, from: VertexIndex) -> Vec<VertexIndex> {
        let mut vertices = vec![from];
        let mut here = from;
        for n in self.back(mesh.edges(), from) {
            let [a, b] = mesh.edges()[n].ends;
            here = if a == here { b } else { a };
            vertices.push(here);
        }
        vertices
    }

    /// The sides of the way back from a vertex.
    pub(super) fn back<'a>(
        &'a self,
        edges: &'a [MeshEdge],
        mut vertex: VertexIndex,
    ) -> impl Iterator<Item = usize> + 'a {
        std::iter::from_fn(move || {
            let n = self.by[vertex.get()]?;
            let [a, b] = edges[n].ends;
            vertex = if a == vertex { b } else { a };
            Some(n)
        })
    }
}

/// A search for shortest ways that goes on where it stopped, with more sources if need be.
pub(crate) struct Search<'a> {
    edges: &'a [MeshEdge],
    lengths: Vec<f64>,
    at: Around,
    next: BinaryHeap<Reached>,
    pub(super) ways: Ways,
}

impl<'a> Search<'a> {
    pub(super) fn new(mesh: &'a Mesh, sources: &[VertexIndex]) -> Self {
        let count = mesh.positions().len();
        let mut search = Self {
            edges: mesh.edges(),
            lengths: mesh.lengths(),
            at: Around::of(mesh),
            next: BinaryHeap::new(),
            ways: Ways { length: vec![f64::INFINITY; count], by: vec![None; count], found: None },
        };
        sources.iter().for_each(|&source| search.add(source));
        search
    }

    /// Takes a vertex as a source from now on.
    pub(super) fn add(&mut self, source: VertexIndex) {
        self.ways.length[source.get()] = 0.0;
        self.ways.by[source.get()] = None;
        self.next.push(Reached(0.0, source));
    }

    /// The nearest vertex for which `is_goal`, once all nearer ones are reached; ways to all where
    /// there is none.
    pub(super) fn next(&mut self, is_goal: impl Fn(VertexIndex) -> bool) -> Option<VertexIndex> {
        while let Some(Reached(length, vertex)) = self.next.pop() {
            if length > self.ways.length[vertex.get()] {
                continue;
            }
            if is_goal(vertex) {
                return Some(vertex);
            }
            for &n in self.at.edges(vertex) {
                let [a, b] = self.edges[n].ends;
                let other = if a == vertex { b } else { a };
                let longer = length + self.lengths[n];
                if longer < self.ways.length[other.get()] {
                    self.ways.length[other.get()] = longer;
                    self.ways.by[other.get()] = Some(n);
                    self.next.push(Reached(longer, other));
                }
            }
        }
        None
    }
}

/// The sides at every vertex.
struct Around {
    starts: Vec<usize>,
    edges: Vec<usize>,
}

impl Around {
    fn of(mesh: &Mesh) -> Self {
        let mut starts = vec![0; mesh.positions().len() + 1];
        for edge in mesh.edges() {
            edge.ends.iter().for_each(|end| starts[end.get() + 1] += 1);
        }
        for v in 1..starts.len() {
            starts[v] += starts[v - 1];
        }
        let mut edges = vec![0; 2 * mesh.edges().len()];
        let mut free = starts.clone();
        for (n, edge) in mesh.edges().iter().enumerate() {
            for end in edge.ends {
                edges[free[end.get()]] = n;
                free[end.get()] += 1;
            }
        }
        Self { starts, edges }
    }

    fn edges(&self, vertex: VertexIndex) -> &[usize] {
        &self.edges[self.starts[vertex.get()]..self.starts[vertex.get() + 1]]
    }
}
