//! Closing cuts whose gaps are smaller than a cutter notices.
//!
//! A window in a bent panel closes when the panel is laid flat only if the panel is exactly
//! developable all round it. Triangles over samples nearly are: the two sides of the cut then lie a
//! hair apart. Lengths are changed a little, so that they meet: of all changes that close the cuts,
//! those with the least Σ δ² / l over all sides, the work it takes to stretch rods of one kind.
//!
//! The pattern follows from the lengths, so the closing of k cuts is 3k conditions on them (two for
//! a place and one for a direction). They are linearised at the pattern and solved, and the pattern
//! is laid anew from the new lengths, until the sides meet (Gauss and Newton). The derivative of a
//! condition comes from going through the triangles from one side of the cut to the other: where
//! the way enters a triangle by one side and leaves it by another, what follows turns about their
//! common corner by the change of the angle there, and moves along a side as it grows.

use super::opened::{CutSides, Opened};
use super::{FlattenError, Flattened, unroll::unroll};
use crate::surface::Connectivity;
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::index::{SampleIndex, TriangleIndex};
use sheetwright_geometry::math::{Point2, Vec2, atan2};
use sheetwright_geometry::watch::Watch;
use sheetwright_optimum::rung::Rung;
use std::collections::BTreeMap;

/// The most steps; each squares the error, so that three or four are enough.
const MOST_STEPS: usize = 12;
/// The gap that rounding leaves, as a share of the size.
const MET: f64 = 1e-12;

/// The sheet laid flat with lengths so changed that the cuts numbered in `closed` meet; `None`
/// where they can't be made to.
///
/// # Errors
/// [`FlattenError::Stopped`].
pub(super) fn closed(
    sheet: &Opened,
    closed: &[usize],
    flat: &Flattened,
    watch: &mut dyn Watch,
) -> Result<Option<Flattened>, FlattenError> {
    let connectivity = sheet.surface().connectivity();
    let sides = Sides::new(sheet);
    let size = size_of(sheet.surface().positions().iter().copied());
    let ways: Option<Vec<WayRound>> =
        closed.iter().map(|&n| way_round(connectivity, &sheet.cuts()[n])).collect();
    let Some(ways) = ways else { return Ok(None) };
    let mut change = vec![0.0; sides.lengths.len()];
    let mut flat = flat.clone();
    for _ in 0..MOST_STEPS {
        let conditions: Option<Vec<Condition>> = ways
            .iter()
            .flat_map(|way| conditions(sheet, &sides, way, &flat.points, size))
            .collect();
        let Some(conditions) = conditions else { return Ok(None) };
        if conditions.iter().all(|c| c.gap.abs() <= MET * size) {
            return Ok(Some(flat));
        }
        let Some(least) = least_change(&conditions, &sides.lengths, &change) else {
            return Ok(None);
        };
        change = least;
        let length = |a: SampleIndex, b: SampleIndex| {
            let n = sides.of(sheet, a, b);
            sides.lengths[n] + change[n]
        };
        flat = match unroll(connectivity, length, watch) {
            Ok(flat) => flat,
            Err(FlattenError::Stopped) => return Err(FlattenError::Stopped),
            Err(_) => return Ok(None),
        };
    }
    Ok(None)
}

/// The sides of the uncut surface with their lengths; both sides of a cut are one.
struct Sides {
    numbers: BTreeMap<Rung, usize>,
    /// mm.
    lengths: Vec<f64>,
}

impl Sides {
    fn new(sheet: &Opened) -> Self {
        let mut numbers = BTreeMap::new();
        let mut lengths = Vec::new();
        for [a, b] in sheet.surface().connectivity().sides() {
            numbers.entry(Self::key(sheet, a, b)).or_insert_with(|| {
                lengths.push(sheet.surface().length(a, b));
                lengths.len() - 1
            });
        }
        Self { numbers, lengths }
    }

    fn key(sheet: &Opened, a: SampleIndex, b: SampleIndex) -> Rung {
        Rung::new(sheet.origin(a).get(), sheet.origin(b).get())
    }

    fn of(&self, sheet: &Opened, a: SampleIndex, b: SampleIndex) -> usize {
        self.numbers.get(&Self::key(sheet, a, b)).copied().unwrap_or(0)
    }
}

/// The way from one side of a cut to the other, over the rungs between.
struct WayRound {
    /// The sides that are come by: first one of the cut, last the other.
    sides: Vec<[SampleIndex; 2]>,
}

/// `None` if there is no way.
fn way_round(connectivity: &Connectivity, cut: &CutSides) -> Option<WayRound> {
    let triangle_at = |side: [SampleIndex; 2]| {
        let has = |t: &[SampleIndex; 3]| side.iter().all(|s| t.contains(s));
        connectivity.triangles().iter().position(has).map(TriangleIndex::new)
    };
    let [from, to] = [triangle_at(cut[0])?, triangle_at(cut[1])?];
    let of_triangles = connectivity.hinges_of_triangles();
    let mut came_by: Vec<Option<usize>> = vec![None; of_triangles.len()];
    let mut waiting = vec![from];
    while let Some(triangle) = waiting.pop() {
        for &n in &of_triangles[triangle.get()] {
            let [a, b] = connectivity.hinges()[n].triangles;
            let other = if a == triangle { b } else { a };
            if other != from && came_by[other.get()].is_none() {
                came_by[other.get()] = Some(n);
                waiting.push(other);
            }
        }
    }
    let mut sides = vec![cut[1]];
    let mut at = to;
    while at != from {
        let hinge = connectivity.hinges()[came_by[at.get()]?];
        sides.push(hinge.rung.ends());
        let [a, b] = hinge.triangles;
        at = if a == at { b } else { a };
    }
    sides.push(cut[0]);
    sides.reverse();
    Some(WayRound { sides })
}

/// That something is nought: how far it is from that, mm, and how it grows with every side.
struct Condition {
    gap: f64,
    by_side: BTreeMap<usize, f64>,
}

/// The three conditions that the two sides of a cut meet: two for where its first sample lies and,
/// times the size, one for the direction; `None` where a triangle has no area.
fn conditions(
    sheet: &Opened,
    sides: &Sides,
    way: &WayRound,
    points: &[Point2],
    size: f64,
) -> Vec<Option<Condition>> {
    let at = |s: SampleIndex| points[s.get()];
    let [first, last] = [way.sides[0], way.sides[way.sides.len() - 1]];
    // The sides of a cut run against one another.
    let [home, goal] = [first[0], last[1]];
    let gap = at(goal) - at(home);
    let (along, came) = (at(first[1]) - at(home), at(last[0]) - at(goal));
    let turn = atan2(along.perp_dot(came), along.dot(came));
    let mut motion = Motion { x: BTreeMap::new(), y: BTreeMap::new(), turn: BTreeMap::new() };
    let mut anchor = home;
    let mut on = first;
    let mut whole = true;
    for &next in &way.sides[1..] {
        let Some(pivot) = on.into_iter().find(|s| next.contains(s)) else { return vec![None] };
        let other = |side: [SampleIndex; 2]| if side[0] == pivot { side[1] } else { side[0] };
        let (q, r) = (other(on), other(next));
        if pivot != anchor {
            motion.grow(sides.of(sheet, q, pivot), at(pivot) - at(q));
        }
        let turned = corner_turn([at(pivot), at(q), at(r)]);
        whole &= turned.iter().all(|x| x.is_finite());
        let of = [sides.of(sheet, q, r), sides.of(sheet, pivot, r), sides.of(sheet, pivot, q)];
        for (side, rate) in of.into_iter().zip(turned) {
            motion.turn_about(side, rate, at(pivot), at(goal));
        }
        (anchor, on) = (pivot, next);
    }
    if anchor != goal {
        motion.grow(sides.of(sheet, anchor, goal), at(goal) - at(anchor));
    }
    for rate in motion.turn.values_mut() {
        *rate *= size;
    }
    let each = [(gap.x, motion.x), (gap.y, motion.y), (turn * size, motion.turn)];
    each.into_iter().map(|(gap, by_side)| whole.then_some(Condition { gap, by_side })).collect()
}

/// How the far side of a cut moves at its first sample, and turns, with every side.
struct Motion {
    x: BTreeMap<usize, f64>,
    y: BTreeMap<usize, f64>,
    turn: BTreeMap<usize, f64>,
}

impl Motion {
    /// As a side grows, what follows moves along it.
    fn grow(&mut self, side: usize, way: Vec2) {
        let along = way / way.length();
        *self.x.entry(side).or_default() += along.x;
        *self.y.entry(side).or_default() += along.y;
    }

    /// As a side grows, what follows turns about a pivot at this rate.
    fn turn_about(&mut self, side: usize, rate: f64, pivot: Point2, goal: Point2) {
        let moved = (goal - pivot).perp() * rate;
        *self.x.entry(side).or_default() += moved.x;
        *self.y.entry(side).or_default() += moved.y;
        *self.turn.entry(side).or_default() += rate;
    }
}

/// How the direction p → r turns against p → q as the sides q–r, p–r and p–q of a triangle grow,
/// radians a mm: the law of cosines, differentiated.
fn corner_turn([p, q, r]: [Point2; 3]) -> [f64; 3] {
    let (pq, pr, qr) = (q - p, r - p, r - q);
    // Positive where the turn from q to r is counter-clockwise.
    let area_doubled = pq.perp_dot(pr);
    let by_far = qr.length() / area_doubled;
    let cos_r = pr.dot(qr) / (pr.length() * qr.length());
    let cos_q = -pq.dot(qr) / (pq.length() * qr.length());
    [by_far, -by_far * cos_r, -by_far * cos_q]
}

/// The least change of all lengths, by Σ δ² / l, with which the linearised conditions hold;
/// `change` is that at which they were linearised. `None` if they depend on one another.
fn least_change(conditions: &[Condition], lengths: &[f64], change: &[f64]) -> Option<Vec<f64>> {
    let count = conditions.len();
    let mut matrix = vec![vec![0.0; count + 1]; count];
    let mut spread = vec![0.0; lengths.len()];
    for (i, condition) in conditions.iter().enumerate() {
        for (&side, &rate) in &condition.by_side {
            spread[side] = rate * lengths[side];
        }
        for (j, other) in conditions.iter().enumerate() {
            matrix[j][i] = other.by_side.iter().map(|(&s, rate)| rate * spread[s]).sum();
        }
        for &side in condition.by_side.keys() {
            spread[side] = 0.0;
        }
        let already: f64 = condition.by_side.iter().map(|(&s, rate)| rate * change[s]).sum();
        matrix[i][count] = already - condition.gap;
    }
    let shares = solved(matrix)?;
    let mut least = vec![0.0; lengths.len()];
    for (condition, share) in conditions.iter().zip(shares) {
        for (&side, &rate) in &condition.by_side {
            least[side] += lengths[side] * rate * share;
        }
    }
    Some(least)
}

/// The solution of linear equations, each a row with its right side last, by elimination; `None` if
/// they have none.
fn solved(mut rows: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    let count = rows.len();
    for n in 0..count {
        let pivot = (n..count).max_by(|&a, &b| rows[a][n].abs().total_cmp(&rows[b][n].abs()))?;
        rows.swap(n, pivot);
        let head = rows[n].clone();
        if !(head[n].is_finite() && head[n] != 0.0) {
            return None;
        }
        for row in &mut rows[n + 1..] {
            let share = row[n] / head[n];
            for (cell, above) in row[n..].iter_mut().zip(&head[n..]) {
                *cell -= share * above;
            }
        }
    }
    let mut solution = vec![0.0; count];
    for n in (0..count).rev() {
        let known: f64 = (n + 1..count).map(|k| rows[n][k] * solution[k]).sum();
        solution[n] = (rows[n][count] - known) / rows[n][n];
    }
    solution.iter().all(|x| x.is_finite()).then_some(solution)
}

/// How far apart the two sides of a cut lie on the pattern, mm.
pub(super) fn gap_mm(cut: &CutSides, points: &[Point2]) -> f64 {
    let [[a, b], [c, d]] = cut.map(|side| side.map(|s| points[s.get()]));
    a.distance(d).max(b.distance(c))
}
