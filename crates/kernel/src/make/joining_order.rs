//! The order in which the parts of a design are joined.
//!
//! The first part is the one that is joined along the greatest length. Each next one is the part
//! that is joined to what stands along the greatest length, so that every part has much to lie
//! against. Parts that nothing joins to what stands begin anew, so the components of a design come
//! one after the other. The joints of a part that was divided count as longer than all others: a
//! plank is scarfed before it is hung. This is a maximum adjacency order: of the last two parts of
//! a component, no way of dividing the component between them cuts less length than taking the last
//! one off (\[SW97\]), which the tests compare with all ways of dividing.
//!
//! Lengths are counted in whole micrometres, so that lengths which differ by rounding alone are
//! equal; where both sides of a seam differ, the shorter counts. Of equal parts, the first in the
//! design comes first.

use super::{Made, Part};
use crate::edge::{Edge, EdgePlace, EdgeSource};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

/// Micrometres in a millimetre.
const UM: f64 = 1e3;
/// By how much longer the joint of a part that was divided counts, micrometres: longer than all
/// edges of a design, which reach 100 km at the most.
const DIVISION_UM: u64 = 1_000_000_000_000_000;

/// One part that is joined to those that stand already.
#[derive(Clone, Debug, PartialEq)]
pub struct JoiningStep {
    /// The part, by its number in the design.
    pub part: usize,
    /// What its own edges are joined to: one another first, then edges of what stands.
    pub joins: Vec<Join>,
    /// Whether it is joined to nothing that stands, and begins a component.
    pub begins: bool,
}

/// Two edges that are joined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Join {
    /// The number of the edge of the part that is added.
    pub edge: usize,
    /// The edge that it is joined to.
    pub to: EdgePlace,
    /// How long both are on the pattern along what they share, mm, in this order.
    pub shared_mm: [f64; 2],
}

impl Made {
    /// The order in which its parts are joined: each part once.
    pub fn joining_order(&self) -> Vec<JoiningStep> {
        let joined = |part: &Part| {
            let of_edge = |edge: &'_ Edge| -> Vec<(usize, u64)> {
                let is_division = matches!(edge.source, EdgeSource::Division { .. });
                let more = if is_division { DIVISION_UM } else { 0 };
                let mates = edge.mates.iter().zip(&edge.shared_mm);
                mates
                    .map(|(mate, shared)| (mate.part, more + whole_um(shared[0].min(shared[1]))))
                    .collect()
            };
            part.edges.iter().flat_map(of_edge).collect()
        };
        let graph: Vec<BTreeMap<usize, u64>> =
            self.parts.iter().map(|part| summed(joined(part))).collect();
        let mut stands = vec![false; self.parts.len()];
        let mut steps = Vec::with_capacity(self.parts.len());
        for (part, begins) in adjacency_order(&graph) {
            steps.push(JoiningStep { part, joins: joins(self, part, &stands), begins });
            stands[part] = true;
        }
        steps
    }
}

/// What the edges of a part are joined to among themselves, and then among what stands.
fn joins(made: &Made, part: usize, stands: &[bool]) -> Vec<Join> {
    let mut own = Vec::new();
    let mut others = Vec::new();
    for (number, edge) in made.parts[part].edges.iter().enumerate() {
        for (&to, &shared_mm) in edge.mates.iter().zip(&edge.shared_mm) {
            let join = Join { edge: number, to, shared_mm };
            if to.part == part {
                if number < to.edge {
                    own.push(join);
                }
            } else if stands[to.part] {
                others.push(join);
            }
        }
    }
    own.extend(others);
    own
}

fn whole_um(mm: f64) -> u64 {
    (mm * UM).round() as u64
}

/// The lengths to each part together.
fn summed(joined: Vec<(usize, u64)>) -> BTreeMap<usize, u64> {
    let mut sums = BTreeMap::new();
    for (part, length) in joined {
        *sums.entry(part).or_insert(0) += length;
    }
    sums
}

/// Each vertex of a graph once, and whether it begins a component: first the one whose edges weigh
/// most, then always the one whose edges to those before it weigh most; of equals the first. The
/// graph has the weights of the edges of each vertex by their other ends.
fn adjacency_order(graph: &[BTreeMap<usize, u64>]) -> Vec<(usize, bool)> {
    let whole = |n: usize| -> u64 {
        graph[n].iter().filter(|(other, _)| **other != n).map(|(_, weight)| weight).sum()
    };
    let whole: Vec<u64> = (0..graph.len()).map(whole).collect();
    let mut left: BTreeSet<(Reverse<u64>, usize)> =
        whole.iter().enumerate().map(|(n, &weight)| (Reverse(weight), n)).collect();
    // Of those that are joined to what stands: by how much.
    let mut reached: BTreeMap<usize, u64> = BTreeMap::new();
    let mut next: BTreeSet<(Reverse<u64>, usize)> = BTreeSet::new();
    let mut order = Vec::with_capacity(graph.len());
    while let Some(&first) = left.first() {
        let (begins, vertex) = match next.pop_first() {
            Some((_, vertex)) => (false, vertex),
            None => (true, first.1),
        };
        left.remove(&(Reverse(whole[vertex]), vertex));
        reached.remove(&vertex);
        order.push((vertex, begins));
        for (&other, &weight) in &graph[vertex] {
            if !left.contains(&(Reverse(whole[other]), other)) {
                continue;
            }
            let before = reached.get(&other).copied();
            if let Some(before) = before {
                next.remove(&(Reverse(before), other));
            }
            let now = before.unwrap_or(0) + weight;
            reached.insert(other, now);
            next.insert((Reverse(now), other));
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    type Graph = Vec<BTreeMap<usize, u64>>;

    fn graph(count: usize, edges: &[(usize, usize, u64)]) -> Graph {
        let mut graph = vec![BTreeMap::new(); count];
        for &(a, b, weight) in edges {
            *graph[a].entry(b).or_insert(0) += weight;
            if a != b {
                *graph[b].entry(a).or_insert(0) += weight;
            }
        }
        graph
    }

    /// A graph of up to eight vertices from a number: some pairs are joined, with small weights.
    fn random(seed: u64) -> Graph {
        let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
        let mut random = |below: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(seed | 1);
            (state >> 33) % below
        };
        let count = 1 + random(8) as usize;
        let mut edges = Vec::new();
        for a in 0..count {
            for b in 0..=a {
                if random(3) == 0 {
                    edges.push((a, b, 1 + random(4)));
                }
            }
        }
        graph(count, &edges)
    }

    fn between(graph: &Graph, vertex: usize, others: &[usize]) -> u64 {
        let is_other = |n: &usize| *n != vertex && others.contains(n);
        graph[vertex].iter().filter(|(n, _)| is_other(n)).map(|(_, weight)| weight).sum()
    }

    /// The vertices of one component, found without the order.
    fn component(graph: &Graph, from: usize) -> BTreeSet<usize> {
        let (mut found, mut open) = (BTreeSet::from([from]), vec![from]);
        while let Some(vertex) = open.pop() {
            open.extend(graph[vertex].keys().filter(|&&n| found.insert(n)));
        }
        found
    }

    /// The least weight that must be cut to part two vertices of a component: all ways are tried.
    fn least_cut(graph: &Graph, vertices: &[usize], [s, t]: [usize; 2]) -> u64 {
        let ways = (0_u32..1 << vertices.len()).map(|way| {
            let side = |n: usize| way >> n & 1 == 1;
            let of = |v: usize| vertices.iter().position(|&n| n == v).map(side);
            let parts = of(s) == Some(true) && of(t) == Some(false);
            let across = vertices.iter().enumerate().filter(|(n, _)| side(*n)).map(|(_, &v)| {
                let others: Vec<usize> =
                    (0..vertices.len()).filter(|&n| !side(n)).map(|n| vertices[n]).collect();
                between(graph, v, &others)
            });
            if parts { across.sum() } else { u64::MAX }
        });
        ways.min().unwrap_or(u64::MAX)
    }

    #[test]
    fn each_next_one_is_joined_most_and_components_follow_one_another() {
        let mut compared = 0;
        for seed in 0..400 {
            let graph = random(seed);
            let order = adjacency_order(&graph);
            let vertices: Vec<usize> = order.iter().map(|step| step.0).collect();
            let each: BTreeSet<usize> = vertices.iter().copied().collect();
            assert_eq!((each.len(), vertices.len()), (graph.len(), graph.len()), "{graph:?}");
            for (n, &(vertex, begins)) in order.iter().enumerate() {
                let (before, after) = vertices.split_at(n);
                let held = between(&graph, vertex, before);
                let most = after.iter().map(|&v| between(&graph, v, before)).max();
                assert_eq!(Some(held), most, "seed {seed}, place {n}");
                assert_eq!(held == 0, begins, "seed {seed}, place {n}");
                let equal = after.iter().filter(|&&v| between(&graph, v, before) == held);
                assert!(begins || equal.min() == Some(&vertex), "seed {seed}, place {n}");
            }
            let starts: Vec<usize> = (0..order.len()).filter(|&n| order[n].1).collect();
            for (n, &start) in starts.iter().enumerate() {
                let end = starts.get(n + 1).copied().unwrap_or(order.len());
                let run = &vertices[start..end];
                let found: BTreeSet<usize> = run.iter().copied().collect();
                assert_eq!(found, component(&graph, run[0]), "seed {seed}");
                if let [.., s, t] = *run {
                    let last = between(&graph, t, &run[..run.len() - 1]);
                    assert_eq!(last, least_cut(&graph, run, [s, t]), "seed {seed}: {run:?}");
                    compared += 1;
                }
            }
        }
        assert!(compared > 200, "{compared}");
    }

    #[test]
    fn a_ring_is_closed_last_and_what_stands_alone_comes_after() {
        let ring = [(1, 2, 5), (2, 3, 5), (3, 4, 5), (4, 1, 5)];
        let order = adjacency_order(&graph(5, &ring));
        assert_eq!(order, [(1, true), (2, false), (3, false), (4, false), (0, true)]);
        // Of two that are joined equally, the first; a longer seam goes before.
        let star = [(0, 1, 2), (0, 2, 2), (0, 3, 3), (3, 3, 9)];
        let order = adjacency_order(&graph(4, &star));
        assert_eq!(order, [(0, true), (3, false), (1, false), (2, false)]);
    }
}
