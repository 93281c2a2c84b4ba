//! What the boundaries of joined panels are made from: smooth runs of curves, cut where others end.

use super::curves::{built, found};
use super::error::{PanelCause, PanelError};
use super::loops::{Matched, Sampler};
use super::source::{apart, run_back};
use super::steps::StepSource;
use crate::design::{CurveUse, Design, DesignPanel, PanelShape};
use sheetwright_geometry::boundary::{JoinCause, samples_from_points, size_of};
use sheetwright_geometry::curve::{
    Curve, CurveKind, CurvePoint, Sample, SampleError, chained_samples, sample_chain, sample_open,
};
use sheetwright_geometry::math::{Point3, Vec3};
use sheetwright_geometry::predicate::for_touching_boxes;
use sheetwright_geometry::tolerance::Tolerance;

/// Spans of curves and samples of all parts at the most: each is compared with those that lie
/// beside it, which are all others where they stand in a row.
pub(super) const MAX_PIECES: usize = 50_000;

/// A smooth run of a curve on a loop of a part: from corner to corner, or a closed smooth curve.
pub(super) struct Link {
    /// As it was drawn.
    pub(super) curve: Curve,
    /// Whether it is run from its end to its beginning.
    reversed: bool,
    /// Its source.
    pub(super) source: StepSource,
}

/// The source of a loop of a part: curves or samples.
pub(super) enum LoopSource {
    Links(Vec<Link>),
    /// Points that are samples themselves.
    Samples(Vec<Sample>, StepSource),
}

/// The loops of each part, the outer one first. A run on which another part has an end is cut
/// there, so that two short edges can share a long one.
pub(super) fn sources(
    design: &Design,
    parts: &[&DesignPanel],
    failed: &dyn Fn(PanelCause) -> PanelError,
) -> Result<Vec<Vec<LoopSource>>, PanelError> {
    let mut sources = Vec::new();
    for part in parts {
        sources.push(loops_of(design, part)?);
    }
    let pieces = |source: &LoopSource| match source {
        LoopSource::Links(links) => links.iter().map(|link| link.curve.spans().len()).sum(),
        LoopSource::Samples(samples, _) => samples.len(),
    };
    let found = sources.iter().flatten().map(pieces).sum();
    if found > MAX_PIECES {
        let cause = JoinCause::TooLarge { found, most: MAX_PIECES };
        return Err(failed(PanelCause::Join { part: None, cause }));
    }
    cut_where_others_end(&mut sources);
    Ok(sources)
}

/// How far apart ends may be that are one, mm, for links of this size.
pub(super) fn near_mm<'a>(links: impl Iterator<Item = &'a Link>) -> f64 {
    let controls = links.flat_map(|link| link.curve.spans()).flat_map(|span| span.control);
    Tolerance::CHAIN.length_mm(size_of(controls))
}

fn loops_of(design: &Design, part: &DesignPanel) -> Result<Vec<LoopSource>, PanelError> {
    let uses: Vec<&CurveUse> = match &part.shape {
        PanelShape::Rails(rails) => rails.iter().collect(),
        PanelShape::Loops { outer, holes } => outer.iter().chain(holes.iter().flatten()).collect(),
        // Refused before.
        PanelShape::Join(_) | PanelShape::Mesh(_) => Vec::new(),
    };
    let mut needed = 3;
    for part_of_loop in uses {
        needed += built(design, part, part_of_loop)?.smooth_runs().len();
    }
    // Errors of a part are those that it has when it is made by itself, but for too few samples:
    // here its number of samples does not count.
    let alone = DesignPanel { samples: part.samples.max(needed), ..part.clone() };
    Sampler { design, matched: &Matched::new() }.of_curves(&alone)?;
    match &part.shape {
        PanelShape::Rails(rails) => {
            rail_links(design, &alone, rails).map(|links| vec![LoopSource::Links(links)])
        }
        PanelShape::Loops { outer, holes } => {
            std::iter::once(outer).chain(holes).map(|uses| loop_of(design, part, uses)).collect()
        }
        PanelShape::Join(_) | PanelShape::Mesh(_) => Ok(Vec::new()),
    }
}

fn loop_of(
    design: &Design,
    part: &DesignPanel,
    uses: &[CurveUse],
) -> Result<LoopSource, PanelError> {
    if let [only] = uses {
        let source = found(design, part, only)?;
        if source.kind.is_none() && source.closed {
            let samples = samples_from_points(&source.points);
            let samples = if only.reversed { run_back(&samples) } else { samples };
            return Ok(LoopSource::Samples(samples, on_curve(design, only)));
        }
    }
    let mut links = Vec::new();
    for wanted in uses {
        let drawn = CurveUse { name: wanted.name.clone(), reversed: false };
        let curve = built(design, part, &drawn)?;
        links.extend(links_of(&curve, wanted.reversed, on_curve(design, wanted)));
    }
    Ok(LoopSource::Links(links))
}

/// What steps along a curve that is used lie on.
fn on_curve(design: &Design, wanted: &CurveUse) -> StepSource {
    let number = design.curves.iter().position(|curve| curve.name == wanted.name);
    StepSource::Curve(number.unwrap_or_default())
}

fn links_of(curve: &Curve, reversed: bool, source: StepSource) -> Vec<Link> {
    let mut runs = curve.smooth_runs();
    if reversed {
        runs.reverse();
    }
    runs.into_iter().map(|curve| Link { curve, reversed, source }).collect()
}

/// The loop of two rails and the straight edges between their ends.
fn rail_links(
    design: &Design,
    part: &DesignPanel,
    rails: &[CurveUse; 2],
) -> Result<Vec<Link>, PanelError> {
    let failed = |cause: PanelCause| PanelError::of_panel(&part.name, cause);
    let curves = [built(design, part, &rails[0])?, built(design, part, &rails[1])?];
    let along = |curve: &Curve| {
        sample_open(curve, part.samples).map_err(|error| failed(PanelCause::Sampling(error)))
    };
    let (near, far) = (along(&curves[0])?, along(&curves[1])?);
    // As where rails are sampled: the second runs back.
    let turned = apart(&near, &far) < apart(&near, &run_back(&far));
    let [first, second] = curves;
    let second = if turned { second.reversed() } else { second };
    let size = size_of(near.iter().chain(&far).map(|s| s.position));
    let edge = |from: Point3, to: Point3, source: StepSource| {
        let straight = [from, to].map(CurvePoint::corner);
        let apart = from.distance(to) > Tolerance::CHAIN.length_mm(size);
        let curve = apart.then(|| Curve::new(CurveKind::Polyline, &straight, false));
        let curve = curve.transpose().map_err(|error| failed(PanelCause::Curve(error)))?;
        Ok(curve.map(|curve| Link { curve, reversed: false, source }))
    };
    let at_end = edge(first.end(), second.start(), StepSource::End)?;
    let at_start = edge(second.end(), first.start(), StepSource::Start)?;
    // As they were drawn, and run as they are used.
    let rail = |curve: Curve, n: usize, reversed: bool| {
        let drawn = if reversed { curve.reversed() } else { curve };
        links_of(&drawn, reversed, on_curve(design, &rails[n]))
    };
    let mut links = rail(first, 0, rails[0].reversed);
    links.extend(at_end);
    links.extend(rail(second, 1, rails[1].reversed != turned));
    links.extend(at_start);
    Ok(links)
}

fn cut_where_others_end(sources: &mut [Vec<LoopSource>]) {
    let links = || {
        let parts = sources.iter().enumerate();
        parts.flat_map(|(part, loops)| {
            let links = loops.iter().filter_map(|source| match source {
                LoopSource::Links(links) => Some(links),
                LoopSource::Samples(..) => None,
            });
            links.flatten().map(move |link| (part, link))
        })
    };
    let near = near_mm(links().map(|(_, link)| link));
    // Spans of links, then ends of links, with their parts.
    let mut boxes: Vec<(Vec3, Vec3)> = Vec::new();
    let mut spans = Vec::new();
    for (n, (part, link)) in links().enumerate() {
        for (number, span) in link.curve.spans().iter().enumerate() {
            let corners = span.control.map(Point3::to_vec);
            let (low, high) = corners
                .iter()
                .fold((corners[0], corners[0]), |(low, high), p| (low.min(*p), high.max(*p)));
            boxes.push((low - near, high + near));
            spans.push((part, n, number, span));
        }
    }
    let mut ends = Vec::new();
    for (part, link) in links() {
        for end in [link.curve.start(), link.curve.end()] {
            boxes.push((end.to_vec(), end.to_vec()));
            ends.push((part, end));
        }
    }
    let mut cuts: Vec<Vec<(usize, f64)>> = vec![Vec::new(); links().count()];
    for_touching_boxes(&boxes, |i, j| {
        let (Some((part, n, number, span)), Some(end)) =
            (spans.get(i), j.checked_sub(spans.len()).and_then(|j| ends.get(j)))
        else {
            return;
        };
        if *part != end.0 {
            let t = span.nearest(end.1);
            if span.position(t).distance(end.1) <= near {
                cuts[*n].push((*number, t));
            }
        }
    });
    let mut cuts = cuts.into_iter();
    for source in sources.iter_mut().flatten() {
        if let LoopSource::Links(links) = source {
            let whole = std::mem::take(links);
            *links = whole.into_iter().flat_map(|l| cut(l, cuts.next(), near)).collect();
        }
    }
}

/// A link cut at places (span and its parameter) that are not its ends; closed links stay whole.
fn cut(link: Link, places: Option<Vec<(usize, f64)>>, near: f64) -> Vec<Link> {
    let Link { curve, reversed, source } = link;
    let mut places = places.unwrap_or_default();
    if curve.closed() {
        return vec![Link { curve, reversed, source }];
    }
    // From the end, so that the numbers of the spans before stay.
    places.sort_by(|a, b| b.0.cmp(&a.0).then(b.1.total_cmp(&a.1)));
    let mut pieces = Vec::new();
    let mut left = curve;
    // How much is left of a span that was cut.
    let mut cut_at = (usize::MAX, 1.0);
    for (span, t) in places {
        let t = if span == cut_at.0 { t / cut_at.1 } else { t };
        let (span, t) = if t >= 1.0 { (span + 1, 0.0) } else { (span, t) };
        let inside = (span > 0 || t > 0.0) && span < left.spans().len();
        let at = left.position(span as f64 + t);
        if inside && [left.start(), left.end()].iter().all(|end| at.distance(*end) > near) {
            let [before, after] = left.cut(span, t);
            pieces.push(Link { curve: after, reversed, source });
            left = before;
            if t > 0.0 {
                cut_at = (span, if span == cut_at.0 { t * cut_at.1 } else { t });
            }
        }
    }
    pieces.push(Link { curve: left, reversed, source });
    if !reversed {
        pieces.reverse();
    }
    pieces
}

/// The samples of a loop of links with these divisions, and what the step from each lies on.
pub(super) fn loop_samples<'a>(
    links: &[Link],
    divisions: &mut impl Iterator<Item = &'a usize>,
) -> Result<(Vec<Sample>, Vec<StepSource>), SampleError> {
    let (mut pieces, mut steps) = (Vec::new(), Vec::new());
    for link in links {
        let divisions = divisions.next().copied().unwrap_or(1);
        if link.curve.closed() {
            let samples = sample_chain(std::slice::from_ref(&link.curve), divisions)?;
            let steps = vec![link.source; samples.len()];
            return Ok((if link.reversed { run_back(&samples) } else { samples }, steps));
        }
        let samples = sample_open(&link.curve, divisions + 1)?;
        steps.extend(vec![link.source; samples.len() - 1]);
        pieces.push(if link.reversed { run_back(&samples) } else { samples });
    }
    Ok((chained_samples(&pieces), steps))
}
