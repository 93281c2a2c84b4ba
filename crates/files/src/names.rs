//! Names that users give: which ones are accepted, and how messages show them.
//!
//! A panel's name becomes the name of its files. A design may be opened on any operating system, so
//! every system refuses the same names.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use unicode_normalization::UnicodeNormalization;

/// The most bytes of a name: with an ending added it stays below the 255 bytes that file systems
/// take, and it fits on a label.
pub(crate) const MAX_NAME_BYTES: usize = 100;

/// Characters with a special meaning in some file system.
const SEPARATORS: [char; 9] = ['/', '\\', ':', '*', '?', '"', '<', '>', '|'];

/// Names that Windows keeps for devices, with any ending.
const RESERVED: [&str; 7] = ["con", "prn", "aux", "nul", "conin$", "conout$", "clock$"];
/// Names that Windows keeps for devices when a digit follows.
const RESERVED_NUMBERED: [&str; 2] = ["com", "lpt"];

/// Why a name is refused, as the end of a sentence that begins with the name; `None` if it is
/// accepted.
pub(crate) fn refused_anywhere(name: &str) -> Option<&'static str> {
    if name.is_empty() {
        Some("is empty")
    } else if name.len() > MAX_NAME_BYTES {
        Some("is longer than 100 bytes")
    } else if name.chars().any(is_invisible) {
        Some("has a control character in it")
    } else if name.trim() != name {
        Some("begins or ends with a space")
    } else {
        None
    }
}

/// Why a curve can't have this name, as the end of a sentence that begins with it.
pub(crate) fn refused_for_curve(name: &str) -> Option<&'static str> {
    // `-name` is the curve run backwards.
    refused_anywhere(name).or(name.starts_with('-').then_some("begins with a minus sign"))
}

/// Why no file can have this name on every system, as the end of a sentence that begins with it.
pub fn refused_for_file(name: &str) -> Option<&'static str> {
    if let Some(why) = refused_anywhere(name) {
        return Some(why);
    }
    if name.contains(SEPARATORS) {
        return Some("has one of / \\ : * ? \" < > | in it");
    }
    if name.starts_with('.') {
        return Some("begins with a dot");
    }
    if name.ends_with('.') {
        return Some("ends with a dot");
    }
    let stem = name.split('.').next().unwrap_or(name).trim_end().to_lowercase();
    let numbered = |device: &str| {
        stem.strip_prefix(device).is_some_and(|rest| {
            let mut rest = rest.chars();
            let digit = rest.next().is_some_and(|c| c.is_ascii_digit() || "¹²³".contains(c));
            digit && rest.next().is_none()
        })
    };
    (RESERVED.contains(&stem.as_str()) || RESERVED_NUMBERED.iter().any(|d| numbered(d)))
        .then_some("is the name of a device on Windows")
}

/// A name from another program, changed to one that a file can have on every system: forbidden
/// characters become `_`, and it is cut to `most_bytes`. Empty if nothing is left.
pub(crate) fn made_for_files(name: &str, most_bytes: usize) -> String {
    let fit = |c: char| if is_invisible(c) || SEPARATORS.contains(&c) { '_' } else { c };
    let mut made = String::new();
    for c in name.trim().trim_start_matches('.').chars().map(fit) {
        if made.len() + c.len_utf8() > most_bytes {
            break;
        }
        made.push(c);
    }
    let made = made.trim_matches(|c: char| c.is_whitespace() || c == '.');
    match refused_for_file(made) {
        // The name of a device: a leading `_` makes it an ordinary name.
        Some(_) if !made.is_empty() => format!("_{made}"),
        _ => made.to_owned(),
    }
}

/// Names that are given, each to one thing alone, whatever the case of its letters.
#[derive(Debug, Default)]
pub(crate) struct OwnNames(BTreeMap<String, usize>);

impl OwnNames {
    /// The name; with a separator and a number behind it if another thing has it.
    pub(crate) fn take(&mut self, name: &str, separator: char) -> String {
        let first = folded(name);
        let mut next = self.0.get(&first).copied().unwrap_or(1);
        loop {
            let taken =
                if next == 1 { name.to_owned() } else { format!("{name}{separator}{next}") };
            next += 1;
            if let Entry::Vacant(free) = self.0.entry(folded(&taken)) {
                free.insert(2);
                self.0.insert(first, next);
                return taken;
            }
        }
    }
}

/// A name for comparison: lower case, with composed accents (NFC), since some file systems ignore
/// case and the composition of letters and accents.
pub(crate) fn folded(name: &str) -> String {
    let composed: String = name.nfc().collect();
    composed.to_lowercase().nfc().collect()
}

/// Whether a character is a control character, invisible, or changes the direction of writing,
/// which can hide an ending.
pub(crate) fn is_invisible(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}')
}

/// The text with U+FFFD for each control or invisible character, so that no name and no path can
/// control a terminal or disguise itself. Line feeds stay.
pub fn visible(text: &str) -> String {
    text.chars().map(|c| if is_invisible(c) && c != '\n' { '\u{fffd}' } else { c }).collect()
}

/// A text of a file for a message: in quotation marks, on one line, cut after 60 characters.
pub fn shown(text: &str) -> String {
    const SHOWN: usize = 60;
    let clean = |c: char| if is_invisible(c) { '\u{fffd}' } else { c };
    let mut short: String = text.chars().take(SHOWN).map(clean).collect();
    if text.chars().nth(SHOWN).is_some() {
        short.push('…');
    }
    format!("'{short}'")
}

/// The known name that is nearest to `wanted`, if one is near.
pub(crate) fn nearest<'a>(
    wanted: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    // The least similarity of a suggestion, 0 ..= 1: with more than about a third of the letters
    // changed it is another word. A text longer than any name is no typing error.
    const NEAR: f64 = 0.65;
    if wanted.len() > MAX_NAME_BYTES {
        return None;
    }
    let wanted = folded(wanted);
    let mut best: Option<(f64, &str)> = None;
    for name in known {
        let score = strsim::normalized_damerau_levenshtein(&wanted, &folded(name));
        if score > best.map_or(NEAR, |(score, _)| score) {
            best = Some((score, name));
        }
    }
    best.map(|(_, name)| name)
}

/// A hint that names the nearest of the known names and lists them: `Did you mean 'keel'? Known
/// here: 'keel', 'sheer'.`
pub(crate) fn did_you_mean(wanted: &str, known: &[&str]) -> String {
    const LISTED: usize = 20;
    let mut hint = match nearest(wanted, known.iter().copied()) {
        Some(name) => format!("Did you mean {}? ", shown(name)),
        None => String::new(),
    };
    if known.is_empty() {
        hint.push_str("There are none here.");
        return hint;
    }
    let list: Vec<String> = known.iter().take(LISTED).map(|name| shown(name)).collect();
    let more = known.len().saturating_sub(LISTED);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    hint.push_str(&format!("Known here: {}{rest}.", list.join(", ")));
    hint
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_some_system_does_not_take_are_refused_on_all() {
        for name in [
            "",
            ".",
            "..",
            "a/b",
            "a\\b",
            "c:d",
            "CON",
            "con.old",
            "Com1",
            "lpt9.x",
            "nul ",
            ".hidden",
            "dot.",
            "space ",
            "a\nb",
            "a\u{202e}gvs",
            "COM²",
            "lpt¹.svg",
            "CONIN$",
            "conout$.old",
            "Clock$",
            &"x".repeat(101),
        ] {
            assert!(refused_for_file(name).is_some(), "{name:?}");
        }
        for name in ["bottom", "Seite 1", "contour", "com10", "comma", "größe", "a.b", "-a"] {
            assert_eq!(refused_for_file(name), None, "{name:?}");
        }
        assert!(refused_for_curve("-a").is_some());
    }

    #[test]
    fn names_of_other_programs_are_made_fit() {
        for (name, made) in [
            ("a/b:c", "a_b_c"),
            ("  hull ", "hull"),
            ("con", "_con"),
            ("..", ""),
            (".hidden. ", "hidden"),
            ("größe", "größ"),
            ("a\nb", "a_b"),
        ] {
            assert_eq!(made_for_files(name, 6), made, "{name:?}");
            assert!(made.is_empty() || refused_for_file(made).is_none());
        }
    }

    #[test]
    fn the_nearest_name_is_found_unless_none_is_near() {
        let known = ["rails", "boundary", "holes"];
        assert_eq!(nearest("boundry", known), Some("boundary"));
        assert_eq!(nearest("RAILS", known), Some("rails"));
        assert_eq!(nearest("colour", known), None);
        assert_eq!(nearest(&"rails".repeat(1000), known), None);
        assert_eq!(
            did_you_mean("hole", &known),
            "Did you mean 'holes'? Known here: 'rails', 'boundary', 'holes'."
        );
    }

    #[test]
    fn what_terminals_obey_is_made_visible() {
        let odd = "a\u{1b}[31mb\u{9b}2J\u{7f}\r\t\u{202e}c\nd";
        let made = visible(odd);
        assert_eq!(made.matches('\u{fffd}').count(), 6, "{made:?}");
        assert!(made.ends_with("c\nd") && made.chars().count() == odd.chars().count());
    }

    #[test]
    fn what_is_shown_is_short_and_in_one_line() {
        assert_eq!(shown("a\nb"), "'a\u{fffd}b'");
        assert_eq!(shown(&"y".repeat(100)).chars().count(), 63);
    }
}
