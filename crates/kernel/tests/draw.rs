//! What people do to curves, panels from curves drawn inside one another, and coarser designs.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::boundary::samples_from_points;
use sheetwright::curve::{Curve, CurveKind, CurvePoint};
use sheetwright::design::{CurveUse, Design, DesignCurve, DesignPanel, PanelShape, Vary};
use sheetwright::draw::coarse::coarse;
use sheetwright::draw::edit::{self, EditError, Nearest};
use sheetwright::draw::loops::nesting;
use sheetwright::draw::panels::{
    PanelChange, in_plan, panels_of_drawing, without_curve, without_panel,
};
use sheetwright::draw::{join, mirror};
use sheetwright::make::make;
use sheetwright::math::{Point2, Point3, cos, sin};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::random::{Random, star};
use std::f64::consts::TAU;

const KINDS: [CurveKind; 3] = [CurveKind::Polyline, CurveKind::Spline, CurveKind::BSpline];

fn plan(p: Point3) -> Point2 {
    Point2::new(p.x, p.y)
}

fn flip(p: Point3) -> Point3 {
    Point3::new(-p.x, p.y, p.z)
}

fn curve(kind: CurveKind, closed: bool, points: &[[f64; 3]]) -> DesignCurve {
    let points = points.iter().map(|p| CurvePoint::smooth(Point3::new(p[0], p[1], p[2])));
    DesignCurve { name: "c".into(), kind: Some(kind), closed, points: points.collect() }
}

/// A star-shaped curve with random corners.
fn random_curve(random: &mut Random, kind: CurveKind, closed: bool) -> DesignCurve {
    let m = 5 + random.below(8);
    let mut made = curve(kind, closed, &[]);
    for i in 0..m {
        let (t, r) = (TAU * i as f64 / m as f64, random.between(60.0, 140.0));
        let at = Point3::new(r * cos(t), r * sin(t), random.between(-30.0, 30.0));
        let corner = random.unit() < 0.3;
        made.points.push(CurvePoint { at, corner, move_mm: 0.0 });
    }
    made
}

fn built(c: &DesignCurve) -> Curve {
    Curve::new(c.kind.unwrap(), &c.points, c.closed).unwrap()
}

fn places(c: &DesignCurve) -> Vec<Point3> {
    let made = built(c);
    let count = 200 * made.spans().len();
    (0..=count).map(|n| made.position(n as f64 / 200.0)).collect()
}

/// How far places of the one curve are from the other at the most.
fn apart(a: &DesignCurve, b: &DesignCurve) -> f64 {
    let (a, b) = (places(a), places(b));
    let off = |p: &Point3| b.iter().map(|q| p.distance(*q)).fold(f64::INFINITY, f64::min);
    a.iter().map(off).fold(0.0, f64::max)
}

fn all_curves(mut check: impl FnMut(&mut Random, DesignCurve)) {
    let mut random = Random::new(5);
    for kind in KINDS {
        for closed in [false, true] {
            for _ in 0..10 {
                let c = random_curve(&mut random, kind, closed);
                check(&mut random, c);
            }
        }
    }
}

#[test]
fn the_nearest_place_is_nearest_and_lies_on_the_curve() {
    all_curves(|random, c| {
        let at = Point2::new(random.between(-150.0, 150.0), random.between(-150.0, 150.0));
        let found = edit::nearest(&c, at, plan).unwrap();
        let least = places(&c).iter().map(|p| plan(*p).distance(at)).fold(f64::INFINITY, f64::min);
        assert!(found.distance_mm <= least + 1e-9, "{found:?} {least}");
        assert!((plan(found.position).distance(at) - found.distance_mm).abs() < 1e-12);
        let on = built(&c).spans()[found.span].position(found.t);
        assert_eq!(on, found.position);
        assert!(found.leg < edit::legs(&c));
    });
}

#[test]
fn an_inserted_point_lies_on_the_curve_and_hardly_changes_it() {
    all_curves(|random, c| {
        let at = Point2::new(random.between(-150.0, 150.0), random.between(-150.0, 150.0));
        let found = edit::nearest(&c, at, plan).unwrap();
        let Ok((with, number)) = edit::insert_point(&c, &found) else {
            // Right on a point.
            let near = c.points.iter().any(|p| p.at.distance(found.position) < 0.03);
            return assert!(near, "{c:?} {found:?}");
        };
        assert_eq!(with.points[number].at, found.position);
        assert_eq!((with.points[number].move_mm, with.points[number].corner), (0.0, false));
        let most = match c.kind {
            Some(CurveKind::Polyline) => 1.0,
            Some(CurveKind::Spline) => 8.0,
            _ => 25.0,
        };
        assert!(apart(&with, &c) <= most, "{:?}: {}", c.kind, apart(&with, &c));
        assert_eq!(edit::remove_point(&with, number).unwrap(), c);
    });
}

#[test]
fn points_of_a_polyline_are_inserted_without_a_trace() {
    let square = [[0., 0., 0.], [100., 0., 0.], [100., 100., 0.], [0., 100., 0.]];
    let c = curve(CurveKind::Polyline, true, &square);
    let found = edit::nearest(&c, Point2::new(-3.0, 40.0), plan).unwrap();
    assert_eq!((found.leg, found.span), (3, 3));
    let (with, number) = edit::insert_point(&c, &found).unwrap();
    assert_eq!(number, 4);
    assert!(with.points[4].at.distance(Point3::new(0.0, 40.0, 0.0)) < 1e-6);
    assert!((built(&with).length() - 400.0).abs() < 1e-9);
}

#[test]
fn too_few_points_are_never_left() {
    all_curves(|_, mut c| {
        let needed = if c.closed { 3 } else { 2 };
        while c.points.len() > needed {
            c = edit::remove_point(&c, 0).unwrap();
        }
        assert_eq!(edit::remove_point(&c, 0), Err(EditError::TooFewLeft { needed }));
        let refused = edit::remove_point(&c, 99).unwrap_err();
        assert_eq!(refused, EditError::NoPoint { point: 99, points: needed });
        assert!(refused.to_string().contains("no point 100"));
    });
}

#[test]
fn corners_come_and_go() {
    all_curves(|_, c| {
        let sharp = edit::set_corner(&c, 1, true).unwrap();
        if c.kind == Some(CurveKind::Polyline) {
            assert_eq!(sharp, c);
            let soft = edit::set_corner(&c, 1, false).unwrap();
            assert_eq!(soft.kind, Some(CurveKind::Spline));
            assert_eq!(soft.points.iter().filter(|p| p.corner).count(), c.points.len() - 1);
        } else {
            assert!(sharp.points[1].corner);
            assert!(!edit::set_corner(&sharp, 1, false).unwrap().points[1].corner);
        }
    });
    let samples = DesignCurve { kind: None, ..curve(CurveKind::Spline, true, &[[0.; 3]; 3]) };
    assert_eq!(edit::set_corner(&samples, 0, true), Err(EditError::Samples));
}

#[test]
fn a_leg_is_made_straight_and_bent_again() {
    all_curves(|_, c| {
        let m = c.points.len();
        let straight = edit::straighten(&c, 1, 2).unwrap();
        assert_eq!(straight.points.len(), m);
        let (a, b) = (c.points[1].at, c.points[2].at);
        let middle = a.lerp(b, 0.5);
        let on = |c: &DesignCurve| {
            places(c).iter().map(|p| p.distance(middle)).fold(f64::INFINITY, f64::min)
        };
        assert!(on(&straight) < 0.006 * a.distance(b), "{}", on(&straight));
        let (bent, number) = edit::curve_leg(&straight, 1).unwrap();
        assert_eq!((bent.points.len(), number), (m + 1, 2));
        assert!(bent.points[2].at.distance(middle) < 1e-12 && !bent.points[2].corner);
        assert_ne!(bent.kind, Some(CurveKind::Polyline));
        // What lies between goes.
        let longer = edit::straighten(&c, 0, 3).unwrap();
        assert_eq!(longer.points.len(), m - 2);
        assert_eq!((longer.points[0].at, longer.points[1].at), (c.points[0].at, c.points[3].at));
    });
    let round =
        curve(CurveKind::Spline, true, &[[9., 0., 0.], [0., 9., 0.], [-9., 0., 0.], [0., -9., 0.]]);
    assert_eq!(edit::curve_leg(&round, 0), Err(EditError::NotStraight));
    let over_the_end = edit::straighten(&round, 3, 0).unwrap();
    assert_eq!(over_the_end.points.iter().filter(|p| p.corner).count(), 2);
    assert_eq!(edit::straighten(&round, 3, 2), Err(EditError::TooFewLeft { needed: 3 }));
    assert_eq!(edit::curve_leg(&round, 4), Err(EditError::NoLeg { leg: 4, legs: 4 }));
}

#[test]
fn a_reversed_curve_is_the_same_place_for_place() {
    all_curves(|_, c| {
        let back = edit::reversed(&c);
        assert_eq!(edit::reversed(&back), c);
        assert!(
            apart(&back, &c) < 2.0 && (built(&back).length() - built(&c).length()).abs() < 1e-6
        );
        if c.closed {
            assert_eq!(back.points[0], c.points[0]);
        }
    });
}

#[test]
fn open_curves_are_joined_at_their_nearest_ends() {
    let mut random = Random::new(2);
    for kind in KINDS {
        for _ in 0..20 {
            let a = random_curve(&mut random, kind, false);
            let end = a.points[a.points.len() - 1].at;
            let mut b = random_curve(&mut random, kind, false);
            for point in &mut b.points {
                point.at = Point3::new(point.at.x + 900.0, point.at.y, point.at.z);
            }
            b.points[0].at = Point3::new(end.x + 0.5, end.y, end.z);
            for second in [b.clone(), edit::reversed(&b)] {
                let one = join::join(&a, &second, 1.0).unwrap();
                assert_eq!(one.points.len(), a.points.len() + b.points.len() - 1);
                let meet = one.points[a.points.len() - 1];
                assert!(meet.corner && meet.at.distance(end) < 0.26);
                assert_eq!((one.points[0], one.name.as_str()), (a.points[0], "c"));
                let gaping = join::join(&a, &second, 0.1).unwrap();
                assert_eq!(gaping.points.len(), a.points.len() + b.points.len());
            }
            // The other way: what is joined to the beginning comes before it.
            let before = join::join(&b, &a, 1.0).unwrap();
            assert_eq!(before.points[before.points.len() - 1], b.points[b.points.len() - 1]);
            assert_eq!(before.points[0], a.points[0]);
        }
    }
    let open = curve(CurveKind::Polyline, false, &[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.]]);
    let spline = curve(CurveKind::Spline, false, &[[1., 1., 0.], [5., 1., 0.], [6., 6., 0.]]);
    let mixed = join::join(&open, &spline, 0.1).unwrap();
    assert_eq!(mixed.kind, Some(CurveKind::Spline));
    assert!(mixed.points[1].corner && !mixed.points[3].corner);
    let beside = DesignCurve { kind: Some(CurveKind::BSpline), ..spline };
    assert_eq!(join::join(&open, &beside, 0.1), Err(EditError::Kinds));
}

#[test]
fn curves_are_closed_and_opened() {
    let open = curve(
        CurveKind::Spline,
        false,
        &[[0., 0., 0.], [9., 0., 0.], [9., 9., 1.], [0., 9., 0.], [0., 0.2, 0.]],
    );
    let met = join::close(&open, 0.5).unwrap();
    assert!(met.closed && met.points.len() == 4 && met.points[0].corner);
    assert!(met.points[0].at.distance(Point3::new(0.0, 0.1, 0.0)) < 1e-12);
    let straight = join::close(&open, 0.1).unwrap();
    assert_eq!(straight.points.len(), 5);
    assert!(straight.points[0].corner && straight.points[4].corner);
    let opened = join::open_at(&met, 2).unwrap();
    assert!(!opened.closed && opened.points.len() == 5);
    assert_eq!((opened.points[0], opened.points[4]), (met.points[2], met.points[2]));
    assert!(matches!(join::close(&met, 1.0), Err(EditError::Closed { .. })));
    assert!(matches!(join::open_at(&open, 1), Err(EditError::Open { .. })));
    assert!(matches!(join::join(&met, &open, 1.0), Err(EditError::Closed { .. })));
    let short = curve(CurveKind::Polyline, false, &[[0., 0., 0.], [1., 0., 0.], [0., 0., 0.]]);
    assert_eq!(join::close(&short, 0.1), Err(EditError::TooFewLeft { needed: 3 }));
}

#[test]
fn halves_become_symmetrical_loops() {
    let onto = |p: Point3| Point3::new(0.0, p.y, p.z);
    for kind in KINDS {
        let half = curve(
            kind,
            false,
            &[[0.2, -50., 0.], [40., -48., 5.], [60., 0., 9.], [40., 30., 3.], [-0.1, 60., 0.]],
        );
        let whole = mirror::closed_by_mirror(&half, flip, onto, 1.0).unwrap();
        assert!(whole.closed && whole.points.len() == 8);
        assert_eq!((whole.points[0].at.x, whole.points[4].at.x), (0.0, 0.0));
        // It lies across the mirror at the one end, and at a slant at the other.
        assert!(kind == CurveKind::Polyline || !whole.points[0].corner);
        assert!(whole.points[4].corner);
        let image = mirror::mirrored(&whole, flip);
        assert!(apart(&image, &whole) < 1.0);
        for point in 0..8 {
            let partner = mirror::mirror_partner(&whole, point, &whole, flip, 1e-6);
            assert_eq!(partner, Some((8 - point) % 8));
        }
        let refused = mirror::closed_by_mirror(&half, flip, onto, 0.15).unwrap_err();
        assert!(matches!(refused, EditError::OffMirror { .. }), "{refused}");
        assert!(mirror::closed_by_mirror(&whole, flip, onto, 1.0).is_err());
    }
    let a = curve(CurveKind::Spline, false, &[[1., 2., 3.], [5., 6., 7.]]);
    let b = curve(CurveKind::Spline, false, &[[-5., 6., 7.], [-1., 2., 3.1]]);
    assert_eq!(mirror::mirror_partner(&a, 0, &b, flip, 0.2), Some(1));
    assert_eq!(mirror::mirror_partner(&a, 0, &b, flip, 0.05), None);
    assert_eq!(mirror::mirror_partner(&a, 7, &b, flip, 0.2), None);
}

fn ring(name: &str, x: f64, y: f64, r: f64) -> DesignCurve {
    let at = |n: usize| {
        let t = TAU * n as f64 / 6.0;
        CurvePoint::smooth(Point3::new(x + r * cos(t), y + r * sin(t), 0.01 * x))
    };
    let points = (0..6).map(at).collect();
    DesignCurve { name: name.into(), kind: Some(CurveKind::Spline), closed: true, points }
}

#[test]
fn nesting_is_what_containment_says() {
    let mut random = Random::new(8);
    for _ in 0..60 {
        // Rings about few middles, so that they nest; those that would touch are left out.
        let mut rings: Vec<[f64; 3]> = Vec::new();
        for _ in 0..14 {
            let [x, y] = [random.below(3), random.below(3)].map(|n| 100.0 * n as f64);
            let new = [x, y, random.between(3.0, 150.0)];
            let clear = |old: &[f64; 3]| {
                let d = Point2::new(x, y).distance(Point2::new(old[0], old[1]));
                d > 1.1 * (new[2] + old[2]) || d < 0.9 * (new[2].max(old[2])) - new[2].min(old[2])
            };
            if rings.iter().all(clear) {
                rings.push(new);
            }
        }
        let loops: Vec<Vec<Point2>> =
            rings.iter().map(|&[x, y, r]| in_plan(&ring("r", x, y, r), plan)).collect();
        let found = nesting(&loops);
        assert!(found.crossing.is_empty() && found.crossing_itself.is_empty());
        for (a, nested) in found.loops.iter().enumerate() {
            let around: Vec<usize> = (0..rings.len())
                .filter(|&b| {
                    let d = Point2::new(rings[a][0], rings[a][1])
                        .distance(Point2::new(rings[b][0], rings[b][1]));
                    b != a && rings[b][2] > rings[a][2] && d < rings[b][2]
                })
                .collect();
            assert_eq!(nested.depth, around.len());
            let innermost = around.into_iter().min_by(|&b, &c| rings[b][2].total_cmp(&rings[c][2]));
            assert_eq!(nested.parent, innermost);
            assert_eq!(nested.is_hole(), nested.depth % 2 == 1);
        }
    }
}

#[test]
fn random_boundaries_nest_when_made_smaller_and_cross_when_moved() {
    let mut random = Random::new(4);
    for _ in 0..30 {
        let Some(boundary) = star(&mut random, 24, 0.3) else { continue };
        let outer: Vec<Point2> = boundary.samples().iter().map(|s| plan(s.position)).collect();
        let scaled = |f: f64, dx: f64| -> Vec<Point2> {
            outer.iter().map(|p| Point2::new(f * p.x + dx, f * p.y)).collect()
        };
        let width = outer.iter().map(|p| p.x).fold(0.0, f64::max);
        let found = nesting(&[scaled(0.25, 0.0), outer.clone(), scaled(0.5, 0.0)]);
        let depths: Vec<usize> = found.loops.iter().map(|l| l.depth).collect();
        assert_eq!(depths, [2, 0, 1]);
        assert_eq!(found.loops[0].parent, Some(2));
        assert!(found.crossing.is_empty());
        let found = nesting(&[outer.clone(), scaled(0.5, width)]);
        assert_eq!(found.crossing, [[0, 1]]);
        assert!(found.loops.iter().all(|l| l.depth == 0 && l.parent.is_none()));
    }
}

fn drawing(curves: Vec<DesignCurve>) -> Design {
    Design { name: "d".into(), curves, ..Design::default() }
}

fn names(uses: &[CurveUse]) -> Vec<&str> {
    uses.iter().map(|u| u.name.as_str()).collect()
}

fn shape(design: &Design, panel: usize) -> (Vec<&str>, Vec<Vec<&str>>) {
    match &design.panels[panel].shape {
        PanelShape::Loops { outer, holes } => {
            (names(outer), holes.iter().map(|h| names(h)).collect())
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn curves_drawn_inside_one_another_are_sheet_and_air_in_turn() {
    let mut design = drawing(vec![
        ring("hole", 0.0, 0.0, 60.0),
        ring("outer", 0.0, 0.0, 100.0),
        ring("island", 0.0, 0.0, 30.0),
        ring("beside", 300.0, 0.0, 50.0),
    ]);
    let proposal = panels_of_drawing(&design, plan, 90);
    assert!(proposal.crossing.is_empty() && proposal.crossing_itself.is_empty());
    design = proposal.applied(&design);
    assert_eq!(design.panels.len(), 3);
    assert_eq!(shape(&design, 0), (vec!["outer"], vec![vec!["hole"]]));
    assert_eq!(shape(&design, 1), (vec!["island"], vec![]));
    assert_eq!(shape(&design, 2), (vec!["beside"], vec![]));
    assert!(design.panels.iter().all(|p| p.samples == 90));
    // Nothing is left to propose, and what is made is right.
    assert_eq!(panels_of_drawing(&design, plan, 90).changes, []);
    assert_eq!(make(&design, &mut Unwatched).unwrap().parts.len(), 3);

    // A hole more, in a panel with settings of its own; another around a panel that there is.
    design.panels[2].fold = 0.25;
    design.curves.push(ring("eye", 300.0, 0.0, 10.0));
    design.curves.push(ring("frame", 300.0, 0.0, 80.0));
    let proposal = panels_of_drawing(&design, plan, 40);
    let hole = PanelChange::Hole { panel: "beside".into(), curve: "eye".into() };
    assert!(proposal.changes.contains(&hole) && proposal.changes.len() == 2);
    let design = proposal.applied(&design);
    assert_eq!(shape(&design, 2), (vec!["beside"], vec![vec!["eye"]]));
    assert_eq!((design.panels[2].fold, design.panels[2].samples), (0.25, 90));
    assert_eq!(shape(&design, 3), (vec!["frame"], vec![vec!["beside"]]));
    assert_eq!(panels_of_drawing(&design, plan, 90).changes, []);
}

#[test]
fn curves_that_cross_are_named() {
    let mut eight = ring("eight", 300.0, 0.0, 60.0);
    eight.points.swap(1, 4);
    let design = drawing(vec![
        ring("a", 0.0, 0.0, 60.0),
        ring("b", 70.0, 0.0, 60.0),
        eight,
        ring("c", 0.0, 500.0, 9.0),
    ]);
    let proposal = panels_of_drawing(&design, plan, 60);
    assert_eq!(proposal.crossing, [["a".to_owned(), "b".to_owned()]]);
    assert_eq!(proposal.crossing_itself, ["eight"]);
    assert_eq!(proposal.changes.len(), 1);
}

#[test]
fn what_is_removed_leaves_nothing_behind() {
    let mut design = drawing(vec![
        ring("outer", 0.0, 0.0, 100.0),
        ring("hole", 0.0, 0.0, 60.0),
        ring("other", 300.0, 0.0, 60.0),
    ]);
    design = panels_of_drawing(&design, plan, 60).applied(&design);
    design.vary = vec![
        Vary { curves: vec!["hole".into()], ..Vary::default() },
        Vary { panels: vec!["outer".into(), "other".into()], ..Vary::default() },
    ];
    let without_hole = without_curve(&design, "hole");
    assert_eq!(shape(&without_hole, 0), (vec!["outer"], vec![]));
    assert_eq!((without_hole.panels.len(), without_hole.vary.len()), (2, 1));
    let without_outer = without_curve(&design, "outer");
    assert_eq!(without_outer.panels.len(), 1);
    assert_eq!(without_outer.vary[1].panels, ["other"]);
    // The hole is free now, and becomes a panel.
    let again = panels_of_drawing(&without_outer, plan, 60);
    assert!(matches!(&again.changes[..], [PanelChange::Panel(p)] if p.name == "hole"));
    let without = without_panel(&design, "outer");
    assert_eq!((without.curves.len(), without.panels.len()), (3, 1));
}

#[test]
fn free_names_are_free() {
    let mut design = drawing(vec![ring("hole", 0.0, 0.0, 9.0), ring("hole 2", 0.0, 0.0, 5.0)]);
    assert_eq!(edit::free_name(&design, "curve"), "curve");
    assert_eq!(edit::free_name(&design, "hole"), "hole 3");
    assert_eq!(edit::free_name(&design, "hole 2"), "hole 3");
    assert_eq!(edit::free_name(&design, ""), "curve 2");
    let shape = PanelShape::Loops { outer: Vec::new(), holes: Vec::new() };
    design.panels.push(DesignPanel::new("hole 3", shape, 9));
    assert_eq!(edit::free_name(&design, "hole"), "hole 4");
}

#[test]
fn coarse_designs_are_small_and_can_be_made() {
    let mut random = Random::new(6);
    for _ in 0..12 {
        let mut curves = vec![ring("outer", 0.0, 0.0, 100.0)];
        for n in 0..random.below(4) {
            let (x, y) = (35.0 * n as f64 - 50.0, random.between(-20.0, 20.0));
            curves.push(ring(&format!("hole {n}"), x, y, random.between(3.0, 14.0)));
        }
        let mut design = drawing(curves);
        design = panels_of_drawing(&design, plan, 300 + random.below(500)).applied(&design);
        let most = 110 + random.below(150);
        let small = coarse(&design, most);
        let found = make(&small, &mut Unwatched).unwrap().parts[0]
            .found()
            .unwrap()
            .boundary
            .samples()
            .len();
        assert!(found <= most && found + 12 > most, "{found} of {most}");
        assert_eq!(coarse(&small, most), small);
        assert_eq!(Design { panels: design.panels.clone(), ..small }, design);
        // What is asked for in vain: as few as can be.
        assert!(make(&coarse(&design, 1), &mut Unwatched).is_ok());
    }
}

#[test]
fn coarse_designs_of_what_cant_be_built_ask_for_no_more() {
    let mut broken = ring("outer", 0.0, 0.0, 100.0);
    let curves = vec![broken.clone(), ring("hole", 10.0, 0.0, 9.0)];
    let mut design = drawing(curves);
    design = panels_of_drawing(&design, plan, 300).applied(&design);
    // All of its handles on one spot.
    broken.points.iter_mut().for_each(|point| point.at = Point3::default());
    for (n, curve) in [(0, "outer"), (1, "hole")] {
        let mut design = design.clone();
        design.curves[n] = DesignCurve { name: curve.into(), ..broken.clone() };
        assert!(make(&design, &mut Unwatched).is_err());
        let small = coarse(&design, 96);
        assert!(small.panels[0].samples <= 300, "{curve}: {}", small.panels[0].samples);
    }
}

#[test]
fn coarse_rails_and_corners_keep_what_they_need() {
    let rail = |name: &str, z: f64| {
        let mut c = curve(
            CurveKind::Polyline,
            false,
            &[[0., 0., z], [50., 9., z], [100., 0., z], [150., 9., z], [200., 0., z]],
        );
        c.name = name.into();
        c
    };
    let used = |name: &str| CurveUse { name: name.into(), reversed: false };
    let mut design = drawing(vec![rail("a", 0.0), rail("b", 80.0)]);
    let shape = PanelShape::Rails([used("a"), used("b")]);
    design.panels.push(DesignPanel::new("strip", shape, 200));
    assert_eq!(coarse(&design, 60).panels[0].samples, 30);
    assert_eq!(coarse(&design, 2).panels[0].samples, 5);
    assert!(make(&coarse(&design, 2), &mut Unwatched).is_ok());
    assert_eq!(coarse(&design, 400), design);
    let points: Vec<CurvePoint> = built(&rail("x", 0.0))
        .spans()
        .iter()
        .map(|s| CurvePoint::smooth(s.position(0.0)))
        .collect();
    assert_eq!(samples_from_points(&points).len(), 4);
}

#[test]
fn nothing_else_is_a_place() {
    let c = curve(CurveKind::Spline, false, &[[0., 0., 0.], [5., 1., 0.]]);
    let place = Nearest { span: 0, t: 0.5, leg: 3, position: Point3::default(), distance_mm: 0.0 };
    assert_eq!(edit::insert_point(&c, &place), Err(EditError::NoLeg { leg: 3, legs: 1 }));
}
