//! The input of a command, from a file or from standard input.

use crate::args::{FormArgs, MeshArgs, SourceArgs};
use crate::failure::{Failure, for_all};
use crate::size::sized;
use crate::voice::Voice;
use sheetwright::design::Design;
use sheetwright_files::{
    INPUT_ENDINGS, InputFormat, ReadOptions, SecondTable, Units, hull_table_notes, io_error,
    read_bytes, read_input, read_limited, units_said,
};
use std::fs::File;
use std::io::{self, Read as _};
use std::path::Path;

pub(crate) const STDIN: &str = "standard input";
/// The refusal of a call that reads standard input twice.
pub(crate) const STDIN_TWICE: &str = "standard input is named twice";
pub(crate) const STDIN_TWICE_HINT: &str = "Name it once.";
/// The bytes at the beginning of a file in which a comment may name its unit.
const LOOKED_AT: u64 = 1 << 14;

/// The design that the input holds, with its meshes laid flat as these arguments say.
pub(crate) fn design(
    input: &Path,
    form: &FormArgs,
    args: &SourceArgs,
    mesh: &MeshArgs,
    voice: Voice,
) -> Result<Design, Failure> {
    settled(read(input, form, args, mesh)?, args, voice)
}

/// The design in a file.
pub(crate) fn design_in(
    path: &Path,
    args: &SourceArgs,
    mesh: &MeshArgs,
    voice: Voice,
) -> Result<Design, Failure> {
    settled(read_file(path, &options(args, mesh))?, args, voice)
}

/// The settings of the caller, those of meshes among them.
pub(crate) fn options(args: &SourceArgs, mesh: &MeshArgs) -> ReadOptions {
    ReadOptions { mesh: mesh.settings(), ..args.options() }
}

/// The design in the size that the call gives; what is to be noted of it is said.
fn settled(read: Read, args: &SourceArgs, voice: Voice) -> Result<Design, Failure> {
    let Read { format, said, design, notes } = read;
    notes.iter().for_each(|note| voice.note(&format!("note: {note}")));
    sized(design, format, said, args, voice)
}

/// An input, its format, and the unit that it names if it is a mesh.
struct Read {
    format: InputFormat,
    said: Option<Units>,
    design: Design,
    /// What is to be noted of a table of offsets.
    notes: Vec<String>,
}

fn read_file(path: &Path, options: &ReadOptions) -> Result<Read, Failure> {
    let design = read_input(path, options)?;
    let (format, said) = (InputFormat::of(path)?, said_in(path));
    let notes = notes_of(path, format, options);
    Ok(Read { format, said, design, notes })
}

fn read(
    input: &Path,
    form: &FormArgs,
    args: &SourceArgs,
    mesh: &MeshArgs,
) -> Result<Read, Failure> {
    let second_table = form.with.as_deref().map(second_table).transpose()?;
    let options = ReadOptions { second_table, ..options(args, mesh) };
    match (is_stdin(input), form.from) {
        (true, Some(from)) => {
            let bytes = read_limited(io::stdin().lock(), STDIN)?;
            let format = from.format();
            let design = read_bytes(format, &bytes, "-", None, &options)?;
            let notes = hull_table_notes(&bytes, "-", &options);
            Ok(Read { format, said: units_said(&bytes), design, notes })
        }
        (true, None) => {
            let bytes = read_limited(io::stdin().lock(), STDIN)?;
            // Nothing at all is refused as any format is.
            let none = bytes.trim_ascii().is_empty().then_some(InputFormat::Table);
            let format = InputFormat::of_bytes(&bytes).or(none).ok_or_else(|| {
                let message = "the content does not show its format";
                let hint = "Name the format: add --from csv, json, svg, dxf, obj, stl, ply or glb.";
                Failure::new(message, hint).at(STDIN)
            })?;
            let design = read_bytes(format, &bytes, "-", None, &options)?;
            let notes = hull_table_notes(&bytes, "-", &options);
            Ok(Read { format, said: units_said(&bytes), design, notes })
        }
        (false, Some(_)) => {
            let message = "--from is for standard input";
            Err(Failure::new(
                message,
                "Leave --from out: the ending of a file's name tells its format.",
            ))
        }
        (false, None) if input.is_dir() => Err(folder(input)),
        (false, None) => read_file(input, &options),
    }
}

/// The second file of a table of offsets.
fn second_table(path: &Path) -> Result<SecondTable, Failure> {
    let name = path.display().to_string();
    let file = File::open(path).map_err(|error| io_error(&name, &error))?;
    let bytes = read_limited(file, &name)?;
    Ok(SecondTable { name, bytes })
}

/// What is to be noted of a table of offsets in a file.
fn notes_of(path: &Path, format: InputFormat, options: &ReadOptions) -> Vec<String> {
    let is_table = matches!(format, InputFormat::Table | InputFormat::Workbook);
    // A pipe, which was read before, has nothing left.
    let is_file = path.metadata().is_ok_and(|data| data.is_file());
    let name = path.display().to_string();
    let bytes = File::open(path).ok().filter(|_| is_table && is_file);
    let bytes = bytes.and_then(|file| read_limited(file, &name).ok()).unwrap_or_default();
    hull_table_notes(&bytes, &name, options)
}

/// The unit that a mesh file names.
fn said_in(path: &Path) -> Option<Units> {
    // A pipe, which was read before, has nothing left.
    path.metadata().ok()?.is_file().then_some(())?;
    let mut beginning = Vec::new();
    File::open(path).ok()?.take(LOOKED_AT).read_to_end(&mut beginning).ok()?;
    units_said(&beginning)
}

/// The refusal of a folder, with what makes all that is in it, for the kind of files that is there.
fn folder(path: &Path) -> Failure {
    let names: Vec<String> = std::fs::read_dir(path)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    let is_there = |ending: &&&str| names.iter().any(|name| name.ends_with(**ending));
    let hint = match INPUT_ENDINGS.iter().find(is_there) {
        Some(ending) => {
            let all = Path::new(&in_shell(path)).join(format!("*{ending}"));
            format!("Name one file in it. {}", for_all(&all.display().to_string(), ending))
        }
        None => "Name a file: a design (.sheet.json), a curve table (.csv), a table of offsets \
                 (.csv, .tsv, .txt, .xlsx or .ods), a drawing (.svg or .dxf) or a mesh (.obj, \
                 .stl, .ply or .glb)."
            .to_owned(),
    };
    Failure::new("this is a folder", hint).at(path.display().to_string())
}

/// A path as a shell takes it: in quotation marks where a blank or the like would end it.
fn in_shell(path: &Path) -> String {
    let path = path.display().to_string();
    let is_plain = |c: char| c.is_alphanumeric() || "/._-".contains(c);
    if path.chars().all(is_plain) { path } else { format!("'{}'", path.replace('\'', r"'\''")) }
}

/// How messages name the input.
pub(crate) fn name(input: &Path) -> String {
    if is_stdin(input) { STDIN.to_owned() } else { input.display().to_string() }
}

pub(crate) fn is_stdin(input: &Path) -> bool {
    input == Path::new("-")
}
