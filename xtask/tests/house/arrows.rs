//! The arrows of the house: which crate may use which, and in the crates that compute, which
//! module.
//!
//! Read off the Cargo files and the `use` lines; a wrong arrow fails here, with its line.

use super::sources::{root, rust_files};
use std::collections::BTreeMap;
use std::path::Path;

/// What each crate may depend on inside the workspace.
const CRATES: [(&str, &[&str]); 9] = [
    ("crates/geometry", &[]),
    ("crates/optimum", &["sheetwright-geometry"]),
    ("crates/kernel", &["sheetwright-geometry", "sheetwright-optimum"]),
    ("crates/shapes", &["sheetwright"]),
    ("crates/files", &["sheetwright"]),
    ("crates/cli", &["sheetwright", "sheetwright-files"]),
    ("crates/editor", &["sheetwright", "sheetwright-files"]),
    ("crates/python", &["sheetwright", "sheetwright-files"]),
    ("xtask", &["sheetwright", "sheetwright-files", "sheetwright-shapes"]),
];

/// Crates that only one crate of ours may name: file formats, the command line, windows.
const OWNERS: [(&str, &str); 20] = [
    ("faer", "crates/geometry"),
    ("glam", "crates/geometry"),
    ("libm", "crates/geometry"),
    ("robust", "crates/geometry"),
    ("pulp", "crates/optimum"),
    ("rayon", "crates/optimum"),
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
    ("numpy", "crates/python"),
    ("pyo3", "crates/python"),
];

/// The crates that compute and nothing else, each above those that it uses.
const PURE: [&str; 3] = ["crates/geometry", "crates/optimum", "crates/kernel"];

/// Files of the pure crates that alone may name these crates.
const FILE_OWNERS: [(&str, &[&str]); 7] = [
    ("faer::", &["math/sparse.rs"]),
    ("glam::", &["math.rs"]),
    ("libm::", &["math.rs"]),
    ("robust::", &["predicate.rs"]),
    (
        "pulp::",
        &[
            "rung/visible/at_ends.rs",
            "triangulate/optimal/pruning/completion_bound.rs",
            "triangulate/optimal/pruning/completion_bound/abstraction.rs",
            "triangulate/optimal/pruning/completion_bound/cells.rs",
            "triangulate/optimal/pruning/completion_bound/pricing.rs",
            "triangulate/optimal/pruning/completion_bound/tests.rs",
            "triangulate/optimal/table.rs",
            "triangulate/optimal/table/filling.rs",
            "triangulate/optimal/table/tests.rs",
        ],
    ),
    ("rayon::", &["triangulate/optimal/threads.rs", "triangulate/optimal/table/tests.rs"]),
    ("spade::", &["rung/visible/expansion.rs", "elastic/net.rs"]),
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

/// The order of a crate's modules is that of the `pub mod` lines of its front door.
fn order_of_modules(source: &Path) -> BTreeMap<String, usize> {
    let door = std::fs::read_to_string(source.join("lib.rs")).unwrap();
    let names = door.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';'));
    names.enumerate().map(|(n, name)| (name.to_owned(), n)).collect()
}

#[test]
fn modules_of_pure_crates_use_only_those_above_them() {
    let mut arrows = 0;
    for source in PURE.map(|folder| root().join(folder).join("src")) {
        let order = order_of_modules(&source);
        assert!(order.len() >= 3, "{order:?}");
        for path in rust_files(&source) {
            let inside = path.strip_prefix(&source).unwrap();
            let first = inside.components().next().unwrap().as_os_str().to_str().unwrap();
            let module = first.trim_end_matches(".rs");
            if module != "lib" {
                let text = std::fs::read_to_string(&path).unwrap();
                arrows += check_arrows(inside, &text, module, &order);
            }
        }
    }
    assert!(arrows > 50, "{arrows}");
}

/// Checks the paths of a file of a module, and returns how many lead to modules of its crate.
fn check_arrows(inside: &Path, text: &str, module: &str, order: &BTreeMap<String, usize>) -> usize {
    let mut arrows = 0;
    for (n, line) in text.lines().enumerate() {
        if line.trim_start().starts_with("//") {
            continue;
        }
        let place = format!("{}:{}", inside.display(), n + 1);
        let whole = format!("{place}: one path a `use` of the crate, so that arrows can be read");
        assert!(!line.contains("crate::{"), "{whole}");
        for part in line.split("crate::").skip(1) {
            let end = part.find(|c: char| !c.is_alphanumeric() && c != '_');
            let used = &part[..end.unwrap_or(part.len())];
            let Some(there) = order.get(used) else { continue };
            let comes_before = *there <= order[module];
            assert!(comes_before, "{place}: {module} may not use {used}, which comes after it");
            arrows += 1;
        }
        for (name, owners) in FILE_OWNERS {
            let owned = !line.contains(name) || owners.iter().any(|o| inside == Path::new(o));
            assert!(owned, "{place}: only {owners:?} may name {name}");
        }
    }
    arrows
}

/// What must stay absent from the crates that compute: threads but in the one file that judges
/// parts with them, where the feature `rayon` is on.
#[test]
fn pure_crates_keep_to_themselves() {
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
    let sources = PURE.map(|folder| root().join(folder).join("src"));
    for path in sources.iter().flat_map(|source| rust_files(source)) {
        let text = std::fs::read_to_string(&path).unwrap();
        let code = text.split("#[cfg(test)]").next().unwrap();
        let has_threads = path.ends_with("make/together.rs");
        for line in code.lines().filter(|line| !line.trim_start().starts_with("//")) {
            for (word, reason) in absent {
                if has_threads && word.starts_with("thread::") {
                    continue;
                }
                assert!(!line.contains(word), "{}: a pure crate {reason}: {line}", path.display());
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
