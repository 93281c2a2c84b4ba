//! What is said about marks.

use super::place::point;
use sheetwright::mark::MarkNote;

/// A note on a mark of a part, in words.
pub(super) fn marked(note: &MarkNote) -> String {
    match note {
        MarkNote::StationMissed { name, axis, at_mm, reach_mm: [low, high] } => {
            let axis = axis.name();
            format!(
                "Station {name}, at {axis} = {at_mm:.1} mm, crosses none of its parts, which reach \
                 from {axis} = {low:.1} to {high:.1} mm. Move it, or leave it out."
            )
        }
        MarkNote::PlaceFar { what, at, off_mm, within_mm } => format!(
            "The {what} at {} is {off_mm:.2} mm from the nearest part; the limit is {within_mm:.2} \
             mm, so it is left out. Move it, or raise `within`.",
            point(*at)
        ),
        MarkNote::OverTheEdge { what, at, radius_mm } => {
            let limit = match radius_mm {
                0.0 => "outside the part".to_owned(),
                radius => format!("less than {radius:.2} mm from an edge of the part, or outside"),
            };
            format!(
                "The {what} at ({:.1}, {:.1}) mm of the pattern lies {limit}, so it is left out. \
                 Move it inwards.",
                at.x + 0.0,
                at.y + 0.0
            )
        }
        MarkNote::SquareToPart { what } => format!(
            "The arrow of the mark {what} points straight through the part, so it is left out. \
             Choose another direction `toward`."
        ),
        MarkNote::CurvedFrame { name, off_mm, length_mm } => format!(
            "A straight frame misses the part, which is curved across: by up to {off_mm:.1} mm at \
             {name}, where the frame is {length_mm:.0} mm long, and by less at other stations. Shape \
             the frames to the part, or let it bear on its edges alone."
        ),
        MarkNote::CurvedFold { edge, off_mm } => format!(
            "Edge {edge} can't lie on a fold: it leaves the straight line between its ends by \
             {off_mm:.2} mm. Choose a straight edge."
        ),
    }
}
