//! Parts with their trims, which depend on the edges of all parts of a design.

use super::error::{MakeCause, MakeError};
use super::part::Part;
use crate::check::{Finding, FindingKind, Place};
use crate::design::Trim;
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
    let seen: Vec<TrimPart<'_>> =
        parts.iter().zip(&drawn).map(|(part, drawn)| seen(part, drawn)).collect();
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

fn seen<'a>(part: &'a Part, drawn: &'a [Point3]) -> TrimPart<'a> {
    TrimPart {
        name: &part.name,
        panel: &part.panel,
        edges: &part.edges,
        space: drawn,
        flat: &part.flat.points,
        triangles: part.sheet.mesh().triangles(),
    }
}
