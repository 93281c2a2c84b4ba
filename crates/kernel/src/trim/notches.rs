//! Notches in the cut line, and ticks inside the net line.

use super::holes::circle;
use super::stretch::Spot;
use crate::design::{NotchForm, Notches};
use crate::pattern::{LabelKind, PathKind, PatternLabel, PatternPath, Role, ahead_of_tick_mm};
use sheetwright_geometry::math::Point2;

/// A notch that is cut out begins this share of its depth beyond the cut line, which may curve.
const BEYOND: f64 = 0.25;
/// The round bottom of a notch has as many sides.
const SIDES: u16 = 24;

/// What a notch adds to the cut region, takes from it, and draws.
#[derive(Default)]
pub(super) struct Notched {
    pub(super) added: Vec<Vec<Point2>>,
    pub(super) removed: Vec<Vec<Point2>>,
    pub(super) paths: Vec<PatternPath>,
}

/// The notches at a spot of the net line where the cut line lies `margin` mm outside.
pub(super) fn notched(spot: Spot, margin: f64, notches: &Notches) -> Notched {
    let mut made = Notched::default();
    let Notches { form, depth, width, count, gap, .. } = *notches;
    for n in 0..count {
        let ahead = (n as f64 - 0.5 * (count as f64 - 1.0)) * gap;
        let at = |side: f64, outwards: f64| spot.beside(ahead + side, margin + outwards);
        let half = 0.5 * width;
        let cut = |points: Vec<Point2>| PatternPath {
            role: Role::Cut,
            kind: PathKind::Notch,
            points,
            closed: false,
        };
        match form {
            NotchForm::Slit => made.paths.push(cut(vec![at(0.0, 0.0), at(0.0, -depth)])),
            NotchForm::T => {
                let bar = [at(0.0, -depth), at(-half, -depth), at(half, -depth)];
                made.paths.push(cut([&[at(0.0, 0.0)], &bar[..]].concat()));
            }
            NotchForm::V => {
                let (wide, over) = (half * (1.0 + BEYOND), depth * BEYOND);
                made.removed.push(vec![at(-wide, over), at(0.0, -depth), at(wide, over)]);
            }
            NotchForm::U => {
                let radius = half.min(depth);
                let (bottom, over) = (radius - depth, depth * BEYOND);
                made.removed.push(vec![
                    at(-half, over),
                    at(-half, bottom),
                    at(half, bottom),
                    at(half, over),
                ]);
                made.removed.push(circle(at(0.0, bottom), radius, SIDES));
            }
            NotchForm::VOut => {
                made.added.push(vec![
                    at(-half, -margin),
                    at(-half, 0.0),
                    at(0.0, depth),
                    at(half, 0.0),
                    at(half, -margin),
                ]);
            }
            NotchForm::Castle => {
                made.added.push(vec![
                    at(-half, -margin),
                    at(half, -margin),
                    at(half, depth),
                    at(-half, depth),
                ]);
            }
        }
    }
    made
}

/// A tick inside the net line, with its number.
pub(super) fn ticked(
    spot: Spot,
    length: f64,
    number: Option<usize>,
) -> (PatternPath, Option<PatternLabel>) {
    let path = PatternPath {
        role: Role::Engrave,
        kind: PathKind::TrimTick,
        points: vec![spot.at, spot.beside(0.0, -length)],
        closed: false,
    };
    let height_mm = (0.6 * length).max(1.5);
    let label = number.map(|number| number.to_string()).map(|text| PatternLabel {
        kind: LabelKind::Trim,
        role: Role::Engrave,
        // Beside the tick, with its feet towards the edge.
        at: spot.beside(ahead_of_tick_mm(&text, height_mm), -0.4 * length),
        along: spot.along,
        height_mm,
        text,
    });
    (path, label)
}
