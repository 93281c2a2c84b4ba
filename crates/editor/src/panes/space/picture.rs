//! What is in the picture of a scene: put together anew only if something in it changed.

use super::camera::Camera;
use super::gauss;
use super::gpu::{Globals, SpacePicture};
use super::lines::{Lines, Pen, curve_points};
use super::pick::share_along;
use super::sheets::vertices;
use crate::document::Plan;
use crate::document::Selection;
use crate::engine::shown::Shown;
use crate::panes::marks::Marks;
use crate::panes::measured::{Quantity, twist, worst, worst_colour, worst_of_all};
use crate::scene::Scene;
use crate::theme::{CURVE_WIDTH, Theme, mapped};
use crate::views::SurfaceView;
use eframe::egui::{Color32, Pos2, Rect};
use sheetwright::design::DesignCurve;
use sheetwright::math::{Point3, Vec3};
use std::sync::Arc;

/// Rungs that are drawn of a panel, at the most.
const RUNGS: usize = 110;
/// A curve this near is under the hand, points.
const NEAR_CURVE: f32 = 9.0;

/// What a picture was made of; another one is another picture.
#[derive(Clone, Debug, PartialEq)]
struct Key {
    panels_version: u64,
    view: SurfaceView,
    selection: Selection,
    theme: &'static Theme,
    plan: Plan,
    grid_mm: f64,
    curves_version: u64,
}

/// A picture, and what it takes to look at it.
#[derive(Debug)]
pub(super) struct Built {
    key: Option<Key>,
    curves: Vec<(DesignCurve, Vec<Point3>)>,
    curves_version: u64,
    /// What is drawn.
    pub(super) picture: Arc<SpacePicture>,
    /// What its places are about, mm.
    origin: Point3,
    /// How far from there anything is, mm.
    reach: f64,
}

impl Default for Built {
    fn default() -> Self {
        Self {
            key: None,
            curves: Vec::new(),
            curves_version: 0,
            picture: Arc::default(),
            origin: Point3::default(),
            reach: 1.0,
        }
    }
}

impl Built {
    /// Makes the picture of a scene, unless it is the one that there is.
    pub(super) fn update(&mut self, scene: &Scene<'_>, view: SurfaceView) {
        self.update_curves(&scene.document.design.curves);
        let drawing = &scene.document.drawing;
        let key = Key {
            panels_version: scene.panels_version,
            view,
            // Points are no part of it.
            selection: Selection { points: Vec::new(), ..scene.selection.clone() },
            theme: scene.theme,
            plan: drawing.plan,
            grid_mm: drawing.grid_mm,
            curves_version: self.curves_version,
        };
        if self.key.as_ref() == Some(&key) {
            return;
        }
        self.key = Some(key);
        let by = Quantity::of(view, scene.made().map(|(_, shown)| shown));
        if view == SurfaceView::Gauss {
            let (sheets, lines) = gauss::image(scene);
            (self.origin, self.reach) = (Point3::default(), 1.3);
            self.picture =
                Arc::new(SpacePicture { sheets, lines: lines.segments, under: 0, ghosts: 0 });
            return;
        }
        let (middle, radius) = around(&self.points(scene));
        let reach = (2.2 * radius).max(6.0 * drawing.grid_mm);
        (self.origin, self.reach) = (middle, reach + radius);
        let mut sheets = Vec::new();
        let mut lines = Lines::about(middle);
        lines.grid(drawing, scene.theme, middle, reach);
        let under = lines.segments.len();
        let worst = worst_of_all(scene).map(|(panel, _)| panel);
        for (n, shown) in scene.made() {
            let marked = scene.selection.panel == Some(n);
            sheets.extend(vertices(shown, by, middle, marked && view != SurfaceView::Wireframe));
            on_sheet(&mut lines, shown, worst == Some(n), view, scene.theme);
            if marked {
                let pen = Pen::new(scene.theme.accent, 3.0, 2.5);
                let marks = Marks::of(&scene.selection.place, shown);
                marks.lines.into_iter().for_each(|ends| lines.segment(ends, pen));
            }
        }
        let before = lines.segments.len();
        for (n, (_, points)) in self.curves.iter().enumerate() {
            let chosen = scene.selection.curve == Some(n);
            let colour = if chosen { scene.theme.accent } else { scene.theme.curve };
            let width = if chosen { CURVE_WIDTH + 0.5 } else { CURVE_WIDTH };
            if by.is_some() {
                // On the dark end of the map, curves would be lost.
                let halo = Pen::new(scene.theme.paper, width + 2.5, 1.0);
                lines.through(points, false, halo.faded(0.55));
            }
            lines.through(points, false, Pen::new(colour, width, 2.0));
        }
        let mut ghosts = lines.segments.len() - before;
        if view == SurfaceView::Wireframe {
            ghosts = lines.segments.len() - under;
        }
        self.picture = Arc::new(SpacePicture { sheets, lines: lines.segments, under, ghosts });
    }

    fn update_curves(&mut self, curves: &[DesignCurve]) {
        if self.curves.len() == curves.len()
            && self.curves.iter().zip(curves).all(|((old, _), new)| old == new)
        {
            return;
        }
        self.curves_version += 1;
        self.curves.resize_with(curves.len(), || {
            let name = String::new();
            (DesignCurve { name, kind: None, closed: false, points: Vec::new() }, Vec::new())
        });
        for ((old, points), new) in self.curves.iter_mut().zip(curves) {
            if old != new {
                *points = curve_points(new);
                *old = new.clone();
            }
        }
    }

    /// All points of a scene in space: what is to be in sight.
    pub(super) fn points(&self, scene: &Scene<'_>) -> Vec<Point3> {
        let mut points: Vec<Point3> =
            self.curves.iter().flat_map(|(_, points)| points.iter().copied()).collect();
        points.extend(scene.made().flat_map(|(_, shown)| shown.positions.iter().copied()));
        let of_points = scene.document.design.curves.iter().flat_map(|curve| &curve.points);
        points.extend(of_points.map(|point| point.at));
        points.retain(|point| point.is_finite());
        points
    }

    /// The curve under the hand, if one is near.
    pub(super) fn nearest(&self, camera: &Camera, rect: Rect, hand: Pos2) -> Option<usize> {
        let distance = |points: &[Point3]| {
            let seen = points.iter().map(|&p| camera.seen(p, rect).map(|seen| seen.at));
            let seen: Vec<Option<Pos2>> = seen.collect();
            let sides = seen.windows(2).filter_map(|side| side[0].zip(side[1]));
            let apart = |(a, b): (Pos2, Pos2)| a.lerp(b, share_along(a, b, hand)).distance(hand);
            sides.map(apart).fold(f32::INFINITY, f32::min)
        };
        let all = self.curves.iter().enumerate().map(|(n, (_, points))| (distance(points), n));
        let near = all.filter(|(apart, _)| *apart <= NEAR_CURVE);
        near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, n)| n)
    }

    /// How it is looked at.
    pub(super) fn globals(
        &self,
        camera: &Camera,
        rect: Rect,
        pixels_per_point: f32,
        view: SurfaceView,
        theme: &Theme,
    ) -> Globals {
        let (toward, up, right) = (camera.toward(), camera.up(), camera.right());
        let distance = camera.distance();
        let about = camera.target - self.origin;
        let eye = about + toward * distance;
        // Everything is within its reach of the origin.
        let middle = eye.dot(toward);
        let farthest = middle + self.reach;
        let nearest = if camera.perspective {
            (middle - self.reach).max(0.01 * distance).min(0.5 * farthest.max(0.04 * distance))
        } else {
            middle - self.reach
        };
        let farthest = farthest.max(nearest + 0.01 * distance);
        let half_height = 0.5 * camera.height_mm;
        let half_width = half_height * f64::from(rect.width() / rect.height().max(1.0));
        let depth_of = farthest - nearest;
        // Each row of the matrix: what it takes of a place, and what it adds.
        let across = row(right / half_width, about);
        let upwards = row(up / half_height, about);
        let (deep, shrink) = if camera.perspective {
            let k = farthest / depth_of / distance;
            ((toward * -k, k * (middle - nearest)), (toward * (-1.0 / distance), middle / distance))
        } else {
            ((toward * (-1.0 / depth_of), (middle - nearest) / depth_of), (Vec3::ZERO, 1.0))
        };
        let rows = [across, upwards, deep, shrink];
        let clip = std::array::from_fn(|column| {
            std::array::from_fn(|n| {
                let (way, added) = rows[n];
                (if column < 3 { way[column] } else { added }) as f32
            })
        });
        let pixels = [rect.width() * pixels_per_point, rect.height() * pixels_per_point];
        let mm_per_pixel = camera.height_mm / f64::from(pixels[1].max(1.0));
        let with = |v: Vec3, w: f64| [v.x as f32, v.y as f32, v.z as f32, w as f32];
        let (shading, covered) = match view {
            SurfaceView::Warp | SurfaceView::LengthError | SurfaceView::Strain => (0.35, 1.0),
            SurfaceView::Wireframe => (0.0, 0.0),
            SurfaceView::Gauss => (0.7, 0.0),
            _ => (1.0, 0.0),
        };
        let [front, back] = match view {
            SurfaceView::Wireframe => [theme.paper; 2],
            SurfaceView::Gauss if theme.is_dark => [theme.field; 2],
            SurfaceView::Gauss => [theme.ground; 2],
            _ => theme.sheet,
        };
        Globals {
            clip,
            toward: with(toward, if camera.perspective { 1.0 } else { 0.0 }),
            up: with(up, distance),
            right: with(right, mm_per_pixel),
            eye: with(eye, 0.0),
            screen: [pixels[0], pixels[1], pixels_per_point, 0.0],
            range: [nearest as f32, farthest as f32, shading, covered],
            front: colour(front),
            back: colour(back),
            selected: colour(theme.accent),
            map: std::array::from_fn(|n| colour(mapped(n as f64 / 32.0))),
        }
    }
}

/// A colour as the shader takes it.
pub(super) fn colour(colour: Color32) -> [f32; 4] {
    colour.to_array().map(|part| f32::from(part) / 255.0)
}

/// What a row of the matrix takes of a place about the origin, and what it adds.
fn row(way: Vec3, about: Vec3) -> (Vec3, f64) {
    (way, -way.dot(about))
}

/// The middle of some points, and how far any is from it; a little room where there are none.
pub(super) fn around(points: &[Point3]) -> (Point3, f64) {
    let Some(&first) = points.first() else { return (Point3::default(), 300.0) };
    let (mut low, mut high) = (first.to_vec(), first.to_vec());
    for p in points {
        low = low.min(p.to_vec());
        high = high.max(p.to_vec());
    }
    let middle = Point3::from_vec((low + high) * 0.5);
    let radius = points.iter().map(|p| p.distance(middle)).fold(0.0, f64::max);
    (middle, radius.max(1.0))
}

/// Edges and rungs of a panel; and the worst rung if it is that of all panels or beyond what the
/// sheet takes.
fn on_sheet(lines: &mut Lines, shown: &Shown, is_worst: bool, view: SurfaceView, theme: &Theme) {
    let at = |n: u32| shown.positions.get(n as usize).copied().unwrap_or_default();
    let pen = match view {
        SurfaceView::Wireframe => Some(Pen::new(theme.rung, 1.0, 1.0)),
        SurfaceView::Rungs => Some(Pen::new(theme.rung, 1.0, 1.0).faded(0.8)),
        SurfaceView::Warp | SurfaceView::LengthError => {
            Some(Pen::new(theme.paper, 1.0, 1.0).faded(0.18))
        }
        SurfaceView::Shaded | SurfaceView::Gauss | SurfaceView::Strain => None,
    };
    if let Some(pen) = pen {
        // Of many rungs close to one another some stand for all.
        let most = match view {
            SurfaceView::Wireframe => usize::MAX,
            SurfaceView::Rungs => RUNGS,
            _ => RUNGS / 2,
        };
        for rung in shown.rungs.iter().step_by(shown.rungs.len().div_ceil(most).max(1)) {
            lines.segment(rung.ends.map(at), pen);
        }
    }
    let edge = Pen::new(theme.curve, 1.2, 1.5).faded(0.7);
    for of_loop in &shown.loops {
        let points: Vec<Point3> = of_loop.iter().map(|&n| at(n)).collect();
        lines.through(&points, true, edge);
    }
    let coloured = matches!(view, SurfaceView::Warp | SurfaceView::Rungs);
    let beyond = |&n: &usize| twist(&shown.rungs[n]) > shown.warp_limit_deg;
    if let Some(worst) = worst(shown).filter(|n| coloured && (is_worst || beyond(n))) {
        let pen = Pen::new(worst_colour(shown, worst, theme), 2.5, 2.0);
        lines.segment(shown.rungs[worst].ends.map(at), pen);
    }
}
