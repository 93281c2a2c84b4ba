//! Dividing parts that are larger than the sheet, in words.

use sheetwright::check::Division;
use sheetwright::design::DivideJoint;
use sheetwright::divide::DivideFault;

/// What a piece of a part is. The first says how and why the part was divided.
pub(super) fn piece_of(piece: usize, division: &Division) -> String {
    let pieces = division.pieces;
    if piece > 1 {
        return format!("Piece {piece} of {pieces}, divided as the first says.");
    }
    format!(
        "Piece {piece} of {pieces}: the part {} What is said of its bending is said of the whole \
         part.",
        division_sentence(division)
    )
}

/// How a part was divided and why, as the rest of a sentence whose subject is the part.
pub(crate) fn division_sentence(division: &Division) -> String {
    let &Division { pieces: _, joints, joint, lap_mm, length_mm, room_mm } = division;
    let s = if joints == 1 { "" } else { "s" };
    let joined = match joint {
        DivideJoint::Scarf => format!("{joints} scarf{s}"),
        DivideJoint::Butt => format!("{joints} butt joint{s} with straps"),
        DivideJoint::Puzzle => format!("{joints} puzzle joint{s}"),
        DivideJoint::Overlap => format!("{joints} overlap{s}"),
    };
    let of = lap_mm.map_or_else(String::new, |mm| format!(" of {}", length(mm)));
    format!(
        "is {} long and the largest sheet takes {}, so it is divided by {joined}{of}.",
        length(length_mm),
        by(room_mm)
    )
}

/// Why a part can't be divided, with advice.
pub(super) fn not_divided(fault: DivideFault) -> &'static str {
    match fault {
        DivideFault::NoThickness => {
            "its joints are counted in thicknesses, and no thickness is known. Name a material or \
             a thickness."
        }
        DivideFault::Seams => {
            "its pattern is cut open along seams, whose sides must stay together. Divide the panel \
             in the design, or take a larger sheet."
        }
        DivideFault::NoPlace => {
            "no straight lines leave pieces that all fit a sheet. Take a larger sheet, or divide \
             the panel in the design."
        }
        DivideFault::Pinched => {
            "a piece would hang together in a point. Divide the panel in the design."
        }
        DivideFault::TooThin => {
            "a piece would be narrower than its joint. Take a larger sheet or a shorter joint."
        }
    }
}

/// A width and a height, in the unit of the larger.
pub(super) fn by([width, height]: [f64; 2]) -> String {
    if width.max(height) >= METRES_FROM_MM {
        format!("{:.2} × {:.2} m", width / 1000.0, height / 1000.0)
    } else {
        format!("{width:.0} × {height:.0} mm")
    }
}

/// Lengths are in metres from here on, to a centimetre.
const METRES_FROM_MM: f64 = 2000.0;

/// A length.
fn length(mm: f64) -> String {
    if mm >= METRES_FROM_MM { format!("{:.2} m", mm / 1000.0) } else { format!("{mm:.0} mm") }
}
