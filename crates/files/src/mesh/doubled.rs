//! Polygons that a file has twice are divided alike.
//!
//! A polygon that begins at another corner, or runs the other way round, may be divided along
//! other diagonals that are as good. Healing finds triangles that lie where others do, but no
//! polygons; so a later polygon with the corners of an earlier one takes the triangles of that.

use sheetwright::math::Point3;
use sheetwright::random::Random;
use std::collections::BTreeMap;
use std::ops::Range;

/// The most polygons that later ones with their key are compared with. Keys differ where polygons
/// do, so that there is more than one in a file alone that was made to be slow.
const MOST_COMPARED: usize = 8;

/// The polygons of a group with four corners or more.
#[derive(Clone, Debug, Default)]
pub(super) struct Polygons {
    /// The corners of all of them, one polygon after the other, by the numbers of the points.
    corners: Vec<usize>,
    each: Vec<Polygon>,
}

#[derive(Clone, Debug)]
struct Polygon {
    /// A number that does not depend on where the polygon begins and which way round it runs.
    key: u64,
    /// Its corners among those of all.
    corners: Range<usize>,
    /// Its triangles in its group.
    triangles: Range<usize>,
}

impl Polygons {
    /// Adds a polygon, whose triangles have these numbers in their group.
    pub(super) fn add(&mut self, points: &[Point3], ring: &[usize], triangles: Range<usize>) {
        if ring.len() < 4 {
            return;
        }
        let first = self.corners.len();
        self.corners.extend_from_slice(ring);
        let corners = first..self.corners.len();
        self.each.push(Polygon { key: key(points, ring), corners, triangles });
    }

    /// Gives each polygon with the corners of an earlier one the triangles of that, which run the
    /// way round that the polygon does.
    pub(super) fn divide_alike(mut self, points: &[Point3], triangles: &mut [[usize; 3]]) {
        self.each.sort_unstable_by_key(|polygon| (polygon.key, polygon.triangles.start));
        for alike in self.each.chunk_by(|a, b| a.key == b.key) {
            let mut firsts: Vec<&Polygon> = Vec::new();
            for polygon in alike {
                let ring = |polygon: &Polygon| &self.corners[polygon.corners.clone()];
                let found = firsts.iter().find_map(|first| {
                    let is_alike = first.triangles.len() == polygon.triangles.len();
                    let partners = partners(points, ring(first), ring(polygon));
                    Some((first, partners.filter(|_| is_alike)?))
                });
                match found {
                    Some((first, partners)) => {
                        for n in 0..first.triangles.len() {
                            let of_first = triangles[first.triangles.start + n];
                            triangles[polygon.triangles.start + n] = partners.triangle(of_first);
                        }
                    }
                    None if firsts.len() < MOST_COMPARED => firsts.push(polygon),
                    None => {}
                }
            }
        }
    }
}

/// The sides of a polygon as one number.
fn key(points: &[Point3], ring: &[usize]) -> u64 {
    let place = |n: usize| {
        let bits = points[n].to_vec().to_array().map(f64::to_bits);
        bits.into_iter().fold(0, |sum, bits| mixed(sum ^ bits))
    };
    let next = ring.iter().cycle().skip(1);
    let sides = ring.iter().zip(next).map(|(&a, &b)| mixed(place(a).wrapping_add(place(b))));
    sides.fold(0, u64::wrapping_add)
}

/// A number all of whose bits depend on all bits of another one.
fn mixed(bits: u64) -> u64 {
    Random::new(bits).bits()
}

/// The corners of a polygon that lie where those of another one do.
struct Partners {
    /// By those of the other one.
    of: BTreeMap<usize, usize>,
    /// Whether it runs the other way round.
    is_turned: bool,
}

impl Partners {
    fn triangle(&self, of_other: [usize; 3]) -> [usize; 3] {
        let [a, b, c] = of_other.map(|corner| self.of.get(&corner).copied().unwrap_or(corner));
        if self.is_turned { [a, c, b] } else { [a, b, c] }
    }
}

/// The corners of the second of two polygons by those of the first; `None` where they are not one
/// and the same polygon.
fn partners(points: &[Point3], first: &[usize], second: &[usize]) -> Option<Partners> {
    let count = second.len();
    if first.len() != count {
        return None;
    }
    let starts = (0..count).flat_map(|start| [(start, false), (start, true)]);
    let pairs = |(start, is_turned): (usize, bool)| {
        let corner = move |n: usize| if is_turned { start + count - n } else { start + n };
        first.iter().enumerate().map(move |(n, &a)| (a, second[corner(n) % count]))
    };
    let mut found = starts.filter(|&way| pairs(way).all(|(a, b)| points[a] == points[b]));
    let way = found.next()?;
    Some(Partners { of: pairs(way).collect(), is_turned: way.1 })
}
