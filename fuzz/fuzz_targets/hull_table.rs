//! Any bytes as a table of offsets, as text and as a workbook: an error with a hint, or a design
//! whose curves have two points or more, all within range.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sheetwright_files::{InputFormat, ReadOptions, hull_table_notes, read_bytes};

fuzz_target!(|bytes: &[u8]| {
    for (format, name) in [(InputFormat::Table, "fuzz.txt"), (InputFormat::Workbook, "fuzz.xlsx")] {
        match read_bytes(format, bytes, name, None, &ReadOptions::default()) {
            Err(error) => assert!(!error.message.is_empty() && !error.hint.is_empty()),
            Ok(design) => {
                let points = || design.curves.iter().flat_map(|curve| &curve.points);
                assert!(design.curves.iter().all(|curve| !curve.points.is_empty()));
                assert!(points().all(|p| [p.at.x, p.at.y, p.at.z].iter().all(|n| n.is_finite())));
            }
        }
        let _ = hull_table_notes(bytes, name, &ReadOptions::default());
    }
});
