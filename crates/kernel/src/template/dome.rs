//! Domes, balls, balloons and airships: round things in gores.

use super::gores::{Names, Station, gores, profile};
use super::sketch::Drawn;
use super::{Template, TemplateError, Values, count, length, number};
use sheetwright_geometry::math::{atan2, cos, pow, sin};
use std::f64::consts::{E, PI};

/// A cap of a sphere.
pub(super) const DOME: Template = Template {
    name: "dome",
    title: "Dome in gores",
    who: "Builders of domes, planetariums, playhouses and yurts cut it in equal gores, and so do \
          makers of umbrellas and helmets.",
    words: &["hemisphere", "half sphere", "spherical cap", "cupola", "igloo", "umbrella", "gores"],
    parameters: &[
        length("diameter", "diameter at the foot", 20.0, 50_000.0, 4000.0),
        length("height", "height; half of the diameter is a hemisphere", 5.0, 50_000.0, 2000.0),
        length("opening", "diameter of an opening at the top, 0 for none", 0.0, 20_000.0, 0.0),
        count("gores", "gores", 3, 48, 12),
    ],
    sheet: None,
    trade: None,
    build: dome,
};

fn dome(values: &Values) -> Drawn {
    let (foot, height) = (values.number("diameter") / 2.0, values.number("height"));
    let opening = values.number("opening") / 2.0;
    if height > 4.0 * foot {
        let message = format!("the height is more than twice the diameter of {} mm", 2.0 * foot);
        let hint = "A dome is a cap of a sphere: choose a height of up to twice the diameter.";
        return Err(TemplateError::together("height", message, hint));
    }
    let radius = (foot * foot + height * height) / (2.0 * height);
    // From the pole to the foot.
    let whole = atan2(foot, radius - height);
    if opening >= OPEN_SHARE * foot {
        let message = format!("the opening leaves no dome of {} mm", 2.0 * foot);
        let hint = "Make it at most nine tenths of the diameter at the foot.";
        return Err(TemplateError::together("opening", message, hint));
    }
    let start = atan2(opening, (radius * radius - opening * opening).sqrt());
    let turn = whole - start;
    let sphere = |t: f64| {
        let angle = whole - turn * t;
        Station { r: radius * sin(angle), z: radius * (cos(angle) - cos(whole)) }
    };
    gores(&profile(turn, sphere), values.count("gores"), named("opening"))
}

fn named(opening: &'static str) -> Names {
    Names { count: "gores", opening }
}

/// An opening takes at most this share of the foot.
const OPEN_SHARE: f64 = 0.9;

/// A whole sphere.
pub(super) const BALL: Template = Template {
    name: "ball",
    title: "Ball or globe in gores",
    who: "Makers of globes, beach balls, juggling balls and paper lanterns print and cut its gores.",
    words: &[
        "sphere",
        "globe",
        "beach ball",
        "juggling ball",
        "paper lantern",
        "football",
        "gores",
    ],
    parameters: &[
        length("diameter", "diameter", 20.0, 20_000.0, 300.0),
        length("opening", "diameter of an opening at each pole, 0 for none", 0.0, 10_000.0, 0.0),
        count("gores", "gores", 3, 48, 12),
    ],
    sheet: None,
    trade: Some("paper"),
    build: ball,
};

fn ball(values: &Values) -> Drawn {
    let (radius, opening) = (values.number("diameter") / 2.0, values.number("opening") / 2.0);
    if opening > OPEN_SHARE * radius {
        let message = format!("the openings leave no ball of {} mm", 2.0 * radius);
        let hint = "Make them at most nine tenths of the diameter.";
        return Err(TemplateError::together("opening", message, hint));
    }
    let start = atan2(opening, (radius * radius - opening * opening).sqrt());
    let turn = PI - 2.0 * start;
    let sphere = |t: f64| {
        let angle = PI - start - turn * t;
        Station { r: radius * sin(angle), z: radius * (1.0 + cos(angle)) }
    };
    gores(&profile(turn, sphere), values.count("gores"), named("opening"))
}

/// A sphere that runs out in a cone.
pub(super) const BALLOON: Template = Template {
    name: "balloon",
    title: "Hot-air balloon in gores",
    who: "Builders of model and tissue-paper balloons cut its gores from paper, foil or cloth.",
    words: &[
        "hot air balloon",
        "envelope",
        "sky lantern",
        "tissue balloon",
        "solar balloon",
        "gores",
    ],
    parameters: &[
        length("diameter", "largest diameter", 100.0, 30_000.0, 1500.0),
        length("height", "height from the mouth to the top", 100.0, 50_000.0, 1900.0),
        length("mouth", "diameter of the mouth", 10.0, 20_000.0, 300.0),
        count("gores", "gores", 3, 48, 12),
    ],
    sheet: None,
    trade: Some("sewing"),
    build: balloon,
};

fn balloon(values: &Values) -> Drawn {
    let (radius, mouth) = (values.number("diameter") / 2.0, values.number("mouth") / 2.0);
    // From the middle of the sphere down to the mouth.
    let below = values.number("height") - radius;
    if mouth > OPEN_SHARE * radius {
        let message = format!("the mouth is too wide for a balloon of {} mm", 2.0 * radius);
        let hint = "Make it at most nine tenths of the diameter.";
        return Err(TemplateError::together("mouth", message, hint));
    }
    if values.number("height") > TALLEST * 2.0 * radius {
        let message = format!("the height is many times the diameter of {} mm", 2.0 * radius);
        let hint = format!("Make it at most {TALLEST} times the diameter.");
        return Err(TemplateError::together("height", message, hint));
    }
    let away = (below * below + mouth * mouth).sqrt();
    if below <= 0.0 || away < (1.0 + CONE_SHARE) * radius {
        let outside = (1.0 + CONE_SHARE) * radius;
        let least = radius + (outside * outside - mouth * mouth).sqrt();
        let message = "the mouth lies inside the sphere".to_owned();
        let hint = format!("Make the height more than {:.0} mm.", least.ceil());
        return Err(TemplateError::together("height", message, hint));
    }
    // The straight side touches the sphere where the radius is at a right angle to it.
    let to_mouth = atan2(mouth, -below);
    let touch = to_mouth - atan2((away * away - radius * radius).sqrt(), radius);
    let sphere = |angle: f64| Station { r: radius * sin(angle), z: below + radius * cos(angle) };
    let last = sphere(touch);
    let side = |t: f64| Station { r: mouth + (last.r - mouth) * t, z: last.z * t };
    let mut points = profile(0.0, side);
    points.extend(profile(touch, |t| sphere(touch * (1.0 - t))).into_iter().skip(1));
    gores(&points, values.count("gores"), named("mouth"))
}

/// The tallest balloon, in diameters.
const TALLEST: f64 = 3.0;
/// The straight side begins at least this share of the radius outside of the sphere.
const CONE_SHARE: f64 = 0.01;

/// A hull of an airship.
pub(super) const AIRSHIP: Template = Template {
    name: "airship",
    title: "Airship hull in gores",
    who: "Builders of blimps and model airships cut its gores from foil or coated cloth.",
    words: &["blimp", "zeppelin", "dirigible", "envelope", "fish", "spindle", "ellipsoid", "gores"],
    parameters: &[
        length("length", "length from nose to tail", 100.0, 100_000.0, 3000.0),
        length("diameter", "largest diameter", 20.0, 30_000.0, 900.0),
        number(
            "fullest",
            "where it is widest, as a share of the length from the nose; 0.5 is an ellipsoid",
            0.35,
            0.5,
            0.4,
        ),
        length(
            "caps",
            "diameter of the discs that close nose and tail, 0 for none",
            0.0,
            10_000.0,
            100.0,
        ),
        count("gores", "gores", 3, 48, 8),
    ],
    sheet: None,
    trade: Some("sewing"),
    build: airship,
};

fn airship(values: &Values) -> Drawn {
    let (length, radius) = (values.number("length"), values.number("diameter") / 2.0);
    let fullest = values.number("fullest");
    if !(1.0..=MOST_SLENDER).contains(&(length / (2.0 * radius))) {
        let message = format!("a hull of {length} mm by {} mm is drawn by no gores", 2.0 * radius);
        let hint = format!("Make the length 1 to {MOST_SLENDER} times the diameter.");
        return Err(TemplateError::together("diameter", message, hint));
    }
    // r² = c · x (1 − x) e^(−kx) is largest at `fullest`, round at both ends, and slimmer towards
    // the tail; k = 0 is an ellipsoid.
    let k = (1.0 - 2.0 * fullest) / (fullest * (1.0 - fullest));
    let shape = |x: f64, left: f64| (x * left * pow(E, -k * x)).sqrt();
    let top = shape(fullest, 1.0 - fullest);
    let hull = |t: f64| {
        if t == 0.0 || t == 1.0 {
            return Station { r: 0.0, z: length * t };
        }
        // Even steps of this angle are short steps of x where the ends are round.
        let (s, c) = (sin(PI * t / 2.0), cos(PI * t / 2.0));
        let (x, left) = (s * s, c * c);
        Station { r: radius * shape(x, left) / top, z: length * x }
    };
    let caps = values.number("caps") / 2.0;
    if caps > OPEN_SHARE * radius {
        let message = format!("the caps leave no hull of {} mm", 2.0 * radius);
        let hint = "Make them at most nine tenths of the diameter.";
        return Err(TemplateError::together("caps", message, hint));
    }
    let widest = 2.0 * atan2(fullest.sqrt(), (1.0 - fullest).sqrt()) / PI;
    let nose = where_radius(&hull, caps, [0.0, widest]);
    let tail = where_radius(&hull, caps, [1.0, widest]);
    gores(&profile(PI, |t| hull(nose + (tail - nose) * t)), values.count("gores"), named("caps"))
}

/// The longest hull, in diameters: the nose and tail of a longer one are too sharp for any
/// sampling.
const MOST_SLENDER: f64 = 10.0;

/// Where a profile that widens from the first place to the second has this radius.
fn where_radius(profile: &dyn Fn(f64) -> Station, radius: f64, places: [f64; 2]) -> f64 {
    let [mut narrow, mut wide] = places;
    if profile(narrow).r >= radius {
        return narrow;
    }
    // Halved until nothing is left between the two.
    for _ in 0..f64::MANTISSA_DIGITS {
        let middle = (narrow + wide) / 2.0;
        if profile(middle).r < radius { narrow = middle } else { wide = middle }
    }
    wide
}
