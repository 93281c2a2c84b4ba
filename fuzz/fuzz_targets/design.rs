//! Any bytes as a design: an error with a hint, or a design that is written and reads back equal.
//! Small ones are made as well, with few samples: the door of the kernel keeps what it promises.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sheetwright::design::{Design, PanelShape};
use sheetwright::make::make;
use sheetwright::watch::Unwatched;
use sheetwright_files::{InputError, InputFormat, ReadOptions, hint_for, read_bytes, write_design};

/// Panels and points up to which making takes no time worth speaking of.
const SMALL: (usize, usize) = (3, 100);

fn read(bytes: &[u8], samples: Option<usize>) -> Result<Design, InputError> {
    let options = ReadOptions { samples, ..ReadOptions::default() };
    read_bytes(InputFormat::Design, bytes, "fuzz.sheet.json", None, &options)
}

fuzz_target!(|bytes: &[u8]| {
    match read(bytes, None) {
        Err(error) => assert!(!error.message.is_empty() && !error.hint.is_empty()),
        Ok(design) => {
            assert_eq!(read(&write_design(&design), None).as_ref(), Ok(&design));
            if let Ok(design) = read(bytes, Some(12)) {
                try_to_make(&design);
            }
        }
    }
});

fn try_to_make(design: &Design) {
    let points: usize = design.curves.iter().map(|curve| curve.points.len()).sum();
    // Holes are refused after they are sampled, as finely as their loop: up to a million samples.
    let holes =
        |shape: &PanelShape| matches!(shape, PanelShape::Loops { holes, .. } if !holes.is_empty());
    if design.panels.len() <= SMALL.0
        && points <= SMALL.1
        && !design.panels.iter().any(|panel| holes(&panel.shape))
        && let Err(error) = make(design, &mut Unwatched)
    {
        assert!(!hint_for(&error).is_empty());
    }
}
