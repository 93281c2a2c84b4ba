//! Triangulations of a boundary without interior vertices: rungs that leave only triangles.
//!
//! One file a method; each fills the same outcome. The price that is minimised is Π of
//! [`crate::cost`], over the triangulations that the method admits.
//!
//! **The least worst warp** ([`Goal::WorstWarp`]) takes two passes of the same method. The first
//! combines parts by the larger of their prices instead of the sum, (max, min) for (+, min), and
//! counts no folds: that gives the least possible largest twist. The second minimises Π with all
//! dearer rungs barred. Bisection over the sorted twists would give the same, but needs separate
//! code for each method; this takes two lines in each, is exact because a maximum does not round,
//! and has the same order of time. A rung without a tangent plane counts 2, the largest twist there
//! is, in both passes: where one is needed, no rung is barred, and the least Π decides.

mod bridge;
mod hole_orientation;
mod holes;
mod memory;
mod optimal;
mod other;
mod part;
mod plane_check;
mod rails;
mod thinned;

pub use hole_orientation::with_holes_facing;
pub use optimal::{is_on_one_thread, memory_needed, on_one_thread};
pub use other::{OtherSurface, WhichSurface, other_surface};
pub use plane_check::Cheapest;
pub use plane_check::cheaper_than;

use crate::cost::{
    EXACT_BELOW, FarEnds, Hint, LANES, MAX_FOLD, PriceOptions, Prices, Strip, TwistForm,
};
use crate::rung::{Rung, Visibility};
use optimal::warm_start;
use part::Part;
use plane_check::{may_ask_less, solve_then_check};
use sheetwright_geometry::boundary::{Boundary, SupportingPlane};
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::Vec3;
use sheetwright_geometry::watch::Watch;
use std::fmt;

/// Which triangulations are looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// All of them: equation (5), see [`crate::specification`]. O(m³) time and O(m²) memory at the
    /// most; next to a developable surface far less. With holes, see `docs/method.md`.
    #[default]
    Optimal,
    /// Those whose every triangle has an edge of the boundary: equations (3) and (4). O(m²) both.
    Bridge,
    /// Those whose every rung joins two rails, \[WT05\]: a path through the lattice of their pairs.
    /// O(m²) both.
    Rails {
        /// How many of the samples, from the first, lie on the first rail; the rest lie on the
        /// second, which runs back.
        first: usize,
    },
}

/// The quantity that is minimised.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Goal {
    /// The price Π: the sum of twist and folds.
    #[default]
    Price,
    /// The largest twist of a rung first, and among triangulations with the least such twist the
    /// price Π. For one loop only.
    WorstWarp,
}

impl Goal {
    /// How designs and reports name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Price => "price",
            Self::WorstWarp => "worst-warp",
        }
    }
}

/// How a boundary is triangulated.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangulateOptions {
    /// Which triangulations are looked at.
    pub method: Method,
    /// The quantity that is minimised.
    pub goal: Goal,
    /// How they are priced.
    pub price: PriceOptions,
    /// Which places the surface should pass near, or keep away from. Default: none.
    pub hints: Vec<Hint>,
    /// Which of two surfaces is meant, where two cost about as much. Default: the cheaper.
    pub which: WhichSurface,
    /// Limit of the memory of tables, bytes. Default 4 GiB: `Optimal` up to 15,000 samples without
    /// holes, and many more where the boundary is near to a developable surface. Lowered where the
    /// system has less.
    pub memory_limit: u64,
    /// Limit of the work of the search with holes, in steps of about a nanosecond (the comparison
    /// of two sums of prices). Work is counted, not timed, so that the answer is the same
    /// everywhere. A search that reaches the limit returns the best triangulation found and its
    /// lower bound; it exceeds the limit only to find a first triangulation. Default
    /// [`DEFAULT_WORK`].
    pub work_limit: u64,
}

/// The default of [`TriangulateOptions::work_limit`], steps: a few seconds.
pub const DEFAULT_WORK: u64 = 3_000_000_000;

impl Default for TriangulateOptions {
    fn default() -> Self {
        Self {
            method: Method::Optimal,
            goal: Goal::Price,
            price: PriceOptions::default(),
            hints: Vec::new(),
            which: WhichSurface::Cheapest,
            memory_limit: 4 << 30,
            work_limit: DEFAULT_WORK,
        }
    }
}

/// A triangulation and how good it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangulation {
    /// Its rungs, in increasing order; m + 3 h − 3 for m samples and h holes.
    pub rungs: Vec<Rung>,
    /// Its triangles, corners counter-clockwise as seen from the side that the surface faces, the
    /// lowest first (on one loop: in its order); m + 2 h − 2 of them, in increasing order.
    pub triangles: Vec<[SampleIndex; 3]>,
    /// Π and the price of hints, without unit; below [`EXACT_BELOW`] an exact multiple of
    /// [`crate::cost::QUANTUM`].
    pub price: f64,
    /// What hints alone cost, a part of the price.
    pub hints: f64,
    /// Whether it is the other of two surfaces that cost about as much, see [`other_surface`].
    pub is_other: bool,
    /// The price of its dearest rung alone: its largest twist, without unit, a multiple of
    /// [`crate::cost::QUANTUM`]; 0 for a triangle. Hints count.
    pub largest_twist: f64,
    /// Whether this is proven optimal among all triangulations that the supporting plane admits:
    /// none is cheaper or, if the goal is the worst warp, has a smaller largest twist, or an equal
    /// one and a lower price. False for prices of [`EXACT_BELOW`] and more, whose sums are rounded:
    /// hopeless boundaries.
    pub proven_optimal: bool,
    /// Lower bound on the price of all triangulations that the supporting plane admits; if the goal
    /// is the worst warp, of those whose largest twist is no larger. Equal to the price where it is
    /// proven optimal, 0 where no bound is known.
    pub lower_bound: f64,
    /// How many rungs have no tangent plane, where no triangulation exists without such rungs; each
    /// counts as a twist of 2.
    pub forced_rungs: usize,
    /// The work of the search with holes, steps; 0 without holes, where work is not counted.
    pub work: u64,
    /// Whether that search ended at [`TriangulateOptions::work_limit`]: with more work, it may find
    /// a better triangulation, or prove this one.
    pub cut_short: bool,
}

impl Triangulation {
    /// Π, without unit: the price without that of hints.
    pub fn price_without_hints(&self) -> f64 {
        self.price - self.hints
    }

    /// The relative optimality gap, (price − lower bound) / price, 0 ..= 1: 0 where the
    /// triangulation is proven optimal; `None` where no bound is known.
    pub fn gap(&self) -> Option<f64> {
        if self.proven_optimal {
            Some(0.0)
        } else {
            (self.lower_bound > 0.0).then(|| (self.price - self.lower_bound) / self.price)
        }
    }
}

/// Why there is no triangulation.
#[derive(Clone, Debug, PartialEq)]
pub enum TriangulateError {
    /// The boundary has holes, which only the optimal method takes.
    Holes {
        /// How many.
        count: usize,
    },
    /// The boundary has holes, and the goal is the worst warp.
    GoalWithHoles {
        /// How many.
        count: usize,
    },
    /// The tables would exceed the memory limit.
    TooLarge {
        /// What they need at the most, bytes.
        needed: u64,
        /// The limit, bytes.
        limit: u64,
    },
    /// The weight of the fold price is not within 0 ..= [`MAX_FOLD`].
    Fold,
    /// The rails do not divide the loop: each needs at least one sample.
    Rails,
    /// No triangulation of this method lies inside the projection on the supporting plane.
    NoneInside,
    /// The watch stopped it.
    Stopped,
}

impl fmt::Display for TriangulateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Holes { count } => {
                let word = if *count == 1 { "hole" } else { "holes" };
                write!(f, "the boundary has {count} {word}, which only 'optimal' takes")
            }
            Self::GoalWithHoles { count } => {
                let word = if *count == 1 { "hole" } else { "holes" };
                write!(
                    f,
                    "the boundary has {count} {word}, which the goal 'worst-warp' does not take"
                )
            }
            Self::TooLarge { needed, limit } => write!(
                f,
                "the tables need {:.1} GiB of memory and may take {:.1} GiB",
                gib(*needed),
                gib(*limit)
            ),
            Self::Fold => write!(f, "the fold price is not within 0 and {MAX_FOLD}"),
            Self::Rails => write!(f, "each of the two rails needs at least one sample"),
            Self::NoneInside => {
                write!(f, "no surface of this kind was found that spans the boundary")
            }
            Self::Stopped => write!(f, "stopped"),
        }
    }
}

impl std::error::Error for TriangulateError {}

fn gib(bytes: u64) -> f64 {
    bytes as f64 / f64::from(1u32 << 30)
}

/// The cheapest triangulation of a boundary that the method admits.
///
/// With a supporting plane, every rung lies inside the boundary's projection on it; without, any
/// two samples may be joined, and the surface may cross itself, which a later stage measures.
///
/// # Errors
/// See [`TriangulateError`].
pub fn triangulate(
    boundary: &Boundary,
    plane: Option<&SupportingPlane>,
    options: &TriangulateOptions,
    watch: &mut dyn Watch,
) -> Result<Triangulation, TriangulateError> {
    Ok(triangulate_near(boundary, plane, options, None, watch)?.triangulation)
}

/// The cheapest triangulation of a boundary, as [`triangulate`] finds it; faster if `known` is a
/// triangulation of nearly the same boundary, as while a handle is dragged: its price now is an
/// upper bound. The answer does not depend on it.
///
/// # Errors
/// See [`TriangulateError`].
pub fn triangulate_near(
    boundary: &Boundary,
    plane: Option<&SupportingPlane>,
    options: &TriangulateOptions,
    known: Option<&Cheapest>,
    watch: &mut dyn Watch,
) -> Result<Cheapest, TriangulateError> {
    if options.which == WhichSurface::Cheapest {
        return cheapest_near(boundary, plane, options, known, watch);
    }
    let first = cheapest_near(boundary, plane, options, None, watch)?;
    let other = other_surface(boundary, plane, options, &first.triangulation, watch)?;
    Ok(other.map_or(first, |other| Cheapest {
        triangulation: Triangulation { is_other: true, ..other.triangulation },
        also_without_plane: None,
    }))
}

/// The cheapest triangulation of a boundary, whichever of two surfaces is meant.
fn cheapest(
    boundary: &Boundary,
    plane: Option<&SupportingPlane>,
    options: &TriangulateOptions,
    watch: &mut dyn Watch,
) -> Result<Triangulation, TriangulateError> {
    Ok(cheapest_near(boundary, plane, options, None, watch)?.triangulation)
}

fn cheapest_near(
    boundary: &Boundary,
    plane: Option<&SupportingPlane>,
    options: &TriangulateOptions,
    known: Option<&Cheapest>,
    watch: &mut dyn Watch,
) -> Result<Cheapest, TriangulateError> {
    let lengths: Vec<usize> = boundary.loops().iter().map(ExactSizeIterator::len).collect();
    refuse(&lengths, options)?;
    let memory_limit = memory::obtainable(options.memory_limit, needed(&lengths, options));
    let options = &TriangulateOptions { memory_limit, ..options.clone() };
    refuse(&lengths, options)?;
    // Some methods begin again; their progress does not.
    let watch = &mut Part::new(watch, 0.0..1.0);
    let prices = Prices::new(boundary, plane, options.price).with_hints(&options.hints, boundary);
    let known = known.filter(|known| warm_start::is_of(&known.triangulation, &lengths));
    // Exact visibility takes time, so looser tests come first.
    let nothing_asked = Visibility::everything();
    let mut also_without_plane = None;
    let as_before = known.is_some_and(|known| known.also_without_plane == Some(true));
    let known = known.map(|known| &known.triangulation);
    if as_before || plane.is_none() {
        match solve_then_check(&prices, &nothing_asked, plane, options, known, watch) {
            Ok(Some(triangulation)) => {
                return Ok(Cheapest { triangulation, also_without_plane: Some(true) });
            }
            Ok(None) => also_without_plane = Some(false),
            // With the plane, the table may be smaller.
            Err(TriangulateError::TooLarge { .. }) if plane.is_some() => {}
            Err(error) => return Err(error),
        }
    }
    let (needed, limit) = (Visibility::memory_needed(boundary.len()), options.memory_limit);
    if options.method == Method::Optimal && plane.is_some() && needed > limit {
        return Err(TriangulateError::TooLarge { needed, limit });
    }
    if let Some(plane) = plane
        && may_ask_less(&prices, options)
    {
        let at_ends = Visibility::at_ends(plane);
        let found = solve_then_check(&prices, &at_ends, Some(plane), options, known, watch)?;
        if let Some(triangulation) = found {
            return Ok(Cheapest { triangulation, also_without_plane });
        }
    }
    let visibility = Visibility::new(boundary, plane);
    // Rungs without a tangent plane are admitted only if there is no triangulation without them,
    // which the table of all rungs has shown where any two samples may be joined.
    let none_unforced = plane.is_none() && may_ask_less(&prices, options);
    let tally = holes::Tally::default();
    let work = holes::Work::new(&tally, options.work_limit);
    for forced in [false, true].into_iter().skip(usize::from(none_unforced)) {
        let mut terms = Terms::new(&prices, &visibility, forced).within(options.memory_limit);
        let simple = |triangles| Found { triangles, lower_bound: None };
        let found = if boundary.holes() > 0 {
            holes::solve(&terms, plane, boundary.loops(), f64::INFINITY, work, watch)?
        } else if options.goal == Goal::Price {
            one_loop(&terms, options.method, known, watch)?.map(simple)
        } else {
            let worst = Terms { rule: Rule::Worst, ..terms };
            let first = one_loop(&worst, options.method, None, &mut Part::new(watch, 0.0..0.5))?;
            let Some(first) = first else { continue };
            terms.bar = terms.largest(&first);
            one_loop(&terms, options.method, None, &mut Part::new(watch, 0.5..1.0))?.map(simple)
        };
        if let Some(found) = found {
            let found = outcome(&terms, found, options.method);
            let cut_short = tally.is_cut_short() && !found.proven_optimal;
            let triangulation = Triangulation { work: tally.done(), cut_short, ..found };
            return Ok(Cheapest { triangulation, also_without_plane });
        }
    }
    Err(TriangulateError::NoneInside)
}

/// The result, or `None` where the tables would exceed the memory limit.
pub fn if_it_fits<T>(
    found: Result<Option<T>, TriangulateError>,
) -> Result<Option<T>, TriangulateError> {
    match found {
        Err(TriangulateError::TooLarge { .. }) => Ok(None),
        found => found,
    }
}

/// Whether a bound on the price can prune most of the table, next to a developable surface.
fn is_bounded(options: &TriangulateOptions) -> bool {
    options.method == Method::Optimal
        && options.goal == Goal::Price
        && options.price.form == TwistForm::Normalised
}

/// The best triangles of one loop; `None` if there are none.
fn one_loop(
    terms: &Terms<'_>,
    method: Method,
    known: Option<&Triangulation>,
    watch: &mut dyn Watch,
) -> Result<Option<Vec<[usize; 3]>>, TriangulateError> {
    match method {
        Method::Optimal => optimal::solve(terms, known, watch),
        Method::Bridge => bridge::solve(terms, watch),
        Method::Rails { first } => rails::solve(terms, first, watch),
    }
}

/// Refuses loops of so many samples, the outer one first, that can't be triangulated, before any
/// computation: options out of range, tables that would exceed the memory limit.
///
/// The memory of one loop with `Optimal` depends on the boundary. Far from a developable surface,
/// [`triangulate`] may still find that it exceeds the limit.
///
/// # Errors
/// See [`TriangulateError`].
pub fn refuse(lengths: &[usize], options: &TriangulateOptions) -> Result<(), TriangulateError> {
    let (m, holes) = (lengths[0], lengths.len() - 1);
    if !(0.0..=MAX_FOLD).contains(&options.price.fold) {
        return Err(TriangulateError::Fold);
    }
    if holes > 0 && options.goal == Goal::WorstWarp {
        return Err(TriangulateError::GoalWithHoles { count: holes });
    }
    if holes > 0 && options.method != Method::Optimal {
        return Err(TriangulateError::Holes { count: holes });
    }
    let limit = options.memory_limit;
    let mut needed = needed(lengths, options);
    if needed > limit && holes == 0 && is_bounded(options) {
        needed = needed.min(optimal::least_memory_needed(m));
    }
    if needed > limit { Err(TriangulateError::TooLarge { needed, limit }) } else { Ok(()) }
}

/// Memory of the tables of a method for loops of so many samples, bytes.
fn needed(lengths: &[usize], options: &TriangulateOptions) -> u64 {
    match options.method {
        Method::Optimal if lengths.len() > 1 => holes::memory_needed(lengths),
        Method::Optimal => memory_needed(lengths[0]),
        Method::Bridge => bridge::memory_needed(lengths[0]),
        Method::Rails { first } => rails::memory_needed(first, lengths[0]),
    }
}

/// The triangles that a method has found.
struct Found {
    /// Corners counter-clockwise as seen from the side that the surface faces; on one loop in any
    /// order.
    triangles: Vec<[usize; 3]>,
    /// Lower bound on the price of all triangulations, if it is, or may be, below the price of this
    /// one.
    lower_bound: Option<f64>,
}

/// Triangles and their price.
#[derive(Clone, Debug)]
struct Solved {
    price: f64,
    triangles: Vec<[usize; 3]>,
}

/// The rungs that a method may use, and their prices.
#[derive(Clone, Copy)]
struct Terms<'a> {
    prices: &'a Prices,
    visibility: &'a Visibility,
    /// Whether rungs without a tangent plane are admitted, as a twist of 2.
    forced: bool,
    /// How the prices of parts are combined.
    rule: Rule,
    /// Rungs that are dearer are not admitted.
    bar: f64,
    /// Limit of the memory of tables, bytes, where it depends on the boundary.
    memory: u64,
}

/// How the prices of two parts are combined.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Rule {
    /// Their sum.
    Sum,
    /// The larger one; folds cost nothing.
    Worst,
}

/// A side of a triangle.
#[derive(Clone, Copy, Debug)]
struct Side {
    /// Its price: 0 for an edge of the boundary, infinite for a rung that may not be used.
    price: f64,
    /// N, or zero for an edge of the boundary and for a rung without tangent planes.
    mean: Vec3,
}

const EDGE: Side = Side { price: 0.0, mean: Vec3::ZERO };
/// A rung without tangent planes where there is no triangulation without such rungs: the largest
/// twist.
const FORCED: Side = Side { price: 2.0, mean: Vec3::ZERO };
const BARRED: Side = Side { price: f64::INFINITY, mean: Vec3::ZERO };

impl<'a> Terms<'a> {
    /// Sums of prices, and nothing barred.
    fn new(prices: &'a Prices, visibility: &'a Visibility, forced: bool) -> Self {
        Self { prices, visibility, forced, rule: Rule::Sum, bar: f64::INFINITY, memory: u64::MAX }
    }

    /// Sets the limit of the memory of tables, bytes.
    fn within(self, memory: u64) -> Self {
        Self { memory, ..self }
    }

    /// The combined price of two parts.
    #[inline(always)]
    fn together(&self, a: f64, b: f64) -> f64 {
        match self.rule {
            Rule::Sum => a + b,
            Rule::Worst => a.max(b),
        }
    }

    /// The fold price of a triangle, see [`Prices::triangle`].
    #[inline(always)]
    fn fold(&self, corners: [usize; 3], means: [Vec3; 3]) -> f64 {
        match self.rule {
            Rule::Sum => self.prices.triangle(corners, means),
            Rule::Worst => 0.0,
        }
    }

    /// Whether folds cost anything.
    fn folds(&self) -> bool {
        self.rule == Rule::Sum && self.prices.options().fold > 0.0
    }

    /// The price of the dearest rung of these triangles.
    fn largest(&self, triangles: &[[usize; 3]]) -> f64 {
        let sides = triangles.iter().flat_map(|&[i, k, j]| [(i, k), (k, j), (i, j)]);
        sides.map(|(a, b)| self.side(a, b).price).fold(0.0, f64::max)
    }

    /// The side between samples `i` and `j`, in either order.
    fn side(&self, i: usize, j: usize) -> Side {
        let (i, j) = (i.min(j), i.max(j));
        if self.prices.neighbours(i, j) {
            return EDGE;
        }
        if self.prices.is_bank(i, j) {
            let mean = self.prices.planes(i, j).map_or(Vec3::ZERO, |planes| planes.mean);
            return Side { price: 0.0, mean };
        }
        if !self.visibility.allows(i, j) {
            return BARRED;
        }
        match self.prices.planes(i, j) {
            Some(planes) => {
                let price = self.prices.rung(i, j, &planes);
                if price > self.bar { BARRED } else { Side { price, mean: planes.mean } }
            }
            None if self.forced => FORCED,
            None => BARRED,
        }
    }

    /// Writes to `strip` all sides from sample `i` to the far ends, at once: what [`Self::side`]
    /// says of each; those that do not lead to a higher sample are barred. Without N unless
    /// `MEANS`.
    #[inline(always)]
    fn strip<const MEANS: bool>(&self, i: usize, to: &FarEnds, strip: &mut Strip) {
        let in_order = self.prices.in_order();
        let is_apart = i + 1 < to.first && to.count == LANES;
        let is_plain = is_apart && in_order && (i > 0 || to.first + LANES < self.prices.len());
        let allowed = if is_plain { self.visibility.allowed(i, to.first) } else { u16::MAX };
        self.prices.strip::<MEANS>(i, to, allowed, strip);
        let Strip { prices, means } = strip;
        if is_plain {
            // No neighbours among them.
            let lost = if self.forced { FORCED.price } else { BARRED.price };
            for n in 0..LANES {
                let price = if prices[n] < f64::INFINITY {
                    if prices[n] > self.bar { BARRED.price } else { prices[n] }
                } else {
                    lost
                };
                prices[n] = if allowed >> n & 1 == 1 { price } else { BARRED.price };
            }
            return;
        }
        for n in 0..LANES {
            let j = to.first + n;
            if j <= i || n >= to.count {
                prices[n] = BARRED.price;
            } else if self.prices.neighbours(i, j) {
                prices[n] = EDGE.price;
            } else if self.prices.is_bank(i, j) {
                prices[n] = 0.0;
                continue;
            } else if !self.visibility.allows(i, j) {
                prices[n] = BARRED.price;
            } else {
                if prices[n] == f64::INFINITY && self.forced {
                    prices[n] = FORCED.price;
                } else if prices[n] > self.bar {
                    prices[n] = BARRED.price;
                }
                continue;
            }
            for mean in means.iter_mut() {
                mean[n] = 0.0;
            }
        }
    }
}

/// The part of the price of a rung that hints are.
fn of_hints(terms: &Terms<'_>, rung: &Rung) -> f64 {
    let [i, j] = rung.ends().map(SampleIndex::get);
    if terms.prices.planes(i, j).is_some() { terms.prices.of_hints(i, j) } else { 0.0 }
}

/// Orders the triangles, lists their rungs and sums their price anew.
fn outcome(terms: &Terms<'_>, found: Found, method: Method) -> Triangulation {
    let mut triangles = found.triangles;
    for triangle in &mut triangles {
        if terms.prices.one_loop() {
            triangle.sort_unstable();
        } else {
            let lowest = (0..3).min_by_key(|&n| triangle[n]).unwrap_or(0);
            triangle.rotate_left(lowest);
        }
    }
    triangles.sort_unstable();
    let mut rungs: Vec<Rung> = triangles
        .iter()
        .flat_map(|&[i, k, j]| [(i, k), (k, j), (i, j)])
        .filter(|&(a, b)| !terms.prices.neighbours(a, b))
        .map(|(a, b)| Rung::new(a, b))
        .collect();
    rungs.sort_unstable();
    rungs.dedup();
    let ends = |rung: &Rung| rung.ends().map(SampleIndex::get);
    let sides: Vec<Side> = rungs
        .iter()
        .map(|rung| {
            let [i, j] = ends(rung);
            terms.side(i, j)
        })
        .collect();
    // A rung without tangent planes has no N; one whose planes are opposite has none either.
    let without_plane = |(rung, side): &(&Rung, &Side)| {
        let [i, j] = ends(rung);
        side.mean == Vec3::ZERO && terms.prices.planes(i, j).is_none()
    };
    let forced_rungs = rungs.iter().zip(&sides).filter(without_plane).count();
    let hints = rungs.iter().map(|rung| of_hints(terms, rung)).sum();
    let of_rungs: f64 = sides.iter().map(|side| side.price).sum();
    let mean = |a: usize, b: usize| {
        let found = rungs.binary_search(&Rung::new(a, b));
        found.map_or(Vec3::ZERO, |n| sides[n].mean)
    };
    let of_fold = |&[i, k, j]: &[usize; 3]| {
        terms.prices.triangle([i, k, j], [mean(i, k), mean(k, j), mean(i, j)])
    };
    let of_folds: f64 = triangles.iter().map(of_fold).sum();
    let price = of_rungs + of_folds;
    let largest_twist = sides.iter().map(|side| side.price).fold(0.0, f64::max);
    let lower_bound = found.lower_bound.unwrap_or(price);
    let proven_optimal = method == Method::Optimal && price < EXACT_BELOW && lower_bound >= price;
    Triangulation {
        rungs,
        triangles: triangles.iter().map(|t| t.map(SampleIndex::new)).collect(),
        price,
        hints,
        is_other: false,
        largest_twist,
        proven_optimal,
        lower_bound: if method == Method::Optimal { lower_bound.min(price) } else { 0.0 },
        forced_rungs,
        work: 0,
        cut_short: false,
    }
}
