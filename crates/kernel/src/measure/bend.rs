//! How tightly a sheet is rolled, measured along its border.
//!
//! Along a ruling of a developable surface the bend radius is linear in the distance from where the
//! ruling meets its neighbours, so it is least at an end of the ruling, and rulings end at the
//! border. So the border is walked along, and over each stretch of it two vectors are summed:
//!
//! - τ, the rotation of the tangent plane: every rung that ends there adds its crease, along
//!   itself;
//! - E, the width: every edge adds its length, across itself within its triangle, inwards.
//!
//! The tangent plane turns about the rulings, so with d along them the turn is τ·d, the width
//! across them E·d, and the radius the width over the turn. Both sums depend on where the stretch
//! begins and ends only: triangles at the two ends touch the surface along an edge each, however
//! the rungs between them run, while creases of neighbouring rungs by themselves are uneven. (A
//! rung ends at a sample and not where its ruling would.) Where a strip is twisted, creases to and
//! fro cancel.
//!
//! Points are typed or measured with some digits, and the finer the samples, the more that turns
//! the edges to and fro. Two things keep it from being taken for bends: a roll counts from a depth
//! on, and its width and turn are averaged with those of the rolls that begin on its first half.
//! Then what is compared is not one edge with another, but the mean slopes of two halves.

use super::SHARP_CREASE_DEG;
use super::apex::{Apex, radius_by_distance};
use crate::surface::Surface;
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::index::{SampleIndex, TriangleIndex};
use sheetwright_geometry::math::{Vec3, to_deg, unit};

/// The least depth of a roll, as a share of the size of the surface: the distance of its middle
/// from the line between its ends. A stiff sheet rounds off shallower rolls, half a millimetre on a
/// metre; and rounded coordinates turn the edges of finely sampled borders to and fro.
const ROLL_DEPTH: f64 = 5e-4;
/// The largest width of a roll, as a share of the size: a roll of this width that is not deep
/// enough has a radius of two and a half times the size, and counts as flat.
const ROLL_WIDTH: f64 = 0.1;
/// The least width of a roll, in edges of the border.
const ROLL_EDGES: f64 = 2.0;
/// The least number of stations of a roll that is averaged with others: coarse samples have fewer.
const MANY: usize = 6;
/// The least width of a roll, in multiples of the uncertainty of where it begins and ends.
const CERTAIN: f64 = 8.0;
/// The longest stretch of border that is followed, in widths of the widest roll: border that runs
/// along rulings gains no width.
const REACH: f64 = 3.0;
/// The largest error of coordinates, as a share of the size: a metre is given to 0.1 mm.
const ROUNDING: f64 = 5e-5;
/// The largest factor by which a triangle enlarges the error of its edge without being corrected.
const LEVER: f64 = 3.0;
/// The largest share of a turn that is attributed to that error.
const PUT_DOWN: f64 = 0.8;
/// A fan has at least as many rungs: fewer may be coarse samples.
const APEX_RUNGS: usize = 4;
/// Turns below it, radians, are rounding: the sheet is flat there.
const FLAT: f64 = 1e-9;
/// The factor that enlarges bounds, far more than rounding lowers them.
const MORE: f64 = 1.0 + 1e-9;

/// How tightly a sheet is rolled.
pub(super) struct Rolls {
    /// The bend radius at each sample, mm: of the tightest stretch whose middle it is, apexes and
    /// folds aside; infinite where flat.
    pub(super) radii_mm: Vec<f64>,
    /// The apexes, in the order of their samples.
    pub(super) apexes: Vec<Apex>,
}

/// The border at one sample: its rungs and half of both edges.
#[derive(Clone, Copy, Default)]
struct Station {
    /// τ.
    turn: Vec3,
    /// E, mm.
    width: Vec3,
    /// Along the rungs, the sum of their creases, whatever their signs.
    axis: Vec3,
    /// How many rungs turn here.
    rungs: usize,
    /// The edge that leaves.
    edge: BorderEdge,
    /// How long that is, mm.
    length: f64,
    /// How its triangle lies to the rulings.
    lie: Option<Lie>,
}

impl Station {
    /// Whether the tangent plane turns there.
    fn turns(&self) -> bool {
        self.turn.length_squared() > FLAT * FLAT
    }
}

/// An edge of the border with its triangle.
#[derive(Clone, Copy, Default)]
struct BorderEdge {
    /// From end to end, mm.
    way: Vec3,
    /// From its middle to the far corner of its triangle, mm.
    to_far: Vec3,
    /// The unit normal of its triangle.
    normal: Vec3,
}

/// The position of the triangle of an edge relative to the rulings, on which its slope depends
/// beside the spacing of the samples.
#[derive(Clone, Copy)]
struct Lie {
    /// Along the rulings.
    ruling: Vec3,
    /// Where it has the slope of the surface, from the middle of the edge across the rulings, mm.
    offset: f64,
    /// |h| and |v w|, see [`Lie::of`].
    along: f64,
    sheared: f64,
    sway: f64,
}

impl Lie {
    /// Where a triangle has the slope of the surface, across rulings along `ruling`. Against the
    /// middle of the edge a sheet lies at z = −u²/2 radii, u across the rulings. The plane through
    /// the three corners, the ends of the edge at ∓(w/2, h/2) and the far corner at (u, v), is as
    /// steep as that is at (u² − w²/4)/2 · h/(u h − v w): near 0 for a triangle that is long along
    /// the rulings, but anywhere up to u/2 if the edge runs along them too. And u is known no
    /// better than the spacing of the samples, since that is how well the ruling is known.
    ///
    /// If the ends of the edge are off by δ each, the plane turns by up to 2 δ (|v| + |h|)/|u h − v
    /// w|: 2 δ/w if the edge runs across the rulings, and many times that if it runs along them.
    fn of(edge: &BorderEdge, ruling: Vec3, size: f64) -> Option<Self> {
        let across = ruling.cross(edge.normal);
        let (w, h) = (edge.way.dot(across), edge.way.dot(ruling));
        let (u, v) = (edge.to_far.dot(across), edge.to_far.dot(ruling));
        let doubled_area = u * h - v * w;
        let length = edge.way.length();
        let lever = (v.abs() + h.abs()) * length / doubled_area.abs();
        (doubled_area != 0.0).then(|| Self {
            ruling,
            offset: 0.5 * (u * u - 0.25 * w * w) * h / doubled_area,
            along: h.abs(),
            sheared: (v * w).abs(),
            sway: 2.0 * ROUNDING * size / length * (lever - LEVER).max(0.0),
        })
    }

    /// The slope, across rulings whose direction is counted along `ruling`.
    fn slope(&self, ruling: Vec3, spacing: f64) -> Slope {
        let along = spacing * self.along;
        let doubt = if along == 0.0 { 0.0 } else { 0.5 * spacing * along / (along + self.sheared) };
        let offset = if self.ruling.dot(ruling) < 0.0 { -self.offset } else { self.offset };
        Slope { offset, doubt: doubt.max(offset.abs()), sway: self.sway }
    }
}

/// Where a triangle has the slope of the surface, across the rulings.
#[derive(Default)]
struct Slope {
    /// How far from the middle of its edge, mm.
    offset: f64,
    /// How far that may be wrong, mm.
    doubt: f64,
    /// How far that slope may be wrong because coordinates are, radians; beyond what it is for an
    /// edge across the rulings, which averages out.
    sway: f64,
}

/// Measures how tightly a surface is rolled. `creases` are those of its hinges, 0 for folds.
pub(super) fn rolls(surface: &Surface, creases: &[f64]) -> Rolls {
    let size = size_of(surface.positions().iter().copied());
    let mut stations = stations(surface, creases);
    let mut apexes = Vec::new();
    let mut radii_mm = vec![f64::INFINITY; stations.len()];
    for of_loop in surface.connectivity().loops() {
        let start = of_loop.start;
        let stations = &mut stations[of_loop.clone()];
        for n in apex_numbers(stations) {
            let turn = stations[n].turn.length();
            let radius_mm = shallowest(turn, size) / turn;
            let sample = SampleIndex::new(start + n);
            let radius_by_distance = radius_by_distance(surface, creases, sample, FLAT);
            apexes.push(Apex { sample, turn, radius_mm, radius_by_distance });
            (stations[n].turn, stations[n].axis) = (Vec3::ZERO, Vec3::ZERO);
        }
        note_lies(stations, size);
        let mut seen = Vec::new();
        let rolls: Vec<Option<Roll>> =
            (0..stations.len()).map(|first| roll_from(stations, first, size, &mut seen)).collect();
        note_radii(&rolls, &mut radii_mm[of_loop.clone()]);
    }
    Rolls { radii_mm, apexes }
}

fn stations(surface: &Surface, creases: &[f64]) -> Vec<Station> {
    let connectivity = surface.connectivity();
    let mut stations = vec![Station::default(); connectivity.samples()];
    let mut after = vec![0; stations.len()];
    for [from, to] in connectivity.edges() {
        after[from.get()] = to.get();
    }
    for (n, corners) in connectivity.triangles().iter().enumerate() {
        let Some(normal) = surface.normal(TriangleIndex::new(n)) else { continue };
        let [a, b, c] = *corners;
        for (from, to) in [(a, b), (b, c), (c, a)] {
            if after[from.get()] == to.get() {
                let far = connectivity.far_corner(TriangleIndex::new(n), [from, to]);
                let [start, end, far] = [from, to, far].map(|s| surface.position(s));
                let edge =
                    BorderEdge { way: end - start, to_far: far - start.lerp(end, 0.5), normal };
                let width = normal.cross(edge.way) * 0.5;
                stations[from.get()].edge = edge;
                stations[from.get()].length = edge.way.length();
                stations[from.get()].width += width;
                stations[to.get()].width += width;
            }
        }
    }
    for (hinge, &crease) in connectivity.hinges().iter().zip(creases) {
        let [low, high] = hinge.rung.ends();
        let Some(along) = unit(surface.position(high) - surface.position(low)) else { continue };
        for (sample, along) in [(low, along), (high, -along)] {
            let station = &mut stations[sample.get()];
            station.turn += along * crease;
            station.axis += lying(along, station.axis) * crease.abs();
            station.rungs += usize::from(crease.abs() > FLAT);
        }
    }
    stations
}

/// Notes how the triangles of the edges of a loop lie to the rulings.
fn note_lies(stations: &mut [Station], size: f64) {
    let m = stations.len();
    for n in 0..m {
        let (from, to) = (&stations[n], &stations[(n + 1) % m]);
        let ruling = unit(from.axis + lying(to.axis, from.axis));
        stations[n].lie = ruling.and_then(|ruling| Lie::of(&from.edge, ruling, size));
    }
}

/// `line` or its opposite, whichever lies along `axis`.
fn lying(line: Vec3, axis: Vec3) -> Vec3 {
    if line.dot(axis) < 0.0 { -line } else { line }
}

/// The samples of a loop where a fan of rungs ends whose turn stands alone, so that no finer
/// sampling would divide it.
fn apex_numbers(stations: &[Station]) -> Vec<usize> {
    let m = stations.len();
    let turn = |n: usize| stations[n % m].turn.length();
    let is_apex = |&n: &usize| {
        let nearby: f64 = [m - 2, m - 1, 1, 2].into_iter().map(|step| turn(n + step)).sum();
        stations[n].rungs >= APEX_RUNGS
            && to_deg(turn(n)) > SHARP_CREASE_DEG
            && turn(n) > 2.0 * nearby
    };
    (0..m).filter(is_apex).collect()
}

/// How wide a roll is that turns by so much, radians, and is as shallow as rolls are, mm: the
/// middle of a roll lies an eighth of its width times its turn from the line between its ends.
fn shallowest(turn: f64, size: f64) -> f64 {
    (8.0 * ROLL_DEPTH * size / turn).min(ROLL_WIDTH * size)
}

/// A stretch of border, as wide as a roll is at the least.
#[derive(Clone, Copy)]
struct Roll {
    /// By how much the tangent plane turns on it, radians, positive for a mountain.
    turn: f64,
    /// How wide it is, mm.
    width: f64,
    /// How wide its first station is, mm.
    step: f64,
    /// How many stations it has.
    count: usize,
    /// The station in its middle.
    middle: usize,
}

impl Roll {
    fn radius(&self) -> f64 {
        self.width / self.turn.abs()
    }
}

/// A stretch of border, summed up from its first station on.
#[derive(Clone, Copy)]
struct BorderStretch {
    /// τ.
    turn: Vec3,
    /// E, mm.
    width: Vec3,
    /// The sum of the axes of its stations.
    axis: Vec3,
    /// Its first station.
    first: usize,
    /// How many it has.
    count: usize,
    /// The longest of its edges and those next to it, mm.
    longest: f64,
}

impl BorderStretch {
    /// One without stations, beside the edge that leads to the first.
    fn before(stations: &[Station], first: usize) -> Self {
        let [turn, width, axis] = [Vec3::ZERO; 3];
        let longest = stations[before(first, stations.len())].length;
        Self { turn, width, axis, first, count: 0, longest }
    }

    fn take(&mut self, station: &Station) {
        self.turn += station.turn;
        self.width += station.width;
        self.axis += lying(station.axis, self.axis);
        self.longest = f64::max(self.longest, station.length);
        self.count += 1;
    }

    /// How wide a roll on it is at the least for its edges, mm.
    fn narrowest(&self) -> f64 {
        ROLL_EDGES * self.longest
    }

    /// Its station number `n`.
    fn number(&self, n: usize, m: usize) -> usize {
        let at = self.first + n;
        if at < m { at } else { at - m }
    }

    /// How the triangles before its first station and after its last lie to the rulings.
    fn lies<'s>(&self, stations: &'s [Station]) -> [Option<&'s Lie>; 2] {
        let m = stations.len();
        [before(self.first, m), self.number(self.count - 1, m)].map(|n| stations[n].lie.as_ref())
    }

    /// The roll that it is, with whether it is as wide as one is at the least: if not, as if it
    /// were.
    fn roll(&self, stations: &[Station], size: f64) -> Option<(Roll, bool)> {
        let (m, ruling) = (stations.len(), unit(self.axis)?);
        let slope = |lie: &Lie| lie.slope(ruling, self.longest);
        let [start, end] = self.lies(stations).map(|lie| lie.map_or(Slope::default(), slope));
        let width = self.width.dot(ruling) + end.offset - start.offset;
        let turn = self.turn.dot(ruling);
        let least = shallowest(turn.abs().max(FLAT), size)
            .max(self.narrowest())
            .max(CERTAIN * (start.doubt + end.doubt));
        let certain = (turn.abs() - start.sway - end.sway).max((1.0 - PUT_DOWN) * turn.abs());
        if certain.is_nan() || certain <= FLAT {
            return None;
        }
        // Of two in the middle the first.
        let middle = self.number((self.count - 1) / 2, m);
        let roll = Roll {
            turn: certain * (turn * width).signum(),
            width: width.abs().max(least),
            step: stations[self.first].width.dot(ruling).abs(),
            count: self.count,
            middle: if stations[middle].turns() { middle } else { self.first },
        };
        Some((roll, width.abs() >= least))
    }

    /// Bounds of that, which take no quotient: the most that its width can be, mm, and its turn,
    /// radians, both times the length of its axis, which is the third.
    fn bounds(&self, stations: &[Station]) -> [f64; 3] {
        let length = self.axis.length();
        let off = |lie: Option<&Lie>| lie.map_or(0.0, |lie| lie.offset.abs());
        let [start, end] = self.lies(stations).map(off);
        let width = self.width.dot(self.axis).abs() + (start + end) * length;
        let turn = (self.turn.dot(self.axis).abs() * MORE).max(FLAT * length);
        [width * MORE, turn, length]
    }

    /// Whether a roll on it is wider than this at the least; as far as products tell, and all as in
    /// [`Self::bounds`].
    fn is_wider(&self, [width, turn, length]: [f64; 3], size: f64) -> bool {
        let is_deeper = width < ROLL_WIDTH * size * length
            && width * turn < 8.0 * ROLL_DEPTH * size * length * length;
        is_deeper || width < self.narrowest() * length
    }
}

/// The number of the station before another, of m.
fn before(n: usize, m: usize) -> usize {
    if n == 0 { m - 1 } else { n - 1 }
}

/// The roll that begins at a station of a loop: the narrowest that is deep and wide enough, or if
/// there is none, the tightest that is not, as if it were. `size` is the surface's, mm.
///
/// Of most stretches it takes no more than products to show that they are too narrow. All are noted
/// in `seen`, for where none is wide enough; then the longest come first, which turn most and leave
/// hardly any that may be tighter.
fn roll_from(
    stations: &[Station],
    first: usize,
    size: f64,
    seen: &mut Vec<BorderStretch>,
) -> Option<Roll> {
    let m = stations.len();
    if !stations[first].turns() {
        return None;
    }
    seen.clear();
    let mut stretch = BorderStretch::before(stations, first);
    let mut way = 0.0;
    for n in 0..m {
        let station = &stations[stretch.number(n, m)];
        stretch.take(station);
        way += station.length;
        if station.turns() {
            seen.push(stretch);
            let is_narrow = stretch.is_wider(stretch.bounds(stations), size);
            if !is_narrow && let Some((roll, true)) = stretch.roll(stations, size) {
                return Some(roll);
            }
        }
        if way > REACH * stretch.narrowest().max(ROLL_WIDTH * size) {
            break;
        }
    }
    let mut tightest: Option<Roll> = None;
    for stretch in seen.iter().rev() {
        let radius = tightest.map_or(f64::INFINITY, |roll| roll.radius());
        let [_, turn, length] = stretch.bounds(stations);
        // Wider than one with that radius, so its own is larger.
        if stretch.is_wider([radius * turn, turn, length], size) {
            continue;
        }
        let Some((roll, _)) = stretch.roll(stations, size) else { continue };
        // Of those as tight the narrowest.
        if tightest.is_none_or(|tightest| roll.radius() <= tightest.radius()) {
            tightest = Some(roll);
        }
    }
    tightest
}

/// Notes the radii of rolls, each averaged with those that begin on its first half.
fn note_radii(rolls: &[Option<Roll>], radii_mm: &mut [f64]) {
    let m = rolls.len();
    for first in 0..m {
        let Some(roll) = rolls[first] else { continue };
        let (mut way, mut width, mut turn) = (0.0, 0.0, 0.0);
        for other in (first..first + m).filter_map(|n| rolls[n % m]) {
            width += other.width * other.step;
            turn += other.turn * other.step;
            way += other.step;
            if roll.count < MANY || way > 0.5 * roll.width {
                break;
            }
        }
        let averaged = width / turn.abs();
        let radius = &mut radii_mm[roll.middle];
        *radius = radius.min(if averaged.is_finite() { averaged } else { roll.radius() });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::Connectivity;
    use sheetwright_geometry::boundary::{Boundary, samples_from_points};
    use sheetwright_geometry::curve::CurvePoint;
    use sheetwright_geometry::math::Point3;
    use sheetwright_geometry::watch::Unwatched;
    use sheetwright_optimum::triangulate::{TriangulateOptions, triangulate};
    use sheetwright_shapes::family::Family;
    use sheetwright_shapes::random::{Random, star, tangle};

    /// The roll that begins at a station, from a look at each stretch in turn, and whether it is
    /// wide enough.
    fn one_by_one(stations: &[Station], first: usize, size: f64) -> Option<(Roll, bool)> {
        let m = stations.len();
        if !stations[first].turns() {
            return None;
        }
        let mut tightest: Option<Roll> = None;
        let mut stretch = BorderStretch::before(stations, first);
        let mut way = 0.0;
        for n in first..first + m {
            stretch.take(&stations[n % m]);
            way += stations[n % m].length;
            if stations[n % m].turns()
                && let Some((roll, is_wide)) = stretch.roll(stations, size)
            {
                if is_wide {
                    return Some((roll, true));
                }
                if tightest.is_none_or(|tightest| roll.radius() < tightest.radius()) {
                    tightest = Some(roll);
                }
            }
            if way > REACH * stretch.narrowest().max(ROLL_WIDTH * size) {
                break;
            }
        }
        tightest.map(|roll| (roll, false))
    }

    #[test]
    fn stretches_that_are_left_out_are_no_rolls() {
        let mut random = Random::new(7);
        let boundaries = (0..80).filter_map(|n| {
            let (m, corners) = (8 + random.below(60), random.unit());
            let boundary = match n {
                0..16 => Some(Family::ALL[n % 8].boundary(if n < 8 { 60 } else { 150 })),
                16..48 => star(&mut random, m, corners),
                _ => tangle(&mut random, m, corners),
            };
            let positions = boundary?.positions();
            let point = |n: usize| Point3::new(positions[n].x, positions[n].y, positions[n].z);
            let points: Vec<CurvePoint> =
                (0..positions.len()).map(|n| CurvePoint::smooth(point(n))).collect();
            Boundary::new(vec![samples_from_points(&points)]).ok()
        });
        let mut counts = [0; 2];
        for boundary in boundaries {
            let options = TriangulateOptions::default();
            let Ok(found) = triangulate(&boundary, None, &options, &mut Unwatched) else {
                continue;
            };
            let connectivity = Connectivity::new(boundary.loops(), found.triangles).unwrap();
            let surface = Surface::new(connectivity, boundary.positions());
            let size = size_of(surface.positions().iter().copied());
            let hinges = surface.connectivity().hinges();
            let creases: Vec<f64> = hinges.iter().map(|hinge| surface.crease(hinge)).collect();
            let mut stations = stations(&surface, &creases);
            note_lies(&mut stations, size);
            let mut seen = Vec::new();
            for first in 0..stations.len() {
                let roll = roll_from(&stations, first, size, &mut seen);
                let plain = one_by_one(&stations, first, size);
                let numbers = |roll: &Roll| {
                    let lengths = [roll.turn, roll.width, roll.step].map(f64::to_bits);
                    (lengths, roll.count, roll.middle)
                };
                let of_plain = plain.as_ref().map(|(roll, _)| numbers(roll));
                assert_eq!(roll.as_ref().map(numbers), of_plain, "{first}");
                if let Some((_, is_wide)) = plain {
                    counts[usize::from(is_wide)] += 1;
                }
            }
        }
        assert!(counts.iter().all(|count| *count > 500), "{counts:?}");
    }
}
