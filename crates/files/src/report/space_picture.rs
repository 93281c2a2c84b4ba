//! The surface in space: shaded triangles, rulings and the boundary.
//!
//! Painter's algorithm: triangles from far to near, then those parts of lines that no triangle
//! hides. Where nothing hides anything (see [`is_plain`]) no order is needed, and triangles of one
//! shade and all lines of a kind are one path each, which makes the page small.

use super::canvas::{Anchor, PathData, Picture, WIDTH, line, round_below, scale_bar, text};
use super::hidden::Seen;
use super::style::SHADES;
use super::view::{View, is_plain, view_of};
use super::wording::{length_short, thinned};
use super::worst_rung;
use sheetwright::design::MadePanel;
use sheetwright::index::TriangleIndex;
use sheetwright::material::{Material, warp_limit};
use sheetwright::math::{Point2, Point3, Vec2, Vec3, unit};

/// Room round the surface, and below it for the axes and the scale.
const MARGIN: f64 = 16.0;
const FOOT: f64 = 96.0;
/// The surface is drawn no higher than this.
const MOST_HEIGHT: f64 = 330.0;
/// The least difference of brightness that the shades are spread over: below it a surface is so
/// flat that it may look so.
const LEAST_CONTRAST: f64 = 0.18;
/// Rulings drawn, at the most.
const RULINGS: usize = 60;

/// The surface of a panel in space, shaded, with rulings; those that warp more than the sheet takes
/// stand out.
pub fn surface_picture(panel: &MadePanel, material: Option<&Material>) -> Picture {
    let view = view_of(panel);
    let points: Vec<Point2> = panel.surface.positions().iter().map(|&p| view.project(p)).collect();
    let bound = |of: fn(&Point2) -> f64, start: f64, pick: fn(f64, f64) -> f64| {
        points.iter().map(of).fold(start, pick)
    };
    let (left, right) =
        (bound(|p| p.x, f64::INFINITY, f64::min), bound(|p| p.x, f64::NEG_INFINITY, f64::max));
    let (low, high) =
        (bound(|p| p.y, f64::INFINITY, f64::min), bound(|p| p.y, f64::NEG_INFINITY, f64::max));
    let (width, height) = (right - left, high - low);
    let scale = ((WIDTH - 2.0 * MARGIN) / width.max(1e-12)).min(MOST_HEIGHT / height.max(1e-12));
    let shift = 0.5 * (WIDTH - scale * width);
    let drawn = scale * height;
    let points: Vec<Point2> = points
        .iter()
        .map(|p| Point2::new(shift + scale * (p.x - left), MARGIN + scale * (high - p.y)))
        .collect();
    let total = MARGIN + drawn + FOOT;
    let mut body = Painter { panel, view: &view, points: &points, material }.paint();
    body += &triad(&view, Point2::new(46.0, total - 42.0));
    let bar = round_below(0.3 * WIDTH / scale);
    body += &scale_bar(Point2::new(WIDTH - MARGIN, total - 14.0), scale * bar, &length_short(bar));
    Picture::new(WIDTH, total, format!("{} in space", panel.name), body)
}

struct Painter<'a> {
    panel: &'a MadePanel,
    view: &'a View,
    points: &'a [Point2],
    material: Option<&'a Material>,
}

impl Painter<'_> {
    fn paint(&self) -> String {
        let shades = self.shades();
        if is_plain(self.view, self.panel) {
            return self.paint_plain(&shades);
        }
        self.paint_by_depth(&shades)
    }

    /// The class of every triangle: the side that is seen, and how bright it is.
    fn shades(&self) -> Vec<String> {
        // A lamp above the left shoulder.
        let view = self.view;
        let lamp = unit(view.toward * 0.75 + view.up * 0.55 - view.right * 0.45).unwrap_or(Vec3::Z);
        let count = self.panel.surface.connectivity().triangles().len();
        let lit: Vec<(bool, f64)> = (0..count)
            .map(|n| {
                let normal = self.panel.surface.normal(TriangleIndex::new(n));
                let normal = normal.unwrap_or(self.view.toward);
                let front = normal.dot(view.toward) >= 0.0;
                let seen = if front { normal } else { -normal };
                (front, 0.5 + 0.5 * seen.dot(lamp))
            })
            .collect();
        let most = lit.iter().map(|l| l.1).fold(0.0, f64::max);
        let least = lit.iter().map(|l| l.1).fold(most - LEAST_CONTRAST, f64::min);
        let class = |(front, brightness): (bool, f64)| {
            let share = (brightness - least) / (most - least);
            let shade = ((SHADES - 1) as f64 * share).round() as usize;
            format!("{}{}", if front { 'f' } else { 'b' }, shade.min(SHADES - 1))
        };
        lit.into_iter().map(class).collect()
    }

    fn corners(&self, triangle: usize) -> [Point2; 3] {
        let corners = self.panel.surface.connectivity().triangles()[triangle];
        corners.map(|s| self.points[s.get()])
    }

    fn rung_ends(&self, rung: usize) -> [Point2; 2] {
        self.panel.measures.rungs[rung].rung.ends().map(|s| self.points[s.get()])
    }

    /// The class of every rung that is drawn.
    fn rung_classes(&self) -> Vec<Option<&'static str>> {
        rung_classes(self.panel, self.material, RULINGS)
    }

    fn paint_plain(&self, shades: &[String]) -> String {
        let mut fills: std::collections::BTreeMap<&str, PathData> = Default::default();
        for (n, shade) in shades.iter().enumerate() {
            fills.entry(shade).or_default().ring(self.corners(n));
        }
        let mut body: String = fills.iter().map(|(class, path)| path.element(class)).collect();
        let classes = self.rung_classes();
        for class in ["r", "x", "w"] {
            let mut path = PathData::default();
            for n in (0..classes.len()).filter(|&n| classes[n] == Some(class)) {
                path.line(self.rung_ends(n));
            }
            body += &path.element(class);
        }
        let mut edge = PathData::default();
        for range in self.panel.surface.connectivity().loops() {
            edge.ring(self.points[range.clone()].iter().copied());
        }
        body + &edge.element("e")
    }

    fn paint_by_depth(&self, shades: &[String]) -> String {
        let connectivity = self.panel.surface.connectivity();
        let depth = |n: usize| {
            let corners = self.panel.surface.corners(TriangleIndex::new(n));
            corners.iter().map(|&p: &Point3| self.view.nearness(p)).sum::<f64>()
        };
        let depths: Vec<f64> = (0..shades.len()).map(depth).collect();
        let mut order: Vec<usize> = (0..shades.len()).collect();
        order.sort_by(|&a, &b| depths[a].total_cmp(&depths[b]).then(a.cmp(&b)));
        let mut body = String::new();
        let (mut class, mut run) = ("", PathData::default());
        for &n in &order {
            if class != shades[n] {
                body += &std::mem::take(&mut run).element(class);
                class = &shades[n];
            }
            run.ring(self.corners(n));
        }
        body += &run.element(class);
        let seen = Seen::new(self.panel, self.view, self.points);
        let classes = self.rung_classes();
        for class in ["r", "x", "w"] {
            let mut path = PathData::default();
            for n in (0..classes.len()).filter(|&n| classes[n] == Some(class)) {
                for part in seen.visible(self.panel.measures.rungs[n].rung.ends()) {
                    path.line(part);
                }
            }
            body += &path.element(class);
        }
        let mut edges: Vec<Vec<Point2>> = Vec::new();
        for [from, to] in connectivity.edges().flat_map(|edge| seen.visible(edge)) {
            match edges.last_mut() {
                Some(edge) if edge.last() == Some(&from) => edge.push(to),
                _ => edges.push(vec![from, to]),
            }
        }
        let mut path = PathData::default();
        for edge in edges {
            path.line(edge);
        }
        body + &path.element("e")
    }
}

/// The class of every rung that is drawn: `w` the worst if it is beyond the limit, `x` beyond it,
/// `r` any other. At the most about `most` of each.
pub(super) fn rung_classes(
    panel: &MadePanel,
    material: Option<&Material>,
    most: usize,
) -> Vec<Option<&'static str>> {
    let limit = warp_limit(material);
    let rungs = &panel.measures.rungs;
    let worst = worst_rung(&panel.measures).filter(|&n| rungs[n].warp > limit);
    let mut classes = vec![None; rungs.len()];
    let (beyond, within): (Vec<usize>, Vec<usize>) =
        (0..rungs.len()).partition(|&n| rungs[n].warp > limit);
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
