//! From the path of a hand, noisy and unevenly spaced, to the few points of a cubic curve.
//!
//! The paper that this program grew from records the paths of a brush or a mouse, simplifies them
//! by the method of Douglas and Peucker \[DouglasPeucker1973\] and approximates them by a cubic
//! B-spline within L/100, L being the length of the stroke. Here the curve is the interpolating
//! spline of `CurveKind::Spline`. It is piecewise cubic and twice differentiable, so it *is* a
//! cubic B-spline with its knots at its handles. It is given by the points it runs through instead
//! of its control points, so handles lie on the curve, where a hand looks for them. In steps:
//!
//! 1. Points on one spot are merged; a stroke no larger than a click is refused (`path`).
//! 2. Where the ends meet, or the end runs past the beginning, the stroke is closed: the excess is
//!    cut off and a gap is drawn together (`closing`).
//! 3. A corner is a place where the hand turns sharply within a short length, and no less sharply
//!    within half of it; a bend turns by half there (`corners`).
//! 4. Between corners, points are removed after Douglas and Peucker while the stroke stays within
//!    L/100. Where none is left between two corners, the side is straight.
//! 5. Elsewhere the fewest handles are placed that bring curve and stroke within L/100 of one
//!    another, by least squares, which smooth the jitter of a hand instead of following it
//!    (`fit`).

mod closing;
mod corners;
mod fit;
mod path;
mod squares;

use path::Path;
use sheetwright_geometry::math::Point2;
use std::fmt;

/// How a stroke becomes a curve. Shares are of the length L of the stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrokeOptions {
    /// The largest distance of the curve from the stroke, as a share of L: 0.01, as in the paper.
    pub tolerance_share: f64,
    /// The least turn that makes a corner, degrees: 40, less than in an octagon and more than in a
    /// bend of an oval.
    pub corner_deg: f64,
    /// The share of L within which the ends of a stroke count as meeting: 0.04.
    pub close_share: f64,
    /// A stroke that extends no farther than this is a click, mm: 1.
    pub smallest_mm: f64,
    /// The resolution of the pointer, mm: the size of a pixel in the plan. 0: unknown.
    pub grain_mm: f64,
}

impl Default for StrokeOptions {
    fn default() -> Self {
        Self {
            tolerance_share: 0.01,
            corner_deg: 40.0,
            close_share: 0.04,
            smallest_mm: 1.0,
            grain_mm: 0.0,
        }
    }
}

/// A point that the curve of a stroke runs through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrokePoint {
    /// Its position in the plan, mm.
    pub at: Point2,
    /// Whether the hand made a corner here. The ends of an open curve are none.
    pub corner: bool,
}

/// A stroke as the points of an interpolating cubic spline.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// The points, in the order that the hand drew them.
    pub points: Vec<StrokePoint>,
    /// Whether the curve ends where it begins.
    pub closed: bool,
    /// The largest distance between curve and stroke, in both directions, mm; from the stroke after
    /// it was closed. It exceeds the tolerance only where a stroke is so wild that [`MOST_POINTS`]
    /// points don't follow it.
    pub off_mm: f64,
    /// The length L of the stroke, mm.
    pub length_mm: f64,
}

/// Limit of the points of a stroke.
pub const MOST_POINTS: usize = 64;

/// Why a stroke is no curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StrokeError {
    /// A coordinate that is no finite number, or beyond
    /// [`MAX_COORDINATE_MM`](sheetwright_geometry::curve::MAX_COORDINATE_MM).
    OutOfRange {
        /// The position, counted from 0.
        position: usize,
    },
    /// It extends no farther than a click.
    Click {
        /// Its extent, mm.
        extent_mm: f64,
        /// The least extent of a stroke, mm.
        smallest_mm: f64,
    },
    /// It runs back over itself, so no curve follows it.
    NoCurve,
}

impl fmt::Display for StrokeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange { position } => write!(
                f,
                "position {} of the stroke has a coordinate that is not a number within ±1e9 mm",
                position + 1
            ),
            Self::Click { extent_mm, smallest_mm } => write!(
                f,
                "the stroke is only {extent_mm:.1} mm long, which is a click; drag for more than \
                 {smallest_mm:.1} mm to draw a curve"
            ),
            Self::NoCurve => {
                write!(f, "the stroke runs back over itself so that no curve follows it")
            }
        }
    }
}

impl std::error::Error for StrokeError {}

/// The curve of a stroke, from the positions of the pointer in the plan, mm.
///
/// # Errors
/// Coordinates that are no numbers, and a stroke that is only a click.
pub fn stroke(positions: &[Point2], options: &StrokeOptions) -> Result<Stroke, StrokeError> {
    let drawn = path::cleaned(positions, options.smallest_mm)?;
    let closing = closing::closing(&drawn, options.close_share);
    let closed = closing.is_some();
    let drawn = Path::new(closing.unwrap_or(drawn), closed);
    let tolerance_mm = options.tolerance_share * drawn.length();
    let even = drawn.even(corners::EVEN);
    let corners = corners::corners(&drawn, &even, options);
    let fitted = fit::fit(&drawn, &even, &corners, tolerance_mm).ok_or(StrokeError::NoCurve)?;
    Ok(Stroke { points: fitted.points, closed, off_mm: fitted.off_mm, length_mm: drawn.length() })
}
