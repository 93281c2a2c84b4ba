//! The curve families that programs of this field are compared on; their sizes are near 1 in the
//! papers, and hundreds of mm here.

use crate::developable::{Blob, Cone, Cylinder};
use crate::random::Random;
use crate::trace::{Trace, samples_along};
use sheetwright::boundary::Boundary;
use sheetwright::math::{Point3, cos, sin};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, TAU};

/// A family of boundaries: one for every number of samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// (cos t, sin t, 0.3 sin 3t).
    Wavy,
    /// A piece of a cylinder, |angle| ≤ 60°, |z| ≤ 0.8 radii, with four corners.
    CylinderPatch,
    /// A closed smooth curve on a cylinder.
    CylinderBlob,
    /// A closed smooth curve on a circular cone.
    Cone,
    /// A strip 4 × 1, turned by 90° about its axis, with four corners.
    TwistedStrip,
    /// A random smooth closed curve: a Fourier series of order 5 about a circle, amplitudes about
    /// 1/k²; the number is the seed.
    Fourier(u64),
}

impl Family {
    /// All of them, with three random curves.
    pub const ALL: [Self; 8] = [
        Self::Wavy,
        Self::CylinderPatch,
        Self::CylinderBlob,
        Self::Cone,
        Self::TwistedStrip,
        Self::Fourier(1),
        Self::Fourier(2),
        Self::Fourier(3),
    ];

    /// Its name, as tables print it.
    pub fn name(self) -> String {
        match self {
            Self::Wavy => "wavy".to_owned(),
            Self::CylinderPatch => "cylinder patch".to_owned(),
            Self::CylinderBlob => "cylinder blob".to_owned(),
            Self::Cone => "cone".to_owned(),
            Self::TwistedStrip => "twisted strip".to_owned(),
            Self::Fourier(seed) => format!("random curve {seed}"),
        }
    }

    /// Its boundary of m samples.
    pub fn boundary(self, m: usize) -> Boundary {
        let radius = 100.0;
        match self {
            Self::Wavy => closed(m, &|t| {
                let t = TAU * t;
                Point3::new(radius * cos(t), radius * sin(t), 0.3 * radius * sin(3.0 * t))
            }),
            Self::CylinderPatch => four_sided(m, [2.0 * FRAC_PI_3, 1.6], &|u, v| {
                let angle = u - FRAC_PI_3;
                Point3::new(radius * cos(angle), radius * sin(angle), radius * (v - 0.8))
            }),
            Self::CylinderBlob => {
                let surface = Box::new(Cylinder { radius });
                let (middle, half) = ([0.0, 0.0], [1.0, 0.8 * radius]);
                Blob { surface, middle, half, wave: 0.1, name: "" }.boundary(m).0
            }
            Self::Cone => {
                let surface = Box::new(Cone { half_angle: 0.5 * FRAC_PI_3 });
                let (middle, half) = ([0.0, 2.0 * radius], [1.2, 0.8 * radius]);
                Blob { surface, middle, half, wave: 0.1, name: "" }.boundary(m).0
            }
            Self::TwistedStrip => four_sided(m, [4.0, 1.0], &|u, v| {
                let (turn, across) = (FRAC_PI_2 * u / 4.0, v - 0.5);
                Point3::new(radius * u, radius * across * cos(turn), radius * across * sin(turn))
            }),
            Self::Fourier(seed) => fourier(m, seed, radius),
        }
    }
}

fn closed(m: usize, point: &dyn Fn(f64) -> Point3) -> Boundary {
    let samples = samples_along(&Trace { point, corners: vec![] }, m);
    Boundary::new(vec![samples.into_iter().map(|(_, s)| s).collect()])
        .expect("the families are boundaries")
}

/// The boundary of the image of the rectangle 0 ..= size[0] by 0 ..= size[1].
fn four_sided(m: usize, size: [f64; 2], map: &dyn Fn(f64, f64) -> Point3) -> Boundary {
    let point = |t: f64| {
        let t = t.rem_euclid(1.0) * 4.0;
        let (side, share) = (t.floor().min(3.0), t - t.floor().min(3.0));
        match side as usize {
            0 => map(share * size[0], 0.0),
            1 => map(size[0], share * size[1]),
            2 => map((1.0 - share) * size[0], size[1]),
            _ => map(0.0, (1.0 - share) * size[1]),
        }
    };
    let samples = samples_along(&Trace { point: &point, corners: vec![0.0, 0.25, 0.5, 0.75] }, m);
    Boundary::new(vec![samples.into_iter().map(|(_, s)| s).collect()])
        .expect("the families are boundaries")
}

fn fourier(m: usize, seed: u64, radius: f64) -> Boundary {
    let mut random = Random::new(seed);
    // For each order, amplitudes of sine and cosine in x, y, z.
    let waves: Vec<[f64; 6]> = (1..=5)
        .map(|k| {
            let size = f64::from(k * k);
            std::array::from_fn(|_| random.between(-1.0, 1.0) / size)
        })
        .collect();
    closed(m, &|t| {
        let mut at = [cos(TAU * t), sin(TAU * t), 0.0];
        for (k, wave) in (1..).zip(&waves) {
            let (s, c) = (sin(TAU * t * f64::from(k)), cos(TAU * t * f64::from(k)));
            for axis in 0..3 {
                at[axis] += wave[2 * axis] * s + wave[2 * axis + 1] * c;
            }
        }
        Point3::new(radius * at[0], radius * at[1], radius * at[2])
    })
}
