//! What opens over the panes: the start page, and the windows of single commands.

pub mod calibrate;
pub mod export;
pub mod keys;
pub mod palette;
pub mod start;
pub mod tour;
pub mod typed;
pub mod unsaved;
pub mod vary;

use crate::room::fitting;
use crate::theme::Theme;
use eframe::egui::{self, Align2, Color32, Id, LayerId, Order, Sense, Ui};

/// What is left free around a window, in points.
const MARGIN: f32 = 12.0;
/// What lies over everything behind a window.
const SHADE: Color32 = Color32::from_black_alpha(70);

/// A window in the middle, closed by its cross; whether it stays open. It is never larger than what
/// it stands in: what finds no room is scrolled to. Nothing behind it is reached by hand or key.
fn window(ctx: &egui::Context, title: &str, width: f32, content: impl FnOnce(&mut Ui)) -> bool {
    let mut is_open = true;
    let room = ctx.content_rect().size();
    // The title, and the margins of the frame.
    let around = egui::vec2(40.0, 90.0);
    let id = Id::unique(("page", title));
    shield(ctx, id);
    egui::Window::new(title)
        .id(id)
        .order(Order::Foreground)
        .open(&mut is_open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, egui::Vec2::ZERO)
        .default_width(width)
        .show(ctx, |ui| {
            ui.set_width(fitting(width, room.x - around.x));
            let height = fitting(f32::INFINITY, room.y - around.y - 2.0 * MARGIN);
            let area = egui::ScrollArea::vertical().auto_shrink([false, true]);
            area.max_height(height).min_scrolled_height(height).show(ui, content);
        });
    is_open
}

/// Covers everything behind the window of this name, so that neither hand nor keys reach it;
/// whether the hand has clicked there.
fn shield(ctx: &egui::Context, window: Id) -> bool {
    let id = window.with("shield");
    let pass = ctx.cumulative_pass_nr();
    let last = ctx.data(|d| d.get_temp::<u64>(id));
    ctx.data_mut(|d| d.insert_temp(id, pass));
    if last.is_none_or(|last| last + 2 < pass) {
        // What had the keys behind it has them no more.
        ctx.memory_mut(|memory| {
            if let Some(focused) = memory.focused() {
                memory.surrender_focus(focused);
            }
        });
    }
    let room = ctx.content_rect();
    let area = egui::Area::new(id).order(Order::Middle).fixed_pos(room.min).constrain(false);
    let shield = area.show(ctx, |ui| {
        ui.painter().rect_filled(room, 0.0, SHADE);
        ui.allocate_rect(room, Sense::CLICK | Sense::DRAG)
    });
    ctx.memory_mut(|memory| memory.set_modal_layer(LayerId::new(Order::Foreground, window)));
    shield.inner.clicked()
}

/// A question in the middle, above everything else, which gets no clicks meanwhile. What it holds
/// is told whether it has just opened, so that what is used most can take the keys.
fn modal(ctx: &egui::Context, name: &str, width: f32, content: impl FnOnce(&mut Ui, bool)) {
    let id = Id::unique(name);
    let frame = ctx.cumulative_pass_nr();
    let last = ctx.data_mut(|data| std::mem::replace(data.get_temp_mut_or(id, 0_u64), frame));
    let is_new = last == 0 || last + 2 < frame;
    let room = ctx.content_rect().size();
    egui::Modal::new(id).show(ctx, |ui| {
        ui.set_width(fitting(width, room.x - 60.0));
        let height = fitting(f32::INFINITY, room.y - 60.0);
        let area = egui::ScrollArea::vertical().auto_shrink([false, true]);
        let area = area.max_height(height).min_scrolled_height(height);
        let frame = egui::Frame::new().inner_margin(10);
        area.show(ui, |ui| frame.show(ui, |ui| content(ui, is_new)));
    });
}

/// A button that stands out, as it is what people came for.
fn main_button(ui: &mut Ui, theme: &Theme, text: &str) -> egui::Response {
    let text = egui::RichText::new(text).color(theme.on_accent).strong();
    ui.add(egui::Button::new(text).fill(theme.accent).min_size(egui::vec2(120.0, 32.0)))
}
