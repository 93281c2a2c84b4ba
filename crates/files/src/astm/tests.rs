//! A strict reader of ASTM D6673, and what it reads of written files.

use super::*;
use sheetwright::math::Vec2;
use std::collections::BTreeMap;

/// A piece as the standard has it.
#[derive(Debug, Default, PartialEq)]
struct ReadPiece {
    texts: BTreeMap<String, String>,
    boundary: Vec<Point2>,
    points: BTreeMap<String, Vec<Point2>>,
    closed: BTreeMap<String, Vec<Vec<Point2>>>,
    open: BTreeMap<String, Vec<Vec<Point2>>>,
    grain: Vec<[Point2; 2]>,
    depths: Vec<f64>,
    annotations: Vec<String>,
}

type Entity<'a> = (&'a str, BTreeMap<u16, &'a str>);

/// The entities of a file: every pair, of codes that the standard has, in ASCII.
fn entities(bytes: &[u8]) -> Vec<Entity<'_>> {
    let text = std::str::from_utf8(bytes).unwrap();
    assert!(text.is_ascii(), "seven bits");
    let lines: Vec<&str> = text.split_terminator("\r\n").collect();
    assert_eq!(lines.len() % 2, 0);
    let mut found: Vec<Entity<'_>> = Vec::new();
    for pair in lines.chunks_exact(2) {
        let code: u16 = pair[0].trim().parse().unwrap();
        match code {
            0 => found.push((pair[1], BTreeMap::new())),
            _ => assert!(found.last_mut().unwrap().1.insert(code, pair[1]).is_none(), "{pair:?}"),
        }
    }
    found
}

fn at(values: &BTreeMap<u16, &str>, code: u16) -> Point2 {
    let number = |code: u16| values[&code].parse::<f64>().unwrap();
    assert_eq!(number(code + 20), 0.0);
    Point2::new(number(code), number(code + 10))
}

/// The style's texts, and the pieces by the names of their blocks. Panics at anything that the
/// standard does not have.
fn read(bytes: &[u8]) -> (BTreeMap<String, String>, BTreeMap<String, ReadPiece>) {
    let found = entities(bytes);
    let sections: Vec<&str> =
        found.iter().filter(|(kind, _)| *kind == "SECTION").map(|(_, values)| values[&2]).collect();
    assert_eq!(sections, ["HEADER", "BLOCKS", "ENTITIES"]);
    assert_eq!(found[0].1.len() + found[1].1.len(), 1, "the header is empty");
    assert_eq!(found.last().unwrap().0, "EOF");
    let (mut style, mut pieces) = (BTreeMap::new(), BTreeMap::new());
    let (mut inserted, mut block): (Vec<&str>, Option<(String, ReadPiece)>) = (Vec::new(), None);
    let mut polyline: Option<(&str, bool, Vec<Point2>)> = None;
    for (kind, values) in &found {
        let layer = values.get(&8).copied().unwrap_or_default();
        match (*kind, &mut block, &mut polyline) {
            ("SECTION" | "ENDSEC" | "EOF", None, None) => {}
            ("BLOCK", None, None) => {
                let name = values[&2];
                assert!(name.len() <= 31 && !name.contains(' '), "{name}");
                assert_eq!((layer, at(values, 10)), ("1", Point2::default()));
                block = Some((name.to_owned(), ReadPiece::default()));
            }
            ("ENDBLK", Some(_), None) => {
                let (name, piece) = block.take().unwrap();
                assert!(pieces.insert(name, piece).is_none(), "two blocks of one name");
            }
            ("INSERT", None, None) => inserted.push(values[&2]),
            ("TEXT", None, None) => {
                let (key, value) = values[&1].split_once(": ").unwrap();
                style.insert(key.to_owned(), value.to_owned());
            }
            ("TEXT", Some((_, piece)), None) if layer == "1" => {
                let (key, value) = values[&1].split_once(": ").unwrap();
                assert!(piece.texts.insert(key.to_owned(), value.to_owned()).is_none());
            }
            ("TEXT", Some((_, piece)), None) if layer == "15" => {
                piece.annotations.push(values[&1].to_owned());
            }
            ("POINT", Some((_, piece)), None) => {
                assert!(["2", "3", "4", "13"].contains(&layer), "{layer}");
                piece.points.entry(layer.to_owned()).or_default().push(at(values, 10));
                piece.depths.extend(values.get(&39).map(|depth| depth.parse::<f64>().unwrap()));
            }
            ("LINE", Some((_, piece)), None) if layer == "7" => {
                piece.grain.push([at(values, 10), at(values, 11)]);
            }
            ("POLYLINE", Some(_), None) => {
                assert!(["1", "6", "8", "11", "14"].contains(&layer), "{layer}");
                polyline = Some((layer, values[&70] == "1", Vec::new()));
            }
            ("VERTEX", Some(_), Some((of, _, points))) if *of == layer => {
                points.push(at(values, 10));
            }
            ("SEQEND", Some((_, piece)), Some(_)) => {
                let (layer, closed, points) = polyline.take().unwrap();
                match (layer, closed) {
                    ("1", true) => {
                        assert!(piece.boundary.is_empty(), "one boundary");
                        piece.boundary = points;
                    }
                    (_, true) => piece.closed.entry(layer.to_owned()).or_default().push(points),
                    (_, false) => piece.open.entry(layer.to_owned()).or_default().push(points),
                }
            }
            other => panic!("{:?} on layer {layer}", other.0),
        }
    }
    let names: Vec<&str> = pieces.keys().map(String::as_str).collect();
    inserted.sort_unstable();
    assert_eq!(inserted, names, "one insert a block");
    (style, pieces)
}

fn loop_of(corners: &[(f64, f64)]) -> Vec<Point2> {
    corners.iter().map(|&(x, y)| Point2::new(x, y)).collect()
}

#[test]
fn what_a_cutter_needs_comes_back() {
    let cut =
        loop_of(&[(-10.0, -10.0), (110.0, -10.0), (110.0, 60.0), (50.0, 61.0), (-10.0, 60.0)]);
    let net = loop_of(&[(0.0, 0.0), (100.0, 0.0), (100.0, 50.0), (0.0, 50.0)]);
    let window = loop_of(&[(10.0, 10.0), (10.0, 20.0), (20.0, 20.0)]);
    let drilled = loop_of(&[(72.0, 30.0), (70.0, 28.0), (68.0, 30.0), (70.0, 32.0)]);
    let path = |role, kind, points, closed| PatternPath { role, kind, points, closed };
    let paths = vec![
        path(Role::Cut, PathKind::Outline, cut.clone(), true),
        path(Role::Inner, PathKind::Hole, window.clone(), true),
        path(Role::Net, PathKind::Net, net.clone(), true),
        path(Role::Drill, PathKind::Drill { diameter_mm: 4.0 }, drilled, true),
        path(Role::Cut, PathKind::Notch, loop_of(&[(30.0, -10.0), (30.0, -5.0)]), false),
        path(Role::Score, PathKind::Crease, loop_of(&[(0.0, 0.0), (100.0, 50.0)]), false),
        path(Role::Note, PathKind::OnFold, loop_of(&[(0.0, 0.0), (100.0, 0.0)]), false),
        path(Role::Note, PathKind::Dimension, loop_of(&[(0.0, -20.0), (100.0, -20.0)]), false),
    ];
    let label = |role, text: &str| PatternLabel {
        kind: LabelKind::Name,
        role,
        at: Point2::new(40.0, 30.0),
        along: Vec2::X,
        height_mm: 6.0,
        text: text.to_owned(),
    };
    let labels = vec![label(Role::Engrave, "Rücken 板"), label(Role::Note, "100 mm")];
    let (name, size) = ("Rücken 板".into(), Vec2::new(100.0, 50.0));
    let piece = Piece {
        is_folded: false,
        name,
        paths,
        labels,
        bends: Vec::new(),
        border: Vec::new(),
        corner: Point2::default(),
        size,
    };
    let other = Piece { name: "R_cken__".into(), labels: Vec::new(), ..piece.clone() };
    let bytes = written(
        "Jacke",
        Some("felt"),
        &[
            (&piece, Quantity { count: 2, mirrored: 1 }),
            (&other, Quantity { count: 1, mirrored: 0 }),
        ],
    );
    let (style, pieces) = read(&bytes);
    assert_eq!((&style["Units"][..], &style["Style Name"][..]), ("METRIC", "Jacke"));
    assert_eq!(style["ASTM/D13Proposal 1 Version"], "D 6673-04");
    assert_eq!(pieces.keys().collect::<Vec<_>>(), ["R_cken__", "R_cken___2"]);
    let read = &pieces["R_cken__"];
    assert_eq!((&read.texts["Size"][..], &read.texts["Fabric"][..]), ("1", "felt"));
    assert_eq!(read.texts["Piece Name"], "R\\U+00FCcken \\U+677F");
    assert_eq!(read.boundary, cut);
    // The point at the top turns by 2 degrees alone.
    assert_eq!((read.points["2"].len(), &read.points["3"][..]), (4, &cut[3..4]));
    assert_eq!((&read.closed["11"], &read.closed["14"]), (&vec![window], &vec![net]));
    assert!(read.points["13"][0].distance(Point2::new(70.0, 30.0)) < 1e-12);
    assert_eq!((read.points["4"][0], &read.depths[..]), (Point2::new(30.0, -10.0), &[5.0][..]));
    assert_eq!(read.grain, [[Point2::new(20.0, 30.0), Point2::new(80.0, 30.0)]]);
    assert_eq!(read.open["6"], [loop_of(&[(0.0, 0.0), (100.0, 0.0)])], "on the fold");
    assert_eq!(read.open["8"], [loop_of(&[(0.0, 0.0), (100.0, 50.0)])], "no dimensions");
    assert_eq!(read.annotations, ["R\\U+00FCcken \\U+677F"]);
}

#[test]
fn a_grain_that_is_marked_takes_the_place_of_the_usual_line() {
    let path = |role, kind, points, closed| PatternPath { role, kind, points, closed };
    let outline = loop_of(&[(0.0, 0.0), (100.0, 0.0), (100.0, 50.0), (0.0, 50.0)]);
    let arrow = loop_of(&[(20.0, 10.0), (50.0, 40.0), (48.0, 39.0), (50.0, 40.0), (49.0, 38.0)]);
    let paths = vec![
        path(Role::Cut, PathKind::Outline, outline, true),
        path(Role::Engrave, PathKind::Grain, arrow.clone(), false),
        path(Role::Engrave, PathKind::Station, loop_of(&[(10.0, 0.0), (10.0, 50.0)]), false),
    ];
    let (name, size) = ("front".into(), Vec2::new(100.0, 50.0));
    let (labels, bends, corner) = (Vec::new(), Vec::new(), Point2::default());
    let border = Vec::new();
    let piece = Piece { name, paths, labels, bends, border, corner, size, is_folded: false };
    let (_, pieces) = read(&written("bag", None, &[(&piece, Quantity { count: 1, mirrored: 0 })]));
    assert_eq!(pieces["front"].grain, [[arrow[0], arrow[1]]]);
    assert_eq!(pieces["front"].open["8"], [loop_of(&[(10.0, 0.0), (10.0, 50.0)])]);
}
