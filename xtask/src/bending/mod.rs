//! The page with the verdicts on known designs beside finer nets, and on the corpus with twice the
//! samples again and again.

mod doubling;
mod held;
mod sheets;

pub(crate) use held::write as write_held;

use sheets::{Case, Row, THICKNESSES, cases, row};
use std::error::Error;
use std::fmt::Write;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

const TEXT: &str = include_str!("page.md");

/// Writes `docs/bending-measured.md`, and fails if a verdict is on the wrong side of its limit.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    let rows = rows(&cases()?)?;
    let doubled = doubling::boundaries()?;
    let page = TEXT
        .replace("{ROWS}", rows.iter().map(line).collect::<Vec<_>>().join("\n").as_str())
        .replace("{SUMMARY}", &summary(&rows)?)
        .replace("{BOUNDARIES}", &doubling::table(&doubled)?)
        .replace("{DOUBLED}", &doubling::summary(&doubled)?);
    let path = crate::root().join("docs/bending-measured.md");
    std::fs::write(&path, page)?;
    println!("wrote {}", path.display());
    let wrong: Vec<String> = rows.iter().flat_map(Row::wrong).collect();
    if wrong.is_empty() { Ok(()) } else { Err(wrong.join("\n").into()) }
}

/// The rows of all cases, two at a time.
fn rows(cases: &[Case]) -> Result<Vec<Row>, Box<dyn Error>> {
    let next = AtomicUsize::new(0);
    let made = Mutex::new(Vec::new());
    let work = || {
        while let Some((n, case)) = nth(cases, next.fetch_add(1, Ordering::Relaxed)) {
            let row = row(case);
            if let Ok(row) = &row {
                println!("{}", line(row));
            }
            made.lock().unwrap_or_else(PoisonError::into_inner).push((n, row));
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(work);
        work();
    });
    let mut made = made.into_inner().unwrap_or_else(PoisonError::into_inner);
    made.sort_by_key(|(n, _)| *n);
    made.into_iter().map(|(_, row)| row.map_err(Into::into)).collect()
}

fn nth(cases: &[Case], n: usize) -> Option<(usize, &Case)> {
    cases.get(n).map(|case| (n, case))
}

/// A line of the table: of each thickness the panel that uses most of what it takes.
fn line(row: &Row) -> String {
    let per_cent = |strain: f64| format!("{:.4}", 100.0 * strain);
    let cells = row.worst().map(|worst| match worst {
        Some(panel) => format!(
            " {} | {} | {} | {} ",
            per_cent(panel.quick),
            per_cent(panel.computed),
            panel.fine.map_or_else(|| "–".to_owned(), per_cent),
            sheetwright_files::verdict_word(panel.verdict),
        ),
        None => " – | – | – | – ".to_owned(),
    });
    format!("| {} | {} |{}|", row.name, row.panels, cells.join("|"))
}

/// How near the formula and the computed sheet come to the finer net, over all panels.
fn summary(rows: &[Row]) -> Result<String, std::fmt::Error> {
    let all = || rows.iter().flat_map(|row| row.judged.iter().flatten());
    let mut text = String::new();
    writeln!(
        text,
        "| over all panels and both thicknesses | median factor | 90 % within | largest |"
    )?;
    writeln!(text, "|---|---|---|---|")?;
    for (name, of) in
        [("formula", (|p| p.quick) as fn(&sheets::Judged) -> f64), ("computed", |p| p.computed)]
    {
        let factor = |p: &sheets::Judged| {
            let fine = p.fine.filter(|&fine| fine > sheets::NO_STRAIN)?;
            Some((of(p) / fine).max(fine / of(p)))
        };
        let mut factors: Vec<f64> = all().filter_map(factor).collect();
        factors.sort_by(f64::total_cmp);
        let at = |share: f64| factors.get((share * factors.len() as f64) as usize);
        let [median, most] = [0.5, 0.9].map(|share| at(share).copied().unwrap_or(1.0));
        let largest = match factors.last() {
            Some(largest) if *largest > 100.0 => "over 100".to_owned(),
            largest => format!("{:.2}", largest.copied().unwrap_or(1.0)),
        };
        writeln!(text, "| {name} | {median:.2} | {most:.2} | {largest} |")?;
    }
    let count = all().count();
    let compared = all().filter(|p| p.fine.is_some()).count();
    let unsure = all().filter(|p| p.verdict == sheetwright::Verdict::Undecided).count();
    let wrong: usize = rows.iter().map(|row| row.wrong().len()).sum();
    let limits = THICKNESSES.len();
    write!(
        text,
        "\nOf {count} sheets ({} designs in {limits} thicknesses, equal panels once), \"can't tell\" is \
         said of {unsure}. Of the\n{compared} that have a finer net, {wrong} are judged on the wrong \
         side of the limit by more than a factor of {}.",
        rows.len(),
        sheets::MOST_WRONG,
    )?;
    Ok(text)
}

/// The cases that the test makes: one of each kind, on both sides of the limit, and quick.
#[cfg(test)]
const TESTED: [&str; 4] =
    ["kayak", "twisted by 20°", "wavy, 20 mm, 0.35 out of step", "random curve 6"];

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests panic

    use super::*;

    #[test]
    fn verdicts_are_on_the_right_side_and_those_of_the_page() {
        let page = std::fs::read_to_string(crate::root().join("docs/bending-measured.md"));
        let page = page.unwrap_or_default();
        let cases: Vec<Case> = cases().unwrap();
        for name in TESTED {
            let row = row(cases.iter().find(|case| case.name == name).unwrap()).unwrap();
            assert_eq!(row.wrong(), Vec::<String>::new());
            assert!(row.judged.iter().all(|panels| !panels.is_empty()), "{name}");
            let line = line(&row);
            assert!(page.contains(&line), "run `cargo xtask bending`; now:\n{line}");
        }
        let head = TEXT.lines().take_while(|line| !line.contains('{'));
        assert!(head.clone().count() > 5 && head.clone().all(|line| page.contains(line)));
    }

    #[test]
    fn what_is_on_the_wrong_side_is_named() {
        use sheetwright::check::Verdict;
        let judged = |computed: f64, fine: f64, verdict: Verdict| sheets::Judged {
            panel: "p".into(),
            quick: computed,
            computed,
            limit: 1e-3,
            fine: Some(fine),
            verdict,
            is_refused: verdict == Verdict::WillNotBend,
        };
        let row = |panel: sheets::Judged| Row {
            name: "row".into(),
            panels: 1,
            judged: [vec![panel], Vec::new()],
        };
        assert_eq!(row(judged(9e-4, 1.6e-3, Verdict::BendsWithForce)).wrong().len(), 1);
        assert_eq!(row(judged(9e-4, 1.4e-3, Verdict::BendsWithForce)).wrong().len(), 0);
        assert_eq!(row(judged(1.1e-3, 0.6e-3, Verdict::WillNotBend)).wrong().len(), 1);
        assert_eq!(row(judged(1.1e-3, 0.6e-3, Verdict::Undecided)).wrong().len(), 0);
    }
}
