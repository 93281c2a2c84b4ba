//! Surfaces of revolution from a few radii, and the hemisphere in bands.

use super::gores::{Names, Station, gores};
use super::sketch::{Drawn, Sketch};
use super::{Choice, Kind, Parameter, Template, TemplateError, Value, Values, count, length};
use sheetwright_geometry::curve::{Curve, CurveKind, CurvePoint};
use sheetwright_geometry::math::{Point3, cos, sin};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A vase, a bowl or a measured profile.
pub(super) const REVOLUTION: Template = Template {
    name: "revolution",
    title: "Vase, bowl or any turned shape in gores",
    who: "Makers of vases, planters, columns and lamps turn a profile into equal pieces.",
    words: &["surface of revolution", "turned", "lathe", "vase", "bowl", "pot", "planter", "urn"],
    parameters: &[
        Parameter {
            name: "profile",
            meaning: "shape from the foot up",
            kind: Kind::Choice(&PROFILES),
        },
        length("height", "height", 10.0, 20_000.0, 400.0),
        length("diameter", "largest diameter; of no effect on `measured`", 10.0, 20_000.0, 260.0),
        Parameter {
            name: "radii",
            meaning: "radii measured at equal heights from the foot to the rim, for `measured`",
            kind: Kind::Lengths {
                least: 0.0,
                most: 10_000.0,
                fewest: 3,
                longest: 100,
                default: &[70.0, 110.0, 130.0, 120.0, 80.0, 50.0, 60.0],
            },
        },
        count("pieces", "pieces", 3, 48, 12),
    ],
    sheet: None,
    trade: None,
    build: revolution,
};

const PROFILES: [Choice; 6] = [
    Choice { name: "vase", meaning: "a belly, a neck and a flared rim" },
    Choice { name: "bowl", meaning: "a foot that opens up to the rim" },
    Choice { name: "barrel", meaning: "widest in the middle" },
    Choice { name: "bell", meaning: "a flared mouth below, closed at the top" },
    Choice { name: "column", meaning: "tapered upwards, with a slight swelling" },
    Choice { name: "measured", meaning: "through the radii that are given" },
];

/// Radii at equal heights from the foot up; only their ratio counts.
fn radii(profile: &str) -> &'static [f64] {
    match profile {
        "vase" => &[0.55, 0.84, 1.0, 0.97, 0.78, 0.52, 0.42, 0.55],
        "bowl" => &[0.40, 0.70, 0.86, 0.95, 1.0],
        "barrel" => &[0.80, 0.95, 1.0, 0.95, 0.80],
        "bell" => &[1.0, 0.75, 0.62, 0.56, 0.50, 0.38, 0.0],
        _ => &[1.0, 0.99, 0.97, 0.93, 0.87, 0.80],
    }
}

fn revolution(values: &Values) -> Drawn {
    let height = values.number("height");
    let list: Vec<f64> = match (values.choice("profile"), values.value("radii")) {
        ("measured", Value::Numbers(list)) => list.clone(),
        (named, _) => {
            let radius = values.number("diameter") / 2.0;
            radii(named).iter().map(|share| share * radius).collect()
        }
    };
    let last = list.len() - 1;
    let stations: Vec<Station> = list
        .iter()
        .enumerate()
        .map(|(n, &r)| Station { r, z: height * n as f64 / last as f64 })
        .collect();
    if let Some(z) = reaches_axis(&stations) {
        return Err(TemplateError::together(
            "radii",
            format!("the curve through the radii reaches the axis at {z:.1} mm above the foot"),
            "Only the foot and the top may close: make the radii between them larger.",
        ));
    }
    let names = Names { count: "pieces", opening: "radii" };
    gores(&stations, values.count("pieces"), names)
}

/// Radii between the ends are at least this share of the largest.
const NEAR_AXIS: f64 = 1e-3;

/// The height between its ends at which the spline through a profile comes to the axis, if it does.
fn reaches_axis(stations: &[Station]) -> Option<f64> {
    let largest = stations.iter().map(|s| s.r).fold(0.0, f64::max);
    let inner = &stations[1..stations.len() - 1];
    // `<=` also catches a profile of zeros.
    if let Some(near) = inner.iter().find(|s| s.r <= NEAR_AXIS * largest) {
        return Some(near.z);
    }
    let points: Vec<CurvePoint> =
        stations.iter().map(|s| CurvePoint::smooth(Point3::new(s.r, 0.0, s.z))).collect();
    let curve = Curve::new(CurveKind::Spline, &points, false).ok()?;
    let places = 1..TRIED * curve.spans().len();
    places
        .map(|n| curve.position(n as f64 / TRIED as f64))
        .find_map(|at| (at.x <= 0.0).then_some(at.z))
}

/// Places that are checked between two radii.
const TRIED: usize = 32;

/// A hemisphere in gores that are divided level.
pub(super) const HEMISPHERE: Template = Template {
    name: "hemisphere",
    title: "Hemisphere in bands of pieces",
    who: "Architects and model makers panel a dome with small pieces: 36 of them by default.",
    words: &["dome panels", "panelled dome", "half sphere", "radome", "planetarium"],
    parameters: &[
        length("diameter", "diameter", 20.0, 50_000.0, 400.0),
        count("gores", "pieces in each band", 4, 32, 12),
        count("bands", "bands from the foot to the pole", 2, 12, 3),
    ],
    sheet: None,
    trade: Some("paper"),
    build: hemisphere,
};

/// Samples of each piece: two more than it has triangles, and 36 pieces have 2,304.
const PIECE_SAMPLES: usize = 66;

fn hemisphere(values: &Values) -> Drawn {
    let radius = values.number("diameter") / 2.0;
    let (n, bands) = (values.count("gores"), values.count("bands"));
    let mut sketch = Sketch::default();
    let (width, rise) = (TAU / n as f64, FRAC_PI_2 / bands as f64);
    let at = |longitude: f64, latitude: f64| {
        let r = radius * cos(latitude);
        Point3::new(r * cos(longitude), r * sin(longitude), radius * sin(latitude))
    };
    let pole = Point3::new(0.0, 0.0, radius);
    for band in 0..bands {
        let low = rise * band as f64;
        for k in 0..n {
            let side = width * k as f64;
            let across = |t: f64| at(side + width * t, low);
            sketch.along(format!("level-{}-{}", band + 1, k + 1), width, across);
            let up = |t: f64| match t {
                1.0 if band + 1 == bands => pole,
                t => at(side, low + rise * t),
            };
            sketch.along(format!("side-{}-{}", band + 1, k + 1), rise, up);
        }
    }
    for band in 1..=bands {
        for k in 1..=n {
            let next = k % n + 1;
            let name = format!("band-{band}-{k}");
            let foot = format!("level-{band}-{k}");
            let (right, left) = (format!("side-{band}-{next}"), format!("-side-{band}-{k}"));
            let top = format!("-level-{}-{k}", band + 1);
            if band == bands {
                sketch.patch(name, &[&foot, &right, &left], PIECE_SAMPLES);
            } else {
                sketch.patch(name, &[&foot, &right, &top, &left], PIECE_SAMPLES);
            }
        }
    }
    Ok(sketch)
}
