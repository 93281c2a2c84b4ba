//! A sheet with the parts on it as one drawing, for writers that know pieces.
//!
//! Lines keep their roles, so that a part on a sheet is cut, scored and engraved as by itself. A
//! part that lies in a hole of another is cut before that hole, or it would fall out with it: all
//! of its cuts count as inner ones. What a pattern has beside the part, its dimensions and texts
//! with leaders, would lie on its neighbours and stays away. Texts are read from below or from the
//! right, however their part lies.

use super::cut_once::cut_once;
use super::{CutItem, Made};
use crate::design::{SheetForm, StockSheet};
use crate::nest::{Placement, UsedSheet};
use crate::pattern::{LabelKind, PathKind, PatternLabel, PatternPath, Piece, Role, is_text_inside};
use sheetwright_geometry::math::{Point2, Vec2};
use sheetwright_geometry::predicate::{Box2, inside};

/// The distance between two sheets that are drawn beside each other, mm.
const BESIDE_MM: f64 = 100.0;
/// The name of a sheet stands this high above it, and its letters are as high, mm.
const NAME_MM: f64 = 15.0;

impl Made {
    /// Each sheet with the parts on it, in order; lines that parts have in common are cut once, if
    /// the stock says so. `patterns` are those of [`super::Nested::list`], or others in their
    /// places, as for a machine. Empty where parts are not laid out.
    pub fn sheet_pieces(&self, patterns: &[CutItem]) -> Vec<Piece> {
        let (Some(nested), Some(stock)) = (&self.nested, &self.stock) else { return Vec::new() };
        let mut on: Vec<Vec<Laid<'_>>> = vec![Vec::new(); nested.nest.sheets.len()];
        for (placement, &part) in nested.nest.placements.iter().zip(&nested.parts) {
            let piece = &patterns[nested.item(placement)].piece;
            let name = &self.parts[part].name;
            let outline = piece.outline().iter().map(|&p| placement.lay(p)).collect();
            on[placement.sheet].push(Laid { placement, piece, name, outline });
        }
        let sheets = nested.nest.sheets.iter().zip(on).enumerate();
        let piece = |(n, (used, parts)): (usize, (&UsedSheet, Vec<Laid<'_>>))| {
            let mut sheet = sheet_piece(n, used, &stock.sheets[used.kind], &parts);
            if stock.has_common_lines {
                sheet.paths = cut_once(sheet.paths);
            }
            sheet
        };
        sheets.map(piece).collect()
    }
}

/// A part on its sheet.
#[derive(Clone)]
struct Laid<'a> {
    placement: &'a Placement,
    piece: &'a Piece,
    name: &'a str,
    /// Its outline on the sheet.
    outline: Vec<Point2>,
}

/// Sheets beside each other, left to right, as one drawing of this name.
pub fn beside_each_other(name: &str, sheets: &[Piece]) -> Piece {
    let mut all = Piece::undrawn(name);
    let mut right = 0.0;
    for sheet in sheets {
        // An offcut may have its corners anywhere.
        let around = sheet.extent();
        let by = Vec2::new(right - around.min.x, 0.0);
        let moved = |path: &PatternPath| PatternPath {
            points: path.points.iter().map(|&p| p + by).collect(),
            ..path.clone()
        };
        all.paths.extend(sheet.paths.iter().map(moved));
        let moved = |label: &PatternLabel| PatternLabel { at: label.at + by, ..label.clone() };
        all.labels.extend(sheet.labels.iter().map(moved));
        right += around.max.x - around.min.x + BESIDE_MM;
        all.size = Vec2::new(right - BESIDE_MM, all.size.y.max(sheet.size.y));
    }
    all
}

fn sheet_piece(number: usize, used: &UsedSheet, stock: &StockSheet, parts: &[Laid<'_>]) -> Piece {
    let [width, height] = used.size;
    let corners = match &stock.form {
        SheetForm::Outline { points } => points.clone(),
        SheetForm::Rectangle { .. } | SheetForm::Roll { .. } => {
            [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]]
                .map(|[x, y]| Point2::new(x, y))
                .to_vec()
        }
    };
    let mut piece = Piece::undrawn(&format!("sheet-{}", number + 1));
    piece.size = Vec2::new(width, height);
    // What lies deepest comes first.
    let mut order: Vec<(usize, usize)> = depths(parts).into_iter().zip(0..).collect();
    order.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.cmp(&b.1)));
    for (depth, n) in order {
        lay(&mut piece, &parts[n], depth > 0);
    }
    let (role, kind) = (Role::Sheet, PathKind::SheetEdge);
    let around = Box2::of_points(corners.iter().copied());
    piece.paths.push(PatternPath { role, kind, points: corners, closed: true });
    if let Some(around) = around {
        piece.labels.push(PatternLabel {
            kind: LabelKind::Name,
            role: Role::Note,
            at: Point2::new(0.5 * (around.min.x + around.max.x), around.max.y + NAME_MM),
            along: Vec2::X,
            height_mm: NAME_MM,
            text: piece.name.clone(),
        });
    }
    piece
}

/// In how many others each part lies. Parts do not overlap, so one that lies within the outline of
/// another lies in a hole of it.
fn depths(parts: &[Laid<'_>]) -> Vec<usize> {
    let boxes: Vec<Option<Box2>> =
        parts.iter().map(|it| Box2::of_points(it.outline.iter().copied())).collect();
    let is_in = |n: usize, k: usize| {
        let (Some(around), Some(&p)) = (boxes[k], parts[n].outline.first()) else { return false };
        let is_near = around.min.x <= p.x
            && p.x <= around.max.x
            && around.min.y <= p.y
            && p.y <= around.max.y;
        k != n && is_near && inside(&parts[k].outline, p)
    };
    let holed: Vec<usize> =
        (0..parts.len()).filter(|&k| parts[k].piece.loops().nth(1).is_some()).collect();
    (0..parts.len()).map(|n| holed.iter().filter(|&&k| is_in(n, k)).count()).collect()
}

/// Draws a part where it lies under its own name: the lines of its inside first.
fn lay(sheet: &mut Piece, laid: &Laid<'_>, is_in_a_hole: bool) {
    let Laid { placement: it, piece: part, name, .. } = *laid;
    let is_last = |path: &PatternPath| path.kind == PathKind::Outline;
    let kept = |path: &&PatternPath| !matches!(path.kind, PathKind::Dimension | PathKind::Leader);
    let mut paths: Vec<PatternPath> = part
        .paths
        .iter()
        .filter(kept)
        .map(|path| PatternPath {
            role: if is_in_a_hole && path.role == Role::Cut { Role::Inner } else { path.role },
            points: path.points.iter().map(|&p| it.lay(p)).collect(),
            ..path.clone()
        })
        .collect();
    paths.sort_by_key(is_last);
    sheet.paths.extend(paths);
    let stays =
        |label: &&PatternLabel| label.kind != LabelKind::Quantity && is_text_inside(label, part);
    sheet.labels.extend(part.labels.iter().filter(stays).map(|label| {
        // Letters are not mirrored: what was their top becomes their base line.
        let lift = if it.is_over { label.height_mm } else { 0.0 };
        let laid = PatternLabel {
            at: it.lay(label.at + label.along.perp() * lift),
            along: it.turned(label.along),
            ..named(label, name)
        };
        laid.upright()
    }));
}

/// A label; the name of a pattern is that of the part which is cut from it, no wider than it was.
fn named(label: &PatternLabel, name: &str) -> PatternLabel {
    if label.kind != LabelKind::Name {
        return label.clone();
    }
    let [before, now] = [label.text.chars().count(), name.chars().count()];
    let height_mm = label.height_mm * (before as f64 / now.max(1) as f64).min(1.0);
    PatternLabel { height_mm, text: name.to_owned(), ..label.clone() }
}
