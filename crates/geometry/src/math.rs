//! Points, vectors and frames: the only file that names the crate of vectors; [`sparse`] alone
//! names that of sparse systems.
//!
//! A point is a place and a vector a displacement; the difference of two points is a vector. Every
//! transcendental function of the kernel stands here and comes from the `libm` crate, so that a
//! design gives the same bits in the browser, on the desktop and on every processor.

pub mod sparse;

use std::ops::{Add, AddAssign, Sub};

/// A vector in space, in mm unless it is a direction.
pub type Vec3 = glam::DVec3;
/// A vector in the plane of a flat pattern or of a projection, in mm unless it is a direction.
pub type Vec2 = glam::DVec2;

/// A place in space, in mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point3 {
    /// First coordinate, mm.
    pub x: f64,
    /// Second coordinate, mm.
    pub y: f64,
    /// Third coordinate, mm.
    pub z: f64,
}

/// A place in a plane, in mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point2 {
    /// First coordinate, mm.
    pub x: f64,
    /// Second coordinate, mm.
    pub y: f64,
}

impl Point3 {
    /// The point (x, y, z).
    pub const fn new(x: f64, y: f64, z: f64) -> Self {
        Self { x, y, z }
    }

    /// The way from the origin to this point.
    pub fn to_vec(self) -> Vec3 {
        Vec3::new(self.x, self.y, self.z)
    }

    /// The point at the displacement `way` from the origin.
    pub fn from_vec(way: Vec3) -> Self {
        Self::new(way.x, way.y, way.z)
    }

    /// Distance to another point, mm.
    pub fn distance(self, other: Self) -> f64 {
        (other - self).length()
    }

    /// Distance to the segment between two points, mm; to the first where both are one.
    pub fn distance_to_segment(self, [a, b]: [Self; 2]) -> f64 {
        let along = b - a;
        let share = (self - a).dot(along) / along.length_squared();
        self.distance(a.lerp(b, if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }))
    }

    /// The point that lies `t` of the way to another one: 0 here, 1 there.
    pub fn lerp(self, other: Self, t: f64) -> Self {
        self + (other - self) * t
    }

    /// Whether all three coordinates are finite numbers.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }
}

impl Point2 {
    /// The point (x, y).
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The way from the origin to this point.
    pub fn to_vec(self) -> Vec2 {
        Vec2::new(self.x, self.y)
    }

    /// Distance to another point, mm.
    pub fn distance(self, other: Self) -> f64 {
        (other - self).length()
    }

    /// Distance to the segment between two points, mm; to the first where both are one.
    pub fn distance_to_segment(self, [a, b]: [Self; 2]) -> f64 {
        let along = b - a;
        let share = (self - a).dot(along) / along.length_squared();
        self.distance(a.lerp(b, if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }))
    }

    /// The point that lies `t` of the way to another one: 0 here, 1 there.
    pub fn lerp(self, other: Self, t: f64) -> Self {
        self + (other - self) * t
    }
}

impl Sub for Point3 {
    type Output = Vec3;
    fn sub(self, from: Self) -> Vec3 {
        Vec3::new(self.x - from.x, self.y - from.y, self.z - from.z)
    }
}

impl Add<Vec3> for Point3 {
    type Output = Self;
    fn add(self, way: Vec3) -> Self {
        Self::new(self.x + way.x, self.y + way.y, self.z + way.z)
    }
}

impl AddAssign<Vec3> for Point3 {
    fn add_assign(&mut self, way: Vec3) {
        *self = *self + way;
    }
}

impl Sub for Point2 {
    type Output = Vec2;
    fn sub(self, from: Self) -> Vec2 {
        Vec2::new(self.x - from.x, self.y - from.y)
    }
}

impl Add<Vec2> for Point2 {
    type Output = Self;
    fn add(self, way: Vec2) -> Self {
        Self::new(self.x + way.x, self.y + way.y)
    }
}

/// Three unit vectors at right angles, right-handed, and an origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The origin of the frame, mm.
    pub origin: Point3,
    /// First unit direction.
    pub x: Vec3,
    /// Second unit direction.
    pub y: Vec3,
    /// Third unit direction, x × y: the normal of the plane that x and y span.
    pub z: Vec3,
}

impl Frame {
    /// A frame at `origin` whose third direction is `normal`; `None` where `normal` has no
    /// direction. The first direction is made from the coordinate axis that `normal` is farthest
    /// from, the first of equals, so that the same normal always gives the same frame.
    pub fn with_normal(origin: Point3, normal: Vec3) -> Option<Self> {
        let z = unit(normal)?;
        let a = z.abs();
        let axis = if a.x <= a.y && a.x <= a.z {
            Vec3::X
        } else if a.y <= a.z {
            Vec3::Y
        } else {
            Vec3::Z
        };
        let x = unit(axis - z * axis.dot(z))?;
        Some(Self { origin, x, y: z.cross(x), z })
    }

    /// The coordinates of a point along x and y, mm: its orthogonal projection on the frame's
    /// plane.
    pub fn project(&self, point: Point3) -> Point2 {
        let way = point - self.origin;
        Point2::new(way.dot(self.x), way.dot(self.y))
    }
}

/// The direction of a vector; `None` where it is zero or not finite.
pub fn unit(vector: Vec3) -> Option<Vec3> {
    // Scaled first, so that neither very long nor very short vectors leave the range of f64.
    let scale = vector.abs().max_element();
    if !(scale > 0.0 && vector.is_finite()) {
        return None;
    }
    let scaled = vector / scale;
    Some(scaled / scaled.length())
}

/// The direction of a vector in the plane; `None` where it is zero or not finite.
pub fn unit2(vector: Vec2) -> Option<Vec2> {
    unit(vector.extend(0.0)).map(|u| u.truncate())
}

/// The angle between two vectors, radians in 0 ..= π; exact to rounding near both ends, where an
/// arc cosine is not. 0 where one of them is zero.
pub fn angle_between(a: Vec3, b: Vec3) -> f64 {
    atan2(a.cross(b).length(), a.dot(b))
}

/// Radians from degrees.
pub fn from_deg(degrees: f64) -> f64 {
    degrees * (std::f64::consts::PI / 180.0)
}

/// Degrees from radians.
pub fn to_deg(radians: f64) -> f64 {
    radians * (180.0 / std::f64::consts::PI)
}

/// Sine of an angle in radians, the same bits on every platform.
pub fn sin(radians: f64) -> f64 {
    libm::sin(radians)
}

/// Cosine of an angle in radians, the same bits on every platform.
pub fn cos(radians: f64) -> f64 {
    libm::cos(radians)
}

/// `base` to a power, the same bits on every platform.
pub fn pow(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// The natural logarithm, the same bits on every platform.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// The angle of the direction (x, y), radians in −π ..= π, the same bits on every platform.
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// The vector `v` turned about the unit direction `axis` by `angle` radians (Rodrigues).
pub fn turned(v: Vec3, axis: Vec3, angle: f64) -> Vec3 {
    let (s, c) = (sin(angle), cos(angle));
    v * c + axis.cross(v) * s + axis * (axis.dot(v) * (1.0 - c))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_is_right_handed_for_every_normal() {
        for n in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(-1.0, 2.0, 0.5), Vec3::new(0.0, -1e-9, 0.0)]
        {
            let f = Frame::with_normal(Point3::default(), n).unwrap();
            assert!((f.x.cross(f.y) - f.z).length() < 1e-15);
            assert!(f.z.dot(n) > 0.0);
        }
        assert!(Frame::with_normal(Point3::default(), Vec3::ZERO).is_none());
    }

    #[test]
    fn unit_survives_the_ends_of_the_range() {
        assert_eq!(unit(Vec3::new(1e300, 0.0, 0.0)), Some(Vec3::X));
        assert_eq!(unit(Vec3::new(0.0, 1e-300, 0.0)), Some(Vec3::Y));
        assert_eq!(unit(Vec3::ZERO), None);
        assert_eq!(unit(Vec3::new(f64::NAN, 1.0, 0.0)), None);
    }

    #[test]
    fn small_angles_keep_their_digits() {
        let a = angle_between(Vec3::X, Vec3::new(1.0, 1e-10, 0.0));
        assert!((a - 1e-10).abs() < 1e-24);
    }
}
