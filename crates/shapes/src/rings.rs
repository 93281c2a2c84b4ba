//! Known developable surfaces with holes: rings between two circles, with and without windows.

use crate::developable::{Cone, Cylinder, Developable, ObliqueCone};
use crate::trace::{Trace, samples_along};
use sheetwright::boundary::Boundary;
use sheetwright::curve::Sample;
use sheetwright::math::{Point3, cos, sin};
use std::f64::consts::{FRAC_PI_3, TAU};

/// A loop in the parameters (u, v) of a developable surface.
#[derive(Clone, Copy, Debug)]
pub enum Loop {
    /// Once round the axis at this v, in the direction of u: the lower end of a ring.
    Round(f64),
    /// Once round the axis at this v, against the direction of u: the upper end of a ring.
    Back(f64),
    /// An ellipse about `middle` with these half axes, counter-clockwise: an outline.
    Outline {
        /// Its middle.
        middle: [f64; 2],
        /// Its half axes.
        half: [f64; 2],
    },
    /// A rectangle about `middle` with these half sides, counter-clockwise: an outline with four
    /// corners, two of whose sides are rulings.
    Patch {
        /// Its middle.
        middle: [f64; 2],
        /// Half its sides.
        half: [f64; 2],
    },
    /// An ellipse about `middle` with these half axes, clockwise.
    Window {
        /// Its middle.
        middle: [f64; 2],
        /// Its half axes.
        half: [f64; 2],
    },
}

impl Loop {
    /// The parameters on the surface at `t` in 0 ..= 1.
    pub fn parameters(self, t: f64) -> [f64; 2] {
        match self {
            Self::Round(v) => [TAU * t, v],
            Self::Back(v) => [TAU * (1.0 - t), v],
            Self::Outline { middle, half } => on_ellipse(middle, half, TAU * t),
            Self::Window { middle, half } => on_ellipse(middle, half, -TAU * t),
            Self::Patch { middle, half } => {
                let t = t.rem_euclid(1.0) * 4.0;
                let side = t.floor().min(3.0);
                let along = 2.0 * (t - side) - 1.0;
                let [x, y] = match side as usize {
                    0 => [along, -1.0],
                    1 => [1.0, along],
                    2 => [-along, 1.0],
                    _ => [-1.0, -along],
                };
                [middle[0] + half[0] * x, middle[1] + half[1] * y]
            }
        }
    }

    fn corners(self) -> Vec<f64> {
        match self {
            Self::Patch { .. } => vec![0.0, 0.25, 0.5, 0.75],
            _ => vec![],
        }
    }
}

fn on_ellipse(middle: [f64; 2], half: [f64; 2], angle: f64) -> [f64; 2] {
    [middle[0] + half[0] * cos(angle), middle[1] + half[1] * sin(angle)]
}

/// A developable surface between some loops.
pub struct Pierced {
    /// Name, as tables print it.
    pub name: &'static str,
    /// The surface on which it lies.
    pub surface: Box<dyn Developable>,
    /// Its loops, the outer one first.
    pub loops: Vec<Loop>,
}

/// A boundary with the parameters of its samples.
pub struct Sampled {
    /// The boundary.
    pub boundary: Boundary,
    /// The parameters of its samples on the surface; u counts on round the axis.
    pub parameters: Vec<[f64; 2]>,
    /// The largest distance between two neighbours, mm.
    pub spacing: f64,
}

/// Steps that a loop's length and area are measured in.
const STEPS: usize = 1_000;

impl Pierced {
    fn space(&self, of_loop: Loop, t: f64) -> Point3 {
        let [u, v] = of_loop.parameters(t);
        self.surface.space(u, v)
    }

    fn length(&self, of_loop: Loop) -> f64 {
        let at = |n: usize| self.space(of_loop, n as f64 / STEPS as f64);
        (0..STEPS).map(|n| at(n).distance(at(n + 1))).sum()
    }

    /// Whether it runs round its axis, from one end to another: then it has no supporting plane.
    pub fn has_ends(&self) -> bool {
        matches!(self.loops[0], Loop::Round(_))
    }

    /// Whether it runs round its axis and has windows.
    pub fn is_tube_with_windows(&self) -> bool {
        self.has_ends() && self.loops.len() > 2
    }

    /// Whether its outline runs along rulings in places. A sample there has no ruling to a sample
    /// elsewhere, and its rungs lead to the nearest column of samples.
    pub fn has_straight_sides(&self) -> bool {
        matches!(self.loops[0], Loop::Patch { .. })
    }

    /// A boundary of about m samples, at one spacing.
    pub fn sampled(&self, m: usize) -> Sampled {
        let lengths: Vec<f64> = self.loops.iter().map(|&l| self.length(l)).collect();
        let whole: f64 = lengths.iter().sum();
        let (mut loops, mut parameters) = (Vec::new(), Vec::new());
        for (&of_loop, length) in self.loops.iter().zip(&lengths) {
            let count = ((m as f64 * length / whole).round() as usize).max(3);
            let point = |t: f64| self.space(of_loop, t);
            let trace = Trace { point: &point, corners: of_loop.corners() };
            let (ts, samples): (Vec<f64>, Vec<Sample>) =
                samples_along(&trace, count).into_iter().unzip();
            parameters.extend(ts.into_iter().map(|t| of_loop.parameters(t)));
            loops.push(samples);
        }
        let boundary = Boundary::new(loops).expect("known surfaces are bounded by boundaries");
        let at = boundary.positions();
        let spacing =
            (0..at.len()).map(|i| at[i].distance(at[boundary.next(i)])).fold(0.0, f64::max);
        Sampled { boundary, parameters, spacing }
    }

    /// Its area, mm²: half the sum of x dy − y dx round the development, cut open from end to end
    /// at u = 0 where it is a ring. Accurate to a hundred-thousandth.
    pub fn area(&self) -> f64 {
        let of_cut = |low: Loop, high: Loop, t: f64| {
            let flat = |[u, v]: [f64; 2]| self.surface.flat(u, v);
            let (a, b) = (flat(low.parameters(t)), flat(high.parameters(1.0 - t)));
            0.5 * a.to_vec().perp_dot(b.to_vec())
        };
        let of_loop = |&l: &Loop| -> f64 {
            let flat = |n: usize| {
                let [u, v] = l.parameters(n as f64 / STEPS as f64);
                self.surface.flat(u, v).to_vec()
            };
            let mut before = flat(0);
            let mut doubled = 0.0;
            for n in 1..=STEPS {
                let here = flat(n);
                doubled += before.perp_dot(here);
                before = here;
            }
            0.5 * doubled
        };
        let of_loops: f64 = self.loops.iter().map(of_loop).sum();
        match self.loops[..] {
            [low @ Loop::Round(_), high @ Loop::Back(_), ..] => {
                of_loops + of_cut(low, high, 1.0) - of_cut(low, high, 0.0)
            }
            _ => of_loops,
        }
    }
}

/// One of each kind: tubes whose ends project onto one another, so that there is no plane, and
/// patches that have one; sizes of some hundred mm, except the oblique cone with size 1.
pub fn pierced() -> Vec<Pierced> {
    let cylinder = || Box::new(Cylinder { radius: 300.0 });
    let ends = [Loop::Round(-300.0), Loop::Back(300.0)];
    let window = |u: f64, v: f64, half: [f64; 2]| Loop::Window { middle: [u, v], half };
    let one = [window(3.0, 20.0, [0.5, 120.0])];
    let three = [
        window(1.0, -60.0, [0.45, 110.0]),
        window(3.1, 90.0, [0.3, 90.0]),
        window(5.0, 10.0, [0.5, 140.0]),
    ];
    let one_in_patch = [window(0.1, 20.0, [0.4, 90.0])];
    let three_in_patch = [
        window(-0.6, -60.0, [0.2, 60.0]),
        window(0.05, 60.0, [0.25, 70.0]),
        window(0.65, -20.0, [0.2, 80.0]),
    ];
    let outline = Loop::Outline { middle: [0.0, 0.0], half: [1.2, 260.0] };
    let patch = Loop::Patch { middle: [0.0, 0.0], half: [FRAC_PI_3, 240.0] };
    let with = |outer: &[Loop], windows: &[Loop]| [outer, windows].concat();
    vec![
        Pierced {
            name: "frustum",
            surface: Box::new(Cone { half_angle: 0.5 * FRAC_PI_3 }),
            loops: vec![Loop::Round(400.0), Loop::Back(900.0)],
        },
        Pierced {
            name: "oblique cone",
            surface: Box::new(ObliqueCone { apex: Point3::new(0.8, 0.3, 2.0) }),
            loops: vec![Loop::Round(0.4), Loop::Back(1.0)],
        },
        Pierced { name: "tube, window", surface: cylinder(), loops: with(&ends, &one) },
        Pierced { name: "tube, three windows", surface: cylinder(), loops: with(&ends, &three) },
        Pierced {
            name: "oval, window",
            surface: cylinder(),
            loops: with(&[outline], &one_in_patch),
        },
        Pierced {
            name: "oval, three windows",
            surface: cylinder(),
            loops: with(&[outline], &three_in_patch),
        },
        Pierced {
            name: "patch, window",
            surface: cylinder(),
            loops: with(&[patch], &one_in_patch),
        },
        Pierced {
            name: "patch, three windows",
            surface: cylinder(),
            loops: with(&[patch], &three_in_patch),
        },
    ]
}
