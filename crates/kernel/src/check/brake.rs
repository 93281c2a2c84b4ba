//! What a press brake can't do with the bend lines and the folds of a part.

use super::{Finding, FindingKind};
use crate::bend::{BrakeFault, Hit, Mitred};
use std::collections::BTreeMap;

/// The findings on folds that are left mitred, of so many folds: one a reason.
pub(crate) fn mitred_folds(
    of: usize,
    mitred: &BTreeMap<Mitred, usize>,
) -> impl Iterator<Item = Finding> + '_ {
    let kind = move |(&why, &count): (&Mitred, &usize)| FindingKind::FoldsMitred { count, of, why };
    mitred.iter().map(kind).map(Finding::of_whole)
}

/// The findings on some hits: one a kind of fault.
pub fn braking(hits: &[Hit]) -> Vec<Finding> {
    let faults = || hits.iter().flat_map(|hit| &hit.faults);
    let close = worst(faults().filter_map(|fault| match *fault {
        BrakeFault::Close { apart_mm, least_mm, .. } => Some((apart_mm, least_mm)),
        _ => None,
    }));
    let long = worst(faults().filter_map(|fault| match *fault {
        BrakeFault::Long { length_mm, most_mm } => Some((-length_mm, most_mm)),
        _ => None,
    }));
    let short = worst(faults().filter_map(|fault| match *fault {
        BrakeFault::Short { beyond_mm, least_mm } => Some((beyond_mm, least_mm)),
        _ => None,
    }));
    let close = close.map(|(count, nearest_mm, least_mm)| FindingKind::LinesClose {
        count,
        nearest_mm,
        least_mm,
    });
    let long = long.map(|(count, longest_mm, most_mm)| FindingKind::LinesLong {
        count,
        longest_mm: -longest_mm,
        most_mm,
    });
    let short = short.map(|(count, shortest_mm, least_mm)| FindingKind::FlangeShort {
        count,
        shortest_mm,
        least_mm,
    });
    [close, long, short].into_iter().flatten().map(Finding::of_whole).collect()
}

/// How many faults there are, the least of their numbers, and its limit; `None` of none.
fn worst(faults: impl Iterator<Item = (f64, f64)>) -> Option<(usize, f64, f64)> {
    faults.fold(None, |worst, (number, limit)| {
        let (count, least, at) = worst.unwrap_or((0, f64::INFINITY, limit));
        let is_less = number < least;
        Some((count + 1, least.min(number), if is_less { limit } else { at }))
    })
}
