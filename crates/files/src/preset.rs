//! Which layer of a pattern's SVG or DXF each role goes to, in which order and colour.

use crate::shapes::Shape;
use sheetwright::pattern::Role;

/// A layer of a DXF, or a group of an SVG.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Layer {
    /// The name of the layer, and the `id` of the group.
    pub(crate) name: &'static str,
    /// The roles on it, in the order in which they are written.
    pub(crate) roles: &'static [Role],
    /// The colour of its lines in an SVG.
    pub(crate) colour: &'static str,
    /// The colour of its lines in a DXF, as AutoCAD numbers them.
    pub(crate) number: u8,
    /// The colour in words, and what to know besides.
    pub(crate) words: &'static str,
}

impl Layer {
    /// Whether the layer is left out of files that would have nothing on it.
    pub(crate) fn is_optional(&self) -> bool {
        self.roles == [Role::Net]
    }

    /// Whether the sheet is cut through along its lines.
    pub(crate) fn is_cut(&self) -> bool {
        self.roles.iter().any(|role| role.is_cut())
    }

    /// Its shapes, in order.
    pub(crate) fn shapes<'a>(&self, all: &'a [Shape]) -> impl Iterator<Item = &'a Shape> {
        self.roles.iter().flat_map(|&role| all.iter().filter(move |shape| shape.role == role))
    }
}

/// The layers of a file, in order. By the widest custom red is cut, blue scored and black
/// engraved; grey has no operation.
pub(crate) const LAYERS: [Layer; 5] = [
    Layer {
        name: "cut",
        roles: &[Role::Cut, Role::Inner, Role::Drill],
        colour: "#ff0000",
        number: 1,
        words: "red",
    },
    Layer { name: "score", roles: &[Role::Score], colour: "#0000ff", number: 5, words: "blue" },
    Layer {
        name: "net",
        roles: &[Role::Net],
        colour: "#ff00ff",
        number: 6,
        words: "magenta, the edge of the finished piece",
    },
    Layer {
        name: "engrave",
        roles: &[Role::Engrave],
        colour: "#000000",
        number: 7,
        words: "black",
    },
    Layer {
        name: "note",
        roles: &[Role::Note],
        colour: "#999999",
        number: 8,
        words: "grey, for people alone",
    },
];

/// The layers of a file that shows these shapes, in order.
pub(crate) fn layers(shapes: &[Shape]) -> impl Iterator<Item = &'static Layer> {
    LAYERS.iter().filter(|layer| !layer.is_optional() || layer.shapes(shapes).next().is_some())
}
