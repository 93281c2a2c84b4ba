//! What the words of a table mean: stations, lines, heights and half-breadths, units.

use super::notation::{Cell, cell};
use crate::quantity::unit_of;
use crate::units::Units;

/// The coordinate that a cell gives of a line at a station.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Quantity {
    /// The place along the boat, for a line whose points lie off the stations.
    Along,
    /// The half-breadth.
    HalfBreadth,
    /// The whole breadth, twice the half-breadth.
    Breadth,
    /// The height above the base line.
    Height,
}

/// The kind of a line, by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LineKind {
    /// A line in space, such as a sheer or a chine.
    Edge,
    /// A line of edges that lies in the middle plane, such as a keel, unless half-breadths say
    /// otherwise.
    Middle,
    /// A waterline, at one height.
    Waterline,
    /// A buttock, at one half-breadth.
    Buttock,
    /// A diagonal, whose plane no table gives.
    Diagonal,
}

/// Words for quantities, those with more letters first.
const QUANTITIES: [(&str, Quantity); 34] = [
    ("half-breadths", Quantity::HalfBreadth),
    ("half-breadth", Quantity::HalfBreadth),
    ("half breadths", Quantity::HalfBreadth),
    ("half breadth", Quantity::HalfBreadth),
    ("halfbreadths", Quantity::HalfBreadth),
    ("halfbreadth", Quantity::HalfBreadth),
    ("half widths", Quantity::HalfBreadth),
    ("half width", Quantity::HalfBreadth),
    ("half-width", Quantity::HalfBreadth),
    ("1/2 breadths", Quantity::HalfBreadth),
    ("1/2 breadth", Quantity::HalfBreadth),
    ("½ breadth", Quantity::HalfBreadth),
    ("from centreline", Quantity::HalfBreadth),
    ("from centerline", Quantity::HalfBreadth),
    ("from centre line", Quantity::HalfBreadth),
    ("from center line", Quantity::HalfBreadth),
    ("from c.l.", Quantity::HalfBreadth),
    ("full breadths", Quantity::Breadth),
    ("full breadth", Quantity::Breadth),
    ("full width", Quantity::Breadth),
    ("full beam", Quantity::Breadth),
    ("above base line", Quantity::Height),
    ("above baseline", Quantity::Height),
    ("from base line", Quantity::Height),
    ("from baseline", Quantity::Height),
    ("above base", Quantity::Height),
    ("heights", Quantity::Height),
    ("height", Quantity::Height),
    ("h.a.b.", Quantity::Height),
    ("widths", Quantity::HalfBreadth),
    ("width", Quantity::HalfBreadth),
    ("breadths", Quantity::HalfBreadth),
    ("hab", Quantity::Height),
    ("hb", Quantity::HalfBreadth),
];

/// Single letters and other words that are quantities only as a whole word.
const LETTERS: [(&str, Quantity); 12] = [
    ("x", Quantity::Along),
    ("position", Quantity::Along),
    ("along", Quantity::Along),
    ("y", Quantity::HalfBreadth),
    ("h.b.", Quantity::HalfBreadth),
    ("b", Quantity::HalfBreadth),
    ("w", Quantity::HalfBreadth),
    ("breadth", Quantity::HalfBreadth),
    ("beam", Quantity::Breadth),
    ("z", Quantity::Height),
    ("h", Quantity::Height),
    ("ht", Quantity::Height),
];

/// Words of which a name of an edge of a hull is made.
const EDGES: [&str; 23] = [
    "sheer",
    "chine",
    "keel",
    "deck",
    "gunwale",
    "gunnel",
    "rabbet",
    "profile",
    "knuckle",
    "bottom",
    "rail",
    "fairbody",
    "fair-body",
    "coaming",
    "skeg",
    "garboard",
    "strake",
    "plank",
    "line",
    "cl",
    "c.l.",
    "edge",
    "bulwark",
];

/// Words of which the name of a line in the middle plane is made.
const MIDDLE: [&str; 8] =
    ["keel", "rabbet", "profile", "fairbody", "fair-body", "centreline", "centerline", "c.l."];

/// Words for stations.
const STATIONS: [&str; 22] = [
    "stations", "station", "sta.", "sta", "stn", "st.", "st", "frames", "frame", "fr.", "fr",
    "sections", "section", "sec.", "sec", "moulds", "mould", "molds", "mold", "ordinate", "spant",
    "form",
];

/// Words for the places of stations.
const POSITIONS: [&str; 12] = [
    "position",
    "positions",
    "distance",
    "distances",
    "location",
    "length",
    "x",
    "from bow",
    "from stern",
    "from stem",
    "from transom",
    "from ap",
];

/// A text as the label of a line: its name, what it gives and its kind.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LineLabel {
    /// The name without the words for the quantity; empty if it has those alone.
    pub(super) name: String,
    /// What it gives, if it says so.
    pub(super) quantity: Option<Quantity>,
    /// The kind.
    pub(super) kind: LineKind,
}

/// Splits a label of a line, such as `Height of sheer` or `Chine HB (mm)`.
pub(super) fn line_label(text: &str) -> LineLabel {
    label_below(text, None)
}

/// Splits a label of a line below a title that may give a quantity: letters that number lines, as
/// in `Chine B`, are then no quantities.
pub(super) fn label_below(text: &str, title: Option<Quantity>) -> LineLabel {
    let mut name = without_brackets(text);
    let mut quantity = bracketed(text).and_then(|inside| quantity_of_words(&inside));
    for (word, means) in QUANTITIES {
        if let Some(rest) = without_word(&name, word) {
            quantity = quantity.or(Some(means));
            name = rest;
        }
    }
    let words: Vec<&str> = name.split([' ', ',']).filter(|word| !word.is_empty()).collect();
    // A letter at the end of a name: Sheer z.
    if quantity.is_none()
        && let [.., last] = words[..]
        && !(title.is_some() && ["b", "h", "w"].iter().any(|n| last.eq_ignore_ascii_case(n)))
        && let Some((_, means)) = LETTERS.iter().find(|(word, _)| last.eq_ignore_ascii_case(word))
    {
        quantity = Some(*means);
        name = words[..words.len() - 1].join(" ");
    }
    let joins = [" of", " at", " from", " above", " to"];
    let mut name = name.trim_matches([' ', '-', ':', ',', '–', '/', '&']).to_owned();
    for join in joins {
        if let Some(rest) = strip_end(&name, join) {
            name = rest;
        }
    }
    for join in ["of ", "to ", "at ", "above ", "the "] {
        if let Some(rest) = strip_begin(&name, join) {
            name = rest;
        }
    }
    let kind = kind_of(&name);
    LineLabel { name, quantity, kind }
}

/// The quantity that a text without a name stands for, such as `Heights above base`.
pub(super) fn quantity_of(text: &str) -> Option<Quantity> {
    let label = line_label(text);
    let is_filler = |word: &str| {
        ["the", "in", "and", "&", "below", "base", "line", "cl", "to", "outside", "inside", "of"]
            .contains(&word)
            || unit_word(word).is_some()
            || ["planking", "plank", "offsets", "table"].contains(&word)
    };
    let name = label.name.to_ascii_lowercase();
    let alone = name.split([' ', ',', ':']).filter(|word| !word.is_empty()).all(is_filler);
    label.quantity.filter(|_| alone)
}

/// A quantity by a text that is nothing else: HAB, z.
fn quantity_of_words(text: &str) -> Option<Quantity> {
    let text = text.trim().to_ascii_lowercase();
    let listed = QUANTITIES.iter().chain(&LETTERS).find(|(word, _)| text == *word);
    listed.map(|(_, quantity)| *quantity)
}

fn kind_of(name: &str) -> LineKind {
    let lower = name.to_ascii_lowercase();
    let begins = |words: &[&str]| {
        words.iter().any(|word| {
            lower.strip_prefix(word).is_some_and(|rest| !rest.starts_with(char::is_alphabetic))
        })
    };
    let ends = |words: &[&str]| words.iter().any(|word| lower.ends_with(word));
    if begins(&["w.l.", "w.l", "wl", "lwl", "dwl", "cwl", "waterline", "water line", "water-line"])
        || ends(&[" wl", " waterline", " w.l."])
    {
        LineKind::Waterline
    } else if begins(&["buttock", "buttocks", "butt", "butt.", "b-"]) || ends(&[" buttock"]) {
        LineKind::Buttock
    } else if begins(&["diagonal", "diag", "diag.", "d-"]) {
        LineKind::Diagonal
    } else if MIDDLE.iter().any(|word| lower.contains(word)) || lower == "cl" {
        LineKind::Middle
    } else {
        LineKind::Edge
    }
}

/// Whether a text is the name of a line by its words.
pub(super) fn is_line(text: &str) -> bool {
    let lower = text.to_ascii_lowercase();
    let label = line_label(text);
    let has = |word: &&str| {
        lower.match_indices(*word).any(|(at, _)| {
            let before = lower[..at].chars().next_back();
            let after = lower[at + word.len()..].chars().next();
            let apart = |c: Option<char>| c.is_none_or(|c| !c.is_alphabetic() || c == 's');
            apart(before) && apart(after)
        })
    };
    !label.name.is_empty()
        && !is_station_word(text)
        && (!matches!(label.kind, LineKind::Edge | LineKind::Middle)
            || label.quantity.is_some()
            || EDGES.iter().any(has))
}

/// Whether a text begins with a word for stations, as in `Sta. 3`.
pub(super) fn is_station_word(text: &str) -> bool {
    let lower = text.trim().to_ascii_lowercase();
    let behind = |word: &str| lower.strip_prefix(word).map(str::to_owned);
    STATIONS
        .iter()
        .filter_map(|word| behind(word))
        .any(|rest| !rest.starts_with(|c: char| c.is_alphabetic()))
}

/// Whether a text heads the places of stations.
pub(super) fn is_position_word(text: &str) -> bool {
    let lower = without_brackets(text).to_ascii_lowercase();
    let words: Vec<&str> = lower.split([' ', ',', ':', '.']).collect();
    POSITIONS.iter().any(|word| match word.contains(' ') {
        true => lower.contains(word),
        false => words.contains(word),
    })
}

/// Whether a text heads the spacing of stations or waterlines.
pub(super) fn is_spacing_word(text: &str) -> bool {
    let lower = text.to_ascii_lowercase();
    ["spacing", "spaced", "apart"].iter().any(|word| lower.contains(word))
}

/// The name of a station without its word: `3` of `Sta. 3`; the word alone is empty.
pub(super) fn station_name(text: &str) -> String {
    let text = without_brackets(text);
    let lower = text.to_ascii_lowercase();
    let behind = STATIONS.iter().find_map(|word| {
        let rest = lower.strip_prefix(word)?;
        (!rest.starts_with(|c: char| c.is_alphabetic())).then(|| text[word.len()..].to_owned())
    });
    let name = behind.unwrap_or(text);
    let name = name.trim().trim_start_matches(['.', '#', ':']).trim();
    let number = strip_begin(name, "no.").or_else(|| strip_begin(name, "nr."));
    number.unwrap_or_else(|| name.to_owned()).trim().to_owned()
}

/// The unit that a text names, such as `Offsets in millimetres` or `(mm)`; `Err` if it names feet
/// and inches, of which cells say the unit themselves. A unit behind a number is of that number
/// alone, as in `12 ft skiff` and `Buttock 1 ft`.
pub(super) fn unit_in(text: &str) -> Option<Result<Units, ()>> {
    let lower = text.to_ascii_lowercase();
    if lower.contains("eighth") || lower.contains("8ths") {
        return Some(Err(()));
    }
    let words = words_with_places(&lower);
    let is_of_number = |at: usize| {
        let before = lower[..at].trim_end();
        let before = before.strip_suffix('-').unwrap_or(before);
        before.ends_with(|c: char| c.is_numeric())
    };
    let found = |n: usize| {
        let (at, word) = words[n];
        // "ft and in", "ft-in"
        let is_after_feet =
            words[..n].iter().rev().find(|(_, word)| *word != "and").is_some_and(|&(at, word)| {
                unit_word(word) == Some(Units::Feet) && !is_of_number(at)
            });
        match word {
            _ if is_of_number(at) => None,
            "in" if is_after_feet => Some(Units::Inches),
            // "in" is a unit where nothing follows it that it could belong to.
            "in" if n + 1 < words.len() => None,
            "m" | "in" if !(lower[..at].ends_with('(') || words.len() <= 3) => None,
            word => unit_word(word),
        }
    };
    let units: Vec<Units> = (0..words.len()).filter_map(found).collect();
    if units.contains(&Units::Feet) && units.contains(&Units::Inches) {
        return Some(Err(()));
    }
    units.first().copied().map(Ok)
}

/// The words of a text, each with the place where it begins.
fn words_with_places(text: &str) -> Vec<(usize, &str)> {
    let mut words = Vec::new();
    let mut at = 0;
    for word in text.split(|c: char| !c.is_alphabetic()) {
        if !word.is_empty() {
            words.push((at, word));
        }
        let behind = at + word.len();
        at = behind + text[behind..].chars().next().map_or(0, char::len_utf8);
    }
    words
}

/// The unit of a word.
fn unit_word(word: &str) -> Option<Units> {
    match word {
        "millimetre" | "millimetres" | "millimeter" | "millimeters" => Some(Units::Millimetres),
        "centimetre" | "centimetres" | "centimeter" | "centimeters" => Some(Units::Centimetres),
        "metre" | "metres" | "meter" | "meters" => Some(Units::Metres),
        "cms" => Some(Units::Centimetres),
        word => unit_of(word),
    }
}

/// The first length in a text that says its unit or is in feet, inches and eighths, mm: 24" in
/// `Stations are 24" apart`. A bare number is given as [`Cell::Bare`].
pub(super) fn length_in_words(text: &str) -> Option<Cell> {
    let words: Vec<&str> = text.split([' ', ':', '=']).filter(|word| !word.is_empty()).collect();
    let mut bare = None;
    for n in 0..words.len() {
        for count in [3, 2, 1] {
            let Some(some) = words.get(n..n + count) else { continue };
            let typed = some.join(" ");
            match cell(typed.trim_end_matches([',', '.', ')']), false) {
                length @ Cell::Length { .. } => return Some(length),
                number @ Cell::Bare { .. } => bare = bare.or(Some(number)),
                _ => {}
            }
        }
    }
    bare
}

/// A text without what stands in brackets.
fn without_brackets(text: &str) -> String {
    match (text.find('('), text.rfind(')')) {
        (Some(open), Some(close)) if open < close => {
            format!("{} {}", text[..open].trim(), text[close + 1..].trim()).trim().to_owned()
        }
        _ => text.trim().to_owned(),
    }
}

fn bracketed(text: &str) -> Option<String> {
    let (open, close) = (text.find('(')?, text.rfind(')')?);
    (open < close).then(|| text[open + 1..close].to_owned())
}

/// A text without a word in it, if it has it as a word of its own.
fn without_word(text: &str, word: &str) -> Option<String> {
    let lower = text.to_ascii_lowercase();
    let at = lower.find(word)?;
    let before = lower[..at].chars().next_back();
    let after = lower[at + word.len()..].chars().next();
    let apart = |c: Option<char>| c.is_none_or(|c| !c.is_alphanumeric());
    (apart(before) && apart(after)).then(|| {
        let (before, after) = (text[..at].trim(), text[at + word.len()..].trim());
        format!("{before} {after}").trim().to_owned()
    })
}

fn strip_end(text: &str, end: &str) -> Option<String> {
    let kept = text.len().checked_sub(end.len())?;
    let is_end = text.get(kept..)?.eq_ignore_ascii_case(end);
    is_end.then(|| text[..kept].trim().to_owned())
}

fn strip_begin(text: &str, begin: &str) -> Option<String> {
    let is_begin = text.get(..begin.len())?.eq_ignore_ascii_case(begin);
    is_begin.then(|| text[begin.len()..].trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_lines_say_name_quantity_and_kind() {
        use LineKind::{Buttock, Diagonal, Edge, Middle, Waterline};
        use Quantity::{Along, HalfBreadth, Height};
        for (text, name, quantity, kind) in [
            ("Sheer", "Sheer", None, Edge),
            ("Height of sheer", "sheer", Some(Height), Edge),
            ("Sheer height", "Sheer", Some(Height), Edge),
            ("Chine half-breadth (mm)", "Chine", Some(HalfBreadth), Edge),
            ("Upper chine HB", "Upper chine", Some(HalfBreadth), Edge),
            ("Chine (HAB)", "Chine", Some(Height), Edge),
            ("Sheer x", "Sheer", Some(Along), Edge),
            ("Keel", "Keel", None, Middle),
            ("C.L.", "C.L.", None, Middle),
            ("WL 12", "WL 12", None, Waterline),
            ("W.L. 1-0-0", "W.L. 1-0-0", None, Waterline),
            ("Buttock 1-0-0", "Buttock 1-0-0", None, Buttock),
            ("B-1", "B-1", None, Buttock),
            ("Diagonal A", "Diagonal A", None, Diagonal),
            ("1/2 breadth of gunwale", "gunwale", Some(HalfBreadth), Edge),
        ] {
            let want = LineLabel { name: name.to_owned(), quantity, kind };
            assert_eq!(line_label(text), want, "{text}");
        }
    }

    #[test]
    fn titles_say_a_quantity_and_names_of_lines_do_not() {
        use Quantity::{HalfBreadth, Height};
        for (text, quantity) in [
            ("Heights above base line", Some(Height)),
            ("HEIGHTS", Some(Height)),
            ("Half-breadths from centreline", Some(HalfBreadth)),
            ("Half-breadths from centreline (mm)", Some(HalfBreadth)),
            ("widths", Some(HalfBreadth)),
            ("Heights in mm", Some(Height)),
            ("HB", Some(HalfBreadth)),
            ("Sheer height", None),
            ("Sheer", None),
        ] {
            assert_eq!(quantity_of(text), quantity, "{text}");
        }
    }

    #[test]
    fn stations_and_units_by_their_words() {
        for (text, name) in [
            ("Sta 3", "3"),
            ("Station No. 3", "3"),
            ("St. 0", "0"),
            ("Frame 12", "12"),
            ("Transom", "Transom"),
            ("Stem", "Stem"),
            ("9 1/2", "9 1/2"),
            ("Station", ""),
        ] {
            assert_eq!(station_name(text), name, "{text}");
        }
        assert!(is_station_word("Stations") && is_station_word("STA.") && !is_station_word("Stem"));
        for (text, unit) in [
            ("Offsets in millimetres", Some(Ok(Units::Millimetres))),
            ("Heights (m)", Some(Ok(Units::Metres))),
            ("Station (in)", Some(Ok(Units::Inches))),
            ("Offsets in feet, inches and eighths", Some(Err(()))),
            ("All offsets in the drawing", None),
            ("units: ft", Some(Ok(Units::Feet))),
            ("mm", Some(Ok(Units::Millimetres))),
            ("# lines of a 12 ft skiff", None),
            ("# lines of a 12-ft skiff, in mm", Some(Ok(Units::Millimetres))),
            ("Scale 1 in 10", None),
            ("LOA 14 ft", None),
            ("Buttock 1 ft", None),
            ("Sta 3 (mm)", Some(Ok(Units::Millimetres))),
            ("Offsets in feet and inches", Some(Err(()))),
            ("Heights (ft-in)", Some(Err(()))),
            ("Heights in ft and in", Some(Err(()))),
            ("Heights in ft", Some(Ok(Units::Feet))),
        ] {
            assert_eq!(unit_in(text), unit, "{text}");
        }
        let spacing = length_in_words("Stations are 24\" apart");
        assert_eq!(spacing, Some(Cell::Length { mm: 609.6, is_feet: true }));
    }
}
