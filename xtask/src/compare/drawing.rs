//! The lines of a drawing without the details of its file: to tell a pattern that has moved from
//! one that is written in another way.

use miniz_oxide::inflate::decompress_to_vec_zlib;

/// The lines of an SVG, DXF or PDF; `None` for another ending, or if the file can't be read.
pub(super) fn shown(name: &str, bytes: &[u8]) -> Option<Vec<u8>> {
    match name.rsplit('.').next()? {
        "svg" => svg(std::str::from_utf8(bytes).ok()?),
        "dxf" => dxf(std::str::from_utf8(bytes).ok()?),
        "pdf" => pdf(bytes),
        _ => None,
    }
}

/// The size, and the lines of all paths except letters, group by group.
fn svg(text: &str) -> Option<Vec<u8>> {
    let mut shown = String::new();
    for tag in text.split('<').skip(1) {
        let attribute = |name: &str| {
            let from = tag.find(&format!(" {name}=\""))? + name.len() + 3;
            Some(&tag[from..from + tag[from..].find('"')?])
        };
        let wanted: &[&str] = match tag.split([' ', '>']).next()? {
            "svg" => &["width", "height", "viewBox"],
            "g" => &["id"],
            "path" if attribute("class") != Some("label") => &["d"],
            _ => &[],
        };
        for value in wanted.iter().filter_map(|name| attribute(name)) {
            shown += value;
            shown.push('\n');
        }
    }
    Some(shown.into_bytes())
}

/// The entities.
fn dxf(text: &str) -> Option<Vec<u8>> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let start = lines.windows(2).position(|pair| pair == ["2", "ENTITIES"])?;
    let length = lines[start..].iter().position(|line| *line == "ENDSEC")?;
    Some(lines[start..start + length].join("\n").into_bytes())
}

/// The contents of all streams without their texts.
fn pdf(bytes: &[u8]) -> Option<Vec<u8>> {
    let mut shown = Vec::new();
    let mut rest = bytes;
    while let Some(at) = position(rest, b"stream\n") {
        rest = &rest[at + b"stream\n".len()..];
        let end = position(rest, b"endstream")?;
        let content = decompress_to_vec_zlib(&rest[..end]).ok();
        let content = content.unwrap_or_else(|| rest[..end].to_vec());
        rest = &rest[end + b"endstream".len()..];
        let mut left = &content[..];
        while let Some(from) = position(left, b"BT\n") {
            shown.extend(&left[..from]);
            let to = position(&left[from..], b"ET\n")?;
            left = &left[from + to + b"ET\n".len()..];
        }
        shown.extend(left);
    }
    Some(shown)
}

fn position(bytes: &[u8], wanted: &[u8]) -> Option<usize> {
    bytes.windows(wanted.len()).position(|window| window == wanted)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests panic

    use super::*;
    use miniz_oxide::deflate::compress_to_vec_zlib;

    #[test]
    fn an_svg_shows_its_lines() {
        let svg = |stroke: &str, d: &str, letters: &str| {
            let text = format!(
                "<svg width=\"9mm\" viewBox=\"0 0 9 9\"><title>{stroke}</title><g id=\"cut\" \
                 stroke-width=\"{stroke}\"><path class=\"outline\" d=\"{d}\"/><path \
                 class=\"label\" d=\"{letters}\"/></g></svg>"
            );
            shown("a.svg", text.as_bytes()).unwrap()
        };
        assert_eq!(svg("0.1", "M0,0 L1,1", "M2,2"), svg("1", "M0,0 L1,1", "M3,3"));
        assert_ne!(svg("0.1", "M0,0 L1,1", ""), svg("0.1", "M0,0 L1,2", ""));
    }

    #[test]
    fn a_dxf_shows_its_entities() {
        let dxf = |header: &str, x: &str| {
            let text = format!(
                "0\nSECTION\n2\nHEADER\n9\n{header}\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n 10\n{x}\n\
                 0\nENDSEC\n0\nEOF\n"
            );
            shown("a.dxf", text.as_bytes()).unwrap()
        };
        assert_eq!(dxf("$A", "1.0"), dxf("$B", "1.0"));
        assert_ne!(dxf("$A", "1.0"), dxf("$A", "1.5"));
        assert_eq!(shown("a.dxf", b"0\nEOF\n"), None);
    }

    #[test]
    fn a_pdf_shows_its_lines_without_texts() {
        let pdf = |level: u8, lines: &str, text: &str| {
            let content = format!("{lines}\nBT\n({text}) Tj\nET\nS\n");
            let mut bytes = b"%PDF-1.7\n<< >>\nstream\n".to_vec();
            bytes.extend(compress_to_vec_zlib(content.as_bytes(), level));
            bytes.extend(b"\nendstream\n%%EOF");
            shown("a.pdf", &bytes).unwrap()
        };
        assert_eq!(pdf(1, "0 0 m 1 1 l", "one"), pdf(9, "0 0 m 1 1 l", "two"));
        assert_ne!(pdf(1, "0 0 m 1 1 l", "one"), pdf(1, "0 0 m 1 2 l", "one"));
        assert_eq!(shown("a.txt", b""), None);
    }
}
