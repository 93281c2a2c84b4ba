//! The steps of joining, gathered into the pictures of a book.
//!
//! Steps that follow one another and are alike (a part of one pattern, joined along equally long
//! edges) are one picture: a dome of twelve gores has three. Of more pictures than a builder leafs
//! through, several that follow one another become one.

use sheetwright::make::{CutItem, JoiningStep, Made};
use std::ops::Range;

/// The most pictures of steps.
const MOST_STAGES: usize = 48;
/// Lengths that differ by less than this, mm, are alike.
const ALIKE_MM: f64 = 0.1;

/// What the picture of a step shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct StageOf {
    /// The steps, by their numbers from 0.
    pub(super) steps: Range<usize>,
    /// Whether they are alike.
    pub(super) alike: bool,
}

/// The pictures of the steps of a design.
pub(super) fn stages(made: &Made, patterns: &[CutItem], steps: &[JoiningStep]) -> Vec<StageOf> {
    let mut pattern_of = vec![0; made.parts.len()];
    for (n, item) in patterns.iter().enumerate() {
        item.instances.iter().for_each(|instance| pattern_of[instance.number] = n);
    }
    let is_joined = |part: usize| made.parts[part].edges.iter().any(|edge| !edge.mates.is_empty());
    let lengths = |step: &JoiningStep| {
        let mut lengths: Vec<f64> = step.joins.iter().map(|join| join.shared_mm[0]).collect();
        lengths.sort_by(f64::total_cmp);
        lengths
    };
    let is_alike = |a: &JoiningStep, b: &JoiningStep| {
        let (of_a, of_b) = (lengths(a), lengths(b));
        let near = of_a.iter().zip(&of_b).all(|(a, b)| (a - b).abs() < ALIKE_MM);
        let both_loose = !is_joined(a.part) && !is_joined(b.part);
        both_loose
            || (!a.begins && !b.begins)
                && pattern_of[a.part] == pattern_of[b.part]
                && of_a.len() == of_b.len()
                && near
    };
    let mut stages: Vec<StageOf> = Vec::new();
    for (n, step) in steps.iter().enumerate() {
        match stages.last_mut() {
            Some(stage) if is_alike(&steps[n - 1], step) => {
                stage.steps.end = n + 1;
                stage.alike = true;
            }
            _ => stages.push(StageOf { steps: n..n + 1, alike: false }),
        }
    }
    gathered(stages, MOST_STAGES)
}

/// At most `most` stages, of several that follow one another each.
fn gathered(stages: Vec<StageOf>, most: usize) -> Vec<StageOf> {
    let together = stages.len().div_ceil(most).max(1);
    if together == 1 {
        return stages;
    }
    let of_chunk = |chunk: &[StageOf]| StageOf {
        steps: chunk[0].steps.start..chunk[chunk.len() - 1].steps.end,
        alike: chunk.len() == 1 && chunk[0].alike,
    };
    stages.chunks(together).map(of_chunk).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright::{Unwatched, make::make};

    fn stages_of(template: &str) -> (usize, Vec<StageOf>) {
        let design = crate::design_from_template(template, &[]).unwrap();
        let made = make(&design, &mut Unwatched).unwrap();
        let steps = made.joining_order();
        (steps.len(), stages(&made, &made.cut_list(), &steps))
    }

    #[test]
    fn a_dome_of_equal_gores_takes_three_pictures() {
        let (steps, found) = stages_of("dome");
        let ranges: Vec<Range<usize>> = found.iter().map(|stage| stage.steps.clone()).collect();
        assert_eq!((steps, ranges), (12, vec![0..1, 1..11, 11..12]));
        assert_eq!(found.iter().map(|stage| stage.alike).collect::<Vec<_>>(), [false, true, false]);
    }

    #[test]
    fn pictures_are_few_and_miss_no_step() {
        let single = |n: usize| StageOf { steps: n..n + 1, alike: false };
        for count in [1, 47, 48, 49, 400] {
            let found = gathered((0..count).map(single).collect(), 48);
            assert!(found.len() <= 48, "{count}: {}", found.len());
            assert_eq!((found[0].steps.start, found[found.len() - 1].steps.end), (0, count));
            assert!(found.windows(2).all(|pair| pair[0].steps.end == pair[1].steps.start));
        }
    }
}
