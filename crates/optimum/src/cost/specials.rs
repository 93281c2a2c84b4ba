//! Special rungs among many that are priced at once, see [`super::planes`].
//!
//! Along nearly straight stretches there are many between smooth samples, and these are priced side
//! by side, too. Those at corners are priced one by one, unless they certainly are too dear.

use super::planes::{Leaving, is_parallel, is_twisted_above, special_smooth};
use super::strip::{FarEnds, LANES, Lanes, Strip, Wanted};
use super::{Prices, TwistForm, quantised};

impl Prices {
    /// Writes to `strip` those of the rungs from sample `i` that are special; all as
    /// [`TwistForm::Printed`]. Rarely called, and a separate function so as not to slow down the
    /// common case.
    #[inline(never)]
    pub(super) fn special_lanes(
        &self,
        i: usize,
        to: &FarEnds,
        wanted: Wanted,
        special: &[bool; LANES],
        strip: &mut Strip,
    ) {
        let (from, printed) = (self.smooth_end(i), self.options.form == TwistForm::Printed);
        let mut smooth = [false; LANES];
        for n in 0..to.count {
            let j = to.first + n;
            if !(special[n] || printed) || j <= i {
                continue;
            }
            // Most of them run along a straight stretch, or end at a corner and are dear.
            let is_lost = wanted.lanes >> n & 1 == 0
                || is_parallel(from, to.end(n))
                || !printed && self.is_corner_above(i, j, wanted.limit);
            let is_smooth = !self.is_corner(i) && !self.is_corner(j);
            if is_smooth && !is_lost && !printed && self.in_order() {
                smooth[n] = true;
                continue;
            }
            let planes = if is_lost {
                None
            } else if special[n] {
                self.special_planes(i, j)
            } else {
                self.planes(i, j)
            };
            strip.prices[n] = planes.map_or(f64::INFINITY, |planes| self.rung(i, j, &planes));
            for axis in 0..3 {
                strip.means[axis][n] = planes.map_or(0.0, |planes| planes.mean[axis]);
            }
        }
        if smooth != [false; LANES] {
            self.special_smooth_lanes(i, to, &smooth, strip);
        }
    }

    /// Writes to `strip` the special rungs from sample `i` that `which` says, all between smooth
    /// samples.
    fn special_smooth_lanes(
        &self,
        i: usize,
        to: &FarEnds,
        which: &[bool; LANES],
        strip: &mut Strip,
    ) {
        let mut edges = [[[0.0; LANES]; 3]; 2];
        for n in 0..to.count {
            let end = &self.ends[to.first + n];
            for (edge, of) in [end.edge_in, end.edge_out].into_iter().zip(&mut edges) {
                for axis in 0..3 {
                    of[axis][n] = edge[axis];
                }
            }
        }
        let (from, facing) = (self.ends[i].leaving(), self.facing.to_array());
        pulp::Arch::new().dispatch(SpecialSmoothLanes { from, to, edges, facing, which, strip });
    }

    fn is_corner(&self, i: usize) -> bool {
        self.ends[i].is_corner()
    }

    /// Whether the rung from a corner to a smooth sample, or the other way round, certainly costs
    /// more than `limit`.
    pub(super) fn is_corner_above(&self, i: usize, j: usize, limit: f64) -> bool {
        let is_above = |corner: usize, smooth: usize| {
            is_twisted_above(&self.ends[corner], self.smooth_end(smooth), limit)
        };
        match (self.is_corner(i), self.is_corner(j)) {
            (true, false) => is_above(i, j),
            (false, true) => is_above(j, i),
            _ => false,
        }
    }
}

/// Prices special rungs from a smooth sample to smooth ones.
struct SpecialSmoothLanes<'a> {
    from: Leaving,
    to: &'a FarEnds,
    /// Of the far ends, by axis: those that arrive, and those that leave.
    edges: [[Lanes; 3]; 2],
    facing: [f64; 3],
    which: &'a [bool; LANES],
    strip: &'a mut Strip,
}

impl pulp::WithSimd for SpecialSmoothLanes<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { from, to, edges, facing, which, strip } = self;
        let (mut prices, mut means) = ([0.0; LANES], [[0.0; LANES]; 3]);
        for n in 0..LANES {
            let at = |of: &[Lanes; 3]| [of[0][n], of[1][n], of[2][n]];
            let (position, tangent, _) = to.end(n);
            let edges = [at(&edges[0]), at(&edges[1])];
            let rung = special_smooth(&from, &Leaving { position, tangent, edges }, facing);
            prices[n] = if rung.is_lost { f64::INFINITY } else { quantised(rung.twist) };
            for axis in 0..3 {
                means[axis][n] = if rung.is_lost { 0.0 } else { rung.mean[axis] };
            }
        }
        for n in 0..LANES {
            strip.prices[n] = if which[n] { prices[n] } else { strip.prices[n] };
        }
        for axis in 0..3 {
            let of_strip = &mut strip.means[axis];
            for n in 0..LANES {
                of_strip[n] = if which[n] { means[axis][n] } else { of_strip[n] };
            }
        }
    }
}
