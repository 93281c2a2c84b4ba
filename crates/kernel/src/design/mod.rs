//! A design: all inputs as one plain value. Nothing is computed here; `sample` takes boundaries
//! from it, `fair` moves its points, `make` derives every stage.

mod bends;
mod dimensions;
mod divide;
mod failure;
mod join;
mod mark;
mod mesh;
mod read_note;
mod scale;
mod shorthand;
mod stock;
mod tolerance;
mod trim;
mod vary;

pub use bends::{AUTO_LINES, AUTO_STEP_DEG, BendMarks, BendRule, Bends, MOST_BEND_LINES};
pub use dimensions::{Dimensions, Thick};
pub use divide::{Divide, DivideJoint};
pub use failure::Failure;
pub use join::Join;
pub use mark::{Axis, Mark, MarkAt, MarkKind, MarkOn, MarkWay, StationPlaces, StationPlane};
pub use mesh::{PanelMesh, Triangles};
pub use read_note::{ReadNote, Unused};
pub use stock::{SheetForm, Stock, StockSheet, Turn};
pub use tolerance::{
    FEWEST_ON_LOOP, FEWEST_ON_RAIL, LOOP_SAMPLES, MOST_BY_TOLERANCE, MOST_USUAL, RAIL_SAMPLES,
    SampleTolerance,
};
pub use trim::{
    Allowance, Corner, Fingers, Flange, Hem, Holes, NotchForm, Notches, Places, Puzzle, Slots,
    Tabs, Ticks, Trim, TrimKind, TrimOn,
};
pub use vary::{MovedBy, Vary, VaryGoal};

use crate::material::Material;
use sheetwright_geometry::boundary::PlaneChoice;
use sheetwright_geometry::curve::{CurveKind, CurvePoint};
use sheetwright_geometry::math::Point3;
use sheetwright_optimum::cost::DEFAULT_FOLD;
use sheetwright_optimum::triangulate::{Goal, WhichSurface};
use std::collections::BTreeSet;

/// A curve of a design, under its name.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignCurve {
    /// Its name; no two curves share one.
    pub name: String,
    /// How its points make the curve; `None` if the points are the samples themselves, with
    /// tangents from central differences.
    pub kind: Option<CurveKind>,
    /// Whether it ends where it begins.
    pub closed: bool,
    /// Its points.
    pub points: Vec<CurvePoint>,
}

/// A curve as a part of a loop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CurveUse {
    /// Its name.
    pub name: String,
    /// Whether it is run from its end to its beginning.
    pub reversed: bool,
}

/// What bounds a panel.
#[derive(Clone, Debug, PartialEq)]
pub enum PanelShape {
    /// Two open curves, which may run either way; straight edges join their ends.
    Rails([CurveUse; 2]),
    /// Curves chained end to end to closed loops.
    Loops {
        /// The outer loop.
        outer: Vec<CurveUse>,
        /// The holes.
        holes: Vec<Vec<CurveUse>>,
    },
    /// Other panels, joined.
    Join(Join),
    /// Nothing: its surface is given as a mesh.
    Mesh(PanelMesh),
}

/// Which triangulations of a panel are looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PanelMethod {
    /// All of them.
    #[default]
    Optimal,
    /// Those whose every triangle has an edge of the boundary.
    Bridge,
    /// Those whose every rung joins the two rails; only for rails.
    Rails,
}

impl PanelMethod {
    /// How designs and reports name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Optimal => "optimal",
            Self::Bridge => "bridge",
            Self::Rails => "rails",
        }
    }
}

/// The least effort of a panel, as a multiple of the default.
pub const LEAST_EFFORT: f64 = 0.001;
/// The greatest effort of a panel, as a multiple of the default: up to an hour and a half.
pub const MOST_EFFORT: f64 = 1000.0;

/// A panel of a design.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignPanel {
    /// Its name, which its files get; no two panels share one.
    pub name: String,
    /// What bounds it.
    pub shape: PanelShape,
    /// Samples of the outer loop, or of each rail; with a tolerance, the fewest. What comes next,
    /// down to `cut`, is for surfaces that are found; a mesh brings its own settings.
    pub samples: usize,
    /// How near the polygon through its samples stays to its curves; `None`: the number of samples
    /// is given.
    pub tolerance: Option<SampleTolerance>,
    /// Which triangulations are looked at.
    pub method: PanelMethod,
    /// What is made as small as can be.
    pub goal: Goal,
    /// Which supporting plane it asks for.
    pub plane: PlaneChoice,
    /// Whether the rails run on beyond their ends, so that rulings may leave the strip there; its
    /// ends are then no longer straight. Only for rails.
    pub run_on: bool,
    /// Whether its edges slide along the boundary while it is bent; between rails, nothing holds
    /// its straight ends then. Else each point of an edge is held where the surface has it.
    pub slides: bool,
    /// The weight ν of the fold price.
    pub fold: f64,
    /// How much work the search may do where there are holes, as a multiple of
    /// `triangulate::DEFAULT_WORK`, within [`LEAST_EFFORT`] ..= [`MOST_EFFORT`].
    pub effort: f64,
    /// Where the pattern is to be cut open if it must be, mm: along the rungs from loop to loop
    /// whose middles lie nearest. Empty: where the cuts are shortest.
    pub cut: Vec<Point3>,
    /// Which surface is meant where two fit the boundary about as well.
    pub which: WhichSurface,
    /// Points that the surface should pass near, mm: they choose between surfaces that fit the
    /// boundary about as well.
    pub near: Vec<Point3>,
    /// How its bends are marked; `None`: as those of the design.
    pub bends: Option<Bends>,
    /// How many of it are cut: 1 or more.
    pub count: u32,
    /// How many of those are turned over.
    pub mirrored: u32,
}

impl DesignPanel {
    /// Whether it is a mesh that was given, rather than a surface to be found.
    pub fn is_mesh(&self) -> bool {
        matches!(self.shape, PanelShape::Mesh(_))
    }

    /// A panel with so many samples, and else with the defaults: the best of all triangulations by
    /// its price with the default fold, on the best-fit plane where there is one, straight ends.
    pub fn new(name: impl Into<String>, shape: PanelShape, samples: usize) -> Self {
        Self {
            name: name.into(),
            shape,
            samples,
            tolerance: None,
            method: PanelMethod::Optimal,
            goal: Goal::Price,
            plane: PlaneChoice::Auto,
            run_on: false,
            slides: false,
            fold: DEFAULT_FOLD,
            effort: 1.0,
            cut: Vec::new(),
            which: WhichSurface::Cheapest,
            near: Vec::new(),
            bends: None,
            count: 1,
            mirrored: 0,
        }
    }
}

/// All inputs of the main job.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Design {
    /// Its name.
    pub name: String,
    /// The sheet it is made from, if one is named.
    pub material: Option<Material>,
    /// The materials that it brings along, in order, each with a name of its own.
    pub materials: Vec<Material>,
    /// Its curves.
    pub curves: Vec<DesignCurve>,
    /// Its panels.
    pub panels: Vec<DesignPanel>,
    /// What may move so that the sheet bends better, one after the other. Where there is none and
    /// some points have a distance by which they may move, those may.
    pub vary: Vec<Vary>,
    /// Whether curves that several panels share get as many samples on each, the most that any of
    /// them gives it, so that both sides of a seam have the same samples. They do in any case where
    /// something moves.
    pub match_seams: bool,
    /// The trade that it is made for, by name, if one is named: its trims, and what its files are
    /// where the fields below leave that open.
    pub trade: Option<String>,
    /// What is done along edges, in order, that of its trade first.
    pub trims: Vec<Trim>,
    /// What is marked on the faces of its parts, in order.
    pub marks: Vec<Mark>,
    /// The name of the preset that its patterns are written for, if it names one: what that is,
    /// writers know.
    pub preset: Option<String>,
    /// The name of the release of its DXF files, if it names one.
    pub dxf: Option<String>,
    /// How near the arcs of DXF files stay to the cut lines that they take the place of, mm, if
    /// they have arcs.
    pub arcs_mm: Option<f64>,
    /// The names of the formats that its files are written in, if it names some.
    pub formats: Vec<String>,
    /// How the bends of panels are marked that do not say it themselves.
    pub bends: Bends,
    /// Which face of the sheet the curves lie on. Default: the pattern is that of the surface
    /// through them, however thick the sheet is.
    pub dimensions: Option<Dimensions>,
    /// How thick the sheet is, mm. Default: as its material.
    pub thickness_mm: Option<f64>,
    /// The inner radius of the tool that makes sharp folds, mm. Default: the smallest bend radius
    /// of the material, if it folds; the thickness, if no material is named.
    pub bend_radius_mm: Option<f64>,
    /// What its parts are cut from, if that is said.
    pub stock: Option<Stock>,
    /// What is to be said of the drawing that it was read from; no file keeps it.
    pub notes: Vec<ReadNote>,
}

impl Design {
    /// How thick the sheet is, mm, if that is known.
    pub fn sheet_thickness_mm(&self) -> Option<f64> {
        let of_material = self.material.as_ref().map(|material| material.thickness_mm.value);
        self.thickness_mm.or(of_material)
    }

    /// The thickness of the sheet and the face that was drawn; `None` where one of both is not
    /// known, and the pattern is that of the surface as it was drawn.
    pub fn thick(&self) -> Option<Thick> {
        let (dimensions, thickness_mm) = (self.dimensions?, self.sheet_thickness_mm()?);
        let fold_radius_mm = self.bend_radius_mm.or(match &self.material {
            Some(material) => material.folds().then_some(material.bend_radius_mm.value),
            None => Some(thickness_mm),
        });
        Some(Thick { dimensions, thickness_mm, fold_radius_mm })
    }

    /// How the bends of a panel are marked.
    pub fn bends_of(&self, panel: &DesignPanel) -> Bends {
        panel.bends.unwrap_or(self.bends)
    }

    /// The panels that are made, in order: all but those that a join takes the place of.
    pub fn panels_to_make(&self) -> Vec<&DesignPanel> {
        let mut replaced: BTreeSet<&str> = BTreeSet::new();
        let mut kept: BTreeSet<&str> = BTreeSet::new();
        for panel in &self.panels {
            if let PanelShape::Join(join) = &panel.shape {
                let names = if join.keep_parts { &mut kept } else { &mut replaced };
                names.extend(join.parts.iter().map(String::as_str));
            }
        }
        // A join is no part of another, whatever is written there; making it says so.
        let is_made = |panel: &&DesignPanel| {
            let name = panel.name.as_str();
            let is_join = matches!(panel.shape, PanelShape::Join(_));
            is_join || !replaced.contains(name) || kept.contains(name)
        };
        self.panels.iter().filter(is_made).collect()
    }
}

/// The curves that bound a panel, or the panels that it joins.
pub(crate) fn used<'a>(
    design: &'a Design,
    shape: &'a PanelShape,
) -> impl Iterator<Item = &'a DesignCurve> {
    fn names(shape: &PanelShape) -> Vec<&str> {
        match shape {
            PanelShape::Rails(rails) => rails.iter().map(|rail| rail.name.as_str()).collect(),
            PanelShape::Loops { outer, holes } => {
                let uses = std::iter::once(outer).chain(holes).flatten();
                uses.map(|part| part.name.as_str()).collect()
            }
            PanelShape::Join(_) | PanelShape::Mesh(_) => Vec::new(),
        }
    }
    let names = match shape {
        PanelShape::Join(join) => {
            let parts = design.panels.iter().filter(|panel| join.parts.contains(&panel.name));
            parts.flat_map(|part| names(&part.shape)).collect()
        }
        _ => names(shape),
    };
    design.curves.iter().filter(move |curve| names.contains(&curve.name.as_str()))
}
