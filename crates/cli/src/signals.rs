//! Ctrl-C and `kill`: what is half written goes, and what is being named is named to its end.
//!
//! Then the signal does what it does by itself, so that a shell sees what has ended the command. On
//! Windows, and after a signal that no program can catch, the next run removes what is left.

use std::sync::OnceLock;

/// What is said when a signal ends the command.
static LAST_WORDS: OnceLock<String> = OnceLock::new();

/// Has this said when a signal ends the command.
pub(crate) fn say_when_stopped(text: String) {
    // Only the first call sets the text.
    let _ = LAST_WORDS.set(text);
}

/// Sees to it from now on, on a thread of its own.
#[cfg(unix)]
pub(crate) fn clean_up_when_stopped() {
    use sheetwright_files::whole::give_up;
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    let ignored = ignored();
    // `nohup` has the end of a terminal ignored, and only Linux says whether it is.
    let ending: &[i32] =
        if cfg!(target_os = "linux") { &[SIGINT, SIGTERM, SIGHUP] } else { &[SIGINT, SIGTERM] };
    let heard = ending.iter().filter(|&&signal| ignored >> (signal - 1) & 1 == 0);
    let Ok(mut signals) = Signals::new(heard) else { return };
    std::thread::spawn(move || {
        for signal in signals.forever() {
            give_up();
            if let Some(text) = LAST_WORDS.get() {
                crate::voice::say(text);
            }
            let _ = emulate_default_handler(signal);
        }
    });
}

/// The signals that the program that started the command has it ignore, one a bit; none where the
/// system does not say.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}

#[cfg(not(unix))]
pub(crate) fn clean_up_when_stopped() {}
