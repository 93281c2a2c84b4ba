//! Warm start: an upper bound from the triangulation of the boundary before it moved.
//!
//! Samples that move by a hundredth of the size may turn cheap rungs into dear ones, and a bound of
//! twice the price keeps many more entries of the table. So the known triangulation is repaired by
//! flips: a rung between two triangles is exchanged for the other diagonal while that lowers the
//! price. That takes a small part of the time of the table, and ends at or near the optimum.
//!
//! Exchanges of single rungs may end far from the cheapest, or, where a bay of the boundary has
//! turned the other way, among rungs that are barred now. Then a band of the table about the rungs
//! that are known is filled for a bound: it finds what takes many exchanges at once.

use super::HIGHEST_BOUND;
use super::upper_bound::price_near;
use crate::triangulate::{EDGE, Side, Terms, TriangulateError, Triangulation};
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::watch::Watch;

/// Limit of the rungs tested for a flip, for each sample.
const MOST_LOOKS: usize = 32;
/// What costs more than so many times what it did before is taken to be far from the cheapest.
const MUCH_DEARER: f64 = 4.0;

/// Whether it is one of a loop with as many samples.
pub(in crate::triangulate) fn is_of(known: &Triangulation, lengths: &[usize]) -> bool {
    // With holes there are more triangles, and more rungs than that.
    lengths.len() == 1
        && known.triangles.len() + 2 == lengths[0]
        && known.rungs.len() + 3 == lengths[0]
}

/// What a triangulation costs now that is mended from one that is known: no less than the cheapest.
/// `None` if it has rungs that may not be used now, or if nothing is known.
pub(in crate::triangulate) fn price(
    terms: &Terms<'_>,
    known: Option<&Triangulation>,
) -> Option<f64> {
    Some(Mended::of(terms, known?)?.price())
}

/// A bound on the cheapest price, if one is found: what a triangulation costs now that is mended
/// from one that is known. Where that is much more than it cost, or a rung stays barred, exchanges
/// have led astray from it, and there may be a cheap one near to the rungs that are known.
pub(in crate::triangulate) fn bound(
    terms: &Terms<'_>,
    known: Option<&Triangulation>,
    watch: &mut dyn Watch,
) -> Result<Option<f64>, TriangulateError> {
    let Some(known) = known else { return Ok(None) };
    let mut bound = price(terms, Some(known)).unwrap_or(f64::INFINITY);
    // Beside what cost nothing all is much dearer, and tables as cheap as that take less than a
    // band.
    if bound > MUCH_DEARER * known.price && known.price > 0.0 {
        let triangles = known.triangles.iter().map(|corners| corners.map(SampleIndex::get));
        bound = price_near(terms, triangles, bound, watch)?;
    }
    Ok(Some(bound).filter(|bound| *bound <= HIGHEST_BOUND))
}

/// A rung or an edge of the boundary.
#[derive(Clone, Copy)]
struct Line {
    side: Side,
    /// The far corners of its triangles; an edge has one, twice.
    far: [usize; 2],
}

impl Line {
    fn is_rung(&self) -> bool {
        self.far[0] != self.far[1]
    }
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

/// A triangulation under repair.
struct Mended<'a> {
    terms: &'a Terms<'a>,
    lines: Lines,
}

fn ends(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

impl<'a> Mended<'a> {
    /// Mended from one that is known; `None` where a rung stays barred.
    fn of(terms: &'a Terms<'a>, known: &Triangulation) -> Option<Self> {
        let mut mended = Self::new(terms, known);
        mended.mend();
        (mended.price() < f64::INFINITY).then_some(mended)
    }

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

    /// F of the triangle with these corners; one of its sides may not be in the list yet.
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
        let rungs = self.lines.iter().filter(|(_, line)| line.is_rung());
        let mut queue: Vec<[usize; 2]> = rungs.map(|(ends, _)| ends).collect();
        let mut left = MOST_LOOKS * queue.len();
        while let Some([a, b]) = queue.pop() {
            if left == 0 {
                break;
            }
            left -= 1;
            let Some(&line) = self.lines.get([a, b]).filter(|line| line.is_rung()) else {
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

    /// Its triangles, each from its lowest side.
    fn triangles(&self) -> impl Iterator<Item = [usize; 3]> {
        self.lines.iter().flat_map(|([a, b], line)| {
            let count = if line.is_rung() { 2 } else { 1 };
            let far = line.far.into_iter().take(count);
            far.filter(move |far| *far > b).map(move |far| [a, b, far])
        })
    }

    fn price(&self) -> f64 {
        let of_rungs: f64 = self.lines.iter().map(|(_, line)| line.side.price).sum();
        let of_fold = |[a, b, far]: [usize; 3]| self.fold(a, b, far, self.side(a, b));
        let of_folds: f64 = self.triangles().map(of_fold).sum();
        of_rungs + of_folds
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::{PriceOptions, Prices};
    use crate::rung::Visibility;
    use crate::triangulate::{TriangulateOptions, optimal, triangulate};
    use sheetwright_geometry::boundary::{
        Boundary, PlaneChoice, samples_from_points, supporting_plane,
    };
    use sheetwright_geometry::curve::CurvePoint;
    use sheetwright_geometry::math::{Point3, Vec3, cos, sin};
    use sheetwright_geometry::watch::Unwatched;

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
                let rungs = mended.lines.iter().filter(|(_, line)| line.is_rung());
                assert_eq!((rungs.count(), mended.lines.iter().count()), (57, 117));
            }
        }
    }

    /// A round curve with a bay of this depth, or a bulge, where it turns by `at`.
    fn round(depth: f64, at: f64, m: usize) -> Boundary {
        let at = |i: usize| {
            let t = std::f64::consts::TAU * i as f64 / m as f64;
            let near = 0.5 + 0.5 * cos(t - at);
            let bay = (0..4).fold(near, |bay, _| bay * bay);
            let r = 1.0 - depth * bay;
            // Turned up, so that rungs run across.
            Point3::new(r * cos(t), r * sin(t), 0.1 * sin(2.0 * t) + 0.1 * cos(3.0 * t) + 0.3 * bay)
        };
        let points: Vec<CurvePoint> = (0..m).map(|i| CurvePoint::smooth(at(i))).collect();
        Boundary::new(vec![samples_from_points(&points)]).unwrap()
    }

    #[test]
    fn what_lies_across_a_bay_has_a_bound() {
        let m = 80;
        let (mut barred, mut bounded) = (0, 0);
        for (n, fold) in [0.0, 1.0].into_iter().cycle().take(24).enumerate() {
            let price = PriceOptions { fold, ..PriceOptions::default() };
            let options = TriangulateOptions { price, ..TriangulateOptions::default() };
            let at = 0.3 * n as f64;
            let choice = PlaneChoice::Normal(Vec3::Z);
            let (before, now) = (round(0.0, at, m), round(0.15, at, m));
            let plane = |b: &Boundary| supporting_plane(b, choice).unwrap().unwrap();
            let solve =
                |b: &Boundary| triangulate(b, Some(&plane(b)), &options, &mut Unwatched).unwrap();
            let (known, cheapest) = (solve(&before), solve(&now));
            let (prices, plane) = (Prices::new(&now, Some(&plane(&now)), price), plane(&now));
            let visibility = Visibility::new(&now, Some(&plane));
            let terms = Terms::new(&prices, &visibility, false);
            let mended = Mended::of(&terms, &known).map(|mended| mended.price());
            barred += usize::from(mended.is_none());
            assert!(mended.is_none_or(|price| cheapest.price <= price), "{n}");
            let bound = bound(&terms, Some(&known), &mut Unwatched).unwrap();
            assert!(bound.is_none_or(|bound| cheapest.price <= bound), "{n}");
            bounded += usize::from(mended.is_none() && bound.is_some());
            let solve = |known| optimal::solve(&terms, known, &mut Unwatched).unwrap();
            assert_eq!(solve(Some(&known)), solve(None), "{n}");
        }
        assert!(barred > 5 && 2 * bounded > barred, "{barred} {bounded}");
    }
}
