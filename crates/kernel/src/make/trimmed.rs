//! Parts with their trims, which depend on the edges of all parts of a design.

use super::error::{MakeCause, MakeError};
use super::part::Part;
use crate::check::{Finding, FindingKind, Place};
use crate::design::Trim;
use crate::edge::Edge;
use crate::trim::{TrimNote, TrimPart, Trimmed, trimmed};
use sheetwright_geometry::math::Point3;

/// Adds the trims of a design to the patterns of its parts, whose edges have their mates, in place
/// of those that they have. A pattern that overlaps itself has no inside to cut around, so it is
/// left as it is.
///
/// # Errors
/// The first trim that can't be made.
pub(super) fn trim_parts(parts: &mut [Part], trims: &[Trim]) -> Result<(), MakeError> {
    for part in parts.iter_mut() {
        part.piece.untrim();
        part.checked
            .findings
            .retain(|finding| !matches!(finding.kind, FindingKind::Trimmed { .. }));
    }
    if trims.is_empty() {
        return Ok(());
    }
    let drawn: Vec<Vec<Point3>> = parts.iter().map(Part::drawn).collect();
    let shown: Vec<Vec<String>> = parts.iter().map(shown).collect();
    let seen = parts.iter().zip(&drawn).zip(&shown);
    let seen: Vec<TrimPart<'_>> =
        seen.map(|((part, drawn), shown)| seen_part(part, drawn, shown)).collect();
    let made = trimmed(&seen, trims).map_err(|(part, fault)| match part {
        Some(part) => MakeError::of_panel(&parts[part].panel, MakeCause::Trim(fault)),
        None => MakeError::of_design(MakeCause::Trim(fault)),
    })?;
    for (part, made) in parts.iter_mut().zip(made) {
        let Trimmed { cut, paths, labels, mut notes } = made;
        if part.flat.overlap.is_some() {
            notes = vec![TrimNote::Overlaps];
        } else {
            part.piece.trim(cut, paths, labels);
        }
        for note in notes {
            part.checked.add(Finding::new(FindingKind::Trimmed { note }, Place::Whole));
        }
    }
    Ok(())
}

/// How the pattern of a part shows its edges: by their marks, or by their names.
fn shown(part: &Part) -> Vec<String> {
    let shown = |edge: &Edge| match &part.edge_marks(edge, None)[..] {
        [] => edge.name.clone(),
        marks => marks.join(", "),
    };
    part.edges.iter().map(shown).collect()
}

fn seen_part<'a>(part: &'a Part, drawn: &'a [Point3], shown: &'a [String]) -> TrimPart<'a> {
    TrimPart {
        name: &part.name,
        panel: &part.panel,
        edges: &part.edges,
        shown,
        space: drawn,
        flat: &part.flat.points,
        triangles: part.sheet.mesh().triangles(),
    }
}
