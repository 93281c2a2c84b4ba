//! How a design is drawn: settings of the editor, which change no output.

use crate::units::Units;
use sheetwright::math::{Point2, Point3, Vec3};
use std::sync::Arc;

/// How the editor draws a design. Nothing in it changes an output.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// The unit of displayed lengths, and of a typed number without a unit.
    pub units: Units,
    /// The plane that the plan shows.
    pub plan: Plan,
    /// The line of symmetry in the plan; `None` without symmetry.
    pub mirror: Option<Mirror>,
    /// The distance of the lines of the grid, mm.
    pub grid_mm: f64,
    /// Whether points snap to the grid.
    pub snap_to_grid: bool,
    /// A picture under the plan, to trace.
    pub reference: Option<Reference>,
}

/// Which plane the plan shows. Handles move in it on the left and across it on the right.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Plan {
    /// Seen from above: x to the right, y upwards; across it is z.
    #[default]
    Top,
    /// Seen from the front: x to the right, z upwards; across it is −y.
    Front,
    /// Seen from the right side: y to the right, z upwards; across it is x.
    Side,
}

impl Plan {
    /// Every plane.
    pub const ALL: [Self; 3] = [Self::Top, Self::Front, Self::Side];

    /// Its name in the editor; in files it is in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Top => "Top",
            Self::Front => "Front",
            Self::Side => "Side",
        }
    }

    /// Where a point lies in the plan, mm.
    pub fn flat(self, p: Point3) -> Point2 {
        match self {
            Self::Top => Point2::new(p.x, p.y),
            Self::Front => Point2::new(p.x, p.z),
            Self::Side => Point2::new(p.y, p.z),
        }
    }

    /// The height of a point above the plan, mm, positive towards the viewer.
    pub fn lift(self, p: Point3) -> f64 {
        match self {
            Self::Top => p.z,
            Self::Front => -p.y,
            Self::Side => p.x,
        }
    }

    /// The point in space at a place of the plan and a height above it, mm.
    pub fn space(self, at: Point2, lift: f64) -> Point3 {
        match self {
            Self::Top => Point3::new(at.x, at.y, lift),
            Self::Front => Point3::new(at.x, -lift, at.y),
            Self::Side => Point3::new(lift, at.x, at.y),
        }
    }

    /// The unit normal of the plan, towards the viewer.
    pub fn normal(self) -> Vec3 {
        match self {
            Self::Top => Vec3::new(0.0, 0.0, 1.0),
            Self::Front => Vec3::new(0.0, -1.0, 0.0),
            Self::Side => Vec3::new(1.0, 0.0, 0.0),
        }
    }
}

/// A line of symmetry in the plan: the editor draws everything on both sides of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror {
    /// Whether the line runs upwards on the plan and mirrors left and right; else it runs to the
    /// right and mirrors above and below.
    pub upright: bool,
    /// Its coordinate on the axis that it crosses, mm.
    pub at_mm: f64,
}

impl Mirror {
    /// The mirror image of a place of the plan, mm.
    pub fn image(self, p: Point2) -> Point2 {
        if self.upright {
            Point2::new(2.0 * self.at_mm - p.x, p.y)
        } else {
            Point2::new(p.x, 2.0 * self.at_mm - p.y)
        }
    }
}

/// A picture to trace: a photograph or a scan of a plan, true to scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// The name of the file that it came from.
    pub name: String,
    /// The bytes of that file, PNG or JPEG.
    pub bytes: Arc<[u8]>,
    /// Where the middle of the picture lies on the plan, mm.
    pub centre: Point2,
    /// The size of a pixel, mm.
    pub mm_per_pixel: f64,
    /// Its opacity, 0 ..= 1; 0 is invisible.
    pub opacity: f64,
}

impl Drawing {
    /// An empty drawing in these units, with a grid that is round in them.
    pub fn in_units(units: Units) -> Self {
        let usual = Self::default();
        Self { units, grid_mm: units.round_step_mm(usual.grid_mm), ..usual }
    }
}

impl Default for Drawing {
    fn default() -> Self {
        Self {
            units: Units::Millimetres,
            plan: Plan::Top,
            mirror: None,
            grid_mm: 50.0,
            snap_to_grid: false,
            reference: None,
        }
    }
}
