//! How wide the knobs of a puzzle joint may be: as boatbuilders make them, or so much smaller that
//! no socket comes near to another edge of its piece, where it would part it.

use crate::edge::Edge;
use crate::make::part::Part;
use sheetwright_geometry::math::{Point2, unit2};

/// The width of a knob, mm.
pub(super) const KNOB_MM: f64 = 51.0;
/// On short joints, this share of the length.
const SHARE: f64 = 0.25;
/// How far a knob reaches beyond the cut, in widths.
pub(super) const REACH: f64 = 0.9;
/// The distance from knob to knob, in widths: where two cuts cross, the first sockets of both then
/// keep clear of one another.
pub(super) const PITCH: f64 = 3.0;
/// The middle of a socket lies as far within the piece, in widths.
const WITHIN: f64 = 0.4;
/// It keeps as far from the other edges, in widths: half of it is its own.
const AWAY: f64 = 0.75;
/// As far from other cuts, in widths.
const AWAY_OF_CUTS: f64 = 1.1;
/// Smaller knobs hold nothing, mm.
const LEAST_MM: f64 = 5.0;
/// How much smaller the next size is.
const SMALLER: f64 = 0.8;

/// The widest knobs that both pieces of a joint take; `None` where they take none. Each piece
/// comes with the number of its side of the joint among its edges.
pub(super) fn knob_mm(pieces: [(&Part, usize); 2]) -> Option<f64> {
    let length_mm = pieces[0].0.edges[pieces[0].1].length_flat_mm;
    let first = KNOB_MM.min(SHARE * length_mm);
    let sizes = std::iter::successors(Some(first), |width| Some(SMALLER * width));
    let mut sizes = sizes.take_while(|&width| width >= LEAST_MM);
    sizes.find(|&width| pieces.iter().all(|&(part, edge)| is_clear(part, edge, width)))
}

/// Whether sockets of this width all along an edge keep clear of the other edges.
fn is_clear(part: &Part, number: usize, width: f64) -> bool {
    let at = |v: usize| part.flat.points[v];
    let run = &part.edges[number].run;
    let [from, to] = [run[0], run[run.len() - 1]].map(at);
    let Some(along) = unit2(to - from) else { return false };
    let count = (from.distance(to) / (PITCH * width)).round().max(1.0);
    let away = |edge: &Edge, middle: Point2| {
        let steps = edge.run.windows(2).map(|step| [at(step[0]), at(step[1])]);
        steps.map(|step| middle.distance_to_segment(step)).fold(f64::INFINITY, f64::min)
    };
    (0..count as usize).all(|n| {
        let middle = from.lerp(to, (n as f64 + 0.5) / count) + along.perp() * (WITHIN * width);
        let others = part.edges.iter().enumerate().filter(|&(n, _)| n != number);
        others.into_iter().all(|(_, edge)| {
            let is_cut = matches!(edge.source, crate::edge::EdgeSource::Division { .. });
            let least = if is_cut { AWAY_OF_CUTS } else { AWAY };
            away(edge, middle) >= least * width
        })
    })
}
