//! Making all quads planar.
//!
//! Both ends of every rung may slide along the boundary, and every quad sets one condition, that
//! its diagonals meet. So there are about twice as many unknowns as equations, and where a
//! developable surface passes through the boundary, there are planar quads near it \[LPW06\]. The
//! equation of a quad with the corners a, b, c, d is h = 0, with h = n · (b − a) the distance of
//! its diagonals ac and bd, and n the direction of (c − a) × (d − b). The derivative of h is n
//! times the relative motion of the two points where the diagonals are nearest. Up to a factor that
//! makes it a length, h is the volume of the tetrahedron of the corners.
//!
//! Of all moves that satisfy the equations, the one with the least squares is wanted: Newton's
//! method, each step the shortest that solves the linear equations (J H⁻¹ Jᵀ λ = …, one row a quad,
//! which is a chain for a strip, see `solve`); and from a planar mesh, steps along the equations
//! that shorten the moves in all. H also holds a barrier, so that no two vertices meet on the
//! boundary.
//!
//! Sliding alone may not suffice: with straight skew rails no quad is planar, and no surface
//! through the edges of a twisted plank has planar quads. Then vertices may leave the outline by as
//! little as suffices: moves off the outline weigh [`OFF_WEIGHTS`] times as much as moves along it.

use super::solve::Symmetric;
use super::{QuadMesh, Vertex};
use sheetwright_geometry::boundary::{Outline, Side};
use sheetwright_geometry::math::{Point3, Vec3, ln, unit};
use sheetwright_geometry::tolerance::Tolerance;
use sheetwright_geometry::watch::Watch;

/// Weights of the squares of moves off the outline against those along it. Where no planar mesh is
/// found with the first, the next is tried, and from its result the first again.
const OFF_WEIGHTS: [f64; 3] = [1e4, 1e2, 1.0];
/// The weight of the barrier between neighbours, as a share of the square of their first distance:
/// small against the moves that it must prevent, which are of that distance.
const BARRIER: f64 = 0.005;
/// Neighbours stay apart by this share of their first distance.
const LEAST_GAP: f64 = 0.01;
/// Neighbours that would limit a step to less than this share are held.
const LEAST_SHARE: f64 = 0.25;
/// Limit of the rounds of holding more neighbours, before a step is taken as it is.
const MOST_HOLDS: usize = 12;
/// Limit of the steps that make quads planar; from a good start five suffice.
const MOST_STEPS: usize = 80;
/// Limit of the steps that shorten the moves.
const MOST_SHORTENINGS: usize = 30;
/// Shortening ends when it gains less than this share.
const GAIN: f64 = 1e-3;
/// The number added to the diagonal of the equations, as a share of its largest entry.
const RIDGE: f64 = 1e-13;

/// Options of making quads planar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarOptions {
    /// The largest distance allowed between the diagonals of a quad, as a share of the size of the
    /// boundary.
    pub even: Tolerance,
    /// The largest distance allowed of a vertex from the outline where sliding along it does not
    /// suffice, mm; 0: vertices stay on it.
    pub leave_mm: f64,
}

/// How making quads planar ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlanarEnd {
    /// All quads are planar, and all vertices are on the outline.
    OnOutline,
    /// All quads are planar, and some vertices are off the outline.
    OffOutline,
    /// Planar quads need vertices farther off the outline than allowed: the mesh has them on the
    /// outline, with the quads as near to planar as was reached, or unchanged.
    TooFarOff,
    /// Even off the outline, no planar quads were found that do not cross themselves: the mesh is
    /// unchanged.
    NotFound,
    /// The watch stopped it: the mesh is unchanged.
    Stopped,
}

/// A mesh of planar quads, and how far its vertices moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Planar {
    /// The mesh.
    pub mesh: QuadMesh,
    /// How it ended.
    pub end: PlanarEnd,
    /// The largest distance between the diagonals of a quad before, mm.
    pub uneven_before_mm: f64,
    /// The largest distance between the diagonals of a quad after, mm.
    pub uneven_after_mm: f64,
    /// The largest displacement of a vertex, mm.
    pub moved_max_mm: f64,
    /// The largest distance of a vertex from the outline, mm; for [`PlanarEnd::TooFarOff`] the
    /// distance that would be needed.
    pub off_max_mm: f64,
    /// Steps that were taken.
    pub steps: usize,
}

/// The distance of the diagonals of a quad with a sign, mm, and its derivatives by its four
/// corners; `None` where they are parallel, or one has no length.
pub(super) fn distance_of_diagonals(at: [Point3; 4]) -> Option<(f64, [Vec3; 4])> {
    let [a, b, c, d] = at;
    let (ac, bd, ab) = (c - a, d - b, b - a);
    let cross = ac.cross(bd);
    let n = unit(cross)?;
    // The places where the diagonals are nearest, as shares of them.
    let square = cross.length_squared();
    let on_ac = ab.cross(bd).dot(cross) / square;
    let on_bd = ab.cross(ac).dot(cross) / square;
    if !(on_ac.is_finite() && on_bd.is_finite()) {
        return None;
    }
    let derivatives = [n * (on_ac - 1.0), n * (1.0 - on_bd), n * -on_ac, n * on_bd];
    Some((n.dot(ab), derivatives))
}

/// Makes the quads of a mesh over an outline planar, with small moves of its vertices.
pub fn planar(
    mesh: &QuadMesh,
    outline: &Outline,
    options: &PlanarOptions,
    watch: &mut dyn Watch,
) -> Planar {
    let size = sheetwright_geometry::boundary::size_of(mesh.vertices.iter().map(|v| v.position));
    let allowed = options.even.length_mm(size);
    // Newton's steps go on to a tenth of it, as far as rounding lets them.
    let enough = 0.1 * allowed;
    let before = mesh.unevenness_max_mm();
    let start =
        Moved { along: vec![0.0; mesh.vertices.len()], off: vec![Vec3::ZERO; mesh.vertices.len()] };
    let mut search = Search::new(mesh, outline, enough);
    let mut end = PlanarEnd::OnOutline;
    let mut found = search.run(&start, None, watch);
    let mut off_max_mm = 0.0;
    if !search.is_even(&found, allowed) {
        let off = search.off_outline(&start, allowed, watch);
        off_max_mm = off.off.iter().map(|off| off.length()).fold(0.0, f64::max);
        if !search.is_even(&off, allowed) {
            (end, found, off_max_mm) = (PlanarEnd::NotFound, start.clone(), 0.0);
        } else if off_max_mm > options.leave_mm {
            end = PlanarEnd::TooFarOff;
            if search.uneven(&found) >= before || search.is_crossed(&found) {
                found = start.clone();
            }
        } else {
            (end, found) = (PlanarEnd::OffOutline, off);
        }
    }
    if watch.stop() {
        (end, found, off_max_mm) = (PlanarEnd::Stopped, start, 0.0);
    }
    let steps = search.steps;
    let mesh_after = search.mesh_of(&found);
    let pairs = mesh.vertices.iter().zip(&mesh_after.vertices);
    let moved_max_mm = pairs.map(|(a, b)| a.position.distance(b.position)).fold(0.0, f64::max);
    Planar {
        end,
        uneven_before_mm: before,
        uneven_after_mm: mesh_after.unevenness_max_mm(),
        moved_max_mm,
        off_max_mm,
        steps,
        mesh: mesh_after,
    }
}

/// The moves of vertices.
#[derive(Clone, Debug)]
struct Moved {
    /// Along the outline, mm.
    along: Vec<f64>,
    /// Off it, mm.
    off: Vec<Vec3>,
}

impl Moved {
    fn stepped(&self, step: &Self, share: f64) -> Self {
        let along = self.along.iter().zip(&step.along).map(|(a, s)| a + s * share);
        let off = self.off.iter().zip(&step.off).map(|(o, &s)| *o + s * share);
        Self { along: along.collect(), off: off.collect() }
    }
}

/// The distance of the diagonals of a quad, and its derivatives.
struct Equation {
    distance: f64,
    corners: [usize; 4],
    by_along: [f64; 4],
    by_off: [Vec3; 4],
}

struct Search<'a> {
    mesh: &'a QuadMesh,
    outline: &'a Outline,
    quads: Vec<[usize; 4]>,
    /// The original arc length from each vertex to the next, mm.
    gaps: Vec<f64>,
    enough: f64,
    steps: usize,
}

impl<'a> Search<'a> {
    fn new(mesh: &'a QuadMesh, outline: &'a Outline, enough: f64) -> Self {
        let count = mesh.vertices.len();
        let quads = mesh.faces().filter_map(|face| <[usize; 4]>::try_from(face).ok()).collect();
        let gaps = (0..count).map(|i| mesh.gap_mm(outline, i)).collect();
        Self { mesh, outline, quads, gaps, enough, steps: 0 }
    }

    fn gap(&self, at: &Moved, i: usize) -> f64 {
        self.mesh.gap_of_moved_mm(self.outline, i, |n| at.along[n])
    }

    fn place(&self, moved: &Moved, i: usize) -> (Point3, Vec3) {
        let Vertex { of_loop, along_mm, position, .. } = self.mesh.vertices[i];
        let on = self.outline.at(of_loop, along_mm + moved.along[i], Side::Leaving);
        let position = if moved.along[i] == 0.0 { position } else { on.position };
        (position + moved.off[i], on.tangent)
    }

    fn mesh_of(&self, moved: &Moved) -> QuadMesh {
        let mut mesh = self.mesh.clone();
        for (i, vertex) in mesh.vertices.iter_mut().enumerate() {
            vertex.position = self.place(moved, i).0;
            vertex.along_mm += moved.along[i];
        }
        mesh
    }

    fn equations(&self, moved: &Moved) -> Vec<Equation> {
        let places: Vec<(Point3, Vec3)> =
            (0..self.mesh.vertices.len()).map(|i| self.place(moved, i)).collect();
        self.quads
            .iter()
            .map(|&corners| {
                let at = corners.map(|i| places[i].0);
                let (distance, by_off) =
                    distance_of_diagonals(at).unwrap_or((0.0, [Vec3::ZERO; 4]));
                let by_along = [0, 1, 2, 3].map(|n| by_off[n].dot(places[corners[n]].1));
                Equation { distance, corners, by_along, by_off }
            })
            .collect()
    }

    fn uneven(&self, moved: &Moved) -> f64 {
        uneven(&self.equations(moved))
    }

    /// Whether all quads are planar, and no more of them cross themselves than at the start.
    fn is_even(&self, moved: &Moved, allowed: f64) -> bool {
        self.uneven(moved) <= allowed && !self.is_crossed(moved)
    }

    /// Whether more quads cross themselves than at the start: planar, but no faces.
    fn is_crossed(&self, moved: &Moved) -> bool {
        self.mesh_of(moved).crossed_quads() > self.mesh.crossed_quads()
    }

    /// Planar quads whose vertices may leave the outline, or the nearest to planar that was found.
    fn off_outline(&mut self, start: &Moved, allowed: f64, watch: &mut dyn Watch) -> Moved {
        let mut found = start.clone();
        for weight in OFF_WEIGHTS {
            found = self.run(start, Some(weight), watch);
            if self.is_even(&found, allowed) {
                if weight < OFF_WEIGHTS[0] {
                    let nearer = self.run(&found, Some(OFF_WEIGHTS[0]), watch);
                    if self.is_even(&nearer, allowed) {
                        found = nearer;
                    }
                }
                break;
            }
        }
        found
    }

    /// The best planar quads with short moves that were found from a start. Vertices may leave the
    /// outline if `leave` gives a weight for that.
    fn run(&mut self, start: &Moved, leave: Option<f64>, watch: &mut dyn Watch) -> Moved {
        let mut best = self.made_even(start.clone(), leave, watch);
        if self.uneven(&best) > self.enough {
            return best;
        }
        let mut cost = self.cost(&best, leave);
        for _ in 0..MOST_SHORTENINGS {
            if watch.stop() {
                break;
            }
            let (step, mut share) = self.free_step(&best, leave, true);
            let mut shorter = None;
            for _ in 0..6 {
                let tried = self.made_even(best.stepped(&step, share), leave, watch);
                let tried_cost = self.cost(&tried, leave);
                if tried_cost < cost && self.uneven(&tried) <= self.enough {
                    shorter = Some((tried, tried_cost));
                    break;
                }
                share *= 0.3;
            }
            let Some((tried, tried_cost)) = shorter else { break };
            let gained = (cost - tried_cost) / cost;
            (best, cost) = (tried, tried_cost);
            if gained < GAIN {
                break;
            }
        }
        best
    }

    /// Newton's steps until all quads are planar, or no step makes them more so.
    fn made_even(&mut self, start: Moved, leave: Option<f64>, watch: &mut dyn Watch) -> Moved {
        let mut at = start;
        let mut sum = squares(&self.equations(&at));
        for _ in 0..MOST_STEPS {
            if self.uneven(&at) <= self.enough || watch.stop() {
                break;
            }
            self.steps += 1;
            let (step, mut share) = self.free_step(&at, leave, false);
            let mut better = None;
            for _ in 0..12 {
                let tried = at.stepped(&step, share);
                let tried_sum = squares(&self.equations(&tried));
                if tried_sum < sum && !self.is_crossed(&tried) {
                    better = Some((tried, tried_sum));
                    break;
                }
                share *= 0.5;
            }
            let Some((tried, tried_sum)) = better else { break };
            (at, sum) = (tried, tried_sum);
        }
        at
    }

    /// A step, and the share of it that can be taken. Where neighbours would limit that share too
    /// much, they are held, and the step is computed again without their sliding.
    fn free_step(&self, at: &Moved, leave: Option<f64>, shorten: bool) -> (Moved, f64) {
        let mut held: Vec<bool> = self.mesh.vertices.iter().map(|v| v.is_corner).collect();
        let mut step = self.step(at, leave, shorten, &held);
        for _ in 0..MOST_HOLDS {
            let tight = |i: &usize| self.share_of_gap(at, &step, *i) < LEAST_SHARE;
            let tight: Vec<usize> = (0..self.gaps.len()).filter(tight).collect();
            if tight.is_empty() {
                break;
            }
            for i in tight {
                held[i] = true;
                held[self.mesh.next(i)] = true;
            }
            step = self.step(at, leave, shorten, &held);
        }
        let shares = (0..self.gaps.len()).map(|i| self.share_of_gap(at, &step, i));
        let share = shares.fold(1.0, f64::min);
        (step, share)
    }

    /// The step of Newton's method in which `held` vertices do not slide; with `shorten` also
    /// towards shorter moves.
    fn step(&self, at: &Moved, leave: Option<f64>, shorten: bool, held: &[bool]) -> Moved {
        let count = self.mesh.vertices.len();
        let (slopes, stiffness) = self.slopes_along(at);
        let mut equations = self.equations(at);
        for equation in &mut equations {
            for (n, &i) in equation.corners.iter().enumerate() {
                if held[i] {
                    equation.by_along[n] = 0.0;
                }
            }
        }
        let slope_share = if shorten { 1.0 } else { 0.0 };
        let mut of_vertex: Vec<Vec<(usize, usize)>> = vec![Vec::new(); count];
        for (q, equation) in equations.iter().enumerate() {
            for (n, &i) in equation.corners.iter().enumerate() {
                of_vertex[i].push((q, n));
            }
        }
        let mut matrix = Symmetric::new(equations.len());
        let mut right: Vec<f64> = equations.iter().map(|e| e.distance).collect();
        for (i, uses) in of_vertex.iter().enumerate() {
            for (k, &(q, n)) in uses.iter().enumerate() {
                let e = &equations[q];
                right[q] -= slope_share * e.by_along[n] * slopes[i] / stiffness[i];
                if leave.is_some() {
                    right[q] -= slope_share * e.by_off[n].dot(at.off[i]);
                }
                for &(r, m) in &uses[k..] {
                    let f = &equations[r];
                    let mut entry = e.by_along[n] * f.by_along[m] / stiffness[i];
                    if let Some(weight) = leave {
                        entry += e.by_off[n].dot(f.by_off[m]) / weight;
                    }
                    matrix.add(q, r, entry);
                }
            }
        }
        let factors = matrix.solved(&right, RIDGE);
        let mut step = Moved { along: vec![0.0; count], off: vec![Vec3::ZERO; count] };
        for (i, uses) in of_vertex.iter().enumerate() {
            let (mut along, mut off) =
                (slope_share * slopes[i], at.off[i] * (slope_share * leave.unwrap_or(0.0)));
            for &(q, n) in uses {
                along += equations[q].by_along[n] * factors[q];
                off += equations[q].by_off[n] * factors[q];
            }
            if !held[i] {
                step.along[i] = -along / stiffness[i];
            }
            if let Some(weight) = leave {
                step.off[i] = -off / weight;
            }
        }
        step
    }

    /// The cost of the moves: half their squares, and the barrier.
    fn cost(&self, at: &Moved, leave: Option<f64>) -> f64 {
        let off_weight = leave.unwrap_or(0.0);
        let moves = at.along.iter().zip(&at.off);
        let squares: f64 = moves.map(|(a, o)| a * a + off_weight * o.length_squared()).sum();
        let barrier: f64 = (0..self.gaps.len())
            .map(|i| {
                let share = self.gap(at, i) / self.gaps[i];
                // x − ln x, which is least for no move.
                BARRIER * self.gaps[i] * self.gaps[i] * (share - ln(share))
            })
            .sum();
        0.5 * squares + barrier
    }

    /// The derivative of the cost by each move along, and a bound of the second derivative.
    fn slopes_along(&self, at: &Moved) -> (Vec<f64>, Vec<f64>) {
        let (mut slopes, mut stiffness) = (at.along.clone(), vec![1.0; at.along.len()]);
        for i in 0..self.gaps.len() {
            let gap = self.gap(at, i);
            let share = gap / self.gaps[i];
            let slope = BARRIER * self.gaps[i] * (1.0 - 1.0 / share);
            let second = 2.0 * BARRIER / (share * share);
            let next = self.mesh.next(i);
            slopes[next] += slope;
            slopes[i] -= slope;
            stiffness[next] += second;
            stiffness[i] += second;
        }
        (slopes, stiffness)
    }

    /// The share of a step that the gap after a vertex allows: the gap shrinks by no more than
    /// half, and not below [`LEAST_GAP`].
    fn share_of_gap(&self, at: &Moved, step: &Moved, i: usize) -> f64 {
        let gap = self.gap(at, i);
        let shrinks = step.along[i] - step.along[self.mesh.next(i)];
        let room = (0.5 * gap).min(gap - LEAST_GAP * self.gaps[i]).max(0.0);
        if shrinks > room { room / shrinks } else { 1.0 }
    }
}

fn uneven(equations: &[Equation]) -> f64 {
    equations.iter().map(|e| e.distance.abs()).fold(0.0, f64::max)
}

fn squares(equations: &[Equation]) -> f64 {
    equations.iter().map(|e| e.distance * e.distance).sum()
}
