//! Materials between their file and the kernel: ranges, sources and defaults.

use super::file::{
    DeductionsFile, GrainBendingFile, GrainFile, KFactorsFile, MaterialFile, NumberFile,
    SourcedFile,
};
use crate::json::{Named, Object};
use crate::names::{refused_anywhere, shown};
use sheetwright::material::{
    ASSUMED, DEFAULT_STRETCH_LIMIT, DEFAULT_WARP_LIMIT_DEG, Deduction, Deductions, Grain,
    GrainBending, KFactor, KFactors, Material, Sourced,
};
use std::ops::RangeInclusive;

/// The numbers that a field takes.
struct Bounds {
    range: RangeInclusive<f64>,
    /// As it follows a number.
    unit: &'static str,
}

/// Thicknesses from a thousandth of a millimetre to a metre: a number beyond was meant in another
/// unit.
const THICKNESS: Bounds = Bounds { range: 0.001..=1000.0, unit: " mm" };
/// Bend radii up to a kilometre: a larger one forbids every bend.
const BEND_RADIUS: Bounds = Bounds { range: 0.001..=1e6, unit: " mm" };
/// Warp angles up to a right angle: rungs hardly turn by more.
const WARP_LIMIT: Bounds = Bounds { range: 0.01..=90.0, unit: "°" };
/// Strains, as shares of a length, up to all of it.
const STRAIN: Bounds = Bounds { range: 1e-6..=1.0, unit: "" };
/// Young's moduli from far below foam to above diamond, the stiffest.
const MODULUS: Bounds = Bounds { range: 0.001..=2e6, unit: " N/mm²" };
/// Poisson's numbers up to just below 0.5, at which the volume stays and stiffness is infinite.
const POISSON: Bounds = Bounds { range: 0.0..=0.499, unit: "" };
/// Densities from below foam to above osmium, the heaviest.
const DENSITY: Bounds = Bounds { range: 1.0..=30_000.0, unit: " kg/m³" };
/// Inner radii over thicknesses: above the largest, K is 0.5.
const RADIUS_PER_THICKNESS: RangeInclusive<f64> = 0.0..=10_000.0;
/// K-factors by the ANSI convention are at most 0.5; measured ones scatter above.
const K_FACTOR: RangeInclusive<f64> = 0.05..=0.6;
/// The most rows of a table of K-factors.
const MAX_K_FACTORS: usize = 100;
/// Inner radii of the tools of deductions, mm.
const DEDUCTION_RADIUS: RangeInclusive<f64> = 0.0..=1000.0;
/// Angles of deductions, degrees: a hem, which is turned by more, has no outer corner.
const DEDUCTION_ANGLE: RangeInclusive<f64> = 0.1..=170.0;
/// The most rows of a table of deductions.
const MAX_DEDUCTIONS: usize = 1000;

/// How to mend a source that is empty.
const SOURCE_HINT: &str = "Say where the number comes from, or write the number alone.";

/// How an error is made of a JSON path, what is wrong, and what to do.
pub(crate) type Refuse<'a, E> = &'a dyn Fn(&str, String, &str) -> E;

/// The materials of an object, in its order.
pub(crate) fn materials_in<E>(
    list: Named<MaterialFile>,
    refuse: Refuse<'_, E>,
) -> Result<Vec<Material>, E> {
    let read = |(name, file): (String, MaterialFile)| {
        if let Some(why) = refused_anywhere(&name) {
            let message = format!("the material's name {} {why}", shown(&name));
            return Err(refuse("materials", message, "Give it a short name in one line."));
        }
        let path = format!("materials.{name}");
        material(name, file, &path, refuse)
    };
    list.0.into_iter().map(read).collect()
}

/// A material of what stands at a path.
pub(crate) fn material<E>(
    name: String,
    file: MaterialFile,
    path: &str,
    refuse: Refuse<'_, E>,
) -> Result<Material, E> {
    if let Some((title, why)) = file.title.as_deref().and_then(|t| Some((t, refused_anywhere(t)?)))
    {
        let message = format!("the title {} {why}", shown(title));
        return Err(refuse(
            &format!("{path}.title"),
            message,
            "Give it a short title in one line.",
        ));
    }
    let at = Place { path, refuse };
    let warp = file.warp_limit_deg.unwrap_or(NumberFile::Bare(DEFAULT_WARP_LIMIT_DEG));
    let stretch = file.stretch_limit.unwrap_or(NumberFile::Bare(DEFAULT_STRETCH_LIMIT));
    let thickness = at.number("thickness_mm", file.thickness_mm, &THICKNESS)?;
    let deductions = file.deductions.map(|Object(table)| at.deductions(table, thickness.value));
    Ok(Material {
        deductions: deductions.transpose()?,
        thickness_mm: thickness,
        bend_radius_mm: at.number("bend_radius_mm", file.bend_radius_mm, &BEND_RADIUS)?,
        warp_limit_deg: at.number("warp_limit_deg", warp, &WARP_LIMIT)?,
        stretch_limit: at.number("stretch_limit", stretch, &STRAIN)?,
        modulus_n_per_mm2: at.known("modulus_n_per_mm2", file.modulus_n_per_mm2, &MODULUS)?,
        poisson: at.known("poisson", file.poisson, &POISSON)?,
        yield_strain: at.known("yield_strain", file.yield_strain, &STRAIN)?,
        density_kg_per_m3: at.known("density_kg_per_m3", file.density_kg_per_m3, &DENSITY)?,
        k_factors: file.k_factors.map(|Object(k)| at.k_factors(k)).transpose()?,
        grain: file.grain.map(|Object(grain)| at.grain(grain)).transpose()?,
        title: file.title.unwrap_or_else(|| name.clone()),
        name,
    })
}

/// Where a material stands, and how its errors are made.
struct Place<'a, E> {
    path: &'a str,
    refuse: Refuse<'a, E>,
}

impl<E> Place<'_, E> {
    /// The error of a field.
    fn error(&self, field: &str, message: String, hint: &str) -> E {
        (self.refuse)(&format!("{}.{field}", self.path), message, hint)
    }

    /// A number within its bounds.
    fn number(&self, field: &str, file: NumberFile, bounds: &Bounds) -> Result<Sourced, E> {
        let number = match file {
            NumberFile::Bare(value) => Sourced::assumed(value),
            NumberFile::Sourced(SourcedFile { value, source }) => Sourced { value, source },
        };
        let Bounds { range, unit } = bounds;
        if !range.contains(&number.value) {
            let message = format!("the number {}{unit} is out of range", number.value);
            let hint = format!("It takes {} to {}{unit}.", range.start(), range.end());
            return Err(self.error(field, message, &hint));
        }
        self.check_source(field, &number.source)?;
        Ok(number)
    }

    /// A number within its bounds, or none.
    fn known(
        &self,
        field: &str,
        file: Option<NumberFile>,
        bounds: &Bounds,
    ) -> Result<Option<Sourced>, E> {
        file.map(|number| self.number(field, number, bounds)).transpose()
    }

    fn k_factors(&self, file: KFactorsFile) -> Result<KFactors, E> {
        const FIELD: &str = "k_factors";
        let count = file.table.len();
        if !(1..=MAX_K_FACTORS).contains(&count) {
            let message = format!("the table of K-factors has {count} rows");
            let hint = format!("It takes 1 to {MAX_K_FACTORS} rows.");
            return Err(self.error(&format!("{FIELD}.table"), message, &hint));
        }
        let mut rows: Vec<KFactor> = Vec::with_capacity(count);
        for (n, [radius_per_thickness, k]) in file.table.into_iter().enumerate() {
            let refused = |message, hint: String| {
                Err(self.error(&format!("{FIELD}.table[{n}]"), message, &hint))
            };
            for (what, value, range) in [
                ("radius over thickness", radius_per_thickness, RADIUS_PER_THICKNESS),
                ("K-factor", k, K_FACTOR),
            ] {
                if !range.contains(&value) {
                    let hint = format!("It takes {} to {}.", range.start(), range.end());
                    return refused(format!("the {what} {value} is out of range"), hint);
                }
            }
            if rows.last().is_some_and(|last| last.radius_per_thickness >= radius_per_thickness) {
                let message = format!("the radius {radius_per_thickness} follows one as large");
                return refused(message, "Order the rows by increasing radius.".to_owned());
            }
            rows.push(KFactor { radius_per_thickness, k });
        }
        let source = file.source.unwrap_or_else(|| ASSUMED.to_owned());
        self.check_source(FIELD, &source)?;
        Ok(KFactors { rows, source })
    }

    fn deductions(&self, file: DeductionsFile, thickness_mm: f64) -> Result<Deductions, E> {
        const FIELD: &str = "deductions";
        let count = file.table.len();
        if !(1..=MAX_DEDUCTIONS).contains(&count) {
            let message = format!("the table of deductions has {count} rows");
            let hint = format!("It takes 1 to {MAX_DEDUCTIONS} rows.");
            return Err(self.error(&format!("{FIELD}.table"), message, &hint));
        }
        let mut rows: Vec<Deduction> = Vec::with_capacity(count);
        for (n, [radius_mm, angle_deg, deduction_mm]) in file.table.into_iter().enumerate() {
            let refused = |message, hint: &str| {
                Err(self.error(&format!("{FIELD}.table[{n}]"), message, hint))
            };
            if !DEDUCTION_RADIUS.contains(&radius_mm) {
                let hint = "It takes 0 to 1000 mm.";
                return refused(format!("the radius {radius_mm} mm is out of range"), hint);
            }
            if !DEDUCTION_ANGLE.contains(&angle_deg) {
                let hint = "It takes 0.1 to 170 degrees, by which the flat sheet is turned.";
                return refused(format!("the angle {angle_deg} is out of range"), hint);
            }
            let row = Deduction { radius_mm, angle_deg, deduction_mm };
            // Not so much that nothing is left between the tangent lines, and no number is NaN.
            let left_mm = row.allowance_mm(thickness_mm);
            if left_mm.is_nan() || left_mm <= 0.0 || deduction_mm < 0.0 {
                let most_mm = left_mm + deduction_mm;
                let hint = format!("It takes 0 to less than both setbacks, {most_mm:.3} mm.");
                let message = format!("the deduction {deduction_mm} mm is out of range");
                return refused(message, &hint);
            }
            let key = |row: &Deduction| (row.radius_mm, row.angle_deg);
            if rows.last().is_some_and(|last| key(last) >= key(&row)) {
                let message = "the row follows one of as large a radius and angle".to_owned();
                return refused(message, "Order the rows by radius, and then by angle.");
            }
            rows.push(row);
        }
        let source = file.source.unwrap_or_else(|| ASSUMED.to_owned());
        self.check_source(FIELD, &source)?;
        Ok(Deductions { rows, source })
    }

    fn grain(&self, file: GrainFile) -> Result<Grain, E> {
        let bending = |way: &str, Object(file): Object<GrainBendingFile>| {
            let field = |name| format!("grain.{way}.{name}");
            Ok(GrainBending {
                modulus_n_per_mm2: self.number(
                    &field("modulus_n_per_mm2"),
                    file.modulus_n_per_mm2,
                    &MODULUS,
                )?,
                bend_radius_mm: self.number(
                    &field("bend_radius_mm"),
                    file.bend_radius_mm,
                    &BEND_RADIUS,
                )?,
            })
        };
        Ok(Grain { along: bending("along", file.along)?, across: bending("across", file.across)? })
    }

    fn check_source(&self, field: &str, source: &str) -> Result<(), E> {
        if source.trim().is_empty() {
            let message = "the source is empty".to_owned();
            return Err(self.error(&format!("{field}.source"), message, SOURCE_HINT));
        }
        Ok(())
    }
}

/// A material as it stands in a file, with the defaults of the limits written out.
pub(crate) fn file_of(material: &Material) -> MaterialFile {
    let bending = |bending: &GrainBending| {
        Object(GrainBendingFile {
            modulus_n_per_mm2: number_file(&bending.modulus_n_per_mm2),
            bend_radius_mm: number_file(&bending.bend_radius_mm),
        })
    };
    MaterialFile {
        title: Some(material.title.clone()),
        thickness_mm: number_file(&material.thickness_mm),
        bend_radius_mm: number_file(&material.bend_radius_mm),
        warp_limit_deg: Some(number_file(&material.warp_limit_deg)),
        stretch_limit: Some(number_file(&material.stretch_limit)),
        modulus_n_per_mm2: material.modulus_n_per_mm2.as_ref().map(number_file),
        poisson: material.poisson.as_ref().map(number_file),
        yield_strain: material.yield_strain.as_ref().map(number_file),
        density_kg_per_m3: material.density_kg_per_m3.as_ref().map(number_file),
        k_factors: material.k_factors.as_ref().map(|KFactors { rows, source }| {
            Object(KFactorsFile {
                table: rows.iter().map(|row| [row.radius_per_thickness, row.k]).collect(),
                source: (source != ASSUMED).then(|| source.clone()),
            })
        }),
        deductions: material.deductions.as_ref().map(|Deductions { rows, source }| {
            let row = |row: &Deduction| [row.radius_mm, row.angle_deg, row.deduction_mm];
            Object(DeductionsFile {
                table: rows.iter().map(row).collect(),
                source: (source != ASSUMED).then(|| source.clone()),
            })
        }),
        grain: material.grain.as_ref().map(|Grain { along, across }| {
            Object(GrainFile { along: bending(along), across: bending(across) })
        }),
    }
}

fn number_file(Sourced { value, source }: &Sourced) -> NumberFile {
    match source.as_str() {
        ASSUMED => NumberFile::Bare(*value),
        _ => NumberFile::Sourced(SourcedFile { value: *value, source: source.clone() }),
    }
}
