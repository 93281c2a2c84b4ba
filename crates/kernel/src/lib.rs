//! From boundary curves to the developable surface that fits them best, and its flat pattern.
//!
//! A panel is bounded by curves in space. They are sampled; of all the ways to join the samples by
//! rungs into a surface without interior vertices, the one whose tangent planes turn least along
//! the rungs is found, with proof; and because it has no interior vertices it is laid flat without
//! changing a length. What remains is to measure it and to say whether a sheet will follow. A panel
//! may also be a mesh from elsewhere, which is laid flat with as little stretch as can be.
//!
//! ```
//! use sheetwright::{Design, DesignCurve, Unwatched, Verdict, make};
//!
//! // A strip between two rails: the chine and the sheer of a small boat, in mm.
//! let chine = DesignCurve::spline("chine", [[0., 0., 0.], [900., 310., 40.], [1800., 420., 60.]]);
//! let sheer =
//!     DesignCurve::spline("sheer", [[-80., 0., 300.], [900., 450., 320.], [1800., 560., 330.]]);
//! let made = make(&Design::between("side", [chine, sheer]), &mut Unwatched)?;
//!
//! let side = &made.parts[0];
//! assert_eq!(side.checked.verdict, Verdict::Bends);
//! assert!(side.measures.length_error_max < 1e-12);
//! assert_eq!(side.piece.size.x.round(), 1986.0);
//! # Ok::<(), sheetwright::MakeError>(())
//! ```
//!
//! [`Design`] is what goes in, [`Part`] what comes out, [`make()`] the way between; [`Live`] keeps
//! up with a design while it is edited. `sheetwright_files` reads designs from files and writes
//! patterns and reports.
//!
//! The list of modules is the flow: a module uses only those above it. Lengths are mm, angles
//! radians. The kernel opens no file, reads no clock, prints nothing and, but for the feature
//! `rayon`, starts no thread, and the same input gives the same bits on every platform.
#![forbid(unsafe_code)]

pub use sheetwright_geometry::{
    boundary, curve, disjoint, index, math, predicate, random, tolerance, triangle, watch,
};
pub use sheetwright_optimum::{cost, rung, triangulate};

pub use boundary::PlaneChoice;
pub use check::{Checked, Finding, Severity, Verdict};
pub use curve::{CurveKind, CurvePoint};
pub use design::{
    CurveUse, Design, DesignCurve, DesignPanel, PanelMesh, PanelMethod, PanelShape, Triangles,
};
pub use edge::Edge;
pub use make::{Live, Made, MakeError, Part, make};
pub use material::Material;
pub use math::{Point2, Point3};
pub use measure::Measures;
pub use pattern::Piece;
pub use sheet::Sheet;
pub use watch::{Unwatched, Watch};

pub mod surface;

pub mod mesh;

pub mod sheet;

pub mod flatten;

pub mod nets;

pub mod quads;

pub mod measure;

pub mod material;

pub mod elastic;

pub mod design;

pub mod sample;

pub mod fair;

pub mod edge;

pub mod bend;

pub mod pattern;

pub mod trim;

pub mod mark;

pub mod divide;

pub mod nest;

pub mod check;

pub mod make;

pub mod draw;

pub mod template;
