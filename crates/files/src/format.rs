//! The kinds of files that are written: their names, and what there is to know of each.

/// A kind of output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Format {
    /// `surface.obj`: the surfaces of all panels.
    Obj,
    /// `PANEL.svg`: the pattern of each panel.
    Svg,
    /// `PANEL.dxf`: the pattern of each panel, for programs that read no SVG.
    Dxf,
    /// `pattern.pdf`: the patterns on sheets of paper.
    Pdf,
    /// `quads.obj`: the panels in planar quads.
    Quads,
    /// `surface.step`: the panels as smooth surfaces for CAD.
    Step,
    /// `pattern.fold`: the patterns with their folds, for origami programs.
    Fold,
    /// `pattern-astm.dxf`: the patterns for cutters of cloth and leather.
    Astm,
    /// `offsets.csv`: where the edges of each pattern lie at stations along a base line.
    Offsets,
    /// `brake.csv`: the plan for the press brake, or for plate rolls.
    Brake,
    /// `parts.csv`: what is to be cut, and how often.
    Parts,
    /// `sheets.svg` and `sheets.dxf`: the parts laid out on sheets.
    Sheets,
    /// `assembly.pdf`: the book that a builder works from.
    Assembly,
    /// `report.json` and `report.html`.
    Report,
}

/// What there is to know of a format.
struct Facts {
    format: Format,
    /// Its name in commands and designs.
    name: &'static str,
    /// What people call it, and what it is for.
    about: (&'static str, &'static str),
    /// Whether it is written unless formats are named.
    by_default: bool,
    /// Whether it needs rulings, which meshes do not have.
    needs_rulings: bool,
}

/// A format that is written by default, of any design.
const fn usual(format: Format, name: &'static str, about: (&'static str, &'static str)) -> Facts {
    Facts { format, name, about, by_default: true, needs_rulings: false }
}

/// A format that is written only where it is named.
const fn named(format: Format, name: &'static str, about: (&'static str, &'static str)) -> Facts {
    Facts { by_default: false, ..usual(format, name, about) }
}

/// A format that is written only where it is named, and not of meshes.
const fn ruled(format: Format, name: &'static str, about: (&'static str, &'static str)) -> Facts {
    Facts { needs_rulings: true, ..named(format, name, about) }
}

/// Every format, in the order in which files are written. The report comes last, since it says what
/// was found in the others.
static FACTS: [Facts; COUNT] = FACTS_OF_ALL;
const COUNT: usize = 14;
const FACTS_OF_ALL: [Facts; COUNT] = [
    usual(Format::Obj, "obj", ("Surface (OBJ)", "The sheet in space, for other 3D programs.")),
    usual(
        Format::Svg,
        "svg",
        ("Pattern (SVG)", "For laser cutters, plotters and drawing programs."),
    ),
    usual(Format::Dxf, "dxf", ("Pattern (DXF)", "For CAD and machines that read no SVG.")),
    usual(
        Format::Pdf,
        "pdf",
        ("Pattern to print (PDF)", "True to scale on sheets of paper, to tape together."),
    ),
    ruled(
        Format::Quads,
        "quads",
        ("Flat facets (OBJ)", "Planar quadrilaterals, for folding and glazing."),
    ),
    ruled(Format::Step, "step", ("Smooth surface (STEP)", "For CAD programs.")),
    named(
        Format::Fold,
        "fold",
        ("Folds (FOLD)", "The pattern with the angle of every fold, for origami programs."),
    ),
    named(
        Format::Astm,
        "astm",
        ("Pieces for cutters (ASTM)", "For machines that cut cloth and leather."),
    ),
    named(
        Format::Offsets,
        "offsets",
        ("Offsets (CSV)", "Where the edges lie along a base line, to mark out by hand."),
    ),
    named(
        Format::Brake,
        "brake",
        ("Bends (CSV)", "The order, angle and place of each bend, for a press brake."),
    ),
    named(
        Format::Parts,
        "parts",
        ("Parts (CSV)", "What to cut: each pattern with its count, size and edges."),
    ),
    named(
        Format::Sheets,
        "sheets",
        ("Sheets (SVG, DXF)", "All parts laid out on sheets, to cut in one go."),
    ),
    named(
        Format::Assembly,
        "assembly",
        ("Assembly book (PDF)", "What to buy, every part, the order of joining, what to measure."),
    ),
    usual(
        Format::Report,
        "report",
        ("Report", "The verdict, the pictures and all numbers, as a page and as data."),
    ),
];

/// The formats of which this holds; they are `N`.
const fn formats_of<const N: usize>(defaults_alone: bool) -> [Format; N] {
    let mut formats = [Format::Report; N];
    let (mut n, mut row) = (0, 0);
    while row < COUNT && n < N {
        if FACTS_OF_ALL[row].by_default || !defaults_alone {
            formats[n] = FACTS_OF_ALL[row].format;
            n += 1;
        }
        row += 1;
    }
    formats
}

impl Format {
    /// Every format, in the order in which files are written.
    pub const ALL: [Self; COUNT] = formats_of(false);
    /// The formats that are written by default.
    pub const DEFAULT: [Self; 5] = formats_of(true);

    fn facts(self) -> &'static Facts {
        // Facts and formats have one order, which a test holds.
        &FACTS[self as usize]
    }

    /// Whether the format needs rulings, which meshes do not have.
    pub fn needs_rulings(self) -> bool {
        self.facts().needs_rulings
    }

    /// Its name in commands and designs.
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// What people call it, and what it is for.
    pub fn about(self) -> (&'static str, &'static str) {
        self.facts().about
    }

    /// The format of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.name() == name)
    }
}
