//! Whose handles are shown: of few all; of many those of the curves that are selected, or under the
//! hand. The others are dots, and there all the same, for the hand, for keys and for screen
//! readers: a hand that comes to one is on its curve, and so sees it.

use crate::document::{PointRef, curves_of};
use crate::scene::Scene;
use crate::theme::Theme;
use eframe::egui::{Painter, Pos2};

/// So many handles are told apart on a pane; of more, not all are shown.
const ALL: usize = 80;
/// How large the others are, points, and how strong.
const DOT: f32 = 2.0;
const DIM: f32 = 0.45;

/// A handle that is not shown.
pub(super) fn paint_dim(painter: &Painter, theme: &Theme, at: Pos2) {
    painter.circle_filled(at, DOT, theme.curve.gamma_multiply(DIM));
}

/// Whether there are too many handles to show all.
pub(super) fn are_many(scene: &Scene<'_>) -> bool {
    scene.document.design.curves.iter().map(|curve| curve.points.len()).sum::<usize>() > ALL
}

/// The curves whose handles are shown.
pub(super) struct Lit {
    curves: Vec<bool>,
}

impl Lit {
    /// Of the curves under the hand, and those that are selected.
    pub(super) fn new(scene: &Scene<'_>, under_hand: impl IntoIterator<Item = usize>) -> Self {
        let design = &scene.document.design;
        let mut curves = vec![!are_many(scene); design.curves.len()];
        let selection = scene.selection;
        let of_points = selection.points.iter().map(|r| r.curve);
        for n in under_hand.into_iter().chain(selection.curve).chain(of_points) {
            if let Some(curve) = curves.get_mut(n) {
                *curve = true;
            }
        }
        let name = selection.panel.and_then(|n| scene.panels.get(n)).map(|panel| &panel.panel);
        if let Some(panel) = design.panels.iter().find(|panel| Some(&panel.name) == name) {
            let uses = curves_of(panel);
            for (curve, lit) in design.curves.iter().zip(&mut curves) {
                *lit |= uses.iter().any(|part| part.name == curve.name);
            }
        }
        Self { curves }
    }

    /// Whether a handle is shown.
    pub(super) fn shows(&self, of: PointRef) -> bool {
        self.curves.get(of.curve).copied().unwrap_or(false)
    }
}
