//! The table with what is left out against the table without.

use super::*;
use crate::cost::{PriceOptions, Prices, QUANTUM, Strip, TwistForm, quantised};
use crate::rung::Visibility;
use crate::test_boundaries::{plate, random_boundary, waving};
use crate::triangulate::Rule;
use sheetwright_geometry::boundary::{Boundary, samples_from_points};
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::math::{Point3, cos, sin};
use sheetwright_geometry::watch::Unwatched;
use sheetwright_shapes::family::Family;

/// With all bounds, with those of a price alone, and without any: the same triangles and the same
/// bits of the price. Returns whether there is a triangulation.
fn check(terms: &Terms<'_>, what: &str) -> bool {
    let mut plain = Table::new(terms);
    let price = plain.fill(&Unpruned, &mut Unwatched, 0.0..1.0).unwrap();
    let expected = (price < f64::INFINITY).then(|| (price.to_bits(), plain.trace()));
    let key = |solved: Option<Solved>| solved.map(|of| (of.price.to_bits(), of.triangles));
    assert_eq!(key(solve_priced(terms, &mut Unwatched).unwrap()), expected, "{what}");
    let found = expected.is_some();
    for share in [1.0, 1.2] {
        let bound = if found { quantised(share * price).max(price) } else { f64::INFINITY };
        let within = solve_within(terms, bound, &mut Unwatched).unwrap();
        assert_eq!(key(within), expected, "{what}, {share}");
    }
    if found && price > 0.0 && price < HIGHEST_BOUND {
        let below = solve_within(terms, price - QUANTUM, &mut Unwatched).unwrap();
        assert!(below.is_none(), "{what}");
    }
    found
}

#[test]
fn random_boundaries_have_the_answer_of_the_table_without_pruning() {
    let mut found = 0;
    for seed in 1_000..1_320 {
        let Some(boundary) = random_boundary(seed) else { continue };
        let fold = [0.0, 1e-9, 0.1, 1.0, 10.0][(seed / 8 % 5) as usize];
        let form = [TwistForm::Normalised, TwistForm::Printed][usize::from(seed % 31 == 0)];
        let prices = Prices::new(&boundary, None, PriceOptions { fold, form });
        let some = Visibility::of_pairs(boundary.len(), |i, j| (i * 7 + j * 3) % 5 != 0);
        let everything = Visibility::everything();
        for (visibility, forced, rule) in [
            (&everything, false, Rule::Sum),
            (&everything, true, Rule::Sum),
            (&some, true, Rule::Sum),
            (&everything, false, Rule::Worst),
        ] {
            let terms = Terms { rule, ..Terms::new(&prices, visibility, forced) };
            found += usize::from(check(&terms, &format!("seed {seed} {forced}")));
        }
    }
    assert!(found > 700, "{found}");
}

#[test]
fn known_surfaces_have_the_answer_of_the_table_without_pruning() {
    // Below and above where it is looked at what the rest of the loop costs.
    for m in [63, 64, 200, 330, 639, 700] {
        for family in Family::ALL {
            for fold in [0.0, 0.1, 1.0] {
                let options = PriceOptions { fold, ..Default::default() };
                let prices = Prices::new(&family.boundary(m), None, options);
                let everything = Visibility::everything();
                let terms = Terms::new(&prices, &everything, false);
                assert!(check(&terms, &format!("{} {m} {fold}", family.name())));
            }
        }
    }
}

#[test]
fn ties_have_the_answer_of_the_table_without_pruning() {
    // Outlines in one plane, along the axes and not, where all costs nothing, or nearly so.
    let outline = |m: usize, square: bool, tilt: f64| {
        let at = |i: usize| {
            let t = i as f64 / m as f64;
            let (side, s) = ((4.0 * t) as usize, (4.0 * t).fract());
            let [x, y] = if square {
                [[s, 0.0], [1.0, s], [1.0 - s, 1.0], [0.0, 1.0 - s]][side]
            } else {
                let t = std::f64::consts::TAU * t;
                [(3.0 + cos(t)) * cos(t), 2.0 * sin(t)]
            };
            let at = Point3::new(x, y * cos(tilt), y * sin(tilt));
            CurvePoint { corner: square && s == 0.0, ..CurvePoint::smooth(at) }
        };
        let points: Vec<CurvePoint> = (0..m).map(at).collect();
        Boundary::new(vec![samples_from_points(&points)]).unwrap()
    };
    for (m, square) in [(64, true), (260, true), (680, true), (65, false), (339, false)] {
        for (tilt, fold) in [(0.0, 0.0), (0.0, 1.0), (0.7, 0.0), (0.7, 1.0)] {
            let options = PriceOptions { fold, ..Default::default() };
            let prices = Prices::new(&outline(m, square, tilt), None, options);
            let everything = Visibility::everything();
            let terms = Terms::new(&prices, &everything, false);
            assert!(check(&terms, &format!("{m} {square} {tilt} {fold}")));
        }
    }
}

#[test]
fn tiles_that_spans_leave_out_have_no_entries() {
    let mut closed = 0;
    for (boundary, fold) in [plate(320), waving(320, 0.3)].iter().flat_map(|b| [(b, 0.0), (b, 1.0)])
    {
        let prices = Prices::new(boundary, None, PriceOptions { fold, ..Default::default() });
        let everything = Visibility::everything();
        for (forced, rule) in [(false, Rule::Sum), (true, Rule::Sum), (false, Rule::Worst)] {
            let terms = Terms { rule, ..Terms::new(&prices, &everything, forced) };
            let bound = solve_priced(&terms, &mut Unwatched).unwrap().unwrap().price;
            let terms = Terms { bar: if forced { 0.5 * bound } else { f64::INFINITY }, ..terms };
            let (mut table, mut full) = (Table::new(&terms), Table::new(&terms));
            let with = |spans: Spans| Pruned { spans, band: None, completion: None };
            let (few, all) = (Spans::new(&terms, bound), Spans::new(&terms, bound).silent());
            let tiles = (0..20).flat_map(|row| (row..20).map(move |column| (row, column)));
            closed += tiles.filter(|&(row, column)| !few.is_open(row, column)).count();
            let few = table.fill(&with(few), &mut Unwatched, 0.0..1.0).unwrap();
            let all = full.fill(&with(all), &mut Unwatched, 0.0..1.0).unwrap();
            assert_eq!(few, all);
            for (i, j) in (0..table.m).flat_map(|i| (i + 1..320).map(move |j| (i, j))) {
                assert_eq!(table.entry(i, j), full.entry(i, j), "{i} {j}");
            }
            if bound < f64::INFINITY && !forced {
                assert_eq!(table.trace(), full.trace());
            }
        }
    }
    assert!(closed > 100, "{closed}");
}

#[test]
fn rungs_cost_what_their_spans_say_or_more() {
    let m = 1_100;
    let mut told = 0;
    for boundary in [plate(m), waving(m, 0.3)] {
        let prices = Prices::new(&boundary, None, PriceOptions::default());
        let everything = Visibility::everything();
        let terms = Terms::new(&prices, &everything, false);
        let spans = Spans::new(&terms, 1.0);
        let mut strip = Strip::BLANK;
        for column in 0..m.div_ceil(LANES) {
            let to = prices.far_ends(column * LANES);
            for row in 0..column {
                let least = spans.least(row, column);
                told += usize::from(least > QUANTUM);
                for i in row * LANES..(row + 1) * LANES {
                    terms.strip::<false>(i, &to, &mut strip);
                    assert!(strip.prices[..to.count].iter().all(|&price| price >= least), "{i}");
                }
            }
        }
    }
    assert!(told > 1_000, "{told}");
}
