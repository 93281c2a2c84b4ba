//! Which parts there are, and where each lies on the paper.
//!
//! Panels whose pieces are the same part, maybe turned over, are one part that stands once (`gore
//! ×12`). All parts lie along the pane or all stand across it, with their dimensions or without,
//! with their names or without: whichever shows them largest, by a margin for each thing that is
//! left out. [`pack`](super::pack) finds the scale.
//!
//! What is arranged stays, with each part about the middle of its place, while a hand changes its
//! shape.

use super::pack::{CLEAR, Cell, Packed, largest};
use super::view::{PatternView, Placed};
use crate::scene::Scene;
use eframe::egui::{Pos2, Vec2, vec2};
use sheetwright::math::{Point2, Vec2 as Size};
use sheetwright::pattern::{EqualPiece, equal_pieces};

/// The room around parts and their texts, points.
const ROOM: f32 = 14.0;
/// The height of a name above its part.
pub(super) const NAME: f32 = 20.0;
/// The longer side of a part that is shown with its dimensions, points.
const LEAST_MEASURED: f32 = 72.0;
/// Parts stand where that shows them larger by this factor: else they lie as in files.
const STANDS: f64 = 1.25;
/// Dimensions are left out where parts are larger by this factor without them.
const BARE: f64 = 1.5;
/// Names, too, where parts are larger by this factor without either.
const NAMELESS: f64 = 2.0;
/// A scale this much smaller than the largest possible is not tried: only texts are left there.
const LEAST: f64 = 1e-4;
/// Where parts without texts don't fit, the paper is looked at from twice as far, at the most so
/// often.
const FARTHER: i32 = 12;

/// Panels whose pieces are alike and drawn once.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct AlikePieces {
    /// The panels, by their numbers.
    pub(super) members: Vec<usize>,
    /// Width and height of the piece as files have it, mm.
    size: Size,
}

/// How much room the texts of a part take, points.
pub(super) struct Texts {
    /// How wide its name is.
    pub(super) name: f32,
    /// How wide and how high its longer dimension is.
    pub(super) dimension: Vec2,
}

/// Room about a part for its dimensions, points.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Takes {
    pub(super) left: f32,
    pub(super) right: f32,
    pub(super) below: f32,
}

impl Takes {
    /// Whether there is so much room.
    pub(super) fn fits_into(self, free: Self) -> bool {
        self.left <= free.left && self.right <= free.right && self.below <= free.below
    }

    /// With half of what is between parts, which belongs to either.
    fn with_clear(self) -> Self {
        self.each(|taken| taken + 0.5 * CLEAR)
    }

    /// As it is seen from nearer or farther.
    fn scaled(self, by: f64) -> Self {
        self.each(|taken| taken * by as f32)
    }

    fn each(self, of: impl Fn(f32) -> f32) -> Self {
        Self { left: of(self.left), right: of(self.right), below: of(self.below) }
    }
}

/// The parts of all panels that were made, in the order of their first.
pub(super) fn parts(scene: &Scene<'_>) -> Vec<AlikePieces> {
    let made: Vec<_> = scene.made().collect();
    let groups = equal_pieces(made.iter().map(|(_, shown)| &shown.piece));
    let part = |group: Vec<EqualPiece>| AlikePieces {
        members: group.iter().map(|equal| made[equal.number].0).collect(),
        size: made[group[0].number].1.piece.size,
    };
    groups.into_iter().map(part).collect()
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
    pub(super) view: PatternView,
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
    /// What is free about it as it is looked at now, for its dimensions.
    pub(super) free: Takes,
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
    /// What is free about it for its dimensions: more than they take, where it was arranged to be
    /// shown with them. Points, as it was arranged.
    free: Takes,
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
        let Some(best) = best(&parts, &texts, takes, room) else { return Self::default() };
        let Best { cells, scale, packed, zoom } = best;
        let mm = |at: Pos2| Point2::new(f64::from(at.x) / scale, -f64::from(at.y) / scale);
        let slots = parts.iter().enumerate().map(|(n, part)| Slot {
            members: part.members.clone(),
            areas: part.members.iter().map(|&n| area(scene, n)).collect(),
            middle: mm(packed.middles[n]),
            turned: cells.way.turned,
            free: cells.takes(n, scale).with_clear().scaled(zoom),
        });
        let middle = mm((0.5 * packed.size).to_pos2());
        let view = PatternView { middle, mm_per_point: 1.0 / (zoom * scale) };
        Self { slots: slots.collect(), view, is_named: cells.way.is_named }
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
    pub(super) fn shown(
        &self,
        scene: &Scene<'_>,
        worst: Option<usize>,
        view: &PatternView,
    ) -> Vec<ShownPart> {
        let zoom = self.view.mm_per_point / view.mm_per_point;
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
            let piece = &scene.panels[panel].made.as_ref().ok()?.piece;
            let of_piece = [piece.corner, piece.corner + piece.size];
            let name = match changed {
                Some(n) => scene.panels[n].name.clone(),
                None => name(scene, &slot.members),
            };
            let placed = Placed::about(slot.middle, panel, of_piece, slot.turned);
            let free = slot.free.scaled(zoom);
            Some(ShownPart { placed, members: slot.members.clone(), name, free })
        };
        self.slots.iter().filter_map(place).collect()
    }
}

/// A piece whose area changed by more, as a share, has changed.
const CHANGED: f64 = 1e-6;

fn area(scene: &Scene<'_>, panel: usize) -> f64 {
    scene.panels[panel].made.as_ref().map_or(0.0, |shown| shown.area_flat_mm2)
}

/// What parts are shown with, and how they lie.
#[derive(Clone, Copy, Debug)]
struct Way {
    turned: bool,
    is_measured: bool,
    is_named: bool,
    /// Parts have to be larger by this factor than with everything, lying.
    by: f64,
}

/// All ways, the plainest last: a later one has to show parts larger.
fn ways() -> impl Iterator<Item = Way> {
    let kinds = [(true, true, 1.0), (false, true, BARE), (false, false, NAMELESS)];
    kinds.into_iter().flat_map(|(is_measured, is_named, by)| {
        let way = |turned, by| Way { turned, is_measured, is_named, by };
        [way(false, by), way(true, STANDS * by)]
    })
}

/// Parts and what there is to know of their texts, to be packed in a way at any scale, points for a
/// millimetre.
struct Cells<'a> {
    parts: &'a [AlikePieces],
    texts: &'a [Texts],
    takes: fn(Vec2, &Texts) -> Takes,
    way: Way,
}

impl Cells<'_> {
    /// The size of a part, mm.
    fn size_mm(&self, n: usize) -> Size {
        let Size { x, y } = self.parts[n].size;
        if self.way.turned { Size::new(y, x) } else { Size::new(x, y) }
    }

    fn size(&self, n: usize, scale: f64) -> Vec2 {
        let size = self.size_mm(n) * scale;
        vec2(size.x as f32, size.y as f32)
    }

    /// The room for the dimensions of a part.
    fn takes(&self, n: usize, scale: f64) -> Takes {
        let of = self.size(n, scale);
        let is_measured = self.way.is_measured && of.max_elem() >= LEAST_MEASURED;
        if is_measured { (self.takes)(of, &self.texts[n]) } else { Takes::default() }
    }

    fn cell(&self, n: usize, scale: f64) -> Cell {
        let of = self.size(n, scale);
        let takes = self.takes(n, scale);
        let (above, least) =
            if self.way.is_named { (NAME, self.texts[n].name) } else { (0.0, 0.0) };
        let wide = takes.left + of.x + takes.right;
        let size = vec2(wide.max(takes.left + least), above + of.y + takes.below);
        Cell { size, middle: vec2(takes.left + 0.5 * of.x, above + 0.5 * of.y) }
    }

    /// The scale at which the largest part alone fills the room.
    fn most(&self, room: Vec2) -> f64 {
        let fits = |n: usize| {
            let size = self.size_mm(n).max(Size::splat(1e-9));
            (f64::from(room.x) / size.x).min(f64::from(room.y) / size.y)
        };
        (0..self.parts.len()).map(fits).fold(f64::INFINITY, f64::min)
    }

    /// The largest scale above `least` times the largest possible at which all fit.
    fn largest(&self, room: Vec2, least: f64) -> Option<(f64, Packed)> {
        let most = self.most(room);
        let cells = |scale| (0..self.parts.len()).map(|n| self.cell(n, scale)).collect();
        largest(cells, room, least.max(LEAST * most), most)
    }
}

/// How parts are shown best, points.
struct Best<'a> {
    cells: Cells<'a>,
    scale: f64,
    packed: Packed,
    /// How much smaller that is shown: 1, or less where the room is too small for so many.
    zoom: f64,
}

/// The way that shows parts largest, each by its own margin.
fn best<'a>(
    parts: &'a [AlikePieces],
    texts: &'a [Texts],
    takes: fn(Vec2, &Texts) -> Takes,
    room: Vec2,
) -> Option<Best<'a>> {
    let cells = |way| Cells { parts, texts, takes, way };
    let mut best: Option<Best<'_>> = None;
    for way in ways() {
        let least = best.as_ref().map_or(0.0, |best| best.scale / best.cells.way.by);
        let cells = cells(way);
        if let Some((scale, packed)) = cells.largest(room, least * way.by) {
            best = Some(Best { cells, scale, packed, zoom: 1.0 });
        }
    }
    best.or_else(|| {
        let plain = ways().last()?;
        (1..FARTHER).find_map(|n| {
            let zoom = 0.5_f32.powi(n);
            let cells = cells(plain);
            let (scale, packed) = cells.largest(room / zoom, 0.0)?;
            Some(Best { cells, scale, packed, zoom: f64::from(zoom) })
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

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

    const TAKES: fn(Vec2, &Texts) -> Takes =
        |_, texts| Takes { left: texts.dimension.x, right: 0.0, below: texts.dimension.y };

    fn of(sizes: &[[f64; 2]]) -> (Vec<AlikePieces>, Vec<Texts>) {
        let part = |&[x, y]: &[f64; 2]| AlikePieces { members: vec![0], size: Size::new(x, y) };
        let texts = || Texts { name: 30.0, dimension: vec2(40.0, 27.0) };
        (sizes.iter().map(part).collect(), sizes.iter().map(|_| texts()).collect())
    }

    #[test]
    fn what_is_left_out_makes_parts_larger() {
        // A few have room for everything.
        let (parts, texts) = of(&[[300.0, 200.0], [250.0, 180.0]]);
        let found = best(&parts, &texts, TAKES, vec2(900.0, 400.0)).unwrap();
        assert!(found.cells.way.is_measured && found.cells.way.is_named);
        for sizes in [vec![[900.0, 80.0]; 4], vec![[900.0, 80.0]; 12], vec![[60.0, 50.0]; 60]] {
            let (parts, texts) = of(&sizes);
            let room = vec2(480.0, 230.0);
            let found = best(&parts, &texts, TAKES, room).unwrap();
            for way in ways() {
                let other = Cells { parts: &parts, texts: &texts, takes: TAKES, way };
                let Some((scale, _)) = other.largest(room, 0.0) else { continue };
                let gains = (scale / way.by) / (found.scale / found.cells.way.by);
                assert!(gains < 1.002, "{gains} by {way:?}");
            }
        }
    }

    #[test]
    fn ever_so_many_parts_are_in_sight() {
        let (parts, texts) = of(&vec![[60.0, 50.0]; 3000]);
        let room = vec2(480.0, 230.0);
        let Best { packed, zoom, .. } = best(&parts, &texts, TAKES, room).unwrap();
        let size = packed.size * zoom as f32;
        assert!(zoom < 1.0 && size.x <= room.x && size.y <= room.y, "{size} at {zoom}");
    }
}
