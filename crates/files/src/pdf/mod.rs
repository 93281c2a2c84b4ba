//! Patterns as PDF, true to scale, tiled to sheets of paper.
//!
//! First comes an overview: every piece with its sheets, and a square of 100 mm to measure. Then
//! come the sheets, piece after piece. A piece that would take more sheets than anyone tapes
//! together is drawn on one page instead, to a smaller scale that is stated, with a table of
//! offsets to mark it out by.

mod offsets;
mod overview;
mod page;
mod piece;
mod sheets;
mod text;

use page::Page;
use pdf_writer::{Finish, Name, Pdf, Rect, Ref, TextStr};
use sheets::Tiling;
use sheetwright::design::Made;
use sheetwright::math::Vec2;

/// A size of paper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Paper {
    /// 210 × 297 mm.
    #[default]
    A4,
    /// 8.5 × 11 inches.
    Letter,
}

impl Paper {
    /// Every size.
    pub const ALL: [Self; 2] = [Self::A4, Self::Letter];

    /// How people ask for it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::A4 => "a4",
            Self::Letter => "letter",
        }
    }

    /// The paper of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|paper| paper.name() == name)
    }

    /// How it is printed on its sheets.
    const fn title(self) -> &'static str {
        match self {
            Self::A4 => "A4",
            Self::Letter => "Letter",
        }
    }

    /// Its width and height upright, mm.
    const fn size_mm(self) -> Vec2 {
        match self {
            Self::A4 => Vec2::new(210.0, 297.0),
            Self::Letter => Vec2::new(215.9, 279.4),
        }
    }
}

/// A written PDF.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenPdf {
    /// The file.
    pub bytes: Vec<u8>,
    /// The panels that it shows smaller than they are.
    pub reduced: Vec<Reduced>,
}

/// A panel that would take too many sheets, so that it is drawn to a smaller scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reduced {
    /// Its number among the panels, from 0.
    pub panel: usize,
    /// About how many sheets it would take: those that its bounding rectangle takes.
    pub sheets: usize,
    /// The scale, as 400 of 1:400.
    pub scale: f64,
}

/// A piece may take so many sheets: taped together for a day, they are as long as a bus.
pub const MAX_SHEETS: usize = 200;

/// How a piece comes to paper.
enum Plan {
    Tiled(Tiling),
    Reduced(Reduced),
}

/// The PDF of all pieces of a design. `docs/outputs.md` says what a reader may rely on.
pub fn write_pdf(made: &Made, paper: Paper) -> WrittenPdf {
    let plans: Vec<Plan> = made
        .panels
        .iter()
        .enumerate()
        .map(|(panel, made)| match sheets::tiling(&made.piece, paper) {
            Ok(tiling) => Plan::Tiled(tiling),
            Err(sheets) => {
                let scale = offsets::scale(&made.piece, paper);
                Plan::Reduced(Reduced { panel, sheets, scale })
            }
        })
        .collect();
    let mut pages = overview::pages(made, &plans, paper);
    for (panel, plan) in made.panels.iter().zip(&plans) {
        match plan {
            Plan::Tiled(tiling) => pages.extend(sheets::pages(&panel.piece, tiling)),
            Plan::Reduced(reduced) => pages.push(offsets::page(&panel.piece, reduced, paper)),
        }
    }
    let reduced = plans.iter().filter_map(|plan| match plan {
        Plan::Tiled(_) => None,
        Plan::Reduced(reduced) => Some(*reduced),
    });
    WrittenPdf { bytes: document(&made.name, pages), reduced: reduced.collect() }
}

/// The file that holds the pages.
fn document(title: &str, pages: Vec<Page>) -> Vec<u8> {
    let mut free = 1..;
    let mut id = || Ref::new(free.next().unwrap_or(i32::MAX));
    let (catalog, tree, info, regular, bold) = (id(), id(), id(), id(), id());
    let mut pdf = Pdf::new();
    let mut root = pdf.catalog(catalog);
    root.pages(tree);
    // Asks printing dialogues to begin with "actual size".
    root.viewer_preferences().pair(Name(b"PrintScaling"), Name(b"None"));
    root.finish();
    pdf.document_info(info).title(TextStr(title)).creator(TextStr("Sheetwright"));
    for (font, name) in [(regular, &b"Helvetica"[..]), (bold, b"Helvetica-Bold")] {
        pdf.type1_font(font).base_font(Name(name)).encoding_predefined(Name(b"WinAnsiEncoding"));
    }
    let mut kids = Vec::with_capacity(pages.len());
    for page in pages {
        let (size, content) = page.finish();
        let (page_id, content_id) = (id(), id());
        kids.push(page_id);
        let mut written = pdf.page(page_id);
        written
            .parent(tree)
            .media_box(Rect::new(0.0, 0.0, page::points(size.x), page::points(size.y)))
            .contents(content_id);
        let mut resources = written.resources();
        resources.fonts().pair(page::REGULAR, regular).pair(page::BOLD, bold);
        resources.finish();
        written.finish();
        pdf.stream(content_id, &content);
    }
    let count = i32::try_from(kids.len()).unwrap_or(i32::MAX);
    pdf.pages(tree).kids(kids).count(count);
    pdf.finish()
}
