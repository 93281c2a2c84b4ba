//! The corners of a flat part between which a builder measures, and the farthest corners of the
//! joined parts.

use super::edge_name;
use crate::pdf::corners;
use sheetwright::edge::Edge;
use sheetwright::make::{Made, Part};
use sheetwright::math::{Point2, Point3};
use sheetwright::pattern::Piece;
use std::collections::BTreeMap;

/// The most corners among which the farthest are looked for; of more, every second, third, ….
const MOST_CORNERS: usize = 1_500;
/// Of so many corners that are far apart the best four are chosen.
const SPREAD: usize = 20;
/// Distances that differ by less than this share are equal, so that the first is taken.
const EQUAL: f64 = 1e-9;
/// Distances in space below this share of the largest are not measured.
const LEAST_SHARE: f64 = 0.3;
/// The most openings.
const MOST_OPENINGS: usize = 6;
/// The most distances in space.
const MOST_DISTANCES: usize = 5;
/// Corners of parts in space that are nearer than this share of the size are one.
const SAME_SHARE: f64 = 1e-4;

/// Some corners of the outline of a finished part, in its order, up to four: those whose two
/// diagonals are longest together.
pub(super) fn far_corners(piece: &Piece) -> Vec<Point2> {
    let outline = piece.net_loops().next().unwrap_or(&[]);
    let all = spread(&thinned(corners(outline)));
    let count = all.len();
    let mut best: Option<(f64, [usize; 4])> = None;
    for a in 0..count {
        for b in a + 1..count {
            for c in b + 1..count {
                for d in c + 1..count {
                    let length = all[a].distance(all[c]) + all[b].distance(all[d]);
                    if best.is_none_or(|(most, _)| length > most * (1.0 + EQUAL)) {
                        best = Some((length, [a, b, c, d]));
                    }
                }
            }
        }
    }
    match best {
        Some((_, four)) => four.map(|n| all[n]).to_vec(),
        None => all,
    }
}

/// Corners that lie far from one another, in their order: the two farthest, and then always the one
/// that is farthest from those that are chosen.
fn spread(all: &[Point2]) -> Vec<Point2> {
    let Some(pair) = farthest(all, |p, q| p.distance(*q)) else { return all.to_vec() };
    let mut chosen = pair.to_vec();
    while chosen.len() < SPREAD.min(all.len()) {
        let near = |n: usize| {
            chosen.iter().map(|&k| all[n].distance(all[k])).fold(f64::INFINITY, f64::min)
        };
        let left = (0..all.len()).filter(|n| !chosen.contains(n));
        let next = left.reduce(|best, n| if near(n) > near(best) { n } else { best });
        chosen.extend(next);
    }
    chosen.sort_unstable();
    chosen.into_iter().map(|n| all[n]).collect()
}

/// The distances to measure between corners A, B, C, … of a flat part, mm, by their letters: the
/// diagonals of four corners, all sides of three.
pub(super) fn diagonals(corners: &[Point2]) -> Vec<(String, f64)> {
    let pairs: &[[usize; 2]] = match corners.len() {
        4 => &[[0, 2], [1, 3]],
        3 => &[[0, 1], [1, 2], [0, 2]],
        2 => &[[0, 1]],
        _ => &[],
    };
    let named = |&[a, b]: &[usize; 2]| {
        let name = format!("{}–{}", letter(a), letter(b));
        (name, corners[a].distance(corners[b]))
    };
    pairs.iter().map(named).collect()
}

/// The letter of a corner.
pub(super) fn letter(n: usize) -> char {
    char::from(b'A' + (n % 26) as u8)
}

/// A corner of a part in space.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SpaceCorner {
    /// Where it lies, mm.
    pub(super) at: Point3,
    /// The part, and the edges that meet in it.
    pub(super) name: String,
}

/// The corners of joined parts that are farthest apart: pairs, each farther than the next, no
/// corner twice. Corners are where edges end.
pub(super) fn far_in_space(made: &Made) -> Vec<[SpaceCorner; 2]> {
    let mut left = thinned(space_corners(made));
    let mut pairs: Vec<[SpaceCorner; 2]> = Vec::new();
    let length = |pair: &[SpaceCorner; 2]| pair[0].at.distance(pair[1].at);
    while pairs.len() < MOST_DISTANCES {
        let apart = |p: &SpaceCorner, q: &SpaceCorner| p.at.distance(q.at);
        let Some([a, b]) = farthest(&left, apart) else { break };
        // The later one first, so that the number of the other stays.
        let second = left.remove(a.max(b));
        let first = left.remove(a.min(b));
        let distance = first.at.distance(second.at);
        if distance <= LEAST_SHARE * pairs.first().map_or(0.0, length) {
            break;
        }
        pairs.push([first, second]);
    }
    pairs
}

/// The longest free edges that run round in space, each with its largest width, mm.
pub(super) fn openings(made: &Made) -> Vec<(String, f64)> {
    let mut found: Vec<(&Part, &Edge)> = Vec::new();
    for part in &made.parts {
        let at = |v: usize| part.sheet.mesh().positions()[v];
        let is_round = |edge: &&Edge| {
            let ends = [edge.run[0], edge.run[edge.run.len() - 1]].map(at);
            ends[0].distance(ends[1]) <= SAME_SHARE * edge.length_space_mm
        };
        let free = part.edges.iter().filter(|edge| edge.mates.is_empty()).filter(is_round);
        found.extend(free.map(|edge| (part, edge)));
    }
    found.sort_by(|a, b| b.1.length_space_mm.total_cmp(&a.1.length_space_mm));
    found.truncate(MOST_OPENINGS);
    let width = |(part, edge): (&Part, &Edge)| {
        let points: Vec<Point3> =
            edge.run.iter().map(|&v| part.sheet.mesh().positions()[v]).collect();
        let points = thinned(points);
        let [a, b] = farthest(&points, |p: &Point3, q| p.distance(*q))?;
        Some((format!("{}/{}", part.name, edge.name), points[a].distance(points[b])))
    };
    found.into_iter().filter_map(width).collect()
}

/// The corners of all parts, each place once, by the first part that has it.
fn space_corners(made: &Made) -> Vec<SpaceCorner> {
    let all = || made.parts.iter().flat_map(|part| part.sheet.mesh().positions().iter().copied());
    let within = SAME_SHARE * sheetwright::boundary::size_of(all());
    let mut places: BTreeMap<[i64; 3], ()> = BTreeMap::new();
    let mut found = Vec::new();
    for part in &made.parts {
        for (vertex, mut edges) in edge_ends(part) {
            edges.dedup();
            let at = part.sheet.mesh().positions()[vertex];
            let square = [at.x, at.y, at.z].map(|x| (x / within.max(1e-9)).round() as i64);
            let neighbours =
                (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [i, j, k])));
            let is_taken = |way: [i64; 3]| {
                places.contains_key(&[0, 1, 2].map(|n| square[n].saturating_add(way[n])))
            };
            if !neighbours.into_iter().any(is_taken) {
                places.insert(square, ());
                let name = format!("{}: {}", part.name, edges.join(" / "));
                found.push(SpaceCorner { at, name });
            }
        }
    }
    found
}

/// The vertices of a part where edges end, and the names of those edges.
fn edge_ends(part: &Part) -> BTreeMap<usize, Vec<String>> {
    let mut ends: BTreeMap<usize, Vec<String>> = BTreeMap::new();
    for edge in part.edges.iter().filter(|edge| !edge.is_loop()) {
        for end in [edge.run.first(), edge.run.last()].into_iter().flatten() {
            let with = edge.mates.first().map_or(usize::MAX, |mate| mate.part);
            ends.entry(*end).or_default().push(edge_name(part, edge, with));
        }
    }
    ends
}

/// The two of a list that are farthest apart, the first of equals, in its order.
fn farthest<T>(list: &[T], apart: impl Fn(&T, &T) -> f64) -> Option<[usize; 2]> {
    let mut best: Option<(f64, [usize; 2])> = None;
    for (n, a) in list.iter().enumerate() {
        for (k, b) in list.iter().enumerate().skip(n + 1) {
            let distance = apart(a, b);
            if best.is_none_or(|(most, _)| distance > most * (1.0 + EQUAL)) {
                best = Some((distance, [n, k]));
            }
        }
    }
    best.map(|(_, pair)| pair)
}

fn thinned<T>(list: Vec<T>) -> Vec<T> {
    let every = list.len().div_ceil(MOST_CORNERS).max(1);
    list.into_iter().step_by(every).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright::math::Vec2;
    use sheetwright::pattern::{PathKind, PatternPath, Role};

    fn piece(corners: &[[f64; 2]]) -> Piece {
        let points = corners.iter().map(|&[x, y]| Point2::new(x, y)).collect();
        let outline =
            PatternPath { role: Role::Cut, kind: PathKind::Outline, points, closed: true };
        Piece {
            name: "side".to_owned(),
            paths: vec![outline],
            labels: Vec::new(),
            size: Vec2::ZERO,
            corner: Point2::default(),
            bends: Vec::new(),
            border: Vec::new(),
            is_folded: false,
        }
    }

    #[test]
    fn diagonals_cross() {
        let found = |corners: &[[f64; 2]]| diagonals(&far_corners(&piece(corners)));
        // Points in the middle of sides are no corners.
        let plate = found(&[[0., 0.], [2., 0.], [4., 0.], [4., 3.], [0., 3.]]);
        assert_eq!(plate, [("A–C".to_owned(), 5.0), ("B–D".to_owned(), 5.0)]);
        let triangle = found(&[[0., 0.], [4., 0.], [4., 3.]]);
        let lengths: Vec<f64> = triangle.iter().map(|(_, length)| *length).collect();
        assert_eq!(lengths, [4.0, 3.0, 5.0]);
        // Both diagonals, although the upper side is longer than they are.
        let boat = found(&[[1., 0.], [9., 0.], [14., 3.], [0., 3.]]);
        assert_eq!(boat.iter().map(|(name, _)| &name[..]).collect::<Vec<_>>(), ["A–C", "B–D"]);
        // Of a gore with two tips, the corners beside the line between them.
        let gore = found(&[[0., 0.], [5., -1.], [10., 0.], [5., 1.]]);
        assert_eq!(gore, [("A–C".to_owned(), 10.0), ("B–D".to_owned(), 2.0)]);
        assert!(found(&[]).is_empty());
    }

    #[test]
    fn the_farthest_pair_is_the_first_of_equals() {
        let list = [0.0, 5.0, 5.0, 0.0];
        assert_eq!(farthest(&list, |a: &f64, b| (a - b).abs()), Some([0, 1]));
        assert_eq!(farthest(&list[..1], |a, b| (a - b).abs()), None);
    }
}
