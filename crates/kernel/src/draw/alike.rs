//! Which pieces of a pattern are equal parts, so that one drawing serves for all.
//!
//! Two outlines are compared about the means of their corners. A rotation, with or without a
//! mirror, keeps each corner's distance from there. So a corner of the second outline can match the
//! first corner of the first outline only if the sequences of distances agree from there on. For
//! each such corner, the rotation is found by least squares, and every corner must then lie on its
//! partner. Holes and scored lines must match, too.

use crate::pattern::{PathKind, Piece, Role};
use sheetwright_geometry::math::{Point2, Vec2};

/// A motion of the plane: points about `from` are mirrored if `is_mirror`, turned, and moved to
/// `to`.
struct Motion {
    from: Vec2,
    to: Vec2,
    is_mirror: bool,
    /// Cosine and sine of the turn.
    turn: Vec2,
}

impl Motion {
    fn moved(&self, p: Point2) -> Point2 {
        let way = p.to_vec() - self.from;
        let way = if self.is_mirror { Vec2::new(way.x, -way.y) } else { way };
        Point2::default() + (self.to + self.turn * way.x + self.turn.perp() * way.y)
    }
}

/// Whether two pieces are equal parts, maybe turned over: a motion brings every corner of a cut or
/// scored line of the one within `within_mm` of one of the other. Pieces whose outlines have
/// different numbers of corners are not equal.
pub fn alike(a: &Piece, b: &Piece, within_mm: f64) -> bool {
    let (of_a, of_b) = (a.outline(), b.outline());
    let size = |piece: &Piece| {
        let size = piece.size;
        [size.x.max(size.y), size.x.min(size.y)]
    };
    let differs = |(a, b): (f64, f64)| (a - b).abs() > 2.0 * within_mm;
    if of_a.len() != of_b.len() || of_a.len() < 3 || size(a).into_iter().zip(size(b)).any(differs) {
        return false;
    }
    let (rest_a, rest_b) = (rest(a), rest(b));
    rest_a.len() == rest_b.len()
        && [false, true].into_iter().any(|is_mirror| {
            motions(of_a, of_b, is_mirror, within_mm).any(|motion| {
                rest_a.iter().all(|&(role, p)| {
                    let to = motion.moved(p);
                    let is_there =
                        |&(other, q): &(Role, Point2)| other == role && q.distance(to) <= within_mm;
                    rest_b.iter().any(is_there)
                })
            })
        })
}

/// The corners of cut and scored lines besides the outline.
fn rest(piece: &Piece) -> Vec<(Role, Point2)> {
    let counts = |role: Role| role.is_cut() || role == Role::Score;
    let paths = piece.paths.iter().filter(|p| p.kind != PathKind::Outline && counts(p.role));
    paths.flat_map(|path| path.points.iter().map(|&p| (path.role, p))).collect()
}

/// The motions that bring each corner of one outline on one of another.
fn motions(
    a: &[Point2],
    b: &[Point2],
    is_mirror: bool,
    within_mm: f64,
) -> impl Iterator<Item = Motion> {
    let m = a.len();
    let mean = |points: &[Point2]| {
        points.iter().map(|p| p.to_vec()).sum::<Vec2>() * (1.0 / points.len() as f64)
    };
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
        let motion = Motion { from, to, is_mirror, turn };
        let off = |(a, b): (Vec2, Vec2)| (turn * a.x + turn.perp() * a.y - b).length();
        (turn.is_finite() && pairs().all(|pair| off(pair) <= within_mm)).then_some(motion)
    })
}
