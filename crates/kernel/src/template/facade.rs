//! Curved façades.

use super::sketch::{Drawn, Sketch};
use super::{Parameter, Template, Values, angle, count, length};
use sheetwright_geometry::math::{Point3, cos, from_deg, sin};

/// A strip between two arcs.
pub(super) const FACADE: Template = Template {
    name: "facade",
    title: "Curved façade strip between two arcs, in panels",
    who: "Architects and façade builders clad a curved wall, a parapet or a canopy's edge with it \
          (of 2 mm aluminium unless material says otherwise): single-curved panels between arcs \
          at two heights, divided along their straight lines.",
    words: &[
        "façade",
        "cladding",
        "curved wall",
        "curved panel",
        "curtain wall",
        "parapet",
        "fascia",
        "conical strip",
        "rainscreen",
    ],
    parameters: &PARAMETERS,
    sheet: Some("aluminium-2mm"),
    trade: Some("plate"),
    build: facade,
};

const PARAMETERS: [Parameter; 6] = [
    length("lower-radius", "radius of the lower arc", 300.0, 100_000.0, 6000.0),
    length("upper-radius", "radius of the upper arc", 300.0, 100_000.0, 6800.0),
    length("height", "height of the upper arc above the lower one", 100.0, 20_000.0, 1500.0),
    angle("angle", "how far round both arcs run", 5.0, 350.0, 60.0),
    length(
        "lean",
        "how far the upper arc is moved outwards as a whole",
        -10_000.0,
        10_000.0,
        400.0,
    ),
    count("panels", "panels that the strip is divided into", 1, 60, 6),
];

/// Arcs in parallel planes have equal directions at equal angles. Straight lines between such
/// points make a developable surface (a cone, oblique if it leans), and the joints are among these
/// lines.
fn facade(values: &Values) -> Drawn {
    let (lower, upper) = (values.number("lower-radius"), values.number("upper-radius"));
    let (height, lean) = (values.number("height"), values.number("lean"));
    let (whole, panels) = (values.radians("angle"), values.count("panels"));
    let width = whole / panels as f64;
    let mut sketch = Sketch::default();
    for panel in 0..panels {
        let arc = |radius: f64, out: f64, z: f64| {
            move |t: f64| {
                // Both panels of a joint get exactly one point.
                let turned = (panel as f64 + t) / panels as f64 - 0.5;
                let angle = whole * turned;
                Point3::new(out + radius * cos(angle), radius * sin(angle), z)
            }
        };
        let n = panel + 1;
        let rails = [format!("lower-{n}"), format!("upper-{n}")];
        sketch.along(&rails[0], width, arc(lower, 0.0, 0.0));
        sketch.along(&rails[1], width, arc(upper, lean, height));
        // As many samples as keep the turn between them below that of a whole ring in 400.
        let samples = (width / from_deg(0.9)).ceil().max(40.0) as usize;
        sketch.strip(format!("panel-{n}"), [&rails[0], &rails[1]], samples);
    }
    Ok(sketch)
}
