//! Where along a stretch things stand: holes at a pitch, notches and ticks at shares or lengths.
//!
//! All places are symmetric where they are regular, so that it does not matter from which end two
//! joined edges are looked at. Holes stand denser near the ends: between them lies the share of a
//! whole number of pitches, counted by the pitch that holds at each place.

use crate::design::{Holes, Places};

/// More places than this on one stretch are a slip.
pub(super) const MOST: f64 = 100_000.0;

/// The places of holes along a stretch of this length, mm, as shares of it, in order.
pub(super) fn of_holes(holes: &Holes, length: f64, is_loop: bool) -> Vec<f64> {
    if is_loop {
        let count = (length / holes.pitch).round().clamp(1.0, MOST);
        return (0..count as usize).map(|n| n as f64 / count).collect();
    }
    let [first, last] = [holes.ends, length - holes.ends];
    if last <= first {
        return if length > holes.diameter { vec![0.5] } else { Vec::new() };
    }
    // From the middle outwards: `loose` mm at the pitch of the middle, the rest at that of ends.
    let half = 0.5 * (last - first);
    let dense = (holes.end_length - holes.ends).clamp(0.0, half);
    let loose = half - dense;
    let pitches = loose / holes.pitch + dense / holes.end_pitch;
    let intervals = (2.0 * pitches).round().clamp(1.0, MOST);
    let middle = 0.5 * length;
    let place = |n: usize| {
        let from_middle = n as f64 * 2.0 * pitches / intervals - pitches;
        let counted = from_middle.abs();
        let of_loose = loose / holes.pitch;
        let away = if counted <= of_loose {
            counted * holes.pitch
        } else {
            loose + (counted - of_loose) * holes.end_pitch
        };
        (middle + away.copysign(from_middle)) / length
    };
    (0..=intervals as usize).map(place).collect()
}

/// The places along a stretch of this length, mm, as shares of it, in order. Those beyond its end
/// are left out.
pub(super) fn of_marks(places: &Places, length: f64) -> Vec<f64> {
    let mut shares = match places {
        Places::Shares(shares) => shares.clone(),
        Places::Lengths(lengths) => lengths.iter().map(|at| at / length).collect(),
        Places::Every(pitch) => {
            let half = (0.5 * length / pitch).floor().min(MOST);
            let steps = (0..=2 * half as usize).map(|n| n as f64 - half);
            steps.map(|n| 0.5 + n * pitch / length).collect()
        }
    };
    shares.retain(|share| (0.0..=1.0).contains(share));
    shares.sort_by(f64::total_cmp);
    shares.dedup();
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    fn holes(pitch: f64, end_pitch: f64, end_length: f64) -> Holes {
        Holes { pitch, end_pitch, end_length, ends: 25.0, inset: 10.0, diameter: 2.0 }
    }

    #[test]
    fn holes_are_denser_near_the_ends_and_symmetric() {
        let length = 3000.0;
        let places = of_holes(&holes(150.0, 50.0, 350.0), length, false);
        let mm: Vec<f64> = places.iter().map(|share| share * length).collect();
        assert!((mm[0] - 25.0).abs() < 1e-9 && (mm[mm.len() - 1] - 2975.0).abs() < 1e-9);
        assert!((45.0..55.0).contains(&(mm[1] - mm[0])), "{mm:?}");
        let middle = mm.len() / 2;
        assert!((140.0..160.0).contains(&(mm[middle] - mm[middle - 1])), "{mm:?}");
        for (n, at) in mm.iter().enumerate() {
            assert!((at + mm[mm.len() - 1 - n] - length).abs() < 1e-9);
        }
        let even = of_holes(&holes(100.0, 100.0, 0.0), 1050.0, false);
        assert_eq!(even.len(), 11);
    }

    #[test]
    fn short_and_closed_stretches_have_holes_too() {
        assert_eq!(of_holes(&holes(100.0, 100.0, 0.0), 40.0, false), [0.5]);
        assert_eq!(of_holes(&holes(100.0, 100.0, 0.0), 1.0, false), [0.0; 0]);
        assert_eq!(of_holes(&holes(100.0, 100.0, 0.0), 410.0, true), [0.0, 0.25, 0.5, 0.75]);
    }

    #[test]
    fn marks_stand_at_shares_and_lengths() {
        assert_eq!(of_marks(&Places::Shares(vec![0.5, 0.25, 0.5]), 8.0), [0.25, 0.5]);
        assert_eq!(of_marks(&Places::Lengths(vec![2.0, 9.0]), 8.0), [0.25]);
        assert_eq!(of_marks(&Places::Every(3.0), 8.0), [0.125, 0.5, 0.875]);
    }
}
