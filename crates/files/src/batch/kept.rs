//! The rows of a table that an earlier batch wrote.

use super::row::{TableForm, TableRows};
use serde::Deserialize;
use sheetwright::check::Verdict;

/// What a batch that goes on needs of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KeptRow {
    /// The number of its panel or design.
    pub number: u64,
    /// The verdict; `None` of what could not be made.
    pub verdict: Option<Verdict>,
    /// Whether some finding is an error.
    pub has_errors: bool,
}

#[derive(Deserialize)]
struct JsonKept {
    number: u64,
    verdict: Option<String>,
    severity: Option<String>,
}

impl TableRows {
    /// Whether these bytes may be the beginning of a row that was not written to its end.
    pub fn may_be_cut(self, bytes: &[u8]) -> bool {
        match self.form {
            TableForm::JsonLines => {
                const BEGINS: &[u8] = b"{\"number\":";
                bytes.starts_with(BEGINS) || BEGINS.starts_with(bytes)
            }
            TableForm::Csv => bytes.first().is_none_or(u8::is_ascii_digit),
        }
    }

    /// A row that was written so, without its line feed; `None` if it is no row of such a table.
    pub fn kept(self, line: &[u8]) -> Option<KeptRow> {
        let (number, verdict, severity) = match self.form {
            TableForm::JsonLines => {
                let kept: JsonKept = serde_json::from_slice(line).ok()?;
                (kept.number, kept.verdict, kept.severity)
            }
            TableForm::Csv => {
                let mut row = csv::StringRecord::new();
                let mut reader =
                    csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(line);
                reader.read_record(&mut row).ok().filter(|is_read| *is_read)?;
                let text = |n: usize| row.get(n).filter(|text| !text.is_empty());
                let (verdict, severity) = (text(3).map(str::to_owned), text(4).map(str::to_owned));
                (row.get(0)?.parse().ok()?, verdict, severity)
            }
        };
        let named = |name: &String| Verdict::ALL.into_iter().find(|v| v.name() == name);
        let has_errors = severity.as_deref() == Some("error");
        Some(KeptRow { number, verdict: verdict.as_ref().and_then(named), has_errors })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_read_back_and_nothing_else_does() {
        let kept = |form, line: &str| TableRows { form, has_seconds: false }.kept(line.as_bytes());
        let bends = KeptRow { number: 12, verdict: Some(Verdict::Bends), has_errors: true };
        assert_eq!(kept(TableForm::Csv, "12,\"a,b\",p,bends,error,x; y,1"), Some(bends));
        let line = "{\"number\":12,\"id\":\"a\",\"verdict\":\"bends\",\"severity\":\"error\"}";
        assert_eq!(kept(TableForm::JsonLines, line), Some(bends));
        let failed = KeptRow { number: 3, verdict: None, has_errors: false };
        assert_eq!(kept(TableForm::Csv, "3,a,,,,,,"), Some(failed));
        assert_eq!(kept(TableForm::Csv, "number,id,panel"), None);
        assert_eq!(kept(TableForm::JsonLines, "{\"number\":1"), None);
        let is_cut =
            |form, text: &str| TableRows { form, has_seconds: false }.may_be_cut(text.as_bytes());
        assert!(is_cut(TableForm::JsonLines, "{\"nu") && is_cut(TableForm::Csv, "12,"));
        assert!(is_cut(TableForm::JsonLines, "{\"number\":7,\"i") && is_cut(TableForm::Csv, ""));
        assert!(!is_cut(TableForm::JsonLines, "to do") && !is_cut(TableForm::Csv, "to do"));
    }
}
