//! Where a sheet on a finer net begins: at the rest of the one on a coarser net.
//!
//! That says how far the pattern was moved to fit it, and how far the sheet lies from its surface.
//! Both are carried over at the corners of the coarse triangles, and are linear between them. From
//! there, a few steps lead to the rest on the finer net, where those from the surface itself would
//! have to find the way, and fit the pattern, anew.

use super::Elastic;
use super::net::Net;
use super::places::Places;
use super::surface::{Reading, Surface};
use crate::flatten::Flattened;
use crate::sheet::Sheet;
use sheetwright_geometry::math::{Point2, Point3, Vec2, Vec3};
use std::collections::BTreeMap;

/// The beginning on a finer net.
pub(super) struct Begin {
    /// How far the pattern is moved at every node, mm.
    pub(super) moves: Vec<Vec2>,
    /// Whether it is moved at all.
    pub(super) is_fitted: bool,
    /// Where the nodes begin in space, mm.
    pub(super) positions: Vec<Point3>,
    /// The strain that decided on the coarser net, without unit.
    pub(super) strain: f64,
}

impl Begin {
    /// The beginning on a net of a sheet.
    pub(super) fn of(
        coarser: &Elastic,
        (sheet, flat, reading): (&Sheet, &Flattened, Reading),
        net: &Net,
    ) -> Self {
        let given = |n: usize| coarser.flat[n] + coarser.moves[n] * -1.0;
        let lifts = lifts(coarser, &Surface::new(sheet, flat, reading));
        let places = Places::new(coarser.triangles.iter().map(|t| t.map(given)));
        let mut moves = Vec::with_capacity(net.flat.len());
        let mut positions = net.space.clone();
        for (n, &at) in net.flat.iter().enumerate() {
            let (t, weights) = places.located(at);
            let corners = coarser.triangles[t].into_iter().zip(weights);
            let (mut way, mut lift) = (Vec2::ZERO, Vec3::ZERO);
            for (corner, weight) in corners {
                way += coarser.moves[corner] * weight;
                lift += lifts[&corner] * weight;
            }
            moves.push(way);
            if !net.on_border[n] {
                positions[n] += lift;
            }
        }
        let is_fitted = coarser.moves.iter().any(|way| *way != Vec2::ZERO);
        Self { moves, is_fitted, positions, strain: coarser.strain() }
    }
}

/// How far each corner of the triangles of a sheet at rest lies from its place on the surface, mm.
fn lifts(coarser: &Elastic, surface: &Surface<'_>) -> BTreeMap<usize, Vec3> {
    let lift = |n: usize| {
        let given: Point2 = coarser.flat[n] + coarser.moves[n] * -1.0;
        coarser.positions[n] - surface.at(given).0
    };
    coarser.triangles.iter().flatten().map(|&n| (n, lift(n))).collect()
}
