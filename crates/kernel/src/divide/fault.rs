//! Why a part can't be divided.

/// Why a part that is larger than every sheet is not divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DivideFault {
    /// Its joints are counted in thicknesses, and the thickness of the sheet is not known.
    NoThickness,
    /// Its pattern is cut open along seams, whose sides must stay together.
    Seams,
    /// No straight lines divide it so that all pieces fit a sheet.
    NoPlace,
    /// A piece would hang together in a point alone.
    Pinched,
    /// A piece would be no valid surface: so thin that its edges touch.
    TooThin,
}
