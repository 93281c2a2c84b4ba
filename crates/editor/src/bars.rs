//! The bar at the top with the commands that people look for, and the line at the bottom.

use crate::command::Command;
use crate::editor::Editor;
use crate::panes::SurfaceView;
use crate::panes::plan::Tool;
use crate::panes::space::navigation::Navigation;
use crate::scene::Act;
use crate::theme::{Look, Theme};
use eframe::egui::{self, Button, Layout, ProgressBar, RichText, Ui};

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
    let key = command.key().map(|key| ui.ctx().format_shortcut(&key));
    let key = key.map_or(String::new(), |key| format!("  ({key})"));
    let response = response
        .on_hover_text(format!("{}{key}", command.tooltip()))
        .on_disabled_hover_text(format!("{}\n{}", command.tooltip(), why_not.unwrap_or_default()));
    if response.clicked() {
        acts.push(Act::Run(command));
    }
    response
}

/// A line of a menu.
fn menu_line(ui: &mut Ui, editor: &Editor, command: Command, acts: &mut Vec<Act>) {
    let why_not = editor.why_not(command);
    let key = command.key().map_or(String::new(), |key| ui.ctx().format_shortcut(&key));
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

fn menu(ui: &mut Ui, editor: &Editor, name: &str, lines: &[&[Command]], acts: &mut Vec<Act>) {
    ui.menu_button(name, |ui| {
        ui.set_min_width(220.0);
        for (n, group) in lines.iter().enumerate() {
            if n > 0 {
                ui.separator();
            }
            for &command in *group {
                menu_line(ui, editor, command, acts);
            }
        }
    });
}

/// The bar at the top.
pub(crate) fn top_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    use Command as C;
    ui.horizontal(|ui| {
        menu(
            ui,
            editor,
            "File",
            &[&[C::Start, C::New, C::Open], &[C::Save, C::SaveAs], &[C::Export]],
            acts,
        );
        menu(
            ui,
            editor,
            "Edit",
            &[
                &[C::Undo, C::Redo],
                &[C::Draw, C::AddRectangle, C::AddCircle],
                &[C::SelectAll, C::Delete],
                &[C::ToggleCorner, C::ToggleStraight, C::Join, C::Reverse],
                &[C::ToggleMirror, C::ToggleGrid],
                &[C::AddReference, C::CalibrateReference, C::RemoveReference],
            ],
            acts,
        );
        let views = SurfaceView::ALL.map(C::View);
        let plans = crate::document::Plan::ALL.map(C::PlanOf);
        let navigations = Navigation::ALL.map(C::Navigate);
        let looks = Look::ALL.map(C::Look);
        menu(
            ui,
            editor,
            "View",
            &[
                &views,
                &plans,
                &[C::Fit, C::ToggleOrthographic, C::WorstRung],
                &navigations,
                &[C::ZoomIn, C::ZoomOut, C::ZoomReset],
                &looks,
            ],
            acts,
        );
        menu(ui, editor, "Help", &[&[C::Tour, C::Palette, C::Keys]], acts);
        ui.separator();
        for command in [C::Select, C::Draw] {
            command_button(ui, editor, command, command.name(), acts);
        }
        ui.separator();
        command_button(ui, editor, C::Undo, "Undo", acts);
        command_button(ui, editor, C::Redo, "Redo", acts);
        ui.separator();
        for command in [C::ToggleMirror, C::ToggleGrid, C::Fit] {
            command_button(ui, editor, command, command.name(), acts);
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
            command_button(ui, editor, C::Vary, "Make it bend…", acts);
            command_button(ui, editor, C::Palette, "Find…", acts);
        });
    });
}

/// The line at the bottom: what to do, what is being done, what was said.
pub(crate) fn bottom_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    ui.horizontal(|ui| {
        let (text, ink) = match &editor.notice {
            Some(notice) if notice.is_refusal => (notice.text.clone(), theme.verdicts[2]),
            Some(notice) => (notice.text.clone(), theme.ink),
            None => (hint(editor).to_owned(), theme.faint),
        };
        let said = ui.add(egui::Label::new(RichText::new(text).color(ink)).truncate());
        ui.ctx().accesskit_node_builder(said.id, |node| {
            node.set_live(egui::accesskit::Live::Polite);
        });
        ui.with_layout(Layout::right_to_left(egui::Align::Center), |ui| {
            let saved = match (editor.file(), editor.is_unsaved()) {
                (Some(file), false) => file.to_owned(),
                (Some(file), true) => format!("{file} · not saved yet"),
                (None, _) => editor.document().design.name.clone(),
            };
            ui.label(RichText::new(saved).color(theme.faint));
            if let Some(work) = editor.work() {
                command_button(ui, editor, Command::Stop, "Stop", acts);
                ui.add(ProgressBar::new(work.done as f32).desired_width(120.0));
                ui.label(work.text);
            }
        });
    });
}

/// What the hand can do now.
fn hint(editor: &Editor) -> &'static str {
    match editor.tool {
        Tool::Draw => {
            "Hold the button and draw; or click corner by corner and press Enter. Esc ends."
        }
        Tool::Calibrate => "Click two places on the picture that are a known distance apart.",
        Tool::Select if editor.document().design.curves.is_empty() => {
            "Press D to draw, or take a template from the start page."
        }
        Tool::Select if !editor.selection().points.is_empty() => {
            "Drag on the left to move, on the right to lift. Del removes, C makes a corner."
        }
        Tool::Select => "Drag a handle. Double click a curve to add one. Right button for more.",
    }
}
