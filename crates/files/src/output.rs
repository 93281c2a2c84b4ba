//! All files of a made design.

use crate::astm::write_astm;
use crate::book::Book;
use crate::brake::BrakeSettings;
use crate::design_json::write_design_of_table;
use crate::dxf::write_dxf_with;
use crate::fold::write_fold;
use crate::format::Format;
use crate::names::{folded, refused_for_file};
use crate::obj::write_obj;
use crate::offsets::{OffsetOptions, write_offsets};
use crate::parts::write_parts;
use crate::pdf::{PdfOptions, Reduced, write_pieces};
use crate::preset::{DxfRelease, Preset};
use crate::quads::{PanelQuads, write_quads};
use crate::reading::InputError;
use crate::refold::{
    PatternFiles, RefoldFileError, check_lines, refold_finding, refold_piece_error_mm,
};
use crate::report::{ReportForm, Written, report_html, report_json};
use crate::step::write_step;
use crate::svg::write_svg_for;
use crate::table::write_table;
use crate::trade::trade;
use crate::units::Units;
use sheetwright::bend::Hit;
use sheetwright::check::{Checked, Finding, FindingKind, braking};
use sheetwright::design::{Design, DesignPanel};
use sheetwright::make::{CutItem, Made, Part, beside_each_other};
use sheetwright::pattern::{EqualPiece, Piece, TooNarrow};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// What a file is called.
enum FileName {
    /// After its part, with this ending.
    OfPart(&'static str),
    /// There is one, of this name.
    Whole(&'static str),
    /// After the sheets, with this ending: one for all of them, or one each.
    OfSheets(&'static str),
}

/// What writes a file.
enum Writer {
    Piece(fn(&Piece, &OutputOptions) -> Vec<u8>),
    Design(fn(&mut Run<'_>) -> Result<Vec<u8>, OutputError>),
}

use FileName::{OfPart, OfSheets, Whole};

/// The files of a format.
const fn files_of(format: Format) -> &'static [(FileName, Writer)] {
    match format {
        Format::Obj => &[(Whole("surface.obj"), Writer::Design(|run| Ok(write_obj(run.made))))],
        Format::Svg => &[(
            OfPart(".svg"),
            Writer::Piece(|piece, options| write_svg_for(piece, options.preset)),
        )],
        Format::Dxf => &[(OfPart(".dxf"), Writer::Piece(|piece, options| options.dxf_of(piece)))],
        Format::Pdf => &[(Whole("pattern.pdf"), Writer::Design(|run| Ok(run.pdf())))],
        Format::Quads => {
            &[(Whole("quads.obj"), Writer::Design(|run| Ok(write_quads(&run.named_quads()))))]
        }
        Format::Step => &[(
            Whole("surface.step"),
            Writer::Design(|run| {
                let named = run.named_quads();
                let smooth: Vec<_> =
                    named.iter().map(|(name, quads)| (*name, &quads.smooth)).collect();
                Ok(write_step(&smooth))
            }),
        )],
        Format::Fold => &[(Whole("pattern.fold"), Writer::Design(|run| Ok(write_fold(run.made))))],
        Format::Astm => &[(
            Whole("pattern-astm.dxf"),
            Writer::Design(|run| Ok(write_astm(run.made, &run.patterns))),
        )],
        Format::Offsets => &[(
            Whole("offsets.csv"),
            Writer::Design(|run| {
                let pieces = run.patterns.iter().map(|pattern| &pattern.piece);
                Ok(write_offsets(pieces, &run.options.offsets))
            }),
        )],
        Format::Brake => &[(Whole("brake.csv"), Writer::Design(|run| Ok(run.brake())))],
        Format::Parts => {
            &[(Whole("parts.csv"), Writer::Design(|run| Ok(write_parts(run.made, &run.patterns))))]
        }
        Format::Sheets => &[
            (
                OfSheets(".svg"),
                Writer::Piece(|piece, options| write_svg_for(piece, options.preset)),
            ),
            (OfSheets(".dxf"), Writer::Piece(|piece, options| options.dxf_of(piece))),
        ],
        Format::Assembly => &[(Whole("assembly.pdf"), Writer::Design(|run| Ok(run.book())))],
        Format::Report => &[
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
    /// How near arcs in DXF files stay to the cut lines that they take the place of, mm. Default:
    /// cut lines have straight sides.
    pub arcs_mm: Option<f64>,
    /// The stations of the table of offsets.
    pub offsets: OffsetOptions,
    /// The machine that the plan of bends is for.
    pub brake: BrakeSettings,
    /// Whether each of several equal parts has a pattern of its own. Default: it is cut from the
    /// pattern of the first.
    pub each_part: bool,
    /// The width of the cut that SVG and DXF files allow for, mm: outlines lie half of it outside,
    /// and holes inside. Default: 0, for programs that see to it themselves.
    pub kerf_mm: f64,
}

impl Default for OutputOptions {
    fn default() -> Self {
        Self {
            pdf: PdfOptions::default(),
            report: ReportForm::default(),
            preset: Preset::generic(),
            dxf: None,
            arcs_mm: None,
            offsets: OffsetOptions::default(),
            brake: BrakeSettings::default(),
            each_part: false,
            kerf_mm: 0.0,
        }
    }
}

impl OutputOptions {
    /// The options for a design: what it says itself, then what its trade needs, then the defaults.
    pub fn of(design: &Design) -> Self {
        Self::with_preset(design, None)
    }

    /// The options for a design with this preset in place of its own. The release of DXF files that
    /// a trade needs gives way to that of a preset that is chosen.
    pub fn with_preset(design: &Design, preset: Option<&'static Preset>) -> Self {
        let trade = design.trade.as_deref().and_then(trade);
        let own = || design.preset.as_deref().and_then(Preset::from_name);
        let chosen = preset.or_else(own);
        let release = design.dxf.as_deref().and_then(DxfRelease::from_name);
        let of_trade = trade.filter(|_| chosen.is_none());
        Self {
            preset: chosen.or_else(|| trade?.preset()).unwrap_or(Preset::generic()),
            dxf: release.or_else(|| of_trade?.dxf()),
            arcs_mm: design.arcs_mm,
            kerf_mm: design.stock.as_ref().map_or(0.0, |stock| stock.kerf_mm),
            ..Self::default()
        }
    }

    /// The DXF file of a piece.
    fn dxf_of(&self, piece: &Piece) -> Vec<u8> {
        let release = self.dxf.unwrap_or(self.preset.dxf);
        write_dxf_with(piece, self.preset, release, self.arcs_mm)
    }
}

/// The default options with this paper.
impl From<&PdfOptions> for OutputOptions {
    fn from(pdf: &PdfOptions) -> Self {
        Self { pdf: *pdf, ..Self::default() }
    }
}

/// The formats of the files of a design, in order: those that it names, else those that its trade
/// needs, else the defaults, and with them what is laid out on its sheets.
pub fn formats_for(design: &Design) -> Vec<Format> {
    let own: Vec<Format> =
        design.formats.iter().filter_map(|name| Format::from_name(name)).collect();
    let own_is_empty = own.is_empty();
    let mut formats = match design.trade.as_deref().and_then(trade) {
        _ if !own_is_empty => own,
        Some(trade) => trade.formats(),
        None => Format::DEFAULT.to_vec(),
    };
    if own_is_empty && design.stock.as_ref().is_some_and(|stock| !stock.sheets.is_empty()) {
        formats.extend([Format::Parts, Format::Sheets]);
    }
    formats.sort_unstable();
    formats.dedup();
    formats
}

/// Refuses formats of which a design has no part: those of rulings, where all panels are meshes.
///
/// # Errors
/// The first of these formats.
pub fn refuse_unmade(design: &Design, formats: &[Format]) -> Result<(), InputError> {
    let unmade = formats.iter().find(|format| format.needs_rulings());
    match unmade {
        Some(format)
            if !design.panels.is_empty() && design.panels.iter().all(DesignPanel::is_mesh) =>
        {
            Err(InputError {
                message: format!("{} can't be made of a mesh, which has no rulings", format.name()),
                place: None,
                hint: "Leave the format out, or give boundary curves instead.".to_owned(),
            })
        }
        _ => Ok(()),
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
#[derive(Clone, Debug, PartialEq)]
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
    /// A panel has the name of another file, such as `sheets`.
    SameFile {
        /// The file.
        file: String,
    },
    /// The die of the press brake is wider than a part that is to be bent over it.
    WideDie {
        /// The part.
        part: String,
        /// The opening of the die, mm.
        die_mm: f64,
        /// The longer side of the part's pattern, mm.
        part_mm: f64,
    },
    /// The cut of a machine is as wide as something that is to be cut.
    Kerf {
        /// The part.
        part: String,
        /// What is too narrow.
        narrow: TooNarrow,
        /// The width of the cut, mm.
        kerf_mm: f64,
    },
    /// The parts are not laid out, since the design has no sheets.
    NoSheets,
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
            Self::SameFile { file } => {
                write!(f, "a panel has the name of a file that is written as well: {file}")
            }
            Self::WideDie { part, die_mm, part_mm } => write!(
                f,
                "panel '{part}': its pattern is {part_mm:.1} mm long and would fall into the die, \
                 which is {die_mm:.1} mm wide"
            ),
            Self::Kerf { part, narrow, kerf_mm } => {
                let what = match narrow {
                    TooNarrow::Hole => "a hole",
                    TooNarrow::Drill => "a round hole",
                    TooNarrow::Gap => "a gap between two of its edges",
                };
                write!(f, "panel '{part}': {what} is no wider than the kerf, {kerf_mm} mm")
            }
            Self::NoSheets => write!(f, "the design has no sheets to lay its parts out on"),
            Self::Report { why } => write!(f, "report.json can't be written: {why}"),
        }
    }
}

impl OutputError {
    /// What to do, where that is up to the caller.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::WideDie { .. } => {
                Some("Give the opening of a die that is narrower than the part.")
            }
            Self::Kerf { .. } => {
                Some("Make it wider, give a narrower kerf, or let the machine's program see to it.")
            }
            Self::BadName { .. } | Self::SameName { .. } | Self::SameFile { .. } => {
                Some("Give the panels other names.")
            }
            Self::NoSheets => Some("Give the size of a sheet, or leave the sheets out."),
            Self::Report { .. } => None,
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
/// Panels whose names can't be names of files, or are those of others; a die that is wider than a
/// part that is bent over it; a hole or a gap that is no wider than the kerf. A written pattern
/// that differs is a finding.
pub fn output_files(
    made: &Made,
    formats: &[Format],
    options: impl Into<OutputOptions>,
) -> Result<Outputs, OutputError> {
    check_names(made.parts.iter().map(|part| &part.name[..]))?;
    let options = options.into();
    if formats.contains(&Format::Brake) {
        check_die(made, &options.brake)?;
    }
    if formats.contains(&Format::Sheets) && made.nested.is_none() {
        return Err(OutputError::NoSheets);
    }
    let mut run = Run::new(made, formats, options)?;
    for format in Format::ALL.into_iter().filter(|format| formats.contains(format)) {
        if format == Format::Report {
            run.prove();
        }
        run.write(format)?;
    }
    run.prove();
    if let Some(moved) = &made.moved {
        run.files.push(file(MOVED_TABLE, write_table(&moved.curves)));
        let design = write_design_of_table(moved, MOVED_TABLE, Some(Units::Millimetres), |_| true);
        run.files.push(file("moved.sheet.json", design));
    }
    let Run { files, panels, errors_mm, .. } = run;
    let mut seen = BTreeSet::new();
    if let Some(twice) = files.iter().find(|file| !seen.insert(folded(&file.name))) {
        return Err(OutputError::SameFile { file: twice.name.clone() });
    }
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
    /// The patterns as a machine follows them whose cut has a width; `None`: as they are.
    with_kerf: Option<Vec<Piece>>,
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
    fn new(
        made: &'a Made,
        formats: &[Format],
        options: OutputOptions,
    ) -> Result<Self, OutputError> {
        let patterns = if options.each_part { made.cut_each() } else { made.cut_list() };
        let is_for_machines = formats.iter().any(|it| matches!(it, Format::Svg | Format::Dxf));
        let needs_kerf = is_for_machines && options.kerf_mm > 0.0;
        let with_kerf = || pieces_with_kerf(made, &patterns, options.kerf_mm);
        let with_kerf = needs_kerf.then(with_kerf).transpose()?;
        let needs_quads = formats.iter().any(|format| format.needs_rulings());
        let quads = |part: &Part| part.found().filter(|_| needs_quads).map(PanelQuads::new);
        Ok(Self {
            made,
            options,
            files: Vec::new(),
            patterns,
            with_kerf,
            first_files: BTreeMap::new(),
            in_quads: made.parts.iter().map(quads).collect(),
            plans: formats.contains(&Format::Brake).then(|| options.brake.plans(made)),
            reduced: Vec::new(),
            panels: Vec::new(),
            errors_mm: Vec::new(),
        })
    }

    fn write(&mut self, format: Format) -> Result<(), OutputError> {
        for (name, writer) in files_of(format) {
            match (name, writer) {
                (OfPart(ending), Writer::Piece(write)) => {
                    self.first_files.insert(format, self.files.len());
                    let named = |piece: &Piece| {
                        file(format!("{}{ending}", piece.name), write(piece, &self.options))
                    };
                    match &self.with_kerf {
                        Some(pieces) => self.files.extend(pieces.iter().map(named)),
                        None => {
                            let pieces = self.patterns.iter().map(|pattern| &pattern.piece);
                            self.files.extend(pieces.map(named));
                        }
                    }
                }
                (Whole(name), Writer::Design(write)) => {
                    let bytes = write(self)?;
                    self.files.push(file(*name, bytes));
                }
                (OfSheets(ending), Writer::Piece(write)) => {
                    let sheets = self.sheets()?;
                    let written = sheets.iter().map(|(name, sheet)| {
                        file(format!("{name}{ending}"), write(sheet, &self.options))
                    });
                    self.files.extend(written);
                }
                // A drawing comes from its piece, what is said of the design from the design.
                (OfPart(_) | OfSheets(_), Writer::Design(_)) | (Whole(_), Writer::Piece(_)) => {}
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

    /// The drawings of the sheets, as a machine follows them: all beside each other in one, or
    /// each by itself; with the names of their files.
    fn sheets(&self) -> Result<Vec<(String, Piece)>, OutputError> {
        let (Some(nested), Some(stock)) = (&self.made.nested, &self.made.stock) else {
            return Err(OutputError::NoSheets);
        };
        let mut list = nested.list.clone();
        let kerf_mm = self.options.kerf_mm;
        if kerf_mm > 0.0 {
            let pieces = pieces_with_kerf(self.made, &list, kerf_mm)?;
            list.iter_mut().zip(pieces).for_each(|(item, piece)| item.piece = piece);
        }
        let sheets = self.made.sheet_pieces(&list);
        if !stock.has_file_each {
            let all = beside_each_other(&self.made.name, &sheets);
            return Ok(vec![("sheets".to_owned(), all)]);
        }
        let names = (1..).map(|n| format!("sheets-{n}"));
        Ok(names.zip(sheets).collect())
    }

    fn book(&self) -> Vec<u8> {
        let (made, patterns) = (self.made, &self.patterns[..]);
        let (plans, paper) = (self.plans.as_deref(), self.options.pdf.paper);
        Book { made, patterns, plans, paper }.written()
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
            let OutputOptions { preset, arcs_mm, .. } = self.options;
            let files = PatternFiles { svg, dxf, preset, arcs_mm };
            let mut checked = part.checked.clone();
            let cut = self.with_kerf.as_ref().filter(|_| is_first).map(|cut| &cut[pattern]);
            let error_mm = match refolded_mm(part, piece, cut, &files) {
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

/// The refold error of a pattern, mm. Where a machine's cut has a width, the pattern is folded up
/// without it, and the files are compared with what the machine follows.
fn refolded_mm(
    part: &Part,
    piece: &Piece,
    cut: Option<&Piece>,
    files: &PatternFiles<'_>,
) -> Result<f64, RefoldFileError> {
    let Some(cut) = cut.filter(|_| files.svg.is_some() || files.dxf.is_some()) else {
        return refold_piece_error_mm(part, piece, files);
    };
    check_lines(cut, files)?;
    refold_piece_error_mm(part, piece, &PatternFiles { svg: None, dxf: None, ..*files })
}

/// The patterns as a machine follows them whose cut is so wide, mm.
fn pieces_with_kerf(
    made: &Made,
    patterns: &[CutItem],
    kerf_mm: f64,
) -> Result<Vec<Piece>, OutputError> {
    let with_kerf = |item: &CutItem| {
        // Of a pattern that overlaps itself, which is an error by itself, no side is the outside.
        if made.parts[item.first()].flat.overlap.is_some() {
            return Ok(item.piece.clone());
        }
        let named = |narrow| OutputError::Kerf { part: item.piece.name.clone(), narrow, kerf_mm };
        item.piece.with_kerf(kerf_mm).map_err(named)
    };
    patterns.iter().map(with_kerf).collect()
}

/// The finding that a written pattern differs from the flat pattern.
fn not_refolded(error: &RefoldFileError) -> Finding {
    Finding::of_whole(FindingKind::NotReadBack { cause: error.to_string() })
}

/// The name of the table of moved curves; the design beside it takes its points from there.
const MOVED_TABLE: &str = "moved.csv";

/// Refuses a die that a part can't span in any direction.
fn check_die(made: &Made, brake: &BrakeSettings) -> Result<(), OutputError> {
    let Some(die_mm) = brake.die_mm.filter(|_| !brake.rolls) else { return Ok(()) };
    let long_mm = |part: &Part| part.piece.size.x.max(part.piece.size.y);
    let is_lost = |part: &&Part| !part.piece.bends.is_empty() && long_mm(part) < die_mm;
    made.parts.iter().find(is_lost).map_or(Ok(()), |part| {
        let (part_mm, part) = (long_mm(part), part.name.clone());
        Err(OutputError::WideDie { part, die_mm, part_mm })
    })
}

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
