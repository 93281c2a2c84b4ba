//! Which edges a trim stands on.

use super::TrimFault;
use super::part::TrimPart;
use crate::design::TrimOn;
use crate::edge::{EdgePlace, EdgeSource};

/// An error names no more edges than this.
const NAMED: usize = 12;

/// The edges of some parts that a trim stands on, in order, each with whether it was named.
///
/// # Errors
/// A name that no edge has.
pub(super) fn chosen(
    parts: &[TrimPart<'_>],
    on: &[TrimOn],
) -> Result<Vec<(EdgePlace, bool)>, TrimFault> {
    let mut found: Vec<(EdgePlace, bool)> = Vec::new();
    for wanted in on {
        let mut is_somewhere = false;
        for (part, of_part) in parts.iter().enumerate() {
            for edge in (0..of_part.edges.len()).filter(|&edge| of_part.is_on(edge, wanted)) {
                let place = EdgePlace { part, edge };
                is_somewhere = true;
                let is_named = matches!(wanted, TrimOn::Edge { .. });
                match found.iter_mut().find(|(known, _)| *known == place) {
                    Some((_, named)) => *named |= is_named,
                    None => found.push((place, is_named)),
                }
            }
        }
        if let (TrimOn::Edge { part, edge }, false) = (wanted, is_somewhere) {
            let wanted = part.iter().chain([edge]).cloned().collect::<Vec<_>>().join("/");
            let all = parts.iter().flat_map(|part| part.edges.iter().map(|edge| part.called(edge)));
            return Err(TrimFault::NoSuchEdge { wanted, known: all.take(NAMED).collect() });
        }
    }
    found.sort_unstable();
    Ok(found)
}

impl TrimPart<'_> {
    fn is_on(&self, number: usize, wanted: &TrimOn) -> bool {
        let edge = &self.edges[number];
        match wanted {
            TrimOn::All => true,
            TrimOn::Free => edge.mates.is_empty(),
            TrimOn::Joined => !edge.mates.is_empty(),
            TrimOn::Cuts => matches!(edge.source, EdgeSource::Cut { .. }),
            TrimOn::Holes => self.is_around_hole(number),
            TrimOn::Edge { part, edge: name } => {
                *name == edge.name
                    && part.as_ref().is_none_or(|part| *part == self.name || *part == self.panel)
            }
        }
    }
}
