//! How the panes share the window: all at once where there is room, else one at a time, with the
//! answer beside it while that fits.

use crate::bars::command_button;
use crate::command::Command;
use crate::document::Plan;
use crate::editor::Editor;
use crate::panes::pattern::PatternPane;
use crate::panes::plan::PlanPane;
use crate::panes::space::SpacePane;
use crate::room::{Room, WindowPart};
use crate::scene::{Act, Scene};
use crate::side::fields_ui;
use crate::theme::Theme;
use crate::verdicts::{banner_ui, verdicts_ui};
use crate::views::SurfaceView;
use eframe::CreationContext;
use eframe::egui::{self, Frame, Margin, Panel, RichText, Ui, vec2};
use sheetwright::check::Place;

/// What the plan takes of the width beside the answer, and the pattern of the height, at first: the
/// plan is what people draw on, and space what they look at.
const PLAN_SHARE: f32 = 0.5;
const PATTERN_SHARE: f32 = 0.36;
/// What the cards of the panels take of the height of the bar at the side, at first.
const VERDICT_SHARE: f32 = 0.42;
/// How wide the answer is at first, points: a verdict in some lines.
const SIDE: f32 = 286.0;
/// What is narrower or lower is of no use, points.
const LEAST_ACROSS: f32 = 220.0;
const LEAST_DOWN: f32 = 80.0;

/// The panes, with what they keep from frame to frame.
pub(crate) struct Panes {
    /// The plan.
    pub(crate) plan: PlanPane,
    /// Space.
    pub(crate) space: SpacePane,
    /// The flat pattern.
    pub(crate) pattern: PatternPane,
    plan_share: Share,
    pattern_share: Share,
    verdict_share: Share,
}

impl Panes {
    /// Panes that draw on the window's graphics card, if it has one.
    pub(crate) fn new(cc: &CreationContext<'_>) -> Self {
        Self {
            plan: PlanPane::default(),
            space: SpacePane::new(cc),
            pattern: PatternPane::default(),
            plan_share: Share::new(0, PLAN_SHARE),
            pattern_share: Share::new(1, PATTERN_SHARE),
            verdict_share: Share::new(1, VERDICT_SHARE),
        }
    }

    /// Brings everything into sight.
    pub(crate) fn fit(&mut self) {
        self.plan.fit();
        self.space.fit();
        self.pattern.fit();
    }

    /// Brings a place on a panel into sight, where it is not.
    pub(crate) fn bring_into_sight(&mut self, panel: usize, place: &Place) {
        self.space.bring_into_sight(panel, place.clone());
        self.pattern.bring_into_sight(panel, place.clone());
    }

    /// What the hand holds in panes that are not shown is let go, except for these.
    pub(crate) fn let_go(&mut self, except: &[WindowPart], acts: &mut Vec<Act>) {
        if !except.contains(&WindowPart::Plan) {
            self.plan.let_go(acts);
        }
        if !except.contains(&WindowPart::Space) {
            self.space.let_go(acts);
        }
    }

    /// Shows them, and the answer at the side.
    pub(crate) fn ui(
        &mut self,
        ui: &mut Ui,
        editor: &Editor,
        theme: &'static Theme,
        acts: &mut Vec<Act>,
    ) {
        self.plan.tool = editor.tool;
        self.space.camera.perspective = !editor.orthographic;
        self.space.navigation = editor.navigation;
        let scene = editor.scene(theme);
        let bar = bar_frame(theme);
        let pane = Frame::new().fill(theme.paper);
        if editor.room != Room::All {
            parts_ui(ui, editor, theme, acts);
        }
        if editor.room != Room::One {
            let most = (0.5 * ui.available_width()).max(SIDE);
            let side = Panel::right("side").frame(bar).default_size(SIDE);
            let side = side.size_range(LEAST_ACROSS..=most);
            side.show(ui, |ui| self.side_ui(ui, editor, theme, acts));
        }
        if editor.room == Room::All {
            self.all_ui(ui, editor, &scene, pane, acts);
            return;
        }
        self.let_go(&[editor.shown_part()], acts);
        let is_answer = editor.shown_part() == WindowPart::Answer;
        egui::CentralPanel::default().frame(if is_answer { bar } else { pane }).show(ui, |ui| {
            match editor.shown_part() {
                WindowPart::Plan => self.plan.ui(ui, &scene, acts),
                WindowPart::Space => {
                    views_ui(ui, editor, theme, acts);
                    self.space.ui(ui, &scene, editor.view, acts);
                }
                WindowPart::Pattern => self.pattern.ui(ui, &scene, editor.view, acts),
                WindowPart::Answer => self.side_ui(ui, editor, theme, acts),
            }
        });
    }

    /// How many panels are not fine; what can be typed, at places that no verdict moves; the
    /// verdicts.
    fn side_ui(&mut self, ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
        banner_ui(ui, editor, theme, acts);
        let panel = Panel::bottom("verdicts").frame(Frame::new()).resizable(true);
        self.verdict_share.show(ui, panel, LEAST_DOWN, |ui| verdicts_ui(ui, editor, theme, acts));
        egui::CentralPanel::default().frame(Frame::new()).show(ui, |ui| {
            fields_ui(ui, editor, theme, acts);
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
        self.plan_share.show(ui, panel, LEAST_ACROSS, |ui| {
            titled(ui, theme, "Plan", plan_hint);
            self.plan.ui(ui, scene, acts);
        });
        let panel = Panel::bottom("pattern").frame(pane).resizable(true);
        self.pattern_share.show(ui, panel, LEAST_DOWN, |ui| {
            titled(ui, theme, "Pattern", "flat, true to scale");
            self.pattern.ui(ui, scene, editor.view, acts);
        });
        egui::CentralPanel::default().frame(pane).show(ui, |ui| {
            views_ui(ui, editor, theme, acts);
            self.space.ui(ui, scene, editor.view, acts);
        });
    }
}

/// How much of the width or the height a panel takes. A panel of egui keeps its size when the
/// window changes; ours keep their share, also where they had to be larger for a while.
#[derive(Clone, Copy, Debug)]
struct Share {
    /// 0 across, 1 down.
    axis: usize,
    of_whole: f32,
    /// The whole that it was last a share of, and what it took of it, in points.
    last: Option<[f32; 2]>,
}

/// A panel that differs by less from what it took was not moved by anybody, points.
const MOVED: f32 = 0.5;

impl Share {
    fn new(axis: usize, of_whole: f32) -> Self {
        Self { axis, of_whole, last: None }
    }

    fn show(&mut self, ui: &mut Ui, panel: Panel, least: f32, content: impl FnOnce(&mut Ui)) {
        let whole = ui.available_size()[self.axis].max(0.0);
        // Neither the panel nor what is beside it goes away.
        let range = least.min(0.5 * whole)..=(whole - least).max(0.5 * whole);
        let size = (self.of_whole * whole).clamp(*range.start(), *range.end());
        let last = self.last.filter(|[last_whole, _]| *last_whole == whole);
        let panel = match last {
            Some(_) => panel.size_range(range),
            None => panel.exact_size(size),
        };
        let taken = panel.show(ui, content).response.rect.size()[self.axis];
        if whole > 0.0 && last.is_some_and(|[_, took]| (taken - took).abs() > MOVED) {
            self.of_whole = taken / whole;
        }
        self.last = Some([whole, taken]);
    }
}

/// What bars stand on.
pub(crate) fn bar_frame(theme: &Theme) -> Frame {
    Frame::new().fill(theme.ground).inner_margin(Margin::symmetric(10, 7))
}

/// What titles stand on.
fn title_frame(theme: &Theme) -> Frame {
    Frame::new().fill(theme.ground).inner_margin(Margin::symmetric(10, 4))
}

/// A pane's title, and what it is for.
fn titled(ui: &mut Ui, theme: &Theme, title: &str, hint: &str) {
    title_frame(theme).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.horizontal(|ui| {
            ui.label(RichText::new(title).strong());
            ui.add(egui::Label::new(RichText::new(hint).color(theme.faint).small()).truncate());
        });
    });
}

/// What can be seen instead, where not everything can.
fn parts_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    Panel::top("parts").frame(title_frame(theme)).show(ui, |ui| {
        ui.horizontal(|ui| {
            for part in WindowPart::ALL {
                if part != WindowPart::Answer || editor.room == Room::One {
                    command_button(ui, editor, Command::Show(part), part.name(), acts);
                }
            }
        });
    });
}

/// The title of the pane of space, with the views of surfaces.
fn views_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    title_frame(theme).show(ui, |ui| {
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
