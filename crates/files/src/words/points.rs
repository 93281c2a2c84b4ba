//! Findings on points that rulings run together in, in sentences.

use sheetwright::check::TooTight;

/// What the sheet does in a point, or in several: by how much it turns, and how far the point
/// reaches with the least bend radius of the sheet, both mm, and whether the sheet folds.
pub(super) fn points(
    is_one: bool,
    turn: &str,
    reach: Option<([String; 2], bool)>,
    too_tight: Option<&TooTight>,
) -> String {
    let begin = match (too_tight, is_one) {
        (None, true) => "Bend lines meet in a corner",
        (None, false) => "Bend lines meet in corners",
        (Some(_), true) => "Bend lines meet in a point",
        (Some(_), false) => "Bend lines meet in points",
    };
    let them = if is_one { "it" } else { "them" };
    let reach = reach.map_or(String::new(), |([reach, limit], folds)| {
        let up_to = if is_one { "" } else { "up to " };
        let does = if folds { "it creases softly instead" } else { "it breaks, or stands off" };
        format!(
            " Within {up_to}{reach} mm of {them} the sheet would be bent to less than {limit} mm, \
             its limit: there {does}."
        )
    });
    let advice = match too_tight {
        Some(TooTight { sheet, limit_mm, needed_mm }) => format!(
            "Rounded off, the bend radius there is {needed_mm:.1} mm; the limit for {sheet} is \
             {limit_mm:.1} mm. Cut the point off, or move the boundary there."
        ),
        None => format!(
            "Bend the {} in steps. The smallest bend radius leaves {them} out.",
            if is_one { "corner" } else { "corners" },
        ),
    };
    format!("{begin} and turn the sheet by up to {turn} there.{reach} {advice}")
}
