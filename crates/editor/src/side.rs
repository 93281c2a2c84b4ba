//! The bar at the side: the verdict in words, and typed values for what is selected.

use crate::command::Command;
use crate::document::{Document, Drawing, Mirror, Plan};
use crate::editor::Editor;
use crate::engine::shown::{Shown, ShownPanel, ShownRung};
use crate::field::{length_ui, name_ui, number_ui};
use crate::scene::{Act, Edit, PointRef, Selection, curves_of};
use crate::theme::Theme;
use eframe::egui::{self, ComboBox, Frame, Margin, RichText, Ui};
use sheetwright::boundary::PlaneChoice;
use sheetwright::check::{Finding, Severity, Verdict};
use sheetwright::design::{DesignPanel, PanelShape};
use sheetwright::material::MATERIALS;
use sheetwright::math::Point2;
use sheetwright_files::{Units, length_text, verdict_sentence, verdict_word};

/// Findings that are shown at once.
const FINDINGS: usize = 3;

/// The whole bar.
pub(crate) fn side_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    egui::ScrollArea::vertical().auto_shrink([false; 2]).show(ui, |ui| {
        verdicts_ui(ui, editor, theme, acts);
        selected_ui(ui, editor, theme, acts);
        panel_ui(ui, editor, theme, acts);
        drawing_ui(ui, editor, theme, acts);
    });
}

fn section(ui: &mut Ui, title: &str, content: impl FnOnce(&mut Ui)) {
    ui.add_space(6.0);
    egui::CollapsingHeader::new(RichText::new(title).strong()).default_open(true).show(ui, content);
}

/// Will it bend? One card a panel.
fn verdicts_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    ui.add_space(4.0);
    ui.heading("Will it bend?");
    if editor.shown().is_empty() {
        let text = if editor.document().design.curves.is_empty() {
            "Nothing is drawn yet."
        } else if editor.document().design.panels.is_empty() {
            "No outline is closed yet. Join the ends of a curve to close it."
        } else {
            "Working it out…"
        };
        ui.label(RichText::new(text).color(theme.faint));
    }
    for (n, panel) in editor.shown().iter().enumerate() {
        card_ui(ui, editor, theme, n, panel, acts);
    }
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
    frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        match &panel.made {
            Ok(shown) => made_ui(ui, editor, theme, n, panel, shown, acts),
            Err(refusal) => {
                ui.label(RichText::new(&panel.name).strong());
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
    ui.horizontal(|ui| {
        let name = egui::Button::selectable(editor.selection().panel == Some(n), &panel.name);
        if ui.add(name).on_hover_text("Select this panel.").clicked() {
            acts.push(Act::Select(Selection { panel: Some(n), ..Selection::default() }));
        }
    });
    let word = RichText::new(format!("{} {}", sign(shown.verdict), verdict_word(shown.verdict)))
        .color(theme.verdict(shown.verdict))
        .size(18.0)
        .strong();
    ui.label(word);
    ui.label(verdict_sentence(shown.verdict));
    let size = shown.piece.size;
    let size =
        format!("{} × {}", length_text(round(size.x), units), length_text(round(size.y), units));
    ui.label(RichText::new(format!("Pattern: {size}")).color(theme.faint));
    if let Some(worst) = shown.worst_rung() {
        let twist = format!(
            "Largest twist {:.1}°, the sheet takes {}°",
            shown.rungs[worst].warp_deg, shown.warp_limit_deg
        );
        let hint = twist_hint(&shown.rungs[worst], shown.warp_max_deg);
        let link = ui.link(twist).on_hover_text(hint);
        if link.clicked() {
            acts.push(Act::Select(Selection::of_rung(n, worst)));
        }
    }
    if shown.bend_radius_min_mm.is_finite() {
        let radius = length_text(round(shown.bend_radius_min_mm), units);
        ui.label(RichText::new(format!("Tightest bend {radius} radius")).color(theme.faint));
    }
    let (first, rest) = shown.findings.split_at(shown.findings.len().min(FINDINGS));
    first.iter().for_each(|finding| finding_ui(ui, theme, finding));
    if !rest.is_empty() {
        let title = format!("{} more", rest.len());
        egui::CollapsingHeader::new(title).id_salt(("more", n)).show(ui, |ui| {
            rest.iter().for_each(|finding| finding_ui(ui, theme, finding));
        });
    }
}

/// What is said of the largest twist, that at `worst`: reports count what the sampling explains too, and
/// may name a larger one.
fn twist_hint(worst: &ShownRung, largest_deg: f64) -> String {
    let shown = format!("{:.1}", worst.warp_deg);
    let largest = format!("{largest_deg:.1}");
    if worst.is_unsure {
        "Show where it is. It may come from samples that are far apart.".into()
    } else if largest == shown {
        "Show where it is.".into()
    } else {
        format!(
            "Show where it is. The {largest}° that the report has may come from samples that are far \
             apart."
        )
    }
}

fn finding_ui(ui: &mut Ui, theme: &Theme, finding: &Finding) {
    let (sign, ink) = match finding.severity {
        Severity::Error => ("■", theme.verdicts[2]),
        Severity::Warning => ("▲", theme.verdicts[1]),
        Severity::Note => ("•", theme.faint),
    };
    ui.horizontal_top(|ui| {
        ui.label(RichText::new(sign).color(ink));
        let place =
            if finding.place.is_empty() { String::new() } else { format!(" ({})", finding.place) };
        ui.add(egui::Label::new(format!("{}{place}", finding.text)).wrap());
    });
}

fn sign(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Bends | Verdict::BendsAndFolds => "●",
        Verdict::BendsWithForce => "▲",
        Verdict::Undecided => "?",
        Verdict::WillNotBend => "■",
    }
}

/// Tenths of a millimetre are enough for a look.
fn round(mm: f64) -> f64 {
    (mm * 10.0).round() / 10.0
}

fn selected_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    let document = editor.document();
    let selection = editor.selection();
    match selection.points[..] {
        [] => {}
        [point] => section(ui, "Handle", |ui| point_ui(ui, document, theme, point, acts)),
        [..] => section(ui, "Handles", |ui| {
            ui.label(format!("{} are selected.", selection.points.len()));
            lift_all_ui(ui, document, theme, &selection.points, acts);
        }),
    }
    if let Some(n) = selection.curve.filter(|&n| n < document.design.curves.len()) {
        section(ui, "Curve", |ui| curve_ui(ui, editor, theme, n, acts));
    }
    if let (Some(panel), Some(rung)) = (selection.panel, selection.rung)
        && let Some(Ok(shown)) = editor.shown().get(panel).map(|panel| &panel.made)
        && let Some(at) = shown.rungs.get(rung)
    {
        section(ui, "Rung", |ui| {
            ui.label(format!("Rung {} of {}", rung + 1, shown.rungs.len()));
            ui.label(format!("Twist {:.2}° of {}°", at.warp_deg, shown.warp_limit_deg));
            if at.is_unsure {
                let text = "With so few samples this may be bending alone.";
                ui.label(RichText::new(text).color(theme.faint));
            }
            ui.label(format!("Bend {:.2}°", at.crease_deg));
        });
    }
}

/// The names of the axes of the plan, and of the one across it.
fn axes(plan: Plan) -> [&'static str; 3] {
    match plan {
        Plan::Top => ["x", "y", "Lift (z)"],
        Plan::Front => ["x", "z", "Lift (−y)"],
        Plan::Side => ["y", "z", "Lift (x)"],
    }
}

fn point_ui(ui: &mut Ui, document: &Document, theme: &Theme, at: PointRef, acts: &mut Vec<Act>) {
    let Some(curve) = document.design.curves.get(at.curve) else { return };
    let Some(point) = curve.points.get(at.point) else { return };
    let Drawing { plan, units, .. } = document.drawing;
    ui.label(RichText::new(format!("{}, point {}", curve.name, at.point + 1)).color(theme.faint));
    let flat = plan.flat(point.at);
    let names = axes(plan);
    let mut to = (flat, plan.lift(point.at));
    let mut is_changed = false;
    for (name, value) in names.iter().zip([&mut to.0.x, &mut to.0.y, &mut to.1]) {
        if let Some(mm) = length_ui(ui, theme, name, *value, units) {
            *value = mm;
            is_changed = true;
        }
    }
    if is_changed {
        acts.push(Act::Move(vec![(at, plan.space(to.0, to.1))]));
        acts.push(Act::Rest);
    }
    let mut is_corner = point.corner;
    if ui.checkbox(&mut is_corner, "Corner").changed() {
        acts.push(Act::Run(Command::ToggleCorner));
    }
}

/// One lift for all that are selected.
fn lift_all_ui(
    ui: &mut Ui,
    document: &Document,
    theme: &Theme,
    points: &[PointRef],
    acts: &mut Vec<Act>,
) {
    let Drawing { plan, units, .. } = document.drawing;
    let place = |r: &PointRef| Some(document.design.curves.get(r.curve)?.points.get(r.point)?.at);
    let Some(first) = points.first().and_then(place) else { return };
    if let Some(mm) = length_ui(ui, theme, axes(plan)[2], plan.lift(first), units) {
        let moved = points.iter().filter_map(|r| Some((*r, plan.space(plan.flat(place(r)?), mm))));
        acts.push(Act::Move(moved.collect()));
        acts.push(Act::Rest);
    }
}

fn curve_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, n: usize, acts: &mut Vec<Act>) {
    let design = &editor.document().design;
    let curve = &design.curves[n];
    if let Some(name) = name_ui(ui, theme, "Name of curve", &curve.name) {
        acts.push(Act::Edit(Edit::RenameCurve { curve: n, name }));
    }
    let state = if curve.closed { "closed" } else { "open" };
    ui.label(RichText::new(format!("{} points, {state}", curve.points.len())).color(theme.faint));
    let uses = |panel: &&DesignPanel| curves_of(panel).iter().any(|u| u.name == curve.name);
    let of: Vec<&str> = design.panels.iter().filter(uses).map(|p| p.name.as_str()).collect();
    let text = if of.is_empty() {
        "It bounds no panel yet: close it.".to_owned()
    } else {
        format!("It bounds {}.", of.join(", "))
    };
    ui.label(RichText::new(text).color(theme.faint));
    ui.horizontal_wrapped(|ui| {
        for command in [Command::Join, Command::Reverse, Command::Delete] {
            crate::bars::command_button(ui, editor, command, command.name(), acts);
        }
    });
}

/// The panel that is selected, or the only one; and the sheet.
fn panel_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    let design = &editor.document().design;
    section(ui, "Sheet", |ui| {
        let named = design.material.map_or("Not named", |material| material.title);
        ComboBox::from_label("Material").selected_text(named).width(150.0).show_ui(ui, |ui| {
            let mut choose = |ui: &mut Ui, is_it: bool, title: &str, name: Option<&str>| {
                if ui.selectable_label(is_it, title).clicked() && !is_it {
                    acts.push(Act::Edit(Edit::SetMaterial(name.map(str::to_owned))));
                }
            };
            choose(ui, design.material.is_none(), "Not named", None);
            for material in &MATERIALS {
                let is_it = design.material.is_some_and(|m| m.name == material.name);
                choose(ui, is_it, material.title, Some(material.name));
            }
        });
    });
    let made: Vec<&str> = design.panels_to_make().iter().map(|p| p.name.as_str()).collect();
    let name = match editor.selection().panel {
        Some(n) => made.get(n),
        None if made.len() == 1 => made.first(),
        None => None,
    };
    let Some(n) = name.and_then(|name| design.panels.iter().position(|p| p.name == *name)) else {
        return;
    };
    let panel = &design.panels[n];
    section(ui, "Panel", |ui| {
        if let Some(name) = name_ui(ui, theme, "Name of panel", &panel.name) {
            acts.push(Act::Edit(Edit::RenamePanel { panel: n, name }));
        }
        let mut to = panel.clone();
        if let Some(samples) = number_ui(ui, theme, "Samples", to.samples as f64, 3.0..=100_000.0) {
            to.samples = samples as usize;
        }
        if let Some(fold) = number_ui(ui, theme, "Fold price", to.fold, 0.0..=10.0) {
            to.fold = fold;
        }
        let mut lies_over = to.plane != PlaneChoice::None;
        let label = "Lies over its plan like a roof";
        if ui.checkbox(&mut lies_over, label).on_hover_text(
            "Rungs stay inside the outline as seen from its best plane. Without it, any two places \
             of the edge may be joined.",
        ).changed() {
            to.plane = if lies_over { PlaneChoice::Auto } else { PlaneChoice::None };
        }
        if matches!(to.shape, PanelShape::Rails(_)) {
            ui.checkbox(&mut to.run_on, "Rails run on beyond the ends");
        }
        if to != *panel {
            acts.push(Act::Edit(Edit::SetPanel { panel: n, to: Box::new(to) }));
        }
    });
}

/// Units, grid, mirror and the picture.
fn drawing_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    let drawing = &editor.document().drawing;
    section(ui, "Drawing", |ui| {
        let mut to = drawing.clone();
        ComboBox::from_label("Units").selected_text(to.units.name()).width(70.0).show_ui(
            ui,
            |ui| {
                for units in Units::ALL {
                    ui.selectable_value(&mut to.units, units, units.name());
                }
            },
        );
        if let Some(mm) = length_ui(ui, theme, "Grid", to.grid_mm, drawing.units)
            && mm > 0.0
        {
            to.grid_mm = mm;
        }
        if let Some(mirror) = drawing.mirror {
            let name = if mirror.upright { "Mirror across" } else { "Mirror up" };
            if let Some(at_mm) = length_ui(ui, theme, name, mirror.at_mm, drawing.units) {
                to.mirror = Some(Mirror { at_mm, ..mirror });
            }
            let mut upright = mirror.upright;
            ui.horizontal(|ui| {
                ui.radio_value(&mut upright, true, "Left and right alike");
                ui.radio_value(&mut upright, false, "Up and down");
            });
            to.mirror = to.mirror.map(|mirror| Mirror { upright, ..mirror });
        }
        if let Some(picture) = &mut to.reference {
            ui.label(RichText::new(format!("Picture: {}", picture.name)).color(theme.faint));
            ui.add(egui::Slider::new(&mut picture.opacity, 0.1..=1.0).text("Opacity"));
            let Point2 { x, y } = picture.centre;
            if let Some(mm) = length_ui(ui, theme, "Middle across", x, drawing.units) {
                picture.centre.x = mm;
            }
            if let Some(mm) = length_ui(ui, theme, "Middle up", y, drawing.units) {
                picture.centre.y = mm;
            }
        }
        if to != *drawing {
            acts.push(Act::Edit(Edit::SetDrawing(Box::new(to))));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert!(
            twist_hint(&rung(0.32, false), 0.8526).contains("The 0.9° that the report has may")
        );
        assert!(twist_hint(&rung(15.0, true), 15.0).contains("It may come from samples"));
    }
}
