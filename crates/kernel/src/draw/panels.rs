//! From the closed curves of a design to panels and holes.
//!
//! A closed curve that no panel uses becomes a hole of the panel whose outer loop is the nearest
//! around it in the plan; inside a hole, or outside of all panels, it becomes a panel. So curves
//! drawn inside one another are sheet and opening in turn. Existing panels do not change. If a new
//! curve is drawn around one, the new panel has a hole there.
//!
//! A new panel runs along its curve in the direction in which it faces as its neighbours do:
//! opposite to a panel that shares two points in a row with it; without such a neighbour,
//! counter-clockwise, so that it faces the eye above the plan. The direction of the drawn curve
//! does not matter.

use super::edit::{built, free_of};
use super::loops::{Nesting, nesting};
use crate::design::{CurveUse, Design, DesignCurve, DesignPanel, PanelShape, TrimOn};
use sheetwright_geometry::curve::Curve;
use sheetwright_geometry::math::{Point2, Point3};
use sheetwright_geometry::predicate::signed_area_doubled;
use std::collections::BTreeSet;

/// A proposed change of the panels of a design.
#[derive(Clone, Debug, PartialEq)]
pub enum PanelChange {
    /// A closed curve becomes a hole of an existing panel.
    Hole {
        /// The panel.
        panel: String,
        /// The curve.
        curve: String,
    },
    /// A closed curve, with those inside it as holes, becomes a panel.
    Panel(Box<DesignPanel>),
}

/// The proposed changes of the panels of a design.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Proposal {
    /// The changes, in the order of the curves.
    pub changes: Vec<PanelChange>,
    /// Pairs of curves that cross in the plan, lie on one another or touch with one inside the
    /// other, at least one of them free: a free curve that crosses another gets no proposal.
    /// Neighbours that touch from outside are no such pair, unless both would be holes of one
    /// panel.
    pub crossing: Vec<[String; 2]>,
    /// Free curves that cross themselves in the plan, which get no proposal.
    pub crossing_itself: Vec<String>,
}

impl Proposal {
    /// The design with all proposed changes.
    pub fn applied(&self, design: &Design) -> Design {
        let mut changed = design.clone();
        for change in &self.changes {
            match change {
                PanelChange::Panel(panel) => changed.panels.push((**panel).clone()),
                PanelChange::Hole { panel, curve } => {
                    let mut panels = changed.panels.iter_mut();
                    if let Some(panel) = panels.find(|p| p.name == *panel)
                        && let PanelShape::Loops { holes, .. } = &mut panel.shape
                    {
                        holes.push(vec![used(curve)]);
                    }
                }
            }
        }
        changed
    }
}

fn used(name: &str) -> CurveUse {
    CurveUse { name: name.to_owned(), reversed: false }
}

/// Places of a span of a curve for its polygon in the plan.
const PLACES: usize = 24;

/// The places of a curve in a plan as a polygon for [`nesting`]; without the end of an open one, so
/// that the polygons of curves in a chain make a loop. Empty if its points make no curve.
pub fn in_plan(curve: &DesignCurve, project: impl Fn(Point3) -> Point2) -> Vec<Point2> {
    built(curve).map(|made| polygon(&made, curve, &project)).unwrap_or_default()
}

fn polygon(made: &Curve, curve: &DesignCurve, project: &impl Fn(Point3) -> Point2) -> Vec<Point2> {
    let straight = |n: usize| {
        let control = made.spans()[n].control;
        let [a, b, c, d] = control;
        let size = a.distance(d);
        b.distance(a.lerp(d, 1.0 / 3.0)) + c.distance(a.lerp(d, 2.0 / 3.0)) <= STRAIGHT * size
    };
    let parts = |n: usize| if curve.kind.is_none() || straight(n) { 1 } else { PLACES };
    let places = (0..made.spans().len())
        .flat_map(|n| (0..parts(n)).map(move |k| (n, k as f64 / parts(n) as f64)));
    places.map(|(n, t)| project(made.spans()[n].position(t))).collect()
}

/// The largest distance of the control points of a straight span from its line, as a share of its
/// length: rounding.
const STRAIGHT: f64 = 1e-12;

/// A loop of the plan.
struct Loop {
    /// The curves it is made of.
    names: Vec<String>,
    polygon: Vec<Point2>,
    /// The points of the curves as the loop runs.
    points: Vec<Point3>,
    part: LoopRole,
}

impl Loop {
    fn is_free(&self) -> bool {
        self.part == LoopRole::Free
    }
}

/// What a loop is to the panels.
#[derive(Clone, Copy, PartialEq)]
enum LoopRole {
    /// The outer loop of a panel, by its number.
    Outer(usize),
    /// A hole of a panel.
    Hole,
    /// Of no panel yet.
    Free,
}

fn loops_of(design: &Design, project: &impl Fn(Point3) -> Point2) -> Vec<Loop> {
    let mut loops = Vec::new();
    let run_along = |uses: &[CurveUse]| -> (Vec<Point2>, Vec<Point3>) {
        let (mut polygon, mut points) = (Vec::new(), Vec::new());
        for part in uses {
            let Some(curve) = design.curves.iter().find(|c| c.name == part.name) else { continue };
            let curve = match part.reversed {
                true => &super::edit::reversed(curve),
                false => curve,
            };
            polygon.extend(in_plan(curve, project));
            points.extend(curve.points.iter().map(|point| point.at));
        }
        polygon.dedup();
        points.dedup();
        (polygon, points)
    };
    let mut bound: BTreeSet<&str> = BTreeSet::new();
    for (n, panel) in design.panels.iter().enumerate() {
        match &panel.shape {
            PanelShape::Rails(rails) => bound.extend(rails.iter().map(|r| r.name.as_str())),
            PanelShape::Loops { outer, holes } => {
                for (k, uses) in std::iter::once(outer).chain(holes).enumerate() {
                    bound.extend(uses.iter().map(|u| u.name.as_str()));
                    let names = uses.iter().map(|u| u.name.clone()).collect();
                    let part = if k == 0 { LoopRole::Outer(n) } else { LoopRole::Hole };
                    let (polygon, points) = run_along(uses);
                    loops.push(Loop { names, polygon, points, part });
                }
            }
            PanelShape::Join(_) | PanelShape::Mesh(_) => {}
        }
    }
    for curve in design.curves.iter().filter(|c| c.closed && !bound.contains(c.name.as_str())) {
        let polygon = in_plan(curve, project);
        if polygon.len() >= 3 {
            let points = curve.points.iter().map(|point| point.at).collect();
            let names = vec![curve.name.clone()];
            loops.push(Loop { names, polygon, points, part: LoopRole::Free });
        }
    }
    loops
}

/// Whether a new outline must run opposite to its curve, given the outer loops of the existing
/// panels.
fn is_turned(new: &Loop, others: &[Vec<Point3>]) -> bool {
    let m = new.points.len();
    let side = |n: usize| [new.points[n], new.points[(n + 1) % m]];
    let runs = |other: &[Point3], [from, to]: [Point3; 2]| {
        let m = other.len();
        (0..m).any(|n| other[n] == from && other[(n + 1) % m] == to)
    };
    let shared = |turned: bool| {
        let of = |n: usize| if turned { [side(n)[1], side(n)[0]] } else { side(n) };
        let count = |other: &Vec<Point3>| (0..m).filter(|&n| runs(other, of(n))).count();
        others.iter().map(count).sum::<usize>()
    };
    // Neighbours run along shared points in opposite directions.
    match shared(false).cmp(&shared(true)) {
        std::cmp::Ordering::Greater => true,
        std::cmp::Ordering::Less => false,
        std::cmp::Ordering::Equal => signed_area_doubled(&new.polygon) < 0.0,
    }
}

/// The free loops without a proposal, and a proposal with the reasons.
fn barred(
    loops: &[Loop],
    crossing: &[[usize; 2]],
    crossing_itself: &[usize],
) -> (Proposal, BTreeSet<usize>) {
    let mut proposal = Proposal::default();
    let mut barred = BTreeSet::new();
    for pair in crossing {
        let free: Vec<usize> = pair.iter().copied().filter(|&n| loops[n].is_free()).collect();
        if !free.is_empty() {
            proposal.crossing.push(pair.map(|n| loops[n].names.join(", ")));
        }
        barred.extend(free);
    }
    for &n in crossing_itself.iter().filter(|&&n| loops[n].is_free()) {
        barred.insert(n);
        proposal.crossing_itself.push(loops[n].names.join(", "));
    }
    (proposal, barred)
}

/// A proposal for every closed curve that no panel uses. New panels get free names made from the
/// names of their curves, and `samples` samples.
pub fn panels_of_drawing(
    design: &Design,
    project: impl Fn(Point3) -> Point2,
    samples: usize,
) -> Proposal {
    let loops = loops_of(design, &project);
    let polygons: Vec<Vec<Point2>> = loops.iter().map(|l| l.polygon.clone()).collect();
    let Nesting { loops: nested, crossing, touching, crossing_itself } = nesting(&polygons);
    let (mut proposal, mut barred) = barred(&loops, &crossing, &crossing_itself);
    // Around it, past loops that are barred.
    let parent = |n: usize, barred: &BTreeSet<usize>| {
        let up = |&n: &usize| nested[n].parent;
        std::iter::successors(up(&n), up).find(|n| !barred.contains(n))
    };
    let neighbours = |n: usize| {
        let of = move |pair: &&[usize; 2]| pair.contains(&n);
        touching.iter().filter(of).map(move |&[a, b]| if a == n { b } else { a })
    };
    // From outside inwards, so that the loops around a loop are decided first.
    let mut order: Vec<usize> =
        (0..loops.len()).filter(|n| loops[*n].is_free() && !barred.contains(n)).collect();
    order.sort_by_key(|&n| (nested[n].depth, n));
    let mut parts: Vec<LoopRole> = loops.iter().map(|l| l.part).collect();
    let is_outer = |part: LoopRole| matches!(part, LoopRole::Outer(_));
    let mut outer_points: Vec<Vec<Point3>> =
        loops.iter().filter(|l| is_outer(l.part)).map(|l| l.points.clone()).collect();
    let first_new = design.panels.len();
    let mut new: Vec<(usize, DesignPanel)> = Vec::new();
    let mut holes: Vec<(usize, PanelChange)> = Vec::new();
    for n in order {
        let name = loops[n].names[0].clone();
        if let Some(LoopRole::Outer(panel)) = parent(n, &barred).map(|n| parts[n]) {
            // Between two holes that touch there would be no sheet.
            if let Some(other) = neighbours(n).find(|&other| parts[other] == LoopRole::Hole) {
                barred.insert(n);
                let pair = [n.min(other), n.max(other)];
                proposal.crossing.push(pair.map(|n| loops[n].names.join(", ")));
                continue;
            }
            parts[n] = LoopRole::Hole;
            if panel >= first_new {
                add_hole(&mut new[panel - first_new].1, vec![used(&name)]);
            } else {
                let panel = design.panels[panel].name.clone();
                holes.push((n, PanelChange::Hole { panel, curve: name }));
            }
            continue;
        }
        parts[n] = LoopRole::Outer(first_new + new.len());
        let others = design.panels.iter().chain(new.iter().map(|(_, panel)| panel));
        let others: Vec<&str> = others.map(|panel| panel.name.as_str()).collect();
        // A panel has the name of its curve if no other has it.
        let free = free_of(&others, &name);
        let reversed = is_turned(&loops[n], &outer_points);
        let turned: Vec<Point3> = loops[n].points.iter().rev().copied().collect();
        outer_points.push(if reversed { turned } else { loops[n].points.clone() });
        let outer = vec![CurveUse { name: name.clone(), reversed }];
        let shape = PanelShape::Loops { outer, holes: Vec::new() };
        new.push((n, DesignPanel::new(free, shape, samples)));
        // Existing panels inside of it.
        for inner in (0..loops.len()).filter(|&i| parent(i, &barred) == Some(n)) {
            if let LoopRole::Outer(of) = loops[inner].part
                && let PanelShape::Loops { outer, .. } = &design.panels[of].shape
                && let Some((_, panel)) = new.last_mut()
            {
                add_hole(panel, outer.clone());
            }
        }
    }
    let panels = new.into_iter().map(|(n, panel)| (n, PanelChange::Panel(Box::new(panel))));
    let mut changes: Vec<(usize, PanelChange)> = holes.into_iter().chain(panels).collect();
    changes.sort_by_key(|(n, _)| *n);
    proposal.changes = changes.into_iter().map(|(_, change)| change).collect();
    proposal
}

fn add_hole(panel: &mut DesignPanel, hole: Vec<CurveUse>) {
    if let PanelShape::Loops { holes, .. } = &mut panel.shape {
        holes.push(hole);
    }
}

/// The design without a curve: panels lose the holes that it bounds. Also removed are panels whose
/// outer loop or rail it is part of, joins of fewer than two panels, and each `vary` without curves
/// or panels left.
pub fn without_curve(design: &Design, name: &str) -> Design {
    let mut changed = design.clone();
    changed.curves.retain(|curve| curve.name != name);
    let uses = |part: &[CurveUse]| part.iter().any(|u| u.name == name);
    changed.panels.retain_mut(|panel| match &mut panel.shape {
        PanelShape::Rails(rails) => !uses(rails),
        PanelShape::Loops { outer, holes } => {
            holes.retain(|hole| !uses(hole));
            !uses(outer)
        }
        PanelShape::Join(_) | PanelShape::Mesh(_) => true,
    });
    changed.vary.retain_mut(|vary| left_of(&mut vary.curves, |curve| curve != name));
    let is_left = |on: &TrimOn| !matches!(on, TrimOn::Edge { edge, .. } if edge == name);
    changed.trims.retain_mut(|trim| {
        trim.on.retain(is_left);
        !trim.on.is_empty()
    });
    without_lost_panels(changed)
}

/// The design without a panel; its curves stay. Also removed are joins of fewer than two panels,
/// and each `vary` without curves or panels left.
pub fn without_panel(design: &Design, name: &str) -> Design {
    let mut changed = design.clone();
    changed.panels.retain(|panel| panel.name != name);
    without_lost_panels(changed)
}

/// Keeps the names that are left; returns whether any are, or the list was empty, which stands for
/// all.
fn left_of(names: &mut Vec<String>, is_left: impl Fn(&str) -> bool) -> bool {
    let named = !names.is_empty();
    names.retain(|name| is_left(name));
    !named || !names.is_empty()
}

fn without_lost_panels(mut design: Design) -> Design {
    let names = |design: &Design| -> BTreeSet<String> {
        design.panels.iter().map(|panel| panel.name.clone()).collect()
    };
    let there = names(&design);
    design.panels.retain_mut(|panel| {
        let PanelShape::Join(join) = &mut panel.shape else { return true };
        join.parts.retain(|part| there.contains(part));
        join.parts.len() > 1
    });
    let there = names(&design);
    design.vary.retain_mut(|vary| left_of(&mut vary.panels, |panel| there.contains(panel)));
    design
}
