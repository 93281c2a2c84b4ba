//! How many panels of a batch bend, in words and as JSON.

use super::kept::KeptRow;
use crate::messages::line;
use serde::Serialize;
use sheetwright::check::{Severity, Verdict};
use sheetwright::make::PanelRow;
use std::collections::BTreeMap;

/// The rows of a table, counted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BatchCount {
    verdicts: BTreeMap<&'static str, u64>,
    failed: u64,
    with_errors: u64,
}

#[derive(Serialize)]
struct CountFile<'a> {
    sheetwright: u32,
    table: Option<&'a str>,
    panels: u64,
    verdicts: &'a BTreeMap<&'static str, u64>,
    failed: u64,
}

impl BatchCount {
    /// Counts a part that was made.
    pub fn add(&mut self, row: &PanelRow) {
        *self.verdicts.entry(row.verdict.name()).or_default() += 1;
        self.with_errors += u64::from(row.severity() == Some(Severity::Error));
    }

    /// Counts what could not be made.
    pub fn add_failed(&mut self) {
        self.failed += 1;
    }

    /// Counts a row of an earlier run.
    pub fn add_kept(&mut self, row: &KeptRow) {
        match row.verdict {
            Some(verdict) => *self.verdicts.entry(verdict.name()).or_default() += 1,
            None => self.failed += 1,
        }
        self.with_errors += u64::from(row.has_errors);
    }

    /// Adds the counts of others.
    pub fn join(&mut self, others: &Self) {
        for (verdict, count) in &others.verdicts {
            *self.verdicts.entry(verdict).or_default() += count;
        }
        self.failed += others.failed;
        self.with_errors += others.with_errors;
    }

    /// All rows.
    pub fn rows(&self) -> u64 {
        self.verdicts.values().sum::<u64>() + self.failed
    }

    /// Whether something could not be made or must not be cut.
    pub fn has_errors(&self) -> bool {
        self.failed > 0 || self.with_errors > 0
    }

    /// The counts in a sentence: `12 panels: 9 bend, 2 will not bend, 1 could not be made`.
    pub fn text(&self) -> String {
        let of = |verdict: Verdict| self.verdicts.get(verdict.name()).copied().unwrap_or(0);
        let said = Verdict::ALL.into_iter().map(|verdict| {
            let (one, more) = match verdict {
                Verdict::Bends => ("bends", "bend"),
                Verdict::BendsAndFolds => ("bends and folds", "bend and fold"),
                Verdict::BendsWithForce => ("bends with force", "bend with force"),
                Verdict::Roll => ("must be rolled or formed", "must be rolled or formed"),
                Verdict::Undecided => ("is undecided", "are undecided"),
                Verdict::WillNotBend => ("will not bend", "will not bend"),
            };
            (of(verdict), if of(verdict) == 1 { one } else { more })
        });
        let failed = [(self.failed, "could not be made")];
        let said = said.chain(failed).filter(|(count, _)| *count > 0);
        let said: Vec<String> = said.map(|(count, words)| format!("{count} {words}")).collect();
        let rows = self.rows();
        let panels = if rows == 1 { "panel" } else { "panels" };
        format!("{rows} {panels}: {}", said.join(", "))
    }

    /// The counts as a line of JSON; `table` is the file of the rows, if they are in one.
    pub fn json(&self, table: Option<&str>) -> String {
        let (verdicts, failed) = (&self.verdicts, self.failed);
        line(&CountFile { sheetwright: 1, table, panels: self.rows(), verdicts, failed })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_counted_in_words_and_as_json() {
        let mut count = BatchCount::default();
        let kept = |verdict, has_errors| KeptRow { number: 1, verdict, has_errors };
        count.add_kept(&kept(Some(Verdict::Bends), false));
        count.add_kept(&kept(None, false));
        let mut more = BatchCount::default();
        more.add_kept(&kept(Some(Verdict::Bends), false));
        more.add_kept(&kept(Some(Verdict::WillNotBend), true));
        count.join(&more);
        assert_eq!(count.text(), "4 panels: 2 bend, 1 will not bend, 1 could not be made");
        let json = "{\"sheetwright\":1,\"table\":null,\"panels\":4,\"verdicts\":{\"bends\":2,\
                    \"will-not-bend\":1},\"failed\":1}\n";
        assert_eq!(count.json(None), json);
        assert!(count.has_errors());
    }
}
