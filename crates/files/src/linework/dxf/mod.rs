//! Drawings in DXF, of any release, as text. Blocks are drawn where they are inserted, entities on
//! the plane of their extrusion, layers that are off or frozen are hidden.

mod entity;
mod records;
mod spline;

use super::drawn::{Drawing, Drawn, MAX_LAYERS, MAX_NAME};
use super::segment::Affine;
use super::too_large;
use crate::reading::{InputError, display_name};
use crate::units::Units;
use entity::{inserted, pieces};
use records::{Record, records};
use sheetwright::design::{ReadNote, Unused};
use sheetwright::math::{Point3, Vec3};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// How deep blocks may lie in one another.
const MAX_DEPTH: usize = 32;
/// The most entities that are drawn, those of copies of blocks among them.
const MAX_DRAWN: usize = 300_000;
/// As many numbers of an entity count as another entity that is drawn.
const NUMBERS_OF_ONE: usize = 64;
const EXPORT: &str = "Save it again as DXF, as text (ASCII), from the program that it came from.";
const BINARY: &[u8] = b"AutoCAD Binary DXF";

/// Reads what is drawn. With `units`, the coordinates are in that unit.
pub(super) fn read(bytes: &[u8], name: &str, units: Option<Units>) -> Result<Drawing, InputError> {
    let place = display_name(name);
    let binary = bytes.starts_with(BINARY).then_some("this is DXF in its binary form");
    let dwg = bytes.starts_with(b"AC10").then_some("this is DWG, which no free program reads well");
    if let Some(message) = binary.or(dwg) {
        return Err(InputError::at(place, message, EXPORT));
    }
    // Old files have texts in the code pages of their countries, which matter for names alone.
    let text = String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes));
    let all = records(&text, place)?;
    let file = File::of(&all);
    let Some(entities) = file.entities else {
        let message = "the file has no section of entities";
        return Err(InputError::at(place, message, EXPORT));
    };
    let mut drawing = Drawing::default();
    let unit_mm = units.map(Units::in_mm).or(file.unit_mm);
    if unit_mm.is_none() {
        drawing.notes.push(ReadNote::NoUnit { unit_mm: 1.0 });
    }
    let map = Affine::scale(Vec3::splat(unit_mm.unwrap_or(1.0)));
    let mut reader = Reader { place, file: &file, drawing, drawn: 0 };
    reader.all(entities, &Context { map, layers: Rc::default(), depth: 0 })?;
    Ok(reader.drawing)
}

/// The sections of a file.
#[derive(Default)]
struct File<'a> {
    unit_mm: Option<f64>,
    hidden: BTreeSet<String>,
    /// The base points and the entities of blocks.
    blocks: BTreeMap<String, (Point3, &'a [Record<'a>])>,
    entities: Option<&'a [Record<'a>]>,
}

impl<'a> File<'a> {
    fn of(all: &'a [Record<'a>]) -> Self {
        let mut file = Self::default();
        let begins = |record: &Record<'_>| record.kind == "SECTION";
        let mut rest = all;
        while let Some(start) = rest.iter().position(begins) {
            let section = &rest[start..];
            let end = section.iter().position(|record| record.kind == "ENDSEC");
            let (section, after) = section.split_at(end.unwrap_or(section.len()));
            match section[0].text(2) {
                Some("HEADER") => file.unit_mm = unit_of(&section[0]),
                Some("TABLES") => file.hidden = section.iter().filter_map(hidden_layer).collect(),
                Some("BLOCKS") => file.blocks = blocks(section),
                Some("ENTITIES") => file.entities = Some(&section[1..]),
                _ => {}
            }
            rest = after;
        }
        file
    }
}

/// The unit that the header names, mm.
fn unit_of(header: &Record<'_>) -> Option<f64> {
    let mut pairs = header.pairs().skip_while(|pair| *pair != (9, "$INSUNITS")).skip(1);
    let (_, number) = pairs.next().filter(|(code, _)| *code == 70)?;
    Some(match number.parse::<u32>().ok()? {
        1 => 25.4,
        2 => 304.8,
        3 => 1_609_344.0,
        4 => 1.0,
        5 => 10.0,
        6 => 1000.0,
        7 => 1e6,
        8 => 25.4e-6,
        9 => 25.4e-3,
        10 => 914.4,
        12 => 1e-6,
        13 => 1e-3,
        14 => 100.0,
        15 => 1e4,
        16 => 1e5,
        // US survey feet, inches, yards and miles.
        21 => 1_200_000.0 / 3937.0,
        22 => 100_000.0 / 3937.0,
        23 => 3_600_000.0 / 3937.0,
        24 => 5280.0 * 1_200_000.0 / 3937.0,
        _ => return None,
    })
}

/// The name of a layer that is off or frozen.
fn hidden_layer(record: &Record<'_>) -> Option<String> {
    const FROZEN: i64 = 1;
    let is_hidden = record.flags(70) & FROZEN == FROZEN || record.flags(62) < 0;
    (record.kind == "LAYER" && is_hidden).then(|| record.text(2).unwrap_or("").to_lowercase())
}

fn blocks<'a>(section: &'a [Record<'a>]) -> BTreeMap<String, (Point3, &'a [Record<'a>])> {
    let mut blocks = BTreeMap::new();
    let mut rest = section;
    while let Some(start) = rest.iter().position(|record| record.kind == "BLOCK") {
        let block = &rest[start..];
        let end = block.iter().position(|record| record.kind == "ENDBLK").unwrap_or(block.len());
        let name = block[0].text(2).unwrap_or("").to_lowercase();
        blocks.insert(name, (block[0].point(10), &block[1..end]));
        rest = &block[end..];
    }
    blocks
}

struct Reader<'a> {
    place: &'a str,
    file: &'a File<'a>,
    drawing: Drawing,
    drawn: usize,
}

/// Where entities stand: in the file itself, or in a block that is inserted.
#[derive(Clone)]
struct Context {
    map: Affine,
    /// The blocks and layers around them, from the innermost.
    layers: Rc<Vec<String>>,
    depth: usize,
}

impl Reader<'_> {
    fn error(&self, record: &Record<'_>, words: &str) -> InputError {
        let message = format!("the {} can't be read: {words}", record.kind);
        InputError::at(format!("{}:{}", self.place, record.line), message, EXPORT)
    }

    fn all(&mut self, entities: &[Record<'_>], at: &Context) -> Result<(), InputError> {
        let mut rest = entities;
        while let [record, after @ ..] = rest {
            // Vertices follow a polyline, attributes an insertion, up to the end of the sequence.
            let has_more =
                record.kind == "POLYLINE" || (record.kind == "INSERT" && record.flags(66) == 1);
            let is_part = |record: &Record<'_>| matches!(record.kind, "VERTEX" | "ATTRIB");
            let parts =
                if has_more { after.iter().take_while(|it| is_part(it)).count() } else { 0 };
            self.entity(record, &after[..parts], at)?;
            rest = &after[parts..];
        }
        Ok(())
    }

    fn entity(
        &mut self,
        record: &Record<'_>,
        parts: &[Record<'_>],
        at: &Context,
    ) -> Result<(), InputError> {
        // Each copy takes as long as the entity has numbers.
        self.drawn += 1 + (record.pairs().count() + parts.len()) / NUMBERS_OF_ONE;
        if self.drawn > MAX_DRAWN {
            return Err(too_large(self.place));
        }
        let layer = record.layer();
        let unused = &mut self.drawing.unused;
        if record.flags(67) == 1 && at.depth == 0 {
            if record.kind != "VIEWPORT" {
                unused.add(Unused::Page, record.kind, None);
            }
            return Ok(());
        }
        if record.flags(60) == 1 || self.file.hidden.contains(&layer.to_lowercase()) {
            if !matches!(record.kind, "SEQEND" | "VERTEX" | "ATTRIB" | "VIEWPORT") {
                unused.add(Unused::Hidden, layer, None);
            }
            return Ok(());
        }
        if record.kind == "INSERT" {
            return self.insert(record, at);
        }
        match pieces(record, parts).map_err(|words| self.error(record, &words))? {
            Some((segments, closed)) => self.curve(record, segments, closed, at),
            None => {
                self.not_a_curve(record, at);
                Ok(())
            }
        }
    }

    fn curve(
        &mut self,
        record: &Record<'_>,
        segments: Vec<super::segment::Segment>,
        closed: bool,
        at: &Context,
    ) -> Result<(), InputError> {
        let segments: Vec<_> = segments.iter().map(|segment| segment.mapped(&at.map)).collect();
        let ends = segments.iter().flat_map(|segment| [segment.start(), segment.end()]);
        if !ends.into_iter().all(Point3::is_finite) {
            return Err(self.error(record, "a coordinate is no finite number"));
        }
        let layers = at.layers_with(record.layer(), None);
        match self.drawing.add(Drawn { names: Vec::new(), layers, segments, closed }) {
            true => Ok(()),
            false => Err(too_large(self.place)),
        }
    }

    fn insert(&mut self, record: &Record<'_>, at: &Context) -> Result<(), InputError> {
        let name = record.text(2).unwrap_or("");
        let Some(&(base, entities)) = self.file.blocks.get(&name.to_lowercase()) else {
            self.drawing.unused.add(Unused::Other, &format!("block {name}"), None);
            return Ok(());
        };
        if at.depth == MAX_DEPTH {
            return Err(self.error(record, "it lies in more than 32 blocks"));
        }
        let layers = at.layers_with(record.layer(), Some(name));
        let [columns, rows] = [70, 71].map(|code| record.flags(code).max(1));
        for row in 0..rows {
            for column in 0..columns {
                self.drawn += 1;
                if self.drawn > MAX_DRAWN {
                    return Err(too_large(self.place));
                }
                let inner = inserted(record, base, column as f64, row as f64);
                let map = at.map.after(&inner);
                if !map.is_finite() {
                    return Err(self.error(record, "a coordinate is no finite number"));
                }
                self.all(entities, &Context { map, layers: layers.clone(), depth: at.depth + 1 })?;
            }
        }
        Ok(())
    }

    fn not_a_curve(&mut self, record: &Record<'_>, at: &Context) {
        let what = match record.kind {
            "TEXT" | "MTEXT" | "ATTDEF" | "RTEXT" => Unused::Text,
            "HATCH" | "MPOLYGON" => Unused::Hatch,
            "DIMENSION" | "ARC_DIMENSION" | "LEADER" | "MULTILEADER" | "MLEADER" | "TOLERANCE" => {
                Unused::Dimension
            }
            "IMAGE" | "OLEFRAME" | "OLE2FRAME" | "WIPEOUT" => Unused::Image,
            "POINT" => Unused::Point,
            "3DFACE" | "SOLID" | "TRACE" | "MESH" | "3DSOLID" | "BODY" | "REGION" | "SURFACE"
            | "POLYLINE" | "EXTRUDEDSURFACE" | "LOFTEDSURFACE" | "REVOLVEDSURFACE"
            | "SWEPTSURFACE" | "PLANESURFACE" => Unused::Surface,
            "SEQEND" | "VERTEX" | "ATTRIB" | "VIEWPORT" => return,
            _ => Unused::Other,
        };
        let name = if what == Unused::Other { record.kind } else { "" };
        let place = record.number(10).map(|_| at.map.place(record.point(10)));
        self.drawing.unused.add(what, name, place.filter(|p| p.is_finite()));
    }
}

impl Context {
    /// The layers of what lies on one here, or in a block that is inserted on it. What lies on
    /// layer 0 of a block is on the layer of the insertion.
    fn layers_with(&self, layer: &str, block: Option<&str>) -> Rc<Vec<String>> {
        let own = (layer != "0" || self.depth == 0).then_some(layer);
        let inner = block.into_iter().chain(own).map(|name| name.chars().take(MAX_NAME).collect());
        Rc::new(inner.chain(self.layers.iter().cloned()).take(MAX_LAYERS).collect())
    }
}
