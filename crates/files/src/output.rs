//! All files of a made design.

use crate::astm::write_astm;
use crate::brake::BrakeSettings;
use crate::design_json::write_design_of_table;
use crate::dxf::write_dxf_for;
use crate::fold::write_fold;
use crate::names::{folded, refused_for_file};
use crate::obj::write_obj;
use crate::offsets::{OffsetOptions, write_offsets};
use crate::parts::write_parts;
use crate::pdf::{PdfOptions, Reduced, write_pieces};
use crate::preset::{DxfRelease, Preset};
use crate::quads::{PanelQuads, write_quads};
use crate::refold::{PatternFiles, RefoldFileError, refold_finding, refold_piece_error_mm};
use crate::report::{ReportForm, Written, report_html, report_json};
use crate::step::write_step;
use crate::svg::write_svg_for;
use crate::table::write_table;
use crate::units::Units;
use sheetwright::bend::Hit;
use sheetwright::check::{Checked, Finding, FindingKind, braking};
use sheetwright::design::Design;
use sheetwright::make::{CutItem, Made, Part};
use sheetwright::pattern::{EqualPiece, Piece};
use std::collections::BTreeMap;
use std::fmt;

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
    /// `report.json` and `report.html`.
    Report,
}

/// What there is to know of a format: a new one is a row of [`ROWS`].
struct Row {
    format: Format,
    /// Its name in commands and designs.
    name: &'static str,
    /// What people call it, and what it is for.
    about: (&'static str, &'static str),
    /// Whether it is written unless formats are named.
    by_default: bool,
    /// Whether it needs rulings, which meshes do not have.
    needs_rulings: bool,
    /// Its files.
    files: &'static [(FileName, Writer)],
}

/// What a file is called.
enum FileName {
    /// After its part, with this ending.
    OfPart(&'static str),
    /// There is one, of this name.
    Whole(&'static str),
}

/// What writes a file.
enum Writer {
    Piece(fn(&Piece, &OutputOptions) -> Vec<u8>),
    Design(fn(&mut Run<'_>) -> Result<Vec<u8>, OutputError>),
}

use FileName::{OfPart, Whole};

/// Every format, in the order in which files are written. The report comes last, since it says what
/// was found in the others.
const ROWS: [Row; 12] = [
    Row {
        format: Format::Obj,
        name: "obj",
        about: ("Surface (OBJ)", "The sheet in space, for other 3D programs."),
        by_default: true,
        needs_rulings: false,
        files: &[(Whole("surface.obj"), Writer::Design(|run| Ok(write_obj(run.made))))],
    },
    Row {
        format: Format::Svg,
        name: "svg",
        about: ("Pattern (SVG)", "For laser cutters, plotters and drawing programs."),
        by_default: true,
        needs_rulings: false,
        files: &[(
            OfPart(".svg"),
            Writer::Piece(|piece, options| write_svg_for(piece, options.preset)),
        )],
    },
    Row {
        format: Format::Dxf,
        name: "dxf",
        about: ("Pattern (DXF)", "For CAD and machines that read no SVG."),
        by_default: true,
        needs_rulings: false,
        files: &[(
            OfPart(".dxf"),
            Writer::Piece(|piece, options| write_dxf_for(piece, options.preset, options.release())),
        )],
    },
    Row {
        format: Format::Pdf,
        name: "pdf",
        about: ("Pattern to print (PDF)", "True to scale on sheets of paper, to tape together."),
        by_default: true,
        needs_rulings: false,
        files: &[(Whole("pattern.pdf"), Writer::Design(|run| Ok(run.pdf())))],
    },
    Row {
        format: Format::Quads,
        name: "quads",
        about: ("Flat facets (OBJ)", "Planar quadrilaterals, for folding and glazing."),
        by_default: false,
        needs_rulings: true,
        files: &[(Whole("quads.obj"), Writer::Design(|run| Ok(write_quads(&run.named_quads()))))],
    },
    Row {
        format: Format::Step,
        name: "step",
        about: ("Smooth surface (STEP)", "For CAD programs."),
        by_default: false,
        needs_rulings: true,
        files: &[(
            Whole("surface.step"),
            Writer::Design(|run| {
                let named = run.named_quads();
                let smooth: Vec<_> =
                    named.iter().map(|(name, quads)| (*name, &quads.smooth)).collect();
                Ok(write_step(&smooth))
            }),
        )],
    },
    Row {
        format: Format::Fold,
        name: "fold",
        about: ("Folds (FOLD)", "The pattern with the angle of every fold, for origami programs."),
        by_default: false,
        needs_rulings: false,
        files: &[(Whole("pattern.fold"), Writer::Design(|run| Ok(write_fold(run.made))))],
    },
    Row {
        format: Format::Astm,
        name: "astm",
        about: ("Pieces for cutters (ASTM)", "For machines that cut cloth and leather."),
        by_default: false,
        needs_rulings: false,
        files: &[(
            Whole("pattern-astm.dxf"),
            Writer::Design(|run| Ok(write_astm(run.made, &run.patterns))),
        )],
    },
    Row {
        format: Format::Offsets,
        name: "offsets",
        about: ("Offsets (CSV)", "Where the edges lie along a base line, to mark out by hand."),
        by_default: false,
        needs_rulings: false,
        files: &[(
            Whole("offsets.csv"),
            Writer::Design(|run| {
                let pieces = run.patterns.iter().map(|pattern| &pattern.piece);
                Ok(write_offsets(pieces, &run.options.offsets))
            }),
        )],
    },
    Row {
        format: Format::Brake,
        name: "brake",
        about: ("Bends (CSV)", "The order, angle and place of each bend, for a press brake."),
        by_default: false,
        needs_rulings: false,
        files: &[(Whole("brake.csv"), Writer::Design(|run| Ok(run.brake())))],
    },
    Row {
        format: Format::Parts,
        name: "parts",
        about: ("Parts (CSV)", "What to cut: each pattern with its count, size and edges."),
        by_default: false,
        needs_rulings: false,
        files: &[(
            Whole("parts.csv"),
            Writer::Design(|run| Ok(write_parts(run.made, &run.patterns))),
        )],
    },
    Row {
        format: Format::Report,
        name: "report",
        about: ("Report", "The verdict, the pictures and all numbers, as a page and as data."),
        by_default: true,
        needs_rulings: false,
        files: &[
            (
                Whole("report.json"),
                Writer::Design(|run| Ok(report_json(run.made, &run.written(), &run.in_quads)?)),
            ),
            (
                Whole("report.html"),
                Writer::Design(|run| {
                    let (form, plans) = (run.options.report, run.plans.as_deref());
                    Ok(report_html(run.made, &run.written(), form, plans))
                }),
            ),
        ],
    },
];

/// The formats of the rows of which this holds; they are `N`.
const fn formats_of<const N: usize>(defaults_alone: bool) -> [Format; N] {
    let mut formats = [Format::Report; N];
    let (mut n, mut row) = (0, 0);
    while row < ROWS.len() && n < N {
        if ROWS[row].by_default || !defaults_alone {
            formats[n] = ROWS[row].format;
            n += 1;
        }
        row += 1;
    }
    formats
}

impl Format {
    /// Every format, in the order in which files are written.
    pub const ALL: [Self; ROWS.len()] = formats_of(false);
    /// The formats that are written by default.
    pub const DEFAULT: [Self; 5] = formats_of(true);

    fn row(self) -> &'static Row {
        static STATIC_ROWS: [Row; ROWS.len()] = ROWS;
        // Rows and formats have one order, which a test holds.
        &STATIC_ROWS[self as usize]
    }

    /// Whether the format needs rulings, which meshes do not have.
    pub fn needs_rulings(self) -> bool {
        self.row().needs_rulings
    }

    /// Its name in commands and designs.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// What people call it, and what it is for.
    pub fn about(self) -> (&'static str, &'static str) {
        self.row().about
    }

    /// The format of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.name() == name)
    }
}

/// How the files of a design are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputOptions {
    /// How patterns are laid out on paper.
    pub pdf: PdfOptions,
    /// How much `report.html` shows. Default: all of up to 100 panels, a table of more.
    pub report: ReportForm,
    /// What SVG and DXF files are written for. Default: the generic preset.
    pub preset: &'static Preset,
    /// The release of DXF files. Default: that of the preset.
    pub dxf: Option<DxfRelease>,
    /// The stations of the table of offsets.
    pub offsets: OffsetOptions,
    /// The machine that the plan of bends is for.
    pub brake: BrakeSettings,
    /// Whether each of several equal parts has a pattern of its own. Default: it is cut from the
    /// pattern of the first.
    pub each_part: bool,
}

impl Default for OutputOptions {
    fn default() -> Self {
        Self {
            pdf: PdfOptions::default(),
            report: ReportForm::default(),
            preset: Preset::generic(),
            dxf: None,
            offsets: OffsetOptions::default(),
            brake: BrakeSettings::default(),
            each_part: false,
        }
    }
}

impl OutputOptions {
    /// The default options for a design, with the preset that it names.
    pub fn of(design: &Design) -> Self {
        let named = design.preset.as_deref().and_then(Preset::from_name);
        Self { preset: named.unwrap_or(Preset::generic()), ..Self::default() }
    }

    fn release(&self) -> DxfRelease {
        self.dxf.unwrap_or(self.preset.dxf)
    }
}

/// The default options with this paper.
impl From<&PdfOptions> for OutputOptions {
    fn from(pdf: &PdfOptions) -> Self {
        Self { pdf: *pdf, ..Self::default() }
    }
}

/// A file that is ready to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputFile {
    /// Its name, without a folder.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

/// The files of a made design, and the findings from writing them.
#[derive(Clone, Debug, PartialEq)]
pub struct Outputs {
    /// The files, format after format in the order of [`Format::ALL`].
    pub files: Vec<OutputFile>,
    /// The verdict of the kernel on each panel, and the findings of the kernel and on the written
    /// files, the worst first.
    pub panels: Vec<Checked>,
    /// The refold error of each panel, mm: the largest distance of its written pattern, read back
    /// and folded up, from its surface; NaN where reading or folding fails.
    pub refold_error_mm: Vec<f64>,
}

/// Why the files of a design can't be made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OutputError {
    /// The name of a panel can't be the name of a file.
    BadName {
        /// The panel.
        panel: String,
    },
    /// Two panels would write one file on a file system that ignores case.
    SameName {
        /// The first panel.
        panel: String,
        /// The other.
        other: String,
    },
    /// `report.json` can't be written.
    Report {
        /// The error of the JSON writer.
        why: String,
    },
}

impl fmt::Display for OutputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BadName { panel } => {
                write!(f, "panel '{panel}': the name can't be the name of a file")
            }
            Self::SameName { panel, other } => {
                write!(f, "panels '{panel}' and '{other}' would write the same file")
            }
            Self::Report { why } => write!(f, "report.json can't be written: {why}"),
        }
    }
}

impl std::error::Error for OutputError {}

impl From<serde_json::Error> for OutputError {
    fn from(error: serde_json::Error) -> Self {
        Self::Report { why: error.to_string() }
    }
}

/// Makes the files of these formats, in memory. With any choice of formats, writes the pattern of
/// every part, reads it back and compares it with the pattern in memory; and writes moved curves as
/// a table, with a design that reads them from it. Formats that need rulings leave meshes out.
///
/// # Errors
/// Panels whose names can't be names of files. A written pattern that differs is a finding.
pub fn output_files(
    made: &Made,
    formats: &[Format],
    options: impl Into<OutputOptions>,
) -> Result<Outputs, OutputError> {
    check_names(made.parts.iter().map(|part| &part.name[..]))?;
    let mut run = Run::new(made, formats, options.into());
    for format in Format::ALL.into_iter().filter(|format| formats.contains(format)) {
        if format == Format::Report {
            run.prove();
        }
        run.write(format)?;
    }
    run.prove();
    if let Some(moved) = &made.moved {
        run.files.push(file(MOVED_TABLE, write_table(&moved.curves)));
        let design = write_design_of_table(moved, MOVED_TABLE, Units::Millimetres);
        run.files.push(file("moved.sheet.json", design));
    }
    let Run { files, panels, errors_mm, .. } = run;
    Ok(Outputs { files, panels, refold_error_mm: errors_mm })
}

fn file(name: impl Into<String>, bytes: Vec<u8>) -> OutputFile {
    OutputFile { name: name.into(), bytes }
}

/// The files so far, and what writers have to tell one another.
struct Run<'a> {
    made: &'a Made,
    options: OutputOptions,
    files: Vec<OutputFile>,
    /// The patterns to cut.
    patterns: Vec<CutItem>,
    /// The number of the first file of the patterns in a format; they follow one another.
    first_files: BTreeMap<Format, usize>,
    in_quads: Vec<Option<PanelQuads>>,
    /// The plans for the press brake, if they are asked for.
    plans: Option<Vec<Vec<Hit>>>,
    /// The parts that the PDF draws to a smaller scale.
    reduced: Vec<Reduced>,
    /// What was found, and the refold errors; empty until they are known.
    panels: Vec<Checked>,
    errors_mm: Vec<f64>,
}

impl<'a> Run<'a> {
    fn new(made: &'a Made, formats: &[Format], options: OutputOptions) -> Self {
        let needs_quads = formats.iter().any(|format| format.needs_rulings());
        let quads = |part: &Part| part.found().filter(|_| needs_quads).map(PanelQuads::new);
        Self {
            made,
            options,
            files: Vec::new(),
            patterns: if options.each_part { made.cut_each() } else { made.cut_list() },
            first_files: BTreeMap::new(),
            in_quads: made.parts.iter().map(quads).collect(),
            plans: formats.contains(&Format::Brake).then(|| options.brake.plans(made)),
            reduced: Vec::new(),
            panels: Vec::new(),
            errors_mm: Vec::new(),
        }
    }

    fn write(&mut self, format: Format) -> Result<(), OutputError> {
        for (name, writer) in format.row().files {
            match (name, writer) {
                (OfPart(ending), Writer::Piece(write)) => {
                    self.first_files.insert(format, self.files.len());
                    let pieces = self.patterns.iter().map(|pattern| &pattern.piece);
                    let named = pieces.map(|piece| {
                        file(format!("{}{ending}", piece.name), write(piece, &self.options))
                    });
                    self.files.extend(named);
                }
                (Whole(name), Writer::Design(write)) => {
                    let bytes = write(self)?;
                    self.files.push(file(*name, bytes));
                }
                // A file of a part comes from its piece, one of the design from the design.
                (OfPart(_), Writer::Design(_)) | (Whole(_), Writer::Piece(_)) => {}
            }
        }
        Ok(())
    }

    fn pdf(&mut self) -> Vec<u8> {
        let pieces: Vec<&Piece> = self.patterns.iter().map(|pattern| &pattern.piece).collect();
        let pdf = write_pieces(&self.made.name, &pieces, &self.options.pdf);
        self.reduced = pdf.reduced;
        pdf.bytes
    }

    fn brake(&self) -> Vec<u8> {
        let Some(plans) = &self.plans else { return Vec::new() };
        self.options.brake.table(self.made, plans, &self.patterns)
    }

    fn named_quads(&self) -> Vec<(&str, &PanelQuads)> {
        let parts = self.made.parts.iter().zip(&self.in_quads);
        parts.filter_map(|(part, quads)| Some((part.name.as_str(), quads.as_ref()?))).collect()
    }

    /// What was found in the parts and their written patterns.
    fn written(&self) -> Written<'_> {
        let Self { panels, errors_mm, patterns, .. } = self;
        Written { patterns, checked: panels, refold_errors_mm: errors_mm }
    }

    /// Reads the patterns back, once, and notes what was found. A part that is cut from the pattern
    /// of an equal one has that much more error as both differ.
    fn prove(&mut self) {
        for n in self.panels.len()..self.made.parts.len() {
            let part = &self.made.parts[n];
            let (pattern, instance) = self.pattern_of(n);
            let off_mm = instance.map_or(0.0, |instance| instance.off_mm);
            let is_first = self.patterns.get(pattern).is_some_and(|item| item.first() == n);
            let written = |format: Format| {
                let first = self.first_files.get(&format).filter(|_| is_first)?;
                Some(&self.files.get(first + pattern)?.bytes[..])
            };
            let piece = if is_first { &self.patterns[pattern].piece } else { &part.piece };
            let (svg, dxf) = (written(Format::Svg), written(Format::Dxf));
            let files = PatternFiles { svg, dxf, preset: self.options.preset };
            let mut checked = part.checked.clone();
            let error_mm = match refold_piece_error_mm(part, piece, &files) {
                Ok(error_mm) => {
                    checked.findings.extend(refold_finding(part, error_mm));
                    error_mm + off_mm
                }
                Err(error) => {
                    checked.findings.push(not_refolded(&error));
                    f64::NAN
                }
            };
            checked.findings.extend(self.in_quads[n].as_ref().and_then(PanelQuads::finding));
            let plan = self.plans.iter().flat_map(|plans| braking(&plans[n]));
            checked.findings.extend(plan);
            let reduced = self.reduced.iter().find(|reduced| is_first && reduced.panel == pattern);
            checked.findings.extend(reduced.map(Reduced::finding));
            checked.sort();
            self.errors_mm.push(error_mm);
            self.panels.push(checked);
        }
    }

    /// The pattern that a part is cut from, by its number, and how the part comes from it.
    fn pattern_of(&self, part: usize) -> (usize, Option<&EqualPiece>) {
        let instances = self.patterns.iter().map(|item| item.instance(part));
        let mut found = instances.enumerate().filter(|(_, instance)| instance.is_some());
        found.next().unwrap_or_default()
    }
}

/// The finding that a written pattern differs from the flat pattern.
fn not_refolded(error: &RefoldFileError) -> Finding {
    Finding::of_whole(FindingKind::NotReadBack { cause: error.to_string() })
}

/// The name of the table of moved curves; the design beside it takes its points from there.
const MOVED_TABLE: &str = "moved.csv";

// Readers of designs refuse such names already; designs built by a program come here unchecked.
fn check_names<'a>(names: impl Iterator<Item = &'a str>) -> Result<(), OutputError> {
    let mut seen: BTreeMap<String, &str> = BTreeMap::new();
    for name in names {
        if refused_for_file(name).is_some() {
            return Err(OutputError::BadName { panel: name.to_owned() });
        }
        if let Some(first) = seen.insert(folded(name), name) {
            return Err(OutputError::SameName { panel: first.to_owned(), other: name.to_owned() });
        }
    }
    Ok(())
}
