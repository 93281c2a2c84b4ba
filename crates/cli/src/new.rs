//! `sheetwright new`: a design from a template.

use crate::args::NewArgs;
use crate::failure::Failure;
use crate::make::Job;
use crate::remedies::{CATALOGUE, TEMPLATE_CALL, bare_outlines};
use crate::voice::{Voice, print, print_as_it_is};
use sheetwright::make::Judging;
use sheetwright::template::template;
use sheetwright_files::whole::write_one;
use sheetwright_files::{
    InputError, OutputOptions, Units, catalogue_json, catalogue_text, design_from_template,
    formats_for, new_design, shown, template_text, write_design,
};
use std::path::Path;
use std::time::Instant;

/// Writes the design, makes it, or lists templates. Returns whether some finding is an error.
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
    refuse_slips(name, &args.set)?;
    let mut new = new_design(name, &args.set, folder).map_err(|error| refused(name, error))?;
    match (&args.trade, template(name).and_then(|template| template.trade)) {
        (Some(trade), _) => new.make_for(trade),
        (None, Some(usual)) => voice.note(&bare_outlines(usual)),
        (None, None) => {}
    }
    args.sheets.settings(None).set(&mut new.design)?;
    if let Some(out) = &args.make {
        // Tables need not lie in the folder of the patterns: the design there has their points.
        let beside = Some((format!("{}.sheet.json", new.design.name), write_design(&new.design)));
        let options = OutputOptions::of(&new.design);
        let (formats, judging) = (&formats_for(&new.design), Judging::Exact);
        let job = Job { input: name, called: None, judging, out, formats, options, beside };
        return job.run(&new.design, start, voice);
    }
    let bytes = new.bytes();
    match &args.out {
        Some(path) => write_one(path, &bytes)?,
        None => print_as_it_is(&bytes)?,
    }
    Ok(false)
}

/// Why a template can't be made; for an unknown name, also how to list all templates.
fn refused(name: &str, error: InputError) -> Failure {
    let mut failure = Failure::from(error);
    if template(name).is_none() {
        failure.hint = format!("{} {CATALOGUE}", failure.hint);
    }
    failure
}

/// Refuses a unit in place of a template, which comes from a setting with a space that is not
/// quoted, and several settings in one, separated by commas or semicolons.
fn refuse_slips(name: &str, settings: &[String]) -> Result<(), Failure> {
    let Some(template) = template(name) else {
        return match Units::from_name(name) {
            Some(_) => Err(Failure::new(
                format!("there is no template {}", shown(name)),
                "Put a value with a space in quotation marks: --set 'height=500 mm'.",
            )),
            None => Ok(()),
        };
    };
    let is_name = |text: &str| {
        text.starts_with(char::is_alphabetic)
            && text.chars().all(|c| c.is_alphanumeric() || c == '-')
    };
    let is_setting =
        |part: &&str| part.split_once('=').is_some_and(|(name, _)| is_name(name.trim()));
    for setting in settings {
        let parts: Vec<&str> = setting.split([',', ';']).map(str::trim).collect();
        if parts.len() < 2 || !parts.iter().all(is_setting) {
            continue;
        }
        let each: Vec<String> = parts.iter().take(3).map(|part| format!("--set {part}")).collect();
        let rest = if parts.len() > 3 { " …" } else { "" };
        let message = format!("{} is several settings", shown(setting));
        let hint = format!("Write --set for each: {}{rest}.", each.join(" "));
        return Err(Failure::new(message, hint).at(template.name));
    }
    Ok(())
}

fn list(name: Option<&str>, voice: Voice) -> Result<(), Failure> {
    let one = name.and_then(template);
    match (one, name) {
        // An unknown name gives the error that it gives without --list.
        (None, Some(name)) => {
            design_from_template(name, &[]).map(|_| ()).map_err(|error| refused(name, error))
        }
        _ if voice.json => print(&catalogue_json(one)),
        (Some(template), _) => print(&template_text(template)),
        (None, None) => print(&catalogue_text(TEMPLATE_CALL)),
    }
}
