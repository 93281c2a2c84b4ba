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
//!    outline. From the ruled surface on, Newton's method goes to the least energy (`newton`). A
//!    place of rest that a small push would leave is left.
//! 4. What comes out is the strain of every triangle, in the plane and in the outer fibre, how far
//!    the sheet lies from the ruled surface, and how stable it is.
//!
//! One membrane place a triangle is on purpose: with three, thin sheets lock, and strains come out
//! several times too large.

mod element;
mod energy;
mod net;
mod newton;

pub use energy::Stiffness;

use crate::flatten::Flattened;
use crate::sheet::Sheet;
use energy::{Energy, largest_principal};
use net::Net;
use newton::{Rest, rest};
use sheetwright_geometry::math::{Point2, Point3};
use sheetwright_geometry::watch::Watch;
use std::fmt;

/// How a sheet is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ElasticOptions {
    /// About how many triangles the flat outline is divided into. Default: 350. On a wavy strip of
    /// 1 m, the strain is then within 10 % of that of 2,800 triangles.
    pub triangles: usize,
    /// Steps of Newton's method at the most. Default: 60; the sheets of the tests take 4 to 11.
    pub most_steps: usize,
}

impl Default for ElasticOptions {
    fn default() -> Self {
        Self { triangles: 350, most_steps: 60 }
    }
}

/// A sheet at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Elastic {
    /// Where the nodes lie flat, mm.
    pub flat: Vec<Point2>,
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
    /// The largest distance of a node from where it lies on the ruled surface, mm.
    pub distance_max_mm: f64,
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
    let mut net = Net::new(sheet, flat, options.triangles).ok_or(ElasticError::NoNet)?;
    // The bending form takes differences of products of positions: near to the origin, few digits
    // are lost.
    let away = net.space[0].to_vec();
    net.space.iter_mut().for_each(|p| *p += -away);
    let energy = Energy::new(&net, stiffness).ok_or(ElasticError::NoNet)?;
    let Rest { positions, is_stable, steps } = rest(&net, &energy, options.most_steps, watch)?;
    let moved = positions.iter().zip(&net.space).map(|(now, before)| now.distance(*before));
    let bending_n_mm = energy.bending_value(&positions);
    Ok(Elastic {
        areas_mm2: energy.areas(),
        strains: energy.strains(&positions).into_iter().map(largest_principal).collect(),
        curvatures: energy.curvatures(&positions),
        distance_max_mm: moved.fold(0.0, f64::max),
        stretching_n_mm: energy.value(&positions) - bending_n_mm,
        bending_n_mm,
        is_stable,
        steps,
        triangles: net.elements.iter().map(|nodes| [nodes[0], nodes[1], nodes[2]]).collect(),
        over: net.over,
        flat: net.flat,
        positions: positions.into_iter().map(|p| p + away).collect(),
    })
}

impl Elastic {
    /// The strain in the plane that this share of the area stays below, without unit.
    pub fn strain_at(&self, share: f64) -> f64 {
        at_share(&self.strains, &self.areas_mm2, share)
    }

    /// The curvature that this share of the area stays below, 1/mm.
    pub fn curvature_at(&self, share: f64) -> f64 {
        at_share(&self.curvatures, &self.areas_mm2, share)
    }
}

/// The value that a share of the area stays below.
fn at_share(values: &[f64], areas: &[f64], share: f64) -> f64 {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]).then(a.cmp(&b)));
    let wanted = share * areas.iter().sum::<f64>();
    let mut below = 0.0;
    for &n in &order {
        below += areas[n];
        if below >= wanted {
            return values[n];
        }
    }
    order.last().map_or(0.0, |&n| values[n])
}
