//! The curves that the samples of a boundary were taken from, walked by arc length.
//!
//! A boundary holds samples and their tangents only. An outline holds, for every edge, the pieces
//! of curve from its sample to the next, so that a vertex may slide along the boundary without
//! leaving it. Where no curve is known (the loops are samples themselves, joined panels, rails that
//! ran on), the piece is the cubic with the tangents of both samples, straight where the edge is.

use super::Boundary;
use crate::curve::{Cubic, length, parameter_at};
use crate::math::{Point3, Vec3};
use std::ops::Range;

/// Closed curves through the samples of a boundary, loop after loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    loops: Vec<Ring>,
    /// The arc length at which each sample lies on its loop, mm; 0 for the first of a loop.
    samples: Vec<f64>,
}

/// One closed curve.
#[derive(Clone, Debug, PartialEq)]
struct Ring {
    pieces: Vec<Cubic>,
    /// The arc length from the first sample to the end of each piece, mm.
    ends: Vec<f64>,
}

/// A place on a closed curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnOutline {
    /// Where it is, mm.
    pub position: Point3,
    /// The unit tangent; at a corner the one on the chosen side.
    pub tangent: Vec3,
}

/// Which of two tangents is wanted at a corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The one with which the curve arrives.
    Arriving,
    /// The one with which it leaves.
    Leaving,
}

impl Outline {
    /// The outline of a boundary of which only the samples are known: from each to the next the
    /// cubic with their tangents, whose derivatives at both ends are as long as the chord.
    pub fn through(boundary: &Boundary) -> Self {
        Self::new(boundary, (0..boundary.len()).map(|i| vec![between(boundary, i)]))
    }

    /// The outline whose pieces from each sample to the next are given. Pieces that miss the
    /// samples by up to `same_mm`, by rounding and chaining, are moved to begin and end there;
    /// those that miss them by more are not taken.
    pub fn from_pieces(
        boundary: &Boundary,
        same_mm: f64,
        pieces: impl Iterator<Item = Option<Vec<Cubic>>>,
    ) -> Self {
        let samples = boundary.samples();
        let fitted = pieces.enumerate().map(|(i, pieces)| {
            let ends = [i, boundary.next(i)].map(|n| samples[n].position);
            pieces
                .and_then(|pieces| fitted(pieces, ends, same_mm))
                .unwrap_or_else(|| vec![between(boundary, i)])
        });
        Self::new(boundary, fitted)
    }

    fn new(boundary: &Boundary, edges: impl Iterator<Item = Vec<Cubic>>) -> Self {
        let mut edges = edges;
        let mut samples = Vec::with_capacity(boundary.len());
        let loops = boundary.loops().iter().map(|range| {
            let mut ring = Ring { pieces: Vec::new(), ends: Vec::new() };
            let mut at = 0.0;
            for _ in range.clone() {
                samples.push(at);
                for piece in edges.next().unwrap_or_default() {
                    at += length(&piece, 0.0, 1.0);
                    ring.pieces.push(piece);
                    ring.ends.push(at);
                }
            }
            ring
        });
        let loops = loops.collect();
        Self { loops, samples }
    }

    /// The length of a closed curve, mm.
    pub fn length(&self, of_loop: usize) -> f64 {
        self.loops[of_loop].ends.last().copied().unwrap_or(0.0)
    }

    /// The arc length from the first sample of its loop to a sample, mm.
    pub fn of_sample(&self, sample: usize) -> f64 {
        self.samples[sample]
    }

    /// The place on a loop at an arc length of `along_mm` after its first sample; a length beyond
    /// the loop goes round again, a negative one goes back.
    pub fn at(&self, of_loop: usize, along_mm: f64, side: Side) -> OnOutline {
        let ring = &self.loops[of_loop];
        let (n, t) = ring.locate(along_mm, side);
        let piece = &ring.pieces[n];
        OnOutline { position: piece.position(t), tangent: piece.tangent(t) }
    }

    /// The smallest distance from a point to the curve between two places on a loop, mm.
    pub fn distance(&self, of_loop: usize, between_mm: Range<f64>, point: Point3) -> f64 {
        let ring = &self.loops[of_loop];
        let (first, _) = ring.locate(between_mm.start, Side::Leaving);
        let (last, _) = ring.locate(between_mm.end, Side::Arriving);
        let count = ring.pieces.len();
        let steps = (last + count - first) % count;
        let offs = (0..=steps).map(|step| {
            let piece = &ring.pieces[(first + step) % count];
            piece.position(piece.nearest(point)).distance(point)
        });
        offs.fold(f64::INFINITY, f64::min)
    }
}

impl Ring {
    /// The piece and its parameter at an arc length.
    fn locate(&self, along_mm: f64, side: Side) -> (usize, f64) {
        let (whole, last) = (self.ends[self.ends.len() - 1], self.ends.len() - 1);
        let mut along = along_mm.rem_euclid(whole);
        if side == Side::Arriving && along == 0.0 {
            along = whole;
        }
        let n = match side {
            Side::Leaving => self.ends.partition_point(|&end| end <= along),
            Side::Arriving => self.ends.partition_point(|&end| end < along),
        };
        let n = n.min(last);
        let start = if n == 0 { 0.0 } else { self.ends[n - 1] };
        (n, parameter_at(&self.pieces[n], along - start, self.ends[n] - start))
    }
}

/// The cubic from a sample to the next by their tangents.
fn between(boundary: &Boundary, i: usize) -> Cubic {
    boundary.samples()[i].cubic_to(&boundary.samples()[boundary.next(i)])
}

/// The pieces moved so that they begin and end at these points and hang together.
fn fitted(mut pieces: Vec<Cubic>, ends: [Point3; 2], same_mm: f64) -> Option<Vec<Cubic>> {
    let last = pieces.len().checked_sub(1)?;
    let misses = [pieces[0].control[0] - ends[0], pieces[last].control[3] - ends[1]];
    if misses.iter().any(|miss| miss.length() > same_mm) {
        return None;
    }
    for control in &mut pieces[0].control[..2] {
        *control += -misses[0];
    }
    for control in &mut pieces[last].control[2..] {
        *control += -misses[1];
    }
    pieces[0].control[0] = ends[0];
    pieces[last].control[3] = ends[1];
    // A piece without length has no direction.
    pieces.retain(|piece| length(piece, 0.0, 1.0) > 0.0);
    (!pieces.is_empty()).then_some(pieces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::samples_from_points;
    use crate::curve::CurvePoint;

    fn square() -> Boundary {
        let points = [[0., 0.], [4., 0.], [4., 4.], [0., 4.]]
            .map(|[x, y]| CurvePoint::corner(Point3::new(x, y, 0.0)));
        Boundary::new(vec![samples_from_points(&points)]).unwrap()
    }

    #[test]
    fn a_square_is_walked_round_and_keeps_both_tangents_of_its_corners() {
        let outline = Outline::through(&square());
        assert!((outline.length(0) - 16.0).abs() < 1e-12);
        assert_eq!(outline.of_sample(2), 8.0);
        for (along, x, y) in [(1.0, 1., 0.), (6.0, 4., 2.), (-1.0, 0., 1.), (17.0, 1., 0.)] {
            let place = outline.at(0, along, Side::Leaving);
            assert!(place.position.distance(Point3::new(x, y, 0.0)) < 1e-12, "{along}");
        }
        let both = [Side::Arriving, Side::Leaving].map(|side| outline.at(0, 0.0, side));
        assert_eq!(both.map(|b| b.position), [Point3::default(); 2]);
        assert!((both[0].tangent + Vec3::Y).length() < 1e-12);
        assert!((both[1].tangent - Vec3::X).length() < 1e-12);
        let off = outline.distance(0, 1.0..6.0, Point3::new(5.0, 1.0, 0.0));
        assert!((off - 1.0).abs() < 1e-12);
    }

    #[test]
    fn pieces_that_miss_the_samples_are_not_taken() {
        let p = |x: f64| Point3::new(x, 0.0, 0.0);
        let piece = Cubic::line(p(0.0), p(1.0));
        let fit = |ends| fitted(vec![piece], ends, 1e-6);
        let moved = fit([p(1e-7), p(1.0)]).unwrap();
        assert_eq!((moved[0].position(0.0), moved[0].position(1.0)), (p(1e-7), p(1.0)));
        assert_eq!(fit([p(1e-3), p(1.0)]), None);
        assert_eq!(fitted(Vec::new(), [p(0.0), p(1.0)], 1.0), None);
    }
}
