//! A plan for the press brake: where each bend line lies against the back gauge, and what a brake
//! can't do.
//!
//! At a brake the bend line lies under the punch, and two fingers behind it touch the edge that the
//! sheet is pushed against: of the sheet as it is cut, with its laps and flanges. So each hit has
//! two distances, square to its line, from a finger's place on the line to the edge: they differ
//! where the edge is no ruling. A stretch of the cut line serves as long as it is straight, lies
//! wholly ahead of the line, with flat sheet in between, turns from it by no more than 45°, and
//! reaches along enough of it for both fingers; of several, the one that turns least. Without one,
//! the line is marked out from the base line of the box around the piece, and the distances are the
//! heights of both places above it.

use super::BendLine;
use crate::edge::Edge;
use sheetwright_geometry::math::{Point2, unit2};
use sheetwright_geometry::predicate::orientation;
use std::cmp::Ordering;

/// The die opening of most bends, in thicknesses of the sheet.
pub const DIE_THICKNESSES: f64 = 8.0;
/// Lines lie no nearer to one another, and sheet reaches no less beyond them, than this share of
/// the die opening: else the sheet falls into the die.
pub const LEAST_SHARE: f64 = 0.5;
/// An edge is straight that leaves its chord by less than this, mm: less than gauges repeat.
const STRAIGHT_MM: f64 = 0.02;
/// Fingers have an edge to touch along this share of the line at least.
const LEAST_TOUCHED: f64 = 0.2;
/// Where both fingers stand, as shares of the stretch of the line that the edge reaches along.
const FINGERS: [f64; 2] = [0.25, 0.75];

/// What a brake can do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Brake {
    /// The opening of its die, mm, if it is known.
    pub die_mm: Option<f64>,
    /// The longest line that it bends, mm, if it is known.
    pub length_mm: Option<f64>,
}

/// What the distances of a hit are measured from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// An edge of the part as it is cut, by its number: distances are square to the bend line.
    Edge(usize),
    /// The lower side of the box around the piece: distances are square to it.
    BaseLine,
}

/// What a brake can't do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BrakeFault {
    /// The line comes nearer to one that is bent before than half the die opening.
    Close {
        /// To which, by its number.
        to: usize,
        /// How near, mm.
        apart_mm: f64,
        /// Half the die opening, mm.
        least_mm: f64,
    },
    /// The line is longer than the brake.
    Long {
        /// How long, mm.
        length_mm: f64,
        /// How long the brake is, mm.
        most_mm: f64,
    },
    /// The sheet reaches less far beyond the first or last line than half the die opening.
    Short {
        /// How far, mm.
        beyond_mm: f64,
        /// Half the die opening, mm.
        least_mm: f64,
    },
}

/// One stroke of the brake.
#[derive(Clone, Debug, PartialEq)]
pub struct Hit {
    /// The line that is bent.
    pub line: BendLine,
    /// The sum of the angles of its strip so far, with their signs, radians.
    pub running: f64,
    /// What the distances are measured from.
    pub reference: Reference,
    /// How far both fingers stand from the left end of the line, along it, mm.
    pub fingers_mm: [f64; 2],
    /// The distance of the reference at both fingers, mm.
    pub gauges_mm: [f64; 2],
    /// What the brake can't do.
    pub faults: Vec<BrakeFault>,
}

/// A flat part that is to be bent.
#[derive(Clone, Copy, Debug)]
pub struct Blank<'a> {
    /// Its bend lines, in the order in which they are bent.
    pub lines: &'a [BendLine],
    /// Where it is cut, mm.
    pub outline: &'a [Point2],
    /// Its edges, before laps and flanges were added to it.
    pub edges: &'a [Edge],
    /// Where their vertices lie, mm.
    pub flat: &'a [Point2],
}

/// The hits of a part, in their order.
pub fn hits(part: &Blank<'_>, brake: &Brake) -> Vec<Hit> {
    let lines = part.lines;
    let stops = stops(part.outline);
    let mut running = 0.0;
    let hit = |n: usize| {
        let line = &lines[n];
        let before = n.checked_sub(1).map(|n| &lines[n]).filter(|other| other.strip == line.strip);
        let is_last = lines.get(n + 1).is_none_or(|other| other.strip != line.strip);
        running = line.angle + if before.is_some() { running } else { 0.0 };
        let is_only = before.is_none() && is_last;
        let (reference, fingers_mm, gauges_mm) = part.gauge(n, &stops, is_only);
        let faults = part.faults(n, brake);
        Hit { line: line.clone(), running, reference, fingers_mm, gauges_mm, faults }
    };
    (0..lines.len()).map(hit).collect()
}

/// The straight stretches of a closed line.
fn stops(outline: &[Point2]) -> Vec<[Point2; 2]> {
    let count = outline.len();
    // The lowest point, of those the leftmost one, is a corner.
    let lower = |&a: &usize, &b: &usize| {
        let [a, b] = [a, b].map(|n| outline[n]);
        a.y.total_cmp(&b.y).then(a.x.total_cmp(&b.x))
    };
    let Some(corner) = (0..count).min_by(lower) else { return Vec::new() };
    let at = |n: usize| outline[(corner + n) % count];
    let is_straight = |from: usize, to: usize| {
        let along = unit2(at(to) - at(from));
        let off = |n: usize| along.map_or(0.0, |along| along.perp_dot(at(n) - at(from)).abs());
        (from + 1..to).all(|n| off(n) <= STRAIGHT_MM)
    };
    let (mut stops, mut from) = (Vec::new(), 0);
    while from < count {
        // As far as it stays straight, in steps that double and then halve.
        let (mut to, mut step) = (from + 1, 1);
        while to + step <= count && is_straight(from, to + step) {
            to += step;
            step *= 2;
        }
        while step > 0 {
            if to + step <= count && is_straight(from, to + step) {
                to += step;
            }
            step /= 2;
        }
        stops.push([at(from), at(to)]);
        from = to;
    }
    stops
}

impl Blank<'_> {
    /// The reference of a hit, the places of its fingers and the distances there. Of a line that is
    /// the only one of its strip the sheet is flat on both sides, but for lines of other strips.
    fn gauge(
        &self,
        n: usize,
        stops: &[[Point2; 2]],
        is_only: bool,
    ) -> (Reference, [f64; 2], [f64; 2]) {
        let line = &self.lines[n];
        let length = line.length_mm();
        let along = unit2(line.ends[1] - line.ends[0]).unwrap_or_default();
        let mut best: Option<Touch> = None;
        for &ends in stops {
            let off = ends.map(|p| line.side_mm(p));
            let is_ahead = off.iter().all(|&off| off > 0.0);
            if !(is_ahead || (is_only && off.iter().all(|&off| off < 0.0))) {
                continue;
            }
            let at = ends.map(|p| along.dot(p - line.ends[0]));
            let [low, high] = [at[0].min(at[1]).max(0.0), at[0].max(at[1]).min(length)];
            let slope = (off[1] - off[0]) / (at[1] - at[0]);
            let serves = slope.abs() <= 1.0 && high - low >= LEAST_TOUCHED * length;
            if !serves || best.as_ref().is_some_and(|best| slope.abs() >= best.aslant) {
                continue;
            }
            let fingers = FINGERS.map(|share| low + (high - low) * share);
            let gauges = fingers.map(|finger| off[0] + slope * (finger - at[0]));
            let is_flat = |k: usize| {
                let from = line.ends[0] + along * fingers[k];
                let to = from + along.perp() * gauges[k];
                self.first_met(n, [from, to]).is_none()
            };
            if is_flat(0) && is_flat(1) {
                let middle = ends[0].lerp(ends[1], 0.5);
                let gauges = gauges.map(f64::abs);
                best = Some(Touch { aslant: slope.abs(), middle, fingers, gauges });
            }
        }
        let edge = best.as_ref().and_then(|best| self.edge_at(best.middle));
        match (best, edge) {
            (Some(Touch { fingers, gauges, .. }), Some(edge)) => {
                (Reference::Edge(edge), fingers, gauges)
            }
            _ => {
                let fingers = FINGERS.map(|share| length * share);
                let base = self.outline.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
                let base = if base.is_finite() { base } else { 0.0 };
                let heights = FINGERS.map(|share| line.ends[0].lerp(line.ends[1], share).y - base);
                (Reference::BaseLine, fingers, heights)
            }
        }
    }

    /// The edge nearest to a place on the cut line.
    fn edge_at(&self, place: Point2) -> Option<usize> {
        let off = |edge: &Edge| {
            let steps = edge.run.windows(2);
            let off = steps.map(|s| place.distance_to_segment([self.flat[s[0]], self.flat[s[1]]]));
            off.fold(f64::INFINITY, f64::min)
        };
        let numbered = self.edges.iter().enumerate().map(|(n, edge)| (off(edge), n));
        numbered.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, n)| n)
    }

    /// What the way from a place on a line meets first before its end, and how far on: the cut
    /// line, or a line that is bent by then.
    fn first_met(&self, n: usize, way: [Point2; 2]) -> Option<(f64, Met)> {
        let length = way[0].distance(way[1]);
        let bent = self.lines[..n].iter().enumerate().map(|(n, line)| (line.ends, Met::Line(n)));
        let count = self.outline.len();
        let steps = (0..count).map(|k| [self.outline[k], self.outline[(k + 1) % count]]);
        let met = |(ends, met): ([Point2; 2], Met)| {
            let far = crossing(way, ends)? * length;
            (far > STRAIGHT_MM && far < length - STRAIGHT_MM).then_some((far, met))
        };
        let all = bent.chain(steps.map(|step| (step, Met::Cut)));
        all.filter_map(met).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// What the brake can't do at a line.
    fn faults(&self, n: usize, brake: &Brake) -> Vec<BrakeFault> {
        let line = &self.lines[n];
        let mut faults = Vec::new();
        if let Some(die_mm) = brake.die_mm {
            let least_mm = LEAST_SHARE * die_mm;
            let (near, beyond_mm) = self.room(n, least_mm);
            if let Some((apart_mm, to)) = near
                && apart_mm < least_mm
            {
                faults.push(BrakeFault::Close { to, apart_mm, least_mm });
            }
            if beyond_mm < least_mm {
                faults.push(BrakeFault::Short { beyond_mm, least_mm });
            }
        }
        if let Some(most_mm) = brake.length_mm
            && line.length_mm() > most_mm
        {
            faults.push(BrakeFault::Long { length_mm: line.length_mm(), most_mm });
        }
        faults
    }

    /// How near to a line another one is that is bent by then, and which, and how far the sheet
    /// reaches beyond it at the least, as far as it is less than so far, mm. A net has no strips to
    /// ask; there it is what lies square to the line at its fingers.
    fn room(&self, n: usize, least_mm: f64) -> (Option<(f64, usize)>, f64) {
        let line = &self.lines[n];
        let before = n.checked_sub(1).filter(|&before| self.lines[before].strip == line.strip);
        let beyond = line.beyond_mm.iter().flatten().copied();
        if before.is_some() || line.beyond_mm != [None; 2] || !line.is_fold {
            let near = before.map(|before| (apart_mm(line.ends, self.lines[before].ends), before));
            return (near, beyond.fold(f64::INFINITY, f64::min));
        }
        let across = unit2(line.ends[1] - line.ends[0]).unwrap_or_default().perp() * least_mm;
        let places = FINGERS.map(|share| line.ends[0].lerp(line.ends[1], share));
        let ways = places
            .into_iter()
            .flat_map(|place| [[place, place + across], [place, place + -across]]);
        let (mut near, mut beyond_mm) = (None, f64::INFINITY);
        for (far, met) in ways.filter_map(|way| self.first_met(n, way)) {
            match met {
                Met::Line(other) if near.is_none_or(|(least, _)| far < least) => {
                    near = Some((far, other));
                }
                Met::Line(_) => {}
                Met::Cut => beyond_mm = beyond_mm.min(far),
            }
        }
        (near, beyond_mm)
    }
}

/// How both fingers touch a stretch of the cut line.
struct Touch {
    /// How it turns from the bend line, as a slope.
    aslant: f64,
    /// Its middle.
    middle: Point2,
    /// Where the fingers stand along the bend line, mm.
    fingers: [f64; 2],
    /// How far it is from the bend line there, mm.
    gauges: [f64; 2],
}

/// What lies on the way from a line.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Met {
    /// Another line, by its number.
    Line(usize),
    /// The cut line.
    Cut,
}

/// How far along the first segment, as a share of it, the second one crosses it.
fn crossing([from, to]: [Point2; 2], [a, b]: [Point2; 2]) -> Option<f64> {
    let (way, other) = (to - from, b - a);
    let whole = way.perp_dot(other);
    if whole == 0.0 {
        return None;
    }
    let [far, at] = [(a - from).perp_dot(other) / whole, (a - from).perp_dot(way) / whole];
    ((0.0..=1.0).contains(&far) && (0.0..=1.0).contains(&at)).then_some(far)
}

/// The least distance of two segments, mm.
fn apart_mm(a: [Point2; 2], b: [Point2; 2]) -> f64 {
    let sides = |[p, q]: [Point2; 2], other: [Point2; 2]| {
        let [first, second] = other.map(|point| orientation(p, q, point));
        first != second && first != Ordering::Equal && second != Ordering::Equal
    };
    if sides(a, b) && sides(b, a) {
        return 0.0;
    }
    let ends =
        a.map(|p| p.distance_to_segment(b)).into_iter().chain(b.map(|p| p.distance_to_segment(a)));
    ends.fold(f64::INFINITY, f64::min)
}
