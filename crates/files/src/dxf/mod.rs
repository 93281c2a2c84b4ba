//! Patterns as DXF of release 12 or 2000, and back.
//!
//! Every shop reads release 12: polylines on layers, without handles, dates or styles. Release 2000
//! says its unit and is smaller. Both are small enough for this module to write and read them: the
//! crate for all of DXF adds dates to the header and 50 crates to the program, and panics on a date
//! out of range. The tests read the written files with that crate.

mod entity;
mod pairs;
mod r12;
mod r2000;
mod read;

pub(crate) use pairs::{Pairs, ascii, real};

use crate::arcs::{Arcs, chords};
use crate::preset::{DxfRelease, Preset};
use crate::read_back::{Lines, MAX_BYTES, PatternReadError, ReadLine, ReadPattern, pattern};
use crate::shapes::{FileLine, Shape, extent, shapes};
use entity::{Entity, LineType, Tables};
use sheetwright::pattern::Piece;

/// The DXF file of a piece, of release 12. `docs/outputs.md` specifies it for readers.
pub fn write_dxf(piece: &Piece) -> Vec<u8> {
    write_dxf_for(piece, Preset::generic(), DxfRelease::R12)
}

/// The DXF file of a piece as a preset has it.
pub fn write_dxf_for(piece: &Piece, preset: &Preset, release: DxfRelease) -> Vec<u8> {
    write_dxf_with(piece, preset, release, None)
}

/// As [`write_dxf_for`], with arcs in place of the sides of cut lines that lie within this distance
/// of them, mm.
pub fn write_dxf_with(
    piece: &Piece,
    preset: &Preset,
    release: DxfRelease,
    arcs_mm: Option<f64>,
) -> Vec<u8> {
    let shapes = shapes(piece);
    let layers = preset.layers(&shapes);
    let around = extent(shapes.iter().filter(|shape| preset.shows(shape.role)));
    let arcs = arcs_mm.map(|mm| Arcs::of(&shapes, mm));
    let fitted = |shape: &Shape, line: FileLine| match &arcs {
        Some(arcs) => arcs.fitted(shape, line),
        None => line,
    };
    let lines = preset.lines(&shapes).map(|(layer, shape, line)| Entity {
        layer: layer.name,
        line_type: LineType::of(&shape.what),
        line: fitted(shape, line),
    });
    let entities: Vec<Entity> = lines.collect();
    let is_there = |kind: &&LineType| entities.iter().any(|of| of.line_type == Some(*kind));
    let types: Vec<&LineType> = LineType::ALL.into_iter().filter(is_there).collect();
    let tables = Tables { layers: &layers, types: &types };
    match release {
        DxfRelease::R12 => r12::written(&piece.name, tables, around, &entities),
        DxfRelease::R2000 => r2000::written(&piece.name, tables, around, &entities),
    }
}

/// Reads back the outline, the holes and the rungs of a pattern that [`write_dxf`] wrote, or
/// [`write_dxf_for`] for the generic preset: the closed polylines on `net`, or on `cut` where there
/// is no net, and the segments on the other layers between their corners. Arcs become chords that
/// rise by no more than a thousandth of a millimetre.
///
/// # Errors
/// See [`PatternReadError`]. Other releases than 12 and 2000, and other entities than polylines and
/// circles are refused.
pub fn read_dxf(bytes: &[u8]) -> Result<ReadPattern, PatternReadError> {
    let mut lines = dxf_lines(bytes, Preset::generic())?;
    let mut count = 0;
    for ReadLine { line, .. } in &mut lines {
        line.points = chords(&line.points, &std::mem::take(&mut line.bulges));
        count += line.points.len();
        if count > MOST_POINTS {
            return Err(PatternReadError::TooLarge);
        }
    }
    pattern(Lines::of_layers(lines))
}

/// The most corners of a pattern whose arcs are made chords.
const MOST_POINTS: usize = 10_000_000;

/// The lines of a pattern that [`write_dxf_for`] wrote, in the order of the file.
pub(crate) fn dxf_lines(bytes: &[u8], preset: &Preset) -> Result<Vec<ReadLine>, PatternReadError> {
    if bytes.len() > MAX_BYTES {
        return Err(PatternReadError::TooLarge);
    }
    let text = std::str::from_utf8(bytes).map_err(|_| PatternReadError::NotText)?;
    let layer = |name: &str| preset.all_layers().iter().find(|layer| layer.name == name);
    let lines = read::lines(text)?.into_iter().map(|(name, line)| match layer(name) {
        Some(layer) => Ok(ReadLine { layer, line }),
        None => Err(PatternReadError::Unexpected(format!("layer '{name}'"))),
    });
    lines.collect()
}
