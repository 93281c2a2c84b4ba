//! How far rounding may have moved the points of a mesh.
//!
//! Programs write coordinates with three to seven digits. Points of one plane then lie beside it by
//! up to half of the last digit in each coordinate, and a narrow triangle of a flat face turns by
//! degrees. The step of those numbers, one of the last digit, is found again from the points
//! themselves, in whatever unit and size they are by now: every difference of two coordinates is a
//! multiple of it, so it is their greatest common divisor, which Euclid's algorithm finds of
//! lengths as of whole numbers. The floating-point noise of the remainders is 1e-16 of the size
//! times the multiples, which are some millions at most where the step matters, so it stays
//! far below the step. Numbers with as many digits as fit have no such step, and those of six
//! significant digits, the usual ones of C++, none that is the same for large and small ones; for
//! both, [`SIX_DIGITS`] counts, within which points are one in healing, too.
//!
//! Healing joins and leaves out what rounding explains and no more, so it needs to know that
//! numbers were rounded, not chosen: a slit of one step in a drawing of whole millimetres is meant.
//! Chosen numbers are round ones mostly; of rounded ones, a fifth are multiples of five steps.

use sheetwright_geometry::math::{Point3, Vec3};

/// The least rounding that counts, as a share of the size.
const SIX_DIGITS: f64 = 1e-5;
/// A step that is larger, as a share of the size, was chosen: such numbers are not rounded. Three
/// decimals are less where the size is above 1.
const LARGEST_STEP: f64 = 1e-3;
/// A step that is larger, as a share of the size, may have been chosen as far as healing knows, as
/// the millimetres of what is smaller than five metres; unless it is [`NO_SLOT_MM`] or less.
const LARGEST_CERTAIN: f64 = 2e-4;
/// No shop cuts a slot as narrow as one or two such steps, mm.
const NO_SLOT_MM: f64 = 0.05;
/// Numbers are chosen where many are multiples of so many steps: people like fives.
const ROUND_STEPS: f64 = 5.0;
/// The share of such multiples up to which numbers are rounded: a fifth of those are.
const MOST_ROUND: f64 = 0.4;
/// Fewer numbers do not tell.
const LEAST_NUMBERS: usize = 3;
/// Digits are whole within this: products with a unit are off by 1e-10.
const DIGIT_NOISE: f64 = 1e-5;
/// A number that is smaller, as a share of the largest, is none: the cosine of a right angle.
const NO_NUMBER: f64 = 1e-9;
/// The lowest power of ten in which the digits of a number are counted, mm.
const LEAST_POWER: f64 = 1e-15;
/// Powers of ten that are tried: up to coordinates of 1e11 mm.
const POWERS: usize = 22;
/// A step that is smaller, as a share of the size, is hidden by [`SIX_DIGITS`].
const LEAST_STEP: f64 = 5e-6;
/// A step that is smaller, as a share of the size, does not count in healing either.
const LEAST_FOUND: f64 = 3e-7;
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
pub(crate) struct Rounding {
    /// The least distance that counts, mm.
    least_mm: f64,
    /// The step of its numbers, mm; 0 where they are not rounded as far as is seen.
    step_mm: f64,
    /// The step that rounding certainly left at the largest number, mm; 0 where none is seen.
    certain_mm: f64,
}

impl Rounding {
    /// The rounding of these points, which are so large together, mm.
    pub(crate) fn of(positions: &[Point3], size_mm: f64) -> Self {
        let found = step(positions, size_mm);
        let is_small = |step: f64| step <= LARGEST_STEP * size_mm;
        let is_certain = |step: f64| {
            (step <= NO_SLOT_MM.max(LARGEST_CERTAIN * size_mm)) && is_rounded(positions, step)
        };
        // Numbers of six digits have a finer step where they are small, which tells them.
        let finer = found.map_or(0.0, |step| 1.5 * step);
        let digit = last_digit(positions).filter(|&digit| finer < digit && is_small(digit));
        let step = found.filter(|&step| is_small(step));
        let certain = digit.or(step.filter(|&step| is_certain(step)));
        let step = step.filter(|&step| step >= LEAST_STEP * size_mm);
        let [step_mm, certain_mm] = [step, certain].map(|step| step.unwrap_or(0.0));
        Self { least_mm: SIX_DIGITS * size_mm, step_mm, certain_mm }
    }

    /// The distance between two points, or a point and a line, that certainly is rounding where
    /// they are meant to meet, mm; 0 where no rounding is seen.
    pub(crate) fn certain_mm(&self) -> f64 {
        MARGIN * 3.0_f64.sqrt() * self.certain_mm
    }

    /// The distance between two points that rounding explains, mm.
    pub(crate) fn between_mm(&self) -> f64 {
        // Each is off by half a step in each coordinate, along a diagonal at most.
        self.least_mm.max(MARGIN * 3.0_f64.sqrt() * self.step_mm)
    }

    /// The distance from a plane of this unit normal that rounding explains at a triangle of this
    /// least height, mm.
    pub(crate) fn off_plane_mm(&self, normal: Vec3, height_mm: f64) -> f64 {
        let sum = normal.x.abs() + normal.y.abs() + normal.z.abs();
        let least_mm = self.least_mm.min(MOST_OF_HEIGHT * height_mm);
        least_mm.max(MARGIN * 0.5 * self.step_mm * sum)
    }
}

/// The largest length of which all differences between coordinates are multiples, mm; `None` where
/// it is less than [`LEAST_FOUND`].
fn step(positions: &[Point3], size_mm: f64) -> Option<f64> {
    let first = *positions.first()?;
    let differences = |p: &Point3| [p.x - first.x, p.y - first.y, p.z - first.z].map(f64::abs);
    let largest = positions.iter().flat_map(differences).fold(0.0, f64::max);
    let (noise, least) = (NOISE * size_mm, LEAST_FOUND * size_mm);
    let lengths = positions.iter().flat_map(differences).filter(|&length| length > noise);
    let smallest = lengths.fold(largest, f64::min);
    let mut step = largest;
    // With the smallest first, every step divides it as well as the largest.
    for length in std::iter::once(smallest).chain(positions.iter().flat_map(differences)) {
        let (mut a, mut b) = (step, remainder(length, step));
        while b > noise {
            if b < least {
                return None;
            }
            (a, b) = (b, remainder(a, b));
        }
        // The largest difference tells the step best; the smallest one before it, since remainders
        // of remainders are too far off to count so many steps.
        let near = smallest / (smallest / a).round();
        step = largest / (largest / near).round();
    }
    (step >= least).then_some(step)
}

/// Whether numbers that are multiples of a step were rounded to it, on one axis at least.
fn is_rounded(positions: &[Point3], step: f64) -> bool {
    let Some(first) = positions.first() else { return false };
    let is_rounded = |axis: usize| {
        let along = |p: &Point3| (p.to_vec() - first.to_vec())[axis].abs();
        let differences = || positions.iter().map(along).filter(|&length| length > 0.5 * step);
        let is_round = |length: &f64| remainder(*length, ROUND_STEPS * step) < 0.5 * step;
        let (all, round) = (differences().count(), differences().filter(is_round).count());
        all >= LEAST_NUMBERS && round as f64 <= MOST_ROUND * all as f64
    };
    (0..3).any(is_rounded)
}

/// The step of the last digit at the largest number, mm: of 32-bit floats, if all numbers are
/// such, or of six significant digits, if none has more and some have six; `None` otherwise.
fn last_digit(positions: &[Point3]) -> Option<f64> {
    let numbers = || positions.iter().flat_map(|p| p.to_vec().to_array()).map(f64::abs);
    let largest = numbers().fold(0.0, f64::max);
    if numbers().all(|number| f64::from(number as f32) == number) {
        return Some(largest * f64::from(f32::EPSILON));
    }
    let mut is_full = false;
    for number in numbers().filter(|&number| number > NO_NUMBER * largest) {
        let digits = number / last_of_six(number)?;
        if (digits - digits.round()).abs() > DIGIT_NOISE {
            return None;
        }
        is_full |= digits.round() % 10.0 != 0.0;
    }
    last_of_six(largest).filter(|_| is_full)
}

/// What one in the sixth digit of a positive number counts, mm.
fn last_of_six(number: f64) -> Option<f64> {
    let powers = std::iter::successors(Some(LEAST_POWER), |power| Some(power * 10.0));
    powers.take(POWERS).find(|power| number / power < 999_999.5)
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
        assert_eq!(chosen, Rounding { least_mm: 5e-3, step_mm: 0.0, certain_mm: 0.0 });
        assert_eq!(Rounding::of(&[], 0.0).step_mm, 0.0);
    }

    #[test]
    fn what_certainly_is_rounding_is_learned_from_the_digits() {
        let certain = |points: &[Point3], size: f64| {
            Rounding::of(points, size).certain_mm() / (MARGIN * 3.0_f64.sqrt())
        };
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-6 * b;
        // Three decimals of a part of 100, in millimetres and in inches.
        assert!(near(certain(&points(20, 100.0, 1e-3, 1.0), 100.0), 1e-3));
        assert!(near(certain(&points(20, 100.0, 1e-3, 25.4), 2540.0), 25.4e-3));
        assert!(near(certain(&points(200, 1000.0, 1e-3, 1.0), 1000.0), 1e-3));
        // Multiples of five were chosen, and so were millimetres of less than five metres.
        let mut chosen = points(20, 100.0, 0.005, 1.0);
        chosen[3].x = 48.001;
        assert!(Rounding::of(&chosen, 100.0).step_mm > 0.0);
        assert_eq!(certain(&chosen, 100.0), 0.0);
        assert_eq!(certain(&points(20, 2000.0, 1.0, 1.0), 2000.0), 0.0);
        // Six digits, as C++ writes them, of numbers up to 300 and in metres.
        let digits = |x: f64| format!("{x:.5e}").parse::<f64>().unwrap();
        let six = |factor: f64| -> Vec<Point3> {
            let exact = points(40, 600.0, 0.0, 1.0);
            let six = exact.iter().map(|p| p.to_vec().to_array().map(|x| factor * digits(x)));
            six.map(|[x, y, z]| Point3::new(x, y, z)).collect()
        };
        assert!(near(certain(&six(1.0), 600.0), 1e-3));
        assert!(near(certain(&six(1000.0), 600e3), 1.0));
        // Of numbers on both sides of 1000, the small ones have one decimal more.
        let mut both = points(40, 600.0, 0.0, 1.0);
        for p in &mut both {
            let [x, y, z] = p.to_vec().to_array().map(|x| digits(1000.0 + x));
            *p = Point3::new(x, y, z);
        }
        assert!(near(certain(&both, 600.0), 1e-2));
        // Floats, and all digits.
        let float = |x: f64| f64::from((x + 4096.0) as f32);
        let floats = points(40, 600.0, 0.0, 1.0);
        let floats: Vec<Point3> =
            floats.iter().map(|p| Point3::new(float(p.x), float(p.y), float(p.z))).collect();
        let spacing = certain(&floats, 600.0);
        assert!((4.5e-4..6e-4).contains(&spacing), "{spacing}");
        assert_eq!(certain(&points(40, 600.0, 0.0, 1.0), 600.0), 0.0);
    }

    #[test]
    fn a_plane_that_is_tilted_all_ways_gives_the_most_room() {
        let rounding = Rounding::of(&points(40, 2.0, 1e-3, 1.0), 2.0);
        assert!((rounding.off_plane_mm(Vec3::Z, 1.0) - 0.55e-3).abs() < 1e-9);
        let tilted = Vec3::splat(1.0 / 3.0_f64.sqrt());
        assert!((rounding.off_plane_mm(tilted, 1.0) - 0.55e-3 * 3.0_f64.sqrt()).abs() < 1e-9);
    }
}
