//! How often a piece is cut, under its name.

use super::{LabelKind, PatternLabel, Piece};

/// The letters are as high as those of the name times this.
const BESIDE_NAME: f64 = 0.6;
/// Lower letters can't be read.
const LEAST_MM: f64 = 1.5;
/// The base line lies this far below that of the name, as a share of the height of its letters.
const BELOW: f64 = 1.0;

/// How many equal parts are cut from one pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// All of them.
    pub count: usize,
    /// Those of them that are the piece turned over.
    pub mirrored: usize,
}

impl Quantity {
    /// In words, such as `cut 2, 1 mirrored`; `None` of a single part.
    pub fn text(self) -> Option<String> {
        match self {
            Self { count: ..=1, .. } => None,
            Self { count, mirrored: 0 } => Some(format!("cut {count}")),
            Self { count, mirrored } => Some(format!("cut {count}, {mirrored} mirrored")),
        }
    }
}

impl Piece {
    /// The piece with its quantity under its name, if there are several of it.
    pub(crate) fn counted(mut self, quantity: Quantity) -> Self {
        let name = self.labels.iter().position(|label| label.kind == LabelKind::Name);
        if let (Some(text), Some(n)) = (quantity.text(), name) {
            let name = &self.labels[n];
            let height_mm = (BESIDE_NAME * name.height_mm).max(LEAST_MM);
            let below_mm = BELOW * name.height_mm.max(height_mm);
            let at = name.at + name.along.perp() * -below_mm;
            let label = PatternLabel {
                kind: LabelKind::Quantity,
                role: name.role,
                at,
                along: name.along,
                height_mm,
                text,
            };
            self.labels.insert(n + 1, label);
        }
        self
    }
}
