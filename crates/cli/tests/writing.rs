//! Writing files: together or not at all, with few files open, whatever ends the command, and with
//! names that a terminal could obey.

#![allow(clippy::unwrap_used, reason = "a test that can't go on fails")]
#![allow(clippy::print_stderr, reason = "what is skipped says so")]
#![cfg(unix)]

use std::fmt::Write as _;
use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

const SQUARE: &str = "x,y,z,corner\n0,0,0,1\n100,0,0,1\n100,100,0,1\n0,100,0,1\n";
const PROGRAM: &str = env!("CARGO_BIN_EXE_sheetwright");

/// A folder with a square and a design of many small panels.
fn desk(panels: usize) -> tempfile::TempDir {
    let desk = tempfile::tempdir().unwrap();
    fs::write(desk.path().join("square.csv"), SQUARE).unwrap();
    let mut list = String::new();
    for n in 0..panels {
        let comma = if n == 0 { "" } else { "," };
        let panel = r#""rails": ["a", "b"], "samples": 3"#;
        write!(list, "{comma}{{ \"name\": \"p{n}\", {panel} }}").unwrap();
    }
    let curves = r#""a": { "kind": "polyline", "points": [[0,0,0], [100,0,0]] },
        "b": { "kind": "polyline", "points": [[0,50,0], [100,50,0]] }"#;
    let design =
        format!("{{ \"sheetwright\": 1, \"curves\": {{ {curves} }}, \"panels\": [{list}] }}");
    fs::write(desk.path().join("many.sheet.json"), design).unwrap();
    desk
}

fn command(folder: &Path, args: &str) -> Command {
    let mut command = Command::new(PROGRAM);
    command.current_dir(folder).args(args.split_whitespace());
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

fn said(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// What a call says on standard error; it ends with this status.
fn says(folder: &Path, args: &str, status: i32) -> String {
    let output = command(folder, args).output().unwrap();
    assert_eq!(output.status.code(), Some(status), "{args}: {}", said(&output));
    said(&output)
}

fn names_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn temporary(folder: &Path) -> Vec<String> {
    let all = if folder.exists() { names_in(folder) } else { Vec::new() };
    all.into_iter().filter(|name| name.starts_with(".sheetwright-")).collect()
}

#[test]
fn many_panels_need_few_open_files() {
    let desk = desk(200);
    let mut shell = Command::new("sh");
    shell.current_dir(desk.path()).arg("-c").arg("ulimit -n 64; exec \"$0\" \"$@\"").arg(PROGRAM);
    shell.args(["make", "many.sheet.json", "--out", "out", "--formats", "svg", "--each-part"]);
    let output = shell.stdin(Stdio::null()).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert_eq!(names_in(&desk.path().join("out")).len(), 200);
}

/// Others may write to a folder with the sticky bit, but not replace what is not theirs.
#[test]
fn where_one_file_may_not_be_replaced_none_is_written() {
    let desk = desk(1);
    let (program, out) = (desk.path().join("sheetwright"), desk.path().join("out"));
    fs::copy(PROGRAM, &program).unwrap();
    fs::create_dir(&out).unwrap();
    let open = |path: &Path, mode| fs::set_permissions(path, fs::Permissions::from_mode(mode));
    open(desk.path(), 0o755).unwrap();
    open(&out, 0o1777).unwrap();
    fs::write(out.join("pattern.pdf"), "old").unwrap();
    let mut other = Command::new("setpriv");
    other.args(["--reuid=65534", "--regid=65534", "--clear-groups"]).arg(&program);
    other.current_dir(desk.path()).args(["make", "square.csv", "--out", "out"]);
    let may_run = Command::new("setpriv")
        .args(["--reuid=65534", "--regid=65534", "--clear-groups", "true"])
        .status()
        .is_ok_and(|status| status.success());
    if !may_run {
        eprintln!("skipped: only root with the command `setpriv` can act as another user");
        return;
    }
    let output = other.stdin(Stdio::null()).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    let words = "error: out/pattern.pdf: the file there may not be replaced\nhint: It belongs to";
    assert!(said(&output).starts_with(words), "{}", said(&output));
    assert_eq!(names_in(&out), ["pattern.pdf"]);
    assert_eq!(fs::read(out.join("pattern.pdf")).unwrap(), b"old");
}

/// What the others were before is put back where one file can't have its name.
#[test]
fn files_that_were_there_come_back_where_one_can_not_be_replaced() {
    let desk = desk(1);
    let out = desk.path().join("out");
    fs::create_dir(&out).unwrap();
    fs::write(out.join("surface.obj"), "old").unwrap();
    symlink("surface.obj", out.join("square.svg")).unwrap();
    says(desk.path(), "make square.csv --out out", 0);
    assert!(!out.join("square.svg").is_symlink());
    fs::write(out.join("surface.obj"), "old").unwrap();
    let attribute = |sign| Command::new("chattr").arg(sign).arg(out.join("report.json")).status();
    if !attribute("+i").is_ok_and(|status| status.success()) {
        eprintln!("skipped: this user or this disk knows no file that can't be replaced");
        return;
    }
    let output = command(desk.path(), "make square.csv --out out").output().unwrap();
    assert!(attribute("-i").unwrap().success());
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(
        said(&output).starts_with("error: out/report.json: the file there may not be replaced")
    );
    assert_eq!(fs::read(out.join("surface.obj")).unwrap(), b"old");
    assert!(temporary(&out).is_empty(), "{:?}", names_in(&out));
}

fn signal(child: &Child, name: &str) {
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-s", name, &id]).status().unwrap().success());
}

/// Starts to make many panels, and waits until files are written.
fn writing(folder: &Path) -> Child {
    let mut make =
        command(folder, "make many.sheet.json --out out --formats svg --each-part --quiet");
    let child = make.spawn().unwrap();
    let start = Instant::now();
    while temporary(&folder.join("out")).is_empty() {
        assert!(start.elapsed() < Duration::from_secs(120));
        thread::sleep(Duration::from_micros(200));
    }
    child
}

/// Whether all files of a folder are old, or all new.
fn is_one_batch(out: &Path) -> bool {
    let old =
        names_in(out).iter().filter(|name| fs::read(out.join(name)).unwrap() == b"old").count();
    old == 0 || old == names_in(out).len()
}

#[test]
fn a_signal_leaves_nothing_half_done() {
    use std::os::unix::process::ExitStatusExt;
    const PANELS: usize = 600;
    let desk = desk(PANELS);
    let out = desk.path().join("out");
    for (n, (name, number)) in [("TERM", 15), ("INT", 2)].iter().cycle().take(12).enumerate() {
        let _ = fs::remove_dir_all(&out);
        let has_old = n % 3 != 0;
        if has_old {
            fs::create_dir(&out).unwrap();
            for n in 0..PANELS {
                fs::write(out.join(format!("p{n}.svg")), "old").unwrap();
            }
        }
        let mut child = writing(desk.path());
        thread::sleep(Duration::from_millis(3 * n as u64));
        signal(&child, name);
        let status = child.wait().unwrap();
        // The shell sees the signal; or the command was done before it came.
        assert!(status.signal() == Some(*number) || status.code() == Some(0), "{status}");
        if !out.exists() {
            assert!(!has_old && status.signal().is_some());
            continue;
        }
        assert_eq!(names_in(&out).len(), PANELS, "{:?}", temporary(&out));
        assert!(is_one_batch(&out), "after {name}");
    }
}

/// A shell has what runs in the background ignore Ctrl-C, and so does the command.
#[test]
fn a_signal_that_is_ignored_stays_so() {
    let desk = desk(600);
    let mut shell = Command::new("sh");
    shell.current_dir(desk.path()).stdin(Stdio::null()).stdout(Stdio::null());
    let script = "trap '' INT; exec \"$0\" make many.sheet.json --out out --formats svg --quiet";
    let mut child = shell.arg("-c").arg(script).arg(PROGRAM).spawn().unwrap();
    while temporary(&desk.path().join("out")).is_empty() {
        thread::sleep(Duration::from_micros(200));
    }
    signal(&child, "INT");
    let status = child.wait().unwrap();
    assert_eq!(status.code(), Some(0).filter(|_| cfg!(target_os = "linux")), "{status}");
}

#[test]
fn the_next_run_removes_what_a_kill_has_left() {
    let desk = desk(600);
    let out = desk.path().join("out");
    let mut left = 0;
    for n in 0..6 {
        let mut child = writing(desk.path());
        thread::sleep(Duration::from_millis(2 * n));
        signal(&child, "KILL");
        child.wait().unwrap();
        left += temporary(&out).len();
    }
    assert!(left > 0, "no kill came in time");
    // What is not ours stays, whatever it is called.
    fs::create_dir_all(out.join(".sheetwright-mine")).unwrap();
    fs::write(out.join(".sheetwright-mine/notes.txt"), "mine").unwrap();
    says(desk.path(), "make square.csv --out out --formats svg", 0);
    assert_eq!(temporary(&out), [".sheetwright-mine"]);
    assert_eq!(fs::read(out.join(".sheetwright-mine/notes.txt")).unwrap(), b"mine");
}

#[test]
fn two_runs_at_once_leave_each_other_alone() {
    let desk = desk(600);
    let mut first = writing(desk.path());
    for n in 0..10 {
        says(desk.path(), &format!("new cone -o out/cone-{n}.sheet.json"), 0);
    }
    let many: Vec<Child> = (0..4).map(|_| writing(desk.path())).collect();
    assert!(first.wait().unwrap().success());
    for mut child in many {
        assert!(child.wait().unwrap().success());
    }
    assert!(temporary(&desk.path().join("out")).is_empty());
    assert_eq!(names_in(&desk.path().join("out")).len(), 610);
}

#[test]
fn read_only_files_are_not_replaced() {
    let desk = desk(1);
    let out = desk.path().join("out");
    fs::create_dir(&out).unwrap();
    for (file, call) in [
        ("out/report.json", "make square.csv --out out"),
        ("cone.sheet.json", "new cone -o cone.sheet.json"),
        ("square.obj", "convert square.csv square.obj"),
    ] {
        fs::write(desk.path().join(file), "mine").unwrap();
        let read_only = fs::Permissions::from_mode(0o444);
        fs::set_permissions(desk.path().join(file), read_only).unwrap();
        let words = says(desk.path(), call, 2);
        let wanted = format!("error: {file}: the file there is read-only\nhint: Make it writable,");
        assert!(words.starts_with(&wanted), "{words}");
        assert_eq!(fs::read(desk.path().join(file)).unwrap(), b"mine");
    }
    assert_eq!(names_in(&out), ["report.json"]);
}

#[test]
fn links_are_followed_or_named() {
    let desk = desk(1);
    symlink("nowhere", desk.path().join("link")).unwrap();
    for call in ["make square.csv --out link", "make square.csv --out link/deeper"] {
        let words = says(desk.path(), call, 2);
        let wanted = "error: link: this link leads to 'nowhere', which is not there\nhint: Create";
        assert!(words.starts_with(wanted), "{words}");
    }
    let words = says(desk.path(), "make square.csv --out square.csv/deeper", 2);
    assert!(words.starts_with("error: square.csv: this is no folder\n"), "{words}");
    // A link to a design stays a link, as with any other program that saves a file.
    fs::write(desk.path().join("real.sheet.json"), "old").unwrap();
    symlink("real.sheet.json", desk.path().join("linked.sheet.json")).unwrap();
    says(desk.path(), "new cone -o linked.sheet.json", 0);
    assert!(desk.path().join("linked.sheet.json").is_symlink());
    says(desk.path(), "check real.sheet.json", 0);
    // What is no file is written to, and not replaced.
    symlink("/dev/null", desk.path().join("null")).unwrap();
    says(desk.path(), "new cone -o null", 0);
    assert!(desk.path().join("null").is_symlink() && !Path::new("/dev/null").is_file());
}

#[test]
fn no_path_commands_the_terminal() {
    let desk = desk(1);
    let odd = "\u{1b}[31mred\u{9b}2J\nerror: \u{202e}b.csv";
    let run = |args: &[&str]| {
        let mut command = command(desk.path(), "");
        command.args(args).stdout(Stdio::piped()).output().unwrap()
    };
    fs::write(desk.path().join(odd), SQUARE).unwrap();
    for args in [
        &["check", "no\u{1b}[31m.csv"][..],
        &["check", odd],
        &["check", "square.csv", "--material", odd],
        &["make", "square.csv", "--out", "square.csv/\u{1b}c"],
        &["convert", "square.csv", odd],
        &["new", odd],
        &["new", "cone", "--set", odd],
        &[odd],
        &["make", "square.csv", "--formats", "svg", "--out", "\u{1b}[31m\nout"],
    ] {
        let output = run(args);
        let texts =
            [&output.stdout, &output.stderr].map(|b| String::from_utf8_lossy(b).into_owned());
        for text in texts {
            let obeyed = |c: char| c.is_control() && c != '\n' || c == '\u{202e}';
            assert!(!text.contains(obeyed), "{args:?}: {text:?}");
            assert!(text.lines().count() <= 2, "{args:?}: {text}");
        }
        let output = run(&[args, &["--json"]].concat());
        let text = String::from_utf8(output.stderr).unwrap();
        assert!(!text.contains(|c: char| c.is_control() && c != '\n'), "{text:?}");
    }
}
