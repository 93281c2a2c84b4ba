//! Which sheets are taken, and what lies on each.
//!
//! Parts go on the first open sheet that takes them; where none does, a new one is opened, of the
//! kind that costs least for its area, offcuts first. Then the sheet with least on it is emptied:
//! its parts are thrown on the others and separated there, and while that works, once more. Single
//! parts of the last sheet are thrown on the others likewise, so that more of it is left. The last
//! sheet may at the end be one of a cheaper kind that takes its parts, too, and they are
//! squeezed together, so that the rest of it can be used.

use super::fill::{fits, lay_on, order};
use super::layout::{Pose, Room};
use super::separate::{Budget, Patience, restore, separate};
use super::shape::Shape;
use super::squeeze::squeeze;
use super::state::{Item, State};
use super::turns::Turns;
use super::{NestForm, NestSheet, rectangle};
use sheetwright_geometry::math::{Point2, Vec2};
use sheetwright_geometry::offset;
use sheetwright_geometry::predicate::{Box2, signed_area_doubled};
use sheetwright_geometry::random::Random;
use std::collections::BTreeSet;

const PATIENCE: Patience = Patience { rounds: 60, strikes: 2 };
/// An attempt to do without a sheet may use this share of what is left of the budget.
const ATTEMPT: f64 = 0.4;
/// Throwing a single part on a fuller sheet may use this share of the budget.
const SINGLE: f64 = 0.02;
/// All of that may use this share of it.
const SINGLES: f64 = 0.5;
/// No layout covers more than this share of its sheets in sensible time.
const DENSEST: f64 = 0.95;
/// More parts than this are not separated together: their pairs would fill the memory.
const MOST_TOGETHER: usize = 2_000;

/// The kinds of sheets, each lying so that its grain runs along x.
pub(super) struct Kinds<'a> {
    sheets: &'a [NestSheet],
    rooms: Vec<Option<Room>>,
    /// The kinds, those first that are taken first.
    order: Vec<usize>,
}

impl<'a> Kinds<'a> {
    /// The kinds; forms lie `inset` mm inside their edges.
    pub(super) fn new(sheets: &'a [NestSheet], inset: f64) -> Self {
        let room = |sheet: &NestSheet| {
            let room = match &sheet.form {
                NestForm::Rectangle([w, h]) => rectangle([w.max(*h), w.min(*h)], inset),
                NestForm::Roll(width) => rectangle([0.0, *width], inset),
                NestForm::Outline(points) => outline(points, inset)?,
            };
            Some(room).filter(|room| room.high.y > room.low.y)
        };
        let mut order: Vec<usize> = (0..sheets.len()).collect();
        let rank = |&n: &usize| {
            let is_offcut = matches!(sheets[n].form, NestForm::Outline(_));
            (!is_offcut, price(&sheets[n]), -area(&sheets[n]))
        };
        order.sort_by(|a, b| {
            let (a, b) = (rank(a), rank(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2))
        });
        Self { sheets, rooms: sheets.iter().map(room).collect(), order }
    }

    fn is_roll(&self, kind: usize) -> bool {
        matches!(self.sheets[kind].form, NestForm::Roll(_))
    }

    /// Whether a form fits on a sheet of some kind.
    pub(super) fn fit(
        &self,
        shape: &Shape,
        turns: &Turns,
        budget: &mut Budget<'_>,
        random: &mut Random,
    ) -> bool {
        let shapes = std::slice::from_ref(shape);
        let items = [Item { shape: 0, turns: turns.clone(), group: None }];
        let state = State::new(shapes, &items);
        (0..self.sheets.len()).any(|kind| {
            self.rooms[kind].as_ref().is_some_and(|room| {
                let mut room = room.clone();
                if self.is_roll(kind) {
                    room.high.x = room.low.x + 2.1 * shape.radius;
                }
                fits(&state, 0, &room, budget, random)
            })
        })
    }
}

/// The area of a sheet, mm²; of a roll, of a metre of it.
fn area(sheet: &NestSheet) -> f64 {
    match &sheet.form {
        NestForm::Rectangle([w, h]) => w * h,
        NestForm::Roll(width) => 1000.0 * width,
        NestForm::Outline(points) => 0.5 * signed_area_doubled(points),
    }
}

/// What a sheet costs for its area.
fn price(sheet: &NestSheet) -> f64 {
    sheet.cost.map_or(1.0, |cost| cost / area(sheet))
}

/// The room on an offcut: what lies `inset` mm from its edges. All around the offcut grows by that,
/// and leaves a hole.
fn outline(points: &[Point2], inset: f64) -> Option<Room> {
    let mut room = points.to_vec();
    if inset > 0.0 {
        let Box2 { min, max } = Box2::of_points(points.iter().copied())?;
        let (min, max) = (min + Vec2::splat(-inset), max + Vec2::splat(inset));
        let frame = vec![min, Point2::new(max.x, min.y), max, Point2::new(min.x, max.y)];
        room.reverse();
        let around = offset::grown(&[frame, room], inset).into_iter().next()?;
        let area = |line: &Vec<Point2>| signed_area_doubled(line).abs();
        room = around.holes.into_iter().max_by(|a, b| area(a).total_cmp(&area(b)))?;
        room.reverse();
    }
    let Box2 { min, max } = Box2::of_points(room.iter().copied())?;
    Some(Room::new(min.to_vec(), max.to_vec(), room))
}

/// Which kinds the sheets of a state are of.
pub(super) struct Laid<'a> {
    kinds: &'a Kinds<'a>,
    of: Vec<usize>,
}

impl<'a> Laid<'a> {
    pub(super) fn new(kinds: &'a Kinds<'a>) -> Self {
        Self { kinds, of: Vec::new() }
    }

    pub(super) fn kind(&self, sheet: usize) -> usize {
        self.of[sheet]
    }

    /// Whether the sheet is higher than wide, and so was turned on its side.
    pub(super) fn is_upright(&self, sheet: usize) -> bool {
        matches!(self.kinds.sheets[self.of[sheet]].form, NestForm::Rectangle([w, h]) if h > w)
    }

    /// The width and height of a sheet; of a roll, what is used of it.
    pub(super) fn size(&self, state: &State<'_>, sheet: usize) -> [f64; 2] {
        match &self.kinds.sheets[self.of[sheet]].form {
            NestForm::Rectangle(size) => *size,
            NestForm::Roll(width) => [state.reach(sheet) + state.rooms[sheet].low.x, *width],
            NestForm::Outline(points) => {
                let around = Box2::of_points(points.iter().copied());
                around.map_or([0.0; 2], |it| (it.max - it.min).to_array())
            }
        }
    }

    /// Lays all parts down; returns those for which no sheet is left.
    pub(super) fn fill(
        &mut self,
        state: &mut State<'_>,
        budget: &mut Budget<'_>,
        random: &mut Random,
    ) -> Vec<usize> {
        let mut left_over = Vec::new();
        // A sheet that refused a form has no more room for it later: sheets only fill up.
        let mut refused: BTreeSet<(usize, usize)> = BTreeSet::new();
        for group in order(state) {
            let key = |sheet: usize| match group[..] {
                [item] if !self.kinds.is_roll(self.of[sheet]) => {
                    Some((sheet, state.items[item].shape))
                }
                _ => None,
            };
            let open: Vec<(usize, Option<(usize, usize)>)> =
                (0..state.rooms.len()).map(|sheet| (sheet, key(sheet))).collect();
            let is_laid = open.into_iter().any(|(sheet, key)| {
                if key.is_some_and(|key| refused.contains(&key)) {
                    return false;
                }
                let is_laid = self.lay_group(state, &group, sheet, budget, random);
                refused.extend(key.filter(|_| !is_laid));
                is_laid
            });
            if is_laid {
                continue;
            }
            let mut is_laid = false;
            for &kind in &self.kinds.order {
                let Some(room) = &self.kinds.rooms[kind] else { continue };
                let taken = self.of.iter().filter(|&&other| other == kind).count();
                if self.kinds.sheets[kind].count.is_some_and(|count| taken >= count) {
                    continue;
                }
                let sheet = state.open(room.clone());
                self.of.push(kind);
                if self.lay_group(state, &group, sheet, budget, random) {
                    is_laid = true;
                    break;
                }
                state.rooms.pop();
                state.on.pop();
                self.of.pop();
            }
            if !is_laid {
                left_over.extend(group);
            }
        }
        left_over.sort_unstable();
        left_over
    }

    /// Lays parts on a sheet, all or none; whether they were laid.
    fn lay_group(
        &self,
        state: &mut State<'_>,
        group: &[usize],
        sheet: usize,
        budget: &mut Budget<'_>,
        random: &mut Random,
    ) -> bool {
        for (n, &item) in group.iter().enumerate() {
            if self.kinds.is_roll(self.of[sheet]) {
                state.rooms[sheet].high.x = state.reach(sheet) + 2.1 * state.shape(item).radius;
            }
            if !lay_on(state, item, sheet, budget, random) {
                group[..n].iter().for_each(|&item| state.take_up(item));
                return false;
            }
        }
        true
    }

    /// Does without sheets where that can be, and squeezes the last.
    pub(super) fn improve(
        &mut self,
        state: &mut State<'_>,
        budget: &mut Budget<'_>,
        random: &mut Random,
    ) {
        while !budget.is_over() && self.without_one(state, budget, random) {}
        let Some(last) = state.least_used() else { return };
        self.fuller(state, last, budget, random);
        let Some(last) = state.least_used() else { return };
        self.cheaper(state, last, budget, random);
        for sheet in state.used() {
            let is_roll = self.kinds.is_roll(self.of[sheet]);
            let has_outline = !state.rooms[sheet].outline.is_empty();
            let too_many = state.on[sheet].len() > MOST_TOGETHER;
            if (is_roll || sheet == last) && !has_outline && !too_many {
                let width = state.rooms[sheet].high.y - state.rooms[sheet].low.y;
                squeeze(state, sheet, state.area(sheet) / width, budget, random);
            }
        }
    }

    /// The sheets with parts on them but for one, and without rolls.
    fn sheets_beside(&self, state: &State<'_>, one: usize) -> Vec<usize> {
        let mut used = state.used();
        used.retain(|&sheet| sheet != one && !self.kinds.is_roll(self.of[sheet]));
        used
    }

    /// Empties the sheet with least on it into the others; whether that could be.
    fn without_one(
        &self,
        state: &mut State<'_>,
        budget: &mut Budget<'_>,
        random: &mut Random,
    ) -> bool {
        let Some(least) = state.least_used() else { return false };
        let others = self.sheets_beside(state, least);
        let room: f64 =
            others.iter().map(|&s| DENSEST * state.rooms[s].area() - state.area(s)).sum();
        let count: usize = others.iter().map(|&s| state.on[s].len()).sum();
        let moved = state.on[least].clone();
        if others.is_empty() || room < state.area(least) || count + moved.len() > MOST_TOGETHER {
            return false;
        }
        let before = state.poses.clone();
        let groups: Vec<Vec<usize>> = order(state)
            .into_iter()
            .map(|group| group.into_iter().filter(|item| moved.contains(item)).collect())
            .filter(|group: &Vec<usize>| !group.is_empty())
            .collect();
        for group in groups {
            if others.iter().any(|&sheet| {
                group.iter().for_each(|&item| state.take_up(item));
                self.lay_group(state, &group, sheet, budget, random)
            }) {
                continue;
            }
            let sheet = others[random.below(others.len())];
            for &item in &group {
                self.throw(state, item, sheet, random);
            }
        }
        let rest = ((1.0 - ATTEMPT) * budget.left as f64) as i64;
        let mut attempt = Budget { left: budget.left - rest, stop: &mut *budget.stop };
        let loss = separate(state, &others, PATIENCE, &mut attempt, random);
        budget.left = rest + attempt.left;
        if loss > 0.0 {
            restore(state, &before);
        }
        loss == 0.0
    }

    /// Throws single parts of the last sheet, the largest first, on the sheet with most room, where
    /// they can be separated.
    fn fuller(
        &self,
        state: &mut State<'_>,
        last: usize,
        budget: &mut Budget<'_>,
        random: &mut Random,
    ) {
        let mut others = self.sheets_beside(state, last);
        others.retain(|&sheet| state.on[sheet].len() < MOST_TOGETHER);
        let single = (SINGLE * budget.left as f64) as i64;
        let least = ((1.0 - SINGLES) * budget.left as f64) as i64;
        // Forms that found no place.
        let mut refused: BTreeSet<usize> = BTreeSet::new();
        for item in order(state).into_iter().flatten() {
            let is_on_last = state.poses[item].is_some_and(|pose| pose.sheet == last);
            let shape = state.items[item].shape;
            if !is_on_last || state.items[item].group.is_some() || refused.contains(&shape) {
                continue;
            }
            let left = |&sheet: &usize| DENSEST * state.rooms[sheet].area() - state.area(sheet);
            let most = others.iter().max_by(|a, b| left(a).total_cmp(&left(b)));
            let Some(&sheet) = most.filter(|most| left(most) >= state.shape(item).area) else {
                continue;
            };
            if budget.left < least || budget.is_over() {
                return;
            }
            let before = state.poses.clone();
            self.throw(state, item, sheet, random);
            let rest = budget.left - single.min(budget.left);
            let mut attempt = Budget { left: budget.left - rest, stop: &mut *budget.stop };
            let loss = separate(state, &[sheet], PATIENCE, &mut attempt, random);
            budget.left = rest + attempt.left;
            if loss > 0.0 {
                restore(state, &before);
                refused.insert(shape);
            }
        }
    }

    /// Lays a part somewhere on a sheet.
    fn throw(&self, state: &mut State<'_>, item: usize, sheet: usize, random: &mut Random) {
        let room = &state.rooms[sheet];
        let x = random.between(room.low.x, room.high.x);
        let y = random.between(room.low.y, room.high.y);
        let (turn, is_over) = state.items[item].turns.any(state.shape(item), random);
        state.lay(item, Pose { sheet, at: Point2::new(x, y), turn, is_over });
    }

    /// Takes a cheaper kind for a sheet if its parts fit there, too.
    fn cheaper(
        &mut self,
        state: &mut State<'_>,
        sheet: usize,
        budget: &mut Budget<'_>,
        random: &mut Random,
    ) {
        let cost = |kind: usize| {
            let sheet = &self.kinds.sheets[kind];
            sheet.cost.unwrap_or_else(|| area(sheet))
        };
        let own = self.of[sheet];
        let parts = state.on[sheet].clone();
        if self.kinds.is_roll(own) || parts.len() > MOST_TOGETHER {
            return;
        }
        let mut kinds: Vec<usize> = (0..self.kinds.sheets.len())
            .filter(|&kind| !self.kinds.is_roll(kind) && cost(kind) < cost(own))
            .collect();
        kinds.sort_by(|&a, &b| cost(a).total_cmp(&cost(b)));
        for kind in kinds {
            let Some(room) = self.kinds.rooms[kind].clone() else { continue };
            let taken = self.of.iter().filter(|&&other| other == kind).count();
            let is_left = self.kinds.sheets[kind].count.is_none_or(|count| taken < count);
            if !is_left || DENSEST * room.area() < state.area(sheet) {
                continue;
            }
            let (before, room_before) = (state.poses.clone(), state.rooms[sheet].clone());
            state.rooms[sheet] = room;
            parts.iter().for_each(|&item| state.take_up(item));
            let is_laid = order(state).iter().all(|group| {
                let own: Vec<usize> =
                    group.iter().copied().filter(|item| parts.contains(item)).collect();
                own.is_empty() || self.lay_group(state, &own, sheet, budget, random)
            });
            if is_laid {
                self.of[sheet] = kind;
                return;
            }
            state.rooms[sheet] = room_before;
            restore(state, &before);
        }
    }
}
