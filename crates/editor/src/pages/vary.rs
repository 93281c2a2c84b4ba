//! Points that move a little so that the sheet bends: what may move and how far, or an angle to
//! reach; before and after; accepted or dropped.

use super::{main_button, window};
use crate::command::Command;
use crate::document::FARTHEST_MM;
use crate::editor::Editor;
use crate::engine::Varied;
use crate::engine::shown::{Shown, ShownPanel};
use crate::field::Field;
use crate::panes::words::length;
use crate::scene::Act;
use crate::theme::Theme;
use crate::verdicts::{not_bending, said_of};
use eframe::egui::{self, Id, Label, ProgressBar, RichText, Ui};
use sheetwright::design::Vary;
use sheetwright::design::VaryGoal;
use sheetwright::material::warp_limit_deg;
use sheetwright::math::from_deg;
use sheetwright_files::{Units, verdict_word};
use std::ops::RangeInclusive;

/// Angles that may be reached, degrees.
const ANGLES: RangeInclusive<f64> = 0.1..=90.0;

/// Shares of the strain that the sheet takes that may be reached, per cent.
const PER_CENTS: RangeInclusive<f64> = 5.0..=100.0;
/// The share that is aimed at unless another is typed: the rest is for what a workshop adds.
const USUAL_PER_CENT: f64 = 80.0;

/// What is asked for.
#[derive(Clone, Debug)]
pub struct VaryPage {
    held: Vec<String>,
    aim: Aim,
    /// What was typed; else [`USUAL_PER_CENT`], the twist that the sheet takes, and what is usual
    /// in the units.
    per_cent: Option<f64>,
    angle_deg: Option<f64>,
    limit_mm: Option<f64>,
    was_limited: bool,
}

/// What moving is for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Aim {
    /// No more strain than a share of what the sheet takes.
    #[default]
    Strain,
    /// No more twist than an angle.
    Angle,
    /// As little twist as can be.
    Least,
}

impl Default for VaryPage {
    fn default() -> Self {
        Self {
            held: Vec::new(),
            aim: Aim::default(),
            per_cent: None,
            angle_deg: None,
            limit_mm: None,
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
                    Ok(varied) => {
                        let units = editor.document().drawing.units;
                        out = outcome_ui(ui, theme, varied, units);
                    }
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
            work_ui(ui, editor, acts);
        });
        (stays, out)
    }

    fn ask_ui(&mut self, ui: &mut Ui, editor: &Editor, theme: &Theme, out: &mut Option<VaryAct>) {
        let document = editor.document();
        ui.label("Points may move a little so that the sheet bends.");
        ui.add_space(6.0);
        let aims = [
            (Aim::Strain, "Until the sheet stretches no more than it takes"),
            (Aim::Angle, "Until it twists no more than an angle"),
            (Aim::Least, "As little twist as these limits allow"),
        ];
        for (aim, title) in aims {
            ui.radio_value(&mut self.aim, aim, title);
        }
        let field = |label| Field { theme, of: Id::unique("vary"), label };
        let per_cent = self.per_cent.unwrap_or(USUAL_PER_CENT);
        let angle_deg = self.angle_deg.unwrap_or(warp_limit_deg(document.design.material.as_ref()));
        match self.aim {
            Aim::Strain => {
                let typed = field("Per cent of that").number(ui, per_cent, PER_CENTS);
                self.per_cent = typed.or(self.per_cent);
            }
            Aim::Angle => {
                let typed = field("Largest twist").angle(ui, angle_deg, ANGLES);
                self.angle_deg = typed.or(self.angle_deg);
            }
            Aim::Least => {}
        }
        ui.checkbox(&mut self.was_limited, "Nothing moves farther than");
        let units = document.drawing.units;
        let limit_mm = self.limit_mm.unwrap_or(usual_limit_mm(units));
        if self.was_limited {
            let typed = field("Distance").length(ui, limit_mm, units, 0.0..=FARTHEST_MM);
            self.limit_mm = typed.or(self.limit_mm);
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
        let is_refused = self.aim == Aim::Strain && field("Per cent of that").is_refused(ui)
            || self.aim == Aim::Angle && field("Largest twist").is_refused(ui)
            || self.was_limited && field("Distance").is_refused(ui);
        let can = !curves.is_empty() && editor.work().is_none() && !is_refused;
        ui.add_enabled_ui(can, |ui| {
            if main_button(ui, theme, "Try it").clicked() {
                let goal = match self.aim {
                    Aim::Strain => VaryGoal::Strain { share: 0.01 * per_cent },
                    Aim::Angle => VaryGoal::Warp { largest: from_deg(angle_deg) },
                    Aim::Least => VaryGoal::Price,
                };
                let limit_mm = self.was_limited.then_some(limit_mm);
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

/// How far points may move unless somebody types it, mm: about a centimetre, round in the units.
fn usual_limit_mm(units: Units) -> f64 {
    match units {
        Units::Millimetres | Units::Centimetres | Units::Metres => 10.0,
        Units::Inches => 0.5 * Units::Inches.in_mm(),
        Units::Feet => 0.04 * Units::Feet.in_mm(),
    }
}

/// What is being worked out. It takes as much room whatever it says and before it begins, so that
/// nothing moves under the hand.
fn work_ui(ui: &mut Ui, editor: &Editor, acts: &mut Vec<Act>) {
    let lines = 2.0 * ui.text_style_height(&egui::TextStyle::Body);
    let bar = ui.spacing().interact_size.y;
    ui.scope(|ui| {
        ui.set_min_height(lines + ui.spacing().item_spacing.y + bar);
        let Some(work) = editor.work() else { return };
        ui.scope(|ui| {
            ui.set_min_height(lines);
            ui.add(Label::new(work.text).wrap());
        });
        ui.horizontal(|ui| {
            ui.add(ProgressBar::new(work.done as f32).desired_width(260.0));
            if ui.button("Stop").clicked() {
                acts.push(Act::Run(Command::Stop));
            }
        });
    });
}

/// How it ended, in words. Angles are those of the cards at the side.
fn said(varied: &Varied, units: Units) -> String {
    if varied.moved.is_none() {
        return "Nothing moved: either the sheet bends already, or moving this far does not help."
            .to_owned();
    }
    let twist = |panels: &[ShownPanel]| {
        let made = panels.iter().filter_map(|panel| panel.made.as_ref().ok());
        made.map(Shown::twist).max().unwrap_or_default().deg
    };
    let end = match &not_bending(&varied.after)[..] {
        [] => "Every panel bends now.".to_owned(),
        left => {
            let counted = |&(of, count)| format!("{count} {}", said_of(of, count));
            let left: Vec<String> = left.iter().map(counted).collect();
            format!("Of {} panels, {}.", varied.after.len(), left.join(", "))
        }
    };
    format!(
        "The largest twist goes from {:.1}° to {:.1}°; no sample moves farther than {}. {end}",
        twist(&varied.before),
        twist(&varied.after),
        length(varied.moved_max_mm, units),
    )
}

fn outcome_ui(ui: &mut Ui, theme: &Theme, varied: &Varied, units: Units) -> Option<VaryAct> {
    ui.label(said(varied, units));
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
            let text = format!("{}, {:.1}°", verdict_word(shown.verdict), shown.twist().deg);
            ui.label(RichText::new(text).color(theme.verdict(shown.verdict)));
        }
        Err(refusal) => {
            ui.label(RichText::new(&refusal.message).color(theme.verdicts[2]));
        }
    }
}
