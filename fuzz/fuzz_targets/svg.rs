//! Any bytes as the SVG of a pattern: an error in words, or an outline and rungs that fit together
//! and are equal up to rounding after being written and read once more.
#![no_main]

mod again;

use libfuzzer_sys::fuzz_target;
use sheetwright_files::{read_svg, write_svg};

/// Largest move of a corner by rounding, as a share of the size: that of a subtraction or two.
const ROUNDED: f64 = 1e-14;

fuzz_target!(|bytes: &[u8]| {
    match read_svg(bytes) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(read) => again::check(&read, |piece| read_svg(&write_svg(piece)), ROUNDED),
    }
});
