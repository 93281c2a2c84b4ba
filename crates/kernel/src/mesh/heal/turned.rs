//! Triangles and closed components that face the wrong way.
//!
//! Of neighbours that run different ways round, the fewer are turned, as in `Mesh::new`; a closed
//! component then faces outwards if its volume is positive. The inner wall of a hollow body faces
//! inwards as it should: a component within the box of the largest closed one is left alone.

use super::{Damage, Work, middle};
use crate::mesh::topology::{HalfEdge, facing, neighbours};
use crate::mesh::tree::Extent;
use sheetwright_geometry::math::Vec3;

/// A volume below this share of the cube of a component's size is rounding: what is as flat has no
/// outside.
const FLAT: f64 = 1e-9;

/// A component of the mesh.
struct Shell {
    triangles: Vec<usize>,
    is_closed: bool,
    /// mm³; negative if it faces inwards.
    volume: f64,
    extent: Extent,
}

/// Turns what faces the wrong way. All sides of the mesh are given.
pub(super) fn turn(work: &mut Work, sides: &[HalfEdge]) {
    let Ok(neighbours) = neighbours(sides, work.triangles.len()) else { return };
    // A surface with one side only stays as it is.
    let Ok((component_of, turned)) = facing(&work.triangles, &neighbours) else { return };
    let mut first = None;
    for n in (0..turned.len()).filter(|&n| turned[n]) {
        work.triangles[n].swap(1, 2);
        first.get_or_insert(n);
    }
    let place = first.map(|n| middle(work.corners(work.triangles[n])));
    work.note(Damage::Turned, turned.iter().filter(|turned| **turned).count(), place);
    let count = component_of.iter().max().map_or(0, |most| most + 1);
    let mut of: Vec<Vec<usize>> = vec![Vec::new(); count];
    let mut is_open = vec![false; count];
    for (n, &component) in component_of.iter().enumerate() {
        of[component].push(n);
        is_open[component] |= neighbours[n].iter().any(Option::is_none);
    }
    let shells = of.into_iter().zip(is_open).map(|(triangles, is_open)| Shell {
        is_closed: !is_open,
        volume: if is_open { 0.0 } else { volume(work, &triangles) },
        extent: Extent::of(
            triangles.iter().flat_map(|&n| work.triangles[n]).map(|v| work.at(v).to_vec()),
        ),
        triangles,
    });
    let shells: Vec<Shell> = shells.collect();
    let size = |shell: &Shell| (shell.extent.1 - shell.extent.0).length();
    let closed = || shells.iter().enumerate().filter(|(_, shell)| shell.is_closed);
    let largest = closed().reduce(|a, b| if size(b.1) > size(a.1) { b } else { a });
    let is_inner = |(n, shell): &(usize, &Shell)| {
        let Some((outer, largest)) = largest else { return false };
        let (a, b) = (&shell.extent, &largest.extent);
        outer != *n && a.0.cmpgt(b.0).all() && a.1.cmplt(b.1).all()
    };
    let is_inwards = |(_, shell): &(usize, &Shell)| {
        let size = size(shell);
        shell.volume < -FLAT * size * size * size
    };
    let inwards: Vec<&Shell> =
        closed().filter(|shell| is_inwards(shell) && !is_inner(shell)).map(|(_, s)| s).collect();
    for &n in inwards.iter().flat_map(|shell| &shell.triangles) {
        work.triangles[n].swap(1, 2);
    }
    let first = inwards.first().and_then(|shell| shell.triangles.first());
    let place = first.map(|&n| middle(work.corners(work.triangles[n])));
    work.note(Damage::InsideOut, inwards.len(), place);
}

/// The volume within some triangles that are closed, mm³: negative if they face inwards.
fn volume(work: &Work, triangles: &[usize]) -> f64 {
    let Some(&first) = triangles.first() else { return 0.0 };
    // Near to the mesh, so that products keep their digits.
    let from = work.at(work.triangles[first][0]);
    let tetrahedron = |n: &usize| {
        let [a, b, c]: [Vec3; 3] = work.corners(work.triangles[*n]).map(|p| p - from);
        a.dot(b.cross(c)) / 6.0
    };
    triangles.iter().map(tetrahedron).sum()
}
