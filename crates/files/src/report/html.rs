//! `report.html`: the report for people, one file that works offline.

use super::flat_picture::{Tagged, edges, flat_picture, outline_length};
use super::form::{ReportForm, Row, short};
use super::gauss_picture::gauss_picture;
use super::moved_picture::{enlarged, moved_picture};
use super::space_picture::{design_picture, surface_picture};
use super::style::page_style;
use super::verdict::{findings, severity, verdict};
use super::view::box_of;
use super::warp_chart::warp_chart;
use super::wording::{
    area, decimal, degrees, millimetres, millimetres_fine, per_cent, radius, refold, scientific,
    steradians, verdict_sentence, verdict_word,
};
use super::worst_rung;
use crate::words::finding_text;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use sheetwright::check::Checked;
use sheetwright::make::{Made, MadePanel};
use sheetwright::material::{Material, warp_limit_deg};
use sheetwright::math::{from_deg, to_deg};
use sheetwright::measure::RungMeasures;
use sheetwright::pattern::seam_mark;
use sheetwright::triangulate::Goal;
use std::collections::BTreeSet;

/// `report.html` of a made design. `refold_error_mm` and `checked` have one entry a panel; a refold
/// error that is not finite says that the written pattern could not be read back.
///
/// # Panics
/// Unless there is one entry a panel.
pub fn report_html(
    made: &Made,
    refold_error_mm: &[f64],
    checked: &[Checked],
    form: ReportForm,
) -> Vec<u8> {
    assert_eq!(made.panels.len(), refold_error_mm.len(), "one refold error a panel");
    assert_eq!(made.panels.len(), checked.len(), "one verdict a panel");
    let each = made.panels.iter().zip(refold_error_mm).zip(checked).enumerate();
    let pages: Vec<Page<'_>> = each
        .map(|(n, ((panel, &refold_error_mm), checked))| Page {
            made,
            number: n + 1,
            panel,
            refold_error_mm,
            checked,
            material: made.material.as_ref(),
        })
        .collect();
    let is_short = form.is_short(pages.len());
    document(
        &made.name,
        html! {
            h1 { (made.name) }
            p.sub { (subtitle(made)) }
            @if !is_short {
                ul.cards {
                    @for page in &pages { (card(page.number, &page.panel.name, page.checked)) }
                }
            }
            @if made.panels.len() > 1 {
                figure.whole {
                    (PreEscaped(design_picture(made).inline()))
                    figcaption { "All panels in space, with their rulings." }
                }
            }
            @if is_short {
                (short(&SUMMARY, pages.iter().map(Page::row).collect()))
            } @else {
                (summary(&SUMMARY, pages.iter().map(|p| (&p.panel.name[..], p.summary()))))
                @for page in &pages { (page.section()) }
            }
        },
    )
}

/// What a browser may do for the page: take its own style sheet, and nothing else. No text of a
/// design, whatever it holds, can run or fetch anything.
const POLICY: &str =
    "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

/// The page of a design: what its body shows, with the head that every report has.
pub(super) fn document(name: &str, body: Markup) -> Vec<u8> {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (name) " – Sheetwright report" }
                style { (PreEscaped(page_style())) }
            }
            body { main { (body) } }
        }
    };
    let mut bytes = page.into_string().into_bytes();
    bytes.push(b'\n');
    bytes
}

fn subtitle(made: &Made) -> String {
    let panels = match made.panels.len() {
        1 => "1 panel".to_owned(),
        n => format!("{n} panels"),
    };
    match &made.material {
        Some(m) => format!(
            "{panels} of {}: takes a warp of {}° and a bend radius of {}",
            m.title,
            decimal(m.warp_limit_deg.value, 1),
            millimetres(m.bend_radius_mm.value)
        ),
        None => format!(
            "{panels}, no material named: a warp of {}° is accepted, and any bend radius",
            decimal(warp_limit_deg(None), 1)
        ),
    }
}

/// The table of all panels: a row for the name of each with what stands under each label.
pub(super) fn summary<'a>(
    labels: &[&str],
    rows: impl Iterator<Item = (&'a str, Vec<String>)>,
) -> Markup {
    html! {
        table.summary {
            caption { "All panels" }
            thead {
                tr {
                    th scope="col" { "Panel" }
                    @for label in labels { th scope="col" { (label) } }
                }
            }
            tbody {
                @for (name, values) in rows {
                    tr {
                        th scope="row" { (name) }
                        @for (label, value) in labels.iter().zip(values) {
                            td data-label=(label) { (value) }
                        }
                    }
                }
            }
        }
    }
}

const SUMMARY: [&str; 6] = [
    "Flat size",
    "Area",
    "Warp, largest / mean",
    "Tightest bend radius",
    "Length error",
    "Refold error",
];

/// A warp that is shown as none, degrees: half of the last digit that is printed.
const NO_WARP_DEG: f64 = 0.005;

/// A panel with all that its part of the page shows.
struct Page<'a> {
    made: &'a Made,
    /// From 1.
    number: usize,
    panel: &'a MadePanel,
    refold_error_mm: f64,
    checked: &'a Checked,
    material: Option<&'a Material>,
}

impl Page<'_> {
    fn row(&self) -> Row<'_> {
        let Self { panel, checked, .. } = *self;
        Row { name: &panel.name, piece: &panel.piece, checked, values: self.summary() }
    }

    fn summary(&self) -> Vec<String> {
        let (measures, size) = (&self.panel.measures, self.panel.piece.size);
        vec![
            format!("{} × {}", millimetres(size.x), millimetres(size.y)),
            area(measures.area_flat_mm2),
            format!(
                "{} / {}",
                degrees(to_deg(measures.warp_max)),
                degrees(to_deg(measures.warp_mean))
            ),
            radius(measures.bend_radius_min_mm),
            per_cent(measures.length_error_max),
            refold(self.refold_error_mm),
        ]
    }

    fn section(&self) -> Markup {
        let (panel, material) = (self.panel, self.material);
        html! {
            section.panel id={ "panel-" (self.number) } {
                h2 { (panel.name) }
                p { (verdict(self.checked)) }
                p { (verdict_sentence(self.checked.verdict)) }
                (findings(self.checked))
                div.figures {
                    div.column {
                        figure.first {
                            (PreEscaped(surface_picture(panel, material).inline()))
                            figcaption { (self.space_caption()) }
                        }
                        @if let Some(gauss) = gauss_picture(panel, material) {
                            figure.fourth {
                                (PreEscaped(gauss.inline()))
                                figcaption { (gauss_caption(self.panel.measures.gauss_area_sr)) }
                            }
                        }
                    }
                    div.column {
                        figure.second {
                            (PreEscaped(flat_picture(panel, material).inline()))
                            (self.flat_caption())
                        }
                        @if let Some(chart) = warp_chart(panel, material) {
                            figure.third {
                                (PreEscaped(chart.inline()))
                                figcaption { (self.warp_caption()) }
                            }
                        } @else {
                            p.third { "One triangle is flat: there is nothing to bend." }
                        }
                    }
                }
                (self.before_and_after())
                (self.numbers())
            }
        }
    }

    /// What moving the boundary has changed, if it was to be moved.
    fn before_and_after(&self) -> Markup {
        let (panel, material) = (self.panel, self.material);
        let Some(change) = panel.change.as_ref() else { return html! {} };
        let before: &MadePanel = &change.before;
        let rows = [
            ("Verdict", [before, panel].map(|p| verdict_word(p.checked.verdict).to_owned())),
            ("Largest warp", [before, panel].map(|p| degrees(to_deg(p.measures.warp_max)))),
            ("Mean warp", [before, panel].map(|p| degrees(to_deg(p.measures.warp_mean)))),
            ("Twist, total", [before, panel].map(|p| scientific(p.measures.twist_total))),
            ("Price, total", [before, panel].map(|p| scientific(p.triangulation.price))),
        ];
        html! {
            h3 { "Before and after the boundary was moved" }
            p {
                "Samples moved by up to " (millimetres_fine(change.moved_max_mm())) ", by "
                (millimetres_fine(change.moved_total_mm())) " in sum: " (change.ended.to_string())
                "."
            }
            table.summary {
                thead { tr { th scope="col" {} th scope="col" { "Before" } th scope="col" { "After" } } }
                tbody {
                    @for (name, [was, is]) in rows {
                        tr {
                            th scope="row" { (name) }
                            td data-label="Before" { (was) }
                            td data-label="After" { (is) }
                        }
                    }
                }
            }
            @if let Some(picture) = moved_picture(panel) {
                div.figures {
                    div.column {
                        figure {
                            (PreEscaped(picture.inline()))
                            figcaption {
                                strong { "Where it moved. " }
                                "The boundary before (dark) and after (blue), with the way between "
                                (decimal(enlarged(change), 0)) " times as long as it is."
                            }
                        }
                    }
                    div.column {
                        @if let Some(chart) = warp_chart(before, material) {
                            figure {
                                (PreEscaped(chart.inline()))
                                figcaption { strong { "Warp before. " } "Above is the warp after." }
                            }
                        }
                    }
                }
            }
        }
    }

    /// Whether the panel is no flat plate.
    fn bends(&self) -> bool {
        self.panel.measures.rungs.iter().any(RungMeasures::bends)
    }

    fn space_caption(&self) -> Markup {
        let size = box_of(self.panel);
        html! {
            strong { "In space. " }
            @if self.bends() {
                "The thin lines are rulings, along which the sheet stays straight. "
            }
            "Blue is the side that the pattern shows, brown the other. It fills a box of "
            (millimetres(size.x)) " × " (millimetres(size.y)) " × " (millimetres(size.z))
            " (x, y, z)."
        }
    }

    fn flat_caption(&self) -> Markup {
        let (panel, edges) = (self.panel, edges(self.panel));
        // Both sides of a seam are one length.
        let mut seen = BTreeSet::new();
        html! {
            figcaption {
                strong { "Laid flat. " }
                "The outline to cut. "
                @if self.bends() {
                    "Short strokes mark where to lay the straightedge; dashed lines are folds. "
                }
                "The whole outline is " (millimetres(outline_length(self.panel)))
                " long."
                @if !panel.sheet.seams().is_empty() {
                    " It is cut open along " b { (seam_mark(0)) }
                    @if panel.sheet.seams().len() > 1 {
                        " to " b { (seam_mark(panel.sheet.seams().len() - 1)) }
                    }
                    ": join the sides that have the same mark."
                }
                @if !edges.is_empty() {
                    ul.edges {
                        @for edge in edges.iter().filter(|edge| seen.insert(&edge.letter)) {
                            li { b { (edge.letter) } " " (self.edge_text(edge)) }
                        }
                    }
                }
            }
        }
    }

    /// The name of an edge, how long it is, and what it is joined to.
    fn edge_text(&self, tagged: &Tagged<'_>) -> String {
        let length = millimetres(tagged.length_mm);
        let Some(edge) = tagged.edge else { return length };
        let mates = edge.mates.iter().map(|mate| &self.made.panels[mate.panel].name[..]);
        let mates: Vec<&str> = mates.collect();
        if mates.is_empty() {
            format!("{}, {length}", edge.name)
        } else {
            format!("{}, {length}, joined to {}", edge.name, mates.join(", "))
        }
    }

    /// Whether some ruling turns by more than the limit which may come from the sampling.
    fn is_unsure(&self) -> bool {
        let limit = from_deg(warp_limit_deg(self.material));
        let is_so = |r: &RungMeasures| r.warp > limit && r.warp_beyond_sampling() <= limit;
        self.panel.measures.rungs.iter().any(is_so)
    }

    fn warp_caption(&self) -> Markup {
        let measures = &self.panel.measures;
        html! {
            strong { "Warp. " }
            "How far the sheet twists from one end of each ruling to the other: the less, the \
             easier it bends. The dashed line is the limit of "
            (self.material.map_or("any sheet", |m| &m.title)) "."
            @if self.is_unsure() {
                " Dashed bars may be the bend from one sample to the next instead of twist: more \
                 samples would tell."
            }
            @if to_deg(measures.warp_max) < NO_WARP_DEG {
                " No ruling of this panel twists."
            } @else if let Some(worst) = worst_rung(measures) {
                " The largest, " (degrees(to_deg(measures.warp_max))) ", is at ruling "
                (worst + 1) " of " (measures.rungs.len()) "."
            }
        }
    }

    fn numbers(&self) -> Markup {
        let (panel, measures) = (self.panel, &self.panel.measures);
        let optimal = match panel.triangulation.gap() {
            Some(0.0) => "yes".to_owned(),
            Some(gap) => format!("within {:.2} %", 100.0 * gap),
            None => "not proven".to_owned(),
        };
        let goal = match panel.goal {
            Goal::Price => "price",
            Goal::WorstWarp => "worst warp, then price",
        };
        let rows: [(&str, String); 17] = [
            ("Samples", panel.boundary.len().to_string()),
            ("Triangles", panel.surface.connectivity().triangles().len().to_string()),
            ("Rulings (rungs)", measures.rungs.len().to_string()),
            ("Method", panel.method.name().to_owned()),
            ("Made least", goal.to_owned()),
            ("Best possible", optimal),
            ("Fold price ν", format!("{}", panel.fold)),
            ("Price, total", scientific(panel.triangulation.price)),
            ("Twist, total", scientific(measures.twist_total)),
            ("Largest crease", degrees(to_deg(measures.crease_max))),
            ("Tightest bend radius", radius(measures.bend_radius_min_mm)),
            ("Area of the Gauss image", steradians(measures.gauss_area_sr)),
            ("Area in space", area(measures.area_space_mm2)),
            ("Area of the pattern", area(measures.area_flat_mm2)),
            ("Length error, largest", scientific(measures.length_error_max)),
            ("Length error, mean", scientific(measures.length_error_mean)),
            ("Refold error", self.refold_number()),
        ];
        numbers(&rows)
    }

    fn refold_number(&self) -> String {
        if self.refold_error_mm.is_finite() {
            format!("{}\u{a0}mm", scientific(self.refold_error_mm))
        } else {
            refold(self.refold_error_mm)
        }
    }
}

/// The card of a panel, by its number from 1, which leads to its part of the page.
pub(super) fn card(number: usize, name: &str, checked: &Checked) -> Markup {
    html! {
        li class={ "card " (severity(checked).name()) } {
            div { a href={ "#panel-" (number) } { (name) } }
            (verdict(checked))
            p {
                @match checked.findings.first() {
                    Some(finding) => (finding_text(finding)),
                    None => "Nothing was found against it.",
                }
            }
        }
    }
}

/// A list of numbers with their names.
pub(super) fn numbers(rows: &[(&str, String)]) -> Markup {
    html! {
        h3 { "Numbers" }
        dl.numbers {
            @for (name, value) in rows { div { dt { (name) } dd { (value) } } }
        }
    }
}

fn gauss_caption(area_sr: f64) -> Markup {
    html! {
        strong { "Which way it faces. " }
        "Every direction is a point on a ball; each ruling is drawn from the direction at its one \
         end (blue) to that at its other (green). One thin curve: the sheet bends without \
         stretching. A ribbon or an area: it must stretch, the more the wider it is. Its area here is "
        (steradians(area_sr))
        ", of 12.57\u{a0}sr that the whole ball has; a little always comes from the sampling."
    }
}
