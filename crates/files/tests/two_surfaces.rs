//! Boundaries that two surfaces fit about as well: both are found, and a person chooses.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::check::FindingKind;
use sheetwright::make::{Found, Made, Part, make};
use sheetwright::math::Point3;
use sheetwright::triangulate::WhichSurface;
use sheetwright::watch::Unwatched;
use sheetwright::{Design, Verdict};
use sheetwright_files::{Format, PdfOptions, ReadOptions, output_files, read_input};
use std::path::Path;

/// The closed curve on a cylinder of radius 300 mm.
fn design(samples: Option<usize>, which: WhichSurface) -> Design {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus/good/two-surfaces.csv");
    let options = ReadOptions { samples, which: Some(which), ..ReadOptions::default() };
    read_input(&file, &options).unwrap()
}

fn made(design: &Design) -> Made {
    make(design, &mut Unwatched).unwrap()
}

fn found(made: &Made) -> (&Part, &Found) {
    (&made.parts[0], made.parts[0].found().unwrap())
}

/// Whether the samples that rungs of a part join lie on a cylinder: the rungs are parallel to its
/// axis, along y.
fn is_cylinder(part: &Part) -> bool {
    let ends = part.sheet.rung_ends();
    let steep = |pair: &&[_; 2]| {
        let [a, b] = pair.map(|v| part.sheet.mesh().position(v));
        let along = b - a;
        along.y.abs() < 0.95 * along.length()
    };
    ends.iter().filter(steep).count() < ends.len() / 20
}

#[test]
fn both_are_found_at_every_sampling_and_shown() {
    for samples in [None, Some(100), Some(200), Some(400), Some(800)] {
        let first = made(&design(samples, WhichSurface::Cheapest));
        let (part, surface) = found(&first);
        let other = surface.other.as_ref().unwrap();
        assert_ne!(is_cylinder(part), is_cylinder(&other.part), "{samples:?}");
        assert!((60.0..120.0).contains(&other.apart_mm), "{samples:?} {}", other.apart_mm);
        assert_eq!(
            (part.checked.verdict, other.part.checked.verdict),
            (Verdict::Bends, Verdict::Bends)
        );
        let is_said = |kind: &FindingKind| matches!(kind, FindingKind::TwoSurfaces { .. });
        assert!(part.checked.findings.iter().any(|finding| is_said(&finding.kind)));
        let second = made(&design(samples, WhichSurface::Other));
        let (chosen, _) = found(&second);
        assert_eq!(chosen.sheet, other.part.sheet);
        assert_eq!(chosen.checked.verdict, other.part.checked.verdict);
    }
}

#[test]
fn a_point_chooses_and_the_price_is_that_of_the_surface_alone() {
    let first = design(None, WhichSurface::Cheapest);
    let made_first = made(&first);
    let (part, surface) = found(&made_first);
    let other = surface.other.as_ref().unwrap();
    for wanted in [part, &other.part] {
        let rungs = wanted.sheet.rung_ends();
        let [a, b] = rungs[rungs.len() / 2].map(|v| wanted.sheet.mesh().position(v));
        let middle = a + (b - a) * 0.5;
        // The hand is off by 2 mm.
        let mut near = first.clone();
        near.panels[0].near = vec![Point3::new(middle.x, middle.y, middle.z + 2.0)];
        let made_near = made(&near);
        let (chosen, chosen_surface) = found(&made_near);
        assert_eq!(is_cylinder(chosen), is_cylinder(wanted));
        let price = |found: &Found| found.triangulation.price_without_hints();
        let wanted_price = price(wanted.found().unwrap());
        assert!((price(chosen_surface) - wanted_price).abs() <= 0.02 * wanted_price);
    }
}

#[test]
fn who_asks_for_the_other_of_one_is_told_and_gets_the_one() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus/good/quarter-cylinder.csv");
    let other = ReadOptions { which: Some(WhichSurface::Other), ..ReadOptions::default() };
    let asked = made(&read_input(&file, &other).unwrap());
    let plain = made(&read_input(&file, &ReadOptions::default()).unwrap());
    assert_eq!(asked.parts[0].sheet, plain.parts[0].sheet);
    let is_said = |kind: &FindingKind| matches!(kind, FindingKind::NoOtherSurface);
    let said = |made: &Made| made.parts[0].checked.findings.iter().any(|f| is_said(&f.kind));
    assert!(said(&asked) && !said(&plain));
}

#[test]
fn the_report_shows_the_other_surface() {
    let made = made(&design(None, WhichSurface::Cheapest));
    let outputs = output_files(&made, &[Format::Report], &PdfOptions::default()).unwrap();
    let page = outputs.files.iter().find(|output| output.name == "report.html").unwrap();
    let page = String::from_utf8(page.bytes.clone()).unwrap();
    assert!(page.contains("The other surface through this boundary"));
}
