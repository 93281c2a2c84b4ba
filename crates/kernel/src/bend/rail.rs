//! The two sides of a run: how far the tangent plane has turned at each place along them.
//!
//! A triangle with a side on the rail touches the smooth surface about the middle of that side, so
//! the plane of the triangle is that of the surface there. In a corner of the border, and in an
//! apex, the plane turns while the ruling stays.

use super::Laid;
use super::strip::{Strip, Tip};
use crate::measure::{Measures, SHARP_CREASE_DEG};
use crate::mesh::Mesh;
use crate::sheet::Sheet;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point2, angle_between, from_deg};
use std::ops::Range;

/// A border turns in a corner by this many times what it turns beside it, on the straighter side.
const ALONE: f64 = 3.0;

/// The vertices of a sheet in which a ruling stays while the tangent plane turns.
pub(super) struct Corners {
    is_corner: Vec<bool>,
    is_apex: Vec<bool>,
}

impl Corners {
    /// Those of a sheet: where its border has a corner that no finer sampling would divide, or
    /// where rulings run together.
    pub(super) fn of(sheet: &Sheet, measures: &Measures) -> Self {
        let mesh = sheet.mesh();
        let count = mesh.positions().len();
        let mut is_corner = vec![false; count];
        for line in mesh.loops() {
            let turns = turns(mesh, line);
            let m = turns.len();
            for n in 0..m {
                let most = |steps: [usize; 2]| {
                    steps.into_iter().map(|step| turns[(n + step) % m]).fold(0.0, f64::max)
                };
                let beside = most([m - 1, m - 2]).min(most([1, 2]));
                is_corner[line[n].get()] =
                    turns[n] > from_deg(SHARP_CREASE_DEG) && turns[n] > ALONE * beside;
            }
        }
        let mut is_apex = vec![false; count];
        if sheet.has_rungs() {
            let apexes: Vec<_> = measures.apexes.iter().map(|apex| apex.sample).collect();
            for (n, is_apex) in is_apex.iter_mut().enumerate() {
                *is_apex = apexes.contains(&sheet.sample(VertexIndex::new(n)));
            }
        }
        Self { is_corner, is_apex }
    }

    pub(super) fn is_corner(&self, vertex: VertexIndex) -> bool {
        self.is_corner[vertex.get()]
    }

    fn stays(&self, vertex: VertexIndex) -> bool {
        self.is_corner(vertex) || self.is_apex[vertex.get()]
    }
}

/// By how much a loop turns at each of its vertices in space, radians.
fn turns(mesh: &Mesh, line: &[VertexIndex]) -> Vec<f64> {
    let m = line.len();
    let at = |n: usize| mesh.position(line[n % m]);
    (0..m).map(|n| angle_between(at(n) - at(n + m - 1), at(n + 1) - at(n))).collect()
}

/// A side of a run.
#[derive(Debug, Default)]
pub(super) struct Rail {
    vertices: Vec<VertexIndex>,
    points: Vec<Point2>,
    /// How far each of them lies from the beginning of the strip, mm.
    along_mm: Vec<f64>,
    /// The triangle of the run that each step from point to point is a side of.
    of_steps: Vec<usize>,
    /// The places where a triangle of the run gives the tangent plane, in order.
    pub(super) places: Vec<RailPlace>,
}

/// A place of a rail with the triangle whose plane touches the surface there.
#[derive(Clone, Copy, Debug)]
pub(super) struct RailPlace {
    /// How far it lies from the beginning of the strip, mm.
    pub(super) along_mm: f64,
    /// The number of the triangle in the run.
    pub(super) triangle: usize,
}

impl Rail {
    fn from(vertex: VertexIndex, along_mm: f64, laid: &Laid<'_>) -> Self {
        let points = vec![laid.flat[vertex.get()]];
        Self { vertices: vec![vertex], points, along_mm: vec![along_mm], ..Self::default() }
    }

    /// Goes on to a vertex, along a side of a triangle.
    fn step(&mut self, to: VertexIndex, triangle: usize, laid: &Laid<'_>) {
        let point = laid.flat[to.get()];
        let last = self.points.len() - 1;
        self.along_mm.push(self.along_mm[last] + self.points[last].distance(point));
        self.points.push(point);
        self.vertices.push(to);
        self.of_steps.push(triangle);
    }

    /// Notes its places, once it has all steps.
    fn placed(mut self, laid: &Laid<'_>) -> Self {
        for (n, &triangle) in self.of_steps.iter().enumerate() {
            let at = self.along_mm[n];
            if n > 0 && laid.corners.stays(self.vertices[n]) {
                let before = self.of_steps[n - 1];
                self.places.push(RailPlace { along_mm: at, triangle: before });
                self.places.push(RailPlace { along_mm: at, triangle });
            }
            let middle = 0.5 * (at + self.along_mm[n + 1]);
            self.places.push(RailPlace { along_mm: middle, triangle });
        }
        self
    }

    /// How far its end lies from the beginning of the strip, mm.
    pub(super) fn length_mm(&self) -> f64 {
        self.along_mm.last().copied().unwrap_or(0.0)
    }

    /// How far its beginning lies from that of the strip, mm.
    pub(super) fn start_mm(&self) -> f64 {
        self.along_mm.first().copied().unwrap_or(0.0)
    }

    /// The point on the pattern so far along, mm.
    pub(super) fn point(&self, along_mm: f64) -> Point2 {
        let after = self.along_mm.partition_point(|&at| at <= along_mm);
        let n = after.clamp(1, self.points.len().max(2) - 1);
        let (Some(&from), Some(&to)) = (self.points.get(n - 1), self.points.get(n)) else {
            return self.points.first().copied().unwrap_or_default();
        };
        let length = self.along_mm[n] - self.along_mm[n - 1];
        from.lerp(to, ((along_mm - self.along_mm[n - 1]) / length).clamp(0.0, 1.0))
    }
}

/// The left and the right rail of a run of a strip, which begin so far along its sides, mm.
pub(super) fn rails(
    strip: &Strip,
    run: &Range<usize>,
    laid: &Laid<'_>,
    along_mm: [f64; 2],
) -> [Rail; 2] {
    let last = strip.triangles.len() - 1;
    let corner = |triangle: usize, rung| strip.far(laid.mesh, triangle, rung);
    // A run of one triangle has no rung inside; its rails are where it begins and ends.
    let begins = match (run.start, strip.starts_inside) {
        (0, false) => strip.ends.first().and_then(|&rung| {
            let tip = corner(0, rung)?;
            Some((tip, rung, Tip::of(tip, rung, laid)))
        }),
        _ => None,
    };
    let from = |ends: [VertexIndex; 2]| [0, 1].map(|n| Rail::from(ends[n], along_mm[n], laid));
    let mut rails = match begins {
        Some((tip, [left, right], kind)) => {
            let mut rails = match kind {
                Tip::Point => from([tip, tip]),
                Tip::Left => from([left, tip]),
                Tip::Right => from([tip, right]),
            };
            if kind != Tip::Left {
                rails[0].step(left, 0, laid);
            }
            if kind != Tip::Right {
                rails[1].step(right, 0, laid);
            }
            rails
        }
        None => from(strip.ends[run.start.saturating_sub(1)]),
    };
    let first = if begins.is_some() || run.start == 0 { 1 } else { run.start };
    for triangle in first..run.end {
        let number = triangle - run.start;
        let [left, right] = strip.ends[triangle - 1];
        if triangle < last {
            let next = strip.ends[triangle];
            if next[0] == left {
                rails[1].step(next[1], number, laid);
            } else {
                rails[0].step(next[0], number, laid);
            }
        } else if let Some(tip) = corner(triangle, [left, right]) {
            let kind = Tip::of(tip, [left, right], laid);
            if kind != Tip::Left {
                rails[0].step(tip, number, laid);
            }
            if kind != Tip::Right {
                rails[1].step(tip, number, laid);
            }
        }
    }
    rails.map(|rail| rail.placed(laid))
}
