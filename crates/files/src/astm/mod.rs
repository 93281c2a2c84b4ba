//! Patterns as ASTM D6673, the DXF that cutters of cloth and leather read.
//!
//! It is a DXF of release 12 with a block for each piece and nothing that a reader of 1992 does not
//! know: an empty header, no tables, text in seven bits. Layers are numbers with a fixed meaning.
//! What no layer is for, such as rungs and dimensions, is left out.

use crate::dxf::{Pairs, ascii, real};
use crate::obj::one_word;
use crate::offsets::crossings;
use crate::shapes::FileLine;
use sheetwright::make::{CutItem, Made};
use sheetwright::math::{Point2, atan2, to_deg, unit2};
use sheetwright::pattern::{LabelKind, PathKind, PatternLabel, PatternPath, Piece, Quantity, Role};
use std::collections::BTreeSet;

/// The layers of the standard, by what is on them.
const BOUNDARY: &str = "1";
const TURN: &str = "2";
const CURVE: &str = "3";
const NOTCH: &str = "4";
const MIRROR: &str = "6";
const GRAIN: &str = "7";
const INTERNAL: &str = "8";
const CUT_OUT: &str = "11";
const DRILL: &str = "13";
const SEW: &str = "14";
const ANNOTATION: &str = "15";

/// A corner turns by more than this, as the cosine of 15°; other points are those of curves.
const CORNER_COS: f64 = 0.965_925_826_289_068_3;
/// The height of system texts, mm.
const TEXT_MM: f64 = 5.0;
/// The most characters of the name of a block in release 12.
const BLOCK_NAME: usize = 31;
/// The arrow of the grain is as long as this share of the sheet along its line.
const GRAIN_SHARE: f64 = 0.6;

/// The ASTM file of the patterns of a made design. `docs/outputs.md` specifies it for readers.
pub fn write_astm(made: &Made, patterns: &[CutItem]) -> Vec<u8> {
    let material = made.material.as_ref().map(|material| material.name.as_str());
    let pieces: Vec<(&Piece, Quantity)> =
        patterns.iter().map(|item| (&item.piece, item.quantity())).collect();
    written(&made.name, material, &pieces)
}

fn written(style: &str, material: Option<&str>, pieces: &[(&Piece, Quantity)]) -> Vec<u8> {
    let mut taken = BTreeSet::new();
    let blocks: Vec<String> =
        pieces.iter().map(|(piece, _)| block_name(&piece.name, &mut taken)).collect();
    let mut pairs = Pairs::default();
    pairs.section("HEADER", |_| {});
    pairs.section("BLOCKS", |pairs| {
        for (&(piece, quantity), name) in pieces.iter().zip(&blocks) {
            block(pairs, piece, quantity, name, material);
        }
    });
    pairs.section("ENTITIES", |pairs| {
        for name in &blocks {
            pairs.put(0, "INSERT");
            pairs.put(8, BOUNDARY);
            pairs.put(2, name);
            pairs.place(Point2::default());
        }
        let below = |n: usize| Point2::new(0.0, -2.0 * TEXT_MM * (n + 1) as f64);
        let texts = [
            format!("Style Name: {style}"),
            "Author: Sheetwright".to_owned(),
            "Sample Size: 1".to_owned(),
            "Units: METRIC".to_owned(),
            "ASTM/D13Proposal 1 Version: D 6673-04".to_owned(),
        ];
        for (n, said) in texts.iter().enumerate() {
            text(pairs, BOUNDARY, below(n), TEXT_MM, 0.0, said);
        }
    });
    pairs.into_bytes()
}

/// The name of a block: letters, digits and `_` alone, no two of which are one.
fn block_name(name: &str, taken: &mut BTreeSet<String>) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
    // A number of up to five digits may follow.
    let name: String = name.chars().map(plain).take(BLOCK_NAME - 6).collect();
    one_word(&name, taken)
}

fn block(pairs: &mut Pairs, piece: &Piece, quantity: Quantity, name: &str, material: Option<&str>) {
    pairs.put(0, "BLOCK");
    pairs.put(8, BOUNDARY);
    pairs.put(2, name);
    pairs.put(70, 0);
    pairs.place(Point2::default());
    let middle = piece.labels.iter().find(|label| label.kind == LabelKind::Name);
    let middle = middle.map_or(Point2::default(), |label| label.at);
    let texts = [
        Some(format!("Piece Name: {}", piece.name)),
        Some("Size: 1".to_owned()),
        Some(format!("Quantity: {}", quantity.count)),
        material.map(|material| format!("Fabric: {material}")),
    ];
    for (n, said) in texts.iter().flatten().enumerate() {
        let at = Point2::new(middle.x, middle.y - 1.5 * TEXT_MM * (n + 1) as f64);
        text(pairs, BOUNDARY, at, TEXT_MM, 0.0, said);
    }
    for path in &piece.paths {
        of_path(pairs, path);
    }
    // The grain that is marked, or that along the pattern.
    if piece.paths.iter().all(|path| path.kind != PathKind::Grain)
        && let Some(ends) = grain(piece, middle)
    {
        grain_line(pairs, ends);
    }
    for label in piece.labels.iter().filter(|label| label.role != Role::Note) {
        annotation(pairs, label);
    }
    pairs.put(0, "ENDBLK");
    pairs.put(8, BOUNDARY);
}

fn of_path(pairs: &mut Pairs, path: &PatternPath) {
    let line = |pairs: &mut Pairs, layer: &str| {
        pairs.line(layer, None, &FileLine::polyline(path.points.clone(), path.closed));
    };
    match (path.kind, path.role) {
        (PathKind::Outline, _) => {
            line(pairs, BOUNDARY);
            let m = path.points.len();
            for n in 0..m {
                let [before, at, after] = [n + m - 1, n, n + 1].map(|n| path.points[n % m]);
                let turn = unit2(at - before).zip(unit2(after - at)).map(|(a, b)| a.dot(b));
                let is_curve = turn.is_some_and(|cos| cos >= CORNER_COS);
                point(pairs, if is_curve { CURVE } else { TURN }, at);
            }
        }
        (PathKind::Hole, _) => line(pairs, CUT_OUT),
        (PathKind::Net, _) => line(pairs, SEW),
        (PathKind::Drill { .. }, _) => {
            let sum = path.points.iter().map(|p| p.to_vec()).sum::<sheetwright::math::Vec2>();
            point(pairs, DRILL, Point2::default() + sum * (1.0 / path.points.len() as f64));
        }
        (PathKind::Notch, _) => notch(pairs, &path.points),
        (PathKind::OnFold, _) => line(pairs, MIRROR),
        (PathKind::Grain, _) => {
            if let [tail, tip, ..] = path.points[..] {
                grain_line(pairs, [tail, tip]);
            }
        }
        (_, Role::Note) => {}
        _ => line(pairs, INTERNAL),
    }
}

fn grain_line(pairs: &mut Pairs, [from, to]: [Point2; 2]) {
    pairs.put(0, "LINE");
    pairs.put(8, GRAIN);
    pairs.place(from);
    for (code, value) in [(11, to.x), (21, to.y), (31, 0.0)] {
        pairs.put(code, real(value));
    }
}

fn point(pairs: &mut Pairs, layer: &str, at: Point2) {
    pairs.put(0, "POINT");
    pairs.put(8, layer);
    pairs.place(at);
}

/// A notch is a point on the boundary, with its depth (39) and the direction inwards (50).
fn notch(pairs: &mut Pairs, points: &[Point2]) {
    let (Some(&on_edge), Some(&inner)) = (points.first(), points.get(1)) else { return };
    let way = inner - on_edge;
    point(pairs, NOTCH, on_edge);
    pairs.put(39, real(way.length()));
    pairs.put(50, real(to_deg(atan2(way.y, way.x))));
}

/// The line of the grain: along x through a place, in the middle of the sheet there.
fn grain(piece: &Piece, at: Point2) -> Option<[Point2; 2]> {
    let turned: Vec<Vec<Point2>> = piece
        .net_loops()
        .map(|line| line.iter().map(|p| Point2::new(p.y, p.x)).collect())
        .collect();
    let turned: Vec<&[Point2]> = turned.iter().map(|line| &line[..]).collect();
    let along = crossings(&turned, at.y);
    let stretches = along.chunks_exact(2).map(|pair| [pair[0], pair[1]]);
    let longest = stretches.reduce(|a, b| if b[1] - b[0] > a[1] - a[0] { b } else { a });
    longest.map(|[from, to]| {
        let (middle, half) = (0.5 * (from + to), 0.5 * GRAIN_SHARE * (to - from));
        [Point2::new(middle - half, at.y), Point2::new(middle + half, at.y)]
    })
}

fn annotation(pairs: &mut Pairs, label: &PatternLabel) {
    let angle = to_deg(atan2(label.along.y, label.along.x));
    text(pairs, ANNOTATION, label.at, label.height_mm, angle, &label.text);
}

fn text(pairs: &mut Pairs, layer: &str, at: Point2, height_mm: f64, angle_deg: f64, said: &str) {
    pairs.put(0, "TEXT");
    pairs.put(8, layer);
    pairs.place(at);
    pairs.put(40, real(height_mm));
    pairs.put(1, ascii(said));
    if angle_deg != 0.0 {
        pairs.put(50, real(angle_deg));
    }
}

#[cfg(test)]
mod tests;
