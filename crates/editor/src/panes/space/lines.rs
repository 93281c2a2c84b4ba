//! Lines in space: curves, rungs, edges and the grid, as segments to draw.

use super::gpu::Segment;
use crate::document::Drawing;
use crate::theme::Theme;
use eframe::egui::Color32;
use sheetwright::curve::{Curve, CurveKind};
use sheetwright::design::DesignCurve;
use sheetwright::math::{Point2, Point3};

/// Segments a span of a curve is drawn with.
const PER_SPAN: usize = 16;
/// And a curve at the least, however many spans it has, at the most.
const PER_CURVE: usize = 1024;
/// Lines of the grid to either side of its middle, at the most.
const GRID_LINES: i32 = 24;
/// Pieces that a line of the grid fades in.
const FADE_STEPS: i32 = 16;

/// How a line looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pen {
    /// Its colour.
    pub(super) colour: Color32,
    /// How much of it covers, 0 ..= 1.
    pub(super) opacity: f32,
    /// How wide it is, points.
    pub(super) width: f32,
    /// How far it is moved towards the eye, pixels' widths, so that it is not half within a sheet.
    pub(super) lift: f32,
}

impl Pen {
    /// A full line.
    pub(super) fn new(colour: Color32, width: f32, lift: f32) -> Self {
        Self { colour, opacity: 1.0, width, lift }
    }

    /// One that covers less.
    pub(super) fn faded(self, opacity: f32) -> Self {
        Self { opacity: self.opacity * opacity, ..self }
    }

    fn bytes(self) -> [u8; 4] {
        let [r, g, b, _] = self.colour.to_array();
        [r, g, b, (255.0 * self.opacity.clamp(0.0, 1.0)).round() as u8]
    }
}

/// Lines that are gathered, in mm about an origin.
#[derive(Debug)]
pub(super) struct Lines {
    /// What was gathered.
    pub(super) segments: Vec<Segment>,
    origin: Point3,
}

impl Lines {
    /// None yet.
    pub(super) fn about(origin: Point3) -> Self {
        Self { segments: Vec::new(), origin }
    }

    /// A segment that looks different at its ends.
    fn blended(&mut self, [a, b]: [Point3; 2], [pen, end]: [Pen; 2]) {
        let ends = [a, b].map(|p| (p - self.origin).as_vec3().to_array());
        let colours = [pen.bytes(), end.bytes()];
        self.segments.push(Segment { ends, colours, width: pen.width, lift: pen.lift });
    }

    /// A segment.
    pub(super) fn segment(&mut self, ends: [Point3; 2], pen: Pen) {
        self.blended(ends, [pen; 2]);
    }

    /// A line through points.
    pub(super) fn through(&mut self, points: &[Point3], closed: bool, pen: Pen) {
        for pair in points.windows(2) {
            self.segment([pair[0], pair[1]], pen);
        }
        if let (true, [first, .., last]) = (closed && points.len() > 2, points) {
            self.segment([*last, *first], pen);
        }
    }

    /// The grid of the plane of the plan, fading out at a distance from a middle, with the axes
    /// that lie in it.
    pub(super) fn grid(&mut self, drawing: &Drawing, theme: &Theme, middle: Point3, reach: f64) {
        let Some((step, tenths)) = grid_step(drawing.grid_mm, reach) else { return };
        let plan = drawing.plan;
        let centre = plan.flat(middle);
        let shown = |at: Point2| {
            let share = 1.0 - at.distance(centre) / reach;
            (share.clamp(0.0, 1.0) * 1.6).min(1.0) as f32
        };
        for upright in [false, true] {
            let (across, along) = if upright { (centre.x, centre.y) } else { (centre.y, centre.x) };
            let first = ((across - reach) / step).ceil() as i64;
            let last = ((across + reach) / step).floor() as i64;
            for n in first..=last {
                let at = n as f64 * step;
                let off = at - across;
                let half = (reach * reach - off * off).max(0.0).sqrt();
                let axis = usize::from(upright);
                let pen = match n {
                    0 => Pen::new(axis_colour(theme, drawing, axis), 1.2, -2.0).faded(0.75),
                    n if n % tenths == 0 => Pen::new(theme.grid[1], 1.0, -3.0),
                    _ => Pen::new(theme.grid[0], 1.0, -3.0),
                };
                let place = |k: i32| {
                    let way = along + half * f64::from(2 * k - FADE_STEPS) / f64::from(FADE_STEPS);
                    if upright { Point2::new(at, way) } else { Point2::new(way, at) }
                };
                for k in 0..FADE_STEPS {
                    let ends = [place(k), place(k + 1)];
                    let pens = ends.map(|end| pen.faded(shown(end)));
                    if pens.iter().any(|pen| pen.opacity > 0.0) {
                        self.blended(ends.map(|end| plan.space(end, 0.0)), pens);
                    }
                }
            }
        }
    }
}

/// The colour of the axis that is line 0 of the lines to the right, or of the upright ones.
fn axis_colour(theme: &Theme, drawing: &Drawing, upright: usize) -> Color32 {
    use crate::document::Plan;
    let axes = match drawing.plan {
        Plan::Top => [0, 1],
        Plan::Front => [0, 2],
        Plan::Side => [1, 2],
    };
    theme.axes[axes[upright]]
}

/// The distance of the lines of a grid that is not too dense, mm, and how many make a strong one.
fn grid_step(grid_mm: f64, reach: f64) -> Option<(f64, i64)> {
    if !(grid_mm > 0.0 && reach > 0.0 && reach.is_finite()) {
        return None;
    }
    let (mut step, mut factor) = (grid_mm, 5.0);
    while reach / step > f64::from(GRID_LINES) {
        step *= factor;
        factor = 10.0 / factor;
    }
    Some((step, 10))
}

/// Points along a curve of a design: through its points where they do not make a curve.
pub(super) fn curve_points(curve: &DesignCurve) -> Vec<Point3> {
    let straight = || {
        let mut points: Vec<Point3> = curve.points.iter().map(|p| p.at).collect();
        if let (true, Some(&first)) = (curve.closed && points.len() > 2, points.first()) {
            points.push(first);
        }
        points
    };
    let Some(kind) = curve.kind else { return straight() };
    let Ok(smooth) = Curve::new(kind, &curve.points, curve.closed) else { return straight() };
    let spans = smooth.spans();
    let per_span = match kind {
        CurveKind::Polyline => 1,
        _ => PER_SPAN.min(PER_CURVE.div_ceil(spans.len().max(1))).max(1),
    };
    let mut points = vec![smooth.start()];
    for span in spans {
        points.extend((1..=per_span).map(|k| span.position(k as f64 / per_span as f64)));
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_is_never_dense() {
        for reach in [1.0, 100.0, 1e4, 1e7] {
            let (step, _) = grid_step(10.0, reach).unwrap();
            assert!(reach / step <= f64::from(GRID_LINES));
        }
        assert_eq!(grid_step(0.0, 1.0), None);
    }
}
