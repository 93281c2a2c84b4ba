//! What decides how many bend lines there are, as it is typed on a command line.

use crate::design_json::{RuleName, rule};
use crate::quantity::size_mm;
use sheetwright::design::BendRule;

/// What decides how many bend lines there are, as it is typed: `24` for a number of lines, `5deg`
/// or `5°` for an angle, `pitch=20mm` and `chord=0.5mm`.
///
/// # Errors
/// Another text, or a value out of range; the error says what to type.
pub fn bend_rule(text: &str) -> Result<BendRule, String> {
    const EXAMPLES: &str = "give a number of lines such as 24, an angle such as 5deg, chord=0.5mm \
                            or pitch=20mm";
    let text = text.trim();
    let length = |text: &str| size_mm(text).ok_or_else(|| EXAMPLES.to_owned());
    let (by, value) = if let Some(length_of) = text.strip_prefix("chord=") {
        (RuleName::Chord, length(length_of)?)
    } else if let Some(length_of) = text.strip_prefix("pitch=") {
        (RuleName::Pitch, length(length_of)?)
    } else if let Some(angle) = text.strip_suffix("deg").or(text.strip_suffix('°')) {
        (RuleName::Angle, angle.trim().parse().map_err(|_| EXAMPLES.to_owned())?)
    } else {
        (RuleName::Number, text.parse().map_err(|_| EXAMPLES.to_owned())?)
    };
    rule(by, value).map_err(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright::math::from_deg;

    #[test]
    fn rules_are_read_as_they_are_typed() {
        for (text, rule) in [
            ("24", BendRule::Number(24)),
            (" 5deg", BendRule::Angle(from_deg(5.0))),
            ("2.5°", BendRule::Angle(from_deg(2.5))),
            ("chord=0.5mm", BendRule::Chord(0.5)),
            ("pitch=1in", BendRule::Pitch(25.4)),
        ] {
            assert_eq!(bend_rule(text), Ok(rule), "{text}");
        }
        for text in
            ["", "0", "2.5", "-3", "1001", "0deg", "95deg", "pitch=", "chord=-1", "sagitta=1"]
        {
            assert!(bend_rule(text).is_err(), "{text}");
        }
    }
}
