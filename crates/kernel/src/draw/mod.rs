//! The geometry of a drawing program, so that the program computes none itself: from the path of a
//! pointer to a curve, from curves in a plan to panels with holes, edits of a curve, and which
//! pieces of a pattern are equal parts.
//!
//! All functions here are pure, on the plain values of a [design](crate::design): each returns the
//! changed value, or an error in words, and never changes its arguments.

pub mod coarse;
pub mod edit;
pub mod join;
pub mod loops;
pub mod mirror;
pub mod panels;
pub mod round;
pub mod settle;
pub mod stroke;
