//! Parts on sheets: where each is cut from, so that little is wasted.
//!
//! Parts are laid down one after the other (`fill`), then sheets are emptied into the others where
//! that can be (`sheets`), and the parts on the last sheet, or on a roll, are squeezed together
//! (`squeeze`). All of it stands on one search \[GardeynVandenBergheWauters2025\]: parts may
//! overlap for a while, and are moved until none does (`separate`). That program works in single
//! precision, on one strip and by the clock, and takes no holes; this one works on several sheets
//! of several forms, lays parts in holes of others, and counts its steps, so that its layouts have
//! the same bits everywhere.
//!
//! Equal parts whose cuts may be in common are laid side by side first (`blocks`).
//!
//! The search sees parts as forms with fewer corners, grown by half the gap (`shape`). What it
//! finds is proved on the parts themselves (`proof`).

mod blocks;
mod fill;
mod layout;
mod proof;
mod search;
mod separate;
mod shape;
mod sheets;
mod squeeze;
mod state;
mod turns;

pub use proof::{NestFault, first_fault};
pub use turns::Turns;

use layout::{Pose, Room};
use separate::Budget;
use shape::{Shape, Trueness};
use sheets::Kinds;
use sheetwright_geometry::math::{Point2, Vec2, cos, sin};
use sheetwright_geometry::random::Random;
use sheetwright_geometry::watch::Watch;
use state::{Item, State};
use std::f64::consts::FRAC_PI_2;

/// A part to lay out.
#[derive(Clone, Debug)]
pub struct NestPart {
    /// The corners of its outline and then of its holes as they are cut, mm.
    pub loops: Vec<Vec<Point2>>,
    /// How often it is cut.
    pub count: usize,
    /// By which angles it may be turned from the grain of a sheet.
    pub turns: Turns,
    /// Parts of one group lie on one sheet.
    pub group: Option<usize>,
}

/// A kind of sheet.
#[derive(Clone, Debug)]
pub struct NestSheet {
    /// Its form.
    pub form: NestForm,
    /// How many there are; `None`: as many as it takes.
    pub count: Option<usize>,
    /// What one costs, or a metre of a roll. Default: its area counts.
    pub cost: Option<f64>,
}

/// The form of a sheet. The grain runs along the longer side of a rectangle, along a roll, and
/// along x of another outline.
#[derive(Clone, Debug)]
pub enum NestForm {
    /// A rectangle of this width and height, mm.
    Rectangle([f64; 2]),
    /// A roll of this width, mm, along x.
    Roll(f64),
    /// Corners, counter-clockwise, mm.
    Outline(Vec<Point2>),
}

/// How parts are laid out.
#[derive(Clone, Copy, Debug)]
pub struct NestOptions {
    /// The least distance between two parts, mm.
    pub gap_mm: f64,
    /// The least distance of a part from the edge of a sheet, mm.
    pub margin_mm: f64,
    /// Whether equal parts lie side by side, the gap apart, so that one cut parts two.
    pub has_common_lines: bool,
    /// The work that may be done, as a multiple of the default.
    pub effort: f64,
}

/// Where a part lies on its sheet: turned over, top to bottom, if `is_over`, then turned by `turn`
/// about the origin, then moved by `shift`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// The part, by its number.
    pub part: usize,
    /// Which of several equal ones, from 0.
    pub copy: usize,
    /// The sheet, by its number in [`Nest::sheets`].
    pub sheet: usize,
    /// Whether it is turned over.
    pub is_over: bool,
    /// Radians.
    pub turn: f64,
    /// Mm.
    pub shift: Vec2,
}

impl Placement {
    /// Where a point of the part lies on the sheet.
    pub fn lay(&self, p: Point2) -> Point2 {
        Point2::default() + self.turned(p.to_vec()) + self.shift
    }

    /// A direction on the part as it is on the sheet.
    pub fn turned(&self, way: Vec2) -> Vec2 {
        let y = if self.is_over { -way.y } else { way.y };
        let (sin, cos) = (sin(self.turn), cos(self.turn));
        Vec2::new(cos * way.x - sin * y, sin * way.x + cos * y)
    }
}

/// A sheet that parts are cut from.
#[derive(Clone, Debug, PartialEq)]
pub struct UsedSheet {
    /// Its kind, by its number.
    pub kind: usize,
    /// Its width and height, mm; of a roll, the length that is used and the width.
    pub size: [f64; 2],
    /// The area of the parts on it, mm².
    pub used_mm2: f64,
}

/// Parts on sheets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Nest {
    /// Where each part lies, in the order of the parts; those that fit no sheet are not among them.
    pub placements: Vec<Placement>,
    /// The sheets, in order.
    pub sheets: Vec<UsedSheet>,
    /// Parts, by their numbers, that are larger than any sheet.
    pub too_large: Vec<usize>,
    /// Parts, by their numbers, for which no sheet is left.
    pub left_over: Vec<usize>,
}

/// The steps of the default effort.
const STEPS: f64 = 6e8;
/// What parts are grown by beyond half the gap, so that rounding does not cost the gap, mm.
const SAFE_MM: f64 = 1e-4;
/// By how much parts may lie nearer to the edge of a sheet than the margin says, mm, so that a part
/// of the very size of a sheet has room.
const EDGE_MM: f64 = 1e-3;
/// Forms with fewer corners have so much more area, as a share.
const COARSE: f64 = 0.002;

/// Lays parts out. `watch` hears how much of the work is done and may end it; the best layout so
/// far then counts.
pub fn nest(
    parts: &[NestPart],
    sheets: &[NestSheet],
    options: NestOptions,
    watch: &mut dyn Watch,
) -> Nest {
    match options.has_common_lines {
        true => blocks::in_blocks(parts, sheets, options, watch),
        false => laid_out(parts, sheets, options, watch),
    }
}

/// Lays parts out by themselves.
fn laid_out(
    parts: &[NestPart],
    sheets: &[NestSheet],
    options: NestOptions,
    watch: &mut dyn Watch,
) -> Nest {
    let whole = (STEPS * options.effort).max(1.0) as i64;
    let mut stop = |left: i64| {
        watch.progress(1.0 - left.max(0) as f64 / whole as f64);
        watch.stop()
    };
    let mut budget = Budget { left: whole, stop: &mut stop };
    let mut random = Random::new(1);
    let grow = 0.5 * options.gap_mm + SAFE_MM;
    let kinds = Kinds::new(sheets, options.margin_mm - 0.5 * options.gap_mm - EDGE_MM);
    let shapes = shapes(parts, &kinds, grow, &mut budget, &mut random);
    let mut items = Vec::new();
    let mut of_item = Vec::new();
    let mut too_large = Vec::new();
    for (part, it) in parts.iter().enumerate() {
        let Some(shape) = shapes.of_part[part] else {
            too_large.push(part);
            continue;
        };
        for copy in 0..it.count {
            items.push(Item { shape, turns: it.turns.clone(), group: it.group });
            of_item.push((part, copy));
        }
    }
    let mut state = State::new(&shapes.list, &items);
    let mut laid = sheets::Laid::new(&kinds);
    let left_over = laid.fill(&mut state, &mut budget, &mut random);
    laid.improve(&mut state, &mut budget, &mut random);
    let mut left_over: Vec<usize> = left_over.iter().map(|&item| of_item[item].0).collect();
    left_over.dedup();
    result(&state, &laid, &of_item, Nest { too_large, left_over, ..Nest::default() })
}

/// The forms of all parts, those of equal parts once.
struct Shapes {
    list: Vec<Shape>,
    /// The form of each part; `None`: it fits on no sheet.
    of_part: Vec<Option<usize>>,
}

fn shapes(
    parts: &[NestPart],
    kinds: &Kinds<'_>,
    grow: f64,
    budget: &mut Budget<'_>,
    random: &mut Random,
) -> Shapes {
    let mut shapes = Shapes { list: Vec::new(), of_part: Vec::new() };
    for (n, part) in parts.iter().enumerate() {
        let known = parts[..n]
            .iter()
            .position(|other| other.loops == part.loops && other.turns == part.turns);
        if let Some(known) = known {
            shapes.of_part.push(shapes.of_part[known]);
            continue;
        }
        let mut found = None;
        // What is truer may fit where what is not does not, but takes longer to lay.
        for trueness in [Trueness::Coarse(COARSE), Trueness::Fine, Trueness::Boxed] {
            let shape = Shape::new(&part.loops, grow, trueness);
            if kinds.fit(&shape, &part.turns, budget, random) {
                found = Some(shapes.list.len());
                shapes.list.push(shape);
                break;
            }
        }
        shapes.of_part.push(found);
    }
    shapes
}

/// The layout in the coordinates of parts and sheets.
fn result(
    state: &State<'_>,
    laid: &sheets::Laid<'_>,
    of_item: &[(usize, usize)],
    mut nest: Nest,
) -> Nest {
    let mut number = vec![usize::MAX; state.rooms.len()];
    for sheet in 0..state.rooms.len() {
        if state.on[sheet].is_empty() {
            continue;
        }
        number[sheet] = nest.sheets.len();
        let kind = laid.kind(sheet);
        let size = laid.size(state, sheet);
        nest.sheets.push(UsedSheet { kind, size, used_mm2: state.area(sheet) });
    }
    for (item, pose) in state.poses.iter().enumerate() {
        let Some(Pose { sheet, at, turn, is_over }) = *pose else { continue };
        let (part, copy) = of_item[item];
        let sheet_number = number[sheet];
        let mut it =
            Placement { part, copy, sheet: sheet_number, is_over, turn, shift: Vec2::ZERO };
        let middle = it.turned(state.shape(item).middle.to_vec());
        it.shift = at.to_vec() - middle;
        // Upright sheets lie on their side while they are filled.
        if laid.is_upright(sheet) {
            let width = nest.sheets[sheet_number].size[0];
            it.turn += FRAC_PI_2;
            it.shift = Vec2::new(width - it.shift.y, it.shift.x);
        }
        nest.placements.push(it);
    }
    nest
}

/// The room on a rectangle of this size, `inset` mm from its edges.
fn rectangle([width, height]: [f64; 2], inset: f64) -> Room {
    Room::new(Vec2::splat(inset), Vec2::new(width - inset, height - inset), Vec::new())
}
