//! Which face of the sheet a drawing is of.

/// Which face of the sheet the curves of a design lie on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimensions {
    /// The inner one of its bends, as duct shops give clear sizes.
    Inside,
    /// The middle of the sheet.
    Mean,
    /// The outer one.
    Outside,
}

impl Dimensions {
    /// Every face.
    pub const ALL: [Self; 3] = [Self::Inside, Self::Mean, Self::Outside];

    /// How deep it lies in the sheet from the inner face of a bend, as a share of the thickness.
    pub(crate) fn share(self) -> f64 {
        match self {
            Self::Inside => 0.0,
            Self::Mean => 0.5,
            Self::Outside => 1.0,
        }
    }

    /// How designs and reports name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Inside => "inside",
            Self::Mean => "mean",
            Self::Outside => "outside",
        }
    }
}

/// A sheet whose thickness the pattern minds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thick {
    /// Which face was drawn.
    pub dimensions: Dimensions,
    /// How thick the sheet is, mm.
    pub thickness_mm: f64,
    /// The inner radius of the tool that makes sharp folds, mm; `None` where none makes them, and
    /// their sides meet as mitred boards do.
    pub fold_radius_mm: Option<f64>,
}
