//! No circles of files: the files that a file uses do not lead back to it.
//!
//! The files of a folder are compared with one another: a file, the folder of its name and all
//! inside of that count as one; names that a file shares with the folder in which it lies are no
//! circle. Each `use` and each path through `crate::` or `super::` is an arrow, also where the
//! folder passes a name on from another file. Test modules are left out.
//!
//! The test fails at the first circle.

use super::sources::{root, rust_files};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const CRATES: [&str; 8] = [
    "crates/geometry",
    "crates/optimum",
    "crates/kernel",
    "crates/shapes",
    "crates/files",
    "crates/cli",
    "crates/editor",
    "xtask",
];

/// The way to a module: `["design", "varying"]`; that of the crate itself is empty.
type Way = Vec<String>;
/// A folder, and the files in it that lead to one another.
type Circle = (String, Vec<String>);

/// The modules of a crate with their texts.
struct Modules {
    texts: BTreeMap<Way, String>,
    /// The names that a module passes on from the files below it, and which file each is from.
    passed_on: BTreeMap<Way, BTreeMap<String, String>>,
}

impl Modules {
    fn new(texts: BTreeMap<Way, String>) -> Self {
        let mut modules = Self { texts, passed_on: BTreeMap::new() };
        let mut passed_on = BTreeMap::new();
        for (way, text) in &modules.texts {
            let mut names = BTreeMap::new();
            for path in used(text) {
                let parts = path.iter().map(|part| &part[..]);
                let path: Vec<&str> = parts.skip_while(|part| *part == "self").collect();
                if let [file, .., name] = path[..]
                    && modules.has_below(way, file)
                {
                    names.insert(name.to_owned(), file.to_owned());
                }
            }
            passed_on.insert(way.clone(), names);
        }
        modules.passed_on = passed_on;
        modules
    }

    fn of_crate(folder: &Path) -> Self {
        let mut texts = BTreeMap::new();
        for path in rust_files(folder) {
            let inside = path.strip_prefix(folder).unwrap().with_extension("");
            let mut way: Way =
                inside.components().map(|c| c.as_os_str().to_str().unwrap().to_owned()).collect();
            if ["mod", "lib", "main"].contains(&&way[way.len() - 1][..]) {
                way.pop();
            }
            if way.last().is_none_or(|name| name != "tests") {
                texts.insert(way, code(&std::fs::read_to_string(&path).unwrap()));
            }
        }
        Self::new(texts)
    }

    fn has_below(&self, way: &Way, name: &str) -> bool {
        self.texts.contains_key(&[&way[..], &[name.to_owned()]].concat())
    }

    /// The module that a path leads to from one module, as deep as it names modules.
    fn reached(&self, from: &Way, path: &[String]) -> Option<Way> {
        let mut path = path.iter().map(|s| &s[..]).peekable();
        let mut at = match path.peek().copied()? {
            "crate" => Way::new(),
            name if ["super", "self"].contains(&name) || self.has_below(from, name) => from.clone(),
            _ => return None,
        };
        path.next_if(|name| *name == "crate" || *name == "self");
        while path.next_if_eq(&"super").is_some() {
            at.pop();
        }
        for name in path {
            let known = self.passed_on.get(&at).and_then(|names| names.get(name));
            let next = if self.has_below(&at, name) { name } else { known? };
            at.push(next.to_owned());
            if known.is_some() && next != name {
                break;
            }
        }
        Some(at)
    }

    /// The arrows between files that stand side by side, by their folder.
    fn arrows(&self) -> BTreeMap<Way, BTreeSet<[String; 2]>> {
        let mut arrows: BTreeMap<Way, BTreeSet<[String; 2]>> = BTreeMap::new();
        for (from, text) in &self.texts {
            for path in used(text).into_iter().chain(named(text)) {
                let Some(to) = self.deepest(from, &path) else { continue };
                let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
                if let (Some(a), Some(b)) = (from.get(common), to.get(common)) {
                    let ends = [a.clone(), b.clone()];
                    arrows.entry(from[..common].to_vec()).or_default().insert(ends);
                }
            }
        }
        arrows
    }

    /// The module that a path reaches, or that the longest possible beginning of it reaches.
    fn deepest(&self, from: &Way, path: &[String]) -> Option<Way> {
        (1..=path.len()).rev().find_map(|n| self.reached(from, &path[..n]))
    }

    fn circles(&self, of: &str) -> Vec<Circle> {
        let mut circles = Vec::new();
        for (folder, arrows) in self.arrows() {
            let mut left: BTreeSet<&String> = arrows.iter().map(|[from, _]| from).collect();
            while let Some(first) = left.pop_first() {
                let leads_on = reachable(first, &arrows);
                let circle: Vec<String> = leads_on
                    .iter()
                    .filter(|name| reachable(name, &arrows).contains(first))
                    .map(|name| (*name).clone())
                    .collect();
                left.retain(|name| !circle.contains(name));
                if circle.len() > 1 {
                    circles.push(([&[of.to_owned()], &folder[..]].concat().join("/"), circle));
                }
            }
        }
        circles
    }
}

/// The files that arrows lead to from a file, in one or more steps.
fn reachable<'a>(from: &'a String, arrows: &'a BTreeSet<[String; 2]>) -> BTreeSet<&'a String> {
    let mut found = BTreeSet::new();
    let mut waiting = vec![from];
    while let Some(at) = waiting.pop() {
        for [_, to] in arrows.iter().filter(|[from, _]| from == at) {
            if found.insert(to) {
                waiting.push(to);
            }
        }
    }
    found
}

/// A text without its comments and its tests.
fn code(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod tests").next().unwrap();
    text.lines().map(|line| line.split("//").next().unwrap()).collect::<Vec<_>>().join("\n")
}

/// The paths of all `use` lines, by their parts.
fn used(text: &str) -> Vec<Vec<String>> {
    let mut paths = Vec::new();
    for part in format!("\n{text}").split("use ").collect::<Vec<_>>().windows(2) {
        let is_word = part[0].ends_with(|c: char| c.is_alphanumeric() || c == '_');
        if !is_word && let Some((tree, _)) = part[1].split_once(';') {
            expand(tree, "", &mut paths);
        }
    }
    paths
}

/// The paths of a tree such as `a::{b, c::{d, e as f}}`.
fn expand(tree: &str, before: &str, paths: &mut Vec<Vec<String>>) {
    let Some((start, rest)) = tree.split_once('{') else {
        let name = tree.split(" as ").next().unwrap();
        let path = format!("{before}{name}");
        paths.push(path.split("::").map(|part| part.trim().to_owned()).collect());
        return;
    };
    let (inner, _) = rest.rsplit_once('}').unwrap_or((rest, ""));
    let mut depth = 0;
    let parts = inner.split(|c: char| {
        depth += i32::from(c == '{') - i32::from(c == '}');
        c == ',' && depth == 0
    });
    for part in parts.filter(|part| !part.trim().is_empty()) {
        expand(part, &format!("{before}{}", start.trim()), paths);
    }
}

/// The paths that begin with `crate::` or `super::` wherever they stand.
fn named(text: &str) -> Vec<Vec<String>> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let words = text.split(|c: char| !is_part(c));
    let paths = words.filter(|word| ["crate::", "super::"].iter().any(|s| word.starts_with(s)));
    let parts = |path: &str| {
        path.split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect::<Vec<String>>()
    };
    paths.map(parts).collect()
}

#[test]
fn files_run_in_no_circle() {
    let root = root();
    let of_crate = |of: &&str| Modules::of_crate(&root.join(of).join("src")).circles(of);
    let found: Vec<Circle> = CRATES.iter().flat_map(of_crate).collect();
    assert!(found.is_empty(), "files that lead back to one another: {found:#?}");
}

#[test]
fn circles_are_found_however_a_name_comes() {
    let circles = |files: &[(&str, &str)]| {
        let texts = files.iter().map(|(way, text)| {
            let way = way.split('/').filter(|part| !part.is_empty()).map(str::to_owned).collect();
            (way, code(text))
        });
        Modules::new(texts.collect()).circles("c")
    };
    let of = |folder: &str, files: [&str; 2]| {
        vec![(folder.to_owned(), files.map(str::to_owned).to_vec())]
    };
    let straight = [("", "mod a;\nmod b;"), ("a", "use crate::b::{X, y::Z};"), ("b", "struct X;")];
    assert_eq!(circles(&straight), []);
    let by_path = [straight[0], straight[1], ("b", "fn f() -> super::a::A { a() }")];
    assert_eq!(circles(&by_path), of("c", ["a", "b"]));
    // `b` uses a name of `a` that the crate passes on.
    let passed_on =
        [("", "mod a;\nmod b;\npub use a::{A, f as g};"), straight[1], ("b", "use crate::A;")];
    assert_eq!(circles(&passed_on), of("c", ["a", "b"]));
    // Arrows from inside of a folder count for it; those to its own files do not.
    let inside =
        [("", ""), ("a", "use super::b::B;\nmod in;"), ("a/in", "use super::A;"), ("b", "")];
    assert_eq!(circles(&inside), []);
    let through = [inside[0], inside[1], inside[2], ("b", "use crate::a::in::I;")];
    assert_eq!(circles(&through), of("c", ["a", "b"]));
    let siblings = [("m", "mod a;\nmod b;"), ("m/a", "use super::b;"), ("m/b", "use super::a::A;")];
    assert_eq!(circles(&siblings), of("c/m", ["a", "b"]));
    let in_comment = [("", ""), ("a", "use crate::b::B;"), ("b", "// use crate::a::A;")];
    assert_eq!(circles(&in_comment), []);
}
