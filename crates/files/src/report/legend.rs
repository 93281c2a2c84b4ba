//! The meaning of the lines of a picture.

use super::canvas::{Anchor, MARGIN, line, text};
use crate::space::CUT;
use sheetwright::math::Point2;
use std::collections::BTreeSet;

/// The meaning of the lines of a picture that are drawn in a style of their own.
pub(super) struct Legend {
    pub(super) body: String,
    /// How much higher it makes the picture.
    pub(super) height: f64,
}

/// The legend of the classes of some lines, whose upper edge is at `top`; empty if no class needs
/// one.
pub(super) fn legend(classes: impl Iterator<Item = &'static str>, top: f64) -> Legend {
    const ROW: f64 = 22.0;
    let shown: BTreeSet<&str> = classes.collect();
    let mut legend = Legend { body: String::new(), height: 0.0 };
    for (class, words) in [
        ("w", "largest warp"),
        ("x", "warp above the limit"),
        ("t", "bend radius below the limit"),
        ("score", "fold: score it"),
        (CUT, "cut open on the pattern"),
    ] {
        if shown.contains(class) {
            let y = top + legend.height + 0.5 * ROW;
            legend.body += &line(class, &[Point2::new(MARGIN, y), Point2::new(MARGIN + 34.0, y)]);
            let at = Point2::new(MARGIN + 44.0, y + 5.0);
            legend.body += &text("", Anchor::Start, at, words);
            legend.height += ROW;
        }
    }
    legend
}
