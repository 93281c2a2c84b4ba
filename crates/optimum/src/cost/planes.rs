//! The tangent planes along a rung.
//!
//! Nearly all rungs end at two smooth samples, away from the directions of the boundary there:
//! [`smooth`] prices those without branches, so that the compiler vectorises it over many rungs,
//! and flags the others. [`special`] has the conventions for these. The choice between the two
//! depends on the rung alone, so a rung has the same bits wherever it is priced.

use sheetwright_geometry::math::{Vec3, angle_between, atan2, cos, sin, turned, unit};

/// Sine of the angle between rung and tangent up to which they count as parallel. At it, the
/// rounding of coordinates (10⁻¹⁶ of the size) still leaves the normal seven digits on rungs of the
/// size of the boundary; samples would have to stand a million to a radian of turning to come near.
const PARALLEL_SINE: f64 = 1e-9;

/// Sectors with a smaller gap, radians, touch: such a gap is rounding, and as a twist far below the
/// quantum of prices.
const MEETING: f64 = 1e-12;
/// Margin of the cone of special directions, as a squared cosine: rounding (2⁻⁵²) must never take
/// an open direction for a plain one, and within its square root, a millionth of a radian, a
/// parallel rung is special too.
const COSINE_MARGIN: f64 = 1e-12;
/// Squared length of the sum of two unit normals below which they are opposite and have no mean: a
/// millionth of a radian from it.
const OPPOSITE: f64 = 1e-12;
/// Weight of the cosine to the reference normal, which decides between choices of equal twist:
/// below the quantum of prices.
const TIE: f64 = 1e-14;
const TURNS: [f64; 3] = [0.0, -std::f64::consts::TAU, std::f64::consts::TAU];

/// The tangent planes along a rung.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RungPlanes {
    /// Unit normals at the two ends, towards the side that the surface faces; the end with the
    /// lower sample number first.
    pub at_ends: [Vec3; 2],
    /// N: the direction of their sum; zero where they are opposite.
    pub mean: Vec3,
    /// w, 0 ..= 2, without unit: 1 minus the cosine of the angle between them.
    pub twist: f64,
}

impl RungPlanes {
    #[inline(always)]
    fn new(a: Vec3, b: Vec3) -> Self {
        let twist = 0.5 * (a - b).length_squared();
        Self { at_ends: [a, b], mean: unit(a + b).unwrap_or(Vec3::ZERO), twist }
    }

    /// The warp angle: how far the tangent plane turns along the rung, radians, 0 ..= π.
    pub fn warp(&self) -> f64 {
        angle_between(self.at_ends[0], self.at_ends[1])
    }
}

/// The data at one end of a rung that its planes depend on.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    pub(super) position: Vec3,
    pub(super) tangent_in: Vec3,
    pub(super) tangent_out: Vec3,
    /// Unit directions of the edges that arrive and leave.
    pub(super) edge_in: Vec3,
    pub(super) edge_out: Vec3,
}

impl End {
    /// Square of the cosine of the angle to the tangent within which the sign of the normal may be
    /// open; −1 for a corner, all of whose rungs are special.
    ///
    /// Open directions lie on and inside the cone whose diameter the two edges are, so within twice
    /// the larger angle between the tangent and an edge.
    pub(super) fn special_cosine_squared(&self) -> f64 {
        if self.is_corner() {
            return -1.0;
        }
        let to_edge = self.tangent_in.dot(self.edge_in).min(self.tangent_in.dot(self.edge_out));
        let twice = (2.0 * to_edge.max(0.0) * to_edge.max(0.0) - 1.0).max(0.0);
        // A little wider, so that rounding never takes an open direction for a plain one; and never
        // so narrow that a parallel rung escapes.
        (twice * twice - COSINE_MARGIN).min(1.0 - COSINE_MARGIN)
    }

    pub(super) fn is_corner(&self) -> bool {
        self.tangent_in != self.tangent_out
    }

    /// The normal of the plane of both tangents of a corner, on the side of `facing`: that of the
    /// surface there, unless it has the apex of a cone. Zero for a smooth sample.
    pub(super) fn plane_normal(&self, facing: Vec3) -> Vec3 {
        let normal = unit(self.tangent_in.cross(self.tangent_out)).unwrap_or(Vec3::ZERO);
        along(normal, facing)
    }

    pub(super) fn mean_tangent(&self) -> Vec3 {
        unit(self.tangent_in + self.tangent_out).unwrap_or(self.tangent_in)
    }
}

/// A rung between two smooth samples, as numbers that stand in vector registers.
#[derive(Clone, Copy)]
pub(super) struct Smooth {
    pub(super) normals: [[f64; 3]; 2],
    pub(super) mean: [f64; 3],
    pub(super) twist: f64,
    /// Whether the other fields are invalid, because the rung is special.
    pub(super) is_special: bool,
}

/// The planes of the rung between two samples with these positions, tangents and squares of
/// special cosines, the lower number first.
#[inline(always)]
pub(super) fn smooth(
    (from, from_tangent, from_special): ([f64; 3], [f64; 3], f64),
    (to, to_tangent, to_special): ([f64; 3], [f64; 3], f64),
) -> Smooth {
    let d = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
    let length_squared = dot(d, d);
    let (along_from, along_to) = (dot(from_tangent, d), dot(to_tangent, d));
    let a = cross(from_tangent, d);
    let b = cross(d, to_tangent);
    let (a, b) = (scaled(a, 1.0 / dot(a, a).sqrt()), scaled(b, 1.0 / dot(b, b).sqrt()));
    let difference = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let sum = [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    let sum_squared = dot(sum, sum);
    let twist = 0.5 * dot(difference, difference);
    // `&` and `|` rather than `&&` and `||`: no branches.
    let plain = (along_from * along_from < from_special * length_squared)
        & (along_to * along_to < to_special * length_squared)
        & (sum_squared > OPPOSITE);
    Smooth {
        normals: [a, b],
        mean: scaled(sum, 1.0 / sum_squared.sqrt()),
        twist,
        is_special: !plain,
    }
}

/// Whether the rung between two samples certainly has no planes, because it is parallel to the
/// tangent of a smooth one; [`special`] says so of a few more.
#[inline(always)]
pub(super) fn is_parallel(
    (from, from_tangent, from_special): ([f64; 3], [f64; 3], f64),
    (to, to_tangent, to_special): ([f64; 3], [f64; 3], f64),
) -> bool {
    let d = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
    // Half of the sine, so that rounding does not matter.
    let most = 0.25 * PARALLEL_SINE * PARALLEL_SINE * dot(d, d);
    let is_along = |tangent: [f64; 3], special: f64| {
        let across = cross(tangent, d);
        special >= 0.0 && dot(across, across) < most
    };
    is_along(from_tangent, from_special) || is_along(to_tangent, to_special)
}

#[inline(always)]
pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn scaled(a: [f64; 3], factor: f64) -> [f64; 3] {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

impl From<Smooth> for RungPlanes {
    fn from(smooth: Smooth) -> Self {
        Self {
            at_ends: smooth.normals.map(Vec3::from_array),
            mean: Vec3::from_array(smooth.mean),
            twist: smooth.twist,
        }
    }
}

/// The normals that one end of a rung may have.
#[derive(Clone, Copy)]
enum Normals {
    One(Vec3),
    EitherSign(Vec3),
    Sector(Vec3, Vec3),
}

/// The planes of a special rung; `None` where it has none, because it is parallel to a tangent or
/// has no length. Where nothing else decides, normals point to the side of `facing`.
pub(super) fn special(from: &End, to: &End, facing: Vec3) -> Option<RungPlanes> {
    let d = unit(to.position - from.position)?;
    Some(match (from.normals(d)?, to.normals(-d)?) {
        (Normals::One(u), Normals::One(v)) => RungPlanes::new(u, v),
        (Normals::One(u), Normals::EitherSign(v)) => RungPlanes::new(u, along(v, u)),
        (Normals::EitherSign(u), Normals::One(v)) => RungPlanes::new(along(u, v), v),
        (Normals::EitherSign(u), Normals::EitherSign(v)) => {
            let v = along(v, u);
            let sign = if (u + v).dot(facing) < 0.0 { -1.0 } else { 1.0 };
            RungPlanes::new(u * sign, v * sign)
        }
        (u, v) => {
            let reference = from.plane_normal(facing) + to.plane_normal(facing);
            between_sectors(u, v, d, reference)
        }
    })
}

/// The planes of a rung, along the unit direction `d`, that ends at a corner: the two normals, one
/// from each end, that differ least, and of those the nearest to `reference`.
fn between_sectors(u: Normals, v: Normals, d: Vec3, reference: Vec3) -> RungPlanes {
    let mut best: Option<(f64, RungPlanes)> = None;
    for u in u.sectors() {
        for v in v.sectors() {
            let planes = closest(u, v, d, reference);
            let key = planes.twist - TIE * planes.mean.dot(reference);
            if best.is_none_or(|(least, _)| key < least) {
                best = Some((key, planes));
            }
        }
    }
    best.map_or_else(|| RungPlanes::new(reference, reference), |(_, planes)| planes)
}

/// `v` or −`v`, whichever lies along `u`.
fn along(v: Vec3, u: Vec3) -> Vec3 {
    if v.dot(u) < 0.0 { -v } else { v }
}

impl End {
    /// The normals of a rung that leaves this sample in the unit direction `d`.
    #[inline(always)]
    fn normals(&self, d: Vec3) -> Option<Normals> {
        let leaving = self.tangent_out.cross(d);
        if !self.is_corner() {
            let sine = leaving.length();
            if sine <= PARALLEL_SINE {
                return None;
            }
            let normal = leaving / sine;
            let open = self.edge_in.cross(d).dot(self.edge_out.cross(d)) <= 0.0;
            return Some(if open { Normals::EitherSign(normal) } else { Normals::One(normal) });
        }
        let arriving = self.tangent_in.cross(d);
        let (sine_in, sine_out) = (arriving.length(), leaving.length());
        let (lost_in, lost_out) = (sine_in <= PARALLEL_SINE, sine_out <= PARALLEL_SINE);
        let on_own_edge = (lost_in && self.tangent_in.dot(d) < 0.0)
            || (lost_out && self.tangent_out.dot(d) > 0.0);
        match (lost_in, lost_out) {
            _ if on_own_edge => None,
            (true, true) => None,
            (true, false) => Some(Normals::One(leaving / sine_out)),
            (false, true) => Some(Normals::One(arriving / sine_in)),
            (false, false) => Some(Normals::Sector(arriving / sine_in, leaving / sine_out)),
        }
    }
}

impl Normals {
    /// As sectors from one normal to another by the shorter way.
    fn sectors(self) -> impl Iterator<Item = (Vec3, Vec3)> {
        let (first, second) = match self {
            Self::One(n) => ((n, n), None),
            Self::EitherSign(n) => ((n, n), Some((-n, -n))),
            Self::Sector(a, b) => ((a, b), None),
        };
        std::iter::once(first).chain(second)
    }
}

/// The two normals, one from each sector of the plane across the unit direction `d`, that differ
/// least; where the sectors overlap, both are the normal nearest to `reference` in the overlap.
fn closest(u: (Vec3, Vec3), v: (Vec3, Vec3), d: Vec3, reference: Vec3) -> RungPlanes {
    let angle = |from: Vec3, to: Vec3| atan2(from.cross(to).dot(d), from.dot(to));
    // All angles are measured about d from the first normal of u. Most sectors are one normal.
    let span = |start: f64, (from, to): (Vec3, Vec3)| {
        let turn = if from == to { 0.0 } else { angle(from, to) };
        (start.min(start + turn), start.max(start + turn))
    };
    let (u_low, u_high) = span(0.0, u);
    let (v_low, v_high) = span(angle(u.0, v.0), v);
    let wanted = angle(u.0, reference - d * d.dot(reference));
    let at = |angle: f64| {
        if angle == 0.0 { u.0 } else { unit(turned(u.0, d, angle)).unwrap_or(u.0) }
    };
    // (gap, angle to the wanted direction, the two angles)
    let mut best: Option<(f64, f64, f64, f64)> = None;
    for round in TURNS {
        let (low, high) = (v_low + round, v_high + round);
        let (gap, a, b) = if low > u_high {
            (low - u_high, u_high, low)
        } else if u_low > high {
            (u_low - high, u_low, high)
        } else {
            let chosen = nearest(wanted, low.max(u_low), high.min(u_high));
            (0.0, chosen, chosen)
        };
        let off = angle_off(wanted, a);
        // Sectors that meet within rounding do meet.
        let gap = if gap < MEETING { 0.0 } else { gap };
        if best.is_none_or(|(least, least_off, ..)| (gap, off) < (least, least_off)) {
            best = Some((gap, off, a, b));
        }
    }
    let (gap, _, a, b) = best.unwrap_or((0.0, 0.0, 0.0, 0.0));
    let first = at(a);
    let mut planes = RungPlanes::new(first, if a == b { first } else { at(b) });
    // The gap itself, rather than the difference of two turned vectors, so that no rounding is
    // left where there is no twist.
    planes.twist = if gap == 0.0 { 0.0 } else { 2.0 * sin(0.5 * gap) * sin(0.5 * gap) };
    if gap == 0.0 {
        planes.at_ends[1] = planes.at_ends[0];
    }
    debug_assert!((planes.twist - (1.0 - cos(gap))).abs() < 1e-12);
    planes
}

/// The angle of the interval `low` ..= `high`, at most a turn wide, that is nearest to `wanted`,
/// round the back too; the lower end of two that are as near.
fn nearest(wanted: f64, low: f64, high: f64) -> f64 {
    match TURNS.map(|turn| wanted + turn).into_iter().find(|a| (low..=high).contains(a)) {
        Some(inside) => inside,
        None if angle_off(wanted, low) <= angle_off(wanted, high) => low,
        None => high,
    }
}

/// How far apart two angles within a turn and a half are, round the back too.
fn angle_off(a: f64, b: f64) -> f64 {
    TURNS.map(|turn| (a + turn - b).abs()).into_iter().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sectors_find_the_least_gap_round_the_back_too() {
        let n = |angle: f64| Vec3::new(cos(angle), sin(angle), 0.0);
        let planes = closest((n(0.0), n(1.0)), (n(-3.0), n(-2.5)), Vec3::Z, n(0.0));
        // Forwards from 1.0 to −3.0 + 2π the gap is 2.283; backwards from 0 to −2.5 it is 2.5.
        let gap = std::f64::consts::TAU - 4.0;
        assert!((planes.warp() - gap).abs() < 1e-12);
        for (wanted, chosen) in [(0.75, 0.75), (0.2, 0.5), (1.7, 1.0), (-2.0, 0.5)] {
            let planes = closest((n(0.0), n(1.0)), (n(0.5), n(2.0)), Vec3::Z, n(wanted));
            assert_eq!(planes.twist, 0.0);
            assert!((planes.mean - n(chosen)).length() < 1e-12, "{wanted} {planes:?}");
        }
    }
}
