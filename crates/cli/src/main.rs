//! The command `sheetwright`: boundary curves in, flat patterns and a verdict out.

mod args;
mod batch;
mod check;
mod convert;
mod failure;
mod make;
mod new;
mod pages;
mod remedies;
mod signals;
mod size;
mod source;
mod voice;
mod watcher;

use args::{Cli, Command};
use clap::Parser;
use clap::error::ErrorKind;
use failure::Failure;
use std::process::ExitCode;
use voice::Voice;

/// The memory of the static command.
#[cfg(target_env = "musl")]
#[global_allocator]
static MEMORY: dlmalloc::GlobalDlmalloc = dlmalloc::GlobalDlmalloc;

/// Done, and no finding is an error.
const FINE: u8 = 0;
/// Done, and some finding is an error.
const FOUND: u8 = 1;
/// The input or the call can't be used; nothing is written of that input.
const REFUSED: u8 = 2;

fn main() -> ExitCode {
    signals::clean_up_when_stopped();
    ExitCode::from(match Cli::try_parse() {
        Ok(cli) => {
            let voice = Voice { json: cli.json, quiet: cli.quiet };
            match run(&cli.command, voice) {
                Ok(found_errors) if found_errors => FOUND,
                Ok(_) => FINE,
                Err(failure) => {
                    voice.fail(&failure);
                    REFUSED
                }
            }
        }
        Err(error) => refused_call(&error),
    })
}

/// Runs a command; whether some finding is an error.
fn run(command: &Command, voice: Voice) -> Result<bool, Failure> {
    match command {
        Command::Make(args) => make::run(args, voice),
        Command::Check(args) => check::run(args, voice),
        Command::Batch(args) => batch::run(args, voice),
        Command::New(args) => new::run(args, voice),
        Command::Convert(args) => convert::run(args, voice),
        Command::Completions { shell } => pages::completions(*shell).map(|()| false),
        Command::Man { command } => pages::man(command.as_deref()).map(|()| false),
    }
}

/// Answers a call that asks for help, or that can't be used.
fn refused_call(error: &clap::Error) -> u8 {
    // Before the call is understood, its own words are all there is to go by.
    let json = std::env::args_os().any(|arg| arg == "--json");
    let voice = Voice { json, quiet: false };
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            let shown = voice::print(&error.render().to_string());
            shown.map_or_else(
                |failure| {
                    voice.fail(&failure);
                    REFUSED
                },
                |()| FINE,
            )
        }
        _ => {
            voice.fail(&Failure::of_call(error));
            REFUSED
        }
    }
}
