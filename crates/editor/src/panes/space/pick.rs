//! What is under the hand on a sheet.

use super::camera::{Camera, Ray};
use crate::document::Selection;
use crate::engine::shown::Shown;
use crate::scene::Scene;
use eframe::egui::{Pos2, Rect, Vec2};
use sheetwright::math::{Point3, unit};

/// A rung is hit within this, points.
const NEAR: f32 = 6.0;

/// What a click at a point of the screen selects: the rung there, else the panel; nothing on empty
/// ground.
pub(super) fn selected(scene: &Scene<'_>, camera: &Camera, rect: Rect, at: Pos2) -> Selection {
    let ray = camera.ray(at, rect);
    let mut front: Option<(f64, usize)> = None;
    for (n, shown) in scene.made() {
        if let Some(far) = met(shown, ray)
            && front.is_none_or(|(nearest, _)| far < nearest)
        {
            front = Some((far, n));
        }
    }
    // What lies behind a sheet can't be meant, but at its rim rungs stick out a little.
    let room = front.map(|(far, _)| {
        let here = ray.from + unit(ray.way).unwrap_or_default() * far;
        far + f64::from(2.0 * NEAR) * camera.mm_per_point(here, rect)
    });
    let mut best: Option<(f32, usize, usize)> = None;
    for (n, shown) in scene.made() {
        if front.is_some_and(|(_, panel)| panel != n) {
            continue;
        }
        for (k, rung) in shown.rungs.iter().enumerate() {
            let ends = rung.ends.map(|end| shown.positions.get(end as usize).copied());
            let [Some(a), Some(b)] = ends else { continue };
            let Some((apart, place)) = beside(camera, rect, [a, b], at) else { continue };
            let far = (place - ray.from).length();
            let hidden = room.is_some_and(|room| far > room);
            if apart <= NEAR && !hidden && best.is_none_or(|(least, ..)| apart < least) {
                best = Some((apart, n, k));
            }
        }
    }
    match (best, front) {
        (Some((_, panel, rung)), _) => Selection::of_rung(panel, rung),
        (None, Some((_, panel))) => Selection { panel: Some(panel), ..Selection::default() },
        (None, None) => Selection::default(),
    }
}

/// How far a point of the screen is from a segment, points, and the place on it, mm.
fn beside(camera: &Camera, rect: Rect, [a, b]: [Point3; 2], at: Pos2) -> Option<(f32, Point3)> {
    let (from, to) = (camera.seen(a, rect)?.at, camera.seen(b, rect)?.at);
    let share = share_along(from, to, at);
    Some((from.lerp(to, share).distance(at), a.lerp(b, f64::from(share))))
}

/// Which share of the way from one point to another is nearest to a third.
pub(crate) fn share_along(from: Pos2, to: Pos2, at: Pos2) -> f32 {
    let way: Vec2 = to - from;
    let share = (at - from).dot(way) / way.length_sq();
    if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }
}

/// How far along a ray it meets a panel first, mm.
fn met(shown: &Shown, ray: Ray) -> Option<f64> {
    let way = unit(ray.way)?;
    let at = |n: u32| shown.positions.get(n as usize).copied();
    let hit = |&[a, b, c]: &[u32; 3]| {
        let (a, b, c) = (at(a)?, at(b)?, at(c)?);
        // Möller and Trumbore's test.
        let (e, f) = (b - a, c - a);
        let p = way.cross(f);
        let det = e.dot(p);
        let s = ray.from - a;
        let u = s.dot(p) / det;
        let q = s.cross(e);
        let v = way.dot(q) / det;
        let far = f.dot(q) / det;
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && far > 0.0;
        (inside && far.is_finite()).then_some(far)
    };
    shown.triangles.iter().filter_map(hit).min_by(f64::total_cmp)
}
