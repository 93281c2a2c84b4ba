//! What a real sheet does whose surface was given as a mesh: the strain that decides the verdict.
//!
//! The sheet is that of the pattern, its border held where the mesh has it, by its length on the
//! pattern. So one way judges all surfaces, and how a surface was divided into triangles does not
//! matter.
//!
//! 1. Sharp creases that divide the mesh are scored: the sheet is held along them, and so it is
//!    along those of bends that are narrower than a net tells (`narrow`).
//! 2. A mesh with points inside its border says more of the surface than its border does. Its sheet
//!    may leave it by as much as sheet leaves a ruled surface, and no farther.
//! 3. The pattern of such a mesh may be fitted to its sheet, if that would need force (`fit`); not
//!    where it fits the surface as it is: what then strains the sheet is that it resists its bend,
//!    which no pattern takes away, and metal that yields does not do (`rolled`).
//! 4. A strip (no points inside its border) lies flat exactly, and its sheet is free within. If it
//!    needs force so, and its pattern may be fitted, it is also judged like the surface that it
//!    samples, as finer meshes of it are, and has the better of both verdicts. Either way, its
//!    sheet begins on the smooth surface through its rails (`surface`), not on its creases.
//! 5. Where no sheet can be computed, a strip is judged by the formula of `screen`, with the turn
//!    of its facing along its sides as the warp.
//! 6. Of a sheet that does not take its shape, a thinner one that does is looked for.
//! 7. Where the triangles of the pattern are stretched by more than a theory of small strains holds
//!    for, and by far more than the material takes, their strain decides; but not on a saddle whose
//!    fitted pattern is stretched by less. It decides, with its doubt, where no sheet can be
//!    computed, too.

use super::narrow::{Turn, narrow, tight, tightest};
use super::predict::{FLAT, NETS, by_nets, stiffness_of};
use super::rolled::{is_developable, rolled};
use super::screen::by_formula;
use super::surface::facing;
use super::thickest::thickest_mm;
use super::{
    Basis, DECIDES, Edges, Elastic, ElasticError, ElasticOptions, Predicted, Reading, Task,
    at_rest, at_share, curvature_of_surface, strain_of_fitted,
};
use crate::flatten::Flattened;
use crate::material::{EASY_SHARE, Limits, Material};
use crate::measure::{Distortion, area_flat};
use crate::mesh::{Mesh, MeshEdge, angle_defects, crease_angles, scored_creases};
use crate::sheet::{Sheet, split_at};
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::angle_between;
use sheetwright_geometry::watch::Watch;
use std::borrow::Cow;

/// How far a sheet may leave a surface that has points inside its border, as a share of its size:
/// as thin sheet leaves ruled surfaces, by 0.2 to 0.5 % in simulations.
const BAND: f64 = 0.005;
/// The largest strain for which a sheet is computed: the theory is one of small strains.
const SMALL: f64 = 0.05;
/// A sheet that takes larger strains is computed up to so many times its limit.
const BEYOND: f64 = 4.0;
/// Patterns that are strained by up to this may be fitted nevertheless.
const FITTABLE: f64 = 0.5;
/// A saddle has at most this share of its curvature in points where it is curved like a dome.
const DOMED: f64 = 0.1;
/// A mesh may take so many times the steps of a surface that was found: it is farther from rest.
const PATIENCE: usize = 2;
/// While the thickest sheet that takes the shape is looked for, the thickness is halved so often at
/// the most. Who asked for a sheet eight times as thick has another one in mind.
const HALVINGS: usize = 3;
/// The pattern of each of these sheets is fitted so often at the most, and until it uses no more
/// than this share of the limit: one net may be wrong by a quarter.
const FITS_OF_THICKEST: usize = 6;
const CLEARLY: f64 = 0.79;
/// A fitted pattern goes before the exact one of a strip where it leaves less than this share of
/// the strain.
const FAR_LESS: f64 = 2.0 / 3.0;
/// A pattern has the lengths of its mesh that differ by no more than this share: rounded files.
const EXACT: f64 = 1e-4;
/// A mesh is computed in so many pieces at the most: of more, creases are facets that are meant.
const MOST_PIECES: usize = 64;

/// Predicts the strain of a sheet whose surface is a mesh, and whose pattern may be fitted to it so
/// often. `None` where the watcher asks to stop.
pub fn predict_given(
    sheet: &Sheet,
    flat: &Flattened,
    distortion: &Distortion,
    material: Option<&Material>,
    fits: usize,
    watch: &mut dyn Watch,
) -> Option<Predicted> {
    let area = area_flat(sheet, flat);
    let limits_at = |curvature: f64| Limits::of(material, area, curvature);
    let creases = crease_angles(sheet.mesh());
    if distortion.length_error_max <= FLAT && creases.iter().all(|&crease| crease <= FLAT) {
        return Some(Predicted::flat(limits_at(0.0)));
    }
    let strain = distortion.strain_p95(sheet.mesh());
    let most = SMALL.max(BEYOND * limits_at(0.0).strain);
    let turns = turns(sheet.mesh());
    let limits = limits_at(0.0);
    let mut narrow = match (is_strip(sheet.mesh()), distortion.length_error_max <= EXACT) {
        (true, _) => narrow(&turns, area, &limits),
        // Where lengths are true, the sheet is strained by no crease.
        (false, true) => dividing(sheet.mesh(), tight(&turns, area, &limits)),
        (false, false) => Vec::new(),
    };
    let mut pieces = folded(sheet, flat, &narrow);
    if pieces.is_none() {
        narrow.clear();
        pieces = folded(sheet, flat, &narrow);
    }
    let Some((folded, flat)) = pieces else {
        return Some(Predicted::of_pattern(limits_at(0.0), strain));
    };
    let reading = reading_of(folded.mesh());
    let is_far = strain > most;
    // Pieces that are fitted each by itself part at their creases.
    let fits = if folded.mesh().components().len() == 1 { fits } else { 0 };
    // A pattern may heap in a few places what a fitted one has nowhere. A saddle is relieved where
    // the sheet leaves it; a dome is so only by wrinkles.
    let fits_better = || {
        let fitted = || strain_of_fitted(&folded, &flat, (reading, !narrow.is_empty()));
        fits > 0 && strain <= FITTABLE && fitted().is_some_and(|fitted| fitted <= most)
    };
    let may_fit = |mesh: &Mesh| is_saddle(mesh) && fits_better();
    if is_far && !may_fit(sheet.mesh()) {
        return Some(Predicted::of_pattern(limits, strain));
    }
    let tightest = tightest(&turns, &narrow);
    let curvature = curvature_of(&folded, &flat, (reading, !narrow.is_empty()));
    let limits = limits_at(curvature);
    let warp = if is_strip(folded.mesh()) { least_warp(folded.mesh()) } else { 0.0 };
    let is_flat = strain <= EASY_SHARE * limits.strain;
    let is_developable = is_flat && is_developable(&limits, warp * warp);
    let given = Given {
        sheet: &folded,
        flat: &flat,
        reading,
        limits,
        nets: &NETS,
        enough: EASY_SHARE,
        curvature,
        tightest,
        is_developable,
        is_far,
    };
    let fits = if is_developable { 0 } else { fits };
    match given.judged(fits, watch) {
        Err(ElasticError::Stopped) => None,
        Err(error) if is_strip(given.sheet.mesh()) => {
            Some(strip_by_formula(&folded, given.limits, curvature, error))
        }
        Err(_) => {
            let curvature = curvature.max(tightest);
            Some(Predicted { curvature, ..Predicted::of_pattern(given.limits, strain) })
        }
        Ok(predicted) if predicted.usage_range()[0] <= 1.0 => Some(predicted),
        Ok(predicted) => {
            let takes = |mm: f64| given.takes_in(mm, fits, watch);
            let thickest_mm = thickest_mm(given.limits.thickness_mm, HALVINGS, takes);
            (!watch.stop()).then_some(Predicted { thickest_mm, ..predicted })
        }
    }
}

/// A sheet that is to be judged.
struct Given<'a> {
    sheet: &'a Sheet,
    flat: &'a Flattened,
    reading: Reading,
    limits: Limits,
    nets: &'a [[usize; 2]],
    /// Its pattern is fitted until the strain is no more than this share of the limit.
    enough: f64,
    /// That of its surface, 1/mm.
    curvature: f64,
    /// That of its narrow bends, 1/mm; 0 without any.
    tightest: f64,
    /// Whether its surface is developable, as far as its triangles tell.
    is_developable: bool,
    /// Whether its pattern is strained by more than the theory holds for, unless it is fitted.
    is_far: bool,
}

/// How easily a sheet takes its shape, from the worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Ease {
    Refused,
    Unsure,
    Yields,
    Force,
    Easy,
}

/// What holds a sheet besides its border.
#[derive(Clone, Copy)]
struct Held {
    /// The band about its surface, mm; `None` of a sheet that is free within.
    band_mm: Option<f64>,
    /// How often its pattern may be fitted, and whether it is in any case.
    fits: usize,
    fits_anyway: bool,
}

impl Given<'_> {
    /// The prediction for it, whose pattern may be fitted so often.
    fn judged(&self, fits: usize, watch: &mut dyn Watch) -> Result<Predicted, ElasticError> {
        let elastic = self.elastic(fits, watch)?;
        if !self.is_developable {
            return Ok(elastic);
        }
        let again =
            |limits: &Limits| Given { limits: limits.clone(), ..*self }.elastic(fits, watch).ok();
        let found = rolled(elastic, [self.curvature, self.tightest], again);
        if watch.stop() { Err(ElasticError::Stopped) } else { Ok(found) }
    }

    /// The prediction for an elastic sheet, whose pattern may be fitted so often.
    fn elastic(&self, fits: usize, watch: &mut dyn Watch) -> Result<Predicted, ElasticError> {
        if is_strip(self.sheet.mesh()) {
            self.strip(fits, watch)
        } else {
            self.surface(fits, self.is_far, watch)
        }
    }

    /// A strip is free within its border, and its pattern is exact. If it would need force or yield
    /// so, it is judged as any surface is, and is that where it then takes its shape better.
    fn strip(&self, fits: usize, watch: &mut dyn Watch) -> Result<Predicted, ElasticError> {
        let held = Held { band_mm: None, fits: 0, fits_anyway: false };
        let free = self.predicted(held, watch);
        let is_done = match &free {
            Ok(free) => self.is_at_best(free),
            Err(error) => *error != ElasticError::NoRest,
        };
        if is_done || fits == 0 {
            return free;
        }
        match (free, self.surface(fits, true, watch)) {
            (_, Err(ElasticError::Stopped)) => Err(ElasticError::Stopped),
            (Err(_), surface) => surface,
            (Ok(free), Ok(surface)) if self.is_better(&surface, &free) => Ok(surface),
            (free, _) => free,
        }
    }

    /// How easily a sheet takes its shape.
    fn ease(&self, predicted: &Predicted) -> Ease {
        let [least, most] = predicted.usage_range();
        if least > 1.0 {
            Ease::Refused
        } else if most > 1.0 {
            Ease::Unsure
        } else if self.limits.yields_at(predicted.curvature) {
            Ease::Yields
        } else if predicted.usage() > EASY_SHARE {
            Ease::Force
        } else {
            Ease::Easy
        }
    }

    /// Whether it could not take its shape more easily: it bends freely, or its surface itself has
    /// it rolled. That a twisted strip is curved so much can't be told from its creases.
    fn is_at_best(&self, predicted: &Predicted) -> bool {
        let curvature = self.curvature.max(self.tightest);
        let is_rolled = self.limits.yields_at(curvature) && !self.is_twisted();
        let best = if is_rolled { Ease::Yields } else { Ease::Easy };
        self.ease(predicted) >= best
    }

    /// Whether the warp of a strip alone would take force, by the formula of `screen`.
    fn is_twisted(&self) -> bool {
        let warp_squared = warp_squared(self.sheet.mesh());
        let of_warp = by_formula(self.limits.clone(), 0.0, warp_squared).strain;
        of_warp > EASY_SHARE * self.limits.strain
    }

    /// Whether one sheet takes the shape more easily than another, or as easily and strained by far
    /// less.
    fn is_better(&self, one: &Predicted, other: &Predicted) -> bool {
        let [of_one, of_other] = [one, other].map(|predicted| self.ease(predicted));
        of_one > of_other || of_one == of_other && one.strain < FAR_LESS * other.strain
    }

    /// A surface holds its sheet within a band.
    fn surface(
        &self,
        fits: usize,
        fits_anyway: bool,
        watch: &mut dyn Watch,
    ) -> Result<Predicted, ElasticError> {
        let held = Held { band_mm: Some(BAND * self.size_mm()), fits, fits_anyway };
        self.predicted(held, watch)
    }

    fn size_mm(&self) -> f64 {
        size_of(self.sheet.mesh().positions().iter().copied())
    }

    fn predicted(&self, held: Held, watch: &mut dyn Watch) -> Result<Predicted, ElasticError> {
        let predicted = by_nets(self.nets, &self.limits, |options, coarser| {
            let Some(coarser) = coarser else {
                return self.at_rest(&self.limits, held, options, None, watch);
            };
            // From the rest on the coarser net, a few steps lead to rest, or many to none.
            let few = ElasticOptions { most_steps: options.most_steps / 2, ..*options };
            match self.at_rest(&self.limits, held, &few, Some(coarser), watch) {
                Err(ElasticError::NoRest) => self.at_rest(&self.limits, held, options, None, watch),
                found => found,
            }
        })?;
        Ok(Predicted { curvature: predicted.curvature.max(self.tightest), ..predicted })
    }

    /// Whether a sheet of this thickness, mm, takes the shape clearly on the first net, with the
    /// fits of the pattern that a run in it does first. Further fits only lower the strain.
    fn takes_in(&self, thickness_mm: f64, fits: usize, watch: &mut dyn Watch) -> bool {
        let limits = self.limits.in_thickness(thickness_mm);
        let thinner = Given { limits, nets: &NETS[..1], enough: CLEARLY, ..*self };
        let found = thinner.judged(fits.min(FITS_OF_THICKEST), watch);
        found.is_ok_and(|found| found.usage_range()[1] <= 1.0)
    }

    fn at_rest(
        &self,
        limits: &Limits,
        Held { band_mm, fits, fits_anyway }: Held,
        options: &ElasticOptions,
        coarser: Option<&Elastic>,
        watch: &mut dyn Watch,
    ) -> Result<Elastic, ElasticError> {
        let (most_steps, fitted) = (PATIENCE * options.most_steps, limits.strain * self.enough);
        // Only the first net of a sheet that is judged for itself is worth another start.
        let is_first = coarser.is_none() && options.triangles == NETS[0][0] && self.nets.len() > 1;
        let reading = self.reading;
        let options = ElasticOptions {
            band_mm,
            most_steps,
            fits,
            fitted,
            fits_anyway,
            starts_anew: is_first,
            reading,
            leaves_needles: self.tightest > 0.0,
            ..*options
        };
        let stiffness = stiffness_of(limits, self.size_mm());
        let edges = Edges::default();
        let task = Task { sheet: self.sheet, flat: self.flat, edges: &edges, coarser };
        at_rest(&task, stiffness, &options, watch)
    }
}

/// Estimates the strain of a sheet whose surface is a mesh without computing one: that of the
/// triangles of the pattern, and of a strip by the formula of `screen`.
pub fn screen_given(
    sheet: &Sheet,
    flat: &Flattened,
    distortion: &Distortion,
    material: Option<&Material>,
) -> Predicted {
    let area = area_flat(sheet, flat);
    let strain = distortion.strain_p95(sheet.mesh());
    if !is_strip(sheet.mesh()) {
        return Predicted::of_pattern(Limits::of(material, area, 0.0), strain);
    }
    let curvature = curvature_of(sheet, flat, (Reading::Smooth, false));
    let limits = Limits::of(material, area, curvature);
    by_formula(limits, curvature, warp_squared(sheet.mesh()))
}

/// Whether a mesh is curved like a saddle nearly everywhere.
fn is_saddle(mesh: &Mesh) -> bool {
    let defects = angle_defects(mesh).into_iter().zip(mesh.topology().on_border());
    let within: Vec<f64> = defects.filter(|(_, on_border)| !on_border).map(|(d, _)| d).collect();
    let like_a_dome: f64 = within.iter().filter(|defect| **defect > 0.0).sum();
    like_a_dome <= DOMED * within.iter().map(|defect| defect.abs()).sum::<f64>()
}

/// Whether all points of a mesh lie on its border.
fn is_strip(mesh: &Mesh) -> bool {
    !mesh.topology().on_border().contains(&false)
}

/// The creases of a strip are none of its surface.
fn reading_of(mesh: &Mesh) -> Reading {
    if is_strip(mesh) { Reading::Smooth } else { Reading::Facets }
}

/// The turns of a mesh at its sides.
fn turns(mesh: &Mesh) -> Vec<Turn> {
    let creases = crease_angles(mesh).into_iter().zip(scored_creases(mesh)).zip(warps(mesh));
    let turn = |(edge, ((angle, scored), warp)): (&MeshEdge, ((f64, f64), f64))| {
        let [from, to] = edge.ends.map(|v| mesh.position(v));
        let area = |t: TriangleIndex| mesh.area_vector(t).length();
        let area_mm2 = edge.triangles.iter().flatten().map(|&t| area(t)).sum();
        // The triangles of a strip mostly come in their order.
        let place = edge.triangles.iter().flatten().map(|t| t.get()).min().unwrap_or(0);
        let (length_mm, is_fold) = (from.distance(to), scored > 0.0);
        Turn { angle, length_mm, area_mm2, place, warp, is_fold }
    };
    mesh.edges().iter().zip(creases).map(turn).collect()
}

/// Those of some sides that divide a mesh, cut along all of them. At the point of a cone narrow
/// triangles meet, and their sides divide nothing.
fn dividing(mesh: &Mesh, mut sides: Vec<usize>) -> Vec<usize> {
    let Ok(apart) = split_at(mesh, |n| sides.binary_search(&n).is_ok()) else { return Vec::new() };
    let mut piece_of = vec![0; mesh.triangles().len()];
    for (n, piece) in apart.mesh().components().iter().enumerate() {
        piece.triangles.iter().for_each(|t| piece_of[t.get()] = n);
    }
    sides.retain(|&n| match mesh.edges()[n].triangles {
        [Some(a), Some(b)] => piece_of[a.get()] != piece_of[b.get()],
        _ => false,
    });
    sides
}

/// The sheet cut along the sharp creases that divide it, and along those of `narrow` bends; `None`
/// where it falls into many pieces.
fn folded<'a>(
    sheet: &'a Sheet,
    flat: &'a Flattened,
    narrow: &[usize],
) -> Option<(Cow<'a, Sheet>, Cow<'a, Flattened>)> {
    let scored = scored_creases(sheet.mesh());
    let is_narrow = |n: usize| narrow.binary_search(&n).is_ok();
    let folded = split_at(sheet.mesh(), |n| scored[n] > 0.0 || is_narrow(n)).ok()?;
    match folded.mesh().components().len() {
        1 => Some((Cow::Borrowed(sheet), Cow::Borrowed(flat))),
        pieces if pieces > MOST_PIECES => None,
        _ => {
            let vertices = (0..folded.mesh().positions().len()).map(VertexIndex::new);
            let points = vertices.map(|v| flat.points[folded.origin(v).get()]).collect();
            Some((Cow::Owned(folded), Cow::Owned(Flattened { points, overlap: None })))
        }
    }
}

/// The curvature that 95 % of the area of a surface stays below, 1/mm: the lesser of that on a net,
/// which curls by up to a tenth more at facets and beside its border, and of that by its creases,
/// which tells too much where sides run askew to the bend, or points are off the surface.
fn curvature_of(sheet: &Sheet, flat: &Flattened, read: (Reading, bool)) -> f64 {
    let by_creases = curvature_by_creases(sheet.mesh());
    let on_net = curvature_of_surface(sheet, flat, read);
    on_net.map_or(by_creases, |on_net| on_net.min(by_creases))
}

/// The curvature that 95 % of the area of a mesh stays below, by its creases, 1/mm. Of two
/// triangles that meet in a crease, it turns by the angle over half of the width of both, which is
/// their area over the length of the crease.
fn curvature_by_creases(mesh: &Mesh) -> f64 {
    let is_within = |(_, edge): &(Turn, &MeshEdge)| !edge.triangles.contains(&None);
    let turns = turns(mesh).into_iter().zip(mesh.edges()).filter(is_within);
    let of_turn = |(turn, _): (Turn, &MeshEdge)| {
        (if turn.is_fold { 0.0 } else { turn.curvature() }, turn.area_mm2)
    };
    let (curvatures, areas): (Vec<f64>, Vec<f64>) = turns.map(of_turn).unzip();
    at_share(&curvatures, &areas, DECIDES)
}

/// What the formula predicts of a strip, whose lengths the pattern keeps.
fn strip_by_formula(
    sheet: &Sheet,
    limits: Limits,
    curvature: f64,
    error: ElasticError,
) -> Predicted {
    let basis = if error == ElasticError::NoNet { Basis::NoNet } else { Basis::NoRest };
    Predicted { basis, ..by_formula(limits, curvature, warp_squared(sheet.mesh())) }
}

/// The warp of every side between two triangles, by which the facing turns from its one end to the
/// other, radians; 0 on the border.
fn warps(mesh: &Mesh) -> Vec<f64> {
    let facing = facing(mesh);
    let warp = |[a, b]: [VertexIndex; 2]| angle_between(facing[a.get()], facing[b.get()]);
    let is_within = |sides: &[Option<TriangleIndex>; 2]| sides.iter().all(Option::is_some);
    let edges = mesh.edges().iter();
    edges.map(|edge| if is_within(&edge.triangles) { warp(edge.ends) } else { 0.0 }).collect()
}

/// The mean square of the warp of a strip, radians².
fn warp_squared(mesh: &Mesh) -> f64 {
    let (mut squares, mut whole) = (0.0, 0.0);
    for (edge, warp) in mesh.edges().iter().zip(warps(mesh)) {
        let [Some(a), Some(b)] = edge.triangles else { continue };
        let area = mesh.area_vector(a).length() + mesh.area_vector(b).length();
        squares += area * warp * warp;
        whole += area;
    }
    if whole > 0.0 { squares / whole } else { 0.0 }
}

/// The warp that 95 % of the area of a strip stays below, radians, where each triangle has the
/// least of its sides: one that runs askew to the rulings has the bend between its ends in it.
fn least_warp(mesh: &Mesh) -> f64 {
    let (warps, edges) = (warps(mesh), mesh.edges());
    let is_within = |n: &usize| edges[*n].triangles.iter().all(Option::is_some);
    let triangles = (0..mesh.triangles().len()).map(TriangleIndex::new);
    let least = triangles.clone().map(|triangle| {
        let sides = mesh.topology().edges_of(triangle).into_iter().filter(is_within);
        sides.map(|n| warps[n]).reduce(f64::min).unwrap_or(0.0)
    });
    let areas: Vec<f64> = triangles.map(|t| mesh.area_vector(t).length()).collect();
    at_share(&least.collect::<Vec<_>>(), &areas, DECIDES)
}
