//! Patches of a sheet at rest that are bent more tightly than it takes.
//!
//! What 95 % of the area stays below leaves out points, where every sheet creases a little. It
//! leaves out the narrow end of a long cone, too, where the sheet breaks all the same. So a patch
//! of triangles side by side counts for itself if it is as large as the coarsest net tells, also on
//! finer nets, which show ever smaller ones beside edges and corners. What lies so near to a point
//! of the surface that no sheet follows it is no patch.

use super::net::ordered;
use super::{Elastic, at_share};
use crate::material::Limits;
use sheetwright_geometry::math::Point3;
use std::collections::{BTreeMap, BTreeSet};

/// A patch of fewer triangles is a point.
const FEWEST: usize = 6;
/// So is one of a smaller share of the area: that of six triangles of 350, if they are small.
const LEAST_SHARE: f64 = 0.015;
/// A triangle is tight where it uses more than this of what the sheet takes: along its edges, a
/// sheet curls by up to a tenth more than elsewhere.
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
    let whole: f64 = sheet.areas_mm2.iter().sum();
    let of_patch = |patch: &Vec<usize>| {
        let of = |values: &[f64]| patch.iter().map(|&t| values[t]).collect::<Vec<f64>>();
        let areas = of(&sheet.areas_mm2);
        if patch.len() < FEWEST || areas.iter().sum::<f64>() < LEAST_SHARE * whole {
            return 0.0;
        }
        at_share(&of(&sheet.curvatures), &areas, 0.5)
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
    [[a, b], [b, c], [c, a]].map(ordered)
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_geometry::math::Point2;

    /// A strip of triangles of 1 mm², which are bent to these radii, mm.
    fn strip(radii: &[f64]) -> Elastic {
        let node = |n: usize| Point3::new((n / 2) as f64, (n % 2) as f64 * 2.0, 0.0);
        let positions: Vec<Point3> = (0..radii.len() + 2).map(node).collect();
        Elastic {
            flat: positions.iter().map(|p| Point2::new(p.x, p.y)).collect(),
            moves: Vec::new(),
            positions,
            triangles: (0..radii.len()).map(|n| [n, n + 1, n + 2]).collect(),
            areas_mm2: vec![1.0; radii.len()],
            strains: vec![0.0; radii.len()],
            curvatures: radii.iter().map(|radius| 1.0 / radius).collect(),
            over: vec![0; radii.len()],
            distance_max_mm: 0.0,
            slid_max_mm: 0.0,
            load_n_per_mm: 0.0,
            stretching_n_mm: 0.0,
            bending_n_mm: 0.0,
            is_stable: true,
            steps: 0,
        }
    }

    #[test]
    fn a_patch_counts_if_it_is_large_and_no_point() {
        let limits = Limits {
            sheet: None,
            thickness_mm: 1.0,
            poisson: 0.3,
            modulus_n_per_mm2: None,
            strain: 1e-3,
            outer_fibre: Some(0.5 / 100.0),
            yields: None,
            moment_share: 1.0,
            folds: false,
        };
        let radius = |radii: &[f64], points: &[(Point3, f64)]| {
            1.0 / curvature_of_patches(&strip(radii), &limits, points)
        };
        let (wide, tight) = ([400.0; 60], [50.0, 60.0, 70.0, 80.0, 85.0, 88.0]);
        let long = [&wide[..], &tight[..], &wide[..]].concat();
        let found = radius(&long, &[]);
        assert!((70.0..=80.0).contains(&found), "{found}");
        let at = Point3::new(31.5, 1.0, 0.0);
        assert_eq!(radius(&long, &[(at, 5.0)]), f64::INFINITY, "a point of the surface");
        let parted = [&tight[..3], &wide[..], &tight[3..]].concat();
        assert_eq!(radius(&parted, &[]), f64::INFINITY, "too few side by side");
        let small = [&long[..], &[400.0; 400]].concat();
        assert_eq!(radius(&small, &[]), f64::INFINITY, "too small a share of the area");
        assert_eq!(radius(&[95.0; 60], &[]), f64::INFINITY, "as sheet curls along its edges");
    }
}
