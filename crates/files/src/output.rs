//! All files of a made design.

use crate::design_json::write_design_of_table;
use crate::dxf::write_dxf;
use crate::names::{folded, refused_for_file};
use crate::obj::write_obj;
use crate::pdf::{PdfOptions, Reduced, WrittenPdf, write_pieces};
use crate::quads::{PanelQuads, write_quads};
use crate::refold::{RefoldFileError, refold_error_mm, refold_finding};
use crate::report::{ReportForm, report_html, report_json};
use crate::step::write_step;
use crate::svg::write_svg;
use crate::table::write_table;
use crate::units::Units;
use sheetwright::check::{Checked, Finding, FindingKind};
use sheetwright::make::Made;
use sheetwright::pattern::Piece;
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
    /// `report.json` and `report.html`.
    Report,
}

impl Format {
    /// Every format, in the order in which files are written.
    pub const ALL: [Self; 7] =
        [Self::Obj, Self::Svg, Self::Dxf, Self::Pdf, Self::Quads, Self::Step, Self::Report];
    /// The formats that are written by default.
    pub const DEFAULT: [Self; 5] = [Self::Obj, Self::Svg, Self::Dxf, Self::Pdf, Self::Report];

    /// Whether the format needs rulings, which meshes do not have.
    pub const fn needs_rulings(self) -> bool {
        matches!(self, Self::Quads | Self::Step)
    }

    /// Its name in commands and designs.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Svg => "svg",
            Self::Dxf => "dxf",
            Self::Pdf => "pdf",
            Self::Quads => "quads",
            Self::Step => "step",
            Self::Report => "report",
        }
    }

    /// The format of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.name() == name)
    }
}

/// How the files of a design are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OutputOptions {
    /// How patterns are laid out on paper.
    pub pdf: PdfOptions,
    /// How much `report.html` shows. Default: all of up to 100 panels, a table of more.
    pub report: ReportForm,
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
    let OutputOptions { pdf, report } = options.into();
    let pieces: Vec<&Piece> = made.parts.iter().map(|part| &part.piece).collect();
    check_names(made.parts.iter().map(|part| &part.name[..]))?;
    let patterns = Patterns::written(&made.name, &pieces, formats, &pdf);
    let asked = |format: Format| formats.contains(&format);
    let needs_quads = asked(Format::Quads) || asked(Format::Step);
    let in_quads: Vec<Option<PanelQuads>> = made
        .parts
        .iter()
        .map(|part| part.found().filter(|_| needs_quads).map(PanelQuads::new))
        .collect();

    let mut panels = Vec::with_capacity(made.parts.len());
    let mut errors_mm = Vec::with_capacity(made.parts.len());
    for (n, part) in made.parts.iter().enumerate() {
        let mut checked = part.checked.clone();
        let (svg, dxf) = patterns.of(n);
        match refold_error_mm(part, svg, dxf) {
            Ok(error_mm) => {
                checked.findings.extend(refold_finding(part, error_mm));
                errors_mm.push(error_mm);
            }
            Err(error) => {
                checked.findings.push(not_refolded(&error));
                errors_mm.push(f64::NAN);
            }
        }
        checked.findings.extend(in_quads[n].as_ref().and_then(PanelQuads::finding));
        panels.push(patterns.noted(n, checked));
    }

    let surface = asked(Format::Obj).then(|| write_obj(made));
    let mut files = patterns.files(surface);
    let named: Vec<(&str, &PanelQuads)> = made
        .parts
        .iter()
        .zip(&in_quads)
        .filter_map(|(part, quads)| Some((part.name.as_str(), quads.as_ref()?)))
        .collect();
    if asked(Format::Quads) {
        files.push(file("quads.obj", write_quads(&named)));
    }
    if asked(Format::Step) {
        let smooth: Vec<_> = named.iter().map(|(name, quads)| (*name, &quads.smooth)).collect();
        files.push(file("surface.step", write_step(&smooth)));
    }
    if asked(Format::Report) {
        files.push(file("report.json", report_json(made, &errors_mm, &panels, &in_quads)?));
        files.push(file("report.html", report_html(made, &errors_mm, &panels, report)));
    }
    if let Some(moved) = &made.moved {
        files.push(file(MOVED_TABLE, write_table(&moved.curves)));
        let design = write_design_of_table(moved, MOVED_TABLE, Units::Millimetres);
        files.push(file("moved.sheet.json", design));
    }
    Ok(Outputs { files, panels, refold_error_mm: errors_mm })
}

fn file(name: impl Into<String>, bytes: Vec<u8>) -> OutputFile {
    OutputFile { name: name.into(), bytes }
}

/// The files of the patterns of all parts.
struct Patterns {
    svg: Vec<OutputFile>,
    dxf: Vec<OutputFile>,
    pdf: Option<WrittenPdf>,
}

impl Patterns {
    fn written(title: &str, pieces: &[&Piece], formats: &[Format], pdf: &PdfOptions) -> Self {
        let of_pieces = |format: Format, write: fn(&Piece) -> Vec<u8>| -> Vec<OutputFile> {
            let asked = formats.contains(&format);
            let pieces = pieces.iter().filter(|_| asked);
            pieces.map(|p| file(format!("{}.{}", p.name, format.name()), write(p))).collect()
        };
        Self {
            svg: of_pieces(Format::Svg, write_svg),
            dxf: of_pieces(Format::Dxf, write_dxf),
            pdf: formats.contains(&Format::Pdf).then(|| write_pieces(title, pieces, pdf)),
        }
    }

    /// The SVG and the DXF of a piece, where they are among the formats.
    fn of(&self, n: usize) -> (Option<&[u8]>, Option<&[u8]>) {
        fn bytes_of(files: &[OutputFile], n: usize) -> Option<&[u8]> {
            files.get(n).map(|file| &file.bytes[..])
        }
        (bytes_of(&self.svg, n), bytes_of(&self.dxf, n))
    }

    /// The findings on a panel, including those on its sheets of paper, the worst first.
    fn noted(&self, n: usize, mut checked: Checked) -> Checked {
        let reduced = self.pdf.iter().flat_map(|pdf| &pdf.reduced).find(|r| r.panel == n);
        checked.findings.extend(reduced.map(Reduced::finding));
        checked.sort();
        checked
    }

    /// All of them, after the surface.
    fn files(self, surface: Option<Vec<u8>>) -> Vec<OutputFile> {
        let mut files: Vec<OutputFile> =
            surface.into_iter().map(|bytes| file("surface.obj", bytes)).collect();
        files.extend(self.svg);
        files.extend(self.dxf);
        files.extend(self.pdf.map(|pdf| file("pattern.pdf", pdf.bytes)));
        files
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
