//! Whether a boundary is developable already, as far as its samples tell.
//!
//! Rungs end at samples and not where rulings would, so even on a perfect cylinder they have warp
//! angles: up to the bend from one sample to the next, which spans two rungs. The signs of creases
//! separate bending from twist: creases of a bend have one sign, while those of a twisted strip
//! alternate, since each triangle lies in the tangent plane at its own edge. So the sum of the
//! creases of one triangle is bending, and the part that cancels is twist.

use super::state::PanelState;
use crate::measure::{RungMeasures, rung_measures};
use crate::surface::{Connectivity, Surface};
use sheetwright_optimum::cost::{PriceOptions, Prices};

/// By which factor a warp angle may exceed the bend from one sample to the next: samples of the two
/// sides need not lie opposite one another.
const MARGIN: f64 = 2.0;
/// Warp angles below it, radians, are rounding: far below what a sheet shows.
const NO_WARP: f64 = 1e-6;

/// Whether the sampling explains every warp angle of a panel.
pub(super) fn explains(panel: &PanelState) -> bool {
    let triangles = panel.triangulation.triangles.clone();
    let Ok(connectivity) = Connectivity::new(panel.boundary.loops(), triangles) else {
        return false;
    };
    let surface = Surface::new(connectivity, panel.boundary.positions());
    let prices = Prices::new(&panel.boundary, panel.plane.as_ref(), PriceOptions::default());
    let rungs = rung_measures(&surface, &prices);
    let bend = |rung: &RungMeasures| if rung.is_fold { 0.0 } else { rung.crease };
    let mut beside = vec![0.0f64; rungs.len()];
    let mut at_sample = vec![0.0f64; panel.boundary.len()];
    let mut note = |bend: f64, numbers: &[usize]| {
        for &n in numbers {
            beside[n] = beside[n].max(bend.abs());
            for sample in rungs[n].rung.ends() {
                let most = &mut at_sample[sample.get()];
                *most = most.max(bend.abs());
            }
        }
    };
    for numbers in surface.connectivity().hinges_of_triangles() {
        note(numbers.iter().map(|&n| bend(&rungs[n])).sum(), &numbers);
    }
    rungs.iter().enumerate().all(|(n, rung)| {
        let ends = rung.rung.ends().map(|sample| at_sample[sample.get()]);
        let explained = (MARGIN * beside[n]).max(ends[0].max(ends[1]));
        // Nor may it exceed the allowance of the verdict.
        rung.warp <= explained.min(rung.resolution).max(NO_WARP)
    })
}
