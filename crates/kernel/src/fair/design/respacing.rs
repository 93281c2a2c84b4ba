//! How samples slip along a curve as its length changes, so that they stay evenly spaced.
//!
//! A sample lies at a share f of the length L of its smooth stretch. Where the points P_k move by
//! dP_k while its parameter u is held, the length up to it, s(u), grows by Σ G_k(u) · dP_k, with
//! G_k(u) = ∫ T B'_k over the stretch up to u, T the unit tangent and B_k the share of the point in
//! the position. To stay at f L the sample slips along the curve by Σ (f G_k(end) − G_k(u)) · dP_k;
//! and as it slips by ds, the derivative C' turns by C'' / |C'| ds.

use crate::fair::{Share, Slip};
use sheetwright_geometry::curve::{Curve, NODES, SpanShares, derivative_shares};
use sheetwright_geometry::math::{Vec3, unit};

/// How a sample slips.
pub(super) struct SlippingSample {
    /// Its number, given by the caller.
    pub(super) number: usize,
    pub(super) slip: Vec<Slip>,
    /// The unit tangent of the curve before it moves.
    pub(super) along: Vec3,
    /// C'' / |C'| of the curve before it moves.
    pub(super) bend: Vec3,
}

/// How the samples at these places of a curve slip: number, span and its parameter. Those at the
/// ends of smooth stretches do not.
pub(super) fn slips(
    curve: &Curve,
    spans: &[SpanShares],
    follows: &[Option<Share>],
    places: &[(usize, usize, f64)],
) -> Vec<SlippingSample> {
    let m = curve.spans().len();
    let mut slipping = Vec::new();
    for stretch in curve.stretches() {
        let order = |span: usize| if span >= stretch.start { span } else { span + m };
        let mut inside: Vec<(usize, usize, f64)> = places
            .iter()
            .map(|&(number, span, t)| (number, order(span), t))
            .filter(|(_, span, _)| stretch.contains(span))
            .collect();
        inside.sort_by(|a, b| a.1.cmp(&b.1).then(a.2.total_cmp(&b.2)).then(a.0.cmp(&b.0)));
        let mut walk =
            Walk { curve, spans, at: (stretch.start, 0.0), length_mm: 0.0, grown: Vec::new() };
        walk.grown.resize(follows.len(), Vec3::ZERO);
        let mut passed = Vec::with_capacity(inside.len());
        for (number, span, t) in inside {
            walk.go_to(span, t);
            passed.push((number, span, t, walk.length_mm, walk.grown.clone()));
        }
        walk.go_to(stretch.end, 0.0);
        for (number, span, t, length_mm, grown) in passed {
            let is_end = (span, t) == (stretch.start, 0.0) || (span + 1, t) == (stretch.end, 1.0);
            let cubic = &curve.spans()[span % m];
            let derivative = cubic.derivative(t);
            let (false, Some(along)) = (is_end, unit(derivative)) else { continue };
            let share = length_mm / walk.length_mm;
            let of_point = |(point, grown): (usize, Vec3)| {
                let Share { unknown, factor } = follows[point]?;
                let way = (walk.grown[point] * share - grown) * factor;
                (way != Vec3::ZERO).then_some(Slip { unknown, way })
            };
            slipping.push(SlippingSample {
                number,
                slip: grown.into_iter().enumerate().filter_map(of_point).collect(),
                along,
                bend: cubic.second_derivative(t) / derivative.length(),
            });
        }
    }
    slipping
}

/// A walk along a stretch: the length so far, and its derivative by each point.
struct Walk<'a> {
    curve: &'a Curve,
    spans: &'a [SpanShares],
    at: (usize, f64),
    length_mm: f64,
    grown: Vec<Vec3>,
}

impl Walk<'_> {
    fn go_to(&mut self, span: usize, t: f64) {
        while self.at.0 < span {
            self.add(self.at.0, self.at.1, 1.0);
            self.at = (self.at.0 + 1, 0.0);
        }
        if t > self.at.1 {
            self.add(span, self.at.1, t);
            self.at.1 = t;
        }
    }

    fn add(&mut self, span: usize, from: f64, to: f64) {
        let span = span % self.spans.len();
        let half = 0.5 * (to - from);
        for (node, weight) in NODES {
            let t = from + half * (1.0 + node);
            let derivative = self.curve.spans()[span].derivative(t);
            let Some(tangent) = unit(derivative) else { continue };
            self.length_mm += half * weight * derivative.length();
            for share in derivative_shares(&self.spans[span], t) {
                self.grown[share.point] += tangent * (half * weight * share.factor);
            }
        }
    }
}
