//! The cheapest triangulation of a boundary in space, with proof.
//!
//! A boundary is given by its samples. Of all the ways to join them by rungs into a surface without
//! interior vertices, [`triangulate::triangulate`] finds the one whose tangent planes turn least
//! along the rungs. [`rung`] says which rungs there are, [`cost`] what they and the triangles
//! between them cost, and [`specification`], on one page, which triangulation is the optimum.

#![forbid(unsafe_code)]

pub mod rung;

pub mod cost;

pub mod specification;

pub mod triangulate;
