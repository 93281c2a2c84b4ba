//! Boundaries of known surfaces, with their developments: for tests, benchmarks and figures.
//!
//! [`developable`] has surfaces whose development is known in closed form, [`rings`] such surfaces
//! with holes, [`damage`] meshes as other programs damage them, [`family`] the curve families that
//! programs of this field are compared on,
//! [`hemisphere`] the pieces of a gored hemisphere, [`gored`] the losses of gores against a sphere,
//! [`solids`] bodies of flat faces, [`low_poly`] an animal and a helmet of some hundred facets,
//! [`transition`] the classical square-to-round duct, [`three_cones`] a sheet that branches,
//! [`random`] a generator of numbers and boundaries, [`bent`] panels on both sides of what a sheet
//! takes, [`hull`] the planks of a published hull,
//! [`drag`] handles and how a hand drags them, [`gallery`] the shapes of the gallery, [`pierced`]
//! random boundaries with holes, [`domain`] the definition of a triangulation of such a boundary,
//! and [`findings`] a finding of each kind.
#![allow(clippy::expect_used)] // nothing comes from outside: a shape that fails is a fault of ours

pub mod bent;
pub mod damage;
pub mod developable;
pub mod domain;
pub mod drag;
pub mod family;
pub mod findings;
pub mod gallery;
pub mod gored;
pub mod hemisphere;
pub mod hull;
pub mod low_poly;
pub mod materials;
pub mod meshes;
pub mod pierced;
pub mod random;
pub mod rings;
pub mod solids;
pub mod three_cones;
mod trace;
pub mod transition;

pub use trace::{Trace, samples_along};
