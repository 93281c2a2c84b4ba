//! The turn of runs in steps, and the bend lines in the middle of the steps.
//!
//! A run is cut where it begins to turn the other way. In each section the turn then only grows but
//! for noise, which isotonic regression takes out: where it falls, neighbours get their mean
//! (pool adjacent violators \[ABERS55\]). Both rails as functions of the turn give the rulings, and
//! a density of lines along the turn (equal angles, equal widths, or equal sagittas, which go with
//! the root of angle times width) is shared out into equal steps.

use super::rail::{Rail, RailPlace};
use super::{BendLine, LEAST_BEND_DEG, Run};
use crate::design::{AUTO_LINES, AUTO_STEP_DEG, BendRule, MOST_BEND_LINES};
use sheetwright_geometry::math::{Point2, from_deg, unit2};

/// Steps are not made smaller for so little, as a share of one: for rounding alone.
const ROUNDING: f64 = 1e-9;

/// The bend lines of runs, run by run.
pub(super) fn divided(runs: &[&Run], rule: BendRule) -> Vec<Vec<BendLine>> {
    let sections: Vec<Vec<Section<'_>>> = runs.iter().map(|run| sections(run)).collect();
    let all: Vec<&Section<'_>> = sections.iter().flatten().collect();
    let mut counts = counts(&all, rule).into_iter();
    let lines = |section: &Section<'_>| section.lines(counts.next().unwrap_or(0), rule);
    let mut lines = lines;
    sections.iter().map(|of_run| of_run.iter().flat_map(&mut lines).collect()).collect()
}

/// How many lines each section gets.
fn counts(sections: &[&Section<'_>], rule: BendRule) -> Vec<usize> {
    let turns: Vec<f64> = sections.iter().map(|section| section.turn()).collect();
    let whole: f64 = turns.iter().sum();
    match rule {
        BendRule::Auto => {
            let steps = (whole / from_deg(AUTO_STEP_DEG) - ROUNDING).ceil().max(0.0) as usize;
            shared(&turns, steps.min(AUTO_LINES))
        }
        BendRule::Number(number) => shared(&turns, number.min(MOST_BEND_LINES)),
        BendRule::Angle(_) | BendRule::Chord(_) | BendRule::Pitch(_) => {
            let steps = |section: &&Section<'_>| {
                let steps = (section.measure(rule) - ROUNDING).ceil();
                (steps.max(1.0) as usize).min(MOST_BEND_LINES)
            };
            sections.iter().map(steps).collect()
        }
    }
}

/// A number shared out in proportion to some turns: one each, and of what is left the whole parts,
/// and then one each to the largest remainders.
fn shared(turns: &[f64], number: usize) -> Vec<usize> {
    let whole: f64 = turns.iter().sum();
    let wanted: Vec<f64> = turns.iter().map(|turn| number as f64 * turn / whole).collect();
    let mut counts: Vec<usize> =
        wanted.iter().map(|wanted| ((wanted + ROUNDING).floor() as usize).max(1)).collect();
    let mut order: Vec<usize> = (0..turns.len()).collect();
    let left = |n: usize, counts: &[usize]| wanted[n] - counts[n] as f64;
    order.sort_by(|&a, &b| left(b, &counts).total_cmp(&left(a, &counts)).then(a.cmp(&b)));
    let given: usize = counts.iter().sum();
    for &n in order.iter().take(number.saturating_sub(given)) {
        counts[n] += 1;
    }
    counts
}

/// A stretch of a run that turns one way.
struct Section<'a> {
    rails: &'a [Rail; 2],
    /// 1 where it turns down, as mountains do, else −1.
    sign: f64,
    /// Its pieces in order, without gaps between their turns.
    pieces: Vec<Piece>,
}

/// A stretch in which both rails run on evenly with the turn.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// The turn at its beginning and at its end, radians.
    turn: [f64; 2],
    /// How far along the left rail it begins and ends, and along the right one, mm.
    along_mm: [[f64; 2]; 2],
    /// How wide it is on both rails, across the ruling, mm.
    width_mm: [f64; 2],
}

impl Piece {
    fn turned(&self) -> f64 {
        self.turn[1] - self.turn[0]
    }
}

/// The sections of a run that are bent; flat ones are none.
fn sections(run: &Run) -> Vec<Section<'_>> {
    let cuts = cuts(&run.turns);
    let last = run.turns.len() - 1;
    let section = |ends: &[usize]| {
        let [first, end] = [ends[0], ends[1]];
        let sign = if run.turns[end] < run.turns[first] { -1.0 } else { 1.0 };
        let raw: Vec<f64> = run.turns.iter().map(|turn| sign * turn).collect();
        let turned = Turned { first, turns: monotone(&raw[first..=end]), raw };
        let begins = |rail: &Rail| turned.begins(rail, first == 0 && run.goes_on[0]);
        let ends = |rail: &Rail| turned.ends(rail, end == last && run.goes_on[1]);
        let mean = |of: &dyn Fn(&Rail) -> Option<f64>, usual: f64| {
            let found: Vec<f64> = run.rails.iter().filter_map(of).collect();
            let count = found.len() as f64;
            if found.is_empty() { usual } else { found.iter().sum::<f64>() / count }
        };
        let start = mean(&begins, turned.turns[0]);
        let stop = mean(&ends, turned.turns[end - first]);
        let known = run.rails.each_ref().map(|rail| {
            let along_mm = [
                if first == 0 { rail.start_mm() } else { turned.passes(rail, first) },
                if end == last { rail.length_mm() } else { turned.passes(rail, end) },
            ];
            turned.along(rail, [start, stop], along_mm)
        });
        Section { rails: &run.rails, sign, pieces: pieces(&known, &run.rails) }
    };
    let sections = cuts.windows(2).map(section);
    sections.filter(|section| section.turn() > from_deg(LEAST_BEND_DEG)).collect()
}

/// The numbers of the first and the last of some turns, and between them of those where they begin
/// to run the other way by more than the least bend.
fn cuts(turns: &[f64]) -> Vec<usize> {
    let least = from_deg(LEAST_BEND_DEG);
    let mut cuts = vec![0];
    let (mut low, mut high) = (0, 0);
    // Whether they grow; unknown as long as they are about equal.
    let mut grows: Option<bool> = None;
    for n in 0..turns.len() {
        if turns[n] > turns[high] {
            high = n;
        }
        if turns[n] < turns[low] {
            low = n;
        }
        match grows {
            None if turns[high] - turns[low] > least => grows = Some(high > low),
            Some(true) if turns[high] - turns[n] > least => {
                cuts.push(high);
                (grows, low) = (Some(false), n);
            }
            Some(false) if turns[n] - turns[low] > least => {
                cuts.push(low);
                (grows, high) = (Some(true), n);
            }
            Some(true) => low = n,
            Some(false) => high = n,
            None => {}
        }
    }
    if turns.len() > 1 {
        cuts.push(turns.len() - 1);
    }
    cuts
}

/// The nearest numbers, by squares, that nowhere fall.
fn monotone(numbers: &[f64]) -> Vec<f64> {
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for &number in numbers {
        pools.push((number, 1));
        while let [.., (a, m), (b, n)] = pools[..] {
            if a <= b {
                break;
            }
            pools.truncate(pools.len() - 2);
            pools.push(((a * m as f64 + b * n as f64) / (m + n) as f64, m + n));
        }
    }
    pools.into_iter().flat_map(|(mean, count)| std::iter::repeat_n(mean, count)).collect()
}

/// The turn of each triangle of a section.
struct Turned {
    /// The number of its first triangle in the run.
    first: usize,
    /// The turns of its triangles, which nowhere fall.
    turns: Vec<f64>,
    /// The turns of all triangles of the run as they are.
    raw: Vec<f64>,
}

impl Turned {
    fn at(&self, place: &RailPlace) -> f64 {
        self.turns[place.triangle - self.first]
    }

    fn within<'r>(&self, rail: &'r Rail) -> &'r [RailPlace] {
        let from = rail.places.partition_point(|place| place.triangle < self.first);
        let to = rail.places.partition_point(|p| p.triangle < self.first + self.turns.len());
        &rail.places[from..to]
    }

    /// The turn at the beginning of a rail, half a step before the middle of its first side: `None`
    /// where the bend does not go on to it, or the rail does not tell.
    fn begins(&self, rail: &Rail, goes_on: bool) -> Option<f64> {
        let [first, second, ..] = self.within(rail) else { return None };
        let [from, to] = [self.at(first), self.at(second)];
        let step = second.along_mm - first.along_mm;
        let share = (first.along_mm - rail.start_mm()) / step;
        (goes_on && step > 0.0).then(|| from - (to - from) * share.min(1.0))
    }

    /// The turn at its end, likewise.
    fn ends(&self, rail: &Rail, goes_on: bool) -> Option<f64> {
        let [.., second, last] = self.within(rail) else { return None };
        let [from, to] = [self.at(second), self.at(last)];
        let step = last.along_mm - second.along_mm;
        let share = (rail.length_mm() - last.along_mm) / step;
        (goes_on && step > 0.0).then(|| to + (to - from) * share.min(1.0))
    }

    /// Where a rail passes the ruling at which the run begins to turn the other way, which the
    /// plane of this triangle touches, mm.
    fn passes(&self, rail: &Rail, triangle: usize) -> f64 {
        let n = rail.places.partition_point(|place| place.triangle < triangle);
        let Some(after) = rail.places.get(n) else { return rail.length_mm() };
        let Some(before) = n.checked_sub(1).map(|n| &rail.places[n]) else {
            return rail.start_mm();
        };
        let off = |place: &RailPlace| (self.raw[place.triangle] - self.raw[triangle]).abs();
        let share = off(before) / (off(before) + off(after));
        let share = if share.is_finite() { share } else { 0.5 };
        before.along_mm + (after.along_mm - before.along_mm) * share
    }

    /// A rail as a function of the turn: turns that nowhere fall, with places along it, mm.
    fn along(&self, rail: &Rail, turn: [f64; 2], along_mm: [f64; 2]) -> Vec<[f64; 2]> {
        let mut known = vec![[turn[0], along_mm[0]]];
        known.extend(self.within(rail).iter().map(|place| [self.at(place), place.along_mm]));
        known.push([turn[1], along_mm[1]]);
        // The places of both ends are estimates, which may lie beyond their neighbours.
        for n in 1..known.len() {
            let before = known[n - 1];
            known[n] = [known[n][0].max(before[0]), known[n][1].max(before[1])];
        }
        known
    }
}

/// The pieces of a section, of what is known of both rails.
fn pieces(known: &[Vec<[f64; 2]>; 2], rails: &[Rail; 2]) -> Vec<Piece> {
    let mut levels: Vec<f64> = known.iter().flatten().map(|&[turn, _]| turn).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let mut at = [0; 2];
    let mut pieces = Vec::new();
    for ends in levels.windows(2) {
        let turn = [ends[0], ends[1]];
        let along_mm = [0, 1].map(|n| {
            let of_rail = &known[n];
            while at[n] + 2 < of_rail.len() && of_rail[at[n] + 1][0] < turn[1] {
                at[n] += 1;
            }
            let ([from, start], [to, end]) = (of_rail[at[n]], of_rail[at[n] + 1]);
            turn.map(|turn| {
                let share = ((turn - from) / (to - from)).clamp(0.0, 1.0);
                start + (end - start) * if share.is_nan() { 1.0 } else { share }
            })
        });
        let points = [0, 1].map(|n| along_mm[n].map(|along| rails[n].point(along)));
        let middle = |n: usize| points[n][0].lerp(points[n][1], 0.5);
        let ruling = unit2(middle(1) - middle(0)).unwrap_or_default();
        let width_mm = points.map(|[from, to]: [Point2; 2]| ruling.perp_dot(to - from).abs());
        pieces.push(Piece { turn, along_mm, width_mm });
    }
    pieces
}

impl Section<'_> {
    /// By how much it is bent, radians.
    fn turn(&self) -> f64 {
        self.pieces.iter().map(Piece::turned).sum()
    }

    /// How many steps of the rule it takes.
    fn measure(&self, rule: BendRule) -> f64 {
        self.pieces.iter().map(|piece| measure(piece, rule)).sum()
    }

    /// Its bend lines, of so many.
    fn lines(&self, count: usize, rule: BendRule) -> Vec<BendLine> {
        let whole = self.measure(rule);
        let Some([first, ..]) = self.pieces.first().map(|piece| piece.turn) else {
            return Vec::new();
        };
        let last = first + self.turn();
        let mut ends = vec![first];
        let (mut n, mut before) = (0, 0.0);
        for step in 1..count {
            let wanted = whole * step as f64 / count as f64;
            while n + 1 < self.pieces.len() && before + measure(&self.pieces[n], rule) < wanted {
                before += measure(&self.pieces[n], rule);
                n += 1;
            }
            let piece = &self.pieces[n];
            let share = ((wanted - before) / measure(piece, rule)).clamp(0.0, 1.0);
            ends.push(piece.turn[0] + piece.turned() * if share.is_nan() { 0.0 } else { share });
        }
        ends.push(last);
        ends.windows(2).map(|ends| self.line([ends[0], ends[1]])).collect()
    }

    /// The bend line of the step between two turns.
    fn line(&self, [from, to]: [f64; 2]) -> BendLine {
        let middle = 0.5 * (from + to);
        let after = self.pieces.partition_point(|piece| piece.turn[1] < middle);
        let piece = &self.pieces[after.min(self.pieces.len() - 1)];
        let share = ((middle - piece.turn[0]) / piece.turned()).clamp(0.0, 1.0);
        let along_mm = piece.along_mm.map(|[start, end]| start + (end - start) * share);
        let mut pitch_mm = [0.0; 2];
        for piece in &self.pieces {
            let within = (to.min(piece.turn[1]) - from.max(piece.turn[0])).max(0.0);
            for (pitch, width) in pitch_mm.iter_mut().zip(piece.width_mm) {
                *pitch += width * within / piece.turned();
            }
        }
        BendLine {
            strip: 0,
            is_fold: false,
            ends: [0, 1].map(|n| self.rails[n].point(along_mm[n])),
            angle: self.sign * (to - from),
            inside_radius_mm: None,
            pitch_mm,
            along_mm,
            beyond_mm: [None; 2],
        }
    }
}

/// How many steps of a rule a piece takes; of a number of steps, its turn.
fn measure(piece: &Piece, rule: BendRule) -> f64 {
    let turned = piece.turned();
    let wider_mm = piece.width_mm[0].max(piece.width_mm[1]);
    match rule {
        BendRule::Auto | BendRule::Number(_) => turned,
        BendRule::Angle(step) => turned / step,
        // A step of width p and angle a bulges by p·a/8.
        BendRule::Chord(chord_mm) => (turned * wider_mm / (8.0 * chord_mm)).sqrt(),
        BendRule::Pitch(pitch_mm) => wider_mm / pitch_mm,
    }
}
