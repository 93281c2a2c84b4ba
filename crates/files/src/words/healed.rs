//! What was wrong with the triangles of a file, and what was done; and what a closed mesh is.

use sheetwright::mesh::{Damage, Skin};

/// What was healed in so many places, in words.
pub(super) fn healed(damage: Damage, count: usize) -> String {
    let [one, more] = match damage {
        Damage::Filler => [
            "A triangle of the file has no area: its corners lie on one line. It is left out.",
            "triangles of the file have no area: their corners lie on one line. They are left out.",
        ],
        Damage::Doubled => [
            "A triangle of the file lies where another one does. It is left out.",
            "triangles of the file lie where others do. They are left out.",
        ],
        Damage::Seam => [
            "A point of the file lies where another one does, at a side that both share. The two \
             count as one, so that the mesh hangs together there.",
            "points of the file lie where others do, at sides that they share. They count as one, \
             so that the mesh hangs together there.",
        ],
        Damage::OnSide => [
            "A point of the file lies on a side of a triangle. The triangle is divided there, so \
             that the mesh hangs together.",
            "points of the file lie on sides of triangles. The triangles are divided there, so \
             that the mesh hangs together.",
        ],
        Damage::Branch => [
            "A side belongs to more than two triangles. The two that go on straightest stay \
             together; the mesh is parted from the others there.",
            "sides belong to more than two triangles each. The two that go on straightest stay \
             together; the mesh is parted from the others there.",
        ],
        Damage::Turned => [
            "A triangle of the file faces the other way than its neighbours. It is turned round.",
            "triangles of the file face the other way than their neighbours. They are turned round.",
        ],
        Damage::InsideOut => [
            "The closed mesh faces inwards. It is turned round, to face outwards.",
            "closed parts of the mesh face inwards. They are turned round, to face outwards.",
        ],
    };
    if count == 1 { one.to_owned() } else { format!("{count} {more}") }
}

/// That a mesh is a plate with two skins, and which is laid flat.
pub(super) fn two_skins(
    [plates, bodies]: [usize; 2],
    thickness_mm: f64,
    laid: Option<Skin>,
) -> String {
    let what = match (plates, bodies) {
        (1, 1) => format!("The mesh is a plate with two skins, {thickness_mm:.2} mm apart."),
        (1, _) => format!(
            "A closed part of the mesh is a plate with two skins, {thickness_mm:.2} mm apart."
        ),
        _ => format!(
            "{plates} closed parts of the mesh are plates with two skins; those of the first are \
             {thickness_mm:.2} mm apart."
        ),
    };
    let done = match laid {
        None => "Both are laid flat, with the band round their edges. One skin alone is the sheet.",
        Some(Skin::Outer) => "The outer skin alone is laid flat.",
        Some(Skin::Inner) => "The inner skin alone is laid flat.",
    };
    format!("{what} {done}")
}
