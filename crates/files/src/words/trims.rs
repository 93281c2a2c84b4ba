//! What is said about trims.

use sheetwright::trim::TrimNote;

/// The most joints that a note names.
const SHOWN: usize = 6;

/// A note on the trims of a part, in words.
pub(super) fn trimmed(note: &TrimNote) -> String {
    match note {
        TrimNote::NoRoomForTabs { joints, covered } => no_room_for_tabs(joints, *covered),
        TrimNote::HolesLeftOut { edge, left_out, of } => format!(
            "{left_out} of {of} holes along {edge} are left out, on both sides of the joint: they \
             would reach over an edge or into another hole. Move the holes nearer to the edge, or \
             farther from its ends."
        ),
        TrimNote::FlangeStretches { edge, flat_mm, bent_mm } => format!(
            "The flange along {edge} must {} by {:.1} % at its rim, which is {flat_mm:.1} mm long on \
             the pattern and {bent_mm:.1} mm when it is bent round the curve. Cut notches into it, \
             or make it narrower.",
            if bent_mm > flat_mm { "stretch" } else { "shrink" },
            100.0 * (bent_mm / flat_mm - 1.0).abs()
        ),
        TrimNote::Closes { of_net, of_cut } => format!(
            "What is added beyond the edges closes a hole or a gap of the part: the part has \
             {of_net} {}, the line to cut goes round {of_cut}. Make it narrower there.",
            if *of_net == 1 { "hole" } else { "holes" }
        ),
        TrimNote::NotProved { outside_mm2 } => format!(
            "{outside_mm2:.3} mm² of the part lie outside the line to cut: don't cut it. This is a \
             fault of the program; please report it with the design."
        ),
        TrimNote::Overlaps => "The pattern overlaps itself, so that nothing was added along its \
                               edges. Mend the overlap first."
            .to_owned(),
    }
}

/// Joints whose tabs cover less than half of them, of one this share.
fn no_room_for_tabs(joints: &[[String; 2]], covered: f64) -> String {
    // Both sides of a seam have one mark.
    let named = |[edge, mate]: &[String; 2]| match edge == mate {
        true => edge.clone(),
        false => format!("{edge} with {mate}"),
    };
    let per_cent = 100.0 * covered;
    if let [joint] = joints {
        let what = if joint[0] == joint[1] { "seam" } else { "joint of" };
        return format!(
            "There is room for full tabs along {per_cent:.0} % of the {what} {}, on either side. \
             Make the tabs narrower, or glue it edge to edge.",
            named(joint)
        );
    }
    let shown: Vec<String> = joints.iter().take(SHOWN).map(named).collect();
    let more = match joints.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!(
        "There is room for full tabs along less than half of {} joints, on either side, and along \
         {per_cent:.0} % of the worst: {}{more}. Make the tabs narrower, or glue them edge to edge.",
        joints.len(),
        shown.join(", ")
    )
}
