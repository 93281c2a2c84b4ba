//! Points of a spline that stand out of their line: slips of a table of offsets.
//!
//! Where a line is fair, each of its points lies near the cubic through the two before it and the
//! two after it, over the distance along the points. A point that is off by d misses its own cubic
//! by d, and those of its neighbours by about two thirds of d the other way, since it carries them.
//! So a point is a slip if putting it on its cubic brings the misses of all others far below its
//! own. A tight bend does not do that: neighbours there miss their cubics to one side, and moving
//! one of them makes the others worse.

use super::{Finding, FindingKind, Place};
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::math::{Point3, Vec3};

/// The fewest points of a line on which one can stand out, and the most of one that was typed.
const FEWEST: usize = 6;
const MOST: usize = 200;
/// A slip misses its cubic by at least so many times what any other point does once it is mended.
const STANDS_OUT: f64 = 5.0;
/// The least slip, as a share of the distance to the neighbours: 3 mm at stations 600 mm apart,
/// more than rounding to an eighth of an inch leaves.
const LEAST: f64 = 0.005;
/// A point beside an end is a slip if the points beyond it miss it by at least this share of what
/// its cubic does; else it is the end that turns away from the line.
const BESIDE_END: f64 = 0.5;

/// The finding that one point of an open spline stands out of its line; `None` where none does, or
/// where the line has corners or too few points to tell. `points` are those of the curve of this
/// name.
pub(crate) fn unfair_line(name: &str, points: &[CurvePoint]) -> Option<Finding> {
    let m = points.len();
    if !(FEWEST..=MOST).contains(&m) || points[1..m - 1].iter().any(|point| point.corner) {
        return None;
    }
    let line: Vec<Point3> = points.iter().map(|point| point.at).collect();
    let candidates = misses(&line).into_iter().enumerate().map(|(n, miss)| (n + 1, miss));
    let slips = candidates.filter_map(|(n, miss)| Some((n, miss, stands_out(&line, n, miss)?)));
    let (slip, miss, _) = slips.max_by(|a, b| a.2.total_cmp(&b.2))?;
    let (at, fair) = (line[slip], line[slip] + miss * -1.0);
    let kind = FindingKind::UnfairLine { curve: name.to_owned(), at, fair };
    let place = Place::CurvePoints { curve: name.to_owned(), numbers: vec![slip] };
    Some(Finding::new(kind, place))
}

/// How many times what any other point misses once a point is mended that point misses itself;
/// `None` if it is no slip.
fn stands_out(line: &[Point3], n: usize, miss: Vec3) -> Option<f64> {
    let near = line[n].distance(line[n - 1]).min(line[n].distance(line[n + 1]));
    let off_mm = miss.length();
    if !off_mm.is_finite() || off_mm < LEAST * near || !is_off_both_ways(line, n, miss) {
        return None;
    }
    let mut mended = line.to_vec();
    mended[n] = line[n] + miss * -1.0;
    let others: Vec<f64> = misses(&mended).into_iter().map(Vec3::length).collect();
    // Nothing is known of a line on which two points are one.
    if !others.iter().all(|miss| miss.is_finite()) {
        return None;
    }
    let others = others.into_iter().fold(0.0, f64::max);
    // A perfect line leaves rounding alone.
    let times = off_mm / others.max(LEAST * LEAST * near);
    (times >= STANDS_OUT).then_some(times)
}

/// How far each inner point misses the cubic through the four points around it, by the distance
/// along the points.
fn misses(line: &[Point3]) -> Vec<Vec3> {
    let along = along(line);
    let last = line.len() - 1;
    let miss = |n: usize| {
        let first = n.saturating_sub(2).min(last - 4);
        let around: Vec<usize> = (first..=first + 4).filter(|&k| k != n).collect();
        line[n] - interpolated(line, &along, &around, along[n])
    };
    (1..last).map(miss).collect()
}

/// Whether a point beside an end is off the parabola through the three points on its other side,
/// too, to the same side; others are.
fn is_off_both_ways(line: &[Point3], n: usize, miss: Vec3) -> bool {
    let last = line.len() - 1;
    let beyond = match n {
        1 => [2, 3, 4],
        n if n == last - 1 => [last - 2, last - 3, last - 4],
        _ => return true,
    };
    let along = along(line);
    let off = line[n] - interpolated(line, &along, &beyond, along[n]);
    off.dot(miss) >= BESIDE_END * miss.dot(miss)
}

/// The distance of each point from the first, along the points, mm.
fn along(line: &[Point3]) -> Vec<f64> {
    let steps = line.windows(2).map(|pair| pair[0].distance(pair[1]));
    let mut along = vec![0.0];
    for step in steps {
        along.push(along[along.len() - 1] + step);
    }
    along
}

/// The polynomial through some points (Lagrange), at a distance along the line.
fn interpolated(line: &[Point3], along: &[f64], through: &[usize], at: f64) -> Point3 {
    let mut sum = Vec3::ZERO;
    for &k in through {
        let others = through.iter().filter(|&&other| other != k);
        let weight = others
            .fold(1.0, |weight, &other| weight * (at - along[other]) / (along[k] - along[other]));
        sum += line[k].to_vec() * weight;
    }
    Point3::from_vec(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sheer: a parabola in profile, another in plan, at stations that lie nearer at the ends.
    fn sheer() -> Vec<CurvePoint> {
        let places = [0.0, 200.0, 500.0, 900.0, 1400.0, 1900.0, 2400.0, 2900.0, 3300.0, 3600.0];
        let at = |x: f64| {
            let t = (x - 1600.0) / 1600.0;
            let rise = if x > 1600.0 { 0.3 * t * t * t } else { 0.0 };
            Point3::new(x, 680.0 * (1.0 - 0.4 * t * t), 490.0 + 60.0 * (t * t + rise))
        };
        places.into_iter().map(|x| CurvePoint::smooth(at(x))).collect()
    }

    #[test]
    fn a_fair_line_has_no_slip() {
        assert_eq!(unfair_line("sheer", &sheer()), None);
        // Rounded to an eighth of an inch, as a table has it.
        let mut rounded = sheer();
        for point in &mut rounded {
            point.at.z = (point.at.z / 3.175).round() * 3.175;
            point.at.y = (point.at.y / 3.175).round() * 3.175;
        }
        assert_eq!(unfair_line("sheer", &rounded), None);
        // A keel that turns up into the stem at its end.
        let keel = [0.0, 0.0, 0.0, 1.0, 6.0, 20.0, 55.0, 160.0, 420.0];
        let keel: Vec<CurvePoint> = keel
            .iter()
            .enumerate()
            .map(|(n, &z)| CurvePoint::smooth(Point3::new(400.0 * n as f64, 0.0, z)))
            .collect();
        assert_eq!(unfair_line("keel", &keel), None);
    }

    #[test]
    fn a_slip_is_found_wherever_it_is_and_whichever_way() {
        let line = sheer();
        for slip in 1..line.len() - 1 {
            for off_mm in [40.0, -40.0, 12.0] {
                let mut wrong = line.clone();
                wrong[slip].at.z += off_mm;
                let Some(Finding { kind: FindingKind::UnfairLine { at, fair, .. }, place }) =
                    unfair_line("sheer", &wrong)
                else {
                    panic!("{slip} {off_mm}")
                };
                let numbers = vec![slip];
                assert_eq!(place, Place::CurvePoints { curve: "sheer".to_owned(), numbers });
                assert_eq!(at, wrong[slip].at);
                let off = fair.distance(line[slip].at);
                assert!(off < 0.1 * off_mm.abs() + 1.5, "{slip} {off_mm}: {off}");
            }
        }
    }

    #[test]
    fn what_has_corners_or_few_points_is_left_alone() {
        let mut line = sheer();
        line[4].at.z += 40.0;
        assert!(unfair_line("sheer", &line).is_some());
        line[6].corner = true;
        assert_eq!(unfair_line("sheer", &line), None);
        assert_eq!(unfair_line("sheer", &sheer()[..5]), None);
    }
}
