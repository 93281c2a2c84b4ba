//! Errors of a design: the panel or curve, and the cause.

use std::fmt;

/// An error of a design: the panel or curve, and the cause.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure<C> {
    /// The panel; empty where it is a curve or the design as a whole.
    pub panel: String,
    /// The curve, if it is one.
    pub curve: Option<String>,
    /// The cause.
    pub cause: C,
}

impl<C> Failure<C> {
    /// Of the design as a whole.
    pub(crate) fn of_design(cause: impl Into<C>) -> Self {
        Self { panel: String::new(), curve: None, cause: cause.into() }
    }

    /// Of a panel.
    pub(crate) fn of_panel(panel: &str, cause: impl Into<C>) -> Self {
        Self { panel: panel.to_owned(), curve: None, cause: cause.into() }
    }

    /// Of a curve, in any panel.
    pub(crate) fn of_curve(curve: &str, cause: impl Into<C>) -> Self {
        Self { panel: String::new(), curve: Some(curve.to_owned()), cause: cause.into() }
    }

    /// Of a curve as a panel uses it.
    pub(crate) fn of_curve_in(panel: &str, curve: &str, cause: impl Into<C>) -> Self {
        Self { panel: panel.to_owned(), curve: Some(curve.to_owned()), cause: cause.into() }
    }

    /// With its cause as one of a later stage.
    pub(crate) fn caused<D>(self, into: impl FnOnce(C) -> D) -> Failure<D> {
        Failure { panel: self.panel, curve: self.curve, cause: into(self.cause) }
    }
}

impl<C: fmt::Display> fmt::Display for Failure<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.panel[..], &self.curve) {
            ("", None) => {}
            ("", Some(curve)) => write!(f, "curve '{curve}': ")?,
            (panel, None) => write!(f, "panel '{panel}': ")?,
            (panel, Some(curve)) => write!(f, "panel '{panel}', curve '{curve}': ")?,
        }
        write!(f, "{}", self.cause)
    }
}

impl<C: fmt::Debug + fmt::Display> std::error::Error for Failure<C> {}
