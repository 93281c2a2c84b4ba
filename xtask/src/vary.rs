//! The page that compares moved curves with \[G14\], and the models of its picture.

use sheetwright::boundary::size_of;
use sheetwright::design::{Design, MovedBy, PanelShape};
use sheetwright::make::{Made, Part, make};
use sheetwright::watch::Unwatched;
use sheetwright_files::{ReadOptions, read_input};
use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write;

/// A model of \[G14\] and the example like it.
struct Model {
    name: &'static str,
    /// The total twist before and after, in its table 2.
    twist: [f64; 2],
    /// The curves of the example that are most like those that moved in the paper, and more of
    /// them.
    alike: &'static [&'static [&'static str]],
    /// Its time, and ours by points and by samples, seconds.
    times: [f64; 3],
}

const MODELS: [Model; 3] = [
    Model {
        name: "mouse",
        twist: [0.306_945_2, 0.305_091_4],
        alike: &[&["left", "right"]],
        times: [8.5, 0.09, 0.24],
    },
    Model {
        name: "hat",
        twist: [0.841_434_07, 0.839_611_2],
        alike: &[&["brim"], &["brim", "crown"]],
        times: [3.7, 0.05, 0.12],
    },
    Model {
        name: "flower",
        twist: [0.786_546_3, 0.782_292_3],
        alike: &[&["petal-1", "petal-5"]],
        times: [7.2, 0.05, 0.65],
    },
];
/// The bar: so many times the gain of the paper.
const TIMES: f64 = 10.0;
/// Shares of ε.
const SHARES: [f64; 4] = [1.0, 0.5, 0.25, 0.125];
/// What moves, and the weight of folds if it is not the design's.
const WAYS: [(MovedBy, Option<f64>); 3] =
    [(MovedBy::Points, None), (MovedBy::Samples, None), (MovedBy::Samples, Some(0.0))];

/// Writes `docs/vary-compared.md`.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    let path = crate::root().join("docs/vary-compared.md");
    std::fs::write(&path, page()?)?;
    println!("wrote {}", path.display());
    Ok(())
}

/// The examples with their curves moved, for the picture.
pub(crate) fn drawn() -> Result<Vec<Made>, Box<dyn Error>> {
    MODELS.iter().map(|model| Ok(make(&example(model)?, &mut Unwatched)?)).collect()
}

fn example(model: &Model) -> Result<Design, Box<dyn Error>> {
    let path = crate::root().join(format!("examples/{}.sheet.json", model.name));
    Ok(read_input(&path, &ReadOptions::default())?)
}

/// The design with its curves moved by a share of its budget.
fn varied(
    design: &Design,
    (by, fold): (MovedBy, Option<f64>),
    share: f64,
) -> Result<Made, Box<dyn Error>> {
    let mut design = design.clone();
    for vary in &mut design.vary {
        vary.by = by;
        vary.budget_mm = vary.budget_mm.map(|mm| share * mm);
    }
    for panel in &mut design.panels {
        panel.fold = fold.unwrap_or(panel.fold);
    }
    Ok(make(&design, &mut Unwatched)?)
}

/// The total twist of all panels, before and after.
fn twist(made: &Made) -> [f64; 2] {
    let of = |panel: &Part| panel.measures.twist_total;
    let before = |panel: &Part| panel.change().map_or(of(panel), |c| of(&c.before));
    [made.parts.iter().map(before).sum(), made.parts.iter().map(of).sum()]
}

fn gain([before, after]: [f64; 2]) -> f64 {
    1.0 - after / before
}

/// How many curves two panels share.
fn shared(design: &Design) -> usize {
    let mut uses: BTreeMap<&str, usize> = BTreeMap::new();
    for panel in &design.panels {
        let parts: Vec<_> = match &panel.shape {
            PanelShape::Rails(rails) => rails.iter().collect(),
            PanelShape::Loops { outer, holes } => {
                std::iter::once(outer).chain(holes).flatten().collect()
            }
            PanelShape::Join(_) | PanelShape::Mesh(_) => Vec::new(),
        };
        parts.iter().for_each(|part| *uses.entry(part.name.as_str()).or_default() += 1);
    }
    uses.values().filter(|&&uses| uses == 2).count()
}

fn page() -> Result<String, Box<dyn Error>> {
    let [mut gains, mut shares, mut alike, mut times, mut brim] = [const { String::new() }; 5];
    let mut seams = 0;
    // By ways and shares, how many models reach the bar.
    let mut reached = [[0; SHARES.len()]; WAYS.len()];
    for model in &MODELS {
        let design = example(model)?;
        seams += shared(&design);
        let bar = TIMES * gain(model.twist);
        for (way, reached) in WAYS.into_iter().zip(&mut reached) {
            let mut cells = String::new();
            let mut size = 0.0;
            let mut fold = 0.0;
            for (share, reached) in SHARES.into_iter().zip(reached) {
                let made = varied(&design, way, share)?;
                size = size_of(
                    before(&made).flat_map(|panel| panel.sheet.mesh().positions().iter().copied()),
                );
                fold = made.parts.first().and_then(Part::found).map_or(0.0, |found| found.fold);
                let found = gain(twist(&made));
                let bold = if found >= bar { "**" } else { "" };
                *reached += usize::from(found >= bar);
                write!(cells, " | {bold}{:.2} %{bold}", 100.0 * found)?;
                if share == 1.0 && way == WAYS[0] {
                    let [theirs, ours] = [model.twist, twist(&made)];
                    writeln!(
                        gains,
                        "| {} | {:.4} → {:.4} | {:.2} % | {:.4} → {:.4} | {:.2} % | {:.0} |",
                        model.name,
                        theirs[0],
                        theirs[1],
                        100.0 * gain(theirs),
                        ours[0],
                        ours[1],
                        100.0 * found,
                        (found / gain(theirs)).floor(),
                    )?;
                }
            }
            let budget = design.vary.first().and_then(|vary| vary.budget_mm).unwrap_or_default();
            let by = match way.0 {
                MovedBy::Points => "points",
                MovedBy::Samples => "samples",
            };
            let of_size = 100.0 * budget / size;
            let name = model.name;
            writeln!(shares, "| {name} | {budget} mm | {of_size:.1} % | {by} | {fold}{cells} |")?;
        }
        for curves in model.alike {
            let mut some = design.clone();
            let names: Vec<String> = curves.iter().map(|name| (*name).to_owned()).collect();
            some.vary.iter_mut().for_each(|vary| vary.curves.clone_from(&names));
            let made = varied(&some, WAYS[WAYS.len() - 1], 1.0)?;
            let found = gain(twist(&made));
            let (name, curves) = (model.name, curves.join("`, `"));
            let times = (found / gain(model.twist)).floor();
            writeln!(alike, "| {name} | `{curves}` | {:.2} % | {times:.0} |", 100.0 * found)?;
        }
        if let Some(panel) = design.panels.iter().position(|panel| panel.name == "brim") {
            let made = varied(&design, WAYS[0], 1.0)?;
            let twists: Vec<f64> = before(&made).map(|panel| panel.measures.twist_total).collect();
            brim = format!("{:.0} %", 100.0 * twists[panel] / twists.iter().sum::<f64>());
        }
        let [theirs, points, samples] = model.times;
        writeln!(times, "| {} | {theirs} | {points:.2} | {samples:.2} |", model.name)?;
    }
    let least = reached.map(|row| {
        let least = row.iter().take_while(|&&models| models == MODELS.len()).count();
        ["with no ε", "with ε", "down to ε/2", "down to ε/4", "down to ε/8"][least]
    });
    let reached = format!(
        "{} by points, {} by samples, and {} by samples for twist alone",
        least[0], least[1], least[2]
    );
    Ok(TEXT
        .replace("{GAINS}", gains.trim_end())
        .replace("{SHARES}", shares.trim_end())
        .replace("{ALIKE}", alike.trim_end())
        .replace("{BRIM}", &brim)
        .replace("{TIMES}", times.trim_end())
        .replace("{REACHED}", &reached)
        .replace("{SHARED}", &seams.to_string()))
}

/// The panels before their curves moved.
fn before(made: &Made) -> impl Iterator<Item = &Part> {
    made.parts.iter().map(|panel| panel.change().map_or(panel, |change| &change.before))
}

const TEXT: &str = include_str!("vary.md");

#[cfg(test)]
mod tests {
    #[test]
    fn the_page_is_that_of_the_code() {
        let path = crate::root().join("docs/vary-compared.md");
        let kept = std::fs::read_to_string(path).unwrap_or_default();
        let current = super::page().unwrap_or_default();
        assert!(kept == current, "docs/vary-compared.md differs: run `cargo xtask vary`");
    }
}
