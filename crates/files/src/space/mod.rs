//! Surfaces as they are seen in space: the view, what hides what, the shades and the lines that
//! are drawn. Reports write it as SVG, the book as PDF.
//!
//! Units of a picture are about a pixel of a page; y points down.

mod colours;
mod lines;
mod order;
mod placing;
mod raster;
mod rungs;
mod scene;
mod solid;
mod view;

pub(crate) use colours::{LIGHT, Ramp, in_ramp};
pub(crate) use lines::SeenLines;
pub(crate) use placing::Placing;
pub(crate) use raster::{CellRow, Facet, Raster};
pub(crate) use rungs::{
    APART, APART_CLASSES, CREASE, CUT, MOST_RUNGS, Middles, RUNG_CLASSES, rung_classes, worst_rung,
};
pub(crate) use scene::{
    Fill, LIES_ON, MOST_PATHS, SHADES, Scene, Shade, coarse_shade, faint, heat_shade, joined,
    shades_of, simplified,
};
pub(crate) use solid::{Drawn, Solid};
pub(crate) use view::{View, box_of, view_of};
