//! The pieces of a gored hemisphere.

use crate::trace::{Trace, samples_along};
use sheetwright::boundary::Boundary;
use sheetwright::math::{Point3, cos, sin};
use std::f64::consts::{FRAC_PI_2, TAU};

/// The boundary of one piece of a hemisphere of this radius, mm: one of `gores` gores, in the band
/// `band` of `bands` of equal latitude counted from the equator. Its sides are meridians and
/// circles of latitude; the piece at the pole has three.
pub fn piece(radius: f64, gores: usize, bands: usize, band: usize, m: usize) -> Boundary {
    let width = TAU / gores as f64;
    let (low, high) =
        (FRAC_PI_2 * band as f64 / bands as f64, FRAC_PI_2 * (band + 1) as f64 / bands as f64);
    let at = move |longitude: f64, latitude: f64| {
        let r = radius * cos(latitude);
        Point3::new(r * cos(longitude), r * sin(longitude), radius * sin(latitude))
    };
    let polar = band + 1 == bands;
    let sides: f64 = if polar { 3.0 } else { 4.0 };
    let point = move |t: f64| {
        let t = t.rem_euclid(1.0) * sides;
        let side = t.floor().min(sides - 1.0);
        let share = t - side;
        match (side as usize, polar) {
            (0, _) => at(width * share, low),
            (1, _) => at(width, low + (high - low) * share),
            (2, false) => at(width * (1.0 - share), high),
            _ => at(0.0, high - (high - low) * share),
        }
    };
    let corners = (0..sides as usize).map(|n| n as f64 / sides).collect();
    let samples = samples_along(&Trace { point: &point, corners }, m);
    Boundary::new(vec![samples.into_iter().map(|(_, s)| s).collect()])
        .expect("a piece of a hemisphere is a boundary")
}
