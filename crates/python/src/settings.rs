//! The keywords of a call as the settings that `sheetwright_files` takes. They are called as the
//! options of the command are; lengths are mm, angles degrees.

use crate::failure::Failure;
use crate::ranges::{self, Range, whole};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use sheetwright::boundary::PlaneChoice;
use sheetwright::design::{BendMarks, Design, Dimensions, DivideJoint, PanelMethod};
use sheetwright::flatten::Aim;
use sheetwright::make::Judging;
use sheetwright::math::{Vec3, from_deg};
use sheetwright::mesh::Skin;
use sheetwright::triangulate::WhichSurface;
use sheetwright_files::{
    BendSettings, BrakeSettings, DxfRelease, Format, MaxSheets, MeshSettings, OffsetOptions,
    OutputOptions, Paper, PdfOptions, Preset, ReadOptions, ReportForm, SheetSettings, Units,
    VarySettings, bend_rule, stock_sheet,
};

/// Keywords with their values.
#[derive(FromPyObject)]
#[pyo3(transparent)]
pub(crate) struct Keywords<'py>(Bound<'py, PyDict>);

impl Keywords<'_> {
    /// The value of a keyword; none where it is left out or `None`.
    fn get<T>(&self, name: &str) -> PyResult<Option<T>>
    where
        T: for<'a, 'py> FromPyObject<'a, 'py>,
    {
        let Some(value) = self.0.get_item(name)?.filter(|value| !value.is_none()) else {
            return Ok(None);
        };
        let read = value.extract().map_err(Into::<PyErr>::into);
        read.map(Some).map_err(|error| PyTypeError::new_err(format!("{name}: {error}")))
    }

    /// A number within a range.
    fn number(&self, name: &str, range: &Range) -> PyResult<Option<f64>> {
        let given: Option<f64> = self.get(name)?;
        Ok(given.map(|number| range.checked(name, number)).transpose()?)
    }

    /// A whole number, 0 or more.
    fn count(&self, name: &str) -> PyResult<Option<usize>> {
        let given: Option<i64> = self.get(name)?;
        Ok(given.map(|count| whole(name, count)).transpose()?)
    }

    /// What a keyword names.
    fn chosen<T: Clone>(&self, name: &str, known: &[(&str, T)]) -> PyResult<Option<T>> {
        let given: Option<String> = self.get(name)?;
        Ok(given.map(|given| chosen(name, &given, known)).transpose()?)
    }

    /// Refuses keywords that are none of these.
    fn refuse_others(&self, names: &[&str]) -> PyResult<()> {
        for name in self.0.keys() {
            let name: String = name.extract()?;
            chosen("keyword", &name, &names.iter().map(|name| (*name, ())).collect::<Vec<_>>())?;
        }
        Ok(())
    }
}

/// The value of a name.
fn chosen<T: Clone>(setting: &str, given: &str, known: &[(&str, T)]) -> Result<T, Failure> {
    let found = known.iter().find(|(name, _)| *name == given);
    let names = || known.iter().map(|(name, _)| *name).collect::<Vec<_>>();
    found
        .map(|(_, value)| value.clone())
        .ok_or_else(|| Failure::of_choice(setting, given, &names()))
}

/// A supporting plane: by its name or by its normal.
#[derive(FromPyObject)]
enum PlaneSetting {
    Named(String),
    Normal([f64; 3]),
}

const AIMS: [(&str, Aim); 3] = [("mean", Aim::Mean), ("max", Aim::Max), ("seams", Aim::Seams)];

/// The aim of a name.
pub(crate) fn aim(given: &str) -> Result<Aim, Failure> {
    chosen("aim", given, &AIMS)
}

/// What verdicts come from.
pub(crate) fn judging(given: &Keywords<'_>) -> PyResult<Judging> {
    let known = [("exact", Judging::Exact), ("quick", Judging::Quick)];
    Ok(given.chosen("verdict", &known)?.unwrap_or(Judging::Exact))
}

/// How an input is read.
pub(crate) fn read_options(given: &Keywords<'_>) -> PyResult<ReadOptions> {
    let methods = [PanelMethod::Optimal, PanelMethod::Bridge, PanelMethod::Rails];
    let sides = [("cheapest", WhichSurface::Cheapest), ("other", WhichSurface::Other)];
    Ok(ReadOptions {
        second_table: None,
        samples: given.count("samples")?,
        tolerance_mm: given.get("tolerance")?,
        fold: given.get("fold")?,
        effort: given.get("effort")?,
        method: given.chosen("method", &methods.map(|method| (method.name(), method)))?,
        which: given.chosen("side", &sides)?,
        plane: plane(given)?,
        slides: given.get("slide")?,
        units: given.chosen("units", &Units::ALL.map(|units| (units.name(), units)))?,
        rails: given.get("rails")?.unwrap_or_default(),
        material: given.get("material")?,
        vary: VarySettings {
            limit_mm: given.number("vary_limit", &ranges::DISTANCE)?,
            budget_mm: given.number("vary_budget", &ranges::DISTANCE)?,
            warp_deg: given.number("vary_warp", &ranges::WARP)?,
            strain: given.number("vary_strain", &ranges::SHARE)?,
        },
        mesh: mesh_settings(given)?,
        trade: given.get("trade")?,
        allowance_mm: given.number("allowance", &ranges::SIZE)?,
        bends: bend_settings(given)?,
        dimensions: given.chosen("dimensions", &Dimensions::ALL.map(|it| (it.name(), it)))?,
        thickness_mm: given.number("thickness", &ranges::THICKNESS)?,
        bend_radius_mm: given.number("bend_radius", &ranges::RADIUS)?,
        sheets: sheet_settings(given)?,
    })
}

fn plane(given: &Keywords<'_>) -> PyResult<Option<PlaneChoice>> {
    let known = [("auto", PlaneChoice::Auto), ("none", PlaneChoice::None)];
    Ok(match given.get("plane")? {
        None => None,
        Some(PlaneSetting::Normal([x, y, z])) => Some(PlaneChoice::Normal(Vec3::new(x, y, z))),
        Some(PlaneSetting::Named(name)) => Some(chosen("plane", &name, &known)?),
    })
}

fn mesh_settings(given: &Keywords<'_>) -> PyResult<MeshSettings> {
    let split_deg = given.number("split_creases", &ranges::CREASE)?;
    let within: Option<[f64; 2]> = given.get("pieces_within")?;
    let size = |mm| ranges::SIZE.checked("pieces_within", mm);
    Ok(MeshSettings {
        aim: given.chosen("aim", &AIMS)?,
        split_creases: split_deg.map(from_deg),
        darts: given.get("darts")?.unwrap_or(false),
        skin: given.chosen("skin", &[("outer", Skin::Outer), ("inner", Skin::Inner)])?,
        facets: given.get("facets")?,
        pieces_within_mm: within
            .map(|[x, y]| Ok::<_, Failure>([size(x)?, size(y)?]))
            .transpose()?,
    })
}

fn bend_settings(given: &Keywords<'_>) -> PyResult<BendSettings> {
    let marks = [
        ("ticks", BendMarks::Ticks),
        ("lines", BendMarks::Lines),
        ("rulings", BendMarks::Rulings),
        ("none", BendMarks::None),
    ];
    let refused = |hint: String| Failure::new("bends: this is no rule for bend lines", hint);
    let rule: Option<String> = given.get("bends")?;
    let rule = rule.as_deref().map(bend_rule).transpose().map_err(refused)?;
    Ok(BendSettings { rule, marks: given.chosen("bend_marks", &marks)? })
}

fn sheet_settings(given: &Keywords<'_>) -> PyResult<SheetSettings> {
    let joints = [
        ("scarf", Some(DivideJoint::Scarf)),
        ("butt", Some(DivideJoint::Butt)),
        ("puzzle", Some(DivideJoint::Puzzle)),
        ("overlap", Some(DivideJoint::Overlap)),
        ("none", None),
    ];
    let read = |text: &String| {
        let refused = |hint| Failure::new(format!("sheets: {text:?} is no sheet"), hint);
        stock_sheet(text).map_err(refused)
    };
    let sheets: Vec<String> = given.get("sheets")?.unwrap_or_default();
    Ok(SheetSettings {
        sheets: sheets.iter().map(read).collect::<Result<_, _>>()?,
        gap_mm: given.number("gap", &ranges::DISTANCE)?,
        margin_mm: given.number("margin", &ranges::DISTANCE)?,
        kerf_mm: given.number("kerf", &ranges::DISTANCE)?,
        common_lines: given.get("common_lines")?,
        file_each: given.chosen("sheet_files", &[("all", false), ("each", true)])?,
        effort: given.get("effort")?,
        divide: given.chosen("divide", &joints)?,
    })
}

/// The preset of a name.
pub(crate) fn preset(given: &str) -> Result<&'static Preset, Failure> {
    chosen("preset", given, &presets())
}

fn presets() -> Vec<(&'static str, &'static Preset)> {
    Preset::all().iter().map(|preset| (preset.name, preset)).collect()
}

/// How the files of a design are written.
pub(crate) fn output_options(given: &Keywords<'_>, design: &Design) -> PyResult<OutputOptions> {
    given.refuse_others(&[
        "preset",
        "dxf",
        "arcs",
        "paper",
        "max_sheets",
        "report",
        "each_part",
        "stations",
        "feet",
        "die",
        "brake_length",
        "rolls",
    ])?;
    let of_design = OutputOptions::with_preset(design, given.chosen("preset", &presets())?);
    let releases = DxfRelease::ALL.map(|release| (release.name(), release));
    let forms =
        [("auto", ReportForm::Auto), ("short", ReportForm::Short), ("long", ReportForm::Long)];
    let refused = |hint: String| Failure::new("paper: this is no paper", hint);
    let paper: Option<String> = given.get("paper")?;
    let paper = paper.as_deref().map(Paper::parse).transpose().map_err(refused)?;
    let most = MaxSheets::MOST.get();
    let max_sheets = given.count("max_sheets")?.map(|count| {
        let hint = format!("Give a whole number from 1 to {most}.");
        MaxSheets::new(count).ok_or_else(|| Failure::new("max_sheets: out of range", hint))
    });
    Ok(OutputOptions {
        pdf: PdfOptions {
            paper: paper.unwrap_or_default(),
            max_sheets: max_sheets.transpose()?.unwrap_or_default(),
        },
        report: given.chosen("report", &forms)?.unwrap_or_default(),
        dxf: given.chosen("dxf", &releases)?.or(of_design.dxf),
        arcs_mm: given.number("arcs", &ranges::ARCS)?.or(of_design.arcs_mm),
        offsets: OffsetOptions {
            pitch_mm: given.number("stations", &ranges::PITCH)?,
            feet: given.get("feet")?.unwrap_or(false),
        },
        brake: BrakeSettings {
            die_mm: given.number("die", &ranges::SIZE)?,
            length_mm: given.number("brake_length", &ranges::SIZE)?,
            rolls: given.get("rolls")?.unwrap_or(false),
        },
        each_part: given.get("each_part")?.unwrap_or(false),
        ..of_design
    })
}

/// Formats by their names, in the order in which files are written.
pub(crate) fn formats_of(names: &[String]) -> Result<Vec<Format>, Failure> {
    let known = Format::ALL.map(|format| (format.name(), format));
    let formats = names.iter().map(|name| chosen("formats", name, &known));
    let mut formats = formats.collect::<Result<Vec<_>, _>>()?;
    formats.sort_unstable();
    formats.dedup();
    Ok(formats)
}
