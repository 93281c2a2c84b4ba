//! Stand-in until the pane lands.
#![allow(missing_docs)]
use crate::panes::SurfaceView;
use crate::scene::{Act, Scene};
use eframe::egui::Ui;
#[derive(Default)]
pub struct PatternPane;
impl PatternPane {
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
