//! The displacement of a moved boundary, enlarged.

use super::canvas::{PathData, Picture, WIDTH, line, round_below};
use super::space_picture::Fit;
use crate::space::view_of;
use sheetwright::boundary::size_of;
use sheetwright::make::{Change, Part};
use sheetwright::math::{Point2, Point3};

/// The largest displacement is drawn at most this long, as a share of the size of the panel.
const LONGEST: f64 = 0.08;
/// The most arrows on a panel.
const ARROWS: usize = 60;

/// The factor that enlarges displacements in the picture: a round number, at least 1.
pub(super) fn enlarged(change: &Change) -> f64 {
    let size = size_of(change.moved.iter().map(|[from, _]| *from));
    round_below((LONGEST * size / change.moved_max_mm()).max(1.0))
}

/// The boundary before and after it was moved, with enlarged displacements; `None` if nothing
/// moved.
pub fn moved_picture(part: &Part) -> Option<Picture> {
    let change = part.change().filter(|change| change.moved_max_mm() > 0.0)?;
    let times = enlarged(change);
    let view = view_of(std::slice::from_ref(&change.before));
    let larger = |[from, to]: &[Point3; 2]| *from + (*to - *from) * times;
    let before: Vec<Point2> = change.moved.iter().map(|[from, _]| view.project(*from)).collect();
    let after: Vec<Point2> = change.moved.iter().map(|m| view.project(larger(m))).collect();
    let fit = Fit::new(before.iter().chain(&after));
    let placed = |list: &[Point2]| list.iter().map(|p| fit.place(*p)).collect::<Vec<_>>();
    let (before, after) = (placed(&before), placed(&after));
    let mut outlines = [PathData::default(), PathData::default()];
    let before_it_moved = change.before.found()?;
    for of_loop in before_it_moved.boundary.loops() {
        for (outline, points) in outlines.iter_mut().zip([&before, &after]) {
            outline.ring(points[of_loop.clone()].iter().copied());
        }
    }
    let mut body = outlines[0].element("e");
    let every = before.len().div_ceil(ARROWS);
    for (from, to) in before.iter().zip(&after).step_by(every) {
        body += &line("tick", &[*from, *to]);
    }
    body += &outlines[1].element("curve");
    body += &fit.foot(&view);
    let title = format!("{}: how its boundary was moved, {times} times enlarged", part.name);
    Some(Picture::new(WIDTH, fit.total, title, body))
}
