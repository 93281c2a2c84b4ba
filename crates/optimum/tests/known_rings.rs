//! Boundaries with holes of surfaces whose development is known in closed form.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright::flatten::lay_flat;
use sheetwright::measure::area_space;
use sheetwright::sheet::Sheet;
use sheetwright::surface::{Connectivity, Surface};
use sheetwright_geometry::boundary::{PlaneChoice, supporting_plane};
use sheetwright_geometry::index::{SampleIndex, TriangleIndex, VertexIndex};
use sheetwright_geometry::math::{Point2, angle_between, sin, to_deg};
use sheetwright_geometry::watch::Unwatched;
use sheetwright_optimum::cost::Prices;
use sheetwright_optimum::triangulate::{TriangulateOptions, Triangulation, triangulate};
use sheetwright_shapes::developable::largest_distance_after_fitting;
use sheetwright_shapes::rings::{Pierced, Sampled, pierced};
use std::f64::consts::{PI, TAU};

struct Solved {
    sampled: Sampled,
    triangulation: Triangulation,
    surface: Surface,
    twist: f64,
}

fn solved(shape: &Pierced, m: usize) -> Solved {
    let sampled = shape.sampled(m);
    let boundary = &sampled.boundary;
    let plane = supporting_plane(boundary, PlaneChoice::Auto).unwrap();
    assert_eq!(plane.is_none(), shape.has_ends(), "{}", shape.name);
    let options = TriangulateOptions::default();
    let triangulation = triangulate(boundary, plane.as_ref(), &options, &mut Unwatched).unwrap();
    let connectivity =
        Connectivity::new(boundary.loops(), triangulation.triangles.clone()).unwrap();
    let surface = Surface::new(connectivity, boundary.positions());
    let prices = Prices::new(boundary, plane.as_ref(), options.price);
    let twists = triangulation.rungs.iter().map(|rung| {
        let [a, b] = rung.ends().map(SampleIndex::get);
        prices.planes(a, b).unwrap().twist
    });
    let twist = twists.sum();
    Solved { sampled, triangulation, surface, twist }
}

/// How far rungs are off their rulings.
struct OffRulings {
    /// The largest angle, radians.
    angle: f64,
    /// How far the far end of a rung misses the ruling through its near end, at the most, in
    /// spacings of the samples.
    miss: f64,
}

fn off_rulings(shape: &Pierced, solved: &Solved) -> OffRulings {
    let (mut angle, mut miss) = (0.0f64, 0.0f64);
    for rung in &solved.triangulation.rungs {
        let [a, b] = rung.ends();
        let way = solved.surface.position(b) - solved.surface.position(a);
        let [u, v] = solved.sampled.parameters[a.get()];
        let off = angle_between(way, shape.surface.ruling(u, v));
        let off = off.min(PI - off);
        angle = angle.max(off);
        miss = miss.max(way.length() * sin(off) / solved.sampled.spacing);
    }
    OffRulings { angle, miss }
}

/// The parameters of a sample, with its u in the turn that is nearest to another's.
fn parameters_near(shape: &Pierced, [u, v]: [f64; 2], near: f64) -> [f64; 2] {
    if shape.has_ends() { [u - TAU * ((u - near) / TAU).round(), v] } else { [u, v] }
}

/// The largest share by which the length of a side differs from that of its development.
fn length_error(shape: &Pierced, solved: &Solved) -> f64 {
    let sides = solved.surface.connectivity().sides();
    let error = |[a, b]: [SampleIndex; 2]| {
        let [u, v] = solved.sampled.parameters[a.get()];
        let [other_u, other_v] = parameters_near(shape, solved.sampled.parameters[b.get()], u);
        let flat = shape.surface.flat(u, v).distance(shape.surface.flat(other_u, other_v));
        (solved.surface.length(a, b) / flat - 1.0).abs()
    };
    sides.map(error).fold(0.0, f64::max)
}

/// The largest distance between the triangles, laid flat one beside the other from the first, and
/// the development, as a share of the size of the surface. Round a hole they are laid both ways.
fn flat_error(shape: &Pierced, solved: &Solved) -> f64 {
    let connectivity = solved.surface.connectivity();
    let (triangles, hinges) = (connectivity.triangles(), connectivity.hinges());
    let of_triangles = connectivity.hinges_of_triangles();
    let parameters = |s: SampleIndex, near: f64| {
        parameters_near(shape, solved.sampled.parameters[s.get()], near)
    };
    // For each triangle, the place and the parameters of its corners.
    type Laid = [(Point2, [f64; 2]); 3];
    let mut laid: Vec<Option<Laid>> = vec![None; triangles.len()];
    let length = |a, b| solved.surface.length(a, b);
    // To the left of the side from p to q.
    let beside = |(p, a): (Point2, SampleIndex), (q, b): (Point2, SampleIndex), c| {
        let (base, left, right) = (length(a, b), length(a, c), length(b, c));
        let along = (base * base + left * left - right * right) / (2.0 * base);
        let height = (left * left - along * along).max(0.0).sqrt();
        let way = (q - p) / base;
        p + way * along + way.perp() * height
    };
    let [a, b, c] = triangles[0];
    let (p, q) = (Point2::default(), Point2::new(length(a, b), 0.0));
    let near = solved.sampled.parameters[a.get()][0];
    let places = [(a, p), (b, q), (c, beside((p, a), (q, b), c))];
    laid[0] = Some(places.map(|(sample, at)| (at, parameters(sample, near))));
    let mut reached = vec![0];
    let mut next = 0;
    while next < reached.len() {
        let t = reached[next];
        next += 1;
        for &n in &of_triangles[t] {
            let [first, second] = hinges[n].triangles.map(TriangleIndex::get);
            let other = if first == t { second } else { first };
            if laid[other].is_some() {
                continue;
            }
            let here = laid[t].unwrap();
            let of = |s: SampleIndex| triangles[t].iter().position(|&c| c == s).map(|k| here[k]);
            let k = (0..3).find(|&k| of(triangles[other][k]).is_none()).unwrap();
            let [c, a, b] = [0, 1, 2].map(|step| triangles[other][(k + step) % 3]);
            let ((p, [u, _]), (q, _)) = (of(a).unwrap(), of(b).unwrap());
            let place = (beside((p, a), (q, b), c), parameters(c, u));
            laid[other] = Some(triangles[other].map(|s| of(s).unwrap_or(place)));
            reached.push(other);
        }
    }
    let (flat, development): (Vec<Point2>, Vec<Point2>) = laid
        .into_iter()
        .flat_map(Option::unwrap)
        .map(|(at, [u, v])| (at, shape.surface.flat(u, v)))
        .unzip();
    largest_distance_after_fitting(&flat, &development) / solved.sampled.boundary.size()
}

/// The largest distance between the pattern as it is made, cut open where it must be, and the
/// development, as a share of the size of the surface. Which turn a sample is developed in is found
/// by walking from triangle to triangle, not across cuts.
fn pattern_error(shape: &Pierced, solved: &Solved) -> f64 {
    let (sheet, flat) = lay_flat(&solved.surface, &[], &mut Unwatched).unwrap();
    assert_eq!(flat.overlap, None, "{}", shape.name);
    // A ring needs one cut; windows in what unrolls exactly close again.
    assert_eq!(sheet.seams().len(), usize::from(shape.has_ends()), "{}", shape.name);
    let mesh = sheet.mesh();
    let mut turns: Vec<Option<[f64; 2]>> = vec![None; flat.points.len()];
    let parameters = |v: VertexIndex, near: f64| {
        parameters_near(shape, solved.sampled.parameters[sheet.origin(v).get()], near)
    };
    let first = mesh.triangles()[0][0];
    turns[first.get()] = Some(parameters(first, 0.0));
    let mut reached = vec![0];
    let mut next = 0;
    while next < reached.len() {
        let t = reached[next];
        next += 1;
        let corners = mesh.triangles()[t];
        let [u, _] = corners.iter().find_map(|s| turns[s.get()]).unwrap();
        for s in corners {
            turns[s.get()] = turns[s.get()].or(Some(parameters(s, u)));
        }
        let sides = mesh.topology().edges_of(TriangleIndex::new(t));
        for other in sides.into_iter().flat_map(|n| mesh.edges()[n].triangles).flatten() {
            if !reached.contains(&other.get()) {
                reached.push(other.get());
            }
        }
    }
    let development: Vec<Point2> =
        turns.into_iter().map(|at| at.unwrap()).map(|[u, v]| shape.surface.flat(u, v)).collect();
    largest_distance_after_fitting(&flat.points, &development) / solved.sampled.boundary.size()
}

/// What is measured on one shape at one sampling.
struct Measured {
    off: OffRulings,
    twist: f64,
    area: f64,
    length: f64,
    flat: f64,
    pattern: f64,
}

fn measured(shape: &Pierced, m: usize) -> Measured {
    let solved = solved(shape, m);
    let measured = Measured {
        off: off_rulings(shape, &solved),
        twist: solved.twist,
        area: (area_space(&Sheet::whole(&solved.surface)) / shape.area() - 1.0).abs(),
        length: length_error(shape, &solved),
        flat: flat_error(shape, &solved),
        pattern: pattern_error(shape, &solved),
    };
    println!(
        "{} {m}: {:.2}° off, {:.2} spacings, W {:.4}, area {:.1e}, lengths {:.1e}, flat {:.1e}, \
         pattern {:.1e}, gap {:.2?}",
        shape.name,
        to_deg(measured.off.angle),
        measured.off.miss,
        measured.twist,
        measured.area,
        measured.length,
        measured.flat,
        measured.pattern,
        solved.triangulation.gap()
    );
    measured
}

/// At 400 samples in all, the surface is the developable one: rungs run along the rulings, to
/// within the samples that they may end at, and lengths, area and pattern are those of the
/// development to 0.05 %.
fn assert_is_developed(shape: &Pierced, at_400: &Measured) {
    let name = shape.name;
    assert!(at_400.off.miss < 2.0, "{name}: {} spacings", at_400.off.miss);
    assert!(at_400.length < 5e-4, "{name}: lengths {}", at_400.length);
    assert!(at_400.area < 5e-4, "{name}: area {}", at_400.area);
    assert!(at_400.flat < 5e-4, "{name}: flat {}", at_400.flat);
    assert!(at_400.pattern < 5e-4, "{name}: pattern {}", at_400.pattern);
    if !shape.has_straight_sides() {
        assert!(to_deg(at_400.off.angle) < 7.0, "{name}: {}°", to_deg(at_400.off.angle));
    }
}

/// Errors fall as they should: angles with the spacing; W as the number of rungs times the square
/// of their angles; areas and patterns with the square of the spacing, as chords of curves do.
#[test]
fn rings_and_patches_are_developed() {
    for shape in pierced().iter().filter(|shape| !shape.is_tube_with_windows()) {
        let [at_100, at_200, at_400] = [100, 200, 400].map(|m| measured(shape, m));
        assert_is_developed(shape, &at_400);
        assert!(at_100.twist > 1.7 * at_200.twist && at_200.twist > 1.7 * at_400.twist);
        if !shape.has_straight_sides() {
            assert!(at_100.off.angle > 3.0 * at_400.off.angle, "{}", shape.name);
        }
        assert!(at_100.area > 8.0 * at_400.area && at_100.flat > 8.0 * at_400.flat);
    }
}

/// No plane helps here, and no cut is known beforehand.
#[test]
fn tubes_with_windows_are_developed() {
    for shape in pierced().iter().filter(|shape| shape.is_tube_with_windows()) {
        assert_is_developed(shape, &measured(shape, 400));
    }
}
