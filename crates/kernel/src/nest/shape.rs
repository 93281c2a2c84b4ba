//! The form of a part as the search sees it: grown by half the gap, with fewer corners, and filled
//! with circles.
//!
//! Corners go one after the other, the one that adds least area first, and only so that the form
//! grows: a concave corner is bridged, and a convex side is replaced by its neighbours, which are
//! prolonged until they meet. What does not overlap with the grown form does not overlap with the
//! part. The circles (poles of inaccessibility) tell how deeply two forms overlap
//! \[GardeynVandenBergheWauters2025\].

use crate::flatten::{convex_hull, long_side};
use sheetwright_geometry::math::{Point2, Vec2, atan2};
use sheetwright_geometry::offset;
use sheetwright_geometry::predicate::{Box2, inside, segments_touch, signed_area_doubled};
use std::cmp::Ordering;

/// The most circles of a form.
const MOST_POLES: usize = 20;
/// Circles cover this share of a form, if the number allows it.
const COVERED: f64 = 0.92;
/// A circle this much smaller than the first is of no use.
const LEAST_POLE: f64 = 0.04;
/// Points to a side of the lattice on which the middles of circles are looked for.
const LATTICE: usize = 40;
/// So many of the longest sides are laid along a sheet.
const MOST_SIDES: usize = 4;

/// A circle inside a form.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pole {
    pub(super) at: Point2,
    pub(super) radius: f64,
}

/// How true a form is to its part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Trueness {
    /// With fewer corners, which add up to this share of its area.
    Coarse(f64),
    /// With all its corners.
    Fine,
    /// With all its corners, in the box of the part grown by the distance. Tips of grown corners
    /// reach beyond that: a part as large as its sheet has no room for them.
    Boxed,
}

/// The form of a part, about the middle of its box.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    /// Where the middle lies in the part's own coordinates.
    pub(super) middle: Point2,
    /// The corners of all loops, the outline first.
    pub(super) points: Vec<Point2>,
    /// The corner that follows each.
    pub(super) next: Vec<usize>,
    pub(super) poles: Vec<Pole>,
    /// The area of the hull, mm².
    pub(super) hull_area: f64,
    /// The farthest corner from the middle, mm.
    pub(super) radius: f64,
    /// The smaller side of the box, mm.
    pub(super) least_side: f64,
    /// The angles, radians, that lay a long side of the hull along x.
    pub(super) upright: Vec<f64>,
    /// The area of the part itself, mm².
    pub(super) area: f64,
    /// What its box is made of where that is the box of the part; else it is that of its corners.
    pub(super) boxed: Option<Boxed>,
}

/// What the box of a part is made of.
#[derive(Clone, Debug)]
pub(super) struct Boxed {
    /// The hull of the part, about the middle of the form.
    pub(super) hull: Vec<Point2>,
    /// By how much its box grows, mm.
    pub(super) by_mm: f64,
}

impl Shape {
    /// The form of a part with these loops, the outline first, grown by `by_mm` all round.
    pub(super) fn new(loops: &[Vec<Point2>], by_mm: f64, trueness: Trueness) -> Self {
        let area_of = |line: &[Point2]| 0.5 * signed_area_doubled(line);
        let area = loops.iter().map(|line| area_of(line).abs()).enumerate();
        let area = area.fold(0.0, |sum, (n, a)| if n == 0 { a } else { sum - a }).max(0.0);
        let grown = grown(loops, by_mm);
        let coarse = match trueness {
            Trueness::Coarse(share) => share,
            Trueness::Fine | Trueness::Boxed => 0.0,
        };
        let allowed = coarse * area_of(&grown[0]).abs();
        let outline = loops.first().filter(|_| trueness == Trueness::Boxed);
        let loops: Vec<Vec<Point2>> =
            grown.into_iter().map(|line| simplified(line, allowed)).collect();
        let (low, high) = corners(&loops[0]);
        let middle = low.lerp(high, 0.5);
        let about = |p: &Point2| Point2::default() + (*p - middle);
        let loops: Vec<Vec<Point2>> =
            loops.iter().map(|line| line.iter().map(about).collect()).collect();
        let mut next = Vec::new();
        for line in &loops {
            let first = next.len();
            next.extend((1..line.len()).map(|n| first + n));
            next.push(first);
        }
        let boxed = outline.map(|outline| {
            let hull = convex_hull(outline).iter().map(about).collect();
            Boxed { hull, by_mm }
        });
        let hull = convex_hull(&loops[0]);
        let points: Vec<Point2> = loops.iter().flatten().copied().collect();
        let radius = points.iter().fold(0.0, |most: f64, p| most.max(p.to_vec().length()));
        let size = high - low;
        let poles = poles(&loops, &points, &next);
        Self {
            middle,
            poles,
            hull_area: area_of(&hull).abs().max(f64::MIN_POSITIVE),
            radius,
            least_side: size.x.min(size.y).max(1e-6),
            upright: upright(boxed.as_ref().map_or(&hull, |boxed| &boxed.hull)),
            boxed,
            points,
            next,
            area,
        }
    }
}

/// The lower left and the upper right corner of the box around some points.
fn corners(points: &[Point2]) -> (Point2, Point2) {
    let around = Box2::of_points(points.iter().copied());
    around.map_or_else(Default::default, |it| (it.min, it.max))
}

/// The outline, counter-clockwise, and the holes, clockwise, of the part and all that lies within
/// `by_mm` of it.
fn grown(loops: &[Vec<Point2>], by_mm: f64) -> Vec<Vec<Point2>> {
    let mut lines: Vec<Vec<Point2>> = Vec::with_capacity(loops.len());
    for (n, line) in loops.iter().enumerate() {
        let turn = (signed_area_doubled(line) < 0.0) == (n == 0);
        lines.push(if turn { line.iter().rev().copied().collect() } else { line.clone() });
    }
    match offset::grown(&lines, by_mm).into_iter().next() {
        Some(region) => std::iter::once(region.outline).chain(region.holes).collect(),
        None => lines,
    }
}

/// A closed line that has its region to the left, with fewer corners. The region grows by up to
/// `allowed`, mm².
fn simplified(mut line: Vec<Point2>, allowed: f64) -> Vec<Point2> {
    let mut left = allowed;
    let mut barred: Vec<bool> = vec![false; line.len()];
    while line.len() > 3 {
        let m = line.len();
        let mut best: Option<(f64, usize, Option<Point2>)> = None;
        for k in 0..m {
            if barred[k] {
                continue;
            }
            if let Some((cost, met)) = removal(&line, k)
                && cost <= left
                && best.is_none_or(|(least, ..)| cost < least)
            {
                best = Some((cost, k, met));
            }
        }
        let Some((cost, k, met)) = best else { break };
        let mut tried = line.clone();
        match met {
            None => _ = tried.remove(k),
            Some(met) => {
                tried[k] = met;
                tried.remove((k + 1) % m);
            }
        }
        if crosses_near(&tried, k, met.is_some(), m) {
            barred[k] = true;
            continue;
        }
        match met {
            None => _ = barred.remove(k),
            Some(_) => _ = barred.remove((k + 1) % m),
        }
        left -= cost;
        line = tried;
    }
    line
}

/// What it adds to do without corner k: it is left out, or it and the next become one corner, where
/// the sides before and behind them meet. `None`: neither can be.
fn removal(line: &[Point2], k: usize) -> Option<(f64, Option<Point2>)> {
    let m = line.len();
    let [a, b, c, d] = [k + m - 1, k, k + 1, k + 2].map(|n| line[n % m]);
    let turn = (b - a).perp_dot(c - b);
    if turn <= 0.0 {
        return Some((-0.5 * turn, None));
    }
    // The side from b to c goes, if both its corners point out.
    let (first, second) = (b - a, d - c);
    if m < 4 || (c - b).perp_dot(second) <= 0.0 {
        return None;
    }
    let across = first.perp_dot(second);
    if across <= 0.0 {
        return None;
    }
    let t = (c - a).perp_dot(second) / across;
    let met = a + first * t;
    (t >= 1.0).then(|| (0.5 * (met - b).perp_dot(c - b).abs(), Some(met)))
}

/// Whether the sides that are new touch others.
fn crosses_near(line: &[Point2], k: usize, is_met: bool, before: usize) -> bool {
    let m = line.len();
    let side = |n: usize| [line[n % m], line[(n + 1) % m]];
    // Where the first corner went, the others moved up.
    let k = if is_met && k + 1 == before { k - 1 } else { k };
    let new = if is_met { vec![(k + m - 1) % m, k % m] } else { vec![(k + m - 1) % m] };
    new.iter().any(|&n| {
        let [a, b] = side(n);
        (0..m).any(|other| {
            let near = other == n || (other + 1) % m == n || (n + 1) % m == other;
            let [c, d] = side(other);
            !near && segments_touch(a, b, c, d)
        })
    })
}

/// The angles that lay along x the long side of the smallest box, the side of the hull on which
/// the box is lowest, and its longest sides.
fn upright(hull: &[Point2]) -> Vec<f64> {
    let m = hull.len();
    let mut sides: Vec<Vec2> = (0..m).map(|k| hull[(k + 1) % m] - hull[k]).collect();
    sides.sort_by(|a, b| b.length_squared().total_cmp(&a.length_squared()));
    let height = |side: &Vec2| {
        let up = side.normalize_or_zero().perp();
        let heights = || hull.iter().map(|p| p.to_vec().dot(up));
        heights().fold(f64::MIN, f64::max) - heights().fold(f64::MAX, f64::min)
    };
    let lowest = sides.iter().copied().min_by(|a, b| height(a).total_cmp(&height(b)));
    let longest = sides.iter().copied().take(MOST_SIDES);
    let mut ways = vec![long_side(hull)];
    ways.extend(lowest.into_iter().chain(longest));
    ways.dedup();
    ways.into_iter().map(|way| -atan2(way.y, way.x)).collect()
}

/// Circles inside a form that do not overlap, the largest first: each is the largest that fits
/// beside those before, of those whose middles lie on a lattice, and then moved by hand.
fn poles(loops: &[Vec<Point2>], points: &[Point2], next: &[usize]) -> Vec<Pole> {
    let (low, high) = corners(&loops[0]);
    let size = high - low;
    let is_in = |p: Point2| inside(&loops[0], p) && !loops[1..].iter().any(|hole| inside(hole, p));
    let clear = |p: Point2| {
        let to = |(a, n): (&Point2, &usize)| p.distance_to_segment([*a, points[*n]]);
        points.iter().zip(next).map(to).fold(f64::INFINITY, f64::min)
    };
    // The lattice has square cells, so that thin forms have points, too.
    let step = (size.x.max(size.y) / LATTICE as f64).min(size.x.min(size.y) / 8.0);
    let step = step.max(size.x.max(size.y) / 400.0).max(1e-9);
    let count = |length: f64| ((length / step) as usize).max(1);
    let mut free: Vec<(Point2, f64)> = Vec::new();
    for i in 0..count(size.x) {
        for j in 0..count(size.y) {
            let at = low + Vec2::new((i as f64 + 0.5) * step, (j as f64 + 0.5) * step);
            if is_in(at) {
                free.push((at, clear(at)));
            }
        }
    }
    let whole: f64 = loops.iter().map(|line| 0.5 * signed_area_doubled(line)).sum();
    let mut poles: Vec<Pole> = Vec::new();
    let mut covered = 0.0;
    while poles.len() < MOST_POLES && covered < COVERED * whole {
        let by_radius = |a: &&(Point2, f64), b: &&(Point2, f64)| a.1.total_cmp(&b.1);
        let Some(&(mut at, mut radius)) = free.iter().max_by(by_radius) else { break };
        let room = |p: Point2| {
            let beside = |pole: &Pole| p.distance(pole.at) - pole.radius;
            poles.iter().map(beside).fold(clear(p), f64::min)
        };
        let mut way = 0.5 * step;
        while way > 0.02 * step {
            let ways = [Vec2::X, Vec2::Y, -Vec2::X, -Vec2::Y].map(|side| at + side * way);
            let tried = ways.map(|p| (p, if is_in(p) { room(p) } else { 0.0 }));
            let best = tried.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
            match best {
                Some((p, more)) if more > radius => (at, radius) = (p, more),
                _ => way *= 0.5,
            }
        }
        if poles.first().is_some_and(|first| radius < LEAST_POLE * first.radius) {
            break;
        }
        covered += std::f64::consts::PI * radius * radius;
        poles.push(Pole { at, radius });
        free.retain_mut(|(p, room)| {
            *room = room.min(p.distance(at) - radius);
            *room > 0.0
        });
    }
    if poles.is_empty() {
        // Too thin for the lattice: a circle of no size on a side tells where it is.
        let at = points.iter().copied().min_by(|a, b| {
            a.to_vec()
                .length_squared()
                .partial_cmp(&b.to_vec().length_squared())
                .unwrap_or(Ordering::Equal)
        });
        poles.extend(at.map(|at| Pole { at, radius: 1e-9 }));
    }
    poles
}
