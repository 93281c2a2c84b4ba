//! How a person looks at things: what surfaces show, and whose habits turn the view.

use eframe::egui::Key;

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
    /// How much the sheet stretches in its shape.
    Strain,
}

impl SurfaceView {
    /// Every view.
    pub const ALL: [Self; 7] = [
        Self::Shaded,
        Self::Wireframe,
        Self::Rungs,
        Self::Strain,
        Self::Warp,
        Self::LengthError,
        Self::Gauss,
    ];

    /// What people call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Shaded => "Sheet",
            Self::Wireframe => "Wireframe",
            Self::Rungs => "Rungs",
            Self::Warp => "Twist",
            Self::LengthError => "Length error",
            Self::Gauss => "Gauss image",
            Self::Strain => "Strain",
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
            Self::Strain => "Where the sheet stretches in its shape, on which the verdict rests.",
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
            Self::Strain => Key::Num0,
        }
    }
}

/// Whose habits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Navigation {
    /// Ours.
    #[default]
    Sheetwright,
    /// Those of Blender.
    Blender,
    /// Those of SketchUp.
    SketchUp,
    /// Those of Rhino.
    Rhino,
}

impl Navigation {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Sheetwright, Self::Blender, Self::SketchUp, Self::Rhino];

    /// What people call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sheetwright => "Mouse: ours",
            Self::Blender => "Mouse: like Blender",
            Self::SketchUp => "Mouse: like SketchUp",
            Self::Rhino => "Mouse: like Rhino",
        }
    }

    /// How to move, in a sentence.
    pub fn tooltip(self) -> &'static str {
        match self {
            Self::Sheetwright => {
                "Drag beside the handles, or with the right button, to turn. Shift or the middle \
                 button shifts, the wheel zooms."
            }
            Self::Blender => {
                "The middle button turns, with Shift it shifts, with Ctrl or the wheel it zooms."
            }
            Self::SketchUp => "The middle button turns, with Shift it shifts, the wheel zooms.",
            Self::Rhino => {
                "The right button turns, with Shift it shifts, with Ctrl or the wheel it zooms."
            }
        }
    }
}
