//! Numbers that stand side by side.

use crate::cost::{LANES, Lanes};

/// The N of one lane.
#[inline(always)]
pub(super) fn of_lane(means: &[Lanes; 3], n: usize) -> [f64; 3] {
    // Not `means.map`, which takes all lanes by value.
    [means[0][n], means[1][n], means[2][n]]
}

#[inline(always)]
pub(super) fn highest(prices: &Lanes) -> f64 {
    // Written out: `f64::max` also orders NaN, which costs instructions and can't occur.
    reduced(prices, |a, b| if b > a { b } else { a })
}

#[inline(always)]
pub(super) fn lowest(prices: &Lanes) -> f64 {
    reduced(prices, |a, b| if b < a { b } else { a })
}

/// The reduction of all lanes by a function of two.
#[inline(always)]
fn reduced(prices: &Lanes, of_two: impl Fn(f64, f64) -> f64) -> f64 {
    let mut lanes = *prices;
    let mut count = LANES;
    while count > 1 {
        count /= 2;
        for n in 0..count {
            lanes[n] = of_two(lanes[n], lanes[n + count]);
        }
    }
    lanes[0]
}
