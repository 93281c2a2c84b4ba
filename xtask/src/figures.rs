//! The pictures of the README and the docs, made from the examples.

use sheetwright::design::make;
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    Picture, ReadOptions, design_picture, flat_picture, read_input, side_by_side, stacked,
};
use std::error::Error;

/// Samples of each rail: enough for a smooth picture, few enough for a small file.
const SAMPLES: usize = 120;

/// Writes every picture.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    let example = crate::root().join("examples/ubc-fishing-vessel.sheet.json");
    let options = ReadOptions { samples: Some(SAMPLES), ..ReadOptions::default() };
    let made = make(&read_input(&example, &options)?, &mut Unwatched)?;
    let flat: Vec<Picture> =
        made.panels.iter().map(|panel| flat_picture(panel, made.material)).collect();
    let title = "The planks of a hull in space, and laid flat";
    let row = side_by_side(title, &[design_picture(&made), stacked("The flat planks", &flat)]);
    let path = crate::root().join("docs/pictures/hull.svg");
    std::fs::write(&path, row.standalone())?;
    println!("wrote {}", path.display());
    Ok(())
}
