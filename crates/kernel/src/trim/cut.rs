//! The cut line of a part: the net and what is added to it, without what is taken away.

use super::TrimFault;
use crate::pattern::{PathKind, PatternLabel, PatternPath};
use sheetwright_geometry::math::Point2;
use sheetwright_geometry::predicate::signed_area_doubled;
use sheetwright_geometry::region::{Region, combined, common_mm2};

/// Pieces with less of the net than this are no part of it, mm².
const CRUMB_MM2: f64 = 1e-3;
/// The net may leave the cut region by this, mm: the rounding of the corners of the cut line.
const PROVED_MM: f64 = 1e-6;

/// What is to be said about the trims of a part. Edges are called as its pattern shows them, by
/// `PART/MARK` or `PART/EDGE`.
#[derive(Clone, Debug, PartialEq)]
pub enum TrimNote {
    /// Tabs cover less than half of some joints, since there is no room on either side.
    NoRoomForTabs {
        /// Both edges of each joint; at a seam of one part, both have one mark.
        joints: Vec<[String; 2]>,
        /// The least share of the length of one that has tabs of the full width.
        covered: f64,
    },
    /// Some holes would reach over the edge or into one another, and were left out.
    HolesLeftOut {
        /// The edge.
        edge: String,
        /// How many were left out.
        left_out: usize,
        /// Of how many.
        of: usize,
    },
    /// A flange along a curve stretches at its rim when it is bent, or shrinks.
    FlangeStretches {
        /// The edge.
        edge: String,
        /// How long the rim is on the pattern, mm.
        flat_mm: f64,
        /// How long it is once the flange is bent, mm.
        bent_mm: f64,
    },
    /// What was added closes a hole or a gap of the part.
    Closes {
        /// How many holes the net has.
        of_net: usize,
        /// How many holes the cut lines have.
        of_cut: usize,
    },
    /// The cut line is not proved to go round the net line.
    NotProved {
        /// The area of the net that lies outside, mm².
        outside_mm2: f64,
    },
    /// The pattern overlaps itself, so nothing was added.
    Overlaps,
}

/// The trims of a part, ready to be drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Trimmed {
    /// The region to cut out; `None` where it is the net.
    pub(crate) cut: Option<Region>,
    /// Folds, holes, notches and ticks.
    pub(crate) paths: Vec<PatternPath>,
    /// Their texts.
    pub(crate) labels: Vec<PatternLabel>,
    /// What is to be said.
    pub(crate) notes: Vec<TrimNote>,
}

/// The trims of a part while they are made.
#[derive(Default)]
pub(super) struct Making {
    /// Polygons that are added to the net.
    pub(super) added: Vec<Vec<Point2>>,
    /// Polygons that are taken from what is added.
    pub(super) removed: Vec<Vec<Point2>>,
    /// Polygons that are taken from what is added beyond the net, as slots through it.
    pub(super) slotted: Vec<Vec<Point2>>,
    /// Polygons that are taken from the net, too.
    pub(super) carved: Vec<Vec<Point2>>,
    /// The centres and radii of holes, mm.
    pub(super) holes: Vec<(Point2, f64)>,
    pub(super) paths: Vec<PatternPath>,
    pub(super) labels: Vec<PatternLabel>,
    pub(super) notes: Vec<TrimNote>,
}

impl Making {
    /// Notes a joint, tabs of which cover this share alone, with others that there are.
    pub(super) fn note_no_room(&mut self, joint: [String; 2], share: f64) {
        for note in &mut self.notes {
            if let TrimNote::NoRoomForTabs { joints, covered } = note {
                joints.push(joint);
                *covered = covered.min(share);
                return;
            }
        }
        self.notes.push(TrimNote::NoRoomForTabs { joints: vec![joint], covered: share });
    }

    /// The cut line around these net lines.
    ///
    /// # Errors
    /// Cut lines that part the piece.
    pub(super) fn cut(self, net: &[Vec<Point2>]) -> Result<Trimmed, TrimFault> {
        let Self { added, removed, slotted, carved, mut paths, labels, mut notes, .. } = self;
        let slots = combined(&[], &slotted, &[]).len();
        let removed = [removed, slotted].concat();
        let mut cut = None;
        if !(added.is_empty() && carved.is_empty()) {
            let mut lines = net.to_vec();
            for Region { outline, holes } in combined(&[], &added, &removed) {
                lines.push(outline);
                lines.extend(holes);
            }
            let mut regions = combined(&lines, &[], &carved);
            // What a corner cuts off beyond the net is waste.
            let of_net = |region: &Region| common_mm2(net, std::slice::from_ref(&region.outline));
            regions.retain(|region| of_net(region) > CRUMB_MM2);
            if regions.len() != 1 {
                return Err(TrimFault::Parted { pieces: regions.len() });
            }
            let region = regions.remove(0);
            let (of_net, of_cut) = (net.len() - 1, region.holes.len());
            if of_net + slots != of_cut {
                notes.push(TrimNote::Closes { of_net, of_cut });
            }
            let outside_mm2 = outside_mm2(net, &region);
            if carved.is_empty() && outside_mm2 > PROVED_MM * length_mm(net) {
                notes.push(TrimNote::NotProved { outside_mm2 });
            }
            for path in paths.iter_mut().filter(|path| path.kind == PathKind::Notch) {
                begin_on(&mut path.points, &region);
            }
            cut = Some(region);
        }
        Ok(Trimmed { cut, paths, labels, notes })
    }
}

/// Moves the beginning of a notch, along its first stretch, to where that meets the line to cut:
/// beside a corner, or where the edge curves inwards, strips overlap and the line lies farther out.
fn begin_on(notch: &mut [Point2], cut: &Region) {
    let [first, second, ..] = *notch else { return };
    let way = first - second;
    let crossing = |a: Point2, b: Point2| {
        let side = b - a;
        let sine = way.perp_dot(side);
        let along = (a - second).perp_dot(side) / sine;
        let share = (a - second).perp_dot(way) / sine;
        let is_met = (0.0..=1.0).contains(&share) && along > 0.5;
        is_met.then_some((along, a.lerp(b, share)))
    };
    let lines = std::iter::once(&cut.outline).chain(&cut.holes);
    let sides =
        lines.flat_map(|line| (0..line.len()).map(|n| (line[n], line[(n + 1) % line.len()])));
    let met = sides.filter_map(|(a, b)| crossing(a, b));
    if let Some((_, at)) = met.min_by(|(a, _), (b, _)| (a - 1.0).abs().total_cmp(&(b - 1.0).abs()))
    {
        notch[0] = at;
    }
}

/// The area of the net outside a cut region, mm².
fn outside_mm2(net: &[Vec<Point2>], cut: &Region) -> f64 {
    let within = common_mm2(net, std::slice::from_ref(&cut.outline));
    let whole: f64 = net.iter().map(|line| 0.5 * signed_area_doubled(line)).sum();
    let in_holes: f64 =
        cut.holes.iter().map(|hole| common_mm2(net, std::slice::from_ref(hole))).sum();
    whole - within + in_holes
}

fn length_mm(lines: &[Vec<Point2>]) -> f64 {
    let of_line = |line: &Vec<Point2>| -> f64 {
        (0..line.len()).map(|n| line[n].distance(line[(n + 1) % line.len()])).sum()
    };
    lines.iter().map(of_line).sum()
}
