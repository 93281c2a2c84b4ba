//! Triangle meshes with interior vertices: developable ones, whose lengths can all be kept, and
//! others.

use crate::random::Random;
use sheetwright::index::VertexIndex;
use sheetwright::math::{Point3, cos, sin};
use sheetwright::mesh::Mesh;

/// The mesh of a grid of `columns` × `rows` vertices, two triangles a cell. Where a row or a column
/// is `None` at a cell's corner, the cell is left out.
pub fn grid(
    columns: usize,
    rows: usize,
    at: impl Fn(usize, usize) -> Option<Point3>,
) -> (Vec<Point3>, Vec<[VertexIndex; 3]>) {
    let mut numbers = vec![None; columns * rows];
    let mut positions = Vec::new();
    for i in 0..columns {
        for j in 0..rows {
            if let Some(point) = at(i, j) {
                numbers[i * rows + j] = Some(VertexIndex::new(positions.len()));
                positions.push(point);
            }
        }
    }
    let mut triangles = Vec::new();
    for i in 0..columns - 1 {
        for j in 0..rows - 1 {
            let corner = |i: usize, j: usize| numbers[i * rows + j];
            let corners = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            let [Some(a), Some(b), Some(c), Some(d)] = corners else { continue };
            // Cells are cut along either diagonal in turn.
            if (i + j) % 2 == 0 {
                triangles.extend([[a, b, c], [a, c, d]]);
            } else {
                triangles.extend([[a, b, d], [b, c, d]]);
            }
        }
    }
    (positions, triangles)
}

/// The mesh of such a grid, all of whose vertices are there.
pub fn grid_mesh(columns: usize, rows: usize, at: impl Fn(usize, usize) -> Point3) -> Mesh {
    let (positions, triangles) = grid(columns, rows, |i, j| Some(at(i, j)));
    Mesh::new(positions, triangles).expect("a grid is a mesh")
}

/// Part of a cylinder of this radius, mm, over `angle` radians, `cells` × `cells`: vertices lie at
/// random places along its rulings, so that cells are flat and the whole unrolls exactly.
pub fn cylinder(radius: f64, angle: f64, height: f64, cells: usize, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let shifts: Vec<f64> =
        (0..(cells + 1) * (cells + 1)).map(|_| random.between(-0.4, 0.4)).collect();
    grid_mesh(cells + 1, cells + 1, |i, j| {
        let turn = angle * i as f64 / cells as f64;
        let z = height * (j as f64 + shifts[i * (cells + 1) + j]) / cells as f64;
        Point3::new(radius * cos(turn), radius * sin(turn), z)
    })
}

/// Part of a cone with its apex at the origin, whose rulings rise by half their length: from
/// `inner` to `outer` mm along them, over `angle` radians round its axis, which may be several
/// times round. Vertices lie on rulings, so it unrolls exactly, into a sector of nearly cos 30° of
/// the angle.
pub fn cone(inner: f64, outer: f64, angle: f64, around: usize, along: usize) -> Mesh {
    let level = 0.75f64.sqrt();
    grid_mesh(along + 1, around + 1, |i, j| {
        let turn = angle * j as f64 / around as f64;
        let r = inner + (outer - inner) * i as f64 / along as f64;
        Point3::new(r * level * cos(turn), r * level * sin(turn), 0.5 * r)
    })
}

/// Part of a sphere of radius 1, mm: from the pole to `angle` radians, in `rings` rings of `sides`
/// sides.
pub fn cap(angle: f64, rings: usize, sides: usize) -> Mesh {
    let mut positions = vec![Point3::new(0.0, 0.0, 1.0)];
    for ring in 1..=rings {
        let down = angle * ring as f64 / rings as f64;
        for side in 0..sides {
            // Every other ring is turned by half a side.
            let turn =
                std::f64::consts::TAU * (side as f64 + 0.5 * (ring % 2) as f64) / sides as f64;
            positions.push(Point3::new(sin(down) * cos(turn), sin(down) * sin(turn), cos(down)));
        }
    }
    let at = |ring: usize, side: usize| match ring {
        0 => VertexIndex::new(0),
        _ => VertexIndex::new(1 + (ring - 1) * sides + side % sides),
    };
    let mut triangles = Vec::new();
    for side in 0..sides {
        triangles.push([at(0, 0), at(1, side), at(1, side + 1)]);
        for ring in 1..rings {
            // The further ring's vertex of this number lies half a side on, or back.
            let on = (ring + 1) % 2;
            let [a, b] = [at(ring, side), at(ring, side + 1)];
            let [c, d] = [at(ring + 1, side), at(ring + 1, side + 1)];
            if on == 1 {
                triangles.extend([[a, c, b], [b, c, d]]);
            } else {
                triangles.extend([[a, c, d], [a, d, b]]);
            }
        }
    }
    Mesh::new(positions, triangles).expect("a cap is a mesh")
}

/// A square of 2 × 2 mm with gentle bumps of 0.02 mm and vertices shifted at random, `cells` ×
/// `cells`: nearly developable, as measured surfaces are.
pub fn bumpy(cells: usize) -> Mesh {
    let mut random = Random::new(20);
    let step = 2.0 / cells as f64;
    let shifts: Vec<[f64; 2]> = (0..(cells + 1) * (cells + 1))
        .map(|_| [random.between(-0.3, 0.3), random.between(-0.3, 0.3)])
        .collect();
    grid_mesh(cells + 1, cells + 1, |i, j| {
        let shift = shifts[i * (cells + 1) + j];
        let (x, y) = (step * (i as f64 + shift[0]) - 1.0, step * (j as f64 + shift[1]) - 1.0);
        // Bent round a cylinder, with the bumps along its normal.
        let radius = 1.0 + 0.02 * sin(5.0 * x) * sin(4.0 * y);
        Point3::new(radius * sin(x), y, radius * cos(x))
    })
}

/// A closed mesh about the origin: the six sides of a cube of `cells` × `cells` blown up to the
/// distance that `radius` tells for a unit direction, mm; it is asked once a vertex.
pub fn ball(cells: usize, mut radius: impl FnMut(Point3) -> f64) -> Mesh {
    let mut numbers = std::collections::BTreeMap::new();
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    let side = |n: usize| {
        let share = 2.0 * n as f64 / cells as f64 - 1.0;
        let angle = std::f64::consts::FRAC_PI_4 * share;
        sin(angle) / cos(angle)
    };
    for (axis, far) in (0..6).map(|n| (n / 2, n % 2)) {
        let mut vertex = |i: usize, j: usize| {
            let mut at = [0; 3];
            (at[axis], at[(axis + 1) % 3], at[(axis + 2) % 3]) = (far * cells, i, j);
            *numbers.entry(at).or_insert_with(|| {
                let way = at.map(side);
                let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
                let [x, y, z] = way.map(|x| x / length);
                let way = Point3::new(x, y, z);
                positions.push(Point3::from_vec(way.to_vec() * radius(way)));
                VertexIndex::new(positions.len() - 1)
            })
        };
        for i in 0..cells {
            for j in 0..cells {
                let [a, b] = [vertex(i, j), vertex(i + 1, j)];
                let [c, d] = [vertex(i + 1, j + 1), vertex(i, j + 1)];
                let halves =
                    if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
                let outwards =
                    |[a, b, c]: [VertexIndex; 3]| if far == 1 { [a, b, c] } else { [a, c, b] };
                triangles.extend(halves.map(outwards));
            }
        }
    }
    Mesh::new(positions, triangles).expect("a ball is a mesh")
}

/// A ball of 100 mm with bumps of 5 mm, as rough as a scan: each vertex is off by up to `rough`
/// mm. It has 12 `cells`² triangles.
pub fn bumpy_ball(cells: usize, rough: f64) -> Mesh {
    let mut random = Random::new(7);
    ball(cells, |p| {
        let bumps = sin(5.0 * p.x + 1.0) * sin(4.0 * p.y) * cos(3.0 * p.z + 0.5);
        100.0 + 5.0 * bumps + random.between(-rough, rough)
    })
}
