//! The input of a command, from a file or from standard input.

use crate::args::SourceArgs;
use crate::failure::Failure;
use sheetwright_files::{Input, read_any, read_any_bytes, read_limited};
use std::io;
use std::path::Path;

const STDIN: &str = "standard input";

/// What the input holds.
pub(crate) fn input(args: &SourceArgs) -> Result<Input, Failure> {
    let options = args.options();
    match (args.input == Path::new("-"), args.from) {
        (true, Some(from)) => {
            let bytes = read_limited(io::stdin().lock(), STDIN)?;
            Ok(read_any_bytes(from.format(), &bytes, "-", None, &options)?)
        }
        (true, None) => {
            let message = "the format of standard input is not given";
            Err(Failure::new(message, "Add --from csv, --from json or --from obj."))
        }
        (false, Some(_)) => {
            let message = "--from is for standard input";
            Err(Failure::new(message, "Leave it out: a file's name ends in its format."))
        }
        (false, None) => Ok(read_any(&args.input, &options)?),
    }
}

/// How messages name the input.
pub(crate) fn name(args: &SourceArgs) -> String {
    if args.input == Path::new("-") { STDIN.to_owned() } else { args.input.display().to_string() }
}
