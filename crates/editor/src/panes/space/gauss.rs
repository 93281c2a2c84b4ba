//! The Gauss image: the directions that a sheet faces along its rungs, as points on a sphere.
//!
//! Along a ruling of a developable sheet the tangent plane stays the same, so both ends of a rung
//! have one normal and the image is a curve. What twists spreads it to a ribbon, as wide as the
//! warp angle: width says it, so colours don't, and the image needs no legend.

use super::gpu::SheetVertex;
use super::lines::{Lines, Pen};
use crate::engine::shown::Shown;
use crate::panes::measured::{rungs_by_ends, sides, sorted};
use crate::scene::Scene;
use crate::theme::Theme;
use sheetwright::check::Place;
use sheetwright::math::{Point3, Vec3, angle_between, cos, from_deg, sin, to_deg, turned, unit};

/// The sphere has this many faces round, and half as many from pole to pole.
const FACES: usize = 72;
/// An arc is drawn straight over this many degrees.
const ARC_DEG: f64 = 3.0;
/// Lines stand off the sphere by this share of its radius.
const OFF: f64 = 1.003;

/// What is drawn for the Gauss image: a ball of radius 1, and lines on it.
pub(super) fn image(scene: &Scene<'_>) -> (Vec<SheetVertex>, Lines) {
    let theme = scene.theme;
    let mut lines = Lines::about(Point3::default());
    graticule(&mut lines, theme);
    let chosen = scene.selection;
    for (n, shown) in scene.made() {
        let picked = chosen.panel == Some(n);
        let opacity = if chosen.panel.is_none() || picked { 1.0 } else { 0.35 };
        for (k, rung) in shown.rungs.iter().enumerate() {
            if rung.normals[0] == Vec3::ZERO {
                continue;
            }
            let is_marked = |numbers: &[usize]| numbers.binary_search(&k).is_ok();
            let at_rung =
                picked && matches!(&chosen.place, Place::Rungs { numbers } if is_marked(numbers));
            let pen = if at_rung {
                Pen::new(theme.accent, 4.0, 3.0)
            } else {
                Pen::new(theme.rung, 1.5, 1.0).faded(opacity)
            };
            arc(&mut lines, rung.normals, pen);
        }
        let pen = Pen::new(theme.curve, 2.0, 2.0).faded(opacity);
        for [a, b] in joins(shown) {
            arc(&mut lines, a, pen);
            arc(&mut lines, b, pen);
        }
    }
    (ball(), lines)
}

/// The middle of the directions of all panels; `None` without a rung that has normals.
pub(super) fn middle(scene: &Scene<'_>) -> Option<Vec3> {
    let normals = || {
        let rungs = scene.made().flat_map(|(_, shown)| shown.rungs.iter());
        rungs.flat_map(|rung| rung.normals).filter(|&n| n != Vec3::ZERO)
    };
    unit(normals().sum::<Vec3>()).or_else(|| normals().next())
}

/// Where two rungs follow one another over a triangle: the normals at their ends on one side of the
/// panel, and on the other.
fn joins(shown: &Shown) -> Vec<[[Vec3; 2]; 2]> {
    let rungs = rungs_by_ends(shown);
    let normal = |n: usize, end: u32| {
        let rung = &shown.rungs[n];
        let normal = rung.normals[usize::from(rung.ends[1] == end)];
        (normal != Vec3::ZERO).then_some(normal)
    };
    let mut joins = Vec::new();
    for &triangle in &shown.triangles {
        let around = sides(triangle);
        let found: Vec<([u32; 2], usize)> =
            around.iter().filter_map(|&side| Some((side, *rungs.get(&sorted(side))?))).collect();
        let [(first, a), (second, b)] = found[..] else { continue };
        let Some(&apex) = first.iter().find(|end| second.contains(end)) else { continue };
        let far = |side: [u32; 2]| if side[0] == apex { side[1] } else { side[0] };
        let pairs = [[(a, apex), (b, apex)], [(a, far(first)), (b, far(second))]];
        let of = |pair: [(usize, u32); 2]| {
            Some([normal(pair[0].0, pair[0].1)?, normal(pair[1].0, pair[1].1)?])
        };
        if let (Some(near), Some(other)) = (of(pairs[0]), of(pairs[1])) {
            joins.push([near, other]);
        }
    }
    joins
}

/// The shortest way on the sphere from one direction to another.
fn arc(lines: &mut Lines, [from, to]: [Vec3; 2], pen: Pen) {
    let angle = angle_between(from, to);
    let steps = (to_deg(angle) / ARC_DEG).ceil().max(1.0) as usize;
    let axis = unit(from.cross(to));
    let at = |k: usize| {
        let way = match axis {
            Some(axis) => turned(from, axis, angle * k as f64 / steps as f64),
            None => from,
        };
        Point3::from_vec(way * OFF)
    };
    for k in 0..steps {
        lines.segment([at(k), at(k + 1)], pen);
    }
}

/// Circles every 30°, the equator and the circles over the axes stronger.
fn graticule(lines: &mut Lines, theme: &Theme) {
    let thin = Pen::new(theme.faint, 1.0, 0.5).faded(0.3);
    for latitude in (-60..=60).step_by(30) {
        let (level, height) = (cos(deg(latitude)), sin(deg(latitude)));
        let at = |k: i32| Vec3::new(level * cos(deg(k)), level * sin(deg(k)), height);
        circle(lines, at, 360, thin);
    }
    for longitude in (0..360).step_by(30) {
        let around = deg(longitude);
        let at = |k: i32| {
            let up = deg(k - 90);
            Vec3::new(cos(up) * cos(around), cos(up) * sin(around), sin(up))
        };
        circle(lines, at, 180, thin);
    }
    for (axis, colour) in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().zip(theme.axes) {
        let ends = [axis * OFF, axis * 1.18].map(Point3::from_vec);
        lines.segment(ends, Pen::new(colour, 2.0, 0.0));
    }
}

fn circle(lines: &mut Lines, at: impl Fn(i32) -> Vec3, degrees: i32, pen: Pen) {
    for k in (0..degrees).step_by(5) {
        lines.segment([k, k + 5].map(|k| Point3::from_vec(at(k) * (1.0 + 0.3 * (OFF - 1.0)))), pen);
    }
}

fn deg(degrees: i32) -> f64 {
    from_deg(f64::from(degrees))
}

/// A ball of radius 1.
fn ball() -> Vec<SheetVertex> {
    let at = |i: usize, j: usize| {
        let around = 2.0 * std::f64::consts::PI * i as f64 / FACES as f64;
        let up = std::f64::consts::PI * (j as f64 / (FACES / 2) as f64 - 0.5);
        Vec3::new(cos(up) * cos(around), cos(up) * sin(around), sin(up))
    };
    let mut all = Vec::new();
    for j in 0..FACES / 2 {
        for i in 0..FACES {
            let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            for triangle in [[0, 1, 2], [0, 2, 3]] {
                let places = triangle.map(|n: usize| corners[n]);
                let normals = [[0, 1], [1, 2], [2, 0]].map(|[a, b]: [usize; 2]| {
                    let n = unit(places[a] + places[b]).unwrap_or(places[a]);
                    [n.x, n.y, n.z, 1.0].map(|share| (share * 32767.0).round() as i16)
                });
                for place in places {
                    let place = place.as_vec3().to_array();
                    all.push(SheetVertex { place, normals, values: [-1.0; 3], mark: 0.0 });
                }
            }
        }
    }
    all
}
