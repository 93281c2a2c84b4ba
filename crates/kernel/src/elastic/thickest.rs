//! The thickest sheet of a kind that takes a shape.
//!
//! Each thickness is judged as a run in it begins: on the first net, where that run stops if the
//! sheet takes the shape clearly. Thicknesses have two digits, so that the one that is named is one
//! that was judged.

/// Between the last two, so many sheets are judged: the thinnest that is known to refuse is then
/// thicker by less than a fifth, but for the digits.
const MIDDLES: usize = 2;
/// Lengths are rounded to so many decimals less one at the most.
const MOST_DECIMALS: usize = 9;

/// The thickest sheet that is found to take the shape, mm, thinner than one of `whole_mm`, which
/// does not; `None` where no sheet does. The thickness is halved up to so many times until one
/// takes it, and then made larger again.
pub(super) fn thickest_mm(
    whole_mm: f64,
    halvings: usize,
    mut takes: impl FnMut(f64) -> bool,
) -> Option<f64> {
    let mut refuses_mm = whole_mm;
    for _ in 0..halvings {
        let half_mm = in_two_digits(0.5 * refuses_mm);
        if !takes(half_mm) {
            refuses_mm = half_mm;
            continue;
        }
        let mut takes_mm = half_mm;
        for _ in 0..MIDDLES {
            let middle_mm = in_two_digits((takes_mm * refuses_mm).sqrt());
            if middle_mm > takes_mm && takes(middle_mm) {
                takes_mm = middle_mm;
            } else {
                refuses_mm = middle_mm;
            }
        }
        return Some(takes_mm);
    }
    None
}

/// A length in two digits, rounded down, mm; whole millimetres from 100 on.
fn in_two_digits(mm: f64) -> f64 {
    let scales = std::iter::successors(Some(1.0), |scale| Some(scale * 10.0));
    let scale = scales.take(MOST_DECIMALS).find(|scale| mm * scale >= 10.0);
    scale.map_or(mm, |scale: f64| (mm * scale * (1.0 + 1e-12)).floor() / scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_thickest_is_one_that_was_judged_and_the_next_is_thicker_by_a_fifth_at_most() {
        for most_mm in [4.9, 2.6, 1.3, 0.7, 0.081] {
            let mut judged = Vec::new();
            let found = thickest_mm(5.0, 6, |mm| {
                judged.push((mm, mm <= most_mm));
                mm <= most_mm
            });
            let Some(found) = found else { panic!("{most_mm}") };
            assert!(judged.contains(&(found, true)), "{most_mm}: {judged:?}");
            assert!(found <= most_mm && most_mm < 1.25 * found, "{most_mm}: {found}");
            assert!(judged.len() <= 8, "{judged:?}");
        }
        assert_eq!(thickest_mm(5.0, 3, |mm| mm < 0.5), None);
    }

    #[test]
    fn lengths_are_rounded_down_to_two_digits() {
        for (mm, wanted) in [(0.25, 0.25), (0.707, 0.7), (1.25, 1.2), (99.9, 99.0), (123.4, 123.0)]
        {
            assert_eq!(in_two_digits(mm), wanted);
        }
    }
}
