//! `sheetwright check`: the verdict alone.

use crate::args::CheckArgs;
use crate::failure::Failure;
use crate::make::{checked_of, made_with_advice, names_of, note_options};
use crate::source;
use crate::voice::{Voice, found_errors, in_words, print};
use crate::watcher::Watcher;
use sheetwright::make::Judging;
use sheetwright_files::findings_json;

pub(crate) fn run(args: &CheckArgs, voice: Voice) -> Result<bool, Failure> {
    let design =
        source::design(&args.input.input, &args.input.form, &args.source, &args.mesh, voice)?;
    note_options(&design, &args.mesh, voice);
    let mut watcher = Watcher::new(voice);
    let judging = args.source.judging(Judging::Exact);
    let made = made_with_advice(&design, judging, &mut watcher, &source::name(&args.input.input))?;
    let panels = checked_of(&made);
    print(&if voice.json {
        findings_json(&made, &panels, None)
    } else {
        in_words(&names_of(&made), &panels)
    })?;
    Ok(found_errors(&panels))
}
