//! Arc length of a cubic span, and the way back from length to parameter.
//!
//! Speed is the root of a polynomial of degree four, so Gauss–Legendre quadrature converges fast
//! wherever the derivative does not vanish; each piece is halved until both estimates agree.

use super::Cubic;

/// Nodes and weights of five-point Gauss–Legendre quadrature on −1 ..= 1.
pub const NODES: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// Share of a span's size up to which two estimates of its length agree.
const AGREEMENT: f64 = 1e-13;
/// Limit of the halvings of a span. Only a point where the derivative vanishes needs many, and 2⁻³⁰
/// of a span is below the digits of its length.
const MOST_HALVINGS: u32 = 30;
/// Steps of Newton's method at the most; each is kept inside a bracket that shrinks, so that
/// reaching this bound only costs digits.
const MOST_STEPS: u32 = 60;

/// The length of the span between two parameters, mm; negative where `to` is below `from`.
pub fn length(span: &Cubic, from: f64, to: f64) -> f64 {
    let whole = quadrature(span, from, to);
    let size = span.control.windows(2).map(|p| p[0].distance(p[1])).sum::<f64>();
    halved(span, from, to, whole, AGREEMENT * size, MOST_HALVINGS)
}

fn halved(span: &Cubic, from: f64, to: f64, whole: f64, enough: f64, halvings: u32) -> f64 {
    let middle = 0.5 * (from + to);
    let (a, b) = (quadrature(span, from, middle), quadrature(span, middle, to));
    // Written so that NaN ends the recursion too.
    let apart = (a + b - whole).abs() > enough;
    if !apart || halvings == 0 {
        return a + b;
    }
    halved(span, from, middle, a, enough, halvings - 1)
        + halved(span, middle, to, b, enough, halvings - 1)
}

fn quadrature(span: &Cubic, from: f64, to: f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let sum: f64 = NODES
        .iter()
        .map(|(node, weight)| weight * span.derivative(middle + half * node).length())
        .sum();
    sum * half
}

/// The parameter up to which the span, from its beginning, is `wanted` mm long; `whole` is the
/// length of the span. Clamped to 0 ..= 1.
pub(crate) fn parameter_at(span: &Cubic, wanted: f64, whole: f64) -> f64 {
    if wanted <= 0.0 {
        return 0.0;
    }
    if wanted >= whole {
        return 1.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    let (mut t, mut reached) = (wanted / whole, 0.0);
    let mut reached_at = 0.0;
    for _ in 0..MOST_STEPS {
        reached += length(span, reached_at, t);
        reached_at = t;
        let miss = reached - wanted;
        if miss > 0.0 {
            high = t;
        } else {
            low = t;
        }
        if miss.abs() <= AGREEMENT * whole || high - low <= f64::EPSILON {
            break;
        }
        let newton = t - miss / span.derivative(t).length();
        t = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
    }
    t
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Point3;

    #[test]
    fn a_parabola_has_its_closed_form_length() {
        // y = x² over 0 ..= 1, whose length is (2√5 + asinh 2) / 4.
        let control = [[0.0, 0.0], [1.0 / 3.0, 0.0], [2.0 / 3.0, 1.0 / 3.0], [1.0, 1.0]]
            .map(|[x, y]| Point3::new(x, y, 0.0));
        let span = Cubic { control };
        assert!((length(&span, 0.0, 1.0) - 1.478_942_857_544_597_4).abs() < 1e-13);
    }

    #[test]
    fn the_way_back_finds_the_parameter() {
        let control = [[0.0, 0.0], [0.0, 0.0], [5.0, 1.0], [1.0, -2.0]]
            .map(|[x, y]| Point3::new(x, y, x * y));
        let span = Cubic { control };
        let whole = length(&span, 0.0, 1.0);
        for step in 0..=20 {
            let wanted = whole * f64::from(step) / 20.0;
            let t = parameter_at(&span, wanted, whole);
            assert!((length(&span, 0.0, t) - wanted).abs() < 1e-11 * whole);
        }
    }
}
