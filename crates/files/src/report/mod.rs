//! The report: `report.json` for scripts, `report.html` for readers.
//!
//! The page is one file that works offline: no scripts, no fonts, no references. Its pictures are
//! drawn here rather than by a plotting crate, because one and the same picture has to follow the
//! reader's light or dark theme, stay legible on a phone and on paper, and have the same bytes on
//! every platform: all colours and sizes of letters are classes of one style sheet.

mod brake_page;
mod canvas;
mod flat_picture;
mod form;
mod found_page;
mod gauss_picture;
mod heat_picture;
mod html;
mod json;
mod mesh_page;
mod moved_picture;
mod order;
mod page;
mod paint;
mod quads_picture;
mod raster;
mod rulings;
mod solid;
mod space_picture;
mod strain_in_space;
mod strips;
mod style;
mod verdict;
mod view;
mod warp_chart;
mod wording;

pub use canvas::{Picture, side_by_side, stacked};
pub use form::ReportForm;
pub use gauss_picture::gauss_picture;
pub use html::report_html;
pub use json::{report_json, report_schema};
pub use moved_picture::moved_picture;
pub use quads_picture::quads_picture;
pub use space_picture::{design_picture, space_picture};
pub use warp_chart::warp_chart;
pub use wording::{verdict_sentence, verdict_word};

use sheetwright::make::{Origin, Part};
use sheetwright::material::Material;
use sheetwright::measure::Measures;

/// The flat pattern of a part, seen from the side that the surface faces; for a mesh, with each
/// triangle coloured by its largest relative length error.
pub fn flat_picture(part: &Part, material: Option<&Material>) -> Picture {
    match (&part.origin, &part.measures.distortion) {
        (Origin::Given(given), Some(distortion)) => {
            heat_picture::heat_picture(part, given, distortion, material)
        }
        _ => flat_picture::ruled_picture(part, material),
    }
}

/// The rung with the largest warp angle, by its number from 0, the first of equals; `None` without
/// rungs.
fn worst_rung(measures: &Measures) -> Option<usize> {
    let rungs = &measures.rungs;
    (0..rungs.len()).reduce(|best, n| if rungs[n].warp > rungs[best].warp { n } else { best })
}

#[cfg(test)]
mod tests;
