//! The edges of a part whose surface was found: runs of its curves, the ends of its rails, and the
//! sides of its cuts.

use super::border::edges_of;
use super::{Edge, EdgeSource};
use crate::sample::StepSource;
use crate::sheet::Sheet;
use sheetwright_geometry::math::Point2;

/// The edges of a sheet that is laid flat at these points, without mates. `steps` holds the source
/// of the step from each sample of the boundary, `curve` gives the name of a curve of the design.
pub(crate) fn edges_of_boundary(
    sheet: &Sheet,
    flat: &[Point2],
    steps: &[StepSource],
    curve: impl Fn(usize) -> String,
) -> Vec<Edge> {
    let source = |[from, _]: [_; 2]| match steps[sheet.sample(from).get()] {
        StepSource::Curve(curve) => EdgeSource::Curve(curve),
        StepSource::Start => EdgeSource::Start,
        StepSource::End => EdgeSource::End,
    };
    let name = |source: EdgeSource| match source {
        EdgeSource::Curve(number) => curve(number),
        EdgeSource::End => "end".to_owned(),
        _ => "start".to_owned(),
    };
    edges_of(sheet, flat, source, name)
}
