//! The command as scripts use it: exit statuses, streams, JSON, conversions, whole files.

#![allow(clippy::unwrap_used, reason = "a test that can't go on fails")]

#[path = "commands/new.rs"]
mod new;
#[path = "commands/pages.rs"]
mod pages;
#[path = "commands/sheets.rs"]
mod sheets;
#[path = "commands/trades.rs"]
mod trades;

use serde_json::Value;
use std::fs;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A flat square with a corner at every row.
const SQUARE: &str = "x,y,z,corner\n0,0,0,1\n100,0,0,1\n100,100,0,1\n0,100,0,1\n";
/// A strip 4 by 1, rounded at its ends and turned by 90°: no sheet bends to that.
const TWISTED: &str = r#"{ "sheetwright": 1, "name": "twisted", "material": "steel-5mm", "curves": {
    "rim": { "kind": "spline", "closed": true, "points": [
        [0,-50,0], [100,-46,-19], [200,-35,-35], [300,-19,-46], [400,0,-50], [430,0,0],
        [400,0,50], [300,19,46], [200,35,35], [100,46,19], [0,50,0], [-30,0,0]] } },
  "panels": [{ "name": "seat", "boundary": ["rim"], "samples": 60 }] }"#;
const TWO_PANELS: &str = r#"{ "sheetwright": 1, "curves": {
    "a": { "kind": "polyline", "points": [[0,0,0], [100,0,0]] },
    "b": { "kind": "polyline", "points": [[0,50,0], [100,50,0]] },
    "c": { "kind": "spline", "points": [[0,90,0], [50,100,10], [100,90,0]] } },
  "panels": [{ "name": "one", "rails": ["a", "b"], "samples": 9 },
             { "name": "two", "rails": ["b", "-c"], "samples": 9, "method": "rails" }] }"#;

struct Desk(tempfile::TempDir);

impl Desk {
    fn new(files: &[(&str, &str)]) -> Self {
        let desk = Self(tempfile::tempdir().unwrap());
        for (name, text) in files {
            fs::write(desk.path(name), text).unwrap();
        }
        desk
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn command(&self, args: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_sheetwright"));
        command.current_dir(self.0.path()).args(args.split_whitespace()).stdin(Stdio::null());
        command
    }

    fn run(&self, args: &str) -> Output {
        self.command(args).output().unwrap()
    }

    /// Runs a call that must end with `status`; what it says on both streams.
    fn says(&self, args: &str, status: i32) -> (String, String) {
        let output = self.run(args);
        let texts = (text(&output.stdout), text(&output.stderr));
        assert_eq!(output.status.code(), Some(status), "{args}: {texts:?}");
        texts
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn names_in(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn the_exit_status_says_how_it_went() {
    let desk = Desk::new(&[("square.csv", SQUARE), ("twisted.sheet.json", TWISTED)]);
    let (words, _) = desk.says("check square.csv", 0);
    assert_eq!(words, "square: bends\n");
    let (words, _) = desk.says("check twisted.sheet.json", 1);
    assert!(words.starts_with("seat: will not bend\n  error: "), "{words}");
    // However it is sampled, it is never taken for a yes.
    for samples in [12, 14, 16, 20, 24, 30, 36, 48, 100, 300] {
        let args = ["check", "twisted.sheet.json", "--samples", &samples.to_string()].join(" ");
        let output = desk.run(&args);
        let words = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(!words.starts_with("seat: bends\n"), "{samples}: {words}");
    }
    desk.says("make twisted.sheet.json --out out", 1);
    // Files are written all the same: the pattern shows what is wrong.
    assert!(desk.path("out/report.json").exists());
    desk.says("check nothing.csv", 2);
    desk.says("chek square.csv", 2);
    desk.says("", 2);
    desk.says("--help", 0);
    desk.says("--version", 0);
}

/// The points stay in the table, so that corrected offsets need no new design.
#[test]
fn a_hull_follows_its_table_of_offsets() {
    let table = "curve,x,y,z\nkeel,0,0,0\nkeel,5,0,0\nkeel,9,0,0\n\
                 chine,0,2,1\nchine,5,2,1\nchine,9,2,1\n";
    let desk = Desk::new(&[]);
    fs::create_dir(desk.path("boat")).unwrap();
    fs::write(desk.path("boat/offsets.csv"), table).unwrap();
    // The table is named from the folder of the design, wherever the command runs.
    desk.says("new hull --set table=offsets.csv --set units=ft -o boat/hull.sheet.json", 0);
    let design = fs::read_to_string(desk.path("boat/hull.sheet.json")).unwrap();
    assert!(!design.contains("\"points\""), "{design}");
    let width = || -> f64 {
        desk.says("make boat/hull.sheet.json --out out --formats report", 0);
        let report = fs::read_to_string(desk.path("out/report.json")).unwrap();
        let report: Value = serde_json::from_str(&report).unwrap();
        report["panels"][0]["flat_width_mm"].as_f64().unwrap()
    };
    assert!((width() - 9.0 * 304.8).abs() < 1e-6);
    fs::write(desk.path("boat/offsets.csv"), table.replace(",9,", ",10,")).unwrap();
    assert!((width() - 10.0 * 304.8).abs() < 1e-6);
    // Where the design goes to standard output, tables lie where the command runs.
    let (_, error) = desk.says("new hull --set table=offsets.csv", 2);
    assert!(error.starts_with("error: hull: table: there is no table 'offsets.csv'"), "{error}");
    desk.says("new hull --set table=boat/offsets.csv", 0);
    // Made at once, the design beside the patterns has the points and needs no table.
    desk.says("new hull --set table=boat/offsets.csv --set units=ft --make made", 0);
    let beside = fs::read_to_string(desk.path("made/hull.sheet.json")).unwrap();
    assert!(beside.contains("\"points\"") && !beside.contains("offsets.csv"), "{beside}");
    desk.says("check made/hull.sheet.json", 0);
}

#[test]
fn make_writes_every_format_or_those_asked_for() {
    let desk = Desk::new(&[("two.sheet.json", TWO_PANELS)]);
    desk.says("make two.sheet.json --out deep/er", 0);
    let all = [
        "one.dxf",
        "one.svg",
        "pattern.pdf",
        "report.html",
        "report.json",
        "surface.obj",
        "timing.json",
        "two.dxf",
        "two.svg",
    ];
    assert_eq!(names_in(&desk.path("deep/er")), all);
    desk.says("make two.sheet.json --out few --formats dxf,obj", 0);
    assert_eq!(names_in(&desk.path("few")), ["one.dxf", "surface.obj", "two.dxf"]);
}

/// Each input has a folder of its own; one that can't be made keeps none back, one that can't be
/// read keeps all back.
#[test]
fn several_inputs_have_folders_of_their_own() {
    let desk = Desk::new(&[
        ("two.sheet.json", TWO_PANELS),
        ("square.csv", SQUARE),
        ("crossed.csv", "x,y,z,corner\n0,0,0,1\n9,9,0,1\n9,0,0,1\n0,9,0,1\n"),
        ("broken.csv", "x,y\n0,0\n"),
    ]);
    fs::create_dir(desk.path("sub")).unwrap();
    fs::copy(desk.path("square.csv"), desk.path("sub/square.csv")).unwrap();
    let inputs = "square.csv two.sheet.json sub/square.csv";
    let (said, _) = desk.says(&format!("make {inputs} --out all --formats svg"), 0);
    let verdicts: Vec<&str> = said.lines().filter(|line| !line.starts_with(' ')).collect();
    let all =
        ["square/square: bends", "two/one: bends", "two/two: bends", "square-2/square: bends"];
    assert_eq!(verdicts, all);
    desk.says("make two.sheet.json --out alone --formats svg", 0);
    for name in ["one.svg", "two.svg"] {
        let bytes = |folder: &str| fs::read(desk.path(folder).join(name)).unwrap();
        assert_eq!(bytes("all/two"), bytes("alone"), "{name}");
    }
    let (said, _) = desk.says(&format!("make {inputs} --out json --formats svg --json"), 0);
    let names: Vec<String> = said
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).unwrap()["files"][0].to_string())
        .collect();
    assert_eq!(names, [r#""square/square.svg""#, r#""two/one.svg""#, r#""square-2/square.svg""#]);
    let mut child = desk.command("make two.sheet.json - --from csv --out piped --formats svg");
    let mut child = child.stdin(Stdio::piped()).stdout(Stdio::null()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(SQUARE.as_bytes()).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert_eq!(names_in(&desk.path("piped")).len(), 2);
    let (_, error) = desk.says("make crossed.csv square.csv --out some --formats svg", 2);
    assert!(error.contains("error: crossed.csv: "), "{error}");
    assert_eq!(names_in(&desk.path("some")), ["square"]);
    let (_, error) = desk.says("make square.csv broken.csv --out none", 2);
    assert!(error.contains("broken.csv"), "{error}");
    assert!(!desk.path("none").exists());
    for (args, words) in [
        ("make - - --out none", "standard input is named twice"),
        ("make square.csv two.sheet.json --with square.csv --out none", "--with goes with one"),
    ] {
        let (_, error) = desk.says(args, 2);
        assert!(error.contains(words), "{args}: {error}");
    }
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let desk = Desk::new(&[("two.sheet.json", TWO_PANELS)]);
    desk.says("make two.sheet.json --out first", 0);
    desk.says("make two.sheet.json --out second --quiet", 0);
    let names = names_in(&desk.path("first"));
    assert_eq!(names, names_in(&desk.path("second")));
    for name in names.iter().filter(|name| *name != "timing.json") {
        let bytes = |folder: &str| fs::read(desk.path(folder).join(name)).unwrap();
        assert_eq!(bytes("first"), bytes("second"), "{name}");
    }
}

#[test]
fn times_stand_in_a_file_of_their_own() {
    let desk = Desk::new(&[("two.sheet.json", TWO_PANELS)]);
    desk.says("make two.sheet.json --out out", 0);
    let times: Value =
        serde_json::from_slice(&fs::read(desk.path("out/timing.json")).unwrap()).unwrap();
    let panels = times["panels"].as_array().unwrap();
    assert_eq!(panels.len(), 2);
    assert_eq!(panels[1]["name"], "two");
    let mut sum = 0.0;
    for panel in panels {
        for field in ["solve", "vary", "flatten", "write"] {
            let seconds = panel[field].as_f64().unwrap();
            assert!((0.0..100.0).contains(&seconds));
            sum += seconds;
        }
        assert_eq!(panel["vary"], 0.0);
        assert!(panel["solve"].as_f64().unwrap() > 0.0);
    }
    assert!(times["total"].as_f64().unwrap() >= sum * 0.999);
}

#[test]
fn files_are_for_the_machine_that_is_named() {
    let of_design = TWO_PANELS.replacen("{ ", "{ \"preset\": \"wazer\", ", 1);
    let desk = Desk::new(&[("two.sheet.json", TWO_PANELS), ("jet.sheet.json", &of_design)]);
    let written =
        |folder: &str, name: &str| fs::read_to_string(desk.path(folder).join(name)).unwrap();
    desk.says("make jet.sheet.json --out jet", 0);
    assert!(!written("jet", "one.svg").contains("id=\"note\""));
    assert!(written("jet", "one.dxf").contains("AC1015"), "WAZER wants a unit");
    // The call comes before the design.
    desk.says("make jet.sheet.json --out laser --preset LightBurn --dxf r12", 0);
    assert!(written("laser", "one.svg").contains("#f36926"));
    assert!(written("laser", "one.dxf").contains("AC1009"));
    // The design that comes back names it still.
    desk.says("convert jet.sheet.json again.sheet.json", 0);
    assert!(written(".", "again.sheet.json").contains("\"preset\": \"wazer\""));
    let (_, said) = desk.says("make two.sheet.json --out no --preset lightbrun", 2);
    assert!(said.contains("lightbrun") && said.contains("'lightburn'"), "{said}");

    desk.says(
        "make two.sheet.json --out hand --formats offsets,fold,astm --stations 1in --feet",
        0,
    );
    let hand = ["offsets.csv", "pattern-astm.dxf", "pattern.fold"];
    assert_eq!(names_in(&desk.path("hand")), hand);
    assert!(written("hand", "offsets.csv").lines().nth(2).unwrap().starts_with("one,0-1-0,"));
    desk.says("convert two.sheet.json two.fold", 0);
    assert_eq!(written(".", "two.fold"), written("hand", "pattern.fold"));
    let (_, said) = desk.says("make two.sheet.json --out no --stations 0", 2);
    assert!(said.contains("at least 0.01 mm"), "{said}");
}

#[test]
fn an_existing_folder_keeps_what_is_not_written() {
    let desk = Desk::new(&[("square.csv", SQUARE)]);
    fs::create_dir(desk.path("out")).unwrap();
    fs::write(desk.path("out/notes.txt"), "mine").unwrap();
    fs::write(desk.path("out/surface.obj"), "old").unwrap();
    desk.says("make square.csv --out out --formats obj", 0);
    assert_eq!(names_in(&desk.path("out")), ["notes.txt", "surface.obj"]);
    assert_eq!(fs::read(desk.path("out/notes.txt")).unwrap(), b"mine");
    assert_ne!(fs::read(desk.path("out/surface.obj")).unwrap(), b"old");
}

#[test]
fn nothing_is_written_where_something_can_not_be() {
    let desk = Desk::new(&[("square.csv", SQUARE), ("taken", "")]);
    let (_, error) = desk.says("make square.csv --out taken", 2);
    assert!(error.starts_with("error: taken: this is no folder\nhint: "), "{error}");
    // A folder with the name of a file of the run.
    fs::create_dir_all(desk.path("out/report.json")).unwrap();
    let (_, error) = desk.says("make square.csv --out out", 2);
    assert!(error.contains("report.json: a folder has this name"), "{error}");
    assert_eq!(names_in(&desk.path("out")), ["report.json"]);
    desk.says("make square.csv --out taken/deeper", 2);
    let (_, error) = desk.says("convert square.csv nowhere/square.obj", 2);
    assert!(error.contains("there is no such folder"), "{error}");
}

#[cfg(unix)]
#[test]
fn files_are_as_open_to_others_as_any_new_file() {
    use std::os::unix::fs::PermissionsExt;
    let desk = Desk::new(&[("square.csv", SQUARE)]);
    desk.says("make square.csv --out out --formats obj", 0);
    let mode = |name: &str| fs::metadata(desk.path(name)).unwrap().permissions().mode();
    assert_eq!(mode("out/surface.obj"), mode("square.csv"));
}

#[test]
fn json_is_for_machines() {
    let desk = Desk::new(&[("two.sheet.json", TWO_PANELS), ("twisted.sheet.json", TWISTED)]);
    let (out, err) = desk.says("check twisted.sheet.json --json", 1);
    let found: Value = serde_json::from_str(&out).unwrap();
    assert_eq!((out.lines().count(), err.as_str()), (1, ""));
    assert_eq!(found["name"], "twisted");
    assert_eq!(found["panels"][0]["verdict"], "will-not-bend");
    assert_eq!(found["panels"][0]["findings"][0]["severity"], "error");
    assert_eq!(found["panels"][0]["findings"][0]["code"], "strain-too-large");
    assert_eq!(found.get("files"), None);

    let (out, _) = desk.says("--json make two.sheet.json --out out --formats svg", 0);
    let found: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(found["files"], serde_json::json!(["one.svg", "two.svg"]));

    let (out, err) = desk.says("check nothing.csv --json", 2);
    let error: Value = serde_json::from_str(&err).unwrap();
    assert_eq!(out, "");
    assert_eq!(error["error"], "there is no such file");
    assert_eq!(error["where"], "nothing.csv");
    assert!(error["hint"].as_str().unwrap().ends_with('.'));
    let (_, err) = desk.says("make --json", 2);
    assert!(serde_json::from_str::<Value>(&err).unwrap()["error"].is_string());
}

#[test]
fn standard_input_is_an_input() {
    let desk = Desk::new(&[]);
    let feed = |args: &str, input: &str| {
        let mut command = desk.command(args);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
        child.wait_with_output().unwrap()
    };
    let output = feed("check - --from csv", SQUARE);
    assert_eq!((output.status.code(), text(&output.stdout).as_str()), (Some(0), "panel: bends\n"));
    let output = feed("make - --from json --out out --formats svg", TWO_PANELS);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(names_in(&desk.path("out")), ["one.svg", "two.svg"]);
    let output = feed("check - --from csv", "x,y,z\n1,2\n");
    assert!(text(&output.stderr).starts_with("error: standard input:2: the row has 2 values"));
    let table = r#"{ "sheetwright": 1, "curves": { "a": { "kind": "spline", "table": "a.csv" } },
        "panels": [] }"#;
    let output = feed("check - --from json", table);
    assert!(text(&output.stderr).contains("curves.a.table: a design from standard input"));
}

#[test]
fn conversions_come_back() {
    let desk = Desk::new(&[("leaf.csv", SQUARE), ("two.sheet.json", TWO_PANELS)]);
    // A table, a design, and the same table again.
    desk.says("convert leaf.csv leaf.sheet.json", 0);
    desk.says("convert leaf.sheet.json once.csv", 0);
    desk.says("convert once.csv again.sheet.json", 0);
    desk.says("convert again.sheet.json twice.csv", 0);
    let read = |name: &str| fs::read_to_string(desk.path(name)).unwrap();
    assert_eq!(read("once.csv"), read("twice.csv"));
    assert!(read("once.csv").starts_with("curve,x,y,z,corner\noutline,0,0,0,1\n"));
    let verdict = |name: &str| desk.says(&format!("check {name} --json"), 0).0;
    assert_eq!(verdict("leaf.csv"), verdict("leaf.sheet.json"));
    // A design, written anew, is the same design.
    desk.says("convert two.sheet.json anew.sheet.json", 0);
    desk.says("convert anew.sheet.json twice.sheet.json", 0);
    assert_eq!(read("anew.sheet.json"), read("twice.sheet.json"));
    let (words, _) = desk.says("check two.sheet.json", 0);
    assert_eq!(words, desk.says("check anew.sheet.json", 0).0);
}

#[test]
fn conversions_write_what_make_writes() {
    let desk = Desk::new(&[("leaf.csv", SQUARE), ("two.sheet.json", TWO_PANELS)]);
    desk.says("make leaf.csv --out out", 0);
    // What takes a program to look at is made when it is asked for.
    let without = names_in(&desk.path("out"));
    assert!(!without.iter().any(|name| name == "quads.obj" || name == "surface.step"));
    desk.says("make leaf.csv --out out --formats quads,step", 0);
    assert_eq!(names_in(&desk.path("out")).len(), without.len() + 2);
    for (out, file) in [
        ("a.obj", "surface.obj"),
        ("a.step", "surface.step"),
        ("a.pdf", "pattern.pdf"),
        ("a.html", "report.html"),
        ("a.json", "report.json"),
        ("a.svg", "leaf.svg"),
        ("a.dxf", "leaf.dxf"),
    ] {
        desk.says(&format!("convert leaf.csv {out}"), 0);
        let made = fs::read(desk.path("out").join(file)).unwrap();
        assert_eq!(fs::read(desk.path(out)).unwrap(), made, "{out}");
    }
    let (_, error) = desk.says("convert two.sheet.json two.svg", 2);
    assert!(error.contains("`sheetwright make` writes one file for each panel"), "{error}");
    assert!(!desk.path("two.svg").exists());
    let (_, error) = desk.says("convert leaf.csv leaf.iges", 2);
    assert!(error.contains("hint: End it in .sheet.json, .csv"), "{error}");
}

#[test]
fn line_ends_and_marks_of_other_systems_are_fine() {
    let desk = Desk::new(&[
        ("plain.csv", SQUARE),
        ("crlf.csv", &SQUARE.replace('\n', "\r\n")),
        ("bom.csv", &format!("\u{feff}{SQUARE}")),
        ("bom.sheet.json", &format!("\u{feff}{TWO_PANELS}")),
    ]);
    for name in ["plain", "crlf", "bom"] {
        desk.says(&format!("convert {name}.csv {name}-out.csv"), 0);
    }
    let read = |name: &str| fs::read(desk.path(name)).unwrap();
    assert_eq!(read("plain-out.csv"), read("crlf-out.csv"));
    assert_eq!(read("plain-out.csv"), read("bom-out.csv"));
    desk.says("check bom.sheet.json", 0);
}

#[test]
fn what_the_call_sets_comes_before_what_the_input_says() {
    let desk = Desk::new(&[("leaf.csv", SQUARE), ("two.sheet.json", TWO_PANELS)]);
    desk.says("convert leaf.csv inches.csv --units in", 0);
    let table = fs::read_to_string(desk.path("inches.csv")).unwrap();
    assert!(table.contains("outline,2540,2540,0,1\n"), "{table}");
    desk.says("convert two.sheet.json set.sheet.json --samples 5 --method bridge --fold 2.5", 0);
    let design = fs::read_to_string(desk.path("set.sheet.json")).unwrap();
    let panel = "\"samples\": 5, \"method\": \"bridge\", \"plane\": \"auto\", \"fold\": 2.5";
    assert_eq!(design.matches(panel).count(), 2, "{design}");
    let (_, note) = desk.says("make leaf.csv --out out --aim max", 0);
    assert!(note.contains("--aim max has no effect"), "{note}");
    let (_, note) = desk.says("make leaf.csv --out out --aim max --quiet", 0);
    assert_eq!(note, "");
    for (options, said) in [
        ("--feet", "--feet has no effect without offsets among the --formats"),
        ("--die 8mm", "--die has no effect without brake"),
        ("--thickness 2mm", "--thickness has no effect on the pattern without --dimensions"),
        ("--sheet 500x500mm --formats dxf", "--sheet shows in no file without sheets"),
    ] {
        let (_, note) = desk.says(&format!("make leaf.csv --out out {options}"), 0);
        assert!(note.contains(said), "{note}");
    }
    let (_, note) = desk.says("make leaf.csv --out out --feet --formats offsets", 0);
    assert!(!note.contains("has no effect"), "{note}");
}

/// Of a loop of 640 samples, threads share the table.
#[test]
fn the_number_of_threads_changes_no_bytes() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let desk = Desk::new(&[]);
    let example = examples.join("leaf.csv");
    let run = |out: &str, mut command: Command| {
        command.current_dir(desk.0.path()).stdin(Stdio::null());
        command.arg("make").arg(&example).args(["--quiet", "--samples", "640", "--out", out]);
        let output = command.output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    };
    let program = || Command::new(env!("CARGO_BIN_EXE_sheetwright"));
    run("all", program());
    let mut outs = vec!["all"];
    for threads in ["1", "7"] {
        let mut command = program();
        command.env("RAYON_NUM_THREADS", threads).env("LC_ALL", "de_DE.UTF-8").env("TZ", "UTC-9");
        run(threads, command);
        outs.push(threads);
    }
    // On one core alone, where the system has a command for it.
    if cfg!(target_os = "linux") && Command::new("taskset").arg("--version").output().is_ok() {
        let mut command = Command::new("taskset");
        command.args(["-c", "0", env!("CARGO_BIN_EXE_sheetwright")]);
        run("core", command);
        outs.push("core");
    }
    let names = names_in(&desk.path("all"));
    assert!(names.len() > 5);
    for out in outs {
        assert_eq!(names_in(&desk.path(out)), names);
        for name in names.iter().filter(|name| *name != "timing.json") {
            let bytes = |folder: &str| fs::read(desk.path(folder).join(name)).unwrap();
            assert!(bytes(out) == bytes("all"), "{out}/{name}");
        }
    }
}

/// Four loops in space that no sheet spans: the search ends with the work that it may do, which is
/// counted, so that it ends at the same place with any number of threads.
#[test]
fn loops_far_from_developable_end_with_their_work() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let vessel = examples.join("ubc-fishing-vessel.csv");
    let desk = Desk::new(&[]);
    let said = |threads: &str, options: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_sheetwright"));
        command.current_dir(desk.0.path()).stdin(Stdio::null()).env("RAYON_NUM_THREADS", threads);
        command.arg("check").arg(&vessel).args(["--samples", "60"]).args(options);
        command.output().unwrap()
    };
    let run = |threads: &str, effort: &str| said(threads, &["--json", "--effort", effort]);
    let [one, two] = ["1", "2"].map(|threads| run(threads, "0.05"));
    assert_eq!(one.status.code(), Some(1), "{}", text(&one.stderr));
    assert_eq!(text(&one.stdout), text(&two.stdout));
    let note = text(&one.stdout);
    assert!(note.contains("not-proven") && note.contains(r#"\"effort\""#), "{note}");
    let words = said("2", &["--effort", "0.05"]);
    assert!(text(&words.stdout).contains("--effort sets it"), "{}", text(&words.stdout));
    for wrong in ["0", "-1", "1001", "NaN"] {
        let refused = run("1", wrong);
        assert_eq!(refused.status.code(), Some(2), "{wrong}");
        assert!(text(&refused.stderr).contains("0.001 to 1000"), "{}", text(&refused.stderr));
    }
}

#[cfg(unix)]
#[test]
fn a_reader_that_leaves_is_no_failure() {
    let desk = Desk::new(&[("square.csv", SQUARE)]);
    for args in ["--help", "completions bash", "man", "check square.csv"] {
        let mut command = desk.command(args);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        // Nobody reads from the pipe any more when the command writes to it, or soon after.
        drop(child.stdout.take());
        let mut said = String::new();
        child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        assert_eq!((child.wait().unwrap().code(), said.as_str()), (Some(0), ""), "{args}");
    }
}

#[test]
fn shells_and_manuals_know_the_commands() {
    let desk = Desk::new(&[]);
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert!(desk.says(&format!("completions {shell}"), 0).0.contains("convert"), "{shell}");
    }
    assert!(desk.says("man", 0).0.contains("sheetwright"));
    // Manual pages have their hyphens behind backslashes.
    assert!(desk.says("man make", 0).0.replace('\\', "").contains("--formats"));
    let (_, error) = desk.says("man mkae", 2);
    assert!(error.contains("there is no command 'mkae'"), "{error}");
}

#[test]
fn the_examples_can_be_made() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let desk = Desk::new(&[]);
    for (name, status) in [
        ("leaf.csv", 0),
        ("square-to-round.sheet.json", 0),
        // Its bottom twists, as the hull was not drawn developable: by less than plate takes.
        ("ubc-fishing-vessel.sheet.json", 0),
        ("mouse.sheet.json", 0),
        ("hat.sheet.json", 0),
        ("flower.sheet.json", 0),
    ] {
        let mut command = desk.command("check");
        let output = command.arg(examples.join(name)).output().unwrap();
        assert_eq!(output.status.code(), Some(status), "{name}: {}", text(&output.stderr));
    }
}

#[test]
fn what_was_moved_can_be_made_again() {
    let twisted = TWISTED.replace(r#""material": "steel-5mm", "#, "");
    let desk = Desk::new(&[("twisted.sheet.json", &twisted[..]), ("two.sheet.json", TWO_PANELS)]);
    let (words, _) = desk.says("make twisted.sheet.json --out out --vary-limit 1cm", 0);
    assert!(words.contains("note: 'rim' moved by up to "), "{words}");
    let report = |of: &str| -> Value {
        serde_json::from_slice(&fs::read(desk.path(of).join("report.json")).unwrap()).unwrap()
    };
    let moved = &report("out")["panels"][0];
    let far = moved["moved_max_mm"].as_f64().unwrap();
    assert!(far > 1.0 && far <= 10.0 * (1.0 + 1e-9), "{far}");
    assert!(moved["before"]["twist_total"].as_f64() > moved["twist_total"].as_f64());
    let timing: Value =
        serde_json::from_slice(&fs::read(desk.path("out/timing.json")).unwrap()).unwrap();
    assert!(timing["panels"][0]["vary"].as_f64() > Some(0.0));
    // The moved design makes the same surface and patterns, and its table reads by itself.
    desk.says("make out/moved.sheet.json --out again", 0);
    for name in ["surface.obj", "seat.svg", "seat.dxf", "pattern.pdf"] {
        let [one, other] = ["out", "again"].map(|of| fs::read(desk.path(of).join(name)).unwrap());
        assert!(one == other, "{name}");
    }
    assert!(!desk.path("again/moved.csv").exists());
    assert_ne!(desk.run("check out/moved.csv --samples 60").status.code(), Some(2));
    // An angle that can't be reached is said with how near it came.
    let output = desk.run("check twisted.sheet.json --vary-warp 1 --vary-limit 2");
    let words = text(&output.stdout);
    assert!(words.contains("The goal of 1.0° is not reached"), "{words}");
    // What bends is left, and says so.
    let (words, _) = desk.says("make two.sheet.json --out still --vary-warp 5", 0);
    assert!(words.contains("note: Nothing was moved"), "{words}");
    assert!(!desk.path("still/moved.csv").exists());
    // Both were to move together, and share the time that it took to see that.
    let timing: Value =
        serde_json::from_slice(&fs::read(desk.path("still/timing.json")).unwrap()).unwrap();
    let vary = [0, 1].map(|n| timing["panels"][n]["vary"].as_f64().unwrap());
    assert!(vary[0] > 0.0 && vary[0] == vary[1], "{timing}");
    for wrong in ["--vary-warp 0", "--vary-warp 100", "--vary-limit -1", "--vary-budget much"] {
        desk.says(&format!("check two.sheet.json {wrong}"), 2);
    }
    // A table with distances needs no more words.
    let rows = (0..40).map(|n| {
        let along = f64::from(if n < 20 { n } else { 39 - n }) / 19.0;
        let (side, turn) = (if n < 20 { -1.0 } else { 1.0 }, along * 1.4);
        let [y, z] =
            [sheetwright::math::cos(turn), sheetwright::math::sin(turn)].map(|x| 40.0 * side * x);
        format!("{},{y},{z},{}\n", 400.0 * along, if n % 2 == 0 { "3" } else { "" })
    });
    fs::write(desk.path("strip.csv"), format!("x,y,z,move\n{}", rows.collect::<String>())).unwrap();
    let output = desk.run("check strip.csv");
    let words = text(&output.stdout);
    assert!(words.contains("'outline' moved by up to "), "{words}");
}

/// A quarter of a cylinder of 100 mm, which nothing need be moved for; 4 mm plywood takes 385 mm.
#[test]
fn a_radius_that_is_too_tight_is_not_called_fine() {
    let arc = |y: f64| -> String {
        let point = |n: i32| {
            let turn = f64::from(n) / 10.0 * std::f64::consts::FRAC_PI_2;
            let [z, x] =
                [sheetwright::math::cos(turn), sheetwright::math::sin(turn)].map(|x| 100.0 * x);
            format!("[{x},{y},{z}]")
        };
        (0..=10).map(point).collect::<Vec<String>>().join(",")
    };
    let design = format!(
        r#"{{ "sheetwright": 1, "material": "plywood-4mm", "curves": {{
            "a": {{ "kind": "spline", "points": [{}] }}, "b": {{ "kind": "spline", "points": [{}] }} }},
          "panels": [{{ "name": "plank", "rails": ["a", "b"], "samples": 40 }}] }}"#,
        arc(0.0),
        arc(300.0)
    );
    let desk = Desk::new(&[("plank.sheet.json", &design)]);
    let (words, _) = desk.says("check plank.sheet.json --vary-warp 5", 1);
    assert!(words.starts_with("plank: will not bend\n  error: The sheet is bent to "), "{words}");
    let truth = "note: Nothing was moved: no ruling twists by more than the goal of 5.0°, as far as \
                 its samples tell. The bend radius keeps the panel from bending,";
    assert!(words.contains(truth) && !words.contains("bends as it is"), "{words}");
    // Of paper, it is fine.
    let (words, _) = desk.says("check plank.sheet.json --vary-warp 5 --material paper", 0);
    assert!(words.contains("Nothing was moved: the panel bends as it is"), "{words}");
}

#[test]
fn a_good_duct_is_told_to_bend_its_corners_in_steps() {
    let desk = Desk::new(&[]);
    desk.says("new square-to-round --set material=steel-1mm -o duct.sheet.json", 0);
    let (words, _) = desk.says("check duct.sheet.json", 0);
    assert_eq!(words.matches("note: Bend lines meet in corners ").count(), 1, "{words}");
    assert!(!words.contains("meet in points"), "{words}");
}

#[test]
fn an_outline_stays_as_near_to_its_curves_as_it_is_to() {
    let desk = Desk::new(&[("square.csv", SQUARE)]);
    desk.says("new lampshade --set bottom=400mm --set top=400mm -o drum.sheet.json", 0);
    let made = |call: &str| -> (Value, String) {
        desk.says(&format!("make {call} --out out --formats report --verdict quick"), 0);
        let report = fs::read_to_string(desk.path("out/report.json")).unwrap();
        let report: Value = serde_json::from_str(&report).unwrap();
        let page = fs::read_to_string(desk.path("out/report.html")).unwrap();
        (report["panels"][0].clone(), page)
    };
    let shorter = |panel: &Value| panel["curve_shorter_max_mm"].as_f64().unwrap();
    // The number of samples of the template is given, and is kept.
    let (panel, page) = made("drum.sheet.json");
    assert_eq!((&panel["samples"], &panel["tolerance_mm"]), (&242.into(), &Value::Null));
    assert!((shorter(&panel) - 0.1435).abs() < 1e-4, "{panel}");
    assert!(
        page.contains("a polygon through 242 samples: its curves lie up to 0.069\u{a0}mm from")
    );
    assert!(page.contains("up to 0.14\u{a0}mm shorter than they are"));
    let (panel, _) = made("drum.sheet.json --tolerance 0.05mm");
    assert!(shorter(&panel) <= 0.05 && shorter(&panel) > 0.049, "{panel}");
    assert_eq!(panel["tolerance_mm"], 0.05);
    let bottom = panel["edges"].as_array().unwrap().iter().find(|edge| edge["name"] == "bottom");
    let bottom = bottom.unwrap();
    let length = bottom["length_flat_mm"].as_f64().unwrap();
    assert!((400.0 * std::f64::consts::PI - length - shorter(&panel)).abs() < 2e-4, "{bottom}");
    // A number that is called for comes before a tolerance.
    let (panel, _) = made("drum.sheet.json --tolerance 0.05mm --samples 100");
    assert_eq!((&panel["samples"], &panel["tolerance_mm"]), (&200.into(), &Value::Null));
    // Rows stay the samples, and have no curves.
    let (panel, page) = made("square.csv --tolerance 0.05mm");
    assert_eq!((&panel["samples"], &panel["curve_shorter_max_mm"]), (&4.into(), &Value::Null));
    assert!(!page.contains("a polygon through"));
}

#[test]
fn a_tolerance_that_is_not_reached_is_said() {
    let desk = Desk::new(&[]);
    desk.says("new lampshade --set bottom=400mm --set top=400mm -o drum.sheet.json", 0);
    let (words, _) = desk.says("check drum.sheet.json --tolerance 0.0001 --verdict quick", 0);
    let said = "  warning: The outline is a polygon through 2000 samples of each rail, the most that a \
                tolerance gives. Its curves lie up to 0.00025 mm from it, and along an edge it is up to \
                0.00052 mm shorter; the tolerance is 0.00010 mm. ";
    assert!(words.contains(said), "{words}");
}

#[test]
fn names_of_choices_are_taken_in_capitals() {
    let desk = Desk::new(&[("square.csv", SQUARE)]);
    let call = "make square.csv --out out --paper A4 --formats PDF,Svg --units MM --material Paper \
                --method Optimal";
    desk.says(call, 0);
    assert_eq!(names_in(&desk.path("out")), ["pattern.pdf", "square.svg"]);
}

#[test]
fn a_folder_is_answered_with_what_makes_all_in_it() {
    let desk = Desk::new(&[]);
    fs::create_dir(desk.path("parts")).unwrap();
    fs::write(desk.path("parts/square.csv"), SQUARE).unwrap();
    let (_, error) = desk.says("make parts --out out", 2);
    let wanted = "error: parts: this is a folder\nhint: Name one file in it. For a table with a row for each \
                  panel: `sheetwright batch parts/*.csv --table panels.csv`. For all files, in a shell: \
                  for f in parts/*.csv; do sheetwright make \"$f\" --out \"${f%.csv}\"; done\n";
    assert_eq!(error, wanted);
    fs::rename(desk.path("parts"), desk.path("a&b's")).unwrap();
    let (_, error) = desk.says("make a&b's --out out", 2);
    assert!(error.contains(r"for f in 'a&b'\''s'/*.csv; do"), "{error}");
    let (_, error) = desk.says("check a&b's/square.csv a&b's/other.csv", 2);
    assert!(
        error.contains("hint: Give one input at a time. For a table with a row")
            && error.contains("For all files, in a shell: for f in *.csv"),
        "{error}"
    );
}

/// The table of the method takes 0.84 GiB, which the program may, and does not get.
#[cfg(target_os = "linux")]
#[test]
fn memory_that_can_not_be_had_is_refused_in_words() {
    let desk = Desk::new(&[("square.csv", SQUARE)]);
    let mut shell = Command::new("sh");
    shell.current_dir(desk.0.path()).stdin(Stdio::null());
    shell
        .arg("-c")
        .arg("ulimit -v 700000; exec \"$0\" \"$@\"")
        .arg(env!("CARGO_BIN_EXE_sheetwright"));
    let output = shell.args("check square.csv --method bridge --samples 30000".split(' ')).output();
    let output = output.unwrap();
    let words = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{words}");
    assert!(words.contains("the tables need 0.8 GiB of memory and may take 0."), "{words}");
}
