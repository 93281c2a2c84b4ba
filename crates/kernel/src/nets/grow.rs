//! Pieces of a net, and how two of them become one.

use super::beyond::Room;
use super::facets::{Facets, Hinge};
use super::mirror::Mirror;
use super::order::seam_cost;
use super::overlap::{Apart, Side, is_inside, meet, reaches_into};
use crate::flatten::Motion;
use sheetwright_geometry::disjoint::DisjointSets;
use sheetwright_geometry::math::Point2;
use sheetwright_geometry::watch::Watch;

/// Both sides of a hinge lie on one another if their ends are nearer than this share of the size:
/// what rounding to six digits leaves round a flat vertex. Lengths are then off by no more.
const TOGETHER: f64 = 1e-6;
/// They are nearer than this share of the hinge and of the widths of its facets as well: beside
/// something large, rounding is more than small facets are long. A surface of 2,000 facets that
/// closed up all round would miss a full turn by 0.0125 radians at one of its vertices at least, so
/// each piece keeps a border.
const TOGETHER_OF_FACET: f64 = 1e-3;

/// Hinges between two looks at the watcher.
const HINGES_A_LOOK: usize = 256;
/// The work for a facet that is laid, parted or numbered, in pairs that are compared.
const FACET_WORK: usize = 20;

/// The facets of a mesh in pieces, each laid out in a plane of its own.
#[derive(Clone, Debug)]
pub(super) struct Pieces<'a> {
    pub(super) facets: &'a Facets,
    /// The room that each has, if there is a limit.
    room: Option<&'a Room>,
    /// The mirror that they are symmetric to, if they are to be.
    pub(super) mirror: Option<&'a Mirror>,
    /// The piece of each facet.
    pub(super) of_facet: Vec<usize>,
    /// The facets of each piece; none of a piece that became part of another.
    pub(super) members: Vec<Vec<usize>>,
    /// Which hinges are folded.
    pub(super) folded: Vec<bool>,
    laid: Vec<Laid>,
    /// The work so far: pairs of facets and of sides that were compared, and facets that were laid,
    /// parted or numbered, each of which takes as long as [`FACET_WORK`] pairs.
    pub(super) work: usize,
}

/// A facet laid in the plane of its piece.
#[derive(Clone, Debug)]
struct Laid {
    points: Vec<Point2>,
    /// The vertex of the net that each of its vertices is: a number that the facets round a vertex
    /// have in common as far as folds join them.
    vertices: Vec<u32>,
    min: Point2,
    max: Point2,
    inside: Point2,
}

impl Laid {
    fn new(points: Vec<Point2>, vertices: Vec<u32>, inside: Point2) -> Self {
        let (mut min, mut max) = (points[0], points[0]);
        for p in &points {
            min = Point2::new(min.x.min(p.x), min.y.min(p.y));
            max = Point2::new(max.x.max(p.x), max.y.max(p.y));
        }
        Self { points, vertices, min, max, inside }
    }

    fn moved(&self, motion: &Motion) -> Self {
        let points = self.points.iter().map(|&p| motion.moved(p)).collect();
        Self::new(points, self.vertices.clone(), motion.moved(self.inside))
    }

    fn sides(&self, border: &[[usize; 2]]) -> Vec<Side> {
        let side = |ends: &[usize; 2]| Side {
            ends: ends.map(|n| self.points[n]),
            vertices: ends.map(|n| self.vertices[n]),
        };
        border.iter().map(side).collect()
    }

    fn is_near(&self, other: &Self, apart_mm: f64) -> bool {
        self.min.x <= other.max.x + apart_mm
            && other.min.x <= self.max.x + apart_mm
            && self.min.y <= other.max.y + apart_mm
            && other.min.y <= self.max.y + apart_mm
    }
}

impl<'a> Pieces<'a> {
    /// Every facet by itself.
    pub(super) fn new(
        facets: &'a Facets,
        room: Option<&'a Room>,
        mirror: Option<&'a Mirror>,
    ) -> Self {
        let laid = facets.list.iter().enumerate().map(|(n, facet)| {
            Laid::new(facet.points.clone(), facets.own_numbers(n).collect(), facet.inside)
        });
        let laid = laid.collect();
        let count = facets.list.len();
        Self {
            facets,
            room,
            mirror,
            of_facet: (0..count).collect(),
            members: (0..count).map(|n| vec![n]).collect(),
            folded: vec![false; facets.hinges.len()],
            laid,
            work: 0,
        }
    }

    /// How many pieces there are.
    pub(super) fn count(&self) -> usize {
        self.members.iter().filter(|members| !members.is_empty()).count()
    }

    /// Whether it is the better of two: fewer pieces, or else shorter cuts and less seen ones.
    pub(super) fn is_better(&self, other: &Self) -> bool {
        let (own, others) = (self.count(), other.count());
        // Sums in another order may differ in their last digits.
        own < others || (own == others && self.cost() < other.cost() * (1.0 - 1e-9))
    }

    /// The price of all cuts.
    pub(super) fn cost(&self) -> f64 {
        let cut = (0..self.folded.len()).filter(|&n| !self.folded[n]);
        cut.map(|n| seam_cost(self.facets, n)).sum()
    }

    /// Folds the hinges in this order, each as far as its pieces do not overlap; `false` if the
    /// watcher asks to stop.
    pub(super) fn grow(&mut self, order: &[usize], watch: &mut dyn Watch) -> bool {
        for (n, &hinge) in order.iter().enumerate() {
            if n % HINGES_A_LOOK == 0 && watch.stop() {
                return false;
            }
            self.fold(hinge);
        }
        true
    }

    /// Folds a hinge if it joins two pieces that do not overlap then, and its image with it;
    /// whether it did.
    pub(super) fn fold(&mut self, hinge: usize) -> bool {
        let image = self.mirror.map_or(hinge, |mirror| mirror.image(hinge));
        if image == hinge {
            return self.fold_alone(hinge);
        }
        // Both would join the same two pieces, in a ring.
        let joined = [hinge, image].map(|n| {
            let mut pieces = self.facets.hinges[n].facets.map(|f| self.of_facet[f]);
            pieces.sort_unstable();
            pieces
        });
        if joined[0] == joined[1] || !self.fold_alone(hinge) {
            return false;
        }
        if self.folded[image] || self.fold_alone(image) {
            return true;
        }
        self.unfold_alone(&[hinge]);
        false
    }

    /// Whether the image of every fold is one.
    pub(super) fn is_symmetric(&self) -> bool {
        let Some(mirror) = self.mirror else { return false };
        (0..self.folded.len()).all(|n| self.folded[n] == self.folded[mirror.image(n)])
    }

    fn fold_alone(&mut self, hinge: usize) -> bool {
        let Hinge { facets: of, is_seam, .. } = self.facets.hinges[hinge];
        let [a, b] = of.map(|f| self.of_facet[f]);
        if a == b || is_seam {
            return false;
        }
        // The smaller piece moves.
        let moves = usize::from(self.members[a].len() >= self.members[b].len());
        let [small, big] = [[a, b][moves], [a, b][1 - moves]];
        let [from, to] = [self.ends(hinge, moves), self.ends(hinge, 1 - moves)];
        let motion = Motion::laying(&[[from[0], to[0]], [from[1], to[1]]]);
        let members = self.members[small].clone();
        let mut moved: Vec<Laid> = members.iter().map(|&f| self.laid[f].moved(&motion)).collect();
        let closed = self.closed(&members, &moved, big);
        self.glue(&mut moved, &closed);
        if self.exceeds(&members, &moved, big, &closed) || self.overlaps(&members, &moved, big) {
            return false;
        }
        closed.iter().for_each(|&(n, _)| self.folded[n] = true);
        for (&f, laid) in members.iter().zip(moved) {
            self.of_facet[f] = big;
            self.laid[f] = laid;
        }
        self.members[small].clear();
        self.members[big].extend(members);
        if closed.len() > 1 {
            self.name_vertices(big);
        }
        true
    }

    /// The ends of a hinge on the facet to its left (0) or to its right (1).
    fn ends(&self, hinge: usize, side: usize) -> [Point2; 2] {
        let hinge = &self.facets.hinges[hinge];
        let places = &hinge.places[side];
        let points = &self.laid[hinge.facets[side]].points;
        [points[places[0]], points[places[places.len() - 1]]]
    }

    /// The hinges between some facets, moved, and a piece whose two sides lie on one another; each
    /// with which of its sides is on a moved facet.
    fn closed(&self, members: &[usize], moved: &[Laid], big: usize) -> Vec<(usize, usize)> {
        let mut closed = Vec::new();
        for (&f, laid) in members.iter().zip(moved) {
            for &n in &self.facets.list[f].hinges {
                let hinge = &self.facets.hinges[n];
                let side = usize::from(hinge.facets[0] != f);
                if hinge.is_seam || self.of_facet[hinge.facets[1 - side]] != big {
                    continue;
                }
                let places = &hinge.places[side];
                let own = [places[0], places[places.len() - 1]].map(|k| laid.points[k]);
                if self.is_closed(n, own, self.ends(n, 1 - side)) {
                    closed.push((n, side));
                }
            }
        }
        closed
    }

    /// Gives the vertices of moved facets the numbers of those that they come to lie on.
    fn glue(&self, moved: &mut [Laid], closed: &[(usize, usize)]) {
        let mut renamed: Vec<[u32; 2]> = Vec::new();
        for &(n, side) in closed {
            let hinge = &self.facets.hinges[n];
            let number = |side: usize, k: usize| {
                self.laid[hinge.facets[side]].vertices[hinge.places[side][k]]
            };
            for k in 0..hinge.line.len() {
                let pair = [number(side, k), number(1 - side, k)];
                if !renamed.contains(&pair) {
                    renamed.push(pair);
                }
            }
        }
        for vertex in moved.iter_mut().flat_map(|laid| laid.vertices.iter_mut()) {
            if let Some([_, new]) = renamed.iter().find(|[old, _]| old == vertex) {
                *vertex = *new;
            }
        }
    }

    /// Numbers the vertices of a piece anew: one number for the corners that folds join.
    pub(super) fn name_vertices(&mut self, piece: usize) {
        self.work += FACET_WORK * self.members[piece].len();
        let members = &self.members[piece];
        let mut first = vec![0; self.facets.list.len()];
        let mut count = 0;
        for &f in members {
            first[f] = count;
            count += self.laid[f].points.len();
        }
        let mut one = DisjointSets::new(count);
        for &f in members {
            for &n in &self.facets.list[f].hinges {
                let hinge = &self.facets.hinges[n];
                if self.folded[n] && hinge.facets[0] == f {
                    for (&a, &b) in hinge.places[0].iter().zip(&hinge.places[1]) {
                        one.join(first[f] + a, first[hinge.facets[1]] + b);
                    }
                }
            }
        }
        // Numbers that no other piece has: those of the first facet with that corner.
        let own: Vec<u32> = members.iter().flat_map(|&f| self.facets.own_numbers(f)).collect();
        for &f in &self.members[piece] {
            for k in 0..self.laid[f].points.len() {
                self.laid[f].vertices[k] = own[one.first(first[f] + k)];
            }
        }
    }

    /// Whether a piece is too large once some facets are added and hinges folded.
    fn exceeds(
        &self,
        members: &[usize],
        moved: &[Laid],
        big: usize,
        closed: &[(usize, usize)],
    ) -> bool {
        let Some(room) = self.room else { return false };
        let of_big = self.members[big].iter().map(|&f| (f, &self.laid[f]));
        let laid: Vec<(usize, &Laid)> = of_big.chain(members.iter().copied().zip(moved)).collect();
        let points = laid.iter().flat_map(|(_, laid)| laid.points.iter().copied());
        let is_folded = |n: usize| self.folded[n] || closed.iter().any(|&(other, _)| other == n);
        let beyond = || {
            let of_facet = |&(f, laid): &(usize, &Laid)| {
                room.beyond(f, &laid.points, is_folded).collect::<Vec<_>>()
            };
            laid.iter().flat_map(of_facet).collect()
        };
        !room.holds(&points.collect::<Vec<_>>(), beyond)
    }

    /// Whether any of some moved facets overlaps one of a piece.
    fn overlaps(&mut self, members: &[usize], moved: &[Laid], big: usize) -> bool {
        let apart = Apart::of(self.facets);
        let apart_mm = apart.sides_mm;
        let [around_moved, around_big] =
            [around(moved.iter()), around(self.members[big].iter().map(|&f| &self.laid[f]))];
        let sides = |n: usize| moved[n].sides(&self.facets.list[members[n]].border);
        let near: Vec<usize> =
            (0..moved.len()).filter(|&n| moved[n].is_near(&around_big, apart_mm)).collect();
        let mut others: Vec<usize> = self.members[big].clone();
        others.retain(|&f| self.laid[f].is_near(&around_moved, apart_mm));
        others.sort_by(|&a, &b| self.laid[a].min.x.total_cmp(&self.laid[b].min.x));
        let mut work = FACET_WORK * members.len() + self.members[big].len();
        let mut overlaps = false;
        'all: for &n in &near {
            let own = sides(n);
            for &f in &others {
                let other = &self.laid[f];
                work += 1;
                if other.min.x > moved[n].max.x + apart_mm {
                    break;
                }
                if !moved[n].is_near(other, apart_mm) {
                    continue;
                }
                let of_other = other.sides(&self.facets.list[f].border);
                let pairs = own.len() * of_other.len();
                work += pairs;
                if own.iter().any(|a| of_other.iter().any(|b| meet(a, b, apart))) {
                    overlaps = true;
                    break 'all;
                }
                // What reaches into the other is looked for among as many pairs, both ways.
                work += 2 * pairs;
                if is_inside(moved[n].inside, &of_other)
                    || is_inside(other.inside, &own)
                    || reaches_into(&own, &of_other)
                    || reaches_into(&of_other, &own)
                {
                    overlaps = true;
                    break 'all;
                }
            }
        }
        self.work += work;
        overlaps
    }

    /// Takes some hinges and their images out of the folds and parts their pieces there.
    pub(super) fn unfold(&mut self, hinges: &[usize]) {
        let Some(mirror) = self.mirror else { return self.unfold_alone(hinges) };
        let mut both: Vec<usize> = hinges.iter().flat_map(|&n| [n, mirror.image(n)]).collect();
        both.sort_unstable();
        both.dedup();
        self.unfold_alone(&both);
    }

    fn unfold_alone(&mut self, hinges: &[usize]) {
        let mut touched: Vec<usize> = Vec::new();
        for &n in hinges.iter().filter(|&&n| self.folded[n]) {
            touched.push(self.of_facet[self.facets.hinges[n].facets[0]]);
        }
        hinges.iter().for_each(|&n| self.folded[n] = false);
        touched.sort_unstable();
        touched.dedup();
        for piece in touched {
            self.part(piece);
        }
        // Round a flat vertex, facets hang together the other way round, and nothing opened.
        for &n in hinges {
            let [a, b] = self.facets.hinges[n].facets.map(|f| self.of_facet[f]);
            let is_seam = self.facets.hinges[n].is_seam;
            if a == b && !is_seam && self.is_closed(n, self.ends(n, 0), self.ends(n, 1)) {
                self.folded[n] = true;
                self.name_vertices(a);
            }
        }
    }

    /// Whether the two sides of a hinge lie on one another.
    fn is_closed(&self, hinge: usize, one: [Point2; 2], other: [Point2; 2]) -> bool {
        let Hinge { facets, length_mm, .. } = &self.facets.hinges[hinge];
        let widths = facets.map(|f| self.facets.list[f].width_mm);
        let narrow_mm = widths.into_iter().fold(*length_mm, f64::min);
        let near_mm = (TOGETHER * self.facets.size_mm).min(TOGETHER_OF_FACET * narrow_mm);
        one.iter().zip(other).all(|(p, q)| p.distance(q) <= near_mm)
    }

    /// Divides a piece into what still hangs together.
    fn part(&mut self, piece: usize) {
        let members = std::mem::take(&mut self.members[piece]);
        self.work += FACET_WORK * members.len();
        let mut left: Vec<bool> = vec![false; self.facets.list.len()];
        members.iter().for_each(|&f| left[f] = true);
        let mut free = std::iter::once(piece)
            .chain((0..self.members.len()).filter(|&n| n != piece && self.members[n].is_empty()))
            .collect::<Vec<usize>>()
            .into_iter();
        for &start in &members {
            if !left[start] {
                continue;
            }
            let Some(number) = free.next() else { continue };
            left[start] = false;
            let mut found = vec![start];
            let mut at = 0;
            while at < found.len() {
                let f = found[at];
                at += 1;
                for &n in &self.facets.list[f].hinges {
                    let [a, b] = self.facets.hinges[n].facets;
                    let other = if a == f { b } else { a };
                    if self.folded[n] && left[other] {
                        left[other] = false;
                        found.push(other);
                    }
                }
            }
            found.iter().for_each(|&f| self.of_facet[f] = number);
            self.members[number] = found;
            self.name_vertices(number);
        }
    }
}

/// The box around some facets.
fn around<'l>(laid: impl Iterator<Item = &'l Laid>) -> Laid {
    let boxes = laid.flat_map(|laid| [laid.min, laid.max]).collect::<Vec<_>>();
    Laid::new(boxes, Vec::new(), Point2::default())
}
