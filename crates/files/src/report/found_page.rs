//! The section of `report.html` for a part whose surface was found.

use super::flat_picture::{CUT_AND_NET, Tagged, edges, outline_length, ruled_picture};
use super::heat_picture::strain_picture;
use super::moved_picture::{enlarged, moved_picture};
use super::page::{Number, PartPage, table};
use super::space_picture::space_picture;
use super::strain_in_space::strain_in_space;
use super::warp_chart::warp_chart;
use crate::space::box_of;
use crate::space::worst_rung;
use crate::wording::{
    area, decimal, degrees, millimetres, millimetres_fine, millimetres_small, plain_per_cent,
    radius, refold, scientific, share_beyond_words, steradians, verdict_word,
};
use maud::{Markup, PreEscaped, html};
use sheetwright::elastic::Predicted;
use sheetwright::make::{Found, Part};
use sheetwright::material::warp_limit_deg;
use sheetwright::math::{from_deg, to_deg};
use sheetwright::measure::RungMeasures;
use sheetwright::pattern::seam_mark;
use sheetwright::triangulate::Goal;
use std::collections::BTreeSet;

/// A smaller warp is shown as none, degrees: half of the last printed digit.
const NO_WARP_DEG: f64 = 0.005;

/// A part with its boundary.
pub(super) struct FoundPage<'a> {
    pub(super) page: &'a PartPage<'a>,
    pub(super) found: &'a Found,
}

impl FoundPage<'_> {
    /// The pictures with their captions.
    pub(super) fn figures(&self) -> Markup {
        let (part, material) = (self.page.part, self.page.material());
        html! {
            div.figures {
                (self.page.space_column(&self.space_caption(), "fourth", &gauss_caption(part.measures.gauss_area_sr)))
                div.column {
                    figure.second {
                        (PreEscaped(ruled_picture(part, material).inline()))
                        (self.flat_caption())
                    }
                    @if let Some(picture) = strain_picture(part) {
                        figure.third {
                            (PreEscaped(picture.inline()))
                            @if let Some(in_space) = strain_in_space(part) {
                                (PreEscaped(in_space.inline()))
                            }
                            figcaption { (self.strain_caption()) }
                        }
                    }
                    @if let Some(chart) = warp_chart(part, material) {
                        figure.third {
                            (PreEscaped(chart.inline()))
                            figcaption { (self.warp_caption()) }
                        }
                    } @else {
                        p.third { "A single triangle is flat: nothing bends." }
                    }
                }
            }
        }
    }

    /// The other surface that fits the boundary about as well, if there is one.
    pub(super) fn other_surface(&self) -> Markup {
        let Some(other) = &self.found.other else { return html! {} };
        let both = [self.page.part, &other.part];
        let tightest = |part: &Part| part.measures.bend_radius_min_mm;
        let size = |part: &Part| {
            let size = part.piece.size;
            format!("{} × {}", millimetres(size.x), millimetres(size.y))
        };
        let rows = [
            ("Verdict", both.map(|p| verdict_word(p.checked.verdict).to_owned())),
            ("Largest warp", both.map(|p| degrees(to_deg(p.measures.warp_max)))),
            ("Tightest radius", both.map(|p| radius(tightest(p)))),
            ("Flat size", both.map(size)),
        ]
        .map(|(name, values)| (name, values.to_vec()));
        html! {
            h3 { "The other surface through this boundary" }
            p {
                "It fits about as well and lies up to " (millimetres(other.apart_mm))
                " away. The pattern is that of the first: decide which is meant before you cut."
            }
            div.figures {
                div.column {
                    figure {
                        (PreEscaped(space_picture(&other.part, self.page.material()).inline()))
                        figcaption { strong { "The other surface in space." } }
                    }
                }
                div.column { (table(None, "", &["This one", "The other"], rows.into_iter())) }
            }
        }
    }

    /// Verdict, warp and price before and after the boundary was moved, if it was.
    pub(super) fn before_and_after(&self) -> Markup {
        let (panel, material) = (self.page.part, self.page.material());
        let Some(change) = panel.change() else { return html! {} };
        let before: &Part = &change.before;
        let price =
            |part: &Part| part.found().map_or(f64::NAN, |f| f.triangulation.price_without_hints());
        let strain = |part: &Part| {
            part.predicted.as_ref().map_or_else(|| "–".to_owned(), |p| plain_per_cent(p.strain))
        };
        let rows = [
            ("Verdict", [before, panel].map(|p| verdict_word(p.checked.verdict).to_owned())),
            ("Strain", [before, panel].map(strain)),
            ("Largest warp", [before, panel].map(|p| degrees(to_deg(p.measures.warp_max)))),
            ("Mean warp", [before, panel].map(|p| degrees(to_deg(p.measures.warp_mean)))),
            ("Twist, total", [before, panel].map(|p| scientific(p.measures.twist_total))),
            ("Price, total", [before, panel].map(|p| scientific(price(p)))),
        ]
        .map(|(name, values)| (name, values.to_vec()));
        html! {
            h3 { "Before and after the boundary was moved" }
            p {
                "Samples moved by up to " (millimetres_fine(change.moved_max_mm())) ", by "
                (millimetres_fine(change.moved_total_mm())) " in total: " (change.ended.to_string())
                "."
            }
            (table(None, "", &["Before", "After"], rows.into_iter()))
            @if let Some(picture) = moved_picture(panel) {
                div.figures {
                    div.column {
                        figure {
                            (PreEscaped(picture.inline()))
                            figcaption {
                                strong { "Where it moved. " }
                                "The boundary before (dark) and after (blue). The distance between \
                                 them is drawn " (decimal(enlarged(change), 0)) " times as long."
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

    /// Whether some rung bends: false for a flat plate.
    fn bends(&self) -> bool {
        self.page.part.measures.rungs.iter().any(RungMeasures::bends)
    }

    fn space_caption(&self) -> Markup {
        let size = box_of(self.page.part);
        html! {
            strong { "In space. " }
            @if self.bends() {
                "The thin lines are rulings, along which the sheet stays straight. "
            }
            "Blue is the side that the pattern shows, brown the other. The panel fills a box of "
            (millimetres(size.x)) " × " (millimetres(size.y)) " × " (millimetres(size.z))
            " (x, y, z)."
        }
    }

    fn flat_caption(&self) -> Markup {
        let (panel, edges) = (self.page.part, edges(self.page.part));
        // Both sides of a seam are equally long, and listed once.
        let mut seen = BTreeSet::new();
        html! {
            figcaption {
                strong { "Laid flat. " }
                @if panel.piece.has_net() {
                    (CUT_AND_NET)
                } @else {
                    "The outline to cut. "
                }
                @if self.bends() {
                    "Lay a straightedge from stroke to stroke along a ruling; dashed lines are folds. "
                }
                @if panel.piece.has_net() { "That edge is " } @else { "The whole outline is " }
                (millimetres(outline_length(panel))) " long."
                (self.chords_text())
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

    /// How near the outline comes to the curves that it was drawn by.
    fn chords_text(&self) -> String {
        let (chords, samples) = (&self.found.chords, self.found.boundary.len());
        let (Some(off), Some(shorter)) = (chords.distance_max_mm(), chords.shorter_max_mm()) else {
            return String::new();
        };
        let [off_text, shorter_text] = [off, shorter].map(millimetres_small);
        if off_text == shorter_text && off_text == "none" {
            return " It runs along its curves exactly.".to_owned();
        }
        format!(
            " It is a polygon through {samples} samples: its curves lie up to {off_text} from it, \
             and along an edge it is up to {shorter_text} shorter than they are."
        )
    }

    /// The name of an edge, its length, and the parts that it is joined to.
    fn edge_text(&self, tagged: &Tagged<'_>) -> String {
        let length = millimetres(tagged.length_mm);
        tagged.edge.map_or_else(|| length.clone(), |edge| self.page.edge_text(edge, &length))
    }

    fn strain_caption(&self) -> Markup {
        html! {
            strong { "Strain. " }
            "How much the sheet stretches or shrinks within its plane when it is held along its \
             edges in its shape. "
            @if let Some(predicted) = &self.page.part.predicted {
                @if let Some(beyond) = share_beyond_words(predicted.strain) {
                    "For 5 % of its area or more it is " (beyond)
                } @else {
                    "95 % of its area stays below " (plain_per_cent(predicted.strain))
                }
                ", on which the verdict rests; the sheet takes "
                (plain_per_cent(predicted.limits.strain)) ". Rings name the largest, on the pattern and \
                 in space."
                @if let Some(sheet) = &predicted.at_rest {
                    " Its middle leaves the surface by up to "
                    (millimetres_fine(sheet.distance_max_mm)) "."
                }
                @if let Some(slide_mm) = predicted.slide_mm() {
                    " Its edges slide along the boundary, by up to " (millimetres_fine(slide_mm)) "."
                }
            }
        }
    }

    /// Whether the warp of some ruling exceeds the limit by no more than the error of its sampling.
    fn is_unsure(&self) -> bool {
        let limit = from_deg(warp_limit_deg(self.page.material()));
        let is_so = |r: &RungMeasures| r.warp > limit && r.warp_beyond_sampling() <= limit;
        self.page.part.measures.rungs.iter().any(is_so)
    }

    fn warp_caption(&self) -> Markup {
        let measures = &self.page.part.measures;
        html! {
            strong { "Warp. " }
            "The angle by which the sheet twists from one end of each ruling to the other: the \
             smaller, the easier it bends. The dashed line is what thick plate takes of "
            (self.page.material().map_or("any sheet", |m| &m.title))
            "; thin sheet takes more, so the verdict rests on the strain. "
            @if self.is_unsure() {
                " Dashed bars may be bending from one sample to the next instead of twist: more \
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

    pub(super) fn numbers(&self) -> Vec<Number> {
        let (found, measures) = (self.found, &self.page.part.measures);
        let optimal = match found.triangulation.gap() {
            Some(0.0) => "yes".to_owned(),
            Some(gap) => format!("within {:.2} %", 100.0 * gap),
            None => "not proven".to_owned(),
        };
        let chords = |mm: Option<f64>| mm.map_or("no curves".to_owned(), millimetres_small);
        let tolerance = |mm: f64| millimetres_small(mm);
        let goal = match found.goal {
            Goal::Price => "price",
            Goal::WorstWarp => "worst warp, then price",
        };
        vec![
            ("Samples", found.boundary.len().to_string()),
            ("Curves from the outline, at most", chords(found.chords.distance_max_mm())),
            ("Outline shorter along an edge, at most", chords(found.chords.shorter_max_mm())),
            (
                "Tolerance of the samples",
                found.tolerance_mm.map_or("a number is given".to_owned(), tolerance),
            ),
            ("Triangles", found.surface.connectivity().triangles().len().to_string()),
            ("Rulings (rungs)", measures.rungs.len().to_string()),
            ("Method", found.method.name().to_owned()),
            ("Minimised", goal.to_owned()),
            ("Best possible", optimal),
            ("Fold price ν", format!("{}", found.fold)),
            ("Price, total", scientific(found.triangulation.price_without_hints())),
            ("Twist, total", scientific(measures.twist_total)),
            ("Strain, at 95 % of the area", self.strain_number(|p| plain_per_cent(p.strain))),
            (
                "Strain that the sheet takes",
                self.strain_number(|p| plain_per_cent(p.limits.strain)),
            ),
            ("Strain of the outer fibre", self.strain_number(|p| plain_per_cent(p.outer_fibre()))),
            (
                "Moment to hold an edge",
                self.strain_number(|p| {
                    p.hold_moment_n().map_or("not known".to_owned(), |m| {
                        format!("{}\u{a0}N·m/m", decimal(m, if m < 10.0 { 1 } else { 0 }))
                    })
                }),
            ),
            (
                "Distance at rest from the surface",
                self.strain_number(|p| {
                    p.rest_distance_mm().map_or("not known".to_owned(), millimetres_fine)
                }),
            ),
            ("Largest crease", degrees(to_deg(measures.crease_max))),
            ("Tightest bend radius", radius(measures.bend_radius_min_mm)),
            ("Area of the Gauss image", steradians(measures.gauss_area_sr)),
            ("Area in space", area(measures.area_space_mm2)),
            ("Area of the pattern", area(measures.area_flat_mm2)),
            ("Length error, largest", scientific(measures.length_error_max)),
            ("Length error, mean", scientific(measures.length_error_mean)),
            ("Refold error", self.refold_number()),
        ]
    }

    fn strain_number(&self, of: impl Fn(&Predicted) -> String) -> String {
        self.page.part.predicted.as_ref().map_or_else(|| "none".to_owned(), of)
    }

    fn refold_number(&self) -> String {
        if self.page.refold_error_mm.is_finite() {
            format!("{}\u{a0}mm", scientific(self.page.refold_error_mm))
        } else {
            refold(self.page.refold_error_mm)
        }
    }
}

fn gauss_caption(area_sr: f64) -> Markup {
    html! {
        strong { "Which way it faces. " }
        "Every direction is a point on a ball. Each ruling is drawn from the direction at one end \
         (blue) to the direction at the other end (green). If these points lie on one thin curve, \
         the sheet bends without stretching. If they cover a ribbon or an area, the sheet must \
         stretch, and more for a wider one. The area here is "
        (steradians(area_sr))
        " of the 12.57\u{a0}sr of the whole ball. Sampling always adds a little."
    }
}
