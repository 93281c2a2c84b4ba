//! Patterns as PDF, true to scale, tiled to sheets of paper.
//!
//! First comes an overview: every piece with its sheets, and a square of 100 mm to measure. Then
//! come the sheets, piece after piece. A piece above the limit of sheets is drawn on one page
//! instead, to a smaller scale that the page states, with a table of offsets for marking it out.

mod labels;
mod offsets;
mod overview;
mod page;
mod piece;
mod sheets;
mod text;
mod tiling;

use miniz_oxide::deflate::compress_to_vec_zlib;
use page::PdfPage;
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, TextStr};
use sheetwright::check::{Finding, FindingKind};
use sheetwright::make::Made;
use sheetwright::math::Vec2;
use sheetwright::pattern::Piece;
use tiling::Tiling;

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

    /// Its name in commands.
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

    /// The largest piece that one sheet of it shows whole, mm, the longer side first.
    pub fn whole_piece_mm(self) -> [f64; 2] {
        tiling::whole_mm(self)
    }

    /// Its name on printed sheets.
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PdfOptions {
    /// The size of a sheet. Default: A4.
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
    pub sheets: usize,
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
pub(crate) fn way_to_sheets(sheets: usize, is_full: bool) -> Option<String> {
    let way = if is_full {
        "To print it true to scale, make it in a design of its own.".to_owned()
    } else {
        format!("To print it true to scale, allow {sheets} sheets.")
    };
    (sheets <= MaxSheets::MOST.get()).then_some(way)
}

/// How a piece is laid out on paper.
enum Plan {
    Tiled(Tiling),
    Reduced(Reduced),
}

/// The PDF of all pieces of a design. `docs/outputs.md` specifies it for readers.
pub fn write_pdf(made: &Made, options: &PdfOptions) -> WrittenPdf {
    let pieces: Vec<&Piece> = made.parts.iter().map(|part| &part.piece).collect();
    write_pieces(&made.name, &pieces, options)
}

/// The PDF of some pieces under a title.
pub(crate) fn write_pieces(title: &str, pieces: &[&Piece], options: &PdfOptions) -> WrittenPdf {
    let PdfOptions { paper, max_sheets } = *options;
    let mut room = MaxSheets::MOST.get();
    let mut plans = Vec::with_capacity(pieces.len());
    for (panel, piece) in pieces.iter().enumerate() {
        plans.push(match tiling::tiling(piece, paper, room.min(max_sheets.get())) {
            Ok(tiling) => {
                room -= tiling.sheets.len();
                Plan::Tiled(tiling)
            }
            Err(sheets) => {
                let scale = offsets::scale(piece, paper);
                let file_full = sheets <= max_sheets.get();
                Plan::Reduced(Reduced { panel, sheets, scale, file_full })
            }
        });
    }
    let overview = overview::pages(title, pieces, &plans, paper);
    let each = pieces.iter().zip(&plans);
    let pages =
        overview.into_iter().chain(each.flat_map(|(piece, plan)| pages(piece, plan, paper)));
    let reduced = plans.iter().filter_map(|plan| match plan {
        Plan::Tiled(_) => None,
        Plan::Reduced(reduced) => Some(*reduced),
    });
    WrittenPdf { bytes: document(title, pages), reduced: reduced.collect() }
}

/// The pages of a piece, each drawn when the iterator reaches it.
fn pages<'a>(
    piece: &'a Piece,
    plan: &'a Plan,
    paper: Paper,
) -> Box<dyn Iterator<Item = PdfPage> + 'a> {
    match plan {
        Plan::Tiled(tiling) => Box::new(sheets::pages(piece, tiling)),
        Plan::Reduced(reduced) => Box::new(std::iter::once(offsets::page(piece, reduced, paper))),
    }
}

/// The PDF file of the pages, which it takes one after the other.
fn document(title: &str, pages: impl Iterator<Item = PdfPage>) -> Vec<u8> {
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
