//! Drawings typed by hand, each with what it must come out as.

mod dxf;
mod obj;
mod roles;
mod svg;

use super::{DrawingFormat, read};
use crate::reading::{InputError, ReadOptions};
use sheetwright::curve::{Curve, CurveKind};
use sheetwright::design::{Design, DesignCurve, DesignPanel, PanelShape, ReadNote, Unused};

fn options() -> ReadOptions {
    ReadOptions::default()
}

fn try_svg(text: &str) -> Result<Design, InputError> {
    read(DrawingFormat::Svg, text.as_bytes(), "a.svg", &options())
}

fn try_dxf(text: &str) -> Result<Design, InputError> {
    read(DrawingFormat::Dxf, text.as_bytes(), "a.dxf", &options())
}

/// A drawing of a metre by a metre in millimetres.
fn page(inside: &str) -> String {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:inkscape='http://www.inkscape.org/' \
         xmlns:xlink='http://www.w3.org/1999/xlink' width='1000mm' height='1000mm' \
         viewBox='0 0 1000 1000'>{inside}</svg>"
    )
}

fn svg(inside: &str) -> Design {
    try_svg(&page(inside)).unwrap()
}

/// A file of these pairs, `code value` a line, as entities, in millimetres.
fn dxf_text(entities: &str) -> String {
    file("70 4", "", entities)
}

/// A file with this unit, these blocks and these entities.
fn file(unit: &str, blocks: &str, entities: &str) -> String {
    let all = format!(
        "0 SECTION/2 HEADER/9 $INSUNITS/{unit}/0 ENDSEC/0 SECTION/2 TABLES/0 LAYER/2 off/70 0/62 \
         -7/0 LAYER/2 on/70 0/62 7/0 ENDSEC/0 SECTION/2 BLOCKS/{blocks}/0 ENDSEC/0 SECTION/2 \
         ENTITIES/{entities}/0 ENDSEC/0 EOF"
    );
    let pairs = all.split('/').map(str::trim).filter(|pair| !pair.is_empty());
    let lines = pairs.map(|pair| {
        let (code, value) = pair.split_once(' ').unwrap_or((pair, ""));
        format!("{code:>3}\r\n{}\r\n", value.trim())
    });
    lines.collect()
}

fn dxf(entities: &str) -> Design {
    try_dxf(&dxf_text(entities)).unwrap()
}

fn built(curve: &DesignCurve) -> Curve {
    Curve::new(curve.kind.unwrap(), &curve.points, curve.closed).unwrap()
}

fn lengths(design: &Design) -> Vec<f64> {
    design.curves.iter().map(|curve| built(curve).length()).collect()
}

/// Asserts the lengths of the curves of a design, mm, within two millionths.
fn has_lengths(design: &Design, expected: &[f64], what: &str) {
    let found = lengths(design);
    let is_close = |(a, b): (&f64, &f64)| (a - b).abs() <= 2e-6 * b.abs();
    let all = found.len() == expected.len() && found.iter().zip(expected).all(is_close);
    assert!(all, "{what}: {found:?}, not {expected:?}");
}

fn names(design: &Design) -> Vec<&str> {
    design.curves.iter().map(|curve| curve.name.as_str()).collect()
}

/// A panel by its outer curve and its holes, or by its rails.
fn shape(panel: &DesignPanel) -> Vec<&str> {
    match &panel.shape {
        PanelShape::Loops { outer, holes } => {
            outer.iter().chain(holes.iter().flatten()).map(|part| part.name.as_str()).collect()
        }
        PanelShape::Rails(rails) => rails.iter().map(|rail| rail.name.as_str()).collect(),
        _ => Vec::new(),
    }
}

/// Each panel so.
fn shapes(design: &Design) -> Vec<Vec<&str>> {
    design.panels.iter().map(shape).collect()
}

/// How many things of each kind were not used.
fn unused(design: &Design) -> Vec<(Unused, usize)> {
    let of = |note: &ReadNote| match note {
        ReadNote::NotUsed { what, count, .. } => Some((*what, *count)),
        _ => None,
    };
    design.notes.iter().filter_map(of).collect()
}
