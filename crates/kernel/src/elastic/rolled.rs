//! Sheet metal that is bent beyond yield: it is rolled or formed, and keeps its bend.
//!
//! An elastic sheet resists its bend, and so it stretches where its border is held: by .2 ν t/2R
//! along curved edges, and by .03 to .11 t/2R along straight ones. That grows without end as the
//! radius R falls. Metal does not resist so: once the outer fibre yields, at a strain ε, the moment
//! hardly grows, and is the plastic one in the end, which is 3/2 of that at which it begins to
//! yield. So what a bend t/2R beyond yield takes is 3/2 ε / (t/2R) of the moment of an elastic
//! sheet (the secant modulus of the deformation theory \[Hencky1924\]), and a sheet that resists by
//! this share is computed again. Half a pipe of 100 mm in 3 mm of steel, which every shop rolls,
//! stretches by .24 % as an elastic sheet, twice its limit, and by .08 % so.
//!
//! That is said of smooth developable surfaces alone: theirs are the lengths of the pattern, and
//! all that strains them is this resistance. What a warped surface asks for, no rolling takes
//! away.

use super::{Basis, Predicted};
use crate::material::{EASY_SHARE, Limits};

/// A plate that can't leave its surface is strained by this share of the square of its warp, where
/// held edges keep its lengths.
const WARPED: f64 = 1.0 / 8.0;

/// Whether a surface with this square of the warp, square radians, is so near to a developable one
/// that no sheet, however thick, would take force for its warp.
pub(super) fn is_developable(limits: &Limits, warp_squared: f64) -> bool {
    WARPED * warp_squared <= EASY_SHARE * limits.strain
}

/// Whether it is so near to a developable one that samples may take it for one, or not.
pub(super) fn is_nearly_developable(limits: &Limits, warp_squared: f64) -> bool {
    WARPED * warp_squared <= limits.strain
}

/// The limits of a sheet that yields at this curvature, 1/mm; `None` of one that does not, or that
/// has them already.
fn yielding(limits: &Limits, curvature: f64) -> Option<Limits> {
    let moment_share = limits.plastic_curvature() / curvature;
    (moment_share < limits.moment_share).then(|| Limits { moment_share, ..limits.clone() })
}

/// What is predicted of a sheet whose surface is developable and has this curvature, 1/mm: what is
/// predicted of the `elastic` one or, where that may not take its shape but yields, of one that is
/// rolled, with the limits that `again` gets, if that takes its shape. That its edges curl a little
/// more than the surface, or than the tightest of its narrow bends, counts for nothing.
pub(super) fn rolled(
    elastic: Predicted,
    [curvature, tightest]: [f64; 2],
    again: impl FnOnce(&Limits) -> Option<Predicted>,
) -> Predicted {
    let most = curvature.max(tightest);
    let as_surface = |p: Predicted| Predicted { curvature: p.curvature.min(most), ..p };
    let elastic = as_surface(elastic);
    // What a formula says counts as it is: its range would take in nearly every sheet.
    let is_screen = elastic.basis == Basis::Screen;
    let usage = if is_screen { elastic.usage() } else { elastic.usage_range()[1] };
    if usage <= 1.0 {
        return elastic;
    }
    let rolled = yielding(&elastic.limits, curvature).and_then(|limits| again(&limits));
    rolled.map(as_surface).filter(|rolled| rolled.usage_range()[0] <= 1.0).unwrap_or(elastic)
}
