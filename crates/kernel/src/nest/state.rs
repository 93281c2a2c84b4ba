//! All parts where they lie, and which of them collide how badly.

use super::layout::{Placed, Pose, Room, Work, collision};
use super::shape::Shape;
use super::turns::Turns;

/// A part that is laid out.
#[derive(Clone, Debug)]
pub(super) struct Item {
    /// Its form, by its number.
    pub(super) shape: usize,
    pub(super) turns: Turns,
    /// Parts of one group lie on one sheet.
    pub(super) group: Option<usize>,
}

/// A state of the search.
#[derive(Clone)]
pub(super) struct State<'a> {
    pub(super) shapes: &'a [Shape],
    pub(super) items: &'a [Item],
    pub(super) rooms: Vec<Room>,
    /// Where each lies; `None`: nowhere yet.
    pub(super) poses: Vec<Option<Pose>>,
    pub(super) placed: Vec<Placed>,
    /// The items on each sheet, in order.
    pub(super) on: Vec<Vec<usize>>,
}

impl<'a> State<'a> {
    pub(super) fn new(shapes: &'a [Shape], items: &'a [Item]) -> Self {
        Self {
            shapes,
            items,
            rooms: Vec::new(),
            poses: vec![None; items.len()],
            placed: vec![Placed::default(); items.len()],
            on: Vec::new(),
        }
    }

    pub(super) fn shape(&self, item: usize) -> &'a Shape {
        &self.shapes[self.items[item].shape]
    }

    /// Opens a sheet, and returns its number.
    pub(super) fn open(&mut self, room: Room) -> usize {
        self.rooms.push(room);
        self.on.push(Vec::new());
        self.rooms.len() - 1
    }

    pub(super) fn take_up(&mut self, item: usize) {
        if let Some(pose) = self.poses[item].take() {
            self.on[pose.sheet].retain(|&other| other != item);
        }
    }

    pub(super) fn lay(&mut self, item: usize, pose: Pose) {
        self.take_up(item);
        let shape = self.shape(item);
        self.placed[item].set(shape, &pose);
        self.poses[item] = Some(pose);
        let list = &mut self.on[pose.sheet];
        let at = list.partition_point(|&other| other < item);
        list.insert(at, item);
    }

    /// Whether a part would collide there with its sheet or with what lies on it.
    pub(super) fn is_free(
        &self,
        item: usize,
        pose: &Pose,
        placed: &Placed,
        work: &mut Work,
    ) -> bool {
        let shape = self.shape(item);
        self.rooms[pose.sheet].left(shape, placed, work) == 0.0
            && self.on[pose.sheet].iter().all(|&other| {
                other == item
                    || collision((shape, placed), (self.shape(other), &self.placed[other]), work)
                        == 0.0
            })
    }

    /// The sheets with parts on them.
    pub(super) fn used(&self) -> Vec<usize> {
        (0..self.rooms.len()).filter(|&sheet| !self.on[sheet].is_empty()).collect()
    }

    /// The one of them whose parts have the least area, the last of equals.
    pub(super) fn least_used(&self) -> Option<usize> {
        let by_area = |a: &usize, b: &usize| self.area(*a).total_cmp(&self.area(*b));
        self.used().into_iter().rev().min_by(by_area)
    }

    /// How far the parts on a sheet reach along it.
    pub(super) fn reach(&self, sheet: usize) -> f64 {
        self.on[sheet]
            .iter()
            .map(|&n| self.placed[n].high.x)
            .fold(self.rooms[sheet].low.x, f64::max)
    }

    /// The area of the parts on a sheet, mm².
    pub(super) fn area(&self, sheet: usize) -> f64 {
        self.on[sheet].iter().map(|&n| self.shape(n).area).sum()
    }
}
