//! Which options of the command do what findings, hints and pages advise in plain words: what lies
//! below the command names none of them, since the editor and the page of a report say the same.

use sheetwright::check::Remedy;

/// How the catalogue of templates is shown.
pub(crate) const CATALOGUE: &str = "`sheetwright new --list` shows it.";
/// How templates are called, between their list and what each takes.
pub(crate) const TEMPLATE_CALL: &str = "\
Write one with its defaults, then see whether it bends and make its patterns:
  sheetwright new NAME -o part.sheet.json
  sheetwright make part.sheet.json --out build
or both at once:
  sheetwright new NAME --make build
Each has its parameters below, with what they are unless they are set: --set diameter=40cm,
as often as need be.";
/// How the page of a report is had whole, where it is short because there are many panels.
pub(crate) const LONG_REPORT: &str =
    "note: report.html is in its short form; make --report long has pictures of every panel";

/// The option that a remedy is, in a sentence that follows what it helps against.
pub(crate) fn option(remedy: Remedy) -> String {
    match remedy {
        Remedy::Effort => "--effort sets it: 10 is ten times the default.".to_owned(),
        Remedy::Darts => "--darts cuts it there.".to_owned(),
        Remedy::SplitCreases => "--split-creases 30 divides it at creases above 30°.".to_owned(),
        Remedy::Units => "--units says which they are.".to_owned(),
        Remedy::Sheets(count) => format!("--max-sheets {count} allows them."),
    }
}

/// A text, and the options that its remedies are.
pub(crate) fn with_options(text: &str, remedies: impl IntoIterator<Item = Remedy>) -> String {
    remedies.into_iter().fold(text.to_owned(), |text, remedy| text + " " + &option(remedy))
}
