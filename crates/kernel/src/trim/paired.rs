//! What stands on two joined edges at once: tabs, joints, holes, notches and ticks.

use super::cut::TrimNote;
use super::holes::{distance_mm, drilled};
use super::joints::{Jointed, fingers, puzzle, slots};
use super::notches::{notched, ticked};
use super::part::TrimPart;
use super::places::{of_holes, of_marks};
use super::stretch::{Spot, Stretch};
use super::tabs::{Side, Tab, tabs};
use super::{Faulted, TrimFault, Work, is_joint};
use crate::design::{Holes, Notches, Tabs, Ticks, TrimKind};
use crate::edge::{EdgePlace, Shared, lengths};
use crate::pattern::{PathKind, PatternPath, Role};
use sheetwright_geometry::math::{Point2, Point3};

/// A notch as deep as the strip is wide is not too deep for rounding, mm.
const ROUNDING_MM: f64 = 1e-9;

/// Two joined edges, or one that a trim stands on alone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    /// The edge that the trim stands on.
    first: EdgePlace,
    /// The edge that it is joined to, with whether the trim stands on that, too.
    second: Option<(EdgePlace, bool)>,
    /// A stretch that both share; of one edge, its whole length.
    shared: Shared,
}

/// The pairs of the edges that a trim stands on: each joint once, and as often as it has stretches
/// apart.
pub(super) fn pairs(parts: &[TrimPart<'_>], on: &[(EdgePlace, bool)]) -> Vec<Pair> {
    let is_on = |place: EdgePlace| on.iter().any(|&(other, _)| other == place);
    let mut pairs = Vec::new();
    for &(first, _) in on {
        let edge = &parts[first.part].edges[first.edge];
        if edge.mates.is_empty() {
            let space = parts[first.part].space;
            let points: Vec<Point3> = edge.run.iter().map(|&v| space[v]).collect();
            let whole = [0.0, lengths(&points).last().copied().unwrap_or(0.0)];
            let shared = Shared { first: whole, second: whole };
            pairs.push(Pair { first, second: None, shared });
        }
        for (&mate, common) in edge.mates.iter().zip(&edge.common) {
            // Of two edges that the trim stands on, the first one speaks for both.
            if is_on(mate) && mate < first {
                continue;
            }
            let second = Some((mate, is_on(mate)));
            pairs.extend(common.iter().map(|&shared| Pair { first, second, shared }));
        }
    }
    pairs
}

impl Pair {
    /// Whether another pair is a stretch of the joint that this one is of.
    fn is_of_joint(&self, other: &Self) -> bool {
        self.first == other.first && self.second == other.second
    }

    /// The edges of it.
    fn places(&self) -> impl Iterator<Item = EdgePlace> {
        std::iter::once(self.first).chain(self.second.map(|(mate, _)| mate))
    }
}

impl Work<'_> {
    fn stretch(&self, place: EdgePlace) -> &Stretch {
        &self.stretches[place.part][place.edge]
    }

    fn edge_name(&self, place: EdgePlace) -> String {
        let part = &self.parts[place.part];
        part.called(&part.edges[place.edge])
    }

    /// What the pattern shows of an edge, for notes.
    fn shown(&self, place: EdgePlace) -> String {
        self.parts[place.part].shown(place.edge)
    }

    /// The length along each edge of a pair at a share of what they have in common.
    fn lengths_at(pair: &Pair, share: f64) -> [f64; 2] {
        [pair.shared.first, pair.shared.second].map(|[from, to]| from + share * (to - from))
    }

    /// The places on both edges of a pair at a share of what they have in common.
    fn spots(&self, pair: &Pair, share: f64) -> Vec<(EdgePlace, f64, Spot)> {
        let lengths = Self::lengths_at(pair, share);
        let spot = |(place, along): (EdgePlace, f64)| {
            let along = self.stretch(place).within(along);
            (place, along, self.stretch(place).at(along))
        };
        pair.places().zip(lengths).map(spot).collect()
    }

    /// Tabs, fingers, puzzle joints and slots.
    pub(super) fn join(&mut self) -> Result<(), Faulted> {
        let trims = self.trims;
        for (number, trim) in trims.iter().enumerate().filter(|(_, trim)| is_joint(&trim.kind)) {
            let pairs = self.pairs(number);
            for of_joint in pairs.chunk_by(Pair::is_of_joint) {
                let pair = of_joint[0];
                let Some((mate, is_on_both)) = pair.second else { continue };
                let holds = |place: EdgePlace| {
                    let moving = &self.moving[place.part][place.edge];
                    moving.iter().any(|&(moved_by, _)| moved_by == number)
                };
                if !holds(pair.first) || !holds(mate) {
                    continue;
                }
                if let TrimKind::Tabs(tabs) = &trim.kind {
                    self.add_tabs(of_joint, [pair.first, mate], is_on_both, tabs);
                    continue;
                }
                for pair in of_joint {
                    let jointed = self.jointed(pair, mate, &trim.kind)?;
                    if let Some(jointed) = jointed {
                        self.add_joint([pair.first, mate], jointed);
                    }
                }
            }
        }
        Ok(())
    }

    /// What a trim of this kind adds and removes along a stretch of a joint; `None` if it is none
    /// that interlocks.
    fn jointed(
        &self,
        pair: &Pair,
        mate: EdgePlace,
        kind: &TrimKind,
    ) -> Result<Option<Jointed>, Faulted> {
        let stretches = [self.stretch(pair.first), self.stretch(mate)];
        Ok(Some(match kind {
            TrimKind::Fingers(kind) => fingers(stretches, &pair.shared, kind),
            TrimKind::Puzzle(kind) => puzzle(stretches, &pair.shared, kind),
            TrimKind::Slots(kind) => {
                let called = || self.edge_name(mate);
                let made = slots(stretches, &pair.shared, kind, called);
                made.map_err(|fault| (Some(mate.part), fault))?
            }
            _ => return Ok(None),
        }))
    }

    fn add_joint(&mut self, places: [EdgePlace; 2], jointed: Jointed) {
        let Jointed { added, removed, slots } = jointed;
        self.made[places[1].part].slotted.extend(slots);
        for (place, (added, removed)) in places.into_iter().zip(added.into_iter().zip(removed)) {
            self.made[place.part].added.extend(added);
            self.made[place.part].carved.extend(removed);
        }
    }

    /// Tabs on that side of a joint that has more room for them, or on the one that was named: the
    /// same side along all of its stretches.
    fn add_tabs(
        &mut self,
        of_joint: &[Pair],
        places: [EdgePlace; 2],
        may_choose: bool,
        kind: &Tabs,
    ) {
        let side = |place: EdgePlace| Side {
            stretch: self.stretch(place),
            net: &self.nets[place.part],
            beyond: &self.made[place.part].added,
        };
        let length = |shared: &Shared| shared.first[1] - shared.first[0];
        let whole: f64 = of_joint.iter().map(|pair| length(&pair.shared)).sum();
        let along = |own: EdgePlace, mate: EdgePlace, is_first: bool| {
            let (mut all, mut covered) = (Vec::new(), 0.0);
            for Pair { shared, .. } in of_joint {
                let of_own = if is_first { *shared } else { shared.swapped() };
                let before = all.iter().map(|tab: &Tab| tab.polygon.clone());
                let beyond: Vec<Vec<Point2>> =
                    self.made[own.part].added.iter().cloned().chain(before).collect();
                let own = Side { beyond: &beyond, ..side(own) };
                let (made, share) = tabs(&own, &side(mate), &of_own, kind);
                all.extend(made);
                covered += share * length(shared) / whole;
            }
            (all, covered)
        };
        let [first, mate] = places;
        let mut best: (EdgePlace, (Vec<Tab>, f64)) = (first, along(first, mate, true));
        if may_choose {
            let on_mate = along(mate, first, false);
            if on_mate.1 > best.1.1 {
                best = (mate, on_mate);
            }
        }
        let (place, (tabs, covered)) = best;
        if covered < 0.5 {
            let joint = places.map(|place| self.shown(place));
            self.made[first.part].note_no_room(joint, covered);
        }
        let made = &mut self.made[place.part];
        for Tab { fold, polygon, mountain } in tabs {
            made.added.push(polygon);
            made.paths.push(PatternPath {
                role: Role::Score,
                kind: PathKind::TrimFold { mountain },
                points: fold,
                closed: false,
            });
        }
    }

    /// Holes, notches and ticks.
    pub(super) fn mark(&mut self) -> Result<(), Faulted> {
        let trims = self.trims;
        for (number, trim) in trims.iter().enumerate() {
            let [from, to] = trim.span;
            let within = |shares: Vec<f64>| -> Vec<f64> {
                shares.into_iter().map(|share| from + share * (to - from)).collect()
            };
            let mut ticks = 0;
            for pair in self.pairs(number) {
                let length = (to - from) * (pair.shared.first[1] - pair.shared.first[0]);
                match &trim.kind {
                    TrimKind::Holes(holes) => {
                        self.check_holes(&pair, holes)?;
                        // A loop of which a stretch alone is joined has holes at both its ends.
                        let edge = self.stretch(pair.first);
                        let is_whole = length >= edge.length() * (1.0 - 1e-9);
                        let is_loop = to - from == 1.0 && edge.is_loop() && is_whole;
                        self.add_holes(&pair, &within(of_holes(holes, length, is_loop)), holes);
                    }
                    TrimKind::Notches(notches) => {
                        self.add_notches(&pair, &within(of_marks(&notches.at, length)), notches)?;
                    }
                    TrimKind::Ticks(kind) => {
                        let shares = within(of_marks(&kind.at, length));
                        ticks += self.add_ticks(&pair, &shares, kind, ticks);
                    }
                    _ => {}
                }
            }
        }
        Ok(())
    }

    fn add_notches(
        &mut self,
        pair: &Pair,
        shares: &[f64],
        notches: &Notches,
    ) -> Result<(), Faulted> {
        for &share in shares {
            for (place, along, spot) in self.spots(pair, share) {
                let margin_mm = self.margin_at(place, along);
                let depth_mm = notches.depth;
                if depth_mm > margin_mm + ROUNDING_MM && !notches.form.is_outward() {
                    let edge = self.edge_name(place);
                    let fault = TrimFault::TooDeep { edge, depth_mm, margin_mm };
                    return Err((Some(place.part), fault));
                }
                let notched = notched(spot, margin_mm, notches);
                let made = &mut self.made[place.part];
                made.added.extend(notched.added);
                made.removed.extend(notched.removed);
                made.paths.extend(notched.paths);
            }
        }
        Ok(())
    }

    /// Ticks at these shares on both edges of a pair, with numbers that follow `before`. Returns
    /// how many places have one.
    fn add_ticks(&mut self, pair: &Pair, shares: &[f64], kind: &Ticks, before: usize) -> usize {
        for (n, &share) in shares.iter().enumerate() {
            let number = kind.numbered.then_some(before + n + 1);
            for (place, _, spot) in self.spots(pair, share) {
                let (path, label) = ticked(spot, kind.length, number);
                let made = &mut self.made[place.part];
                made.paths.push(path);
                made.labels.extend(label);
            }
        }
        shares.len()
    }

    /// The width of the strip beyond an edge, mm; 0 without one.
    fn margin_at(&self, place: EdgePlace, along: f64) -> f64 {
        let margins = &self.margins[place.part][place.edge];
        margins.iter().find_map(|margin| margin.width_at(along)).unwrap_or(0.0)
    }

    fn check_holes(&self, pair: &Pair, holes: &Holes) -> Result<(), Faulted> {
        let (part, edge) = (Some(pair.first.part), self.edge_name(pair.first));
        let (pitch_mm, diameter_mm) = (holes.pitch.min(holes.end_pitch), holes.diameter);
        if pitch_mm <= diameter_mm {
            return Err((part, TrimFault::TooDense { edge, pitch_mm, diameter_mm }));
        }
        let (inset_mm, radius_mm) = (holes.inset, 0.5 * holes.diameter);
        if inset_mm < radius_mm {
            return Err((part, TrimFault::OverTheLine { edge, inset_mm, radius_mm }));
        }
        Ok(())
    }

    /// Holes at these shares on both edges of a pair. One that would reach over the net line, or
    /// into another hole, is left out on both.
    fn add_holes(&mut self, pair: &Pair, shares: &[f64], holes: &Holes) {
        let radius = 0.5 * holes.diameter;
        let mut left_out = 0;
        for &share in shares {
            let spots = self.spots(pair, share);
            let centres: Vec<(usize, Point2)> = spots
                .iter()
                .map(|(place, _, spot)| (place.part, spot.beside(0.0, -holes.inset)))
                .collect();
            // Where three parts meet on one curve, the third has the holes of the first two.
            let known = |&(part, at): &(usize, Point2)| {
                self.made[part].holes.iter().any(|&(other, _)| at.distance(other) < 1e-3)
            };
            let fits = |&(part, at): &(usize, Point2)| {
                distance_mm(at, &self.nets[part]) >= radius
                    && self.made[part]
                        .holes
                        .iter()
                        .all(|&(other, of_other)| at.distance(other) >= radius + of_other)
            };
            let fits: Vec<bool> =
                centres.iter().map(|centre| known(centre) || fits(centre)).collect();
            if fits.contains(&false) {
                left_out += 1;
                continue;
            }
            for centre in
                centres.iter().filter(|centre| !known(centre)).copied().collect::<Vec<_>>()
            {
                let (part, at) = centre;
                self.made[part].holes.push((at, radius));
                self.made[part].paths.push(drilled(at, holes.diameter));
            }
        }
        if left_out > 0 {
            let edge = self.shown(pair.first);
            let of = shares.len();
            self.made[pair.first.part].notes.push(TrimNote::HolesLeftOut { edge, left_out, of });
        }
    }
}
