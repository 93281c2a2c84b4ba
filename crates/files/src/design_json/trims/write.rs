//! A trim from the kernel's form to its file's.

use super::form::{KindFile, LengthFile, OneOrMore, TrimFile, WidthFile};
use sheetwright::design::{Allowance, Places, Trim, TrimKind, TrimOn};
use sheetwright::math::to_deg;

/// An edge as files name it.
fn on_name(on: &TrimOn) -> String {
    match on {
        TrimOn::All => "all".to_owned(),
        TrimOn::Free => "free".to_owned(),
        TrimOn::Joined => "joined".to_owned(),
        TrimOn::Cuts => "cuts".to_owned(),
        TrimOn::Holes => "holes".to_owned(),
        TrimOn::Edge { part: None, edge } => edge.clone(),
        TrimOn::Edge { part: Some(part), edge } => format!("{part}/{edge}"),
    }
}

/// A trim as its file has it.
pub(super) fn file_of(trim: &Trim) -> TrimFile {
    let names: Vec<String> = trim.on.iter().map(on_name).collect();
    let on = match &names[..] {
        [one] => OneOrMore::One(one.clone()),
        _ => OneOrMore::More(names),
    };
    let span = (trim.span != [0.0, 1.0]).then_some(trim.span);
    TrimFile { on, span, kind: kind_file(&trim.kind) }
}

fn kind_file(kind: &TrimKind) -> KindFile {
    // With its unit, so that it does not depend on that of the file.
    let mm = LengthFile::of_mm;
    let some = |length: f64| Some(mm(length));
    let places = |places: &Places| match places {
        Places::Shares(shares) => (Some(shares.clone()), None, None),
        Places::Lengths(lengths) => (None, Some(lengths.iter().copied().map(mm).collect()), None),
        Places::Every(every) => (None, None, some(*every)),
    };
    match kind {
        TrimKind::Allowance(Allowance { width: [from, to], corner }) => KindFile::Allowance {
            width: match from == to {
                true => WidthFile::Even(mm(*from)),
                false => WidthFile::Ends([mm(*from), mm(*to)]),
            },
            corners: (*corner).into(),
        },
        TrimKind::Hem(hem) => KindFile::Hem { width: mm(hem.width), turn: some(hem.turn) },
        TrimKind::Flange(flange) => KindFile::Flange {
            width: mm(flange.width),
            angle_deg: Some(to_deg(flange.angle)),
            relief: some(flange.relief),
        },
        TrimKind::Tabs(tabs) => KindFile::Tabs {
            width: some(tabs.width),
            angle_deg: Some(to_deg(tabs.angle)),
            tolerance: some(tabs.tolerance),
        },
        TrimKind::Holes(holes) => KindFile::Holes {
            pitch: mm(holes.pitch),
            end_pitch: some(holes.end_pitch),
            end_length: some(holes.end_length),
            ends: some(holes.ends),
            inset: some(holes.inset),
            diameter: mm(holes.diameter),
        },
        TrimKind::Notches(notches) => {
            let (at, at_lengths, every) = places(&notches.at);
            KindFile::Notches {
                at,
                at_lengths,
                every,
                form: notches.form.into(),
                depth: some(notches.depth),
                width: some(notches.width),
                count: Some(notches.count),
                gap: some(notches.gap),
            }
        }
        TrimKind::Ticks(ticks) => {
            let (at, at_lengths, every) = places(&ticks.at);
            let (length, numbered) = (some(ticks.length), ticks.numbered);
            KindFile::Ticks { at, at_lengths, every, length, numbered }
        }
        TrimKind::Fingers(fingers) => KindFile::Fingers {
            width: some(fingers.width),
            depth: some(fingers.depth),
            clearance: some(fingers.clearance),
        },
        TrimKind::Slots(slots) => KindFile::Slots {
            pitch: some(slots.pitch),
            width: some(slots.width),
            depth: some(slots.depth),
            thickness: some(slots.thickness),
            clearance: some(slots.clearance),
            beyond: some(slots.beyond),
            dogbone: some(slots.dogbone),
        },
        TrimKind::Puzzle(puzzle) => KindFile::Puzzle {
            pitch: some(puzzle.pitch),
            width: some(puzzle.width),
            clearance: some(puzzle.clearance),
        },
    }
}
