//! What is done along edges after a part was laid flat: allowances, hems, flanges, tabs, holes,
//! notches, ticks and joints.
//!
//! 1. `chosen` finds the edges that each trim of a design stands on. Of trims that move the cut
//!    line, the last one on a span of an edge holds.
//! 2. `margin` makes strips beyond the net line, with the corners that `corner` constructs.
//! 3. What stands on joined edges is placed once, at shares of the length that both have in common
//!    (`edge::shared`), and made on both: `tabs` on one side of each joint, `joints`, `holes` and
//!    `notches`.
//! 4. `cut` takes the union of the net and all that is added, without what is taken away, in exact
//!    arithmetic, and proves that the net lies inside.
//!
//! The net line is kept beside the cut line. The idea that one trait of an edge draws both halves
//! of a joint is that of boxes.py; that seams are placed at equal shares of both edges is that of
//! GarmentCode \[KorostelevaSorkine2023\].

mod chosen;
mod corner;
mod cut;
mod fault;
mod flange;
mod holes;
mod joints;
mod margin;
mod notches;
mod paired;
mod part;
mod places;
mod reach;
mod stretch;
mod tabs;

#[cfg(test)]
mod tests;

pub use cut::TrimNote;
pub use fault::TrimFault;

pub(crate) use cut::Trimmed;
pub(crate) use holes::drilled;
pub(crate) use part::TrimPart;
pub(crate) use reach::beyond;

use crate::design::{Flange, Trim, TrimKind};
use crate::edge::EdgePlace;
use chosen::chosen;
use cut::Making;
use flange::{Rim, rim};
use margin::{Bordered, Margin, MarginForm, folds};
use paired::{Pair, pairs};
use sheetwright_geometry::math::Point2;
use sheetwright_geometry::region::MOST_MM;
use stretch::Stretch;

/// A flange is shortened by no more than this share of its length at a corner.
const MOST_RELIEF: f64 = 0.25;

/// A fault, with the number of the part that it is about.
pub(crate) type Faulted = (Option<usize>, TrimFault);

/// The trims of some parts, in their order.
///
/// # Errors
/// The first trim that can't be made.
pub(crate) fn trimmed(parts: &[TrimPart<'_>], trims: &[Trim]) -> Result<Vec<Trimmed>, Faulted> {
    let mut work = Work::new(parts, trims)?;
    work.check_sizes()?;
    work.add_margins()?;
    work.join()?;
    work.mark()?;
    work.cut()
}

/// The trims that move the cut line of an edge: the number of each, and its span.
type Moving = Vec<(usize, [f64; 2])>;

/// Parts while they are trimmed.
struct Work<'a> {
    parts: &'a [TrimPart<'a>],
    trims: &'a [Trim],
    /// The edges that each trim stands on, and whether they were named.
    on: Vec<Vec<(EdgePlace, bool)>>,
    /// The edges of each part on its pattern.
    stretches: Vec<Vec<Stretch>>,
    /// The net lines of each part.
    nets: Vec<Vec<Vec<Point2>>>,
    /// What moves the cut line of each edge of each part.
    moving: Vec<Vec<Moving>>,
    /// The strips along each edge of each part.
    margins: Vec<Vec<Vec<Margin>>>,
    made: Vec<Making>,
}

impl<'a> Work<'a> {
    fn new(parts: &'a [TrimPart<'a>], trims: &'a [Trim]) -> Result<Self, Faulted> {
        let on = trims.iter().map(|trim| chosen(parts, &trim.on));
        let on: Vec<Vec<(EdgePlace, bool)>> =
            on.collect::<Result<_, _>>().map_err(|fault| (None, fault))?;
        let moving = parts.iter().map(|part| vec![Moving::new(); part.edges.len()]).collect();
        let mut work = Self {
            parts,
            trims,
            on,
            stretches: parts.iter().map(TrimPart::stretches).collect(),
            nets: parts.iter().map(TrimPart::net).collect(),
            moving,
            margins: parts.iter().map(|part| vec![Vec::new(); part.edges.len()]).collect(),
            made: parts.iter().map(|_| Making::default()).collect(),
        };
        for (number, trim) in trims.iter().enumerate().filter(|(_, trim)| trim.kind.moves_the_cut())
        {
            work.claim(number, trim)?;
        }
        Ok(work)
    }

    /// Strips, which are no wider than their part, reach no farther than its size again.
    fn check_sizes(&self) -> Result<(), Faulted> {
        for (part, net) in self.nets.iter().enumerate() {
            let reaches = |p: &Point2| p.x.abs().max(p.y.abs());
            let most_mm = net.iter().flatten().map(reaches).fold(0.0, f64::max);
            if 4.0 * most_mm > MOST_MM {
                return Err((Some(part), TrimFault::TooLarge { most_mm }));
            }
        }
        Ok(())
    }

    /// Notes that a trim moves the cut line of its edges, in place of those before it. What joins
    /// two edges claims both.
    fn claim(&mut self, number: usize, trim: &Trim) -> Result<(), Faulted> {
        let joins = is_joint(&trim.kind);
        for &(place, is_named) in &self.on[number] {
            let edge = &self.parts[place.part].edges[place.edge];
            if joins && edge.mates.is_empty() {
                if is_named {
                    let (what, edge) = (trim.kind.name(), self.parts[place.part].called(edge));
                    return Err((Some(place.part), TrimFault::NoMate { what, edge }));
                }
                continue;
            }
            let mates = edge.mates.iter().copied().filter(|_| joins);
            for place in std::iter::once(place).chain(mates) {
                let moving = &mut self.moving[place.part][place.edge];
                let span = if joins { [0.0, 1.0] } else { trim.span };
                moving.retain(|(_, [from, to])| *to <= span[0] || span[1] <= *from);
                moving.push((number, span));
            }
        }
        Ok(())
    }

    /// The strips of allowances, hems and flanges.
    fn add_margins(&mut self) -> Result<(), Faulted> {
        for (part, of_part) in self.parts.iter().enumerate() {
            for (edge, moving) in self.moving[part].iter().enumerate() {
                for &(trim, span) in moving {
                    let Some((width, form)) = strip(&self.trims[trim].kind) else { continue };
                    let width_mm = width[0].max(width[1]);
                    let part_mm = of_part.shorter_mm();
                    if width_mm > part_mm {
                        let what = self.trims[trim].kind.name();
                        let edge = of_part.called(&of_part.edges[edge]);
                        let fault = TrimFault::TooWide { what, edge, width_mm, part_mm };
                        return Err((Some(part), fault));
                    }
                    let length = self.stretches[part][edge].length();
                    let span = span.map(|share| share * length);
                    self.margins[part][edge].push(Margin { span, width, trim, form });
                }
            }
        }
        for (part, of_part) in self.parts.iter().enumerate() {
            let loops = of_part.loops();
            for (stretch, margins) in self.stretches[part].iter().zip(&mut self.margins[part]) {
                let corners: Vec<f64> = stretch.corners().iter().map(|&(at, _)| at).collect();
                *margins = margins.iter().flat_map(|margin| margin.divided(&corners)).collect();
            }
            self.set_back_flanges(part, &loops);
            let bordered = Bordered {
                stretches: &self.stretches[part],
                loops: &loops,
                margins: &self.margins[part],
            };
            let strips = bordered.made();
            let made = &mut self.made[part];
            made.added.extend(strips.added);
            made.removed.extend(strips.removed);
            for number in 0..of_part.edges.len() {
                let stretch = &self.stretches[part][number];
                let rims = self.margins[part][number].iter().filter_map(|m| rim(stretch, m));
                let worst = rims.max_by(|a, b| a.strain().abs().total_cmp(&b.strain().abs()));
                if let Some(Rim { flat_mm, bent_mm }) = worst.filter(Rim::is_strained) {
                    let edge = of_part.shown(number);
                    made.notes.push(TrimNote::FlangeStretches { edge, flat_mm, bent_mm });
                }
            }
            for (stretch, margins) in self.stretches[part].iter().zip(&self.margins[part]) {
                for margin in margins {
                    let (paths, labels) = folds(stretch, margin);
                    made.paths.extend(paths);
                    made.labels.extend(labels);
                }
            }
        }
        Ok(())
    }

    /// Where two flanges meet at a corner, both end a little before it.
    fn set_back_flanges(&mut self, part: usize, loops: &[Vec<usize>]) {
        // The flange that has its end 1, or its beginning 0, there.
        let of_flange = |margins: &[Margin], at: f64, end: usize| {
            margins.iter().position(|m| m.relief().is_some() && m.span[end] == at)
        };
        let mut moved: Vec<(usize, usize, usize)> = Vec::new();
        for edges in loops {
            for (n, &after) in edges.iter().enumerate() {
                let before = edges[(n + edges.len() - 1) % edges.len()];
                let length = self.stretches[part][before].length();
                let of_before = of_flange(&self.margins[part][before], length, 1);
                let of_after = of_flange(&self.margins[part][after], 0.0, 0);
                // Where the corner goes in, they part along its middle (`margin`).
                let ends = [(before, length), (after, 0.0)];
                let [arrives, leaves] =
                    ends.map(|(edge, at)| self.stretches[part][edge].at(at).along);
                let stretches = &self.stretches[part];
                let has_corner = stretches[before].has_corner_before(&stretches[after]);
                // An edge that turns in space alone may run straight on the pattern.
                let sine = arrives.perp_dot(leaves);
                let sticks_out = match before == after {
                    true => has_corner && sine >= 0.0,
                    false => sine > 0.0 || (has_corner && sine == 0.0),
                };
                if let (Some(first), Some(second), true) = (of_before, of_after, sticks_out) {
                    moved.extend([(before, first, 1), (after, second, 0)]);
                }
                let margins = &self.margins[part][after];
                for (at, sine) in self.stretches[part][after].corners() {
                    let flanges = (of_flange(margins, at, 1), of_flange(margins, at, 0));
                    if let (Some(first), Some(second), true) = (flanges.0, flanges.1, sine >= 0.0) {
                        moved.extend([(after, first, 1), (after, second, 0)]);
                    }
                }
            }
        }
        for (edge, margin, end) in moved {
            let margin = &mut self.margins[part][edge][margin];
            let [from, to] = margin.span;
            let by = margin.relief().unwrap_or(0.0).min(MOST_RELIEF * (to - from));
            margin.span[end] += if end == 0 { by } else { -by };
        }
    }

    /// The pairs of edges on which a trim is made once for both, and the edges that it stands on
    /// alone.
    fn pairs(&self, trim: usize) -> Vec<Pair> {
        pairs(self.parts, &self.on[trim])
    }

    fn cut(self) -> Result<Vec<Trimmed>, Faulted> {
        let made = self.made.into_iter().zip(&self.nets).enumerate();
        made.map(|(part, (made, net))| made.cut(net).map_err(|fault| (Some(part), fault))).collect()
    }
}

/// Whether it joins two edges.
fn is_joint(kind: &TrimKind) -> bool {
    use TrimKind::{Fingers, Puzzle, Slots, Tabs};
    matches!(kind, Tabs(_) | Fingers(_) | Puzzle(_) | Slots(_))
}

/// The strip of a trim: its widths, mm, and its form.
fn strip(kind: &TrimKind) -> Option<([f64; 2], MarginForm)> {
    match *kind {
        TrimKind::Allowance(allowance) => {
            Some((allowance.width, MarginForm::Allowance(allowance.corner)))
        }
        TrimKind::Hem(hem) => {
            let fold = if hem.turn > 0.0 { hem.width } else { 0.0 };
            Some(([hem.width + hem.turn; 2], MarginForm::Hem(fold)))
        }
        TrimKind::Flange(Flange { width, angle, relief }) => {
            Some(([width; 2], MarginForm::Flange { angle, relief }))
        }
        _ => None,
    }
}
