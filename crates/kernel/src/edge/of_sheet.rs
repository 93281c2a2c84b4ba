//! The edges of a panel whose surface was found: runs of its curves, the ends of its rails, and the
//! sides of its cuts.

use super::border::{Step, edges};
use super::{Edge, EdgeSource};
use crate::flatten::Sheet;
use crate::sample::StepSource;
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::Point2;
use std::collections::BTreeMap;

/// The edges of a sheet that is laid flat at these points. `steps` says what the step from each
/// sample of the boundary lies on, `curve` how a curve of the design is called. They have no mates
/// yet.
pub fn edges_of_sheet(
    sheet: &Sheet,
    flat: &[Point2],
    steps: &[StepSource],
    curve: impl Fn(usize) -> String,
) -> Vec<Edge> {
    let mut of_cut: BTreeMap<[SampleIndex; 2], EdgeSource> = BTreeMap::new();
    for (number, seam) in sheet.seams().iter().enumerate() {
        for (side, second) in seam.sides.iter().zip([false, true]) {
            of_cut.insert(*side, EdgeSource::Cut { number, second });
        }
    }
    let source = |from: usize, to: usize| {
        let ends = [from, to].map(SampleIndex::new);
        of_cut.get(&ends).copied().unwrap_or_else(|| match steps[sheet.origin(ends[0]).get()] {
            StepSource::Curve(curve) => EdgeSource::Curve(curve),
            StepSource::Start => EdgeSource::Start,
            StepSource::End => EdgeSource::End,
        })
    };
    let of_loop = |range: &std::ops::Range<usize>| -> Vec<Step> {
        let next = |i: usize| if i + 1 == range.end { range.start } else { i + 1 };
        range.clone().map(|i| (i, source(i, next(i)))).collect()
    };
    let loops: Vec<Vec<Step>> =
        sheet.surface().connectivity().loops().iter().map(of_loop).collect();
    let name = |source: EdgeSource| match source {
        EdgeSource::Curve(number) => curve(number),
        EdgeSource::Cut { number, second } => cut_name(number, second),
        EdgeSource::End => "end".to_owned(),
        _ => "start".to_owned(),
    };
    edges(&loops, name, sheet.surface().positions(), flat)
}

/// How a side of a cut is called: `cut-1a`, `cut-1b`.
pub(super) fn cut_name(number: usize, second: bool) -> String {
    format!("cut-{}{}", number + 1, if second { 'b' } else { 'a' })
}
