//! The page about composites and its example: three cones joined to one sheet.

use sheetwright::design::PanelMethod;
use sheetwright::make::{Made, Part, make};
use sheetwright::math::to_deg;
use sheetwright::watch::Unwatched;
use sheetwright_files::write_design;
use sheetwright_shapes::three_cones::design;
use std::error::Error;
use std::fmt::Write;

/// Samples of the example, and of the row that the page speaks of.
const SAMPLES: usize = 300;
/// Samples of the picture: enough for a smooth outline, few enough for a small file.
const DRAWN: usize = 150;

/// Writes `docs/composites.md` and `examples/three-cones.sheet.json`.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    for (name, bytes) in files()? {
        let path = crate::root().join(name);
        std::fs::write(&path, bytes)?;
        println!("wrote {}", path.display());
    }
    Ok(())
}

/// A file of the checkout and what it should hold.
type Kept = (&'static str, Vec<u8>);

fn files() -> Result<[Kept; 2], Box<dyn Error>> {
    Ok([
        ("docs/composites.md", page()?.into_bytes()),
        ("examples/three-cones.sheet.json", write_design(&design(SAMPLES))),
    ])
}

/// The three cones joined, with the best triangulation of a method.
fn joined(samples: usize, method: PanelMethod, fold: f64) -> Result<Made, Box<dyn Error>> {
    let mut design = design(samples);
    for panel in &mut design.panels {
        (panel.method, panel.fold) = (method, fold);
    }
    Ok(make(&design, &mut Unwatched)?)
}

/// The joined panel for the picture: with the best of all triangulations, and of the bridges.
pub(crate) fn drawn() -> Result<[Made; 2], Box<dyn Error>> {
    let fold = sheetwright::cost::DEFAULT_FOLD;
    Ok([joined(DRAWN, PanelMethod::Optimal, fold)?, joined(DRAWN, PanelMethod::Bridge, fold)?])
}

fn page() -> Result<String, Box<dyn Error>> {
    let mut table = String::new();
    let mut spoken_of = String::new();
    for fold in [0.0, sheetwright::cost::DEFAULT_FOLD] {
        for samples in [100, 200, SAMPLES] {
            let best = joined(samples, PanelMethod::Optimal, fold)?;
            let bridge = joined(samples, PanelMethod::Bridge, fold)?;
            let [best, bridge] = [&best.parts[0], &bridge.parts[0]];
            let ratio = bridge.measures.twist_total / best.measures.twist_total;
            let cell = |panel: &Part| {
                format!(
                    "{:.4} | {:.1}°",
                    panel.measures.twist_total,
                    to_deg(panel.measures.warp_max)
                )
            };
            let (left, right) = (cell(best), cell(bridge));
            writeln!(table, "| {fold} | {samples} | {left} | {right} | {ratio:.0} |")?;
            if fold == 0.0 && samples == SAMPLES {
                spoken_of = format!("{ratio:.0}");
            }
        }
    }
    Ok(TEXT.replace("{TABLE}", table.trim_end()).replace("{RATIO}", &spoken_of))
}

const TEXT: &str = include_str!("composites.md");

#[cfg(test)]
mod tests {
    #[test]
    fn the_page_and_the_example_are_those_of_the_code() {
        for (name, bytes) in super::files().unwrap() {
            let kept = std::fs::read(crate::root().join(name)).unwrap_or_default();
            assert!(kept == bytes, "{name} differs from the code: run cargo xtask composites");
        }
    }
}
