//! By which angles a part may be turned on a sheet.

use super::shape::Shape;
use sheetwright_geometry::random::Random;
use std::f64::consts::{FRAC_PI_2, TAU};

/// By which angles a part may be turned, from the grain of the sheet, and whether it may be turned
/// over.
#[derive(Clone, Debug, PartialEq)]
pub struct Turns {
    /// The angles, radians, from 0 to 2π; empty: any. A part that is turned over, top to bottom, is
    /// turned by them the other way round, so that what lay along the grain still does.
    pub angles: Vec<f64>,
    /// By how much it may lie off them, radians.
    pub tolerance: f64,
    /// Whether it may be turned over.
    pub may_turn_over: bool,
}

impl Turns {
    /// Any angle, never turned over.
    pub const FREE: Self = Self { angles: Vec::new(), tolerance: 0.0, may_turn_over: false };

    /// Whether small turns may help.
    pub(super) fn wiggles(&self) -> bool {
        self.angles.is_empty() || self.tolerance > 0.0
    }

    /// An allowed angle, and whether it is turned over. Where any angle is allowed, half of them
    /// lay a long side of the form along a side of the sheet.
    pub(super) fn any(&self, shape: &Shape, random: &mut Random) -> (f64, bool) {
        let is_over = self.may_turn_over && random.below(2) == 1;
        let turn = if !self.angles.is_empty() {
            let angle = self.angles[random.below(self.angles.len())];
            let off = match self.tolerance {
                0.0 => 0.0,
                most => random.between(-most, most),
            };
            if is_over { -angle + off } else { angle + off }
        } else if random.below(2) == 0 && !shape.upright.is_empty() {
            let upright = shape.upright[random.below(shape.upright.len())];
            let upright = if is_over { -upright } else { upright };
            upright + FRAC_PI_2 * random.below(4) as f64
        } else {
            random.between(0.0, TAU)
        };
        (turn, is_over)
    }

    /// The angle that is allowed when one that is allowed is changed a little.
    pub(super) fn kept(&self, turn: f64, is_over: bool, by: f64) -> f64 {
        if by == 0.0 || self.angles.is_empty() {
            return turn + by;
        }
        let off = self.off(turn, is_over);
        turn + (off + by).clamp(-self.tolerance, self.tolerance) - off
    }

    /// How far a turn lies from the nearest of the angles, radians; 0 where there are none.
    pub(super) fn off(&self, turn: f64, is_over: bool) -> f64 {
        let off = |angle: &f64| {
            let off = (if is_over { turn + angle } else { turn - angle }) / TAU;
            (off - off.round()) * TAU
        };
        let all = self.angles.iter().map(off);
        all.min_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0)
    }
}
