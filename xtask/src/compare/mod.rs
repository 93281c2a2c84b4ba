//! Two folders of outputs compared file by file: how a change of the code has changed outputs.
//!
//! - `report.json`: the numbers, truth values and codes, value by value. Sentences may change.
//! - Drawings (SVG, DXF, PDF): byte by byte, and where bytes differ, whether their lines do.
//! - Pages, texts and times may change and are only counted.
//! - All other files, as surfaces, tables and statuses: byte by byte.
//!
//! With `--bytes` nothing may differ but times: for two builds of one code. Then each file that
//! differs is named with the place where it first does (`bytes`).

mod bytes;
mod drawing;
mod leaves;

use leaves::{Leaf, leaves};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

const HELP: &str = "`cargo xtask compare` takes BEFORE AFTER, the folders of two runs of `cargo xtask \
                    outputs`, and, for what is meant to change, `--added-keys` (new values of reports \
                    are listed as added) and `--same-drawings` (a drawing may be written another \
                    way); or `--bytes`: nothing but times may differ";
/// So many differences of one report are listed.
const SHOWN: usize = 12;
/// The keys of sentences in a report.
const SENTENCES: [&str; 2] = ["text", "where"];

/// The changes that are intended.
#[derive(Clone, Copy, Debug, Default)]
struct Allowed {
    added_keys: bool,
    same_drawings: bool,
    /// Nothing else, and of the rest times alone.
    only_times: bool,
}

/// The differences of two folders.
#[derive(Debug, Default)]
struct Compared {
    files: usize,
    /// A line each.
    differences: Vec<String>,
    /// New values of reports: their paths without the numbers of lists, and how many there are.
    added: BTreeMap<String, usize>,
    /// Drawings with equal lines that are written another way.
    redrawn: usize,
    /// Pages, texts and times that differ.
    texts: usize,
    /// Sentences of reports that differ.
    sentences: usize,
}

/// Compares the folders that the arguments name and prints what differs.
pub(crate) fn run() -> Result<(), String> {
    let mut allowed = Allowed::default();
    let mut folders = Vec::new();
    for argument in std::env::args().skip(2) {
        match &argument[..] {
            "--added-keys" => allowed.added_keys = true,
            "--same-drawings" => allowed.same_drawings = true,
            "--bytes" => allowed.only_times = true,
            flag if flag.starts_with('-') => return Err(HELP.to_owned()),
            folder => folders.push(PathBuf::from(folder)),
        }
    }
    let [before, after] = &folders[..] else { return Err(HELP.to_owned()) };
    let compared = compare(before, after, allowed)?;
    print!("{}", told(&compared));
    match compared.differences.len() {
        0 => Ok(()),
        count => Err(format!("{count} differences")),
    }
}

fn compare(before: &Path, after: &Path, allowed: Allowed) -> Result<Compared, String> {
    let mut compared = Compared::default();
    let lists = [files(before)?, files(after)?];
    for name in lists[0].union(&lists[1]) {
        compared.files += 1;
        match lists.each_ref().map(|list| list.contains(name)) {
            [true, false] => compared.differences.push(format!("missing  {name}")),
            [false, true] => compared.differences.push(format!("new      {name}")),
            _ => {
                let read = |folder: &Path| {
                    fs::read(folder.join(name)).map_err(|error| format!("{name}: {error}"))
                };
                compare_file(name, [&read(before)?, &read(after)?], allowed, &mut compared);
            }
        }
    }
    Ok(compared)
}

/// The names of all files below a folder.
fn files(folder: &Path) -> Result<BTreeSet<String>, String> {
    let mut found = BTreeSet::new();
    let mut waiting = vec![folder.to_owned()];
    while let Some(inner) = waiting.pop() {
        let failed = |error: std::io::Error| format!("{}: {error}", inner.display());
        for entry in fs::read_dir(&inner).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            if path.is_dir() {
                waiting.push(path);
            } else if let Ok(name) = path.strip_prefix(folder) {
                found.insert(name.to_string_lossy().replace('\\', "/"));
            }
        }
    }
    Ok(found)
}

fn compare_file(name: &str, both: [&Vec<u8>; 2], allowed: Allowed, compared: &mut Compared) {
    let [before, after] = both;
    if before == after {
        return;
    }
    let last = name.rsplit('/').next().unwrap_or(name);
    let is_text = [".html", ".txt"].iter().any(|ending| last.ends_with(ending));
    if last == "timing.json" {
        compared.texts += 1;
    } else if allowed.only_times {
        let place = bytes::first_difference(before, after);
        compared.differences.push(format!("bytes    {name}: {place}"));
    } else if is_text {
        compared.texts += 1;
    } else if last == "report.json" {
        compare_reports(name, both, allowed, compared);
    } else if [".svg", ".dxf", ".pdf"].iter().any(|ending| last.ends_with(ending)) {
        let [before, after] = both.map(|bytes| drawing::shown(last, bytes));
        let is_redrawn = before.is_some() && before == after;
        compared.redrawn += usize::from(is_redrawn);
        if !is_redrawn {
            compared.differences.push(format!("drawing  {name}"));
        } else if !allowed.same_drawings {
            compared.differences.push(format!("written  {name} shows the same"));
        }
    } else {
        compared.differences.push(format!("bytes    {name}"));
    }
}

fn compare_reports(name: &str, both: [&Vec<u8>; 2], allowed: Allowed, compared: &mut Compared) {
    let read = both.map(|bytes| leaves(&String::from_utf8_lossy(bytes)));
    let [Ok(before), Ok(after)] = read else {
        compared.differences.push(format!("report   {name} can't be read"));
        return;
    };
    let [before, after] = [before, after].map(|list| list.into_iter().collect::<BTreeMap<_, _>>());
    let mut differences = Vec::new();
    for (path, was) in &before {
        let Some(is) = after.get(path) else {
            differences.push(format!("{path} is gone; it was {}", written(was)));
            continue;
        };
        if is_same(was, is) {
            continue;
        }
        if is_sentence(path) {
            compared.sentences += 1;
        } else {
            differences.push(format!("{path} was {} and is {}", written(was), written(is)));
        }
    }
    for (path, is) in after.iter().filter(|(path, _)| !before.contains_key(*path)) {
        if allowed.added_keys {
            *compared.added.entry(without_numbers(path)).or_default() += 1;
        } else {
            differences.push(format!("{path} is added: {}", written(is)));
        }
    }
    let more = differences.len().saturating_sub(SHOWN);
    differences.truncate(SHOWN);
    let lines = differences.into_iter().map(|what| format!("report   {name}: {what}"));
    compared.differences.extend(lines);
    if more > 0 {
        compared.differences.push(format!("report   {name}: and {more} more"));
    }
}

/// Whether two values are equal: numbers to the last bit, however they are written.
fn is_same(a: &Leaf, b: &Leaf) -> bool {
    let number = |leaf: &Leaf| match leaf {
        Leaf::Token(token) => token.parse::<f64>().ok().map(f64::to_bits),
        Leaf::Text(_) => None,
    };
    a == b || number(a).is_some_and(|bits| number(b) == Some(bits))
}

fn written(leaf: &Leaf) -> &str {
    match leaf {
        Leaf::Token(written) | Leaf::Text(written) => written,
    }
}

fn is_sentence(path: &str) -> bool {
    SENTENCES.contains(&path.rsplit('.').next().unwrap_or(path))
}

/// A path without the numbers of lists: `panels[].edges[].name`.
fn without_numbers(path: &str) -> String {
    let mut parts = path.split('[');
    let mut short = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        short.push('[');
        short.push_str(part.trim_start_matches(|c: char| c.is_ascii_digit()));
    }
    short
}

fn told(compared: &Compared) -> String {
    let mut text = String::new();
    for line in &compared.differences {
        let _ = writeln!(text, "{line}");
    }
    for (path, count) in &compared.added {
        let _ = writeln!(text, "added    {path}: {count} values");
    }
    let Compared { files, redrawn, texts, sentences, .. } = compared;
    let _ = writeln!(
        text,
        "{files} files; {} differences. Of what may change, {texts} pages, texts and times differ, \
         and {sentences} sentences of reports; {redrawn} drawings show the same, written another way.",
        compared.differences.len()
    );
    text
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests panic

    use super::*;

    const REPORT: &str = r#"{"panels": [{"name": "a", "warp": 1.0, "findings": [{"code": "folds",
        "text": "It folds.", "where": "rung 1"}]}]}"#;

    /// A folder with these files, by their names.
    fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        folder
    }

    fn compared(before: &[(&str, &str)], after: &[(&str, &str)], allowed: Allowed) -> Compared {
        compare(folder(before).path(), folder(after).path(), allowed).unwrap()
    }

    #[test]
    fn what_may_change_is_counted_and_what_may_not_is_named() {
        let before = [
            ("leaf/status", "0"),
            ("leaf/stdout.txt", "bends"),
            ("leaf/files/report.html", "<p>bends"),
            ("leaf/files/timing.json", "{\"total\": 1}"),
            ("leaf/files/surface.obj", "v 0 0 0"),
            ("leaf/files/gone.csv", "x"),
        ];
        let same = compared(&before, &before, Allowed::default());
        assert_eq!((same.files, same.differences.len(), same.texts), (6, 0, 0));
        let after = [
            ("leaf/status", "1"),
            ("leaf/stdout.txt", "bends well"),
            ("leaf/files/report.html", "<p>bends well"),
            ("leaf/files/timing.json", "{\"total\": 2}"),
            ("leaf/files/surface.obj", "v 0 0 1"),
            ("leaf/files/more.csv", "x"),
        ];
        let found = compared(&before, &after, Allowed::default());
        assert_eq!(found.texts, 3);
        let expected = [
            "missing  leaf/files/gone.csv",
            "new      leaf/files/more.csv",
            "bytes    leaf/files/surface.obj",
            "bytes    leaf/status",
        ];
        assert_eq!(found.differences, expected);
        assert!(told(&found).ends_with("written another way.\n"));
    }

    #[test]
    fn of_two_builds_nothing_differs_but_times() {
        let files =
            |page, total| [("leaf/files/report.html", page), ("leaf/files/timing.json", total)];
        let allowed = Allowed { only_times: true, ..Allowed::default() };
        let found = compared(&files("<p>1.0\n<p>2", "1"), &files("<p>1.0\n<p>3", "2"), allowed);
        let place = "line 2, byte 10: \"<p>2\" and \"<p>3\"";
        assert_eq!(found.differences, [format!("bytes    leaf/files/report.html: {place}")]);
        assert_eq!(found.texts, 1);
    }

    #[test]
    fn numbers_of_reports_are_compared_to_the_last_bit_and_sentences_are_not() {
        let report = |changed: [&str; 2]| {
            let text = REPORT.replace(changed[0], changed[1]);
            let found = compared(&[("report.json", REPORT)], &[("report.json", &text)], {
                Allowed::default()
            });
            (found.differences, found.sentences)
        };
        assert_eq!(report(["1.0", "1"]), (vec![], 0));
        assert_eq!(report(["It folds.", "It has folds."]), (vec![], 1));
        let differs = |what: &str| (vec![format!("report   report.json: {what}")], 0);
        let last_bit = differs("panels[0].warp was 1.0 and is 1.0000000000000002");
        assert_eq!(report(["1.0", "1.0000000000000002"]), last_bit);
        let code = differs("panels[0].findings[0].code was folds and is fold");
        assert_eq!(report(["\"folds\"", "\"fold\""]), code);
        let null = differs("panels[0].warp was 1.0 and is null");
        assert_eq!(report(["1.0", "null"]), null);
        assert_eq!(report(["{", "["]), differs_unread());
    }

    fn differs_unread() -> (Vec<String>, usize) {
        (vec!["report   report.json can't be read".to_owned()], 0)
    }

    #[test]
    fn stated_changes_are_listed_and_no_differences() {
        let edges = REPORT.replace("\"warp\"", "\"edges\": [{\"mm\": 1}, {\"mm\": 2}], \"warp\"");
        let svg = |note: &str| format!("<svg width=\"1mm\"><!--{note}--><path d=\"M0,0\"/></svg>");
        let before = [("report.json", REPORT), ("a.svg", &svg("one"))];
        let after = [("report.json", &edges[..]), ("a.svg", &svg("two"))];
        let strict = compared(&before, &after, Allowed::default());
        assert_eq!(strict.differences.len(), 3, "{:?}", strict.differences);
        let allowed = Allowed { added_keys: true, same_drawings: true, only_times: false };
        let found = compared(&before, &after, allowed);
        assert_eq!((found.differences.len(), found.redrawn), (0, 1));
        assert_eq!(found.added, BTreeMap::from([("panels[].edges[].mm".to_owned(), 2)]));
        // What is gone is a difference, whatever is allowed.
        assert_eq!(compared(&after, &before, allowed).differences.len(), 2);
    }
}
