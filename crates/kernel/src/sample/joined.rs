//! The samples of a panel that joins others: theirs, sampled alike along what they share.
//!
//! Panels share edges, and ⊕ looks for shared samples. So each run of each part, from corner to
//! corner or to where another part ends on it, is sampled by itself, from where it was drawn from;
//! runs that lie on one another get equal numbers of samples, and the others share out the rest of
//! the panel's number by their lengths.

use super::error::{PanelCause, PanelError};
use super::shared_runs::{Link, LoopSource, MAX_PIECES, loop_samples, near_mm, sources};
use super::source::Sampled;
use super::steps::{StepSource, StepsByPlace};
use crate::design::{Design, DesignPanel, Join, PanelShape};
use sheetwright_geometry::boundary::{
    Boundary, JoinCause, JoinError, JoinOptions, Joined, join_all,
};
use sheetwright_geometry::curve::{SampleError, sample_chain, sample_open};
use sheetwright_geometry::math::{Point3, Vec3};
use sheetwright_geometry::predicate::for_touching_boxes;
use sheetwright_geometry::tolerance::Tolerance;

/// The most rounds of sharing samples out, until the outer loop has the number of samples of the
/// panel: two are enough unless a ring closes.
const ROUNDS: usize = 6;

/// The most samples of all parts. It ends the search for the number of samples of the outer loop:
/// an outline of fixed samples never gets more of them, and an edge that two parts share may be
/// much longer than the rest of both.
const MOST: usize = 2 * MAX_PIECES;

/// The joined boundary of the parts of `panel`.
pub(super) fn sampled(
    design: &Design,
    panel: &DesignPanel,
    join: &Join,
) -> Result<Sampled, PanelError> {
    let failed = |cause: PanelCause| PanelError::of_panel(&panel.name, cause);
    let parts = parts_of(design, join).map_err(failed)?;
    if panel.samples > MAX_PIECES {
        let cause = JoinCause::TooLarge { found: panel.samples, most: MAX_PIECES };
        return Err(failed(PanelCause::Join { part: None, cause }));
    }
    let sources = sources(design, &parts, &failed)?;
    let links = Links::new(&sources);
    let options = JoinOptions { same: Tolerance::CHAIN, smooth: join.smooth, within: join.within };
    let with = |asked: usize| {
        let divisions = links.shared_out(asked).map_err(|e| failed(PanelCause::Sampling(e)))?;
        joined_with(&parts, &sources, &divisions, &options, &failed)
    };
    let on_outer = |(joined, _): &WithSteps| joined.boundary.loops()[0].len();
    let mut asked = links.first_guess(panel.samples);
    let mut joined = with(asked)?;
    let mut found = on_outer(&joined);
    for _ in 1..ROUNDS {
        if found == panel.samples || links.free_length == 0.0 {
            break;
        }
        asked = if found.abs_diff(panel.samples) > 4 {
            (asked as f64 * panel.samples as f64 / found as f64).round() as usize
        } else {
            (asked + panel.samples).saturating_sub(found)
        };
        asked = asked.min(MOST);
        // Where fewer do not do, those that there are are as near as it comes.
        let Ok(tried) = with(asked) else { break };
        found = on_outer(&tried);
        if found.abs_diff(panel.samples) < on_outer(&joined).abs_diff(panel.samples) {
            joined = tried;
        }
    }
    Ok(Sampled::joined(joined.0, joined.1))
}

fn parts_of<'a>(design: &'a Design, join: &Join) -> Result<Vec<&'a DesignPanel>, PanelCause> {
    let part = |name: &String| {
        let part = design.panels.iter().find(|panel| panel.name == *name);
        match part {
            None => Err(PanelCause::UnknownPanel { name: name.clone() }),
            Some(DesignPanel { shape: PanelShape::Join(_), .. }) => {
                Err(PanelCause::JoinOfJoins { name: name.clone() })
            }
            Some(DesignPanel { shape: PanelShape::Mesh(_), .. }) => {
                Err(PanelCause::NoCurves { name: name.clone() })
            }
            Some(part) if part.run_on => Err(PanelCause::RunOn),
            Some(part) => Ok(part),
        }
    };
    join.parts.iter().map(part).collect()
}

/// How long the links of all parts are, and which of them lie on one another. Links are counted
/// through all loops of all parts.
struct Links {
    lengths: Vec<f64>,
    /// The fewest divisions of each: one, or three of a closed one.
    least: Vec<usize>,
    /// The first link that lies on this one: of another part, or the way back along a seam.
    on: Vec<Option<usize>>,
    is_shared: Vec<bool>,
    /// The length of those that nothing lies on, mm, and how much of it belongs to outer loops.
    free_length: f64,
    free_outer_length: f64,
}

impl Links {
    fn new(sources: &[Vec<LoopSource>]) -> Self {
        // The loop of each link, counted within its part.
        let mut list: Vec<(usize, &Link)> = Vec::new();
        for (n, source) in sources.iter().flat_map(|loops| loops.iter().enumerate()) {
            if let LoopSource::Links(links) = source {
                list.extend(links.iter().map(|link| (n, link)));
            }
        }
        let near = near_mm(list.iter().map(|(_, link)| *link));
        let middles: Vec<Point3> = list.iter().map(|(_, link)| middle(link)).collect();
        let boxes: Vec<(Vec3, Vec3)> =
            middles.iter().map(|p| (p.to_vec() - near, p.to_vec() + near)).collect();
        let lengths: Vec<f64> = list.iter().map(|(_, link)| link.curve.length()).collect();
        let mut on: Vec<Option<usize>> = vec![None; list.len()];
        let mut is_shared = vec![false; list.len()];
        for_touching_boxes(&boxes, |i, j| {
            let (a, b) = (&list[i].1.curve, &list[j].1.curve);
            let meet = |p: Point3, q: Point3| p.distance(q) <= near;
            let alike = (meet(a.start(), b.start()) && meet(a.end(), b.end()))
                || (meet(a.start(), b.end()) && meet(a.end(), b.start()));
            let as_long = (lengths[i] - lengths[j]).abs() <= near;
            if alike && as_long && meet(middles[i], middles[j]) {
                (is_shared[i], is_shared[j]) = (true, true);
                on[j] = Some(on[j].map_or(i, |earlier| earlier.min(i)));
            }
        });
        let free = |outer_only: bool| -> f64 {
            let counts = |n: &usize| !is_shared[*n] && (!outer_only || list[*n].0 == 0);
            (0..list.len()).filter(counts).map(|n| lengths[n]).sum()
        };
        let (free_length, free_outer_length) = (free(false), free(true));
        let least = list.iter().map(|(_, link)| if link.curve.closed() { 3 } else { 1 }).collect();
        Self { lengths, least, on, is_shared, free_length, free_outer_length }
    }

    /// How many divisions the free links get together so that the outer ones have `samples`.
    fn first_guess(&self, samples: usize) -> usize {
        if self.free_outer_length > 0.0 {
            let all = samples as f64 * self.free_length / self.free_outer_length;
            (all.round() as usize).min(MOST)
        } else {
            samples
        }
    }

    /// The divisions of every link: `asked` among the free ones, by length (largest remainder, the
    /// first of equals); the same spacing on those that are shared.
    fn shared_out(&self, asked: usize) -> Result<Vec<usize>, SampleError> {
        let free: Vec<usize> = (0..self.lengths.len()).filter(|n| !self.is_shared[*n]).collect();
        let needed: usize = free.iter().map(|&n| self.least[n]).sum();
        if asked < needed && !free.is_empty() {
            return Err(SampleError::TooFew { asked, needed });
        }
        let per_mm = if self.free_length > 0.0 { asked as f64 / self.free_length } else { 0.0 };
        let shared_length: f64 = self.lengths.iter().sum::<f64>() - self.free_length;
        let shared_per_mm = per_mm.min(MOST as f64 / shared_length.max(f64::MIN_POSITIVE));
        let mut divisions = vec![0; self.lengths.len()];
        for n in 0..divisions.len() {
            if self.is_shared[n] {
                let wanted = (self.lengths[n] * shared_per_mm).round() as usize;
                divisions[n] = match self.on[n] {
                    Some(earlier) => divisions[earlier],
                    None => wanted.max(self.least[n]),
                };
            }
        }
        // The least is given already, so what is shared is the rest.
        let ideal: Vec<f64> = free
            .iter()
            .map(|&n| (self.lengths[n] * per_mm - self.least[n] as f64).max(0.0))
            .collect();
        let wanted: f64 = ideal.iter().sum();
        let scale = if wanted > 0.0 { (asked - needed.min(asked)) as f64 / wanted } else { 0.0 };
        let mut left = asked;
        for (&n, ideal) in free.iter().zip(&ideal) {
            divisions[n] = self.least[n] + (ideal * scale).floor() as usize;
            left = left.saturating_sub(divisions[n]);
        }
        let rest = |k: usize| ideal[k] * scale - (ideal[k] * scale).floor();
        let mut order: Vec<usize> = (0..free.len()).collect();
        order.sort_by(|&a, &b| rest(b).total_cmp(&rest(a)).then(a.cmp(&b)));
        for &k in order.iter().cycle().take(left.min(asked) * usize::from(!free.is_empty())) {
            divisions[free[k]] += 1;
        }
        Ok(divisions)
    }
}

/// The point of a link with as much of it on both sides.
fn middle(link: &Link) -> Point3 {
    let curve = &link.curve;
    let samples = if curve.closed() {
        sample_chain(std::slice::from_ref(curve), 4).map(|samples| samples[2])
    } else {
        sample_open(curve, 3).map(|samples| samples[1])
    };
    samples.map_or(curve.start(), |sample| sample.position)
}

/// A joined boundary, and what the step from each of its samples lies on.
type WithSteps = (Joined, Vec<Vec<StepSource>>);

fn joined_with(
    parts: &[&DesignPanel],
    sources: &[Vec<LoopSource>],
    divisions: &[usize],
    options: &JoinOptions,
    failed: &dyn Fn(PanelCause) -> PanelError,
) -> Result<WithSteps, PanelError> {
    let mut divisions = divisions.iter();
    let mut boundaries = Vec::new();
    let mut steps = StepsByPlace::default();
    for (part, loops) in parts.iter().zip(sources) {
        let mut sampled = Vec::new();
        for source in loops {
            let (samples, sources) = match source {
                LoopSource::Samples(samples, on) => (samples.clone(), vec![*on; samples.len()]),
                LoopSource::Links(links) => loop_samples(links, &mut divisions)
                    .map_err(|error| failed(PanelCause::Sampling(error)))?,
            };
            let next = samples.iter().cycle().skip(1);
            for ((from, to), step) in samples.iter().zip(next).zip(sources) {
                steps.insert([from.position, to.position], step);
            }
            sampled.push(samples);
        }
        let boundary = Boundary::new(sampled)
            .map_err(|error| PanelError::of_panel(&part.name, PanelCause::Boundary(error)))?;
        boundaries.push(boundary);
    }
    let boundaries: Vec<&Boundary> = boundaries.iter().collect();
    let joined = join_all(&boundaries, options).map_err(|JoinError { part, cause }| {
        let part = part.map(|n| parts[n].name.clone());
        failed(PanelCause::Join { part, cause })
    })?;
    let steps = steps.of(&joined.boundary);
    Ok((joined, steps))
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::design::{CurveUse, DesignCurve};
    use sheetwright_geometry::boundary::{Continuity, Within};
    use sheetwright_geometry::curve::{CurveKind, CurvePoint};
    use sheetwright_geometry::math::{cos, from_deg, sin};

    /// Two halves of a tube about the axis z, of radius 50 and height 80.
    fn tube() -> Design {
        let arc = |from: f64, z: f64| -> Vec<CurvePoint> {
            (0..=12)
                .map(|n| {
                    let a = from_deg(from + 15.0 * f64::from(n));
                    CurvePoint::smooth(Point3::new(50.0 * cos(a), 50.0 * sin(a), z))
                })
                .collect()
        };
        let line =
            |x: f64| [0.0, 80.0].map(|z| CurvePoint::corner(Point3::new(x, 0.0, z))).to_vec();
        let curve = |name: &str, kind: CurveKind, points: Vec<CurvePoint>| DesignCurve {
            name: name.into(),
            kind: Some(kind),
            closed: false,
            points,
        };
        let panel = |name: &str, shape: PanelShape| DesignPanel {
            fold: 1.0,
            ..DesignPanel::new(name, shape, 90)
        };
        let loop_of = |uses: [(&str, bool); 4]| PanelShape::Loops {
            outer: uses.map(|(name, reversed)| CurveUse { name: name.into(), reversed }).to_vec(),
            holes: Vec::new(),
        };
        Design {
            name: "tube".into(),
            material: None,
            materials: Vec::new(),
            curves: vec![
                curve("low-front", CurveKind::Spline, arc(180.0, 0.0)),
                curve("low-back", CurveKind::Spline, arc(0.0, 0.0)),
                curve("high-front", CurveKind::Spline, arc(180.0, 80.0)),
                curve("high-back", CurveKind::Spline, arc(0.0, 80.0)),
                curve("east", CurveKind::Polyline, line(50.0)),
                curve("west", CurveKind::Polyline, line(-50.0)),
            ],
            panels: vec![
                panel(
                    "front",
                    loop_of([
                        ("low-front", false),
                        ("east", false),
                        ("high-front", true),
                        ("west", true),
                    ]),
                ),
                // Drawn from inside.
                panel(
                    "back",
                    loop_of([
                        ("west", false),
                        ("high-back", true),
                        ("east", true),
                        ("low-back", false),
                    ]),
                ),
            ],
            ..Design::default()
        }
    }

    #[test]
    fn a_tube_of_two_halves_has_two_loops() {
        let design = tube();
        let join = Join {
            parts: vec!["front".into(), "back".into()],
            smooth: Continuity::G1,
            within: Within::default(),
            keep_parts: false,
        };
        let panel =
            DesignPanel { shape: PanelShape::Join(join.clone()), ..design.panels[0].clone() };
        let Ok(tube) = sampled(&design, &panel, &join) else { panic!() };
        let counts: Vec<usize> = tube.loops.iter().map(Vec::len).collect();
        assert_eq!(counts, [90, 90]);
        // Natural ends of the arcs leave small corners where they meet, which are made smooth.
        assert!(tube.loops.iter().flatten().all(|s| !s.sample.is_corner()));
        let joined = tube.joined.unwrap();
        assert!(joined.joints.iter().any(|joint| joint.window.is_some()));
    }
}
