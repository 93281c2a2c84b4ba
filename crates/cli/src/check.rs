//! `sheetwright check`: the verdict alone.

use crate::args::CheckArgs;
use crate::failure::Failure;
use crate::make::{Made, note_options};
use crate::source;
use crate::voice::{Voice, found_errors, in_words, print};
use crate::watcher::Watcher;
use sheetwright_files::findings_json;

pub(crate) fn run(args: &CheckArgs, voice: Voice) -> Result<bool, Failure> {
    let input = source::input(&args.source)?;
    note_options(&input, &args.source, &args.mesh, voice);
    let mut watcher = Watcher::new(voice);
    let made = Made::of(&input, &args.mesh.options(), &mut watcher, &source::name(&args.source))?;
    let panels = made.checked();
    print(&if voice.json {
        findings_json(made.name(), &made.panels(), &panels, None)
    } else {
        in_words(&made.panels(), &panels)
    })?;
    Ok(found_errors(&panels))
}
