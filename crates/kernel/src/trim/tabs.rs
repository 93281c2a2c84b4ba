//! Tabs to glue under the face beside: on one of two joined edges.
//!
//! A tab is a trapezoid beyond a stretch of the net line that is nearly straight on both parts; a
//! curved edge gets a row of them. A tab must not reach over its own part or over what stands
//! beyond it already, and must lie inside the face that it is glued under: the neighbour's pattern
//! is laid against the edge and looked at. Where a tab does not fit, its ends get more slanted, as
//! far as its outer side stays as long as half of its inner one, and then it gets narrower. Below
//! a third of its width it is left out.

use super::stretch::Stretch;
use crate::design::Tabs;
use crate::edge::Shared;
use sheetwright_geometry::math::{Point2, Vec2, cos, sin, unit2};
use sheetwright_geometry::predicate::{inside, segments_touch};

/// The widths that are tried, as shares of the one asked for.
const WIDTHS: [f64; 5] = [1.0, 0.8, 0.6, 0.45, 0.34];
/// The angles that are tried, as shares of the one asked for.
const ANGLES: [f64; 3] = [1.0, 0.7, 0.45];
/// The outer side of a tab is at least as long as this share of its inner one.
pub(super) const OUTER: f64 = 0.3;
/// The sine of the angle that a joint goes in by at least for its tab to be folded towards the
/// viewer: 1°. Less is the rounding of a joint that is flat.
const GOES_IN: f64 = 0.0175;
/// Tests begin this share of a tab's width away from the net line, which it touches.
const OFF: f64 = 0.05;

/// A side of two joined edges.
pub(super) struct Side<'a> {
    pub(super) stretch: &'a Stretch,
    /// The net line of its part.
    pub(super) net: &'a [Vec<Point2>],
    /// What stands beyond it already.
    pub(super) beyond: &'a [Vec<Point2>],
}

/// A tab: the stretch of the net line at which it is folded, and its polygon.
#[derive(Clone, Debug)]
pub(super) struct Tab {
    pub(super) fold: Vec<Point2>,
    pub(super) polygon: Vec<Point2>,
    /// Whether it is folded away from the viewer: it lies behind its mate, so it is where the joint
    /// sticks out, and is not where it goes in.
    pub(super) mountain: bool,
}

/// The tabs of `own` under the face of `mate`, and the share of the common length that has some.
pub(super) fn tabs(
    own: &Side<'_>,
    mate: &Side<'_>,
    shared: &Shared,
    tabs: &Tabs,
) -> (Vec<Tab>, f64) {
    let (mut made, mut covered): (Vec<Tab>, f64) = (Vec::new(), 0.0);
    for piece in straight_pieces(own.stretch, mate.stretch, shared, tabs.tolerance) {
        let beyond: Vec<Vec<Point2>> =
            own.beyond.iter().cloned().chain(made.iter().map(|tab| tab.polygon.clone())).collect();
        let own = Side { beyond: &beyond, ..*own };
        if let Some((tab, width)) = tab(&own, mate, shared, piece, tabs) {
            covered += (piece[1] - piece[0]) * width / tabs.width;
            made.push(tab);
        }
    }
    (made, covered)
}

/// The shares between which both edges leave a straight line by no more than the tolerance.
fn straight_pieces(
    own: &Stretch,
    mate: &Stretch,
    shared: &Shared,
    tolerance: f64,
) -> Vec<[f64; 2]> {
    let mut shares: Vec<f64> = vec![0.0, 1.0];
    for (stretch, [from, to]) in [(own, shared.first), (mate, shared.second)] {
        let whole = stretch.length();
        for (along, _) in stretch.points() {
            let rounds = if stretch.is_loop() { [0.0, whole, -whole] } else { [0.0; 3] };
            shares.extend(rounds.map(|round| (along + round - from) / (to - from)));
        }
    }
    shares.retain(|share| (0.0..=1.0).contains(share));
    shares.sort_by(f64::total_cmp);
    shares.dedup_by(|a, b| *a - *b < 1e-9);
    let points: Vec<[Point2; 2]> = shares
        .iter()
        .map(|&share| {
            let at = |[from, to]: [f64; 2]| from + share * (to - from);
            [own.at(at(shared.first)).at, mate.at(at(shared.second)).at]
        })
        .collect();
    let is_straight = |from: usize, to: usize| {
        (0..2).all(|side| {
            let (a, b) = (points[from][side], points[to][side]);
            let off = |p: Point2| match unit2(b - a) {
                Some(way) => way.perp_dot(p - a).abs(),
                None => p.distance(a),
            };
            points[from + 1..to].iter().all(|p| off(p[side]) <= tolerance)
        })
    };
    let mut pieces = Vec::new();
    let mut from = 0;
    while from + 1 < shares.len() {
        let mut to = from + 1;
        while to + 1 < shares.len() && is_straight(from, to + 1) {
            to += 1;
        }
        pieces.push([shares[from], shares[to]]);
        from = to;
    }
    pieces
}

/// The largest tab that fits, with its width.
fn tab(
    own: &Side<'_>,
    mate: &Side<'_>,
    shared: &Shared,
    piece: [f64; 2],
    tabs: &Tabs,
) -> Option<(Tab, f64)> {
    let lengths = |[from, to]: [f64; 2]| piece.map(|share| from + share * (to - from));
    let of_own = lengths(shared.first);
    let fold = own.stretch.part(of_own);
    let ends = of_own.map(|along| own.stretch.at(along).at);
    let against = lengths(shared.second).map(|along| mate.stretch.at(along).at);
    let length = ends[0].distance(ends[1]);
    let along = unit2(ends[1] - ends[0])?;
    let along_mate = unit2(against[1] - against[0])?;
    let out = -along.perp();
    // The mate's sheet lies to the left of its edge; run the other way, it lies to the right.
    let is_reversed = shared.second[0] > shared.second[1];
    let into = if is_reversed { -along_mate.perp() } else { along_mate.perp() };
    for width in WIDTHS.map(|share| share * tabs.width) {
        for angle in ANGLES.map(|share| share * tabs.angle) {
            let back = width * cos(angle) / sin(angle);
            if length - 2.0 * back < OUTER * length {
                continue;
            }
            let corners = |from: Point2, to: Point2, along: Vec2, out: Vec2| {
                let low = [from + along * back, to + along * -back].map(|p| p + out * width);
                [from, low[0], low[1], to]
            };
            let [_, first, last, _] = corners(ends[0], ends[1], along, out);
            let of_own = corners(ends[0], ends[1], along, out);
            let of_mate = corners(against[0], against[1], along_mate, into);
            if is_clear(&of_own, own.net, false)
                && own
                    .beyond
                    .iter()
                    .all(|polygon| is_clear(&of_own, std::slice::from_ref(polygon), false))
                && is_clear(&of_mate, mate.net, true)
            {
                let mut polygon = fold.clone();
                polygon.extend([last, first]);
                let mountain = !goes_in(own.stretch, mate.stretch, shared, piece);
                return Some((Tab { fold, polygon, mountain }, width));
            }
        }
    }
    None
}

/// Whether the mate rises above the plane of a part, as seen from the side of its pattern, at the
/// middle of a piece of their joint.
fn goes_in(own: &Stretch, mate: &Stretch, shared: &Shared, piece: [f64; 2]) -> bool {
    let share = 0.5 * (piece[0] + piece[1]);
    let at = |[from, to]: [f64; 2]| from + share * (to - from);
    let faces = (own.face_at(at(shared.first)), mate.face_at(at(shared.second)));
    matches!(faces, (Some(own), Some(mate)) if mate.into.dot(own.up) > GOES_IN)
}

/// Whether the three outer sides of a tab lie wholly inside closed lines, or wholly outside.
fn is_clear(tab: &[Point2; 4], lines: &[Vec<Point2>], is_inside: bool) -> bool {
    let [from, first, last, to] = *tab;
    let sides = [[from.lerp(first, OFF), first], [first, last], [last, to.lerp(last, OFF)]];
    let touches = lines.iter().any(|line| {
        let mut edges = (0..line.len()).map(|n| (line[n], line[(n + 1) % line.len()]));
        edges.any(|(a, b)| sides.iter().any(|&[c, d]| segments_touch(a, b, c, d)))
    });
    let rounds = lines.iter().filter(|line| inside(line, first)).count();
    !touches && (rounds % 2 == 1) == is_inside
}
