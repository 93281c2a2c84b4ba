//! Whose handles are shown: of few curves all; of many those of the curves that are selected, or
//! under the hand. The others are there all the same, for the hand, for keys and for screen readers:
//! a hand that comes to one is on its curve, and so sees it.

use crate::scene::{PointRef, Scene, curves_of};

/// So many handles are told apart on a pane; of more, not all are shown.
pub(super) const ALL: usize = 48;

/// The curves whose handles are shown.
pub(super) struct Lit {
    curves: Vec<bool>,
}

impl Lit {
    /// Of the curves under the hand, and those that are selected.
    pub(super) fn new(scene: &Scene<'_>, under_hand: impl IntoIterator<Item = usize>) -> Self {
        let design = &scene.document.design;
        let handles: usize = design.curves.iter().map(|curve| curve.points.len()).sum();
        let mut curves = vec![handles <= ALL; design.curves.len()];
        let selection = scene.selection;
        let of_points = selection.points.iter().map(|r| r.curve);
        for n in under_hand.into_iter().chain(selection.curve).chain(of_points) {
            if let Some(curve) = curves.get_mut(n) {
                *curve = true;
            }
        }
        let name = selection.panel.and_then(|n| scene.panels.get(n)).map(|panel| &panel.name);
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
