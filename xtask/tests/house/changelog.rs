//! Each entry of the changelog is one line that can be read at once.

use std::fs;
use std::path::Path;

/// The most characters of an entry.
const LONGEST: usize = 120;

#[test]
fn every_entry_of_the_changelog_is_one_line() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../CHANGELOG.md");
    let text = fs::read_to_string(path).unwrap();
    let entries = text.lines().filter(|line| line.starts_with("- ")).count();
    assert!(entries > 0);
    for line in text.lines() {
        assert!(!line.starts_with("  "), "an entry goes on: {line}");
        assert!(line.chars().count() <= LONGEST, "too long: {line}");
    }
}
