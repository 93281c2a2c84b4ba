//! Boundaries of known surfaces, with their developments: for tests, benchmarks and figures.
//!
//! [`developable`] has surfaces whose flat form is known in closed form, [`family`] the curve
//! families that programs of this field are compared on, [`hemisphere`] the pieces of a gored
//! hemisphere, [`gored`] what gores lose of a sphere, [`transition`] the classical square-to-round
//! duct and [`random`] a generator of numbers and boundaries.

pub mod developable;
pub mod family;
pub mod gored;
pub mod hemisphere;
pub mod random;
mod trace;
pub mod transition;

pub use trace::{Trace, samples_along};
