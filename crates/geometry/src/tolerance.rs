//! A tolerance: positive by type, and relative to the size of the model.

/// The smallest size of a model, mm (a nanometre): below it, coordinates have no digits left.
/// Boundaries and meshes are refused below it, and parts of a mesh are left out.
pub const MIN_SIZE_MM: f64 = 1e-6;

/// A positive, finite share of the size of a model, without unit.
///
/// Tolerances measure (is this close enough to show, to merge, to stop?); they never decide
/// topology, which is for the exact tests of [`crate::predicate`].
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Tolerance(f64);

impl Tolerance {
    /// Samples nearer than this share of the size count as one: coordinates of about 16 digits
    /// that went through a file and a spline agree to some 12 of them.
    pub const SAME_POINT: Self = Self(1e-12);
    /// End points of curves that are chained, nearer than this share of the size, are the same
    /// point: people type six digits or more.
    pub const CHAIN: Self = Self(1e-6);
    /// A written pattern that folds back onto its surface within this share of the size is right.
    pub const REFOLD: Self = Self(1e-6);
    /// Points of a mesh within this share of its size lie in one place, if the triangles there are
    /// ten times as large: six digits, as many programs write them, are off by up to 5e-6 of a
    /// number, and both of two points are. (In a metre, a hundredth of a millimetre: no shop cuts a
    /// slot as narrow.)
    pub const JOINED: Self = Self(1e-5);
    /// A triangle of a mesh that is lower than this share of the size of the mesh, and tapers to
    /// both ends, only fills the line along its longest side: coordinates of 32 bits are off by
    /// 6e-8 of the size, so that the normal of such a triangle has one digit.
    pub const FILLER: Self = Self(1e-6);

    /// Sides of a cut this near to one another on the pattern, as a share of the size, meet up to
    /// rounding: lengths are exact to some 13 digits, and their errors add up along the way round.
    pub const ROUNDING: Self = Self(1e-9);
    /// A cut that gapes by more than this share of the size is a seam; one that gapes by less may
    /// be one round a window, and is closed if little stretching does it. (Of an elliptic window in
    /// a cylinder, the gap is 6e-5 with 100 samples on the outline, and 2e-6 with 400.)
    pub const CLOSING: Self = Self(1e-2);
    /// Lengths are changed by no more than this share to close a cut: a tenth of a millimetre in a
    /// metre is finer than any shop cuts. (Those windows need 2e-6 and 5e-9.)
    pub const STRETCH: Self = Self(1e-4);
    /// Lengths are changed by up to this share to close a cut where the pattern would otherwise
    /// overlap itself and could not be cut at all: a sheet stretches by a millimetre in a metre
    /// without being bent out of shape.
    pub const MOST_STRETCH: Self = Self(1e-3);

    /// A tolerance of `share` of the size; `None` unless it is positive and finite.
    pub fn new(share: f64) -> Option<Self> {
        (share > 0.0 && share.is_finite()).then_some(Self(share))
    }

    /// The share.
    pub fn share(self) -> f64 {
        self.0
    }

    /// This tolerance as a length, mm, for a model of `size_mm`.
    pub fn length_mm(self, size_mm: f64) -> f64 {
        self.0 * size_mm
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_positive_shares_are_tolerances() {
        assert!(Tolerance::new(0.0).is_none());
        assert!(Tolerance::new(-1.0).is_none());
        assert!(Tolerance::new(f64::NAN).is_none());
        assert_eq!(Tolerance::new(1e-3).unwrap().length_mm(2000.0), 2.0);
    }
}
