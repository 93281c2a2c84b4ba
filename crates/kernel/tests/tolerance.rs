//! Samples by tolerance: the polygon through them stays as near to the curves as it is to, with as
//! few as that takes.
#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::check::{FindingKind, Severity};
use sheetwright::curve::{Curve, CurveKind, CurvePoint, sample_open};
use sheetwright::design::{
    CurveUse, Design, DesignCurve, DesignPanel, FEWEST_ON_RAIL, MOST_BY_TOLERANCE, MOST_USUAL,
    PanelShape, SampleTolerance, Vary,
};
use sheetwright::make::{Live, Part, make};
use sheetwright::math::{Point3, cos, sin};
use sheetwright::sample::Counts;
use sheetwright::template::{Value, template};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::random::Random;
use std::f64::consts::{PI, TAU};

fn drawn(name: &str, kind: CurveKind, points: Vec<Point3>) -> DesignCurve {
    let points = points.into_iter().map(CurvePoint::smooth).collect();
    DesignCurve { name: name.to_owned(), kind: Some(kind), closed: false, points }
}

/// A curve and one above it, as the rails of a panel with this tolerance.
fn between(kind: CurveKind, points: &[Point3], tolerance_mm: f64) -> Design {
    let lifted = points.iter().map(|p| Point3::new(p.x, p.y, p.z + 100.0)).collect();
    let rails = [drawn("low", kind, points.to_vec()), drawn("high", kind, lifted)];
    let mut design = Design::between("strip", rails);
    design.panels[0] = design.panels[0].clone().within_mm(tolerance_mm);
    design
}

fn samples(design: &Design) -> usize {
    Counts::default().of(design).panels[0].samples
}

/// The largest distance of a curve from the polygon through so many samples, and by how much that
/// is shorter, by trying thousands of points.
fn by_trying(curve: &Curve, samples: usize) -> [f64; 2] {
    let polygon = sample_open(curve, samples).unwrap();
    let at: Vec<Point3> = polygon.iter().map(|s| s.position).collect();
    let off = |p: Point3| {
        let of_step = |step: &[Point3]| {
            let along = step[1] - step[0];
            let share = ((p - step[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            p.distance(step[0] + along * share)
        };
        at.windows(2).map(of_step).fold(f64::INFINITY, f64::min)
    };
    let spans = curve.spans().len();
    let tried = spans * 400;
    let place = |n: usize| curve.position(spans as f64 * n as f64 / tried as f64);
    let farthest = (0..=tried).map(|n| off(place(n))).fold(0.0, f64::max);
    let steps: f64 = at.windows(2).map(|step| step[0].distance(step[1])).sum();
    [farthest, curve.length() - steps]
}

#[test]
fn as_few_samples_as_keep_random_curves_within_the_tolerance() {
    let mut random = Random::new(40);
    let mut chosen = 0;
    for case in 0..40 {
        let kind = [CurveKind::Spline, CurveKind::BSpline][case % 2];
        let points: Vec<Point3> = if case % 4 < 2 {
            // An arc.
            let (radius, turn) = (random.between(50.0, 2000.0), random.between(0.3, TAU));
            let on = |n: usize| {
                let a = turn * n as f64 / 40.0;
                Point3::new(radius * cos(a), radius * sin(a), 0.0)
            };
            (0..=40).map(on).collect()
        } else {
            let mut point = |n: usize| {
                let mut aside = || random.between(-60.0, 60.0);
                Point3::new(120.0 * n as f64, aside(), aside())
            };
            (0..9).map(&mut point).collect()
        };
        let tolerance = [0.01, 0.05, 0.3][case % 3];
        let design = between(kind, &points, tolerance);
        let found = samples(&design);
        let curve = &design.curves[0];
        let curve = Curve::new(kind, &curve.points, false).unwrap();
        let [far, short] = by_trying(&curve, found);
        let case = format!("{case}: {found} samples, {far} off, {short} shorter, {tolerance}");
        assert!(far <= 1.001 * tolerance && short <= 1.001 * tolerance, "{case}");
        if found > FEWEST_ON_RAIL {
            chosen += 1;
            let [far, short] = by_trying(&curve, found - 1);
            assert!(far.max(short) > 0.98 * tolerance, "{case}: one fewer does: {far} {short}");
        }
        // What is counted once is not counted up again.
        let counted = Counts::default().of(&design).into_owned();
        assert_eq!(samples(&counted), found, "{case}");
    }
    assert!(chosen > 20, "{chosen}");
}

fn with_tolerance(name: &str, numbers: &[(&str, f64)], tolerance_mm: f64) -> Vec<Part> {
    let mut values = template(name).unwrap().defaults();
    for (name, number) in numbers {
        values.set(name, Value::Number(*number)).unwrap();
    }
    let mut design = values.design().unwrap();
    for panel in &mut design.panels {
        *panel = panel.clone().within_mm(tolerance_mm);
    }
    make(&design, &mut Unwatched).unwrap().parts
}

#[test]
fn a_drum_is_as_long_as_its_circle_within_the_tolerance() {
    let numbers = [("bottom", 400.0), ("top", 400.0)];
    let mut values = template("lampshade").unwrap().defaults();
    for (name, number) in numbers {
        values.set(name, Value::Number(number)).unwrap();
    }
    let drawn = make(&values.design().unwrap(), &mut Unwatched).unwrap().parts.remove(0);
    let chords = &drawn.found().unwrap().chords;
    let near = |a: Option<f64>, b: f64| (a.unwrap() - b).abs() < 0.001;
    // With 121 samples: 200 (1 − cos 1.5°), and 400 π − 120 · 400 sin 1.5°.
    assert!(near(chords.distance_max_mm(), 0.0685), "{:?}", chords.distance_max_mm());
    assert!(near(chords.shorter_max_mm(), 0.1435), "{:?}", chords.shorter_max_mm());
    for tolerance in [0.2, 0.05, 0.01] {
        let drum = with_tolerance("lampshade", &numbers, tolerance).remove(0);
        for name in ["bottom", "top"] {
            let edge = drum.edges.iter().find(|edge| edge.name == name).unwrap();
            let short = 400.0 * PI - edge.length_flat_mm;
            assert!(short > 0.5 * tolerance && short < 1.01 * tolerance, "{tolerance} {short}");
            // The spline of the template is 10⁻⁷ longer than the circle.
            let told = drum.curve_shorter_mm(edge).unwrap();
            assert!((told - short).abs() < 1e-3 * tolerance + 2e-4, "{told} {short}");
        }
        let seam = drum.edges.iter().find(|edge| edge.name == "start").unwrap();
        assert!(drum.curve_shorter_mm(seam).unwrap() < 1e-9);
        assert_eq!(drum.found().unwrap().tolerance_mm, Some(tolerance));
    }
}

#[test]
fn ducts_stay_within_the_tolerance_and_their_seams_have_the_same_samples() {
    for name in ["elbow", "square-to-round"] {
        let parts = with_tolerance(name, &[], 0.05);
        for part in &parts {
            let chords = &part.found().unwrap().chords;
            let both = [chords.distance_max_mm().unwrap(), chords.shorter_max_mm().unwrap()];
            assert!(both.iter().all(|mm| *mm <= 0.0505), "{name} {both:?}");
            assert!(!part.checked.findings.iter().any(is_off), "{name}");
            for edge in part.edges.iter().filter(|edge| !edge.mates.is_empty()) {
                assert!(edge.difference_mm.unwrap() < 1e-6, "{name} {edge:?}");
            }
        }
    }
}

fn is_off(finding: &sheetwright::check::Finding) -> bool {
    matches!(finding.kind, FindingKind::OffTolerance { .. })
}

fn arc(radius: f64) -> Vec<Point3> {
    let on = |n: i32| {
        Point3::new(radius * cos(0.05 * f64::from(n)), radius * sin(0.05 * f64::from(n)), 0.0)
    };
    (0..=30).map(on).collect()
}

#[test]
fn a_tolerance_beyond_reach_ends_at_the_limit() {
    let design = between(CurveKind::Spline, &arc(300.0), 1e-9);
    assert_eq!(samples(&design), MOST_BY_TOLERANCE[0]);
    let mut wide = design.clone();
    wide.panels[0] = wide.panels[0].clone().within_mm(900.0);
    assert_eq!(samples(&wide), FEWEST_ON_RAIL);
}

#[test]
fn the_limit_is_said_in_numbers() {
    let mut design = between(CurveKind::Spline, &arc(300.0), 1e-9);
    // As if a tolerance gave no more.
    design.panels[0].tolerance = None;
    design.panels[0].samples = MOST_BY_TOLERANCE[0];
    let count = make(&design, &mut Unwatched).unwrap().parts.remove(0);
    assert!(!count.checked.findings.iter().any(is_off), "a number that is given wins");
    design.panels[0] = design.panels[0].clone().within_mm(1e-9);
    let part = make(&design, &mut Unwatched).unwrap().parts.remove(0);
    let found = part.checked.findings.iter().find(|finding| is_off(finding)).unwrap();
    let FindingKind::OffTolerance { distance_mm, samples, is_most, is_rails, .. } = found.kind
    else {
        panic!()
    };
    assert!(is_most && is_rails && samples == MOST_BY_TOLERANCE[0] && distance_mm > 1e-9);
}

#[test]
fn the_usual_samples_are_more_where_curves_wind_and_no_fewer() {
    assert_eq!(samples(&Design::between("arc", rails(&arc(300.0)))), 200);
    let coil = |n: usize| {
        let a = 0.1 * n as f64;
        Point3::new(300.0 * cos(a), 300.0 * sin(a), 5.0 * a)
    };
    let coil: Vec<Point3> = (0..=88).map(coil).collect();
    let design = Design::between("coil", rails(&coil));
    let counted = Counts::default().of(&design).into_owned();
    let samples = counted.panels[0].samples;
    assert!(samples > 250 && samples < MOST_USUAL[0], "{samples}");
    assert_eq!(counted.panels[0].tolerance, Some(SampleTolerance::USUAL));
    // The usual tolerance does not take ten times as long.
    let part = make(&zigzag(), &mut Unwatched).unwrap().parts.remove(0);
    assert_eq!(part.found().unwrap().boundary.len(), MOST_USUAL[1]);
    let off = part.checked.findings.iter().find(|finding| is_off(finding)).unwrap();
    assert_eq!(off.severity(), Severity::Note);
}

/// A circle of 200 mm of which every second handle of a quarter is far above or below.
fn zigzag() -> Design {
    let on = |n: usize| {
        let a = TAU * n as f64 / 32.0;
        let z = if n < 8 { [90.0, 0.0, -90.0, 0.0][n % 4] } else { 0.0 };
        [100.0 * cos(a), 100.0 * sin(a), z]
    };
    Design::inside("zigzag", DesignCurve::spline("rim", (0..32).map(on)).closed(), Vec::new())
}

fn rails(points: &[Point3]) -> [DesignCurve; 2] {
    let lifted = points.iter().map(|p| Point3::new(p.x, p.y, p.z + 100.0)).collect();
    [drawn("low", CurveKind::Spline, points.to_vec()), drawn("high", CurveKind::Spline, lifted)]
}

#[test]
fn rows_of_a_table_have_no_curves_and_straight_edges_are_exact() {
    let square = [[0., 0.], [90., 0.], [90., 60.], [0., 60.]];
    let points: Vec<CurvePoint> =
        square.iter().map(|&[x, y]| CurvePoint::corner(Point3::new(x, y, 0.0))).collect();
    let rim = |kind| DesignCurve { name: "rim".into(), kind, closed: true, points: points.clone() };
    let made = |kind| {
        let design = Design::inside("plate", rim(kind), Vec::new());
        make(&design, &mut Unwatched).unwrap().parts.remove(0)
    };
    let rows = made(None);
    assert_eq!(rows.found().unwrap().boundary.len(), 4);
    assert_eq!(rows.found().unwrap().chords.distance_max_mm(), None);
    assert_eq!(rows.curve_shorter_mm(&rows.edges[0]), None);
    let straight = made(Some(CurveKind::Polyline));
    let chords = &straight.found().unwrap().chords;
    assert!(chords.distance_max_mm().unwrap() < 1e-12 && chords.shorter_max_mm().unwrap() < 1e-9);
}

/// Three planks between four rails, of which the middle one is the most curved.
fn planks(tolerance_mm: f64) -> Design {
    let rail = |name: &str, z: f64, bulge: f64| {
        let on = |n: usize| {
            let x = 100.0 * n as f64;
            Point3::new(x, bulge * sin(PI * x / 1000.0), z)
        };
        drawn(name, CurveKind::Spline, (0..=10).map(on).collect())
    };
    let plank = |name: &str, rails: [&str; 2]| {
        let along = |rail: &str| CurveUse { name: rail.into(), reversed: false };
        DesignPanel::new(name, PanelShape::Rails(rails.map(along)), 0).within_mm(tolerance_mm)
    };
    Design {
        name: "hull".into(),
        curves: vec![
            rail("a", 0., 20.),
            rail("b", 90., 60.),
            rail("c", 180., 150.),
            rail("d", 270., 160.),
        ],
        panels: vec![
            plank("one", ["a", "b"]),
            plank("two", ["b", "c"]),
            plank("three", ["c", "d"]),
        ],
        ..Design::default()
    }
}

#[test]
fn panels_that_share_a_rail_have_as_many_samples() {
    let design = planks(0.05);
    let counted = Counts::default().of(&design).into_owned();
    let counts: Vec<usize> = counted.panels.iter().map(|panel| panel.samples).collect();
    assert!(counts[0] > FEWEST_ON_RAIL && counts.iter().all(|&n| n == counts[0]), "{counts:?}");
    for part in make(&design, &mut Unwatched).unwrap().parts {
        for edge in part.edges.iter().filter(|edge| !edge.mates.is_empty()) {
            assert!(edge.difference_mm.unwrap() < 1e-9);
        }
    }
}

#[test]
fn a_design_that_is_edited_comes_to_what_making_it_does() {
    let mut live = Live::new(planks(0.2), &mut Unwatched);
    for step in 0..4 {
        let to = Point3::new(500.0, 170.0 + 40.0 * f64::from(step), 270.0);
        live.move_point(3, 5, to, &mut Unwatched);
        live.settle(&mut Unwatched);
        assert_eq!(live.made(), make(live.design(), &mut Unwatched), "{step}");
    }
}

#[test]
fn a_design_that_was_moved_keeps_its_numbers() {
    let mut design = planks(0.2);
    design.vary = vec![Vary { limit_mm: Some(2.0), ..Vary::default() }];
    let made = make(&design, &mut Unwatched).unwrap();
    let moved = made.moved.as_ref().unwrap();
    assert!(moved.panels.iter().all(|panel| panel.tolerance.is_none()));
    let again = make(moved, &mut Unwatched).unwrap();
    for (part, again) in made.parts.iter().zip(&again.parts) {
        assert_eq!(part.flat, again.flat);
    }
}

#[test]
fn joined_panels_stay_within_the_tolerance_too() {
    use sheetwright::boundary::{Continuity, Within};
    use sheetwright::design::Join;
    let mut design = planks(0.1);
    let join = Join {
        parts: vec!["one".into(), "two".into()],
        smooth: Continuity::G0,
        within: Within::default(),
        keep_parts: false,
    };
    let whole = DesignPanel::new("whole", PanelShape::Join(join), 0).within_mm(0.1);
    design.panels.push(whole);
    let parts = make(&design, &mut Unwatched).unwrap().parts;
    let whole = parts.iter().find(|part| part.name == "whole").unwrap();
    let chords = &whole.found().unwrap().chords;
    assert!(chords.distance_max_mm().unwrap() <= 0.1 && chords.shorter_max_mm().unwrap() <= 0.101);
    assert!(!whole.checked.findings.iter().any(is_off));
}
