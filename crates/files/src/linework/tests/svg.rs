use super::*;
use std::f64::consts::PI;

/// The length of the cubic 0,0 0,100 100,100 100,0, by 2,000 chords with their ends refined.
fn bow() -> f64 {
    let point = |t: f64| {
        let s = 1.0 - t;
        let x = 100.0 * (3.0 * s * t * t + t * t * t);
        (x, 100.0 * (3.0 * s * s * t + 3.0 * s * t * t))
    };
    length(point)
}

/// The length of a plane curve over 0 ..= 1 by Richardson extrapolation of chords.
fn length(point: impl Fn(f64) -> (f64, f64)) -> f64 {
    let chords = |n: usize| -> f64 {
        let at = |k: usize| point(k as f64 / n as f64);
        (0..n)
            .map(|k| {
                let ((ax, ay), (bx, by)) = (at(k), at(k + 1));
                ((bx - ax) * (bx - ax) + (by - ay) * (by - ay)).sqrt()
            })
            .sum()
    };
    (4.0 * chords(4000) - chords(2000)) / 3.0
}

/// The length of the parabola 0,0 50,100 100,0.
fn parabola() -> f64 {
    length(|t| (100.0 * t, 200.0 * t * (1.0 - t)))
}

#[test]
fn every_command_of_a_path_has_its_length() {
    let square = 400.0;
    let half = 100.0 + 50.0 * PI;
    let quarter = 200.0 + 50.0 * PI;
    for (data, expected) in [
        ("M0,0 L100,0 L100,100 L0,100 Z", square),
        ("m0,0 l100,0 l0,100 l-100,0 z", square),
        // Implicit repeats, of a move as lines.
        ("M0 0 100 0 100 100 0 100z", square),
        ("m0 0 100 0 0 100-100 0Z", square),
        ("M0,0 H100 V100 H0 Z", square),
        ("m0,0 h100 v100 h-100 z", square),
        ("M0,0 h50 50 v40 60 h-30-70 z", square),
        // Closed by its last line, without Z.
        ("M0,0 H100 V100 H0 V0", square),
        ("M0,0 C0,100 100,100 100,0 Z", bow() + 100.0),
        ("m0,0 c0,100 100,100 100,0 z", bow() + 100.0),
        // The mirrored control point makes the second bow as long as the first.
        ("M0,0 C0,100 100,100 100,0 S200,-100 200,0 Z", 2.0 * bow() + 200.0),
        ("m0,0 c0,100 100,100 100,0 s100,-100 100,0 z", 2.0 * bow() + 200.0),
        // Without a curve before it, the first control point is the pen.
        (
            "M0,0 S100,100 100,0 Z",
            100.0
                + length(|t| {
                    let s = 1.0 - t;
                    (100.0 * (3.0 * s * t * t + t * t * t), 300.0 * s * t * t)
                }),
        ),
        ("M0,0 Q50,100 100,0 Z", parabola() + 100.0),
        ("m0,0 q50,100 100,0 z", parabola() + 100.0),
        ("M0,0 Q50,100 100,0 T200,0 Z", 2.0 * parabola() + 200.0),
        ("m0,0 q50,100 100,0 t100,0 z", 2.0 * parabola() + 200.0),
        // Without a parabola before it, a straight line.
        ("M0,0 T100,0 L100,100 0,100 Z", square),
        ("M0,0 A50,50 0 0 1 100,0 Z", half),
        ("m0,0 a50,50 0 0 0 100,0 z", half),
        ("M0,0 A50 50 0 1 1 100 0 z", half),
        // Flags without separators, and radii that are too small grow.
        ("M0 0a10 10 0 01100 0z", half),
        ("M0,0 L100,0 A100,100 0 0 1 0,100 Z", quarter),
        ("M0,0 L100,0 A100,100 0 1 0 0,100 Z", 200.0 + 150.0 * PI),
        // A radius of 0 is a line.
        ("M0,0 A0,50 0 0 1 100,0 V100 H0 Z", square),
        ("M.0.0L1e2-0L+100,100,0,1.e2z", square),
    ] {
        has_lengths(&svg(&format!("<path d='{data}'/>")), &[expected], data);
    }
}

#[test]
fn an_ellipse_that_is_turned_is_as_long() {
    let straight = lengths(&svg("<ellipse cx='200' cy='200' rx='120' ry='50'/>"))[0];
    let exact = length(|t| {
        let angle = 2.0 * PI * t;
        (120.0 * sheetwright::math::cos(angle), 50.0 * sheetwright::math::sin(angle))
    });
    assert!((straight - exact).abs() < 1e-6 * exact);
    let arcs =
        "<path d='M200 200a120 50 30 1 0 103.9230484541 60 120 50 30 1 0 -103.9230484541 -60z'/>";
    // Two halves between ends that are no diameter: each more than half of it.
    let turned = lengths(&svg(arcs))[0];
    assert!(turned > exact && turned < 2.0 * exact, "{turned} {exact}");
}

#[test]
fn shapes_have_their_lengths() {
    for (shape, expected) in [
        ("<rect x='10' y='10' width='100' height='50'/>", 300.0),
        ("<rect width='100' height='50' rx='10'/>", 300.0 - 80.0 + 20.0 * PI),
        (
            "<rect width='100' height='50' ry='100' rx='10'/>",
            80.0 * 2.0
                + length(|t| {
                    let angle = 2.0 * PI * t;
                    (10.0 * sheetwright::math::cos(angle), 25.0 * sheetwright::math::sin(angle))
                }),
        ),
        ("<circle cx='5cm' cy='50' r='30'/>", 60.0 * PI),
        ("<circle r='10%'/>", 200.0 * PI),
        ("<polygon points='0,0 100,0 100 100,0,100'/>", 400.0),
        ("<polyline points='0,0 100,0 100,100 0,100 0,0'/>", 400.0),
        (
            "<g transform='scale(2)'><circle r='30' transform='translate(9) rotate(40)'/></g>",
            120.0 * PI,
        ),
        (
            "<g transform='matrix(1 0 0 1 5 5) skewX(45)'><rect width='100' height='100'/></g>",
            200.0 + 200.0 * std::f64::consts::SQRT_2,
        ),
        ("<defs><circle id='c' r='20'/></defs><use xlink:href='#c' x='50' y='5'/>", 40.0 * PI),
        (
            "<symbol id='s' viewBox='0 0 10 10'><circle cx='5' cy='5' r='5'/></symbol>\
          <use href='#s' width='80' height='80'/>",
            80.0 * PI,
        ),
        (
            "<svg x='10' y='10' width='100' height='300' viewBox='0 0 10 10'><circle r='4'/></svg>",
            80.0 * PI,
        ),
    ] {
        // In a page whose unit is a millimetre, a centimetre is 96/2.54 of them.
        has_lengths(&svg(shape), &[expected], shape);
    }
}

#[test]
fn pages_have_their_units() {
    let square = "<rect width='10' height='10'/>";
    for (head, side) in [
        ("width='100mm' height='100mm' viewBox='0 0 100 100'", 10.0),
        ("width='10cm' height='10cm' viewBox='0 0 1000 1000'", 1.0),
        ("width='4in' height='4in' viewBox='0 0 40 40'", 25.4),
        ("width='72pt' height='72pt' viewBox='0 0 72 72'", 254.0 / 72.0),
        ("width='6pc' height='6pc' viewBox='0 0 10 10'", 25.4),
        ("width='960' height='960'", 2.5 * 25.4 / 24.0),
        ("viewBox='0 0 960 960'", 25.4 / 9.6),
        ("width='100%' height='100%' viewBox='0 0 96 96'", 25.4 / 9.6),
        ("width='100mm' viewBox='0 0 50 20'", 20.0),
        // Not of the proportions of its page: fitted into it.
        ("width='100mm' height='50mm' viewBox='0 0 10 10'", 50.0),
        ("width='96px' height='96px' viewBox='0 0 10 10'", 25.4),
    ] {
        let text = format!("<svg xmlns='http://www.w3.org/2000/svg' {head}>{square}</svg>");
        let design = try_svg(&text).unwrap();
        has_lengths(&design, &[4.0 * side], head);
        let is_said = design.notes.iter().any(|note| matches!(note, ReadNote::NoUnit { .. }));
        assert_eq!(
            is_said,
            !["mm", "cm", "in'", "pt", "pc"].iter().any(|u| head.contains(u)),
            "{head}"
        );
        let options = ReadOptions { units: Some(crate::Units::Inches), ..options() };
        let design = read(DrawingFormat::Svg, text.as_bytes(), "a.svg", &options).unwrap();
        has_lengths(&design, &[4.0 * 254.0], head);
    }
}

#[test]
fn lines_and_corners_stay_exact() {
    let design = svg("<path d='M100 100H300.5V200A50 50 0 0 1 250.5 250H100Z'/>");
    let points = &design.curves[0].points;
    let corners: Vec<[f64; 2]> =
        points.iter().filter(|p| p.corner).map(|p| [p.at.x, p.at.y]).collect();
    let expected = [[100.0, 900.0], [300.5, 900.0], [300.5, 800.0], [250.5, 750.0], [100.0, 750.0]];
    let is_there = |e: &[f64; 2]| {
        corners.iter().any(|c| (c[0] - e[0]).abs() < 1e-12 && (c[1] - e[1]).abs() < 1e-12)
    };
    assert!(corners.len() == 5 && expected.iter().all(is_there), "{corners:?}");
    // What is seen from above runs counter-clockwise, as it was drawn.
    let area: f64 = points
        .iter()
        .zip(points.iter().cycle().skip(1))
        .map(|(a, b)| 0.5 * (a.at.x * b.at.y - a.at.y * b.at.x))
        .sum();
    assert!((area - (200.5 * 150.0 - 2500.0 * (1.0 - PI / 4.0))).abs() < 5.0, "{area}");
}

#[test]
fn what_is_not_shown_bounds_nothing() {
    let design = svg("<g inkscape:label='old' style='fill:none;display:none'><circle r='9'/></g>\
         <circle r='3' visibility='hidden'/><text>a</text><image href='a.png'/>\
         <clipPath><circle r='1'/></clipPath><defs><circle r='2'/></defs>\
         <g inkscape:label='engrave'><path d='M0 0h5'/></g>\
         <rect id='lid' width='100' height='50'/><rect width='100' height='50'/>");
    assert_eq!(names(&design), ["lid"]);
    assert_eq!(
        unused(&design),
        [
            (Unused::Doubled, 1),
            (Unused::Marks, 1),
            (Unused::Hidden, 2),
            (Unused::Text, 1),
            (Unused::Image, 1)
        ]
    );
}

#[test]
fn what_is_no_drawing_is_refused_in_words() {
    let laughs: String = (0..9)
        .map(|n| {
            let copies = format!("<use href='#g{n}'/>").repeat(10);
            format!("<g id='g{}'>{copies}</g>", n + 1)
        })
        .collect();
    for (text, says) in [
        ("<html/>".to_owned(), "no SVG"),
        ("<svg>".to_owned(), "no XML"),
        (page(""), "has no curve"),
        (page("<text>a</text>"), "no curve that can bound"),
        (page("<path d='M0 0L1'/>"), "can't be read"),
        (page("<path d='M0 0H9V9' transform='turn(3)'/>"), "its transform is"),
        (page("<rect width='wide' height='1'/>"), "no length"),
        (page("<path d='M0 0H9V9'/>"), "not closed: its ends are 12.728 mm apart"),
        (page("<path d='M0 0H1e300V9e300Z'/>"), ""),
        (page("<g id='a'><use href='#a'/></g>"), "more than 64"),
        (page(&format!("<g id='g0'><circle r='1'/></g>{laughs}")), "more than 300000 pieces"),
    ] {
        let error = try_svg(&text).unwrap_err();
        assert!(error.message.contains(says) && !error.hint.is_empty(), "{says}: {error:?}");
    }
}

#[test]
fn arcs_of_circles_too_large_are_straight_and_bad_points_are_named() {
    let design = svg("<path d='M0 0A1e16 1e16 0 0 1 100 37L0 90Z'/>");
    assert_eq!(design.curves[0].kind, Some(CurveKind::Polyline));
    let error = try_svg(&page("<polygon points='0,0 100,0 100,100 x 0,100'/>")).unwrap_err();
    assert!(error.message.contains("its points:"), "{error:?}");
}

#[test]
fn copies_of_long_data_are_bounded() {
    let long = "M0 0".repeat(100_000);
    let uses = "<use href='#a'/>".repeat(2000);
    let text = page(&format!("<defs><path id='a' d='{long}'/></defs>{uses}"));
    assert!(try_svg(&text).unwrap_err().message.contains("more than 300000 pieces"));
    let titles = "<title/>".repeat(1000);
    let uses = "<use href='#g'/>".repeat(1000);
    let text = page(&format!("<defs><g id='g'>{titles}</g></defs>{uses}"));
    assert!(try_svg(&text).unwrap_err().message.contains("more than 300000 pieces"));
}
