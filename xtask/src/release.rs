//! What people install without Rust, in one folder:
//!
//! - `sheetwright`: the command as one static file, which runs on any Linux of the processor;
//! - `sheetwright_….deb`: that file with its manual pages and the completions of shells, which the
//!   command itself prints;
//! - `sheetwright-editor_….deb`: the editor with its icon, desktop entry and kind of file;
//! - `web/`: the editor for the browser (`web`);
//! - `pysheetwright-….whl`: the Python package;
//! - `sheetwright_blender-….zip`: Blender's add-on as an extension that brings this wheel along;
//! - `SHA256SUMS` of all files but those of `web/`.
//!
//! `--tested-editor` packs the editor as the tests have built it: a build for release takes
//! minutes, and adds nothing where the package is what is tried.
//!
//! `cargo-deb` and `maturin` pack by `crates/cli/Cargo.toml`, `crates/editor/Cargo.toml` and
//! `crates/python/pyproject.toml`. Where they are not in PATH, they are installed into
//! `target/tools`.

use crate::root;
use crate::tools::{has_target, read, run, said, text};
use crate::web;
use std::env::consts::ARCH;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const HELP: &str =
    "`cargo xtask release` takes `--out DIR`, after it `--tested-editor` and nothing else";
/// The commands that have a page of their own in the manual.
const COMMANDS: [&str; 5] = ["make", "check", "batch", "new", "convert"];
const SHELLS: [&str; 3] = ["bash", "zsh", "fish"];
/// Blender's add-on, in `addons/blender`, and the file that makes it an extension.
const ADDON: &str = "sheetwright_blender";
const MANIFEST: &str = "blender_manifest.toml";
/// The major version of cargo-deb that reads the settings of our packages.
const CARGO_DEB: u32 = 3;

/// Makes all of it.
pub(crate) fn build() -> Result<(), String> {
    let (out, tested) = match std::env::args().skip(2).collect::<Vec<_>>().as_slice() {
        [flag, folder] if flag == "--out" => (PathBuf::from(folder), false),
        [flag, folder, last] if flag == "--out" && last == "--tested-editor" => {
            (PathBuf::from(folder), true)
        }
        _ => return Err(HELP.to_owned()),
    };
    fs::create_dir_all(&out).map_err(|error| format!("{}: {error}", out.display()))?;
    let out = fs::canonicalize(&out).map_err(|error| format!("{}: {error}", out.display()))?;
    let (target, flags) = static_target();
    let mut build = Command::new("cargo");
    build.args(["build", "--release", "--package", "sheetwright-cli", "--target", &target]);
    run(at_home(build.env("RUSTFLAGS", flags)).current_dir(root()))?;
    let command = root().join("target").join(&target).join("release/sheetwright");
    copy(&command, &out.join("sheetwright"))?;
    write_pages(&command, &root().join("target/pages"))?;

    pack("sheetwright-cli", &["--no-strip", "--target", &target], &out)?;
    if tested {
        // What the tests have built lies in the folder of this profile, with what debuggers read.
        pack("sheetwright-editor", &["--strip", "--profile", "dev"], &out)?;
    } else {
        let mut build = Command::new("cargo");
        build.args(["build", "--release", "--package", "sheetwright-editor"]);
        run(at_home(&mut build).current_dir(root()))?;
        pack("sheetwright-editor", &["--no-strip"], &out)?;
    }
    let mut maturin = Command::new(maturin()?);
    maturin.args(["build", "--quiet", "--release", "--out"]).arg(&out);
    run(at_home(&mut maturin).current_dir(root().join("crates/python")))?;
    write_extension(&out)?;
    web::build_into(&out.join("web"))?;
    write_sums(&out)
}

/// The target of the static command, and the flags that make it static.
fn static_target() -> (String, &'static str) {
    // The C library of this target is a small static one that may go with any program.
    let musl = format!("{ARCH}-unknown-linux-musl");
    if has_target(&musl) {
        return (musl, "");
    }
    // That of the system can be linked in as well, where Rust has no other.
    (format!("{ARCH}-unknown-linux-gnu"), "-C target-feature=+crt-static")
}

/// The command, which builds into `target` even where settings of the user name another folder:
/// what lies in `target` would be of an earlier day.
fn at_home(command: &mut Command) -> &mut Command {
    command.env("CARGO_TARGET_DIR", root().join("target"))
}

/// Writes what belongs into packages beside the programs: pages, completions and the icon.
fn write_pages(command: &Path, folder: &Path) -> Result<(), String> {
    let failed = |path: &Path, error: std::io::Error| format!("{}: {error}", path.display());
    fs::create_dir_all(folder).map_err(|error| failed(folder, error))?;
    let write = |name: &str, text: String| {
        let path = folder.join(name);
        fs::write(&path, text + "\n").map_err(|error| failed(&path, error))
    };
    let printed = |arguments: &[&str]| {
        let text = said(Command::new(command).args(arguments));
        text.ok_or_else(|| format!("the command has failed with {}", arguments.join(" ")))
    };
    write("sheetwright.1", printed(&["man"])?)?;
    for name in COMMANDS {
        write(&format!("sheetwright-{name}.1"), printed(&["man", name])?)?;
    }
    for shell in SHELLS {
        write(&format!("sheetwright.{shell}"), printed(&["completions", shell])?)?;
    }
    write("sheetwright.svg", web::icon()?.trim_end().to_owned())
}

/// Makes the Debian package of a crate that is built.
fn pack(package: &str, options: &[&str], out: &Path) -> Result<(), String> {
    let mut deb = Command::new(cargo_deb()?);
    deb.args(["--quiet", "--no-build", "--package", package]).args(options);
    run(at_home(deb.arg("--output").arg(out)).current_dir(root()))
}

/// Packs Blender's add-on with the wheel that lies in `out`, which the extension names as its own.
fn write_extension(out: &Path) -> Result<(), String> {
    let wheel = names_in(out)?.into_iter().find(|name| name.ends_with(".whl"));
    let wheel = wheel.ok_or("maturin has made no wheel")?;
    let folder = root().join("target/blender");
    let packed = folder.join(ADDON);
    let failed = |error: std::io::Error| format!("{}: {error}", packed.display());
    if folder.exists() {
        fs::remove_dir_all(&folder).map_err(failed)?;
    }
    fs::create_dir_all(packed.join("wheels")).map_err(failed)?;
    copy(&out.join(&wheel), &packed.join("wheels").join(&wheel))?;
    let addon = root().join("addons/blender").join(ADDON);
    for name in names_in(&addon)? {
        copy(&addon.join(&name), &packed.join(&name))?;
    }
    let manifest = packed.join(MANIFEST);
    // Before the first table of the manifest.
    let text = text(&manifest)?;
    let text = text.replacen("\n[", &format!("\nwheels = [\"./wheels/{wheel}\"]\n\n["), 1);
    fs::write(&manifest, text).map_err(failed)?;
    let zip = out.join(format!("{ADDON}-{}.zip", env!("CARGO_PKG_VERSION")));
    let mut python = Command::new("python3");
    python.args(["-m", "zipfile", "-c"]).arg(zip).arg(ADDON);
    run(python.current_dir(&folder))
}

/// The names of the files of a folder, sorted.
fn names_in(folder: &Path) -> Result<Vec<String>, String> {
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        if entry.path().is_file() {
            names.push(entry.file_name().to_string_lossy().into_owned());
        }
    }
    names.sort();
    Ok(names)
}

/// The program `cargo-deb`.
fn cargo_deb() -> Result<PathBuf, String> {
    let tools = root().join("target/tools");
    let ours = tools.join("bin/cargo-deb");
    let fits = |program: &Path| {
        let said = said(Command::new(program).arg("--version"));
        let said = said.as_deref().and_then(|said| said.split_whitespace().last());
        said.is_some_and(|version| version.starts_with(&format!("{CARGO_DEB}.")))
    };
    for program in [ours.as_path(), Path::new("cargo-deb")] {
        if fits(program) {
            return Ok(program.to_owned());
        }
    }
    println!("installing cargo-deb into {}", tools.display());
    let mut cargo = Command::new("cargo");
    // It runs for seconds: not worth the minutes that optimising takes.
    cargo.args(["install", "--quiet", "--locked", "--debug", "--force", "cargo-deb", "--version"]);
    run(cargo.arg(format!("^{CARGO_DEB}")).arg("--root").arg(&tools))?;
    if fits(&ours) { Ok(ours) } else { Err(format!("cargo-deb {CARGO_DEB} can't be had")) }
}

/// The program `maturin`, as the checks of the Python package have it.
fn maturin() -> Result<PathBuf, String> {
    let wanted = text(&root().join(".ci/requirements-python.txt"))?;
    let wanted = wanted.lines().find(|line| line.starts_with("maturin=="));
    let wanted = wanted.ok_or(".ci/requirements-python.txt names no maturin")?;
    let is_it = |program: &Path| {
        let said = said(Command::new(program).arg("--version"));
        said.is_some_and(|said| said.replace(' ', "==") == wanted)
    };
    let tools = root().join("target/tools/python");
    let ours = tools.join("bin/maturin");
    if is_it(Path::new("maturin")) {
        return Ok(PathBuf::from("maturin"));
    }
    if !is_it(&ours) {
        println!("installing {wanted} into {}", tools.display());
        run(Command::new("python3").args(["-m", "venv"]).arg(&tools))?;
        let mut pip = Command::new(tools.join("bin/pip"));
        run(pip.args(["install", "--quiet", "--disable-pip-version-check", wanted]))?;
    }
    Ok(ours)
}

fn write_sums(out: &Path) -> Result<(), String> {
    let mut names = names_in(out)?;
    names.retain(|name| name != "SHA256SUMS");
    let sums = said(Command::new("sha256sum").args(&names).current_dir(out));
    let sums = sums.ok_or("sha256sum has failed")?;
    let path = out.join("SHA256SUMS");
    fs::write(&path, sums + "\n").map_err(|error| format!("{}: {error}", path.display()))?;
    for name in &names {
        println!("{:8.1} MB  {name}", read(&out.join(name))?.len() as f64 / 1e6);
    }
    Ok(())
}

fn copy(from: &Path, to: &Path) -> Result<(), String> {
    fs::copy(from, to).map(drop).map_err(|error| format!("{}: {error}", to.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_add_on_is_of_this_version() {
        let addon = root().join("addons/blender").join(ADDON);
        let version = env!("CARGO_PKG_VERSION");
        let manifest = text(&addon.join(MANIFEST)).unwrap();
        assert!(manifest.contains(&format!("\nversion = \"{version}\"\n")), "{manifest}");
        let numbers = version.replace('.', ", ");
        let addon = text(&addon.join("__init__.py")).unwrap();
        assert!(addon.contains(&format!("\"version\": ({numbers})")), "{addon}");
    }
}
