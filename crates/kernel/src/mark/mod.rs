//! What is marked on the faces of parts: stations, arrows of the grain and of directions in space,
//! edges on a fold, drilled holes and texts.
//!
//! A mark knows places in space and places on the flat pattern. A part is laid flat triangle by
//! triangle, so a point of a triangle lies at the same shares of its corners in space and on the
//! pattern. Lines lie inside the finished outline; where texts stand, `pattern` decides for all
//! texts of a part together.

mod arrow;
mod fault;
mod fold;
mod part;
mod point;
mod station;

pub use fault::{MarkFault, MarkNote};

pub(crate) use part::MarkPart;

use crate::design::{Axis, Mark, MarkAt, MarkKind, MarkOn, MarkWay, StationPlaces};
use crate::pattern::{PatternPath, Wish};
use station::Frame;

/// An error names no more parts or edges than this.
const NAMED: usize = 12;

/// The marks of a part.
#[derive(Default)]
pub(crate) struct Marked {
    /// Their lines.
    pub(crate) paths: Vec<PatternPath>,
    /// Their texts, which have no place yet.
    pub(crate) wishes: Vec<Wish>,
    /// What is to be said about them.
    pub(crate) notes: Vec<MarkNote>,
}

/// The marks of some parts, in their order.
///
/// # Errors
/// The first mark that can't be made.
pub(crate) fn marked(parts: &[MarkPart<'_>], marks: &[Mark]) -> Result<Vec<Marked>, MarkFault> {
    let mut made: Vec<Marked> = parts.iter().map(|_| Marked::default()).collect();
    for mark in marks {
        let on = chosen(parts, &mark.on)?;
        match &mark.kind {
            MarkKind::Stations { axis, at } => stations(parts, &on, *axis, at, &mut made)?,
            MarkKind::Fold { edge } => {
                check_edge(parts, &on, edge)?;
                on.iter().for_each(|&n| fold::mark(&parts[n], edge, &mut made[n]));
            }
            kind @ (MarkKind::Grain { .. } | MarkKind::Face { .. }) => {
                if let MarkKind::Grain { way: MarkWay::Edge { edge }, .. } = kind {
                    check_edge(parts, &on, edge)?;
                }
                on.iter().for_each(|&n| arrow::mark(&parts[n], kind, &mut made[n]));
            }
            kind @ (MarkKind::Drill { .. } | MarkKind::Text { .. }) => {
                at_points(parts, &on, kind, &mut made);
            }
        }
    }
    Ok(made)
}

/// The parts that a mark is on, in order.
fn chosen(parts: &[MarkPart<'_>], on: &[MarkOn]) -> Result<Vec<usize>, MarkFault> {
    let is_on = |part: &MarkPart<'_>, on: &MarkOn| match on {
        MarkOn::All => true,
        MarkOn::Part { name } => part.name == name || part.panel == name,
    };
    for wanted in on {
        if let MarkOn::Part { name } = wanted
            && !parts.iter().any(|part| is_on(part, wanted))
        {
            let known = parts.iter().map(|part| part.name.to_owned()).take(NAMED).collect();
            return Err(MarkFault::NoSuchPart { wanted: name.clone(), known });
        }
    }
    let is_chosen = |n: &usize| on.iter().any(|on| is_on(&parts[*n], on));
    Ok((0..parts.len()).filter(is_chosen).collect())
}

/// Whether one of some parts has an edge of this name.
fn check_edge(parts: &[MarkPart<'_>], on: &[usize], edge: &str) -> Result<(), MarkFault> {
    if on.is_empty() || on.iter().any(|&n| parts[n].edge(edge).is_some()) {
        return Ok(());
    }
    let edges = on.iter().flat_map(|&n| {
        let part = &parts[n];
        part.edges.iter().map(move |edge| format!("{}/{}", part.name, edge.name))
    });
    Err(MarkFault::NoSuchEdge { wanted: edge.to_owned(), known: edges.take(NAMED).collect() })
}

/// Marks stations; says which cross no part, and where straight frames would miss a part most.
fn stations(
    parts: &[MarkPart<'_>],
    on: &[usize],
    axis: Axis,
    at: &StationPlaces,
    made: &mut [Marked],
) -> Result<(), MarkFault> {
    let places = on.iter().flat_map(|&n| parts[n].mesh.positions()).map(|&p| axis.of(p));
    let [low, high] = places
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)]);
    let Some(&first) = on.first() else { return Ok(()) };
    let mut frames: Vec<Option<Frame>> = parts.iter().map(|_| None).collect();
    for station in station::planes(axis, at, [low, high])? {
        let mut touches = false;
        for &n in on {
            let (here, frame) = station::mark(&parts[n], axis, &station, &mut made[n]);
            touches |= here;
            if frame.as_ref().map(|f| f.off_mm) > frames[n].as_ref().map(|f| f.off_mm) {
                frames[n] = frame;
            }
        }
        if !touches {
            let (at_mm, name) = station;
            let note = MarkNote::StationMissed { name, axis, at_mm, reach_mm: [low, high] };
            made[first].notes.push(note);
        }
    }
    for (made, frame) in made.iter_mut().zip(frames) {
        made.notes.extend(frame.map(|Frame { name, off_mm, length_mm }| MarkNote::CurvedFrame {
            name,
            off_mm,
            length_mm,
        }));
    }
    Ok(())
}

/// Marks holes or texts; says which lie on no part.
fn at_points(parts: &[MarkPart<'_>], on: &[usize], kind: &MarkKind, made: &mut [Marked]) {
    let mut is_somewhere = false;
    for &n in on {
        is_somewhere |= point::mark(&parts[n], kind, &mut made[n]);
    }
    let (MarkKind::Drill { at, .. } | MarkKind::Text { at: Some(at), .. }) = kind else { return };
    let MarkAt::Space { at, within } = *at else { return };
    let off = |n: &usize| parts[*n].nearest(at).1;
    let nearest = on.iter().map(|n| (off(n), *n)).min_by(|a, b| a.0.total_cmp(&b.0));
    if let (false, Some((off_mm, n))) = (is_somewhere, nearest) {
        let what = kind.name().to_owned();
        made[n].notes.push(MarkNote::PlaceFar { what, at, off_mm, within_mm: within });
    }
}
