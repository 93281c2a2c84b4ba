//! Equal parts side by side, so that one cut parts two.
//!
//! Where cuts may be in common, parts lie a kerf apart. The search alone seldom lays two straight
//! sides along each other, so blocks of equal parts are made first: a block and its image, moved or
//! turned by half a turn so that their longest straight sides face each other, are a block of twice
//! as many. What is then laid out are blocks. Where a block finds no room, smaller ones are tried,
//! at last single parts.

use super::{Nest, NestForm, NestOptions, NestPart, NestSheet, Placement, Turns, laid_out};
use crate::flatten::convex_hull;
use sheetwright_geometry::math::{Point2, Vec2, unit2};
use sheetwright_geometry::offset::grown;
use sheetwright_geometry::predicate::{Box2, signed_area_doubled};
use sheetwright_geometry::region::{Region, common_mm2};
use sheetwright_geometry::watch::Watch;
use std::f64::consts::PI;

/// The most parts of a block.
const MOST: usize = 64;
/// ... where larger ones find no room.
const FEW: usize = 8;
/// The most corners of a block: all are looked at for each place beside it.
const MOST_CORNERS: usize = 4000;
/// Facing sides lie so much farther apart than a kerf, mm, that rounding brings none nearer.
const SAFE_MM: f64 = 2e-3;
/// A block covers this share of the box of a sheet at the most, or the rest of it is wasted.
const OF_SHEET: f64 = 0.5;
/// A side that is shorter than this share of the longest side of its box is no side to join.
const LEAST_SIDE: f64 = 0.2;
/// A block fills as much of its hull as its halves do, but for this share.
const FILLED: f64 = 0.95;
/// So many of the longest sides are tried.
const TRIED: usize = 6;
/// Sides are parallel, or one line, where the sine between them is smaller.
const PARALLEL: f64 = 1e-6;
/// Sides are equally long within this, mm.
const EQUAL_MM: f64 = 1e-3;

/// Lays parts out, equal ones in blocks.
pub(super) fn in_blocks(
    parts: &[NestPart],
    sheets: &[NestSheet],
    options: NestOptions,
    watch: &mut dyn Watch,
) -> Nest {
    let share = NestOptions { effort: options.effort / 3.0, ..options };
    for most in [MOST, FEW] {
        let blocks = Blocks::new(parts, sheets, options, most, watch);
        let nest = laid_out(&blocks.parts, sheets, share, watch);
        let mut without = nest.too_large.iter().chain(&nest.left_over);
        if !without.any(|&block| blocks.of[block].1.len() > 1) {
            return blocks.taken_apart(nest, parts);
        }
    }
    laid_out(parts, sheets, share, watch)
}

/// Where a part lies in its block: turned by half a turn if so, then moved.
#[derive(Clone, Copy, Debug)]
struct Member {
    is_turned: bool,
    shift: Vec2,
}

impl Member {
    fn lay(&self, p: Point2) -> Point2 {
        let p = p.to_vec();
        Point2::default() + if self.is_turned { -p } else { p } + self.shift
    }

    /// Laid as this, and then as that.
    fn then(&self, that: &Self) -> Self {
        Self {
            is_turned: self.is_turned != that.is_turned,
            shift: that.lay(Point2::default() + self.shift).to_vec(),
        }
    }
}

/// What is laid out in place of parts.
struct Blocks {
    /// The blocks, as parts.
    parts: Vec<NestPart>,
    /// The part that each consists of, by its number, and where copies of it lie in the block.
    of: Vec<(usize, Vec<Member>)>,
}

impl Blocks {
    fn new(
        parts: &[NestPart],
        sheets: &[NestSheet],
        options: NestOptions,
        most: usize,
        watch: &mut dyn Watch,
    ) -> Self {
        let rooms: Vec<[f64; 2]> = sheets.iter().filter_map(|it| room(it, options)).collect();
        let distance = options.gap_mm + SAFE_MM;
        let mut blocks = Self { parts: Vec::new(), of: Vec::new() };
        for (n, part) in parts.iter().enumerate() {
            let first = Block::new(part, distance);
            let mut sizes = vec![first];
            let corners: usize = part.loops.iter().map(Vec::len).sum();
            while let Some(last) = sizes.last()
                && !watch.stop()
                && 2 * last.members.len() <= most.min(part.count)
                && 2 * last.members.len() * corners <= MOST_CORNERS
                && let Some(double) = last.doubled(part, distance, &rooms)
            {
                sizes.push(double);
            }
            let mut left = part.count;
            for block in sizes.into_iter().rev() {
                let size = block.members.len();
                let count = left / size;
                left -= count * size;
                if count > 0 {
                    let Block { members, around, .. } = block;
                    let loops = if size == 1 { part.loops.clone() } else { loops(around) };
                    blocks.parts.push(NestPart { loops, count, ..part.clone() });
                    blocks.of.push((n, members));
                }
            }
        }
        blocks
    }

    /// The layout of the parts themselves.
    fn taken_apart(&self, nest: Nest, parts: &[NestPart]) -> Nest {
        let mut next_copy = vec![0; parts.len()];
        let mut placements = Vec::new();
        for it in &nest.placements {
            let (part, members) = &self.of[it.part];
            for member in members {
                placements.push(Placement {
                    part: *part,
                    copy: next_copy[*part],
                    turn: it.turn + if member.is_turned { PI } else { 0.0 },
                    shift: it.shift + it.turned(member.shift),
                    ..*it
                });
                next_copy[*part] += 1;
            }
        }
        placements.sort_by_key(|it| (it.part, it.copy));
        let mut sheets = nest.sheets;
        sheets.iter_mut().for_each(|sheet| sheet.used_mm2 = 0.0);
        for it in &placements {
            sheets[it.sheet].used_mm2 += area_mm2(&parts[it.part].loops);
        }
        let of_parts = |blocks: &[usize]| -> Vec<usize> {
            let mut all: Vec<usize> = blocks.iter().map(|&block| self.of[block].0).collect();
            all.sort_unstable();
            all.dedup();
            all
        };
        let (too_large, left_over) = (of_parts(&nest.too_large), of_parts(&nest.left_over));
        Nest { placements, sheets, too_large, left_over }
    }
}

/// The room on a sheet, mm; of a roll as much of its length as it is wide. `None` of an offcut,
/// whose form is not known to take blocks.
fn room(sheet: &NestSheet, options: NestOptions) -> Option<[f64; 2]> {
    let inside = |side: f64| side - 2.0 * options.margin_mm;
    match sheet.form {
        NestForm::Rectangle(size) => Some(size.map(inside)),
        NestForm::Roll(width) => Some([inside(width); 2]),
        NestForm::Outline(_) => None,
    }
}

fn area_mm2(loops: &[Vec<Point2>]) -> f64 {
    let areas = loops.iter().map(|line| 0.5 * signed_area_doubled(line).abs());
    areas.enumerate().fold(0.0, |sum, (n, area)| if n == 0 { area } else { sum - area })
}

/// Some equal parts beside one another.
struct Block {
    members: Vec<Member>,
    /// What lies within half the distance of its members.
    around: Vec<Region>,
    /// What lies a little nearer to them: two blocks may have none of it in common.
    own: Vec<Region>,
}

impl Block {
    fn new(part: &NestPart, distance: f64) -> Self {
        Self::of(vec![Member { is_turned: false, shift: Vec2::ZERO }], part, distance)
    }

    fn of(members: Vec<Member>, part: &NestPart, distance: f64) -> Self {
        let laid = |member: &Member, n: usize| {
            let mut line: Vec<Point2> = part.loops[n].iter().map(|&p| member.lay(p)).collect();
            // A half turn keeps the direction of a loop; parts give theirs either way round.
            if (signed_area_doubled(&line) < 0.0) == (n == 0) {
                line.reverse();
            }
            line
        };
        let of_member = |member| (0..part.loops.len()).map(move |n| laid(member, n));
        let lines: Vec<Vec<Point2>> = members.iter().flat_map(of_member).collect();
        let [around, own] = [0.1, -0.1].map(|more| grown(&lines, 0.5 * distance + more * SAFE_MM));
        Self { members, around, own }
    }

    fn outline(&self) -> &[Point2] {
        self.around.first().map_or(&[], |region| &region.outline)
    }

    /// The block and its image beside it, if they fit a sheet.
    fn doubled(&self, part: &NestPart, distance: f64, rooms: &[[f64; 2]]) -> Option<Self> {
        let outline = self.outline();
        let sides = sides(outline);
        let may_turn = may_turn_by_half(&part.turns);
        let size = |line: &[Point2]| {
            let around = Box2::of_points(line.iter().copied());
            around.map_or(Vec2::ZERO, |it| it.max - it.min)
        };
        let longest = size(outline).max_element();
        let fits = |size: Vec2| {
            rooms.iter().any(|&[width, height]| {
                let [low, high] = [size.min_element(), size.max_element()];
                low <= width.min(height)
                    && high <= width.max(height)
                    && low * high <= OF_SHEET * width * height
            })
        };
        let share = filled(outline);
        let long = |side: &&[Point2; 2]| side[0].distance(side[1]) >= LEAST_SIDE * longest;
        for side in sides.iter().filter(long).take(TRIED) {
            for image in images(*side, &sides, distance, may_turn) {
                let image_members = self.members.iter().map(|member| member.then(&image));
                let members: Vec<Member> =
                    self.members.iter().copied().chain(image_members).collect();
                let here: Vec<Vec<Point2>> = self.own.iter().map(|it| it.outline.clone()).collect();
                let there: Vec<Vec<Point2>> = self
                    .own
                    .iter()
                    .map(|it| it.outline.iter().map(|&p| image.lay(p)).collect())
                    .collect();
                if common_mm2(&here, &there) > 0.0 {
                    continue;
                }
                let double = Self::of(members, part, distance);
                let line = double.outline();
                if double.around.len() == 1 && fits(size(line)) && filled(line) >= FILLED * share {
                    return Some(double);
                }
            }
        }
        None
    }
}

/// The outline of a block and its holes: all that lies within half the distance of it.
fn loops(around: Vec<Region>) -> Vec<Vec<Point2>> {
    let all = around.into_iter().next();
    all.map_or_else(Vec::new, |it| std::iter::once(it.outline).chain(it.holes).collect())
}

/// Which share of its hull an outline fills.
fn filled(outline: &[Point2]) -> f64 {
    let hull = signed_area_doubled(&convex_hull(outline)).abs();
    signed_area_doubled(outline).abs() / hull.max(f64::MIN_POSITIVE)
}

/// Whether a part that lies as it may still does after half a turn.
fn may_turn_by_half(turns: &Turns) -> bool {
    turns.angles.iter().all(|angle| turns.off(angle + PI, false).abs() < 1e-9)
}

/// The straight sides of an outline, the longest first.
fn sides(outline: &[Point2]) -> Vec<[Point2; 2]> {
    let mut sides: Vec<[Point2; 2]> = Vec::new();
    let count = outline.len();
    let way = |n: usize| unit2(outline[(n + 1) % count] - outline[n % count]);
    let goes_on = |n: usize| match (way(n), way(n + 1)) {
        (Some(a), Some(b)) => a.perp().dot(b).abs() < PARALLEL && a.dot(b) > 0.0,
        _ => false,
    };
    // Begins behind a corner, so that no side is broken at the first point.
    let Some(corner) = (0..count).find(|&n| !goes_on(n)) else { return sides };
    let mut from = corner + 1;
    for n in corner + 1..=corner + count {
        if !goes_on(n) {
            sides.push([outline[from % count], outline[(n + 1) % count]]);
            from = n + 1;
        }
    }
    let length = |side: &[Point2; 2]| side[0].distance(side[1]);
    sides.sort_by(|a, b| length(b).total_cmp(&length(a)));
    sides
}

/// Where an image of the block may lie so that a side of it faces this one: moved to where an
/// opposite side of the block faces it, and turned by half a turn about it. Sides are those of what
/// lies within half the distance of the block and a little more.
fn images(side: [Point2; 2], sides: &[[Point2; 2]], distance: f64, may_turn: bool) -> Vec<Member> {
    let Some(way) = unit2(side[1] - side[0]) else { return Vec::new() };
    let (out, middle) = (-way.perp(), side[0].lerp(side[1], 0.5));
    // Outlines reach a little farther than half the distance: so much they lie over one another.
    let apart = distance - 2.0 * (0.5 * distance + 0.1 * SAFE_MM);
    let faces = |other: &&[Point2; 2]| {
        let along = other[0] - other[1];
        (along.length() - side[0].distance(side[1])).abs() < EQUAL_MM
            && along.dot(way) > 0.0
            && along.dot(out).abs() < EQUAL_MM
    };
    let moved = sides.iter().filter(faces).map(|other| Member {
        is_turned: false,
        shift: middle - other[0].lerp(other[1], 0.5) + out * apart,
    });
    let turned = may_turn.then(|| {
        let about = middle + out * (0.5 * apart);
        Member { is_turned: true, shift: about.to_vec() * 2.0 }
    });
    moved.chain(turned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_geometry::watch::Unwatched;

    fn part(corners: &[[f64; 2]], count: usize) -> NestPart {
        let line = corners.iter().map(|&[x, y]| Point2::new(x, y)).collect();
        NestPart { loops: vec![line], count, turns: Turns::FREE, group: None }
    }

    fn sizes(part: &NestPart, sheet: [f64; 2], kerf: f64) -> Vec<(usize, usize)> {
        let sheet = NestSheet { form: NestForm::Rectangle(sheet), count: None, cost: None };
        let options =
            NestOptions { gap_mm: kerf, margin_mm: 0.0, has_common_lines: true, effort: 1.0 };
        let blocks =
            Blocks::new(std::slice::from_ref(part), &[sheet], options, MOST, &mut Unwatched);
        let sizes = blocks.of.iter().zip(&blocks.parts);
        sizes.map(|((_, members), part)| (members.len(), part.count)).collect()
    }

    #[test]
    fn rectangles_make_rows_and_triangles_pairs() {
        let square = [[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]];
        assert_eq!(sizes(&part(&square, 13), [1000.0, 800.0], 0.2), [(8, 1), (4, 1), (1, 1)]);
        let triangle = [[0.0, 0.0], [90.0, 0.0], [30.0, 60.0]];
        let found = sizes(&part(&triangle, 2), [1000.0, 800.0], 0.0);
        assert_eq!(found, [(2, 1)]);
        // One way up, with a grain: no triangle has its image beside it by a shift alone.
        let turns = Turns { angles: vec![0.0], ..Turns::FREE };
        let grained = NestPart { turns, ..part(&triangle, 2) };
        assert_eq!(sizes(&grained, [1000.0, 800.0], 0.0), [(1, 2)]);
        // A block is no larger than half of the sheet.
        assert_eq!(sizes(&part(&square, 4), [210.0, 210.0], 0.2), [(2, 2)]);
    }

    #[test]
    fn members_of_a_block_lie_a_kerf_apart() {
        let kite = [[0.0, 0.0], [80.0, 10.0], [100.0, 60.0], [-10.0, 70.0]];
        for kerf in [0.0, 0.3] {
            let (part, distance) = (part(&kite, 2), kerf + SAFE_MM);
            let block = Block::new(&part, distance).doubled(&part, distance, &[[1e3, 1e3]]);
            let block = block.unwrap();
            let [a, b] = [0, 1].map(|n| {
                let member: &Member = &block.members[n];
                kite.map(|[x, y]| member.lay(Point2::new(x, y)))
            });
            let to_line = |p: &Point2| {
                let edges = (0..4).map(|n| [b[n], b[(n + 1) % 4]]);
                edges.map(|edge| p.distance_to_segment(edge)).fold(f64::INFINITY, f64::min)
            };
            let mut off: Vec<f64> = a.iter().map(to_line).collect();
            off.sort_by(f64::total_cmp);
            // The longest side, with both of its ends; one lies a little beyond that of the other.
            assert!((off[0] - distance).abs() < 1e-6, "{off:?}");
            assert!(off[1] >= distance && off[1] < distance + 1e-3, "{off:?}");
            assert!(off[2] > 10.0);
        }
    }
}
