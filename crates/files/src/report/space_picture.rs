//! The surface in space: shaded triangles, rulings and the boundary.

use super::canvas::{Anchor, Picture, WIDTH, line, round_below, scale_bar, text};
use super::paint::paint;
use super::part::Part;
use super::view::{View, view_of};
use super::wording::{length_short, thinned};
use super::worst_rung;
use sheetwright::design::{Made, MadePanel};
use sheetwright::material::{Material, warp_limit_deg};
use sheetwright::math::{Point2, Vec2, Vec3, from_deg};

/// Room round the surface, and below it for the axes and the scale.
const MARGIN: f64 = 16.0;
const FOOT: f64 = 96.0;
/// The surface is drawn no higher than this.
const MOST_HEIGHT: f64 = 330.0;
/// Rulings drawn on a panel, at the most.
const RULINGS: usize = 60;

/// The surface of a panel in space, shaded, with rulings; those that warp more than the sheet takes
/// stand out.
pub fn surface_picture(panel: &MadePanel, material: Option<&Material>) -> Picture {
    let title = format!("{} in space", panel.name);
    pictured(std::slice::from_ref(panel), material, title)
}

/// The surfaces of all panels of a design, as they lie in space.
pub fn design_picture(made: &Made) -> Picture {
    pictured(&made.panels, made.material, format!("{} in space", made.name))
}

fn pictured(panels: &[MadePanel], material: Option<&Material>, title: String) -> Picture {
    let view = view_of(panels);
    let projected: Vec<Vec<Point2>> = panels
        .iter()
        .map(|panel| panel.surface.positions().iter().map(|&p| view.project(p)).collect())
        .collect();
    let fit = Fit::new(projected.iter().flatten());
    let parts: Vec<Part<'_>> = panels
        .iter()
        .zip(&projected)
        .map(|(panel, points)| Part {
            panel,
            points: points.iter().map(|p| fit.place(*p)).collect(),
            rungs: rung_classes(panel, material, RULINGS),
        })
        .collect();
    let mut body = paint(&view, &parts);
    body += &fit.foot(&view);
    Picture::new(WIDTH, fit.total, title, body)
}

/// Where projected points lie in a picture that shows all of them, with the axes and the scale below.
pub(super) struct Fit {
    left: f64,
    high: f64,
    scale: f64,
    shift: f64,
    /// The height of the picture.
    pub(super) total: f64,
}

impl Fit {
    pub(super) fn new<'a>(projected: impl Iterator<Item = &'a Point2>) -> Self {
        let start = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        let [[left, right], [low, high]] = projected.fold(start, |bounds, p| {
            [(bounds[0], p.x), (bounds[1], p.y)]
                .map(|([least, most], x)| [least.min(x), most.max(x)])
        });
        // A plate that is seen edge on still has a scale.
        let (width, height) = ((right - left).max(1e-12), (high - low).max(1e-12));
        let scale = ((WIDTH - 2.0 * MARGIN) / width).min(MOST_HEIGHT / height);
        let shift = 0.5 * (WIDTH - scale * width);
        Self { left, high, scale, shift, total: MARGIN + scale * height + FOOT }
    }

    pub(super) fn place(&self, p: Point2) -> Point2 {
        Point2::new(
            self.shift + self.scale * (p.x - self.left),
            MARGIN + self.scale * (self.high - p.y),
        )
    }

    /// A length in the picture, in space, mm.
    pub(super) fn millimetres(&self, length: f64) -> f64 {
        length / self.scale
    }

    /// The axes and the scale.
    pub(super) fn foot(&self, view: &View) -> String {
        let bar = round_below(0.3 * WIDTH / self.scale);
        let right = Point2::new(WIDTH - MARGIN, self.total - 14.0);
        triad(view, Point2::new(46.0, self.total - 42.0))
            + &scale_bar(right, self.scale * bar, &length_short(bar))
    }
}

/// The class of every rung that is drawn: `w` the worst if it is beyond the limit, `x` beyond it,
/// `r` any other. At the most about `most` of each.
pub(super) fn rung_classes(
    panel: &MadePanel,
    material: Option<&Material>,
    most: usize,
) -> Vec<Option<&'static str>> {
    let limit = from_deg(warp_limit_deg(material));
    let rungs = &panel.measures.rungs;
    let worst = worst_rung(&panel.measures).filter(|&n| rungs[n].warp_beyond_sampling() > limit);
    let mut classes = vec![None; rungs.len()];
    let (beyond, within): (Vec<usize>, Vec<usize>) =
        (0..rungs.len()).partition(|&n| rungs[n].warp_beyond_sampling() > limit);
    for (list, class) in [(within, "r"), (beyond, "x")] {
        for n in thinned(&list, most) {
            classes[n] = Some(class);
        }
    }
    if let Some(worst) = worst {
        classes[worst] = Some("w");
    }
    classes
}

/// Where x, y and z point.
fn triad(view: &View, at: Point2) -> String {
    const ARM: f64 = 26.0;
    const NAME_AWAY: f64 = 10.0;
    let mut body = String::new();
    let mut drawn: Vec<Vec2> = Vec::new();
    let mut axes = [(Vec3::X, "x"), (Vec3::Y, "y"), (Vec3::Z, "z")]
        .map(|(axis, name)| (view.direction(axis).to_vec(), name));
    // The long arms first: a short one makes way for them.
    axes.sort_by(|a, b| b.0.length().total_cmp(&a.0.length()).then(a.1.cmp(b.1)));
    for (way, name) in axes {
        // An axis that points at the eye is a dot, whose name would lie on those of the others.
        if way.length() < 0.2 {
            continue;
        }
        let end = Point2::new(at.x + ARM * way.x, at.y - ARM * way.y);
        body += &line("axis", &[at, end]);
        let along = way / way.length();
        let hidden = drawn.iter().any(|d| d.dot(along) > 0.0 && d.perp_dot(along).abs() < 0.4);
        // Beside the arm where another arm runs on the same way.
        let away = NAME_AWAY * if hidden { along.perp() } else { along };
        let name_at = Point2::new(end.x + away.x, end.y - away.y + 4.0);
        body += &text("", Anchor::Middle, name_at, name);
        drawn.push(along);
    }
    body
}
