//! Parts on sheets: nothing overlaps, nothing is lost, nothing lies against its grain, and the same
//! bits come out every time.

use sheetwright::math::{Point2, Vec2, cos, sin};
use sheetwright::nest::{
    Nest, NestFault, NestForm, NestOptions, NestPart, NestSheet, Turns, first_fault, nest,
};
use sheetwright::watch::{Unwatched, Watch};
use sheetwright_shapes::random::Random;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn ring(count: usize, radius: impl Fn(usize) -> f64, middle: [f64; 2]) -> Vec<Point2> {
    let at = |n: usize| {
        let angle = TAU * n as f64 / count as f64;
        Point2::new(middle[0] + radius(n) * cos(angle), middle[1] + radius(n) * sin(angle))
    };
    (0..count).map(at).collect()
}

fn rectangle(width: f64, height: f64) -> Vec<Point2> {
    [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]]
        .map(|[x, y]| Point2::new(x, y))
        .to_vec()
}

/// A part of a random kind: convex, thin, concave, with a hole, a rectangle, a circle.
fn random_loops(random: &mut Random) -> Vec<Vec<Point2>> {
    let size = random.between(20.0, 400.0);
    match random.below(6) {
        0 => vec![ring(3 + random.below(6), |_| size, [300.0, -100.0])],
        1 => vec![rectangle(2.0 * size, random.between(0.5, 10.0))],
        2 => {
            let radii: Vec<f64> = (0..24).map(|_| size * random.between(0.3, 1.0)).collect();
            vec![ring(24, |n| radii[n], [0.0, 50.0])]
        }
        3 => {
            let hole = size * random.between(0.2, 0.9);
            vec![ring(30, |_| size, [0.0, 0.0]), ring(20, |_| hole, [0.0, 0.0])]
        }
        4 => vec![rectangle(size, random.between(0.2, 1.0) * size)],
        _ => vec![ring(64, |_| size, [0.0, 0.0])],
    }
}

fn random_turns(random: &mut Random) -> Turns {
    let angles = match random.below(4) {
        0 | 1 => Vec::new(),
        2 => vec![0.0, PI],
        _ => (0..4).map(|n| FRAC_PI_2 * f64::from(n)).collect(),
    };
    let tolerance = if random.below(3) == 0 { 0.05 } else { 0.0 };
    Turns { angles, tolerance, may_turn_over: random.below(3) == 0 }
}

fn random_sheets(random: &mut Random) -> Vec<NestSheet> {
    let sheet = |random: &mut Random| {
        let [a, b] = [random.between(200.0, 1500.0), random.between(200.0, 1500.0)];
        let form = match random.below(5) {
            0 => NestForm::Roll(a),
            1 => NestForm::Outline(
                [[0.0, 0.0], [a, 0.0], [a, 0.4 * b], [0.5 * a, 0.4 * b], [0.5 * a, b], [0.0, b]]
                    .map(|[x, y]| Point2::new(x, y))
                    .to_vec(),
            ),
            _ => NestForm::Rectangle([a, b]),
        };
        let count = (random.below(3) == 0).then(|| 1 + random.below(2));
        let cost = (random.below(2) == 0).then(|| random.between(1.0, 100.0));
        NestSheet { form, count, cost }
    };
    (0..1 + random.below(2)).map(|_| sheet(random)).collect()
}

fn laid(parts: &[NestPart], sheets: &[NestSheet], options: NestOptions) -> Nest {
    let found = nest(parts, sheets, options, &mut Unwatched);
    assert_eq!(first_fault(&found, parts, sheets, options), None);
    found
}

const SHEET: NestSheet =
    NestSheet { form: NestForm::Rectangle([1220.0, 2440.0]), count: None, cost: None };

fn part(loops: Vec<Vec<Point2>>, count: usize) -> NestPart {
    NestPart { loops, count, turns: Turns::FREE, group: None }
}

/// A set and its layout as a line of JSON, for programs of others to check.
fn as_json(parts: &[NestPart], sheets: &[NestSheet], options: NestOptions, nest: &Nest) -> String {
    let line = |points: &[Point2]| {
        let points: Vec<String> = points.iter().map(|p| format!("[{},{}]", p.x, p.y)).collect();
        format!("[{}]", points.join(","))
    };
    let list = |items: Vec<String>| format!("[{}]", items.join(","));
    let loops = |loops: &[Vec<Point2>]| list(loops.iter().map(|points| line(points)).collect());
    let part = |it: &NestPart| {
        let Turns { angles, tolerance, may_turn_over } = &it.turns;
        format!(
            r#"{{"loops":{},"count":{},"angles":{angles:?},"tolerance":{tolerance},"over":{may_turn_over}}}"#,
            loops(&it.loops),
            it.count
        )
    };
    let sheet = |n: usize| {
        let [w, h] = nest.sheets[n].size;
        let corners = [[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]].map(|[x, y]| Point2::new(x, y));
        let (outline, is_upright) = match &sheets[nest.sheets[n].kind].form {
            NestForm::Outline(points) => (line(points), false),
            NestForm::Rectangle(_) => (line(&corners), h > w),
            NestForm::Roll(_) => (line(&corners), false),
        };
        format!(r#"{{"outline":{outline},"upright":{is_upright}}}"#)
    };
    let placed = |it: &sheetwright::nest::Placement| {
        let lines = parts[it.part]
            .loops
            .iter()
            .map(|points| line(&points.iter().map(|&p| it.lay(p)).collect::<Vec<_>>()));
        format!(
            r#"{{"part":{},"sheet":{},"turn":{},"over":{},"loops":{}}}"#,
            it.part,
            it.sheet,
            it.turn,
            it.is_over,
            list(lines.collect())
        )
    };
    format!(
        r#"{{"gap":{},"margin":{},"parts":{},"sheets":{},"placed":{},"refused":{:?}}}"#,
        options.gap_mm,
        options.margin_mm,
        list(parts.iter().map(part).collect()),
        list((0..nest.sheets.len()).map(sheet).collect()),
        list(nest.placements.iter().map(placed).collect()),
        [&nest.too_large[..], &nest.left_over[..]].concat()
    )
}

#[test]
fn random_sets_lie_on_their_sheets() {
    let sets = 2_000;
    let (mut placed, mut refused) = (0, 0);
    let mut lines = String::new();
    for seed in 0..sets {
        let mut random = Random::new(seed);
        let mut parts: Vec<NestPart> = Vec::new();
        for _ in 0..random.below(6) {
            let twin = (random.below(4) == 0).then(|| parts.last().cloned()).flatten();
            let group = (random.below(5) == 0).then_some(1);
            parts.push(twin.unwrap_or_else(|| NestPart {
                loops: random_loops(&mut random),
                count: 1 + random.below(2),
                turns: random_turns(&mut random),
                group,
            }));
        }
        let sheets = random_sheets(&mut random);
        let [gap_mm, margin_mm] = [random.between(0.0, 10.0), random.between(0.0, 20.0)];
        let gap_mm = if random.below(3) == 0 { 0.0 } else { gap_mm };
        let options = NestOptions { has_common_lines: false, gap_mm, margin_mm, effort: 0.001 };
        let found = laid(&parts, &sheets, options);
        lines += &as_json(&parts, &sheets, options, &found);
        lines.push('\n');
        placed += found.placements.len();
        refused += found.too_large.len() + found.left_over.len();
        if seed % 20 == 0 {
            assert_eq!(found, nest(&parts, &sheets, options, &mut Unwatched), "set {seed}");
        }
    }
    // `.ci/nest.py` reads them.
    if let Some(file) = std::env::var_os("SHEETWRIGHT_NESTED") {
        std::fs::write(file, lines).unwrap();
    }
    assert!(placed > 3 * sets as usize && refused > 0, "{placed} laid, {refused} refused");
}

#[test]
fn what_is_too_large_or_too_much_is_said() {
    let parts = [part(vec![rectangle(3000.0, 100.0)], 1), part(vec![rectangle(1000.0, 2000.0)], 3)];
    let options =
        NestOptions { has_common_lines: false, gap_mm: 3.0, margin_mm: 5.0, effort: 0.01 };
    let two = [NestSheet { count: Some(2), ..SHEET }];
    let found = laid(&parts, &two, options);
    assert_eq!((found.too_large, found.left_over), (vec![0], vec![1]));
    assert_eq!((found.placements.len(), found.sheets.len()), (2, 2));
    assert_eq!(laid(&[], &[SHEET], options), Nest::default());
    let none = laid(&parts, &[], options);
    assert_eq!(none.too_large, [0, 1]);
}

#[test]
fn a_part_of_the_size_of_the_sheet_has_room() {
    let options =
        NestOptions { has_common_lines: false, gap_mm: 4.0, margin_mm: 10.0, effort: 0.01 };
    let found = laid(&[part(vec![rectangle(2420.0, 1200.0)], 2)], &[SHEET], options);
    assert_eq!((found.placements.len(), found.sheets.len()), (2, 2));
    let round = ring(200, |_| 600.0, [7.0, 9.0]);
    assert_eq!(laid(&[part(vec![round], 1)], &[SHEET], options).placements.len(), 1);
}

/// Tips of the grown form reach beyond the sheet; what must be within it does not.
#[test]
fn a_part_whose_tips_touch_the_edges_has_room() {
    for corners in [4, 5, 9, 14, 23, 46] {
        // A star's points are the hull that touches the edges.
        for inner in [80.0, 48.0] {
            let star = ring(2 * corners, |n| if n % 2 == 0 { 80.0 } else { inner }, [7.0, 3.0]);
            let sides = |along: fn(&Point2) -> f64| {
                let all = || star.iter().map(along);
                all().fold(f64::MIN, f64::max) - all().fold(f64::MAX, f64::min)
            };
            let room = [sides(|p| p.x), sides(|p| p.y)];
            let options =
                NestOptions { has_common_lines: false, gap_mm: 4.0, margin_mm: 6.0, effort: 0.01 };
            let form = NestForm::Rectangle(room.map(|side| side + 12.0));
            let sheets = [NestSheet { form, count: None, cost: None }];
            let turns = Turns { angles: vec![0.0, FRAC_PI_2], ..Turns::FREE };
            let part = NestPart { turns, ..part(vec![star], 1) };
            let nest = laid(&[part], &sheets, options);
            assert!(nest.too_large.is_empty(), "{corners} {inner}");
        }
    }
}

#[test]
fn small_parts_lie_in_the_holes_of_large_ones() {
    let frame = vec![rectangle(1000.0, 1000.0), {
        let inner = rectangle(900.0, 900.0);
        inner.into_iter().map(|p| Point2::new(p.x + 50.0, p.y + 50.0)).collect()
    }];
    let parts = [part(frame, 1), part(vec![rectangle(400.0, 400.0)], 3)];
    let sheet =
        NestSheet { form: NestForm::Rectangle([1030.0, 1030.0]), count: Some(1), cost: None };
    let options = NestOptions { has_common_lines: false, gap_mm: 5.0, margin_mm: 5.0, effort: 0.3 };
    let found = laid(&parts, &[sheet], options);
    assert_eq!((found.placements.len(), found.left_over.len()), (4, 0));
}

#[test]
fn parts_of_a_group_share_a_sheet_and_the_cheap_sheet_is_taken() {
    let group = |loops, count| NestPart { group: Some(7), ..part(loops, count) };
    let parts = [
        group(vec![rectangle(1100.0, 500.0)], 2),
        part(vec![rectangle(1100.0, 1100.0)], 3),
        group(vec![rectangle(300.0, 300.0)], 2),
    ];
    let options =
        NestOptions { has_common_lines: false, gap_mm: 3.0, margin_mm: 5.0, effort: 0.05 };
    let found = laid(&parts, &[SHEET], options);
    let of_group: Vec<usize> =
        found.placements.iter().filter(|it| it.part != 1).map(|it| it.sheet).collect();
    assert!(of_group.iter().all(|&sheet| sheet == of_group[0]), "{of_group:?}");
    let small =
        NestSheet { form: NestForm::Rectangle([600.0, 600.0]), count: None, cost: Some(3.0) };
    let large = NestSheet { cost: Some(10.0), ..SHEET };
    let found = laid(&[part(vec![rectangle(500.0, 500.0)], 1)], &[large, small], options);
    assert_eq!(found.sheets[0].kind, 1, "a small sheet costs less");
}

#[test]
fn a_stop_keeps_a_whole_layout() {
    struct Stopped(usize);
    impl Watch for Stopped {
        fn progress(&mut self, _: f64) {
            self.0 += 1;
        }
        fn stop(&self) -> bool {
            self.0 > 3
        }
    }
    let mut random = Random::new(5);
    let parts: Vec<NestPart> = (0..12).map(|_| part(random_loops(&mut random), 2)).collect();
    let options = NestOptions { has_common_lines: false, gap_mm: 3.0, margin_mm: 5.0, effort: 1.0 };
    let found = nest(&parts, &[SHEET], options, &mut Stopped(0));
    assert_eq!(first_fault(&found, &parts, &[SHEET], options), None);
}

#[test]
fn faults_are_found() {
    let parts = [part(vec![rectangle(500.0, 500.0)], 2)];
    let options =
        NestOptions { has_common_lines: false, gap_mm: 3.0, margin_mm: 5.0, effort: 0.01 };
    let found = laid(&parts, &[SHEET], options);
    let fault = |change: fn(&mut Nest)| {
        let mut changed = found.clone();
        change(&mut changed);
        first_fault(&changed, &parts, &[SHEET], options)
    };
    let onto = |it: &mut Nest| {
        it.placements[1] = sheetwright::nest::Placement { copy: 1, ..it.placements[0] }
    };
    assert_eq!(fault(onto), Some(NestFault::TooNear(0, 1)));
    assert_eq!(fault(|it| it.placements[0].shift.x -= 1e4), Some(NestFault::OffSheet(0)));
    assert_eq!(fault(|it| _ = it.placements.pop()), Some(NestFault::Miscounted(0)));
    let grain = Turns { angles: vec![0.0], ..Turns::FREE };
    let along = [NestPart { turns: grain, ..part(vec![rectangle(500.0, 400.0)], 1) }];
    let mut turned = laid(&along, &[SHEET], options);
    assert!((turned.placements[0].turn - FRAC_PI_2).abs() < 1e-9, "along the longer side");
    turned.placements[0].turn = 0.0;
    turned.placements[0].shift = Vec2::splat(20.0);
    assert_eq!(first_fault(&turned, &along, &[SHEET], options), Some(NestFault::Turned(0)));
    assert!(fault(|it| it.placements[0].is_over = true).is_some());
}
