//! The sheet of a mesh: cut along some of its sides.

use super::Sheet;
use crate::mesh::{Cut, Mesh, MeshError, separated};
use sheetwright_geometry::index::VertexIndex;
use std::collections::BTreeSet;

/// The sheet of a mesh that is cut along some of its sides. Its seams are the cuts, each between
/// points where cuts end or meet; the sheet may fall into several pieces.
///
/// # Errors
/// See [`MeshError`]; a cut along sides of a valid mesh has none.
pub fn cut_along(mesh: &Mesh, cut: &Cut) -> Result<Sheet, MeshError> {
    cut_along_chains(mesh, cut, &chains(mesh, cut))
}

/// The sheet of a mesh that is cut along lines of vertices, each of which is a seam; no two have a
/// side in common.
///
/// # Errors
/// See [`MeshError`]; a cut along sides of a valid mesh has none.
pub(crate) fn cut_along_lines(mesh: &Mesh, lines: &[&[VertexIndex]]) -> Result<Sheet, MeshError> {
    let chain = |line: &&[VertexIndex]| -> Vec<(usize, bool)> {
        let side = |pair: &[VertexIndex]| {
            let n = mesh.topology().edge_between(pair[0], pair[1])?;
            Some((n, pair[0] < pair[1]))
        };
        line.windows(2).filter_map(side).collect()
    };
    let chains: Vec<Vec<(usize, bool)>> = lines.iter().map(chain).collect();
    let cut = chains.iter().flatten().map(|&(n, _)| n).collect();
    cut_along_chains(mesh, &cut, &chains)
}

/// The sheet of a mesh that is cut along some of its sides, which are those of the chains: each a
/// seam, its sides with whether they are run from their lower ends.
fn cut_along_chains(
    mesh: &Mesh,
    cut: &Cut,
    chains: &[Vec<(usize, bool)>],
) -> Result<Sheet, MeshError> {
    let edges = mesh.edges();
    let is_cut = |ends: [VertexIndex; 2]| {
        mesh.topology().edge_between(ends[0], ends[1]).is_some_and(|n| cut.contains(&n))
    };
    let apart = separated(mesh.triangles(), is_cut);
    let positions = apart.origin.iter().map(|&v| mesh.position(v)).collect();
    let seams: Vec<[Vec<VertexIndex>; 2]> = chains
        .iter()
        .map(|chain| {
            let side = |left: bool| -> Vec<VertexIndex> {
                let mut vertices = Vec::with_capacity(chain.len() + 1);
                for (step, &(n, forward)) in chain.iter().enumerate() {
                    // The first triangle of an edge lies to the left of the way up.
                    let triangle = edges[n].triangles[usize::from(forward != left)];
                    let Some(triangle) = triangle else { continue };
                    let [low, high] = edges[n].ends;
                    let (from, to) = if forward { (low, high) } else { (high, low) };
                    let now = |v: VertexIndex| {
                        let corners = mesh.triangles()[triangle.get()];
                        let k = corners.iter().position(|&c| c == v).unwrap_or(0);
                        apart.triangles[triangle.get()][k]
                    };
                    if step == 0 {
                        vertices.push(now(from));
                    }
                    vertices.push(now(to));
                }
                vertices
            };
            [side(true), side(false)]
        })
        .collect();
    let mesh = Mesh::new(positions, apart.triangles)?;
    Ok(Sheet::new(mesh, apart.origin, seams))
}

/// The cut as ways along sides, each with whether it is run from its lower end, between the points
/// where cuts end, meet, touch the border or come back to where they began.
fn chains(mesh: &Mesh, cut: &Cut) -> Vec<Vec<(usize, bool)>> {
    let edges = mesh.edges();
    let on_border = mesh.topology().on_border();
    let mut at: Vec<Vec<usize>> = vec![Vec::new(); mesh.positions().len()];
    for &n in cut {
        edges[n].ends.iter().for_each(|end| at[end.get()].push(n));
    }
    let is_end = |v: VertexIndex| at[v.get()].len() != 2 || on_border[v.get()];
    let mut used: BTreeSet<usize> = BTreeSet::new();
    let mut chains = Vec::new();
    // Those that have ends first; what is left runs in rings.
    for ends_only in [true, false] {
        for &n in cut {
            for forward in [true, false] {
                let [low, high] = edges[n].ends;
                let (start, mut to) = if forward { (low, high) } else { (high, low) };
                if used.contains(&n) || (ends_only && !is_end(start)) {
                    continue;
                }
                used.insert(n);
                let mut chain = vec![(n, forward)];
                while !is_end(to) && to != start {
                    let Some(&next) = at[to.get()].iter().find(|m| !used.contains(m)) else {
                        break;
                    };
                    used.insert(next);
                    let forward = edges[next].ends[0] == to;
                    to = edges[next].ends[usize::from(forward)];
                    chain.push((next, forward));
                }
                chains.push(chain);
            }
        }
    }
    chains
}
