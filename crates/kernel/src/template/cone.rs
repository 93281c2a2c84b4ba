//! Cones, frusta and what is made from them.

use super::sketch::{Drawn, Sketch};
use super::{Parameter, Template, Values, count, length};
use crate::math::{Point3, cos, sin};
use std::f64::consts::TAU;

/// A cone or a frustum in one or more pieces.
pub(super) const CONE: Template = Template {
    name: "cone",
    title: "Cone or frustum",
    who: "Sheet-metal shops roll it as a hood, funnel or reducer, and children wear it as a hat.",
    words: &[
        "cone",
        "frustum",
        "truncated cone",
        "funnel",
        "hood",
        "party hat",
        "concentric reducer",
    ],
    parameters: &CONE_PARAMETERS,
    build: cone,
};

const CONE_PARAMETERS: [Parameter; 4] = [
    length("bottom", "diameter at the bottom", 10.0, 20_000.0, 300.0),
    length("top", "diameter at the top, 0 for a point", 0.0, 20_000.0, 100.0),
    length("height", "height from the bottom to the top, upright", 10.0, 20_000.0, 250.0),
    count("pieces", "pieces that it is divided into, each with a seam", 1, 12, 1),
];

fn cone(values: &Values) -> Drawn {
    let size = |name: &str| values.number(name);
    frustum(size("bottom") / 2.0, size("top") / 2.0, size("height"), values.count("pieces"))
}

/// Smallest radius that is drawn as a circle, mm; what is smaller is a point.
const POINT_MM: f64 = 0.05;

/// The frustum about the axis z between two circles, in equal pieces.
fn frustum(bottom: f64, top: f64, height: f64, pieces: usize) -> Drawn {
    let mut sketch = Sketch::default();
    let width = TAU / pieces as f64;
    let on =
        |radius: f64, z: f64, angle: f64| Point3::new(radius * cos(angle), radius * sin(angle), z);
    for n in 1..=pieces {
        let arc = |radius: f64, z: f64| move |t: f64| on(radius, z, width * ((n - 1) as f64 + t));
        let name = if pieces == 1 { "cone".to_owned() } else { format!("cone-{n}") };
        let (base, rim) = (format!("bottom-{n}"), format!("top-{n}"));
        sketch.along(&base, width, arc(bottom, 0.0));
        if top > POINT_MM {
            sketch.along(&rim, width, arc(top, height));
            sketch.strip(name, [&base, &rim], STRIP_SAMPLES);
        } else {
            let apex = Point3::new(0.0, 0.0, height);
            let side = |n: usize| format!("side-{n}");
            sketch.polyline(side(n), &[arc(bottom, 0.0)(0.0), apex]);
            let next = side(n % pieces + 1);
            sketch.patch(name, &[&base, &next, &format!("-{}", side(n))], 2 * STRIP_SAMPLES);
        }
    }
    Ok(sketch)
}

/// Samples of each rail.
const STRIP_SAMPLES: usize = 120;
