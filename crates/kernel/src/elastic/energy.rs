//! The energy of a bent and stretched sheet, its slopes and its curvatures.
//!
//! Membrane: St. Venant and Kirchhoff's, from the strain ½ (FᵀF − I) at one place of each
//! triangle. Bending: ½ D ∫ (1 − ν) |∇∇x|² + ν |Δx|² over the flat sheet, which is that of the
//! curvatures where lengths are kept, and a quadratic form of the positions; quadratic triangles
//! have no continuous slope, so jumps of the slope across sides are weighed in by the C0 interior
//! penalty method \[BrennerSung2005\].

use super::band::Band;
use super::element::{CENTROID, Derivatives, Nodes, Place};
use super::net::{InnerSide, Net};
use sheetwright_geometry::math::{Point3, Vec2, Vec3};
use std::collections::BTreeMap;

/// The weight η of the jumps of the slope: above what makes the form positive, and as little above
/// as tests against known surfaces bear.
const PENALTY: f64 = 6.0;

/// What a sheet is made of, as far as it stretches and bends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffness {
    /// Young's modulus times the thickness, N/mm.
    pub membrane_n_per_mm: f64,
    /// The bending stiffness D = E t³ / 12 (1 − ν²), N·mm.
    pub bending_n_mm: f64,
    /// Poisson's number ν, without unit.
    pub poisson: f64,
}

impl Stiffness {
    /// That of a sheet of this thickness, mm, Young's modulus, N/mm², and Poisson's number.
    pub fn new(thickness_mm: f64, modulus_n_per_mm2: f64, poisson: f64) -> Self {
        let membrane_n_per_mm = modulus_n_per_mm2 * thickness_mm;
        let bending_n_mm =
            membrane_n_per_mm * thickness_mm * thickness_mm / (12.0 * (1.0 - poisson * poisson));
        Self { membrane_n_per_mm, bending_n_mm, poisson }
    }
}

/// The membrane strain of a triangle: its parts by xx, yy, and twice that by xy.
pub(super) type Strain = [f64; 3];

/// An element as it lies flat.
#[derive(Clone)]
struct Element {
    nodes: Nodes,
    at: Derivatives,
}

/// The energy of a sheet with this net, by the positions of its nodes.
#[derive(Clone)]
pub(super) struct Energy {
    stiffness: Stiffness,
    elements: Vec<Element>,
    /// The bending form: pairs of nodes, the lower first, with half of the entries of both.
    bending: BTreeMap<[usize; 2], f64>,
    /// What keeps it near the surface, if it has points inside its border.
    band: Option<Band>,
}

impl Energy {
    /// `None` where a triangle of the net is turned over.
    pub(super) fn new(net: &Net, stiffness: Stiffness) -> Option<Self> {
        let flat = |nodes: &Nodes| nodes.map(|n| net.flat[n]);
        let elements: Option<Vec<Element>> = net
            .elements
            .iter()
            .map(|&nodes| Some(Element { nodes, at: Derivatives::at(flat(&nodes), CENTROID)? }))
            .collect();
        let elements = elements?;
        let mut bending = BTreeMap::new();
        for element in &elements {
            let of = |n: usize| element.at.hessians[n];
            for (i, &a) in element.nodes.iter().enumerate() {
                for (k, &b) in element.nodes.iter().enumerate() {
                    let value = element.at.area * curvature_product(&stiffness, of(i), of(k));
                    add(&mut bending, a, b, value);
                }
            }
        }
        for side in net.inner_sides() {
            add_jumps(&mut bending, net, &stiffness, &side)?;
        }
        Some(Self { stiffness, elements, bending, band: None })
    }

    /// That of a sheet which is kept within a distance of the surface, mm.
    pub(super) fn within(self, net: &Net, half_mm: f64) -> Self {
        let band = Band::new(net, &self.areas(), self.stiffness.membrane_n_per_mm, half_mm);
        Self { band: Some(band), ..self }
    }

    /// The energy of what keeps the sheet near the surface, N·mm.
    pub(super) fn band_value(&self, positions: &[Point3]) -> f64 {
        self.band.as_ref().map_or(0.0, |band| band.value(positions))
    }

    /// The largest distance of a node that is kept near the surface from it, mm; `None` where none
    /// is.
    pub(super) fn farthest_mm(&self, positions: &[Point3]) -> Option<f64> {
        self.band.as_ref().map(|band| band.farthest_mm(positions))
    }

    /// The pairs of different nodes that act on one another, the lower first.
    pub(super) fn pairs(&self) -> Vec<[usize; 2]> {
        self.bending.keys().filter(|[a, b]| a != b).copied().collect()
    }

    /// The membrane strain of every triangle.
    pub(super) fn strains(&self, positions: &[Point3]) -> Vec<Strain> {
        self.elements.iter().map(|element| element.strain(positions)).collect()
    }

    /// The area of every triangle, flat, mm².
    pub(super) fn areas(&self) -> Vec<f64> {
        self.elements.iter().map(|element| element.at.area).collect()
    }

    /// The energy, N·mm, below which a sheet is as good as not strained: strains of 1e-9.
    pub(super) fn negligible(&self) -> f64 {
        1e-18 * self.stiffness.membrane_n_per_mm * self.areas().iter().sum::<f64>()
    }

    /// A curvature of the energy, N/mm, like that of a node in the plane of the sheet.
    pub(super) fn across_tracks(&self) -> f64 {
        self.stiffness.membrane_n_per_mm
    }

    /// The larger principal curvature of every triangle, without its sign, 1/mm.
    pub(super) fn curvatures(&self, positions: &[Point3]) -> Vec<f64> {
        self.elements.iter().map(|element| element.curvature(positions)).collect()
    }

    /// The energy, N·mm.
    pub(super) fn value(&self, positions: &[Point3]) -> f64 {
        let membrane: f64 = self
            .elements
            .iter()
            .map(|element| {
                let strain = element.strain(positions);
                let stress = self.stress(strain);
                0.5 * element.at.area * (0..3).map(|k| stress[k] * strain[k]).sum::<f64>()
            })
            .sum();
        membrane + self.bending_value(positions) + self.band_value(positions)
    }

    /// The energy of bending alone, N·mm.
    pub(super) fn bending_value(&self, positions: &[Point3]) -> f64 {
        let of = |(&[a, b], value): (&[usize; 2], &f64)| {
            let twice = if a == b { 1.0 } else { 2.0 };
            0.5 * twice * value * positions[a].to_vec().dot(positions[b].to_vec())
        };
        self.bending.iter().map(of).sum()
    }

    /// The stress in the plane, N/mm, by xx, yy and xy.
    fn stress(&self, [xx, yy, xy]: Strain) -> [f64; 3] {
        let Stiffness { membrane_n_per_mm, poisson, .. } = self.stiffness;
        let c = membrane_n_per_mm / (1.0 - poisson * poisson);
        [c * (xx + poisson * yy), c * (yy + poisson * xx), 0.5 * c * (1.0 - poisson) * xy]
    }

    /// The slopes of the energy by the position of every node, N.
    pub(super) fn slopes(&self, positions: &[Point3]) -> Vec<Vec3> {
        let mut slopes = vec![Vec3::ZERO; positions.len()];
        for element in &self.elements {
            let [fx, fy] = element.tangents(positions);
            let [sxx, syy, sxy] = self.stress(strain_of(fx, fy));
            for (n, gradient) in element.nodes.iter().zip(&element.at.gradients) {
                let along = fx * (sxx * gradient.x + sxy * gradient.y)
                    + fy * (sxy * gradient.x + syy * gradient.y);
                slopes[*n] += along * element.at.area;
            }
        }
        for (&[a, b], &value) in &self.bending {
            slopes[a] += positions[b].to_vec() * value;
            if a != b {
                slopes[b] += positions[a].to_vec() * value;
            }
        }
        if let Some(band) = &self.band {
            band.add_slopes(positions, &mut slopes);
        }
        slopes
    }

    /// Calls `add` with every block of the curvatures of the energy, N/mm: a pair of nodes, the
    /// lower first, rows of the first and columns of the second. Only this share of what is pressed
    /// enters: with all of it they are those of the energy, without any they are positive in every
    /// direction.
    pub(super) fn curvature_blocks(
        &self,
        positions: &[Point3],
        pressed: f64,
        mut add: impl FnMut([usize; 2], [[f64; 3]; 3]),
    ) {
        for (&pair, &value) in &self.bending {
            add(
                pair,
                std::array::from_fn(|r| std::array::from_fn(|c| if r == c { value } else { 0.0 })),
            );
        }
        if let Some(band) = &self.band {
            band.blocks(positions, &mut add);
        }
        for element in &self.elements {
            let [fx, fy] = element.tangents(positions);
            let [sxx, syy, sxy] = eased(self.stress(strain_of(fx, fy)), pressed);
            // How the three parts of the strain grow with a move of each node.
            let growth: [[Vec3; 3]; 6] =
                element.at.gradients.map(|g| [fx * g.x, fy * g.y, fy * g.x + fx * g.y]);
            for i in 0..6 {
                let stressed: [Vec3; 3] = self.stress_of(growth[i]);
                let gi = element.at.gradients[i];
                for k in 0..6 {
                    let (a, b) = (element.nodes[i], element.nodes[k]);
                    if a > b {
                        continue;
                    }
                    let gk = element.at.gradients[k];
                    let held = gi.x * (sxx * gk.x + sxy * gk.y) + gi.y * (sxy * gk.x + syy * gk.y);
                    let mut block = [[0.0; 3]; 3];
                    for (s, g) in stressed.iter().zip(&growth[k]) {
                        let (s, g) = (s.to_array(), g.to_array());
                        for r in 0..3 {
                            for c in 0..3 {
                                block[r][c] += element.at.area * s[r] * g[c];
                            }
                        }
                    }
                    (0..3).for_each(|r| block[r][r] += element.at.area * held);
                    add([a, b], block);
                }
            }
        }
    }

    /// The stress that a growth of the strain brings.
    fn stress_of(&self, [xx, yy, xy]: [Vec3; 3]) -> [Vec3; 3] {
        let Stiffness { membrane_n_per_mm, poisson, .. } = self.stiffness;
        let c = membrane_n_per_mm / (1.0 - poisson * poisson);
        [(xx + yy * poisson) * c, (yy + xx * poisson) * c, xy * (0.5 * c * (1.0 - poisson))]
    }
}

impl Element {
    /// The derivatives of the position by x and y.
    fn tangents(&self, positions: &[Point3]) -> [Vec3; 2] {
        let mut tangents = [Vec3::ZERO; 2];
        for (n, gradient) in self.nodes.iter().zip(&self.at.gradients) {
            let at = positions[*n].to_vec();
            tangents[0] += at * gradient.x;
            tangents[1] += at * gradient.y;
        }
        tangents
    }

    fn strain(&self, positions: &[Point3]) -> Strain {
        let [fx, fy] = self.tangents(positions);
        strain_of(fx, fy)
    }

    fn curvature(&self, positions: &[Point3]) -> f64 {
        let [fx, fy] = self.tangents(positions);
        let normal = fx.cross(fy);
        let mut second = [Vec3::ZERO; 3];
        for (n, hessian) in self.nodes.iter().zip(&self.at.hessians) {
            (0..3).for_each(|k| second[k] += positions[*n].to_vec() * hessian[k]);
        }
        let [xx, yy, xy] = second.map(|s| s.dot(normal) / normal.length());
        largest_principal([xx, yy, 2.0 * xy])
    }
}

fn strain_of(fx: Vec3, fy: Vec3) -> Strain {
    [0.5 * (fx.dot(fx) - 1.0), 0.5 * (fy.dot(fy) - 1.0), fx.dot(fy)]
}

/// The larger principal value of a symmetric tensor, without its sign: its parts by xx, yy, and
/// twice that by xy.
pub(super) fn largest_principal([xx, yy, xy]: [f64; 3]) -> f64 {
    let middle = 0.5 * (xx + yy);
    let radius = (0.25 * (xx - yy) * (xx - yy) + 0.25 * xy * xy).sqrt();
    middle.abs() + radius
}

/// A stress with this share of its compression.
fn eased([xx, yy, xy]: [f64; 3], pressed: f64) -> [f64; 3] {
    if pressed == 1.0 {
        return [xx, yy, xy];
    }
    let middle = 0.5 * (xx + yy);
    let half = 0.5 * (xx - yy);
    let radius = (half * half + xy * xy).sqrt();
    let [high, low] = [middle + radius, middle - radius].map(|s| s.max(pressed * s));
    if radius == 0.0 {
        return [high, high, 0.0];
    }
    let (mean, share) = (0.5 * (high + low), 0.5 * (high - low) / radius);
    [mean + share * half, mean - share * half, share * xy]
}

/// The product of two curvature tensors in the bending form, D included.
fn curvature_product(stiffness: &Stiffness, a: [f64; 3], b: [f64; 3]) -> f64 {
    let Stiffness { bending_n_mm, poisson, .. } = *stiffness;
    let same = a[0] * b[0] + a[1] * b[1] + 2.0 * a[2] * b[2];
    let traces = (a[0] + a[1]) * (b[0] + b[1]);
    bending_n_mm * ((1.0 - poisson) * same + poisson * traces)
}

fn add(form: &mut BTreeMap<[usize; 2], f64>, a: usize, b: usize, value: f64) {
    // Both orders come by; the lower first counts.
    if a <= b {
        *form.entry([a, b]).or_default() += value;
    }
}

/// Two places of a side, for integrals of degree three along it.
const ALONG: [f64; 2] = [0.211_324_865_405_187_13, 0.788_675_134_594_812_9];

/// Adds what the jump of the slope across a side takes; `None` where a triangle is turned over.
fn add_jumps(
    form: &mut BTreeMap<[usize; 2], f64>,
    net: &Net,
    stiffness: &Stiffness,
    side: &InnerSide,
) -> Option<()> {
    let [from, to] = side.ends.map(|n| net.flat[n]);
    let along = to - from;
    let length = along.length();
    // Out of the first triangle, which lies to the left.
    let normal = Vec2::new(along.y, -along.x) * (1.0 / length);
    let [first, second] = side.elements.map(|n| net.elements[n]);
    for share in ALONG {
        let mut slopes: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
        for (nodes, sign) in [(first, 1.0), (second, -1.0)] {
            let place = place_on(&nodes, side.ends, share);
            let at = Derivatives::at(nodes.map(|n| net.flat[n]), place)?;
            for (k, &n) in nodes.iter().enumerate() {
                let of_node = slopes.entry(n).or_default();
                of_node[0] += sign * at.gradients[k].dot(normal);
                of_node[1] += 0.5 * moment(stiffness, at.hessians[k], normal);
            }
        }
        let weight = 0.5 * length;
        let penalty = PENALTY * stiffness.bending_n_mm / length;
        for (&a, &[jump_a, moment_a]) in &slopes {
            for (&b, &[jump_b, moment_b]) in &slopes {
                let value = penalty * jump_a * jump_b - jump_a * moment_b - jump_b * moment_a;
                add(form, a, b, weight * value);
            }
        }
    }
    Some(())
}

/// The bending moment about a side with this normal, by a curvature tensor, N.
fn moment(stiffness: &Stiffness, [xx, yy, xy]: [f64; 3], n: Vec2) -> f64 {
    let Stiffness { bending_n_mm, poisson, .. } = *stiffness;
    let across = xx * n.x * n.x + yy * n.y * n.y + 2.0 * xy * n.x * n.y;
    bending_n_mm * ((1.0 - poisson) * across + poisson * (xx + yy))
}

/// The place in a triangle so far along a side of it, by the corners at the side's ends.
fn place_on(nodes: &Nodes, ends: [usize; 2], share: f64) -> Place {
    let weight = |corner: usize| {
        if nodes[corner] == ends[0] {
            1.0 - share
        } else if nodes[corner] == ends[1] {
            share
        } else {
            0.0
        }
    };
    [weight(1), weight(2)]
}
