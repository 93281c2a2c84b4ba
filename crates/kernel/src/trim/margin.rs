//! Allowances, hems and flanges: strips of material beyond the net line.
//!
//! Along each step of the net line lies a trapezoid, as wide at both ends as the strip is there; at
//! each corner that sticks out, what `corner` adds. The union of all that with the net is the cut
//! region. No point of its border is nearer to the net line than the strip is wide there: such a
//! point would lie within the trapezoid of the step that it is nearest to, or within the wedge of a
//! corner, but where the style of a corner cuts that off.

use super::corner::{Between, Cornered};
use super::stretch::{Stretch, moved_out};
use crate::design::Corner;
use crate::pattern::{LabelKind, PathKind, PatternLabel, PatternPath, Role};
use sheetwright_geometry::math::{Point2, Vec2, to_deg, unit2};

/// A strip along a span of an edge.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Margin {
    /// Where it begins and ends, mm in space from the beginning of the edge.
    pub(super) span: [f64; 2],
    /// Its width at both, mm.
    pub(super) width: [f64; 2],
    /// The number of its trim: of two that meet at a corner, the later one decides its style.
    pub(super) trim: usize,
    /// What it is folded or bent by.
    pub(super) form: MarginForm,
}

/// What becomes of a strip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum MarginForm {
    /// It stays as it is, with corners of this style.
    Allowance(Corner),
    /// It is folded back at the net line, and once more at this distance beyond it, if that is not
    /// 0, mm.
    Hem(f64),
    /// It is bent at the net line.
    Flange {
        /// By this angle, radians.
        angle: f64,
        /// How far it keeps from a corner where the next edge has a flange, too, mm.
        relief: f64,
    },
}

impl Margin {
    /// Its width at a length; `None` outside its span.
    pub(super) fn width_at(&self, along: f64) -> Option<f64> {
        let [from, to] = self.span;
        let share = (along - from) / (to - from);
        (0.0..=1.0)
            .contains(&share)
            .then(|| self.width[0] + share * (self.width[1] - self.width[0]))
    }

    /// The strip divided at these lengths, if it is a flange.
    pub(super) fn divided(&self, at: &[f64]) -> Vec<Self> {
        let [from, to] = self.span;
        let inner =
            at.iter().copied().filter(|&at| from < at && at < to && self.relief().is_some());
        let ends: Vec<f64> = [from].into_iter().chain(inner).chain([to]).collect();
        ends.windows(2).map(|ends| Self { span: [ends[0], ends[1]], ..self.clone() }).collect()
    }

    /// The relief of a flange, mm; `None` of another strip.
    pub(super) fn relief(&self) -> Option<f64> {
        match self.form {
            MarginForm::Flange { relief, .. } => Some(relief),
            _ => None,
        }
    }
}

/// A step of the net line, the sheet to its left.
struct Step<'a> {
    ends: [Point2; 2],
    edge: usize,
    /// Where it begins, mm along its edge.
    from: f64,
    margin: Option<&'a Margin>,
    /// The widths of the strip at both ends; 0 without one.
    width: [f64; 2],
}

/// The edges of a part, loop after loop.
pub(super) struct Bordered<'a> {
    pub(super) stretches: &'a [Stretch],
    /// The numbers of the edges of each loop, in its order.
    pub(super) loops: &'a [Vec<usize>],
    /// The strips along each edge.
    pub(super) margins: &'a [Vec<Margin>],
}

impl Bordered<'_> {
    /// The polygons that the strips add to the net and that their corners take from them.
    pub(super) fn made(&self) -> Cornered {
        let mut made = Cornered::default();
        for edges in self.loops {
            let steps: Vec<Step<'_>> = edges.iter().flat_map(|&edge| self.steps(edge)).collect();
            for (n, step) in steps.iter().enumerate() {
                made.added.extend(step.strip());
                let before = &steps[(n + steps.len() - 1) % steps.len()];
                let corner = self.corner(before, step);
                made.added.extend(corner.added);
                made.removed.extend(corner.removed);
            }
        }
        made
    }

    /// The steps of an edge, divided where strips begin and end.
    fn steps(&self, edge: usize) -> Vec<Step<'_>> {
        let stretch = &self.stretches[edge];
        let margins = &self.margins[edge];
        let mut breaks: Vec<f64> = stretch.points().map(|(along, _)| along).collect();
        let spans = margins.iter().flat_map(|margin| margin.span);
        breaks.extend(spans.filter(|&along| 0.0 < along && along < stretch.length()));
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        let step = |pair: &[f64]| {
            let ends = [stretch.at(pair[0]).at, stretch.at(pair[1]).at];
            let middle = 0.5 * (pair[0] + pair[1]);
            let margin = margins.iter().find(|margin| margin.width_at(middle).is_some());
            let width = margin.map_or([0.0; 2], |margin| {
                [pair[0], pair[1]].map(|along| {
                    let [from, to] = margin.span;
                    margin.width_at(along.clamp(from, to)).unwrap_or(0.0)
                })
            });
            Step { ends, edge, from: pair[0], margin, width }
        };
        let steps = breaks.windows(2).map(step);
        steps.filter(|step| unit2(step.ends[1] - step.ends[0]).is_some()).collect()
    }

    fn corner(&self, before: &Step<'_>, after: &Step<'_>) -> Cornered {
        let (Some(arrives), Some(leaves)) =
            (unit2(before.ends[1] - before.ends[0]), unit2(after.ends[1] - after.ends[0]))
        else {
            return Cornered::default();
        };
        let at = after.ends[0];
        let corner = Between { at, arrives, leaves, widths: [before.width[1], after.width[0]] };
        let margins = [before.margin, after.margin];
        let is_one_edge = before.edge == after.edge;
        if is_one_edge && before.margin == after.margin {
            return corner.made(Corner::ByLength);
        }
        // A flange on a closed edge runs on over its beginning, unless that is a corner.
        let edge = &self.stretches[after.edge];
        let runs_on = is_one_edge && after.from == 0.0 && !edge.has_corner_before(edge);
        if let [Some(first), Some(second)] = margins.map(|margin| margin.and_then(Margin::relief)) {
            if runs_on {
                return corner.made(Corner::ByLength);
            }
            return Cornered { added: Vec::new(), removed: corner.parted(first.max(second)) };
        }
        corner.made(style(margins))
    }
}

/// The style of the corner between two strips, of which there may be none.
fn style([first, second]: [Option<&Margin>; 2]) -> Corner {
    let own = |margin: &Margin, is_first: bool| match margin.form {
        MarginForm::Allowance(corner) => corner,
        // Folded back, a hem ends where the next edge does.
        MarginForm::Hem(_) if is_first => Corner::FirstEdgeSymmetry,
        MarginForm::Hem(_) => Corner::SecondEdgeSymmetry,
        MarginForm::Flange { .. } => Corner::ByLength,
    };
    match (first, second) {
        (Some(first), Some(second)) => {
            let is_hem = |margin: &Margin| matches!(margin.form, MarginForm::Hem(_));
            match (is_hem(first), is_hem(second)) {
                (true, true) => Corner::ByLength,
                (true, false) => own(first, true),
                (false, true) => own(second, false),
                (false, false) if first.trim > second.trim => own(first, true),
                (false, false) => own(second, false),
            }
        }
        (Some(first), None) => own(first, true),
        (None, Some(second)) => own(second, false),
        (None, None) => Corner::ByLength,
    }
}

impl Step<'_> {
    /// The trapezoid beyond it.
    fn strip(&self) -> Option<Vec<Point2>> {
        let [from, to] = self.ends;
        let out = -unit2(to - from)?.perp();
        let is_wide = self.width[0].max(self.width[1]) > 0.0;
        is_wide.then(|| vec![from, to, to + out * self.width[1], from + out * self.width[0]])
    }
}

impl Between {
    /// A gap between two flanges at a corner that goes in, along the line in its middle, so that
    /// they don't overlap on the flat. Where the corner sticks out they keep apart already.
    fn parted(&self, gap: f64) -> Vec<Vec<Point2>> {
        let [out, out_next] = [-self.arrives.perp(), -self.leaves.perp()];
        let Some(middle) =
            unit2(out + out_next).filter(|_| self.arrives.perp_dot(self.leaves) < 0.0)
        else {
            return Vec::new();
        };
        let half = 0.5 * gap;
        // The gap opens along both edges until it is as wide as asked, and goes on as wide.
        let across = middle.perp();
        let slope =
            self.leaves.dot(middle).max(1e-6) / self.leaves.perp_dot(middle).abs().max(1e-6);
        let far = 4.0 * (self.widths[0].max(self.widths[1]) + gap) / middle.dot(out).max(0.1);
        let at = |ahead: f64, side: f64| self.at + middle * ahead + across * side;
        let opens = half * slope;
        vec![vec![self.at, at(opens, -half), at(far, -half), at(far, half), at(opens, half)]]
    }
}

/// The lines along which a strip is folded, and the angle of a flange.
pub(super) fn folds(stretch: &Stretch, margin: &Margin) -> (Vec<PatternPath>, Vec<PatternLabel>) {
    let line = stretch.part(margin.span);
    let path = |points: Vec<Point2>, mountain: bool| PatternPath {
        role: Role::Score,
        kind: PathKind::TrimFold { mountain },
        points,
        closed: false,
    };
    match margin.form {
        MarginForm::Allowance(_) => (Vec::new(), Vec::new()),
        MarginForm::Hem(turned) => {
            let mut paths = vec![path(line.clone(), true)];
            if turned > 0.0 {
                paths.push(path(moved_out(&line, turned), true));
            }
            (paths, Vec::new())
        }
        MarginForm::Flange { angle, .. } => {
            let middle = stretch.at(0.5 * (margin.span[0] + margin.span[1]));
            let height_mm = (0.3 * margin.width[0]).clamp(1.5, 6.0);
            let is_upright =
                middle.along.x > 0.0 || (middle.along.x == 0.0 && middle.along.y > 0.0);
            let along: Vec2 = if is_upright { middle.along } else { -middle.along };
            // Between the fold and the cut line, upright.
            let feet = if is_upright { 1.4 } else { 0.4 } * height_mm;
            let label = PatternLabel {
                kind: LabelKind::Trim,
                role: Role::Note,
                at: middle.beside(0.0, feet),
                along,
                height_mm,
                text: format!("up {:.0}°", to_deg(angle)),
            };
            (vec![path(line, false)], vec![label])
        }
    }
}
