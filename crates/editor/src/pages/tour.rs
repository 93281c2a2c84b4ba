//! The tour: five steps from an outline to a pattern, each done by the person.

use crate::command::Command;
use crate::editor::Editor;
use crate::room::fitting;
use crate::scene::Act;
use crate::theme::Theme;
use eframe::egui::{self, Align2, RichText};

/// A step: its title, what to do, and whether it is done.
struct Step {
    title: &'static str,
    text: &'static str,
    is_done: fn(&Editor) -> bool,
}

const STEPS: [Step; 5] = [
    Step {
        title: "Draw an outline",
        text: "Choose Draw (D). On the plan, hold the button, draw round once and let go. The line \
               becomes a smooth curve with handles on it.",
        is_done: |editor| !editor.document().design.panels.is_empty(),
    },
    Step {
        title: "Lift it",
        text: "In space, drag a handle upwards. It stays over its place on the plan; only its \
               height changes.",
        is_done: |editor| {
            let drawing = &editor.document().drawing;
            let curves = &editor.document().design.curves;
            curves.iter().flat_map(|c| &c.points).any(|p| drawing.plan.lift(p.at) != 0.0)
        },
    },
    Step {
        title: "Will it bend?",
        text: "The answer stands under Will it bend, for the sheet that you choose under Material. The view \
               Twist (4) shows where the sheet resists.",
        is_done: |editor| editor.document().design.material.is_some(),
    },
    Step {
        title: "Make it bend",
        text: "If it twists too much, choose Make it bend (V): handles move a little, and you accept \
               it or drop it. If it bends already, go on.",
        is_done: |editor| {
            let shown = editor.shown();
            let bends = |p: &crate::engine::shown::ShownPanel| {
                p.made.as_ref().is_ok_and(|s| s.warp_max_deg <= s.warp_limit_deg)
            };
            !shown.is_empty() && shown.iter().all(bends)
        },
    },
    Step {
        title: "Cut the pattern",
        text: "Choose Export. SVG and DXF are for machines, the PDF is to print true to scale and \
               tape together.",
        is_done: |_| false,
    },
];

/// Where the tour is.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tour {
    at: usize,
}

impl Tour {
    /// Shows the step; whether the tour goes on.
    pub fn ui(
        &mut self,
        ctx: &egui::Context,
        editor: &Editor,
        theme: &Theme,
        acts: &mut Vec<Act>,
    ) -> bool {
        let mut goes_on = true;
        let step = &STEPS[self.at.min(STEPS.len() - 1)];
        let title = format!("{} of {}: {}", self.at + 1, STEPS.len(), step.title);
        egui::Window::new("Tour")
            .title_bar(false)
            .resizable(false)
            .anchor(Align2::LEFT_BOTTOM, egui::vec2(24.0, -48.0))
            .show(ctx, |ui| {
                ui.set_width(fitting(340.0, ctx.content_rect().width() - 80.0));
                ui.label(RichText::new(title).strong().size(16.0));
                ui.label(step.text);
                if (step.is_done)(editor) {
                    ui.label(RichText::new("● Done").color(theme.verdicts[0]).strong());
                }
                ui.horizontal(|ui| {
                    if ui.add_enabled(self.at > 0, egui::Button::new("Back")).clicked() {
                        self.at -= 1;
                    }
                    if self.at + 1 < STEPS.len() {
                        if ui.button("Next").clicked() {
                            self.at += 1;
                        }
                    } else if ui.button("Export…").clicked() {
                        acts.push(Act::Run(Command::Export));
                        goes_on = false;
                    }
                    if ui.button("End the tour").clicked() {
                        goes_on = false;
                    }
                });
            });
        if !goes_on {
            self.at = 0;
        }
        goes_on
    }
}
