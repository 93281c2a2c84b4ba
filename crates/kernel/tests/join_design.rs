//! Panels joined in a design: sampled alike, as many samples as were asked for, one sheet.

#![allow(clippy::unwrap_used, reason = "a test that can't go on fails")]

use sheetwright::boundary::{Continuity, JoinCause, Within};
use sheetwright::check::Verdict;
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{
    CurveUse, Design, DesignCurve, DesignPanel, Join, PanelMethod, PanelShape,
};
use sheetwright::make::{MakeCause, MakeError, Part, make};
use sheetwright::math::{Point2, Point3, cos, from_deg, sin};
use sheetwright::sample::PanelCause;
use sheetwright::watch::Unwatched;
use sheetwright_shapes::developable::largest_distance_after_fitting;
use sheetwright_shapes::three_cones;

fn curve(name: &str, kind: CurveKind, points: Vec<Point3>) -> DesignCurve {
    let points = points.into_iter().map(CurvePoint::smooth).collect();
    DesignCurve { name: name.into(), kind: Some(kind), closed: false, points }
}

fn used(written: &str) -> CurveUse {
    match written.strip_prefix('-') {
        Some(name) => CurveUse { name: name.into(), reversed: true },
        None => CurveUse { name: written.into(), reversed: false },
    }
}

fn bounded(name: &str, outer: &[&str]) -> DesignPanel {
    let outer = outer.iter().map(|c| used(c)).collect();
    DesignPanel::new(name, PanelShape::Loops { outer, holes: Vec::new() }, 80)
}

fn joining(parts: &[&str], smooth: Continuity) -> PanelShape {
    PanelShape::Join(Join {
        parts: parts.iter().map(|p| (*p).to_owned()).collect(),
        smooth,
        within: Within::default(),
        keep_parts: false,
    })
}

/// A patch of a cylinder of radius 100 about the axis y, cut along a wavy seam.
fn cylinder() -> Design {
    let at = |angle: f64, y: f64| {
        Point3::new(100.0 * sin(from_deg(angle)), y, 100.0 * cos(from_deg(angle)))
    };
    let arc = |from: f64, to: f64, y: f64| -> Vec<Point3> {
        (0..=20).map(|n| at(from + (to - from) * f64::from(n) / 20.0, y)).collect()
    };
    let seam: Vec<Point3> = (0..=20)
        .map(|n| at(8.0 * sin(from_deg(18.0 * f64::from(n))), 10.0 * f64::from(n)))
        .collect();
    let curves = vec![
        curve("low-left", CurveKind::Spline, arc(-50.0, 0.0, 0.0)),
        curve("low-right", CurveKind::Spline, arc(0.0, 60.0, 0.0)),
        curve("right", CurveKind::Polyline, vec![at(60.0, 0.0), at(60.0, 200.0)]),
        curve("high-right", CurveKind::Spline, arc(0.0, 60.0, 200.0)),
        curve("high-left", CurveKind::Spline, arc(-50.0, 0.0, 200.0)),
        curve("left", CurveKind::Polyline, vec![at(-50.0, 0.0), at(-50.0, 200.0)]),
        curve("seam", CurveKind::Spline, seam),
    ];
    let panels = vec![
        bounded("west", &["low-left", "seam", "-high-left", "-left"]),
        bounded("east", &["low-right", "right", "-high-right", "-seam"]),
        DesignPanel::new("joined", joining(&["west", "east"], Continuity::G0), 132),
    ];
    Design { name: "patch".into(), material: None, curves, panels, ..Design::default() }
}

fn made(design: &Design) -> Vec<Part> {
    make(design, &mut Unwatched).unwrap().parts
}

fn refused(design: &Design) -> MakeError {
    make(design, &mut Unwatched).map(|made| made.parts.len()).unwrap_err()
}

#[test]
fn two_parts_of_a_cylinder_cost_what_the_whole_costs() {
    let mut design = cylinder();
    let around = ["low-left", "low-right", "right", "-high-right", "-high-left", "-left"];
    design.panels.push(DesignPanel { samples: 132, ..bounded("whole", &around) });
    let panels = made(&design);
    // The join takes the place of its parts.
    let names: Vec<&str> = panels.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["joined", "whole"]);
    let [joined, whole] = &panels[..] else { panic!() };
    assert_eq!(joined.found().unwrap().boundary.len(), 132);
    assert_eq!(joined.checked.verdict, Verdict::Bends);
    // Both have the samples of one loop, from another one on. (An odd number would fall to one of
    // two sides that are as long, and to which depends on where the loop begins.)
    let mut samples = joined.found().unwrap().boundary.samples().to_vec();
    let start = whole.found().unwrap().boundary.samples()[0].position;
    let first = samples.iter().position(|s| s.position == start).unwrap();
    samples.rotate_left(first);
    for (a, b) in samples.iter().zip(whole.found().unwrap().boundary.samples()) {
        assert!(a.position.distance(b.position) < 1e-9);
        assert!((a.tangent_in - b.tangent_in).length() < 1e-9);
        assert!((a.tangent_out - b.tangent_out).length() < 1e-9);
    }
    let [a, b] = [joined, whole].map(|p| p.measures.twist_total);
    assert!((a - b).abs() < 1e-9 * (1.0 + b), "{a} {b}");
    assert!(
        (joined.found().unwrap().triangulation.price - whole.found().unwrap().triangulation.price)
            .abs()
            < 1e-9
    );
}

#[test]
fn the_outer_loop_has_as_many_samples_as_were_asked_for() {
    let mut design = cylinder();
    for samples in [12, 13, 50, 77, 200, 331] {
        for smooth in [Continuity::G0, Continuity::G1, Continuity::G2] {
            design.panels[2].samples = samples;
            design.panels[2].shape = joining(&["east", "west"], smooth);
            assert_eq!(made(&design)[0].found().unwrap().boundary.len(), samples);
        }
    }
    if let PanelShape::Join(join) = &mut design.panels[2].shape {
        join.keep_parts = true;
    }
    assert_eq!(made(&design).len(), 3);
    design.panels[2].samples = 5;
    assert!(matches!(refused(&design).cause, MakeCause::Panel(PanelCause::Sampling(_))));
}

#[test]
fn panels_between_rails_join_along_a_rail() {
    // A hull side of three rails; the lower panel is drawn from the other end.
    let rail = |name: &str, y: f64, z: f64| {
        let points = (0..=4).map(|n| {
            let x = f64::from(n) * 250.0;
            Point3::new(x, y + 60.0 * sin(from_deg(0.18 * x)), z)
        });
        curve(name, CurveKind::Spline, points.collect())
    };
    let rails = |a: &str, b: &str| PanelShape::Rails([used(a), used(b)]);
    let mut design = Design {
        name: "side".into(),
        material: None,
        curves: vec![rail("keel", 0.0, 0.0), rail("chine", 0.0, 150.0), rail("sheer", 0.0, 400.0)],
        panels: vec![
            DesignPanel::new("lower", rails("-chine", "keel"), 40),
            DesignPanel::new("upper", rails("chine", "sheer"), 90),
            DesignPanel::new("side", joining(&["lower", "upper"], Continuity::G1), 160),
        ],
        ..Design::default()
    };
    let side = &made(&design)[0];
    assert_eq!(side.found().unwrap().boundary.len(), 160);
    // The ends of the chine lie on the straight ends of the side: nothing to be made smooth.
    assert!(side.found().unwrap().boundary.samples().iter().filter(|s| s.is_corner()).count() == 4);
    assert_eq!(side.checked.verdict, Verdict::Bends);
    // Which side a panel faces depends on the order of its rails and the way that the first runs.
    for (rail, other, turns) in [
        ("chine", "sheer", false),
        ("-chine", "sheer", true),
        ("sheer", "chine", true),
        ("-sheer", "chine", false),
    ] {
        design.panels[1].shape = rails(rail, other);
        let side = &made(&design)[0];
        assert_eq!(side.found().unwrap().boundary.len(), 160);
        let turned = side.checked.findings.iter().any(|f| f.code() == "turned-round");
        assert_eq!(turned, turns, "{rail} {other}");
    }
    design.panels[2].method = PanelMethod::Rails;
    assert_eq!(refused(&design).cause, PanelCause::NoRails.into());
}

/// A closed polyline round a rectangle, as a panel.
fn rectangle(
    name: &str,
    [x, y]: [f64; 2],
    [width, height]: [f64; 2],
) -> (DesignCurve, DesignPanel) {
    let points = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]]
        .map(|[a, b]| Point3::new(x + a, y + b, 0.0))
        .to_vec();
    let rim = DesignCurve { closed: true, ..curve(name, CurveKind::Polyline, points) };
    (rim, bounded(name, &[name]))
}

fn flat(parts: Vec<(DesignCurve, DesignPanel)>, samples: usize) -> Design {
    let names: Vec<String> = parts.iter().map(|(_, part)| part.name.clone()).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let (curves, mut panels): (Vec<_>, Vec<_>) = parts.into_iter().unzip();
    panels.push(DesignPanel::new("whole", joining(&names, Continuity::G0), samples));
    Design { name: "flat".into(), material: None, curves, panels, ..Design::default() }
}

#[test]
fn closed_outlines_share_their_edges_and_parts_of_them() {
    // Beside one another; and a long edge beside two short ones, in every order.
    let pair = flat(
        vec![rectangle("a", [0., 0.], [70., 100.]), rectangle("b", [70., 0.], [110., 100.])],
        93,
    );
    let whole = &made(&pair)[0];
    assert_eq!(whole.found().unwrap().boundary.len(), 93);
    assert!((whole.measures.area_flat_mm2 - 18_000.0).abs() < 1e-6);
    for order in [[0, 1, 2], [1, 0, 2], [1, 2, 0]] {
        let parts = [
            rectangle("long", [0., 0.], [50., 201.5]),
            rectangle("low", [50., 0.], [33., 90.1]),
            rectangle("high", [50., 90.1], [44., 111.4]),
        ];
        let parts = order.map(|n| parts[n].clone()).to_vec();
        let whole = &made(&flat(parts, 120))[0];
        assert_eq!(whole.found().unwrap().boundary.len(), 120);
        let area = 50.0 * 201.5 + 33.0 * 90.1 + 44.0 * 111.4;
        assert!((whole.measures.area_flat_mm2 - area).abs() < 1e-6);
    }
    // One corner in common, and the sample there goes: as many as were asked for are left.
    let touching = flat(
        vec![rectangle("a", [0., 0.], [50., 50.]), rectangle("b", [50., 50.], [80., 50.])],
        90,
    );
    assert_eq!(made(&touching)[0].found().unwrap().boundary.len(), 90);
}

#[test]
fn outlines_of_fixed_samples_keep_them() {
    // A square of eight samples beside a rectangle of five; the seam is two edges of each.
    let around = [[0, 0], [1, 0], [2, 0], [2, 1], [2, 2], [1, 2], [0, 2], [0, 1]];
    let points = around.map(|[x, y]| Point3::new(25.0 * f64::from(x), 25.0 * f64::from(y), 0.0));
    let points = points.map(|at| CurvePoint { at, corner: true, move_mm: 0.0 }).to_vec();
    let rim = DesignCurve { name: "a".into(), kind: None, closed: true, points };
    let part = bounded("a", &["a"]);
    let other: Vec<Point3> = [[50., 0.], [90., 0.], [90., 50.], [50., 50.], [50., 25.]]
        .map(|[x, y]| Point3::new(x, y, 0.0))
        .to_vec();
    let points = other.into_iter().map(CurvePoint::corner).collect();
    let next = DesignCurve { name: "b".into(), kind: None, closed: true, points };
    let fixed = flat(vec![(rim, part), (next, bounded("b", &["b"]))], 400);
    assert_eq!(made(&fixed)[0].found().unwrap().boundary.len(), 8 + 5 - 2 - 2);
    // A seam that is a thousand times as long as what is left of both parts, nearly.
    let zigzag: Vec<Point3> = (0..=400)
        .map(|n| Point3::new(if n % 2 == 0 { 0.0 } else { 50.0 }, 0.1 * f64::from(n), 0.0))
        .collect();
    let side = |x: f64| {
        let points = [[0., 0.], [x, -5.], [x, 45.], [0., 40.]];
        points.map(|[x, y]| Point3::new(x, y, 0.0)).to_vec()
    };
    let design = Design {
        name: "comb".into(),
        material: None,
        curves: vec![
            curve("left", CurveKind::Polyline, side(-9.0)),
            curve("right", CurveKind::Polyline, side(59.0)),
            curve("seam", CurveKind::Polyline, zigzag),
        ],
        panels: vec![
            bounded("west", &["seam", "-left"]),
            bounded("east", &["right", "-seam"]),
            DesignPanel::new("whole", joining(&["west", "east"], Continuity::G0), 60),
        ],
        ..Design::default()
    };
    assert_eq!(made(&design)[0].found().unwrap().boundary.len(), 60);
}

#[test]
fn what_cannot_be_joined_names_the_part() {
    let mut design = cylinder();
    let with = |design: &mut Design, parts: &[&str]| {
        design.panels[2].shape = joining(parts, Continuity::G0);
        let error = refused(design);
        assert_eq!(error.panel, "joined");
        error.cause
    };
    let unknown = with(&mut design, &["west", "north"]);
    assert_eq!(unknown, PanelCause::UnknownPanel { name: "north".into() }.into());
    let itself = with(&mut design, &["west", "joined"]);
    assert_eq!(itself, PanelCause::JoinOfJoins { name: "joined".into() }.into());
    let of = |part: &str, cause: JoinCause| {
        MakeCause::Panel(PanelCause::Join { part: Some(part.into()), cause })
    };
    let twice = with(&mut design, &["west", "west"]);
    assert_eq!(twice, of("west", JoinCause::Closed));
    // A seam of its own beside the other's: only its ends are shared.
    let points = design.curves[6].points.iter().step_by(4).map(|p| p.at).collect();
    design.curves.push(curve("coarse", CurveKind::Spline, points));
    design.panels[1] = bounded("east", &["low-right", "right", "-high-right", "-coarse"]);
    let beside = with(&mut design, &["west", "east"]);
    assert_eq!(beside, of("east", JoinCause::LooseSamples { count: 2 }));
    for point in design.curves.iter_mut().flat_map(|c| &mut c.points).skip(21) {
        point.at.x += 500.0;
    }
    design.panels[1] = bounded("east", &["low-right", "right", "-high-right", "-seam"]);
    design.panels[0] = bounded("west", &["low-left", "low-left"]);
    // What is wrong with a part by itself is said of the part.
    assert_eq!(refused(&design).panel, "west");
}

#[test]
fn three_cones_unroll_to_the_sheet_that_they_were_rolled_from() {
    let mut design = three_cones::design(300);
    if let PanelShape::Join(join) = &mut design.panels[3].shape {
        join.smooth = Continuity::G0;
    }
    let whole = &made(&design)[0];
    assert_eq!((whole.name.as_str(), whole.found().unwrap().boundary.len()), ("whole", 300));
    assert_eq!(whole.checked.verdict, Verdict::Bends);
    let rolled: Vec<Point2> = (0..3)
        .flat_map(|wing| {
            let mut outline = three_cones::wing_outline(wing, 101);
            outline.pop();
            outline
        })
        .collect();
    let off = largest_distance_after_fitting(&rolled, &whole.flat.points);
    let size = whole.found().unwrap().boundary.size();
    assert!(off < 5e-4 * size, "{off} mm of {size} mm");
}
