//! Which rungs a picture draws, and their classes.

use crate::wording::thinned;
use sheetwright::make::Part;
use sheetwright::material::{Material, warp_limit_deg};
use sheetwright::math::{Point2, from_deg, to_deg};
use sheetwright::measure::{Measures, RungMeasures, SHARP_CREASE_DEG};
use std::collections::BTreeMap;

/// The most rungs of a class that are drawn on a panel.
pub(crate) const MOST_RUNGS: usize = 60;
/// The least distance between the middles of rulings on a panel, in units of the picture: closer
/// ones would run into one another.
pub(crate) const APART: f64 = 5.0;
/// The classes of rungs, in the order in which they are drawn.
pub(crate) const RUNG_CLASSES: [&str; 6] = ["turn", "r", "score", "t", "x", "w"];
/// The classes whose middles keep that distance; the first is placed first.
pub(crate) const APART_CLASSES: [&str; 2] = ["turn", "r"];
/// The class of cuts in space: rungs along which the pattern is cut open.
pub(crate) const CUT: &str = "seam";
/// The class of the sharp creases of a mesh, which are scored as folds are.
pub(crate) const CREASE: &str = "score";

/// The class of every rung that is drawn: `w` the largest warp, if above the limit, `x` any other
/// warp above the limit, `t` a bend radius below the limit, `score` a fold, `turn` a bend so sharp
/// that the pattern engraves it, `r` any other along which the sheet bends: on a flat part a line
/// would look like a bend. About `most` of each class at most.
pub(crate) fn rung_classes(
    part: &Part,
    material: Option<&Material>,
    most: usize,
) -> Vec<Option<&'static str>> {
    let limit = from_deg(warp_limit_deg(material));
    let least_mm = material.map_or(0.0, |m| m.bend_radius_mm.value);
    let rungs = &part.measures.rungs;
    let is_beyond = |n: &usize| rungs[*n].warp_beyond_sampling() > limit;
    let worst = worst_rung(&part.measures).filter(is_beyond);
    let mut classes = vec![None; rungs.len()];
    let (beyond, within): (Vec<usize>, Vec<usize>) = (0..rungs.len()).partition(is_beyond);
    let (tight, wide): (Vec<usize>, Vec<usize>) =
        within.into_iter().partition(|&n| rungs[n].bend_radius_mm < least_mm);
    let of_class = |class: &str| -> Vec<usize> {
        wide.iter().copied().filter(|&n| class_within(&rungs[n]) == Some(class)).collect()
    };
    for (list, class) in [
        (alike(&of_class("r"), most), "r"),
        (alike(&of_class("turn"), most), "turn"),
        (thinned(&of_class("score"), most), "score"),
        (thinned(&tight, most), "t"),
        (thinned(&beyond, most), "x"),
    ] {
        for n in list {
            classes[n] = Some(class);
        }
    }
    if let Some(worst) = worst {
        classes[worst] = Some("w");
    }
    classes
}

/// The class of a rung within the limits of the sheet; `None` where it is flat.
fn class_within(rung: &RungMeasures) -> Option<&'static str> {
    if rung.is_scored {
        Some("score")
    } else if !rung.is_fold && to_deg(rung.crease.abs()) > SHARP_CREASE_DEG {
        Some("turn")
    } else {
        rung.bends().then_some("r")
    }
}

/// The rung with the largest warp angle, by its number from 0, the first of equals; `None` without
/// rungs.
pub(crate) fn worst_rung(measures: &Measures) -> Option<usize> {
    let rungs = &measures.rungs;
    (0..rungs.len()).reduce(|best, n| if rungs[n].warp > rungs[best].warp { n } else { best })
}

/// At most `most` of some rungs, in equal, even steps: along a strip rungs alternately lean one way
/// and the other, so those drawn all lean one way.
fn alike(rungs: &[usize], most: usize) -> Vec<usize> {
    if rungs.len() <= most {
        return rungs.to_vec();
    }
    let every = rungs.len().div_ceil(most).next_multiple_of(2);
    rungs[(rungs.len() - 1) % every / 2..].iter().step_by(every).copied().collect()
}

/// The middles of the rulings that are drawn, in a grid whose squares have their least distance.
pub(crate) struct Middles {
    apart: f64,
    squares: BTreeMap<(i64, i64), Vec<Point2>>,
}

impl Middles {
    /// No middles; `apart` is their least distance, in units of the picture.
    pub(crate) fn apart(apart: f64) -> Self {
        Self { apart, squares: BTreeMap::new() }
    }

    fn square(&self, middle: Point2) -> (i64, i64) {
        ((middle.x / self.apart).floor() as i64, (middle.y / self.apart).floor() as i64)
    }

    /// Whether no other middle is nearer than the least distance.
    pub(crate) fn is_free(&self, middle: Point2) -> bool {
        let (x, y) = self.square(middle);
        let around = (-1..=1).flat_map(|i| (-1..=1).map(move |k| (x + i, y + k)));
        let mut near = around.filter_map(|square| self.squares.get(&square)).flatten();
        near.all(|other| other.distance(middle) >= self.apart)
    }

    pub(crate) fn take(&mut self, middle: Point2) {
        self.squares.entry(self.square(middle)).or_default().push(middle);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rungs_that_are_drawn_lean_one_way() {
        let all: Vec<usize> = (0..397).collect();
        let few = alike(&all, 60);
        assert!((45..=60).contains(&few.len()), "{}", few.len());
        assert!(few.iter().all(|n| n % 2 == few[0] % 2), "{few:?}");
        assert!(few[0] < 8 && few[few.len() - 1] > 388, "{few:?}");
        assert_eq!(alike(&all[..60], 60), &all[..60]);
        assert!(alike(&[], 60).is_empty());
    }
}
