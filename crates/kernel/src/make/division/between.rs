//! A boundary as two rails whose ends are straight or points, and the boundaries of its parts.
//!
//! A place on the panel is given by two shares: one along both rails, by their lengths, and one
//! from the first rail to the second, straight across. So lines that divide it lie on the ruled
//! surface between the rails.

use super::parts::{Divisible, between, chained, straight};
use crate::check::CutWay;
use sheetwright_geometry::boundary::{Boundary, OnOutline, Outline, Side};
use sheetwright_geometry::curve::Sample;
use sheetwright_geometry::math::{Point3, Vec3, angle_between, from_deg, unit};
use std::ops::Range;

/// A loop has a corner where it turns by more than this, degrees.
const CORNER_DEG: f64 = 20.0;
/// A side is straight if none of its samples lies farther from its chord, as a share of that.
const STRAIGHT: f64 = 1e-3;
/// Rails are sampled as they were, but with at least and at most so many samples.
const SAMPLES: [usize; 2] = [24, 100];

/// A boundary between two rails.
pub(super) struct Between<'a> {
    outline: &'a Outline,
    /// The rails by arc length on the outline: the first runs as the loop does, the second against
    /// it.
    rails: [[f64; 2]; 2],
    /// How many samples each rail of a part has.
    samples: usize,
}

/// A side of a loop from one corner to the next.
struct OneSide {
    mm: Range<f64>,
    is_straight: bool,
}

impl<'a> Between<'a> {
    /// `None` if the boundary has holes, or its loop no such sides.
    pub(super) fn new(boundary: &Boundary, outline: &'a Outline) -> Option<Self> {
        let sides = sides(boundary, outline);
        if boundary.holes() > 0 {
            return None;
        }
        let length = |n: &usize| sides[*n].mm.end - sides[*n].mm.start;
        let shortest = |ends: &mut dyn Iterator<Item = usize>| {
            ends.min_by(|a, b| length(a).total_cmp(&length(b)))
        };
        // The numbers of the two rails, in the order of the loop.
        let rails = match sides.len() {
            2 => [0, 1],
            3 => {
                let end = shortest(&mut (0..3).filter(|&n| sides[n].is_straight))?;
                [(end + 1) % 3, (end + 2) % 3]
            }
            4 => {
                let both = |n: &usize| sides[*n].is_straight && sides[n + 2].is_straight;
                let end = shortest(&mut (0..2).filter(both))?;
                [end + 1, (end + 3) % 4]
            }
            _ => return None,
        };
        let [first, second] = rails.map(|n| &sides[n].mm);
        let [least, most] = SAMPLES;
        Some(Self {
            outline,
            rails: [[first.start, first.end], [second.end, second.start]],
            samples: (boundary.len() / 2).clamp(least, most),
        })
    }

    /// The place at these shares, mm, and the direction of the line there along the rails, unit.
    fn at(&self, along: f64, across: f64) -> OnOutline {
        let on_rail = |[from, to]: [f64; 2]| {
            // Beside a corner, the tangent of the rail and not that of the end.
            let side = if (along == 0.0) == (to > from) { Side::Leaving } else { Side::Arriving };
            let at = self.outline.at(0, from + (to - from) * along, side);
            (at.position, at.tangent * (to - from))
        };
        let [(a, a_along), (b, b_along)] = self.rails.map(on_rail);
        let tangent = unit(a_along * (1.0 - across) + b_along * across).unwrap_or(Vec3::X);
        OnOutline { position: a.lerp(b, across), tangent }
    }

    /// A rail of a part between shares along the rails, at a share between them.
    fn rail(&self, along: [f64; 2], across: f64, is_back: bool) -> Vec<OnOutline> {
        let sample = |n: usize| {
            let n = if is_back { self.samples - 1 - n } else { n };
            let at = self.at(between(along, n as f64 / (self.samples - 1) as f64), across);
            if is_back { OnOutline { tangent: -at.tangent, ..at } } else { at }
        };
        (0..self.samples).map(sample).collect()
    }
}

impl Divisible for Between<'_> {
    fn around(&self, way: CutWay, parts: usize, n: usize) -> Option<Vec<Vec<Sample>>> {
        let part = [n, n + 1].map(|n| n as f64 / parts as f64);
        let (along, across) = match way {
            CutWay::Across => (part, [0.0, 1.0]),
            CutWay::Lengthwise => ([0.0, 1.0], part),
        };
        let rails = [0, 1].map(|n| self.rail(along, across[n], n == 1));
        let mut stretches = Vec::new();
        for n in 0..2 {
            let (from, to) = (rails[n].last()?.position, rails[1 - n].first()?.position);
            stretches.push(rails[n].clone());
            // Ends on one spot are one corner.
            stretches.extend(straight([from, to], 1));
        }
        Some(vec![chained(&stretches)])
    }

    fn lines(&self, way: CutWay, parts: usize, count: usize) -> Vec<Vec<Point3>> {
        let line = |n: usize| {
            let share = n as f64 / parts as f64;
            let at = |n: usize| {
                let on_it = n as f64 / (count - 1) as f64;
                let (along, across) = match way {
                    CutWay::Across => (share, on_it),
                    CutWay::Lengthwise => (on_it, share),
                };
                self.at(along, across).position
            };
            (0..count).map(at).collect()
        };
        (1..parts).map(line).collect()
    }

    fn of_first_rail(&self) -> Option<usize> {
        Some(self.samples)
    }
}

/// The sides of the outer loop from corner to corner.
fn sides(boundary: &Boundary, outline: &Outline) -> Vec<OneSide> {
    let m = boundary.loops()[0].len();
    let samples = boundary.samples();
    let turns = |&n: &usize| {
        angle_between(samples[n].tangent_in, samples[n].tangent_out) > from_deg(CORNER_DEG)
    };
    let corners: Vec<usize> = (0..m).filter(turns).collect();
    let side = |k: usize| {
        let from = corners[k];
        let to = if k + 1 < corners.len() { corners[k + 1] } else { corners[0] + m };
        let [a, b] = [from, to % m].map(|n| samples[n].position);
        let way = unit(b - a).unwrap_or(Vec3::ZERO);
        let off = |n: usize| {
            let p = samples[n % m].position - a;
            (p - way * p.dot(way)).length()
        };
        let farthest = (from..=to).map(off).fold(0.0, f64::max);
        let end = outline.of_sample(to % m) + if to < m { 0.0 } else { outline.length(0) };
        OneSide {
            mm: outline.of_sample(from)..end,
            is_straight: farthest <= STRAIGHT * a.distance(b),
        }
    };
    (0..corners.len()).map(side).collect()
}
