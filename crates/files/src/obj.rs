//! Surfaces as OBJ.

use crate::shapes::digits;
use sheetwright::index::VertexIndex;
use sheetwright::make::Made;
use sheetwright::math::{Point2, Point3};
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// The OBJ file of all parts, with one object and one group per part. Vertices are points in space,
/// texture coordinates are points of the flat pattern, both in mm with all their digits.
pub fn write_obj(made: &Made) -> Vec<u8> {
    let mut obj = Obj::new();
    for part in &made.parts {
        // Along a seam, a vertex lies on the pattern twice.
        let on_sheet = part.sheet.mesh().triangles().iter().map(|t| t.map(VertexIndex::get));
        let triangles = part.triangles().zip(on_sheet).map(|(space, flat)| [space, flat]);
        obj.part(&part.name, part.positions(), &part.flat.points, triangles);
    }
    obj.text.into_bytes()
}

/// An OBJ file so far.
struct Obj {
    text: String,
    /// The numbers of the next vertex and of the next texture coordinate.
    next: [usize; 2],
    /// Names that are taken.
    taken: BTreeSet<String>,
}

impl Obj {
    fn new() -> Self {
        let text = String::from(
            "# Surface by Sheetwright. Units: mm. One group per panel.\n\
             # v: places in space. vt: the same samples on the flat pattern, in mm as well.\n",
        );
        Self { text, next: [1, 1], taken: BTreeSet::new() }
    }

    /// Adds a part: every triangle by its corners in space and on the pattern.
    fn part(
        &mut self,
        name: &str,
        space: &[Point3],
        flat: &[Point2],
        triangles: impl Iterator<Item = [[usize; 3]; 2]>,
    ) {
        let name = one_word(name, &mut self.taken);
        let obj = &mut self.text;
        // `o` divides the file for Blender and trimesh, `g` for other programs. Writing to a string
        // does not fail.
        let _ = writeln!(obj, "o {name}\ng {name}");
        for p in space {
            let _ = writeln!(obj, "v {} {} {}", digits(p.x), digits(p.y), digits(p.z));
        }
        for p in flat {
            let _ = writeln!(obj, "vt {} {}", digits(p.x), digits(p.y));
        }
        let [before, before_flat] = self.next;
        for [triangle, flat] in triangles {
            let [a, b, c] = triangle.map(|n| before + n);
            let [p, q, r] = flat.map(|n| before_flat + n);
            let _ = writeln!(obj, "f {a}/{p} {b}/{q} {c}/{r}");
        }
        self.next = [before + space.len(), before_flat + flat.len()];
    }
}

/// A name without blanks, which would begin another group in OBJ. A number is added where the
/// result is taken.
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
