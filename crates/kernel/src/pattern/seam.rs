//! The marks of a seam: the same letters and a tick in the middle of both its sides, and how long
//! it is.

use super::dimension::millimetres;
use super::{LabelKind, PathKind, PatternLabel, PatternPath, Role};
use crate::flatten::{Flattened, Sheet};
use sheetwright_geometry::math::{Point2, Vec2, unit2};

/// Letters of a mark are as high as this share of the seam at the most, and as the letters of the
/// piece times [`BESIDE_NAME`], but no lower than [`LEAST_MM`].
const HEIGHT_SHARE: f64 = 0.12;
/// Marks are smaller than the name of the piece.
const BESIDE_NAME: f64 = 0.6;
/// Smaller letters can't be engraved.
const LEAST_MM: f64 = 1.5;

/// How the `n`-th seam of a piece is marked, from 0: `S1` and so on. Edges have letters in reports,
/// so seams have another name.
pub fn seam_mark(n: usize) -> String {
    format!("S{}", n + 1)
}

/// How the `n`-th seam between two panels is marked on both, from 0: `J1` and so on.
pub fn joint_mark(n: usize) -> String {
    format!("J{}", n + 1)
}

/// The marks of all seams of a sheet. `tick_mm` is the length of a tick on it, `height_mm` the
/// height of its letters.
pub(super) fn marks(
    sheet: &Sheet,
    flat: &Flattened,
    tick_mm: f64,
    height_mm: f64,
) -> (Vec<PatternPath>, Vec<PatternLabel>) {
    let (mut paths, mut labels) = (Vec::new(), Vec::new());
    for (n, seam) in sheet.seams().iter().enumerate() {
        for (side, ends) in seam.sides.iter().enumerate() {
            let [from, to] = ends.map(|s| flat.points[s.get()]);
            let (mark, first) = (seam_mark(n), side == 0);
            let side = Side { mark, first, length_mm: from.distance(to), from, to };
            let (tick, texts) = side.marks(from.lerp(to, 0.5), tick_mm, height_mm);
            paths.push(tick);
            labels.extend(texts);
        }
    }
    (paths, labels)
}

/// A side of a seam on the pattern.
pub(super) struct Side {
    /// What both sides of the seam are marked with.
    pub(super) mark: String,
    /// Whether it is the side that says how long the seam is.
    pub(super) first: bool,
    /// How long the seam is, mm.
    pub(super) length_mm: f64,
    /// The ends of the straight line that the side runs along at its middle; the sheet lies to its
    /// left.
    pub(super) from: Point2,
    /// See `from`.
    pub(super) to: Point2,
}

impl Side {
    /// The tick and the letters at the middle of the side.
    pub(super) fn marks(
        &self,
        middle: Point2,
        tick_mm: f64,
        height_mm: f64,
    ) -> (PatternPath, Vec<PatternLabel>) {
        let mark = &self.mark;
        let length = self.length_mm;
        let height_mm = (HEIGHT_SHARE * length).min(BESIDE_NAME * height_mm).max(LEAST_MM);
        // The sheet lies to the left of its border.
        let along = unit2(self.to - self.from).unwrap_or(Vec2::X);
        let inside = along.perp();
        let tick = PatternPath {
            role: Role::Engrave,
            kind: PathKind::SeamTick,
            points: vec![middle, middle + inside * tick_mm.min(0.2 * length)],
            closed: false,
        };
        // Beside the tick, with its feet on the seam, so that the marks of both sides stand
        // foot to foot when it is joined.
        let beside = middle + along * (1.2 * height_mm) + inside * (0.4 * height_mm);
        let label = |kind: LabelKind, role: Role, at: Point2, text: String| PatternLabel {
            kind,
            role,
            at,
            along,
            height_mm,
            text,
        };
        let mut labels = vec![label(LabelKind::Mark, Role::Engrave, beside, mark.clone())];
        if self.first {
            let outside = middle + inside * (-1.5 * height_mm);
            let text = format!("seam {mark}, {}", millimetres(length));
            labels.push(label(LabelKind::Length, Role::Note, outside, text));
        }
        (tick, labels)
    }
}
