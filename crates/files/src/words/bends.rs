//! The words for folds and the tools that make them.

use sheetwright::bend::Mitred;

/// Folds that have no bend allowance, of so many.
pub(super) fn folds_mitred(count: usize, of: usize, why: Mitred) -> String {
    let folds = match (count, of) {
        (1, 1) => "The fold has".to_owned(),
        (1, _) => format!("1 of {of} folds has"),
        _ if count == of => format!("All {of} folds have"),
        _ => format!("{count} of {of} folds have"),
    };
    let is_one = count == 1;
    let why = match (why, is_one) {
        (Mitred::Meets, true) => "it meets others in a point, where the bends do not fit together",
        (Mitred::Meets, false) => "they meet in points, where the bends do not fit together",
        (Mitred::NotFlat, true) => {
            "it is not straight, ends within the sheet or has a bend beside it"
        }
        (Mitred::NotFlat, false) => {
            "they are not straight, end within the sheet or have bends beside"
        }
        (Mitred::Narrow, true) => "a face beside it ends before the bend does",
        (Mitred::Narrow, false) => "faces beside them end before the bends do",
        (Mitred::Untrue, true) => "with it, lengths of the part would not stay true",
        (Mitred::Untrue, false) => "with it, lengths of the part would not stay true",
    };
    format!("{folds} no bend allowance: {why}. There the faces meet as mitred boards do.")
}

/// A smooth bend of the drawn face with this radius, in a sheet whose inner face lies so far inside
/// of it.
pub(super) fn sheet_too_thick(drawn_mm: f64, inside_mm: f64, thickness_mm: f64) -> String {
    format!(
        "The sheet is too thick for its tightest smooth bend: the face that was drawn has a radius \
         of {drawn_mm:.2} mm there, and the inner face of a sheet of {thickness_mm} mm lies \
         {inside_mm:.2} mm inside of that, where no radius is left. Draw the bend rounder or as a \
         sharp fold, take a thinner sheet, or say that another face was drawn."
    )
}
