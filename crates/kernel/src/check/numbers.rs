//! What kinds of findings tell beyond a number or two.

use crate::design::DivideJoint;

/// How a part was divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Division {
    /// How many pieces there are.
    pub pieces: usize,
    /// How many joints.
    pub joints: usize,
    /// What they are.
    pub joint: DivideJoint,
    /// How far pieces lie over one another, mm, if they do.
    pub lap_mm: Option<f64>,
    /// How long the whole part is, mm.
    pub length_mm: f64,
    /// The room of the largest sheet, its longer side first, mm.
    pub room_mm: [f64; 2],
}

/// A sheet that can't be rolled so tightly.
#[derive(Clone, Debug, PartialEq)]
pub struct TooTight {
    /// The sheet.
    pub sheet: String,
    /// The smallest bend radius that it takes, mm.
    pub limit_mm: f64,
    /// The bend radius of the point, mm.
    pub needed_mm: f64,
}

/// How far a point reaches in which rulings run together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointReach {
    /// Nearer to it, the sheet would be bent to less than the limit, mm.
    pub reach_mm: f64,
    /// The smallest bend radius that the sheet takes, mm.
    pub limit_mm: f64,
    /// Whether the sheet folds, and so creases there.
    pub folds: bool,
}

/// Why a pattern has seams.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeamCause {
    /// In one piece it does not lie flat.
    NotFlat,
    /// It is closed.
    Closed,
    /// These seams were chosen, and no other is needed.
    Chosen,
    /// Cuts let it stretch less.
    Darts,
    /// It is folded between its facets.
    Facets,
}

/// How a panel bends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// The largest warp angle, radians.
    pub warp: f64,
    /// The smallest bend radius, mm; infinite where flat.
    pub radius_mm: f64,
}

/// How a boundary was moved, and the change of warp and twist.
#[derive(Clone, Debug, PartialEq)]
pub struct Movement {
    /// The curves of the panel that moved, by name.
    pub curves: Vec<String>,
    /// The largest distance that a sample was moved, mm.
    pub moved_max_mm: f64,
    /// The sum of the distances of all samples, mm.
    pub moved_total_mm: f64,
    /// The size of the boundary, mm.
    pub size_mm: f64,
    /// The largest warp angle before and after, radians.
    pub warp: [f64; 2],
    /// The total twist before and after, without unit.
    pub twist: [f64; 2],
}

/// What keeps a panel from bending although its warp angles reach the goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hindrance {
    /// The strain, which the warp angle alone does not tell.
    Strain,
    /// Its bend radius.
    Radius,
    /// Something else that was found.
    Other,
}

/// How lines run that divide a panel: between two rails, or inside other closed curves, whose long
/// direction stands for theirs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CutWay {
    /// Straight from one rail to the other, or across the long direction.
    Across,
    /// Along the rails, or straight along the long direction.
    Lengthwise,
}

/// How a mesh is asked to be laid flat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshSetting {
    /// What flattening minimises.
    Aim,
    /// Dividing it along its creases.
    SplitCreases,
    /// Cutting it where it would stretch.
    Darts,
    /// The largest size of its pieces.
    PiecesWithin,
}
