//! Nets: a mesh of flat facets laid flat by folds alone, as a paper model is.
//!
//! A facet is a flat face: triangles that hang together and lie in one plane, within the rounding
//! of their file (`planes`, `mesh/rounding`). Two facets meet along a *hinge*, a straight line.
//! Every hinge is folded or cut. A piece, whose facets hang together by folds, lies flat without
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
//! 4. Cuts are made shorter and less seen: one is folded in place of a cheaper fold.
//! 5. A body that is its own image in a plane (`mirror`) gets a net that is, too, if that has no
//!    more pieces and its cuts are hardly longer: it grows, and is mended and tidied, by pairs of
//!    hinges, of which both are folded or none. Such a net is easier to put together.
//!
//! Each body of a mesh is a net by itself. The number of comparisons of facets bounds the search,
//! so it is the same on every machine.
//!
//! Out of sight is below and at the back: the model stands on a table, its top towards +z, and is
//! looked at from the front, which is −y, as in the editor's views.
//!
//! A hinge whose two sides come to lie on one another, as round a vertex that is flat, is folded as
//! well: the cut there would be none.

mod beyond;
mod facets;
mod grow;
mod meant;
mod mend;
mod mirror;
mod order;
mod overlap;
mod planes;

pub use beyond::{Beyond, Strip, StripEnds};
pub use meant::{Coarseness, MEANT_DEG, MOST_FACETS, coarseness};

use crate::mesh::{Cut, Mesh, Rounding, cut_of_part};
use crate::sheet::Sheet;
use beyond::Room;
use facets::Facets;
use grow::Pieces;
use mirror::{Mirror, mirrors};
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::watch::Watch;

/// The limits of a net.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NetOptions {
    /// The width and height, mm, of a rectangle that no piece exceeds; a facet that is larger by
    /// itself is a piece of its own. Default: no limit.
    pub within_mm: Option<[f64; 2]>,
    /// What will stand beyond the border of pieces, which counts for that. Default: nothing.
    pub beyond: Beyond,
    /// Sides of one piece that come nearer than this to one another, mm, count as overlapping. Of
    /// two that meet in a vertex, the end of the shorter must be as far from the line of the
    /// longer, if they leave it on one side. Default: 0, for which 1e-9 of the size counts.
    pub apart_mm: f64,
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

/// Work of trying orders, in pairs that are compared: about two seconds.
const MOST_GROWING: usize = 200_000_000;
/// Work of mending: about a second.
const MOST_MENDING: usize = 100_000_000;
/// Work of tidying: about a second.
const MOST_TIDYING: usize = 100_000_000;
/// The cuts of a symmetric net may cost so many times as much: a cone of an even number of sides
/// would have two long seams in place of one, 1.2 times as much.
const MOST_COST: f64 = 1.1;
/// Mirrors in which a symmetric net is tried.
const MOST_MIRRORS: usize = 3;

/// The work that is left for a body.
struct Left {
    growing: usize,
    mending: usize,
    tidying: usize,
}

impl Left {
    /// The work for a body with this share of a mesh.
    fn of_share(share: f64) -> Self {
        let part = |most: usize| (most as f64 * share) as usize;
        let [growing, mending] = [MOST_GROWING, MOST_MENDING].map(part);
        Self { growing, mending, tidying: part(MOST_TIDYING) }
    }
}

/// The distance between two points of a mesh that the rounding of its file explains, mm.
pub fn rounding_mm(mesh: &Mesh) -> f64 {
    let size_mm = size_of(mesh.positions().iter().copied());
    Rounding::of(mesh.positions(), size_mm).between_mm()
}

/// The net of a mesh with the fewest pieces that were found, each of its bodies by itself; it is
/// cut along `seams` wherever they part two facets. `None` if the watcher asks to stop.
pub fn net(mesh: &Mesh, seams: &Cut, options: &NetOptions, watch: &mut dyn Watch) -> Option<Net> {
    let of_triangle = vec![0; mesh.triangles().len()];
    let mut net = Net { facets: 0, pieces: 0, cuts: Vec::new(), of_triangle };
    let bodies = match mesh.components() {
        [_] => None,
        components => components.iter().map(|body| mesh.part(&body.triangles).ok()).collect(),
    };
    let Some(bodies): Option<Vec<(Mesh, Vec<VertexIndex>)>> = bodies else {
        let all: Vec<TriangleIndex> = (0..mesh.triangles().len()).map(TriangleIndex::new).collect();
        net.add(mesh, &all, |v| v, seams, options, watch)?;
        return Some(net);
    };
    for ((body, vertices), component) in bodies.iter().zip(mesh.components()) {
        let seams = cut_of_part(mesh, seams, body, vertices);
        let of_mesh = |v: VertexIndex| vertices[v.get()];
        net.add(body, &component.triangles, of_mesh, &seams, options, watch)?;
    }
    Some(net)
}

/// The best pieces of a body: those with the fewest that were found; symmetric ones, if there are
/// no more of them and their cuts hardly cost more.
fn best<'a>(
    facets: &'a Facets,
    mirrors: &'a [Mirror],
    room: Option<&'a Room>,
    mut left: Left,
    watch: &mut dyn Watch,
) -> Option<Pieces<'a>> {
    let orders = order::orders(facets);
    let each = |mirror| Pieces::new(facets, room, mirror);
    let pieces = grown(&each(None), orders.iter().cloned(), &mut left.growing, watch)?;
    let pieces = mend::mended(pieces, mend::components(facets), &mut left.mending, watch)?;
    let mut best = mend::tidied(pieces, &mut left.tidying, watch)?;
    let (count, most_cost) = (best.count(), MOST_COST * best.cost());
    let mut is_symmetric = false;
    for mirror in mirrors.iter().filter(|mirror| mirror.least_pieces <= count).take(MOST_MIRRORS) {
        if left.growing == 0 {
            break;
        }
        let arranged = [true, false].into_iter().flat_map(|middle_first| {
            orders.iter().map(move |order| mirror.arranged(facets, order, middle_first))
        });
        let pieces = grown(&each(Some(mirror)), arranged, &mut left.growing, watch)?;
        let pieces = mend::mended(pieces, count, &mut left.mending, watch)?;
        if pieces.count() > count {
            continue;
        }
        let pieces = mend::tidied(pieces, &mut left.tidying, watch)?;
        let is_worth_it = pieces.cost() <= most_cost && pieces.is_symmetric();
        if is_worth_it && (!is_symmetric || pieces.is_better(&best)) {
            (best, is_symmetric) = (pieces, true);
        }
    }
    Some(best)
}

/// Pieces that are grown in several orders, the best of them; the first order is tried whatever
/// work is left. `None` if the watcher asks to stop.
fn grown<'a>(
    each: &Pieces<'a>,
    orders: impl Iterator<Item = Vec<usize>>,
    left: &mut usize,
    watch: &mut dyn Watch,
) -> Option<Pieces<'a>> {
    let mut best: Option<Pieces<'a>> = None;
    for order in orders {
        if best.is_some() && *left == 0 {
            break;
        }
        let mut pieces = each.clone();
        if !pieces.grow(&order, watch) {
            return None;
        }
        *left = left.saturating_sub(pieces.work);
        best = Some(match best {
            Some(best) if !pieces.is_better(&best) => best,
            _ => pieces,
        });
    }
    Some(best.unwrap_or_else(|| each.clone()))
}

impl Net {
    /// Adds the net of a body, which are these triangles of the mesh, and whose vertices are
    /// `of_mesh` there; `None` if the watcher asks to stop.
    fn add(
        &mut self,
        body: &Mesh,
        triangles: &[TriangleIndex],
        of_mesh: impl Fn(VertexIndex) -> VertexIndex,
        seams: &Cut,
        options: &NetOptions,
        watch: &mut dyn Watch,
    ) -> Option<()> {
        let mut facets = Facets::of(body, seams);
        facets.apart_mm = options.apart_mm;
        let mirrors = mirrors(&facets);
        let left = Left::of_share(triangles.len() as f64 / self.of_triangle.len() as f64);
        let room = options.within_mm.map(|within| Room::new(&facets, within, &options.beyond));
        let pieces = best(&facets, &mirrors, room.as_ref(), left, watch)?;
        for (n, hinge) in facets.hinges.iter().enumerate().filter(|&(n, _)| !pieces.folded[n]) {
            let [a, b] = facets.hinges[n].facets.map(|f| pieces.of_facet[f]);
            let line = hinge.line.iter().map(|&v| of_mesh(v)).collect();
            self.cuts.push(NetCut { line, parts: a != b });
        }
        for (t, facet) in triangles.iter().zip(&facets.of_triangle) {
            self.of_triangle[t.get()] = self.facets + facet;
        }
        self.facets += facets.list.len();
        self.pieces += pieces.count();
        Some(())
    }

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
