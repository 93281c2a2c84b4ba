//! Texts that belong to a place on an edge, the marks of seams and the numbers of ticks: each
//! stands beside its tick or, where something is in its way, at the nearest free place along the
//! edge.
//!
//! They have their places before all other texts, which keep clear of them. A text goes by steps of
//! half its height, ahead and back by turns, along the line that its tick stands on, and no farther
//! than where its own tick is the nearest, nor round a corner. Where no such place is free, a mark
//! stands beyond the edge, and is read before that is cut; where that is not free either, a line
//! leads from the tick to it. A number stays beside its tick, and so does a mark without any place.

use super::placer::Placer;
use super::seam::beside;
use super::text_box::TextBox;
use super::{LabelKind, PathKind, PatternLabel, PatternPath, Role};
use sheetwright_geometry::math::{Point2, Vec2, unit2};

/// A step along the edge, as a share of the height of the text.
const STEP: f64 = 0.5;
/// More ticks than this leave no room beside one another: their numbers stay where they are.
const MOST_FEET: usize = 2_000;
/// So many steps are tried ahead, and as many back.
const STEPS: u16 = 24;
/// The cosine of the turn that ends an edge for its texts, 30°.
const TURNS: f64 = 0.866;
/// The base line of a mark beyond an edge lies so far from it, as a share of the text's height: the
/// gap that letters have inside, and letters with dots.
const BEYOND: f64 = 0.4 + 7.0 / 6.0;

/// Whether a text has its place here.
pub(super) fn is_settled(kind: LabelKind) -> bool {
    matches!(kind, LabelKind::Mark | LabelKind::Trim)
}

/// Gives the texts of edges their places, among those that have one. `net` are the loops of the
/// finished piece, whose `paths` have the ticks.
pub(super) fn settle(
    labels: &mut [PatternLabel],
    paths: &[PatternPath],
    net: &[&[Point2]],
    placer: &mut Placer,
) {
    let mut seams = ticks(paths, PathKind::SeamTick);
    let feet: Vec<Point2> = [PathKind::SeamTick, PathKind::TrimTick]
        .into_iter()
        .flat_map(|kind| ticks(paths, kind))
        .map(|[foot, _]| foot)
        .collect();
    let is_roomy = feet.len() <= MOST_FEET;
    for label in labels.iter_mut().filter(|label| is_settled(label.kind)) {
        let foot = match label.kind {
            LabelKind::Mark => seams.next().map(|[foot, inside]| {
                // It may have moved when the piece had other lines.
                (label.at, label.along) = beside(&label.text, label.height_mm, foot, inside);
                label.role = Role::Engrave;
                foot
            }),
            _ if !is_roomy => None,
            _ => {
                let ahead_mm = ahead_of_tick_mm(&label.text, label.height_mm);
                numbered_tick(label, label.at + label.along * -ahead_mm, paths)
            }
        };
        // A text without a tick, such as the angle of a flange, is that of a whole line.
        if let Some(foot) = foot.filter(|_| is_roomy) {
            let is_mark = label.kind == LabelKind::Mark;
            let tick = Tick { foot, feet: &feet, net };
            let place = tick
                .free(label, placer)
                .or_else(|| is_mark.then(|| tick.beyond(label, placer)).flatten())
                .or_else(|| is_mark.then(|| placer.led(label, foot)).flatten());
            if let Some(place) = place {
                *label = place;
            }
        }
        placer.keep(label);
    }
}

/// The ticks of a kind, in order, each from the edge inwards.
fn ticks(paths: &[PatternPath], kind: PathKind) -> impl Iterator<Item = [Point2; 2]> + '_ {
    let ticks = paths.iter().filter(move |path| path.kind == kind);
    ticks.filter_map(|tick| tick.points.first_chunk().copied())
}

/// How far ahead of its tick the middle of a number stands, mm, where there is room.
pub(crate) fn ahead_of_tick_mm(number: &str, height_mm: f64) -> f64 {
    height_mm * (0.5 + 0.4 * number.chars().count() as f64)
}

/// Where the tick stands on the edge whose number a text of a trim is; `None` of another text.
pub(super) fn tick_of(label: &PatternLabel, paths: &[PatternPath]) -> Option<Point2> {
    numbered_tick(label, TextBox::of(label).middle, paths)
}

/// The foot of the tick of a trim that stands nearest to a place, if a text is a number.
fn numbered_tick(label: &PatternLabel, at: Point2, paths: &[PatternPath]) -> Option<Point2> {
    let is_number = label.kind == LabelKind::Trim && label.text.parse::<usize>().is_ok();
    let feet = ticks(paths, PathKind::TrimTick).map(|[foot, _]| foot).filter(|_| is_number);
    feet.min_by(|a, b| a.distance(at).total_cmp(&b.distance(at)))
}

/// The tick of a text, on an edge of the net.
struct Tick<'a> {
    foot: Point2,
    /// Where all ticks stand.
    feet: &'a [Point2],
    net: &'a [&'a [Point2]],
}

impl Tick<'_> {
    /// The text at the first free place inside its edge, if there is one.
    fn free(&self, label: &PatternLabel, placer: &Placer) -> Option<PatternLabel> {
        let off = label.at - self.foot;
        let [ahead_mm, up_mm] = [off.dot(label.along), off.dot(label.along.perp())];
        let is_free = |label: &PatternLabel| placer.is_free(label) && self.is_nearest(label);
        if is_free(label) {
            return Some(label.clone());
        }
        self.places(label, [ahead_mm, up_mm]).find(is_free)
    }

    /// A mark at the first free place beyond its edge, to read, if there is one.
    fn beyond(&self, label: &PatternLabel, placer: &Placer) -> Option<PatternLabel> {
        let label = PatternLabel { role: Role::Note, ..label.clone() };
        let is_free = |label: &PatternLabel| placer.is_free_beyond(label) && self.is_nearest(label);
        self.places(&label, [0.0, -BEYOND * label.height_mm]).find(is_free)
    }

    /// Whether no other tick is nearer to a text.
    fn is_nearest(&self, label: &PatternLabel) -> bool {
        let middle = TextBox::of(label).middle;
        let off_mm = self.foot.distance(middle);
        self.feet.iter().all(|other| other.distance(middle) >= off_mm)
    }

    /// A text beside the edge, so far ahead of the tick and above the edge at first, mm, then by
    /// steps ahead and back, as far as the edge does not turn.
    fn places(
        &self,
        label: &PatternLabel,
        [ahead_mm, up_mm]: [f64; 2],
    ) -> impl Iterator<Item = PatternLabel> {
        let edge = Loop::nearest(self.net, self.foot);
        let steps = (1..=STEPS).flat_map(|n| [f64::from(n), -f64::from(n)]);
        std::iter::once(0.0).chain(steps).filter_map(move |n| {
            let (at, along) = edge.as_ref()?.at(ahead_mm + n * STEP * label.height_mm)?;
            let is_on = along.dot(label.along) >= TURNS;
            is_on.then(|| PatternLabel { at: at + along.perp() * up_mm, along, ..label.clone() })
        })
    }
}

/// A loop of the net, and a place on it.
struct Loop<'a> {
    points: &'a [Point2],
    /// How far along it each side begins, mm, and its whole length.
    starts_mm: Vec<f64>,
    /// How far along it the place lies, mm.
    along_mm: f64,
}

impl<'a> Loop<'a> {
    /// The loop that passes nearest to a point, and where it does.
    fn nearest(net: &[&'a [Point2]], point: Point2) -> Option<Self> {
        let all = net.iter().flat_map(|&points| {
            let sides = sides(points).enumerate();
            sides.map(move |(n, side)| (point.distance_to_segment(side), points, n, side))
        });
        let (_, points, side, [a, b]) = all.min_by(|one, other| one.0.total_cmp(&other.0))?;
        let mut starts_mm = vec![0.0];
        for [a, b] in sides(points) {
            starts_mm.push(starts_mm[starts_mm.len() - 1] + a.distance(b));
        }
        let on_mm = unit2(b - a).map_or(0.0, |way| way.dot(point - a));
        let along_mm = starts_mm[side] + on_mm.clamp(0.0, a.distance(b));
        Some(Self { points, starts_mm, along_mm })
    }

    /// The point so far ahead of the place, mm, and the direction of the loop there.
    fn at(&self, ahead_mm: f64) -> Option<(Point2, Vec2)> {
        let (whole_mm, starts_mm) = self.starts_mm.split_last()?;
        let along_mm = (self.along_mm + ahead_mm).rem_euclid(*whole_mm);
        let next = starts_mm.partition_point(|start_mm| *start_mm < along_mm);
        let of_side = |n: usize| {
            let [a, b] = [n, (n + 1) % self.points.len()].map(|n| self.points[n]);
            unit2(b - a).map(|way| (a + way * (along_mm - starts_mm[n]), way))
        };
        // The side before the next, unless that has no length.
        (next.saturating_sub(1)..starts_mm.len()).find_map(of_side)
    }
}

/// The sides of a closed line, each from a point to the next.
fn sides(line: &[Point2]) -> impl Iterator<Item = [Point2; 2]> + '_ {
    line.iter().zip(line.iter().cycle().skip(1)).map(|(&a, &b)| [a, b])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loop_is_followed_ahead_and_back_over_points_that_stand_twice() {
        let p = Point2::new;
        let square = [p(0.0, 0.0), p(4.0, 0.0), p(4.0, 0.0), p(4.0, 4.0), p(0.0, 4.0), p(0.0, 0.0)];
        let far = [p(50.0, 50.0), p(60.0, 50.0), p(50.0, 60.0)];
        let found = Loop::nearest(&[&far, &square], p(3.0, -0.5)).unwrap();
        assert_eq!(found.at(0.0), Some((p(3.0, 0.0), Vec2::X)));
        assert_eq!(found.at(1.0), Some((p(4.0, 0.0), Vec2::X)));
        assert_eq!(found.at(2.5), Some((p(4.0, 1.5), Vec2::Y)));
        assert_eq!(found.at(-4.0), Some((p(0.0, 1.0), -Vec2::Y)));
        assert_eq!(found.at(18.5), found.at(2.5));
        assert!(Loop::nearest(&[], p(0.0, 0.0)).is_none());
        let point = [p(1.0, 1.0); 2];
        assert_eq!(Loop::nearest(&[&point], p(0.0, 0.0)).unwrap().at(1.0), None);
    }
}
