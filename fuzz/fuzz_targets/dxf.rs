//! Any bytes as the DXF of a pattern: an error in words, or an outline and rungs that fit together
//! and are equal after being written and read once more.
#![no_main]

mod again;

use libfuzzer_sys::fuzz_target;
use sheetwright_files::{read_dxf, write_dxf};

/// Largest move of a corner by rounding: none, since DXF keeps every bit.
const EXACT: f64 = 0.0;

fuzz_target!(|bytes: &[u8]| {
    match read_dxf(bytes) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(read) => again::check(&read, |piece| read_dxf(&write_dxf(piece)), EXACT),
    }
});
