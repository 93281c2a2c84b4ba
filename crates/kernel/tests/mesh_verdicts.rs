//! One verdict for one surface: however it was divided into triangles, and whether it came as a
//! mesh or as curves.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::check::{FindingKind, Verdict};
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{
    CurveUse, Design, DesignCurve, DesignPanel, PanelMesh, PanelShape, Triangles,
};
use sheetwright::elastic::Basis;
use sheetwright::index::VertexIndex;
use sheetwright::make::{Part, make};
use sheetwright::material::Material;
use sheetwright::math::{Point3, atan2, cos, from_deg, sin};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::materials::steel;
use sheetwright_shapes::meshes::{cap, cone};
use sheetwright_shapes::random::Random;
use std::f64::consts::TAU;

/// A mesh as it is made alone.
fn made(
    positions: Vec<Point3>,
    triangles: Vec<[VertexIndex; 3]>,
    material: Option<Material>,
) -> Part {
    let mesh = PanelMesh::new(Triangles { positions, triangles, left_out: 0 });
    let panel = DesignPanel::new("mesh", PanelShape::Mesh(mesh), 100);
    let design = Design { panels: vec![panel], material, ..Design::default() };
    make(&design, &mut Unwatched).unwrap().parts.remove(0)
}

/// How the cells of a grid are cut.
#[derive(Clone, Copy, Debug)]
enum Cut {
    Forth,
    Back,
    InTurn,
}

/// A grid in two triangles a cell.
fn grid(
    [columns, rows]: [usize; 2],
    cut: Cut,
    mut at: impl FnMut(f64, f64) -> Point3,
) -> (Vec<Point3>, Vec<[VertexIndex; 3]>) {
    let mut place = |k: usize| {
        let (i, j) = (k / (rows + 1), k % (rows + 1));
        at(i as f64 / columns as f64, j as f64 / rows as f64)
    };
    let positions = (0..(columns + 1) * (rows + 1)).map(&mut place).collect();
    let mut triangles = Vec::new();
    for i in 0..columns {
        for j in 0..rows {
            let corner = |i: usize, j: usize| VertexIndex::new(i * (rows + 1) + j);
            let [a, b, c, d] =
                [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            let is_forth = match cut {
                Cut::Forth => true,
                Cut::Back => false,
                Cut::InTurn => (i + j) % 2 == 0,
            };
            triangles.extend(if is_forth {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, b, d], [b, c, d]]
            });
        }
    }
    (positions, triangles)
}

/// A strip of 1000 × 300 mm that is twisted by an angle.
fn helicoid(deg: f64) -> impl Fn(f64, f64) -> Point3 {
    move |along, across| {
        let (angle, side) = (from_deg(deg) * along, 300.0 * (across - 0.5));
        Point3::new(1000.0 * along, side * cos(angle), side * sin(angle))
    }
}

/// A panel between two rails.
fn between(rails: [Vec<Point3>; 2], material: Option<Material>) -> Part {
    let names = ["low", "high"];
    let curves = rails.into_iter().zip(names).map(|(points, name)| DesignCurve {
        name: name.into(),
        kind: Some(CurveKind::Spline),
        closed: false,
        points: points.into_iter().map(CurvePoint::smooth).collect(),
    });
    let on = |name: &str| CurveUse { name: name.into(), reversed: false };
    let design = Design {
        curves: curves.collect(),
        panels: vec![DesignPanel::new("strip", PanelShape::Rails(names.map(on)), 100)],
        material,
        ..Design::default()
    };
    make(&design, &mut Unwatched).unwrap().parts.remove(0)
}

fn strain(part: &Part) -> f64 {
    part.predicted.as_ref().unwrap().strain
}

fn verdict(part: &Part) -> Verdict {
    part.checked.verdict
}

/// Strips in 1, 2, 10 and 16 rows that are twisted by an angle.
fn twisted(deg: f64, material: Option<&Material>) -> Vec<Part> {
    let at = helicoid(deg);
    let rows = [
        ([32, 1], Cut::Back),
        ([32, 2], Cut::Back),
        ([32, 2], Cut::InTurn),
        ([32, 10], Cut::Forth),
        ([60, 16], Cut::InTurn),
    ];
    let strip = |(cells, cut)| {
        let (positions, triangles) = grid(cells, cut, &at);
        let part = made(positions, triangles, material.cloned());
        assert_eq!(part.predicted.as_ref().unwrap().basis, Basis::Computed);
        part
    };
    rows.into_iter().map(strip).collect()
}

#[test]
fn a_twisted_strip_is_judged_alike_however_it_was_divided() {
    let steel = steel(1.0);
    for part in twisted(10.0, Some(&steel)) {
        assert_eq!(verdict(&part), Verdict::Bends, "{}", strain(&part));
    }
    let at = helicoid(10.0);
    let rail = |side: f64| (0..25).map(|i| at(f64::from(i) / 24.0, side)).collect();
    assert_eq!(verdict(&between([rail(0.0), rail(1.0)], Some(steel))), Verdict::Bends);
}

#[test]
fn a_strip_twisted_by_60_deg_strains_alike_however_it_was_divided() {
    // Its pattern is fitted to its sheet, and that from one row alone as from sixteen.
    let parts = twisted(60.0, Some(&steel(1.0)));
    let strains: Vec<f64> = parts.iter().map(strain).collect();
    let verdicts: Vec<Verdict> = parts.iter().map(verdict).collect();
    // Thin sheet has several places of rest; one of them is `Undecided`.
    let is_alike = |verdict: &Verdict| matches!(verdict, Verdict::Roll | Verdict::Undecided);
    assert!(verdicts.iter().all(is_alike), "{verdicts:?} {strains:?}");
    let rolled = verdicts.iter().zip(&strains).filter(|(verdict, _)| **verdict == Verdict::Roll);
    let rolled: Vec<f64> = rolled.map(|(_, &strain)| strain).collect();
    let [least, most] = [f64::min, f64::max].map(|of| rolled.iter().copied().reduce(of).unwrap());
    assert!(rolled.len() > 3 && most < 1.25 * least, "{strains:?}");
    assert!(least > 5e-4 && most < 8e-4, "{strains:?}");
}

#[test]
fn a_strip_twisted_by_90_deg_in_one_row_is_no_row_of_folds() {
    let at = helicoid(90.0);
    for (cells, cut) in [([40, 1], Cut::Forth), ([40, 1], Cut::InTurn), ([40, 4], Cut::Back)] {
        for (thickness_mm, wanted) in [(2.0, Verdict::WillNotBend), (0.3, Verdict::Roll)] {
            let (positions, triangles) = grid(cells, cut, &at);
            let part = made(positions, triangles, Some(steel(thickness_mm)));
            let basis = part.predicted.as_ref().unwrap().basis;
            assert_eq!(basis, Basis::Computed, "{cells:?} {cut:?}");
            assert_eq!(verdict(&part), wanted, "{cells:?} {cut:?} {thickness_mm}");
            let is_crease = |kind: &FindingKind| matches!(kind, FindingKind::Creases { .. });
            assert!(!part.checked.findings.iter().any(|finding| is_crease(&finding.kind)));
        }
    }
}

#[test]
fn a_strip_in_one_row_is_judged_as_in_four() {
    // Its creases are not its surface: a sheet that began on them lay by chance, and one of three
    // strips twisted by 45° was told that it will not bend.
    for (deg, thickness_mm) in [(30.0, 1.0), (45.0, 1.0), (45.0, 0.5)] {
        let at = helicoid(deg);
        let strip = |(rows, cut)| {
            let (positions, triangles) = grid([32, rows], cut, &at);
            made(positions, triangles, Some(steel(thickness_mm)))
        };
        let four = strip((4, Cut::InTurn));
        assert_ne!(verdict(&four), Verdict::WillNotBend, "{deg} {thickness_mm}");
        for cut in [Cut::Forth, Cut::Back, Cut::InTurn] {
            let one = strip((1, cut));
            let ratio = strain(&one) / strain(&four);
            assert!((0.67..1.5).contains(&ratio), "{deg} {thickness_mm} {cut:?} {ratio}");
            assert_ne!(verdict(&one), Verdict::WillNotBend, "{deg} {thickness_mm} {cut:?}");
        }
    }
}

#[test]
fn the_thickest_sheet_that_is_named_takes_the_shape() {
    let steep = |x: f64, y: f64| {
        let (x, y) = (2.0 * x - 1.0, 2.0 * y - 1.0);
        Point3::new(150.0 * x, 150.0 * y, 20.0 * (x * x - y * y))
    };
    let meshes = [
        (grid([12, 12], Cut::Forth, steep), 0.5),
        (grid([40, 1], Cut::Forth, helicoid(75.0)), 2.0),
        (grid([40, 4], Cut::Back, helicoid(75.0)), 2.0),
    ];
    for ((positions, triangles), thickness_mm) in meshes {
        let in_sheet = |mm: f64| made(positions.clone(), triangles.clone(), Some(steel(mm)));
        let part = in_sheet(thickness_mm);
        assert_eq!(verdict(&part), Verdict::WillNotBend);
        let thickest_mm = part.predicted.as_ref().unwrap().thickest_mm.unwrap();
        assert!(thickest_mm < thickness_mm);
        let thinner = in_sheet(thickest_mm);
        let is_taken = !matches!(verdict(&thinner), Verdict::WillNotBend | Verdict::Undecided);
        assert!(is_taken, "{thickest_mm}: {:?} {}", verdict(&thinner), strain(&thinner));
    }
}

/// Surfaces of 1000 × 300 mm in 1, 2, 3 and 10 rows of 24 cells, each cut in two ways.
fn in_rows(at: impl Fn(f64, f64) -> Point3) -> Vec<Part> {
    let rows = [1, 2, 3, 10].into_iter();
    let cells = rows.flat_map(|rows| [Cut::Forth, Cut::InTurn].map(|cut| ([24, rows], cut)));
    let one = |(cells, cut)| {
        let (positions, triangles) = grid(cells, cut, &at);
        made(positions, triangles, Some(steel(1.0)))
    };
    cells.map(one).collect()
}

/// Between straight sides; each corner lies so far, mm, above the plane or below it.
fn hyperbolic(height: f64) -> impl Fn(f64, f64) -> Point3 {
    move |along, across| {
        let warp = (2.0 * along - 1.0) * (2.0 * across - 1.0);
        Point3::new(1000.0 * along, 300.0 * across, height * warp)
    }
}

#[test]
fn one_surface_has_one_verdict_however_it_was_cut() {
    let cylinder = |along: f64, across: f64| {
        let angle = 1.5 * along;
        Point3::new(660.0 * cos(angle), 660.0 * sin(angle), 300.0 * across)
    };
    let families = [
        (in_rows(helicoid(15.0)), Verdict::Bends),
        (in_rows(hyperbolic(15.0)), Verdict::Bends),
        (in_rows(hyperbolic(80.0)), Verdict::Roll),
        (in_rows(cylinder), Verdict::Bends),
    ];
    for (parts, wanted) in families {
        let found: Vec<(Verdict, f64)> =
            parts.iter().map(|part| (verdict(part), strain(part))).collect();
        let is_so = |(is, _): &(Verdict, f64)| *is == wanted || *is == Verdict::Undecided;
        assert!(found.iter().all(is_so), "{wanted:?}: {found:?}");
        let sure = found.iter().filter(|(is, _)| *is == wanted).count();
        assert!(sure + 1 >= found.len(), "{wanted:?}: {found:?}");
    }
}

#[test]
fn a_strip_that_lies_flat_exactly_keeps_its_pattern() {
    // A cone in one row: its sheet strains where its border turns, but no fitted pattern is better
    // by far.
    let cone = cone(200.0, 600.0, 1.0, 40, 1);
    let part = made(cone.positions().to_vec(), cone.triangles().to_vec(), Some(steel(1.0)));
    assert!(part.measures.length_error_max < 1e-9, "{}", part.measures.length_error_max);
}

/// A cap of a sphere of 1 m to so many degrees from its pole.
fn dome(deg: f64) -> Part {
    let mesh = cap(from_deg(deg), 10, 40);
    let scaled = mesh.positions().iter().map(|p| Point3::from_vec(p.to_vec() * 1000.0));
    made(scaled.collect(), mesh.triangles().to_vec(), Some(steel(1.0)))
}

#[test]
fn a_shallow_dome_bends_and_a_deep_one_does_not_though_their_borders_are_flat() {
    // They are as high as 0.9, 5.3 and 18 % of their width.
    let [shallow, deep, deeper] = [2.0, 12.0, 40.0].map(dome);
    assert_eq!(verdict(&shallow), Verdict::Bends);
    assert_eq!(verdict(&deep), Verdict::WillNotBend);
    assert_eq!(verdict(&deeper), Verdict::WillNotBend);
    assert!(strain(&shallow) < strain(&deep) && strain(&deep) < strain(&deeper));
    // Both lengths are said: what grows and what shrinks.
    let said = deeper.checked.findings.iter().find_map(|finding| match finding.kind {
        FindingKind::Stretch { stretch, shrink } => Some([stretch, shrink]),
        _ => None,
    });
    let distortion = deeper.measures.distortion.as_ref().unwrap();
    let wanted = [1.0 / distortion.stretch_min - 1.0, 1.0 - 1.0 / distortion.stretch_max];
    assert_eq!(said.unwrap(), wanted);
}

/// A grid of cells on a saddle of a size of 400 mm, as high as this at its corners, mm.
fn saddle(height: f64) -> Part {
    let (positions, triangles) = grid([20, 20], Cut::InTurn, |x, y| {
        let (x, y) = (2.0 * x - 1.0, 2.0 * y - 1.0);
        Point3::new(200.0 * x, 200.0 * y, height * x * y)
    });
    made(positions, triangles, Some(steel(1.0)))
}

#[test]
fn gentle_saddles_bend_and_steep_ones_do_not() {
    assert_eq!(verdict(&saddle(3.0)), Verdict::Bends);
    assert_eq!(verdict(&saddle(100.0)), Verdict::WillNotBend);
}

/// Found crumpled, it would strain by ten times as much as it needs to.
#[test]
fn a_thin_saddle_is_not_found_crumpled_however_it_was_cut() {
    let cells = [(12, Cut::Forth), (12, Cut::Back), (12, Cut::InTurn), (16, Cut::Forth)];
    for height in [110.0, 150.0] {
        for (cells, cut) in cells {
            let (positions, triangles) = grid([cells; 2], cut, |x, y| {
                let warp = (2.0 * x - 1.0) * (2.0 * y - 1.0);
                Point3::new(1000.0 * x, 1000.0 * y, height * warp)
            });
            let part = made(positions, triangles, Some(steel(0.5)));
            let taken = [Verdict::Bends, Verdict::BendsWithForce, Verdict::Roll];
            let is_taken = taken.contains(&verdict(&part)) && strain(&part) < 8e-4;
            assert!(is_taken, "{height} {cells} {cut:?} {:?} {}", verdict(&part), strain(&part));
        }
    }
}

/// Felt that stretches by 5 or 10 %: deeper dishes strain more, and the sheet has their shape.
#[test]
fn a_dish_that_is_too_deep_is_not_taken_however_it_was_divided() {
    let dishes = [(0.05, 30.0, 45.0, 70.0), (0.1, 45.0, 60.0, 80.0)];
    for cells in [[6, 18], [8, 24]] {
        for (limit, shallow, deep, too_deep) in dishes {
            let in_felt = |depth: f64| {
                let (positions, triangles) = dish(150.0, depth, cells);
                made(positions, triangles, Some(springy(3.0, limit, 10.0)))
            };
            let parts = [shallow, deep, too_deep].map(in_felt);
            let is_taken = |part| matches!(verdict(part), Verdict::Bends | Verdict::BendsWithForce);
            let found = parts.each_ref().map(|part| (verdict(part), strain(part)));
            assert_eq!(parts.each_ref().map(is_taken), [true, true, false], "{cells:?} {found:?}");
            assert!(found[0].1 < found[1].1 && found[1].1 < found[2].1, "{cells:?} {found:?}");
            // It lies off the surface by no more than 1 % of its size.
            let off = parts[1].predicted.as_ref().unwrap().rest_distance_mm().unwrap();
            assert!(off < 0.01 * 430.0, "{cells:?} {off}");
        }
    }
}

/// A round dish of a radius, mm, that is part of a sphere of this depth, mm.
fn dish(
    radius: f64,
    depth: f64,
    [rings, around]: [usize; 2],
) -> (Vec<Point3>, Vec<[VertexIndex; 3]>) {
    let of_sphere = (radius * radius + depth * depth) / (2.0 * depth);
    let angle = atan2(radius, of_sphere - depth);
    let mesh = cap(angle, rings, around);
    let scaled = mesh.positions().iter().map(|p| Point3::from_vec(p.to_vec() * of_sphere));
    (scaled.collect(), mesh.triangles().to_vec())
}

#[test]
fn cylinders_and_cones_bend_with_noise_and_without() {
    for noise in [0.0, 0.05, 0.2] {
        let mut random = Random::new(3);
        let (positions, triangles) = grid([50, 40], Cut::InTurn, |x, y| {
            let radius = 600.0 + random.between(-noise, noise);
            Point3::new(radius * cos(x), radius * sin(x), 400.0 * y)
        });
        let part = made(positions, triangles, Some(steel(1.0)));
        assert_eq!(verdict(&part), Verdict::Bends, "{noise} {}", strain(&part));
    }
    let cone = cone(600.0, 1200.0, 1.0, 24, 12);
    let part = made(cone.positions().to_vec(), cone.triangles().to_vec(), Some(steel(1.0)));
    assert_eq!(verdict(&part), Verdict::Bends, "{}", strain(&part));
}

/// A cone of 300 mm with its base open, in so many sides and rings.
fn open_cone([sides, rings]: [usize; 2], radius: f64, material: Material) -> Part {
    let mut positions = vec![Point3::new(0.0, 0.0, 300.0)];
    let mut triangles = Vec::new();
    for ring in 1..=rings {
        let down = ring as f64 / rings as f64;
        for side in 0..sides {
            let angle = TAU * side as f64 / sides as f64;
            let out = down * radius;
            let at = Point3::new(out * cos(angle), out * sin(angle), 300.0 * (1.0 - down));
            let number = |ring: usize, side: usize| match ring {
                0 => VertexIndex::new(0),
                _ => VertexIndex::new(1 + (ring - 1) * sides + side % sides),
            };
            let [a, b] = [side, side + 1].map(|side| number(ring - 1, side));
            let [c, d] = [side, side + 1].map(|side| number(ring, side));
            triangles.push([a, c, d]);
            if ring > 1 {
                triangles.push([a, d, b]);
            }
            positions.push(at);
        }
    }
    made(positions, triangles, Some(material))
}

#[test]
fn a_cone_with_an_open_base_is_cut_to_its_point_in_however_few_rings() {
    for radius in [100.0, 250.0] {
        for cells in [[24, 1], [36, 1], [48, 1], [48, 4], [36, 6]] {
            let part = open_cone(cells, radius, steel(1.0));
            assert!(part.measures.length_error_max < 1e-6, "{cells:?}");
            assert_eq!(part.flat.overlap, None, "{cells:?}");
            let is_rolled = matches!(verdict(&part), Verdict::Roll);
            assert!(is_rolled || radius < 200.0, "{radius} {cells:?} {:?}", verdict(&part));
            // The slope of the cone from its point to its base, and the base, flat.
            let slope = (radius * radius + 90_000.0_f64).sqrt();
            let area = 0.5 * TAU * radius * slope;
            assert!((part.piece.area_mm2() / area - 1.0).abs() < 0.02, "{cells:?}");
        }
    }
}

/// A shop rolls to the radius that it reads: that of the pipe, however it was divided.
#[test]
fn half_a_pipe_is_rolled_to_its_radius() {
    for radius in [100.0, 300.0] {
        for (columns, rows) in [(24, 1), (24, 6), (48, 10)] {
            for cut in [Cut::Forth, Cut::InTurn] {
                let (positions, triangles) = grid([columns, rows], cut, |x, y| {
                    let angle = 0.5 * TAU * x;
                    Point3::new(radius * cos(angle), radius * sin(angle), 3.0 * radius * y)
                });
                let part = made(positions, triangles, Some(steel(1.0)));
                assert_eq!(verdict(&part), Verdict::Roll);
                let found = 1.0 / part.predicted.unwrap().curvature;
                assert!((found / radius - 1.0).abs() < 0.01, "{columns} {rows} {cut:?} {found}");
            }
        }
    }
}

/// A ribbon of this length, 1 mm wide, wound round a cylinder of 20 mm, turn beside turn.
fn ribbon(length: f64) -> Part {
    let (positions, triangles) = grid([length as usize, 1], Cut::Forth, |along, across| {
        let angle = along * length / 20.0;
        Point3::new(20.0 * cos(angle), 20.0 * sin(angle), across + 1.2 * angle / TAU)
    });
    made(positions, triangles, Some(steel(0.1)))
}

#[test]
fn a_ribbon_too_long_for_a_net_is_judged_by_its_creases() {
    let (short, long) = (ribbon(1000.0), ribbon(15_000.0));
    let bases = [&short, &long].map(|part| part.predicted.as_ref().unwrap().basis);
    assert_eq!(bases, [Basis::Computed, Basis::NoNet]);
    let radii = [&short, &long].map(|part| 1.0 / part.predicted.as_ref().unwrap().curvature);
    assert!(radii.iter().all(|radius| (radius / 20.0 - 1.0).abs() < 0.1), "{radii:?}");
    assert_eq!([&short, &long].map(verdict), [Verdict::Roll; 2]);
}

/// Sheet that springs back, of a thickness, mm, and with these limits.
fn springy(thickness_mm: f64, stretch: f64, bend_radius_mm: f64) -> Material {
    let mut sheet = Material { yield_strain: None, ..steel(thickness_mm) };
    sheet.stretch_limit.value = stretch;
    sheet.bend_radius_mm.value = bend_radius_mm;
    sheet
}

#[test]
fn a_mesh_is_bent_no_more_tightly_than_its_sheet_takes() {
    for (radius, is_taken) in [(200.0, false), (350.0, false), (420.0, true)] {
        let (positions, triangles) = grid([24, 6], Cut::Forth, |x, y| {
            let angle = 0.5 * TAU * x;
            Point3::new(radius * cos(angle), radius * sin(angle), 500.0 * y)
        });
        let part = made(positions, triangles, Some(springy(4.0, 0.005, 385.0)));
        let is_tight = |kind: &FindingKind| matches!(kind, FindingKind::RadiusTooSmall { .. });
        let is_said = part.checked.findings.iter().any(|finding| is_tight(&finding.kind));
        assert_eq!(is_said, !is_taken, "{radius}");
        assert_eq!(verdict(&part) == Verdict::WillNotBend, !is_taken, "{radius}");
    }
}

/// The steps of a leg of a bracket.
const LEG_STEPS: usize = 25;

/// The profile of a bracket: legs of 100 mm, and round bends of a radius between them, each turning
/// by 90° this way or the other.
fn bracket(radius: f64, bends: &[f64], steps: usize) -> Vec<[f64; 2]> {
    let (mut at, mut angle) = ([0.0, 0.0], 0.0);
    let mut points = vec![at];
    let forward =
        |at: [f64; 2], far: f64, angle: f64| [at[0] + far * cos(angle), at[1] + far * sin(angle)];
    for &way in bends {
        for _ in 0..LEG_STEPS {
            at = forward(at, 100.0 / LEG_STEPS as f64, angle);
            points.push(at);
        }
        let step = 0.25 * TAU / steps as f64;
        for _ in 0..steps {
            at = forward(at, 2.0 * radius * sin(0.5 * step), angle + 0.5 * way * step);
            angle += way * step;
            points.push(at);
        }
    }
    for _ in 0..LEG_STEPS {
        at = forward(at, 100.0 / LEG_STEPS as f64, angle);
        points.push(at);
    }
    points
}

#[test]
fn brackets_are_formed_to_the_radius_of_their_bends() {
    for radius in [3.0, 5.0, 10.0, 20.0, 40.0] {
        for bends in [&[1.0][..], &[1.0, 1.0], &[1.0, -1.0]] {
            let fine = bracket(radius, bends, 24);
            let points = bracket(radius, bends, 8);
            let rail = |z: f64| fine.iter().map(move |&[x, y]| Point3::new(x, y, z)).collect();
            let curves = between([rail(0.0), rail(150.0)], Some(steel(2.0)));
            let mut parts = vec![curves];
            for rows in [1, 4] {
                let cells = [points.len() - 1, rows];
                let (positions, triangles) = grid(cells, Cut::Forth, |along, across| {
                    let [x, y] = points[(along * cells[0] as f64).round() as usize];
                    Point3::new(x, y, 150.0 * across)
                });
                parts.push(made(positions, triangles, Some(steel(2.0))));
            }
            for (n, part) in parts.iter().enumerate() {
                assert_eq!(verdict(part), Verdict::Roll, "{radius} {bends:?} {n} {}", strain(part));
                // The spline through the profile rounds off where a bend of 3 mm begins.
                let found = 1.0 / part.predicted.as_ref().unwrap().curvature;
                assert!((found / radius - 1.0).abs() < 0.12, "{radius} {bends:?} {n} {found}");
                // What holds it is the plastic moment, σ t²/4 with σ = E ε / (1 − ν²).
                let plastic = 210_000.0 * 0.0012 / (1.0 - 0.09);
                let moment = part.predicted.as_ref().unwrap().hold_moment_n().unwrap();
                assert!(moment < 1.01 * plastic, "{radius} {bends:?} {n} {moment}");
            }
        }
    }
}
