//! DXF of release 12.

use super::entity::{Entity, Tables};
use super::pairs::{Pairs, ascii};
use sheetwright::predicate::Box2;

/// The file of a piece of this name: lines on layers, within a box.
pub(super) fn written(
    name: &str,
    declared: Tables<'_>,
    around: Box2,
    entities: &[Entity],
) -> Vec<u8> {
    let mut pairs = Pairs::default();
    pairs.put(999, format_args!("Flat pattern of {}, by Sheetwright. Units: mm.", ascii(name)));
    pairs.section("HEADER", |pairs| {
        pairs.variable("$ACADVER", 1, "AC1009");
        for (name, corner) in [("$EXTMIN", around.min), ("$EXTMAX", around.max)] {
            pairs.put(9, name);
            pairs.place(corner);
        }
    });
    pairs.section("TABLES", |pairs| tables(pairs, declared));
    pairs.section("BLOCKS", |_| {});
    pairs.section("ENTITIES", |pairs| {
        entities.iter().for_each(|of| pairs.line(of.layer, of.type_name(), &of.line));
    });
    pairs.into_bytes()
}

fn tables(pairs: &mut Pairs, Tables { layers, types }: Tables<'_>) {
    table(pairs, "LTYPE", 1 + types.len(), |pairs| {
        pairs.put(0, "LTYPE");
        pairs.put(2, "CONTINUOUS");
        pairs.put(70, 0);
        pairs.put(3, "Solid line");
        pairs.put(72, 65);
        pairs.put(73, 0);
        pairs.put(40, "0.0");
        for line_type in types {
            pairs.put(0, "LTYPE");
            pairs.put(2, line_type.name);
            pairs.put(70, 0);
            pairs.put(3, line_type.about);
            line_type.put_pattern(pairs, false);
        }
    });
    table(pairs, "LAYER", 1 + layers.len(), |pairs| {
        let layer_0 = ("0", 7);
        let layers = layers.iter().map(|layer| (layer.name, layer.number));
        for (name, colour) in std::iter::once(layer_0).chain(layers) {
            pairs.put(0, "LAYER");
            // FreeCAD 0.20 reads no name of a layer that stands before the flags.
            pairs.put(70, 0);
            pairs.put(2, name);
            pairs.put(62, colour);
            pairs.put(6, "CONTINUOUS");
        }
    });
}

fn table(pairs: &mut Pairs, name: &str, entries: usize, fill: impl FnOnce(&mut Pairs)) {
    pairs.put(0, "TABLE");
    pairs.put(2, name);
    pairs.put(70, entries);
    fill(pairs);
    pairs.put(0, "ENDTAB");
}
