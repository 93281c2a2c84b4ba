//! NumPy arrays to points and back.

use crate::failure::Failure;
use numpy::ndarray::ArrayView1;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use sheetwright::math::{Point2, Point3};
use std::collections::BTreeSet;

/// Points in space of an array of shape (N, 3).
pub(crate) fn points3(
    array: &PyReadonlyArray2<'_, f64>,
    what: &str,
) -> Result<Vec<Point3>, Failure> {
    let rows = array.as_array();
    if rows.ncols() != 3 {
        return Err(wrong_shape(what, "(N, 3)", rows.shape()));
    }
    Ok(rows.rows().into_iter().map(|row| Point3::new(row[0], row[1], row[2])).collect())
}

/// Points in the plane of an array of shape (N, 2).
pub(crate) fn points2(
    array: &PyReadonlyArray2<'_, f64>,
    what: &str,
) -> Result<Vec<Point2>, Failure> {
    let rows = array.as_array();
    if rows.ncols() != 2 {
        return Err(wrong_shape(what, "(N, 2)", rows.shape()));
    }
    Ok(rows.rows().into_iter().map(|row| Point2::new(row[0], row[1])).collect())
}

/// Triangles of an array of shape (F, 3), whose corners are below `count`.
pub(crate) fn triangles(
    array: &PyReadonlyArray2<'_, i64>,
    count: usize,
) -> Result<Vec<[usize; 3]>, Failure> {
    let rows = array.as_array();
    if rows.ncols() != 3 {
        return Err(wrong_shape("faces", "(F, 3)", rows.shape()));
    }
    let corner = |n: i64| {
        usize::try_from(n).ok().filter(|&n| n < count).ok_or_else(|| {
            let message = format!("a face has the corner {n}, and there are {count} vertices");
            Failure::new(message, "Count vertices from 0.")
        })
    };
    rows.rows()
        .into_iter()
        .map(|row| Ok([corner(row[0])?, corner(row[1])?, corner(row[2])?]))
        .collect()
}

/// Sides of triangles of an array of shape (S, 2).
pub(crate) fn sides(
    array: &PyReadonlyArray2<'_, i64>,
    triangles: &[[usize; 3]],
) -> Result<Vec<[usize; 2]>, Failure> {
    let rows = array.as_array();
    if rows.ncols() != 2 {
        return Err(wrong_shape("seams", "(S, 2)", rows.shape()));
    }
    if rows.nrows() == 0 {
        return Ok(Vec::new());
    }
    let ends = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
    let all = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]].map(ends));
    let all: BTreeSet<[usize; 2]> = all.collect();
    let side = |row: ArrayView1<'_, i64>| {
        let given = [row[0], row[1]];
        let known = given.map(|n| usize::try_from(n).unwrap_or(usize::MAX));
        all.contains(&ends(known)).then_some(known).ok_or_else(|| {
            let message = format!("seams: {} and {} are no side of a face", given[0], given[1]);
            Failure::new(message, "Give both ends of sides, by vertices counted from 0.")
        })
    };
    rows.rows().into_iter().map(side).collect()
}

fn wrong_shape(what: &str, wanted: &str, found: &[usize]) -> Failure {
    let found: Vec<String> = found.iter().map(usize::to_string).collect();
    let message = format!("{what}: the array has the shape ({})", found.join(", "));
    Failure::new(message, format!("Give an array of shape {wanted}, one point a row."))
}

/// An array of shape (rows, N) of rows with N numbers.
pub(crate) fn array2<'py, T: numpy::Element, const N: usize>(
    py: Python<'py>,
    rows: impl IntoIterator<Item = [T; N]>,
) -> PyResult<Bound<'py, PyArray2<T>>> {
    let flat: Vec<T> = rows.into_iter().flatten().collect();
    let count = flat.len() / N;
    PyArray1::from_vec(py, flat).reshape([count, N])
}

/// An array of shape (N, 2) of points in the plane.
pub(crate) fn array_of_points2<'py>(
    py: Python<'py>,
    points: &[Point2],
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    array2(py, points.iter().map(|p| [p.x, p.y]))
}

/// An array of shape (N, 3) of points in space.
pub(crate) fn array_of_points3<'py>(
    py: Python<'py>,
    points: &[Point3],
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    array2(py, points.iter().map(|p| [p.x, p.y, p.z]))
}
