//! The output files of made designs: what a reader relies on, and that they read back.
#![allow(clippy::unwrap_used)] // Whatever fails here is a failed test.

use miniz_oxide::inflate::decompress_to_vec_zlib;
use sheetwright::boundary::PlaneChoice;
use sheetwright::check::{Finding, Severity};
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{
    BendMarks, Bends, CurveUse, Design, DesignCurve, DesignPanel, PanelMethod, PanelShape, Stock,
};
use sheetwright::make::{Made, Part, make};
use sheetwright::math::{Point2, Point3, Vec2};
use sheetwright::pattern::{LabelKind, PathKind, PatternLabel, PatternPath, Piece, Role};
use sheetwright::rung::Rung;
use sheetwright::triangulate::{Goal, WhichSurface};
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    BrakeSettings, Format, InputFormat, MaxSheets, OutputError, OutputOptions, Outputs, Paper,
    PatternReadError, PdfOptions, ReadOptions, ReadPattern, Reduced, finding_text, output_files,
    read_bytes, read_dxf, read_svg, refold_error_mm, stock_sheet, write_dxf, write_obj, write_pdf,
    write_svg,
};

/// The planks of the hull of `examples/ubc-fishing-vessel.csv`, a metre of it `scale` mm long.
fn hull(scale: f64) -> Made {
    let table = include_str!("../../../examples/ubc-fishing-vessel.csv");
    let mut curves: Vec<DesignCurve> = Vec::new();
    for line in table.lines().skip(1) {
        let (name, rest) = line.split_once(',').unwrap();
        let xyz: Vec<f64> = rest.split(',').map(|f| f.parse::<f64>().unwrap() * scale).collect();
        if curves.last().is_none_or(|curve| curve.name != name) {
            let kind = Some(CurveKind::Spline);
            curves.push(DesignCurve { name: name.into(), kind, closed: false, points: vec![] });
        }
        let point = CurvePoint::smooth(Point3::new(xyz[0], xyz[1], xyz[2]));
        curves.last_mut().unwrap().points.push(point);
    }
    let rail = |name: &str| CurveUse { name: name.into(), reversed: false };
    let panels = [
        ("topside", "Main deck", "Upper chine"),
        ("bilge", "Upper chine", "Lower chine"),
        ("bottom", "Lower chine", "Profile"),
    ];
    let panels = panels.map(|(name, a, b)| DesignPanel {
        name: name.into(),
        shape: PanelShape::Rails([rail(a), rail(b)]),
        samples: 60,
        tolerance: None,
        method: PanelMethod::Rails,
        goal: Goal::Price,
        run_on: false,
        slides: false,
        plane: PlaneChoice::None,
        fold: 0.1,
        effort: 1.0,
        cut: Vec::new(),
        which: WhichSurface::Cheapest,
        near: Vec::new(),
        bends: Some(Bends { marks: BendMarks::Rulings, ..Bends::default() }),
        count: 1,
        mirrored: 0,
    });
    let design = Design {
        name: "hull".into(),
        material: None,
        curves,
        panels: panels.to_vec(),
        ..Design::default()
    };
    make(&design, &mut Unwatched).unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// How often a text stands in another.
fn count(bytes: &[u8], needle: &str) -> usize {
    text(bytes).matches(needle).count()
}

fn rungs(panel: &Part) -> Vec<Rung> {
    panel.found().unwrap().surface.connectivity().hinges().iter().map(|hinge| hinge.rung).collect()
}

/// The largest distance of a point read back from where it was, mm.
fn missed(read: &ReadPattern, outline: &[Point2]) -> f64 {
    assert_eq!(read.outline.len(), outline.len());
    let low = outline.iter().fold(Vec2::splat(f64::INFINITY), |low, p| low.min(p.to_vec()));
    let pairs = read.outline.iter().zip(outline);
    pairs.map(|(a, b)| a.distance(*b + -low)).fold(0.0, f64::max)
}

#[test]
fn planks_read_back_and_fold_up_at_every_size() {
    // From a model to hold in the hand to one of 70 km, near the largest there may be.
    for scale in [1.0, 1000.0, 1e6] {
        for panel in &hull(scale).parts {
            let (svg, dxf) = (write_svg(&panel.piece), write_dxf(&panel.piece));
            let outline = panel.piece.outline();
            let size = panel.found().unwrap().boundary.size();
            for read in [read_svg(&svg).unwrap(), read_dxf(&dxf).unwrap()] {
                assert_eq!(read.rungs, rungs(panel));
                assert!(missed(&read, outline) <= 1e-9_f64.max(1e-15 * size), "{scale}");
            }
            let error_mm = refold_error_mm(panel, Some(&svg), Some(&dxf)).unwrap();
            assert!(error_mm <= 1e-12 * size, "{scale}: {error_mm}");
            assert_eq!(
                refold_error_mm(panel, None, None),
                refold_error_mm(panel, Some(&svg), None)
            );
        }
    }
}

#[test]
fn dxf_keeps_every_bit() {
    let panel = &hull(1000.0).parts[0];
    let read = read_dxf(&write_dxf(&panel.piece)).unwrap();
    assert_eq!(read.outline, panel.piece.outline());
}

/// FreeCAD 0.20 reads no name of a layer that stands before the flags.
#[test]
fn layers_of_dxf_have_their_flags_before_their_names() {
    let dxf = write_dxf(&hull(1000.0).parts[0].piece);
    let lines: Vec<&str> = text(&dxf).lines().collect();
    let pairs: Vec<(&str, &str)> = lines.chunks(2).map(|p| (p[0].trim(), p[1])).collect();
    let layers: Vec<usize> = (0..pairs.len()).filter(|&n| pairs[n] == ("0", "LAYER")).collect();
    assert_eq!(layers.len(), 5);
    for n in layers {
        assert_eq!([1, 2, 3].map(|k| pairs[n + k].0), ["70", "2", "62"]);
    }
}

/// Browsers and Inkscape draw lines of a pixel at any zoom; all others see 0.1 mm.
#[test]
fn lines_of_svg_show_on_screens_and_are_thin_for_machines() {
    let svg = write_svg(&hull(1000.0).parts[0].piece);
    let document = roxmltree::Document::parse(text(&svg)).unwrap();
    let groups: Vec<_> =
        document.root_element().children().filter(|n| n.has_tag_name("g")).collect();
    assert_eq!(groups.len(), 4);
    assert!(groups.iter().all(|g| g.attribute("stroke-width") == Some("0.1")));
    let styles: Vec<&str> =
        document.descendants().filter(|n| n.has_tag_name("style")).flat_map(|n| n.text()).collect();
    // Inkscape passes over a sheet with a rule that it does not know, so it has its own.
    let [for_inkscape, rules] = styles[..] else { panic!("{styles:?}") };
    assert_eq!(for_inkscape, "path{-inkscape-stroke:hairline}");
    // Whatever reads style sheets without knowing this rule has to pass over all of it.
    assert!(
        rules.starts_with("@supports (vector-effect:non-scaling-stroke){")
            && rules.ends_with("}}}")
    );
    assert!(rules.contains("stroke-width:1px"));
}

/// Small whole numbers that look random, the same ones every time (a linear congruence).
struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: u64) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % sides
    }

    fn share(&mut self) -> f64 {
        self.roll(1 << 30) as f64 / (1 << 30) as f64
    }
}

/// A piece between two lines of points, some of it folded, with awkward names and numbers.
fn random_piece(dice: &mut Dice) -> Piece {
    let n = 2 + dice.roll(30) as usize;
    let size = [1e-3, 1.0, 333.3, 1e6][dice.roll(4) as usize];
    let mut edge = |y: f64| -> Vec<Point2> {
        (0..n)
            .map(|i| Point2::new(size * (i as f64 + 0.4 * dice.share()), size * (y + dice.share())))
            .collect()
    };
    let (lower, mut upper) = (edge(0.0), edge(3.0));
    upper.reverse();
    let outline: Vec<Point2> = lower.into_iter().chain(upper).collect();
    let m = outline.len();
    let mut paths = vec![PatternPath {
        role: Role::Cut,
        kind: PathKind::Outline,
        points: outline.clone(),
        closed: true,
    }];
    for i in 1..n - 1 {
        let rung = Rung::new(i, m - 1 - i);
        paths.push(PatternPath {
            role: if dice.roll(2) == 0 { Role::Score } else { Role::Note },
            kind: PathKind::Rung(rung),
            points: rung.ends().map(|s| outline[s.get()]).to_vec(),
            closed: false,
        });
    }
    let label = PatternLabel {
        kind: LabelKind::Name,
        role: Role::Engrave,
        at: Point2::new(size, size),
        along: Vec2::new(0.6, 0.8),
        height_mm: 0.1 * size,
        text: "a<b & \"c\" \u{1}\u{FFFF}]]> Łódź 板".into(),
    };
    let name = label.text.clone();
    let size = Vec2::splat(size * n as f64);
    Piece {
        name,
        paths,
        labels: vec![label],
        size,
        corner: Point2::default(),
        bends: Vec::new(),
        border: Vec::new(),
        is_folded: false,
    }
}

#[test]
fn random_pieces_read_back() {
    let mut dice = Dice(1);
    for _ in 0..300 {
        let piece = random_piece(&mut dice);
        let expected: Vec<Rung> = {
            let mut rungs: Vec<Rung> = piece
                .paths
                .iter()
                .filter_map(|path| match path.kind {
                    PathKind::Rung(rung) => Some(rung),
                    _ => None,
                })
                .collect();
            rungs.sort();
            rungs
        };
        for read in [read_svg(&write_svg(&piece)), read_dxf(&write_dxf(&piece))] {
            let read = read.unwrap();
            assert!(missed(&read, piece.outline()) <= 1e-9);
            assert_eq!(read.rungs, expected);
        }
    }
}

#[test]
fn an_svg_says_its_unit_and_has_a_group_a_role() {
    let svg = write_svg(&hull(10.0).parts[1].piece);
    let document = roxmltree::Document::parse(text(&svg)).unwrap();
    let root = document.root_element();
    let view: Vec<&str> = root.attribute("viewBox").unwrap().split(' ').collect();
    assert_eq!(view[..2], ["0", "0"]);
    assert_eq!(root.attribute("width").unwrap(), format!("{}mm", view[2]));
    assert_eq!(root.attribute("height").unwrap(), format!("{}mm", view[3]));
    let groups = root.children().filter(|n| n.has_tag_name("g"));
    let ids: Vec<&str> = groups.filter_map(|n| n.attribute("id")).collect();
    assert_eq!(ids, ["cut", "score", "engrave", "note"]);
    assert_eq!(count(&svg, "transform"), 0);
}

/// The sign of the area of an outline tells a pattern from its mirror image.
#[test]
fn no_pattern_is_mirrored() {
    let panel = &hull(10.0).parts[0];
    for read in [read_svg(&write_svg(&panel.piece)), read_dxf(&write_dxf(&panel.piece))] {
        let doubled = sheetwright::predicate::signed_area_doubled(&read.unwrap().outline);
        assert!(doubled > 0.0);
        assert!((doubled / 2.0 / panel.measures.area_flat_mm2 - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_wrong_unit_a_moved_corner_and_a_missing_rung_are_seen() {
    let panel = &hull(10.0).parts[0];
    let svg = write_svg(&panel.piece);
    let refolded = |svg: &str| refold_error_mm(panel, Some(svg.as_bytes()), None);
    let inches = text(&svg).replacen("mm\" height=\"", "in\" height=\"", 1);
    assert_eq!(read_svg(inches.as_bytes()), Err(PatternReadError::Units));
    let inches = inches.replacen("mm\" viewBox", "in\" viewBox", 1);
    assert!(refolded(&inches).unwrap() > 1000.0);

    let path = text(&svg).split("class=\"outline\" d=\"M").nth(1).unwrap();
    let corner = path.split(" L").nth(7).unwrap();
    let moved = text(&svg).replace(corner, &format!("0.5,{}", corner.split_once(',').unwrap().1));
    assert!(refolded(&moved).unwrap() > 1.0);

    let rung = text(&svg).lines().find(|line| line.contains("class=\"rung\"")).unwrap();
    assert!(refolded(&text(&svg).replace(rung, "")).is_err());
    let turned = text(&svg).replacen("<g id=\"cut\"", "<g transform=\"scale(2)\" id=\"cut\"", 1);
    assert!(matches!(read_svg(turned.as_bytes()), Err(PatternReadError::Unexpected(_))));
}

#[test]
fn another_reader_of_dxf_sees_the_same_polylines() {
    let piece = &hull(1000.0).parts[2].piece;
    let bytes = write_dxf(piece);
    let drawing = dxf::Drawing::load(&mut std::io::Cursor::new(&bytes)).unwrap();
    assert_eq!(drawing.header.version, dxf::enums::AcadVersion::R12);
    let colours: Vec<(String, Option<u8>)> =
        drawing.layers().map(|layer| (layer.name.clone(), layer.color.index())).collect();
    for (name, colour) in [("cut", 1), ("score", 5), ("engrave", 7), ("note", 8)] {
        assert!(colours.contains(&(name.to_owned(), Some(colour))), "{colours:?}");
    }
    let mut cut = 0;
    for entity in drawing.entities() {
        let dxf::entities::EntityType::Polyline(polyline) = &entity.specific else {
            panic!("{:?}", entity.specific)
        };
        if entity.common.layer == "cut" {
            cut += 1;
            assert!(polyline.is_closed());
            let points: Vec<Point2> =
                polyline.vertices().map(|v| Point2::new(v.location.x, v.location.y)).collect();
            assert_eq!(points, piece.outline());
        }
    }
    assert_eq!(cut, 1);
}

#[test]
fn an_obj_has_a_group_a_panel_and_the_flat_pattern() {
    let made = hull(10.0);
    let obj = write_obj(&made);
    let lines = |tag: &str| text(&obj).lines().filter(|line| line.starts_with(tag)).count();
    let samples: usize = made.parts.iter().map(|p| p.found().unwrap().boundary.len()).sum();
    assert_eq!((lines("g "), lines("v "), lines("vt ")), (3, samples, samples));
    assert_eq!(lines("f "), samples - 2 * 3);
    let first = made.parts[0].flat.points[3];
    assert!(text(&obj).contains(&format!("vt {} {}\n", first.x + 0.0, first.y + 0.0)));
}

#[test]
fn the_same_design_gives_the_same_bytes() {
    let files = || {
        let mut made = hull(20.0);
        let sheets = vec![stock_sheet("1000x500mm").unwrap()];
        made.stock = Some(Stock { sheets, effort: 0.001, ..Stock::default() });
        made.lay_out(&mut Unwatched);
        output_files(&made, &Format::ALL, &PdfOptions::default()).unwrap()
    };
    assert_eq!(files(), files());
    let names: Vec<String> = files().files.into_iter().map(|file| file.name).collect();
    assert_eq!(
        names,
        [
            "surface.obj",
            "topside.svg",
            "bilge.svg",
            "bottom.svg",
            "topside.dxf",
            "bilge.dxf",
            "bottom.dxf",
            "pattern.pdf",
            "quads.obj",
            "surface.step",
            "pattern.fold",
            "pattern-astm.dxf",
            "offsets.csv",
            "brake.csv",
            "parts.csv",
            "sheets.svg",
            "sheets.dxf",
            "assembly.pdf",
            "report.json",
            "report.html"
        ]
    );
}

#[test]
fn formats_stand_in_the_order_of_their_table() {
    let mut sorted = Format::ALL;
    sorted.sort();
    assert_eq!(sorted, Format::ALL);
    for (n, format) in Format::ALL.into_iter().enumerate() {
        assert_eq!(format as usize, n);
        assert_eq!(Format::from_name(format.name()), Some(format));
    }
    assert_eq!(
        Format::DEFAULT,
        [Format::Obj, Format::Svg, Format::Dxf, Format::Pdf, Format::Report]
    );
}

#[test]
fn only_what_is_asked_for_is_made_but_it_is_always_folded() {
    let made = hull(20.0);
    let outputs = output_files(&made, &[Format::Obj], &PdfOptions::default()).unwrap();
    assert_eq!(outputs.files.len(), 1);
    assert!(outputs.refold_error_mm.iter().all(|error| *error < 1e-8));
    for (panel, checked) in made.parts.iter().zip(&outputs.panels) {
        assert_eq!(&panel.checked, checked);
    }
}

#[test]
fn a_pattern_that_does_not_fold_back_is_an_error_found() {
    let mut made = hull(20.0);
    made.parts[1].piece.paths.remove(7);
    let outputs = output_files(&made, &[], &PdfOptions::default()).unwrap();
    let first = &outputs.panels[1].findings[0];
    assert_eq!((first.code(), first.severity()), ("refold", Severity::Error));
    assert_eq!(outputs.panels[1].verdict, made.parts[1].checked.verdict);
    assert!(outputs.refold_error_mm[1].is_nan() && outputs.refold_error_mm[0] < 1e-8);
}

#[test]
fn names_that_make_no_files_are_refused() {
    let mut made = hull(20.0);
    made.parts[2].name = "TopSide".into();
    let refused = |made: &Made| output_files(made, &[], &PdfOptions::default()).unwrap_err();
    let same = OutputError::SameName { panel: "topside".into(), other: "TopSide".into() };
    assert_eq!(refused(&made), same);
    made.parts[2].name = "../up".into();
    assert_eq!(refused(&made), OutputError::BadName { panel: "../up".into() });
}

/// How often a text stands in the content of pages, which is compressed.
fn shown(pdf: &[u8], needle: &str) -> usize {
    let places = |bytes: &[u8], needle: &[u8]| -> Vec<usize> {
        let windows = bytes.windows(needle.len()).enumerate();
        windows.filter(|(_, window)| *window == needle).map(|(at, _)| at).collect()
    };
    // Both words end so; streams do not hold them by any chance that a test would meet.
    let streams = places(pdf, b"stream\n").into_iter().filter(|&at| !pdf[..at].ends_with(b"end"));
    streams
        .map(|at| {
            let content = &pdf[at + b"stream\n".len()..];
            let end = places(content, b"\nendstream")[0];
            places(&decompress_to_vec_zlib(&content[..end]).unwrap(), needle.as_bytes()).len()
        })
        .sum()
}

#[test]
fn a_pdf_is_tiled_or_says_that_it_is_reduced() {
    for paper in Paper::SHEETS {
        let options = PdfOptions { paper, ..PdfOptions::default() };
        let tiled = write_pdf(&hull(20.0), &options);
        assert!(tiled.reduced.is_empty());
        assert_eq!(shown(&tiled.bytes, "Measure it both ways"), 1);
        assert!(shown(&tiled.bytes, "This sheet: topside ") > 1);
        assert_eq!(shown(&tiled.bytes, "at 1:1. Print"), shown(&tiled.bytes, "This sheet"));
    }
    for paper in [Paper::A4, Paper::Letter] {
        let options = PdfOptions { paper, ..PdfOptions::default() };
        let made = hull(1000.0);
        let reduced = write_pdf(&made, &options);
        let panels: Vec<usize> = reduced.reduced.iter().map(|r| r.panel).collect();
        assert_eq!(panels, [0, 1, 2]);
        assert_eq!(reduced.reduced[0].scale, 400.0);
        assert_eq!(shown(&reduced.bytes, "Measure it both ways"), 1);
        assert_eq!(shown(&reduced.bytes, "at 1:400. Print"), 3);
        let noted = output_files(&made, &[Format::Pdf], &options).unwrap();
        let codes =
            |n: usize| noted.panels[n].findings.iter().map(Finding::code).collect::<Vec<_>>();
        assert!((0..3).all(|n| codes(n).contains(&"pdf-reduced")));
    }
}

/// Widths and heights of the pages of a PDF, mm.
fn page_sizes_mm(pdf: &[u8]) -> Vec<[f64; 2]> {
    let text = String::from_utf8_lossy(pdf);
    let boxes = text.split("/MediaBox [").skip(1).map(|rest| rest.split(']').next().unwrap());
    let numbers = |one: &str| -> Vec<f64> {
        one.split_whitespace().map(|word| word.parse().unwrap()).collect()
    };
    boxes.map(numbers).map(|box_of| [box_of[2], box_of[3]].map(|pt| pt * 25.4 / 72.0)).collect()
}

#[test]
fn a_roll_is_as_wide_as_it_is_and_as_long_as_need_be() {
    let paper = Paper::parse("Roll:36in").unwrap();
    let written = write_pdf(&hull(45.0), &PdfOptions { paper, ..PdfOptions::default() });
    let sizes = page_sizes_mm(&written.bytes);
    assert!(sizes.len() > 1);
    for size in &sizes {
        assert!((size[0] - 914.4).abs() < 0.01 && size[1] <= 5000.01, "{sizes:?}");
    }
    // Pages that lie along the roll, and no piece in more of them than it is long.
    assert!(sizes.iter().any(|size| size[1] > 2000.0), "{sizes:?}");
    for given in ["roll:", "roll:100mm", "roll:9m", "a9", "projector:2"] {
        assert!(Paper::parse(given).is_err(), "{given}");
    }
}

#[test]
fn a_projector_shows_all_parts_on_one_page_or_each_on_its_own() {
    let made = hull(20.0);
    let written = |paper| write_pdf(&made, &PdfOptions { paper, ..PdfOptions::default() }).bytes;
    let all = written(Paper::Projector);
    assert_eq!(page_sizes_mm(&all).len(), 1);
    assert_eq!(shown(&all, "This page: "), 1);
    assert_eq!(shown(&all, "the lines of the grid are 50 mm apart"), 1);
    let each = written(Paper::ProjectorEach);
    assert_eq!(page_sizes_mm(&each).len(), made.parts.len());
    for part in &made.parts {
        assert_eq!(shown(&each, &format!("This page: {} at 1:1", part.name)), 1);
    }
}

#[test]
fn small_parts_share_pages_and_stand_below_the_check_square_if_they_have_room() {
    let pages = |scale: f64| {
        let written = write_pdf(&hull(scale), &PdfOptions::default());
        (page_sizes_mm(&written.bytes).len(), shown(&written.bytes, "They stand below, at 1:1."))
    };
    assert_eq!(pages(1.0), (1, 1));
    // Two of three share a page, which the overview lists.
    let written = write_pdf(&hull(3.0), &PdfOptions::default()).bytes;
    assert_eq!(page_sizes_mm(&written).len(), 3);
    assert_eq!(shown(&written, ": 2 parts"), 1);
    assert_eq!(shown(&written, "(page "), 2, "strings of a PDF stand in parentheses");
}

/// A machine's files follow the cut of a width; everything else is as without it, and the net is
/// still proved.
#[test]
fn a_kerf_moves_the_cuts_of_files_for_machines_alone() {
    let made = hull(20.0);
    let formats = [Format::Svg, Format::Dxf, Format::Pdf, Format::Parts, Format::Report];
    let files = |kerf_mm: f64| {
        output_files(&made, &formats, OutputOptions { kerf_mm, ..Default::default() }).unwrap()
    };
    let (plain, with_kerf) = (files(0.0), files(0.2));
    assert!(with_kerf.refold_error_mm.iter().all(|&error_mm| error_mm < 1e-9));
    let codes = |outputs: &Outputs| -> Vec<&'static str> {
        outputs.panels.iter().flat_map(|panel| &panel.findings).map(Finding::code).collect()
    };
    assert_eq!(codes(&plain), codes(&with_kerf));
    // The report has refold errors, which differ in their rounding.
    let is_report = |name: &str| name.starts_with("report.");
    for (a, b) in plain.files.iter().zip(&with_kerf.files).filter(|(a, _)| !is_report(&a.name)) {
        let is_cut = a.name.ends_with(".svg") || a.name.ends_with(".dxf");
        assert_eq!(a.bytes != b.bytes, is_cut, "{}", a.name);
    }
    let counted = made.cut_list();
    for item in &counted {
        let piece = item.piece.with_kerf(0.2).unwrap();
        let name = format!("{}.svg", piece.name);
        let written = with_kerf.files.iter().find(|file| file.name == name).unwrap();
        assert_eq!(written.bytes, write_svg(&piece));
        let off = |p: &Point2| {
            let edges = |line: &[Point2]| -> Vec<[Point2; 2]> {
                (0..line.len()).map(|n| [line[n], line[(n + 1) % line.len()]]).collect()
            };
            let old = edges(item.piece.outline());
            old.into_iter().map(|edge| p.distance_to_segment(edge)).fold(f64::INFINITY, f64::min)
        };
        for off_mm in piece.outline().iter().map(off) {
            assert!((0.1 - 1e-6..0.2 + 1e-6).contains(&off_mm), "{off_mm}");
        }
    }
}

#[test]
fn a_kerf_as_wide_as_a_hole_is_refused_in_words() {
    let mut made = hull(20.0);
    let round = |n: u32| {
        let angle = -f64::from(n) * std::f64::consts::TAU / 24.0;
        let middle = made.parts[0].piece.labels[0].at;
        middle + Vec2::new(sheetwright::math::cos(angle), sheetwright::math::sin(angle)) * 0.15
    };
    let (kind, points) = (PathKind::Drill { diameter_mm: 0.3 }, (0..24).map(round).collect());
    let drill = PatternPath { role: Role::Drill, kind, points, closed: true };
    made.parts[0].piece.paths.push(drill);
    let options = |kerf_mm| OutputOptions { kerf_mm, ..OutputOptions::default() };
    let refused = output_files(&made, &[Format::Svg], options(0.3)).unwrap_err();
    let name = &made.parts[0].name;
    let words = format!("panel '{name}': a round hole is no wider than the kerf, 0.3 mm");
    assert_eq!(refused.to_string(), words);
    assert!(output_files(&made, &[Format::Svg], options(0.1)).is_ok());
    assert!(output_files(&made, &[Format::Pdf], options(0.3)).is_ok(), "not for machines");
}

/// The texts of the findings that a PDF shows panels smaller.
fn reductions(made: &Made, max_sheets: MaxSheets) -> Vec<String> {
    let options = PdfOptions { max_sheets, ..PdfOptions::default() };
    let outputs = output_files(made, &[Format::Pdf], &options).unwrap();
    let findings = outputs.panels.into_iter().flat_map(|panel| panel.findings);
    let reductions = findings.filter(|finding| finding.code() == "pdf-reduced");
    reductions.map(|finding| finding_text(&finding)).collect()
}

#[test]
fn as_many_sheets_as_the_finding_names_are_enough() {
    let made = hull(100.0);
    let reduced = write_pdf(&made, &PdfOptions { max_sheets: sheets(10), ..Default::default() });
    assert_eq!(reduced.reduced.len(), 3);
    for Reduced { panel, sheets: enough, file_full, .. } in reduced.reduced {
        assert!(!file_full);
        let texts = reductions(&made, sheets(10));
        assert!(texts[panel].contains(&format!(" allow {enough} sheets. ")), "{texts:?}");
        let options = PdfOptions { max_sheets: sheets(enough as usize), ..Default::default() };
        let left = write_pdf(&made, &options).reduced;
        assert!(left.iter().all(|reduced| reduced.panel != panel && reduced.sheets > enough));
    }
    assert_eq!(reductions(&made, MaxSheets::MOST), [""; 0]);
}

#[test]
fn one_pdf_takes_so_many_sheets_and_no_more() {
    assert_eq!(
        [0, 1, 20_000, 20_001].map(|n| MaxSheets::new(n).is_some()),
        [false, true, true, false]
    );
    let most = MaxSheets::MOST.get();
    // Two panels in rectangles of 20,000 sheets each, and then of more than there are.
    let made = hull(1090.0);
    let texts = reductions(&made, MaxSheets::MOST);
    let full = format!("leave fewer of the {most} that one PDF may have");
    assert_eq!(
        texts.iter().map(|text| text.contains(&full)).collect::<Vec<_>>(),
        [true],
        "{texts:?}"
    );
    let texts = reductions(&hull(10_000.0), MaxSheets::MOST);
    assert_eq!(texts.len(), 3);
    assert!(texts.iter().all(|text| text.contains("the limit of one PDF is 20000")), "{texts:?}");
    assert!(texts.iter().all(|text| !text.contains("allow")));
}

fn sheets(most: usize) -> MaxSheets {
    MaxSheets::new(most).unwrap()
}

#[test]
fn readers_refuse_whatever_is_no_pattern_and_never_panic() {
    let piece = &hull(20.0).parts[1].piece;
    let (svg, dxf) = (write_svg(piece), write_dxf(piece));
    for bytes in [&b""[..], b"\xFF\xFE", b"<svg/>", b"0\nEOF\n", b"  0\r\nSECTION\r\n"] {
        assert!(read_svg(bytes).is_err());
        assert!(read_dxf(bytes).is_err());
    }
    let deep = ["<svg xmlns=\"http://www.w3.org/2000/svg\">", &"<g>".repeat(200_000)].concat();
    assert!(read_svg(deep.as_bytes()).is_err());
    let closed = [&deep, &"</g>".repeat(200_000)[..], "</svg>"].concat();
    assert_eq!(read_svg(closed.as_bytes()), Err(PatternReadError::Units));

    let mut dice = Dice(7);
    for _ in 0..400 {
        for (bytes, read) in [
            (&svg, read_svg as fn(&[u8]) -> Result<ReadPattern, PatternReadError>),
            (&dxf, read_dxf),
        ] {
            let mut broken = bytes.clone();
            for _ in 0..=dice.roll(4) {
                let at = dice.roll(broken.len() as u64) as usize;
                match dice.roll(4) {
                    0 => broken.truncate(at.max(1)),
                    1 => broken[at] = dice.roll(128) as u8,
                    2 => drop(broken.drain(at..(at + 9).min(broken.len()))),
                    _ => broken[at] = b"9-.eE0 \n"[dice.roll(8) as usize],
                }
                if broken.is_empty() {
                    break;
                }
            }
            if let Ok(pattern) = read(&broken) {
                assert!(pattern.rungs.iter().all(|r| r.ends()[1].get() < pattern.outline.len()));
            }
        }
    }
}

#[test]
fn patterns_of_the_neutral_fibre_fold_up_to_its_surface() {
    let settings =
        ["width=600", "diameter=350", "material=steel-1mm", "dimensions=inside"].map(str::to_owned);
    let design = sheetwright_files::design_from_template("square-to-round", &settings).unwrap();
    let made = make(&design, &mut Unwatched).unwrap();
    let found = made.parts[0].found().unwrap();
    let moved = found.surface.positions().iter().zip(made.parts[0].sheet.mesh().positions());
    assert!(moved.clone().all(|(drawn, neutral)| drawn.distance(*neutral) > 0.49));
    let outputs = output_files(&made, &Format::DEFAULT, &PdfOptions::default()).unwrap();
    assert!(outputs.refold_error_mm[0] < 1e-9, "{}", outputs.refold_error_mm[0]);
    let codes = outputs.panels[0].findings.iter().map(|finding| finding.code());
    assert!(codes.clone().all(|code| code != "refold" && code != "length-error"));
}

#[test]
fn a_plan_for_the_brake_names_the_inner_radius_of_folds() {
    let file = r#"{
        "sheetwright": 1, "name": "bracket", "thickness": 2, "dimensions": "outside", "bend_radius": 2.5,
        "curves": {
            "front": { "kind": "polyline", "points": [[0, 0, 50], [0, 0, 0], [50, 0, 0]] },
            "back": { "kind": "polyline", "points": [[0, 80, 50], [0, 80, 0], [50, 80, 0]] }
        },
        "panels": [{ "name": "bracket", "rails": ["front", "back"], "samples": 5 }]
    }"#;
    let (format, options) = (InputFormat::Design, ReadOptions::default());
    let design = read_bytes(format, file.as_bytes(), "bracket.sheet.json", None, &options).unwrap();
    let made = make(&design, &mut Unwatched).unwrap();
    let formats = [Format::Brake, Format::Report];
    let outputs = output_files(&made, &formats, OutputOptions::default()).unwrap();
    let table = text(&outputs.files[0].bytes);
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    let column = rows[0].iter().position(|&name| name == "inside_radius_mm").unwrap();
    assert_eq!(rows.len(), 2, "{table}");
    assert_eq!((rows[1][2], rows[1][column]), ("fold", "2.500"));
    let page = outputs.files.iter().find(|file| file.name == "report.html").unwrap();
    assert!(text(&page.bytes).contains("inside 2.5"));
}

#[test]
fn a_plan_for_the_brake_warns_in_the_table_the_report_and_the_findings() {
    let settings = ["material=steel-1mm".to_owned()];
    let design = sheetwright_files::design_from_template("square-to-round", &settings).unwrap();
    let made = make(&design, &mut Unwatched).unwrap();
    let brake = BrakeSettings { length_mm: Some(380.0), ..BrakeSettings::default() };
    let options = OutputOptions { brake, ..OutputOptions::default() };
    let outputs = output_files(&made, &[Format::Brake, Format::Report], options).unwrap();
    let file = |name: &str| {
        let file = outputs.files.iter().find(|file| file.name == name).unwrap();
        text(&file.bytes).to_owned()
    };
    let table = file("brake.csv");
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows.len(), 25, "a header, and 24 hits");
    // Lines of one corner meet in it, and the die is eight thicknesses.
    assert!(rows[2].contains(",0.0 mm from line 1; half the die opening is 4.0 mm"), "{}", rows[2]);
    assert!(rows[1..].iter().any(|row| row.contains("mm long; the brake is 380 mm")));
    assert!(file("report.html").contains("Bends, in order"));
    let codes: Vec<&str> = outputs.panels[0].findings.iter().map(|f| f.code()).collect();
    assert!(codes.contains(&"bend-lines-close") && codes.contains(&"bend-lines-long"), "{codes:?}");

    let brake = BrakeSettings { rolls: true, ..BrakeSettings::default() };
    let options = OutputOptions { brake, ..OutputOptions::default() };
    let rolled = output_files(&made, &[Format::Brake], options).unwrap();
    assert!(text(&rolled.files[0].bytes).starts_with("part,station,kind,direction,x1_mm"));
    assert!(rolled.panels[0].findings.iter().all(|f| !f.code().starts_with("bend-lines-")));
}
