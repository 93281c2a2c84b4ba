//! DXF of release 2000: lightweight polylines, the unit in the header, and the tables, blocks and
//! dictionaries without which AutoCAD refuses a file of any release after 12.

use super::entity::{Entity, Tables};
use super::pairs::{Pairs, ascii, real};
use crate::shapes::Form;
use sheetwright::predicate::Box2;

/// The handles that other records refer to.
const MODEL_SPACE: &str = "10";
const PAPER_SPACE: &str = "11";
const ROOT: &str = "C";
const GROUPS: &str = "D";
const STYLE: &str = "20";
/// The first handle of layers and entities.
const FIRST_FREE: u64 = 0x100;

/// The text so far, and the next free handle.
struct Handled {
    pairs: Pairs,
    next: u64,
}

impl Handled {
    fn handle(&mut self) -> String {
        self.next += 1;
        format!("{:X}", self.next - 1)
    }

    /// The beginning of a table: its name, its handle and how many records it has.
    fn table(&mut self, name: &str, handle: &str, count: usize, fill: impl FnOnce(&mut Self)) {
        let pairs = &mut self.pairs;
        pairs.put(0, "TABLE");
        pairs.put(2, name);
        pairs.put(5, handle);
        pairs.put(330, 0);
        pairs.put(100, "AcDbSymbolTable");
        pairs.put(70, count);
        if name == "DIMSTYLE" {
            pairs.put(100, "AcDbDimStyleTable");
        }
        fill(self);
        self.pairs.put(0, "ENDTAB");
    }

    /// The beginning of a record of a table.
    fn record(&mut self, kind: &str, handle: &str, table: &str, class: &str, name: &str) {
        let pairs = &mut self.pairs;
        pairs.put(0, kind);
        pairs.put(5, handle);
        pairs.put(330, table);
        pairs.put(100, "AcDbSymbolTableRecord");
        pairs.put(100, class);
        pairs.put(2, name);
    }
}

/// The file of a piece of this name: lines on layers, within a box.
pub(super) fn written(
    name: &str,
    declared: Tables<'_>,
    around: Box2,
    entities: &[Entity],
) -> Vec<u8> {
    let mut body = Handled { pairs: Pairs::default(), next: FIRST_FREE };
    tables(&mut body, declared);
    blocks(&mut body.pairs);
    section(&mut body, "ENTITIES", |body| entities.iter().for_each(|of| entity(body, of)));
    section(&mut body, "OBJECTS", |body| dictionaries(&mut body.pairs));
    let seed = format!("{:X}", body.next);

    let mut pairs = Pairs::default();
    pairs.put(999, format_args!("Flat pattern of {}, by Sheetwright. Units: mm.", ascii(name)));
    pairs.section("HEADER", |pairs| {
        pairs.variable("$ACADVER", 1, "AC1015");
        pairs.variable("$DWGCODEPAGE", 3, "ANSI_1252");
        for (name, corner) in [("$EXTMIN", around.min), ("$EXTMAX", around.max)] {
            pairs.put(9, name);
            pairs.place(corner);
        }
        pairs.variable("$HANDSEED", 5, seed);
        // Millimetres, of the metric kind.
        pairs.variable("$INSUNITS", 70, 4);
        pairs.variable("$MEASUREMENT", 70, 1);
    });
    pairs.section("CLASSES", |_| {});
    pairs.append(body.pairs);
    pairs.into_bytes()
}

fn section(body: &mut Handled, name: &str, fill: impl FnOnce(&mut Handled)) {
    body.pairs.put(0, "SECTION");
    body.pairs.put(2, name);
    fill(body);
    body.pairs.put(0, "ENDSEC");
}

fn tables(body: &mut Handled, Tables { layers, types }: Tables<'_>) {
    section(body, "TABLES", |body| {
        body.table("VPORT", "1", 0, |_| {});
        body.table("LTYPE", "2", 3 + types.len(), |body| {
            for (name, handle) in [("ByBlock", "15"), ("ByLayer", "16"), ("Continuous", "17")] {
                body.record("LTYPE", handle, "2", "AcDbLinetypeTableRecord", name);
                let pairs = &mut body.pairs;
                pairs.put(70, 0);
                pairs.put(3, "");
                pairs.put(72, 65);
                pairs.put(73, 0);
                pairs.put(40, "0.0");
            }
            for line_type in types {
                let handle = body.handle();
                body.record("LTYPE", &handle, "2", "AcDbLinetypeTableRecord", line_type.name);
                body.pairs.put(70, 0);
                body.pairs.put(3, line_type.about);
                line_type.put_pattern(&mut body.pairs, true);
            }
        });
        body.table("LAYER", "3", 1 + layers.len(), |body| {
            let named = layers.iter().map(|layer| (layer.name, layer.number));
            for (name, number) in std::iter::once(("0", 7)).chain(named) {
                let handle = body.handle();
                // FreeCAD 0.20 reads no name of a layer that stands before the flags.
                let pairs = &mut body.pairs;
                pairs.put(0, "LAYER");
                pairs.put(5, handle);
                pairs.put(330, "3");
                pairs.put(100, "AcDbSymbolTableRecord");
                pairs.put(100, "AcDbLayerTableRecord");
                pairs.put(70, 0);
                pairs.put(2, name);
                pairs.put(62, number);
                pairs.put(6, "Continuous");
            }
        });
        body.table("STYLE", "4", 1, |body| {
            body.record("STYLE", STYLE, "4", "AcDbTextStyleTableRecord", "Standard");
            let pairs = &mut body.pairs;
            pairs.put(70, 0);
            for (code, value) in [(40, "0.0"), (41, "1.0"), (50, "0.0"), (71, "0"), (42, "2.5")] {
                pairs.put(code, value);
            }
            pairs.put(3, "txt");
            pairs.put(4, "");
        });
        body.table("VIEW", "5", 0, |_| {});
        body.table("UCS", "6", 0, |_| {});
        body.table("APPID", "7", 1, |body| {
            body.record("APPID", "21", "7", "AcDbRegAppTableRecord", "ACAD");
            body.pairs.put(70, 0);
        });
        body.table("DIMSTYLE", "8", 1, |body| {
            let pairs = &mut body.pairs;
            pairs.put(0, "DIMSTYLE");
            pairs.put(105, "22");
            pairs.put(330, "8");
            pairs.put(100, "AcDbSymbolTableRecord");
            pairs.put(100, "AcDbDimStyleTableRecord");
            pairs.put(2, "Standard");
            pairs.put(70, 0);
            pairs.put(340, STYLE);
        });
        body.table("BLOCK_RECORD", "9", 2, |body| {
            for (name, handle) in [("*Model_Space", MODEL_SPACE), ("*Paper_Space", PAPER_SPACE)] {
                body.record("BLOCK_RECORD", handle, "9", "AcDbBlockTableRecord", name);
            }
        });
    });
}

fn blocks(pairs: &mut Pairs) {
    pairs.section("BLOCKS", |pairs| {
        let spaces = [
            ("*Model_Space", MODEL_SPACE, ["12", "13"]),
            ("*Paper_Space", PAPER_SPACE, ["18", "19"]),
        ];
        for (name, record, [begin, end]) in spaces {
            let head = |pairs: &mut Pairs, kind: &str, handle: &str, class: &str| {
                pairs.put(0, kind);
                pairs.put(5, handle);
                pairs.put(330, record);
                pairs.put(100, "AcDbEntity");
                if record == PAPER_SPACE {
                    pairs.put(67, 1);
                }
                pairs.put(8, "0");
                pairs.put(100, class);
            };
            head(pairs, "BLOCK", begin, "AcDbBlockBegin");
            pairs.put(2, name);
            pairs.put(70, 0);
            for code in [10, 20, 30] {
                pairs.put(code, "0.0");
            }
            pairs.put(3, name);
            pairs.put(1, "");
            head(pairs, "ENDBLK", end, "AcDbBlockEnd");
        }
    });
}

fn entity(body: &mut Handled, of: &Entity) {
    let Entity { layer, line, .. } = of;
    let handle = body.handle();
    let pairs = &mut body.pairs;
    let is_circle = matches!(line.form, Form::Circle { .. });
    pairs.put(0, if is_circle { "CIRCLE" } else { "LWPOLYLINE" });
    pairs.put(5, handle);
    pairs.put(330, MODEL_SPACE);
    pairs.put(100, "AcDbEntity");
    pairs.put(8, layer);
    if let Some(line_type) = of.type_name() {
        pairs.put(6, line_type);
    }
    if let (Form::Circle { radius_mm }, Some(&centre)) = (line.form, line.points.first()) {
        pairs.put(100, "AcDbCircle");
        pairs.place(centre);
        pairs.put(40, real(radius_mm));
        return;
    }
    pairs.put(100, "AcDbPolyline");
    pairs.put(90, line.points.len());
    pairs.put(70, u8::from(line.form == Form::Closed));
    for (n, point) in line.points.iter().enumerate() {
        pairs.put(10, real(point.x));
        pairs.put(20, real(point.y));
        pairs.bulge(line, n);
    }
}

/// The root dictionary, and that of groups, which is empty.
fn dictionaries(pairs: &mut Pairs) {
    for (handle, owner) in [(ROOT, "0"), (GROUPS, ROOT)] {
        pairs.put(0, "DICTIONARY");
        pairs.put(5, handle);
        pairs.put(330, owner);
        pairs.put(100, "AcDbDictionary");
        pairs.put(281, 1);
        if handle == ROOT {
            pairs.put(3, "ACAD_GROUP");
            pairs.put(350, GROUPS);
        }
    }
}
