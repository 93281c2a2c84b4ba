//! Sheets as triangles to draw: smooth where they bend, sharp where they fold, coloured by what is
//! measured along their rungs and edges.
//!
//! A sheet without vertices inside is a row of triangles, and bends along its rungs. So normals
//! belong to rungs, not to corners: the mean of the two triangles that meet there, or each
//! triangle's own at a fold. The shader runs from one rung's normal to the next; at an apex, where
//! many rungs end, that has a normal for each of them.

use super::gpu::SheetVertex;
use crate::engine::shown::{Shown, ShownStrain};
use crate::panes::measured::{
    Quantity, folds, rungs_by_ends, sides, sorted, strained, triangle_normals, values,
};
use sheetwright::math::{Point3, Vec3, unit};
use std::collections::BTreeMap;

/// The triangles of a panel, in mm about an origin.
pub(super) fn vertices(
    shown: &Shown,
    by: Option<Quantity>,
    origin: Point3,
    marked: bool,
) -> Vec<SheetVertex> {
    if let Some((strain, triangles)) = strained(shown, by) {
        return at_rest(strain, triangles, origin, if marked { 1.0 } else { 0.0 });
    }
    let rungs = rungs_by_ends(shown);
    let folds = folds(shown);
    let normals = triangle_normals(shown);
    // The sum of the normals of the triangles at each rung.
    let mut bent = vec![Vec3::ZERO; shown.rungs.len()];
    for (triangle, &normal) in shown.triangles.iter().zip(&normals) {
        for side in sides(*triangle) {
            if let Some(&n) = rungs.get(&sorted(side)) {
                bent[n] += normal;
            }
        }
    }
    let values = values(shown, by);
    let mark = if marked { 1.0 } else { 0.0 };
    let mut all = Vec::with_capacity(3 * shown.triangles.len());
    for (t, triangle) in shown.triangles.iter().enumerate() {
        let own = normals[t];
        let of_side = sides(*triangle).map(|side| {
            let &n = rungs.get(&sorted(side))?;
            Some(if folds[n] { own } else { unit(bent[n]).unwrap_or(own) })
        });
        let alone = of_side.iter().all(Option::is_none);
        let packed = of_side.map(|normal| match normal {
            Some(normal) => pack(normal, 1.0),
            None => pack(own, if alone { 1.0 } else { 0.0 }),
        });
        let values = values.get(t).copied().unwrap_or([-1.0; 3]);
        for &corner in triangle {
            let at = shown.positions.get(corner as usize).copied().unwrap_or_default();
            let place = (at - origin).as_vec3().to_array();
            all.push(SheetVertex { place, normals: packed, values, mark });
        }
    }
    all
}

/// The triangles of a sheet at rest, each in the colour of its share.
fn at_rest(
    strain: &ShownStrain,
    triangles: impl Iterator<Item = ([u32; 3], f64)>,
    origin: Point3,
    mark: f32,
) -> Vec<SheetVertex> {
    let at = |n: u32| strain.positions.get(n as usize).copied().unwrap_or_default();
    let normal = |t: &[u32; 3]| {
        let [a, b, c] = t.map(at);
        unit((b - a).cross(c - a)).unwrap_or(Vec3::ZERO)
    };
    let mut bent: BTreeMap<[u32; 2], Vec3> = BTreeMap::new();
    for triangle in &strain.triangles {
        for side in sides(*triangle) {
            *bent.entry(sorted(side)).or_insert(Vec3::ZERO) += normal(triangle);
        }
    }
    let mut all = Vec::with_capacity(3 * strain.triangles.len());
    for (triangle, share) in triangles {
        let own = normal(&triangle);
        let of_side = |side| bent.get(&sorted(side)).and_then(|sum| unit(*sum)).unwrap_or(own);
        let normals = sides(triangle).map(|side| pack(of_side(side), 1.0));
        for corner in triangle {
            let place = (at(corner) - origin).as_vec3().to_array();
            all.push(SheetVertex { place, normals, values: [share as f32; 3], mark });
        }
    }
    all
}

fn pack(normal: Vec3, counts: f64) -> [i16; 4] {
    [normal.x, normal.y, normal.z, counts].map(|share| (share * 32767.0).round() as i16)
}
