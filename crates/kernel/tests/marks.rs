//! Marks on faces: stations lie on their planes and where an independent development has them,
//! every line lies inside the finished outline, and what can't be made is said.

#![allow(clippy::unwrap_used, reason = "a test that can't go on fails")]

use sheetwright::check::FindingKind;
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{
    Axis, Design, DesignCurve, Mark, MarkAt, MarkKind, MarkOn, MarkWay, StationPlaces, StationPlane,
};
use sheetwright::make::{Judging, Live, Made, MakeCause, Part, make_judged};
use sheetwright::mark::{MarkFault, MarkNote};
use sheetwright::math::{Point2, Point3, Vec2, Vec3, cos, from_deg, sin};
use sheetwright::pattern::{LabelKind, PathKind, PatternPath, Role};
use sheetwright::template::{catalogue, template};
use sheetwright::watch::Unwatched;
use std::f64::consts::PI;

fn on_all(kind: MarkKind) -> Mark {
    Mark { on: vec![MarkOn::All], kind }
}

fn on(part: &str, kind: MarkKind) -> Mark {
    Mark { on: vec![MarkOn::Part { name: part.to_owned() }], kind }
}

fn stations(axis: Axis, at: &[f64]) -> MarkKind {
    let planes = at.iter().map(|&at| StationPlane { at, name: None }).collect();
    MarkKind::Stations { axis, at: StationPlaces::Listed { planes } }
}

fn made(mut design: Design, marks: Vec<Mark>) -> Made {
    design.marks = marks;
    make_judged(&design, Judging::Quick, &mut Unwatched).unwrap()
}

fn of_template(name: &str) -> Design {
    template(name).unwrap().defaults().design().unwrap()
}

fn of_kind(part: &Part, kind: PathKind) -> Vec<&PatternPath> {
    part.piece.paths.iter().filter(|path| path.kind == kind).collect()
}

fn notes(made: &Made) -> Vec<&MarkNote> {
    let findings = made.parts.iter().flat_map(|part| &part.checked.findings);
    let noted = findings.filter_map(|finding| match &finding.kind {
        FindingKind::Marked { note } => Some(note),
        _ => None,
    });
    noted.collect()
}

/// The point in space of a point of the pattern that lies on a side of a triangle.
fn refolded(part: &Part, at: Point2) -> Point3 {
    let mesh = part.sheet.mesh();
    let ends = |n: usize| mesh.edges()[n].ends;
    let flat = |n: usize| ends(n).map(|v| part.flat.points[v.get()]);
    let off = |n: usize| at.distance_to_segment(flat(n));
    let nearest = (0..mesh.edges().len()).min_by(|&a, &b| off(a).total_cmp(&off(b))).unwrap();
    assert!(off(nearest) < 1e-9, "{at:?} lies {} mm from a side", off(nearest));
    let [a, b] = flat(nearest);
    let share = (at - a).dot(b - a) / (b - a).length_squared();
    let [a, b] = ends(nearest).map(|v| mesh.position(v));
    a.lerp(b, share)
}

#[test]
fn stations_fold_back_into_their_planes_on_every_template() {
    let mut curves = 0;
    for template in catalogue() {
        let design = template.defaults().design().unwrap();
        let points = design.curves.iter().flat_map(|curve| &curve.points).map(|point| point.at);
        let points: Vec<Point3> = points.collect();
        let mut marks = Vec::new();
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            let places = points.iter().map(|&p| axis.of(p));
            let (low, high) = places.fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
            if high - low > 1.0 {
                let at = [0.0, 0.21, 0.5, 0.83, 1.0].map(|share| low + share * (high - low));
                marks.push(on_all(stations(axis, &at)));
            }
        }
        for mark in marks {
            let MarkKind::Stations { axis, at: StationPlaces::Listed { planes } } = &mark.kind
            else {
                panic!()
            };
            let (axis, planes) = (*axis, planes.clone());
            let made = made(design.clone(), vec![mark]);
            for part in &made.parts {
                for path in of_kind(part, PathKind::Station) {
                    curves += 1;
                    assert!(path.role == Role::Engrave && path.points.len() > 1);
                    let first = axis.of(refolded(part, path.points[0]));
                    let off = |plane: &StationPlane| (plane.at - first).abs();
                    let plane = planes.iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
                    for &at in &path.points {
                        let off = axis.of(refolded(part, at)) - plane.at;
                        assert!(off.abs() < 1e-9, "{}: {off:e}", template.name);
                    }
                }
            }
        }
    }
    assert!(curves > 200, "{curves}");
}

#[test]
fn frames_of_a_dinghy_are_where_its_rulings_pass_them() {
    let frames = [600.0, 1300.0, 2100.0];
    let made = made(of_template("dinghy"), vec![on_all(stations(Axis::X, &frames))]);
    let mut passed = 0;
    for part in made.parts.iter().filter(|part| part.name != "transom") {
        let curves = of_kind(part, PathKind::Station);
        assert_eq!(curves.len(), 3, "{}", part.name);
        for ends in part.sheet.rung_ends() {
            let [a, b] = ends.map(|v| part.sheet.mesh().position(v));
            for at in frames {
                if (a.x - at) * (b.x - at) >= 0.0 {
                    continue;
                }
                // Where the ruling passes the frame, by similar triangles; on the pattern, as far
                // from both its ends.
                let to_a = a.distance(b) * (at - a.x).abs() / ((at - a.x).abs() + (b.x - at).abs());
                let to_b = a.distance(b) - to_a;
                let [flat_a, flat_b] = ends.map(|v| part.flat.points[v.get()]);
                let off = |p: &Point2| {
                    (p.distance(flat_a) - to_a).abs().max((p.distance(flat_b) - to_b).abs())
                };
                let all = curves.iter().flat_map(|curve| &curve.points);
                let nearest = all.map(off).fold(f64::INFINITY, f64::min);
                assert!(nearest < 1e-6, "{} at {at}: {nearest:e}", part.name);
                passed += 1;
            }
        }
    }
    assert!(passed > 20, "{passed}");
}

/// Half of a tube of radius 200 about y, from y = 0 to 500.
fn half_tube(samples: usize) -> Design {
    let rail = |name: &str, y: f64| {
        let at = |n: usize| {
            let angle = PI * n as f64 / (samples - 1) as f64;
            CurvePoint::smooth(Point3::new(-200.0 * cos(angle), y, 200.0 * sin(angle)))
        };
        let points = (0..samples).map(at).collect();
        DesignCurve { name: name.to_owned(), kind: None, closed: false, points }
    };
    let mut design = Design::between("tube", [rail("a", 0.0), rail("b", 500.0)]);
    design.panels[0].samples = samples;
    design
}

#[test]
fn a_slanting_cut_of_a_tube_is_the_sine_that_tinsmiths_draw() {
    // The tube stands aslant, so that a plane of one height cuts it in an ellipse: on the flat, a
    // sine.
    let (s, c) = (0.6, 0.8);
    let mut design = half_tube(201);
    for point in design.curves.iter_mut().flat_map(|curve| &mut curve.points) {
        let p = point.at;
        point.at = Point3::new(p.x, c * p.y - s * p.z, s * p.y + c * p.z);
    }
    let made = made(design, vec![on_all(stations(Axis::Z, &[250.0]))]);
    let part = &made.parts[0];
    let [curve] = of_kind(part, PathKind::Station)[..] else { panic!() };
    let step = 2.0 * 200.0 * sin(0.5 * PI / 200.0);
    let mut seen = 0;
    let corner = |x: f64, y: f64| {
        // The sheet may lie either way round, so places are compared by their distances.
        let own = |n: usize| part.sheet.mesh().position(sheetwright::index::VertexIndex::new(n));
        let (mut best, mut found) = (f64::MAX, Point2::default());
        for n in 0..part.flat.points.len() {
            let p = own(n);
            let back = Point3::new(p.x, c * p.y + s * p.z, -s * p.y + c * p.z);
            let off = (back.x - x).abs() + (back.y - y).abs() + back.z.abs();
            if off < best {
                (best, found) = (off, part.flat.points[n]);
            }
        }
        assert!(best < 1e-6, "{best}");
        found
    };
    let (origin, along, across) = (corner(-200.0, 0.0), corner(200.0, 0.0), corner(-200.0, 500.0));
    let (along, across) = (along - origin, across - origin);
    for n in 0..=200u32 {
        let angle = PI * f64::from(n) / 200.0;
        // s y + c z = 250 on the ruling at this angle.
        let y = (250.0 - c * 200.0 * sin(angle)) / s;
        let wanted = Vec2::new(f64::from(n) * step, y);
        let is_it = |p: &&Point2| {
            let way = **p - origin;
            let own = Vec2::new(way.dot(along) / along.length(), way.dot(across) / across.length());
            (own - wanted).length() < 1e-6
        };
        seen += usize::from(curve.points.iter().any(|p| is_it(&p)));
    }
    assert_eq!(seen, 201);
}

#[test]
fn a_pitch_gives_the_planes_that_cross_the_part_and_a_name_to_each() {
    let at = StationPlaces::Every { pitch: 100.0, from: 50.0 };
    let made = made(half_tube(101), vec![on_all(MarkKind::Stations { axis: Axis::Y, at })]);
    let part = &made.parts[0];
    assert_eq!(of_kind(part, PathKind::Station).len(), 5);
    let texts = part.piece.labels.iter().filter(|label| label.kind == LabelKind::OnFace);
    let mut texts: Vec<&str> = texts.map(|label| label.text.as_str()).collect();
    texts.sort_unstable();
    assert_eq!(texts, ["y 150", "y 250", "y 350", "y 450", "y 50"]);
    assert_eq!(notes(&made), Vec::<&MarkNote>::new());
}

#[test]
fn stations_along_the_border_are_no_curves_and_no_fault() {
    let made = made(half_tube(101), vec![on_all(stations(Axis::Y, &[0.0, 500.0, 501.0]))]);
    assert_eq!(of_kind(&made.parts[0], PathKind::Station).len(), 0);
    let [MarkNote::StationMissed { name, at_mm, reach_mm, .. }] = notes(&made)[..] else {
        panic!("{:?}", notes(&made))
    };
    assert_eq!((&name[..], *at_mm, *reach_mm), ("y 501", 501.0, [0.0, 500.0]));
}

/// All kinds of marks at once.
fn everything(size_mm: f64) -> Vec<Mark> {
    let face = |toward| MarkKind::Face { text: "outside".to_owned(), toward, length: 50.0 };
    let grain = |way| MarkKind::Grain { way, length: 0.5 * size_mm };
    vec![
        on_all(MarkKind::Stations {
            axis: Axis::X,
            at: StationPlaces::Every { pitch: 0.2 * size_mm, from: 0.0 },
        }),
        on_all(face(Vec3::Z)),
        on_all(face(Vec3::X)),
        on_all(grain(MarkWay::Angle { angle: from_deg(30.0) })),
        on_all(grain(MarkWay::Space { way: Vec3::Y })),
        on_all(MarkKind::Text { at: None, text: "front".to_owned(), height: Some(7.0) }),
    ]
}

/// Whether a point lies inside some loops, or within a tolerance of them: counted along a ray.
fn is_inside(loops: &[&[Point2]], at: Point2) -> bool {
    let sides = || {
        loops.iter().flat_map(|line| {
            line.iter().copied().zip(line.iter().copied().cycle().skip(1)).collect::<Vec<_>>()
        })
    };
    let passes = sides().filter(|&(a, b)| {
        (a.y > at.y) != (b.y > at.y) && at.x < a.x + (b.x - a.x) * (at.y - a.y) / (b.y - a.y)
    });
    passes.count() % 2 == 1 || sides().any(|(a, b)| at.distance_to_segment([a, b]) < 1e-7)
}

#[test]
fn every_mark_lies_inside_the_finished_outline() {
    let mut drawn = 0;
    for template in catalogue() {
        let design = template.defaults().design().unwrap();
        let marks = everything(design.extent_mm());
        for part in made(design, marks).parts.iter().filter(|part| part.flat.overlap.is_none()) {
            let loops: Vec<&[Point2]> = part.piece.net_loops().collect();
            for path in &part.piece.paths {
                if !matches!(path.kind, PathKind::Station | PathKind::Grain | PathKind::Arrow) {
                    continue;
                }
                drawn += 1;
                for pair in path.points.windows(2) {
                    for n in 0..=20 {
                        let at = pair[0].lerp(pair[1], f64::from(n) / 20.0);
                        assert!(is_inside(&loops, at), "{} {:?} {at:?}", part.name, path.kind);
                    }
                }
            }
        }
    }
    assert!(drawn > 300, "{drawn}");
}

#[test]
fn a_hole_in_space_is_drilled_where_the_part_passes_it() {
    // The tube at 60 degrees and y = 120, 0.4 mm off its surface.
    let angle = from_deg(60.0);
    let off = |by: f64| Point3::new(-(200.0 + by) * cos(angle), 120.0, (200.0 + by) * sin(angle));
    let drill = |at, within| MarkKind::Drill { at: MarkAt::Space { at, within }, diameter: 6.0 };
    let design = half_tube(181);
    let made = made(design, vec![on_all(drill(off(0.4), 1.0)), on_all(drill(off(8.0), 1.0))]);
    let part = &made.parts[0];
    let [hole] = of_kind(part, PathKind::Drill { diameter_mm: 6.0 })[..] else { panic!() };
    let sum: Vec2 = hole.points.iter().map(|p| p.to_vec()).sum();
    let middle = Point2::default() + sum * (1.0 / hole.points.len() as f64);
    let flat = |n: usize| part.flat.points[n];
    // The sample at 60 degrees of each rail lies as far from the middle as in space.
    let near = |y: f64| {
        let to = Point3::new(-200.0 * cos(angle), y, 200.0 * sin(angle));
        let off = |n: &usize| part.sheet.mesh().positions()[*n].distance(to);
        (0..part.flat.points.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap()
    };
    assert!((middle.distance(flat(near(0.0))) - 120.0).abs() < 1e-6);
    assert!((middle.distance(flat(near(500.0))) - 380.0).abs() < 1e-6);
    let [MarkNote::PlaceFar { what, off_mm, within_mm, .. }] = notes(&made)[..] else { panic!() };
    assert!(what == "drill" && (off_mm - 8.0).abs() < 1e-6 && *within_mm == 1.0);
}

#[test]
fn what_reaches_over_the_edge_or_points_through_the_part_is_said() {
    let flat = |x: f64, y: f64| MarkAt::Flat { at: Point2::new(x, y) };
    let drill = |at| MarkKind::Drill { at, diameter: 10.0 };
    let text = |at| MarkKind::Text { at: Some(at), text: "here".to_owned(), height: None };
    let plate = |name: &str, z: f64| {
        let at = |n: u32| CurvePoint::smooth(Point3::new(10.0 * f64::from(n), z, 0.0));
        let points = (0..=40).map(at).collect();
        DesignCurve {
            name: name.to_owned(),
            kind: Some(CurveKind::Polyline),
            closed: false,
            points,
        }
    };
    let design = Design::between("plate", [plate("a", 0.0), plate("b", 200.0)]);
    let face = |toward| MarkKind::Face { text: "up".to_owned(), toward, length: 50.0 };
    let made = made(
        design,
        vec![
            on_all(drill(flat(4.0, 50.0))),
            on_all(drill(flat(6.0, 50.0))),
            on_all(text(flat(-3.0, 50.0))),
            on_all(face(Vec3::Z)),
            on_all(face(Vec3::X)),
            on_all(MarkKind::Fold { edge: "a".to_owned() }),
        ],
    );
    let part = &made.parts[0];
    assert_eq!(of_kind(part, PathKind::Drill { diameter_mm: 10.0 }).len(), 1);
    let [arrow] = of_kind(part, PathKind::Arrow)[..] else { panic!() };
    assert!((arrow.points[0].distance(arrow.points[1]) - 50.0).abs() < 1e-9);
    let [fold] = of_kind(part, PathKind::OnFold)[..] else { panic!() };
    let folded = fold.points[0].distance(fold.points[fold.points.len() - 1]);
    assert!((folded - 400.0).abs() < 1e-9, "{folded}");
    assert!(part.piece.labels.iter().any(|label| label.text == "cut on fold"));
    let said: Vec<String> = notes(&made).iter().map(|note| format!("{note:?}")).collect();
    assert_eq!(said.len(), 3, "{said:?}");
    assert!(said[0].starts_with("OverTheEdge { what: \"drill\", at: Point2 { x: 4.0"), "{said:?}");
    assert!(said[1].starts_with("OverTheEdge { what: \"text\""), "{said:?}");
    assert!(said[2].starts_with("SquareToPart { what: \"face\""), "{said:?}");
}

#[test]
fn a_curved_edge_can_not_lie_on_a_fold() {
    let made =
        made(of_template("dinghy"), vec![on("side", MarkKind::Fold { edge: "sheer".into() })]);
    let [MarkNote::CurvedFold { edge, off_mm }] = notes(&made)[..] else { panic!() };
    assert!(edge == "side/sheer" && *off_mm > 10.0, "{off_mm}");
}

#[test]
fn parts_and_edges_that_are_not_there_are_refused() {
    let refused = |mark: Mark| {
        let design = Design { marks: vec![mark], ..of_template("dinghy") };
        let error = make_judged(&design, Judging::Quick, &mut Unwatched).unwrap_err();
        let MakeCause::Mark(fault) = error.cause else { panic!("{error}") };
        fault
    };
    let fault = refused(on("sail", stations(Axis::X, &[1.0])));
    let MarkFault::NoSuchPart { wanted, known } = fault else { panic!("{fault}") };
    assert_eq!((&wanted[..], &known.join(" ")[..]), ("sail", "bottom side transom"));
    let fault = refused(on("side", MarkKind::Fold { edge: "keel".to_owned() }));
    assert!(matches!(&fault, MarkFault::NoSuchEdge { wanted, .. } if wanted == "keel"), "{fault}");
    let along = |edge: &str| MarkWay::Edge { edge: edge.to_owned() };
    let fault = refused(on_all(MarkKind::Grain { way: along("mast"), length: 9.0 }));
    assert!(matches!(&fault, MarkFault::NoSuchEdge { .. }), "{fault}");
    let at = StationPlaces::Every { pitch: 0.1, from: 0.0 };
    let fault = refused(on_all(MarkKind::Stations { axis: Axis::X, at }));
    assert!(matches!(&fault, MarkFault::TooManyStations { most: 1000, .. }), "{fault}");
}

#[test]
fn a_live_design_has_the_marks_of_a_made_one() {
    let mut design = Design { marks: everything(3000.0), ..of_template("dinghy") };
    let mut live = Live::new(design.clone(), &mut Unwatched);
    assert_eq!(live.made(), sheetwright::make(&design, &mut Unwatched));
    let drawn = live.trimmed().unwrap();
    let stations = |part: &Part| of_kind(part, PathKind::Station).len();
    assert_eq!(drawn[0].as_ref().map(|parts| stations(&parts[0])), Ok(4));
    design.marks = vec![on("sail", stations_at())];
    live.update(design.clone(), &mut Unwatched);
    let drawn = live.trimmed().unwrap();
    assert!(drawn[0].is_err() && drawn[1].is_ok());
    design.marks.clear();
    live.update(design.clone(), &mut Unwatched);
    assert_eq!(live.made(), sheetwright::make(&design, &mut Unwatched));
}

fn stations_at() -> MarkKind {
    stations(Axis::X, &[100.0])
}
