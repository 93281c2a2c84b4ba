//! Domains with holes against all of their triangulations, enumerated one by one.
//!
//! Nothing here knows of cuts or of paths round a hole: [`growth`] goes by the definition.
// Tests panic and print what they measured.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout)]

mod growth;

use growth::{Costs, Growth, Triangle, all_triangulations};
use sheetwright::surface::Connectivity;
use sheetwright_geometry::boundary::{Boundary, PlaneChoice, SupportingPlane, supporting_plane};
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::Vec3;
use sheetwright_geometry::predicate::orientation;
use sheetwright_geometry::watch::Unwatched;
use sheetwright_optimum::cost::{DEFAULT_FOLD, PriceOptions, Prices, TwistForm};
use sheetwright_optimum::rung::{Rung, Visibility};
use sheetwright_optimum::triangulate::{TriangulateOptions, Triangulation, triangulate};
use sheetwright_shapes::domain::fault;
use sheetwright_shapes::pierced::{
    FROM_ABOVE, grid_plate, plate, roof, tangled_loops, tube, upright_tube,
};
use sheetwright_shapes::random::Random;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::OnceLock;

/// Those of all rings with 3 to 5 samples a loop, by the sizes of the loops.
fn all_of_rings() -> &'static BTreeMap<Vec<usize>, Vec<Vec<Triangle>>> {
    static ALL: OnceLock<BTreeMap<Vec<usize>, Vec<Vec<Triangle>>>> = OnceLock::new();
    ALL.get_or_init(|| {
        let sizes = (3..=5).flat_map(|outer| (3..=5).map(move |hole| vec![outer, hole]));
        sizes.map(|sizes| (sizes.clone(), all_triangulations(&sizes))).collect()
    })
}

/// A boundary whose triangulations are priced.
struct Domain<'a> {
    boundary: &'a Boundary,
    plane: Option<SupportingPlane>,
    prices: Prices,
    sizes: Vec<usize>,
}

impl<'a> Domain<'a> {
    fn new(boundary: &'a Boundary, choice: PlaneChoice, options: PriceOptions) -> Self {
        let plane = supporting_plane(boundary, choice).unwrap();
        let prices = Prices::new(boundary, plane.as_ref(), options);
        let sizes = boundary.loops().iter().map(ExactSizeIterator::len).collect();
        Self { boundary, plane, prices, sizes }
    }

    fn is_edge(&self, i: usize, j: usize) -> bool {
        self.boundary.next(i) == j || self.boundary.next(j) == i
    }

    /// Whether the triangle may be part of a triangulation: over a plane, if it faces up there.
    /// Triangles that all face up and have the loops for their border lie beside one another and
    /// fill the projection, for every point of it is covered as often as the border winds round it.
    fn admits(&self, triangle: Triangle) -> bool {
        self.plane.as_ref().is_none_or(|plane| {
            let [a, b, c] = triangle.map(|i| plane.projected[i]);
            orientation(a, b, c).is_gt()
        })
    }

    /// The price of a side and its N; `None` without tangent planes.
    fn side(&self, i: usize, j: usize) -> Option<(f64, Vec3)> {
        let (i, j) = (i.min(j), i.max(j));
        if self.is_edge(i, j) {
            return Some((0.0, Vec3::ZERO));
        }
        let planes = self.prices.planes(i, j)?;
        Some((self.prices.rung(i, j, &planes), planes.mean))
    }

    /// The fold price of a triangle, its smallest sample first.
    fn fold(&self, triangle: Triangle) -> f64 {
        let mut corners = triangle;
        let lowest = (0..3).min_by_key(|&n| corners[n]).unwrap();
        corners.rotate_left(lowest);
        let [a, b, c] = corners;
        let mean = |(i, j)| self.side(i, j).map_or(Vec3::ZERO, |(_, mean)| mean);
        self.prices.triangle(corners, [(a, b), (b, c), (a, c)].map(mean))
    }

    /// The prices of triangles; those with a rung without tangent planes only if they are admitted,
    /// at a twist of 2.
    fn costs(&self, forced: bool) -> Costs {
        Costs::new(self.boundary.len(), |triangle| {
            let [a, b, c] = triangle;
            let half = |(i, j)| match self.side(i, j) {
                Some((price, _)) => 0.5 * price,
                None if forced => 1.0,
                None => f64::INFINITY,
            };
            let rungs: f64 = [(a, b), (b, c), (c, a)].map(half).iter().sum();
            if self.admits(triangle) { self.fold(triangle) + rungs } else { f64::INFINITY }
        })
    }

    /// Checks that a result is a triangulation of the domain, and that its claims are true.
    fn check(&self, found: &Triangulation, case: &str) {
        let triangles: Vec<Triangle> =
            found.triangles.iter().map(|t| t.map(SampleIndex::get)).collect();
        assert_eq!(fault(self.boundary.loops(), &triangles), None, "{case}");
        Connectivity::new(self.boundary.loops(), found.triangles.clone()).unwrap();
        assert!(triangles.iter().all(|&t| self.admits(t)), "{case}: outside the plan");
        let first = |t: &Triangle| t[0] < t[1] && t[0] < t[2];
        assert!(triangles.iter().all(first) && triangles.is_sorted(), "{case}: {triangles:?}");
        let sides = triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        let rungs: BTreeSet<Rung> =
            sides.filter(|&(i, j)| !self.is_edge(i, j)).map(|(i, j)| Rung::new(i, j)).collect();
        assert_eq!(found.rungs, rungs.into_iter().collect::<Vec<_>>(), "{case}");
        let twists = found.rungs.iter().map(|rung| {
            let [i, j] = rung.ends().map(SampleIndex::get);
            self.side(i, j).map(|(price, _)| price)
        });
        let forced = twists.clone().filter(Option::is_none).count();
        assert_eq!(found.forced_rungs, forced, "{case}");
        let price = twists.map(|twist| twist.unwrap_or(2.0)).sum::<f64>()
            + triangles.iter().map(|&t| self.fold(t)).sum::<f64>();
        assert_eq!(found.price, price, "{case}: the price that it says");
        assert!(found.lower_bound <= price, "{case}: {found:?}");
        if found.proven_optimal {
            assert_eq!(found.lower_bound, price, "{case}");
        }
    }

    fn solved(&self, case: &str) -> Triangulation {
        let options = TriangulateOptions { price: self.prices.options(), ..Default::default() };
        let found = triangulate(self.boundary, self.plane.as_ref(), &options, &mut Unwatched);
        let found = found.unwrap_or_else(|error| panic!("{case}: {error}"));
        self.check(&found, case);
        found
    }

    /// The least price of all triangulations, and whether rungs without tangent planes have to be
    /// admitted because there are no others.
    fn least_of(&self, all: &[Vec<Triangle>]) -> (f64, bool) {
        match cheapest(all, &self.costs(false)) {
            Some(price) => (price, false),
            None => (cheapest(all, &self.costs(true)).unwrap(), true),
        }
    }

    /// The least price of all triangulations not dearer than `bound`, and whether rungs without
    /// tangent planes have to be admitted, by searching: for domains with too many to list.
    fn least_by_search(&self, bound: f64) -> Option<(f64, bool)> {
        [false, true].into_iter().find_map(|forced| {
            let costs = self.costs(forced);
            let (mut least, mut bound) = (None, bound.next_up());
            Growth::new(&self.sizes, &costs).grow(&mut bound, &mut |_, price, bound| {
                (least, *bound) = (Some((price, forced)), price);
            });
            least
        })
    }

    /// How to reproduce the case.
    fn told(&self, seed: u64) -> String {
        let plane = if self.plane.is_some() { "plane" } else { "no plane" };
        let mut rows = String::new();
        for (n, of_loop) in self.boundary.loops().iter().enumerate() {
            for sample in &self.boundary.samples()[of_loop.clone()] {
                let (p, corner) = (sample.position, u8::from(sample.is_corner()));
                rows += &format!("\nloop{n},{:?},{:?},{:?},{corner}", p.x, p.y, p.z);
            }
        }
        format!("seed {seed}, {plane}, {:?}\ncurve,x,y,z,corner{rows}\n", self.prices.options())
    }
}

fn loops_of(sizes: &[usize]) -> Vec<Range<usize>> {
    let mut end = 0;
    sizes
        .iter()
        .map(|size| {
            end += size;
            end - size..end
        })
        .collect()
}

/// Triangles in order, the smallest sample of each first.
fn in_order(mut triangles: Vec<Triangle>) -> Vec<Triangle> {
    for triangle in &mut triangles {
        let lowest = (0..3).min_by_key(|&n| triangle[n]).unwrap();
        triangle.rotate_left(lowest);
    }
    triangles.sort_unstable();
    triangles
}

/// The triangulations that turning one rung makes of a triangulation.
fn turns(triangles: &[Triangle], sizes: &[usize]) -> Vec<Vec<Triangle>> {
    let sides = |&[a, b, c]: &Triangle| [[a, b, c], [b, c, a], [c, a, b]];
    let mut turned = Vec::new();
    for (n, first) in triangles.iter().enumerate() {
        for (k, second) in triangles[..n].iter().enumerate() {
            for [a, b, c] in sides(first) {
                for [other_b, other_a, d] in sides(second) {
                    if [a, b] == [other_a, other_b] && c != d {
                        let mut list = triangles.to_vec();
                        (list[n], list[k]) = ([a, d, c], [d, b, c]);
                        if fault(&loops_of(sizes), &list).is_none() {
                            turned.push(in_order(list));
                        }
                    }
                }
            }
        }
    }
    turned
}

/// The least price of a list of triangulations.
fn cheapest(all: &[Vec<Triangle>], costs: &Costs) -> Option<f64> {
    let price = |triangles: &Vec<Triangle>| triangles.iter().map(|&t| costs.of(t)).sum::<f64>();
    all.iter().map(price).filter(|price| price.is_finite()).reduce(f64::min)
}

const FOLDS: [f64; 3] = [0.0, 0.05, DEFAULT_FOLD];

/// Random boundaries with loops of these sizes: one of every kind that there is for so many loops,
/// and whether it has a plane seen from above.
fn boundary_of(seed: u64, sizes: &[usize]) -> Option<(Boundary, bool)> {
    let random = &mut Random::new(seed);
    let ring = sizes.len() == 2;
    match seed % 8 {
        0 => plate(random, sizes, 0.0).map(|b| (b, true)),
        1 | 2 => plate(random, sizes, 0.4).map(|b| (b, true)),
        3 => roof(random, sizes).map(|b| (b, true)),
        4 | 5 if ring && !seed.is_multiple_of(5) => {
            tube(random, [sizes[0], sizes[1]], 0.3).map(|b| (b, false))
        }
        4 | 5 if ring && sizes[0] == sizes[1] => {
            upright_tube(random, sizes[0], 0.3).map(|b| (b, false))
        }
        6 => tangled_loops(random, sizes, 0.3).map(|b| (b, false)),
        _ => grid_plate(random, sizes).map(|b| (b, true)),
    }
}

/// Random boundaries of this many, with the seeds that they come from.
fn boundaries(
    count: usize,
    sizes: impl Fn(u64) -> Vec<usize>,
) -> impl Iterator<Item = (u64, Boundary, bool)> {
    (0..)
        .filter_map(move |seed| boundary_of(seed, &sizes(seed)).map(|(b, plane)| (seed, b, plane)))
        .take(count)
}

/// The planes that a boundary is looked at over.
fn choices(has_plane: bool) -> &'static [PlaneChoice] {
    if has_plane { &[FROM_ABOVE, PlaneChoice::None] } else { &[PlaneChoice::None] }
}

/// The enumeration itself, checked by other reasoning.
#[test]
fn every_triangulation_is_enumerated_once() {
    // A disc of m samples has as many as Catalan's numbers say.
    for (m, wanted) in [(3, 1), (4, 2), (5, 5), (6, 14), (7, 42), (8, 132)] {
        assert_eq!(all_triangulations(&[m]).len(), wanted);
    }
    // Between two loops of three, six triangles follow one another round the ring, three with an
    // edge of each loop: 30 ways [C(6,3) · 9 / 6]. In 9 of them all three of a loop share their
    // third corner, which joins it twice to one sample.
    assert_eq!(all_of_rings()[&vec![3, 3]].len(), 21);
    for sizes in [vec![4, 4], vec![5, 3], vec![3, 3, 3]] {
        let all: BTreeSet<Vec<Triangle>> =
            all_triangulations(&sizes).into_iter().map(in_order).collect();
        let m: usize = sizes.iter().sum();
        assert_eq!(all.len(), all_triangulations(&sizes).len(), "{sizes:?}: none comes up twice");
        // Turning one rung within the two triangles beside it, again and again, leads to the same.
        let mut reached = BTreeSet::from([all.first().unwrap().clone()]);
        let mut fresh: Vec<Vec<Triangle>> = reached.iter().cloned().collect();
        while let Some(triangles) = fresh.pop() {
            for turned in turns(&triangles, &sizes) {
                if reached.insert(turned.clone()) {
                    fresh.push(turned);
                }
            }
        }
        println!("{sizes:?}, {m} samples: {} triangulations", all.len());
        assert!(reached == all, "{sizes:?}: {} by turning, {} grown", reached.len(), all.len());
    }
}

fn price_options(fold: f64) -> PriceOptions {
    PriceOptions { fold, form: TwistForm::Normalised }
}

#[test]
fn rings_are_the_least_of_all() {
    let sizes = |seed: u64| vec![3 + (seed / 8 % 3) as usize, 3 + (seed / 24 % 3) as usize];
    let (mut with_plane, mut with_forced) = (0, 0);
    for (seed, boundary, has_plane) in boundaries(200, sizes) {
        with_plane += usize::from(has_plane);
        for choice in choices(has_plane) {
            for fold in FOLDS {
                let domain = Domain::new(&boundary, *choice, price_options(fold));
                let case = domain.told(seed);
                let all = &all_of_rings()[&domain.sizes];
                let (least, forced) = domain.least_of(all);
                let found = domain.solved(&case);
                assert_eq!(found.price, least, "{case}");
                assert_eq!(found.forced_rungs > 0, forced, "{case}");
                assert!(found.proven_optimal, "{case}");
                with_forced += usize::from(forced);
            }
        }
    }
    println!("{with_plane} of 200 with a plane; {with_forced} times rungs were forced");
    assert!(with_plane > 80 && with_forced > 0);
}

/// How results compare with the least prices.
#[derive(Default)]
struct Tally {
    looked_at: usize,
    proven: usize,
    /// Results above the least price, each with its excess as a share.
    dearer: Vec<(f64, String)>,
}

impl Tally {
    /// Compares the results for random boundaries with the least prices, found by searching. The
    /// search begins with the price of the result as its bound, so it finds that again unless a
    /// triangulation is cheaper. The claims of a result must be true, whether it is the best or
    /// not.
    fn of(
        count: usize,
        sizes: impl Fn(u64) -> Vec<usize>,
        choices: impl Fn(bool) -> &'static [PlaneChoice],
    ) -> Self {
        let mut tally = Self::default();
        for (seed, boundary, has_plane) in boundaries(count, sizes) {
            for choice in choices(has_plane) {
                for fold in FOLDS {
                    let domain = Domain::new(&boundary, *choice, price_options(fold));
                    tally.look_at(&domain, &domain.told(seed));
                }
            }
        }
        println!(
            "{} looked at, {} proven, {} dearer than need be",
            tally.looked_at,
            tally.proven,
            tally.dearer.len()
        );
        tally
    }

    fn look_at(&mut self, domain: &Domain<'_>, case: &str) {
        let found = domain.solved(case);
        let (least, forced) = domain.least_by_search(found.price).expect(case);
        assert!(found.lower_bound <= least, "{case}: {} > {least}", found.lower_bound);
        assert!(!found.proven_optimal || found.price == least, "{case}: {} {least}", found.price);
        assert_eq!(found.forced_rungs > 0, forced, "{case}");
        self.looked_at += 1;
        self.proven += usize::from(found.proven_optimal);
        if found.price > least {
            self.dearer.push(((found.price - least) / least, case.to_owned()));
        }
    }

    fn assert_all_least(&self) {
        if let Some((share, case)) = self.dearer.iter().max_by(|a, b| a.0.total_cmp(&b.0)) {
            let count = self.dearer.len();
            panic!("{count} of {} are dearer, one by {share}: {case}", self.looked_at);
        }
        assert_eq!(self.proven, self.looked_at);
    }
}

fn over_the_plane(has_plane: bool) -> &'static [PlaneChoice] {
    if has_plane { &[FROM_ABOVE] } else { &[] }
}

/// A rung lies inside the projection if, and only if, some triangulation uses it.
#[test]
fn what_is_seen_is_what_triangulations_use() {
    let sizes = |seed: u64| match seed / 8 % 3 {
        0 => vec![4, 3],
        1 => vec![5, 4],
        _ => vec![4, 3, 3],
    };
    let mut hidden = 0;
    for (seed, boundary, has_plane) in boundaries(120, sizes) {
        if !has_plane {
            continue;
        }
        let domain = Domain::new(&boundary, FROM_ABOVE, price_options(0.0));
        let m = boundary.len();
        let up = |t| if domain.admits(t) { 0.0 } else { f64::INFINITY };
        let mut used = vec![false; m * m];
        let costs = Costs::new(m, up);
        let mut all = f64::INFINITY;
        Growth::new(&domain.sizes, &costs).grow(&mut all, &mut |triangles, _, _| {
            for &[a, b, c] in triangles {
                for (i, j) in [(a, b), (b, c), (c, a)] {
                    used[i * m + j] = true;
                }
            }
        });
        let visibility = Visibility::new(&boundary, domain.plane.as_ref());
        for i in 0..m {
            for j in 0..m {
                if i != j && !domain.is_edge(i, j) {
                    let case = format!("{i} {j} {}", domain.told(seed));
                    assert_eq!(visibility.allows(i, j), used[i * m + j], "{case}");
                    hidden += usize::from(!used[i * m + j]);
                }
            }
        }
    }
    assert!(hidden > 1000, "{hidden}");
}

#[test]
fn rings_in_the_printed_form_are_the_least_of_all() {
    let options = PriceOptions { fold: 0.0, form: TwistForm::Printed };
    for (seed, boundary, has_plane) in boundaries(40, |seed| vec![4, 3 + (seed / 8 % 3) as usize]) {
        for choice in choices(has_plane) {
            let domain = Domain::new(&boundary, *choice, options);
            let case = domain.told(seed);
            let found = domain.solved(&case);
            assert_eq!(found.price, domain.least_of(&all_of_rings()[&domain.sizes]).0, "{case}");
        }
    }
}

#[test]
fn larger_rings_are_the_least_of_all() {
    let sizes = |seed: u64| vec![5 + (seed / 8 % 3) as usize, 4 + (seed / 24 % 4) as usize];
    Tally::of(60, sizes, over_the_plane).assert_all_least();
}

#[test]
fn two_holes_are_the_least_of_all() {
    let sizes = |seed: u64| vec![3 + (seed / 8 % 3) as usize, 3, 3];
    Tally::of(60, sizes, choices).assert_all_least();
}

#[test]
fn three_holes_are_the_least_of_all() {
    let sizes = |seed: u64| vec![3 + (seed / 8 % 3) as usize, 3, 3, 3];
    Tally::of(60, sizes, over_the_plane).assert_all_least();
}

/// Without a plane there are millions, so these are few.
#[test]
fn three_holes_without_a_plane() {
    Tally::of(3, |_| vec![3; 4], |_| &[PlaneChoice::None]).assert_all_least();
}
