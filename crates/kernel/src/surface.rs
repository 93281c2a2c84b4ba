//! A surface without interior vertices: triangles over samples.
//!
//! [`Connectivity`] holds which samples are joined, but no positions; [`Surface`] adds positions.
//! Flattening takes a connectivity and lengths, so it can't depend on positions.

use sheetwright_geometry::index::{SampleIndex, TriangleIndex};
use sheetwright_geometry::math::{Point3, Vec3, angle_between, unit};
use sheetwright_optimum::rung::Rung;
use std::fmt;
use std::ops::Range;

/// A rung with the two triangles that it joins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hinge {
    /// The rung.
    pub rung: Rung,
    /// Its triangles: first the one on whose border it runs from the lower sample to the higher.
    pub triangles: [TriangleIndex; 2],
}

/// Triangles over samples, without positions.
#[derive(Clone, Debug, PartialEq)]
pub struct Connectivity {
    samples: usize,
    loops: Vec<Range<usize>>,
    triangles: Vec<[SampleIndex; 3]>,
    hinges: Vec<Hinge>,
}

/// Why triangles are no surface over the loops of a boundary.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ConnectivityError {
    /// A side that belongs to more than two triangles, or twice in the same direction.
    NotManifold {
        /// One end of the side.
        from: SampleIndex,
        /// The other end.
        to: SampleIndex,
    },
    /// A side of only one triangle that is no edge of the boundary, or an edge of the boundary that
    /// is no such side.
    OpenSide {
        /// One end of the side.
        from: SampleIndex,
        /// The other end.
        to: SampleIndex,
    },
    /// A triangle with a corner that is no sample, or with two corners on one.
    BadTriangle(TriangleIndex),
}

impl fmt::Display for ConnectivityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotManifold { from, to } => {
                write!(f, "the side {from}–{to} belongs to more than two triangles")
            }
            Self::OpenSide { from, to } => {
                write!(f, "the side {from}–{to} does not agree with the boundary")
            }
            Self::BadTriangle(triangle) => write!(f, "triangle {triangle} has no three corners"),
        }
    }
}

impl std::error::Error for ConnectivityError {}

impl Connectivity {
    /// The surface that `triangles` make over the samples of `loops` (numbers of samples, loop
    /// after loop). Corners run counter-clockwise as seen from the side that the surface faces.
    ///
    /// # Errors
    /// Unless the triangles are a manifold whose border is exactly the loops. Faults of single
    /// triangles come first.
    pub fn new(
        loops: &[Range<usize>],
        triangles: Vec<[SampleIndex; 3]>,
    ) -> Result<Self, ConnectivityError> {
        let samples = loops.iter().map(|l| l.end).max().unwrap_or(0);
        // Sides that begin at one sample lie side by side in a list, up to the end of its row.
        let mut ends = vec![0; samples];
        for (n, &[a, b, c]) in triangles.iter().enumerate() {
            let corners_differ = a != b && b != c && c != a;
            if !corners_differ || [a, b, c].iter().any(|s| s.get() >= samples) {
                return Err(ConnectivityError::BadTriangle(TriangleIndex::new(n)));
            }
            [a, b, c].iter().for_each(|from| ends[from.get()] += 1);
        }
        let mut before = 0;
        for end in &mut ends {
            let count = *end;
            *end = before;
            before += count;
        }
        // Each with the place where it is written, three to a triangle.
        let none = ([SampleIndex::new(0); 2], 0);
        let mut sides: Vec<([SampleIndex; 2], usize)> = vec![none; 3 * triangles.len()];
        for (n, &[a, b, c]) in triangles.iter().enumerate() {
            for (side, place) in [([a, b], 3 * n), ([b, c], 3 * n + 1), ([c, a], 3 * n + 2)] {
                let end = &mut ends[side[0].get()];
                sides[*end] = (side, place);
                *end += 1;
            }
        }
        let row = |from: usize| if from == 0 { 0..ends[0] } else { ends[from - 1]..ends[from] };
        (0..samples).for_each(|from| sides[row(from)].sort_unstable());
        let twice = sides.windows(2).filter(|pair| pair[0].0 == pair[1].0).map(|pair| pair[1]);
        if let Some(([from, to], _)) = twice.min_by_key(|(_, place)| *place) {
            return Err(ConnectivityError::NotManifold { from, to });
        }
        let triangle_at = |side: [SampleIndex; 2]| {
            let row = &sides[row(side[0].get())];
            let found = row.binary_search_by_key(&side, |(side, _)| *side).ok()?;
            Some(TriangleIndex::new(row[found].1 / 3))
        };
        let mut edges: Vec<[SampleIndex; 2]> = edges_of(loops).collect();
        edges.sort_unstable();
        if let Some(&[from, to]) = edges.iter().find(|edge| triangle_at(**edge).is_none()) {
            return Err(ConnectivityError::OpenSide { from, to });
        }
        let mut hinges = Vec::with_capacity(triangles.len());
        for &([from, to], place) in &sides {
            match triangle_at([to, from]) {
                Some(other) if from < to => hinges.push(Hinge {
                    rung: Rung::new(from.get(), to.get()),
                    triangles: [TriangleIndex::new(place / 3), other],
                }),
                Some(_) => {}
                None if edges.binary_search(&[from, to]).is_ok() => {}
                None => return Err(ConnectivityError::OpenSide { from, to }),
            }
        }
        Ok(Self { samples, loops: loops.to_vec(), triangles, hinges })
    }

    /// How many samples there are.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// The numbers of the samples of each loop, the outer one first.
    pub fn loops(&self) -> &[Range<usize>] {
        &self.loops
    }

    /// The triangles; corners counter-clockwise as seen from the side that the surface faces.
    pub fn triangles(&self) -> &[[SampleIndex; 3]] {
        &self.triangles
    }

    /// The rungs with the triangles that they join, in increasing order.
    pub fn hinges(&self) -> &[Hinge] {
        &self.hinges
    }

    /// The edges of the boundary, loop after loop, each from a sample to the next.
    pub fn edges(&self) -> impl Iterator<Item = [SampleIndex; 2]> + '_ {
        edges_of(&self.loops)
    }

    /// All sides: the edges of the boundary, then the rungs.
    pub fn sides(&self) -> impl Iterator<Item = [SampleIndex; 2]> + '_ {
        self.edges().chain(self.hinges.iter().map(|h| h.rung.ends()))
    }

    /// The corner of a triangle that is no end of a side of it.
    pub(crate) fn far_corner(
        &self,
        triangle: TriangleIndex,
        side: [SampleIndex; 2],
    ) -> SampleIndex {
        let corners = self.triangles[triangle.get()];
        corners.into_iter().find(|c| !side.contains(c)).unwrap_or(corners[0])
    }

    /// The hinges of each triangle, by their numbers.
    pub fn hinges_of_triangles(&self) -> Vec<Vec<usize>> {
        let mut of_triangles = vec![Vec::new(); self.triangles.len()];
        for (n, hinge) in self.hinges.iter().enumerate() {
            for triangle in hinge.triangles {
                of_triangles[triangle.get()].push(n);
            }
        }
        of_triangles
    }
}

/// The edges of loops of samples, loop after loop, each from a sample to the next.
fn edges_of(loops: &[Range<usize>]) -> impl Iterator<Item = [SampleIndex; 2]> + '_ {
    loops.iter().flat_map(|l| {
        l.clone().map(|i| {
            let next = if i + 1 == l.end { l.start } else { i + 1 };
            [i, next].map(SampleIndex::new)
        })
    })
}

/// A connectivity with positions of its samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    connectivity: Connectivity,
    positions: Vec<Point3>,
}

impl Surface {
    /// The surface of a connectivity whose samples lie at `positions`, mm.
    ///
    /// # Panics
    /// Unless there is one position a sample.
    pub fn new(connectivity: Connectivity, positions: Vec<Point3>) -> Self {
        assert_eq!(connectivity.samples(), positions.len(), "one position a sample");
        Self { connectivity, positions }
    }

    /// The triangles over samples, without positions.
    pub fn connectivity(&self) -> &Connectivity {
        &self.connectivity
    }

    /// The positions of the samples, mm.
    pub fn positions(&self) -> &[Point3] {
        &self.positions
    }

    /// The position of a sample, mm.
    pub fn position(&self, sample: SampleIndex) -> Point3 {
        self.positions[sample.get()]
    }

    /// The distance between two samples, mm.
    pub fn length(&self, a: SampleIndex, b: SampleIndex) -> f64 {
        self.position(a).distance(self.position(b))
    }

    /// The corners of a triangle, mm.
    pub fn corners(&self, triangle: TriangleIndex) -> [Point3; 3] {
        self.connectivity.triangles[triangle.get()].map(|s| self.position(s))
    }

    /// The area vector of a triangle, mm²: along its normal, as long as its area.
    pub fn area_vector(&self, triangle: TriangleIndex) -> Vec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(c - a) * 0.5
    }

    /// The unit normal of a triangle on the side that the surface faces; `None` without area.
    pub fn normal(&self, triangle: TriangleIndex) -> Option<Vec3> {
        unit(self.area_vector(triangle))
    }

    /// The angle between the normals of the two triangles at a hinge, radians in −π ..= π:
    /// positive where the surface bends away from the side that it faces (a mountain, as seen from
    /// there). 0 where a triangle has no area.
    pub fn crease(&self, hinge: &Hinge) -> f64 {
        let [low, high] = hinge.rung.ends().map(|s| self.position(s));
        signed_crease(hinge.triangles.map(|t| self.area_vector(t)), high - low)
    }
}

/// The angle between two triangles that share a side, by their area vectors, radians in −π ..= π:
/// positive over a mountain, 0 where one has no area. `along` is the side in the direction in which
/// the first triangle lies to its left.
pub(crate) fn signed_crease(areas: [Vec3; 2], along: Vec3) -> f64 {
    let [Some(first), Some(second)] = areas.map(unit) else { return 0.0 };
    // Over a ridge, going from the first triangle to the second turns the normal about the side.
    let turn = first.cross(second).dot(along);
    let angle = angle_between(first, second);
    if turn < 0.0 { -angle } else { angle }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangles(list: &[[usize; 3]]) -> Vec<[SampleIndex; 3]> {
        list.iter().map(|t| t.map(SampleIndex::new)).collect()
    }

    fn four() -> Vec<Range<usize>> {
        std::iter::once(0..4).collect()
    }

    #[test]
    fn two_triangles_make_a_square_with_one_hinge() {
        let c = Connectivity::new(&four(), triangles(&[[0, 1, 2], [0, 2, 3]])).unwrap();
        assert_eq!(c.hinges().len(), 1);
        assert_eq!(c.hinges()[0].rung, Rung::new(0, 2));
        assert_eq!(c.hinges()[0].triangles, [TriangleIndex::new(1), TriangleIndex::new(0)]);
        assert_eq!(c.sides().count(), 5);
    }

    #[test]
    fn what_is_no_surface_is_refused() {
        let refused =
            |list: &[[usize; 3]]| Connectivity::new(&four(), triangles(list)).unwrap_err();
        let s = SampleIndex::new;
        assert_eq!(refused(&[[0, 1, 2]]), ConnectivityError::OpenSide { from: s(2), to: s(3) });
        assert_eq!(
            refused(&[[0, 1, 2], [0, 1, 3]]),
            ConnectivityError::NotManifold { from: s(0), to: s(1) }
        );
        assert_eq!(
            refused(&[[0, 1, 1], [0, 2, 3]]),
            ConnectivityError::BadTriangle(TriangleIndex::new(0))
        );
    }

    #[test]
    fn a_roof_is_a_mountain_from_above() {
        let c = Connectivity::new(&four(), triangles(&[[0, 1, 2], [0, 2, 3]])).unwrap();
        let at = |x: f64, y: f64, z: f64| Point3::new(x, y, z);
        // The ridge runs from sample 0 to sample 2.
        let roof = [at(0., 0., 1.), at(1., -1., 0.), at(2., 0., 1.), at(1., 1., 0.)];
        let surface = Surface::new(c.clone(), roof.to_vec());
        let crease = surface.crease(&c.hinges()[0]);
        assert!((crease - std::f64::consts::FRAC_PI_2).abs() < 1e-12, "{crease}");
        let gutter = roof.map(|p| at(p.x, p.y, -p.z)).to_vec();
        let crease = Surface::new(c.clone(), gutter).crease(&c.hinges()[0]);
        assert!((crease + std::f64::consts::FRAC_PI_2).abs() < 1e-12, "{crease}");
    }
}
