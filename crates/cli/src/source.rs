//! The input of a command, from a file or from standard input.

use crate::args::SourceArgs;
use crate::failure::Failure;
use sheetwright::design::Design;
use sheetwright_files::{read_bytes, read_input, read_limited};
use std::io;
use std::path::Path;

const STDIN: &str = "standard input";

/// The design of the input.
pub(crate) fn design(args: &SourceArgs) -> Result<Design, Failure> {
    let options = args.options();
    match (args.input == Path::new("-"), args.from) {
        (true, Some(from)) => {
            let bytes = read_limited(io::stdin().lock(), STDIN)?;
            Ok(read_bytes(from.format(), &bytes, "-", None, &options)?)
        }
        (true, None) => {
            let message = "the format of standard input is not given";
            Err(Failure::new(message, "Add --from csv or --from json."))
        }
        (false, Some(_)) => {
            let message = "--from is for standard input";
            Err(Failure::new(message, "Leave it out: a file's name ends in its format."))
        }
        (false, None) => Ok(read_input(&args.input, &options)?),
    }
}

/// How messages name the input.
pub(crate) fn name(args: &SourceArgs) -> String {
    if args.input == Path::new("-") { STDIN.to_owned() } else { args.input.display().to_string() }
}
