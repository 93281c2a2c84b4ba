//! A part with the data of its section of `report.html`, and code that the sections of found
//! surfaces and of meshes share.

use super::gauss_picture::gauss_picture;
use super::space_picture::space_picture;
use maud::{Markup, PreEscaped, html};
use sheetwright::bend::Hit;
use sheetwright::check::Checked;
use sheetwright::edge::Edge;
use sheetwright::make::{CutItem, Made, Part};
use sheetwright::material::Material;
use sheetwright::pattern::EqualPiece;

/// A part with the data of its section of the page.
pub(super) struct PartPage<'a> {
    pub(super) made: &'a Made,
    /// From 1.
    pub(super) number: usize,
    pub(super) part: &'a Part,
    /// See [`crate::Outputs::refold_error_mm`].
    pub(super) refold_error_mm: f64,
    pub(super) checked: &'a Checked,
    /// The pattern that it is cut from, and how it comes from it.
    pub(super) pattern: Option<(&'a CutItem, &'a EqualPiece)>,
    /// Its hits at the press brake, if a plan is made.
    pub(super) plan: Option<&'a [Hit]>,
}

impl PartPage<'_> {
    /// Whether it is cut from its own pattern.
    pub(super) fn is_first(&self) -> bool {
        self.pattern.is_none_or(|(item, _)| item.first() + 1 == self.number)
    }

    pub(super) fn material(&self) -> Option<&Material> {
        self.made.material.as_ref()
    }

    /// The column of the part in space and of the directions that it faces. The second picture has
    /// the place `gauss_place` among all where the page is narrow.
    pub(super) fn space_column(
        &self,
        space_caption: &Markup,
        gauss_place: &str,
        gauss_caption: &Markup,
    ) -> Markup {
        html! {
            div.column {
                figure.first {
                    (PreEscaped(space_picture(self.part, self.material()).inline()))
                    figcaption { (space_caption) }
                }
                @if let Some(gauss) = gauss_picture(self.part, self.material()) {
                    figure class=(gauss_place) {
                        (PreEscaped(gauss.inline()))
                        figcaption { (gauss_caption) }
                    }
                }
            }
        }
    }

    /// The name of an edge, its length, and the parts that it is joined to.
    pub(super) fn edge_text(&self, edge: &Edge, length: &str) -> String {
        let mates = edge.mates.iter().map(|mate| &self.made.parts[mate.part].name[..]);
        let mates: Vec<&str> = mates.collect();
        match mates[..] {
            [] => format!("{}, {length}", edge.name),
            // An edge of a mesh has the name of the part that it meets.
            [only] if only == edge.name => format!("{length}, joined to {only}"),
            _ => format!("{}, {length}, joined to {}", edge.name, mates.join(", ")),
        }
    }
}

/// A table: a row for each name, with a value under each label. `first` stands above the names.
pub(super) fn table<N: AsRef<str>>(
    caption: Option<&str>,
    first: &str,
    labels: &[&str],
    rows: impl Iterator<Item = (N, Vec<String>)>,
) -> Markup {
    html! {
        table.summary {
            @if let Some(caption) = caption { caption { (caption) } }
            thead {
                tr {
                    th scope="col" { (first) }
                    @for label in labels { th scope="col" { (label) } }
                }
            }
            tbody {
                @for (name, values) in rows {
                    tr {
                        th scope="row" { (name.as_ref()) }
                        @for (label, value) in labels.iter().zip(values) {
                            td data-label=(label) { (value) }
                        }
                    }
                }
            }
        }
    }
}

/// A number with its name.
pub(super) type Number = (&'static str, String);
