//! A supporting plane: where the boundary projects onto a plane without crossing itself, a panel
//! may demand a surface that lies over that plane like a roof over its floor plan.

use super::Boundary;
use crate::math::{Frame, Point2, Point3, Vec3, unit};
use crate::predicate::{first_crossing_of_loops, inside, signed_area_doubled};
use crate::tolerance::Tolerance;
use std::fmt;

/// Which supporting plane a panel demands.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum PlaneChoice {
    /// The plane onto which the outer loop projects with the largest area, if the boundary projects
    /// there without crossing itself, with its holes beside one another inside; else none.
    #[default]
    Auto,
    /// None: any two samples may be joined.
    None,
    /// The plane with this normal.
    Normal(Vec3),
}

/// A plane and the projection of all samples on it. Seen against its normal, the outer loop runs
/// counter-clockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct SupportingPlane {
    /// Where the plane stands; its normal is the frame's third direction.
    pub frame: Frame,
    /// The projected samples, mm, in the frame's first two directions.
    pub projected: Vec<Point2>,
}

/// Why a plane can't support a boundary.
#[derive(Clone, Debug, PartialEq)]
pub enum PlaneError {
    /// The normal has no direction.
    NoDirection,
    /// Projected on the plane, the boundary crosses itself.
    Crossing {
        /// The sample that the first edge begins at, counted through all loops from 0.
        sample: usize,
        /// The sample that the second edge begins at.
        other: usize,
        /// Where the first edge begins, mm.
        near: Point3,
    },
    /// Projected on the plane, a hole lies outside the outer loop, or inside another hole.
    HoleOutside {
        /// Which hole, from 1.
        hole: usize,
    },
}

impl fmt::Display for PlaneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoDirection => write!(f, "the plane's normal has no direction"),
            Self::Crossing { sample, other, near } => {
                write!(f, "seen along the plane's normal, the boundary crosses itself after ")?;
                write!(f, "samples {} and {}, near ", sample + 1, other + 1)?;
                write!(f, "({:.1}, {:.1}, {:.1}) mm", near.x, near.y, near.z)
            }
            Self::HoleOutside { hole } => {
                write!(f, "seen along the plane's normal, hole {hole} lies outside the panel")
            }
        }
    }
}

impl std::error::Error for PlaneError {}

/// The supporting plane of a boundary; `None` where the choice is none, or [`PlaneChoice::Auto`]
/// finds none.
///
/// # Errors
/// A hole of a flat panel lies outside it or in another hole; a chosen normal has no direction, or
/// the boundary projected along it crosses itself or has a hole outside.
pub fn supporting_plane(
    boundary: &Boundary,
    choice: PlaneChoice,
) -> Result<Option<SupportingPlane>, PlaneError> {
    match choice {
        PlaneChoice::None => Ok(None),
        PlaneChoice::Auto => match project(boundary, boundary.area_vector()) {
            Ok(plane) => Ok(Some(plane)),
            // Loops that all lie in one plane are a flat panel, whose holes are inside it.
            Err(error @ PlaneError::HoleOutside { .. }) if is_flat(boundary) => Err(error),
            Err(_) => Ok(None),
        },
        PlaneChoice::Normal(normal) => project(boundary, normal).map(Some),
    }
}

/// Whether all loops lie in the plane of the outer one, to within rounding.
fn is_flat(boundary: &Boundary) -> bool {
    let Some(normal) = unit(boundary.area_vector()) else { return false };
    let origin = boundary.samples()[0].position;
    let off = |s: &crate::curve::Sample| (s.position - origin).dot(normal).abs();
    let within = Tolerance::SAME_POINT.length_mm(boundary.size());
    boundary.samples().iter().all(|s| off(s) <= within)
}

fn project(boundary: &Boundary, normal: Vec3) -> Result<SupportingPlane, PlaneError> {
    // The side of the plane that the loop runs counter-clockwise on.
    let facing = if boundary.area_vector().dot(normal) < 0.0 { -normal } else { normal };
    let origin = boundary.samples()[0].position;
    // `facing` is not normalised here: a vector normalised twice may differ by a bit.
    let frame = Frame::with_normal(origin, facing).ok_or(PlaneError::NoDirection)?;
    let projected: Vec<Point2> =
        boundary.samples().iter().map(|s| frame.project(s.position)).collect();
    let loops = boundary.loops();
    if let Some((sample, other)) = first_crossing_of_loops(&projected, loops) {
        let near = boundary.samples()[sample].position;
        return Err(PlaneError::Crossing { sample, other, near });
    }
    for hole in 1..loops.len() {
        // Loops that do not cross lie wholly inside or outside one another.
        let start = projected[loops[hole].start];
        let within = |of_loop: usize| inside(&projected[loops[of_loop].clone()], start);
        if !within(0) || (1..loops.len()).any(|other| other != hole && within(other)) {
            return Err(PlaneError::HoleOutside { hole });
        }
    }
    debug_assert!(signed_area_doubled(&projected[loops[0].clone()]) > 0.0);
    Ok(SupportingPlane { frame, projected })
}
