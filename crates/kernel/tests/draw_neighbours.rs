//! Panels that are drawn off one another: where loops touch, which way panels face, points that are
//! shared in space, and circles.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::curve::{Curve, CurveKind, CurvePoint};
use sheetwright::design::{Design, DesignCurve, PanelShape};
use sheetwright::draw::loops::nesting;
use sheetwright::draw::panels::panels_of_drawing;
use sheetwright::draw::round::circle;
use sheetwright::draw::settle::{point_at, settled};
use sheetwright::make::make;
use sheetwright::math::{Point2, Point3, cos, sin};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::random::Random;
use std::f64::consts::TAU;

fn plan(p: Point3) -> Point2 {
    Point2::new(p.x, p.y)
}

fn polygon(corners: &[[f64; 2]]) -> Vec<Point2> {
    corners.iter().map(|&[x, y]| Point2::new(x, y)).collect()
}

fn outline(name: &str, corners: &[[f64; 3]]) -> DesignCurve {
    let points = corners.iter().map(|&[x, y, z]| CurvePoint::corner(Point3::new(x, y, z)));
    DesignCurve {
        name: name.into(),
        kind: Some(CurveKind::Spline),
        closed: true,
        points: points.collect(),
    }
}

fn drawing(curves: Vec<DesignCurve>) -> Design {
    Design { name: "d".into(), curves, ..Design::default() }
}

/// Whether the first two are neighbours or cross, whichever is given first and however they run.
fn meet(a: &[[f64; 2]], b: &[[f64; 2]]) -> (usize, usize) {
    let (a, b) = (polygon(a), polygon(b));
    let back = |p: &[Point2]| p.iter().rev().copied().collect::<Vec<_>>();
    let found = |a: &[Point2], b: &[Point2]| {
        let found = nesting(&[a.to_vec(), b.to_vec()]);
        assert!(found.loops.iter().all(|l| l.depth == 0) || found.touching.is_empty());
        (found.touching.len(), found.crossing.len())
    };
    let first = found(&a, &b);
    for (p, q) in [(&b, &a), (&a, &back(&b)), (&back(&a), &b), (&back(&b), &back(&a))] {
        assert_eq!(found(p, q), first, "{p:?} {q:?}");
    }
    first
}

#[test]
fn loops_that_touch_from_outside_are_neighbours_and_others_cross() {
    let square = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let notched = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 2.0], [0.0, 4.0]];
    for (a, b, what) in [
        (&square[..], &[[4.0, 0.0], [9.0, 1.0], [4.0, 4.0]][..], "along a side"),
        (&square, &[[4.0, 4.0], [9.0, 4.0], [9.0, 9.0]], "in a corner"),
        (&square, &[[4.0, 1.0], [9.0, 1.0], [9.0, 9.0], [4.0, 3.0]], "along part of a side"),
        (&square, &[[4.0, -1.0], [9.0, 1.0], [4.0, 9.0]], "along more than a side"),
        (&square, &[[4.0, 2.0], [9.0, 1.0], [9.0, 9.0]], "a corner on a side"),
        (&notched, &[[2.0, 2.0], [4.0, 4.0], [0.0, 4.0]], "in a notch"),
        (&notched, &[[2.0, 2.0], [3.0, 9.0], [1.0, 9.0]], "a corner in a notch"),
        (&square, &[[0.0, 0.0], [4.0, 0.0], [4.0, 0.0], [0.0, 0.0]], "seen along its plane"),
    ] {
        assert_eq!(meet(a, b), (1, 0), "{what}");
    }
    for (a, b, what) in [
        (&square[..], &square[..], "one on the other"),
        (&square, &[[4.0, 0.0], [9.0, 1.0], [2.0, 2.0]], "through a side"),
        (&square, &[[0.0, 0.0], [4.0, 0.0], [2.0, 2.0]], "inside, along a side"),
        (&square, &[[2.0, 0.0], [3.0, 2.0], [1.0, 2.0]], "inside, in a corner"),
        (&square, &[[0.0, 0.0], [4.0, 4.0], [9.0, -9.0]], "through two corners"),
        (&square, &[[-3.0, -3.0], [7.0, 7.0], [-3.0, 7.0]], "a side through two corners"),
        (&notched, &[[2.0, 2.0], [4.0, 0.0], [0.0, 0.0]], "inside, up to a notch"),
        (&notched, &[[0.0, 4.0], [2.0, 1.0], [4.0, 4.0]], "over a notch and beyond"),
        // Along a side for a while: in on the one side, out on the other.
        (&square, &[[2.0, 4.0], [5.0, 4.0], [5.0, 9.0], [1.0, 9.0], [1.0, 1.0]], "in along a side"),
    ] {
        assert_eq!(meet(a, b), (0, 1), "{what}");
    }
    assert_eq!(meet(&square, &[[1.0, 1.0], [2.0, 1.0], [2.0, 2.0]]), (0, 0), "inside");
}

#[test]
fn parts_of_a_round_plate_are_neighbours_and_no_part_is_one_of_the_plate() {
    let mut random = Random::new(3);
    for _ in 0..200 {
        let m = 6 + random.below(20);
        let whole: Vec<[f64; 2]> = (0..m)
            .map(|n| {
                let t = TAU * (n as f64 + random.between(0.0, 0.8)) / m as f64;
                [100.0 * cos(t), 90.0 * sin(t)]
            })
            .collect();
        let (i, j) = (random.below(m / 2 - 1), m / 2 + random.below(m / 2 - 1));
        let first = whole[i..=j].to_vec();
        let second: Vec<[f64; 2]> = whole[j..].iter().chain(&whole[..=i]).copied().collect();
        assert_eq!(meet(&first, &second), (1, 0));
        assert_eq!(meet(&first, &whole), (0, 1));
        assert_eq!(meet(&whole, &second), (0, 1));
    }
}

#[test]
fn neighbours_face_alike_however_they_were_drawn() {
    let first = [[0.0, 0.0, 50.0], [200.0, 0.0, 80.0], [200.0, 100.0, 20.0], [0.0, 100.0, 0.0]];
    let second = [[200.0, 0.0, 80.0], [400.0, 0.0, 0.0], [400.0, 100.0, 0.0], [200.0, 100.0, 20.0]];
    for turns in 0..4 {
        let mut curves = vec![outline("a", &first), outline("b", &second)];
        for (n, curve) in curves.iter_mut().enumerate() {
            if turns >> n & 1 == 1 {
                curve.points.reverse();
            }
        }
        let design = drawing(curves);
        let proposal = panels_of_drawing(&design, plan, 40);
        assert_eq!(proposal.crossing.len(), 0);
        let made = make(&proposal.applied(&design), &mut Unwatched).unwrap();
        assert_eq!(made.parts.len(), 2);
        for panel in &made.parts {
            let up = |t: &[sheetwright::index::SampleIndex; 3]| {
                let [a, b, c] = t.map(|v| panel.found().unwrap().surface.positions()[v.get()]);
                (b - a).cross(c - a).z
            };
            let triangles = panel.found().unwrap().surface.connectivity().triangles();
            assert!(triangles.iter().all(|t| up(t) > 0.0), "{turns}: {}", panel.name);
        }
    }
    // A panel that a file has facing down keeps its way, and its new neighbour faces down too.
    let mut design = drawing(vec![outline("a", &first)]);
    design = panels_of_drawing(&design, plan, 40).applied(&design);
    let PanelShape::Loops { outer, .. } = &mut design.panels[0].shape else { panic!() };
    assert!(!outer[0].reversed);
    outer[0].reversed = true;
    design.curves.push(outline("b", &second));
    let design = panels_of_drawing(&design, plan, 40).applied(&design);
    let turned = design.panels.iter().map(|panel| match &panel.shape {
        PanelShape::Loops { outer, .. } => outer[0].reversed,
        other => panic!("{other:?}"),
    });
    assert_eq!(turned.collect::<Vec<_>>(), [true, true]);
}

#[test]
fn holes_that_touch_are_refused_by_name() {
    let design = drawing(vec![
        outline(
            "plate",
            &[[-9.0, -9.0, 0.0], [19.0, -9.0, 0.0], [19.0, 19.0, 0.0], [-9.0, 19.0, 0.0]],
        ),
        outline("a", &[[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]]),
        outline("b", &[[4.0, 0.0, 0.0], [8.0, 0.0, 0.0], [4.0, 4.0, 0.0]]),
    ]);
    let proposal = panels_of_drawing(&design, plan, 40);
    assert_eq!(proposal.crossing, [["a".to_owned(), "b".to_owned()]]);
    let design = proposal.applied(&design);
    let PanelShape::Loops { holes, .. } = &design.panels[0].shape else { panic!() };
    assert_eq!((design.panels.len(), holes.len()), (1, 1));
}

#[test]
fn a_point_that_settles_has_the_position_of_the_one_there_bit_by_bit() {
    let low = outline("low", &[[0.1, 0.2, 0.3], [100.1, 0.2, 10.0], [50.0, 80.0, 7.0]]);
    let high = outline("high", &[[0.1, 0.2, 40.3], [-90.0, 3.0, 1.0], [-50.0, 80.0, 2.0]]);
    let points = || [&low, &high].into_iter().flat_map(|curve| &curve.points).map(|p| p.at);
    let at = |x, y| point_at(points(), Point2::new(x, y), plan, |p| p.z);
    assert_eq!(at(0.1, 0.2), Some(Point3::new(0.1, 0.2, 40.3)));
    assert_eq!(at(100.1, 0.2), Some(Point3::new(100.1, 0.2, 10.0)));
    assert_eq!(at(100.1, 0.2 + 1e-12), None);

    let ends = [Some(Point3::new(1.0, 2.0, 30.0)), Some(Point3::new(90.0, 5.0, -7.0))];
    let mut open = outline("o", &[[1.0, 2.0, 0.0], [40.0, 30.0, 0.0], [90.0, 5.0, 0.0]]);
    open.closed = false;
    let joined = settled(&open, ends, plan).unwrap();
    assert_eq!([Some(joined.points[0].at), Some(joined.points[2].at)], ends);
    assert_eq!(joined.points[1], open.points[1]);

    // A round one: near one of its points that moves there, far from all there is one more.
    let round = |n: usize| {
        let points = circle(Point2::new(0.0, 0.0), 50.0);
        let points = points.into_iter().step_by(32 / n);
        let points = points.map(|p| CurvePoint::smooth(Point3::new(p.x, p.y, 0.0))).collect();
        DesignCurve { points, ..outline("r", &[]) }
    };
    for (x, y, count) in [(50.5, 1.0, 8), (46.2, 19.1, 9)] {
        let to = Point3::new(x, y, 25.0);
        let joined = settled(&round(8), [Some(to), Some(to)], plan).unwrap();
        assert_eq!(joined.points.len(), count);
        assert_eq!(joined.points.iter().filter(|p| p.at == to).count(), 1);
        assert!(joined.points.iter().filter(|p| p.at != to).all(|p| p.at.z == 0.0));
    }
}

#[test]
fn a_circle_has_its_diameter_in_every_direction() {
    let points = circle(Point2::new(3.0, -4.0), 100.0);
    assert_eq!(points[0], Point2::new(103.0, -4.0));
    assert_eq!(points[points.len() / 4], Point2::new(3.0, 96.0));
    let points: Vec<CurvePoint> =
        points.iter().map(|p| CurvePoint::smooth(Point3::new(p.x, p.y, 0.0))).collect();
    let curve = Curve::new(CurveKind::Spline, &points, true).unwrap();
    let places: Vec<Point2> =
        (0..32 * 64).map(|n| plan(curve.position(f64::from(n) / 64.0))).collect();
    for n in 0..180 {
        let t = TAU * f64::from(n) / 360.0;
        let along = |p: &Point2| p.x * cos(t) + p.y * sin(t);
        let most = places.iter().map(along).fold(f64::MIN, f64::max);
        let least = places.iter().map(along).fold(f64::MAX, f64::min);
        assert!((most - least - 200.0).abs() < 1e-3, "{n}°: {}", most - least);
    }
}
