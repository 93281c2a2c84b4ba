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

    /// The span up to `t` and from there on (de Casteljau).
    pub fn halves(&self, t: f64) -> [Self; 2] {
        let [a, b, c, d] = self.control;
        let (ab, bc, cd) = (a.lerp(b, t), b.lerp(c, t), c.lerp(d, t));
        let (abc, bcd) = (ab.lerp(bc, t), bc.lerp(cd, t));
        let middle = abc.lerp(bcd, t);
        [Self { control: [a, ab, abc, middle] }, Self { control: [middle, bcd, cd, d] }]
    }

    /// The parameter of the point of the span that lies nearest to `p`: of 17 points spread over
    /// it the nearest, improved by Newton's method.
    pub fn nearest(&self, p: Point3) -> f64 {
        const STEPS: usize = 16;
        let off = |t: f64| self.position(t).distance(p);
        let tried = (0..=STEPS).map(|n| n as f64 / STEPS as f64);
        let mut best = tried.reduce(|best, t| if off(t) < off(best) { t } else { best });
        let mut t = best.unwrap_or(0.0);
        for _ in 0..STEPS {
            let (way, first) = (self.position(t) - p, self.derivative(t));
            let slope = first.length_squared() + way.dot(self.second_derivative(t));
            if slope <= 0.0 {
                break;
            }
            t = (t - way.dot(first) / slope).clamp(0.0, 1.0);
            best = best.map(|best| if off(t) < off(best) { t } else { best });
        }
        best.unwrap_or(0.0)
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
    fn halves_join_where_the_nearest_point_is() {
        let p = Point3::new;
        let span = Cubic { control: [p(0., 0., 0.), p(1., 2., 0.), p(3., -1., 2.), p(4., 1., 1.)] };
        for t in [0.1, 0.37, 0.9] {
            assert!((span.nearest(span.position(t)) - t).abs() < 1e-9);
            let [first, second] = span.halves(t);
            assert!(first.position(1.0).distance(span.position(t)) < 1e-14);
            assert!(first.position(0.5).distance(span.position(0.5 * t)) < 1e-14);
            assert!(second.position(0.5).distance(span.position(0.5 + 0.5 * t)) < 1e-14);
        }
        assert_eq!((span.nearest(p(-3., -3., 0.)), span.nearest(p(9., 3., 0.))), (0.0, 1.0));
    }

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
