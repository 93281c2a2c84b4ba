//! `sheetwright batch`: rows as `check` has them, errors a panel, shards, streams, and tables that
//! are whole however often a run is killed.

#![allow(clippy::unwrap_used, reason = "a test that can't go on fails")]

use serde_json::Value;
use sheetwright::random::Random;
use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::Duration;

struct Desk(tempfile::TempDir);

impl Desk {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    fn command(&self, args: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_sheetwright"));
        command.current_dir(self.0.path()).args(args.split_whitespace()).stdin(Stdio::null());
        command
    }

    /// Runs a call that must end with `status`; what it says on both streams.
    fn says(&self, args: &str, status: i32) -> (String, String) {
        said(&self.command(args).output().unwrap(), args, status)
    }

    /// As [`Self::says`], with this text on standard input.
    fn hears(&self, args: &str, text: &str, status: i32) -> (String, String) {
        let mut command = self.command(args);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
        said(&child.wait_with_output().unwrap(), args, status)
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    }
}

fn said(output: &Output, args: &str, status: i32) -> (String, String) {
    let texts = [&output.stdout, &output.stderr].map(|b| String::from_utf8(b.clone()).unwrap());
    assert_eq!(output.status.code(), Some(status), "{args}: {texts:?}");
    let [out, err] = texts;
    (out, err)
}

/// A table of wavy panels, `p0` to the last, each of so many rows.
fn facade(panels: usize, rows: usize) -> String {
    let mut random = Random::new(5);
    let mut text = String::from("curve,x,y,z\n");
    for panel in 0..panels {
        let waves: Vec<f64> = (0..3).map(|_| random.between(-9.0, 9.0)).collect();
        for row in 0..rows {
            let angle = std::f64::consts::TAU * row as f64 / rows as f64;
            let (s, c) = (sheetwright::math::sin(angle), sheetwright::math::cos(angle));
            let z = waves[0] * s * c + waves[1] * c * c + waves[2] * s;
            writeln!(text, "p{panel},{},{},{z}", 100.0 * c, 60.0 * s).unwrap();
        }
    }
    text
}

fn rows(table: &str) -> Vec<Value> {
    table.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn rows_are_what_check_says_of_each_input() {
    let desk = Desk::new();
    let good = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus/good");
    fs::create_dir(desk.path("in")).unwrap();
    let names = [
        "cone-with-a-tight-end.csv",
        "drawing-lid.svg",
        "drawing-rails.dxf",
        "kayak-strake.sheet.json",
        "mesh-cube.obj",
        "mesh-gentle-saddle.obj",
        "parabolic-leaf.csv",
    ];
    for name in names {
        fs::copy(good.join(name), desk.path("in").join(name)).unwrap();
    }
    // What is no input is left alone.
    desk.write("in/notes.md", "to do");
    let made = desk.command("batch in --table t.jsonl").output().unwrap();
    let table = rows(&desk.read("t.jsonl"));
    let mut checked = Vec::new();
    let mut statuses = Vec::new();
    for name in names {
        let output =
            desk.command(&format!("check in/{name} --json --verdict auto")).output().unwrap();
        statuses.push(output.status.code());
        let json: Value = serde_json::from_slice(&output.stdout).unwrap();
        checked.extend(json["panels"].as_array().unwrap().clone());
    }
    assert_eq!(made.status.code(), statuses.into_iter().max().unwrap());
    assert_eq!(table.len(), checked.len());
    for (row, panel) in table.iter().zip(&checked) {
        for (key, value) in panel.as_object().unwrap() {
            match &key[..] {
                // A panel of a table has the name of its curve.
                "name" if value == "cone-with-a-tight-end" => assert_eq!(row["panel"], "outline"),
                "name" => assert_eq!(&row["panel"], value),
                _ => assert_eq!(&row[key], value, "{key} of {row}"),
            }
        }
        assert!(row["error"].is_null() && row["area_flat_mm2"].as_f64().unwrap() > 0.0, "{row}");
    }
    let sources: Vec<&str> = table.iter().map(|row| row["source"].as_str().unwrap()).collect();
    assert!(
        sources.contains(&"in/drawing-lid.svg") && sources.contains(&"in/parabolic-leaf.csv:2")
    );
}

#[test]
fn the_values_are_those_of_the_report() {
    let desk = Desk::new();
    desk.write("t.csv", &facade(1, 40));
    desk.says("batch t.csv --table rows.jsonl --verdict exact", 0);
    let row = &rows(&desk.read("rows.jsonl"))[0];
    desk.says("make t.csv --out made --formats report", 0);
    let report: Value = serde_json::from_str(&desk.read("made/report.json")).unwrap();
    let panel = &report["panels"][0];
    for key in [
        "warp_max_deg",
        "strain_p95",
        "strain_limit",
        "bend_radius_min_mm",
        "area_flat_mm2",
        "area_space_mm2",
        "flat_width_mm",
        "flat_height_mm",
        "verdict",
    ] {
        assert_eq!(row[key], panel[key], "{key}");
    }
    let edges = panel["edges"].as_array().unwrap();
    let around: f64 = edges.iter().map(|edge| edge["length_flat_mm"].as_f64().unwrap()).sum();
    assert!((row["outline_length_mm"].as_f64().unwrap() - around).abs() < 1e-9 * around);
}

#[test]
fn one_bad_panel_spoils_no_other() {
    let desk = Desk::new();
    let good = facade(3, 16);
    let bad = good.replacen("p1,", "p1,x", 1);
    desk.write("t.csv", &bad);
    let (said, _) = desk.says("batch t.csv missing.stl --table rows.csv --quiet", 1);
    assert!(said.starts_with("4 panels: 2 bend, 2 could not be made\n"), "{said}");
    let table = desk.read("rows.csv");
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 5);
    assert!(
        lines[2].starts_with("2,p1,,,,,") && lines[2].contains(",t.csv:18,\"x is 'x"),
        "{table}"
    );
    assert!(lines[4].starts_with("4,missing,") && lines[4].contains("there is no such file"));
    // The others have the rows that they have without it.
    desk.write("good.csv", &good);
    desk.says("batch good.csv --table good-rows.csv --quiet", 0);
    let expected = desk.read("good-rows.csv").replace("good.csv", "t.csv");
    let expected: Vec<&str> = expected.lines().collect();
    assert_eq!([lines[1], lines[3]], [expected[1], expected[3]]);
}

#[test]
fn threads_change_no_byte_and_shards_are_the_whole() {
    let desk = Desk::new();
    desk.write("t.csv", &facade(23, 16));
    for form in ["csv", "jsonl"] {
        for threads in [1, 2, 5] {
            let call = format!("batch t.csv --table {threads}.{form} --threads {threads} --quiet");
            desk.says(&call, 0);
        }
        let whole = desk.read(&format!("1.{form}"));
        assert_eq!(whole.lines().count(), if form == "csv" { 24 } else { 23 });
        assert_eq!(whole, desk.read(&format!("2.{form}")));
        assert_eq!(whole, desk.read(&format!("5.{form}")));
        let mut merged = Vec::new();
        for shard in 1..=4 {
            let call = format!("batch t.csv --table s{shard}.{form} --shard {shard}/4 --quiet");
            desk.says(&call, 0);
            let part = desk.read(&format!("s{shard}.{form}"));
            let header = usize::from(form == "csv");
            merged.extend(part.lines().skip(header).map(str::to_owned));
        }
        let number = |line: &String| {
            let digits: String = line.chars().skip_while(|c| !c.is_ascii_digit()).collect();
            digits.split(',').next().unwrap().parse::<u64>().unwrap()
        };
        merged.sort_by_key(number);
        let whole: Vec<&str> = whole.lines().skip(usize::from(form == "csv")).collect();
        assert_eq!(merged, whole);
    }
    // A share of nothing is a table without rows.
    desk.says("batch t.csv --table none.csv --shard 40/50 --quiet", 0);
    assert_eq!(desk.read("none.csv").lines().count(), 1);
}

#[test]
fn json_lines_are_designs() {
    let desk = Desk::new();
    let design = |name: &str, size: u32| {
        format!(
            "{{\"sheetwright\":1,{name}\"curves\":{{\"rim\":{{\"kind\":\"polyline\",\"closed\":true,\
             \"points\":[[0,0,0],[{size},0,0],[{size},50,0],[0,50,0]]}}}},\"panels\":[{{\"name\":\
             \"lid\",\"boundary\":[\"rim\"],\"samples\":20}}]}}\n"
        )
    };
    let lines = [
        design("\"name\":\"a\",", 10),
        "\n".to_owned(),
        design("", 20),
        "{\"sheetwright\":1,\"curves\"\n".to_owned(),
        design("\"name\":\"A\",", 30),
    ]
    .concat();
    let (out, err) = desk.hears("batch - ", &lines, 1);
    let ids: Vec<String> =
        out.lines().map(|line| line.split(',').take(3).collect::<Vec<_>>().join(" ")).collect();
    assert_eq!(ids, ["number id panel", "1 a lid", "2 2 lid", "3 3 ", "4 A-2 lid"], "{out}");
    assert!(out.contains("standard input:4") && err.contains("4 panels: 3 bend, 1 could not"));
    desk.write("d.jsonl", &lines);
    desk.says("batch d.jsonl --table d-rows.csv", 1);
    assert_eq!(desk.read("d-rows.csv").replace("d.jsonl", "standard input"), out);
}

#[test]
fn calls_that_can_t_be_used_write_nothing() {
    let desk = Desk::new();
    desk.write("t.csv", &facade(2, 12));
    fs::create_dir(desk.path("empty")).unwrap();
    for (call, says) in [
        ("batch empty --table rows.csv", "the inputs hold no panel"),
        ("batch - --table rows.csv", "the inputs hold no panel"),
        ("batch t.csv --table rows.txt", "the ending of the table's name"),
        ("batch t.csv --table rows.csv --formats svg", "--out"),
        ("batch t.csv --resume", "standard output can't be gone on with"),
        ("batch t.csv --table rows.csv --shard 3/2", "as in 3/16"),
        ("batch t.csv --table rows.csv --from csv", "--from is for standard input"),
        ("batch - - --table rows.csv", "standard input is named twice"),
        ("batch - --from stl --table rows.csv", "JSON lines or a curve table"),
    ] {
        let (_, err) = desk.says(call, 2);
        assert!(err.contains(says) && err.contains("hint: "), "{call}: {err}");
        assert_eq!(desk.names(), ["empty", "t.csv"], "{call}");
    }
    desk.says("batch t.csv --table rows.csv --quiet", 0);
    let table = desk.read("rows.csv");
    let (_, err) = desk.says("batch t.csv --table rows.csv", 2);
    assert!(err.contains("there is a table of this name") && err.contains("--resume"), "{err}");
    // Other inputs, other options, and what is no such table at all.
    desk.write("u.csv", &facade(2, 12).replace("p0", "q0"));
    desk.write("v.csv", &facade(1, 12));
    for (call, says) in [
        ("batch u.csv --table rows.csv --resume", "the table is of other inputs"),
        ("batch v.csv --table rows.csv --resume", "the table goes to number 2"),
        ("batch t.csv --table rows.csv --resume --material steel-5mm", "comes out otherwise now"),
        ("batch t.csv --table t.csv --resume", "no table that such a batch writes"),
    ] {
        let (_, err) = desk.says(call, 2);
        assert!(err.contains(says), "{call}: {err}");
        assert_eq!(desk.read("rows.csv"), table, "{call}");
    }
    assert_eq!(desk.read("t.csv"), facade(2, 12));
    desk.write("notes.jsonl", "to do");
    let (_, err) = desk.says("batch t.csv --table notes.jsonl --resume", 2);
    assert!(err.contains("notes.jsonl:1: this is no row"), "{err}");
    assert_eq!(desk.read("notes.jsonl"), "to do");
}

#[test]
fn a_table_beside_its_inputs_is_no_input() {
    let desk = Desk::new();
    desk.write("t.csv", &facade(2, 12));
    for _ in 0..2 {
        let (said, _) = desk.says("batch . --table rows.csv --resume --json", 0);
        let said: Value = serde_json::from_str(&said).unwrap();
        assert_eq!((&said["panels"], &said["failed"]), (&2.into(), &0.into()));
    }
}

#[test]
fn a_table_that_was_cut_anywhere_is_made_whole() {
    let desk = Desk::new();
    // A design of three panels has three rows, which may be cut between.
    let quilt = r#"{ "sheetwright": 1, "curves": {
        "a": { "kind": "polyline", "points": [[0,0,0], [100,0,0]] },
        "b": { "kind": "polyline", "points": [[0,50,0], [100,50,9]] },
        "c": { "kind": "spline", "points": [[0,90,0], [50,100,10], [100,90,0]] } },
      "panels": [{ "name": "one", "rails": ["a", "b"], "samples": 9 },
                 { "name": "two", "rails": ["b", "-c"], "samples": 9 },
                 { "name": "three", "rails": ["a", "c"], "samples": 9 }] }"#;
    desk.write("quilt.sheet.json", quilt);
    desk.write("t.csv", &facade(4, 12).replace("p2,", "p2,-"));
    let mut random = Random::new(11);
    for form in ["csv", "jsonl"] {
        let call = format!("batch quilt.sheet.json t.csv --table rows.{form} --resume --quiet");
        let status = desk.command(&call).output().unwrap().status.code().unwrap();
        let whole = desk.read(&format!("rows.{form}"));
        assert!(whole.lines().count() >= 7, "{whole}");
        for n in 0..20 {
            let cut = if n == 0 { 0 } else { random.below(whole.len() + 1) };
            desk.write(&format!("rows.{form}"), &whole[..cut]);
            desk.says(&call, status);
            assert_eq!(desk.read(&format!("rows.{form}")), whole, "cut at {cut}");
        }
    }
}

#[test]
#[cfg(unix)]
fn a_batch_that_is_killed_ten_times_is_whole_in_the_end() {
    let desk = Desk::new();
    // As many rows as are made in a few seconds, and some files beside them.
    desk.write("t.csv", &facade(60, 40));
    let options = "--verdict exact --formats svg --threads 2 --quiet";
    desk.says(&format!("batch t.csv --out whole {options}"), 0);
    let mut random = Random::new(u64::from(std::process::id()));
    for _ in 0..10 {
        let mut child =
            desk.command(&format!("batch t.csv --out killed --resume {options}")).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(random.below(900) as u64));
        // SIGKILL; no program hears it.
        child.kill().unwrap();
        child.wait().unwrap();
    }
    desk.says(&format!("batch t.csv --out killed --resume {options}"), 0);
    assert_eq!(tree(&desk.path("killed")), tree(&desk.path("whole")));
}

/// All files below a folder, by their paths in it.
fn tree(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let below = path.strip_prefix(folder).unwrap().to_owned();
                files.push((below, fs::read(&path).unwrap()));
            }
        }
    }
    files.sort();
    files
}

#[test]
#[cfg(unix)]
fn a_batch_that_is_stopped_says_how_it_goes_on() {
    let desk = Desk::new();
    // Far more than are made before the signal comes, however loaded the machine is.
    desk.write("t.csv", &facade(1500, 60));
    let mut command = desk.command("batch t.csv --table rows.csv --verdict exact");
    let mut child = command.stderr(Stdio::piped()).spawn().unwrap();
    let has_rows = || fs::metadata(desk.path("rows.csv")).is_ok_and(|of| of.len() > 0);
    while !has_rows() {
        assert_eq!(child.try_wait().unwrap(), None);
        std::thread::sleep(Duration::from_millis(50));
    }
    let pid = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), None);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("stopped: --resume goes on with rows.csv"), "{said}");
    let table = desk.read("rows.csv");
    assert!(table.ends_with('\n') || table.is_empty(), "{table}");
}
