//! Presets: which layer of a pattern's SVG or DXF each role goes to, in which order and colour.
//!
//! A machine's program tells cutting from scoring by the colours of lines, by the names of layers
//! or not at all, and runs them in the order of the file. Each preset is a row of [`PRESETS`]:
//! its layers in the order of the file, and on each layer roles in order. A role that stands on no
//! layer is left out. `docs/outputs.md` has the table for readers, which a test compares with this
//! one.

use crate::shapes::{FileLine, Shape, What};
use sheetwright::pattern::Role;

/// A release of DXF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DxfRelease {
    /// Release 12: every program reads it; it has no place for the unit.
    #[default]
    R12,
    /// Release 2000: it says that the unit is the millimetre.
    R2000,
}

impl DxfRelease {
    /// Every release, the default first.
    pub const ALL: [Self; 2] = [Self::R12, Self::R2000];

    /// Its name in commands.
    pub fn name(self) -> &'static str {
        match self {
            Self::R12 => "r12",
            Self::R2000 => "r2000",
        }
    }

    /// The release of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|release| release.name() == name)
    }
}

/// How a machine's program wants its files.
#[derive(Debug, PartialEq)]
pub struct Preset {
    /// Its name in commands and designs.
    pub name: &'static str,
    /// What it is for, in a few words.
    pub about: &'static str,
    /// Its layers, in the order of the file.
    layers: &'static [Layer],
    /// Whether every line to cut is closed: a notch runs there and back.
    closes_cuts: bool,
    /// The release of its DXF files, unless another is asked for.
    pub dxf: DxfRelease,
}

/// A layer of a DXF, or a group of an SVG.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// How wide its lines are where they are drawn as filled areas, mm; `None` of plain lines.
    pub(crate) filled_mm: Option<f64>,
}

use Role::{Cut, Drill, Engrave, Inner, Net, Note, Score, Sheet};

/// A layer of plain lines: name, roles, colours of SVG and DXF, and the colour in words.
const fn lines(
    name: &'static str,
    roles: &'static [Role],
    colour: &'static str,
    number: u8,
    words: &'static str,
) -> Layer {
    Layer { name, roles, colour, number, words, filled_mm: None }
}

/// A layer whose lines are filled areas, as wide as a laser engraves cleanly.
const fn filled(layer: Layer) -> Layer {
    Layer { filled_mm: Some(0.3), ..layer }
}

const R12: DxfRelease = DxfRelease::R12;

/// Every preset.
static PRESETS: [Preset; 7] = [
    Preset {
        name: "generic",
        about: "any program: a layer for each kind of work",
        // By the widest custom red is cut, blue scored and black engraved; grey has no operation.
        layers: &[
            lines("cut", &[Drill, Inner, Cut], "#ff0000", 1, "red"),
            lines("score", &[Score], "#0000ff", 5, "blue"),
            lines("net", &[Net], "#ff00ff", 6, "magenta, the edge of the finished piece"),
            lines("engrave", &[Engrave], "#000000", 7, "black"),
            lines("note", &[Note], "#999999", 8, "grey, for people alone"),
            lines("sheet", &[Sheet], "#00a0a0", 4, "cyan, the edge of the sheet"),
        ],
        closes_cuts: false,
        dxf: R12,
    },
    Preset {
        name: "lightburn",
        about: "LightBurn, which takes layers from its own colours and runs them in this order",
        layers: &[
            lines("engrave", &[Engrave], "#000000", 7, "C00, black"),
            lines("score", &[Score], "#0000ff", 5, "C01, blue"),
            lines("net", &[Net], "#ff8000", 30, "C05, orange, the edge of the finished piece"),
            lines("inner", &[Drill, Inner], "#00e000", 3, "C03, green, holes"),
            lines("cut", &[Cut], "#ff0000", 1, "C02, red"),
            lines("note", &[Note], "#f36926", 32, "T1, a tool layer, which does not burn"),
            lines("sheet", &[Sheet], "#0c96d9", 150, "T2, a tool layer, the edge of the sheet"),
        ],
        closes_cuts: false,
        dxf: R12,
    },
    Preset {
        name: "glowforge",
        about: "Glowforge, which takes one step from each colour of an SVG; filled areas engrave",
        layers: &[
            filled(lines("engrave", &[Engrave], "#000000", 7, "black, filled: engrave")),
            lines("score", &[Score], "#0000ff", 5, "blue: set it to score"),
            lines("net", &[Net], "#ff8000", 30, "orange: score it or leave it out"),
            lines("inner", &[Drill, Inner], "#00a000", 3, "green: cut"),
            lines("cut", &[Cut], "#ff0000", 1, "red: cut"),
        ],
        closes_cuts: false,
        dxf: R12,
    },
    Preset {
        name: "cricut",
        about: "Cricut Design Space, which cuts closed paths; set scores and pens there by colour",
        layers: &[
            lines("cut", &[Drill, Inner, Cut], "#ff0000", 1, "red: basic cut"),
            lines("score", &[Score], "#0000ff", 5, "blue: set it to score"),
            lines("net", &[Net], "#ff8000", 30, "orange: set it to pen, or hide it"),
            lines("draw", &[Engrave], "#000000", 7, "black: set it to pen"),
        ],
        closes_cuts: true,
        dxf: R12,
    },
    Preset {
        name: "silhouette",
        about: "Silhouette Studio, whose Basic Edition opens DXF; lines by colour or layer",
        layers: &[
            lines("draw", &[Engrave], "#000000", 7, "black: pen"),
            lines("score", &[Score], "#0000ff", 5, "blue: score"),
            lines("net", &[Net], "#ff8000", 30, "orange: pen or no cut"),
            lines("inner", &[Drill, Inner], "#00ff00", 3, "green: cut"),
            lines("cut", &[Cut], "#ff0000", 1, "red: cut"),
        ],
        closes_cuts: true,
        dxf: R12,
    },
    Preset {
        name: "plotter",
        about: "pen and knife plotters: one pen a layer, drawn before anything is cut",
        layers: &[
            lines("pen", &[Note, Engrave], "#000000", 7, "black, pen"),
            lines("crease", &[Net, Score], "#0000ff", 5, "blue, creasing wheel"),
            lines("knife", &[Drill, Inner, Cut], "#ff0000", 1, "red, knife: holes first"),
        ],
        closes_cuts: false,
        dxf: R12,
    },
    Preset {
        name: "wazer",
        about: "WAZER and other jets of water: what is cut through, on one layer, with its unit",
        layers: &[lines("cut", &[Drill, Inner, Cut], "#000000", 7, "black: holes first")],
        closes_cuts: false,
        dxf: DxfRelease::R2000,
    },
];

impl Preset {
    /// Every preset, the default first.
    pub fn all() -> &'static [Self] {
        &PRESETS
    }

    /// The default.
    pub fn generic() -> &'static Self {
        &PRESETS[0]
    }

    /// The preset of a name.
    pub fn from_name(name: &str) -> Option<&'static Self> {
        PRESETS.iter().find(|preset| preset.name == name)
    }

    /// Whether its files show what has this role.
    pub fn shows(&self, role: Role) -> bool {
        self.layers.iter().any(|layer| layer.roles.contains(&role))
    }

    /// Its layers as rows of the table in `docs/outputs.md`: roles, layer, colours, words.
    pub fn table_rows(&self) -> Vec<String> {
        let row = |layer: &Layer| {
            let roles: Vec<&str> = layer.roles.iter().map(|role| role.name()).collect();
            let Layer { name, colour, number, words, .. } = layer;
            let roles = roles.join(", ");
            format!("| `{}` | `{name}` | {roles} | `{colour}` | {number} | {words} |", self.name)
        };
        self.layers.iter().map(row).collect()
    }

    /// Whether its files show what has this role as plain lines, so that a reader finds the ends of
    /// a rung.
    pub(crate) fn draws_lines(&self, role: Role) -> bool {
        let is_plain = |layer: &Layer| layer.filled_mm.is_none() && layer.roles.contains(&role);
        self.layers.iter().any(is_plain)
    }

    /// Its layers, in the order of the file.
    pub(crate) fn all_layers(&self) -> &'static [Layer] {
        self.layers
    }

    /// The layers of a file that shows these shapes, in order: a layer for the net alone only
    /// where there is one.
    pub(crate) fn layers(&self, shapes: &[Shape]) -> Vec<&'static Layer> {
        let is_there =
            |layer: &&Layer| !layer.is_optional() || layer.shapes(shapes).next().is_some();
        self.layers.iter().filter(is_there).collect()
    }

    /// The lines that draw a shape on a layer.
    pub(crate) fn drawn(&self, layer: &Layer, shape: &Shape) -> Vec<FileLine> {
        if let What::Drill { centre, radius_mm } = shape.what {
            return vec![FileLine::circle(centre, radius_mm)];
        }
        let lines = shape.lines.iter();
        if let Some(width_mm) = layer.filled_mm {
            return lines.flat_map(|line| FileLine::areas(line, shape.closed, width_mm)).collect();
        }
        lines
            .map(|line| match shape.closed {
                false if self.closes_cuts && layer.is_cut() => FileLine::there_and_back(line),
                closed => FileLine::polyline(line.clone(), closed),
            })
            .collect()
    }

    /// The lines of a file that shows these shapes, each with its layer and its shape, in order.
    pub(crate) fn lines<'a>(
        &'a self,
        shapes: &'a [Shape],
    ) -> impl Iterator<Item = (&'static Layer, &'a Shape, FileLine)> + 'a {
        self.layers.iter().flat_map(move |layer| {
            layer.shapes(shapes).flat_map(move |shape| {
                self.drawn(layer, shape).into_iter().map(move |line| (layer, shape, line))
            })
        })
    }
}

impl Layer {
    /// Whether the layer is left out of files that would have nothing on it.
    pub(crate) fn is_optional(&self) -> bool {
        self.roles == [Net] || self.roles == [Sheet]
    }

    /// Whether the sheet is cut through along its lines.
    pub(crate) fn is_cut(&self) -> bool {
        self.roles.iter().any(|role| role.is_cut())
    }

    /// Its shapes, in order. On a sheet, which is cut in the order of the file, outlines come last:
    /// what is cut out first can't be cut inside any more.
    pub(crate) fn shapes<'a>(&self, all: &'a [Shape]) -> impl Iterator<Item = &'a Shape> + use<'a> {
        let is_sheet = all.iter().any(|shape| shape.role == Sheet);
        let mut roles = self.roles.to_vec();
        roles.sort_by_key(|&role| is_sheet && role == Cut);
        roles.into_iter().flat_map(move |role| all.iter().filter(move |shape| shape.role == role))
    }
}
