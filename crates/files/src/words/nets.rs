//! What is said about nets, and about meshes that are asked to be some.

use sheetwright::check::MeshSetting;

/// What does nothing to a mesh that is laid flat the other way.
pub(super) fn no_effect(settings: &[MeshSetting], is_net: bool) -> String {
    let called = |setting: &MeshSetting| match setting {
        MeshSetting::Aim => "the aim of flattening",
        MeshSetting::SplitCreases => "the angle of creases that divide it",
        MeshSetting::Darts => "cuts where it would stretch",
        MeshSetting::PiecesWithin => "the largest size of pieces",
    };
    let called: Vec<&str> = settings.iter().map(called).collect();
    let (last, before) = called.split_last().map_or(("", &[][..]), |(last, rest)| (*last, rest));
    let all = if before.is_empty() {
        last.to_owned()
    } else {
        format!("{} and {last}", before.join(", "))
    };
    // Cuts are several.
    let have = if settings == [MeshSetting::Darts] || settings.len() > 1 { "have" } else { "has" };
    let why = match is_net {
        true => "The mesh is folded between its facets and stretched nowhere",
        false => "The mesh is laid flat as a surface, not folded between its facets",
    };
    format!("{why}, so {all} {have} no effect.")
}

/// A piece of a net beside the room that it may have.
pub(super) fn piece_too_large(
    [size, within]: [[f64; 2]; 2],
    is_facet: bool,
    is_trimmed: bool,
) -> String {
    let what = match (is_facet, is_trimmed) {
        (true, true) => "With what is added along its edges, this facet by itself",
        (true, false) => "This facet by itself",
        (false, true) => "With what is added along its edges, this piece",
        (false, false) => "This piece",
    };
    let advice = match (is_facet, is_trimmed) {
        (true, true) => "Add less along its edges, make the model smaller, or divide the facet.",
        (true, false) => "Make the model smaller, or divide the facet.",
        (false, true) => "Add less along its edges, or ask for smaller pieces.",
        (false, false) => "Make the model smaller, or ask for smaller pieces.",
    };
    let tenths = |[width, height]: [f64; 2], rounded: fn(f64) -> f64| {
        let [width, height] = [width, height].map(|mm| rounded(10.0 * mm) / 10.0);
        format!("{width} × {height} mm")
    };
    // A piece that is too large by little is said to be larger.
    let (size, within) = (tenths(size, f64::ceil), tenths(within, f64::floor));
    format!("{what} is {size}, and a piece may have {within}. {advice}")
}
