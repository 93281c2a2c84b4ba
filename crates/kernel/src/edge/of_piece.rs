//! The edges of a piece that a part was divided into: those of the part, as far as they lie on the
//! piece, and the sides of the cuts that divide it.

use super::border::edges;
use super::{Edge, EdgeSource};
use crate::sheet::{Sheet, steps_of};
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::Point2;

/// What a step of the border of a piece lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PieceStep {
    /// An edge of the part, by its number.
    Edge(usize),
    /// A cut that divides the part, by its number, and whether it is its second side.
    Division(usize, bool),
    /// Nothing that is joined: the border of a strap.
    Free,
}

/// The edges of a piece that is laid flat at these points, without mates. `step` gives what a step
/// of its border lies on, `whole` are the edges of the part.
pub(crate) fn edges_of_piece(
    sheet: &Sheet,
    flat: &[Point2],
    whole: &[Edge],
    step: impl Fn([VertexIndex; 2]) -> PieceStep,
) -> Vec<Edge> {
    let of_loop = |line: &Vec<VertexIndex>| -> Vec<(usize, PieceStep)> {
        steps_of(line).map(|ends| (ends[0].get(), step(ends))).collect()
    };
    let loops: Vec<Vec<(usize, PieceStep)>> = sheet.loops().iter().map(of_loop).collect();
    let named = |step: PieceStep| match step {
        PieceStep::Edge(number) => (whole[number].name.clone(), whole[number].source),
        PieceStep::Division(number, second) => {
            let name = format!("divide-{}{}", number + 1, if second { 'b' } else { 'a' });
            (name, EdgeSource::Division { number, second })
        }
        PieceStep::Free => ("border".to_owned(), EdgeSource::Border),
    };
    edges(&loops, named, sheet.mesh().positions(), flat)
}
