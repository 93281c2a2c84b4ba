//! Where to divide a panel that will not bend: found after everything is shown, stopped by the
//! hand, and marked where somebody asks.

#![allow(clippy::unwrap_used)] // tests panic

mod hands;

use eframe::egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use hands::Hands;
use sheetwright::check::{Finding, FindingKind, Place, Verdict};
use sheetwright::design::Design;
use sheetwright::make::make;
use sheetwright::math::Vec3;
use sheetwright::watch::Unwatched;
use sheetwright_editor::document::{Document, PointRef, Selection};
use sheetwright_editor::editor::Editor;
use sheetwright_editor::engine::shown::ShownPanel;
use sheetwright_editor::engine::work::Work;
use sheetwright_editor::engine::{Answer, Detail, Engine, Job};
use sheetwright_editor::scene::Act;
use sheetwright_files::{Format, finding_place, finding_text};
use sheetwright_shapes::bent;
use sheetwright_shapes::materials::steel;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A strip of steel of 5 mm between rails that twist by so many degrees.
fn twisted(deg: f64) -> Design {
    Design { material: Some(steel(5.0)), ..bent::twisted(deg) }
}

/// The findings on where to divide a panel that is shown.
fn divisions(panel: &ShownPanel) -> Vec<&Finding> {
    let findings = panel.made.iter().flat_map(|shown| &shown.findings);
    findings.filter(|f| matches!(f.kind, FindingKind::BendsDivided { .. })).collect()
}

fn show(work: &mut Work, design: &Design, detail: Detail) -> ShownPanel {
    let job = Job::Show { number: 1, design: Arc::new(design.clone()), detail };
    match work.run(&job, &mut Unwatched) {
        Some(Answer::Shown { mut panels, .. }) => panels.remove(0),
        other => panic!("{other:?}"),
    }
}

/// All advice on a design, and in how many answers it came.
fn advised(work: &mut Work, design: &Design) -> (Vec<(String, Finding)>, usize) {
    let job = Job::Advise { number: 2, design: Arc::new(design.clone()) };
    let mut answers = 0;
    loop {
        answers += 1;
        match work.run(&job, &mut Unwatched) {
            Some(Answer::Advised { advice, is_over: true, .. }) => return (advice, answers),
            Some(Answer::Advised { .. }) => assert!(answers < 100),
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn it_is_found_after_everything_is_shown_and_stays() {
    let (mut work, design) = (Work::default(), twisted(90.0));
    let before = show(&mut work, &design, Detail::Full);
    assert_eq!(before.made.as_ref().unwrap().verdict, Verdict::WillNotBend);
    assert!(divisions(&before).is_empty());
    let (advice, answers) = advised(&mut work, &design);
    let [(name, finding)] = &advice[..] else { panic!("{advice:?}") };
    assert!(name == "strip" && matches!(finding.kind, FindingKind::BendsDivided { parts: 2, .. }));
    assert!(answers > 1, "what comes meanwhile has to wait");
    // As the command says it, in its place among the others.
    let mut made = make(&design, &mut Unwatched).unwrap();
    made.advise(&mut Unwatched);
    let after = show(&mut work, &design, Detail::Full);
    assert_eq!(after.made.unwrap().findings, made.parts[0].checked.findings);
    // A worker that has begun anew finds it, too, and nothing where the sheet bends.
    assert_eq!(advised(&mut Work::default(), &design).0, advice);
    let bends = Design { material: Some(steel(1.0)), ..bent::twisted(10.0) };
    assert!(advised(&mut work, &bends).0.is_empty());
    // While the hand moves, a formula judges, and nothing is said.
    assert!(divisions(&show(&mut work, &twisted(91.0), Detail::Coarse)).is_empty());
}

#[test]
fn files_say_it_as_those_of_the_command_do() {
    let (number, design) = (1, Arc::new(twisted(90.0)));
    let job = Job::Export { number, design, formats: vec![Format::Report] };
    let Some(Answer::Files { outcome: Ok(files), .. }) = Work::default().run(&job, &mut Unwatched)
    else {
        panic!("no files")
    };
    let report = files.iter().find(|file| file.name == "report.json").unwrap();
    assert!(String::from_utf8_lossy(&report.bytes).contains("bends-divided"));
}

#[test]
fn the_hand_stops_it_at_once() {
    let mut engine = Engine::new(Arc::new(|| {}));
    let design = Arc::new(twisted(90.0));
    let wait = |engine: &mut Engine, is_it: &dyn Fn(&Answer) -> bool| {
        let begun = Instant::now();
        loop {
            let answers = engine.answers();
            if let Some(answer) = answers.into_iter().find(is_it) {
                return answer;
            }
            assert!(begun.elapsed() < Duration::from_secs(60), "no answer");
            std::thread::sleep(Duration::from_millis(1));
        }
    };
    let is = |number: u64| move |answer: &Answer| matches!(answer, Answer::Shown { number: n, .. } if *n == number);
    engine.ask(Job::Show { number: 1, design: design.clone(), detail: Detail::Full });
    wait(&mut engine, &is(1));
    let asked = Instant::now();
    engine.ask(Job::Advise { number: 2, design });
    let moved = Arc::new(twisted(91.0));
    engine.ask(Job::Show { number: 3, design: moved.clone(), detail: Detail::Coarse });
    engine.ask(Job::Show { number: 4, design: moved, detail: Detail::Full });
    // The full answer comes from the thread that has searched: nothing of the search comes first,
    // unless a first slice of it was over by then.
    let is_late = asked.elapsed() > Duration::from_millis(100);
    let of_search = |answer: &Answer| matches!(answer, Answer::Advised { .. });
    let first = wait(&mut engine, &|answer| is(4)(answer) || of_search(answer));
    assert!(is(4)(&first) || is_late, "{first:?}");
}

#[test]
fn a_drag_in_the_middle_of_it_puts_it_off_until_the_hand_rests_again() {
    let mut editor = Editor::new(Arc::new(|| {}));
    editor.replace(Document { design: twisted(90.0), ..Document::default() }, None);
    let until = |editor: &mut Editor, is_it: &dyn Fn(&Editor) -> bool| {
        let begun = Instant::now();
        while !is_it(editor) {
            assert!(begun.elapsed() < Duration::from_secs(60), "it never comes");
            editor.tick();
            std::thread::sleep(Duration::from_millis(2));
        }
    };
    until(&mut editor, &Editor::is_settled);
    assert!(divisions(&editor.shown()[0]).is_empty() && !editor.is_advised());
    let home = editor.document().design.curves[0].points[0].at;
    let begun = Instant::now();
    let mut n = 0.0;
    while begun.elapsed() < Duration::from_secs(2) {
        n += 1.0;
        let to = home + Vec3::Z * (n % 2.0);
        editor.carry_out(Act::Move(vec![(PointRef { curve: 0, point: 0 }, to)]));
        editor.tick();
        assert!(divisions(&editor.shown()[0]).is_empty());
        std::thread::sleep(Duration::from_millis(8));
    }
    editor.carry_out(Act::Rest);
    until(&mut editor, &Editor::is_advised);
    assert_eq!(divisions(&editor.shown()[0]).len(), 1);
    // With the next change it goes, and comes again.
    editor.carry_out(Act::Move(vec![(PointRef { curve: 0, point: 0 }, home + Vec3::Z * 5.0)]));
    editor.tick();
    assert!(!editor.is_advised());
    editor.carry_out(Act::Rest);
    until(&mut editor, &Editor::is_advised);
    assert_eq!(divisions(&editor.shown()[0]).len(), 1);
}

#[test]
fn a_click_on_it_marks_the_lines_in_space_and_on_the_pattern() {
    let mut hands = Hands::new([1280.0, 800.0], false);
    let document = Document { design: twisted(90.0), ..Document::default() };
    hands.harness.state_mut().editor_mut().replace(document, None);
    hands.settle();
    assert!(hands.sees("Will not bend") && !hands.sees("Divided straight across"));
    hands.advise();
    let finding = divisions(&hands.app().editor().shown()[0])[0].clone();
    let label = format!("{} ({})", finding_text(&finding), finding_place(&finding));
    assert!(label.starts_with("Divided straight across into 2"));
    hands.harness.get_by_label(&label).scroll_to_me();
    hands.harness.run_steps(40);
    hands.click(&label);
    hands.harness.run_steps(40);
    let selected = hands.app().editor().selection().clone();
    assert_eq!(selected, Selection::of_place(0, finding.place.clone()));
    let Place::Lines { lines } = &finding.place else { panic!("{finding:?}") };
    let mut panes = hands.harness.query_all_by_role(Role::Canvas);
    let is_space = |label: Option<String>| label.is_some_and(|label| label.starts_with("Space"));
    let rect = panes.find(|node| is_space(node.accesskit_node().label())).unwrap().rect();
    let camera = &hands.app().space().camera;
    for (at, _) in lines.iter().flat_map(|line| &line.on_part) {
        assert!(camera.seen(*at, rect).is_some_and(|seen| rect.contains(seen.at)));
    }
}
