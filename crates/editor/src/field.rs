//! Fields that people type quantities into: `40cm`, `1' 4"`, `12,5`, `200 + 50`, `15°`.
//!
//! While a field is typed into it keeps its own text; Enter, or leaving it, takes the value. What
//! then can't be read or is out of range stays there in red, and why stands below it, until it is
//! right or Esc drops it. A field belongs to the thing whose value it has ([`Field::of`]): where
//! another thing is shown in its place, or the value changes by other means, what was typed is
//! dropped.

use crate::theme::Theme;
use eframe::egui::{self, Id, Key, RichText, Ui};
use sheetwright::design::StockSheet;
use sheetwright_files::{
    Units, length_text, piece_size, piece_size_text, read_angle, read_length, read_lengths,
    read_number, step_text, stock_sheet,
};
use std::ops::RangeInclusive;

/// How wide a field is, points.
const WIDTH: f32 = 96.0;
/// Lengths from here on are said in kilometres, mm.
const KILOMETRE: f64 = 1e6;

/// A field for one value of one thing.
pub(crate) struct Field<'a> {
    /// The colours.
    pub(crate) theme: &'a Theme,
    /// The thing whose value it has.
    pub(crate) of: Id,
    /// The name of the value.
    pub(crate) label: &'a str,
}

/// What a field shows and what is typed, while it is not taken.
#[derive(Clone, Default)]
struct Typed {
    text: String,
    /// What was shown when typing began.
    before: String,
    /// The pass in which the field was shown last.
    seen: u64,
    /// Whether it was to be taken and could not be.
    is_refused: bool,
}

impl Field<'_> {
    /// A length. `Some` with the new one, mm, when one was typed.
    pub(crate) fn length(
        &self,
        ui: &mut Ui,
        mm: f64,
        units: Units,
        range: RangeInclusive<f64>,
    ) -> Option<f64> {
        self.long(ui, &length_text(mm, units), units, range)
    }

    /// The step of a grid, which is shown as people say it: `1/8 in`.
    pub(crate) fn step(
        &self,
        ui: &mut Ui,
        mm: f64,
        units: Units,
        range: RangeInclusive<f64>,
    ) -> Option<f64> {
        self.long(ui, &step_text(mm, units), units, range)
    }

    fn long(
        &self,
        ui: &mut Ui,
        shown: &str,
        units: Units,
        range: RangeInclusive<f64>,
    ) -> Option<f64> {
        let say = |mm| far_text(mm, units);
        let read = |text: &str| within(read_length(text, units)?, &range, say);
        let takes = takes(&range, say);
        let hint = format!("Type a length, such as 400, 40cm, 1' 4\" or 200 + 50. {takes}");
        self.typed(ui, shown, &hint, read)
    }

    /// A list of lengths. `Some` with the new ones, mm, when they were typed.
    pub(crate) fn lengths(
        &self,
        ui: &mut Ui,
        mm: &[f64],
        units: Units,
        range: RangeInclusive<f64>,
    ) -> Option<Vec<f64>> {
        let say = |mm| far_text(mm, units);
        let read = |text: &str| {
            let all = read_lengths(text, units)?.into_iter();
            all.map(|mm| within(mm, &range, say)).collect()
        };
        let texts: Vec<String> = mm.iter().map(|&mm| length_text(mm, units)).collect();
        let hint =
            "Type lengths with commas between them; semicolons let commas stand before decimals.";
        self.typed(ui, &texts.join(", "), hint, read)
    }

    /// An angle. `Some` with the new one, degrees, when one was typed.
    pub(crate) fn angle(&self, ui: &mut Ui, deg: f64, range: RangeInclusive<f64>) -> Option<f64> {
        let say = |deg| format!("{deg}°");
        let read = |text: &str| within(read_angle(text)?, &range, say);
        let hint = format!("Type an angle, such as 15 or 15°. {}", takes(&range, say));
        self.typed(ui, &say(deg), &hint, read)
    }

    /// A plain number. `Some` with the new one when one was typed.
    pub(crate) fn number(
        &self,
        ui: &mut Ui,
        value: f64,
        range: RangeInclusive<f64>,
    ) -> Option<f64> {
        self.counted(ui, value, range, false)
    }

    /// A whole number. `Some` with the new one when one was typed.
    pub(crate) fn count(&self, ui: &mut Ui, value: f64, range: RangeInclusive<f64>) -> Option<f64> {
        self.counted(ui, value, range, true)
    }

    fn counted(
        &self,
        ui: &mut Ui,
        value: f64,
        range: RangeInclusive<f64>,
        is_whole: bool,
    ) -> Option<f64> {
        let say = |number: f64| number.to_string();
        let read = |text: &str| whole_if(is_whole, within(read_number(text)?, &range, say)?);
        let what = if is_whole { "a whole number" } else { "a number" };
        self.typed(ui, &say(value), &format!("Type {what}. {}", takes(&range, say)), read)
    }

    /// A name. `Some` with the new one when one was typed.
    pub(crate) fn name(&self, ui: &mut Ui, name: &str) -> Option<String> {
        let read = |text: &str| match text.trim() {
            "" => Err("A name has at least one letter.".to_owned()),
            text => Ok(text.to_owned()),
        };
        self.typed(ui, name, "Type a name.", read).filter(|new| new != name)
    }

    /// Sheets, separated by commas. `Some` with the new ones when others were typed; none where the
    /// text is empty.
    pub(crate) fn sheets(&self, ui: &mut Ui, shown: &str) -> Option<Vec<StockSheet>> {
        let read = |text: &str| -> Result<Vec<StockSheet>, String> {
            let all = text.split([',', ';']).map(str::trim).filter(|text| !text.is_empty());
            all.map(stock_sheet).collect()
        };
        let hint = "Type the size of a sheet, such as 1220x2440mm or 4x8ft, 3x1220x2440mm where \
                    there are three, roll:1370mm for a roll; or several with commas between them. \
                    Empty: parts are not laid out.";
        self.typed(ui, shown, hint, read)
    }

    /// The largest size of a piece, in these units where none is typed. `Some` with the new one,
    /// mm, when another was typed; within it `None` where the text is empty.
    #[expect(clippy::option_option, reason = "typed or not, and then limited or not")]
    pub(crate) fn piece_size(
        &self,
        ui: &mut Ui,
        size: Option<[f64; 2]>,
        units: Units,
    ) -> Option<Option<[f64; 2]>> {
        let read = |text: &str| match text.trim() {
            "" => Ok(None),
            text => piece_size(text).map(|read| {
                // The names of papers end in digits, too, and take no unit.
                let is_bare = text.ends_with(|c: char| c.is_ascii_digit());
                let in_units = piece_size(&format!("{text}{}", units.name()));
                Some(in_units.ok().filter(|_| is_bare).unwrap_or(read))
            }),
        };
        let hint = "Type the paper that every piece of facets has to fit, such as A4, or a width \
                    and a height such as 280x200mm. Empty: pieces are as large as they come.";
        self.typed(ui, &size.map_or_else(String::new, piece_size_text), hint, read)
    }

    /// Puts the cursor into the field, once it has been shown, to type over what is there.
    pub(crate) fn focus(&self, ui: &Ui) {
        ui.memory_mut(|memory| memory.request_focus(self.id()));
        ui.data_mut(|d| {
            d.insert_temp(self.fresh(), true);
            d.insert_temp(self.untouched(), true);
        });
    }

    /// Whether the cursor was put there by nobody's hand yet.
    fn untouched(&self) -> Id {
        self.id().with("untouched")
    }

    /// Whether somebody has just come to it.
    fn fresh(&self) -> Id {
        self.id().with("fresh")
    }

    /// Whether it holds what was refused.
    pub(crate) fn is_refused(&self, ui: &Ui) -> bool {
        ui.data(|d| d.get_temp::<Typed>(self.id())).is_some_and(|typed| typed.is_refused)
    }

    fn id(&self) -> Id {
        self.of.with(("field", self.label))
    }

    /// A text that `read` makes something of, or says why not. `Some` when something else was
    /// typed.
    fn typed<T>(
        &self,
        ui: &mut Ui,
        shown: &str,
        hint: &str,
        read: impl Fn(&str) -> Result<T, String>,
    ) -> Option<T> {
        let id = self.id();
        let pass = ui.ctx().cumulative_pass_nr();
        // One that was out of sight, or is of another value by now, is no longer meant.
        let kept = ui.data(|d| d.get_temp::<Typed>(id));
        let kept = kept.filter(|typed| typed.before == shown && typed.seen + 2 >= pass);
        let (mut text, was_refused) =
            kept.map_or_else(|| (shown.to_owned(), false), |typed| (typed.text, typed.is_refused));
        let value = |text: &str| (text != shown).then(|| read(text));
        let is_bad = matches!(value(&text), Some(Err(_)));
        let response = self.row(ui, &mut text, is_bad);
        self.select_what_is_there(ui, &response, &text);
        let (is_dropped, is_entered) =
            ui.input(|i| (i.key_pressed(Key::Escape), i.key_pressed(Key::Enter)));
        let ends = response.lost_focus();
        let mut found = value(&text);
        if ends && is_dropped {
            found = None;
            text.clear();
        }
        let is_refused = matches!(found, Some(Err(_))) && (was_refused || ends);
        if is_refused && ends && is_entered {
            // It is to be put right.
            response.request_focus();
        }
        if is_refused || response.has_focus() {
            let typed = Typed { text, before: shown.to_owned(), seen: pass, is_refused };
            ui.data_mut(|d| d.insert_temp(id, typed));
        } else {
            ui.data_mut(|d| d.remove_temp::<Typed>(id));
        }
        match found {
            Some(Ok(new)) if ends => return Some(new),
            Some(Err(why)) if is_refused => {
                let why = RichText::new(why).color(self.theme.verdicts[2]).small();
                ui.add(egui::Label::new(why).wrap());
            }
            _ => _ = response.on_hover_text(hint),
        }
        None
    }

    /// A field that is come to is typed over. A click puts the cursor once more where the button is
    /// let go, so that this waits for it.
    fn select_what_is_there(&self, ui: &Ui, response: &egui::Response, text: &str) {
        let fresh = self.fresh();
        let is_first = response.clicked()
            && ui.data_mut(|d| d.remove_temp::<bool>(self.untouched())).is_some();
        if response.gained_focus() || is_first {
            ui.data_mut(|d| d.insert_temp(fresh, true));
        }
        let is_held = ui.input(|i| i.pointer.any_down());
        if !is_held && ui.data_mut(|d| d.remove_temp::<bool>(fresh)).is_some() {
            select_all(ui, self.id(), text);
        }
    }

    /// The name, and what is typed beside it.
    fn row(&self, ui: &mut Ui, text: &mut String, is_bad: bool) -> egui::Response {
        let theme = self.theme;
        let row = ui.horizontal(|ui| {
            let room = (ui.available_width() - WIDTH - 3.0 * ui.spacing().item_spacing.x).max(0.0);
            let name = ui
                .scope(|ui| {
                    ui.set_max_width(room);
                    ui.add(egui::Label::new(RichText::new(self.label).color(theme.faint)).wrap())
                })
                .inner;
            let edit = ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let ink = if is_bad { theme.verdicts[2] } else { theme.ink };
                let edit = egui::TextEdit::singleline(text)
                    .id(self.id())
                    .desired_width(WIDTH)
                    .align(egui::Align2::RIGHT_CENTER)
                    .text_color(ink);
                ui.add(edit)
            });
            edit.inner.labelled_by(name.id)
        });
        row.inner
    }
}

/// A number in its range, or why it is refused; `say` is a number in words.
fn within(
    number: f64,
    range: &RangeInclusive<f64>,
    say: impl Fn(f64) -> String,
) -> Result<f64, String> {
    match range.contains(&number) {
        true => Ok(number),
        false => Err(format!("{} is out of range. {}", say(number), takes(range, say))),
    }
}

/// A number that has to be whole, or any, or why it is refused.
fn whole_if(is_whole: bool, number: f64) -> Result<f64, String> {
    match is_whole && number.fract() != 0.0 {
        true => Err(format!("{number} is not a whole number.")),
        false => Ok(number),
    }
}

/// A range in a sentence: `It takes 10 mm to 2 m.`
fn takes(range: &RangeInclusive<f64>, say: impl Fn(f64) -> String) -> String {
    format!("It takes {} to {}.", say(*range.start()), say(*range.end()))
}

/// A length as a bound: far ones in kilometres.
fn far_text(mm: f64, units: Units) -> String {
    match mm.abs() >= KILOMETRE {
        true => format!("{} km", mm / KILOMETRE),
        false => length_text(mm, units),
    }
}

fn select_all(ui: &Ui, id: Id, text: &str) {
    use egui::text::{CCursor, CCursorRange};
    if let Some(mut state) = egui::TextEdit::load_state(ui.ctx(), id) {
        let all = CCursorRange::two(CCursor::new(0), CCursor::new(text.chars().count()));
        state.cursor.set_char_range(Some(all));
        state.store(ui.ctx(), id);
    }
}
