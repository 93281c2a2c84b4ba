//! A mesh as it is cut and laid flat.

use crate::flatten::Relaxed;
use crate::measure::Distortion;
use crate::sheet::Sheet;

/// A sheet, laid flat.
pub(super) struct Laid {
    pub(super) sheet: Sheet,
    pub(super) relaxed: Relaxed,
    pub(super) distortion: Distortion,
}
