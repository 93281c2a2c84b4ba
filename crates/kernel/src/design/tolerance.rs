//! How finely panels are sampled: by a number, or by how near the polygon through the samples stays
//! to the curves.

use super::{DesignPanel, PanelShape};

/// The fewest samples of each rail of a panel with the usual tolerance: a ruling every half per
/// cent of the length, finer than hands can mark, in well under a second.
pub const RAIL_SAMPLES: usize = 200;
/// The fewest samples of an outer loop with the usual tolerance: as many as two rails have.
pub const LOOP_SAMPLES: usize = 400;
/// The fewest samples of each rail with a tolerance of its own: still enough to measure how a sheet
/// bends to some per cent.
pub const FEWEST_ON_RAIL: usize = 50;
/// The fewest samples of an outer loop with a tolerance of its own: as many as two rails have.
pub const FEWEST_ON_LOOP: usize = 100;
/// The most samples that a tolerance of its own gives, of each rail and of an outer loop: ten times
/// as many as the usual ones, some seconds a panel.
pub const MOST_BY_TOLERANCE: [usize; 2] = [2_000, 4_000];
/// The most samples that the usual tolerance gives: twice as many as the fewest, about twice the
/// time.
pub const MOST_USUAL: [usize; 2] = [2 * RAIL_SAMPLES, 2 * LOOP_SAMPLES];

/// How near the polygon through the samples of a panel stays to its curves. It bounds two lengths:
/// the largest distance of a curve from the polygon, and the length by which the polygon is shorter
/// than the curve along one edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SampleTolerance {
    /// Both are at most this length, mm, in all loops.
    Mm(f64),
    /// Both are at most this share of the size of the outer loop, in the outer loop.
    Share(f64),
}

impl SampleTolerance {
    /// That of a panel for which nothing is said: 0.1 mm on a metre, less than a hand cuts.
    pub const USUAL: Self = Self::Share(1e-4);

    /// The length, mm, for an outer loop of this size.
    pub fn mm(self, size_mm: f64) -> f64 {
        match self {
            Self::Mm(mm) => mm,
            Self::Share(share) => share * size_mm,
        }
    }
}

impl DesignPanel {
    /// A panel with the defaults of [`DesignPanel::new`] and as many samples as the usual tolerance
    /// takes; a mesh has none.
    pub fn usual(name: impl Into<String>, shape: PanelShape) -> Self {
        let samples = usual_samples(&shape);
        let tolerance = (samples > 0).then_some(SampleTolerance::USUAL);
        Self { tolerance, ..Self::new(name, shape, samples) }
    }

    /// The panel with as many samples as keep both lengths within this one, mm.
    #[must_use]
    pub fn within_mm(self, mm: f64) -> Self {
        let samples = match &self.shape {
            PanelShape::Rails(_) => FEWEST_ON_RAIL,
            _ => FEWEST_ON_LOOP,
        };
        Self { samples, tolerance: Some(SampleTolerance::Mm(mm)), ..self }
    }

    /// The most samples that its tolerance gives it.
    pub(crate) fn most_by_tolerance(&self) -> usize {
        let [of_rail, of_loop] = match self.tolerance {
            Some(SampleTolerance::Share(_)) => MOST_USUAL,
            _ => MOST_BY_TOLERANCE,
        };
        if matches!(self.shape, PanelShape::Rails(_)) { of_rail } else { of_loop }
    }
}

/// The fewest samples of a panel of this shape with the usual tolerance; of a mesh, none.
fn usual_samples(shape: &PanelShape) -> usize {
    match shape {
        PanelShape::Rails(_) => RAIL_SAMPLES,
        PanelShape::Loops { .. } | PanelShape::Join(_) => LOOP_SAMPLES,
        PanelShape::Mesh(_) => 0,
    }
}
