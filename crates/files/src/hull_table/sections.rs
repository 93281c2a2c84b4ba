//! The edges of planks of a hull of which sections are known: curves that run along it, or the
//! corners of its stations.
//!
//! Curves that run along at least half of the hull are edges: control curves of FREE!ship follow
//! chines and the sheer. Where corners of the stations show more edges, these are taken: most
//! stations have an equal number of corners, and the edges pass through the lower ends, the first
//! corners, the second, …, the upper ends. All other curves lie on the skin.

use super::lines::{HullLine, HullTable};
use crate::names::{OwnNames, shown};
use sheetwright::curve::CurvePoint;
use std::collections::BTreeMap;

/// A coordinate is constant along a curve if it changes by less than this, as a part of the length
/// of the hull: files give four decimals of a metre.
const FLAT: f64 = 1e-4;
/// An edge of planks runs along this part of the hull or more.
const ALONG: f64 = 0.5;
/// The fewest stations whose corners show edges.
const FEWEST_STATIONS: usize = 3;

/// A curve of a hull as points in space, mm; x runs along the hull, y out, z up.
pub(super) struct HullCurve {
    /// Its name, if the file gives it one.
    pub(super) name: Option<String>,
    /// Its points; a corner where the curve has one.
    pub(super) points: Vec<CurvePoint>,
}

/// A section across the hull.
struct Station {
    name: String,
    at: f64,
    /// Its points from the lower end up.
    points: Vec<CurvePoint>,
}

/// The lines of a hull: its edges of planks and, if there are none, its other curves.
pub(super) fn hull_of(mut curves: Vec<HullCurve>) -> HullTable {
    let mut notes = Vec::new();
    to_one_side(&mut curves, &mut notes);
    let length = extent(curves.iter().flat_map(|curve| &curve.points), |p| p.at.x);
    let runs_along = |curve: &HullCurve| extent(&curve.points, |p| p.at.x) >= ALONG * length;
    let is_named = |curve: &HullCurve| curve.name.is_some();
    let (stations, several) = stations_of(&curves, FLAT * length);
    let (of_corners, skipped) = edges_of_stations(&stations);
    let is_edge = |curve: &HullCurve| !is_named(curve) && runs_along(curve);
    let count = curves.iter().filter(|curve| is_edge(curve)).count();
    let edges = if of_corners.len() > count {
        notes.extend(skipped);
        of_corners
    } else {
        curves.iter().filter(|curve| is_edge(curve)).map(forwards).collect()
    };
    if several > 0 {
        notes.push(format!("left out: {several} stations of several parts"));
    }
    let mut lines = named_edges(edges, FLAT * length);
    if lines.len() < 2 {
        lines.extend(others(&curves, &is_edge));
    } else {
        let others = curves.iter().filter(|curve| !is_edge(curve)).count();
        if others > 0 {
            notes.push(format!(
                "{others} sections and other curves are left out: they lie on the skin between \
                 the edges of planks"
            ));
        }
    }
    let stations = stations.into_iter().map(|station| (station.name, station.at)).collect();
    HullTable { lines, stations, notes }
}

/// The points of a curve from its end with the smaller x on, as tables have them.
fn forwards(curve: &HullCurve) -> Vec<CurvePoint> {
    let mut points = curve.points.clone();
    if let [first, .., last] = &points[..]
        && first.at.x > last.at.x
    {
        points.reverse();
    }
    points
}

/// Turns the half of a hull on the side of negative y over.
fn to_one_side(curves: &mut [HullCurve], notes: &mut Vec<String>) {
    let mut points = curves.iter().flat_map(|curve| &curve.points);
    if points.clone().any(|point| point.at.y > 0.0) || !points.any(|point| point.at.y < 0.0) {
        return;
    }
    for point in curves.iter_mut().flat_map(|curve| &mut curve.points) {
        // Adding 0 turns −0 into 0.
        point.at.y = 0.0 - point.at.y;
    }
    notes.push("the half with negative y is turned over".to_owned());
}

fn extent<'a>(
    points: impl IntoIterator<Item = &'a CurvePoint>,
    of: impl Fn(&CurvePoint) -> f64,
) -> f64 {
    let [low, high] = points
        .into_iter()
        .map(of)
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
            [low.min(value), high.max(value)]
        });
    (high - low).max(0.0)
}

/// The stations from the stern to the bow, and the number of curves that are left out since others
/// lie in their planes: sections of several parts, of which one can't tell how they go together.
fn stations_of(curves: &[HullCurve], flat: f64) -> (Vec<Station>, usize) {
    let is_across = |curve: &&HullCurve| {
        let across = extent(&curve.points, |p| p.at.y).max(extent(&curve.points, |p| p.at.z));
        extent(&curve.points, |p| p.at.x) <= flat && across > flat
    };
    let mut stations: Vec<Station> = curves.iter().filter(is_across).map(station).collect();
    stations.sort_by(|a, b| a.at.total_cmp(&b.at));
    let before = stations.len();
    let places: Vec<f64> = stations.iter().map(|station| station.at).collect();
    let in_plane = |at: f64| places.iter().filter(|other| (*other - at).abs() <= flat).count();
    stations.retain(|station| in_plane(station.at) == 1);
    let several = before - stations.len();
    (stations, several)
}

fn station(curve: &HullCurve) -> Station {
    let mut points = curve.points.clone();
    if let [first, .., last] = &points[..]
        && first.at.z > last.at.z
    {
        points.reverse();
    }
    let at = points.first().map_or(0.0, |point| point.at.x);
    // Files name stations by their places in words that the mark has already.
    let name = curve.name.as_deref().and_then(|name| name.split(' ').next_back());
    Station { name: name.map_or_else(|| format!("{at:.0}"), str::to_owned), at, points }
}

/// The edges that the corners of the stations show, from the lowest, and notes of stations that are
/// unlike most; none where most have no corners.
fn edges_of_stations(stations: &[Station]) -> (Vec<Vec<CurvePoint>>, Vec<String>) {
    let corners = |station: &Station| -> Vec<CurvePoint> {
        let inner = station.points.iter().skip(1).take(station.points.len().saturating_sub(2));
        inner.filter(|point| point.corner).copied().collect()
    };
    let mut counts = BTreeMap::new();
    for station in stations {
        *counts.entry(corners(station).len()).or_insert(0) += 1;
    }
    let most = counts.iter().max_by_key(|(corners, stations)| (**stations, **corners));
    let (usual, of_usual) = most.map_or((0, 0), |(corners, stations)| (*corners, *stations));
    if usual == 0 || stations.len() < FEWEST_STATIONS || 2 * of_usual <= stations.len() {
        return (Vec::new(), Vec::new());
    }
    let mut notes = Vec::new();
    let mut edges = vec![Vec::new(); usual + 2];
    for station in stations {
        let [first, .., last] = &station.points[..] else { continue };
        let found = corners(station);
        edges[0].push(CurvePoint::smooth(first.at));
        edges[usual + 1].push(CurvePoint::smooth(last.at));
        if found.len() == usual {
            for (edge, corner) in edges[1..].iter_mut().zip(&found) {
                edge.push(CurvePoint::smooth(corner.at));
            }
        } else {
            notes.push(format!(
                "the station {} has {} corners and most have {usual}: it gives its ends alone",
                shown(&station.name),
                found.len()
            ));
        }
    }
    (edges, notes)
}

/// Names edges from the lowest: the keel, chines, the sheer, and the middle of a deck.
fn named_edges(mut edges: Vec<Vec<CurvePoint>>, flat: f64) -> Vec<HullLine> {
    let height = |points: &[CurvePoint]| {
        points.iter().map(|point| point.at.z).sum::<f64>() / points.len() as f64
    };
    edges.sort_by(|a, b| height(a).total_cmp(&height(b)));
    let is_middle = |points: &[CurvePoint]| points.iter().all(|point| point.at.y.abs() <= flat);
    let count = edges.len();
    let has_deck = count > 2 && edges.last().is_some_and(|points| is_middle(points));
    let sheer = count.saturating_sub(1 + usize::from(has_deck));
    let name = |n: usize, points: &[CurvePoint]| match n {
        0 if is_middle(points) => "Keel".to_owned(),
        0 if count > 1 => "Bottom".to_owned(),
        n if n == sheer => "Sheer".to_owned(),
        n if n > sheer => "Deck".to_owned(),
        n => format!("Chine {n}"),
    };
    let line = |(n, points): (usize, Vec<CurvePoint>)| HullLine {
        name: name(n, &points),
        points,
        is_edge: true,
    };
    edges.into_iter().enumerate().map(line).collect()
}

/// The curves of a round hull, of which none is an edge.
fn others(curves: &[HullCurve], is_edge: &dyn Fn(&HullCurve) -> bool) -> Vec<HullLine> {
    let mut names = OwnNames::default();
    let mut line = |curve: &HullCurve| HullLine {
        name: names.take(curve.name.as_deref().unwrap_or("curve"), ' '),
        points: curve.points.clone(),
        is_edge: false,
    };
    curves.iter().filter(|curve| !is_edge(curve)).map(&mut line).collect()
}
