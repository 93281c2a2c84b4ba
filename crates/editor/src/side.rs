//! Typed values for what is selected, the sheet, the panel and the drawing.
//!
//! What is selected stands at the top, and the verdict, which grows, in a part of its own below: a
//! field stays where it is while somebody types into it. Each field belongs to the thing by its
//! name, so that what is typed never lands in another.

mod mesh;
mod sheets;
mod trims;

use crate::command::Command;
use crate::document::edit::{allowance_mm, why_unbound};
use crate::document::{Document, Drawing, FARTHEST_MM, Mirror, Plan};
use crate::document::{Edit, PointRef, curves_of};
use crate::editor::Editor;
use crate::engine::shown::ShownPanel;
use crate::field::Field;
use crate::panes::words::decimal;
use crate::scene::Act;
use crate::theme::Theme;
use eframe::egui::{self, ComboBox, Id, RichText, Ui};
use mesh::{mesh_ui, size_ui};
use sheets::sheets_ui;
use sheetwright::boundary::PlaneChoice;
use sheetwright::design::{Design, DesignPanel, Dimensions, PanelShape, SampleTolerance};
use sheetwright::math::Point2;
use sheetwright::triangulate::WhichSurface;
use sheetwright_files::{
    MOST_TOLERANCE_MM, OutputOptions, Preset, Units, known_materials, material_group, trade_names,
    trade_title,
};
use std::ops::RangeInclusive;
use trims::trims_ui;

/// Where things may lie, mm.
const PLACES: RangeInclusive<f64> = -FARTHEST_MM..=FARTHEST_MM;
/// How wide an allowance may be, mm.
const ALLOWANCES: RangeInclusive<f64> = 0.0..=1000.0;
/// How thick a sheet may be, mm; 0 where it is as its material.
const THICKNESSES: RangeInclusive<f64> = 0.0..=1000.0;
/// The inner radius of a tool that folds, mm; 0 takes that of the material.
const BEND_RADII: RangeInclusive<f64> = 0.0..=10_000.0;
/// How near outlines may be held to their curves, mm: down to what a field shows.
const TOLERANCES: RangeInclusive<f64> = 0.01..=MOST_TOLERANCE_MM;
/// The tolerance that a panel gets first where it is to have one, mm: less than a knife cuts.
const FIRST_TOLERANCE_MM: f64 = 0.1;
/// How far lines of a grid may be apart, mm.
const GRIDS: RangeInclusive<f64> = 0.01..=1e6;

/// All fields.
pub(crate) fn fields_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, acts: &mut Vec<Act>) {
    egui::ScrollArea::vertical().auto_shrink([false; 2]).show(ui, |ui| {
        selected_ui(ui, editor, theme, acts);
        panel_ui(ui, editor, theme, acts);
        drawing_ui(ui, editor, theme, acts);
    });
}

fn section(ui: &mut Ui, title: &str, content: impl FnOnce(&mut Ui)) {
    ui.add_space(6.0);
    egui::CollapsingHeader::new(RichText::new(title).strong()).default_open(true).show(ui, content);
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
    if let Some((panel, rung)) = selection.rung()
        && let Some(Ok(shown)) = editor.shown().get(panel).map(|panel| &panel.made)
        && let Some(at) = shown.rungs.get(rung)
    {
        section(ui, "Rung", |ui| {
            ui.label(format!("Rung {} of {}", rung + 1, shown.rungs.len()));
            let twist = decimal(at.warp_deg, 2);
            let plate = shown.warp_limit_deg;
            ui.label(format!("Twist {twist}° (thick plate takes {plate}°)"));
            if at.is_unsure && at.warp_deg > plate {
                let text = "The samples are coarse: this may be bending alone.";
                ui.label(RichText::new(text).color(theme.faint));
            }
            ui.label(format!("Bend {}°", decimal(at.crease_deg, 2)));
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
    let of = Id::unique(("handle", &curve.name, at.point));
    for (label, value) in names.into_iter().zip([&mut to.0.x, &mut to.0.y, &mut to.1]) {
        if let Some(mm) = (Field { theme, of, label }).length(ui, *value, units, PLACES) {
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
    let field = Field { theme, of: Id::unique(("handles", points)), label: axes(plan)[2] };
    if let Some(mm) = field.length(ui, plan.lift(first), units, PLACES) {
        let moved = points.iter().filter_map(|r| Some((*r, plan.space(plan.flat(place(r)?), mm))));
        acts.push(Act::Move(moved.collect()));
        acts.push(Act::Rest);
    }
}

fn curve_ui(ui: &mut Ui, editor: &Editor, theme: &Theme, n: usize, acts: &mut Vec<Act>) {
    let document = editor.document();
    let design = &document.design;
    let curve = &design.curves[n];
    let of = Id::unique(("curve", &curve.name));
    if let Some(name) = (Field { theme, of, label: "Name of curve" }).name(ui, &curve.name) {
        acts.push(Act::Edit(Edit::RenameCurve { curve: n, name }));
    }
    let width_mm = allowance_mm(design, &curve.name);
    let units = document.drawing.units;
    let field = Field { theme, of, label: "Allowance" };
    if let Some(width_mm) = field.length(ui, width_mm, units, ALLOWANCES) {
        acts.push(Act::Edit(Edit::SetAllowance { curve: n, width_mm }));
    }
    trims_ui(ui, document, theme, n, acts);
    let state = if curve.closed { "closed" } else { "open" };
    ui.label(RichText::new(format!("{} points, {state}", curve.points.len())).color(theme.faint));
    let uses = |panel: &&DesignPanel| curves_of(panel).iter().any(|u| u.name == curve.name);
    let of: Vec<&str> = design.panels.iter().filter(uses).map(|p| p.name.as_str()).collect();
    let text = match (of.is_empty(), curve.closed) {
        (false, _) => format!("It bounds {}.", of.join(", ")),
        (true, false) => "It bounds no panel yet: close it.".to_owned(),
        (true, true) => why_unbound(document).unwrap_or_else(|| "It bounds no panel.".to_owned()),
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
        material_ui(ui, design, acts);
        thickness_ui(ui, editor.document(), theme, acts);
        trade_ui(ui, design, acts);
        preset_ui(ui, design, acts);
        sheets_ui(ui, design, theme, acts);
    });
    let made = design.panels_to_make();
    let name = match editor.selection().panel {
        Some(n) => editor.shown().get(n).map(|shown| &shown.panel),
        None if made.len() == 1 => made.first().map(|panel| &panel.name),
        None => None,
    };
    let Some(n) = name.and_then(|name| design.panels.iter().position(|p| p.name == *name)) else {
        return;
    };
    let panel = &design.panels[n];
    let units = editor.document().drawing.units;
    section(ui, "Panel", |ui| {
        let of = Id::unique(("panel", &panel.name));
        let field = |label| Field { theme, of, label };
        if let Some(name) = field("Name of panel").name(ui, &panel.name) {
            acts.push(Act::Edit(Edit::RenamePanel { panel: n, name }));
        }
        let mut to = panel.clone();
        if let PanelShape::Mesh(mesh) = &mut to.shape {
            let shown = editor.shown().iter().filter(|shown| shown.panel == panel.name);
            size_ui(ui, editor.document(), theme, acts);
            mesh_ui(ui, &field, mesh, editor.document().drawing.units, &shown.collect::<Vec<_>>());
            if to != *panel {
                acts.push(Act::Edit(Edit::SetPanel { panel: n, to: Box::new(to) }));
            }
            return;
        }
        let shown = editor.shown().iter().find(|shown| shown.panel == panel.name);
        samples_ui(ui, theme, &field, &mut to, units, shown);
        if let Some(fold) = field("Fold price").number(ui, to.fold, 0.0..=10.0) {
            to.fold = fold;
        }
        let mut lies_over = to.plane != PlaneChoice::None;
        let label = "Lies over its plan like a roof";
        if ui.checkbox(&mut lies_over, label).on_hover_text(
            "On: seen square to the best-fit plane, the surface stays inside the outline. Off: the \
             surface may wrap round or hang over.",
        ).changed() {
            to.plane = if lies_over { PlaneChoice::Auto } else { PlaneChoice::None };
        }
        let mut is_other = to.which == WhichSurface::Other;
        if ui
            .checkbox(&mut is_other, "The other surface, where two fit")
            .on_hover_text(
                "A closed curve may bound two surfaces that bend about as well. A message says so \
             where it does.",
            )
            .changed()
        {
            to.which = if is_other { WhichSurface::Other } else { WhichSurface::Cheapest };
        }
        if matches!(to.shape, PanelShape::Rails(_)) {
            ui.checkbox(&mut to.run_on, "Rails run on beyond the ends");
        }
        ui.checkbox(&mut to.slides, "Edges slide while it is bent").on_hover_text(
            "On: the edges may slide along the boundary, as those of a plank that is pulled onto its \
             stringers before it is fastened. Off: every point of an edge is held.",
        );
        if to != *panel {
            acts.push(Act::Edit(Edit::SetPanel { panel: n, to: Box::new(to) }));
        }
    });
}

fn material_ui(ui: &mut Ui, design: &Design, acts: &mut Vec<Act>) {
    let named = design.material.as_ref().map_or("Not named", |material| &material.title);
    ComboBox::from_label("Material").selected_text(named).width(150.0).show_ui(ui, |ui| {
        let mut choose = |ui: &mut Ui, is_it: bool, title: &str, name: Option<&str>| {
            if ui.selectable_label(is_it, title).clicked() && !is_it {
                acts.push(Act::Edit(Edit::SetMaterial(name.map(str::to_owned))));
            }
        };
        choose(ui, design.material.is_none(), "Not named", None);
        let mut group = None;
        for material in known_materials(&design.materials) {
            let of = material_group(&material.name);
            if group.replace(of) != Some(of) {
                ui.separator();
            }
            let is_it = design.material.as_ref() == Some(material);
            choose(ui, is_it, &material.title, Some(&material.name));
        }
    });
}

fn trade_ui(ui: &mut Ui, design: &Design, acts: &mut Vec<Act>) {
    let trade = design.trade.as_deref();
    let shown = trade.unwrap_or("Bare outlines");
    ComboBox::from_label("Made for").selected_text(shown).width(150.0).show_ui(ui, |ui| {
        for name in std::iter::once(None).chain(trade_names().into_iter().map(Some)) {
            let label = ui.selectable_label(trade == name, name.unwrap_or("Bare outlines"));
            let title = name.and_then(trade_title);
            let label = title.map_or(label.clone(), |title| label.on_hover_text(title));
            if label.clicked() && trade != name {
                acts.push(Act::Edit(Edit::SetTrade(name.map(str::to_owned))));
            }
        }
    });
}

/// How thick the sheet is, which face of it is drawn, and how sharply it is folded.
fn thickness_ui(ui: &mut Ui, document: &Document, theme: &Theme, acts: &mut Vec<Act>) {
    let design = &document.design;
    let before = (design.thickness_mm, design.dimensions, design.bend_radius_mm);
    let mut to = before;
    let field = Field { theme, of: Id::unique("sheet"), label: "Thickness" };
    let mm = design.sheet_thickness_mm().unwrap_or(0.0);
    if let Some(mm) = field.length(ui, mm, document.drawing.units, THICKNESSES) {
        let of_material = design.material.as_ref().map(|material| material.thickness_mm.value);
        to.0 = Some(mm).filter(|&mm| mm > 0.0 && Some(mm) != of_material);
    }
    let title = |face: Option<Dimensions>| match face {
        None => "As it is drawn",
        Some(Dimensions::Inside) => "Inside",
        Some(Dimensions::Mean) => "Middle",
        Some(Dimensions::Outside) => "Outside",
    };
    let shown = title(to.1);
    ComboBox::from_label("Drawn face").selected_text(shown).width(150.0).show_ui(ui, |ui| {
        for face in std::iter::once(None).chain(Dimensions::ALL.map(Some)) {
            ui.selectable_value(&mut to.1, face, title(face));
        }
    });
    // Without a drawn face, no fold has an allowance.
    if let Some(thick) = design.thick() {
        let usual = Design { bend_radius_mm: None, ..design.clone() };
        let usual_mm = usual.thick().and_then(|thick| thick.fold_radius_mm);
        let field = Field { label: "Bend radius", ..field };
        let mm = thick.fold_radius_mm.unwrap_or(0.0);
        if let Some(mm) = field.length(ui, mm, document.drawing.units, BEND_RADII) {
            to.2 = Some(mm).filter(|&mm| mm > 0.0 && Some(mm) != usual_mm);
        }
    }
    let (thickness_mm, dimensions, bend_radius_mm) = to;
    if to != before {
        acts.push(Act::Edit(Edit::SetSheet { thickness_mm, dimensions, bend_radius_mm }));
    }
}

/// The machine that SVG and DXF files are written for.
fn preset_ui(ui: &mut Ui, design: &Design, acts: &mut Vec<Act>) {
    let preset = design.preset.as_deref();
    let of_trade = Design { preset: None, trade: design.trade.clone(), ..Design::default() };
    let usual = format!("Usual ({})", OutputOptions::of(&of_trade).preset.name);
    let shown = preset.unwrap_or(&usual);
    ComboBox::from_label("Files for").selected_text(shown).width(150.0).show_ui(ui, |ui| {
        let all = Preset::all().iter().map(|preset| (Some(preset.name), preset.about));
        for (name, about) in std::iter::once((None, "as its trade needs it")).chain(all) {
            let label = ui.selectable_label(preset == name, name.unwrap_or(&usual));
            if label.on_hover_text(about).clicked() && preset != name {
                acts.push(Act::Edit(Edit::SetPreset(name.map(str::to_owned))));
            }
        }
    });
}

/// How finely a panel is sampled, and how near that comes to its curves.
fn samples_ui<'a>(
    ui: &mut Ui,
    theme: &Theme,
    field: &impl Fn(&'a str) -> Field<'a>,
    to: &mut DesignPanel,
    units: Units,
    shown: Option<&ShownPanel>,
) {
    let made = shown.and_then(|shown| shown.made.as_ref().ok());
    let usual = DesignPanel::usual(String::new(), to.shape.clone());
    let titles = ["Usual", "By tolerance", "A number"];
    let at = match to.tolerance {
        Some(SampleTolerance::Share(_)) => 0,
        Some(SampleTolerance::Mm(_)) => 1,
        None => 2,
    };
    let mut chosen = at;
    ComboBox::from_label("Sampled").selected_text(titles[at]).width(110.0).show_ui(ui, |ui| {
        for (n, title) in titles.into_iter().enumerate() {
            ui.selectable_value(&mut chosen, n, title);
        }
    });
    if chosen != at {
        *to = match chosen {
            0 => DesignPanel { samples: usual.samples, tolerance: usual.tolerance, ..to.clone() },
            1 => to.clone().within_mm(FIRST_TOLERANCE_MM),
            _ => DesignPanel { samples: usual.samples, tolerance: None, ..to.clone() },
        };
    }
    match to.tolerance {
        Some(SampleTolerance::Share(_)) => {}
        Some(SampleTolerance::Mm(mm)) => {
            if let Some(mm) = field("Tolerance").length(ui, mm, units, TOLERANCES) {
                *to = to.clone().within_mm(mm);
            }
        }
        None => {
            if let Some(number) = field("Samples").count(ui, to.samples as f64, 3.0..=100_000.0) {
                to.samples = number as usize;
            }
        }
    }
    // Also where nothing is made, so that no field moves.
    let count = made.map_or_else(|| "–".to_owned(), |made| made.positions.len().to_string());
    let label = ui.label(RichText::new(format!("{count} samples in all")).color(theme.faint));
    if let Some([off, shorter]) = made.and_then(|made| made.chords_mm) {
        // Down to a micrometre: a field's lengths are shown to a hundredth of a millimetre.
        let [off, shorter] = [off, shorter].map(|mm| decimal(mm, 3));
        label.on_hover_text(format!(
            "The outline is a polygon through them. Its curves lie up to {off} mm from it, and \
             along an edge it is up to {shorter} mm shorter."
        ));
    }
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
        if to.units != drawing.units && drawing.units.round_step_mm(to.grid_mm) == to.grid_mm {
            // What was round in the old unit is to be round in the new one.
            to.grid_mm = to.units.round_step_mm(to.grid_mm);
        }
        let of = Id::unique("drawing");
        let field = |label| Field { theme, of, label };
        if let Some(mm) = field("Grid").step(ui, drawing.grid_mm, drawing.units, GRIDS) {
            to.grid_mm = mm;
        }
        if let Some(mirror) = drawing.mirror {
            let name = if mirror.upright { "Mirror across" } else { "Mirror up" };
            if let Some(at_mm) = field(name).length(ui, mirror.at_mm, drawing.units, PLACES) {
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
            if let Some(mm) = field("Middle across").length(ui, x, drawing.units, PLACES) {
                picture.centre.x = mm;
            }
            if let Some(mm) = field("Middle up").length(ui, y, drawing.units, PLACES) {
                picture.centre.y = mm;
            }
        }
        if to != *drawing {
            acts.push(Act::Edit(Edit::SetDrawing(Box::new(to))));
        }
    });
}
