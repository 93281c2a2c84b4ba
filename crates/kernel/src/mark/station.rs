//! Stations: where planes square to an axis cut a part, as curves on its flat pattern.
//!
//! A plane cuts a side of a triangle where one end lies before it and the other does not. The point
//! of the side where it does lies at the same share of the side in space and on the pattern, since
//! a triangle is laid flat by an affine map. So each triangle that the plane cuts has one straight
//! stretch of the curve, from side to side, and these are chained over the sides that they share.
//! A vertex in the plane counts as behind it, so that no case is left out or counted twice.

use super::Marked;
use super::fault::MarkFault;
use super::part::MarkPart;
use crate::design::{Axis, StationPlaces};
use crate::mesh::MeshEdge;
use crate::pattern::{PathKind, PatternPath, Role, Wish};
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::{Point2, Point3, unit};

/// The most stations on a part.
pub(super) const MOST_STATIONS: usize = 1000;

/// A plane square to an axis: its coordinate, mm, and its name.
pub(super) type Station = (f64, String);

/// The planes of some stations on parts that reach from one coordinate to another, mm.
///
/// # Errors
/// More than [`MOST_STATIONS`].
pub(super) fn planes(
    axis: Axis,
    at: &StationPlaces,
    [low, high]: [f64; 2],
) -> Result<Vec<Station>, MarkFault> {
    let called = |at: f64| format!("{} {}", axis.name(), shortest(at));
    match at {
        StationPlaces::Listed { planes } => {
            let name = |name: &Option<String>, at| name.clone().unwrap_or_else(|| called(at));
            Ok(planes.iter().map(|plane| (plane.at, name(&plane.name, plane.at))).collect())
        }
        StationPlaces::Every { pitch, from } => {
            let first = ((low - from) / pitch).ceil();
            let count = ((high - from) / pitch).floor() - first + 1.0;
            if count > MOST_STATIONS as f64 {
                let count = count as usize;
                return Err(MarkFault::TooManyStations { count, most: MOST_STATIONS });
            }
            let at = |n: usize| from + pitch * (first + n as f64);
            Ok((0..count.max(0.0) as usize).map(at).map(|at| (at, called(at))).collect())
        }
    }
}

/// A length in mm, to hundredths, in as few digits as there are.
fn shortest(mm: f64) -> String {
    // Adding 0 turns −0 into 0.
    format!("{}", (mm * 100.0).round() / 100.0 + 0.0)
}

/// A frame is nearly straight where the part leaves its straight line by less than this share of
/// its length; a frame that is curved by design is no slip of a straight one.
const NEARLY_STRAIGHT: f64 = 0.1;
/// What is less than this share of the length of a frame, or than a millimetre, is left unsaid.
const STRAIGHT: f64 = 0.005;
const LEAST_MM: f64 = 1.0;

/// A straight frame that misses the part: how far, mm, its length, mm, and its station.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Frame {
    /// How far the part leaves the straight line, mm.
    pub(super) off_mm: f64,
    /// The length of that line, mm.
    pub(super) length_mm: f64,
    /// The name of the station.
    pub(super) name: String,
}

/// Marks a station on a part; whether it touches it, and the frame that misses it most.
pub(super) fn mark(
    part: &MarkPart<'_>,
    axis: Axis,
    station: &Station,
    made: &mut Marked,
) -> (bool, Option<Frame>) {
    let (at, name) = station;
    let (curves, touches) = curves(part, |p| axis.of(p) - at);
    let mut worst: Option<Frame> = None;
    for (points, in_space) in curves {
        let frame = frame(&in_space, name);
        if frame.as_ref().map(|frame| frame.off_mm) > worst.as_ref().map(|frame| frame.off_mm) {
            worst = frame;
        }
        made.wishes.push(Wish::at_ends(name.clone(), &points));
        let (role, kind) = (Role::Engrave, PathKind::Station);
        made.paths.push(PatternPath { role, kind, points, closed: false });
    }
    (touches, worst)
}

/// The frame along a curve in space that is nearly straight; `None` if a straight one fits, or if
/// the curve is none that a straight one was meant for.
fn frame(curve: &[Point3], name: &str) -> Option<Frame> {
    let (first, last) = (*curve.first()?, *curve.last()?);
    let length_mm = first.distance(last);
    let along = unit(last - first)?;
    let off = |p: &Point3| {
        let to = *p - first;
        (to - along * to.dot(along)).length()
    };
    let off_mm = curve.iter().map(off).fold(0.0, f64::max);
    let is_off = off_mm > LEAST_MM && off_mm > STRAIGHT * length_mm;
    let is_near = off_mm < NEARLY_STRAIGHT * length_mm;
    (is_off && is_near).then(|| Frame { off_mm, length_mm, name: name.to_owned() })
}

/// A curve on the pattern, and in space.
type Twofold = (Vec<Point2>, Vec<Point3>);

/// The curves where a function of space that is linear on triangles is 0, and whether there are
/// any, those along the border included, which are left out.
fn curves(part: &MarkPart<'_>, value: impl Fn(Point3) -> f64) -> (Vec<Twofold>, bool) {
    let mesh = part.mesh;
    let values: Vec<f64> = mesh.positions().iter().map(|&p| value(p)).collect();
    let is_cut = |edge: &MeshEdge| {
        let [a, b] = edge.ends.map(|v| values[v.get()] >= 0.0);
        a != b
    };
    let edges = mesh.edges();
    let cut: Vec<bool> = edges.iter().map(is_cut).collect();
    let mut used: Vec<bool> = cut.iter().map(|cut| !cut).collect();
    let mut chains: Vec<Vec<usize>> = Vec::new();
    // Curves that begin at the border first; what is left runs round.
    for ends_only in [true, false] {
        for first in 0..edges.len() {
            if used[first] || (ends_only && !edges[first].is_border()) {
                continue;
            }
            let mut chain = vec![first];
            used[first] = true;
            let mut from: Option<TriangleIndex> = None;
            let mut at = first;
            while let Some(triangle) =
                edges[at].triangles.iter().flatten().copied().find(|t| Some(*t) != from)
            {
                let sides = mesh.topology().edges_of(triangle);
                let Some(next) = sides.into_iter().find(|&side| side != at && cut[side]) else {
                    break;
                };
                chain.push(next);
                if used[next] {
                    break;
                }
                used[next] = true;
                (from, at) = (Some(triangle), next);
            }
            chains.push(chain);
        }
    }
    let touches = !chains.is_empty() || values.contains(&0.0);
    let place = |edge: usize| {
        let [a, b] = edges[edge].ends;
        let [of_a, of_b] = [a, b].map(|v| values[v.get()]);
        let [in_a, in_b] = [a, b].map(|v| mesh.position(v));
        // Exact at both ends.
        match of_a / (of_a - of_b) {
            1.0 => (part.laid(b), in_b),
            share => (part.laid(a).lerp(part.laid(b), share), in_a.lerp(in_b, share)),
        }
    };
    let drawn = chains.into_iter().filter_map(|chain| {
        let is_inside = !runs_along_border(part, &chain, &values);
        let (mut points, in_space): Twofold = chain.into_iter().map(place).unzip();
        points.dedup();
        (is_inside && points.len() > 1).then_some((points, in_space))
    });
    (drawn.collect(), touches)
}

/// Whether all sides that a curve passes are cut at vertices that follow one another along the
/// border.
fn runs_along_border(part: &MarkPart<'_>, chain: &[usize], values: &[f64]) -> bool {
    let vertices: Option<Vec<_>> = chain
        .iter()
        .map(|&edge| part.mesh.edges()[edge].ends.into_iter().find(|v| values[v.get()] == 0.0))
        .collect();
    let Some(mut vertices) = vertices else { return false };
    vertices.dedup();
    vertices.windows(2).all(|pair| {
        let between = part.mesh.topology().edge_between(pair[0], pair[1]);
        between.is_some_and(|edge| part.mesh.edges()[edge].is_border())
    })
}
