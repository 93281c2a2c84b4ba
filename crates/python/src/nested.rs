//! Outlines on sheets.

use crate::arrays::{array2, points2};
use crate::failure::Failure;
use crate::ranges::{ANGLE, COORDINATE, DISTANCE, EFFORT, whole};
use crate::signals::detached;
use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use sheetwright::design::SheetForm;
use sheetwright::math::Point2;
use sheetwright::nest::{
    Nest, NestForm, NestOptions, NestPart, NestSheet, Turns, first_fault, nest as kernel_nest,
};
use sheetwright_files::{FAULT, stock_sheet};

/// A part to lay out, as the Python half hands it over.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct OutlineArrays<'py> {
    loops: Vec<PyReadonlyArray2<'py, f64>>,
    count: i64,
}

/// The most parts of a layout.
const MOST_PARTS: usize = 100_000;

/// Where parts lie on sheets.
#[pyclass(frozen, module = "pysheetwright")]
pub(crate) struct Layout {
    nest: Nest,
    parts: Vec<NestPart>,
}

/// Lays outlines out on sheets.
#[pyfunction]
pub(crate) fn nest(
    py: Python<'_>,
    outlines: Vec<OutlineArrays<'_>>,
    sheets: Vec<String>,
    distances: (f64, f64),
    turns_deg: Option<Vec<f64>>,
    may_turn_over: bool,
    effort: f64,
) -> PyResult<Layout> {
    let angle = |deg| ANGLE.checked("turns", deg).map(sheetwright::math::from_deg);
    let angles = turns_deg.unwrap_or_default().into_iter().map(angle);
    let angles = angles.collect::<Result<_, Failure>>()?;
    let turns = Turns { angles, may_turn_over, ..Turns::FREE };
    let parts = outlines.iter().enumerate().map(|(n, given)| part(n, given, &turns));
    let parts = parts.collect::<Result<Vec<_>, Failure>>()?;
    let count = parts.iter().fold(0, |sum: usize, part| sum.saturating_add(part.count));
    if count > MOST_PARTS {
        let hint = format!("The limit is {MOST_PARTS} parts: lay them out in several calls.");
        Err(Failure::new(format!("counts: there are {count} parts"), hint))?;
    }
    let sheets = sheets.iter().map(|text| sheet(text)).collect::<Result<Vec<_>, Failure>>()?;
    let gap_mm = DISTANCE.checked("gap", distances.0)?;
    let margin_mm = DISTANCE.checked("margin", distances.1)?;
    let effort = EFFORT.checked("effort", effort)?;
    let options = NestOptions { gap_mm, margin_mm, has_common_lines: false, effort };
    let nest = detached(py, |signals| kernel_nest(&parts, &sheets, options, signals))?;
    if first_fault(&nest, &parts, &sheets, options).is_some() {
        Err(Failure::new("the layout does not keep what was asked", FAULT))?;
    }
    Ok(Layout { nest, parts })
}

/// The n-th part of a call.
fn part(n: usize, given: &OutlineArrays<'_>, turns: &Turns) -> Result<NestPart, Failure> {
    let name = format!("outline {n}");
    let loops = given.loops.iter().map(|line| points2(line, &name));
    let loops = loops.collect::<Result<Vec<Vec<Point2>>, Failure>>()?;
    if loops.iter().any(|line| line.len() < 3) || loops.is_empty() {
        let message = format!("{name} has a loop with fewer than 3 corners");
        return Err(Failure::new(message, "Give an array of shape (N, 2)."));
    }
    for p in loops.iter().flatten() {
        COORDINATE.checked(&name, p.x)?;
        COORDINATE.checked(&name, p.y)?;
    }
    let count = whole("counts", given.count)?;
    Ok(NestPart { loops, count, turns: turns.clone(), group: None })
}

fn sheet(text: &str) -> Result<NestSheet, Failure> {
    let refused = |hint: String| Failure::new(format!("sheets: {text:?} is no sheet"), hint);
    let stock = stock_sheet(text).map_err(refused)?;
    let form = match stock.form {
        SheetForm::Rectangle { size } => NestForm::Rectangle(size),
        SheetForm::Roll { width } => NestForm::Roll(width),
        SheetForm::Outline { points } => NestForm::Outline(points),
    };
    Ok(NestSheet { form, count: stock.count, cost: stock.cost })
}

#[pymethods]
impl Layout {
    /// The outline of each placement, by its number in the call, int64 of shape (K,).
    #[getter]
    fn part<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        PyArray1::from_iter(py, self.nest.placements.iter().map(|it| it.part as i64))
    }

    /// The sheet of each placement, by its number in `sheets`, int64 of shape (K,).
    #[getter]
    fn sheet<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        PyArray1::from_iter(py, self.nest.placements.iter().map(|it| it.sheet as i64))
    }

    /// Where each lies on its sheet: an affine map float64 of shape (K, 2, 3), so that a point p of
    /// the outline lies at `map[:, :2] @ p + map[:, 2]`.
    #[getter]
    fn maps<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, numpy::PyArray3<f64>>> {
        use numpy::PyArrayMethods;
        use sheetwright::math::Vec2;
        let map = |it: &sheetwright::nest::Placement| {
            let (x, y) = (it.turned(Vec2::X), it.turned(Vec2::Y));
            [x.x, y.x, it.shift.x, x.y, y.y, it.shift.y]
        };
        let flat: Vec<f64> = self.nest.placements.iter().flat_map(map).collect();
        PyArray1::from_vec(py, flat).reshape([self.nest.placements.len(), 2, 3])
    }

    /// The outlines where they lie, each float64 of shape (N, 2), mm, without their holes.
    #[getter]
    fn outlines<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
        let laid = self.nest.placements.iter().map(|it| {
            let outline = self.parts[it.part].loops[0].iter();
            array2(py, outline.map(|&p| it.lay(p)).map(|p| [p.x, p.y]))
        });
        laid.collect()
    }

    /// The width and height of each sheet that is used, of a roll the length and the width, float64
    /// of shape (S, 2), mm.
    #[getter]
    fn sheets<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        array2(py, self.nest.sheets.iter().map(|sheet| sheet.size))
    }

    /// The share of each sheet that parts cover, float64 of shape (S,).
    #[getter]
    fn used<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let sheets = self.nest.sheets.iter();
        PyArray1::from_iter(py, sheets.map(|it| it.used_mm2 / (it.size[0] * it.size[1])))
    }

    /// Outlines, by their numbers, that have no place: too large, or no sheet is left.
    #[getter]
    fn left_over(&self) -> Vec<usize> {
        let mut all = [&self.nest.too_large[..], &self.nest.left_over[..]].concat();
        all.sort_unstable();
        all.dedup();
        all
    }

    fn __repr__(&self) -> String {
        let (parts, sheets) = (self.nest.placements.len(), self.nest.sheets.len());
        format!("<Layout: {parts} parts on {sheets} sheets>")
    }
}
