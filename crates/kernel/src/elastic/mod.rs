//! The sheet as it will lie: an elastic plate that is held along its border where the surface has
//! it, and free within.
//!
//! A surface that no sheet takes by bending alone is taken by one that stretches a little, and thin
//! sheet stretches least where it leaves the ruled surface. How much it must stretch decides
//! whether it bends, and a warp angle alone does not say that: it leaves out the thickness.
//!
//! 1. The flat outline is divided into quadratic triangles (`net`).
//! 2. The energy of the sheet is that of stretching and of bending (`energy`); both are exact for
//!    large turns and small strains, which is what sheets bear.
//! 3. The border is held: every point of it lies on the curve in space, by its length along the
//!    outline, or slides along it (`hold`). From the ruled surface on, Newton's method goes to the
//!    least energy (`newton`). A place of rest that a small push would leave is left.
//! 4. What comes out is the strain of every triangle and its curvature, how far the sheet lies from
//!    the ruled surface, how stable it is, and what holds its border.
//!
//! A mesh that has points inside its border tells more of the surface than its border: there the
//! sheet is kept within a band about it (`band`), as wide as sheet leaves ruled surfaces.
//!
//! A pattern that was laid flat by lengths of sides may be fitted to the sheet at rest (`fit`).
//!
//! A sheet that is cut into several components is computed piece by piece, each held all round. So
//! a scored fold is a cut that is held where the surface has it.
//!
//! Metal that is bent beyond yield resists its bend by less (`rolled`).
//!
//! While a hand drags there is no time for all that; then a formula estimates the strain within a
//! factor of two (`screen`).
//!
//! One membrane place a triangle is on purpose: with three, thin sheets lock, and strains come out
//! several times too large.

mod band;
mod coarser;
mod element;
mod energy;
mod fit;
mod folds;
mod given;
mod hold;
mod narrow;
mod net;
mod newton;
mod outline;
mod places;
mod predict;
mod predicted;
mod rolled;
mod screen;
mod settled;
mod surface;
mod thickest;
mod tight;

pub use energy::Stiffness;
pub use given::{predict_given, screen_given};
pub use hold::Edges;
pub use predict::{predict, predict_alone};
pub use predicted::{Basis, Predicted};
pub use screen::{DOUBT, screen};
pub use surface::Reading;

use crate::flatten::Flattened;
use crate::sheet::Sheet;
use coarser::Begin;
use energy::{Energy, largest_principal};
use hold::{Edge, Stretch};
use net::Net;
use newton::Rest;
use outline::Outline;
use places::Places;
use settled::{Settled, fit_surface, settled, settled_from};
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::math::{Point2, Point3, Vec2, Vec3};
use sheetwright_geometry::watch::Watch;
use std::collections::BTreeSet;
use std::fmt;

/// How a sheet is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticOptions {
    /// About how many triangles the flat outline is divided into. Default: 350. On a wavy strip of
    /// 1 m, the strain is then within 10 % of that of 2,800 triangles.
    pub triangles: usize,
    /// Steps of Newton's method at the most. Default: 60; the sheets of the tests take 4 to 11.
    pub most_steps: usize,
    /// Of a mesh that has points inside its border: the largest distance from it, mm, at which the
    /// sheet may lie freely; it is pressed back beyond. Default: none, the border alone holds it.
    pub band_mm: Option<f64>,
    /// How often the pattern is fitted to the sheet at rest at the most, besides the three times
    /// that it is first fitted to the surface itself. Default: 0.
    pub fits: usize,
    /// The pattern is fitted until the strain that decides is no more than this, without unit.
    pub fitted: f64,
    /// Whether it is fitted in any case, however little the sheet of the given one is strained.
    /// Default: no.
    pub fits_anyway: bool,
    /// Whether it is fitted once more from a stiffer sheet, where the sheet stays strained by far
    /// more. Default: no.
    pub starts_anew: bool,
    /// Whether it begins as a far stiffer sheet, which is made softer step by step: so it finds a
    /// rest beside a folded surface where it finds none as it is. Default: no.
    pub begins_stiff: bool,
    /// How the triangles of the surface are taken. Default: they are the surface.
    pub reading: Reading,
    /// Whether components that are narrower than a side of the net are left out, if they are a
    /// small part of the sheet: the facets of narrow bends. Default: no.
    pub leaves_needles: bool,
}

impl Default for ElasticOptions {
    fn default() -> Self {
        Self {
            triangles: 350,
            most_steps: 60,
            band_mm: None,
            fits: 0,
            fitted: 0.0,
            fits_anyway: false,
            starts_anew: false,
            begins_stiff: false,
            reading: Reading::Facets,
            leaves_needles: false,
        }
    }
}

/// A sheet at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Elastic {
    /// Where the nodes lie flat, mm, once the pattern is fitted.
    pub flat: Vec<Point2>,
    /// How far each node was moved to fit the pattern to the sheet, mm.
    pub moves: Vec<Vec2>,
    /// Where they lie in space at rest, mm.
    pub positions: Vec<Point3>,
    /// The corners of every triangle, by its nodes, counter-clockwise as seen from the side that
    /// the surface faces.
    pub triangles: Vec<[usize; 3]>,
    /// The area of every triangle, flat, mm².
    pub areas_mm2: Vec<f64>,
    /// The largest principal strain of every triangle in the plane, without its sign and unit.
    pub strains: Vec<f64>,
    /// The larger principal curvature of every triangle, without its sign, 1/mm.
    pub curvatures: Vec<f64>,
    /// The triangle of the surface below the middle of every triangle, by its number.
    pub over: Vec<usize>,
    /// The largest distance of a node from where it lies on the ruled surface, mm; where its edges
    /// slide, and of a mesh that has points inside its border, across the surface alone.
    pub distance_max_mm: f64,
    /// How far a point of the border slides along the boundary at the most, mm; 0 where it is held.
    pub slid_max_mm: f64,
    /// The force that holds the border across the sheet, per length, N/mm: 95 % of the border
    /// takes less. Within a factor of 1.5 of that of finer nets.
    pub load_n_per_mm: f64,
    /// The energy of stretching, N·mm.
    pub stretching_n_mm: f64,
    /// The energy of bending, N·mm.
    pub bending_n_mm: f64,
    /// Whether it stays where it lies when it is pushed a little.
    pub is_stable: bool,
    /// How many steps were taken.
    pub steps: usize,
}

/// Why a sheet can't be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElasticError {
    /// Its flat outline can't be divided into triangles, as where it overlaps itself.
    NoNet,
    /// The steps did not come to rest.
    NoRest,
    /// The system of equations does not fit the memory.
    TooLarge,
    /// The watcher asked to stop.
    Stopped,
}

impl fmt::Display for ElasticError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoNet => write!(f, "the flat outline can't be divided into triangles"),
            Self::NoRest => write!(f, "the sheet did not come to rest"),
            Self::TooLarge => write!(f, "the system of equations does not fit the memory"),
            Self::Stopped => write!(f, "stopped"),
        }
    }
}

impl std::error::Error for ElasticError {}

/// The sheet at rest whose border is held where the surface of `sheet` has it.
///
/// # Errors
/// See [`ElasticError`].
pub fn elastic(
    sheet: &Sheet,
    flat: &Flattened,
    stiffness: Stiffness,
    options: &ElasticOptions,
    watch: &mut dyn Watch,
) -> Result<Elastic, ElasticError> {
    elastic_on(&Edges::default(), sheet, flat, stiffness, options, watch)
}

/// The sheet at rest whose border is held as `edges` say.
///
/// # Errors
/// See [`ElasticError`].
pub fn elastic_on(
    edges: &Edges,
    sheet: &Sheet,
    flat: &Flattened,
    stiffness: Stiffness,
    options: &ElasticOptions,
    watch: &mut dyn Watch,
) -> Result<Elastic, ElasticError> {
    at_rest(&Task { sheet, flat, edges, coarser: None }, stiffness, options, watch)
}

/// What is computed.
struct Task<'a> {
    /// The surface, and its pattern.
    sheet: &'a Sheet,
    flat: &'a Flattened,
    /// What holds its border.
    edges: &'a Edges,
    /// The sheet at rest on a coarser net, to begin from.
    coarser: Option<&'a Elastic>,
}

/// A sheet may lie so many times as far from its surface as its band is wide on either side.
const MOST_BANDS: f64 = 2.0;

/// The sheet at rest.
fn at_rest(
    task: &Task<'_>,
    stiffness: Stiffness,
    options: &ElasticOptions,
    watch: &mut dyn Watch,
) -> Result<Elastic, ElasticError> {
    let Task { sheet, flat, edges, coarser } = *task;
    let outline = options.band_mm.map_or(Outline::Sampled, |_| Outline::Coarse);
    let read = (options.reading, options.leaves_needles);
    let net = Net::new(sheet, flat, edges, options.triangles, outline, read);
    let mut net = net.ok_or(ElasticError::NoNet)?;
    // The bending form takes differences of products of positions: near to the origin, few digits
    // are lost.
    let away = net.space[0].to_vec();
    let mut begin = coarser.map(|coarser| Begin::of(coarser, (sheet, flat, options.reading), &net));
    let places = begin.iter_mut().flat_map(|begin| &mut begin.positions);
    net.space.iter_mut().chain(places).for_each(|p| *p += -away);
    let settled = match begin {
        None => settled(&mut net, stiffness, options, watch)?,
        Some(begin) => settled_from(begin, &mut net, stiffness, options, watch)?,
    };
    let Settled { energy, at_rest, moves } = settled;
    // A sheet that is pressed so far off its surface does not have its shape.
    if let (Some(half_mm), Some(off_mm)) = (options.band_mm, energy.farthest_mm(&at_rest.positions))
        && off_mm > MOST_BANDS * half_mm
    {
        return Err(ElasticError::NoRest);
    }
    let Rest { positions, slid_max_mm, is_stable, steps } = at_rest;
    let moved = |n: usize| match positions[n] - net.space[n] {
        way if slid_max_mm > 0.0 => way.dot(net.facing[n]).abs(),
        way => way.length(),
    };
    let bending_n_mm = energy.bending_value(&positions);
    Ok(Elastic {
        areas_mm2: energy.areas(),
        strains: energy.strains(&positions).into_iter().map(largest_principal).collect(),
        curvatures: energy.curvatures(&positions),
        distance_max_mm: energy
            .farthest_mm(&positions)
            .unwrap_or_else(|| (0..positions.len()).map(moved).fold(0.0, f64::max)),
        slid_max_mm,
        load_n_per_mm: load_n_per_mm(&net, &energy, &positions),
        stretching_n_mm: energy.value(&positions) - bending_n_mm - energy.band_value(&positions),
        bending_n_mm,
        is_stable,
        steps,
        triangles: net.elements.iter().map(|nodes| [nodes[0], nodes[1], nodes[2]]).collect(),
        over: net.over,
        moves,
        flat: net.flat,
        positions: positions.into_iter().map(|p| p + away).collect(),
    })
}

/// The curvature that 95 % of the area of a surface stays below, 1/mm, on a net of the default
/// size; `None` where there is no net.
fn curvature_of_surface(sheet: &Sheet, flat: &Flattened, read: (Reading, bool)) -> Option<f64> {
    let triangles = ElasticOptions::default().triangles;
    let held = Edges::default();
    let net = Net::new(sheet, flat, &held, triangles, Outline::Coarse, read)?;
    let energy = Energy::new(&net, Stiffness::new(1.0, 1.0, 0.3))?;
    Some(at_share(&energy.curvatures(&net.space), &energy.areas(), DECIDES))
}

/// The strain of a surface itself that 95 % of the area stays below, once its pattern is fitted to
/// it; `None` where there is no net.
fn strain_of_fitted(sheet: &Sheet, flat: &Flattened, read: (Reading, bool)) -> Option<f64> {
    let triangles = ElasticOptions::default().triangles;
    let mut net = Net::new(sheet, flat, &Edges::default(), triangles, Outline::Coarse, read)?;
    let stiffness = Stiffness::new(1.0, 1.0, 0.3);
    fit_surface(&mut net, stiffness).ok()?;
    let energy = Energy::new(&net, stiffness)?;
    let strains = energy.strains(&net.space).into_iter().map(largest_principal);
    Some(at_share(&strains.collect::<Vec<_>>(), &energy.areas(), DECIDES))
}

impl Elastic {
    /// The strain in the plane that decides: 95 % of the area stays below it. Without unit.
    pub fn strain(&self) -> f64 {
        self.strain_at(DECIDES)
    }

    /// The curvature that decides: 95 % of the area stays below it. 1/mm.
    pub fn curvature(&self) -> f64 {
        self.curvature_at(DECIDES)
    }

    /// Where the strain in the plane is largest, in space, mm: the middles of the triangles of
    /// [`Self::most_strained_triangles`].
    pub fn most_strained(&self) -> Vec<Point3> {
        self.most_strained_triangles().into_iter().map(|n| self.middle(n)).collect()
    }

    /// The triangles whose strain in the plane is largest: at most three that are apart by a tenth
    /// of the size of the sheet, the worst first.
    pub fn most_strained_triangles(&self) -> Vec<usize> {
        let apart = 0.1 * size_of(self.positions.iter().copied());
        let mut order: Vec<usize> = (0..self.strains.len()).collect();
        order.sort_by(|&a, &b| self.strains[b].total_cmp(&self.strains[a]).then(a.cmp(&b)));
        let bound = self.strain();
        let mut places: Vec<usize> = Vec::new();
        for n in order.into_iter().take_while(|&n| self.strains[n] >= bound) {
            let middle = self.middle(n);
            if places.iter().all(|&place| self.middle(place).distance(middle) > apart) {
                places.push(n);
            }
            if places.len() == MOST_PLACES {
                break;
            }
        }
        places
    }

    /// The middle of a triangle in space, mm.
    pub fn middle(&self, triangle: usize) -> Point3 {
        let [a, b, c] = self.triangles[triangle].map(|v| self.positions[v]);
        a + ((b - a) + (c - a)) / 3.0
    }

    /// Where points of the pattern go, mm, if the pattern was fitted to the sheet; else `None`.
    pub(crate) fn fitted(&self, points: &[Point2]) -> Option<Vec<Point2>> {
        if self.moves.iter().all(|way| *way == Vec2::ZERO) {
            return None;
        }
        let before = |n: usize| self.flat[n] + self.moves[n] * -1.0;
        let places = Places::new(self.triangles.iter().map(|t| t.map(before)));
        let fitted = |&p: &Point2| {
            let (t, weights) = places.located(p);
            let of = self.triangles[t].iter().zip(weights);
            of.fold(p, |sum, (n, weight)| sum + self.moves[*n] * weight)
        };
        Some(points.iter().map(fitted).collect())
    }

    /// The normal of the sheet at rest at a point of the flat sheet, mm; `None` beside it.
    fn normal_at(&self, p: Point2) -> Option<Vec3> {
        let holds = |t: &&[usize; 3]| {
            let [a, b, c] = t.map(|n| self.flat[n]);
            [(a, b), (b, c), (c, a)].into_iter().all(|(a, b)| (b - a).perp_dot(p - a) >= 0.0)
        };
        let [a, b, c] = self.triangles.iter().find(holds)?.map(|n| self.positions[n]);
        Some((b - a).cross(c - a))
    }

    /// The strain in the plane that this share of the area stays below, without unit.
    pub fn strain_at(&self, share: f64) -> f64 {
        at_share(&self.strains, &self.areas_mm2, share)
    }

    /// The curvature that this share of the area stays below, 1/mm.
    pub fn curvature_at(&self, share: f64) -> f64 {
        at_share(&self.curvatures, &self.areas_mm2, share)
    }
}

/// So many places are named.
const MOST_PLACES: usize = 3;

/// The share of the area, or of the border, that decides: a point takes none of it.
const DECIDES: f64 = 0.95;

/// The force across the sheet that the border takes, per length: that at a corner node and half of
/// that at the middles beside it, over half of the sides beside it. What nothing holds takes none
/// and does not count.
fn load_n_per_mm(net: &Net, energy: &Energy, positions: &[Point3]) -> f64 {
    let slopes = energy.slopes(positions);
    let normals = net.border_normals(positions);
    let free = net.stretches.iter().flatten().filter(|stretch| stretch.edge == Edge::IsFree);
    let inside = |stretch: &Stretch| stretch.nodes[1..stretch.nodes.len() - 1].to_vec();
    let free: BTreeSet<usize> = free.flat_map(inside).collect();
    let (mut loads, mut lengths) = (Vec::new(), Vec::new());
    for line in &net.border {
        let m = line.len();
        let at = |n: usize| line[n % m];
        for n in (0..m).step_by(2).filter(|&n| !free.contains(&at(n))) {
            let force = slopes[at(n)] + (slopes[at(n + m - 1)] + slopes[at(n + 1)]) * 0.5;
            let way = |a: usize, b: usize| net.flat[at(a)].distance(net.flat[at(b)]);
            let length = way(n + m - 1, n) + way(n, n + 1);
            loads.push(force.dot(normals[at(n)]).abs() / length);
            lengths.push(length);
        }
    }
    at_share(&loads, &lengths, DECIDES)
}

/// The value that a share of all stays below, each with its weight.
fn at_share(values: &[f64], weights: &[f64], share: f64) -> f64 {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]).then(a.cmp(&b)));
    let wanted = share * weights.iter().sum::<f64>();
    let mut below = 0.0;
    for &n in &order {
        below += weights[n];
        if below >= wanted {
            return values[n];
        }
    }
    order.last().map_or(0.0, |&n| values[n])
}
