//! Bend lines on the pattern: numbered, with the way and the angle that the sheet is bent by.
//!
//! A machine marks a tick at both ends alone unless whole lines are asked for: a line across a
//! lampshade or a plank would be seen for ever.

use super::wish::{Instead, Wish, WishAt};
use super::{LabelKind, PathKind, PatternPath, Role};
use crate::bend::BendLine;
use crate::design::BendMarks;
use sheetwright_geometry::math::to_deg;

/// Shares of a line that a text stands at, nearer to its right end.
const NEAR_RIGHT: &[f64] = &[0.7, 0.8, 0.6, 0.85, 0.5, 0.4, 0.3, 0.2];
/// Nearer to its left end.
const NEAR_LEFT: &[f64] = &[0.3, 0.2, 0.4, 0.15, 0.5, 0.6, 0.7, 0.8];
/// Ticks are no longer than this share of their line: others would meet in the middle.
const TICK_SHARE: f64 = 0.2;

/// The lines and ticks of bend lines. A fold that the pattern has scored is drawn there. `tick_mm`
/// is the length of a tick.
pub(super) fn drawn(
    lines: &[BendLine],
    marks: BendMarks,
    is_scored: impl Fn(&BendLine) -> bool,
    tick_mm: f64,
) -> Vec<PatternPath> {
    let mut paths = Vec::new();
    if marks == BendMarks::None {
        return paths;
    }
    let role = if marks == BendMarks::Lines { Role::Engrave } else { Role::Note };
    for line in lines {
        if !is_scored(line) {
            paths.push(PatternPath {
                role,
                kind: PathKind::Bend { up: line.is_up() },
                points: line.ends.to_vec(),
                closed: false,
            });
            if marks != BendMarks::Lines {
                paths.extend(ticks(line, tick_mm));
            }
        }
    }
    paths
}

/// The ticks at both ends of a line.
fn ticks(line: &BendLine, tick_mm: f64) -> impl Iterator<Item = PatternPath> {
    let [a, b] = line.ends;
    let share = (tick_mm / a.distance(b)).min(TICK_SHARE);
    [(a, a.lerp(b, share)), (b, b.lerp(a, share))].into_iter().map(|(from, to)| PatternPath {
        role: Role::Engrave,
        kind: PathKind::BendTick,
        points: vec![from, to],
        closed: false,
    })
}

/// The number, the way and the angle of each line, along it, or its number alone: the table of bend
/// lines has the rest.
pub(super) fn wishes(lines: &[BendLine], marks: BendMarks) -> Vec<Wish> {
    if marks == BendMarks::None {
        return Vec::new();
    }
    let role = if marks == BendMarks::Lines { Role::Engrave } else { Role::Note };
    let wish = |(n, line): (usize, &BendLine)| {
        // Towards the end where lines are farther apart.
        let [left, right] = line.pitch_mm;
        let shares = if right > left { NEAR_RIGHT } else { NEAR_LEFT };
        let at = WishAt::Beside { line: line.ends.to_vec(), shares, is_left: false, away_mm: 0.0 };
        let (kind, instead) = (LabelKind::Bend, Instead::Nothing);
        let texts = vec![written(n + 1, line), (n + 1).to_string()];
        Wish { kind, role, texts, height_mm: None, at: vec![at], instead }
    };
    lines.iter().enumerate().map(wish).collect()
}

/// As in `7 up 12.5°`.
fn written(number: usize, line: &BendLine) -> String {
    let way = if line.is_up() { "up" } else { "down" };
    format!("{number} {way} {:.1}°", to_deg(line.angle.abs()))
}
