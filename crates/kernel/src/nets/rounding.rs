//! How far rounding may have moved the points of a mesh.
//!
//! Programs write coordinates with three to seven digits. Points of one plane then lie beside it by
//! up to half of the last digit in each coordinate, and a narrow triangle of a flat face turns by
//! degrees. The step of those numbers, one of the last digit, is found again from the points
//! themselves, in whatever unit and size they are by now: every difference of two coordinates is a
//! multiple of it, so it is their greatest common divisor, which Euclid's algorithm finds of
//! lengths as of whole numbers. The floating-point noise of the remainders is 1e-16 of the size
//! times the multiples, which are a hundred thousand at most where the step matters, so it stays
//! far below the step. Numbers with as many digits as fit have no such step, and those of six
//! significant digits, the usual ones of C++, none that is the same for large and small ones; for
//! both, [`SIX_DIGITS`] counts, within which points are one in healing, too.

use sheetwright_geometry::math::{Point3, Vec3};

/// The least rounding that counts, as a share of the size.
const SIX_DIGITS: f64 = 1e-5;
/// A step that is larger, as a share of the size, was chosen: such numbers are not rounded. Three
/// decimals are less where the size is above 1.
const LARGEST_STEP: f64 = 1e-3;
/// A step that is smaller, as a share of the size, is hidden by [`SIX_DIGITS`].
const LEAST_STEP: f64 = 5e-6;
/// Remainders up to this share of the size are noise.
const NOISE: f64 = 1e-8;
/// Where no step tells it, rounding counts up to this share of the height of a triangle, as it does
/// in healing: the size may be that of one point far away.
const MOST_OF_HEIGHT: f64 = 0.1;
/// Points count as in one plane up to this multiple of half a step: the plane through rounded
/// points is not quite that of the true ones.
const MARGIN: f64 = 1.1;

/// The rounding of the coordinates of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rounding {
    /// The least distance that counts, mm.
    least_mm: f64,
    /// The step of its numbers, mm; 0 where they are not rounded as far as is seen.
    step_mm: f64,
}

impl Rounding {
    /// The rounding of these points, which are so large together, mm.
    pub(super) fn of(positions: &[Point3], size_mm: f64) -> Self {
        let step = step(positions, size_mm).filter(|&step| step <= LARGEST_STEP * size_mm);
        Self { least_mm: SIX_DIGITS * size_mm, step_mm: step.unwrap_or(0.0) }
    }

    /// The distance between two points that rounding explains, mm.
    pub(super) fn between_mm(&self) -> f64 {
        // Each is off by half a step in each coordinate, along a diagonal at most.
        self.least_mm.max(MARGIN * 3.0_f64.sqrt() * self.step_mm)
    }

    /// The distance from a plane of this unit normal that rounding explains at a triangle of this
    /// least height, mm.
    pub(super) fn off_plane_mm(&self, normal: Vec3, height_mm: f64) -> f64 {
        let sum = normal.x.abs() + normal.y.abs() + normal.z.abs();
        let least_mm = self.least_mm.min(MOST_OF_HEIGHT * height_mm);
        least_mm.max(MARGIN * 0.5 * self.step_mm * sum)
    }
}

/// The largest length of which all differences between coordinates are multiples, mm; `None` where
/// it is less than [`LEAST_STEP`].
fn step(positions: &[Point3], size_mm: f64) -> Option<f64> {
    let first = *positions.first()?;
    let differences = |p: &Point3| [p.x - first.x, p.y - first.y, p.z - first.z].map(f64::abs);
    let largest = positions.iter().flat_map(differences).fold(0.0, f64::max);
    let (noise, least) = (NOISE * size_mm, LEAST_STEP * size_mm);
    let mut step = largest;
    for length in positions.iter().flat_map(differences) {
        let (mut a, mut b) = (step, remainder(length, step));
        while b > noise {
            if b < least {
                return None;
            }
            (a, b) = (b, remainder(a, b));
        }
        // The largest difference tells the step best.
        step = largest / (largest / a).round();
    }
    (step >= least).then_some(step)
}

/// How far a length is from the nearest multiple of another.
fn remainder(length: f64, of: f64) -> f64 {
    (length - of * (length / of).round()).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_geometry::random::Random;

    /// Points in a box of this size whose numbers are rounded to multiples of a step, then scaled.
    fn points(count: usize, size: f64, step: f64, factor: f64) -> Vec<Point3> {
        let mut random = Random::new(7);
        let mut number = || {
            let exact = size * (random.unit() - 0.5);
            let rounded = if step > 0.0 { (exact / step).round() * step } else { exact };
            rounded * factor
        };
        (0..count).map(|_| Point3::new(number(), number(), number())).collect()
    }

    #[test]
    fn the_step_of_rounded_numbers_is_found_in_any_unit() {
        for (size, step_given) in [(2.0, 1e-3), (3.2, 1e-4), (300.0, 1e-2), (5000.0, 0.1)] {
            for factor in [1.0, 25.4, 304.8, 0.731_234_567_8] {
                let points = points(40, size, step_given, factor);
                let found = step(&points, size * factor).unwrap();
                assert!((found / (step_given * factor) - 1.0).abs() < 1e-6, "{size} {found}");
            }
        }
    }

    #[test]
    fn numbers_of_all_digits_and_chosen_ones_are_not_rounded() {
        assert_eq!(step(&points(40, 2.0, 0.0, 1.0), 2.0), None);
        // Rounded to floats: no step that counts.
        let floats = points(40, 2.0, 0.0, 1.0);
        let float = |x: f64| f64::from(x as f32);
        let floats: Vec<Point3> =
            floats.iter().map(|p| Point3::new(float(p.x), float(p.y), float(p.z))).collect();
        assert_eq!(step(&floats, 2.0), None);
        // A design in whole centimetres.
        let chosen = Rounding::of(&points(40, 500.0, 10.0, 1.0), 500.0);
        assert_eq!(chosen, Rounding { least_mm: 5e-3, step_mm: 0.0 });
        assert_eq!(Rounding::of(&[], 0.0).step_mm, 0.0);
    }

    #[test]
    fn a_plane_that_is_tilted_all_ways_gives_the_most_room() {
        let rounding = Rounding::of(&points(40, 2.0, 1e-3, 1.0), 2.0);
        assert!((rounding.off_plane_mm(Vec3::Z, 1.0) - 0.55e-3).abs() < 1e-9);
        let tilted = Vec3::splat(1.0 / 3.0_f64.sqrt());
        assert!((rounding.off_plane_mm(tilted, 1.0) - 0.55e-3 * 3.0_f64.sqrt()).abs() < 1e-9);
    }
}
