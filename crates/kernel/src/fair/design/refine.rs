//! Curves drawn anew through their samples, so that each of these can move by itself.

use crate::design::{CurveUse, Design, DesignCurve, DesignPanel};
use crate::sample::{PanelError, Sampled, Sampler, built, kind_of_part, matched, sampled};
use sheetwright_geometry::curve::{CurveKind, CurvePoint, point_shares, position_shares};
use sheetwright_geometry::math::Point3;
use std::collections::BTreeSet;

/// The design with these curves drawn as splines through their samples, those of the first panel
/// that uses each. Curves whose points are samples stay as they are.
pub(super) fn with_a_point_a_sample(
    design: &Design,
    panels: &[&DesignPanel],
    curves: &BTreeSet<usize>,
) -> Result<Design, PanelError> {
    let mut refined = design.clone();
    let matched = matched(design);
    let sampler = Sampler { design, matched: &matched };
    let is_drawn = |n: &usize| design.curves[*n].kind.is_some() || !design.curves[*n].closed;
    let mut left: BTreeSet<usize> = curves.iter().copied().filter(is_drawn).collect();
    for panel in panels {
        let sampled = sampled(&sampler, panel)?;
        for number in left.clone() {
            let curve = &design.curves[number];
            let mut taken = samples_on(&sampled, number);
            if taken.is_empty() {
                continue;
            }
            left.remove(&number);
            if !curve.closed {
                // At the ends, the samples may have been taken from the next curve.
                let whole = CurveUse { name: curve.name.clone(), reversed: false };
                let whole = built(design, panel, &whole)?;
                let last = whole.spans().len() - 1;
                taken.push(Taken { span: 0, t: 0.0, at: whole.start(), corner: false });
                taken.push(Taken { span: last, t: 1.0, at: whole.end(), corner: false });
            }
            refined.curves[number].kind = Some(CurveKind::Spline);
            refined.curves[number].points = points(curve, taken);
        }
    }
    Ok(refined)
}

/// A sample of a curve.
struct Taken {
    span: usize,
    t: f64,
    at: Point3,
    /// Whether the curve has a corner there.
    corner: bool,
}

fn samples_on(sampled: &Sampled, number: usize) -> Vec<Taken> {
    let of_curve = sampled.loops.iter().flatten().filter_map(|sourced| {
        let place = sourced.at.filter(|place| place.curve == number)?;
        let both = [sourced.arriving, sourced.leaving];
        let inside = both.iter().flatten().filter(|place| place.curve == number).count() == 2;
        let corner = inside && sourced.sample.is_corner();
        Some(Taken { span: place.span, t: place.t, at: sourced.sample.position, corner })
    });
    of_curve.collect()
}

/// The points of the curve through these samples, in the order of the curve.
fn points(curve: &DesignCurve, mut taken: Vec<Taken>) -> Vec<CurvePoint> {
    taken.sort_by(|a, b| a.span.cmp(&b.span).then(a.t.total_cmp(&b.t)));
    taken.dedup_by(|b, a| {
        let same = a.at == b.at;
        a.corner |= same && b.corner;
        same
    });
    let shares = point_shares(kind_of_part(curve), &curve.points, curve.closed);
    // The limit of a sample follows from those of the points beside it.
    let may_move = |taken: &Taken| {
        let near = position_shares(&shares[taken.span], taken.t);
        let all: f64 = near.iter().map(|share| share.factor.abs()).sum();
        let each = near.iter().map(|s| s.factor.abs() * curve.points[s.point].move_mm);
        each.sum::<f64>() / all
    };
    let point =
        |taken: &Taken| CurvePoint { at: taken.at, corner: taken.corner, move_mm: may_move(taken) };
    taken.iter().map(point).collect()
}
