//! What is to be said of the drawing that a design was read from stands with its first part.

use super::part::Part;
use crate::check::{Finding, FindingKind};
use crate::design::ReadNote;

/// Says the notes with the first part, in place of those that were said before.
pub(super) fn say_notes(parts: &mut [Part], notes: &[ReadNote]) {
    let is_note = |finding: &Finding| matches!(finding.kind, FindingKind::Read { .. });
    parts.iter_mut().for_each(|part| part.checked.findings.retain(|finding| !is_note(finding)));
    let Some(first) = parts.first_mut() else { return };
    for note in notes {
        first.checked.add(Finding::of_whole(FindingKind::Read { note: note.clone() }));
    }
}
