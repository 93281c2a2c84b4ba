//! Derivatives of the price of a triangulation by positions and tangents of samples.
//!
//! Reverse-mode differentiation by hand: the price is a sum over rungs and triangles, and the
//! derivative of each term is carried back, through the mean normal N, the two normals at the ends
//! and the cross products that they come from, to positions and tangents.
//!
//! The price of a rung at a corner or with an open sign is piecewise smooth. The active piece is
//! read off its planes: each normal is ± t × d of one tangent, or, where two sectors overlap, the
//! normal nearest to the planes of the corners.

use super::{End, Prices, RungPlanes};
use sheetwright_geometry::math::{Vec3, unit};

/// Squared distance of two unit normals up to which they are the same expression: a millionth,
/// squared. Normals that are turned by an angle differ from t × d by rounding only.
const SAME_NORMAL: f64 = 1e-12;

/// Squared distance of two unit normals up to which they differ by rounding alone. Where two
/// tangents lie in one plane with the rung, as those along the edges of a triangle do, both give
/// the normal, and the first is taken.
const ROUNDING: f64 = 1e-24;

/// The derivatives of a price by the position and the unit tangents of a sample; per mm, and per
/// radian that a tangent turns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SampleSlope {
    /// By the position, per mm.
    pub position: Vec3,
    /// By the tangent of arrival.
    pub tangent_in: Vec3,
    /// By the tangent of leaving.
    pub tangent_out: Vec3,
}

/// Where a normal of a rung comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Source {
    /// ± t × d, with a tangent of the sample at one end.
    Tangent { at_second: bool, arriving: bool, negative: bool },
    /// The normal nearest to the planes of the corners, in the overlap of two sectors.
    Corners,
    /// Unknown: the normal is taken to be constant.
    Unknown,
}

/// Which piece of its price is active on a rung: where it changes, the price has a kink.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece(PieceKind);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PieceKind {
    /// One normal at each end.
    Apart([Source; 2]),
    /// The sectors of the ends overlap: no twist, and one normal for both.
    Shared(Source),
    /// No tangent planes.
    None,
}

/// The planes of a rung and where they come from.
#[derive(Clone, Copy, Debug)]
pub struct SlopedRung {
    ends: [usize; 2],
    /// Its tangent planes; `None` where it has none.
    pub planes: Option<RungPlanes>,
    /// Which piece of its price is active.
    pub piece: Piece,
}

impl Prices {
    /// The planes of the rung between samples `i` < `j`, with what their slopes need.
    pub fn sloped_rung(&self, i: usize, j: usize) -> SlopedRung {
        let planes = self.planes(i, j);
        let kind = planes.map_or(PieceKind::None, |planes| {
            let [a, b] = planes.at_ends;
            let corner = |n: usize| self.ends[n].tangent_in != self.ends[n].tangent_out;
            if a == b && planes.twist == 0.0 && (corner(i) || corner(j)) {
                let either = self.source(i, j, a, [false, true]);
                let source = if either != Source::Unknown {
                    either
                } else if self.nearest_to_corners(i, j).is_some_and(|n| same(n, a)) {
                    Source::Corners
                } else {
                    Source::Unknown
                };
                return PieceKind::Shared(source);
            }
            PieceKind::Apart([self.source(i, j, a, [false]), self.source(i, j, b, [true])])
        });
        SlopedRung { ends: [i, j], planes, piece: Piece(kind) }
    }

    /// The tangent among those of the ends `at` that `normal` comes from.
    fn source(
        &self,
        i: usize,
        j: usize,
        normal: Vec3,
        at: impl IntoIterator<Item = bool>,
    ) -> Source {
        let mut best = (SAME_NORMAL, Source::Unknown);
        for at_second in at {
            for arriving in [false, true] {
                let Some(candidate) = unit(self.across(i, j, at_second, arriving).0) else {
                    continue;
                };
                for negative in [false, true] {
                    let signed = if negative { -candidate } else { candidate };
                    let off = (signed - normal).length_squared();
                    let source = Source::Tangent { at_second, arriving, negative };
                    if off < ROUNDING {
                        return source;
                    }
                    if off < best.0 {
                        best = (off, source);
                    }
                }
            }
        }
        best.1
    }

    /// t × d, t and d for a tangent at one end, d from there to the other end.
    fn across(&self, i: usize, j: usize, at_second: bool, arriving: bool) -> (Vec3, Vec3, Vec3) {
        let (here, there) = if at_second { (j, i) } else { (i, j) };
        let end = &self.ends[here];
        let tangent = if arriving { end.tangent_in } else { end.tangent_out };
        let way = self.ends[there].position - end.position;
        (tangent.cross(way), tangent, way)
    }

    /// The normal across the rung that is nearest to the planes of the corners at its ends.
    fn nearest_to_corners(&self, i: usize, j: usize) -> Option<Vec3> {
        let d = unit(self.ends[j].position - self.ends[i].position)?;
        let reference =
            self.ends[i].plane_normal(self.facing) + self.ends[j].plane_normal(self.facing);
        unit(reference - d * reference.dot(d))
    }

    /// Carries the slopes of a price with the twist and with N of a rung back to its samples.
    pub fn carry_rung(
        &self,
        rung: &SlopedRung,
        with_twist: f64,
        with_mean: Vec3,
        slopes: &mut [SampleSlope],
    ) {
        let Some(planes) = rung.planes else { return };
        match rung.piece.0 {
            PieceKind::None => {}
            PieceKind::Shared(source) => {
                self.carry_normal(rung.ends, source, planes.mean, with_mean, slopes);
            }
            PieceKind::Apart(sources) => {
                let [a, b] = planes.at_ends;
                let with_a = (a - b) * with_twist;
                let mut with_ends = [with_a, -with_a];
                let sum = (a + b).length();
                if planes.mean != Vec3::ZERO && sum > 0.0 {
                    let with_sum = rejected(with_mean, planes.mean) / sum;
                    with_ends = with_ends.map(|with_end| with_end + with_sum);
                }
                for (n, source) in sources.into_iter().enumerate() {
                    self.carry_normal(rung.ends, source, planes.at_ends[n], with_ends[n], slopes);
                }
            }
        }
    }

    fn carry_normal(
        &self,
        [i, j]: [usize; 2],
        source: Source,
        normal: Vec3,
        with_normal: Vec3,
        slopes: &mut [SampleSlope],
    ) {
        match source {
            Source::Unknown => {}
            Source::Tangent { at_second, arriving, negative } => {
                let (product, tangent, way) = self.across(i, j, at_second, arriving);
                let length = product.length();
                if length == 0.0 {
                    return;
                }
                let sign = if negative { -1.0 } else { 1.0 };
                let with_product = rejected(with_normal, normal) * (sign / length);
                let (here, there) = if at_second { (j, i) } else { (i, j) };
                let with_tangent = way.cross(with_product);
                let with_way = with_product.cross(tangent);
                if arriving {
                    slopes[here].tangent_in += with_tangent;
                } else {
                    slopes[here].tangent_out += with_tangent;
                }
                slopes[here].position -= with_way;
                slopes[there].position += with_way;
            }
            Source::Corners => self.carry_corners([i, j], normal, with_normal, slopes),
        }
    }

    /// N = q / |q| with q = r − d (r · d) and r the sum of the normals of the corners' planes.
    fn carry_corners(
        &self,
        [i, j]: [usize; 2],
        normal: Vec3,
        with_normal: Vec3,
        slopes: &mut [SampleSlope],
    ) {
        let way = self.ends[j].position - self.ends[i].position;
        let Some(d) = unit(way) else { return };
        let [at_i, at_j] = [i, j].map(|n| self.ends[n].plane_normal(self.facing));
        let reference = at_i + at_j;
        let length = (reference - d * reference.dot(d)).length();
        if length == 0.0 {
            return;
        }
        let with_q = rejected(with_normal, normal) / length;
        let with_d = -(reference * with_q.dot(d) + with_q * reference.dot(d));
        let with_way = rejected(with_d, d) / way.length();
        slopes[i].position -= with_way;
        slopes[j].position += with_way;
        let with_reference = rejected(with_q, d);
        for (n, plane) in [(i, at_i), (j, at_j)] {
            let End { tangent_in, tangent_out, .. } = self.ends[n];
            let product = tangent_in.cross(tangent_out);
            let sine = product.length();
            if plane == Vec3::ZERO || sine == 0.0 {
                continue;
            }
            let sign = if product.dot(plane) < 0.0 { -1.0 } else { 1.0 };
            let with_product = rejected(with_reference, plane) * (sign / sine);
            slopes[n].tangent_in += tangent_out.cross(with_product);
            slopes[n].tangent_out += with_product.cross(tangent_in);
        }
    }

    /// The price of the triangle i, k, j with this many rungs and this sum of their N, before
    /// rounding, and its derivative by the sum of N; carries its slopes back to its corners.
    pub fn carry_triangle(
        &self,
        [i, k, j]: [usize; 3],
        rungs: f64,
        sum: Vec3,
        slopes: &mut [SampleSlope],
    ) -> (f64, Vec3) {
        let fold = self.options.fold;
        let at = |n: usize| self.ends[n].position;
        let (u, v) = (at(k) - at(i), at(j) - at(i));
        let area_vector = u.cross(v);
        let doubled_area = area_vector.length();
        if doubled_area == 0.0 {
            return (fold * 2.0 * rungs, Vec3::ZERO);
        }
        let normal = area_vector / doubled_area;
        let with_area = rejected(sum, normal) * (-fold / doubled_area);
        let (with_u, with_v) = (v.cross(with_area), with_area.cross(u));
        slopes[i].position -= with_u + with_v;
        slopes[k].position += with_u;
        slopes[j].position += with_v;
        (fold * (rungs - normal.dot(sum)), normal * -fold)
    }
}

/// The part of `v` across the unit vector `axis`.
fn rejected(v: Vec3, axis: Vec3) -> Vec3 {
    v - axis * v.dot(axis)
}

fn same(a: Vec3, b: Vec3) -> bool {
    (a - b).length_squared() < SAME_NORMAL
}
