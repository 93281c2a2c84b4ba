//! What stands on which page: parts that share pages, parts on several sheets, and those that are
//! too large.

use super::drawn::drawn_around;
use super::packing::{Placed, SharedPage, SmallPart, in_room, is_small, pages_of};
use super::paper::Paper;
use super::tiling::{Tiling, tiling};
use super::{MaxSheets, PdfOptions, Reduced, offsets};
use sheetwright::math::Vec2;
use sheetwright::pattern::Piece;
use sheetwright::predicate::Box2;

/// How a piece is laid out on paper.
pub(super) enum Plan {
    /// On sheets of its own.
    Tiled(Tiling),
    /// On one page, smaller than it is.
    Reduced(Reduced),
    /// With others, on the shared page of this number, from 0.
    Shared(usize),
    /// With all others, on the first page.
    OnFirst,
}

/// The pages of one piece, or a page of several.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Leaves {
    Piece(usize),
    Shared(usize),
}

/// All that is laid out.
pub(super) struct Layout<'a> {
    pub(super) title: &'a str,
    pub(super) paper: Paper,
    pub(super) pieces: &'a [&'a Piece],
    /// The box around what is drawn of each piece, mm.
    pub(super) boxes: Vec<Box2>,
    pub(super) plans: Vec<Plan>,
    pub(super) shared: Vec<SharedPage>,
    /// The pieces on the first page, where all of them have room below its head.
    pub(super) on_first: Vec<Placed>,
}

impl<'a> Layout<'a> {
    /// The layout of some pieces; `first_room` is what the first page has left below its head, mm.
    pub(super) fn new(
        title: &'a str,
        pieces: &'a [&'a Piece],
        options: &PdfOptions,
        first_room: Vec2,
    ) -> Self {
        let PdfOptions { paper, max_sheets } = *options;
        let boxes: Vec<Box2> = pieces.iter().map(|piece| drawn_around(piece)).collect();
        let size = |part: usize| boxes[part].max - boxes[part].min;
        let small = (0..pieces.len()).map(|part| SmallPart { part, size: size(part) });
        let small: Vec<SmallPart> = small.filter(|small| is_small(small.size, paper)).collect();
        let all_on_first = || in_room(&small, first_room).unwrap_or_default();
        let on_first = match small.len() == pieces.len() && !paper.is_projected() {
            true => all_on_first(),
            false => Vec::new(),
        };
        let mut layout =
            Self { title, paper, pieces, boxes, plans: Vec::new(), shared: Vec::new(), on_first };
        if layout.on_first.is_empty() {
            layout.shared = pages_of(&small, paper);
            // A piece alone on its page has the frame and the crosses of a sheet.
            layout.shared.retain(|page| page.parts.len() > 1 || paper.is_projected());
        }
        layout.plans = layout.plan(max_sheets);
        layout
    }

    fn plan(&self, max_sheets: MaxSheets) -> Vec<Plan> {
        let mut shared_by: Vec<Option<usize>> = vec![None; self.pieces.len()];
        for (n, page) in self.shared.iter().enumerate() {
            for placed in &page.parts {
                shared_by[placed.part] = Some(n);
            }
        }
        let mut room = MaxSheets::MOST.get().saturating_sub(self.shared.len());
        let mut plan = |(panel, piece): (usize, &&Piece)| {
            if !self.on_first.is_empty() {
                return Plan::OnFirst;
            }
            if let Some(page) = shared_by[panel] {
                return Plan::Shared(page);
            }
            match tiling(piece, self.paper, room.min(max_sheets.get())) {
                Ok(tiling) => {
                    room -= tiling.sheets.len();
                    Plan::Tiled(tiling)
                }
                Err(sheets) => {
                    let scale = offsets::scale(piece, self.paper);
                    let file_full = sheets <= max_sheets.get() as u64;
                    Plan::Reduced(Reduced { panel, sheets, scale, file_full })
                }
            }
        };
        self.pieces.iter().enumerate().map(&mut plan).collect()
    }

    /// The pages after the overview, in the order of the design: a shared page stands where the
    /// first of its pieces does.
    pub(super) fn order(&self) -> Vec<Leaves> {
        let mut order = Vec::new();
        for (n, plan) in self.plans.iter().enumerate() {
            match plan {
                Plan::Tiled(_) | Plan::Reduced(_) => order.push(Leaves::Piece(n)),
                Plan::Shared(page) if self.shared[*page].parts[0].part == n => {
                    order.push(Leaves::Shared(*page));
                }
                Plan::Shared(_) | Plan::OnFirst => {}
            }
        }
        order
    }

    /// How many pages some leaves are.
    pub(super) fn pages(&self, leaves: Leaves) -> usize {
        match leaves {
            Leaves::Shared(_) => 1,
            Leaves::Piece(n) => match &self.plans[n] {
                Plan::Tiled(tiling) => tiling.sheets.len(),
                Plan::Reduced(_) | Plan::Shared(_) | Plan::OnFirst => 1,
            },
        }
    }
}
