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
    let bound = |of: fn(&Point2) -> f64, start: f64, pick: fn(f64, f64) -> f64| {
        projected.iter().flatten().map(of).fold(start, pick)
    };
    let (left, right) =
        (bound(|p| p.x, f64::INFINITY, f64::min), bound(|p| p.x, f64::NEG_INFINITY, f64::max));
    let (low, high) =
        (bound(|p| p.y, f64::INFINITY, f64::min), bound(|p| p.y, f64::NEG_INFINITY, f64::max));
    // A plate that is seen edge on still has a scale.
    let (width, height) = ((right - left).max(1e-12), (high - low).max(1e-12));
    let scale = ((WIDTH - 2.0 * MARGIN) / width).min(MOST_HEIGHT / height);
    let shift = 0.5 * (WIDTH - scale * width);
    let total = MARGIN + scale * height + FOOT;
    let place =
        |p: &Point2| Point2::new(shift + scale * (p.x - left), MARGIN + scale * (high - p.y));
    let parts: Vec<Part<'_>> = panels
        .iter()
        .zip(&projected)
        .map(|(panel, points)| Part {
            panel,
            points: points.iter().map(place).collect(),
            rungs: rung_classes(panel, material, RULINGS),
        })
        .collect();
    let mut body = paint(&view, &parts);
    body += &triad(&view, Point2::new(46.0, total - 42.0));
    let bar = round_below(0.3 * WIDTH / scale);
    body += &scale_bar(Point2::new(WIDTH - MARGIN, total - 14.0), scale * bar, &length_short(bar));
    Picture::new(WIDTH, total, title, body)
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
