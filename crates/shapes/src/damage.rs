//! Meshes, and the ways in which other programs damage them: for tests of healing.

use crate::meshes::grid_mesh;
use crate::random::Random;
use sheetwright::index::{TriangleIndex, VertexIndex};
use sheetwright::math::{Point3, Vec3, cos, sin, unit};
use sheetwright::mesh::Mesh;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Triangles over points, with what is wrong with them.
pub type Soup = (Vec<Point3>, Vec<[VertexIndex; 3]>);

/// A kind of damage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Points are there twice along seams, as where textures or normals differ.
    Seams,
    /// And their last digits differ.
    SeamsInDigits,
    /// Triangles are divided at points on their sides, and their neighbours are not.
    OnSides,
    /// Triangles without area fill the line beside such points.
    Fillers,
    /// Triangles are there twice, some the other way round.
    Doubled,
    /// Less than half of the triangles run the other way round.
    Turned,
    /// All triangles run the other way round.
    InsideOut,
    /// Triangles stand like ribs on sides that have two already.
    Ribs,
    /// The mesh lies far from the origin.
    Far,
    /// Several of these at once.
    Several,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 10] = [
        Self::Seams,
        Self::SeamsInDigits,
        Self::OnSides,
        Self::Fillers,
        Self::Doubled,
        Self::Turned,
        Self::InsideOut,
        Self::Ribs,
        Self::Far,
        Self::Several,
    ];
}

/// Where [`Kind::Far`] puts a mesh, mm: as far as a place in coordinates of UTM.
pub const FAR: Vec3 = Vec3::new(4.5e8, 5.4e9, 2e5);

/// A random sheet: part of a cylinder of random radius, in random cells, which unrolls exactly.
pub fn open(random: &mut Random) -> Mesh {
    let (columns, rows) = (3 + random.below(5), 2 + random.below(4));
    let radius = random.between(50.0, 400.0);
    let angle = random.between(0.2, 3.0) / columns as f64;
    let height = random.between(20.0, 300.0);
    let shift: Vec<f64> = (0..=columns * (rows + 1)).map(|_| random.between(-0.3, 0.3)).collect();
    grid_mesh(columns, rows, |i, j| {
        let turn = angle * i as f64;
        let z = height * (j as f64 + shift[i * rows + j]);
        Point3::new(radius * cos(turn), radius * sin(turn), z)
    })
}

/// A random closed prism with 3 to 5 sides, cut off askew at the top, each of random cells; its
/// ends are fans. No two of its edges are as long, so that the shortest cuts through its corners
/// are known, and cut open it lies flat exactly.
pub fn closed(random: &mut Random) -> Mesh {
    let (sides, rows) = (3 + random.below(3), 1 + random.below(3));
    let (radius, height) = (random.between(20.0, 200.0), random.between(20.0, 300.0));
    let turns: Vec<f64> = (0..sides)
        .map(|side| TAU * (side as f64 + random.between(-0.2, 0.2)) / sides as f64)
        .collect();
    let levels: Vec<f64> = (0..=rows)
        .map(|row| height * (row as f64 + random.between(-0.3, 0.3)) / rows as f64)
        .collect();
    let mut positions = Vec::new();
    let slope = random.between(0.05, 0.3) * height / radius;
    for (row, &z) in levels.iter().enumerate() {
        let askew = slope * row as f64 / rows as f64;
        let corner = |&turn: &f64| {
            let (x, y) = (radius * cos(turn), radius * sin(turn));
            Point3::new(x, y, z + askew * (x + 0.4 * y))
        };
        positions.extend(turns.iter().map(corner));
    }
    positions.extend([levels[0], levels[rows]].map(|z| Point3::new(0.0, 0.0, z)));
    let mut triangles = Vec::new();
    let at = |row: usize, side: usize| row * sides + side % sides;
    for side in 0..sides {
        let (low, high) = (positions.len() - 2, positions.len() - 1);
        triangles.push([low, at(0, side + 1), at(0, side)]);
        triangles.push([high, at(rows, side), at(rows, side + 1)]);
        for row in 0..rows {
            let [a, b] = [at(row, side), at(row, side + 1)];
            let [c, d] = [at(row + 1, side), at(row + 1, side + 1)];
            triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    let triangles = triangles.into_iter().map(|t| t.map(VertexIndex::new)).collect();
    Mesh::new(positions, triangles).expect("a prism is a mesh")
}

/// A mesh with damage of a kind in random places, one at least.
pub fn damaged(kind: Kind, mesh: &Mesh, random: &mut Random) -> Soup {
    let soup = (mesh.positions().to_vec(), mesh.triangles().to_vec());
    match kind {
        Kind::Seams => seams(soup, 0.0, random),
        Kind::SeamsInDigits => seams(soup, 3e-7, random),
        Kind::OnSides => on_sides(mesh, false, random),
        Kind::Fillers => on_sides(mesh, true, random),
        Kind::Doubled => doubled(soup, random),
        Kind::Turned => turned(mesh, random),
        Kind::InsideOut => inside_out(soup),
        Kind::Ribs => ribs(mesh, soup, random),
        Kind::Far => (soup.0.into_iter().map(|p| p + FAR).collect(), soup.1),
        Kind::Several => {
            let filled = random.unit() < 0.5;
            let soup = on_sides(mesh, filled, random);
            seams(doubled(soup, random), 0.0, random)
        }
    }
}

/// Gives the triangles of each of some random regions points of their own, off by up to `digits`
/// times the size of 300 mm.
fn seams((positions, triangles): Soup, digits: f64, random: &mut Random) -> Soup {
    let regions = 2 + random.below(4);
    let mut found: BTreeMap<(VertexIndex, usize), VertexIndex> = BTreeMap::new();
    let mut points = Vec::new();
    let mut apart = Vec::with_capacity(triangles.len());
    for (n, corners) in triangles.iter().enumerate() {
        // The first two triangles lie in two regions, whatever is drawn.
        let region = if n < 2 { n } else { random.below(regions) };
        apart.push(corners.map(|v| {
            *found.entry((v, region)).or_insert_with(|| {
                let off = [0; 3].map(|_| random.between(-300.0, 300.0) * digits);
                points.push(positions[v.get()] + Vec3::from_array(off));
                VertexIndex::new(points.len() - 1)
            })
        }));
    }
    (points, apart)
}

/// Divides one of the two triangles at each of some inner sides, at a point on it; `filled` by a
/// triangle without area.
fn on_sides(mesh: &Mesh, filled: bool, random: &mut Random) -> Soup {
    let (mut positions, mut triangles) = (mesh.positions().to_vec(), mesh.triangles().to_vec());
    let mut is_divided = vec![false; triangles.len()];
    let mut done = 0;
    for edge in mesh.edges() {
        let [Some(a), Some(b)] = edge.triangles else { continue };
        if is_divided[a.get()] || is_divided[b.get()] || (done > 0 && random.unit() < 0.6) {
            continue;
        }
        done += 1;
        let [from, to] = edge.ends;
        let on = VertexIndex::new(positions.len());
        let share = random.between(0.2, 0.8);
        positions.push(mesh.position(from).lerp(mesh.position(to), share));
        let corners = mesh.triangles()[a.get()];
        let across = corners.into_iter().find(|&v| v != from && v != to).expect("a third corner");
        // The first of the two triangles runs from the lower end to the higher.
        triangles[a.get()] = [from, on, across];
        triangles.push([on, to, across]);
        if filled {
            triangles.push([from, to, on]);
        }
        is_divided[a.get()] = true;
        is_divided[b.get()] = true;
    }
    (positions, triangles)
}

/// Copies some triangles, some of them the other way round, some with points of their own.
fn doubled((mut positions, mut triangles): Soup, random: &mut Random) -> Soup {
    for _ in 0..=random.below(4) {
        let mut copy = triangles[random.below(triangles.len())];
        if random.unit() < 0.5 {
            copy.swap(0, 1);
        }
        if random.unit() < 0.5 {
            copy = copy.map(|v| {
                positions.push(positions[v.get()]);
                VertexIndex::new(positions.len() - 1)
            });
        }
        triangles.push(copy);
    }
    (positions, triangles)
}

fn turned(mesh: &Mesh, random: &mut Random) -> Soup {
    let mut triangles = mesh.triangles().to_vec();
    // The first one stays as it is: it decides where as many run each way.
    let most = (triangles.len() - 1) / 2;
    for _ in 0..most.min(1 + random.below(4)) {
        let n = 1 + random.below(triangles.len() - 1);
        triangles[n] = mesh.triangles()[n];
        triangles[n].swap(0, 2);
    }
    (mesh.positions().to_vec(), triangles)
}

fn inside_out((positions, mut triangles): Soup) -> Soup {
    triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
    (positions, triangles)
}

/// Stands triangles on some inner sides, between the two that are there.
fn ribs(mesh: &Mesh, (mut positions, mut triangles): Soup, random: &mut Random) -> Soup {
    let mut done = 0;
    for edge in mesh.edges() {
        let [Some(a), Some(b)] = edge.triangles else { continue };
        if done == 2 || (done > 0 && random.unit() < 0.8) {
            continue;
        }
        let normal = |t: TriangleIndex| unit(mesh.area_vector(t)).unwrap_or(Vec3::X);
        let Some(out) = unit(normal(a) + normal(b)) else { continue };
        let [from, to] = edge.ends.map(|v| mesh.position(v));
        let apex = from.lerp(to, 0.5) + out * from.distance(to);
        let top = VertexIndex::new(positions.len());
        positions.push(apex);
        triangles.push([edge.ends[0], edge.ends[1], top]);
        done += 1;
    }
    (positions, triangles)
}
