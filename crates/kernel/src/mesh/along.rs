//! The sides of a mesh along ways that are given by points in space.
//!
//! A seam is given by points and not by numbers of vertices, since healing joins vertices and adds
//! some. Each point stands for the vertices nearest to it: several where parts of the mesh meet. A
//! way goes from point to point along the side that joins them, or along the shortest way of sides
//! where none does. Where a point was a vertex of something that was left out, as one of two skins
//! or a speck, the steps to it and from it went with that.

use super::tree::{Extent, Tree};
use super::ways::Ways;
use super::{Cut, Mesh};
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::Point3;
use sheetwright_geometry::watch::Watch;
use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// A point that lies farther from every vertex than this share of the size of the mesh is none of
/// it: a point in another unit, or of another mesh.
const FAR: f64 = 0.01;
/// Vertices whose distances from a point differ by less than this share of the size are as near.
const AS_NEAR: f64 = 1e-9;
/// So many pairs of vertices are compared, places visited and sides passed in the search for
/// shortest ways at the most: half a minute. A search takes as long as the mesh is large.
const MOST_WORK: usize = 500_000_000;
/// Vertices that are kept for a point count as so many pairs, which bounds the memory.
const KEPT: usize = 16;

/// Why a mesh can't be cut along a way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SeamFault {
    /// A point lies far from every vertex.
    Off {
        /// The point, mm.
        at: Point3,
        /// Its distance from the nearest vertex, mm.
        distance_mm: f64,
    },
    /// Two points of a way lie on parts that do not hang together.
    Apart {
        /// The points, mm.
        ends: [Point3; 2],
    },
    /// There are too many steps that are no sides of triangles, or that join places where many
    /// vertices lie.
    TooLong,
}

/// Where the vertices of a mesh lay before parts of it were left out.
#[derive(Clone, Copy)]
pub(crate) struct Before<'a> {
    /// As its maker gave it; what was damaged may have been moved since.
    pub(crate) given: &'a [Point3],
    /// Healed and without specks, but with both skins.
    pub(crate) healed: &'a [Point3],
}

/// The sides along some ways, but for those on the border, where nothing is left to cut; `None` if
/// the watcher asks to stop.
///
/// # Errors
/// See [`SeamFault`].
pub(crate) fn sides_along(
    mesh: &Mesh,
    before: Before<'_>,
    ways: &[Vec<Point3>],
    watch: &dyn Watch,
) -> Result<Option<Cut>, SeamFault> {
    let mut cut = Cut::new();
    if ways.is_empty() {
        return Ok(Some(cut));
    }
    let mut near = Near::of(mesh, before);
    for way in ways {
        let mut vertices = Vec::with_capacity(way.len());
        for &point in way {
            if watch.stop() {
                return Ok(None);
            }
            vertices.push(near.vertices(point)?);
        }
        for (step, ends) in vertices.windows(2).zip(way.windows(2)) {
            let [from, to] = [&step[0], &step[1]];
            near.take(from.len().saturating_mul(to.len()))?;
            let pairs = from.iter().flat_map(|&a| to.iter().map(move |&b| (a, b)));
            let sides: Vec<usize> =
                pairs.filter_map(|(a, b)| mesh.topology().edge_between(a, b)).collect();
            cut.extend(&sides);
            let went = from.is_empty() || to.is_empty();
            if !sides.is_empty() || from == to || went {
                continue;
            }
            if watch.stop() {
                return Ok(None);
            }
            near.take(mesh.edges().len())?;
            let found = Ways::from(mesh, from, |v| to.binary_search(&v).is_ok());
            let end = found.found.ok_or(SeamFault::Apart { ends: [ends[0], ends[1]] })?;
            cut.extend(found.back(mesh.edges(), end));
        }
    }
    cut.retain(|&n| !mesh.edges()[n].is_border());
    Ok(Some(cut))
}

/// A place to the last bit; 0 and −0 are one.
fn bits(p: Point3) -> [u64; 3] {
    [p.x, p.y, p.z].map(|c| (c + 0.0).to_bits())
}

/// Some places, which are made ready once they are asked for.
struct Places<'a> {
    positions: &'a [Point3],
    ready: Option<BTreeSet<[u64; 3]>>,
}

impl<'a> Places<'a> {
    fn of(positions: &'a [Point3]) -> Self {
        Self { positions, ready: None }
    }

    fn have(&mut self, at: Point3) -> bool {
        let all = || self.positions.iter().copied().map(bits).collect();
        self.ready.get_or_insert_with(all).contains(&bits(at))
    }
}

/// The vertices of a mesh by their places.
struct Near<'a> {
    positions: &'a [Point3],
    tree: Tree,
    size_mm: f64,
    kept: Places<'a>,
    healed: Places<'a>,
    given: Places<'a>,
    /// What was found at a place: ways share points, and many vertices may lie at one.
    known: BTreeMap<[u64; 3], Rc<[VertexIndex]>>,
    /// The work that may still be done.
    work: usize,
}

impl<'a> Near<'a> {
    fn of(mesh: &'a Mesh, before: Before<'a>) -> Self {
        let positions = mesh.positions();
        let extents: Vec<Extent> = positions.iter().map(|p| Extent::of([p.to_vec()])).collect();
        let size_mm = size_of(positions.iter().copied());
        let [kept, healed, given] = [positions, before.healed, before.given].map(Places::of);
        let (tree, known) = (Tree::new(&extents), BTreeMap::new());
        Self { positions, tree, size_mm, kept, healed, given, known, work: MOST_WORK }
    }

    /// The vertices nearest to a point, in increasing order; none where what it lay on was left
    /// out.
    fn vertices(&mut self, at: Point3) -> Result<Rc<[VertexIndex]>, SeamFault> {
        if let Some(known) = self.known.get(&bits(at)) {
            return Ok(known.clone());
        }
        // A skin that was left out may lie very near to the one that was kept.
        let found: Rc<[VertexIndex]> = if self.healed.have(at) && !self.kept.have(at) {
            Rc::default()
        } else {
            let (found, visited) = self.found(at);
            self.take(visited)?;
            match found {
                Err(SeamFault::Off { .. }) if self.given.have(at) => Rc::default(),
                found => found?.into(),
            }
        };
        self.take(KEPT * found.len())?;
        self.known.insert(bits(at), found.clone());
        Ok(found)
    }

    fn take(&mut self, work: usize) -> Result<(), SeamFault> {
        self.work = self.work.checked_sub(work).ok_or(SeamFault::TooLong)?;
        Ok(())
    }

    /// The vertices nearest to a point, and how many places were visited to find them.
    fn found(&self, at: Point3) -> (Result<Vec<VertexIndex>, SeamFault>, usize) {
        let visited = Cell::new(0);
        let distance = |n: usize| self.positions[n].distance(at);
        let away = |extent: &Extent| {
            visited.set(visited.get() + 1);
            extent.distance(at.to_vec())
        };
        let mut least = f64::INFINITY;
        let is_near = |least: &f64, extent: &Extent| away(extent) <= *least;
        self.tree.visit(&mut least, is_near, |least, n| *least = least.min(distance(n)));
        // Also where the distance is no number.
        if least.is_nan() || least > FAR * self.size_mm {
            return (Err(SeamFault::Off { at, distance_mm: least }), visited.get());
        }
        let reach = least + AS_NEAR * self.size_mm;
        let mut found = Vec::new();
        let is_near = |_: &Vec<usize>, extent: &Extent| away(extent) <= reach;
        self.tree.visit(&mut found, is_near, |found, n| {
            if distance(n) <= reach {
                found.push(n);
            }
        });
        found.sort_unstable();
        (Ok(found.into_iter().map(VertexIndex::new).collect()), visited.get())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_geometry::watch::Unwatched;

    fn before(positions: &[Point3]) -> Before<'_> {
        Before { given: positions, healed: positions }
    }

    fn along(mesh: &Mesh, ways: &[Vec<Point3>]) -> Result<Cut, SeamFault> {
        sides_along(mesh, before(mesh.positions()), ways, &Unwatched).map(Option::unwrap)
    }

    /// A square of four by four fields, 10 mm each.
    fn square() -> Mesh {
        let at = |n: usize| Point3::new(10.0 * (n % 5) as f64, 10.0 * (n / 5) as f64, 0.0);
        let field = |n: usize| {
            let low = n / 4 * 5 + n % 4;
            [[low, low + 1, low + 6], [low, low + 6, low + 5]]
        };
        let triangles = (0..16).flat_map(field).map(|t| t.map(VertexIndex::new)).collect();
        Mesh::new((0..25).map(at).collect(), triangles).unwrap()
    }

    #[test]
    fn a_way_goes_along_sides_from_point_to_point() {
        let mesh = square();
        let ends = |cut: &Cut| -> Vec<[usize; 2]> {
            cut.iter().map(|&n| mesh.edges()[n].ends.map(|v| v.get())).collect()
        };
        let at = |x: f64, y: f64| Point3::new(x, y, 0.0);
        // Three sides, of which the first lies on the border, where nothing is cut; points need
        // not be exact.
        let way = vec![at(10.0, 0.0), at(20.0, 0.0), at(20.0, 20.1)];
        let cut = along(&mesh, &[way]).unwrap();
        assert_eq!(ends(&cut), [[2, 7], [7, 12]]);
        assert_eq!(along(&mesh, &[]), Ok(Cut::new()));
    }

    #[test]
    fn a_point_off_the_mesh_is_refused() {
        let (mesh, off) = (square(), Point3::new(20.0, 20.0, 5.0));
        let fault = along(&mesh, &[vec![Point3::new(20.0, 10.0, 0.0), off]]);
        assert_eq!(fault, Err(SeamFault::Off { at: off, distance_mm: 5.0 }));
        let nowhere = Point3::new(f64::NAN, 0.0, 0.0);
        assert!(along(&mesh, &[vec![nowhere]]).is_err());
    }

    #[test]
    fn steps_on_what_was_left_out_are_passed_over() {
        let (mesh, at) = (square(), |x: f64, y: f64, z: f64| Point3::new(x, y, z));
        // A point of a part that is not there any more, far off or near, and the way without it.
        for gone in [at(20.0, 20.0, 5.0), at(20.0, 20.0, 0.01)] {
            let came: Vec<Point3> = mesh.positions().iter().copied().chain([gone]).collect();
            let way = vec![at(20.0, 10.0, 0.0), at(20.0, 20.0, 0.0), gone, at(20.0, 30.0, 0.0)];
            let found =
                sides_along(&mesh, before(&came), std::slice::from_ref(&way), &Unwatched).unwrap();
            assert_eq!(found, along(&mesh, &[way[..2].to_vec()]).ok());
            assert_eq!(found.unwrap().len(), 1);
        }
    }

    #[test]
    fn seams_that_take_too_long_are_refused_and_can_be_stopped() {
        struct Stopped;
        impl Watch for Stopped {
            fn stop(&self) -> bool {
                true
            }
        }
        let at = |x: f64, y: f64| Point3::new(x, y, 0.0);
        let across = [vec![at(10.0, 10.0), at(30.0, 20.0)]];
        let mesh = square();
        assert_eq!(sides_along(&mesh, before(mesh.positions()), &across, &Stopped), Ok(None));
        // Triangles at one place, as many as fill the work with one step.
        let fan = |n: usize| [at(0.0, 0.0), at(10.0, 0.0), at(0.0, 10.0 + n as f64)];
        let count = 23_000;
        let numbers = (0..count).map(|n| [3 * n, 3 * n + 1, 3 * n + 2].map(VertexIndex::new));
        let mesh = Mesh::new((0..count).flat_map(fan).collect(), numbers.collect()).unwrap();
        let way = vec![at(0.0, 0.0), at(10.0, 0.0)];
        assert_eq!(along(&mesh, &[way]), Err(SeamFault::TooLong));
    }
}
