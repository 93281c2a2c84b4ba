//! The colours of the shades of surfaces on a light page.

use super::scene::SHADES;

/// Dark and light end of the shades of a side, red, green and blue, from 0 to 255.
pub(crate) type Ramp = [[f64; 3]; 2];

/// The side that the surface faces, and the other.
pub(crate) const LIGHT: [Ramp; 2] = [
    [[104.0, 146.0, 186.0], [226.0, 238.0, 248.0]],
    [[176.0, 146.0, 106.0], [242.0, 230.0, 210.0]],
];

/// The colour of a level of brightness.
pub(crate) fn in_ramp([dark, light]: &Ramp, level: usize) -> [f64; 3] {
    let share = level as f64 / (SHADES - 1) as f64;
    [0, 1, 2].map(|n| dark[n] + share * (light[n] - dark[n]))
}
