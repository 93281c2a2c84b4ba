//! Surfaces of revolution in gores: a profile turned about the axis z and divided into equal
//! pieces from one end to the other.
//!
//! The rails of a gore are two meridians and lie on the surface of revolution. Level rungs between
//! them are parallel, so the gore is a piece of a cylinder: it bends without any force, and its
//! outline has the lengths of the meridians. What is lost is the bulge between two meridians: a
//! share of 1 − cos(π/n) of the radius at the middle of a gore, and of 1 − sin(π/n)/(π/n) of the
//! girth.

use super::sketch::{Drawn, Sketch, stations};
use crate::curve::{Curve, CurveKind, CurvePoint};
use crate::math::{Point3, cos, sin};
use std::f64::consts::TAU;

/// A point of a profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Station {
    /// Distance from the axis, mm.
    pub(super) r: f64,
    /// Height, mm.
    pub(super) z: f64,
}

/// Samples of each meridian: at least so many, since rungs every hundredth of the way look smooth …
const FEWEST_SAMPLES: usize = 101;
/// … and at the most so many, where the files would grow and hands can't follow.
const MOST_SAMPLES: usize = 401;
/// Between samples the meridian turns by at most this share of the angle between the rails, where so
/// many are enough for it. Rungs that are not level join a sample to the next one on the other rail;
/// at the point of a slim gore they run almost along it, and their tangent planes say little unless
/// the meridian turns little beside the width of the gore.
const TURN_SHARE: f64 = 1.0 / 15.0;

/// The points of a profile along `at` from 0 to 1, which turns by `turn` radians in all.
pub(super) fn profile(turn: f64, at: impl Fn(f64) -> Station) -> Vec<Station> {
    stations(turn).into_iter().map(at).collect()
}

/// The panels `gore-1` to `gore-n` of the surface that the spline through a profile sweeps.
pub(super) fn gores(profile: &[Station], n: usize) -> Drawn {
    let largest = profile.iter().map(|s| s.r).fold(0.0, f64::max);
    let mut sketch = Sketch::default();
    for k in 0..n {
        let angle = TAU * k as f64 / n as f64;
        let (x, y) = (cos(angle), sin(angle));
        let point = |station: &Station| {
            let r = if station.r < ON_AXIS * largest { 0.0 } else { station.r };
            Point3::new(r * x, r * y, station.z)
        };
        let points: Vec<Point3> = profile.iter().map(point).collect();
        sketch.spline(format!("meridian-{}", k + 1), &points);
    }
    let samples = samples(profile, TAU / n as f64);
    for k in 0..n {
        // Profiles run upwards: down on the left and up on the right is counter-clockwise from outside.
        let rails = [(k + 1) % n, k].map(|k| format!("meridian-{}", k + 1));
        sketch.strip(format!("gore-{}", k + 1), [&rails[0], &rails[1]], samples);
    }
    Ok(sketch)
}

/// What is nearer to the axis, as a share of the largest radius, is on it: rounding is.
const ON_AXIS: f64 = 1e-9;

/// How many samples, evenly along it, show the tightest bend of a profile in gores of this width,
/// radians.
fn samples(profile: &[Station], width: f64) -> usize {
    let points: Vec<CurvePoint> =
        profile.iter().map(|s| CurvePoint::smooth(Point3::new(s.r, 0.0, s.z))).collect();
    let Ok(curve) = Curve::new(CurveKind::Spline, &points, false) else { return FEWEST_SAMPLES };
    let spans = curve.spans().len();
    // Curvature |c' × c''| / |c'|³, at both ends of spans and in their middles.
    let tightest = (0..=2 * spans)
        .map(|n| {
            let u = n as f64 / 2.0;
            let (along, bend) = (curve.derivative(u), curve.second_derivative(u));
            let speed = along.length();
            along.cross(bend).length() / (speed * speed * speed)
        })
        .fold(0.0, f64::max);
    let wanted = curve.length() * tightest / (TURN_SHARE * width);
    (wanted.ceil() as usize).clamp(FEWEST_SAMPLES, MOST_SAMPLES)
}
