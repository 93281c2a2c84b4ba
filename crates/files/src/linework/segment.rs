//! A piece of a curve as a drawing has it: a straight line, an arc of an ellipse in space, or a
//! Bézier curve of any degree with weights. All three keep their form under affine maps, so groups,
//! blocks and views of a drawing are maps of their points.

use sheetwright::math::{Point3, Vec3, cos, sin, unit};

/// An affine map: the images of the three axes and of the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine {
    pub(super) axes: [Vec3; 3],
    pub(super) origin: Vec3,
}

impl Affine {
    pub(super) const IDENTITY: Self =
        Self { axes: [Vec3::X, Vec3::Y, Vec3::Z], origin: Vec3::ZERO };

    pub(super) fn translation(by: Vec3) -> Self {
        Self { origin: by, ..Self::IDENTITY }
    }

    pub(super) fn scale(by: Vec3) -> Self {
        let axes = [Vec3::X * by.x, Vec3::Y * by.y, Vec3::Z * by.z];
        Self { axes, origin: Vec3::ZERO }
    }

    /// A turn about z by an angle in radians, counter-clockwise.
    pub(super) fn turn(angle: f64) -> Self {
        let (s, c) = (sin(angle), cos(angle));
        Self { axes: [Vec3::new(c, s, 0.0), Vec3::new(-s, c, 0.0), Vec3::Z], origin: Vec3::ZERO }
    }

    /// The image of a direction.
    pub(super) fn way(&self, v: Vec3) -> Vec3 {
        self.axes[0] * v.x + self.axes[1] * v.y + self.axes[2] * v.z
    }

    pub(super) fn place(&self, p: Point3) -> Point3 {
        Point3::from_vec(self.way(p.to_vec()) + self.origin)
    }

    /// `inner` first, then this one.
    pub(super) fn after(&self, inner: &Self) -> Self {
        let origin = self.way(inner.origin) + self.origin;
        Self { axes: inner.axes.map(|axis| self.way(axis)), origin }
    }

    pub(super) fn is_finite(&self) -> bool {
        self.origin.is_finite() && self.axes.iter().all(|axis| axis.is_finite())
    }
}

/// A piece of a curve, over the parameter 0 ..= 1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Segment {
    form: Form,
    /// How far its ends are moved so that they meet others; points between move by their share.
    moved: [Vec3; 2],
}

#[derive(Clone, Debug, PartialEq)]
enum Form {
    Line([Point3; 2]),
    /// The points c + u cos α + v sin α, for α from the first angle to the second, radians.
    Arc {
        centre: Point3,
        u: Vec3,
        v: Vec3,
        angles: [f64; 2],
    },
    /// The control points times their weights, each with its weight.
    Bezier(Vec<[f64; 4]>),
}

impl Segment {
    pub(super) fn line(a: Point3, b: Point3) -> Self {
        Self::of(Form::Line([a, b]))
    }

    /// The arc of the ellipse with these conjugate radii, from one angle to another, radians.
    pub(super) fn arc(centre: Point3, u: Vec3, v: Vec3, angles: [f64; 2]) -> Self {
        Self::of(Form::Arc { centre, u, v, angles })
    }

    /// The Bézier curve with these control points, two or more.
    pub(super) fn bezier(points: &[Point3]) -> Self {
        Self::of(Form::Bezier(points.iter().map(|p| [p.x, p.y, p.z, 1.0]).collect()))
    }

    /// The rational Bézier curve with these control points times their weights, two or more.
    pub(super) fn rational(points: Vec<[f64; 4]>) -> Self {
        Self::of(Form::Bezier(points))
    }

    fn of(form: Form) -> Self {
        Self { form, moved: [Vec3::ZERO; 2] }
    }

    pub(super) fn is_line(&self) -> bool {
        matches!(self.form, Form::Line(_))
    }

    /// In how many parts its fitting begins.
    pub(super) fn parts(&self) -> usize {
        match &self.form {
            Form::Line(_) => 1,
            Form::Arc { angles: [from, to], .. } => {
                ((to - from).abs() / std::f64::consts::FRAC_PI_6).ceil().clamp(2.0, 64.0) as usize
            }
            Form::Bezier(points) => (2 * points.len()).clamp(4, 64),
        }
    }

    pub(super) fn start(&self) -> Point3 {
        self.position(0.0)
    }

    pub(super) fn end(&self) -> Point3 {
        self.position(1.0)
    }

    pub(super) fn position(&self, t: f64) -> Point3 {
        let shift = self.moved[0] * (1.0 - t) + self.moved[1] * t;
        shift_of(self.point(t), shift)
    }

    fn point(&self, t: f64) -> Point3 {
        match &self.form {
            Form::Line([a, _]) if t == 0.0 => *a,
            Form::Line([_, b]) if t == 1.0 => *b,
            Form::Line([a, b]) => a.lerp(*b, t),
            Form::Arc { centre, u, v, angles: [from, to] } => {
                let angle = from + (to - from) * t;
                *centre + (*u * cos(angle) + *v * sin(angle))
            }
            Form::Bezier(points) => {
                let [x, y, z, w] = casteljau(points, t).0;
                Point3::new(x / w, y / w, z / w)
            }
        }
    }

    /// The derivative by the parameter.
    pub(super) fn derivative(&self, t: f64) -> Vec3 {
        let of_form = match &self.form {
            Form::Line([a, b]) => *b - *a,
            Form::Arc { u, v, angles: [from, to], .. } => {
                let angle = from + (to - from) * t;
                (*v * cos(angle) - *u * sin(angle)) * (to - from)
            }
            Form::Bezier(points) => {
                let ([x, y, z, w], [dx, dy, dz, dw]) = casteljau(points, t);
                (Vec3::new(dx, dy, dz) - Vec3::new(x, y, z) * (dw / w)) / w
            }
        };
        of_form + (self.moved[1] - self.moved[0])
    }

    /// The direction at an end: where control points coincide there, that of the chord to a point
    /// near it.
    pub(super) fn tangent_at_end(&self, is_end: bool) -> Vec3 {
        let t = if is_end { 1.0 } else { 0.0 };
        let chord = self.end().distance(self.start());
        let derivative = self.derivative(t);
        let is_clear = derivative.length() > 1e-6 * chord;
        let near = 1e-3;
        let by_chord = if is_end {
            self.position(1.0) - self.position(1.0 - near)
        } else {
            self.position(near) - self.position(0.0)
        };
        unit(if is_clear { derivative } else { by_chord }).unwrap_or(Vec3::ZERO)
    }

    pub(super) fn mapped(&self, map: &Affine) -> Self {
        let form = match &self.form {
            Form::Line(ends) => Form::Line(ends.map(|p| map.place(p))),
            Form::Arc { centre, u, v, angles } => Form::Arc {
                centre: map.place(*centre),
                u: map.way(*u),
                v: map.way(*v),
                angles: *angles,
            },
            Form::Bezier(points) => Form::Bezier(
                points
                    .iter()
                    .map(|&[x, y, z, w]| {
                        let p = map.way(Vec3::new(x, y, z)) + map.origin * w;
                        [p.x, p.y, p.z, w]
                    })
                    .collect(),
            ),
        };
        Self { form, moved: self.moved.map(|v| map.way(v)) }
    }

    pub(super) fn reversed(mut self) -> Self {
        match &mut self.form {
            Form::Line(ends) => ends.reverse(),
            Form::Arc { angles, .. } => angles.reverse(),
            Form::Bezier(points) => points.reverse(),
        }
        self.moved.reverse();
        self
    }

    /// Moves its end, or its start, to a point nearby.
    pub(super) fn move_end(&mut self, is_end: bool, to: Point3) {
        let which = usize::from(is_end);
        if let Form::Line(ends) = &mut self.form {
            ends[which] = to;
            return;
        }
        let now = if is_end { self.end() } else { self.start() };
        self.moved[which] += to - now;
    }
}

fn shift_of(p: Point3, shift: Vec3) -> Point3 {
    if shift == Vec3::ZERO { p } else { p + shift }
}

/// The point of a Bézier curve in four dimensions at `t`, and the derivative by `t` (de Casteljau).
fn casteljau(points: &[[f64; 4]], t: f64) -> ([f64; 4], [f64; 4]) {
    let between = |a: &[f64; 4], b: &[f64; 4]| {
        std::array::from_fn::<f64, 4, _>(|n| if t == 1.0 { b[n] } else { a[n] + (b[n] - a[n]) * t })
    };
    let mut level = points.to_vec();
    while level.len() > 2 {
        level = level.windows(2).map(|pair| between(&pair[0], &pair[1])).collect();
    }
    let degree = (points.len() - 1) as f64;
    let (a, b) = (level[0], level[level.len() - 1]);
    (between(&a, &b), std::array::from_fn(|n| (b[n] - a[n]) * degree))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

    #[test]
    fn a_quarter_of_a_circle_is_one_whichever_way_it_is_written() {
        let arc = Segment::arc(
            Point3::new(0.0, 0.0, 0.0),
            Vec3::X * 2.0,
            Vec3::Y * 2.0,
            [0.0, FRAC_PI_2],
        );
        let w = FRAC_1_SQRT_2;
        let conic = Segment::rational(vec![
            [2.0, 0.0, 0.0, 1.0],
            [2.0 * w, 2.0 * w, 0.0, w],
            [0.0, 2.0, 0.0, 1.0],
        ]);
        let map = Affine::turn(0.3).after(&Affine::scale(Vec3::new(1.0, 3.0, 1.0)));
        for segment in [arc, conic] {
            for n in 0..=10 {
                let t = f64::from(n) / 10.0;
                let p = segment.position(t);
                assert!((p.to_vec().length() - 2.0).abs() < 1e-14);
                assert!(p.to_vec().dot(segment.derivative(t)).abs() < 1e-13);
                let moved = segment.mapped(&map).position(t);
                assert!(moved.distance(map.place(p)) < 1e-14);
                assert!(segment.clone().reversed().position(1.0 - t).distance(p) < 1e-14);
            }
        }
    }

    #[test]
    fn an_end_that_moves_takes_its_neighbourhood_along() {
        let p = Point3::new;
        let mut bow =
            Segment::bezier(&[p(0., 0., 0.), p(1., 1., 0.), p(2., 1., 0.), p(3., 0., 0.)]);
        let middle = bow.position(0.5);
        bow.move_end(true, p(3.0, 0.0, 0.2));
        assert_eq!((bow.start(), bow.end()), (p(0., 0., 0.), p(3., 0., 0.2)));
        assert!(bow.position(0.5).distance(middle + Vec3::Z * 0.1) < 1e-15);
    }
}
