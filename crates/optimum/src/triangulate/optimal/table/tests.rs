use super::*;
use crate::cost::{PriceOptions, Prices, Strip, quantised};
use crate::rung::Visibility;
use crate::test_boundaries::{plate, waving};
use crate::triangulate::optimal::pruning::fill_up_to;
use crate::triangulate::{Rule, Side};
use sheetwright_geometry::boundary::{Boundary, samples_from_points};
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::math::{Point3, cos, sin};
use sheetwright_geometry::watch::Unwatched;

/// Leaves out what costs more, and nothing else.
struct UpTo(f64);

impl Pruning for UpTo {
    fn bound(&self) -> f64 {
        self.0
    }

    fn least(&self, _row: usize, _column: usize) -> f64 {
        0.0
    }

    fn rests(&self, _i: usize, _to: &FarEnds) -> Lanes {
        [0.0; LANES]
    }

    fn bytes(&self) -> u64 {
        0
    }
}

#[test]
fn strips_are_what_single_sides_are() {
    let m = 320;
    let (mut admitted, mut barred) = (0, 0);
    for boundary in [plate(m), waving(m, 0.3)] {
        let prices = Prices::new(&boundary, None, PriceOptions::default());
        let some = Visibility::of_pairs(m, |i, j| (i * 7 + j * 3) % 5 != 0);
        for visibility in [Visibility::everything(), some] {
            for (forced, bar) in [(false, f64::INFINITY), (true, f64::INFINITY), (false, 0.1)] {
                let terms = Terms { bar, ..Terms::new(&prices, &visibility, forced) };
                let mut strip = Strip::BLANK;
                for (i, first) in (0..m).flat_map(|i| [(i, i / 16 * 16), (i, 256), (i, 304)]) {
                    terms.strip::<true>(i, &prices.far_ends(first), &mut strip);
                    for (n, j) in (first..first + LANES).enumerate().filter(|(_, j)| *j > i) {
                        let side = terms.side(i, j);
                        assert_eq!(strip.prices[n], side.price, "{i} {j}");
                        if side.price < f64::INFINITY {
                            let mean = Vec3::from_array(strip.means.map(|mean| mean[n]));
                            assert_eq!(mean, side.mean, "{i} {j}");
                            admitted += 1;
                        } else {
                            barred += 1;
                        }
                    }
                }
            }
        }
    }
    assert!(admitted > 10_000 && barred > 10_000, "{admitted} {barred}");
}

#[test]
fn entries_are_all_those_of_equation_5_up_to_the_bound() {
    // The last tiles are not full.
    let m = 315;
    for (boundary, fold) in [plate(m), waving(m, 0.3)].iter().flat_map(|b| [(b, 0.0), (b, 1.0)]) {
        let prices = Prices::new(boundary, None, PriceOptions { fold, ..Default::default() });
        let everything = Visibility::everything();
        let terms = Terms::new(&prices, &everything, false);
        let sides: Vec<Vec<Side>> =
            (0..m).map(|j| (0..j).map(|i| terms.side(i, j)).collect()).collect();
        let mut plain = vec![vec![0.0; m]; m];
        for (length, i) in (2..m).flat_map(|length| (0..m - length).map(move |i| (length, i))) {
            let j = i + length;
            let price = |k: usize| {
                let means = [sides[k][i].mean, sides[j][k].mean, sides[j][i].mean];
                plain[i][k] + plain[k][j] + prices.triangle([i, k, j], means)
            };
            plain[i][j] = sides[j][i].price + (i + 1..j).map(price).fold(f64::INFINITY, f64::min);
        }
        let answer = plain[0][m - 1];
        for bound in [answer, quantised(1.5 * answer)] {
            let mut table = Table::new(&terms);
            assert_eq!(table.fill(&UpTo(bound), &mut Unwatched, 0.0..1.0), Ok(answer));
            for (i, j) in (0..m).flat_map(|i| (i + 1..m).map(move |j| (i, j))) {
                let expected = if plain[i][j] <= bound { plain[i][j] } else { f64::INFINITY };
                assert_eq!(table.entry(i, j), expected, "{i} {j}");
            }
        }
    }
}

#[test]
fn tiles_that_stand_in_many_places_have_the_n_of_all() {
    // A patch of a cylinder, whose arcs lie in planes.
    let m = 640;
    let patch = |i: usize| {
        let (side, t) = (4 * i / m, (4 * i % m) as f64 / m as f64);
        let [s, z] = [[t, -0.8], [1.0, 1.6 * t - 0.8], [1.0 - t, 0.8], [0.0, 0.8 - 1.6 * t]][side];
        let at = Point3::new(cos(2.0 * s - 1.0), sin(2.0 * s - 1.0), z);
        CurvePoint { corner: (4 * i).is_multiple_of(m), ..CurvePoint::smooth(at) }
    };
    let samples = samples_from_points(&(0..m).map(patch).collect::<Vec<_>>());
    let boundary = Boundary::new(vec![samples]).unwrap();
    let prices = Prices::new(&boundary, None, PriceOptions::default());
    let everything = Visibility::everything();
    let terms = Terms::new(&prices, &everything, false);
    let mut table = Table::new(&terms);
    table.fill(&UpTo(0.5), &mut Unwatched, 0.0..1.0).unwrap();
    let mut places = std::collections::BTreeMap::new();
    for (row, column) in (0..m / LANES).flat_map(|row| (row..m / LANES).map(move |c| (row, c))) {
        let Some(tile) = table.store.tile(row, column) else { continue };
        *places.entry(std::ptr::from_ref(tile)).or_insert(0) += 1;
        let ends =
            (0..LANES * LANES).map(|at| (row * LANES + at / LANES, column * LANES + at % LANES));
        for (i, j) in ends.filter(|&(i, j)| i < j && table.entry(i, j) < f64::INFINITY) {
            assert_eq!(table.mean(i, j), terms.side(i, j).mean.to_array(), "{i} {j}");
        }
    }
    // One for each arc.
    let shared: Vec<i32> = places.into_values().filter(|&count| count > 1).collect();
    assert!(shared.len() == 2 && shared.iter().all(|&count| count > 20), "{shared:?}");
}

#[test]
fn registers_change_no_bit() {
    #[cfg(target_arch = "x86_64")]
    let narrow = [Some(pulp::Arch::Scalar), pulp::x86::V3::try_new().map(pulp::Arch::V3)];
    #[cfg(not(target_arch = "x86_64"))]
    let narrow = [Some(pulp::Arch::Scalar)];
    for (boundary, fold) in [plate(320), waving(320, 0.3)].iter().flat_map(|b| [(b, 0.0), (b, 1.0)])
    {
        let prices = Prices::new(boundary, None, PriceOptions { fold, ..Default::default() });
        let everything = Visibility::everything();
        for rule in [Rule::Sum, Rule::Worst] {
            let terms = Terms { rule, ..Terms::new(&prices, &everything, false) };
            let mut widest = Table::new(&terms);
            let price = fill_up_to(&mut widest, 1.0, &mut Unwatched).unwrap();
            assert!(price < 1.0, "{price}");
            for registers in narrow.into_iter().flatten() {
                let mut table = Table { registers, ..Table::new(&terms) };
                assert_eq!(fill_up_to(&mut table, 1.0, &mut Unwatched).unwrap(), price);
                for (i, j) in (0..table.m).flat_map(|i| (i + 1..320).map(move |j| (i, j))) {
                    assert_eq!(table.entry(i, j), widest.entry(i, j), "{registers:?} {i} {j}");
                    if table.entry(i, j) < f64::INFINITY {
                        assert_eq!(table.mean(i, j), widest.mean(i, j), "{registers:?} {i} {j}");
                    }
                }
            }
        }
    }
}

#[cfg(feature = "rayon")]
mod threads {
    use super::*;
    use std::cell::Cell;
    use std::panic::{AssertUnwindSafe, catch_unwind};

    fn pool(threads: usize) -> rayon::ThreadPool {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap()
    }

    /// Stops, or panics, once it was told of so much progress.
    struct Ending {
        told: Cell<f64>,
        at: f64,
        panics: bool,
    }

    impl Watch for Ending {
        fn progress(&mut self, done: f64) {
            assert!(done >= self.told.get() && done <= 1.0, "{done} after {}", self.told.get());
            self.told.set(done);
        }

        fn stop(&self) -> bool {
            let ends = self.told.get() >= self.at;
            assert!(!(ends && self.panics), "as wanted");
            ends
        }
    }

    #[test]
    fn any_number_of_threads_fills_the_same_table() {
        // More columns of tiles than are filled together, and fewer.
        for m in [315, 640] {
            for (boundary, fold) in
                [plate(m), waving(m, 0.3)].iter().flat_map(|b| [(b, 0.0), (b, 1.0)])
            {
                let prices =
                    Prices::new(boundary, None, PriceOptions { fold, ..Default::default() });
                let everything = Visibility::everything();
                for (rule, bound) in
                    [(Rule::Sum, 1.0), (Rule::Sum, f64::INFINITY), (Rule::Worst, f64::INFINITY)]
                {
                    let terms = Terms { rule, ..Terms::new(&prices, &everything, false) };
                    let filled = |threads: usize| {
                        let mut table = Table::new(&terms);
                        assert_eq!(
                            pool(threads)
                                .install(|| Helpers::call(table.m.div_ceil(LANES)))
                                .is_some(),
                            threads > 1
                        );
                        let fill = || fill_up_to(&mut table, bound, &mut Unwatched);
                        pool(threads).install(fill).unwrap();
                        table
                    };
                    let alone = filled(1);
                    assert!(alone.entry(0, m - 1) < f64::INFINITY);
                    for threads in [2, 3, 8] {
                        let table = filled(threads);
                        for (i, j) in (0..m).flat_map(|i| (i + 1..m).map(move |j| (i, j))) {
                            let what = format!("{threads} threads, {i} {j}");
                            let entries = [&table, &alone].map(|table| table.entry(i, j).to_bits());
                            assert_eq!(entries[0], entries[1], "{what}");
                            // N means nothing elsewhere.
                            if alone.entry(i, j) < f64::INFINITY {
                                assert_eq!(table.mean(i, j), alone.mean(i, j), "{what}");
                            }
                        }
                        assert_eq!(table.trace(), alone.trace(), "{threads} threads");
                        assert_eq!(table.bytes(), alone.bytes(), "{threads} threads");
                    }
                }
            }
        }
    }

    #[test]
    fn threads_stop_when_asked_and_when_one_panics() {
        let wavy = waving(640, 0.3);
        let prices = Prices::new(&wavy, None, PriceOptions::default());
        let everything = Visibility::everything();
        let terms = Terms::new(&prices, &everything, false);
        let mut table = Table::new(&terms);
        let pool = pool(4);
        let mut fill = |at: f64, panics: bool| {
            let filled = pool.install(|| {
                let mut watch = Ending { told: Cell::new(0.0), at, panics };
                let filled = fill_up_to(&mut table, 1.0, &mut watch);
                (filled, watch.told.get())
            });
            (filled, table.entry(0, 639))
        };
        // The first two while it is priced what the rest of the loop costs.
        for at in [0.0, 0.1, 0.3, 0.9] {
            let ((stopped, told), entry) = fill(at, false);
            assert!(matches!(stopped, Err(TriangulateError::Stopped)), "{at}: {stopped:?}");
            assert!(told >= at && entry == f64::INFINITY, "{at}: {told} {entry}");
            let panicked = catch_unwind(AssertUnwindSafe(|| fill(at, true))).unwrap_err();
            assert_eq!(panicked.downcast_ref(), Some(&"as wanted"), "{at}");
        }
        let ((filled, told), entry) = fill(2.0, false);
        assert!(filled.unwrap() == entry && entry < 1.0 && told > 0.9, "{entry} {told}");
    }

    #[test]
    fn threads_end_where_the_memory_does() {
        let plate = plate(640);
        let prices = Prices::new(&plate, None, PriceOptions::default());
        let everything = Visibility::everything();
        let terms = Terms::new(&prices, &everything, false);
        let mut table = Table::new(&terms);
        pool(4).install(|| fill_up_to(&mut table, f64::INFINITY, &mut Unwatched)).unwrap();
        let memory = table.bytes() / 2;
        let terms = Terms { memory, ..Terms::new(&prices, &everything, false) };
        let mut table = Table::new(&terms);
        let refused = pool(4).install(|| fill_up_to(&mut table, f64::INFINITY, &mut Unwatched));
        let limit = memory;
        assert!(
            matches!(refused, Err(TriangulateError::TooLarge { limit: at, .. }) if at == limit)
        );
    }
}
