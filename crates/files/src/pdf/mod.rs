//! Patterns as PDF, true to scale, on sheets of paper, a roll or for a projector.
//!
//! First comes an overview: every piece with its sheets, and a square of 100 mm to measure. Then
//! come the sheets, in the order of the design: small pieces share pages, larger ones are tiled. If
//! all pieces have room below the check square, they stand there. A piece above the limit of sheets
//! is drawn on one page instead, to a smaller scale that the page states, with a table of offsets
//! for marking it out.

mod drawn;
mod labels;
mod layout;
mod list;
mod offsets;
mod overview;
mod packing;
mod page;
mod paper;
mod piece;
mod shared;
mod sheets;
mod text;
mod tiling;

pub use paper::{Paper, RollWidth};

use layout::{Layout, Leaves, Plan};
use miniz_oxide::deflate::compress_to_vec_zlib;
pub(crate) use offsets::corners;
pub(crate) use page::{Anchor, PdfPage, Pen, Type};
pub(crate) use piece::{Detail, PaperView, draw};
pub(crate) use text::{shortened, text_mm, wrapped};

use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, TextStr};
use sheetwright::check::{Finding, FindingKind};
use sheetwright::make::Made;
use sheetwright::pattern::Piece;

/// The most sheets of a piece; a piece that takes more is drawn to a smaller scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct MaxSheets(usize);

impl MaxSheets {
    /// The most sheets of one PDF, of all pieces together: a file of about 22 MB, and 40 reams of
    /// paper.
    pub const MOST: Self = Self(20_000);

    /// From 1 to [`MaxSheets::MOST`] sheets; `None` for other numbers.
    pub fn new(sheets: usize) -> Option<Self> {
        (1..=Self::MOST.0).contains(&sheets).then_some(Self(sheets))
    }

    /// The number of sheets.
    pub const fn get(self) -> usize {
        self.0
    }
}

/// 2,000: a PDF is true to scale for everything that fits a workshop, such as the planks of a
/// vessel 20 m long, in a file of a few MB.
impl Default for MaxSheets {
    fn default() -> Self {
        Self(2_000)
    }
}

/// How patterns are laid out on paper.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PdfOptions {
    /// What they are printed on. Default: A4.
    pub paper: Paper,
    /// The most sheets of a piece. Default: 2,000.
    pub max_sheets: MaxSheets,
}

/// The level of compression of pages, up to 10. Sheets repeat much, so they shrink to about a
/// quarter at every level.
const COMPRESSION: u8 = 6;

/// A written PDF.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenPdf {
    /// The file.
    pub bytes: Vec<u8>,
    /// The panels that it shows to a smaller scale.
    pub reduced: Vec<Reduced>,
}

/// A panel that would take too many sheets, so that it is drawn to a smaller scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reduced {
    /// Its number among the panels, from 0.
    pub panel: usize,
    /// An upper bound on the sheets that it takes at 1:1: those that cover its bounding rectangle.
    /// With this limit it is tiled, unless the file is full.
    pub sheets: u64,
    /// The denominator of the scale, such as 400 for 1:400.
    pub scale: f64,
    /// Whether it is within the limit of sheets of a piece, but the panels before it leave too few
    /// of the [`MaxSheets::MOST`] sheets of the file.
    pub file_full: bool,
}

impl Reduced {
    /// The finding that the PDF shows the panel smaller than it is.
    pub(crate) fn finding(&self) -> Finding {
        let Self { sheets, scale, file_full: is_full, .. } = *self;
        let most = MaxSheets::MOST.get();
        Finding::of_whole(FindingKind::PdfReduced { sheets, scale, most, is_full })
    }
}

/// How to print a panel of this number of sheets true to scale, in a sentence; `is_full` if the
/// panels before it leave too few sheets. `None` for more sheets than a PDF may have.
pub(crate) fn way_to_sheets(sheets: u64, is_full: bool) -> Option<String> {
    let way = if is_full {
        "To print it true to scale, make it in a design of its own.".to_owned()
    } else {
        format!("To print it true to scale, allow {sheets} sheets.")
    };
    (sheets <= MaxSheets::MOST.get() as u64).then_some(way)
}

/// The PDF of all pieces of a design. `docs/outputs.md` specifies it for readers.
pub fn write_pdf(made: &Made, options: &PdfOptions) -> WrittenPdf {
    let pieces: Vec<&Piece> = made.parts.iter().map(|part| &part.piece).collect();
    write_pieces(&made.name, &pieces, options)
}

/// The PDF of some pieces under a title.
pub(crate) fn write_pieces(title: &str, pieces: &[&Piece], options: &PdfOptions) -> WrittenPdf {
    let layout = Layout::new(title, pieces, options, overview::first_room(options.paper));
    // What a projector shows is looked at as it is.
    let overview = match options.paper.is_projected() {
        true => Vec::new(),
        false => overview::pages(&layout),
    };
    let order = layout.order();
    let leaves = order.into_iter().flat_map(|leaves| pages(&layout, leaves));
    let bytes = document(title, overview.into_iter().chain(leaves));
    let reduced = layout.plans.iter().filter_map(|plan| match plan {
        Plan::Reduced(reduced) => Some(*reduced),
        Plan::Tiled(_) | Plan::Shared(_) | Plan::OnFirst => None,
    });
    WrittenPdf { bytes, reduced: reduced.collect() }
}

/// Some pages, each drawn when the iterator reaches it.
fn pages<'a>(layout: &'a Layout<'_>, leaves: Leaves) -> Box<dyn Iterator<Item = PdfPage> + 'a> {
    let one = std::iter::once;
    let n = match leaves {
        Leaves::Shared(n) => return Box::new(one(shared::page(layout, &layout.shared[n]))),
        Leaves::Piece(n) => n,
    };
    let piece = layout.pieces[n];
    match &layout.plans[n] {
        Plan::Tiled(tiling) => Box::new(sheets::pages(piece, tiling)),
        Plan::Reduced(reduced) => Box::new(one(offsets::page(piece, reduced, layout.paper))),
        Plan::Shared(_) | Plan::OnFirst => Box::new(std::iter::empty()),
    }
}

/// The PDF file of the pages, which it takes one after the other.
pub(crate) fn document(title: &str, pages: impl Iterator<Item = PdfPage>) -> Vec<u8> {
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
    let mut kids = Vec::new();
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
        let content = compress_to_vec_zlib(&content, COMPRESSION);
        pdf.stream(content_id, &content).filter(Filter::FlateDecode);
    }
    let count = i32::try_from(kids.len()).unwrap_or(i32::MAX);
    pdf.pages(tree).kids(kids).count(count);
    pdf.finish()
}
