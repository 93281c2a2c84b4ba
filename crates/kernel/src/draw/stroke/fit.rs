//! The fewest handles with which a curve lies within the tolerance of a stroke.
//!
//! Between corners, or all round without corners, handles are spread along the stroke, more of them
//! where it bends by the points that Douglas and Peucker keep. Then all handles, corners too, are
//! moved to minimise the sum of squared distances between places of the stroke and the curve
//! (`squares`). Stretches that are still off by more than the tolerance get one more handle. Both
//! variants are tried, all handles spread anew and the old ones with one more at the worst place,
//! and the better one counts.

use super::path::{Path, douglas_peucker};
use super::squares::{Handle, curve, solved};
use super::{MOST_POINTS, StrokePoint};
use sheetwright_geometry::math::{Point2, atan2};
use sheetwright_geometry::predicate::{for_touching_boxes, segments_touch};

/// Least number of handles of a closed curve without corners: three make no fair oval.
const LEAST_ROUND: usize = 4;
/// Points that Douglas and Peucker leave for each handle that a cubic needs, at most: fewer are
/// tried first.
const LEFT_BY_HANDLE: usize = 5;
/// Pieces of a span of the curve when it is compared with the stroke.
const PIECES: usize = 24;
/// A stretch with this many handles gets more than one at a time.
const MANY: usize = 12;
/// Places of the stroke for each handle, at least.
const PLACES_BY_HANDLE: usize = 3;
/// Share of the tolerance for distances at places of the curve: between them it is hardly farther
/// off.
const BETWEEN_PLACES: f64 = 0.99;
/// The weight of the bends against the length where handles are spread.
const BY_BEND: f64 = 1.0;

pub(super) struct Fitted {
    pub(super) points: Vec<StrokePoint>,
    pub(super) off_mm: f64,
}

/// A part of the stroke between two corners: numbers of places at equal steps; the end may run over
/// the number of them. The whole of a closed stroke without corners is one.
struct StrokeStretch {
    from: usize,
    to: usize,
    /// The share of handles that lies before each place, 0 ..= 1, which follows the bends.
    share_before: Vec<f64>,
    /// Handles inside it.
    inner: usize,
}

/// A curve and its distance from the stroke.
#[derive(Clone)]
struct Tried {
    handles: Vec<Handle>,
    off_mm: f64,
    /// For each stretch, its largest distance and the place of that.
    worst: Vec<(f64, usize)>,
}

/// The curve of a closed or open path with corners at these of its places at equal steps.
pub(super) fn fit(
    drawn: &Path,
    even: &[Point2],
    corners: &[usize],
    tolerance_mm: f64,
) -> Option<Fitted> {
    let tolerance_mm = BETWEEN_PLACES * tolerance_mm;
    let mut stretches = stretches(drawn, even, corners, tolerance_mm);
    let with_handles = |inner: usize| inner + usize::from(!drawn.closed || !corners.is_empty());
    let least = if corners.is_empty() { LEAST_ROUND } else { 3 };
    while drawn.closed && stretches.iter().map(|s| with_handles(s.inner)).sum::<usize>() < least {
        let Some(fewest) = stretches.iter_mut().min_by_key(|s| s.inner) else { break };
        fewest.inner += 1;
    }
    let may_cross = crosses(even, drawn.closed);
    let good = |tried: &Tried| {
        let places = places_of(&tried.handles, drawn.closed).unwrap_or_default();
        tried.off_mm <= tolerance_mm && (may_cross || !crosses(&places, drawn.closed))
    };
    // As spread, unless a better one is found.
    let laid = spread(&stretches, even, drawn.closed, corners.is_empty());
    let mut best = compared(laid, drawn, even, &stretches);
    let mut last: Option<Tried> = None;
    for _ in 0..MOST_POINTS {
        let spread = spread(&stretches, even, drawn.closed, corners.is_empty());
        let added = last.as_ref().map(|last| with_added(last, even, drawn.closed, tolerance_mm));
        // Where a hand rounded a corner off widely, straight sides that meet beyond it are far off.
        let pinned = (spread.iter().any(|h| h.corner) && last.is_some()).then(|| spread.clone());
        let laid = [(Some(spread), false), (added, false), (pinned, true)];
        let mut tries: Vec<Tried> = laid
            .into_iter()
            .filter_map(|(handles, pinned)| Some((handles?, pinned)))
            .filter(|(handles, _)| handles.len() <= MOST_POINTS)
            .filter_map(|(h, pinned)| solved(h, even, drawn.closed, drawn.length(), pinned))
            .filter_map(|handles| compared(handles, drawn, even, &stretches))
            .collect();
        tries.sort_by(|a, b| a.off_mm.total_cmp(&b.off_mm));
        let done = (0..tries.len()).filter(|&n| good(&tries[n]));
        if let Some(done) = done.min_by_key(|&n| tries[n].handles.len()) {
            best = Some(tries.swap_remove(done));
            break;
        }
        let now = tries.into_iter().next();
        let all = now.as_ref().is_none_or(|now| now.off_mm <= tolerance_mm);
        for (n, stretch) in stretches.iter_mut().enumerate() {
            let off = now.as_ref().map_or(0.0, |now| now.worst[n].0);
            let room = stretch.inner + 1 < (stretch.to - stretch.from) / PLACES_BY_HANDLE;
            if room && (all || off > tolerance_mm) {
                stretch.inner += 1 + stretch.inner / MANY;
            }
        }
        let off_mm = |tried: &Option<Tried>| tried.as_ref().map_or(f64::INFINITY, |t| t.off_mm);
        if off_mm(&now) < off_mm(&best) {
            best.clone_from(&now);
        }
        last = now;
        let inner: usize = stretches.iter().map(|s| s.inner).sum();
        if corners.len() + inner > MOST_POINTS {
            break;
        }
    }
    let best = best?;
    let points = best.handles.iter().map(|h| StrokePoint { at: h.at, corner: h.corner }).collect();
    Some(Fitted { points, off_mm: best.off_mm })
}

fn stretches(
    drawn: &Path,
    even: &[Point2],
    corners: &[usize],
    tolerance_mm: f64,
) -> Vec<StrokeStretch> {
    let m = even.len();
    let mut ends: Vec<usize> = corners.to_vec();
    if drawn.closed {
        ends.push(corners.first().map_or(0, |first| first + m));
        if corners.is_empty() {
            ends.push(m);
        }
    } else {
        ends.insert(0, 0);
        ends.push(m - 1);
    }
    let room = MOST_POINTS.saturating_sub(ends.len()) / (ends.len() - 1);
    let stretch = |pair: &[usize]| {
        let (from, to) = (pair[0], pair[1]);
        let points: Vec<Point2> = (from..=to).map(|i| even[i % m]).collect();
        let left = douglas_peucker(&points, tolerance_mm).len() - 2;
        let inner = left.div_ceil(LEFT_BY_HANDLE).min(room);
        StrokeStretch { from, to, share_before: share_before(&points, tolerance_mm), inner }
    };
    ends.windows(2).map(stretch).collect()
}

/// The share of handles that should lie before each of these points: by length, and by the turns at
/// the points that Douglas and Peucker keep, each turn spread half way to its neighbours.
fn share_before(points: &[Point2], tolerance_mm: f64) -> Vec<f64> {
    let kept = douglas_peucker(points, 0.5 * tolerance_mm);
    let last = points.len() - 1;
    let mut density = vec![1.0 / last as f64; last];
    let turn = |at: &[usize]| {
        let (a, b) = (points[at[1]] - points[at[0]], points[at[2]] - points[at[1]]);
        atan2(a.perp_dot(b), a.dot(b)).abs()
    };
    let turned: f64 = kept.windows(3).map(turn).sum();
    if turned > 0.0 {
        for at in kept.windows(3) {
            let (from, to) = (usize::midpoint(at[0], at[1]), usize::midpoint(at[1], at[2]));
            let each = BY_BEND * turn(at) / turned / (to - from).max(1) as f64;
            density[from..to].iter_mut().for_each(|d| *d += each);
        }
    }
    let whole: f64 = density.iter().sum();
    let mut before = 0.0;
    let mut shares = vec![0.0];
    shares.extend(density.iter().map(|d| {
        before += d / whole;
        before
    }));
    shares
}

/// Handles spread over all stretches.
fn spread(stretches: &[StrokeStretch], even: &[Point2], closed: bool, round: bool) -> Vec<Handle> {
    let m = even.len();
    let mut handles = Vec::new();
    let handle = |place: usize, corner: bool| Handle { place, at: even[place % m], corner };
    for (n, stretch) in stretches.iter().enumerate() {
        let is_corner = closed && !round || !closed && n > 0;
        let (first, parts) =
            if closed && round { (0, stretch.inner) } else { (1, stretch.inner + 1) };
        if first == 1 {
            handles.push(handle(stretch.from, is_corner));
        }
        for k in first..parts {
            let share = k as f64 / parts as f64;
            let place = stretch.share_before.partition_point(|&s| s < share);
            handles.push(handle(stretch.from + place, false));
        }
    }
    if !closed {
        handles.push(handle(m - 1, false));
    }
    handles
}

/// The handles of a curve with one more in every stretch beyond the tolerance, at its worst place;
/// if none is, in every stretch.
fn with_added(tried: &Tried, even: &[Point2], closed: bool, tolerance_mm: f64) -> Vec<Handle> {
    let m = even.len();
    let mut handles = tried.handles.clone();
    let all = tried.off_mm <= tolerance_mm;
    for &(off, place) in &tried.worst {
        let taken = handles.iter().any(|h| h.place % m == place % m);
        if !taken && (all || off > tolerance_mm) {
            // A closed curve may begin late: its handles run on beyond the number of places.
            let first = handles.first().map_or(0, |h| h.place);
            let place = if closed && place < first { place + m } else { place };
            let n = handles.partition_point(|h| h.place < place);
            handles.insert(n, Handle { place, at: even[place % m], corner: false });
        }
    }
    handles
}

/// The distance between the stroke and the curve through handles; `None` if there is no such curve.
fn compared(
    handles: Vec<Handle>,
    drawn: &Path,
    even: &[Point2],
    stretches: &[StrokeStretch],
) -> Option<Tried> {
    let m = even.len();
    let step = drawn.length() / (m - usize::from(!drawn.closed)) as f64;
    let along = Path::new(places_of(&handles, drawn.closed)?, drawn.closed);
    let spans = along.points.len() / PIECES;
    let mut worst: Vec<(f64, usize)> =
        stretches.iter().map(|s| (0.0, (s.from + s.to) / 2)).collect();
    let mut note = |place: usize, off: f64| {
        let holds = |s: &StrokeStretch| {
            (s.from..=s.to).contains(&place) || (s.from..=s.to).contains(&(place + m))
        };
        if let Some(n) = stretches.iter().position(holds)
            && off > worst[n].0
        {
            worst[n] = (off, place);
        }
    };
    for (p, way) in drawn.points.iter().zip(drawn.ways()) {
        note(((way / step).round() as usize).min(m - 1), along.distance(*p));
    }
    for (n, p) in along.points.iter().enumerate() {
        let span = n / PIECES;
        let from = handles[span.min(handles.len() - 1)].place;
        let to = handles.get(span + 1).map_or(handles[0].place + m, |h| h.place);
        let place = if span < spans { from + (to - from) * (n % PIECES) / PIECES } else { from };
        note(place % m, drawn.distance(*p));
    }
    let off_mm = worst.iter().fold(0.0, |most: f64, w| most.max(w.0));
    Some(Tried { handles, off_mm, worst })
}

/// Places along the curve through handles.
fn places_of(handles: &[Handle], closed: bool) -> Option<Vec<Point2>> {
    let curve = curve(handles, closed)?;
    let count = curve.spans().len() * PIECES + usize::from(!closed);
    let at = |n: usize| curve.position(n as f64 / PIECES as f64);
    Some((0..count).map(|n| Point2::new(at(n).x, at(n).y)).collect())
}

/// Whether a polyline crosses itself.
fn crosses(points: &[Point2], closed: bool) -> bool {
    let m = points.len();
    let edges = m - usize::from(!closed);
    let edge = |i: usize| (points[i], points[(i + 1) % m]);
    let boxes: Vec<_> = (0..edges)
        .map(|i| {
            let (a, b) = (edge(i).0.to_vec().extend(0.0), edge(i).1.to_vec().extend(0.0));
            (a.min(b), a.max(b))
        })
        .collect();
    let mut found = false;
    for_touching_boxes(&boxes, |i, j| {
        let beside = j == i + 1 || (closed && i == 0 && j + 1 == edges);
        let ((a, b), (c, d)) = (edge(i), edge(j));
        found |= !beside && segments_touch(a, b, c, d);
    });
    found
}
