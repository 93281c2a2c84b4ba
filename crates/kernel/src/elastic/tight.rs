//! Patches of a sheet at rest that are bent more tightly than it takes.
//!
//! What 95 % of the area stays below leaves out points, where every sheet creases a little. It
//! leaves out the narrow end of a long cone, too, where the sheet breaks all the same. So a patch
//! of triangles side by side counts for itself, however little of the area it is, if it is as large
//! as the net tells. What lies so near to a point of the surface that no sheet follows it is no
//! patch.

use super::{Elastic, at_share};
use crate::material::Limits;
use sheetwright_geometry::math::Point3;
use std::collections::{BTreeMap, BTreeSet};

/// A patch of fewer triangles is a point.
const FEWEST: usize = 6;
/// Sheet curls along its edges by up to so many times its curvature.
const CURL: f64 = 1.1;

/// The tightest curvature that half of such a patch stays above, 1/mm; 0 where there is none.
/// `points` are those of the surface, each with its reach, mm.
pub(super) fn curvature_of_patches(
    sheet: &Elastic,
    limits: &Limits,
    points: &[(Point3, f64)],
) -> f64 {
    let is_at_point = |t| points.iter().any(|(at, reach)| sheet.middle(t).distance(*at) < *reach);
    let is_tight = |&t: &usize| limits.use_of(0.0, sheet.curvatures[t]) > CURL && !is_at_point(t);
    let tight: Vec<usize> = (0..sheet.triangles.len()).filter(is_tight).collect();
    let of_patch = |patch: &Vec<usize>| {
        if patch.len() < FEWEST {
            return 0.0;
        }
        let of = |values: &[f64]| patch.iter().map(|&t| values[t]).collect::<Vec<f64>>();
        at_share(&of(&sheet.curvatures), &of(&sheet.areas_mm2), 0.5)
    };
    patches(sheet, &tight).iter().map(of_patch).fold(0.0, f64::max)
}

/// Some triangles of a sheet, by the patches in which they lie side by side.
fn patches(sheet: &Elastic, triangles: &[usize]) -> Vec<Vec<usize>> {
    let mut beside: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
    for &t in triangles {
        for side in sides(sheet.triangles[t]) {
            beside.entry(side).or_default().push(t);
        }
    }
    let mut seen = BTreeSet::new();
    let mut patches = Vec::new();
    for &first in triangles {
        let mut patch = Vec::new();
        let mut reached = vec![first];
        while let Some(t) = reached.pop() {
            if seen.insert(t) {
                patch.push(t);
                reached.extend(sides(sheet.triangles[t]).iter().flat_map(|side| &beside[side]));
            }
        }
        patches.push(patch);
    }
    patches
}

/// The sides of a triangle, each by its ends, the lower first.
fn sides([a, b, c]: [usize; 3]) -> [[usize; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[from, to]| [from.min(to), from.max(to)])
}
