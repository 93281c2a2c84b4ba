//! Whether the plane of a panel, rather than its boundary, keeps it from bending.
//!
//! A surface that need not lie over the plane may pass through itself, so a panel without a plane is
//! for whoever asks for it. Where one that costs much less does not pass through itself, that is worth
//! a word. To know takes a search of its own, without the plane. While a handle is dragged, what was
//! found one move ago bounds it, as it bounds that with the plane.

use super::MakeCause;
use crate::boundary::Boundary;
use crate::measure::crosses_itself;
use crate::surface::{Connectivity, Surface};
use crate::triangulate::{
    Cheapest, Goal, Method, TriangulateError, TriangulateOptions, Triangulation, cheaper_than,
    if_it_fits, triangulate,
};
use crate::watch::Watch;

/// A surface that need not lie over the plane is worth a word if its price is below this share.
const MUCH_CHEAPER: f64 = 0.5;

/// What is known of the triangulations of a panel.
#[derive(Clone, Debug)]
pub(super) struct Known {
    cheapest: Cheapest,
    /// The cheapest one without the plane, if it was much cheaper when it was last looked for.
    free: Option<Triangulation>,
    /// Whether the panel was made before.
    is_again: bool,
}

impl Known {
    /// After the panel is triangulated anew.
    pub(super) fn next(before: Option<Self>, mut cheapest: Cheapest) -> Self {
        let is_again = before.is_some();
        let differed = |known: &Self| known.cheapest.also_without_plane == Some(false);
        // What differed one move ago is not worth a search of its own.
        if cheapest.also_without_plane.is_none() && before.as_ref().is_some_and(differed) {
            cheapest.also_without_plane = Some(false);
        }
        Self { cheapest, free: before.and_then(|known| known.free), is_again }
    }

    pub(super) fn cheapest(&self) -> &Cheapest {
        &self.cheapest
    }

    /// The price of the cheapest surface without the plane, if it costs much less than that with it and
    /// does not pass through itself.
    pub(super) fn better_without_plane(
        &mut self,
        boundary: &Boundary,
        options: &TriangulateOptions,
        watch: &mut dyn Watch,
    ) -> Result<Option<f64>, MakeCause> {
        self.free = self.much_cheaper(boundary, options, watch).map_err(MakeCause::Triangulate)?;
        let Some(free) = &self.free else { return Ok(None) };
        let connectivity = Connectivity::new(boundary.loops(), free.triangles.clone())
            .map_err(MakeCause::Surface)?;
        let surface = Surface::new(connectivity, boundary.positions());
        Ok(if crosses_itself(&surface) { None } else { Some(free.price) })
    }

    /// The cheapest triangulation without the plane, if it costs much less than that with it.
    fn much_cheaper(
        &mut self,
        boundary: &Boundary,
        options: &TriangulateOptions,
        watch: &mut dyn Watch,
    ) -> Result<Option<Triangulation>, TriangulateError> {
        let found = &self.cheapest.triangulation;
        let limit = MUCH_CHEAPER * found.price;
        match self.cheapest.also_without_plane {
            Some(true) => return Ok(None),
            // Whoever asks again and again had better know.
            None if self.is_again => {
                let free = if_it_fits(triangulate(boundary, None, options, watch).map(Some))?;
                if let Some(free) = &free {
                    self.cheapest.also_without_plane = Some(free == found);
                }
                return Ok(free.filter(|free| free.price < limit));
            }
            _ => {}
        }
        let is_plain = boundary.holes() == 0 && options.method == Method::Optimal;
        // Where one without forced rungs is known, those with them do not count.
        if is_plain && options.goal == Goal::Price && found.forced_rungs == 0 {
            return cheaper_than(boundary, options, limit, self.free.as_ref(), watch);
        }
        let free = triangulate(boundary, None, options, watch)?;
        Ok(Some(free).filter(|free| free.price < limit))
    }
}
