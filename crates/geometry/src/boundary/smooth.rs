//! Smooth joints: a span with the tangents of both sides, and for G2 their curvatures too, replaces
//! the samples around a joint of two boundaries.
//!
//! The span is a Hermite polynomial between two samples that stay, a cubic for G1 and a quintic for
//! G2. Its speed at both ends is c / cos²(θ/4), with the chord c and the angle θ between the
//! tangents: that of the cubic nearest to a circular arc. It gets as many samples as it replaces,
//! evenly by length, with its tangents.

use crate::curve::Sample;
use crate::index::SampleIndex;
use crate::math::{Point3, Vec3, angle_between, cos, unit};

/// How smooth a loop is where two boundaries meet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Continuity {
    /// Unchanged: with a corner, unless the two happen to meet smoothly.
    #[default]
    G0,
    /// One tangent.
    G1,
    /// One tangent and one curvature.
    G2,
}

impl Continuity {
    /// How designs name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::G0 => "none",
            Self::G1 => "G1",
            Self::G2 => "G2",
        }
    }
}

/// How far from a joint a loop may be changed. The changed part ends sooner at a corner and half
/// way to the next joint, and reaches the nearest samples at least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Within {
    /// This arc length to both sides, mm.
    Mm(f64),
    /// This share of the length of the loop to both sides, up to ½.
    Share(f64),
}

impl Default for Within {
    fn default() -> Self {
        Self::Share(0.05)
    }
}

impl Within {
    /// Whether it is positive and finite, and at most ½ if it is a share.
    pub fn is_valid(self) -> bool {
        match self {
            Self::Mm(mm) => mm > 0.0 && mm.is_finite(),
            Self::Share(share) => share > 0.0 && share <= 0.5,
        }
    }

    fn way_mm(self, length_mm: f64) -> f64 {
        match self {
            Self::Mm(mm) => mm,
            Self::Share(share) => share * length_mm,
        }
    }
}

/// A place on a boundary where two that were joined meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothedJoint {
    /// The sample there; where joining removed a single shared sample, the one before it.
    pub sample: SampleIndex,
    /// The angle by which the loop turned there before it was made smooth, radians.
    pub turn: f64,
    /// The samples between which the loop was made smooth, themselves unchanged; `None` if the loop
    /// is unchanged here.
    pub window: Option<[SampleIndex; 2]>,
    /// The largest distance between the loop before and after, mm, measured at the samples of both.
    pub deviation_mm: f64,
}

/// Where two boundaries meet on a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum JointAt {
    /// At this sample.
    Sample,
    /// On the edge after this sample.
    EdgeAfter,
}

/// A sample of a loop that is being joined.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) sample: Sample,
    pub(super) joint: Option<JointAt>,
}

/// Makes the joints of all loops smooth and returns them, with samples counted through all loops;
/// `None` where two joints have no sample between them that could stay.
pub(super) fn smooth_joints(
    loops: &mut [Vec<Node>],
    continuity: Continuity,
    within: Within,
) -> Option<Vec<SmoothedJoint>> {
    let mut joints = Vec::new();
    let mut count = 0;
    for nodes in loops {
        let before = nodes.clone();
        let ring = Ring { nodes: &before, joints: joints_of(&before) };
        for n in 0..ring.joints.len() {
            let joint = ring.joints[n];
            let turn = ring.turn_at(joint);
            let skip = match continuity {
                Continuity::G0 => true,
                // One tangent is there already; a removed sample leaves none.
                Continuity::G1 => before[joint].joint == Some(JointAt::Sample) && turn == 0.0,
                Continuity::G2 => false,
            };
            let mut window = None;
            let mut deviation_mm = 0.0;
            if !skip {
                let [from, to] = ring.window(n, within)?;
                let span = ring.span(from, to, continuity);
                let replaced = to - from - 1;
                let found = span.even(replaced);
                deviation_mm = ring.deviation_mm(from, to, joint, &found);
                let m = nodes.len();
                for (k, sample) in found.into_iter().enumerate() {
                    nodes[(from + 1 + k) % m].sample = sample;
                }
                window = Some([from, to].map(|i| SampleIndex::new(count + i % m)));
            }
            let sample = SampleIndex::new(count + joint);
            joints.push(SmoothedJoint { sample, turn, window, deviation_mm });
        }
        count += nodes.len();
    }
    Some(joints)
}

fn joints_of(nodes: &[Node]) -> Vec<usize> {
    (0..nodes.len()).filter(|&i| nodes[i].joint.is_some()).collect()
}

/// A loop before the change, with the numbers of its nodes that are joints. Numbers run on over its
/// end.
struct Ring<'a> {
    nodes: &'a [Node],
    joints: Vec<usize>,
}

impl Ring<'_> {
    fn sample(&self, i: usize) -> Sample {
        self.nodes[i % self.nodes.len()].sample
    }

    fn at(&self, i: usize) -> Point3 {
        self.sample(i).position
    }

    fn length_mm(&self, from: usize, to: usize) -> f64 {
        (from..to).map(|i| self.at(i).distance(self.at(i + 1))).sum()
    }

    /// The nodes at a joint: one, or the two ends of an edge.
    fn ends(&self, joint: usize) -> [usize; 2] {
        match self.nodes[joint].joint {
            Some(JointAt::EdgeAfter) => [joint, joint + 1],
            _ => [joint, joint],
        }
    }

    /// By how much the loop turns at a joint, radians.
    fn turn_at(&self, joint: usize) -> f64 {
        let [first, last] = self.ends(joint);
        let (arriving, leaving) = (self.sample(first).tangent_in, self.sample(last).tangent_out);
        if arriving == leaving { 0.0 } else { angle_between(arriving, leaving) }
    }

    /// The nodes that stay at both ends of the replaced part around the n-th joint.
    fn window(&self, n: usize, within: Within) -> Option<[usize; 2]> {
        let (m, count) = (self.nodes.len(), self.joints.len());
        let way_mm = within.way_mm(self.length_mm(0, m));
        let joint = self.joints[n];
        let before = self.joints[(n + count - 1) % count];
        let after = self.joints[(n + 1) % count];
        // One round later, so that nodes before the joint have numbers too.
        let [first, last] = self.ends(joint).map(|i| i + m);
        let before = if before < joint { before + m } else { before };
        let after = if after > joint { after + m } else { after + 2 * m };
        let low = self.half_way(self.ends(before % m)[1] + before - before % m, first)?;
        let high = self.half_way(last, after)?;
        let half_edge = 0.5 * self.at(first).distance(self.at(last));
        let mut from = first;
        let mut left = way_mm - half_edge;
        while from > low {
            from -= 1;
            left -= self.at(from).distance(self.at(from + 1));
            if left <= 0.0 || self.sample(from).is_corner() {
                break;
            }
        }
        let mut to = last;
        let mut left = way_mm - half_edge;
        while to < high {
            to += 1;
            left -= self.at(to).distance(self.at(to - 1));
            if left <= 0.0 || self.sample(to).is_corner() {
                break;
            }
        }
        Some([from, to])
    }

    /// The node strictly between two that lies nearest to half way.
    fn half_way(&self, from: usize, to: usize) -> Option<usize> {
        let half = 0.5 * self.length_mm(from, to);
        let mut gone = 0.0;
        let mut best: Option<(f64, usize)> = None;
        for i in from + 1..to {
            gone += self.at(i).distance(self.at(i - 1));
            let off = (gone - half).abs();
            if best.is_none_or(|(least, _)| off < least) {
                best = Some((off, i));
            }
        }
        best.map(|(_, i)| i)
    }

    fn span(&self, from: usize, to: usize, continuity: Continuity) -> Span {
        let (a, b) = (self.sample(from), self.sample(to));
        let (a_tangent, b_tangent) = (a.tangent_out, b.tangent_in);
        let chord = a.position.distance(b.position);
        // cos²(θ/4) from cos(θ/2).
        let half = cos(0.5 * angle_between(a_tangent, b_tangent));
        let speed = 2.0 * chord / (1.0 + half);
        let (a_derivative, b_derivative) = (a_tangent * speed, b_tangent * speed);
        match continuity {
            Continuity::G2 => {
                let [a_bend, b_bend] = [self.curvature(from, true), self.curvature(to, false)];
                Span::quintic(
                    [a.position, b.position],
                    [a_derivative, b_derivative],
                    [a_bend * (speed * speed), b_bend * (speed * speed)],
                )
            }
            Continuity::G0 | Continuity::G1 => {
                Span::cubic([a.position, b.position], [a_derivative, b_derivative])
            }
        }
    }

    /// The curvature vector at a node, 1/mm: the difference of the tangents of its neighbours over
    /// the length between them; at a corner, that on the side of the window.
    fn curvature(&self, i: usize, window_after: bool) -> Vec3 {
        let i = i + self.nodes.len();
        let here = self.sample(i);
        let step = |a: usize| self.at(a).distance(self.at(a + 1));
        let (tangent, turned, way) = match (here.is_corner(), window_after) {
            (false, _) => {
                let turned = self.sample(i + 1).tangent_in - self.sample(i - 1).tangent_out;
                (here.tangent_out, turned, step(i - 1) + step(i))
            }
            (true, true) => {
                let turned = self.sample(i + 1).tangent_in - here.tangent_out;
                (here.tangent_out, turned, step(i))
            }
            (true, false) => {
                let turned = here.tangent_in - self.sample(i - 1).tangent_out;
                (here.tangent_in, turned, step(i - 1))
            }
        };
        let bend = if way > 0.0 { turned / way } else { Vec3::ZERO };
        bend - tangent * bend.dot(tangent)
    }

    /// The largest distance between the loop before and after, mm, between two nodes that stay,
    /// measured at the samples of both (at some hundred of them where there are more).
    fn deviation_mm(&self, from: usize, to: usize, joint: usize, found: &[Sample]) -> f64 {
        const MEASURED: usize = 256;
        let before: Vec<Point3> = (from..=to).map(|i| self.at(i)).collect();
        let mut after = vec![self.at(from)];
        after.extend(found.iter().map(|s| s.position));
        after.push(self.at(to));
        let far = |points: &[Point3], line: &[Point3]| {
            let measured = points.iter().step_by(points.len().div_ceil(MEASURED));
            measured.map(|&p| distance_to(p, line)).fold(0.0, f64::max)
        };
        // The distance is mostly largest at the corner itself.
        let corner = self.ends(joint).map(|i| distance_to(self.at(i), &after));
        far(&before, &after).max(far(&after, &before)).max(corner[0]).max(corner[1])
    }
}

/// The distance of a point from a polyline, mm.
fn distance_to(p: Point3, line: &[Point3]) -> f64 {
    line.windows(2)
        .map(|ends| {
            let along = ends[1] - ends[0];
            let share = (p - ends[0]).dot(along) / along.length_squared();
            let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
            p.distance(ends[0] + along * share)
        })
        .fold(f64::INFINITY, f64::min)
}

/// A polynomial over 0 ..= 1 by its coefficients, from that of t⁰ to that of t⁵; the first is the
/// way from `start`.
struct Span {
    start: Point3,
    coefficients: [Vec3; 6],
}

impl Span {
    fn cubic([a, b]: [Point3; 2], [u, v]: [Vec3; 2]) -> Self {
        let d = b - a;
        let coefficients =
            [Vec3::ZERO, u, d * 3.0 - u * 2.0 - v, u + v - d * 2.0, Vec3::ZERO, Vec3::ZERO];
        Self { start: a, coefficients }
    }

    /// From positions, first and second derivatives at both ends.
    fn quintic([a, b]: [Point3; 2], [u, v]: [Vec3; 2], [p, q]: [Vec3; 2]) -> Self {
        let d = b - a;
        let coefficients = [
            Vec3::ZERO,
            u,
            p * 0.5,
            d * 10.0 - u * 6.0 - v * 4.0 - p * 1.5 + q * 0.5,
            d * -15.0 + u * 8.0 + v * 7.0 + p * 1.5 - q,
            d * 6.0 - (u + v) * 3.0 + (q - p) * 0.5,
        ];
        Self { start: a, coefficients }
    }

    fn position(&self, t: f64) -> Point3 {
        self.start + self.coefficients.iter().rev().fold(Vec3::ZERO, |sum, c| sum * t + *c)
    }

    fn derivative(&self, t: f64) -> Vec3 {
        let factors = (1..6).rev().map(|k| self.coefficients[k] * k as f64);
        factors.fold(Vec3::ZERO, |sum, c| sum * t + c)
    }

    /// `count` samples inside the span, evenly by length.
    fn even(&self, count: usize) -> Vec<Sample> {
        /// Steps of the table of lengths for each sample: enough for steps that differ by less
        /// than a hundredth.
        const STEPS: usize = 16;
        let steps = STEPS * (count + 1);
        let parameter = |n: usize| n as f64 / steps as f64;
        let mut table = Vec::with_capacity(steps + 1);
        let mut gone = 0.0;
        table.push(gone);
        for n in 1..=steps {
            gone += self.position(parameter(n - 1)).distance(self.position(parameter(n)));
            table.push(gone);
        }
        (1..=count)
            .map(|k| {
                let wanted = gone * k as f64 / (count + 1) as f64;
                let n = table.partition_point(|&length| length <= wanted).clamp(1, steps);
                let step = table[n] - table[n - 1];
                let share = if step > 0.0 { (wanted - table[n - 1]) / step } else { 0.0 };
                let t = ((n - 1) as f64 + share) / steps as f64;
                // Where the derivative vanishes, the direction of the chord.
                let chord = self.position(1.0) - self.start;
                let tangent = unit(self.derivative(t)).or(unit(chord)).unwrap_or(Vec3::ZERO);
                Sample { position: self.position(t), tangent_in: tangent, tangent_out: tangent }
            })
            .collect()
    }
}
