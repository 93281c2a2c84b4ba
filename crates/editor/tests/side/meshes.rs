//! A panel that is a mesh: its size, its skin, and how its facets are folded.

use super::hands::Hands;
use super::{HIGH, field, open_list, says, with_template};
use eframe::egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use sheetwright::design::{DesignPanel, PanelMesh, PanelShape};
use sheetwright::mesh::Skin;
use sheetwright_editor::command::Command;
use sheetwright_editor::document::Document;
use sheetwright_editor::engine::shown::Shown;
use sheetwright_files::{Drawing, Units, piece_size};

/// A box with six faces, as an OBJ file.
fn box_of([x, y, z]: [f64; 3]) -> String {
    let corners = [[0.0, 0.0], [x, 0.0], [x, y], [0.0, y]];
    let corner = |[a, b]: [f64; 2], z: f64| format!("v {a} {b} {z}\n");
    let corners = [0.0, z].map(|z| corners.map(|at| corner(at, z)).concat()).concat();
    corners + "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
}

/// A window with a mesh from a file.
fn with_mesh(text: &str) -> Hands {
    let mut hands = Hands::new(HIGH, false);
    let mut document = Document::read("a.obj", text.as_bytes()).unwrap();
    document.drawing = Drawing::in_units(Units::Millimetres);
    hands.harness.state_mut().editor_mut().replace(document, None);
    hands.settle();
    hands.harness.run_steps(5);
    hands
}

fn extent_mm(hands: &Hands) -> f64 {
    hands.app().editor().document().design.extent_mm()
}

fn mesh(hands: &Hands) -> PanelMesh {
    let panels = &hands.app().editor().document().design.panels;
    let [DesignPanel { shape: PanelShape::Mesh(mesh), .. }] = &panels[..] else { panic!() };
    mesh.clone()
}

/// Whether a list shows this.
fn has_list(hands: &Hands, shows: &str) -> bool {
    let mut lists = hands.harness.query_all_by_role(Role::ComboBox);
    lists.any(|node| node.accesskit_node().value().is_some_and(|value| value == shows))
}

fn made(hands: &Hands) -> Vec<&Shown> {
    hands.app().editor().shown().iter().map(|shown| shown.made.as_ref().unwrap()).collect()
}

#[test]
fn a_mesh_takes_another_size_and_the_unit_of_its_file() {
    let mut hands = with_mesh(&box_of([20.0, 30.0, 40.0]));
    assert_eq!(field(&hands, "Largest extent").unwrap().1, "40 mm");
    hands.type_into("Largest extent", "30cm");
    hands.settle();
    assert!((extent_mm(&hands) - 300.0).abs() < 1e-9);
    hands.run(Command::Undo);
    hands.settle();
    assert_eq!(extent_mm(&hands), 40.0);
    hands.click("The file was in another unit");
    hands.harness.run_steps(30);
    hands.click("in, not mm: 1016 mm long");
    hands.settle();
    assert_eq!(extent_mm(&hands), 1016.0);
    let area: f64 = made(&hands).iter().map(|made| made.area_flat_mm2).sum();
    assert!((area / (2.0 * 2600.0 * 25.4 * 25.4) - 1.0).abs() < 1e-9, "{area}");
    hands.type_into("Largest extent", "0");
    assert!(says(&hands, "out of range"));
    // Panels with curves have their points for that.
    let mut hands = with_template("cone", Units::Millimetres);
    hands.harness.set_size(HIGH.into());
    hands.harness.run_steps(5);
    assert!(field(&hands, "Thickness").is_some() && field(&hands, "Largest extent").is_none());
    assert!(field(&hands, "Pieces within").is_none());
}

#[test]
fn pieces_of_facets_fit_the_paper_that_is_typed() {
    let mut hands = with_mesh(&box_of([120.0, 130.0, 140.0]));
    open_list(&mut hands, "Folded where meant");
    hands.click("Folded");
    hands.settle();
    assert_eq!((mesh(&hands).facets, made(&hands).len()), (Some(true), 1));
    assert_eq!(field(&hands, "Pieces within").unwrap().1, "");
    hands.type_into("Pieces within", "a4");
    hands.settle();
    assert_eq!(mesh(&hands).pieces_within_mm, Some(piece_size("a4").unwrap()));
    assert_eq!(field(&hands, "Pieces within").unwrap().1, "A4");
    let [longer, shorter] = piece_size("a4").unwrap();
    assert!(made(&hands).len() > 1);
    for made in made(&hands) {
        let size = made.piece.size;
        assert!(size.max_element() <= longer && size.min_element() <= shorter, "{size:?}");
    }
    hands.type_into("Pieces within", "20x15cm");
    hands.settle();
    assert_eq!(mesh(&hands).pieces_within_mm, Some([200.0, 150.0]));
    assert_eq!(field(&hands, "Pieces within").unwrap().1, "200x150mm");
    hands.run(Command::Undo);
    hands.settle();
    assert_eq!(mesh(&hands).pieces_within_mm, Some([longer, shorter]));
    hands.type_into("Pieces within", "a9");
    assert!(says(&hands, "give a4, letter or another size of paper"));
    assert_eq!(mesh(&hands).pieces_within_mm, Some([longer, shorter]));
}

#[test]
fn one_skin_of_a_plate_is_chosen_where_the_mesh_is_one() {
    let hands = with_mesh(&box_of([120.0, 130.0, 140.0]));
    assert!(has_list(&hands, "Folded where meant") && !has_list(&hands, "Both, as it is"));
    let mut hands = with_mesh(&box_of([200.0, 100.0, 1.0]));
    open_list(&mut hands, "Both, as it is");
    hands.click("Outer alone");
    hands.settle();
    assert_eq!(mesh(&hands).skin, Some(Skin::Outer));
    let [plate] = made(&hands)[..] else { panic!() };
    assert!((plate.area_flat_mm2 - 20_000.0).abs() < 1e-6, "{}", plate.area_flat_mm2);
}
