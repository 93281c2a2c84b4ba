//! What is done along edges, from a design to files that read back.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::check::{FindingKind, Severity};
use sheetwright::design::Design;
use sheetwright::index::VertexIndex;
use sheetwright::make::{Judging, Made, Part, make_judged};
use sheetwright::math::{Point2, Point3};
use sheetwright::pattern::{PathKind, PatternPath, Role};
use sheetwright::predicate::signed_area_doubled;
use sheetwright::trim::TrimNote;
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    Format, InputFormat, MeshFormat, OutputOptions, ReadOptions, design_from_template,
    output_files, read_bytes, trade_names, trims_for, write_design,
};
use std::path::Path;

fn options(trade: &str) -> ReadOptions {
    ReadOptions { trade: Some(trade.to_owned()), ..ReadOptions::default() }
}

/// A design of a template, read for a trade.
fn for_trade(template: &str, trade: &str) -> Design {
    let design = design_from_template(template, &[]).unwrap();
    let bytes = write_design(&design);
    read_bytes(InputFormat::Design, &bytes, "d.sheet.json", None, &options(trade)).unwrap()
}

fn example(name: &str, trade: &str) -> Design {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name);
    sheetwright_files::read_input(&path, &options(trade)).unwrap()
}

/// A regular icosahedron with sides of 40 mm.
fn icosahedron() -> Design {
    let (a, b) = (20.0, 10.0 * (1.0 + 5f64.sqrt()));
    let mut text = String::new();
    for (s, t) in [(a, b), (-a, b), (a, -b), (-a, -b)] {
        for p in [[0.0, s, t], [s, t, 0.0], [t, 0.0, s]] {
            text.push_str(&format!("v {} {} {}\n", p[0], p[1], p[2]));
        }
    }
    let points: Vec<Point3> = text
        .lines()
        .map(|line| {
            let n: Vec<f64> = line[2..].split(' ').map(|n| n.parse().unwrap()).collect();
            Point3::new(n[0], n[1], n[2])
        })
        .collect();
    let near = |i: usize, j: usize| (points[i].distance(points[j]) - 40.0).abs() < 1e-6;
    for i in 0..12 {
        for j in i + 1..12 {
            for k in (j + 1..12).filter(|&k| near(i, j) && near(j, k) && near(i, k)) {
                let (p, q, r) = (points[i], points[j], points[k]);
                let out = (q - p).cross(r - p).dot(p.to_vec()) > 0.0;
                let (j, k) = if out { (j, k) } else { (k, j) };
                text.push_str(&format!("f {} {} {}\n", i + 1, j + 1, k + 1));
            }
        }
    }
    let format = InputFormat::Mesh(MeshFormat::Obj);
    read_bytes(format, text.as_bytes(), "icosahedron.obj", None, &options("paper")).unwrap()
}

fn make(design: &Design) -> Made {
    make_judged(design, Judging::Quick, &mut Unwatched).unwrap()
}

/// Files of all patterns are written, read back and compared; trims are no errors.
fn assert_written(made: &Made, what: &str) {
    let formats = [Format::Svg, Format::Dxf, Format::Pdf, Format::Report];
    let outputs = output_files(made, &formats, OutputOptions::default()).unwrap();
    for (part, checked) in made.parts.iter().zip(&outputs.panels) {
        let bad = checked.findings.iter().find(|finding| {
            finding.severity() == Severity::Error && ["trim", "refold"].contains(&finding.code())
        });
        assert!(bad.is_none(), "{what}, {}: {bad:?}", part.name);
    }
}

fn area(lines: impl Iterator<Item = Vec<Point2>>) -> f64 {
    lines.map(|line| 0.5 * signed_area_doubled(&line)).sum()
}

fn added_mm2(part: &Part) -> f64 {
    let cut = area(part.piece.loops().map(<[Point2]>::to_vec));
    cut - area(part.piece.net_loops().map(<[Point2]>::to_vec))
}

#[test]
fn every_trade_is_made_written_and_read_back() {
    let designs = ["lampshade", "square-to-round", "elbow", "bag", "tent", "dinghy"];
    for trade in trade_names() {
        for template in designs {
            let made = make(&for_trade(template, trade));
            assert_written(&made, &format!("{template} for {trade}"));
        }
    }
}

#[test]
fn a_design_keeps_its_trade_and_its_trims() {
    let text = r#"{ "sheetwright": 1, "name": "a", "units": "cm", "material": "leather-2mm", "for": "leather",
      "curves": {
        "left": { "kind": "polyline", "points": [[0,0,0], [0,30,0]] },
        "right": { "kind": "polyline", "points": [[20,0,0], [20,30,0]] } },
      "panels": [{ "name": "side", "rails": ["left", "right"], "samples": 10 }],
      "trims": [
        { "on": "joined", "kind": "holes", "pitch": 0.5 },
        { "on": ["side/left", "start"], "kind": "allowance", "width": [1, "2 t"], "corners": "first-edge-symmetry" },
        { "on": "end", "kind": "notches", "every": "30 mm", "form": "v-out", "count": 2, "span": [0.1, 0.9] } ] }"#;
    let read = |text: &[u8]| {
        read_bytes(InputFormat::Design, text, "d.sheet.json", None, &ReadOptions::default())
    };
    let design = read(text.as_bytes()).unwrap();
    assert_eq!(design.trade.as_deref(), Some("leather"));
    assert_eq!(design.trims.len(), 4, "the first one replaces a field of the trade's");
    let holes = format!("{:?}", design.trims[0].kind);
    assert!(holes.contains("pitch: 5.0") && holes.contains("inset: 3.0"), "{holes}");
    let allowance = format!("{:?}", design.trims[2].kind);
    assert!(allowance.contains("[10.0, 4.0]"), "{allowance}");
    let again = read(&write_design(&design)).unwrap();
    assert_eq!(again.trims, design.trims);
    let plain = text.replace("\"pitch\": 0.5", "\"pitch\": \"4 mm\"");
    let plain = read(plain.as_bytes()).unwrap();
    let again = write_design(&plain);
    assert!(String::from_utf8_lossy(&again).contains("\"for\": \"leather\""));
    assert_eq!(read(&again).unwrap(), plain);
    assert_written(&make(&design), "leather");
}

#[test]
fn what_is_wrong_is_said() {
    let with = |trims: &str| {
        let text = format!(
            r#"{{ "sheetwright": 1, "curves": {{
                "left": {{ "kind": "polyline", "points": [[0,0,0], [0,300,0]] }},
                "right": {{ "kind": "polyline", "points": [[200,0,0], [200,300,0]] }} }},
                "panels": [{{ "name": "side", "rails": ["left", "right"], "samples": 10 }}], {trims} }}"#
        );
        let options = ReadOptions::default();
        let design = read_bytes(InputFormat::Design, text.as_bytes(), "d", None, &options);
        match design {
            Err(error) => format!("{error} {}", error.hint),
            Ok(design) => match make_judged(&design, Judging::Quick, &mut Unwatched) {
                Err(error) => format!("{error} {}", sheetwright_files::hint_for(&error)),
                Ok(_) => "made".to_owned(),
            },
        }
    };
    for (trims, said) in [
        (r#""trims": [{ "on": "left", "kind": "allowance", "width": 10 }]"#, "made"),
        (r#""for": "boats""#, "there is no trade 'boats'"),
        (r#""trims": [{ "kind": "allowance", "width": 10 }]"#, "the field `on` is missing"),
        (r#""trims": [{ "on": "left", "kind": "alowance" }]"#, "Did you mean `allowance`?"),
        (
            r#""trims": [{ "on": "left", "kind": "hem", "width": 10, "pitch": 3 }]"#,
            "trims[0]: the field 'pitch' is not known",
        ),
        (r#""trims": [{ "on": "left", "kind": "hem", "width": 0 }]"#, "`width` is 0"),
        (r#""trims": [{ "on": "left", "kind": "hem", "width": "2 t" }]"#, "no sheet is named"),
        (r#""trims": [{ "on": "left", "kind": "hem", "width": "wide" }]"#, "`width` is 'wide'"),
        (
            r#""trims": [{ "on": "left", "kind": "allowance", "width": 10, "corners": "round" }]"#,
            "the value 'round' is not known",
        ),
        (
            r#""trims": [{ "on": "left", "span": [0.5, 0.2], "kind": "hem", "width": 10 }]"#,
            "the span is [0.5, 0.2]",
        ),
        (
            r#""trims": [{ "on": "keel", "kind": "hem", "width": 10 }]"#,
            "no edge is called 'keel'; there are side/left",
        ),
        (
            r#""trims": [{ "on": "left", "kind": "tabs" }]"#,
            "edge 'side/left' is joined to no other",
        ),
        (
            r#""trims": [{ "on": "all", "kind": "hem", "width": 250 }]"#,
            "wider than the part, which measures 200.0 mm",
        ),
        (
            r#""trims": [{ "on": "all", "kind": "holes", "pitch": 2, "diameter": 3 }]"#,
            "holes of 3.00 mm overlap",
        ),
        (
            r#""trims": [{ "on": "all", "kind": "holes", "pitch": 20, "diameter": 3, "inset": 1 }]"#,
            "reach over the edge",
        ),
        (
            r#""trims": [{ "on": "left", "kind": "notches", "depth": 5 }]"#,
            "has 0.00 mm of allowance there",
        ),
        (r#""trims": [{ "on": "left", "kind": "ticks", "at": [1.5] }]"#, "`at` has 1.5"),
        (
            r#""trims": [{ "on": "left", "kind": "ticks", "at": [0.5], "every": 20 }]"#,
            "Keep one of them",
        ),
    ] {
        let answer = with(trims);
        assert!(answer.contains(said), "{trims}: {answer}");
    }
}

/// The arc lengths in space, along an edge, of the holes of its part that stand `inset` mm inside.
fn holes_along(part: &Part, edge: usize, inset: f64) -> Vec<f64> {
    let run = &part.edges[edge].run;
    let space: Vec<Point3> = run.iter().map(|&v| part.sheet.mesh().positions()[v]).collect();
    let flat: Vec<Point2> = run.iter().map(|&v| part.flat.points[v]).collect();
    let mut found = Vec::new();
    for path in &part.piece.paths {
        if !matches!(path.kind, PathKind::Drill { .. }) {
            continue;
        }
        let at = path.points[0].lerp(path.points[path.points.len() / 2], 0.5);
        let mut along = 0.0;
        for n in 0..flat.len() - 1 {
            let way = flat[n + 1] - flat[n];
            let share = (at - flat[n]).dot(way) / way.length_squared();
            let off = way.perp_dot(at - flat[n]) / way.length();
            let step = space[n].distance(space[n + 1]);
            if (-1e-9..1.0).contains(&share) && (off - inset).abs() < 1e-6 {
                found.push(along + share * step);
                break;
            }
            along += step;
        }
    }
    found.sort_by(f64::total_cmp);
    found
}

#[test]
fn stitch_holes_of_a_dinghy_meet_by_arc_length() {
    let compared = compared_holes(&make(&for_trade("dinghy", "boat")));
    assert!(compared >= 2, "{compared} joints");
}

/// A hull with a keel and one with a flat bottom, both with a transom: planks have holes along
/// every seam, those with the transom too.
#[test]
fn stitch_holes_of_hulls_from_tables_meet_on_every_seam() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus/offsets");
    // Keel, chines and four edges of the transom; chines, stem and three edges of the transom.
    for (table, seams, unjoined) in [
        (
            "skiff.csv",
            7,
            &[
                "bottom-port/end",
                "bottom-starboard/end",
                "side-port/Sheer",
                "side-port/end",
                "side-starboard/Sheer-starboard",
                "side-starboard/end",
                "transom/transom-top",
            ][..],
        ),
        (
            "flat-skiff.csv",
            6,
            &["side-port/Sheer", "side-starboard/Sheer-starboard", "transom/transom-top"],
        ),
    ] {
        let settings = [format!("table={table}"), "transoms=yes".to_owned()];
        let new = sheetwright_files::new_design("hull", &settings, &folder).unwrap();
        let read = |bytes: &[u8]| {
            let format = InputFormat::Design;
            read_bytes(format, bytes, "d.sheet.json", Some(&folder), &options("boat")).unwrap()
        };
        let made = make(&read(&new.bytes()));
        assert_eq!(compared_holes(&made), seams, "{table}");
        let free = made.parts.iter().flat_map(|part| {
            let free = part.edges.iter().filter(|edge| edge.mates.is_empty());
            free.map(|edge| format!("{}/{}", part.name, edge.name))
        });
        let mut free: Vec<String> = free.collect();
        free.sort_unstable();
        assert_eq!(free, unjoined, "{table}");
    }
}

/// How many joints of two whole edges there are, whose holes are seen to meet.
fn compared_holes(made: &Made) -> usize {
    let mut compared = 0;
    for (number, part) in made.parts.iter().enumerate() {
        for (n, edge) in part.edges.iter().enumerate() {
            let [mate] = edge.mates[..] else { continue };
            let other = &made.parts[mate.part];
            // Of a side alone: other edges that come near may have holes there as well.
            if mate.part < number
                || (other.edges[mate.edge].length_space_mm - edge.length_space_mm).abs() > 1.0
            {
                continue;
            }
            let own = holes_along(part, n, 10.0);
            let mut theirs = holes_along(other, mate.edge, 10.0);
            let first = |part: &Part, edge: usize| {
                let run = &part.edges[edge].run;
                part.sheet.mesh().positions()[run[0]]
            };
            if first(part, n).distance(first(other, mate.edge)) > 1.0 {
                let whole = other.edges[mate.edge].length_space_mm;
                theirs = theirs.iter().rev().map(|along| whole - along).collect();
            }
            assert!(own.len() >= 5, "{}/{}: {own:?}", part.name, edge.name);
            assert_eq!(
                own.len(),
                theirs.len(),
                "{}/{}: {own:?} and {theirs:?}",
                part.name,
                edge.name
            );
            for (a, b) in own.iter().zip(&theirs) {
                assert!((a - b).abs() < 0.01, "{}/{}: {a} and {b} mm", part.name, edge.name);
            }
            compared += 1;
        }
    }
    compared
}

/// How many tabs stand along an edge: folds both of whose ends, and whose middle, lie on it.
fn tabs_along(part: &Part, edge: usize) -> usize {
    let run: Vec<Point2> = part.edges[edge].run.iter().map(|&v| part.flat.points[v]).collect();
    let on_edge =
        |p: Point2| run.windows(2).any(|step| p.distance_to_segment([step[0], step[1]]) < 1e-6);
    let is_along = |points: &[Point2]| {
        let middle = points[0].lerp(points[1], 0.5);
        on_edge(points[0]) && on_edge(points[points.len() - 1]) && on_edge(middle)
    };
    let paths = part.piece.paths.iter();
    let folds = paths.filter(|path| matches!(path.kind, PathKind::TrimFold { .. }));
    folds.filter(|path| is_along(&path.points)).count()
}

#[test]
fn paper_models_have_tabs_on_one_side_of_each_joint() {
    let designs = [
        for_trade("hemisphere", "paper"),
        for_trade("lampshade", "paper"),
        example("corpus/good/mesh-cube.obj", "paper"),
        icosahedron(),
    ];
    for design in designs {
        let made = make(&design);
        assert_written(&made, &design.name);
        for part in &made.parts {
            let folds = part.piece.paths.iter();
            let folds = folds.filter(|path| matches!(path.kind, PathKind::TrimFold { .. })).count();
            // Every tab adds to the piece: none lies over it, or over another.
            assert_eq!(folds > 0, added_mm2(part) > 0.0, "{}", part.name);
        }
        let mut joints = 0;
        for (number, part) in made.parts.iter().enumerate() {
            for (n, edge) in part.edges.iter().enumerate() {
                for mate in edge.mates.iter().filter(|mate| (number, n) < (mate.part, mate.edge)) {
                    let sides =
                        [tabs_along(part, n), tabs_along(&made.parts[mate.part], mate.edge)];
                    let (part, edge) = (&part.name, &edge.name);
                    assert!(
                        (sides[0] > 0) != (sides[1] > 0),
                        "{}, {part}/{edge}: {sides:?} tabs",
                        design.name
                    );
                    joints += 1;
                }
            }
        }
        assert!(joints > 0, "{}", design.name);
    }
}

#[test]
fn tabs_are_folded_the_way_their_joint_turns() {
    // A prism on an L, cut along its inner corner and taken apart into small pieces.
    let text = "v 0 0 0\nv 60 0 0\nv 60 20 0\nv 20 20 0\nv 20 70 0\nv 0 70 0\n\
        v 0 0 30\nv 60 0 30\nv 60 20 30\nv 20 20 30\nv 20 70 30\nv 0 70 30\n\
        f 6 5 4 3 2 1\nf 7 8 9 10 11 12\nf 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\n\
        f 5 6 12 11\nf 6 1 7 12\nl 4 10\n";
    let format = InputFormat::Mesh(MeshFormat::Obj);
    let mut options = options("paper");
    options.mesh.facets = Some(true);
    let design = read_bytes(format, text.as_bytes(), "l.obj", None, &options).unwrap();
    let made = make(&design);
    let (mut mountains, mut valleys) = (0, 0);
    for part in &made.parts {
        for path in &part.piece.paths {
            let PathKind::TrimFold { mountain } = path.kind else { continue };
            let middle = path.points[0].lerp(path.points[path.points.len() - 1], 0.5);
            let mut steps = part.edges.iter().flat_map(|edge| edge.run.windows(2));
            let flat = |v: usize| part.flat.points[v];
            let on =
                |step: &&[usize]| middle.distance_to_segment([flat(step[0]), flat(step[1])]) < 1e-6;
            let step = steps.find(on).unwrap();
            let inner = Point3::new(20.0, 20.0, 0.0);
            let is_inner = step.iter().all(|&v| {
                let at = part.sheet.mesh().position(VertexIndex::new(v));
                Point3::new(at.x, at.y, 0.0).distance(inner) < 1e-9
            });
            assert_eq!(mountain, !is_inner, "{}: {middle:?}", part.name);
            *(if mountain { &mut mountains } else { &mut valleys }) += 1;
        }
    }
    assert!(mountains > 0 && valleys == 1, "{mountains} {valleys}");
}

#[test]
fn flanges_of_ducts_are_parted_at_the_corners_that_their_mouths_have_in_space() {
    let folded = ["pieces=folded".to_owned()];
    for (template, settings) in [("hopper", &folded[..]), ("square-to-round", &[])] {
        let design = write_design(&design_from_template(template, settings).unwrap());
        let format = InputFormat::Design;
        let design = read_bytes(format, &design, "d.sheet.json", None, &options("duct")).unwrap();
        let made = make(&design);
        assert_written(&made, template);
        let mut corners = 0;
        for part in &made.parts {
            let mesh = part.sheet.mesh();
            let space = |v: usize| mesh.position(VertexIndex::new(v));
            let is_cut = |path: &&PatternPath| path.kind == PathKind::Outline;
            let cut = part.piece.paths.iter().find(is_cut).unwrap();
            let free = part.edges.iter().filter(|edge| edge.mates.is_empty());
            for at in free.flat_map(|edge| edge.run.windows(3)) {
                let (a, b) = (space(at[1]) - space(at[0]), space(at[2]) - space(at[1]));
                if a.dot(b) > 0.5 * a.length() * b.length() {
                    continue;
                }
                let corner = part.flat.points[at[1]];
                let steps = cut.points.iter().zip(cut.points.iter().cycle().skip(1));
                let apart_mm = steps.map(|(&p, &q)| corner.distance_to_segment([p, q]));
                let apart_mm = apart_mm.fold(f64::INFINITY, f64::min);
                assert!(apart_mm < 5.0, "{template}, {}: {apart_mm} mm", part.name);
                corners += 1;
            }
        }
        assert!(corners >= 3, "{template}: {corners} corners");
        let findings = made.parts.iter().flat_map(|part| &part.checked.findings);
        let stretches = findings.filter_map(|finding| match &finding.kind {
            FindingKind::Trimmed { note: TrimNote::FlangeStretches { flat_mm, bent_mm, .. } } => {
                Some(bent_mm / flat_mm - 1.0)
            }
            _ => None,
        });
        let stretches: Vec<f64> = stretches.collect();
        match template {
            "hopper" => assert!(stretches.is_empty(), "{stretches:?}"),
            _ => assert!(matches!(stretches[..], [share] if (0.05..0.3).contains(&share))),
        }
    }
}

#[test]
fn trims_of_a_moving_design_follow_it() {
    let design = for_trade("bag", "sewing");
    let mut live = sheetwright::Live::new(design.clone(), &mut Unwatched);
    let first = live.made().unwrap();
    assert!(first.parts.iter().all(|part| part.piece.has_net()));
    assert_eq!(live.made().unwrap(), first);
    let mut bare = design;
    bare.trims.clear();
    live.update(bare, &mut Unwatched);
    let without = live.made().unwrap();
    let is_of_trim = |role: Role| role == Role::Net || role == Role::Drill;
    let mut paths = without.parts.iter().flat_map(|part| &part.piece.paths);
    assert!(!paths.any(|path| is_of_trim(path.role)));
}

#[test]
fn a_trimmed_pattern_lies_within_its_picture() {
    let text = r#"{ "sheetwright": 1, "curves": {
        "left": { "kind": "polyline", "points": [[0,0,0], [0,300,0]] },
        "right": { "kind": "polyline", "points": [[200,0,0], [200,300,0]] } },
        "panels": [{ "name": "side", "rails": ["left", "right"], "samples": 10 }],
        "trims": [{ "on": "all", "kind": "allowance", "width": 20 }] }"#;
    let options = ReadOptions::default();
    let design = read_bytes(InputFormat::Design, text.as_bytes(), "d", None, &options).unwrap();
    let made = make(&design);
    let piece = &made.parts[0].piece;
    assert!((piece.size.x - 340.0).abs() < 1e-6 && (piece.size.y - 240.0).abs() < 1e-6);
    assert!(piece.corner.distance(Point2::new(-20.0, -20.0)) < 1e-6);
    let outputs = output_files(&made, &[Format::Report], OutputOptions::default()).unwrap();
    let json = outputs.files.iter().find(|file| file.name == "report.json").unwrap();
    let json = String::from_utf8_lossy(&json.bytes);
    assert!(json.contains("\"samples\": 20"), "{json}");
    let page = outputs.files.iter().find(|file| file.name == "report.html").unwrap();
    let page = String::from_utf8_lossy(&page.bytes);
    assert!(page.contains("The outer line is cut; the dashed one inside is the edge"));
    assert!(page.contains("class=\"net\"") && page.contains("That edge is 1000\u{a0}mm long."));
}

/// The neutral surfaces of parts that were drawn to meet lie apart; their edges are mates still.
#[test]
fn edges_that_were_drawn_to_meet_are_joined_whatever_face_was_drawn() {
    for (template, joined) in [("square-to-round", 2), ("elbow", 18), ("tent", 6)] {
        let count = |face: Option<&str>| {
            let mut settings = vec!["material=steel-1mm".to_owned()];
            settings.extend(face.map(|face| format!("dimensions={face}")));
            let mut design = design_from_template(template, &settings).unwrap();
            design.panels.iter_mut().for_each(|panel| panel.samples = panel.samples.min(120));
            let thickness_mm = design.sheet_thickness_mm();
            design.trims = trims_for(&design, Some("duct"), [thickness_mm; 2]).unwrap();
            let made = make(&design);
            let edges = made.parts.iter().flat_map(|part| &part.edges);
            edges.filter(|edge| !edge.mates.is_empty()).count()
        };
        assert_eq!(count(None), joined, "{template}");
        for face in ["inside", "mean", "outside"] {
            assert_eq!(count(Some(face)), joined, "{template}, {face}");
        }
    }
}
