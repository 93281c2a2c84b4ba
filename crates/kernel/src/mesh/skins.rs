//! Plates that come as closed meshes: two skins a thickness apart, and a band round their edges.
//!
//! Twice the volume of a closed plate by its area is its thickness, a little less for the band. A
//! triangle belongs to a skin if a triangle that faces the other way lies behind it, within twice
//! that length: behind the band there is the whole width of the plate. If the triangles of skins
//! hang together as two parts, each behind the other, as large as the other within a factor of two
//! and everywhere as far, the mesh is such a plate. Round a sharp bend, the nearest point of the
//! other skin is the bend itself, at most √2 thicknesses away.

use super::tree::{Extent, Tree};
use super::{Component, Mesh};
use sheetwright_geometry::disjoint::DisjointSets;
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::{Point3, Vec3, unit};
use sheetwright_geometry::triangle::nearest_in_triangle;

/// A plate is at least twenty times as wide as it is thick. What is thicker is a body.
const MOST_THICKNESS: f64 = 0.05;
/// How far the other skin may be, in thicknesses: more than the √2 of a sharp bend.
const REACH: f64 = 2.0;
/// Two triangles face different ways if the cosine between their normals is below this.
const FACES_AWAY: f64 = -0.5;
/// The thickness is the same within this share of it.
const SAME: f64 = 0.25;
/// On this share of the area of both skins at least.
const MOSTLY: f64 = 0.9;
/// The least share of the area that both skins have, with the band.
const LEAST_SKINS: f64 = 0.6;

/// One of the two skins of a plate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Skin {
    /// The larger one, which lies outside where the plate bends one way; the first if both are as
    /// large.
    Outer,
    /// The other.
    Inner,
}

/// The two skins of a plate.
#[derive(Clone, Debug, PartialEq)]
pub struct Skins {
    /// How far they are apart, mm: the mean.
    pub thickness_mm: f64,
    /// The triangles of the outer skin and of the inner.
    pub triangles: [Vec<TriangleIndex>; 2],
}

/// The triangle behind another: how far it is, and its number.
type Behind = Option<(f64, usize)>;

/// The skins of a component of a mesh, if it is a closed plate.
pub fn two_skins(mesh: &Mesh, component: &Component) -> Option<Skins> {
    if !component.is_closed() {
        return None;
    }
    let numbers = &component.triangles;
    let corners: Vec<[Point3; 3]> = numbers.iter().map(|&t| mesh.corners(t)).collect();
    let vectors: Vec<Vec3> = numbers.iter().map(|&t| mesh.area_vector(t)).collect();
    let area: f64 = vectors.iter().map(|v| v.length()).sum();
    let from = corners[0][0];
    let cone = |(at, vector): (&[Point3; 3], &Vec3)| (at[0] - from).dot(*vector) / 3.0;
    let volume: f64 = corners.iter().zip(&vectors).map(cone).sum();
    let thickness = 2.0 * volume.abs() / area;
    if thickness > MOST_THICKNESS * (0.5 * area).sqrt() {
        return None;
    }
    let normals: Vec<Vec3> =
        vectors.iter().map(|&v| unit(v * volume.signum()).unwrap_or_default()).collect();
    let behind = behind(&corners, &normals, REACH * thickness);
    let sides = sides(mesh, numbers, &behind)?;
    // The other skin lies behind each.
    let mut areas = [0.0, 0.0];
    let (mut sum, mut triangles) = (0.0, [Vec::new(), Vec::new()]);
    for (n, side) in sides.iter().enumerate() {
        let (Some(side), Some((distance, other))) = (*side, behind[n]) else { continue };
        if sides[other] == Some(side) {
            return None;
        }
        areas[side] += vectors[n].length();
        sum += vectors[n].length() * distance;
        triangles[side].push(numbers[n]);
    }
    let both = areas[0] + areas[1];
    let thickness_mm = sum / both;
    let is_same = |n: &usize| {
        behind[*n]
            .is_some_and(|(distance, _)| (distance - thickness_mm).abs() <= SAME * thickness_mm)
    };
    let same: f64 = (0..sides.len()).filter(is_same).map(|n| vectors[n].length()).sum();
    let is_plate = both >= LEAST_SKINS * area
        && areas[0].max(areas[1]) <= 2.0 * areas[0].min(areas[1])
        && same >= MOSTLY * both;
    // Both areas are as large up to rounding in a flat plate.
    if areas[1] > areas[0] * (1.0 + 1e-9) {
        triangles.reverse();
    }
    is_plate.then_some(Skins { thickness_mm, triangles })
}

/// The nearest triangle behind the middle of each that faces the other way, within `reach` mm.
fn behind(corners: &[[Point3; 3]], normals: &[Vec3], reach: f64) -> Vec<Behind> {
    let extents: Vec<Extent> =
        corners.iter().map(|at| Extent::of(at.map(Point3::to_vec))).collect();
    let tree = Tree::new(&extents);
    let of = |n: usize| {
        let [a, b, c] = corners[n];
        let (here, normal) = (a + ((b - a) + (c - a)) / 3.0, normals[n]);
        let mut found: (f64, Behind) = (reach, None);
        tree.visit(
            &mut found,
            |found, extent| extent.distance(here.to_vec()) <= found.0,
            |found, other| {
                if normal.dot(normals[other]) > FACES_AWAY {
                    return;
                }
                let there = nearest_in_triangle(corners[other], here);
                let distance = here.distance(there);
                let is_first = found.1.is_none_or(|(least, n)| (distance, other) < (least, n));
                if distance <= found.0 && is_first && (there - here).dot(normal) < 0.0 {
                    *found = (distance, Some((distance, other)));
                }
            },
        );
        found.1
    };
    (0..corners.len()).map(of).collect()
}

/// Which of two skins each triangle belongs to; `None` of the band. `None` in all if the triangles
/// of skins do not hang together as two parts.
fn sides(mesh: &Mesh, numbers: &[TriangleIndex], behind: &[Behind]) -> Option<Vec<Option<usize>>> {
    let place = |t: TriangleIndex| numbers.binary_search(&t).ok();
    let mut one = DisjointSets::new(numbers.len());
    for (n, &triangle) in numbers.iter().enumerate().filter(|(n, _)| behind[*n].is_some()) {
        for edge in mesh.topology().edges_of(triangle) {
            for other in mesh.edges()[edge].triangles.into_iter().flatten().filter_map(place) {
                if behind[other].is_some() {
                    one.join(n, other);
                }
            }
        }
    }
    let part = one.all_first();
    let mut parts: Vec<usize> =
        (0..numbers.len()).filter(|&n| behind[n].is_some() && part[n] == n).collect();
    parts.sort_unstable();
    let [first, second] = parts[..] else { return None };
    let side = |n: usize| behind[n].is_some().then_some(usize::from(part[n] == second));
    debug_assert!(first < second);
    Some((0..numbers.len()).map(side).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_geometry::index::VertexIndex;
    use sheetwright_geometry::math::{cos, sin};

    /// A closed plate over a grid of `columns` × `rows` cells: its upper skin at `at(i, j, 1)`, its
    /// lower one at `at(i, j, 0)`. `closes`: its last column is its first.
    fn plate(
        columns: usize,
        rows: usize,
        closes: bool,
        at: impl Fn(usize, usize, usize) -> [f64; 3],
    ) -> Mesh {
        let wide = if closes { columns } else { columns + 1 };
        let vertex = |i: usize, j: usize, k: usize| 2 * ((i % wide) * (rows + 1) + j) + k;
        let mut positions = Vec::new();
        for i in 0..wide {
            for j in 0..=rows {
                positions.extend([0, 1].map(|k| at(i, j, k)));
            }
        }
        let mut quads = Vec::new();
        for i in 0..columns {
            for j in 0..rows {
                let ring = |k| {
                    [
                        vertex(i, j, k),
                        vertex(i + 1, j, k),
                        vertex(i + 1, j + 1, k),
                        vertex(i, j + 1, k),
                    ]
                };
                let mut lower = ring(0);
                lower.reverse();
                quads.extend([ring(1), lower]);
            }
            for (j, [a, b]) in [(0, [i, i + 1]), (rows, [i + 1, i])] {
                quads.push([vertex(a, j, 0), vertex(b, j, 0), vertex(b, j, 1), vertex(a, j, 1)]);
            }
        }
        for j in (0..rows).filter(|_| !closes) {
            for (i, [a, b]) in [(0, [j + 1, j]), (columns, [j, j + 1])] {
                quads.push([vertex(i, a, 0), vertex(i, b, 0), vertex(i, b, 1), vertex(i, a, 1)]);
            }
        }
        let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
        let triangles = triangles.map(|t| t.map(VertexIndex::new)).collect();
        let positions = positions.into_iter().map(|[x, y, z]| Point3::new(x, y, z)).collect();
        Mesh::new(positions, triangles).unwrap()
    }

    fn skins(mesh: &Mesh) -> Option<Skins> {
        assert!(mesh.components()[0].is_closed());
        two_skins(mesh, &mesh.components()[0])
    }

    fn area(mesh: &Mesh, of: &[TriangleIndex]) -> f64 {
        of.iter().map(|&t| mesh.area_vector(t).length()).sum()
    }

    #[test]
    fn a_flat_plate_has_two_skins() {
        for cells in [1, 7] {
            let step = 200.0 / cells as f64;
            let flat = plate(cells, cells, false, |i, j, k| {
                [step * i as f64, step * j as f64, 3.0 * k as f64]
            });
            let found = skins(&flat).unwrap();
            assert!((found.thickness_mm - 3.0).abs() < 1e-9);
            assert_eq!(found.triangles.each_ref().map(Vec::len), [2 * cells * cells; 2]);
        }
    }

    #[test]
    fn the_outer_skin_of_a_bent_plate_is_the_larger() {
        for closes in [false, true] {
            let bent = plate(24, 3, closes, |i, j, k| {
                let (turn, radius) =
                    (std::f64::consts::TAU * i as f64 / 24.0, 100.0 + 4.0 * k as f64);
                let share = if closes { 1.0 } else { 0.6 };
                [radius * cos(share * turn), radius * sin(share * turn), 50.0 * j as f64]
            });
            let found = skins(&bent).unwrap();
            assert!((found.thickness_mm - 4.0).abs() < 0.1, "{}", found.thickness_mm);
            let [outer, inner] = found.triangles.each_ref().map(|of| area(&bent, of));
            assert!((outer / inner - 1.04).abs() < 1e-9);
        }
    }

    #[test]
    fn a_folded_bracket_is_a_plate() {
        // Two flanges of 100 mm at a right angle, 3 mm thick, in cells that do not end at the bend.
        let bracket = plate(8, 2, false, |i, j, k| {
            let (along, off) = (25.0 * (i as f64 - 4.0), 3.0 * k as f64);
            let [x, y] = if i < 4 {
                [-along, off]
            } else if i == 4 {
                [off, off]
            } else {
                [off, along]
            };
            [x, y, 60.0 * j as f64]
        });
        let found = skins(&bracket).unwrap();
        assert_eq!(found.triangles.each_ref().map(Vec::len), [32, 32]);
    }

    #[test]
    fn bodies_are_no_plates() {
        let cuboid = |thick: f64| {
            plate(4, 4, false, move |i, j, k| [25.0 * i as f64, 25.0 * j as f64, thick * k as f64])
        };
        assert!(skins(&cuboid(4.0)).is_some());
        assert!(skins(&cuboid(30.0)).is_none());
        // A wedge is not everywhere as thick.
        let wedge = plate(4, 4, false, |i, j, k| {
            [25.0 * i as f64, 25.0 * j as f64, k as f64 * (0.5 + i as f64)]
        });
        assert!(skins(&wedge).is_none());
    }
}
