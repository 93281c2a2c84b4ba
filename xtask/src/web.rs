//! The editor for the browser: a folder of files that any web server can serve.
//!
//! 1. The crate is compiled for WebAssembly: by the toolchain in PATH if it has the target, else by
//!    Debian's, which builds the standard library for it on the way.
//! 2. `wasm-bindgen`, as a library, writes the script that joins it to a page; `Cargo.lock` keeps
//!    it at the version that the crate is compiled with, since no other fits. No `wasm-opt` after
//!    it: the output of the compiler for size is smaller once a server has packed it, and older
//!    versions of `wasm-opt` break it.
//! 3. The page is put beside it (`crates/editor/web`), with the colours of the editor's theme, an
//!    icon in the same colours, and a list of all files under a number made from their contents,
//!    from which the service worker keeps them for when there is no network.

mod icon;

use crate::root;
use crate::tools::{has_target, read, run, text};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use wasm_bindgen_cli_support::Bindgen;

const TARGET: &str = "wasm32-unknown-unknown";
const CRATE: &str = "sheetwright-editor";
/// The compiler's name for the compiled crate.
const MADE: &str = "sheetwright_editor.wasm";
/// The files of the page that colours and sizes are put into.
const PAGE: [&str; 6] =
    ["index.html", "page.css", "page.js", "kept.js", "worker.js", "manifest.webmanifest"];
const HELP: &str = "`cargo xtask web` takes `--out DIR` and nothing else";

/// Builds the folder.
pub(crate) fn build() -> Result<(), String> {
    let mut out = root().join("target/web");
    match std::env::args().skip(2).collect::<Vec<_>>().as_slice() {
        [] => {}
        [flag, folder] if flag == "--out" => out = PathBuf::from(folder),
        _ => return Err(HELP.to_owned()),
    }
    build_into(&out)
}

/// The icon, in the colours of the editor's theme, as SVG.
pub(crate) fn icon() -> Result<String, String> {
    let theme = text(&root().join("crates/editor/src/theme.rs"))?;
    icon::svg(&|name| colour(&theme, name))
}

/// Builds it into this folder.
pub(crate) fn build_into(out: &Path) -> Result<(), String> {
    let work = root().join("target/web-build");
    let wasm = compile(&work)?;
    let glue = work.join("glue");
    bind(&wasm, &glue)?;

    let mut files = BTreeMap::new();
    for name in ["sheetwright.js", "sheetwright_bg.wasm"] {
        files.insert(name.to_owned(), read(&glue.join(name))?);
    }
    let size = files["sheetwright_bg.wasm"].len();
    let theme = text(&root().join("crates/editor/src/theme.rs"))?;
    let pages = root().join("crates/editor/web");
    for name in PAGE {
        let page = text(&pages.join(name))?.replace("{{wasm-bytes}}", &size.to_string());
        files.insert(name.to_owned(), coloured(&page, &theme)?.into_bytes());
    }
    files.insert("icon.svg".to_owned(), icon()?.into_bytes());
    let worker = service_worker(&text(&pages.join("sw.js"))?, &files);
    files.insert("sw.js".to_owned(), worker.into_bytes());
    write(out, &files)?;
    println!("{} ({:.1} MB of WebAssembly)", out.display(), size as f64 / 1e6);
    Ok(())
}

/// Compiles the crate; where the WebAssembly lies.
fn compile(work: &Path) -> Result<PathBuf, String> {
    let mut cargo = cargo()?;
    cargo.args(["build", "--package", CRATE, "--lib", "--target", TARGET, "--profile", "web"]);
    // A separate folder, so that this and other builds don't undo each other's work.
    cargo.arg("--target-dir").arg(work).current_dir(root());
    run(&mut cargo)?;
    Ok(work.join(TARGET).join("web").join(MADE))
}

/// A cargo that can compile for WebAssembly.
fn cargo() -> Result<Command, String> {
    if has_target(TARGET) {
        return Ok(Command::new("cargo"));
    }
    let debian = ["/usr/bin/cargo", "/usr/bin/rustc", "/usr/lib/rustlib/src/rust/library"];
    let linker = ["wasm-ld", "rust-lld"];
    let linker = linker.into_iter().find(|name| Path::new("/usr/bin").join(name).exists());
    if let (Some(linker), true) = (linker, debian.iter().all(|path| Path::new(path).exists())) {
        let mut cargo = Command::new(debian[0]);
        cargo.args(["-Z", "build-std=std,panic_abort"]);
        // Debian's is a stable compiler, which builds its standard library only when told to.
        cargo.env("RUSTC_BOOTSTRAP", "1").env("RUSTC", debian[1]);
        cargo.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", linker);
        return Ok(cargo);
    }
    Err(format!(
        "this Rust can't compile for the browser. Run `rustup target add {TARGET}`, or on Debian \
         `apt install rustc-web cargo-web rust-web-src lld`"
    ))
}

/// Writes the script that joins the WebAssembly to a page.
fn bind(wasm: &Path, glue: &Path) -> Result<(), String> {
    let mut bindgen = Bindgen::new();
    bindgen.input_path(wasm).out_name("sheetwright").typescript(false);
    let bound = bindgen.web(true).and_then(|bindgen| bindgen.generate(glue));
    bound.map_err(|error| format!("{}: {error:#}", wasm.display()))
}

/// The service worker, with the files that it keeps and their number.
fn service_worker(script: &str, files: &BTreeMap<String, Vec<u8>>) -> String {
    let version = files.iter().fold(0xcbf2_9ce4_8422_2325, |sum, (name, bytes)| {
        let all = name.bytes().chain([0]).chain(bytes.iter().copied());
        all.fold(sum, |sum: u64, b| (sum ^ u64::from(b)).wrapping_mul(0x0000_0100_0000_01b3))
    });
    // The page itself is asked for by its folder, too.
    let names: Vec<String> = std::iter::once("./")
        .chain(files.keys().map(String::as_str))
        .map(|n| format!("{n:?}"))
        .collect();
    script
        .replace("{{version}}", &format!("{version:016x}"))
        .replace("{{files}}", &format!("[{}]", names.join(", ")))
}

/// The text with `{{accent}}` and `{{dark-accent}}` as the theme has them.
fn coloured(page: &str, theme: &str) -> Result<String, String> {
    let mut parts = page.split("{{");
    let mut done = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (name, rest) = part.split_once("}}").ok_or("a `{{` of the page has no `}}`")?;
        done.push_str(&colour(theme, name)?);
        done.push_str(rest);
    }
    Ok(done)
}

/// A colour of the editor's theme, of the light look or, with `dark-` before it, the dark one.
fn colour(theme: &str, name: &str) -> Result<String, String> {
    let (look, field) = name.strip_prefix("dark-").map_or(("LIGHT", name), |field| ("DARK", field));
    theme
        .split_once(&format!("const {look}: Theme"))
        .and_then(|(_, rest)| rest.split_once(&format!(" {field}: ")))
        .and_then(|(_, rest)| rest.split_once("hex(0x"))
        .and_then(|(_, rest)| rest.get(..6))
        .filter(|digits| digits.bytes().all(|digit| digit.is_ascii_hexdigit()))
        .map(|digits| format!("#{digits}"))
        .ok_or_else(|| format!("the theme has no colour {name}"))
}

/// Writes the files, and removes other files of an earlier build.
fn write(out: &Path, files: &BTreeMap<String, Vec<u8>>) -> Result<(), String> {
    let failed = |path: &Path, error: std::io::Error| format!("{}: {error}", path.display());
    if out.join("sw.js").exists() {
        fs::remove_dir_all(out).map_err(|error| failed(out, error))?;
    }
    fs::create_dir_all(out).map_err(|error| failed(out, error))?;
    for (name, bytes) in files {
        let path = out.join(name);
        fs::write(&path, bytes).map_err(|error| failed(&path, error))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_has_the_colours_of_the_theme() {
        let theme = text(&root().join("crates/editor/src/theme.rs")).unwrap();
        for name in PAGE {
            let page = text(&root().join("crates/editor/web").join(name)).unwrap();
            let page = page.replace("{{wasm-bytes}}", "1");
            let done = coloured(&page, &theme).unwrap();
            assert!(!done.contains("{{"), "{name}");
        }
        assert_ne!(colour(&theme, "ground"), colour(&theme, "dark-ground"));
        assert!(colour(&theme, "no-such").is_err());
        let icon = icon().unwrap();
        assert!(icon.starts_with("<svg") && icon.ends_with("</svg>\n"), "{icon}");
    }

    #[test]
    fn another_content_is_another_version() {
        let files = |text: &str| BTreeMap::from([("a.js".to_owned(), text.as_bytes().to_vec())]);
        let script = "{{version}} {{files}}";
        let [a, b] = ["x", "y"].map(|text| service_worker(script, &files(text)));
        assert_ne!(a, b);
        assert!(a.ends_with(" [\"./\", \"a.js\"]"), "{a}");
    }
}
