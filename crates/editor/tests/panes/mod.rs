//! A pane alone in a window, over a made design, whose acts are carried out as the app does.

#![allow(clippy::unwrap_used)] // what is made here is known to be whole
#![allow(dead_code)] // each test file shows one pane

use eframe::egui;
use sheetwright::design::Design;
use sheetwright::make::make;
use sheetwright::watch::Unwatched;
use sheetwright_editor::document::Selection;
use sheetwright_editor::document::{Document, Drawing};
use sheetwright_editor::engine::Refusal;
use sheetwright_editor::engine::shown::{Shown, ShownPanel};
use sheetwright_editor::panes::pattern::PatternPane;
use sheetwright_editor::panes::space::SpacePane;
use sheetwright_editor::scene::{Act, Scene};
use sheetwright_editor::theme::{Look, Theme};
use sheetwright_editor::views::SurfaceView;
use std::path::Path;

/// Which pane.
pub(crate) enum Pane {
    Space(Box<SpacePane>),
    Pattern(PatternPane),
}

/// A window with one pane.
pub(crate) struct Window {
    pub(crate) pane: Pane,
    pub(crate) document: Document,
    pub(crate) panels: Vec<ShownPanel>,
    pub(crate) version: u64,
    pub(crate) selection: Selection,
    pub(crate) view: SurfaceView,
    pub(crate) look: Look,
    /// All acts, in order.
    pub(crate) acts: Vec<Act>,
    /// How long each frame of the pane took, seconds.
    pub(crate) took: Vec<f64>,
}

impl Window {
    pub(crate) fn new(pane: Pane, design: Design) -> Self {
        let panels = shown(&design);
        let document = Document { design, drawing: Drawing::default() };
        Self {
            pane,
            document,
            panels,
            version: 1,
            selection: Selection::default(),
            view: SurfaceView::Shaded,
            look: Look::Light,
            acts: Vec::new(),
            took: Vec::new(),
        }
    }

    pub(crate) fn space(&mut self) -> &mut SpacePane {
        match &mut self.pane {
            Pane::Space(pane) => pane,
            Pane::Pattern(_) => panic!("the pattern is shown"),
        }
    }

    fn carry_out(&mut self, act: Act) {
        match &act {
            Act::Select(selection) => self.selection = selection.clone(),
            Act::Move(moved) => {
                for (of, to) in moved {
                    self.document.design.curves[of.curve].points[of.point].at = *to;
                }
            }
            _ => {}
        }
        self.acts.push(act);
    }
}

impl eframe::App for Window {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let theme = Theme::of(self.look, false);
        theme.apply(ui.ctx());
        let scene = Scene {
            document: &self.document,
            panels: &self.panels,
            panels_version: self.version,
            selection: &self.selection,
            theme,
        };
        let mut acts = Vec::new();
        let began = std::time::Instant::now();
        match &mut self.pane {
            Pane::Space(pane) => pane.ui(ui, &scene, self.view, &mut acts),
            Pane::Pattern(pane) => pane.ui(ui, &scene, self.view, &mut acts),
        }
        self.took.push(began.elapsed().as_secs_f64());
        for act in acts {
            self.carry_out(act);
        }
    }
}

/// The panels of a design, as the engine shows them.
pub(crate) fn shown(design: &Design) -> Vec<ShownPanel> {
    if design.panels.is_empty() {
        return Vec::new();
    }
    match make(design, &mut Unwatched) {
        Ok(made) => {
            let of = |p: &sheetwright::make::Part| Shown::new(p, design.material.as_ref());
            let panels = made.parts.iter();
            let shown = |p: &sheetwright::make::Part| {
                let (name, panel, made) = (p.name.clone(), p.panel.clone(), Ok(of(p)));
                ShownPanel { name, panel, made }
            };
            panels.map(shown).collect()
        }
        Err(error) => {
            let refusal = Refusal { message: error.to_string(), hint: String::new() };
            let name = design.name.clone();
            vec![ShownPanel { name: name.clone(), panel: name, made: Err(refusal) }]
        }
    }
}

/// The design of a template.
pub(crate) fn template(name: &str) -> Design {
    sheetwright_files::design_from_template(name, &[]).unwrap()
}

/// The design of an example.
pub(crate) fn example(name: &str) -> Design {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(name);
    sheetwright_files::read_input(&path, &sheetwright_files::ReadOptions::default()).unwrap()
}
