//! Nets of flat facets at the press brake: what each fold is gauged from, and what the brake can't
//! do.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::bend::{Brake, BrakeFault, Hit, Reference, hits};
use sheetwright::design::{Design, DesignPanel, PanelMesh, PanelShape, Triangles};
use sheetwright::index::VertexIndex;
use sheetwright::make::{Part, make};
use sheetwright::math::Point3;
use sheetwright::watch::Unwatched;

/// The net of some rectangles with these corners.
fn net(rectangles: &[[[f64; 3]; 4]]) -> Part {
    let mut positions: Vec<Point3> = Vec::new();
    let mut triangles = Vec::new();
    for corners in rectangles {
        let numbers = corners.map(|[x, y, z]| {
            let at = Point3::new(x, y, z);
            let known = positions.iter().position(|&p| p == at);
            VertexIndex::new(known.unwrap_or_else(|| {
                positions.push(at);
                positions.len() - 1
            }))
        });
        let [a, b, c, d] = numbers;
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    let mesh = PanelMesh::new(Triangles { positions, triangles, left_out: 0 });
    let mesh = PanelMesh { facets: Some(true), ..mesh };
    let panel = DesignPanel::new("net", PanelShape::Mesh(mesh), 0);
    let design = Design { panels: vec![panel], ..Design::default() };
    let mut parts = make(&design, &mut Unwatched).unwrap().parts;
    assert_eq!(parts.len(), 1);
    parts.remove(0)
}

fn plan(part: &Part, die_mm: f64) -> Vec<Hit> {
    hits(&part.blank(), &Brake { die_mm: Some(die_mm), length_mm: None })
}

/// A channel of 60 × 100 mm with legs of 40 and 8 mm.
fn channel() -> Part {
    let leg = |x: f64, height: f64, up: bool| {
        let mut corners = [[x, 0.0, 0.0], [x, 100.0, 0.0], [x, 100.0, height], [x, 0.0, height]];
        if up {
            corners.reverse();
        }
        corners
    };
    let base = [[0.0, 0.0, 0.0], [60.0, 0.0, 0.0], [60.0, 100.0, 0.0], [0.0, 100.0, 0.0]];
    net(&[base, leg(0.0, 40.0, true), leg(60.0, 8.0, false)])
}

#[test]
fn folds_of_a_channel_are_gauged_from_edges_that_are_still_flat() {
    let part = channel();
    let plan = plan(&part, 20.0);
    assert_eq!(plan.len(), 2);
    for (n, hit) in plan.iter().enumerate() {
        assert!(matches!(hit.reference, Reference::Edge(_)), "{:?}", hit.reference);
        let [gauge, other] = hit.gauges_mm;
        assert!((gauge - other).abs() < 1e-6);
        let is = |wanted: f64| (gauge - wanted).abs() < 1e-6;
        assert!(is(40.0) || is(8.0) || n == 0 && (is(68.0) || is(100.0)), "{n}: {gauge}");
    }
    let is_short = |hit: &&Hit| {
        let short = |fault: &BrakeFault| match *fault {
            BrakeFault::Short { beyond_mm, least_mm } => {
                (beyond_mm - 8.0).abs() < 1e-6 && least_mm == 10.0
            }
            _ => false,
        };
        hit.faults.iter().any(short)
    };
    assert_eq!(plan.iter().filter(is_short).count(), 1, "one leg is too short for the die");
    assert_eq!(plan.iter().map(|hit| hit.faults.len()).sum::<usize>(), 1);
}

#[test]
fn a_second_fold_is_told_to_be_too_near_to_the_first() {
    let part = channel();
    let faults: Vec<BrakeFault> =
        plan(&part, 130.0).into_iter().flat_map(|hit| hit.faults).collect();
    let close = faults.iter().find_map(|fault| match *fault {
        BrakeFault::Close { to, apart_mm, least_mm } => Some((to, apart_mm, least_mm)),
        _ => None,
    });
    let (to, apart_mm, least_mm) = close.unwrap();
    assert_eq!((to, least_mm), (0, 65.0));
    assert!((apart_mm - 60.0).abs() < 1e-6, "{apart_mm}");
}

#[test]
fn walls_of_a_tray_are_gauged_from_no_wall_that_is_up() {
    let at = |x: f64, y: f64, z: f64| [x, y, z];
    let foot = [at(0., 0., 0.), at(100., 0., 0.), at(100., 80., 0.), at(0., 80., 0.)];
    let out = [at(-5., -5., 30.), at(105., -5., 30.), at(105., 85., 30.), at(-5., 85., 30.)];
    let wall = |n: usize| [foot[(n + 1) % 4], foot[n], out[n], out[(n + 1) % 4]];
    let part = net(&[foot, wall(0), wall(1), wall(2), wall(3)]);
    let plan = plan(&part, 20.0);
    assert_eq!(plan.len(), 4);
    // Walls are 30.4 mm high, and reach from rim to rim of 2 × 30.4 mm and the foot.
    let height = (30.0_f64 * 30.0 + 25.0).sqrt();
    for (n, hit) in plan.iter().enumerate() {
        assert!(matches!(hit.reference, Reference::Edge(_)), "{:?}", hit.reference);
        let gauge = hit.gauges_mm[0];
        let own = (gauge - height).abs() < 1e-6;
        let opposite = [80.0, 100.0].iter().any(|foot| (gauge - height - foot).abs() < 1e-6);
        assert!(own || opposite, "{gauge}");
        // The opposite wall is up by the third fold at the latest, or by the second.
        assert!(own || n < 2, "{n}: {gauge}");
        assert!(hit.faults.is_empty(), "{:?}", hit.faults);
    }
}
