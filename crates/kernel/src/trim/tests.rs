//! Trims on outlines that are known, and on random ones.

use super::{TrimFault, TrimNote, TrimPart, Trimmed, trimmed};
use crate::design::{
    Allowance, Corner, Fingers, Flange, Hem, Holes, NotchForm, Notches, Places, Puzzle, Slots,
    Tabs, Ticks, Trim, TrimKind, TrimOn,
};
use crate::edge::{Edge, EdgePlace, EdgeSource, shared};
use crate::pattern::PathKind;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point2, Point3, Vec2, cos, from_deg, sin};
use sheetwright_geometry::predicate::{Box2, first_crossing, inside, signed_area_doubled};
use sheetwright_geometry::region::Region;
use sheetwright_shapes::random::Random;

/// A flat part whose edges are the sides of its loops.
struct Flat {
    name: String,
    edges: Vec<Edge>,
    shown: Vec<String>,
    space: Vec<Point3>,
    flat: Vec<Point2>,
    triangles: Vec<[VertexIndex; 3]>,
}

impl Flat {
    fn new(name: &str, loops: &[Vec<Point2>]) -> Self {
        let flat: Vec<Point2> = loops.iter().flatten().copied().collect();
        let space: Vec<Point3> = flat.iter().map(|p| Point3::new(p.x, p.y, 0.0)).collect();
        let (mut edges, mut start) = (Vec::new(), 0);
        for line in loops {
            let m = line.len();
            for n in 0..m {
                let run = vec![start + n, start + (n + 1) % m];
                let (name, source) = (format!("e{}", edges.len()), EdgeSource::Border);
                edges.push(Edge::new(name, source, run, &space, &flat));
            }
            start += m;
        }
        let shown = edges.iter().map(|edge| edge.name.clone()).collect();
        Self { name: name.to_owned(), edges, shown, space, flat, triangles: Vec::new() }
    }

    /// Where the points of an edge lie in space.
    fn points(&self, edge: usize) -> Vec<Point3> {
        self.edges[edge].run.iter().map(|&v| self.space[v]).collect()
    }

    fn seen(&self) -> TrimPart<'_> {
        let Self { name, edges, shown, space, flat, triangles } = self;
        TrimPart { name, panel: name, edges, shown, space, flat, triangles }
    }
}

fn trim(parts: &[Flat], trims: &[Trim]) -> Result<Vec<Trimmed>, TrimFault> {
    let seen: Vec<TrimPart<'_>> = parts.iter().map(Flat::seen).collect();
    trimmed(&seen, trims).map_err(|(_, fault)| fault)
}

fn points(list: &[(f64, f64)]) -> Vec<Point2> {
    list.iter().map(|&(x, y)| Point2::new(x, y)).collect()
}

fn rectangle(width: f64, height: f64) -> Vec<Point2> {
    points(&[(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)])
}

fn allowance(width: f64, corner: Corner) -> TrimKind {
    TrimKind::Allowance(Allowance { width: [width; 2], corner })
}

fn on_all(kind: TrimKind) -> Trim {
    Trim::new([TrimOn::All], kind)
}

fn on(edges: &[&str], kind: TrimKind) -> Trim {
    let named = |edge: &&str| {
        let (part, edge) =
            edge.split_once('/').map_or((None, *edge), |(part, edge)| (Some(part), edge));
        TrimOn::Edge { part: part.map(str::to_owned), edge: edge.to_owned() }
    };
    Trim::new(edges.iter().map(named), kind)
}

fn cut(trimmed: &Trimmed) -> &Region {
    trimmed.cut.as_ref().unwrap()
}

fn loops(region: &Region) -> Vec<Vec<Point2>> {
    std::iter::once(&region.outline).chain(&region.holes).cloned().collect()
}

/// Whether the region has these corners and no other.
fn has_corners(region: &Region, wanted: &[(f64, f64)]) -> bool {
    let near = |p: &Point2, &(x, y): &(f64, f64)| p.distance(Point2::new(x, y)) < 1e-7;
    region.outline.len() == wanted.len()
        && wanted.iter().all(|w| region.outline.iter().any(|p| near(p, w)))
}

/// The distance between two segments that do not cross.
fn apart(a: [Point2; 2], b: [Point2; 2]) -> f64 {
    let off = |p: Point2, [from, to]: [Point2; 2]| {
        let share = (p - from).dot(to - from) / (to - from).length_squared();
        p.distance(from.lerp(to, share.clamp(0.0, 1.0)))
    };
    off(a[0], b).min(off(a[1], b)).min(off(b[0], a)).min(off(b[1], a))
}

fn sides(line: &[Point2]) -> impl Iterator<Item = [Point2; 2]> + '_ {
    (0..line.len()).map(|n| [line[n], line[(n + 1) % line.len()]])
}

fn assert_sound(net: &[Vec<Point2>], made: &Trimmed, what: &str) {
    let unproved = |note: &TrimNote| matches!(note, TrimNote::NotProved { .. });
    assert!(!made.notes.iter().any(unproved), "{what}: {:?}", made.notes);
    // The outline and a hole may touch in a point, where a gap is just closed.
    for line in loops(cut(made)) {
        assert_eq!(first_crossing(&line), None, "{what}: the cut line crosses itself: {line:?}");
    }
    assert!(cut(made).area_mm2() > 0.0 && !net.is_empty());
}

/// A closed line around a point, of a random form: round, jagged, or thin as a needle.
fn random_line(random: &mut Random, size: f64) -> Vec<Point2> {
    let count = 3 + random.below(12);
    let squeeze = [1.0, 0.3, 0.02][random.below(3)];
    let jag = [0.0, 0.4, 0.9][random.below(3)];
    let turn = from_deg(random.between(0.0, 360.0));
    let corner = |n: usize, r: f64| {
        let angle = from_deg(360.0 * (n as f64) / count as f64);
        let (x, y) = (r * cos(angle), squeeze * r * sin(angle));
        Point2::new(x * cos(turn) - y * sin(turn), x * sin(turn) + y * cos(turn))
    };
    (0..count).map(|n| corner(n, size * random.between(1.0 - jag, 1.0))).collect()
}

#[test]
fn the_cut_line_keeps_its_distance_from_random_outlines() {
    let mut random = Random::new(40);
    let mut closed = 0;
    for n in 0..3000 {
        let mut net = vec![random_line(&mut random, 100.0)];
        if n % 3 == 0 {
            let scale = random.between(0.05, 0.3);
            let hole = net[0].iter().rev().map(|p| Point2::default() + p.to_vec() * scale);
            let hole: Vec<Point2> = hole.collect();
            net.push(hole);
        }
        if signed_area_doubled(&net[0]) <= 0.0 {
            continue;
        }
        let flat = [Flat::new("a", &net)];
        let shorter = flat[0].seen().shorter_mm();
        let width = shorter * random.between(0.001, 0.999);
        let made = trim(&flat, &[on_all(allowance(width, Corner::ByLength))]).unwrap();
        let what = format!("outline {n}, {width} mm");
        assert_sound(&net, &made[0], &what);
        closed += made[0].notes.len();
        let of_cut = loops(cut(&made[0]));
        for side in of_cut.iter().flat_map(|line| sides(line)) {
            for of_net in net.iter().flat_map(|line| sides(line)) {
                let off = apart(side, of_net);
                assert!(off >= width - 1e-6, "{what}: {off} mm between {side:?} and {of_net:?}");
            }
        }
    }
    assert!((100..2900).contains(&closed), "{closed} notes on holes and gaps that are closed");
}

#[test]
fn every_style_of_corner_is_sound_on_random_outlines() {
    let mut random = Random::new(41);
    let styles = [
        Corner::ByIntersection,
        Corner::FirstEdgeSymmetry,
        Corner::SecondEdgeSymmetry,
        Corner::FirstEdgeRightAngle,
        Corner::SecondEdgeRightAngle,
    ];
    for n in 0..1000 {
        let net = vec![random_line(&mut random, 100.0)];
        if signed_area_doubled(&net[0]) <= 0.0 {
            continue;
        }
        let flat = [Flat::new("a", &net)];
        let most = flat[0].seen().shorter_mm();
        let mut width = || most * random.between(0.01, 0.5);
        let kind =
            |width: [f64; 2], corner: Corner| TrimKind::Allowance(Allowance { width, corner });
        let trims: Vec<Trim> = (0..net[0].len())
            .map(|edge| on(&[&format!("e{edge}")], kind([width(), width()], styles[n % 5])))
            .collect();
        let made = trim(&flat, &trims).unwrap();
        assert_sound(&net, &made[0], &format!("outline {n}, {:?}", styles[n % 5]));
    }
}

#[test]
fn corners_are_those_of_pattern_makers() {
    // A right angle, 10 mm beyond the first edge (below) and 20 mm beyond the second (right).
    let of = |corner: Corner, net: Vec<Point2>| {
        let trims = [on(&["e0"], allowance(10.0, corner)), on(&["e1"], allowance(20.0, corner))];
        trim(&[Flat::new("a", &[net])], &trims).unwrap().remove(0)
    };
    let square = |corner: Corner| of(corner, rectangle(100.0, 100.0));
    let common = [(0.0, -10.0), (0.0, 0.0), (0.0, 100.0), (120.0, 100.0)];
    let with = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
        // The corner at the origin lies on a straight line.
        let rest = common.iter().filter(|p| **p != (0.0, 0.0)).copied();
        points.iter().copied().chain(rest).collect()
    };
    let tip = with(&[(120.0, -10.0)]);
    let by_length = square(Corner::ByLength);
    assert!(has_corners(cut(&by_length), &tip), "{:?}", by_length.cut);
    let straight = with(&[(100.0, -10.0), (120.0, 0.0)]);
    assert!(has_corners(cut(&square(Corner::ByIntersection)), &straight));
    // At a right angle, a mirror and a right angle are the tip.
    for corner in [
        Corner::FirstEdgeSymmetry,
        Corner::SecondEdgeSymmetry,
        Corner::FirstEdgeRightAngle,
        Corner::SecondEdgeRightAngle,
    ] {
        let made = square(corner);
        assert!(has_corners(cut(&made), &tip), "{corner:?}: {:?}", made.cut);
    }
    // At 45°, the first edge's allowance, folded over, ends along the second's cut line.
    let net = points(&[(0.0, 0.0), (100.0, 0.0), (0.0, 100.0)]);
    let made = of(Corner::FirstEdgeSymmetry, net);
    let root = 20.0 * 2f64.sqrt();
    let found =
        cut(&made).outline.iter().any(|p| p.distance(Point2::new(100.0 + root, 0.0)) < 1e-6);
    let mirrored = Point2::new(100.0 + root - 10.0, -10.0);
    assert!(found && cut(&made).outline.iter().any(|p| p.distance(mirrored) < 1e-6), "{made:?}");
}

#[test]
fn a_needle_is_cut_off_and_an_edge_alone_ends_squarely() {
    let needle = points(&[(0.0, 0.0), (200.0, 0.0), (0.0, 20.0)]);
    let made = trim(&[Flat::new("a", &[needle])], &[on_all(allowance(10.0, Corner::ByLength))]);
    let made = made.unwrap().remove(0);
    let right = cut(&made).outline.iter().map(|p| p.x).fold(0.0, f64::max);
    assert!((220.0..=226.0).contains(&right), "the tip is cut off at 25 mm: {right}");
    let one = trim(
        &[Flat::new("a", &[rectangle(50.0, 30.0)])],
        &[on(&["e0"], allowance(8.0, Corner::ByLength))],
    );
    let wanted = [(0.0, -8.0), (50.0, -8.0), (50.0, 30.0), (0.0, 30.0)];
    assert!(has_corners(cut(&one.unwrap()[0]), &wanted));
}

#[test]
fn hems_and_flanges_have_their_folds() {
    let flat = [Flat::new("a", &[rectangle(100.0, 60.0)])];
    let hem = TrimKind::Hem(Hem { width: 20.0, turn: 10.0 });
    let made = trim(&flat, &[on(&["e0"], hem)]).unwrap().remove(0);
    let folds: Vec<&Vec<Point2>> = made.paths.iter().map(|path| &path.points).collect();
    assert_eq!(folds[0], &points(&[(0.0, 0.0), (100.0, 0.0)]));
    assert_eq!(folds[1], &points(&[(0.0, -20.0), (100.0, -20.0)]));
    assert!((cut(&made).area_mm2() - 100.0 * 90.0).abs() < 1e-6);

    // Four flanges of a tray keep 2 mm from its corners.
    let flange = TrimKind::Flange(Flange { width: 25.0, angle: from_deg(90.0), relief: 2.0 });
    let made = trim(&flat, &[on_all(flange.clone())]).unwrap().remove(0);
    assert_eq!(made.paths.len(), 4);
    let area = 100.0 * 60.0 + 25.0 * 2.0 * (96.0 + 56.0);
    assert!((cut(&made).area_mm2() - area).abs() < 1e-6);

    // At a corner that goes in, they part along its middle, and do not overlap.
    let corner = points(&[(0., 0.), (100., 0.), (100., 100.), (60., 100.), (60., 60.), (0., 60.)]);
    let made = trim(&[Flat::new("l", &[corner])], &[on_all(flange)]).unwrap().remove(0);
    let middle = Point2::new(50.0, 70.0);
    let lines = loops(cut(&made));
    let nearest = lines
        .iter()
        .flat_map(|l| sides(l))
        .map(|s| apart(s, [middle, middle + Vec2::new(1e-9, 0.0)]));
    let nearest = nearest.fold(f64::INFINITY, f64::min);
    assert!((nearest - 1.0).abs() < 1e-6, "a gap of 2 mm: {nearest}");
}

/// Two rectangles beside one another, joined along the right side of the first.
fn joined(height: f64) -> [Flat; 2] {
    let mut left = Flat::new("left", &[rectangle(100.0, height)]);
    let mut right = Flat::new("right", &[rectangle(40.0, height)]);
    for p in &mut right.space {
        p.x += 100.0;
    }
    left.edges[1].mates = vec![EdgePlace { part: 1, edge: 3 }];
    right.edges[3].mates = vec![EdgePlace { part: 0, edge: 1 }];
    let (first, second) = (left.points(1), right.points(3));
    left.edges[1].common = vec![shared((&first, false), (&second, false))];
    right.edges[3].common = vec![shared((&second, false), (&first, false))];
    [left, right]
}

fn tabs(width: f64) -> TrimKind {
    TrimKind::Tabs(Tabs { width, angle: from_deg(45.0), tolerance: 0.3 })
}

#[test]
fn a_joint_has_tabs_on_one_side_and_they_hide() {
    let parts = joined(60.0);
    let made = trim(&parts, &[Trim::new([TrimOn::Joined], tabs(8.0))]).unwrap();
    let with_tabs = made.iter().filter(|part| part.cut.is_some()).count();
    assert_eq!(with_tabs, 1);
    assert_eq!(made[0].paths.len(), 1);
    // Named, the other side has them.
    let named = trim(&parts, &[on(&["right/e3"], tabs(8.0))]).unwrap();
    assert!(named[0].cut.is_none() && named[1].cut.is_some());
    let area = 40.0 * 60.0 + 8.0 * (60.0 - 8.0);
    assert!((cut(&named[1]).area_mm2() - area).abs() < 1e-6);
    // A neighbour that is narrower than the tab: the tab gets narrower, too.
    let mut narrow = joined(60.0);
    narrow[1].flat = points(&[(0.0, 0.0), (5.0, 0.0), (5.0, 60.0), (0.0, 60.0)]);
    let made = trim(&narrow, &[on(&["left/e1"], tabs(8.0))]).unwrap();
    let depth = cut(&made[0]).outline.iter().map(|p| p.x).fold(0.0, f64::max) - 100.0;
    assert!((2.0..5.0).contains(&depth), "{depth}");
    assert_eq!(
        trim(&parts, &[on(&["left/e0"], tabs(8.0))]).err(),
        Some(TrimFault::NoMate { what: "tabs", edge: "left/e0".to_owned() })
    );
}

#[test]
fn holes_meet_on_both_sides_of_a_joint() {
    let parts = joined(605.0);
    let holes = Holes {
        pitch: 100.0,
        end_pitch: 50.0,
        end_length: 100.0,
        ends: 20.0,
        inset: 10.0,
        diameter: 1.5,
    };
    let made = trim(&parts, &[Trim::new([TrimOn::Joined], TrimKind::Holes(holes))]).unwrap();
    let centres = |part: &Trimmed| -> Vec<Point2> {
        let drilled = part.paths.iter().filter(|p| matches!(p.kind, PathKind::Drill { .. }));
        drilled.map(|p| p.points[0].lerp(p.points[12], 0.5)).collect()
    };
    let [left, right] = [0, 1].map(|n| centres(&made[n]));
    assert_eq!(left.len(), right.len());
    assert!(left.len() >= 8 && made.iter().all(|part| part.cut.is_none()));
    for (a, b) in left.iter().zip(&right) {
        assert!((a.x - 90.0).abs() < 1e-9 && (b.x - 10.0).abs() < 1e-9);
        assert!((a.y - b.y).abs() < 1e-9, "they meet");
    }
    let dense = Holes { pitch: 1.0, end_pitch: 1.0, ..holes };
    assert_eq!(
        trim(&parts, &[on_all(TrimKind::Holes(dense))]).err(),
        Some(TrimFault::TooDense { edge: "left/e0".to_owned(), pitch_mm: 1.0, diameter_mm: 1.5 })
    );
}

#[test]
fn notches_stand_in_the_allowance_and_meet() {
    let parts = joined(60.0);
    let notches = |form: NotchForm, depth: f64| {
        let at = Places::Shares(vec![0.5]);
        TrimKind::Notches(Notches { at, form, depth, width: 4.0, count: 2, gap: 6.0 })
    };
    let with = |kind: TrimKind| {
        let joined = Trim::new([TrimOn::Joined], kind);
        trim(&parts, &[on_all(allowance(10.0, Corner::ByLength)), joined])
    };
    let whole =
        cut(&trim(&parts, &[on_all(allowance(10.0, Corner::ByLength))]).unwrap()[1]).area_mm2();
    let slits = with(notches(NotchForm::Slit, 5.0)).unwrap();
    assert_eq!(slits[0].paths.len(), 2);
    assert_eq!(slits[0].paths[0].points[0].x, 110.0);
    assert_eq!(slits[0].paths[0].points[1].x, 105.0);
    for (form, more) in [(NotchForm::V, -20.0), (NotchForm::VOut, 20.0), (NotchForm::Castle, 40.0)]
    {
        let made = with(notches(form, 5.0)).unwrap();
        let differs = cut(&made[1]).area_mm2() - whole;
        assert!((differs - more).abs() < 1e-6, "{form:?}: {differs}");
    }
    let deep = TrimFault::TooDeep { edge: "left/e1".into(), depth_mm: 12.0, margin_mm: 10.0 };
    assert_eq!(with(notches(NotchForm::V, 12.0)).err(), Some(deep));
}

#[test]
fn ticks_are_numbered_through_the_design() {
    let parts = joined(60.0);
    let ticks = TrimKind::Ticks(Ticks { at: Places::Every(20.0), length: 3.0, numbered: true });
    let made = trim(&parts, &[Trim::new([TrimOn::Joined], ticks)]).unwrap();
    let texts = |part: &Trimmed| part.labels.iter().map(|l| l.text.clone()).collect::<Vec<_>>();
    assert_eq!(texts(&made[0]), ["1", "2", "3"]);
    assert_eq!(texts(&made[1]), ["1", "2", "3"]);
}

#[test]
fn fingers_and_knobs_fit_into_the_other_side() {
    let parts = joined(60.0);
    let fingers = TrimKind::Fingers(Fingers { width: 12.0, depth: 3.0, clearance: 0.0 });
    let made = trim(&parts, &[Trim::new([TrimOn::Joined], fingers)]).unwrap();
    let more = |n: usize, plain: f64| cut(&made[n]).area_mm2() - plain;
    let sum = more(0, 6000.0) + more(1, 2400.0);
    assert!((sum - 180.0).abs() < 1e-6, "together they fill the joint: {sum}");
    let knobs = TrimKind::Puzzle(Puzzle { pitch: 20.0, width: 10.0, clearance: 0.2 });
    let made = trim(&parts, &[Trim::new([TrimOn::Joined], knobs)]).unwrap();
    let [left, right] = [0, 1].map(|n| cut(&made[n]).area_mm2());
    assert!(left > 6000.0 && right < 2400.0 && left + right < 8400.0, "{left}, {right}");
}

const SLOTS: Slots = Slots {
    pitch: 20.0,
    width: 10.0,
    depth: 4.0,
    thickness: 3.0,
    clearance: 0.2,
    beyond: 5.0,
    dogbone: 0.0,
};

#[test]
fn tabs_go_through_slots_in_a_strip_beyond_the_other_net_line() {
    let parts = joined(60.0);
    let made = trim(&parts, &[Trim::new([TrimOn::Joined], TrimKind::Slots(SLOTS))]).unwrap();
    let areas = [0, 1].map(|n| cut(&made[n]).area_mm2());
    assert!((areas[0] - 6000.0 - 3.0 * 40.0).abs() < 1e-6, "three tabs: {}", areas[0]);
    let strip_mm2 = 60.0 * 8.2 - 3.0 * 10.2 * 3.2;
    assert!((areas[1] - 2400.0 - strip_mm2).abs() < 1e-6, "{}", areas[1]);
    let holes = &made[1].cut.as_ref().unwrap().holes;
    assert_eq!(holes.len(), 3);
    assert!(made.iter().all(|part| part.notes.is_empty()), "{:?}", made[1].notes);
    // Each slot is closed, and its middle lies beside that of its tab.
    for hole in holes {
        let area = 0.5 * signed_area_doubled(hole).abs();
        assert!((area - 10.2 * 3.2).abs() < 1e-6, "{area}");
    }
    // Holes in the corners lengthen a slot by their radius at both ends, and widen it nowhere.
    let dogbones = TrimKind::Slots(Slots { dogbone: 1.5, ..SLOTS });
    let made = trim(&parts, &[Trim::new([TrimOn::Joined], dogbones)]).unwrap();
    let size = |hole: &Vec<Point2>| {
        let around = Box2::of_points(hole.iter().copied()).unwrap();
        let size = around.max - around.min;
        [size.x.max(size.y), size.x.min(size.y)]
    };
    let region = made[1].cut.as_ref().unwrap();
    assert_eq!(region.holes.len(), 3);
    for [long, wide] in region.holes.iter().map(size) {
        assert!((long - 11.7).abs() < 1e-2 && (wide - 3.2).abs() < 1e-6, "{long} {wide}");
    }
}

#[test]
fn slots_that_meet_and_corners_wider_than_slots_are_refused() {
    let parts = joined(60.0);
    let fault = |slots: Slots| {
        trim(&parts, &[Trim::new([TrimOn::Joined], TrimKind::Slots(slots))]).err().unwrap()
    };
    let meeting = fault(Slots { width: 20.0, ..SLOTS });
    assert!(matches!(meeting, TrimFault::SlotsMeet { pitch_mm: 20.0, .. }), "{meeting}");
    let wide = fault(Slots { dogbone: 3.5, ..SLOTS });
    assert!(matches!(wide, TrimFault::DogboneWide { .. }), "{wide}");
}

#[test]
fn what_cannot_be_made_is_said() {
    let flat = [Flat::new("a", &[rectangle(50.0, 30.0)])];
    let wide = trim(&flat, &[on_all(allowance(31.0, Corner::ByLength))]);
    assert!(matches!(wide.err(), Some(TrimFault::TooWide { part_mm, .. }) if part_mm == 30.0));
    let unknown = trim(&flat, &[on(&["chine"], allowance(3.0, Corner::ByLength))]).err().unwrap();
    let text = unknown.to_string();
    assert_eq!(text, "no edge is called 'chine'; there are a/e0, a/e1, a/e2, a/e3");
    let far = [Flat::new("a", &[rectangle(2e9, 2e9)])];
    let large = trim(&far, &[on_all(allowance(3.0, Corner::ByLength))]).err().unwrap();
    assert!(large.to_string().contains("larger than 2000 km"), "{large}");
    // The later trim on an edge holds.
    let two = [on_all(allowance(3.0, Corner::ByLength)), on_all(allowance(5.0, Corner::ByLength))];
    let made = trim(&flat, &two).unwrap();
    assert!((cut(&made[0]).area_mm2() - 60.0 * 40.0).abs() < 1e-6);
}

/// A strip of this height with points at `flat` along its lower and upper edge, which lie in space
/// at `space` and straight above. Its lower edge is e0.
fn strip(flat: &[f64], space: &[(f64, f64)], height: f64) -> Flat {
    let count = flat.len();
    let row = |y: f64| flat.iter().map(move |&x| Point2::new(x, y));
    let points: Vec<Point2> = row(0.0).chain(row(height)).collect();
    let in_space = |z: f64| space.iter().map(move |&(x, y)| Point3::new(x, y, z));
    let space: Vec<Point3> = in_space(0.0).chain(in_space(height)).collect();
    let runs: [Vec<usize>; 4] = [
        (0..count).collect(),
        vec![count - 1, 2 * count - 1],
        (count..2 * count).rev().collect(),
        vec![count, 0],
    ];
    let edge = |(n, run): (usize, Vec<usize>)| {
        Edge::new(format!("e{n}"), EdgeSource::Border, run, &space, &points)
    };
    let edges: Vec<Edge> = runs.into_iter().enumerate().map(edge).collect();
    let shown = edges.iter().map(|edge| edge.name.clone()).collect();
    let cell = |n: usize| [[n, n + 1, count + n + 1], [n, count + n + 1, count + n]];
    let triangles = (0..count - 1).flat_map(cell).map(|t| t.map(VertexIndex::new)).collect();
    Flat { name: "a".to_owned(), edges, shown, space, flat: points, triangles }
}

fn flange(width: f64) -> TrimKind {
    TrimKind::Flange(Flange { width, angle: from_deg(90.0), relief: 2.0 })
}

#[test]
fn a_flange_is_parted_where_its_edge_has_a_corner_in_space() {
    // Round a square duct: on the pattern, its edge is straight.
    let flat = [0.0, 100.0, 200.0, 300.0, 400.0];
    let square = [(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0), (0.0, 0.0)];
    let made = trim(&[strip(&flat, &square, 100.0)], &[on(&["e0"], flange(25.0))]).unwrap();
    let has = |x: f64, y: f64| inside(&cut(&made[0]).outline, Point2::new(x, y));
    for corner in [100.0, 200.0, 300.0] {
        for y in [-1.0, -12.0, -24.0] {
            assert!(!has(corner, y) && !has(corner - 1.9, y) && !has(corner + 1.9, y), "{corner}");
            assert!(has(corner - 2.1, y) && has(corner + 2.1, y), "{corner}");
        }
    }
    let folds = made[0].paths.iter().filter(|path| matches!(path.kind, PathKind::TrimFold { .. }));
    assert_eq!(folds.count(), 4);
    assert_eq!(made[0].notes, []);
}

#[test]
fn a_flange_is_parted_at_the_corners_of_a_closed_edge() {
    // One curve round a square: where it begins is a corner as well.
    let (points, run) = (rectangle(100.0, 100.0), vec![0, 1, 2, 3, 0]);
    let space: Vec<Point3> = points.iter().map(|p| Point3::new(p.x, p.y, 0.0)).collect();
    let edges = vec![Edge::new("e0".into(), EdgeSource::Border, run, &space, &points)];
    let triangles = Vec::new();
    let shown = vec!["e0".to_owned()];
    let square = Flat { name: "a".to_owned(), edges, shown, space, flat: points, triangles };
    let made = trim(&[square], &[on(&["e0"], flange(25.0))]).unwrap();
    let around = Box2::of_points(cut(&made[0]).outline.iter().copied()).unwrap();
    assert!((around.max - around.min).distance(Vec2::new(150.0, 150.0)) < 1e-9);
    // Four rectangles of 96 mm by 25 mm.
    assert!((cut(&made[0]).area_mm2() - 10_000.0 - 4.0 * 96.0 * 25.0).abs() < 1e-6);
}

#[test]
fn a_flange_round_a_curve_says_by_how_much_it_stretches() {
    let (radius, width, steps) = (100.0, 25.0, 90);
    let turn = |n: usize| from_deg(2.0 * n as f64);
    let chord = 2.0 * radius * sin(from_deg(1.0));
    let flat: Vec<f64> = (0..=steps).map(|n| chord * n as f64).collect();
    for (side, wanted) in [(-1.0, 0.25), (1.0, -0.25)] {
        // Seen from outside, or from inside: the flange is bent towards the viewer.
        let round = |n: usize| (radius * sin(turn(n)), side * radius * cos(turn(n)));
        let space: Vec<(f64, f64)> = (0..=steps).map(round).collect();
        let half_pipe = strip(&flat, &space, 200.0);
        let made = trim(&[half_pipe], &[on(&["e0"], flange(width))]).unwrap();
        let [TrimNote::FlangeStretches { edge, flat_mm, bent_mm }] = &made[0].notes[..] else {
            panic!("{:?}", made[0].notes);
        };
        assert_eq!(edge, "a/e0");
        assert!((flat_mm - chord * steps as f64).abs() < 1e-9);
        // Half a step at each end of the rim is straight: that share does not stretch.
        let wanted = wanted * (1.0 - 1.0 / steps as f64);
        assert!((bent_mm / flat_mm - 1.0 - wanted).abs() < 1e-3, "{bent_mm} {flat_mm}");
    }
}
