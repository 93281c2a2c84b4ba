//! Boundaries joined into one: P1 ⊕ P2 (equation 7, \[L11\]).
//!
//! Two panels that face the same side walk their shared edges in opposite directions. Those pairs
//! of edges cancel. Where a shared run ends, the walk along the remaining edges passes from one
//! panel into the other: in the formula, …, b1_{i−1}, b2_{j+1}, …, b2_{j−1}, b1_{i+1}, …. So
//!
//! * of a shared run, the two end points stay and the interior goes;
//! * several shared runs leave several loops: the largest is the outer one, the others are holes;
//! * a panel that fills a hole leaves no hole, and holes that no other panel touches stay;
//! * two boundaries that meet at one sample alone lose it, as the formula says: straight edges
//!   between its neighbours join the two at a neck.
//!
//! A second boundary that walks the shared edges the same way is turned round first. Which samples
//! are on one spot is decided by distance, everything after that by counting.

use super::smooth::{Continuity, JointAt, Node, SmoothedJoint, Within, smooth_joints};
use super::{Boundary, BoundaryError, size_of};
use crate::curve::Sample;
use crate::math::{Point3, Vec3, angle_between, unit};
use crate::predicate::for_touching_boxes;
use crate::tolerance::Tolerance;
use std::fmt;

/// How boundaries are joined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JoinOptions {
    /// Samples of two boundaries that are nearer than this share of the size of both are one.
    /// Default: [`Tolerance::SAME_POINT`].
    pub same: Tolerance,
    /// How smooth the loop is made where two boundaries meet. Default: [`Continuity::G0`].
    pub smooth: Continuity,
    /// How far from a joint it is made smooth. Default: 5 % of the length of its loop.
    pub within: Within,
}

impl Default for JoinOptions {
    fn default() -> Self {
        Self { same: Tolerance::SAME_POINT, smooth: Continuity::G0, within: Within::default() }
    }
}

/// Boundaries joined into one.
#[derive(Clone, Debug, PartialEq)]
pub struct Joined {
    /// The boundary of all of them together. It faces as the first one does.
    pub boundary: Boundary,
    /// The joints, where two of the parts meet on it, in the order of its samples.
    pub joints: Vec<SmoothedJoint>,
    /// For each part, whether it was turned round to face as the first does.
    pub turned: Vec<bool>,
}

impl Joined {
    /// The largest distance of the boundary from its parts, mm: the largest deviation of a joint.
    pub fn deviation_mm(&self) -> f64 {
        self.joints.iter().map(|joint| joint.deviation_mm).fold(0.0, f64::max)
    }
}

/// Why boundaries can't be joined.
#[derive(Clone, Debug, PartialEq)]
pub struct JoinError {
    /// The part at fault, counted from 0; `None` if it is no single one.
    pub part: Option<usize>,
    /// What is wrong.
    pub cause: JoinCause,
}

/// What is wrong with boundaries to be joined.
#[derive(Clone, Debug, PartialEq)]
pub enum JoinCause {
    /// Fewer than two boundaries.
    TooFew,
    /// More samples or spans of curves than may be compared with one another.
    TooLarge {
        /// How many there are.
        found: usize,
        /// The limit.
        most: usize,
    },
    /// A distance or share that is not positive and finite, or a share above ½.
    Within,
    /// It shares no sample with the others.
    Apart,
    /// It meets the others at samples with no shared edge between them, besides a shared run or
    /// at several places: the edge that they have in common is sampled differently.
    LooseSamples {
        /// How many.
        count: usize,
    },
    /// An edge of it runs along two edges of the others, or the other way about.
    ManySheets,
    /// It shares edges in both directions, so that no way round faces as the others do: together
    /// they have one side only, as a Möbius strip.
    OneSided,
    /// Together they are no sheet with holes but have a handle.
    Handle,
    /// Together they are closed: nothing bounds them.
    Closed,
    /// Two joints with no sample between them, so that there is nothing to make smooth.
    NoRoom,
    /// The joined loops are no boundary.
    Boundary(BoundaryError),
}

impl fmt::Display for JoinError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(part) = self.part {
            write!(f, "part {}: ", part + 1)?;
        }
        write!(f, "{}", self.cause)
    }
}

impl std::error::Error for JoinError {}

impl fmt::Display for JoinCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew => write!(f, "it takes two boundaries or more to join"),
            Self::TooLarge { found, most } => write!(
                f,
                "the panels have {found} samples and pieces of curves together; {most} are the most"
            ),
            Self::Within => write!(
                f,
                "the way within which joints are made smooth is no length above 0, and no share \
                 above 0 and up to ½"
            ),
            Self::Apart => write!(f, "it shares no sample with the others"),
            Self::LooseSamples { count } => write!(
                f,
                "it meets the others at {count} separate samples, with no shared edge between them"
            ),
            Self::ManySheets => write!(f, "more than two sheets meet along an edge of it"),
            Self::OneSided => {
                write!(f, "it can't face as the others do: together they have one side only")
            }
            Self::Handle => write!(f, "together with the others it has a handle, as a cup has"),
            Self::Closed => write!(f, "together with the others it is closed: no edge is left"),
            Self::NoRoom => {
                write!(f, "two joints have no sample between them, so that none can be made smooth")
            }
            Self::Boundary(error) => write!(f, "{error}"),
        }
    }
}

/// P1 ⊕ P2: two boundaries joined along what they share.
///
/// # Errors
/// See [`JoinCause`].
pub fn join(
    first: &Boundary,
    second: &Boundary,
    options: &JoinOptions,
) -> Result<Joined, JoinError> {
    join_all(&[first, second], options)
}

/// P1 ⊕ P2 ⊕ …: boundaries joined one after the other, and the joints that are left then made
/// smooth. Each step takes the first that shares edges with what is joined already and meets it
/// nowhere else, or else the first that shares one sample; so they may come in any order.
///
/// # Errors
/// See [`JoinCause`].
pub fn join_all(parts: &[&Boundary], options: &JoinOptions) -> Result<Joined, JoinError> {
    let failed = |part: Option<usize>, cause: JoinCause| JoinError { part, cause };
    let [first, _, ..] = parts else { return Err(failed(None, JoinCause::TooFew)) };
    if !options.within.is_valid() {
        return Err(failed(None, JoinCause::Within));
    }
    let positions = parts.iter().flat_map(|part| part.samples()).map(|s| s.position);
    let same_mm = options.same.length_mm(size_of(positions));
    let mut whole = JoinedLoops::of(first);
    let mut turned = vec![false; parts.len()];
    let mut waiting: Vec<usize> = (1..parts.len()).collect();
    while !waiting.is_empty() {
        let mut at_sample = None;
        let mut next = None;
        let mut refused = None;
        for (place, &part) in waiting.iter().enumerate() {
            let sheet = JoinedLoops::of(parts[part]);
            match Contact::between(&whole, &sheet, same_mm).kind() {
                Ok(ContactKind::Edges) => {
                    next = Some((place, sheet));
                    break;
                }
                Ok(ContactKind::Sample) => at_sample = at_sample.or(Some((place, sheet))),
                Ok(ContactKind::Nothing) => {}
                // Other parts may fill the gap, so that edges are shared there later.
                Err(cause) => refused = refused.or(Some(failed(Some(part), cause))),
            }
        }
        let Some((place, sheet)) = next.or(at_sample) else {
            return Err(refused.unwrap_or(failed(Some(waiting[0]), JoinCause::Apart)));
        };
        let part = waiting.remove(place);
        let joined = whole.joined_with(sheet, same_mm);
        (whole, turned[part]) = joined.map_err(|cause| failed(Some(part), cause))?;
    }
    whole.outer_first();
    let mut loops: Vec<Vec<Node>> = whole.loops.into_iter().map(|l| l.nodes).collect();
    let joints = smooth_joints(&mut loops, options.smooth, options.within)
        .ok_or_else(|| failed(None, JoinCause::NoRoom))?;
    let loops = loops.iter().map(|nodes| nodes.iter().map(|node| node.sample).collect()).collect();
    let boundary = Boundary::new(loops).map_err(|e| failed(None, JoinCause::Boundary(e)))?;
    Ok(Joined { boundary, joints, turned })
}

/// A loop that is being joined.
#[derive(Clone)]
struct Ring {
    nodes: Vec<Node>,
    /// Whether its direction is arbitrary: holes of the parts may run either way.
    free: bool,
}

impl Ring {
    /// Walks it the other way.
    fn turn_round(&mut self) {
        self.nodes.reverse();
        let m = self.nodes.len();
        let after: Vec<bool> =
            self.nodes.iter().map(|n| n.joint == Some(JointAt::EdgeAfter)).collect();
        for (n, node) in self.nodes.iter_mut().enumerate() {
            let Sample { tangent_in, tangent_out, .. } = node.sample;
            node.sample.tangent_in = -tangent_out;
            node.sample.tangent_out = -tangent_in;
            // An edge comes after its other end now.
            let comes_after = after[(n + 1) % m];
            node.joint = match node.joint {
                Some(JointAt::Sample) => Some(JointAt::Sample),
                _ => comes_after.then_some(JointAt::EdgeAfter),
            };
        }
    }

    fn area_vector(&self) -> Vec3 {
        let at = |i: usize| self.nodes[i % self.nodes.len()].sample.position;
        (0..self.nodes.len()).map(|i| (at(i) - at(0)).cross(at(i + 1) - at(0))).sum()
    }
}

/// A boundary that is being joined: an oriented sheet with loops, the sheet on their left.
#[derive(Clone)]
struct JoinedLoops {
    loops: Vec<Ring>,
}

impl JoinedLoops {
    fn of(boundary: &Boundary) -> Self {
        let node = |sample: &Sample| Node { sample: *sample, joint: None };
        let ring = |(n, range): (usize, &std::ops::Range<usize>)| Ring {
            nodes: boundary.samples()[range.clone()].iter().map(node).collect(),
            free: n > 0,
        };
        Self { loops: boundary.loops().iter().enumerate().map(ring).collect() }
    }

    fn count(&self) -> usize {
        self.loops.iter().map(|ring| ring.nodes.len()).sum()
    }

    fn nodes(&self) -> impl Iterator<Item = &Node> {
        self.loops.iter().flat_map(|ring| &ring.nodes)
    }

    /// The loop of every node, and the node after every node, counted through all loops.
    fn rings_and_next(&self) -> (Vec<usize>, Vec<usize>) {
        let (mut of_node, mut next) = (Vec::new(), Vec::new());
        for (n, ring) in self.loops.iter().enumerate() {
            let (start, m) = (of_node.len(), ring.nodes.len());
            of_node.extend(std::iter::repeat_n(n, m));
            next.extend((0..m).map(|i| start + (i + 1) % m));
        }
        (of_node, next)
    }

    /// Puts the loop with the largest area first.
    fn outer_first(&mut self) {
        let areas: Vec<f64> = self.loops.iter().map(|r| r.area_vector().length()).collect();
        let outer =
            (0..areas.len()).reduce(|best, n| if areas[n] > areas[best] { n } else { best });
        self.loops[..=outer.unwrap_or(0)].rotate_right(1);
    }

    /// This sheet joined with another that it shares edges or a sample with, and whether the other
    /// was turned round for it.
    fn joined_with(mut self, mut other: Self, same_mm: f64) -> Result<(Self, bool), JoinCause> {
        let contact = Contact::between(&self, &other, same_mm);
        let turned = contact.turn_alike(&mut self, &mut other)?;
        let contact = Contact::between(&self, &other, same_mm);
        let joined = match contact.kind()? {
            ContactKind::Nothing => return Err(JoinCause::Apart),
            ContactKind::Sample => contact.joined_at_sample(&self, &other),
            ContactKind::Edges => contact.joined_along_edges(&self, &other)?,
        };
        Ok((joined, turned))
    }
}

enum ContactKind {
    Nothing,
    Sample,
    Edges,
}

/// An edge of the first sheet and one of the second that join the same two spots; an edge is known
/// by the node that it begins at.
struct SharedEdge {
    edges: [usize; 2],
    same_way: bool,
}

/// What two sheets share. Nodes are counted through all loops, those of each sheet from 0.
struct Contact {
    shared: Vec<SharedEdge>,
    /// Nodes on one spot that end no shared edge.
    loose: Vec<[usize; 2]>,
    /// The loop of each node, for both sheets.
    ring_of: [Vec<usize>; 2],
    next: [Vec<usize>; 2],
}

impl Contact {
    fn between(first: &JoinedLoops, second: &JoinedLoops, same_mm: f64) -> Self {
        let (first_rings, first_next) = first.rings_and_next();
        let (second_rings, second_next) = second.rings_and_next();
        let (ring_of, next) = ([first_rings, second_rings], [first_next, second_next]);
        let count = first.count();
        let positions: Vec<Point3> =
            first.nodes().chain(second.nodes()).map(|node| node.sample.position).collect();
        let half = 0.5 * same_mm;
        let boxes: Vec<(Vec3, Vec3)> =
            positions.iter().map(|p| (p.to_vec() - half, p.to_vec() + half)).collect();
        let mut on_one_spot: Vec<[usize; 2]> = Vec::new();
        for_touching_boxes(&boxes, |i, j| {
            let of_both = i < count && j >= count;
            if of_both && positions[i].distance(positions[j]) <= same_mm {
                on_one_spot.push([i, j - count]);
            }
        });
        on_one_spot.sort_unstable();
        let among = |pair: [usize; 2]| on_one_spot.binary_search(&pair).is_ok();
        let mut shared = Vec::new();
        let mut ends = [vec![false; count], vec![false; second.count()]];
        let mut before = vec![0; second.count()];
        for (j, &after) in next[1].iter().enumerate() {
            before[after] = j;
        }
        for &[i, j] in &on_one_spot {
            let i_next = next[0][i];
            for (j_next, same_way) in [(before[j], false), (next[1][j], true)] {
                if among([i_next, j_next]) {
                    let second = if same_way { j } else { j_next };
                    shared.push(SharedEdge { edges: [i, second], same_way });
                    for (side, node) in [(0, i), (0, i_next), (1, j), (1, j_next)] {
                        ends[side][node] = true;
                    }
                }
            }
        }
        let is_loose = |[i, j]: &[usize; 2]| !ends[0][*i] && !ends[1][*j];
        let loose = on_one_spot.iter().copied().filter(is_loose).collect();
        Self { shared, loose, ring_of, next }
    }

    fn kind(&self) -> Result<ContactKind, JoinCause> {
        match (self.shared.len(), self.loose.len()) {
            (0, 0) => Ok(ContactKind::Nothing),
            (0, 1) => Ok(ContactKind::Sample),
            (_, 0) => Ok(ContactKind::Edges),
            (_, count) => Err(JoinCause::LooseSamples { count }),
        }
    }

    /// Turns loops round until every shared edge is walked in opposite directions. Returns whether
    /// the second sheet was turned. Loops that are not `free` turn with their sheet.
    fn turn_alike(
        &self,
        first: &mut JoinedLoops,
        second: &mut JoinedLoops,
    ) -> Result<bool, JoinCause> {
        let free = [first, second].map(|sheet| {
            let free: Vec<bool> = sheet.loops.iter().map(|ring| ring.free).collect();
            (sheet, free)
        });
        let [(first, first_free), (second, second_free)] = free;
        // None: not known yet.
        let known = |free: &bool| if *free { None } else { Some(false) };
        let mut turns: [Vec<Option<bool>>; 2] =
            [first_free.iter().map(known).collect(), vec![None; second_free.len()]];
        let mut turned = None;
        let rings = |edge: &SharedEdge| [0, 1].map(|side| self.ring_of[side][edge.edges[side]]);
        for edge in &self.shared {
            let [a, b] = rings(edge);
            if !first_free[a] && !second_free[b] {
                turned = turned.or(Some(edge.same_way));
            }
        }
        let turned = turned.unwrap_or(false);
        for (turn, free) in turns[1].iter_mut().zip(&second_free) {
            *turn = (!free).then_some(turned);
        }
        // Each pass settles one free loop at least, or none is left.
        for _ in 0..first_free.len() + second_free.len() {
            for edge in &self.shared {
                let [a, b] = rings(edge);
                match (turns[0][a], turns[1][b]) {
                    (Some(turn), None) => turns[1][b] = Some(turn != edge.same_way),
                    (None, Some(turn)) => turns[0][a] = Some(turn != edge.same_way),
                    (None, None) => turns[0][a] = Some(false),
                    (Some(_), Some(_)) => {}
                }
            }
        }
        let turn = |side: usize, ring: usize| turns[side][ring].unwrap_or(false);
        let alike = |edge: &SharedEdge| {
            let [a, b] = rings(edge);
            (turn(0, a) != turn(1, b)) == edge.same_way
        };
        if !self.shared.iter().all(alike) {
            return Err(JoinCause::OneSided);
        }
        for (side, sheet) in [(0, first), (1, second)] {
            for (n, ring) in sheet.loops.iter_mut().enumerate() {
                if turn(side, n) {
                    ring.turn_round();
                }
            }
        }
        Ok(turned)
    }

    /// The formula for one shared sample: it goes, and straight edges join its neighbours.
    fn joined_at_sample(&self, first: &JoinedLoops, second: &JoinedLoops) -> JoinedLoops {
        let [i, j] = self.loose[0];
        // The other nodes of a loop, from the one after the shared one to the one before.
        let others = |sheet: &JoinedLoops, side: usize, node: usize| -> Vec<Node> {
            let all: Vec<Node> = sheet.nodes().copied().collect();
            let mut list = Vec::new();
            let mut at = self.next[side][node];
            while at != node {
                list.push(all[at]);
                at = self.next[side][at];
            }
            list
        };
        let mut nodes = others(second, 1, j);
        let second_count = nodes.len();
        nodes.extend(others(first, 0, i));
        // Where the first ends and the second begins, and the other way about.
        for (before, after) in [(nodes.len() - 1, 0), (second_count - 1, second_count)] {
            let way = nodes[after].sample.position - nodes[before].sample.position;
            if let Some(across) = unit(way) {
                nodes[before].sample.tangent_out = across;
                nodes[after].sample.tangent_in = across;
            }
            nodes[before].joint = Some(JointAt::EdgeAfter);
        }
        let rings = [self.ring_of[0][i], self.ring_of[1][j]];
        let free = first.loops[rings[0]].free && second.loops[rings[1]].free;
        // The first one's samples keep their place at the beginning, up to the shared one.
        let lead = i - self.ring_of[0].partition_point(|&ring| ring < rings[0]);
        nodes.rotate_right(lead);
        let mut loops = first.loops.clone();
        loops[rings[0]] = Ring { nodes, free };
        let carried = second.loops.iter().enumerate().filter(|(n, _)| *n != rings[1]);
        loops.extend(carried.map(|(_, ring)| ring.clone()));
        JoinedLoops { loops }
    }

    fn joined_along_edges(
        &self,
        first: &JoinedLoops,
        second: &JoinedLoops,
    ) -> Result<JoinedLoops, JoinCause> {
        // Edges of both in one list, those of the second after those of the first.
        let count = first.count();
        let nodes: Vec<Node> = first.nodes().chain(second.nodes()).copied().collect();
        let next = |edge: usize| match edge.checked_sub(count) {
            None => self.next[0][edge],
            Some(edge) => count + self.next[1][edge],
        };
        let mut partner: Vec<Option<usize>> = vec![None; nodes.len()];
        for SharedEdge { edges: [a, b], .. } in &self.shared {
            for (edge, other) in [(*a, count + b), (count + b, *a)] {
                if partner[edge].replace(other).is_some() {
                    return Err(JoinCause::ManySheets);
                }
            }
        }
        let ring_of = |edge: usize| match edge.checked_sub(count) {
            None => &first.loops[self.ring_of[0][edge]],
            Some(edge) => &second.loops[self.ring_of[1][edge]],
        };
        let mut seen = vec![false; nodes.len()];
        let mut loops = Vec::new();
        for start in 0..nodes.len() {
            if seen[start] || partner[start].is_some() {
                continue;
            }
            let mut ring = Ring { nodes: Vec::new(), free: true };
            let mut edge = start;
            while !seen[edge] {
                seen[edge] = true;
                let arrived = next(edge);
                // Round the spot, from sheet to sheet, to the next edge that is left. The way is a
                // permutation that begins outside of every circle, so that it ends.
                let mut leaving = arrived;
                while let Some(other) = partner[leaving] {
                    leaving = next(other);
                }
                ring.nodes.push(meeting(nodes[arrived], nodes[leaving], arrived < count));
                if leaving != arrived {
                    let last = ring.nodes.len() - 1;
                    ring.nodes[last].joint = Some(JointAt::Sample);
                }
                ring.free &= ring_of(edge).free;
                edge = leaving;
            }
            // A loop without joints is as it came.
            ring.free &= ring.nodes.iter().all(|node| node.joint.is_none());
            // The walk begins with the end of its first edge.
            ring.nodes.rotate_right(1);
            loops.push(ring);
        }
        self.refuse_handles(first, second, loops.len())?;
        Ok(JoinedLoops { loops })
    }

    /// Euler's number of the two together, less that of what they share, is that of a sheet with as
    /// many loops as are left: 2 − loops.
    fn refuse_handles(
        &self,
        first: &JoinedLoops,
        second: &JoinedLoops,
        left: usize,
    ) -> Result<(), JoinCause> {
        let spots = |side: usize| {
            let next = &self.next[side];
            let ends = self.shared.iter().flat_map(|e| [e.edges[side], next[e.edges[side]]]);
            let mut ends: Vec<usize> = ends.collect();
            ends.sort_unstable();
            ends.dedup();
            ends.len()
        };
        if spots(0) != spots(1) {
            return Err(JoinCause::ManySheets);
        }
        if left == 0 {
            return Err(JoinCause::Closed);
        }
        let runs = spots(0) - self.shared.len();
        // 2 − a + 2 − b − runs = 2 − left, without negative numbers.
        if left + 2 != first.loops.len() + second.loops.len() + runs {
            return Err(JoinCause::Handle);
        }
        Ok(())
    }
}

/// Tangents at a joint that differ by less, radians, are one, as where curves are chained.
const SAME_DIRECTION: f64 = 1e-7;

/// The node where one boundary is left for another: it arrives as the one and leaves as the other.
fn meeting(arrived: Node, leaving: Node, keep_arrived: bool) -> Node {
    let kept = if keep_arrived { arrived } else { leaving };
    let tangent_out = leaving.sample.tangent_out;
    let bend = angle_between(arrived.sample.tangent_in, tangent_out);
    let tangent_in = if bend < SAME_DIRECTION { tangent_out } else { arrived.sample.tangent_in };
    Node { sample: Sample { position: kept.sample.position, tangent_in, tangent_out }, ..kept }
}
