use super::*;
use crate::linework::{is_lines, lines_beside};
use crate::mesh::MeshFormat;

const RAILS: &str = "# units: m\no hull\ng keel\nv 0 0 0\nv 1 0 0.1\nv 2 0 0\nl 1 2 3\n\
                     g sheer\nv 0 1 1\nv 2 1 1\nl -2 -1\n";

#[test]
fn lines_without_faces_are_curves() {
    assert!(is_lines(RAILS.as_bytes()));
    let design = read(DrawingFormat::Obj, RAILS.as_bytes(), "a.obj", &options()).unwrap();
    assert_eq!(shapes(&design), [["keel", "sheer"]]);
    has_lengths(&design, &[2000.0 * 1.01f64.sqrt(), 2000.0], RAILS);
    assert_eq!(lines_beside(MeshFormat::Obj, RAILS.as_bytes(), 0), []);
}

#[test]
fn loose_edges_in_any_order_are_chained() {
    let edges = "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nl 3 4\nl 1 2\nl 3 2\nl 4 1\n";
    let design = read(DrawingFormat::Obj, edges.as_bytes(), "a.obj", &options()).unwrap();
    has_lengths(&design, &[36.0], edges);
}

#[test]
fn lines_beside_faces_are_counted() {
    let both = format!("{RAILS}f 1 2 3\n");
    assert!(!is_lines(both.as_bytes()));
    let notes = lines_beside(MeshFormat::Obj, both.as_bytes(), 0);
    let count = |note: &ReadNote| matches!(note, ReadNote::NotUsed { count: 2, .. });
    assert!(notes.len() == 1 && count(&notes[0]), "{notes:?}");
}

#[test]
fn a_line_to_nowhere_is_refused() {
    let error = read(DrawingFormat::Obj, b"v 0 0 0\nl 1 2\n", "a.obj", &options()).unwrap_err();
    assert_eq!(error.to_string(), "a.obj:2: '2' names no point above this line");
}
