//! Places for the texts of a piece: inside it, clear of one another and of lines.
//!
//! Texts are placed one after the other, the most important one first, and never moved again. Each
//! has candidates: beside its line at some shares of it, or places of a grid, by their distance
//! from the outline. A text tries the standard heights of letters from the one that it should have
//! downwards, and takes the first candidate that crosses no line; else the largest that crosses
//! lines to read alone; else a leader: it stands beside the piece, and a line leads to where it
//! belongs. This is the greedy method for the labels of maps \[ChristensenMarksShieber1995\].

use super::text_box::TextBox;
use super::wish::{Instead, Wish, WishAt, along, upright};
use super::{LabelKind, PathKind, PatternLabel, PatternPath, Role, Room, Spot};
use sheetwright_geometry::math::{Point2, Vec2, cos, from_deg, sin, unit2};
use sheetwright_geometry::predicate::Box2;

/// Heights of capitals in ISO 3098, mm, without those that are too low to be engraved or too high
/// for a name.
const HEIGHTS_MM: [f64; 8] = [20.0, 14.0, 10.0, 7.0, 5.0, 3.5, 2.5, 1.8];
/// Room around a text, as a share of its height.
const AROUND: f64 = 0.2;
/// Places that are tried for a text that may stand anywhere.
const TRIED: usize = 80;
/// Places that are tried for one near a point.
const TRIED_NEAR: usize = 40;
/// A text that may stand anywhere is written this much lower at the most to be clear of lines to
/// read.
const LOWER: f64 = 0.5;
/// Letters beside a piece are no higher.
const LEADER_MM: f64 = 5.0;
/// A piece is large beside a text if its diagonal is longer by this factor.
const LARGE: f64 = 6.0;
/// A text that may stand anywhere has as many places that its leader may begin at.
const ANCHORS: usize = 16;
/// The directions in which a place beside the piece is looked for.
const LEADERS: u16 = 32;
/// A leader is longer than the last one that was tried by this factor.
const LONGER: f64 = 1.25;
/// A leader begins this share of its length away from its foot where lines are looked for that it
/// crosses.
const CLEAR_OF_FOOT: f64 = 0.02;
/// Leaders that are tried in each direction.
const LONGEST: usize = 48;
/// Likewise of short ones: the longest is about ten times as long as letters are high.
const LONGEST_SHORT: usize = 10;

/// The standard height at or below this one, mm.
pub(super) fn standard_mm(height_mm: f64) -> f64 {
    let lower = HEIGHTS_MM.into_iter().find(|&standard| standard <= height_mm);
    lower.unwrap_or(HEIGHTS_MM[HEIGHTS_MM.len() - 1])
}

/// The line that leads to a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Leader {
    /// As short as can be.
    Any,
    /// Likewise, and so short that an eye follows it among many.
    Short,
    /// Likewise, and across no line of the piece.
    Plain,
}

/// What crosses a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Crossed {
    /// Nothing.
    Clear,
    /// Lines to read.
    Notes,
    /// Lines that are drawn or scored.
    Marks,
    /// The edge of the piece, or another text.
    Edge,
}

/// The lines and texts of a piece, and the texts that find a place between them.
pub(super) struct Placer {
    room: Room,
    /// Places inside the piece, the farthest from its lines first.
    places: Vec<Spot>,
    lines: Lines,
    boxes: Vec<TextBox>,
    /// The texts, with the places that they have.
    pub(super) labels: Vec<PatternLabel>,
    /// The lines that lead to texts beside the piece.
    pub(super) leaders: Vec<PatternPath>,
}

impl Placer {
    /// That of a piece with these paths, beside these texts. Names look at some places of their own
    /// beside those of a grid.
    pub(super) fn new(
        room: Room,
        paths: &[PatternPath],
        fixed: &[PatternLabel],
        places: Vec<Point2>,
    ) -> Self {
        let places = room.places(places);
        let mut lines = Lines::around(room.around());
        for path in paths {
            let crossed = match (path.role, path.kind) {
                (role, _) if role.is_cut() || role == Role::Net => Crossed::Edge,
                (Role::Note, kind) if kind != PathKind::Dimension => Crossed::Notes,
                _ => Crossed::Marks,
            };
            let last = path.points.last().filter(|_| path.closed).zip(path.points.first());
            let steps = path.points.windows(2).map(|step| [step[0], step[1]]);
            steps.chain(last.map(|(a, b)| [*a, *b])).for_each(|step| lines.add(step, crossed));
        }
        let boxes = fixed.iter().map(TextBox::of).collect();
        Self { room, places, lines, boxes, labels: Vec::new(), leaders: Vec::new() }
    }

    /// Whether a text that has its place inside the piece crosses no line that is cut or drawn, and
    /// no other text. Its tails may, since marks have none.
    pub(super) fn is_free(&self, label: &PatternLabel) -> bool {
        let text = TextBox::of(label);
        let letters = text.without_tails(label.height_mm);
        self.room.holds(text.middle)
            && !self.boxes.iter().any(|other| other.overlaps(&letters))
            && self.lines.crossed(&letters) <= Crossed::Notes
    }

    /// Whether a text that has its place beyond an edge crosses nothing at all.
    pub(super) fn is_free_beyond(&self, label: &PatternLabel) -> bool {
        let text = TextBox::of(label);
        self.is_clear_beside(&text.without_tails(label.height_mm))
    }

    /// Whether a text stands beside the piece, with nothing in its way.
    fn is_clear_beside(&self, text: &TextBox) -> bool {
        !self.room.holds(text.middle)
            && self.lines.crossed(text) <= Crossed::Notes
            && !self.boxes.iter().any(|other| other.overlaps(text))
    }

    /// A mark of an edge as near as can be beside the piece, with a line that leads there from its
    /// foot on the edge, across no other if there is such a place; `None` where none is near.
    pub(super) fn led(&mut self, label: &PatternLabel, foot: Point2) -> Option<PatternLabel> {
        let (letters, height_mm) = (label.text.chars().count(), label.height_mm);
        let anchors = [(foot, -label.along.perp())];
        let place = |leader| self.beside(&anchors, letters, height_mm, false, leader);
        let (at, along, leader) = place(Leader::Plain).or_else(|| place(Leader::Short))?;
        self.add_leader(leader);
        Some(PatternLabel { role: Role::Note, at, along, ..label.clone() })
    }

    fn add_leader(&mut self, leader: [Point2; 2]) {
        self.lines.add(leader, Crossed::Marks);
        let (role, kind, points) = (Role::Note, PathKind::Leader, leader.to_vec());
        self.leaders.push(PatternPath { role, kind, points, closed: false });
    }

    /// Keeps other texts clear of one that has its place.
    pub(super) fn keep(&mut self, label: &PatternLabel) {
        self.boxes.push(TextBox::of(label));
    }

    /// Places a text whose letters should be so high, mm.
    pub(super) fn place(&mut self, wish: &Wish, height_mm: f64) {
        let most_mm = standard_mm(wish.height_mm.unwrap_or(height_mm));
        let heights = HEIGHTS_MM.into_iter().filter(|&height| height <= most_mm);
        for text in &wish.texts {
            let letters = text.chars().count();
            // The best of each kind of crossing, the largest of equals.
            let mut best: [Option<PatternLabel>; 2] = [None, None];
            for height_mm in heights.clone() {
                let found = self.best(wish, letters, height_mm);
                for (best, place) in best.iter_mut().zip(found) {
                    let label = |(at, along)| label(wish, wish.role, at, along, height_mm, text);
                    *best = best.take().or(place.map(label));
                }
            }
            let [clear, across] = best;
            let is_high = |label: &PatternLabel| {
                wish.instead == Instead::Nothing || label.height_mm >= LOWER * most_mm
            };
            let found = match (clear, across.filter(|_| wish.instead != Instead::Nothing)) {
                (Some(clear), Some(across)) if !is_high(&clear) => Some(across),
                (clear, across) => clear.or(across),
            };
            if let Some(label) = found {
                self.boxes.push(TextBox::of(&label));
                self.labels.push(label);
                return;
            }
        }
        if wish.instead == Instead::Leader {
            self.lead(wish, most_mm);
        }
    }

    /// The first candidate of this height that crosses nothing, and the first that crosses lines to
    /// read alone: the middle of its base line, and its direction.
    fn best(&self, wish: &Wish, letters: usize, height_mm: f64) -> [Option<(Point2, Vec2)>; 2] {
        let mut across = None;
        let candidates = wish.at.iter().flat_map(|at| self.candidates(at, height_mm));
        for (at, along) in candidates {
            let text = TextBox::new(letters, at, along, height_mm).grown(AROUND * height_mm);
            match self.crossed(&text) {
                Crossed::Clear => return [Some((at, along)), across.or(Some((at, along)))],
                Crossed::Notes => across = across.or(Some((at, along))),
                Crossed::Marks | Crossed::Edge => {}
            }
        }
        [None, across]
    }

    /// What crosses a text.
    fn crossed(&self, text: &TextBox) -> Crossed {
        if self.boxes.iter().any(|other| other.overlaps(text)) || !self.room.holds(text.middle) {
            return Crossed::Edge;
        }
        self.lines.crossed(text)
    }

    /// The middles of base lines and directions that a text may have, the best first.
    fn candidates(&self, at: &WishAt, height_mm: f64) -> Vec<(Point2, Vec2)> {
        match at {
            WishAt::Anywhere => {
                // Half of a text is at least this far from the outline.
                let least_mm = (0.75 + AROUND) * height_mm;
                let places = self.places.iter().take(TRIED);
                level_first(places.filter(|spot| spot.clearance_mm >= least_mm), height_mm)
            }
            WishAt::Near(point) => {
                let off = |spot: &&Spot| spot.at.distance(*point);
                let mut places: Vec<&Spot> = self.places.iter().collect();
                places.sort_by(|a, b| off(a).total_cmp(&off(b)));
                let mut found = level_first([&self.room.spot(*point)], height_mm);
                found.extend(level_first(places.into_iter().take(TRIED_NEAR), height_mm));
                found
            }
            WishAt::Beside { line, shares, is_left, away_mm } => {
                let farther = [0.0, 1.5 * height_mm].map(|farther| away_mm + farther);
                beside(line, shares, *is_left, &farther, height_mm)
            }
            WishAt::Along { line, shares } => beside(line, shares, false, &[0.0], height_mm),
        }
    }

    /// Places a text beside the piece, with a line that leads to where it belongs: as near as can
    /// be, and straight outwards if possible. Round a small piece, texts stand like rays, so that
    /// they don't bar the way to others.
    fn lead(&mut self, wish: &Wish, most_mm: f64) {
        let Some(text) = wish.texts.first() else { return };
        let letters = text.chars().count();
        let height_mm = most_mm.min(LEADER_MM);
        let Box2 { min, max } = self.room.around();
        let is_large = min.distance(max) > LARGE * letters as f64 * height_mm;
        let anchors = self.anchors(wish);
        let rays = || self.beside(&anchors, letters, height_mm, false, Leader::Any);
        let level = || self.beside(&anchors, letters, height_mm, true, Leader::Any);
        let level = is_large.then(level).flatten();
        let Some((at, along, leader)) = level.or_else(rays) else { return };
        let label = label(wish, Role::Note, at, along, height_mm, text);
        self.boxes.push(TextBox::of(&label));
        self.labels.push(label);
        self.add_leader(leader);
    }

    /// The nearest place beside the piece for a text, level or like a ray: the middle of its base
    /// line, its direction, and its leader.
    fn beside(
        &self,
        anchors: &[(Point2, Vec2)],
        letters: usize,
        height_mm: f64,
        is_level: bool,
        leader: Leader,
    ) -> Option<(Point2, Vec2, [Point2; 2])> {
        let half_mm = 0.5 * letters as f64 * height_mm;
        let mut away_mm = 1.5 * height_mm;
        let is_plain = leader == Leader::Plain;
        let longest = if leader == Leader::Any { LONGEST } else { LONGEST_SHORT };
        for _ in 0..longest {
            for n in 0..LEADERS {
                // By turns to both sides.
                let turn = from_deg(360.0 * f64::from(n.div_ceil(2)) / f64::from(LEADERS));
                let turn = if n % 2 == 0 { turn } else { -turn };
                for &(anchor, out) in anchors {
                    let way = out * cos(turn) + out.perp() * sin(turn);
                    let (middle, along) = match is_level {
                        // The box is wider than it is high.
                        true => (anchor + way * away_mm + Vec2::X * (way.x * half_mm), Vec2::X),
                        false => (anchor + way * (away_mm + half_mm), upright(way)),
                    };
                    let at = TextBox::base(middle, along, height_mm);
                    let text = TextBox::new(letters, at, along, height_mm);
                    let leader = [anchor, text.nearest(anchor)];
                    let is_crossed = || is_plain && self.crosses(leader);
                    if self.is_beside(&text.grown(AROUND * height_mm), leader) && !is_crossed() {
                        return Some((at, along, leader));
                    }
                }
            }
            away_mm *= LONGER;
        }
        None
    }

    /// Where the leader of a text may begin, with the direction outwards.
    fn anchors(&self, wish: &Wish) -> Vec<(Point2, Vec2)> {
        let Box2 { min, max } = self.room.around();
        let middle = min.lerp(max, 0.5);
        let outwards = |at: Point2| (at, unit2(at - middle).unwrap_or(Vec2::X));
        match &wish.at[0] {
            WishAt::Anywhere => {
                self.places.iter().take(ANCHORS).map(|spot| outwards(spot.at)).collect()
            }
            WishAt::Near(at) => vec![outwards(*at)],
            WishAt::Along { line, shares } => {
                let places = shares.iter().filter_map(|&share| along(line, share));
                places.map(|(at, _)| outwards(at)).collect()
            }
            WishAt::Beside { line, shares, is_left, .. } => {
                let places = shares.iter().filter_map(|&share| along(line, share));
                let anchor = |(at, way): (Point2, Vec2)| match is_left {
                    true => (at, -way.perp()),
                    false => outwards(at),
                };
                places.map(anchor).collect()
            }
        }
    }

    /// Whether a text stands beside the piece, with nothing in its way, and its leader passes no
    /// other text.
    fn is_beside(&self, text: &TextBox, leader: [Point2; 2]) -> bool {
        self.is_clear_beside(text) && !self.boxes.iter().any(|other| other.meets(leader))
    }

    /// Whether a leader crosses a line of the piece, beside that on which it begins.
    fn crosses(&self, [from, to]: [Point2; 2]) -> bool {
        let from = from.lerp(to, CLEAR_OF_FOOT);
        let (along, half_mm) = (unit2(to - from).unwrap_or(Vec2::X), 0.5 * from.distance(to));
        let (middle, half) = (from.lerp(to, 0.5), Vec2::new(half_mm, 0.0));
        self.lines.crossed(&TextBox { middle, along, half }) > Crossed::Notes
    }
}

/// Texts about some places: level ones, then those along the nearest line of the piece, and upright
/// ones.
fn level_first<'a>(
    places: impl IntoIterator<Item = &'a Spot>,
    height_mm: f64,
) -> Vec<(Point2, Vec2)> {
    let text = |middle, along| (TextBox::base(middle, along, height_mm), along);
    let (mut level, mut turned) = (Vec::new(), Vec::new());
    for spot in places {
        let beside = unit2(spot.way).map(upright);
        level.push(text(spot.at, Vec2::X));
        turned.extend(beside.into_iter().chain([Vec2::Y]).map(|along| text(spot.at, along)));
    }
    level.extend(turned);
    level
}

/// Texts beside a line, so far away from it, mm, or a little farther.
fn beside(
    line: &[Point2],
    shares: &[f64],
    is_left: bool,
    away_mm: &[f64],
    height_mm: f64,
) -> Vec<(Point2, Vec2)> {
    let mut found = Vec::new();
    for away_mm in away_mm {
        for (at, way) in shares.iter().filter_map(|&share| along(line, share)) {
            let along = upright(way);
            for side in if is_left { &[1.0][..] } else { &[1.0, -1.0] } {
                let way = way.perp() * *side;
                // Feet or heads towards the line.
                let feet = if along.perp().dot(way) > 0.0 { 0.6 } else { 1.4 };
                found.push((at + way * (away_mm + feet * height_mm), along));
            }
        }
    }
    found
}

fn label(
    wish: &Wish,
    role: Role,
    at: Point2,
    along: Vec2,
    height_mm: f64,
    text: &str,
) -> PatternLabel {
    let kind: LabelKind = wish.kind;
    PatternLabel { kind, role, at, along, height_mm, text: text.to_owned() }
}

/// Segments in the cells of a grid.
struct Lines {
    around: Box2,
    segments: Vec<([Point2; 2], Crossed)>,
    /// The numbers of the segments in each cell, row after row.
    cells: Vec<Vec<u32>>,
}

/// Cells along each side of the grid.
const CELLS: usize = 24;

impl Lines {
    fn around(around: Box2) -> Self {
        Self { around, segments: Vec::new(), cells: vec![Vec::new(); CELLS * CELLS] }
    }

    /// The cells that a box touches: columns and rows. What lies beside the grid is in its cells at
    /// the border.
    fn cells(&self, of: &Box2) -> [std::ops::RangeInclusive<usize>; 2] {
        let size = self.around.max - self.around.min;
        let cell = |at: f64, low: f64, size: f64| {
            let n = (CELLS as f64 * (at - low) / size).floor();
            // The conversion saturates; of no number it is 0.
            (n as usize).min(CELLS - 1)
        };
        let column = |x: f64| cell(x, self.around.min.x, size.x);
        let row = |y: f64| cell(y, self.around.min.y, size.y);
        [column(of.min.x)..=column(of.max.x), row(of.min.y)..=row(of.max.y)]
    }

    fn add(&mut self, segment: [Point2; 2], crossed: Crossed) {
        let number = self.segments.len() as u32;
        let [columns, rows] = self.cells(&Box2::of_segment(segment[0], segment[1]));
        for row in rows {
            for column in columns.clone() {
                self.cells[row * CELLS + column].push(number);
            }
        }
        self.segments.push((segment, crossed));
    }

    /// What crosses a text, other texts aside.
    fn crossed(&self, text: &TextBox) -> Crossed {
        let [columns, rows] = self.cells(&text.around());
        let mut worst = Crossed::Clear;
        for row in rows {
            for column in columns.clone() {
                for &number in &self.cells[row * CELLS + column] {
                    let (segment, crossed) = self.segments[number as usize];
                    if crossed > worst && text.meets(segment) {
                        worst = crossed;
                    }
                }
                if worst == Crossed::Edge {
                    return worst;
                }
            }
        }
        worst
    }
}
