//! Every broken input of corpus/bad is refused in the words beside it, and nothing is written.

#![allow(clippy::unwrap_used, reason = "a test that can't go on fails")]

use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Address space that is enough to refuse anything, KiB.
const ENOUGH_KIB: u64 = 1 << 20;

/// An input and how it is handed over.
struct Case {
    name: String,
    /// The folder that the command runs in.
    folder: PathBuf,
    input: String,
    args: Vec<String>,
}

fn corpus() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../corpus/bad")
}

fn run(case: &Case, out: &Path) -> Output {
    let program = env!("CARGO_BIN_EXE_sheetwright");
    let mut command = if cfg!(target_os = "linux") {
        let mut shell = Command::new("sh");
        let limited = format!("ulimit -v {ENOUGH_KIB}; exec \"$0\" \"$@\"");
        shell.arg("-c").arg(limited).arg(program);
        shell
    } else {
        Command::new(program)
    };
    command.current_dir(&case.folder);
    if case.input.ends_with(".new") {
        command.arg("new").arg("--out").arg(out);
    } else {
        command.arg("make").arg(&case.input).arg("--out").arg(out);
    }
    command.args(&case.args).stdin(Stdio::null()).output().unwrap()
}

/// The cases of the corpus, in the order of their names. What is generated lies in `scratch`.
fn cases(scratch: &Path) -> Vec<Case> {
    let mut files: Vec<String> = fs::read_dir(corpus())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|file| {
            let beside = [".expected", ".args", ".md", ".gitattributes"];
            !beside.iter().any(|ending| file.ends_with(ending))
        })
        .collect();
    files.sort();
    files.into_iter().filter_map(|file| case(file, scratch)).collect()
}

fn case(file: String, scratch: &Path) -> Option<Case> {
    let name = file.trim_end_matches(".sheet.json");
    let name = name.rsplit_once('.').map_or(name, |(stem, _)| stem).to_owned();
    let args = fs::read_to_string(corpus().join(format!("{name}.args"))).unwrap_or_default();
    let args = args.split_whitespace().map(str::to_owned).collect();
    if file.ends_with(".new") {
        let args = fs::read_to_string(corpus().join(&file)).unwrap();
        let args = args.lines().map(str::to_owned).collect();
        return Some(Case { name, folder: corpus(), input: file, args });
    }
    let (folder, input) = if file.ends_with(".generate") {
        let recipe = fs::read_to_string(corpus().join(&file)).unwrap();
        let folder = scratch.join(&name);
        fs::create_dir(&folder).unwrap();
        let input = generated(&recipe, &folder)?;
        (folder, input)
    } else {
        (corpus(), file)
    };
    Some(Case { name, folder, input, args })
}

/// Makes what a recipe describes; the name of the input, or none where this system can't have it.
fn generated(recipe: &str, folder: &Path) -> Option<String> {
    let words: Vec<&str> = recipe.split_whitespace().collect();
    let count = |word: &str| word.parse::<usize>().unwrap();
    let input = words[words.len() - 1];
    let path = folder.join(input);
    match words[..] {
        ["folder", _] => fs::create_dir(&path).unwrap(),
        ["missing", _] => {}
        ["rows", rows, _] => {
            let mut file = std::io::BufWriter::new(fs::File::create(&path).unwrap());
            writeln!(file, "x,y,z").unwrap();
            for row in 0..count(rows) {
                writeln!(file, "{row},0,0").unwrap();
            }
        }
        ["loops", loops, _] => {
            let mut file = std::io::BufWriter::new(fs::File::create(&path).unwrap());
            writeln!(file, "curve,x,y,z,corner").unwrap();
            for n in 0..count(loops) {
                for (x, y) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
                    writeln!(file, "c{n},{},{y},0,1", 2 * n + x).unwrap();
                }
            }
        }
        ["points", points, _] => {
            let mut list = String::from("[0,0,0]");
            for point in 1..count(points) {
                write!(list, ",[{point},0,0]").unwrap();
            }
            fs::write(&path, design(&list, "\"rim\"")).unwrap();
        }
        ["uses", uses, points, _] => {
            let list: Vec<String> = (0..count(points)).map(|n| format!("[{n},0,0]")).collect();
            let uses = vec!["\"rim\""; count(uses)];
            fs::write(&path, design(&list.join(","), &uses.join(","))).unwrap();
        }
        ["groups", groups, _] => fs::write(&path, "g\n".repeat(count(groups))).unwrap(),
        ["nodes", nodes, _] => {
            let json = format!("{{\"nodes\":[{}{{}}]}}", "{},".repeat(count(nodes) - 1));
            let mut bytes = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
            bytes.extend((json.len() as u32).to_le_bytes());
            bytes.extend(b"JSON");
            bytes.extend(json.bytes());
            fs::write(&path, bytes).unwrap();
        }
        ["bytes", bytes, _] => {
            fs::File::create(&path).unwrap().set_len(count(bytes) as u64).unwrap();
        }
        ["link", _] => return linked(folder, input),
        ["stdin"] => return Some("-".to_owned()),
        _ => panic!("{recipe}"),
    }
    Some(input.to_owned())
}

#[cfg(unix)]
fn linked(folder: &Path, input: &str) -> Option<String> {
    let inside = folder.join("inside");
    fs::create_dir(&inside).unwrap();
    fs::write(folder.join("secret.csv"), "x,y,z\n0,0,0\n1,0,0\n1,1,0\n").unwrap();
    std::os::unix::fs::symlink("../secret.csv", inside.join("link.csv")).unwrap();
    let curve = "{ \"kind\": \"spline\", \"closed\": true, \"table\": \"link.csv\" }";
    let text = format!(
        "{{ \"sheetwright\": 1, \"curves\": {{ \"rim\": {curve} }}, \"panels\": [\
         {{ \"name\": \"lid\", \"boundary\": [\"rim\"] }}] }}"
    );
    fs::write(inside.join(input), text).unwrap();
    Some(format!("inside/{input}"))
}

#[cfg(not(unix))]
fn linked(_: &Path, _: &str) -> Option<String> {
    None
}

fn design(points: &str, boundary: &str) -> String {
    format!(
        "{{ \"sheetwright\": 1, \"curves\": {{ \"rim\": {{ \"kind\": \"polyline\", \"closed\": \
         true, \"points\": [{points}] }} }}, \"panels\": [{{ \"name\": \"lid\", \"boundary\": \
         [{boundary}] }}] }}"
    )
}

#[test]
fn bad_inputs_are_refused_in_the_words_beside_them() {
    let scratch = tempfile::tempdir().unwrap();
    let rewrite = std::env::var_os("SHEETWRIGHT_REWRITE").is_some();
    let cases = cases(scratch.path());
    assert!(cases.len() >= 60);
    let mut wrong = String::new();
    for case in &cases {
        let out = scratch.path().join(format!("{}-out", case.name));
        let output = run(case, &out);
        let said = String::from_utf8(output.stderr).unwrap();
        let expected = corpus().join(format!("{}.expected", case.name));
        if rewrite {
            fs::write(&expected, &said).unwrap();
        }
        let wanted = fs::read_to_string(&expected).unwrap_or_default();
        let form = said.starts_with("error: ") && said.contains("\nhint: ");
        if said != wanted || !form || said.lines().count() != 2 {
            write!(wrong, "{}: said\n{said}instead of\n{wanted}\n", case.name).unwrap();
        }
        if output.status.code() != Some(2) || !output.stdout.is_empty() || out.exists() {
            let status = output.status;
            writeln!(wrong, "{}: {status}, written: {}", case.name, out.exists()).unwrap();
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn every_expected_text_has_its_input() {
    let names: Vec<String> = fs::read_dir(corpus())
        .unwrap()
        .filter_map(|entry| {
            let file = entry.unwrap().file_name().into_string().unwrap();
            file.strip_suffix(".expected").map(str::to_owned)
        })
        .collect();
    let files: Vec<String> = fs::read_dir(corpus())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    for name in names {
        let is_input = |file: &&String| {
            !file.ends_with(".expected")
                && !file.ends_with(".args")
                && (**file == name || file.starts_with(&format!("{name}.")))
        };
        assert_eq!(files.iter().filter(is_input).count(), 1, "{name}");
    }
}
