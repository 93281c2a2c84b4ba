//! Entities of DXF as pieces of curves.

use super::super::drawn::MAX_SEGMENTS;
use super::super::segment::{Affine, Segment};
use super::records::Record;
use super::spline::{Spline, through};
use sheetwright::math::{Point3, Vec3, atan2, cos, from_deg, sin, unit};
use std::f64::consts::PI;

/// The pieces of an entity, and whether it is closed.
pub(super) type Pieces = (Vec<Segment>, bool);

/// The map from the coordinates of an entity that stands on a direction of extrusion to those of
/// the world (the arbitrary axis algorithm of the DXF reference).
pub(super) fn extruded(normal: Vec3) -> Affine {
    let Some(z) = unit(normal) else { return Affine::IDENTITY };
    if z == Vec3::Z {
        return Affine::IDENTITY;
    }
    let is_near_z = z.x.abs() < 1.0 / 64.0 && z.y.abs() < 1.0 / 64.0;
    let across = if is_near_z { Vec3::Y.cross(z) } else { Vec3::Z.cross(z) };
    let x = unit(across).unwrap_or(Vec3::X);
    Affine { axes: [x, z.cross(x), z], origin: Vec3::ZERO }
}

/// The pieces of an entity that is a curve by itself; `None` of other entities. `vertices` are
/// those of a polyline.
///
/// # Errors
/// What is wrong with its numbers, in words.
pub(super) fn pieces(
    record: &Record<'_>,
    vertices: &[Record<'_>],
) -> Result<Option<Pieces>, String> {
    let map = extruded(record.normal());
    let on_plane = |(segments, closed): Pieces| {
        (segments.iter().map(|segment| segment.mapped(&map)).collect(), closed)
    };
    Ok(Some(match record.kind {
        "LINE" => (vec![Segment::line(record.point(10), record.point(11))], false),
        "LWPOLYLINE" => on_plane(light_polyline(record)),
        "POLYLINE" => {
            let Some((pieces, is_plane)) = polyline(record, vertices) else { return Ok(None) };
            if is_plane { on_plane(pieces) } else { pieces }
        }
        "ARC" | "CIRCLE" => on_plane(arc(record)),
        "ELLIPSE" => ellipse(record),
        // A helix has its spline with it.
        "SPLINE" | "HELIX" => spline(record)?,
        _ => return Ok(None),
    }))
}

/// Corners with the bulge of the piece that begins there.
fn chain(corners: &[(Point3, f64)], closed: bool) -> Pieces {
    let ends = corners.iter().zip(corners.iter().cycle().skip(1));
    let count = if closed { corners.len() } else { corners.len().saturating_sub(1) };
    // One more than a drawing may have is refused.
    let pieces =
        ends.take(count.min(MAX_SEGMENTS + 1)).map(|((a, bulge), (b, _))| bulged(*a, *b, *bulge));
    (pieces.collect(), closed && corners.len() > 1)
}

/// A bulge below this is rounding: its arc rises by less than 5e-9 of the chord, and its centre is
/// so far that the rest of the digits would not tell where the arc runs.
const LEAST_BULGE: f64 = 1e-8;

/// The piece between two corners with a bulge, the tangent of a quarter of the angle of the arc,
/// positive counter-clockwise; straight with 0.
fn bulged(a: Point3, b: Point3, bulge: f64) -> Segment {
    if bulge.abs() < LEAST_BULGE || !bulge.is_finite() || a == b {
        return Segment::line(a, b);
    }
    let way = b - a;
    let left = Vec3::new(-way.y, way.x, 0.0);
    let centre = a.lerp(b, 0.5) + left * ((1.0 - bulge * bulge) / (4.0 * bulge));
    let from = a - centre;
    let radius = from.length();
    let start = atan2(from.y, from.x);
    let angles = [start, start + 4.0 * atan2(bulge, 1.0)];
    let mut arc = Segment::arc(centre, Vec3::X * radius, Vec3::Y * radius, angles);
    arc.move_end(false, a);
    arc.move_end(true, b);
    arc
}

fn light_polyline(record: &Record<'_>) -> Pieces {
    let z = record.or(38, 0.0);
    let mut corners: Vec<(Point3, f64)> = Vec::new();
    for (code, value) in record.pairs() {
        let value = value.parse().unwrap_or(f64::NAN);
        match (code, corners.last_mut()) {
            (10, _) => corners.push((Point3::new(value, 0.0, z), 0.0)),
            (20, Some((corner, _))) => corner.y = value,
            (42, Some((_, bulge))) => *bulge = value,
            _ => {}
        }
    }
    chain(&corners, record.flags(70) & 1 == 1)
}

/// A polyline, and whether it lies in the plane of its extrusion; `None` of a mesh.
fn polyline(record: &Record<'_>, vertices: &[Record<'_>]) -> Option<(Pieces, bool)> {
    const CLOSED: i64 = 1;
    const IN_SPACE: i64 = 8;
    const MESH: i64 = 16 | 64;
    // The frame of control points of a vertex of a fitted spline.
    const CONTROL: i64 = 16;
    let flags = record.flags(70);
    if flags & MESH != 0 {
        return None;
    }
    let is_plane = flags & IN_SPACE == 0;
    let z = record.or(30, 0.0);
    let drawn = vertices.iter().filter(|vertex| vertex.flags(70) & CONTROL == 0);
    let corners: Vec<(Point3, f64)> = drawn
        .map(|vertex| {
            let p = vertex.point(10);
            match is_plane {
                true => (Point3::new(p.x, p.y, z), vertex.or(42, 0.0)),
                false => (p, 0.0),
            }
        })
        .collect();
    Some((chain(&corners, flags & CLOSED == CLOSED), is_plane))
}

fn arc(record: &Record<'_>) -> Pieces {
    let (centre, radius) = (record.point(10), record.or(40, 0.0));
    let (u, v) = (Vec3::X * radius, Vec3::Y * radius);
    if record.kind == "CIRCLE" {
        return (vec![Segment::arc(centre, u, v, [0.0, 2.0 * PI])], true);
    }
    let [start, end] = [50, 51].map(|code| from_deg(record.or(code, 0.0)));
    (vec![Segment::arc(centre, u, v, [start, ahead(start, end)])], false)
}

/// The angle that is reached counter-clockwise from another one; a whole turn for the same.
fn ahead(start: f64, end: f64) -> f64 {
    let turns = ((end - start) / (2.0 * PI)).floor();
    let way = end - start - turns * 2.0 * PI;
    start + if way > 1e-12 { way } else { 2.0 * PI }
}

fn ellipse(record: &Record<'_>) -> Pieces {
    let major = record.point(11).to_vec();
    let normal = unit(record.normal()).unwrap_or(Vec3::Z);
    let minor = normal.cross(major) * record.or(40, 1.0);
    let (start, end) = (record.or(41, 0.0), record.or(42, 2.0 * PI));
    let end = ahead(start, end);
    let is_whole = (end - start - 2.0 * PI).abs() < 1e-9;
    (vec![Segment::arc(record.point(10), major, minor, [start, end])], is_whole)
}

fn spline(record: &Record<'_>) -> Result<Pieces, String> {
    const CLOSED: i64 = 1;
    let mut control = record.points(10);
    let (mut knots, mut weights) = (record.numbers(40), record.numbers(41));
    // A helix has more numbers behind those of its spline.
    if record.kind == "HELIX" {
        let count = |code| usize::try_from(record.flags(code)).unwrap_or(0);
        control.truncate(count(73));
        knots.truncate(count(72));
        weights.clear();
    }
    if record.kind == "SPLINE" && control.is_empty() {
        let points = record.points(11);
        let closed = record.flags(70) & CLOSED == CLOSED;
        return through(&points, closed);
    }
    let spline =
        Spline { degree: usize::try_from(record.flags(71)).unwrap_or(0), knots, weights, control };
    Ok((spline.pieces()?, false))
}

/// The map of a block where it is inserted: of its copy in a column and a row.
pub(super) fn inserted(record: &Record<'_>, base: Point3, column: f64, row: f64) -> Affine {
    let scale = Vec3::new(record.or(41, 1.0), record.or(42, 1.0), record.or(43, 1.0));
    let angle = from_deg(record.or(50, 0.0));
    let step = Vec3::new(column * record.or(44, 0.0), row * record.or(45, 0.0), 0.0);
    let (s, c) = (sin(angle), cos(angle));
    let step = Vec3::new(c * step.x - s * step.y, s * step.x + c * step.y, 0.0);
    let to = Affine::translation(record.point(10).to_vec() + step);
    let sized = Affine::scale(scale).after(&Affine::translation(-base.to_vec()));
    extruded(record.normal()).after(&to.after(&Affine::turn(angle).after(&sized)))
}
