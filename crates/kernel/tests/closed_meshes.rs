//! Closed meshes are cut as far as it serves, and large ones with bounded work.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::design::{Design, DesignPanel, PanelMesh, PanelShape, Triangles};
use sheetwright::make::{Part, make};
use sheetwright::math::Point3;
use sheetwright::mesh::Mesh;
use sheetwright::watch::{Unwatched, Watch};
use sheetwright_shapes::meshes::{ball, bumpy_ball};
use std::cell::Cell;

fn design(mesh: &Mesh) -> Design {
    let (positions, triangles) = (mesh.positions().to_vec(), mesh.triangles().to_vec());
    let mesh = PanelMesh::new(Triangles { positions, triangles, left_out: 0 });
    let panel = DesignPanel::new("mesh", PanelShape::Mesh(mesh), 100);
    Design { panels: vec![panel], ..Design::default() }
}

fn made(mesh: &Mesh) -> Part {
    make(&design(mesh), &mut Unwatched).unwrap().parts.remove(0)
}

/// The largest factor by which lengths grow or shrink from the pattern to the shape.
fn factor(part: &Part) -> f64 {
    let distortion = part.measures.distortion.as_ref().unwrap();
    distortion.stretch_max.max(1.0 / distortion.stretch_min)
}

/// A ball of 12 sides a quarter with spikes at these places of a side of the cube.
fn spiked(spikes: &[[f64; 2]], height: f64) -> Mesh {
    let at = |p: Point3, [x, y]: [f64; 2]| {
        let quarter = std::f64::consts::FRAC_PI_4;
        let tan = |share: f64| {
            sheetwright::math::sin(quarter * share) / sheetwright::math::cos(quarter * share)
        };
        p.z > 0.5 && (p.x / p.z - tan(x)).abs() < 1e-6 && (p.y / p.z - tan(y)).abs() < 1e-6
    };
    ball(12, |p| if spikes.iter().any(|&s| at(p, s)) { height } else { 100.0 })
}

#[test]
fn spikes_that_stand_side_by_side_are_cut_through_and_on() {
    let sixth = 1.0 / 6.0;
    for (spikes, height) in [
        (&[[0.0, 0.0], [sixth, 0.0]][..], 110.0),
        (&[[0.0, 0.0], [sixth, 0.0], [0.0, sixth]], 112.0),
        (&[[0.0, 0.0], [sixth, 0.0]], 140.0),
        (&[[0.5, 0.5], [0.5, 0.5 + sixth]], 90.0),
    ] {
        let part = made(&spiked(spikes, height));
        assert!(!part.sheet.mesh().loops().is_empty());
        assert!(factor(&part) < 6.0, "{spikes:?} {height}: {}", factor(&part));
        assert!(part.predicted.unwrap().strain < 0.5, "{spikes:?} {height}");
    }
}

#[test]
fn a_rough_ball_is_cut_as_far_as_it_serves() {
    for rough in [0.0, 0.2, 0.6] {
        let part = made(&bumpy_ball(16, rough));
        assert!(factor(&part) < 5.0, "{rough}: {}", factor(&part));
        assert!(part.sheet.seams().len() < 60, "{rough}: {}", part.sheet.seams().len());
    }
}

/// Counts how often it is asked whether to stop: at least once a step.
#[derive(Default)]
struct Counting {
    asked: Cell<usize>,
}

impl Watch for Counting {
    fn stop(&self) -> bool {
        self.asked.set(self.asked.get() + 1);
        false
    }
}

#[test]
fn large_meshes_take_few_steps() {
    // Of 14,700 triangles and as many vertices as 400,000 divided by the most steps, 54.
    let mut watch = Counting::default();
    make(&design(&bumpy_ball(35, 0.05)), &mut watch).unwrap();
    let asked = watch.asked.get();
    assert!(asked < 100, "{asked}");
}
