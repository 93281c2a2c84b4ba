//! Verdicts on the boundaries of the corpus with twice the samples again and again.

use sheetwright::boundary::PlaneChoice;
use sheetwright::check::Verdict;
use sheetwright::make::make;
use sheetwright::watch::Unwatched;
use sheetwright_files::{ReadOptions, material_named, read_input, verdict_word};
use std::error::Error;
use std::fmt::Write;
use std::path::PathBuf;

/// Samples of each panel.
const SAMPLES: [usize; 5] = [100, 200, 400, 800, 1600];
/// From so many samples on, few verdicts may be "can't tell".
const FROM: usize = 400;
/// The sheet beside the one that a boundary names or not.
const SHEET: &str = "steel-1mm";

/// A boundary of the corpus in one sheet, and its verdicts.
pub(super) struct Doubled {
    name: String,
    sheet: &'static str,
    verdicts: [Verdict; SAMPLES.len()],
}

impl Doubled {
    /// Whether the verdicts differ, but for "can't tell".
    fn flips(&self) -> bool {
        let mut told = self.verdicts.iter().filter(|&&verdict| verdict != Verdict::Undecided);
        let first = told.next();
        told.any(|verdict| Some(verdict) != first)
    }
}

/// The boundaries of the corpus, as they are and in steel.
pub(super) fn boundaries() -> Result<Vec<Doubled>, Box<dyn Error>> {
    let mut doubled = Vec::new();
    for path in paths()? {
        let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let name = file.split('.').next().unwrap_or(&file).to_owned();
        let facts = std::fs::read_to_string(path.with_file_name(format!("{name}.facts.json")))?;
        let plane = facts.contains("\"plane\": \"none\"").then_some(PlaneChoice::None);
        for sheet in ["its own", SHEET] {
            let mut verdicts = [Verdict::Undecided; SAMPLES.len()];
            for (verdict, samples) in verdicts.iter_mut().zip(SAMPLES) {
                let samples = Some(samples);
                let options = ReadOptions { plane, samples, ..ReadOptions::default() };
                let mut design = read_input(&path, &options)?;
                if sheet == SHEET {
                    design.material = material_named(SHEET, &[]);
                }
                *verdict = make(&design, &mut Unwatched)?.parts[0].checked.verdict;
            }
            doubled.push(Doubled { name: name.clone(), sheet, verdicts });
            println!("{}", line(&doubled[doubled.len() - 1]));
        }
    }
    Ok(doubled)
}

/// The files of the corpus with curves, in the order of their names.
fn paths() -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let entries = std::fs::read_dir(crate::root().join("corpus/good"))?;
    let is_boundary = |path: &PathBuf| {
        let name = path.to_string_lossy();
        name.ends_with(".csv") || name.ends_with(".sheet.json")
    };
    let mut paths: Vec<PathBuf> =
        entries.filter_map(|entry| Some(entry.ok()?.path())).filter(is_boundary).collect();
    paths.sort();
    Ok(paths)
}

fn line(doubled: &Doubled) -> String {
    let words = doubled.verdicts.map(verdict_word).join(" | ");
    format!("| {} | {} | {words} |", doubled.name, doubled.sheet)
}

/// The table of those whose verdicts are not all the same, or that there are none.
pub(super) fn table(doubled: &[Doubled]) -> Result<String, std::fmt::Error> {
    let differ = |d: &&Doubled| d.verdicts.iter().any(|verdict| *verdict != d.verdicts[0]);
    let lines: Vec<String> = doubled.iter().filter(differ).map(line).collect();
    if lines.is_empty() {
        return Ok("Each of them has one verdict throughout.".to_owned());
    }
    let samples = SAMPLES.map(|count| count.to_string()).join(" | ");
    let mut text =
        "Boundaries that are not in the table have one verdict throughout.\n\n".to_owned();
    writeln!(text, "| boundary | sheet | {samples} |")?;
    writeln!(text, "|---|---{}|", "|---".repeat(SAMPLES.len()))?;
    text.push_str(&lines.join("\n"));
    Ok(text)
}

/// How many verdicts change, and how often it says "can't tell".
pub(super) fn summary(doubled: &[Doubled]) -> Result<String, std::fmt::Error> {
    let flips: Vec<String> = doubled
        .iter()
        .filter(|d| d.flips())
        .map(|d| format!("`{}` ({})", d.name, d.sheet))
        .collect();
    let late = || {
        let late = |d: &Doubled| d.verdicts.into_iter().zip(SAMPLES).filter(|&(_, m)| m >= FROM);
        doubled.iter().flat_map(late).map(|(verdict, _)| verdict)
    };
    let unsure = late().filter(|&verdict| verdict == Verdict::Undecided).count();
    let mut text = String::new();
    write!(
        text,
        "Of {} sheets, {} change their verdict otherwise than to or from \"can't tell\"",
        doubled.len(),
        flips.len()
    )?;
    if !flips.is_empty() {
        write!(text, ":\n{}", flips.join(", "))?;
    }
    write!(
        text,
        ".\nFrom {FROM} samples on, {unsure} of {} verdicts are \"can't tell\".",
        late().count()
    )?;
    Ok(text)
}
