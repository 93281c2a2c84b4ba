//! All files that a command makes of the project's own inputs, kept in folders: the first half of
//! showing that a change of the code changes no output. `compare` is the other half.
//!
//! Each input gets a folder with the status, both streams and all files that were written: the
//! examples, the gallery, the good corpus entries, and the templates at their defaults.

use crate::root;
use sheetwright::template::catalogue;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

const HELP: &str = "`cargo xtask outputs` takes `--with COMMAND --out DIR` and, if need be, \
                    `--only TEXT`, once or several times, for inputs whose names hold one";
/// The folders with inputs of `make`.
const INPUTS: [&str; 3] = ["examples", "examples/gallery", "corpus/good"];
/// The formats for a curve table or a design: all that every one of them has. A mesh takes those
/// that are written unless formats are named.
const FORMATS: &str = "obj,svg,dxf,pdf,quads,step,fold,astm,offsets,parts,assembly,report";

/// An input and how it is made.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Job {
    /// The folder of its own, below that of all.
    folder: String,
    /// The calls one after the other; `OUT` in an argument stands for the folder of its own.
    calls: Vec<Vec<String>>,
}

/// Makes all inputs with the command that the arguments name.
pub(crate) fn write() -> Result<(), String> {
    let (mut with, mut out, mut only) = (None, None, Vec::new());
    let arguments: Vec<String> = std::env::args().skip(2).collect();
    for pair in arguments.chunks(2) {
        match pair {
            [flag, value] if flag == "--with" => with = Some(value.clone()),
            [flag, value] if flag == "--out" => out = Some(PathBuf::from(value)),
            [flag, value] if flag == "--only" => only.push(value),
            _ => return Err(HELP.to_owned()),
        }
    }
    let (Some(with), Some(out)) = (with, out) else { return Err(HELP.to_owned()) };
    // A path is of the folder that the caller is in, and commands run in the root.
    let path = Path::new(&with);
    let command = if path.components().count() > 1 {
        fs::canonicalize(path).map_err(|error| format!("{with}: {error}"))?
    } else {
        path.to_owned()
    };
    if fs::read_dir(&out).is_ok_and(|mut entries| entries.next().is_some()) {
        return Err(format!("{} is not empty: give a folder of its own", out.display()));
    }
    fs::create_dir_all(&out).map_err(|error| format!("{}: {error}", out.display()))?;
    let out = fs::canonicalize(&out).map_err(|error| format!("{}: {error}", out.display()))?;
    let is_wanted =
        |job: &Job| only.is_empty() || only.iter().any(|&text| job.folder.contains(text));
    for job in jobs()?.into_iter().filter(is_wanted) {
        let begun = Instant::now();
        let status = run(&command, &job, &out.join(&job.folder))?;
        println!("{:6.1} s  status {status}  {}", begun.elapsed().as_secs_f64(), job.folder);
    }
    Ok(())
}

/// All inputs, in the order of their names.
fn jobs() -> Result<Vec<Job>, String> {
    let mut jobs = Vec::new();
    for folder in INPUTS {
        let path = root().join(folder);
        let entries = fs::read_dir(&path).map_err(|error| format!("{folder}: {error}"))?;
        let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
        let mut names: Vec<String> = names.filter(|name| is_input(name)).collect();
        names.sort();
        for name in names {
            let stem = name.split('.').next().unwrap_or(&name);
            let facts = fs::read_to_string(path.join(format!("{stem}.facts.json")));
            let is_without_plane = facts.is_ok_and(|facts| facts.contains("\"plane\": \"none\""));
            jobs.push(Job {
                folder: format!("{folder}/{name}"),
                calls: vec![make(&format!("{folder}/{name}"), is_without_plane)],
            });
        }
    }
    for template in catalogue() {
        let design = format!("OUT/{}.sheet.json", template.name);
        let new = ["new", template.name, "-o", &design].map(str::to_owned).to_vec();
        jobs.push(Job {
            folder: format!("templates/{}", template.name),
            calls: vec![new, make(&design, false)],
        });
    }
    Ok(jobs)
}

fn is_mesh(name: &str) -> bool {
    [".obj", ".stl", ".ply", ".glb"].iter().any(|ending| name.ends_with(ending))
}

fn is_input(name: &str) -> bool {
    is_mesh(name) || name.ends_with(".csv") || name.ends_with(".sheet.json")
}

/// The call that makes an input into `files` of its folder.
fn make(input: &str, without_plane: bool) -> Vec<String> {
    let mut call = vec!["make", input, "--out", "OUT/files", "--quiet"];
    if !is_mesh(input) {
        call.extend(["--formats", FORMATS]);
    }
    if without_plane {
        call.extend(["--plane", "none"]);
    }
    call.into_iter().map(str::to_owned).collect()
}

/// Runs the calls of a job into its folder and keeps their statuses and streams; `signal` is the
/// status of one that a signal ended.
fn run(command: &Path, job: &Job, folder: &Path) -> Result<String, String> {
    let failed = |error: std::io::Error| format!("{}: {error}", job.folder);
    fs::create_dir_all(folder).map_err(failed)?;
    let mut statuses = Vec::new();
    let (mut said, mut noted) = (Vec::new(), Vec::new());
    for call in &job.calls {
        let own = folder.to_string_lossy();
        let arguments = call.iter().map(|argument| argument.replace("OUT", &own));
        let output = Command::new(command).args(arguments).current_dir(root()).output();
        let output = output.map_err(|error| format!("{}: {error}", command.display()))?;
        let code = output.status.code();
        statuses.push(code.map_or_else(|| "signal".to_owned(), |code| code.to_string()));
        said.extend(output.stdout);
        noted.extend(output.stderr);
    }
    let statuses = statuses.join(" ");
    for (name, bytes) in
        [("status", statuses.as_bytes()), ("stdout.txt", &said), ("stderr.txt", &noted)]
    {
        fs::write(folder.join(name), bytes).map_err(failed)?;
    }
    Ok(statuses)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests panic

    use super::*;

    #[test]
    fn every_kind_of_input_is_made() {
        let jobs = jobs().unwrap();
        let of = |folder: &str| jobs.iter().find(|job| job.folder == folder).unwrap();
        assert_eq!(of("examples/leaf.csv").calls[0][..2], ["make", "examples/leaf.csv"]);
        assert!(of("corpus/good/wrapped-egg.csv").calls[0].contains(&"none".to_owned()));
        assert!(!of("examples/gallery/half-sphere.obj").calls[0].contains(&FORMATS.to_owned()));
        let dome = &of("templates/dome").calls;
        assert_eq!((dome.len(), &dome[0][3][..]), (2, "OUT/dome.sheet.json"));
        assert!(jobs.iter().all(|job| !job.folder.ends_with(".facts.json")));
        let mut folders: Vec<&str> = jobs.iter().map(|job| &job.folder[..]).collect();
        folders.sort_unstable();
        folders.dedup();
        assert_eq!(folders.len(), jobs.len());
    }

    #[cfg(unix)]
    #[test]
    fn statuses_and_streams_are_kept() {
        let desk = tempfile::tempdir().unwrap();
        let call = |script: &str| vec!["-c".to_owned(), script.to_owned()];
        let calls = vec![call("echo said; echo noted >&2; exit 1"), call("echo file > OUT/made")];
        let job = Job { folder: "job".to_owned(), calls };
        let folder = desk.path().join("job");
        assert_eq!(run(Path::new("sh"), &job, &folder).unwrap(), "1 0");
        let kept = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
        assert_eq!((kept("status"), kept("stdout.txt")), ("1 0".to_owned(), "said\n".to_owned()));
        assert_eq!((kept("stderr.txt"), kept("made")), ("noted\n".to_owned(), "file\n".to_owned()));
        assert!(run(Path::new("no-such-command"), &job, &folder).is_err());
    }
}
