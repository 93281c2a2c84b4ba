//! Fields that people type quantities into: `40cm`, `1' 4"`, `12.5`.
//!
//! While a field is typed into it keeps its own text; Enter, or leaving it, takes the value. What
//! can't be read stays there in red with what could be, and changes nothing.

use crate::theme::Theme;
use eframe::egui::{self, Id, Key, RichText, Ui};
use sheetwright_files::{Units, length_in, length_text};

/// How wide a field is, points.
const WIDTH: f32 = 96.0;

/// A length. `Some` with the new one, mm, when one was typed.
pub(crate) fn length_ui(
    ui: &mut Ui,
    theme: &Theme,
    label: &str,
    mm: f64,
    units: Units,
) -> Option<f64> {
    let read = |text: &str| length_in(text, units).filter(|mm| mm.abs() <= 1e9);
    let hint = "Type a length, such as 400, 40cm or 1' 4\".";
    typed_ui(ui, theme, label, &length_text(mm, units), hint, read)
}

/// A plain number between two others. `Some` with the new one when one was typed.
pub(crate) fn number_ui(
    ui: &mut Ui,
    theme: &Theme,
    label: &str,
    value: f64,
    range: std::ops::RangeInclusive<f64>,
) -> Option<f64> {
    let hint = format!("Type a number from {} to {}.", range.start(), range.end());
    let read = |text: &str| {
        let number: f64 = text.trim().trim_end_matches('°').trim().parse().ok()?;
        range.contains(&number).then_some(number)
    };
    typed_ui(ui, theme, label, &format!("{value}"), &hint, read)
}

/// A text that `read` makes something of. `Some` when something else was typed.
pub(crate) fn typed_ui<T>(
    ui: &mut Ui,
    theme: &Theme,
    label: &str,
    shown: &str,
    hint: &str,
    read: impl Fn(&str) -> Option<T>,
) -> Option<T> {
    let id = ui.scope_id().with(("field", label));
    let mut text = ui.data(|d| d.get_temp::<String>(id)).unwrap_or_else(|| shown.to_owned());
    let is_bad = text != shown && read(&text).is_none();
    let mut taken = None;
    ui.horizontal(|ui| {
        let room = (ui.available_width() - WIDTH - 3.0 * ui.spacing().item_spacing.x).max(0.0);
        let name = ui
            .scope(|ui| {
                ui.set_max_width(room);
                ui.add(egui::Label::new(RichText::new(label).color(theme.faint)).wrap())
            })
            .inner;
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let ink = if is_bad { theme.verdicts[2] } else { theme.ink };
            let edit = egui::TextEdit::singleline(&mut text)
                .id(field_id(id))
                .desired_width(WIDTH)
                .align(egui::Align2::RIGHT_CENTER)
                .text_color(ink);
            let response = ui.add(edit).labelled_by(name.id);
            // A click puts the cursor once more where the button is let go.
            let is_held = ui.input(|i| i.pointer.any_down());
            let fresh = id.with("fresh");
            if response.gained_focus() {
                ui.data_mut(|d| d.insert_temp(fresh, true));
            }
            if !is_held && ui.data_mut(|d| d.remove_temp::<bool>(fresh)).is_some() {
                select_all(ui, field_id(id), &text);
            }
            if response.lost_focus() {
                let is_dropped = ui.input(|i| i.key_pressed(Key::Escape));
                match read(&text) {
                    Some(value) if !is_dropped && text != shown => taken = Some(value),
                    _ => {}
                }
                // What could not be read goes back to what was.
                ui.data_mut(|d| d.remove_temp::<String>(id));
            } else if response.has_focus() {
                ui.data_mut(|d| d.insert_temp(id, text.clone()));
            }
            if is_bad {
                response.show_tooltip_text(hint);
            } else {
                response.on_hover_text(hint);
            }
        });
    });
    taken
}

/// The place of a field that keys come to.
fn field_id(id: Id) -> Id {
    id.with("text")
}

fn select_all(ui: &Ui, id: Id, text: &str) {
    use egui::text::{CCursor, CCursorRange};
    if let Some(mut state) = egui::TextEdit::load_state(ui.ctx(), id) {
        let all = CCursorRange::two(CCursor::new(0), CCursor::new(text.chars().count()));
        state.cursor.set_char_range(Some(all));
        state.store(ui.ctx(), id);
    }
}

/// A name. `Some` with the new one when one was typed.
pub(crate) fn name_ui(ui: &mut Ui, theme: &Theme, label: &str, name: &str) -> Option<String> {
    let read = |text: &str| {
        let text = text.trim();
        (!text.is_empty() && text != name).then(|| text.to_owned())
    };
    typed_ui(ui, theme, label, name, "Type a name.", read)
}
