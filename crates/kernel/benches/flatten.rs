//! How fast meshes are laid flat, and how well: `cargo bench -p sheetwright --bench flatten --
//! MESH.obj`; without a file, a surface of its own, as fine as `--cells N` says, which `--write
//! FILE` only writes.
//!
//! `--closed N` instead times how a closed scan of 12 N² triangles is cut, flattened and judged.
//!
//! A line for each way: its name, seconds (the least of three runs, one thread), the mean and the
//! largest relative length error (every side counting the same), triangles turned over, steps, and
//! how it ended. The time is all from a validated mesh to the pattern with its overlap looked for;
//! reading and validating are told apart. `bench/peers/flatten` puts other programs beside it.
#![allow(clippy::print_stdout, clippy::unwrap_used)] // it prints; what fails should stop it

use sheetwright::design::{Design, DesignPanel, PanelMesh, PanelShape, Triangles};
use sheetwright::flatten::{Aim, RelaxOptions, relax};
use sheetwright::index::VertexIndex;
use sheetwright::make::make;
use sheetwright::math::Point3;
use sheetwright::measure::distortion;
use sheetwright::mesh::Mesh;
use sheetwright::watch::Unwatched;
use sheetwright_shapes::meshes::{bumpy, bumpy_ball};
use std::time::Instant;

const RUNS: usize = 3;

fn main() {
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
    let mut cells = 100;
    let mut file = None;
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--cells" => cells = arguments.next().unwrap().parse().unwrap(),
            "--closed" => return closed(arguments.next().unwrap().parse().unwrap()),
            "--write" => return write_obj(&arguments.next().unwrap(), &bumpy(cells)),
            _ => file = Some(argument),
        }
    }
    let (positions, triangles) = match &file {
        Some(path) => read_obj(&std::fs::read_to_string(path).unwrap()),
        None => {
            let mesh = bumpy(cells);
            (mesh.positions().to_vec(), mesh.triangles().to_vec())
        }
    };
    let start = Instant::now();
    let mesh = Mesh::new(positions, triangles).unwrap();
    println!(
        "# {} vertices, {} triangles, {} sides; validated in {:.4} s",
        mesh.positions().len(),
        mesh.triangles().len(),
        mesh.edges().len(),
        start.elapsed().as_secs_f64()
    );
    let of = |aim| RelaxOptions { aim, ..RelaxOptions::default() };
    let ways = [
        ("fast", RelaxOptions::FAST),
        ("mean", of(Aim::Mean)),
        ("max", of(Aim::Max)),
        ("seams", of(Aim::Seams)),
    ];
    for (name, options) in ways {
        let mut least = f64::INFINITY;
        let mut flat = None;
        for _ in 0..RUNS {
            let start = Instant::now();
            flat = Some(relax(&mesh, &options, &mut Unwatched).unwrap());
            least = least.min(start.elapsed().as_secs_f64());
        }
        let flat = flat.unwrap();
        let measures = distortion(&mesh, &flat.flat.points);
        println!(
            "{name} {least:.4} {:.9} {:.9} {} {} {:?}{}",
            measures.length_error_mean,
            measures.length_error_max,
            flat.flipped,
            flat.steps,
            flat.ended,
            if flat.flat.overlap.is_some() { " overlaps" } else { "" }
        );
    }
}

/// Prints the seconds that making a closed, bumpy ball of 12 `cells`² triangles takes, the least of
/// three runs.
fn closed(cells: usize) {
    let mesh = bumpy_ball(cells, 0.05);
    let (positions, triangles) = (mesh.positions().to_vec(), mesh.triangles().to_vec());
    let mesh = PanelMesh::new(Triangles { positions, triangles, left_out: 0 });
    let panel = DesignPanel::new("ball", PanelShape::Mesh(mesh), 100);
    let design = Design { panels: vec![panel], ..Design::default() };
    let mut least = f64::INFINITY;
    for _ in 0..RUNS {
        let start = Instant::now();
        make(&design, &mut Unwatched).unwrap();
        least = least.min(start.elapsed().as_secs_f64());
    }
    println!("closed, {} triangles: {least:.2} s", 12 * cells * cells);
}

fn write_obj(path: &str, mesh: &Mesh) {
    let vertices = mesh.positions().iter().map(|p| format!("v {} {} {}\n", p.x, p.y, p.z));
    let triangles = mesh.triangles().iter().map(|t| {
        let [a, b, c] = t.map(|v| v.get() + 1);
        format!("f {a} {b} {c}\n")
    });
    std::fs::write(path, vertices.chain(triangles).collect::<String>()).unwrap();
}

/// The vertices and triangles of an OBJ file that has nothing else.
fn read_obj(text: &str) -> (Vec<Point3>, Vec<[VertexIndex; 3]>) {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let [x, y, z] = std::array::from_fn(|_| words.next().unwrap().parse().unwrap());
                positions.push(Point3::new(x, y, z));
            }
            Some("f") => triangles.push(std::array::from_fn(|_| {
                let corner = words.next().unwrap().split('/').next().unwrap();
                VertexIndex::new(corner.parse::<usize>().unwrap() - 1)
            })),
            _ => {}
        }
    }
    (positions, triangles)
}
