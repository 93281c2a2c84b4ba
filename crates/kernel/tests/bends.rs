//! Bend lines of surfaces whose bends are known.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright::bend::{BendLine, Brake, BrakeFault, Reference, hits};
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{
    Allowance, BendMarks, BendRule, Bends, Corner, Design, DesignCurve, Dimensions, PanelMethod,
    Trim, TrimKind, TrimOn,
};
use sheetwright::make::{Part, make};
use sheetwright::math::{
    Point2, Point3, Vec3, angle_between, cos, from_deg, sin, to_deg, unit, unit2,
};
use sheetwright::pattern::{LabelKind, PathKind, Role};
use sheetwright::template::{Value, template};
use sheetwright::watch::Unwatched;
use std::f64::consts::PI;

/// A curve whose samples are points of it, evenly spread over the parameter 0 ..= 1.
fn through(name: &str, count: usize, at: impl Fn(f64) -> Point3) -> DesignCurve {
    let points = (0..count).map(|n| CurvePoint::smooth(at(n as f64 / (count - 1) as f64)));
    DesignCurve {
        name: name.to_owned(),
        kind: Some(CurveKind::Spline),
        closed: false,
        points: points.collect(),
    }
}

/// The part between two curves with so many samples each.
fn between(curves: [DesignCurve; 2], samples: usize, rule: BendRule) -> Part {
    let mut design = Design::between("strip", curves);
    design.panels[0].samples = samples;
    design.panels[0].method = PanelMethod::Rails;
    design.bends = Bends { rule, marks: BendMarks::Ticks };
    make(&design, &mut Unwatched).unwrap().parts.remove(0)
}

/// An arc of a circle, bulging towards −x or away from it.
fn arc(radius: f64, y: f64, turn: f64) -> impl Fn(f64) -> Point3 {
    move |t| Point3::new(radius * cos(turn * (t - 0.5)), y, radius * sin(turn * (t - 0.5)))
}

/// Half a tube of radius 200 mm and length 600 mm.
fn half_tube(samples: usize, rule: BendRule) -> Part {
    let rails = [("a", 0.0), ("b", 600.0)];
    between(rails.map(|(name, y)| through(name, 401, arc(200.0, y, PI))), samples, rule)
}

fn way(line: &BendLine) -> Point2 {
    let way = unit2(line.ends[1] - line.ends[0]).unwrap();
    Point2::new(way.x, way.y)
}

#[test]
fn a_tube_is_bent_along_parallel_lines_at_equal_distances_by_equal_angles() {
    const HITS: usize = 20;
    let part = half_tube(201, BendRule::Number(HITS));
    let lines = &part.piece.bends;
    assert_eq!(lines.len(), HITS);
    let pitch = lines[0].side_mm(lines[1].ends[0]);
    println!("pitch {pitch} mm, {}°", to_deg(lines[0].angle));
    for pair in lines.windows(2) {
        for end in pair[1].ends {
            assert!((pair[0].side_mm(end) - pitch).abs() < 1e-6, "{}", pair[0].side_mm(end));
        }
    }
    for line in lines {
        assert!((line.angle - lines[0].angle).abs() < 1e-6);
        assert!((to_deg(line.angle.abs()) - 9.0).abs() < 1e-3, "{}", to_deg(line.angle));
        assert!(line.pitch_mm.iter().all(|mm| (mm - pitch).abs() < 1e-6));
        assert!(line.radius_mm().iter().all(|mm| (mm - 200.0).abs() < 0.02), "{line:?}");
        assert!((line.length_mm() - 600.0).abs() < 1e-6);
    }
    // The flanges at both ends are half a step wide.
    let [first, last] = [lines[0].beyond_mm[0], lines[HITS - 1].beyond_mm[1]].map(Option::unwrap);
    assert!((first - 0.5 * pitch).abs() < 1e-6 && (last - 0.5 * pitch).abs() < 1e-6);
}

#[test]
fn rungs_aslant_do_not_turn_the_lines() {
    // One rail has its samples between those of the other, so no rung lies along a ruling.
    for (of_a, of_b) in [(201, 200), (201, 163)] {
        let rails = [("a", 0.0, of_a), ("b", 600.0, of_b)];
        let curves = rails.map(|(name, y, count)| DesignCurve {
            kind: None,
            ..through(name, count, arc(200.0, y, PI))
        });
        let mut points: Vec<CurvePoint> = curves[0].points.clone();
        points.extend(curves[1].points.iter().rev().copied());
        for end in [0, of_a - 1, of_a, of_a + of_b - 1] {
            points[end].corner = true;
        }
        let border = DesignCurve { closed: true, points, ..curves[0].clone() };
        let mut design = Design::inside("tube", border, Vec::new());
        design.bends.rule = BendRule::Number(20);
        let part = make(&design, &mut Unwatched).unwrap().parts.remove(0);
        let lines = &part.piece.bends;
        assert_eq!(lines.len(), 20);
        let first = way(&lines[0]);
        let turned = |line: &BendLine| to_deg(way(line).distance(first));
        let worst = lines.iter().map(turned).fold(0.0, f64::max);
        let angles = lines.iter().map(|line| (to_deg(line.angle.abs()) - 9.0).abs());
        let off = angles.fold(0.0, f64::max);
        println!("{of_a} and {of_b}: lines turned by {worst}°, angles off by {off}°");
        assert!(worst < 0.05 && off < 0.02, "{worst} {off}");
    }
}

#[test]
fn rules_keep_what_they_say() {
    let whole = |rule| half_tube(201, rule).piece.bends;
    let by_angle = whole(BendRule::Angle(from_deg(7.0)));
    assert_eq!(by_angle.len(), 26, "180° in steps of 7° at the most");
    let by_pitch = whole(BendRule::Pitch(30.0));
    assert_eq!(by_pitch.len(), 21, "628.3 mm in steps of 30 mm at the most");
    let by_chord = whole(BendRule::Chord(0.5));
    let sagittas: Vec<f64> =
        by_chord.iter().map(|line| 200.0 * (1.0 - cos(0.5 * line.angle))).collect();
    assert!(sagittas.iter().all(|&mm| mm < 0.5 && mm > 0.4), "{sagittas:?}");
    let auto = whole(BendRule::Auto);
    assert_eq!(auto.len(), 24, "no more than ducts are divided into");
    let rails = [("a", 0.0), ("b", 600.0)];
    let shallow = rails.map(|(name, y)| through(name, 101, arc(2000.0, y, from_deg(12.0))));
    assert_eq!(between(shallow, 101, BendRule::Auto).piece.bends.len(), 3, "12° in steps of 5°");
}

#[test]
fn an_s_is_bent_up_and_down() {
    let wave = |y: f64| move |t: f64| Point3::new(600.0 * t, y, 60.0 * sin(2.0 * PI * t));
    let rails = [("a", 0.0), ("b", 400.0)];
    let curves = rails.map(|(name, y)| through(name, 201, wave(y)));
    let part = between(curves, 201, BendRule::Number(12));
    let ups: Vec<bool> = part.piece.bends.iter().map(BendLine::is_up).collect();
    assert_eq!(ups.len(), 12);
    assert!(ups[..6].iter().all(|&up| up == ups[0]) && ups[6..].iter().all(|&up| up != ups[0]));
    let whole: f64 = part.piece.bends.iter().map(|line| line.angle.abs()).sum();
    // The slope is 2π · 60 / 600 at the ends and back in the middle, and turns there and back.
    let slope = sheetwright::math::atan2(2.0 * PI * 60.0, 600.0);
    assert!((whole - 4.0 * slope).abs() < 0.01, "{whole}");
}

/// A sheet folded by 90° along two lines: a channel.
#[test]
fn folds_are_lines_of_their_own() {
    let at = |y: f64| {
        let corners = [(0.0, 80.0), (0.0, 0.0), (300.0, 0.0), (300.0, 80.0)];
        corners.map(|(x, z)| CurvePoint::smooth(Point3::new(x, y, z))).to_vec()
    };
    let rail = |name: &str, y: f64| DesignCurve {
        name: name.to_owned(),
        kind: Some(CurveKind::Polyline),
        closed: false,
        points: at(y),
    };
    let part = between([rail("a", 0.0), rail("b", 500.0)], 47, BendRule::Auto);
    let lines = &part.piece.bends;
    assert_eq!(lines.len(), 2);
    for line in lines {
        assert!(line.is_fold && (to_deg(line.angle.abs()) - 90.0).abs() < 1e-9);
        assert!((line.length_mm() - 500.0).abs() < 1e-9);
    }
    assert!((lines[0].side_mm(lines[1].ends[0]) - 300.0).abs() < 1e-9);
    assert!((lines[0].beyond_mm[0].unwrap() - 80.0).abs() < 1e-9);
    let scored = part.piece.paths.iter().filter(|path| path.role == Role::Score);
    assert_eq!(scored.count(), 2, "each is drawn once");
}

#[test]
fn nothing_is_drawn_on_a_flat_sheet_and_rulings_only_if_asked_for() {
    let flat = |y: f64| move |t: f64| Point3::new(500.0 * t, y + 40.0 * sin(PI * t), 0.0);
    let curves = [("a", 0.0), ("b", 300.0)].map(|(name, y)| through(name, 101, flat(y)));
    let plate = between(curves, 101, BendRule::Auto).piece;
    assert_eq!(plate.bends, []);
    assert!(plate.paths.iter().all(|path| !matches!(path.kind, PathKind::Rung(_))));

    let mut design = template("reducer").unwrap().defaults().design().unwrap();
    let count = |design: &Design, is: fn(&PathKind) -> bool| {
        let made = make(design, &mut Unwatched).unwrap();
        let paths = made.parts[0].piece.paths.clone();
        paths.iter().filter(|path| is(&path.kind)).count()
    };
    let rungs = |kind: &PathKind| matches!(kind, PathKind::Rung(_));
    let lines = |kind: &PathKind| matches!(kind, PathKind::Bend { .. });
    let ticks = |kind: &PathKind| matches!(kind, PathKind::BendTick);
    for (marks, wanted) in [
        (BendMarks::Ticks, [0, 24, 48]),
        (BendMarks::Lines, [0, 24, 0]),
        (BendMarks::None, [0, 0, 0]),
    ] {
        design.bends.marks = marks;
        assert_eq!([rungs, lines, ticks].map(|is| count(&design, is)), wanted, "{marks:?}");
    }
    design.bends.marks = BendMarks::Rulings;
    assert!(count(&design, rungs) > 400);
    assert_eq!(count(&design, lines), 24);
}

#[test]
fn lines_of_a_duct_pass_through_the_corners_of_its_rectangle() {
    let mut values = template("square-to-round").unwrap().defaults();
    values.set("width", Value::Number(600.0)).unwrap();
    values.set("diameter", Value::Number(350.0)).unwrap();
    let part = make(&values.design().unwrap(), &mut Unwatched).unwrap().parts.remove(0);
    let lines = &part.piece.bends;
    assert_eq!(lines.len(), 24);
    let samples = part.found().unwrap().boundary.samples();
    let corners: Vec<Point2> = (0..samples.len())
        .filter(|&n| samples[n].is_corner())
        .map(|n| part.flat.points[n])
        .collect();
    for line in lines {
        let near =
            |end: Point2| corners.iter().map(|c| c.distance(end)).fold(f64::INFINITY, f64::min);
        let from_corner = line.ends.map(near);
        assert!(from_corner[0].min(from_corner[1]) < 1e-9, "{from_corner:?}");
    }
    let texts = part.piece.labels.iter().filter(|label| label.kind == LabelKind::Bend);
    assert_eq!(texts.count(), 24);
}

#[test]
fn gauges_are_square_to_the_line_from_the_edge_ahead() {
    let part = half_tube(201, BendRule::Number(20));
    let brake = Brake { die_mm: Some(70.0), length_mm: Some(500.0) };
    let plan = hits(&part.blank(), &brake);
    let mut running = 0.0;
    for (n, hit) in plan.iter().enumerate() {
        let Reference::Edge(edge) = hit.reference else { panic!("{n}: {:?}", hit.reference) };
        assert_eq!(part.edges[edge].name, "end");
        // 628.3 mm in 20 steps; the edge is half a step beyond the last line.
        let wanted = 31.4157 * (19.5 - n as f64);
        assert!(hit.gauges_mm.iter().all(|mm| (mm - wanted).abs() < 0.01), "{:?}", hit.gauges_mm);
        assert_eq!(hit.fingers_mm.map(f64::round), [150.0, 450.0]);
        running += hit.line.angle;
        assert!((hit.running - running).abs() < 1e-12);
        let is = |wanted: fn(&BrakeFault) -> bool| hit.faults.iter().any(wanted);
        assert!(is(|fault| matches!(fault, BrakeFault::Long { .. })));
        assert_eq!(is(|fault| matches!(fault, BrakeFault::Close { .. })), n > 0);
        let is_short = is(|fault| matches!(fault, BrakeFault::Short { .. }));
        assert_eq!(is_short, n == 0 || n == 19, "{n}");
    }
    let unknown = hits(&part.blank(), &Brake::default());
    assert!(unknown.iter().all(|hit| hit.faults.is_empty()));
}

#[test]
fn gauges_go_to_the_edge_of_a_lap_where_it_is_cut() {
    let mut design = Design::between(
        "strip",
        [("a", 0.0), ("b", 600.0)].map(|(name, y)| through(name, 401, arc(200.0, y, PI))),
    );
    design.panels[0].method = PanelMethod::Rails;
    design.bends = Bends { rule: BendRule::Number(4), marks: BendMarks::Ticks };
    let lap = Allowance { width: [15.0; 2], corner: Corner::ByLength };
    design.trims = vec![Trim::new([TrimOn::All], TrimKind::Allowance(lap))];
    let part = make(&design, &mut Unwatched).unwrap().parts.remove(0);
    for (n, hit) in hits(&part.blank(), &Brake::default()).iter().enumerate() {
        let Reference::Edge(edge) = hit.reference else { panic!("{:?}", hit.reference) };
        assert_eq!(part.edges[edge].name, "end");
        let wanted = 50.0 * PI * (3.5 - n as f64) + 15.0;
        assert!(hit.gauges_mm.iter().all(|mm| (mm - wanted).abs() < 0.05), "{:?}", hit.gauges_mm);
    }
}

#[test]
fn the_steps_of_a_bend_fold_up_to_its_surface() {
    // Flat facets between the lines, turned one after the other, end where the tube ends.
    let part = half_tube(201, BendRule::Number(20));
    let lines = &part.piece.bends;
    let pitch = lines[0].side_mm(lines[1].ends[0]);
    let (mut at, mut turned) = ([0.0, 0.0], 0.0);
    for step in 0..=lines.len() {
        let width = if step == 0 || step == lines.len() { 0.5 * pitch } else { pitch };
        at = [at[0] + width * cos(turned), at[1] + width * sin(turned)];
        turned += lines.get(step).map_or(0.0, |line| line.angle.abs());
    }
    // Facets touch the arc that is as long from line to line, which is narrower by a share of a
    // twelfth of the square of the step.
    let narrower = 400.0 * from_deg(9.0) * from_deg(9.0) / 12.0;
    let across = Point2::new(at[0], at[1]).distance(Point2::new(0.0, 0.0));
    println!("{across} mm across");
    assert!((across - 400.0 + narrower).abs() < 0.02, "{across}");
}

/// How long an edge is on the pattern of a template with these settings, mm, of 1 mm sheet of which
/// a face is drawn.
fn edge_mm(
    template_name: &str,
    settings: &[(&str, f64)],
    edge: &str,
    dimensions: Option<Dimensions>,
) -> f64 {
    let mut values = template(template_name).unwrap().defaults();
    for &(name, number) in settings {
        values.set(name, Value::Number(number)).unwrap();
    }
    let mut design = values.design().unwrap();
    (design.dimensions, design.thickness_mm) = (dimensions, Some(1.0));
    let part = make(&design, &mut Unwatched).unwrap().parts.remove(0);
    assert!(part.measures.length_error_max < 1e-9, "it lies flat as exactly as the drawn one");
    part.edges.iter().find(|found| found.name == edge).unwrap().length_flat_mm
}

#[test]
fn a_pipe_of_inside_dimensions_is_as_long_round_as_its_mean_fibre() {
    let sizes = [("bottom", 350.0), ("top", 350.0), ("offset", 0.0)];
    for (dimensions, diameter) in
        [(Dimensions::Inside, 351.0), (Dimensions::Mean, 350.0), (Dimensions::Outside, 349.0)]
    {
        let mm = edge_mm("reducer", &sizes, "top", Some(dimensions));
        println!("{dimensions:?}: {mm} mm");
        assert!((mm - PI * diameter).abs() < 0.06, "{dimensions:?}: {mm}");
    }
}

/// Of a duct whose sides lean, the mean fibre is half a millimetre farther out square to the sheet.
/// The mouth stays in its plane, so it grows by more than π times 1 mm.
#[test]
fn a_duct_of_inside_dimensions_is_as_long_round_its_mouth_as_its_cones() {
    let sizes = [("width", 600.0), ("diameter", 350.0)];
    let mouth = |dimensions| edge_mm("square-to-round", &sizes, "round", dimensions);
    let [drawn, inside] = [mouth(None), mouth(Some(Dimensions::Inside))];
    const STEPS: usize = 20_000;
    let corner = Point3::new(300.0, 200.0, 0.0);
    let middle = |n: usize| {
        let normal = normal_of_corner(corner, 175.0, 350.0, 0.5 * PI * n as f64 / STEPS as f64);
        let angle = 0.5 * PI * n as f64 / STEPS as f64;
        let within = Vec3::new(normal.x, normal.y, 0.0);
        let out = within * (0.5 / within.dot(within));
        Point3::new(175.0 * cos(angle), 175.0 * sin(angle), 350.0) + out
    };
    let quarter: f64 = (0..STEPS).map(|n| middle(n).distance(middle(n + 1))).sum();
    println!("{drawn} mm as drawn, {inside} mm inside, {} mm of cones", 4.0 * quarter);
    assert!((inside - 4.0 * quarter).abs() < 0.06, "{inside} {}", 4.0 * quarter);
    let outside = mouth(Some(Dimensions::Outside));
    assert!((drawn - outside - (inside - drawn)).abs() < 0.01, "{outside}");
    assert!((mouth(Some(Dimensions::Mean)) - drawn).abs() < 1e-9, "K is 0.5");
}

#[test]
fn the_neutral_surface_of_a_tube_is_a_tube() {
    let rails = [("a", 0.0), ("b", 600.0)];
    let curves = rails.map(|(name, y)| through(name, 401, arc(200.0, y, PI)));
    let mut design = Design::between("strip", curves);
    design.panels[0].method = PanelMethod::Rails;
    for (dimensions, radius) in
        [(Dimensions::Inside, 202.0), (Dimensions::Mean, 200.0), (Dimensions::Outside, 198.0)]
    {
        (design.dimensions, design.thickness_mm) = (Some(dimensions), Some(4.0));
        let part = make(&design, &mut Unwatched).unwrap().parts.remove(0);
        // The first and the last side grow on one end only.
        let missing = 4.0 * PI / 199.0;
        let [width, length] = [part.piece.size.x, part.piece.size.y];
        println!("{dimensions:?}: {width} mm, {} mm expected", PI * radius);
        assert!((width - PI * radius).abs() < missing, "{dimensions:?}: {width}");
        assert!((length - 600.0).abs() < 1e-6, "{length}");
    }
}

/// The unit normal outwards of the cone between a corner of a rectangle and a circle above it, at
/// an angle on the circle; by the smooth cone alone.
fn normal_of_corner(corner: Point3, radius: f64, height: f64, angle: f64) -> Vec3 {
    let along = Vec3::new(-sin(angle), cos(angle), 0.0);
    let at = Point3::new(radius * cos(angle), radius * sin(angle), height);
    unit(along.cross(at - corner)).unwrap()
}

/// How far the tangent plane of that cone has turned at so many angles from 0 to 90°, radians.
fn turns_of_corner(corner: Point3, radius: f64, height: f64, steps: usize) -> Vec<f64> {
    let normal =
        |n: usize| normal_of_corner(corner, radius, height, 0.5 * PI * n as f64 / steps as f64);
    let mut turns = vec![0.0];
    for n in 0..steps {
        turns.push(turns[n] + angle_between(normal(n), normal(n + 1)));
    }
    turns
}

#[test]
fn lines_and_angles_of_a_duct_are_those_of_its_cones() {
    const STEPS: usize = 20_000;
    let mut values = template("square-to-round").unwrap().defaults();
    values.set("width", Value::Number(600.0)).unwrap();
    values.set("diameter", Value::Number(350.0)).unwrap();
    let part = make(&values.design().unwrap(), &mut Unwatched).unwrap().parts.remove(0);
    let lines = &part.piece.bends;
    let corner = Point3::new(300.0, 200.0, 0.0);
    let turns = turns_of_corner(corner, 175.0, 350.0, STEPS);
    let quarter = turns[STEPS];
    let step = 4.0 * quarter / 24.0;
    let (mut off_deg, mut off_mm) = (0.0f64, 0.0f64);
    for (n, line) in lines.iter().enumerate() {
        off_deg = off_deg.max(to_deg(line.angle.abs() - step).abs());
        // Quarters 1 and 3 are mirror images of 0 and 2.
        let (of_quarter, hit) = (n / 6, n % 6);
        let mirrored = of_quarter % 2 == 1;
        let turn = (hit as f64 + 0.5) * step;
        let turn = if mirrored { quarter - turn } else { turn };
        let after = turns.partition_point(|&t| t < turn);
        let share = (turn - turns[after - 1]) / (turns[after] - turns[after - 1]);
        let angle = 0.5 * PI * ((after - 1) as f64 + share) / STEPS as f64;
        let angle = if mirrored { 0.5 * PI - angle } else { angle };
        let wanted_mm = 175.0 * (0.5 * PI * of_quarter as f64 + angle);
        let off = line.along_mm.map(|mm| (mm - wanted_mm).abs());
        off_mm = off_mm.max(off[0].min(off[1]));
    }
    println!("off by {off_deg}° and {off_mm} mm");
    assert!(off_deg < 0.05 && off_mm < 0.05, "{off_deg}° {off_mm} mm");
}
