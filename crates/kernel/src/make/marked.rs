//! Parts with the marks on their faces, and all their texts in their places: those of edges name
//! other parts, so this comes last.

use super::error::{MakeCause, MakeError};
use super::part::Part;
use crate::check::{Finding, FindingKind, Place};
use crate::design::Mark;
use crate::mark::{MarkPart, Marked, marked};
use crate::pattern::{Labelled, PatternPath, Room, Wish};

/// An edge names no more edges that it is joined to.
const NAMED: usize = 2;

/// Adds the marks of a design to the patterns of its parts, whose edges have their mates and which
/// have their trims, and places all texts anew, unless the patterns are bare. Marks that parts had
/// went with their trims.
///
/// # Errors
/// The first mark that can't be made.
pub(super) fn mark_parts(
    parts: &mut [Part],
    marks: &[Mark],
    is_bare: bool,
) -> Result<(), MakeError> {
    let is_note = |finding: &Finding| matches!(finding.kind, FindingKind::Marked { .. });
    parts.iter_mut().for_each(|part| part.checked.findings.retain(|finding| !is_note(finding)));
    let mut wishes: Vec<Vec<Wish>> = parts.iter().map(|_| Vec::new()).collect();
    if !marks.is_empty() {
        let seen: Vec<MarkPart<'_>> = parts.iter().map(seen).collect();
        let fault = |fault| MakeError::of_design(MakeCause::Mark(fault));
        let made = marked(&seen, marks).map_err(fault)?;
        for ((part, made), wishes) in parts.iter_mut().zip(made).zip(&mut wishes) {
            let Marked { paths, wishes: texts, notes } = made;
            part.piece.paths.extend(paths);
            *wishes = texts;
            for note in notes {
                part.checked.add(Finding::new(FindingKind::Marked { note }, Place::Whole));
            }
        }
    }
    if is_bare {
        return Ok(());
    }
    let joined: Vec<Vec<Option<String>>> = parts.iter().map(|part| joined(part, parts)).collect();
    for ((part, joined), wishes) in parts.iter_mut().zip(&joined).zip(&wishes) {
        let is_net = part.given().is_some_and(|given| given.is_net);
        let Part { sheet, flat, edges, bends, piece, .. } = part;
        let (marks, flat) = (bends.marks, &flat.points[..]);
        piece.label(&Labelled { sheet, flat, edges, joined, marks, is_net }, wishes);
    }
    Ok(())
}

/// The lines of marks on parts, without being drawn there; `None` where a mark can't be made.
pub(super) fn drawn(parts: &[Part], marks: &[Mark]) -> Option<Vec<Vec<PatternPath>>> {
    if marks.is_empty() {
        return None;
    }
    let seen: Vec<MarkPart<'_>> = parts.iter().map(seen).collect();
    let made = marked(&seen, marks).ok()?;
    Some(made.into_iter().map(|made| made.paths).collect())
}

fn seen(part: &Part) -> MarkPart<'_> {
    MarkPart {
        name: &part.name,
        panel: &part.panel,
        edges: &part.edges,
        mesh: part.sheet.mesh(),
        flat: &part.flat.points,
        room: Room::new(part.piece.net_loops()),
    }
}

/// What each edge of a part is joined to, in words: the other part where both edges have one name,
/// as along a shared curve, else the other edge.
fn joined(part: &Part, parts: &[Part]) -> Vec<Option<String>> {
    let of_edge = |edge: &crate::edge::Edge| {
        let mut mates: Vec<String> = Vec::new();
        for mate in &edge.mates {
            let other = &parts[mate.part];
            let of_other = &other.edges[mate.edge].name;
            let is_shared = *of_other == edge.name;
            let name =
                if is_shared { other.name.clone() } else { format!("{}/{of_other}", other.name) };
            if !mates.contains(&name) {
                mates.push(name);
            }
        }
        let left_out = mates.len().saturating_sub(NAMED);
        mates.truncate(NAMED);
        if left_out > 0 {
            mates.push(format!("+{left_out}"));
        }
        (!mates.is_empty()).then(|| mates.join(", "))
    };
    part.edges.iter().map(of_edge).collect()
}
