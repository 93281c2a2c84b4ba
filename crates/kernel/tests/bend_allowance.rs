//! Sharp folds that a tool with a radius makes: flat lengths against worked numbers.

#![allow(clippy::unwrap_used, reason = "a test that can't go on fails")]

use sheetwright::bend::Mitred;
use sheetwright::check::{Finding, FindingKind, Place, Verdict};
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{
    Design, DesignCurve, DesignPanel, Dimensions, PanelMesh, PanelMethod, PanelShape, Triangles,
};
use sheetwright::flatten::refold;
use sheetwright::index::VertexIndex;
use sheetwright::make::{Part, make};
use sheetwright::material::{
    ASSUMED, Deduction, Deductions, KFactor, KFactors, Material, setback_mm,
};
use sheetwright::math::{Point3, cos, from_deg, sin};
use sheetwright::watch::Unwatched;
use std::f64::consts::FRAC_PI_2;

/// A sheet of 2 mm that is bent to 2 mm, with one K.
fn sheet(k: f64) -> Material {
    let rows = vec![KFactor { radius_per_thickness: 1.0, k }];
    let k_factors = Some(KFactors { rows, source: ASSUMED.to_owned() });
    Material { k_factors, ..sheetwright_shapes::materials::steel(2.0) }
}

/// How exact neutral surfaces are where they are mitred, mm.
const NEUTRAL_MM: f64 = 1e-5;

/// A profile, x and z, drawn out along y.
fn profile(
    points: &[[f64; 2]],
    dimensions: Dimensions,
    material: Material,
    samples: usize,
) -> Design {
    let rail = |name: &str, y: f64| DesignCurve {
        name: name.to_owned(),
        kind: Some(CurveKind::Polyline),
        closed: false,
        points: points.iter().map(|&[x, z]| CurvePoint::corner(Point3::new(x, y, z))).collect(),
    };
    let mut design = Design::between("bracket", [rail("front", 0.0), rail("back", 80.0)]);
    design.panels[0].method = PanelMethod::Rails;
    design.panels[0].samples = samples;
    (design.dimensions, design.thickness_mm) = (Some(dimensions), Some(2.0));
    design.bend_radius_mm = Some(2.0);
    design.material = Some(material);
    design
}

fn made(design: &Design) -> Part {
    make(design, &mut Unwatched).unwrap().parts.remove(0)
}

/// How long the pattern is along its front rail, which must be straight, mm; after it was folded.
fn length_mm(part: &Part) -> f64 {
    let off_mm = refold(&part.sheet, &part.flat.points, &part.sheet.rungs()).unwrap();
    assert!(off_mm < 1e-9, "refolded {off_mm} mm off");
    let size = part.piece.size;
    assert!((size.x - 80.0).abs() < 1e-9 || (size.y - 80.0).abs() < 1e-9, "{size}");
    assert_eq!(mitred(part), []);
    let area: f64 = part.piece.area_mm2();
    area / 80.0
}

fn mitred(part: &Part) -> Vec<(usize, usize, Mitred)> {
    let of = |kind: &FindingKind| match *kind {
        FindingKind::FoldsMitred { count, of, why } => Some((count, of, why)),
        _ => None,
    };
    part.checked.findings.iter().filter_map(|finding| of(&finding.kind)).collect()
}

/// Of a right angle at R 2, T 2: what K = 0.44 takes, and what it leaves out of outer lengths.
const ALLOWANCE_MM: f64 = FRAC_PI_2 * 2.88;
const DEDUCTION_MM: f64 = 8.0 - ALLOWANCE_MM;

#[test]
fn a_bracket_is_as_long_as_its_legs_and_its_bend() {
    let outside = [[0.0, 50.0], [0.0, 0.0], [50.0, 0.0]];
    let mean = [[1.0, 50.0], [1.0, 1.0], [50.0, 1.0]];
    let inside = [[2.0, 50.0], [2.0, 2.0], [50.0, 2.0]];
    // As few samples as there are corners, and some that lie within the bend.
    for samples in [3, 5, 41] {
        for (points, dimensions) in
            [(outside, Dimensions::Outside), (mean, Dimensions::Mean), (inside, Dimensions::Inside)]
        {
            let part = made(&profile(&points, dimensions, sheet(0.44), samples));
            let flat_mm = length_mm(&part);
            let expected_mm = 46.0 + ALLOWANCE_MM + 46.0;
            assert!((flat_mm - expected_mm).abs() < NEUTRAL_MM, "{dimensions:?}: {flat_mm}");
            assert!((flat_mm - 96.523_893).abs() < 1e-6);
        }
    }
}

#[test]
fn a_channel_and_a_step_lose_a_deduction_at_each_fold() {
    let channel = [[0.0, 30.0], [0.0, 0.0], [50.0, 0.0], [50.0, 30.0]];
    let flat_mm = length_mm(&made(&profile(&channel, Dimensions::Outside, sheet(0.44), 31)));
    assert!((flat_mm - (110.0 - 2.0 * DEDUCTION_MM)).abs() < NEUTRAL_MM, "{flat_mm}");
    // One bend up and one down: the drawn face is the outer one of the first and the inner one of
    // the second, whose lengths are both thicknesses longer outside.
    let step = [[0.0, 60.0], [0.0, 0.0], [50.0, 0.0], [50.0, -20.0]];
    let flat_mm = length_mm(&made(&profile(&step, Dimensions::Outside, sheet(0.44), 27)));
    let first_mm = 60.0 + 50.0 - DEDUCTION_MM;
    assert!((flat_mm - (first_mm + 20.0 + 4.0 - DEDUCTION_MM)).abs() < NEUTRAL_MM, "{flat_mm}");
}

#[test]
fn angles_that_are_not_right_have_their_own_setbacks() {
    for degrees in [20.0, 60.0, 120.0] {
        let turn = from_deg(degrees);
        let end = [50.0 - 50.0 * cos(turn), 50.0 * sin(turn)];
        let points = [[0.0, 0.0], [50.0, 0.0], [100.0 - end[0], end[1]]];
        let flat_mm = length_mm(&made(&profile(&points, Dimensions::Outside, sheet(0.44), 3)));
        let expected_mm = 100.0 - 2.0 * setback_mm(turn, 4.0) + turn * 2.88;
        assert!(
            (flat_mm - expected_mm).abs() < NEUTRAL_MM,
            "{degrees}: {flat_mm}, not {expected_mm}"
        );
    }
}

/// The test case in the README of FreeCAD's SheetMetal workbench: T 2, R 1.64, legs of 48.12, which
/// make 100 mm of flat sheet with its table of K-factors.
#[test]
fn the_worked_example_of_freecad_is_reproduced() {
    let points = [[0.0, 51.76], [0.0, 0.0], [51.76, 0.0]];
    let row = |[radius_per_thickness, k]: [f64; 2]| KFactor { radius_per_thickness, k };
    let rows = [[1.0, 0.38], [3.0, 0.43], [99.0, 0.5]].map(row).to_vec();
    let k_factors = Some(KFactors { rows, source: ASSUMED.to_owned() });
    let material = Material { k_factors, ..sheet(0.5) };
    let mut design = profile(&points, Dimensions::Outside, material, 3);
    design.bend_radius_mm = Some(1.64);
    assert!((length_mm(&made(&design)) - 100.0).abs() < 0.02);
}

#[test]
fn a_table_of_deductions_goes_before_k() {
    let points = [[0.0, 50.0], [0.0, 0.0], [50.0, 0.0]];
    let row = Deduction { radius_mm: 2.0, angle_deg: 90.0, deduction_mm: 3.6 };
    let deductions = Some(Deductions { rows: vec![row], source: ASSUMED.to_owned() });
    let material = Material { deductions, ..sheet(0.44) };
    let mut design = profile(&points, Dimensions::Outside, material, 3);
    let flat_mm = length_mm(&made(&design));
    assert!((flat_mm - 96.4).abs() < NEUTRAL_MM, "{flat_mm}");
    // The table has no row of that tool.
    design.bend_radius_mm = Some(3.0);
    let flat_mm = length_mm(&made(&design));
    assert!((flat_mm - (90.0 + FRAC_PI_2 * 3.88)).abs() < NEUTRAL_MM, "{flat_mm}");
}

#[test]
fn a_sheet_that_breaks_where_it_is_folded_and_a_drawing_without_thickness_keep_their_lengths() {
    let points = [[0.0, 50.0], [0.0, 0.0], [50.0, 0.0]];
    let mut design = profile(&points, Dimensions::Mean, sheet(0.5), 3);
    design.dimensions = None;
    assert!((length_mm(&made(&design)) - 100.0).abs() < 1e-9);
}

#[test]
fn a_flange_that_ends_within_its_bend_stays_mitred() {
    let points = [[0.0, 3.0], [0.0, 0.0], [50.0, 0.0]];
    let part = made(&profile(&points, Dimensions::Outside, sheet(0.5), 3));
    assert_eq!(mitred(&part), [(1, 1, Mitred::Narrow)]);
    assert!((part.piece.area_mm2() / 80.0 - 51.0).abs() < 1e-9);
}

#[test]
fn folds_with_an_allowance_name_the_radius_of_their_tool() {
    let radii = |part: &Part| -> Vec<Option<f64>> {
        assert!(part.piece.bends.iter().all(|line| line.is_fold));
        part.piece.bends.iter().map(|line| line.inside_radius_mm).collect()
    };
    let channel = [[0.0, 30.0], [0.0, 0.0], [50.0, 0.0], [50.0, 30.0]];
    let mut design = profile(&channel, Dimensions::Outside, sheet(0.44), 31);
    assert_eq!(radii(&made(&design)), [Some(2.0); 2]);
    design.bend_radius_mm = Some(2.5);
    assert_eq!(radii(&made(&design)), [Some(2.5); 2]);
    design.dimensions = None;
    assert_eq!(radii(&made(&design)), [None; 2]);
    // The flange at one end is narrower than its bend.
    let narrow = [[0.0, 3.0], [0.0, 0.0], [50.0, 0.0], [50.0, 30.0]];
    let part = made(&profile(&narrow, Dimensions::Outside, sheet(0.44), 43));
    assert_eq!(mitred(&part), [(1, 2, Mitred::Narrow)]);
    let mut of_part = radii(&part);
    of_part.sort_by(|a, b| a.partial_cmp(b).unwrap());
    assert_eq!(of_part, [None, Some(2.0)]);
}

/// A mesh of these facets, each of three or four corners.
fn net(points: &[[f64; 3]], facets: &[&[usize]], dimensions: Dimensions) -> Vec<Part> {
    let positions = points.iter().map(|&[x, y, z]| Point3::new(x, y, z)).collect();
    let fan = |facet: &&[usize]| -> Vec<[VertexIndex; 3]> {
        let corner = |n: usize| VertexIndex::new(facet[n]);
        (2..facet.len()).map(|n| [corner(0), corner(n - 1), corner(n)]).collect()
    };
    let triangles = facets.iter().flat_map(fan).collect();
    let triangles = Triangles { positions, triangles, left_out: 0 };
    let mesh = PanelMesh { facets: Some(true), ..PanelMesh::new(triangles) };
    let panel = DesignPanel::new("net", PanelShape::Mesh(mesh), 0);
    let mut design = Design { panels: vec![panel], ..Design::default() };
    (design.dimensions, design.thickness_mm) = (Some(dimensions), Some(2.0));
    design.bend_radius_mm = Some(2.0);
    design.material = Some(sheet(0.44));
    make(&design, &mut Unwatched).unwrap().parts
}

#[test]
fn a_tray_of_outside_dimensions_loses_a_deduction_at_each_wall() {
    let (x, y, z) = (100.0, 60.0, 30.0);
    let floor = [[0.0, 0.0, 0.0], [x, 0.0, 0.0], [x, y, 0.0], [0.0, y, 0.0]];
    let rim = floor.map(|[x, y, _]| [x, y, z]);
    let points = [floor, rim].concat();
    let facets: [&[usize]; 5] =
        [&[0, 1, 2, 3], &[1, 0, 4, 5], &[2, 1, 5, 6], &[3, 2, 6, 7], &[0, 3, 7, 4]];
    let parts = net(&points, &facets, Dimensions::Outside);
    assert_eq!(parts.len(), 1);
    let part = &parts[0];
    let radii = part.piece.bends.iter().map(|line| line.inside_radius_mm);
    assert_eq!(radii.collect::<Vec<_>>(), [Some(2.0); 4]);
    assert_eq!(mitred(part), []);
    let off_mm = refold(&part.sheet, &part.flat.points, &part.sheet.rungs()).unwrap();
    assert!(off_mm < 1e-9, "refolded {off_mm} mm off");
    let size = part.piece.size;
    let expected = [x, y].map(|side| side + 2.0 * (z - DEDUCTION_MM));
    assert!((size.x - expected[0]).abs() < 1e-9 && (size.y - expected[1]).abs() < 1e-9, "{size}");
    // The corners of the floor lie where the middles of the bends cross.
    let crossing = [x, y].map(|side| side - DEDUCTION_MM);
    let outline = part.piece.outline();
    let found = |x: f64, y: f64| {
        let at = sheetwright::math::Point2::new(0.5 * size.x + x, 0.5 * size.y + y);
        outline.iter().any(|p| p.distance(at) < 1e-9)
    };
    for (a, b) in [(0.5, 0.5), (0.5, -0.5), (-0.5, 0.5), (-0.5, -0.5)] {
        assert!(found(a * crossing[0], b * crossing[1]), "{outline:?}");
    }
}

#[test]
fn sides_of_a_hopper_stay_straight() {
    let ring = |half: f64, z: f64| {
        [[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]]
    };
    let points = [ring(100.0, 0.0), ring(40.0, 90.0)].concat();
    let facets: [&[usize]; 4] = [&[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]];
    let parts = net(&points, &facets, Dimensions::Outside);
    assert_eq!(mitred(&parts[0]), []);
    // Each side is a trapezoid whose rims are parallel, outside the bends and within.
    let flat = &parts[0].flat.points;
    let mesh = parts[0].sheet.mesh();
    let rim = |v: VertexIndex| parts[0].sheet.origin(v).get() < 4;
    let sides = mesh.edges().iter().filter(|edge| edge.is_border());
    let (mut lower, mut upper) = (Vec::new(), Vec::new());
    for edge in sides {
        let [a, b] = edge.ends;
        let length_mm = flat[a.get()].distance(flat[b.get()]);
        match [rim(a), rim(b)] {
            [true, true] => lower.push(length_mm),
            [false, false] => upper.push(length_mm),
            _ => {}
        }
    }
    lower.sort_by(f64::total_cmp);
    upper.sort_by(f64::total_cmp);
    // The two outer sides have one fold, the two inner ones two.
    let shorter = |sides: &[f64], drawn_mm: f64| [drawn_mm - sides[3], drawn_mm - sides[0]];
    let [once, twice] = shorter(&lower, 200.0);
    assert!((twice - 2.0 * once).abs() < 1e-9 && once > 0.1, "{once} {twice}");
    let [once_above, _] = shorter(&upper, 80.0);
    assert!((once_above - once).abs() < 1e-9, "{once_above} {once}");
}

/// Four parallelograms of a Miura fold, which lies flat round the vertex in its middle.
#[test]
fn folds_that_meet_inside_the_sheet_stay_mitred() {
    let (side, angle, lift) = (60.0, from_deg(60.0), from_deg(40.0));
    let slope = cos(lift) * sin(angle) / cos(angle);
    let root = (1.0 + slope * slope).sqrt();
    let low = sin(lift) * sin(angle);
    let (across, aside) = (side * slope / root, side / root);
    let (along, up) = (side * (1.0 - low * low).sqrt(), side * low);
    let mut points = Vec::new();
    for row in 0..3 {
        for column in 0..3 {
            let odd = |n: usize| f64::from(u8::from(n % 2 == 1));
            let (column_mm, row_mm) = (column as f64 * across, row as f64 * along);
            points.push([column_mm, row_mm + odd(column) * aside, odd(row) * up]);
        }
    }
    let facets: [&[usize]; 4] = [&[0, 1, 4, 3], &[1, 2, 5, 4], &[3, 4, 7, 6], &[4, 5, 8, 7]];
    let parts = net(&points, &facets, Dimensions::Mean);
    assert_eq!(parts.len(), 1);
    let slits = parts[0].sheet.seams().len();
    let expected = if slits == 0 { vec![(4, 4, Mitred::Meets)] } else { Vec::new() };
    assert_eq!(mitred(&parts[0]), expected, "{slits} slits");
    assert_eq!(slits, 0);
}

/// Whatever the samples, and drawn as rails or as one outline: samples nearer to the fold than the
/// neutral surface moves there keep their order.
#[test]
fn lengths_do_not_hang_on_the_samples() {
    let ell = [[0.0, 50.0], [0.0, 0.0], [50.0, 0.0]];
    let expected = |k: f64| 2.0 * (50.0 - 4.0) + FRAC_PI_2 * (2.0 + 2.0 * k);
    for samples in [41, 101, 201, 401, 801] {
        let part = made(&profile(&ell, Dimensions::Outside, sheet(0.5), samples));
        assert_eq!(mitred(&part), [], "{samples}");
        let off_mm = length_mm(&part) - expected(0.5);
        assert!(off_mm.abs() < NEUTRAL_MM, "{samples}: {off_mm}");
        let part = made(&profile(&ell, Dimensions::Outside, sheet(0.44), samples));
        let off_mm = length_mm(&part) - expected(0.44);
        assert!(off_mm.abs() < NEUTRAL_MM, "{samples}: {off_mm}");
    }
    // By the tolerance, which takes some hundred samples.
    let mut usual = profile(&ell, Dimensions::Outside, sheet(0.44), 41);
    let panel = DesignPanel::usual("bracket".to_owned(), usual.panels[0].shape.clone());
    usual.panels[0] = panel;
    let off_mm = length_mm(&made(&usual)) - expected(0.44);
    assert!(off_mm.abs() < NEUTRAL_MM, "{off_mm}");
    // A fold towards each face: one grows and one shrinks, drawn on either.
    let zed = [[0.0, 30.0], [0.0, 0.0], [40.0, 0.0], [40.0, -30.0]];
    for samples in [61, 301] {
        for dimensions in [Dimensions::Inside, Dimensions::Outside] {
            let part = made(&profile(&zed, dimensions, sheet(0.44), samples));
            assert_eq!(mitred(&part), [], "{samples} {dimensions:?}");
        }
    }
}

/// A sheet of 2 mm that is bent by a right angle round a radius of the drawn face.
fn rolled(radius: f64, dimensions: Dimensions, samples: usize) -> Part {
    let arc = |n: usize| {
        let turn = FRAC_PI_2 * n as f64 / 40.0;
        [radius * sin(turn), radius * (1.0 - cos(turn))]
    };
    let points: Vec<[f64; 2]> = std::iter::once([-20.0, 0.0])
        .chain((0..=40).map(arc))
        .chain([[radius, radius + 20.0]])
        .collect();
    made(&profile(&points, dimensions, sheet(0.44), samples))
}

#[test]
fn a_bend_that_leaves_the_inner_face_no_radius_is_an_error() {
    let found = |part: &Part| {
        let of = |finding: &Finding| match finding.kind {
            FindingKind::SheetTooThick { drawn_mm, inside_mm, thickness_mm } => {
                assert!(
                    matches!(&finding.place, Place::Rungs { numbers, .. } if numbers.len() > 10)
                );
                Some((drawn_mm, inside_mm, thickness_mm))
            }
            _ => None,
        };
        part.checked.findings.iter().find_map(of)
    };
    let part = rolled(1.5, Dimensions::Outside, 201);
    let (drawn_mm, inside_mm, thickness_mm) = found(&part).unwrap();
    assert!((drawn_mm - 1.5).abs() < 0.1, "{drawn_mm}");
    assert_eq!((inside_mm, thickness_mm), (2.0, 2.0));
    assert_eq!(part.checked.verdict, Verdict::WillNotBend);
    // The middle lies half as far from the inner face, which itself may have any radius.
    assert!(found(&rolled(0.8, Dimensions::Mean, 201)).is_some());
    for (radius, dimensions) in
        [(1.2, Dimensions::Mean), (2.5, Dimensions::Outside), (0.5, Dimensions::Inside)]
    {
        assert_eq!(found(&rolled(radius, dimensions, 201)), None, "{radius} {dimensions:?}");
    }
}
