//! `sheetwright check`: the verdict alone.

use crate::args::CheckArgs;
use crate::failure::Failure;
use crate::source;
use crate::voice::{Voice, found_errors, in_words, print};
use crate::watcher::Watcher;
use sheetwright::check::Checked;
use sheetwright::design::make;
use sheetwright_files::findings_json;

pub(crate) fn run(args: &CheckArgs, voice: Voice) -> Result<bool, Failure> {
    let design = source::design(&args.source)?;
    let mut watcher = Watcher::new(voice);
    let made = make(&design, &mut watcher);
    watcher.end();
    let made = made.map_err(|error| Failure::of_make(&error, &source::name(&args.source)))?;
    let panels: Vec<Checked> = made.panels.iter().map(|panel| panel.checked.clone()).collect();
    print(&if voice.json {
        findings_json(&made, &panels, None)
    } else {
        in_words(&made, &panels)
    })?;
    Ok(found_errors(&panels))
}
