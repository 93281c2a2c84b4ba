//! Templates at their defaults bend in the sheet that they are usually made of.
#![allow(clippy::unwrap_used)] // Whatever fails here is a failed test.

use sheetwright::check::Verdict;
use sheetwright::make::make;
use sheetwright::template::catalogue;
use sheetwright::watch::Unwatched;
use sheetwright_files::design_from_template;

#[test]
fn panels_bend_in_their_usual_sheet() {
    let mut count = 0;
    for template in catalogue().iter().filter(|template| template.sheet.is_some()) {
        count += 1;
        let design = design_from_template(template.name, &[]).unwrap();
        let name = design.material.as_ref().map(|material| &material.name[..]);
        assert_eq!(name, template.sheet, "{}", template.name);
        for panel in &make(&design, &mut Unwatched).unwrap().parts {
            let (name, findings) = (&panel.name, &panel.checked.findings);
            // Plywood of 9 mm is bent round the ramp with force.
            let is_ramp = template.name == "ramp" && panel.name == "surface";
            let wanted = if is_ramp { Verdict::BendsWithForce } else { Verdict::Bends };
            assert_eq!(panel.checked.verdict, wanted, "{}: {name}", template.name);
            assert!(findings.is_empty() || is_ramp, "{}: {name}: {findings:?}", template.name);
        }
    }
    assert_eq!(count, 8);
}
