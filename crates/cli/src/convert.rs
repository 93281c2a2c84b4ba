//! `sheetwright convert`: one format to another.

use crate::args::ConvertArgs;
use crate::failure::Failure;
use crate::make::{files, made, names_of, note_options};
use crate::source;
use crate::voice::{Voice, found_errors, in_words, say};
use crate::watcher::Watcher;
use sheetwright::curve::CurveKind;
use sheetwright::design::Design;
use sheetwright::make::Judging;
use sheetwright_files::whole::write_one;
use sheetwright_files::{
    Format, OutputOptions, findings_json, read_note_text, refuse_unmade, write_design, write_table,
};
use std::path::Path;

/// What a file is turned into.
enum Target {
    Table,
    Design,
    /// A file of this format, whose name ends so.
    Made(Format, &'static str),
}

impl Target {
    fn of(path: &Path) -> Result<Self, Failure> {
        let name = path.file_name().and_then(|n| n.to_str()).unwrap_or_default().to_lowercase();
        if name.ends_with(".sheet.json") {
            return Ok(Self::Design);
        }
        match name.rsplit_once('.').map_or("", |(_, ending)| ending) {
            "csv" => Ok(Self::Table),
            "obj" => Ok(Self::Made(Format::Obj, ".obj")),
            "step" | "stp" => Ok(Self::Made(Format::Step, ".step")),
            "fold" => Ok(Self::Made(Format::Fold, ".fold")),
            "pdf" => Ok(Self::Made(Format::Pdf, ".pdf")),
            "html" => Ok(Self::Made(Format::Report, ".html")),
            "json" => Ok(Self::Made(Format::Report, ".json")),
            "svg" => Ok(Self::Made(Format::Svg, ".svg")),
            "dxf" => Ok(Self::Made(Format::Dxf, ".dxf")),
            _ => Err(Failure::new(
                "the ending of the name is no format that can be written",
                "End it in .sheet.json, .csv, .obj, .step, .fold, .pdf, .html, .json, .svg or .dxf.",
            )
            .at(path.display().to_string())),
        }
    }
}

pub(crate) fn run(args: &ConvertArgs, voice: Voice) -> Result<bool, Failure> {
    let target = Target::of(&args.out)?;
    let design =
        source::design(&args.input.input, &args.input.form, &args.source, &args.mesh, voice)?;
    note_options(&design, &args.mesh, voice);
    match target {
        Target::Table => {
            write_one(&args.out, &table(&design, &args.out)?)?;
            note_reading(&design, voice);
            Ok(false)
        }
        Target::Design => {
            write_one(&args.out, &write_design(&design))?;
            note_reading(&design, voice);
            Ok(false)
        }
        Target::Made(format, ending) => {
            refuse_unmade(&design, &[format])?;
            let mut watcher = Watcher::new(voice);
            let place = source::name(&args.input.input);
            let single = matches!(format, Format::Svg | Format::Dxf);
            if single && design.panels_to_make().len() > 1 {
                return Err(for_one_panel(ending, &args.out));
            }
            let made = made(&design, args.source.judging(Judging::Exact), &mut watcher, &place)?;
            let names = names_of(&made);
            // A mesh may turn out to be several parts.
            if single && names.len() > 1 {
                return Err(for_one_panel(ending, &args.out));
            }
            let options = OutputOptions { pdf: args.pdf.options(), ..args.files.options(&design) };
            let outputs = files(&made, &[format], options, &mut watcher, &place)?;

            let file = outputs.files.iter().find(|file| file.name.ends_with(ending));
            let file = file.ok_or_else(|| {
                Failure::new(format!("no {ending} came out"), "This is a fault of the program.")
            })?;
            write_one(&args.out, &file.bytes)?;
            // The answer is the file; what was found is said beside it.
            if voice.json {
                say(&findings_json(&made, &outputs.panels, None));
            } else if !voice.quiet {
                say(&in_words(&names, &outputs.panels));
            }
            Ok(found_errors(&outputs.panels))
        }
    }
}

/// Says how a drawing was read, which neither a design nor a table keeps.
fn note_reading(design: &Design, voice: Voice) {
    design.notes.iter().for_each(|note| voice.note(&format!("note: {}", read_note_text(note))));
}

fn for_one_panel(ending: &str, out: &Path) -> Failure {
    let message = format!("{ending} holds one panel, and there are several");
    let hint = "`sheetwright make` writes one file for each panel; .pdf holds all of them.";
    Failure::new(message, hint).at(out.display().to_string())
}

fn table(design: &Design, out: &Path) -> Result<Vec<u8>, Failure> {
    if design.curves.is_empty() {
        let message = "a mesh has no boundary curves to write";
        let hint = "It can become .sheet.json, .obj, .pdf, .html, .json or, of a single panel, \
                    .svg or .dxf.";
        return Err(Failure::new(message, hint).at(out.display().to_string()));
    }
    if let Some(curve) = design.curves.iter().find(|c| c.kind == Some(CurveKind::BSpline)) {
        let message = format!("the points of the curve '{}' do not lie on it", curve.name);
        let hint = "A table has points of curves, not control points: make the curve a spline.";
        return Err(Failure::new(message, hint));
    }
    Ok(write_table(&design.curves))
}
