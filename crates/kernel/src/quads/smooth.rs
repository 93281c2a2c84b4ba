//! Smooth strips: ruled B-spline surfaces over the quads.
//!
//! A strip is a run of quads, rung beside rung. Its two rails are cubic Bézier curves from rung to
//! rung, P on the right and Q on the left as seen along the strip, and its surface is ruled,
//! S(u, v) = (1 − v) P(u) + v Q(u): degree 3 × 1 (\[G14\]). Two patches at a rung are
//! G1 if the derivatives of both rails change by one factor λ there, P′₊ = λ P′₋ and Q′₊ = λ Q′₋:
//! then S_u of the one is λ times that of the other all along the rung. Rails over common knots,
//! with one derivative at each, satisfy that; so a strip is one B-spline surface with double knots,
//! λ the ratio of the knot intervals.
//!
//! Rails pass through the places of the vertices on the outline, with the tangents of the outline
//! there. (A smooth surface does not need the planar quads for which some vertices left the
//! outline.) The length of the derivative is the slope of arc length by u, from the neighbouring
//! vertices. So rails miss the outline between the vertices by the fourth power of their distance,
//! which is measured. A ruled surface need not be developable: its warp, the angle between the
//! tangent planes at both ends of a ruling, is measured too.
//!
//! Where a rail has a corner the strip ends and another begins. Cells that are no part of a strip
//! (ends in a triangle, larger polygons where strips meet) stay plane faces. Their sides on the
//! boundary are the cubics of the outline's tangents, laid into the plane.

use super::{QuadMesh, Vertex, planar::distance_of_diagonals};
use sheetwright_geometry::boundary::{Outline, Side, size_of};
use sheetwright_geometry::curve::Cubic;
use sheetwright_geometry::math::{Point3, Vec3, angle_between, unit};
use sheetwright_geometry::tolerance::Tolerance;
use std::collections::BTreeMap;

/// Places a span at which the distance to the outline and the warp are measured.
const PLACES: usize = 8;
/// Quads of larger polygons with more than this, as a share of the size, between their diagonals
/// are two triangles, since they lie in no plane.
const PLANE: Tolerance = Tolerance::ROUNDING;
/// Faces whose area is less than this share of the square of their longest side have no plane.
const LEAST_AREA: f64 = 1e-9;

/// A cubic B-spline with double knots: continuous, with its derivative.
#[derive(Clone, Debug, PartialEq)]
pub struct Rail {
    /// The knots, increasing: the first and the last count four times, the others twice.
    pub knots: Vec<f64>,
    /// The control points, two more than twice the spans.
    pub control: Vec<Point3>,
}

/// The curve of an edge.
#[derive(Clone, Debug, PartialEq)]
pub enum EdgeCurve {
    /// The straight line between its ends.
    Line,
    /// A spline.
    Spline(Rail),
}

/// An edge of a smooth surface.
#[derive(Clone, Debug, PartialEq)]
pub struct SmoothEdge {
    /// The vertices that it runs from and to.
    pub ends: [usize; 2],
    /// Its curve.
    pub curve: EdgeCurve,
}

/// The shape of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FaceShape {
    /// The ruled surface between two edges, splines over common knots: the one at v = 0, on the
    /// right as seen along the strip, and the one at v = 1.
    Ruled([usize; 2]),
    /// The plane through the face's first vertex with this unit normal.
    Plane(Vec3),
}

/// A face of a smooth surface.
#[derive(Clone, Debug, PartialEq)]
pub struct SmoothFace {
    /// Its shape; its normals point to the side that the panel faces.
    pub shape: FaceShape,
    /// Its edges, counter-clockwise as seen from there, and whether each is run from its end to its
    /// beginning.
    pub border: Vec<(usize, bool)>,
}

/// A surface of ruled strips and plane faces, sewn along their rungs.
#[derive(Clone, Debug, PartialEq)]
pub struct SmoothSurface {
    /// The positions of the vertices, mm.
    pub vertices: Vec<Point3>,
    /// The edges: those between two faces once.
    pub edges: Vec<SmoothEdge>,
    /// The faces.
    pub faces: Vec<SmoothFace>,
    /// The largest distance of its border from the outline, mm.
    pub deviation_max_mm: f64,
    /// The largest angle between the tangent planes at the ends of a ruling, radians.
    pub warp_max: f64,
}

impl SmoothSurface {
    /// How many of its faces are ruled strips.
    pub fn strips(&self) -> usize {
        self.faces.iter().filter(|face| matches!(face.shape, FaceShape::Ruled(_))).count()
    }
}

impl Rail {
    /// The rail through these points with these derivatives at the knots.
    fn new(knots: &[f64], points: &[Point3], derivatives: &[Vec3]) -> Self {
        let last = points.len() - 1;
        let mut control = Vec::with_capacity(2 * last + 2);
        control.push(points[0]);
        for i in 0..=last {
            if i > 0 {
                control.push(points[i] + derivatives[i] * ((knots[i] - knots[i - 1]) / -3.0));
            }
            if i < last {
                control.push(points[i] + derivatives[i] * ((knots[i + 1] - knots[i]) / 3.0));
            }
        }
        control.push(points[last]);
        Self { knots: knots.to_vec(), control }
    }

    /// Its spans, each over 0 ..= 1.
    pub fn spans(&self) -> Vec<Cubic> {
        let last = self.knots.len() - 1;
        let joint = |i: usize| {
            if i == 0 {
                return self.control[0];
            }
            if i == last {
                return self.control[2 * last + 1];
            }
            let (before, behind) =
                (self.knots[i] - self.knots[i - 1], self.knots[i + 1] - self.knots[i]);
            self.control[2 * i].lerp(self.control[2 * i + 1], before / (before + behind))
        };
        let span = |i: usize| Cubic {
            control: [joint(i), self.control[2 * i + 1], self.control[2 * i + 2], joint(i + 1)],
        };
        (0..last).map(span).collect()
    }
}

/// The smooth surface over a quad mesh on this outline.
pub fn smooth(mesh: &QuadMesh, outline: &Outline) -> SmoothSurface {
    let mut building = Building::new(mesh, outline);
    let (strips, others) = strips(mesh, outline);
    for strip in &strips {
        building.add_strip(strip);
    }
    for cell in others {
        for face in &mesh.cells[cell].faces {
            building.add_plane(face);
        }
    }
    building.done
}

/// The vertices of the rulings of a strip, one after the other: that on the right, that on the
/// left.
type Strip = Vec<[usize; 2]>;

/// The strips of a mesh, and the numbers of the cells that are no part of one.
fn strips(mesh: &QuadMesh, outline: &Outline) -> (Vec<Strip>, Vec<usize>) {
    let is_rung = |a: usize, b: usize| mesh.rungs.binary_search(&[a.min(b), a.max(b)]).is_ok();
    // The sides across a strip of each cell, in its own direction: two rungs, or a rung and a
    // straight end.
    let across: Vec<Option<[[usize; 2]; 2]>> = mesh
        .cells
        .iter()
        .map(|cell| {
            let [a, b, c, d] = <[usize; 4]>::try_from(cell.corners.as_slice()).ok()?;
            let is_across =
                |a: usize, b: usize| is_rung(a, b) || is_straight_end(mesh, outline, a, b);
            let is_along = |a: usize, b: usize| !is_rung(a, b) && mesh.next(a) == b;
            let takes = |a, b, c, d| {
                is_across(a, b)
                    && is_across(c, d)
                    && is_along(b, c)
                    && is_along(d, a)
                    && (is_rung(a, b) || is_rung(c, d))
            };
            if takes(a, b, c, d) {
                Some([[a, b], [c, d]])
            } else if takes(b, c, d, a) {
                Some([[b, c], [d, a]])
            } else {
                None
            }
        })
        .collect();
    let mut entered_by: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    for (cell, sides) in across.iter().enumerate() {
        for &side in sides.iter().flatten() {
            entered_by.insert(side, cell);
        }
    }
    let is_corner = |[a, b]: [usize; 2]| mesh.vertices[a].is_corner || mesh.vertices[b].is_corner;
    // Where a strip begins: a side without a strip cell behind it, or with a corner.
    let begins = |side: [usize; 2]| {
        let [a, b] = side;
        !entered_by.contains_key(&[b, a]) || is_corner(side)
    };
    let mut taken = vec![false; mesh.cells.len()];
    let mut found = Vec::new();
    let mut walk = |cell: usize, side: [usize; 2], most: usize, taken: &mut Vec<bool>| {
        let ([a, b], mut at) = (side, Some((cell, side)));
        let mut strip: Strip = vec![[b, a]];
        while let Some((cell, side)) = at {
            let Some([first, second]) = across[cell] else { break };
            taken[cell] = true;
            let [c, d] = if side == first { second } else { first };
            strip.push([c, d]);
            let next = entered_by.get(&[d, c]).copied();
            let goes_on = !is_corner([c, d]) && strip.len() <= most;
            at = next.filter(|&n| goes_on && !taken[n]).map(|n| (n, [d, c]));
        }
        found.push(strip);
    };
    for pass in 0..2 {
        for (cell, sides) in across.iter().enumerate() {
            for &side in sides.iter().flatten() {
                if taken[cell] {
                    continue;
                }
                // A closed strip has no beginning, and is cut at two of its rungs.
                if pass == 1 {
                    let round = ring_length(&across, &entered_by, cell, side);
                    walk(cell, side, round.div_ceil(2), &mut taken);
                } else if begins(side) {
                    walk(cell, side, usize::MAX, &mut taken);
                }
            }
        }
    }
    let others = (0..mesh.cells.len()).filter(|&n| !taken[n]).collect();
    (found, others)
}

/// The number of cells of a closed strip, from a side on.
fn ring_length(
    across: &[Option<[[usize; 2]; 2]>],
    entered_by: &BTreeMap<[usize; 2], usize>,
    cell: usize,
    side: [usize; 2],
) -> usize {
    let (mut at, mut entered, mut count) = (cell, side, 0);
    while let Some([first, second]) = across[at].filter(|_| count <= across.len()) {
        count += 1;
        let [c, d] = if entered == first { second } else { first };
        entered = [d, c];
        match entered_by.get(&entered) {
            Some(&next) if next != cell => at = next,
            _ => break,
        }
    }
    count
}

/// Whether a side of the boundary is straight, from corner to corner.
fn is_straight_end(mesh: &QuadMesh, outline: &Outline, a: usize, b: usize) -> bool {
    let (from, to) = (&mesh.vertices[a], &mesh.vertices[b]);
    if mesh.next(a) != b || !from.is_corner || !to.is_corner {
        return false;
    }
    let length = from.position.distance(to.position);
    let gap = mesh.gap_mm(outline, a);
    length > 0.0 && (gap - length).abs() <= Tolerance::ROUNDING.length_mm(length)
}

struct Building<'a> {
    mesh: &'a QuadMesh,
    outline: &'a Outline,
    size: f64,
    lines: BTreeMap<[usize; 2], usize>,
    done: SmoothSurface,
}

impl<'a> Building<'a> {
    fn new(mesh: &'a QuadMesh, outline: &'a Outline) -> Self {
        // Vertices that left the outline are put back on it: between close neighbours, steps off it
        // would bend the rails.
        let on = |v: &Vertex| outline.at(v.of_loop, v.along_mm, Side::Leaving).position;
        let vertices: Vec<Point3> = mesh.vertices.iter().map(on).collect();
        let done = SmoothSurface {
            edges: Vec::new(),
            faces: Vec::new(),
            deviation_max_mm: 0.0,
            warp_max: 0.0,
            vertices: vertices.clone(),
        };
        Self { mesh, outline, size: size_of(vertices), lines: BTreeMap::new(), done }
    }

    /// The straight edge between two vertices, as a part of a border.
    fn line(&mut self, from: usize, to: usize) -> (usize, bool) {
        let ends = [from.min(to), from.max(to)];
        let edges = &mut self.done.edges;
        let edge = *self.lines.entry(ends).or_insert_with(|| {
            edges.push(SmoothEdge { ends, curve: EdgeCurve::Line });
            edges.len() - 1
        });
        (edge, from > to)
    }

    fn spline(&mut self, from: usize, to: usize, rail: Rail) -> usize {
        self.done.edges.push(SmoothEdge { ends: [from, to], curve: EdgeCurve::Spline(rail) });
        self.done.edges.len() - 1
    }

    fn tangent(&self, i: usize, side: Side) -> Vec3 {
        let vertex = &self.mesh.vertices[i];
        self.outline.at(vertex.of_loop, vertex.along_mm, side).tangent
    }

    /// The largest distance of a cubic from the outline between a vertex and the next.
    fn deviation(&self, from: usize, cubic: &Cubic) -> f64 {
        let vertex = &self.mesh.vertices[from];
        let range = vertex.along_mm..vertex.along_mm + self.mesh.gap_mm(self.outline, from);
        let off = |n: usize| {
            let point = cubic.position(n as f64 / PLACES as f64);
            self.outline.distance(vertex.of_loop, range.clone(), point)
        };
        (0..=PLACES).map(off).fold(0.0, f64::max)
    }

    fn add_strip(&mut self, strip: &Strip) {
        let last = strip.len() - 1;
        // The arc lengths of the rails from ruling to ruling; the left one runs back along the
        // boundary.
        let gaps: Vec<[f64; 2]> = strip
            .windows(2)
            .map(|pair| {
                [
                    self.mesh.gap_mm(self.outline, pair[0][0]),
                    self.mesh.gap_mm(self.outline, pair[1][1]),
                ]
            })
            .collect();
        let mut knots = vec![0.0];
        for gap in &gaps {
            knots.push(knots[knots.len() - 1] + 0.5 * (gap[0] + gap[1]));
        }
        let rails = [0, 1].map(|side| {
            let slopes: Vec<f64> = gaps
                .iter()
                .zip(knots.windows(2))
                .map(|(gap, knots)| gap[side] / (knots[1] - knots[0]))
                .collect();
            let speeds = speeds(&knots, &slopes);
            let points: Vec<Point3> =
                strip.iter().map(|ruling| self.done.vertices[ruling[side]]).collect();
            let derivatives: Vec<Vec3> = (0..=last)
                .map(|i| {
                    let leaves = if side == 0 { i < last } else { i == last };
                    let towards = if leaves { Side::Leaving } else { Side::Arriving };
                    let way = if side == 0 { 1.0 } else { -1.0 };
                    self.tangent(strip[i][side], towards) * (way * speeds[i])
                })
                .collect();
            Rail::new(&knots, &points, &derivatives)
        });
        let spans = [0, 1].map(|side| rails[side].spans());
        for i in 0..last {
            let back = spans[1][i].reversed();
            let off = self.deviation(strip[i][0], &spans[0][i]);
            let off = off.max(self.deviation(strip[i + 1][1], &back));
            self.done.deviation_max_mm = self.done.deviation_max_mm.max(off);
            for n in 0..=PLACES {
                let t = n as f64 / PLACES as f64;
                let ruling = spans[1][i].position(t) - spans[0][i].position(t);
                let normal = |side: usize| spans[side][i].derivative(t).cross(ruling);
                let warp = angle_between(normal(0), normal(1));
                self.done.warp_max = self.done.warp_max.max(warp);
            }
        }
        let [first, end] = [strip[0], strip[last]];
        let [on_right, on_left] = rails;
        let right = self.spline(first[0], end[0], on_right);
        let left = self.spline(first[1], end[1], on_left);
        let (over, back) = (self.line(end[0], end[1]), self.line(first[1], first[0]));
        let border = vec![(right, false), over, (left, true), back];
        self.done.faces.push(SmoothFace { shape: FaceShape::Ruled([right, left]), border });
    }

    fn add_plane(&mut self, face: &[usize]) {
        let at = |n: usize| self.done.vertices[face[n]];
        if let [a, b, c, d] = *face {
            let distance = distance_of_diagonals([0, 1, 2, 3].map(at)).map_or(0.0, |(h, _)| h);
            if distance.abs() > PLANE.length_mm(self.size) {
                self.add_plane(&[a, b, c]);
                self.add_plane(&[a, c, d]);
                return;
            }
        }
        let count = face.len();
        let doubled: Vec3 = (1..count - 1).map(|n| (at(n) - at(0)).cross(at(n + 1) - at(0))).sum();
        let longest = (0..count).map(|n| at(n).distance(at((n + 1) % count))).fold(0.0, f64::max);
        let Some(normal) =
            unit(doubled).filter(|_| doubled.length() > LEAST_AREA * longest * longest)
        else {
            return;
        };
        let mut border = Vec::with_capacity(count);
        for n in 0..count {
            let (from, to) = (face[n], face[(n + 1) % count]);
            let is_inside = self.mesh.next(from) != to;
            border.push(if is_inside || is_straight_end(self.mesh, self.outline, from, to) {
                self.line(from, to)
            } else {
                let gap = self.mesh.gap_mm(self.outline, from);
                let laid = |tangent: Vec3| (tangent - normal * normal.dot(tangent)) * gap;
                let [leaving, arriving] = [
                    laid(self.tangent(from, Side::Leaving)),
                    laid(self.tangent(to, Side::Arriving)),
                ];
                let ends = [from, to].map(|i| self.done.vertices[i]);
                let span = Cubic::hermite(ends[0], leaving, ends[1], arriving);
                let off = self.deviation(from, &span);
                self.done.deviation_max_mm = self.done.deviation_max_mm.max(off);
                let rail = Rail { knots: vec![0.0, gap], control: span.control.to_vec() };
                (self.spline(from, to, rail), false)
            });
        }
        self.done.faces.push(SmoothFace { shape: FaceShape::Plane(normal), border });
    }
}

/// The slope at each knot of the curve with these slopes between them: inside that of the parabola
/// through three, limited so that the curve does not run back; at the ends that with the most even
/// outer span.
fn speeds(knots: &[f64], slopes: &[f64]) -> Vec<f64> {
    let last = slopes.len();
    let step = |i: usize| knots[i + 1] - knots[i];
    let mut speeds: Vec<f64> = (0..=last)
        .map(|i| {
            if i == 0 || i == last {
                return slopes[i.min(last - 1)];
            }
            let (before, behind) = (step(i - 1), step(i));
            let parabola = (slopes[i - 1] * behind + slopes[i] * before) / (before + behind);
            // With three times the slope of a span at both its ends, its cubic would stop half-way.
            parabola.min(2.0 * slopes[i - 1].min(slopes[i]))
        })
        .collect();
    if last > 1 {
        let outer = |slope: f64, inner: f64| (1.5 * slope - 0.5 * inner).max(0.25 * slope);
        speeds[0] = outer(slopes[0], speeds[1]);
        speeds[last] = outer(slopes[last - 1], speeds[last - 1]);
    }
    speeds
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rail_has_the_points_and_derivatives_that_it_was_made_of() {
        let p = Point3::new;
        let knots = [0.0, 1.0, 3.0, 3.5];
        let points = [p(0., 0., 0.), p(1., 1., 0.), p(3., 0., 1.), p(4., 0., 0.)];
        let derivatives = [
            Vec3::X,
            Vec3::new(1.0, -0.5, 0.2),
            Vec3::new(0.7, 0.1, -1.0),
            Vec3::new(2.0, 0.0, 0.0),
        ];
        let rail = Rail::new(&knots, &points, &derivatives);
        assert_eq!(rail.control.len(), 8);
        for (i, span) in rail.spans().into_iter().enumerate() {
            let step = knots[i + 1] - knots[i];
            for (t, n) in [(0.0, i), (1.0, i + 1)] {
                assert!(span.position(t).distance(points[n]) < 1e-14);
                assert!((span.derivative(t) / step - derivatives[n]).length() < 1e-13);
            }
        }
    }
}
