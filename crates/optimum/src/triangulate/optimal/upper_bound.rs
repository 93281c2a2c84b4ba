//! The table of all rungs, below an upper bound that is found first among few samples.
//!
//! 1. All rungs near to those of a triangulation of the thinned loop are priced and combined: a
//!    band of the table. Next to a developable surface, the optimum of the band costs a quarter of
//!    that of the thinned loop, and is the cheapest triangulation of all or nearly so. Where one
//!    step from few samples to more has shown that, the triangulation of the band serves for the
//!    next step, and the table of the thinned loop, which takes several times as long, is not
//!    filled. Where the next step shows the contrary, that table is filled after all.
//! 2. Far from a developable surface, where the band is dearer than the thinned loop, the optimum
//!    of the thinned loop may have another shape than that of all samples. Then the thinned loop is
//!    triangulated with cheaper folds as well, and the cheaper of two bands is the bound.
//! 3. If neither has a triangulation, the bound is guessed from the optimum of the thinned loop,
//!    and raised until there is a triangulation below it.

use super::band::Band;
use super::table::Table;
use super::{HIGHEST_BOUND, memory_needed, solve_within};
use crate::cost::quantised;
use crate::triangulate::coarse::{Thinned, kept};
use crate::triangulate::part::Part;
use crate::triangulate::{Solved, Terms, TriangulateError, if_it_fits};
use sheetwright_geometry::watch::Watch;

/// Loops with fewer samples are solved without a bound: it would cost more than it saves.
const LEAST_THINNED: usize = 64;
/// For thinned loops with fewer samples, the cheapest triangulation is computed in any case, which
/// takes little.
const LEAST_ROUGH: usize = 128;
/// A triangulation that costs up to so many times as much as that of the thinned loop near which it
/// was found is taken to be nearly the cheapest. Next to a developable surface the ratio is a
/// quarter. Some random curves had 0.31 to 0.46 where another shape was far cheaper.
const NEAR: f64 = 0.3;
/// [`NEAR`] for a triangulation that is found with cheaper folds: it is one guess of two, so it may
/// cost as much as that of the thinned loop.
const NEAR_WITH_CHEAPER_FOLDS: f64 = 1.0;
/// If the next band costs more than so many times as much, the triangulation taken to be nearly the
/// cheapest was not.
const NOT_NEAR: f64 = 0.5;
/// A cheapest triangulation that costs at least so many times as much as the rough one does not
/// lead to another bound.
const CHEAPER: f64 = 0.95;
/// Guesses of the price of the optimum, as multiples of that of the thinned loop, where the band
/// has no triangulation.
const GUESSES: [f64; 2] = [1.3, 5.2];
/// Where the table may exceed the memory limit, that of the thinned loop may take one part in so
/// many of it: next to a developable surface the table has about six times as many tiles, elsewhere
/// up to sixteen times, and at least 3.7 times on the families and the planks of 2,600 to 16,000
/// samples. Where all samples lie in one plane, flat tiles are stored once and it has 1.9 times as
/// many: such a loop may be refused though it would just fit.
const SHARE_OF_THINNED: u64 = 3;
/// The memory of the table as a multiple of that of the thinned loop, for the error where that is
/// refused.
const GROWTH: u64 = 6;

/// The cheapest triangulation; `None` if there is none.
pub(in crate::triangulate) fn solve_priced(
    terms: &Terms<'_>,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let mut table = Table::new(terms);
    let bounds = Bounds::find(&mut table, watch)?;
    fill_below(&mut table, &bounds, watch)
}

/// The price of the cheapest triangulation near to the rungs of these triangles, if it is less than
/// `bound`; else `bound`.
pub(in crate::triangulate) fn price_near(
    terms: &Terms<'_>,
    triangles: impl Iterator<Item = [usize; 3]>,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<f64, TriangulateError> {
    let mut table = Table::new(terms);
    if table.m < LEAST_THINNED {
        return Ok(bound);
    }
    let band = Band::about(triangles, &kept(terms), table.m);
    let found = table.fill(bound, Some(&band), &mut Part::silent(watch), 0.0..0.0);
    Ok(if_it_fits(found.map(Some))?.map_or(bound, |price| price.min(bound)))
}

/// The cheapest triangulation below these bounds; `None` if there is none.
fn fill_below(
    table: &mut Table<'_>,
    bounds: &Bounds,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let mut left = 1.0;
    for &bound in &bounds.prices {
        // The number of bounds is not known: each gets half of the remaining progress.
        let share = 1.0 - left..1.0 - 0.5 * left;
        let price = table.fill(bound, None, watch, share)?;
        if price < f64::INFINITY {
            return Ok(Some(Solved { price, triangles: table.trace() }));
        }
        left *= 0.5;
    }
    Ok(None)
}

/// A cheap triangulation.
struct Rough {
    solved: Solved,
    /// Whether it is the cheapest.
    is_cheapest: bool,
}

/// A triangulation that costs up to `near` times as much as the one of still fewer samples near
/// which it was found, or the cheapest; `None` if there is none.
fn roughly(
    terms: &Terms<'_>,
    near: f64,
    watch: &mut dyn Watch,
) -> Result<Option<Rough>, TriangulateError> {
    let mut table = Table::new(terms);
    let bounds = Bounds::find(&mut table, watch)?;
    let is_near = |&[price, thinned]: &[f64; 2]| table.m >= LEAST_ROUGH && price <= near * thinned;
    if let Some([price, _]) = bounds.held.filter(is_near) {
        let solved = Solved { price, triangles: table.trace() };
        return Ok(Some(Rough { solved, is_cheapest: false }));
    }
    let solved = fill_below(&mut table, &bounds, watch)?;
    Ok(solved.map(|solved| Rough { solved, is_cheapest: true }))
}

/// Upper bounds on the price of the optimum.
struct Bounds {
    /// To be tried one after the other; the last one is valid, or infinite.
    prices: Vec<f64>,
    /// The prices of the triangulation that the table holds, if it holds one, and of that of the
    /// thinned loop near which it was found.
    held: Option<[f64; 2]>,
}

impl Bounds {
    fn find(table: &mut Table<'_>, watch: &mut dyn Watch) -> Result<Self, TriangulateError> {
        let found = if table.m < LEAST_THINNED {
            None
        } else {
            Thinning::of(table).bounds(&mut Part::silent(watch))?
        };
        let none = Self { prices: vec![f64::INFINITY], held: None };
        Ok(found.unwrap_or(none))
    }
}

/// A table, and the loop of some of its samples.
struct Thinning<'t, 'a> {
    table: &'t mut Table<'a>,
    kept: Vec<usize>,
    thinned: Thinned,
    /// Whether the table may exceed the memory limit.
    may_fail: bool,
    /// Memory limit of the table of the thinned loop, bytes.
    share: u64,
}

impl<'t, 'a> Thinning<'t, 'a> {
    fn of(table: &'t mut Table<'a>) -> Self {
        let terms = table.terms;
        let kept = kept(terms);
        let thinned = terms.thinned(&kept);
        let may_fail = memory_needed(table.m) > terms.memory;
        let share = if may_fail { terms.memory / SHARE_OF_THINNED } else { terms.memory };
        Self { table, kept, thinned, may_fail, share }
    }

    /// Bounds by way of the thinned loop; `None` if that has no triangulation.
    fn bounds(self, watch: &mut dyn Watch) -> Result<Option<Bounds>, TriangulateError> {
        // The whole table of the thinned loop shows whether this one has a chance to fit.
        let near = if self.may_fail { 0.0 } else { NEAR };
        let few = self.thinned.terms().within(self.left());
        let rough = roughly(&few, near, watch).map_err(|error| self.refused(error))?;
        let Some(Rough { solved: mut coarse, is_cheapest }) = rough else { return Ok(None) };
        let mut band = self.band_of(&coarse);
        let mut price = self.table.fill(f64::INFINITY, Some(&band), watch, 0.0..0.0)?;
        let mut held = price;
        if price > NOT_NEAR * coarse.price && !is_cheapest {
            let few = self.thinned.terms().within(self.left());
            let before = coarse.price;
            coarse = if_it_fits(solve_within(&few, before, watch))?.unwrap_or(coarse);
            let other = self.band_of(&coarse);
            if coarse.price < CHEAPER * before && !band.covers(&other) {
                held = self.table.fill(price, Some(&other), watch, 0.0..0.0)?;
                price = price.min(held);
                band = other;
            }
        }
        let mut held = Some([held, coarse.price]).filter(|[held, _]| *held < f64::INFINITY);
        if self.table.terms.folds() && coarse.price <= HIGHEST_BOUND && price > coarse.price {
            // The table is needed for others.
            held = None;
            price = price.min(self.with_cheaper_folds(&band, price, watch)?);
        }
        let guessed = |guess: f64| quantised((guess * coarse.price).min(HIGHEST_BOUND));
        let prices = match price {
            _ if coarse.price.min(price) > HIGHEST_BOUND => vec![f64::INFINITY],
            f64::INFINITY => GUESSES.map(guessed).into_iter().chain([f64::INFINITY]).collect(),
            _ => vec![price],
        };
        Ok(Some(Bounds { prices, held }))
    }

    /// The price of a triangulation near that of the thinned loop with cheaper folds, if it is up
    /// to `bound`; infinite if not, or if the known band covers the new one.
    fn with_cheaper_folds(
        self,
        known: &Band,
        bound: f64,
        watch: &mut dyn Watch,
    ) -> Result<f64, TriangulateError> {
        let Self { table, kept, thinned, share, .. } = self;
        let needed = memory_needed(kept.len()).min(share);
        table.clear_for(needed);
        let left = table.terms.memory.saturating_sub(table.bytes()).min(needed);
        let thinned = thinned.with_cheaper_folds();
        let few = thinned.terms().within(left);
        let rough = if_it_fits(roughly(&few, NEAR_WITH_CHEAPER_FOLDS, watch))?;
        let band = rough.map(|rough| Band::along(&rough.solved.triangles, &kept, table.m));
        match band.filter(|band| !known.covers(band)) {
            Some(band) => table.fill(bound, Some(&band), watch, 0.0..0.0),
            None => Ok(f64::INFINITY),
        }
    }

    /// The band near to a triangulation of the thinned loop.
    fn band_of(&self, coarse: &Solved) -> Band {
        Band::along(&coarse.triangles, &self.kept, self.table.m)
    }

    /// The memory left for the table of the thinned loop, bytes.
    fn left(&self) -> u64 {
        self.table.terms.memory.saturating_sub(self.table.bytes()).min(self.share)
    }

    /// The error of this loop, from that of the thinned loop.
    fn refused(&self, error: TriangulateError) -> TriangulateError {
        match error {
            TriangulateError::TooLarge { needed, .. } => TriangulateError::TooLarge {
                needed: (self.table.bytes() + GROWTH * needed).min(memory_needed(self.table.m)),
                limit: self.table.terms.memory,
            },
            error => error,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::{PriceOptions, Prices};
    use crate::rung::Visibility;
    use sheetwright_geometry::boundary::{Boundary, samples_from_points};
    use sheetwright_geometry::curve::CurvePoint;
    use sheetwright_geometry::math::{Point3, cos, sin};
    use sheetwright_geometry::watch::Unwatched;
    use sheetwright_shapes::random::Random;
    use std::f64::consts::TAU;

    /// About a circle that waves three times, by a Fourier series of order 5.
    fn curve(m: usize, seed: u64) -> Boundary {
        let mut random = Random::new(seed);
        let wild = 0.1 * seed as f64;
        let terms: Vec<[f64; 3]> = (1..=5)
            .map(|k| [f64::from(k), random.unit() * wild / f64::from(k * k), random.unit() * TAU])
            .collect();
        let at = |i: usize| {
            let t = TAU * i as f64 / m as f64;
            let wave: f64 = terms.iter().map(|[k, high, from]| high * sin(k * t + from)).sum();
            CurvePoint::smooth(Point3::new(cos(t), sin(t), 0.3 * sin(3.0 * t) + wave))
        };
        let points: Vec<CurvePoint> = (0..m).map(at).collect();
        Boundary::new(vec![samples_from_points(&points)]).unwrap()
    }

    #[test]
    fn what_was_found_roughly_leads_to_the_answer_of_the_table_alone() {
        let mut found = [0; 2];
        for (seed, fold) in (0..8).flat_map(|seed| [(seed, 0.0), (seed, 1.0)]) {
            let boundary = curve(544, seed);
            let options = PriceOptions { fold, ..Default::default() };
            let prices = Prices::new(&boundary, None, options);
            let everything = Visibility::everything();
            let terms = Terms::new(&prices, &everything, false);
            let thinned = terms.thinned(&kept(&terms));
            let few = thinned.terms();
            let rough = roughly(&few, NEAR, &mut Unwatched).unwrap().unwrap();
            found[usize::from(rough.is_cheapest)] += 1;
            let cheapest = solve_within(&few, rough.solved.price, &mut Unwatched).unwrap().unwrap();
            assert!(cheapest.price <= rough.solved.price, "{seed} {fold}");
            if rough.is_cheapest {
                assert_eq!(cheapest.triangles, rough.solved.triangles, "{seed} {fold}");
            }
            let solved = solve_priced(&terms, &mut Unwatched).unwrap().unwrap();
            let alone = solve_within(&terms, f64::INFINITY, &mut Unwatched).unwrap().unwrap();
            assert_eq!(solved.price.to_bits(), alone.price.to_bits(), "{seed} {fold}");
            assert_eq!(solved.triangles, alone.triangles, "{seed} {fold}");
            // About the cheapest is none cheaper; below it there is nothing.
            for bound in [f64::INFINITY, 10.0, solved.price, quantised(0.5 * solved.price)] {
                let triangles = solved.triangles.iter().copied();
                let price = price_near(&terms, triangles, bound, &mut Unwatched).unwrap();
                assert_eq!(
                    price.to_bits(),
                    bound.min(solved.price).to_bits(),
                    "{seed} {fold} {bound}"
                );
            }
        }
        assert!(found[0] > 2 && found[1] > 2, "{found:?}");
    }
}
