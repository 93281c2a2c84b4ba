//! Places the names and marks of a piece on its sheets so that no joint of two sheets cuts one.
//!
//! A text that a joint would cut moves by the shortest way into one of the sheets that it lies on,
//! if possible clear of the lines to cut. One that lies on no sheet moves into the nearest. It
//! becomes smaller only where a sheet has no room for it at full size. The end of a leader moves
//! with its text.

use super::drawn::{drawn_labels, text_around};
use super::tiling::Tiling;
use sheetwright::math::{Point2, Vec2};
use sheetwright::pattern::{PathKind, PatternLabel, Piece};
use sheetwright::predicate::Box2;

/// The least distance between a text and a joint, mm.
const AWAY_MM: f64 = 1.0;
/// A leader ends this near to its text, as a share of the height of its letters.
const AT_TEXT: f64 = 1.0;

/// The piece with the texts to draw on its sheets, in their final places and sizes.
pub(super) fn placed(piece: &Piece, tiling: &Tiling) -> Piece {
    let mut drawn = Piece { labels: Vec::new(), ..piece.clone() };
    for label in drawn_labels(piece) {
        let moved = off_joints(label, piece, tiling);
        if moved != *label {
            lead_to(&mut drawn, piece, label, &moved);
        }
        drawn.labels.push(moved);
    }
    drawn
}

/// Lets the leader of a text end at its new place.
fn lead_to(drawn: &mut Piece, piece: &Piece, label: &PatternLabel, moved: &PatternLabel) {
    let (Some(stood), Some(stands)) = (text_around(label), text_around(moved)) else { return };
    let near = Vec2::splat(AT_TEXT * label.height_mm);
    let about = Box2 { min: stood.min + -near, max: stood.max + near };
    let leads = |end: Point2| holds(&about, &Box2 { min: end, max: end });
    for (was, path) in piece.paths.iter().zip(&mut drawn.paths) {
        if let (PathKind::Leader, [_, end]) = (was.kind, &was.points[..])
            && leads(*end)
        {
            // The nearest point of the text's new box to where the leader begins.
            let from = path.points[0];
            let end = Point2::new(
                from.x.clamp(stands.min.x, stands.max.x),
                from.y.clamp(stands.min.y, stands.max.y),
            );
            path.points[1] = end;
        }
    }
}

fn off_joints(label: &PatternLabel, piece: &Piece, tiling: &Tiling) -> PatternLabel {
    let Some(stands) = text_around(label) else { return label.clone() };
    let mut cells = tiling.cells_about(stands);
    if cells.is_empty() {
        cells.extend(tiling.nearest_cell(stands));
    }
    let cells: Vec<Box2> = cells.into_iter().map(inner).collect();
    if cells.iter().any(|cell| holds(cell, &stands)) {
        return label.clone();
    }
    let mut tried: Vec<(f64, f64, PatternLabel)> = Vec::new();
    for cell in &cells {
        let (room, size) = (cell.max - cell.min, stands.max - stands.min);
        let share = (room.x / size.x).min(room.y / size.y).min(1.0);
        let smaller = PatternLabel { height_mm: share * label.height_mm, ..label.clone() };
        let Some(stands) = text_around(&smaller) else { continue };
        for way in ways(cell, &stands, label.along) {
            let moved = PatternLabel { at: label.at + way, ..smaller.clone() };
            if text_around(&moved).is_some_and(|stands| holds(cell, &stands)) {
                tried.push((share, way.length(), moved));
            }
        }
    }
    // The largest first, and of equal sizes the nearest.
    tried.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.total_cmp(&b.1)));
    let is_free = |label: &PatternLabel| text_around(label).is_some_and(|it| !is_cut(piece, &it));
    let free = tried.iter().position(|tried| is_free(&tried.2));
    let best = free.unwrap_or(0);
    tried.into_iter().nth(best).map_or_else(|| label.clone(), |(_, _, moved)| moved)
}

/// A cell without a margin, since the joints run along its edge.
fn inner(cell: Box2) -> Box2 {
    let away = Vec2::splat(AWAY_MM);
    Box2 { min: cell.min + away, max: cell.max + -away }
}

fn holds(cell: &Box2, other: &Box2) -> bool {
    /// The tolerance for the rounding of a sum, mm.
    const EPS: f64 = 1e-9;
    cell.min.x - EPS <= other.min.x
        && cell.min.y - EPS <= other.min.y
        && other.max.x <= cell.max.x + EPS
        && other.max.y <= cell.max.y + EPS
}

/// The displacements of a text into a cell, mm: the shortest, and the shortest along the text.
fn ways(cell: &Box2, stands: &Box2, along: Vec2) -> Vec<Vec2> {
    let into = |low: f64, high: f64, least: f64, most: f64| {
        if low < least {
            least - low
        } else if high > most {
            most - high
        } else {
            0.0
        }
    };
    let x = into(stands.min.x, stands.max.x, cell.min.x, cell.max.x);
    let y = into(stands.min.y, stands.max.y, cell.min.y, cell.max.y);
    let mut ways = vec![Vec2::new(x, y)];
    for (by, of) in [(x, along.x), (y, along.y)] {
        if by != 0.0 && of != 0.0 {
            ways.push(along * (by / of));
        }
    }
    ways
}

/// Whether a line to cut passes through a box.
fn is_cut(piece: &Piece, around: &Box2) -> bool {
    piece.loops().any(|line| {
        let ends = |n: usize| (line[n], line[(n + 1) % line.len()]);
        let edges = (0..line.len()).map(ends);
        edges.into_iter().any(|(a, b): (Point2, Point2)| around.part_inside(a, b).is_some())
    })
}

#[cfg(test)]
mod tests {
    use super::super::{Paper, tiling};
    use super::*;
    use sheetwright::math::from_deg;
    use sheetwright::pattern::{LabelKind, PatternPath, Role};

    fn piece(size: Vec2, labels: Vec<PatternLabel>) -> Piece {
        let corners = [(0.0, 0.0), (size.x, 0.0), (size.x, size.y), (0.0, size.y)];
        let outline = PatternPath {
            role: Role::Cut,
            kind: PathKind::Outline,
            points: corners.map(|(x, y)| Point2::new(x, y)).to_vec(),
            closed: true,
        };
        let (name, corner) = ("front".to_owned(), Point2::default());
        Piece {
            is_folded: false,
            name,
            paths: vec![outline],
            labels,
            size,
            corner,
            bends: Vec::new(),
            border: Vec::new(),
        }
    }

    fn label(text: &str, at: Point2, along: Vec2, height_mm: f64) -> PatternLabel {
        let (kind, role) = (LabelKind::Name, Role::Engrave);
        PatternLabel { kind, role, at, along, height_mm, text: text.to_owned() }
    }

    /// Names all over a piece of several sheets, along and aslant, short and long.
    #[test]
    fn no_joint_cuts_a_name() {
        let size = Vec2::new(900.0, 700.0);
        let mut moved = 0;
        for (text, height_mm) in [("front", 25.0), ("S1", 4.0), ("a name that is long", 25.0)] {
            for along in [0.0, 90.0, 30.0, 180.0].map(from_deg) {
                let along = Vec2::new(sheetwright::math::cos(along), sheetwright::math::sin(along));
                for n in 0..60 {
                    let at = Point2::new(60.0 + 13.0 * f64::from(n), 80.0 + 9.0 * f64::from(n));
                    let piece = piece(size, vec![label(text, at, along, height_mm)]);
                    let tiling = tiling::tiling(&piece, Paper::A4, 2000).unwrap_or_else(|n| {
                        panic!("{n} sheets");
                    });
                    let drawn = placed(&piece, &tiling).labels;
                    let stands = text_around(&drawn[0]).unwrap_or_else(|| panic!("{text}"));
                    let cells = tiling.cells_about(stands);
                    assert!(cells.len() == 1 && holds(&cells[0], &stands), "{text} at {at:?}");
                    assert!(!is_cut(&piece, &stands), "{text} at {at:?}");
                    moved += u32::from(drawn[0] != piece.labels[0]);
                }
            }
        }
        assert!((100..700).contains(&moved), "{moved} of 720");
    }

    #[test]
    fn what_no_joint_cuts_stays_where_it_is() {
        let there = label("front", Point2::new(60.0, 50.0), Vec2::X, 10.0);
        let piece = piece(Vec2::new(120.0, 100.0), vec![there.clone()]);
        let tiling = tiling::tiling(&piece, Paper::A4, 2000).unwrap_or_else(|n| panic!("{n}"));
        assert_eq!(placed(&piece, &tiling).labels, [there]);
    }
}
