//! The square-to-round duct against what is known of it, and pipes that are cut by planes.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright::check::Verdict;
use sheetwright::curve::Curve;
use sheetwright::design::{Design, Dimensions, PanelMethod, PanelShape};
use sheetwright::edge::{Edge, EdgeSource};
use sheetwright::make::{Made, Part, make};
use sheetwright::math::{Point3, cos, sin};
use sheetwright::template::{Value, template};
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
            let made = make(&design, &mut Unwatched).unwrap().parts.remove(0);
            assert!(made.found().unwrap().triangulation.proven_optimal);
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

/// The points of the curve of a name.
fn points(design: &Design, name: &str) -> Vec<Point3> {
    let curve = design.curves.iter().find(|curve| curve.name == name).unwrap();
    curve.points.iter().map(|point| point.at).collect()
}

#[test]
fn the_pieces_of_an_elbow_meet_and_unroll_to_their_formula() {
    let design = template("elbow").unwrap().defaults().design().unwrap();
    // Of its defaults: a pipe of 200 mm, a bend of 300 mm by 90° in 5 segments.
    let (r, bend, half) = (100.0, 300.0, std::f64::consts::FRAC_PI_2 / 8.0);
    for n in 1..5 {
        let between = format!("cut-{n}b");
        for panel in &design.panels[n - 1..=n] {
            let PanelShape::Rails(rails) = &panel.shape else { panic!("{}", panel.name) };
            assert!(rails.iter().any(|rail| rail.name == between), "{}: {between}", panel.name);
        }
    }
    let made = make(&design, &mut Unwatched).unwrap();
    for panel in &made.parts {
        assert_eq!(panel.checked.verdict, Verdict::Bends);
        assert!(panel.checked.findings.is_empty(), "{:?}", panel.checked.findings);
    }
    let segment = &made.parts[2];
    let tan = sin(half) / cos(half);
    // Across the throat, where the seam is, across the heel, and round the pipe.
    let (flat, m) = (&segment.flat.points, segment.flat.points.len());
    let (throat, heel) = (flat[0].distance(flat[m - 1]), flat[m / 4].distance(flat[3 * m / 4]));
    let round = flat[0].distance(flat[m / 2 - 1]);
    for (ours, exact) in [
        (throat, 2.0 * (bend - r) * tan),
        (heel, 2.0 * (bend + r) * tan),
        (round, std::f64::consts::TAU * r),
    ] {
        println!("{ours} {exact}");
        assert!((ours / exact - 1.0).abs() < 5e-4, "{ours} instead of {exact}");
    }
}

#[test]
fn the_pieces_of_a_y_branch_meet() {
    for (trunk, branch, angle) in [(250.0, 180.0, 40.0), (200.0, 200.0, 60.0), (200.0, 215.0, 45.0)]
    {
        let mut values = template("y-branch").unwrap().defaults();
        for (name, value) in [("trunk", trunk), ("branch", branch), ("angle", angle)] {
            values.set(name, Value::Number(value)).unwrap();
        }
        let design = values.design().unwrap();
        let cut = points(&design, "right-cut");
        let (on_trunk, between): (Vec<Point3>, Vec<Point3>) =
            cut.into_iter().partition(|p| p.x > 1e-9);
        assert!(on_trunk.len() > 10 && between.len() > 10);
        // Beyond the plane between the branches the cut runs on the trunk, and on its upper edge.
        for p in on_trunk {
            let away = (p.x * p.x + p.y * p.y).sqrt();
            assert!((away - trunk / 2.0).abs() < 1e-9, "{p:?}: {away}");
        }
        assert!(between.iter().all(|p| p.x.abs() < 1e-9));
        // The upper edge of the trunk is that same cut on one side and its mirror image on the
        // other.
        let source = design.curves.iter().find(|curve| curve.name == "right-cut").unwrap();
        let curve = Curve::new(source.kind.unwrap(), &source.points, false).unwrap();
        let fine: Vec<Point3> = (0..=20_000)
            .map(|n| curve.position(curve.spans().len() as f64 * n as f64 / 2e4))
            .collect();
        for p in points(&design, "trunk-top") {
            let mirrored = Point3::new(p.x.abs(), p.y, p.z);
            let off = fine.iter().map(|q| q.distance(mirrored)).fold(f64::INFINITY, f64::min);
            assert!(off < 0.05, "{p:?}: {off}");
        }
        let made = make(&design, &mut Unwatched).unwrap();
        for panel in &made.parts {
            println!("{} {}", panel.name, sheetwright::math::to_deg(panel.measures.warp_max));
            assert_eq!(panel.checked.verdict, Verdict::Bends, "{}", panel.name);
        }
    }
}

/// The edges of a made template that lie on a curve of this name, by their parts.
fn edges<'a>(made: &'a Made, name: &'a str) -> impl Iterator<Item = &'a Edge> + 'a {
    let all = made.parts.iter().flat_map(|part| &part.edges);
    all.filter(move |edge| edge.name == name)
}

#[test]
fn rings_of_an_elbow_are_joined_wherever_their_seams_are() {
    for seam in ["throat", "staggered"] {
        let mut values = template("elbow").unwrap().defaults();
        values.set("seam", Value::Choice(seam.to_owned())).unwrap();
        let made = make(&values.design().unwrap(), &mut Unwatched).unwrap();
        let mut joined = 0;
        for (part, edge) in made.parts.iter().flat_map(|p| p.edges.iter().map(move |e| (p, e))) {
            let is_mouth = edge.name == "cut-1a" || edge.name == "cut-5b";
            let is_seam = edge.name == "start" || edge.name == "end";
            let [mate] = edge.mates[..] else {
                assert!(is_mouth && edge.mates.is_empty(), "{} {}", part.name, edge.name);
                continue;
            };
            joined += usize::from(!is_seam);
            assert!(edge.difference_mm.unwrap() < 0.01, "{}: {:?}", edge.name, edge.difference_mm);
            assert!((edge.shared_mm[0][0] - edge.length_flat_mm).abs() < 0.01, "{}", edge.name);
            assert_eq!(made.parts[mate.part].name == part.name, is_seam);
        }
        assert_eq!(joined, 8, "{seam}");
    }
}

#[test]
fn the_edges_of_a_y_branch_are_joined_along_what_they_share() {
    let design = template("y-branch").unwrap().defaults().design().unwrap();
    let made = make(&design, &mut Unwatched).unwrap();
    let edge = |name| edges(&made, name).next().unwrap();
    let (trunk, right, left) = (edge("trunk-top"), edge("right-cut"), edge("left-cut"));
    for name in ["trunk-foot", "right-end", "left-end"] {
        assert!(edge(name).mates.is_empty(), "{name}");
    }
    for edge in [trunk, right, left] {
        assert_eq!(edge.mates.len(), 2, "{}", edge.name);
        assert!(edge.difference_mm.unwrap() < 0.1, "{}: {:?}", edge.name, edge.difference_mm);
        // Both stretches together are the whole of it.
        let common: f64 = edge.shared_mm.iter().map(|shared| shared[0]).sum();
        assert!((common - edge.length_flat_mm).abs() < 0.1, "{}: {common}", edge.name);
    }
}

/// A template with other values, whose drawn face is this one of a sheet of 3 mm.
fn thick(name: &str, values: &[(&str, f64)], dimensions: Dimensions) -> (Design, Made) {
    let mut chosen = template(name).unwrap().defaults();
    values.iter().for_each(|&(name, value)| chosen.set(name, Value::Number(value)).unwrap());
    let mut design = chosen.design().unwrap();
    (design.dimensions, design.thickness_mm) = (Some(dimensions), Some(3.0));
    let made = make(&design, &mut Unwatched).unwrap();
    (design, made)
}

/// Where an edge of a part lies in space.
fn run(part: &Part, edge: &Edge) -> Vec<Point3> {
    edge.run.iter().map(|&n| part.sheet.mesh().positions()[n]).collect()
}

/// How far a point lies from a line of points.
fn off_line(p: Point3, line: &[Point3]) -> f64 {
    let off = |step: &[Point3]| {
        let way = step[1] - step[0];
        let t = ((p - step[0]).dot(way) / way.dot(way)).clamp(0.0, 1.0);
        p.distance(step[0] + way * t)
    };
    line.windows(2).map(off).fold(f64::INFINITY, f64::min)
}

/// The neutral surfaces of joined parts meet, and mouths stay in their planes.
#[test]
fn thick_ducts_stand_on_their_mouths_and_meet_where_they_are_joined() {
    let cases: [(&str, &[(&str, f64)]); 6] = [
        ("elbow", &[]),
        ("elbow", &[("segments", 3.0)]),
        ("y-branch", &[]),
        ("y-branch", &[("trunk", 200.0), ("branch", 200.0), ("angle", 60.0)]),
        ("reducer", &[]),
        ("square-to-round", &[("offset-x", 80.0), ("tilt", 30.0)]),
    ];
    for (name, values) in cases {
        for dimensions in [Dimensions::Inside, Dimensions::Outside] {
            let (design, made) = thick(name, values, dimensions);
            let (mut off_mouth, mut apart) = (0.0_f64, 0.0_f64);
            for part in &made.parts {
                for edge in
                    part.edges.iter().filter(|edge| matches!(edge.source, EdgeSource::Curve(_)))
                {
                    let line = run(part, edge);
                    if edge.mates.is_empty() {
                        let drawn = points(&design, &edge.name);
                        let third = drawn.len() / 3;
                        let [a, b, c] = [0, third, 2 * third].map(|n| drawn[n]);
                        let normal = (b - a).cross(c - a);
                        let off = |p: &Point3| ((*p - a).dot(normal) / normal.length()).abs();
                        off_mouth = line.iter().map(off).fold(off_mouth, f64::max);
                    }
                    let mates: Vec<Vec<Point3>> = edge
                        .mates
                        .iter()
                        .map(|mate| {
                            let part = &made.parts[mate.part];
                            run(part, &part.edges[mate.edge])
                        })
                        .collect();
                    for p in line.iter().filter(|_| !mates.is_empty()) {
                        let off = mates.iter().map(|mate| off_line(*p, mate));
                        apart = apart.max(off.fold(f64::INFINITY, f64::min));
                    }
                }
            }
            println!("{name} {dimensions:?}: {off_mouth:.1e} mm off, {apart:.1e} mm apart");
            assert!(off_mouth < 1e-9 && apart < 0.06, "{name}: {off_mouth} {apart}");
            for part in &made.parts {
                assert!(part.flat.overlap.is_none(), "{name} {}", part.name);
            }
        }
    }
}

/// The square mouth of a neutral surface is a square: no sample of a side lies behind a corner.
#[test]
fn a_thick_square_mouth_is_a_larger_square() {
    for (dimensions, way) in [(Dimensions::Inside, 1.0), (Dimensions::Outside, -1.0)] {
        let (_, made) = thick("square-to-round", &[], dimensions);
        let part = &made.parts[0];
        let mouth = edges(&made, "square").next().unwrap();
        // Half the thickness across a side that leans in by 50 mm on 350 mm of height.
        let half = 200.0 + way * 1.5 * (350.0_f64 * 350.0 + 50.0 * 50.0).sqrt() / 350.0;
        let line = run(part, mouth);
        for p in &line {
            let off = (p.x.abs().max(p.y.abs()) - half).abs().max(p.z.abs());
            assert!(off < 1e-4, "{dimensions:?} {p:?} {half}");
        }
        let length: f64 = line.windows(2).map(|step| step[0].distance(step[1])).sum();
        assert!((length - 8.0 * half).abs() < 1e-3, "{length} {}", 8.0 * half);
        assert!((mouth.length_flat_mm - length).abs() < 1e-6);
    }
}
