//! One cubic span, in Bézier form.

use crate::math::{Point3, Vec3, unit};

/// A cubic Bézier span over the parameter 0 ..= 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cubic {
    /// The four control points, mm; the span begins at the first and ends at the last.
    pub control: [Point3; 4],
}

impl Cubic {
    /// The straight span from `a` to `b`, run at constant speed.
    pub fn line(a: Point3, b: Point3) -> Self {
        Self { control: [a, a.lerp(b, 1.0 / 3.0), a.lerp(b, 2.0 / 3.0), b] }
    }

    /// The span with these ends and these derivatives at them, both by the span's own parameter.
    pub fn hermite(a: Point3, a_derivative: Vec3, b: Point3, b_derivative: Vec3) -> Self {
        Self { control: [a, a + a_derivative / 3.0, b + b_derivative / -3.0, b] }
    }

    /// The point at `t`, mm. Exactly the end points at 0 and at 1.
    pub fn position(&self, t: f64) -> Point3 {
        let [a, b, c, d] = self.control;
        if t == 1.0 {
            return d;
        }
        let s = 1.0 - t;
        let way = (b - a) * (3.0 * s * s * t) + (c - a) * (3.0 * s * t * t) + (d - a) * (t * t * t);
        a + way
    }

    /// The derivative by the parameter at `t`, mm.
    pub fn derivative(&self, t: f64) -> Vec3 {
        let [a, b, c, d] = self.control;
        let s = 1.0 - t;
        ((b - a) * (s * s) + (c - b) * (2.0 * s * t) + (d - c) * (t * t)) * 3.0
    }

    /// The second derivative by the parameter at `t`, mm.
    pub fn second_derivative(&self, t: f64) -> Vec3 {
        let [a, b, c, d] = self.control;
        (((c - b) - (b - a)) * (1.0 - t) + ((d - c) - (c - b)) * t) * 6.0
    }

    /// The unit tangent at `t`. Where the derivative vanishes it is the limit from inside the span
    /// (from the second derivative, else from the chord); a span without extent has none: zero.
    pub fn tangent(&self, t: f64) -> Vec3 {
        let inwards = if t > 0.5 { -1.0 } else { 1.0 };
        unit(self.derivative(t))
            .or_else(|| unit(self.second_derivative(t) * inwards))
            .or_else(|| unit(self.control[3] - self.control[0]))
            .unwrap_or(Vec3::ZERO)
    }

    /// The span run the other way.
    pub fn reversed(&self) -> Self {
        let [a, b, c, d] = self.control;
        Self { control: [d, c, b, a] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tangent_at_a_doubled_control_point_is_the_limit() {
        let a = Point3::new(0.0, 0.0, 0.0);
        let c = Point3::new(1.0, 1.0, 0.0);
        let d = Point3::new(2.0, 0.0, 0.0);
        let span = Cubic { control: [a, a, c, d] };
        let (start, near) = (span.tangent(0.0), span.tangent(1e-9));
        assert!((start - near).length() < 1e-6);
        let span = span.reversed();
        assert!((span.tangent(1.0) - span.tangent(1.0 - 1e-9)).length() < 1e-6);
    }
}
