//! Strokes drawn as a hand does, with a seed: what becomes of them.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::curve::{Curve, CurveKind, CurvePoint};
use sheetwright::draw::stroke::{MOST_POINTS, Stroke, StrokeError, StrokeOptions, stroke};
use sheetwright::math::{Point2, Point3, Vec2, cos, sin};
use sheetwright::predicate::first_crossing;
use sheetwright_shapes::random::Random;
use std::f64::consts::{PI, TAU};

/// A way drawn with a ruler: places along it, a mm apart or so, corners exact.
fn along(corners: &[[f64; 2]], closed: bool) -> Vec<Point2> {
    let m = corners.len();
    let sides = if closed { m } else { m - 1 };
    let mut way = Vec::new();
    for i in 0..sides {
        let [a, b] = [corners[i], corners[(i + 1) % m]].map(|[x, y]| Point2::new(x, y));
        let steps = a.distance(b).ceil() as usize;
        way.extend((0..steps).map(|n| a.lerp(b, n as f64 / steps as f64)));
    }
    let last = corners[sides % m];
    way.push(Point2::new(last[0], last[1]));
    way
}

fn of(count: usize, at: impl Fn(f64) -> [f64; 2]) -> Vec<Point2> {
    (0..=count).map(|n| at(n as f64 / count as f64)).map(|[x, y]| Point2::new(x, y)).collect()
}

fn circle() -> Vec<Point2> {
    of(900, |t| [150.0 * cos(TAU * t), 150.0 * sin(TAU * t)])
}

fn ellipse() -> Vec<Point2> {
    of(900, |t| [220.0 * cos(TAU * t + 0.7), 100.0 * sin(TAU * t + 0.7)])
}

fn rectangle() -> Vec<Point2> {
    along(&[[0.0, 0.0], [320.0, 0.0], [320.0, 200.0], [0.0, 200.0]], true)
}

fn rounded_rectangle() -> Vec<Point2> {
    let (w, h, r) = (150.0, 100.0, 60.0);
    let mut way = Vec::new();
    for (n, [x, y]) in [[w, h], [-w, h], [-w, -h], [w, -h]].into_iter().enumerate() {
        for k in 0..=90 {
            let t = (n as f64 + f64::from(k) / 90.0) * PI / 2.0;
            way.push(Point2::new(x + r * cos(t), y + r * sin(t)));
        }
    }
    way.push(way[0]);
    let corners: Vec<[f64; 2]> = way.iter().map(|p| [p.x, p.y]).collect();
    along(&corners, false)
}

/// Two arcs that meet at both ends.
fn leaf() -> Vec<Point2> {
    let arc = |t: f64, side: f64| [400.0 * t, side * 320.0 * t * (1.0 - t)];
    of(1000, |t| if t < 0.5 { arc(2.0 * t, 1.0) } else { arc(2.0 - 2.0 * t, -1.0) })
}

fn half_disc() -> Vec<Point2> {
    let mut way = of(500, |t| [150.0 * cos(PI * t), 150.0 * sin(PI * t)]);
    way.extend(along(&[[-150.0, 0.0], [150.0, 0.0]], false));
    way
}

fn star() -> Vec<Point2> {
    let corner = |n: usize| {
        let (t, r) = (PI * n as f64 / 5.0, if n.is_multiple_of(2) { 200.0 } else { 85.0 });
        [r * sin(t), r * cos(t)]
    };
    along(&(0..10).map(corner).collect::<Vec<_>>(), true)
}

fn s_curve() -> Vec<Point2> {
    of(700, |t| [120.0 * sin(TAU * t), 400.0 * t])
}

fn sheer() -> Vec<Point2> {
    of(700, |t| [600.0 * t, 90.0 * (2.0 * t - 0.9) * (2.0 * t - 0.9)])
}

/// The way as a hand draws it: corners rounded off a little, slowly there and else fast, wandering,
/// trembling, on whole pixels; a closed one begins and ends about the same spot.
fn by_hand(way: &[Point2], seed: u64) -> Vec<Point2> {
    let mut random = Random::new(seed);
    let m = way.len();
    let size = 0.5 * (0..m - 1).map(|i| way[i].distance(way[i + 1])).sum::<f64>();
    let waves: Vec<[f64; 4]> = (0..4)
        .map(|_| {
            [random.between(1.0, 6.0), random.between(0.0, TAU), random.between(0.0, TAU), size]
        })
        .map(|[f, a, b, size]| [f, a, b, 1.2e-3 * size])
        .collect();
    let mut drawn = Vec::new();
    let mut n = 0.0;
    while (n as usize) < m {
        let i = n as usize;
        // Rounded off over a few places.
        let (from, to) = (i.saturating_sub(3), (i + 3).min(m - 1));
        let mean: Vec2 =
            way[from..=to].iter().map(|p| p.to_vec()).sum::<Vec2>() / (to - from + 1) as f64;
        let t = n / m as f64;
        let wander = waves.iter().fold(Vec2::ZERO, |sum, [f, a, b, r]| {
            sum + Vec2::new(sin(TAU * f * t + a), sin(TAU * f * t + b)) * *r
        });
        let tremble = Vec2::new(random.between(-0.5, 0.5), random.between(-0.5, 0.5));
        let p = mean + wander + tremble;
        drawn.push(Point2::new(p.x.round(), p.y.round()));
        n += random.between(0.3, 6.0);
    }
    drawn
}

fn spline(drawn: &Stroke) -> Curve {
    let points: Vec<CurvePoint> = drawn
        .points
        .iter()
        .map(|p| CurvePoint {
            corner: p.corner,
            ..CurvePoint::smooth(Point3::new(p.at.x, p.at.y, 0.0))
        })
        .collect();
    Curve::new(CurveKind::Spline, &points, drawn.closed).unwrap()
}

/// Name, way, closed, corners, points at the most.
type Case = (&'static str, Vec<Point2>, bool, usize, usize);

fn cases() -> Vec<Case> {
    vec![
        ("circle", circle(), true, 0, 8),
        ("ellipse", ellipse(), true, 0, 8),
        ("rectangle", rectangle(), true, 4, 4),
        ("rounded rectangle", rounded_rectangle(), true, 0, 16),
        ("leaf", leaf(), true, 2, 8),
        ("half disc", half_disc(), true, 2, 6),
        ("star", star(), true, 10, 10),
        ("S", s_curve(), false, 0, 9),
        ("sheer", sheer(), false, 0, 5),
    ]
}

/// Places along the curve of a stroke.
fn places(drawn: &Stroke) -> Vec<Point2> {
    let curve = spline(drawn);
    let count = 100 * curve.spans().len();
    let at = |n: usize| curve.position(n as f64 / 100.0);
    (0..=count).map(|n| Point2::new(at(n).x, at(n).y)).collect()
}

/// How far each of some points is from a way from point to point, at the most.
fn off(points: &[Point2], way: &[Point2]) -> f64 {
    let from = |p: Point2, a: Point2, b: Point2| {
        let squared = (b - a).length_squared();
        let t = if squared > 0.0 { ((p - a).dot(b - a) / squared).clamp(0.0, 1.0) } else { 0.0 };
        p.distance(a.lerp(b, t))
    };
    let nearest = |p: &Point2| {
        way.windows(2).map(|pair| from(*p, pair[0], pair[1])).fold(f64::INFINITY, f64::min)
    };
    points.iter().map(nearest).fold(0.0, f64::max)
}

fn corners(drawn: &Stroke) -> usize {
    drawn.points.iter().filter(|p| p.corner).count()
}

#[test]
fn a_hand_draws_what_it_means() {
    let options = StrokeOptions { grain_mm: 1.0, ..StrokeOptions::default() };
    for (name, way, closed, with_corners, most) in cases() {
        for seed in 0..24 {
            let hand = by_hand(&way, seed);
            let drawn = stroke(&hand, &options).unwrap();
            let said = format!("{name} {seed}: {drawn:?}");
            assert_eq!(drawn.closed, closed, "{said}");
            assert_eq!(corners(&drawn), with_corners, "{said}");
            assert!(drawn.points.len() <= most, "{said}");
            assert!(drawn.off_mm <= 0.01 * drawn.length_mm, "{said}");
            // Measured anew. What the hand wandered apart at its ends was drawn together.
            let curve = places(&drawn);
            let gap = if closed { hand[0].distance(hand[hand.len() - 1]) } else { 0.0 };
            let most_off = 0.01 * drawn.length_mm + gap;
            assert!(off(&hand, &curve) <= most_off, "{said}");
            let mut there = hand.clone();
            there.extend(closed.then_some(hand[0]));
            assert!(off(&curve, &there) <= most_off, "{said}");
            let ring = &curve[..curve.len() - usize::from(closed)];
            assert!(!closed || first_crossing(ring).is_none(), "{said}");
        }
    }
}

#[test]
fn a_tighter_tolerance_is_kept_too() {
    let options = StrokeOptions { tolerance_share: 0.005, ..StrokeOptions::default() };
    for (name, way, ..) in cases() {
        for seed in 0..10 {
            let drawn = stroke(&by_hand(&way, seed), &options).unwrap();
            assert!(drawn.off_mm <= 0.005 * drawn.length_mm, "{name} {seed}: {drawn:?}");
            assert!(drawn.points.len() <= 14, "{name} {seed}: {drawn:?}");
        }
    }
}

#[test]
fn where_and_how_large_and_which_way_up_does_not_matter() {
    for (name, way, ..) in cases() {
        for seed in 0..5 {
            let hand = by_hand(&way, seed);
            let drawn = stroke(&hand, &StrokeOptions::default()).unwrap();
            let (size, turn, shift) = (3.7, 0.83, Vec2::new(-400.0, 950.0));
            let moved = |p: &Point2| {
                let (c, s) = (size * cos(turn), size * sin(turn));
                Point2::new(c * p.x - s * p.y, s * p.x + c * p.y) + shift
            };
            let there: Vec<Point2> = hand.iter().map(moved).collect();
            let again = stroke(&there, &StrokeOptions::default()).unwrap();
            assert_eq!((again.closed, again.points.len()), (drawn.closed, drawn.points.len()));
            for (a, b) in drawn.points.iter().zip(&again.points) {
                assert_eq!(a.corner, b.corner, "{name} {seed}");
                assert!(moved(&a.at).distance(b.at) < 1e-6 * drawn.length_mm, "{name} {seed}");
            }
            assert!((again.off_mm / drawn.off_mm / size - 1.0).abs() < 1e-6, "{name} {seed}");
        }
    }
}

#[test]
fn either_way_round_is_the_same_shape() {
    for (name, way, closed, with_corners, most) in cases() {
        for seed in 0..5 {
            let mut hand = by_hand(&way, seed);
            let drawn = stroke(&hand, &StrokeOptions::default()).unwrap();
            hand.reverse();
            let back = stroke(&hand, &StrokeOptions::default()).unwrap();
            assert_eq!((back.closed, corners(&back)), (closed, with_corners), "{name} {seed}");
            assert!(back.points.len() <= most, "{name} {seed}");
            // Both lie within L/100 of the stroke.
            let apart = off(&places(&drawn), &places(&back));
            assert!(apart <= 0.02 * drawn.length_mm, "{name} {seed}: {apart}");
        }
    }
}

/// A stroke that stops short of where it began, or runs past it, beside it or across it.
#[test]
fn ends_that_meet_within_a_hand_are_closed() {
    let circle_to = |turn: f64, drift: f64| {
        of(600, |t| {
            let r = 150.0 + drift * t;
            [r * cos(turn * TAU * t), r * sin(turn * TAU * t)]
        })
    };
    for (turn, drift, closed) in [
        (0.98, 0.0, true),
        (1.06, 8.0, true),
        (1.06, -8.0, true),
        (1.0, 15.0, true),
        (0.85, 0.0, false),
        (0.5, 0.0, false),
    ] {
        for seed in 0..5 {
            let hand = by_hand(&circle_to(turn, drift), seed);
            let drawn = stroke(&hand, &StrokeOptions::default()).unwrap();
            assert_eq!(drawn.closed, closed, "{turn} {drift} {seed}: {drawn:?}");
            assert_eq!(corners(&drawn), 0, "{turn} {drift} {seed}: {drawn:?}");
        }
    }
    // Lines that cross where the corner is meant.
    let across =
        along(&[[-12.0, 0.0], [320.0, 0.0], [320.0, 200.0], [0.0, 200.0], [0.0, -12.0]], false);
    for seed in 0..10 {
        let drawn = stroke(&by_hand(&across, seed), &StrokeOptions::default()).unwrap();
        assert!(drawn.closed && corners(&drawn) == 4 && drawn.points.len() == 4, "{drawn:?}");
    }
}

#[test]
fn the_same_stroke_gives_the_same_bits() {
    let hand = by_hand(&rounded_rectangle(), 3);
    let options = StrokeOptions::default();
    assert_eq!(stroke(&hand, &options), stroke(&hand, &options));
}

#[test]
fn clicks_and_nonsense_are_refused_in_words() {
    let options = StrokeOptions::default();
    let p = Point2::new;
    for click in [vec![], vec![p(3.0, 4.0)], vec![p(3.0, 4.0); 9], vec![p(3.0, 4.0), p(3.5, 4.0)]] {
        let refused = stroke(&click, &options).unwrap_err();
        assert!(matches!(refused, StrokeError::Click { .. }));
        assert!(refused.to_string().contains("click"));
    }
    let wrong = [p(0.0, 0.0), p(5.0, f64::NAN), p(9.0, 9.0)];
    assert_eq!(stroke(&wrong, &options), Err(StrokeError::OutOfRange { position: 1 }));
    let far = [p(0.0, 0.0), p(1e10, 0.0)];
    assert_eq!(stroke(&far, &options), Err(StrokeError::OutOfRange { position: 1 }));
    // Two positions are a straight line.
    let line = stroke(&[p(0.0, 0.0), p(0.0, 0.0), p(50.0, 20.0)], &options).unwrap();
    assert!(!line.closed && line.points.len() == 2 && line.off_mm < 1e-9);
}

/// Whatever is drawn, there is a curve that can be made, or a reason.
#[test]
fn scribbles_never_panic() {
    let mut random = Random::new(11);
    for _ in 0..60 {
        let count = 2 + random.below(120);
        let wild = random.between(1.0, 300.0);
        let mut p = Point2::new(0.0, 0.0);
        let mut hand = vec![p];
        for _ in 0..count {
            p = p + Vec2::new(random.between(-wild, wild), random.between(-wild, wild));
            p = Point2::new(p.x.round(), p.y.round());
            hand.push(p);
        }
        match stroke(&hand, &StrokeOptions::default()) {
            Ok(drawn) => {
                assert!(drawn.off_mm.is_finite() && places(&drawn).len() > 1);
                assert!(drawn.points.len() <= MOST_POINTS);
            }
            Err(refused) => assert!(!refused.to_string().is_empty()),
        }
    }
    // There and back again.
    let there_and_back = along(&[[0.0, 0.0], [100.0, 0.0], [0.0, 0.0]], false);
    match stroke(&there_and_back, &StrokeOptions::default()) {
        Ok(drawn) => assert!(places(&drawn).len() > 1),
        Err(refused) => assert_eq!(refused, StrokeError::NoCurve),
    }
}
