//! A design while it is edited: only the panels that depend on a change are made anew.
//!
//! 1. A panel depends on the curves that bound it, on its own settings, on the material, on the
//!    thickness and the face that was drawn, on how its bends are marked, and on how many samples
//!    its curves get where seams are matched or a tolerance says; one that joins others, on those
//!    too; the pieces of a net that have a largest size, on what trims add to them. A panel for
//!    which all that is as it was, to the last bit, stays as it is.
//! 2. A panel that does change has nearly the triangulation that it had. The price of that, mended
//!    where necessary, bounds the price of the new one, so that the table is filled below it at
//!    once, where making a panel afresh looks for such a bound first. (The table itself is not
//!    kept: samples are spread evenly over a smooth stretch of an outline, so when its length
//!    changes, all of them move.)
//! 3. An elastic sheet (`judged`), and whether a panel that does not bend would bend better without
//!    its plane (`unrestricted`), take a search of their own, and no surface depends on them. While
//!    a handle is dragged, a formula gives the verdict, and both wait until the hand rests.
//! 4. Where to divide a panel that will not bend (`advice`) takes a second or two. It is looked for
//!    last, in steps, between which the hand may move again.
//!
//! Panels are kept whole: what depends on all of them, as the pieces that they are divided into, is
//! made anew from them each time.
//!
//! Once the hand rests, the outcome is that of [`super::make`] for this design, bit by bit; only if
//! memory is short, a bound from before may make a table fit that does not fit afresh.

mod advice;

use super::cleaned::{Cleaned, LastCleaned};
use super::cut_list::wanted;
use super::facets::{net_options, say_too_large};
use super::unrestricted::Known;
use super::{How, finish, is_screened, join_meshes, settle};
use super::{Judging, Made, MakeCause, MakeError, Maker, Part};
use crate::design::{Bends, Design, DesignCurve, DesignPanel, PanelShape, Thick, used};
use crate::material::Material;
use crate::nets::NetOptions;
use crate::sample::Counts;
use advice::Advice;
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::math::Point3;
use sheetwright_geometry::watch::{Stage, Watch};
use sheetwright_optimum::triangulate::TriangulateError;

/// A design that is being edited, with its panels as they are now; by default, one without any.
///
/// ```
/// use sheetwright::{
///     CurveUse, Design, DesignCurve, DesignPanel, Live, PanelShape, Point3, Unwatched, make,
/// };
///
/// // Two planks that share the chine, in mm.
/// let rail = |name: &str, z: f64| {
///     let at = |x: f64| [x, 0.4 * z + x * (1800.0 - x) * 3e-4, z];
///     DesignCurve::spline(name, [0.0, 900.0, 1800.0].map(at))
/// };
/// let plank = |name: &str, rails: [&str; 2]| {
///     let along = |rail: &str| CurveUse { name: rail.into(), reversed: false };
///     DesignPanel::new(name, PanelShape::Rails(rails.map(along)), 40)
/// };
/// let design = Design {
///     name: "dinghy".into(),
///     curves: vec![rail("keel", 0.0), rail("chine", 300.0), rail("sheer", 600.0)],
///     panels: vec![plank("bottom", ["keel", "chine"]), plank("side", ["chine", "sheer"])],
///     ..Design::default()
/// };
/// let mut live = Live::new(design, &mut Unwatched);
///
/// // The hand drags the middle of the sheer: of the two planks, only the side is made anew.
/// for step in 1..=3 {
///     let to = Point3::new(900.0, 483.0 + f64::from(step), 600.0);
///     let changed = live.move_point(2, 1, to, &mut Unwatched);
///     assert_eq!(changed, [1]);
///     let side = &live.panels()[1].made.as_ref().unwrap()[0];
///     println!("{:?}: {} triangles", side.checked.verdict, side.sheet.mesh().triangles().len());
///     // … draw side.sheet, side.flat and side.piece.
/// }
///
/// // The hand rests.
/// live.settle(&mut Unwatched);
/// assert_eq!(live.made(), make(live.design(), &mut Unwatched));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Live {
    design: Design,
    panels: Vec<LivePanel>,
    meshes: LastCleaned,
    counts: Counts,
    /// The numbers of the panels that [`Self::advise`] looks at, once that is known.
    to_advise: Option<Vec<usize>>,
}

/// A panel of a design that is being edited.
#[derive(Clone, Debug)]
pub struct LivePanel {
    /// Its name.
    pub name: String,
    /// Its parts as they were made last, or why they can't be made: one part of a panel with
    /// curves. The mates of their edges are known to [`Live::made`] alone.
    pub made: Result<Vec<Part>, MakeError>,
    /// The inputs that it was made from; `None` if making it was stopped.
    made_from: Option<Inputs>,
    /// Its last triangulation, if it had one.
    known: Option<Known>,
    /// Where to divide it.
    advice: Advice,
}

impl LivePanel {
    /// Whether it was made from the design as it is now: false if making it was stopped.
    pub fn is_current(&self) -> bool {
        self.made_from.is_some()
    }

    /// Whether nothing is left that [`Live::settle`] would look for.
    pub fn is_settled(&self) -> bool {
        self.is_current() && !self.is_open()
    }

    fn is_open(&self) -> bool {
        let Ok(parts) = &self.made else { return false };
        parts.iter().any(is_screened) || self.known.as_ref().is_some_and(Known::is_open)
    }
}

/// All that a panel depends on.
#[derive(Clone, Debug)]
struct Inputs {
    /// The panel, and those that it joins.
    panels: Vec<DesignPanel>,
    curves: Vec<DesignCurve>,
    /// How many divisions each curve gets, where that is given.
    divisions: Vec<Option<Vec<usize>>>,
    /// Its mesh, if it is one.
    mesh: Option<Cleaned>,
    material: Option<Material>,
    /// The thickness and the face that was drawn.
    thick: Option<Thick>,
    /// How its bends are marked.
    bends: Bends,
    /// The limits of its net, if it is a mesh.
    net: Option<NetOptions>,
}

impl Inputs {
    /// Those of the `number`-th panel that is to be made.
    fn new(maker: &Maker<'_>, number: usize, panel: &DesignPanel) -> Self {
        let design = maker.design;
        let mut panels = vec![panel.clone()];
        if let PanelShape::Join(join) = &panel.shape {
            let parts = design.panels.iter().filter(|part| join.parts.contains(&part.name));
            panels.extend(parts.cloned());
        }
        let curves: Vec<DesignCurve> = used(design, &panel.shape).cloned().collect();
        let place = |curve: &DesignCurve| design.curves.iter().position(|c| c.name == curve.name);
        let given = |curve| place(curve).and_then(|number| maker.matched.get(&number).cloned());
        let divisions = curves.iter().map(given).collect();
        let mesh = maker.meshes[number].clone();
        let (material, bends) = (design.material.clone(), design.bends_of(panel));
        let net = match &panel.shape {
            PanelShape::Mesh(settings) => Some(net_options(design, settings)),
            _ => None,
        };
        Self { panels, curves, divisions, mesh, material, thick: design.thick(), bends, net }
    }

    /// Whether both are alike to the last bit: 0 and −0 are not.
    fn same(&self, other: &Self) -> bool {
        let bits = |p: Point3| [p.x, p.y, p.z].map(f64::to_bits);
        let same_point = |(a, b): (&CurvePoint, &CurvePoint)| bits(a.at) == bits(b.at);
        let same_points =
            |a: &DesignCurve, b: &DesignCurve| a.points.iter().zip(&b.points).all(same_point);
        self.panels == other.panels
            && self.curves == other.curves
            && self.curves.iter().zip(&other.curves).all(|(a, b)| same_points(a, b))
            && self.divisions == other.divisions
            && self.mesh == other.mesh
            && self.material == other.material
            && self.thick == other.thick
            && self.bends == other.bends
            && self.net == other.net
    }
}

impl Live {
    /// Makes all panels of a design as it is drawn; its `vary` is ignored.
    pub fn new(design: Design, watch: &mut dyn Watch) -> Self {
        let mut live = Self::default();
        live.update(design, watch);
        live
    }

    /// The design as it is now.
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// Its panels, in the order of [`Design::panels_to_make`].
    pub fn panels(&self) -> &[LivePanel] {
        &self.panels
    }

    /// Moves one point of a curve, both by their numbers, to another place, mm, and makes the
    /// panels that depend on it as [`Self::follow`] does. Returns the numbers, among
    /// [`Self::panels`], of the panels that were made anew or that failed.
    ///
    /// # Panics
    /// If there is no such curve or point.
    pub fn move_point(
        &mut self,
        curve: usize,
        point: usize,
        to: Point3,
        watch: &mut dyn Watch,
    ) -> Vec<usize> {
        self.design.curves[curve].points[point].at = to;
        self.to_advise = None;
        self.make_changed(watch)
    }

    /// Takes another design in place of this one and makes the panels that depend on the change:
    /// surface, pattern, measures, findings, and a verdict by a formula. Two things are left to
    /// [`Self::settle`]: the verdict by an elastic sheet, with the folds that this needs, and
    /// whether a panel that does not bend would bend better without its plane. Returns the
    /// numbers, among [`Self::panels`], of the panels that were made anew or that failed.
    ///
    /// If the watcher asks to stop, the panels that were not made yet keep their former parts and
    /// are made by the next call; [`LivePanel::is_current`] is false for them.
    pub fn follow(&mut self, design: Design, watch: &mut dyn Watch) -> Vec<usize> {
        if design != self.design {
            self.to_advise = None;
        }
        self.design = design;
        self.make_changed(watch)
    }

    /// Looks for what [`Self::follow`] and [`Self::move_point`] have left; call it
    /// when the hand rests. Returns the numbers of the panels that changed. If the watcher asks to
    /// stop, the next call looks for the rest; [`LivePanel::is_settled`] is true for finished
    /// panels.
    pub fn settle(&mut self, watch: &mut dyn Watch) -> Vec<usize> {
        let mut changed = Vec::new();
        for (n, panel) in self.panels.iter_mut().enumerate() {
            if !panel.is_current() || !panel.is_open() || watch.stop() {
                continue;
            }
            let (Ok(made), Some(known)) = (&mut panel.made, &mut panel.known) else { continue };
            let [part] = &mut made[..] else { continue };
            self.to_advise = None;
            watch.begin(&[&panel.name], Stage::Check);
            match settle(part, known, self.design.material.as_ref(), watch) {
                Ok(false) => continue,
                Ok(true) => {}
                Err(_) if known.is_open() => continue,
                Err(cause) => {
                    panel.made = Err(MakeError::of_panel(&panel.name, cause));
                }
            }
            changed.push(n);
        }
        changed
    }

    /// Calls [`Self::follow`], then [`Self::settle`]. Returns the numbers of the panels that either
    /// changed, in increasing order.
    pub fn update(&mut self, design: Design, watch: &mut dyn Watch) -> Vec<usize> {
        let mut changed = self.follow(design, watch);
        changed.extend(self.settle(watch));
        changed.sort_unstable();
        changed.dedup();
        changed
    }

    /// The outcome of [`super::make`] for the design as it is now without its `vary`; findings left
    /// to [`Self::settle`] are missing. What [`Self::advise`] has found is there, as after
    /// [`Made::advise`].
    ///
    /// # Errors
    /// The first panel that can't be made, and why.
    pub fn made(&self) -> Result<Made, MakeError> {
        if self.design.panels.is_empty() {
            return Err(MakeError::of_design(MakeCause::NoPanels));
        }
        let panels = self.panels.iter().map(|panel| panel.made.clone());
        let mut parts = panels.collect::<Result<Vec<_>, _>>()?.concat();
        let divided = finish(&mut parts, &self.design, false)?;
        for part in &mut parts {
            let advice = self.advice_on(part).cloned();
            advice.into_iter().for_each(|finding| part.checked.add(finding));
        }
        let (name, material) = (self.design.name.clone(), self.design.material.clone());
        let thickness_mm = self.design.sheet_thickness_mm();
        let stock = self.design.stock.clone();
        let wanted = wanted(&self.design, &parts);
        let (moved, nested) = (None, None);
        Ok(Made { name, material, thickness_mm, parts, wanted, moved, stock, divided, nested })
    }

    /// The parts of each panel, or why they can't be made, in the order of [`Self::panels`]:
    /// divided as the sheets of the design ask for, and with its trims and marks, as far as its
    /// panels can be made; `None` of a design without any of these.
    pub fn trimmed(&self) -> Option<Vec<Result<Vec<Part>, MakeError>>> {
        let design = &self.design;
        if design.trims.is_empty() && design.marks.is_empty() && design.stock.is_none() {
            return None;
        }
        let made = self.panels.iter().filter_map(|panel| panel.made.as_ref().ok());
        let mut parts: Vec<Part> = made.flatten().cloned().collect();
        let refused = finish(&mut parts, design, false).err();
        // What is refused of no panel is said at the first.
        let of_error = |error: &MakeError| {
            self.panels.iter().position(|panel| panel.name == error.panel).unwrap_or(0)
        };
        let at = refused.as_ref().map(of_error);
        let mut parts = parts.into_iter().peekable();
        let of_panel = |(n, panel): (usize, &LivePanel)| {
            panel.made.as_ref().map_err(Clone::clone)?;
            let is_of_it = |part: &Part| part.panel == panel.name;
            let made = std::iter::from_fn(|| parts.next_if(is_of_it)).collect();
            match &refused {
                Some(error) if at == Some(n) => Err(error.clone()),
                _ => Ok(made),
            }
        };
        Some(self.panels.iter().enumerate().map(of_panel).collect())
    }

    fn make_changed(&mut self, watch: &mut dyn Watch) -> Vec<usize> {
        let design = &*self.counts.of(&self.design);
        let how = How { judging: Judging::Exact, is_bare: false };
        let maker = Maker::new(design, self.meshes.of(design), how);
        let mut before: Vec<Option<LivePanel>> = self.panels.drain(..).map(Some).collect();
        let (mut panels, mut changed) = (Vec::new(), Vec::new());
        for (n, panel) in design.panels_to_make().into_iter().enumerate() {
            let is_it = |old: &&mut Option<LivePanel>| {
                old.as_ref().is_some_and(|old| old.name == panel.name)
            };
            let old = before.iter_mut().find(is_it).and_then(Option::take);
            let inputs = Inputs::new(&maker, n, panel);
            let same = |old: &LivePanel| old.made_from.as_ref().is_some_and(|i| i.same(&inputs));
            let old = match old {
                Some(old) if same(&old) => {
                    panels.push(old);
                    continue;
                }
                old => old,
            };
            let (was_made, mut known) = match old {
                Some(old) => (Some(old.made), old.known),
                None => (None, None),
            };
            let made = if watch.stop() {
                Err(MakeError::of_panel(&panel.name, TriangulateError::Stopped))
            } else {
                maker.make(n, panel, &mut known, watch)
            };
            let name = panel.name.clone();
            panels.push(if watch.stop() {
                // What came out may be of a part of the work.
                let made = was_made.unwrap_or(made);
                LivePanel { name, made, made_from: None, known, advice: Advice::default() }
            } else {
                changed.push(n);
                let made_from = Some(inputs);
                LivePanel { name, made, made_from, known, advice: Advice::default() }
            });
        }
        self.panels = panels;
        // Of meshes, what one part is called may change the edges of another.
        if !changed.is_empty() {
            self.to_advise = None;
            let made = self.panels.iter_mut().filter_map(|panel| panel.made.as_mut().ok());
            let mut made: Vec<&mut Part> = made.flatten().collect();
            join_meshes(&mut made);
            say_too_large(made.into_iter(), design);
        }
        changed
    }
}
