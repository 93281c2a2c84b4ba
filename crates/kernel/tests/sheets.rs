//! Parts of a design on its sheets: counts, grain, mirror images, and what a sheet shows.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::design::{
    Design, DesignCurve, Mark, MarkKind, MarkOn, MarkWay, SheetForm, Stock, StockSheet, Turn,
};
use sheetwright::make::{Made, beside_each_other, make};
use sheetwright::math::{Vec2, cos, from_deg, unit2};
use sheetwright::pattern::{LabelKind, PathKind, Piece, Role};
use sheetwright::predicate::{inside, signed_area_doubled};
use sheetwright::template::template;
use sheetwright::watch::Unwatched;

fn stock(size: [f64; 2]) -> Stock {
    let sheet =
        StockSheet { name: None, form: SheetForm::Rectangle { size }, count: None, cost: None };
    Stock { sheets: vec![sheet], effort: 0.02, ..Stock::default() }
}

fn laid_out(template_name: &str, change: impl FnOnce(&mut Design)) -> (Made, Vec<Piece>) {
    let mut design = template(template_name).unwrap().defaults().design().unwrap();
    design.stock = Some(stock([800.0, 500.0]));
    change(&mut design);
    let mut made = make(&design, &mut Unwatched).unwrap();
    made.lay_out(&mut Unwatched);
    let pieces = made
        .sheet_pieces(&made.nested.as_ref().map_or_else(Vec::new, |nested| nested.list.clone()));
    assert!(made.nested.as_ref().unwrap().is_proved);
    (made, pieces)
}

fn outlines(piece: &Piece) -> impl Iterator<Item = &[sheetwright::Point2]> {
    let outlines = piece.paths.iter().filter(|path| path.kind == PathKind::Outline);
    outlines.map(|path| &path.points[..])
}

#[test]
fn every_part_lies_once_under_its_own_name_and_mirror_images_are_mirrored() {
    let (made, sheets) = laid_out("hemisphere", |_| {});
    let mut names: Vec<&str> = sheets
        .iter()
        .flat_map(|sheet| &sheet.labels)
        .filter(|label| label.kind == LabelKind::Name && label.role != Role::Note)
        .map(|label| &label.text[..])
        .collect();
    names.sort_unstable();
    let mut wanted: Vec<&str> = made.parts.iter().map(|part| &part.name[..]).collect();
    wanted.sort_unstable();
    assert_eq!(names, wanted);
    assert!(sheets.iter().all(|sheet| {
        sheet.labels.iter().all(|label| label.kind != LabelKind::Quantity)
            && sheet.paths.iter().all(|path| path.kind != PathKind::Dimension)
    }));
    // The outline of a pattern runs counter-clockwise, and that of its mirror image clockwise.
    let turned = sheets.iter().flat_map(outlines).filter(|line| signed_area_doubled(line) < 0.0);
    let mirrored: usize = made.cut_list().iter().map(|item| item.quantity().mirrored).sum();
    assert_eq!(turned.count(), mirrored);
    assert!(mirrored > 0);
    let all = beside_each_other("all", &sheets);
    let count = |piece: &Piece| piece.paths.len();
    assert_eq!(count(&all), sheets.iter().map(count).sum::<usize>());
    assert!(all.size.x >= 800.0);
}

#[test]
fn grain_runs_along_the_sheet() {
    let arrow = |angle: f64| Mark {
        on: vec![MarkOn::All],
        kind: MarkKind::Grain { way: MarkWay::Angle { angle }, length: 40.0 },
    };
    for (turn, is_upright) in [(Turn::Free, false), (Turn::OneWay, true)] {
        let (_, sheets) = laid_out("elbow", |design| {
            design.marks = vec![arrow(from_deg(30.0))];
            let size = if is_upright { [700.0, 1500.0] } else { [1500.0, 700.0] };
            design.stock = Some(Stock { turn, ..stock(size) });
        });
        let along = if is_upright { Vec2::Y } else { Vec2::X };
        let arrows: Vec<f64> = sheets
            .iter()
            .flat_map(|sheet| &sheet.paths)
            .filter(|path| path.kind == PathKind::Grain)
            .map(|path| unit2(path.points[1] - path.points[0]).unwrap().dot(along))
            .collect();
        assert_eq!(arrows.len(), 5);
        for cos in arrows {
            let is_along = if turn == Turn::OneWay { cos } else { cos.abs() };
            assert!(is_along > 1.0 - 1e-9, "{cos}");
        }
    }
}

#[test]
fn texts_on_sheets_are_read_from_below_or_from_the_right() {
    let (made, sheets) = laid_out("hemisphere", |_| {});
    let turns = made.nested.as_ref().unwrap().nest.placements.iter().map(|it| cos(it.turn));
    assert!(turns.filter(|cosine| *cosine < 0.0).count() > 3, "parts lie upside down");
    for label in sheets.iter().flat_map(|sheet| &sheet.labels) {
        let Vec2 { x, y } = label.along;
        assert!(x > 0.0 || (x > -1e-6 && y > 0.0), "{}: {:?}", label.text, label.along);
    }
    // Their boxes stay where they are: each name lies in its part as it did before.
    for sheet in &sheets {
        let names = sheet.labels.iter().filter(|label| label.kind == LabelKind::Name);
        for name in names.filter(|label| label.role != Role::Note) {
            let up = name.along.perp() * (0.5 * name.height_mm);
            assert!(outlines(sheet).any(|line| inside(line, name.at + up)), "{}", name.text);
        }
    }
}

#[test]
fn what_fits_no_sheet_is_left_out_and_no_stock_lays_nothing_out() {
    let (made, sheets) = laid_out("elbow", |design| design.stock = Some(stock([300.0, 200.0])));
    let nested = made.nested.as_ref().unwrap();
    assert_eq!((nested.nest.too_large.len(), sheets.len()), (2, 0));
    let mut design = template("elbow").unwrap().defaults().design().unwrap();
    design.stock = Some(Stock { sheets: Vec::new(), ..Stock::default() });
    let mut made = make(&design, &mut Unwatched).unwrap();
    made.lay_out(&mut Unwatched);
    assert_eq!(made.nested, None);
}

#[test]
fn equal_parts_have_cuts_in_common_where_that_is_asked_for() {
    let cut_mm = |sheets: &[Piece]| -> f64 {
        let cut = sheets.iter().flat_map(|sheet| &sheet.paths).filter(|it| it.role == Role::Cut);
        cut.map(|path| {
            let steps = path.points.windows(2).map(|pair| pair[0].distance(pair[1]));
            let last = path.points[0].distance(*path.points.last().unwrap());
            steps.sum::<f64>() + if path.closed { last } else { 0.0 }
        })
        .sum()
    };
    let [apart, joined] = [false, true].map(|has_common_lines| {
        let (made, sheets) = laid_out("cone", |design| {
            let corners = [[0.0; 3], [200.0, 0.0, 0.0], [200.0, 120.0, 0.0], [0.0, 120.0, 0.0]];
            let rim = DesignCurve::polyline("rim", corners).closed();
            *design = Design::inside("tile", rim, Vec::new());
            design.panels[0].count = 5;
            design.stock = Some(Stock { has_common_lines, ..stock([3000.0, 2000.0]) });
        });
        assert_eq!(made.nested.unwrap().nest.placements.len(), 5);
        cut_mm(&sheets)
    });
    assert!((apart - 3200.0).abs() < 1e-6, "{apart}");
    // Two times two of them share two sides of 200 mm and two of 120 mm.
    assert!((joined - 2560.0).abs() < 0.1, "{joined}");
}

#[test]
fn parts_without_a_sheet_are_found() {
    let (made, sheets) = laid_out("hemisphere", |design| {
        let mut one = stock([400.0, 400.0]);
        one.sheets[0].count = Some(1);
        design.stock = Some(one);
    });
    let laid = &made.nested.as_ref().unwrap().parts;
    assert_eq!(sheets.len(), 1);
    assert!(laid.len() < made.parts.len());
    for (n, part) in made.parts.iter().enumerate() {
        let codes: Vec<&str> = part.checked.findings.iter().map(|it| it.kind.code()).collect();
        let is_without = codes.contains(&"no-sheet") || codes.contains(&"too-large");
        assert_eq!(is_without, !laid.contains(&n), "{}: {codes:?}", part.name);
    }
}
