//! Where one looks from: a turntable round a point, with z upwards.
//!
//! ```text
//!        z  eye
//!        │ ╱      toward: from the target to the eye, by yaw about z and pitch above the ground
//!        │╱ pitch  right, up: the axes of the picture
//! target ●────     height: what fits between the lower and the upper edge at the target, mm
//! ```
//!
//! The height serves both kinds of view: parallel lines stay parallel, or meet far away, and what
//! lies at the target is as large in either.

use eframe::egui::{Pos2, Rect, Vec2};
use sheetwright::math::{Point3, Vec3, atan2, cos, sin};
use std::f64::consts::{FRAC_PI_2, PI};

/// The angle between the lower and the upper edge of a picture in perspective, radians.
const FIELD: f64 = 30.0 * PI / 180.0;
/// The share of the picture that is left free around what fits it.
const MARGIN: f64 = 1.16;
/// Nothing is looked at more closely, mm.
const HEIGHT_MIN: f64 = 1e-3;
/// Nothing is looked at from farther, mm.
const HEIGHT_MAX: f64 = 1e10;

/// From where one looks, as angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Direction {
    /// How far the eye is turned about z, radians: 0 on the side of x.
    pub yaw: f64,
    /// How far it is above the ground, radians, −π/2 ..= π/2.
    pub pitch: f64,
}

impl Direction {
    /// From in front, to the right and above: what a shape is best seen from.
    pub const CORNER: Self = Self { yaw: -PI / 3.0, pitch: PI / 6.0 };

    /// From where a direction points.
    pub fn towards(way: Vec3) -> Self {
        let level = Vec3::new(way.x, way.y, 0.0).length();
        // Straight from above or below, as plans are drawn.
        let yaw = if level > 1e-6 { atan2(way.y, way.x) } else { -FRAC_PI_2 };
        Self { yaw, pitch: atan2(way.z, level) }
    }

    /// A part of the way to another one, the short way round.
    fn toward(self, other: Self, share: f64) -> Self {
        let turn = (other.yaw - self.yaw + PI).rem_euclid(2.0 * PI) - PI;
        Self {
            yaw: self.yaw + share * turn,
            pitch: self.pitch + share * (other.pitch - self.pitch),
        }
    }
}

/// Where one looks from, and how far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// What is in the middle of the picture, mm.
    pub target: Point3,
    /// From where.
    pub direction: Direction,
    /// What fits between the lower and the upper edge at the target, mm.
    pub height_mm: f64,
    /// Whether parallel lines meet far away.
    pub perspective: bool,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            target: Point3::default(),
            direction: Direction::CORNER,
            height_mm: 1000.0,
            perspective: true,
        }
    }
}

/// A point on the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Where.
    pub at: Pos2,
    /// How far from the eye along the view, mm; smaller is nearer.
    pub depth: f64,
}

/// A line of sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it begins, mm.
    pub from: Point3,
    /// Where it goes; its length says nothing.
    pub way: Vec3,
}

impl Camera {
    /// From the target to the eye.
    pub fn toward(&self) -> Vec3 {
        let Direction { yaw, pitch } = self.direction;
        Vec3::new(cos(pitch) * cos(yaw), cos(pitch) * sin(yaw), sin(pitch))
    }

    /// From where the front of a surface with this normal is seen: from where it is looked at now,
    /// unless that shows its back. What turns its back is mostly hidden by what turns its front.
    pub fn facing(&self, normal: Vec3) -> Direction {
        if self.toward().dot(normal) < 0.0 { Direction::towards(normal) } else { self.direction }
    }

    /// To the right on the picture.
    pub fn right(&self) -> Vec3 {
        Vec3::new(-sin(self.direction.yaw), cos(self.direction.yaw), 0.0)
    }

    /// Upwards on the picture.
    pub fn up(&self) -> Vec3 {
        self.toward().cross(self.right())
    }

    /// How far the eye is from the target, mm.
    pub fn distance(&self) -> f64 {
        0.5 * self.height_mm * cos(0.5 * FIELD) / sin(0.5 * FIELD)
    }

    /// Where a point shows; `None` behind the eye.
    pub fn seen(&self, p: Point3, rect: Rect) -> Option<Seen> {
        let way = p - self.target;
        let depth = self.distance() - way.dot(self.toward());
        let shrink = self.shrink(depth)?;
        let scale = f64::from(rect.height()) / self.height_mm / shrink;
        let (x, y) = (way.dot(self.right()) * scale, way.dot(self.up()) * scale);
        let at = rect.center() + Vec2::new(x as f32, -y as f32);
        at.is_finite().then_some(Seen { at, depth })
    }

    /// How much smaller things are at a distance from the eye than at the target; `None` behind
    /// the eye.
    fn shrink(&self, depth: f64) -> Option<f64> {
        if !self.perspective {
            return Some(1.0);
        }
        let shrink = depth / self.distance();
        (shrink > 1e-3).then_some(shrink)
    }

    /// The size of a point of the screen where `p` is, mm.
    pub fn mm_per_point(&self, p: Point3, rect: Rect) -> f64 {
        let depth = self.distance() - (p - self.target).dot(self.toward());
        let shrink = self.shrink(depth).unwrap_or(1e-3);
        self.height_mm / f64::from(rect.height().max(1.0)) * shrink
    }

    /// The place under a point of the screen, as far from the eye as the target, mm.
    pub fn under(&self, at: Pos2, rect: Rect) -> Point3 {
        let scale = self.height_mm / f64::from(rect.height().max(1.0));
        let way = at - rect.center();
        self.target
            + self.right() * (f64::from(way.x) * scale)
            + self.up() * (-f64::from(way.y) * scale)
    }

    /// The line of sight through a point of the screen.
    pub fn ray(&self, at: Pos2, rect: Rect) -> Ray {
        let through = self.under(at, rect);
        let eye = self.target + self.toward() * self.distance();
        if self.perspective {
            Ray { from: eye, way: through - eye }
        } else {
            let back = self.toward() * self.distance();
            Ray { from: through + back, way: -back }
        }
    }

    /// Turns by a way of the hand: a picture's height is half a turn.
    pub fn orbit(&mut self, way: Vec2, rect: Rect) {
        let angle = PI / f64::from(rect.height().max(1.0));
        self.turn(-f64::from(way.x) * angle, f64::from(way.y) * angle);
    }

    /// Turns by angles, radians.
    pub fn turn(&mut self, yaw: f64, pitch: f64) {
        self.direction.yaw = (self.direction.yaw + yaw + PI).rem_euclid(2.0 * PI) - PI;
        self.direction.pitch = (self.direction.pitch + pitch).clamp(-FRAC_PI_2, FRAC_PI_2);
    }

    /// Shifts by a way of the hand: what is at the target stays under it.
    pub fn pan(&mut self, way: Vec2, rect: Rect) {
        let scale = self.height_mm / f64::from(rect.height().max(1.0));
        self.target += self.right() * (-f64::from(way.x) * scale);
        self.target += self.up() * (f64::from(way.y) * scale);
    }

    /// Makes things larger by a factor, keeping what is under a point of the screen there.
    pub fn zoom(&mut self, factor: f64, at: Pos2, rect: Rect) {
        if !(factor.is_finite() && factor > 0.0) {
            return;
        }
        let fixed = self.under(at, rect);
        let height = (self.height_mm / factor).clamp(HEIGHT_MIN, HEIGHT_MAX);
        self.target = fixed.lerp(self.target, height / self.height_mm);
        self.height_mm = height;
    }

    /// Brings a box of points into sight, seen from where it looks now.
    pub fn fit(&mut self, points: &[Point3], rect: Rect) {
        if points.is_empty() || !rect.is_positive() {
            return;
        }
        let axes = [self.right(), self.up(), self.toward()];
        let mut low = Vec3::splat(f64::INFINITY);
        let mut high = Vec3::splat(f64::NEG_INFINITY);
        for p in points {
            let seen = Vec3::from_array(axes.map(|axis| p.to_vec().dot(axis)));
            low = low.min(seen);
            high = high.max(seen);
        }
        let size = high - low;
        let aspect = f64::from(rect.width() / rect.height());
        let height = size.y.max(size.x / aspect).max(1e-2 * size.z);
        // What is near the eye is larger in perspective.
        let near = if self.perspective { 0.5 * size.z * 2.0 * sin(0.5 * FIELD) } else { 0.0 };
        self.height_mm = ((height + near) * MARGIN).clamp(HEIGHT_MIN, HEIGHT_MAX);
        let middle = (low + high) * 0.5;
        self.target =
            Point3::from_vec(axes[0] * middle.x + axes[1] * middle.y + axes[2] * middle.z);
    }

    /// A part of the way to another view, for a turn that the eye can follow.
    pub fn on_the_way(&self, to: &Self, share: f64) -> Self {
        Self {
            target: self.target.lerp(to.target, share),
            direction: self.direction.toward(to.direction, share),
            height_mm: self.height_mm + share * (to.height_mm - self.height_mm),
            perspective: to.perspective,
        }
    }
}

/// Degrees that an arrow key turns by.
pub const ARROW_TURN: f64 = 10.0 * PI / 180.0;

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::pos2;
    use sheetwright::math::from_deg;

    fn rect() -> Rect {
        Rect::from_min_size(pos2(100.0, 50.0), Vec2::new(640.0, 480.0))
    }

    #[test]
    fn a_ray_goes_through_what_is_seen() {
        for perspective in [false, true] {
            let camera = Camera { perspective, ..Camera::default() };
            let p = Point3::new(120.0, -80.0, 200.0);
            let seen = camera.seen(p, rect()).unwrap();
            let ray = camera.ray(seen.at, rect());
            let off = (p - ray.from).cross(ray.way).length() / ray.way.length();
            assert!(off < 0.05, "{off} mm beside the ray");
        }
    }

    #[test]
    fn plans_lie_as_they_are_drawn() {
        use crate::document::Plan;
        for plan in Plan::ALL {
            let camera =
                Camera { direction: Direction::towards(plan.normal()), ..Camera::default() };
            let right = Point3::from_vec(camera.right());
            let up = Point3::from_vec(camera.up());
            assert!((plan.flat(right).x - 1.0).abs() < 1e-12, "{plan:?}");
            assert!((plan.flat(up).y - 1.0).abs() < 1e-12, "{plan:?}");
            assert!((camera.toward() - plan.normal()).length() < 1e-12, "{plan:?}");
        }
    }

    #[test]
    fn zooming_keeps_what_is_under_the_hand() {
        for perspective in [false, true] {
            let mut camera = Camera { perspective, ..Camera::default() };
            let at = pos2(200.0, 100.0);
            let under = camera.under(at, rect());
            camera.zoom(3.0, at, rect());
            let now = camera.seen(under, rect()).unwrap().at;
            assert!(now.distance(at) < 1e-2, "{now:?}");
            assert!((camera.height_mm - 1000.0 / 3.0).abs() < 1e-9);
        }
    }

    #[test]
    fn what_fits_is_in_the_picture() {
        let corners: Vec<Point3> = (0..8)
            .map(|n| {
                let of = |bit: i32, size: f64| if n >> bit & 1 == 1 { size } else { 0.0 };
                Point3::new(of(0, 3000.0), of(1, 800.0), of(2, 500.0))
            })
            .collect();
        for perspective in [false, true] {
            let mut camera = Camera { perspective, ..Camera::default() };
            camera.fit(&corners, rect());
            for &corner in &corners {
                let seen = camera.seen(corner, rect()).unwrap();
                assert!(rect().contains(seen.at), "{corner:?} at {:?}", seen.at);
            }
        }
    }

    #[test]
    fn a_turn_goes_the_short_way_round() {
        let from = Direction { yaw: from_deg(170.0), pitch: 0.0 };
        let to = Direction { yaw: from_deg(-170.0), pitch: 0.0 };
        assert!((from.toward(to, 0.5).yaw - PI).abs() < 1e-12);
    }

    #[test]
    fn what_shows_its_back_is_looked_at_from_the_other_side() {
        let camera = Camera::default();
        assert_eq!(camera.facing(camera.toward()), camera.direction);
        assert_eq!(camera.facing(Vec3::new(0.0, 0.0, 0.0)), camera.direction, "no tangent plane");
        let normal = -camera.toward();
        let turned = Camera { direction: camera.facing(normal), ..camera };
        assert!(turned.toward().dot(normal) > 1.0 - 1e-12);
    }
}
