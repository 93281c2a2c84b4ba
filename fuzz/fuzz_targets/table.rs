//! Any bytes as a table: an error with a hint, or curves. Those of a curve table are written and
//! read back to the same bits. Small ones are made as well: the door of the kernel keeps what it
//! promises.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sheetwright::design::{Design, DesignCurve};
use sheetwright::make::make;
use sheetwright::watch::Unwatched;
use sheetwright_files::{InputFormat, ReadOptions, hint_for, read_bytes, write_table};

/// Samples up to which making takes no time worth speaking of.
const SMALL: usize = 24;

fuzz_target!(|bytes: &[u8]| {
    let read = |bytes: &[u8]| {
        read_bytes(InputFormat::Table, bytes, "fuzz.csv", None, &ReadOptions::default())
    };
    match read(bytes) {
        Err(error) => assert!(!error.message.is_empty() && !error.hint.is_empty()),
        Ok(design) => {
            let again = read(&write_table(&design.curves)).map(|again| again.curves);
            if design.curves.iter().all(keeps_its_points) {
                assert_eq!(again.as_ref(), Ok(&design.curves));
            }
            try_to_make(&design);
        }
    }
});

/// Whether a curve reads back as it is: the text may have had the lines of a hull, which are open,
/// and a loop that still ends where it begins loses its last point once more.
fn keeps_its_points(curve: &DesignCurve) -> bool {
    let ends = (curve.points.first().map(|p| p.at), curve.points.last().map(|p| p.at));
    curve.closed && (curve.points.len() < 2 || ends.0 != ends.1)
}

fn try_to_make(design: &Design) {
    if design.curves.iter().map(|curve| curve.points.len()).sum::<usize>() <= SMALL
        && let Err(error) = make(design, &mut Unwatched)
    {
        assert!(!hint_for(&error).is_empty());
    }
}
