//! The options of the command that do what findings, hints and pages advise. The crates below name
//! no options, since the editor and the report show the findings too.

use sheetwright::check::Remedy;

/// How to show the catalogue of templates.
pub(crate) const CATALOGUE: &str = "`sheetwright new --list` shows it.";
/// How to use a template: printed between the list of templates and their parameters.
pub(crate) const TEMPLATE_CALL: &str = "\
Write a design with the defaults, then check it and make its patterns:
  sheetwright new NAME -o part.sheet.json
  sheetwright make part.sheet.json --out build
or both in one step:
  sheetwright new NAME --make build
The parameters of each template follow, with their defaults. Set one with
--set diameter=40cm; repeat --set for others. --for TRADE adds what a
trade does along edges, and its files.";
/// The note on a report that is short because it has many panels.
pub(crate) const LONG_REPORT: &str =
    "note: report.html is in its short form; --report long gives pictures of every panel";

/// The note on a template without a trade: what it is usually made for.
pub(crate) fn bare_outlines(usual: &str) -> String {
    format!("note: patterns are bare outlines; --for {usual} adds what that trade does along edges")
}

/// The option for a remedy, as a sentence that follows the finding or hint.
pub(crate) fn option(remedy: Remedy) -> String {
    match remedy {
        Remedy::Effort => "--effort sets it: 10 is ten times the default.".to_owned(),
        Remedy::OtherSurface => "--side other makes it.".to_owned(),
        Remedy::Darts => "--darts cuts it there.".to_owned(),
        Remedy::SplitCreases => "--split-creases 30 divides it at creases above 30°.".to_owned(),
        Remedy::OneSkin => "--skin outer lays the outer one flat.".to_owned(),
        Remedy::Facets => "--facets folds it so.".to_owned(),
        Remedy::NoFacets => "--facets=off lays it flat as a smooth surface.".to_owned(),
        Remedy::Divide => "--divide scarf divides it, or butt, puzzle or overlap.".to_owned(),
        Remedy::Units => "--units sets them.".to_owned(),
        Remedy::Sheets(count) => format!("--max-sheets {count} allows them."),
    }
}

/// A text, followed by the options for its remedies.
pub(crate) fn with_options(text: &str, remedies: impl IntoIterator<Item = Remedy>) -> String {
    remedies.into_iter().fold(text.to_owned(), |text, remedy| text + " " + &option(remedy))
}
