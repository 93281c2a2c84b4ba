//! Stretches of the boundary that lie in a plane along the axes and bend one way: what their rungs
//! cost is known before any is looked at. Keels lie in such planes, and so do transoms, arcs of
//! templates and walls.
//!
//! Let the tangent turn by less than half a turn from sample i to sample j, all the way to the same
//! side. Then so do the edges between, and the rung ⟨i,j⟩, the sum of them, leads to that side of
//! the tangent at i, and to the other side of that at j. Its normals are both n, the unit vector
//! along the axis, whether it is special or not: they have no other part, and one that is divided
//! by its own length is 1 to the last bit. So w is 0, N is n, and F of triangles between such rungs
//! is 0, as their normals are n, too. Whatever triangulates the stretch from i to j costs nothing,
//! and E(i,j) is 0. Next to the tangent rungs have no planes; edges as close to it end a stretch.

use crate::cost::{LANES, TwistForm};
use crate::triangulate::Terms;

/// The least sine of the angle between an edge and the tangents at its ends: ten times what counts
/// as parallel.
const LEAST_SINE: f64 = 1e-8;
/// The cosine of the most that tangents turn along a stretch, some eight degrees less than half a
/// turn.
const LEAST_COSINE: f64 = -0.99;

/// The flat stretches of a loop, in tiles.
pub(super) struct Flat {
    /// For each tile of samples the end of the tiles that lie with it in one stretch, itself and
    /// later ones; 0 if it does not lie in any.
    ends: Vec<u32>,
    /// N of the rungs within that stretch.
    means: Vec<[f64; 3]>,
}

impl Flat {
    /// Where nothing is known.
    pub(super) const NONE: Self = Self { ends: vec![], means: vec![] };

    /// The stretches of a loop that is numbered in order, where any two samples may be joined.
    pub(super) fn of(terms: &Terms<'_>) -> Self {
        let options = terms.prices.options();
        if !terms.visibility.is_everything() || options.form != TwistForm::Normalised {
            return Self::NONE;
        }
        let count = terms.prices.len() / LANES;
        let mut flat = Self { ends: vec![0; count], means: vec![[0.0; 3]; count] };
        for axis in 0..3 {
            flat.note(terms, axis);
        }
        flat
    }

    /// Notes the stretches in planes across this axis.
    fn note(&mut self, terms: &Terms<'_>, axis: usize) {
        let m = terms.prices.len();
        let sides: Vec<f64> = (0..m - 1).map(|i| side(terms, axis, i)).collect();
        let (mut end, mut of_stretch) = (0, 0.0);
        for tile in 0..self.ends.len() {
            let first = tile * LANES;
            if end <= first {
                (end, of_stretch) = (first + 1, sides[first]);
            }
            // A later tile turns less to the same end.
            while of_stretch != 0.0
                && end < m
                && sides[end - 1] == of_stretch
                && is_within_half_a_turn(terms, axis, [first, end], of_stretch)
            {
                end += 1;
            }
            if end / LANES > tile {
                self.ends[tile] = (end / LANES) as u32;
                self.means[tile][axis] = of_stretch;
            }
        }
    }

    /// N of the rungs between the samples of these two tiles, without edges of the boundary among
    /// them, if they are known to cost nothing, and so does whatever lies below them.
    #[inline(always)]
    pub(super) fn mean(&self, row: usize, column: usize) -> Option<[f64; 3]> {
        let end = *self.ends.get(row)?;
        (column < end as usize).then(|| self.means[row])
    }
}

/// To which side of the tangent at sample i the edge to the next sample leads, and so on to the
/// tangent there, in a plane across the axis: 1 or −1; 0 if they do not lie so.
fn side(terms: &Terms<'_>, axis: usize, i: usize) -> f64 {
    let [(from, out, of_from), (to, into, of_to)] = [i, i + 1].map(|i| terms.prices.smooth_end(i));
    let is_flat = from[axis] == to[axis] && out[axis] == 0.0 && into[axis] == 0.0;
    // Corners have another tangent besides.
    if !is_flat || of_from < 0.0 || of_to < 0.0 {
        return 0.0;
    }
    let edge = [0, 1, 2].map(|axis| to[axis] - from[axis]);
    let least = LEAST_SINE * edge.iter().map(|x| x.abs()).sum::<f64>();
    let turns = [turn(axis, out, edge), turn(axis, edge, into)];
    let is_forwards = along(axis, out, edge) > 0.0 && along(axis, edge, into) > 0.0;
    match turns {
        _ if !is_forwards => 0.0,
        [a, b] if a > least && b > least => 1.0,
        [a, b] if a < -least && b < -least => -1.0,
        _ => 0.0,
    }
}

fn is_within_half_a_turn(
    terms: &Terms<'_>,
    axis: usize,
    [from, to]: [usize; 2],
    side: f64,
) -> bool {
    let [from, to] = [from, to].map(|i| terms.prices.smooth_end(i).1);
    side * turn(axis, from, to) > 0.0 && along(axis, from, to) > LEAST_COSINE
}

/// The part of a × b along the axis.
fn turn(axis: usize, a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y] = [(axis + 1) % 3, (axis + 2) % 3];
    a[x] * b[y] - a[y] * b[x]
}

/// The product of the parts of two vectors across the axis.
fn along(axis: usize, a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y] = [(axis + 1) % 3, (axis + 2) % 3];
    a[x] * b[x] + a[y] * b[y]
}

#[cfg(test)]
mod tests {
    use super::super::open::Open;
    use super::super::solve_priced;
    use super::super::table::Table;
    use super::*;
    use crate::cost::{PriceOptions, Prices};
    use crate::rung::Visibility;
    use sheetwright_geometry::boundary::{Boundary, samples_from_points};
    use sheetwright_geometry::curve::CurvePoint;
    use sheetwright_geometry::math::{Point3, cos, sin};
    use sheetwright_geometry::watch::Unwatched;
    use sheetwright_shapes::random::Random;
    use std::f64::consts::TAU;

    /// A loop with an arc, perhaps a wavy or a straight one, in a plane across an axis, closed by a
    /// curve in space.
    fn with_arc(m: usize, axis: usize, random: &mut Random) -> Option<Boundary> {
        let (turn, wave) = (random.between(0.4, 1.4), random.between(-0.1, 0.1));
        let bend = [1.0, 1.0, -1.0, 0.0][random.below(4)];
        let point = |i: usize| {
            let t = 2.0 * i as f64 / m as f64;
            let at = if t <= 1.0 {
                let angle = turn * TAU * (t - 0.5);
                let r = 1.0 + wave * sin(3.0 * TAU * t);
                [0.3, r * sin(angle), bend * r * cos(angle)]
            } else {
                let (angle, s) = (turn * TAU * (1.5 - t), sin(0.5 * TAU * (t - 1.0)));
                [0.3 + s, sin(angle) + 0.3 * s, bend * cos(angle) - s]
            };
            let mut turned = [0.0; 3];
            (0..3).for_each(|n| turned[(axis + n) % 3] = at[n]);
            let [x, y, z] = turned;
            CurvePoint { corner: 2 * i == m || i == 0, ..CurvePoint::smooth(Point3::new(x, y, z)) }
        };
        let samples = samples_from_points(&(0..m).map(point).collect::<Vec<_>>());
        Boundary::new(vec![samples]).ok()
    }

    #[test]
    fn all_of_a_flat_tile_is_what_it_is_said_to_be() {
        let mut random = Random::new(9);
        let (mut tiles, mut opposite, mut loops) = (0, 0, 0);
        for case in 0..90 {
            let m = [160, 323, 640][case % 3];
            // Some cross themselves.
            let Some(boundary) = with_arc(m, case / 3 % 3, &mut random) else { continue };
            let fold = [0.0, 1.0][case % 2];
            let prices = Prices::new(&boundary, None, PriceOptions { fold, ..Default::default() });
            let everything = Visibility::everything();
            let terms = Terms::new(&prices, &everything, false);
            let open = Open::new(&terms, 1.0, None);
            let mut plain = Table::new(&terms);
            let unflat = Open::new(&terms, 1.0, None).without_spans();
            plain.fill_open(&unflat, &mut Unwatched, 0.0..1.0).unwrap();
            let count = prices.len().div_ceil(LANES);
            let before = tiles;
            for (row, column) in (0..count).flat_map(|row| (row..count).map(move |at| (row, at))) {
                let Some(mean) = open.flat_mean(row, column) else { continue };
                for i in row * LANES..(row + 1) * LANES {
                    for j in column * LANES..(column + 1) * LANES {
                        let planes = prices.planes(i, j).unwrap();
                        assert_eq!(prices.rung(i, j, &planes), 0.0, "{case}: {i} {j}");
                        assert_eq!(planes.mean.to_array(), mean, "{case}: {i} {j}");
                        assert_eq!(plain.entry(i, j), 0.0, "{case}: {i} {j}");
                    }
                }
                tiles += 1;
                opposite += usize::from(mean.iter().sum::<f64>() < 0.0);
            }
            loops += usize::from(tiles > before);
            // Flat stretches change no triangle of the answer.
            let solved = solve_priced(&terms, &mut Unwatched).unwrap().unwrap();
            if solved.price <= 1.0 {
                assert_eq!(plain.entry(0, prices.len() - 1), solved.price, "{case}");
                let sorted = |mut triangles: Vec<[usize; 3]>| {
                    triangles.sort_unstable();
                    triangles
                };
                assert_eq!(sorted(plain.trace()), sorted(solved.triangles), "{case}");
            }
        }
        assert!(tiles > 1000 && opposite > 100 && loops > 20, "{tiles} {opposite} {loops}");
    }
}
