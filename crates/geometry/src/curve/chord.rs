//! A curve from one sample to the next, beside its chord: how far it lies off, and how much shorter
//! the chord is.

use super::{Cubic, length};
use crate::math::Point3;

/// Steps of the search for the point of a span that lies farthest from the chord.
const STEPS: usize = 8;

/// How far a straight step lies from the curve that it takes the place of.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Chord {
    /// The largest distance of the curve from the step, mm.
    pub distance_mm: f64,
    /// The length of the curve less that of the step, mm; 0 or more.
    pub shorter_mm: f64,
}

/// The chord of a chain of spans, each of which begins where the last ends. Its largest distance is
/// looked for at nine points of each span, and at the top of the parabola through the farthest of
/// them and its neighbours: right to a thousandth where the chain has no narrower wiggle.
pub fn chord(pieces: &[Cubic]) -> Chord {
    let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else {
        return Chord::default();
    };
    let ends = [first.control[0], last.control[3]];
    let farthest = pieces.iter().map(|piece| farthest_mm(piece, ends));
    let curve: f64 = pieces.iter().map(|piece| length(piece, 0.0, 1.0)).sum();
    Chord {
        distance_mm: farthest.fold(0.0, f64::max),
        shorter_mm: (curve - ends[0].distance(ends[1])).max(0.0),
    }
}

/// The largest distance of a span from a straight step, mm.
fn farthest_mm(piece: &Cubic, step: [Point3; 2]) -> f64 {
    let off = |t: f64| piece.position(t).distance_to_segment(step);
    let at: [f64; STEPS + 1] = std::array::from_fn(|n| off(n as f64 / STEPS as f64));
    let top = (0..=STEPS).fold(0, |top, n| if at[n] > at[top] { n } else { top });
    if top == 0 || top == STEPS {
        return at[top];
    }
    let (before, after) = (at[top] - at[top - 1], at[top] - at[top + 1]);
    let aside = 0.5 * (before - after) / (before + after);
    let t = (top as f64 + if aside.is_finite() { aside } else { 0.0 }) / STEPS as f64;
    at[top].max(off(t))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{Curve, CurveKind, CurvePoint};
    use crate::math::{cos, from_deg, sin};

    #[test]
    fn an_arc_lies_its_sagitta_from_its_chord_and_is_longer_than_it() {
        for turn in [2.0f64, 20.0, 90.0] {
            let on = |n: usize| {
                let a = from_deg(turn * n as f64 / 64.0);
                CurvePoint::smooth(Point3::new(200.0 * cos(a), 200.0 * sin(a), 7.0))
            };
            let points: Vec<CurvePoint> = (0..=64).map(on).collect();
            let curve = Curve::new(CurveKind::Spline, &points, false).unwrap();
            let chord = chord(curve.spans());
            let half = from_deg(0.5 * turn);
            let shorter_mm = 400.0 * (half - sin(half));
            let within = |found: f64, exact: f64| (found - exact).abs() < 2e-4 * exact + 1e-9;
            assert!(within(chord.distance_mm, 200.0 * (1.0 - cos(half))), "{turn} {chord:?}");
            assert!(within(chord.shorter_mm, shorter_mm), "{turn} {chord:?} {shorter_mm}");
        }
    }

    #[test]
    fn the_farthest_point_is_found_wherever_it_lies_on_the_span() {
        let p = Point3::new;
        for lift in [0.0, 0.3, 1.0, 4.0] {
            let span =
                Cubic { control: [p(0., 0., 0.), p(0.2, lift, 0.), p(4., 0.5, 1.), p(5., 0., 0.)] };
            let ends = [span.control[0], span.control[3]];
            let dense =
                (0..=10_000).map(|n| span.position(f64::from(n) * 1e-4).distance_to_segment(ends));
            let dense = dense.fold(0.0, f64::max);
            let found = chord(&[span]).distance_mm;
            assert!(found <= dense * (1.0 + 1e-6) && found >= 0.999 * dense, "{found} {dense}");
        }
        assert_eq!(chord(&[Cubic::line(p(1., 2., 3.), p(4., 4., 4.))]).distance_mm, 0.0);
        assert_eq!(chord(&[]), Chord::default());
    }
}
