//! Sentences on moved boundaries and on rails that run on.

use sheetwright::check::{Bend, FindingKind, Hindrance, Movement};
use sheetwright::math::to_deg;

/// Which curves moved, how far, and the change of warp and twist; a sentence without its end.
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

/// Why nothing moved, as the end of a sentence, and what to do instead where the panel does not
/// bend. `wanted` is the goal, the largest warp angle, radians.
pub(super) fn not_needed(
    wanted: Option<f64>,
    is_above: bool,
    hindrance: Option<Hindrance>,
) -> String {
    let tell = "as far as its samples tell";
    if is_above {
        return ": bending from one sample to the next explains every warp angle, so the panel is \
                developable as far as its samples tell. With more samples its warp angles fall."
            .to_owned();
    }
    let Some(kept) = hindrance else {
        return format!(": the panel bends as it is, {tell}.");
    };
    let twist = match wanted.map(to_deg) {
        Some(wanted) => format!("no ruling twists by more than the goal of {wanted:.1}°"),
        None => "less twist, which moving aims at, would not help".to_owned(),
    };
    // Without a goal there is no angle to set smaller.
    let kept = Some(kept).filter(|kept| wanted.is_some() || *kept != Hindrance::Strain);
    format!(": {twist}, {tell}.{}", keeps_from_bending(kept))
}

/// Why a panel does not bend although its warp angles reach the goal, as a sentence.
pub(super) fn keeps_from_bending(hindrance: Option<Hindrance>) -> &'static str {
    match hindrance {
        None => "",
        Some(Hindrance::Strain) => {
            " The sheet must stretch too much all the same: set a smaller angle."
        }
        Some(Hindrance::Radius) => {
            " The bend radius keeps the panel from bending, and moving for less twist does not \
             change it. Choose a thinner sheet, or draw the curves rounder."
        }
        Some(Hindrance::Other) => {
            " Something other than twist keeps the panel from bending: see the other errors."
        }
    }
}

/// The shape of both ends of a panel whose rails run on, and whether it bends better with them than
/// with straight ends.
pub(super) fn ran_on(
    kind: &FindingKind,
    bulges_mm: [Option<f64>; 2],
    bends: Option<[Bend; 2]>,
) -> String {
    let said = |bulge: Option<f64>| match bulge {
        Some(mm) => format!("a curve up to {mm:.2} mm from the straight line"),
        None => "straight".to_owned(),
    };
    let [start, end] = bulges_mm.map(said);
    let mut text = format!(
        "The rails run on beyond their ends. Where the first rail begins, the end of the panel is \
         {start}; where that rail ends, it is {end}."
    );
    if bulges_mm == [None; 2] {
        text.push_str(" Rulings through these ends would gain nothing.");
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
