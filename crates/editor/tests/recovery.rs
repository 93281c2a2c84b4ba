//! Kills a program at any moment and looks what is left of its work: it must be whole, and nothing
//! older than two seconds may be missing.
//!
//! The program that is killed is this one, with a variable set. Every second time it is the whole
//! editor but for the card: a handle is lifted with every frame. In between it is the autosave
//! alone, with up to a megabyte every few milliseconds. Both print the number of each version with
//! the time when it was made.

#![allow(clippy::print_stdout, clippy::unwrap_used, missing_docs)] // a test that runs itself

mod hands;

use hands::Hands;
use sheetwright::math::{Point2, Point3};
use sheetwright_editor::command::Command as Asked;
use sheetwright_editor::document::Draft;
use sheetwright_editor::document::{Edit, PointRef};
use sheetwright_editor::scene::Act;
use sheetwright_editor::store::{Autosave, Store};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

const CHILD: &str = "SHEETWRIGHT_TEST_CHILD";
const KILLS: usize = 50;
/// Programs that run at a time.
const BESIDE: usize = 10;
/// What may be lost.
const MOST: Duration = Duration::from_secs(2);

fn main() {
    if let Ok(number) = std::env::var(CHILD) {
        return if is_editor(number.parse().unwrap()) { edit() } else { work() };
    }
    let next = AtomicUsize::new(0);
    let lost = std::thread::scope(|scope| {
        let run = || {
            let mut lost = Vec::new();
            loop {
                let n = next.fetch_add(1, Ordering::Relaxed);
                if n >= KILLS {
                    return lost;
                }
                lost.push(killed(n));
            }
        };
        let threads: Vec<_> = (0..BESIDE).map(|_| scope.spawn(run)).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect::<Vec<_>>()
    });
    assert_eq!(lost.len(), KILLS);
    let most = lost.iter().max().unwrap();
    println!("killed {KILLS} times, lost at most the last {} ms", most.as_millis());
}

/// Kills a program at the `n`th moment; how old the oldest change was that got lost.
fn killed(n: usize) -> Duration {
    let folder = tempfile::tempdir().unwrap();
    let mut child = Command::new(std::env::current_exe().unwrap())
        .env(CHILD, n.to_string())
        .env("SHEETWRIGHT_DATA", folder.path())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let lines = BufReader::new(child.stdout.take().unwrap()).lines();
    let reader = std::thread::spawn(move || lines.map_while(Result::ok).collect::<Vec<_>>());
    // From before the first save is through to many saves later.
    std::thread::sleep(Duration::from_micros(50_000 + random(n as u64) % 4_500_000));
    let killed_at = now();
    child.kill().unwrap();
    child.wait().unwrap();

    let made: Vec<(u64, Duration)> = reader
        .join()
        .unwrap()
        .iter()
        .filter_map(|line| {
            let (version, time) = line.split_once(' ')?;
            Some((version.parse().ok()?, Duration::from_micros(time.parse().ok()?)))
        })
        .collect();
    assert!(made.windows(2).all(|pair| pair[0].0 + 1 == pair[1].0), "every version is printed");

    let found = recovered(folder.path(), is_editor(n));
    let lost = made.iter().find(|(version, _)| *version > found);
    let lost = lost.map_or(Duration::ZERO, |(_, time)| killed_at.saturating_sub(*time));
    assert!(lost <= MOST, "kill {n}: of {} versions, {found} is found: {lost:?} lost", made.len());
    lost
}

/// Whether the program that is killed the `n`th time is the whole editor.
fn is_editor(n: usize) -> bool {
    n % 2 == 1
}

/// The version that is found in the folder, 0 for none.
fn recovered(folder: &Path, of_editor: bool) -> u64 {
    let mut store = Store::open_at(folder).unwrap();
    let found = store.load_all();
    assert!(found.len() <= 1);
    let Some(found) = found.first() else { return 0 };
    let version = if of_editor {
        let found = Draft::read(&found.bytes).unwrap().document;
        let lifted = found.design.curves.first().map_or(0.0, |curve| curve.points[0].at.z);
        assert_eq!(lifted.fract(), 0.0);
        lifted as u64
    } else {
        let version = u64::from_le_bytes(*found.bytes.first_chunk().unwrap());
        assert!(found.bytes == document(version), "version {version} is whole");
        version
    };
    store.remove(&found.slot).unwrap();
    assert_eq!(store.load_all(), []);
    version
}

/// The program that is killed.
fn work() {
    let mut autosave = Autosave::new(Store::open().unwrap(), 0);
    let mut out = std::io::stdout().lock();
    for version in 1.. {
        writeln!(out, "{version} {}", now().as_micros()).unwrap();
        out.flush().unwrap();
        autosave.frame(version, Instant::now(), || Box::new(move || document(version)));
        assert_eq!(autosave.problem(), None);
        std::thread::sleep(Duration::from_millis(1 + random(version) % 8));
    }
}

/// The whole editor, in which a handle is lifted by a millimetre with every frame.
fn edit() {
    let mut hands = Hands::new([900.0, 600.0], false);
    hands.harness.state_mut().keep_in(Store::open().unwrap());
    hands.run(Asked::New);
    let corners = [[0.0, 0.0], [300.0, 0.0], [300.0, 200.0], [0.0, 200.0]];
    let corners = corners.map(|[x, y]| Point2::new(x, y)).to_vec();
    let drawn = Act::Edit(Edit::Corners { corners, closed: true });
    hands.harness.state_mut().editor_mut().carry_out(drawn);
    let mut out = std::io::stdout().lock();
    for version in 1.. {
        let first = PointRef { curve: 0, point: 0 };
        let to = Point3::new(0.0, 0.0, version as f64);
        let editor = hands.harness.state_mut().editor_mut();
        editor.carry_out(Act::Move(vec![(first, to)]));
        editor.carry_out(Act::Rest);
        writeln!(out, "{version} {}", now().as_micros()).unwrap();
        out.flush().unwrap();
        hands.step();
        std::thread::sleep(Duration::from_millis(1 + random(version) % 8));
    }
}

/// A document of some length, up to a megabyte, no part of which is like that of another version.
fn document(version: u64) -> Vec<u8> {
    let words = 1 + random(version) % 125_000;
    let words = (1..words).map(|n| random(version << 20 | n));
    std::iter::once(version).chain(words).flat_map(u64::to_le_bytes).collect()
}

/// A pseudo-random number of 64 bits from a seed, alike on all machines (splitmix64).
fn random(seed: u64) -> u64 {
    let mut x = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ x >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ x >> 31
}

fn now() -> Duration {
    SystemTime::now().duration_since(UNIX_EPOCH).unwrap()
}
