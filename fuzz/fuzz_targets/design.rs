//! Any bytes as a design: an error with a hint, or a design that is written and reads back equal.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sheetwright_files::{InputFormat, ReadOptions, read_bytes, write_design};

fuzz_target!(|bytes: &[u8]| {
    let read = |bytes: &[u8]| {
        read_bytes(InputFormat::Design, bytes, "fuzz.sheet.json", None, &ReadOptions::default())
    };
    match read(bytes) {
        Err(error) => assert!(!error.message.is_empty() && !error.hint.is_empty()),
        Ok(design) => assert_eq!(read(&write_design(&design)).as_ref(), Ok(&design)),
    }
});
