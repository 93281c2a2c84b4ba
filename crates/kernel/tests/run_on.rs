//! Strips whose rails run on, on surfaces that are known.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright::check::{Finding, FindingKind};
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{
    CurveUse, Design, DesignCurve, DesignPanel, Join, PanelMethod, PanelShape,
};
use sheetwright::make::{Judging, Part, make, make_judged};
use sheetwright::math::{Point3, cos, from_deg, sin, to_deg};
use sheetwright::sample::PanelCause;
use sheetwright::watch::Unwatched;
use sheetwright_shapes::random::Random;

const RADIUS: f64 = 100.0;

/// A rail on the cylinder of this radius about the axis z, by angles in degrees and heights.
fn rail(name: &str, from: [f64; 2], to: [f64; 2]) -> DesignCurve {
    let points = (0..=24)
        .map(|n| {
            let t = f64::from(n) / 24.0;
            let (angle, z) = (from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]));
            let a = from_deg(angle);
            CurvePoint::smooth(Point3::new(RADIUS * cos(a), RADIUS * sin(a), z))
        })
        .collect();
    DesignCurve { name: name.into(), kind: Some(CurveKind::Spline), closed: false, points }
}

fn design(rails: [DesignCurve; 2], method: PanelMethod, run_on: bool) -> Design {
    let uses = rails.each_ref().map(|r| CurveUse { name: r.name.clone(), reversed: false });
    let panel =
        DesignPanel { method, run_on, ..DesignPanel::new("strip", PanelShape::Rails(uses), 80) };
    let curves = rails.to_vec();
    Design {
        name: "strip".into(),
        material: None,
        curves,
        panels: vec![panel],
        ..Design::default()
    }
}

fn made(rails: [DesignCurve; 2], method: PanelMethod, run_on: bool) -> Part {
    let design = design(rails, method, run_on);
    make_judged(&design, Judging::Quick, &mut Unwatched).unwrap().parts.remove(0)
}

fn off_cylinder(p: Point3) -> f64 {
    ((p.x * p.x + p.y * p.y).sqrt() - RADIUS).abs()
}

/// Rails round a cylinder whose ends lie askew: the rulings of the cylinder leave through the ends,
/// and with rails that run on, the strip is the cylinder's. With straight ends, rulings fan out
/// from two of its corners: as little twisted, but with a point at each, round which the sheet
/// turns by a third of a right angle.
#[test]
fn a_strip_askew_on_a_cylinder_becomes_the_cylinders() {
    for method in [PanelMethod::Optimal, PanelMethod::Bridge, PanelMethod::Rails] {
        let rails =
            [rail("low", [0.0, 0.0], [80.0, 0.0]), rail("high", [30.0, 90.0], [110.0, 90.0])];
        let straight = made(rails.clone(), method, false);
        let run_on = made(rails, method, true);
        let off = |panel: &Part| {
            panel
                .found()
                .unwrap()
                .boundary
                .positions()
                .into_iter()
                .map(off_cylinder)
                .fold(0.0, f64::max)
        };
        let middles = |panel: &Part| {
            let middle = panel.measures.rungs.iter().map(|r| off_cylinder(r.middle));
            middle.fold(0.0, f64::max)
        };
        let [a, b] = [&straight, &run_on].map(|panel| to_deg(panel.measures.warp_max));
        println!(
            "{method:?}: {a:.3}° to {b:.3}°, samples {:.3} mm and rungs {:.3} mm from the \
             cylinder, with straight ends {:.3} mm; radius {:.1} mm and {:.1} mm",
            off(&run_on),
            middles(&run_on),
            middles(&straight),
            run_on.measures.bend_radius_min_mm,
            straight.measures.bend_radius_min_mm
        );
        assert!(run_on.found().unwrap().boundary.len() > straight.found().unwrap().boundary.len());
        // A natural spline is a little straighter near its ends, so the rails run on a little wide.
        assert!(off(&run_on) < 0.6 && middles(&run_on) < 0.1 * middles(&straight));
        // The radius is measured apart from points, so by itself it does not tell the two strips
        // apart.
        let points = straight.measures.apexes.iter().map(|apex| to_deg(apex.turn));
        assert_eq!(points.filter(|turn| *turn > 25.0).count(), 2, "{:?}", straight.measures.apexes);
        assert_eq!(run_on.measures.apexes, []);
        // The new ends bulge from the cylinder and come back to it at the corners, where they are
        // bent most: the developable surface through such an end and its rail, found ruling by
        // ruling from where tangents and ruling lie in one plane, has 69.3 mm at its tightest and
        // 75 mm or less over 4 mm. As a roll of the least depth that is 84 mm, at 160 and 320
        // samples too.
        let radius = run_on.measures.bend_radius_min_mm;
        assert!((0.78 * RADIUS..0.9 * RADIUS).contains(&radius), "{radius}");
        assert!(b < 1.0);
        assert!(run_on.measures.length_error_max < 1e-12 && run_on.flat.overlap.is_none());
    }
}

/// Where rails meet there is no end to leave through.
#[test]
fn rails_that_meet_do_not_run_on_there() {
    let rails = [rail("low", [0.0, 0.0], [80.0, 0.0]), rail("high", [0.0, 0.0], [110.0, 90.0])];
    let straight = made(rails.clone(), PanelMethod::Rails, false);
    let run_on = made(rails, PanelMethod::Rails, true);
    let first = |panel: &Part| panel.found().unwrap().boundary.samples()[..20].to_vec();
    assert_eq!(first(&run_on), first(&straight));
}

#[test]
fn only_rails_of_their_own_run_on() {
    let rails = [rail("low", [0.0, 0.0], [80.0, 0.0]), rail("high", [0.0, 90.0], [80.0, 90.0])];
    let mut whole = design(rails.clone(), PanelMethod::Optimal, true);
    let outer = vec![CurveUse { name: "low".into(), reversed: false }];
    whole.panels[0].shape = PanelShape::Loops { outer, holes: Vec::new() };
    assert_eq!(make(&whole, &mut Unwatched).unwrap_err().cause, PanelCause::RunOn.into());

    let mut joined = design(rails, PanelMethod::Optimal, true);
    joined.curves.push(rail("top", [0.0, 180.0], [80.0, 180.0]));
    let uses = ["high", "top"].map(|name| CurveUse { name: name.into(), reversed: false });
    let shape = PanelShape::Rails(uses);
    let other =
        DesignPanel { name: "upper".into(), shape, run_on: false, ..joined.panels[0].clone() };
    joined.panels.push(other);
    let join = Join {
        parts: vec!["strip".into(), "upper".into()],
        smooth: Default::default(),
        within: Default::default(),
        keep_parts: false,
    };
    let shape = PanelShape::Join(join);
    let both =
        DesignPanel { name: "both".into(), shape, run_on: false, ..joined.panels[0].clone() };
    joined.panels.push(both);
    assert_eq!(make(&joined, &mut Unwatched).unwrap_err().cause, PanelCause::RunOn.into());
    joined.panels[0].run_on = false;
    assert!(make(&joined, &mut Unwatched).is_ok());
}

/// Whatever the rails, what is made is exact, and the rails themselves stay.
#[test]
fn wild_rails_run_on_without_harm() {
    let (mut ran, mut refused) = (0, 0);
    for seed in 0..150 {
        let mut random = Random::new(seed);
        let mut wild = |name: &str, y: f64| {
            let points = (0..5)
                .map(|n| {
                    let [a, b, c] = [0; 3].map(|_| random.between(-40.0, 40.0));
                    CurvePoint::smooth(Point3::new(100.0 * f64::from(n) + a, y + b, c))
                })
                .collect();
            let kind = Some([CurveKind::Spline, CurveKind::BSpline][(seed % 2) as usize]);
            DesignCurve { name: name.into(), kind, closed: false, points }
        };
        let rails = [wild("low", 0.0), wild("high", 150.0)];
        let method = [PanelMethod::Optimal, PanelMethod::Rails][(seed % 3 % 2) as usize];
        let panel = made(rails.clone(), method, true);
        assert!(panel.measures.length_error_max < 1e-9, "{seed}");
        let straight = made(rails, method, false);
        let samples = panel.found().unwrap().boundary.positions();
        assert!(
            straight.found().unwrap().boundary.positions().iter().all(|p| samples.contains(p)),
            "{seed}"
        );
        ran += usize::from(samples.len() > straight.found().unwrap().boundary.len());
        let can_not =
            |finding: &&Finding| matches!(finding.kind, FindingKind::StayedStraight { .. });
        if let Some(finding) = panel.checked.findings.iter().find(can_not) {
            println!("{seed}: {:?}", finding.kind);
            assert_eq!(panel.found().unwrap().boundary, straight.found().unwrap().boundary);
            refused += 1;
        }
    }
    println!("{ran} ran on, {refused} were refused");
    assert!(ran > 100 && (1..10).contains(&refused));
}
