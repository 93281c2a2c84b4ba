//! Parts of a mesh that are too small to be sheet.
//!
//! Files of meshes hold crumbs: triangles of 1e-14 mm that some operation left, or slivers without
//! width. Each would become a panel of its own, whose pattern has no digits left. A small triangle
//! that is joined to larger ones is no crumb: leaving it out would tear the surface.

use super::corners::separated;
use sheetwright_geometry::disjoint::DisjointSets;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point3, Vec3};
use sheetwright_geometry::tolerance::{MIN_SIZE_MM, Tolerance};
use std::collections::BTreeMap;

/// Parts that were left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Specks {
    /// How many.
    pub parts: usize,
    /// Where the first of them lies, mm: one of its vertices.
    pub first: Point3,
}

/// Triangles without the parts that are too small, and those that were left out.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WithoutSpecks {
    /// The vertices that are left, mm.
    pub(crate) positions: Vec<Point3>,
    /// The triangles that are left.
    pub(crate) triangles: Vec<[VertexIndex; 3]>,
    /// The parts that are not.
    pub(crate) specks: Specks,
}

/// The limits below which a component is too small.
struct Limits {
    /// The least width, mm: the area of a part divided by its size.
    width: f64,
    /// The size of the file, mm.
    of: f64,
}

/// The box and the area of a connected component.
struct ComponentSize {
    first: usize,
    low: Vec3,
    high: Vec3,
    area: f64,
}

impl ComponentSize {
    fn of_triangle(first: usize, at: [Point3; 3]) -> Self {
        let [a, b, c] = at.map(Point3::to_vec);
        let area = 0.5 * (b - a).cross(c - a).length();
        Self { first, low: a.min(b).min(c), high: a.max(b).max(c), area }
    }

    fn with(self, other: &Self) -> Self {
        Self {
            first: self.first,
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            area: self.area + other.area,
        }
    }

    fn is_speck(&self, limits: &Limits) -> bool {
        let size = (self.high - self.low).length();
        size < MIN_SIZE_MM || self.area < limits.width * size
    }

    /// Whether a triangle may belong to a part that is too small: no triangle of such a part has
    /// more area or size than the part.
    fn may_be_of_speck(&self, limits: &Limits) -> bool {
        (self.high - self.low).length() < MIN_SIZE_MM || self.area < limits.width * limits.of
    }
}

/// Triangles without the parts that are smaller than [`MIN_SIZE_MM`], or narrower (area by size)
/// than [`Tolerance::SAME_POINT`] of the size of the file that they are from, mm. `None` if there
/// are none, and where a corner is no vertex.
pub(crate) fn without_specks(
    positions: &[Point3],
    triangles: &[[VertexIndex; 3]],
    file_size_mm: f64,
) -> Option<WithoutSpecks> {
    if triangles.iter().flatten().any(|v| v.get() >= positions.len()) {
        return None;
    }
    let limits = Limits { width: Tolerance::SAME_POINT.length_mm(file_size_mm), of: file_size_mm };
    let alone = |n: usize| ComponentSize::of_triangle(n, triangles[n].map(|v| positions[v.get()]));
    if !(0..triangles.len()).any(|n| alone(n).may_be_of_speck(&limits)) {
        return None;
    }
    // Vertices in which parts only touch are taken apart first.
    let apart = separated(triangles, |_| false);
    let mut of = DisjointSets::new(apart.origin.len());
    for [a, b, c] in &apart.triangles {
        of.join(a.get(), b.get());
        of.join(a.get(), c.get());
    }
    let part_of: Vec<usize> = apart.triangles.iter().map(|t| of.first(t[0].get())).collect();
    let mut parts: BTreeMap<usize, ComponentSize> = BTreeMap::new();
    for (n, part) in part_of.iter().enumerate() {
        let more = alone(n);
        let whole = match parts.remove(part) {
            Some(known) => known.with(&more),
            None => more,
        };
        parts.insert(*part, whole);
    }
    parts.retain(|_, part| part.is_speck(&limits));
    let first = parts.values().map(|part| part.first).min()?;
    let first = positions[triangles[first][0].get()];
    let specks = Specks { parts: parts.len(), first };
    let kept = |n: &usize| !parts.contains_key(&part_of[*n]);
    let kept: Vec<[VertexIndex; 3]> =
        (0..triangles.len()).filter(kept).map(|n| triangles[n]).collect();
    let mut used: Vec<VertexIndex> = kept.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let number = |v: VertexIndex| VertexIndex::new(used.partition_point(|other| *other < v));
    let triangles = kept.iter().map(|t| t.map(number)).collect();
    let positions = used.iter().map(|v| positions[v.get()]).collect();
    Some(WithoutSpecks { positions, triangles, specks })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle a list, each with vertices of its own.
    fn soup(list: &[[[f64; 3]; 3]]) -> (Vec<Point3>, Vec<[VertexIndex; 3]>) {
        let positions = list.iter().flatten().map(|&[x, y, z]| Point3::new(x, y, z)).collect();
        let numbers = (0..list.len()).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]);
        (positions, numbers.map(|t| t.map(VertexIndex::new)).collect())
    }

    fn right(size: f64) -> [[f64; 3]; 3] {
        [[0.0; 3], [size, 0.0, 0.0], [0.0, size, 0.0]]
    }

    #[test]
    fn parts_too_small_or_too_narrow_are_left_out_and_counted() {
        let narrow = [[3.0, 0.0, 0.0], [3.0, 5.0, 0.0], [3.0, 5.0, 1e-13]];
        let (positions, triangles) = soup(&[right(1e-14), right(100.0), narrow, right(1e-5)]);
        let found = without_specks(&positions, &triangles, 100.0).unwrap();
        assert_eq!(found.specks, Specks { parts: 2, first: positions[0] });
        assert_eq!(found.triangles, soup(&[right(100.0), right(1e-5)]).1);
        assert_eq!(found.positions, soup(&[right(100.0), right(1e-5)]).0);
        assert!(without_specks(&found.positions, &found.triangles, 100.0).is_none());
    }

    #[test]
    fn what_hangs_together_with_more_stays() {
        // A sliver on the side of a triangle, a crumb that touches it in a point.
        let at = |x: f64, y: f64| Point3::new(x, y, 0.0);
        let positions =
            vec![at(0., 0.), at(10., 0.), at(0., 9.), at(5., -1e-14), at(-1e-9, 0.), at(0., -1e-9)];
        let triangles = [[0, 1, 2], [1, 0, 3], [0, 4, 5]].map(|t| t.map(VertexIndex::new));
        let found = without_specks(&positions, &triangles, 10.0).unwrap();
        assert_eq!(found.triangles, triangles[..2]);
        assert_eq!((found.positions, found.specks.parts), (positions[..4].to_vec(), 1));
        assert!(without_specks(&positions[..4], &triangles[..2], 10.0).is_none());
    }
}
