//! Ducts that change their shape: square to round, round to round.
//!
//! Each is rolled from one sheet with one seam, or from two with two, between a lower and an upper
//! rail. Both rails are run from the side +x round by +y.

use super::sketch::{Drawn, Sketch, numbered};
use super::{Template, TemplateError, Values, angle, count, length};
use sheetwright_geometry::math::{Point3, cos, sin};
use std::f64::consts::{PI, TAU};

/// A rectangle below and a circle above.
pub(super) const SQUARE_TO_ROUND: Template = Template {
    name: "square-to-round",
    title: "Square-to-round duct",
    who: "Duct shops join a rectangular opening to a round pipe, straight, offset or tilted.",
    words: &[
        "transition",
        "square to round",
        "rectangle to round",
        "tallboy",
        "hood",
        "reducer",
        "offset",
        "HVAC",
    ],
    parameters: &[
        length("width", "width of the rectangle, along x", 20.0, 10_000.0, 400.0),
        length("depth", "depth of the rectangle, along y", 20.0, 10_000.0, 400.0),
        length("diameter", "diameter of the round end", 20.0, 10_000.0, 300.0),
        length(
            "height",
            "height from the rectangle to the middle of the round end",
            20.0,
            10_000.0,
            350.0,
        ),
        length("offset-x", "offset of the round end along x", -5_000.0, 5_000.0, 0.0),
        length("offset-y", "offset of the round end along y", -5_000.0, 5_000.0, 0.0),
        angle("tilt", "tilt of the round end towards x", -60.0, 60.0, 0.0),
        count("pieces", "1: one seam, in the middle of a side; 2: two halves", 1, 2, 1),
    ],
    sheet: None,
    trade: Some("duct"),
    build: square_to_round,
};

/// Samples of each rail: with a quarter of the round end between two corners, one lies where a flat
/// side meets it.
const SAMPLES: usize = 241;

/// Least distance from the rectangle, as a share of its half width, at which the plane of a tilted
/// round end meets that of the rectangle. Nearer to a side, the sheet between that side and the
/// next is folded rather than bent.
const CLEAR_SHARE: f64 = 0.2;

fn square_to_round(values: &Values) -> Drawn {
    let (x, y) = (values.number("width") / 2.0, values.number("depth") / 2.0);
    let (radius, height) = (values.number("diameter") / 2.0, values.number("height"));
    let tilt = values.radians("tilt");
    let middle = Point3::new(values.number("offset-x"), values.number("offset-y"), height);
    // The heights of the plane of the round end above the far edge of the rectangle, and of the
    // round end itself above the plane of the rectangle.
    let slope = sin(tilt).abs() / cos(tilt);
    let towards = middle.x * tilt.signum();
    let over = height + slope * (towards - (1.0 + CLEAR_SHARE) * x);
    if over < 0.0 || radius * sin(tilt).abs() >= height {
        let message = "the round end is tilted into the rectangle";
        let hint = "Tilt it less, or make the height larger.";
        return Err(TemplateError::together("tilt", message, hint));
    }
    // Tilted towards +x, the side of +x goes down.
    let circle = |angle: f64| {
        let (across, along) = (radius * cos(angle), radius * sin(angle));
        let p = Point3::new(across * cos(tilt), along, -across * sin(tilt));
        middle + p.to_vec()
    };
    let corner = |x: f64, y: f64| Point3::new(x, y, 0.0);
    let mut sketch = Sketch::default();
    let pieces = values.count("pieces");
    for piece in 0..pieces {
        let half = piece as f64;
        let square = match (pieces, piece) {
            (1, _) => vec![
                corner(x, 0.0),
                corner(x, y),
                corner(-x, y),
                corner(-x, -y),
                corner(x, -y),
                corner(x, 0.0),
            ],
            (_, 0) => vec![corner(x, 0.0), corner(x, y), corner(-x, y), corner(-x, 0.0)],
            _ => vec![corner(-x, 0.0), corner(-x, -y), corner(x, -y), corner(x, 0.0)],
        };
        let (low, high) = (numbered("square", piece, pieces), numbered("round", piece, pieces));
        let turn = TAU / pieces as f64;
        sketch.polyline(&low, &square);
        sketch.along(&high, turn, |t| circle(PI * half + turn * t));
        sketch.strip(numbered("duct", piece, pieces), [&low, &high], SAMPLES / pieces + pieces - 1);
    }
    Ok(sketch)
}

/// Two circles in parallel planes.
pub(super) const REDUCER: Template = Template {
    name: "reducer",
    title: "Oblique cone reducer",
    who: "Duct and pipe shops join two round pipes whose middles are out of line.",
    words: &[
        "oblique cone",
        "eccentric reducer",
        "offset reducer",
        "taper",
        "scalene cone",
        "HVAC",
    ],
    parameters: &[
        length("bottom", "diameter at the bottom", 20.0, 10_000.0, 400.0),
        length("top", "diameter at the top", 20.0, 10_000.0, 250.0),
        length("height", "height from the bottom to the top", 20.0, 10_000.0, 350.0),
        length(
            "offset",
            "offset of the top; half the difference of the diameters makes one side upright",
            -5_000.0,
            5_000.0,
            75.0,
        ),
        count("pieces", "1: one seam, on the shortest side; 2: two halves", 1, 2, 1),
    ],
    sheet: None,
    trade: Some("duct"),
    build: reducer,
};

fn reducer(values: &Values) -> Drawn {
    let (bottom, top) = (values.number("bottom") / 2.0, values.number("top") / 2.0);
    let (height, offset) = (values.number("height"), values.number("offset"));
    let lean = |side: f64| (offset + side * (top - bottom)).abs();
    let start = if lean(1.0) <= lean(-1.0) { 0.0 } else { PI };
    let circle = |radius: f64, x: f64, z: f64, angle: f64| {
        Point3::new(x + radius * cos(angle), radius * sin(angle), z)
    };
    let mut sketch = Sketch::default();
    let pieces = values.count("pieces");
    for piece in 0..pieces {
        let turn = TAU / pieces as f64;
        let angle = |t: f64| start + turn * (piece as f64 + t);
        let (low, high) = (numbered("bottom", piece, pieces), numbered("top", piece, pieces));
        sketch.along(&low, turn, |t| circle(bottom, 0.0, 0.0, angle(t)));
        sketch.along(&high, turn, |t| circle(top, offset, height, angle(t)));
        sketch.strip(
            numbered("reducer", piece, pieces),
            [&low, &high],
            SAMPLES / pieces + pieces - 1,
        );
    }
    Ok(sketch)
}
