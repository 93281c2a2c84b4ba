//! Errors with a hint: `pysheetwright.SheetwrightError`.

use crate::remedies::with_keywords;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;
use sheetwright::design::Design;
use sheetwright::make::MakeError;
use sheetwright_files::whole::WriteError;
use sheetwright_files::{FAULT, InputError, OutputError, hint_in_design, remedy_for};

/// Why a call failed.
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

    /// A design that can't be made.
    pub(crate) fn of_make(error: &MakeError, design: &Design) -> Self {
        let hint = with_keywords(&hint_in_design(error, design), remedy_for(error));
        Self::new(error.to_string(), hint)
    }

    /// A setting that has none of its values.
    pub(crate) fn of_choice(setting: &str, given: &str, known: &[&str]) -> Self {
        let message = format!("{setting}: {given:?} is not known");
        Self::new(message, format!("Give one of {}.", known.join(", ")))
    }
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

impl From<OutputError> for Failure {
    fn from(error: OutputError) -> Self {
        Self::new(error.to_string(), error.hint().unwrap_or(FAULT))
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        static ERROR: PyOnceLock<Py<PyType>> = PyOnceLock::new();
        let Failure { message, place, hint } = failure;
        Python::attach(|py| {
            let class = ERROR.import(py, "pysheetwright.errors", "SheetwrightError");
            match class.and_then(|class| class.call1((message, hint, place))) {
                Ok(error) => Self::from_value(error),
                Err(error) => error,
            }
        })
    }
}
