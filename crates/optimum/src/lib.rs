//! The cheapest triangulation of a boundary in space, with proof.
//!
//! A boundary is given by its samples. Of all the ways to join them by rungs into a surface without
//! interior vertices, [`triangulate::triangulate`] finds the one whose tangent planes turn least
//! along the rungs. [`rung`] has the rungs, [`cost`] the prices of rungs and triangles, and
//! [`specification`] the definition of the optimum, on one page.
//!
//! ```
//! use sheetwright_geometry::boundary::{Boundary, samples_from_points};
//! use sheetwright_geometry::curve::CurvePoint;
//! use sheetwright_geometry::math::Point3;
//! use sheetwright_geometry::watch::Unwatched;
//! use sheetwright_optimum::triangulate::{TriangulateOptions, triangulate};
//!
//! // A square of 100 mm with one corner lifted by 20 mm: folded along a diagonal.
//! let corners = [[0., 0., 0.], [100., 0., 0.], [100., 100., 20.], [0., 100., 0.]];
//! let points = corners.map(|[x, y, z]| CurvePoint::corner(Point3::new(x, y, z)));
//! let boundary = Boundary::new(vec![samples_from_points(&points)])?;
//! let found = triangulate(&boundary, None, &TriangulateOptions::default(), &mut Unwatched)?;
//! assert_eq!((found.triangles.len(), found.rungs.len()), (2, 1));
//! assert!(found.proven_optimal);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]

pub mod rung;

pub mod cost;

pub mod specification;

pub mod triangulate;

#[cfg(test)]
mod test_boundaries;
