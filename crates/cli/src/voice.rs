//! Output of the command: answers on standard output, everything else on standard error. Text for a
//! terminal is written without control sequences ([`visible`]); designs and pages are written as
//! they are.

use crate::failure::Failure;
use crate::remedies::with_options;
use sheetwright::check::{Checked, Place, Severity, Verdict};
use sheetwright_files::{error_json, finding_place, finding_text, visible};
use std::fmt::Display;
use std::io::{self, Write};

/// How the command speaks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Voice {
    /// In JSON rather than in words.
    pub(crate) json: bool,
    /// Without progress and notes.
    pub(crate) quiet: bool,
}

impl Voice {
    /// Writes why the command failed.
    pub(crate) fn fail(self, failure: &Failure) {
        let Failure { message, place, hint } = failure;
        say(&if self.json {
            error_json(message, place.as_deref(), hint)
        } else {
            let place = place.as_ref().map_or(String::new(), |place| format!("{place}: "));
            let said = [format!("error: {place}{message}"), format!("hint: {hint}")];
            said.map(|text| in_one_line(&text)).concat()
        });
    }

    /// Writes a note about the work, unless the command is quiet or writes JSON.
    pub(crate) fn note(self, text: &str) {
        if !self.quiet && !self.json {
            say(&in_one_line(text));
        }
    }
}

/// The text as one line, even if a path or a name in it has a line break.
fn in_one_line(text: &str) -> String {
    text.replace('\n', "\u{fffd}") + "\n"
}

/// Writes to standard error. Where that fails, no stream is left to report it.
pub(crate) fn say(text: &str) {
    let _ = io::stderr().lock().write_all(visible(text).as_bytes());
}

/// Writes text to standard output. A reader that closes its end early is no failure.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    print_as_it_is(visible(text).as_bytes())
}

/// Writes data, such as a design, to standard output, unchanged.
pub(crate) fn print_as_it_is(bytes: &[u8]) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::new(
            format!("standard output can't be written: {error}"),
            "Check where standard output leads to.",
        )),
        _ => Ok(()),
    }
}

/// The verdict on every panel in words, each followed by its findings, one a line, with the options
/// that help.
pub(crate) fn in_words<T: Display>(names: &[T], panels: &[Checked]) -> String {
    let mut text = String::new();
    for (name, checked) in names.iter().zip(panels) {
        let verdict = match checked.verdict {
            Verdict::Bends => "bends",
            Verdict::BendsAndFolds => "bends, with sharp folds",
            Verdict::BendsWithForce => "bends with some force",
            Verdict::Roll => "must be rolled or formed",
            Verdict::Undecided => "can't tell",
            Verdict::WillNotBend => "will not bend",
        };
        text.push_str(&format!("{name}: {verdict}\n"));
        for finding in &checked.findings {
            let place = match finding.place {
                Place::Whole => String::new(),
                _ => format!(" ({})", finding_place(finding)),
            };
            let (severity, said) = (finding.severity().name(), finding_text(finding));
            let said = format!("  {severity}: {said}{place}");
            text.push_str(&with_options(&said, finding.remedies()));
            text.push('\n');
        }
    }
    text
}

/// Whether some finding is an error.
pub(crate) fn found_errors(panels: &[Checked]) -> bool {
    panels.iter().flat_map(|p| &p.findings).any(|finding| finding.severity() == Severity::Error)
}
