//! What a caller hands over, as the bytes of a file that the command reads.

use crate::arrays::points3;
use crate::failure::Failure;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{Design, DesignCurve};
use sheetwright::math::Point3;
use sheetwright_files::{
    DrawingFormat, InputFormat, MeshFormat, ReadOptions, read_bytes, write_design, write_table,
};
use std::fmt::Write;
use std::path::Path;

/// The formats by their names.
const FORMATS: [(&str, InputFormat); 9] = [
    ("json", InputFormat::Design),
    ("csv", InputFormat::Table),
    ("xlsx", InputFormat::Workbook),
    ("svg", InputFormat::Drawing(DrawingFormat::Svg)),
    ("dxf", InputFormat::Drawing(DrawingFormat::Dxf)),
    ("obj", InputFormat::Mesh(MeshFormat::Obj)),
    ("stl", InputFormat::Mesh(MeshFormat::Stl)),
    ("ply", InputFormat::Mesh(MeshFormat::Ply)),
    ("glb", InputFormat::Mesh(MeshFormat::Glb)),
];

/// The design in some bytes, which are of this format or show it themselves. `name` is its name
/// where they do not say one; tables and meshes that it refers to lie in `folder`.
pub(crate) fn design_of_bytes(
    bytes: &[u8],
    format: Option<&str>,
    name: &str,
    folder: Option<&Path>,
    options: &ReadOptions,
) -> Result<Design, Failure> {
    let names = FORMATS.map(|(name, _)| name);
    let format = match format {
        Some(given) => FORMATS
            .into_iter()
            .find(|(name, _)| *name == given)
            .ok_or_else(|| Failure::of_choice("format", given, &names))?,
        None => {
            let shown = InputFormat::of_bytes(bytes);
            let known = FORMATS.into_iter().find(|(_, format)| Some(*format) == shown);
            known.ok_or_else(|| {
                let hint = format!("Give format=, one of {}.", names.join(", "));
                Failure::new("the bytes show no format that is known", hint)
            })?
        }
    };
    let ending = if format.0 == "json" { "sheet.json" } else { format.0 };
    Ok(read_bytes(format.1, bytes, &format!("{name}.{ending}"), folder, options)?)
}

/// The curves that bound a panel, as arrays of shape (N, 3).
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct BoundArrays<'py> {
    /// Whether they are two rails; else they are closed, an outline and its holes.
    is_rails: bool,
    /// How points make a curve, by name; `samples` where they are the samples themselves.
    kind: String,
    /// The points of each, mm.
    curves: Vec<PyReadonlyArray2<'py, f64>>,
}

/// The curves that bound a panel.
pub(crate) struct Bounds {
    is_rails: bool,
    kind: Option<CurveKind>,
    curves: Vec<Vec<Point3>>,
}

impl BoundArrays<'_> {
    /// Copies the points, so that no array is needed while the panel is made.
    pub(crate) fn copied(&self) -> Result<Bounds, Failure> {
        const KINDS: [(&str, Option<CurveKind>); 4] = [
            ("samples", None),
            ("polyline", Some(CurveKind::Polyline)),
            ("spline", Some(CurveKind::Spline)),
            ("bspline", Some(CurveKind::BSpline)),
        ];
        let known = KINDS.into_iter().find(|(name, _)| *name == self.kind);
        let (_, kind) = known
            .ok_or_else(|| Failure::of_choice("kind", &self.kind, &KINDS.map(|(name, _)| name)))?;
        let copied = |(n, curve): (usize, &PyReadonlyArray2<'_, f64>)| {
            points3(curve, &curve_name(self.is_rails, n))
        };
        let curves = self.curves.iter().enumerate().map(copied).collect::<Result<_, _>>()?;
        Ok(Bounds { is_rails: self.is_rails, kind, curves })
    }
}

fn curve_name(is_rails: bool, number: usize) -> String {
    match (is_rails, number) {
        (true, _) => format!("rail-{}", number + 1),
        (false, 0) => "outline".to_owned(),
        (false, _) => format!("hole-{number}"),
    }
}

impl Bounds {
    /// The design of one panel inside these curves, as the command reads it from a curve table
    /// where the points are the samples, else from a design.
    pub(crate) fn design(self, name: &str, options: &ReadOptions) -> Result<Design, Failure> {
        let Self { is_rails, kind, curves } = self;
        let curve = |(n, points): (usize, Vec<Point3>)| DesignCurve {
            name: curve_name(is_rails, n),
            kind,
            closed: !is_rails,
            points: points.into_iter().map(CurvePoint::smooth).collect(),
        };
        let mut curves: Vec<DesignCurve> = curves.into_iter().enumerate().map(curve).collect();
        if !is_rails && kind.is_none() {
            return design_of_bytes(&write_table(&curves), Some("csv"), name, None, options);
        }
        let design = if is_rails {
            let rails: [DesignCurve; 2] = curves
                .try_into()
                .map_err(|_| Failure::new("rails are two curves", "Give rails=(a, b)."))?;
            Design::between(name, rails)
        } else {
            if curves.is_empty() {
                return Err(Failure::new("there is no boundary", "Give an array of shape (N, 3)."));
            }
            let outline = curves.remove(0);
            Design::inside(name, outline, curves)
        };
        design_of_bytes(&write_design(&design), Some("json"), name, None, options)
    }
}

/// The design of a mesh, as the command reads it from an OBJ file, where seams are lines.
pub(crate) fn design_of_mesh(
    vertices: &[Point3],
    faces: &[[usize; 3]],
    seams: &[[usize; 2]],
    name: &str,
    options: &ReadOptions,
) -> Result<Design, Failure> {
    let mut text = String::with_capacity(64 * vertices.len() + 24 * faces.len());
    // Writing to a string can't fail. Numbers are written so that they read back to their bits.
    for p in vertices {
        let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
    }
    for [a, b, c] in faces {
        let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    for [a, b] in seams {
        let _ = writeln!(text, "l {} {}", a + 1, b + 1);
    }
    design_of_bytes(text.as_bytes(), Some("obj"), name, None, options)
}
