//! The other of two surfaces through one boundary.
//!
//! A closed curve may bound two surfaces that bend about as well, as the two sides of its convex
//! hull do. Rounding or the number of samples then decides which costs less, and the person who
//! means the other one would cut the wrong pattern. To find it:
//!
//! 1. Places are chosen on the surface that was found: the middles of long rungs.
//! 2. The cheapest surface that keeps away from all of them ([`HintKind::Away`]) is found.
//! 3. It may keep away because it must, as a dent. So the cheapest surface that passes near the
//!    middles of *its* rungs ([`HintKind::Near`]) is found: if that falls back to the first, there
//!    is no other. Of both, the cheaper one is the answer.
//!
//! Each step fills one table as exact as the first, so the answer is the cheapest surface under
//! these hints, not a local minimum. Steps 1 and 2 are first tried on a part of the samples: most
//! boundaries have no second surface, and then that is all it takes.

use super::part::Part;
use super::{Goal, Method, TriangulateError, TriangulateOptions, Triangulation, if_it_fits};
use crate::cost::{Hint, HintKind};
use crate::rung::Rung;
use sheetwright_geometry::boundary::{Boundary, SupportingPlane};
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::Point3;
use sheetwright_geometry::triangle::nearest_in_triangle;
use sheetwright_geometry::watch::Watch;

/// At how many places the other surface keeps away: in each eighth of the rungs at one.
const PLACES: usize = 8;
/// At how many places the distance of two surfaces is measured.
const MEASURED: usize = 24;
/// A rung counts as long from this share of the longest on; the middles of short ones lie on every
/// surface through the boundary.
const LONG: f64 = 0.4;
/// Two surfaces are two if they are apart by this share of the size of the boundary somewhere, the
/// distance from which on a hint costs nothing.
const APART: f64 = 0.005;
/// The price of the other surface is at most so many times that of the first: twist is about half
/// the square of the warp angle, so its mean warp is at most about twice.
const MOST_DEARER: f64 = 4.0;
/// A surface with less price for each rung is as good as developable, whatever the first costs: the
/// twist of a warp angle of half a degree.
const AS_GOOD_AS_NONE: f64 = 4e-5;
/// How many samples are looked at first.
const FEW: usize = 200;

/// Which surface through a boundary is asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WhichSurface {
    /// The cheapest.
    #[default]
    Cheapest,
    /// The other one, where there are two that cost about as much.
    Other,
}

impl WhichSurface {
    /// How designs and reports name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cheapest => "cheapest",
            Self::Other => "other",
        }
    }
}

/// The other surface through a boundary.
#[derive(Clone, Debug, PartialEq)]
pub struct OtherSurface {
    /// Its triangulation: the cheapest that passes on the other side. Its price without hints is
    /// [`Triangulation::price_without_hints`].
    pub triangulation: Triangulation,
    /// How far both surfaces are apart, mm: the largest distance from places on the first.
    pub distance_mm: f64,
}

/// The surface that costs about as much as the `first` of a boundary and lies elsewhere, if there
/// is one. Only boundaries of one loop are looked at, with all triangulations admitted.
///
/// # Errors
/// See [`TriangulateError`].
pub fn other_surface(
    boundary: &Boundary,
    plane: Option<&SupportingPlane>,
    options: &TriangulateOptions,
    first: &Triangulation,
    watch: &mut dyn Watch,
) -> Result<Option<OtherSurface>, TriangulateError> {
    let is_asked = boundary.holes() == 0
        && options.method == Method::Optimal
        && options.goal == Goal::Price
        && first.forced_rungs == 0;
    if !is_asked {
        return Ok(None);
    }
    let watch = &mut Part::silent(watch);
    let search = Search { boundary, plane, options, seen: middles(boundary, first, MEASURED) };
    let away = hints(boundary, first, HintKind::Away);
    if let Some(few) = fewer(boundary) {
        let search = Search { boundary: &few, plane: None, ..search.clone() };
        let Some(nearby) = search.with(Vec::new(), watch)? else { return Ok(None) };
        if search.other(away.clone(), &nearby, watch)?.is_none() {
            return Ok(None);
        }
    }
    let Some(other) = search.other(away, first, watch)? else { return Ok(None) };
    let near = hints(boundary, &other.triangulation, HintKind::Near);
    let Some(nearer) = search.with(near, watch)? else { return Ok(None) };
    let Some(distance_mm) = search.apart(&nearer) else { return Ok(None) };
    let is_cheaper = nearer.price_without_hints() < other.triangulation.price_without_hints();
    Ok(Some(if is_cheaper { OtherSurface { triangulation: nearer, distance_mm } } else { other }))
}

/// The search for another surface of a boundary.
#[derive(Clone)]
struct Search<'a> {
    boundary: &'a Boundary,
    plane: Option<&'a SupportingPlane>,
    options: &'a TriangulateOptions,
    /// Places on the first surface.
    seen: Vec<Point3>,
}

impl Search<'_> {
    /// The cheapest surface with these hints; `None` if it exceeds the memory or there is none.
    fn with(
        &self,
        hints: Vec<Hint>,
        watch: &mut dyn Watch,
    ) -> Result<Option<Triangulation>, TriangulateError> {
        let options = TriangulateOptions { hints, ..self.options.clone() };
        match if_it_fits(super::cheapest(self.boundary, self.plane, &options, watch).map(Some)) {
            Err(TriangulateError::NoneInside) => Ok(None),
            found => Ok(found?.filter(|found| found.forced_rungs == 0)),
        }
    }

    /// The cheapest surface with these hints, if it lies elsewhere than the first and costs about
    /// as much.
    fn other(
        &self,
        hints: Vec<Hint>,
        first: &Triangulation,
        watch: &mut dyn Watch,
    ) -> Result<Option<OtherSurface>, TriangulateError> {
        let Some(triangulation) = self.with(hints, watch)? else { return Ok(None) };
        let most = (MOST_DEARER * first.price_without_hints())
            .max(AS_GOOD_AS_NONE * first.rungs.len() as f64);
        let distance_mm =
            self.apart(&triangulation).filter(|_| triangulation.price_without_hints() <= most);
        Ok(distance_mm.map(|distance_mm| OtherSurface { triangulation, distance_mm }))
    }

    /// How far a surface is from the first, mm, if they are two.
    fn apart(&self, surface: &Triangulation) -> Option<f64> {
        let at = |sample: SampleIndex| self.boundary.samples()[sample.get()].position;
        let distance = |p: &Point3| {
            let to = |t: &[SampleIndex; 3]| p.distance(nearest_in_triangle(t.map(at), *p));
            surface.triangles.iter().map(to).fold(f64::INFINITY, f64::min)
        };
        let most = self.seen.iter().map(distance).fold(0.0, f64::max);
        (most > APART * self.boundary.size()).then_some(most)
    }
}

/// The loop with about [`FEW`] samples, all of its corners among them; `None` if it has not many
/// more.
fn fewer(boundary: &Boundary) -> Option<Boundary> {
    let step = boundary.len() / FEW;
    if step < 2 {
        return None;
    }
    let kept = boundary.samples().iter().enumerate();
    let kept = kept.filter(|(n, sample)| n % step == 0 || sample.is_corner());
    Boundary::new(vec![kept.map(|(_, sample)| *sample).collect()]).ok()
}

fn hints(boundary: &Boundary, surface: &Triangulation, kind: HintKind) -> Vec<Hint> {
    middles(boundary, surface, PLACES).into_iter().map(|at| Hint { at, kind }).collect()
}

/// The middles of so many long rungs of a surface, spread evenly over all long ones.
fn middles(boundary: &Boundary, surface: &Triangulation, count: usize) -> Vec<Point3> {
    let ends = |rung: &Rung| rung.ends().map(|end| boundary.samples()[end.get()].position);
    let length = |rung: &Rung| {
        let [from, to] = ends(rung);
        from.distance(to)
    };
    let longest = surface.rungs.iter().map(length).fold(0.0, f64::max);
    let long: Vec<&Rung> =
        surface.rungs.iter().filter(|rung| length(rung) >= LONG * longest).collect();
    if long.is_empty() {
        return Vec::new();
    }
    let middle = |n: usize| {
        let [from, to] = ends(long[(2 * n + 1) * long.len() / (2 * count)]);
        from + (to - from) * 0.5
    };
    (0..count).map(middle).collect()
}
