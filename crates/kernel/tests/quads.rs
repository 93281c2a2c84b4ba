//! Quads of random boundaries and of known developable surfaces.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright::boundary::{Boundary, Outline, PlaneChoice, Side, supporting_plane};
use sheetwright::curve::Sample;
use sheetwright::math::{Point3, Vec3, cos, sin, to_deg};
use sheetwright::quads::{
    EdgeCurve, FaceShape, PlanarEnd, PlanarOptions, QuadMesh, lay_quads_flat, planar, quads, smooth,
};
use sheetwright::surface::{Connectivity, Surface};
use sheetwright::tolerance::Tolerance;
use sheetwright::triangulate::{TriangulateOptions, triangulate};
use sheetwright::watch::{Unwatched, Watch};
use sheetwright_shapes::developable::blobs;
use sheetwright_shapes::pierced::{plate, roof, tube};
use sheetwright_shapes::random::{Random, grid, star, tangle};
use std::collections::{BTreeMap, BTreeSet};

fn boundaries() -> impl Iterator<Item = Boundary> {
    (0..240u64).filter_map(|seed| {
        let random = &mut Random::new(51_000 + seed);
        let m = 4 + random.below(60);
        match seed % 6 {
            0 => star(random, m, 0.2),
            1 => tangle(random, m, 0.2),
            2 => grid(random, m),
            3 => plate(random, &[30, 8], 0.2),
            4 => roof(random, &[40, 9, 7]),
            _ => tube(random, [18, 14], 0.1),
        }
    })
}

fn surface(boundary: &Boundary) -> Option<Surface> {
    let plane = supporting_plane(boundary, PlaneChoice::Auto).unwrap();
    let found =
        triangulate(boundary, plane.as_ref(), &TriangulateOptions::default(), &mut Unwatched);
    let connectivity = Connectivity::new(boundary.loops(), found.ok()?.triangles).unwrap();
    Some(Surface::new(connectivity, boundary.positions()))
}

fn degrees(mesh: &QuadMesh) -> Vec<usize> {
    let mut degrees = vec![2; mesh.vertices.len()];
    for end in mesh.rungs.iter().flatten() {
        degrees[*end] += 1;
    }
    degrees
}

/// What the five steps promise, of a mesh as they leave it.
fn check(surface: &Surface, boundary: &Boundary, outline: &Outline, mesh: &QuadMesh) {
    let degrees = degrees(mesh);
    for (vertices, samples) in mesh.loops.iter().zip(boundary.loops()) {
        // No corner is lost, nor a sample without rungs.
        let hinges = surface.connectivity().hinges();
        for i in samples.clone() {
            let has_rung = hinges.iter().any(|h| h.rung.ends().iter().any(|e| e.get() == i));
            let at = boundary.samples()[i].position;
            let is_kept = vertices.clone().any(|v| mesh.vertices[v].position == at);
            assert!(is_kept || (has_rung && !boundary.samples()[i].is_corner()), "sample {i}");
        }
    }
    // Two sides only where there was no rung, or at a straight end.
    for (i, &degree) in degrees.iter().enumerate().filter(|(_, degree)| **degree == 2) {
        let at = mesh.vertices[i].position;
        let sample = (0..boundary.len()).find(|&s| boundary.samples()[s].position == at).unwrap();
        let rungs = surface.connectivity().hinges().iter();
        let has_rung = rungs.clone().any(|h| h.rung.ends().iter().any(|e| e.get() == sample));
        assert!(!has_rung || boundary.samples()[sample].is_corner(), "degree {degree}");
    }
    check_moved(boundary, outline, mesh);
}

/// What they promise, and sliding along the outline keeps.
fn check_moved(boundary: &Boundary, outline: &Outline, mesh: &QuadMesh) {
    let loops = boundary.loops();
    assert_eq!(mesh.loops.len(), loops.len());
    for (of_loop, vertices) in mesh.loops.iter().enumerate() {
        // In order, once round.
        let along: Vec<f64> = vertices.clone().map(|i| mesh.vertices[i].along_mm).collect();
        assert!(along.windows(2).all(|pair| pair[0] < pair[1]), "{along:?}");
        assert!(along[along.len() - 1] < along[0] + outline.length(of_loop));
        for i in vertices.clone() {
            let vertex = &mesh.vertices[i];
            assert_eq!(vertex.of_loop, of_loop);
            let place = outline.at(of_loop, vertex.along_mm, Side::Leaving).position;
            assert!(place.distance(vertex.position) < 1e-9 * boundary.size());
        }
    }
    // A rung at every vertex, but where strips end.
    let degrees = degrees(mesh);
    assert!(degrees.iter().all(|&degree| degree == 2 || degree == 3));
    // As many rungs as the boundary and the holes leave room for: the same surface.
    let holes = loops.len() - 1;
    assert_eq!(mesh.cells.len() + holes, mesh.rungs.len() + 1, "Euler");
    let rungs: BTreeSet<[usize; 2]> = mesh.rungs.iter().copied().collect();
    for cell in &mesh.cells {
        let count = cell.corners.len();
        let sides = (0..count).map(|n| (cell.corners[n], cell.corners[(n + 1) % count]));
        let of_cell = sides.filter(|&(a, b)| rungs.contains(&[a.min(b), a.max(b)])).count();
        let without = cell.corners.iter().filter(|&&i| degrees[i] == 2).count();
        assert_eq!(count, 2 * of_cell + without);
        // k − 1 quads of 2k corners, and a triangle if the number is odd.
        let triangles = cell.faces.iter().filter(|face| face.len() == 3).count();
        assert_eq!((triangles, cell.faces.len()), (count % 2, count.div_ceil(2) - 1));
        assert!(cell.faces.iter().all(|face| (3..=4).contains(&face.len())));
    }
    // A manifold whose border is the loops: Connectivity refuses all else.
    let triangles = mesh.triangulated().unwrap();
    let faces = mesh.faces().map(|face| face.len() - 2).sum::<usize>();
    assert_eq!(triangles.connectivity().triangles().len(), faces);
    assert_eq!(faces + 2, mesh.vertices.len() + 2 * holes);
}

#[test]
fn quads_cover_the_boundary_with_one_rung_a_vertex() {
    let (mut tried, mut larger, mut quads_in_all, mut faces) = (0, 0, 0, 0);
    for boundary in boundaries() {
        let Some(surface) = surface(&boundary) else { continue };
        let outline = Outline::through(&boundary);
        let mesh = quads(&surface, &boundary, &outline);
        check(&surface, &boundary, &outline, &mesh);
        tried += 1;
        larger += mesh.larger_polygons();
        quads_in_all += mesh.faces().filter(|face| face.len() == 4).count();
        faces += mesh.faces().count();
    }
    println!("{tried} boundaries, {larger} larger polygons, {quads_in_all} quads of {faces} faces");
    assert!(tried > 150 && larger > 100 && quads_in_all * 10 > faces * 8);
}

/// Lengths of a flat pattern against those in space, both diagonals of every quad included;
/// relative to the size.
fn flat_error(mesh: &QuadMesh, size: f64) -> f64 {
    let (sheet, flat) = lay_quads_flat(mesh, &[], &mut Unwatched).unwrap();
    // Along a seam a vertex lies on the pattern twice; the triangles know which place is theirs.
    let surface = mesh.triangulated().unwrap();
    let mut places: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    let of_sheet = sheet.mesh().triangles();
    for (n, (t, u)) in surface.connectivity().triangles().iter().zip(of_sheet).enumerate() {
        places.extend(t.iter().zip(u).map(|(a, b)| ((n, a.get()), b.get())));
    }
    let (mut worst, mut first) = (0.0f64, 0);
    for face in mesh.faces() {
        let count = face.len() - 2;
        let place = |i: usize| (first..first + count).find_map(|n| places.get(&(n, i))).unwrap();
        for (k, &a) in face.iter().enumerate() {
            for &b in &face[..k] {
                let space = mesh.vertices[a].position.distance(mesh.vertices[b].position);
                let laid = flat.points[*place(a)].distance(flat.points[*place(b)]);
                worst = worst.max((space - laid).abs() / size);
            }
        }
        first += count;
    }
    worst
}

fn options(leave_mm: f64) -> PlanarOptions {
    PlanarOptions { even: Tolerance::new(1e-9).unwrap(), leave_mm }
}

/// A smooth surface hangs together like the mesh, its strips are G1 across their rulings, and it is
/// near to the outline and to a developable one.
fn check_smooth(mesh: &QuadMesh, outline: &Outline, size: f64) {
    let made = smooth(mesh, outline);
    let mut uses = vec![0; made.edges.len()];
    for face in &made.faces {
        let ends = |&(edge, reversed): &(usize, bool)| {
            let [from, to] = made.edges[edge].ends;
            if reversed { [to, from] } else { [from, to] }
        };
        let border: Vec<[usize; 2]> = face.border.iter().map(ends).collect();
        for n in 0..border.len() {
            assert_eq!(border[n][1], border[(n + 1) % border.len()][0], "a border is closed");
        }
        face.border.iter().for_each(|&(edge, _)| uses[edge] += 1);
        let FaceShape::Ruled(rails) = face.shape else { continue };
        let rails = rails.map(|edge| match &made.edges[edge].curve {
            EdgeCurve::Spline(rail) => rail,
            EdgeCurve::Line => panic!("a rail is a spline"),
        });
        assert_eq!(rails[0].knots, rails[1].knots);
        let [p, q] = [0, 1].map(|side| rails[side].spans());
        for i in 1..p.len() {
            let step = |n: usize| rails[0].knots[n + 1] - rails[0].knots[n];
            let lambda = step(i) / step(i - 1);
            for spans in [&p, &q] {
                let (before, behind) = (spans[i - 1].derivative(1.0), spans[i].derivative(0.0));
                assert!((behind - before * lambda).length() < 1e-9 * size, "G1");
            }
        }
    }
    // Rungs join two faces; what is on the boundary has one.
    let shared = uses.iter().filter(|&&uses| uses == 2).count();
    assert!(uses.iter().all(|&uses| uses == 1 || uses == 2));
    assert_eq!(shared + 1, made.faces.len(), "faces hang together as a tree");
    println!(
        "  {} faces, {} strips, off by {:.1e} of the size, warp {:.2}°",
        made.faces.len(),
        made.strips(),
        made.deviation_max_mm / size,
        to_deg(made.warp_max)
    );
    assert!(made.deviation_max_mm < 2e-3 * size && to_deg(made.warp_max) < 12.0);
}

#[test]
fn quads_of_developable_surfaces_are_made_planar_on_their_curves_and_unroll() {
    for blob in blobs() {
        for m in [40, 120] {
            let (boundary, _) = blob.boundary(m);
            let surface = surface(&boundary).unwrap();
            let outline = Outline::through(&boundary);
            let mesh = quads(&surface, &boundary, &outline);
            let done = planar(&mesh, &outline, &options(0.0), &mut Unwatched);
            println!(
                "{} {m}: {:?} {:.1e} → {:.1e} mm, moved {:.2} mm",
                blob.name, done.end, done.uneven_before_mm, done.uneven_after_mm, done.moved_max_mm
            );
            assert_eq!(done.end, PlanarEnd::OnOutline);
            assert!(done.uneven_after_mm < 1e-9 * boundary.size());
            check_moved(&boundary, &outline, &done.mesh);
            assert_eq!(done.mesh.crossed_quads(), 0);
            assert!(flat_error(&done.mesh, boundary.size()) < 1e-9);
            check_smooth(&done.mesh, &outline, boundary.size());
        }
    }
}

#[test]
fn random_boundaries_end_as_they_say() {
    let mut ends: BTreeMap<String, usize> = BTreeMap::new();
    let mut unrolled = 0;
    for boundary in boundaries() {
        let Some(surface) = surface(&boundary) else { continue };
        let outline = Outline::through(&boundary);
        let mesh = quads(&surface, &boundary, &outline);
        let size = boundary.size();
        let done = planar(&mesh, &outline, &options(0.05 * size), &mut Unwatched);
        *ends.entry(format!("{:?}", done.end)).or_default() += 1;
        assert_eq!(done.mesh.unevenness_max_mm(), done.uneven_after_mm);
        assert_eq!(done.mesh.cells, mesh.cells, "nothing but places changes");
        let off = done.mesh.vertices.iter().map(|v| {
            outline.at(v.of_loop, v.along_mm, Side::Leaving).position.distance(v.position)
        });
        let off = off.fold(0.0, f64::max);
        let corners = |mesh: &QuadMesh| -> Vec<Point3> {
            mesh.vertices.iter().filter(|v| v.is_corner).map(|v| v.position).collect()
        };
        match done.end {
            PlanarEnd::OnOutline => {
                assert!(done.uneven_after_mm < 1e-9 * size && off < 1e-9 * size);
                assert_eq!(corners(&mesh), corners(&done.mesh));
                check_moved(&boundary, &outline, &done.mesh);
                // Round holes, lengths may change a little so that cuts close.
                if done.mesh.crossed_quads() == 0 && done.mesh.loops.len() == 1 {
                    assert!(flat_error(&done.mesh, size) < 1e-9);
                    unrolled += 1;
                }
            }
            PlanarEnd::OffOutline => {
                assert!(done.uneven_after_mm < 1e-9 * size);
                assert!((off - done.off_max_mm).abs() < 1e-9 * size && off <= 0.05 * size);
            }
            PlanarEnd::TooFarOff => {
                assert!(done.uneven_after_mm <= done.uneven_before_mm);
                assert!(off < 1e-9 * size && done.off_max_mm > 0.05 * size);
            }
            PlanarEnd::NotFound | PlanarEnd::Stopped => assert_eq!(done.mesh, mesh),
        }
    }
    println!("{ends:?}, {unrolled} unrolled");
    assert!(unrolled > 10);
    assert!(ends["OnOutline"] > 20 && ends["OffOutline"] > 20);
    let all: usize = ends.values().sum();
    assert!(ends.get("NotFound").is_none_or(|&n| n * 10 < all));
}

/// A strip between two rails with eleven samples each and straight ends.
fn strip(rails: [&dyn Fn(f64) -> (Point3, Vec3); 2]) -> (Boundary, Surface) {
    let rail = |rail: &dyn Fn(f64) -> (Point3, Vec3)| -> Vec<Sample> {
        let sample = |n: usize| {
            let (position, tangent) = rail(n as f64 / 10.0);
            let tangent = tangent / tangent.length();
            Sample { position, tangent_in: tangent, tangent_out: tangent }
        };
        (0..=10).map(sample).collect()
    };
    let mut samples = rail(rails[0]);
    samples.extend(rail(rails[1]));
    for (end, start) in [(10, 11), (21, 0)] {
        let way: Vec3 = samples[start].position - samples[end].position;
        samples[end].tangent_out = way / way.length();
        samples[start].tangent_in = way / way.length();
    }
    let boundary = Boundary::new(vec![samples]).unwrap();
    let surface = surface(&boundary).unwrap();
    (boundary, surface)
}

#[test]
fn a_strip_of_a_cylinder_has_its_rulings_for_rungs() {
    let arc = |along: f64, y: f64| {
        let (s, c) = (sin(along), cos(along));
        (Point3::new(100.0 * s, y, 100.0 * c), Vec3::new(c, 0.0, -s))
    };
    let back = |t: f64| {
        let (position, tangent) = arc(1.0 - t, 80.0);
        (position, -tangent)
    };
    let (boundary, surface) = strip([&|t| arc(t, 0.0), &back]);
    let outline = Outline::through(&boundary);
    let mesh = quads(&surface, &boundary, &outline);
    check(&surface, &boundary, &outline, &mesh);
    // The straight ends are rulings, so that the diagonals beside them go as well.
    let rulings: Vec<[usize; 2]> = (1..10).map(|n| [n, 21 - n]).collect();
    assert_eq!((mesh.rungs.clone(), mesh.vertices.len()), (rulings, 22));
    let done = planar(&mesh, &outline, &options(0.0), &mut Unwatched);
    assert_eq!((done.end, done.moved_max_mm), (PlanarEnd::OnOutline, 0.0));
}

/// Two straight rails that are skew, whose quads no sliding makes planar.
fn skew() -> (Boundary, Surface) {
    let p = Point3::new;
    let rail = |from: Point3, to: Point3| move |t: f64| (from.lerp(to, t), to - from);
    let first = rail(p(0., 0., 0.), p(100., 0., 0.));
    strip([&first, &rail(p(100., 100., 10.), p(0., 100., -10.))])
}

#[test]
fn skew_rails_are_left_by_no_more_than_is_allowed() {
    let (boundary, surface) = skew();
    let outline = Outline::through(&boundary);
    let mesh = quads(&surface, &boundary, &outline);
    let free = planar(&mesh, &outline, &options(10.0), &mut Unwatched);
    println!("{:?}, off by {:.3} mm", free.end, free.off_max_mm);
    assert_eq!(free.end, PlanarEnd::OffOutline);
    assert!(free.off_max_mm > 1e-3 && free.off_max_mm < 10.0);
    assert!(flat_error(&free.mesh, boundary.size()) < 1e-9);
    let tight = planar(&mesh, &outline, &options(0.5 * free.off_max_mm), &mut Unwatched);
    assert_eq!((tight.end, tight.off_max_mm), (PlanarEnd::TooFarOff, free.off_max_mm));
    assert!(tight.uneven_after_mm > 1e-6 && tight.uneven_after_mm <= tight.uneven_before_mm);
}

#[test]
fn work_that_is_stopped_leaves_the_mesh_alone() {
    struct Impatient;
    impl Watch for Impatient {
        fn stop(&self) -> bool {
            true
        }
    }
    let (boundary, surface) = skew();
    let outline = Outline::through(&boundary);
    let mesh = quads(&surface, &boundary, &outline);
    let done = planar(&mesh, &outline, &options(10.0), &mut Impatient);
    assert_eq!((done.end, done.mesh), (PlanarEnd::Stopped, mesh));
}
