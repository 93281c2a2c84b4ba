//! Stand-in until the pane lands.
#![allow(missing_docs)]
use crate::panes::SurfaceView;
use crate::scene::{Act, Scene};
use eframe::egui::Ui;
pub struct SpacePane;
impl SpacePane {
    pub fn new(_cc: &eframe::CreationContext<'_>) -> Self {
        Self
    }
    pub fn fit(&mut self) {}
    pub fn ui(
        &mut self,
        _ui: &mut Ui,
        _scene: &Scene<'_>,
        _view: SurfaceView,
        _acts: &mut Vec<Act>,
    ) {
    }
}
