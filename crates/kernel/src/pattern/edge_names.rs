//! The names of edges, inside the middles of the edges, each with what it is joined to: which piece
//! meets which is read off the pieces.

use super::wish::{FROM_MIDDLE, Instead, Wish, WishAt};
use super::{LabelKind, Role};
use crate::edge::{Edge, EdgeSource};
use sheetwright_geometry::math::Point2;

/// Between the name of an edge and what it is joined to.
pub(super) const JOINED_TO: &str = " = ";
/// The name of a shorter edge, mm, stands there only where it has room: no leader tells such edges
/// apart.
const SHORT_MM: f64 = 4.0;

/// The names of the edges of a piece whose vertices lie at `flat`. Sides of cuts have marks of
/// their own, and where there is one edge its name says nothing, unless it is joined. `tick_mm` is
/// the length of ticks on the border, which names stay clear of.
pub(super) fn wishes(
    edges: &[Edge],
    joined: &[Option<String>],
    flat: &[Point2],
    tick_mm: f64,
) -> Vec<Wish> {
    let joined = joined.iter().map(Option::as_deref).chain(std::iter::repeat(None));
    let is_cut = |edge: &Edge| matches!(edge.source, EdgeSource::Cut { .. });
    let said = edges
        .iter()
        .zip(joined)
        .filter(|(edge, joined)| !is_cut(edge) && (edges.len() > 1 || joined.is_some()));
    let wish = |(edge, joined): (&Edge, Option<&str>)| {
        let name = edge.name.clone();
        let both = joined.map(|joined| format!("{name}{JOINED_TO}{joined}"));
        let line = edge.run.iter().map(|&v| flat[v]).collect();
        Wish {
            kind: LabelKind::Edge,
            role: Role::Engrave,
            texts: both.into_iter().chain([name]).collect(),
            height_mm: None,
            at: vec![WishAt::Beside { line, shares: FROM_MIDDLE, is_left: true, away_mm: tick_mm }],
            instead: match edge.length_flat_mm < SHORT_MM {
                true => Instead::Nothing,
                false => Instead::Leader,
            },
        }
    };
    said.map(wish).collect()
}
