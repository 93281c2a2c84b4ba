//! Designs from templates.

use super::{Desk, names_in, text};
use serde_json::Value;
use std::fs;

#[test]
fn new_writes_a_design_that_is_made() {
    let desk = Desk::new(&[]);
    let (design, _) = desk.says("new hopper --set width=1m --set pieces=folded", 0);
    fs::write(desk.path("piped.sheet.json"), &design).unwrap();
    let (quiet, _) = desk.says("new hopper --set width=1m --set pieces=folded -o h.sheet.json", 0);
    assert_eq!(
        (quiet.as_str(), fs::read_to_string(desk.path("h.sheet.json")).unwrap()),
        ("", design)
    );
    let (words, _) = desk.says("check h.sheet.json", 0);
    assert!(words.starts_with("hopper: bends, with sharp folds\n"), "{words}");
    // A space is part of the value.
    let mut command = desk.command("new cone --set");
    let output = command.arg("height=1' 4 1/2\"").output().unwrap();
    assert!(text(&output.stdout).contains(",419.1]"));
}

#[test]
fn new_makes_at_once_where_it_is_asked_to() {
    let desk = Desk::new(&[]);
    let (words, _) = desk.says("new hemisphere --make out --quiet", 0);
    assert_eq!(words.lines().count(), 36);
    assert!(words.lines().all(|line| line.ends_with(": bends")));
    desk.says("new hemisphere -o alone.sheet.json", 0);
    let beside = fs::read(desk.path("out/hemisphere.sheet.json")).unwrap();
    assert_eq!(beside, fs::read(desk.path("alone.sheet.json")).unwrap());
    desk.says("make alone.sheet.json --out later", 0);
    for name in names_in(&desk.path("later")).iter().filter(|name| *name != "timing.json") {
        let [now, later] = ["out", "later"].map(|of| fs::read(desk.path(of).join(name)).unwrap());
        assert!(now == later, "{name}");
    }
    // What is refused leaves nothing behind.
    desk.says("new hemisphere --set bands=99 --make none", 2);
    desk.says("new hemisphere --make none -o both.sheet.json", 2);
    assert!(!desk.path("none").exists() && !desk.path("both.sheet.json").exists());
}

#[test]
fn new_says_what_there_is() {
    let desk = Desk::new(&[]);
    let (all, _) = desk.says("new --list", 0);
    let (one, _) = desk.says("new square-to-round --list", 0);
    assert!(all.starts_with("Templates:\n") && all.contains(&one));
    for words in
        ["\nsquare-to-round: ", "offset-x = 0 mm", "Also searched for as: ", "(20 mm to 10 m)"]
    {
        assert!(format!("\n{one}").contains(words), "{words}");
    }
    let (json, _) = desk.says("new --list --json", 0);
    let json: Value = serde_json::from_str(&json).unwrap();
    let templates = json["templates"].as_array().unwrap();
    assert!(templates.iter().any(|t| t["name"] == "dome" && t["parameters"][0]["unit"] == "mm"));
    let (page, _) = desk.says("man new", 0);
    assert!(page.contains("square\\-to\\-round") && page.contains("NAME=VALUE"));
    let (script, _) = desk.says("completions bash", 0);
    assert!(script.contains("square-to-round"));
}
