//! The drawing tools of templates: named curves and panels, and curves through points of a formula,
//! which they match far more closely than a hand can cut.

use super::TemplateError;
use crate::design::{
    Axis, CurveUse, Design, DesignCurve, DesignPanel, Join, Mark, MarkKind, MarkOn, PanelMethod,
    PanelShape, StationPlaces, StationPlane,
};
use sheetwright_geometry::boundary::PlaneChoice;
use sheetwright_geometry::curve::{CurveKind, CurvePoint};
use sheetwright_geometry::math::Point3;
use sheetwright_optimum::cost::DEFAULT_FOLD;

/// Curves and panels as they are drawn.
#[derive(Debug, Default)]
pub(super) struct Sketch {
    curves: Vec<DesignCurve>,
    panels: Vec<DesignPanel>,
    marks: Vec<Mark>,
}

/// The result of a template's function.
pub(super) type Drawn = Result<Sketch, TemplateError>;

/// A smooth part of a curve: its total turn, radians, and its points over 0 ..= 1.
pub(super) struct SmoothPart<'a> {
    pub(super) turn: f64,
    pub(super) at: &'a dyn Fn(f64) -> Point3,
}

impl Sketch {
    /// A curve that runs straight from point to point.
    pub(super) fn polyline(&mut self, name: impl Into<String>, points: &[Point3]) {
        let points = points.iter().map(|&at| CurvePoint::smooth(at)).collect();
        self.curve(name, CurveKind::Polyline, points);
    }

    /// A smooth curve through points.
    pub(super) fn spline(&mut self, name: impl Into<String>, points: &[Point3]) {
        let points = points.iter().map(|&at| CurvePoint::smooth(at)).collect();
        self.curve(name, CurveKind::Spline, points);
    }

    /// A smooth open curve along `at` from 0 to 1, which has about constant speed and turns by
    /// `turn` radians in all.
    pub(super) fn along(&mut self, name: impl Into<String>, turn: f64, at: impl Fn(f64) -> Point3) {
        self.jointed(name, &[SmoothPart { turn, at: &at }]);
    }

    /// A smooth curve through points that may be corners.
    pub(super) fn through(&mut self, name: impl Into<String>, points: Vec<CurvePoint>) {
        self.curve(name, CurveKind::Spline, points);
    }

    /// A smooth curve by control points.
    pub(super) fn bspline(&mut self, name: impl Into<String>, points: &[Point3]) {
        let points = points.iter().map(|&at| CurvePoint::smooth(at)).collect();
        self.curve(name, CurveKind::BSpline, points);
    }

    /// An open curve of smooth parts, with a corner wherever two meet.
    pub(super) fn jointed(&mut self, name: impl Into<String>, parts: &[SmoothPart<'_>]) {
        let mut points: Vec<CurvePoint> = Vec::new();
        for part in parts {
            let mut stations = stations(part.turn).into_iter();
            if let Some(joint) = points.last_mut() {
                joint.corner = true;
                stations.next();
            }
            points.extend(stations.map(|t| CurvePoint::smooth((part.at)(t))));
        }
        self.curve(name, CurveKind::Spline, points);
    }

    fn curve(&mut self, name: impl Into<String>, kind: CurveKind, points: Vec<CurvePoint>) {
        self.curves.push(DesignCurve {
            name: name.into(),
            kind: Some(kind),
            closed: false,
            points,
        });
    }

    /// Stations across x on all panels.
    pub(super) fn stations(&mut self, places: &[f64]) {
        let planes = places.iter().map(|&at| StationPlane { at, name: None }).collect();
        let kind = MarkKind::Stations { axis: Axis::X, at: StationPlaces::Listed { planes } };
        self.marks.push(Mark { on: vec![MarkOn::All], kind });
    }

    /// A panel between two rails, whose every rung joins the two. It needs no supporting plane: the
    /// order of the rails is enough, and a sheet rolled round a pipe has none.
    pub(super) fn strip(&mut self, name: impl Into<String>, rails: [&str; 2], samples: usize) {
        let shape = PanelShape::Rails(rails.map(used));
        self.panel(name, shape, samples, PanelMethod::Rails, PlaneChoice::None);
    }

    /// A panel between two lines that were not drawn as rails of a strip: all rungs are admitted.
    pub(super) fn plank(&mut self, name: impl Into<String>, rails: [&str; 2], samples: usize) {
        let shape = PanelShape::Rails(rails.map(used));
        self.panel(name, shape, samples, PanelMethod::Optimal, PlaneChoice::Auto);
    }

    /// Has these panels, which were drawn to one side of the plane y = 0, cut twice, once turned
    /// over: for both halves.
    pub(super) fn cut_twice(&mut self, panels: &[&str]) {
        for panel in self.panels.iter_mut().filter(|panel| panels.contains(&&panel.name[..])) {
            (panel.count, panel.mirrored) = (2, 1);
        }
    }

    /// A panel within a loop of curves; `-name` is run backwards.
    pub(super) fn patch(&mut self, name: impl Into<String>, outer: &[&str], samples: usize) {
        let outer = outer.iter().copied().map(used).collect();
        let shape = PanelShape::Loops { outer, holes: Vec::new() };
        self.panel(name, shape, samples, PanelMethod::Optimal, PlaneChoice::Auto);
    }

    /// Adds the starboard halves of these panels, which were drawn to port of the plane y = 0:
    /// `NAME` becomes `NAME-port` and `NAME-starboard`. They share the curves that lie in the
    /// plane.
    pub(super) fn mirror(&mut self, panels: &[&str]) {
        for mut panel in std::mem::take(&mut self.panels) {
            if !panels.contains(&&panel.name[..]) {
                self.panels.push(panel);
                continue;
            }
            let name = panel.name.clone();
            panel.name = format!("{name}-port");
            let shape = match &panel.shape {
                PanelShape::Rails([first, second]) => {
                    PanelShape::Rails([self.starboard(second), self.starboard(first)])
                }
                // Seen in a mirror, a loop runs the other way round.
                PanelShape::Loops { outer, holes } => {
                    let mut back = |part: &CurveUse| {
                        let part = self.starboard(part);
                        CurveUse { reversed: !part.reversed, ..part }
                    };
                    let outer = outer.iter().rev().map(&mut back).collect();
                    let mut hole =
                        |hole: &Vec<CurveUse>| hole.iter().rev().map(&mut back).collect();
                    PanelShape::Loops { outer, holes: holes.iter().map(&mut hole).collect() }
                }
                PanelShape::Join(join) => {
                    let parts = join.parts.iter().map(|part| format!("{part}-starboard"));
                    PanelShape::Join(Join { parts: parts.collect(), ..join.clone() })
                }
                // Templates draw curves.
                PanelShape::Mesh(mesh) => PanelShape::Mesh(mesh.clone()),
            };
            let starboard =
                DesignPanel { name: format!("{name}-starboard"), shape, ..panel.clone() };
            self.panels.extend([panel, starboard]);
        }
    }

    /// A use of the image of a curve to starboard.
    fn starboard(&mut self, part: &CurveUse) -> CurveUse {
        CurveUse { name: self.image(&part.name), reversed: part.reversed }
    }

    /// The name of the image of a curve to starboard, which is drawn unless it exists; that of the
    /// curve itself if it lies in the plane y = 0.
    pub(super) fn image(&mut self, of: &str) -> String {
        let Some(curve) = self.curves.iter().find(|curve| curve.name == of) else {
            return of.to_owned();
        };
        if curve.points.iter().all(|point| point.at.y == 0.0) {
            return of.to_owned();
        }
        let name = format!("{of}-starboard");
        if !self.curves.iter().any(|curve| curve.name == name) {
            let mut image = curve.clone();
            image.name.clone_from(&name);
            image.points.iter_mut().for_each(|point| point.at = mirrored(point.at));
            self.curves.push(image);
        }
        name
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
        let cut = Vec::new();
        self.panels.push(DesignPanel {
            method,
            plane,
            fold,
            cut,
            ..DesignPanel::new(name, shape, samples)
        });
    }

    /// The design.
    pub(super) fn design(self, name: &str) -> Design {
        let Self { curves, panels, marks } = self;
        Design { name: name.to_owned(), curves, panels, marks, ..Design::default() }
    }
}

/// The mirror image of a point in the plane y = 0.
pub(super) fn mirrored(point: Point3) -> Point3 {
    // Not -y, which would make -0 of a point in the plane.
    Point3::new(point.x, 0.0 - point.y, point.z)
}

fn used(name: &str) -> CurveUse {
    match name.strip_prefix('-') {
        Some(name) => CurveUse { name: name.to_owned(), reversed: true },
        None => CurveUse { name: name.to_owned(), reversed: false },
    }
}

/// The name of one of several pieces; a single one needs no number.
pub(super) fn numbered(name: &str, piece: usize, pieces: usize) -> String {
    if pieces == 1 { name.to_owned() } else { format!("{name}-{}", piece + 1) }
}

/// Largest turn of a curve between two of its points, radians (5°): a spline through points of a
/// circle then lies within 10⁻⁶ of its radius.
const STEP: f64 = 0.0873;
/// Least number of steps of a curve, however little it turns.
const FEWEST_STEPS: usize = 8;
/// How often the step is halved towards the ends. A natural spline is straight at its ends, where
/// these curves are not, and deviates there in proportion to its last step: 64 times shorter, that
/// is 0.02°.
const HALVINGS: u32 = 6;

/// The parameters of the points of a curve that turns by `turn` radians: from 0 to 1, closer
/// towards the ends.
pub(super) fn stations(turn: f64) -> Vec<f64> {
    let steps = ((turn.abs() / STEP).ceil() as usize).max(FEWEST_STEPS);
    let step = 1.0 / steps as f64;
    let near: Vec<f64> = (1..=HALVINGS).rev().map(|n| step / f64::from(1 << n)).collect();
    let far: Vec<f64> = near.iter().rev().map(|t| 1.0 - t).collect();
    let even = (1..steps).map(|n| n as f64 * step);
    std::iter::once(0.0).chain(near).chain(even).chain(far).chain([1.0]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_geometry::curve::Curve;
    use sheetwright_geometry::math::{angle_between, atan2, cos, sin};

    #[test]
    fn a_spline_through_the_stations_is_the_circle() {
        for turn in [0.1, 1.0, 3.0, std::f64::consts::TAU] {
            let on = |t: f64| Point3::new(cos(turn * t), sin(turn * t), 0.0);
            let points: Vec<CurvePoint> =
                stations(turn).into_iter().map(|t| CurvePoint::smooth(on(t))).collect();
            let curve = Curve::new(CurveKind::Spline, &points, false).unwrap();
            let mut off: f64 = 0.0;
            let mut aslant: f64 = 0.0;
            for n in 0..=10_000 {
                let u = curve.spans().len() as f64 * f64::from(n) / 10_000.0;
                let (p, d) = (curve.position(u), curve.derivative(u));
                off = off.max((p.to_vec().length() - 1.0).abs());
                let at = atan2(p.y, p.x);
                let along = sheetwright_geometry::math::Vec3::new(-sin(at), cos(at), 0.0);
                aslant = aslant.max(angle_between(d, along).to_degrees());
            }
            assert!(off < 1e-6 && aslant < 0.03, "{turn}: {off:e} {aslant}");
        }
    }
}
