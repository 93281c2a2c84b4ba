//! A boundary of any loops, cut by parallel planes, and the boundaries of its parts.
//!
//! Seen along the normal of the boundary, lines at even distances run straight across its long
//! direction, or lengthwise across its short one. Where such a line enters and leaves the panel, a
//! straight chord in space joins the places on its loops: one from rim to rim, two where it passes
//! through a hole, which opens it. Around a part run arcs of the loops and chords in turn.
//!
//! Chords are straight: lines along the sheet at rest, which bulge with it, were tried on 32 panels
//! of steel that will not bend, and helped 4 of them; chords helped 8, these 4 among them.

use super::parts::{Divisible, between, chained, straight};
use crate::check::CutWay;
use sheetwright_geometry::boundary::{Boundary, OnOutline, Outline, Side};
use sheetwright_geometry::curve::Sample;
use sheetwright_geometry::math::{
    Frame, Point2, Point3, Vec2, angle_between, atan2, cos, from_deg, sin,
};

/// A loop has a corner where it turns by more than this, degrees.
const CORNER_DEG: f64 = 1.0;
/// A part has samples as the whole had, but at least and at most so many.
const SAMPLES: [f64; 2] = [48.0, 200.0];
/// Samples of a hole at the least, however small it is.
const LEAST_OF_HOLE: f64 = 24.0;
/// Places that crossings are looked for between, on each loop at the least.
const LEAST_PLACES: usize = 256;
/// A line that crosses a loop so near to a corner, as a share of its length, crosses it there.
const AT_CORNER: f64 = 1e-6;
/// Halvings that find a crossing to rounding.
const HALVINGS: usize = 60;

/// A boundary as it is seen along its normal.
pub(super) struct Within<'a> {
    outline: &'a Outline,
    frame: Frame,
    /// The long direction and the short one, unit.
    ways: [Vec2; 2],
    /// From where to where the outer loop reaches along both, mm.
    reach: [[f64; 2]; 2],
    loops: Vec<Ring>,
    /// How many samples the outer loop of the whole has.
    samples: usize,
}

/// A loop of the boundary.
struct Ring {
    /// Places on it in order, by arc length, mm.
    places: Vec<(f64, Point2)>,
    /// Its corners by arc length, mm.
    corners: Vec<f64>,
    length: f64,
}

impl Ring {
    /// The arc from an arc length to another, mm, or all round, in stretches from corner to corner:
    /// their ends may lie beyond the first sample.
    fn between_corners(&self, [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
        let whole = self.length;
        let end = if to > from { to } else { to + whole };
        let near = AT_CORNER * whole;
        let is_between = |mm: &f64| *mm > from + near && *mm < end - near;
        let twice = self.corners.iter().copied().chain(self.corners.iter().map(|mm| mm + whole));
        let mut ends = vec![from];
        ends.extend(twice.filter(is_between));
        ends.push(end);
        ends.windows(2).map(|pair| [pair[0], pair[1]]).collect()
    }
}

/// Where a line crosses a loop.
#[derive(Clone, Copy)]
struct Crossing {
    of_loop: usize,
    /// The arc length on the loop, mm.
    mm: f64,
    /// The number of the line, from 1.
    line: usize,
    /// Whether the loop runs from the part before the line to the part after it.
    rises: bool,
    /// How far along the line it is, mm.
    along: f64,
    at: Point3,
}

impl Crossing {
    /// The number of the part that the loop runs on in.
    fn part(&self) -> usize {
        self.line - usize::from(!self.rises)
    }
}

/// The crossings of a division: those of each loop together, in its order.
struct Cut {
    crossings: Vec<Crossing>,
    /// For each crossing the other end of its chord.
    partners: Vec<usize>,
}

impl<'a> Within<'a> {
    /// `None` if the outer loop faces no side, or there are holes and no supporting plane.
    pub(super) fn new(
        boundary: &'a Boundary,
        outline: &'a Outline,
        has_plane: bool,
    ) -> Option<Self> {
        if boundary.holes() > 0 && !has_plane {
            return None;
        }
        let origin = boundary.samples()[0].position;
        let frame = Frame::with_normal(origin, boundary.area_vector())?;
        let loops: Vec<Ring> =
            (0..boundary.loops().len()).map(|n| ring(boundary, outline, &frame, n)).collect();
        let long = long_direction(&loops[0].places);
        let ways = [long, Vec2::new(-long.y, long.x)];
        let reach = ways.map(|way| {
            let along = loops[0].places.iter().map(|(_, at)| off(*at, way));
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)])
        });
        Some(Self { outline, frame, ways, reach, loops, samples: boundary.loops()[0].len() })
    }

    /// The crossings of a division; `None` if a line crosses a loop more than twice.
    fn cut(&self, way: CutWay, parts: usize) -> Option<Cut> {
        let n = number(way);
        let (across, line_way) = (self.ways[n], self.ways[1 - n]);
        let mut crossings: Vec<Crossing> = Vec::new();
        for of_loop in 0..self.loops.len() {
            let mut of_it = Vec::new();
            for line in 1..parts {
                let height = between(self.reach[n], line as f64 / parts as f64);
                let found = self.crossed(of_loop, across, height);
                if found.len() != 2 && (of_loop == 0 || !found.is_empty()) {
                    return None;
                }
                of_it.extend(found.into_iter().map(|(mm, rises)| {
                    let at = self.outline.at(of_loop, mm, Side::Leaving).position;
                    let along = off(self.frame.project(at), line_way);
                    Crossing { of_loop, mm, line, rises, along, at }
                }));
            }
            of_it.sort_by(|a, b| a.mm.total_cmp(&b.mm));
            crossings.extend(of_it);
        }
        let mut partners = vec![0; crossings.len()];
        for line in 1..parts {
            let mut on_it: Vec<usize> =
                (0..crossings.len()).filter(|&n| crossings[n].line == line).collect();
            on_it.sort_by(|&a, &b| crossings[a].along.total_cmp(&crossings[b].along));
            for pair in on_it.chunks_exact(2) {
                let [a, b] = [pair[0], pair[1]];
                if crossings[a].rises == crossings[b].rises {
                    return None;
                }
                (partners[a], partners[b]) = (b, a);
            }
        }
        Some(Cut { crossings, partners })
    }

    /// The arc lengths at which a loop crosses a line, and whether it rises there.
    fn crossed(&self, of_loop: usize, across: Vec2, height: f64) -> Vec<(f64, bool)> {
        let ring = &self.loops[of_loop];
        let is_above = |at: Point2| off(at, across) > height;
        let count = ring.places.len();
        let step = |n: usize| {
            let (from, a) = ring.places[n];
            let (to, b) = ring.places[(n + 1) % count];
            let to = if n + 1 == count { ring.length } else { to };
            let rises = is_above(b);
            (is_above(a) != rises).then_some((from, to, rises))
        };
        let crossing = |(mut from, mut to, rises): (f64, f64, bool)| {
            for _ in 0..HALVINGS {
                let middle = between([from, to], 0.5);
                let at = self.outline.at(of_loop, middle, Side::Leaving).position;
                if is_above(self.frame.project(at)) == rises { to = middle } else { from = middle }
            }
            let near = |corner: &&f64| (to - **corner).abs() <= AT_CORNER * ring.length;
            (ring.corners.iter().find(near).copied().unwrap_or(to), rises)
        };
        (0..count).filter_map(step).map(crossing).collect()
    }

    /// The ends of the chords of a line of a division.
    fn chords(&self, cut: &Cut, line: usize) -> Vec<[Point3; 2]> {
        let Cut { crossings, partners } = cut;
        let is_start = |n: &usize| {
            crossings[*n].line == line && crossings[*n].along < crossings[partners[*n]].along
        };
        let mut starts: Vec<usize> = (0..crossings.len()).filter(is_start).collect();
        starts.sort_by(|&a, &b| crossings[a].along.total_cmp(&crossings[b].along));
        starts.into_iter().map(|n| [crossings[n].at, crossings[partners[n]].at]).collect()
    }

    /// The arcs and chords around a part by the crossings that its arcs begin at; `None` if it is
    /// none or several.
    fn rim(&self, cut: &Cut, part: usize) -> Option<Vec<usize>> {
        let Cut { crossings, partners } = cut;
        let is_of_it = |n: &usize| crossings[*n].part() == part;
        let count = (0..crossings.len()).filter(is_of_it).count();
        let first = (0..crossings.len()).find(is_of_it)?;
        let mut rim = vec![first];
        loop {
            let next = partners[self.next(cut, *rim.last()?)];
            if next == first {
                return (rim.len() == count).then_some(rim);
            }
            if rim.len() == count {
                return None;
            }
            rim.push(next);
        }
    }

    /// The next crossing of its loop.
    fn next(&self, cut: &Cut, n: usize) -> usize {
        let of_loop = cut.crossings[n].of_loop;
        let is_its = |n: &usize| cut.crossings.get(*n).is_some_and(|c| c.of_loop == of_loop);
        let first = (0..=n).find(is_its).unwrap_or(n);
        Some(n + 1).filter(is_its).unwrap_or(first)
    }
}

/// A stretch of the rim of a part.
enum Stretch {
    /// Of a loop, between arc lengths, mm.
    OfLoop(usize, [f64; 2]),
    /// A chord between two places.
    Chord([Point3; 2]),
}

impl Stretch {
    fn length(&self) -> f64 {
        match self {
            Self::OfLoop(_, [from, to]) => to - from,
            Self::Chord([from, to]) => from.distance(*to),
        }
    }
}

impl Within<'_> {
    /// The stretches around a part, which is one piece; `None` if it is none or several.
    fn stretches(&self, cut: &Cut, part: usize) -> Option<Vec<Stretch>> {
        let mut stretches = Vec::new();
        for start in self.rim(cut, part)? {
            let end = self.next(cut, start);
            let [from, to, on] = [start, end, cut.partners[end]].map(|n| &cut.crossings[n]);
            let arc = self.loops[from.of_loop].between_corners([from.mm, to.mm]);
            stretches.extend(arc.into_iter().map(|mm| Stretch::OfLoop(from.of_loop, mm)));
            stretches.push(Stretch::Chord([to.at, on.at]));
        }
        Some(stretches)
    }

    /// The samples of a loop of stretches, so many a mm, and both ends of each at least.
    fn sampled(&self, stretches: &[Stretch], by_mm: f64) -> Option<Vec<Sample>> {
        let sampled = |stretch: &Stretch| {
            let steps = ((stretch.length() * by_mm).round() as usize).max(1);
            match *stretch {
                Stretch::Chord(ends) => straight(ends, steps),
                Stretch::OfLoop(of_loop, mm) => {
                    let at = |n: usize| {
                        let side = if n == steps { Side::Arriving } else { Side::Leaving };
                        self.outline.at(of_loop, between(mm, n as f64 / steps as f64), side)
                    };
                    Some((0..=steps).map(at).collect())
                }
            }
        };
        let sampled: Option<Vec<Vec<OnOutline>>> = stretches.iter().map(sampled).collect();
        Some(chained(&sampled?))
    }

    /// The holes that no line crosses within a part.
    fn whole_holes(&self, cut: &Cut, [way, parts, part]: [usize; 3]) -> Vec<usize> {
        let [from, to] = self.reach[way];
        let is_in_it = |of_loop: &usize| {
            let first = off(self.loops[*of_loop].places[0].1, self.ways[way]);
            let number = ((first - from) / (to - from) * parts as f64).floor();
            number == part as f64 && cut.crossings.iter().all(|c| c.of_loop != *of_loop)
        };
        (1..self.loops.len()).filter(is_in_it).collect()
    }
}

impl Divisible for Within<'_> {
    fn around(&self, way: CutWay, parts: usize, n: usize) -> Option<Vec<Vec<Sample>>> {
        let cut = self.cut(way, parts)?;
        let rim = self.stretches(&cut, n)?;
        let whole: f64 = rim.iter().map(Stretch::length).sum();
        let [least, most] = SAMPLES;
        let by_mm = (self.samples as f64).clamp(least, most) / whole;
        let mut loops = vec![self.sampled(&rim, by_mm)?];
        for hole in self.whole_holes(&cut, [number(way), parts, n]) {
            let ring = &self.loops[hole];
            let first = ring.corners.first().copied().unwrap_or(0.0);
            let arc = ring.between_corners([first, first]).into_iter();
            let rim: Vec<Stretch> = arc.map(|mm| Stretch::OfLoop(hole, mm)).collect();
            loops.push(self.sampled(&rim, by_mm.max(LEAST_OF_HOLE / ring.length))?);
        }
        Some(loops)
    }

    fn lines(&self, way: CutWay, parts: usize, count: usize) -> Vec<Vec<Point3>> {
        let Some(cut) = self.cut(way, parts) else { return Vec::new() };
        let share = |n: usize| n as f64 / (count - 1) as f64;
        let places =
            |[from, to]: [Point3; 2]| (0..count).map(|n| from.lerp(to, share(n))).collect();
        (1..parts).flat_map(|line| self.chords(&cut, line)).map(places).collect()
    }

    fn of_first_rail(&self) -> Option<usize> {
        None
    }
}

/// The number of the direction across which lines divide.
fn number(way: CutWay) -> usize {
    match way {
        CutWay::Across => 0,
        CutWay::Lengthwise => 1,
    }
}

/// How far a place lies in a direction, mm.
fn off(at: Point2, way: Vec2) -> f64 {
    at.x * way.x + at.y * way.y
}

/// A loop of a boundary as it is seen along its normal.
fn ring(boundary: &Boundary, outline: &Outline, frame: &Frame, of_loop: usize) -> Ring {
    let range = boundary.loops()[of_loop].clone();
    let length = outline.length(of_loop);
    let between_samples = LEAST_PLACES.div_ceil(range.len());
    let mut places = Vec::with_capacity(range.len() * between_samples);
    for n in range.clone() {
        let from = outline.of_sample(n);
        let to = if n + 1 == range.end { length } else { outline.of_sample(n + 1) };
        places.push((from, frame.project(boundary.samples()[n].position)));
        places.extend((1..between_samples).map(|k| {
            let mm = between([from, to], k as f64 / between_samples as f64);
            (mm, frame.project(outline.at(of_loop, mm, Side::Leaving).position))
        }));
    }
    let turns = |n: &usize| {
        let Sample { tangent_in, tangent_out, .. } = boundary.samples()[*n];
        angle_between(tangent_in, tangent_out) > from_deg(CORNER_DEG)
    };
    let corners = range.filter(turns).map(|n| outline.of_sample(n)).collect();
    Ring { places, corners, length }
}

/// The direction in which a closed line of places reaches farthest: that of the largest moment of
/// inertia about its middle, unit.
fn long_direction(places: &[(f64, Point2)]) -> Vec2 {
    let count = places.len();
    let steps = || (0..count).map(|n| [places[n].1, places[(n + 1) % count].1]);
    let middle = |[a, b]: [Point2; 2]| a.lerp(b, 0.5);
    let mut sums = [0.0; 3];
    for step in steps() {
        let (length, at) = (step[0].distance(step[1]), middle(step));
        sums = [sums[0] + length, sums[1] + length * at.x, sums[2] + length * at.y];
    }
    let [whole, x, y] = sums;
    let centre = Point2::new(x / whole, y / whole);
    let mut moments = [0.0; 3];
    for step in steps() {
        let (length, at) = (step[0].distance(step[1]), middle(step) - centre);
        let own = [at.x * at.x, at.x * at.y, at.y * at.y];
        moments = std::array::from_fn(|n| moments[n] + length * own[n]);
    }
    let [xx, xy, yy] = moments;
    let angle = 0.5 * atan2(2.0 * xy, xx - yy);
    Vec2::new(cos(angle), sin(angle))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::CurvePoint;
    use sheetwright_geometry::boundary::samples_from_points;

    /// The area of a loop over the plane z = 0, mm².
    fn area(samples: &[Sample]) -> f64 {
        let next = samples.iter().skip(1).chain(samples.first());
        let pairs = samples.iter().zip(next).map(|(a, b)| (a.position, b.position));
        pairs.map(|(a, b)| 0.5 * (a.x * b.y - a.y * b.x)).sum()
    }

    fn corners(points: &[[f64; 2]]) -> Vec<Sample> {
        let corner = |[x, y]: &[f64; 2]| CurvePoint::corner(Point3::new(*x, *y, 0.0));
        samples_from_points(&points.iter().map(corner).collect::<Vec<_>>())
    }

    fn is_corner(sample: &&Sample) -> bool {
        angle_between(sample.tangent_in, sample.tangent_out) > from_deg(CORNER_DEG)
    }

    /// A plate of 40 x 30 mm with a hole of 6 x 4 mm whose middle is given.
    fn pierced(x: f64, y: f64) -> Boundary {
        let rim = corners(&[[0., 0.], [40., 0.], [40., 30.], [0., 30.]]);
        let hole = [[-3., -2.], [-3., 2.], [3., 2.], [3., -2.]].map(|[a, b]| [x + a, y + b]);
        Boundary::new(vec![rim, corners(&hole)]).unwrap()
    }

    #[test]
    fn a_line_through_a_hole_opens_it() {
        let boundary = pierced(20.5, 15.0);
        let outline = Outline::through(&boundary);
        let within = Within::new(&boundary, &outline, true).unwrap();
        for (way, ends) in [(CutWay::Across, 8), (CutWay::Lengthwise, 8)] {
            let lines = within.lines(way, 2, 5);
            assert_eq!(lines.len(), 2, "{way:?}");
            let parts = [0, 1].map(|n| within.around(way, 2, n).unwrap());
            for part in &parts {
                assert_eq!(part.len(), 1);
                assert_eq!(part[0].iter().filter(is_corner).count(), ends);
            }
            let areas = parts.map(|part| area(&part[0]));
            assert!((areas[0] + areas[1] - 1176.0).abs() < 1e-9, "{areas:?}");
        }
        // The hole reaches from x = 17.5 to 23.5: its right part is the larger.
        let [left, right] = [0, 1].map(|n| area(&within.around(CutWay::Across, 2, n).unwrap()[0]));
        assert!((left - right).abs() > 3.9 && (left + right - 1176.0).abs() < 1e-9);
    }

    #[test]
    fn a_hole_beside_the_lines_stays() {
        let boundary = pierced(8.0, 20.0);
        let outline = Outline::through(&boundary);
        let within = Within::new(&boundary, &outline, true).unwrap();
        let parts = [0, 1].map(|n| within.around(CutWay::Across, 2, n).unwrap());
        let mut loops = parts.each_ref().map(Vec::len);
        loops.sort_unstable();
        assert_eq!(loops, [1, 2]);
        let hole = parts.iter().find_map(|part| part.get(1)).unwrap();
        assert!((area(hole) + 24.0).abs() < 1e-9 && hole.len() >= 24);
        assert_eq!(hole.iter().filter(is_corner).count(), 4);
        assert!(Within::new(&boundary, &outline, false).is_none());
    }

    #[test]
    fn lines_through_corners_meet_them() {
        let six = [[30., 0.], [15., 20.], [-15., 20.], [-30., 0.], [-15., -20.], [15., -20.]];
        let boundary = Boundary::new(vec![corners(&six)]).unwrap();
        let outline = Outline::through(&boundary);
        let within = Within::new(&boundary, &outline, true).unwrap();
        let halves = [0, 1].map(|n| within.around(CutWay::Lengthwise, 2, n).unwrap());
        for half in halves {
            assert_eq!(half[0].iter().filter(is_corner).count(), 4);
            assert!((area(&half[0]) - 900.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_line_that_leaves_the_panel_twice_divides_nothing() {
        let comb = [[0., 0.], [60., 0.], [60., 30.], [40., 30.], [40., 8.], [20., 8.], [20., 30.]];
        let boundary = [&comb[..], &[[0., 30.]]].concat();
        let boundary = Boundary::new(vec![corners(&boundary)]).unwrap();
        let outline = Outline::through(&boundary);
        let within = Within::new(&boundary, &outline, true).unwrap();
        assert!(within.around(CutWay::Lengthwise, 2, 0).is_none());
        assert!(within.lines(CutWay::Lengthwise, 2, 5).is_empty());
        assert!(within.around(CutWay::Across, 2, 1).is_some());
    }
}
