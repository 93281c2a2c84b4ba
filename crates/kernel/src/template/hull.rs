//! A hull from measured lines.

use super::boat::{BOTH, PORT};
use super::sketch::{Drawn, Sketch, mirrored};
use super::{Choice, Kind, NamedCurve, Parameter, Template, TemplateError, Values};
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::math::{Point3, Vec3};

/// A hull from a table of offsets.
pub(super) const HULL: Template = Template {
    name: "hull",
    title: "Hull from a table of offsets, a plank between each two lines",
    who: "Boat builders and naval architects get the planks of a design, or of a boat that they \
          measured, from the offsets of its lines, which are those of one half; without a table \
          it draws a skiff to begin with.",
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

const PARAMETERS: [Parameter; 5] = [
    Parameter {
        name: "table",
        meaning: "a curve for each line, from the keel to the sheer: x along, y out, z up",
        kind: Kind::Table,
    },
    Parameter { name: "units", meaning: "unit of the table's numbers", kind: Kind::Choice(&UNITS) },
    Parameter {
        name: "halves",
        meaning: "halves of the planks that are drawn",
        kind: Kind::Choice(&[BOTH, PORT]),
    },
    Parameter {
        name: "transoms",
        meaning: "whether flat ends of the hull are drawn, too",
        kind: Kind::Choice(&NO_YES),
    },
    Parameter {
        name: "deck",
        meaning: "whether a deck from sheer to sheer is drawn, too",
        kind: Kind::Choice(&NO_YES),
    },
];

/// Whether a part is drawn.
const NO_YES: [Choice; 2] =
    [Choice { name: "no", meaning: "left out" }, Choice { name: "yes", meaning: "drawn" }];

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
/// Samples of the edge of a transom, which is flat.
const TRANSOM_SAMPLES: usize = 100;
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
    let is_flat = has_flat_bottom(&upwards);
    let planks = plank_names(&upwards, is_flat);
    for (name, pair) in planks.iter().zip(upwards.windows(2)) {
        plank(&mut sketch, name, [pair[1], pair[0]], inside);
    }
    let halves: Vec<&str> = planks.iter().map(String::as_str).collect();
    if values.choice("halves") == BOTH.name {
        sketch.mirror(&halves);
    } else {
        sketch.cut_twice(&halves);
    }
    if is_flat {
        across(&mut sketch, BOTTOM, upwards[0], inside);
    }
    if values.choice("transoms") == NO_YES[1].name {
        transoms(&mut sketch, &upwards, &planks, is_flat);
    }
    if values.choice("deck") == NO_YES[1].name {
        // Seen from below, where the keel is, the deck faces away.
        let below = Point3::new(sheer.x, 0.0, middle(upwards[0]).z);
        across(&mut sketch, "deck", upwards[upwards.len() - 1], below);
    }
    let stations = stations(lines);
    if !stations.is_empty() {
        sketch.stations(&stations);
    }
    Ok(sketch)
}

/// Lines with more points in common are no offsets at stations, but samples.
const MOST_STATIONS: usize = 1000;
/// A lowest line that keeps this share of the half-breadth from the middle plane is no keel, but
/// the edge of a flat bottom.
const FLAT_BOTTOM: f64 = 0.1;
/// How far the ends of lines may lie from a plane across the hull, as a share of the height of the
/// end, if it is to be a transom: what rounding to an eighth of an inch leaves of a small one.
const OFF_TRANSOM: f64 = 0.01;
/// The least width of a transom, as a share of the breadth of the hull: a narrower end is a stem.
const LEAST_TRANSOM: f64 = 0.1;

/// Whether the lowest line is the edge of a flat bottom, of a hull without a line for the keel.
fn has_flat_bottom(upwards: &[&NamedCurve]) -> bool {
    let widest =
        |line: &NamedCurve| line.points.iter().map(|point| point.at.y.abs()).fold(0.0, f64::max);
    let of_all = upwards.iter().map(|line| widest(line)).fold(0.0, f64::max);
    widest(upwards[0]) > FLAT_BOTTOM * of_all
}

/// The name of a flat bottom, and of the lowest plank of a hull that has none.
const BOTTOM: &str = "bottom";

/// The names of the planks between each two neighbouring lines.
fn plank_names(upwards: &[&NamedCurve], is_flat: bool) -> Vec<String> {
    let last = upwards.len() - 2;
    let name = |n: usize| match n {
        n if n == last && (n > 0 || is_flat) => "side".to_owned(),
        0 if !is_flat => BOTTOM.to_owned(),
        n => format!("strake-{}", n + usize::from(is_flat)),
    };
    (0..=last).map(name).collect()
}

/// A plank between two lines, that faces away from `inside`.
fn plank(sketch: &mut Sketch, name: &str, lines: [&NamedCurve; 2], inside: Point3) {
    let [mut first, mut second] = lines;
    if !faces_away(first, second, inside) {
        (first, second) = (second, first);
    }
    sketch.plank(name, [&first.name, &second.name], SAMPLES);
}

/// A panel from a line to its mirror image, of straight lines across: a deck or a flat bottom.
fn across(sketch: &mut Sketch, name: &str, line: &NamedCurve, away_from: Point3) {
    let image = NamedCurve {
        name: sketch.image(&line.name),
        points: line
            .points
            .iter()
            .map(|point| CurvePoint { at: mirrored(point.at), ..*point })
            .collect(),
    };
    plank(sketch, name, [line, &image], away_from);
}

/// Draws each end of a hull whose lines end in a plane across it, wide enough to be a transom.
fn transoms(sketch: &mut Sketch, upwards: &[&NamedCurve], planks: &[String], is_flat: bool) {
    let first = |line: &&NamedCurve| line.points[0].at;
    let last = |line: &&NamedCurve| line.points[line.points.len() - 1].at;
    let ends = [
        upwards.iter().map(first).collect::<Vec<Point3>>(),
        upwards.iter().map(last).collect::<Vec<Point3>>(),
    ];
    let width = upwards
        .iter()
        .flat_map(|line| line.points.iter().map(|point| point.at.y.abs()))
        .fold(0.0, f64::max);
    let middle = (middle(upwards[0]).x + middle(upwards[upwards.len() - 1]).x) / 2.0;
    let mut number = 0;
    for end in ends {
        let (keel, sheer) = (end[0], end[end.len() - 1]);
        let height = sheer.z - keel.z;
        let plane = |z: f64| keel.x + (z - keel.z) * (sheer.x - keel.x) / height;
        let is_off = |p: &Point3| (p.x - plane(p.z)).abs() > OFF_TRANSOM * height;
        let is_upwards = end.windows(2).all(|pair| pair[1].z >= pair[0].z);
        if height <= 0.0 || end.iter().any(is_off) || !is_upwards || sheer.y < LEAST_TRANSOM * width
        {
            continue;
        }
        number += 1;
        let name = if number == 1 { "transom".to_owned() } else { format!("transom-{number}") };
        let mut edges = board_edges(sketch, &name, &end, planks, is_flat);
        // The board faces away from the hull.
        if sheer.x < middle {
            edges.reverse();
            edges.iter_mut().for_each(|edge| *edge = opposite(edge));
        }
        let edges: Vec<&str> = edges.iter().map(String::as_str).collect();
        sketch.patch(name, &edges, TRANSOM_SAMPLES);
    }
}

/// Draws the edges of a transom, each straight from the end of a line to that of the next, as the
/// planks end; where the ends lie out of one plane, so does the board. Gives their names as they
/// run round it: up to port, and down to starboard.
fn board_edges(
    sketch: &mut Sketch,
    board: &str,
    end: &[Point3],
    planks: &[String],
    is_flat: bool,
) -> Vec<String> {
    // A line from one point of the middle plane to another is no edge of the board.
    let below = end[1..].iter().take_while(|p| end[0].y == 0.0 && p.y == 0.0).count();
    let [lowest, sheer] = [end[below], end[end.len() - 1]];
    let mut edges = Vec::new();
    if lowest.y != 0.0 {
        let name = format!("{board}-{}", if is_flat { BOTTOM } else { "keel" });
        sketch.polyline(&name, &[mirrored(lowest), lowest]);
        edges.push(name);
    }
    let mut to_starboard = Vec::new();
    for (plank, ends) in planks.iter().zip(end.windows(2)).skip(below) {
        // Two lines that end in one point have no edge between them.
        if ends[0] == ends[1] {
            continue;
        }
        let name = format!("{board}-{plank}");
        sketch.polyline(&name, ends);
        to_starboard.push(opposite(&sketch.image(&name)));
        edges.push(name);
    }
    let name = format!("{board}-top");
    sketch.polyline(&name, &[sheer, mirrored(sheer)]);
    edges.push(name);
    edges.extend(to_starboard.into_iter().rev());
    edges
}

/// The name of a curve, run the other way.
fn opposite(edge: &str) -> String {
    edge.strip_prefix('-').map_or_else(|| format!("-{edge}"), str::to_owned)
}

/// Places along x at which every line has a point between its ends, in increasing order: the
/// stations at which the offsets were taken.
fn stations(lines: &[NamedCurve]) -> Vec<f64> {
    let inner = |line: &NamedCurve| -> Vec<f64> {
        let last = line.points.len() - 1;
        // Adding 0 turns −0 into 0.
        let points = line.points.iter().take(last).skip(1);
        let mut places: Vec<f64> = points.map(|point| point.at.x + 0.0).collect();
        places.sort_by(f64::total_cmp);
        places
    };
    let Some((first, others)) = lines.split_first() else { return Vec::new() };
    let others: Vec<Vec<f64>> = others.iter().map(inner).collect();
    let is_in = |line: &Vec<f64>, x: f64| line.binary_search_by(|at| at.total_cmp(&x)).is_ok();
    let is_shared = |x: &f64| others.iter().all(|line| is_in(line, *x));
    let mut places: Vec<f64> = inner(first).into_iter().filter(is_shared).collect();
    places.dedup();
    if places.len() > MOST_STATIONS { Vec::new() } else { places }
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
    use crate::design::{Axis, Design, DesignPanel, Mark, MarkKind, PanelShape, StationPlaces};
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
        assert_eq!(names, ["bottom-port", "bottom-starboard", "side-port", "side-starboard"]);
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
    fn one_half_is_drawn_for_both_if_that_is_wanted() {
        let panels = |lines: Vec<NamedCurve>, halves: &str| -> Vec<(String, [u32; 2])> {
            let mut values = template("hull").unwrap().defaults();
            values.set("table", Value::Table(lines)).unwrap();
            values.set("halves", Value::Choice(halves.to_owned())).unwrap();
            let of = |p: &DesignPanel| (p.name.clone(), [p.count, p.mirrored]);
            values.design().unwrap().panels.iter().map(of).collect()
        };
        let named = |list: &[(&str, [u32; 2])]| -> Vec<(String, [u32; 2])> {
            list.iter().map(|(name, count)| ((*name).to_owned(), *count)).collect()
        };
        let (once, twice) = ([1, 0], [2, 1]);
        assert_eq!(panels(skiff(), "port"), named(&[("bottom", twice), ("side", twice)]));
        let flat = || skiff().into_iter().skip(1).collect();
        assert_eq!(panels(flat(), "port"), named(&[("side", twice), ("bottom", once)]));
        let both = [("side-port", once), ("side-starboard", once), ("bottom", once)];
        assert_eq!(panels(flat(), "both"), named(&both));
    }

    #[test]
    fn a_hull_without_a_keel_has_a_flat_bottom() {
        let flat = drawn(skiff().into_iter().skip(1).collect()).unwrap();
        let made = crate::make::make(&flat, &mut crate::Unwatched).unwrap();
        let bottom = &made.parts[2];
        assert_eq!(bottom.name, "bottom");
        // The bottom is a cylinder across the boat.
        assert!(bottom.measures.warp_max < 0.01, "{}", bottom.measures.warp_max);
    }

    #[test]
    fn transom_and_deck_are_drawn_if_they_are_wanted() {
        let mut values = template("hull").unwrap().defaults();
        for name in ["transoms", "deck"] {
            values.set(name, Value::Choice("yes".to_owned())).unwrap();
        }
        let made = crate::make::make(&values.design().unwrap(), &mut crate::Unwatched).unwrap();
        let names: Vec<&str> = made.parts.iter().map(|part| part.name.as_str()).collect();
        assert_eq!(
            names,
            ["bottom-port", "bottom-starboard", "side-port", "side-starboard", "transom", "deck"]
        );
        let normal = |n: usize| {
            let mesh = made.parts[n].sheet.mesh();
            let [a, b, c] = mesh.triangles()[0].map(|v| mesh.position(v));
            (b - a).cross(c - a)
        };
        assert!(normal(4).x < 0.0, "the transom of the stern faces aft");
        assert!(normal(5).z > 0.0, "the deck faces up");
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
