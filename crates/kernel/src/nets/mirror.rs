//! Mirror planes of a body of facets, and what a net takes that is symmetric to one.
//!
//! Every mirror plane goes through the mean of the corners, and maps the corner that is farthest
//! from there to one as far away, or holds it. So the planes half-way between that corner and each
//! such one are all that there may be but those that hold it; and of these, a second corner gives
//! all, in the same way. A plane is a mirror if corners, hinges and facets have images.
//!
//! The folds of a symmetric piece form a tree that the mirror maps to itself. Such a tree has a
//! middle: facets that the plane crosses, joined by hinges that it crosses, or one hinge within the
//! plane. Everything else comes in pairs. Facets that the plane crosses and that no such hinges
//! join are of two pieces, so their count bounds that of the pieces.

use super::facets::{Facets, Hinge};
use super::order::HIDDEN;
use sheetwright_geometry::disjoint::DisjointSets;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::{Point3, Vec3, unit};
use std::collections::{BTreeMap, BTreeSet};

/// Mirrors that are looked for at most: a ball of triangles has fifteen, a prism as many as sides.
const MOST_MIRRORS: usize = 8;
/// Images of corners that are looked for at most, in all planes together: some tenths of a second.
const MOST_IMAGES: usize = 400_000;
/// Planes whose normals differ by less are one.
const ONE_PLANE: f64 = 1e-4;
/// The width of a facet may differ from that of its image by this share, or by rounding.
const ALIKE: f64 = 1e-3;
/// A direction that no edge of a model is square to, but by chance: corners are found along it.
const ACROSS: Vec3 = Vec3::new(0.267_261, 0.534_523, 0.801_784);

/// A mirror of a body.
#[derive(Clone, Debug)]
pub(super) struct Mirror {
    /// The image of each facet.
    facets: Vec<usize>,
    /// The image of each hinge.
    hinges: Vec<usize>,
    /// A symmetric net has so many pieces or more.
    pub(super) least_pieces: usize,
}

impl Mirror {
    /// The image of a hinge.
    pub(super) fn image(&self, hinge: usize) -> usize {
        self.hinges[hinge]
    }

    /// Whether a hinge is its own image.
    pub(super) fn keeps(&self, hinge: usize) -> bool {
        self.hinges[hinge] == hinge
    }

    /// An order of hinges as a symmetric net grows: those that the plane crosses first; then the
    /// first of those within it, if a middle is to come first (`middle_first`) and the plane
    /// crosses no facet; then pairs; and the others within the plane last.
    pub(super) fn arranged(
        &self,
        facets: &Facets,
        order: &[usize],
        middle_first: bool,
    ) -> Vec<usize> {
        let is_crossed =
            |n: usize| self.facets[facets.hinges[n].facets[0]] == facets.hinges[n].facets[0];
        let kept = |n: &&usize| self.keeps(**n);
        let mut arranged: Vec<usize> =
            order.iter().filter(kept).copied().filter(|&n| is_crossed(n)).collect();
        let within: Vec<usize> =
            order.iter().filter(kept).copied().filter(|&n| !is_crossed(n)).collect();
        let crosses = self.facets.iter().enumerate().any(|(f, &image)| f == image);
        let middle = usize::from(middle_first && !crosses).min(within.len());
        arranged.extend(&within[..middle]);
        arranged.extend(order.iter().filter(|n| !self.keeps(**n)));
        arranged.extend(&within[middle..]);
        arranged
    }
}

/// The mirrors of a body, first those in which a symmetric net has the fewest pieces at least; then
/// those along an axis; then those that keep apart what is seen and what is hidden.
pub(super) fn mirrors(facets: &Facets) -> Vec<Mirror> {
    let Some(corners) = Corners::of(facets) else { return Vec::new() };
    let mut images = 0;
    let planes = corners.planes().into_iter().filter_map(|normal| {
        (images < MOST_IMAGES).then_some(())?;
        corners.mirror(facets, normal, &mut images)
    });
    let mut mirrors: Vec<Mirror> = planes.take(MOST_MIRRORS).collect();
    mirrors.sort_by_key(|mirror| mirror.least_pieces);
    mirrors
}

/// The corners of a body: where its hinges end.
struct Corners {
    points: Vec<Point3>,
    centre: Point3,
    /// How far they lie along [`ACROSS`], mm, and which they are, in that order.
    across: Vec<(f64, usize)>,
    /// The hinge between two corners.
    hinges: BTreeMap<[usize; 2], usize>,
    /// The corners at which each hinge starts and ends.
    ends: Vec<[usize; 2]>,
    near_mm: f64,
}

impl Corners {
    /// `None` where there are no hinges, or two lie in one place.
    fn of(facets: &Facets) -> Option<Self> {
        let ends = |hinge: &Hinge| [hinge.line[0], hinge.line[hinge.line.len() - 1]];
        let vertices: BTreeSet<VertexIndex> = facets.hinges.iter().flat_map(ends).collect();
        let vertices: Vec<VertexIndex> = vertices.into_iter().collect();
        let points: Vec<Point3> = vertices.iter().map(|v| facets.positions[v.get()]).collect();
        let sum: Vec3 = points.iter().map(|p| p.to_vec()).sum();
        let centre = Point3::from_vec(sum / points.len().max(1) as f64);
        let number = |v: VertexIndex| vertices.binary_search(&v).unwrap_or(0);
        let ends: Vec<[usize; 2]> = facets.hinges.iter().map(|h| ends(h).map(number)).collect();
        let sorted = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
        let hinges: BTreeMap<[usize; 2], usize> =
            ends.iter().enumerate().map(|(n, &ends)| (sorted(ends), n)).collect();
        let mut across: Vec<(f64, usize)> =
            points.iter().enumerate().map(|(n, p)| (p.to_vec().dot(ACROSS), n)).collect();
        across.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let is_clear = !hinges.is_empty() && hinges.len() == facets.hinges.len();
        is_clear.then_some(Self { points, centre, across, hinges, ends, near_mm: facets.near_mm })
    }

    /// The unit normals of all planes that may be mirrors, the best first.
    fn planes(&self) -> Vec<Vec3> {
        let from_centre = |n: usize| self.points[n] - self.centre;
        let farthest = |away: &dyn Fn(usize) -> f64| {
            (0..self.points.len()).max_by(|&a, &b| away(a).total_cmp(&away(b)).then(b.cmp(&a)))
        };
        let mut planes = vec![Vec3::X, Vec3::Y, Vec3::Z];
        let Some(first) = farthest(&|n| from_centre(n).length()) else { return planes };
        let Some(axis) = unit(from_centre(first)) else { return planes };
        let off_axis = |n: usize| from_centre(n).cross(axis).length();
        let Some(second) = farthest(&off_axis) else { return planes };
        let is_alike = |a: f64, b: f64| (a - b).abs() <= self.near_mm;
        for (n, &point) in self.points.iter().enumerate() {
            let is_as_far = |of: usize| is_alike(from_centre(n).length(), from_centre(of).length());
            if is_as_far(first) {
                planes.extend(unit(point - self.points[first]));
            }
            let is_as_high = is_alike(from_centre(n).dot(axis), from_centre(second).dot(axis));
            if is_as_far(second) && is_as_high {
                planes.extend(unit(point - self.points[second]));
            }
        }
        planes.extend(unit(axis.cross(from_centre(second))));
        // Models stand square to the axes, and look to -y: left is the image of right. What is
        // least seen is best its own image. Numbers that differ by rounding are equal.
        let key = |normal: &Vec3| {
            let along = normal.x.abs().max(normal.y.abs()).max(normal.z.abs());
            let off_axis = if along > 1.0 - ONE_PLANE { 0.0 } else { 1.0 };
            let [hidden, side] = [normal.dot(HIDDEN).abs(), -normal.x.abs()];
            [off_axis, (hidden * 1e6).round(), (side * 1e6).round()]
        };
        planes.sort_by(|a, b| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal));
        let mut distinct: Vec<Vec3> = Vec::new();
        for normal in planes {
            // Those of one plane stand beside one another, but for a few of the same key.
            let is_new = |other: &Vec3| normal.cross(*other).length() > ONE_PLANE;
            if distinct.iter().rev().take(4).all(is_new) {
                distinct.push(normal);
            }
        }
        distinct
    }

    /// The corner at a place.
    fn at(&self, place: Point3) -> Option<usize> {
        let along = place.to_vec().dot(ACROSS);
        let from = self.across.partition_point(|&(k, _)| k < along - self.near_mm);
        let near = self.across[from..].iter().take_while(|&&(k, _)| k <= along + self.near_mm);
        let near = near.map(|&(_, n)| (self.points[n].distance(place), n));
        let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (nearest.0 <= self.near_mm).then_some(nearest.1)
    }

    /// The mirror in a plane; `None` if it is none. Counts the images that it looks for.
    fn mirror(&self, facets: &Facets, normal: Vec3, images: &mut usize) -> Option<Mirror> {
        let mut of_corner = Vec::with_capacity(self.points.len());
        for &point in &self.points {
            *images += 1;
            let off = (point - self.centre).dot(normal);
            of_corner.push(self.at(point + normal * (-2.0 * off))?);
        }
        if of_corner.iter().enumerate().any(|(n, &image)| of_corner[image] != n) {
            return None;
        }
        let mut of_facet: Vec<usize> = vec![usize::MAX; facets.list.len()];
        let mut of_hinge = Vec::with_capacity(self.ends.len());
        for (n, ends) in self.ends.iter().enumerate() {
            let [a, b] = ends.map(|end| of_corner[end]);
            let image = *self.hinges.get(&[a.min(b), a.max(b)])?;
            of_hinge.push(image);
            let [hinge, other] = [n, image].map(|n| &facets.hinges[n]);
            let mut sides = other.facets;
            // A mirror swaps left and right.
            if self.ends[image][0] == a {
                sides.reverse();
            }
            for (&f, image) in hinge.facets.iter().zip(sides) {
                let is_other = of_facet[f] != usize::MAX && of_facet[f] != image;
                if is_other || hinge.is_seam != other.is_seam {
                    return None;
                }
                of_facet[f] = image;
            }
        }
        let width = |f: usize| facets.list[f].width_mm;
        let is_alike = |(f, &image): (usize, &usize)| {
            let off_mm = (width(f) - width(image)).abs();
            off_mm <= (2.0 * self.near_mm).max(ALIKE * width(f))
        };
        // Facets of one body have hinges, but for one that is all of it.
        let is_whole = of_facet.iter().all(|&image| image != usize::MAX);
        if !is_whole || !of_facet.iter().enumerate().all(is_alike) {
            return None;
        }
        let is_kept = |f: usize| of_facet[f] == f;
        let mut sets = DisjointSets::new(of_facet.len());
        let mut least = (0..of_facet.len()).filter(|&f| is_kept(f)).count();
        for (n, hinge) in facets.hinges.iter().enumerate() {
            let [a, b] = hinge.facets;
            if of_hinge[n] == n && !hinge.is_seam && is_kept(a) && sets.join(a, b) {
                least -= 1;
            }
        }
        Some(Mirror { facets: of_facet, hinges: of_hinge, least_pieces: least.max(1) })
    }
}
