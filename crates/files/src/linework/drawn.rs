//! What a reader of drawings finds: curves with their names and layers, in millimetres, and a tally
//! of everything else.

use super::segment::Segment;
use sheetwright::design::{ReadNote, Unused};
use sheetwright::math::Point3;
use std::collections::BTreeMap;
use std::rc::Rc;

/// The most pieces of curves of a drawing, copies of blocks and symbols among them.
pub(super) const MAX_SEGMENTS: usize = 300_000;
/// The most layers of a curve that are kept, from the innermost.
pub(super) const MAX_LAYERS: usize = 24;
/// The most characters of a name that are kept.
pub(super) const MAX_NAME: usize = 80;
/// The most names of things that were not used that are kept.
const NAMES: usize = 20;

/// The most characters of such a name.
const SHOWN_NAME: usize = 60;

/// A curve of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Drawn {
    /// Its own names: a label first, then its id.
    pub(super) names: Vec<String>,
    /// The names of its layers or groups, from the innermost.
    pub(super) layers: Rc<Vec<String>>,
    /// Its pieces, each beginning where the last ends.
    pub(super) segments: Vec<Segment>,
    /// Whether it ends where it begins.
    pub(super) closed: bool,
}

impl Drawn {
    pub(super) fn start(&self) -> Option<Point3> {
        self.segments.first().map(Segment::start)
    }

    pub(super) fn end(&self) -> Option<Point3> {
        self.segments.last().map(Segment::end)
    }

    /// Its own names and those of its layers.
    pub(super) fn all_names(&self) -> impl Iterator<Item = &str> {
        self.names.iter().chain(self.layers.iter()).map(String::as_str)
    }

    /// Its name for people.
    pub(super) fn name(&self) -> &str {
        let mut names = self.all_names();
        names.find(|name| !is_automatic(name)).unwrap_or("curve")
    }
}

/// Whether a program gave this name, not a person: `path846`, `g12-3`, or the layer `0` of what
/// lies on none.
fn is_automatic(name: &str) -> bool {
    const KINDS: [&str; 13] = [
        "", "path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "g", "use", "svg",
        "layer", "svg-path",
    ];
    let rest = name.trim_end_matches(|c: char| c.is_ascii_digit() || c == '-');
    name.is_empty() || (rest.len() < name.len() && KINDS.contains(&rest))
}

/// All that a reader finds.
#[derive(Debug, Default)]
pub(super) struct Drawing {
    pub(super) curves: Vec<Drawn>,
    pub(super) unused: Tally,
    /// What else is to be said.
    pub(super) notes: Vec<ReadNote>,
    /// The number of pieces so far.
    segments: usize,
}

impl Drawing {
    /// Adds a curve without pieces of no length; whether there is still room.
    pub(super) fn add(&mut self, mut curve: Drawn) -> bool {
        self.segments += curve.segments.len();
        curve.segments.retain(|segment| !(segment.is_line() && segment.start() == segment.end()));
        if !curve.segments.is_empty() {
            self.curves.push(curve);
        }
        self.segments <= MAX_SEGMENTS
    }
}

/// How many things of each kind are not used, with some of their names.
#[derive(Debug, Default)]
pub(super) struct Tally(BTreeMap<Unused, Counted>);

#[derive(Debug, Default)]
struct Counted {
    count: usize,
    names: Vec<String>,
    at: Option<Point3>,
}

impl Tally {
    pub(super) fn add(&mut self, what: Unused, name: &str, at: Option<Point3>) {
        let counted = self.0.entry(what).or_default();
        counted.count += 1;
        if counted.names.len() < NAMES && !name.is_empty() {
            let short: String = name.chars().take(SHOWN_NAME).collect();
            if !counted.names.contains(&short) {
                counted.names.push(short);
            }
        }
        counted.at = counted.at.or(at);
    }

    pub(super) fn add_curve(&mut self, what: Unused, curve: &Drawn) {
        self.add(what, curve.name(), curve.start());
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn notes(self) -> impl Iterator<Item = ReadNote> {
        self.0.into_iter().map(|(what, Counted { count, names, at })| ReadNote::NotUsed {
            what,
            count,
            names,
            at,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::is_automatic;

    #[test]
    fn names_by_programs_are_known() {
        for (name, is) in [
            ("path846", true),
            ("g12-3", true),
            ("0", true),
            ("", true),
            ("path", false),
            ("lid", false),
            ("rail-1", false),
            ("Layer 1", false),
        ] {
            assert_eq!(is_automatic(name), is, "{name:?}");
        }
    }
}
