//! The lines of a part in space, as far as they are seen.

use super::scene::{Scene, joined};
use super::solid::Drawn;
use sheetwright::math::Point2;

/// The lines of a part that nothing hides, in units of the picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct SeenLines {
    /// Whole loops of the border.
    pub(crate) rings: Vec<Vec<Point2>>,
    /// Pieces of the border.
    pub(crate) border: Vec<Vec<Point2>>,
    /// Where the surface turns away from the eye.
    pub(crate) turns: Vec<Vec<Point2>>,
    /// The sharp creases of a mesh.
    pub(crate) creases: Vec<Vec<Point2>>,
    /// The cuts along which the sheet is open.
    pub(crate) cuts: Vec<Vec<Point2>>,
}

impl SeenLines {
    /// The lines of a part whose triangles have these shades.
    pub(crate) fn of(part: &Drawn, shades: &[u16], scene: &Scene<'_>) -> Self {
        let seen = |steps: &[[usize; 2]]| {
            let lines = steps.iter().map(|&step| part.line(step));
            joined(lines.flat_map(|(ends, near)| scene.visible(ends, near)))
        };
        let solid = &part.solid;
        let mut found = Self::default();
        // The loops of a sheet that is cut open include the sides of the cuts, so its border is
        // drawn step by step.
        if scene.is_plain() && solid.cuts.is_empty() {
            let ring = |of_loop: &Vec<usize>| of_loop.iter().map(|&n| part.points[n]).collect();
            found.rings = solid.loops.iter().map(ring).collect();
        } else {
            found.border = seen(&solid.border);
        }
        if !scene.is_plain() {
            let lines = part.turns(shades).map(|ends| part.line(ends));
            found.turns = joined(lines.flat_map(|(ends, near)| scene.visible_turn(ends, near)));
        }
        found.creases = seen(&solid.creases);
        found.cuts = seen(&solid.cuts);
        found
    }
}
