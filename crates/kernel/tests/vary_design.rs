//! Designs whose curves move.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright::boundary::size_of;
use sheetwright::check::{FindingKind, Place, Severity};
use sheetwright::cost::DEFAULT_FOLD;
use sheetwright::curve::{CurveKind, CurvePoint, Sample};
use sheetwright::design::VaryGoal;
use sheetwright::design::{
    CurveUse, Design, DesignCurve, DesignPanel, Join, MovedBy, PanelShape, Vary,
};
use sheetwright::fair::Ended;
use sheetwright::fair::VaryCause;
use sheetwright::index::VertexIndex;
use sheetwright::make::{Made, MakeCause, Part, make};
use sheetwright::math::{Point3, cos, from_deg, sin, to_deg};
use sheetwright::template::{NamedCurve, Value, template};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::hull::planks;
use sheetwright_shapes::random::Random;

fn curve(name: &str, kind: CurveKind, points: Vec<Point3>) -> DesignCurve {
    let points = points.into_iter().map(CurvePoint::smooth).collect();
    DesignCurve { name: name.into(), kind: Some(kind), closed: false, points }
}

fn uses(list: &[&str]) -> Vec<CurveUse> {
    let one = |name: &&str| CurveUse {
        name: name.trim_start_matches('-').into(),
        reversed: name.starts_with('-'),
    };
    list.iter().map(one).collect()
}

fn rails(a: &str, b: &str) -> PanelShape {
    PanelShape::Rails(<[CurveUse; 2]>::try_from(uses(&[a, b])).unwrap())
}

fn outline(list: &[&str]) -> PanelShape {
    PanelShape::Loops { outer: uses(list), holes: Vec::new() }
}

fn made(design: &Design) -> Made {
    make(design, &mut Unwatched).unwrap()
}

fn size(made: &Made) -> f64 {
    size_of(made.parts.iter().flat_map(|p| p.found().unwrap().boundary.positions()))
}

fn hull(samples: usize, vary: Vary) -> Design {
    Design { vary: vec![vary], ..planks(samples, DEFAULT_FOLD) }
}

/// The samples of a panel that lie where those of another do.
fn shared<'a>(a: &'a Part, b: &Part) -> Vec<(usize, &'a Sample)> {
    let theirs = b.found().unwrap().boundary.positions();
    let of_a = a.found().unwrap().boundary.samples().iter().enumerate();
    of_a.filter(|(_, sample)| theirs.contains(&sample.position)).collect()
}

/// How long the shared line is on the flat pattern of a panel, mm.
fn flat_length(panel: &Part, on_seam: &[(usize, &Sample)]) -> f64 {
    let is_on = |i: usize| on_seam.iter().any(|(n, _)| *n == i);
    let m = panel.found().unwrap().boundary.len();
    let edges = (0..m).filter(|&i| is_on(i) && is_on((i + 1) % m));
    let flat = |i: usize| panel.flat.points[i];
    assert_eq!(panel.sheet.origin(VertexIndex::new(0)).get(), 0, "nothing is cut open");
    edges.map(|i| flat(i).distance(flat((i + 1) % m))).sum()
}

/// Published \[ZB18\]: at most 5.6°, 0.52° in the mean, with data moved by at most 0.065 % of the
/// size of the model. Here the 13 points of each curve move, or each of its samples.
#[test]
fn the_hull_bends_as_a_design_with_less_moved_than_published() {
    let still = made(&hull(200, Vary { limit_mm: Some(0.0), ..Vary::default() }));
    let size = size(&still);
    for (by, most) in [(MovedBy::Points, 0.000_65), (MovedBy::Samples, 0.000_2)] {
        let goal = VaryGoal::Warp { largest: from_deg(5.6) };
        let limit_mm = Some(0.000_65 * size);
        let design = hull(200, Vary { goal, limit_mm, by, ..Vary::default() });
        let made = made(&design);
        let warp = made.parts.iter().map(|p| p.measures.warp_max).fold(0.0, f64::max);
        let rungs: Vec<f64> = made.parts.iter().map(|p| p.measures.rungs.len() as f64).collect();
        let sum: f64 = made.parts.iter().zip(&rungs).map(|(p, n)| p.measures.warp_mean * n).sum();
        let mean = sum / rungs.iter().sum::<f64>();
        let changes: Vec<_> = made.parts.iter().map(|p| p.change().unwrap()).collect();
        let share = changes.iter().map(|c| c.moved_max_mm()).fold(0.0, f64::max) / size;
        println!("{by:?}: {:.2}° / {:.3}°, {:.4} %", to_deg(warp), to_deg(mean), 100.0 * share);
        assert!(warp <= from_deg(5.6) && mean <= from_deg(0.52));
        assert!(share <= most * (1.0 + 1e-9), "{share}");
        assert!(changes.iter().all(|c| c.ended == Ended::Reached));
        assert!(changes.iter().all(|c| c.before.change().is_none()));
        for pair in made.parts.windows(2) {
            let (ours, theirs) = (shared(&pair[0], &pair[1]), shared(&pair[1], &pair[0]));
            assert_eq!((ours.len(), theirs.len()), (200, 200));
            let lengths = [flat_length(&pair[0], &ours), flat_length(&pair[1], &theirs)];
            assert!((lengths[0] - lengths[1]).abs() <= 1e-9 * lengths[0], "{lengths:?}");
        }
        // The moved design is a design like any other, and what was made is what it makes.
        let again = make(made.moved.as_ref().unwrap(), &mut Unwatched).unwrap();
        for (one, other) in made.parts.iter().zip(&again.parts) {
            assert_eq!(one.found().unwrap().boundary, other.found().unwrap().boundary);
            assert_eq!(one.found().unwrap().triangulation, other.found().unwrap().triangulation);
        }
    }
}

/// Two twisted sheets of different length, side by side: their outlines share the seam, which each
/// runs its own way, and their own numbers of samples would divide it differently.
fn quilt(random: &mut Random, kind: CurveKind) -> Design {
    let mut at = |x: f64, y: f64, z: f64| {
        let mut off = || 6.0 * (random.unit() - 0.5);
        Point3::new(x + off(), y + off(), z + off())
    };
    let [low, high] = [at(0., 0., 0.), at(0., 100., 0.)];
    let [west_low, west_high] = [at(-150., 0., -70.), at(-150., 100., 70.)];
    let [east_low, east_high] = [at(90., 0., 50.), at(90., 100., -50.)];
    let between = |a: Point3, b: Point3, middle: Point3| {
        let third = |share: f64| a.lerp(b, share).lerp(middle, 0.4);
        vec![a, third(0.3), third(0.7), b]
    };
    let seam = between(low, high, at(12., 50., 8.));
    let west: Vec<Point3> = [
        between(low, west_low, at(-70., 0., -10.)),
        between(west_low, west_high, at(-155., 50., 0.)),
        between(west_high, high, at(-70., 100., 15.)),
    ]
    .concat();
    let east: Vec<Point3> = [
        between(low, east_low, at(50., 0., 12.)),
        between(east_low, east_high, at(95., 50., 0.)),
        between(east_high, high, at(50., 100., -8.)),
    ]
    .concat();
    let around = |name: &str, mut points: Vec<Point3>| {
        points.dedup();
        let mut around = curve(name, kind, points);
        around.points[3].corner = true;
        around.points[6].corner = true;
        around
    };
    let curves = vec![curve("seam", kind, seam), around("west", west), around("east", east)];
    let panels = vec![
        DesignPanel::new("left", outline(&["west", "-seam"]), 70),
        DesignPanel::new("right", outline(&["seam", "-east"]), 90),
    ];
    Design { name: "quilt".into(), curves, panels, ..Design::default() }
}

#[test]
fn seams_of_outlines_stay_one_line() {
    let mut gained = 0;
    for seed in 0..8 {
        let mut random = Random::new(900 + seed);
        let kind = [CurveKind::Spline, CurveKind::BSpline, CurveKind::Polyline][seed as usize % 3];
        let mut design = quilt(&mut random, kind);
        let by = if seed % 2 == 0 { MovedBy::Points } else { MovedBy::Samples };
        let curves = if seed < 4 { vec!["seam".to_owned()] } else { Vec::new() };
        design.vary = vec![Vary {
            limit_mm: Some(2.0),
            by,
            curves: curves.clone(),
            leave_developable: false,
            ..Vary::default()
        }];
        let found = made(&design);
        let [left, right] = found.parts.as_slice() else { panic!() };
        let changes = [left, right].map(|p| p.change().unwrap());
        let price = |panels: [&Part; 2]| -> f64 {
            panels.iter().map(|p| p.found().unwrap().triangulation.price).sum()
        };
        let twist =
            |panels: [&Part; 2]| -> f64 { panels.iter().map(|p| p.measures.twist_total).sum() };
        let before = changes.map(|c| &*c.before);
        println!(
            "{seed} {kind:?}: {:.3e} -> {:.3e} {}",
            price(before),
            price([left, right]),
            changes[0].ended
        );
        assert!(price([left, right]) <= price(before));
        assert!(twist([left, right]) <= twist(before) * (1.0 + 1e-12));
        gained += usize::from(price([left, right]) < 0.98 * price(before));
        for change in changes {
            assert!(change.moved_max_mm() <= 2.0 * (1.0 + 1e-9), "{}", change.moved_max_mm());
        }
        // Both copies of the seam are the same bits, run either way, before and after.
        for [a, b] in [[left, right], before] {
            let (ours, theirs) = (shared(a, b), shared(b, a));
            assert_eq!(ours.len(), theirs.len());
            assert!(ours.len() > 15, "{}", ours.len());
            let lengths = [flat_length(a, &ours), flat_length(b, &theirs)];
            assert!((lengths[0] - lengths[1]).abs() <= 1e-9 * lengths[0], "{lengths:?}");
        }
        // What may not move keeps its bits.
        let moved = found.moved.unwrap_or_else(|| design.clone());
        for (is, was) in moved.curves.iter().zip(&design.curves) {
            assert!(is.name == "seam" || curves.is_empty() || is.points == was.points);
        }
        // The ends of the seam are the ends of the others.
        let end = |name: &str, last: bool| {
            let points = &moved.curves.iter().find(|c| c.name == name).unwrap().points;
            points[if last { points.len() - 1 } else { 0 }].at
        };
        for last in [false, true] {
            assert!(end("seam", last).distance(end("west", last)) < 1e-9);
            assert!(end("seam", last).distance(end("east", last)) < 1e-9);
        }
    }
    assert!(gained >= 6, "{gained}");
}

#[test]
fn a_budget_holds_over_all_samples_and_points_keep_their_own_limits() {
    let mut random = Random::new(77);
    for own_limits in [false, true] {
        let mut design = quilt(&mut random, CurveKind::Spline);
        if own_limits {
            design.curves[0].points[1..3].iter_mut().for_each(|point| point.move_mm = 0.5);
        }
        let budget_mm = Some(9.0);
        design.vary = vec![Vary { budget_mm, leave_developable: false, ..Vary::default() }];
        let found = made(&design);
        let changes = found.parts.iter().map(|p| p.change().unwrap());
        let mut ways: Vec<(Point3, f64)> =
            changes.flat_map(|c| &c.moved).map(|[from, to]| (*from, from.distance(*to))).collect();
        ways.sort_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.0.y.total_cmp(&b.0.y)));
        ways.dedup_by_key(|way| way.0);
        let total: f64 = ways.iter().map(|way| way.1).sum();
        println!("{total:.3} mm {}", found.parts[0].change().unwrap().ended);
        assert!(total > 0.1 && total <= 9.0 * (1.0 + 1e-9), "{total}");
        let moved = found.moved.as_ref().unwrap();
        if own_limits {
            keeps_limits(&moved.curves[0], &design.curves[0], 1..3, 0.5);
            assert_eq!(moved.curves[1].points, design.curves[1].points);
        }
    }
}

/// Points in a range have moved by so much at the most, and the others not at all.
fn keeps_limits(is: &DesignCurve, was: &DesignCurve, free: std::ops::Range<usize>, most_mm: f64) {
    for (n, (is, was)) in is.points.iter().zip(&was.points).enumerate() {
        let way = is.at.distance(was.at);
        assert!(way <= if free.contains(&n) { most_mm * (1.0 + 1e-9) } else { 0.0 }, "{n} {way}");
    }
}

#[test]
fn points_with_a_distance_move_without_more_words() {
    let mut design = twisted();
    assert!(made(&design).parts[0].change().is_none());
    design.curves[0].points[5..15].iter_mut().for_each(|point| point.move_mm = 4.0);
    let found = made(&design);
    let change = found.parts[0].change().unwrap();
    println!("{:.3} mm: {}", change.moved_max_mm(), change.ended);
    assert!(change.moved_max_mm() > 1.0);
    assert!(found.parts[0].measures.twist_total < change.before.measures.twist_total);
    let moved = found.moved.unwrap();
    keeps_limits(&moved.curves[0], &design.curves[0], 5..15, 4.0);
    // What has moved has moved: the moved design says nothing of moving on.
    assert!(moved.vary.is_empty() && moved.curves[0].points.iter().all(|p| p.move_mm == 0.0));
}

/// A quarter of a cylinder between two arcs of many points.
fn quarter() -> Design {
    let arc = |y: f64| {
        let at = |n: usize| from_deg(90.0 * n as f64 / 12.0);
        (0..13).map(|n| Point3::new(200.0 * cos(at(n)), y, 200.0 * sin(at(n)))).collect()
    };
    let curves =
        vec![curve("a", CurveKind::Spline, arc(0.0)), curve("b", CurveKind::Spline, arc(400.0))];
    let panels = vec![DesignPanel::new("quarter", rails("a", "b"), 60)];
    Design { name: "quarter".into(), curves, panels, ..Design::default() }
}

#[test]
fn what_is_developable_does_not_move() {
    for goal in [VaryGoal::Price, VaryGoal::Warp { largest: from_deg(3.0) }] {
        for by in [MovedBy::Points, MovedBy::Samples] {
            let vary = vec![Vary { goal, by, ..Vary::default() }];
            let found = made(&Design { vary, ..quarter() });
            assert!(found.moved.is_none());
            let change = found.parts[0].change().unwrap();
            assert_eq!(change.ended, Ended::NothingToDo);
            assert_eq!((change.moved_max_mm(), change.moved_total_mm()), (0.0, 0.0));
            let finding = &found.parts[0].checked.findings[0];
            assert_eq!((finding.code(), finding.severity()), ("not-moved", Severity::Note));
        }
    }
}

/// A strip that turns by a right angle about its middle line.
fn twisted() -> Design {
    let points: Vec<Point3> = (0..40)
        .map(|n| {
            let (side, n) = if n < 20 { (-1.0, n) } else { (1.0, 39 - n) };
            let along = f64::from(n) / 19.0;
            let angle = from_deg(90.0) * along;
            Point3::new(1000.0 * along, side * 100.0 * cos(angle), side * 100.0 * sin(angle))
        })
        .collect();
    let mut rim = curve("rim", CurveKind::Spline, points);
    rim.closed = true;
    let panels = vec![DesignPanel::new("strip", outline(&["rim"]), 80)];
    Design { name: "strip".into(), curves: vec![rim], panels, ..Design::default() }
}

#[test]
fn a_hopeless_strip_says_how_close_it_came() {
    let goal = VaryGoal::Warp { largest: from_deg(6.0) };
    let vary = vec![Vary { goal, ..Vary::default() }];
    let found = made(&Design { vary, ..twisted() });
    let strip = &found.parts[0];
    let change = strip.change().unwrap();
    let Ended::Closest { wanted, before, reached, resisting } = &change.ended else { panic!() };
    assert_eq!((*wanted, *reached), (from_deg(6.0), strip.measures.warp_max));
    assert_eq!(*before, change.before.measures.warp_max);
    assert!(reached < before && !resisting.is_empty());
    let finding = strip.checked.findings.iter().find(|f| f.code() == "warp-not-reached").unwrap();
    assert_eq!(finding.severity(), Severity::Warning);
    let FindingKind::WarpNotReached { movement, wanted: of_finding, ended } = &finding.kind else {
        panic!("{finding:?}")
    };
    assert_eq!((of_finding, ended), (wanted, &change.ended));
    assert_eq!(movement.warp, [*before, *reached]);
    let Place::Rungs { numbers } = &finding.place else { panic!("{finding:?}") };
    let rungs = &strip.measures.rungs;
    assert!(!numbers.is_empty() && numbers.iter().all(|&n| rungs[n].warp > *wanted));
}

#[test]
fn only_the_panels_that_are_named_must_reach_the_angle() {
    let mut random = Random::new(5);
    let mut design = quilt(&mut random, CurveKind::Spline);
    design.match_seams = true;
    let before = made(&design);
    let [left, right] = before.parts.as_slice() else { panic!() };
    let (asked, other) = if left.measures.warp_max > right.measures.warp_max {
        (left, right)
    } else {
        (right, left)
    };
    let largest = 0.9 * asked.measures.warp_max;
    design.vary = vec![Vary {
        panels: vec![asked.name.clone()],
        goal: VaryGoal::Warp { largest },
        limit_mm: Some(6.0),
        leave_developable: false,
        ..Vary::default()
    }];
    let found = made(&design);
    let after = |name: &str| found.parts.iter().find(|p| p.name == name).unwrap();
    println!(
        "{:.2}° -> {:.2}° of {:.2}°",
        to_deg(asked.measures.warp_max),
        to_deg(after(&asked.name).measures.warp_max),
        to_deg(largest)
    );
    assert!(after(&asked.name).measures.warp_max <= largest);
    // The other panel has followed: it shares the seam.
    let change = after(&other.name).change().unwrap();
    assert_eq!(change.curves, ["seam"], "{}", change.ended);
    assert!(change.moved_max_mm() > 0.0);
}

#[test]
fn what_cannot_move_is_said() {
    let refused = |design: &Design| {
        let error = make(design, &mut Unwatched).unwrap_err();
        let MakeCause::Vary(cause) = error.cause else { panic!("{error}") };
        (cause, error.curve.unwrap_or_default(), error.panel)
    };
    let mut random = Random::new(3);
    let quilt = quilt(&mut random, CurveKind::Spline);
    let of = |panel: &str| Vary { panels: vec![panel.into()], ..Vary::default() };
    let design = Design { vary: vec![of("left"), of("right")], ..quilt.clone() };
    assert_eq!(refused(&design), (VaryCause::MovedTwice, "seam".into(), String::new()));
    let cause = VaryCause::UnknownPanel { name: "middle".into() };
    let design = Design { vary: vec![of("middle")], ..quilt.clone() };
    assert_eq!(refused(&design), (cause, String::new(), String::new()));
    let vary = Vary { curves: vec!["east".into()], ..of("left") };
    let design = Design { vary: vec![vary], ..quilt.clone() };
    assert_eq!(refused(&design), (VaryCause::BoundsNothing, "east".into(), String::new()));
    let mut joined = Design { vary: vec![Vary::default()], ..quilt };
    let join = Join {
        parts: vec!["left".into(), "right".into()],
        smooth: Default::default(),
        within: Default::default(),
        keep_parts: true,
    };
    joined.panels.push(DesignPanel::new("both", PanelShape::Join(join), 90));
    assert_eq!(refused(&joined), (VaryCause::Joined, String::new(), "both".into()));
    let mut run_on = Design { vary: vec![Vary::default()], ..quarter() };
    run_on.panels[0].run_on = true;
    assert_eq!(refused(&run_on), (VaryCause::RunsOn, String::new(), "quarter".into()));
}

/// A boat of a template with these choices.
fn boat(name: &str, choices: &[(&str, &str)], lines: Option<Vec<NamedCurve>>) -> Design {
    let mut values = template(name).unwrap().defaults();
    for (parameter, choice) in choices {
        values.set(parameter, Value::Choice((*choice).to_owned())).unwrap();
    }
    lines.into_iter().for_each(|lines| values.set("table", Value::Table(lines)).unwrap());
    values.design().unwrap()
}

fn curve_of<'a>(design: &'a Design, name: &str) -> &'a DesignCurve {
    design.curves.iter().find(|curve| curve.name == name).unwrap()
}

/// Curves in the middle plane stay in it, and images are images, to the bit: of curves that have
/// one to starboard, of edges of transoms that run across, and of points where halves meet.
fn assert_mirrored(before: &Design, moved: &Design) {
    let image = |p: Point3| Point3::new(p.x, 0.0 - p.y, p.z);
    for (was, is) in before.curves.iter().zip(&moved.curves) {
        for (was, is) in was.points.iter().zip(&is.points) {
            assert!(was.at.y != 0.0 || is.at.y == 0.0, "{was:?} {is:?}");
        }
        let starboard = format!("{}-starboard", is.name);
        if let Some(other) = moved.curves.iter().find(|curve| curve.name == starboard) {
            let pairs = is.points.iter().zip(&other.points);
            pairs.for_each(|(a, b)| assert_eq!(image(a.at), b.at, "{}", is.name));
        }
        if let [a, b] = &was.points[..]
            && image(a.at) == b.at
        {
            assert_eq!(image(is.points[0].at), is.points[1].at, "{}", is.name);
        }
    }
}

/// Boats whose largest warp angle is to fall by a fifth. Their halves are drawn, or said to be cut
/// twice, once turned over.
#[test]
fn boats_stay_their_own_mirror_images() {
    let transoms = ("transoms", "yes");
    let skiff = boat("hull", &[transoms], None);
    let half = boat("hull", &[transoms, ("halves", "port")], None);
    let lines = ["chine", "sheer"].map(|name| NamedCurve {
        name: name.to_owned(),
        points: curve_of(&skiff, name).points.clone(),
    });
    let flat = boat("hull", &[transoms], Some(lines.to_vec()));
    let dinghy = boat("dinghy", &[("halves", "both")], None);
    let half_dinghy = boat("dinghy", &[], None);
    let mut missed = Vec::new();
    for mut design in [skiff, half, flat, dinghy, half_dinghy] {
        // A chine that is too wide and high aft makes planks twist.
        for chine in design.curves.iter_mut().filter(|curve| curve.name.starts_with("chine")) {
            for point in chine.points.iter_mut().skip(2).take(2) {
                (point.at.y, point.at.z) = (1.05 * point.at.y, point.at.z + 15.0);
            }
        }
        let warp = made(&design).parts.iter().map(|p| p.measures.warp_max).fold(0.0, f64::max);
        let goal = VaryGoal::Warp { largest: 0.8 * warp };
        let vary = Vary { goal, limit_mm: Some(60.0), ..Vary::default() };
        let made = made(&Design { vary: vec![vary], ..design.clone() });
        let changes = || made.parts.iter().filter_map(|part| part.change());
        let farthest = changes().map(|change| change.moved_max_mm()).fold(0.0, f64::max);
        println!("{}: {:.2}°, moved {farthest:.2} mm", design.name, to_deg(warp));
        missed.extend(changes().map(|c| c.ended.clone()).filter(|e| *e != Ended::Reached));
        assert!(farthest > 0.01, "{}: {farthest} mm", design.name);
        assert_mirrored(&design, made.moved.as_ref().unwrap());
    }
    assert_eq!(missed, []);
}

/// A panel that is named moves its curves, and with them their images; of curves that are named,
/// only those.
#[test]
fn images_move_with_the_curves_of_a_panel_but_not_with_curves_that_are_named() {
    let design = boat("hull", &[], None);
    let vary =
        Vary { panels: vec!["side-port".to_owned()], limit_mm: Some(5.0), ..Vary::default() };
    let moved = made(&Design { vary: vec![vary.clone()], ..design.clone() }).moved.unwrap();
    assert_mirrored(&design, &moved);
    assert_ne!(curve_of(&moved, "sheer"), curve_of(&design, "sheer"));
    let vary = Vary { curves: vec!["sheer".to_owned()], ..vary };
    let moved = made(&Design { vary: vec![vary], ..design.clone() }).moved.unwrap();
    assert_ne!(curve_of(&moved, "sheer"), curve_of(&design, "sheer"));
    for stays in ["chine", "keel", "chine-starboard", "sheer-starboard"] {
        let points = |design: &Design| -> Vec<Point3> {
            curve_of(design, stays).points.iter().map(|point| point.at).collect()
        };
        assert_eq!(points(&moved), points(&design), "{stays}");
    }
}
