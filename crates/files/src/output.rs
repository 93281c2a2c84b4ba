//! All files of a made design. A stand-in until the writers are there.

use sheetwright::check::Checked;
use sheetwright::design::Made;
use std::fmt;

/// Formats that designs are made to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Surfaces.
    Obj,
    /// Patterns for the laser.
    Svg,
    /// Patterns for the router.
    Dxf,
    /// Patterns for the printer.
    Pdf,
    /// The report.
    Report,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 5] = [Self::Obj, Self::Svg, Self::Dxf, Self::Pdf, Self::Report];

    /// How the command names it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Svg => "svg",
            Self::Dxf => "dxf",
            Self::Pdf => "pdf",
            Self::Report => "report",
        }
    }

    /// The format of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.name() == name)
    }
}

/// A file in memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputFile {
    /// Its name.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// All files, and the findings after reading them back.
#[derive(Clone, Debug, PartialEq)]
pub struct Outputs {
    /// The files.
    pub files: Vec<OutputFile>,
    /// The verdicts, in the order of the panels.
    pub panels: Vec<Checked>,
}

/// Why there are no files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OutputError {
    /// A fault.
    Fault(String),
}

impl fmt::Display for OutputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::Fault(text) = self;
        write!(f, "{text}")
    }
}

impl std::error::Error for OutputError {}

/// All files of a made design.
///
/// # Errors
/// See [`OutputError`].
pub fn output_files(made: &Made, formats: &[Format]) -> Result<Outputs, OutputError> {
    let mut files = Vec::new();
    for format in formats {
        let whole: &[&str] = match format {
            Format::Obj => &["surface.obj"],
            Format::Pdf => &["pattern.pdf"],
            Format::Report => &["report.json", "report.html"],
            Format::Svg | Format::Dxf => &[],
        };
        files.extend(whole.iter().map(|name| (*name).to_owned()));
        if whole.is_empty() {
            files.extend(made.panels.iter().map(|p| format!("{}.{}", p.name, format.name())));
        }
    }
    let stand_in = made.panels.iter().map(|p| format!("{} {}\n", p.name, p.triangulation.price));
    let bytes = stand_in.collect::<String>().into_bytes();
    let files = files.into_iter().map(|name| OutputFile { name, bytes: bytes.clone() }).collect();
    Ok(Outputs { files, panels: made.panels.iter().map(|p| p.checked.clone()).collect() })
}
