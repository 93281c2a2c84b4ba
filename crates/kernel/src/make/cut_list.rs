//! What is to be cut: each of several equal parts from the pattern of the first, as often as the
//! panels of all of them ask for.

use super::{Made, Part};
use crate::design::Design;
use crate::pattern::{EqualPiece, Piece, Quantity, equal_pieces};
use std::collections::BTreeMap;

/// A pattern, and the parts that are cut from it.
#[derive(Clone, Debug, PartialEq)]
pub struct CutItem {
    /// The pattern, with its quantity under its name.
    pub piece: Piece,
    /// The parts, by their numbers in the design. The pattern is that of the first.
    pub instances: Vec<EqualPiece>,
    quantity: Quantity,
}

impl CutItem {
    fn new(made: &Made, instances: Vec<EqualPiece>) -> Self {
        let piece = made.parts[instances[0].number].piece.clone();
        let quantity = quantity(made, &instances);
        Self { piece: piece.counted(quantity), instances, quantity }
    }

    /// The part whose pattern it is, by its number in the design.
    pub fn first(&self) -> usize {
        self.instances[0].number
    }

    /// The part of this number in the design, if it is cut from this pattern.
    pub fn instance(&self, part: usize) -> Option<&EqualPiece> {
        self.instances.iter().find(|instance| instance.number == part)
    }

    /// The part, by its number in the design, for each copy that is cut as the pattern lies, or
    /// turned over: part after part.
    pub fn copies(&self, made: &Made, turned_over: bool) -> Vec<usize> {
        let of_instance = |instance: &EqualPiece| {
            let Quantity { count, mirrored } = made.wanted[instance.number];
            let is_other = instance.mirrored != turned_over;
            let copies = if is_other { mirrored } else { count - mirrored };
            std::iter::repeat_n(instance.number, copies)
        };
        self.instances.iter().flat_map(of_instance).collect()
    }

    /// How many parts are cut.
    pub fn quantity(&self) -> Quantity {
        self.quantity
    }
}

/// How many are cut from a pattern for some parts. What a turned part wants turned over lies as the
/// pattern does.
fn quantity(made: &Made, instances: &[EqualPiece]) -> Quantity {
    let mut all = Quantity { count: 0, mirrored: 0 };
    for instance in instances {
        let Quantity { count, mirrored } = made.wanted[instance.number];
        all.count += count;
        all.mirrored += if instance.mirrored { count - mirrored } else { mirrored };
    }
    all
}

/// How many of each part its panel asks for: at least one, and no more turned over than that.
pub(super) fn wanted(design: &Design, parts: &[Part]) -> Vec<Quantity> {
    let counts: BTreeMap<&str, (u32, u32)> =
        design.panels.iter().map(|p| (&p.name[..], (p.count, p.mirrored))).collect();
    let of_part = |part: &Part| {
        let (count, mirrored) = counts.get(&part.panel[..]).copied().unwrap_or((1, 0));
        let count = count.max(1);
        Quantity { count: count as usize, mirrored: mirrored.min(count) as usize }
    };
    parts.iter().map(of_part).collect()
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
