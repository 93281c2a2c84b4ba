//! Texts on patterns: none covers another, each lies inside its piece or has a leader, and none is
//! crossed by a line that is cut, scored or drawn.

#![allow(clippy::unwrap_used, reason = "a test that can't go on fails")]

use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{Axis, BendRule, Design, DesignCurve, DesignPanel, Mark, MarkKind};
use sheetwright::design::{MarkOn, PanelMesh, PanelShape, StationPlaces, Triangles};
use sheetwright::design::{Trim, TrimKind, TrimOn};
use sheetwright::make::{Judging, Part, make_judged};
use sheetwright::math::{Point2, Point3, Vec2, cos, sin, to_deg};
use sheetwright::pattern::{LabelKind, PathKind, PatternLabel, Role};
use sheetwright::template::catalogue;
use sheetwright::watch::Unwatched;
use sheetwright_shapes::low_poly::animal;
use sheetwright_shapes::random::Random;
use sheetwright_shapes::solids::Solid;
use std::f64::consts::TAU;

/// The corners of the box around a text: letters are two thirds of their height wide and a third
/// apart, with tails of a third below the line and dots of a sixth above.
fn corners(label: &PatternLabel) -> [Point2; 4] {
    let wide = (label.text.chars().count() as f64 - 1.0 / 3.0).max(0.0) * label.height_mm;
    let at = |x: f64, y: f64| label.at + label.along * x + label.along.perp() * y;
    let (low, high) = (-label.height_mm / 3.0, label.height_mm * 7.0 / 6.0);
    [at(-0.5 * wide, low), at(0.5 * wide, low), at(0.5 * wide, high), at(-0.5 * wide, high)]
}

/// Whether a rectangle and another one or a segment overlap by more than rounding: no direction of
/// their sides parts them.
fn overlap(a: &[Point2], b: &[Point2]) -> bool {
    let ways = [a, b].into_iter().flat_map(|of| [of[1] - of[0], (of[1] - of[0]).perp()]);
    let reach = |of: &[Point2], way: Vec2| {
        let along = of.iter().map(|p| p.to_vec().dot(way));
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
    };
    ways.filter(|way| *way != Vec2::ZERO).all(|way| {
        let ((low_a, high_a), (low_b, high_b)) = (reach(a, way), reach(b, way));
        let rounding = 1e-9 * way.length();
        low_a < high_b - rounding && low_b < high_a - rounding
    })
}

fn winding(loops: &[&[Point2]], at: Point2) -> bool {
    let mut odd = false;
    for line in loops {
        for (n, &a) in line.iter().enumerate() {
            let b = line[(n + 1) % line.len()];
            let meets = (a.y > at.y) != (b.y > at.y)
                && at.x < a.x + (b.x - a.x) * (at.y - a.y) / (b.y - a.y);
            odd ^= meets;
        }
    }
    odd
}

/// Texts that stand where a seam or a trim has them: only what is placed is looked at.
fn is_placed(label: &PatternLabel) -> bool {
    !matches!(
        label.kind,
        LabelKind::Mark | LabelKind::Length | LabelKind::Overall | LabelKind::Trim
    )
}

/// Checks a part; how many of its texts have leaders.
fn check(part: &Part) -> usize {
    let name = &part.name;
    let loops: Vec<&[Point2]> = part.piece.net_loops().collect();
    let boxes: Vec<[Point2; 4]> = part.piece.labels.iter().map(corners).collect();
    let leaders: Vec<&[Point2]> = part
        .piece
        .paths
        .iter()
        .filter(|path| path.kind == PathKind::Leader)
        .map(|path| &path.points[..])
        .collect();
    for (n, label) in part.piece.labels.iter().enumerate().filter(|(_, label)| is_placed(label)) {
        for (m, other) in part.piece.labels.iter().enumerate().filter(|&(m, _)| m != n) {
            let apart = !overlap(&boxes[n], &boxes[m]);
            assert!(apart, "{name}: '{}' covers '{}'", label.text, other.text);
        }
        let middle = boxes[n][0].lerp(boxes[n][2], 0.5);
        let has_leader = leaders.iter().any(|leader| {
            let off = |p: Point2| {
                let side = |k: usize| p.distance_to_segment([boxes[n][k], boxes[n][(k + 1) % 4]]);
                (0..4).map(side).fold(f64::INFINITY, f64::min)
            };
            off(leader[1]) < 1e-6
        });
        assert!(
            winding(&loops, middle) || has_leader,
            "{name}: '{}' lies outside, without a leader",
            label.text
        );
        for path in &part.piece.paths {
            let is_hard = path.role != Role::Note || path.kind == PathKind::Leader;
            if !is_hard {
                continue;
            }
            let last = path.closed.then(|| [path.points[path.points.len() - 1], path.points[0]]);
            let steps = path.points.windows(2).map(|w| [w[0], w[1]]).chain(last);
            for step in steps {
                assert!(
                    !overlap(&boxes[n], &step),
                    "{name}: {:?} crosses '{}'",
                    path.kind,
                    label.text
                );
            }
        }
    }
    leaders.len()
}

fn parts(design: &Design) -> Vec<Part> {
    make_judged(design, Judging::Quick, &mut Unwatched).unwrap().parts
}

#[test]
fn texts_of_every_template_keep_clear() {
    for template in catalogue() {
        let mut design = template.defaults().design().unwrap();
        parts(&design).iter().for_each(|part| {
            check(part);
        });
        // And with much more on the parts.
        let at = StationPlaces::Every { pitch: 0.1 * design.extent_mm(), from: 0.0 };
        let kind = MarkKind::Stations { axis: Axis::X, at };
        design.marks.push(Mark { on: vec![MarkOn::All], kind });
        design.bends.rule = BendRule::Number(40);
        parts(&design).iter().for_each(|part| {
            check(part);
        });
    }
}

/// A flat star of random radii, bent round a cylinder, of about this size.
fn random_part(random: &mut Random, size_mm: f64) -> Design {
    let count = 3 + random.below(12);
    let corner = |n: usize| {
        let angle = TAU * (n as f64 + random.between(-0.3, 0.3)) / count as f64;
        let r = size_mm * random.between(0.15, 0.5);
        let (x, y) = (r * cos(angle), r * sin(angle));
        let radius = 0.8 * size_mm;
        CurvePoint {
            at: Point3::new(radius * sin(x / radius), y, radius * cos(x / radius)),
            corner: true,
            move_mm: 0.0,
        }
    };
    let points: Vec<CurvePoint> = (0..count).map(corner).collect();
    let curve = |n: usize| DesignCurve {
        name: format!("edge-{n}"),
        kind: Some(CurveKind::Polyline),
        closed: false,
        points: vec![points[n], points[(n + 1) % count]],
    };
    let outline = DesignCurve {
        name: "outline".to_owned(),
        kind: Some(CurveKind::Polyline),
        closed: true,
        points: points.clone(),
    };
    let mut design = Design::inside("a part", outline, Vec::new());
    design.panels[0].samples = 60;
    design.curves = (0..count).map(curve).collect();
    let along =
        |n: usize| sheetwright::design::CurveUse { name: format!("edge-{n}"), reversed: false };
    design.panels[0].shape =
        PanelShape::Loops { outer: (0..count).map(along).collect(), holes: Vec::new() };
    design
}

#[test]
fn texts_of_random_parts_keep_clear_or_have_leaders() {
    let mut random = Random::new(40);
    let (mut count, mut leaders, mut lost) = (0, 0, 0);
    for round in 0..150u32 {
        let size_mm = [8.0, 20.0, 60.0, 200.0, 1000.0][round as usize % 5];
        let mut design = random_part(&mut random, size_mm);
        let at = StationPlaces::Every { pitch: 0.2 * size_mm, from: 0.0 };
        let marks = [
            MarkKind::Stations { axis: Axis::Y, at },
            MarkKind::Text { at: None, text: "upside".to_owned(), height: None },
        ];
        design.marks = marks.map(|kind| Mark { on: vec![MarkOn::All], kind }).to_vec();
        if round % 3 == 0 {
            let ticks = sheetwright::design::Ticks {
                at: sheetwright::design::Places::Shares(vec![0.5]),
                length: 0.02 * size_mm,
                numbered: false,
            };
            design.trims = vec![Trim::new([TrimOn::All], TrimKind::Ticks(ticks))];
        }
        // Some are no boundaries.
        let Ok(made) = make_judged(&design, Judging::Quick, &mut Unwatched) else { continue };
        let part = &made.parts[0];
        if part.flat.overlap.is_some() {
            continue;
        }
        count += 1;
        leaders += check(part);
        assert!(part.piece.labels.iter().any(|label| label.kind == LabelKind::Name));
        let says = |text: &str| part.piece.labels.iter().any(|label| label.text == text);
        lost += usize::from(!says("upside"));
        // Shorter edges are no longer than the letters are high.
        let long = part.edges.iter().filter(|edge| edge.length_flat_mm > 4.0);
        lost += long.filter(|edge| !says(&edge.name)).count();
    }
    assert!(count > 100 && leaders > 100, "{count} parts, {leaders} leaders");
    assert_eq!(lost, 0);
}

#[test]
fn letters_have_standard_heights() {
    let standard = [20.0, 14.0, 10.0, 7.0, 5.0, 3.5, 2.5, 1.8];
    for template in catalogue() {
        for part in parts(&template.defaults().design().unwrap()) {
            for label in part.piece.labels.iter().filter(|label| is_placed(label)) {
                assert!(standard.contains(&label.height_mm), "{label:?}");
                assert!((label.along.length() - 1.0).abs() < 1e-9 && label.along != Vec2::ZERO);
            }
        }
    }
}

#[test]
fn numbers_of_ticks_move_along_their_edge_where_something_is_in_their_way() {
    let rail = |name: &str, y: f64| DesignCurve {
        name: name.to_owned(),
        kind: Some(CurveKind::Polyline),
        closed: false,
        points: [0.0, 100.0].map(|x| CurvePoint::corner(Point3::new(x, y, 0.0))).to_vec(),
    };
    let mut design = Design::between("strap", [rail("front", 0.0), rail("back", 40.0)]);
    let ticks = sheetwright::design::Ticks {
        at: sheetwright::design::Places::Every(12.0),
        length: 4.0,
        numbered: true,
    };
    design.trims = vec![Trim::new([TrimOn::All], TrimKind::Ticks(ticks))];
    let part = parts(&design).remove(0);
    check(&part);
    let piece = &part.piece;
    let ticks = piece.paths.iter().filter(|path| path.kind == PathKind::TrimTick);
    let ticks: Vec<[Point2; 2]> = ticks.map(|tick| [tick.points[0], tick.points[1]]).collect();
    let numbers = piece.labels.iter().filter(|label| label.kind == LabelKind::Trim);
    // Numbers have no tails.
    let boxes: Vec<(&PatternLabel, [Point2; 4])> = numbers
        .map(|label| {
            let [_, _, high, top] = corners(label);
            let down = label.along.perp() * (-7.0 / 6.0 * label.height_mm);
            (label, [top + down, high + down, high, top])
        })
        .collect();
    // 9 on each long side and 3 on each short one.
    assert_eq!((ticks.len(), boxes.len()), (24, 24));
    let mut moved = 0;
    for (n, (label, around)) in boxes.iter().enumerate() {
        let text = &label.text;
        let outline = piece.outline();
        let sides = outline.iter().zip(outline.iter().cycle().skip(1)).map(|(&a, &b)| [a, b]);
        assert!(sides.into_iter().all(|side| !overlap(around, &side)), "{text} is cut");
        assert!(ticks.iter().all(|tick| !overlap(around, tick)), "{text} is crossed");
        let others = boxes.iter().enumerate().filter(|(m, _)| *m != n);
        assert!(others.into_iter().all(|(_, (_, other))| !overlap(around, other)), "{text}");
        // The nearest tick is its own: numbers follow one another in their order.
        let middle = around[0].lerp(around[2], 0.5);
        let off = |tick: &[Point2; 2]| tick[0].distance(middle);
        let nearest = (0..ticks.len()).min_by(|&a, &b| off(&ticks[a]).total_cmp(&off(&ticks[b])));
        assert_eq!(nearest.map(|n| (n + 1).to_string()).as_ref(), Some(text));
        let ahead = (label.at - ticks[n][0]).dot(label.along);
        moved += usize::from(ahead < 0.0);
    }
    assert!(moved > 0, "near a corner, some stand before their ticks");
}

/// The pieces of the net of a model, this many times as large, on A4.
fn net(solid: &Solid, scale: f64) -> Vec<Part> {
    let mesh = solid.mesh();
    let large = |p: &Point3| Point3::new(scale * p.x, scale * p.y, scale * p.z);
    let positions = mesh.positions().iter().map(large).collect();
    let triangles = mesh.triangles().to_vec();
    let given = PanelMesh::new(Triangles { positions, triangles, left_out: 0 });
    let within = Some([270.0, 180.0]);
    let mesh = PanelMesh { facets: Some(true), pieces_within_mm: within, ..given };
    let panels = vec![DesignPanel::new("net", PanelShape::Mesh(mesh), 0)];
    let design = Design { panels, ..Design::default() };
    make_judged(&design, Judging::Quick, &mut Unwatched).unwrap().parts
}

/// The lines of a part that are cut or folded.
fn cut_or_folded(part: &Part) -> Vec<[Point2; 2]> {
    let paths = part.piece.paths.iter();
    let paths = paths.filter(|path| path.role.is_cut() || path.role == Role::Score);
    let steps = paths.flat_map(|path| {
        let last = path.closed.then(|| [path.points[path.points.len() - 1], path.points[0]]);
        path.points.windows(2).map(|w| [w[0], w[1]]).chain(last)
    });
    steps.collect()
}

#[test]
fn angles_of_a_net_stand_along_their_folds() {
    for scale in [1.0, 0.5] {
        for part in net(&animal(), scale) {
            let lines = cut_or_folded(&part);
            let angles = part.piece.labels.iter().filter(|label| label.kind == LabelKind::Angle);
            let angles: Vec<&PatternLabel> = angles.collect();
            let (left_out, of) = part.piece.folds_without_angle();
            assert_eq!(angles.len() + left_out, of);
            for label in angles {
                let [a, b, c, d] = corners(label);
                let middle = a.lerp(c, 0.5);
                let is_told = |ends: [Point2; 2]| {
                    let [from, to] = ends;
                    let way = (to - from) / from.distance(to);
                    let off = |p: Point2| way.perp_dot(p - from).abs();
                    let nearest = off(a).max(off(b)).min(off(c).max(off(d)));
                    let foot = from + way * (middle - from).dot(way);
                    let is_beside = foot.distance_to_segment(ends) < 1e-9;
                    let short = foot.lerp(middle, 1e-6);
                    let is_parted = lines.iter().any(|line| overlap(&[short, middle], line));
                    nearest < 0.3 * label.height_mm && is_beside && !is_parted
                };
                let folds = part.piece.bends.iter();
                let mut told = folds.filter(|fold| is_told(fold.ends));
                let text = |angle: f64| format!("{:.0}°", to_deg(angle.abs()));
                let is_right = told.any(|fold| text(fold.angle) == label.text);
                assert!(is_right, "{}: '{}' at {middle:?}", part.name, label.text);
            }
        }
    }
}

#[test]
fn marks_of_a_net_can_be_read() {
    // Where two cuts meet at a needle's point, some marks find no room within reach.
    for (scale, most) in [(1.0, 0.05), (0.5, 0.2)] {
        let (mut crossed, mut count) = (0, 0);
        for part in net(&animal(), scale) {
            let lines = cut_or_folded(&part);
            let marks = part.piece.labels.iter().filter(|label| label.kind == LabelKind::Mark);
            let boxes: Vec<[Point2; 4]> = marks
                .map(|label| {
                    let [a, b, c, d] = corners(label);
                    // Digits and capitals stand on the base line.
                    let tail = label.along.perp() * (label.height_mm / 3.0);
                    [a + tail, b + tail, c, d]
                })
                .collect();
            let is_crossed = |n: &usize| {
                let of_others = (0..boxes.len()).filter(|m| m != n);
                lines.iter().any(|line| overlap(&boxes[*n], line))
                    || of_others.into_iter().any(|m| overlap(&boxes[*n], &boxes[m]))
            };
            crossed += (0..boxes.len()).filter(is_crossed).count();
            count += boxes.len();
        }
        assert!((crossed as f64) < most * count as f64, "{scale}: {crossed} of {count}");
    }
}
