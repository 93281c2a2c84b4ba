//! How much of it all a window has room for. A phone has little, and no more has a small screen
//! with text at 200 %.

use eframe::egui::{Key, Vec2};

/// A window that is narrower than this, in points, has no room for all panes beside one another.
const WIDE: f32 = 900.0;
/// And one that is lower has none for space and the pattern below one another.
const HIGH: f32 = 480.0;
/// A window that is narrower than this has no room for a pane beside the answer.
const NARROW: f32 = 600.0;

/// How much room there is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Room {
    /// For everything.
    #[default]
    All,
    /// For one pane, and the answer beside it.
    Two,
    /// For one of them.
    One,
}

impl Room {
    /// In a window of this size, in points.
    pub fn of(size: Vec2) -> Self {
        if size.x >= WIDE && size.y >= HIGH {
            Self::All
        } else if size.x >= NARROW {
            Self::Two
        } else {
            Self::One
        }
    }
}

/// A part of the window; one or two are seen where there is no room for all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WindowPart {
    /// The plan.
    #[default]
    Plan,
    /// Space.
    Space,
    /// The flat pattern.
    Pattern,
    /// Will it bend, and the typed values.
    Answer,
}

impl WindowPart {
    /// Every part.
    pub const ALL: [Self; 4] = [Self::Plan, Self::Space, Self::Pattern, Self::Answer];

    /// Its title.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plan => "Plan",
            Self::Space => "Space",
            Self::Pattern => "Pattern",
            Self::Answer => "Will it bend?",
        }
    }

    /// Its key, with Shift.
    pub fn key(self) -> Key {
        match self {
            Self::Plan => Key::D,
            Self::Space => Key::S,
            Self::Pattern => Key::P,
            Self::Answer => Key::A,
        }
    }
}

/// What is smaller is of no use, points.
const LEAST: f32 = 40.0;

/// As long as it is wanted, or as there is room, in points; but never nothing, however small a
/// window is.
pub(crate) fn fitting(wanted: f32, room: f32) -> f32 {
    wanted.min(room).max(LEAST)
}
