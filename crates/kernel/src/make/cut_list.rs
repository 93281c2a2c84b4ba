//! What is to be cut: each of several equal parts from the pattern of the first.

use super::Made;
use crate::pattern::{EqualPiece, Piece, Quantity, equal_pieces};

/// A pattern, and the parts that are cut from it.
#[derive(Clone, Debug, PartialEq)]
pub struct CutItem {
    /// The pattern, with its quantity under its name.
    pub piece: Piece,
    /// The parts, by their numbers in the design. The pattern is that of the first.
    pub instances: Vec<EqualPiece>,
}

impl CutItem {
    fn new(made: &Made, instances: Vec<EqualPiece>) -> Self {
        let piece = made.parts[instances[0].number].piece.clone();
        Self { piece: piece.counted(quantity(&instances)), instances }
    }

    /// The part whose pattern it is, by its number in the design.
    pub fn first(&self) -> usize {
        self.instances[0].number
    }

    /// The part of this number in the design, if it is cut from this pattern.
    pub fn instance(&self, part: usize) -> Option<&EqualPiece> {
        self.instances.iter().find(|instance| instance.number == part)
    }

    /// How many parts are cut.
    pub fn quantity(&self) -> Quantity {
        quantity(&self.instances)
    }
}

fn quantity(instances: &[EqualPiece]) -> Quantity {
    let mirrored = instances.iter().filter(|instance| instance.mirrored).count();
    Quantity { count: instances.len(), mirrored }
}

impl Made {
    /// The patterns to cut, in the order of the design: equal parts are one of them.
    pub fn cut_list(&self) -> Vec<CutItem> {
        let groups = equal_pieces(self.parts.iter().map(|part| &part.piece));
        groups.into_iter().map(|instances| CutItem::new(self, instances)).collect()
    }

    /// As [`cut_list`](Self::cut_list), but every part by itself.
    pub fn cut_each(&self) -> Vec<CutItem> {
        let alone = |number| EqualPiece { number, mirrored: false, off_mm: 0.0 };
        (0..self.parts.len()).map(|n| CutItem::new(self, vec![alone(n)])).collect()
    }
}
