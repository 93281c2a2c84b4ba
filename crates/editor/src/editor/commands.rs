//! Every command, carried out; and why one can't be.

use super::{Editor, FileWish, Next, Page, Zoom};
use crate::command::Command;
use crate::document::Selection;
use crate::document::{Mirror, edit};
use crate::engine::shown::Shown;
use crate::panes::plan::Tool;
use crate::room::{Room, WindowPart};
use sheetwright::check::Place;

const NOTHING_DRAWN: &str = "Nothing is drawn yet.";
const NO_CURVE: &str = "There is no curve: a mesh has no handles.";
const NO_PANEL: &str = "There is no panel yet: close an outline first.";
const SELECT_A_HANDLE: &str = "Select a handle first.";
const SELECT_A_CURVE: &str = "Select a curve or a handle first.";

impl Editor {
    /// Why a command can't be carried out now, in a sentence; `None` if it can.
    pub fn why_not(&self, command: Command) -> Option<&'static str> {
        let document = self.document();
        let needs = |is_there: bool, why: &'static str| (!is_there).then_some(why);
        let is_drawn = !document.is_undrawn();
        let has_curves = !document.design.curves.is_empty();
        let has_panels = !document.design.panels.is_empty();
        let has_points = !self.selection.points.is_empty();
        let has_curve = has_points || self.selection.curve.is_some();
        match command {
            Command::Undo => needs(self.history.steps_back() > 0, "There is nothing to take back."),
            Command::Redo => needs(self.history.steps_forth() > 0, "Nothing was taken back."),
            Command::Save | Command::SaveAs | Command::Fit => needs(is_drawn, NOTHING_DRAWN),
            Command::SelectAll => needs(is_drawn, NOTHING_DRAWN).or(needs(has_curves, NO_CURVE)),
            Command::Export => needs(is_drawn, NOTHING_DRAWN).or(needs(has_panels, NO_PANEL)),
            Command::Vary => needs(is_drawn, NOTHING_DRAWN)
                .or(needs(has_curves, NO_CURVE))
                .or(needs(has_panels, NO_PANEL)),
            Command::ToggleCorner | Command::ToggleStraight => needs(has_points, SELECT_A_HANDLE),
            Command::Delete | Command::Join | Command::Reverse => needs(has_curve, SELECT_A_CURVE),
            Command::RemoveReference | Command::CalibrateReference => {
                needs(document.drawing.reference.is_some(), "There is no picture under the plan.")
            }
            Command::WorstRung => needs(self.worst_rung().is_some(), "No panel has a rung yet."),
            Command::Show(WindowPart::Answer) if self.room == Room::Two => {
                Some("It is in sight at the side.")
            }
            Command::Show(_) => needs(self.room != Room::All, "All panes are in sight."),
            Command::Stop => needs(self.jobs.work().is_some(), "Nothing is being worked out."),
            _ => None,
        }
    }

    /// Whether a command that switches something is on; `None` for the others.
    pub fn is_on(&self, command: Command) -> Option<bool> {
        let drawing = &self.document().drawing;
        match command {
            Command::Draw => Some(self.tool == Tool::Draw),
            Command::Select => Some(self.tool == Tool::Select),
            Command::CalibrateReference => Some(self.tool == Tool::Calibrate),
            Command::ToggleMirror => Some(drawing.mirror.is_some()),
            Command::ToggleGrid => Some(drawing.snap_to_grid),
            Command::ToggleOrthographic => Some(!self.orthographic),
            Command::PlanOf(plan) => Some(drawing.plan == plan),
            Command::View(view) => Some(self.view == view),
            Command::Show(part) => Some(self.room != Room::All && self.shown_part() == part),
            Command::Navigate(navigation) => Some(self.navigation == navigation),
            Command::Look(look) => Some(self.look == look),
            _ => None,
        }
    }

    pub(super) fn run(&mut self, command: Command) {
        if let Some(why) = self.why_not(command) {
            // No fault of anybody, and over as soon as something changes.
            self.say_in_passing(why);
            return;
        }
        self.notice = None;
        // Whatever is done by name is done to the panes.
        if self.page == Page::Palette {
            self.page = Page::Panes;
        }
        match command {
            Command::New => self.leave_for(Next::Blank),
            Command::Start => self.page = Page::Start,
            Command::Open => self.wishes.push(FileWish::Open),
            Command::Save => self.save(self.file.clone()),
            Command::SaveAs => self.save(None),
            Command::Export => self.page = Page::Export,
            Command::Undo => {
                self.history.undo();
                self.selection = self.cleaned(self.selection.clone());
            }
            Command::Redo => {
                self.history.redo();
                self.selection = self.cleaned(self.selection.clone());
            }
            Command::Draw => self.use_tool(Tool::Draw),
            Command::AddRectangle => {
                self.part = WindowPart::Plan;
                self.step(edit::with_rectangle(self.document()));
            }
            Command::AddCircle => {
                self.part = WindowPart::Plan;
                self.step(edit::with_circle(self.document()));
            }
            Command::Select => self.use_tool(Tool::Select),
            Command::CalibrateReference => self.use_tool(Tool::Calibrate),
            Command::SelectAll => self.selection = edit::all(self.document()),
            Command::Delete => self.step(edit::deleted(self.document(), &self.selection)),
            Command::ToggleCorner => {
                self.step(edit::with_corners_toggled(self.document(), &self.selection));
            }
            Command::ToggleStraight => {
                self.step(edit::with_sides_toggled(self.document(), &self.selection));
            }
            Command::Join => self.step(edit::joined(self.document(), &self.selection)),
            Command::Reverse => self.step(edit::reversed(self.document(), &self.selection)),
            Command::ToggleMirror => self.draw_as(|drawing| {
                let mirror = Mirror { upright: true, at_mm: 0.0 };
                drawing.mirror = drawing.mirror.is_none().then_some(mirror);
            }),
            Command::ToggleGrid => {
                self.draw_as(|drawing| drawing.snap_to_grid = !drawing.snap_to_grid);
            }
            Command::AddReference => self.wishes.push(FileWish::Picture),
            Command::RemoveReference => self.draw_as(|drawing| drawing.reference = None),
            Command::PlanOf(plan) => {
                self.draw_as(|drawing| drawing.plan = plan);
                self.part = WindowPart::Plan;
                self.wants_fit = true;
            }
            Command::View(view) => {
                self.view = view;
                self.show_sheet();
            }
            Command::Show(part) => self.part = part,
            Command::Fit => self.wants_fit = true,
            Command::ToggleOrthographic => self.orthographic = !self.orthographic,
            Command::WorstRung => {
                if let Some((panel, rung)) = self.worst_rung() {
                    self.bring_into_sight(Selection::of_rung(panel, rung));
                }
            }
            Command::Vary => self.page = Page::Vary,
            Command::Palette => self.page = Page::Palette,
            Command::Tour => self.page = Page::Tour,
            Command::Keys => self.page = Page::Keys,
            Command::Navigate(navigation) => {
                self.navigation = navigation;
                self.say(command.tooltip());
            }
            Command::Look(look) => self.look = look,
            Command::ZoomIn => self.wants_zoom = Some(Zoom::In),
            Command::ZoomOut => self.wants_zoom = Some(Zoom::Out),
            Command::ZoomReset => self.wants_zoom = Some(Zoom::Normal),
            Command::Stop => self.jobs.stop(),
            Command::Escape => self.escape(),
        }
    }

    /// Ends what is open, then the tool, then the selection.
    fn escape(&mut self) {
        if self.history.is_dragging() {
            self.history.drop_drag();
        } else if self.page != Page::Panes {
            self.page = Page::Panes;
        } else if self.tool != Tool::Select {
            self.tool = Tool::Select;
        } else {
            self.selection = Selection::default();
        }
    }

    /// Brings the sheet into sight, as it is in space; or as it lies flat, for whoever looks at
    /// that.
    fn show_sheet(&mut self) {
        if self.part != WindowPart::Pattern {
            self.part = WindowPart::Space;
        }
    }

    /// Selects something, and brings what is marked of a panel into sight.
    pub(super) fn bring_into_sight(&mut self, selection: Selection) {
        let place = Some(&selection.place).filter(|&place| *place != Place::Whole);
        self.wants_sight = selection.panel.zip(place.cloned());
        self.selection = self.cleaned(selection);
        self.show_sheet();
    }

    fn use_tool(&mut self, tool: Tool) {
        self.page = Page::Panes;
        self.part = WindowPart::Plan;
        self.tool = tool;
    }

    fn draw_as(&mut self, change: impl FnOnce(&mut crate::document::Drawing)) {
        let mut document = self.document().clone();
        change(&mut document.drawing);
        self.becomes(document);
    }

    /// The panel and the rung with the largest warp angle of all: of those that the sampling does
    /// not explain, if there are any.
    pub fn worst_rung(&self) -> Option<(usize, usize)> {
        let made = self.shown.iter().enumerate();
        let worst = made.filter_map(|(n, panel)| {
            let shown = panel.made.as_ref().ok()?;
            let rung = shown.worst_rung()?;
            Some((n, rung, shown.twist()))
        });
        worst.max_by(|a, b| a.2.cmp(&b.2)).map(|(panel, rung, _)| (panel, rung))
    }

    /// The numbers of the panels that are shown, the worst first; those that are as bad in their
    /// order.
    pub fn worst_first(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.shown.len()).collect();
        let rank = |n: &usize| {
            let panel = &self.shown[*n];
            (panel.badness(), panel.made.as_ref().ok().map(Shown::twist))
        };
        order.sort_by_key(|n| std::cmp::Reverse(rank(n)));
        order
    }

    /// The worst panel with its worst rung, if it has one.
    pub fn worst_place(&self) -> Option<Selection> {
        let panel = *self.worst_first().first()?;
        let rung = self.shown[panel].made.as_ref().ok().and_then(Shown::worst_rung);
        Some(match rung {
            Some(rung) => Selection::of_rung(panel, rung),
            None => Selection::of_place(panel, Place::Whole),
        })
    }
}
