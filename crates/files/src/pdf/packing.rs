//! Which small parts share a page, and where each lies on it.
//!
//! Parts come to pages in the order of the design, so that those that are built together lie
//! together: a page takes as many of the next parts as it has room for. Within a page, the box of
//! each part, the highest first, lies as near to the upper edge as it can and then as far to the
//! left: the skyline heuristic for packing rectangles \[Jylanki2010\].

use super::paper::{AIR_MM, PageSides, Paper, window};
use sheetwright::math::{Point2, Vec2};

/// The least gap between the boxes of two parts, mm.
pub(super) const GAP_MM: f64 = 5.0;
/// Parts side by side on a page that grows are about as wide as high; the gaps between them take
/// this much more than their own area.
const LOOSE: f64 = 1.2;

/// The box of a part that may share a page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SmallPart {
    /// Its number.
    pub(super) part: usize,
    /// Width and height of the box around all that is drawn of it, mm.
    pub(super) size: Vec2,
}

/// Where a part lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placed {
    /// Its number.
    pub(super) part: usize,
    /// The lower left corner of its box, mm from that of the window.
    pub(super) at: Vec2,
}

/// A page of small parts.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SharedPage {
    /// Width and height as it is read, mm.
    pub(super) page: Vec2,
    /// Whether it is turned by a quarter when it is finished.
    pub(super) turned: bool,
    /// The parts, in order.
    pub(super) parts: Vec<Placed>,
}

/// Whether one page has room for a box of this size, mm.
pub(super) fn is_small(size: Vec2, paper: Paper) -> bool {
    paper.pages().into_iter().any(|sides| {
        let room = room_of(sides);
        size.x <= room.x && size.y <= room.y
    })
}

/// The pages of some small parts, each of which has room on one.
pub(super) fn pages_of(parts: &[SmallPart], paper: Paper) -> Vec<SharedPage> {
    let mut pages = Vec::new();
    let mut rest = parts;
    while !rest.is_empty() {
        let next = if paper == Paper::ProjectorEach { &rest[..1] } else { rest };
        let [upright, lying] = paper.pages().map(|sides| fullest(next, sides));
        let cost = |page: &SharedPage| page.page.x * page.page.y;
        let is_better = |second: &SharedPage, first: &SharedPage| {
            let (more, few) = (second.parts.len(), first.parts.len());
            more > few || (more == few && cost(second) < cost(first))
        };
        let page = if is_better(&lying, &upright) { lying } else { upright };
        // Every part has room on a page of its own, so this ends.
        rest = rest.get(page.parts.len().max(1)..).unwrap_or(&[]);
        pages.push(page);
    }
    pages
}

/// The room for boxes on the largest page of a kind, mm.
fn room_of(sides: PageSides) -> Vec2 {
    window(sides.largest()) - Vec2::splat(2.0 * AIR_MM)
}

/// The page that takes most of the first parts.
fn fullest(parts: &[SmallPart], sides: PageSides) -> SharedPage {
    let packed = |count: usize| on_page(&parts[..count], sides);
    if let Some(page) = packed(parts.len()) {
        return page;
    }
    // So many have room, and so many have not.
    let (mut few, mut many) = (0, parts.len());
    let mut best = SharedPage { page: sides.largest(), turned: sides.turned, parts: Vec::new() };
    while many - few > 1 {
        let middle = few.midpoint(many);
        match packed(middle) {
            Some(page) => (few, best) = (middle, page),
            None => many = middle,
        }
    }
    best
}

/// The page with all of some parts, if it has room for them. One that grows is as large as it must
/// be.
fn on_page(parts: &[SmallPart], sides: PageSides) -> Option<SharedPage> {
    let mut room = room_of(sides);
    if sides.grows() {
        let areas = parts.iter().map(|part| (part.size.x + GAP_MM) * (part.size.y + GAP_MM));
        let square = (LOOSE * areas.sum::<f64>()).sqrt();
        let widest = parts.iter().map(|part| part.size.x).fold(square, f64::max);
        room.x = room.x.min(widest);
    }
    // Parts are pushed towards the side that the page need not have.
    let along_x = sides.grows_along_x();
    let placed = if along_x {
        let lying: Vec<SmallPart> = parts.iter().map(|part| part.transposed()).collect();
        let placed = packed(&lying, transposed(room))?;
        placed.into_iter().map(|(at, size)| (transposed(at), transposed(size))).collect()
    } else {
        packed(parts, room)?
    };
    let far = placed.iter().fold(Vec2::ZERO, |far, (at, size)| {
        Vec2::new(far.x.max(at.x + size.x), far.y.max(at.y + size.y))
    });
    let page = sides.around(far + Vec2::splat(2.0 * AIR_MM));
    let high = window(page).y - AIR_MM;
    // From the upper edge to the lower one.
    let at = |(at, size): (Vec2, Vec2)| Vec2::new(at.x + AIR_MM, high - at.y - size.y);
    let each = parts.iter().zip(placed);
    let parts = each.map(|(part, placed)| Placed { part: part.part, at: at(placed) }).collect();
    Some(SharedPage { page, turned: sides.turned, parts })
}

impl SmallPart {
    fn transposed(&self) -> Self {
        Self { size: transposed(self.size), ..*self }
    }
}

fn transposed(v: Vec2) -> Vec2 {
    Vec2::new(v.y, v.x)
}

/// The places of some parts in a room, if it has room for all, from its upper edge downwards.
pub(super) fn in_room(parts: &[SmallPart], room: Vec2) -> Option<Vec<Placed>> {
    let placed = packed(parts, room)?;
    let at = |(at, size): (Vec2, Vec2)| Vec2::new(at.x, room.y - at.y - size.y);
    let each = parts.iter().zip(placed);
    Some(each.map(|(part, placed)| Placed { part: part.part, at: at(placed) }).collect())
}

/// The corner of each part in a room, mm to the right and downwards from its upper left corner, and
/// its size; `None` if they have no room.
fn packed(parts: &[SmallPart], room: Vec2) -> Option<Vec<(Vec2, Vec2)>> {
    let gap = Vec2::splat(GAP_MM);
    let mut order: Vec<usize> = (0..parts.len()).collect();
    // A stable sort: equal boxes stay in the order of the parts.
    order.sort_by(|&a, &b| {
        let (a, b) = (parts[a].size, parts[b].size);
        b.y.total_cmp(&a.y).then(b.x.total_cmp(&a.x))
    });
    let mut skyline = Skyline::new(room + gap);
    let mut corners = vec![(Vec2::ZERO, Vec2::ZERO); parts.len()];
    for n in order {
        corners[n] = (skyline.place(parts[n].size + gap)?, parts[n].size);
    }
    Some(corners)
}

/// How far boxes reach down from the upper edge of a room: from each x to the next, one depth.
struct Skyline {
    room: Vec2,
    /// The left end of each step and its depth, from left to right.
    steps: Vec<Point2>,
}

impl Skyline {
    fn new(room: Vec2) -> Self {
        Self { room, steps: vec![Point2::default()] }
    }

    /// Places a box as high as can be, then as far to the left: its upper left corner.
    fn place(&mut self, size: Vec2) -> Option<Vec2> {
        // Sums of sizes are rounded.
        const EPS: f64 = 1e-9;
        let mut best: Option<(f64, f64)> = None;
        for (n, step) in self.steps.iter().enumerate() {
            let right = step.x + size.x;
            if right > self.room.x + EPS {
                break;
            }
            let under = self.steps[n..].iter().take_while(|step| step.x < right - EPS);
            let depth = under.map(|step| step.y).fold(0.0, f64::max);
            let fits = depth + size.y <= self.room.y + EPS;
            if fits && best.is_none_or(|(least, _)| depth < least) {
                best = Some((depth, step.x));
            }
        }
        let (depth, x) = best?;
        self.lower(x, x + size.x, depth + size.y);
        Some(Vec2::new(x, depth))
    }

    /// Lowers the steps between two places to a depth.
    fn lower(&mut self, from: f64, to: f64, depth: f64) {
        let covered = |step: &&Point2| step.x <= to;
        let behind = self.steps.iter().rfind(covered).map_or(0.0, |step| step.y);
        let has_end = self.steps.iter().any(|step| step.x == to);
        self.steps.retain(|step| step.x < from || step.x >= to);
        let at = self.steps.partition_point(|step| step.x < from);
        let end = (!has_end && to < self.room.x).then_some(Point2::new(to, behind));
        self.steps.splice(at..at, [Point2::new(from, depth)].into_iter().chain(end));
        self.steps.dedup_by(|next, step| next.y == step.y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright::predicate::Box2;

    fn parts(count: usize) -> Vec<SmallPart> {
        // Sizes without order, by a linear congruence.
        let mut state = 7_u32;
        let mut next = |most: f64| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            5.0 + most * f64::from(state >> 8) / f64::from(1 << 24)
        };
        (0..count)
            .map(|part| SmallPart { part, size: Vec2::new(next(180.0), next(100.0)) })
            .collect()
    }

    /// Every part is placed once, in the order of the design, within its page and clear of the
    /// others by the gap.
    #[test]
    fn parts_share_pages_and_no_place() {
        let roll = Paper::parse("roll:610mm").unwrap();
        for paper in Paper::SHEETS.into_iter().chain([roll, Paper::Projector, Paper::ProjectorEach])
        {
            for count in [0, 1, 2, 17, 150] {
                let parts = parts(count);
                let pages = pages_of(&parts, paper);
                let order: Vec<usize> =
                    pages.iter().flat_map(|page| page.parts.iter().map(|p| p.part)).collect();
                assert_eq!(order, (0..count).collect::<Vec<_>>(), "{paper:?}");
                for page in &pages {
                    check(page, &parts);
                }
                let area: f64 = parts.iter().map(|part| part.size.x * part.size.y).sum();
                let paper_area: f64 = pages.iter().map(|page| page.page.x * page.page.y).sum();
                if pages.len() > 3 && paper != Paper::ProjectorEach {
                    assert!(area > 0.3 * paper_area, "{paper:?}: {}", area / paper_area);
                }
            }
        }
    }

    fn check(page: &SharedPage, parts: &[SmallPart]) {
        let room = window(page.page);
        let boxes: Vec<Box2> = page
            .parts
            .iter()
            .map(|placed| {
                let min = Point2::default() + placed.at;
                Box2 { min, max: min + parts[placed.part].size }
            })
            .collect();
        for (n, a) in boxes.iter().enumerate() {
            assert!(a.min.x > 0.99 && a.min.y > 0.99, "{a:?}");
            assert!(a.max.x < room.x - 0.99 && a.max.y < room.y - 0.99, "{a:?} {room:?}");
            for b in &boxes[n + 1..] {
                let apart = (a.min.x - b.max.x).max(b.min.x - a.max.x);
                let apart = apart.max((a.min.y - b.max.y).max(b.min.y - a.max.y));
                assert!(apart > GAP_MM - 1e-6, "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn equal_squares_fill_a_page() {
        let squares: Vec<SmallPart> =
            (0..720).map(|part| SmallPart { part, size: Vec2::splat(30.0) }).collect();
        let pages = pages_of(&squares, Paper::A4);
        // Eight by five on a page that lies, five by seven on one that stands.
        assert_eq!(pages[0].parts.len(), 40);
        assert_eq!(pages.len(), 18);
    }
}
