//! Hoppers: a rectangle above and a smaller one below.

use super::sketch::{Drawn, Sketch};
use super::{Choice, Kind, Parameter, Template, Values, length};
use sheetwright_geometry::math::Point3;

/// A funnel with four flat sides.
pub(super) const HOPPER: Template = Template {
    name: "hopper",
    title: "Hopper",
    who: "Farm, mill and workshop builders weld it from plates, or fold it from one sheet.",
    words: &["funnel", "square funnel", "chute", "bin", "rectangular reducer", "pyramid", "silo"],
    parameters: &[
        length("width", "width of the upper opening, along x", 20.0, 20_000.0, 800.0),
        length("depth", "depth of the upper opening, along y", 20.0, 20_000.0, 600.0),
        length("outlet-width", "width of the outlet, along x", 10.0, 20_000.0, 200.0),
        length("outlet-depth", "depth of the outlet, along y", 10.0, 20_000.0, 200.0),
        length("height", "height between the two", 10.0, 20_000.0, 500.0),
        length("offset-x", "offset of the outlet along x", -10_000.0, 10_000.0, 0.0),
        length("offset-y", "offset of the outlet along y", -10_000.0, 10_000.0, 0.0),
        Parameter { name: "pieces", meaning: "how it is made", kind: Kind::Choice(&PIECES) },
    ],
    sheet: None,
    trade: Some("duct"),
    build: hopper,
};

const PIECES: [Choice; 2] = [
    Choice { name: "plates", meaning: "four flat plates" },
    Choice {
        name: "folded",
        meaning: "one piece with four folds and a seam in the middle of a side",
    },
];

/// Samples of each rail of the folded one: they divide every side evenly.
const SAMPLES: usize = 41;

fn hopper(values: &Values) -> Drawn {
    let half = |name: &str| values.number(name) / 2.0;
    let (x, y) = (values.number("offset-x"), values.number("offset-y"));
    let top =
        |u: f64, v: f64| Point3::new(u * half("width"), v * half("depth"), values.number("height"));
    let outlet = |u: f64, v: f64| {
        Point3::new(x + u * half("outlet-width"), y + v * half("outlet-depth"), 0.0)
    };
    let mut sketch = Sketch::default();
    let corners = [[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]];
    if values.choice("pieces") == "folded" {
        let round = [[1.0, 0.0], corners[1], corners[2], corners[3], corners[0], [1.0, 0.0]];
        sketch.polyline("outlet", &round.map(|[u, v]| outlet(u, v)));
        sketch.polyline("top", &round.map(|[u, v]| top(u, v)));
        sketch.strip("hopper", ["outlet", "top"], SAMPLES);
        return Ok(sketch);
    }
    for (n, name) in ["right", "back", "left", "front"].into_iter().enumerate() {
        let ends = [corners[n], corners[(n + 1) % 4]];
        sketch.polyline(format!("{name}-outlet"), &ends.map(|[u, v]| outlet(u, v)));
        sketch.polyline(format!("{name}-top"), &ends.map(|[u, v]| top(u, v)));
        // A plate needs its four corners and no more.
        sketch.strip(name, [&format!("{name}-outlet"), &format!("{name}-top")], 2);
    }
    Ok(sketch)
}
