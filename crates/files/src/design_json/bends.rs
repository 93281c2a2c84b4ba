//! How bends are marked: the field `bends` of a design and of a panel.

use super::source::Source;
use crate::json::{Object, json};
use crate::reading::InputError;
use crate::units::Units;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sheetwright::design::{BendMarks, BendRule, Bends, MOST_BEND_LINES};
use sheetwright::math::{from_deg, to_deg};

/// How many bend lines a bend is divided into, and how they are drawn.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct BendsFile {
    /// What decides how many there are. Default: steps of 5°, 24 lines a part at the most.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    by: Option<RuleName>,
    /// The largest angle of a step, in degrees; the number of lines of a part; the largest distance
    /// of the smooth surface from the flat steps, in the design's units; or the largest width of a
    /// step, likewise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    value: Option<f64>,
    /// How they are drawn. Default: ticks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    draw: Option<MarksName>,
}

/// What decides how many bend lines there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum RuleName {
    /// Steps of equal angles, each of `value` at the most.
    Angle,
    /// So many lines a part.
    Number,
    /// The smooth surface is no farther than `value` from the flat steps.
    Chord,
    /// Steps of equal widths, each of `value` at the most at its wider end.
    Pitch,
}

/// How bend lines are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
enum MarksName {
    /// A tick at each end to engrave; the line and its text as notes.
    Ticks,
    /// The whole line and its text, to engrave.
    Lines,
    /// As `ticks`, and all rulings as notes.
    Rulings,
    /// Not at all; folds alone are drawn.
    None,
}

/// The bends that a field describes. `path` is its JSON path.
pub(super) fn read(
    file: Option<Object<BendsFile>>,
    path: &str,
    units: Units,
    source: &Source<'_>,
) -> Result<Option<Bends>, InputError> {
    let Some(Object(file)) = file else { return Ok(None) };
    let refused = |field: &str, message: String, hint: &str| {
        Err(source.error(&format!("{path}{field}"), message, hint))
    };
    let rule = match (file.by, file.value) {
        (None, None) => BendRule::Auto,
        (None, Some(_)) => {
            let hint = "Add \"by\": \"angle\", \"number\", \"chord\" or \"pitch\".";
            return refused("", "`value` stands without `by`".to_owned(), hint);
        }
        (Some(_), None) => {
            let hint = "Add \"value\": an angle in degrees, a number or a length.";
            return refused("", "`by` stands without `value`".to_owned(), hint);
        }
        (Some(by), Some(value)) => {
            let in_mm = match by {
                RuleName::Chord | RuleName::Pitch => value * units.in_mm(),
                RuleName::Angle | RuleName::Number => value,
            };
            match rule(by, in_mm) {
                Ok(rule) => rule,
                Err(hint) => return refused(".value", format!("the value is {value}"), hint),
            }
        }
    };
    let marks = match file.draw {
        None | Some(MarksName::Ticks) => BendMarks::Ticks,
        Some(MarksName::Lines) => BendMarks::Lines,
        Some(MarksName::Rulings) => BendMarks::Rulings,
        Some(MarksName::None) => BendMarks::None,
    };
    Ok(Some(Bends { rule, marks }))
}

/// The rule with a value, in degrees, mm or none; where it is out of range, what is in range.
pub(crate) fn rule(by: RuleName, value: f64) -> Result<BendRule, &'static str> {
    let number = (1..=MOST_BEND_LINES).find(|&n| n as f64 == value);
    match by {
        RuleName::Angle if (0.1..=90.0).contains(&value) => Ok(BendRule::Angle(from_deg(value))),
        RuleName::Angle => Err("Write an angle from 0.1 to 90 degrees."),
        RuleName::Number => {
            number.map(BendRule::Number).ok_or("Write a whole number from 1 to 1000.")
        }
        RuleName::Chord if value >= 1e-3 && value.is_finite() => Ok(BendRule::Chord(value)),
        RuleName::Chord => Err("Write a distance of 0.001 mm or more."),
        RuleName::Pitch if value >= 0.1 && value.is_finite() => Ok(BendRule::Pitch(value)),
        RuleName::Pitch => Err("Write a width of 0.1 mm or more."),
    }
}

/// The field of a design as it is written, in mm; `None` for the default.
pub(super) fn written(bends: &Bends) -> Option<String> {
    (*bends != Bends::default()).then(|| written_of_panel(bends))
}

/// The field of a panel as it is written, in mm.
pub(super) fn written_of_panel(bends: &Bends) -> String {
    let (by, value) = match bends.rule {
        BendRule::Auto => (None, None),
        // The degrees that read as these radians.
        BendRule::Angle(angle) => (Some(RuleName::Angle), Some(degrees(angle))),
        BendRule::Number(number) => (Some(RuleName::Number), Some(number as f64)),
        BendRule::Chord(mm) => (Some(RuleName::Chord), Some(mm)),
        BendRule::Pitch(mm) => (Some(RuleName::Pitch), Some(mm)),
    };
    let draw = match bends.marks {
        BendMarks::Ticks => None,
        BendMarks::Lines => Some(MarksName::Lines),
        BendMarks::Rulings => Some(MarksName::Rulings),
        BendMarks::None => Some(MarksName::None),
    };
    format!("\"bends\": {}", json(&BendsFile { by, value, draw }))
}

/// The degrees, rounded if they are meant to be, that read as an angle in radians.
fn degrees(angle: f64) -> f64 {
    let exact = to_deg(angle);
    let rounded = (exact * 1e6).round() / 1e6;
    if from_deg(rounded) == angle { rounded } else { exact }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{InputFormat, ReadOptions, read_bytes, write_design};
    use sheetwright::design::{Design, Dimensions};

    fn read(bytes: &[u8]) -> Design {
        let options = ReadOptions::default();
        read_bytes(InputFormat::Design, bytes, "d.sheet.json", None, &options).unwrap()
    }

    fn design(fields: &str, of_panel: &str) -> Design {
        let text = format!(
            "{{ \"sheetwright\": 1, \"units\": \"cm\", {fields} \"curves\": {{ \"rim\": {{ \
             \"kind\": \"polyline\", \"closed\": true, \"points\": [[0,0,0], [1,0,0], [0,1,0]] }} }}, \
             \"panels\": [{{ \"name\": \"p\", \"boundary\": [\"rim\"] {of_panel} }}] }}"
        );
        read(text.as_bytes())
    }

    #[test]
    fn what_is_written_reads_back() {
        for (field, bends) in [
            ("{}", Bends::default()),
            (
                "{ \"by\": \"angle\", \"value\": 7.3 }",
                Bends { rule: BendRule::Angle(from_deg(7.3)), ..Bends::default() },
            ),
            (
                "{ \"by\": \"number\", \"value\": 20, \"draw\": \"lines\" }",
                Bends { rule: BendRule::Number(20), marks: BendMarks::Lines },
            ),
            (
                "{ \"by\": \"pitch\", \"value\": 2.5, \"draw\": \"rulings\" }",
                Bends { rule: BendRule::Pitch(25.0), marks: BendMarks::Rulings },
            ),
            (
                "{ \"by\": \"chord\", \"value\": 0.05, \"draw\": \"none\" }",
                Bends { rule: BendRule::Chord(0.5), marks: BendMarks::None },
            ),
        ] {
            let whole = design(&format!("\"bends\": {field},"), "");
            assert_eq!((whole.bends, whole.panels[0].bends), (bends, None));
            assert_eq!(read(&write_design(&whole)), whole);
            let own = design("", &format!(", \"bends\": {field}"));
            assert_eq!((own.bends, own.panels[0].bends), (Bends::default(), Some(bends)));
            assert_eq!(own.bends_of(&own.panels[0]), bends);
            assert_eq!(read(&write_design(&own)), own);
        }
    }

    #[test]
    fn thickness_and_dimensions_read_back() {
        let thick = design("\"dimensions\": \"inside\", \"thickness\": 0.1,", "");
        assert_eq!(thick.dimensions, Some(Dimensions::Inside));
        assert_eq!(thick.thickness_mm, Some(1.0));
        let tool = design("\"bend_radius\": 0.2, \"arcs\": 0.005,", "");
        assert_eq!((tool.bend_radius_mm, tool.arcs_mm), (Some(2.0), Some(0.05)));
        assert_eq!(read(&write_design(&tool)), tool);
        assert_eq!(read(&write_design(&thick)), thick);
    }
}
