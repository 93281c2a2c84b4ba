//! Offsets and folds against the curves and surfaces that they come from.
#![allow(clippy::unwrap_used)] // Whatever fails here is a failed test.

use serde_json::Value;
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{CurveUse, Design, DesignCurve, DesignPanel, PanelShape};
use sheetwright::make::{Made, make};
use sheetwright::math::{Point2, Point3, Vec3, cos, from_deg, sin, unit, unit2};
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    Format, InputFormat, MeshFormat, OffsetOptions, OutputOptions, ReadOptions, output_files,
    read_bytes, read_input, write_fold,
};
use std::f64::consts::PI;
use std::path::Path;

fn read(file: &str) -> Made {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file);
    make(&read_input(&path, &ReadOptions::default()).unwrap(), &mut Unwatched).unwrap()
}

/// Half a frustum of radii 200 and 300 mm and 100 mm high.
fn half_frustum() -> Made {
    let arc = |name: &str, radius: f64, z: f64| {
        let point = |n: u32| {
            let angle = PI * f64::from(n) / 400.0;
            CurvePoint::smooth(Point3::new(radius * cos(angle), radius * sin(angle), z))
        };
        let points = (0..=400).map(point).collect();
        DesignCurve { name: name.into(), kind: Some(CurveKind::Spline), closed: false, points }
    };
    let rail = |name: &str| CurveUse { name: name.into(), reversed: false };
    let shape = PanelShape::Rails([rail("top"), rail("foot")]);
    let curves = vec![arc("top", 200.0, 100.0), arc("foot", 300.0, 0.0)];
    let panels = vec![DesignPanel::new("half", shape, 400)];
    let design = Design { name: "frustum".into(), curves, panels, ..Design::default() };
    make(&design, &mut Unwatched).unwrap()
}

fn offsets(made: &Made, options: OffsetOptions) -> Vec<Vec<String>> {
    let options = OutputOptions { offsets: options, ..OutputOptions::default() };
    let outputs = output_files(made, &[Format::Offsets], options).unwrap();
    assert_eq!(outputs.files[0].name, "offsets.csv");
    let text = std::str::from_utf8(&outputs.files[0].bytes).unwrap();
    text.lines().map(|row| row.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn offsets_lie_on_the_analytic_development() {
    let made = half_frustum();
    let rows = offsets(&made, OffsetOptions { pitch_mm: Some(25.0), feet: false });
    // A sector between two circles about the apex, at 100 √2 times 2 and 3 from it.
    let slant = 100.0 * 2.0f64.sqrt();
    let (inner, outer) = (2.0 * slant, 3.0 * slant);
    let half_angle = 0.5 * PI * 300.0 / outer;
    let (width, apex) = (2.0 * outer * sin(half_angle), -inner * cos(half_angle));
    let upper = |x: f64| apex + (outer * outer - (x - 0.5 * width) * (x - 0.5 * width)).sqrt();
    let lower = |x: f64| {
        let off = (x - 0.5 * width).abs();
        let on_end = apex + off * cos(half_angle) / sin(half_angle);
        let on_arc = apex + (inner * inner - off * off).max(0.0).sqrt();
        if off <= inner * sin(half_angle) { on_arc } else { on_end }
    };
    let height = outer + apex;
    // The pattern may lie either way up; between the feet of the inner arc it has one stretch.
    let numbers: Vec<Vec<f64>> = rows[1..]
        .iter()
        .map(|row| row[1..4].iter().map(|n| n.parse().unwrap()).collect())
        .collect();
    assert!(numbers.len() > 30 && (numbers.last().unwrap()[0] - width).abs() < 0.05);
    let off = |turned: bool| {
        let off_at = |row: &Vec<f64>| {
            let [x, low, high] = row[..] else { panic!("{row:?}") };
            let (low, high) = if turned { (height - high, height - low) } else { (low, high) };
            (low - lower(x)).abs().max((high - upper(x)).abs())
        };
        // At its ends the piece is a corner, where a hundredth along x is as much across.
        numbers[1..numbers.len() - 1].iter().map(off_at).fold(0.0, f64::max)
    };
    let worst = off(false).min(off(true));
    assert!(worst < 0.02, "{worst} mm off the analytic curve");

    let feet = offsets(&made, OffsetOptions { pitch_mm: None, feet: true });
    assert_eq!(feet[0].join(","), "part,station_ft_in_8,lower_ft_in_8,upper_ft_in_8");
    assert_eq!(feet[2][1], "0-2-0", "every two inches");
}

fn frames(made: &Made) -> Vec<Value> {
    let mut file: Value = serde_json::from_slice(&write_fold(made)).unwrap();
    let others =
        file.as_object_mut().unwrap().remove("file_frames").unwrap_or(Value::Array(vec![]));
    std::iter::once(file).chain(others.as_array().unwrap().iter().cloned()).collect()
}

/// The places in space of the corners of a frame, folded up side by side from its first face.
fn folded(frame: &Value) -> Vec<Option<Point3>> {
    let list = |key: &str| frame[key].as_array().unwrap();
    let number = |v: &Value| v.as_u64().unwrap() as usize;
    let flat: Vec<Point2> = list("vertices_coords")
        .iter()
        .map(|p| Point2::new(p[0].as_f64().unwrap(), p[1].as_f64().unwrap()))
        .collect();
    let faces: Vec<[usize; 3]> =
        list("faces_vertices").iter().map(|f| [0, 1, 2].map(|n| number(&f[n]))).collect();
    let mut folds = std::collections::BTreeMap::new();
    for ((edge, angle), mark) in
        list("edges_vertices").iter().zip(list("edges_foldAngle")).zip(list("edges_assignment"))
    {
        let (a, b, deg) = (number(&edge[0]), number(&edge[1]), angle.as_f64().unwrap());
        let is_marked = match mark.as_str().unwrap() {
            "M" => deg < 0.0,
            "V" => deg > 0.0,
            "F" | "B" => deg == 0.0,
            _ => false,
        };
        assert!(is_marked, "{mark}: {deg}");
        folds.insert([a.min(b), a.max(b)], deg);
    }
    let mut space: Vec<Option<Point3>> = vec![None; flat.len()];
    for &v in &faces[0] {
        space[v] = Some(Point3::new(flat[v].x, flat[v].y, 0.0));
    }
    let mut done = vec![false; faces.len()];
    done[0] = true;
    let mut waiting = vec![0];
    while let Some(face) = waiting.pop() {
        for n in 0..3 {
            let [a, b, c] = [n, (n + 1) % 3, (n + 2) % 3].map(|k| faces[face][k]);
            let beyond = (0..faces.len()).find(|&other| {
                let run = faces[other];
                !done[other] && (0..3).any(|k| [run[k], run[(k + 1) % 3]] == [b, a])
            });
            let Some(other) = beyond else { continue };
            let d = *faces[other].iter().find(|v| ![a, b].contains(v)).unwrap();
            let [pa, pb, pc] = [a, b, c].map(|v| space[v].unwrap());
            let along: Vec3 = unit(pb - pa).unwrap();
            let normal = unit(along.cross(pc - pa)).unwrap();
            let outwards = along.cross(normal);
            let edge = unit2(flat[b] - flat[a]).unwrap();
            let (t, h) = ((flat[d] - flat[a]).dot(edge), -edge.perp_dot(flat[d] - flat[a]));
            let angle = from_deg(folds[&[a.min(b), a.max(b)]]);
            let way = outwards * cos(angle) + normal * sin(angle);
            let place = pa + (along * t + way * h);
            // Round a corner inside, a second way round comes to the first one's place.
            let off = space[d].map_or(0.0, |known| known.distance(place));
            assert!(off < 1e-6, "{off}");
            space[d] = Some(place);
            done[other] = true;
            waiting.push(other);
        }
    }
    assert!(done.iter().all(|&done| done));
    space
}

#[test]
fn a_fold_file_folds_up_to_the_surface() {
    for made in [half_frustum(), read("examples/three-cones.sheet.json"), facets()] {
        let frames = frames(&made);
        assert_eq!(frames.len(), made.parts.len());
        for (frame, part) in frames.iter().zip(&made.parts) {
            assert_eq!(frame["frame_title"], part.name.as_str());
            assert_eq!(frame["frame_unit"], "mm");
            let folded: Vec<Point3> = folded(frame).into_iter().map(Option::unwrap).collect();
            let mesh = part.sheet.mesh();
            let true_place = |n: usize| mesh.position(sheetwright::index::VertexIndex::new(n));
            let mut worst = 0.0f64;
            // Distances between corners tell a shape but for its mirror image, which the side of
            // one more tells apart.
            for a in (0..folded.len()).step_by(7) {
                for b in 0..folded.len() {
                    let off = folded[a].distance(folded[b]) - true_place(a).distance(true_place(b));
                    worst = worst.max(off.abs());
                }
            }
            let volume = |place: &dyn Fn(usize) -> Point3| {
                let m = folded.len();
                let [a, b, c, d] = [0, m / 4, m / 2, 3 * m / 4].map(place);
                (b - a).cross(c - a).dot(d - a)
            };
            let (here, there) = (volume(&|n| folded[n]), volume(&true_place));
            let size = part.piece.size.length();
            assert!(worst < 1e-7 * size, "{}: {worst} mm", part.name);
            assert!((here - there).abs() < 1e-6 * size * size * size, "{here} {there}");
        }
    }
}

/// A cube as a net, whose folds are right angles.
fn facets() -> Made {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus/good/mesh-cube.obj");
    let mut options = ReadOptions::default();
    options.mesh.facets = Some(true);
    make(&read_input(&path, &options).unwrap(), &mut Unwatched).unwrap()
}

/// A facet of a rounded file turns along its diagonals by rounding alone.
#[test]
fn diagonals_of_flat_facets_are_flat() {
    let text = "v 0.3 0 0\nv 100.13 0 37.42\nv 100.13 80.74 37.43\nv 0.3 80.74 0\n\
                v 130.6 0 -61.3\nv 130.6 80.74 -61.31\nf 1 2 3\nf 1 3 4\nf 2 5 6\nf 2 6 3\n";
    let mut options = ReadOptions::default();
    options.mesh.facets = Some(true);
    let format = InputFormat::Mesh(MeshFormat::Obj);
    let design = read_bytes(format, text.as_bytes(), "roof.obj", None, &options).unwrap();
    let made = make(&design, &mut Unwatched).unwrap();
    let frame = frames(&made).remove(0);
    let marks = frame["edges_assignment"].as_array().unwrap();
    let count = |mark: &str| marks.iter().filter(|other| *other == mark).count();
    assert_eq!(["M", "V", "F"].map(count), [1, 0, 2], "{marks:?}");
}
