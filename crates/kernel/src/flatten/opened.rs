//! A surface cut open along some of its rungs, while it is being laid flat: what becomes its
//! [`Sheet`].

use super::FlattenError;
use crate::mesh::Mesh;
use crate::sheet::Sheet;
use crate::surface::{Connectivity, Surface};
use sheetwright_geometry::disjoint::DisjointSets;
use sheetwright_geometry::index::{SampleIndex, TriangleIndex, VertexIndex};
use sheetwright_geometry::math::Point2;
use std::collections::BTreeMap;
use std::ops::Range;

/// The two sides of a cut, each from a sample of the surface as it is cut to the next on its loop.
/// They run against one another: the first sample of one belongs on the second of the other.
pub(super) type CutSides = [[SampleIndex; 2]; 2];

/// A surface cut open.
#[derive(Clone, Debug)]
pub(super) struct Opened {
    surface: Surface,
    origin: Vec<SampleIndex>,
    rung_ends: Vec<[SampleIndex; 2]>,
    cuts: Vec<CutSides>,
}

/// A sample as a vertex of a sheet.
fn vertex(sample: SampleIndex) -> VertexIndex {
    VertexIndex::new(sample.get())
}

impl Opened {
    /// A surface that is cut along the hinges numbered in `cuts`, in increasing
    /// order. Its loops follow the surface's, the one that begins at `first` foremost; of several
    /// that are joined by cuts, the one with the lowest samples counts.
    ///
    /// # Errors
    /// [`FlattenError::Pieces`] if a sample would lie inside, or more than once on the border.
    pub(super) fn cut(
        surface: &Surface,
        cuts: &[usize],
        first: usize,
    ) -> Result<Self, FlattenError> {
        let connectivity = surface.connectivity();
        let hinges = connectivity.hinges();
        let corners = Corners::joined(connectivity, cuts);
        let edges = border(connectivity, cuts, first);
        let mut leaving: BTreeMap<usize, usize> = BTreeMap::new();
        for (n, edge) in edges.iter().enumerate() {
            let from = corners.of(connectivity, edge.triangle, edge.ends[0]);
            if leaving.insert(from, n).is_some() {
                return Err(FlattenError::Pieces);
            }
        }
        // Round the border from each edge that was not come by yet.
        let mut number: BTreeMap<usize, SampleIndex> = BTreeMap::new();
        let mut origin = Vec::new();
        let mut loops: Vec<Range<usize>> = Vec::new();
        for edge in &edges {
            let start = origin.len();
            let mut corner = corners.of(connectivity, edge.triangle, edge.ends[0]);
            while !number.contains_key(&corner) {
                let Some(&n) = leaving.get(&corner) else { return Err(FlattenError::Pieces) };
                number.insert(corner, SampleIndex::new(origin.len()));
                origin.push(edges[n].ends[0]);
                corner = corners.of(connectivity, edges[n].triangle, edges[n].ends[1]);
            }
            if origin.len() > start {
                loops.push(start..origin.len());
            }
        }
        let place = |triangle: TriangleIndex, sample: SampleIndex| {
            number.get(&corners.of(connectivity, triangle, sample)).copied()
        };
        let triangles: Option<Vec<[SampleIndex; 3]>> = (0..connectivity.triangles().len())
            .map(TriangleIndex::new)
            .map(|t| {
                let [a, b, c] = connectivity.triangles()[t.get()].map(|s| place(t, s));
                Some([a?, b?, c?])
            })
            .collect();
        let side = |triangle: TriangleIndex, [a, b]: [SampleIndex; 2]| {
            Some([place(triangle, a)?, place(triangle, b)?])
        };
        let rung_ends: Option<Vec<[SampleIndex; 2]>> =
            hinges.iter().map(|h| side(h.triangles[0], h.rung.ends())).collect();
        let cuts: Option<Vec<CutSides>> = cuts
            .iter()
            .map(|&n| {
                let [low, high] = hinges[n].rung.ends();
                let [first, second] = hinges[n].triangles;
                Some([side(first, [low, high])?, side(second, [high, low])?])
            })
            .collect();
        let (Some(triangles), Some(rung_ends), Some(cuts)) = (triangles, rung_ends, cuts) else {
            return Err(FlattenError::Pieces);
        };
        let connectivity =
            Connectivity::new(&loops, triangles).map_err(|_| FlattenError::Pieces)?;
        let positions = origin.iter().map(|&s| surface.position(s)).collect();
        Ok(Self { surface: Surface::new(connectivity, positions), origin, rung_ends, cuts })
    }

    /// The surface as it is cut, in space: along a cut its samples lie on one another in pairs.
    /// Its loops are those of the pattern, the outline first.
    pub(super) fn surface(&self) -> &Surface {
        &self.surface
    }

    /// The sample of the uncut surface that a sample is.
    pub(super) fn origin(&self, sample: SampleIndex) -> SampleIndex {
        self.origin[sample.get()]
    }

    /// The cuts that are left, in the order of their rungs.
    pub(super) fn cuts(&self) -> &[CutSides] {
        &self.cuts
    }

    /// The sheet whose samples lie at these points when it is flat.
    pub(super) fn sheet(&self, points: &[Point2]) -> Sheet {
        let origin = self.origin.iter().copied().map(vertex).collect();
        let ways = |&[[a, b], [c, d]]: &CutSides| [vec![a, b], vec![d, c]].map(named);
        let named_ends = self.rung_ends.iter().map(|ends| ends.map(vertex)).collect();
        let seams = self.cuts.iter().map(ways).collect();
        let sheet = Sheet::new(Mesh::of_surface(&self.surface), origin, seams);
        sheet.with_rungs(named_ends).laid_at(points)
    }
}

fn named(side: Vec<SampleIndex>) -> Vec<VertexIndex> {
    side.into_iter().map(vertex).collect()
}

/// An edge of the border of a sheet, by the samples of the uncut surface, and the triangle to its
/// left.
struct BorderEdge {
    ends: [SampleIndex; 2],
    triangle: TriangleIndex,
}

/// The edges of the boundary, those of loop `first` foremost, and then both sides of the cuts.
fn border(connectivity: &Connectivity, cuts: &[usize], first: usize) -> Vec<BorderEdge> {
    let mut left_of: BTreeMap<[SampleIndex; 2], TriangleIndex> = BTreeMap::new();
    for (n, &[a, b, c]) in connectivity.triangles().iter().enumerate() {
        for side in [[a, b], [b, c], [c, a]] {
            left_of.insert(side, TriangleIndex::new(n));
        }
    }
    let of_first = &connectivity.loops()[first];
    let mut edges: Vec<BorderEdge> = connectivity
        .edges()
        .filter_map(|ends| Some(BorderEdge { ends, triangle: *left_of.get(&ends)? }))
        .collect();
    edges.sort_by_key(|edge| !of_first.contains(&edge.ends[0].get()));
    for &n in cuts {
        let hinge = connectivity.hinges()[n];
        let [low, high] = hinge.rung.ends();
        edges.push(BorderEdge { ends: [low, high], triangle: hinge.triangles[0] });
        edges.push(BorderEdge { ends: [high, low], triangle: hinge.triangles[1] });
    }
    edges
}

/// The corners of all triangles, those joined that are one sample of the sheet.
struct Corners {
    /// The lowest corner that each is joined with.
    first: Vec<usize>,
}

impl Corners {
    fn joined(connectivity: &Connectivity, cuts: &[usize]) -> Self {
        let mut same = DisjointSets::new(3 * connectivity.triangles().len());
        for (n, hinge) in connectivity.hinges().iter().enumerate() {
            if cuts.binary_search(&n).is_ok() {
                continue;
            }
            for sample in hinge.rung.ends() {
                let [a, b] = hinge.triangles.map(|t| own_corner(connectivity, t, sample));
                same.join(a, b);
            }
        }
        Self { first: same.all_first() }
    }

    /// What stands for all corners that a corner of a triangle is joined with.
    fn of(&self, connectivity: &Connectivity, triangle: TriangleIndex, at: SampleIndex) -> usize {
        self.first[own_corner(connectivity, triangle, at)]
    }
}

/// The number of a triangle's corner among those of all triangles.
fn own_corner(connectivity: &Connectivity, triangle: TriangleIndex, at: SampleIndex) -> usize {
    let corners = connectivity.triangles()[triangle.get()];
    3 * triangle.get() + corners.iter().position(|&s| s == at).unwrap_or(0)
}
