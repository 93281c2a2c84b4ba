//! The order in which the triangles of a picture are drawn, so that nearer ones lie over farther
//! ones.
//!
//! An order by one number per triangle, such as the depth of its middle, is wrong for long
//! triangles that lie across one another. So the order comes from pairs of triangles of which one
//! must lie over the other, as Newell, Newell and Sancha do (1972). The depth buffer gives these
//! pairs: the triangle that shows in a cell is drawn after every other one that covers the cell.
//! Triangles that show nowhere are left out. Triangles that overlap in a cycle, or pass through one
//! another, have no right order. Then one of them is drawn all the same, and the cells that this
//! makes wrong are drawn last, one by one.

use super::raster::Raster;
use sheetwright::math::Point2;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Depths that differ by less than this share of the depth range of the picture count as equal.
const SAME: f64 = 1e-3;

/// How the facets of a picture are drawn.
#[derive(Debug, PartialEq)]
pub(crate) enum Order {
    /// Nothing hides anything: in any order.
    Any,
    /// From the first to the last, by their numbers; then the cells that are marked, if there are
    /// any.
    Of(Vec<usize>, Option<Vec<bool>>),
}

/// The order of all facets of a raster.
pub(crate) fn order(raster: &Raster<'_>) -> Order {
    if raster.is_plain() {
        return Order::Any;
    }
    let count = raster.facets.len();
    let mut shows = vec![false; count];
    for n in (0..raster.width * raster.height).filter_map(|cell| raster.top(cell)) {
        shows[n] = true;
    }
    // Pairs of facets, of which the first is drawn before the second.
    let mut pairs: Vec<(u32, u32)> = Vec::new();
    let mut hidden = false;
    let depths = || raster.facets.iter().flat_map(|facet| facet.near);
    let span = depths().fold(f64::NEG_INFINITY, f64::max) - depths().fold(f64::INFINITY, f64::min);
    for n in 0..count {
        if !raster.covers(n) {
            shows[n] = thin(raster, n, SAME * span, &mut pairs);
            hidden |= !shows[n];
            continue;
        }
        hidden |= !shows[n];
        let mut last = n;
        for over in raster.cells(n).filter_map(|cell| raster.top(cell)) {
            if over != n && over != last {
                pairs.push((n as u32, over as u32));
                last = over;
            }
        }
    }
    if pairs.is_empty() && !hidden {
        return Order::Any;
    }
    pairs.retain(|&(under, over)| shows[under as usize] && shows[over as usize]);
    pairs.sort_unstable();
    pairs.dedup();
    let (list, is_broken) = sorted(raster, &shows, &pairs);
    let wrong = is_broken.then(|| wrong_cells(raster, &list));
    Order::Of(list, wrong)
}

/// Whether a facet that covers the middle of no cell shows at one of some places on it. Depths that
/// differ by less than `same` count as equal.
fn thin(raster: &Raster<'_>, n: usize, same: f64, pairs: &mut Vec<(u32, u32)>) -> bool {
    let facet = &raster.facets[n];
    let mut shows = false;
    for at in along(facet.corners) {
        let Some(top) = raster.top_at(at) else {
            shows = true;
            continue;
        };
        let before = facet.near_at(at) - raster.facets[top].near_at(at);
        if before > same {
            pairs.push((top as u32, n as u32));
        } else if before < -same {
            pairs.push((n as u32, top as u32));
        }
        shows |= before >= -same;
    }
    shows
}

/// Four places along the middle of a thin triangle.
fn along([a, b, c]: [Point2; 3]) -> [Point2; 4] {
    let sides = [(a, b, c), (b, c, a), (c, a, b)];
    let shortest = sides.into_iter().min_by(|s, t| s.0.distance(s.1).total_cmp(&t.0.distance(t.1)));
    let (from, to, tip) = shortest.unwrap_or((a, b, c));
    [0.1, 0.35, 0.6, 0.85].map(|share| from.lerp(to, 0.5).lerp(tip, share))
}

/// The facets that show, each after those that it must lie over, else from far to near; and whether
/// a cycle breaks this order.
fn sorted(raster: &Raster<'_>, shows: &[bool], pairs: &[(u32, u32)]) -> (Vec<usize>, bool) {
    let mut by_depth: Vec<usize> = (0..shows.len()).filter(|&n| shows[n]).collect();
    let mean: Vec<f64> = raster.facets.iter().map(|facet| facet.mean_near()).collect();
    by_depth.sort_by(|&a, &b| mean[a].total_cmp(&mean[b]).then(a.cmp(&b)));
    let mut rank = vec![0; shows.len()];
    by_depth.iter().enumerate().for_each(|(n, &facet)| rank[facet] = n);
    let mut waits_for = vec![0_u32; shows.len()];
    pairs.iter().for_each(|pair| waits_for[pair.1 as usize] += 1);
    let free = by_depth.iter().filter(|&&n| waits_for[n] == 0);
    let mut ready: BinaryHeap<Reverse<usize>> = free.map(|&n| Reverse(rank[n])).collect();
    let mut done = vec![false; shows.len()];
    let (mut list, mut is_broken) = (Vec::with_capacity(by_depth.len()), false);
    let mut farthest = by_depth.iter().copied();
    while list.len() < by_depth.len() {
        let next = match ready.pop() {
            Some(Reverse(rank)) => by_depth[rank],
            None => {
                is_broken = true;
                let Some(left) = farthest.find(|&n| !done[n]) else { break };
                left
            }
        };
        if std::mem::replace(&mut done[next], true) {
            continue;
        }
        list.push(next);
        let from = pairs.partition_point(|pair| (pair.0 as usize) < next);
        for &(_, over) in pairs[from..].iter().take_while(|pair| pair.0 as usize == next) {
            let over = over as usize;
            waits_for[over] -= 1;
            if waits_for[over] == 0 && !done[over] {
                ready.push(Reverse(rank[over]));
            }
        }
    }
    (list, is_broken)
}

/// The cells where another facet is drawn over the nearest one.
fn wrong_cells(raster: &Raster<'_>, list: &[usize]) -> Vec<bool> {
    let mut place = vec![0; raster.facets.len()];
    list.iter().enumerate().for_each(|(n, &facet)| place[facet] = n);
    let mut wrong = vec![false; raster.width * raster.height];
    for &n in list {
        for cell in raster.cells(n) {
            wrong[cell] |= raster.top(cell).is_some_and(|top| place[top] < place[n]);
        }
    }
    wrong
}

#[cfg(test)]
mod tests {
    use super::super::raster::Facet;
    use super::*;
    use sheetwright::math::Vec2;

    const SIZE: Vec2 = Vec2::new(40.0, 40.0);

    /// A bar from one place to another, 4 wide, as two triangles; `near` is the nearness of its
    /// ends.
    fn bar(from: [f64; 2], to: [f64; 2], near: [f64; 2]) -> [Facet; 2] {
        let [a, b] = [from, to].map(|[x, y]| Point2::new(x, y));
        let along = b - a;
        let side = Vec2::new(-along.y, along.x) * (2.0 / along.length());
        let [p, q, r, s] = [a + -side, b + -side, b + side, a + side];
        let [low, high] = near;
        [
            Facet { corners: [p, q, r], near: [low, high, high], class: 0 },
            Facet { corners: [p, r, s], near: [low, high, low], class: 0 },
        ]
    }

    /// The number of cells that show the nearest facet when the facets are drawn, and of those that
    /// do not.
    fn right_and_wrong(facets: &[Facet]) -> [usize; 2] {
        let raster = Raster::new(SIZE, 2.0, facets);
        let Order::Of(list, patch) = order(&raster) else { panic!("something hides something") };
        let cells = raster.width * raster.height;
        let mut drawn = vec![None; cells];
        for &n in &list {
            raster.cells(n).for_each(|cell| drawn[cell] = Some(n));
        }
        let patched = |cell: usize| patch.as_ref().is_some_and(|patch| patch[cell]);
        let is_right = |cell: &usize| drawn[*cell] == raster.top(*cell) || patched(*cell);
        let right = (0..cells).filter(is_right).count();
        [right, cells - right]
    }

    /// The middle of the long bar is farther than that of the short one, which it hides all the
    /// same.
    #[test]
    fn a_long_triangle_hides_what_lies_behind_one_of_its_ends() {
        let long = bar([2., 20.], [38., 20.], [10., -30.]);
        let short = bar([6., 8.], [6., 32.], [0., 0.]);
        let facets = [long, short].concat();
        assert_eq!(right_and_wrong(&facets)[1], 0);
        let raster = Raster::new(SIZE, 2.0, &facets);
        let Order::Of(_, patch) = order(&raster) else { panic!("something hides something") };
        assert_eq!(patch, None, "an order is enough");
    }

    #[test]
    fn three_bars_in_a_ring_come_out_right() {
        let facets = [
            bar([4., 6.], [36., 6.], [0., 10.]),
            bar([33., 4.], [20., 36.], [0., 10.]),
            bar([24., 36.], [6., 3.], [0., 10.]),
        ];
        assert_eq!(right_and_wrong(&facets.concat())[1], 0);
    }

    #[test]
    fn what_passes_through_comes_out_right() {
        let facets =
            [bar([4., 20.], [36., 20.], [-10., 10.]), bar([20., 4.], [20., 36.], [0., 0.])];
        assert_eq!(right_and_wrong(&facets.concat())[1], 0);
        let tilted =
            [bar([4., 20.], [36., 20.], [-10., 10.]), bar([4., 21.], [36., 21.], [10., -10.])];
        assert_eq!(right_and_wrong(&tilted.concat())[1], 0);
    }

    #[test]
    fn what_shows_nowhere_is_not_drawn_and_what_hides_nothing_needs_no_order() {
        let front = bar([4., 20.], [36., 20.], [5., 5.]);
        let behind = bar([8., 20.], [30., 20.], [1., 1.]);
        let facets = [behind, front].concat();
        let raster = Raster::new(SIZE, 2.0, &facets);
        assert_eq!(order(&raster), Order::Of(vec![2, 3], None));
        let raster = Raster::new(SIZE, 2.0, &front);
        assert_eq!(order(&raster), Order::Any);
    }

    /// Triangles thinner than a cell.
    #[test]
    fn thin_triangles_are_drawn_where_nothing_hides_them() {
        let thin = |y: f64, near: f64| Facet {
            corners: [Point2::new(5., y), Point2::new(35., y), Point2::new(35., y + 0.01)],
            near: [near; 3],
            class: 1,
        };
        let sheet = bar([4., 20.], [36., 20.], [5., 5.]);
        let facets = [&sheet[..], &[thin(20.1, 9.0), thin(20.1, 1.0), thin(3.1, 1.0)]].concat();
        let raster = Raster::new(SIZE, 2.0, &facets);
        let Order::Of(list, None) = order(&raster) else { panic!("an order is enough") };
        assert!(list.contains(&2) && !list.contains(&3) && list.contains(&4), "{list:?}");
        let place = |n| list.iter().position(|&m| m == n);
        assert!(place(2) > place(0) && place(2) > place(1));
    }
}
