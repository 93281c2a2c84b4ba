use super::*;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

const SQUARE: &str = "0 LWPOLYLINE/8 0/90 4/70 1/10 0/20 0/10 100/20 0/10 100/20 100/10 0/20 100/";

#[test]
fn every_entity_has_its_length() {
    let w = FRAC_1_SQRT_2;
    let circle: String = [
        (1., 0.),
        (1., 1.),
        (0., 1.),
        (-1., 1.),
        (-1., 0.),
        (-1., -1.),
        (0., -1.),
        (1., -1.),
        (1., 0.),
    ]
    .iter()
    .map(|(x, y)| format!("10 {}/20 {}/30 5/", 100.0 * x, 100.0 * y))
    .collect();
    let weights: String =
        (0..9).map(|n| format!("41 {}/", if n % 2 == 0 { 1.0 } else { w })).collect();
    let knots: String =
        [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4].iter().map(|k| format!("40 {k}/")).collect();
    let nurbs = format!("0 SPLINE/8 0/70 4/71 2/72 12/73 9/{knots}{weights}{circle}");
    let lines: String = [[0, 0, 100, 0], [100, 100, 100, 0], [100, 100, 0, 100], [0, 0, 0, 100]]
        .iter()
        .map(|[a, b, c, d]| format!("0 LINE/8 0/10 {a}/20 {b}/11 {c}/21 {d}/"))
        .collect();
    for (entities, expected) in [
        (SQUARE, 400.0),
        (&lines, 400.0),
        // Half a circle and its diameter; a circle of two bulges; a bulge of a quarter, clockwise.
        ("0 LWPOLYLINE/8 0/90 2/70 1/10 0/20 0/42 1/10 100/20 0/", 100.0 + 50.0 * PI),
        ("0 LWPOLYLINE/8 0/90 2/70 1/10 0/20 0/42 1/10 100/20 0/42 1/", 100.0 * PI),
        (
            "0 LWPOLYLINE/8 0/90 3/70 1/10 0/20 0/10 100/20 0/42 -0.4142135623730951/10 0/20 100/",
            200.0 + 50.0 * PI,
        ),
        (
            "0 POLYLINE/8 0/66 1/70 1/0 VERTEX/8 0/10 0/20 0/42 1/0 VERTEX/8 0/10 100/20 0/0 \
             SEQEND/8 0/",
            100.0 + 50.0 * PI,
        ),
        ("0 CIRCLE/8 0/10 5/20 5/40 50/", 100.0 * PI),
        (
            "0 ARC/8 0/10 0/20 0/40 50/50 90/51 180/0 ARC/8 0/10 0/20 0/40 50/50 180/51 90/",
            100.0 * PI,
        ),
        (
            "0 ARC/8 0/10 0/20 0/40 50/50 350/51 170/0 LINE/8 0/10 49.24038765061041/20 \
             -8.682408883346517/11 -49.24038765061041/21 8.682408883346517/",
            100.0 + 50.0 * PI,
        ),
        ("0 ELLIPSE/8 0/10 0/20 0/11 30/21 40/40 1/41 0/42 6.283185307179586/", 100.0 * PI),
        (&nurbs, 200.0 * PI),
        // Mirrored, as the back of a drawing is: the direction of extrusion points down.
        ("0 CIRCLE/8 0/10 5/20 5/40 50/210 0/220 0/230 -1/", 100.0 * PI),
        ("0 CIRCLE/8 0/10 5/20 5/40 50/210 1/220 0/230 0/", 100.0 * PI),
    ] {
        let design = dxf(entities);
        has_lengths(&design, &[expected], entities);
        let panel = &design.panels[0];
        assert!(panel.name == "a" && panel.tolerance.is_some());
    }
}

#[test]
fn units_are_those_of_the_header() {
    for (unit, side) in
        [("70 1", 25.4), ("70 2", 304.8), ("70 4", 1.0), ("70 5", 10.0), ("70 6", 1e3)]
    {
        let design = try_dxf(&file(unit, "", SQUARE)).unwrap();
        has_lengths(&design, &[400.0 * side], unit);
        assert_eq!(design.notes, []);
    }
    for unit in ["70 0", "70 99", "40 1"] {
        let design = try_dxf(&file(unit, "", SQUARE)).unwrap();
        has_lengths(&design, &[400.0], unit);
        assert_eq!(design.notes, [ReadNote::NoUnit { unit_mm: 1.0 }]);
    }
}

#[test]
fn blocks_are_drawn_where_they_are_inserted() {
    let block = format!("0 BLOCK/2 Part/10 50/20 50/{SQUARE}0 ENDBLK/");
    let twice = "0 BLOCK/2 pair/10 0/20 0/0 INSERT/8 0/2 PART/10 0/20 0/0 INSERT/8 0/2 part/10 \
                 500/20 0/0 ENDBLK/";
    let blocks = format!("{block}{twice}");
    let once = "0 INSERT/8 on/2 part/10 1000/20 0/41 2/42 2/50 30/";
    let design = try_dxf(&file("70 4", &blocks, once)).unwrap();
    has_lengths(&design, &[800.0], once);
    // The middle of the square, its base point, is where the block is inserted.
    let low = design.curves[0].points.iter().map(|p| p.at.x).fold(f64::INFINITY, f64::min);
    let reach = 100.0 * (0.5 + 0.75f64.sqrt());
    assert!((low - (1000.0 - reach)).abs() < 1e-9, "{low}");
    let grid = "0 INSERT/8 on/2 part/10 0/20 0/70 3/71 2/44 150/45 150/";
    has_lengths(&try_dxf(&file("70 4", &blocks, grid)).unwrap(), &[400.0; 6], grid);
    let nested = "0 INSERT/8 on/2 pair/10 0/20 0/41 -1/";
    let design = try_dxf(&file("70 4", &blocks, nested)).unwrap();
    has_lengths(&design, &[400.0; 2], nested);
    assert_eq!(names(&design), ["PART", "part 2"]);
}

#[test]
fn rails_may_be_polylines_in_space() {
    let rail = |layer: &str, z: f64, bend: f64| {
        let vertex = |n: i32| {
            let x = 100.0 * f64::from(n);
            let y = bend * x * (1000.0 - x) / 250_000.0;
            format!("0 VERTEX/8 {layer}/10 {x}/20 {y}/30 {z}/70 32/")
        };
        let vertices: String = (0..=10).map(vertex).collect();
        format!("0 POLYLINE/8 {layer}/66 1/70 8/{vertices}0 SEQEND/8 {layer}/")
    };
    let both = rail("keel", 0.0, 100.0) + &rail("Sheer", 300.0, 150.0);
    let design = dxf(&both);
    assert_eq!(shapes(&design), [["keel", "Sheer"]]);
    assert!(
        design
            .notes
            .contains(&ReadNote::TakenForRails { names: ["keel", "Sheer"].map(str::to_owned) })
    );
    assert!(
        design
            .notes
            .iter()
            .any(|note| matches!(note, ReadNote::Smoothed { names } if names.len() == 2))
    );
    // Smooth through its points, it is nearer to the parabola than its chords are.
    let curve = built(&design.curves[0]);
    let middle = curve.position(4.5);
    let parabola = 100.0 * middle.x * (1000.0 - middle.x) / 250_000.0;
    assert!((middle.y - parabola).abs() < 0.05, "{middle:?}");
    let options = ReadOptions { rails: ["sheer", "KEEL"].map(str::to_owned).to_vec(), ..options() };
    let text = dxf_text(&(both + SQUARE));
    let design = read(DrawingFormat::Dxf, text.as_bytes(), "a.dxf", &options).unwrap();
    assert_eq!(
        (shapes(&design), unused(&design)),
        (vec![vec!["sheer", "KEEL"]], vec![(Unused::NotNamed, 1)])
    );
}

#[test]
fn what_bounds_nothing_is_counted() {
    let others = "0 TEXT/8 0/1 a/0 MTEXT/8 0/1 a/0 HATCH/8 0/0 DIMENSION/8 0/0 POINT/8 0/10 1/20 2/0 \
                  3DFACE/8 0/0 LINE/8 off/10 0/11 5/0 LINE/8 0/67 1/10 0/11 5/0 XLINE/8 0/10 0/0 \
                  INSERT/8 0/2 nowhere/0 LINE/8 0/10 500/11 600/21 50/";
    let design = dxf(&format!("{SQUARE}{others}"));
    assert_eq!(
        unused(&design),
        [
            (Unused::Open, 1),
            (Unused::Hidden, 1),
            (Unused::Text, 2),
            (Unused::Hatch, 1),
            (Unused::Dimension, 1),
            (Unused::Point, 1),
            (Unused::Surface, 1),
            (Unused::Page, 1),
            (Unused::Other, 2),
        ]
    );
}

#[test]
fn what_is_no_drawing_is_refused_in_words() {
    let blocks: String = (0..9)
        .map(|n| {
            let copies = format!("0 INSERT/8 0/2 b{n}/").repeat(10);
            format!("0 BLOCK/2 b{}/{copies}0 ENDBLK/", n + 1)
        })
        .collect();
    let laughs =
        file("70 4", &format!("0 BLOCK/2 b0/{SQUARE}0 ENDBLK/{blocks}"), "0 INSERT/8 0/2 b9/");
    let itself = file("70 4", "0 BLOCK/2 a/0 INSERT/8 0/2 a/0 ENDBLK/", "0 INSERT/8 0/2 a/");
    for (text, says) in [
        ("AutoCAD Binary DXF\r\n\u{1a}".to_owned(), "binary"),
        ("AC1032".to_owned(), "DWG"),
        ("hello\nworld\n".to_owned(), "'hello' stands where"),
        ("0\nSECTION\n2\n".to_owned(), "ends within"),
        ("0\nEOF\n".to_owned(), "no section of entities"),
        (dxf_text(""), "has no curve"),
        (dxf_text("0 LINE/8 0/10 0/11 5/"), "not closed"),
        (dxf_text("0 LINE/8 0/10 nan/11 5/"), "no finite number"),
        (dxf_text("0 SPLINE/8 0/71 3/10 0/20 0/10 1/20 1/"), "2 control points and degree 3"),
        (dxf_text("0 SPLINE/8 0/71 1/40 0/40 0/40 1/10 0/20 0/10 1/20 1/"), "3 knots and needs 4"),
        (
            dxf_text("0 LINE/8 a/10 0/11 5/0 LINE/8 b/10 0/11 5/21 5/0 LINE/8 c/10 0/11 5/21 9/"),
            "3 open curves",
        ),
        (itself, "more than 32 blocks"),
        (laughs, "more than 300000 pieces"),
    ] {
        let error = try_dxf(&text).unwrap_err();
        assert!(error.message.contains(says) && !error.hint.is_empty(), "{says}: {error:?}");
    }
}

#[test]
fn bulges_of_rounding_are_straight_and_every_gap_counts() {
    for bulge in ["1e-14", "-1e-16", "1e-9"] {
        let text =
            format!("0 LWPOLYLINE/8 0/90 3/70 1/10 0/20 0/42 {bulge}/10 100/20 37/10 0/20 90/");
        let design = dxf(&text);
        assert_eq!(design.curves[0].kind, Some(CurveKind::Polyline), "{bulge}");
    }
    let sides =
        [[0.0, 0.0, 99.995, 0.0], [100.0, 0.0, 100.0, 99.995], [100.0, 100.0, 0.005, 100.0]];
    let lines: String = sides
        .iter()
        .chain(&[[0.0, 100.0, 0.0, 0.005]])
        .map(|[a, b, c, d]| format!("0 LINE/8 0/10 {a}/20 {b}/11 {c}/21 {d}/"))
        .collect();
    let notes = dxf(&lines).notes;
    assert!(matches!(notes[..], [ReadNote::GapsClosed { count: 4, .. }]), "{notes:?}");
}

#[test]
fn codes_and_units_that_are_odd_are_no_faults() {
    let odd = "0 SPLINE/8 0/70 0/-2147483648 1/11 0/21 0/11 50/21 20/11 100/21 0/";
    assert_eq!(try_dxf(&dxf_text(&format!("{odd}{SQUARE}"))).unwrap().panels.len(), 1);
    let feet = try_dxf(&file("70 21", "", SQUARE)).unwrap();
    has_lengths(&feet, &[400.0 * 1_200_000.0 / 3937.0], "US survey feet");
}
