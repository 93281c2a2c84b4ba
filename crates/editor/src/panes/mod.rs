//! The panes: the plan on the left, space on the right, and the flat pattern.

mod dashes;
mod lit;
pub mod pattern;
pub mod plan;
pub mod space;

use eframe::egui::{Key, Vec2};

/// A pane that grew or shrank by less, as a share of its size, looks the same: so bars may come and
/// go.
const SAME_SIZE: f32 = 0.06;

/// Whether a pane has another size than it had.
fn is_resized(from: Vec2, to: Vec2) -> bool {
    let differs = |from: f32, to: f32| (to - from).abs() > SAME_SIZE * from;
    differs(from.x, to.x) || differs(from.y, to.y)
}

/// How surfaces look.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SurfaceView {
    /// As a lit sheet.
    #[default]
    Shaded,
    /// The sides of the triangles alone.
    Wireframe,
    /// A lit sheet with its rungs.
    Rungs,
    /// How far the sheet twists along its rungs.
    Warp,
    /// How much flattening changes lengths.
    LengthError,
    /// The normals of the sheet on a sphere.
    Gauss,
}

impl SurfaceView {
    /// Every view.
    pub const ALL: [Self; 6] =
        [Self::Shaded, Self::Wireframe, Self::Rungs, Self::Warp, Self::LengthError, Self::Gauss];

    /// What people call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Shaded => "Sheet",
            Self::Wireframe => "Wireframe",
            Self::Rungs => "Rungs",
            Self::Warp => "Twist",
            Self::LengthError => "Length error",
            Self::Gauss => "Gauss image",
        }
    }

    /// What it shows, in a sentence.
    pub fn tooltip(self) -> &'static str {
        match self {
            Self::Shaded => "The sheet as it will look.",
            Self::Wireframe => "The triangles that the sheet is made of.",
            Self::Rungs => "The straight lines across the sheet.",
            Self::Warp => "Where the sheet twists, in degrees.",
            Self::LengthError => "Where the pattern is longer or shorter than the sheet.",
            Self::Gauss => {
                "The directions that the sheet faces, on a sphere: a line if it bends freely."
            }
        }
    }

    /// Its key.
    pub fn key(self) -> Key {
        match self {
            Self::Shaded => Key::Num1,
            Self::Wireframe => Key::Num2,
            Self::Rungs => Key::Num3,
            Self::Warp => Key::Num4,
            Self::LengthError => Key::Num5,
            Self::Gauss => Key::Num6,
        }
    }
}
