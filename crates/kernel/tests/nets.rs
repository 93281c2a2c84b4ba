//! Nets of known bodies: exact, without overlap, in as few pieces as other programs make.

#![allow(clippy::unwrap_used, reason = "a test that can't go on fails")]

use sheetwright::check::{FindingKind, Severity, Verdict};
use sheetwright::design::{Design, DesignPanel, PanelMesh, PanelShape, Triangles};
use sheetwright::flatten::refold;
use sheetwright::index::VertexIndex;
use sheetwright::make::{Made, Part, make};
use sheetwright::math::{Point2, Point3, Vec3, cos, sin};
use sheetwright::mesh::{Cut, Mesh};
use sheetwright::nets::{NetOptions, coarseness, net};
use sheetwright::pattern::{LabelKind, PathKind, Role};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::low_poly::{animal, helmet, models};
use sheetwright_shapes::solids::{archimedean, closed_cone, icosphere, platonic, prism};
use std::collections::BTreeMap;
use std::f64::consts::PI;

fn triangles(mesh: &Mesh) -> Triangles {
    let (positions, triangles) = (mesh.positions().to_vec(), mesh.triangles().to_vec());
    Triangles { positions, triangles, left_out: 0 }
}

fn made_as(settings: PanelMesh) -> Made {
    let panel = DesignPanel::new("net", PanelShape::Mesh(settings), 0);
    make(&Design { panels: vec![panel], ..Design::default() }, &mut Unwatched).unwrap()
}

fn folded(mesh: &Mesh) -> Made {
    made_as(PanelMesh { facets: Some(true), ..PanelMesh::new(triangles(mesh)) })
}

/// What holds of every piece of a net: all lengths are true, it does not overlap, it folds up onto
/// the mesh, and it takes folds and nothing else.
fn check_piece(name: &str, part: &Part, size_mm: f64) {
    assert!(part.measures.length_error_max < 1e-9, "{name}: {}", part.measures.length_error_max);
    assert_eq!(part.flat.overlap, None, "{name}");
    let off_mm = refold(&part.sheet, &part.flat.points, &part.sheet.rungs()).unwrap();
    assert!(off_mm < 1e-9 * size_mm, "{name}: {off_mm} mm");
    assert!(
        part.checked.findings.iter().all(|f| f.severity() == Severity::Note),
        "{name}: {:?}",
        part.checked.findings
    );
    let folds = part.piece.paths.iter().filter(|path| path.role == Role::Score);
    assert!(folds.clone().all(|path| matches!(path.kind, PathKind::Fold { .. })), "{name}");
    let verdict = if folds.count() == 0 { Verdict::Bends } else { Verdict::BendsAndFolds };
    assert_eq!(part.checked.verdict, verdict, "{name}");
}

/// How far the cuts of a net are long together, mm, and whether its slits are their own image in a
/// plane through the middle of the mesh.
fn slits(mesh: &Mesh, normals: &[Vec3]) -> (f64, bool) {
    let net = net(mesh, &Cut::new(), &NetOptions::default(), &mut Unwatched).unwrap();
    assert_eq!(net.pieces, 1);
    let at = |v: VertexIndex| mesh.position(v);
    let sides: Vec<[VertexIndex; 2]> =
        net.slits().flat_map(|line| line.windows(2).map(|pair| [pair[0], pair[1]])).collect();
    let length = sides.iter().map(|[a, b]| at(*a).distance(at(*b))).sum();
    let positions = mesh.positions();
    let sum: Vec3 = positions.iter().map(|p| p.to_vec()).sum();
    let middle = Point3::from_vec(sum / positions.len() as f64);
    let is_mirror = |normal: &Vec3| {
        let image = |v: VertexIndex| {
            let place = at(v) + *normal * (-2.0 * (at(v) - middle).dot(*normal));
            positions.iter().position(|p| p.distance(place) < 1e-6).map(VertexIndex::new)
        };
        sides.iter().all(|&[a, b]| match (image(a), image(b)) {
            (Some(a), Some(b)) => sides.contains(&[a, b]) || sides.contains(&[b, a]),
            _ => false,
        })
    };
    (length, normals.iter().any(is_mirror))
}

#[test]
fn nets_of_symmetric_bodies_are_symmetric_and_others_are_as_short_as_can_be() {
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    let turned = |sides: u32| {
        let angle = move |n: u32| PI * f64::from(n) / f64::from(2 * sides);
        (0..2 * sides).map(move |n| Vec3::new(cos(angle(n)), sin(angle(n)), 0.0))
    };
    let solids = platonic().into_iter().chain(archimedean());
    let solids = solids.filter(|(name, _)| ["cube", "octahedron", "truncated cube"].contains(name));
    for (name, model) in solids.chain([("animal", animal())]) {
        assert!(slits(&model.mesh(), &axes).1, "{name}");
    }
    for sides in [4, 7, 12, 24, 64] {
        let normals: Vec<Vec3> = axes.into_iter().chain(turned(sides)).collect();
        assert!(slits(&prism(sides as usize, 80.0).mesh(), &normals).1, "prism {sides}");
    }
    for sides in [5, 13, 25] {
        let normals: Vec<Vec3> = turned(sides).collect();
        assert!(slits(&closed_cone(sides as usize, 80.0).mesh(), &normals).1, "cone {sides}");
    }
    // A symmetric net of a cone with an even number of sides has two long seams in place of one;
    // the opening of the helmet lies to one side of its middle.
    let cuts = [closed_cone(64, 80.0), helmet()].map(|model| slits(&model.mesh(), &axes).0);
    assert!((cuts[0] - 403.0).abs() < 1.0 && (cuts[1] - 4469.0).abs() < 1.0, "{cuts:?}");
}

#[test]
fn each_body_of_a_mesh_is_folded_or_bent_by_itself() {
    // 24 solids of 92 facets, 2,208 together; a fine ball samples a smooth one.
    let snub = archimedean().into_iter().find(|(name, _)| *name == "snub dodecahedron");
    let solid = snub.unwrap().1;
    let ball = icosphere(3);
    let (mut positions, mut list) = (Vec::new(), Vec::new());
    for n in 0..25 {
        let mesh = if n == 7 { ball.mesh() } else { solid.mesh() };
        let first = positions.len();
        let beside = Vec3::new(200.0 * f64::from(n), 0.0, 0.0);
        positions.extend(mesh.positions().iter().map(|&p| p + beside));
        let corner = |v: VertexIndex| VertexIndex::new(first + v.get());
        list.extend(mesh.triangles().iter().map(|corners| corners.map(corner)));
    }
    let whole = Mesh::new(positions, list).unwrap();
    assert!(!coarseness(&whole).has_few());
    let made = made_as(PanelMesh::new(triangles(&whole)));
    assert_eq!(made.parts.len(), 25);
    let folded = |part: &&Part| part.given().unwrap().is_net;
    let (nets, smooth): (Vec<&Part>, Vec<&Part>) = made.parts.iter().partition(folded);
    let [smooth] = &smooth[..] else { panic!("{} smooth parts", smooth.len()) };
    assert!(
        smooth.measures.length_error_max > 0.01 && smooth.sheet.mesh().triangles().len() == 1280
    );
    for part in nets {
        check_piece(&part.name, part, 200.0);
        let meant = part.checked.findings.iter().find_map(|finding| match finding.kind {
            FindingKind::FacetsMeant { facets, .. } => Some(facets),
            _ => None,
        });
        assert_eq!(meant, Some(92), "{}", part.name);
    }
    // Names are those of one panel, in order; each body has seams of its own.
    let names = made.parts.iter().enumerate();
    assert!(names.clone().all(|(n, part)| part.name == format!("net-{}", n + 1)));
    for part in &made.parts {
        let marks = marks(std::slice::from_ref(part));
        assert!(marks.values().all(|&count| count == 2), "{}: {marks:?}", part.name);
    }
}

/// How often each mark stands on the pieces.
fn marks(parts: &[Part]) -> BTreeMap<String, usize> {
    let mut marks = BTreeMap::new();
    for label in parts.iter().flat_map(|part| &part.piece.labels) {
        if label.kind == LabelKind::Mark {
            *marks.entry(label.text.clone()).or_insert(0) += 1;
        }
    }
    marks
}

#[test]
fn bodies_of_facets_fold_up_from_one_piece_without_stretching() {
    // Blender's Export Paper Model makes 20 pieces of the animal, 2 of the helmet and one of each
    // other body (`bench/peers/nets`).
    for (name, model) in models() {
        let mesh = model.mesh();
        let size_mm = mesh.positions().iter().map(|p| p.to_vec().length()).fold(0.0, f64::max);
        let made = folded(&mesh);
        assert_eq!(made.parts.len(), 1, "{name}");
        made.parts.iter().for_each(|part| check_piece(&name, part, size_mm));
        assert!(
            marks(&made.parts).values().all(|&count| count == 2),
            "{name}: every mark has a mate"
        );
    }
}

#[test]
fn only_vertices_that_are_not_flat_are_cut_and_faces_stay_whole() {
    // A cube each of whose faces is four by four squares, each square two triangles.
    let mut positions: Vec<Point3> = Vec::new();
    let mut list = Vec::new();
    let mut number = |p: Point3| -> VertexIndex {
        let known = positions.iter().position(|q| q.distance(p) < 1e-9);
        VertexIndex::new(known.unwrap_or_else(|| {
            positions.push(p);
            positions.len() - 1
        }))
    };
    for axis in 0..3 {
        for end in [0.0, 40.0] {
            for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
                let corner = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(di, dj)| {
                    let mut at = [end; 3];
                    at[(axis + 1) % 3] = 10.0 * f64::from(i + di);
                    at[(axis + 2) % 3] = 10.0 * f64::from(j + dj);
                    number(Point3::new(at[0], at[1], at[2]))
                });
                let [a, b, c, d] = corner;
                list.extend(if end > 0.0 {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, c, b], [a, d, c]]
                });
            }
        }
    }
    let cube = Mesh::new(positions, list).unwrap();
    let made = folded(&cube);
    let [part] = &made.parts[..] else { panic!("{} pieces", made.parts.len()) };
    check_piece("cube", part, 70.0);
    let folds = part.piece.paths.iter().filter(|path| path.role == Role::Score);
    assert!(folds.clone().all(|path| path.kind == PathKind::MOUNTAIN));
    let lengths: Vec<f64> = folds.map(|path| path.points[0].distance(path.points[1])).collect();
    assert!(lengths.len() == 5 && lengths.iter().all(|mm| (mm - 40.0).abs() < 1e-9));
    // Seven edges are cut, each a seam of its own.
    assert_eq!(part.sheet.seams().len(), 7);
    assert!(part.sheet.seams().iter().all(|seam| (seam.length_mm - 40.0).abs() < 1e-9));
}

/// A mesh with its numbers as a program writes them.
fn written(mesh: &Mesh, number: impl Fn(f64) -> f64) -> Mesh {
    let rounded = |p: &Point3| Point3::new(number(p.x), number(p.y), number(p.z));
    let positions = mesh.positions().iter().map(rounded).collect();
    Mesh::new(positions, mesh.triangles().to_vec()).unwrap()
}

/// A mesh turned, so that no plane of it is square to an axis, and made so large.
fn turned(mesh: &Mesh, size: f64) -> Mesh {
    let [(s, c), (v, u)] = [0.7, 0.4].map(|angle| (sin(angle), cos(angle)));
    let turn = |p: &Point3| {
        let (x, y, z) = (c * p.x - s * p.y, s * p.x + c * p.y, p.z);
        Point3::new(size * x, size * (u * y - v * z), size * (v * y + u * z))
    };
    let positions = mesh.positions().iter().map(turn).collect();
    Mesh::new(positions, mesh.triangles().to_vec()).unwrap()
}

#[test]
fn faces_that_are_flat_but_for_the_rounding_of_a_file_stay_whole() {
    let facets = |mesh: &Mesh| coarseness(mesh).facets;
    for (name, model) in models().into_iter().filter(|(_, model)| model.faces.len() <= 100) {
        // As large as metres are.
        let exact = turned(&model.mesh(), 0.02);
        assert_eq!(facets(&exact), model.faces.len(), "{name}");
        for step in [1e-3, 1e-4, 1e-5, 1e-6] {
            let rounded = written(&exact, |x| (x / step).round() * step);
            assert_eq!(facets(&rounded), model.faces.len(), "{name} {step}");
            // In another unit and elsewhere, the numbers are no longer short.
            let inches = written(&rounded, |x| 25.4 * x + 1234.567);
            assert_eq!(facets(&inches), model.faces.len(), "{name} {step} in inches");
            let [part] = &folded(&rounded).parts[..] else { panic!("{name} {step}") };
            check_piece(&name, part, 2.0);
            let folds = part.piece.paths.iter().filter(|path| path.role == Role::Score);
            assert!(folds.count() < model.faces.len(), "{name} {step}");
        }
        let floats = written(&exact, |x| f64::from(x as f32));
        assert_eq!(facets(&floats), model.faces.len(), "{name} as floats");
    }
}

#[test]
fn what_turns_by_more_than_rounding_is_no_flat_face() {
    // A roof over a square of 1 m, by its rise: one face as soon as rounding explains it.
    let roof = |rise: f64, step: f64| {
        let at = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let corners = at.map(|[x, y, z]| Point3::new(x, y, z));
        let positions = [&corners[..], &[Point3::new(0.5, 0.5, rise)]].concat();
        let side = |n: usize| [n, (n + 1) % 4, 4].map(VertexIndex::new);
        let mesh = turned(&Mesh::new(positions, (0..4).map(side).collect()).unwrap(), 1.0);
        coarseness(&written(&mesh, |x| if step > 0.0 { (x / step).round() * step } else { x }))
            .facets
    };
    assert_eq!([0.0, 1e-6, 1e-4, 0.02].map(|rise| roof(rise, 0.0)), [1, 1, 4, 4]);
    assert_eq!([0.0, 1e-4, 0.02].map(|rise| roof(rise, 1e-3)), [1, 1, 4]);
    // Whole centimetres are chosen, not rounded.
    assert_eq!(roof(0.02, 0.01), 4);
}

#[test]
fn a_ridge_and_a_chamfer_of_one_step_of_the_file_are_folds() {
    // Strips of 1 m in whole millimetres, by where their lines run across.
    let strips = |lines: &[[f64; 2]]| {
        let ends = |&[x, z]: &[f64; 2]| [Point3::new(x, 0.0, z), Point3::new(x, 301.0, z)];
        let strip = |n: usize| {
            let [a, b, c, d] = [2 * n, 2 * n + 1, 2 * n + 2, 2 * n + 3].map(VertexIndex::new);
            [[a, c, b], [b, c, d]]
        };
        let triangles = (0..lines.len() - 1).flat_map(strip).collect();
        coarseness(&Mesh::new(lines.iter().flat_map(ends).collect(), triangles).unwrap()).facets
    };
    assert_eq!(strips(&[[0.0, 0.0], [498.0, 0.0], [500.0, 1.0], [502.0, 0.0], [1000.0, 0.0]]), 4);
    assert_eq!(strips(&[[0.0, 0.0], [999.0, 0.0], [1000.0, 1.0], [1000.0, 400.0]]), 3);
    assert_eq!(strips(&[[0.0, 0.0], [499.0, 0.0], [1000.0, 0.0]]), 1);
}

#[test]
fn a_valley_is_told_from_a_mountain() {
    // A gutter: three strips, the middle one below, seen from above.
    let at = |x: f64, z: f64| [Point3::new(x, 0.0, z), Point3::new(x, 90.0, z)];
    let rails = [at(0.0, 0.0), at(20.0, -15.0), at(40.0, -15.0), at(60.0, 0.0), at(80.0, -15.0)];
    let positions = rails.concat();
    let strip = |n: usize| {
        let [a, b, c, d] = [2 * n, 2 * n + 1, 2 * n + 2, 2 * n + 3].map(VertexIndex::new);
        [[a, c, b], [b, c, d]]
    };
    let mesh = Mesh::new(positions, (0..4).flat_map(strip).collect()).unwrap();
    let made = folded(&mesh);
    let [part] = &made.parts[..] else { panic!("{} pieces", made.parts.len()) };
    let count = |kind| part.piece.paths.iter().filter(|path| path.kind == kind).count();
    assert_eq!((count(PathKind::MOUNTAIN), count(PathKind::VALLEY)), (1, 2));
    let angles = part.piece.labels.iter().filter(|label| label.kind == LabelKind::Angle);
    let mut angles: Vec<&str> = angles.map(|label| label.text.as_str()).collect();
    angles.sort_unstable();
    assert_eq!(angles, ["37°", "37°", "74°"]);
}

#[test]
fn no_piece_is_larger_than_it_may_be_and_every_edge_that_meets_another_has_its_mark() {
    for (name, model) in [("animal", animal()), ("helmet", helmet()), ("prism", prism(64, 80.0))] {
        let within = [150.0, 110.0];
        let settings = PanelMesh {
            facets: Some(true),
            pieces_within_mm: Some(within),
            ..PanelMesh::new(triangles(&model.mesh()))
        };
        let made = made_as(settings);
        assert!(made.parts.len() > 1, "{name}");
        for part in &made.parts {
            check_piece(name, part, 250.0);
            let size = part.piece.size;
            assert!(size.x <= within[0] + 1e-6 && size.y <= within[1] + 1e-6, "{name}: {size}");
        }
        let marks = marks(&made.parts);
        assert!(marks.values().all(|&count| count == 2), "{name}");
        // Marks of slits and of joints together are those of all cut lines.
        let cuts: usize = made
            .parts
            .iter()
            .map(|part| 2 * part.sheet.seams().len() + part.given().unwrap().joints.len())
            .sum();
        assert_eq!(cuts, 2 * marks.len(), "{name}");
    }
}

/// Where a point of the border of a pattern lies in space.
fn in_space(part: &Part, at: Point2) -> Point3 {
    let mesh = part.sheet.mesh();
    let steps = part.edges.iter().flat_map(|edge| edge.run.windows(2));
    let on = steps
        .map(|step| [step[0], step[1]])
        .find(|step| at.distance_to_segment(step.map(|v| part.flat.points[v])) < 1e-6);
    let step = on.unwrap();
    let [a, b] = step.map(|v| part.flat.points[v]);
    let [from, to] = step.map(|v| mesh.position(VertexIndex::new(v)));
    from.lerp(to, at.distance(a) / b.distance(a))
}

#[test]
fn both_marks_of_a_joint_stand_on_one_spot_wherever_its_edge_has_points() {
    // A box with a point on an edge of its top, a third along.
    let positions = [
        [0.0, 0.0, 0.0],
        [100.0, 0.0, 0.0],
        [100.0, 60.0, 0.0],
        [0.0, 60.0, 0.0],
        [0.0, 0.0, 40.0],
        [100.0, 0.0, 40.0],
        [100.0, 60.0, 40.0],
        [0.0, 60.0, 40.0],
        [30.0, 0.0, 40.0],
    ];
    let positions: Vec<Point3> = positions.map(|[x, y, z]| Point3::new(x, y, z)).to_vec();
    let corners = [
        [3, 2, 1],
        [3, 1, 0],
        [8, 5, 6],
        [8, 6, 7],
        [8, 7, 4],
        [0, 1, 5],
        [0, 5, 8],
        [0, 8, 4],
        [1, 2, 6],
        [1, 6, 5],
        [2, 3, 7],
        [2, 7, 6],
        [3, 0, 4],
        [3, 4, 7],
    ];
    let corners = corners.map(|corners| corners.map(VertexIndex::new)).to_vec();
    let mesh = Mesh::new(positions, corners).unwrap();
    let made = made_as(PanelMesh {
        facets: Some(true),
        pieces_within_mm: Some([110.0, 70.0]),
        ..PanelMesh::new(triangles(&mesh))
    });
    let mut spots: BTreeMap<String, Vec<Point3>> = BTreeMap::new();
    for part in &made.parts {
        let piece = &part.piece;
        let ticks = piece.paths.iter().filter(|path| path.kind == PathKind::SeamTick);
        let marks = piece.labels.iter().filter(|label| label.kind == LabelKind::Mark);
        for (tick, label) in ticks.zip(marks) {
            let spot = in_space(part, tick.points[0]);
            spots.entry(label.text.clone()).or_default().push(spot);
        }
    }
    let middle = Point3::new(50.0, 0.0, 40.0);
    let is_at = |list: &Vec<Point3>| list[0].distance(middle) < 1e-9;
    assert!(spots.values().any(is_at), "no cut along the edge with the point: {spots:?}");
    for (mark, list) in spots {
        assert!(list.len() == 2 && list[0].distance(list[1]) < 1e-9, "{mark}: {list:?}");
    }
}

#[test]
fn facets_are_folded_unasked_where_they_are_coarse_and_the_mesh_would_not_bend() {
    let as_given = |mesh: &Mesh| made_as(PanelMesh::new(triangles(mesh)));
    let is_meant = |made: &Made| {
        let findings = made.parts.iter().flat_map(|part| &part.checked.findings);
        let is_it = |kind: &FindingKind| matches!(kind, FindingKind::FacetsMeant { .. });
        findings.filter(|finding| is_it(&finding.kind)).count()
    };
    // Told once for all pieces.
    for (name, model) in [("animal", animal()), ("ball of 80", icosphere(1))] {
        let made = as_given(&model.mesh());
        assert_eq!(is_meant(&made), 1, "{name}");
        assert!(made.parts.iter().all(|part| part.measures.length_error_max < 1e-9), "{name}");
    }
    // A fine ball samples a smooth one; a cone lies flat as a surface.
    for (name, model) in [("ball of 1280", icosphere(3)), ("cone", closed_cone(64, 80.0))] {
        assert_eq!(is_meant(&as_given(&model.mesh())), 0, "{name}");
    }
    // Where it may be meant, a note says so.
    let made = as_given(&helmet().mesh());
    let few = FindingKind::FacetsFew { facets: 408 };
    assert!(
        made.parts[0].checked.findings.iter().any(|finding| finding.kind == few),
        "{:?}",
        made.parts[0].checked.findings
    );
    // Asked not to, none is folded.
    let off = PanelMesh { facets: Some(false), ..PanelMesh::new(triangles(&animal().mesh())) };
    let made = made_as(off);
    assert_eq!(is_meant(&made), 0);
    assert!(made.parts.iter().any(|part| part.measures.length_error_max > 0.01));
}
