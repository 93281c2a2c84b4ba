//! The pictures of the README and the docs, made from the examples.

use sheetwright::design::{Made, make};
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    Picture, ReadOptions, design_picture, flat_picture, gauss_picture, read_input, side_by_side,
    stacked, surface_picture,
};
use std::error::Error;

/// Samples of each rail: enough for a smooth picture, few enough for a small file.
const SAMPLES: usize = 120;

/// Writes every picture.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    for (name, picture) in [("hull.svg", hull()?), ("three-cones.svg", three_cones()?)] {
        let path = crate::root().join("docs/pictures").join(name);
        std::fs::write(&path, picture.standalone())?;
        println!("wrote {}", path.display());
    }
    Ok(())
}

fn hull() -> Result<Picture, Box<dyn Error>> {
    let example = crate::root().join("examples/ubc-fishing-vessel.sheet.json");
    let options = ReadOptions { samples: Some(SAMPLES), ..ReadOptions::default() };
    let made = make(&read_input(&example, &options)?, &mut Unwatched)?;
    let flat: Vec<Picture> =
        made.panels.iter().map(|panel| flat_picture(panel, made.material)).collect();
    let title = "The planks of a hull in space, and laid flat";
    Ok(side_by_side(title, &[design_picture(&made), stacked("The flat planks", &flat)]))
}

/// The best triangulation and the best bridge of the three cones, with their Gauss images.
fn three_cones() -> Result<Picture, Box<dyn Error>> {
    let [best, bridge] = crate::composites::drawn()?;
    let column = |made: &Made, title: &str| {
        let panel = &made.panels[0];
        let mut pictures = vec![surface_picture(panel, made.material)];
        pictures.extend(gauss_picture(panel, made.material));
        stacked(title, &pictures)
    };
    let columns = [
        column(&best, "The best of all triangulations, with its Gauss image"),
        column(&bridge, "The best bridge triangulation, with its Gauss image"),
    ];
    Ok(side_by_side("Three cones joined to one sheet", &columns))
}
