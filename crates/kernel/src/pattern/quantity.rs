//! How often a piece is cut, under its name.

use super::edge_names::JOINED_TO;
use super::placer::Placer;
use super::{LabelKind, Piece, Room, Wish};

/// The letters are as high as those of the name times this.
const BESIDE_NAME: f64 = 0.6;
/// The base line lies this far below that of the name, as a share of the height of its letters.
const BELOW: f64 = 1.2;

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
    /// The piece with its quantity under its name, if there are several of it. Its edges then say
    /// their names alone, since each of the several is joined to others.
    pub(crate) fn counted(mut self, quantity: Quantity) -> Self {
        if quantity.count > 1 {
            for label in self.labels.iter_mut().filter(|label| label.kind == LabelKind::Edge) {
                if let Some((name, _)) = label.text.split_once(JOINED_TO) {
                    label.text = name.to_owned();
                }
            }
        }
        let name = self.labels.iter().find(|label| label.kind == LabelKind::Name);
        if let (Some(text), Some(name)) = (quantity.text(), name) {
            let height_mm = BESIDE_NAME * name.height_mm;
            let below = name.at + name.along.perp() * (-BELOW * height_mm);
            let wish = Wish::quantity(text, below);
            let room = Room::new(self.net_loops());
            let mut placer = Placer::new(room, &self.paths, &self.labels, vec![below]);
            placer.place(&wish, height_mm);
            self.paths.extend(placer.leaders);
            self.labels.extend(placer.labels);
        }
        self
    }
}
