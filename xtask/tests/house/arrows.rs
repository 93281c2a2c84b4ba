//! The arrows of the house: which crate and which kernel module may use which.
//!
//! Read off the Cargo files and the `use` lines; a wrong arrow fails here, with its line.

use super::sources::{root, rust_files};
use std::collections::BTreeMap;
use std::path::Path;

/// What each crate may depend on inside the workspace.
const CRATES: [(&str, &[&str]); 6] = [
    ("crates/kernel", &[]),
    ("crates/shapes", &["sheetwright"]),
    ("crates/files", &["sheetwright"]),
    ("crates/cli", &["sheetwright", "sheetwright-files"]),
    ("crates/editor", &["sheetwright", "sheetwright-files"]),
    ("xtask", &["sheetwright", "sheetwright-files", "sheetwright-shapes"]),
];

/// Crates that only one crate of ours may name: file formats, the command line, windows.
const OWNERS: [(&str, &str); 15] = [
    ("faer", "crates/kernel"),
    ("glam", "crates/kernel"),
    ("robust", "crates/kernel"),
    ("serde", "crates/files"),
    ("serde_json", "crates/files"),
    ("csv", "crates/files"),
    ("dxf", "crates/files"),
    ("pdf-writer", "crates/files"),
    ("roxmltree", "crates/files"),
    ("clap", "crates/cli"),
    ("indicatif", "crates/cli"),
    ("eframe", "crates/editor"),
    ("image", "crates/editor"),
    ("rfd", "crates/editor"),
    ("wasm-bindgen", "crates/editor"),
];

/// Files of the kernel that alone may name these crates.
const FILE_OWNERS: [(&str, &[&str]); 6] = [
    ("faer::", &["math/sparse.rs"]),
    ("glam::", &["math.rs"]),
    ("libm::", &["math.rs"]),
    ("robust::", &["predicate.rs"]),
    (
        "pulp::",
        &[
            "cost/specials.rs",
            "rung/visible/at_ends.rs",
            "triangulate/optimal/lanes.rs",
            "triangulate/optimal/outside.rs",
            "triangulate/optimal/outside/afar.rs",
            "triangulate/optimal/outside/cells.rs",
            "triangulate/optimal/outside/pricing.rs",
            "triangulate/optimal/outside/tests.rs",
            "triangulate/optimal/table.rs",
            "triangulate/optimal/table/filling.rs",
            "triangulate/optimal/table/tests.rs",
            "triangulate/sparse/listed.rs",
            "triangulate/sparse/table.rs",
        ],
    ),
    ("rayon::", &["triangulate/optimal/threads.rs", "triangulate/optimal/table/tests.rs"]),
];

/// The dependencies under a `[section]` of a Cargo file.
fn dependencies(manifest: &Path, section: &str) -> Vec<String> {
    let text = std::fs::read_to_string(manifest).unwrap();
    let mut inside = false;
    let mut found = Vec::new();
    for line in text.lines().map(str::trim) {
        if line.starts_with('[') {
            let hidden = line.starts_with("[dependencies.");
            assert!(!hidden, "{}: {line} hides dependencies from this test", manifest.display());
            // Those of one platform alone, `[target.'cfg(…)'.dependencies]`, count as any.
            inside = line == format!("[{section}]")
                || line.starts_with("[target.") && line.ends_with(&format!(".{section}]"));
        } else if inside && !line.is_empty() && !line.starts_with('#') {
            let name = line.split(['=', '.']).next().unwrap().trim();
            found.push(name.to_owned());
        }
    }
    found
}

#[test]
fn crates_use_only_what_lies_below_them() {
    let mut members = Vec::new();
    for (folder, allowed) in CRATES {
        members.push(folder);
        for name in dependencies(&root().join(folder).join("Cargo.toml"), "dependencies") {
            let ours = name.starts_with("sheetwright") || name == "xtask";
            assert!(!ours || allowed.contains(&name.as_str()), "{folder} may not use {name}");
            if let Some((_, owner)) = OWNERS.iter().find(|(of, _)| *of == name) {
                assert_eq!(*owner, folder, "{name} belongs to {owner}");
            }
        }
    }
    let workspace = std::fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let listed = workspace.lines().find(|l| l.starts_with("members")).unwrap().to_owned();
    let listed: Vec<&str> = listed.split('"').skip(1).step_by(2).collect();
    let mut sorted = (listed.clone(), members.clone());
    sorted.0.sort_unstable();
    sorted.1.sort_unstable();
    assert_eq!(sorted.0, sorted.1, "every member of the workspace has its arrows here");
    assert!(workspace.contains("default-members = [\"crates/cli\"]"));
}

/// The order of the kernel's modules is that of the `pub mod` lines of its front door.
#[test]
fn kernel_modules_use_only_those_above_them() {
    let source = root().join("crates/kernel/src");
    let door = std::fs::read_to_string(source.join("lib.rs")).unwrap();
    let order: BTreeMap<&str, usize> = door
        .lines()
        .filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';'))
        .enumerate()
        .map(|(n, name)| (name, n))
        .collect();
    assert!(order.len() > 15, "{order:?}");
    let mut arrows = 0;
    for path in rust_files(&source) {
        let inside = path.strip_prefix(&source).unwrap();
        let first = inside.components().next().unwrap().as_os_str().to_str().unwrap();
        let module = first.trim_end_matches(".rs");
        if module == "lib" {
            continue;
        }
        let here = order[module];
        let text = std::fs::read_to_string(&path).unwrap();
        for (n, line) in text.lines().enumerate() {
            if line.trim_start().starts_with("//") {
                continue;
            }
            let whole = format!("{}:{}: one path a `use` of the crate", inside.display(), n + 1);
            assert!(!line.contains("crate::{"), "{whole}, so that arrows can be read");
            for part in line.split("crate::").skip(1) {
                let end = part.find(|c: char| !c.is_alphanumeric() && c != '_');
                let used = &part[..end.unwrap_or(part.len())];
                let Some(&there) = order.get(used) else { continue };
                assert!(
                    there <= here,
                    "{}:{}: {module} may not use {used}, which comes after it",
                    inside.display(),
                    n + 1
                );
                arrows += 1;
            }
            for (name, owners) in FILE_OWNERS {
                let owned = !line.contains(name) || owners.iter().any(|o| inside == Path::new(o));
                assert!(owned, "{}:{}: only {owners:?} may name {name}", inside.display(), n + 1);
            }
        }
    }
    assert!(arrows > 50, "{arrows}");
}

/// What must stay absent from the kernel.
#[test]
fn the_kernel_keeps_to_itself() {
    let source = root().join("crates/kernel/src");
    let absent = [
        ("std::fs", "opens no file"),
        ("std::time", "reads no clock"),
        ("thread::spawn", "starts no thread"),
        ("thread::scope", "starts no thread"),
        ("thread::Builder", "starts no thread"),
        ("std::env", "reads no environment"),
        ("println!", "prints nothing"),
        ("HashMap", "has no order that changes from run to run"),
        ("serde", "has no type of a file"),
        ("unsafe {", "has no unsafe code"),
    ];
    for path in rust_files(&source) {
        let text = std::fs::read_to_string(&path).unwrap();
        let code = text.split("#[cfg(test)]").next().unwrap();
        for line in code.lines().filter(|line| !line.trim_start().starts_with("//")) {
            for (word, reason) in absent {
                assert!(!line.contains(word), "{}: the kernel {reason}: {line}", path.display());
            }
        }
    }
}

#[test]
fn no_drawer_without_a_name() {
    for (folder, _) in CRATES {
        for path in rust_files(&root().join(folder)) {
            let name = path.file_stem().unwrap().to_str().unwrap();
            let drawer = ["util", "utils", "common", "helper", "helpers", "misc"].contains(&name);
            assert!(!drawer, "{}", path.display());
        }
    }
}
