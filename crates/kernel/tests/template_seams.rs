//! The pieces of a template fit: what two panels share is one curve, and its two edges in the flat
//! have one length.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright::boundary::size_of;
use sheetwright::check::Verdict;
use sheetwright::curve::Curve;
use sheetwright::design::{Design, DesignPanel, PanelShape};
use sheetwright::make::{Made, Part, make};
use sheetwright::math::{Point3, Vec3};
use sheetwright::pattern::PathKind;
use sheetwright::template::{NamedCurve, Value, template};
use sheetwright::watch::Unwatched;

/// Edges of two panels that are to be joined differ by this share of their length at the most: a
/// fiftieth of a millimetre on a metre, from sampling one curve twice.
const FITS: f64 = 2e-5;

fn made(name: &str) -> (Design, Made) {
    let design = template(name).unwrap().defaults().design().unwrap();
    let made = make(&design, &mut Unwatched).unwrap();
    (design, made)
}

fn curves_of(panel: &DesignPanel) -> Vec<&str> {
    match &panel.shape {
        PanelShape::Rails(rails) => rails.iter().map(|rail| rail.name.as_str()).collect(),
        PanelShape::Loops { outer, .. } => outer.iter().map(|part| part.name.as_str()).collect(),
        other => panic!("no template has panels of this kind: {other:?}"),
    }
}

/// How long the edge of a flat panel is between the samples at the ends of a curve: of the two ways
/// round, the one that is nearer to the length of the curve.
fn flat_length(panel: &Part, curve: &Curve) -> f64 {
    let samples = panel.found().unwrap().boundary.samples();
    let nearest = |end: Point3| {
        let far = |i: &usize| samples[*i].position.distance(end);
        (0..samples.len()).min_by(|a, b| far(a).total_cmp(&far(b))).unwrap()
    };
    let walk = |from: usize, to: usize| {
        let (mut at, mut length) = (from, 0.0);
        while at != to {
            let next = (at + 1) % samples.len();
            length += panel.flat.points[at].distance(panel.flat.points[next]);
            at = next;
        }
        length
    };
    let (start, end) = (nearest(curve.start()), nearest(curve.end()));
    let off = |length: &f64| (length - curve.length()).abs();
    let ways = [walk(start, end), walk(end, start)];
    ways.into_iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap()
}

#[test]
fn boats_have_their_stations_on_every_plank() {
    for name in ["dinghy", "pram", "kayak"] {
        let values = template(name).unwrap().defaults();
        let design = values.design().unwrap();
        let made = make(&design, &mut Unwatched).unwrap();
        for part in &made.parts {
            let stations = part.piece.paths.iter().filter(|path| path.kind == PathKind::Station);
            let has_length = part.piece.size.x.max(part.piece.size.y) > 2000.0;
            // A transom leans across some station, or lies before all of them.
            assert!(stations.count() >= if has_length { 8 } else { 0 }, "{name}: {}", part.name);
        }
    }
}

#[test]
fn seams_have_one_length_on_both_sides() {
    for (name, shared) in [
        ("dinghy", &["chine", "transom-bottom", "transom-side"][..]),
        ("pram", &["chine", "bow-transom-bottom", "bow-transom-side", "transom-side"]),
        ("kayak", &["chine", "sheer"]),
        ("hull", &["chine"]),
        ("bag", &["front-seam", "back-seam"]),
        ("tent", &["front-hoop", "middle-hoop", "rear-hoop"]),
        ("ramp", &["right-curve", "right-deck"]),
    ] {
        let (design, made) = made(name);
        for wanted in shared {
            let drawn = design.curves.iter().find(|curve| curve.name == *wanted).unwrap();
            let curve = Curve::new(drawn.kind.unwrap(), &drawn.points, drawn.closed).unwrap();
            let lengths: Vec<f64> = design
                .panels
                .iter()
                .zip(&made.parts)
                .filter(|(panel, _)| curves_of(panel).contains(wanted))
                .map(|(_, made)| flat_length(made, &curve))
                .collect();
            println!("{name}: {wanted}: {lengths:?}");
            let [a, b] = lengths[..] else { panic!("{name}: {wanted} is in {lengths:?}") };
            assert!((a - b).abs() <= FITS * curve.length(), "{name}: {wanted}: {a} and {b}");
        }
    }
}

/// A boat's panels are cut from cylinders, so that all the twist there is comes from sampling and
/// from drawing curves through a few points.
#[test]
fn panels_of_boats_hardly_twist() {
    for name in ["dinghy", "pram", "kayak"] {
        for panel in made(name).1.parts {
            let warp = panel.measures.warp_max.to_degrees();
            println!("{name}: {}: {warp:.3}°", panel.name);
            assert!(warp < 0.5, "{name}: {}: {warp}°", panel.name);
        }
    }
}

/// The area of a boundary as a vector: half the sum of the cross products of its samples.
fn faces(panel: &Part) -> Vec3 {
    let samples = panel.found().unwrap().boundary.samples();
    let at = |i: usize| samples[i % samples.len()].position.to_vec();
    (0..samples.len()).fold(Vec3::ZERO, |sum, i| sum + at(i).cross(at(i + 1)) * 0.5)
}

#[test]
fn both_halves_of_a_boat_are_drawn_and_face_outwards() {
    for name in ["dinghy", "pram", "kayak"] {
        let mut values = template(name).unwrap().defaults();
        values.set("halves", Value::Choice("both".to_owned())).unwrap();
        let design = values.design().unwrap();
        let made = make(&design, &mut Unwatched).unwrap();
        let half = template(name).unwrap().defaults().design().unwrap();
        let twice = half.panels.iter().filter(|panel| (panel.count, panel.mirrored) == (2, 1));
        let mut both = twice.map(|panel| format!("{}-starboard", panel.name));
        assert!(both.all(|name| design.panels.iter().any(|panel| panel.name == name)), "{name}");
        assert!(design.panels.iter().all(|panel| panel.count == 1), "{name}");
        let panel = |name: &str| made.parts.iter().find(|panel| panel.name == name);
        for (half, outwards) in [("bottom", -Vec3::Z), ("side", Vec3::Y), ("deck", Vec3::Z)] {
            let (Some(port), Some(starboard)) =
                (panel(&format!("{half}-port")), panel(&format!("{half}-starboard")))
            else {
                assert!(half == "deck" && name != "kayak", "{name} has no {half}");
                continue;
            };
            let image = |v: Vec3| Vec3::new(v.x, -v.y, v.z);
            let (a, b) = (faces(port), faces(starboard));
            assert!(a.dot(outwards) > 0.0 && b.dot(image(outwards)) > 0.0, "{name}: {half}");
            assert!((image(a) - b).length() < 1e-9 * a.length(), "{name}: {half}: {a} {b}");
            assert_eq!(starboard.checked.verdict, Verdict::Bends);
            let areas = [port, starboard].map(|panel| panel.measures.area_flat_mm2);
            assert!((areas[0] - areas[1]).abs() < 1e-6 * areas[0], "{name}: {half}: {areas:?}");
        }
        for (board, outwards) in [("transom", -Vec3::X), ("bow-transom", Vec3::X)] {
            if let Some(board) = panel(board) {
                assert!(faces(board).dot(outwards) > 0.0, "{name}: {}", board.name);
            }
        }
        let on_keel = |panel: &&DesignPanel| curves_of(panel).contains(&"keel");
        assert_eq!(design.panels.iter().filter(on_keel).count(), 2, "{name}");
    }
}

/// The lines of the skiff that the template draws without a table: keel, chine, sheer.
fn skiff() -> Vec<NamedCurve> {
    let design = template("hull").unwrap().defaults().design().unwrap();
    let line = |name: &str| {
        let curve = design.curves.iter().find(|curve| curve.name == name).unwrap();
        NamedCurve { name: name.to_owned(), points: curve.points.clone() }
    };
    ["keel", "chine", "sheer"].map(line).to_vec()
}

/// Keel, chines, stem, sheer and the edges of transoms, one or two of them.
#[test]
fn every_edge_of_a_hull_with_a_deck_is_joined_along_its_whole_length() {
    let aft = || {
        let mut lines = skiff();
        lines.iter_mut().for_each(|line| line.points.reverse());
        lines
    };
    let scow = || {
        let mut lines = skiff();
        lines.iter_mut().for_each(|line| line.points.truncate(7));
        // Its bow ends in a plane, up to 1.4 mm.
        lines[1].points[6].at.x = 2687.0;
        lines
    };
    let flat = |lines: Vec<NamedCurve>| lines.into_iter().skip(1).collect::<Vec<_>>();
    for (lines, boards) in [
        (skiff(), 1),
        (aft(), 1),
        (scow(), 2),
        (flat(skiff()), 1),
        (flat(aft()), 1),
        (flat(scow()), 2),
    ] {
        let mut values = template("hull").unwrap().defaults();
        values.set("table", Value::Table(lines)).unwrap();
        for name in ["transoms", "deck"] {
            values.set(name, Value::Choice("yes".to_owned())).unwrap();
        }
        let made = make(&values.design().unwrap(), &mut Unwatched).unwrap();
        let transoms = made.parts.iter().filter(|part| part.name.starts_with("transom"));
        assert_eq!(transoms.count(), boards);
        let parts = made.parts.iter();
        let size = size_of(parts.flat_map(|part| part.sheet.mesh().positions().iter().copied()));
        let (mut pairs, mut most, mut free) = (0, 0.0f64, Vec::new());
        for part in &made.parts {
            println!("{}: {:?}", part.name, part.checked.verdict);
            for edge in &part.edges {
                let place = format!("{}/{}", part.name, edge.name);
                let own: f64 = edge.shared_mm.iter().map(|shared| shared[0]).sum();
                if (own - edge.length_flat_mm).abs() > 1e-6 * size {
                    free.push(format!("{place}: {own} of {} mm", edge.length_flat_mm));
                }
                let differ = edge.shared_mm.iter().map(|[own, other]| (own - other).abs());
                most = differ.fold(most, f64::max);
                pairs += edge.mates.len();
            }
        }
        println!("{most:e} of {size} mm, {pairs}; {free:?}");
        assert!(free.is_empty(), "{free:?}");
        assert!(most < 1e-6 * size, "{most:e} of {size} mm");
        let order = made.joining_order();
        assert_eq!(order.iter().filter(|step| step.begins).count(), 1);
        assert_eq!(order.iter().map(|step| step.joins.len()).sum::<usize>(), pairs / 2);
    }
}
