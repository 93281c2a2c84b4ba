//! The report: `report.json` for scripts, `report.html` for people.
//!
//! The page is one file that works offline: no scripts, no fonts, no references. Its pictures are
//! drawn here rather than by a plotting crate, because one and the same picture has to follow the
//! reader's light or dark theme, stay legible on a phone and on paper, and have the same bytes on
//! every platform: all colours and sizes of letters are classes of one style sheet.

mod canvas;
mod flat_picture;
mod form;
mod gauss_picture;
mod html;
mod json;
mod mesh_html;
mod mesh_picture;
mod moved_picture;
mod order;
mod paint;
mod part;
mod quads_picture;
mod raster;
mod rulings;
mod space_picture;
mod strips;
mod style;
mod verdict;
mod view;
mod warp_chart;
mod wording;

pub use canvas::{Picture, side_by_side, stacked};
pub use flat_picture::flat_picture;
pub use form::ReportForm;
pub use gauss_picture::{gauss_picture, mesh_gauss_picture};
pub use html::report_html;
pub use json::{mesh_report_json, report_json, report_schema};
pub use mesh_html::mesh_report_html;
pub use mesh_picture::{heat_picture, mesh_picture, meshes_picture};
pub use moved_picture::moved_picture;
pub use quads_picture::quads_picture;
pub use space_picture::{design_picture, surface_picture};
pub use warp_chart::warp_chart;
pub use wording::{verdict_sentence, verdict_word};

use sheetwright::measure::Measures;

/// The rung with the largest warp angle, by its number from 0, the first of equals; `None` without
/// rungs.
fn worst_rung(measures: &Measures) -> Option<usize> {
    let rungs = &measures.rungs;
    (0..rungs.len()).reduce(|best, n| if rungs[n].warp > rungs[best].warp { n } else { best })
}

#[cfg(test)]
mod tests;
