//! Small boats of plywood with one chine: dinghy, pram and kayak.

use super::hull_form::{Dimensions, End, LONG_SAMPLES, Style, hull};
use super::sketch::Drawn;
use super::{Parameter, Template, Values, angle, length};
use crate::math::Point3;

/// A pointed boat with a transom.
pub(super) const DINGHY: Template = Template {
    name: "dinghy",
    title: "Dinghy with a pointed bow, a chine and a transom",
    who: "Home builders stitch and glue it from plywood (6 mm unless material says otherwise); \
          bottom and side are one half, to be cut twice, once turned over.",
    words: &[
        "dinghy",
        "rowing boat",
        "skiff",
        "tender",
        "stitch and glue",
        "plywood boat",
        "hard chine",
        "chine and sheer",
        "boat plans",
        "hull",
    ],
    parameters: &DINGHY_PARAMETERS,
    build: dinghy,
};

const DINGHY_PARAMETERS: [Parameter; 11] = [
    length("length", "from the top of the transom to the top of the stem", 2000.0, 6000.0, 3000.0),
    length("beam", "across the sheer at the widest station", 900.0, 2400.0, 1300.0),
    length("chine-beam", "across the chines there", 500.0, 2200.0, 950.0),
    length("depth", "from keel to sheer there: draught and freeboard", 300.0, 900.0, 480.0),
    length("chine-height", "of the chine above the keel there", 20.0, 300.0, 110.0),
    length("bow-height", "of the sheer at the bow above the keel's lowest", 400.0, 1200.0, 620.0),
    length("stern-height", "of the sheer at the stern above the same", 300.0, 1000.0, 450.0),
    length("bow-rise", "of the line of the keel towards the bow", 50.0, 450.0, 260.0),
    length("stern-rise", "of the line of the keel towards the stern", 0.0, 200.0, 50.0),
    length("transom-width", "of the transom at the sheer", 500.0, 2200.0, 1000.0),
    angle("transom-rake", "of the transom from upright", 0.0, 35.0, 12.0),
];

fn dinghy(values: &Values) -> Drawn {
    let style = Style {
        widest: 0.42,
        lowest: 0.45,
        keel_powers: [3, 2],
        sweep: 0.6,
        fullness: 0.0,
    };
    let transom = transom(values, "transom-width", "transom-rake");
    let mut drawn = hull(dimensions(values, End::Stem, transom, style))?.sketch;
    drawn.sheet("plywood-6mm");
    Ok(drawn)
}

/// A boat with two transoms.
pub(super) const PRAM: Template = Template {
    name: "pram",
    title: "Pram: a boat with a transom at the bow too",
    who: "Home builders and sailing schools build it as the shortest boat that carries two, of \
          plywood (6 mm unless material says otherwise); bottom and side are one half, to be cut \
          twice, once turned over.",
    words: &[
        "pram",
        "pram dinghy",
        "optimist",
        "punt",
        "scow",
        "tender",
        "stitch and glue",
        "plywood boat",
        "hard chine",
        "two transoms",
    ],
    parameters: &PRAM_PARAMETERS,
    build: pram,
};

const PRAM_PARAMETERS: [Parameter; 13] = [
    length("length", "from the top of one transom to the other", 1500.0, 5000.0, 2400.0),
    length("beam", "across the sheer at the widest station", 800.0, 2000.0, 1200.0),
    length("chine-beam", "across the chines there", 500.0, 1800.0, 900.0),
    length("depth", "from keel to sheer there: draught and freeboard", 250.0, 800.0, 420.0),
    length("chine-height", "of the chine above the keel there", 20.0, 250.0, 90.0),
    length("bow-height", "of the sheer at the bow above the keel's lowest", 350.0, 1000.0, 480.0),
    length("stern-height", "of the sheer at the stern above the same", 300.0, 900.0, 420.0),
    length("bow-rise", "of the line of the keel towards the bow", 50.0, 350.0, 260.0),
    length("stern-rise", "of the line of the keel towards the stern", 0.0, 200.0, 70.0),
    length("bow-width", "of the bow transom at the sheer", 400.0, 1500.0, 600.0),
    angle("bow-rake", "of the bow transom from upright", 0.0, 50.0, 35.0),
    length("transom-width", "of the transom at the sheer", 500.0, 1800.0, 950.0),
    angle("transom-rake", "of the transom from upright", 0.0, 35.0, 10.0),
];

fn pram(values: &Values) -> Drawn {
    let style = Style {
        widest: 0.42,
        lowest: 0.45,
        keel_powers: [2, 2],
        sweep: 0.4,
        fullness: 0.0,
    };
    let bow = transom(values, "bow-width", "bow-rake");
    let stern = transom(values, "transom-width", "transom-rake");
    let mut drawn = hull(dimensions(values, bow, stern, style))?.sketch;
    drawn.sheet("plywood-6mm");
    Ok(drawn)
}

/// A boat that is pointed at both ends, with a deck.
pub(super) const KAYAK: Template = Template {
    name: "kayak",
    title: "Kayak with a chine and a ridged deck",
    who: "Home builders stitch and glue it from plywood (4 mm unless material says otherwise); \
          every panel is one half, to be cut twice, once turned over, and the cockpit is cut out \
          of the deck by its rim.",
    words: &[
        "kayak",
        "sea kayak",
        "canoe",
        "double-ender",
        "paddling",
        "stitch and glue",
        "plywood boat",
        "hard chine",
        "chine and sheer",
    ],
    parameters: &KAYAK_PARAMETERS,
    build: kayak,
};

const KAYAK_PARAMETERS: [Parameter; 10] = [
    length("length", "from stem to stem at the sheer", 3000.0, 6500.0, 4800.0),
    length("beam", "across the sheer amidships", 450.0, 900.0, 600.0),
    length("chine-beam", "across the chines there", 250.0, 800.0, 420.0),
    length("depth", "from keel to sheer there: draught and freeboard", 180.0, 450.0, 280.0),
    length("chine-height", "of the chine above the keel there", 10.0, 150.0, 70.0),
    length("bow-height", "of the sheer at the bow above the keel's lowest", 250.0, 600.0, 370.0),
    length("stern-height", "of the sheer at the stern above the same", 250.0, 600.0, 340.0),
    length("bow-rise", "of the line of the keel towards the bow", 0.0, 200.0, 90.0),
    length("stern-rise", "of the line of the keel towards the stern", 0.0, 200.0, 70.0),
    length("deck-rise", "of the deck's ridge above the sheer amidships", 0.0, 150.0, 50.0),
];

fn kayak(values: &Values) -> Drawn {
    let style = Style {
        widest: 0.5,
        lowest: 0.5,
        keel_powers: [4, 4],
        sweep: 0.0,
        fullness: 0.35,
    };
    let drawn = hull(dimensions(values, End::Stem, End::Stem, style))?;
    // The deck is a cylinder too: the sheer, carried inwards along a line that rises.
    let slope = values.number("deck-rise") / (values.number("beam") / 2.0);
    let ridge: Vec<Point3> =
        drawn.sheer.iter().map(|p| Point3::new(p.x, 0.0, p.z + slope * p.y)).collect();
    let mut sketch = drawn.sketch;
    sketch.spline("ridge", &ridge);
    sketch.patch("deck", &["ridge", "-sheer"], LONG_SAMPLES);
    sketch.sheet("plywood-4mm");
    Ok(sketch)
}

/// The dimensions that all of them take.
fn dimensions(values: &Values, bow: End, stern: End, style: Style) -> Dimensions {
    Dimensions {
        length: values.number("length"),
        beam: values.number("beam"),
        chine_beam: values.number("chine-beam"),
        depth: values.number("depth"),
        chine_height: values.number("chine-height"),
        bow_height: values.number("bow-height"),
        stern_height: values.number("stern-height"),
        bow_rise: values.number("bow-rise"),
        stern_rise: values.number("stern-rise"),
        bow,
        stern,
        style,
    }
}

fn transom(values: &Values, width: &str, rake: &str) -> End {
    End::Transom { width: values.number(width), rake: values.radians(rake) }
}
