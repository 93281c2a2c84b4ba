//! `sheetwright make`: every file of a design or a mesh, or of several.

use crate::args::{FormArgs, MakeArgs, MeshArgs};
use crate::failure::{Failure, split_value};
use crate::remedies::LONG_REPORT;
use crate::source;
use crate::voice::{Voice, found_errors, in_words, print};
use crate::watcher::Watcher;
use sheetwright::check::Checked;
use sheetwright::design::{Design, DesignPanel};
use sheetwright::make::{Judging, Made, make_judged};
use sheetwright_files::whole::Folder;
use sheetwright_files::{
    FAULT, Format, Ids, OutputOptions, Outputs, ReportForm, findings_json, formats_for,
    output_files, refuse_unmade, refused_for_file, sheets_sentence, stem, timing_json, visible,
};
use std::path::{Path, PathBuf};
use std::time::Instant;

pub(crate) fn run(args: &MakeArgs, voice: Voice) -> Result<bool, Failure> {
    let start = Instant::now();
    match &args.inputs[..] {
        [input] => one(&read(input, &args.form, args, voice)?, input, None, args, start, voice),
        inputs => several(inputs, args, voice),
    }
}

/// Makes several inputs, each into a folder of its own; whether some finding is an error.
fn several(inputs: &[PathBuf], args: &MakeArgs, voice: Voice) -> Result<bool, Failure> {
    if args.form.with.is_some() {
        let hint = "Make the table of offsets alone.";
        return Err(Failure::new("--with goes with one input", hint));
    }
    if inputs.iter().filter(|input| source::is_stdin(input)).count() > 1 {
        return Err(Failure::new(source::STDIN_TWICE, source::STDIN_TWICE_HINT));
    }
    for input in inputs.iter().filter(|input| !source::is_stdin(input) && !input.exists()) {
        let name = input.display().to_string();
        if let Some(hint) = split_value(&name) {
            return Err(Failure::new(format!("unexpected argument '{name}' found"), hint));
        }
    }
    // The format of standard input is not that of the files beside it.
    let has_stdin = inputs.iter().any(|input| source::is_stdin(input));
    let form = |input: &Path| {
        let from = args.form.from.filter(|_| source::is_stdin(input) || !has_stdin);
        FormArgs { from, with: None }
    };
    // All are read before anything is written.
    let read = |input: &PathBuf| read(input, &form(input), args, voice);
    let designs: Vec<Design> = inputs.iter().map(read).collect::<Result<_, _>>()?;
    let folders = folders(inputs, &designs)?;
    let (mut found_errors, mut failed) = (false, None);
    for ((input, design), folder) in inputs.iter().zip(&designs).zip(&folders) {
        match one(design, input, Some(folder), args, Instant::now(), voice) {
            Ok(found) => found_errors |= found,
            // One that can't be made keeps none of the others back.
            Err(failure) => {
                if let Some(before) = failed.replace(failure) {
                    voice.fail(&before);
                }
            }
        }
    }
    failed.map_or(Ok(found_errors), Err)
}

/// The folders of several inputs, called after their files; no two have one name.
fn folders(inputs: &[PathBuf], designs: &[Design]) -> Result<Vec<String>, Failure> {
    let mut ids = Ids::default();
    let mut folders = Vec::new();
    for (input, design) in inputs.iter().zip(designs) {
        let is_stdin = source::is_stdin(input);
        let name = if is_stdin { design.name.clone() } else { stem(&input.display().to_string()) };
        if let Some(why) = refused_for_file(&name).filter(|_| !name.is_empty()) {
            let message = format!("its folder would be called {}, which {why}", visible(&name));
            return Err(Failure::new(message, "Rename it.").at(source::name(input)));
        }
        folders.push(ids.take(&name, 1 + folders.len() as u64));
    }
    Ok(folders)
}

/// Makes one input, of several into the folder `called`.
fn one(
    design: &Design,
    input: &Path,
    called: Option<&str>,
    args: &MakeArgs,
    start: Instant,
    voice: Voice,
) -> Result<bool, Failure> {
    let job = Job {
        input: &source::name(input),
        called,
        judging: args.source.judging(Judging::Exact),
        out: &called.map_or(args.out.clone(), |folder| args.out.join(folder)),
        formats: &formats(design, args),
        options: args.options(design),
        beside: None,
    };
    job.run(design, start, voice)
}

fn read(input: &Path, form: &FormArgs, args: &MakeArgs, voice: Voice) -> Result<Design, Failure> {
    let design = source::design(input, form, &args.source, &args.mesh, voice)?;
    let formats = formats(&design, args);
    refuse_unmade(&design, &formats)?;
    note_options(&design, &args.mesh, voice);
    for idle in args.idle(&design, &formats) {
        voice.note(&format!("note: {idle}"));
    }
    Ok(design)
}

/// The formats that are written of a design.
fn formats(design: &Design, args: &MakeArgs) -> Vec<Format> {
    match &args.formats[..] {
        [] => formats_for(design),
        asked => Format::ALL.into_iter().filter(|format| asked.contains(format)).collect(),
    }
}

/// Notes an option that has no effect.
pub(crate) fn note_options(design: &Design, mesh: &MeshArgs, voice: Voice) {
    if let (false, Some(given)) = (design.panels.iter().any(DesignPanel::is_mesh), mesh.given()) {
        voice.note(&format!(
            "note: {given} has no effect: no panel is a mesh, and the others are laid flat exactly"
        ));
    }
}

/// What is made of an input, and where to.
pub(crate) struct Job<'a> {
    /// How messages name the input.
    pub(crate) input: &'a str,
    /// What it is called among several: it goes before the names of its parts.
    pub(crate) called: Option<&'a str>,
    /// What its verdicts come from.
    pub(crate) judging: Judging,
    /// The folder for the files.
    pub(crate) out: &'a Path,
    /// The formats to write.
    pub(crate) formats: &'a [Format],
    /// How its files are written.
    pub(crate) options: OutputOptions,
    /// A file that goes with them: its name and its bytes.
    pub(crate) beside: Option<(String, Vec<u8>)>,
}

impl Job<'_> {
    /// Makes the input, writes its files and says its verdict; whether some finding is an error.
    pub(crate) fn run(
        &self,
        design: &Design,
        start: Instant,
        voice: Voice,
    ) -> Result<bool, Failure> {
        let formats = self.formats;
        // What can't be written to is said before anybody waits.
        let folder = Folder::new(self.out)?;
        let mut watcher = Watcher::new(voice);
        let mut made = made_with_advice(design, self.judging, &mut watcher, self.input)?;
        made.lay_out(&mut watcher);
        watcher.end();
        let outputs = files(&made, formats, self.options, &mut watcher, self.input)?;
        let mut names: Vec<String> = outputs.files.iter().map(|file| file.name.clone()).collect();

        let mut batch = folder.batch()?;
        for file in &outputs.files {
            batch.add(&file.name, &file.bytes)?;
        }
        if formats.contains(&Format::Report) {
            const TIMING: &str = "timing.json";
            let times = watcher.times(&names_of(&made));
            batch.add(TIMING, &timing_json(&times, start.elapsed().as_secs_f64()))?;
            names.push(TIMING.to_owned());
        }
        if let Some((name, bytes)) = &self.beside {
            batch.add(name, bytes)?;
            names.push(name.clone());
        }
        let prefix = self.called.map_or(String::new(), |called| format!("{called}/"));
        let prefixed = |name: &str| format!("{prefix}{name}");
        let names: Vec<String> = names.iter().map(|name| prefixed(name)).collect();
        let answer = if voice.json {
            findings_json(&made, &outputs.panels, Some(&names))
        } else {
            let parts: Vec<String> = names_of(&made).into_iter().map(prefixed).collect();
            in_words(&parts, &outputs.panels)
        };
        // The answer first: where it can't be given, nothing is written.
        print(&answer)?;
        batch.keep()?;
        let is_short = self.options.report == ReportForm::Auto
            && ReportForm::Auto.is_short(outputs.panels.len());
        if is_short && formats.contains(&Format::Report) {
            voice.note(LONG_REPORT);
        }
        if let Some(sentence) = sheets_sentence(&made) {
            voice.note(&sentence);
        }
        let files = if names.len() == 1 { "file" } else { "files" };
        voice.note(&format!("{} {files} written to {}", names.len(), self.out.display()));
        Ok(found_errors(&outputs.panels))
    }
}

/// Makes a design; `place` is what the design was read from.
pub(crate) fn made(
    design: &Design,
    judging: Judging,
    watcher: &mut Watcher,
    place: &str,
) -> Result<Made, Failure> {
    let made = make_judged(design, judging, watcher);
    watcher.end();
    made.map_err(|error| Failure::of_make(&error, design, place))
}

/// Makes a design and, where sheets are computed, advises on what will not bend; `place` is what
/// the design was read from.
pub(crate) fn made_with_advice(
    design: &Design,
    judging: Judging,
    watcher: &mut Watcher,
    place: &str,
) -> Result<Made, Failure> {
    let mut made = make_judged(design, judging, watcher);
    if let Ok(made) = &mut made
        && judging == Judging::Exact
    {
        made.advise(watcher);
    }
    watcher.end();
    made.map_err(|error| Failure::of_make(&error, design, place))
}

/// The names of its parts.
pub(crate) fn names_of(made: &Made) -> Vec<&str> {
    made.parts.iter().map(|part| part.name.as_str()).collect()
}

/// The verdicts on its parts, before any file is written.
pub(crate) fn checked_of(made: &Made) -> Vec<Checked> {
    made.parts.iter().map(|part| part.checked.clone()).collect()
}

/// Its files in memory.
pub(crate) fn files(
    made: &Made,
    formats: &[Format],
    options: OutputOptions,
    watcher: &mut Watcher,
    place: &str,
) -> Result<Outputs, Failure> {
    watcher.begin_writing();
    let outputs = output_files(made, formats, options);
    outputs
        .map_err(|error| Failure::new(error.to_string(), error.hint().unwrap_or(FAULT)).at(place))
}
