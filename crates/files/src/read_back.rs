//! Reads the outline, the holes and the rungs back from a written pattern, by the positions of its
//! lines.

use crate::preset::Layer;
use crate::shapes::{FileLine, Form};
use sheetwright::math::Point2;
use sheetwright::predicate::{Box2, orientation, signed_area_doubled};
use sheetwright::rung::Rung;
use std::cmp::Ordering;
use std::fmt;

/// The most bytes of a file: a hundred times the pattern of 10,000 samples.
pub(crate) const MAX_BYTES: usize = 256 << 20;
/// The end of a rung lies on a point of the outline if it is nearer than this share of the size
/// of the outline. The files give both in the same digits; this is for rounding alone.
const SAME_POINT: f64 = 1e-11;
/// A notch begins on the edge if it is nearer than this share of the size of the outline.
const ON_LINE: f64 = 1e-9;

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
    /// The file is larger than 256 MiB.
    TooLarge,
    /// The file is no text in UTF-8.
    NotText,
    /// The file is no XML, with the parser's message.
    Xml(String),
    /// The file is no DXF of release 12 or 2000.
    Dxf {
        /// The line, from 1.
        line: usize,
        /// The problem at this line.
        problem: &'static str,
    },
    /// `width`, `height` and `viewBox` are missing or give different sizes of a unit.
    Units,
    /// A group or layer that is missing.
    Missing(&'static str),
    /// Something that a pattern does not have, such as a transform, a curve or another entity.
    Unexpected(String),
    /// The closed lines to cut, of this number, are no outline with holes: the largest must enclose
    /// all others, and they must run in its opposite direction.
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

/// A line of a file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ReadLine {
    /// The layer or the group that it is on.
    pub(crate) layer: &'static Layer,
    pub(crate) line: FileLine,
}

/// The lines of a file, not yet told apart into outline, holes and rungs.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Lines {
    /// The closed lines to cut, mm: the outline and the holes.
    pub(crate) cuts: Vec<Vec<Point2>>,
    /// The open lines to cut, mm: notches.
    pub(crate) slits: Vec<Vec<Point2>>,
    /// The outline and the holes of the finished piece, where the cut lies off them, mm.
    pub(crate) net: Vec<Vec<Point2>>,
    /// The segments that may be rungs, mm.
    pub(crate) segments: Vec<[Point2; 2]>,
}

impl Lines {
    /// The lines of a file by their layers and how they run. Circles are drilled holes.
    pub(crate) fn of_layers(read: Vec<ReadLine>) -> Self {
        let mut lines = Self::default();
        for ReadLine { layer, line } in read {
            match (line.form, &line.points[..]) {
                (Form::Closed, _) if layer.is_cut() => lines.cuts.push(line.points),
                (Form::Closed, _) if layer.is_optional() => lines.net.push(line.points),
                (Form::Open, _) if layer.is_cut() => lines.slits.push(line.points),
                (Form::Open, &[from, to]) => lines.segments.push([from, to]),
                _ => {}
            }
        }
        lines
    }

    /// The outline and the holes of the finished piece, as lines to cut, and the segments that may
    /// be its rungs.
    fn checked(self) -> Result<Self, PatternReadError> {
        let lines = self.cuts.iter().chain(&self.slits).chain(&self.net).flatten();
        let mut points = lines.chain(self.segments.iter().flatten());
        if !points.all(|p| p.x.is_finite() && p.y.is_finite()) {
            return Err(PatternReadError::NotFinite);
        }
        let off_the_edge = |slit: &&Vec<Point2>| !self.cuts.iter().any(|cut| begins_on(slit, cut));
        if self.slits.iter().find(off_the_edge).is_some() {
            return Err(PatternReadError::Unexpected(
                "open line to cut that begins on no closed one".to_owned(),
            ));
        }
        let cuts = if self.net.is_empty() { self.cuts } else { self.net };
        Ok(Self { cuts, segments: self.segments, ..Self::default() })
    }
}

/// Whether an end of an open line lies on a closed one.
fn begins_on(open: &[Point2], closed: &[Point2]) -> bool {
    let (Some(around), Some(first), Some(last)) =
        (Box2::of_points(closed.iter().copied()), open.first(), open.last())
    else {
        return false;
    };
    let near_mm = ON_LINE * around.min.distance(around.max);
    let edges = || closed.iter().zip(closed.iter().cycle().skip(1));
    [first, last]
        .into_iter()
        .any(|&end| edges().any(|(&a, &b)| end.distance_to_segment([a, b]) <= near_mm))
}

/// The pattern of some lines. A segment is a rung if both its ends lie on corners of the outline;
/// dimensions and letters lie elsewhere.
pub(crate) fn pattern(lines: Lines) -> Result<ReadPattern, PatternReadError> {
    let Lines { mut cuts, mut segments, .. } = lines.checked()?;
    let count = cuts.len();
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
            // A fold along an edge runs between neighbours, which no rung joins.
            (a != b && !corners.beside[a].contains(&b)).then(|| Rung::new(a, b))
        })
        .collect();
    rungs.sort_unstable();
    rungs.dedup();
    let outline = cuts.remove(0);
    Ok(ReadPattern { outline, holes: cuts, rungs })
}

/// The pattern of some lines that is known to overlap itself. A hole may then run in either
/// direction and leave the outline, and corners may coincide, so the lines alone do not tell
/// outline, holes and rungs apart. Takes the outline and the holes in the order of the file, moved
/// so that the box around all of them has its lower left corner at that of `laid`. Returns those of
/// the `wanted` rungs, by numbers of corners, that a segment draws.
pub(crate) fn overlapping_pattern(
    lines: Lines,
    laid: &[Point2],
    wanted: &[Rung],
) -> Result<ReadPattern, PatternReadError> {
    let Lines { cuts: mut loops, mut segments, .. } = lines.checked()?;
    let read = Box2::of_points(loops.iter().flatten().copied());
    let around = read.zip(Box2::of_points(laid.iter().copied()));
    let Some((read, laid)) = around else {
        return Err(PatternReadError::Outlines(loops.len()));
    };
    let to_laid = laid.min - read.min;
    for point in loops.iter_mut().flatten().chain(segments.iter_mut().flatten()) {
        *point = *point + to_laid;
    }
    let corners = loops.concat();
    let near_mm = SAME_POINT * laid.min.distance(laid.max);
    let ends = segments.iter().flat_map(|&[a, b]| [[a, b], [b, a]]);
    let mut by_x: Vec<[Point2; 2]> = ends.collect();
    by_x.sort_by(|a, b| a[0].x.total_cmp(&b[0].x));
    let is_drawn = |rung: &&Rung| {
        let [Some(&from), Some(&to)] = rung.ends().map(|sample| corners.get(sample.get())) else {
            return false;
        };
        let first = by_x.partition_point(|segment| segment[0].x < from.x - near_mm);
        by_x[first..]
            .iter()
            .take_while(|segment| segment[0].x <= from.x + near_mm)
            .any(|[a, b]| a.distance(from) <= near_mm && b.distance(to) <= near_mm)
    };
    let rungs = wanted.iter().filter(is_drawn).copied().collect();
    let outline = loops.remove(0);
    Ok(ReadPattern { outline, holes: loops, rungs })
}

/// The corners of closed lines, searchable by position.
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

    /// The corner at `point`. If several coincide there, as on the sides of a cut, the first from
    /// which the segment `to` the other end starts inside the outline.
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

    /// Whether the segment from corner `i` to a point starts inside, which is left of the corner's
    /// line: outlines run counter-clockwise, holes clockwise.
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
        let read = pattern(Lines { cuts: vec![outline], segments, ..Lines::default() }).unwrap();
        assert_eq!(read.rungs, [Rung::new(0, 2)]);
        assert_eq!(read.outline[0], Point2::default());
    }

    #[test]
    fn the_finished_piece_is_the_net_and_notches_begin_on_the_cut() {
        let square =
            |low: f64, high: f64| points(&[(low, low), (high, low), (high, high), (low, high)]);
        let slit = points(&[(-1.0, 1.0), (0.5, 1.0)]);
        let lines = Lines {
            cuts: vec![square(-1.0, 5.0), square(1.0, 1.1)],
            slits: vec![slit],
            net: vec![square(0.0, 4.0)],
            segments: vec![[Point2::new(0.0, 0.0), Point2::new(4.0, 4.0)]],
        };
        let read = pattern(lines.clone()).unwrap();
        assert_eq!((&read.outline, read.holes.len()), (&square(0.0, 4.0), 0));
        assert_eq!(read.rungs, [Rung::new(0, 2)]);
        let astray = Lines { slits: vec![points(&[(2.0, 2.0), (3.0, 2.0)])], ..lines };
        assert!(matches!(pattern(astray), Err(PatternReadError::Unexpected(_))));
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
        let lines = Lines { cuts: vec![outline.clone()], segments, ..Lines::default() };
        let read = pattern(lines).unwrap();
        let expected = [Rung::new(0, 10), Rung::new(1, 11), Rung::new(4, 6), Rung::new(5, 7)];
        assert_eq!(read.rungs, expected);
    }

    #[test]
    fn one_outline_is_wanted() {
        let of = |cuts: Vec<Vec<Point2>>| pattern(Lines { cuts, ..Lines::default() });
        assert_eq!(of(vec![]), Err(PatternReadError::Outlines(0)));
        let square = points(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]);
        assert_eq!(of(vec![square.clone(), square]), Err(PatternReadError::Outlines(2)));
        let nowhere = points(&[(0.0, 0.0), (f64::NAN, 0.0), (0.0, 1.0)]);
        assert_eq!(of(vec![nowhere]), Err(PatternReadError::NotFinite));
    }

    #[test]
    fn where_a_pattern_overlaps_its_lines_are_what_was_laid() {
        // A hole that runs as the outline does, with two of its corners on corners of the outline.
        let outline = points(&[(0.0, 0.0), (6.0, 0.0), (6.0, 6.0), (0.0, 6.0)]);
        let hole = points(&[(0.0, 0.0), (2.0, 1.0), (6.0, 6.0), (-3.0, 7.0)]);
        let laid: Vec<Point2> = outline.iter().chain(&hole).copied().collect();
        let away = Point2::new(40.0, 30.0).to_vec();
        let moved = |line: &[Point2]| line.iter().map(|&p| p + away).collect::<Vec<Point2>>();
        let segments = vec![[laid[1], laid[5]], [laid[5], laid[2]]];
        let segments = segments.into_iter().map(|ends| ends.map(|p| p + away)).collect();
        let cuts = vec![moved(&outline), moved(&hole)];
        let lines = Lines { cuts, segments, ..Lines::default() };
        assert_eq!(pattern(lines.clone()), Err(PatternReadError::Outlines(2)));
        let wanted = [Rung::new(1, 5), Rung::new(2, 4), Rung::new(5, 6)];
        let read = overlapping_pattern(lines, &laid, &wanted).unwrap();
        assert_eq!(read.points(), laid);
        assert_eq!(read.rungs, [wanted[0], wanted[2]], "the second is not drawn");
        let none = overlapping_pattern(Lines::default(), &laid, &wanted);
        assert_eq!(none, Err(PatternReadError::Outlines(0)));
    }
}
