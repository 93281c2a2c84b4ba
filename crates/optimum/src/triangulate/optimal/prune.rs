//! Pruning of tiles: a tile may have finite entries only if the lower bound on the price of any
//! rung between two runs of neighbouring samples ([`Span::least`]), those of its rows and columns,
//! does not exceed the upper bound on the price of the optimum.

use super::band::Band;
use crate::cost::{LANES, QUANTUM, Segment, TwistForm};
use crate::triangulate::Terms;
use sheetwright_geometry::math::{Vec3, unit};
use std::ops::Range;

/// So many tiles beside one another are first bounded as one. With 8 or 16 of them the table of
/// *wavy* with 50,000 samples takes 0.91 times as long where folds cost nothing, and 0.97 times
/// otherwise.
const LONG: usize = 16;

/// Which tiles may have finite entries.
pub(super) struct Open<'a> {
    /// If given, only tiles with rungs of the band.
    pub(super) band: Option<&'a Band>,
    /// Common data of the samples of each row of tiles; empty where it bounds nothing.
    spans: Vec<Span>,
    /// Lower bounds on the prices of rungs between [`LONG`] rows of tiles and as many columns, on
    /// and above the diagonal; empty where spans bound nothing.
    of_long: Vec<Vec<f64>>,
    /// Entries above it are infinite; a multiple of the quantum.
    pub(super) bound: f64,
    samples: usize,
}

impl<'a> Open<'a> {
    pub(super) fn new(terms: &Terms<'_>, bound: f64, band: Option<&'a Band>) -> Self {
        let m = terms.prices.len();
        let tells = bound < f64::INFINITY
            && terms.prices.in_order()
            && terms.prices.options().form == TwistForm::Normalised;
        let spans_of = |length: usize| -> Vec<Span> {
            let starts = (0..if tells { m } else { 0 }).step_by(length);
            starts.map(|start| Span::of(terms, start..m.min(start + length))).collect()
        };
        let long = spans_of(LONG * LANES);
        let of_row = |row: usize| long[row..].iter().map(|to| long[row].least(to)).collect();
        let of_long = (0..long.len()).map(of_row).collect();
        Self { band, spans: spans_of(LANES), of_long, bound, samples: m }
    }

    /// Without spans, so that every tile is open that the band does not exclude.
    #[cfg(test)]
    pub(super) fn without_spans(self) -> Self {
        Self { spans: vec![], of_long: vec![], ..self }
    }

    /// Whether the tile of these rows and columns has edges of the boundary.
    pub(super) fn has_edges(&self, row: usize, column: usize) -> bool {
        row + 1 >= column || (row, column) == (0, (self.samples - 1) / LANES)
    }

    /// Lower bound, by spans, on the price of a rung of the tile of these rows and columns.
    pub(super) fn least(&self, row: usize, column: usize) -> f64 {
        if self.has_edges(row, column) || self.spans.is_empty() {
            return 0.0;
        }
        let of_long = self.of_long[row / LONG][column / LONG - row / LONG];
        if of_long > self.bound {
            return of_long;
        }
        self.spans[row].least(&self.spans[column])
    }

    /// Whether the tile of these rows and columns may have finite entries.
    pub(super) fn is_open(&self, row: usize, column: usize) -> bool {
        let is_dear = self.least(row, column) > self.bound;
        let run = |at: usize| at * LANES..self.samples.min((at + 1) * LANES);
        let is_near = |band: &Band| band.has(run(row), run(column));
        !is_dear && (self.has_edges(row, column) || self.band.is_none_or(is_near))
    }

    /// The segment near which the samples of a column of tiles lie, if spans are known.
    pub(super) fn segment(&self, column: usize) -> Option<Segment> {
        self.spans.get(column).map(Span::segment)
    }
}

/// Rounding error of lengths of differences of unit vectors, at most.
const SLACK: f64 = 1e-7;
/// Rounding error of the difference of two squared cosines, at most.
const COSINE_MARGIN: f64 = 1e-11;

/// The samples of a run to second order: positions are middle + τ t + r and tangents t + ξ k + q,
/// with |τ| ≤ reach, |r| ≤ bow, |ξ| ≤ turn, |q| ≤ rest.
#[derive(Clone, Copy)]
pub(super) struct Span {
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
    pub(super) fn of(terms: &Terms<'_>, samples: Range<usize>) -> Self {
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

    /// The segment that its samples are near to.
    pub(super) fn segment(&self) -> Segment {
        let to_end = self.tangent * self.reach;
        let ends = [self.middle - to_end, self.middle + to_end].map(|end| end.to_array());
        // The ends are rounded.
        let off = 4.0 * f64::EPSILON * (self.middle.length() + self.reach);
        Segment { ends, bow: self.bow + off }
    }

    /// The largest distance of a sample from the middle, and of a tangent from t.
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

    /// Lower bound on the price of any rung to another run.
    pub(super) fn least(&self, to: &Self) -> f64 {
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
