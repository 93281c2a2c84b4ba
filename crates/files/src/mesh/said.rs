//! The unit that a mesh names in a comment near its beginning: `# File units = inches`,
//! `comment Units: mm`, `solid box units=cm`. No format has a field for it.

use super::scan::lines;
use crate::reading::without_utf16;
use crate::units::Units;

/// The lines that are looked at, and the bytes.
const LINES: usize = 100;
const BYTES: usize = 1 << 14;

/// The unit of the lengths of a mesh, if a comment names it.
pub fn units_said(bytes: &[u8]) -> Option<Units> {
    let bytes = without_utf16(&bytes[..bytes.len().min(BYTES)]);
    let comments = lines(&bytes).take(LINES).filter_map(|(_, line)| {
        let text = String::from_utf8_lossy(line).trim().to_lowercase();
        ["#", "comment ", "obj_info ", "solid "]
            .iter()
            .any(|word| text.starts_with(word))
            .then_some(text)
    });
    comments.into_iter().find_map(|text| in_comment(&text))
}

fn in_comment(text: &str) -> Option<Units> {
    let (_, rest) = text.split_once("unit")?;
    let rest = rest.strip_prefix('s').unwrap_or(rest).trim_start();
    let rest = rest.strip_prefix([':', '='])?.trim_start();
    let end = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
    Some(match &rest[..end] {
        "mm" | "millimeter" | "millimeters" | "millimetre" | "millimetres" => Units::Millimetres,
        "cm" | "centimeter" | "centimeters" | "centimetre" | "centimetres" => Units::Centimetres,
        "m" | "meter" | "meters" | "metre" | "metres" => Units::Metres,
        "in" | "inch" | "inches" => Units::Inches,
        "ft" | "foot" | "feet" => Units::Feet,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comment_may_name_the_unit() {
        for (text, units) in [
            (&b"# made by hand\n# File units = inches\nv 0 0 0\n"[..], Some(Units::Inches)),
            (
                b"ply\nformat ascii 1.0\ncomment Units: mm, seen from above\n",
                Some(Units::Millimetres),
            ),
            (b"solid hood units=cm\r\nfacet\n", Some(Units::Centimetres)),
            (b"#Unit:Metres\rv 0 0 0\r", Some(Units::Metres)),
            (b"\xff\xfe#\0 \0u\0n\0i\0t\0=\0f\0t\0\n\0", Some(Units::Feet)),
            (b"# units: parsecs\nv 0 0 0\n", None),
            (b"# a unit of length\nv 0 0 0\n", None),
            (b"v 0 0 0\ng units: mm\n", None),
            (b"", None),
        ] {
            assert_eq!(units_said(text), units, "{:?}", String::from_utf8_lossy(text));
        }
    }
}
