//! `sheetwright new`: a design from a template.

use crate::args::NewArgs;
use crate::failure::Failure;
use crate::voice::{Voice, print};
use crate::whole::write_one;
use sheetwright::template::template;
use sheetwright_files::{
    catalogue_json, catalogue_text, design_from_template, new_design, template_text,
};
use std::path::Path;

pub(crate) fn run(args: &NewArgs, voice: Voice) -> Result<(), Failure> {
    let name = args.template.as_deref();
    if args.list {
        let one = name.and_then(template);
        return match (one, name) {
            // A name that is none is answered as it is where a design is wanted.
            (None, Some(name)) => {
                design_from_template(name, &[]).map(|_| ()).map_err(Failure::from)
            }
            _ if voice.json => print(&catalogue_json(one)),
            (Some(template), _) => print(&template_text(template)),
            (None, None) => print(&catalogue_text()),
        };
    }
    // Tables are named from the folder of the design, as in the design itself.
    let folder = match args.out.as_deref().and_then(Path::parent) {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let bytes = new_design(name.unwrap_or_default(), &args.set, folder)?.bytes();
    match &args.out {
        Some(path) => write_one(path, &bytes)?,
        None => print(&String::from_utf8_lossy(&bytes))?,
    }
    Ok(())
}
