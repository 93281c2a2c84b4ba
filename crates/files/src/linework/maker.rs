//! The curves and panels that a drawing becomes, as they are gathered: each curve with a name of
//! its own, each panel too, and what is to be said.

use super::chain::{Chained, chained};
use super::drawn::{Drawn, Tally};
use super::fit::{FitError, Fitted, MAX_POINTS, fitted};
use super::nest::Ring;
use crate::names::{OwnNames, made_for_files, shown};
use crate::reading::InputError;
use crate::table::MAX_CURVES;
use sheetwright::boundary::MAX_SAMPLES;
use sheetwright::design::{DesignCurve, DesignPanel, PanelShape, ReadNote};
use sheetwright::math::Point3;

/// The most panels of a drawing.
const MAX_PANELS: usize = 1000;
/// The most bytes of a name, so that a number fits behind it.
const NAME_BYTES: usize = 80;

/// The curves and panels of a drawing, and what is to be said of it.
pub(super) struct Found {
    pub(super) curves: Vec<DesignCurve>,
    pub(super) panels: Vec<DesignPanel>,
    pub(super) notes: Vec<ReadNote>,
}

#[derive(Default)]
pub(super) struct Maker<'a> {
    pub(super) place: &'a str,
    pub(super) stem: &'a str,
    /// The size of the drawing, mm.
    pub(super) size: f64,
    pub(super) unused: Tally,
    pub(super) notes: Vec<ReadNote>,
    pub(super) gaps: Vec<(f64, Point3)>,
    pub(super) smoothed: Vec<String>,
    pub(super) curves: Vec<DesignCurve>,
    pub(super) taken: OwnNames,
    /// What bounds each panel, with a name for it.
    pub(super) shapes: Vec<(String, PanelShape)>,
    pub(super) points: usize,
}

/// A closed curve, its points and how it lies.
pub(super) struct Closed {
    pub(super) curve: Drawn,
    pub(super) fit: Fitted,
    pub(super) ring: Ring,
}

impl Maker<'_> {
    pub(super) fn error(&self, message: impl Into<String>, hint: impl Into<String>) -> InputError {
        InputError::at(self.place, message, hint)
    }

    pub(super) fn nothing(&self) -> InputError {
        if self.unused.is_empty() {
            let hint = "Draw outlines as closed curves, or two open curves as rails.";
            return self.error("the drawing has no curve", hint);
        }
        let hint = "Texts, pictures, hatches, dimensions and hidden layers bound nothing: draw \
                    outlines as curves on a layer that is shown.";
        self.error("the drawing has no curve that can bound a panel", hint)
    }

    pub(super) fn chained(
        &mut self,
        curves: Vec<Drawn>,
        group: impl Fn(&Drawn) -> String,
    ) -> Chained {
        let mut chained = chained(curves, self.size, group);
        self.gaps.append(&mut chained.gaps);
        chained
    }

    /// Keeps a closed curve, an outline of a plane drawing counter-clockwise; returns its name.
    pub(super) fn keep(&mut self, closed: &Closed) -> Result<String, InputError> {
        let mut fit = closed.fit.clone();
        if closed.ring.is_clockwise() {
            // The point that it begins at stays.
            fit.points[1..].reverse();
        }
        self.add(&closed.curve, fit)
    }

    pub(super) fn curve(&mut self, curve: &Drawn, smooth: bool) -> Result<String, InputError> {
        let fit = fitted(curve, smooth).map_err(|error| self.unfit(curve, &error))?;
        self.add(curve, fit)
    }

    pub(super) fn add(&mut self, curve: &Drawn, fit: Fitted) -> Result<String, InputError> {
        self.points += fit.points.len();
        if self.points > MAX_SAMPLES {
            return Err(self.too_many_points());
        }
        if self.curves.len() == MAX_CURVES {
            return Err(self.too_many_curves());
        }
        let Fitted { kind, closed, points, smoothed } = fit;
        let wanted = curve_name(curve.name());
        let name = self.taken.take(&wanted, ' ');
        if smoothed {
            self.smoothed.push(name.clone());
        }
        self.curves.push(DesignCurve { name: name.clone(), kind: Some(kind), closed, points });
        Ok(name)
    }

    pub(super) fn too_many_points(&self) -> InputError {
        let message = format!("the curves of the drawing take more than {MAX_SAMPLES} points");
        self.error(message, "Divide the drawing, or simplify its curves.")
    }

    pub(super) fn too_many_curves(&self) -> InputError {
        let message = format!("the drawing has more than {MAX_CURVES} closed curves");
        self.error(message, "Divide it, or hide what bounds no panel.")
    }

    pub(super) fn unfit(&self, curve: &Drawn, error: &FitError) -> InputError {
        let name = shown(curve.name());
        match error {
            FitError::Nothing => {
                self.error(format!("the curve {name} has no length"), "Remove it.")
            }
            FitError::TooManyPoints => {
                let message = format!("the curve {name} takes more than {MAX_POINTS} points");
                self.error(message, "Simplify it; a few hundred points are enough for a curve.")
            }
            FitError::Curve(error) => {
                let at = curve.start().map_or_else(String::new, place_of);
                let message = format!("the curve {name}, which begins at {at}, {error}");
                self.error(message, "Check the units and the numbers of the drawing.")
            }
        }
    }

    pub(super) fn finished(self) -> Result<Found, InputError> {
        let Self { place, stem, shapes, curves, mut notes, unused, gaps, smoothed, .. } = self;
        if shapes.len() > MAX_PANELS {
            let message = format!("the drawing has more than {MAX_PANELS} outlines");
            let hint = "Each outline is a panel: divide the drawing.";
            return Err(InputError::at(place, message, hint));
        }
        let is_one = shapes.len() == 1;
        let mut taken = OwnNames::default();
        let mut panels = Vec::with_capacity(shapes.len());
        for (own, shape) in shapes {
            let first = made_for_files(if is_one { stem } else { &own }, NAME_BYTES);
            let first = if first.is_empty() { "panel".to_owned() } else { first };
            panels.push(DesignPanel::usual(taken.take(&first, ' '), shape));
        }
        let widest = gaps.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((widest_mm, at)) = widest {
            notes.push(ReadNote::GapsClosed { count: gaps.len(), widest_mm, at });
        }
        if !smoothed.is_empty() {
            notes.push(ReadNote::Smoothed { names: smoothed });
        }
        notes.extend(unused.notes());
        Ok(Found { curves, panels, notes })
    }
}

/// A name that a curve of a design may have.
pub(super) fn curve_name(name: &str) -> String {
    let made = made_for_files(name.trim_start_matches(['-', ' ']), NAME_BYTES);
    if made.is_empty() { "curve".to_owned() } else { made }
}

pub(super) fn place_of(p: Point3) -> String {
    let number = |c: f64| format!("{:.2}", c + 0.0);
    if p.z == 0.0 {
        return format!("({}, {}) mm", number(p.x), number(p.y));
    }
    format!("({}, {}, {}) mm", number(p.x), number(p.y), number(p.z))
}

/// A curve by its name and its ends, for a message.
pub(super) fn ends_of(curve: &Drawn) -> String {
    let [start, end] = [curve.start(), curve.end()].map(|p| p.map_or_else(String::new, place_of));
    format!("{} runs from {start} to {end}", shown(curve.name()))
}
