//! From boundary curves to the developable surface that fits them best, and its flat pattern.
#![forbid(unsafe_code)]

pub mod math;
pub mod predicate;
pub mod tolerance;
pub mod index;
pub mod watch;
pub mod curve;
pub mod boundary;
pub mod rung;
pub mod cost;
pub mod triangulate;
pub mod surface;
pub mod flatten;
pub mod measure;
pub mod material;
pub mod pattern;
pub mod check;
pub mod design;
