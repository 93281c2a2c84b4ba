//! The keywords that do what findings and hints advise, as the command names its options.

use sheetwright::check::Remedy;

/// The keyword for a remedy, as a sentence that follows the finding or hint.
fn keyword(remedy: Remedy) -> String {
    match remedy {
        Remedy::Effort => "effort=10 sets ten times the default.".to_owned(),
        Remedy::OtherSurface => "side=\"other\" makes it.".to_owned(),
        Remedy::Darts => "darts=True cuts it there.".to_owned(),
        Remedy::SplitCreases => "split_creases=30 divides it at creases above 30°.".to_owned(),
        Remedy::OneSkin => "skin=\"outer\" lays the outer one flat.".to_owned(),
        Remedy::Facets => "facets=True folds it so.".to_owned(),
        Remedy::NoFacets => "facets=False lays it flat as a smooth surface.".to_owned(),
        Remedy::Divide => {
            "divide=\"scarf\" divides it, or \"butt\", \"puzzle\" or \"overlap\".".to_owned()
        }
        Remedy::Units => "units sets them.".to_owned(),
        Remedy::Sheets(count) => format!("max_sheets={count} allows them."),
    }
}

/// A text, followed by the keywords for its remedies.
pub(crate) fn with_keywords(text: &str, remedies: impl IntoIterator<Item = Remedy>) -> String {
    let all = remedies.into_iter().fold(text.to_owned(), |text, it| text + " " + &keyword(it));
    all.trim().to_owned()
}
