//! Panels moved by the unknowns and triangulated anew, by which a step is judged.

use super::{Motion, Moving, MovingPanel, VaryError, VaryPanel};
use crate::design::VaryGoal;
use sheetwright_geometry::boundary::{Boundary, SupportingPlane};
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::Vec3;
use sheetwright_geometry::watch::Watch;
use sheetwright_optimum::cost::Prices;
use sheetwright_optimum::rung::Rung;
use sheetwright_optimum::triangulate::{
    TriangulateError, TriangulateOptions, Triangulation, triangulate,
};
use std::f64::consts::PI;

/// A panel in its current state.
#[derive(Clone, Debug)]
pub(super) struct PanelState {
    pub(super) boundary: Boundary,
    pub(super) plane: Option<SupportingPlane>,
    pub(super) triangulate: TriangulateOptions,
    /// How its samples follow the unknowns from here on.
    pub(super) motions: Vec<Motion>,
    pub(super) triangulation: Triangulation,
    /// The warp angle of each rung, radians; π without tangent planes.
    pub(super) warps: Vec<f64>,
    twist: f64,
    pub(super) follows: bool,
}

impl PanelState {
    /// A given panel, not moved.
    pub(super) fn held(
        panel: &VaryPanel<'_>,
        plane: Option<&SupportingPlane>,
        triangulation: &Triangulation,
    ) -> Self {
        Self {
            boundary: panel.boundary.clone(),
            plane: plane.cloned(),
            triangulate: panel.triangulate.clone(),
            motions: panel.motions.to_vec(),
            triangulation: triangulation.clone(),
            warps: Vec::new(),
            twist: 0.0,
            follows: panel.follows,
        }
    }
}

/// All panels in their current state.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub(super) unknowns: Vec<Vec3>,
    pub(super) panels: Vec<PanelState>,
    /// Π, summed over the panels.
    pub(super) price: f64,
    /// W, summed over the panels.
    pub(super) twist: f64,
}

/// Passes on stopping, but not the progress, which is of a part of a stage only.
struct Quiet<'a>(&'a dyn Watch);

impl Watch for Quiet<'_> {
    fn stop(&self) -> bool {
        self.0.stop()
    }
}

/// Why there is no state.
pub(super) enum NoState {
    /// The moved samples touch, or have no triangulation.
    Refused(VaryError),
    Stopped,
}

impl State {
    /// The panels moved by the unknowns. Those with the samples of `before` keep its triangulation.
    pub(super) fn new(
        moving: &dyn Moving,
        unknowns: Vec<Vec3>,
        before: Option<&Self>,
        watch: &dyn Watch,
    ) -> Result<Self, NoState> {
        let panels = moving.panels(&unknowns, &mut Quiet(watch)).map_err(|error| match error {
            VaryError::Stopped => NoState::Stopped,
            error => NoState::Refused(error),
        })?;
        let mut states: Vec<PanelState> = Vec::with_capacity(panels.len());
        for (n, panel) in panels.into_iter().enumerate() {
            let MovingPanel { boundary, plane, triangulate: options, motions, follows } = panel;
            let known = before.map(|state| &state.panels[n]);
            if let Some(known) = known.filter(|known| known.boundary == boundary) {
                states.push(PanelState { motions, ..known.clone() });
                continue;
            }
            let triangulation = triangulate(&boundary, plane.as_ref(), &options, &mut Quiet(watch))
                .map_err(|error| match error {
                    TriangulateError::Stopped => NoState::Stopped,
                    error => NoState::Refused(VaryError::Triangulate { panel: n, error }),
                })?;
            let prices = Prices::new(&boundary, plane.as_ref(), options.price);
            let planes = |rung: &Rung| {
                let [i, j] = rung.ends().map(SampleIndex::get);
                prices.planes(i, j)
            };
            let warps =
                triangulation.rungs.iter().map(|r| planes(r).map_or(PI, |p| p.warp())).collect();
            let twist =
                triangulation.rungs.iter().map(|r| planes(r).map_or(2.0, |p| p.twist)).sum();
            states.push(PanelState {
                boundary,
                plane,
                triangulate: options,
                motions,
                triangulation,
                warps,
                twist,
                follows,
            });
        }
        let price = states.iter().map(|panel| panel.triangulation.price).sum();
        let twist = states.iter().map(|panel| panel.twist).sum();
        Ok(Self { unknowns, panels: states, price, twist })
    }

    /// The largest warp angle of all rungs, radians; 0 without rungs.
    pub(super) fn warp_max(&self) -> f64 {
        self.panels.iter().flat_map(|panel| &panel.warps).copied().fold(0.0, f64::max)
    }

    /// The panels for which the goal's warp angle holds, with their numbers.
    fn asked(&self) -> impl Iterator<Item = (usize, &PanelState)> {
        self.panels.iter().enumerate().filter(|(_, panel)| !panel.follows)
    }

    /// The largest warp angle of the panels for which the goal's holds, radians.
    pub(super) fn warp_asked(&self) -> f64 {
        self.asked().flat_map(|(_, panel)| &panel.warps).copied().fold(0.0, f64::max)
    }

    /// The sum of the squared excess of warp angles above the goal's, radians²; 0 without such a
    /// goal.
    pub(super) fn excess(&self, goal: VaryGoal) -> f64 {
        let VaryGoal::Warp { largest } = goal else { return 0.0 };
        let above = |warp: &f64| (warp - largest).max(0.0);
        let warps = self.asked().flat_map(|(_, panel)| &panel.warps);
        warps.map(above).map(|excess| excess * excess).sum()
    }

    /// The rungs whose warp angle is above `angle`, radians, with their panels.
    pub(super) fn above(&self, angle: f64) -> Vec<(usize, Rung)> {
        let of_panel = |(n, panel): (usize, &PanelState)| {
            let rungs = panel.triangulation.rungs.iter().zip(&panel.warps);
            rungs.filter(|(_, warp)| **warp > angle).map(|(r, _)| (n, *r)).collect::<Vec<_>>()
        };
        self.asked().flat_map(of_panel).collect()
    }
}
