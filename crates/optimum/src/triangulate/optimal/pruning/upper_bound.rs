//! An upper bound on the price of the answer: what a triangulation costs that is found near to that
//! of the loop of every fourth sample.
//!
//! 1. The loop of the corners and every fourth sample is solved first, the same way. Near to the
//!    rungs of its optimum, all rungs are priced and put together: a band of the table. Next to a
//!    developable surface, the optimum of the band costs a quarter of what that of the thinned loop
//!    does, and is the cheapest triangulation of all or nearly so.
//! 2. Far from a developable surface, where the band is dearer than the thinned loop, its optimum
//!    may have another shape than that of all samples; then the thinned loop is solved with cheaper
//!    folds as well, and the cheaper of two bands is the bound.
//! 3. If neither has a triangulation, the bound is guessed from the optimum of the thinned loop,
//!    and raised until there is an answer below it.

use super::band::Band;
use super::{HIGHEST_BOUND, fill, solve_priced};
use crate::cost::quantised;
use crate::triangulate::optimal::memory_needed;
use crate::triangulate::optimal::table::Table;
use crate::triangulate::part::Part;
use crate::triangulate::thinned::kept;
use crate::triangulate::{Solved, Terms, TriangulateError, if_it_fits};
use sheetwright_geometry::watch::Watch;
use std::slice;

/// One sample in about so many is kept in the thinned loop.
const THINNING: usize = 4;
/// Loops with fewer samples are solved without a bound: it would cost more than it saves.
const LEAST_THINNED: usize = 64;
/// How much more than that of the thinned loop the answer may cost, where its rungs lead to none.
const GUESSES: [f64; 2] = [1.3, 5.2];

/// What the cheapest triangulation near to the rungs of these triangles costs, if that is less than
/// `bound`; else `bound`.
pub(super) fn price_near(
    terms: &Terms<'_>,
    triangles: impl Iterator<Item = [usize; 3]>,
    bound: f64,
    watch: &mut dyn Watch,
) -> Result<f64, TriangulateError> {
    let mut table = Table::new(terms);
    if table.m < LEAST_THINNED {
        return Ok(bound);
    }
    let band = Band::about(triangles, &kept(terms.prices, &(0..table.m), THINNING), table.m);
    let found = fill(&mut table, bound, Some(&band), &mut Part::silent(watch), 0.0..0.0);
    Ok(if_it_fits(found.map(Some))?.map_or(bound, |price| price.min(bound)))
}

/// Bounds on the price of the answer, to be tried one after the other; the last one holds, or is
/// none.
pub(super) fn bounds(
    table: &mut Table<'_>,
    watch: &mut dyn Watch,
) -> Result<Vec<f64>, TriangulateError> {
    let (terms, m) = (table.terms, table.m);
    if m < LEAST_THINNED {
        return Ok(vec![f64::INFINITY]);
    }
    let kept = kept(terms.prices, &(0..m), THINNING);
    let thinned = terms.thinned(&kept, slice::from_ref(&(0..kept.len())));
    let left = |table: &Table<'_>| terms.memory.saturating_sub(table.bytes());
    let few = thinned.terms().within(left(table));
    let coarse = solve_priced(&few, watch).map_err(|error| refused(terms, error))?;
    let Some(coarse) = coarse else { return Ok(vec![f64::INFINITY]) };
    let band_of = |coarse: &Solved| Band::along(&coarse.triangles, &kept, m);
    let band = band_of(&coarse);
    let mut price = fill(table, f64::INFINITY, Some(&band), watch, 0.0..0.0)?;
    if terms.folds() && coarse.price <= HIGHEST_BOUND && price > coarse.price {
        table.clear();
        let thinned = thinned.with_cheaper_folds(THINNING);
        let few = thinned.terms().within(left(table));
        let other = if_it_fits(solve_priced(&few, watch))?.as_ref().map(band_of);
        if let Some(other) = other.filter(|other| !band.covers(other)) {
            price = price.min(fill(table, price, Some(&other), watch, 0.0..0.0)?);
        }
    }
    let guessed = |guess: f64| quantised((guess * coarse.price).min(HIGHEST_BOUND));
    Ok(match price {
        _ if price <= HIGHEST_BOUND => vec![price],
        f64::INFINITY if coarse.price <= HIGHEST_BOUND => {
            GUESSES.map(guessed).into_iter().chain([f64::INFINITY]).collect()
        }
        _ => vec![f64::INFINITY],
    })
}

/// What it means that the thinned loop was refused: this one needs more.
fn refused(terms: &Terms<'_>, error: TriangulateError) -> TriangulateError {
    match error {
        TriangulateError::TooLarge { .. } => TriangulateError::TooLarge {
            needed: memory_needed(terms.prices.len()),
            limit: terms.memory,
        },
        error => error,
    }
}

#[cfg(test)]
mod tests {
    use super::super::solve_within;
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
    fn bounds_lead_to_the_answer_of_the_table_alone() {
        for (seed, fold) in (0..8).flat_map(|seed| [(seed, 0.0), (seed, 1.0)]) {
            let boundary = curve(544, seed);
            let options = PriceOptions { fold, ..Default::default() };
            let prices = Prices::new(&boundary, None, options);
            let everything = Visibility::everything();
            let terms = Terms::new(&prices, &everything, false);
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
    }
}
