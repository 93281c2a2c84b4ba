//! How the material beyond two edges ends at the corner between them.
//!
//! The names and the constructions are those of the pattern makers' programs Seamly2D and
//! Valentina. `p` is the corner, the first edge arrives there and the second leaves. Beyond the
//! first lies its *cut line*, moved out by `a`, beyond the second one moved out by `b`. A style
//! names two points, one on each cut line; a straight line joins them. Where the first of them lies
//! behind the corner, a triangle of the material is cut away, and likewise beyond the second.

use crate::design::Corner;
use sheetwright_geometry::math::{Point2, Vec2};

/// Cut lines that meet farther from the corner than this many widths are cut off there: that of a
/// corner below 47°.
const FARTHEST: f64 = 2.5;
/// Constructions that leave the corner by more widths than this are for other corners: then both
/// lines are joined by length.
const ASTRAY: f64 = 6.0;
/// Edges that turn by less than this have no corner to speak of, as the cosine: the tip would lie
/// beyond a straight line by less than a millionth of the width.
const STRAIGHT: f64 = 1.0 - 1e-9;
/// What a corner takes away is no thinner than this, mm.
const LEAST_MM: f64 = 1e-6;

/// The corner between two edges.
pub(super) struct Between {
    /// The corner of the net line.
    pub(super) at: Point2,
    /// The unit direction in which the first edge arrives.
    pub(super) arrives: Vec2,
    /// The unit direction in which the second edge leaves.
    pub(super) leaves: Vec2,
    /// The width of the material beyond the first edge and beyond the second one, mm.
    pub(super) widths: [f64; 2],
}

/// What a corner adds to the strips along its edges, and what it takes from them.
#[derive(Default)]
pub(super) struct Cornered {
    pub(super) added: Vec<Vec<Point2>>,
    pub(super) removed: Vec<Vec<Point2>>,
}

impl Between {
    /// The sine and the cosine of the turn from the first edge to the second; the sine is positive
    /// where the sheet has a corner that sticks out.
    fn turn(&self) -> (f64, f64) {
        (self.arrives.perp_dot(self.leaves), self.arrives.dot(self.leaves))
    }

    /// The directions away from the sheet.
    fn outwards(&self) -> [Vec2; 2] {
        [-self.arrives.perp(), -self.leaves.perp()]
    }

    /// The corner in this style.
    pub(super) fn made(&self, style: Corner) -> Cornered {
        let (sine, cosine) = self.turn();
        let [a, b] = self.widths;
        let sticks_out = sine > 0.0 || (sine == 0.0 && cosine < 0.0);
        if !sticks_out || a.max(b) <= 0.0 {
            return Cornered::default();
        }
        let points = match self.styled(style, sine) {
            Some(points) => points,
            None if a > 0.0 && b > 0.0 => self.by_length(sine, cosine),
            // Beside an edge without material, a strip ends at a right angle.
            None => return Cornered::default(),
        };
        self.joined(points)
    }

    /// The points of a style that is not by length, one on each cut line; `None` where they would
    /// go astray.
    fn styled(&self, style: Corner, sine: f64) -> Option<[Point2; 2]> {
        let ([a, b], [out, out_next]) = (self.widths, self.outwards());
        // Where each cut line meets the net line of the other edge, run on.
        let on_first = self.at + self.arrives * (b / sine);
        let on_second = self.at + self.leaves * (-a / sine);
        let mirrored = |way: Vec2, axis: Vec2| axis * (2.0 * way.dot(axis)) - way;
        let points = match style {
            Corner::ByLength => return None,
            Corner::ByIntersection => [on_second, on_first],
            Corner::FirstEdgeRightAngle => [on_first + out * a, on_first],
            Corner::SecondEdgeRightAngle => [on_second, on_second + out_next * b],
            Corner::FirstEdgeSymmetry => {
                let way = mirrored(self.leaves, self.arrives);
                [on_first + way * (a / way.dot(out)), on_first]
            }
            Corner::SecondEdgeSymmetry => {
                let way = mirrored(self.arrives, self.leaves);
                [on_second, on_second + way * (b / way.dot(out_next))]
            }
        };
        let far = ASTRAY * a.max(b);
        points.iter().all(|p| p.distance(self.at) <= far).then_some(points)
    }

    /// Both cut lines run on to where they meet, and are cut off squarely where that is far.
    fn by_length(&self, sine: f64, cosine: f64) -> [Point2; 2] {
        let ([a, b], [out, out_next]) = (self.widths, self.outwards());
        let ends = [self.at + out * a, self.at + out_next * b];
        // How far the first line runs on ahead, and the second one back, until they meet.
        let (ahead, back) = (b - a * cosine, a - b * cosine);
        if ahead < 0.0 || back < 0.0 {
            return ends;
        }
        let far = FARTHEST * a.max(b);
        if cosine > STRAIGHT {
            return ends;
        }
        let tip = ends[0] + self.arrives * (ahead / sine);
        if sine > 0.0 && tip.distance(self.at) <= far {
            return [tip, tip];
        }
        // Cut off at right angles to the way from the corner to the tip.
        let way = self.arrives * ahead + out * (a * sine);
        let way = way * (1.0 / way.length());
        let run_on = |end: Point2, along: Vec2| {
            let toward = along.dot(way);
            let left = far - (end - self.at).dot(way);
            if toward > 0.0 { end + along * (left / toward) } else { end }
        };
        [run_on(ends[0], self.arrives), run_on(ends[1], -self.leaves)]
    }

    /// The polygons of a corner whose cut line runs through these two points.
    fn joined(&self, [first, second]: [Point2; 2]) -> Cornered {
        let ([a, b], [out, out_next]) = (self.widths, self.outwards());
        let ends = [self.at + out * a, self.at + out_next * b];
        let mut cornered = Cornered::default();
        cornered.added.push(vec![self.at, first, second]);
        let is_behind = (first - ends[0]).dot(self.arrives) < -LEAST_MM;
        let is_beyond = (second - ends[1]).dot(self.leaves) > LEAST_MM;
        let crossed = |end: Point2| {
            // Where the line through both points meets the way from the corner to `end`.
            let (way, line) = (end - self.at, second - first);
            let sine = way.perp_dot(line);
            let share = (first - self.at).perp_dot(line) / sine;
            if share.is_finite() { self.at + way * share.clamp(0.0, 1.0) } else { self.at }
        };
        if is_behind {
            cornered.removed.push(vec![first, ends[0], crossed(ends[0])]);
        } else {
            cornered.added.push(vec![self.at, ends[0], first]);
        }
        if is_beyond {
            cornered.removed.push(vec![second, ends[1], crossed(ends[1])]);
        } else {
            cornered.added.push(vec![self.at, second, ends[1]]);
        }
        cornered
    }
}
