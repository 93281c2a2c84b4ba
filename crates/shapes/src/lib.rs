//! Boundaries of known surfaces, with their developments: for tests, benchmarks and figures.
//!
//! [`developable`] has surfaces whose flat form is known in closed form, [`family`] the curve
//! families that programs of this field are compared on, [`hemisphere`] the pieces of a gored
//! hemisphere and [`random`] a generator of numbers and boundaries.

pub mod developable;
pub mod family;
pub mod hemisphere;
pub mod random;
pub mod three_cones;
mod trace;

pub use trace::{Trace, samples_along};
