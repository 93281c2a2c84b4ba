//! What a workshop adds: the trade, the sheet, and what is done along edges.

use super::hands::Hands;
use super::{HIGH, field, open_list, says, with_template};
use sheetwright::design::Dimensions;
use sheetwright::make::make;
use sheetwright::pattern::{PathKind, Piece};
use sheetwright::watch::Unwatched;
use sheetwright_editor::command::Command;
use sheetwright_editor::document::{Edit, Selection};
use sheetwright_editor::scene::Act;
use sheetwright_files::{
    InputFormat, OutputOptions, ReadOptions, Units, formats_for, output_files, read_bytes,
};

#[test]
fn what_a_design_is_made_for_and_an_allowance_are_drawn_on_the_pattern() {
    let mut hands = with_template("bag", Units::Millimetres);
    let with_net = |hands: &mut Hands, edit: Edit| -> Vec<bool> {
        hands.harness.state_mut().editor_mut().carry_out(Act::Edit(edit));
        hands.settle();
        let shown = hands.harness.state().editor().shown();
        shown.iter().map(|panel| panel.made.as_ref().unwrap().piece.has_net()).collect()
    };
    let sewn = with_net(&mut hands, Edit::SetTrade(Some("sewing".to_owned())));
    assert!(!sewn.is_empty() && sewn.iter().all(|has| *has));
    let design = &hands.harness.state().editor().document().design;
    assert_eq!((design.trade.as_deref(), design.trims.len()), (Some("sewing"), 3));
    let mouth = design.curves.iter().position(|curve| curve.name == "mouth").unwrap();
    let bare = with_net(&mut hands, Edit::SetTrade(None));
    assert!(!bare.contains(&true));
    let width_mm = 15.0;
    let wider = with_net(&mut hands, Edit::SetAllowance { curve: mouth, width_mm });
    assert!(wider.contains(&true));
    let none = with_net(&mut hands, Edit::SetAllowance { curve: mouth, width_mm: 0.0 });
    assert!(!none.contains(&true));
    assert!(hands.harness.state().editor().document().design.trims.is_empty());
}

/// The flat pattern of the first panel.
fn first(hands: &Hands) -> &Piece {
    &hands.app().editor().shown()[0].made.as_ref().unwrap().piece
}

#[test]
fn thickness_drawn_face_and_preset_are_fields_of_the_sheet() {
    let mut hands = with_template("cone", Units::Millimetres);
    let design = |hands: &Hands| hands.app().editor().document().design.clone();
    hands.harness.set_size(HIGH.into());
    hands.harness.run_steps(5);
    // A face is that of a sheet: what is not known is said, and nothing changes.
    assert_eq!(field(&hands, "Thickness").unwrap().1, "0 mm");
    assert!(field(&hands, "Bend radius").is_none());
    open_list(&mut hands, "As it is drawn");
    hands.click("Inside");
    hands.step();
    assert!(says(&hands, "Name a material or a thickness"));
    assert_eq!(design(&hands).dimensions, None);
    let bare = first(&hands).size;
    hands.type_into("Thickness", "2mm");
    hands.settle();
    assert_eq!((design(&hands).thickness_mm, first(&hands).size), (Some(2.0), bare));
    open_list(&mut hands, "As it is drawn");
    hands.click("Inside");
    hands.settle();
    assert_eq!(design(&hands).dimensions, Some(Dimensions::Inside));
    assert!(first(&hands).size.x > bare.x + 1.0, "{:?}, bare {bare:?}", first(&hands).size);
    // The radius of the tool is that of the sheet until one is typed, and 0 is that again.
    assert_eq!(field(&hands, "Bend radius").unwrap().1, "2 mm");
    hands.type_into("Bend radius", "3mm");
    assert_eq!(design(&hands).bend_radius_mm, Some(3.0));
    assert_eq!(field(&hands, "Bend radius").unwrap().1, "3 mm");
    hands.type_into("Bend radius", "0");
    assert_eq!(design(&hands).bend_radius_mm, None);
    hands.settle();
    // The thickness of a material needs not be said twice.
    hands
        .harness
        .state_mut()
        .editor_mut()
        .carry_out(Act::Edit(Edit::SetMaterial(Some("steel-2mm".to_owned()))));
    hands.type_into("Thickness", "3mm");
    hands.type_into("Thickness", "2mm");
    hands.settle();
    assert_eq!(design(&hands).thickness_mm, None);
    assert_eq!(field(&hands, "Thickness").unwrap().1, "2 mm");

    open_list(&mut hands, "Usual (generic)");
    hands.click("lightburn");
    hands.step();
    assert_eq!(design(&hands).preset.as_deref(), Some("lightburn"));
    let edit = Edit::SetTrade(Some("duct".to_owned()));
    hands.harness.state_mut().editor_mut().carry_out(Act::Edit(edit));
    hands.settle();
    // What is exported is what the command writes: the files of the trade, for that preset.
    hands.save_and_export();
    let disk = hands.disk.lock().unwrap();
    let (options, format) = (ReadOptions::default(), InputFormat::Design);
    let read = read_bytes(format, &disk.saved, "a.sheet.json", None, &options).unwrap();
    let made = make(&read, &mut Unwatched).unwrap();
    let wanted = output_files(&made, &formats_for(&read), OutputOptions::of(&read)).unwrap().files;
    assert!(wanted.iter().any(|file| file.name == "brake.csv"));
    assert_eq!(disk.exported, wanted);
}

#[test]
fn what_parts_are_cut_from_is_a_field_and_larger_parts_are_divided() {
    let mut hands = with_template("cone", Units::Millimetres);
    hands.harness.set_size(HIGH.into());
    hands.harness.run_steps(5);
    let stock = |hands: &Hands| hands.app().editor().document().design.stock.clone();
    assert_eq!(field(&hands, "Cut from").unwrap().1, "");
    hands.type_into("Cut from", "2x1220x2440mm, roll:900mm");
    hands.settle();
    assert_eq!(stock(&hands).unwrap().sheets.len(), 2);
    assert_eq!(field(&hands, "Cut from").unwrap().1, "2x1220x2440mm, roll:900mm");
    hands.save_and_export();
    {
        let disk = hands.disk.lock().unwrap();
        let (options, format) = (ReadOptions::default(), InputFormat::Design);
        let read = read_bytes(format, &disk.saved, "a.sheet.json", None, &options).unwrap();
        let mut made = make(&read, &mut Unwatched).unwrap();
        made.lay_out(&mut Unwatched);
        let formats = formats_for(&read);
        let wanted = output_files(&made, &formats, OutputOptions::of(&read)).unwrap().files;
        assert!(wanted.iter().any(|file| file.name == "sheets.svg"));
        assert_eq!(disk.exported, wanted);
    }
    let pieces = |hands: &Hands| hands.app().editor().shown().len();
    hands.type_into("Cut from", "300x250mm");
    hands.settle();
    assert_eq!(pieces(&hands), 1);
    open_list(&mut hands, "Left whole");
    hands.click("Overlapped");
    hands.settle();
    assert!(stock(&hands).unwrap().divide.is_some() && pieces(&hands) > 2);
    let edit = Edit::SetStock(None);
    hands.harness.state_mut().editor_mut().carry_out(Act::Edit(edit));
    hands.settle();
    assert_eq!(pieces(&hands), 1);
    let before = stock(&hands);
    hands.type_into("Cut from", "1220");
    assert!(says(&hands, "give a width and a height such as 1220x2440mm"));
    assert_eq!(stock(&hands), before);
}

#[test]
fn what_is_done_along_a_selected_edge_is_fields_and_drawn_at_once() {
    let mut hands = with_template("bag", Units::Millimetres);
    hands.harness.set_size(HIGH.into());
    let design = |hands: &Hands| hands.app().editor().document().design.clone();
    let mouth = design(&hands).curves.iter().position(|curve| curve.name == "mouth").unwrap();
    let curve = Selection { curve: Some(mouth), ..Selection::default() };
    hands.harness.state_mut().editor_mut().carry_out(Act::Select(curve));
    hands.harness.run_steps(5);
    let kinds = |hands: &Hands| -> Vec<String> {
        design(hands).trims.iter().map(|trim| trim.kind.name().to_owned()).collect()
    };
    let cut = |hands: &Hands| first(hands).size;
    let bare = cut(&hands);
    open_list(&mut hands, "Nothing");
    hands.click("Hem");
    hands.settle();
    let hemmed = cut(&hands);
    assert!(first(&hands).has_net() && hemmed.y > bare.y + 29.0, "{hemmed:?}, bare {bare:?}");
    hands.type_into("Hem width", "4cm");
    hands.type_into("Turned in", "0");
    hands.settle();
    let wider = cut(&hands);
    assert!((wider.y - hemmed.y - 10.0).abs() < 0.1, "{wider:?}, {hemmed:?}");
    // Others add to it; of those that move the cut line, the last takes the place of the others.
    open_list(&mut hands, "Nothing more");
    hands.click("Holes");
    hands.settle();
    assert_eq!(kinds(&hands), ["hem", "holes"]);
    hands.type_into("Hole pitch", "50");
    hands.type_into("From the edge", "12");
    hands.settle();
    let holes = |hands: &Hands| {
        let paths = first(hands).paths.iter();
        paths.filter(|path| matches!(path.kind, PathKind::Drill { .. })).count()
    };
    assert!((6..=8).contains(&holes(&hands)), "{}", holes(&hands));
    hands.type_into("Allowance", "15");
    hands.settle();
    assert_eq!(kinds(&hands), ["holes", "allowance"]);
    open_list(&mut hands, "Nothing more");
    hands.click("Flange");
    hands.settle();
    assert_eq!(kinds(&hands), ["holes", "flange"]);
    assert_eq!(field(&hands, "Flange angle").unwrap().1, "90°");
    // They go with the name of the curve, and with the curve.
    hands.type_into("Name of curve", "rim");
    hands.settle();
    assert_eq!(kinds(&hands), ["holes", "flange"]);
    assert!(first(&hands).has_net());
    open_list(&mut hands, "Holes");
    hands.click("None");
    hands.settle();
    assert_eq!((kinds(&hands), holes(&hands)), (vec!["flange".to_owned()], 0));
    // What can't be is said in words where the panel would be.
    open_list(&mut hands, "Nothing more");
    hands.click("Fingers");
    hands.settle();
    let shown = &hands.app().editor().shown()[0].made;
    let refused = shown.as_ref().err().map(|refusal| refusal.message.clone());
    assert!(refused.is_some_and(|message| message.contains("joined to no other")));
    hands.run(Command::Delete);
    assert!(design(&hands).trims.is_empty());
}
