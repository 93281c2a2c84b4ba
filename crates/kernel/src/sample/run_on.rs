//! Rails that run on beyond their ends.
//!
//! A strip whose last rungs join the ends of its rails is forced to have rulings there that no
//! developable surface through the rails may have. \[ZB18\] let rulings leave the boundary; here
//! the rails run on, the cheapest path of \[WT05\] is found on the longer rails, and the strip is
//! trimmed at its true ends:
//!
//! 1. Each rail runs on beyond each end along a circle: with its own tangent there, and the mean
//!    curvature of its last tenth (that at the very end is 0 for a natural spline, which says
//!    nothing of its shape). It stops before it has turned by a right angle, and where it would
//!    come back to the plane that trims it.
//! 2. The strip is trimmed by the plane through both ends, across the mean of the rails' tangents
//!    less its part along the end: seen along the surface's normal, the end stays straight.
//! 3. The path begins at any rung from the end of one rail to where the other runs on, or at both
//!    ends, and ends likewise; so no price is paid for what is cut off. Of a rung that is cut, the
//!    share s within the strip counts: if the tangent plane turns evenly along a rung, it turns by
//!    s of the warp angle there, and twist goes with the square of the angle.
//! 4. The points where the rulings cross the plane, evenly thinned, make a spline: the new end of
//!    the strip, a part of its boundary like any other. The panel's own method then finds the
//!    rungs, for it may do better than the path, and what is measured is the strip that is cut.

use sheetwright_geometry::curve::{Curve, CurveKind, CurvePoint, Sample, sample_open};
use sheetwright_geometry::math::{Point3, Vec3, angle_between, cos, sin, unit};
use sheetwright_optimum::cost::{PriceOptions, Prices};

use super::source::run_back;
use super::steps::Own;

/// How far a rail runs on at the most, as a share of its length.
const REACH: f64 = 0.5;
/// The share of a rail whose mean curvature it runs on with.
const CURVATURE_SHARE: f64 = 0.1;
/// The points that a new end is drawn through lie at least this share of the end apart: path steps
/// are too uneven to follow each.
const END_POINT_SHARE: f64 = 0.125;
/// The price of a rung without tangent planes: the most that can be.
const FORCED: f64 = 2.0;

/// Rungs of the lattice are joined to so many samples of a rail at the most: the new ends need no
/// finer path.
const LATTICE: usize = 200;

/// Two rails that have run on and been trimmed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RanOn {
    /// The rails, each with the new ends that it runs on to; run as they were given.
    pub(super) rails: [Vec<Sample>; 2],
    /// Where the rails' own samples lie among them.
    pub(super) own: [Own; 2],
    /// How far the new end at the beginning and that at the end bulge from the straight line, mm;
    /// `None` where the strip is best as it is.
    pub(super) bulges_mm: [Option<f64>; 2],
}

/// Lets two rails run on, the second of which runs back. Ends that are no farther apart than
/// `same_mm` meet, and stay.
pub(super) fn run_on(
    first: &[Sample],
    second: &[Sample],
    same_mm: f64,
    price: PriceOptions,
) -> RanOn {
    let mut rails = [first.to_vec(), run_back(second)];
    let mut own = rails.each_ref().map(|rail| Own::all(rail.len()));
    let few = rails.each_ref().map(|rail| thinned(rail));
    let apart = |a: &Sample, b: &Sample| a.position.distance(b.position) > same_mm;
    let open = [
        apart(&few[0][0], &few[1][0]),
        apart(&few[0][few[0].len() - 1], &few[1][few[1].len() - 1]),
    ];
    let lattice = Lattice::new([&few[0], &few[1]], open, price);
    let path = lattice.cheapest();
    let back: Vec<[usize; 2]> = path.iter().rev().copied().collect();
    let bulges_mm = [(0, &path), (1, &back)].map(|(n, path)| {
        let end = lattice.new_end(n, path)?;
        let longer = usize::from(!end.by_first);
        let (rail, own) = (&mut rails[longer], &mut own[longer]);
        let before = rail.len();
        let spacing_mm = length(rail) / (rail.len() - 1) as f64;
        *rail = if n == 0 {
            begun_with(rail, &end.points, spacing_mm)
        } else {
            run_back(&begun_with(&run_back(rail), &end.points, spacing_mm))
        };
        if n == 0 {
            let added = rail.len() - before;
            (own.first, own.last) = (own.first + added, own.last + added);
        }
        Some(end.bulge_mm())
    });
    let [first, second] = rails;
    let own = [own[0], own[1].back(second.len())];
    RanOn { rails: [first, run_back(&second)], own, bulges_mm }
}

/// Evenly chosen samples of a rail, both ends among them.
fn thinned(rail: &[Sample]) -> Vec<Sample> {
    let count = rail.len().min(LATTICE);
    (0..count).map(|n| rail[n * (rail.len() - 1) / (count - 1)]).collect()
}

fn length(rail: &[Sample]) -> f64 {
    rail.windows(2).map(|pair| pair[0].position.distance(pair[1].position)).sum()
}

/// Where an end of a strip runs when its rails run on.
struct NewEnd {
    /// Whether the first rail is the one that runs on.
    by_first: bool,
    /// The points that it is drawn through, mm: from the end of the rail that keeps its end to the
    /// end of the one that runs on.
    points: Vec<Point3>,
}

impl NewEnd {
    /// How far it lies from the straight line between its ends, mm.
    fn bulge_mm(&self) -> f64 {
        let (from, to) = (self.points[0], self.points[self.points.len() - 1]);
        let along = unit(to - from).unwrap_or(Vec3::ZERO);
        let aside = |p: &Point3| (*p - from).cross(along).length();
        self.points.iter().map(aside).fold(0.0, f64::max)
    }
}

/// A rail that begins with a new end, whose points lead to where the rail began. Samples of the end
/// are about `spacing_mm` apart.
fn begun_with(rail: &[Sample], points: &[Point3], spacing_mm: f64) -> Vec<Sample> {
    let smooth: Vec<CurvePoint> = points.iter().copied().map(CurvePoint::smooth).collect();
    let Ok(curve) = Curve::new(CurveKind::Spline, &smooth, false) else { return rail.to_vec() };
    let count = (curve.length() / spacing_mm).round().max(1.0) as usize + 1;
    let Ok(mut samples) = sample_open(&curve, count) else { return rail.to_vec() };
    samples[0].position = points[0];
    let arriving = samples.pop().map_or(rail[0].tangent_in, |last| last.tangent_in);
    samples.push(Sample { tangent_in: arriving, ..rail[0] });
    samples.extend(&rail[1..]);
    samples
}

/// A rail with what it runs on.
struct LongRail {
    samples: Vec<Sample>,
    /// Its first and its last true sample.
    ends: [usize; 2],
    /// How far each sample lies beyond the planes that trim the two ends, mm.
    beyond: [Vec<f64>; 2],
}

/// The plane that trims an end: a point, and the unit normal that points out of the strip.
#[derive(Clone, Copy)]
struct Plane {
    at: Point3,
    out: Vec3,
}

impl Plane {
    /// The plane at the beginning of two rails.
    fn new(rails: [&[Sample]; 2]) -> Option<Self> {
        let [a, b] = rails.map(|rail| rail[0]);
        let along = unit(b.position - a.position)?;
        let back = -(a.tangent_out + b.tangent_out);
        let out = unit(back - along * back.dot(along))?;
        Some(Self { at: a.position, out })
    }

    fn beyond(&self, point: Point3) -> f64 {
        (point - self.at).dot(self.out)
    }
}

/// What a rail runs on beyond its beginning, the nearest first.
fn before(rail: &[Sample], plane: &Plane) -> Vec<Sample> {
    let length = length(rail);
    let step = length / (rail.len() - 1) as f64;
    let part = ((CURVATURE_SHARE * rail.len() as f64).ceil() as usize).clamp(1, rail.len() - 1);
    let start = rail[0].position;
    // Outwards, with the curvature of the turn from inside to the end.
    let tangent = -rail[0].tangent_out;
    let inside = -rail[part].tangent_in;
    let turn = angle_between(inside, tangent);
    let curvature = turn / (step * part as f64);
    let across = unit(tangent - inside).and_then(|way| unit(way - tangent * way.dot(tangent)));
    let count = (REACH * length / step) as usize;
    let mut samples: Vec<Sample> = Vec::with_capacity(count);
    let mut last = 0.0;
    for n in 1..=count {
        let way = step * n as f64;
        let angle = way * curvature;
        let (position, direction) = match across {
            Some(across) if angle > 1e-9 => {
                let (s, c) = (sin(angle), cos(angle));
                let moved = (tangent * s + across * (1.0 - c)) / curvature;
                (start + moved, tangent * c + across * s)
            }
            _ => (start + tangent * way, tangent),
        };
        let beyond = plane.beyond(position);
        if angle >= std::f64::consts::FRAC_PI_2 || beyond <= last {
            break;
        }
        last = beyond;
        samples.push(Sample { position, tangent_in: -direction, tangent_out: -direction });
    }
    samples
}

struct Lattice {
    rails: [LongRail; 2],
    prices: Prices,
}

/// A rung of the lattice: what it costs, N, and the share of it that is within the strip.
#[derive(Clone, Copy)]
struct Step {
    price: f64,
    mean: Vec3,
    share: f64,
}

impl Lattice {
    fn new(rails: [&[Sample]; 2], open: [bool; 2], price: PriceOptions) -> Self {
        let backs = rails.map(run_back);
        let directions = [rails, [&backs[0], &backs[1]]];
        let planes = [0, 1].map(|n| Plane::new(directions[n]).filter(|_| open[n]));
        let long = [0, 1].map(|r| {
            let beyond = |n: usize| -> Vec<Sample> {
                planes[n].map_or(Vec::new(), |plane| before(directions[n][r], &plane))
            };
            let (start, end) = (beyond(0), run_back_all(beyond(1)));
            let ends = [start.len(), start.len() + rails[r].len() - 1];
            let mut samples: Vec<Sample> = start.into_iter().rev().collect();
            samples.extend(rails[r]);
            samples.extend(end);
            let beyond = [0, 1].map(|n| {
                let of = |s: &Sample| planes[n].map_or(-1.0, |plane| plane.beyond(s.position));
                let mut beyond: Vec<f64> = samples.iter().map(of).collect();
                beyond[ends[n]] = 0.0;
                beyond
            });
            LongRail { samples, ends, beyond }
        });
        let mut ring = long[0].samples.clone();
        ring.extend(run_back(&long[1].samples));
        let prices = Prices::of_ring(&ring, price);
        Self { rails: long, prices }
    }

    /// The sample of the ring that sample `j` of the second rail is.
    fn on_second(&self, j: usize) -> usize {
        self.prices.len() - 1 - j
    }

    /// Which of the two samples of a rung lies beyond end `n`: `None` if none does.
    fn outer(&self, [i, j]: [usize; 2], n: usize) -> [bool; 2] {
        let is_beyond = |rail: &LongRail, k: usize| match n {
            0 => k < rail.ends[0],
            _ => k > rail.ends[1],
        };
        [is_beyond(&self.rails[0], i), is_beyond(&self.rails[1], j)]
    }

    /// The share of a rung within the strip, and that of its way from the first rail to the second
    /// at which it is cut, if it is; `None` for a rung that is not to be used.
    fn cut(&self, rung: [usize; 2]) -> Option<(f64, Option<f64>)> {
        let outer = [0, 1].map(|n| self.outer(rung, n));
        let n = match outer.map(|o| usize::from(o[0]) + usize::from(o[1])) {
            [0, 0] => return Some((1.0, None)),
            [1, 0] => 0,
            [0, 1] => 1,
            _ => return None,
        };
        let by_first = outer[n][0];
        let [a, b] = [0, 1].map(|r| self.rails[r].beyond[n][rung[r]]);
        let (out, within) = if by_first { (a, b) } else { (b, a) };
        if within > 0.0 {
            return None;
        }
        let share = -within / (out - within);
        Some((share, Some(if by_first { 1.0 - share } else { share })))
    }

    fn step(&self, [i, j]: [usize; 2]) -> Option<Step> {
        let (share, _) = self.cut([i, j])?;
        let end = [0, 1].iter().any(|&n| [i, j] == self.rails.each_ref().map(|r| r.ends[n]));
        if end {
            return Some(Step { price: 0.0, mean: Vec3::ZERO, share });
        }
        let on_second = self.on_second(j);
        Some(match self.prices.planes(i, on_second) {
            Some(planes) => {
                let twist = self.prices.rung(i, on_second, &planes);
                Step { price: share * share * twist, mean: planes.mean, share }
            }
            None => Step { price: share * share * FORCED, mean: Vec3::ZERO, share },
        })
    }

    /// Whether a path may begin (end 0) or end (end 1) with this rung.
    fn is_last(&self, [i, j]: [usize; 2], n: usize) -> bool {
        let at_end = [i == self.rails[0].ends[n], j == self.rails[1].ends[n]];
        let outer = self.outer([i, j], n);
        (at_end[0] && (at_end[1] || outer[1])) || (at_end[1] && outer[0])
    }

    /// The cheapest path, as rungs from the beginning on.
    fn cheapest(&self) -> Vec<[usize; 2]> {
        let [m, n] = self.rails.each_ref().map(|rail| rail.samples.len());
        let mut came = vec![Came::Begun; m * n];
        let mut above: Vec<Option<(f64, Step)>> = vec![None; n];
        let mut best: Option<(f64, [usize; 2])> = None;
        for i in 0..m {
            let mut row: Vec<Option<(f64, Step)>> = vec![None; n];
            for j in 0..n {
                let Some(step) = self.step([i, j]) else { continue };
                let mut least = self.is_last([i, j], 0).then_some((0.0, Came::Begun));
                let fold = |corners: [usize; 3], means: [Vec3; 3], other: &Step| {
                    step.share.max(other.share) * self.prices.triangle(corners, means)
                };
                if let Some((price, other)) = &above[j] {
                    let corners = [i - 1, i, self.on_second(j)];
                    let means = [Vec3::ZERO, step.mean, other.mean];
                    let price = price + fold(corners, means, other);
                    if least.is_none_or(|(least, _)| price < least) {
                        least = Some((price, Came::AlongFirst));
                    }
                }
                if let Some((price, other)) = j.checked_sub(1).and_then(|j| row[j].as_ref()) {
                    let corners = [i, self.on_second(j), self.on_second(j - 1)];
                    let means = [step.mean, Vec3::ZERO, other.mean];
                    let price = price + fold(corners, means, other);
                    if least.is_none_or(|(least, _)| price < least) {
                        least = Some((price, Came::AlongSecond));
                    }
                }
                let Some((price, way)) = least else { continue };
                let price = price + step.price;
                row[j] = Some((price, step));
                came[i * n + j] = way;
                if self.is_last([i, j], 1) && best.is_none_or(|(least, _)| price < least) {
                    best = Some((price, [i, j]));
                }
            }
            above = row;
        }
        let mut path = Vec::new();
        let mut at = best.map(|(_, last)| last);
        while let Some([i, j]) = at {
            path.push([i, j]);
            at = match came[i * n + j] {
                Came::Begun => None,
                Came::AlongFirst => Some([i - 1, j]),
                Came::AlongSecond => Some([i, j - 1]),
            };
        }
        path.reverse();
        path
    }

    /// Where the rungs of a path that begins at end `n` cross the plane there.
    fn new_end(&self, n: usize, path: &[[usize; 2]]) -> Option<NewEnd> {
        let by_first = self.outer(*path.first()?, n)[0];
        let crossing = |&[i, j]: &[usize; 2]| {
            let (_, at) = self.cut([i, j])?;
            let [a, b] = [self.rails[0].samples[i], self.rails[1].samples[j]];
            at.map(|at| a.position.lerp(b.position, at))
        };
        let is_cut = |rung: &&[usize; 2]| self.outer(**rung, n) != [false; 2];
        let crossings: Vec<Point3> = path.iter().take_while(is_cut).filter_map(crossing).collect();
        let [a, b] = self.rails.each_ref().map(|rail| rail.samples[rail.ends[n]].position);
        let (from, to) = if by_first { (b, a) } else { (a, b) };
        let apart = END_POINT_SHARE * from.distance(to);
        let mut points = vec![from];
        for point in crossings {
            let last = points[points.len() - 1];
            if point.distance(last) >= apart && point.distance(to) >= apart {
                points.push(point);
            }
        }
        points.push(to);
        (points.len() > 2).then_some(NewEnd { by_first, points })
    }
}

/// How a path comes to a rung.
#[derive(Clone, Copy)]
enum Came {
    Begun,
    AlongFirst,
    AlongSecond,
}

/// What runs on beyond the end of a rail, worked out on the rail run back.
fn run_back_all(samples: Vec<Sample>) -> Vec<Sample> {
    let back = |s: Sample| Sample { tangent_in: -s.tangent_out, tangent_out: -s.tangent_in, ..s };
    samples.into_iter().map(back).collect()
}
