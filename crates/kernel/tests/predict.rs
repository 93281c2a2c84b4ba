//! What real sheets do: verdicts on strips, brackets and saddles whose strain is known from an
//! independent simulation, and how well the formula screens.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::check::{FindingKind, Verdict};
use sheetwright::curve::CurveKind;
use sheetwright::design::Design;
use sheetwright::elastic::{Basis, DOUBT};
use sheetwright::make::{Judging, Part, make, make_judged};
use sheetwright::material::{Material, Sourced};
use sheetwright::math::{Point3, cos, from_deg, sin};
use sheetwright::pattern::Role;
use sheetwright::template::Value;
use sheetwright::watch::Unwatched;
use sheetwright_shapes::bent;
use sheetwright_shapes::materials::{plywood, steel};
use std::f64::consts::TAU;

/// A strip between two rails of points, of a material.
fn strip(rails: [Vec<Point3>; 2], kind: CurveKind, material: Option<Material>) -> Design {
    Design { material, ..bent::strip("strip", rails, kind) }
}

/// Steel of a thickness, mm, that springs back however far it is bent.
fn spring(thickness_mm: f64) -> Material {
    Material { yield_strain: None, ..steel(thickness_mm) }
}

/// A strip that is twisted by an angle, of a material.
fn twisted(deg: f64, material: Option<Material>) -> Design {
    Design { material, ..bent::twisted(deg) }
}

/// A strip whose rails wave out of step, of a material.
fn wavy(height: f64, phase: f64, material: Option<Material>) -> Design {
    Design { material, ..bent::wavy(height, phase) }
}

fn made(design: &Design) -> Part {
    make(design, &mut Unwatched).unwrap().parts.remove(0)
}

fn scored(part: &Part) -> usize {
    part.piece.paths.iter().filter(|path| path.role == Role::Score).count()
}

#[test]
fn twisted_strips_need_no_fold_until_they_stretch_too_much() {
    // Strains in per cent, of an independent simulation.
    for (deg, known) in [(5.0, 0.008), (10.0, 0.020), (20.0, 0.047), (45.0, 0.115)] {
        let part = made(&twisted(deg, Some(steel(1.0))));
        let strain = 100.0 * part.predicted.as_ref().unwrap().strain;
        assert!(strain / known < 1.3 && known / strain < 1.3, "{deg}: {strain}");
        assert_ne!(part.checked.verdict, Verdict::WillNotBend, "{deg}");
        assert!(part.measures.rungs.iter().any(|rung| rung.is_fold), "{deg}");
        assert_eq!(scored(&part), 0, "{deg}");
        let is_spare = |kind: &FindingKind| matches!(kind, FindingKind::FoldsNotNeeded { .. });
        assert!(part.checked.findings.iter().any(|finding| is_spare(&finding.kind)), "{deg}");
    }
    let part = made(&twisted(90.0, Some(steel(1.0))));
    assert_eq!(part.checked.verdict, Verdict::BendsAndFolds);
    assert!(scored(&part) > 0);
}

/// Between held edges, even a sheet that does not buckle strains by no more than ω²/8.
#[test]
fn soft_sheet_is_twisted_without_a_fold() {
    for deg in [50.0, 60.0, 90.0] {
        let warp = from_deg(deg) * 300.0 / 1200.0;
        for (thickness_mm, stretch) in [(1.0, 0.05), (3.0, 0.05), (0.5, 0.03)] {
            let stretch_limit = Sourced::assumed(stretch);
            let soft = Material { stretch_limit, ..spring(thickness_mm) };
            let part = made(&twisted(deg, Some(soft)));
            let strain = part.predicted.as_ref().unwrap().strain;
            assert_eq!(scored(&part), 0, "{deg} {thickness_mm}");
            assert_eq!(part.checked.verdict, Verdict::Bends, "{deg} {thickness_mm}");
            assert!(strain <= warp * warp / 8.0, "{deg} {thickness_mm} {strain}");
        }
    }
}

/// Plywood can't be folded: what a folded surface would strain it by is no help.
#[test]
fn a_sheet_that_does_not_fold_is_judged_by_its_smooth_shape() {
    let part = made(&twisted(60.0, Some(plywood())));
    assert_eq!((part.checked.verdict, scored(&part)), (Verdict::WillNotBend, 0));
    let thickest_mm = part.predicted.as_ref().unwrap().thickest_mm.unwrap();
    let thinner = Material {
        thickness_mm: Sourced::assumed(thickest_mm),
        bend_radius_mm: Sourced::assumed(plywood().bend_radius_mm.value * thickest_mm / 3.0),
        ..plywood()
    };
    let part = made(&twisted(60.0, Some(thinner)));
    let is_taken = matches!(part.checked.verdict, Verdict::Bends | Verdict::BendsWithForce);
    assert!(is_taken && scored(&part) == 0, "{thickest_mm} {:?}", part.checked.verdict);
}

/// The formula smooths the fold of the cheapest surface as the computed sheet does; where it can't
/// tell, a batch computes the sheet.
#[test]
fn the_formula_needs_no_fold_where_the_sheet_needs_none() {
    for deg in [5.0, 10.0, 20.0, 30.0] {
        let design = twisted(deg, Some(steel(1.0)));
        let quick = make_judged(&design, Judging::Quick, &mut Unwatched).unwrap().parts.remove(0);
        let known = made(&design).predicted.unwrap().strain;
        let strain = quick.predicted.as_ref().unwrap().strain;
        assert!(strain / known < 1.5 && known / strain < 3.0, "{deg}: {strain} {known}");
        assert_eq!(scored(&quick), 0, "{deg}");
    }
    let design = twisted(45.0, Some(steel(1.0)));
    let auto = make_judged(&design, Judging::Auto, &mut Unwatched).unwrap().parts.remove(0);
    assert_eq!(auto.predicted.as_ref().unwrap().basis, Basis::Computed);
    let design = twisted(90.0, Some(steel(1.0)));
    let auto = make_judged(&design, Judging::Auto, &mut Unwatched).unwrap().parts.remove(0);
    assert_eq!(auto.checked.verdict, Verdict::BendsAndFolds);
}

#[test]
fn a_bracket_needs_the_fold_that_its_boundary_has() {
    let rail = |y: f64| {
        [[0.0, 0.0], [100.0, 0.0], [100.0, 100.0]].map(|[x, z]| Point3::new(x, y, z)).to_vec()
    };
    for material in [None, Some(steel(0.1)), Some(steel(1.0))] {
        let design = strip([rail(0.0), rail(150.0)], CurveKind::Polyline, material);
        let part = made(&design);
        assert_eq!(part.checked.verdict, Verdict::BendsAndFolds);
        assert_eq!(scored(&part), 1);
        let strain = part.predicted.as_ref().unwrap().strain;
        assert!(strain < 1e-9, "{strain}");
    }
}

#[test]
fn the_thickness_decides_and_the_thickest_sheet_is_named() {
    let thin = made(&wavy(80.0, 1.2, Some(spring(1.0))));
    let thick = made(&wavy(80.0, 1.2, Some(spring(5.0))));
    assert_ne!(thin.checked.verdict, Verdict::WillNotBend);
    assert_eq!(thick.checked.verdict, Verdict::WillNotBend);
    let predicted = thick.predicted.as_ref().unwrap();
    let thickest_mm = predicted.thickest_mm.unwrap();
    assert!(thickest_mm > 1.0 && thickest_mm < 5.0, "{thickest_mm}");
    // The moment goes with the third power of the thickness.
    let moments = [&thin, &thick].map(|part| part.predicted.as_ref().unwrap().hold_moment_n());
    let ratio = moments[1].unwrap() / moments[0].unwrap();
    assert!((ratio / 125.0 - 1.0).abs() < 0.1, "{ratio}");
}

/// A template at its defaults but for these values, of a material.
fn template(name: &str, values: &[(&str, f64)], material: Material) -> Design {
    let mut chosen = sheetwright::template::template(name).unwrap().defaults();
    values.iter().for_each(|&(name, value)| chosen.set(name, Value::Number(value)).unwrap());
    Design { material: Some(material), ..chosen.design().unwrap() }
}

#[test]
fn the_thickest_sheet_that_is_named_takes_the_shape() {
    // In these thicknesses, none does.
    let cases: [(&dyn Fn(Material) -> Design, f64); 6] = [
        (&|sheet| twisted(90.0, Some(sheet)), 5.0),
        (&|sheet| wavy(60.0, 1.2, Some(sheet)), 4.0),
        (&|sheet| wavy(80.0, 1.2, Some(sheet)), 5.0),
        (&|sheet| template("square-to-round", &[], sheet), 5.0),
        (&|sheet| template("reducer", &[], sheet), 5.0),
        (&|sheet| template("cone", &[], sheet), 5.0),
    ];
    for (n, (design, thickness_mm)) in cases.into_iter().enumerate() {
        let refused = made(&design(spring(thickness_mm)));
        assert_eq!(refused.checked.verdict, Verdict::WillNotBend, "{n}");
        let thickest_mm = refused.predicted.as_ref().unwrap().thickest_mm;
        let Some(thickest_mm) = thickest_mm else { panic!("{n}: none is named") };
        assert!(thickest_mm < thickness_mm, "{n}");
        let taken = made(&design(spring(thickest_mm)));
        let is_taken = !matches!(taken.checked.verdict, Verdict::WillNotBend | Verdict::Undecided);
        assert!(is_taken, "{n}: {:?} in {thickest_mm} mm", taken.checked.verdict);
    }
}

#[test]
fn metal_keeps_a_bend_beyond_its_yield() {
    let arc = |z: f64, radius: f64| {
        let at = |i: usize| {
            let angle = TAU / 4.0 * i as f64 / 24.0;
            Point3::new(radius * cos(angle), radius * sin(angle), z)
        };
        (0..25).map(at).collect::<Vec<_>>()
    };
    let bent = |radius: f64| {
        let rails = [arc(0.0, radius), arc(300.0, radius)];
        made(&strip(rails, CurveKind::Spline, Some(steel(1.0))))
    };
    // Its outer fibre yields below 1/2 mm / 0.12 % = 417 mm.
    assert_eq!(bent(500.0).checked.verdict, Verdict::Bends);
    let rolled = bent(300.0);
    assert_eq!(rolled.checked.verdict, Verdict::Roll);
    let from_mm = rolled.checked.findings.iter().find_map(|finding| match finding.kind {
        FindingKind::Roll { from_mm, .. } => Some(from_mm),
        _ => None,
    });
    assert!((from_mm.unwrap() - 416.7).abs() < 0.1);
}

#[test]
fn the_verdict_on_an_unknown_sheet_does_not_depend_on_the_unit() {
    let of = |scale: f64| {
        let mut design = wavy(60.0, 0.8, None);
        for point in design.curves.iter_mut().flat_map(|curve| &mut curve.points) {
            point.at = Point3::from_vec(point.at.to_vec() * scale);
        }
        let part = made(&design);
        (part.checked.verdict, part.predicted.unwrap().strain)
    };
    let (verdict, strain) = of(1.0);
    // By powers of two, rounding stays and so does the net; else it is another one.
    for (scale, most) in [(1.0 / 1024.0, 1.0 + 1e-6), (1024.0, 1.0 + 1e-6), (25.4, 1.5)] {
        let (other, scaled) = of(scale);
        assert_eq!(other, verdict);
        assert!(scaled / strain < most && strain / scaled < most, "{scale}: {scaled} {strain}");
    }
}

#[test]
fn the_formula_screens_within_its_doubt() {
    let mut within = 0;
    let mut all = 0;
    for height in [20.0, 40.0, 60.0] {
        for phase in [0.35, 0.8, 1.2] {
            for thickness_mm in [0.5, 1.0, 2.0] {
                let design = wavy(height, phase, Some(steel(thickness_mm)));
                let quick = make_judged(&design, Judging::Quick, &mut Unwatched).unwrap();
                let quick = quick.parts[0].predicted.as_ref().unwrap();
                assert_eq!(quick.basis, Basis::Screen);
                let exact = made(&design).predicted.unwrap();
                assert_eq!(exact.basis, Basis::Computed);
                let factor = quick.strain / exact.strain;
                all += 1;
                within += usize::from(factor < DOUBT && factor > 1.0 / DOUBT);
            }
        }
    }
    assert!(10 * within >= 9 * all, "{within} of {all}");
}

#[test]
fn the_formula_knows_that_thick_sheet_resists_a_fold_that_it_smooths() {
    for degrees in [5.0, 7.0, 10.0] {
        for thickness_mm in [1.0, 2.0, 5.0] {
            let design = twisted(degrees, Some(steel(thickness_mm)));
            let quick = make_judged(&design, Judging::Quick, &mut Unwatched).unwrap();
            let quick = quick.parts[0].predicted.as_ref().unwrap();
            let exact = made(&design).predicted.unwrap();
            assert!(quick.scored.is_empty() && exact.scored.is_empty());
            let factor = exact.strain / quick.strain;
            assert!((0.9..1.5).contains(&factor), "{degrees}° in {thickness_mm} mm: {factor}");
        }
    }
}

/// What edges that slide take away: strains in per cent, held and sliding.
#[test]
fn edges_that_slide_strain_the_sheet_less() {
    let slack = |mut design: Design| {
        design.panels[0].slides = true;
        made(&design)
    };
    for (design, verdicts) in [
        (twisted(20.0, Some(steel(1.0))), [Verdict::Roll; 2]),
        (wavy(60.0, 1.2, Some(spring(4.0))), [Verdict::WillNotBend, Verdict::BendsWithForce]),
    ] {
        let (held, loose) = (made(&design), slack(design));
        assert_eq!([held.checked.verdict, loose.checked.verdict], verdicts);
        let [tight, slid] = [&held, &loose].map(|part| part.predicted.as_ref().unwrap());
        assert!(slid.strain < 0.75 * tight.strain, "{} {}", slid.strain, tight.strain);
        // By tenths of a millimetre, and neither the surface nor its pattern is another one.
        assert_eq!(tight.slide_mm(), None);
        let slide_mm = slid.slide_mm().unwrap();
        assert!((0.1..1.0).contains(&slide_mm), "{slide_mm}");
        assert_eq!((&held.sheet, &held.flat), (&loose.sheet, &loose.flat));
    }
    // The rails slide, however short they are: the ends between them are let go.
    let short = [0.0, 1000.0].map(|y| [0.0, 300.0].map(|x| Point3::new(x, y, x * y / 6000.0)));
    let short = slack(strip(short.map(Vec::from), CurveKind::Polyline, Some(steel(2.0))));
    let free = |p: &Point3| (0.2..0.8).contains(&(p.y / 1000.0)) && p.x.abs() < 1.0;
    let sheet = short.predicted.unwrap().at_rest.unwrap();
    let line = sheet.positions.iter().filter(|p| free(p)).map(|p| p.z.abs());
    assert!(line.fold(0.0, f64::max) > 0.01);
    // Nothing is gained where the sheet hardly stretches.
    let cylinder = Design { material: Some(steel(1.0)), ..bent::cylinder(300.0) };
    let (held, loose) = (made(&cylinder), slack(cylinder));
    assert_eq!(held.checked.verdict, loose.checked.verdict);
}

/// A cylinder of a radius, mm, that turns by so much, degrees, with straight rulings of a length.
fn rolled(radius: f64, turn_deg: f64, length: f64, thickness_mm: f64) -> Part {
    let rail = |y: f64| {
        let angle = |n: usize| (TAU / 360.0) * turn_deg * n as f64 / 48.0;
        let at = |n| Point3::new(radius * sin(angle(n)), y, -radius * cos(angle(n)));
        (0..=48).map(at).collect::<Vec<_>>()
    };
    made(&strip([rail(0.0), rail(length)], CurveKind::Spline, Some(steel(thickness_mm))))
}

/// What shops roll every day, though it would be too much for a sheet that does not yield.
#[test]
fn metal_that_yields_is_rolled_to_developable_shapes() {
    for (radius, turn, length, thickness_mm) in [
        (100.0, 180.0, 300.0, 3.0),
        (100.0, 180.0, 1000.0, 3.0),
        (50.0, 180.0, 500.0, 1.0),
        (30.0, 90.0, 300.0, 1.0),
        (200.0, 90.0, 1000.0, 5.0),
    ] {
        let part = rolled(radius, turn, length, thickness_mm);
        let predicted = part.predicted.unwrap();
        assert_eq!(part.checked.verdict, Verdict::Roll, "R {radius}: {}", predicted.strain);
        assert_eq!(predicted.basis, Basis::Computed);
        // The moment is the plastic one, σ t²/4, of a plate: with σ = E ε / (1 − ν²).
        let moment = predicted.hold_moment_n().unwrap();
        let plastic = 210_000.0 * 0.0012 / (1.0 - 0.09) * thickness_mm * thickness_mm / 4.0;
        assert!((moment / plastic - 1.0).abs() < 0.01, "R {radius}: {moment} {plastic}");
        let radius_mm = 1.0 / predicted.curvature;
        assert!((radius_mm / radius - 1.0).abs() < 0.02, "R {radius}: {radius_mm}");
    }
    // Strips that wave are developable, too; steel that springs back does not take them.
    for (design, verdict) in [
        (wavy(80.0, 1.2, Some(steel(5.0))), Verdict::Roll),
        (wavy(80.0, 1.2, Some(spring(5.0))), Verdict::WillNotBend),
    ] {
        assert_eq!(made(&design).checked.verdict, verdict);
    }
}

/// Cones of 8 to 30 mm at the top, of steel of 1 to 3 mm: no net of 350 triangles follows their
/// tips, which a shop rolls all the same.
#[test]
fn sharp_cones_are_rolled() {
    for (height, bottom, top, thickness_mm) in [
        (100.0, 200.0, 8.0, 1.0),
        (200.0, 400.0, 16.0, 1.0),
        (200.0, 400.0, 30.0, 1.0),
        (600.0, 200.0, 16.0, 1.0),
        (100.0, 400.0, 30.0, 3.0),
    ] {
        let values = [("height", height), ("bottom", bottom), ("top", top)];
        let part = made(&template("cone", &values, steel(thickness_mm)));
        let of = (height, bottom, top);
        assert_eq!(part.checked.verdict, Verdict::Roll, "{of:?} {:?}", part.checked.findings);
    }
}
