//! The first page of the book, and the last.

use super::flow::Flow;
use super::scene::{Extras, Frame, Stage};
use super::{Book, counted};
use crate::pdf::{Type, shortened, wrapped};
use crate::wording::millimetres;
use sheetwright::boundary::size_of;
use sheetwright::make::Made;
use sheetwright::math::{Point2, Point3, Vec2, Vec3};

/// Name, view, and what there is to know at once.
pub(super) fn title_page(flow: &mut Flow, book: &Book<'_>) {
    const NAME_PT: f64 = 26.0;
    let (size, left, width) = (flow.size(), flow.left(), flow.width());
    let made = book.made;
    let mut y = size.y - 38.0;
    let lines = wrapped(book.title(), NAME_PT, width / 1.1);
    for line in lines.iter().take(3) {
        let line = shortened(line, NAME_PT, width / 1.1);
        flow.page().text(Point2::new(left, y), &line, Type::new(NAME_PT).bold());
        y -= 11.0;
    }
    flow.page().text(Point2::new(left, y), "How to build it", Type::new(13.0));
    let below = 62.0;
    let frame = Frame {
        corner: Point2::new(left, below),
        size: Vec2::new(width, (y - 10.0 - below).max(60.0)),
    };
    let stage = Stage::new(&made.parts, frame.size);
    let all: Vec<usize> = (0..made.parts.len()).collect();
    stage.draw(flow.page(), frame, &all, &[], &Extras::default());
    for (n, (name, value)) in facts(book).into_iter().enumerate() {
        let y = below - 8.0 - 7.0 * n as f64;
        flow.page().text(Point2::new(left, y), name, Type::new(10.0).bold());
        let value = shortened(&value, 10.0, width - 32.0);
        flow.page().text(Point2::new(left + 32.0, y), &value, Type::new(10.0));
    }
}

fn facts(book: &Book<'_>) -> Vec<(&'static str, String)> {
    let made = book.made;
    let parts = counted(book.count(), "part", "parts");
    let patterns = counted(book.patterns.len(), "pattern", "patterns");
    let size = overall_size(made);
    let size = [size.x, size.y, size.z].map(millimetres).join(" × ");
    let mut facts = vec![
        ("Parts", format!("{parts} from {patterns}")),
        ("Size", format!("{size} along x, y and z")),
        ("Material", material(made)),
    ];
    if let Some(moved) = &made.moved {
        let count = moved.curves.len();
        facts.push(("Moved", format!("its curves were moved ({count} in the design)")));
    }
    facts
}

/// The material and its thickness, in words.
pub(super) fn material(made: &Made) -> String {
    let thickness = made.thickness_mm.map(millimetres);
    match (&made.material, thickness) {
        (Some(material), _) => material.title.clone(),
        (None, Some(thickness)) => format!("any sheet of {thickness}"),
        (None, None) => "any sheet".to_owned(),
    }
}

/// Length, width and height of the box around all parts along the axes, mm.
fn overall_size(made: &Made) -> Vec3 {
    let points = || made.parts.iter().flat_map(|part| part.sheet.mesh().positions());
    let along =
        |axis: Vec3| size_of(points().map(|p| Point3::from_vec(axis * p.to_vec().dot(axis))));
    Vec3::new(along(Vec3::X), along(Vec3::Y), along(Vec3::Z))
}

/// A page of lines to write on.
pub(super) fn notes(flow: &mut Flow) {
    const APART_MM: f64 = 9.0;
    flow.section("Notes");
    while flow.room() > APART_MM {
        let top = flow.take(APART_MM);
        flow.rule(top - APART_MM);
    }
}
