//! Ramps to skate on.

use super::sketch::{Drawn, Sketch};
use super::{Parameter, Template, TemplateError, Values, length};
use sheetwright_geometry::math::{Point3, atan2, cos, sin};

/// A quarter pipe.
pub(super) const RAMP: Template = Template {
    name: "ramp",
    title: "Skateboard ramp: a quarter pipe's surface, side and deck",
    who: "Skaters, BMX riders and skate-park builders bend the surface from plywood (9 mm unless \
          material says otherwise) over ribs cut like the side.",
    words: &[
        "quarter pipe",
        "quarterpipe",
        "half pipe",
        "skateboard ramp",
        "skate ramp",
        "mini ramp",
        "BMX ramp",
        "transition",
        "launch ramp",
    ],
    parameters: &PARAMETERS,
    sheet: Some("plywood-9mm"),
    trade: None,
    build: ramp,
};

const PARAMETERS: [Parameter; 4] = [
    length("radius", "radius of the transition", 1200.0, 5000.0, 2000.0),
    length("height", "height of the deck above the ground", 200.0, 3600.0, 1200.0),
    length("width", "width of the ramp", 400.0, 6000.0, 1220.0),
    length("deck", "length of the deck, from the edge to the back", 100.0, 3000.0, 400.0),
];

/// The surface is an arc from the ground up, carried across the ramp. The side has the same arc.
fn ramp(values: &Values) -> Drawn {
    let (radius, height) = (values.number("radius"), values.number("height"));
    let (width, deck) = (values.number("width"), values.number("deck"));
    if height > radius {
        return Err(TemplateError::together(
            "height",
            format!("the transition is upright at {radius} mm and rises no higher"),
            format!("Take {radius} mm or less, or a larger radius."),
        ));
    }
    let run = (height * (2.0 * radius - height)).sqrt();
    let turn = atan2(run, radius - height);
    let arc = |y: f64| {
        move |t: f64| match t {
            // The foot lies on the ground and the top in the deck, to the last digit.
            0.0 => Point3::new(0.0, y, 0.0),
            1.0 => Point3::new(run, y, height),
            t => Point3::new(radius * sin(turn * t), y, radius * (1.0 - cos(turn * t))),
        }
    };
    let mut sketch = Sketch::default();
    for (side, y) in [("right", 0.0), ("left", width)] {
        sketch.along(format!("{side}-curve"), turn, arc(y));
        let edge = [Point3::new(run, y, height), Point3::new(run + deck, y, height)];
        sketch.polyline(format!("{side}-deck"), &edge);
    }
    sketch.polyline(
        "right-back",
        &[
            Point3::new(run + deck, 0.0, height),
            Point3::new(run + deck, 0.0, 0.0),
            Point3::new(0.0, 0.0, 0.0),
        ],
    );
    sketch.strip("surface", ["right-curve", "left-curve"], 200);
    sketch.patch("side", &["-right-back", "-right-deck", "-right-curve"], 200);
    sketch.strip("deck", ["right-deck", "left-deck"], 20);
    Ok(sketch)
}
