//! The names of edges, beside the middles of the edges: what is joined to what is read off the
//! pieces.

use super::{LabelKind, PatternLabel, Role};
use crate::edge::{Edge, EdgeSource};
use sheetwright_geometry::math::{Point2, Vec2, unit2};

/// Letters are as high as those of the piece times this.
const BESIDE_NAME: f64 = 0.4;
/// Lower letters can't be read.
const LEAST_MM: f64 = 1.5;
/// A letter is about as wide as this share of its height.
const WIDTH: f64 = 0.75;
/// A name takes this share of its edge at the most; longer ones are written smaller.
const ALONG: f64 = 0.7;

/// The names of the edges of a piece whose vertices lie at `flat`. Sides of cuts have marks of
/// their own, and where there is one edge its name says nothing. `tick_mm` is the length of ticks
/// on the border, which names stay clear of, `height_mm` the height of the piece's letters.
pub(super) fn labels(
    edges: &[Edge],
    flat: &[Point2],
    tick_mm: f64,
    height_mm: f64,
) -> Vec<PatternLabel> {
    let is_cut = |edge: &&Edge| matches!(edge.source, EdgeSource::Cut { .. });
    if edges.len() < 2 {
        return Vec::new();
    }
    let named = edges.iter().filter(|edge| !is_cut(edge));
    named.filter_map(|edge| label(edge, flat, tick_mm, height_mm)).collect()
}

/// The name of an edge; `None` where it would be too small to be read.
fn label(edge: &Edge, flat: &[Point2], tick_mm: f64, height_mm: f64) -> Option<PatternLabel> {
    let letters = edge.name.chars().count() as f64;
    let fits_mm = ALONG * edge.length_flat_mm / (WIDTH * letters);
    let height_mm = (BESIDE_NAME * height_mm).min(fits_mm);
    if height_mm.is_nan() || height_mm < LEAST_MM {
        return None;
    }
    let points: Vec<Point2> = edge.run.iter().map(|&v| flat[v]).collect();
    let half = 0.5 * edge.length_flat_mm;
    let (middle, step) = middle(&points, half)?;
    // The sheet lies to the left. Letters stand upright as far as they can.
    let inside = step.perp();
    let is_upright = step.x > 0.0 || (step.x == 0.0 && step.y > 0.0);
    let along = if is_upright { step } else { -step };
    let feet_mm = tick_mm + if is_upright { 0.4 * height_mm } else { 1.4 * height_mm };
    let at = middle + inside * feet_mm;
    let (kind, role) = (LabelKind::Edge, Role::Engrave);
    Some(PatternLabel { kind, role, at, along, height_mm, text: edge.name.clone() })
}

/// The point so far along a line, mm, and the direction of the line there.
fn middle(points: &[Point2], along_mm: f64) -> Option<(Point2, Vec2)> {
    let mut left = along_mm;
    let mut last = None;
    for pair in points.windows(2) {
        let length = pair[0].distance(pair[1]);
        let Some(step) = unit2(pair[1] - pair[0]) else { continue };
        if left <= length {
            return Some((pair[0] + step * left, step));
        }
        left -= length;
        last = Some((pair[1], step));
    }
    last
}
