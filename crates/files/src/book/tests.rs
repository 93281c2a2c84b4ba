use super::*;
use crate::input::{InputFormat, read_bytes};
use crate::mesh::MeshFormat;
use crate::reading::ReadOptions;
use crate::{design_from_template, pdf::text_mm};
use sheetwright::math::{Point2, Vec2};
use sheetwright::predicate::Box2;
use sheetwright::{Unwatched, design::Design, make::make};

/// A line of text on a page, and the box around it, mm.
struct Text {
    words: String,
    around: Box2,
}

/// The bytes of a string of a content stream, as text: literal, or in hexadecimal digits.
fn read(string: &str) -> String {
    let bytes: Vec<u8> = match string.strip_prefix('<') {
        Some(hex) => {
            let digits: Vec<u32> = hex.chars().filter_map(|c| c.to_digit(16)).collect();
            digits.chunks(2).map(|pair| (pair[0] * 16 + pair[1]) as u8).collect()
        }
        None => string[1..string.len() - 1].replace('\\', "").into_bytes(),
    };
    // WinAnsi is Latin-1 but for a few signs, which are as wide as most letters here.
    bytes.into_iter().map(char::from).collect()
}

/// All texts of a page.
fn texts(page: PdfPage) -> (Vec2, Vec<Text>) {
    const MM: f64 = 25.4 / 72.0;
    let (size, content) = page.finish();
    let content = String::from_utf8_lossy(&content).into_owned();
    let (mut set, mut found) = ((String::new(), 0.0, [0.0; 2]), Vec::new());
    for line in content.lines() {
        let numbers: Vec<f64> = line.split(' ').filter_map(|word| word.parse().ok()).collect();
        if line.ends_with(" Tf") {
            set.0 = line[..3].to_owned();
            set.1 = numbers[0];
        } else if line.ends_with(" Tm") {
            set.2 = [numbers[4] * MM, numbers[5] * MM];
        } else if let Some(string) = line.strip_suffix(" Tj") {
            let words = read(string);
            let bold = if set.0 == "/F2" { 1.08 } else { 1.0 };
            let wide = bold * text_mm(&words, set.1);
            let min = Point2::new(set.2[0], set.2[1]);
            let max = min + Vec2::new(wide, 0.7 * set.1 * MM);
            found.push(Text { words, around: Box2 { min, max } });
        }
    }
    (size, found)
}

fn pages_of(design: &Design, paper: Paper) -> Vec<(Vec2, Vec<Text>)> {
    let made = make(design, &mut Unwatched).unwrap();
    let patterns = made.cut_list();
    let plans = crate::BrakeSettings::default().plans(&made);
    let book = Book { made: &made, patterns: &patterns, plans: Some(&plans), paper };
    book.pages().into_iter().map(texts).collect()
}

fn template(name: &str, settings: &[&str]) -> Design {
    let settings: Vec<String> = settings.iter().map(|&setting| setting.to_owned()).collect();
    design_from_template(name, &settings).unwrap()
}

/// An octahedron, as a mesh of flat facets.
fn net() -> Design {
    let mut text = String::new();
    for corner in ["1 0 0", "-1 0 0", "0 1 0", "0 -1 0", "0 0 1", "0 0 -1"] {
        text += &format!("v {corner}\n");
    }
    for (a, b) in [(1, 3), (3, 2), (2, 4), (4, 1)] {
        text += &format!("f {a} {b} 5\nf {b} {a} 6\n");
    }
    let mut options = ReadOptions::default();
    options.mesh.facets = Some(true);
    let format = InputFormat::Mesh(MeshFormat::Obj);
    read_bytes(format, text.as_bytes(), "net", None, &options).unwrap()
}

/// The parts of the dinghy with names that are longer than a line.
fn long_names() -> Design {
    let mut design = template("dinghy", &[]);
    design.name = format!("{} (on paper)", "the boat of many words ".repeat(9).trim());
    for panel in &mut design.panels {
        panel.name = format!("{}-{}", panel.name, "of-a-very-long-name".repeat(8));
    }
    design
}

#[test]
fn every_text_lies_on_its_page_and_on_no_other_text() {
    let designs = [
        (template("dinghy", &[]), Paper::A4),
        (template("elbow", &["segments=4"]), Paper::Letter),
        (template("cone", &[]), Paper::Letter),
        (long_names(), Paper::A4),
        (net(), Paper::A4),
    ];
    for (design, paper) in designs {
        for (number, (size, texts)) in pages_of(&design, paper).into_iter().enumerate() {
            let what = format!("{}, page {}", design.name, number + 1);
            for (n, text) in texts.iter().enumerate() {
                let Box2 { min, max } = text.around;
                let is_inside =
                    min.x > 9.0 && min.y > 9.0 && max.x < size.x - 9.0 && max.y < size.y - 9.0;
                assert!(is_inside, "{what}: '{}' at {min:?}–{max:?}", text.words);
                for other in &texts[..n] {
                    let (a, b) = (text.around, other.around);
                    let apart = a.max.x <= b.min.x
                        || b.max.x <= a.min.x
                        || a.max.y <= b.min.y
                        || b.max.y <= a.min.y;
                    assert!(apart, "{what}: '{}' on '{}'", text.words, other.words);
                }
            }
        }
    }
}

#[test]
fn a_book_has_its_chapters_and_numbers_its_pages() {
    let pages = pages_of(&template("elbow", &[]), Paper::A4);
    let count = pages.len();
    for (n, (_, texts)) in pages.iter().enumerate() {
        let wanted = format!("{} of {count}", n + 1);
        assert!(texts.iter().any(|text| text.words == wanted), "{wanted}");
    }
    let all: Vec<&str> =
        pages.iter().flat_map(|(_, texts)| texts.iter().map(|text| &text.words[..])).collect();
    let chapters = ["What to buy", "Parts", "Order of joining", "Checks to make", "Notes"];
    for chapter in chapters {
        assert!(all.contains(&chapter), "{chapter}");
    }
    // Two patterns, each once, with its count; every step with the edges that it joins.
    for wanted in ["1. segment-1: cut 2", "2. segment-2: cut 3", "2. Add segment-1"] {
        assert_eq!(all.iter().filter(|&&text| text == wanted).count(), 1, "{wanted}");
    }
    let seam = "(2) cut-1b to segment-2, 634.5\u{a0}mm";
    assert!(all.contains(&seam), "{all:?}");
}

#[test]
fn parts_that_nothing_joins_have_no_order() {
    let square = "x,y,z,corner\n0,0,0,1\n100,0,0,1\n100,100,0,1\n0,100,0,1\n";
    let options = ReadOptions::default();
    let alone = read_bytes(InputFormat::Table, square.as_bytes(), "s.csv", None, &options).unwrap();
    let has_order = |design: &Design| {
        let mut texts = pages_of(design, Paper::A4).into_iter().flat_map(|(_, texts)| texts);
        texts.any(|text| text.words == "Order of joining")
    };
    assert!(!has_order(&alone));
    assert!(has_order(&template("ramp", &[])));
}

#[test]
fn a_panel_that_is_cut_several_times_counts_as_often() {
    let mut design = template("cone", &[]);
    design.panels[0].count = 3;
    let words = |design: &Design| -> Vec<String> {
        let pages = pages_of(design, Paper::A4);
        pages.into_iter().flat_map(|(_, texts)| texts.into_iter().map(|text| text.words)).collect()
    };
    let three = words(&design);
    assert!(three.iter().any(|text| text == "3 from 1 pattern"), "{three:?}");
    assert!(three.iter().any(|text| text == "3 parts from 1 pattern"), "{three:?}");
    let free = |words: &[String]| {
        let n = words.iter().position(|text| text == "Free edges").unwrap();
        words[n + 1].split('\u{a0}').next().unwrap().parse::<f64>().unwrap()
    };
    design.panels[0].count = 1;
    let ratio = free(&three) / free(&words(&design));
    assert!((ratio - 3.0).abs() < 0.02, "{ratio}");
}

#[test]
fn too_many_lines_say_how_many_more_there_are() {
    let lines = |count: usize| (0..count).map(|n| n.to_string()).collect::<Vec<_>>();
    assert_eq!(first_lines(lines(5), 5), lines(5));
    let short = first_lines(lines(9), 5);
    assert_eq!(short[..4], lines(4));
    assert_eq!(short[4], "… and 5 more lines: the patterns name all edges.");
}

#[test]
fn marks_that_follow_one_another_are_a_range() {
    let marks = |list: &[&str]| list.iter().map(|&mark| mark.to_owned()).collect::<Vec<_>>();
    let all = marks(&["S10", "S1", "S1", "S9", "S3", "S2", "S12"]);
    assert_eq!(ranges(all), "S1–S3, S9–S10, S12");
    assert_eq!(ranges(marks(&["keel", "chine"])), "keel, chine");
    assert_eq!(ranges(Vec::new()), "");
}

#[test]
fn lengths_that_differ_are_both_said() {
    assert_eq!(both_lengths(100.0, 100.04), "100.0\u{a0}mm");
    assert_eq!(both_lengths(100.0, 100.4), "100.0\u{a0}mm, the other 100.4\u{a0}mm");
}
