//! Designs that are their own mirror images in the plane y = 0, as boats are. Moved, they stay so:
//! what lies in the plane stays in it, and mirror images move as mirror images.

use crate::design::{Design, DesignCurve, DesignPanel, used};
use sheetwright_geometry::boundary::size_of;
use sheetwright_geometry::math::{Point3, Vec3};
use sheetwright_geometry::tolerance::Tolerance;
use std::collections::{BTreeMap, BTreeSet};

/// The factors of a displacement that make its mirror image.
pub(super) const MIRRORED: Vec3 = Vec3::new(1.0, -1.0, 1.0);
/// The factors of a displacement that leave of it what lies in the plane.
pub(super) const IN_PLANE: Vec3 = Vec3::new(1.0, 0.0, 1.0);

/// A point of a curve, by the numbers of both.
pub(super) type CurvePlace = (usize, usize);

/// How a design is its own mirror image.
pub(super) struct Symmetry {
    /// The images of the curves that bound its panels, by number. A curve of half a hull, whose
    /// panels are cut twice, once turned over, has one that is not drawn.
    images: BTreeMap<usize, Option<usize>>,
    /// How far points may lie from their images, mm.
    within_mm: f64,
}

impl Symmetry {
    /// That of a design; `None` unless every curve of its panels has an image, drawn or not.
    pub(super) fn of(design: &Design) -> Option<Self> {
        let panels = design.panels_to_make();
        let curves: BTreeSet<usize> =
            panels.iter().flat_map(|panel| curves_of(design, panel)).collect();
        let points = |&curve: &usize| design.curves[curve].points.iter().map(|point| point.at);
        let within_mm = Tolerance::CHAIN.length_mm(size_of(curves.iter().flat_map(points)));
        let is_half = |panel: &DesignPanel| {
            let of_panel = curves_of(design, panel);
            let mut sides = [-1.0, 1.0].into_iter();
            panel.mirrored > 0
                && panel.count == 2 * panel.mirrored
                && sides
                    .any(|side| of_panel.iter().flat_map(points).all(|p| side * p.y <= within_mm))
        };
        let whole: BTreeSet<usize> = panels
            .iter()
            .filter(|panel| !is_half(panel))
            .flat_map(|panel| curves_of(design, panel))
            .collect();
        let image = |&curve: &usize| {
            // A curve that is its own image comes first.
            let mut all = std::iter::once(curve).chain(curves.iter().copied());
            let is_image = |other: &usize| {
                let both = [curve, *other].map(|n| &design.curves[n]);
                mirrored_points(both[0], both[1], within_mm).is_some()
            };
            match all.find(is_image) {
                None if whole.contains(&curve) => None,
                found => Some((curve, found)),
            }
        };
        let images: Option<BTreeMap<_, _>> = curves.iter().map(image).collect();
        images.filter(|images| !images.is_empty()).map(|images| Self { images, within_mm })
    }

    /// The image of a curve, if it is drawn.
    pub(super) fn image(&self, curve: usize) -> Option<usize> {
        self.images.get(&curve).copied().flatten()
    }

    /// The pairs of points of these curves that are mirror images of one another; a point in the
    /// plane is its own. The design may have other points on its curves than the one whose symmetry
    /// it is. A curve whose image may not move has none, and moves alone.
    pub(super) fn pairs(&self, design: &Design, moving: &BTreeSet<usize>) -> Vec<[CurvePlace; 2]> {
        let mut pairs = Vec::new();
        for &curve in moving {
            let Some(image) = self.images.get(&curve) else { continue };
            if image.is_some_and(|image| !moving.contains(&image)) {
                continue;
            }
            let own = &design.curves[curve];
            let found = image.and_then(|image| {
                Some((image, mirrored_points(own, &design.curves[image], self.within_mm)?))
            });
            match found {
                Some((image, points)) => pairs
                    .extend(points.into_iter().enumerate().map(|(n, k)| [(curve, n), (image, k)])),
                None => {
                    let points = own.points.iter().enumerate();
                    let in_plane =
                        points.filter(|(_, p)| mirrored(p.at).distance(p.at) <= self.within_mm);
                    pairs.extend(in_plane.map(|(n, _)| [(curve, n); 2]));
                }
            }
        }
        pairs
    }
}

/// The curves of a panel, by their numbers.
pub(super) fn curves_of(design: &Design, panel: &DesignPanel) -> BTreeSet<usize> {
    let number = |curve: &DesignCurve| design.curves.iter().position(|c| c.name == curve.name);
    used(design, &panel.shape).filter_map(number).collect()
}

fn mirrored(p: Point3) -> Point3 {
    Point3::new(p.x, -p.y, p.z)
}

/// For each point of a curve, the number of the point of another that is its mirror image; `None`
/// unless the other curve is the mirror image of the first, whichever way it runs and wherever it
/// begins, if it is closed.
fn mirrored_points(a: &DesignCurve, b: &DesignCurve, within_mm: f64) -> Option<Vec<usize>> {
    let count = a.points.len();
    if (a.kind, a.closed, count) != (b.kind, b.closed, b.points.len()) {
        return None;
    }
    let is_image = |partner: &dyn Fn(usize) -> usize| {
        a.points.iter().enumerate().all(|(n, point)| {
            let other = &b.points[partner(n)];
            point.corner == other.corner && mirrored(point.at).distance(other.at) <= within_mm
        })
    };
    let shifts = if a.closed { count } else { 1 };
    for shift in 0..shifts {
        let forwards = |n: usize| (n + shift) % count;
        let back = |n: usize| (2 * count - 1 - n - shift) % count;
        for partner in [&forwards as &dyn Fn(usize) -> usize, &back] {
            if is_image(partner) {
                return Some((0..count).map(partner).collect());
            }
        }
    }
    None
}
