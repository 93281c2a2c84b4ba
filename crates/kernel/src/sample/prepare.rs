//! The input of the triangulation of a panel: its boundary, its supporting plane and the options.

use super::error::{PanelCause, PanelError};
use super::joined;
use super::loops::Sampler;
use super::source::{Sampled, Sourced};
use super::steps::StepSource;
use crate::design::{DesignPanel, PanelMethod, PanelShape};
use sheetwright_geometry::boundary::{Boundary, Joined, SupportingPlane, supporting_plane};
use sheetwright_geometry::math::Point3;
use sheetwright_geometry::watch::Watch;
use sheetwright_optimum::cost::{Hint, HintKind};
use sheetwright_optimum::triangulate::{
    DEFAULT_WORK, Method, TriangulateOptions, refuse, with_holes_facing,
};

/// The samples of a panel.
pub(crate) fn sampled(sampler: &Sampler<'_>, panel: &DesignPanel) -> Result<Sampled, PanelError> {
    match &panel.shape {
        PanelShape::Join(_) if panel.run_on => {
            Err(PanelError::of_panel(&panel.name, PanelCause::RunOn))
        }
        PanelShape::Join(join) => joined::sampled(sampler.design, panel, join),
        _ => sampler.of_curves(panel),
    }
}

/// The input of the triangulation of a panel.
pub(crate) struct Prepared {
    pub(crate) boundary: Boundary,
    /// The plane that supports it, if there is one.
    pub(crate) plane: Option<SupportingPlane>,
    pub(crate) options: TriangulateOptions,
    /// The places on curves of the samples of the boundary.
    pub(crate) sources: Vec<Sourced>,
    /// The source of the step from each sample of the boundary to the next.
    pub(crate) steps: Vec<StepSource>,
    /// If rails run on: how far each end bulges from the straight line, mm, if it does.
    pub(crate) new_ends: Option<[Option<f64>; 2]>,
    /// If panels were joined: the outcome.
    pub(crate) joined: Option<Joined>,
}

/// Samples a panel, and says how it is to be triangulated.
pub(crate) fn prepare(
    sampler: &Sampler<'_>,
    panel: &DesignPanel,
    watch: &mut dyn Watch,
) -> Result<Prepared, PanelError> {
    let failed = |cause: PanelCause| PanelError::of_panel(&panel.name, cause);
    let sampled = sampled(sampler, panel)?;
    let method = match panel.method {
        PanelMethod::Optimal => Method::Optimal,
        PanelMethod::Bridge => Method::Bridge,
        PanelMethod::Rails => Method::Rails {
            first: sampled.on_first_rail.ok_or_else(|| failed(PanelCause::NoRails))?,
        },
    };
    let mut options =
        TriangulateOptions { method, goal: panel.goal, ..TriangulateOptions::default() };
    options.price.fold = panel.fold;
    options.which = panel.which;
    let near = |&at: &Point3| Hint { at, kind: HintKind::Near };
    options.hints = panel.near.iter().map(near).collect();
    options.work_limit = (panel.effort * DEFAULT_WORK as f64) as u64;
    // Before the boundary is looked at, which takes its time for a long one.
    let lengths: Vec<usize> = sampled.loops.iter().map(Vec::len).collect();
    refuse(&lengths, &options).map_err(|e| failed(PanelCause::Triangulate(e)))?;
    let boundary = Boundary::new(sampled.samples()).map_err(|e| failed(PanelCause::Boundary(e)))?;
    let plane_of = |boundary: &Boundary| {
        supporting_plane(boundary, panel.plane).map_err(|e| failed(PanelCause::Plane(e)))
    };
    let mut plane = plane_of(&boundary)?;
    let Sampled { mut loops, mut steps, new_ends, joined, .. } = sampled;
    let mut faced = boundary;
    if faced.holes() > 0 {
        faced = with_holes_facing(&faced, plane.as_ref(), &options, watch)
            .map_err(|e| failed(PanelCause::Triangulate(e)))?;
        plane = plane_of(&faced)?;
        for ((sources, steps), range) in loops.iter_mut().zip(&mut steps).zip(faced.loops()) {
            // A hole that was turned keeps its first sample.
            if sources[1].sample.position != faced.samples()[range.start + 1].position {
                steps.reverse();
                sources[1..].reverse();
                sources.iter_mut().for_each(|source| *source = source.back());
            }
        }
    }
    let sources = loops.into_iter().flatten().collect();
    let steps = steps.into_iter().flatten().collect();
    Ok(Prepared { boundary: faced, plane, options, sources, steps, new_ends, joined })
}
