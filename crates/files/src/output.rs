//! All files of a made design.

use crate::design_json::write_design_of_table;
use crate::dxf::write_dxf;
use crate::names::{folded, refused_for_file};
use crate::obj::write_obj;
use crate::pdf::{MaxSheets, PdfOptions, Reduced, write_pdf};
use crate::quads::{PanelQuads, write_quads};
use crate::refold::{known_miss_mm, refold_error_mm};
use crate::report::{report_html, report_json};
use crate::step::write_step;
use crate::svg::write_svg;
use crate::table::write_table;
use crate::units::Units;
use sheetwright::check::{Checked, Finding, Severity, refolding};
use sheetwright::design::{Made, MadePanel};
use std::collections::BTreeMap;
use std::fmt;

/// A kind of output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Format {
    /// `surface.obj`: the surfaces of all panels.
    Obj,
    /// `PANEL.svg`: the pattern of each panel.
    Svg,
    /// `PANEL.dxf`: the same for programs that read no SVG.
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
    /// Those that are written unless somebody asks for others.
    pub const DEFAULT: [Self; 5] = [Self::Obj, Self::Svg, Self::Dxf, Self::Pdf, Self::Report];

    /// How people ask for it.
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

/// A file that is ready to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputFile {
    /// Its name, without a folder.
    pub name: String,
    /// What it holds.
    pub bytes: Vec<u8>,
}

/// The files of a made design, and what writing them has found.
#[derive(Clone, Debug, PartialEq)]
pub struct Outputs {
    /// The files, format after format in the order of [`Format::ALL`].
    pub files: Vec<OutputFile>,
    /// What is known of each panel: the findings of the kernel, those of the written files added,
    /// the worst first. The verdict is the kernel's.
    pub panels: Vec<Checked>,
    /// How far the written files of each panel miss its surface when they are folded up, mm; NaN
    /// where they can't be.
    pub refold_error_mm: Vec<f64>,
}

/// Why no files can be made of a design.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OutputError {
    /// The name of a panel can't be the name of a file.
    BadName {
        /// The panel.
        panel: String,
    },
    /// Two panels would write the same file, on a disk that does not tell capitals from small
    /// letters.
    SameName {
        /// The panel that comes first.
        panel: String,
        /// The other.
        other: String,
    },
}

impl fmt::Display for OutputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BadName { panel } => write!(f, "panel '{panel}': no file can have this name"),
            Self::SameName { panel, other } => {
                write!(f, "panels '{panel}' and '{other}' would write the same file")
            }
        }
    }
}

impl std::error::Error for OutputError {}

/// Makes the files of the formats that are asked for, in memory. Whatever is asked for, the
/// pattern of every panel is written, read back and folded up again; and where curves were moved,
/// they are written as a table, with a design that makes the same from it.
///
/// # Errors
/// Panels whose names make no files. A pattern that does not fold back is a finding.
pub fn output_files(
    made: &Made,
    formats: &[Format],
    pdf: &PdfOptions,
) -> Result<Outputs, OutputError> {
    check_names(made)?;
    let asked = |format: Format| formats.contains(&format);
    let file = |name: String, bytes: Vec<u8>| OutputFile { name, bytes };
    let of_panels = |format: Format, write: &dyn Fn(&MadePanel) -> Vec<u8>| -> Vec<OutputFile> {
        let panels = made.panels.iter().filter(|_| asked(format));
        panels.map(|p| file(format!("{}.{}", p.name, format.name()), write(p))).collect()
    };
    let svg = of_panels(Format::Svg, &|panel| write_svg(&panel.piece));
    let dxf = of_panels(Format::Dxf, &|panel| write_dxf(&panel.piece));
    let pdf = asked(Format::Pdf).then(|| write_pdf(made, pdf));
    fn bytes_of(files: &[OutputFile], n: usize) -> Option<&[u8]> {
        files.get(n).map(|file| &file.bytes[..])
    }

    let in_quads: Vec<Option<PanelQuads>> = made
        .panels
        .iter()
        .map(|panel| {
            let is_wanted = asked(Format::Quads) || asked(Format::Step);
            is_wanted.then(|| PanelQuads::new(panel))
        })
        .collect();

    let mut panels = Vec::with_capacity(made.panels.len());
    let mut errors_mm = Vec::with_capacity(made.panels.len());
    for (n, panel) in made.panels.iter().enumerate() {
        let mut checked = panel.checked.clone();
        match refold_error_mm(panel, bytes_of(&svg, n), bytes_of(&dxf, n)) {
            Ok(error_mm) => {
                checked.findings.extend(refolding(
                    error_mm,
                    panel.boundary.size(),
                    known_miss_mm(panel),
                ));
                errors_mm.push(error_mm);
            }
            Err(error) => {
                checked.findings.push(Finding {
                    severity: Severity::Error,
                    code: "refold",
                    text: format!(
                        "{}. Do not cut it; this is a fault of the program.",
                        capitalised(&error.to_string())
                    ),
                    place: String::new(),
                });
                errors_mm.push(f64::NAN);
            }
        }
        let reduced = pdf.iter().flat_map(|pdf| &pdf.reduced).find(|r| r.panel == n);
        checked.findings.extend(reduced.map(not_tiled));
        checked.findings.extend(in_quads[n].as_ref().and_then(PanelQuads::finding));
        checked.findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
        panels.push(checked);
    }

    let mut files = Vec::new();
    if asked(Format::Obj) {
        files.push(file("surface.obj".to_owned(), write_obj(made)));
    }
    files.extend(svg);
    files.extend(dxf);
    files.extend(pdf.map(|pdf| file("pattern.pdf".to_owned(), pdf.bytes)));
    let named: Vec<(&str, &PanelQuads)> = made
        .panels
        .iter()
        .zip(&in_quads)
        .filter_map(|(panel, quads)| Some((panel.name.as_str(), quads.as_ref()?)))
        .collect();
    if asked(Format::Quads) {
        files.push(file("quads.obj".to_owned(), write_quads(&named)));
    }
    if asked(Format::Step) {
        let smooth: Vec<_> = named.iter().map(|(name, quads)| (*name, &quads.smooth)).collect();
        files.push(file("surface.step".to_owned(), write_step(&smooth)));
    }
    if asked(Format::Report) {
        let report = report_json(made, &errors_mm, &panels, &in_quads);
        files.push(file("report.json".to_owned(), report));
        files.push(file("report.html".to_owned(), report_html(made, &errors_mm, &panels)));
    }
    if let Some(moved) = &made.moved {
        files.push(file(MOVED_TABLE.to_owned(), write_table(&moved.curves)));
        let design = write_design_of_table(moved, MOVED_TABLE, Units::Millimetres);
        files.push(file("moved.sheet.json".to_owned(), design));
    }
    Ok(Outputs { files, panels, refold_error_mm: errors_mm })
}

/// The curves as they were moved, beside the design that takes its points from there.
const MOVED_TABLE: &str = "moved.csv";

/// Readers of designs check names with a hint each; this is the last door before the disk.
fn check_names(made: &Made) -> Result<(), OutputError> {
    let mut seen: BTreeMap<String, &str> = BTreeMap::new();
    for MadePanel { name, .. } in &made.panels {
        if refused_for_file(name).is_some() {
            return Err(OutputError::BadName { panel: name.clone() });
        }
        if let Some(first) = seen.insert(folded(name), name) {
            return Err(OutputError::SameName { panel: first.to_owned(), other: name.clone() });
        }
    }
    Ok(())
}

/// The finding that the PDF shows a panel smaller than it is.
fn not_tiled(reduced: &Reduced) -> Finding {
    let Reduced { sheets, scale, file_full, .. } = *reduced;
    let most = MaxSheets::MOST.get();
    let (too_many, instead) = if file_full {
        (
            format!(", for which the panels before it leave no room among the {most} of one PDF"),
            "Make it in a design of its own to print it true to scale. ".to_owned(),
        )
    } else if sheets > most {
        (format!("; {most} are the most that a PDF takes"), String::new())
    } else {
        (
            String::new(),
            format!("To print it true to scale all the same, add --max-sheets {sheets}. "),
        )
    };
    Finding {
        severity: Severity::Note,
        code: "pdf-reduced",
        text: format!(
            "True to scale, this panel would take about {sheets} sheets of paper{too_many}. So \
             pattern.pdf shows it at 1:{scale} with a table of offsets to mark it out by. \
             {instead}SVG and DXF are true to scale."
        ),
        place: String::new(),
    }
}

fn capitalised(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |c| c.to_uppercase().chain(chars).collect())
}
