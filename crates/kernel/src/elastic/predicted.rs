//! What is predicted of a sheet: how far it must stretch and bend to take its shape, beside what it
//! takes.

use super::{Elastic, Stiffness};
use crate::material::Limits;

/// The strain on one coarse net is at least that of fine nets over the first factor, and at most
/// that times the second: coarse nets read high beside points.
const DOUBT_OF_ONE: [f64; 2] = [1.25, 1.5];

/// An elastic sheet has at least the strain of the triangles of the pattern over the first factor,
/// by which a twisted strip is relieved where it leaves the surface, and at most that times the
/// second.
const PATTERN_DOUBT: [f64; 2] = [4.0, 1.25];

/// A sheet may have this share of the curvature that was found: nets tell radii within 5 %, and
/// read high beside edges.
const CURVATURE_DOUBT: f64 = 0.95;

/// How a strain was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// An elastic sheet was computed.
    Computed,
    /// A formula estimated it, and an elastic sheet is to follow.
    Screen,
    /// A formula estimated it, since the outline can't be divided into triangles, as where the
    /// pattern overlaps itself.
    NoNet,
    /// A formula estimated it, since the elastic sheet did not come to rest.
    NoRest,
    /// A formula estimated it, since metal is rolled more tightly than the net of a computed sheet
    /// can follow.
    TooTight,
    /// The triangles of a mesh tell it, by their stretches from the pattern to the shape: they are
    /// stretched too far, or no sheet could be computed.
    Pattern,
}

/// The strain that a sheet is predicted to have in its shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Predicted {
    /// What the sheet takes.
    pub limits: Limits,
    /// How the strain was found.
    pub basis: Basis,
    /// The strain in the plane that 95 % of the area stays below, without unit.
    pub strain: f64,
    /// The least and the greatest that this may be.
    pub strain_range: [f64; 2],
    /// The curvature that decides, 1/mm: what 95 % of the area stays below or, if that is more,
    /// that of narrow bends and of tight patches.
    pub curvature: f64,
    /// The folds that it needs, by their rungs, in increasing order.
    pub scored: Vec<usize>,
    /// The sheet at rest, if it was computed and is not flat.
    pub at_rest: Option<Elastic>,
    /// The thickest sheet of its kind that takes the shape, mm, if this one does not and such a
    /// sheet was found.
    pub thickest_mm: Option<f64>,
}

impl Predicted {
    /// That of a sheet that stays flat.
    pub fn flat(limits: Limits) -> Self {
        Self {
            limits,
            basis: Basis::Computed,
            strain: 0.0,
            strain_range: [0.0; 2],
            curvature: 0.0,
            scored: Vec::new(),
            at_rest: None,
            thickest_mm: None,
        }
    }

    /// That of a mesh whose triangles must stretch by this to come from the pattern to their shape:
    /// what 95 % of the area stays below. A sheet that leaves the surface a little stretches less.
    pub fn of_pattern(limits: Limits, strain: f64) -> Self {
        let strain_range = [strain / PATTERN_DOUBT[0], strain * PATTERN_DOUBT[1]];
        Self { basis: Basis::Pattern, strain, strain_range, ..Self::flat(limits) }
    }

    /// That of a sheet at rest on one net.
    pub fn computed(limits: Limits, at_rest: Elastic) -> Self {
        let (strain, curvature) = (at_rest.strain(), at_rest.curvature());
        Self {
            strain,
            strain_range: [strain / DOUBT_OF_ONE[1], strain * DOUBT_OF_ONE[0]],
            curvature,
            at_rest: Some(at_rest),
            ..Self::flat(limits)
        }
    }

    /// That of this sheet at rest on a finer net. The strain lies among those of both nets and the
    /// limit that they tend to, if the error falls with the length of the sides.
    pub fn refined(&self, at_rest: Elastic) -> Self {
        let finer = Self::computed(self.limits.clone(), at_rest);
        let side = |p: &Self| {
            let triangles = p.at_rest.as_ref().map_or(1, |sheet| sheet.triangles.len());
            1.0 / (triangles as f64).sqrt()
        };
        let (long, short) = (side(self), side(&finer));
        if long <= short {
            return finer;
        }
        let further = (finer.strain - self.strain) * short / (long - short);
        let tends_to = (finer.strain + further).max(0.0);
        let all = [self.strain, finer.strain, tends_to];
        let strain_range =
            [all.into_iter().fold(f64::INFINITY, f64::min), all.into_iter().fold(0.0, f64::max)];
        Self { strain_range, ..finer }
    }

    /// The strain of the outer fibre that decides, without unit: that at the curvature.
    pub fn outer_fibre(&self) -> f64 {
        self.limits.outer_fibre_at(self.curvature)
    }

    /// How much it uses of what the sheet takes: 1 is the limit.
    pub fn usage(&self) -> f64 {
        self.limits.use_of(self.strain, self.curvature)
    }

    /// The least and the greatest that this may be.
    pub fn usage_range(&self) -> [f64; 2] {
        let [least, most] = self.strain_range;
        let curvature = self.curvature;
        [(least, CURVATURE_DOUBT * curvature), (most, curvature)]
            .map(|(strain, curvature)| self.limits.use_of(strain, curvature))
    }

    /// The bend radius that decides, mm, at its least and its greatest.
    pub fn radius_range_mm(&self) -> [f64; 2] {
        [1.0, CURVATURE_DOUBT].map(|doubt| 1.0 / (doubt * self.curvature))
    }

    /// The largest distance of the sheet at rest from the surface, mm; `None` where it was not
    /// computed.
    pub fn rest_distance_mm(&self) -> Option<f64> {
        let is_flat = self.basis == Basis::Computed;
        self.at_rest.as_ref().map(|sheet| sheet.distance_max_mm).or(is_flat.then_some(0.0))
    }

    /// How far the edges of the sheet slide along the boundary at the most, mm; `None` where they
    /// are held, or where no sheet was computed.
    pub fn slide_mm(&self) -> Option<f64> {
        self.at_rest.as_ref().map(|sheet| sheet.slid_max_mm).filter(|mm| *mm > 0.0)
    }

    /// The moment that holds an edge, per length, N (N·m/m): the bending stiffness times the
    /// curvature, but of metal beyond yield the plastic one. `None` where Young's modulus is
    /// unknown.
    pub fn hold_moment_n(&self) -> Option<f64> {
        let Limits { thickness_mm, poisson, modulus_n_per_mm2, moment_share, .. } = self.limits;
        let stiffness = Stiffness::new(thickness_mm, modulus_n_per_mm2?, poisson);
        let curvature = moment_share * self.curvature;
        Some(stiffness.bending_n_mm * curvature.min(self.limits.plastic_curvature()))
    }

    /// The load across the sheet that holds its border, N/mm, within a factor of 1.5. `None` where
    /// Young's modulus is unknown, or no sheet was computed.
    pub fn hold_load_n_per_mm(&self) -> Option<f64> {
        self.limits.modulus_n_per_mm2?;
        self.at_rest.as_ref().map(|sheet| sheet.load_n_per_mm)
    }
}
