//! `report.html`: the report to read, one file that works offline.

use super::Written;
use super::brake_page::brake_plan;
use super::cut_page::{cut_from, cut_list};
use super::divided_page::divided;
use super::form::{ReportForm, Row, short};
use super::found_page::FoundPage;
use super::joined_page::joined_edges;
use super::mesh_page::MeshPage;
use super::page::{PartPage, table};
use super::sheets_page::sheets;
use super::space_picture::design_picture;
use super::style::page_style;
use super::verdict::{findings, severity, verdict};
use crate::wording::{
    area, decimal, degrees, millimetres, millimetres_small, per_cent, plain_per_cent, radius,
    refold, verdict_sentence,
};
use crate::words::finding_text;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use sheetwright::bend::Hit;
use sheetwright::check::Checked;
use sheetwright::make::{Made, Origin};
use sheetwright::material::stretch_limit;
use sheetwright::math::to_deg;

/// `report.html` of a made design. What was written has one entry for each part; a refold error
/// that is not finite means that the written pattern can't be read back. `plans` has the hits of
/// each part at the press brake, if they are to be shown.
///
/// # Panics
/// Unless there is one entry for each part.
pub fn report_html(
    made: &Made,
    written: &Written<'_>,
    form: ReportForm,
    plans: Option<&[Vec<Hit>]>,
) -> Vec<u8> {
    written.assert_complete(made);
    let page = |(n, part)| PartPage {
        made,
        number: n + 1,
        part,
        refold_error_mm: written.refold_errors_mm[n],
        checked: &written.checked[n],
        pattern: written.pattern_of(n),
        plan: plans.and_then(|plans| plans.get(n)).map(|hits| &hits[..]),
    };
    let pages: Vec<PartPage<'_>> = made.parts.iter().enumerate().map(page).collect();
    let columns = columns(&pages);
    let labels: Vec<&str> = columns.iter().map(|column| column.label).collect();
    let is_short = form.is_short(pages.len());
    document(
        &made.name,
        html! {
            h1 { (made.name) }
            p.sub { (subtitle(made)) }
            @if !is_short {
                ul.cards {
                    @for page in &pages { (card(page.number, &page.part.name, page.checked)) }
                }
            }
            @if made.parts.len() > 1 {
                figure.whole {
                    (PreEscaped(design_picture(made).inline()))
                    figcaption { "All panels in space, with their rulings, creases and cuts." }
                }
            }
            @if is_short {
                (short(&labels, pages.iter().map(|page| page.row(&columns)).collect()))
                (cut_list(made, written.patterns))
            } @else {
                (table(Some("All panels"), "Panel", &labels, pages.iter().map(|p| (&p.part.name[..], p.values(&columns)))))
                (cut_list(made, written.patterns))
                @for page in &pages { (page.section()) }
            }
            (divided(made))
            (sheets(made))
            (joined_edges(made))
        },
    )
}

/// The content security policy: a browser loads the page's own style sheet, and nothing else. No
/// text of a design can run or fetch anything.
const POLICY: &str =
    "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

/// The page of a design: `body` with the head that every report has.
fn document(name: &str, body: Markup) -> Vec<u8> {
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

/// The number of panels, their material and its limits.
fn subtitle(made: &Made) -> String {
    let meshes = made.parts.iter().filter(|part| part.given().is_some()).count();
    let count = made.parts.len();
    let panels = match (count, meshes == count) {
        (1, false) => "1 panel".to_owned(),
        (1, true) => "1 mesh panel".to_owned(),
        (n, false) => format!("{n} panels"),
        (n, true) => format!("{n} mesh panels"),
    };
    let stretch = plain_per_cent(stretch_limit(made.material.as_ref()));
    let thick = made.parts.iter().find_map(|part| part.thick);
    let thick = thick.map_or_else(String::new, |thick| {
        let (face, mm) = (thick.dimensions.name(), millimetres(thick.thickness_mm));
        let folds = thick.fold_radius_mm.map_or_else(String::new, |radius_mm| {
            format!(", with folds of the inner radius {}", millimetres(radius_mm))
        });
        format!(". Dimensions: {face}; patterns are those of the neutral fibre of {mm}{folds}")
    });
    match &made.material {
        Some(m) => {
            let radius = millimetres(m.bend_radius_mm.value);
            format!(
                "{panels} of {}. Limits: strain {stretch}, bend radius {radius}{thick}",
                m.title
            )
        }
        None => {
            format!("{panels}, no material named. Limit: strain {stretch}{thick}")
        }
    }
}

/// A column of the table of all panels; its value is `None` where a part has no such quantity.
struct Column {
    label: &'static str,
    value: fn(&PartPage<'_>) -> Option<String>,
}

const COLUMNS: [Column; 11] = [
    Column {
        label: "Flat size",
        value: |page| {
            let size = page.part.piece.size;
            Some(format!("{} × {}", millimetres(size.x), millimetres(size.y)))
        },
    },
    Column { label: "Area", value: |page| Some(area(page.part.measures.area_flat_mm2)) },
    Column {
        label: "Strain",
        value: |page| page.part.predicted.as_ref().map(|p| plain_per_cent(p.strain)),
    },
    Column {
        label: "Warp, largest / mean",
        value: |page| {
            let measures = page.part.found().map(|_| &page.part.measures)?;
            let [largest, mean] = [measures.warp_max, measures.warp_mean].map(to_deg);
            Some(format!("{} / {}", degrees(largest), degrees(mean)))
        },
    },
    Column {
        label: "Tightest bend radius",
        value: |page| page.part.found().map(|_| radius(page.part.measures.bend_radius_min_mm)),
    },
    Column {
        label: "Outline off its curves / shorter",
        value: |page| {
            let chords = &page.part.found()?.chords;
            let both = [chords.distance_max_mm()?, chords.shorter_max_mm()?];
            let [off, shorter] = both.map(millimetres_small);
            Some(format!("{off} / {shorter}"))
        },
    },
    Column {
        label: "Length error of flattening",
        value: |page| Some(per_cent(page.part.measures.length_error_max)),
    },
    Column {
        label: "Length error, mean",
        value: |page| page.part.given().map(|_| per_cent(page.part.measures.length_error_mean)),
    },
    Column {
        label: "Stretch, least / most",
        value: |page| {
            let stretch = page.part.measures.distortion.as_ref()?;
            let [least, most] = [stretch.stretch_min, stretch.stretch_max].map(|s| decimal(s, 4));
            Some(format!("{least} / {most}"))
        },
    },
    Column {
        label: "Seams",
        value: |page| page.part.given().map(|_| page.part.sheet.seams().len().to_string()),
    },
    Column {
        label: "Refold error",
        value: |page| page.part.found().map(|_| refold(page.refold_error_mm)),
    },
];

/// The columns in which some part has a value.
fn columns(pages: &[PartPage<'_>]) -> Vec<&'static Column> {
    let has = |column: &&Column| pages.iter().any(|page| (column.value)(page).is_some());
    COLUMNS.iter().filter(has).collect()
}

impl PartPage<'_> {
    fn row(&self, columns: &[&Column]) -> Row<'_> {
        let Self { part, checked, .. } = *self;
        Row { name: &part.name, piece: &part.piece, checked, values: self.values(columns) }
    }

    fn values(&self, columns: &[&Column]) -> Vec<String> {
        let value = |column: &&Column| (column.value)(self).unwrap_or_else(|| "–".to_owned());
        columns.iter().map(value).collect()
    }

    fn section(&self) -> Markup {
        let (figures, numbers) = match &self.part.origin {
            Origin::Found(found) => {
                let page = FoundPage { page: self, found };
                (
                    html! { (page.figures()) (page.other_surface()) (page.before_and_after()) },
                    page.numbers(),
                )
            }
            Origin::Given(given) => {
                let page = MeshPage { page: self, given };
                (html! { (page.figures()) (page.seams()) (page.joints()) }, page.numbers())
            }
        };
        let is_mesh = self.part.given().is_some();
        html! {
            section.panel id={ "panel-" (self.number) } {
                h2 { (self.part.name) }
                p { (verdict(self.checked)) }
                p { (verdict_sentence(self.checked.verdict, is_mesh)) }
                (findings(self.checked))
                (cut_from(self))
                (figures)
                (brake_plan(self))
                h3 { "Numbers" }
                dl.numbers {
                    @for (name, value) in numbers {
                        div { dt { (name) } dd { (value) } }
                    }
                }
            }
        }
    }
}

/// The card of a panel, which links to its section of the page; `number` counts from 1.
fn card(number: usize, name: &str, checked: &Checked) -> Markup {
    html! {
        li class={ "card " (severity(checked).name()) } {
            div { a href={ "#panel-" (number) } { (name) } }
            (verdict(checked))
            p {
                @match checked.findings.first() {
                    Some(finding) => (finding_text(finding)),
                    None => "No findings.",
                }
            }
        }
    }
}
