//! The outline of a panel: between its samples, the curves of the design themselves.

use super::curves::kind_of_part;
use super::source::{OnCurve, Sourced};
use crate::design::Design;
use sheetwright_geometry::boundary::{Boundary, Outline};
use sheetwright_geometry::curve::{Cubic, Curve};
use sheetwright_geometry::tolerance::Tolerance;
use std::collections::BTreeMap;

/// The outline of a boundary whose samples are from these places of the curves.
pub(crate) fn outline(design: &Design, boundary: &Boundary, sources: &[Sourced]) -> Outline {
    let mut known = KnownCurves::of(design);
    let pieces =
        (0..boundary.len()).map(|i| known.between(sources.get(i)?, sources.get(boundary.next(i))?));
    let same_mm = Tolerance::CHAIN.length_mm(boundary.size());
    Outline::from_pieces(boundary, same_mm, pieces)
}

/// The curves of a design, built as they are needed.
pub(super) struct KnownCurves<'a> {
    design: &'a Design,
    built: BTreeMap<usize, Option<Curve>>,
}

impl<'a> KnownCurves<'a> {
    pub(super) fn of(design: &'a Design) -> Self {
        Self { design, built: BTreeMap::new() }
    }

    /// The pieces of a curve from one sample to the next, run as the loop runs; `None` where both
    /// are not from one curve.
    pub(super) fn between(&mut self, from: &Sourced, to: &Sourced) -> Option<Vec<Cubic>> {
        let (from, to) = (from.leaving?, to.arriving?);
        let design = self.design;
        let curve = self.built.entry(from.curve).or_insert_with(|| {
            let source = design.curves.get(from.curve)?;
            Curve::new(kind_of_part(source), &source.points, source.closed).ok()
        });
        stretch(curve.as_ref()?, from, to)
    }
}

/// The pieces of a curve from one place on it to another, run as the loop runs.
fn stretch(curve: &Curve, from: OnCurve, to: OnCurve) -> Option<Vec<Cubic>> {
    if from.curve != to.curve || from.reversed != to.reversed {
        return None;
    }
    let spans = curve.spans();
    let (start, end) = if from.reversed { (to, from) } else { (from, to) };
    let forwards = (start.span, start.t) < (end.span, end.t);
    if !forwards && !curve.closed() {
        return None;
    }
    let steps = if forwards { end.span - start.span } else { end.span + spans.len() - start.span };
    let mut pieces = Vec::with_capacity(steps + 1);
    for step in 0..=steps {
        let span = spans.get((start.span + step) % spans.len())?;
        let low = if step == 0 { start.t } else { 0.0 };
        let high = if step == steps { end.t } else { 1.0 };
        if high > low {
            pieces.push(part(span, low, high));
        }
    }
    if from.reversed {
        pieces.reverse();
        pieces = pieces.iter().map(Cubic::reversed).collect();
    }
    Some(pieces)
}

/// A span between two of its parameters.
fn part(span: &Cubic, low: f64, high: f64) -> Cubic {
    let upper = if high < 1.0 { span.halves(high)[0] } else { *span };
    if low > 0.0 { upper.halves(low / high)[1] } else { upper }
}
