//! How large a mesh is and how it is laid flat.

use crate::document::{Document, Edit, FARTHEST_MM};
use crate::engine::shown::ShownPanel;
use crate::field::Field;
use crate::panes::words;
use crate::scene::Act;
use crate::theme::Theme;
use eframe::egui::{Button, ComboBox, Id, Ui};
use sheetwright::check::FindingKind;
use sheetwright::design::PanelMesh;
use sheetwright::flatten::Aim;
use sheetwright::math::{from_deg, to_deg};
use sheetwright::mesh::Skin;
use sheetwright_files::Units;
use std::ops::RangeInclusive;

/// Creases above this angle, degrees, divide a mesh where a person has not said which.
const SPLIT_CREASES_DEG: f64 = 30.0;
/// The largest extent of a drawing, mm, down to what a field shows.
const EXTENTS: RangeInclusive<f64> = 0.01..=FARTHEST_MM;
/// Units that the numbers of a file may be in, each with the one that it was read in by mistake.
const MISREAD: [[Units; 2]; 8] = [
    [Units::Centimetres, Units::Millimetres],
    [Units::Metres, Units::Millimetres],
    [Units::Inches, Units::Millimetres],
    [Units::Feet, Units::Millimetres],
    [Units::Millimetres, Units::Metres],
    [Units::Centimetres, Units::Metres],
    [Units::Inches, Units::Metres],
    [Units::Feet, Units::Metres],
];

/// How wide lists are, points.
const WIDE: f32 = 150.0;

/// The size of the whole drawing, which a mesh has from a file that seldom says its unit.
pub(super) fn size_ui(ui: &mut Ui, document: &Document, theme: &Theme, acts: &mut Vec<Act>) {
    let extent_mm = document.design.extent_mm();
    if extent_mm == 0.0 {
        return;
    }
    let units = document.drawing.units;
    let field = Field { theme, of: Id::unique("size"), label: "Largest extent" };
    if let Some(mm) = field.length(ui, extent_mm, units, EXTENTS) {
        acts.push(Act::Edit(Edit::Scale(mm / extent_mm)));
    }
    let text = "The file was in another unit";
    let menu = ui.menu_button(text, |ui| {
        for [meant, read] in MISREAD {
            let factor = meant.in_mm() / read.in_mm();
            let length = words::length(extent_mm * factor, units);
            let text = format!("{}, not {}: {length} long", meant.name(), read.name());
            if ui.add(Button::new(text)).clicked() {
                acts.push(Act::Edit(Edit::Scale(factor)));
                ui.close();
            }
        }
    });
    menu.response.on_hover_text("All panels change by one factor. The sheet and its paper do not.");
}

/// How a mesh is laid flat; numbers without a unit are in `units`. `shown` are the parts that were
/// made of it.
pub(super) fn mesh_ui<'a>(
    ui: &mut Ui,
    field: &impl Fn(&'a str) -> Field<'a>,
    mesh: &mut PanelMesh,
    units: Units,
    shown: &[&ShownPanel],
) {
    skin_ui(ui, mesh, shown);
    let aims = [
        (Aim::Mean, "Mean length error"),
        (Aim::Max, "Largest length error"),
        (Aim::Seams, "Border exact"),
    ];
    list_ui(ui, "Made small", &mut mesh.aim, &aims);
    let mut divides = mesh.split_creases.is_some();
    if ui.checkbox(&mut divides, "Divide along creases").changed() {
        mesh.split_creases = divides.then(|| from_deg(SPLIT_CREASES_DEG));
    }
    if let Some(crease) = mesh.split_creases
        && let Some(deg) = field("Creases above, °").number(ui, to_deg(crease), 1.0..=179.0)
    {
        mesh.split_creases = Some(from_deg(deg));
    }
    let facets =
        [(None, "Folded where meant"), (Some(true), "Folded"), (Some(false), "Not folded")];
    list_ui(ui, "Facets", &mut mesh.facets, &facets);
    if mesh.facets != Some(false)
        && let Some(size) = field("Pieces within").piece_size(ui, mesh.pieces_within_mm, units)
    {
        mesh.pieces_within_mm = size;
    }
    ui.checkbox(&mut mesh.darts, "Cut to the worst points").on_hover_text(
        "Where the mesh would stretch by more than the limit of the sheet, cut it from its border.",
    );
}

/// Which skin of a plate is laid flat, where the mesh is one, or was taken for one.
fn skin_ui(ui: &mut Ui, mesh: &mut PanelMesh, shown: &[&ShownPanel]) {
    let made = shown.iter().filter_map(|shown| shown.made.as_ref().ok());
    let is_plate = made.flat_map(|made| &made.findings).any(|finding| {
        matches!(finding.kind, FindingKind::TwoSkins { .. } | FindingKind::NotTwoSkins)
    });
    if is_plate || mesh.skin.is_some() {
        let skins = [
            (None, "Both, as it is"),
            (Some(Skin::Outer), "Outer alone"),
            (Some(Skin::Inner), "Inner alone"),
        ];
        list_ui(ui, "Skin", &mut mesh.skin, &skins);
    }
}

/// A list of a few values by their titles.
fn list_ui<T: Copy + PartialEq>(ui: &mut Ui, label: &str, value: &mut T, titles: &[(T, &str)]) {
    let title = titles.iter().find(|(of, _)| of == value).map_or("", |(_, title)| title);
    ComboBox::from_label(label).selected_text(title).width(WIDE).show_ui(ui, |ui| {
        for (of, title) in titles {
            ui.selectable_value(value, *of, *title);
        }
    });
}
