//! What a real sheet does whose surface was found: the strain that decides the verdict.
//!
//! 1. Folds that the boundary itself has, since it turns in space where the pattern does not, are
//!    needed. An elastic sheet that is scored there is computed. If it finds no rest from the
//!    surface, it begins anew as a far stiffer sheet, which unfolds, and is made softer step by
//!    step. Folds that it does not smooth are needed, too: it turns sharply there all the same, and
//!    is computed with them scored.
//! 2. If it stretches by more than its limit and the surface has further folds, the sheet is
//!    computed with all of them scored. They are needed if that helps.
//!    If it is developable and yields, it is computed as one that is rolled (`rolled`); if it is
//!    nearly so and only a rolled sheet takes it, the verdict stays open. Where it is rolled more
//!    tightly than a net can follow, as the tip of a cone, a formula decides.
//!    Bends that are narrower than a net tells are held as they are (`narrow`).
//! 3. Where the strain comes near to the limit, finer nets are asked as well; if the limit still
//!    lies between what they give and what they tend to, nobody can tell.
//! 4. Of a sheet that does not take its shape, the thickest one that does is looked for.
//! 5. A sheet whose pattern overlaps itself has no net; it is computed in pieces.
//! 6. Where no sheet can be computed, a formula estimates the strain, with its doubt.

use super::folds::{Border, folds, weights};
use super::narrow::{is_beyond_net, narrow_rungs};
use super::rolled::{is_developable, is_nearly_developable, rolled};
use super::screen::curvature_of_rungs;
use super::thickest::thickest_mm;
use super::tight::curvature_of_patches;
use super::{
    Basis, DECIDES, Edges, Elastic, ElasticError, ElasticOptions, Predicted, Stiffness, at_share,
    elastic_on,
};
use crate::flatten::Flattened;
use crate::material::Limits;
use crate::measure::{Measures, RungMeasures};
use crate::mesh::Cut;
use crate::sheet::{Sheet, cut_along};
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point3, Vec2, angle_between};
use sheetwright_geometry::watch::Watch;

/// The nets: about how many triangles each has, and how many steps it may take at the most. A finer
/// one is asked only while the limit lies in the range that the strain may have.
pub(super) const NETS: [[usize; 2]; 3] = [[350, 40], [800, 30], [1600, 24]];
/// So many of them are asked for a sheet that only counts if it takes its shape clearly.
const FEW_NETS: usize = 2;
/// Angles up to it, radians, are rounding: the sheet is flat.
pub(super) const FLAT: f64 = 1e-9;
/// Sheet is computed as if it were at least so thick, as a share of its size: rounding hides the
/// stiffness of thinner sheet, which bends no worse.
const THINNEST: f64 = 1e-5;
/// A sheet whose pattern overlaps itself is cut into so many pieces.
const PIECES: [usize; 5] = [2, 3, 4, 6, 10];
/// Where rulings run together is a point if the sheet can't follow it within this share of its
/// size; farther than that, it is bent too tightly.
const LARGEST_POINT: f64 = 0.25;
/// At so many places of a fold it is asked whether the sheet at rest has smoothed it.
const FOLD_PLACES: usize = 7;
/// While the thickest sheet that takes the shape is looked for, the thickness is halved so often at
/// the most.
const HALVINGS: usize = 6;

/// Predicts the strain of a sheet whose surface was found, and the folds that it needs, where a
/// formula has `screened` it, and whose border is held as `edges` say. `None` where the watcher
/// asks to stop.
pub fn predict(
    sheet: &Sheet,
    flat: &Flattened,
    edges: &Edges,
    measures: &Measures,
    screened: &Predicted,
    watch: &mut dyn Watch,
) -> Option<Predicted> {
    let judge = Judge { sheet, flat, edges, measures, limits: &screened.limits, nets: &NETS };
    let predicted = judge.judged(screened, watch)?;
    if takes(&predicted) || predicted.basis != Basis::Computed {
        return (!watch.stop()).then_some(predicted);
    }
    let takes = |mm: f64| judge.takes_in(mm, screened, watch);
    let thickest_mm = thickest_mm(screened.limits.thickness_mm, HALVINGS, takes);
    // What folds but does not take the shape at all shows every fold.
    let is_stiff = !screened.limits.folds;
    let scored = if is_stiff { predicted.scored.clone() } else { judge.folds(|_| true) };
    (!watch.stop()).then_some(Predicted { thickest_mm, scored, ..predicted })
}

/// Predicts it as [`predict`] does where the limit is not near: on two nets at the most, and
/// without the thickest sheet that takes the shape; its border is held. `None` where the watcher
/// asks to stop.
pub fn predict_alone(
    sheet: &Sheet,
    flat: &Flattened,
    measures: &Measures,
    screened: &Predicted,
    watch: &mut dyn Watch,
) -> Option<Predicted> {
    let nets = &NETS[..FEW_NETS];
    let (edges, limits) = (&Edges::default(), &screened.limits);
    let judge = Judge { sheet, flat, edges, measures, limits, nets };
    judge.judged(screened, watch).filter(|_| !watch.stop())
}

/// Whether one result goes before another: that the watcher asked to stop, a sheet where the other
/// has none, or one that uses less of what it takes.
fn is_better(
    one: &Result<Predicted, ElasticError>,
    other: &Result<Predicted, ElasticError>,
) -> bool {
    match (one, other) {
        (Ok(one), Ok(other)) => one.usage() < other.usage(),
        (Ok(_), Err(_)) | (Err(ElasticError::Stopped), _) => true,
        (Err(_), _) => false,
    }
}

/// Whether a sheet takes its shape, as far as can be told.
fn takes(predicted: &Predicted) -> bool {
    predicted.usage_range()[0] <= 1.0
}

struct Judge<'a> {
    sheet: &'a Sheet,
    flat: &'a Flattened,
    edges: &'a Edges,
    measures: &'a Measures,
    limits: &'a Limits,
    nets: &'a [[usize; 2]],
}

impl Judge<'_> {
    /// The prediction, with the folds that the sheet needs. `None` where the watcher asks to stop.
    fn judged(&self, screened: &Predicted, watch: &mut dyn Watch) -> Option<Predicted> {
        let elastic = self.elastic(screened, watch)?;
        let warp = self.warp();
        let is_surely = is_developable(self.limits, warp * warp);
        let is_smooth = self.folds(|_| true).is_empty();
        let most = elastic.strain_range[1];
        let may_be_rolled = is_nearly_developable(self.limits, warp * warp)
            && (is_surely || most > self.limits.strain);
        if !is_smooth || !may_be_rolled {
            return Some(elastic);
        }
        let again = |limits: &Limits| Judge { limits, ..*self }.elastic(screened, watch);
        let curvature = curvature_of_rungs(self.measures, &weights(self.sheet));
        let (_, tightest) = narrow_rungs(self.sheet, self.flat, self.measures, self.limits);
        let found = rolled(elastic, [curvature, tightest], again);
        if !is_surely {
            // Few samples may hide the warp of a surface, or make it, so both results are possible.
            return Some(Predicted { strain_range: [found.strain_range[0], most], ..found });
        }
        let is_sure =
            found.usage_range()[1] <= 1.0 || !self.is_rolled_beyond_net(screened, curvature);
        if is_sure {
            return Some(found);
        }
        // The plastic moment strains it by no more, and a bend that is rolled resists by less.
        let strain_range = [screened.strain_range[0], screened.strain];
        let basis = if found.basis == Basis::Computed { Basis::TooTight } else { found.basis };
        Some(Predicted { basis, strain_range, ..screened.clone() })
    }

    /// Whether the sheet is rolled to a surface without any warp, and to more of a curvature, 1/mm,
    /// than its net can follow.
    fn is_rolled_beyond_net(&self, screened: &Predicted, curvature: f64) -> bool {
        let warps = self.measures.rungs.iter().map(RungMeasures::warp_of_surface);
        let warp = warps.fold(0.0, f64::max);
        screened.limits.moment_share < 1.0
            && is_developable(self.limits, warp * warp)
            && is_beyond_net(curvature, self.measures.area_flat_mm2)
    }

    /// The warp that 95 % of the area of the surface stays below, as far as its samples tell,
    /// radians.
    fn warp(&self) -> f64 {
        let warps: Vec<f64> =
            self.measures.rungs.iter().map(RungMeasures::warp_of_surface).collect();
        at_share(&warps, &weights(self.sheet), DECIDES)
    }

    /// The prediction for an elastic sheet.
    fn elastic(&self, screened: &Predicted, watch: &mut dyn Watch) -> Option<Predicted> {
        let Self { sheet, flat, measures, limits, .. } = *self;
        if measures.warp_max <= FLAT && measures.crease_max <= FLAT {
            return Some(Predicted::flat(limits.clone()));
        }
        let folds = self.folds(|_| true);
        let border = Border::new(sheet, flat);
        let needed = self.folds(|rung| border.demands(rung));
        let mut predicted = self.best(&needed, false, watch);
        let is_taken = |p: &Result<Predicted, ElasticError>| p.as_ref().is_ok_and(takes);
        // Of a sheet in another thickness, that it finds no rest at once is told enough.
        if predicted == Err(ElasticError::NoRest) && self.nets.len() > 1 {
            predicted = self.best(&needed, true, watch);
        }
        let unsmoothed = predicted.as_ref().map_or(Vec::new(), |found| self.unsmoothed(found));
        if !unsmoothed.is_empty() {
            let all = self.folds(|rung| needed.contains(&rung) || unsmoothed.contains(&rung));
            predicted = match self.best(&all, false, watch) {
                Err(ElasticError::NoRest) => {
                    predicted.map(|smooth| Predicted { scored: all, ..smooth })
                }
                folded => folded,
            };
        }
        let has_more = |p: &Predicted| limits.folds && p.scored.len() < folds.len();
        if !is_taken(&predicted) && predicted.as_ref().is_ok_and(has_more) {
            let folded = self.best(&folds, false, watch);
            if is_taken(&folded) || is_better(&folded, &predicted) {
                predicted = folded;
            }
        }
        match predicted {
            Err(ElasticError::Stopped) => None,
            Err(error) => {
                let basis = if error == ElasticError::NoNet { Basis::NoNet } else { Basis::NoRest };
                Some(Predicted { basis, ..screened.clone() })
            }
            Ok(predicted) => Some(predicted),
        }
    }

    /// Whether a sheet of this thickness, mm, takes the shape clearly on the first net, with the
    /// folds that it needs.
    fn takes_in(&self, thickness_mm: f64, screened: &Predicted, watch: &mut dyn Watch) -> bool {
        let limits = &self.limits.in_thickness(thickness_mm);
        let thinner = Judge { limits, nets: &NETS[..1], ..*self };
        let is_clear = |p: Predicted| p.basis == Basis::Computed && p.usage_range()[1] <= 1.0;
        thinner.judged(screened, watch).is_some_and(is_clear)
    }

    fn folds(&self, is_so: impl Fn(usize) -> bool) -> Vec<usize> {
        folds(self.measures, is_so)
    }

    /// The folds that a sheet which folds has not smoothed at rest: it turns by more than half of
    /// their angle from one side to the other within the length of a side of the net, and by more
    /// than it takes in half of that, for the net does not tell how tight a bend so narrow is.
    fn unsmoothed(&self, predicted: &Predicted) -> Vec<usize> {
        let Some(sheet) = &predicted.at_rest else { return Vec::new() };
        if !self.limits.folds {
            return Vec::new();
        }
        let area: f64 = sheet.areas_mm2.iter().sum();
        let side_mm = (area / sheet.triangles.len() as f64).sqrt();
        self.folds(|rung| {
            let [a, b] = self.sheet.rung_ends()[rung].map(|v| self.flat.points[v.get()]);
            let along = b - a;
            let across = Vec2::new(-along.y, along.x) * (0.5 * side_mm / along.length());
            let turns = (1..=FOLD_PLACES).filter_map(|n| {
                let at = a + along * (n as f64 / (FOLD_PLACES + 1) as f64);
                let [left, right] = [at + across, at + across * -1.0].map(|p| sheet.normal_at(p));
                Some(angle_between(left?, right?))
            });
            let turns: Vec<f64> = turns.collect();
            let crease = self.measures.rungs[rung].crease.abs();
            let is_beyond = |turn: f64| {
                let bent = self.limits.use_of(0.0, turn / (0.5 * side_mm));
                self.limits.outer_fibre.is_none() || bent > 1.0
            };
            let is_sharp = |turn: &&f64| **turn > 0.5 * crease && is_beyond(**turn);
            let sharp = turns.iter().filter(is_sharp).count();
            !predicted.scored.contains(&rung) && 2 * sharp > turns.len()
        })
    }

    /// The prediction for a sheet that is scored along these rungs, in pieces if need be. It begins
    /// as it is or, where it found no rest so, as a stiffer sheet.
    fn best(
        &self,
        scored: &[usize],
        begins_stiff: bool,
        watch: &mut dyn Watch,
    ) -> Result<Predicted, ElasticError> {
        match self.predicted(scored, begins_stiff, watch) {
            Err(ElasticError::NoNet) => self.in_pieces(scored, begins_stiff, watch),
            predicted => predicted,
        }
    }

    /// The prediction for a sheet that is scored along these rungs.
    fn predicted(
        &self,
        scored: &[usize],
        begins_stiff: bool,
        watch: &mut dyn Watch,
    ) -> Result<Predicted, ElasticError> {
        let Self { sheet, flat, measures, limits, .. } = *self;
        let (narrow, tightest) = narrow_rungs(sheet, flat, measures, limits);
        let mut held = [scored, &narrow[..]].concat();
        held.sort_unstable();
        held.dedup();
        let leaves_needles = !narrow.is_empty();
        let at_rest = |options: &ElasticOptions, _: Option<&Elastic>| {
            let options = ElasticOptions { leaves_needles, begins_stiff, ..*options };
            self.at_rest(limits, &held, &options, watch)
        };
        let predicted = by_nets(self.nets, limits, at_rest)?;
        let of_sheet = |sheet| curvature_of_patches(sheet, limits, &self.points());
        let of_patches = predicted.at_rest.as_ref().map_or(0.0, of_sheet);
        let curvature = predicted.curvature.max(tightest).max(of_patches);
        Ok(Predicted { scored: scored.to_vec(), curvature, ..predicted })
    }

    /// The points of the surface, where rulings run together, each with how far round it the sheet
    /// can't follow, mm. One that reaches far is none.
    fn points(&self) -> Vec<(Point3, f64)> {
        let Some(least_mm) = self.limits.bend_radius_mm() else { return Vec::new() };
        let mesh = self.sheet.mesh();
        let size_mm = size_of(mesh.positions().iter().copied());
        let vertices = (0..mesh.positions().len()).map(VertexIndex::new);
        let of_vertex = |v: VertexIndex| {
            let apexes = self.measures.apexes.iter();
            let here = apexes.filter(move |apex| apex.sample == self.sheet.sample(v));
            here.map(move |apex| (mesh.position(v), apex.reach_mm(least_mm)))
        };
        let most_mm = LARGEST_POINT * size_mm;
        vertices.flat_map(of_vertex).filter(|(_, reach_mm)| *reach_mm < most_mm).collect()
    }

    /// The prediction for a sheet whose pattern overlaps itself: cut along some rungs, evenly, into
    /// as few pieces as have a net. That it is held along these too hardly strains it.
    fn in_pieces(
        &self,
        scored: &[usize],
        begins_stiff: bool,
        watch: &mut dyn Watch,
    ) -> Result<Predicted, ElasticError> {
        let rungs = self.measures.rungs.len();
        for pieces in PIECES {
            let mut cut = scored.to_vec();
            let smooth = |n: &usize| !self.measures.rungs[*n].is_fold;
            cut.extend((1..pieces).map(|n| n * rungs / pieces).filter(smooth));
            cut.sort_unstable();
            cut.dedup();
            let predicted = self.predicted(&cut, begins_stiff, watch);
            if predicted != Err(ElasticError::NoNet) {
                return predicted.map(|found| Predicted { scored: scored.to_vec(), ..found });
            }
        }
        Err(ElasticError::NoNet)
    }

    fn at_rest(
        &self,
        limits: &Limits,
        scored: &[usize],
        options: &ElasticOptions,
        watch: &mut dyn Watch,
    ) -> Result<Elastic, ElasticError> {
        let Self { sheet, flat, edges, .. } = *self;
        let size_mm = size_of(sheet.mesh().positions().iter().copied());
        let stiffness = stiffness_of(limits, size_mm);
        if scored.is_empty() {
            return elastic_on(edges, sheet, flat, stiffness, options, watch);
        }
        let ends = scored.iter().map(|&n| sheet.rung_ends()[n]);
        let topology = sheet.mesh().topology();
        let cut: Cut = ends.filter_map(|[a, b]| topology.edge_between(a, b)).collect();
        let cut = cut_along(sheet.mesh(), &cut).map_err(|_| ElasticError::NoNet)?;
        let vertices = (0..cut.mesh().positions().len()).map(VertexIndex::new);
        let points = vertices.map(|v| flat.points[cut.origin(v).get()]).collect();
        let (edges, flat) = (edges.of_cut(&cut), Flattened { points, overlap: None });
        elastic_on(&edges, &cut, &flat, stiffness, options, watch)
    }
}

/// The prediction for a sheet by one net, or by finer ones as well while the limit lies in the
/// range that its strain may have. Each is asked with the sheet on the one before.
pub(super) fn by_nets(
    nets: &[[usize; 2]],
    limits: &Limits,
    mut at_rest: impl FnMut(&ElasticOptions, Option<&Elastic>) -> Result<Elastic, ElasticError>,
) -> Result<Predicted, ElasticError> {
    let mut predicted: Option<Predicted> = None;
    for &[triangles, most_steps] in nets {
        let options = ElasticOptions { triangles, most_steps, ..ElasticOptions::default() };
        let coarser = predicted.as_ref().and_then(|coarser| coarser.at_rest.as_ref());
        let at_rest = match at_rest(&options, coarser) {
            Ok(at_rest) => at_rest,
            Err(ElasticError::NoNet | ElasticError::NoRest) if predicted.is_some() => break,
            Err(error) => return Err(error),
        };
        let next = match &predicted {
            None => Predicted::computed(limits.clone(), at_rest),
            Some(coarser) => coarser.refined(at_rest),
        };
        let [least, most] = next.usage_range();
        predicted = Some(next);
        if least > 1.0 || most <= 1.0 {
            break;
        }
    }
    predicted.ok_or(ElasticError::NoNet)
}

/// The stiffness of a sheet of this size, mm. Without a modulus, strains are those of any other:
/// they depend on the thickness alone.
pub(super) fn stiffness_of(limits: &Limits, size_mm: f64) -> Stiffness {
    let thickness_mm = limits.thickness_mm.max(THINNEST * size_mm);
    let modulus = limits.modulus_n_per_mm2.unwrap_or(1.0);
    let elastic = Stiffness::new(thickness_mm, modulus, limits.poisson);
    Stiffness { bending_n_mm: elastic.bending_n_mm * limits.moment_share, ..elastic }
}
