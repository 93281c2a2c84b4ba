//! Painting surfaces as they are seen.
//!
//! Painter's algorithm: triangles from far to near, then those parts of lines that no triangle
//! hides. Where nothing hides anything (see [`is_plain`]) no order is needed, and triangles of one
//! shade and all lines of a kind are one path each, which makes the page small.

use super::canvas::PathData;
use super::hidden::Seen;
use super::part::Part;
use super::style::SHADES;
use super::view::{View, is_plain};
use sheetwright::index::TriangleIndex;
use sheetwright::math::{Point2, Vec3, unit};
use std::collections::BTreeMap;

/// The least difference of brightness that the shades are spread over: below it a surface is so
/// flat that it may look so.
const LEAST_CONTRAST: f64 = 0.18;
/// The classes of rungs, in the order in which they are drawn.
const RUNG_CLASSES: [&str; 3] = ["r", "x", "w"];

/// A triangle of a part, with the class of its shade.
struct Facet {
    part: usize,
    triangle: TriangleIndex,
    shade: String,
}

/// The elements of a picture of some panels.
pub(super) fn paint(view: &View, parts: &[Part<'_>]) -> String {
    let facets = facets(view, parts);
    match parts {
        [only] if is_plain(view, only.panel) => paint_plain(only, &facets),
        _ => paint_by_depth(view, parts, &facets),
    }
}

/// All triangles: the side that is seen of each, and how bright it is.
fn facets(view: &View, parts: &[Part<'_>]) -> Vec<Facet> {
    // A lamp above the left shoulder.
    let lamp = unit(view.toward * 0.75 + view.up * 0.55 - view.right * 0.45).unwrap_or(Vec3::Z);
    let mut lit: Vec<(usize, TriangleIndex, bool, f64)> = Vec::new();
    for (n, part) in parts.iter().enumerate() {
        let surface = &part.panel.surface;
        for triangle in (0..surface.connectivity().triangles().len()).map(TriangleIndex::new) {
            let normal = surface.normal(triangle).unwrap_or(view.toward);
            let front = normal.dot(view.toward) >= 0.0;
            let seen = if front { normal } else { -normal };
            lit.push((n, triangle, front, 0.5 + 0.5 * seen.dot(lamp)));
        }
    }
    let most = lit.iter().map(|l| l.3).fold(0.0, f64::max);
    let least = lit.iter().map(|l| l.3).fold(most - LEAST_CONTRAST, f64::min);
    let facet = |(part, triangle, front, brightness): (usize, TriangleIndex, bool, f64)| {
        let share = (brightness - least) / (most - least);
        let shade = ((SHADES - 1) as f64 * share).round() as usize;
        let side = if front { 'f' } else { 'b' };
        Facet { part, triangle, shade: format!("{side}{}", shade.min(SHADES - 1)) }
    };
    lit.into_iter().map(facet).collect()
}

fn paint_plain(part: &Part<'_>, facets: &[Facet]) -> String {
    let mut fills: BTreeMap<&str, PathData> = BTreeMap::new();
    for facet in facets {
        fills.entry(&facet.shade).or_default().ring(part.corners(facet.triangle));
    }
    let mut body: String = fills.iter().map(|(class, path)| path.element(class)).collect();
    for class in RUNG_CLASSES {
        let mut path = PathData::default();
        for ends in part.rungs_of(class) {
            path.line(ends.map(|s| part.points[s.get()]));
        }
        body += &path.element(class);
    }
    let mut edge = PathData::default();
    for range in part.panel.surface.connectivity().loops() {
        edge.ring(part.points[range.clone()].iter().copied());
    }
    body + &edge.element("e")
}

fn paint_by_depth(view: &View, parts: &[Part<'_>], facets: &[Facet]) -> String {
    let nearness: Vec<f64> = facets
        .iter()
        .map(|facet| {
            let corners = parts[facet.part].panel.surface.corners(facet.triangle);
            corners.iter().map(|&p| view.nearness(p)).sum::<f64>()
        })
        .collect();
    let mut order: Vec<usize> = (0..facets.len()).collect();
    order.sort_by(|&a, &b| nearness[a].total_cmp(&nearness[b]).then(a.cmp(&b)));
    let mut body = String::new();
    let (mut class, mut run) = ("", PathData::default());
    for facet in order.into_iter().map(|n| &facets[n]) {
        if class != facet.shade {
            body += &std::mem::take(&mut run).element(class);
            class = &facet.shade;
        }
        run.ring(parts[facet.part].corners(facet.triangle));
    }
    body += &run.element(class);
    let seen = Seen::new(view, parts);
    for class in RUNG_CLASSES {
        let mut path = PathData::default();
        for (n, part) in parts.iter().enumerate() {
            for piece in part.rungs_of(class).flat_map(|ends| seen.visible(n, ends)) {
                path.line(piece);
            }
        }
        body += &path.element(class);
    }
    let mut path = PathData::default();
    for (n, part) in parts.iter().enumerate() {
        let edges = part.panel.surface.connectivity().edges();
        for run in joined(edges.flat_map(|edge| seen.visible(n, edge))) {
            path.line(run);
        }
    }
    body + &path.element("e")
}

/// Pieces that follow one another as one line.
fn joined(pieces: impl Iterator<Item = [Point2; 2]>) -> Vec<Vec<Point2>> {
    let mut runs: Vec<Vec<Point2>> = Vec::new();
    for [from, to] in pieces {
        match runs.last_mut() {
            Some(run) if run.last() == Some(&from) => run.push(to),
            _ => runs.push(vec![from, to]),
        }
    }
    runs
}
