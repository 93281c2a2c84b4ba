//! Will it bend? A line that counts, always at the top of the bar, and a card a panel, the worst
//! first.

use crate::document::Selection;
use crate::document::edit::why_no_panel;
use crate::editor::Editor;
use crate::engine::shown::{Shown, ShownPanel, ShownRung};
use crate::panes::words::{length, radius};
use crate::scene::Act;
use crate::theme::Theme;
use eframe::egui::{self, Align, Button, Color32, Frame, Layout, Margin, RichText, Ui, vec2};
use sheetwright::check::{Finding, FindingKind, Place, Severity, Verdict};
use sheetwright_files::{finding_place, finding_text, verdict_sentence, verdict_word};

/// Findings that are shown at once.
const FINDINGS: usize = 3;
/// Of more panels than this, those that bend are shown in a line each.
const WHOLE_CARDS: usize = 3;
/// How high the line that counts is, points: the same whatever it says, so that nothing below it
/// moves.
const BANNER: f32 = 34.0;

/// How many panels are not fine, in a line. A click brings the worst place into sight.
pub(crate) fn banner_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    let (text, ink) = match counted(editor.shown()) {
        Some((text, panel)) => (text, ink(theme, panel)),
        None => (waiting(editor).to_owned(), theme.faint),
    };
    let worst = editor.worst_place();
    let text = RichText::new(text).color(ink).strong().size(15.0);
    let button = Button::new(text).fill(theme.paper).wrap_mode(egui::TextWrapMode::Truncate);
    let room = vec2(ui.available_width(), BANNER);
    let placed =
        Layout::left_to_right(Align::Center).with_cross_justify(true).with_main_justify(true);
    ui.allocate_ui_with_layout(room, placed, |ui| {
        let response = ui.add_enabled(worst.is_some(), button);
        let response = response.on_hover_text("Show the worst place.");
        if let Some(worst) = worst.filter(|_| response.clicked()) {
            acts.push(Act::Show(worst));
        }
    });
}

/// Why there is no verdict.
fn waiting(editor: &Editor) -> &'static str {
    let design = &editor.document().design;
    if editor.document().is_undrawn() {
        "Nothing is drawn yet"
    } else if design.panels.is_empty() {
        "No outline bounds a panel yet"
    } else {
        "Working it out…"
    }
}

/// How many panels are as bad as the worst, and how many else are not known to bend, in words; and
/// one of the worst. `None` without panels.
fn counted(panels: &[ShownPanel]) -> Option<(String, &ShownPanel)> {
    let worst = panels.iter().max_by_key(|panel| panel.badness())?;
    let count = panels.iter().filter(|panel| panel.badness() == worst.badness()).count();
    let all = panels.len();
    let verdict = verdict_of(worst);
    let sign = verdict.map_or("▲", sign);
    let text = match (all, count) {
        (1, _) => format!("{sign} The panel {}", said_of(verdict, 1)),
        (_, _) if all == count => format!("{sign} All {all} panels {}", said_of(verdict, all)),
        _ => format!("{sign} {count} of {all} panels {}", said_of(verdict, count)),
    };
    let others = not_bending(panels).into_iter().filter(|&(of, _)| of != verdict);
    let others = others.map(|(of, count)| format!(", {count} {}", said_of(of, count)));
    Some((text + &others.collect::<String>(), worst))
}

fn verdict_of(panel: &ShownPanel) -> Option<Verdict> {
    panel.made.as_ref().ok().map(|shown| shown.verdict)
}

/// The verdicts of panels that are not known to bend, the worst first, and how many have each;
/// `None` is of those that can't be made.
pub(crate) fn not_bending(panels: &[ShownPanel]) -> Vec<(Option<Verdict>, usize)> {
    let count = |of| (of, panels.iter().filter(|panel| verdict_of(panel) == of).count());
    let classes = [None, Some(Verdict::WillNotBend), Some(Verdict::Undecided)].map(count);
    classes.into_iter().filter(|&(_, count)| count > 0).collect()
}

/// What a line says of so many panels with a verdict; `None` is of those that can't be made.
pub(crate) fn said_of(verdict: Option<Verdict>, count: usize) -> &'static str {
    let (one, more) = match verdict {
        None => ("can't be made yet", "can't be made yet"),
        Some(Verdict::WillNotBend) => ("will not bend", "will not bend"),
        Some(Verdict::Undecided) => ("is undecided", "are undecided"),
        Some(Verdict::BendsWithForce) => ("bends with force", "bend with force"),
        Some(Verdict::Roll) => ("must be rolled", "must be rolled"),
        Some(Verdict::BendsAndFolds) => ("bends and folds", "bend and fold"),
        Some(Verdict::Bends) => ("bends", "bend"),
    };
    if count == 1 { one } else { more }
}

fn ink(theme: &Theme, panel: &ShownPanel) -> Color32 {
    panel.made.as_ref().map_or(theme.verdicts[1], |shown| theme.verdict(shown.verdict))
}

/// Will it bend? One card a panel.
pub(crate) fn verdicts_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    ui.add_space(4.0);
    ui.heading("Will it bend?");
    if editor.shown().is_empty() && !editor.document().is_undrawn() {
        let text = match editor.document().design.panels.is_empty() {
            true => why_no_panel(editor.document()),
            false => "Working it out…".to_owned(),
        };
        ui.label(RichText::new(text).color(theme.faint));
    }
    egui::ScrollArea::vertical().auto_shrink([false; 2]).show(ui, |ui| {
        for n in editor.worst_first() {
            card_ui(ui, editor, theme, n, &editor.shown()[n], acts);
        }
    });
}

fn card_ui(
    ui: &mut Ui,
    editor: &Editor,
    theme: &Theme,
    n: usize,
    panel: &ShownPanel,
    acts: &mut Vec<Act>,
) {
    let is_selected = editor.selection().panel == Some(n);
    let line = if is_selected { theme.accent } else { theme.line };
    let frame = Frame::new()
        .fill(theme.paper)
        .stroke(egui::Stroke::new(if is_selected { 1.5 } else { 1.0 }, line))
        .corner_radius(6)
        .inner_margin(Margin::same(10));
    let is_short = editor.shown().len() > WHOLE_CARDS && !is_selected;
    frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        match &panel.made {
            Ok(shown) if is_short && shown.verdict == Verdict::Bends => {
                ui.horizontal_wrapped(|ui| {
                    name_ui(ui, editor, n, panel, acts);
                    ui.label(verdict_text(theme, shown.verdict));
                });
            }
            Ok(shown) => made_ui(ui, editor, theme, n, panel, shown, acts),
            Err(refusal) => {
                ui.horizontal(|ui| name_ui(ui, editor, n, panel, acts));
                ui.label(RichText::new("Can't be made yet").color(theme.verdicts[1]).strong());
                ui.label(&refusal.message);
                ui.label(RichText::new(&refusal.hint).color(theme.faint));
            }
        }
    });
}

fn made_ui(
    ui: &mut Ui,
    editor: &Editor,
    theme: &Theme,
    n: usize,
    panel: &ShownPanel,
    shown: &Shown,
    acts: &mut Vec<Act>,
) {
    let units = editor.document().drawing.units;
    ui.horizontal(|ui| name_ui(ui, editor, n, panel, acts));
    ui.label(verdict_text(theme, shown.verdict).size(18.0));
    ui.label(verdict_sentence(shown.verdict, shown.is_mesh));
    let size = shown.piece.size;
    let size = format!("Pattern: {} × {}", length(size.x, units), length(size.y, units));
    ui.label(RichText::new(size).color(theme.faint));
    if let Some(worst) = shown.worst_rung() {
        let twist = format!(
            "Largest twist {:.1}° (thick plate takes {}°)",
            shown.rungs[worst].warp_deg, shown.warp_limit_deg
        );
        let hint = twist_hint(&shown.rungs[worst], shown.warp_max_deg);
        let link = ui.link(twist).on_hover_text(hint);
        if link.clicked() {
            acts.push(Act::Show(Selection::of_rung(n, worst)));
        }
    }
    if shown.bend_radius_min_mm.is_finite() {
        let text = format!("Tightest bend {} radius", radius(shown.bend_radius_min_mm, units));
        ui.label(RichText::new(text).color(theme.faint));
    }
    let (first, rest) = first_findings(&shown.findings);
    first.into_iter().for_each(|finding| finding_ui(ui, theme, n, finding, acts));
    if !rest.is_empty() {
        let title = format!("{} more", rest.len());
        egui::CollapsingHeader::new(title).id_salt(("more", n)).show(ui, |ui| {
            rest.into_iter().for_each(|finding| finding_ui(ui, theme, n, finding, acts));
        });
    }
}

/// The findings that are shown at once, and the others: whether dividing helps answers the verdict
/// and comes late, so it is always shown.
fn first_findings(findings: &[Finding]) -> (Vec<&Finding>, Vec<&Finding>) {
    let mut number = 0;
    findings.iter().partition(|finding| {
        number += 1;
        let kind = &finding.kind;
        number <= FINDINGS
            || matches!(kind, FindingKind::BendsDivided { .. } | FindingKind::DividedInVain { .. })
    })
}

fn name_ui(ui: &mut Ui, editor: &Editor, n: usize, panel: &ShownPanel, acts: &mut Vec<Act>) {
    let name = Button::selectable(editor.selection().panel == Some(n), &panel.name);
    if ui.add(name).on_hover_text("Select this panel.").clicked() {
        acts.push(Act::Select(Selection { panel: Some(n), ..Selection::default() }));
    }
}

/// A verdict with its sign: `● Bends`.
fn verdict_text(theme: &Theme, verdict: Verdict) -> RichText {
    let text = format!("{} {}", sign(verdict), verdict_word(verdict));
    RichText::new(text).color(theme.verdict(verdict)).strong()
}

/// What is said of the largest twist, that at `worst`: reports count what the sampling explains
/// too, and may name a larger one.
fn twist_hint(worst: &ShownRung, largest_deg: f64) -> String {
    let shown = format!("{:.1}", worst.warp_deg);
    let largest = format!("{largest_deg:.1}");
    if worst.is_unsure {
        "Show where it is. It may come from samples that are far apart.".into()
    } else if largest == shown {
        "Show where it is.".into()
    } else {
        format!(
            "Show where it is. The report has {largest}°, which may come from samples that are far \
             apart."
        )
    }
}

/// A finding on the panel of this number. Where it has a place, a click brings that into sight.
fn finding_ui(ui: &mut Ui, theme: &Theme, n: usize, finding: &Finding, acts: &mut Vec<Act>) {
    let (sign, ink) = match finding.severity() {
        Severity::Error => ("■", theme.verdicts[2]),
        Severity::Warning => ("▲", theme.verdicts[1]),
        Severity::Note => ("•", theme.faint),
    };
    ui.horizontal_top(|ui| {
        ui.label(RichText::new(sign).color(ink));
        let text = finding_text(finding);
        if finding.place == Place::Whole {
            ui.add(egui::Label::new(text).wrap());
            return;
        }
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Wrap);
        let text = format!("{text} ({})", finding_place(finding));
        let link = egui::Link::new(RichText::new(text).color(ui.visuals().text_color()));
        if ui.add(link).on_hover_text("Show where it is.").clicked() {
            acts.push(Act::Show(Selection::of_place(n, finding.place.clone())));
        }
    });
}

fn sign(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Bends | Verdict::Roll | Verdict::BendsAndFolds => "●",
        Verdict::BendsWithForce => "▲",
        Verdict::Undecided => "?",
        Verdict::WillNotBend => "■",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_counts_the_worst() {
        let refusal = crate::engine::Refusal { message: String::new(), hint: String::new() };
        let panel = |name: &str| ShownPanel {
            name: name.into(),
            panel: name.into(),
            made: Err(refusal.clone()),
        };
        let panels = [panel("a"), panel("b")];
        let (text, worst) = counted(&panels[..1]).unwrap();
        assert_eq!((&text[..], &worst.name[..]), ("▲ The panel can't be made yet", "a"));
        assert_eq!(counted(&panels).unwrap().0, "▲ All 2 panels can't be made yet");
        assert_eq!(counted(&[]), None);
    }

    #[test]
    fn a_larger_twist_in_the_report_is_explained() {
        let rung = |warp_deg: f64, is_unsure: bool| ShownRung {
            ends: [0, 2],
            flat_ends: [0, 2],
            warp_deg,
            is_unsure,
            crease_deg: 0.0,
            normals: Default::default(),
        };
        assert_eq!(twist_hint(&rung(9.07, false), 9.07), "Show where it is.");
        assert!(twist_hint(&rung(0.32, false), 0.8526).contains("The report has 0.9°, which may"));
        assert!(twist_hint(&rung(15.0, true), 15.0).contains("It may come from samples"));
    }
}
