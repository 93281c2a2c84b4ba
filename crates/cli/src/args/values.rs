//! Values that several options take.

use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use std::ffi::OsStr;

pub(super) fn size_mm(given: &str) -> Result<f64, String> {
    let mm = sheetwright_files::size_mm(given);
    mm.ok_or_else(|| "give a length above 0, such as 300, 300mm or 12in".to_owned())
}

pub(super) fn distance_mm(given: &str) -> Result<f64, String> {
    let mm = sheetwright_files::distance_mm(given);
    mm.ok_or_else(|| "give a length of 0 or more, such as 2, 2mm or 1/8in".to_owned())
}

/// Any name; completions and help show the known ones. An unknown name is refused later, with the
/// nearest known one, as everywhere.
#[derive(Clone)]
pub(super) struct Name {
    /// The known ones.
    pub(super) known: fn() -> Vec<PossibleValue>,
}

impl TypedValueParser for Name {
    type Value = String;

    fn parse_ref(
        &self,
        command: &clap::Command,
        arg: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<String, clap::Error> {
        StringValueParser::new().parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new((self.known)().into_iter()))
    }
}
