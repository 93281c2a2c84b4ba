//! The page about planar quads and smooth strips, with what was measured on the examples.

use sheetwright::boundary::size_of;
use sheetwright::design::Design;
use sheetwright::make::{Part, make};
use sheetwright::math::to_deg;
use sheetwright::quads::PlanarEnd;
use sheetwright::watch::Unwatched;
use sheetwright_files::{PanelQuads, ReadOptions, design_from_template, read_input};
use std::error::Error;
use std::fmt::Write;

/// The examples: the file, the samples if not its own, and whether its panels have a row each.
const EXAMPLES: [(&str, Option<usize>, bool); 7] = [
    ("three-cones", None, true),
    ("ubc-fishing-vessel", None, true),
    ("square-to-round", None, true),
    ("reducer", None, true),
    ("mouse", None, false),
    ("hat", None, false),
    ("flower", None, false),
];
/// Examples with more samples than their designs have.
const FINER: [(&str, usize); 2] = [("hat", 200), ("flower", 200)];
const TEMPLATES: [&str; 3] = ["hemisphere", "revolution", "dome"];

/// Writes `docs/quads.md`.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    let path = crate::root().join("docs/quads.md");
    std::fs::write(&path, page()?)?;
    println!("wrote {}", path.display());
    Ok(())
}

fn page() -> Result<String, Box<dyn Error>> {
    let mut table = String::new();
    for (name, samples, each) in EXAMPLES {
        rows(&mut table, name, &example(name, samples)?, each)?;
    }
    for (name, samples) in FINER {
        let title = format!("{name}, {samples} samples");
        rows(&mut table, &title, &example(name, Some(samples))?, false)?;
    }
    for name in TEMPLATES {
        let design = design_from_template(name, &[])?;
        rows(&mut table, &format!("{name} (template)"), &design, false)?;
    }
    Ok(TEXT.replace("{TABLE}", table.trim_end()))
}

fn example(name: &str, samples: Option<usize>) -> Result<Design, Box<dyn Error>> {
    let path = crate::root().join(format!("examples/{name}.sheet.json"));
    Ok(read_input(&path, &ReadOptions { samples, ..ReadOptions::default() })?)
}

/// A row for each panel, or one with the worst of all.
fn rows(table: &mut String, name: &str, design: &Design, each: bool) -> Result<(), Box<dyn Error>> {
    let made = make(design, &mut Unwatched)?;
    let measured: Vec<(&Part, PanelQuads)> =
        made.parts.iter().filter_map(|part| Some((part, PanelQuads::new(part.found()?)))).collect();
    if each && measured.len() > 1 {
        for one in &measured {
            row(table, &format!("{name}, {}", one.0.name), std::slice::from_ref(one))?;
        }
        return Ok(());
    }
    let title = match measured.len() {
        1 => name.to_owned(),
        panels => format!("{name}, {panels} panels"),
    };
    row(table, &title, &measured)
}

fn row(
    table: &mut String,
    name: &str,
    measured: &[(&Part, PanelQuads)],
) -> Result<(), Box<dyn Error>> {
    let worst = |of: &dyn Fn(&Part, &PanelQuads) -> f64| {
        measured.iter().map(|(panel, quads)| of(panel, quads)).fold(0.0, f64::max)
    };
    let share = |of: &dyn Fn(&PanelQuads) -> f64| {
        let largest = worst(&|panel, quads| {
            of(quads) / size_of(panel.sheet.mesh().positions().iter().copied())
        });
        if largest < 1e-15 { "0".to_owned() } else { format!("{largest:.0e}") }
    };
    let faces = |corners: usize| -> usize {
        let of = |q: &PanelQuads| q.planar.mesh.faces().filter(|f| f.len() == corners).count();
        measured.iter().map(|(_, quads)| of(quads)).sum()
    };
    let larger: usize = measured.iter().map(|(_, q)| q.planar.mesh.larger_polygons()).sum();
    let on = measured.iter().filter(|(_, q)| q.planar.end == PlanarEnd::OnOutline).count();
    let is_planar =
        |q: &PanelQuads| matches!(q.planar.end, PlanarEnd::OnOutline | PlanarEnd::OffOutline);
    let unfinished = measured.iter().filter(|(_, q)| !is_planar(q)).count();
    let on = match (on, unfinished) {
        (on, 0) => format!("{on} of {}", measured.len()),
        (on, _) => format!("{on} of {}, {unfinished} not planar", measured.len()),
    };
    writeln!(
        table,
        "| {name} | {:.1}° | {}, {} | {larger} | {} | {} | {:.2} mm | {on} | {} | {} | {:.2}° |",
        worst(&|panel, _| to_deg(panel.measures.warp_max)),
        faces(4),
        faces(3),
        share(&|q| q.planar.uneven_before_mm),
        share(&|q| q.planar.uneven_after_mm),
        worst(&|_, q| q.planar.moved_max_mm),
        share(&|q| q.planar.off_max_mm),
        share(&|q| q.smooth.deviation_max_mm),
        worst(&|_, q| to_deg(q.smooth.warp_max)),
    )?;
    Ok(())
}

const TEXT: &str = include_str!("quads.md");

#[cfg(test)]
mod tests {
    #[test]
    fn the_page_is_that_of_the_code() {
        let page = super::page().unwrap();
        let path = crate::root().join("docs/quads.md");
        if std::env::var_os("SHEETWRIGHT_REWRITE").is_some() {
            std::fs::write(&path, &page).unwrap();
        }
        let kept = std::fs::read(path).unwrap_or_default();
        assert!(
            kept == page.as_bytes(),
            "docs/quads.md differs from the code: run cargo xtask quads"
        );
    }
}
