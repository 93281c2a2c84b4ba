//! From points and curves to validated boundaries: the base of all other crates of Sheetwright.
//!
//! Read in this order, which is that of the arrows: [`math`] has points and vectors, [`predicate`]
//! exact tests, [`curve`] curves through points and their samples, [`boundary`] the closed loops
//! that bound a panel, validated once. Lengths are mm, angles radians. Nothing here
//! opens a file, reads a clock or starts a thread, and the same input gives the same bits on every
//! platform.

#![forbid(unsafe_code)]

pub mod math;

pub mod triangle;

pub mod predicate;

pub mod region;

pub mod offset;

pub mod tolerance;

pub mod index;

pub mod disjoint;

pub mod random;

pub mod watch;

pub mod curve;

pub mod boundary;
