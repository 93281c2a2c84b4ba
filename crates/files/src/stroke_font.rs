//! A single-stroke alphabet for engraved labels.
//!
//! A laser or a pen draws a letter along its middle line; the outlines of a printed font would be
//! traced on both sides, and a font that a machine does not have would be replaced. Every letter
//! stands on a grid of 4 by 9 units, round shapes are cut off at 45°, and letters that workshops
//! mix up are told apart: the nought has a stroke through it, the I has feet, the l has a hook.

use sheetwright::math::{Point2, Vec2};

/// A line of text as polylines, mm. The middle of its base line is `at`, it runs in the unit
/// direction `along`, and a capital is `height_mm` high. A character that the alphabet does not
/// have becomes a box.
pub(crate) fn strokes(text: &str, at: Point2, along: Vec2, height_mm: f64) -> Vec<Vec<Point2>> {
    let unit_mm = height_mm / CAPITAL;
    let mut drawn = Vec::new();
    let mut pen = -0.5 * width_units(text);
    for character in text.chars() {
        let (glyph, width) = glyph(character);
        for stroke in glyph.split_ascii_whitespace() {
            let place = |xy: &[u8]| {
                let x = pen + f64::from(xy[0] - b'0');
                let y = f64::from(xy[1] - b'0') - BASE_LINE;
                at + along * (x * unit_mm) + along.perp() * (y * unit_mm)
            };
            drawn.push(stroke.as_bytes().chunks_exact(2).map(place).collect());
        }
        pen += width + GAP;
    }
    drawn
}

fn width_units(text: &str) -> f64 {
    let all: f64 = text.chars().map(|c| glyph(c).1 + GAP).sum();
    (all - GAP).max(0.0)
}

/// Height of a capital, units.
const CAPITAL: f64 = 6.0;
/// Where the base line runs on the grid, units.
const BASE_LINE: f64 = 2.0;
/// The gap between two characters, units.
const GAP: f64 = 2.0;
/// The width of a space, units.
const SPACE: f64 = 2.0;
/// The strokes for a character that the alphabet does not have.
const BOX: &str = "0242480802";

/// The strokes of a character, and its width in units.
fn glyph(character: char) -> (&'static str, f64) {
    if character.is_whitespace() {
        return ("", SPACE);
    }
    let found = GLYPHS.binary_search_by_key(&character, |entry| entry.0);
    let strokes = found.map_or(BOX, |n| GLYPHS[n].1);
    let columns = strokes.split_ascii_whitespace().flat_map(|s| s.bytes().step_by(2));
    (strokes, columns.max().map_or(0.0, |x| f64::from(x - b'0')))
}

/// The alphabet, by code point. A stroke is a run of digit pairs, x and y on the grid: the base
/// line is y = 2, small letters reach to 6, capitals to 8, tails down to 0 and dots up to 9.
#[rustfmt::skip]
const GLYPHS: [(char, &str); 106] = [
    ('!', "0804 0302"), ('"', "0806 1816"), ('#', "1218 3238 0444 0646"),
    ('%', "0248 0818170708 3343423233"), ('&', "42071828370403122244"), ('\'', "0806"),
    ('(', "18070312"), (')', "08171302"), ('*', "1317 0644 0446"), ('+', "2327 0545"),
    (',', "1301"), ('-', "0535"), ('.', "0203131202"), ('/', "0248"),
    ('0', "183847433212030718 0347"), ('1', "062822 0242"), ('2', "07183847460242"),
    ('3', "0718384746354443321203 1535"), ('4', "32380444"), ('5', "480805354443321203"),
    ('6', "473818070312324344351504"), ('7', "084812"), ('8', "15060718384746351504031232434435"),
    ('9', "031232434738180706153546"), (':', "0203 0506"), (';', "1301 1516"), ('<', "470543"),
    ('=', "0444 0646"), ('>', "074503"), ('?', "07183847462524 2322"),
    ('@', "3436261524344447381807031242"),
    ('A', "022842 1535"), ('B', "02083847463505 3544433202"), ('C', "4738180703123243"),
    ('D', "02082846442202"), ('E', "48080242 0535"), ('F', "480802 0535"),
    ('G', "47381807031232434525"), ('H', "0802 4842 0545"), ('I', "1218 0222 0828"),
    ('J', "4843321203"), ('K', "0802 4804 1542"), ('L', "080242"), ('M', "0208254842"),
    ('N', "02084248"), ('O', "183847433212030718"), ('P', "02083847463505"),
    ('Q', "183847433212030718 2442"), ('R', "02083847463505 2542"),
    ('S', "473818070615354443321203"), ('T', "0848 2822"), ('U', "080312324348"), ('V', "082248"),
    ('W', "0812263248"), ('X', "0248 0842"), ('Y', "082548 2522"), ('Z', "08480242"),
    ('[', "18080212"), ('\\', "0842"), (']', "08181202"), ('_', "0141"),
    ('a', "4642 4536160503123243"), ('b', "0802 0516364543321203"), ('c', "4536160503123243"),
    ('d', "4842 4536160503123243"), ('e', "04444536160503123242"), ('f', "38281712 0636"),
    ('g', "4536160503123243 4641301001"), ('h', "0802 0516364542"), ('i', "0602 0807"),
    ('j', "26211000 2827"), ('k', "0802 3603 1432"), ('l', "080312"),
    ('m', "0602 05162522 25364542"), ('n', "0602 0516364542"), ('o', "163645433212030516"),
    ('p', "0600 0516364543321203"), ('q', "4640 4536160503123243"), ('r', "0602 051636"),
    ('s', "45361605143443321203"), ('t', "18132232 0636"), ('u', "0603123243 4642"),
    ('v', "062246"), ('w', "0612253246"), ('x', "0246 0642"), ('y', "0622 4610"),
    ('z', "06460242"), ('°', "1827160718"), ('²', "0828270626"),
    ('Ä', "022842 1535 0919 3949"), ('Ö', "183847433212030718 0919 3949"),
    ('×', "0347 0743"), ('Ü', "080312324348 0919 3949"), ('ß', "020718283736253443321222"), ('à', "4642 4536160503123243 1827"),
    ('ä', "4642 4536160503123243 1817 3837"), ('å', "4642 4536160503123243 2938271829"),
    ('ç', "4536160503123243 222010"), ('è', "04444536160503123242 1827"),
    ('é', "04444536160503123242 2738"), ('ñ', "0602 0516364542 07182738"),
    ('ö', "163645433212030516 1817 3837"), ('ø', "163645433212030516 0147"),
    ('ü', "0603123243 4642 1817 3837"), ('–', "0545"), ('−', "0545"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_alphabet_is_sorted_and_every_stroke_goes_somewhere() {
        for pair in GLYPHS.windows(2) {
            assert!(pair[0].0 < pair[1].0, "{:?} before {:?}", pair[0].0, pair[1].0);
        }
        for (character, strokes) in GLYPHS {
            for stroke in strokes.split_ascii_whitespace() {
                let bytes = stroke.as_bytes();
                assert!(bytes.len() >= 4 && bytes.len().is_multiple_of(2), "{character}");
                let points: Vec<&[u8]> = bytes.chunks_exact(2).collect();
                for point in &points {
                    assert!((b'0'..=b'4').contains(&point[0]), "{character}");
                    assert!(point[1].is_ascii_digit(), "{character}");
                }
                for step in points.windows(2) {
                    assert_ne!(step[0], step[1], "a stroke of {character} stands still");
                }
            }
        }
    }

    #[test]
    fn all_printable_ascii_of_names_is_there() {
        for character in ('A'..='Z').chain('a'..='z').chain('0'..='9').chain("-_.,()+#".chars()) {
            assert_ne!(glyph(character).0, BOX, "{character}");
        }
        assert_eq!(glyph('\u{1F6F6}').0, BOX);
    }

    #[test]
    fn every_glyph_is_drawn_inside_its_box() {
        let (at, height) = (Point2::new(100.0, -20.0), 12.0);
        for (character, _) in GLYPHS {
            let drawn = strokes(&character.to_string(), at, Vec2::X, height);
            assert!(!drawn.is_empty());
            let half = 0.5 * width_units(&character.to_string()) * height / CAPITAL + 1e-9;
            for point in drawn.iter().flatten() {
                assert!((point.x - at.x).abs() <= half, "{character}");
                let above = point.y - at.y;
                // A third of the height below the base line, a sixth above a capital for its dots.
                assert!((-4.0 - 1e-9..=14.0 + 1e-9).contains(&above), "{character} {above}");
            }
        }
    }

    #[test]
    fn a_line_of_text_is_centred_and_turned() {
        let along = Vec2::new(0.6, 0.8);
        let drawn = strokes("HH", Point2::new(5.0, 7.0), along, 6.0);
        let ends = drawn.iter().flatten().map(|p| (*p - Point2::new(5.0, 7.0)).dot(along));
        let (low, high) = ends.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
        assert!((low + 5.0).abs() < 1e-12 && (high - 5.0).abs() < 1e-12, "{low} {high}");
        assert_eq!(width_units("HH"), 10.0);
        assert!(strokes("", Point2::default(), along, 6.0).is_empty());
    }
}
