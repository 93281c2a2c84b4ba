//! Designs whose curves move, \[G14\], so that the sheet bends better: [`crate::fair`] moves
//! samples, this module the points that people draw.
//!
//! The unknowns are the displacements of the points of curves, so that a spline of a dozen points
//! stays one, and the result is an ordinary design: [`varied_design`] turns a design into a design.
//! Points on one spot, such as the ends of curves that meet, are one unknown, and so is a curve
//! that several panels share. Points that are mirror images in a design that is its own mirror
//! image are one unknown, too, which moves the one and mirrored the other ([`symmetry`]). With
//! [`MovedBy::Samples`] a curve first gets as many points as it has samples.
//!
//! Between two triangulations the places of the samples on their curves are held, and so are the
//! chord lengths of splines; then samples and tangents are linear in the points
//! ([`point_shares`](sheetwright_geometry::curve::point_shares)). With every triangulation the
//! moved curves are sampled anew, as those of any design, and steps are accepted by these samples.
//! So samples slip along their curves as these change their lengths, which their motions include
//! ([`respacing`]).

mod error;
mod refine;
mod respacing;
mod symmetry;
mod unknowns;

use super::{
    Ended, Limit, Moving, MovingPanel, Varied, VaryError, VaryOptions, counted_shares, vary_moving,
};
use crate::design::{Design, DesignPanel, MovedBy, PanelShape, Vary, VaryGoal, used};
use crate::sample::{PanelCause, PanelError, Prepared, Sampler, matched, prepare};
pub use error::{FairCause, FairError, VaryCause};
use refine::with_a_point_a_sample;
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::math::{Point3, Vec3};
use sheetwright_geometry::watch::{Stage, Watch};
use sheetwright_optimum::triangulate::TriangulateError;
use std::collections::{BTreeMap, BTreeSet};
use symmetry::{Symmetry, curves_of};
use unknowns::Unknowns;

/// Limit of the points that move together: every step computes all of them.
const MOST_POINTS: usize = 20_000;
/// The limit where none is given, as a share of the size of the panels.
const DEFAULT_SHARE: f64 = 0.01;
/// The effort of a search with holes while points move, as a share of the panel's effort: there are
/// dozens of such searches, and the final panel is triangulated with the whole effort.
const SHARE_OF_EFFORT: f64 = 0.1;
/// How often the limits of points are reduced because samples between them moved too far.
const ATTEMPTS: usize = 3;
/// Additional factor of each reduction, since the displacements differ each time.
const HELD_BACK: f64 = 0.98;
/// By how much a sample may exceed its limit, as a share of it: rounding.
const WITHIN: f64 = 1e-9;

/// How the samples of a panel were moved.
#[derive(Clone, Debug)]
pub(crate) struct Shift {
    /// How moving ended.
    pub(crate) ended: Ended,
    /// The goal.
    pub(crate) goal: VaryGoal,
    /// The curves of the panel that moved, by name.
    pub(crate) curves: Vec<String>,
    /// The positions of samples before and after, mm.
    pub(crate) moved: Vec<[Point3; 2]>,
}

impl Shift {
    pub(crate) fn is_moved(&self) -> bool {
        self.moved.iter().any(|[from, to]| from != to)
    }
}

/// A design before and after its points were moved.
pub(crate) struct VariedDesign {
    /// The given design with matched seams and without `vary`.
    pub(crate) before: Design,
    /// `before` with its points moved.
    pub(crate) after: Design,
    /// How panels were moved, by name, for those with a `vary`.
    pub(crate) shifts: BTreeMap<String, Shift>,
}

/// The design with its points moved; `None` where no point may move.
pub(crate) fn varied_design(
    design: &Design,
    watch: &mut dyn Watch,
) -> Result<Option<VariedDesign>, FairError> {
    let asked = asked(design);
    if asked.is_empty() {
        return Ok(None);
    }
    let before = Design { vary: Vec::new(), match_seams: true, ..design.clone() };
    let mut scopes =
        asked.iter().map(|vary| Scope::new(&before, vary)).collect::<Result<Vec<_>, _>>()?;
    refuse_moved_twice(&before, &scopes)?;
    let symmetry = Symmetry::of(&before);
    if let Some(symmetry) = &symmetry {
        add_images(&before, symmetry, &asked, &mut scopes)?;
    }
    let symmetry = symmetry.as_ref();
    let mut after = before.clone();
    let mut shifts = BTreeMap::new();
    for (vary, scope) in asked.iter().zip(&scopes) {
        let moved = Problem { design: &after, vary, scope, symmetry }.solved(watch)?;
        after = moved.0;
        // A panel that follows others comes up once for each; the last entry has all moves.
        shifts.extend(moved.1);
    }
    after.curves.iter_mut().flat_map(|c| &mut c.points).for_each(|point| point.move_mm = 0.0);
    Ok(Some(VariedDesign { before, after, shifts }))
}

/// What should move: the `vary` of the design, or else all points with a distance of their own.
fn asked(design: &Design) -> Vec<Vary> {
    if !design.vary.is_empty() {
        return design.vary.clone();
    }
    let panels = design.panels_to_make();
    let mut curves = panels.iter().flat_map(|panel| used(design, &panel.shape));
    let may_move = curves.any(|curve| curve.points.iter().any(|point| point.move_mm > 0.0));
    if may_move { vec![Vary::default()] } else { Vec::new() }
}

/// The panels and curves of a problem.
struct Scope {
    /// The panels, by their numbers in the design, and whether each only follows.
    panels: Vec<(usize, bool)>,
    /// The curves that move, by their numbers.
    curves: BTreeSet<usize>,
    /// Whether each point moves only by its own distance.
    by_point: bool,
}

impl Scope {
    fn new(design: &Design, vary: &Vary) -> Result<Self, FairError> {
        let made = design.panels_to_make();
        for name in &vary.panels {
            if !made.iter().any(|panel| panel.name == *name) {
                return Err(failed("", None, VaryCause::UnknownPanel { name: name.clone() }));
            }
        }
        let asked: BTreeSet<usize> = made
            .iter()
            .filter(|panel| is_asked(vary, panel))
            .flat_map(|panel| curves_of(design, panel))
            .collect();
        if asked.is_empty() {
            return Err(failed("", None, VaryCause::NoCurves));
        }
        let mut curves = BTreeSet::new();
        for name in &vary.curves {
            let number = design.curves.iter().position(|curve| curve.name == *name);
            let Some(number) = number else {
                return Err(FairError::of_curve(name, PanelCause::UnknownCurve));
            };
            if !asked.contains(&number) {
                return Err(failed("", Some(name), VaryCause::BoundsNothing));
            }
            curves.insert(number);
        }
        if curves.is_empty() {
            curves = asked;
        }
        let may_move = |curve: &usize| design.curves[*curve].points.iter().any(|p| p.move_mm > 0.0);
        let by_point = curves.iter().any(may_move);
        if by_point && vary.curves.is_empty() {
            curves.retain(may_move);
        }
        let panels = panels_of(design, vary, &curves)?;
        let found = curves.iter().map(|&curve| design.curves[curve].points.len()).sum();
        if found > MOST_POINTS {
            return Err(failed("", None, VaryCause::TooManyPoints { found, most: MOST_POINTS }));
        }
        Ok(Self { panels, curves, by_point })
    }
}

fn failed(panel: &str, curve: Option<&str>, cause: VaryCause) -> FairError {
    FairError {
        panel: panel.to_owned(),
        curve: curve.map(str::to_owned),
        cause: FairCause::Vary(cause),
    }
}

fn is_asked(vary: &Vary, panel: &DesignPanel) -> bool {
    vary.panels.is_empty() || vary.panels.contains(&panel.name)
}

/// The panels that have some of these curves, by their numbers, and whether each only follows.
fn panels_of(
    design: &Design,
    vary: &Vary,
    curves: &BTreeSet<usize>,
) -> Result<Vec<(usize, bool)>, FairError> {
    let made = design.panels_to_make();
    let mut panels = Vec::new();
    for (n, panel) in design.panels.iter().enumerate() {
        let is_made = made.iter().any(|one| one.name == panel.name);
        if !is_made || curves_of(design, panel).is_disjoint(curves) {
            continue;
        }
        if matches!(panel.shape, PanelShape::Join(_)) {
            return Err(failed(&panel.name, None, VaryCause::Joined));
        }
        if panel.run_on {
            return Err(failed(&panel.name, None, VaryCause::RunsOn));
        }
        panels.push((n, !is_asked(vary, panel)));
    }
    Ok(panels)
}

/// Has the mirror images of curves move, too, where neither curves nor points are named that may
/// move and no other scope moves the image.
fn add_images(
    design: &Design,
    symmetry: &Symmetry,
    asked: &[Vary],
    scopes: &mut [Scope],
) -> Result<(), FairError> {
    let mut moving: BTreeSet<usize> =
        scopes.iter().flat_map(|scope| scope.curves.iter().copied()).collect();
    for (vary, scope) in asked.iter().zip(scopes) {
        if !vary.curves.is_empty() || scope.by_point {
            continue;
        }
        let images = scope.curves.iter().filter_map(|&curve| symmetry.image(curve));
        let more: Vec<usize> = images.filter(|image| moving.insert(*image)).collect();
        scope.curves.extend(more);
        scope.panels = panels_of(design, vary, &scope.curves)?;
    }
    Ok(())
}

fn refuse_moved_twice(design: &Design, scopes: &[Scope]) -> Result<(), FairError> {
    let mut moving = BTreeSet::new();
    for curve in scopes.iter().flat_map(|scope| &scope.curves) {
        if !moving.insert(*curve) {
            return Err(FairError::of_curve(&design.curves[*curve].name, VaryCause::MovedTwice));
        }
    }
    Ok(())
}

/// Panels and curves that are moved together.
struct Problem<'a> {
    design: &'a Design,
    vary: &'a Vary,
    scope: &'a Scope,
    symmetry: Option<&'a Symmetry>,
}

impl Problem<'_> {
    fn panels(&self) -> Vec<&DesignPanel> {
        self.scope.panels.iter().map(|&(n, _)| &self.design.panels[n]).collect()
    }

    /// The design with its points moved, and how.
    fn solved(
        &self,
        watch: &mut dyn Watch,
    ) -> Result<(Design, BTreeMap<String, Shift>), FairError> {
        let names: Vec<&str> = self.panels().iter().map(|panel| panel.name.as_str()).collect();
        watch.begin(&names, Stage::Vary);
        let design = match self.vary.by {
            MovedBy::Points => self.design.clone(),
            MovedBy::Samples => {
                with_a_point_a_sample(self.design, &self.panels(), &self.scope.curves)?
            }
        };
        let before = self.prepared(&design, watch)?;
        let unknowns = Unknowns::new(&design, &self.scope.curves, &before, self.symmetry);
        let drawn = Drawn { problem: self, unknowns, design };
        let found = self.within_the_limit(&drawn, &before, watch).map_err(|e| self.failed(e))?;
        let is_moved = found.displacements.iter().any(|way| *way != Vec3::ZERO);
        let after = if is_moved {
            drawn.unknowns.moved(&drawn.design, &found.displacements)
        } else {
            self.design.clone()
        };
        let curves = |panel: &DesignPanel| -> Vec<String> {
            let moving = used(self.design, &panel.shape).filter(|curve| {
                let number = self.design.curves.iter().position(|c| c.name == curve.name);
                let number = number.filter(|n| is_moved && self.scope.curves.contains(n));
                number.is_some_and(|n| after.curves[n] != drawn.design.curves[n])
            });
            moving.map(|curve| curve.name.clone()).collect()
        };
        let shifts = self.panels().into_iter().zip(&before).map(|(panel, before)| {
            let from = before.boundary.positions();
            let to = drawn.unknowns.places(before, &found.displacements);
            let shift = Shift {
                ended: found.ended.clone(),
                goal: self.vary.goal,
                curves: curves(panel),
                moved: from.into_iter().zip(to).map(|(from, to)| [from, to]).collect(),
            };
            (panel.name.clone(), shift)
        });
        let shifts = shifts.collect();
        Ok((after, shifts))
    }

    /// Moves the points so that no sample exceeds its limit. Between its points a spline may move
    /// farther than they do; where it does, the limits of the points are reduced accordingly.
    fn within_the_limit(
        &self,
        drawn: &Drawn<'_>,
        before: &[Prepared],
        watch: &mut dyn Watch,
    ) -> Result<Varied, VaryError> {
        let options = VaryOptions {
            goal: self.vary.goal,
            leave_developable: self.vary.leave_developable,
            ..VaryOptions::default()
        };
        let size_mm = size_of(before.iter().flat_map(|panel| panel.boundary.positions()));
        let limit_mm = self.limit_mm(size_mm);
        let farthest = |found: &Varied| -> f64 {
            let ways = before.iter().flat_map(|panel| {
                let to = drawn.unknowns.places(panel, &found.displacements);
                panel.boundary.positions().into_iter().zip(to)
            });
            ways.map(|(from, to)| from.distance(to)).fold(0.0, f64::max)
        };
        let mut share = 1.0;
        let mut known = Vec::new();
        for _ in 0..ATTEMPTS {
            let limit = self.limit(&drawn.unknowns, before, limit_mm.map(|mm| share * mm));
            let found = vary_moving(drawn, &known, &limit, &options, watch)?;
            let Some(limit_mm) = limit_mm else { return Ok(found) };
            let beyond = farthest(&found) / limit_mm;
            if beyond.is_nan() || beyond <= 1.0 + WITHIN {
                return Ok(found);
            }
            share *= HELD_BACK / beyond;
            known = found.displacements;
        }
        let share = 1.0 / drawn.unknowns.most_shares();
        let limit = self.limit(&drawn.unknowns, before, limit_mm.map(|mm| share * mm));
        vary_moving(drawn, &known, &limit, &options, watch)
    }

    /// The limit of each sample, mm, if there is one.
    fn limit_mm(&self, size_mm: f64) -> Option<f64> {
        let nothing_said =
            self.vary.limit_mm.is_none() && self.vary.budget_mm.is_none() && !self.scope.by_point;
        self.vary.limit_mm.or(nothing_said.then_some(DEFAULT_SHARE * size_mm))
    }

    fn limit(&self, unknowns: &Unknowns, panels: &[Prepared], limit_mm: Option<f64>) -> Limit {
        let radii_mm = unknowns.radii_mm(limit_mm, self.scope.by_point);
        let Some(total_mm) = self.vary.budget_mm else { return Limit::Each { radii_mm } };
        // The copies of a shared sample count once.
        let mut seen = BTreeSet::new();
        let mut counted = Vec::new();
        for panel in panels {
            for (sample, motion) in panel.boundary.samples().iter().zip(unknowns.motions(panel)) {
                let at = sample.position;
                if seen.insert([at.x, at.y, at.z].map(f64::to_bits)) {
                    counted.push(motion);
                }
            }
        }
        let weights = counted_shares(&counted, radii_mm.len());
        Limit::Budget { total_mm, weights, radii_mm }
    }

    fn failed(&self, error: VaryError) -> FairError {
        FairError::of_design(match error {
            VaryError::Stopped => PanelCause::Triangulate(TriangulateError::Stopped).into(),
            error => FairCause::Vary(VaryCause::Failed(error)),
        })
    }

    fn prepared(
        &self,
        design: &Design,
        watch: &mut dyn Watch,
    ) -> Result<Vec<Prepared>, PanelError> {
        let matched = matched(design);
        let sampler = Sampler { design, matched: &matched };
        let panels = self.scope.panels.iter().map(|&(n, _)| &design.panels[n]);
        panels.map(|panel| prepare(&sampler, panel, watch)).collect()
    }
}

/// The design, drawn anew for each displacement of its points.
struct Drawn<'a> {
    problem: &'a Problem<'a>,
    design: Design,
    unknowns: Unknowns,
}

impl Moving for Drawn<'_> {
    fn panels(
        &self,
        unknowns: &[Vec3],
        watch: &mut dyn Watch,
    ) -> Result<Vec<MovingPanel>, VaryError> {
        let mut moved = self.unknowns.moved(&self.design, unknowns);
        moved.panels.iter_mut().for_each(|panel| panel.effort *= SHARE_OF_EFFORT);
        let prepared = self.problem.prepared(&moved, watch).map_err(|error| match error.cause {
            PanelCause::Triangulate(TriangulateError::Stopped) => VaryError::Stopped,
            _ => VaryError::NoPanels,
        })?;
        let here = self.unknowns.drawn_anew(&moved, &prepared);
        let panels = prepared.into_iter().zip(&self.problem.scope.panels);
        Ok(panels
            .map(|(panel, &(_, follows))| MovingPanel {
                motions: here.motions(&panel),
                boundary: panel.boundary,
                plane: panel.plane,
                triangulate: panel.options,
                follows,
            })
            .collect())
    }
}
