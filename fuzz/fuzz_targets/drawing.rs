//! Any bytes as a drawing of every format: an error with a hint, or panels of curves that the
//! kernel takes. Small ones are made as well.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sheetwright::curve::Curve;
use sheetwright::design::Design;
use sheetwright::make::{Judging, make_judged};
use sheetwright::watch::Unwatched;
use sheetwright_files::{DrawingFormat, InputFormat, ReadOptions, hint_for, read_bytes};

/// Curves and points up to which making takes no time worth speaking of.
const SMALL: [usize; 2] = [4, 200];

fuzz_target!(|bytes: &[u8]| {
    let named = ["a", "b"].map(str::to_owned).to_vec();
    for format in [DrawingFormat::Svg, DrawingFormat::Dxf, DrawingFormat::Obj] {
        for rails in [Vec::new(), named.clone()] {
            let options = ReadOptions { rails, samples: Some(12), ..ReadOptions::default() };
            match read_bytes(InputFormat::Drawing(format), bytes, "fuzz", None, &options) {
                Err(error) => assert!(!error.message.is_empty() && !error.hint.is_empty()),
                Ok(design) => {
                    assert!(!design.panels.is_empty());
                    for curve in &design.curves {
                        let kind = curve.kind.expect("drawn curves have kinds");
                        assert!(Curve::new(kind, &curve.points, curve.closed).is_ok());
                    }
                    try_to_make(&design);
                }
            }
        }
    }
});

fn try_to_make(design: &Design) {
    let points: usize = design.curves.iter().map(|curve| curve.points.len()).sum();
    if design.curves.len() > SMALL[0] || points > SMALL[1] {
        return;
    }
    if let Err(error) = make_judged(design, Judging::Quick, &mut Unwatched) {
        assert!(!hint_for(&error).is_empty());
    }
}
