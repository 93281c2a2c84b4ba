//! Where to divide panels that will not bend, and that they bend when they are divided there. Each
//! advice is checked by panels that are drawn by hand along its lines and made as any other.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::boundary::{Outline, Side};
use sheetwright::check::{CutWay, FindingKind, LinePlace, Place, Verdict};
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{CurveUse, Design, DesignCurve, DesignPanel, PanelShape};
use sheetwright::make::{Judging, Live, Made, make, make_judged};
use sheetwright::material::Material;
use sheetwright::math::{Point3, cos, from_deg, sin};
use sheetwright::watch::{Unwatched, Watch};
use sheetwright_shapes::bent;
use sheetwright_shapes::materials;
use std::cell::Cell;
use std::f64::consts::TAU;

/// Steel that springs back however far it is bent: what yields is rolled to some of these shapes.
fn steel(thickness_mm: f64) -> Material {
    Material { yield_strain: None, ..materials::steel(thickness_mm) }
}

fn made(design: &Design) -> Made {
    let mut made = make(design, &mut Unwatched).unwrap();
    made.advise(&mut Unwatched);
    made
}

/// The findings on divisions, with the points of their lines.
fn divisions(made: &Made) -> Vec<(FindingKind, Vec<Point3>)> {
    let findings = made.parts.iter().flat_map(|part| &part.checked.findings);
    let of_division = |kind: &FindingKind| {
        matches!(kind, FindingKind::BendsDivided { .. } | FindingKind::DividedInVain { .. })
    };
    let points = |place: &Place| match place {
        Place::Lines { lines } => lines.iter().flat_map(|line| line.at.clone()).collect(),
        _ => Vec::new(),
    };
    let found = findings.filter(|finding| of_division(&finding.kind));
    found.map(|finding| (finding.kind.clone(), points(&finding.place))).collect()
}

/// Strips between curves: all of them one design, by the points of the curves.
fn strips(panels: &[[Vec<Point3>; 2]], thickness_mm: f64) -> Design {
    let name = |n: usize, side: usize| format!("{n}.{side}");
    let curves = panels.iter().enumerate().flat_map(|(n, rails)| {
        rails.iter().enumerate().map(move |(side, points)| DesignCurve {
            name: name(n, side),
            kind: Some(CurveKind::Spline),
            closed: false,
            points: points.iter().copied().map(CurvePoint::smooth).collect(),
        })
    });
    let on = |n: usize, side: usize| CurveUse { name: name(n, side), reversed: false };
    let panel =
        |n: usize| DesignPanel::new(format!("{n}"), PanelShape::Rails([on(n, 0), on(n, 1)]), 100);
    Design {
        name: "divided".into(),
        curves: curves.collect(),
        panels: (0..panels.len()).map(panel).collect(),
        material: Some(steel(thickness_mm)),
        ..Design::default()
    }
}

/// Points of the line at a height on the strip of [`bent::twisted`], between shares of its length.
fn on_helicoid(deg: f64, high: f64, [from, to]: [f64; 2]) -> Vec<Point3> {
    let at = |n: u32| {
        let share = from + (to - from) * f64::from(n) / 12.0;
        let angle = from_deg(deg) * share;
        Point3::new(1200.0 * share, high * cos(angle), high * sin(angle))
    };
    (0..=12).map(at).collect()
}

#[test]
fn a_twisted_strip_is_divided_across_and_its_halves_bend() {
    let whole = made(&Design { material: Some(steel(5.0)), ..bent::twisted(90.0) });
    assert_eq!(whole.parts[0].checked.verdict, Verdict::WillNotBend);
    let found = divisions(&whole);
    let [(FindingKind::BendsDivided { parts, way, strain, verdict }, line)] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!((*parts, *way), (2, CutWay::Across));
    assert_eq!(*verdict, Verdict::BendsAndFolds);
    // The line runs straight through the middle of the strip, from edge to edge.
    let half = 150.0 * cos(from_deg(45.0));
    let mut ends = [*line.first().unwrap(), *line.last().unwrap()];
    ends.sort_by(|a, b| a.z.total_cmp(&b.z));
    for (end, side) in ends.iter().zip([-1.0, 1.0]) {
        let expected = Point3::new(600.0, side * half, side * half);
        assert!(end.distance(expected) < 0.5, "{end:?}");
    }
    // Drawn as two panels, each bends, strained as it was said.
    let halves = [[0.0, 0.5], [0.5, 1.0]];
    let rails = halves.map(|half| [-150.0, 150.0].map(|high| on_helicoid(90.0, high, half)));
    let by_hand = made(&strips(&rails, 5.0));
    for part in &by_hand.parts {
        assert_eq!(part.checked.verdict, *verdict);
        let known = part.predicted.as_ref().unwrap().strain;
        assert!((known / strain - 1.0).abs() < 0.25, "{known} {strain}");
    }
    assert!(divisions(&by_hand).is_empty());
    // Divided lengthwise it would not: that is not what is advised.
    let rails = [[-150.0, 0.0], [0.0, 150.0]]
        .map(|heights| heights.map(|high| on_helicoid(90.0, high, [0.0, 1.0])));
    let lengthwise = made(&strips(&rails, 5.0));
    for part in &lengthwise.parts {
        assert_eq!(part.checked.verdict, Verdict::WillNotBend);
    }
}

/// Rails that wave against one another: the middle between them is straight.
fn against(wave_mm: f64, thickness_mm: f64) -> Design {
    let rail = |y: f64, side: f64| {
        let at = |n: u32| {
            let x = 1000.0 * f64::from(n) / 24.0;
            Point3::new(x, y, side * wave_mm * cos(TAU * x / 500.0))
        };
        (0..=24).map(at).collect::<Vec<_>>()
    };
    strips(&[[rail(0.0, -1.0), rail(300.0, 1.0)]], thickness_mm)
}

#[test]
fn what_no_division_helps_is_said() {
    let part = made(&against(20.0, 3.0));
    assert_eq!(part.parts[0].checked.verdict, Verdict::WillNotBend);
    assert_eq!(divisions(&part), [(FindingKind::DividedInVain { most: 4 }, Vec::new())]);
}

#[test]
fn nothing_is_said_of_what_bends_or_was_judged_by_a_formula() {
    let bends = made(&Design { material: Some(steel(1.0)), ..bent::twisted(10.0) });
    assert_ne!(bends.parts[0].checked.verdict, Verdict::WillNotBend);
    assert!(divisions(&bends).is_empty());
    let mut quick = make_judged(&against(20.0, 3.0), Judging::Quick, &mut Unwatched).unwrap();
    quick.advise(&mut Unwatched);
    assert!(divisions(&quick).is_empty());
    // Thick sheet that is bent tightly stretches at its edges, however it is divided.
    let rim = made(&Design { material: Some(steel(30.0)), ..bent::saddle(150.0) });
    assert_eq!(rim.parts[0].checked.verdict, Verdict::WillNotBend);
    assert!(divisions(&rim).is_empty());
}

#[test]
fn what_is_stopped_adds_nothing() {
    /// Stops all work from the start.
    struct Stopped;
    impl Watch for Stopped {
        fn stop(&self) -> bool {
            true
        }
    }
    let made = make(&against(20.0, 3.0), &mut Unwatched).unwrap();
    let mut stopped = made.clone();
    stopped.advise(&mut Stopped);
    assert_eq!(stopped, made);
}

/// Stops from the n-th time on that it is asked.
struct StopAt(Cell<usize>);

impl Watch for StopAt {
    fn stop(&self) -> bool {
        self.0.set(self.0.get().saturating_sub(1));
        self.0.get() == 0
    }
}

/// Looks for all advice on a design that is edited; how many steps that took.
fn advised(live: &mut Live) -> usize {
    (0..).find(|_| !live.advise(&mut Unwatched)).unwrap()
}

#[test]
fn a_design_that_is_edited_is_advised_on_as_one_that_is_made() {
    let steel_5mm = |deg| Design { material: Some(steel(5.0)), ..bent::twisted(deg) };
    let mut live = Live::default();
    live.follow(steel_5mm(90.0), &mut Unwatched);
    // Nothing is looked for before the sheet is computed.
    assert_eq!(advised(&mut live), 0);
    live.settle(&mut Unwatched);
    // Both halves, and one of the two that it is divided into lengthwise.
    assert_eq!(advised(&mut live), 3);
    assert_eq!(live.made().as_ref(), Ok(&made(live.design())));
    assert_eq!(divisions(&live.made().unwrap()).len(), 1);
    // It stays as long as the panel does.
    live.update(live.design().clone(), &mut Unwatched);
    assert_eq!((advised(&mut live), divisions(&live.made().unwrap()).len()), (0, 1));
    live.update(steel_5mm(91.0), &mut Unwatched);
    assert!(divisions(&live.made().unwrap()).is_empty());
    assert_eq!(advised(&mut live), 3);
    live.update(Design { material: Some(steel(1.0)), ..bent::twisted(10.0) }, &mut Unwatched);
    assert_eq!(advised(&mut live), 0);
    // What none helps takes all divisions, most of them up to the first part that does not bend.
    live.update(against(20.0, 3.0), &mut Unwatched);
    assert!((6..=18).contains(&advised(&mut live)));
    assert_eq!(live.made().as_ref(), Ok(&made(live.design())));
}

#[test]
fn a_search_that_is_stopped_is_taken_up_again() {
    let design = Design { material: Some(steel(5.0)), ..bent::twisted(90.0) };
    let mut live = Live::new(design, &mut Unwatched);
    let expected = made(live.design());
    let mut counted = StopAt(Cell::new(usize::MAX));
    live.clone().advise(&mut counted);
    let asked = usize::MAX - counted.0.get();
    assert!(asked > 10, "{asked}");
    for n in 0..8 {
        assert!(live.advise(&mut StopAt(Cell::new(1 + asked * n / 8))), "{n}");
        assert!(divisions(&live.made().unwrap()).is_empty());
    }
    assert_eq!(advised(&mut live), 3);
    assert_eq!(live.made().as_ref(), Ok(&expected));
}

#[test]
fn lines_lie_beside_the_part_and_on_its_pattern() {
    let whole = made(&Design { material: Some(steel(5.0)), ..bent::twisted(90.0) });
    let part = &whole.parts[0];
    let places = part.checked.findings.iter().map(|finding| &finding.place);
    let lines: Vec<&LinePlace> = places
        .filter_map(|place| match place {
            Place::Lines { lines } => Some(&lines[..]),
            _ => None,
        })
        .flatten()
        .collect();
    let [line] = lines[..] else { panic!("{lines:?}") };
    // From edge to edge: both ends are where the boundary is.
    let ends = [(0, 0), (line.at.len() - 1, line.on_part.len() - 1)];
    for (n, m) in ends {
        assert!(line.at[n].distance(line.on_part[m].0) < 0.5, "{line:?}");
    }
    // As long on the pattern as on the part, which it crosses about the middle of.
    for pair in line.on_part.windows(2) {
        let [(a, flat_a), (b, flat_b)] = [pair[0], pair[1]];
        assert!(flat_a.distance(flat_b) >= a.distance(b) - 1e-6, "{pair:?}");
        assert!(flat_a.distance(flat_b) <= 1.2 * a.distance(b) + 1e-6, "{pair:?}");
    }
    // The sheet is folded, and so not alike on both sides of its middle.
    let middle = line.on_part[line.on_part.len() / 2].1;
    let [along, across] = [middle.x / part.piece.size.x, middle.y / part.piece.size.y];
    let near_half = 0.3..0.7;
    assert!(near_half.contains(&along) && near_half.contains(&across), "{along} {across}");
}

/// The line that a panel is divided along into two, with what is said of them.
fn one_line(made: &Made) -> (CutWay, f64, Verdict, [Point3; 2]) {
    let found = divisions(made);
    let [(FindingKind::BendsDivided { parts: 2, way, strain, verdict }, line)] = &found[..] else {
        panic!("{found:?}");
    };
    (*way, *strain, *verdict, [*line.first().unwrap(), *line.last().unwrap()])
}

/// A design of panels inside closed chains of curves: splines, and polylines where two points are.
fn chains(panels: &[Vec<Vec<Point3>>], thickness_mm: f64) -> Design {
    let name = |n: usize, side: usize| format!("{n}.{side}");
    let curves = panels.iter().enumerate().flat_map(|(n, sides)| {
        sides.iter().enumerate().map(move |(side, points)| DesignCurve {
            name: name(n, side),
            kind: Some(if points.len() == 2 { CurveKind::Polyline } else { CurveKind::Spline }),
            closed: false,
            points: points.iter().copied().map(CurvePoint::smooth).collect(),
        })
    });
    let panel = |(n, sides): (usize, &Vec<Vec<Point3>>)| {
        let on = |side: usize| CurveUse { name: name(n, side), reversed: false };
        let outer = (0..sides.len()).map(on).collect();
        DesignPanel::new(format!("{n}"), PanelShape::Loops { outer, holes: Vec::new() }, 200)
    };
    Design {
        name: "chains".into(),
        curves: curves.collect(),
        panels: panels.iter().enumerate().map(panel).collect(),
        material: Some(steel(thickness_mm)),
        ..Design::default()
    }
}

/// The arc length at which a smooth loop comes nearest to a point, mm.
fn nearest_mm(outline: &Outline, of_loop: usize, to: Point3) -> f64 {
    const STEPS: usize = 2000;
    let off = |mm: f64| outline.at(of_loop, mm, Side::Leaving).position.distance(to);
    let step = outline.length(of_loop) / STEPS as f64;
    let places = (0..STEPS).map(|n| n as f64 * step);
    let mut best = places.min_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap();
    let mut reach = step;
    for _ in 0..40 {
        reach *= 0.5;
        for mm in [best - reach, best + reach] {
            if off(mm) < off(best) {
                best = mm;
            }
        }
    }
    assert!(off(best) < 1e-3, "{}", off(best));
    best
}

/// Points of the arc of a smooth loop from one of its points to another.
fn arc(outline: &Outline, of_loop: usize, [from, to]: [Point3; 2]) -> Vec<Point3> {
    let [a, b] = [from, to].map(|end| nearest_mm(outline, of_loop, end));
    let b = if b > a { b } else { b + outline.length(of_loop) };
    let at =
        |n: u32| outline.at(of_loop, a + (b - a) * f64::from(n) / 60.0, Side::Leaving).position;
    std::iter::once(from).chain((1..60).map(at)).chain([to]).collect()
}

/// Both parts of a panel inside one smooth curve, drawn by hand along the chord between two points.
fn both_parts(whole: &Made, [a, b]: [Point3; 2], thickness_mm: f64) -> Design {
    let outline = &whole.parts[0].found().unwrap().outline;
    let part = |from: Point3, to: Point3| vec![arc(outline, 0, [from, to]), vec![to, from]];
    chains(&[part(a, b), part(b, a)], thickness_mm)
}

/// Panels that were drawn along an advice take their shapes, strained as it says.
fn assert_as_said(by_hand: &Made, strain: f64, verdict: Verdict) {
    let verdicts: Vec<Verdict> = by_hand.parts.iter().map(|part| part.checked.verdict).collect();
    assert!(verdicts.contains(&verdict), "{verdicts:?} {verdict:?}");
    let worst = by_hand.parts.iter().map(|part| part.predicted.as_ref().unwrap());
    for part in worst.clone() {
        assert!(part.usage() <= 1.0 && part.usage_range()[0] < 1.0, "{:?}", part.usage_range());
    }
    let worst = worst.map(|part| part.strain).fold(0.0, f64::max);
    assert!((worst / strain - 1.0).abs() < 0.25, "{worst} {strain}");
}

/// A strip of 1200 x 300 mm with round ends on a helicoid that turns by an angle over its length.
fn round_ended(deg: f64, thickness_mm: f64) -> Design {
    const STRAIGHT: f64 = 900.0;
    const RADIUS: f64 = 150.0;
    const POINTS: u32 = 96;
    let half = STRAIGHT + 0.5 * TAU * RADIUS;
    let point = |n: u32| {
        let along = 2.0 * half * f64::from(n) / f64::from(POINTS);
        // The second half is the first turned by a half turn.
        let (along, turned) = if along < half { (along, 1.0) } else { (along - half, -1.0) };
        let end = ((along - STRAIGHT) / RADIUS).max(0.0);
        let x = along.min(STRAIGHT) - 0.5 * STRAIGHT + RADIUS * sin(end);
        let [x, y] = [x, -RADIUS * cos(end)].map(|at| at * turned);
        let angle = from_deg(deg) * (x / 1200.0 + 0.5);
        Point3::new(x + 600.0, y * cos(angle), y * sin(angle))
    };
    let rim = DesignCurve {
        name: "rim".into(),
        kind: Some(CurveKind::Spline),
        closed: true,
        points: (0..POINTS).map(point).map(CurvePoint::smooth).collect(),
    };
    let outer = vec![CurveUse { name: "rim".into(), reversed: false }];
    let shape = PanelShape::Loops { outer, holes: Vec::new() };
    Design {
        name: "round ends".into(),
        curves: vec![rim],
        panels: vec![DesignPanel::new("sheet", shape, 200)],
        material: Some(steel(thickness_mm)),
        ..Design::default()
    }
}

#[test]
fn a_strip_with_round_ends_is_divided_across() {
    let whole = made(&round_ended(40.0, 3.0));
    assert_eq!(whole.parts[0].checked.verdict, Verdict::WillNotBend);
    let (way, strain, verdict, mut ends) = one_line(&whole);
    assert_eq!(way, CutWay::Across);
    // Through the middle of the strip, straight from edge to edge.
    ends.sort_by(|a, b| a.y.total_cmp(&b.y));
    for (end, side) in ends.iter().zip([-150.0, 150.0]) {
        let angle = from_deg(20.0);
        let expected = Point3::new(600.0, side * cos(angle), side * sin(angle));
        assert!(end.distance(expected) < 1.0, "{end:?}");
    }
    assert_as_said(&made(&both_parts(&whole, ends, 3.0)), strain, verdict);
}

#[test]
fn random_closed_curves_are_divided_where_that_helps() {
    for (seed, thickness_mm) in [(4, 2.0), (17, 2.0)] {
        let design = Design { material: Some(steel(thickness_mm)), ..bent::fourier(seed) };
        let whole = made(&design);
        assert_eq!(whole.parts[0].checked.verdict, Verdict::WillNotBend, "{seed}");
        let (_, strain, verdict, ends) = one_line(&whole);
        assert_as_said(&made(&both_parts(&whole, ends, thickness_mm)), strain, verdict);
    }
}

/// The strip of [`bent::twisted`] between shares of its length, with ends that bulge out by so many
/// mm where they are no cuts.
fn bulging(deg: f64, [from, to]: [f64; 2], [first, last]: [f64; 2]) -> Vec<Vec<Point3>> {
    let end = |share: f64, bulge: f64, side: f64| -> Vec<Point3> {
        let at = |y: f64| {
            let x = 1200.0 * share + bulge * (1.0 - y * y);
            let angle = from_deg(deg) * x / 1200.0;
            Point3::new(x, 150.0 * y * cos(angle), 150.0 * y * sin(angle))
        };
        let steps = if bulge == 0.0 { 1 } else { 24 };
        (0..=steps).map(|n| at(side * (2.0 * f64::from(n) / f64::from(steps) - 1.0))).collect()
    };
    let back = on_helicoid(deg, 150.0, [from, to]).into_iter().rev().collect();
    let forth = on_helicoid(deg, -150.0, [from, to]);
    vec![forth, end(to, last, 1.0), back, end(from, -first, -1.0)]
}

#[test]
fn a_twisted_strip_with_bulging_ends_is_divided_as_one_with_straight_ends() {
    let whole = made(&chains(&[bulging(90.0, [0.0, 1.0], [20.0, 20.0])], 5.0));
    assert_eq!(whole.parts[0].checked.verdict, Verdict::WillNotBend);
    let (way, strain, verdict, ends) = one_line(&whole);
    assert_eq!((way, verdict), (CutWay::Across, Verdict::BendsAndFolds));
    assert!(ends.iter().all(|end| (end.x - 600.0).abs() < 1.0), "{ends:?}");
    let halves = [([0.0, 0.5], [20.0, 0.0]), ([0.5, 1.0], [0.0, 20.0])];
    let halves = halves.map(|(part, bulges)| bulging(90.0, part, bulges));
    assert_as_said(&made(&chains(&halves, 5.0)), strain, verdict);
}

#[test]
fn a_closed_curve_that_no_division_helps_is_told_so() {
    let design = Design { material: Some(steel(4.0)), ..bent::fourier(17) };
    let whole = made(&design);
    assert_eq!(whole.parts[0].checked.verdict, Verdict::WillNotBend);
    assert_eq!(divisions(&whole), [(FindingKind::DividedInVain { most: 4 }, Vec::new())]);
    let mut live = Live::new(design, &mut Unwatched);
    // All six divisions, and at most nine parts each way.
    assert!((6..=18).contains(&advised(&mut live)));
    assert_eq!(live.made().as_ref(), Ok(&whole));
}

#[test]
fn a_line_through_a_hole_opens_it() {
    let mut design = round_ended(30.0, 3.0);
    let point = |n: u32| {
        let turn = -TAU * f64::from(n) / 24.0;
        let (x, y) = (600.0 + 60.0 * cos(turn), 60.0 * sin(turn));
        let angle = from_deg(30.0) * x / 1200.0;
        CurvePoint::smooth(Point3::new(x, y * cos(angle), y * sin(angle)))
    };
    design.curves.push(DesignCurve {
        name: "hole".into(),
        kind: Some(CurveKind::Spline),
        closed: true,
        points: (0..24).map(point).collect(),
    });
    let [outer, hole] = ["rim", "hole"].map(|name| CurveUse { name: name.into(), reversed: false });
    let shape = PanelShape::Loops { outer: vec![outer], holes: vec![vec![hole]] };
    design.panels = vec![DesignPanel::new("sheet", shape, 200)];
    let whole = made(&design);
    assert_eq!(whole.parts[0].checked.verdict, Verdict::WillNotBend);
    let found = divisions(&whole);
    let [(FindingKind::BendsDivided { parts: 2, way, strain, verdict }, points)] = &found[..]
    else {
        panic!("{found:?}");
    };
    // Along the middle of the strip, from end to end, but for the hole.
    assert_eq!((*way, points.len()), (CutWay::Lengthwise, 18));
    let mut ends = [0, 8, 9, 17].map(|n: usize| points[n]);
    ends.sort_by(|a, b| a.x.total_cmp(&b.x));
    for (end, x) in ends.iter().zip([0.0, 540.0, 660.0, 1200.0]) {
        assert!((end.x - x).abs() < 2.0, "{ends:?}");
    }
    let [a, b, c, d] = ends;
    let outline = &whole.parts[0].found().unwrap().outline;
    let rim = |ends: [Point3; 2]| arc(outline, 0, ends);
    let hole = |ends: [Point3; 2]| arc(outline, 1, ends);
    let halves = [
        vec![rim([a, d]), vec![d, c], hole([c, b]), vec![b, a]],
        vec![rim([d, a]), vec![a, b], hole([b, c]), vec![c, d]],
    ];
    assert_as_said(&made(&chains(&halves, 3.0)), *strain, *verdict);
}
