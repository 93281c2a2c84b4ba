//! Meshes laid flat: known ones exactly, others as well as can be, and what can't be in words.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::check::FindingKind;
use sheetwright::design::{Design, DesignPanel, PanelMesh, PanelShape, Triangles};
use sheetwright::flatten::{Aim, Ended, RelaxError, RelaxOptions, Relaxed, relax, relax_lengths};
use sheetwright::index::VertexIndex;
use sheetwright::make::make;
use sheetwright::math::{Point2, Point3, cos, sin};
use sheetwright::measure::{Distortion, cut_suggestion, distortion};
use sheetwright::mesh::{Mesh, MeshError};
use sheetwright::watch::{Unwatched, Watch};
use sheetwright_shapes::meshes::{bumpy, cap, cone, cylinder, grid, grid_mesh};
use std::f64::consts::{PI, TAU};

const AIMS: [Aim; 3] = [Aim::Mean, Aim::Max, Aim::Seams];

fn laid(mesh: &Mesh, aim: Aim) -> (Relaxed, Distortion) {
    let options = RelaxOptions { aim, ..RelaxOptions::default() };
    let flat = relax(mesh, &options, &mut Unwatched).unwrap();
    let measures = distortion(mesh, &flat.flat.points);
    assert_eq!(flat.flipped, 0);
    (flat, measures)
}

#[test]
fn developable_meshes_are_exact() {
    let plane = grid_mesh(12, 9, |i, j| Point3::new(3.0 * i as f64, 2.0 * j as f64, 7.0));
    let meshes = [
        ("plane", plane),
        ("cylinder", cylinder(40.0, 2.5, 90.0, 30, 1)),
        ("cone", cone(10.0, 60.0, 4.0, 40, 12)),
        ("one triangle", grid_mesh(2, 2, |i, j| Point3::new(i as f64, j as f64, (i * j) as f64))),
    ];
    for (name, mesh) in &meshes {
        for aim in AIMS {
            let (flat, measures) = laid(mesh, aim);
            assert_eq!(flat.ended, Ended::True, "{name} {aim:?} {}", measures.length_error_max);
            assert!(measures.length_error_max < 1e-10, "{name} {}", measures.length_error_max);
            assert!(flat.flat.overlap.is_none());
            assert!(cut_suggestion(mesh, &measures, 1e-6).is_none());
        }
    }
    // The cylinder's own development, up to motion: distances between far vertices agree.
    let mesh = &meshes[1].1;
    let (flat, _) = laid(mesh, Aim::Mean);
    let chord = 2.0 * 40.0 * sin(0.5 * 2.5 / 30.0);
    let developed = |v: usize| Point2::new(chord * (v / 31) as f64, mesh.positions()[v].z);
    for (a, b) in [(0, 960), (30, 930), (5, 500)] {
        let error =
            flat.flat.points[a].distance(flat.flat.points[b]) - developed(a).distance(developed(b));
        assert!(error.abs() < 1e-8, "{error}");
    }
}

#[test]
fn a_pattern_lies_as_patterns_do() {
    let (flat, _) = laid(&cylinder(40.0, 1.0, 90.0, 8, 3), Aim::Mean);
    let most = |of: fn(&Point2) -> f64| flat.flat.points.iter().map(of).fold(f64::MIN, f64::max);
    assert!(flat.flat.points.iter().all(|p| p.x >= -1e-9 && p.y >= -1e-9));
    assert!(most(|p| p.x) >= most(|p| p.y));
}

/// A square of 21 × 21 vertices with a hole in it, bent by `bend`.
fn window(bend: impl Fn(f64, f64) -> Point3) -> Mesh {
    let hole = |n: usize| (8..=12).contains(&n);
    let (positions, triangles) = grid(21, 21, |i, j| {
        let inside = hole(i) && hole(j) && !(i == 8 || i == 12 || j == 8 || j == 12);
        (!inside).then(|| bend(i as f64 - 10.0, j as f64 - 10.0))
    });
    Mesh::new(positions, triangles).unwrap()
}

#[test]
fn holes_stay_open_and_exact() {
    let flat = window(|x, y| Point3::new(x, y, 0.0));
    let rolled = window(|x, y| Point3::new(9.0 * cos(x / 9.0), 9.0 * sin(x / 9.0), y));
    for mesh in [&flat, &rolled] {
        assert_eq!(mesh.loops().len(), 2);
        for aim in AIMS {
            let (flat, measures) = laid(mesh, aim);
            assert!(measures.length_error_max < 1e-10, "{}", measures.length_error_max);
            assert!(flat.flat.overlap.is_none());
        }
    }
}

#[test]
fn a_closed_tube_is_strained_and_a_cut_is_suggested() {
    let around = 24;
    let (positions, _) = grid(around, 9, |i, j| {
        let turn = TAU * i as f64 / around as f64;
        Some(Point3::new(20.0 * cos(turn), 20.0 * sin(turn), 5.0 * j as f64))
    });
    let mut triangles = Vec::new();
    for i in 0..around {
        for j in 0..8 {
            let at = |i: usize, j: usize| VertexIndex::new((i % around) * 9 + j);
            triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    let tube = Mesh::new(positions, triangles).unwrap();
    let (flat, measures) = laid(&tube, Aim::Max);
    assert_ne!(flat.ended, Ended::True);
    assert!(measures.length_error_max > 0.1, "{}", measures.length_error_max);
    let cut = cut_suggestion(&tube, &measures, 0.02).unwrap();
    assert!(cut.strain > 0.1);
    assert_eq!(cut.path.len(), 9, "straight along the tube: {:?}", cut.path);
    for pair in cut.path.windows(2) {
        assert!(tube.topology().edge_between(pair[0], pair[1]).is_some());
    }
    let on_border = tube.topology().on_border();
    assert!(on_border[cut.path[0].get()] && on_border[cut.path[8].get()]);
}

#[test]
fn a_dome_is_cut_from_its_top() {
    let dome = cap(1.2, 12, 30);
    let (_, measures) = laid(&dome, Aim::Mean);
    let cut = cut_suggestion(&dome, &measures, 0.001).unwrap();
    assert!(dome.position(cut.path[0]).z > 0.8, "{:?}", dome.position(cut.path[0]));
    assert!(dome.topology().on_border()[cut.path.last().unwrap().get()]);
    assert!(cut_suggestion(&dome, &measures, 10.0).is_none());
}

#[test]
fn an_overlapping_spiral_is_found_and_named() {
    // 2.6 turns round the cone are 2.25 turns in the plane.
    let spiral = cone(20.0, 30.0, 2.6 * TAU, 160, 4);
    let (flat, measures) = laid(&spiral, Aim::Mean);
    assert!(measures.length_error_max < 1e-10, "{}", measures.length_error_max);
    let (a, b) = flat.flat.overlap.unwrap();
    assert!(a != b && spiral.topology().on_border()[a] && spiral.topology().on_border()[b]);
    assert!(laid(&cone(20.0, 30.0, TAU, 60, 4), Aim::Mean).0.flat.overlap.is_none());
}

#[test]
fn each_aim_is_best_at_its_own() {
    let mesh = bumpy(24);
    let of = AIMS.map(|aim| laid(&mesh, aim).1);
    let [mean, max, seams] = &of;
    for other in [max, seams] {
        assert!(mean.length_error_mean < other.length_error_mean);
    }
    for other in [mean, seams] {
        assert!(max.length_error_max < other.length_error_max);
    }
    assert!(seams.border_error_max < 1e-9, "{}", seams.border_error_max);
    assert!(mean.border_error_max > 1e-6 && max.border_error_max > 1e-6);
    // Little is lost elsewhere.
    assert!(seams.length_error_mean < 3.0 * mean.length_error_mean);
}

#[test]
fn strongly_curved_surfaces_are_not_turned_over() {
    // Nearly a whole sphere: the conformal form squeezes its middle by thousands, and no form is
    // good. The border, true, would be far too short for what is in it.
    let ball = cap(0.93 * PI, 24, 30);
    for aim in AIMS {
        let (flat, measures) = laid(&ball, aim);
        assert!(measures.stretch_min > 0.0, "{aim:?} {:?}", flat.ended);
        assert!(matches!(flat.ended, Ended::Least | Ended::Squeezed), "{:?}", flat.ended);
    }
    let dome = cap(0.5 * PI, 16, 40);
    for aim in AIMS {
        let (flat, measures) = laid(&dome, aim);
        assert!(flat.flat.overlap.is_none());
        assert_eq!(flat.ended, Ended::Least, "{aim:?}");
        assert!(aim != Aim::Seams || measures.border_error_max < 1e-9);
    }
}

#[test]
fn a_border_that_could_not_be_true_is_said_to_be() {
    for angle in [0.3, 0.5, 0.93] {
        let ball = cap(angle * PI, 24, 30);
        let triangles = Triangles {
            positions: ball.positions().to_vec(),
            triangles: ball.triangles().to_vec(),
            left_out: 0,
        };
        for aim in AIMS {
            let mesh = PanelMesh { aim, ..PanelMesh::new(triangles.clone()) };
            let panel = DesignPanel::new("ball", PanelShape::Mesh(mesh), 3);
            let design = Design { panels: vec![panel], ..Design::default() };
            let made = make(&design, &mut Unwatched).unwrap();
            let panel = &made.parts[0];
            let said = panel
                .checked
                .findings
                .iter()
                .any(|f| matches!(f.kind, FindingKind::BorderNotTrue { .. }));
            let error = panel.measures.distortion.as_ref().unwrap().border_error_max;
            assert_eq!(said, aim == Aim::Seams && error > 1e-9, "{angle} π, {aim:?}: {error}");
            assert!(aim != Aim::Seams || angle > 0.9 || !said, "{angle} π: {error}");
        }
    }
}

#[test]
fn what_cannot_lie_flat_is_refused_in_words() {
    let refused = |positions: Vec<Point3>, triangles: &[[usize; 3]]| {
        let triangles = triangles.iter().map(|t| t.map(VertexIndex::new)).collect();
        let mesh = Mesh::new(positions, triangles).unwrap();
        relax(&mesh, &RelaxOptions::default(), &mut Unwatched).unwrap_err()
    };
    let corners = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
    let corners = corners.map(|[x, y, z]| Point3::new(x, y, z)).to_vec();
    let closed = refused(corners.clone(), &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
    assert_eq!(closed, RelaxError::Closed);
    assert!(closed.to_string().contains("must be cut open"));
    let mut two = corners[..3].to_vec();
    two.extend(corners[..3].iter().map(|p| Point3::new(p.x, p.y, 5.0)));
    assert_eq!(refused(two, &[[0, 1, 2], [3, 4, 5]]), RelaxError::Components { found: 2 });
    // A torus of 6 × 5 cells without one triangle.
    let at = |i: usize, j: usize| 5 * (i % 6) + j % 5;
    let mut torus = Vec::new();
    for (i, j) in (0..6).flat_map(|i| (0..5).map(move |j| (i, j))) {
        torus.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
        torus.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
    torus.pop();
    let positions = (0..30).map(|n| {
        let (a, b) = ((n / 5) as f64 * TAU / 6.0, (n % 5) as f64 * TAU / 5.0);
        let r = 3.0 + cos(b);
        Point3::new(r * cos(a), r * sin(a), sin(b))
    });
    assert_eq!(refused(positions.collect(), &torus), RelaxError::Handles { found: 1 });
    // What is no mesh does not come so far.
    assert_eq!(Mesh::new(Vec::new(), Vec::new()), Err(MeshError::Empty));
}

#[test]
fn lengths_that_make_no_triangle_are_named() {
    let mesh = grid_mesh(3, 3, |i, j| Point3::new(i as f64, j as f64, 0.0));
    let mut lengths = mesh.lengths();
    lengths[0] = 100.0;
    let options = RelaxOptions::default();
    let refused = relax_lengths(mesh.topology(), &lengths, &options, &mut Unwatched);
    assert!(matches!(refused, Err(RelaxError::NoTriangle { .. })));
}

/// Stops after some questions.
struct Impatient {
    asked: std::cell::Cell<usize>,
    patience: usize,
}

impl Watch for Impatient {
    fn stop(&self) -> bool {
        self.asked.set(self.asked.get() + 1);
        self.asked.get() > self.patience
    }
}

#[test]
fn stopping_and_running_out_of_steps_are_outcomes() {
    let mesh = bumpy(12);
    let stopped = |patience: usize| {
        let mut watch = Impatient { asked: 0.into(), patience };
        relax(&mesh, &RelaxOptions::default(), &mut watch)
    };
    assert_eq!(stopped(0), Err(RelaxError::Stopped));
    let early = stopped(3).unwrap();
    assert_eq!((early.ended, early.flipped), (Ended::Stopped, 0));
    let fast = relax(&mesh, &RelaxOptions::FAST, &mut Unwatched).unwrap();
    assert_eq!((fast.ended, fast.steps), (Ended::OutOfSteps, 1));
    let best = relax(&mesh, &RelaxOptions::default(), &mut Unwatched).unwrap();
    assert_eq!(best.ended, Ended::Least);
    let mean = |flat: &Relaxed| distortion(&mesh, &flat.flat.points).length_error_mean;
    assert!(mean(&best) < mean(&fast));
}
