//! Drawings of other programs as designs: SVG, DXF, and OBJ files with lines in place of faces.
//!
//! A reader (`svg`, `dxf`, `obj`) turns what is drawn into curves with names and layers, in
//! millimetres (`drawn`); each is a list of pieces that affine maps do not change in kind
//! (`segment`). Curves that meet end to end are chained (`chain`), those that bound panels are
//! chosen by their names or by how they lie (`panels`, `roles`, `nest`) and gathered (`maker`), and
//! each becomes a curve of the design: a polyline, or a spline as near to it as a millionth of its
//! size (`fit`).

mod chain;
mod drawn;
mod dxf;
mod fit;
mod maker;
mod nest;
mod obj;
mod panels;
mod roles;
mod segment;
mod svg;

pub(crate) use obj::is_lines;
pub(crate) use roles::says_rail;

use crate::mesh::MeshFormat;
use crate::reading::{InputError, ReadOptions, display_name, named_after};
use maker::Found;
use panels::panels;
use sheetwright::design::{Design, ReadNote, Unused};

/// A format of drawings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawingFormat {
    /// `*.svg`.
    Svg,
    /// `*.dxf`, as text.
    Dxf,
    /// Wavefront OBJ with lines (`l`).
    Obj,
}

/// The hint for a drawing with too many pieces.
const TOO_LARGE: &str = "Simplify the drawing, or divide it; a few hundred pieces are enough for an \
                         outline.";

fn too_large(place: &str) -> InputError {
    let message = format!("the drawing has more than {} pieces of curves", drawn::MAX_SEGMENTS);
    InputError::at(place, message, TOO_LARGE)
}

/// The format of a drawing, by its beginning in small letters.
pub(crate) fn format_of(beginning: &str) -> Option<DrawingFormat> {
    let text = beginning.trim_start();
    let is_xml = text.starts_with("<?xml") || text.starts_with("<!");
    if text.starts_with("<svg") || (is_xml && text.contains("<svg")) {
        return Some(DrawingFormat::Svg);
    }
    // Comments (999) may come first.
    let mut lines = text.lines().map(str::trim);
    loop {
        match (lines.next()?, lines.next()?) {
            ("0", "section") => return Some(DrawingFormat::Dxf),
            ("999", _) => {}
            _ => return None,
        }
    }
}

/// Why a drawing with this ending can't be read, and a way round.
pub(crate) fn way_round(ending: &str) -> Option<(&'static str, &'static str)> {
    const CURVES: &str = "Export the curves from the program that it came from as DXF (a spline stays \
                          one), as SVG or as OBJ with lines.";
    const DRAWING: &str = "Export the drawing as DXF or SVG.";
    Some(match ending {
        "step" | "stp" => ("STEP files are written, not read", CURVES),
        "iges" | "igs" => ("IGES files are not read", CURVES),
        "3dm" => ("Rhino files are not read", CURVES),
        "dwg" => ("DWG files are not read", DRAWING),
        "ai" | "eps" | "cdr" | "pdf" => ("drawings of this kind are not read", DRAWING),
        "svgz" => ("compressed drawings are not read", "Unpack it, or save it as plain SVG."),
        _ => return None,
    })
}

/// What is to be said of the lines in a file of a mesh that are not used, or in part alone, if so
/// many are seams all the way.
pub(crate) fn lines_beside(format: MeshFormat, bytes: &[u8], seams: usize) -> Vec<ReadNote> {
    let count = if format == MeshFormat::Obj { obj::lines_beside(bytes) } else { 0 };
    let count = count.saturating_sub(seams);
    let (what, names, at) = (Unused::Lines, Vec::new(), None);
    let note = ReadNote::NotUsed { what, count, names, at };
    if count > 0 { vec![note] } else { Vec::new() }
}

/// The design in a drawing: its panels, with the notes on what was not used. `name` is the name of
/// the file, or `-`.
///
/// # Errors
/// Bytes that are no drawing of this format, or one that bounds no panel.
pub(crate) fn read(
    format: DrawingFormat,
    bytes: &[u8],
    name: &str,
    options: &ReadOptions,
) -> Result<Design, InputError> {
    let place = display_name(name);
    let drawing = match format {
        DrawingFormat::Svg => svg::read(bytes, name, options.units)?,
        DrawingFormat::Dxf => dxf::read(bytes, name, options.units)?,
        DrawingFormat::Obj => obj::read(bytes, name, options.units)?,
    };
    let called = named_after(name)?;
    let Found { curves, mut panels, notes } = panels(drawing, place, &called, &options.rails)?;
    for panel in &mut panels {
        options.set_panel(panel);
    }
    let vary = options.vary.applied(Vec::new());
    Ok(Design { name: called, curves, panels, vary, notes, ..Design::default() })
}

#[cfg(test)]
mod tests;
