//! Which pieces of a pattern are equal parts, so that one drawing serves for all.
//!
//! Two outlines are compared about the means of their corners. A rotation, with or without a
//! mirror, keeps each corner's distance from there. So a corner of the second outline can match the
//! first corner of the first outline only if the sequences of distances agree from there on. For
//! each such corner, the rotation is found by least squares, and every corner must then lie on its
//! partner. So must everything else that is done to the sheet: holes, folds, notches, ticks. Names
//! and lengths may differ; what a trim or a mark writes may not. Nor may the marks of joints on the
//! pieces of nets, which alone say where a piece goes; and no such piece serves turned over, since
//! its mountains would be valleys.
//!
//! Equal outlines may still be bent to different shapes, so their borders in space are compared,
//! too, corner by corner. Bend lines are not: where one border has two equally good surfaces, such
//! as one and its mirror image, either serves.

use super::seam::is_joint_mark;
use super::settle::tick_of;
use super::{LabelKind, PathKind, PatternLabel, PatternPath, Piece, Role};
use sheetwright_geometry::math::{Point2, Point3, Vec2, Vec3, unit};

/// Pieces this near to one another in every corner are equal, mm; less for small ones, as a share
/// of their longer side.
const ALIKE_MM: f64 = 0.05;
const ALIKE_SHARE: f64 = 1e-4;
/// In space, corners may lie apart by this many times as much, since three of them place the rest.
const IN_SPACE: f64 = 4.0;

/// A piece among equal ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EqualPiece {
    /// Its number among all pieces.
    pub number: usize,
    /// Whether it is the first of them turned over.
    pub mirrored: bool,
    /// The largest distance of a corner from that of the first, laid on it, mm.
    pub off_mm: f64,
}

/// The pieces in groups of equal ones, each in the order of the pieces, by its first.
pub fn equal_pieces<'a>(pieces: impl IntoIterator<Item = &'a Piece>) -> Vec<Vec<EqualPiece>> {
    let mut groups: Vec<(&Piece, Vec<EqualPiece>)> = Vec::new();
    for (number, piece) in pieces.into_iter().enumerate() {
        let within_mm = ALIKE_MM.min(ALIKE_SHARE * piece.size.max_element());
        let equal = groups.iter_mut().find_map(|(first, group)| {
            let alike = alike(first, piece, within_mm)?;
            Some((group, EqualPiece { number, ..alike }))
        });
        match equal {
            Some((group, equal)) => group.push(equal),
            None => {
                groups.push((piece, vec![EqualPiece { number, mirrored: false, off_mm: 0.0 }]));
            }
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

/// A motion of the plane: points about `from` are mirrored if `is_mirror`, turned, and moved to
/// `to`.
struct Motion {
    from: Vec2,
    to: Vec2,
    is_mirror: bool,
    /// Cosine and sine of the turn.
    turn: Vec2,
    /// The corner of the second outline on which the first corner of the first one lies, and so on
    /// backwards if it is a mirror.
    first: usize,
    /// The largest distance of a corner from its partner, mm.
    off_mm: f64,
}

impl Motion {
    fn moved(&self, p: Point2) -> Point2 {
        let way = p.to_vec() - self.from;
        let way = if self.is_mirror { Vec2::new(way.x, -way.y) } else { way };
        Point2::default() + (self.to + self.turn * way.x + self.turn.perp() * way.y)
    }
}

/// How the second of two equal parts comes from the first: a motion brings everything that is done
/// to the sheet of the one within `within_mm` of that of the other. `None` where they differ, and
/// where their outlines have different numbers of corners.
pub fn alike(a: &Piece, b: &Piece, within_mm: f64) -> Option<EqualPiece> {
    let size = |piece: &Piece| {
        let size = piece.size;
        [size.x.max(size.y), size.x.min(size.y)]
    };
    let differs = |(a, b): (f64, f64)| (a - b).abs() > 2.0 * within_mm;
    if size(a).into_iter().zip(size(b)).any(differs) {
        return None;
    }
    let (of_a, of_b) = (a.net_loops().next()?, b.net_loops().next()?);
    if of_a.len() != of_b.len() || of_a.len() < 3 {
        return None;
    }
    let is_net = a.is_folded || b.is_folded;
    if is_net && joints(a) != joints(b) {
        return None;
    }
    let (spots_a, spots_b) = (spots(a), spots(b));
    let (lines_a, lines_b) = (lines(a), lines(b));
    if texts(a) != texts(b) || spots_a.len() != spots_b.len() || lines_a.len() != lines_b.len() {
        return None;
    }
    [false, true].into_iter().filter(|is_mirror| !(is_net && *is_mirror)).find_map(|is_mirror| {
        motions(of_a, of_b, is_mirror, within_mm).find_map(|motion| {
            let moved: Vec<Line> = lines_a.iter().map(|line| line.moved(&motion)).collect();
            let to_partner = |(done, p): &(Spot<'_>, Point2)| {
                let (to, partners) = (motion.moved(*p), spots_b.iter());
                let partners = partners.filter(|(other, _)| other == done);
                partners.map(|(_, q)| q.distance(to)).fold(f64::INFINITY, f64::min)
            };
            let off_mm = spots_a
                .iter()
                .map(to_partner)
                .chain(corners_off_mm(&moved, &lines_b))
                .chain(corners_off_mm(&lines_b, &moved))
                .try_fold(motion.off_mm, |worst, off| (off <= within_mm).then_some(worst.max(off)));
            let off_mm = off_mm.filter(|_| is_so_in_space(a, b, &motion, within_mm))?;
            Some(EqualPiece { number: 0, mirrored: is_mirror, off_mm })
        })
    })
}

/// A line along which something is done to the sheet.
struct Line {
    kind: PathKind,
    points: Vec<Point2>,
    closed: bool,
}

impl Line {
    fn moved(&self, motion: &Motion) -> Self {
        let points = self.points.iter().map(|&p| motion.moved(p)).collect();
        Self { points, ..*self }
    }

    fn distance(&self, p: Point2) -> f64 {
        let closing = self.points.last().zip(self.points.first()).filter(|_| self.closed);
        let steps = self.points.windows(2).map(|step| [step[0], step[1]]);
        let steps = steps.chain(closing.map(|(last, first)| [*last, *first]));
        steps.map(|step| p.distance_to_segment(step)).fold(f64::INFINITY, f64::min)
    }
}

/// The lines along which something is done to the sheet of a piece, besides cutting its net.
fn lines(piece: &Piece) -> Vec<Line> {
    let has_net = piece.has_net();
    let kind = |path: &PatternPath| match path.kind {
        PathKind::Outline if !has_net => None,
        PathKind::Dimension | PathKind::Leader | PathKind::SheetEdge | PathKind::Drill { .. } => {
            None
        }
        PathKind::Bend { .. } | PathKind::BendTick => None,
        // Rungs have their numbers, which depend on where the samples begin.
        PathKind::Rung(_) if path.role == Role::Score => Some(PathKind::Crease),
        PathKind::Rung(_) => None,
        kind => Some(kind),
    };
    let line = |path: &PatternPath| {
        Some(Line { kind: kind(path)?, points: path.points.clone(), closed: path.closed })
    };
    piece.paths.iter().filter_map(line).collect()
}

/// How far each corner of some lines lies from the nearest of others of its kind, mm. Lines that
/// were cleaned or cut to a length may have more corners or fewer.
fn corners_off_mm(lines: &[Line], others: &[Line]) -> impl Iterator<Item = f64> {
    lines.iter().flat_map(move |line| {
        line.points.iter().map(move |&p| {
            let others = others.iter().filter(|other| other.kind == line.kind);
            others.map(|other| other.distance(p)).fold(f64::INFINITY, f64::min)
        })
    })
}

/// The marks of its joints with other pieces, in order.
fn joints(piece: &Piece) -> Vec<&str> {
    let marks = piece.labels.iter().filter(|label| label.kind == LabelKind::Mark);
    let mut joints: Vec<&str> =
        marks.map(|label| &label.text[..]).filter(|mark| is_joint_mark(mark)).collect();
    joints.sort_unstable();
    joints
}

/// What marks on the face of a piece say, in order. Where they say it is where there is room.
fn texts(piece: &Piece) -> Vec<&str> {
    let of_marks = piece.labels.iter().filter(|label| label.kind == LabelKind::OnFace);
    let mut texts: Vec<&str> = of_marks.map(|label| &label.text[..]).collect();
    texts.sort_unstable();
    texts
}

/// What stands at a place: a drilled hole of this diameter, or a text of a trim.
#[derive(Clone, Copy, PartialEq)]
enum Spot<'a> {
    Drill(f64),
    Text(&'a str),
}

/// What stands at places of a piece, and where.
fn spots(piece: &Piece) -> Vec<(Spot<'_>, Point2)> {
    let holes = piece.paths.iter().filter_map(|path| match path.kind {
        PathKind::Drill { diameter_mm } => {
            Some((Spot::Drill(diameter_mm), Point2::default() + mean(&path.points)))
        }
        _ => None,
    });
    let texts = piece.labels.iter().filter(|label| label.kind == LabelKind::Trim);
    // A number stands beside its tick where there is room.
    let at = |label: &PatternLabel| tick_of(label, &piece.paths).unwrap_or(label.at);
    let texts = texts.map(|label| (Spot::Text(&label.text), at(label)));
    holes.chain(texts).collect()
}

/// The mean of some points.
fn mean(points: &[Point2]) -> Vec2 {
    points.iter().map(|p| p.to_vec()).sum::<Vec2>() * (1.0 / points.len() as f64)
}

/// The motions that bring each corner of one outline on one of another.
fn motions(
    a: &[Point2],
    b: &[Point2],
    is_mirror: bool,
    within_mm: f64,
) -> impl Iterator<Item = Motion> {
    let m = a.len();
    let (from, to) = (mean(a), mean(b));
    let ways_a: Vec<Vec2> = a
        .iter()
        .map(|p| p.to_vec() - from)
        .map(|way| if is_mirror { Vec2::new(way.x, -way.y) } else { way })
        .collect();
    let mut ways_b: Vec<Vec2> = b.iter().map(|p| p.to_vec() - to).collect();
    if is_mirror {
        // Both outlines run counter-clockwise; in a mirror, the other way.
        ways_b.reverse();
    }
    (0..m).filter_map(move |shift| {
        let pairs = || (0..m).map(|i| (ways_a[i], ways_b[(i + shift) % m]));
        if pairs().any(|(a, b)| (a.length() - b.length()).abs() > within_mm) {
            return None;
        }
        let sum: Vec2 = pairs().map(|(a, b)| Vec2::new(a.dot(b), a.perp_dot(b))).sum();
        let turn = sum * (1.0 / sum.length());
        let off = |(a, b): (Vec2, Vec2)| (turn * a.x + turn.perp() * a.y - b).length();
        let off_mm = pairs().map(off).fold(0.0, f64::max);
        let first = if is_mirror { m - 1 - shift } else { shift };
        let motion = Motion { from, to, is_mirror, turn, first, off_mm };
        (turn.is_finite() && off_mm <= within_mm).then_some(motion)
    })
}

/// Whether a motion in space, mirrored where that of the plane is, brings the border of the first
/// piece on that of the second. The outlines of the nets are compared: their corners are those of
/// the sheet.
fn is_so_in_space(a: &Piece, b: &Piece, motion: &Motion, within_mm: f64) -> bool {
    let (of_a, of_b) = (&a.border, &b.border);
    let m = of_a.len();
    if m != of_b.len() {
        return false;
    }
    let partner = |n: usize| {
        let on = if motion.is_mirror { motion.first + m - n } else { motion.first + n };
        of_b[on % m]
    };
    let Some(three) = spread(of_a) else { return true };
    let frames = Frame::new(three.map(|n| of_a[n]), false)
        .zip(Frame::new(three.map(partner), motion.is_mirror));
    let Some((from, to)) = frames else { return false };
    (0..m).all(|n| to.point(from.place(of_a[n])).distance(partner(n)) <= IN_SPACE * within_mm)
}

/// Three corners far from one another, by their numbers; `None` of a border on a line.
fn spread(border: &[Point3]) -> Option<[usize; 3]> {
    let farthest = |from: &dyn Fn(Point3) -> f64| {
        let of = |n: &usize| from(border[*n]);
        (0..border.len()).reduce(|best, n| if of(&n) > of(&best) { n } else { best })
    };
    let first = *border.first()?;
    let second = farthest(&|p| p.distance(first))?;
    let along = border[second] - first;
    let third = farthest(&|p| along.cross(p - first).length())?;
    (along.cross(border[third] - first).length() > 0.0).then_some([0, second, third])
}

/// A corner and three directions at right angles, the third turned about if it is a mirror.
struct Frame {
    origin: Point3,
    axes: [Vec3; 3],
}

impl Frame {
    fn new([a, b, c]: [Point3; 3], is_mirror: bool) -> Option<Self> {
        let x = unit(b - a)?;
        let z = unit(x.cross(c - a))?;
        let y = z.cross(x);
        Some(Self { origin: a, axes: [x, y, if is_mirror { -z } else { z }] })
    }

    fn place(&self, p: Point3) -> [f64; 3] {
        self.axes.map(|axis| axis.dot(p - self.origin))
    }

    fn point(&self, place: [f64; 3]) -> Point3 {
        let steps = self.axes.iter().zip(place).map(|(axis, along)| *axis * along);
        steps.fold(self.origin, |p, step| p + step)
    }
}
