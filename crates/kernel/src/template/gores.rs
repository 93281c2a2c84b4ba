//! Surfaces of revolution in gores: a profile turned about the axis z and divided into equal
//! pieces from one end to the other.
//!
//! The rails of a gore are two meridians and lie on the surface of revolution. Level rungs between
//! them are parallel, so the gore is a piece of a cylinder: it bends without any force, and its
//! outline has the lengths of the meridians. The bulge between two meridians is lost: a share of
//! 1 − cos(π/n) of the radius at the middle of a gore, and of 1 − sin(π/n)/(π/n) of the girth.

use super::TemplateError;
use super::sketch::{Drawn, Sketch, stations};
use sheetwright_geometry::curve::{Curve, CurveKind, CurvePoint};
use sheetwright_geometry::math::{Point3, cos, sin};
use std::f64::consts::TAU;

/// A point of a profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Station {
    /// Distance from the axis, mm.
    pub(super) r: f64,
    /// Height, mm.
    pub(super) z: f64,
}

/// Samples of each meridian: at least so many, since rungs every hundredth of it look smooth …
const FEWEST_SAMPLES: usize = 101;
/// … and at most so many, since files grow, and more rulings can't be marked by hand.
const MOST_SAMPLES: usize = 401;
/// Largest turn of the meridian from sample to sample, radians (4°), if that needs no more than
/// [`MOST_SAMPLES`].
const TURN: f64 = 0.07;
/// Largest turn of the tangent planes along a rung that is not level, radians (3.8°), if that needs
/// no more than [`MOST_SAMPLES`].
const SLANT_TURN: f64 = 1.0 / 15.0;
/// If that turn is this many times too large even with [`MOST_SAMPLES`], the gores are too slim.
const TOO_SLIM: f64 = 1.4;

/// The points of a profile along `at` from 0 to 1, which turns by `turn` radians in all.
pub(super) fn profile(turn: f64, at: impl Fn(f64) -> Station) -> Vec<Station> {
    stations(turn).into_iter().map(at).collect()
}

/// The names of the parameters of a template in gores.
#[derive(Clone, Copy, Debug)]
pub(super) struct Names {
    /// That of the number of gores.
    pub(super) count: &'static str,
    /// That of the width of the openings at the ends.
    pub(super) opening: &'static str,
}

/// The panels `gore-1` to `gore-n` of the surface that the spline through a profile sweeps.
/// Profiles run upwards.
///
/// # Errors
/// Ends that are neither closed nor open, and gores that run to points too slim to be drawn.
pub(super) fn gores(profile: &[Station], n: usize, names: Names) -> Drawn {
    let largest = profile.iter().map(|s| s.r).fold(0.0, f64::max);
    for end in [profile[0], profile[profile.len() - 1]] {
        if end.r > ON_AXIS * largest && end.r < LEAST_OPENING * largest {
            return Err(TemplateError::together(
                names.opening,
                format!("an end is open by no more than {} mm", 2.0 * end.r),
                "Open it by a hundredth of the largest diameter or more, or close it where it may be closed.",
            ));
        }
    }
    let samples = samples(profile, n).ok_or_else(|| {
        TemplateError::together(
            names.count,
            format!("{n} gores of this shape run to points that are too slim"),
            "Ask for fewer of them, or for openings or caps where they meet.",
        )
    })?;
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
    for k in 0..n {
        // Down on the left and up on the right is counter-clockwise from outside.
        let rails = [(k + 1) % n, k].map(|k| format!("meridian-{}", k + 1));
        sketch.strip(format!("gore-{}", k + 1), [&rails[0], &rails[1]], samples);
    }
    Ok(sketch)
}

/// Points nearer to the axis than this share of the largest radius are on it: rounding.
const ON_AXIS: f64 = 1e-9;
/// Least radius of an open end, as a share of the largest radius: the edge of a gore there is then
/// not much shorter than the distance between two samples.
const LEAST_OPENING: f64 = 0.01;

/// The number of samples, evenly along it, that a profile in n gores needs; `None` if no number
/// suffices.
///
/// Every other rung joins a sample to the next one of the other rail. Where the curvature is κ, the
/// distance from the axis r and that from sample to sample h, the tangent planes at its two ends
/// turn by about κh · h / (2πr/n): by the bend of one step, times how aslant the rung lies. At a
/// point, r counts as h, its value at the first sample after it.
fn samples(profile: &[Station], n: usize) -> Option<usize> {
    let points: Vec<CurvePoint> =
        profile.iter().map(|s| CurvePoint::smooth(Point3::new(s.r, 0.0, s.z))).collect();
    let curve = Curve::new(CurveKind::Spline, &points, false).ok()?;
    let length = curve.length();
    let (mut bend, mut slant) = (0.0_f64, 0.0_f64);
    for half in 0..=2 * curve.spans().len() {
        let u = half as f64 / 2.0;
        let (along, by) = (curve.derivative(u), curve.second_derivative(u));
        let speed = along.length();
        let curvature = along.cross(by).length() / (speed * speed * speed);
        bend = bend.max(length * curvature / TURN);
        // κ n h² / (2π SLANT_TURN) may be max(r, h).
        let per_mm = curvature * n as f64 / (TAU * SLANT_TURN);
        if per_mm > 0.0 {
            let step = (1.0 / per_mm).max((curve.position(u).x.max(0.0) / per_mm).sqrt());
            slant = slant.max(length / step);
        }
    }
    let enough = slant <= TOO_SLIM * MOST_SAMPLES as f64;
    enough.then(|| (bend.max(slant).ceil() as usize).clamp(FEWEST_SAMPLES, MOST_SAMPLES))
}
