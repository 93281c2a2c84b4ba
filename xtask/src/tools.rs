//! Other programs and files, for chores that build something.

use crate::root;
use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Whether the compiler in PATH has the standard library of a target.
pub(crate) fn has_target(target: &str) -> bool {
    let sysroot = said(Command::new("rustc").args(["--print", "sysroot"]).current_dir(root()));
    Path::new(&sysroot.unwrap_or_default()).join("lib/rustlib").join(target).is_dir()
}

/// The bytes of a file.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, String> {
    fs::read(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// The text of a file.
pub(crate) fn text(path: &Path) -> Result<String, String> {
    String::from_utf8(read(path)?).map_err(|_| format!("{} is no text", path.display()))
}

/// Runs a command to its end.
///
/// # Errors
/// It can't be run, or it fails.
pub(crate) fn run(command: &mut Command) -> Result<(), String> {
    let name = Path::new(command.get_program()).file_name().unwrap_or(OsStr::new("?")).to_owned();
    let name = name.to_string_lossy();
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{name} has failed ({status})")),
        Err(error) => Err(format!("{name} can't be run: {error}")),
    }
}

/// The standard output of a command; `None` if there is no such command or it fails.
pub(crate) fn said(command: &mut Command) -> Option<String> {
    let output = command.output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
}
