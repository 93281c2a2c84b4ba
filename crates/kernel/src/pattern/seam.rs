//! The marks of a seam: equal letters and a tick in the middle of both its sides, and its length.

use super::dimension::millimetres;
use super::{LabelKind, PathKind, PatternLabel, PatternPath, Role};
use crate::flatten::Flattened;
use crate::mesh::Mesh;
use crate::sheet::{Seam, Sheet};
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point2, Vec2, unit2};

/// Letters of a mark are as high as this share of the seam at the most, and as the letters of the
/// piece times [`BESIDE_NAME`], but no lower than [`LEAST_MM`].
const HEIGHT_SHARE: f64 = 0.12;
/// Marks are smaller than the name of the piece.
const BESIDE_NAME: f64 = 0.6;
/// The middle of a mark lies as far from its tick as its letters times this share of their height:
/// a little more than half of a letter with its gap.
const HALF_LETTER: f64 = 0.6;
/// Smaller letters can't be engraved.
const LEAST_MM: f64 = 1.5;

/// The mark of the `n`-th seam of a piece, from 0: `S1` and so on. Edges have letters in reports,
/// so seams have another name.
pub fn seam_mark(n: usize) -> String {
    format!("S{}", n + 1)
}

/// The mark of the `n`-th seam between two parts, on both of them, from 0: `J1` and so on.
pub(crate) fn joint_mark(n: usize) -> String {
    format!("J{}", n + 1)
}

/// Whether a mark is that of a seam between two parts.
pub(super) fn is_joint_mark(mark: &str) -> bool {
    mark.starts_with('J')
}

/// A way along the border of a part that is marked: a side of a cut, or where the part is joined to
/// another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EdgeMark {
    /// The mark, which stands on both sides.
    pub mark: String,
    /// The steps of the border that it runs along, by vertices of the sheet, which lies to their
    /// left.
    pub steps: Vec<[VertexIndex; 2]>,
    /// Whether it says how long the seam is.
    pub first: bool,
}

/// The marks of the seams along which a sheet is cut.
pub fn seam_marks(sheet: &Sheet) -> Vec<EdgeMark> {
    let of_seam = |(n, seam): (usize, &Seam)| {
        let sides = seam.steps().into_iter().zip([true, false]);
        let mark = move || seam_mark(sheet.first_seam() + n);
        sides.map(move |(steps, first)| EdgeMark { mark: mark(), steps, first })
    };
    sheet.seams().iter().enumerate().flat_map(of_seam).collect()
}

/// The ticks and letters of some marks. `tick_mm` is the length of a tick, `height_mm` the height
/// of the piece's letters.
pub(super) fn drawn(
    marks: &[EdgeMark],
    sheet: &Sheet,
    flat: &Flattened,
    tick_mm: f64,
    height_mm: f64,
) -> (Vec<PatternPath>, Vec<PatternLabel>) {
    let (mut paths, mut labels) = (Vec::new(), Vec::new());
    for EdgeMark { mark, steps, first } in marks {
        let Some((step, share, in_space_mm)) = middle(sheet.mesh(), steps) else { continue };
        let at = |v: VertexIndex| flat.points[v.get()];
        let [from, to] = steps[step].map(at);
        // Both sides may differ in length on the pattern of a mesh, so the length in space is
        // shown.
        let length_mm = if sheet.has_rungs() {
            steps.iter().map(|[a, b]| at(*a).distance(at(*b))).sum()
        } else {
            in_space_mm
        };
        let side = SeamSide { mark: mark.clone(), first: *first, length_mm, from, to };
        let (tick, texts) = side.marks(from.lerp(to, share), tick_mm, height_mm);
        paths.push(tick);
        labels.extend(texts);
    }
    (paths, labels)
}

/// The middle of the base line of a mark beside its tick, which goes inwards from its foot on the
/// seam, and its direction. It stands with its feet on the seam, so that the marks of both sides
/// stand foot to foot when it is joined.
pub(super) fn beside(mark: &str, height_mm: f64, foot: Point2, inside: Point2) -> (Point2, Vec2) {
    let inside = unit2(inside - foot).unwrap_or(Vec2::Y);
    let along = -inside.perp();
    let half_mm = HALF_LETTER * mark.chars().count() as f64 * height_mm;
    (foot + along * half_mm + inside * (0.4 * height_mm), along)
}

/// The middle of a way along sides in space: the step on which it lies, how much of the step comes
/// before it, and the length of the whole, mm. `None` for no way.
fn middle(sheet: &Mesh, steps: &[[VertexIndex; 2]]) -> Option<(usize, f64, f64)> {
    let length = |n: usize| sheet.position(steps[n][0]).distance(sheet.position(steps[n][1]));
    let whole: f64 = (0..steps.len()).map(length).sum();
    let mut left = 0.5 * whole;
    for n in 0..steps.len() {
        if left <= length(n) {
            return Some((n, left / length(n), whole));
        }
        left -= length(n);
    }
    // Rounding may leave a little.
    steps.len().checked_sub(1).map(|last| (last, 1.0, whole))
}

/// A side of a seam on the pattern.
struct SeamSide {
    /// What both sides of the seam are marked with.
    mark: String,
    /// Whether it is the side that says how long the seam is.
    first: bool,
    /// How long the seam is, mm.
    length_mm: f64,
    /// The ends of the straight line that the side runs along at its middle; the sheet lies to its
    /// left.
    from: Point2,
    /// See `from`.
    to: Point2,
}

impl SeamSide {
    /// The tick and the letters at the middle of the side.
    fn marks(
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
        let (beside, _) = beside(mark, height_mm, tick.points[0], tick.points[1]);
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
