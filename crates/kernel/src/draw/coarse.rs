//! A design with fewer samples, for a picture that keeps up with the hand.

use super::edit::built;
use crate::design::{CurveUse, Design, DesignPanel, PanelShape};
use crate::sample::LEAST_OF_HOLE;
use sheetwright_geometry::curve::Curve;

/// A design of which no panel has more than `most` samples in all its loops, or else the least
/// number that its curves need: one at every corner, three on an outline, and the minimum of each
/// hole. Panels with no more samples stay as they are. Where seams are matched, all panels with
/// more get fewer in the same proportion, so that both sides of a seam still agree; a panel that
/// shares a long curve with a finer one may then keep a few more. Tolerances are dropped: the
/// numbers that they take are to be known, by [`crate::sample::Counts`].
///
/// Meshes have no samples. Points that are samples themselves stay, and joins are as fine as they
/// ask for or their parts make them.
pub fn coarse(design: &Design, most: usize) -> Design {
    let mut changed = design.clone();
    let finest: Vec<usize> = design
        .panels
        .iter()
        .map(|panel| within(design, panel, most).unwrap_or(panel.samples))
        .collect();
    let sampled = finest.iter().zip(&design.panels).filter(|(_, p)| p.samples > 0);
    let shares = sampled.map(|(&n, p)| n as f64 / p.samples as f64);
    let smallest = shares.fold(1.0, f64::min);
    for (panel, finest) in changed.panels.iter_mut().zip(finest) {
        let in_proportion = (panel.samples as f64 * smallest).floor() as usize;
        let wanted = if design.match_seams { finest.min(in_proportion) } else { finest };
        panel.samples = wanted.max(least(design, panel)).min(panel.samples);
        panel.tolerance = None;
    }
    changed
}

/// The largest setting of `samples` of a panel with which it has at most `most` samples in all;
/// `None` where that is unknown.
fn within(design: &Design, panel: &DesignPanel, most: usize) -> Option<usize> {
    let (mut low, mut high) = (least(design, panel), panel.samples);
    let count = counter(design, panel)?;
    if count(high) <= most {
        return Some(high);
    }
    // The number of samples never falls as the setting grows.
    while low < high {
        let middle = (low + high).div_ceil(2);
        if count(middle) <= most {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    Some(low)
}

fn curves<'a>(
    design: &'a Design,
    uses: &'a [CurveUse],
) -> impl Iterator<Item = (Curve, bool)> + 'a {
    let found = |part: &CurveUse| {
        let curve = design.curves.iter().find(|curve| curve.name == part.name)?;
        Some((built(curve).ok()?, curve.kind.is_none() && curve.closed))
    };
    uses.iter().filter_map(found)
}

/// Samples that the corners of a chain of curves need.
fn corners(design: &Design, uses: &[CurveUse]) -> usize {
    curves(design, uses).map(|(curve, _)| curve.stretches().len()).sum::<usize>().max(3)
}

/// The least setting of `samples` of a panel.
fn least(design: &Design, panel: &DesignPanel) -> usize {
    match &panel.shape {
        PanelShape::Rails(rails) => {
            let of_rail = |rail| corners_of_rail(design, rail);
            rails.iter().map(of_rail).max().unwrap_or(2)
        }
        PanelShape::Loops { outer, .. } => corners(design, outer),
        PanelShape::Join(_) | PanelShape::Mesh(_) => 3,
    }
}

fn corners_of_rail(design: &Design, rail: &CurveUse) -> usize {
    let uses = std::slice::from_ref(rail);
    curves(design, uses).map(|(curve, _)| curve.stretches().len() + 1).sum::<usize>().max(2)
}

/// The number of samples in all loops of a panel, as a function of its setting.
fn counter(design: &Design, panel: &DesignPanel) -> Option<impl Fn(usize) -> usize> {
    // Curves that can't be built have none.
    let length = |uses: &[CurveUse]| {
        Some(curves(design, uses).map(|(c, _)| c.length()).sum::<f64>()).filter(|&l| l > 0.0)
    };
    // Points that are samples themselves: how many.
    let fixed = |uses: &[CurveUse]| match curves(design, uses).next() {
        Some((curve, true)) if uses.len() == 1 => Some(curve.spans().len()),
        _ => None,
    };
    let (outer, holes) = match &panel.shape {
        PanelShape::Rails(_) => (None, Vec::new()),
        PanelShape::Loops { outer, holes } => {
            let hole =
                |hole: &Vec<CurveUse>| Some((length(hole)?, fixed(hole), corners(design, hole)));
            let holes = holes.iter().map(hole).collect::<Option<Vec<_>>>()?;
            (Some((length(outer)?, fixed(outer))), holes)
        }
        PanelShape::Join(_) | PanelShape::Mesh(_) => return None,
    };
    Some(move |asked: usize| {
        let Some((length, fixed)) = outer else { return 2 * asked };
        let on_outer = fixed.unwrap_or(asked);
        let spacing = length / on_outer.max(1) as f64;
        let of_hole = |(length, fixed, corners): &(f64, Option<usize>, usize)| {
            let spaced = (length / spacing).ceil() as usize;
            fixed.unwrap_or(spaced.max(LEAST_OF_HOLE).max(*corners))
        };
        on_outer + holes.iter().map(of_hole).sum::<usize>()
    })
}
