//! Pictures of the window, to be looked at: `SHEETWRIGHT_LOOK=folder cargo test --test look`. Of
//! another size and scale: `SHEETWRIGHT_LOOK_AT=2560x1440@2`, in pixels, with two pixels a point.

#![allow(clippy::unwrap_used)] // tests panic

mod hands;

use eframe::egui::vec2;
use hands::{Hands, round};
use sheetwright::check::Place;
use sheetwright::design::Design;
use sheetwright_editor::command::Command;
use sheetwright_editor::document::{Document, Edit, PointRef, Selection};
use sheetwright_editor::room::WindowPart;
use sheetwright_editor::scene::Act;
use sheetwright_editor::theme::Look;
use sheetwright_editor::views::SurfaceView;
use sheetwright_files::{design_from_template, usual_trim};
use sheetwright_shapes::bent;
use sheetwright_shapes::materials::steel;
use std::path::{Path, PathBuf};

fn keep(hands: &mut Hands, folder: &Path, name: &str) {
    hands.step();
    let picture = hands.harness.render().unwrap();
    picture.save(folder.join(format!("{name}.png"))).unwrap();
}

#[test]
fn pictures_are_taken_where_somebody_asks() {
    let Some(folder) = std::env::var_os("SHEETWRIGHT_LOOK").map(PathBuf::from) else { return };
    std::fs::create_dir_all(&folder).unwrap();
    let at = std::env::var("SHEETWRIGHT_LOOK_AT").unwrap_or("1280x800@1".to_string());
    let numbers: Vec<f32> = at.split(['x', '@']).map(|n| n.parse().unwrap()).collect();
    let [width, height, scale] = numbers[..] else { panic!("not as 1280x800@1: {at}") };
    for (look, name) in
        [(Look::Light, "light"), (Look::Dark, "dark"), (Look::HighContrast, "contrast")]
    {
        let mut hands = Hands::new([width, height], true);
        hands.harness.set_pixels_per_point(scale);
        hands.run(Command::Look(look));
        for _ in 0..40 {
            hands.step();
        }
        keep(&mut hands, &folder, &format!("{name}-start"));
        hands.click("Dome in gores");
        keep(&mut hands, &folder, &format!("{name}-form"));
        hands.run(Command::New);
        keep(&mut hands, &folder, &format!("{name}-empty"));
        let middle = hands.on_plan(0.0, 0.0);
        hands.drag(&round(middle, vec2(190.0, 120.0), 90));
        hands.settle();
        hands.run(Command::Draw);
        hands.drag(&round(middle + vec2(40.0, 0.0), vec2(45.0, 32.0), 60));
        hands.settle();
        for (point, lift) in [(0, 60.0), (2, 40.0)] {
            let editor = hands.harness.state_mut().editor_mut();
            let at = PointRef { curve: 0, point };
            let mut to = editor.document().design.curves[0].points[point].at;
            to.z = lift;
            editor.carry_out(Act::Move(vec![(at, to)]));
            editor.carry_out(Act::Rest);
            editor.carry_out(Act::Select(Selection::of_point(at)));
        }
        hands.settle();
        keep(&mut hands, &folder, &format!("{name}-panes"));
        for view in SurfaceView::ALL {
            hands.run(Command::View(view));
            hands.settle();
            keep(&mut hands, &folder, &format!("{name}-{view:?}").to_lowercase());
        }
        for part in WindowPart::ALL {
            hands.run(Command::Show(part));
            hands.settle();
            keep(&mut hands, &folder, &format!("{name}-part-{part:?}").to_lowercase());
        }
        for (command, page) in [
            (Command::Export, "export"),
            (Command::Vary, "vary"),
            (Command::Palette, "palette"),
            (Command::Tour, "tour"),
            (Command::Keys, "keys"),
        ] {
            hands.run(command);
            // It fades in.
            for _ in 0..30 {
                hands.step();
            }
            keep(&mut hands, &folder, &format!("{name}-{page}"));
            hands.run(Command::Escape);
        }
        hands.run(Command::View(SurfaceView::Shaded));
        for template in ["dome", "hemisphere", "dinghy"] {
            let design = design_from_template(template, &[]);
            let document = Document { design: design.unwrap(), ..Document::default() };
            hands.harness.state_mut().editor_mut().replace(document, None);
            hands.settle();
            for _ in 0..40 {
                hands.step();
            }
            keep(&mut hands, &folder, &format!("{name}-{template}"));
            let at = hands.app().editor().document().design.curves[1].points[1].at;
            let at = hands.on_plan(at.x, at.y);
            hands.move_to(at);
            keep(&mut hands, &folder, &format!("{name}-{template}-under-the-hand"));
        }
        // Where to divide a panel that will not bend.
        let design = Design { material: Some(steel(5.0)), ..bent::twisted(90.0) };
        let document = Document { design, ..Document::default() };
        hands.harness.state_mut().editor_mut().replace(document, None);
        hands.advise();
        let shown = hands.app().editor().shown()[0].made.clone().unwrap();
        let is_line = |place: &&Place| matches!(place, Place::Lines { .. });
        let place = shown.findings.iter().map(|finding| &finding.place).find(is_line).unwrap();
        let lines = Act::Show(Selection::of_place(0, place.clone()));
        hands.harness.state_mut().editor_mut().carry_out(lines);
        hands.harness.run_steps(40);
        keep(&mut hands, &folder, &format!("{name}-divided"));
        let design = design_from_template("dinghy", &[]);
        let document = Document { design: design.unwrap(), ..Document::default() };
        hands.harness.state_mut().editor_mut().replace(document, None);
        hands.settle();
        // What is done along a selected edge.
        let kinds = ["hem", "holes", "notches"].into_iter();
        let kinds = kinds.filter_map(|kind| usual_trim(kind, None)).collect();
        let edge = Selection { curve: Some(0), ..Selection::default() };
        let editor = hands.harness.state_mut().editor_mut();
        editor.carry_out(Act::Edit(Edit::SetTrims { curve: 0, kinds }));
        editor.carry_out(Act::Select(edge));
        hands.settle();
        keep(&mut hands, &folder, &format!("{name}-edge"));
    }
}
