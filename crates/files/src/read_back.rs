//! What is read back from a written pattern: the outline, the holes and the rungs, by where their
//! lines lie.

use sheetwright::math::Point2;
use sheetwright::predicate::{Box2, orientation, signed_area_doubled};
use sheetwright::rung::Rung;
use std::cmp::Ordering;
use std::fmt;

/// Larger files than this are not read, bytes: a hundred times the pattern of 10,000 samples.
pub(crate) const MAX_BYTES: usize = 256 << 20;
/// The end of a rung lies on a point of the outline if it is nearer than this share of the size
/// of the outline. The files give both in the same digits; this is for rounding alone.
const SAME_POINT: f64 = 1e-11;

/// The flat pattern that a file holds.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadPattern {
    /// The corners of the outline in the order of the file, mm, y upwards, moved so that the lower
    /// left corner of the box around them is the origin.
    pub outline: Vec<Point2>,
    /// The corners of each hole, in the order of the file, mm.
    pub holes: Vec<Vec<Point2>>,
    /// The rungs, by the numbers of the corners that they join, counted through the outline and the
    /// holes; in increasing order.
    pub rungs: Vec<Rung>,
}

impl ReadPattern {
    /// The corners of the outline and then of the holes, mm.
    pub fn points(&self) -> Vec<Point2> {
        self.outline.iter().chain(self.holes.iter().flatten()).copied().collect()
    }
}

/// Why a file is no pattern.
#[derive(Clone, Debug, PartialEq)]
pub enum PatternReadError {
    /// More bytes than a pattern has.
    TooLarge,
    /// No text in UTF-8.
    NotText,
    /// No XML, and what the parser says of it.
    Xml(String),
    /// No DXF of release 12: the line and what is wrong there.
    Dxf {
        /// The line, from 1.
        line: usize,
        /// What is wrong.
        problem: &'static str,
    },
    /// A width, height and view box that do not agree on the size of a unit, or no such size.
    Units,
    /// A group or layer that is missing.
    Missing(&'static str),
    /// Something that a pattern does not have, such as a transform, a curve or another entity.
    Unexpected(String),
    /// So many closed lines to cut, of which none encloses all others and they run its other way
    /// round.
    Outlines(usize),
    /// A coordinate that is not finite.
    NotFinite,
}

impl fmt::Display for PatternReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLarge => write!(f, "the file is larger than {} MiB", MAX_BYTES >> 20),
            Self::NotText => write!(f, "the file is no text in UTF-8"),
            Self::Xml(problem) => write!(f, "the file is no XML: {problem}"),
            Self::Dxf { line, problem } => write!(f, "line {line}: {problem}"),
            Self::Units => write!(f, "width, height and viewBox give no size in millimetres"),
            Self::Missing(name) => write!(f, "there is no '{name}'"),
            Self::Unexpected(what) => write!(f, "a pattern has no {what}"),
            Self::Outlines(count) => {
                write!(f, "the {count} closed lines on 'cut' are no outline with holes")
            }
            Self::NotFinite => write!(f, "a coordinate is not a finite number"),
        }
    }
}

impl std::error::Error for PatternReadError {}

/// The pattern of the closed lines to cut and of the segments that may be rungs. A segment is a
/// rung if both its ends lie on corners of the outline; dimensions and letters lie elsewhere.
pub(crate) fn pattern(
    mut cuts: Vec<Vec<Point2>>,
    mut segments: Vec<[Point2; 2]>,
) -> Result<ReadPattern, PatternReadError> {
    let count = cuts.len();
    let finite = |p: &Point2| p.x.is_finite() && p.y.is_finite();
    if !cuts.iter().flatten().chain(segments.iter().flatten()).all(finite) {
        return Err(PatternReadError::NotFinite);
    }
    let area = |line: &Vec<Point2>| signed_area_doubled(line);
    let largest = (0..count)
        .max_by(|&a, &b| area(&cuts[a]).abs().total_cmp(&area(&cuts[b]).abs()).then(b.cmp(&a)));
    let around = largest
        .and_then(|largest| Box2::of_points(cuts[largest].iter().copied()).zip(Some(largest)));
    let Some((around, largest)) = around else { return Err(PatternReadError::Outlines(count)) };
    let outline = cuts.remove(largest);
    let is_hole = |line: &Vec<Point2>| {
        let within = |p: &Point2| {
            (around.min.x..=around.max.x).contains(&p.x)
                && (around.min.y..=around.max.y).contains(&p.y)
        };
        line.iter().all(within) && (area(line) < 0.0) == (area(&outline) > 0.0)
    };
    if !cuts.iter().all(is_hole) {
        return Err(PatternReadError::Outlines(count));
    }
    cuts.insert(0, outline);
    let to_origin = -around.min.to_vec();
    for point in cuts.iter_mut().flatten().chain(segments.iter_mut().flatten()) {
        *point = *point + to_origin;
    }
    let corners = Corners::new(&cuts, SAME_POINT * around.min.distance(around.max));
    let mut rungs: Vec<Rung> = segments
        .iter()
        .filter_map(|&[from, to]| {
            let (a, b) = (corners.at(from, to)?, corners.at(to, from)?);
            (a != b).then(|| Rung::new(a, b))
        })
        .collect();
    rungs.sort_unstable();
    rungs.dedup();
    let outline = cuts.remove(0);
    Ok(ReadPattern { outline, holes: cuts, rungs })
}

/// The corners of closed lines, found by where they lie.
struct Corners {
    points: Vec<Point2>,
    /// The numbers of the corners before and after each on its line.
    beside: Vec<[usize; 2]>,
    /// The numbers of the corners by increasing x.
    by_x: Vec<usize>,
    near_mm: f64,
}

impl Corners {
    fn new(lines: &[Vec<Point2>], near_mm: f64) -> Self {
        let points: Vec<Point2> = lines.iter().flatten().copied().collect();
        let mut beside = Vec::with_capacity(points.len());
        for line in lines {
            let (start, m) = (beside.len(), line.len());
            beside.extend((0..m).map(|i| [start + (i + m - 1) % m, start + (i + 1) % m]));
        }
        let mut by_x: Vec<usize> = (0..points.len()).collect();
        by_x.sort_by(|&i, &j| points[i].x.total_cmp(&points[j].x).then(i.cmp(&j)));
        Self { points, beside, by_x, near_mm }
    }

    /// The corner that lies at `point`. Where the sides of a cut lie on one another, several do:
    /// then the first from which the way `to` the other end starts inside the outline.
    fn at(&self, point: Point2, to: Point2) -> Option<usize> {
        let first = self.by_x.partition_point(|&i| self.points[i].x < point.x - self.near_mm);
        let near: Vec<usize> = self.by_x[first..]
            .iter()
            .copied()
            .take_while(|&i| self.points[i].x <= point.x + self.near_mm)
            .filter(|&i| self.points[i].distance(point) <= self.near_mm)
            .collect();
        match near[..] {
            [] => None,
            [only] => Some(only),
            _ => near.iter().copied().find(|&i| self.inside(i, to)).or(Some(near[0])),
        }
    }

    /// Whether the way from corner `i` to a point starts inside: to the left of its line, as of an
    /// outline that runs counter-clockwise and of a hole that runs clockwise.
    fn inside(&self, i: usize, to: Point2) -> bool {
        let [previous, next] = self.beside[i].map(|k| self.points[k]);
        let at = self.points[i];
        let left_of_next = orientation(at, next, to) == Ordering::Greater;
        let right_of_previous = orientation(at, previous, to) == Ordering::Less;
        if orientation(at, next, previous) == Ordering::Greater {
            left_of_next && right_of_previous
        } else {
            left_of_next || right_of_previous
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<Point2> {
        list.iter().map(|&(x, y)| Point2::new(x, y)).collect()
    }

    #[test]
    fn segments_between_corners_are_rungs_and_others_are_not() {
        let outline = points(&[(1.0, 2.0), (5.0, 2.0), (5.0, 4.0), (1.0, 4.0)]);
        let segment = |a: (f64, f64), b: (f64, f64)| [a, b].map(|(x, y)| Point2::new(x, y));
        let segments = vec![segment((5.0, 4.0), (1.0, 2.0)), segment((1.0, 4.0), (5.0, 2.5))];
        let read = pattern(vec![outline], segments).unwrap();
        assert_eq!(read.rungs, [Rung::new(0, 2)]);
        assert_eq!(read.outline[0], Point2::default());
    }

    #[test]
    fn the_two_sides_of_a_cut_are_told_apart() {
        // A square ring, cut open below: corners 0 and 9 lie on one another, and so do 4 and 5.
        let outline = points(&[
            (0.0, -3.0),
            (3.0, -3.0),
            (3.0, 3.0),
            (-3.0, 3.0),
            (-3.0, -3.0),
            (0.0, -3.0),
            (0.0, -1.0),
            (-1.0, -1.0),
            (-1.0, 1.0),
            (1.0, 1.0),
            (1.0, -1.0),
            (0.0, -1.0),
        ]);
        let at = |i: usize| outline[i];
        let segments = vec![[at(0), at(10)], [at(5), at(7)], [at(11), at(1)], [at(6), at(4)]];
        let read = pattern(vec![outline.clone()], segments).unwrap();
        let expected = [Rung::new(0, 10), Rung::new(1, 11), Rung::new(4, 6), Rung::new(5, 7)];
        assert_eq!(read.rungs, expected);
    }

    #[test]
    fn one_outline_is_wanted() {
        assert_eq!(pattern(vec![], vec![]), Err(PatternReadError::Outlines(0)));
        let square = points(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]);
        let two = pattern(vec![square.clone(), square], vec![]);
        assert_eq!(two, Err(PatternReadError::Outlines(2)));
        let nowhere = points(&[(0.0, 0.0), (f64::NAN, 0.0), (0.0, 1.0)]);
        assert_eq!(pattern(vec![nowhere], vec![]), Err(PatternReadError::NotFinite));
    }
}
