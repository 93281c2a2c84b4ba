//! A made design: its parts, its files, its report.

use crate::arrays::{points3, sides, triangles};
use crate::failure::Failure;
use crate::part::Part;
use crate::settings::{Keywords, formats_of, judging, output_options, read_options};
use crate::signals::detached;
use crate::source::{BoundArrays, design_of_bytes, design_of_mesh};
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBytes, PyDict};
use sheetwright::check::Severity;
use sheetwright::design::Design;
use sheetwright::make::{Judging, Made as KernelMade, make_judged};
use sheetwright_files::whole::Folder;
use sheetwright_files::{
    Format, OutputOptions, Outputs, design_picture, flat_picture, formats_for, output_files,
    read_input, refuse_unmade, stacked, write_design,
};
use std::path::PathBuf;
use std::sync::Arc;

/// A made design: the surfaces, the flat patterns and the verdicts of all its parts.
#[pyclass(frozen, module = "pysheetwright")]
pub(crate) struct Made {
    design: Arc<Design>,
    made: Arc<KernelMade>,
    report: PyOnceLock<Py<PyAny>>,
}

/// Makes a design as the command `make` does.
fn made(py: Python<'_>, design: Design, judging: Judging) -> PyResult<Made> {
    let made = detached(py, |signals| {
        let made = make_judged(&design, judging, signals);
        made.map(|mut made| {
            if judging == Judging::Exact {
                made.advise(signals);
            }
            made.lay_out(signals);
            made
        })
    })?;
    let made = made.map_err(|error| Failure::of_make(&error, &design))?;
    Ok(Made { design: Arc::new(design), made: Arc::new(made), report: PyOnceLock::new() })
}

/// Makes the design, curve table, drawing or mesh in a file.
#[pyfunction]
pub(crate) fn make_file(py: Python<'_>, path: PathBuf, settings: Keywords<'_>) -> PyResult<Made> {
    let options = read_options(&settings)?;
    let design = py.detach(|| read_input(&path, &options)).map_err(Failure::from)?;
    made(py, design, judging(&settings)?)
}

/// Makes the design, curve table, drawing or mesh in some bytes.
#[pyfunction]
pub(crate) fn make_bytes(
    py: Python<'_>,
    data: &[u8],
    format: Option<&str>,
    name: &str,
    folder: Option<PathBuf>,
    settings: Keywords<'_>,
) -> PyResult<Made> {
    let options = read_options(&settings)?;
    let read = || design_of_bytes(data, format, name, folder.as_deref(), &options);
    let design = py.detach(read)?;
    made(py, design, judging(&settings)?)
}

/// Makes one panel inside curves that are given as points.
#[pyfunction]
pub(crate) fn make_points(
    py: Python<'_>,
    bounds: BoundArrays<'_>,
    name: &str,
    settings: Keywords<'_>,
) -> PyResult<Made> {
    let (bounds, options) = (bounds.copied()?, read_options(&settings)?);
    let design = py.detach(|| bounds.design(name, &options))?;
    made(py, design, judging(&settings)?)
}

/// Makes a mesh that is given as vertices and faces.
#[pyfunction]
pub(crate) fn make_mesh(
    py: Python<'_>,
    vertices: PyReadonlyArray2<'_, f64>,
    faces: PyReadonlyArray2<'_, i64>,
    seams: PyReadonlyArray2<'_, i64>,
    name: &str,
    settings: Keywords<'_>,
) -> PyResult<Made> {
    let vertices = points3(&vertices, "vertices")?;
    let faces = triangles(&faces, vertices.len())?;
    let seams = sides(&seams, &faces)?;
    let options = read_options(&settings)?;
    let design = py.detach(|| design_of_mesh(&vertices, &faces, &seams, name, &options))?;
    made(py, design, judging(&settings)?)
}

impl Made {
    fn part(&self, number: usize) -> Part {
        Part::new(Arc::clone(&self.made), number)
    }

    /// The formats of these names; none: those that the command writes of the design.
    fn formats(&self, names: Option<&Vec<String>>) -> Result<Vec<Format>, Failure> {
        let Some(names) = names else { return Ok(formats_for(&self.design)) };
        let formats = formats_of(names)?;
        refuse_unmade(&self.design, &formats)?;
        Ok(formats)
    }

    fn outputs(
        &self,
        py: Python<'_>,
        formats: Option<&Vec<String>>,
        options: Option<Keywords<'_>>,
    ) -> PyResult<Outputs> {
        let formats = self.formats(formats)?;
        let options = match options {
            None => OutputOptions::of(&self.design),
            Some(given) => output_options(&given, &self.design)?,
        };
        let outputs = py.detach(|| output_files(&self.made, &formats, options));
        Ok(outputs.map_err(Failure::from)?)
    }
}

/// What some JSON says, as Python's own reader has it.
fn from_json<'py>(py: Python<'py>, bytes: &[u8]) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (PyBytes::new(py, bytes),))
}

#[pymethods]
impl Made {
    /// The name of the design.
    #[getter]
    fn name(&self) -> &str {
        &self.made.name
    }

    /// The name of the material; None if none is named.
    #[getter]
    fn material(&self) -> Option<&str> {
        self.made.material.as_ref().map(|material| &material.name[..])
    }

    /// Its parts, in the order of the panels.
    #[getter]
    fn parts(&self) -> Vec<Part> {
        (0..self.made.parts.len()).map(|number| self.part(number)).collect()
    }

    /// Whether no finding is an error: the command would end with status 0.
    #[getter]
    fn ok(&self) -> bool {
        let findings = self.made.parts.iter().flat_map(|part| &part.checked.findings);
        findings.into_iter().all(|finding| finding.severity() < Severity::Error)
    }

    /// The design as a dict, which `make` takes.
    #[getter]
    fn design<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        from_json(py, &write_design(&self.design))
    }

    /// What `report.json` of the command holds, as a dict: all numbers of all parts, the edges and
    /// what they are joined to, the sheets, and what was found in them and in the files, which are
    /// made for it. docs/report.md explains every field.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let report = self.report.get_or_try_init(py, || {
            let mut formats = formats_for(&self.design);
            formats.push(Format::Report);
            let made = || output_files(&self.made, &formats, OutputOptions::of(&self.design));
            let outputs = py.detach(made).map_err(Failure::from)?;
            let file = outputs.files.iter().find(|file| file.name == "report.json");
            from_json(py, file.map_or(&b"null"[..], |file| &file.bytes)).map(Bound::unbind)
        })?;
        Ok(report.bind(py).clone())
    }

    /// The files that the command writes, as bytes by their names; all but `timing.json`.
    #[pyo3(signature = (formats=None, **options))]
    fn files<'py>(
        &self,
        py: Python<'py>,
        formats: Option<Vec<String>>,
        options: Option<Keywords<'py>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let files = PyDict::new(py);
        for file in self.outputs(py, formats.as_ref(), options)?.files {
            files.set_item(file.name, PyBytes::new(py, &file.bytes))?;
        }
        Ok(files)
    }

    /// Writes the files of `files` into a folder, all or none, and returns their names.
    #[pyo3(signature = (folder, formats=None, **options))]
    fn write(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        formats: Option<Vec<String>>,
        options: Option<Keywords<'_>>,
    ) -> PyResult<Vec<String>> {
        let outputs = self.outputs(py, formats.as_ref(), options)?;
        let written = py.detach(|| {
            let mut batch = Folder::new(&folder)?.batch()?;
            for file in &outputs.files {
                batch.add(&file.name, &file.bytes)?;
            }
            batch.keep()
        });
        written.map_err(Failure::from)?;
        Ok(outputs.files.into_iter().map(|file| file.name).collect())
    }

    /// A picture of the design in space and of all flat patterns, as SVG text.
    fn svg(&self) -> String {
        let made = &self.made;
        let mut pictures = vec![design_picture(made)];
        let material = made.material.as_ref();
        pictures.extend(made.parts.iter().map(|part| flat_picture(part, material)));
        stacked(&made.name, &pictures).standalone()
    }

    /// What notebooks show.
    fn _repr_svg_(&self) -> String {
        self.svg()
    }

    fn __repr__(&self) -> String {
        let made = &self.made;
        let part =
            |part: &sheetwright::Part| format!("{}: {}", part.name, part.checked.verdict.name());
        let parts: Vec<String> = made.parts.iter().map(part).collect();
        format!("<Made {}: {}>", made.name, parts.join(", "))
    }
}
