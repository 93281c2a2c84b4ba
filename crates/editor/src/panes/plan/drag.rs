//! Handles on their way over the plan.

use super::snap::Snap;
use crate::document::PointRef;
use crate::scene::Scene;
use sheetwright::draw::settle::point_at;
use sheetwright::math::{Point2, Point3};

/// Handles on their way.
pub(super) struct Drag {
    /// The one under the hand.
    pub(super) held: PointRef,
    /// Where each lay in space when it was taken hold of, mm.
    from: Vec<(PointRef, Point3)>,
    /// All that move, in order: with them those of other curves on their spots.
    pub(super) moving: Vec<PointRef>,
    /// Where the hand took hold, less the handle, mm.
    pub(super) grip: Point2,
}

impl Drag {
    /// The hand takes hold of a handle, at a place of the plan, and with it of these points, which
    /// are in order.
    pub(super) fn new(
        held: PointRef,
        points: &[PointRef],
        hand: Point2,
        scene: &Scene<'_>,
    ) -> Option<Self> {
        let all = || all_points(scene);
        let from: Vec<(PointRef, Point3)> =
            all().filter(|(r, _)| points.binary_search(r).is_ok()).collect();
        let (_, at) = *from.iter().find(|(r, _)| *r == held)?;
        let here = scene.document.drawing.plan.flat(at);
        let grip = Point2::new(hand.x - here.x, hand.y - here.y);
        let goes = |(_, at): &(PointRef, Point3)| from.iter().any(|(_, moved)| moved == at);
        let moving = all().filter(goes).map(|(r, _)| r).collect();
        Some(Self { held, from, moving, grip })
    }

    /// Where every handle goes if the one under the hand goes to a place of the plan: across the
    /// plan alone; on a point that it settled on, to where that lies in space.
    pub(super) fn moved(
        &self,
        to: Point2,
        snaps: &[Snap],
        scene: &Scene<'_>,
    ) -> Vec<(PointRef, Point3)> {
        let plan = scene.document.drawing.plan;
        let Some((_, held)) = self.from.iter().find(|(r, _)| *r == self.held) else {
            return Vec::new();
        };
        let at = plan.flat(*held);
        let by = Point2::new(to.x - at.x, to.y - at.y);
        let other = match snaps {
            [Snap::Point(p)] => self.settled_on(*p, scene),
            _ => None,
        };
        let lifted = other.map_or(0.0, |other| plan.lift(other) - plan.lift(*held));
        let place = |&(r, from): &(PointRef, Point3)| {
            if let Some(other) = other.filter(|_| from == *held) {
                return (r, other);
            }
            let flat = plan.flat(from);
            let there = Point2::new(flat.x + by.x, flat.y + by.y);
            (r, plan.space(there, plan.lift(from) + lifted))
        };
        self.from.iter().map(place).collect()
    }

    /// Whether a handle is on its way.
    pub(super) fn moves(&self, of: PointRef) -> bool {
        self.moving.binary_search(&of).is_ok()
    }

    /// Whether the handle under the hand may settle on another. On a smooth run two handles on one
    /// spot make no curve; ends of other curves do.
    pub(super) fn may_meet(&self, other: PointRef) -> bool {
        other.curve != self.held.curve && !self.moves(other)
    }

    /// Where the point lies in space that the hand settled on: of several the one on top.
    fn settled_on(&self, place: Point2, scene: &Scene<'_>) -> Option<Point3> {
        let plan = scene.document.drawing.plan;
        let others = all_points(scene).filter(|(r, _)| self.may_meet(*r)).map(|(_, at)| at);
        point_at(others, place, |p| plan.flat(p), |p| plan.lift(p))
    }
}

/// Every point of every curve, and where it lies in space, mm.
fn all_points<'a>(scene: &Scene<'a>) -> impl Iterator<Item = (PointRef, Point3)> + use<'a> {
    let curves = scene.document.design.curves.iter().enumerate();
    curves.flat_map(|(curve, of)| {
        let points = of.points.iter().enumerate();
        points.map(move |(point, p)| (PointRef { curve, point }, p.at))
    })
}
