//! Small boats of plywood with one chine: dinghy, pram and kayak.

use super::hull_form::{Dimensions, End, LONG_SAMPLES, Style, hull};
use super::sketch::{Drawn, Sketch};
use super::{Choice, Kind, Parameter, Template, Values, angle, length, number};
use sheetwright_geometry::math::{Point3, cos, sin};

/// Which halves of a boat are drawn.
const HALVES: Parameter = Parameter {
    name: "halves",
    meaning: "halves of the boat that are drawn",
    kind: Kind::Choice(&[PORT, BOTH]),
};

pub(super) const PORT: Choice =
    Choice { name: "port", meaning: "the port half, to be cut twice, once turned over" };
pub(super) const BOTH: Choice =
    Choice { name: "both", meaning: "port and starboard, each cut once" };

/// A pointed boat with a transom.
pub(super) const DINGHY: Template = Template {
    name: "dinghy",
    title: "Dinghy with a pointed bow, a chine and a transom",
    who: "Home builders stitch and glue it from plywood (6 mm unless material says otherwise); \
          bottom and side are the port half, to be cut twice, once turned over.",
    words: &[
        "rowing boat",
        "skiff",
        "tender",
        "stitch and glue",
        "plywood boat",
        "boat",
        "hard chine",
        "chine and sheer",
        "boat plans",
        "hull",
    ],
    parameters: &DINGHY_PARAMETERS,
    sheet: Some("plywood-6mm"),
    trade: Some("boat"),
    build: dinghy,
};

const DINGHY_PARAMETERS: [Parameter; 12] = [
    length(
        "length",
        "length from the top of the transom to the top of the stem",
        2000.0,
        6000.0,
        3000.0,
    ),
    length("beam", "width across the sheer at the widest station", 900.0, 2400.0, 1300.0),
    length(
        "depth",
        "height from keel to sheer amidships: draught and freeboard",
        300.0,
        900.0,
        480.0,
    ),
    angle("flare", "how far the sides lean outwards", 0.0, 45.0, 25.0),
    angle("deadrise", "how far the bottom rises from keel to chine, amidships", 0.0, 25.0, 13.0),
    length(
        "bow-sheer",
        "how much higher the sheer is at the bow than amidships",
        -100.0,
        500.0,
        140.0,
    ),
    length("stern-sheer", "how much higher it is at the stern", -100.0, 300.0, -30.0),
    length("bow-rise", "how far the line of the keel rises towards the bow", 20.0, 450.0, 260.0),
    length("stern-rise", "how far it rises towards the stern: rocker", 0.0, 200.0, 50.0),
    number(
        "transom-width",
        "width of the transom at the sheer, as a share of the beam",
        0.3,
        0.85,
        0.77,
    ),
    angle("transom-rake", "how far the transom leans outwards", 0.0, 35.0, 12.0),
    HALVES,
];

fn dinghy(values: &Values) -> Drawn {
    let style =
        Style { widest: 0.42, lowest: 0.45, keel_powers: [3, 2], sweep: 0.6, fullness: 0.0 };
    let transom = transom(values, "transom-width", "transom-rake");
    let drawn = hull(dimensions(values, End::Stem, transom, style))?.sketch;
    Ok(finished(drawn, values, &["bottom", "side"]))
}

/// A boat with two transoms.
pub(super) const PRAM: Template = Template {
    name: "pram",
    title: "Pram: a boat with a transom at the bow too",
    who: "Home builders and sailing schools build it as the shortest boat that carries two, of \
          plywood (6 mm unless material says otherwise); bottom and side are the port half, to \
          be cut twice, once turned over.",
    words: &[
        "pram dinghy",
        "optimist",
        "punt",
        "scow",
        "tender",
        "stitch and glue",
        "plywood boat",
        "boat",
        "hard chine",
        "two transoms",
    ],
    parameters: &PRAM_PARAMETERS,
    sheet: Some("plywood-6mm"),
    trade: Some("boat"),
    build: pram,
};

const PRAM_PARAMETERS: [Parameter; 14] = [
    length(
        "length",
        "length from the top of one transom to the top of the other",
        1500.0,
        5000.0,
        2400.0,
    ),
    length("beam", "width across the sheer at the widest station", 800.0, 2000.0, 1200.0),
    length(
        "depth",
        "height from keel to sheer amidships: draught and freeboard",
        300.0,
        800.0,
        420.0,
    ),
    angle("flare", "how far the sides lean outwards", 0.0, 45.0, 24.0),
    angle("deadrise", "how far the bottom rises from keel to chine, amidships", 0.0, 20.0, 11.0),
    length(
        "bow-sheer",
        "how much higher the sheer is at the bow than amidships",
        -50.0,
        400.0,
        60.0,
    ),
    length("stern-sheer", "how much higher it is at the stern", -50.0, 300.0, 0.0),
    length("bow-rise", "how far the line of the keel rises towards the bow", 20.0, 280.0, 240.0),
    length("stern-rise", "how far it rises towards the stern: rocker", 0.0, 200.0, 70.0),
    number(
        "bow-width",
        "width of the bow transom at the sheer, as a share of the beam",
        0.3,
        0.8,
        0.5,
    ),
    angle("bow-rake", "how far the bow transom leans outwards", 0.0, 50.0, 35.0),
    number("transom-width", "width of the transom at the stern, likewise", 0.4, 0.9, 0.79),
    angle("transom-rake", "how far the transom leans outwards", 0.0, 35.0, 10.0),
    HALVES,
];

fn pram(values: &Values) -> Drawn {
    let style =
        Style { widest: 0.42, lowest: 0.45, keel_powers: [2, 2], sweep: 0.4, fullness: 0.0 };
    let bow = transom(values, "bow-width", "bow-rake");
    let stern = transom(values, "transom-width", "transom-rake");
    let drawn = hull(dimensions(values, bow, stern, style))?.sketch;
    Ok(finished(drawn, values, &["bottom", "side"]))
}

/// A boat that is pointed at both ends, with a deck.
pub(super) const KAYAK: Template = Template {
    name: "kayak",
    title: "Kayak with a chine and a ridged deck",
    who: "Home builders stitch and glue it from plywood (4 mm unless material says otherwise); \
          panels are the port half, to be cut twice, once turned over, and the cockpit is cut \
          out of the deck by its rim.",
    words: &[
        "sea kayak",
        "canoe",
        "double-ender",
        "paddling",
        "stitch and glue",
        "plywood boat",
        "boat",
        "hard chine",
        "chine and sheer",
    ],
    parameters: &KAYAK_PARAMETERS,
    sheet: Some("plywood-4mm"),
    trade: Some("boat"),
    build: kayak,
};

const KAYAK_PARAMETERS: [Parameter; 11] = [
    length("length", "length from stem to stem at the sheer", 3000.0, 6500.0, 4800.0),
    length("beam", "width across the sheer amidships", 450.0, 900.0, 600.0),
    length(
        "depth",
        "height from keel to sheer amidships: draught and freeboard",
        180.0,
        450.0,
        280.0,
    ),
    angle("flare", "how far the sides lean outwards", 0.0, 40.0, 23.0),
    angle("deadrise", "how far the bottom rises from keel to chine", 0.0, 30.0, 18.0),
    length(
        "bow-sheer",
        "how much higher the sheer is at the bow than amidships",
        -50.0,
        300.0,
        90.0,
    ),
    length("stern-sheer", "how much higher it is at the stern", -50.0, 300.0, 60.0),
    length("bow-rise", "how far the line of the keel rises towards the bow", 0.0, 200.0, 90.0),
    length("stern-rise", "how far it rises towards the stern", 0.0, 200.0, 70.0),
    length("deck-rise", "height of the deck's ridge above the sheer amidships", 0.0, 150.0, 50.0),
    HALVES,
];

fn kayak(values: &Values) -> Drawn {
    let style = Style { widest: 0.5, lowest: 0.5, keel_powers: [4, 4], sweep: 0.0, fullness: 0.35 };
    let drawn = hull(dimensions(values, End::Stem, End::Stem, style))?;
    // The deck is a cylinder too: the sheer, carried inwards along a line that rises.
    let slope = values.number("deck-rise") / (values.number("beam") / 2.0);
    let ridge: Vec<Point3> =
        drawn.sheer.iter().map(|p| Point3::new(p.x, 0.0, p.z + slope * p.y)).collect();
    let mut sketch = drawn.sketch;
    sketch.spline("ridge", &ridge);
    sketch.patch("deck", &["ridge", "-sheer"], LONG_SAMPLES);
    Ok(finished(sketch, values, &["bottom", "side", "deck"]))
}

/// The dimensions that all of them take.
fn dimensions(values: &Values, bow: End, stern: End, style: Style) -> Dimensions {
    let depth = values.number("depth");
    Dimensions {
        length: values.number("length"),
        beam: values.number("beam"),
        depth,
        flare: slope(values.radians("flare")),
        deadrise: slope(values.radians("deadrise")),
        bow_height: depth + values.number("bow-sheer"),
        stern_height: depth + values.number("stern-sheer"),
        bow_rise: values.number("bow-rise"),
        stern_rise: values.number("stern-rise"),
        bow,
        stern,
        style,
    }
}

fn transom(values: &Values, width: &str, rake: &str) -> End {
    End::Transom {
        width: values.number(width) * values.number("beam"),
        lean: slope(values.radians(rake)),
    }
}

/// Into so many parts a plan divides the length of a boat by its stations.
const DIVISIONS: usize = 10;

/// The boat with the halves that are wanted, and with its stations, between its ends, marked.
fn finished(mut sketch: Sketch, values: &Values, halves: &[&str]) -> Sketch {
    let length = values.number("length");
    let places: Vec<f64> = (1..DIVISIONS).map(|n| length * n as f64 / DIVISIONS as f64).collect();
    sketch.stations(&places);
    if values.choice(HALVES.name) == BOTH.name {
        sketch.mirror(halves);
    } else {
        sketch.cut_twice(halves);
    }
    sketch
}

/// The tangent of an angle below a right one.
fn slope(angle: f64) -> f64 {
    sin(angle) / cos(angle)
}
