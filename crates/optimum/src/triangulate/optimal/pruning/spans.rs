//! Lower bounds on the price of any rung between the samples of two tiles, from where these lie and
//! how the boundary turns there.

use crate::cost::{LANES, QUANTUM, TwistForm};
use crate::triangulate::Terms;
use sheetwright_geometry::math::{Vec3, unit};
use std::ops::Range;

/// What the samples of each column of tiles have in common, and a bound on the price of the answer.
pub(super) struct Spans {
    /// Empty where they tell nothing.
    spans: Vec<Span>,
    /// A multiple of the quantum, or infinite.
    pub(super) bound: f64,
    samples: usize,
}

impl Spans {
    pub(super) fn new(terms: &Terms<'_>, bound: f64) -> Self {
        let m = terms.prices.len();
        let tells = bound < f64::INFINITY
            && terms.prices.in_order()
            && terms.prices.options().form == TwistForm::Normalised;
        let starts = (0..if tells { m } else { 0 }).step_by(LANES);
        let span = |start: usize| Span::of(terms, start..m.min(start + LANES));
        Self { spans: starts.map(span).collect(), bound, samples: m }
    }

    /// Tells nothing of any tile.
    #[cfg(test)]
    pub(super) fn silent(self) -> Self {
        Self { spans: vec![], ..self }
    }

    /// The samples of a column of tiles.
    pub(super) fn run(&self, at: usize) -> Range<usize> {
        at * LANES..self.samples.min((at + 1) * LANES)
    }

    /// Whether the tile of these rows and columns has edges of the boundary.
    pub(super) fn has_edges(&self, row: usize, column: usize) -> bool {
        row + 1 >= column || (row, column) == (0, (self.samples - 1) / LANES)
    }

    /// No rung of the tile of these rows and columns costs less; 0 where edges are among them.
    pub(super) fn least(&self, row: usize, column: usize) -> f64 {
        if self.has_edges(row, column) || self.spans.is_empty() {
            return 0.0;
        }
        self.spans[row].least(&self.spans[column]).max(0.0)
    }

    /// Whether the tile of these rows and columns may have rungs up to the bound, or has edges.
    pub(super) fn is_open(&self, row: usize, column: usize) -> bool {
        self.least(row, column) <= self.bound
    }
}

/// Rounding error of lengths of differences of unit vectors, at most.
const SLACK: f64 = 1e-7;
/// Rounding error of the difference of two squared cosines, at most.
const COSINE_MARGIN: f64 = 1e-11;

/// The samples of a run to second order: positions are middle + τ t + r and tangents t + ξ k + q,
/// with |τ| ≤ reach, |r| ≤ bow, |ξ| ≤ turn, |q| ≤ rest.
#[derive(Clone, Copy)]
struct Span {
    middle: Vec3,
    /// t and k, unit vectors or zero.
    tangent: Vec3,
    turning: Vec3,
    reach: f64,
    bow: f64,
    turn: f64,
    rest: f64,
    /// The least square of a special cosine.
    special_cosine_squared: f64,
}

impl Span {
    fn of(terms: &Terms<'_>, samples: Range<usize>) -> Self {
        let end = |i: usize| {
            let (position, tangent, special) = terms.prices.smooth_end(i);
            (Vec3::from_array(position), Vec3::from_array(tangent), special)
        };
        let count = samples.len() as f64;
        let zero = (Vec3::ZERO, Vec3::ZERO);
        let sum = samples.clone().map(end).fold(zero, |sum, e| (sum.0 + e.0, sum.1 + e.1));
        let (first, last) = (end(samples.start).1, end(samples.end - 1).1);
        let mut span = Self {
            middle: sum.0 / count,
            tangent: unit(sum.1).unwrap_or(Vec3::ZERO),
            turning: unit(last - first).unwrap_or(Vec3::ZERO),
            reach: 0.0,
            bow: 0.0,
            turn: 0.0,
            rest: 0.0,
            special_cosine_squared: f64::INFINITY,
        };
        for i in samples {
            let (position, tangent, special) = end(i);
            let off = position - span.middle;
            let along = off.dot(span.tangent);
            span.reach = span.reach.max(along.abs());
            span.bow = span.bow.max((off - span.tangent * along).length());
            let off = tangent - span.tangent;
            let along = off.dot(span.turning);
            span.turn = span.turn.max(along.abs());
            span.rest = span.rest.max((off - span.turning * along).length());
            span.special_cosine_squared = span.special_cosine_squared.min(special);
        }
        span
    }

    /// How far a sample may be from the middle, and a tangent from t.
    fn off(&self) -> (f64, f64) {
        (self.reach + self.bow, self.turn + self.rest)
    }

    /// The direction of t × d over the rungs from this run along about `d` to the run `to`, and the
    /// largest distance from it; `None` if all directions are possible.
    ///
    /// With d = d₀ + τ′ t′ + r′ − τ t − r, and as t × t = 0,
    /// (t + ξ k + q) × d = t × d₀ + τ′ t × t′ + t × (r′ − r) + ξ k × (d − τ t …) + q × d.
    /// On a developable surface t, t′, k and d₀ lie nearly in one plane, so that the terms of first
    /// order run along t × d₀ and do not turn it.
    fn normal(&self, to: &Self, d: Vec3, length: f64) -> Option<(Vec3, f64)> {
        let v = self.tangent.cross(d);
        let size = v.length();
        if size <= SLACK * length {
            return None;
        }
        let normal = v / size;
        let split = |x: Vec3, by: f64| {
            let along = x.dot(normal);
            [by * along.abs(), by * (x - normal * along).length()]
        };
        let from_to = split(self.tangent.cross(to.tangent), to.reach);
        let from_turn = split(self.turning.cross(d), self.turn);
        let off = self.off().0 + to.off().0;
        let second = self.bow + to.bow + self.turn * off + self.rest * (length + off);
        let across = from_to[1] + from_turn[1] + second;
        let left = size - from_to[0] - from_turn[0] - second;
        // Rungs near the tangent are special; left is at most |t × d| for all of them.
        let sine = left / (length + off) * (1.0 - SLACK);
        let plain = left > 0.0 && sine * sine > 1.0 - self.special_cosine_squared + COSINE_MARGIN;
        plain.then(|| (normal, across / left + SLACK))
    }

    /// No rung to another run costs less, as far as the spans tell.
    fn least(&self, to: &Self) -> f64 {
        let d = to.middle - self.middle;
        let length = d.length();
        let off = self.off().0 + to.off().0;
        if length <= 2.0 * off {
            return 0.0;
        }
        let (Some((v, v_off)), Some((u, u_off))) =
            (self.normal(to, d, length), to.normal(self, -d, length))
        else {
            return 0.0;
        };
        let apart = ((v - u).length() - v_off - u_off).max(0.0);
        // Prices are rounded to the quantum.
        0.5 * apart * apart * (1.0 - SLACK) - QUANTUM
    }
}
