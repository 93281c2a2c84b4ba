//! The sharp creases of a mesh, to be scored.

use crate::mesh::{Mesh, scored_creases};
use sheetwright_geometry::index::VertexIndex;
use std::collections::BTreeMap;

/// The sharp creases as ways along sides, each as long as can be without branching.
pub(super) fn creases(sheet: &Mesh) -> Vec<Vec<VertexIndex>> {
    let angles = scored_creases(sheet);
    let sharp: Vec<usize> = (0..angles.len()).filter(|&n| angles[n] > 0.0).collect();
    let mut at: BTreeMap<VertexIndex, Vec<usize>> = BTreeMap::new();
    for &n in &sharp {
        sheet.edges()[n].ends.iter().for_each(|&end| at.entry(end).or_default().push(n));
    }
    let goes_on = |v: VertexIndex| at.get(&v).is_some_and(|list| list.len() == 2);
    let mut used = vec![false; angles.len()];
    let mut chains = Vec::new();
    // Those that have ends first; what is left runs in rings.
    for ends_only in [true, false] {
        for &n in &sharp {
            for [start, next] in [sheet.edges()[n].ends, {
                let [a, b] = sheet.edges()[n].ends;
                [b, a]
            }] {
                if used[n] || (ends_only && goes_on(start)) {
                    continue;
                }
                used[n] = true;
                let mut chain = vec![start, next];
                let mut to = next;
                while goes_on(to) {
                    let Some(&n) = at[&to].iter().find(|&&n| !used[n]) else { break };
                    used[n] = true;
                    let [a, b] = sheet.edges()[n].ends;
                    to = if a == to { b } else { a };
                    chain.push(to);
                }
                chains.push(chain);
            }
        }
    }
    chains
}
