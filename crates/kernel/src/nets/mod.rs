//! Nets: a mesh of flat facets laid flat by folds alone, as a paper model is.
//!
//! A facet is a flat face: triangles that hang together and lie in one plane, within the rounding
//! of their file (`planes`, `rounding`). Two facets meet along a *hinge*, a straight line. Every
//! hinge is folded or cut. A piece, whose facets hang together by folds, lies flat without
//! stretching if every vertex that is not flat is reached by a cut. So the folds of a piece form a
//! tree of facets (of the *dual graph*), and each tree has an exact net. Which tree is a matter of
//! taste and of one limit: the net must not overlap itself.
//!
//! 1. Pieces *grow* (`grow`): all hinges are tried in an order, and a hinge is folded if the
//!    pieces on its two sides, laid beside one another, do not overlap. Every piece is free of
//!    overlap at all times, so none is ever parted. Kruskal's algorithm with this extra condition
//!    is what makers' programs do (Blender's Export Paper Model).
//! 2. Several orders are tried (`order`): long hinges first, as \[StraubPrautzsch2011\] advise;
//!    flat ones first; and each vertex's edge that climbs most steeply in some direction last
//!    (\[Schlickenrieder1997\]), after which a convex body nearly always comes out in one piece.
//!    The fewest pieces win; among equals, the net whose cuts are short and out of sight.
//! 3. What remains in several pieces is *mended* (`mend`): a small piece is taken apart, together
//!    with facets around it, and grown again in another order; the result is kept if there are
//!    fewer pieces, or if more facets are in large ones; \[Takahashi2011\] do so by a genetic
//!    algorithm.
//! 4. Last, cuts are made shorter and less seen: one is folded in place of a cheaper fold.
//!
//! The number of comparisons of facets bounds the search, so it is the same on every machine.
//!
//! Out of sight is below and at the back: the model stands on a table, its top towards +z, and is
//! looked at from the front, which is −y, as in the editor's views.
//!
//! A hinge whose two sides come to lie on one another, as round a vertex that is flat, is folded as
//! well: the cut there would be none.

mod facets;
mod grow;
mod meant;
mod mend;
mod order;
mod overlap;
mod planes;
mod rounding;

pub use meant::{Coarseness, MEANT_DEG, MOST_FACETS, coarseness};

use crate::mesh::{Cut, Mesh};
use crate::sheet::Sheet;
use facets::Facets;
use grow::Pieces;
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::watch::Watch;

/// The limits of a net.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NetOptions {
    /// The width and height, mm, of a rectangle that no piece exceeds; a facet that is larger by
    /// itself is a piece of its own. Default: no limit.
    pub within_mm: Option<[f64; 2]>,
}

/// A net: how a mesh of facets is cut.
#[derive(Clone, Debug, PartialEq)]
pub struct Net {
    /// How many facets there are.
    pub facets: usize,
    /// How many pieces they form.
    pub pieces: usize,
    /// The hinges that are cut: each its vertices in order.
    cuts: Vec<NetCut>,
    /// The facet of each triangle of the mesh.
    of_triangle: Vec<usize>,
}

/// A hinge that is cut.
#[derive(Clone, Debug, PartialEq)]
struct NetCut {
    line: Vec<VertexIndex>,
    /// Whether it parts two pieces; otherwise both its sides are of one piece.
    parts: bool,
}

/// Once so many pairs are compared, no further orders are tried: about two seconds.
const MOST_WORK: usize = 150_000_000;

/// The net of a mesh with the fewest pieces that were found, which is cut along `seams` wherever
/// they part two facets; `None` if the watcher asks to stop.
pub fn net(mesh: &Mesh, seams: &Cut, options: &NetOptions, watch: &mut dyn Watch) -> Option<Net> {
    let facets = Facets::of(mesh, seams);
    let pieces = best(&facets, options, watch)?;
    let cut = |(n, hinge): (usize, &facets::Hinge)| {
        let [a, b] = hinge.facets.map(|f| pieces.of_facet[f]);
        (!pieces.folded[n]).then(|| NetCut { line: hinge.line.clone(), parts: a != b })
    };
    let cuts = facets.hinges.iter().enumerate().filter_map(cut).collect();
    let (count, of_triangle) = (pieces.count(), facets.of_triangle.clone());
    Some(Net { facets: facets.list.len(), pieces: count, cuts, of_triangle })
}

fn best<'a>(facets: &'a Facets, options: &NetOptions, watch: &mut dyn Watch) -> Option<Pieces<'a>> {
    let empty = Pieces::new(facets, options.within_mm);
    let mut best: Option<Pieces<'a>> = None;
    let mut work = 0;
    for order in order::orders(facets) {
        if work > MOST_WORK {
            break;
        }
        let mut pieces = empty.clone();
        if !pieces.grow(&order, watch) {
            return None;
        }
        work += pieces.work;
        best = Some(match best {
            Some(best) if !pieces.is_better(&best) => best,
            _ => pieces,
        });
    }
    let mended = mend::mended(best.unwrap_or(empty), watch)?;
    mend::tidied(mended, watch)
}

impl Net {
    /// The facet of a triangle of the mesh.
    pub fn facet_of(&self, triangle: TriangleIndex) -> usize {
        self.of_triangle[triangle.get()]
    }

    /// The mesh taken apart into the pieces of the net, with the lines along which they were one.
    ///
    /// # Errors
    /// See [`crate::mesh::MeshError`]; a valid mesh has none.
    pub fn apart(&self, mesh: &Mesh) -> Result<Sheet, crate::mesh::MeshError> {
        let lines = self.cuts.iter().filter(|cut| cut.parts).map(|cut| &cut.line[..]);
        crate::sheet::cut_along_lines(mesh, &lines.collect::<Vec<_>>())
    }

    /// The lines along which pieces are cut without falling apart.
    pub fn slits(&self) -> impl Iterator<Item = &[VertexIndex]> {
        self.cuts.iter().filter(|cut| !cut.parts).map(|cut| &cut.line[..])
    }
}

#[cfg(test)]
mod tests;
