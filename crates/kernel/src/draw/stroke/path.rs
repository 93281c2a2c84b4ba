//! A stroke as a polyline: its length, places on it, distances from it.

use super::StrokeError;
use sheetwright_geometry::curve::MAX_COORDINATE_MM;
use sheetwright_geometry::math::{Point2, Vec2};

/// Steps shorter than this share of the extent are dropped: they have no clear direction.
const SAME_SPOT: f64 = 1e-9;

/// The positions without those that repeat the one before.
pub(super) fn cleaned(positions: &[Point2], smallest_mm: f64) -> Result<Vec<Point2>, StrokeError> {
    let wrong = |p: &Point2| {
        let in_range = |x: f64| (-MAX_COORDINATE_MM..=MAX_COORDINATE_MM).contains(&x);
        !(in_range(p.x) && in_range(p.y))
    };
    if let Some(position) = positions.iter().position(wrong) {
        return Err(StrokeError::OutOfRange { position });
    }
    let low = positions.iter().fold(Vec2::INFINITY, |low, p| low.min(p.to_vec()));
    let high = positions.iter().fold(Vec2::NEG_INFINITY, |high, p| high.max(p.to_vec()));
    let extent_mm = if positions.is_empty() { 0.0 } else { (high - low).length() };
    if extent_mm <= smallest_mm.max(0.0) {
        return Err(StrokeError::Click { extent_mm, smallest_mm });
    }
    let mut kept: Vec<Point2> = Vec::new();
    for &p in positions {
        if kept.last().is_none_or(|last| last.distance(p) > SAME_SPOT * extent_mm) {
            kept.push(p);
        }
    }
    Ok(kept)
}

/// Straight from point to point, and back to the first if it is closed.
#[derive(Clone, Debug)]
pub(super) struct Path {
    pub(super) points: Vec<Point2>,
    pub(super) closed: bool,
    /// The length up to each point, and to the end, mm.
    ways: Vec<f64>,
}

impl Path {
    pub(super) fn new(points: Vec<Point2>, closed: bool) -> Self {
        let mut ways = vec![0.0];
        let mut way = 0.0;
        for i in 0..points.len() - usize::from(!closed) {
            way += points[i].distance(points[(i + 1) % points.len()]);
            ways.push(way);
        }
        Self { points, closed, ways }
    }

    /// Its length, mm.
    pub(super) fn length(&self) -> f64 {
        self.ways[self.ways.len() - 1]
    }

    /// The length up to each of its points, mm.
    pub(super) fn ways(&self) -> impl Iterator<Item = f64> + '_ {
        self.ways.iter().copied().take(self.points.len())
    }

    /// The place at a length of `way` mm from its beginning; on a closed path, counted on round it.
    pub(super) fn at(&self, way: f64) -> Point2 {
        let length = self.length();
        let way = if self.closed { way.rem_euclid(length) } else { way.clamp(0.0, length) };
        let m = self.points.len();
        let last = self.ways.len() - 2;
        let i = self.ways.partition_point(|&w| w <= way).saturating_sub(1).min(last);
        let step = self.ways[i + 1] - self.ways[i];
        let share = if step > 0.0 { (way - self.ways[i]) / step } else { 0.0 };
        self.points[i].lerp(self.points[(i + 1) % m], share)
    }

    /// As many places at equal steps along it, both ends of an open path among them.
    pub(super) fn even(&self, count: usize) -> Vec<Point2> {
        let steps = (count - usize::from(!self.closed)) as f64;
        (0..count).map(|i| self.at(self.length() * (i as f64 / steps))).collect()
    }

    /// Its steps.
    pub(super) fn steps(&self) -> impl Iterator<Item = (Point2, Point2)> + '_ {
        let m = self.points.len();
        (0..self.ways.len() - 1).map(move |i| (self.points[i], self.points[(i + 1) % m]))
    }

    /// The distance of a point from the path, mm.
    pub(super) fn distance(&self, p: Point2) -> f64 {
        let squared = self.steps().map(|(a, b)| squared_from_segment(p, a, b));
        squared.fold(f64::INFINITY, f64::min).sqrt()
    }
}

fn squared_from_segment(p: Point2, a: Point2, b: Point2) -> f64 {
    let (along, to) = (b - a, p - a);
    let squared = along.length_squared();
    let t = if squared > 0.0 { (to.dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
    (to - along * t).length_squared()
}

/// The points of a polyline that Douglas and Peucker keep so that it stays within `tolerance_mm`:
/// their numbers, both ends among them.
pub(super) fn douglas_peucker(points: &[Point2], tolerance_mm: f64) -> Vec<usize> {
    let mut kept = vec![0];
    let mut open = vec![points.len() - 1];
    while let (Some(&from), Some(&to)) = (kept.last(), open.last()) {
        let off = |i: usize| squared_from_segment(points[i], points[from], points[to]);
        let worst = (from + 1..to).fold(None, |worst: Option<(usize, f64)>, i| match worst {
            Some((_, most)) if most >= off(i) => worst,
            _ => Some((i, off(i))),
        });
        match worst {
            Some((i, most)) if most > tolerance_mm * tolerance_mm => open.push(i),
            _ => {
                kept.push(to);
                open.pop();
            }
        }
    }
    kept
}
