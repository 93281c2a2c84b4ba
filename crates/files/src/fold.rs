//! Patterns as FOLD, the format of origami programs: the triangles of every part as they lie flat,
//! with the angle by which each side between two of them is folded.

use serde::Serialize;
use sheetwright::make::{Made, Part};
use sheetwright::math::to_deg;

/// The version of the format.
const SPEC: f64 = 1.2;
/// Sides that are folded by less, degrees, are flat: rounding alone.
const FLAT_DEG: f64 = 1e-9;

#[derive(Serialize)]
struct File {
    file_spec: f64,
    file_creator: &'static str,
    file_title: String,
    file_classes: [&'static str; 1],
    #[serde(flatten)]
    first: Option<Frame>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    file_frames: Vec<Frame>,
}

#[derive(Serialize)]
struct Frame {
    frame_title: String,
    frame_classes: [&'static str; 1],
    frame_attributes: [&'static str; 2],
    frame_unit: &'static str,
    vertices_coords: Vec<[f64; 2]>,
    edges_vertices: Vec<[usize; 2]>,
    edges_assignment: Vec<&'static str>,
    #[serde(rename = "edges_foldAngle")]
    edges_fold_angle: Vec<f64>,
    faces_vertices: Vec<[usize; 3]>,
}

/// The FOLD file of all parts. `docs/outputs.md` specifies it for readers.
pub fn write_fold(made: &Made) -> Vec<u8> {
    let mut frames = made.parts.iter().map(frame);
    let first = frames.next();
    let file = File {
        file_spec: SPEC,
        file_creator: "Sheetwright",
        file_title: made.name.clone(),
        file_classes: [if made.parts.len() > 1 { "multiModel" } else { "singleModel" }],
        first,
        file_frames: frames.collect(),
    };
    // Numbers, texts and lists always become JSON: coordinates are finite.
    let mut json = serde_json::to_vec(&file).unwrap_or_default();
    json.push(b'\n');
    json
}

fn frame(part: &Part) -> Frame {
    let mesh = part.sheet.mesh();
    let folds: Vec<f64> = mesh
        .edges()
        .iter()
        .map(|edge| match edge.triangles {
            // Rounding alone turns it.
            _ if part.sheet.is_within_face(edge) => 0.0,
            // Positive in FOLD is a valley, towards the viewer; of a crease, away from it.
            [Some(a), Some(b)] => 0.0 - to_deg(mesh.crease(edge.ends, [a, b])),
            _ => 0.0,
        })
        .map(|deg| if deg.abs() <= FLAT_DEG { 0.0 } else { deg })
        .collect();
    let assignment =
        |(edge, &deg): (&sheetwright::mesh::MeshEdge, &f64)| match (edge.is_border(), deg) {
            (true, _) => "B",
            (false, 0.0) => "F",
            (false, deg) if deg > 0.0 => "V",
            (false, _) => "M",
        };
    Frame {
        frame_title: part.name.clone(),
        frame_classes: ["creasePattern"],
        frame_attributes: ["2D", "orientable"],
        frame_unit: "mm",
        vertices_coords: part.flat.points.iter().map(|p| [p.x + 0.0, p.y + 0.0]).collect(),
        edges_vertices: mesh.edges().iter().map(|edge| edge.ends.map(|v| v.get())).collect(),
        edges_assignment: mesh.edges().iter().zip(&folds).map(assignment).collect(),
        edges_fold_angle: folds,
        faces_vertices: mesh.triangles().iter().map(|t| t.map(|v| v.get())).collect(),
    }
}
