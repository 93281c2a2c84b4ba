//! The cheapest triangulation of a boundary in space, with proof.
//!
//! A boundary is given by its samples. Of all the ways to join them by rungs into a surface without
//! interior vertices, [`triangulate::triangulate`] finds the one whose tangent planes turn least
//! along the rungs. [`rung`] has the rungs, [`cost`] the prices of rungs and triangles, and
//! [`specification`] the definition of the optimum, on one page.

#![forbid(unsafe_code)]

pub mod rung;

pub mod cost;

pub mod specification;

pub mod triangulate;

#[cfg(test)]
mod test_boundaries;
