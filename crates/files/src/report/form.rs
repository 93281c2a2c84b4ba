//! How much `report.html` shows: of many panels a table with thumbnails, since a page with all
//! their pictures has many megabytes and is hard to read.

use super::canvas::{PathData, Picture};
use super::verdict::{findings, severity, verdict};
use crate::space::simplified;
use maud::{Markup, PreEscaped, html};
use sheetwright::check::{Checked, Severity, Verdict};
use sheetwright::math::Point2;
use sheetwright::pattern::Piece;

/// How much `report.html` shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ReportForm {
    /// Everything of up to 100 panels, a table of more.
    #[default]
    Auto,
    /// A table of all panels with thumbnails of their patterns, and the findings.
    Short,
    /// Everything of every panel.
    Long,
}

impl ReportForm {
    /// The most panels of a report that is long by default.
    const MOST_LONG: usize = 100;

    /// Its name in commands.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Short => "short",
            Self::Long => "long",
        }
    }

    /// Whether the report of this number of panels is short.
    pub const fn is_short(self, panels: usize) -> bool {
        match self {
            Self::Auto => panels > Self::MOST_LONG,
            Self::Short => true,
            Self::Long => false,
        }
    }
}

/// A panel in the short form.
pub(super) struct Row<'a> {
    pub(super) name: &'a str,
    pub(super) piece: &'a Piece,
    pub(super) checked: &'a Checked,
    /// The values under the labels.
    pub(super) values: Vec<String>,
}

/// All panels in the short form: the number of panels with each verdict, and a table, the worst
/// first.
pub(super) fn short(labels: &[&str], rows: Vec<Row<'_>>) -> Markup {
    let mut order: Vec<usize> = (0..rows.len()).collect();
    order.sort_by_key(|&n| std::cmp::Reverse(severity(rows[n].checked)));
    html! {
        (counts(&rows))
        p.sub {
            "This is the short form of the report. Panels with errors and warnings come first. For \
             pictures of every panel, choose the long form when you make the report."
        }
        table.summary.short {
            caption { "All panels" }
            thead {
                tr {
                    th scope="col" { "Pattern" }
                    th scope="col" { "Panel" }
                    th scope="col" { "Verdict" }
                    @for label in labels { th scope="col" { (label) } }
                }
            }
            tbody {
                @for row in order.iter().map(|&n| &rows[n]) {
                    tr {
                        td data-label="Pattern" { (PreEscaped(thumbnail(row.piece).inline())) }
                        th scope="row" { (row.name) }
                        td data-label="Verdict" {
                            (verdict(row.checked))
                            @if severity(row.checked) > Severity::Note { (findings(row.checked)) }
                        }
                        @for (label, value) in labels.iter().zip(&row.values) {
                            td data-label=(label) { (value) }
                        }
                    }
                }
            }
        }
    }
}

/// The number of panels with each verdict, the best verdict first.
fn counts(rows: &[Row<'_>]) -> Markup {
    let all = [
        (Verdict::Bends, "bend"),
        (Verdict::BendsAndFolds, "bend and fold"),
        (Verdict::BendsWithForce, "bend with force"),
        (Verdict::Roll, "must be rolled or formed"),
        (Verdict::Undecided, "can't be told"),
        (Verdict::WillNotBend, "will not bend"),
    ];
    let with = |verdict| rows.iter().filter(|row| row.checked.verdict == verdict).count();
    let found = all.map(|(verdict, words)| (with(verdict), words));
    let told: Vec<String> = found
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, words)| format!("{count} {words}"))
        .collect();
    let errors = rows.iter().filter(|row| severity(row.checked) == Severity::Error).count();
    html! {
        p {
            strong { "Of " (rows.len()) " panels " (told.join(", ")) "." }
            @if errors > 0 { " Do not cut " (errors) " of them as they are." }
        }
    }
}

/// The outline of a pattern, small.
fn thumbnail(piece: &Piece) -> Picture {
    const SIZE: Point2 = Point2::new(96.0, 48.0);
    const EDGE: f64 = 2.0;
    /// The largest distance of a point left out from the outline, in units of the picture.
    const SEEN: f64 = 0.15;
    let room = Point2::new(SIZE.x - 2.0 * EDGE, SIZE.y - 2.0 * EDGE);
    let scale = (room.x / piece.size.x.max(1e-12)).min(room.y / piece.size.y.max(1e-12));
    let (left, bottom) =
        (0.5 * (SIZE.x - scale * piece.size.x), 0.5 * (SIZE.y + scale * piece.size.y));
    let mut path = PathData::default();
    for line in piece.loops() {
        let place = |p: &Point2| {
            let at = *p - piece.corner;
            Point2::new(left + scale * at.x, bottom - scale * at.y)
        };
        path.ring(simplified(&line.iter().map(place).collect::<Vec<_>>(), SEEN));
    }
    let title = format!("{} laid flat", piece.name);
    Picture::new(SIZE.x, SIZE.y, title, path.element("sheet thin cut"))
}
