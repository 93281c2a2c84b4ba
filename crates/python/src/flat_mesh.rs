//! A mesh laid flat as it stands: one position for each vertex.

use crate::arrays::{array_of_points2, array2, points3, triangles};
use crate::failure::Failure;
use crate::settings;
use crate::signals::detached;
use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use sheetwright::flatten::{Ended, RelaxOptions, Relaxed, relax};
use sheetwright::index::{TriangleIndex, VertexIndex};
use sheetwright::measure::{Distortion, distortion};
use sheetwright::mesh::Mesh;

/// A mesh laid flat.
#[pyclass(frozen, module = "pysheetwright")]
pub(crate) struct FlatMesh {
    relaxed: Relaxed,
    distortion: Distortion,
    triangles: usize,
}

/// Lays a mesh of one piece flat, with one position for each vertex.
#[pyfunction]
pub(crate) fn flatten(
    py: Python<'_>,
    vertices: PyReadonlyArray2<'_, f64>,
    faces: PyReadonlyArray2<'_, i64>,
    aim: &str,
) -> PyResult<FlatMesh> {
    let positions = points3(&vertices, "vertices")?;
    let corners = triangles(&faces, positions.len())?;
    let aim = settings::aim(aim)?;
    let mut is_used = vec![false; positions.len()];
    corners.iter().flatten().for_each(|&corner| is_used[corner] = true);
    if let Some(lone) = is_used.iter().position(|&is_used| !is_used) {
        let message = format!("vertex {lone} belongs to no face");
        Err(Failure::new(message, "Leave out vertices that no face uses."))?;
    }
    let faces = corners.into_iter().map(|face| face.map(VertexIndex::new)).collect();
    detached(py, |signals| {
        laid_flat(positions, faces, RelaxOptions { aim, ..RelaxOptions::default() }, signals)
    })?
    .map_err(PyErr::from)
}

fn laid_flat(
    positions: Vec<sheetwright::Point3>,
    faces: Vec<[VertexIndex; 3]>,
    options: RelaxOptions,
    watch: &mut dyn sheetwright::Watch,
) -> Result<FlatMesh, Failure> {
    const HINT: &str = "make_mesh heals a mesh, cuts it open and divides it as the command does.";
    let mesh =
        Mesh::new(positions, faces).map_err(|error| Failure::new(error.to_string(), HINT))?;
    let relaxed = relax(&mesh, &options, watch);
    let relaxed = relaxed.map_err(|error| Failure::new(error.to_string(), HINT))?;
    let distortion = distortion(&mesh, &relaxed.flat.points);
    Ok(FlatMesh { relaxed, distortion, triangles: mesh.triangles().len() })
}

#[pymethods]
impl FlatMesh {
    /// Where each vertex lies, float64 of shape (V, 2), mm.
    #[getter]
    fn flat<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        array_of_points2(py, &self.relaxed.flat.points)
    }

    /// The largest and the smallest stretch of each face, flat by space, float64 of shape (F, 2).
    #[getter]
    fn stretches<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        array2(py, self.distortion.stretches.iter().copied())
    }

    /// The strain of each face, by how much its stretches differ from 1 at most, float64 of shape
    /// (F,).
    #[getter]
    fn strain<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let faces = (0..self.triangles).map(TriangleIndex::new);
        PyArray1::from_iter(py, faces.map(|face| self.distortion.strain(face)))
    }

    /// The largest relative length error of a side.
    #[getter]
    fn length_error_max(&self) -> f64 {
        self.distortion.length_error_max
    }

    /// The mean relative length error of all sides.
    #[getter]
    fn length_error_mean(&self) -> f64 {
        self.distortion.length_error_mean
    }

    /// Whether the flat form overlaps itself.
    #[getter]
    fn overlaps(&self) -> bool {
        self.relaxed.flat.overlap.is_some()
    }

    /// How many faces lie upside down.
    #[getter]
    fn flipped(&self) -> usize {
        self.relaxed.flipped
    }

    /// How it ended: "true" (all lengths are), "least" (the error is as small as it gets),
    /// "squeezed" (it should be cut open) or "out-of-steps".
    #[getter]
    fn ended(&self) -> &'static str {
        match self.relaxed.ended {
            Ended::True => "true",
            Ended::Least => "least",
            Ended::Squeezed => "squeezed",
            Ended::OutOfSteps => "out-of-steps",
            Ended::Stopped => "stopped",
        }
    }

    fn __repr__(&self) -> String {
        let error = 100.0 * self.length_error_max();
        format!("<FlatMesh: {} faces, lengths within {error:.3} %>", self.triangles)
    }
}
