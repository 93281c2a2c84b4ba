//! How samples follow the unknowns: positions and tangents are linear in them, before tangents are
//! normalised.

use sheetwright_geometry::boundary::Boundary;
use sheetwright_geometry::curve::Sample;
use sheetwright_geometry::math::{Vec3, unit};
use sheetwright_optimum::cost::SampleSlope;

/// The share of an unknown in a position or a derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// The unknown, a displacement in space, counted from 0.
    pub unknown: usize,
    /// The share along each axis, without unit. Alike along all of them, but for what mirrors the
    /// displacement in a plane across an axis, or holds it in that plane.
    pub factor: Vec3,
}

/// The slip of a sample along its curve as an unknown moves: `way` · displacement, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip {
    /// The unknown, counted from 0.
    pub unknown: usize,
    /// The slip for a displacement of 1 mm along each axis, without unit.
    pub way: Vec3,
}

/// How a tangent follows the unknowns: it is the direction of `length_mm` times the tangent at the
/// start, plus the shares, plus `bend` times the slip of the sample.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lean {
    /// The length of the derivative, or of the difference of samples, whose direction the tangent
    /// at the start is, mm; positive.
    pub length_mm: f64,
    /// The displacements added to it.
    pub shares: Vec<Share>,
    /// The vector added to it for each mm that the sample slips, without unit.
    pub bend: Vec3,
}

/// How a sample follows the unknowns. Without shares it is fixed and keeps its bits.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// The displacements added to its position.
    pub position: Vec<Share>,
    /// How it slips along its curve, so that samples stay evenly spaced as the length of the curve
    /// changes.
    pub slip: Vec<Slip>,
    /// The direction that it slips in, a unit tangent.
    pub along: Vec3,
    /// How its tangent of arrival turns; unused for a sample that is no corner.
    pub tangent_in: Lean,
    /// How its tangent of leaving turns.
    pub tangent_out: Lean,
}

/// The motions of samples whose positions follow these shares, one list a sample. Tangents follow
/// the difference of the neighbours, at corners of the sample and its neighbour: tangents that come
/// from a spline begin as they are and turn as the samples beside them move.
///
/// # Panics
/// Unless there is one list for every sample.
pub fn motions(boundary: &Boundary, positions: Vec<Vec<Share>>) -> Vec<Motion> {
    assert_eq!(positions.len(), boundary.len(), "one list of shares a sample");
    let at = |i: usize| boundary.samples()[i].position;
    let lean = |from: usize, to: usize| {
        let opposite = |share: &Share| Share { factor: -share.factor, ..*share };
        let shares = positions[to].iter().copied().chain(positions[from].iter().map(opposite));
        let shares = gathered(shares.collect());
        Lean { length_mm: at(to).distance(at(from)), shares, bend: Vec3::ZERO }
    };
    let motion = |i: usize| {
        let (before, after) = (boundary.previous(i), boundary.next(i));
        let (tangent_in, tangent_out) = if boundary.samples()[i].is_corner() {
            (lean(before, i), lean(i, after))
        } else {
            let central = lean(before, after);
            (central.clone(), central)
        };
        Motion { position: positions[i].clone(), tangent_in, tangent_out, ..Motion::default() }
    };
    (0..boundary.len()).map(motion).collect()
}

/// The motions of samples that are unknowns themselves, by their numbers in `unknown`; the others
/// are fixed. The copies of a shared sample are one unknown.
///
/// # Panics
/// Unless there is one entry for every sample.
pub fn motions_of_samples(boundary: &Boundary, unknown: &[Option<usize>]) -> Vec<Motion> {
    let of =
        |n: &Option<usize>| n.iter().map(|&unknown| Share { unknown, factor: Vec3::ONE }).collect();
    motions(boundary, unknown.iter().map(of).collect())
}

/// The shares of a sample in the displacements of control points, numbered from `first` on, of a
/// uniform cubic B-spline along an open curve. `along` is the place of the sample: 0 at the
/// beginning and 1 at the end, where it follows the first and the last alone. The shares are
/// positive and add up to one, so that no sample moves farther than a control point.
///
/// # Panics
/// With fewer than four control points.
pub fn control_shares(along: f64, first: usize, controls: usize) -> Vec<Share> {
    assert!(controls >= 4, "a cubic has four control points");
    let spans = controls - 3;
    let knot = |n: usize| n.saturating_sub(3).min(spans) as f64;
    let u = along.clamp(0.0, 1.0) * spans as f64;
    let span = (u as usize).min(spans - 1);
    // De Boor's triangle: the values of those that are not zero, degree by degree.
    let mut values = [1.0, 0.0, 0.0, 0.0];
    for degree in 1..=3 {
        let mut carried = 0.0;
        for r in 0..degree {
            let (low, high) = (knot(span + 4 + r - degree), knot(span + 4 + r));
            let part = values[r] / (high - low);
            values[r] = carried + (high - u) * part;
            carried = (u - low) * part;
        }
        values[degree] = carried;
    }
    let some = (0..4).filter(|&r| values[r] != 0.0);
    some.map(|r| Share { unknown: first + span + r, factor: Vec3::splat(values[r]) }).collect()
}

/// The weight of each unknown in a budget for samples: the sum of the shares that the samples of
/// these motions have in it, so that the displacements of the samples add up to no more than the
/// budget. Give the copies of a shared sample once. 1 for an unknown without samples, which does
/// not move.
///
/// # Panics
/// If a motion follows an unknown that is not below `unknowns`.
pub fn counted_shares<'a>(
    motions: impl IntoIterator<Item = &'a Motion>,
    unknowns: usize,
) -> Vec<f64> {
    let mut sums = vec![0.0; unknowns];
    for share in motions.into_iter().flat_map(|motion| &motion.position) {
        sums[share.unknown] += share.factor.abs().max_element();
    }
    sums.into_iter().map(|sum| if sum > 0.0 { sum } else { 1.0 }).collect()
}

/// One share an unknown, in increasing order, without those that cancel.
fn gathered(mut shares: Vec<Share>) -> Vec<Share> {
    shares.sort_by_key(|share| share.unknown);
    let mut sums: Vec<Share> = Vec::with_capacity(shares.len());
    for share in shares {
        match sums.last_mut() {
            Some(last) if last.unknown == share.unknown => last.factor += share.factor,
            _ => sums.push(share),
        }
    }
    sums.retain(|share| share.factor != Vec3::ZERO);
    sums
}

/// The displacement by these shares of the unknowns, mm.
pub(super) fn displacement(shares: &[Share], unknowns: &[Vec3]) -> Vec3 {
    shares.iter().map(|share| unknowns[share.unknown] * share.factor).sum()
}

/// The slip of a sample, mm.
fn slipped(motion: &Motion, unknowns: &[Vec3]) -> f64 {
    motion.slip.iter().map(|slip| slip.way.dot(unknowns[slip.unknown])).sum()
}

/// A tangent that has turned; `None` where it has lost its direction.
fn leaning(start: Vec3, lean: &Lean, unknowns: &[Vec3], slipped: f64) -> Option<Vec3> {
    match displacement(&lean.shares, unknowns) + lean.bend * slipped {
        Vec3::ZERO => Some(start),
        added => unit(start * lean.length_mm + added),
    }
}

/// The samples where the unknowns have moved them; `None` where a tangent has lost its direction.
pub(crate) fn moved(
    samples: &[Sample],
    motions: &[Motion],
    unknowns: &[Vec3],
) -> Option<Vec<Sample>> {
    let moved = |(start, motion): (&Sample, &Motion)| {
        let slipped = slipped(motion, unknowns);
        let tangent_out = leaning(start.tangent_out, &motion.tangent_out, unknowns, slipped)?;
        let tangent_in = if start.is_corner() {
            leaning(start.tangent_in, &motion.tangent_in, unknowns, slipped)?
        } else {
            tangent_out
        };
        let position = match displacement(&motion.position, unknowns) + motion.along * slipped {
            Vec3::ZERO => start.position,
            added => start.position + added,
        };
        Some(Sample { position, tangent_in, tangent_out })
    };
    samples.iter().zip(motions).map(moved).collect()
}

/// The samples where the unknowns have moved them, and how they follow from there; `None` where a
/// tangent has lost its direction.
pub(super) fn moved_on(
    samples: &[Sample],
    motions: &[Motion],
    unknowns: &[Vec3],
) -> Option<(Vec<Sample>, Vec<Motion>)> {
    let now = moved(samples, motions, unknowns)?;
    let from_there = samples.iter().zip(motions).map(|(start, motion)| {
        let slipped = slipped(motion, unknowns);
        let onward = |start: Vec3, lean: &Lean| {
            let added = displacement(&lean.shares, unknowns) + lean.bend * slipped;
            Lean { length_mm: (start * lean.length_mm + added).length(), ..lean.clone() }
        };
        Motion {
            tangent_in: onward(start.tangent_in, &motion.tangent_in),
            tangent_out: onward(start.tangent_out, &motion.tangent_out),
            ..motion.clone()
        }
    });
    Some((now, from_there.collect()))
}

/// Carries slopes with the samples, which started at `start` and are at `now`, back to the
/// unknowns.
pub(super) fn carry(
    start: &[Sample],
    now: &[Sample],
    motions: &[Motion],
    unknowns: &[Vec3],
    slopes: &[SampleSlope],
    with_unknowns: &mut [Vec3],
) {
    let mut add = |shares: &[Share], slope: Vec3| {
        for share in shares {
            with_unknowns[share.unknown] += slope * share.factor;
        }
    };
    let with_raw = |start: Vec3, now: Vec3, lean: &Lean, slipped: f64, slope: Vec3| {
        let added = displacement(&lean.shares, unknowns) + lean.bend * slipped;
        (slope - now * slope.dot(now)) / (start * lean.length_mm + added).length()
    };
    let mut with_slips = vec![0.0; motions.len()];
    for (n, motion) in motions.iter().enumerate() {
        let (start, now, slope) = (&start[n], &now[n], &slopes[n]);
        let slipped = slipped(motion, unknowns);
        add(&motion.position, slope.position);
        let mut with_slip = slope.position.dot(motion.along);
        let (out, arriving) = (&motion.tangent_out, &motion.tangent_in);
        let turns = |lean: &Lean| !lean.shares.is_empty() || !motion.slip.is_empty();
        let with_out = if start.is_corner() {
            if turns(arriving) {
                let (from, to) = (start.tangent_in, now.tangent_in);
                let slope = with_raw(from, to, arriving, slipped, slope.tangent_in);
                add(&arriving.shares, slope);
                with_slip += slope.dot(arriving.bend);
            }
            slope.tangent_out
        } else {
            slope.tangent_in + slope.tangent_out
        };
        if turns(out) {
            let slope = with_raw(start.tangent_out, now.tangent_out, out, slipped, with_out);
            add(&out.shares, slope);
            with_slip += slope.dot(out.bend);
        }
        with_slips[n] = with_slip;
    }
    for (motion, with_slip) in motions.iter().zip(with_slips) {
        for slip in &motion.slip {
            with_unknowns[slip.unknown] += slip.way * with_slip;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_control_points_are_positive_and_add_up_to_one() {
        for controls in [4, 5, 6, 9] {
            for step in 0..=97 {
                let along = f64::from(step) / 97.0;
                let shares = control_shares(along, 10, controls);
                assert!(shares.iter().all(|s| s.factor.min_element() > 0.0));
                assert!(shares.iter().all(|s| (10..10 + controls).contains(&s.unknown)));
                let sum: Vec3 = shares.iter().map(|s| s.factor).sum();
                assert!((sum - Vec3::ONE).length() < 1e-14, "{controls} {along} {sum}");
            }
            let only = |unknown| vec![Share { unknown, factor: Vec3::ONE }];
            assert_eq!(control_shares(0.0, 10, controls), only(10));
            assert_eq!(control_shares(1.0, 10, controls), only(9 + controls));
        }
        // In the middle of a long spline: the uniform cubic B-spline at a knot.
        let middle = control_shares(0.5, 0, 9);
        let expected = [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0];
        assert_eq!(middle.iter().map(|s| s.unknown).collect::<Vec<_>>(), [3, 4, 5]);
        assert!(
            middle.iter().zip(expected).all(|(s, e)| (s.factor - Vec3::splat(e)).length() < 1e-15)
        );
    }
}
