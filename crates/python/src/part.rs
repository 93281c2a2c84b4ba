//! A part: its numbers are called as in `report.json`, its arrays have one row a thing.

use crate::arrays::{array_of_points2, array_of_points3, array2};
use crate::remedies::with_keywords;
use crate::settings;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use sheetwright::check::Severity;
use sheetwright::elastic::Predicted;
use sheetwright::make::{Made, Part as KernelPart};
use sheetwright::material::{stretch_limit, warp_limit_deg};
use sheetwright::math::to_deg;
use sheetwright_files::{
    Preset, finding_place, finding_text, flat_picture, side_by_side, space_picture,
    verdict_sentence, write_svg_for,
};
use std::sync::Arc;

/// A part: one piece of sheet, in space and flat.
#[pyclass(frozen, module = "pysheetwright")]
pub(crate) struct Part {
    made: Arc<Made>,
    number: usize,
}

impl Part {
    pub(crate) fn new(made: Arc<Made>, number: usize) -> Self {
        Self { made, number }
    }

    fn part(&self) -> &KernelPart {
        &self.made.parts[self.number]
    }

    fn predicted(&self) -> Option<&Predicted> {
        self.part().predicted.as_ref()
    }

    /// A measure that meshes do not have.
    fn of_found<T>(&self, measure: impl FnOnce(&KernelPart) -> T) -> Option<T> {
        self.part().found().map(|_| measure(self.part()))
    }
}

/// What was found on a part.
#[pyclass(frozen, get_all, module = "pysheetwright")]
pub(crate) struct Finding {
    /// A name that scripts may rely on.
    code: &'static str,
    /// "error", "warning" or "note".
    severity: &'static str,
    /// What is so, in words, and what to do.
    text: String,
    /// Where; empty where it is the whole part.
    place: String,
    /// The keyword that helps against it, in a sentence; empty where there is none.
    hint: String,
}

#[pymethods]
impl Finding {
    fn __repr__(&self) -> String {
        format!("<Finding {} {}: {}>", self.severity, self.code, self.text)
    }
}

/// A named run of the border of a part.
#[pyclass(frozen, get_all, module = "pysheetwright")]
pub(crate) struct Edge {
    /// Its name: that of its curve, or `start`, `end`, `cut-1a`, `border`, ….
    name: String,
    /// How long it is in space, mm.
    length_space_mm: f64,
    /// How long it is on the pattern, mm.
    length_flat_mm: f64,
    /// The edges that it is joined to, as `PANEL/EDGE`.
    mates: Vec<String>,
    /// The largest difference between its length on the pattern and that of a mate, mm; None of a
    /// free edge.
    difference_mm: Option<f64>,
    /// Its vertices in order, by their numbers.
    run: Vec<usize>,
}

#[pymethods]
impl Edge {
    fn __repr__(&self) -> String {
        format!("<Edge {}: {:.3} mm>", self.name, self.length_flat_mm)
    }
}

#[pymethods]
impl Part {
    /// Its name: that of its panel, with a number where a mesh makes several parts.
    #[getter]
    fn name(&self) -> &str {
        &self.part().name
    }

    /// The panel of the design that it is made of.
    #[getter]
    fn panel(&self) -> &str {
        &self.part().panel
    }

    /// How many of it the design asks for.
    #[getter]
    fn count(&self) -> usize {
        self.made.wanted.get(self.number).map_or(1, |wanted| wanted.count)
    }

    /// How many of those are turned over.
    #[getter]
    fn mirrored(&self) -> usize {
        self.made.wanted.get(self.number).map_or(0, |wanted| wanted.mirrored)
    }

    /// The method that found the surface: "optimal", "bridge" or "rails"; "mesh" of a mesh.
    #[getter]
    fn method(&self) -> &'static str {
        self.part().found().map_or("mesh", |found| found.method.name())
    }

    /// The verdict: "bends", "bends-with-force", "roll", "bends-and-folds", "will-not-bend" or
    /// "undecided".
    #[getter]
    fn verdict(&self) -> &'static str {
        self.part().checked.verdict.name()
    }

    /// The verdict in a sentence.
    #[getter]
    fn verdict_text(&self) -> &'static str {
        verdict_sentence(self.part().checked.verdict, self.part().found().is_none())
    }

    /// Whether no finding is an error.
    #[getter]
    fn ok(&self) -> bool {
        self.part().checked.findings.iter().all(|it| it.severity() < Severity::Error)
    }

    /// What was found, the worst first, as `sheetwright check` says it. A report adds what writing
    /// the files found.
    #[getter]
    fn findings(&self) -> Vec<Finding> {
        let findings = self.part().checked.findings.iter().map(|finding| Finding {
            code: finding.code(),
            severity: finding.severity().name(),
            text: finding_text(finding),
            place: finding_place(finding),
            hint: with_keywords("", finding.remedies()),
        });
        findings.collect()
    }

    /// Its edges, loop after loop, with their lengths and the edges that they are joined to.
    #[getter]
    fn edges(&self) -> Vec<Edge> {
        let edges = self.part().edges.iter().map(|edge| Edge {
            name: edge.name.clone(),
            length_space_mm: edge.length_space_mm,
            length_flat_mm: edge.length_flat_mm,
            mates: edge
                .mates
                .iter()
                .map(|at| {
                    let other = &self.made.parts[at.part];
                    format!("{}/{}", other.name, other.edges[at.edge].name)
                })
                .collect(),
            difference_mm: edge.difference_mm,
            run: edge.run.clone(),
        });
        edges.collect()
    }

    fn __repr__(&self) -> String {
        let size = self.part().piece.size;
        format!("<Part {}: {}, {:.1} × {:.1} mm>", self.name(), self.verdict(), size.x, size.y)
    }

    // What was measured. Lengths are mm, angles degrees, strains without unit.

    /// Whether no triangulation at all is cheaper; None of a mesh.
    #[getter]
    fn proven_optimal(&self) -> Option<bool> {
        self.part().found().map(|found| found.triangulation.proven_optimal)
    }

    /// The price: twist and weighted folds, summed; None of a mesh.
    #[getter]
    fn price_total(&self) -> Option<f64> {
        self.part().found().map(|found| found.triangulation.price_without_hints())
    }

    /// The sum of the twist of all rungs; None of a mesh.
    #[getter]
    fn twist_total(&self) -> Option<f64> {
        self.of_found(|part| part.measures.twist_total)
    }

    /// The largest warp angle of a rung, degrees; None of a mesh.
    #[getter]
    fn warp_max_deg(&self) -> Option<f64> {
        self.of_found(|part| to_deg(part.measures.warp_max))
    }

    /// The mean warp angle, degrees; None of a mesh.
    #[getter]
    fn warp_mean_deg(&self) -> Option<f64> {
        self.of_found(|part| to_deg(part.measures.warp_mean))
    }

    /// The largest warp angle that the sheet takes, degrees.
    #[getter]
    fn warp_limit_deg(&self) -> f64 {
        warp_limit_deg(self.made.material.as_ref())
    }

    /// The largest angle between two triangles, degrees.
    #[getter]
    fn crease_max_deg(&self) -> f64 {
        to_deg(self.part().measures.crease_max)
    }

    /// The smallest radius that the sheet is bent to, mm; None of a flat one and of a mesh.
    #[getter]
    fn bend_radius_min_mm(&self) -> Option<f64> {
        let radius_mm = self.of_found(|part| part.measures.bend_radius_min_mm)?;
        radius_mm.is_finite().then_some(radius_mm)
    }

    /// The strain within its plane that 95 % of the sheet stays below.
    #[getter]
    fn strain_p95(&self) -> Option<f64> {
        self.predicted().map(|predicted| predicted.strain)
    }

    /// The least and the greatest that this may be.
    #[getter]
    fn strain_range(&self) -> Option<(f64, f64)> {
        self.predicted().map(|predicted| predicted.strain_range.into())
    }

    /// The strain within its plane that the sheet takes.
    #[getter]
    fn strain_limit(&self) -> f64 {
        stretch_limit(self.made.material.as_ref())
    }

    /// The strain of the outer fibre that 95 % of the sheet stays below.
    #[getter]
    fn outer_fibre(&self) -> Option<f64> {
        self.predicted().map(Predicted::outer_fibre)
    }

    /// The strain of the outer fibre that the sheet takes; None without a material.
    #[getter]
    fn outer_fibre_limit(&self) -> Option<f64> {
        self.predicted().and_then(|predicted| predicted.limits.outer_fibre)
    }

    /// The thickness that the strain was predicted for, mm.
    #[getter]
    fn thickness_mm(&self) -> Option<f64> {
        self.predicted().map(|predicted| predicted.limits.thickness_mm)
    }

    /// The moment that holds an edge, N·m for each metre; None where Young's modulus is unknown.
    #[getter]
    fn hold_moment_n(&self) -> Option<f64> {
        self.predicted().and_then(Predicted::hold_moment_n)
    }

    /// The largest relative difference of a length, flat against space.
    #[getter]
    fn length_error_max(&self) -> f64 {
        self.part().measures.length_error_max
    }

    /// The mean relative difference of all lengths.
    #[getter]
    fn length_error_mean(&self) -> f64 {
        self.part().measures.length_error_mean
    }

    /// The area in space, mm².
    #[getter]
    fn area_space_mm2(&self) -> f64 {
        self.part().measures.area_space_mm2
    }

    /// The area of the flat pattern, mm².
    #[getter]
    fn area_flat_mm2(&self) -> f64 {
        self.part().measures.area_flat_mm2
    }

    /// The longer side of the flat pattern, mm.
    #[getter]
    fn flat_width_mm(&self) -> f64 {
        self.part().piece.size.x
    }

    /// The shorter side of the flat pattern, mm.
    #[getter]
    fn flat_height_mm(&self) -> f64 {
        self.part().piece.size.y
    }

    /// Whether the flat pattern overlaps itself.
    #[getter]
    fn overlaps(&self) -> bool {
        self.part().flat.overlap.is_some()
    }

    // Its arrays. A part that is cut open has a vertex on each side of a cut.

    /// The outline as it is cut, float64 of shape (N, 2), mm; the first point is not repeated.
    #[getter]
    fn outline<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        array_of_points2(py, self.part().piece.loops().next().unwrap_or_default())
    }

    /// The holes as they are cut, each float64 of shape (N, 2), mm.
    #[getter]
    fn holes<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
        self.part().piece.loops().skip(1).map(|line| array_of_points2(py, line)).collect()
    }

    /// Its vertices in space, float64 of shape (V, 3), mm.
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        array_of_points3(py, self.part().sheet.mesh().positions())
    }

    /// Where they lie on the flat pattern, float64 of shape (V, 2), mm.
    #[getter]
    fn flat<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        array_of_points2(py, &self.part().flat.points)
    }

    /// Its triangles by their vertices, int64 of shape (F, 3), counter-clockwise on the pattern.
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let faces = self.part().sheet.mesh().triangles().iter();
        array2(py, faces.map(|corners| corners.map(|corner| corner.get() as i64)))
    }

    /// For each vertex the sample of the boundary, or the vertex of the mesh before it was cut,
    /// int64 of shape (V,).
    #[getter]
    fn origin<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let sheet = &self.part().sheet;
        let vertices =
            (0..sheet.mesh().positions().len()).map(sheetwright::index::VertexIndex::new);
        PyArray1::from_iter(py, vertices.map(|v| sheet.origin(v).get() as i64))
    }

    /// The rungs, straight lines that the surface is ruled by, by the vertices at their ends,
    /// int64 of shape (R, 2); none of a mesh.
    #[getter]
    fn rungs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let ends = self.part().sheet.rung_ends().iter();
        array2(py, ends.map(|ends| ends.map(|end| end.get() as i64)))
    }

    /// The rungs in space, float64 of shape (R, 2, 3), mm.
    #[getter]
    fn rulings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, numpy::PyArray3<f64>>> {
        use numpy::PyArrayMethods;
        let sheet = &self.part().sheet;
        let place = |end: sheetwright::index::VertexIndex| {
            let p = sheet.mesh().position(end);
            [p.x, p.y, p.z]
        };
        let ends = sheet.rung_ends();
        let flat: Vec<f64> = ends.iter().flatten().flat_map(|&end| place(end)).collect();
        PyArray1::from_vec(py, flat).reshape([ends.len(), 2, 3])
    }

    /// The warp angle of each rung, degrees, float64 of shape (R,).
    #[getter]
    fn warp_deg<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let rungs = self.part().measures.rungs.iter();
        PyArray1::from_iter(py, rungs.map(|rung| to_deg(rung.warp)))
    }

    /// The crease at each rung, degrees, positive for a mountain, float64 of shape (R,).
    #[getter]
    fn crease_deg<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let rungs = self.part().measures.rungs.iter();
        PyArray1::from_iter(py, rungs.map(|rung| to_deg(rung.crease)))
    }

    /// The largest and the smallest stretch of each triangle, flat by space, float64 of shape
    /// (F, 2); ones where the part unrolls exactly.
    #[getter]
    fn stretches<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        match &self.part().measures.distortion {
            Some(distortion) => array2(py, distortion.stretches.iter().copied()),
            None => array2(py, self.part().sheet.mesh().triangles().iter().map(|_| [1.0; 2])),
        }
    }

    // How it is drawn.

    /// The pattern as an SVG file, true to scale: the text of `NAME.svg`.
    #[pyo3(signature = (preset=None))]
    fn svg(&self, preset: Option<String>) -> PyResult<String> {
        let chosen = preset.as_deref().map(settings::preset).transpose()?;
        let chosen = chosen.unwrap_or(Preset::generic());
        let bytes = write_svg_for(&self.part().piece, chosen);
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    /// What notebooks show: the part in space beside its pattern.
    fn _repr_svg_(&self) -> String {
        let (part, material) = (self.part(), self.made.material.as_ref());
        let pictures = [space_picture(part, material), flat_picture(part, material)];
        side_by_side(&part.name, &pictures).standalone()
    }

    /// Draws the part in space and flat with Matplotlib; see `pysheetwright.plotting.plot`.
    #[pyo3(signature = (axes=None, *, warp=true))]
    fn plot<'py>(
        slf: &Bound<'py, Self>,
        axes: Option<Bound<'py, PyAny>>,
        warp: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("pysheetwright.plotting")?.call_method1("plot", (slf, axes, warp))
    }
}
