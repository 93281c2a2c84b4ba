//! Whether the plane of a panel, rather than its boundary, keeps it from bending.
//!
//! A surface that need not lie over the plane may pass through itself, so panels have a plane by
//! default. If a surface without it has a much lower price and does not pass through itself, a
//! finding says so. This takes a search of its own, without the plane, and no surface or pattern
//! depends on it. So the question stays open while a panel is made, and may wait until a dragged
//! handle rests. The last answer bounds the search, as the last triangulation bounds that with the
//! plane.

use super::other::add_other;
use super::part::{Found, Origin, Part};
use super::{Judging, MakeCause};
use crate::check::{Verdict, better_without_plane};
use crate::design::DesignPanel;
use crate::material::{DEFAULT_WARP_LIMIT_DEG, Material};
use crate::measure::crosses_itself;
use crate::surface::{Connectivity, Surface};
use sheetwright_geometry::boundary::{Boundary, PlaneChoice};
use sheetwright_geometry::math::to_deg;
use sheetwright_geometry::watch::Watch;
use sheetwright_optimum::triangulate::{
    Cheapest, Goal, Method, TriangulateError, TriangulateOptions, Triangulation, WhichSurface,
    cheaper_than, if_it_fits, triangulate,
};

/// A surface without the plane is reported if its price is below this share of that with the plane.
const MUCH_CHEAPER: f64 = 0.5;

/// The work for the question is at most that for the panel divided by this.
const SHARE_OF_WORK: u64 = 4;

/// The last triangulations of a panel, with the plane and without.
#[derive(Clone, Debug)]
pub(super) struct Known {
    cheapest: Cheapest,
    /// The cheapest one without the plane, if it was much cheaper when it was last looked for.
    free: Option<Triangulation>,
    /// Whether the question was answered before the panel was made anew.
    was_answered: bool,
    /// The options of its triangulation while the question is open: whether it bends better without
    /// its plane.
    open: Option<TriangulateOptions>,
    /// Those options while it is open whether another surface fits its boundary.
    open_other: Option<TriangulateOptions>,
}

impl Known {
    /// After the panel is triangulated anew.
    pub(super) fn next(before: Option<Self>, mut cheapest: Cheapest) -> Self {
        let was_answered = before.as_ref().is_some_and(|known| !known.is_open());
        let differed = |known: &Self| known.cheapest.also_without_plane == Some(false);
        // What differed one move ago is not worth a search of its own.
        if cheapest.also_without_plane.is_none() && before.as_ref().is_some_and(differed) {
            cheapest.also_without_plane = Some(false);
        }
        let free = before.and_then(|known| known.free);
        Self { cheapest, free, was_answered, open: None, open_other: None }
    }

    pub(super) fn cheapest(&self) -> &Cheapest {
        &self.cheapest
    }

    /// Whether [`Self::answer`] has something to look for.
    pub(super) fn is_open(&self) -> bool {
        self.open.is_some() || self.open_other.is_some()
    }

    /// Opens both questions for a panel that was made with these options, if they are any: who asks
    /// for a plane gets it.
    pub(super) fn ask(&mut self, panel: &DesignPanel, found: &Found, options: TriangulateOptions) {
        let is_asked = panel.plane == PlaneChoice::Auto
            && panel.which == WhichSurface::Cheapest
            && found.plane.is_some()
            && found.boundary.holes() < 2;
        self.open = is_asked.then(|| options.clone());
        self.open_other = Some(options);
    }

    /// Answers the questions that are open, and adds what was found to the findings of the panel.
    /// Returns whether there was something. Where it is stopped, a question stays open.
    pub(super) fn answer(
        &mut self,
        made: &mut Part,
        judging: Judging,
        material: Option<&Material>,
        watch: &mut dyn Watch,
    ) -> Result<bool, MakeCause> {
        let mut changed = self.answer_plane(made, watch)?;
        if let Some(options) = self.open_other.take() {
            let added = add_other(made, &options, judging, material, watch);
            if added == Err(TriangulateError::Stopped.into()) {
                self.open_other = Some(options);
            }
            changed |= added?;
        }
        Ok(changed)
    }

    /// Answers the question of the plane: what bends with little twist needs no other surface.
    fn answer_plane(&mut self, made: &mut Part, watch: &mut dyn Watch) -> Result<bool, MakeCause> {
        let Origin::Found(found) = &made.origin else { return Ok(false) };
        let Some(options) = self.open.take() else { return Ok(false) };
        let twists_little = to_deg(made.measures.warp_max) <= DEFAULT_WARP_LIMIT_DEG;
        if twists_little && matches!(made.checked.verdict, Verdict::Bends | Verdict::Roll) {
            return Ok(false);
        }
        let price = self.better_without_plane(&found.boundary, &options, watch);
        if price == Err(TriangulateError::Stopped.into()) {
            self.open = Some(options);
        }
        let Some(price) = price? else { return Ok(false) };
        made.checked.add(better_without_plane(found.triangulation.price, price));
        Ok(true)
    }

    /// The price of the cheapest surface without the plane, if it costs much less than that with it
    /// and does not pass through itself.
    fn better_without_plane(
        &mut self,
        boundary: &Boundary,
        options: &TriangulateOptions,
        watch: &mut dyn Watch,
    ) -> Result<Option<f64>, MakeCause> {
        self.free = self.much_cheaper(boundary, options, watch)?;
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
            // The question comes back with each change, so the answer is looked for and kept.
            None if self.was_answered && boundary.holes() == 0 => {
                let free = if_it_fits(triangulate(boundary, None, options, watch).map(Some))?;
                if let Some(free) = &free {
                    self.cheapest.also_without_plane = Some(free == found);
                }
                return Ok(free.filter(|free| free.price < limit));
            }
            _ => {}
        }
        let few_work = options.work_limit / SHARE_OF_WORK;
        let options = &TriangulateOptions { work_limit: few_work, ..options.clone() };
        let is_plain = options.method == Method::Optimal;
        // Where one without forced rungs is known, those with them do not count.
        if is_plain && options.goal == Goal::Price && found.forced_rungs == 0 {
            return cheaper_than(boundary, options, limit, self.free.as_ref(), watch);
        }
        let free = if_it_fits(triangulate(boundary, None, options, watch).map(Some))?;
        Ok(free.filter(|free| free.price < limit))
    }
}
