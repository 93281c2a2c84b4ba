//! What the names of curves and layers say of them.

use super::drawn::Drawn;
use crate::names::folded;

/// What a curve is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Rail,
    Outline,
    Hole,
    /// No boundary: to be engraved, noted or measured.
    Mark,
}

/// The words that begin a name, and what they say.
const WORDS: [(&str, Role); 22] = [
    ("rail", Role::Rail),
    ("rails", Role::Rail),
    ("outline", Role::Outline),
    ("outlines", Role::Outline),
    ("hole", Role::Hole),
    ("holes", Role::Hole),
    ("score", Role::Mark),
    ("engrave", Role::Mark),
    ("note", Role::Mark),
    ("notes", Role::Mark),
    ("mark", Role::Mark),
    ("marks", Role::Mark),
    ("dim", Role::Mark),
    ("dims", Role::Mark),
    ("dimension", Role::Mark),
    ("dimensions", Role::Mark),
    ("construction", Role::Mark),
    ("guide", Role::Mark),
    ("guides", Role::Mark),
    ("text", Role::Mark),
    // The layer of AutoCAD that is not plotted.
    ("defpoints", Role::Mark),
    ("reference", Role::Mark),
];

/// What the names of a curve say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Told<'a> {
    pub(super) role: Role,
    /// The name that says so.
    pub(super) name: &'a str,
    /// Whether that is a name of its own, not that of a layer.
    pub(super) is_own: bool,
}

/// The role that a curve has by its own names, else by those of its layers, from the innermost.
pub(super) fn role(curve: &Drawn) -> Option<Told<'_>> {
    let own = curve.names.iter().map(|name| (name, true));
    let mut names = own.chain(curve.layers.iter().map(|name| (name, false)));
    names.find_map(|(name, is_own)| Some(Told { role: said(name)?, name, is_own }))
}

/// Whether a curve of this name is a rail.
pub(crate) fn says_rail(name: &str) -> bool {
    said(name) == Some(Role::Rail)
}

/// What a name says: that of the word that it begins with, followed by its end or by no letter.
fn said(name: &str) -> Option<Role> {
    let name = name.trim().to_lowercase();
    let end = name.find(|c: char| !c.is_alphabetic()).unwrap_or(name.len());
    WORDS.iter().find(|(word, _)| *word == &name[..end]).map(|(_, role)| *role)
}

/// Whether a curve, or a layer that it lies on, has this name.
pub(super) fn is_called(curve: &Drawn, wanted: &str) -> bool {
    let wanted = folded(wanted.trim());
    curve.all_names().any(|name| folded(name.trim()) == wanted)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_word_of_a_name_says_the_role() {
        for (name, role) in [
            ("rail", Some(Role::Rail)),
            ("Rail-sheer", Some(Role::Rail)),
            ("RAILS 2", Some(Role::Rail)),
            ("outline_1", Some(Role::Outline)),
            ("hole3", Some(Role::Hole)),
            ("Engrave", Some(Role::Mark)),
            ("railing", None),
            ("handrail", None),
            ("0", None),
            ("", None),
        ] {
            assert_eq!(said(name), role, "{name:?}");
        }
    }
}
