//! Which parts there are, and where each lies on the paper.
//!
//! Panels whose pieces are the same part, maybe turned over, are one part that stands once (`gore
//! ×12`). Parts lie in shelves, the highest first, each in the first shelf with room for it; all
//! lie along the pane or all stand across it, whichever shows them larger. Texts have the same size
//! however large parts are shown, so the scale is searched for: the largest at which parts and
//! texts fit into the pane. Where many parts would be small for their names, the names are left
//! out.
//!
//! What is arranged stays, with each part about the middle of its place, while a hand changes its
//! shape.

use super::view::{Placed, View};
use crate::scene::Scene;
use eframe::egui::{Pos2, Vec2, pos2, vec2};
use sheetwright::draw::alike::alike;
use sheetwright::math::{Point2, Vec2 as Way};

/// Pieces this near to one another in every corner are the same part, mm; less for small ones, as a
/// share of their size.
const ALIKE_MM: f64 = 0.05;
const ALIKE_SHARE: f64 = 1e-4;
/// The room around parts and their texts, points.
const ROOM: f32 = 14.0;
/// The room between parts, points.
const CLEAR: f32 = 12.0;
/// The height of a name above its part.
pub(super) const NAME: f32 = 20.0;
/// Parts stand where that shows them larger by this factor: else they lie as in files.
const STANDS: f64 = 1.25;
/// Names are left out where parts are larger by this factor without them.
const NAMELESS: f64 = 2.0;
/// Steps of the search for the scale: to a thousandth.
const STEPS: usize = 22;

/// Panels whose pieces are one part.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    /// The panels, by their numbers.
    pub(super) members: Vec<usize>,
    /// Width and height of the piece as files have it, mm.
    size: Way,
}

/// How much room the texts of a part take, points.
pub(super) struct Texts {
    /// How wide its name is.
    pub(super) name: f32,
    /// How wide and how high its longer dimension is.
    pub(super) dimension: Vec2,
}

/// What is left free about a part for its dimensions, points.
pub(super) struct Takes {
    pub(super) left: f32,
    pub(super) right: f32,
    pub(super) below: f32,
}

/// The parts of all panels that were made, in the order of their first.
pub(super) fn parts(scene: &Scene<'_>) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    for (panel, shown) in scene.made() {
        let size = shown.piece.size;
        let within = ALIKE_MM.min(ALIKE_SHARE * size.max_element());
        let is_of = |part: &&mut Part| {
            let first = scene.panels[part.members[0]].made.as_ref();
            first.is_ok_and(|first| alike(&first.piece, &shown.piece, within))
        };
        match parts.iter_mut().find(is_of) {
            Some(part) => part.members.push(panel),
            None => parts.push(Part { members: vec![panel], size }),
        }
    }
    parts
}

/// What a part is called: the name of its only panel, or what the names of its panels begin with,
/// and how many there are.
pub(super) fn name(scene: &Scene<'_>, members: &[usize]) -> String {
    let names: Vec<&str> = members.iter().map(|&n| scene.panels[n].name.as_str()).collect();
    match names[..] {
        [] => String::new(),
        [only] => only.to_owned(),
        [first, ..] => {
            let stem = stem(&names);
            format!("{} ×{}", if stem.is_empty() { first } else { stem }, names.len())
        }
    }
}

/// What all names begin with, in whole words and numbers.
fn stem<'a>(names: &[&'a str]) -> &'a str {
    let [first, others @ ..] = names else { return "" };
    let agree = |other: &&str| {
        let same = first.chars().zip(other.chars()).take_while(|(a, b)| a == b);
        same.map(|(a, _)| a.len_utf8()).sum::<usize>()
    };
    let mut shared = &first[..others.iter().map(agree).min().unwrap_or(first.len())];
    let kinds: [fn(char) -> bool; 2] = [char::is_alphabetic, char::is_numeric];
    for kind in kinds {
        let goes_on = |name: &&str| name[shared.len()..].starts_with(kind);
        if shared.ends_with(kind) && names.iter().any(goes_on) {
            shared = shared.trim_end_matches(kind);
            break;
        }
    }
    shared.trim_end_matches(|c: char| !c.is_alphanumeric())
}

/// The parts on the paper.
#[derive(Clone, Debug, Default)]
pub(super) struct Arrangement {
    slots: Vec<Slot>,
    /// How they are looked at so that all are in sight, in the middle of the pane.
    pub(super) view: View,
    /// Whether there is room for names.
    pub(super) is_named: bool,
}

/// A part as it is shown.
pub(super) struct ShownPart {
    /// The piece that stands for it, and where.
    pub(super) placed: Placed,
    /// The panels that it is for.
    pub(super) members: Vec<usize>,
    /// What it is called.
    pub(super) name: String,
}

/// The place of a part.
#[derive(Clone, Debug)]
struct Slot {
    members: Vec<usize>,
    /// The areas of the pieces when they were arranged, mm².
    areas: Vec<f64>,
    /// The middle of the part, mm.
    middle: Point2,
    /// Whether it stands: turned by a right angle.
    turned: bool,
}

impl Arrangement {
    /// The parts of a scene, as large as they fit into a room.
    pub(super) fn new(
        scene: &Scene<'_>,
        room: Vec2,
        texts: impl Fn(&[usize]) -> Texts,
        takes: fn(Vec2, &Texts) -> Takes,
    ) -> Self {
        let parts = parts(scene);
        if parts.is_empty() {
            return Self::default();
        }
        let texts: Vec<Texts> = parts.iter().map(|part| texts(&part.members)).collect();
        let room = (room - Vec2::splat(2.0 * ROOM)).max(Vec2::splat(40.0));
        let best = |is_named: bool| {
            let cells =
                |turned: bool| Cells { parts: &parts, texts: &texts, takes, turned, is_named };
            let [lying, standing] = [false, true].map(|turned| largest(&cells(turned), room));
            if standing.0 > STANDS * lying.0 { (standing, true) } else { (lying, false) }
        };
        let (named, nameless) = (best(true), best(false));
        let is_named = nameless.0.0 < NAMELESS * named.0.0;
        let ((scale, shelves), turned) = if is_named { named } else { nameless };
        let mm = |at: Pos2| Point2::new(f64::from(at.x) / scale, -f64::from(at.y) / scale);
        let slots = parts.iter().zip(&shelves.middles).map(|(part, &middle)| Slot {
            members: part.members.clone(),
            areas: part.members.iter().map(|&n| area(scene, n)).collect(),
            middle: mm(middle),
            turned,
        });
        let middle = mm((0.5 * shelves.size).to_pos2());
        let view = View { middle, mm_per_point: 1.0 / scale };
        Self { slots: slots.collect(), view, is_named }
    }

    /// Whether it is one of the panels that were made now.
    pub(super) fn is_of(&self, scene: &Scene<'_>) -> bool {
        let mut members: Vec<usize> = self.slots.iter().flat_map(|s| &s.members).copied().collect();
        members.sort_unstable();
        members.into_iter().eq(scene.made().map(|(n, _)| n))
    }

    /// Takes other shapes of the same parts as they are now; whether the parts are the same.
    pub(super) fn renewed(&mut self, scene: &Scene<'_>) -> bool {
        let parts = parts(scene);
        let is_same = parts.iter().map(|p| &p.members).eq(self.slots.iter().map(|s| &s.members));
        for slot in self.slots.iter_mut().filter(|_| is_same) {
            slot.areas = slot.members.iter().map(|&n| area(scene, n)).collect();
        }
        is_same
    }

    /// Every part with the panel that stands for it: one that has changed since it was arranged,
    /// else the one that is selected or that twists most of all, else the first.
    pub(super) fn shown(&self, scene: &Scene<'_>, worst: Option<usize>) -> Vec<ShownPart> {
        let place = |slot: &Slot| {
            let changed = slot.members.iter().zip(&slot.areas).map(|(&n, &was)| {
                let now = area(scene, n);
                ((now - was).abs() / was.abs().max(now).max(f64::MIN_POSITIVE), n)
            });
            let most = changed.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
            let mut wished = [scene.selection.panel, worst].into_iter().flatten();
            let wished = wished.find(|n| slot.members.contains(n));
            let changed = most.filter(|(share, _)| *share > CHANGED).map(|(_, n)| n);
            let panel = changed.or(wished).or(slot.members.first().copied())?;
            let size = scene.panels[panel].made.as_ref().ok()?.piece.size;
            let name = match changed {
                Some(n) => scene.panels[n].name.clone(),
                None => name(scene, &slot.members),
            };
            let placed = Placed::about(slot.middle, panel, size, slot.turned);
            Some(ShownPart { placed, members: slot.members.clone(), name })
        };
        self.slots.iter().filter_map(place).collect()
    }
}

/// A piece whose area changed by more, as a share, has changed.
const CHANGED: f64 = 1e-6;

fn area(scene: &Scene<'_>, panel: usize) -> f64 {
    scene.panels[panel].made.as_ref().map_or(0.0, |shown| shown.area_flat_mm2)
}

/// What is to be packed, for any scale.
struct Cells<'a> {
    parts: &'a [Part],
    texts: &'a [Texts],
    takes: fn(Vec2, &Texts) -> Takes,
    turned: bool,
    is_named: bool,
}

impl Cells<'_> {
    /// A part with its texts at a scale, points for a millimetre: how large it is, and where the
    /// middle of the part lies in it.
    fn cell(&self, n: usize, scale: f64) -> (Vec2, Vec2) {
        let of = self.parts[n].size * scale;
        let of = if self.turned {
            vec2(of.y as f32, of.x as f32)
        } else {
            vec2(of.x as f32, of.y as f32)
        };
        let takes = (self.takes)(of, &self.texts[n]);
        let (above, least) = if self.is_named { (NAME, self.texts[n].name) } else { (0.0, 0.0) };
        let wide = takes.left + of.x + takes.right;
        let size = vec2(wide.max(takes.left + least), above + of.y + takes.below);
        (size, vec2(takes.left + 0.5 * of.x, above + 0.5 * of.y))
    }
}

/// Where the middles of parts lie, and the box around all, points.
struct Shelves {
    middles: Vec<Pos2>,
    size: Vec2,
}

/// The largest scale at which all fit into the room, nearly, and how they lie there.
fn largest(cells: &Cells<'_>, room: Vec2) -> (f64, Shelves) {
    let size =
        |part: &Part| if cells.turned { Way::new(part.size.y, part.size.x) } else { part.size };
    let fits = |part: &Part| {
        let size = size(part).max(Way::splat(1e-9));
        (f64::from(room.x) / size.x).min(f64::from(room.y) / size.y)
    };
    // Between these, as powers: no part alone is larger, and with none smaller are there only
    // texts.
    let most = cells.parts.iter().map(fits).fold(f64::INFINITY, f64::min);
    let (mut low, mut high) = (1e-4 * most, most);
    for _ in 0..STEPS {
        let scale = (low * high).sqrt();
        let shelves = shelved(cells, scale, room.x);
        if shelves.size.x <= room.x && shelves.size.y <= room.y {
            low = scale;
        } else {
            high = scale;
        }
    }
    (low, shelved(cells, low, room.x))
}

/// Parts on shelves of a width, the highest first, each on the first with room for it.
fn shelved(cells: &Cells<'_>, scale: f64, width: f32) -> Shelves {
    struct Shelf {
        top: f32,
        height: f32,
        taken: f32,
    }
    let all: Vec<(Vec2, Vec2)> = (0..cells.parts.len()).map(|n| cells.cell(n, scale)).collect();
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by(|&a, &b| all[b].0.y.total_cmp(&all[a].0.y));
    let mut shelves: Vec<Shelf> = Vec::new();
    let mut middles = vec![Pos2::ZERO; all.len()];
    for n in order {
        let (size, middle) = all[n];
        let found = shelves.iter().position(|s| s.taken + CLEAR + size.x <= width);
        let at = found.unwrap_or_else(|| {
            let top = shelves.last().map_or(0.0, |last| last.top + last.height + CLEAR);
            shelves.push(Shelf { top, height: size.y, taken: -CLEAR });
            shelves.len() - 1
        });
        let shelf = &mut shelves[at];
        middles[n] = pos2(shelf.taken + CLEAR, shelf.top) + middle;
        shelf.taken += CLEAR + size.x;
    }
    let across = shelves.iter().map(|s| s.taken).fold(0.0, f32::max);
    let down = shelves.last().map_or(0.0, |last| last.top + last.height);
    Shelves { middles, size: vec2(across, down) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::Rect;

    #[test]
    fn names_share_whole_words_and_numbers() {
        for (names, wanted) in [
            (&["gore-1", "gore-10", "gore-11"][..], "gore"),
            (&["band-1-1", "band-1-2", "band-1-12"], "band-1"),
            (&["port-side", "port-stern"], "port"),
            (&["strake 2 port", "strake 2 starboard"], "strake 2"),
            (&["panel1", "panel2"], "panel"),
            (&["outline", "outline 2"], "outline"),
            (&["lid", "floor"], ""),
            (&["ä-1", "ä-2"], "ä"),
        ] {
            assert_eq!(stem(names), wanted);
        }
    }

    fn cells(sizes: &[[f64; 2]]) -> (Vec<Part>, Vec<Texts>) {
        let part = |&[x, y]: &[f64; 2]| Part { members: vec![0], size: Way::new(x, y) };
        let texts = || Texts { name: 30.0, dimension: vec2(40.0, 14.0) };
        (sizes.iter().map(part).collect(), sizes.iter().map(|_| texts()).collect())
    }

    #[test]
    fn parts_fit_without_covering_one_another_and_fill_the_room() {
        let takes: fn(Vec2, &Texts) -> Takes = |of, texts| {
            let room = if of.max_elem() > 72.0 { texts.dimension.x } else { 0.0 };
            Takes { left: room, right: 0.0, below: 0.5 * room }
        };
        let alike: Vec<[f64; 2]> = vec![[900.0, 80.0]; 12];
        let mixed: Vec<[f64; 2]> =
            (1..30).map(|n| [20.0 * f64::from(n), 300.0 / f64::from(n)]).collect();
        for sizes in [&[[300.0, 200.0]][..], &alike, &mixed] {
            for room in [vec2(640.0, 260.0), vec2(300.0, 500.0)] {
                let (parts, texts) = cells(sizes);
                let cells =
                    |turned| Cells { parts: &parts, texts: &texts, takes, turned, is_named: true };
                for turned in [false, true] {
                    let cells = cells(turned);
                    let (scale, shelves) = largest(&cells, room);
                    assert!(shelves.size.x <= room.x && shelves.size.y <= room.y);
                    let boxes: Vec<Rect> = (0..parts.len())
                        .map(|n| {
                            let (size, middle) = cells.cell(n, scale);
                            Rect::from_min_size(shelves.middles[n] - middle, size)
                        })
                        .collect();
                    for (n, a) in boxes.iter().enumerate() {
                        assert!(boxes[..n].iter().all(|b| !a.shrink(0.01).intersects(*b)));
                    }
                    let larger = shelved(&cells, 1.02 * scale, room.x).size;
                    assert!(larger.x > room.x || larger.y > room.y, "{scale}");
                }
            }
        }
    }
}
