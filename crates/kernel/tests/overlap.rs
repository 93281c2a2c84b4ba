//! Patterns that lie over themselves without an edge that crosses another, against counting
//! triangles.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::flatten::{Ended, RelaxOptions, Relaxed, relax};
use sheetwright::index::VertexIndex;
use sheetwright::math::{Point2, Point3, cos, sin};
use sheetwright::mesh::Mesh;
use sheetwright::predicate::{first_crossing_of_loops, orientation};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::random::Random;

/// A plate of 200 mm with a triangular window, `half` mm to each side along x and `open` mm deep,
/// and on the window's long edge a triangular flap `deep` mm long, turned up by an angle.
fn plate_with_flap(half: f64, open: f64, deep: f64, turned: f64) -> Mesh {
    let p = Point3::new;
    let positions = vec![
        p(-100.0, -100.0, 0.0),
        p(100.0, -100.0, 0.0),
        p(100.0, 100.0, 0.0),
        p(-100.0, 100.0, 0.0),
        p(-half, 0.0, 0.0),
        p(half, 0.0, 0.0),
        p(0.0, open, 0.0),
        p(0.0, deep * cos(turned), deep * sin(turned)),
    ];
    let triangles =
        [[0, 1, 5], [0, 5, 4], [1, 2, 5], [2, 3, 6], [2, 6, 5], [3, 4, 6], [3, 0, 4], [4, 5, 7]];
    Mesh::new(positions, triangles.map(|t| t.map(VertexIndex::new)).to_vec()).unwrap()
}

/// Whether two triangles of a pattern, or more, lie over some of many points in it.
fn lies_double(mesh: &Mesh, flat: &Relaxed, random: &mut Random) -> bool {
    let corners = |t: &[VertexIndex; 3]| t.map(|v| flat.flat.points[v.get()]);
    let covers = |[a, b, c]: [Point2; 3], at: Point2| {
        [[a, b], [b, c], [c, a]].iter().all(|&[from, to]| orientation(from, to, at).is_gt())
    };
    (0..4000).any(|_| {
        let at = Point2::new(random.between(0.0, 200.0), random.between(0.0, 200.0));
        mesh.triangles().iter().filter(|t| covers(corners(t), at)).count() > 1
    })
}

#[test]
fn a_flap_that_does_not_fit_its_window_overlaps() {
    let mut random = Random::new(36);
    let (mut fits, mut overlaps) = (0, 0);
    for _ in 0..60 {
        let [half, open] = [random.between(20.0, 60.0), random.between(3.0, 80.0)];
        let mut deep = random.between(5.0, 85.0);
        if (deep - open).abs() < 4.0 {
            deep += 8.0;
        }
        let mesh = plate_with_flap(half, open, deep, random.between(0.3, 2.0));
        let flat = relax(&mesh, &RelaxOptions::default(), &mut Unwatched).unwrap();
        assert_eq!(flat.ended, Ended::True, "{half} {open} {deep}");
        let loops = mesh.loops();
        let border: Vec<Point2> =
            loops.iter().flatten().map(|v| flat.flat.points[v.get()]).collect();
        let ranges = [0..loops[0].len(), loops[0].len()..border.len()];
        assert_eq!(first_crossing_of_loops(&border, &ranges), None);
        assert_eq!(flat.flat.overlap.is_some(), deep > open, "{half} {open} {deep}");
        assert_eq!(lies_double(&mesh, &flat, &mut random), deep > open, "{half} {open} {deep}");
        *(if deep > open { &mut overlaps } else { &mut fits }) += 1;
    }
    assert!(fits > 10 && overlaps > 10, "{fits} {overlaps}");
}
