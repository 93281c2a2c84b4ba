//! From a design to parts with everything that is derived from them: [`make`] and, while a design
//! is edited, [`Live`].
//!
//! A panel that is bounded by curves becomes one part (`found`), a mesh one or several
//! (`mesh`). Joined edges and their marks, which depend on other parts, come last (`joined`), after
//! parts that are larger than the sheet are divided (`divided`). The order in which a builder joins
//! them is `joining_order`; where they lie on sheets, `nested`.

mod batch;
mod candidate;
mod cleaned;
mod cut_list;
mod cut_once;
mod divided;
mod division;
mod error;
mod facets;
mod found;
mod joined;
mod joining_order;
mod judged;
mod laid;
mod live;
mod marked;
mod mesh;
mod nested;
mod on_sheets;
mod opened;
mod other;
mod part;
mod read_notes;
mod rebuilt;
mod seams;
mod skins;
mod strained;
mod together;
mod trimmed;
mod truest;
mod unrestricted;

pub use batch::{PanelRow, PanelValues, make_rows};
pub use cut_list::CutItem;
pub use divided::DividedPart;
pub use error::{MakeCause, MakeError};
pub use joining_order::{Join, JoiningStep};
pub use live::{Live, LivePanel};
pub use nested::{NestItem, Nested};
pub use on_sheets::beside_each_other;
pub use part::{Change, Found, Given, Joint, Origin, Other, Part};
pub use rebuilt::Rebuilt;

use crate::design::{Design, DesignPanel, PanelShape, Stock};
use crate::fair::varied_design;
use crate::material::Material;
use crate::pattern::Quantity;
use crate::sample::{Matched, Sampler, counted, matched};
use cleaned::{Cleaned, cleaned};
use divided::divide_parts;
use division::may_help;
use facets::say_too_large;
use found::make_found;
use joined::{find_mates, join_meshes};
use judged::{is_screened, judge};
use marked::mark_parts;
use mesh::make_mesh;
use read_notes::say_notes;
use sheetwright_geometry::watch::{Stage, Watch};
use sheetwright_optimum::triangulate::TriangulateError;
use strained::aimed_by_angles;
use together::{advise_all, judge_all};
use trimmed::trim_parts;
use unrestricted::Known;

/// A design with everything that was derived from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Made {
    /// Its name.
    pub name: String,
    /// The material of the sheet, if one is named.
    pub material: Option<Material>,
    /// How thick the sheet is, mm, if that is known.
    pub thickness_mm: Option<f64>,
    /// Its parts, panel after panel in the order of the design, without panels that a join
    /// replaces.
    pub parts: Vec<Part>,
    /// How many of each part its panel asks for, and how many of those turned over.
    pub wanted: Vec<Quantity>,
    /// The design with its points moved, if any were: making it gives these parts.
    pub moved: Option<Design>,
    /// What its parts are cut from, if that is said.
    pub stock: Option<Stock>,
    /// The parts that were divided since they are larger than every sheet.
    pub divided: Vec<DividedPart>,
    /// Where they lie on it, once they are laid out.
    pub nested: Option<Nested>,
}

/// What a verdict comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judging {
    /// A formula, true within a factor of two: "probably". Nor are other surfaces looked for that
    /// fit a boundary.
    Quick,
    /// The formula; an elastic sheet where that factor decides whether the sheet takes the shape,
    /// and for meshes.
    Auto,
    /// An elastic sheet, some hundredths of a second for each part.
    Exact,
}

/// Makes a design: the surface, the flat pattern, the measures and the verdict of every part.
///
/// # Errors
/// The first panel or curve that can't be made, and why.
pub fn make(design: &Design, watch: &mut dyn Watch) -> Result<Made, MakeError> {
    make_judged(design, Judging::Exact, watch)
}

/// Makes a design as [`make`] does, with verdicts that come from a formula or an elastic sheet.
///
/// # Errors
/// The first panel or curve that can't be made, and why.
pub fn make_judged(
    design: &Design,
    judging: Judging,
    watch: &mut dyn Watch,
) -> Result<Made, MakeError> {
    make_with(design, How { judging, is_bare: false }, watch)
}

/// How a design is made.
#[derive(Clone, Copy)]
struct How {
    /// What the verdicts come from.
    judging: Judging,
    /// Whether patterns have no texts, where values alone are read: placing texts takes as long as
    /// finding a surface.
    is_bare: bool,
}

fn make_with(design: &Design, how: How, watch: &mut dyn Watch) -> Result<Made, MakeError> {
    if design.panels.is_empty() {
        return Err(MakeError::of_design(MakeCause::NoPanels));
    }
    let design = counted(design);
    let (design, wanted) = &aimed_by_angles(&design, how, watch)?;
    let varied = varied_design(design, watch)?;
    let made_from = varied.as_ref().map_or(&**design, |varied| &varied.after);
    let mut parts = make_panels(made_from, |_| true, how, watch)?;
    let mut moved = None;
    if let Some(varied) = varied {
        let shifts = &varied.shifts;
        let is_shifted = |panel: &DesignPanel| shifts.contains_key(&panel.name);
        for before in make_panels(&varied.before, is_shifted, how, watch)? {
            let part = parts.iter_mut().find(|part| part.name == before.name);
            if let (Some(part), Some(shift)) = (part, shifts.get(&before.name)) {
                let change = Change::new(before, shift);
                if let Some(said) = change.said(part) {
                    part.checked.add(crate::check::moved(&said));
                }
                if let Origin::Found(found) = &mut part.origin {
                    found.change = Some(change);
                }
            }
        }
        let is_moved = shifts.values().any(|shift| shift.is_moved());
        // As many samples as they have now, wherever their points lie.
        let fixed = |panel: DesignPanel| DesignPanel { tolerance: None, ..panel };
        let panels = varied.after.panels.into_iter().map(fixed).collect();
        moved = is_moved.then_some(Design { panels, ..varied.after });
    }
    wanted.iter().for_each(|wanted| wanted.say_missed(&mut parts));
    join_meshes(&mut parts.iter_mut().collect::<Vec<_>>());
    let divided = finish(&mut parts, design, how.is_bare)?;
    let (name, material) = (design.name.clone(), design.material.clone());
    let thickness_mm = design.sheet_thickness_mm();
    let stock = design.stock.clone();
    let wanted = cut_list::wanted(design, &parts);
    let nested = None;
    Ok(Made { name, material, thickness_mm, parts, wanted, moved, stock, divided, nested })
}

/// What depends on all parts of a design: those that are too large are divided, edges get their
/// mates, and patterns their trims, marks and, unless they are bare, texts. Returns what was
/// divided.
///
/// # Errors
/// The first trim or mark that can't be made.
fn finish(
    parts: &mut Vec<Part>,
    design: &Design,
    is_bare: bool,
) -> Result<Vec<DividedPart>, MakeError> {
    say_notes(parts, &design.notes);
    let (divided, of_joints) = divide_parts(parts, design);
    find_mates(parts);
    let trims = [&design.trims[..], &of_joints].concat();
    trim_parts(parts, &trims)?;
    say_too_large(parts.iter_mut(), design);
    mark_parts(parts, &design.marks, is_bare)?;
    Ok(divided)
}

/// The inputs that the panels of a design share.
struct Maker<'a> {
    design: &'a Design,
    matched: Matched,
    /// The meshes of the panels that are to be made.
    meshes: Vec<Option<Cleaned>>,
    /// The verdicts on meshes are made so; those on boundaries come later.
    how: How,
}

impl<'a> Maker<'a> {
    fn new(design: &'a Design, meshes: Vec<Option<Cleaned>>, how: How) -> Self {
        Self { design, matched: matched(design), meshes, how }
    }

    fn sampler(&self) -> Sampler<'_> {
        Sampler { design: self.design, matched: &self.matched }
    }

    /// Makes one panel, the `number`-th of those that are to be made. `known` holds its
    /// triangulation from the last time it was made, and then the new one, with a question that may
    /// be open. A mesh without a component that is large enough to be sheet gives no parts.
    fn make(
        &self,
        number: usize,
        panel: &DesignPanel,
        known: &mut Option<Known>,
        watch: &mut dyn Watch,
    ) -> Result<Vec<Part>, MakeError> {
        let PanelShape::Mesh(settings) = &panel.shape else {
            let made = make_found(&self.sampler(), panel, self.how.is_bare, known, watch);
            return made.map(|part| vec![part]);
        };
        *known = None;
        let Some(mesh) = &self.meshes[number] else { return Ok(Vec::new()) };
        make_mesh(self.design, panel, settings, mesh, self.how.judging, watch)
    }
}

/// Most parts of a design for which a division is looked for.
pub const MOST_ADVISED: usize = 8;

impl Made {
    /// Adds a finding to parts that will not bend although their sheets were computed: where to
    /// divide them so that their parts bend, or that no such division was found. That takes up to a
    /// second or two each, so it is done for the first [`MOST_ADVISED`] of them; pieces of a
    /// divided part are left out. If the watcher asks to stop, some findings are missing.
    pub fn advise(&mut self, watch: &mut dyn Watch) {
        let Self { parts, divided, material, .. } = self;
        let is_piece = |part: &Part| {
            divided.iter().flat_map(|whole| &whole.pieces).any(|(name, _)| *name == part.name)
        };
        let whole = parts.iter_mut().filter(|part| may_help(part) && !is_piece(part));
        advise_all(whole.take(MOST_ADVISED).collect(), material.as_ref(), watch);
    }
}

/// Looks for what was left open when a part was made: the strain of an elastic sheet, whether it
/// bends better without its plane, and whether another surface fits its boundary. Returns whether
/// the part changed. Where it is stopped, the rest stays open.
fn settle(
    part: &mut Part,
    known: &mut Known,
    material: Option<&Material>,
    watch: &mut dyn Watch,
) -> Result<bool, MakeCause> {
    let was_screened = is_screened(part);
    if was_screened && judge(part, material, watch) {
        return Ok(false);
    }
    match known.answer(part, Judging::Exact, material, watch) {
        // It was judged, whatever else stays open.
        Err(stopped) if was_screened && stopped == TriangulateError::Stopped.into() => Ok(true),
        answered => Ok(answered? || was_screened),
    }
}

fn make_panels(
    design: &Design,
    wanted: impl Fn(&DesignPanel) -> bool,
    how: How,
    watch: &mut dyn Watch,
) -> Result<Vec<Part>, MakeError> {
    let maker = Maker::new(design, cleaned(design), how);
    let judging = how.judging;
    let material = design.material.as_ref();
    let mut parts: Vec<Part> = Vec::new();
    // The parts with a question that may be open, by their numbers.
    let mut open: Vec<(usize, Known)> = Vec::new();
    for (number, panel) in design.panels_to_make().into_iter().enumerate() {
        if !wanted(panel) {
            continue;
        }
        let mut known = None;
        let made = maker.make(number, panel, &mut known, watch)?;
        open.extend(known.map(|known| (parts.len(), known)));
        parts.extend(made);
    }
    if judging == Judging::Quick {
        return Ok(parts);
    }
    let names: Vec<String> = parts.iter().map(|part| part.panel.clone()).collect();
    watch.begin(&names.iter().map(|name| &name[..]).collect::<Vec<_>>(), Stage::Check);
    judge_all(&mut parts, judging, material, watch);
    for (number, mut known) in open {
        let part = &mut parts[number];
        let answered = known.answer(part, judging, material, watch);
        answered.map_err(|cause| MakeError::of_panel(&part.panel, cause))?;
    }
    Ok(parts)
}
