//! Text in the fonts that every PDF reader has: their encoding and their widths.

/// A text in the encoding WinAnsi. Letters outside it lose their accents, signs are written out,
/// and other characters become question marks.
pub(crate) fn encoded(text: &str) -> Vec<u8> {
    let mut out = Vec::with_capacity(text.len());
    for character in text.chars() {
        match byte(character) {
            Some(byte) => out.push(byte),
            None => out.extend_from_slice(stand_in(character).as_bytes()),
        }
    }
    out
}

/// The length of a line of text of a size, mm. Bold letters are wider by less than a tenth.
pub(crate) fn text_mm(text: &str, size_pt: f64) -> f64 {
    width(&encoded(text)) * size_pt * (25.4 / 72.0)
}

/// The text, or its beginning and its end with dots between them, no longer than `most_mm`: names
/// mostly differ at their ends.
pub(crate) fn shortened(text: &str, size_pt: f64, most_mm: f64) -> String {
    let letters: Vec<char> = text.chars().collect();
    let without = |left_out: usize| -> String {
        let kept = letters.len() - left_out;
        let (first, last) = (kept.div_ceil(2), letters.len() - kept / 2);
        let dots = if left_out == 0 { None } else { Some('…') };
        letters[..first]
            .iter()
            .copied()
            .chain(dots)
            .chain(letters[last..].iter().copied())
            .collect()
    };
    let mut tried = (0..=letters.len()).map(without);
    tried.find(|text| text_mm(text, size_pt) <= most_mm).unwrap_or_default()
}

/// The lines of a text that is broken between words, each no longer than `most_mm`; a word that is
/// longer is broken.
pub(crate) fn wrapped(text: &str, size_pt: f64, most_mm: f64) -> Vec<String> {
    let fits = |line: &str| text_mm(line, size_pt) <= most_mm;
    let mut lines: Vec<String> = vec![String::new()];
    for word in text.split(' ') {
        let line = lines.len() - 1;
        let longer = if lines[line].is_empty() {
            word.to_owned()
        } else {
            format!("{} {word}", lines[line])
        };
        if fits(&longer) {
            lines[line] = longer;
            continue;
        }
        if !lines[line].is_empty() {
            lines.push(String::new());
        }
        for letter in word.chars() {
            let line = lines.len() - 1;
            let longer = format!("{}{letter}", lines[line]);
            if fits(&longer) || lines[line].is_empty() {
                lines[line] = longer;
            } else {
                lines.push(letter.to_string());
            }
        }
    }
    lines
}

/// The width of an encoded text in Helvetica of size 1 pt, in pt.
pub(crate) fn width(encoded: &[u8]) -> f64 {
    let thousandths = |b: &u8| {
        let from_space = usize::from(*b).checked_sub(0x20);
        from_space.and_then(|n| WIDTHS.get(n)).copied().unwrap_or(OTHERS)
    };
    encoded.iter().map(|b| f64::from(thousandths(b))).sum::<f64>() / 1000.0
}

fn byte(character: char) -> Option<u8> {
    match character {
        ' '..='~' | '\u{A0}'..='\u{FF}' => u8::try_from(u32::from(character)).ok(),
        _ => SIGNS.iter().find(|sign| sign.0 == character).map(|sign| sign.1),
    }
}

/// The signs between 0x80 and 0x9F of WinAnsi.
const SIGNS: [(char, u8); 27] = [
    ('€', 0x80),
    ('‚', 0x82),
    ('ƒ', 0x83),
    ('„', 0x84),
    ('…', 0x85),
    ('†', 0x86),
    ('‡', 0x87),
    ('ˆ', 0x88),
    ('‰', 0x89),
    ('Š', 0x8A),
    ('‹', 0x8B),
    ('Œ', 0x8C),
    ('Ž', 0x8E),
    ('‘', 0x91),
    ('’', 0x92),
    ('“', 0x93),
    ('”', 0x94),
    ('•', 0x95),
    ('–', 0x96),
    ('—', 0x97),
    ('˜', 0x98),
    ('™', 0x99),
    ('š', 0x9A),
    ('›', 0x9B),
    ('œ', 0x9C),
    ('ž', 0x9E),
    ('Ÿ', 0x9F),
];

fn stand_in(character: char) -> &'static str {
    match character {
        'Ā' | 'Ă' | 'Ą' => "A",
        'ā' | 'ă' | 'ą' => "a",
        'Ć' | 'Č' | 'Ĉ' | 'Ċ' => "C",
        'ć' | 'č' | 'ĉ' | 'ċ' => "c",
        'Ď' | 'Đ' => "D",
        'ď' | 'đ' => "d",
        'Ē' | 'Ė' | 'Ę' | 'Ě' => "E",
        'ē' | 'ė' | 'ę' | 'ě' => "e",
        'Ğ' | 'Ģ' | 'Ĝ' | 'Ġ' => "G",
        'ğ' | 'ģ' | 'ĝ' | 'ġ' => "g",
        'Ī' | 'Į' | 'İ' => "I",
        'ī' | 'į' | 'ı' => "i",
        'Ķ' => "K",
        'ķ' => "k",
        'Ł' | 'Ļ' | 'Ľ' | 'Ĺ' => "L",
        'ł' | 'ļ' | 'ľ' | 'ĺ' => "l",
        'Ń' | 'Ņ' | 'Ň' => "N",
        'ń' | 'ņ' | 'ň' => "n",
        'Ō' | 'Ő' => "O",
        'ō' | 'ő' => "o",
        'Ř' | 'Ŕ' => "R",
        'ř' | 'ŕ' => "r",
        'Ś' | 'Ş' | 'Ș' => "S",
        'ś' | 'ş' | 'ș' => "s",
        'Ţ' | 'Ț' | 'Ť' => "T",
        'ţ' | 'ț' | 'ť' => "t",
        'Ū' | 'Ů' | 'Ű' | 'Ų' => "U",
        'ū' | 'ů' | 'ű' | 'ų' => "u",
        'Ź' | 'Ż' => "Z",
        'ź' | 'ż' => "z",
        '−' | '‐' | '‑' => "-",
        '\u{202f}' | '\u{2009}' => " ",
        '→' => "->",
        '≤' => "<=",
        '≥' => ">=",
        _ => "?",
    }
}

/// The width of characters that [`WIDTHS`] does not list, thousandths of the size: that of most
/// letters.
const OTHERS: u16 = 556;

/// The widths of Helvetica from the space to the tilde, thousandths of the size.
#[rustfmt::skip]
const WIDTHS: [u16; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278,
    556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556,
    1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,
    667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556,
    333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556,
    556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_can_not_be_encoded_is_replaced_visibly() {
        assert_eq!(encoded("Größe 5 – 6"), b"Gr\xF6\xDFe 5 \x96 6");
        assert_eq!(encoded("Łódź −1 → ≤ 板"), b"L\xF3dz -1 -> <= ?");
        assert_eq!(encoded("a\u{7}b"), b"a?b");
    }

    #[test]
    fn long_texts_are_broken_or_lose_their_middle() {
        assert_eq!(shortened("transom", 10.0, 100.0), "transom");
        let short = shortened("a-very-long-name-of-a-panel-12", 10.0, 30.0);
        assert!(short.starts_with("a-very") && short.ends_with("l-12"), "{short}");
        assert!(text_mm(&short, 10.0) <= 30.0);
        let lines = wrapped("one two three incomprehensibilities of a word", 10.0, 22.0);
        assert!(lines.iter().all(|line| text_mm(line, 10.0) <= 22.0), "{lines:?}");
        assert_eq!(lines.concat().replace(' ', ""), "onetwothreeincomprehensibilitiesofaword");
        assert_eq!(lines[0], "one two three");
    }

    #[test]
    fn widths_are_those_of_helvetica() {
        assert!((width(b"Hi 100") - (0.722 + 0.222 + 0.278 + 3.0 * 0.556)).abs() < 1e-12);
    }
}
