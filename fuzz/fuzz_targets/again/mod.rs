//! Properties of every pattern that is read, and of that pattern written once more.

use sheetwright::math::Point2;
use sheetwright::pattern::{PathKind, PatternPath, Piece, Role};
use sheetwright::predicate::signed_area_doubled;
use sheetwright_files::{PatternReadError, ReadPattern};

/// Patterns up to this size, mm, and down to its inverse, are written again: what the kernel makes.
const SIZE_MM: f64 = 1e9;

/// Checks a pattern that was read; `again` writes and reads it. Corners may move by `near`, as a
/// share of the size of the file.
pub fn check(
    read: &ReadPattern,
    again: impl Fn(&Piece) -> Result<ReadPattern, PatternReadError>,
    near: f64,
) {
    let points = read.points();
    let corners = points.len();
    assert!(!read.outline.is_empty() && read.rungs.is_sorted());
    let ends = || read.rungs.iter().flat_map(|rung| rung.ends().map(|end| end.get()));
    assert!(ends().all(|end| end < corners));
    let (width, height) = read.outline.iter().fold((0.0_f64, 0.0_f64), |(width, height), at| {
        assert!(at.x >= 0.0 && at.y >= 0.0);
        (width.max(at.x), height.max(at.y))
    });
    let size = width.max(height);
    if !(1.0 / SIZE_MM..=SIZE_MM).contains(&size) {
        return;
    }
    // Rounding may reverse a line with hardly any area, and then it is no hole.
    let area = |line: &Vec<Point2>| signed_area_doubled(line).abs();
    let tiny = |line: &Vec<Point2>| area(line) <= 1e-6 * size * size;
    let equal = |line: &Vec<Point2>| area(line) >= area(&read.outline) * (1.0 - 1e-6);
    if read.holes.iter().any(|hole| size <= PAGE_MM || tiny(hole) || equal(hole)) {
        return;
    }
    let twice = again(&piece(read)).expect("what was written reads");
    let far = |(a, b): (&Point2, &Point2)| a.distance(*b) > near * (size + PAGE_MM);
    assert_eq!(twice.outline.len(), read.outline.len());
    assert_eq!(twice.points().len(), corners);
    assert!(!points.iter().zip(&twice.points()).any(far));
    // Corners that lie on one another may lend each other their rungs.
    let apart = 1e-9 * size;
    let alone = |end: usize| {
        let at = points[end];
        points.iter().filter(|other| other.distance(at) <= apart).count() == 1
    };
    if size > PAGE_MM && ends().all(alone) {
        assert_eq!(read.rungs, twice.rungs);
    }
}

/// Pages begin so far from the pattern at the most, mm, which is what small ones are rounded to.
const PAGE_MM: f64 = 100.0;

fn piece(read: &ReadPattern) -> Piece {
    let points = read.points();
    let path = |role, kind, points: Vec<Point2>, closed| PatternPath { role, kind, points, closed };
    let rungs = read.rungs.iter().map(|&rung| {
        let ends = rung.ends().map(|end| points[end.get()]);
        path(Role::Note, PathKind::Rung(rung), ends.to_vec(), false)
    });
    let outline = path(Role::Cut, PathKind::Outline, read.outline.clone(), true);
    let hole = |hole: &Vec<Point2>| path(Role::Inner, PathKind::Hole, hole.clone(), true);
    let paths = std::iter::once(outline).chain(read.holes.iter().map(hole)).chain(rungs).collect();
    Piece {
        is_folded: false,
        name: "again".to_owned(),
        paths,
        labels: Vec::new(),
        size: Default::default(),
        corner: Default::default(),
        bends: Vec::new(),
        border: Vec::new(),
    }
}
