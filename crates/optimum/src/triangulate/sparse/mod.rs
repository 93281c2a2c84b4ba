//! The cheapest triangulation of all, found and proved among few rungs.
//!
//! The dense table (`optimal`) works out E(i,j) for every pair of samples whose rung costs no more
//! than a whole triangulation. Next to a developable surface most of them are in vain. Here even
//! fewer rungs are looked at, and the answer is the same, bit by bit, ties included.
//!
//! 1. **A good triangulation** (`corridor`). About every fourth sample is solved, by the same
//!    means; its rungs, widened by a few samples at both ends, are a corridor in which the table
//!    finds a triangulation of all samples. Its price U is nearly always the optimum already; what
//!    follows proves that, or finds what is better.
//! 2. **Asks** (`asks`). Each edge of the boundary asks for what it is paid in that triangulation,
//!    so that all of them together ask for U. A triangle pays its folds and half the price of each
//!    of its rungs; a triangulation's triangles pay its price. The *surplus* s(a,b) of the inner
//!    side of a rung is what its triangles pay at the least, beyond what its edges ask for; where
//!    that is negative, the rung owes −s. The surplus of the whole loop is 0 if U is the optimum,
//!    and else what the optimum is cheaper by. These are the reduced costs of the linear program of
//!    triangulations, as in `holes::bound`.
//! 3. **Few rungs** (`listed`). Suppose that no rung at sample x owes more than D(x). Let those
//!    rungs be listed that cost no more than 2 (D(a) + D(b)). Then, by induction from short rungs
//!    to long ones, the surplus of a rung that is not listed is positive: half of its price alone
//!    exceeds what the two other sides of any triangle below it can owe. For the same reason a
//!    triangle with a side that is not listed leaves any rung a surplus above min(D(a), D(b)). So
//!    it is enough to work out the surpluses of the listed rungs, from listed rungs, up to that
//!    limit.
//! 4. **The table** (`table`) does that, and shows what is owed. If it is more than D somewhere, D
//!    is raised there and the table filled again. If surpluses above the limit were lost that the
//!    loop needs (in another surface through the same boundary, cheaper here and dearer there), D
//!    and the limit are raised everywhere. The loop of fewer samples tells what to begin with, as
//!    what is owed falls as the price does.
//! 5. **Finding the cheap rungs** (`blocks`) takes about as many steps as there are: neighbouring
//!    samples are put together to blocks of 2, 4, 8 …, and cones of their tangents and positions
//!    say what no rung between two blocks costs less than.
//!
//! All prices are whole quanta, asks and surpluses half quanta, so that the proof is exact.
//!
//! How much is owed decides how much work it is. Along a ruling's neighbours, d samples off, a rung
//! costs about c d² U / m, so that about √(D m / c U) rungs a sample are listed. Where the dense
//! table would take less, as the loops of fewer samples show, it takes over; by then a small part
//! of its time is spent.

mod asks;
mod blocks;
mod corridor;
mod listed;
mod table;

use super::part::Part;
use super::thinned::kept;
use super::{Solved, Terms, TriangulateError, if_it_fits, optimal};
use asks::{HALF, asks};
use blocks::{Blocks, levels};
use corridor::corridor;
use listed::listed;
use sheetwright_geometry::watch::Watch;
use table::{Aim, Proof, Table};

/// Loops with fewer samples are left to the dense table: it is faster there, or as fast.
const FASTER_FROM: usize = 5000;
/// What the dense table takes near to a developable surface, in sums compared, for each pair of
/// samples: without folds and with them. As measured at 10,000 samples.
const DENSE_WORK: [u64; 2] = [1, 2];
/// What a listed rung counts as, in sums compared.
const LISTED_WORK: u64 = 8;
/// A loop is expected to take so many times what a quarter of its samples takes.
const GROWTH: u64 = 16;
/// Loops on the way that take less are not given up.
const LEAST_WORK: u64 = 1 << 21;
/// Loops of fewer samples on the way have the dense table.
const LEAST_THINNED: usize = 500;
/// Levels of blocks end where no more than this are left.
const TOP: usize = 20;
/// The level of the blocks that corridors are made of: four samples each.
const NARROW: usize = 2;
/// The lowest level of blocks that are compared: sixteen samples each.
const LOWEST: usize = 4;
/// Answers that cost more are left to the dense table.
const HIGHEST_PRICE: f64 = 100.0;
/// What a sample takes at least, bytes: the rungs listed for it, and the blocks. How much more
/// depends on the boundary; what would exceed the limit is given up.
const BYTES_A_SAMPLE: u64 = 2048;
/// A loop is expected to have so many times the rungs that a quarter of its samples has.
const RUNGS_GROWTH: u64 = 8;
/// How much more may be owed than was found, when that was more than was thought, and how much more
/// than a loop of fewer samples owes, for its size.
const MORE: f64 = 1.25;
/// The most of so many kept samples on both sides may be owed.
const AROUND: usize = 3;
/// The shares of the price up to which surpluses count, one after the other: more takes more time,
/// and with less the bound may not reach the price.
const SHARES: [f64; 10] = [1e-6, 1e-4, 1e-3, 3e-3, 0.01, 0.02, 0.04, 0.08, 0.16, 0.32];
/// The table is filled no more often.
const MOST_TRIALS: usize = 24;

/// The cheapest triangulation; `None` if that is left to the dense table.
pub(super) fn solve(
    terms: &Terms<'_>,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    let m = terms.prices.len();
    if m < FASTER_FROM || m as u64 * BYTES_A_SAMPLE > terms.memory {
        return Ok(None);
    }
    let (memory, dense) = (terms.memory, DENSE_WORK[usize::from(terms.folds())]);
    // The table is about half of all the work here.
    let work = dense * (m as u64).pow(2) / 2;
    let step = Step { least: LEAST_THINNED, top: TOP };
    let found = step.solve(terms, &Budget { memory, work }, watch)?;
    Ok(found.map(|found| found.solved))
}

/// What a table may take.
struct Budget {
    /// Bytes.
    memory: u64,
    /// Sums that are compared.
    work: u64,
}

impl Budget {
    /// For a loop of a quarter of the samples.
    fn of_quarter(&self) -> Self {
        let work = (self.work / GROWTH).max(LEAST_WORK);
        Self { memory: self.memory / RUNGS_GROWTH, work }
    }
}

/// How a loop is solved.
struct Step {
    /// Loops with fewer samples on the way have the table of all rungs.
    least: usize,
    /// The highest level of blocks has no more than this.
    top: usize,
}

/// A triangulation that is proved to be the cheapest.
struct Found {
    solved: Solved,
    /// What sides of each sample owe at the most.
    owed: Vec<f64>,
    /// The share of the price up to which surpluses had to count.
    share: f64,
}

impl Step {
    fn solve(
        &self,
        terms: &Terms<'_>,
        budget: &Budget,
        watch: &mut dyn Watch,
    ) -> Result<Option<Found>, TriangulateError> {
        let m = terms.prices.len();
        let levels = levels(terms, self.top);
        let (narrow, lowest) = (NARROW.min(levels.len() - 1), LOWEST.min(levels.len() - 1));
        let (known, owed, share) = if m < self.least {
            let known = if_it_fits(optimal::solve_priced(terms, &mut Part::silent(watch)))?;
            let Some(known) = known else { return Ok(None) };
            (known, vec![0.0; m], SHARES[0])
        } else {
            let kept = kept(terms);
            let thinned = terms.thinned(&kept);
            let (few, watch) = (thinned.terms(), &mut Part::silent(watch));
            let Some(few) = self.solve(&few, &budget.of_quarter(), watch)? else {
                return Ok(None);
            };
            let rungs = corridor(&levels[narrow], &few.solved, &kept, m);
            let Some(known) = among(terms, &rungs, few.solved.price, budget, watch)? else {
                return Ok(None);
            };
            (known, spread(&few.owed, &kept, m), few.share)
        };
        prove(terms, &levels[lowest..], &known, owed, share, budget, watch)
    }
}

/// The cheapest triangulation among these rungs, likely to cost no more than `likely`.
fn among(
    terms: &Terms<'_>,
    rungs: &[Vec<u32>],
    likely: f64,
    budget: &Budget,
    watch: &mut dyn Watch,
) -> Result<Option<Solved>, TriangulateError> {
    for bound in [likely, HIGHEST_PRICE] {
        let table = Table::fill(terms, rungs, Aim::Among(bound), budget, watch)?;
        let Some(table) = table else { return Ok(None) };
        if let (Some(price), Some(triangles)) = (table.surplus(), table.triangles()) {
            return Ok(Some(Solved { price, triangles }));
        }
    }
    Ok(None)
}

/// The cheapest triangulation of all, from one that is known and from guesses of what sides of each
/// sample may owe and of the share of the price up to which surpluses must count.
fn prove(
    terms: &Terms<'_>,
    levels: &[Blocks],
    known: &Solved,
    mut owed: Vec<f64>,
    mut share: f64,
    budget: &Budget,
    watch: &mut dyn Watch,
) -> Result<Option<Found>, TriangulateError> {
    let m = terms.prices.len();
    let asks = asks(terms, known);
    for i in 0..m {
        owed[i] = owed[i].max(asks[i]).max(asks[(i + m - 1) % m]);
    }
    let (mut left, mut work) = (1.0, budget.work);
    for _ in 0..MOST_TRIALS {
        // How many trials it takes is not known: each gets half of what is left of the progress.
        let watch = &mut Part::new(watch, 1.0 - left..1.0 - 0.5 * left);
        left *= 0.5;
        let counted = halves(share * known.price);
        owed.iter_mut().for_each(|owed| *owed = owed.max(counted));
        let most = (work / LISTED_WORK).min(budget.most_rungs(terms));
        let Some(rungs) = listed(terms, levels, &owed, most, watch)? else { return Ok(None) };
        let proof = Proof::new(&asks, owed, counted);
        let of_trial = Budget { work, ..*budget };
        let table = Table::fill(terms, &rungs, Aim::Proof(&proof), &of_trial, watch)?;
        let Some(table) = table else { return Ok(None) };
        work = work.saturating_sub(table.work);
        let is_less = |(found, owed): (&f64, &f64)| found <= owed;
        if table.owed.iter().zip(&proof.owed).all(is_less) {
            // More than nothing: what is known has sides that are not listed.
            let surplus = table.surplus().filter(|surplus| *surplus <= 0.0);
            if let (Some(surplus), Some(triangles)) = (surplus, table.triangles()) {
                let solved = Solved { price: known.price + surplus, triangles };
                return Ok(Some(Found { solved, owed: table.owed, share }));
            }
            let next = SHARES.into_iter().find(|next| *next > share);
            share = next.unwrap_or(2.0 * share);
        }
        let found = table.owed;
        owed = proof.owed;
        for (owed, found) in owed.iter_mut().zip(found).filter(|(owed, found)| *found > **owed) {
            *owed = halves(MORE * found);
        }
    }
    Ok(None)
}

/// A whole number of half quanta, no more than `price`.
fn halves(price: f64) -> f64 {
    (price / HALF).floor() * HALF
}

/// What may be owed at each of m samples, from what was among those that were kept: prices fall
/// with the square of the spacing, and there are more of them.
fn spread(few: &[f64], kept: &[usize], m: usize) -> Vec<f64> {
    let share = MORE * few.len() as f64 / m as f64;
    let mut owed = vec![0.0; m];
    let n = kept.len();
    for i in 0..n {
        let until = if i + 1 == n { m } else { kept[i + 1] };
        let around = (0..2 * AROUND).map(|step| few[(i + n + 1 + step - AROUND) % n]);
        owed[kept[i]..until].fill(halves(share * around.fold(0.0, f64::max)));
    }
    owed
}

#[cfg(test)]
pub(super) mod tests;
