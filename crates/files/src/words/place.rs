//! Places of findings, in words.

use sheetwright::check::{BorderSide, Finding, FindingKind, LinePlace, Place, SeamPlace};
use sheetwright::index::SampleIndex;
use sheetwright::math::Point3;
use sheetwright::pattern::seam_mark;

/// The most entries of a list that a place shows.
const SHOWN: usize = 6;

/// The place of a finding: `rungs 41–47`, `samples 3, 12`; empty where it is the whole panel.
/// Numbers count from 1.
pub fn finding_place(finding: &Finding) -> String {
    match (&finding.place, &finding.kind) {
        (Place::Whole, _) => String::new(),
        (Place::Rungs { numbers }, _) => rungs(numbers),
        (Place::Samples { numbers }, FindingKind::JointsSmoothed { .. }) => {
            format!("around samples {}", listed(numbers))
        }
        (Place::Samples { numbers }, _) => samples(numbers),
        (Place::Triangles { corners }, _) => {
            let triangles: Vec<String> = corners.iter().map(|t| listed(t)).collect();
            format!("triangles at samples {}", triangles.join(" and "))
        }
        (Place::Sides { sides }, _) => {
            let between = |side: &BorderSide| {
                let [from, to] = side.samples.map(number);
                format!("from {from} to {to}")
            };
            let sides: Vec<String> = sides.iter().map(between).collect();
            let sides = sides.join(" and ");
            format!("edges {}", sides.replacen("from", "from sample", 1))
        }
        (Place::Seams { seams: list }, _) => seams(list),
        (Place::Points { at }, kind) => points(at, kind),
        (Place::Lines { lines: list }, _) => lines(list),
        (Place::CurvePoints { curve, numbers }, _) => {
            let first = numbers.first().map_or(0, |first| first + 1);
            format!("point {first}{} of '{curve}'", and_more(numbers.len(), 1, ""))
        }
    }
}

/// A point in space: `(1.0, 2.0, 3.0) mm`.
pub(super) fn point(p: Point3) -> String {
    // Rounded first, so that no zero has a sign.
    let [x, y, z] = [p.x, p.y, p.z].map(|c| (c * 10.0).round() / 10.0 + 0.0);
    format!("({x:.1}, {y:.1}, {z:.1}) mm")
}

/// Lines by their ends.
fn lines(lines: &[LinePlace]) -> String {
    let ends = |line: &LinePlace| Some((point(*line.at.first()?), point(*line.at.last()?)));
    let ends = lines.iter().filter_map(ends).map(|(a, b)| format!("from {a} to {b}"));
    let ends = ends.collect::<Vec<_>>().join(", ");
    format!("along the {} {ends}", if lines.len() == 1 { "line" } else { "lines" })
}

fn number(sample: SampleIndex) -> usize {
    sample.get() + 1
}

fn listed(numbers: &[SampleIndex]) -> String {
    numbers.iter().map(|&n| number(n).to_string()).collect::<Vec<_>>().join(", ")
}

/// ` and 3 more`, with `what` behind it; empty where all of `count` are `shown`.
fn and_more(count: usize, shown: usize, what: &str) -> String {
    match count.saturating_sub(shown) {
        0 => String::new(),
        more => format!(" and {more} more{what}"),
    }
}

fn samples(numbers: &[SampleIndex]) -> String {
    let shown = listed(&numbers[..numbers.len().min(SHOWN)]);
    let s = if numbers.len() == 1 { "" } else { "s" };
    format!("sample{s} {shown}{}", and_more(numbers.len(), SHOWN, ""))
}

/// The number of ranges that are left out, in words.
fn and_more_ranges(count: usize) -> String {
    let what = if count == SHOWN + 1 { " range" } else { " ranges" };
    and_more(count, SHOWN, what)
}

/// Rungs as ranges of their numbers: `rungs 41–47, 60`.
fn rungs(numbers: &[usize]) -> String {
    let mut ranges: Vec<(usize, usize)> = Vec::new();
    for n in numbers.iter().map(|n| n + 1) {
        match ranges.last_mut() {
            Some((_, end)) if *end + 1 == n => *end = n,
            _ => ranges.push((n, n)),
        }
    }
    let shown: Vec<String> = ranges
        .iter()
        .take(SHOWN)
        .map(|&(a, b)| if a == b { a.to_string() } else { format!("{a}–{b}") })
        .collect();
    let word = if numbers.len() == 1 { "rung" } else { "rungs" };
    format!("{word} {}{}", shown.join(", "), and_more_ranges(ranges.len()))
}

/// Seams with their marks: `S1 from sample 3 to 17`; of a mesh, whose list has all, `S1 to S5`.
fn seams(list: &[SeamPlace]) -> String {
    if let [SeamPlace { number: first, ends: None }, .., SeamPlace { number: last, .. }] = list {
        return format!("{} to {}", seam_mark(*first), seam_mark(*last));
    }
    let shown: Vec<String> = list
        .iter()
        .take(SHOWN)
        .map(|seam| {
            let mark = seam_mark(seam.number);
            match seam.ends.map(|ends| ends.map(number)) {
                Some([a, b]) => format!("{mark} from sample {a} to {b}"),
                None => mark,
            }
        })
        .collect();
    format!("{}{}", shown.join(", "), and_more(list.len(), SHOWN, ""))
}

fn points(at: &[Point3], kind: &FindingKind) -> String {
    let places: Vec<String> = at.iter().map(|&p| format!("at {}", point(p))).collect();
    let places = places.join(" and ");
    match kind {
        FindingKind::Overlap => format!("the border {places}"),
        FindingKind::PartsLeftOut { count } | FindingKind::Healed { count, .. } if *count > 1 => {
            format!("the first {places}")
        }
        _ => places,
    }
}
