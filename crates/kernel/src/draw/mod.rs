//! What a drawing program needs of geometry, so that it computes none itself: from the way of a
//! hand to a curve, from curves in a plan to panels with holes, what people do to a curve, and
//! which pieces of a pattern are the same part.
//!
//! Everything here is a pure function on the plain values of a [design](crate::design): it returns
//! what is changed, or says in words why it can't be, and never changes what it is given.

pub mod alike;
pub mod coarse;
pub mod edit;
pub mod join;
pub mod loops;
pub mod mirror;
pub mod panels;
pub mod round;
pub mod settle;
pub mod stroke;
