//! The bar at the top with the commands that people look for, and the line at the bottom.

use crate::command::Command;
use crate::document::Plan;
use crate::editor::{Editor, Notice, Page};
use crate::panes::plan::Tool;
use crate::room::{Room, fitting};
use crate::scene::Act;
use crate::theme::{Look, Theme};
use crate::views::Navigation;
use crate::views::SurfaceView;
use eframe::egui::{self, Button, Color32, Id, Layout, ProgressBar, RichText, Ui, UiBuilder};

/// What is above and below an open menu, points.
const AROUND_MENU: f32 = 70.0;
/// Widths that are to be left before something is put into the bar at the top, points: its own and
/// what comes after it, by the longest of their texts.
const ROOM_FOR_REDO: f32 = 150.0;
const ROOM_FOR_HABITS: f32 = 530.0;
const ROOM_FOR_VARY: f32 = 130.0;
const ROOM_FOR_FIND: f32 = 70.0;

/// A button that runs a command, or says why it can't.
pub(crate) fn command_button(
    ui: &mut Ui,
    editor: &Editor,
    command: Command,
    text: impl Into<RichText>,
    acts: &mut Vec<Act>,
) -> egui::Response {
    let why_not = editor.why_not(command);
    let is_on = editor.is_on(command).unwrap_or(false);
    let mut text = text.into();
    if is_on {
        text = text.color(ui.visuals().selection.stroke.color);
    }
    let button = Button::new(text).selected(is_on);
    let response = ui.add_enabled(why_not.is_none(), button);
    let key = ui.ctx().format_shortcut(&command.key());
    let response = response
        .on_hover_text(format!("{}  ({key})", command.tooltip()))
        .on_disabled_hover_text(format!("{}\n{}", command.tooltip(), why_not.unwrap_or_default()));
    if response.clicked() {
        acts.push(Act::Run(command));
    }
    response
}

/// A line of a menu.
fn menu_line(ui: &mut Ui, editor: &Editor, command: Command, acts: &mut Vec<Act>) {
    let why_not = editor.why_not(command);
    let key = ui.ctx().format_shortcut(&command.key());
    let mark = match editor.is_on(command) {
        Some(true) => "•  ",
        Some(false) => "    ",
        None => "",
    };
    let button = Button::new(format!("{mark}{}", command.name())).shortcut_text(key);
    let response = ui
        .add_enabled(why_not.is_none(), button)
        .on_hover_text(command.tooltip())
        .on_disabled_hover_text(why_not.unwrap_or_default());
    if response.clicked() {
        acts.push(Act::Run(command));
        ui.close();
    }
}

/// Every menu: its name, and its lines in groups.
fn menus() -> [(&'static str, Vec<Vec<Command>>); 4] {
    use Command as C;
    let file = vec![vec![C::Start, C::New, C::Open], vec![C::Save, C::SaveAs], vec![C::Export]];
    let edit = vec![
        vec![C::Undo, C::Redo],
        vec![C::Draw, C::AddRectangle, C::AddCircle],
        vec![C::SelectAll, C::Delete],
        vec![C::ToggleCorner, C::ToggleStraight, C::Join, C::Reverse],
        vec![C::ToggleMirror, C::ToggleGrid, C::Vary],
        vec![C::AddReference, C::CalibrateReference, C::RemoveReference],
    ];
    let view = vec![
        SurfaceView::ALL.map(C::View).to_vec(),
        Plan::ALL.map(C::PlanOf).to_vec(),
        vec![C::Fit, C::ToggleOrthographic, C::WorstRung],
        Navigation::ALL.map(C::Navigate).to_vec(),
        vec![C::ZoomIn, C::ZoomOut, C::ZoomReset],
        Look::ALL.map(C::Look).to_vec(),
    ];
    let help = vec![vec![C::Tour, C::Palette, C::Keys]];
    [("File", file), ("Edit", edit), ("View", view), ("Help", help)]
}

fn menus_ui(ui: &mut Ui, editor: &Editor, acts: &mut Vec<Act>) {
    for (name, groups) in menus() {
        ui.menu_button(name, |ui| {
            ui.set_min_width(220.0);
            let height = fitting(f32::INFINITY, ui.ctx().content_rect().height() - AROUND_MENU);
            let area = egui::ScrollArea::vertical().max_height(height);
            area.min_scrolled_height(height).show(ui, |ui| {
                for (n, group) in groups.iter().enumerate() {
                    if n > 0 {
                        ui.separator();
                    }
                    for &command in group {
                        menu_line(ui, editor, command, acts);
                    }
                }
            });
        });
    }
}

/// The bar at the top: what finds no room there stands in the menus all the same.
pub(crate) fn top_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    use Command as C;
    ui.horizontal(|ui| {
        if editor.room == Room::All {
            menus_ui(ui, editor, acts);
        } else {
            ui.menu_button("Menu", |ui| menus_ui(ui, editor, acts));
        }
        ui.separator();
        for command in [C::Select, C::Draw] {
            command_button(ui, editor, command, command.name(), acts);
        }
        ui.separator();
        command_button(ui, editor, C::Undo, "Undo", acts);
        if ui.available_width() > ROOM_FOR_REDO {
            command_button(ui, editor, C::Redo, "Redo", acts);
        }
        if ui.available_width() > ROOM_FOR_HABITS {
            ui.separator();
            for command in [C::ToggleMirror, C::ToggleGrid, C::Fit] {
                command_button(ui, editor, command, command.name(), acts);
            }
        }
        ui.with_layout(Layout::right_to_left(egui::Align::Center), |ui| {
            let text = RichText::new("Export…").color(theme.on_accent).strong();
            ui.scope(|ui| {
                if editor.why_not(C::Export).is_none() {
                    let widgets = &mut ui.visuals_mut().widgets;
                    widgets.inactive.weak_bg_fill = theme.accent;
                    widgets.hovered.weak_bg_fill = theme.accent;
                    command_button(ui, editor, C::Export, text, acts);
                } else {
                    command_button(ui, editor, C::Export, "Export…", acts);
                }
            });
            if ui.available_width() > ROOM_FOR_VARY {
                command_button(ui, editor, C::Vary, "Make it bend…", acts);
            }
            if ui.available_width() > ROOM_FOR_FIND {
                command_button(ui, editor, C::Palette, "Find…", acts);
            }
        });
    });
}

/// The line at the bottom: what to do, what is being done, what was said.
pub(crate) fn bottom_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    if editor.room == Room::One
        && let Some(notice) = editor.notice.as_ref().filter(|_| editor.work().is_none())
    {
        notice_ui(ui, theme, notice, true);
        return;
    }
    let line = egui::vec2(ui.available_width(), ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(line, Layout::right_to_left(egui::Align::Center), |ui| {
        if editor.room != Room::One {
            saved_ui(ui, editor, theme);
        }
        // *Make it bend* shows its work itself, and lies over this line.
        if let Some(work) = editor.work().filter(|_| editor.page != Page::Vary) {
            command_button(ui, editor, Command::Stop, "Stop", acts);
            ui.add(ProgressBar::new(work.done as f32).desired_width(120.0));
            if editor.room == Room::All {
                let most = (ui.available_width() / 2.0).max(0.0);
                ui.scope(|ui| {
                    ui.set_max_width(most);
                    ui.add(egui::Label::new(work.text).truncate()).on_hover_text(work.text);
                });
            }
        }
        ui.with_layout(Layout::left_to_right(egui::Align::Center), |ui| match &editor.notice {
            Some(notice) => notice_ui(ui, theme, notice, false),
            None => said_ui(ui, hint(editor), theme.faint, false),
        });
    });
}

/// Which file it is, or which design, and whether a file has it all; its whole path is under the
/// pointer.
fn saved_ui(ui: &mut Ui, editor: &Editor, theme: &Theme) {
    let title = editor.title();
    let text =
        if editor.is_in_no_file() { format!("{title} · not saved yet") } else { title.to_owned() };
    let most = (ui.available_width() / 3.0).max(0.0);
    let said = ui.scope(|ui| {
        ui.set_max_width(most);
        ui.add(egui::Label::new(RichText::new(text).color(theme.faint)).truncate())
    });
    if let Some(file) = editor.file() {
        said.inner.on_hover_text(file);
    }
}

/// What was last said to the person, in a line or as many as it takes.
pub(crate) fn notice_ui(ui: &mut Ui, theme: &Theme, notice: &Notice, wraps: bool) {
    let ink = match notice {
        Notice { is_refusal: true, .. } => theme.verdicts[2],
        Notice { is_passing: true, .. } => theme.faint,
        _ => theme.ink,
    };
    said_ui(ui, &notice.text, ink, wraps);
}

/// What screen readers say when it changes: always the same thing to them, wherever it stands.
fn said_ui(ui: &mut Ui, text: &str, ink: Color32, wraps: bool) {
    let builder = UiBuilder::new().scope_id(Id::unique("said"));
    let said = ui.scope_builder(builder, |ui| {
        let label = egui::Label::new(RichText::new(text).color(ink));
        ui.add(if wraps { label.wrap() } else { label.truncate() })
    });
    ui.ctx().accesskit_node_builder(said.inner.id, |node| {
        node.set_live(egui::accesskit::Live::Polite);
    });
}

/// What the hand can do now.
fn hint(editor: &Editor) -> &'static str {
    match editor.tool {
        Tool::Draw => {
            "Hold the button and draw; or click corner by corner and press Enter. Esc ends."
        }
        Tool::Calibrate => "Click two places on the picture that are a known distance apart.",
        Tool::Select if editor.document().is_undrawn() => {
            "Press D to draw, or take a template from the start page."
        }
        Tool::Select if editor.document().design.curves.is_empty() => {
            "Click a panel on the pattern to set how its mesh is laid flat. Press D to draw."
        }
        Tool::Select if !editor.selection().points.is_empty() => {
            "Drag on the plan to move, in space to lift. Del removes, C makes a corner."
        }
        Tool::Select => "Drag a handle. Double click a curve to add one. Right button for more.",
    }
}
