//! Cones, frusta and lampshades.

use super::sketch::{Drawn, Sketch, numbered};
use super::{Template, TemplateError, Values, count, length};
use sheetwright_geometry::math::{Point3, cos, sin};
use std::f64::consts::TAU;

/// A cone or a frustum in one or more pieces.
pub(super) const CONE: Template = Template {
    name: "cone",
    title: "Cone or frustum",
    who: "Sheet-metal shops roll it as a hood, funnel or reducer, and children wear it as a hat.",
    words: &["frustum", "truncated cone", "funnel", "hood", "party hat", "concentric reducer"],
    parameters: &[
        length("bottom", "diameter at the bottom", 10.0, 20_000.0, 300.0),
        length("top", "diameter at the top; 1 mm is as good as a point", 1.0, 20_000.0, 100.0),
        length("height", "height from the bottom to the top, upright", 10.0, 20_000.0, 250.0),
        count("pieces", "pieces that it is divided into, each with a seam", 1, 12, 1),
    ],
    sheet: None,
    trade: None,
    build: |values| {
        let size = |name: &str| values.number(name);
        let (bottom, top) = (size("bottom") / 2.0, size("top") / 2.0);
        frustum("cone", bottom, top, size("height"), values.count("pieces"))
    },
};

/// The ring of a lampshade.
pub(super) const LAMPSHADE: Template = Template {
    name: "lampshade",
    title: "Lampshade",
    who: "Lamp makers cut it from paper, parchment, cloth or thin plastic and glue it to two rings.",
    words: &["lamp shade", "shade", "coolie", "empire shade", "drum shade", "light"],
    parameters: &[
        length("bottom", "diameter of the lower ring", 20.0, 3_000.0, 400.0),
        length("top", "diameter of the upper ring", 20.0, 3_000.0, 250.0),
        length("slant", "height along the side, as the shade is sold", 20.0, 3_000.0, 260.0),
        count("pieces", "pieces that it is divided into, each with a seam", 1, 4, 1),
    ],
    sheet: None,
    trade: Some("card"),
    build: lampshade,
};

fn lampshade(values: &Values) -> Drawn {
    let (bottom, top) = (values.number("bottom") / 2.0, values.number("top") / 2.0);
    let slant = values.number("slant");
    let flare = (bottom - top).abs();
    // A flatter shade is a plate: its height is at least a thousandth of its slant.
    let upright = (slant * slant - flare * flare).sqrt();
    if upright.is_nan() || upright < 1e-3 * slant {
        return Err(TemplateError::together(
            "slant",
            format!("the rings differ by {flare:.1} mm in radius, and the side is {slant} mm"),
            "Make the slant larger than that, or the rings more alike.",
        ));
    }
    frustum("shade", bottom, top, upright, values.count("pieces"))
}

/// Samples of each rail: a ruling every 3° of a whole circle.
const SAMPLES: usize = 121;
/// The frustum about the axis z between two circles, in equal pieces.
fn frustum(panel: &str, bottom: f64, top: f64, height: f64, pieces: usize) -> Drawn {
    let mut sketch = Sketch::default();
    let width = TAU / pieces as f64;
    for piece in 0..pieces {
        let arc = |radius: f64, z: f64| {
            move |t: f64| {
                let angle = width * (piece as f64 + t);
                Point3::new(radius * cos(angle), radius * sin(angle), z)
            }
        };
        let name = numbered(panel, piece, pieces);
        let (base, rim) = (numbered("bottom", piece, pieces), numbered("top", piece, pieces));
        sketch.along(&base, width, arc(bottom, 0.0));
        sketch.along(&rim, width, arc(top, height));
        sketch.strip(name, [&base, &rim], SAMPLES);
    }
    Ok(sketch)
}
