//! Why a command failed: the message, the place and the hint.

use crate::remedies::with_options;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use sheetwright::design::Design;
use sheetwright::make::MakeError;
use sheetwright_files::whole::WriteError;
use sheetwright_files::{INPUT_ENDINGS, InputError, Units, hint_in_design, length_in, remedy_for};

const HELP: &str = "`sheetwright --help` shows the commands with examples.";

/// Why a command failed.
#[derive(Debug)]
pub(crate) struct Failure {
    /// What is wrong.
    pub(crate) message: String,
    /// Where: a file, with a line or a JSON path.
    pub(crate) place: Option<String>,
    /// What to do.
    pub(crate) hint: String,
}

impl Failure {
    pub(crate) fn new(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { message: message.into(), place: None, hint: hint.into() }
    }

    pub(crate) fn at(mut self, place: impl Into<String>) -> Self {
        self.place = Some(place.into());
        self
    }

    /// A design that can't be made. `input` is what it was read from.
    pub(crate) fn of_make(error: &MakeError, design: &Design, input: &str) -> Self {
        let hint = with_options(&hint_in_design(error, design), remedy_for(error));
        Self::new(error.to_string(), hint).at(input)
    }

    /// A call that the command line does not take.
    pub(crate) fn of_call(error: &clap::Error) -> Self {
        if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
            return Self::new("no command is given", HELP);
        }
        let text = error.render().to_string();
        // The first block says what is wrong, in one or more lines; tips may follow.
        let block = text.split("\n\n").next().unwrap_or_default();
        let words: Vec<&str> = block.split_whitespace().collect();
        let message = words.join(" ");
        let message = message.strip_prefix("error: ").unwrap_or(&message).to_owned();
        // A mistyped option is no value: leave out the tip on passing it as one.
        let tips: Vec<&str> = text
            .lines()
            .filter_map(|line| line.trim().strip_prefix("tip: "))
            .filter(|tip| !tip.starts_with("to pass "))
            .collect();
        let hint = match tips.join("; ") {
            tips if !tips.is_empty() => tips,
            _ => too_many(error).unwrap_or_else(|| HELP.to_owned()),
        };
        Self::new(message, hint)
    }
}

/// The hint for an extra argument: a unit that belongs to the number before it, or a second input.
fn too_many(error: &clap::Error) -> Option<String> {
    let Some(ContextValue::String(extra)) = error.get(ContextKind::InvalidArg) else { return None };
    if error.kind() != ErrorKind::UnknownArgument {
        return None;
    }
    if let Some(name) = extra.strip_prefix('-') {
        let is_number = name.starts_with(|c: char| c.is_ascii_digit());
        return is_number.then(|| {
            "A negative number stands behind an equals sign, as in --offset=-10mm.".to_owned()
        });
    }
    if let Some(hint) = split_value(extra) {
        return Some(hint);
    }
    let checks = std::env::args_os().any(|arg| arg == "check");
    let ending =
        INPUT_ENDINGS.iter().find(|ending| extra.ends_with(**ending)).filter(|_| checks)?;
    Some(format!("Give one input at a time. {}", for_all(&format!("*{ending}"), ending)))
}

/// What to do where a value with a space, such as 15 3/4in, came as two arguments, of which this is
/// the second.
pub(crate) fn split_value(extra: &str) -> Option<String> {
    let args: Vec<String> = std::env::args_os().map(|a| a.to_string_lossy().into_owned()).collect();
    let before = args.iter().position(|arg| arg == extra).and_then(|n| args.get(n.checked_sub(1)?));
    let number = before.filter(|before| before.ends_with(|c: char| c.is_ascii_digit()))?;
    length_in(&format!("1 {extra}"), Units::Millimetres)?;
    Some(format!("Put a value with a space in quotation marks: '{number} {extra}'."))
}

impl From<InputError> for Failure {
    fn from(error: InputError) -> Self {
        Self { message: error.message, place: error.place, hint: error.hint }
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        Self { message: error.message, place: Some(error.place), hint: error.hint }
    }
}

/// The call that makes a table of all inputs of a pattern; and the loop of a shell that makes each
/// of them into a folder of its own.
pub(crate) fn for_all(pattern: &str, ending: &str) -> String {
    format!(
        "For a table with a row for each panel: `sheetwright batch {pattern} --table panels.csv`. \
         For all files, in a shell: for f in {pattern}; do sheetwright make \"$f\" --out \
         \"${{f%{ending}}}\"; done"
    )
}
