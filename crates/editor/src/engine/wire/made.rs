//! What was made of a panel.

use super::{Wire, fields, kinds};
use crate::engine::shown::{Shown, ShownPanel, ShownRung};
use sheetwright::check::{Finding, Remedy, Severity, Verdict};
use sheetwright::pattern::{LabelKind, PathKind, PatternLabel, PatternPath, Piece, Role};
use sheetwright::rung::Rung;

/// The codes that findings have, in order. They are names in the kernel, which no bytes can be.
pub(super) const CODES: [&str; 30] = [
    "bend-lines",
    "better-without-plane",
    "border-not-true",
    "coarse-samples",
    "flipped",
    "folds",
    "joint-smoothed",
    "left-out",
    "length-error",
    "moved",
    "not-moved",
    "not-proven",
    "overlap",
    "pdf-reduced",
    "point",
    "point-contact",
    "radius-too-small",
    "ran-on",
    "refold",
    "rounded-corner",
    "rung-without-plane",
    "seam",
    "self-crossing",
    "stretch",
    "stretch-too-large",
    "turned-round",
    "warp-high",
    "warp-not-reached",
    "warp-too-large",
    "window-gap",
];

fields!(ShownPanel { name, made });
fields!(Shown {
    verdict,
    findings,
    proven_optimal,
    positions,
    loop_ends,
    triangles,
    flat,
    flat_triangles,
    sides,
    rungs,
    piece,
    warp_limit_deg,
    warp_max_deg,
    bend_radius_min_mm,
    gauss_area_sr,
    area_flat_mm2,
    length_error_max
});
fields!(ShownRung { ends, flat_ends, warp_deg, is_unsure, crease_deg, normals });
fields!(Piece { name, paths, labels, size });
fields!(PatternPath { role, kind, points, closed });
fields!(PatternLabel { kind, role, at, along, height_mm, text });
kinds!(Verdict { Bends, BendsAndFolds, BendsWithForce, Undecided, WillNotBend });
kinds!(Severity { Note, Warning, Error });
kinds!(Role { Cut, Score, Engrave, Note });
kinds!(LabelKind { Name, Edge, Mark, Length });

impl Wire for Finding {
    fn put(&self, out: &mut Vec<u8>) {
        let Self { severity, code, text, place, remedies } = self;
        severity.put(out);
        // What is not in the list arrives without its code, and with all its words.
        CODES.iter().position(|known| known == code).put(out);
        text.put(out);
        place.put(out);
        remedies.put(out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let severity = Severity::take(from)?;
        let number: Option<usize> = Wire::take(from)?;
        let code = match number {
            Some(number) => CODES.get(number)?,
            None => "",
        };
        let (text, place) = (String::take(from)?, String::take(from)?);
        Some(Self { severity, code, text, place, remedies: Wire::take(from)? })
    }
}

impl Wire for Remedy {
    fn put(&self, out: &mut Vec<u8>) {
        let (kind, count) = match self {
            Self::Effort => (0_u8, 0),
            Self::Darts => (1, 0),
            Self::SplitCreases => (2, 0),
            Self::Units => (3, 0),
            Self::Sheets(count) => (4, *count),
        };
        kind.put(out);
        count.put(out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let (kind, count) = (u8::take(from)?, usize::take(from)?);
        Some(match kind {
            0 => Self::Effort,
            1 => Self::Darts,
            2 => Self::SplitCreases,
            3 => Self::Units,
            4 => Self::Sheets(count),
            _ => return None,
        })
    }
}

impl Wire for PathKind {
    fn put(&self, out: &mut Vec<u8>) {
        out.push(match self {
            Self::Outline => 0,
            Self::Hole => 1,
            Self::Rung(_) => 2,
            Self::Crease => 3,
            Self::RulingTick => 4,
            Self::SeamTick => 5,
            Self::Dimension => 6,
        });
        if let Self::Rung(rung) = self {
            rung.ends().map(|end| end.get() as u32).put(out);
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(match u8::take(from)? {
            0 => Self::Outline,
            1 => Self::Hole,
            2 => {
                let [a, b] = <[u32; 2]>::take(from)?;
                Self::Rung((a < b).then(|| Rung::new(a as usize, b as usize))?)
            }
            3 => Self::Crease,
            4 => Self::RulingTick,
            5 => Self::SeamTick,
            6 => Self::Dimension,
            _ => return None,
        })
    }
}
