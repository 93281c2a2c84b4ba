//! What was made of a panel.

use super::{Wire, fields, kinds};
use crate::engine::shown::{Shown, ShownPanel, ShownRung, ShownStrain};
use sheetwright::bend::BendLine;
use sheetwright::check::Verdict;
use sheetwright::index::{SampleIndex, VertexIndex};
use sheetwright::pattern::{LabelKind, PathKind, PatternLabel, PatternPath, Piece, Role};
use sheetwright::rung::Rung;

fields!(ShownPanel { name, panel, made });
fields!(Shown {
    verdict,
    findings,
    is_mesh,
    positions,
    loops,
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
    length_error_max,
    chords_mm,
    strain
});
fields!(ShownStrain { flat, positions, triangles, strains, decides, limit });
fields!(ShownRung { ends, flat_ends, warp_deg, is_unsure, crease_deg, normals });
fields!(Piece { name, paths, labels, size, corner, bends, border, is_folded });
fields!(BendLine { strip, is_fold, ends, angle, inside_radius_mm, pitch_mm, along_mm, beyond_mm });
fields!(PatternPath { role, kind, points, closed });
fields!(PatternLabel { kind, role, at, along, height_mm, text });
kinds!(Verdict { Bends, BendsWithForce, Roll, BendsAndFolds, Undecided, WillNotBend });
kinds!(Role { Cut, Inner, Drill, Score, Net, Engrave, Note, Sheet });
kinds!(LabelKind { Name, Quantity, Edge, Mark, Length, Angle, Overall, Trim, Bend, OnFace });

impl Wire for PathKind {
    fn put(&self, out: &mut Vec<u8>) {
        out.push(match self {
            Self::Outline => 0,
            Self::Hole => 1,
            Self::Rung(_) => 2,
            Self::Crease => 3,
            Self::BendTick => 4,
            Self::SeamTick => 5,
            Self::Dimension => 6,
            Self::Fold { mountain: true } => 7,
            Self::Fold { mountain: false } => 8,
            Self::Net => 9,
            Self::Drill { .. } => 10,
            Self::Notch => 11,
            Self::TrimFold { mountain: true } => 12,
            Self::TrimFold { mountain: false } => 13,
            Self::TrimTick => 14,
            Self::Bend { up: true } => 15,
            Self::Bend { up: false } => 16,
            Self::Station => 17,
            Self::Grain => 18,
            Self::OnFold => 19,
            Self::Arrow => 20,
            Self::Leader => 21,
            Self::SheetEdge => 22,
            Self::LapEnd => 23,
        });
        match self {
            Self::Rung(rung) => rung.put(out),
            Self::Drill { diameter_mm } => diameter_mm.put(out),
            _ => {}
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(match u8::take(from)? {
            0 => Self::Outline,
            1 => Self::Hole,
            2 => Self::Rung(Rung::take(from)?),
            3 => Self::Crease,
            4 => Self::BendTick,
            5 => Self::SeamTick,
            6 => Self::Dimension,
            7 => Self::MOUNTAIN,
            8 => Self::VALLEY,
            9 => Self::Net,
            10 => Self::Drill { diameter_mm: f64::take(from)? },
            11 => Self::Notch,
            12 => Self::TrimFold { mountain: true },
            13 => Self::TrimFold { mountain: false },
            14 => Self::TrimTick,
            15 => Self::Bend { up: true },
            16 => Self::Bend { up: false },
            17 => Self::Station,
            18 => Self::Grain,
            19 => Self::OnFold,
            20 => Self::Arrow,
            21 => Self::Leader,
            22 => Self::SheetEdge,
            23 => Self::LapEnd,
            _ => return None,
        })
    }
}

impl Wire for Rung {
    fn put(&self, out: &mut Vec<u8>) {
        self.ends().put(out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let [a, b] = <[SampleIndex; 2]>::take(from)?;
        (a < b).then(|| Self::new(a.get(), b.get()))
    }
}

impl Wire for VertexIndex {
    fn put(&self, out: &mut Vec<u8>) {
        (self.get() as u32).put(out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(Self::new(u32::take(from)? as usize))
    }
}

impl Wire for SampleIndex {
    fn put(&self, out: &mut Vec<u8>) {
        (self.get() as u32).put(out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(Self::new(u32::take(from)? as usize))
    }
}
