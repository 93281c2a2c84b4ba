//! Parts that are larger than the sheet, divided: the pieces against the whole.
#![allow(clippy::unwrap_used, clippy::panic)] // Whatever fails here is a failed test.

use sheetwright::check::FindingKind;
use sheetwright::cost::DEFAULT_FOLD;
use sheetwright::design::{
    Divide, DivideJoint, Mark, MarkKind, MarkOn, MarkWay, SheetForm, Stock, StockSheet,
};
use sheetwright::edge::EdgeSource;
use sheetwright::flatten::refold;
use sheetwright::index::VertexIndex;
use sheetwright::make::{Live, Made, Part, make};
use sheetwright::math::{Point2, Point3, cos, sin};
use sheetwright::pattern::PathKind;
use sheetwright::template::{Value, template};
use sheetwright::watch::Unwatched;
use sheetwright::{Design, DesignCurve, Triangles};
use sheetwright_shapes::hull::planks;
use std::f64::consts::FRAC_PI_2;

fn stock(size: [f64; 2], joint: DivideJoint) -> Stock {
    let divide = Some(Divide::by(joint));
    let form = SheetForm::Rectangle { size };
    let sheet = StockSheet { name: None, form, count: None, cost: None };
    Stock { sheets: vec![sheet], margin_mm: 10.0, divide, ..Stock::default() }
}

/// A plank between two rails that bend and twist.
fn plank(length: f64, width: f64, wave: f64) -> Design {
    let rail = |name: &str, y: f64, phase: f64| {
        let at = |n: usize| {
            let x = length * n as f64 / 8.0;
            [x, y + 0.02 * wave * sin(0.0003 * x + phase), wave * sin(0.0004 * x + 0.2 * phase)]
        };
        DesignCurve::spline(name, (0..=8).map(at))
    };
    let curves = [rail("lower", 0.0, 0.0), rail("upper", width, 0.4)];
    Design { thickness_mm: Some(12.0), ..Design::between("plank", curves) }
}

fn made(design: &Design) -> Made {
    make(design, &mut Unwatched).unwrap()
}

fn whole(design: &Design) -> Part {
    made(&Design { stock: None, ..design.clone() }).parts.remove(0)
}

/// The parts that are no straps.
fn pieces(made: &Made) -> Vec<&Part> {
    let is_strap = |part: &Part| {
        part.checked.findings.iter().any(|f| matches!(f.kind, FindingKind::Strap { .. }))
    };
    made.parts.iter().filter(|part| !is_strap(part)).collect()
}

/// What must hold of the pieces of every part.
fn check(whole: &Part, pieces: &[&Part], room: [f64; 2]) {
    let sum = |of: fn(&Part) -> f64| pieces.iter().map(|piece| of(piece)).sum::<f64>();
    let areas = [whole.measures.area_flat_mm2, sum(|p| p.measures.area_flat_mm2)];
    assert!((areas[0] / areas[1] - 1.0).abs() < 1e-9, "{areas:?}");
    let areas = [whole.measures.area_space_mm2, sum(|p| p.measures.area_space_mm2)];
    assert!((areas[0] / areas[1] - 1.0).abs() < 1e-9, "{areas:?}");
    for piece in pieces {
        assert_eq!(piece.checked.verdict, whole.checked.verdict);
        let size = piece.piece.size;
        let (long, short) = (size.x.max(size.y), size.x.min(size.y));
        let fits = long <= room[0].max(room[1]) + 1e-6 && short <= room[0].min(room[1]) + 1e-6;
        assert!(fits, "{}: {size:?} {:?}", piece.name, piece.checked.findings);
        if piece.found().is_some() {
            let off = refold(&piece.sheet, &piece.flat.points, &piece.sheet.rungs()).unwrap();
            assert!(off < 1e-6, "{}: {off}", piece.name);
            assert_eq!(piece.sheet.rung_ends().len(), piece.measures.rungs.len());
        }
        assert_eq!(piece.flat.overlap, None);
    }
}

/// The two sides of each joint: congruent on the pattern, in one place in space.
fn check_joints(made: &Made) -> usize {
    let mut joints = 0;
    for part in &made.parts {
        for edge in &part.edges {
            let EdgeSource::Division { second: false, .. } = edge.source else { continue };
            joints += 1;
            let [mate] = edge.mates[..] else { panic!("{}: {:?}", edge.name, edge.mates) };
            let other = &made.parts[mate.part];
            let back: Vec<usize> = other.edges[mate.edge].run.iter().rev().copied().collect();
            assert_eq!(back.len(), edge.run.len());
            let space = |part: &Part, run: &[usize]| -> Vec<Point3> {
                run.iter().map(|&v| part.sheet.mesh().positions()[v]).collect()
            };
            assert_eq!(space(part, &edge.run), space(other, &back));
            let flat = |part: &Part, run: &[usize]| -> Vec<Point2> {
                run.iter().map(|&v| part.flat.points[v]).collect()
            };
            let (a, b) = (flat(part, &edge.run), flat(other, &back));
            for n in 0..a.len() {
                for k in 0..n {
                    assert!((a[n].distance(a[k]) - b[n].distance(b[k])).abs() < 1e-9);
                }
            }
            assert!((edge.length_flat_mm - other.edges[mate.edge].length_flat_mm).abs() < 1e-9);
            assert!(edge.difference_mm.unwrap() < 1e-9);
        }
    }
    joints
}

#[test]
fn planks_are_divided_by_every_joint_and_refold() {
    for (n, joint) in DivideJoint::ALL.into_iter().enumerate() {
        let design = Design {
            stock: Some(stock([2440.0, 1220.0], joint)),
            ..plank(6500.0, 600.0, 100.0 + 150.0 * n as f64)
        };
        let made = made(&design);
        assert_eq!(check_joints(&made), 2);
        let pieces = pieces(&made);
        check(&whole(&design), &pieces, [2420.0, 1200.0]);
        let names: Vec<&str> = made.parts.iter().map(|part| &part.name[..]).collect();
        assert_eq!(names[..3], ["plank-1", "plank-2", "plank-3"]);
        let straps: &[&str] =
            if joint == DivideJoint::Butt { &["plank-strap-1", "plank-strap-2"] } else { &[] };
        assert_eq!(names[3..], *straps);
        for strap in &made.parts[3..] {
            let [wide, long] = [strap.piece.size.x, strap.piece.size.y];
            assert!((wide.min(long) - 288.0).abs() < 5.0, "{wide} x {long}");
            assert!(strap.edges.iter().all(|edge| edge.mates.is_empty()));
        }
        let mut live = Live::new(design.clone(), &mut Unwatched);
        live.settle(&mut Unwatched);
        assert_eq!(live.made().unwrap(), made);
        assert_eq!(live.trimmed().unwrap()[0].as_ref().unwrap(), &made.parts);
    }
}

fn rectangle(width: f64, height: f64, holes: Vec<DesignCurve>) -> Design {
    let corners = [[0.0, 0.0, 0.0], [width, 0.0, 0.0], [width, height, 0.0], [0.0, height, 0.0]];
    let outline = DesignCurve::polyline("rim", corners).closed();
    Design { thickness_mm: Some(6.0), ..Design::inside("floor", outline, holes) }
}

#[test]
fn rectangles_are_divided_into_as_few_pieces_as_can_be() {
    let room = [2420.0, 1200.0];
    for length in [2421.0, 3000.0, 4839.9, 4841.0, 7259.9, 11_111.0] {
        for joint in DivideJoint::ALL {
            let stock = stock([2440.0, 1220.0], joint);
            let design = Design { stock: Some(stock), ..rectangle(length, 700.0, Vec::new()) };
            let made = made(&design);
            let reach = match joint {
                DivideJoint::Butt => 0.0,
                DivideJoint::Scarf => 24.0,
                DivideJoint::Overlap => 15.0,
                DivideJoint::Puzzle => 45.9,
            };
            let mut least = 2;
            while 2.0 * (room[0] - reach) + f64::from(least - 2) * (room[0] - 2.0 * reach) < length
            {
                least += 1;
            }
            let pieces = pieces(&made);
            assert_eq!(pieces.len(), least as usize, "{length} {joint:?}");
            assert_eq!(check_joints(&made), least as usize - 1);
            check(&whole(&design), &pieces, room);
        }
    }
}

#[test]
fn a_grain_arrow_lies_along_the_sheet() {
    for (angle, size, least) in [(0.0, [3000.0, 700.0], 2), (FRAC_PI_2, [3000.0, 700.0], 3)] {
        let kind = MarkKind::Grain { way: MarkWay::Angle { angle }, length: 40.0 };
        let design = Design {
            stock: Some(stock([2440.0, 1220.0], DivideJoint::Butt)),
            marks: vec![Mark { on: vec![MarkOn::All], kind }],
            ..rectangle(size[0], size[1], Vec::new())
        };
        let mut made = made(&design);
        let pieces = pieces(&made).len();
        assert_eq!(pieces, least, "{angle}");
        made.lay_out(&mut Unwatched);
        let nested = made.nested.unwrap();
        assert!(nested.is_proved && nested.nest.too_large.is_empty(), "{angle}");
    }
}

#[test]
fn what_is_too_wide_as_well_is_divided_both_ways() {
    for joint in DivideJoint::ALL {
        let stock = Some(stock([2440.0, 1220.0], joint));
        let design = Design { stock, ..rectangle(5000.0, 3000.0, Vec::new()) };
        let made = made(&design);
        let pieces = pieces(&made);
        check(&whole(&design), &pieces, [2420.0, 1200.0]);
        // An area of 5.17 sheets.
        assert!((6..=9).contains(&pieces.len()), "{joint:?}: {}", pieces.len());
        assert!(check_joints(&made) >= pieces.len() - 1);
    }
}

#[test]
fn joints_keep_away_from_holes() {
    let ring = |x: f64, r: f64| {
        let at = |n: usize| {
            let a = std::f64::consts::TAU * n as f64 / 16.0;
            [x - r * cos(a), 350.0 + r * sin(a), 0.0]
        };
        DesignCurve::spline("hole", (0..16).map(at)).closed()
    };
    for x in [1500.0, 1750.0, 2000.0, 2250.0] {
        let stock = Some(stock([2440.0, 1220.0], DivideJoint::Scarf));
        let design = Design { stock, ..rectangle(4000.0, 700.0, vec![ring(x, 150.0)]) };
        let made = made(&design);
        assert_eq!(made.parts.len(), 2);
        let holes: Vec<usize> =
            made.parts.iter().map(|part| part.sheet.loops().len() - 1).collect();
        assert_eq!(holes.iter().sum::<usize>(), 1, "at {x}: {holes:?}");
        check_joints(&made);
        check(&whole(&design), &pieces(&made), [2420.0, 1200.0]);
    }
}

#[test]
fn meshes_are_divided_as_found_surfaces_are() {
    // A quarter of a cylinder that bulges a little, in squares.
    let (columns, rows) = (40, 8);
    let at = |n: usize| {
        let (c, r) = ((n % (columns + 1)) as f64, (n / (columns + 1)) as f64);
        let (x, a) = (120.0 * c, 0.15 * r);
        let radius = 600.0 + 3.0 * sin(0.08 * c);
        Point3::new(x, radius * cos(a), radius * sin(a))
    };
    let v = |c: usize, r: usize| VertexIndex::new(r * (columns + 1) + c);
    let squares = (0..rows).flat_map(|r| (0..columns).map(move |c| (c, r)));
    let triangles = squares.flat_map(|(c, r)| {
        [[v(c, r), v(c + 1, r), v(c + 1, r + 1)], [v(c, r), v(c + 1, r + 1), v(c, r + 1)]]
    });
    let triangles = Triangles {
        positions: (0..(columns + 1) * (rows + 1)).map(at).collect(),
        triangles: triangles.collect(),
        left_out: 0,
    };
    let stock = Some(stock([2440.0, 1220.0], DivideJoint::Puzzle));
    let design = Design { stock, ..Design::of_mesh("shell", triangles) };
    let made = made(&design);
    assert_eq!(made.parts.len(), 3);
    assert_eq!(check_joints(&made), 2);
    let whole = whole(&design);
    check(&whole, &pieces(&made), [2420.0, 1200.0]);
    // A puzzle moves the cut off the net.
    assert!(made.parts.iter().all(|part| part.piece.has_net()));
    let stretch = |part: &Part| part.measures.distortion.as_ref().unwrap().stretch_max;
    let pieces = made.parts.iter().map(stretch).fold(0.0, f64::max);
    assert!((pieces / stretch(&whole) - 1.0).abs() < 1e-9, "stretched as the whole is");
}

#[test]
fn laps_show_where_they_end_and_bends_keep_their_angles() {
    let stock = Some(stock([2440.0, 1220.0], DivideJoint::Scarf));
    let design = Design { stock, ..plank(6500.0, 600.0, 250.0) };
    let made = made(&design);
    let laps =
        |part: &Part| part.piece.paths.iter().filter(|path| path.kind == PathKind::LapEnd).count();
    assert_eq!(made.parts.iter().map(laps).collect::<Vec<_>>(), [1, 2, 1]);
    let whole = whole(&design);
    let known: Vec<f64> = whole.piece.bends.iter().map(|line| line.angle).collect();
    let found: Vec<f64> =
        made.parts.iter().flat_map(|part| part.piece.bends.iter().map(|line| line.angle)).collect();
    assert!(found.len() >= known.len() && found.iter().all(|angle| known.contains(angle)));
}

#[test]
fn what_is_not_divided_says_so() {
    let has = |made: &Made, is_it: fn(&FindingKind) -> bool| {
        made.parts[0].checked.findings.iter().any(|finding| is_it(&finding.kind))
    };
    let scarf = stock([2440.0, 1220.0], DivideJoint::Scarf);
    let plank = plank(6500.0, 600.0, 100.0);
    let whole = Stock { divide: None, ..scarf.clone() };
    let left = made(&Design { stock: Some(whole), ..plank.clone() });
    assert!(has(&left, |kind| matches!(kind, FindingKind::TooLarge { .. })));
    let unknown = Design { thickness_mm: None, stock: Some(scarf), ..plank.clone() };
    assert!(has(&made(&unknown), |kind| matches!(kind, FindingKind::NotDivided { .. })));
    let small = stock([60.0, 60.0], DivideJoint::Overlap);
    let made = made(&Design { stock: Some(small), ..plank });
    assert!(has(&made, |kind| matches!(kind, FindingKind::NotDivided { .. })));
}

/// Every panel of a design that is divided, against its pieces.
fn check_design(design: &Design, room: [f64; 2]) -> Made {
    let made = made(design);
    let wholes = self::made(&Design { stock: None, ..design.clone() });
    check_joints(&made);
    for whole in &wholes.parts {
        let of_it: Vec<&Part> =
            pieces(&made).into_iter().filter(|part| part.panel == whole.panel).collect();
        check(whole, &of_it, room);
    }
    made
}

#[test]
fn a_hull_of_22_metres_is_divided_for_plates() {
    let stock = Some(stock([6000.0, 2400.0], DivideJoint::Butt));
    let design = Design { stock, thickness_mm: Some(6.0), ..planks(60, DEFAULT_FOLD) };
    let made = check_design(&design, [5980.0, 2380.0]);
    assert!(made.parts.len() > design.panels.len());
}

#[test]
fn puzzles_do_not_part_the_pieces_of_a_hull() {
    let stock = Some(stock([6000.0, 2400.0], DivideJoint::Puzzle));
    let made = check_design(&Design { stock, ..planks(60, DEFAULT_FOLD) }, [5980.0, 2380.0]);
    assert!(made.parts.iter().filter(|part| part.piece.has_net()).count() > 9);
}

#[test]
fn a_skiff_of_4500_mm_is_divided_for_plywood() {
    let dinghy = template("dinghy").unwrap();
    let mut values = dinghy.defaults();
    values.set("length", Value::Number(4500.0)).unwrap();
    let stock = Some(stock([1220.0, 2440.0], DivideJoint::Scarf));
    let design = Design { stock, thickness_mm: Some(6.0), ..values.design().unwrap() };
    let made = check_design(&design, [2420.0, 1200.0]);
    let count = |panel: &str| made.parts.iter().filter(|part| part.panel == panel).count();
    assert_eq!([count("side"), count("bottom"), count("transom")], [2, 2, 1]);
    // What was joined before still is: pieces of the side to those of the bottom.
    let chine = made.parts.iter().flat_map(|part| &part.edges).filter(|e| e.name == "chine");
    assert!(chine.into_iter().all(|edge| !edge.mates.is_empty()));
}
