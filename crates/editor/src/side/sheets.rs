//! What the parts are cut from, and how those are divided that are larger.

use crate::document::Edit;
use crate::field::Field;
use crate::scene::Act;
use crate::theme::Theme;
use eframe::egui::{ComboBox, Id, RichText, Ui};
use sheetwright::design::{Design, Divide, DivideJoint, Stock};
use sheetwright_files::stock_text;

/// The sheets of the design, and the joint of parts that are larger.
pub(super) fn sheets_ui(ui: &mut Ui, design: &Design, theme: &Theme, acts: &mut Vec<Act>) {
    let before = design.stock.as_ref();
    let sheets = before.map_or(&[][..], |stock| &stock.sheets);
    let texts: Option<Vec<String>> = sheets.iter().map(stock_text).collect();
    let Some(texts) = texts else {
        ui.label(RichText::new("Cut from the sheets of its file").color(theme.faint));
        return;
    };
    let field = Field { theme, of: Id::unique("stock"), label: "Cut from" };
    if let Some(mut typed) = field.sheets(ui, &texts.join(", ")) {
        // A sheet that stays keeps its name and its cost, which are not typed here.
        for sheet in &mut typed {
            if let Some(known) = sheets.iter().find(|known| known.form == sheet.form) {
                (sheet.name, sheet.cost) = (known.name.clone(), known.cost);
            }
        }
        let sheets = typed;
        let stock = Stock { sheets, ..before.cloned().unwrap_or_default() };
        let is_nothing = stock == Stock::default();
        acts.push(Act::Edit(Edit::SetStock((!is_nothing).then(|| Box::new(stock)))));
        return;
    }
    let Some(stock) = before.filter(|_| !sheets.is_empty()) else { return };
    let title = |joint: Option<DivideJoint>| match joint {
        None => "Left whole",
        Some(DivideJoint::Scarf) => "Scarfed",
        Some(DivideJoint::Butt) => "Butted, with straps",
        Some(DivideJoint::Puzzle) => "Puzzle joints",
        Some(DivideJoint::Overlap) => "Overlapped",
    };
    let joint = stock.divide.map(|divide| divide.joint);
    let mut chosen = joint;
    ComboBox::from_label("Larger parts").selected_text(title(joint)).width(150.0).show_ui(
        ui,
        |ui| {
            for joint in std::iter::once(None).chain(DivideJoint::ALL.map(Some)) {
                ui.selectable_value(&mut chosen, joint, title(joint));
            }
        },
    );
    if chosen != joint {
        let stock = Stock { divide: chosen.map(Divide::by), ..stock.clone() };
        acts.push(Act::Edit(Edit::SetStock(Some(Box::new(stock)))));
    }
}
