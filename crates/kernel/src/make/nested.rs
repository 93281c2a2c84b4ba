//! The patterns to cut, laid out on the sheets of a design.

use super::{CutItem, Made};
use crate::check::{Finding, FindingKind};
use crate::design::{SheetForm, Stock, Turn};
use crate::nest::{
    Nest, NestForm, NestOptions, NestPart, NestSheet, Placement, Turns, first_fault, nest,
};
use crate::pattern::{PathKind, Piece};
use sheetwright_geometry::math::{Point2, Vec2, atan2};
use sheetwright_geometry::watch::{Stage, Watch};
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

/// Steps below this, radians, are any angle.
const LEAST_STEP: f64 = TAU / 720.0;

/// The patterns to cut on their sheets.
#[derive(Clone, Debug, PartialEq)]
pub struct Nested {
    /// The patterns: [`Made::cut_list`].
    pub list: Vec<CutItem>,
    /// Where each lies. The parts are [`items`](Self::items).
    pub nest: Nest,
    /// The part that is cut at each placement, by its number in the design.
    pub parts: Vec<usize>,
    /// What each part of `nest` is. A placement of mirror images is turned over already.
    pub items: Vec<NestItem>,
    /// Whether the layout was proved to keep all that was asked; it always should.
    pub is_proved: bool,
}

/// A pattern that is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NestItem {
    /// The number of its pattern in the list to cut.
    pub item: usize,
    /// Whether the parts are mirror images of the pattern.
    pub is_mirrored: bool,
}

impl Made {
    /// Lays the patterns of [`Made::cut_list`] out on the sheets of the design, if it has some.
    pub fn lay_out(&mut self, watch: &mut dyn Watch) {
        let Some(stock) = self.stock.as_ref().filter(|stock| !stock.sheets.is_empty()) else {
            return;
        };
        let names: Vec<&str> = self.parts.iter().map(|part| &part.name[..]).collect();
        watch.begin(&names, Stage::Nest);
        let (nested, without) = Nested::new(self, stock, watch);
        self.nested = Some(nested);
        for (part, is_too_large) in without {
            let checked = &mut self.parts[part].checked;
            let is_known = |it: &Finding| matches!(it.kind, FindingKind::TooLarge { .. });
            if !checked.findings.iter().any(is_known) {
                checked.add(Finding::of_whole(FindingKind::NoSheet { is_too_large }));
            }
        }
    }
}

impl Nested {
    /// The layout, and the parts that have no sheet for all their copies, by their numbers in the
    /// design: whether they fit none.
    fn new(made: &Made, stock: &Stock, watch: &mut dyn Watch) -> (Self, BTreeMap<usize, bool>) {
        let list = made.cut_list();
        let (mut items, mut parts, mut copies) = (Vec::new(), Vec::new(), Vec::new());
        for (item, cut) in list.iter().enumerate() {
            for is_mirrored in [false, true] {
                // Equal parts may belong to several groups, or to none.
                let mut groups: BTreeMap<Option<usize>, Vec<usize>> = BTreeMap::new();
                for part in cut.copies(made, is_mirrored) {
                    groups.entry(group(&made.parts[part].panel, stock)).or_default().push(part);
                }
                for (group, of_group) in groups {
                    items.push(NestItem { item, is_mirrored });
                    parts.push(nest_part(&cut.piece, is_mirrored, of_group.len(), group, stock));
                    copies.push(of_group);
                }
            }
        }
        let sheets: Vec<NestSheet> = stock.sheets.iter().map(nest_sheet).collect();
        // Cuts run half of the kerf beside the parts.
        let options = NestOptions {
            gap_mm: match stock.has_common_lines {
                true => stock.kerf_mm,
                false => stock.gap_mm.max(stock.kerf_mm),
            },
            has_common_lines: stock.has_common_lines,
            margin_mm: stock.margin_mm.max(0.5 * stock.kerf_mm),
            effort: stock.effort,
        };
        let mut nest = nest(&parts, &sheets, options, watch);
        let is_proved = first_fault(&nest, &parts, &sheets, options).is_none();
        // The mirror image of a pattern, turned over once more, is the pattern.
        for it in &mut nest.placements {
            it.is_over ^= items[it.part].is_mirrored;
        }
        let parts = nest.placements.iter().map(|it| copies[it.part][it.copy]).collect();
        let mut without = BTreeMap::new();
        for &part in nest.too_large.iter().chain(&nest.left_over) {
            let mut has_place = vec![false; copies[part].len()];
            let placed = nest.placements.iter().filter(|it| it.part == part);
            placed.for_each(|it| has_place[it.copy] = true);
            let lost = copies[part].iter().zip(has_place).filter(|&(_, has_place)| !has_place);
            let is_too_large = nest.too_large.contains(&part);
            without.extend(lost.map(|(&copy, _)| (copy, is_too_large)));
        }
        (Self { list, nest, parts, items, is_proved }, without)
    }

    /// The pattern that lies there, by its number in the list to cut.
    pub fn item(&self, placement: &Placement) -> usize {
        self.items[placement.part].item
    }
}

/// The group of panels that stay together that a panel belongs to.
fn group(panel: &str, stock: &Stock) -> Option<usize> {
    stock.together.iter().position(|names| names.iter().any(|name| name == panel))
}

fn nest_sheet(sheet: &crate::design::StockSheet) -> NestSheet {
    let form = match &sheet.form {
        SheetForm::Rectangle { size } => NestForm::Rectangle(*size),
        SheetForm::Roll { width } => NestForm::Roll(*width),
        SheetForm::Outline { points } => NestForm::Outline(points.clone()),
    };
    NestSheet { form, count: sheet.count, cost: sheet.cost }
}

fn nest_part(
    piece: &Piece,
    is_mirrored: bool,
    count: usize,
    group: Option<usize>,
    stock: &Stock,
) -> NestPart {
    // Turned over, top to bottom, and run the other way round.
    let laid = |line: &[Point2]| -> Vec<Point2> {
        match is_mirrored {
            false => line.to_vec(),
            true => line.iter().rev().map(|p| Point2::new(p.x, -p.y)).collect(),
        }
    };
    let loops = piece.loops().map(laid).collect();
    let grain = grain(piece).map(|way| if is_mirrored { Vec2::new(way.x, -way.y) } else { way });
    NestPart { loops, count, turns: turns(grain, stock), group }
}

/// The direction of the grain arrow of a piece.
fn grain(piece: &Piece) -> Option<Vec2> {
    let arrow = piece.paths.iter().find(|path| path.kind == PathKind::Grain)?;
    Some(arrow.points[1] - arrow.points[0])
}

fn turns(grain: Option<Vec2>, stock: &Stock) -> Turns {
    let along = |way: Vec2| {
        let angle = -atan2(way.y, way.x);
        match stock.turn {
            Turn::OneWay => vec![angle],
            _ => vec![angle, angle + PI],
        }
    };
    let may_turn_over = stock.may_turn_over;
    let free = Turns { may_turn_over, ..Turns::FREE };
    let of_grain =
        |way: Vec2| Turns { angles: along(way), tolerance: stock.grain_tolerance, may_turn_over };
    match (grain, stock.turn) {
        (Some(way), _) => of_grain(way),
        (None, Turn::Grain | Turn::OneWay) => of_grain(Vec2::X),
        (None, Turn::Steps { angle }) if angle >= LEAST_STEP => {
            let count = ((TAU / angle) + 1e-9) as usize;
            let angles = (0..count.max(1)).map(|n| n as f64 * angle).collect();
            Turns { angles, ..free }
        }
        (None, Turn::Steps { .. } | Turn::Free) => free,
    }
}
