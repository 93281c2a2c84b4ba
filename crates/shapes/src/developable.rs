//! Developable surfaces whose development is known, and closed smooth curves on them.

use crate::trace::{Trace, samples_along};
use sheetwright::boundary::Boundary;
use sheetwright::math::{Point2, Point3, Vec3, atan2, cos, sin, unit};

/// A developable surface over parameters (u, v).
pub trait Developable {
    /// The point in space, mm.
    fn space(&self, u: f64, v: f64) -> Point3;
    /// The point of the development, mm.
    fn flat(&self, u: f64, v: f64) -> Point2;
    /// A direction along the ruling through the point.
    fn ruling(&self, u: f64, v: f64) -> Vec3;

    /// The bend radius at the point, mm: the distance to the next ruling over the angle by which
    /// the tangent plane turns; NaN where a ruling has no direction or runs along u. Accurate to a
    /// millionth, by differences of the second order.
    fn bend_radius(&self, u: f64, v: f64) -> f64 {
        const STEP: f64 = 1e-4;
        let along_u = |u: f64| (self.space(u + STEP, v) - self.space(u - STEP, v)) / (2.0 * STEP);
        let across = |u: f64| along_u(u).cross(unit(self.ruling(u, v)).unwrap_or(Vec3::NAN));
        let normal = |u: f64| unit(across(u)).unwrap_or(Vec3::NAN);
        let turn = (normal(u + STEP) - normal(u - STEP)).length() / (2.0 * STEP);
        across(u).length() / turn
    }
}

/// A cylinder of this radius, mm, about the axis z; u is the angle, v the height in mm.
pub struct Cylinder {
    /// Its radius, mm.
    pub radius: f64,
}

impl Developable for Cylinder {
    fn space(&self, u: f64, v: f64) -> Point3 {
        Point3::new(self.radius * cos(u), self.radius * sin(u), v)
    }
    fn flat(&self, u: f64, v: f64) -> Point2 {
        Point2::new(self.radius * u, v)
    }
    fn ruling(&self, _: f64, _: f64) -> Vec3 {
        Vec3::Z
    }
}

/// A circular cone with its apex at the origin and its axis along z; u is the angle about the axis,
/// v the distance from the apex, mm.
pub struct Cone {
    /// Angle between axis and rulings, radians.
    pub half_angle: f64,
}

impl Developable for Cone {
    fn space(&self, u: f64, v: f64) -> Point3 {
        Point3::from_vec(self.ruling(u, v) * v)
    }
    fn flat(&self, u: f64, v: f64) -> Point2 {
        // Clockwise, as the parameters run as seen from outside.
        let turn = -u * sin(self.half_angle);
        Point2::new(v * cos(turn), v * sin(turn))
    }
    fn ruling(&self, u: f64, _: f64) -> Vec3 {
        let (s, c) = (sin(self.half_angle), cos(self.half_angle));
        Vec3::new(s * cos(u), s * sin(u), c)
    }
}

/// A cone from an apex over a circle of radius 1 about the origin in the plane z = 0; u is the
/// angle on the circle, v the share of the way from the apex to the circle.
pub struct ObliqueCone {
    /// The apex.
    pub apex: Point3,
}

impl ObliqueCone {
    fn way(&self, u: f64) -> Vec3 {
        Point3::new(cos(u), sin(u), 0.0) - self.apex
    }
}

/// Steps of Simpson's rule for each radian of the oblique cone's development.
const SIMPSON_A_RADIAN: f64 = 400.0;

impl Developable for ObliqueCone {
    fn space(&self, u: f64, v: f64) -> Point3 {
        self.apex + self.way(u) * v
    }
    fn flat(&self, u: f64, v: f64) -> Point2 {
        // The development turns as fast as the direction of the rulings.
        let speed = |u: f64| {
            let (way, along) = (self.way(u), Vec3::new(-sin(u), cos(u), 0.0));
            way.cross(along).length() / way.length_squared()
        };
        let steps = 2 * ((u.abs() * SIMPSON_A_RADIAN).ceil() as usize).max(1);
        let h = u / steps as f64;
        let weight = |n: usize| match n {
            0 => 1.0,
            n if n == steps => 1.0,
            n if n % 2 == 1 => 4.0,
            _ => 2.0,
        };
        let turn: f64 = (0..=steps).map(|n| weight(n) * speed(n as f64 * h)).sum::<f64>() * h / 3.0;
        let r = v * self.way(u).length();
        Point2::new(r * cos(turn), -r * sin(turn))
    }
    fn ruling(&self, u: f64, _: f64) -> Vec3 {
        self.way(u)
    }
}

/// The tangent surface of a helix about the axis z; u is the angle on the helix, v the way along
/// its tangent, mm.
pub struct HelixTangents {
    /// Radius of the helix, mm.
    pub radius: f64,
    /// Its rise, mm a radian.
    pub rise: f64,
}

impl HelixTangents {
    fn speed(&self) -> f64 {
        (self.radius * self.radius + self.rise * self.rise).sqrt()
    }
}

impl Developable for HelixTangents {
    fn space(&self, u: f64, v: f64) -> Point3 {
        let foot = Point3::new(self.radius * cos(u), self.radius * sin(u), self.rise * u);
        foot + self.ruling(u, v) * v
    }
    fn flat(&self, u: f64, v: f64) -> Point2 {
        // The helix keeps its curvature r / (r² + h²) and becomes a circle.
        let radius = self.speed() * self.speed() / self.radius;
        let turn = self.speed() * u / radius;
        // Clockwise, as the parameters run as seen from outside.
        Point2::new(radius * cos(turn) - v * sin(turn), -radius * sin(turn) - v * cos(turn))
    }
    fn ruling(&self, u: f64, _: f64) -> Vec3 {
        Vec3::new(-self.radius * sin(u), self.radius * cos(u), self.rise) / self.speed()
    }
}

/// A closed smooth curve on a developable surface: an ellipse in its parameters, with a wave that
/// makes it concave in places.
pub struct Blob {
    /// The surface on which it lies.
    pub surface: Box<dyn Developable>,
    /// Middle of the ellipse.
    pub middle: [f64; 2],
    /// Its two half axes.
    pub half: [f64; 2],
    /// The height of the wave, as a share of the half axes.
    pub wave: f64,
    /// Name, as tables print it.
    pub name: &'static str,
}

impl Blob {
    /// The parameters on the surface at `t` in 0 ..= 1.
    pub fn parameters(&self, t: f64) -> [f64; 2] {
        let angle = std::f64::consts::TAU * t;
        let r = 1.0 + self.wave * cos(3.0 * angle);
        [
            self.middle[0] + self.half[0] * r * cos(angle),
            self.middle[1] + self.half[1] * r * sin(angle),
        ]
    }

    /// A boundary of m samples, and their parameters on the surface.
    pub fn boundary(&self, m: usize) -> (Boundary, Vec<[f64; 2]>) {
        let point = |t: f64| {
            let [u, v] = self.parameters(t);
            self.surface.space(u, v)
        };
        let (parameters, samples): (Vec<[f64; 2]>, Vec<_>) =
            samples_along(&Trace { point: &point, corners: vec![] }, m)
                .into_iter()
                .map(|(t, sample)| (self.parameters(t), sample))
                .unzip();
        let boundary = Boundary::new(vec![samples]).expect("a blob is a boundary");
        (boundary, parameters)
    }
}

/// One blob on each of the known surfaces; sizes of some hundred mm.
pub fn blobs() -> Vec<Blob> {
    let third = std::f64::consts::FRAC_PI_3;
    vec![
        Blob {
            surface: Box::new(Cylinder { radius: 300.0 }),
            middle: [0.0, 0.0],
            half: [1.0, 250.0],
            wave: 0.15,
            name: "cylinder",
        },
        Blob {
            surface: Box::new(Cone { half_angle: 0.5 * third }),
            middle: [0.0, 600.0],
            half: [1.2, 250.0],
            wave: 0.1,
            name: "cone",
        },
        Blob {
            surface: Box::new(ObliqueCone { apex: Point3::new(0.8, 0.3, 2.0) }),
            middle: [1.0, 0.6],
            half: [1.1, 0.25],
            wave: 0.1,
            name: "oblique cone",
        },
        Blob {
            surface: Box::new(HelixTangents { radius: 100.0, rise: 60.0 }),
            middle: [0.0, 260.0],
            half: [0.8, 100.0],
            wave: 0.1,
            name: "helix tangents",
        },
    ]
}

/// The largest distance, mm, between two lists of points in the plane after the rotation and
/// translation (no mirror) of one onto the other that is best by least squares.
pub fn largest_distance_after_fitting(a: &[Point2], b: &[Point2]) -> f64 {
    let middle = |list: &[Point2]| {
        let sum = list.iter().fold(Point2::default().to_vec(), |sum, p| sum + p.to_vec());
        sum / list.len() as f64
    };
    let (a_middle, b_middle) = (middle(a), middle(b));
    let (mut along, mut across) = (0.0, 0.0);
    for (p, q) in a.iter().zip(b) {
        let (p, q) = (p.to_vec() - a_middle, q.to_vec() - b_middle);
        along += p.dot(q);
        across += p.perp_dot(q);
    }
    let turn = atan2(across, along);
    let (s, c) = (sin(turn), cos(turn));
    a.iter()
        .zip(b)
        .map(|(p, q)| {
            let (p, q) = (p.to_vec() - a_middle, q.to_vec() - b_middle);
            let turned = Point2::new(c * p.x - s * p.y, s * p.x + c * p.y);
            turned.distance(Point2::new(q.x, q.y))
        })
        .fold(0.0, f64::max)
}
