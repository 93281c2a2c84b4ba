//! Curves that move until the sheet stretches by no more than a share of what it takes.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::check::FindingKind;
use sheetwright::design::{CurveUse, Design, DesignCurve, DesignPanel, PanelShape, Vary, VaryGoal};
use sheetwright::make::{Made, Part, make};
use sheetwright::material::Material;
use sheetwright::watch::Unwatched;
use sheetwright_shapes::materials::steel;

/// A strip of 4 mm, as stiff as steel, that springs back, and whose rails wave against one another.
fn wavy(wave: f64, share: Option<f64>, limit_mm: f64) -> Design {
    let rail = |name: &str, y: f64, z: f64| {
        DesignCurve::spline(
            name,
            [0, 1, 2, 3, 4].map(|n| {
                let side = if n % 2 == 0 { -1.0 } else { 1.0 };
                [250.0 * f64::from(n), y, z * side]
            }),
        )
    };
    let along = |rail: &str| CurveUse { name: rail.into(), reversed: false };
    let panel = DesignPanel::new("strip", PanelShape::Rails(["low", "high"].map(along)), 100);
    let vary = |share| Vary {
        goal: VaryGoal::Strain { share },
        limit_mm: Some(limit_mm),
        ..Vary::default()
    };
    Design {
        name: "wavy".into(),
        material: Some(Material { yield_strain: None, ..steel(4.0) }),
        curves: vec![rail("low", 0.0, wave), rail("high", 300.0, -wave)],
        panels: vec![panel],
        vary: share.map(vary).into_iter().collect(),
        ..Design::default()
    }
}

fn made(design: &Design) -> Made {
    make(design, &mut Unwatched).unwrap()
}

fn share(part: &Part) -> f64 {
    let predicted = part.predicted.as_ref().unwrap();
    predicted.strain / predicted.limits.strain
}

fn misses(part: &Part) -> bool {
    let is_missed = |kind: &FindingKind| matches!(kind, FindingKind::StrainNotReached { .. });
    part.checked.findings.iter().any(|finding| is_missed(&finding.kind))
}

#[test]
fn the_strain_comes_within_its_share_and_no_further_than_that_takes() {
    let drawn = share(&made(&wavy(20.0, None, 0.0)).parts[0]);
    assert!(drawn > 1.0, "{drawn}");
    let mut moved_before = f64::INFINITY;
    for wanted in [0.4, 0.8] {
        let made = made(&wavy(20.0, Some(wanted), 40.0));
        let part = &made.parts[0];
        let reached = share(part);
        assert!(reached <= wanted, "{wanted}: {reached}");
        assert!(!misses(part) && made.moved.is_some());
        let moved_mm = part.change().unwrap().moved_max_mm();
        assert!(moved_mm > 0.5 && moved_mm < moved_before, "{wanted}: {moved_mm} mm");
        moved_before = moved_mm;
    }
}

#[test]
fn a_goal_out_of_reach_is_said_with_what_is_left() {
    let made = made(&wavy(20.0, Some(0.4), 1.0));
    let part = &made.parts[0];
    assert!(misses(part) && share(part) > 0.4);
    let is_of_angle = |kind: &FindingKind| matches!(kind, FindingKind::WarpNotReached { .. });
    assert!(!part.checked.findings.iter().any(|finding| is_of_angle(&finding.kind)));
    assert!(part.change().unwrap().moved_max_mm() <= 1.0 + 1e-9);
}

#[test]
fn what_stretches_less_stays_as_it_is_drawn() {
    let made = made(&wavy(3.0, Some(0.8), 40.0));
    assert!(made.moved.is_none() && !misses(&made.parts[0]));
}
