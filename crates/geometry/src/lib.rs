//! From points and curves to validated boundaries: the base of all other crates of Sheetwright.
//!
//! Read in this order, which is that of the arrows: [`math`] has points and vectors, [`predicate`]
//! exact tests, [`curve`] curves through points and their samples, [`boundary`] the closed loops
//! that bound a panel, validated once. Lengths are mm, angles radians. Nothing here
//! opens a file, reads a clock or starts a thread, and the same input gives the same bits on every
//! platform.
//!
//! ```
//! use sheetwright_geometry::boundary::{Boundary, samples_from_points};
//! use sheetwright_geometry::curve::CurvePoint;
//! use sheetwright_geometry::math::Point3;
//!
//! // A square of 100 mm with one corner lifted by 20 mm.
//! let corners = [[0., 0., 0.], [100., 0., 0.], [100., 100., 20.], [0., 100., 0.]];
//! let points = corners.map(|[x, y, z]| CurvePoint::corner(Point3::new(x, y, z)));
//! let boundary = Boundary::new(vec![samples_from_points(&points)])?;
//! assert_eq!((boundary.len(), boundary.holes()), (4, 0));
//! assert_eq!(boundary.area_vector().z, 10_000.0);
//! # Ok::<(), sheetwright_geometry::boundary::BoundaryError>(())
//! ```

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
