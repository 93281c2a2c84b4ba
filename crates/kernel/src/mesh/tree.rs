//! Boxes in a tree, to find those near a place: halves of the longest extent, down to a few boxes.
//!
//! The nodes stand in one list, each before those below it, with the number of the next node that
//! is not below it. A search runs down the list and skips what lies below a node that it does not
//! enter.

use sheetwright_geometry::math::Vec3;

/// The most boxes of a leaf.
const LEAF: usize = 8;

/// A box by its lowest and its highest corner.
#[derive(Clone, Copy)]
pub(super) struct Extent(pub(super) Vec3, pub(super) Vec3);

impl Extent {
    /// The box of some points.
    pub(super) fn of(points: impl IntoIterator<Item = Vec3>) -> Self {
        let none = Self(Vec3::splat(f64::INFINITY), Vec3::splat(f64::NEG_INFINITY));
        points.into_iter().fold(none, |found, p| Self(found.0.min(p), found.1.max(p)))
    }

    fn with(self, other: Self) -> Self {
        Self(self.0.min(other.0), self.1.max(other.1))
    }

    /// The distance of a point from it, 0 inside.
    pub(super) fn distance(&self, p: Vec3) -> f64 {
        (p - p.clamp(self.0, self.1)).length()
    }

    /// Whether a straight line from one point to another comes within `reach` of it in every
    /// coordinate at once.
    pub(super) fn is_near_line(&self, from: Vec3, to: Vec3, reach: f64) -> bool {
        let (low, high) = (self.0 - reach, self.1 + reach);
        let way = to - from;
        let (mut begin, mut end): (f64, f64) = (0.0, 1.0);
        for axis in 0..3 {
            let (low, high) = (low[axis] - from[axis], high[axis] - from[axis]);
            if way[axis] == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return false;
                }
                continue;
            }
            let (a, b) = (low / way[axis], high / way[axis]);
            begin = begin.max(a.min(b));
            end = end.min(a.max(b));
        }
        begin <= end
    }
}

struct Node {
    extent: Extent,
    /// The next node that is not below it.
    skip: usize,
    /// Of a leaf, its boxes in the list.
    leaf: Option<(usize, usize)>,
}

/// Boxes by their numbers.
pub(super) struct Tree {
    nodes: Vec<Node>,
    items: Vec<usize>,
}

impl Tree {
    pub(super) fn new(extents: &[Extent]) -> Self {
        let items = (0..extents.len()).collect();
        let mut tree = Self { nodes: Vec::new(), items };
        if !extents.is_empty() {
            tree.divide(extents, 0, extents.len());
        }
        tree
    }

    fn divide(&mut self, extents: &[Extent], from: usize, to: usize) {
        let items = &mut self.items[from..to];
        let all = items.iter().map(|&n| extents[n]);
        let Some(extent) = all.reduce(Extent::with) else { return };
        let here = self.nodes.len();
        self.nodes.push(Node { extent, skip: 0, leaf: None });
        if to - from <= LEAF {
            self.nodes[here].leaf = Some((from, to));
        } else {
            let size = extent.1 - extent.0;
            let axis = (1..3).fold(0, |most, n| if size[n] > size[most] { n } else { most });
            let middle = |n: usize| extents[n].0[axis] + extents[n].1[axis];
            let half = (to - from) / 2;
            items.select_nth_unstable_by(half, |&a, &b| {
                middle(a).total_cmp(&middle(b)).then(a.cmp(&b))
            });
            self.divide(extents, from, from + half);
            self.divide(extents, from + half, to);
        }
        self.nodes[here].skip = self.nodes.len();
    }

    /// Shows the boxes below all nodes that are entered, in an order that depends on the boxes
    /// alone. Both functions have the same state, which they may change.
    pub(super) fn visit<S>(
        &self,
        state: &mut S,
        enters: impl Fn(&S, &Extent) -> bool,
        mut sees: impl FnMut(&mut S, usize),
    ) {
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            if !enters(state, &node.extent) {
                at = node.skip;
                continue;
            }
            if let Some((from, to)) = node.leaf {
                self.items[from..to].iter().for_each(|&n| sees(state, n));
            }
            at += 1;
        }
    }
}
