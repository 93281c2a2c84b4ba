//! What will stand beyond the border of pieces, such as tabs to glue: with that, too, a piece is no
//! larger than it may be.
//!
//! Which of two sides gets the tabs of a joint is decided when all pieces are known, so room is
//! kept on both. What stands beyond a side lies inside the hull of the side and two outer points.

use super::facets::{Facet, Facets};
use crate::flatten::fits_in_with;
use sheetwright_geometry::math::{Point2, unit2};

/// Where the outer sides of two strips would meet farther from a corner than this, in widths, they
/// are cut off.
const MOST_BEYOND: f64 = 2.5;

/// What stands beyond the border of pieces. Default: nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Beyond {
    /// Beyond both sides of each cut.
    pub joined: Option<Strip>,
    /// Beyond the border of the mesh.
    pub free: Option<Strip>,
}

/// A strip beyond a side of the border.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    /// How far it reaches, mm.
    pub width_mm: f64,
    /// How it ends.
    pub ends: StripEnds,
}

/// How a strip ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StripEnds {
    /// Its outer side is shorter than the inner one at each end.
    Slanted {
        /// By this, mm.
        by_mm: f64,
        /// By no more than this share of the inner side.
        most: f64,
    },
    /// Its outer side runs on to where it meets that of the next strip.
    Meets,
}

impl Strip {
    /// A strip that holds both.
    pub(crate) fn around(self, other: Self) -> Self {
        use StripEnds::{Meets, Slanted};
        let ends = match (self.ends, other.ends) {
            (Slanted { by_mm: a, most: b }, Slanted { by_mm: c, most: d }) => {
                Slanted { by_mm: a.min(c), most: b.min(d) }
            }
            _ => Meets,
        };
        Self { width_mm: self.width_mm.max(other.width_mm), ends }
    }

    /// How far from its side it reaches at the most, mm.
    fn reach_mm(&self) -> f64 {
        match self.ends {
            StripEnds::Slanted { .. } => self.width_mm,
            StripEnds::Meets => (1.0 + MOST_BEYOND) * self.width_mm,
        }
    }
}

/// The room that a piece has, with what stands beyond the sides of each facet.
#[derive(Clone, Debug)]
pub(super) struct Room {
    within_mm: [f64; 2],
    sides: Vec<Vec<OuterSide>>,
    reach_mm: f64,
}

/// A side of the border of a facet, and the outer side of what stands beyond it.
#[derive(Clone, Copy, Debug)]
struct OuterSide {
    ends: [usize; 2],
    /// The hinge that it is of; `None` at the border of the mesh.
    hinge: Option<usize>,
    out_mm: f64,
    /// By how much the outer side is shorter at its beginning and at its end, mm.
    shorter_mm: [f64; 2],
}

impl Room {
    pub(super) fn new(facets: &Facets, within_mm: [f64; 2], beyond: &Beyond) -> Self {
        let strips = [beyond.joined, beyond.free];
        let reaches = strips.iter().flatten().map(Strip::reach_mm);
        let reach_mm = reaches.fold(0.0, f64::max);
        let sides = |n: usize| {
            let facet = &facets.list[n];
            let sides = facet.border.iter().filter_map(|&ends| {
                let hinge = hinge_of(facets, n, ends);
                let strip = if hinge.is_some() { beyond.joined } else { beyond.free }?;
                let shorter_mm = shorter_mm(facet, ends, &strip);
                Some(OuterSide { ends, hinge, out_mm: strip.width_mm, shorter_mm })
            });
            sides.collect()
        };
        let sides = (0..facets.list.len()).map(sides).collect();
        Self { within_mm, sides, reach_mm }
    }

    /// The outer points of what stands beyond the sides of a facet whose vertices are laid at
    /// `points`, where it is cut.
    pub(super) fn beyond(
        &self,
        facet: usize,
        points: &[Point2],
        is_folded: impl Fn(usize) -> bool,
    ) -> impl Iterator<Item = Point2> {
        let cut = self.sides[facet].iter().filter(move |side| !side.hinge.is_some_and(&is_folded));
        let outer = |side: &OuterSide| {
            let [a, b] = side.ends.map(|n| points[n]);
            // The facet lies to the left.
            let along = unit2(b - a)?;
            let out = -along.perp() * side.out_mm;
            let [first, last] = side.shorter_mm;
            Some([a + along * first + out, b + along * -last + out])
        };
        cut.filter_map(outer).flatten()
    }

    /// Whether a piece with these points has room, with the outer points of what stands beyond it.
    pub(super) fn holds(&self, points: &[Point2], beyond: impl FnOnce() -> Vec<Point2>) -> bool {
        fits_in_with(points, (self.reach_mm, beyond), self.within_mm)
    }
}

/// The hinge that a side of a facet is of.
fn hinge_of(facets: &Facets, facet: usize, [from, to]: [usize; 2]) -> Option<usize> {
    let is_of = |&n: &usize| {
        let hinge = &facets.hinges[n];
        let side = usize::from(hinge.facets[0] != facet);
        let mut steps = hinge.places[side].windows(2);
        steps.any(|step| step == [from, to] || step == [to, from])
    };
    facets.list[facet].hinges.iter().copied().find(is_of)
}

/// By how much the outer side of a strip beyond a side of a facet is shorter at both ends, mm;
/// where it is longer, less than 0. What is folded beside the facet makes corners wider alone.
fn shorter_mm(facet: &Facet, [from, to]: [usize; 2], strip: &Strip) -> [f64; 2] {
    let at = |n: usize| facet.points[n];
    match strip.ends {
        StripEnds::Slanted { by_mm, most } => [by_mm.min(most * at(from).distance(at(to))); 2],
        StripEnds::Meets => {
            let before = facet.border.iter().find(|side| side[1] == from).map(|side| side[0]);
            let after = facet.border.iter().find(|side| side[0] == to).map(|side| side[1]);
            let corner = |tip: usize, ends: [Option<usize>; 2]| -> Option<f64> {
                let [next, last] = ends;
                let [a, b] = [unit2(at(next?) - at(tip))?, unit2(at(last?) - at(tip))?];
                let (cosine, sine) = (a.dot(b), a.perp_dot(b));
                // Where it goes in, they are cut off by one another.
                let is_cotangent = sine > 0.0;
                Some(if is_cotangent { (1.0 + cosine) / sine } else { 0.0 })
            };
            let corners = [corner(from, [Some(to), before]), corner(to, [after, Some(from)])];
            corners.map(|cotangent| -strip.width_mm * cotangent.unwrap_or(0.0).min(MOST_BEYOND))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Cut, Mesh};
    use sheetwright_geometry::index::VertexIndex;
    use sheetwright_geometry::math::Point3;

    #[test]
    fn outer_points_are_those_of_tabs_and_of_allowances() {
        // A rectangle of 40 by 30, of two triangles.
        let corners = [[0.0, 0.0], [40.0, 0.0], [40.0, 30.0], [0.0, 30.0]];
        let positions = corners.map(|[x, y]| Point3::new(x, y, 0.0)).to_vec();
        let triangles = [[0, 1, 2], [0, 2, 3]].map(|t| t.map(VertexIndex::new)).to_vec();
        let mesh = Mesh::new(positions, triangles).unwrap();
        let facets = Facets::of(&mesh, &Cut::new());
        let size = |ends: StripEnds, within_mm: [f64; 2]| {
            let free = Some(Strip { width_mm: 5.0, ends });
            let room = Room::new(&facets, within_mm, &Beyond { joined: None, free });
            let points = &facets.list[0].points;
            let outer: Vec<Point2> = room.beyond(0, points, |_| false).collect();
            assert_eq!(outer.len(), 8);
            let lengths: Vec<f64> = outer.chunks(2).map(|side| side[0].distance(side[1])).collect();
            (lengths, room.holds(points, || outer.clone()))
        };
        let near = |lengths: &[f64], wanted: [f64; 2]| {
            lengths.iter().all(|mm| wanted.iter().any(|w| (mm - w).abs() < 1e-9))
        };
        // Tabs of 45°; and short ones, which keep three tenths of their side.
        let (lengths, fits) = size(StripEnds::Slanted { by_mm: 5.0, most: 0.35 }, [50.0, 40.0]);
        assert!(near(&lengths, [30.0, 20.0]) && fits, "{lengths:?}");
        let (lengths, fits) = size(StripEnds::Slanted { by_mm: 15.0, most: 0.35 }, [50.0, 39.9]);
        assert!(near(&lengths, [12.0, 9.0]) && !fits, "{lengths:?}");
        // Strips that meet at right angles.
        let (lengths, fits) = size(StripEnds::Meets, [40.0, 50.0]);
        assert!(near(&lengths, [50.0, 40.0]) && fits, "{lengths:?}");
        assert!(!size(StripEnds::Meets, [49.9, 45.0]).1);
    }
}
