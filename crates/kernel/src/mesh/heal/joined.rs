//! Sides of the border that lie along one another become one.
//!
//! Points are joined only where sides are: points that lie in one place without a side in common
//! stay as they are, and so does a point on a side that no other side lies along.
//!
//! 1. Vertices of the border that lie in one place get one name ([`named`]).
//! 2. Every side of the border becomes a chain of names, those on it between those of its ends, and
//!    is divided into steps from name to name ([`chain`]).
//! 3. Steps with the names of another side's step are joined: both vertices of a name become one,
//!    and names between the ends of a side divide its triangle.
//!
//! How far points may lie apart depends on the triangles there: no further than a tenth of the
//! height of each, so that no narrow strip is joined with itself. What fits best comes first: sides
//! with equal ends, then those whose ends lie near to one another, and only where neither is found
//! are sides divided. So no point of a low triangle divides its neighbours.

use super::fillers::Fillers;
use super::{BorderSide, Damage, Work, border, places};
use crate::mesh::tree::{Extent, Tree};
use sheetwright_geometry::disjoint::DisjointSets;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::Vec3;
use std::collections::BTreeMap;

/// Points lie in one place within this share of the height of the triangles there.
const OF_HEIGHT: f64 = 0.1;
/// Points lie in one place within this share of the sides there, and on a side within this share of
/// the way to its ends, so that no side turns by more: half a degree.
const OF_LENGTH: f64 = 0.01;
/// Where the numbers of the file are rounded, a point that is off a side by no more than that is on
/// it within this share of the way to its ends.
const ROUNDED_OF_LENGTH: f64 = 0.1;

/// The sides of the border of a mesh, with what is near to each.
struct Border {
    sides: Vec<BorderSide>,
    /// How far from each side points may lie that are on it, mm.
    reach: Vec<f64>,
    /// The vertices at its ends.
    vertices: Vec<VertexIndex>,
    tree: Tree,
    /// The first of the vertices that lie in one place, by the number of a vertex.
    name: Vec<VertexIndex>,
    /// A vertex of the border in each of the places that fillers know.
    in_place: BTreeMap<usize, VertexIndex>,
}

/// Which sides are joined.
#[derive(Clone, Copy, PartialEq)]
enum Fit {
    /// Those with equal ends.
    Equal,
    /// Those whose ends lie near to one another.
    Near,
    /// Those that lie along one another in part.
    InPart,
}

/// Joins the sides of the border that lie along one another.
pub(super) fn join(work: &mut Work, fillers: &Fillers) {
    let mut sides = border(&work.triangles);
    for fit in [Fit::Equal, Fit::Near, Fit::InPart] {
        if sides.is_empty() {
            return;
        }
        let border = named(work, sides, fillers, fit);
        let whole = |side: &BorderSide| side.ends.map(|v| border.name[v.get()]).to_vec();
        let chains: Vec<Vec<VertexIndex>> = match fit {
            Fit::InPart => {
                (0..border.sides.len()).map(|n| chain(work, &border, fillers, n)).collect()
            }
            Fit::Equal | Fit::Near => border.sides.iter().map(whole).collect(),
        };
        let is_other = join_steps(work, &border, &chains);
        sides = if is_other { super::border(&work.triangles) } else { border.sides };
    }
}

/// Joins what has the names of another side's step; whether there is something.
fn join_steps(work: &mut Work, border: &Border, chains: &[Vec<VertexIndex>]) -> bool {
    let mut steps: Vec<([VertexIndex; 2], [usize; 2])> = Vec::new();
    for (n, chain) in chains.iter().enumerate() {
        let of_side = chain.windows(2).enumerate();
        steps.extend(of_side.map(|(k, s)| ([s[0].min(s[1]), s[0].max(s[1])], [n, k])));
    }
    steps.sort_unstable();
    let mut one = DisjointSets::new(work.positions.len());
    let (mut joined, mut place) = (0, None);
    // By triangle and corner, the names that divide the side which begins there.
    let mut dividing: BTreeMap<[usize; 2], Vec<VertexIndex>> = BTreeMap::new();
    for group in steps.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1) {
        for name in group[0].0 {
            let mut owners = Vec::with_capacity(group.len());
            for &(_, [n, _]) in group {
                let (side, chain) = (&border.sides[n], &chains[n]);
                match chain.iter().position(|&other| other == name) {
                    Some(0) => owners.push(side.ends[0]),
                    Some(k) if k + 1 == chain.len() => owners.push(side.ends[1]),
                    _ => {
                        let on = dividing.entry([side.triangle, side.at]).or_default();
                        if !on.contains(&name) {
                            on.push(name);
                        }
                        owners.push(name);
                    }
                }
            }
            for pair in owners.windows(2) {
                if one.join(pair[0].get(), pair[1].get()) {
                    joined += 1;
                    place.get_or_insert(work.at(pair[1]));
                }
            }
        }
    }
    if joined == 0 && dividing.is_empty() {
        return false;
    }
    work.note(Damage::Seam, joined, place);
    divide(work, border, chains, &dividing, &one.all_first());
    true
}

/// The border with a name for every vertex.
fn named(work: &Work, sides: Vec<BorderSide>, fillers: &Fillers, fit: Fit) -> Border {
    if fit == Fit::Equal {
        let name = places(&work.positions).into_iter().map(VertexIndex::new).collect();
        return Border {
            sides,
            reach: Vec::new(),
            vertices: Vec::new(),
            tree: Tree::new(&[]),
            name,
            in_place: BTreeMap::new(),
        };
    }
    let mut around = vec![f64::INFINITY; work.positions.len()];
    let mut reach = Vec::with_capacity(sides.len());
    for side in &sides {
        let corners = work.corners(work.triangles[side.triangle]);
        let [a, b, c] = [0, 1, 2].map(|k| corners[(side.at + k) % 3]);
        let length = a.distance(b);
        let height = (b - a).cross(c - a).length() / length;
        let of_side = work.reach.min(OF_HEIGHT * height);
        for end in side.ends {
            let least = around[end.get()].min(of_side).min(OF_LENGTH * length);
            around[end.get()] = least;
        }
        reach.push(of_side);
    }
    let vertices = (0..around.len()).filter(|&v| around[v].is_finite());
    let vertices: Vec<VertexIndex> = vertices.map(VertexIndex::new).collect();
    let extents: Vec<Extent> =
        vertices.iter().map(|&v| Extent::of([work.at(v).to_vec()])).collect();
    let tree = Tree::new(&extents);
    let mut one = DisjointSets::new(work.positions.len());
    for &vertex in &vertices {
        let (here, near) = (work.at(vertex), around[vertex.get()]);
        tree.visit(
            &mut one,
            |_, extent| extent.distance(here.to_vec()) <= near,
            |one, n| {
                let other = vertices[n];
                let is_one = here.distance(work.at(other)) <= near.min(around[other.get()]);
                if other < vertex && is_one {
                    one.join(vertex.get(), other.get());
                }
            },
        );
    }
    let name = one.all_first().into_iter().map(VertexIndex::new).collect();
    let in_place = vertices.iter().filter_map(|&v| Some((fillers.place(v)?, v))).collect();
    Border { sides, reach, vertices, tree, name, in_place }
}

/// The names along a side, from its lower end to its higher.
fn chain(work: &Work, border: &Border, fillers: &Fillers, n: usize) -> Vec<VertexIndex> {
    let side = &border.sides[n];
    let name = |v: VertexIndex| border.name[v.get()];
    let [from, to] = side.ends.map(|v| work.at(v));
    let reach = border.reach[n];
    let (way, length) = (to - from, from.distance(to));
    let along = |p: Vec3| (p - from.to_vec()).dot(way) / length;
    let own = work.triangles[side.triangle].map(name);
    let mut on: Vec<(f64, VertexIndex)> = Vec::new();
    border.tree.visit(
        &mut on,
        |_, extent| extent.is_near_line(from.to_vec(), to.to_vec(), reach),
        |on, n| {
            let vertex = border.vertices[n];
            let p = work.at(vertex);
            let t = along(p.to_vec());
            let to_end = t.min(length - t);
            let off = (p - from - way * (t / length)).length();
            let share = if off <= work.rounding { ROUNDED_OF_LENGTH } else { OF_LENGTH };
            let is_on = off <= reach && to_end > reach && off <= share * to_end;
            if is_on && !own.contains(&name(vertex)) {
                on.push((t, name(vertex)));
            }
        },
    );
    let known = fillers.on(side.ends).into_iter().filter_map(|place| border.in_place.get(&place));
    let known = known.filter(|v| !own.contains(&name(**v)));
    on.extend(known.map(|&v| (along(work.at(v).to_vec()), name(v))));
    on.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut names = vec![name(side.ends[0])];
    for (_, name) in on {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names.push(name(side.ends[1]));
    names
}

/// Divides triangles at the names on their sides, and gives vertices that are one their lowest
/// number.
fn divide(
    work: &mut Work,
    border: &Border,
    chains: &[Vec<VertexIndex>],
    dividing: &BTreeMap<[usize; 2], Vec<VertexIndex>>,
    one: &[usize],
) {
    let renamed = |v: VertexIndex| VertexIndex::new(one[v.get()]);
    let mut on_sides: BTreeMap<usize, [Vec<VertexIndex>; 3]> = BTreeMap::new();
    let (mut count, mut first) = (0, None);
    for (side, chain) in border.sides.iter().zip(chains) {
        let Some(names) = dividing.get(&[side.triangle, side.at]) else { continue };
        let mut on: Vec<VertexIndex> =
            chain.iter().filter(|name| names.contains(name)).map(|&name| renamed(name)).collect();
        if !side.upwards {
            on.reverse();
        }
        count += on.len();
        first = first.or(on.first().map(|&v| work.at(v)));
        on_sides.entry(side.triangle).or_default()[side.at] = on;
    }
    let mut triangles = Vec::with_capacity(work.triangles.len() + count);
    for (n, corners) in work.triangles.iter().enumerate() {
        let corners = corners.map(renamed);
        match on_sides.remove(&n) {
            None => triangles.push(corners),
            Some(on) => triangles.extend(divided(work, corners, on)),
        }
    }
    triangles.retain(|[a, b, c]| a != b && b != c && c != a);
    work.triangles = triangles;
    work.note(Damage::OnSide, count, first);
}

/// A triangle divided at vertices on its sides, each of which is given by the corner at which it
/// begins: through the middle vertex of the longest side that has some to the corner across, and so
/// on with both halves.
pub(super) fn divided(
    work: &Work,
    corners: [VertexIndex; 3],
    on: [Vec<VertexIndex>; 3],
) -> Vec<[VertexIndex; 3]> {
    let mut triangles = Vec::new();
    let mut left = vec![(corners, on)];
    while let Some((corners, mut on)) = left.pop() {
        let length = |k: usize| work.at(corners[k]).distance(work.at(corners[(k + 1) % 3]));
        let sides = (0..3).filter(|&k| !on[k].is_empty());
        let Some(k) = sides.reduce(|most, k| if length(k) > length(most) { k } else { most })
        else {
            triangles.push(corners);
            continue;
        };
        let [a, b, c] = [0, 1, 2].map(|step| corners[(k + step) % 3]);
        let before = std::mem::take(&mut on[k]);
        let half = before.len() / 2;
        let (middle, after) = (before[half], before[half + 1..].to_vec());
        let before = before[..half].to_vec();
        let [next, last] = [1, 2].map(|step| std::mem::take(&mut on[(k + step) % 3]));
        left.push(([middle, b, c], [after, next, Vec::new()]));
        left.push(([a, middle, c], [before, Vec::new(), last]));
    }
    triangles
}
