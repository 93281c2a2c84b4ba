//! `sheetwright make`: every file of a design or a mesh.

use crate::args::{MakeArgs, MeshArgs};
use crate::failure::Failure;
use crate::remedies::LONG_REPORT;
use crate::source;
use crate::voice::{Voice, found_errors, in_words, print};
use crate::watcher::Watcher;
use sheetwright::check::Checked;
use sheetwright::design::{Design, DesignPanel, PanelShape};
use sheetwright::make::{Judging, Made, make_judged};
use sheetwright_files::whole::Folder;
use sheetwright_files::{
    FAULT, Format, OutputOptions, Outputs, ReportForm, findings_json, formats_for, output_files,
    refuse_unmade, sheets_sentence, timing_json,
};
use std::path::Path;
use std::time::Instant;

pub(crate) fn run(args: &MakeArgs, voice: Voice) -> Result<bool, Failure> {
    let start = Instant::now();
    let design = source::design(&args.input, &args.source, &args.mesh, voice)?;
    let formats = match &args.formats[..] {
        [] => formats_for(&design),
        asked => Format::ALL.into_iter().filter(|format| asked.contains(format)).collect(),
    };
    refuse_unmade(&design, &formats)?;
    note_options(&design, &args.mesh, voice);
    let job = Job {
        input: &source::name(&args.input),
        judging: args.source.judging(Judging::Exact),
        out: &args.out,
        formats: &formats,
        options: args.options(&design),
        beside: None,
    };
    job.run(&design, start, voice)
}

fn is_mesh(panel: &DesignPanel) -> bool {
    matches!(panel.shape, PanelShape::Mesh(_))
}

/// Notes an option that has no effect.
pub(crate) fn note_options(design: &Design, mesh: &MeshArgs, voice: Voice) {
    if let (false, Some(given)) = (design.panels.iter().any(is_mesh), mesh.given()) {
        voice.note(&format!(
            "note: {given} has no effect: no panel is a mesh, and the others are laid flat exactly"
        ));
    }
}

/// What is made of an input, and where to.
pub(crate) struct Job<'a> {
    /// How messages name the input.
    pub(crate) input: &'a str,
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
        let mut made = made(design, self.judging, &mut watcher, self.input)?;
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
        let answer = if voice.json {
            findings_json(&made, &outputs.panels, Some(&names))
        } else {
            in_words(&names_of(&made), &outputs.panels)
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

/// Makes a design; `place` is what it was read from.
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
