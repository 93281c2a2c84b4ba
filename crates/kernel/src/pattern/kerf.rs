//! The line that a beam, a jet or a mill follows so that the piece keeps its size: half of the
//! cut's width outside the outline and inside holes.

use super::{PathKind, PatternPath, Piece, Role};
use sheetwright_geometry::math::{Point2, Vec2};
use sheetwright_geometry::offset::grown;

/// A hole or a gap that is no wider than the cut, so that the cut can't follow it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TooNarrow {
    /// A hole.
    Hole,
    /// A round hole.
    Drill,
    /// A gap between two sides of the outline or of a hole.
    Gap,
}

impl Piece {
    /// The piece as a machine follows it whose cut is so wide, mm: its outline lies half of that
    /// outside, and its holes lie inside. Open cuts, folds, marks and texts stay.
    ///
    /// # Errors
    /// What is too narrow for the cut: the outline would close over it.
    pub fn with_kerf(&self, kerf_mm: f64) -> Result<Self, TooNarrow> {
        let lines: Vec<Vec<Point2>> = self.loops().map(<[Point2]>::to_vec).collect();
        let regions = grown(&lines, 0.5 * kerf_mm);
        let [region] = &regions[..] else { return Err(TooNarrow::Gap) };
        match region.holes.len() + 1 {
            loops if loops < lines.len() => return Err(TooNarrow::Hole),
            loops if loops > lines.len() => return Err(TooNarrow::Gap),
            _ => {}
        }
        let mut paths = Vec::with_capacity(self.paths.len());
        let mut holes = region.holes.iter();
        for path in &self.paths {
            let points = match path.kind {
                PathKind::Outline => region.outline.clone(),
                PathKind::Hole => holes.next().ok_or(TooNarrow::Hole)?.clone(),
                PathKind::Drill { diameter_mm } => {
                    paths.push(drill(path, diameter_mm, kerf_mm).ok_or(TooNarrow::Drill)?);
                    continue;
                }
                _ => path.points.clone(),
            };
            paths.push(PatternPath { points, ..path.clone() });
        }
        let half = Vec2::splat(0.5 * kerf_mm);
        let (size, corner) = (self.size + half * 2.0, self.corner + -half);
        Ok(Self { paths, size, corner, ..self.clone() })
    }
}

/// A round hole that the cut leaves as wide as it is to be; `None` if the cut is as wide.
fn drill(path: &PatternPath, diameter_mm: f64, kerf_mm: f64) -> Option<PatternPath> {
    let narrower_mm = diameter_mm - kerf_mm;
    if narrower_mm <= 0.0 {
        return None;
    }
    let count = path.points.len() as f64;
    let sum = path.points.iter().fold(Vec2::ZERO, |sum, p| sum + p.to_vec());
    let middle = Point2::default() + sum / count;
    let scale = narrower_mm / diameter_mm;
    let points = path.points.iter().map(|&p| middle + (p - middle) * scale).collect();
    let kind = PathKind::Drill { diameter_mm: narrower_mm };
    Some(PatternPath { role: Role::Drill, kind, points, closed: true })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(at: f64, side: f64) -> Vec<Point2> {
        let corner = |x: f64, y: f64| Point2::new(at + x * side, at + y * side);
        vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)]
    }

    fn piece(hole_mm: f64, drill_mm: f64) -> Piece {
        let path =
            |role, kind, points: Vec<Point2>| PatternPath { role, kind, points, closed: true };
        let turned = |line: Vec<Point2>| line.into_iter().rev().collect::<Vec<_>>();
        let mut piece = Piece::undrawn("plate");
        let drill = PathKind::Drill { diameter_mm: drill_mm };
        piece.paths = vec![
            path(Role::Cut, PathKind::Outline, square(0.0, 100.0)),
            path(Role::Inner, PathKind::Hole, turned(square(20.0, hole_mm))),
            path(Role::Drill, drill, turned(square(70.0, drill_mm))),
        ];
        piece.size = Vec2::splat(100.0);
        piece
    }

    #[test]
    fn the_cut_lies_half_a_kerf_beside_the_piece() {
        let piece = piece(10.0, 3.0).with_kerf(0.2).unwrap();
        let ends = |n: usize| {
            let points = &piece.paths[n].points;
            let x = |p: &Point2| p.x;
            let least = points.iter().map(x).fold(f64::INFINITY, f64::min);
            [least, points.iter().map(x).fold(f64::NEG_INFINITY, f64::max)]
        };
        let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) < 1e-8;
        assert!(near(ends(0), [-0.1, 100.1]), "{:?}", ends(0));
        assert!(near(ends(1), [20.1, 29.9]), "{:?}", ends(1));
        assert!(near(ends(2), [70.1, 72.9]), "{:?}", ends(2));
        assert!((piece.size - Vec2::splat(100.2)).length() < 1e-12);
    }

    #[test]
    fn what_is_narrower_than_the_cut_is_said() {
        assert_eq!(piece(0.2, 3.0).with_kerf(0.2), Err(TooNarrow::Hole));
        assert_eq!(piece(10.0, 0.2).with_kerf(0.2), Err(TooNarrow::Drill));
        let mut slit = piece(10.0, 3.0);
        // From the middle of the lower side upwards, and wider inside.
        let keyhole = [(49.9, 0.0), (49.9, 10.0), (40.0, 10.0), (40.0, 15.0), (60.0, 15.0)];
        let back = [(60.0, 10.0), (50.05, 10.0), (50.05, 0.0)];
        let points = keyhole.into_iter().chain(back).map(|(x, y)| Point2::new(x, y));
        slit.paths[0].points.splice(1..1, points);
        assert_eq!(slit.with_kerf(0.2), Err(TooNarrow::Gap));
        assert!(slit.with_kerf(0.1).is_ok());
    }
}
