//! Shared by every reader: errors with a place and a hint, the settings of the caller, and bytes
//! and text within limits.

use crate::names::{refused_for_file, shown};
use crate::units::Units;
use sheetwright::boundary::PlaneChoice;
use sheetwright::design::{
    Allowance, BendMarks, BendRule, Bends, Corner, Design, DesignPanel, Dimensions, Divide,
    DivideJoint, PanelMesh, PanelMethod, Stock, StockSheet, Trim, TrimKind, TrimOn, Vary, VaryGoal,
};
use sheetwright::flatten::Aim;
use sheetwright::math::from_deg;
use sheetwright::mesh::Skin;
use sheetwright::triangulate::WhichSurface;
use std::borrow::Cow;
use std::fmt;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The most bytes of a file: more than a million rows of 250 characters.
pub const MAX_INPUT_BYTES: u64 = 256 << 20;

/// The endings of inputs that stand for one kind of input alone.
pub const INPUT_ENDINGS: [&str; 11] = [
    ".sheet.json",
    ".csv",
    ".tsv",
    ".xlsx",
    ".ods",
    ".svg",
    ".dxf",
    ".obj",
    ".stl",
    ".ply",
    ".glb",
];
/// The endings of inputs that other files have, too, and of many designs in one file.
const OTHER_ENDINGS: [&str; 4] = [".json", ".txt", ".jsonl", ".ndjson"];

/// The hint for an unknown ending.
pub(crate) const TAKEN: &str = "Give a design (.sheet.json or .json), a curve table (.csv), a table \
     of offsets (.csv, .tsv, .txt, .xlsx or .ods), a drawing (.svg or .dxf) or a mesh (.obj, .stl, \
     .ply or .glb).";

/// Why an input can't be read, where, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputError {
    /// The problem, in words.
    pub message: String,
    /// Where: the file, with a line (`leaf.csv:12`), a line and a column (`a.sheet.json:3:14`) or
    /// a JSON path (`a.sheet.json: panels[0].rails[1]`).
    pub place: Option<String>,
    /// What to do.
    pub hint: String,
}

impl InputError {
    /// An error in the file of this name, or at this place of it.
    pub(crate) fn at(
        place: impl Into<String>,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) -> Self {
        Self { message: message.into(), place: Some(place.into()), hint: hint.into() }
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            Some(place) => write!(f, "{place}: {}", self.message),
            None => write!(f, "{}", self.message),
        }
    }
}

impl std::error::Error for InputError {}

/// The limits on movement that the caller sets; `None` keeps the value of the design.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VarySettings {
    /// How far each sample may move, mm.
    pub limit_mm: Option<f64>,
    /// How far all samples together may move, mm.
    pub budget_mm: Option<f64>,
    /// The largest warp angle to be reached, degrees.
    pub warp_deg: Option<f64>,
    /// The goal, the largest strain as a share of what the sheet takes, 0.05 ..= 1; it takes the
    /// place of a goal for the warp angle.
    pub strain: Option<f64>,
}

impl VarySettings {
    /// The `vary` of a design with these settings in place of its values. A design without `vary`
    /// gets one that moves all curves, if there are settings.
    pub(crate) fn applied(&self, mut vary: Vec<Vary>) -> Vec<Vary> {
        if *self == Self::default() {
            return vary;
        }
        if vary.is_empty() {
            vary.push(Vary::default());
        }
        for one in &mut vary {
            one.limit_mm = self.limit_mm.or(one.limit_mm);
            one.budget_mm = self.budget_mm.or(one.budget_mm);
            if let Some(deg) = self.warp_deg {
                one.goal = VaryGoal::Warp { largest: from_deg(deg) };
            }
            if let Some(share) = self.strain {
                one.goal = VaryGoal::Strain { share };
            }
        }
        vary
    }
}

/// How meshes are laid flat; these settings replace those of their panels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshSettings {
    /// The quantity that flattening minimises where it can't be exact.
    pub aim: Option<Aim>,
    /// Meshes are divided into parts along creases above this angle, radians.
    pub split_creases: Option<f64>,
    /// Whether parts that would stretch too much are cut from their border to the points of the
    /// largest stretch: `true` cuts, `false` leaves it to the panel.
    pub darts: bool,
    /// The skin that is laid flat of plates that come as closed meshes with two.
    pub skin: Option<Skin>,
    /// Whether facets are folded and nothing is stretched; `None` leaves it to the panel.
    pub facets: Option<bool>,
    /// The width and height of a rectangle that no piece of facets exceeds, mm.
    pub pieces_within_mm: Option<[f64; 2]>,
}

impl MeshSettings {
    /// The mesh with these settings in place of its own.
    pub(crate) fn applied(&self, mesh: PanelMesh) -> PanelMesh {
        PanelMesh {
            aim: self.aim.unwrap_or(mesh.aim),
            split_creases: self.split_creases.or(mesh.split_creases),
            darts: self.darts || mesh.darts,
            skin: self.skin.or(mesh.skin),
            facets: self.facets.or(mesh.facets),
            pieces_within_mm: self.pieces_within_mm.or(mesh.pieces_within_mm),
            ..mesh
        }
    }
}

/// How bends are marked; these settings replace those of the design and of its panels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BendSettings {
    /// What decides how many bend lines there are.
    pub rule: Option<BendRule>,
    /// How they are drawn.
    pub marks: Option<BendMarks>,
}

impl BendSettings {
    /// The bends with these settings in place of their own.
    fn applied(self, bends: Bends) -> Bends {
        let (rule, marks) = (self.rule.unwrap_or(bends.rule), self.marks.unwrap_or(bends.marks));
        Bends { rule, marks }
    }

    /// Sets how the bends of a design are marked.
    pub(crate) fn set(self, design: &mut Design) {
        design.bends = self.applied(design.bends);
        for bends in design.panels.iter_mut().filter_map(|panel| panel.bends.as_mut()) {
            *bends = self.applied(*bends);
        }
    }
}

/// The largest tolerance of samples, mm: beyond it, a length has the wrong unit.
pub const MOST_TOLERANCE_MM: f64 = 1000.0;

/// Whether the polygon through samples can be held within this tolerance, mm.
pub(crate) fn is_tolerance(mm: f64) -> bool {
    mm > 0.0 && mm <= MOST_TOLERANCE_MM
}

/// The hint for a tolerance out of range.
pub(crate) const TOLERANCES: &str =
    "Set a tolerance above 0 and up to 1 m; 0.05 mm is less than most machines cut.";

/// What is wrong where equal parts share cuts and a gap is given.
pub(crate) const GAP_AND_COMMON_LINES: &str = "parts with cuts in common lie a kerf apart";
/// What helps then.
pub(crate) const LEAVE_THE_GAP_OUT: &str = "Leave the gap out, or the cuts in common.";

/// The hint for an effort out of range.
pub(crate) const EFFORTS: &str =
    "Set an effort from 0.001 to 1000; 1 is the default, up to 5 seconds for each panel.";

/// What the caller sets of sheets, in place of what the design says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SheetSettings {
    /// The sheets; none: those of the design.
    pub sheets: Vec<StockSheet>,
    /// The least distance between two parts, mm.
    pub gap_mm: Option<f64>,
    /// The least distance of a part from the edge of its sheet, mm.
    pub margin_mm: Option<f64>,
    /// The width that a cut takes away, mm.
    pub kerf_mm: Option<f64>,
    /// Whether equal parts lie side by side so that one cut parts two.
    pub common_lines: Option<bool>,
    /// Whether each sheet has files of its own.
    pub file_each: Option<bool>,
    /// How much work the search may do, as a multiple of the default.
    pub effort: Option<f64>,
    /// What joins the pieces of parts that are larger than every sheet; `Some(None)`: they are not
    /// divided.
    pub divide: Option<Option<DivideJoint>>,
}

impl SheetSettings {
    /// Sets it on a design.
    ///
    /// # Errors
    /// Something is set that is about sheets, and there are none; or a gap between parts that share
    /// their cuts.
    pub fn set(&self, design: &mut Design) -> Result<(), InputError> {
        let Self { sheets, gap_mm, margin_mm, kerf_mm, common_lines, file_each, effort, divide } =
            self;
        let refused = |message: &str, hint: &str| {
            Err(InputError { message: message.to_owned(), place: None, hint: hint.to_owned() })
        };
        let of_sheets = gap_mm.is_some()
            || margin_mm.is_some()
            || *common_lines == Some(true)
            || file_each.is_some()
            || matches!(divide, Some(Some(_)));
        let is_set = !sheets.is_empty() || of_sheets || divide.is_some() || kerf_mm.is_some();
        if !is_set && design.stock.is_none() {
            return Ok(());
        }
        let stock = design.stock.get_or_insert_with(Stock::default);
        if !sheets.is_empty() {
            stock.sheets.clone_from(sheets);
        }
        stock.gap_mm = gap_mm.unwrap_or(stock.gap_mm);
        stock.margin_mm = margin_mm.unwrap_or(stock.margin_mm);
        stock.kerf_mm = kerf_mm.unwrap_or(stock.kerf_mm);
        stock.effort = effort.unwrap_or(stock.effort);
        if let Some(joint) = *divide {
            let of_design = stock.divide;
            let with = |joint| match of_design {
                Some(sizes) => Divide { joint, ..sizes },
                None => Divide::by(joint),
            };
            stock.divide = joint.map(with);
        }
        stock.has_common_lines = common_lines.unwrap_or(stock.has_common_lines);
        stock.has_file_each = file_each.unwrap_or(stock.has_file_each);
        if of_sheets && stock.sheets.is_empty() {
            return refused(
                "there is no sheet to lay parts out on",
                "Give the size of a sheet, or leave out what is said of sheets.",
            );
        }
        if stock.has_common_lines && gap_mm.is_some() {
            return refused(GAP_AND_COMMON_LINES, LEAVE_THE_GAP_OUT);
        }
        Ok(())
    }
}

/// A second file of a table of offsets.
#[derive(Clone, Debug, PartialEq)]
pub struct SecondTable {
    /// The name of the file.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// The settings of the caller, which replace those of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Samples of each outer loop or rail. A curve table becomes splines with it. Default: as the
    /// design says; the rows of a table as they are.
    pub samples: Option<usize>,
    /// How near the polygon through the samples stays to the curves, mm, above 0 and up to
    /// [`MOST_TOLERANCE_MM`]; a number of samples comes first. Default: as the design says.
    pub tolerance_mm: Option<f64>,
    /// The weight ν of the fold price, 0 ..= 10. Default: as the design says.
    pub fold: Option<f64>,
    /// The limit on the work of the search in panels with holes, as a multiple of the default.
    pub effort: Option<f64>,
    /// Which triangulations are searched. Default: as the design says.
    pub method: Option<PanelMethod>,
    /// Which surface is meant where two fit a boundary about as well. Default: as the design says.
    pub which: Option<WhichSurface>,
    /// The supporting plane of every panel. Default: as the design says, or `auto`.
    pub plane: Option<PlaneChoice>,
    /// Whether the edges of every panel slide along its boundary while it is bent. Default: as the
    /// design says; of a table or a drawing they are held.
    pub slides: Option<bool>,
    /// The unit of a curve table, a drawing or a mesh. Default: of a mesh, the one that a comment
    /// in it names, of a drawing, the one that it states; else millimetres. A design states its
    /// own.
    pub units: Option<Units>,
    /// A second file of a table of offsets: its half-breadths, where the input has its heights.
    pub second_table: Option<SecondTable>,
    /// The names of the curves or layers of a drawing that are rails, in order. Default: what is
    /// named so, or two open curves alone.
    pub rails: Vec<String>,
    /// The name of the material of the sheet, one of the design's own or of the catalogue.
    /// Default: as the design says; none for tables and meshes.
    pub material: Option<String>,
    /// Limits on movement. Default: as the design says.
    pub vary: VarySettings,
    /// How meshes are laid flat. Default: as the design says.
    pub mesh: MeshSettings,
    /// The trade that the design is made for, by name. Default: as the design says.
    pub trade: Option<String>,
    /// The width of an allowance along all edges, mm, in place of other strips. Default: as the
    /// trims of the design say.
    pub allowance_mm: Option<f64>,
    /// How bends are marked. Default: as the design says.
    pub bends: BendSettings,
    /// The face of the sheet that the curves lie on. Default: as the design says.
    pub dimensions: Option<Dimensions>,
    /// How thick the sheet is, mm. Default: as the design says, or its material.
    pub thickness_mm: Option<f64>,
    /// The inner radius of the tool that makes sharp folds, mm. Default: as the design says.
    pub bend_radius_mm: Option<f64>,
    /// What parts are cut from. Default: as the design says.
    pub sheets: SheetSettings,
}

impl ReadOptions {
    /// Sets what the caller asks for of a panel that was drawn.
    pub(crate) fn set_panel(&self, panel: &mut DesignPanel) {
        if let Some(mm) = self.tolerance_mm {
            *panel = panel.clone().within_mm(mm);
        }
        if let Some(samples) = self.samples {
            (panel.samples, panel.tolerance) = (samples, None);
        }
        panel.method = self.method.unwrap_or(panel.method);
        panel.which = self.which.unwrap_or(panel.which);
        panel.plane = self.plane.unwrap_or(panel.plane);
        panel.fold = self.fold.unwrap_or(panel.fold);
        panel.effort = self.effort.unwrap_or(panel.effort);
    }

    /// The allowance along all edges that the caller asks for.
    pub(crate) fn allowance(&self) -> Option<Trim> {
        let allowance = |mm: f64| Allowance { width: [mm; 2], corner: Corner::ByLength };
        let trim = |mm: f64| Trim::new([TrimOn::All], TrimKind::Allowance(allowance(mm)));
        self.allowance_mm.map(trim)
    }
}

/// The name of a design that is called after its file.
///
/// # Errors
/// A name that no output file can have.
pub(crate) fn named_after(name: &str) -> Result<String, InputError> {
    let called = stem(name);
    let Some(why) = refused_for_file(&called) else { return Ok(called) };
    let message = format!("the name of the design would be {}, which {why}", shown(&called));
    let hint = "Rename the file: the design and its output files are named after it.";
    Err(InputError::at(display_name(name), message, hint))
}

/// How messages name the input.
pub(crate) fn display_name(name: &str) -> &str {
    if name == "-" { "standard input" } else { name }
}

/// The default name of an input: the file's name without its endings, or `panel` for standard
/// input.
pub fn stem(name: &str) -> String {
    if name == "-" {
        return "panel".to_owned();
    }
    let file = Path::new(name).file_name().and_then(|n| n.to_str()).unwrap_or(name);
    let lower = file.to_lowercase();
    let ending = INPUT_ENDINGS.into_iter().chain(OTHER_ENDINGS).find(|e| lower.ends_with(e));
    // Lower case may change the length of other characters, never that of an ASCII ending.
    let kept = file.len() - ending.map_or(0, str::len);
    file.get(..kept).unwrap_or(file).to_owned()
}

/// Refuses a folder, also one whose name has a known ending.
pub(crate) fn refuse_folder(path: &Path) -> Result<(), InputError> {
    if path.is_dir() {
        let message = "this is a folder";
        return Err(InputError::at(path.display().to_string(), message, TAKEN));
    }
    Ok(())
}

/// All bytes of a file, at most [`MAX_INPUT_BYTES`].
pub(crate) fn read_whole(path: &Path) -> Result<Vec<u8>, InputError> {
    refuse_folder(path)?;
    let place = path.display().to_string();
    let file = File::open(path).map_err(|error| io_error(&place, &error))?;
    // Fails at once if the size is known; the bytes of a pipe are counted while they are read.
    if file.metadata().is_ok_and(|data| data.len() > MAX_INPUT_BYTES) {
        return Err(too_large(&place));
    }
    read_limited(file, &place)
}

/// All bytes of a reader, at most [`MAX_INPUT_BYTES`]. Errors name `place`.
///
/// # Errors
/// More bytes than [`MAX_INPUT_BYTES`], or an error of the reader.
pub fn read_limited(reader: impl Read, place: &str) -> Result<Vec<u8>, InputError> {
    let mut bytes = Vec::new();
    reader
        .take(MAX_INPUT_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| io_error(place, &error))?;
    if bytes.len() as u64 > MAX_INPUT_BYTES { Err(too_large(place)) } else { Ok(bytes) }
}

/// Refuses more bytes than an input may have.
pub(crate) fn refuse_large(bytes: &[u8], place: &str) -> Result<(), InputError> {
    if bytes.len() as u64 > MAX_INPUT_BYTES { Err(too_large(place)) } else { Ok(()) }
}

/// The error for an input above the limit of bytes.
fn too_large(place: &str) -> InputError {
    InputError::at(
        place,
        "the input is larger than 256 MiB",
        "Remove points: a few thousand are enough for a boundary.",
    )
}

/// The error for what the system can't read.
pub fn io_error(place: &str, error: &io::Error) -> InputError {
    // Operating systems word these errors differently; common causes get a text of this program.
    let (message, hint) = match error.kind() {
        io::ErrorKind::NotFound => {
            ("there is no such file".to_owned(), "Check the path and the spelling.")
        }
        io::ErrorKind::PermissionDenied => {
            ("the file may not be read".to_owned(), "Check its permissions.")
        }
        _ => (format!("the file can't be read: {error}"), "Check the path and the disk."),
    };
    InputError::at(place, message, hint)
}

/// Text that is encoded as UTF-16, by its byte order mark, in UTF-8; other bytes as they are. What
/// is no character becomes the replacement character.
pub(crate) fn without_utf16(bytes: &[u8]) -> Cow<'_, [u8]> {
    let (rest, of): (_, fn([u8; 2]) -> u16) = match bytes {
        [0xff, 0xfe, rest @ ..] => (rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => (rest, u16::from_be_bytes),
        _ => return Cow::Borrowed(bytes),
    };
    let units = rest.chunks_exact(2).map(|pair| of([pair[0], pair[1]]));
    let text = char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER));
    Cow::Owned(text.collect::<String>().into_bytes())
}

/// The text of some bytes, without the byte order mark that some editors write.
pub(crate) fn text_of<'a>(bytes: &'a [u8], name: &str) -> Result<&'a str, InputError> {
    let place = display_name(name);
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        let hint = "Save it as UTF-8 (in a spreadsheet: CSV UTF-8).";
        return Err(InputError::at(place, "the text is encoded as UTF-16", hint));
    }
    if bytes.contains(&0) {
        return Err(InputError::at(place, "this is binary data, not text", TAKEN));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|&&b| b == b'\n').count();
        InputError::at(
            format!("{place}:{line}"),
            "the text is not encoded as UTF-8",
            "Save it as UTF-8 (in a spreadsheet: CSV UTF-8).",
        )
    })?;
    if text.trim().is_empty() {
        return Err(InputError::at(place, "the input is empty", TAKEN));
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stem_drops_every_known_ending() {
        assert_eq!(stem("a/dinghy.sheet.json"), "dinghy");
        assert_eq!(stem("Leaf.CSV"), "Leaf");
        assert_eq!(stem("b/hull.STL"), "hull");
        assert_eq!(stem("İ.csv"), "İ");
        assert_eq!(stem("-"), "panel");
    }

    #[test]
    fn more_bytes_than_the_limit_are_not_kept() {
        let error = read_limited(io::repeat(b'x'), "endless").unwrap_err();
        assert_eq!(error.to_string(), "endless: the input is larger than 256 MiB");
    }
}
