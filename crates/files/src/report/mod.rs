//! The report: `report.json` for scripts, `report.html` for readers.
//!
//! The page is one file that works offline: no scripts, no fonts, no references. Its pictures are
//! drawn here rather than by a plotting crate, because one and the same picture has to follow the
//! reader's light or dark theme, stay legible on a phone and on paper, and have the same bytes on
//! every platform: all colours and sizes of letters are classes of one style sheet.

mod advice_json;
mod brake_page;
mod canvas;
mod cut_page;
mod divided_page;
mod flat_picture;
mod form;
mod found_page;
mod gauss_picture;
mod heat_picture;
mod html;
mod joined_page;
mod json;
mod legend;
mod mesh_page;
mod moved_picture;
mod page;
mod paint;
mod quads_picture;
mod sheets_json;
mod sheets_page;
mod space_picture;
mod strain_in_space;
mod strips;
mod style;
mod verdict;
mod warp_chart;

pub use canvas::{Picture, side_by_side, stacked};
pub use form::ReportForm;
pub use gauss_picture::gauss_picture;
pub use html::report_html;
pub use json::{report_json, report_schema};
pub use moved_picture::moved_picture;
pub use quads_picture::quads_picture;
pub use space_picture::{design_picture, space_picture};
pub use warp_chart::warp_chart;

use sheetwright::check::Checked;
use sheetwright::make::{CutItem, Made, Origin, Part};
use sheetwright::material::Material;
use sheetwright::pattern::EqualPiece;

/// What was found when the patterns of a made design were written and read back.
#[derive(Clone, Copy, Debug)]
pub struct Written<'a> {
    /// The patterns to cut.
    pub patterns: &'a [CutItem],
    /// The verdict of each part, and all its findings.
    pub checked: &'a [Checked],
    /// The refold error of each part, mm; see [`crate::Outputs::refold_error_mm`].
    pub refold_errors_mm: &'a [f64],
}

impl<'a> Written<'a> {
    /// # Panics
    /// Unless there is a verdict and a refold error for each part.
    fn assert_complete(&self, made: &Made) {
        assert_eq!(made.parts.len(), self.refold_errors_mm.len(), "one refold error a part");
        assert_eq!(made.parts.len(), self.checked.len(), "one verdict a part");
    }

    /// The pattern that a part is cut from, by the number of the part.
    fn pattern_of(&self, part: usize) -> Option<(&'a CutItem, &'a EqualPiece)> {
        self.patterns.iter().find_map(|item| Some((item, item.instance(part)?)))
    }
}

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

#[cfg(test)]
mod tests;
