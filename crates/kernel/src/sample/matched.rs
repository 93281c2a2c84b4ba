//! How many samples curves get that several panels share, so that both sides of a seam have the
//! same.

use super::loops::{Matched, Sampler, drawn};
use crate::design::{Design, PanelShape};
use sheetwright_geometry::curve::{Curve, Placed, divisions_of, open_placed};
use std::collections::BTreeMap;

/// The divisions of the curves that several loops share: of each smooth run, the most that it has
/// in any of them. Empty unless the design matches its seams. Panels that can't be sampled are left
/// out.
pub(crate) fn matched(design: &Design) -> Matched {
    let mut most = Matched::new();
    if !design.match_seams {
        return most;
    }
    let mut uses: BTreeMap<usize, usize> = BTreeMap::new();
    let mut note = |curve: usize, divisions: Vec<usize>| {
        *uses.entry(curve).or_default() += 1;
        let known = most.entry(curve).or_default();
        known.resize(known.len().max(divisions.len()), 0);
        known.iter_mut().zip(divisions).for_each(|(most, n)| *most = n.max(*most));
    };
    let sampler = Sampler { design, matched: &Matched::new() };
    for panel in design.panels_to_make() {
        match &panel.shape {
            PanelShape::Rails(rails) => {
                for rail in rails {
                    let Ok((number, curve)) = sampler.built(panel, rail) else { continue };
                    let Ok(samples) = open_placed(&curve, panel.samples, None) else { continue };
                    note(number, drawn(counted(&curve, &samples), &curve, rail.reversed));
                }
            }
            PanelShape::Loops { outer, holes } => {
                let Ok(loops) = sampler.loops(panel, outer, holes) else { continue };
                for (uses, samples) in std::iter::once(outer).chain(holes).zip(loops) {
                    let built: Result<Vec<_>, _> =
                        uses.iter().map(|part| sampler.built(panel, part)).collect();
                    let Ok(built) = built else { continue };
                    let curves: Vec<Curve> = built.iter().map(|(_, c)| c.clone()).collect();
                    let Ok(divisions) = divisions_of(&curves, samples.len()) else { continue };
                    for ((number, curve), (part, found)) in
                        built.iter().zip(uses.iter().zip(divisions))
                    {
                        if design.curves[*number].kind.is_some() {
                            note(*number, drawn(found, curve, part.reversed));
                        }
                    }
                }
            }
            PanelShape::Join(_) | PanelShape::Mesh(_) => {}
        }
    }
    most.retain(|curve, _| uses.get(curve).is_some_and(|&n| n > 1));
    most
}

/// The divisions of each smooth run of an open curve with these samples.
fn counted(curve: &Curve, samples: &[Placed]) -> Vec<usize> {
    let runs = curve.smooth_runs();
    let mut ends = 0;
    let ends: Vec<usize> = runs
        .iter()
        .map(|run| {
            ends += run.spans().len();
            ends
        })
        .collect();
    let mut found = vec![0; runs.len()];
    for placed in &samples[..samples.len() - 1] {
        let run = ends.partition_point(|&end| end <= placed.leaving.span);
        found[run.min(runs.len() - 1)] += 1;
    }
    found
}
