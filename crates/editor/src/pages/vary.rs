//! Points that move a little so that the sheet bends: what may move and how far, or an angle to
//! reach; before and after; accepted or dropped.

use super::{main_button, window};
use crate::command::Command;
use crate::editor::Editor;
use crate::engine::Varied;
use crate::engine::shown::ShownPanel;
use crate::field::{length_ui, number_ui};
use crate::scene::Act;
use crate::theme::Theme;
use eframe::egui::{self, ProgressBar, RichText, Ui};
use sheetwright::design::Vary;
use sheetwright::math::from_deg;
use sheetwright::vary::Goal;
use sheetwright_files::verdict_word;

/// What is asked for.
#[derive(Clone, Debug)]
pub struct VaryPage {
    held: Vec<String>,
    reach_angle: bool,
    angle_deg: f64,
    limit_mm: f64,
    was_limited: bool,
}

impl Default for VaryPage {
    fn default() -> Self {
        Self {
            held: Vec::new(),
            reach_angle: false,
            angle_deg: 3.0,
            limit_mm: 10.0,
            was_limited: true,
        }
    }
}

/// What the page came to.
#[derive(Clone, Debug, PartialEq)]
pub enum VaryAct {
    /// Points are to move.
    Move(Box<Vary>),
    /// They stay where they were moved, or go back.
    End {
        /// Whether they stay.
        accept: bool,
    },
}

impl VaryPage {
    /// Shows the page: whether it stays open, and what it came to.
    pub fn ui(
        &mut self,
        ctx: &egui::Context,
        editor: &Editor,
        theme: &Theme,
        acts: &mut Vec<Act>,
    ) -> (bool, Option<VaryAct>) {
        let mut out = None;
        let stays = window(ctx, "Make it bend", 430.0, |ui| {
            if let Some(outcome) = editor.varied() {
                match outcome {
                    Ok(varied) => out = outcome_ui(ui, theme, varied),
                    Err(refusal) => {
                        ui.label(RichText::new(&refusal.message).color(theme.verdicts[2]));
                        ui.label(&refusal.hint);
                        if ui.button("Back").clicked() {
                            out = Some(VaryAct::End { accept: false });
                        }
                    }
                }
                return;
            }
            self.ask_ui(ui, editor, theme, &mut out);
            if let Some(work) = editor.work() {
                ui.horizontal(|ui| {
                    ui.add(ProgressBar::new(work.done as f32).desired_width(260.0).text(work.text));
                    if ui.button("Stop").clicked() {
                        acts.push(Act::Run(Command::Stop));
                    }
                });
            }
        });
        (stays, out)
    }

    fn ask_ui(&mut self, ui: &mut Ui, editor: &Editor, theme: &Theme, out: &mut Option<VaryAct>) {
        let document = editor.document();
        ui.label("Points may move a little so that the sheet twists less.");
        ui.add_space(6.0);
        ui.radio_value(&mut self.reach_angle, false, "As little twist as these limits allow");
        ui.radio_value(
            &mut self.reach_angle,
            true,
            "Reach an angle, and move no more than that takes",
        );
        if self.reach_angle
            && let Some(deg) = number_ui(ui, theme, "Largest twist (°)", self.angle_deg, 0.1..=90.0)
        {
            self.angle_deg = deg;
        }
        ui.checkbox(&mut self.was_limited, "Nothing moves farther than");
        if self.was_limited {
            let units = document.drawing.units;
            if let Some(mm) = length_ui(ui, theme, "Distance", self.limit_mm, units)
                && mm >= 0.0
            {
                self.limit_mm = mm;
            }
        }
        ui.add_space(6.0);
        ui.label("Curves that may move:");
        egui::ScrollArea::vertical().max_height(180.0).show(ui, |ui| {
            for curve in &document.design.curves {
                let mut may_move = !self.held.contains(&curve.name);
                if ui.checkbox(&mut may_move, &curve.name).changed() {
                    self.held.retain(|name| *name != curve.name);
                    if !may_move {
                        self.held.push(curve.name.clone());
                    }
                }
            }
        });
        let is_free = |name: &&str| !self.held.iter().any(|held| held == name);
        let names = document.design.curves.iter().map(|curve| curve.name.as_str());
        let curves: Vec<String> = names.filter(is_free).map(str::to_owned).collect();
        ui.add_space(8.0);
        let can = !curves.is_empty() && editor.work().is_none();
        ui.add_enabled_ui(can, |ui| {
            if main_button(ui, theme, "Try it").clicked() {
                let goal = if self.reach_angle {
                    Goal::Warp { largest: from_deg(self.angle_deg) }
                } else {
                    Goal::Price
                };
                let limit_mm = self.was_limited.then_some(self.limit_mm);
                *out = Some(VaryAct::Move(Box::new(Vary {
                    curves,
                    goal,
                    limit_mm,
                    ..Vary::default()
                })));
            }
        });
    }
}

fn outcome_ui(ui: &mut Ui, theme: &Theme, varied: &Varied) -> Option<VaryAct> {
    ui.label(&varied.text);
    ui.add_space(6.0);
    egui::Grid::new("varied").num_columns(3).striped(true).show(ui, |ui| {
        for title in ["Panel", "Before", "After"] {
            ui.label(RichText::new(title).strong());
        }
        ui.end_row();
        for (before, after) in varied.before.iter().zip(&varied.after) {
            ui.label(&after.name);
            for panel in [before, after] {
                said_ui(ui, theme, panel);
            }
            ui.end_row();
        }
    });
    ui.add_space(8.0);
    let mut out = None;
    ui.horizontal(|ui| {
        if varied.moved.is_some() && main_button(ui, theme, "Accept").clicked() {
            out = Some(VaryAct::End { accept: true });
        }
        if ui.button("Drop").clicked() {
            out = Some(VaryAct::End { accept: false });
        }
    });
    out
}

fn said_ui(ui: &mut Ui, theme: &Theme, panel: &ShownPanel) {
    match &panel.made {
        Ok(shown) => {
            let text = format!("{}, {:.1}°", verdict_word(shown.verdict), shown.warp_max_deg);
            ui.label(RichText::new(text).color(theme.verdict(shown.verdict)));
        }
        Err(refusal) => {
            ui.label(RichText::new(&refusal.message).color(theme.verdicts[2]));
        }
    }
}
