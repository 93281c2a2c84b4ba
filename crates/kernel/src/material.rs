//! Materials: the limits of a sheet, with which the verdict compares a panel.
//!
//! A material is data that comes with a design. The kernel names no material: the catalogue is a
//! file (`materials.json` in the crate `sheetwright-files`), and designs bring their own. Every
//! number has its source, so that a reader of a verdict can judge the limit.

use sheetwright_geometry::math::{cos, from_deg, sin};

/// The source of a number that has none.
pub const ASSUMED: &str = "assumed";

/// A number and its source.
#[derive(Clone, Debug, PartialEq)]
pub struct Sourced {
    /// The number, in the unit of its field.
    pub value: f64,
    /// A publication, a data sheet or a measurement; begins with [`ASSUMED`] where there is none.
    pub source: String,
}

impl Sourced {
    /// A number without a source.
    pub fn assumed(value: f64) -> Self {
        Self { value, source: ASSUMED.to_owned() }
    }
}

/// A sheet of one material and one thickness.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// How designs name it.
    pub name: String,
    /// The name for people.
    pub title: String,
    /// Thickness, mm.
    pub thickness_mm: Sourced,
    /// The smallest bend radius, mm.
    pub bend_radius_mm: Sourced,
    /// The largest warp angle that it takes, degrees.
    pub warp_limit_deg: Sourced,
    /// The largest strain within its plane, in tension and compression, as a share. Of a metal: the
    /// yield stress over Young's modulus.
    pub stretch_limit: Sourced,
    /// Young's modulus, N/mm². Of plywood and veneer: the mean of along and across the grain.
    pub modulus_n_per_mm2: Option<Sourced>,
    /// Poisson's number: the share of a strain by which the sheet narrows crosswise.
    pub poisson: Option<Sourced>,
    /// The strain of the outer fibre from which the sheet keeps its bend, as a share. `None` if it
    /// springs back until it breaks, as plywood does, or if it is unknown.
    pub yield_strain: Option<Sourced>,
    /// Mass per volume, kg/m³.
    pub density_kg_per_m3: Option<Sourced>,
    /// Where the neutral fibre of a bend lies.
    pub k_factors: Option<KFactors>,
    /// By how much bends shorten the flat sheet, as measured at a brake; it goes before K-factors.
    pub deductions: Option<Deductions>,
    /// Bending along and across the grain, of a sheet for which that differs. `bend_radius_mm` and
    /// `modulus_n_per_mm2` are those of the verdict.
    pub grain: Option<Grain>,
}

/// K-factors by the ANSI convention: the depth of the neutral fibre below the inner face, over the
/// thickness.
#[derive(Clone, Debug, PartialEq)]
pub struct KFactors {
    /// The K-factors of several bends, by increasing radius; at least one.
    pub rows: Vec<KFactor>,
    /// As in [`Sourced`].
    pub source: String,
}

impl KFactors {
    /// K at an inner radius over the thickness: between two rows in proportion, beyond the first
    /// and the last as there, as FreeCAD's SheetMetal has it.
    pub fn at(&self, radius_per_thickness: f64) -> f64 {
        let after =
            self.rows.partition_point(|row| row.radius_per_thickness < radius_per_thickness);
        match (after.checked_sub(1).map(|n| self.rows[n]), self.rows.get(after)) {
            (Some(from), Some(to)) => {
                let step = to.radius_per_thickness - from.radius_per_thickness;
                let share = (radius_per_thickness - from.radius_per_thickness) / step;
                from.k + (to.k - from.k) * share
            }
            (Some(only), None) => only.k,
            (None, Some(only)) => only.k,
            (None, None) => 0.5,
        }
    }
}

/// Bend deductions: by how much the flat sheet is shorter than both flanges together, each measured
/// from its end to where the outer faces meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Deductions {
    /// The deductions of several bends, by increasing radius and then by increasing angle.
    pub rows: Vec<Deduction>,
    /// As in [`Sourced`].
    pub source: String,
}

/// The deduction of one bend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deduction {
    /// The inner radius of the bend, mm.
    pub radius_mm: f64,
    /// By how much the flat sheet is turned, degrees, above 0 and below 180.
    pub angle_deg: f64,
    /// How much shorter the flat sheet is, mm.
    pub deduction_mm: f64,
}

impl Deduction {
    /// The bend allowance that it says, mm, of a sheet of a thickness, mm.
    pub fn allowance_mm(&self, thickness_mm: f64) -> f64 {
        2.0 * setback_mm(from_deg(self.angle_deg), self.radius_mm + thickness_mm)
            - self.deduction_mm
    }
}

/// Rows of a table of deductions whose radii differ by less than this share are of one tool.
const SAME_RADIUS: f64 = 1e-3;

impl Deductions {
    /// The bend allowance, mm, of a bend by an angle, radians, with a tool of this inner radius,
    /// mm, in a sheet of a thickness, mm; `None` if the table has no row of that radius. Allowances
    /// are nearly in proportion to the angle, so between two angles, and from none to the first,
    /// they are taken in proportion; beyond the last as it says.
    pub fn allowance_mm(&self, angle: f64, radius_mm: f64, thickness_mm: f64) -> Option<f64> {
        let is_of_tool =
            |row: &&Deduction| (row.radius_mm - radius_mm).abs() <= SAME_RADIUS * radius_mm;
        let (mut before, mut last) = ([0.0; 2], None);
        for row in self.rows.iter().filter(is_of_tool) {
            let here = [from_deg(row.angle_deg), row.allowance_mm(thickness_mm)];
            if angle <= here[0] {
                let share = (angle - before[0]) / (here[0] - before[0]);
                return Some(before[1] + (here[1] - before[1]) * share);
            }
            (before, last) = (here, Some(here));
        }
        last.map(|[last, allowance_mm]| allowance_mm * angle / last)
    }
}

/// The setback of a bend by an angle, radians, mm: how far its tangent lines lie from where the two
/// faces of this radius, mm, would meet if they went straight on.
pub fn setback_mm(angle: f64, radius_mm: f64) -> f64 {
    radius_mm * sin(0.5 * angle.abs()) / cos(0.5 * angle)
}

/// The bend allowance, mm: how much of the flat sheet a bend takes, by an angle, radians, at an
/// inner radius, mm, of a sheet of a thickness, mm, with this K.
pub fn bend_allowance_mm(angle: f64, radius_mm: f64, thickness_mm: f64, k: f64) -> f64 {
    angle.abs() * (radius_mm + k * thickness_mm)
}

/// The K-factor of one bend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KFactor {
    /// The inner radius of the bend over the thickness.
    pub radius_per_thickness: f64,
    /// The depth of the neutral fibre over the thickness: 0 at the inner face, 0.5 in the middle.
    pub k: f64,
}

/// How a sheet bends in two directions: along and across the grain of its face. The direction is
/// that which becomes curved. A tube bent across the grain has the fibres of its face parallel to
/// its axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Grain {
    /// The fibres of the face become curved.
    pub along: GrainBending,
    /// The fibres of the face stay straight.
    pub across: GrainBending,
}

/// How a sheet bends in one direction.
#[derive(Clone, Debug, PartialEq)]
pub struct GrainBending {
    /// Young's modulus in bending, N/mm².
    pub modulus_n_per_mm2: Sourced,
    /// The smallest bend radius, mm.
    pub bend_radius_mm: Sourced,
}

/// The largest warp angle of an unknown sheet, degrees: metal shipbuilding \[ZB18\]. A warp angle
/// along a ruling means that the sheet must stretch there.
pub const DEFAULT_WARP_LIMIT_DEG: f64 = 6.0;

/// The largest strain of an unknown sheet within its plane, as a share: a millimetre in a metre,
/// about where metal stops springing back. Assumed, not looked up; equal to
/// [`sheetwright_geometry::tolerance::Tolerance::MOST_STRETCH`].
pub const DEFAULT_STRETCH_LIMIT: f64 = 1e-3;

/// The plastic moment of a plate over that at which it begins to yield.
const PLASTIC: f64 = 1.5;

/// Up to this share of its limit, a sheet takes its shape without force; above it, with force. A
/// third: a choice, not a measurement, so that a warning comes well before the limit.
pub const EASY_SHARE: f64 = 1.0 / 3.0;

/// The thickness of an unknown sheet, as a share of the side of a square with its area: a
/// millimetre for a square metre. Assumed, so that the verdict on a shape does not depend on its
/// unit.
const THICKNESS_BY_SIDE: f64 = 1e-3;

/// The most thickness of an unknown sheet, as a share of the radius that it is bent to: who makes a
/// narrow tube takes a sheet that can be bent so. Its outer fibre stretches by 1 % then. Assumed.
const THICKNESS_BY_RADIUS: f64 = 0.02;

/// Poisson's number of an unknown sheet: between wood and metal, 0.3. Strains hardly depend on it.
const DEFAULT_POISSON: f64 = 0.3;

/// A sheet whose smallest bend radius exceeds this many thicknesses is taken to break when it is
/// folded: between solid board (10) and plywood (96), nearer to the board.
const MOST_THICKNESSES: f64 = 10.0;

impl Material {
    /// Whether it takes a sharp fold along a scored line: not plywood, whose bend radius is a
    /// hundred times its thickness.
    pub fn folds(&self) -> bool {
        self.bend_radius_mm.value <= MOST_THICKNESSES * self.thickness_mm.value
    }
}

/// The largest warp angle that is accepted, degrees: the material's, or the default without one.
pub fn warp_limit_deg(material: Option<&Material>) -> f64 {
    material.map_or(DEFAULT_WARP_LIMIT_DEG, |m| m.warp_limit_deg.value)
}

/// The largest strain of a sheet within its plane, as a share: the material's, or the default
/// without one.
pub fn stretch_limit(material: Option<&Material>) -> f64 {
    material.map_or(DEFAULT_STRETCH_LIMIT, |m| m.stretch_limit.value)
}

/// What a sheet is and takes, for the prediction of its strain: the material's numbers, or the
/// defaults without one.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// The title of the material, if one is named.
    pub sheet: Option<String>,
    /// Thickness, mm.
    pub thickness_mm: f64,
    /// Young's modulus, N/mm², if it is known.
    pub modulus_n_per_mm2: Option<f64>,
    /// Poisson's number.
    pub poisson: f64,
    /// The largest strain within its plane, as a share.
    pub strain: f64,
    /// The largest strain of the outer fibre, as a share: that at the smallest bend radius. `None`
    /// without a material.
    pub outer_fibre: Option<f64>,
    /// The strain of the outer fibre from which it keeps its bend, as a share, if it does so.
    pub yields: Option<f64>,
    /// The moment that a bend takes, as a share of that of a sheet that does not yield.
    pub moment_share: f64,
    /// Whether it takes a sharp fold along a scored line, as [`Material::folds`] says; an unknown
    /// sheet does.
    pub folds: bool,
}

impl Limits {
    /// Those of a material, or of an unknown one for a part of this area, mm², and this curvature,
    /// 1/mm.
    pub fn of(material: Option<&Material>, area_mm2: f64, curvature: f64) -> Self {
        let unknown_mm = (THICKNESS_BY_SIDE * area_mm2.sqrt()).min(THICKNESS_BY_RADIUS / curvature);
        let thickness_mm = material.map_or(unknown_mm, |m| m.thickness_mm.value);
        let value = |number: &Option<Sourced>| number.as_ref().map(|number| number.value);
        let poisson = material.and_then(|m| value(&m.poisson));
        Self {
            sheet: material.map(|m| m.title.clone()),
            thickness_mm,
            modulus_n_per_mm2: material.and_then(|m| value(&m.modulus_n_per_mm2)),
            poisson: poisson.unwrap_or(DEFAULT_POISSON),
            strain: stretch_limit(material),
            outer_fibre: material.map(|m| 0.5 * thickness_mm / m.bend_radius_mm.value),
            yields: material.and_then(|m| value(&m.yield_strain)),
            moment_share: 1.0,
            folds: material.is_none_or(Material::folds),
        }
    }

    /// Those of a sheet of the same material in another thickness, mm, which bends to as many times
    /// its thickness.
    pub fn in_thickness(&self, thickness_mm: f64) -> Self {
        Self { thickness_mm, ..self.clone() }
    }

    /// The strain of the outer fibre, as a share, where the sheet has this curvature, 1/mm.
    pub fn outer_fibre_at(&self, curvature: f64) -> f64 {
        0.5 * self.thickness_mm * curvature
    }

    /// The least radius that it is bent to, mm, if a material tells.
    pub fn bend_radius_mm(&self) -> Option<f64> {
        self.outer_fibre.map(|limit| self.outer_fibre_at(1.0) / limit)
    }

    /// Whether its outer fibre yields where the sheet has this curvature, 1/mm.
    pub fn yields_at(&self, curvature: f64) -> bool {
        self.yields.is_some_and(|most| self.outer_fibre_at(curvature) > most)
    }

    /// The curvature at which an elastic sheet would take the plastic moment of this one, 1/mm;
    /// infinite of one that does not yield.
    pub fn plastic_curvature(&self) -> f64 {
        let of = |yields: f64| PLASTIC * yields / self.outer_fibre_at(1.0);
        self.yields.map_or(f64::INFINITY, of)
    }

    /// How much of what it takes a strain in the plane and a curvature, 1/mm, use: 1 is the limit.
    pub fn use_of(&self, strain: f64, curvature: f64) -> f64 {
        let bent = self.outer_fibre.map_or(0.0, |limit| self.outer_fibre_at(curvature) / limit);
        (strain / self.strain).max(bent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_geometry::math::to_deg;

    fn sheet(thickness_mm: f64, bend_radius_mm: f64) -> Material {
        Material {
            name: "sheet".to_owned(),
            title: "a sheet".to_owned(),
            thickness_mm: Sourced::assumed(thickness_mm),
            bend_radius_mm: Sourced::assumed(bend_radius_mm),
            warp_limit_deg: Sourced::assumed(12.0),
            stretch_limit: Sourced::assumed(0.02),
            modulus_n_per_mm2: None,
            poisson: None,
            yield_strain: None,
            density_kg_per_m3: None,
            k_factors: None,
            deductions: None,
            grain: None,
        }
    }

    #[test]
    fn what_is_bent_tightly_folds() {
        assert!(sheet(1.5, 15.0).folds());
        // Ten thicknesses to the last bit, which quotients miss.
        assert!(Limits::of(Some(&sheet(0.01, 0.1)), 1.0, 0.0).folds);
        assert!(!sheet(3.0, 290.0).folds());
    }

    /// The example of a table and the test case in the README of FreeCAD's SheetMetal workbench.
    #[test]
    fn k_factors_and_allowances_are_those_of_a_worked_example() {
        let row = |(radius_per_thickness, k)| KFactor { radius_per_thickness, k };
        let rows = [(1.0, 0.38), (3.0, 0.43), (99.0, 0.5)].map(row).to_vec();
        let table = KFactors { rows, source: ASSUMED.to_owned() };
        for (ratio, k) in [(0.82, 0.38), (1.0, 0.38), (2.0, 0.405), (51.0, 0.465), (1e4, 0.5)] {
            assert!((table.at(ratio) - k).abs() < 1e-12, "{ratio}");
        }
        let (thickness_mm, radius_mm, flange_mm) = (2.0, 1.64, 51.76);
        let k = table.at(radius_mm / thickness_mm);
        let right_angle = std::f64::consts::FRAC_PI_2;
        let allowance_mm = bend_allowance_mm(right_angle, radius_mm, thickness_mm, k);
        // Up to where the bend begins, and half of the bend: the mould line.
        let leg_mm = flange_mm - radius_mm - thickness_mm;
        assert!((leg_mm - 48.12).abs() < 1e-9);
        assert!((leg_mm + 0.5 * allowance_mm - 50.0).abs() < 0.01);
    }

    /// Deductions of 90° and 45° at R 2 and T 2, as K = 0.44 makes them; the allowance in between
    /// is that of the same K.
    #[test]
    fn deductions_say_the_allowance_of_their_tool() {
        let right = std::f64::consts::FRAC_PI_2;
        let row = |angle: f64| {
            let allowance_mm = bend_allowance_mm(angle, 2.0, 2.0, 0.44);
            let deduction_mm = 2.0 * setback_mm(angle, 4.0) - allowance_mm;
            Deduction { radius_mm: 2.0, angle_deg: to_deg(angle), deduction_mm }
        };
        let rows = vec![row(0.5 * right), row(right)];
        assert!((rows[1].deduction_mm - 3.476_106_579).abs() < 1e-9, "{}", rows[1].deduction_mm);
        let table = Deductions { rows, source: ASSUMED.to_owned() };
        for angle in [0.1, 0.5 * right, 1.0, right, 2.0] {
            let found = table.allowance_mm(angle, 2.0, 2.0).unwrap();
            assert!((found - angle * 2.88).abs() < 1e-12, "{angle}: {found}");
        }
        assert_eq!(table.allowance_mm(right, 3.0, 2.0), None);
    }

    #[test]
    fn limits_are_those_of_the_material_or_the_default() {
        let cloth = sheet(0.5, 0.5);
        assert_eq!((warp_limit_deg(Some(&cloth)), stretch_limit(Some(&cloth))), (12.0, 0.02));
        assert_eq!(warp_limit_deg(None), DEFAULT_WARP_LIMIT_DEG);
        assert_eq!(stretch_limit(None), DEFAULT_STRETCH_LIMIT);
    }
}
