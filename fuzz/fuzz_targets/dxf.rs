//! Any bytes as the DXF of a pattern: words of why not, or an outline and rungs that hold together
//! and that survive being written and read once more.
#![no_main]

mod again;

use libfuzzer_sys::fuzz_target;
use sheetwright_files::{read_dxf, write_dxf};

/// How far rounding takes a corner: not at all, since DXF keeps every bit.
const EXACT: f64 = 0.0;

fuzz_target!(|bytes: &[u8]| {
    match read_dxf(bytes) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(read) => again::check(&read, |piece| read_dxf(&write_dxf(piece)), EXACT),
    }
});
