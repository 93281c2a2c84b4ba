//! What a DXF file holds: lines on layers, and line types. Folds are dashed, mountains and valleys
//! by names that a program can select.

use super::pairs::{Pairs, real};
use crate::preset::Layer;
use crate::shapes::{FileLine, What};

/// A line of a file.
pub(super) struct Entity {
    pub(super) layer: &'static str,
    /// `None` of a line as its layer has it.
    pub(super) line_type: Option<&'static LineType>,
    pub(super) line: FileLine,
}

impl Entity {
    /// The name of its line type, if that is another than its layer's.
    pub(super) fn type_name(&self) -> Option<&'static str> {
        self.line_type.map(|line_type| line_type.name)
    }
}

/// What a file declares.
#[derive(Clone, Copy)]
pub(super) struct Tables<'a> {
    pub(super) layers: &'a [&'static Layer],
    /// The line types besides the solid one.
    pub(super) types: &'a [&'static LineType],
}

/// A line type that a file declares.
#[derive(Debug, PartialEq)]
pub(super) struct LineType {
    pub(super) name: &'static str,
    pub(super) about: &'static str,
    /// The lengths of dashes, and of gaps with a minus, mm.
    dashes: &'static [f64],
}

/// Mountain folds are dashed, as in SVG.
static MOUNTAIN: LineType =
    LineType { name: "MOUNTAIN", about: "Mountain fold __ __ __", dashes: &[3.0, -1.5] };
/// Valley folds have dashes and dots.
static VALLEY: LineType =
    LineType { name: "VALLEY", about: "Valley fold __ . __ .", dashes: &[4.0, -1.5, 0.3, -1.5] };

impl LineType {
    /// All, in the order of the table.
    pub(super) const ALL: [&'static Self; 2] = [&MOUNTAIN, &VALLEY];

    /// The line type of a shape; `None` of one that is a solid line, as its layer says.
    pub(super) fn of(what: &What) -> Option<&'static Self> {
        match what {
            What::Fold { mountain: true } => Some(&MOUNTAIN),
            What::Fold { mountain: false } => Some(&VALLEY),
            _ => None,
        }
    }

    /// Writes its pattern. From release 2000 on, a dash says that it holds no text.
    pub(super) fn put_pattern(&self, pairs: &mut Pairs, says_plain: bool) {
        pairs.put(72, 65);
        pairs.put(73, self.dashes.len());
        pairs.put(40, real(self.dashes.iter().map(|dash| dash.abs()).sum()));
        for &dash in self.dashes {
            pairs.put(49, real(dash));
            if says_plain {
                pairs.put(74, 0);
            }
        }
    }
}
