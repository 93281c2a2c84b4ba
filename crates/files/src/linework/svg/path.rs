//! The data of a path (`d`) as pieces of curves, in its own coordinates. Commands, relative ones
//! and implicit repeats are split by `svgtypes`.

use super::super::drawn::MAX_SEGMENTS;
use super::super::segment::Segment;
use sheetwright::math::{Point3, Vec3, atan2, cos, from_deg, sin};
use svgtypes::{PathParser, PathSegment};

/// An arc whose chord is a smaller share of its radii rises by less than 3e-9 of the chord.
const LEAST_CHORD: f64 = 1e-8;

/// A part of a path that is drawn in one stroke.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Stroke {
    pub(super) segments: Vec<Segment>,
    pub(super) closed: bool,
}

/// The strokes of a path.
///
/// # Errors
/// What is wrong with the data, in the words of `svgtypes`.
pub(super) fn strokes(data: &str) -> Result<Vec<Stroke>, String> {
    let mut pen = Pen::default();
    for (n, segment) in PathParser::from(data).enumerate() {
        if n > MAX_SEGMENTS {
            return Err(format!("it has more than {MAX_SEGMENTS} pieces"));
        }
        pen.run(segment.map_err(|error| error.to_string())?);
    }
    pen.lift();
    Ok(pen.strokes)
}

/// Where a path is being drawn.
#[derive(Default)]
struct Pen {
    strokes: Vec<Stroke>,
    now: Stroke,
    at: Point3,
    start: Point3,
    /// The last control point of the piece before, if it was cubic, or quadratic.
    cubic: Option<Point3>,
    quadratic: Option<Point3>,
}

fn p(x: f64, y: f64) -> Point3 {
    Point3::new(x, y, 0.0)
}

impl Pen {
    fn lift(&mut self) {
        let stroke = std::mem::take(&mut self.now);
        if !stroke.segments.is_empty() {
            self.strokes.push(stroke);
        }
    }

    /// The point with these coordinates, which count from the pen if they are relative.
    fn to(&self, abs: bool, x: f64, y: f64) -> Point3 {
        if abs { p(x, y) } else { p(self.at.x + x, self.at.y + y) }
    }

    fn draw(&mut self, segment: Segment, to: Point3) {
        self.now.segments.push(segment);
        self.at = to;
    }

    fn line(&mut self, to: Point3) {
        self.draw(Segment::line(self.at, to), to);
    }

    /// The control point before the pen, mirrored at it.
    fn mirrored(&self, control: Option<Point3>) -> Point3 {
        control.map_or(self.at, |control| self.at + (self.at - control))
    }

    fn curve(&mut self, first: Point3, second: Point3, to: Point3) {
        self.draw(Segment::bezier(&[self.at, first, second, to]), to);
        self.cubic = Some(second);
    }

    fn parabola(&mut self, control: Point3, to: Point3) {
        self.draw(Segment::bezier(&[self.at, control, to]), to);
        self.quadratic = Some(control);
    }

    fn run(&mut self, segment: PathSegment) {
        let (cubic, quadratic) = (self.cubic.take(), self.quadratic.take());
        match segment {
            PathSegment::MoveTo { abs, x, y } => {
                let to = self.to(abs, x, y);
                self.lift();
                (self.at, self.start) = (to, to);
            }
            PathSegment::LineTo { abs, x, y } => self.line(self.to(abs, x, y)),
            PathSegment::HorizontalLineTo { abs, x } => {
                self.line(p(if abs { x } else { self.at.x + x }, self.at.y));
            }
            PathSegment::VerticalLineTo { abs, y } => {
                self.line(p(self.at.x, if abs { y } else { self.at.y + y }));
            }
            PathSegment::CurveTo { abs, x1, y1, x2, y2, x, y } => {
                self.curve(self.to(abs, x1, y1), self.to(abs, x2, y2), self.to(abs, x, y));
            }
            PathSegment::SmoothCurveTo { abs, x2, y2, x, y } => {
                let first = self.mirrored(cubic);
                self.curve(first, self.to(abs, x2, y2), self.to(abs, x, y));
            }
            PathSegment::Quadratic { abs, x1, y1, x, y } => {
                self.parabola(self.to(abs, x1, y1), self.to(abs, x, y));
            }
            PathSegment::SmoothQuadratic { abs, x, y } => {
                let control = self.mirrored(quadratic);
                self.parabola(control, self.to(abs, x, y));
            }
            PathSegment::EllipticalArc { abs, rx, ry, x_axis_rotation, large_arc, sweep, x, y } => {
                let to = self.to(abs, x, y);
                let arc =
                    Arc { radii: [rx, ry], turn: from_deg(x_axis_rotation), large_arc, sweep };
                if let Some(segment) = arc.segment(self.at, to) {
                    self.draw(segment, to);
                }
            }
            PathSegment::ClosePath { .. } => {
                if self.at != self.start && !self.now.segments.is_empty() {
                    self.line(self.start);
                }
                self.now.closed = true;
                self.lift();
                self.at = self.start;
            }
        }
    }
}

/// An arc by its end points, as SVG has it.
struct Arc {
    radii: [f64; 2],
    /// How far its axes are turned, radians.
    turn: f64,
    large_arc: bool,
    sweep: bool,
}

impl Arc {
    /// The piece between two points: the centre is found as SVG 2 says in appendix B.2.4. Radii of
    /// 0 make a straight line, those that are too small grow; an arc to its own start is none.
    fn segment(&self, from: Point3, to: Point3) -> Option<Segment> {
        if from == to {
            return None;
        }
        let [mut rx, mut ry] = self.radii.map(f64::abs);
        if rx == 0.0 || ry == 0.0 {
            return Some(Segment::line(from, to));
        }
        let (s, c) = (sin(self.turn), cos(self.turn));
        let half = (from - to) * 0.5;
        let (x, y) = (c * half.x + s * half.y, c * half.y - s * half.x);
        let needed = (x / rx) * (x / rx) + (y / ry) * (y / ry);
        if needed > 1.0 {
            (rx, ry) = (rx * needed.sqrt(), ry * needed.sqrt());
        }
        let (a, b) = (x / rx, y / ry);
        let squares = a * a + b * b;
        // Of a circle so much larger than its chord, rounding would not tell where it runs.
        if squares < LEAST_CHORD * LEAST_CHORD {
            return Some(Segment::line(from, to));
        }
        let far = ((1.0 - squares).max(0.0) / squares).sqrt();
        let far = if self.large_arc == self.sweep { -far } else { far };
        // On the unit circle, the centre and the two ends.
        let (cx, cy) = (far * b, -far * a);
        let start = atan2(b - cy, a - cx);
        let full = 2.0 * std::f64::consts::PI;
        let mut way = atan2(-b - cy, -a - cx) - start;
        if self.sweep && way < 0.0 {
            way += full;
        }
        if !self.sweep && way > 0.0 {
            way -= full;
        }
        let (u, v) = (Vec3::new(c, s, 0.0) * rx, Vec3::new(-s, c, 0.0) * ry);
        let centre = from.lerp(to, 0.5) + u * cx + v * cy;
        let mut arc = Segment::arc(centre, u, v, [start, start + way]);
        arc.move_end(false, from);
        arc.move_end(true, to);
        Some(arc)
    }
}
