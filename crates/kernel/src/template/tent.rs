//! Tents.

use super::sketch::{Drawn, Sketch};
use super::{Parameter, Template, TemplateError, Values, length};
use sheetwright_geometry::math::{Point3, cos, sin};
use std::f64::consts::PI;

/// A tunnel tent on three hoops.
pub(super) const TENT: Template = Template {
    name: "tent",
    title: "Tunnel tent on three hoops, with flat end walls",
    who: "Tent and awning makers sew it, and growers cover a polytunnel with it (of canvas unless \
          material says otherwise): two bays that bend over elliptic hoops, each in one panel.",
    words: &[
        "tunnel tent",
        "tent panel",
        "awning",
        "canopy",
        "hoop house",
        "polytunnel",
        "covered wagon",
        "shelter",
        "tarp",
    ],
    parameters: &PARAMETERS,
    sheet: Some("canvas"),
    trade: Some("sewing"),
    build: tent,
};

const PARAMETERS: [Parameter; 8] = [
    length("front-width", "width of the front hoop on the ground", 600.0, 6000.0, 1400.0),
    length("front-height", "height of the front hoop", 400.0, 2500.0, 1000.0),
    length("middle-width", "width of the middle hoop on the ground", 600.0, 6000.0, 2200.0),
    length("middle-height", "height of the middle hoop", 400.0, 2500.0, 1200.0),
    length("rear-width", "width of the rear hoop on the ground", 600.0, 6000.0, 1600.0),
    length("rear-height", "height of the rear hoop", 400.0, 2500.0, 900.0),
    length("front-length", "length from the front hoop to the middle one", 200.0, 10_000.0, 1400.0),
    length("rear-length", "length from the middle hoop to the rear one", 200.0, 10_000.0, 1300.0),
];

/// A hoop is at most so many times as high as half of its width, and at least that fraction of it:
/// a pole does not bend further.
const MOST_STRETCHED: f64 = 4.0;
/// Samples along a hoop that is half a circle; a stretched one bends more tightly somewhere.
const SAMPLES: f64 = 150.0;

/// Hoops in parallel planes: straight lines between points of equal directions make a developable
/// surface, for all sizes.
fn tent(values: &Values) -> Drawn {
    let length = |name: &str| values.number(name);
    let middle = length("front-length");
    let hoops = [
        ("front", ["front-width", "front-height"], 0.0),
        ("middle", ["middle-width", "middle-height"], middle),
        ("rear", ["rear-width", "rear-height"], middle + length("rear-length")),
    ];
    let mut sketch = Sketch::default();
    let mut stretched: f64 = 1.0;
    for (hoop, [width, upright], x) in hoops {
        let (half, height) = (length(width) / 2.0, length(upright));
        let ratio = (height / half).max(half / height);
        if ratio > MOST_STRETCHED {
            let (least, most) = (half / MOST_STRETCHED, half * MOST_STRETCHED);
            return Err(TemplateError::together(
                upright,
                format!("a hoop {} mm wide and {height} mm high bends too tightly", 2.0 * half),
                format!("Take from {least:.0} mm to {most:.0} mm, or another width."),
            ));
        }
        stretched = stretched.max(ratio);
        let at = |t: f64| match t {
            // The ends stand on the ground, not a rounding above it.
            0.0 => Point3::new(x, -half, 0.0),
            1.0 => Point3::new(x, half, 0.0),
            t => Point3::new(x, -half * cos(PI * t), height * sin(PI * t)),
        };
        sketch.along(format!("{hoop}-hoop"), PI * ratio, at);
        if hoop != "middle" {
            sketch.polyline(format!("{hoop}-sill"), &[at(1.0), at(0.0)]);
        }
    }
    let samples = (SAMPLES * stretched) as usize;
    sketch.strip("front-bay", ["middle-hoop", "front-hoop"], samples);
    sketch.strip("rear-bay", ["rear-hoop", "middle-hoop"], samples);
    sketch.patch("front-wall", &["front-hoop", "front-sill"], 200);
    sketch.patch("rear-wall", &["-rear-hoop", "-rear-sill"], 200);
    Ok(sketch)
}
