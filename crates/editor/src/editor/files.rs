//! Files: what the editor wants of the system, and what comes back.
//!
//! The editor itself touches no disk: it says what it wishes, and whoever owns the window (or a
//! test) asks the person and answers.

use super::{Coming, Editor, Next, Source};
use crate::document::{Document, Draft, Reference};
use sheetwright::math::{Point2, Point3};
use sheetwright::predicate::Box2;
use sheetwright_files::{
    InputFormat, MeshFormat, OutputFile, ReadOptions, Units, read_bytes, units_said,
};
use std::path::Path;
use std::sync::Arc;

/// Something that only the system can do.
#[derive(Clone, Debug, PartialEq)]
pub enum FileWish {
    /// A design, a curve table, a drawing or a mesh, chosen by the person.
    Open,
    /// A picture, chosen by the person.
    Picture,
    /// A design to be written: to this file, or to one that the person chooses.
    Save {
        /// The file, if it is known.
        to: Option<String>,
        /// A name to begin with.
        name: String,
        /// What it holds.
        bytes: Vec<u8>,
        /// The version of the document that it holds.
        version: u64,
    },
    /// Files to be written to a folder that the person chooses.
    Export(Vec<OutputFile>),
}

/// A file that the person has chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Opened {
    /// Its path, or its name where there are no paths.
    pub path: String,
    /// What it holds.
    pub bytes: Vec<u8>,
}

/// A file that was dropped on the window.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dropped {
    /// Its path, or its name where there are no paths.
    pub path: String,
    /// What it holds, or why it can't be read.
    pub bytes: Result<Vec<u8>, String>,
}

/// A table whose numbers are in a unit that it does not name.
#[derive(Clone, Debug, PartialEq)]
pub struct Unitless {
    opened: Opened,
    /// The largest extent of its curves, in its unit.
    pub length: f64,
}

impl Unitless {
    /// The name of its file.
    pub fn name(&self) -> &str {
        name_of(&self.opened.path)
    }
}

/// What a file is taken for.
enum Taken {
    Design(Box<Coming>),
    Picture(Opened),
    Unitless(Unitless),
}

/// What the editor opens.
const TAKEN: &str = "The editor opens designs (.json), tables of curves (.csv), tables of \
                     offsets (.csv, .tsv, .txt, .xlsx, .ods), drawings (.svg and .dxf) and \
                     meshes (.obj, .stl, .ply and .glb).";

/// What to do with a file whose name does not tell what it is.
fn way_out(bytes: &[u8]) -> &'static str {
    match InputFormat::of_bytes(bytes) {
        Some(InputFormat::Table) => "It holds a table of curves: give it the ending .csv.",
        Some(InputFormat::Workbook) => "It may be a workbook: give it the ending .xlsx or .ods.",
        Some(InputFormat::Design) => "It may hold a design: give it the ending .json.",
        Some(InputFormat::Drawing(_)) => "It may hold a drawing: give it the ending .svg or .dxf.",
        Some(InputFormat::Mesh(_)) => "It may hold a mesh: give it the ending of its format.",
        _ => {
            "Pictures to trace (.png, .jpg) are dropped on the window or come in by Picture to trace."
        }
    }
}

/// The ends of the names of pictures to draw after.
pub(crate) const PICTURES: [&str; 3] = ["png", "jpg", "jpeg"];

/// What a dropped file is taken for, or why it can't be opened.
fn taken(file: Dropped) -> Result<Taken, String> {
    let Dropped { path, bytes } = file;
    let bytes = bytes.map_err(|error| format!("{path} can't be read: {error}."))?;
    let opened = Opened { path, bytes };
    let ending = Path::new(&opened.path).extension().and_then(|ending| ending.to_str());
    let is_picture = ending.is_some_and(|it| PICTURES.contains(&it.to_lowercase().as_str()));
    if is_picture && image::guess_format(&opened.bytes).is_ok() {
        return Ok(Taken::Picture(opened));
    }
    design_in(opened)
}

/// The design that a file holds; a table without a unit, of which the person is asked.
fn design_in(opened: Opened) -> Result<Taken, String> {
    match Document::read_in(&opened.path, &opened.bytes, None) {
        Ok(read) => Ok(Taken::Design(Box::new(coming(opened.path, read)))),
        Err(text) => without_unit(opened).map(Taken::Unitless).ok_or(text),
    }
}

/// The file, if all that it lacks is a unit: with one it can be read.
fn without_unit(opened: Opened) -> Option<Unitless> {
    let format = InputFormat::of(Path::new(&opened.path)).ok()?;
    if !matches!(format, InputFormat::Table | InputFormat::Workbook) {
        return None;
    }
    let (read, _) =
        Document::read_in(&opened.path, &opened.bytes, Some(Units::Millimetres)).ok()?;
    let points = || read.design.curves.iter().flat_map(|curve| &curve.points).map(|p| p.at);
    let extents = [|p: Point3| p.x, |p: Point3| p.y, |p: Point3| p.z].map(|of| {
        let values = points().map(of);
        let (low, high) = (values.clone().reduce(f64::min)?, values.reduce(f64::max)?);
        Some(high - low)
    });
    let length = extents.into_iter().flatten().fold(0.0, f64::max);
    Some(Unitless { opened, length })
}

/// A document that was read from a file, as what comes next, and what is to be said of it.
fn coming(path: String, (document, said): (Document, Option<&'static str>)) -> Coming {
    let file = path.ends_with(".json").then(|| path.clone());
    let source = Source::File(path);
    Coming { draft: Draft { document, file }, is_safe: true, source, said }
}

/// The last part of a path.
pub(crate) fn name_of(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// Which files were not opened, after a space; nothing if there are none.
fn left_out(names: &[String]) -> String {
    let Some((last, rest)) = names.split_last() else { return String::new() };
    match rest {
        [] => format!(" {last} was not opened: one file opens at a time."),
        rest => {
            format!(" {} and {last} were not opened: one file opens at a time.", rest.join(", "))
        }
    }
}

/// What is said of a mesh whose numbers would be too small for millimetres.
const IN_METRES: &str = "The file names no unit, and would be small for a sheet in millimetres: it \
                         is read in metres. Its size is among the fields of the panel.";
const GLB_IN_METRES: &str = "The file is read in metres, as the standard of glTF says. Its size is \
                             among the fields of the panel.";
const GLB_IN_MILLIMETRES: &str = "The standard of glTF says metres, and the file is read in \
                                  millimetres. Its size is among the fields of the panel.";

/// A larger picture would not fit where drawings are kept.
const MOST_PICTURE_BYTES: usize = 8 << 20;

impl Editor {
    /// The bytes of the document as a file.
    pub fn bytes(&self) -> Vec<u8> {
        self.document().bytes()
    }

    pub(super) fn save(&mut self, to: Option<String>) {
        let name = format!("{}.sheet.json", self.document().design.name);
        let (bytes, version) = (self.bytes(), self.history.version());
        self.wishes.push(FileWish::Save { to, name, bytes, version });
    }

    /// A document was written. What waited for it goes on, unless something has changed meanwhile.
    pub fn saved(&mut self, path: String, version: u64) {
        self.say(format!("Saved to {path}."));
        // Another document may have taken its place meanwhile: its file is not that of the other.
        if version >= self.first_version {
            self.file = Some(path);
            self.saved_version = version;
            let is_now = version == self.history.version();
            self.saved_document = is_now.then(|| self.document().clone());
            self.go_on_if_safe();
        }
    }

    /// Something of the system did not work out.
    pub fn failed(&mut self, text: String) {
        self.refuse(text);
    }

    /// Something of the system worked out.
    pub fn done(&mut self, text: String) {
        self.say(text);
    }

    /// A file was chosen to be opened. It is, once the person has decided about work that no file
    /// has.
    pub fn open(&mut self, opened: Opened) {
        match design_in(opened) {
            Ok(taken) => self.take(taken),
            Err(text) => self.refuse(text),
        }
    }

    fn take(&mut self, taken: Taken) {
        match taken {
            Taken::Design(coming) => self.leave_for(Next::Document(coming)),
            Taken::Picture(picture) => {
                self.page = super::Page::Panes;
                self.trace(picture);
            }
            Taken::Unitless(unitless) => {
                self.unitless = Some(unitless);
                self.page = super::Page::Unit;
            }
        }
    }

    /// The table of which the person is asked in which unit its numbers are.
    pub fn unitless(&self) -> Option<&Unitless> {
        self.unitless.as_ref()
    }

    /// The numbers of that table are in this unit, or the person would not say.
    pub fn unit_is(&mut self, unit: Option<Units>) {
        self.page = super::Page::Panes;
        let unitless = self.unitless.take();
        let (Some(Unitless { opened, .. }), Some(unit)) = (unitless, unit) else { return };
        match Document::read_in(&opened.path, &opened.bytes, Some(unit)) {
            Ok(read) => self.leave_for(Next::Document(Box::new(coming(opened.path, read)))),
            Err(text) => self.refuse(text),
        }
    }

    /// Files were dropped on the window: the first that can be opened is, and the others are named.
    pub fn open_first(&mut self, files: Vec<Dropped>) {
        let (mut found, mut refusal, mut others) = (None, None, Vec::new());
        for file in files {
            let name = name_of(&file.path).to_owned();
            if found.is_some() {
                others.push(name);
                continue;
            }
            match taken(file) {
                Ok(taken) => found = Some(taken),
                Err(text) => {
                    others.push(name);
                    refusal.get_or_insert(text);
                }
            }
        }
        match (found, refusal) {
            (Some(taken), _) => self.take(taken),
            (None, Some(text)) => {
                // The first is named by why it can't be opened.
                others.remove(0);
                self.refuse(text + &left_out(&others));
                return;
            }
            (None, None) => return,
        }
        if !others.is_empty() {
            self.say(left_out(&others).trim_start());
        }
    }

    /// A picture was chosen to draw after: it lies in the middle, as wide as what is drawn.
    pub fn trace(&mut self, opened: Opened) {
        if opened.bytes.len() > MOST_PICTURE_BYTES {
            let most = MOST_PICTURE_BYTES >> 20;
            self.refuse(format!("The picture is larger than {most} MB. Make it smaller first."));
            return;
        }
        let Ok(picture) = image::load_from_memory(&opened.bytes) else {
            self.refuse(format!("{} is no picture in PNG or JPEG.", opened.path));
            return;
        };
        let width = f64::from(picture.width().max(1));
        let mut document = self.document().clone();
        let plan = document.drawing.plan;
        let points = document.design.curves.iter().flat_map(|curve| &curve.points);
        let drawn = Box2::of_points(points.map(|point| plan.flat(point.at)));
        // Of an empty sheet, or one straight line, a metre is as good as anything.
        let (centre, wide_mm) = drawn
            .filter(|drawn| drawn.max.x > drawn.min.x)
            .map_or((Point2::default(), 1000.0), |drawn| {
                (drawn.min.lerp(drawn.max, 0.5), drawn.max.x - drawn.min.x)
            });
        let name = Path::new(&opened.path)
            .file_name()
            .map_or(String::new(), |name| name.to_string_lossy().into_owned());
        document.drawing.reference = Some(Reference {
            name,
            bytes: Arc::from(opened.bytes),
            centre,
            mm_per_pixel: wide_mm / width,
            opacity: 0.5,
        });
        self.becomes(document);
        self.part = crate::room::WindowPart::Plan;
        self.wants_fit = true;
        self.say(
            "Now scale the picture: click two places on it and type the distance between them.",
        );
    }
}

impl Document {
    /// What its file holds: what the command line reads, and how it is drawn.
    pub fn bytes(&self) -> Vec<u8> {
        crate::document::file::written(self)
    }

    /// The document of a file: a design, a curve table, a drawing or a mesh.
    ///
    /// # Errors
    /// What is wrong with it and what to do, in words.
    pub fn read(path: &str, bytes: &[u8]) -> Result<Self, String> {
        Self::read_in(path, bytes, None).map(|(document, _)| document)
    }

    /// The document of a file that is read in this unit, whatever it names, and what is to be said
    /// of the unit that it was read in.
    fn read_in(
        path: &str,
        bytes: &[u8],
        units: Option<Units>,
    ) -> Result<(Self, Option<&'static str>), String> {
        let words = |error: sheetwright_files::InputError| format!("{error}. {}", error.hint);
        let of = Path::new(path);
        let format =
            InputFormat::of(of).map_err(|error| format!("{error}. {TAKEN} {}", way_out(bytes)))?;
        match format {
            InputFormat::Design => {
                crate::document::file::read(path, bytes).map(|read| (read, None)).map_err(words)
            }
            InputFormat::Table
            | InputFormat::Workbook
            | InputFormat::Mesh(_)
            | InputFormat::Drawing(_) => {
                let options = ReadOptions { units, ..ReadOptions::default() };
                let design = read_bytes(format, bytes, path, of.parent(), &options);
                let mut design = design.map_err(words)?;
                let names_none = units.is_none() && units_said(bytes).is_none();
                let is_unsure = names_none && matches!(format, InputFormat::Mesh(_));
                let in_metres = is_unsure && Units::meant(design.extent_mm()) == Units::Metres;
                if in_metres {
                    design = design.scaled(Units::Metres.in_mm());
                }
                let is_glb = format == InputFormat::Mesh(MeshFormat::Glb);
                let said = match (in_metres, is_glb && is_unsure) {
                    (true, true) => Some(GLB_IN_METRES),
                    (true, false) => Some(IN_METRES),
                    (false, true) => Some(GLB_IN_MILLIMETRES),
                    (false, false) => None,
                };
                Ok((Self { design, ..Self::default() }, said))
            }
        }
    }
}

/// The question how far apart two places of the picture are.
impl Editor {
    /// Two places of the picture were taken, mm: they are as far apart as the person types next.
    pub fn calibrate(&mut self, places: [Point2; 2]) {
        self.calibrated = Some(places);
        self.tool = crate::panes::plan::Tool::Select;
        self.page = super::Page::Calibrate;
    }

    /// The distance between the two places of the picture, mm, while it is asked for.
    pub fn calibrating(&self) -> Option<f64> {
        self.calibrated.map(|[a, b]| a.distance(b))
    }

    /// The two places are this far apart, mm: the picture becomes as large as that makes it, and
    /// the first of them stays where it is.
    pub fn calibrated(&mut self, distance_mm: f64) {
        let Some([a, b]) = self.calibrated.take() else { return };
        self.page = super::Page::Panes;
        let apart = a.distance(b);
        if !(apart > 0.0 && distance_mm > 0.0) {
            self.refuse("The two places are the same. Click two places that are apart.".to_owned());
            return;
        }
        let factor = distance_mm / apart;
        let mut document = self.document().clone();
        if let Some(picture) = &mut document.drawing.reference {
            let from_first = |c: f64, first: f64| first + (c - first) * factor;
            picture.centre =
                Point2::new(from_first(picture.centre.x, a.x), from_first(picture.centre.y, a.y));
            picture.mm_per_pixel *= factor;
        }
        self.becomes(document);
    }
}
