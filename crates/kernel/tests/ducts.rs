//! The square-to-round duct against what is known of it, and pipes that are cut by planes.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright::design::{PanelMethod, make};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::transition::{Transition, lengths, neither_flat_nor_conical};

const CONCENTRIC: Transition = Transition {
    rectangle: [400.0, 400.0],
    diameter: 300.0,
    height: 350.0,
    offset: [0.0, 0.0],
    tilt_deg: 0.0,
};
const OFFSET: Transition =
    Transition { rectangle: [400.0, 300.0], offset: [120.0, 60.0], ..CONCENTRIC };
const TILTED: Transition = Transition { offset: [80.0, 0.0], tilt_deg: 30.0, ..CONCENTRIC };

/// Half the turn of the round end from one of so many samples to the next, radians.
fn half_step(samples: usize) -> f64 {
    std::f64::consts::PI / (samples - 1) as f64
}

#[test]
fn four_flat_triangles_and_four_cones_come_out_by_themselves() {
    for (name, duct) in [("concentric", CONCENTRIC), ("offset", OFFSET), ("tilted", TILTED)] {
        // As the template samples it, and where no sample lies at a quarter of the round end.
        for (samples, flat) in [(241, 1e-6), (200, half_step(200)), (137, half_step(137))] {
            let share = neither_flat_nor_conical(&duct.made(samples), flat);
            println!("{name}, {samples}: {:.5} % of the area is neither", 100.0 * share);
            assert!(share <= 0.001, "{name}, {samples}: {share}");
        }
    }
}

#[test]
fn they_are_the_optimum_over_all_triangulations_too() {
    for duct in [CONCENTRIC, OFFSET, TILTED] {
        for (samples, flat) in [(81, 1e-6), (90, half_step(90))] {
            let mut design = duct.design();
            design.panels[0].samples = samples;
            design.panels[0].method = PanelMethod::Optimal;
            let made = make(&design, &mut Unwatched).unwrap().panels.remove(0);
            assert!(made.triangulation.proven_optimal);
            let share = neither_flat_nor_conical(&made, flat);
            println!("{samples}: {:.5} % of the area is neither", 100.0 * share);
            assert!(share <= 0.001, "{share}");
        }
    }
}

#[test]
fn lengths_are_those_of_the_classical_triangulation() {
    const DIVISIONS: usize = 24;
    for duct in [CONCENTRIC, OFFSET] {
        let classical = duct.classical(DIVISIONS);
        let ours = lengths(&duct.made(241), DIVISIONS);
        println!("{classical:?}\n{ours:?}");
        for (a, b) in classical.elements.iter().zip(&ours.elements) {
            assert!((a - b).abs() < 1e-3, "{a} {b}");
        }
        // Chords of 15° are shorter than their arcs by 0.285 %.
        let arc = std::f64::consts::PI * duct.diameter;
        assert!((classical.round / arc - 1.0 + 0.00285).abs() < 1e-4);
        assert!((ours.round / arc - 1.0).abs() < 3e-5);
        // With as many divisions as ours has samples the two patterns are one.
        let fine = duct.classical(240);
        assert!((fine.round_span - ours.round_span).abs() < 0.05, "{fine:?}");
        assert!((fine.square_span - ours.square_span).abs() < 0.05, "{fine:?}");
    }
}
