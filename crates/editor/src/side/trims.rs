//! What is done along the edge of a selected curve, as fields: a kind and its main numbers each.
//!
//! The numbers to begin with are those of `sheetwright_files::usual_trim`, and the kernel draws
//! what comes of them. Other numbers of a trim, which a file may have, stay as they are.

use crate::document::edit::trims_along;
use crate::document::{Document, Edit};
use crate::field::Field;
use crate::scene::Act;
use crate::theme::Theme;
use eframe::egui::{ComboBox, Id, Ui};
use sheetwright::design::{
    Fingers, Flange, Hem, Holes, NotchForm, Notches, Places, Puzzle, Slots, Tabs, Ticks, TrimKind,
};
use sheetwright::math::{from_deg, to_deg};
use sheetwright_files::{Units, usual_trim};
use std::ops::RangeInclusive;

/// The kinds beside the allowance, which has a field of its own: their names in designs and here.
const KINDS: [(&str, &str); 9] = [
    ("hem", "Hem"),
    ("flange", "Flange"),
    ("tabs", "Glue tabs"),
    ("holes", "Holes"),
    ("notches", "Notches"),
    ("ticks", "Ticks"),
    ("fingers", "Fingers"),
    ("puzzle", "Puzzle joint"),
    ("slots", "Slots"),
];
const FORMS: [(NotchForm, &str); 6] = [
    (NotchForm::Slit, "Slit"),
    (NotchForm::T, "T"),
    (NotchForm::V, "V inwards"),
    (NotchForm::VOut, "V outwards"),
    (NotchForm::U, "U"),
    (NotchForm::Castle, "Castle"),
];
/// How high a list may be, points, so that all kinds are in sight.
const HIGH: f32 = 320.0;
/// Lengths that may not be 0, mm.
const ABOVE_0: RangeInclusive<f64> = 0.01..=10_000.0;
/// Lengths that may, mm.
const FROM_0: RangeInclusive<f64> = 0.0..=10_000.0;

/// The trims along a curve, each with a list of kinds and its numbers, and a list to add one from.
pub(super) fn trims_ui(
    ui: &mut Ui,
    document: &Document,
    theme: &Theme,
    curve: usize,
    acts: &mut Vec<Act>,
) {
    let design = &document.design;
    let name = &design.curves[curve].name;
    let mut kinds = trims_along(design, name);
    let before = kinds.clone();
    let thickness_mm = design.sheet_thickness_mm();
    let mut gone = None;
    for (n, kind) in kinds.iter_mut().enumerate() {
        match kind_ui(ui, n, Some(kind), thickness_mm) {
            Some(Chosen::Nothing) => gone = Some(n),
            Some(Chosen::Kind(other)) => *kind = other,
            None => {
                let of = Id::unique(("trim", name, n, kind.name()));
                numbers_ui(ui, kind, &Fields { theme, of, units: document.drawing.units });
            }
        }
    }
    if let Some(n) = gone {
        kinds.remove(n);
    }
    if let Some(Chosen::Kind(kind)) = kind_ui(ui, before.len(), None, thickness_mm) {
        kinds.push(kind);
    }
    if kinds != before {
        acts.push(Act::Edit(Edit::SetTrims { curve, kinds }));
    }
}

enum Chosen {
    Nothing,
    Kind(TrimKind),
}

/// A list of kinds. `Some` where another was chosen.
fn kind_ui(
    ui: &mut Ui,
    n: usize,
    now: Option<&TrimKind>,
    thickness_mm: Option<f64>,
) -> Option<Chosen> {
    let nothing = if n == 0 { "Nothing" } else { "Nothing more" };
    let title = |kind: &TrimKind| KINDS.iter().find(|(name, _)| *name == kind.name());
    let shown = now.map_or(nothing, |kind| title(kind).map_or("", |(_, title)| title));
    let label = if n == 0 { "Along the edge" } else { "And along it" };
    let mut chosen = None;
    ui.push_id(("trim", n), |ui| {
        let list = ComboBox::from_label(label).selected_text(shown).width(130.0).height(HIGH);
        list.show_ui(ui, |ui| {
            if ui.selectable_label(now.is_none(), "None").clicked() && now.is_some() {
                chosen = Some(Chosen::Nothing);
            }
            for (name, title) in KINDS {
                let is_it = now.is_some_and(|kind| kind.name() == name);
                if ui.selectable_label(is_it, title).clicked() && !is_it {
                    chosen = usual_trim(name, thickness_mm).map(Chosen::Kind);
                }
            }
        });
    });
    chosen
}

/// The fields of one trim.
struct Fields<'a> {
    theme: &'a Theme,
    of: Id,
    units: Units,
}

impl Fields<'_> {
    fn field<'b>(&'b self, label: &'b str) -> Field<'b> {
        Field { theme: self.theme, of: self.of, label }
    }

    /// Whether another length was typed, which then stands in `mm`.
    fn length(&self, ui: &mut Ui, label: &str, mm: &mut f64, range: RangeInclusive<f64>) -> bool {
        let typed = self.field(label).length(ui, *mm, self.units, range);
        typed.map(|typed| *mm = typed).is_some()
    }

    /// How many places stand along the edge, evenly.
    fn places(&self, ui: &mut Ui, at: &mut Places) {
        match at {
            Places::Shares(shares) => {
                let count = shares.len() as f64;
                if let Some(count) = self.field("How many").count(ui, count, 1.0..=100.0) {
                    *shares = (1..=count as usize).map(|n| n as f64 / (count + 1.0)).collect();
                }
            }
            Places::Every(mm) => _ = self.length(ui, "Every", mm, ABOVE_0),
            Places::Lengths(_) => {}
        }
    }
}

/// The main numbers of a trim.
fn numbers_ui(ui: &mut Ui, kind: &mut TrimKind, fields: &Fields<'_>) {
    match kind {
        TrimKind::Allowance(_) => {}
        TrimKind::Hem(Hem { width, turn }) => {
            fields.length(ui, "Hem width", width, ABOVE_0);
            fields.length(ui, "Turned in", turn, FROM_0);
        }
        TrimKind::Flange(Flange { width, angle, .. }) => {
            fields.length(ui, "Flange width", width, ABOVE_0);
            let deg = (to_deg(*angle) * 1e9).round() / 1e9;
            if let Some(deg) = fields.field("Flange angle").angle(ui, deg, 1.0..=180.0) {
                *angle = from_deg(deg);
            }
        }
        TrimKind::Tabs(Tabs { width, .. }) => {
            fields.length(ui, "Tab width", width, ABOVE_0);
        }
        TrimKind::Holes(holes) => holes_ui(ui, holes, fields),
        TrimKind::Notches(notches) => notches_ui(ui, notches, fields),
        TrimKind::Ticks(Ticks { at, length, numbered }) => {
            fields.places(ui, at);
            fields.length(ui, "Tick length", length, ABOVE_0);
            ui.checkbox(numbered, "Numbered");
        }
        TrimKind::Fingers(Fingers { width, depth, .. }) => {
            fields.length(ui, "Finger width", width, ABOVE_0);
            fields.length(ui, "Finger depth", depth, ABOVE_0);
        }
        TrimKind::Slots(Slots { pitch, width, thickness, .. }) => {
            fields.length(ui, "Tab length", width, ABOVE_0);
            fields.length(ui, "Tab pitch", pitch, ABOVE_0);
            fields.length(ui, "Slot width", thickness, ABOVE_0);
        }
        TrimKind::Puzzle(Puzzle { pitch, width, .. }) => {
            fields.length(ui, "Knob width", width, ABOVE_0);
            fields.length(ui, "Knob pitch", pitch, ABOVE_0);
        }
    }
}

/// Near the ends, holes stay as dense as elsewhere, where they were.
fn holes_ui(ui: &mut Ui, holes: &mut Holes, fields: &Fields<'_>) {
    let Holes { pitch, end_pitch, end_length, ends, inset, diameter } = holes;
    let was = *pitch;
    if fields.length(ui, "Hole pitch", pitch, ABOVE_0) && *end_length == 0.0 {
        let half = *ends == 0.5 * was;
        *end_pitch = *pitch;
        if half {
            *ends = 0.5 * *pitch;
        }
    }
    fields.length(ui, "From the edge", inset, ABOVE_0);
    fields.length(ui, "Hole diameter", diameter, ABOVE_0);
}

fn notches_ui(ui: &mut Ui, notches: &mut Notches, fields: &Fields<'_>) {
    fields.places(ui, &mut notches.at);
    fields.length(ui, "Notch depth", &mut notches.depth, ABOVE_0);
    let title = FORMS.iter().find(|(form, _)| *form == notches.form).map_or("", |(_, title)| title);
    ComboBox::from_label("Form").selected_text(title).width(150.0).show_ui(ui, |ui| {
        for (form, title) in FORMS {
            ui.selectable_value(&mut notches.form, form, title);
        }
    });
}
