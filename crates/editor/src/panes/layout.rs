//! How the panes share the window: all at once where there is room, else one at a time, with the
//! answer beside it while that fits. A phone has no room, and no more has a small screen with text
//! at 200 %.

use super::SurfaceView;
use super::pattern::PatternPane;
use super::plan::PlanPane;
use super::space::SpacePane;
use crate::bars::command_button;
use crate::command::Command;
use crate::document::Plan;
use crate::editor::Editor;
use crate::scene::{Act, Scene};
use crate::side::side_ui;
use crate::theme::Theme;
use eframe::CreationContext;
use eframe::egui::{self, Frame, Key, Margin, Panel, RichText, Ui, Vec2, vec2};

/// How much room there is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Room {
    /// For everything.
    #[default]
    All,
    /// For one pane, and the answer beside it.
    Two,
    /// For one of them.
    One,
}

impl Room {
    /// In a window of this size, in points.
    pub fn of(size: Vec2) -> Self {
        if size.x >= 900.0 && size.y >= 480.0 {
            Self::All
        } else if size.x >= 600.0 {
            Self::Two
        } else {
            Self::One
        }
    }
}

/// What is seen where there is no room for everything.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Part {
    /// The plan.
    #[default]
    Plan,
    /// Space.
    Space,
    /// The flat pattern.
    Pattern,
    /// Will it bend, and the typed values.
    Answer,
}

impl Part {
    /// Every part.
    pub const ALL: [Self; 4] = [Self::Plan, Self::Space, Self::Pattern, Self::Answer];

    /// What people call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plan => "Plan",
            Self::Space => "Space",
            Self::Pattern => "Pattern",
            Self::Answer => "Will it bend?",
        }
    }

    /// Its key, with Shift.
    pub fn key(self) -> Key {
        match self {
            Self::Plan => Key::D,
            Self::Space => Key::S,
            Self::Pattern => Key::P,
            Self::Answer => Key::A,
        }
    }
}

/// The panes, with what they keep from frame to frame.
pub struct Panes {
    /// The plan.
    pub plan: PlanPane,
    /// Space.
    pub space: SpacePane,
    /// The flat pattern.
    pub pattern: PatternPane,
    plan_share: Share,
    pattern_share: Share,
}

impl Panes {
    /// Panes that draw on the window's graphics card, if it has one.
    pub fn new(cc: &CreationContext<'_>) -> Self {
        Self {
            plan: PlanPane::default(),
            space: SpacePane::new(cc),
            pattern: PatternPane::default(),
            plan_share: Share { axis: 0, of_whole: 0.5, whole: 0.0 },
            pattern_share: Share { axis: 1, of_whole: 0.36, whole: 0.0 },
        }
    }

    /// Brings everything into sight.
    pub fn fit(&mut self) {
        self.plan.fit();
        self.space.fit();
        self.pattern.fit();
    }

    /// Shows them, and the answer at the side.
    pub fn ui(&mut self, ui: &mut Ui, editor: &Editor, theme: &'static Theme, acts: &mut Vec<Act>) {
        self.plan.tool = editor.tool;
        self.space.camera.perspective = !editor.orthographic;
        self.space.navigation = editor.navigation;
        let scene = editor.scene(theme);
        let bar = Frame::new().fill(theme.ground).inner_margin(Margin::symmetric(10, 7));
        let pane = Frame::new().fill(theme.paper);
        if editor.room != Room::All {
            parts_ui(ui, editor, theme, acts);
        }
        if editor.room != Room::One {
            Panel::right("side").frame(bar).default_size(286.0).min_size(220.0).show(ui, |ui| {
                side_ui(ui, editor, theme, acts);
            });
        }
        if editor.room == Room::All {
            self.all_ui(ui, editor, &scene, pane, acts);
            return;
        }
        let is_answer = editor.shown_part() == Part::Answer;
        egui::CentralPanel::default().frame(if is_answer { bar } else { pane }).show(ui, |ui| {
            match editor.shown_part() {
                Part::Plan => self.plan.ui(ui, &scene, acts),
                Part::Space => {
                    views_ui(ui, editor, theme, acts);
                    self.space.ui(ui, &scene, editor.view, acts);
                }
                Part::Pattern => self.pattern.ui(ui, &scene, editor.view, acts),
                Part::Answer => side_ui(ui, editor, theme, acts),
            }
        });
    }

    /// The plan on the left, space on the right, the pattern below it.
    fn all_ui(
        &mut self,
        ui: &mut Ui,
        editor: &Editor,
        scene: &Scene<'_>,
        pane: Frame,
        acts: &mut Vec<Act>,
    ) {
        let theme = scene.theme;
        let plan_hint = match scene.document.drawing.plan {
            Plan::Top => "from above: draw and move",
            Plan::Front => "from the front: draw and move",
            Plan::Side => "from the side: draw and move",
        };
        let panel = Panel::left("plan").frame(pane).resizable(true);
        self.plan_share.show(ui, panel, 220.0, |ui| {
            titled(ui, theme, "Plan", plan_hint);
            self.plan.ui(ui, scene, acts);
        });
        let panel = Panel::bottom("pattern").frame(pane).resizable(true);
        self.pattern_share.show(ui, panel, 80.0, |ui| {
            titled(ui, theme, "Pattern", "flat, true to scale");
            self.pattern.ui(ui, scene, editor.view, acts);
        });
        egui::CentralPanel::default().frame(pane).show(ui, |ui| {
            views_ui(ui, editor, theme, acts);
            self.space.ui(ui, scene, editor.view, acts);
        });
    }
}

/// How much of the width or the height a panel takes. A panel of egui keeps its size when the window
/// grows; ours keep their share.
#[derive(Clone, Copy, Debug)]
struct Share {
    /// 0 across, 1 down.
    axis: usize,
    of_whole: f32,
    /// The whole that it was last a share of, in points.
    whole: f32,
}

impl Share {
    fn show(&mut self, ui: &mut Ui, panel: Panel, least: f32, content: impl FnOnce(&mut Ui)) {
        let whole = ui.available_size()[self.axis];
        let size = (self.of_whole * whole).max(least);
        let has_grown = self.whole != whole;
        let panel = if has_grown { panel.exact_size(size) } else { panel.min_size(least) };
        let taken = panel.show(ui, content).response.rect.size()[self.axis];
        if !has_grown {
            self.of_whole = taken / whole;
        }
        self.whole = whole;
    }
}

/// A pane's title, and what it is for.
fn titled(ui: &mut Ui, theme: &Theme, title: &str, hint: &str) {
    Frame::new().fill(theme.ground).inner_margin(Margin::symmetric(10, 4)).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.horizontal(|ui| {
            ui.label(RichText::new(title).strong());
            ui.add(egui::Label::new(RichText::new(hint).color(theme.faint).small()).truncate());
        });
    });
}

/// What can be seen instead, where not everything can.
fn parts_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    let bar = Frame::new().fill(theme.ground).inner_margin(Margin::symmetric(10, 4));
    Panel::top("parts").frame(bar).show(ui, |ui| {
        ui.horizontal(|ui| {
            for part in Part::ALL {
                if part != Part::Answer || editor.room == Room::One {
                    command_button(ui, editor, Command::Show(part), part.name(), acts);
                }
            }
        });
    });
}

/// The title of the pane of space, with the views of surfaces.
fn views_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    Frame::new().fill(theme.ground).inner_margin(Margin::symmetric(10, 4)).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.horizontal_wrapped(|ui| {
            if editor.room == Room::All {
                ui.label(RichText::new("Space").strong());
            }
            ui.spacing_mut().item_spacing = vec2(3.0, 3.0);
            ui.spacing_mut().button_padding = vec2(6.0, 1.0);
            ui.spacing_mut().interact_size.y = 18.0;
            for view in SurfaceView::ALL {
                let text = RichText::new(view.name()).size(12.5);
                command_button(ui, editor, Command::View(view), text, acts);
            }
        });
    });
}
