//! From boundary curves to the developable surface that fits them best, and its flat pattern.
//!
//! A panel is bounded by curves in space. They are sampled; of all the ways to join the samples by
//! rungs into a surface without interior vertices, the one whose tangent planes turn least along
//! the rungs is found, with proof; and because it has no interior vertices it is laid flat without
//! changing a length. What remains is to measure it and to say whether a sheet will follow.
//!
//! The list of modules is the flow: a module uses only those above it. Lengths are mm, angles
//! radians. The kernel opens no file, reads no clock, prints nothing and, but for the feature
//! `rayon`, starts no thread, and the same input gives the same bits on every platform.
//!
//! ```
//! use sheetwright::boundary::PlaneChoice;
//! use sheetwright::check::Verdict;
//! use sheetwright::curve::{CurveKind, CurvePoint};
//! use sheetwright::design::{
//!     CurveUse, Design, DesignCurve, DesignPanel, PanelMethod, PanelShape,
//! };
//! use sheetwright::make::make;
//! use sheetwright::math::Point3;
//! use sheetwright::triangulate::Goal;
//! use sheetwright::watch::Unwatched;
//!
//! // A strip between two rails: the chine and the sheer of a small boat, in mm.
//! let rail = |name: &str, points: [[f64; 3]; 3]| DesignCurve {
//!     name: name.into(),
//!     kind: Some(CurveKind::Spline),
//!     closed: false,
//!     points: points.map(|[x, y, z]| CurvePoint::smooth(Point3::new(x, y, z))).to_vec(),
//! };
//! let on = |name: &str| CurveUse { name: name.into(), reversed: false };
//! let design = Design {
//!     name: "dinghy".into(),
//!     curves: vec![
//!         rail("chine", [[0., 0., 0.], [900., 310., 40.], [1800., 420., 60.]]),
//!         rail("sheer", [[-80., 0., 300.], [900., 450., 320.], [1800., 560., 330.]]),
//!     ],
//!     panels: vec![DesignPanel {
//!         name: "side".into(),
//!         shape: PanelShape::Rails([on("chine"), on("sheer")]),
//!         samples: 50,
//!         method: PanelMethod::Optimal,
//!         goal: Goal::Price,
//!         run_on: false,
//!         plane: PlaneChoice::Auto,
//!         fold: sheetwright::cost::DEFAULT_FOLD,
//!         effort: 1.0,
//!         cut: Vec::new(),
//!     }],
//!     ..Design::default()
//! };
//!
//! let side = &make(&design, &mut Unwatched)?.parts[0];
//! assert!(side.found().is_some_and(|found| found.triangulation.proven_optimal));
//! assert_eq!(side.checked.verdict, Verdict::Bends);
//! assert!(side.measures.length_error_max < 1e-12);
//! # Ok::<(), sheetwright::make::MakeError>(())
//! ```
#![forbid(unsafe_code)]

pub use sheetwright_geometry::{boundary, curve, index, math, predicate, tolerance, watch};
pub use sheetwright_optimum::{cost, rung, triangulate};

pub mod surface;

pub mod mesh;

pub mod sheet;

pub mod flatten;

pub mod quads;

pub mod measure;

pub mod material;

pub mod design;

pub mod sample;

pub mod fair;

pub mod edge;

pub mod pattern;

pub mod check;

pub mod make;

pub mod draw;

pub mod template;
