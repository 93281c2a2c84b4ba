//! Meshes cut open: whatever their handles and holes, a disk comes out, with nothing lost.
#![allow(clippy::unwrap_used, reason = "a test that can't go on fails")]

use sheetwright::index::VertexIndex;
use sheetwright::math::{Point3, cos, from_deg, sin};
use sheetwright::mesh::{Cut, Mesh, angle_defects, cut_through, cut_to_disk, worst_points};
use sheetwright::sheet::{Sheet, cut_along, split_along_creases};

fn mesh(positions: Vec<Point3>, triangles: &[[usize; 3]]) -> Mesh {
    let triangles = triangles.iter().map(|t| t.map(VertexIndex::new)).collect();
    Mesh::new(positions, triangles).unwrap()
}

/// A grid in two triangles a cell, closed round in one way or both.
fn grid([m, n]: [usize; 2], closed: [bool; 2], place: impl Fn(usize, usize) -> Point3) -> Mesh {
    let [columns, rows] = [(m, closed[0]), (n, closed[1])].map(|(k, c)| if c { k } else { k - 1 });
    let at = |i: usize, j: usize| n * (i % m) + j % n;
    let mut triangles = Vec::new();
    for i in 0..columns {
        for j in 0..rows {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let positions = (0..m * n).map(|k| place(k / n, k % n)).collect();
    mesh(positions, &triangles)
}

fn round(turn: f64, radius: f64) -> [f64; 2] {
    [radius * cos(from_deg(360.0 * turn)), radius * sin(from_deg(360.0 * turn))]
}

fn torus() -> Mesh {
    grid([24, 12], [true, true], |i, j| {
        let [along, up] = round(j as f64 / 12.0, 30.0);
        let [x, y] = round(i as f64 / 24.0, 100.0 + along);
        Point3::new(x, y, up)
    })
}

fn tube() -> Mesh {
    grid([20, 6], [true, false], |i, j| {
        let [x, y] = round(i as f64 / 20.0, 50.0);
        Point3::new(x, y, 30.0 * j as f64)
    })
}

fn cube() -> Mesh {
    let at = |n: usize| Point3::new(n as f64 % 2.0, (n / 2) as f64 % 2.0, (n / 4) as f64);
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<[usize; 3]> =
        faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    mesh((0..8).map(at).collect(), &triangles)
}

/// A ball of latitudes and longitudes.
fn ball(longitudes: usize, latitudes: usize) -> Mesh {
    let mut positions = vec![Point3::new(0.0, 0.0, 100.0), Point3::new(0.0, 0.0, -100.0)];
    for j in 1..latitudes {
        let height = from_deg(180.0 * j as f64 / latitudes as f64);
        for i in 0..longitudes {
            let [x, y] = round(i as f64 / longitudes as f64, 100.0 * sin(height));
            positions.push(Point3::new(x, y, 100.0 * cos(height)));
        }
    }
    let at = |i: usize, j: usize| 2 + longitudes * j + i % longitudes;
    let mut triangles = Vec::new();
    for i in 0..longitudes {
        triangles.push([0, at(i, 0), at(i + 1, 0)]);
        triangles.push([1, at(i + 1, latitudes - 2), at(i, latitudes - 2)]);
        for j in 0..latitudes - 2 {
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh(positions, &triangles)
}

fn opened(mesh: &Mesh) -> Sheet {
    let cut = cut_to_disk(mesh);
    let open = cut_along(mesh, &cut).unwrap();
    // Nothing is lost, nothing is moved, and both sides of a seam are the same way.
    assert_eq!(open.mesh().triangles().len(), mesh.triangles().len());
    for (is, was) in open.mesh().triangles().iter().zip(mesh.triangles()) {
        assert_eq!(is.map(|v| open.origin(v)), *was);
    }
    let mut sides = 0;
    for seam in open.seams() {
        let [left, right] = seam
            .sides
            .each_ref()
            .map(|side| side.iter().map(|&v| open.origin(v)).collect::<Vec<_>>());
        assert_eq!(left, right);
        sides += left.len() - 1;
        // On the border of the sheet: forwards on its left, backwards on its right.
        for (side, way) in seam.sides.iter().zip([true, false]) {
            for pair in side.windows(2) {
                let n = open.mesh().topology().edge_between(pair[0], pair[1]).unwrap();
                let edge = &open.mesh().edges()[n];
                assert!(edge.is_border());
                let runs_up = edge.triangles[0].is_some();
                assert_eq!(runs_up == (pair[0] < pair[1]), way);
            }
        }
    }
    assert_eq!(sides, cut.len());
    open
}

fn assert_disk(open: &Sheet) {
    let pieces = open.mesh().components();
    assert_eq!((pieces.len(), open.mesh().loops().len(), open.mesh().euler()), (1, 1, 1));
    assert!(pieces[0].is_disk());
}

fn length(mesh: &Mesh, cut: &Cut) -> f64 {
    cut.iter().map(|&n| mesh.lengths()[n]).sum()
}

#[test]
fn a_tube_is_cut_along_the_shortest_way() {
    let tube = tube();
    let open = opened(&tube);
    assert_disk(&open);
    assert_eq!(open.seams().len(), 1);
    assert!((length(&tube, &cut_to_disk(&tube)) - 150.0).abs() < 1e-9);
}

#[test]
fn a_torus_is_cut_along_two_loops_that_meet() {
    let torus = torus();
    let open = opened(&torus);
    assert_disk(&open);
    // Not much longer than round the hole inside (140 π, its chords shorter) and through it (60 π).
    let cut = length(&torus, &cut_to_disk(&torus));
    assert!((550.0..700.0).contains(&cut), "{cut}");
}

#[test]
fn a_cube_is_cut_through_its_corners_and_along_its_edges() {
    let cube = cube();
    let open = opened(&cube);
    assert_disk(&open);
    // Seven edges of a cube open it, and all its corners are freed.
    assert_eq!(length(&cube, &cut_to_disk(&cube)), 7.0);
    let inside = open.mesh().topology().on_border().iter().filter(|&&border| !border).count();
    assert_eq!(inside, 0);
}

#[test]
fn a_ball_is_cut_from_end_to_end() {
    let ball = ball(24, 12);
    let open = opened(&ball);
    assert_disk(&open);
    assert_eq!(open.seams().len(), 1);
    let long = length(&ball, &cut_to_disk(&ball));
    assert!((290.0..330.0).contains(&long), "{long}");
}

#[test]
fn a_disk_needs_no_cut_and_all_holes_are_joined_to_the_border() {
    let plate = grid([12, 12], [false, false], |i, j| Point3::new(i as f64, j as f64, 0.0));
    assert!(cut_to_disk(&plate).is_empty());
    assert_eq!(*opened(&plate).mesh(), plate);
    // Two windows of a cell each.
    let keep: Vec<[usize; 3]> = plate
        .triangles()
        .iter()
        .enumerate()
        .filter(|(t, _)| ![2 * (11 * 3 + 3), 2 * (11 * 8 + 8)].contains(&(t - t % 2)))
        .map(|(_, corners)| corners.map(|v| v.get()))
        .collect();
    let windows = mesh(plate.positions().to_vec(), &keep);
    assert_eq!((windows.loops().len(), windows.euler()), (3, -1));
    let open = opened(&windows);
    assert_disk(&open);
    // From the first to the border in three sides, from the second in two.
    assert_eq!(length(&windows, &cut_to_disk(&windows)), 5.0);
}

#[test]
fn the_curvature_of_a_closed_mesh_is_two_full_turns() {
    for (mesh, turns) in [(cube(), 2.0), (ball(24, 12), 2.0), (torus(), 0.0), (tube(), 0.0)] {
        let sum: f64 = angle_defects(&mesh).iter().sum();
        assert!((sum - turns * from_deg(360.0)).abs() < 1e-9, "{sum}");
    }
}

#[test]
fn a_dart_reaches_the_worst_point() {
    // A plate with one cone in it.
    let plate = grid([11, 11], [false, false], |i, j| {
        let (x, y) = (i as f64 - 5.0, j as f64 - 5.0);
        Point3::new(x, y, 2.0 - (x * x + y * y).sqrt().min(2.0))
    });
    let worst = worst_points(&plate, from_deg(30.0));
    assert_eq!(worst[0], VertexIndex::new(60));
    let mut cut = Cut::new();
    cut_through(&plate, &mut cut, &worst[..1]);
    let open = cut_along(&plate, &cut).unwrap();
    assert_disk(&open);
    let mut vertices = (0..open.mesh().positions().len()).map(VertexIndex::new);
    let place = vertices.find(|&v| open.origin(v) == worst[0]).unwrap();
    assert!(open.mesh().topology().on_border()[place.get()]);
}

#[test]
fn a_cube_is_split_into_its_faces() {
    let cube = cube();
    let split = split_along_creases(&cube, from_deg(45.0)).unwrap();
    assert_eq!(split.mesh().components().len(), 6);
    assert!(
        split.mesh().components().iter().all(|piece| piece.is_disk() && piece.triangles.len() == 2)
    );
    assert_eq!(split.seams().len(), 12);
    let whole = split_along_creases(&cube, from_deg(100.0)).unwrap();
    assert_eq!(*whole.mesh(), cube);
    assert!(whole.seams().is_empty());
}
