//! A first flat form, by linear equations: conformal with the border's lengths kept, and where that
//! turns a triangle over, an embedding within a circle.
//!
//! **Conformal** \[SawhneyCrane2017\]. A flat form that keeps angles is told by how much it scales,
//! e^u. With u = 0 on the border, the border keeps its lengths, and inside u solves A·u = −Ω, where
//! A is the Laplacian of cotangents and Ω the angle that is missing from 2π at a vertex (in their
//! letters; the sign of u is theirs too). What flows out through the border turns it: its exterior
//! angles become k̃ = k + (A·u) at the border. They draw the outline; as a polygon of these angles
//! and lengths need not close, the lengths are changed by as little as closes it. The inner
//! vertices follow harmonically, with the same matrix. So one factorisation of the size of the
//! inner vertices gives all, where least-squares conformal maps need one of twice that size.
//!
//! **In a circle** \[Tutte1963\]. With the border on a circle and every other vertex at the mean of
//! its neighbours, no triangle is turned over.
//!
//! A hole is closed for the time being by a cone: an apex that is as far from all its border as a
//! third of the way round it.

use super::RelaxError;
use super::shape::{Shape, flipped, goes_round_once};
use crate::mesh::Topology;
use sheetwright_geometry::index::{TriangleIndex, VertexIndex};
use sheetwright_geometry::math::sparse::{Factor, Plan, TooLarge, elimination_order};
use sheetwright_geometry::math::{Point2, Vec2, cos, sin};
use std::f64::consts::{FRAC_1_PI, PI, TAU};

/// The apex of a closed hole lies this share of the way round it from every vertex of it. Any share
/// above a quarter makes triangles, since no side is longer than the others together.
const APEX: f64 = FRAC_1_PI;

/// A disk: the mesh with its holes closed.
struct Disk<'a> {
    topology: &'a Topology,
    vertices: usize,
    /// Corners and shapes, those of the mesh first.
    triangles: Vec<([usize; 3], Shape)>,
    border: Vec<usize>,
    /// The number of each inner vertex among them.
    inner: Vec<Option<usize>>,
    /// Pairs of inner vertices that are joined, as these numbers.
    pairs: Vec<[usize; 2]>,
    /// The pair of each side of each triangle, where both its ends are inner ones.
    pairs_of: Vec<[Option<usize>; 3]>,
}

/// A flat form without a triangle turned over, if one was found: conformal or in a circle.
pub(super) fn start(
    topology: &Topology,
    lengths: &[f64],
    shapes: &[Shape],
    order: &[usize],
) -> Result<Option<Vec<Point2>>, RelaxError> {
    let disk = Disk::new(topology, lengths, shapes)?;
    // The order of elimination of all vertices serves the inner ones; apexes come last.
    let apexes = topology.vertices()..disk.vertices;
    let inner_order: Vec<usize> =
        order.iter().copied().chain(apexes).filter_map(|v| disk.inner[v]).collect();
    let plan = Plan::<1>::new(&inner_order, &disk.pairs).map_err(too_large)?;
    let is_embedded = |points: &Vec<Point2>| {
        points.iter().all(|p| p.x.is_finite() && p.y.is_finite())
            && flipped(topology, points) == 0
            && goes_round_once(topology, points)
    };
    if let Some(points) = disk.conformal(&plan, lengths)?.filter(is_embedded) {
        return Ok(Some(points));
    }
    Ok(disk.in_circle(&plan, lengths)?.filter(is_embedded))
}

/// How much the conformal form scales at every vertex: |u|, 0 on the border. `None` where rounding
/// or very obtuse triangles leave no factor.
pub(super) fn scales(
    topology: &Topology,
    lengths: &[f64],
    shapes: &[Shape],
) -> Result<Option<Vec<f64>>, RelaxError> {
    let disk = Disk::new(topology, lengths, shapes)?;
    let order = elimination_order(disk.pairs_inner(), &disk.pairs).map_err(too_large)?;
    let plan = Plan::<1>::new(&order, &disk.pairs).map_err(too_large)?;
    let (Some(factor), _) = disk.laplacian(&plan, half_cotangents)? else { return Ok(None) };
    let minus_u = disk.minus_u(&factor, &disk.turn());
    let of = |inner: &Option<usize>| inner.map_or(0.0, |inner| minus_u[inner][0].abs());
    Ok(Some(disk.inner[..topology.vertices()].iter().map(of).collect()))
}

/// Half the cotangent of the angle opposite to each side.
fn half_cotangents(shape: &Shape) -> [f64; 3] {
    let [a, b, c] = shape.cotangents();
    [0.5 * c, 0.5 * a, 0.5 * b]
}

fn too_large(_: TooLarge) -> RelaxError {
    RelaxError::TooLarge
}

impl<'a> Disk<'a> {
    fn new(topology: &'a Topology, lengths: &[f64], shapes: &[Shape]) -> Result<Self, RelaxError> {
        let corners = topology.triangles().iter().map(|t| t.map(|v| v.get()));
        let mut triangles: Vec<([usize; 3], Shape)> = corners.zip(shapes.iter().copied()).collect();
        let mut vertices = topology.vertices();
        let border: Vec<usize> = topology.loops()[0].iter().map(|v| v.get()).collect();
        let mut pairs_of: Vec<[Option<usize>; 3]> = Vec::new();
        let mut inner = vec![Some(0); vertices];
        for &v in &border {
            inner[v] = None;
        }
        let mut spokes = Vec::new();
        for hole in &topology.loops()[1..] {
            let sides: Vec<(usize, usize, f64)> = hole
                .iter()
                .zip(hole.iter().cycle().skip(1))
                .map(|(&a, &b)| (a.get(), b.get(), between(topology, lengths, a.get(), b.get())))
                .collect();
            let radius = APEX * sides.iter().map(|side| side.2).sum::<f64>();
            for (a, b, length) in sides {
                // The loop runs with the triangles of the mesh, so the cone's run against it.
                let shape = Shape::of([length, radius, radius]).ok_or(RelaxError::Hole)?;
                triangles.push(([b, a, vertices], shape));
                spokes.push([a, vertices]);
            }
            inner.push(Some(0));
            vertices += 1;
        }
        for (count, number) in inner.iter_mut().flatten().enumerate() {
            *number = count;
        }
        let mut pairs = Vec::new();
        let mut pair = |[a, b]: [usize; 2]| {
            let ends = [inner[a]?, inner[b]?];
            pairs.push(ends);
            Some(pairs.len() - 1)
        };
        let of_edges: Vec<Option<usize>> =
            topology.edges().iter().map(|edge| pair(edge.ends.map(|v| v.get()))).collect();
        let of_spokes: Vec<Option<usize>> = spokes.iter().map(|&spoke| pair(spoke)).collect();
        let of_mesh = (0..shapes.len())
            .map(|n| topology.edges_of(TriangleIndex::new(n)).map(|edge| of_edges[edge]));
        pairs_of.extend(of_mesh);
        let mut first = 0;
        for hole in &topology.loops()[1..] {
            for n in 0..hole.len() {
                let (a, b) = (hole[n], hole[(n + 1) % hole.len()]);
                let edge = topology.edge_between(a, b).and_then(|edge| of_edges[edge]);
                let (at_a, at_b) = (of_spokes[first + n], of_spokes[first + (n + 1) % hole.len()]);
                pairs_of.push([edge, at_a, at_b]);
            }
            first += hole.len();
        }
        Ok(Self { topology, vertices, triangles, border, inner, pairs, pairs_of })
    }

    /// The factor of a Laplacian over the inner vertices, and its entries between inner vertices
    /// and the border as (inner, border, weight). `weights` are of the sides of a triangle.
    #[allow(clippy::type_complexity)] // a pair that both callers take apart at once
    fn laplacian<'p>(
        &self,
        plan: &'p Plan<1>,
        weights: impl Fn(&Shape) -> [f64; 3],
    ) -> Result<(Option<Factor<'p, 1>>, Vec<(usize, usize, f64)>), RelaxError> {
        let mut matrix = plan.zero();
        let mut across = Vec::new();
        for ((corners, shape), pairs) in self.triangles.iter().zip(&self.pairs_of) {
            let weights = weights(shape);
            for side in 0..3 {
                let (a, b, w) = (corners[side], corners[(side + 1) % 3], weights[side]);
                if let Some(pair) = pairs[side] {
                    matrix.add_pair(pair, [[-w]]);
                }
                for (from, to) in [(a, b), (b, a)] {
                    if let Some(inner) = self.inner[from] {
                        matrix.add_diagonal(inner, [[w]]);
                        if self.inner[to].is_none() {
                            across.push((inner, to, w));
                        }
                    }
                }
            }
        }
        Ok((matrix.factor().map_err(too_large)?, across))
    }

    /// The conformal form; `None` where rounding or very obtuse triangles leave no factor.
    fn conformal(
        &self,
        plan: &Plan<1>,
        lengths: &[f64],
    ) -> Result<Option<Vec<Point2>>, RelaxError> {
        let (Some(factor), across) = self.laplacian(plan, half_cotangents)? else {
            return Ok(None);
        };
        let mut turn = self.turn();
        let minus_u = self.minus_u(&factor, &turn);
        for &(inner, v, w) in &across {
            // (A·u) at the border, with u = 0 there.
            turn[v] += w * minus_u[inner][0];
        }
        let outline = self.outline(lengths, &turn);
        Ok(outline.map(|outline| self.harmonic(&factor, &across, &outline)))
    }

    /// The exterior angle at the border; inside, the angle that is missing.
    fn turn(&self) -> Vec<f64> {
        let mut turn = vec![TAU; self.vertices];
        for &v in &self.border {
            turn[v] = PI;
        }
        for (corners, shape) in &self.triangles {
            for (v, angle) in corners.iter().zip(shape.angles()) {
                turn[*v] -= angle;
            }
        }
        turn
    }

    /// −u at every inner vertex, with u = 0 on the border.
    fn minus_u(&self, factor: &Factor<'_, 1>, turn: &[f64]) -> Vec<[f64; 1]> {
        let mut missing = vec![[0.0]; self.pairs_inner()];
        for (v, inner) in self.inner.iter().enumerate() {
            if let Some(inner) = inner {
                missing[*inner] = [turn[v]];
            }
        }
        let [minus_u] = factor.solve([&missing]);
        minus_u
    }

    fn pairs_inner(&self) -> usize {
        self.inner.iter().flatten().count()
    }

    /// The border as a closed polygon of its lengths, or nearly, that turns by these angles.
    fn outline(&self, lengths: &[f64], turn: &[f64]) -> Option<Vec<Vec2>> {
        let m = self.border.len();
        let mut direction = 0.0;
        let mut sides = Vec::with_capacity(m);
        for n in 0..m {
            let (a, b) = (self.border[n], self.border[(n + 1) % m]);
            sides.push((
                between(self.topology, lengths, a, b),
                Vec2::new(cos(direction), sin(direction)),
            ));
            direction += turn[b];
        }
        // The change of lengths d that is least in Σ d²/l and closes: d = −l·(t · M⁻¹ g).
        let gap: Vec2 = sides.iter().map(|(l, t)| *t * *l).sum();
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for (l, t) in &sides {
            xx += l * t.x * t.x;
            xy += l * t.x * t.y;
            yy += l * t.y * t.y;
        }
        let determinant = xx * yy - xy * xy;
        let pull = Vec2::new(yy * gap.x - xy * gap.y, xx * gap.y - xy * gap.x) / determinant;
        let mut at = Vec2::ZERO;
        let outline = sides.iter().map(|(l, t)| {
            let here = at;
            at += *t * (l * (1.0 - t.dot(pull)));
            here
        });
        let outline: Vec<Vec2> = outline.collect();
        outline.iter().all(|p| p.is_finite()).then_some(outline)
    }

    /// The vertices of the mesh, with the border on an outline and the inner ones at the means of
    /// their neighbours that the weights of a Laplacian ask for.
    fn harmonic(
        &self,
        factor: &Factor<'_, 1>,
        across: &[(usize, usize, f64)],
        outline: &[Vec2],
    ) -> Vec<Point2> {
        let mut points = vec![Point2::default(); self.vertices];
        for (&v, at) in self.border.iter().zip(outline) {
            points[v] = Point2::new(at.x, at.y);
        }
        let inner = self.pairs_inner();
        let (mut x, mut y) = (vec![[0.0]; inner], vec![[0.0]; inner]);
        for &(inner, v, w) in across {
            x[inner][0] += w * points[v].x;
            y[inner][0] += w * points[v].y;
        }
        let [x, y] = factor.solve([&x, &y]);
        for (point, inner) in points.iter_mut().zip(&self.inner) {
            if let Some(inner) = *inner {
                *point = Point2::new(x[inner][0], y[inner][0]);
            }
        }
        points.truncate(self.topology.vertices());
        points
    }

    /// The form in a circle, of the area of the mesh.
    fn in_circle(
        &self,
        plan: &Plan<1>,
        lengths: &[f64],
    ) -> Result<Option<Vec<Point2>>, RelaxError> {
        let (Some(factor), across) = self.laplacian(plan, |_| [1.0; 3])? else { return Ok(None) };
        let area: f64 = self.triangles.iter().map(|(_, shape)| 0.5 * shape.doubled_area).sum();
        let radius = (area * FRAC_1_PI).sqrt();
        let m = self.border.len();
        let side =
            |n: usize| between(self.topology, lengths, self.border[n], self.border[(n + 1) % m]);
        let around: f64 = (0..m).map(side).sum();
        let mut along = 0.0;
        let outline: Vec<Vec2> = (0..m)
            .map(|n| {
                let angle = TAU * along / around;
                along += side(n);
                Vec2::new(cos(angle), sin(angle)) * radius
            })
            .collect();
        Ok(Some(self.harmonic(&factor, &across, &outline)))
    }
}

fn between(topology: &Topology, lengths: &[f64], a: usize, b: usize) -> f64 {
    let [a, b] = [a, b].map(VertexIndex::new);
    topology.edge_between(a, b).map_or(0.0, |edge| lengths[edge])
}
