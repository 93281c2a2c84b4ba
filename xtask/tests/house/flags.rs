//! The command alone names its options: the crates below it also serve the editor and pages, and
//! name remedies in plain words.

use super::sources::{root, rust_files};

/// The crates below the command.
const BELOW: [&str; 3] = ["kernel", "files", "shapes"];

/// The options that a line of code names, in a text: a word after two hyphens that is no property
/// of a style sheet, `var(--ink)` or `--ink:`.
fn options(line: &str) -> Vec<&str> {
    let code = line.split(" // ").next().unwrap_or_default();
    if code.trim_start().starts_with("//") {
        return Vec::new();
    }
    let named = code.match_indices("--").filter_map(|(at, _)| {
        let (before, word) = (&code[..at], &code[at + 2..]);
        let length = word.find(|c: char| !c.is_ascii_lowercase() && c != '-').unwrap_or(word.len());
        let is_word = word.starts_with(|c: char| c.is_ascii_lowercase())
            && !before.ends_with(|c: char| c.is_alphanumeric() || c == '-');
        let is_property = before.ends_with("var(") || word[length..].starts_with(':');
        (is_word && !is_property).then(|| &code[at..at + 2 + length])
    });
    named.collect()
}

#[test]
fn nothing_below_the_command_names_its_options() {
    let mut found = Vec::new();
    for krate in BELOW {
        for path in rust_files(&root().join("crates").join(krate).join("src")) {
            let text = std::fs::read_to_string(&path).unwrap();
            for (n, line) in text.lines().enumerate() {
                for option in options(line) {
                    let path = path.strip_prefix(root()).unwrap();
                    found.push(format!("{}:{}: {option}", path.display(), n + 1));
                }
            }
        }
    }
    assert!(
        found.is_empty(),
        "name these in crates/cli/src/remedies.rs instead:\n{}",
        found.join("\n")
    );
}

#[test]
fn options_are_told_from_styles_and_comments() {
    for (line, named) in [
        ("\"divide it (--split-creases 30)\"", &["--split-creases"][..]),
        ("format!(\"`--set {name}` or --report\\n\")", &["--set", "--report"]),
        ("\".pic{--ink:#16202a;fill:var(--paper)}\"", &[]),
        ("\"<!-- a picture -->\" // --units", &[]),
        ("/// As `--units` has it.", &[]),
    ] {
        assert_eq!(options(line), named, "{line}");
    }
}
