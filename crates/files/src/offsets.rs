//! Offsets: where the edges of a pattern lie at stations along a base line, to mark it out by hand.
//!
//! The base line is the lower side of the box around the finished piece, x runs along it and y
//! square to it. A line across the sheet at a station passes an edge wherever one end of a side
//! lies left of it and the other does not, so that it passes an even number of edges and two
//! neighbours bound a stretch of sheet. At both ends, that is asked 0.005 mm further inside, since
//! a side that runs square to the base line does so within rounding only.

use crate::shapes::digits;
use crate::table::name_cell;
use sheetwright::math::Point2;
use sheetwright::pattern::Piece;
use sheetwright::predicate::Box2;

/// A whole number of these are the most stations of a piece by default, beside its ends.
const MOST_STATIONS: f64 = 20.0;
/// The most stations of a piece at any pitch.
const MOST_AT_A_PITCH: f64 = 100_000.0;
/// So far from either end the edges of the first and the last station are taken: rounding decides
/// which of two corners is the last. Written are hundredths.
const NEAR_THE_END_MM: f64 = 0.005;
const MM_PER_INCH: f64 = 25.4;

/// The stations of a table of offsets, and its unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OffsetOptions {
    /// The distance of two stations, mm. Default: a round number for which a piece has 10 to 20.
    pub pitch_mm: Option<f64>,
    /// Whether lengths are written in feet, inches and eighths, such as `2-3-5`, with a `+` for a
    /// sixteenth more; else in millimetres.
    pub feet: bool,
}

/// The table of the offsets of some pieces: of each its finished outline and, where trims have
/// moved the cut off it, such as the lap of a scarf, that as it is cut. `docs/outputs.md` specifies
/// it for readers.
pub fn write_offsets<'a>(
    pieces: impl Iterator<Item = &'a Piece>,
    options: &OffsetOptions,
) -> Vec<u8> {
    let mut rows: Vec<(String, f64, Vec<f64>)> = Vec::new();
    let finished_and_cut = |piece: &'a Piece| {
        let cut =
            piece.has_net().then(|| (format!("{} (as cut)", piece.name), piece.loops().collect()));
        let net: Vec<&[Point2]> = piece.net_loops().collect();
        [(piece.name.clone(), net)].into_iter().chain(cut)
    };
    for (name, loops) in pieces.flat_map(finished_and_cut) {
        let Some(around) = Box2::of_points(loops.iter().copied().flatten().copied()) else {
            continue;
        };
        let name = name_cell(&name);
        let length_mm = around.max.x - around.min.x;
        let within_mm = NEAR_THE_END_MM.min(0.25 * length_mm);
        let of_station = |x: f64| {
            let at = x.clamp(within_mm, length_mm - within_mm);
            let heights = crossings(&loops, around.min.x + at);
            (name.clone(), x, heights.into_iter().map(|y| y - around.min.y).collect())
        };
        rows.extend(stations(length_mm, options).into_iter().map(of_station));
    }
    let stretches = rows.iter().map(|(.., heights)| heights.len() / 2).max().unwrap_or(0);
    let unit = if options.feet { "ft_in_8" } else { "mm" };
    let mut table = format!("part,station_{unit}");
    for n in 1..=stretches.max(1) {
        let number = if n == 1 { String::new() } else { format!("_{n}") };
        table.push_str(&format!(",lower{number}_{unit},upper{number}_{unit}"));
    }
    table.push('\n');
    for (name, x, heights) in rows {
        let length = |mm: f64| if options.feet { feet(mm) } else { hundredths(mm) };
        let mut cells: Vec<String> = heights.iter().map(|&y| length(y)).collect();
        cells.resize(2 * stretches.max(1), String::new());
        table.push_str(&format!("{name},{},{}\n", length(x), cells.join(",")));
    }
    table.into_bytes()
}

/// The stations of a piece of this length, mm: every multiple of the pitch, and the end.
fn stations(length_mm: f64, options: &OffsetOptions) -> Vec<f64> {
    let pitch_mm = options.pitch_mm.unwrap_or_else(|| round_pitch_mm(length_mm, options.feet));
    let count = (length_mm / pitch_mm).ceil().min(MOST_AT_A_PITCH);
    let whole = (0..count as u32).map(|n| f64::from(n) * pitch_mm);
    whole.filter(|&x| x < length_mm - NEAR_THE_END_MM).chain([length_mm]).collect()
}

/// The least round pitch at which a piece has no more than 20 stations, mm.
fn round_pitch_mm(length_mm: f64, feet: bool) -> f64 {
    let inches = [0.125, 0.25, 0.5, 1.0, 2.0, 3.0, 6.0].into_iter();
    let feet_long = [12.0, 24.0, 48.0, 120.0, 240.0, 480.0, 1200.0, 2400.0, 4800.0, 12000.0];
    let in_inches = inches.chain(feet_long).map(|inches| inches * MM_PER_INCH);
    let powers = [0.1, 1.0, 10.0, 100.0, 1e3, 1e4];
    let in_mm = powers.into_iter().flat_map(|power| [1.0, 2.0, 2.5, 5.0].map(|n| n * power));
    let mut pitches: Vec<f64> = if feet { in_inches.collect() } else { in_mm.collect() };
    // A length beyond all of them has more stations.
    let last = pitches.pop().unwrap_or(1.0);
    pitches.into_iter().find(|pitch| length_mm <= MOST_STATIONS * pitch).unwrap_or(last)
}

/// Where the line across at x passes the loops, y, the lowest first: an even number of times.
pub(crate) fn crossings(loops: &[&[Point2]], x: f64) -> Vec<f64> {
    let mut heights = passed(loops, |p| p.x <= x, x);
    if heights.is_empty() {
        heights = passed(loops, |p| p.x < x, x);
    }
    heights.sort_by(f64::total_cmp);
    heights
}

fn passed(loops: &[&[Point2]], is_left: impl Fn(&Point2) -> bool, x: f64) -> Vec<f64> {
    let sides = loops.iter().flat_map(|line| line.iter().zip(line.iter().cycle().skip(1)));
    let across = sides.filter(|(a, b)| is_left(a) != is_left(b));
    across.map(|(a, b)| a.lerp(*b, ((x - a.x) / (b.x - a.x)).clamp(0.0, 1.0)).y).collect()
}

/// A length in whole hundredths of a millimetre.
fn hundredths(mm: f64) -> String {
    digits((mm * 100.0).round() / 100.0)
}

/// A length in feet, inches and eighths, to the nearest sixteenth.
fn feet(mm: f64) -> String {
    let sixteenths = (mm / MM_PER_INCH * 16.0).round();
    let feet = (sixteenths / 192.0).floor();
    let rest = sixteenths - 192.0 * feet;
    let inches = (rest / 16.0).floor();
    let rest = rest - 16.0 * inches;
    let odd = if rest % 2.0 == 1.0 { "+" } else { "" };
    format!("{feet}-{inches}-{}{odd}", (rest / 2.0).floor())
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright::math::Vec2;
    use sheetwright::pattern::{PathKind, PatternPath, Role};

    fn path(kind: PathKind, points: Vec<Point2>) -> PatternPath {
        PatternPath { role: Role::Cut, kind, points, closed: true }
    }

    fn table(paths: Vec<PatternPath>, options: &OffsetOptions) -> Vec<Vec<String>> {
        let piece = Piece {
            name: "a".into(),
            paths,
            labels: Vec::new(),
            bends: Vec::new(),
            border: Vec::new(),
            is_folded: false,
            corner: Point2::default(),
            size: Vec2::ZERO,
        };
        let text = String::from_utf8(write_offsets([&piece].into_iter(), options)).unwrap();
        text.lines().map(|row| row.split(',').map(str::to_owned).collect()).collect()
    }

    fn square(low: f64, high: f64) -> Vec<Point2> {
        [(low, low), (high, low), (high, high), (low, high)]
            .map(|(x, y)| Point2::new(x, y))
            .to_vec()
    }

    #[test]
    fn a_station_has_both_edges_of_every_stretch_of_sheet() {
        let hole = square(40.0, 60.0).into_iter().rev().collect();
        let paths = vec![path(PathKind::Outline, square(0.0, 100.0)), path(PathKind::Hole, hole)];
        let options = OffsetOptions { pitch_mm: Some(50.0), feet: false };
        let rows = table(paths, &options);
        assert_eq!(rows[0].join(","), "part,station_mm,lower_mm,upper_mm,lower_2_mm,upper_2_mm");
        assert_eq!(
            rows[1..].iter().map(|row| row.join(",")).collect::<Vec<_>>(),
            ["a,0,0,100,,", "a,50,0,40,60,100", "a,100,0,100,,"]
        );
    }

    #[test]
    fn both_ends_have_both_corners_though_rounding_parts_them() {
        let corners = [(0.0, 0.0), (508.0, 0.0), (508.0 + 6e-14, 254.0), (-3e-14, 254.0)];
        let outline = corners.map(|(x, y)| Point2::new(x, y)).to_vec();
        let options = OffsetOptions { pitch_mm: Some(254.0), feet: false };
        let rows = table(vec![path(PathKind::Outline, outline)], &options);
        let rows: Vec<String> = rows[1..].iter().map(|row| row.join(",")).collect();
        assert_eq!(rows, ["a,0,0,254", "a,254,0,254", "a,508,0,254"]);
    }

    #[test]
    fn a_piece_whose_cut_is_trimmed_has_the_offsets_of_both_outlines() {
        let paths = vec![
            path(PathKind::Outline, square(-10.0, 110.0)),
            path(PathKind::Net, square(0.0, 100.0)),
        ];
        let rows = table(paths, &OffsetOptions::default());
        assert_eq!(rows[1].join(","), "a,0,0,100");
        assert_eq!(rows[1 + 21].join(","), "a (as cut),0,0,120", "stations every 5 mm");
        assert_eq!(rows.len(), 1 + 21 + 13, "stations every 10 mm");
    }

    #[test]
    fn feet_inches_and_eighths_are_what_lofters_write() {
        let inch = MM_PER_INCH;
        let written = [27.625, 27.6875, 0.0, 11.97, 12.0].map(|inches| feet(inches * inch));
        assert_eq!(written, ["2-3-5", "2-3-5+", "0-0-0", "1-0-0", "1-0-0"]);
    }

    #[test]
    fn a_piece_has_ten_to_twenty_stations_by_default() {
        for length_mm in [3.0, 17.0, 160.0, 333.0, 4567.0, 12_345.0] {
            for feet in [false, true] {
                let count = stations(length_mm, &OffsetOptions { pitch_mm: None, feet }).len() - 1;
                // Below an inch, no pitch is finer than an eighth.
                let least = if feet && length_mm < 100.0 { 1 } else { 8 };
                assert!((least..=20).contains(&count), "{length_mm} mm: {count}");
            }
        }
    }
}
