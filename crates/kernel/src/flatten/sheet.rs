//! A surface as it lies on the sheet: cut open along some of its rungs.
//!
//! Along a cut, every sample lies on two sides and so becomes two of the sheet. Triangles keep
//! their numbers. A surface with one loop needs no cut, and its sheet is the surface itself.

use super::FlattenError;
use crate::surface::{Connectivity, Surface};
use sheetwright_geometry::index::{SampleIndex, TriangleIndex};
use sheetwright_optimum::rung::Rung;
use std::collections::BTreeMap;
use std::ops::Range;

/// A cut that the pattern needs: its two sides are joined when the sheet is bent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seam {
    /// The rung of the surface along which it runs.
    pub rung: Rung,
    /// Its two sides, each from a sample of the sheet to the next on its loop. They run against
    /// one another: the first sample of one belongs on the second of the other.
    pub sides: [[SampleIndex; 2]; 2],
    /// How far apart the two places of a sample lie on the pattern, the larger of both, mm.
    pub gap_mm: f64,
}

/// A surface cut open.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    surface: Surface,
    origin: Vec<SampleIndex>,
    rung_ends: Vec<[SampleIndex; 2]>,
    seams: Vec<Seam>,
}

impl Sheet {
    /// The sheet of a surface that is not cut.
    pub fn whole(surface: &Surface) -> Self {
        Self {
            surface: surface.clone(),
            origin: (0..surface.positions().len()).map(SampleIndex::new).collect(),
            rung_ends: surface.connectivity().hinges().iter().map(|h| h.rung.ends()).collect(),
            seams: Vec::new(),
        }
    }

    /// The sheet of a surface that is cut along the hinges numbered in `cuts`, in increasing
    /// order. Its loops follow the surface's, the one that begins at `first` foremost; of several
    /// that are joined by cuts, the one with the lowest samples counts. Gaps are left 0.
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
        let seams: Option<Vec<Seam>> = cuts
            .iter()
            .map(|&n| {
                let [low, high] = hinges[n].rung.ends();
                let [first, second] = hinges[n].triangles;
                let sides = [side(first, [low, high])?, side(second, [high, low])?];
                Some(Seam { rung: hinges[n].rung, sides, gap_mm: 0.0 })
            })
            .collect();
        let (Some(triangles), Some(rung_ends), Some(seams)) = (triangles, rung_ends, seams) else {
            return Err(FlattenError::Pieces);
        };
        let connectivity =
            Connectivity::new(&loops, triangles).map_err(|_| FlattenError::Pieces)?;
        let positions = origin.iter().map(|&s| surface.position(s)).collect();
        Ok(Self { surface: Surface::new(connectivity, positions), origin, rung_ends, seams })
    }

    /// The surface as it is cut, in space: along a cut its samples lie on one another in pairs.
    /// Its loops are those of the pattern, the outline first.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// The sample of the uncut surface that a sample of the sheet is.
    pub fn origin(&self, sample: SampleIndex) -> SampleIndex {
        self.origin[sample.get()]
    }

    /// Where the `n`-th rung of the uncut surface begins and ends on the sheet; of a seam, its
    /// first side.
    pub fn rung_ends(&self, n: usize) -> [SampleIndex; 2] {
        self.rung_ends[n]
    }

    /// The cuts that are left, in the order of their rungs.
    pub fn seams(&self) -> &[Seam] {
        &self.seams
    }

    pub(super) fn seams_mut(&mut self) -> &mut [Seam] {
        &mut self.seams
    }
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
    parent: Vec<usize>,
}

impl Corners {
    fn joined(connectivity: &Connectivity, cuts: &[usize]) -> Self {
        let mut parent: Vec<usize> = (0..3 * connectivity.triangles().len()).collect();
        for (n, hinge) in connectivity.hinges().iter().enumerate() {
            if cuts.binary_search(&n).is_ok() {
                continue;
            }
            for sample in hinge.rung.ends() {
                let [a, b] =
                    hinge.triangles.map(|t| root(&mut parent, own_corner(connectivity, t, sample)));
                parent[a.max(b)] = a.min(b);
            }
        }
        // Parents have lower numbers, so one pass upwards leads every corner to its root.
        for corner in 0..parent.len() {
            parent[corner] = parent[parent[corner]];
        }
        Self { parent }
    }

    /// What stands for all corners that a corner of a triangle is joined with.
    fn of(&self, connectivity: &Connectivity, triangle: TriangleIndex, at: SampleIndex) -> usize {
        self.parent[own_corner(connectivity, triangle, at)]
    }
}

/// The number of a triangle's corner among those of all triangles.
fn own_corner(connectivity: &Connectivity, triangle: TriangleIndex, at: SampleIndex) -> usize {
    let corners = connectivity.triangles()[triangle.get()];
    3 * triangle.get() + corners.iter().position(|&s| s == at).unwrap_or(0)
}

/// The root of a forest that a number hangs from; the way there is halved for the next time.
pub(super) fn root(parent: &mut [usize], mut n: usize) -> usize {
    while parent[n] != n {
        parent[n] = parent[parent[n]];
        n = parent[n];
    }
    n
}
