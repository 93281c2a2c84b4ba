//! A sheet laid flat while it is divided: triangles that straight lines are cut through.
//!
//! A line cuts each triangle that it crosses into two or three. Where it crosses a side, the new
//! vertex lies at one share of that side on the pattern and in space, since a triangle is laid flat
//! by an affine map. It is made once for the side, so both pieces have it to the bit, and the
//! refolded pieces meet without a gap. A vertex that lies all but on the line is taken to lie on
//! it: else slivers would be cut off. Where a piece beside the one that is cut ends in a side that
//! is cut, its triangle is cut there as well, so that all triangles stay side to side.

use super::DivideFault;
use sheetwright_geometry::disjoint::DisjointSets;
use sheetwright_geometry::math::{Point2, Point3, Vec2};
use sheetwright_geometry::predicate::{Box2, signed_area_doubled};
use std::collections::{BTreeMap, BTreeSet};

/// Vertices nearer to a line than this share of the size of the pattern lie on it: 0.02 mm of a
/// hull.
const ON_LINE: f64 = 1e-6;

/// A vertex of a sheet that is divided.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Vertex {
    /// Where it lies in the sheet, mm.
    pub(crate) space: Point3,
    /// Where it was drawn, mm: elsewhere where the sheet is a neutral surface.
    pub(crate) drawn: Point3,
    /// Where it lies on the pattern, mm.
    pub(crate) flat: Point2,
    /// The vertices of the whole sheet that it lies between, in increasing order: one is itself,
    /// two are the ends of a side, three the corners of a triangle.
    pub(crate) between: Vec<usize>,
}

/// A triangle of a sheet that is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Facet {
    /// Its corners, in the direction of those of the triangle that it was cut from.
    pub(crate) corners: [usize; 3],
    /// The piece that it is of.
    pub(crate) piece: usize,
}

impl Facet {
    /// Its sides, the facet to their left.
    fn sides(&self) -> [[usize; 2]; 3] {
        let [a, b, c] = self.corners;
        [[a, b], [b, c], [c, a]]
    }
}

/// A sheet laid flat while it is divided into pieces.
#[derive(Clone, Debug)]
pub(crate) struct Dividing {
    vertices: Vec<Vertex>,
    facets: Vec<Facet>,
    /// How many pieces there have been.
    pieces: usize,
    /// Vertices nearer to a line lie on it, mm.
    on_line_mm: f64,
}

/// The new vertices of a cut, by the sides that they lie on, lower end first.
type CutSides = BTreeMap<[usize; 2], usize>;

/// The border of a piece.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Border {
    /// Its loops, the piece to their left: the outline first.
    pub(crate) loops: Vec<Vec<usize>>,
}

impl Border {
    /// The steps along it, loop after loop.
    pub(crate) fn steps(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.loops.iter().flat_map(|line| {
            let next = line.iter().cycle().skip(1);
            line.iter().zip(next).map(|(&a, &b)| [a, b])
        })
    }
}

impl Dividing {
    /// A sheet in one piece, of number 0.
    pub(crate) fn new(vertices: Vec<Vertex>, triangles: &[[usize; 3]]) -> Self {
        let facets = triangles.iter().map(|&corners| Facet { corners, piece: 0 }).collect();
        let around = Box2::of_points(vertices.iter().map(|vertex| vertex.flat));
        let size_mm = around.map_or(0.0, |around| (around.max - around.min).length());
        Self { vertices, facets, pieces: 1, on_line_mm: ON_LINE * size_mm }
    }

    pub(crate) fn vertex(&self, vertex: usize) -> &Vertex {
        &self.vertices[vertex]
    }

    pub(crate) fn flat(&self, vertex: usize) -> Point2 {
        self.vertices[vertex].flat
    }

    /// The triangles of a piece, in the order of those that they were cut from.
    pub(crate) fn facets(&self, piece: usize) -> impl Iterator<Item = [usize; 3]> + '_ {
        self.facets.iter().filter(move |facet| facet.piece == piece).map(|facet| facet.corners)
    }

    /// Cuts a piece along straight lines square to a direction, which lie at these distances along
    /// it in increasing order, mm. Returns the numbers of the pieces that it falls into, in that
    /// order; those between two lines that don't hang together are several.
    pub(crate) fn cut(&mut self, piece: usize, along: Vec2, at: &[f64]) -> Vec<usize> {
        for &at in at {
            self.cut_once(piece, along, at);
        }
        let of_piece: Vec<usize> =
            (0..self.facets.len()).filter(|&n| self.facets[n].piece == piece).collect();
        let slab = |n: usize| {
            let corners = self.facets[n].corners.map(|v| self.flat(v).to_vec().dot(along));
            let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
            at.iter().filter(|&&at| middle > at).count()
        };
        let slabs: Vec<usize> = of_piece.iter().map(|&n| slab(n)).collect();
        let mut sets = DisjointSets::new(of_piece.len());
        let mut across: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        for (k, &n) in of_piece.iter().enumerate() {
            for [a, b] in self.facets[n].sides() {
                match across.remove(&[b, a]) {
                    Some(other) if slabs[other] == slabs[k] => {
                        sets.join(other, k);
                    }
                    Some(_) => {}
                    None => {
                        across.insert([a, b], k);
                    }
                }
            }
        }
        let mut groups: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
        for (k, first) in sets.all_first().into_iter().enumerate() {
            groups.entry((slabs[k], first)).or_default().push(of_piece[k]);
        }
        let mut made = Vec::with_capacity(groups.len());
        for facets in groups.into_values() {
            facets.into_iter().for_each(|n| self.facets[n].piece = self.pieces);
            made.push(self.pieces);
            self.pieces += 1;
        }
        made
    }

    fn cut_once(&mut self, piece: usize, along: Vec2, at: f64) {
        let mut sides = CutSides::new();
        let mut cut = Vec::with_capacity(self.facets.len() + 2);
        for facet in std::mem::take(&mut self.facets) {
            if facet.piece == piece {
                let parts = self.cut_facet(facet.corners, along, at, &mut sides);
                cut.extend(parts.into_iter().map(|corners| Facet { corners, piece }));
            } else {
                cut.push(facet);
            }
        }
        // Pieces beside it.
        let mut left = cut;
        left.reverse();
        while let Some(facet) = left.pop() {
            let of_side = |[a, b]: [usize; 2]| sides.get(&[a.min(b), a.max(b)]).copied();
            let Some(n) = (0..3).find(|&n| of_side(facet.sides()[n]).is_some()) else {
                self.facets.push(facet);
                continue;
            };
            let [a, b] = facet.sides()[n];
            let far = facet.corners[(n + 2) % 3];
            let Some(middle) = of_side([a, b]) else { continue };
            left.push(Facet { corners: [middle, b, far], ..facet });
            left.push(Facet { corners: [a, middle, far], ..facet });
        }
    }

    /// How far a vertex lies beyond a line, mm; 0 of one that lies all but on it.
    fn beyond(&self, vertex: usize, along: Vec2, at: f64) -> f64 {
        let off = self.flat(vertex).to_vec().dot(along) - at;
        if off.abs() <= self.on_line_mm { 0.0 } else { off }
    }

    /// The triangles that a line cuts one into; itself where it does not cross it.
    fn cut_facet(
        &mut self,
        corners: [usize; 3],
        along: Vec2,
        at: f64,
        sides: &mut CutSides,
    ) -> Vec<[usize; 3]> {
        let off = corners.map(|v| self.beyond(v, along, at));
        let is_crossed = off.iter().any(|&off| off > 0.0) && off.iter().any(|&off| off < 0.0);
        if !is_crossed {
            return vec![corners];
        }
        let turned = |n: usize| [corners[n], corners[(n + 1) % 3], corners[(n + 2) % 3]];
        if let Some(on) = off.iter().position(|&off| off == 0.0) {
            let [on, a, b] = turned(on);
            let middle = self.cut_side([a, b], along, at, sides);
            return vec![[on, a, middle], [on, middle, b]];
        }
        // The corner that lies on a side of its own.
        let ahead = off.iter().filter(|&&off| off > 0.0).count() == 1;
        let alone = off.iter().position(|&off| (off > 0.0) == ahead).unwrap_or(0);
        let [alone, a, b] = turned(alone);
        let on_a = self.cut_side([alone, a], along, at, sides);
        let on_b = self.cut_side([alone, b], along, at, sides);
        let far = |from: usize, to: usize| self.flat(from).distance(self.flat(to));
        let mut cut = vec![[alone, on_a, on_b]];
        if far(on_a, b) < far(a, on_b) {
            cut.extend([[on_a, a, b], [on_a, b, on_b]]);
        } else {
            cut.extend([[on_a, a, on_b], [a, b, on_b]]);
        }
        cut
    }

    /// The vertex in which a line crosses a side.
    fn cut_side(&mut self, side: [usize; 2], along: Vec2, at: f64, sides: &mut CutSides) -> usize {
        let [a, b] = [side[0].min(side[1]), side[0].max(side[1])];
        if let Some(&known) = sides.get(&[a, b]) {
            return known;
        }
        let [of_a, of_b] = [a, b].map(|v| self.beyond(v, along, at));
        let share = of_a / (of_a - of_b);
        let (from, to) = (&self.vertices[a], &self.vertices[b]);
        let mut between: Vec<usize> = from.between.iter().chain(&to.between).copied().collect();
        between.sort_unstable();
        between.dedup();
        self.vertices.push(Vertex {
            space: from.space.lerp(to.space, share),
            drawn: from.drawn.lerp(to.drawn, share),
            flat: from.flat.lerp(to.flat, share),
            between,
        });
        let made = self.vertices.len() - 1;
        sides.insert([a, b], made);
        made
    }

    /// The sides of the triangles of all pieces but one.
    pub(super) fn sides_beside(&self, piece: usize) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.facets.iter().filter(move |facet| facet.piece != piece).flat_map(Facet::sides)
    }

    /// The border of a piece.
    ///
    /// # Errors
    /// A piece that hangs together in a point alone.
    pub(crate) fn border(&self, piece: usize) -> Result<Border, DivideFault> {
        let mut steps: BTreeSet<[usize; 2]> = BTreeSet::new();
        for facet in self.facets.iter().filter(|facet| facet.piece == piece) {
            for [a, b] in facet.sides() {
                if !steps.remove(&[b, a]) {
                    steps.insert([a, b]);
                }
            }
        }
        let mut next: BTreeMap<usize, usize> = BTreeMap::new();
        for [a, b] in steps {
            if next.insert(a, b).is_some() {
                return Err(DivideFault::Pinched);
            }
        }
        let mut loops: Vec<Vec<usize>> = Vec::new();
        while let Some((&first, _)) = next.first_key_value() {
            let mut line = Vec::new();
            let mut at = first;
            while let Some(to) = next.remove(&at) {
                line.push(at);
                at = to;
            }
            loops.push(line);
        }
        let area = |line: &Vec<usize>| {
            let points: Vec<Point2> = line.iter().map(|&v| self.flat(v)).collect();
            signed_area_doubled(&points)
        };
        loops.sort_by(|a, b| area(b).total_cmp(&area(a)));
        Ok(Border { loops })
    }
}
