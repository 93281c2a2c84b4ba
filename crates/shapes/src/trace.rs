//! Samples of a closed curve that is given as a function, evenly by arc length.

use sheetwright::curve::Sample;
use sheetwright::math::{Point3, Vec3, unit};

/// A closed curve over the parameter 0 ..= 1, with the parameters of its corners in increasing
/// order; 0 is among them if there are any.
pub struct Trace<'a> {
    /// The point at a parameter, mm.
    pub point: &'a dyn Fn(f64) -> Point3,
    /// Where the corners are.
    pub corners: Vec<f64>,
}

/// Steps of the arc-length table for each stretch: its trapezoids are exact to 10⁻⁹ of the length
/// on the curves that are sampled here.
const STEPS: usize = 20_000;

impl Trace<'_> {
    /// Unit tangent at `t`, of the stretch that runs from `from` to `to`: a difference quotient of
    /// fourth order that stays inside the stretch.
    fn tangent(&self, t: f64, from: f64, to: f64) -> Vec3 {
        let h = 1e-4 * (to - from);
        let t = t.clamp(from + 2.0 * h, to - 2.0 * h);
        let at = |n: f64| (self.point)(t + n * h).to_vec();
        unit((at(1.0) - at(-1.0)) * 8.0 - (at(2.0) - at(-2.0))).unwrap_or(Vec3::ZERO)
    }

    /// Unit tangent at the end `t` of a stretch, a one-sided difference quotient of fourth order:
    /// `inwards` is 1 at its beginning and −1 at its end.
    fn tangent_at_end(&self, t: f64, from: f64, to: f64, inwards: f64) -> Vec3 {
        let h = 1e-4 * (to - from) * inwards;
        let at = |n: f64| (self.point)(t + n * h).to_vec();
        let way =
            at(0.0) * -25.0 + at(1.0) * 48.0 - at(2.0) * 36.0 + at(3.0) * 16.0 - at(4.0) * 3.0;
        unit(way * inwards).unwrap_or(Vec3::ZERO)
    }
}

/// `count` samples of a curve with the parameters that they lie at; every corner is a sample.
pub fn samples_along(trace: &Trace<'_>, count: usize) -> Vec<(f64, Sample)> {
    let smooth = trace.corners.is_empty();
    let mut ends = if smooth { vec![0.0] } else { trace.corners.clone() };
    ends.push(ends[0] + 1.0);
    let tables: Vec<Vec<f64>> =
        ends.windows(2).map(|ends| arc_table(trace, ends[0], ends[1])).collect();
    let lengths: Vec<f64> = tables.iter().map(|table| table[STEPS]).collect();
    let parts = shared_out(&lengths, count);
    let mut samples = Vec::with_capacity(count);
    for (n, ends) in ends.windows(2).enumerate() {
        let (from, to) = (ends[0], ends[1]);
        for part in 0..parts[n] {
            let wanted = lengths[n] * part as f64 / parts[n] as f64;
            let t = from + (to - from) * share_at(&tables[n], wanted);
            let position = (trace.point)(t);
            let sample = if part > 0 {
                let tangent = trace.tangent(t, from, to);
                Sample { position, tangent_in: tangent, tangent_out: tangent }
            } else if smooth {
                let tangent = trace.tangent(t, from - 0.5, to + 0.5);
                Sample { position, tangent_in: tangent, tangent_out: tangent }
            } else {
                let before =
                    if n == 0 { ends_before(&trace.corners) } else { trace.corners[n - 1] };
                Sample {
                    position,
                    tangent_in: trace.tangent_at_end(t, before, from, -1.0),
                    tangent_out: trace.tangent_at_end(t, from, to, 1.0),
                }
            };
            samples.push((t, sample));
        }
    }
    samples
}

fn ends_before(corners: &[f64]) -> f64 {
    corners[corners.len() - 1] - 1.0
}

fn arc_table(trace: &Trace<'_>, from: f64, to: f64) -> Vec<f64> {
    let at = |n: usize| (trace.point)(from + (to - from) * n as f64 / STEPS as f64);
    let mut table = Vec::with_capacity(STEPS + 1);
    table.push(0.0);
    let mut before = at(0);
    for n in 1..=STEPS {
        let here = at(n);
        table.push(table[n - 1] + before.distance(here));
        before = here;
    }
    table
}

fn share_at(table: &[f64], wanted: f64) -> f64 {
    let n = table.partition_point(|&length| length <= wanted).clamp(1, STEPS);
    let (low, high) = (table[n - 1], table[n]);
    ((n - 1) as f64 + (wanted - low) / (high - low)) / STEPS as f64
}

fn shared_out(lengths: &[f64], count: usize) -> Vec<usize> {
    let whole: f64 = lengths.iter().sum();
    let mut parts: Vec<usize> =
        lengths.iter().map(|l| ((l / whole * count as f64).round() as usize).max(1)).collect();
    let longest =
        (0..lengths.len()).max_by(|&a, &b| lengths[a].total_cmp(&lengths[b])).unwrap_or(0);
    let others: usize = parts.iter().sum::<usize>() - parts[longest];
    parts[longest] = count.saturating_sub(others).max(1);
    parts
}
