//! Bend lines on the pattern: numbered, with the way and the angle that the sheet is bent by.
//!
//! A machine marks a tick at both ends alone unless whole lines are asked for: a line across a
//! lampshade or a plank would be seen for ever.

use super::{LabelKind, PathKind, PatternLabel, PatternPath, Role};
use crate::bend::BendLine;
use crate::design::BendMarks;
use sheetwright_geometry::math::{Vec2, to_deg, unit2};

/// Letters are as high as those of the piece times this, at the most.
const BESIDE_NAME: f64 = 0.3;
/// Letters are as high as this share of the line, at the most.
const ALONG: f64 = 0.06;
/// Letters are as high as this share of the way to the next line, at the most.
const BETWEEN: f64 = 0.6;
/// Lower letters can't be read.
const LEAST_MM: f64 = 1.5;
/// The middle of a text lies this share of the line from its end where there is more room.
const FROM_END: f64 = 0.3;
/// Ticks are no longer than this share of their line: others would meet in the middle.
const TICK_SHARE: f64 = 0.2;

/// The lines, ticks and texts of bend lines. A fold that the pattern has scored is drawn there, and
/// has a text alone. `tick_mm` is the length of a tick, `height_mm` the height of the piece's
/// letters.
pub(super) fn drawn(
    lines: &[BendLine],
    marks: BendMarks,
    is_scored: impl Fn(&BendLine) -> bool,
    tick_mm: f64,
    height_mm: f64,
) -> (Vec<PatternPath>, Vec<PatternLabel>) {
    let (mut paths, mut labels) = (Vec::new(), Vec::new());
    if marks == BendMarks::None {
        return (paths, labels);
    }
    let role = if marks == BendMarks::Lines { Role::Engrave } else { Role::Note };
    for (n, line) in lines.iter().enumerate() {
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
        labels.extend(text(lines, n, role, height_mm));
    }
    (paths, labels)
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

/// The number, the way and the angle of a line, along it; `None` where there is no room.
fn text(lines: &[BendLine], n: usize, role: Role, height_mm: f64) -> Option<PatternLabel> {
    let line = &lines[n];
    // Towards the end where lines are farther apart.
    let [left, right] = line.pitch_mm;
    let share = if right > left { 1.0 - FROM_END } else { FROM_END };
    let at = line.ends[0].lerp(line.ends[1], share);
    let beside = [n.checked_sub(1), Some(n + 1)].into_iter().flatten();
    let apart = |other: &BendLine| other.side_mm(at).abs();
    let room = beside.filter_map(|other| lines.get(other).map(apart)).fold(f64::INFINITY, f64::min);
    let height_mm = (BESIDE_NAME * height_mm).min(ALONG * line.length_mm()).min(BETWEEN * room);
    let way = unit2(line.ends[1] - line.ends[0]).filter(|_| height_mm >= LEAST_MM)?;
    let along = if way.x > 0.0 || (way.x == 0.0 && way.y > 0.0) { way } else { -way };
    let beside: Vec2 = along.perp() * (0.25 * height_mm);
    Some(PatternLabel {
        kind: LabelKind::Bend,
        role,
        at: at + beside,
        along,
        height_mm,
        text: written(n + 1, line),
    })
}

/// As in `7 up 12.5°`.
fn written(number: usize, line: &BendLine) -> String {
    let way = if line.is_up() { "up" } else { "down" };
    format!("{number} {way} {:.1}°", to_deg(line.angle.abs()))
}
