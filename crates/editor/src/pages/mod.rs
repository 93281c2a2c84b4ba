//! What opens over the panes: the start page, and the windows of single commands.

pub mod calibrate;
pub mod export;
pub mod keys;
pub mod palette;
pub mod start;
pub mod tour;
pub mod typed;
pub mod unit;
pub mod unsaved;
pub mod vary;

use crate::room::fitting;
use crate::theme::Theme;
use eframe::egui::{
    self, Align, Align2, Button, Color32, Frame, Id, Layout, Modal, RichText, Role, ScrollArea, Ui,
    Vec2, WidgetInfo, vec2,
};

/// What is left free of the window around a page, in points.
const MARGIN: f32 = 24.0;
/// What lies over everything behind a page.
const SHADE: Color32 = Color32::from_black_alpha(70);

/// How a page opens.
#[derive(Clone, Copy)]
struct PageWindow<'a> {
    /// What screen readers call it, and by what it is known again in the next frame.
    name: &'a str,
    /// Whether its name stands at its top, beside a cross that closes it.
    is_titled: bool,
    /// How wide it is where there is room, points.
    width: f32,
    /// Where it stands, and how far from there, points.
    place: (Align2, Vec2),
}

impl<'a> PageWindow<'a> {
    /// A page in the middle without a title.
    fn new(name: &'a str, width: f32) -> Self {
        Self { name, is_titled: false, width, place: (Align2::CENTER_CENTER, Vec2::ZERO) }
    }

    /// Shows it above everything else, which neither hand nor key reaches. It is never larger than
    /// the window: what finds no room is scrolled to. What it holds is told whether it has just
    /// opened, so that what is used most can take the keys.
    fn show(self, ctx: &egui::Context, content: impl FnOnce(&mut Ui, bool)) -> Touched {
        let id = Id::unique(("page", self.name));
        let pass = ctx.cumulative_pass_nr();
        let last = ctx.data(|data| data.get_temp::<u64>(id));
        ctx.data_mut(|data| data.insert_temp(id, pass));
        let is_new = last.is_none_or(|last| last + 2 < pass);
        if is_new {
            // What had the keys behind it has them no more.
            ctx.memory_mut(|memory| memory.stop_text_input());
        }
        let frame = Frame::window(&ctx.global_style());
        let room =
            ctx.content_rect().size() - frame.total_margin().sum() - Vec2::splat(2.0 * MARGIN);
        let (anchor, off) = self.place;
        let modal = Modal::new(id).backdrop_color(SHADE).frame(frame);
        let modal = Modal { area: modal.area.clone().anchor(anchor, off), ..modal };
        let shown = modal.show(ctx, |ui| {
            ui.set_width(fitting(self.width, room.x));
            let closes = self.is_titled && title_ui(ui, self.name);
            let height = fitting(f32::INFINITY, room.y - ui.min_rect().height() - off.y);
            let area = ScrollArea::vertical().auto_shrink([false, true]);
            let area = area.max_height(height).min_scrolled_height(height);
            area.show(ui, |ui| content(ui, is_new));
            closes
        });
        let name = || WidgetInfo::labeled(Role::Window, true, self.name);
        shown.response.widget_info(name);
        Touched { closes: shown.inner, beside: shown.backdrop_response.clicked() }
    }
}

/// What the hand has touched of a page besides what it holds.
struct Touched {
    /// Its cross.
    closes: bool,
    /// What lies behind it.
    beside: bool,
}

/// The title of a page and the cross that closes it; whether that was pressed.
fn title_ui(ui: &mut Ui, title: &str) -> bool {
    let height = ui.spacing().interact_size.y;
    let row = vec2(ui.available_width(), height);
    let closes = ui.allocate_ui_with_layout(row, Layout::left_to_right(Align::Center), |ui| {
        ui.heading(title);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let cross = ui.add(
                Button::new(RichText::new("×").size(19.0))
                    .frame(false)
                    .min_size(Vec2::splat(height)),
            );
            let name = || WidgetInfo::labeled(Role::Button, true, "Close");
            cross.widget_info(name);
            cross.on_hover_text("Close (Esc)").clicked()
        })
        .inner
    });
    ui.separator();
    closes.inner
}

/// A page in the middle with a title and a cross; whether it stays open.
fn window(ctx: &egui::Context, title: &str, width: f32, content: impl FnOnce(&mut Ui)) -> bool {
    let page = PageWindow { is_titled: true, ..PageWindow::new(title, width) };
    !page.show(ctx, |ui, _| content(ui)).closes
}

/// A button that stands out, as it is what people came for.
fn main_button(ui: &mut Ui, theme: &Theme, text: &str) -> egui::Response {
    let text = RichText::new(text).color(theme.on_accent).strong();
    ui.add(Button::new(text).fill(theme.accent).min_size(vec2(120.0, 32.0)))
}
