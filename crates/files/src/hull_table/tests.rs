//! One hull in every notation and form that builders use, and what is refused.

use super::*;
use crate::units::Units;
use std::fmt::Write as _;

/// A small hull in sixteenths of an inch: name, half-breadths and heights at the stations.
type Lines = Vec<(&'static str, Vec<[u32; 2]>)>;

const PLACES: [u32; 4] = [0, 384, 768, 1200];

fn hull() -> Lines {
    vec![
        ("Sheer", vec![[413, 310], [500, 297], [455, 320], [180, 377]]),
        ("Chine", vec![[300, 95], [366, 80], [301, 111], [96, 203]]),
        ("Keel", vec![[0, 30], [0, 0], [0, 21], [0, 160]]),
    ]
}

fn eighths(sixteenths: u32) -> String {
    let odd = if sixteenths % 2 == 1 { "+" } else { "" };
    let (feet, inches) = (sixteenths / 192, sixteenths % 192 / 16);
    format!("{feet}-{inches}-{}{odd}", sixteenths % 16 / 2)
}

fn marked(sixteenths: u32) -> String {
    let (feet, inches) = (sixteenths / 192, sixteenths % 192 / 16);
    format!("{feet}'-{inches} {}/16\"", sixteenths % 16)
}

fn fraction(sixteenths: u32) -> String {
    format!("{} {}/16", sixteenths / 16, sixteenths % 16)
}

fn millimetres(sixteenths: u32) -> String {
    format!("{}", f64::from(sixteenths) * 25.4 / 16.0)
}

/// Heights and half-breadths in two blocks, stations across.
fn blocks(of: &dyn Fn(u32) -> String, separator: &str, position: &str) -> String {
    let cell = |n: u32| {
        let text = of(n);
        let is_quoted = separator == "," && text.contains([',', '"']);
        if is_quoted { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
    };
    let row = |name: &str, list: &[u32]| {
        let cells: Vec<String> = list.iter().map(|&n| cell(n)).collect();
        format!("{name}{separator}{}\n", cells.join(separator))
    };
    let mut text = format!("Station{separator}Sta 0{separator}Sta 1{separator}Sta 2{separator}");
    text.push_str("Sta 3\n");
    text.push_str(&row(position, &PLACES));
    for (title, of) in [("Heights above base", 1), ("Half-breadths", 0)] {
        writeln!(text, "\n{title}").unwrap();
        for (name, points) in hull() {
            if of == 0 && name == "Keel" {
                continue;
            }
            text.push_str(&row(name, &points.iter().map(|p| p[of]).collect::<Vec<u32>>()));
        }
    }
    text
}

/// Both columns of every line beside one another, stations down.
fn columns(of: &dyn Fn(u32) -> String) -> String {
    let mut text =
        "Station\tx\tSheer height\tSheer half-breadth\tChine height\tChine half-breadth\t\
                    Keel height\tKeel half-breadth\n"
            .to_owned();
    for (n, place) in PLACES.iter().enumerate() {
        write!(text, "{n}\t{}", of(*place)).unwrap();
        for (_, points) in hull() {
            let [half, height] = points[n];
            write!(text, "\t{}\t{}", of(height), of(half)).unwrap();
        }
        text.push('\n');
    }
    text
}

fn read(text: &str, units: Option<Units>) -> HullTable {
    let units = GivenUnits { asked: units, usual: None };
    match read_hull_table(text.as_bytes(), "hull.csv", false, None, units) {
        Ok(table) => table,
        Err(error) => panic!("{error} / {}\n{text}", error.hint),
    }
}

fn refused(text: &str) -> InputError {
    read_hull_table(text.as_bytes(), "hull.csv", false, None, GivenUnits::default()).unwrap_err()
}

fn is_the_hull(table: &HullTable) {
    assert_eq!(table.lines.len(), 3);
    for (line, (name, points)) in table.lines.iter().zip(hull()) {
        assert_eq!((&line.name[..], line.points.len()), (name, 4));
        for ((point, place), [half, height]) in line.points.iter().zip(PLACES).zip(points) {
            let mm = |sixteenths: u32| f64::from(sixteenths) * 25.4 / 16.0;
            let off = [point.at.x - mm(place), point.at.y - mm(half), point.at.z - mm(height)];
            assert!(off.iter().all(|off| off.abs() < 1e-9), "{name}: {off:?}");
        }
    }
}

#[test]
fn every_notation_gives_the_hull() {
    let comma = |n: u32| millimetres(n).replace('.', ",");
    let units = |n: u32| format!("{} mm", millimetres(n));
    for (of, what) in [
        (&eighths as &dyn Fn(u32) -> String, "eighths"),
        (&marked, "marks"),
        (&fraction, "fractions"),
        (&millimetres, "mm"),
        (&comma, "decimal comma"),
        (&units, "units"),
    ] {
        for separator in [";", "\t"] {
            let text = blocks(of, separator, "Position");
            assert!(is_hull_table(&text), "{what}");
            is_the_hull(&read(&text, None));
        }
        let text = columns(of);
        assert!(is_hull_table(&text), "{what}");
        is_the_hull(&read(&text, None));
    }
    is_the_hull(&read(&blocks(&eighths, ",", "Position"), None));
    is_the_hull(&read(&blocks(&marked, ",", "Position"), None));
    let inches = |n: u32| format!("{}", f64::from(n) / 16.0);
    is_the_hull(&read(&blocks(&inches, ",", "Distance from bow"), Some(Units::Inches)));
    is_the_hull(&read(&format!("Offsets in inches\n{}", blocks(&inches, ",", "x")), None));
}

#[test]
fn stations_have_places_by_spacing_or_by_their_names() {
    let spaced = "Station spacing, 2-0-0\nStation,0,1,2\nHeights\nSheer,1-0-0,1-1-0,1-2-0\n\
                  Half-breadths\nSheer,1-0-0,2-0-0,1-0-0\n";
    let places =
        |text: &str, units| read(text, units).stations.iter().map(|s| s.1).collect::<Vec<f64>>();
    assert_eq!(places(spaced, None), [0.0, 609.6, 1219.2]);
    let named = "Station,0,600,1200\nSheer height,500,510,520\nSheer half-breadth,400,420,300\n";
    assert_eq!(places(named, None), [0.0, 600.0, 1200.0]);
    let remark = "axis,name,1,2\nheights,sheer,1-0-0,1-1-0\nwidths,sheer,1-0-0,2-0-0\n\
                  # Stations are 24\" apart\n";
    assert_eq!(places(remark, None), [609.6, 1219.2]);
    let mere = refused("Station,0,1,2\nSheer height,500,510,520\nSheer HB,400,420,300\n");
    assert!(mere.message.contains("where the stations are"), "{mere}");
}

#[test]
fn waterlines_and_buttocks_have_what_their_names_say() {
    let text = "Stations,0,1000,2000\nHalf-breadths\nWL 100,300,400,200\nWL 200,350,450,-\n\
                Heights\nButtock 150,20,30,x\nDiagonal A,1,2,3\n";
    let table = read(text, Some(Units::Millimetres));
    let names: Vec<&str> = table.lines.iter().map(|line| &line.name[..]).collect();
    assert_eq!(names, ["WL 100", "WL 200", "Buttock 150"]);
    assert!(table.lines.iter().all(|line| !line.is_edge));
    let last = table.lines[1].points[1].at;
    assert_eq!([last.x, last.y, last.z], [1000.0, 450.0, 200.0]);
    let buttock = table.lines[2].points[0].at;
    assert_eq!([buttock.y, buttock.z], [150.0, 20.0]);
    assert!(table.notes.iter().any(|note| note.contains("diagonal")), "{:?}", table.notes);
    let mere = refused("Stations,0 mm,1000 mm\nWL 1,300 mm,400 mm\nWL 2,350 mm,450 mm\n");
    assert!(mere.message.contains("which height 'WL 1' has"), "{mere}");
    let spaced =
        "Waterline spacing,100 mm\nStations,0 mm,1000 mm\nWL 1,300 mm,400 mm\nWL 2,350 mm,450 mm\n";
    assert_eq!(read(spaced, None).lines[1].points[0].at.z, 200.0);
}

#[test]
fn what_is_not_understood_is_named_with_its_place() {
    let good = blocks(&eighths, ",", "Position");
    for (from, to, message, place) in [
        ("1-7-3", "1-13-3", "13 inches", "hull.csv:5, column B"),
        ("1-7-3", "2001-07-03", "date", "hull.csv:5, column B"),
        ("1-7-3", "7-3", "two parts", "hull.csv:5, column B"),
        ("1-7-3", "about 20", "is no length", "hull.csv:5, column B"),
        ("1-7-3", "19", "feet and inches", "hull.csv:5, column B"),
        ("1-7-3", "-", "no height at Sta 0", "hull.csv:10, column B"),
        ("Half-breadths\n", "\n", "given twice", "hull.csv:10, column B"),
        ("Heights above base\n", "\n", "whether 'Sheer' are heights", "hull.csv:5, column A"),
    ] {
        assert!(good.contains(from), "{from} in {good}");
        let error = refused(&good.replacen(from, to, 1));
        assert!(error.message.contains(message), "{from} {to}: {error}");
        assert_eq!(error.place.as_deref(), Some(place), "{from} {to}");
        assert!(error.hint.contains("4 stations (Sta 0"), "{}", error.hint);
    }
}

/// Commas divide a title as they divide columns.
#[test]
fn a_title_may_have_commas() {
    let body = blocks(&eighths, ",", "Position");
    for title in [
        "Skiff, offsets in feet-inches-eighths",
        "My boat, 2026",
        "Lines of a skiff, 2026, drawn by A. Smith",
        "My boat, length 4 m, beam 1.5 m",
    ] {
        is_the_hull(&read(&format!("{title}\n{body}"), None));
        is_the_hull(&read(&format!("# remark, 1\n\n{title}\n\n{body}"), None));
    }
    let metric = blocks(&millimetres, ",", "Position");
    is_the_hull(&read(&format!("Skiff, offsets in millimetres\n{metric}"), None));
    // Names of stations above their places are no title.
    let named = "Name,A,B,C\nPosition (mm),0,900,1800\nSheer height (mm),500,510,520\n\
                 Sheer half-breadth (mm),400,420,300\n";
    assert_eq!(read(named, None).stations[1], ("B".to_owned(), 900.0));
    let bare = named.replace("Name,A,B,C", ",A,B,C");
    assert_eq!(read(&bare, None).stations[1], ("B".to_owned(), 900.0));
}

/// The unit that one label names is that of all numbers, unless they are too large for it.
#[test]
fn the_unit_of_a_label_is_that_of_the_table() {
    let table = "Station;x (mm);Sheer height;Sheer half-breadth\n0;0;492;656\n1;610;471;794\n";
    let refused_as_it_is = refused(table);
    assert!(refused_as_it_is.message.contains("has no unit"), "{refused_as_it_is}");
    let longer = format!("{table}2;1219;508;722\n");
    let found = read(&longer, None);
    let last = found.lines[0].points[2].at;
    assert_eq!([last.x, last.y, last.z], [1219.0, 722.0, 508.0]);
    assert!(found.notes.iter().any(|note| note.contains("the one that a label names")));
    let metres = longer.replace("(mm)", "(m)").replace("610", "0.61").replace("1219", "1.219");
    assert!(refused(&metres).message.contains("has no unit"));
}

#[test]
fn heights_below_a_base_line_are_turned_up() {
    let text = "Station,0,1000,2000\nHeights\nGunwale,10,20,10\nBottom,300,310,280\n\
                Half-breadths\nGunwale,400,500,400\nBottom,200,250,200\n";
    let table = read(text, Some(Units::Millimetres));
    assert_eq!(table.lines[1].points[0].at.z, -300.0);
    assert!(table.notes.iter().any(|note| note.contains("downwards")), "{:?}", table.notes);
}

#[test]
fn many_stations_or_lines_are_refused() {
    let heads: String = (0..1001).map(|n| format!(",{n}")).collect();
    let many = refused(&format!("Station{heads}\nSheer height,1 mm\n"));
    assert!(many.message.contains("more than 1000 stations"), "{many}");
    let rows: String = (0..20_000).map(|n| format!("Line {n} height,1 mm\n")).collect();
    let many = refused(&format!("Station,0 mm,1 mm\n{rows}"));
    assert!(many.message.contains("more than 1000 lines"), "{many}");
    let far = refused("Station spacing,600 mm\nStation,0,1e308\nSheer height,1 mm,2 mm\n");
    assert!(far.message.contains("'1e308' is out of range"), "{far}");
}

#[test]
fn units_are_those_of_the_caller_the_table_or_last_the_usual_ones() {
    let body = "Station,0,100,200\nSheer height,8,9,10\nSheer half-breadth,4,5,4\n";
    let first = |title: &str, asked, usual| {
        let text = format!("{title}{body}");
        let units = GivenUnits { asked, usual };
        let table = read_hull_table(text.as_bytes(), "hull.csv", false, None, units);
        table.map(|table| table.lines[0].points[0].at.z)
    };
    let usual = Some(Units::Millimetres);
    assert_eq!(first("Offsets in inches\n", None, usual).unwrap(), 8.0 * 25.4);
    assert_eq!(first("Offsets in inches\n", Some(Units::Feet), usual).unwrap(), 8.0 * 304.8);
    assert_eq!(first("", None, usual).unwrap(), 8.0);
    assert_eq!(first("# lines of a 12 ft skiff\n", None, usual).unwrap(), 8.0);
    assert!(first("# lines of a 12 ft skiff\n", None, None).is_err());
    let error = first("Offsets in feet and inches\n", None, usual).unwrap_err();
    assert!(error.message.contains("has no unit, and the table is in feet"), "{error}");
    let fraction = format!("{body}Chine height,1 1/2,2,3\nChine half-breadth,2,3,2\n");
    let units = GivenUnits { asked: None, usual };
    let table = read_hull_table(fraction.as_bytes(), "hull.csv", false, None, units).unwrap();
    assert_eq!(table.lines[0].points[0].at.z, 8.0 * 25.4);
}

/// The place of each point of a line, as docs/offset-tables.md has it.
#[test]
fn a_line_may_have_places_of_its_own() {
    let text = "Station,0,1,2\nPosition (mm),0,900,1800\nSheer x (mm),-50,900,1850\n\
                Sheer height (mm),500,510,520\nSheer half-breadth (mm),400,420,300\n";
    let table = read(text, None);
    let along: Vec<f64> = table.lines[0].points.iter().map(|point| point.at.x).collect();
    assert_eq!(along, [-50.0, 900.0, 1850.0]);
    assert_eq!(table.stations.iter().map(|s| s.1).collect::<Vec<f64>>(), [0.0, 900.0, 1800.0]);
}

#[test]
fn a_second_head_of_a_block_is_the_head_once_more() {
    let text = "Offsets in mm\nStation,0,1,2\nPosition,0,900,1800\nSheer height,500,510,520\n\
                Chine height,100,110,120\nStation,0,1,2\nSheer HB,400,420,300\n\
                Chine HB,200,220,100\n";
    let table = read(text, None);
    assert_eq!(table.stations.last().unwrap().1, 1800.0);
    assert_eq!((table.lines.len(), table.lines[1].points[2].at.y), (2, 100.0));
    // The stations of the second head stand in another order.
    let turned = text.replace("120\nStation,0,1,2", "120\nStation,2,1,0");
    assert_eq!(read(&turned, None).lines[1].points[2].at.y, 200.0);
}

#[test]
fn letters_and_fractions_belong_to_names() {
    let text = "Offsets in mm\nStation,0,1000\nHeights\nChine A,100,110\nChine B,200,210\n\
                Half-breadths\nChine A,300,310\nChine B,400,410\nWL 2.5 mm,5,6\nWL 25 mm,7,8\n";
    let table = read(text, None);
    let names: Vec<&str> = table.lines.iter().map(|line| &line.name[..]).collect();
    assert_eq!(names, ["Chine A", "Chine B", "WL 2.5 mm", "WL 25 mm"]);
    let chine = table.lines[1].points[1].at;
    assert_eq!([chine.y, chine.z], [410.0, 210.0]);
}

#[test]
fn rows_that_are_left_out_are_noted() {
    let text = "Offsets in mm\nStation,0,1000\nSheer height,500,510\nSheer HB,400,420\n\
                Bevel angle,10,12\n,-,33\n";
    let notes = read(text, None).notes;
    for said in [
        "left out from hull.csv:5, column B on: 'Bevel angle', which is no line of a hull",
        "left out from hull.csv:6, column C on: lengths without the name of a line",
    ] {
        assert!(notes.iter().any(|note| note == said), "{notes:?}");
    }
}

#[test]
fn an_export_of_delftship_is_named() {
    let error = refused("5\n11\n1\n1\n0\n0\n0\n10.0\n3.0\n0.5\n0.1 0.2\n");
    assert!(error.message.contains("DELFTship, of 5 waterlines and 11 stations"), "{error}");
}

/// Random hulls, written in each notation: what is read is what was written, within the notation.
#[test]
fn random_hulls_come_back_within_the_notation() {
    let mut random = sheetwright::random::Random::new(42);
    for round in 0..200 {
        let stations = 3 + random.below(12);
        let names = ["Sheer", "Upper chine", "Lower chine", "Knuckle 2"];
        let count = 1 + random.below(names.len());
        let place = |n: usize, random: &mut sheetwright::random::Random| {
            (400 * n + random.below(300)) as f64 + random.between(0.0, 1.0)
        };
        let places: Vec<f64> = (0..stations).map(|n| place(n, &mut random)).collect();
        let mut value = || random.between(-300.0, 2500.0);
        let hull: Vec<Vec<[f64; 2]>> =
            (0..count).map(|_| (0..stations).map(|_| [value().abs(), value()]).collect()).collect();
        let eighths = |mm: f64| {
            let n = (mm.abs() / 25.4 * 16.0).round() as u32;
            format!("{}{}", if mm < 0.0 { "-" } else { "" }, eighths(n))
        };
        let mm = |mm: f64| format!("{mm:.1} mm");
        let inches = |mm: f64| {
            let n = (mm.abs() / 25.4 * 8.0).round() as u32;
            format!("{}{} {}/8\"", if mm < 0.0 { "-" } else { "" }, n / 8, n % 8)
        };
        for (of, within) in
            [(&eighths as &dyn Fn(f64) -> String, 25.4 / 32.0), (&mm, 0.05), (&inches, 25.4 / 16.0)]
        {
            let row = |name: &str, cells: Vec<f64>| {
                let cells: Vec<String> = cells.into_iter().map(of).collect();
                format!("{name};{}\n", cells.join(";"))
            };
            let heads: Vec<String> = (0..stations).map(|n| format!("Sta {n}")).collect();
            let mut text = format!("Station;{}\n", heads.join(";"));
            text.push_str(&row("Position", places.clone()));
            for (title, axis) in [("Half-breadths", 0), ("Heights", 1)] {
                text.push_str(&format!("{title}\n"));
                for (name, points) in names.iter().zip(&hull) {
                    text.push_str(&row(name, points.iter().map(|p| p[axis]).collect()));
                }
            }
            let table = read(&text, None);
            assert_eq!(table.lines.len(), count, "{round}: {text}");
            // Heights of random lines may look as if they were measured downwards.
            let is_down = table.notes.iter().any(|note| note.contains("downwards"));
            let sign = if is_down { -1.0 } else { 1.0 };
            for (line, points) in table.lines.iter().zip(&hull) {
                for ((point, at), [half, height]) in line.points.iter().zip(&places).zip(points) {
                    let off = [point.at.x - at, point.at.y - half, sign * point.at.z - height];
                    assert!(off.iter().all(|off| off.abs() <= within + 1e-9), "{off:?} {text}");
                }
            }
        }
    }
}

#[test]
fn heights_and_half_breadths_may_be_two_files() {
    let table =
        |quantity: &str, rows: &str| format!("Offsets in mm\n{quantity}Station,0,900,1800\n{rows}");
    let heights = "Sheer,500,480,510\nKeel,0,-20,30\n";
    let breadths = "Sheer,400,420,300\nKeel,0,0,0\n";
    let units = GivenUnits::default();
    let one = table("Heights\n", heights) + "\n" + &table("Half-breadths\n", breadths);
    let one = read_hull_table(one.as_bytes(), "hull.csv", false, None, units).unwrap();
    // The quantity stands in the file, or in its name.
    for (names, titles) in [
        (["hull.csv", "more.csv"], ["Heights above base\n", "Half-breadths\n"]),
        (["heights.csv", "half-breadths.csv"], ["", ""]),
        (["Half_breadths.csv", "Heights.csv"], ["", ""]),
    ] {
        let mut texts = [table(titles[0], heights), table(titles[1], breadths)];
        if names[0].starts_with("Half") {
            texts.reverse();
        }
        let [first, second] = texts;
        let second = SecondTable { name: names[1].to_owned(), bytes: second.into_bytes() };
        let two = read_hull_table(first.as_bytes(), names[0], false, Some(&second), units).unwrap();
        for (a, b) in one.lines.iter().zip(&two.lines) {
            let at = |line: &lines::HullLine| line.points.iter().map(|p| p.at).collect::<Vec<_>>();
            assert_eq!((&a.name, at(a)), (&b.name, at(b)), "{names:?}");
        }
        assert_eq!((two.lines.len(), two.stations.len()), (2, 3));
    }
    let lone = table("", heights);
    assert!(read_hull_table(lone.as_bytes(), "heights.csv", false, None, units).is_err());
}
