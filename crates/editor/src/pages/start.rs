//! The start page: an empty sheet, templates and examples with pictures, recent files, what was
//! closed without being saved, and what was not saved when the program ended last.

use super::main_button;
use crate::bars::notice_ui;
use crate::command::Command;
use crate::document::Document;
use crate::editor::{Notice, name_of};
use crate::field::Field;
use crate::room::{Room, fitting};
use crate::scene::Act;
use crate::theme::Theme;
use crate::thumb::Thumbs;
use eframe::egui::{self, Align, Button, Id, Layout, RichText, ScrollArea, TextEdit, Ui, vec2};
use sheetwright::template::{Kind, Parameter, Range, Template, catalogue};
use sheetwright_files::{Drawing, Units, design_from_template, length_in, read_lengths};
use std::collections::BTreeMap;

/// What the page shows and what is chosen on it.
#[derive(Default)]
pub struct StartPage {
    search: String,
    form: Option<Form>,
    thumbs: Thumbs,
    /// The units of new designs.
    pub units: Units,
}

/// A template that is being filled in.
struct Form {
    template: &'static Template,
    /// What was set, as it was typed.
    settings: BTreeMap<&'static str, String>,
    outcome: Result<Document, String>,
}

/// What came of a field of a form.
enum Entry {
    /// Nothing.
    Same,
    /// A new value, which is set.
    New,
    /// It holds what was refused.
    Refused,
}

/// What the page came to.
pub enum StartAct {
    /// A new document takes the place of the one that is edited.
    Take {
        /// The document.
        document: Box<Document>,
        /// Whether it is as it is offered: nothing was typed for it that could be lost.
        is_safe: bool,
    },
    /// A recent file is to be opened.
    Recent(String),
    /// Something that was not saved comes back, by its number.
    Recover(usize),
    /// Something that was not saved is not needed, by its number.
    Forget(usize),
    /// Something that was closed without being saved comes back, by its number.
    Reopen(usize),
    /// Back to the document that is edited.
    Back,
}

/// What the page offers beside templates.
pub struct Offers<'a> {
    /// The paths of recent files, the newest first.
    pub recent: &'a [String],
    /// What was not saved when the program ended last, in words.
    pub recovered: &'a [String],
    /// What was closed without being saved, in words.
    pub closed: &'a [String],
    /// What is edited, unless it is blank.
    pub back_to: Option<&'a str>,
    /// What was last said to the person.
    pub notice: Option<&'a Notice>,
}

/// Designs that come with the program.
const EXAMPLES: [(&str, &str, &[u8]); 8] = [
    (
        "Three cones",
        "Pieces of three cones in one sheet",
        include_bytes!("../../../../examples/three-cones.sheet.json"),
    ),
    (
        "Square to round",
        "A duct from a square to a circle",
        include_bytes!("../../../../examples/square-to-round.sheet.json"),
    ),
    (
        "Reducer",
        "A duct from wide to narrow",
        include_bytes!("../../../../examples/reducer.sheet.json"),
    ),
    ("Mouse", "A toy in five pieces", include_bytes!("../../../../examples/mouse.sheet.json")),
    ("Hat", "Brim, band and crown", include_bytes!("../../../../examples/hat.sheet.json")),
    ("Flower", "Petals of paper", include_bytes!("../../../../examples/flower.sheet.json")),
    (
        "Window sheet",
        "A sheet with several holes",
        include_bytes!("../../../../examples/gallery/multiply-connected.sheet.json"),
    ),
    (
        "Raised",
        "A surface raised from its edge",
        include_bytes!("../../../../examples/gallery/raised.sheet.json"),
    ),
];

/// How large a card of a shape is, in points.
pub const CARD: egui::Vec2 = vec2(168.0, 168.0);

/// How wide the field of the search is, points.
const SEARCH: f32 = 220.0;
/// A form that has less room shows its picture above its fields, points.
const TWO_COLUMNS: f32 = 480.0;
/// How far its picture is from its fields, points.
const BETWEEN_COLUMNS: f32 = 16.0;
/// How large its picture is at the most, above and beside the fields, points; fields are no wider.
const PICTURES: [f32; 2] = [240.0, 460.0];

impl StartPage {
    /// Shows the page.
    pub fn ui(
        &mut self,
        ui: &mut Ui,
        theme: &'static Theme,
        offers: &Offers<'_>,
        acts: &mut Vec<Act>,
    ) -> Option<StartAct> {
        let mut out = None;
        if let Some(notice) = offers.notice {
            egui::Panel::bottom("said").show(ui, |ui| notice_ui(ui, theme, notice, true));
        }
        if Room::of(ui.available_size()) == Room::One {
            egui::CentralPanel::default().show(ui, |ui| {
                if self.form.is_some() {
                    out = self.form_ui(ui, theme);
                    return;
                }
                ScrollArea::vertical().auto_shrink([false; 2]).show(ui, |ui| {
                    out = self.side_ui(ui, theme, offers, acts);
                    self.search_ui(ui);
                    let chosen = self.cards_ui(ui, theme);
                    out = out.take().or(chosen);
                });
            });
            return out;
        }
        egui::Panel::left("start").resizable(false).exact_size(230.0).show(ui, |ui| {
            ScrollArea::vertical().auto_shrink([false; 2]).show(ui, |ui| {
                out = self.side_ui(ui, theme, offers, acts);
            });
        });
        egui::CentralPanel::default().show(ui, |ui| {
            let chosen = if self.form.is_some() {
                self.form_ui(ui, theme)
            } else {
                self.search_ui(ui);
                let area = ScrollArea::vertical().auto_shrink([false; 2]);
                area.show(ui, |ui| self.cards_ui(ui, theme)).inner
            };
            out = out.take().or(chosen);
        });
        out
    }

    fn side_ui(
        &mut self,
        ui: &mut Ui,
        theme: &Theme,
        offers: &Offers<'_>,
        acts: &mut Vec<Act>,
    ) -> Option<StartAct> {
        let mut out = None;
        ui.add_space(16.0);
        ui.label(RichText::new("Sheetwright").size(26.0).strong());
        ui.label(RichText::new("Draw an outline, lift it, cut the pattern.").color(theme.faint));
        ui.add_space(16.0);
        let wide = |text: &str| Button::new(text.to_owned()).min_size(vec2(200.0, 34.0));
        let draw = RichText::new("Draw an outline").color(theme.on_accent).strong();
        let draw = Button::new(draw).fill(theme.accent).min_size(vec2(200.0, 38.0));
        if ui.add(draw).on_hover_text(Command::New.tooltip()).clicked() {
            acts.push(Act::Run(Command::New));
        }
        if let Some(title) = offers.back_to {
            let back = wide(&format!("Back to {title}")).truncate();
            if ui.add(back).on_hover_text("Go on with what is open.").clicked() {
                out = Some(StartAct::Back);
            }
        }
        for command in [Command::Open, Command::Tour] {
            if ui.add(wide(command.name())).on_hover_text(command.tooltip()).clicked() {
                acts.push(Act::Run(command));
            }
        }
        egui::ComboBox::from_label("Units").selected_text(self.units.name()).show_ui(ui, |ui| {
            for units in Units::ALL {
                ui.selectable_value(&mut self.units, units, units.name());
            }
        });
        if !offers.recovered.is_empty() {
            ui.add_space(16.0);
            ui.label(
                RichText::new("Not saved when the editor ended").color(theme.verdicts[1]).strong(),
            );
            for (n, text) in offers.recovered.iter().enumerate() {
                // However long the name is, the button beside it stays in sight.
                let line = vec2(ui.available_width(), ui.spacing().interact_size.y);
                ui.allocate_ui_with_layout(line, Layout::right_to_left(Align::Center), |ui| {
                    if ui.small_button("×").on_hover_text("Forget it.").clicked() {
                        out = Some(StartAct::Forget(n));
                    }
                    ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                        if left_ui(ui, text, "Bring it back.") {
                            out = Some(StartAct::Recover(n));
                        }
                    });
                });
            }
        }
        if !offers.closed.is_empty() {
            ui.add_space(16.0);
            ui.label(RichText::new("Recently closed").strong());
            for (n, text) in offers.closed.iter().enumerate() {
                if left_ui(ui, text, "Open it again. It was closed without being saved.") {
                    out = Some(StartAct::Reopen(n));
                }
            }
        }
        if !offers.recent.is_empty() {
            ui.add_space(16.0);
            ui.label(RichText::new("Recent files").strong());
            for path in offers.recent {
                if left_ui(ui, name_of(path), path) {
                    out = Some(StartAct::Recent(path.clone()));
                }
            }
        }
        out
    }

    fn search_ui(&mut self, ui: &mut Ui) {
        ui.add_space(8.0);
        ui.horizontal_wrapped(|ui| {
            ui.heading("Begin with a shape");
            let edit = TextEdit::singleline(&mut self.search)
                .hint_text("Search: cone, duct, tent …")
                .desired_width(SEARCH);
            let edit = |ui: &mut Ui| {
                ui.add(edit).widget_info(|| {
                    egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Search shapes")
                });
            };
            // On a line of its own where it finds no room at the right.
            if ui.available_size_before_wrap().x < SEARCH + 20.0 {
                ui.end_row();
                edit(ui);
            } else {
                ui.with_layout(Layout::right_to_left(Align::Center), edit);
            }
        });
        ui.add_space(6.0);
    }

    fn cards_ui(&mut self, ui: &mut Ui, theme: &'static Theme) -> Option<StartAct> {
        let mut out = None;
        let wanted = self.search.trim().to_lowercase();
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(12.0, 12.0);
            for template in catalogue().iter().filter(|t| is_meant(t, &wanted)) {
                let shape = || design_from_template(template.name, &[]).ok();
                let name = template.title;
                if self.thumbs.card_ui(ui, theme, CARD, name, template.who, shape) {
                    self.form = Some(Form::new(template, self.units));
                }
            }
        });
        ui.add_space(18.0);
        ui.heading("Examples");
        ui.add_space(6.0);
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(12.0, 12.0);
            for (name, what, bytes) in EXAMPLES {
                if !wanted.is_empty() && !format!("{name} {what}").to_lowercase().contains(&wanted)
                {
                    continue;
                }
                let read = || Document::read("example.sheet.json", bytes).ok();
                let shape = || read().map(|document| document.design);
                if self.thumbs.card_ui(ui, theme, CARD, name, what, shape)
                    && let Some(document) = read()
                {
                    out = Some(StartAct::Take { document: Box::new(document), is_safe: true });
                }
            }
        });
        out
    }

    fn form_ui(&mut self, ui: &mut Ui, theme: &'static Theme) -> Option<StartAct> {
        let units = self.units;
        let form = self.form.as_mut()?;
        let mut is_left = false;
        let mut out = None;
        ui.add_space(8.0);
        ui.horizontal_wrapped(|ui| {
            is_left = ui.button("← All shapes").clicked();
            ui.heading(form.template.title);
        });
        ui.label(RichText::new(form.template.who).color(theme.faint));
        ui.add_space(8.0);
        let mut picture_ui = |ui: &mut Ui, form: &Form, most: f32| {
            if let Ok(document) = &form.outcome {
                let side = ui.available_width().min(most);
                self.thumbs.picture_ui(ui, theme, vec2(side, side), &document.design);
            }
        };
        let is_narrow = ui.available_width() < TWO_COLUMNS;
        if is_narrow {
            ScrollArea::vertical().id_salt("form").show(ui, |ui| {
                picture_ui(ui, form, PICTURES[0]);
                out = form.ui(ui, theme, units);
            });
        } else {
            ui.horizontal_top(|ui| {
                let column = fitting(PICTURES[1], 0.5 * ui.available_width());
                ui.vertical(|ui| {
                    ui.set_width(column);
                    let area = ScrollArea::vertical().id_salt("form");
                    out = area.show(ui, |ui| form.ui(ui, theme, units)).inner;
                });
                ui.add_space(BETWEEN_COLUMNS);
                picture_ui(ui, form, PICTURES[1]);
            });
        }
        if is_left {
            self.form = None;
        }
        out
    }

    /// The template that was filled in is edited by now: next time the shapes are shown again.
    pub fn close_form(&mut self) {
        self.form = None;
    }
}

fn is_meant(template: &Template, wanted: &str) -> bool {
    let has = |text: &str| text.to_lowercase().contains(wanted);
    has(template.title) || has(template.name) || template.words.iter().any(|word| has(word))
}

impl Form {
    fn new(template: &'static Template, units: Units) -> Self {
        let outcome = Err(String::new());
        let mut form = Self { template, settings: BTreeMap::new(), outcome };
        form.draw(units);
        form
    }

    /// Draws the template with what is set.
    fn draw(&mut self, units: Units) {
        let settings: Vec<String> =
            self.settings.iter().map(|(name, value)| format!("{name}={value}")).collect();
        self.outcome = match design_from_template(self.template.name, &settings) {
            Ok(design) => Ok(Document { design, drawing: Drawing::in_units(units) }),
            Err(error) => Err(format!("{error}. {}", error.hint)),
        };
    }

    /// The fields for all parameters, and the design if it is to be made.
    fn ui(&mut self, ui: &mut Ui, theme: &Theme, units: Units) -> Option<StartAct> {
        let mut refused = None;
        for parameter in self.template.parameters {
            match self.parameter_ui(ui, theme, parameter, units) {
                Entry::New => self.draw(units),
                Entry::Refused => _ = refused.get_or_insert(parameter.meaning),
                Entry::Same => {}
            }
        }
        ui.add_space(12.0);
        match &self.outcome {
            Ok(document) => {
                // What stands in red would not be what is made.
                let button = |ui: &mut Ui| main_button(ui, theme, "Make it").clicked();
                let is_clicked = ui.add_enabled_ui(refused.is_none(), button).inner;
                if let Some(meaning) = refused {
                    let text = format!("First correct the {meaning}, or press Esc in its field.");
                    ui.label(RichText::new(text).color(theme.verdicts[2]));
                }
                is_clicked.then(|| StartAct::Take {
                    document: Box::new(document.clone()),
                    is_safe: self.settings.is_empty(),
                })
            }
            Err(text) => {
                ui.label(RichText::new(text).color(theme.verdicts[2]));
                None
            }
        }
    }

    /// A field for a parameter; what came of it.
    fn parameter_ui(
        &mut self,
        ui: &mut Ui,
        theme: &Theme,
        parameter: &Parameter,
        units: Units,
    ) -> Entry {
        let set = self.settings.get(parameter.name);
        let label = capitalised(parameter.meaning);
        let of = Id::unique(("template", self.template.name, parameter.name));
        let field = Field { theme, of, label: &label };
        let new = match parameter.kind {
            Kind::Length(Range { least, most, default }) => {
                let now = set.and_then(|text| length_in(text, Units::Millimetres));
                let typed = field.length(ui, now.unwrap_or(default), units, least..=most);
                typed.map(|mm| mm.to_string())
            }
            Kind::Angle(range) | Kind::Count(range) | Kind::Number(range) => {
                let now = set.and_then(|text| text.parse().ok()).unwrap_or(range.default);
                let range = range.least..=range.most;
                let typed = match parameter.kind {
                    Kind::Angle(_) => field.angle(ui, now, range),
                    Kind::Count(_) => field.count(ui, now, range),
                    _ => field.number(ui, now, range),
                };
                typed.map(|number| number.to_string())
            }
            Kind::Lengths { default, least, most, .. } => {
                let now = set.and_then(|text| read_lengths(text, Units::Millimetres).ok());
                let now = now.unwrap_or_else(|| default.to_vec());
                let typed = field.lengths(ui, &now, units, least..=most);
                let text = |mm: &f64| mm.to_string();
                typed.map(|list| list.iter().map(text).collect::<Vec<_>>().join(","))
            }
            Kind::Choice(choices) => {
                let now = set.map_or(choices[0].name, String::as_str);
                let shown = choices.iter().find(|choice| choice.name == now);
                let mut new = None;
                ui.horizontal(|ui| {
                    ui.label(RichText::new(&label).color(theme.faint));
                    let text = shown.map_or(now, |choice| choice.meaning);
                    egui::ComboBox::from_id_salt(parameter.name).selected_text(text).show_ui(
                        ui,
                        |ui| {
                            for choice in choices {
                                if ui.selectable_label(choice.name == now, choice.meaning).clicked()
                                {
                                    new = Some(choice.name.to_owned());
                                }
                            }
                        },
                    );
                });
                new
            }
            // Tables come from files, which the command line takes.
            Kind::Table => None,
        };
        let is_refused = field.is_refused(ui);
        match new {
            Some(value) => {
                self.settings.insert(parameter.name, value);
                Entry::New
            }
            None if is_refused => Entry::Refused,
            None => Entry::Same,
        }
    }
}

/// A line to click that leads to something that is kept, on one line however long; whether it was
/// clicked.
fn left_ui(ui: &mut Ui, text: &str, hint: &str) -> bool {
    ui.scope(|ui| {
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Truncate);
        ui.link(text).on_hover_text(hint).clicked()
    })
    .inner
}

fn capitalised(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |c| c.to_uppercase().chain(chars).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_example_opens_and_every_template_draws() {
        for (name, _, bytes) in EXAMPLES {
            assert!(Document::read("example.sheet.json", bytes).is_ok(), "{name}");
        }
        for template in catalogue() {
            assert!(Form::new(template, Units::Inches).outcome.is_ok(), "{}", template.name);
        }
    }

    #[test]
    fn what_is_typed_into_a_form_is_drawn() {
        let mut form = Form::new(&catalogue()[0], Units::Millimetres);
        let before = form.outcome.clone().unwrap();
        let lengths = form.template.parameters.iter();
        let length = lengths.clone().find(|p| matches!(p.kind, Kind::Length(_))).unwrap();
        let Kind::Length(range) = length.kind else { unreachable!() };
        let value = f64::midpoint(range.default, range.most).min(range.default * 1.1);
        form.settings.insert(length.name, format!("{value}"));
        form.draw(Units::Millimetres);
        assert_ne!(form.outcome.unwrap().design, before.design);
    }
}
