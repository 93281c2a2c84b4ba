//! Surfaces in space: shaded triangles, rulings or creases, the boundary and the cuts.

use super::canvas::{Anchor, MARGIN, PathData, Picture, WIDTH, line, round_below, scale_bar, text};
use super::legend::legend;
use super::paint::fill_elements;
use crate::space::{
    APART, APART_CLASSES, CREASE, CUT, Drawn, Facet, LIES_ON, MOST_PATHS, Middles, Placing,
    RUNG_CLASSES, Scene, SeenLines, Solid, View, coarse_shade, shades_of, view_of,
};
use crate::wording::length_short;
use sheetwright::make::{Made, Part};
use sheetwright::material::Material;
use sheetwright::math::{Point2, Vec2, Vec3};

/// Room below the surface for the axes and the scale.
const FOOT: f64 = 96.0;
/// The surface is drawn no higher than this.
const MOST_HEIGHT: f64 = 330.0;
/// The least distance between the middles of rulings in a picture of several panels: closer rulings
/// would make narrow panels dark.
const APART_OF_SEVERAL: f64 = 9.0;
/// The most panels with thick outlines.
const MOST_THICK: usize = 12;

/// The surface of a part in space, shaded, with rulings or creases; rulings that warp more than the
/// sheet takes stand out.
pub fn space_picture(part: &Part, material: Option<&Material>) -> Picture {
    let title = format!("{} in space", part.name);
    pictured(std::slice::from_ref(part), material, title)
}

/// The surfaces of all parts of a design, as they lie in space.
pub fn design_picture(made: &Made) -> Picture {
    pictured(&made.parts, made.material.as_ref(), format!("{} in space", made.name))
}

fn pictured(parts: &[Part], material: Option<&Material>, title: String) -> Picture {
    let view = view_of(parts);
    let solids: Vec<Solid> = parts.iter().map(|part| Solid::of(part, material)).collect();
    let projected: Vec<Vec<Point2>> = solids
        .iter()
        .map(|solid| solid.positions.iter().map(|&p| view.project(p)).collect())
        .collect();
    let fit = Fit::new(projected.iter().flatten());
    let placed = |points: &Vec<Point2>| points.iter().map(|p| fit.place(*p)).collect();
    let drawn: Vec<Drawn> = solids
        .into_iter()
        .zip(&projected)
        .map(|(solid, points)| Drawn::new(solid, &view, placed(points)))
        .collect();
    let areas: Vec<Vec<Vec3>> = drawn.iter().map(|part| part.solid.areas.clone()).collect();
    let mut shades = shades_of(&view, &areas);
    if shades.iter().map(Vec::len).sum::<usize>() > MOST_PATHS {
        shades.iter_mut().flatten().for_each(|shade| *shade = coarse_shade(*shade));
    }
    let facets: Vec<Facet> =
        drawn.iter().zip(&shades).flat_map(|(part, shades)| part.facets(shades)).collect();
    let scene = Scene::new(Vec2::new(WIDTH, fit.total), &facets, fit.millimetres(LIES_ON));
    let mut body = fill_elements(&scene.fills());
    body += &rungs(&drawn, &shades, &scene);
    body += &outlines(&drawn, &shades, &scene);
    body += &fit.foot(&view);
    let rungs = drawn.iter().flat_map(|part| part.solid.rungs.iter().copied().flatten());
    let lines = drawn.iter().flat_map(|part| {
        let creases = part.solid.creases.iter().map(|_| CREASE);
        creases.chain(part.solid.cuts.iter().map(|_| CUT))
    });
    let shown = legend(rungs.chain(lines), fit.total);
    Picture::new(WIDTH, fit.total + shown.height, title, body + &shown.body)
}

/// The boundaries of all parts, their creases, where their surfaces turn away from the eye, and the
/// cuts along which their sheets are open.
fn outlines(parts: &[Drawn], shades: &[Vec<u16>], scene: &Scene<'_>) -> String {
    let (mut border, mut turns) = (PathData::default(), PathData::default());
    let (mut creases, mut cuts) = (PathData::default(), PathData::default());
    for (part, shades) in parts.iter().zip(shades) {
        let seen = SeenLines::of(part, shades, scene);
        seen.rings.into_iter().for_each(|ring| border.ring(ring));
        let open = [
            (seen.border, &mut border),
            (seen.turns, &mut turns),
            (seen.creases, &mut creases),
            (seen.cuts, &mut cuts),
        ];
        for (runs, path) in open {
            runs.into_iter().for_each(|run| path.line(run));
        }
    }
    let class = |name: &str| name.to_owned() + if parts.len() > MOST_THICK { " thin" } else { "" };
    turns.element("e thin")
        + &creases.element(CREASE)
        + &border.element(&class("e"))
        + &cuts.element(&class(CUT))
}

/// The rungs of all parts, as far as they are seen. Where rulings would run into one another, some
/// are left out.
fn rungs(parts: &[Drawn], shades: &[Vec<u16>], scene: &Scene<'_>) -> String {
    let apart = if parts.len() > 1 { APART_OF_SEVERAL } else { APART };
    let mut drawn = Middles::apart(apart);
    let mut body = String::new();
    for class in RUNG_CLASSES {
        let mut path = PathData::default();
        for (part, shades) in parts.iter().zip(shades) {
            for (ends, sides) in part.rungs_of(class, shades) {
                let (ends, near) = part.line(ends);
                let middle = ends[0].lerp(ends[1], 0.5);
                let is_ruling = APART_CLASSES.contains(&class);
                if is_ruling && !drawn.is_free(middle) {
                    continue;
                }
                let pieces = scene.visible_on(ends, near, sides);
                if is_ruling && !pieces.is_empty() {
                    drawn.take(middle);
                }
                pieces.into_iter().for_each(|piece| path.line(piece));
            }
        }
        body += &path.element(class);
    }
    body
}

/// Where projected points lie in a picture that shows all of them, with the axes and the scale
/// below.
pub(super) struct Fit {
    placing: Placing,
    /// The height of the picture.
    pub(super) total: f64,
}

impl Fit {
    pub(super) fn new<'a>(projected: impl Iterator<Item = &'a Point2>) -> Self {
        let placing = Placing::new(projected, WIDTH, MARGIN, MOST_HEIGHT);
        Self { placing, total: placing.height - MARGIN + FOOT }
    }

    pub(super) fn place(&self, p: Point2) -> Point2 {
        self.placing.place(p)
    }

    /// A length in space, mm, from one in the picture.
    pub(super) fn millimetres(&self, length: f64) -> f64 {
        self.placing.millimetres(length)
    }

    /// The axes and the scale.
    pub(super) fn foot(&self, view: &View) -> String {
        let scale = self.placing.scale();
        let bar = round_below(0.3 * WIDTH / scale);
        let right = Point2::new(WIDTH - MARGIN, self.total - 14.0);
        triad(view, Point2::new(46.0, self.total - 42.0))
            + &scale_bar(right, scale * bar, &length_short(bar))
    }
}

/// Draws the directions of x, y and z.
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
