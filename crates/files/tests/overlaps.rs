//! A pattern that overlaps itself is that, and no fault of the program beside it.
#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::make::make;
use sheetwright::watch::Unwatched;
use sheetwright_files::{Format, InputFormat, PdfOptions, ReadOptions, output_files, read_bytes};
use std::fmt::Write;

/// A plate of 120 mm with a window of 40 mm, and on the window's upper edge an upright flap between
/// two places, so long, mm. The plate has samples every 20 mm, so that corners of the flap may come
/// to lie on some of them.
fn plate_with_flap([from, to]: [i32; 2], long: i32) -> String {
    let mut table = "curve,x,y,z,corner\n".to_owned();
    let mut line = |name: &str, points: &[[i32; 3]], every: i32| {
        for (n, [x, y, z]) in points.iter().enumerate() {
            let is_corner = i32::from(n % every as usize == 0);
            let _ = writeln!(table, "{name},{x},{y},{z},{is_corner}");
        }
    };
    let side = |n: i32| 20 * n - 60;
    let outline: Vec<[i32; 3]> = (0..6)
        .map(|n| [side(n), -60, 0])
        .chain((0..6).map(|n| [60, side(n), 0]))
        .chain((0..6).map(|n| [-side(n), 60, 0]))
        .chain((0..6).map(|n| [-60, -side(n), 0]))
        .collect();
    line("outline", &outline, 6);
    let flap = [[from, 20, 0], [from, 20, long], [to, 20, long], [to, 20, 0]];
    let window = [&[[-20, -20, 0], [-20, 20, 0]], &flap[..], &[[20, 20, 0], [20, -20, 0]]];
    line("window", &window.concat(), 1);
    table
}

#[test]
fn a_flap_over_its_plate_overlaps_and_is_no_fault() {
    let (mut overlapping, mut beyond) = (0, 0);
    for ends in [[-10, 10], [-10, 0], [0, 10], [-4, 4]] {
        for long in [20, 39, 41, 60, 80, 100, 140] {
            let table = plate_with_flap(ends, long);
            let options = ReadOptions::default();
            let format = InputFormat::Table;
            let read = read_bytes(format, table.as_bytes(), "flap.csv", None, &options);
            let design = read.unwrap();
            let made = make(&design, &mut Unwatched).unwrap();
            let outputs = output_files(&made, &Format::DEFAULT, &PdfOptions::default()).unwrap();
            let has = |code: &str| outputs.panels[0].findings.iter().any(|f| f.code() == code);
            assert!(!has("refold"), "{ends:?} {long}: {:?}", outputs.panels[0].findings);
            assert!(outputs.refold_error_mm[0] < 1e-6, "{ends:?} {long}");
            // Where the surface is the plate and its flap.
            if made.parts[0].measures.twist_total < 1e-9 && made.parts[0].sheet.seams().is_empty() {
                assert_eq!(has("overlap"), long > 40, "{ends:?} {long}");
                overlapping += usize::from(long > 40);
                beyond += usize::from(long > 80);
            }
        }
    }
    assert!(overlapping > 5 && beyond > 2, "{overlapping} {beyond}");
}
