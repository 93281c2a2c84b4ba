//! A hull from measured lines.

use super::sketch::{Drawn, Sketch};
use super::{Choice, Kind, NamedCurve, Parameter, Template, TemplateError, Values};
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::math::{Point3, Vec3};

/// A hull from a table of offsets.
pub(super) const HULL: Template = Template {
    name: "hull",
    title: "Hull from a table of offsets, a plank between each two lines",
    who: "Boat builders and naval architects get the planks of a design, or of a boat that they \
          measured, from the offsets of its lines; planks are one half, to be cut twice, once \
          turned over, and without a table it draws a skiff to begin with.",
    words: &[
        "offsets",
        "offset table",
        "table of offsets",
        "half-breadths",
        "lines plan",
        "stations",
        "plank",
        "plank expansion",
        "plate development",
        "chine and sheer",
        "multi-chine",
        "boat",
    ],
    parameters: &PARAMETERS,
    sheet: Some("plywood-6mm"),
    trade: Some("boat"),
    build: hull,
};

const PARAMETERS: [Parameter; 2] = [
    Parameter {
        name: "table",
        meaning: "a curve for each line, from the keel to the sheer: x along, y out, z up",
        kind: Kind::Table,
    },
    Parameter { name: "units", meaning: "unit of the table's numbers", kind: Kind::Choice(&UNITS) },
];

/// The units of the table, which its reader turns into millimetres.
const UNITS: [Choice; 5] = [
    Choice { name: "mm", meaning: "millimetres" },
    Choice { name: "cm", meaning: "centimetres" },
    Choice { name: "m", meaning: "metres" },
    Choice { name: "in", meaning: "inches" },
    Choice { name: "ft", meaning: "feet" },
];

/// Samples of each line.
const SAMPLES: usize = 200;
/// Limit of the lines of a hull.
const MOST_LINES: usize = 20;

/// The lines of a skiff of 3.6 m, as a builder writes them down, to the mm.
const SKIFF: [(&str, [[f64; 3]; 9]); 3] = [
    (
        "keel",
        [
            [90.0, 0.0, 45.0],
            [398.0, 0.0, 28.0],
            [754.0, 0.0, 14.0],
            [1203.0, 0.0, 3.0],
            [1701.0, 0.0, 0.0],
            [2199.0, 0.0, 6.0],
            [2648.0, 0.0, 36.0],
            [3004.0, 0.0, 89.0],
            [3311.0, 0.0, 162.0],
        ],
    ),
    (
        "chine",
        [
            [76.0, 374.0, 113.0],
            [385.0, 411.0, 106.0],
            [743.0, 454.0, 104.0],
            [1194.0, 496.0, 106.0],
            [1694.0, 504.0, 109.0],
            [2194.0, 450.0, 116.0],
            [2645.0, 334.0, 133.0],
            [3003.0, 182.0, 150.0],
            [3311.0, 0.0, 162.0],
        ],
    ),
    (
        "sheer",
        [
            [0.0, 531.0, 470.0],
            [344.0, 576.0, 472.0],
            [742.0, 628.0, 477.0],
            [1244.0, 678.0, 490.0],
            [1800.0, 686.0, 513.0],
            [2356.0, 614.0, 543.0],
            [2858.0, 453.0, 577.0],
            [3256.0, 246.0, 609.0],
            [3600.0, 0.0, 640.0],
        ],
    ),
];

fn hull(values: &Values) -> Drawn {
    let table = values.table("table");
    let skiff: Vec<NamedCurve> = SKIFF.iter().map(|(name, points)| line(name, points)).collect();
    let lines = if table.is_empty() { &skiff } else { table };
    let wrong = |message: String| {
        let hint =
            "Give the table one curve for each line of the hull, from the keel to the sheer.";
        TemplateError::together("table", message, hint)
    };
    let units = values.choice("units");
    if table.is_empty() && units != UNITS[0].name {
        let message = format!("there is no table whose numbers could be in {units}");
        let hint = "Name one, such as table=offsets.csv, or leave the units out.";
        return Err(TemplateError::together("units", message, hint));
    }
    match lines.len() {
        1 => return Err(wrong("the table has one line, and a plank lies between two".to_owned())),
        found if found > MOST_LINES => {
            return Err(wrong(format!(
                "the table has {found} lines, and {MOST_LINES} are the most"
            )));
        }
        _ => {}
    }
    if let Some(short) = lines.iter().find(|line| line.points.len() < 2) {
        return Err(wrong(format!("the line '{}' has a single point", short.name)));
    }
    let mut sketch = Sketch::default();
    for line in lines {
        sketch.through(&line.name, line.points.clone());
    }
    // Tables list lines from the keel up or from the sheer down.
    let mut upwards: Vec<&NamedCurve> = lines.iter().collect();
    if middle(upwards[0]).z > middle(upwards[upwards.len() - 1]).z {
        upwards.reverse();
    }
    let sheer = middle(upwards[upwards.len() - 1]);
    let inside = Point3::new(sheer.x, 0.0, sheer.z);
    let last = upwards.len() - 2;
    for (n, pair) in upwards.windows(2).enumerate() {
        let name = match n {
            0 => "bottom".to_owned(),
            n if n == last => "side".to_owned(),
            n => format!("strake-{n}"),
        };
        let [mut first, mut second] = [pair[1], pair[0]];
        if !faces_away(first, second, inside) {
            (first, second) = (second, first);
        }
        sketch.plank(name, [&first.name, &second.name], SAMPLES);
    }
    let stations = stations(lines);
    if !stations.is_empty() {
        sketch.stations(&stations);
    }
    Ok(sketch)
}

/// Places along x at which every line has a point between its ends, in increasing order: the
/// stations at which the offsets were taken.
fn stations(lines: &[NamedCurve]) -> Vec<f64> {
    let inner = |line: &NamedCurve| -> Vec<f64> {
        let last = line.points.len() - 1;
        line.points.iter().take(last).skip(1).map(|point| point.at.x).collect()
    };
    let Some((first, others)) = lines.split_first() else { return Vec::new() };
    let others: Vec<Vec<f64>> = others.iter().map(inner).collect();
    let is_shared = |x: &f64| others.iter().all(|line| line.contains(x));
    let mut places: Vec<f64> = inner(first).into_iter().filter(is_shared).collect();
    places.sort_by(f64::total_cmp);
    places.dedup();
    places
}

fn line(name: &str, points: &[[f64; 3]]) -> NamedCurve {
    let points = points.iter().map(|&[x, y, z]| CurvePoint::smooth(Point3::new(x, y, z))).collect();
    NamedCurve { name: name.to_owned(), points }
}

/// The mean of the points of a line.
fn middle(line: &NamedCurve) -> Point3 {
    let sum = line.points.iter().fold(Vec3::ZERO, |sum, point| sum + point.at.to_vec());
    Point3::from_vec(sum / line.points.len() as f64)
}

/// Whether a plank whose boundary runs along `first` and back along `second` faces away from a
/// point.
fn faces_away(first: &NamedCurve, second: &NamedCurve, from: Point3) -> bool {
    let along = first.points[first.points.len() - 1].at - first.points[0].at;
    let across = middle(second) - middle(first);
    let plank = middle(first).lerp(middle(second), 0.5);
    along.cross(across).dot(plank - from) >= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Axis, Design, Mark, MarkKind, PanelShape, StationPlaces};
    use crate::template::{Value, template};

    fn drawn(lines: Vec<NamedCurve>) -> Result<Design, TemplateError> {
        let mut values = template("hull").unwrap().defaults();
        values.set("table", Value::Table(lines)).unwrap();
        values.design()
    }

    fn skiff() -> Vec<NamedCurve> {
        SKIFF.iter().map(|(name, points)| line(name, points)).collect()
    }

    #[test]
    fn planks_are_the_same_from_either_end_of_the_table() {
        let upwards = drawn(skiff()).unwrap();
        let names: Vec<&str> = upwards.panels.iter().map(|panel| panel.name.as_str()).collect();
        assert_eq!(names, ["bottom", "side"]);
        let PanelShape::Rails([first, second]) = &upwards.panels[0].shape else { panic!() };
        assert_eq!([&first.name[..], &second.name[..]], ["chine", "keel"]);
        let downwards = drawn(skiff().into_iter().rev().collect()).unwrap();
        assert_eq!(downwards.panels, upwards.panels);
        // Run aft, the same lines are rails the other way round, and the planks still face
        // outwards.
        let mut aft = skiff();
        aft.iter_mut().for_each(|line| line.points.reverse());
        let PanelShape::Rails([first, _]) = &drawn(aft).unwrap().panels[0].shape else { panic!() };
        assert_eq!(first.name, "keel");
    }

    #[test]
    fn stations_that_all_lines_share_are_marked() {
        assert_eq!(drawn(skiff()).unwrap().marks, []);
        let mut lines = skiff();
        for line in &mut lines {
            (line.points[3].at.x, line.points[5].at.x) = (1200.0, 2200.0);
        }
        let marks = drawn(lines).unwrap().marks;
        let [Mark { kind: MarkKind::Stations { axis: Axis::X, at }, .. }] = &marks[..] else {
            panic!("{marks:?}")
        };
        let StationPlaces::Listed { planes } = at else { panic!("{at:?}") };
        assert_eq!(planes.iter().map(|plane| plane.at).collect::<Vec<_>>(), [1200.0, 2200.0]);
    }

    #[test]
    fn what_is_no_hull_is_refused() {
        let one = drawn(skiff().into_iter().take(1).collect()).unwrap_err();
        assert!(one.to_string().contains("one line"), "{one}");
        let mut short = skiff();
        short[1].points.truncate(1);
        let short = drawn(short).unwrap_err();
        assert!(short.to_string().contains("'chine' has a single point"), "{short}");
        let mut values = template("hull").unwrap().defaults();
        values.set("units", Value::Choice("ft".to_owned())).unwrap();
        assert_eq!(values.design().unwrap_err().parameter(), Some("units"));
    }
}
