//! The runs of one source that a border is divided into, and their names.

use super::{Edge, EdgeSource};
use crate::sheet::{Sheet, steps_of};
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point2, Point3};
use std::collections::BTreeMap;

/// A step of a border: the vertex at which it begins, and its source, or what that follows from.
pub(super) type Step<S> = (usize, S);

/// The edges of a sheet. The source of a step along a cut is that cut; `source` gives that of any
/// other step, by its ends, and `name` the name of an edge with such a source.
pub(super) fn edges_of(
    sheet: &Sheet,
    flat: &[Point2],
    source: impl Fn([VertexIndex; 2]) -> EdgeSource,
    name: impl Fn(EdgeSource) -> String,
) -> Vec<Edge> {
    let cuts = cut_steps(sheet);
    let source = |step: [VertexIndex; 2]| cuts.get(&step).copied().unwrap_or_else(|| source(step));
    let step = |step: [VertexIndex; 2]| (step[0].get(), source(step));
    let loops: Vec<Vec<Step<EdgeSource>>> =
        sheet.loops().iter().map(|line| steps_of(line).map(step).collect()).collect();
    let name = |source: EdgeSource| match source {
        EdgeSource::Cut { number, second } => {
            format!("cut-{}{}", number + 1, if second { 'b' } else { 'a' })
        }
        other => name(other),
    };
    edges(&loops, |source| (name(source), source), sheet.mesh().positions(), flat)
}

/// The steps of the border along the cuts of a sheet.
fn cut_steps(sheet: &Sheet) -> BTreeMap<[VertexIndex; 2], EdgeSource> {
    let mut of_cuts = BTreeMap::new();
    for (number, seam) in sheet.seams().iter().enumerate() {
        for (side, second) in seam.steps().into_iter().zip([false, true]) {
            of_cuts.extend(side.into_iter().map(|s| (s, EdgeSource::Cut { number, second })));
        }
    }
    of_cuts
}

/// The edges of a border of these loops. `named` gives the name and the source of an edge by what
/// its steps have in common; a second edge with that name gets `-2`, and so on.
pub(super) fn edges<S: Copy + PartialEq>(
    loops: &[Vec<Step<S>>],
    named: impl Fn(S) -> (String, EdgeSource),
    space: &[Point3],
    flat: &[Point2],
) -> Vec<Edge> {
    let mut count: BTreeMap<String, usize> = BTreeMap::new();
    let mut edges: Vec<Edge> = Vec::new();
    for (of_run, run) in loops.iter().flat_map(|steps| runs(steps)) {
        let (name, source) = named(of_run);
        // A curve may have the name that the second edge of another gets.
        let mut numbered = || {
            let n = count.entry(name.clone()).and_modify(|n| *n += 1).or_insert(1);
            if *n == 1 { name.clone() } else { format!("{name}-{n}") }
        };
        let mut free = numbered();
        while edges.iter().any(|edge| edge.name == free) {
            free = numbered();
        }
        edges.push(Edge::new(free, source, run, space, flat));
    }
    edges
}

/// The longest runs of one source along a loop, in the order of the loop; the first holds its first
/// step.
pub(crate) fn runs<S: Copy + PartialEq>(steps: &[Step<S>]) -> Vec<(S, Vec<usize>)> {
    let m = steps.len();
    let begins = |n: usize| steps[n].1 != steps[(n + m - 1) % m].1;
    let starts: Vec<usize> = (0..m).filter(|&n| begins(n)).collect();
    let run = |from: usize, count: usize| {
        let vertices = (0..=count).map(|k| steps[(from + k) % m].0).collect();
        (steps[from].1, vertices)
    };
    let [first, ..] = starts[..] else {
        return if m == 0 { Vec::new() } else { vec![run(0, m)] };
    };
    let ends = starts.iter().skip(1).copied().chain([first + m]);
    let mut runs: Vec<_> =
        starts.iter().zip(ends).map(|(&from, to)| run(from, to - from)).collect();
    if first > 0 {
        runs.rotate_right(1);
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_end_where_the_source_changes() {
        let (a, b) = (EdgeSource::Curve(0), EdgeSource::Curve(1));
        let loop_of = |sources: &[EdgeSource]| -> Vec<Step<EdgeSource>> {
            sources.iter().enumerate().map(|(n, source)| (10 + n, *source)).collect()
        };
        assert_eq!(runs(&loop_of(&[a, a, a])), [(a, vec![10, 11, 12, 10])]);
        assert_eq!(runs(&loop_of(&[a, a, b])), [(a, vec![10, 11, 12]), (b, vec![12, 10])]);
        // The first run holds the first step, wherever it begins.
        assert_eq!(runs(&loop_of(&[a, b, a])), [(a, vec![12, 10, 11]), (b, vec![11, 12])]);
        assert_eq!(runs::<EdgeSource>(&[]), []);
    }

    #[test]
    fn no_two_edges_have_one_name() {
        let sources = [0, 1, 0, 2].map(EdgeSource::Curve);
        let steps: Vec<Step<EdgeSource>> =
            sources.iter().enumerate().map(|(n, s)| (n, *s)).collect();
        let names = ["rim", "keel", "rim-2"];
        let name = |source| match source {
            EdgeSource::Curve(n) => (names[n].to_owned(), source),
            _ => (String::new(), source),
        };
        let at = [Point3::new(0.0, 0.0, 0.0); 4];
        let flat = [Point2::new(0.0, 0.0); 4];
        let found: Vec<String> =
            edges(&[steps], name, &at, &flat).into_iter().map(|edge| edge.name).collect();
        assert_eq!(found, ["rim", "keel", "rim-2", "rim-2-2"]);
    }
}
