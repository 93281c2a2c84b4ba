//! What moving a boundary came to, and letting rails run on, in words.

use sheetwright::check::{Bend, FindingKind, Hindrance, Movement};
use sheetwright::math::to_deg;

/// What was moved, and what that changed; a sentence without its end.
pub(super) fn movement(movement: &Movement) -> String {
    let Movement { curves, moved_max_mm, moved_total_mm, size_mm, warp, twist } = movement;
    if curves.is_empty() {
        return "Nothing was moved".to_owned();
    }
    let ([warp_before, warp_after], [twist_before, twist_after]) = (warp.map(to_deg), twist);
    format!(
        "{} moved by up to {moved_max_mm:.2} mm ({:.3} % of the size), {moved_total_mm:.1} mm over \
         all samples: the largest warp angle goes from {warp_before:.2}° to {warp_after:.2}°, the \
         total twist from {twist_before:.3e} to {twist_after:.3e}",
        listed(curves),
        100.0 * moved_max_mm / size_mm,
    )
}

/// Why nothing was moved, as the end of a sentence, and what is to be done instead where the panel
/// does not bend.
pub(super) fn not_needed(
    wanted: Option<f64>,
    is_above: bool,
    hindrance: Option<Hindrance>,
) -> String {
    let tell = "as far as its samples tell";
    if is_above {
        return ": the samples explain every warp angle by bending, so the panel is developable as \
                far as they tell. Ask for more samples to see its warp angles fall."
            .to_owned();
    }
    let Some(hindrance) = hindrance else {
        return format!(": the panel bends as it is, {tell}.");
    };
    let twist = match wanted.map(to_deg) {
        Some(wanted) => format!("no ruling twists by more than the {wanted:.1}° asked for"),
        None => "no ruling twists".to_owned(),
    };
    format!(": {twist}, {tell}.{}", keeps_from_bending(Some(hindrance)))
}

/// What keeps a panel from bending that has all the warp angles asked for, as a sentence.
pub(super) fn keeps_from_bending(hindrance: Option<Hindrance>) -> &'static str {
    match hindrance {
        None => "",
        Some(Hindrance::Warp) => " The sheet takes less than that: ask for a smaller angle.",
        Some(Hindrance::Radius) => {
            " What keeps the panel from bending is its radius, which moving for less twist does \
             not change: take a thinner sheet, or draw the curves rounder."
        }
        Some(Hindrance::Other) => {
            " What keeps the panel from bending is not its twist: see the errors beside this."
        }
    }
}

/// What became of the ends of a panel whose rails were let run on, and whether it bends the better
/// for it.
pub(super) fn ran_on(
    kind: &FindingKind,
    bulges_mm: [Option<f64>; 2],
    bends: Option<[Bend; 2]>,
) -> String {
    let said = |bulge: Option<f64>| match bulge {
        Some(mm) => format!("a curve up to {mm:.2} mm beside the straight line"),
        None => "straight".to_owned(),
    };
    let [start, end] = bulges_mm.map(said);
    let mut text = format!(
        "The rails were let run on beyond their ends. The end of the panel where the first rail \
         begins is {start}; the one where it ends is {end}."
    );
    if bulges_mm == [None; 2] {
        text.push_str(" Rulings would gain nothing by leaving there.");
    } else if let Some(bends) = bends {
        let [now, straight] = bends.map(|bend| {
            let warp = to_deg(bend.warp);
            match bend.radius_mm {
                r if r.is_finite() => format!("{warp:.2}° and {r:.1} mm"),
                _ => format!("{warp:.2}°, and it is flat"),
            }
        });
        text.push_str(&format!(
            " Largest warp and smallest bend radius are {now}; with straight ends they are \
             {straight}."
        ));
        if kind.is_worse_than_straight() {
            text.push_str(" The panel bends better with straight ends.");
        }
    }
    text
}

/// Names in a sentence: `'a', 'b' and 'c'`.
pub(super) fn listed(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("'{name}'")).collect();
    match &names[..] {
        [others @ .., last] if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        one_or_none => one_or_none.concat(),
    }
}
