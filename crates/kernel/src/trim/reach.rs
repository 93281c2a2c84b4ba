//! How far trims reach beyond pieces that are still looked for.

use super::is_joint;
use super::joints::KNOB;
use super::tabs::OUTER;
use crate::design::{Trim, TrimKind, TrimOn};
use crate::nets::{Beyond, Strip, StripEnds};
use sheetwright_geometry::math::{cos, sin};

/// What these trims add beyond the edges of the pieces of a net, at the most. A trim on an edge
/// that it names is not counted: no edge has a name yet.
pub(crate) fn beyond(trims: &[Trim]) -> Beyond {
    let mut beyond = Beyond::default();
    for trim in trims {
        let Some(strip) = strip(&trim.kind) else { continue };
        let is_on = |on: &[TrimOn]| trim.on.iter().any(|other| on.contains(other));
        let is_whole = trim.span == [0.0, 1.0];
        let add = |known: &mut Option<Strip>, all: &[TrimOn], some: &[TrimOn]| {
            // The last one takes the place of others.
            if is_whole && is_on(all) {
                *known = Some(strip);
            } else if is_on(all) || is_on(some) {
                *known = Some(known.map_or(strip, |before| before.around(strip)));
            }
        };
        add(&mut beyond.joined, &[TrimOn::All, TrimOn::Joined], &[TrimOn::Cuts]);
        if !is_joint(&trim.kind) {
            add(&mut beyond.free, &[TrimOn::All, TrimOn::Free], &[TrimOn::Holes]);
        }
    }
    beyond
}

/// What a trim adds beyond an edge; `None` of one that adds nothing along the whole of it.
fn strip(kind: &TrimKind) -> Option<Strip> {
    let square = StripEnds::Slanted { by_mm: 0.0, most: 0.0 };
    let (width_mm, ends) = match kind {
        TrimKind::Allowance(allowance) => {
            (allowance.width[0].max(allowance.width[1]), StripEnds::Meets)
        }
        TrimKind::Hem(hem) => (hem.width + hem.turn, StripEnds::Meets),
        TrimKind::Flange(flange) => (flange.width, StripEnds::Meets),
        TrimKind::Tabs(tabs) => {
            let back_mm = tabs.width * cos(tabs.angle) / sin(tabs.angle);
            let ends = StripEnds::Slanted { by_mm: back_mm.max(0.0), most: 0.5 * (1.0 - OUTER) };
            // A tab is as wide from a straight line, which its edge leaves by the tolerance.
            (tabs.width + tabs.tolerance, ends)
        }
        TrimKind::Fingers(fingers) => (fingers.depth, square),
        TrimKind::Puzzle(puzzle) => (0.5 * (1.0 + KNOB) * puzzle.width, square),
        TrimKind::Slots(slots) => {
            (slots.depth.max(slots.thickness + slots.clearance + slots.beyond), square)
        }
        TrimKind::Holes(_) | TrimKind::Notches(_) | TrimKind::Ticks(_) => return None,
    };
    Some(Strip { width_mm, ends })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Allowance, Corner, Hem, Tabs};
    use sheetwright_geometry::math::from_deg;

    #[test]
    fn the_last_trim_of_an_edge_counts_and_those_of_some_edges_beside_it() {
        let tabs =
            |width: f64| TrimKind::Tabs(Tabs { width, angle: from_deg(45.0), tolerance: 0.3 });
        let allowance =
            TrimKind::Allowance(Allowance { width: [4.0, 9.0], corner: Corner::ByLength });
        let hem = TrimKind::Hem(Hem { width: 20.0, turn: 10.0 });
        let widths = |trims: &[Trim]| {
            let beyond = beyond(trims);
            [beyond.joined, beyond.free].map(|strip| strip.map_or(0.0, |strip| strip.width_mm))
        };
        assert_eq!(widths(&[]), [0.0, 0.0]);
        assert_eq!(widths(&[Trim::new([TrimOn::All], tabs(5.0))]), [5.3, 0.0]);
        let both = [
            Trim::new([TrimOn::Joined], allowance.clone()),
            Trim::new([TrimOn::Joined], tabs(5.0)),
            Trim::new([TrimOn::Free], hem.clone()),
        ];
        assert_eq!(widths(&both), [5.3, 30.0]);
        let some = [
            Trim::new([TrimOn::All], allowance.clone()),
            Trim::new([TrimOn::Cuts], tabs(5.0)),
            Trim { span: [0.0, 0.5], ..Trim::new([TrimOn::Free], hem) },
        ];
        assert_eq!(widths(&some), [9.0, 30.0]);
        let named = TrimOn::Edge { part: None, edge: "cut-1a".to_owned() };
        assert_eq!(widths(&[Trim::new([named], allowance)]), [0.0, 0.0]);
        let ends = beyond(&[Trim::new([TrimOn::Joined], tabs(5.0))]).joined.unwrap().ends;
        let StripEnds::Slanted { by_mm, most } = ends else { panic!("{ends:?}") };
        assert!((by_mm - 5.0).abs() < 1e-12 && most == 0.35);
    }
}
