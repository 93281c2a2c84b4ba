//! Comments are no longer than lines of code, and each names its subject.

use super::sources::{root, rust_files};

/// As `rustfmt.toml` has it for code.
const MOST_CHARACTERS: usize = 100;

/// The folders of the source.
const FOLDERS: [&str; 3] = ["crates", "fuzz/fuzz_targets", "xtask"];

/// The places of all comment lines for which `holds` is true.
fn comments(holds: impl Fn(&str, &str) -> bool) -> Vec<String> {
    let mut found = Vec::new();
    for path in FOLDERS.iter().flat_map(|folder| rust_files(&root().join(folder))) {
        let text = std::fs::read_to_string(&path).unwrap();
        for (n, line) in text.lines().enumerate() {
            let Some(comment) = line.trim_start().strip_prefix("//") else { continue };
            if holds(line, comment.trim_start_matches(['/', '!']).trim_start()) {
                let path = path.strip_prefix(root()).unwrap();
                found.push(format!("{}:{}: {}", path.display(), n + 1, line.trim()));
            }
        }
    }
    found
}

#[test]
fn comments_are_no_longer_than_code() {
    let long = comments(|line, _| line.chars().count() > MOST_CHARACTERS);
    assert!(long.is_empty(), "longer than {MOST_CHARACTERS} characters:\n{}", long.join("\n"));
}

#[test]
fn comments_name_what_they_are_about() {
    // The subject may stand on another page.
    let nameless = comments(|_, comment| comment.starts_with("The same"));
    assert!(nameless.is_empty(), "say what it is:\n{}", nameless.join("\n"));
}
