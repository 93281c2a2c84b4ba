//! The pictures of the trades: what each adds to a pattern, on a template that it is usual for.

use sheetwright::make::{Judging, make_judged};
use sheetwright::watch::Unwatched;
use sheetwright_files::{flat_picture, new_design};
use std::error::Error;
use std::path::Path;

/// What is shown of a trade.
struct Shown {
    trade: &'static str,
    /// The template, and its settings: those of the walk on the page of the trade.
    template: &'static str,
    settings: &'static [&'static str],
    /// The part that is shown.
    part: &'static str,
}

const fn shown(
    trade: &'static str,
    template: &'static str,
    settings: &'static [&'static str],
    part: &'static str,
) -> Shown {
    Shown { trade, template, settings, part }
}

const SHOWN: [Shown; 9] = [
    shown("boat", "dinghy", &["halves=both"], "transom"),
    shown("card", "lampshade", &["bottom=120mm", "top=80mm", "slant=90mm"], "shade"),
    shown("duct", "square-to-round", &["material=galvanised-26ga", "dimensions=inside"], "duct"),
    shown("foam", "ball", &["gores=8", "material=eva-10mm"], "gore-1"),
    shown(
        "laser",
        "hopper",
        &[
            "width=24cm",
            "depth=18cm",
            "outlet-width=12cm",
            "outlet-depth=9cm",
            "height=15cm",
            "material=plywood-3mm",
        ],
        "right",
    ),
    shown("leather", "bag", &["width=200mm", "height=150mm", "depth=60mm"], "front"),
    shown("paper", "hemisphere", &["diameter=200mm", "gores=8"], "band-2-1"),
    shown("plate", "elbow", &["diameter=600mm", "radius=900mm"], "segment-2"),
    shown("sewing", "bag", &["material=canvas"], "front"),
];

/// Writes the pictures.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    for shown in &SHOWN {
        let path = crate::root().join("docs").join(picture_path(shown.trade));
        std::fs::write(&path, drawn(shown)?)?;
        println!("wrote {}", path.display());
    }
    Ok(())
}

fn picture_path(trade: &str) -> String {
    format!("pictures/trade-{trade}.svg")
}

fn drawn(shown: &Shown) -> Result<String, Box<dyn Error>> {
    let settings: Vec<String> = shown.settings.iter().map(|&setting| setting.to_owned()).collect();
    let mut new = new_design(shown.template, &settings, Path::new("."))?;
    new.make_for(shown.trade);
    let made = make_judged(&new.design, Judging::Quick, &mut Unwatched)?;
    let part = made.parts.iter().find(|part| part.name == shown.part).ok_or(shown.part)?;
    Ok(flat_picture(part, made.material.as_ref()).standalone())
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_files::trade_names;

    fn read(name: &str) -> String {
        let path = crate::root().join("docs").join(name);
        std::fs::read_to_string(path).unwrap_or_default().replace('\r', "")
    }

    #[test]
    fn every_trade_has_a_page_with_its_picture_and_its_walk() {
        let trades: Vec<&str> = SHOWN.iter().map(|shown| shown.trade).collect();
        assert_eq!(trades, trade_names());
        for shown in &SHOWN {
            let page = read(&format!("trades/{}.md", shown.trade));
            assert!(
                page.contains(&format!("](../{})", picture_path(shown.trade))),
                "{}",
                shown.trade
            );
            let settings: String =
                shown.settings.iter().map(|setting| format!(" --set {setting}")).collect();
            let call =
                format!("sheetwright new {} --for {}{settings} -o ", shown.template, shown.trade);
            assert!(page.contains(&call), "{call}");
        }
    }

    #[test]
    fn pictures_are_those_of_the_code() {
        for shown in &SHOWN {
            let kept = read(&picture_path(shown.trade));
            assert!(kept == drawn(shown).unwrap(), "{}: run `cargo xtask trades`", shown.trade);
        }
    }
}
