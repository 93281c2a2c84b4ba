//! The choice of a view that shows the shape of a surface well.

use sheetwright::boundary::size_of;
use sheetwright::index::TriangleIndex;
use sheetwright::make::{Origin, Part};
use sheetwright::math::{Point2, Point3, Vec3, cos, from_deg, sin, unit};

/// A parallel projection, world z up where that has a meaning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct View {
    pub(crate) right: Vec3,
    pub(crate) up: Vec3,
    /// The unit direction from the surface to the eye.
    pub(crate) toward: Vec3,
}

impl View {
    /// The view from an eye in the direction `toward`.
    pub(crate) fn from(toward: Vec3) -> Self {
        let toward = unit(toward).unwrap_or(Vec3::Z);
        // Seen from right above, y is up.
        let vertical = if toward.z.abs() > 0.999 { Vec3::Y } else { Vec3::Z };
        let right = unit(vertical.cross(toward)).unwrap_or(Vec3::X);
        Self { right, up: toward.cross(right), toward }
    }

    /// Where a direction points in the picture; y is up.
    pub(crate) fn direction(&self, way: Vec3) -> Point2 {
        Point2::new(way.dot(self.right), way.dot(self.up))
    }

    /// Where a point lies in the picture, mm; y is up.
    pub(crate) fn project(&self, point: Point3) -> Point2 {
        self.direction(point.to_vec())
    }

    /// The nearness of a point to the eye, mm: its coordinate along `toward`.
    pub(crate) fn nearness(&self, point: Point3) -> f64 {
        point.to_vec().dot(self.toward)
    }
}

/// The number of directions round the horizon that are tried.
const AZIMUTHS: u32 = 24;
/// The elevations above the horizon that are tried, degrees, each with its penalty.
const ELEVATIONS: [(f64, f64); 5] =
    [(20.0, 0.0), (35.0, 0.0), (55.0, 0.1), (75.0, 0.2), (-25.0, 0.25)];
/// The best share of the surface's area that faces the eye: head on (1) it looks flat, edge on (0)
/// it is invisible.
const FACING: f64 = 0.78;
/// The best visible share of the panel's length: in full length, a tube looks like a plate.
const LENGTH: f64 = 0.9;

/// The choice of a view uses about this many triangles, or one per panel if there are more panels.
const LOOKED_AT: usize = 20_000;

/// The view of some parts, from the side that they face: the best of some dozens. It shows most of
/// them, at an angle, nearly in full length and with little of their back.
pub(crate) fn view_of(parts: &[Part]) -> View {
    let mut areas: Vec<Vec3> = Vec::new();
    let mut long = Vec3::ZERO;
    let triangles = |part: &Part| part.sheet.mesh().triangles().len();
    let step = parts.iter().map(triangles).sum::<usize>().div_ceil(LOOKED_AT).max(1);
    for part in parts {
        let mesh = part.sheet.mesh();
        let all = (0..triangles(part)).step_by(step);
        areas.extend(all.map(|n| mesh.area_vector(TriangleIndex::new(n))));
        let size = match &part.origin {
            Origin::Found(found) => found.boundary.size(),
            Origin::Given(_) => part.piece.size.length(),
        };
        let of_part = longest_direction(mesh.positions(), &part.flat.points) * size;
        // The first part decides which way is right.
        long += if of_part.dot(long) < 0.0 { -of_part } else { of_part };
    }
    best_view(&areas, long)
}

/// The best view of triangles with these area vectors; `long` is the direction of their greatest
/// length.
fn best_view(areas: &[Vec3], long: Vec3) -> View {
    let long = unit(long).unwrap_or(Vec3::X);
    let mut best: Option<(f64, View)> = None;
    for step in 0..AZIMUTHS {
        let azimuth = from_deg(360.0 / f64::from(AZIMUTHS) * f64::from(step));
        for (elevation, against) in ELEVATIONS {
            let (level, height) = (cos(from_deg(elevation)), sin(from_deg(elevation)));
            let toward = Vec3::new(level * cos(azimuth), level * sin(azimuth), height);
            let view = View::from(toward);
            let score = score(&view, areas, long) - against;
            // Equally good views differ by rounding alone: a margin makes the first of them win.
            if best.is_none_or(|(most, _)| score > most + 1e-9) {
                best = Some((score, view));
            }
        }
    }
    best.map_or(View::from(Vec3::Z), |(_, view)| view)
}

fn score(view: &View, areas: &[Vec3], long: Vec3) -> f64 {
    let whole: f64 = areas.iter().map(|a| a.length()).sum();
    let share =
        |sign: f64| areas.iter().map(|a| (sign * a.dot(view.toward)).max(0.0)).sum::<f64>() / whole;
    let (front, back) = (share(1.0), share(-1.0));
    let along = view.direction(long);
    let facing = 1.0 - (front - FACING).abs();
    let length = 1.0 - (along.to_vec().length() - LENGTH).abs();
    // The left side of the pattern should be on the left here.
    2.0 * facing - 1.5 * back + 1.5 * length + 0.5 * along.x
}

/// The direction in space of the flat pattern's x, its longer side: the sum over all samples of
/// their vector in space times their x on the pattern, relative to the mean.
fn longest_direction(space: &[Point3], flat: &[Point2]) -> Vec3 {
    let mean = flat.iter().map(|p| p.x).sum::<f64>() / flat.len() as f64;
    let Some(&first) = space.first() else { return Vec3::X };
    unit(space.iter().zip(flat).map(|(p, f)| (*p - first) * (f.x - mean)).sum()).unwrap_or(Vec3::X)
}

/// Length, width and height of the box around a part along the axes, mm.
pub(crate) fn box_of(part: &Part) -> Vec3 {
    let points = part.sheet.mesh().positions();
    let along =
        |axis: Vec3| size_of(points.iter().map(|p| Point3::from_vec(axis * p.to_vec().dot(axis))));
    Vec3::new(along(Vec3::X), along(Vec3::Y), along(Vec3::Z))
}
