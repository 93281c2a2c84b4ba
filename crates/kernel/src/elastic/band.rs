//! What keeps an elastic sheet near a surface that has points inside its border.
//!
//! A border alone does not tell such a surface: a dome and a plate may have one border. So the
//! sheet may leave the surface freely by as much as sheet leaves a ruled surface, and is pressed
//! back beyond: a spring at every inner node, across the surface where the node began, without
//! force within the band. Along the surface, nodes slide freely.

use super::net::Net;
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::math::{Point3, Vec3};

/// The stiffness of the springs, per area, as a multiple of Young's modulus times the thickness
/// over the square of the size. With 4, the sheet of a deep dish of felt left the surface by 3 % of
/// the size, and was told to bend; with 60, how a twisted strip was divided shows in its strain.
const STIFF: f64 = 30.0;

/// The springs of a sheet.
#[derive(Clone)]
pub(super) struct Band {
    half_mm: f64,
    springs: Vec<Spring>,
}

/// A spring at an inner node.
#[derive(Clone)]
struct Spring {
    node: usize,
    /// Where the node began, mm.
    at: Point3,
    /// Where the surface faces there.
    facing: Vec3,
    /// N/mm.
    stiffness: f64,
}

impl Band {
    /// The springs of a net whose triangles have these areas, mm², and this stiffness in the plane,
    /// N/mm, without force up to `half_mm` from the surface.
    pub(super) fn new(net: &Net, areas: &[f64], membrane_n_per_mm: f64, half_mm: f64) -> Self {
        let size = size_of(net.space.iter().copied());
        let per_area = STIFF * membrane_n_per_mm / (size * size);
        let mut area_of = vec![0.0; net.flat.len()];
        for (nodes, area) in net.elements.iter().zip(areas) {
            nodes.iter().for_each(|&n| area_of[n] += area / 6.0);
        }
        let inner = (0..net.flat.len()).filter(|&n| !net.on_border[n]);
        let spring = |node: usize| Spring {
            node,
            at: net.space[node],
            facing: net.facing[node],
            stiffness: per_area * area_of[node],
        };
        Self { half_mm, springs: inner.map(spring).collect() }
    }

    /// The largest distance of an inner node from the surface, mm.
    pub(super) fn farthest_mm(&self, positions: &[Point3]) -> f64 {
        self.springs.iter().map(|s| s.off_mm(positions).abs()).fold(0.0, f64::max)
    }

    /// The energy of the springs, N·mm.
    pub(super) fn value(&self, positions: &[Point3]) -> f64 {
        let of = |(spring, beyond): (&Spring, f64)| 0.5 * spring.stiffness * beyond * beyond;
        self.pressed(positions).map(of).sum()
    }

    /// Adds its slopes by the position of every node, N.
    pub(super) fn add_slopes(&self, positions: &[Point3], slopes: &mut [Vec3]) {
        for (spring, beyond) in self.pressed(positions) {
            slopes[spring.node] += spring.facing * (spring.stiffness * beyond);
        }
    }

    /// Calls `add` with its curvatures, N/mm, each of a node with itself.
    pub(super) fn blocks(
        &self,
        positions: &[Point3],
        mut add: impl FnMut([usize; 2], [[f64; 3]; 3]),
    ) {
        for (spring, _) in self.pressed(positions) {
            let n = spring.facing.to_array();
            let block =
                std::array::from_fn(|r| std::array::from_fn(|c| spring.stiffness * n[r] * n[c]));
            add([spring.node; 2], block);
        }
    }

    /// The springs beyond the band, each with how far, signed, mm.
    fn pressed<'a>(&'a self, positions: &'a [Point3]) -> impl Iterator<Item = (&'a Spring, f64)> {
        let beyond = move |spring: &Spring| {
            let off = spring.off_mm(positions);
            off - off.clamp(-self.half_mm, self.half_mm)
        };
        self.springs.iter().map(move |s| (s, beyond(s))).filter(|(_, beyond)| *beyond != 0.0)
    }
}

impl Spring {
    /// How far its node is from the surface, signed, mm.
    fn off_mm(&self, positions: &[Point3]) -> f64 {
        (positions[self.node] - self.at).dot(self.facing)
    }
}
