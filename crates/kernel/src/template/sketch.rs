//! What templates draw with: named curves and panels, and curves through points of a formula that
//! lie on it to far below what a hand can cut.

use super::TemplateError;
use crate::boundary::PlaneChoice;
use crate::cost::DEFAULT_FOLD;
use crate::curve::{CurveKind, CurvePoint};
use crate::design::{CurveUse, Design, DesignCurve, DesignPanel, PanelMethod, PanelShape};
use crate::material::Material;
use crate::math::Point3;

/// Curves and panels as they are drawn.
#[derive(Debug, Default)]
pub(super) struct Sketch {
    curves: Vec<DesignCurve>,
    panels: Vec<DesignPanel>,
    /// What it is usually made of.
    material: Option<&'static Material>,
}

impl Sketch {
    /// Names the sheet that it is made of unless another one is asked for.
    pub(super) fn sheet(&mut self, name: &str) {
        self.material = Material::named(name);
    }

    /// A curve that runs straight from point to point.
    pub(super) fn polyline(&mut self, name: impl Into<String>, points: &[Point3]) {
        self.curve(name, CurveKind::Polyline, points);
    }

    /// A smooth curve through points.
    pub(super) fn spline(&mut self, name: impl Into<String>, points: &[Point3]) {
        self.curve(name, CurveKind::Spline, points);
    }

    /// A smooth open curve along `at` from 0 to 1, which moves about evenly and turns by `turn`
    /// radians in all.
    pub(super) fn along(&mut self, name: impl Into<String>, turn: f64, at: impl Fn(f64) -> Point3) {
        let points: Vec<Point3> = stations(turn).into_iter().map(at).collect();
        self.spline(name, &points);
    }

    /// A smooth curve that control points draw to themselves.
    pub(super) fn bspline(&mut self, name: impl Into<String>, points: &[Point3]) {
        self.curve(name, CurveKind::BSpline, points);
    }

    fn curve(&mut self, name: impl Into<String>, kind: CurveKind, points: &[Point3]) {
        let points = points.iter().map(|&at| CurvePoint::smooth(at)).collect();
        self.curves.push(DesignCurve {
            name: name.into(),
            kind: Some(kind),
            closed: false,
            points,
        });
    }

    /// A panel between two rails, which may bend by more than half a turn: no plane supports it.
    pub(super) fn strip(&mut self, name: impl Into<String>, rails: [&str; 2], samples: usize) {
        let shape = PanelShape::Rails(rails.map(used));
        self.panel(name, shape, samples, PanelMethod::Rails, PlaneChoice::None);
    }

    /// A panel within a loop of curves; `-name` is run backwards.
    pub(super) fn patch(&mut self, name: impl Into<String>, outer: &[&str], samples: usize) {
        let outer = outer.iter().copied().map(used).collect();
        let shape = PanelShape::Loops { outer, holes: Vec::new() };
        self.panel(name, shape, samples, PanelMethod::Optimal, PlaneChoice::Auto);
    }

    fn panel(
        &mut self,
        name: impl Into<String>,
        shape: PanelShape,
        samples: usize,
        method: PanelMethod,
        plane: PlaneChoice,
    ) {
        let fold = DEFAULT_FOLD;
        self.panels.push(DesignPanel { name: name.into(), shape, samples, method, plane, fold });
    }

    /// The design, of this material or else of the usual one.
    pub(super) fn design(self, name: &str, material: Option<&'static Material>) -> Design {
        let material = material.or(self.material);
        Design { name: name.to_owned(), material, curves: self.curves, panels: self.panels }
    }
}

/// How a template ends that has drawn everything.
pub(super) type Drawn = Result<Sketch, TemplateError>;

fn used(name: &str) -> CurveUse {
    match name.strip_prefix('-') {
        Some(name) => CurveUse { name: name.to_owned(), reversed: true },
        None => CurveUse { name: name.to_owned(), reversed: false },
    }
}

/// Points of a curve are at most so far apart, radians of its turning (5°): a spline through points
/// of a circle then lies within 10⁻⁷ of its radius.
const STEP: f64 = 0.0873;
/// How often the step is halved towards the ends. A natural spline is straight at its ends, where
/// these curves are not, and so comes off by the square of its last step and turns off by the last
/// step itself: 64 times smaller, that is 2·10⁻⁶ of the radius and 0.02°.
const HALVINGS: u32 = 6;

/// Where points of a curve lie that turns by `turn` radians: from 0 to 1, closer towards the ends.
pub(super) fn stations(turn: f64) -> Vec<f64> {
    let steps = ((turn / STEP).ceil() as usize).max(8);
    let step = 1.0 / steps as f64;
    let mut near: Vec<f64> = (1..=HALVINGS).rev().map(|n| step / f64::from(1 << n)).collect();
    let far: Vec<f64> = near.iter().rev().map(|t| 1.0 - t).collect();
    near.insert(0, 0.0);
    near.extend((1..steps).map(|n| n as f64 * step));
    near.extend(far);
    near.push(1.0);
    near
}
