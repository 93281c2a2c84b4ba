use super::*;

fn square(attributes: &str, x: f64, side: f64) -> String {
    format!("<rect {attributes} x='{x}' y='{x}' width='{side}' height='{side}'/>")
}

#[test]
fn closed_curves_are_outlines_and_holes_by_turns() {
    let all = square("id='sheet'", 0.0, 500.0)
        + &square("id='window'", 50.0, 200.0)
        + &square("id='island'", 80.0, 50.0)
        + &square("id='slot'", 300.0, 50.0)
        + &square("id='other'", 600.0, 50.0);
    let design = svg(&all);
    let expected: [&[&str]; 3] = [&["sheet", "window", "slot"], &["island"], &["other"]];
    assert_eq!(shapes(&design), expected);
    let panels: Vec<&str> = design.panels.iter().map(|panel| panel.name.as_str()).collect();
    assert_eq!(panels, ["sheet", "island", "other"]);
}

#[test]
fn names_come_before_places() {
    let told = square("id='outline-a'", 0.0, 500.0)
        + &square("inkscape:label='Outline b' id='x'", 50.0, 200.0)
        + &square("id='inner'", 80.0, 50.0)
        + &square("id='beside'", 600.0, 50.0);
    let design = svg(&told);
    let expected: [&[&str]; 2] = [&["outline-a"], &["Outline b", "inner"]];
    assert_eq!(shapes(&design), expected);
    assert_eq!(unused(&design), [(Unused::Closed, 1)]);
    // A layer of outlines has their holes as well.
    let layer = format!(
        "<g inkscape:label='OUTLINES'>{}{}</g>",
        square("id='a'", 0.0, 500.0),
        square("id='b'", 50.0, 200.0)
    );
    assert_eq!(shapes(&svg(&layer)), [["a", "b"]]);
    let hole = square("id='hole'", 0.0, 10.0);
    let error = try_svg(&page(&hole)).unwrap_err();
    assert_eq!(error.message, "the drawing has holes and no outline");
}

#[test]
fn rails_are_found_by_their_names() {
    let rails = "<path id='rail-sheer' d='M0 0C100 50 200 50 300 0'/>\
                 <path id='Rail_keel' d='M0 0C100 90 200 90 300 99'/>\
                 <circle id='c' r='5'/>";
    let design = svg(rails);
    // They meet in a point, and are two all the same.
    assert_eq!(shapes(&design), [["rail-sheer", "Rail_keel"]]);
    assert_eq!(unused(&design), [(Unused::NotNamed, 1)]);
    let layers = "<g id='rail-a'><path d='M0 0h9'/><path d='M0 9h9'/></g>\
                  <g id='rail-b'><path d='M0 20h9'/><path d='M0 30h9'/></g>";
    assert_eq!(svg(layers).panels.len(), 2);
    let three = "<g id='rail'><path d='M0 0h9'/><path d='M0 9h9'/><path d='M0 15h9'/></g>";
    let error = try_svg(&page(three)).unwrap_err();
    assert!(error.message.starts_with("3 curves are named for rails"), "{error:?}");
}

#[test]
fn rails_are_found_by_the_call() {
    let lines = "<path id='keel' d='M0 0h9'/><path id='chine' d='M0 9h5'/>\
                 <path id='chine' d='M5 9h4'/><path id='sheer' d='M0 15h9'/>";
    let with = |rails: &[&str]| {
        let rails = rails.iter().map(|rail| (*rail).to_owned()).collect();
        let options = ReadOptions { rails, ..options() };
        read(DrawingFormat::Svg, page(lines).as_bytes(), "a.svg", &options)
    };
    let design = with(&["keel", "chine", "sheer"]).unwrap();
    assert_eq!(shapes(&design), [["keel", "chine"], ["chine", "sheer"]]);
    has_lengths(&design, &[9.0; 3], lines);
    let names: Vec<&str> = design.panels.iter().map(|panel| panel.name.as_str()).collect();
    assert_eq!(names, ["keel-chine", "chine-sheer"]);
    assert_eq!(unused(&with(&["keel", "sheer"]).unwrap()), [(Unused::NotNamed, 2)]);
    let error = with(&["keel", "shear"]).unwrap_err();
    assert_eq!(error.message, "no curve or layer is called 'shear'");
    assert!(error.hint.starts_with("Did you mean 'sheer'?"), "{error:?}");
    assert_eq!(with(&["keel"]).unwrap_err().message, "'keel' is one curve");
}

#[test]
fn ends_that_nearly_meet_are_joined() {
    let square = |gap: f64| format!("<path d='M0 0H100V100'/><path d='M0 {gap}V100H100'/>");
    let design = svg(&square(0.01));
    assert!(design.curves[0].closed);
    let gap = |note: &ReadNote| match note {
        ReadNote::GapsClosed { count, widest_mm, .. } => Some((*count, *widest_mm)),
        _ => None,
    };
    let gaps: Vec<_> = design.notes.iter().filter_map(gap).collect();
    assert!(gaps.len() == 1 && gaps[0].0 == 1 && (gaps[0].1 - 0.01).abs() < 1e-9, "{gaps:?}");
    // A gap that is wider stays, and is named with its place.
    let error = try_svg(&page(&square(0.5))).unwrap_err();
    assert!(error.message.contains("0.500 mm apart"), "{error:?}");
}

#[test]
fn a_fork_joins_nothing_by_chance() {
    let fork = "<path d='M0 0H100V100H0V50'/><path d='M0 50V0'/><path d='M0 50H-40'/>";
    let error = try_svg(&page(fork)).unwrap_err();
    assert!(error.hint.contains("three ends or more meet"), "{error:?}");
}

#[test]
fn two_rings_in_space_are_the_borders_of_one_panel() {
    let rings = "0 CIRCLE/8 top/10 0/20 0/30 200/40 50/0 CIRCLE/8 bottom/10 0/20 0/40 150/";
    let design = dxf(rings);
    assert_eq!(shapes(&design), [["top", "bottom"]]);
    let names = ["top", "bottom"].map(str::to_owned);
    assert_eq!(design.notes, [ReadNote::TakenForRing { names }]);
}

#[test]
fn only_what_lies_on_the_very_line_is_drawn_twice() {
    let halves = "<polygon id='lower' points='0,0 100,0 0,100'/>\
                  <polygon id='upper' points='100,0 100,100 0,100'/>\
                  <polygon id='again' points='0,100 100,0 100,100'/>";
    let design = svg(halves);
    assert_eq!(shapes(&design), [["lower"], ["upper"]]);
    assert_eq!(unused(&design), [(Unused::Doubled, 1)]);
    // Two curves through the same three points.
    let round = svg("<ellipse id='low' cx='200' cy='200' rx='50' ry='20'/>\
                     <circle id='round' cx='200' cy='200' r='50'/>");
    assert_eq!(shapes(&round), [["round", "low"]]);
    // Of a mark and an outline in one place, the outline counts, whichever comes first.
    let both = svg("<rect class='engrave' width='100' height='50'/>\
                    <rect id='lid' width='100' height='50'/>");
    assert_eq!(shapes(&both), [["lid"]]);
    assert_eq!(unused(&both), [(Unused::Marks, 1)]);
}

#[test]
fn holes_lie_in_the_smallest_outline_around_them() {
    let counterbore = "<rect id='outline-a' width='100' height='100'/>\
                       <rect id='outline-b' x='200' width='100' height='100'/>\
                       <g id='holes'><circle id='wide' cx='50' cy='50' r='20'/>\
                       <circle id='narrow' cx='50' cy='50' r='8'/></g>";
    assert_eq!(shapes(&svg(counterbore)), [vec!["outline-a", "wide", "narrow"], vec!["outline-b"]]);
    let outside = page(
        "<rect id='outline' width='100' height='100'/>\
                        <circle id='hole' cx='500' cy='500' r='20'/>",
    );
    assert_eq!(try_svg(&outside).unwrap_err().message, "the hole 'hole' lies in no outline");
}

#[test]
fn specks_are_named_and_refuse_nothing() {
    let specks = "<rect id='lid' width='100' height='100'/><path d='M50 50h0.005'/>\
                  <path d='M20 20h9Z'/>";
    let design = svg(specks);
    assert_eq!(shapes(&design), [["lid"]]);
    assert_eq!(unused(&design), [(Unused::Open, 1), (Unused::Closed, 1)]);
}

#[test]
fn plane_rails_keep_their_corners() {
    let rails = "<path id='rail-a' d='M0 0L100 10L200 0L300 -10L400 0'/>\
                 <path id='rail-b' d='M0 50L100 60L200 50L300 40L400 50'/>";
    let design = svg(rails);
    assert!(design.curves.iter().all(|curve| curve.kind == Some(CurveKind::Polyline)));
    assert_eq!(design.notes, []);
}

#[test]
fn many_curves_without_names_are_numbered_at_once() {
    let holes: String = (0..3000)
        .map(|n| format!("<circle cx='{}' cy='{}' r='1'/>", 5 + n % 100 * 9, 5 + n / 100 * 9))
        .collect();
    let design = svg(&format!("<rect id='plate' width='999' height='999'/>{holes}"));
    assert_eq!((design.panels.len(), design.curves.len()), (1, 3001));
    assert_eq!(design.curves[3000].name, "curve 3000");
}
