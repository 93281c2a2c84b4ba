//! What is filled in a picture of space, as SVG: triangles and cells in the classes of their
//! shades.

use super::canvas::{PathData, number};
use crate::space::{CellRow, Fill, Shade};
use std::fmt::Write as _;

/// The elements of what is filled.
pub(super) fn fill_elements(fills: &[Fill]) -> String {
    fills.iter().map(fill_element).collect()
}

fn fill_element(fill: &Fill) -> String {
    match fill {
        Fill::Triangles { shade, triangles } => {
            let mut path = PathData::default();
            triangles.iter().for_each(|corners| path.ring(*corners));
            path.element(&shade_name(*shade))
        }
        Fill::Cells { shade, rows } => cells_element(&shade_name(*shade), rows),
    }
}

/// Rows of cells of a class as one element.
pub(super) fn cells_element(class: &str, rows: &[CellRow]) -> String {
    let mut path = String::new();
    for CellRow { corner, size } in rows {
        let (left, top) = (number(corner.x), number(corner.y));
        let (wide, high) = (number(size.x), number(size.y));
        // Writing to a string does not fail.
        let _ = write!(path, "M{left} {top}h{wide}v{high}h-{wide}z");
    }
    format!(r#"<path class="{class} cells" d="{path}"/>"#)
}

/// The class of a shade.
fn shade_name(shade: u16) -> String {
    match Shade::of(shade) {
        Shade::Heat(step) => format!("k{step}"),
        Shade::Back(level) => format!("b{level}"),
        Shade::Front(level) | Shade::Faint(level) => format!("f{level}"),
    }
}
