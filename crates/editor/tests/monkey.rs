//! A monkey with a seed: random commands, strokes, drags, keys and words, without a panic.
//!
//! `SHEETWRIGHT_MONKEY_SECONDS` says for how long (10), `SHEETWRIGHT_MONKEY_SEED` which monkey (1);
//! what it says where it fails names it. Whatever it has done, the document is one that a file can
//! hold, and undo goes back to the beginning.

#![allow(clippy::print_stdout, clippy::unwrap_used)] // tests panic, and say what they did

mod hands;

use eframe::egui::{Event, Key, Modifiers, MouseWheelUnit, Pos2, pos2, vec2};
use hands::{Hands, round};
use sheetwright_editor::command::Command;
use sheetwright_editor::document::Document;
use sheetwright_editor::editor::{Decision, Opened, Page};
use sheetwright_editor::scene::Act;
use std::time::{Duration, Instant};

/// Random numbers: splitmix64.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    fn one<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }

    fn place(&mut self, size: [f32; 2]) -> Pos2 {
        pos2(self.below(size[0] as usize) as f32, self.below(size[1] as usize) as f32)
    }
}

const SIZE: [f32; 2] = [1100.0, 720.0];
const KEYS: [Key; 16] = [
    Key::ArrowLeft,
    Key::ArrowRight,
    Key::ArrowUp,
    Key::ArrowDown,
    Key::PageUp,
    Key::PageDown,
    Key::Enter,
    Key::Tab,
    Key::Backspace,
    Key::Delete,
    Key::Space,
    Key::C,
    Key::L,
    Key::J,
    Key::M,
    Key::Escape,
];
const WORDS: [&str; 9] = ["40cm", "1' 4\"", "-12", "0", "1e9", "rim", "x/y", "§", "100000000000"];

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

#[test]
fn nothing_panics_whatever_is_done() {
    let lasts = Duration::from_secs(setting("SHEETWRIGHT_MONKEY_SECONDS", 10));
    let seed = setting("SHEETWRIGHT_MONKEY_SEED", 1);
    println!("monkey {seed}");
    let mut dice = Dice(seed);
    let mut hands = Hands::new(SIZE, false);
    let start = Instant::now();
    let (mut done, mut documents) = (0, 0);
    while start.elapsed() < lasts {
        act(&mut hands, &mut dice);
        done += 1;
        if done % 20 == 0 {
            documents += usize::from(check(&hands));
        }
        if done % 400 == 0 {
            rewind(&mut hands);
        }
    }
    println!("{done} acts, {documents} documents compared");
    assert!(done > 20);
}

fn act(hands: &mut Hands, dice: &mut Dice) {
    let all = Command::all();
    if hands.app().editor().asks().is_some() && dice.below(3) == 0 {
        let decision = dice.one(&[Decision::Save, Decision::Drop, Decision::Stay]);
        hands.harness.state_mut().editor_mut().decide(decision);
    }
    match dice.below(15) {
        0..=2 => hands.run(dice.one(&all)),
        3 | 4 => {
            let middle = hands.on_plan(0.0, 0.0) + vec2(dice.below(160) as f32 - 80.0, 0.0);
            let radii = vec2(8.0 + dice.below(150) as f32, 8.0 + dice.below(120) as f32);
            hands.run(Command::Draw);
            let mut way = round(middle, radii, 8 + dice.below(50));
            way.truncate(3 + dice.below(60));
            hands.drag(&way);
        }
        5..=7 => {
            let from = dice.place(SIZE);
            let to = dice.place(SIZE);
            let way: Vec<Pos2> = (0..=6).map(|n| from.lerp(to, n as f32 / 6.0)).collect();
            hands.drag(&way);
        }
        8 => {
            let at = dice.place(SIZE);
            hands.drag(&[at, at]);
            if dice.below(2) == 0 {
                hands.drag(&[at, at]);
            }
        }
        9 => {
            let modifiers = dice.one(&[Modifiers::NONE, Modifiers::SHIFT, Modifiers::COMMAND]);
            hands.key(modifiers, dice.one(&KEYS));
        }
        10 => {
            hands.harness.event(Event::Text(dice.one(&WORDS).to_owned()));
            hands.step();
            hands.key(Modifiers::NONE, Key::Enter);
        }
        11 => {
            let curves = &hands.app().editor().document().design.curves;
            let Some(count) = curves.first().map(|curve| curve.points.len()) else { return };
            let at = sheetwright_editor::document::PointRef { curve: 0, point: dice.below(count) };
            let to = curves[0].points[at.point].at;
            let to =
                sheetwright::math::Point3::new(to.x, to.y, to.z + dice.below(90) as f64 - 40.0);
            let editor = hands.harness.state_mut().editor_mut();
            editor.carry_out(Act::Move(vec![(at, to)]));
            editor.carry_out(Act::Rest);
        }
        12 => {
            hands.harness.event(Event::MouseWheel {
                unit: MouseWheelUnit::Point,
                delta: vec2(0.0, dice.below(400) as f32 - 200.0),
                source: eframe::egui::MouseWheelSource::Unknown,
                phase: eframe::egui::TouchPhase::Move,
                modifiers: Modifiers::NONE,
            });
            hands.step();
        }
        13 => {
            let size = vec2(60.0 + dice.below(1400) as f32, 60.0 + dice.below(900) as f32);
            hands.harness.set_size(if dice.below(2) == 0 { SIZE.into() } else { size });
            hands.step();
        }
        _ => {
            let to_open = match dice.below(3) {
                0 => Opened {
                    path: "a.csv".to_owned(),
                    bytes: b"x,y,z\n0,0,0\n9,0,0\n9,9,3".to_vec(),
                },
                1 => Opened { path: "a.json".to_owned(), bytes: b"{}".to_vec() },
                _ => Opened { path: "a.sheet.json".to_owned(), bytes: written(hands) },
            };
            hands.disk.lock().unwrap().to_open = Some(to_open);
            hands.run(Command::Open);
        }
    }
    hands.step();
}

fn written(hands: &Hands) -> Vec<u8> {
    hands.app().editor().bytes()
}

/// Whether the document, as its file holds it, was read back equal; a drawing that is not done yet
/// (a curve of one point) makes no file that could be read.
fn check(hands: &Hands) -> bool {
    let document = hands.app().editor().document();
    let read = Document::read("a.sheet.json", &written(hands));
    assert_eq!(read.as_ref(), Ok(document));
    true
}

/// Back to the beginning, and on from there.
fn rewind(hands: &mut Hands) {
    let editor = hands.harness.state_mut().editor_mut();
    editor.carry_out(Act::Run(Command::Escape));
    editor.page = Page::Panes;
    while editor.history().steps_back() > 0 {
        let before = editor.history().steps_back();
        editor.carry_out(Act::Run(Command::Undo));
        assert!(editor.history().steps_back() < before);
    }
    hands.step();
}
