//! What a triangulation that is known from before is worth now.
//!
//! Samples that move by a hundredth of the size may turn cheap rungs into dear ones, and a bound of
//! twice the price keeps many more entries of the table. So the known triangulation is mended first:
//! a rung between two triangles is exchanged for the other diagonal of theirs as long as that makes
//! it cheaper. That takes a small part of what the table takes, and ends at or near the optimum.

use super::{EDGE, Side, Terms, Triangulation};
use crate::index::SampleIndex;

/// Rungs that are looked at, at the most, for each sample.
const MOST_LOOKS: usize = 32;

/// Whether it is one of a loop with as many samples.
pub(super) fn is_of(known: &Triangulation, lengths: &[usize]) -> bool {
    // With holes there are more triangles, and more rungs than that.
    lengths.len() == 1
        && known.triangles.len() + 2 == lengths[0]
        && known.rungs.len() + 3 == lengths[0]
}

/// What a triangulation costs now that is mended from one that is known: no less than the cheapest.
/// `None` if it has rungs that may not be used now, or if nothing is known.
pub(super) fn price(terms: &Terms<'_>, known: Option<&Triangulation>) -> Option<f64> {
    let mut mended = Mended::new(terms, known?);
    mended.mend();
    Some(mended.price()).filter(|price| price.is_finite())
}

/// A rung or an edge of the boundary.
#[derive(Clone, Copy)]
struct Line {
    side: Side,
    /// The far corners of its triangles; an edge has one, twice.
    far: [usize; 2],
}

/// The lines of a triangulation, by their ends.
struct Lines {
    /// For each sample those to higher ones, in increasing order: two in the mean.
    rows: Vec<Vec<(usize, Line)>>,
}

impl Lines {
    /// Where a line stands, or would stand, in the row of its lower end.
    fn find(&self, [low, high]: [usize; 2]) -> Result<usize, usize> {
        self.rows[low].binary_search_by_key(&high, |(high, _)| *high)
    }

    fn get(&self, ends: [usize; 2]) -> Option<&Line> {
        self.find(ends).ok().map(|at| &self.rows[ends[0]][at].1)
    }

    fn get_mut(&mut self, ends: [usize; 2]) -> Option<&mut Line> {
        self.find(ends).ok().map(|at| &mut self.rows[ends[0]][at].1)
    }

    fn insert(&mut self, ends: [usize; 2], line: Line) {
        match self.find(ends) {
            Ok(at) => self.rows[ends[0]][at].1 = line,
            Err(at) => self.rows[ends[0]].insert(at, (ends[1], line)),
        }
    }

    fn remove(&mut self, ends: [usize; 2]) {
        if let Ok(at) = self.find(ends) {
            self.rows[ends[0]].remove(at);
        }
    }

    /// All lines with their ends, in order.
    fn iter(&self) -> impl Iterator<Item = ([usize; 2], &Line)> {
        let rows = self.rows.iter().enumerate();
        rows.flat_map(|(low, row)| row.iter().map(move |(high, line)| ([low, *high], line)))
    }
}

/// A triangulation on the way.
struct Mended<'a> {
    terms: &'a Terms<'a>,
    lines: Lines,
}

fn ends(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

impl<'a> Mended<'a> {
    fn new(terms: &'a Terms<'a>, known: &Triangulation) -> Self {
        let mut lines = Lines { rows: vec![Vec::new(); terms.prices.len()] };
        for corners in &known.triangles {
            let [i, k, j] = corners.map(SampleIndex::get);
            for (a, b, far) in [(i, k, j), (k, j, i), (i, j, k)] {
                match lines.get_mut(ends(a, b)) {
                    Some(line) => line.far[1] = far,
                    None => {
                        lines.insert(ends(a, b), Line { side: terms.side(a, b), far: [far; 2] });
                    }
                }
            }
        }
        Self { terms, lines }
    }

    fn side(&self, a: usize, b: usize) -> Side {
        self.lines.get(ends(a, b)).map_or(EDGE, |line| line.side)
    }

    /// F of the triangle with these corners, of which one side may not be there yet.
    fn fold(&self, a: usize, b: usize, far: usize, between: Side) -> f64 {
        let mut corners = [a, b, far];
        corners.sort_unstable();
        let [i, k, j] = corners;
        let mean = |p: usize, q: usize| {
            if ends(p, q) == ends(a, b) { between.mean } else { self.side(p, q).mean }
        };
        self.terms.fold(corners, [mean(i, k), mean(k, j), mean(i, j)])
    }

    /// Exchanges rungs as long as that makes it cheaper, those around an exchanged one again.
    fn mend(&mut self) {
        let is_rung = |line: &Line| line.far[0] != line.far[1];
        let rungs = self.lines.iter().filter(|(_, line)| is_rung(line));
        let mut queue: Vec<[usize; 2]> = rungs.map(|(ends, _)| ends).collect();
        let mut left = MOST_LOOKS * queue.len();
        while let Some([a, b]) = queue.pop() {
            if left == 0 {
                break;
            }
            left -= 1;
            let Some(&line) = self.lines.get([a, b]).filter(|line| is_rung(line)) else {
                continue;
            };
            let [c, d] = line.far;
            let other = self.terms.side(c, d);
            let of = |a, b, far: [usize; 2], side: Side| {
                side.price + self.fold(a, b, far[0], side) + self.fold(a, b, far[1], side)
            };
            if other.price < f64::INFINITY && of(c, d, [a, b], other) < of(a, b, [c, d], line.side)
            {
                self.lines.remove([a, b]);
                self.lines.insert(ends(c, d), Line { side: other, far: [a, b] });
                // Each side of the two triangles: the corner beyond it was one end and is another.
                for (p, q, before, now) in [(a, c, b, d), (b, c, a, d), (a, d, b, c), (b, d, a, c)]
                {
                    if let Some(line) = self.lines.get_mut(ends(p, q)) {
                        for far in &mut line.far {
                            *far = if *far == before { now } else { *far };
                        }
                        queue.push(ends(p, q));
                    }
                }
            }
        }
    }

    fn price(&self) -> f64 {
        let of_rungs: f64 = self.lines.iter().map(|(_, line)| line.side.price).sum();
        // Each triangle is looked at from its lowest side.
        let mut of_folds = 0.0;
        for ([a, b], line) in self.lines.iter() {
            let count = if line.far[0] == line.far[1] { 1 } else { 2 };
            for &far in line.far[..count].iter().filter(|far| **far > b) {
                of_folds += self.fold(a, b, far, line.side);
            }
        }
        of_rungs + of_folds
    }
}

#[cfg(test)]
mod tests {
    use super::super::{TriangulateOptions, Visibility, triangulate};
    use super::*;
    use crate::boundary::{Boundary, samples_from_points};
    use crate::cost::{PriceOptions, Prices};
    use crate::curve::CurvePoint;
    use crate::math::{Point3, cos, sin};
    use crate::watch::Unwatched;

    /// A closed curve that waves this much.
    fn wavy(wave: f64, m: usize) -> Boundary {
        let at = |i: usize| {
            let t = std::f64::consts::TAU * i as f64 / m as f64;
            Point3::new(cos(t), sin(t), 0.3 * sin(3.0 * t) + wave * cos(2.0 * t))
        };
        let points: Vec<CurvePoint> = (0..m).map(|i| CurvePoint::smooth(at(i))).collect();
        Boundary::new(vec![samples_from_points(&points)]).unwrap()
    }

    #[test]
    fn what_is_mended_is_a_triangulation_and_near_the_cheapest() {
        for fold in [0.0, 1.0] {
            let price = PriceOptions { fold, ..PriceOptions::default() };
            let options = TriangulateOptions { price, ..TriangulateOptions::default() };
            let solve = |b: &Boundary| triangulate(b, None, &options, &mut Unwatched).unwrap();
            let known = solve(&wavy(0.0, 60));
            for wave in [0.0, 0.01, 0.1] {
                let now = wavy(wave, 60);
                let (cheapest, prices) = (solve(&now).price, Prices::new(&now, None, price));
                let everything = Visibility::everything();
                let terms = Terms::new(&prices, &everything, false);
                let mut mended = Mended::new(&terms, &known);
                let before = mended.price();
                mended.mend();
                let after = mended.price();
                assert!(
                    cheapest <= after && after <= before,
                    "{wave}: {cheapest} {after} {before}"
                );
                assert!(
                    after < 1.1 * cheapest || wave > 0.05,
                    "{wave}: {cheapest} {after} {before}"
                );
                let rungs = mended.lines.iter().filter(|(_, line)| line.far[0] != line.far[1]);
                assert_eq!((rungs.count(), mended.lines.iter().count()), (57, 117));
            }
        }
    }
}
