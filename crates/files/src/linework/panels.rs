//! From the curves of a drawing to the panels of a design: which curves are rails, outlines and
//! holes. Names say it, or the caller; else closed curves bound panels by how they lie inside one
//! another, and two open curves alone are rails.

use super::chain::{Chained, size_of};
use super::drawn::{Drawing, Drawn};
use super::fit::{FitError, Fitted, fitted};
use super::maker::{Closed, Found, Maker, ends_of, place_of};
use super::nest::{Ring, doubled, parents};
use super::roles::{Role, Told, is_called, role};
use super::segment::Segment;
use crate::names::{did_you_mean, folded, shown};
use crate::reading::InputError;
use crate::table::MAX_CURVES;
use sheetwright::boundary::MAX_SAMPLES;
use sheetwright::design::{CurveUse, PanelShape, ReadNote, Unused};
use sheetwright::math::Point3;
use std::collections::{BTreeMap, BTreeSet};

const ROLES_HINT: &str = "Name the curves or their layers for what they are: `rail-…`, \
                          `outline-…`, `hole-…`.";

/// Makes panels of a drawing. `place` names it in messages, `stem` is its name, `rails` the names
/// of the curves that the caller wants for rails.
pub(super) fn panels(
    drawing: Drawing,
    place: &str,
    stem: &str,
    rails: &[String],
) -> Result<Found, InputError> {
    let Drawing { curves, unused, notes, .. } = drawing;
    let size = size_of(&curves);
    let mut maker = Maker { place, stem, size, unused, notes, ..Maker::default() };
    if !(size > 0.0 && size.is_finite()) {
        return Err(maker.nothing());
    }
    if rails.is_empty() {
        maker.by_names(curves)?;
    } else {
        maker.by_call(curves, rails)?;
    }
    maker.finished()
}

impl Maker<'_> {
    /// Curves that are drawn twice, one on the other, stay once.
    fn without_doubles(&mut self, curves: Vec<Drawn>) -> Vec<Drawn> {
        let mut known: BTreeSet<Vec<[i64; 3]>> = BTreeSet::new();
        let step = 1e-7 * self.size;
        let rounded = |p: Point3| [p.x, p.y, p.z].map(|c| (c / step).round() as i64);
        let mut kept = Vec::with_capacity(curves.len());
        for curve in curves {
            let of_segment =
                |segment: &Segment| [0.0, 0.25, 0.5, 0.75].map(|t| segment.position(t));
            let points = curve.segments.iter().flat_map(of_segment).chain(curve.end());
            let mut there: Vec<[i64; 3]> = points.map(rounded).collect();
            // Run either way.
            let back: Vec<[i64; 3]> = there.iter().rev().copied().collect();
            there = there.min(back);
            if known.insert(there) {
                kept.push(curve);
            } else {
                self.unused.add_curve(Unused::Doubled, &curve);
            }
        }
        kept
    }

    /// Rails by the names that the caller gives; everything else is left out.
    fn by_call(&mut self, curves: Vec<Drawn>, wanted: &[String]) -> Result<(), InputError> {
        let mut groups: Vec<Vec<Drawn>> = vec![Vec::new(); wanted.len()];
        let mut names: BTreeSet<String> = BTreeSet::new();
        for curve in curves {
            names.extend(curve.all_names().map(str::to_owned));
            match wanted.iter().position(|name| is_called(&curve, name)) {
                Some(n) => groups[n].push(curve),
                None => self.unused.add_curve(Unused::NotNamed, &curve),
            }
        }
        if let Some(n) = groups.iter().position(Vec::is_empty) {
            let known: Vec<&str> = names.iter().map(String::as_str).collect();
            let message = format!("no curve or layer is called {}", shown(&wanted[n]));
            return Err(self.error(message, did_you_mean(&wanted[n], &known)));
        }
        let mut rails = Vec::new();
        for (group, name) in groups.into_iter().zip(wanted) {
            let group = self.without_doubles(group);
            let mut found = self.as_rails(group, wanted.len() == 1);
            if found.len() > 1 && wanted.len() > 1 {
                return Err(self.several_for_one(&found, name));
            }
            if let [rail] = &mut found[..] {
                rail.names = vec![name.clone()];
            }
            rails.append(&mut found);
        }
        if rails.len() < 2 {
            let message = format!("{} is one curve", shown(&wanted[0]));
            return Err(self.error(message, "A panel has two rails: name another one as well."));
        }
        self.between_rails(rails)
    }

    fn several_for_one(&self, found: &[Drawn], name: &str) -> InputError {
        let message = format!("{} is {} curves that do not meet", shown(name), found.len());
        let ends: Vec<String> = found.iter().take(3).map(ends_of).collect();
        let hint = format!("Join them to one curve, or name one of them. {}.", ends.join("; "));
        self.error(message, hint)
    }

    /// The rails of one name or layer: what meets end to end is one. Where it is the only name, two
    /// curves that meet in a point, as planks do at the stem, are two.
    fn as_rails(&mut self, curves: Vec<Drawn>, is_only: bool) -> Vec<Drawn> {
        let is_pair = is_only && curves.len() == 2 && curves.iter().all(|curve| !curve.closed);
        let parted = if is_pair { curves.clone() } else { Vec::new() };
        let chained = self.chained(curves, |_| String::new()).curves;
        if is_pair && chained.len() == 1 { parted } else { chained }
    }

    /// A panel between each rail and the next; two rings are the borders of one.
    fn between_rails(&mut self, rails: Vec<Drawn>) -> Result<(), InputError> {
        let closed = rails.iter().filter(|rail| rail.closed).count();
        if closed > 0 && closed < rails.len() {
            let (ring, open) = (
                rails.iter().find(|rail| rail.closed).map_or("", Drawn::name),
                rails.iter().find(|rail| !rail.closed).map_or("", Drawn::name),
            );
            let message =
                format!("of the rails, {} is closed and {} is open", shown(ring), shown(open));
            return Err(self.error(message, "Both rails of a panel are open, or both are closed."));
        }
        // Plane rails are an exact drawing; those in space may be smooth curves as many lines.
        let segments = rails.iter().flat_map(|rail| &rail.segments);
        let points = segments.flat_map(|segment| [segment.start(), segment.end()]);
        let smooth = !Ring::new(points.collect(), self.size).is_flat();
        let names =
            rails.iter().map(|rail| self.curve(rail, smooth)).collect::<Result<Vec<_>, _>>()?;
        for pair in names.windows(2) {
            let [a, b] = [&pair[0], &pair[1]].map(|name| whole(name));
            let shape = match closed {
                0 => PanelShape::Rails([a, b]),
                _ => PanelShape::Loops { outer: vec![a], holes: vec![vec![b]] },
            };
            self.shapes.push((format!("{}-{}", pair[0], pair[1]), shape));
        }
        Ok(())
    }

    /// Rails, outlines and holes by the names of curves and layers, else by how they lie.
    fn by_names(&mut self, curves: Vec<Drawn>) -> Result<(), InputError> {
        let mut rails: Vec<Vec<Drawn>> = Vec::new();
        let mut rail_of: BTreeMap<String, usize> = BTreeMap::new();
        let mut others = Vec::new();
        for curve in curves {
            match role(&curve).map(|told| (told.role, folded(told.name))) {
                Some((Role::Mark, _)) => self.unused.add_curve(Unused::Marks, &curve),
                Some((Role::Rail, name)) => {
                    let n = *rail_of.entry(name).or_insert(rails.len());
                    if n == rails.len() {
                        rails.push(Vec::new());
                    }
                    rails[n].push(curve);
                }
                _ => others.push(curve),
            }
        }
        let others = self.without_doubles(others);
        if rails.is_empty() {
            return self.outlines(others);
        }
        let is_told = |curve: &Drawn| role(curve).is_some();
        let (told, untold): (Vec<Drawn>, Vec<Drawn>) = others.into_iter().partition(is_told);
        for curve in untold {
            self.unused.add_curve(Unused::NotNamed, &curve);
        }
        self.named_rails(rails)?;
        if told.is_empty() { Ok(()) } else { self.outlines(told) }
    }

    /// The panels of rails by the names that say so: two in all, or two of each name.
    fn named_rails(&mut self, rails: Vec<Vec<Drawn>>) -> Result<(), InputError> {
        let is_only = rails.len() == 1;
        let mut groups: Vec<Vec<Drawn>> = Vec::with_capacity(rails.len());
        for group in rails {
            let group = self.without_doubles(group);
            groups.push(self.as_rails(group, is_only));
        }
        let count: usize = groups.iter().map(Vec::len).sum();
        if count == 2 {
            return self.between_rails(groups.into_iter().flatten().collect());
        }
        if groups.iter().all(|group| group.len() == 2) {
            return groups.into_iter().try_for_each(|pair| self.between_rails(pair));
        }
        let listed: Vec<String> = groups.iter().flatten().take(6).map(ends_of).collect();
        let message = format!("{count} curves are named for rails; a panel has two");
        let hint = format!(
            "Name two of them as the rails of a panel, or give each pair of rails a layer. {}.",
            listed.join("; ")
        );
        Err(self.error(message, hint))
    }

    /// Panels of outlines and holes, or of a pair of rails that nothing names.
    fn outlines(&mut self, curves: Vec<Drawn>) -> Result<(), InputError> {
        let parted: Vec<Drawn> = curves.iter().take(3).cloned().collect();
        let told = |curve: &Drawn| match role(curve).map(|told| told.role) {
            Some(Role::Outline) => "outline".to_owned(),
            Some(Role::Hole) => "hole".to_owned(),
            _ => String::new(),
        };
        let Chained { curves, forks, .. } = self.chained(curves, told);
        let (closed, open): (Vec<Drawn>, Vec<Drawn>) =
            curves.into_iter().partition(|curve| curve.closed);
        if !closed.is_empty() {
            open.iter().for_each(|curve| self.unused.add_curve(Unused::Open, curve));
            return self.closed(closed);
        }
        if open.is_empty() {
            return Err(self.nothing());
        }
        // Two lines that meet at one end are rails that run to a point, unless it is an outline of
        // two strokes that all but closes.
        let is_pointed = parted.len() == 2 && open.len() == 1 && !self.nearly_closes(&open[0]);
        let pair = if is_pointed { &parted } else { &open };
        if pair.len() == 2 && forks.is_empty() {
            let names = [&pair[0], &pair[1]].map(|curve| curve.name().to_owned());
            self.between_rails(pair.clone())?;
            let names = match &self.curves[..] {
                [a, b] => [a.name.clone(), b.name.clone()],
                _ => names,
            };
            self.notes.push(ReadNote::TakenForRails { names });
            return Ok(());
        }
        Err(self.not_closed(&open, &forks))
    }

    /// Whether the ends of a curve are nearer to one another than a hundredth of the drawing.
    fn nearly_closes(&self, curve: &Drawn) -> bool {
        let ends = curve.start().zip(curve.end());
        ends.is_some_and(|(start, end)| start.distance(end) < 0.01 * self.size)
    }

    fn not_closed(&self, open: &[Drawn], forks: &[Point3]) -> InputError {
        let mut hint = match open {
            [_] => "Close it, or draw a second curve: two open curves are rails.".to_owned(),
            _ => {
                let listed: Vec<String> = open.iter().take(4).map(ends_of).collect();
                format!("{ROLES_HINT} Or close them: {}.", listed.join("; "))
            }
        };
        if let Some(fork) = forks.first() {
            hint.push_str(&format!(" At {}, three ends or more meet.", place_of(*fork)));
        }
        match open {
            [only] => {
                let apart = match (only.start(), only.end()) {
                    (Some(a), Some(b)) => a.distance(b),
                    _ => 0.0,
                };
                let message = format!(
                    "the only curve, {}, is not closed: its ends are {apart:.3} mm apart, at {} \
                     and {}",
                    shown(only.name()),
                    only.start().map_or_else(String::new, place_of),
                    only.end().map_or_else(String::new, place_of)
                );
                self.error(message, hint)
            }
            _ => {
                let message = format!(
                    "the drawing has {} open curves and no outline, so what is a rail is not clear",
                    open.len()
                );
                self.error(message, hint)
            }
        }
    }

    /// Panels of closed curves.
    fn closed(&mut self, closed: Vec<Drawn>) -> Result<(), InputError> {
        if closed.len() > MAX_CURVES {
            return Err(self.too_many_curves());
        }
        let size = self.size;
        let flat = |curve: &Drawn| -> Result<(Fitted, Ring), FitError> {
            let fit = fitted(curve, false)?;
            let ring = Ring::new(fit.points.iter().map(|point| point.at).collect(), size);
            // What is bent in space may be a smooth curve that is drawn as many lines.
            if ring.is_flat() {
                return Ok((fit, ring));
            }
            let fit = fitted(curve, true)?;
            let ring = Ring::new(fit.points.iter().map(|point| point.at).collect(), size);
            Ok((fit, ring))
        };
        let (mut fits, mut rings, mut points) = (Vec::new(), Vec::new(), 0);
        let mut bounding: Vec<Drawn> = Vec::new();
        let mut fault: Option<InputError> = None;
        for curve in closed {
            match flat(&curve) {
                Ok((fit, ring)) => {
                    points += fit.points.len();
                    if points > MAX_SAMPLES {
                        return Err(self.too_many_points());
                    }
                    fits.push(fit);
                    rings.push(ring);
                    bounding.push(curve);
                }
                // A line there and back, or a point, bounds nothing.
                Err(error) if error.bounds_nothing() => {
                    fault = fault.or_else(|| Some(self.unfit(&curve, &error)));
                    self.unused.add_curve(Unused::Closed, &curve);
                }
                Err(error) => return Err(self.unfit(&curve, &error)),
            }
        }
        if let (true, Some(fault)) = (bounding.is_empty(), fault) {
            return Err(fault);
        }
        let doubled = doubled(&rings, self.size);
        let mut all: Vec<Closed> = Vec::new();
        for (((curve, fit), ring), doubled) in
            bounding.into_iter().zip(fits).zip(rings).zip(doubled)
        {
            if doubled {
                self.unused.add_curve(Unused::Doubled, &curve);
            } else {
                all.push(Closed { curve, fit, ring });
            }
        }
        let is_told = all.iter().any(|closed| role(&closed.curve).is_some());
        if let [a, b] = &all[..]
            && !is_told
            && !a.ring.holds_in_plane(&b.ring, self.size)
            && !b.ring.holds_in_plane(&a.ring, self.size)
        {
            let names = [self.keep(a)?, self.keep(b)?];
            let [a, b] = [&names[0], &names[1]].map(|name| whole(name));
            self.notes.push(ReadNote::TakenForRing { names });
            let shape = PanelShape::Loops { outer: vec![a], holes: vec![vec![b]] };
            self.shapes.push((self.stem.to_owned(), shape));
            return Ok(());
        }
        self.nested(&all)
    }

    /// Panels of closed curves by their names and by how they lie inside one another.
    fn nested(&mut self, all: &[Closed]) -> Result<(), InputError> {
        let rings: Vec<&Ring> = all.iter().map(|closed| &closed.ring).collect();
        let parents = parents(&rings, self.size);
        let roles = self.roles_of(all, &parents)?;
        let mut outlines = (0..all.len()).filter(|&m| roles[m] == Some(Role::Outline));
        let only = outlines.next().filter(|_| outlines.next().is_none());
        let mut holes: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (n, closed) in all.iter().enumerate() {
            match roles[n] {
                Some(Role::Hole) => {
                    let is_outline = |m: &usize| roles[*m] == Some(Role::Outline);
                    let around = std::iter::successors(parents[n], |&m| parents[m]);
                    // What lies inside an outline in space is not known: the only one counts.
                    let lone = only.filter(|&m| !all[m].ring.is_flat());
                    let around = around.into_iter().find(is_outline).or(lone);
                    let Some(around) = around else {
                        let message =
                            format!("the hole {} lies in no outline", shown(closed.curve.name()));
                        return Err(self.error(message, ROLES_HINT));
                    };
                    holes.entry(around).or_default().push(n);
                }
                Some(_) => {
                    holes.entry(n).or_default();
                }
                None => self.unused.add_curve(Unused::Closed, &closed.curve),
            }
        }
        for (outer, holes) in holes {
            let name = self.keep(&all[outer])?;
            let mut inner = Vec::new();
            for hole in holes {
                inner.push(vec![whole(&self.keep(&all[hole])?)]);
            }
            let outer = vec![whole(&name)];
            self.shapes.push((name, PanelShape::Loops { outer, holes: inner }));
        }
        Ok(())
    }

    /// What each closed curve is: as it is named; else an outline, or a hole of the outline that it
    /// lies in. Where outlines are named, what lies in none of them is not used. A layer of
    /// outlines may have their holes as well.
    fn roles_of(
        &self,
        all: &[Closed],
        parents: &[Option<usize>],
    ) -> Result<Vec<Option<Role>>, InputError> {
        let told: Vec<Option<Told<'_>>> = all.iter().map(|closed| role(&closed.curve)).collect();
        let has_outlines = told.iter().flatten().any(|told| told.role == Role::Outline);
        let mut roles: Vec<Option<Role>> = vec![None; all.len()];
        // From the outside inwards: a curve lies in fewer others than what lies in it.
        let depth = |n: usize| std::iter::successors(parents[n], |&m| parents[m]).count();
        let mut order: Vec<usize> = (0..all.len()).collect();
        order.sort_by_cached_key(|&n| depth(n));
        for n in order {
            let on_layer = told[n].is_some_and(|told| told.role == Role::Outline);
            let fixed = told[n].filter(|told| told.is_own || told.role == Role::Hole);
            roles[n] = match (fixed, parents[n].and_then(|m| roles[m])) {
                (Some(told), _) => Some(told.role),
                (None, Some(Role::Outline)) => Some(Role::Hole),
                _ if has_outlines && !on_layer => None,
                _ => Some(Role::Outline),
            };
        }
        if roles.contains(&Some(Role::Outline)) {
            return Ok(roles);
        }
        Err(self.error("the drawing has holes and no outline", ROLES_HINT))
    }
}

fn whole(name: &str) -> CurveUse {
    CurveUse { name: name.to_owned(), reversed: false }
}
