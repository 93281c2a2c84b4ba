//! Surfaces as OBJ.

use crate::drawing::digits;
use sheetwright::design::Made;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// The OBJ file of all panels: an object and a group a panel, places in space as vertices and
/// places on the flat pattern as texture coordinates, both in mm and with all their digits.
pub fn write_obj(made: &Made) -> Vec<u8> {
    let mut obj = String::from(
        "# Surface by Sheetwright. Units: mm. One group per panel.\n\
         # v: places in space. vt: the same samples on the flat pattern, in mm as well.\n",
    );
    let (mut before, mut before_flat) = (1, 1);
    let mut taken = BTreeSet::new();
    for panel in &made.panels {
        let name = one_word(&panel.name, &mut taken);
        // `o` divides the file for Blender and trimesh, `g` for everyone else. Writing to a
        // string does not fail.
        let _ = writeln!(obj, "o {name}\ng {name}");
        for p in panel.surface.positions() {
            let _ = writeln!(obj, "v {} {} {}", digits(p.x), digits(p.y), digits(p.z));
        }
        for p in &panel.flat.points {
            let _ = writeln!(obj, "vt {} {}", digits(p.x), digits(p.y));
        }
        // Along a seam, a sample lies on the pattern twice.
        let on_sheet = panel.sheet.surface().connectivity().triangles();
        for (triangle, flat) in panel.surface.connectivity().triangles().iter().zip(on_sheet) {
            let [a, b, c] = triangle.map(|s| before + s.get());
            let [p, q, r] = flat.map(|s| before_flat + s.get());
            let _ = writeln!(obj, "f {a}/{p} {b}/{q} {c}/{r}");
        }
        before += panel.surface.positions().len();
        before_flat += panel.flat.points.len();
    }
    obj.into_bytes()
}

/// A name as OBJ takes it: blanks would begin another group. Names that differ in blanks alone are
/// told apart by a number.
pub(crate) fn one_word(name: &str, taken: &mut BTreeSet<String>) -> String {
    let word: String =
        name.chars().map(|c| if c.is_whitespace() || c.is_control() { '_' } else { c }).collect();
    let numbered = (2..).map(|n| format!("{word}_{n}"));
    let mut words = std::iter::once(word.clone()).chain(numbered);
    words.find(|word| taken.insert(word.clone())).unwrap_or(word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_panel_keeps_a_group_of_its_own() {
        let mut taken = BTreeSet::new();
        let words = ["a b", "a_b", "a\tb"].map(|name| one_word(name, &mut taken));
        assert_eq!(words, ["a_b", "a_b_2", "a_b_3"]);
    }
}
