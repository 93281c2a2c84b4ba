//! Samples of curves, evenly by arc length, that keep the corners.
//!
//! The curves are split at their corners into smooth stretches. Every stretch begins and ends at a
//! sample and is divided evenly. Unless the numbers are given, divisions are shared out by length,
//! at least one a stretch (largest remainder, the first of equals). A stretch that is walked back
//! along another, as the two sides of a seam are, gets as many. In either direction, the samples of
//! a stretch have the same bits.

use super::arc_length::{length, parameter_at};
use super::{Cubic, Curve};
use crate::math::{Point3, Vec3, angle_between};
use std::collections::BTreeMap;
use std::fmt;

/// Tangents at a joint that differ by less, radians, are one tangent: far below the angles that can
/// be drawn or seen on a sheet, far above rounding.
const SAME_DIRECTION: f64 = 1e-7;

/// A point of a curve with its tangents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Where it lies, mm.
    pub position: Point3,
    /// Unit tangent of the curve as it arrives.
    pub tangent_in: Vec3,
    /// Unit tangent of the curve as it leaves; equal to `tangent_in` except at a corner.
    pub tangent_out: Vec3,
}

impl Sample {
    /// Whether the curve turns here.
    pub fn is_corner(&self) -> bool {
        self.tangent_in != self.tangent_out
    }

    /// The cubic to the next sample by the tangents of both, whose derivatives at its ends are as
    /// long as the chord: straight where both tangents lie along the chord.
    pub fn cubic_to(&self, next: &Self) -> Cubic {
        let chord = self.position.distance(next.position);
        let (leaving, arriving) = (self.tangent_out * chord, next.tangent_in * chord);
        Cubic::hermite(self.position, leaving, next.position, arriving)
    }
}

/// Why curves cannot be sampled.
#[derive(Clone, Debug, PartialEq)]
pub enum SampleError {
    /// Fewer samples than the corners need.
    TooFew {
        /// The number of samples wanted.
        asked: usize,
        /// The number needed to keep every corner.
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

/// A place on a curve of a chain: a span, counted from 0, and its parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The curve, counted from 0.
    pub curve: usize,
    /// The span of it.
    pub span: usize,
    /// Where on the span, 0 ..= 1.
    pub t: f64,
}

/// A sample and the places that it was taken from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// The sample.
    pub sample: Sample,
    /// Where the curve arrives at it.
    pub arriving: Place,
    /// Where the curve leaves it; its position is taken there.
    pub leaving: Place,
}

impl Placed {
    /// The samples alone.
    pub fn samples(placed: Vec<Self>) -> Vec<Sample> {
        placed.into_iter().map(|placed| placed.sample).collect()
    }
}

/// A smooth run of spans.
struct Stretch {
    /// The spans, in a direction that does not depend on that of the curve.
    spans: Vec<Cubic>,
    /// Whether the curve runs in the other direction.
    turned: bool,
    lengths: Vec<f64>,
    whole: f64,
    /// The curve, and the numbers of its spans in the order of the curve.
    curve: usize,
    numbers: Vec<usize>,
    /// The given number of divisions, if there is one.
    divisions: Option<usize>,
    /// The earlier stretch that this one is walked back along, if there is one.
    back_along: Option<usize>,
}

impl Stretch {
    fn new(spans: Vec<Cubic>, curve: usize, numbers: Vec<usize>) -> Self {
        let back: Vec<Cubic> = spans.iter().rev().map(Cubic::reversed).collect();
        let order = |spans: &[Cubic]| {
            let first = spans[0].control.map(Point3::to_vec);
            [first[0], first[1]].map(|p| p.to_array())
        };
        let turned = order(&back) < order(&spans);
        let spans = if turned { back } else { spans };
        let lengths: Vec<f64> = spans.iter().map(|s| length(s, 0.0, 1.0)).collect();
        let whole = lengths.iter().sum();
        Self { spans, turned, lengths, whole, curve, numbers, divisions: None, back_along: None }
    }

    /// Position, unit tangent and place after `part` of `parts` equal parts of the stretch.
    fn at(&self, part: usize, parts: usize) -> (Point3, Vec3, Place) {
        let part = if self.turned { parts - part } else { part };
        let (n, t) = self.locate(part, parts);
        let (position, tangent) = (self.spans[n].position(t), self.spans[n].tangent(t));
        let place = |n: usize, t: f64| Place { curve: self.curve, span: self.numbers[n], t };
        if self.turned {
            (position, -tangent, place(self.numbers.len() - 1 - n, 1.0 - t))
        } else {
            (position, tangent, place(n, t))
        }
    }

    /// The span and its parameter, the way that the spans run.
    fn locate(&self, part: usize, parts: usize) -> (usize, f64) {
        let last = self.spans.len() - 1;
        if part == 0 {
            return (0, 0.0);
        }
        if part == parts {
            return (last, 1.0);
        }
        let mut left = self.whole * (part as f64 / parts as f64);
        let mut n = 0;
        while n < last && left > self.lengths[n] {
            left -= self.lengths[n];
            n += 1;
        }
        (n, parameter_at(&self.spans[n], left, self.lengths[n]))
    }
}

/// Notes which stretches are walked back along earlier ones: exactly, as the uses of one curve are.
fn pair_seams(stretches: &mut [Stretch]) {
    let bits = |p: Point3| [p.x, p.y, p.z].map(f64::to_bits);
    let mut by_ends: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    for n in 0..stretches.len() {
        let this = &stretches[n];
        let ends = (
            bits(this.spans[0].position(0.0)),
            bits(this.spans[this.spans.len() - 1].position(1.0)),
        );
        let back_along = |forth: &usize| {
            let forth = &stretches[*forth];
            forth.turned != this.turned && forth.spans == this.spans
        };
        // Each is walked back along once.
        let waiting = by_ends.entry(ends).or_default();
        let found = waiting.iter().position(back_along).map(|place| waiting.remove(place));
        if found.is_none() {
            waiting.push(n);
        }
        stretches[n].back_along = found;
    }
}

fn stretches_of(curve: &Curve, number: usize) -> impl Iterator<Item = Stretch> {
    let m = curve.spans().len();
    curve.stretches().into_iter().map(move |range| {
        let numbers: Vec<usize> = range.map(|i| i % m).collect();
        Stretch::new(numbers.iter().map(|&i| curve.spans()[i]).collect(), number, numbers)
    })
}

/// `count` samples of an open curve, both ends among them.
///
/// # Errors
/// Too few samples to keep every corner and both ends.
pub fn sample_open(curve: &Curve, count: usize) -> Result<Vec<Sample>, SampleError> {
    open_placed(curve, count, None).map(Placed::samples)
}

/// `count` samples of an open curve with their places on it, both ends among them; the number of
/// the curve is 0. Where `divisions` are given, one entry for each stretch between corners, there
/// are as many samples as that makes.
///
/// # Errors
/// As those of [`sample_open`].
pub fn open_placed(
    curve: &Curve,
    count: usize,
    divisions: Option<&[usize]>,
) -> Result<Vec<Placed>, SampleError> {
    let given = |n: usize| divisions.and_then(|list| list.get(n)).copied();
    let stretches: Vec<Stretch> = stretches_of(curve, 0)
        .enumerate()
        .map(|(n, stretch)| Stretch { divisions: given(n), ..stretch })
        .collect();
    let needed = stretches.len() + 1;
    if count < needed {
        return Err(SampleError::TooFew { asked: count, needed });
    }
    let mut samples = walk(&stretches, &shared_out(&stretches, count - 1));
    let (position, tangent, place) = stretches[stretches.len() - 1].at(1, 1);
    let sample = Sample { position, tangent_in: tangent, tangent_out: tangent };
    samples.push(Placed { sample, arriving: place, leaving: place });
    // Nothing arrives at the beginning of an open curve.
    samples[0].sample.tangent_in = samples[0].sample.tangent_out;
    samples[0].arriving = samples[0].leaving;
    Ok(samples)
}

/// `count` samples of the closed loop that `curves` make when chained end to end (or of the one
/// closed curve among them). The loop begins where the first curve begins.
///
/// # Errors
/// Too few samples to keep every corner and every joint between two curves; at least 3.
pub fn sample_chain(curves: &[Curve], count: usize) -> Result<Vec<Sample>, SampleError> {
    chain_placed(curves, count, &[]).map(Placed::samples)
}

/// `count` samples, with their places, of the closed loop that [`sample_chain`] describes. A curve
/// with a list in `divisions` gets these divisions, one entry for each of its stretches between
/// corners. They count towards `count`, which is exceeded where they need more.
///
/// # Errors
/// As those of [`sample_chain`].
pub fn chain_placed(
    curves: &[Curve],
    count: usize,
    divisions: &[Option<Vec<usize>>],
) -> Result<Vec<Placed>, SampleError> {
    let mut stretches = Vec::new();
    for (number, curve) in curves.iter().enumerate() {
        let given = divisions.get(number).and_then(Option::as_deref).unwrap_or_default();
        let mut given = given.iter().copied();
        stretches
            .extend(stretches_of(curve, number).map(|s| Stretch { divisions: given.next(), ..s }));
    }
    pair_seams(&mut stretches);
    let needed = stretches.len().max(3);
    if count < needed {
        return Err(SampleError::TooFew { asked: count, needed });
    }
    let mut samples = walk(&stretches, &shared_out(&stretches, count));
    // A closed curve whose first point is no corner begins inside its last stretch; rotate the
    // samples so that the one nearest to its beginning comes first.
    if let [curve] = curves {
        let start = curve.start();
        let nearest = (0..samples.len())
            .min_by(|&a, &b| {
                let to = |i: usize| samples[i].sample.position.distance(start);
                to(a).total_cmp(&to(b)).then(a.cmp(&b))
            })
            .unwrap_or(0);
        samples.rotate_left(nearest);
    }
    Ok(samples)
}

/// How many divisions the stretches of each curve get in the loop that `curves` make, as
/// [`sample_chain`] shares them out.
///
/// # Errors
/// As those of [`sample_chain`].
pub fn divisions_of(curves: &[Curve], count: usize) -> Result<Vec<Vec<usize>>, SampleError> {
    let samples = chain_placed(curves, count, &[])?;
    let stretches = |curve: &Curve| curve.stretches();
    let mut found: Vec<Vec<usize>> =
        curves.iter().map(|curve| vec![0; stretches(curve).len()]).collect();
    for Placed { leaving, .. } in samples {
        let curve = &curves[leaving.curve];
        let m = curve.spans().len();
        let holds = |range: &std::ops::Range<usize>| {
            range.contains(&leaving.span) || range.contains(&(leaving.span + m))
        };
        if let Some(n) = stretches(curve).iter().position(holds) {
            found[leaving.curve][n] += 1;
        }
    }
    Ok(found)
}

/// The samples of the closed loop that open curves make when chained end to end, from the samples
/// of each with both its ends. Where one curve ends and the next begins, the sample has the
/// position of the beginning and the tangents of both.
pub fn chained_samples(curves: &[Vec<Sample>]) -> Vec<Sample> {
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

/// All samples of a ring of stretches but the one that ends the last, with these divisions.
fn walk(stretches: &[Stretch], divisions: &[usize]) -> Vec<Placed> {
    let mut samples = Vec::with_capacity(divisions.iter().sum::<usize>() + 1);
    let (_, mut before, mut place_before) = stretches[stretches.len() - 1].at(1, 1);
    for (stretch, &parts) in stretches.iter().zip(divisions) {
        for part in 0..parts {
            let (position, tangent, leaving) = stretch.at(part, parts);
            let smooth = part > 0 || angle_between(before, tangent) < SAME_DIRECTION;
            let (tangent_in, arriving) =
                if smooth { (tangent, leaving) } else { (before, place_before) };
            let sample = Sample { position, tangent_in, tangent_out: tangent };
            samples.push(Placed { sample, arriving, leaving });
        }
        (_, before, place_before) = stretch.at(1, 1);
    }
    samples
}

/// How many divisions each stretch gets: the given number; else by length, at least one each, as
/// many for both sides of a seam.
fn shared_out(stretches: &[Stretch], divisions: usize) -> Vec<usize> {
    let free: Vec<usize> =
        (0..stretches.len()).filter(|&n| stretches[n].divisions.is_none()).collect();
    let given: usize = stretches.iter().filter_map(|s| s.divisions).sum();
    let divisions = divisions.saturating_sub(given).max(free.len());
    let whole: f64 = free.iter().map(|&n| stretches[n].whole).sum();
    let spare = divisions - free.len();
    // Each has one already; the rest is shared out, and short stretches get none of it.
    let ideal: Vec<f64> = (0..stretches.len())
        .map(|n| match stretches[n].divisions {
            None => (stretches[n].whole / whole * divisions as f64 - 1.0).max(0.0),
            Some(_) => 0.0,
        })
        .collect();
    let wanted: f64 = ideal.iter().sum();
    let scale = if wanted > 0.0 { spare as f64 / wanted } else { 0.0 };
    let least = |n: usize| stretches[n].divisions.unwrap_or(1);
    let mut parts: Vec<usize> =
        (0..stretches.len()).map(|n| least(n) + (ideal[n] * scale).floor() as usize).collect();
    let mut left = (divisions + given).saturating_sub(parts.iter().sum());
    // Those that share a remainder: a stretch alone, or both sides of a seam.
    let mut sides: Vec<Vec<usize>> = (0..stretches.len()).map(|n| vec![n]).collect();
    for n in 0..stretches.len() {
        if let Some(forth) = stretches[n].back_along {
            sides[n].clear();
            sides[forth].push(n);
        }
    }
    sides.retain(|side| side.first().is_some_and(|&n| stretches[n].divisions.is_none()));
    let rest = |n: usize| ideal[n] * scale - (ideal[n] * scale).floor();
    sides.sort_by(|a, b| rest(b[0]).total_cmp(&rest(a[0])).then(a[0].cmp(&b[0])));
    // A single division that a seam can't share goes to the other stretches, so there are at most
    // as many rounds as remainders; a loop of seams only keeps one division too few.
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
