//! The catalogue of templates: as text, as JSON and as tables of the docs.

use crate::template_call::{DIMENSIONS, MATERIAL, default, range};
use serde::Serialize;
use sheetwright::template::{Kind, Parameter, Template, Value, catalogue};
use std::fmt::Write;

/// The most characters of a line, unless one word is longer.
const LINE: usize = 96;
/// Where the meaning of a parameter begins.
const COLUMN: usize = 28;

/// The catalogue as text: one line for each template, then `call`, then each template with its
/// parameters. `call` says how to name a template and its settings in the calling program.
pub fn catalogue_text(call: &str) -> String {
    let mut text = String::from("Templates:\n");
    let widest = catalogue().iter().map(|t| t.name.len()).max().unwrap_or(0);
    for Template { name, title, .. } in catalogue() {
        line(&mut text, &format!("  {name:widest$}  {title}"));
    }
    text.push_str(&format!(
        "\n{call} Lengths are in mm or have a unit (400mm, 40cm, 0.4m, 15 3/4in, 1' 4\"),\n\
         angles are in degrees.\n"
    ));
    line(
        &mut text,
        &format!("Every template also takes {MATERIAL}=NAME, such as steel-1mm or paper, and"),
    );
    line(
        &mut text,
        &format!(
            "{DIMENSIONS}=inside, mean or outside: the face of the sheet that its sizes are of."
        ),
    );
    for template in catalogue() {
        text.push('\n');
        text.push_str(&template_text(template));
    }
    text
}

/// One template as text: its users, its search words and its parameters.
pub fn template_text(template: &Template) -> String {
    let mut text = String::new();
    line(&mut text, &format!("{}: {}", template.name, template.title));
    wrapped(&mut text, "  ", template.who);
    wrapped(&mut text, "  ", &format!("Also searched for as: {}.", template.words.join(", ")));
    if let Some(trade) = template.trade {
        wrapped(&mut text, "  ", &format!("Usually made for: {trade}."));
    }
    let indent = " ".repeat(COLUMN);
    for Parameter { name, meaning, kind } in template.parameters {
        let setting = format!("    {name} = {}", default(kind));
        let said = match kind {
            Kind::Choice(_) => format!("{meaning}:"),
            _ => format!("{meaning} ({})", range(kind)),
        };
        if setting.chars().count() + 2 > COLUMN {
            line(&mut text, &setting);
            wrapped_after(&mut text, &indent, &indent, &said);
        } else {
            wrapped_after(&mut text, &format!("{setting:COLUMN$}"), &indent, &said);
        }
        if let Kind::Choice(choices) = kind {
            for choice in *choices {
                let said = format!("{}: {}", choice.name, choice.meaning);
                wrapped_after(&mut text, &format!("{indent}- "), &format!("{indent}  "), &said);
            }
        }
    }
    text
}

fn line(text: &mut String, said: &str) {
    text.push_str(said);
    text.push('\n');
}

fn wrapped(text: &mut String, indent: &str, said: &str) {
    wrapped_after(text, indent, indent, said);
}

/// Breaks a text into lines between words, so that a terminal does not break inside words. Keeps
/// runs of spaces, as between columns, on the first line.
fn wrapped_after(text: &mut String, first: &str, indent: &str, said: &str) {
    let mut current = first.to_owned();
    let mut fresh = true;
    for word in said.split(' ') {
        let width = current.chars().count() + 1 + word.chars().count();
        if !fresh && width > LINE {
            line(text, current.trim_end());
            current = indent.to_owned();
            fresh = true;
        }
        if !fresh {
            current.push(' ');
        }
        current.push_str(word);
        fresh = false;
    }
    line(text, current.trim_end());
}

/// The parameters of a template as a Markdown table, for the docs.
pub fn parameter_table(template: &Template) -> String {
    let mut table = String::from("| parameter | | default | takes |\n|---|---|---|---|\n");
    for Parameter { name, meaning, kind } in template.parameters {
        let mut meaning = (*meaning).to_owned();
        if let Kind::Choice(choices) = kind {
            for choice in *choices {
                let _ = write!(meaning, "<br>`{}`: {}", choice.name, choice.meaning);
            }
        }
        let _ = writeln!(table, "| `{name}` | {meaning} | {} | {} |", default(kind), range(kind));
    }
    table
}

#[derive(Serialize)]
struct CatalogueFile {
    sheetwright: u32,
    templates: Vec<TemplateFile>,
}

#[derive(Serialize)]
struct TemplateFile {
    name: &'static str,
    title: &'static str,
    who: &'static str,
    words: &'static [&'static str],
    /// The trade that it is usually made for.
    #[serde(rename = "for", skip_serializing_if = "Option::is_none")]
    trade: Option<&'static str>,
    parameters: Vec<ParameterFile>,
}

#[derive(Serialize)]
struct ParameterFile {
    name: &'static str,
    meaning: &'static str,
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<&'static str>,
    default: ValueFile,
    #[serde(skip_serializing_if = "Option::is_none")]
    least: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    most: Option<f64>,
    /// The least and the greatest number of lengths in a list.
    #[serde(skip_serializing_if = "Option::is_none")]
    lengths: Option<[usize; 2]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    choices: Vec<ChoiceFile>,
}

#[derive(Serialize)]
struct ChoiceFile {
    name: &'static str,
    meaning: &'static str,
}

#[derive(Serialize)]
#[serde(untagged)]
enum ValueFile {
    Number(f64),
    Numbers(Vec<f64>),
    Choice(String),
    None,
}

/// The catalogue, or this one template of it, as one line of JSON; docs/files.md lists the fields.
pub fn catalogue_json(only: Option<&Template>) -> String {
    let templates = catalogue()
        .iter()
        .filter(|template| only.is_none_or(|only| only.name == template.name))
        .map(|template| TemplateFile {
            name: template.name,
            title: template.title,
            who: template.who,
            words: template.words,
            trade: template.trade,
            parameters: template.parameters.iter().map(parameter_file).collect(),
        })
        .collect();
    let file = CatalogueFile { sheetwright: 1, templates };
    // Texts and finite numbers always serialise.
    serde_json::to_string(&file).unwrap_or_default() + "\n"
}

fn parameter_file(parameter: &Parameter) -> ParameterFile {
    let kind = &parameter.kind;
    let (word, unit) = match kind {
        Kind::Length(_) => ("length", Some("mm")),
        Kind::Angle(_) => ("angle", Some("deg")),
        Kind::Count(_) => ("count", None),
        Kind::Number(_) => ("number", None),
        Kind::Lengths { .. } => ("lengths", Some("mm")),
        Kind::Choice(_) => ("choice", None),
        Kind::Table => ("table", None),
    };
    let (least, most) = match *kind {
        Kind::Length(range) | Kind::Angle(range) | Kind::Count(range) | Kind::Number(range) => {
            (Some(range.least), Some(range.most))
        }
        Kind::Lengths { least, most, .. } => (Some(least), Some(most)),
        Kind::Choice(_) | Kind::Table => (None, None),
    };
    let lengths = match *kind {
        Kind::Lengths { fewest, longest, .. } => Some([fewest, longest]),
        _ => None,
    };
    let choices = match kind {
        Kind::Choice(choices) => choices
            .iter()
            .map(|choice| ChoiceFile { name: choice.name, meaning: choice.meaning })
            .collect(),
        _ => Vec::new(),
    };
    let default = match kind.default() {
        Value::Number(number) => ValueFile::Number(number),
        Value::Numbers(list) => ValueFile::Numbers(list),
        Value::Choice(name) => ValueFile::Choice(name),
        Value::Table(_) => ValueFile::None,
    };
    ParameterFile {
        name: parameter.name,
        meaning: parameter.meaning,
        kind: word,
        unit,
        default,
        least,
        most,
        lengths,
        choices,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_names_everything_within_its_lines() {
        let text = catalogue_text("Set what it takes.");
        for template in catalogue() {
            assert!(text.contains(&format!("\n{}: {}\n", template.name, template.title)));
            for parameter in template.parameters {
                assert!(text.contains(parameter.name));
            }
        }
        for line in text.lines() {
            assert!(line.chars().count() <= LINE + 4, "{line}");
        }
        let json: serde_json::Value = serde_json::from_str(&catalogue_json(None)).unwrap();
        assert_eq!(json["templates"].as_array().map(Vec::len), Some(catalogue().len()));
    }
}
