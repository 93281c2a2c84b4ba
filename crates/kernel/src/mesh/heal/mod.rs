//! Meshes as other programs write them, healed: each kind of damage in a file of its own.
//!
//! Files of meshes come with seams of texture and normals, along which every point is there twice;
//! with points in the middle of their neighbours' sides; with triangles that only fill a line, lie
//! there twice or run the other way round. A surface is there all the same. One after the other,
//!
//! 1. triangles that only fill a line are left out ([`fillers`]),
//! 2. and so are those that lie where another does ([`doubled`]);
//! 3. sides of the border that lie along one another become one ([`joined`]): their points are
//!    joined, and triangles are divided where a point of a neighbour lies on their side;
//! 4. where more than two triangles share a side, the mesh is parted ([`parted`]);
//! 5. triangles and closed components that face the wrong way are turned round ([`turned`]).
//!
//! No vertex moves by more than [`Tolerance::JOINED`] of the size of the mesh, or than the rounding
//! of its file explains, and a mesh that needs none of this stays as it is. What is meant to be
//! apart comes as several meshes, each healed alone. A surface with one side only can't be healed;
//! `Mesh::new` refuses it.

mod doubled;
mod fillers;
mod joined;
mod parted;
mod turned;

use super::rounding::Rounding;
use super::topology::{groups, sorted_sides};
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point3, Vec3};
use sheetwright_geometry::tolerance::{MIN_SIZE_MM, Tolerance};
use std::cmp::Ordering;

/// Rounding of coordinates far from the origin as they are computed, in units of their last place:
/// that of a point and of the two ends of a side that it lies on, in three coordinates.
const ROUNDED_PLACES: f64 = 8.0;

/// What was wrong with a mesh before it was healed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Damage {
    /// Triangles without area that fill a line between others: left out.
    Filler,
    /// Triangles with the corners of another: left out.
    Doubled,
    /// Points that lie where others do, so that triangles do not hang together: joined.
    Seam,
    /// Points that lie on sides of triangles: these are divided there.
    OnSide,
    /// Sides that belong to more than two triangles: parted.
    Branch,
    /// Triangles that run the other way round than their neighbours: turned round.
    Turned,
    /// Closed components that face inwards: turned round.
    InsideOut,
}

/// One kind of damage of a mesh, all of which is healed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Healing {
    /// What was wrong.
    pub damage: Damage,
    /// In how many places.
    pub count: usize,
    /// The first of them, mm.
    pub first: Point3,
}

/// Triangles after healing.
#[derive(Clone, Debug, PartialEq)]
pub struct Healed {
    /// The vertices that are left, mm.
    pub positions: Vec<Point3>,
    /// The triangles that are left.
    pub triangles: Vec<[VertexIndex; 3]>,
    /// What was done, in the order of [`Damage`].
    pub healings: Vec<Healing>,
}

/// A mesh while it is healed. Vertices may be unused.
struct Work {
    positions: Vec<Point3>,
    triangles: Vec<[VertexIndex; 3]>,
    /// The largest distance of points that lie in one place, mm, where triangles are large.
    reach: f64,
    /// The height below which a triangle may be a filler, mm.
    filler: f64,
    /// The height up to which the rounding of the file may have made a filler a triangle, mm.
    rounding: f64,
    healings: Vec<Healing>,
}

impl Work {
    fn at(&self, vertex: VertexIndex) -> Point3 {
        self.positions[vertex.get()]
    }

    fn corners(&self, corners: [VertexIndex; 3]) -> [Point3; 3] {
        corners.map(|v| self.at(v))
    }

    /// Notes what was healed, if something was: in how many places, the first of which is given.
    fn note(&mut self, damage: Damage, count: usize, first: Option<Point3>) {
        let (1.., Some(first)) = (count, first) else { return };
        match self.healings.iter_mut().find(|known| known.damage == damage) {
            Some(known) => known.count += count,
            None => self.healings.push(Healing { damage, count, first }),
        }
    }
}

/// Triangles healed; `None` if they need no healing, if nothing would be left of them, and where
/// they are none at all: a corner is no vertex, a coordinate no number, or all of them are smaller
/// than [`MIN_SIZE_MM`].
pub fn healed(positions: &[Point3], triangles: &[[VertexIndex; 3]]) -> Option<Healed> {
    let size = size_of(positions.iter().copied());
    let is_vertex = |v: &VertexIndex| v.get() < positions.len();
    if !positions.iter().all(|p| p.is_finite())
        || !triangles.iter().flatten().all(is_vertex)
        || size < MIN_SIZE_MM
    {
        return None;
    }
    let farthest = positions.iter().fold(0.0, |most: f64, p| most.max(longest_coordinate(*p)));
    let last_places = ROUNDED_PLACES * f64::EPSILON * farthest;
    let rounding = Rounding::of(positions, size).certain_mm();
    let mut work = Work {
        positions: positions.to_vec(),
        triangles: triangles.to_vec(),
        reach: Tolerance::JOINED.length_mm(size).max(last_places).max(rounding),
        filler: Tolerance::FILLER.length_mm(size).max(last_places),
        rounding,
        healings: Vec::new(),
    };
    let fillers = fillers::leave_out(&mut work);
    doubled::leave_out(&mut work);
    joined::join(&mut work, &fillers);
    let mut sides = sorted_sides(&work.triangles);
    if parted::part(&mut work, &sides) {
        sides = sorted_sides(&work.triangles);
    }
    turned::turn(&mut work, &sides);
    if work.healings.is_empty() || work.triangles.is_empty() {
        return None;
    }
    Some(without_unused(work))
}

fn longest_coordinate(p: Point3) -> f64 {
    p.x.abs().max(p.y.abs()).max(p.z.abs())
}

/// The mesh without vertices that no triangle uses.
fn without_unused(work: Work) -> Healed {
    let Work { positions, mut triangles, healings, .. } = work;
    let mut number: Vec<Option<VertexIndex>> = vec![None; positions.len()];
    for vertex in triangles.iter().flatten() {
        number[vertex.get()] = Some(*vertex);
    }
    let mut kept = Vec::with_capacity(positions.len());
    for (number, at) in number.iter_mut().zip(&positions).filter(|(number, _)| number.is_some()) {
        *number = Some(VertexIndex::new(kept.len()));
        kept.push(*at);
    }
    for vertex in triangles.iter_mut().flatten() {
        *vertex = number[vertex.get()].unwrap_or(*vertex);
    }
    Healed { positions: kept, triangles, healings }
}

/// For every vertex, the first of those with its coordinates.
fn places(positions: &[Point3]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..positions.len()).collect();
    order.sort_unstable_by(|&a, &b| by_place(positions[a], positions[b]).then(a.cmp(&b)));
    let mut place: Vec<usize> = (0..positions.len()).collect();
    for pair in order.windows(2) {
        if by_place(positions[pair[0]], positions[pair[1]]).is_eq() {
            place[pair[1]] = place[pair[0]];
        }
    }
    place
}

/// The order of points by their coordinates, in which 0 is −0.
fn by_place(a: Point3, b: Point3) -> Ordering {
    let order = |a: f64, b: f64| a.partial_cmp(&b).unwrap_or(Ordering::Equal);
    order(a.x, b.x).then(order(a.y, b.y)).then(order(a.z, b.z))
}

/// The middle of some points.
fn middle<const N: usize>(points: [Point3; N]) -> Point3 {
    let first = points[0];
    let ways: Vec3 = points.iter().map(|p| *p - first).sum();
    first + ways / N as f64
}

/// A side of one triangle alone.
#[derive(Clone, Copy)]
struct BorderSide {
    /// Its ends, the lower vertex first.
    ends: [VertexIndex; 2],
    triangle: usize,
    /// The corner of the triangle at which it begins.
    at: usize,
    /// Whether the triangle runs from the lower vertex to the higher.
    upwards: bool,
}

/// The sides of one triangle alone, in the order of their ends.
fn border(triangles: &[[VertexIndex; 3]]) -> Vec<BorderSide> {
    let sides = sorted_sides(triangles);
    let alone = groups(&sides).filter_map(|group| match group {
        [side] => Some(BorderSide {
            ends: side.ends,
            triangle: side.triangle as usize,
            at: side.at.into(),
            upwards: side.upwards,
        }),
        _ => None,
    });
    alone.collect()
}

#[cfg(test)]
mod tests;
