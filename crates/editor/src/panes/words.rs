//! Numbers as panes say them: short, in the units of the drawing.

use crate::engine::shown::ShownPanel;
use crate::scene::Scene;
use sheetwright::check::Verdict;
use sheetwright_files::{Units, share_beyond_words};

use super::measured::{twist, unsure_max, worst};

/// A length with its unit: `40 mm`, `−1.25 in`.
pub fn length(mm: f64, units: Units) -> String {
    format!("{} {}", length_bare(mm, units), units.name())
}

/// A bend radius with its unit: where lengths are in feet or metres, one below 1 ft or 1 m is said
/// in inches or millimetres.
pub fn radius(mm: f64, units: Units) -> String {
    let smaller = match units {
        Units::Feet => Units::Inches,
        Units::Metres => Units::Millimetres,
        units => units,
    };
    length(mm, if mm < units.in_mm() { smaller } else { units })
}

/// A length without its unit.
pub fn length_bare(mm: f64, units: Units) -> String {
    // About a tenth of a millimetre, whatever the unit.
    let decimals = match units {
        Units::Millimetres => 1,
        Units::Centimetres | Units::Inches => 2,
        Units::Feet => 3,
        Units::Metres => 4,
    };
    decimal(mm / units.in_mm(), decimals)
}

/// A number with so many decimals at the most, without zeros at its end.
pub fn decimal(value: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", value.abs());
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    };
    if value < 0.0 && text != "0" { format!("−{text}") } else { text }
}

/// An angle: two figures below ten degrees.
pub fn degrees(deg: f64) -> String {
    format!("{}°", decimal(deg, if deg.abs() < 9.95 { 1 } else { 0 }))
}

/// A strain in per cent: two figures below one per cent.
pub fn per_cent(share: f64) -> String {
    if let Some(beyond) = share_beyond_words(share) {
        return beyond.to_owned();
    }
    let percent = 100.0 * share;
    let decimals = match percent {
        x if x < 0.01 => 4,
        x if x < 0.1 => 3,
        x if x < 10.0 => 2,
        _ => 0,
    };
    format!("{} %", decimal(percent, decimals))
}

/// A share as people read it: in per cent, in parts of a thousand, or as exact.
pub fn error(share: f64) -> String {
    if share < super::measured::EXACT {
        "exact".to_owned()
    } else if share < 1e-5 {
        format!("{share:.0e}")
    } else if share < 1e-2 {
        format!("{} ‰", decimal(1e3 * share, if share < 1e-3 { 2 } else { 1 }))
    } else {
        format!("{} %", decimal(1e2 * share, 1))
    }
}

/// Will it bend, in words.
pub fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Bends => "bends",
        Verdict::BendsAndFolds => "bends and folds",
        Verdict::BendsWithForce => "bends with force",
        Verdict::Roll => "must be rolled",
        Verdict::Undecided => "can't tell",
        Verdict::WillNotBend => "will not bend",
    }
}

/// What a screen reader says of all panels.
pub fn description(scene: &Scene<'_>) -> String {
    let count = scene.panels.len();
    if count == 0 {
        return "No panels.".to_owned();
    }
    let mut text = if count == 1 { "1 panel.".to_owned() } else { format!("{count} panels.") };
    for panel in scene.panels {
        text += &format!(" {}.", of_panel(panel));
    }
    text
}

fn of_panel(panel: &ShownPanel) -> String {
    let shown = match &panel.made {
        Ok(shown) => shown,
        Err(refusal) => return format!("{}: {}", panel.name, refusal.message),
    };
    let said = format!("{}: {}", panel.name, verdict(shown.verdict));
    match worst(shown) {
        Some(n) => format!(
            "{said}, worst at rung {} with {} of twist",
            n + 1,
            degrees(twist(&shown.rungs[n]))
        ),
        None if unsure_max(shown) > 0.0 => format!(
            "{said}, without twist that is sure, up to {} from coarse samples",
            degrees(unsure_max(shown))
        ),
        None => format!("{said}, without twist"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!(length(40.0, Units::Millimetres), "40 mm");
        assert_eq!(length(-12.34, Units::Millimetres), "−12.3 mm");
        assert_eq!(length(-0.01, Units::Millimetres), "0 mm");
        assert_eq!(length(31.75, Units::Inches), "1.25 in");
        assert_eq!(length(22_137.29, Units::Feet), "72.629 ft");
        assert_eq!(radius(31.75, Units::Feet), "1.25 in");
        assert_eq!(radius(609.6, Units::Feet), "2 ft");
        assert_eq!(radius(31.75, Units::Metres), "31.8 mm");
        assert_eq!(radius(31.7, Units::Centimetres), "3.17 cm");
        assert_eq!(decimal(100.0, 0), "100");
        assert_eq!(decimal(-0.001, 2), "0");
        assert_eq!(degrees(9.26), "9.3°");
        assert_eq!(degrees(12.4), "12°");
        assert_eq!(error(1e-12), "exact");
        assert_eq!(error(0.0023), "2.3 ‰");
        assert_eq!(error(0.031), "3.1 %");
    }
}
