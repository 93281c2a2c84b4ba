//! Samples of curves, evenly by arc length, that keep the corners.
//!
//! The curves are split at their corners into smooth stretches. Every stretch begins and ends at a
//! sample and is divided evenly; the divisions are shared out by length, at least one a stretch
//! (largest remainder, the first of equals). A stretch that is walked back along another, as the
//! two sides of a seam are, gets as many, and the same bits for its samples.

use super::arc_length::{length, parameter_at};
use super::{Cubic, Curve};
use crate::math::{Point3, Vec3, angle_between};
use std::collections::BTreeMap;
use std::fmt;

/// Tangents at a joint that differ by less, radians, are one tangent: far below what a hand can
/// draw or a sheet can show, far above rounding.
const SAME_DIRECTION: f64 = 1e-7;

/// A point of a curve with its tangents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Where it lies, mm.
    pub position: Point3,
    /// Unit tangent of the curve as it arrives.
    pub tangent_in: Vec3,
    /// Unit tangent of the curve as it leaves; that of arrival but at a corner.
    pub tangent_out: Vec3,
}

impl Sample {
    /// Whether the curve turns here.
    pub fn is_corner(&self) -> bool {
        self.tangent_in != self.tangent_out
    }
}

/// Why curves cannot be sampled.
#[derive(Clone, Debug, PartialEq)]
pub enum SampleError {
    /// Fewer samples than the corners need.
    TooFew {
        /// How many were asked for.
        asked: usize,
        /// How many it takes to keep every corner.
        needed: usize,
    },
}

impl fmt::Display for SampleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::TooFew { asked, needed } = self;
        write!(f, "{asked} samples cannot keep every corner: it takes at least {needed}")
    }
}

impl std::error::Error for SampleError {}

/// A smooth run of spans.
struct Stretch {
    spans: Vec<Cubic>,
    lengths: Vec<f64>,
    whole: f64,
    /// The earlier stretch that this one is walked back along, if there is one.
    back_along: Option<usize>,
}

impl Stretch {
    fn new(spans: Vec<Cubic>) -> Self {
        let lengths: Vec<f64> = spans.iter().map(|s| length(s, 0.0, 1.0)).collect();
        let whole = lengths.iter().sum();
        Self { spans, lengths, whole, back_along: None }
    }

    /// Position and unit tangent where `part` of `parts` equal parts of the stretch are behind.
    fn at(&self, part: usize, parts: usize) -> (Point3, Vec3) {
        let last = self.spans.len() - 1;
        if part == 0 {
            return (self.spans[0].position(0.0), self.spans[0].tangent(0.0));
        }
        if part == parts {
            return (self.spans[last].position(1.0), self.spans[last].tangent(1.0));
        }
        let mut left = self.whole * (part as f64 / parts as f64);
        let mut n = 0;
        while n < last && left > self.lengths[n] {
            left -= self.lengths[n];
            n += 1;
        }
        let t = parameter_at(&self.spans[n], left, self.lengths[n]);
        (self.spans[n].position(t), self.spans[n].tangent(t))
    }
}

/// Position and unit tangent where `part` of `parts` equal parts of stretch `n` are behind.
fn at(stretches: &[Stretch], n: usize, part: usize, parts: usize) -> (Point3, Vec3) {
    match stretches[n].back_along {
        None => stretches[n].at(part, parts),
        Some(forth) => {
            let (position, tangent) = stretches[forth].at(parts - part, parts);
            (position, -tangent)
        }
    }
}

/// Notes which stretches are walked back along earlier ones: exactly, as the uses of one curve are.
fn pair_seams(stretches: &mut [Stretch]) {
    let bits = |p: Point3| [p.x, p.y, p.z].map(f64::to_bits);
    let mut by_ends: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    for n in 0..stretches.len() {
        let ends = |s: &Stretch| {
            (bits(s.spans[0].position(0.0)), bits(s.spans[s.spans.len() - 1].position(1.0)))
        };
        let (start, end) = ends(&stretches[n]);
        let same = |forth: &usize| {
            let (back, forth) = (&stretches[n].spans, &stretches[*forth].spans);
            back.len() == forth.len()
                && back.iter().zip(forth.iter().rev()).all(|(b, f)| *b == f.reversed())
        };
        // Each is walked back along once.
        let waiting = by_ends.get_mut(&(end, start));
        let found = waiting.and_then(|list| {
            let place = list.iter().position(same)?;
            Some(list.remove(place))
        });
        match found {
            Some(forth) => stretches[n].back_along = Some(forth),
            None => by_ends.entry((start, end)).or_default().push(n),
        }
    }
}

fn stretches_of(curve: &Curve) -> impl Iterator<Item = Stretch> {
    let m = curve.spans().len();
    curve
        .stretches()
        .into_iter()
        .map(move |range| Stretch::new(range.map(|i| curve.spans()[i % m]).collect()))
}

/// `count` samples of an open curve, both ends among them.
///
/// # Errors
/// Too few samples to keep every corner and both ends.
pub fn sample_open(curve: &Curve, count: usize) -> Result<Vec<Sample>, SampleError> {
    let stretches: Vec<Stretch> = stretches_of(curve).collect();
    let needed = stretches.len() + 1;
    if count < needed {
        return Err(SampleError::TooFew { asked: count, needed });
    }
    let mut samples = walk(&stretches, count - 1);
    let (position, tangent) = stretches[stretches.len() - 1].at(1, 1);
    samples.push(Sample { position, tangent_in: tangent, tangent_out: tangent });
    // Nothing arrives at the beginning of an open curve.
    samples[0].tangent_in = samples[0].tangent_out;
    Ok(samples)
}

/// `count` samples of the closed loop that `curves` make when chained end to end (or of the one
/// closed curve among them). The loop begins where the first curve begins.
///
/// # Errors
/// Too few samples to keep every corner and every joint between two curves; at least 3.
pub fn sample_chain(curves: &[Curve], count: usize) -> Result<Vec<Sample>, SampleError> {
    let mut stretches: Vec<Stretch> = curves.iter().flat_map(stretches_of).collect();
    pair_seams(&mut stretches);
    let needed = stretches.len().max(3);
    if count < needed {
        return Err(SampleError::TooFew { asked: count, needed });
    }
    let mut samples = walk(&stretches, count);
    // A closed curve whose first point is no corner begins inside its last stretch; turn the
    // samples so that they begin as near to its beginning as one lies.
    if let [curve] = curves {
        let start = curve.start();
        let nearest = (0..samples.len())
            .min_by(|&a, &b| {
                let to = |i: usize| samples[i].position.distance(start);
                to(a).total_cmp(&to(b)).then(a.cmp(&b))
            })
            .unwrap_or(0);
        samples.rotate_left(nearest);
    }
    Ok(samples)
}

/// The samples of the closed loop that open curves make when chained end to end, from the samples
/// of each with both its ends. Where one ends the next begins: that sample has the place where it
/// begins, and the tangents of both.
pub(crate) fn chained_samples(curves: &[Vec<Sample>]) -> Vec<Sample> {
    let mut samples: Vec<Sample> = Vec::new();
    let mut arriving = curves.last().and_then(|curve| curve.last()).copied();
    for curve in curves {
        let Some((last, others)) = curve.split_last() else { continue };
        let first = samples.len();
        samples.extend(others);
        if let (Some(begin), Some(end)) = (samples.get_mut(first), arriving) {
            let smooth = angle_between(end.tangent_out, begin.tangent_out) < SAME_DIRECTION;
            begin.tangent_in = if smooth { begin.tangent_out } else { end.tangent_out };
        }
        arriving = Some(*last);
    }
    samples
}

/// All samples of a ring of stretches but the one that ends the last: `divisions` of them.
fn walk(stretches: &[Stretch], divisions: usize) -> Vec<Sample> {
    let parts = shared_out(stretches, divisions);
    let mut samples = Vec::with_capacity(divisions + 1);
    let mut arriving = at(stretches, stretches.len() - 1, 1, 1).1;
    for (n, &parts) in parts.iter().enumerate() {
        for part in 0..parts {
            let (position, tangent) = at(stretches, n, part, parts);
            let smooth = part > 0 || angle_between(arriving, tangent) < SAME_DIRECTION;
            let tangent_in = if smooth { tangent } else { arriving };
            samples.push(Sample { position, tangent_in, tangent_out: tangent });
        }
        arriving = at(stretches, n, 1, 1).1;
    }
    samples
}

/// How many divisions each stretch gets: by length, at least one each, as many for both sides of a
/// seam.
fn shared_out(stretches: &[Stretch], divisions: usize) -> Vec<usize> {
    let whole: f64 = stretches.iter().map(|s| s.whole).sum();
    let spare = divisions - stretches.len();
    // One is given already, so what is shared is the rest; short stretches want none of it.
    let length = |n: usize| stretches[stretches[n].back_along.unwrap_or(n)].whole;
    let ideal: Vec<f64> = (0..stretches.len())
        .map(|n| (length(n) / whole * divisions as f64 - 1.0).max(0.0))
        .collect();
    let wanted: f64 = ideal.iter().sum();
    let scale = if wanted > 0.0 { spare as f64 / wanted } else { 0.0 };
    let mut parts: Vec<usize> = ideal.iter().map(|w| 1 + (w * scale).floor() as usize).collect();
    let mut left = divisions.saturating_sub(parts.iter().sum());
    // Those that share a remainder: a stretch alone, or both sides of a seam.
    let mut sides: Vec<Vec<usize>> = (0..stretches.len()).map(|n| vec![n]).collect();
    for n in 0..stretches.len() {
        if let Some(forth) = stretches[n].back_along {
            sides[n].clear();
            sides[forth].push(n);
        }
    }
    sides.retain(|side| !side.is_empty());
    let rest = |n: usize| ideal[n] * scale - (ideal[n] * scale).floor();
    sides.sort_by(|a, b| rest(b[0]).total_cmp(&rest(a[0])).then(a[0].cmp(&b[0])));
    // What no seam can share goes to the others, so that at most as many rounds as there are
    // remainders are needed; a loop of nothing but seams keeps one too few.
    for side in sides.iter().cycle().take(2 * divisions) {
        if left >= side.len() {
            side.iter().for_each(|&n| parts[n] += 1);
            left -= side.len();
        }
        if left == 0 {
            break;
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{CurveKind, CurvePoint};

    fn square(side: f64) -> Curve {
        let points = [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]]
            .map(|[x, y]| CurvePoint::corner(Point3::new(x, y, 0.0)));
        Curve::new(CurveKind::Polyline, &points, true).unwrap()
    }

    #[test]
    fn a_square_keeps_its_corners_and_its_spacing() {
        let samples = sample_chain(&[square(10.0)], 42).unwrap();
        assert_eq!(samples.len(), 42);
        assert_eq!(samples.iter().filter(|s| s.is_corner()).count(), 4);
        let gaps: Vec<f64> =
            (0..42).map(|i| samples[i].position.distance(samples[(i + 1) % 42].position)).collect();
        assert!(gaps.iter().all(|g| (10.0 / 11.0 - 1e-9..=1.0 + 1e-9).contains(g)), "{gaps:?}");
        assert!((gaps.iter().sum::<f64>() - 40.0).abs() < 1e-9);
    }

    #[test]
    fn every_corner_needs_a_sample() {
        let refused = sample_chain(&[square(1.0)], 3);
        assert_eq!(refused, Err(SampleError::TooFew { asked: 3, needed: 4 }));
    }

    #[test]
    fn a_smooth_loop_is_spaced_evenly_and_has_no_corner() {
        let points: Vec<CurvePoint> = (0..12)
            .map(|i| {
                let t = std::f64::consts::TAU * f64::from(i) / 12.0;
                CurvePoint::smooth(Point3::new(
                    3.0 * crate::math::cos(t),
                    crate::math::sin(t),
                    crate::math::sin(2.0 * t),
                ))
            })
            .collect();
        let curve = Curve::new(CurveKind::Spline, &points, true).unwrap();
        let samples = sample_chain(std::slice::from_ref(&curve), 1000).unwrap();
        assert!(samples.iter().all(|s| !s.is_corner()));
        assert!(samples[0].position.distance(curve.start()) < 1e-12);
        let gaps: Vec<f64> = (0..1000)
            .map(|i| samples[i].position.distance(samples[(i + 1) % 1000].position))
            .collect();
        let (least, most) = gaps.iter().fold((f64::MAX, 0.0f64), |(a, b), &g| (a.min(g), b.max(g)));
        assert!(most / least < 1.001, "{least} {most}");
    }

    #[test]
    fn both_sides_of_a_seam_have_the_same_samples() {
        let open = |points: &[[f64; 3]]| {
            let points: Vec<CurvePoint> =
                points.iter().map(|p| CurvePoint::smooth(Point3::new(p[0], p[1], p[2]))).collect();
            Curve::new(CurveKind::Spline, &points, false).unwrap()
        };
        let ring = |z: f64| {
            open(&[[9.0, 0.0, z], [0.0, 9.0, z], [-9.0, 0.0, z], [0.0, -9.0, z], [9.0, 0.0, z]])
        };
        let seam = open(&[[9.0, 0.0, 0.0], [9.3, 0.1, 4.0], [9.0, 0.0, 10.0]]);
        let tube = [ring(0.0), seam.clone(), ring(10.0).reversed(), seam.reversed()];
        for count in 20..160 {
            let samples = sample_chain(&tube, count).unwrap();
            assert_eq!(samples.len(), count);
            let doubled = (0..count)
                .filter(|&i| {
                    let at = |k: usize| samples[k % count].position;
                    (0..count).any(|j| at(i) == at(j + 1) && at(i + 1) == at(j))
                })
                .count();
            assert!(doubled >= 2 && doubled % 2 == 0, "{count}: {doubled}");
        }
    }

    #[test]
    fn an_open_curve_keeps_both_ends() {
        let points = [[0.0, 0.0], [1.0, 2.0], [4.0, 0.0]]
            .map(|[x, y]| CurvePoint::smooth(Point3::new(x, y, 0.0)));
        let curve = Curve::new(CurveKind::Spline, &points, false).unwrap();
        let samples = sample_open(&curve, 7).unwrap();
        assert_eq!(samples.len(), 7);
        assert_eq!(samples[0].position, points[0].at);
        assert_eq!(samples[6].position, points[2].at);
        assert!(samples.iter().all(|s| !s.is_corner()));
    }
}
