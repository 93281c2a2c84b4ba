//! `sheetwright make`: every file of a design.

use crate::args::{Aim, MakeArgs};
use crate::failure::Failure;
use crate::source;
use crate::voice::{Voice, found_errors, in_words, print};
use crate::watcher::Watcher;
use crate::whole::Folder;
use sheetwright::design::{Design, Made, make};
use sheetwright_files::{Format, Outputs, PdfOptions, findings_json, output_files, timing_json};
use std::path::Path;
use std::time::Instant;

const FAULT: &str = "This is a fault of the program: please report it with the input.";

pub(crate) fn run(args: &MakeArgs, voice: Voice) -> Result<bool, Failure> {
    let formats: Vec<Format> = Format::ALL
        .into_iter()
        .filter(|format| match &args.formats[..] {
            [] => Format::DEFAULT.contains(format),
            asked => asked.contains(format),
        })
        .collect();
    let start = Instant::now();
    let design = source::design(&args.source)?;
    if let Some(aim) = args.aim {
        voice.note(&aim_note(aim));
    }
    let input = source::name(&args.source);
    let job = Job {
        input: &input,
        out: &args.out,
        formats: &formats,
        pdf: args.pdf.options(),
        beside: None,
    };
    job.run(&design, start, voice)
}

/// What is made of a design, and where to.
pub(crate) struct Job<'a> {
    /// How messages name the design.
    pub(crate) input: &'a str,
    /// The folder for the files.
    pub(crate) out: &'a Path,
    /// The formats to write.
    pub(crate) formats: &'a [Format],
    /// How patterns come to paper.
    pub(crate) pdf: PdfOptions,
    /// A file that goes with them: its name and its bytes.
    pub(crate) beside: Option<(String, Vec<u8>)>,
}

impl Job<'_> {
    /// Makes the design, writes its files and says its verdict; whether some finding is an error.
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
        let (made, outputs) = made(design, formats, &self.pdf, &mut watcher, self.input)?;
        let mut names: Vec<String> = outputs.files.iter().map(|file| file.name.clone()).collect();

        let mut batch = folder.batch()?;
        for file in &outputs.files {
            batch.add(&file.name, &file.bytes)?;
        }
        if formats.contains(&Format::Report) {
            const TIMING: &str = "timing.json";
            let times = watcher.times(design);
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
            in_words(&made, &outputs.panels)
        };
        // The answer first: where it can't be given, nothing is written.
        print(&answer)?;
        batch.keep()?;
        voice.note(&format!("{} files written to {}", names.len(), self.out.display()));
        Ok(found_errors(&outputs.panels))
    }
}

/// A design, made, and its files in memory.
pub(crate) fn made(
    design: &Design,
    formats: &[Format],
    pdf: &PdfOptions,
    watcher: &mut Watcher,
    input: &str,
) -> Result<(Made, Outputs), Failure> {
    let made = make(design, watcher);
    watcher.end();
    let made = made.map_err(|error| Failure::of_make(&error, input))?;
    watcher.begin_writing();
    let outputs = output_files(&made, formats, pdf)
        .map_err(|e| Failure::new(e.to_string(), FAULT).at(input))?;
    Ok((made, outputs))
}

fn aim_note(aim: Aim) -> String {
    let aim = match aim {
        Aim::Mean => "mean",
        Aim::Max => "max",
        Aim::Seams => "seams",
    };
    format!("note: every panel is flattened exactly, so --aim {aim} makes no difference")
}
