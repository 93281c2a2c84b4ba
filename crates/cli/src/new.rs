//! `sheetwright new`: a design from a template.

use crate::args::NewArgs;
use crate::failure::Failure;
use crate::make::Job;
use crate::voice::{Voice, print, print_as_it_is};
use sheetwright::design::MeshOptions;
use sheetwright::template::template;
use sheetwright_files::whole::write_one;
use sheetwright_files::{
    Format, Input, OutputOptions, catalogue_json, catalogue_text, design_from_template, new_design,
    template_text, write_design,
};
use std::path::Path;
use std::time::Instant;

/// Writes the design, makes it, or says what there is; whether some finding is an error.
pub(crate) fn run(args: &NewArgs, voice: Voice) -> Result<bool, Failure> {
    let name = args.template.as_deref();
    if args.list {
        return list(name, voice).map(|()| false);
    }
    let start = Instant::now();
    let name = name.unwrap_or_default();
    // Tables are named from the folder of the design, as in the design itself.
    let folder = match args.out.as_deref().and_then(Path::parent) {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let new = new_design(name, &args.set, folder)?;
    if let Some(out) = &args.make {
        // Tables need not lie in the folder of the patterns: the design there has their points.
        let beside = Some((format!("{}.sheet.json", new.design.name), write_design(&new.design)));
        let options = OutputOptions::default();
        let mesh = MeshOptions::default();
        let job = Job { input: name, out, formats: &Format::DEFAULT, options, mesh, beside };
        return job.run(&Input::Design(new.design), start, voice);
    }
    let bytes = new.bytes();
    match &args.out {
        Some(path) => write_one(path, &bytes)?,
        None => print_as_it_is(&bytes)?,
    }
    Ok(false)
}

fn list(name: Option<&str>, voice: Voice) -> Result<(), Failure> {
    let one = name.and_then(template);
    match (one, name) {
        // A name that is none is answered as it is where a design is wanted.
        (None, Some(name)) => design_from_template(name, &[]).map(|_| ()).map_err(Failure::from),
        _ if voice.json => print(&catalogue_json(one)),
        (Some(template), _) => print(&template_text(template)),
        (None, None) => print(&catalogue_text()),
    }
}
