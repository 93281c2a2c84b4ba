//! Panels for another program that computes shells: the flat outline, the way on which it is held
//! to its place in space, and our own strain. `bench/peers/bend` calls it and compares.
//!
//! A program that begins with the flat sheet needs a way to the shape on which nothing is strained
//! much. The triangles of a surface that was found hang together like a tree, so their creases can
//! be opened one as far as the other: between flat and shape lie surfaces with all lengths kept.

use sheetwright::elastic::{ElasticOptions, Stiffness, elastic};
use sheetwright::make::{Judging, Part, make_judged};
use sheetwright::math::{Point2, Point3, Vec3, atan2, cos, sin, unit};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::bent;
use std::error::Error;
use std::fmt::Write;
use std::path::Path;

/// Poisson's number: shells that another program makes bricks of are compared at 0.
const POISSON: f64 = 0.0;
const MODULUS_N_PER_MM2: f64 = 210_000.0;
const THICKNESS_MM: f64 = 1.0;
/// Our nets: the one that verdicts begin with, and a fine one.
const TRIANGLES: [usize; 2] = [350, 2000];
/// Stops on the way from flat to shape.
const STOPS: usize = 24;

/// `bend-peers DIR`: writes a file for each panel.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(2).ok_or("usage: bench/peers/bend")?;
    let panels = [
        ("cylinder", bent::cylinder(400.0)),
        ("cone", bent::cone([450.0, 250.0])),
        ("twisted", bent::twisted(20.0)),
        ("wavy", bent::wavy(60.0, 0.8)),
        ("saddle", bent::saddle(80.0)),
    ];
    for (name, design) in panels {
        let made = make_judged(&design, Judging::Quick, &mut Unwatched)?;
        let text = described(&made.parts[0])?;
        std::fs::write(Path::new(&folder).join(format!("{name}.txt")), text)?;
        println!("wrote {name}: {}", design.name);
    }
    Ok(())
}

/// The panel as a text: thickness and modulus, our strains, the corners of the outline by their
/// numbers, the outline flat, and the outline at every stop.
fn described(part: &Part) -> Result<String, Box<dyn Error>> {
    let stiffness = Stiffness::new(THICKNESS_MM, MODULUS_N_PER_MM2, POISSON);
    let mut text = format!("sheet {THICKNESS_MM} {MODULUS_N_PER_MM2}\n");
    for triangles in TRIANGLES {
        let options = ElasticOptions { triangles, ..ElasticOptions::default() };
        let rest = elastic(&part.sheet, &part.flat, stiffness, &options, &mut Unwatched)?;
        writeln!(text, "ours {triangles} {:e}", rest.strain())?;
    }
    let line = &part.sheet.loops()[0];
    let found = part.found().ok_or("a surface that was found")?;
    let corners = found.boundary.samples().iter().enumerate();
    let corners = corners.filter(|(_, s)| s.tangent_in.dot(s.tangent_out) < 0.5);
    write!(text, "corners")?;
    for (n, _) in corners {
        write!(text, " {n}")?;
    }
    writeln!(text)?;
    for v in line {
        let p = part.flat.points[v.get()];
        writeln!(text, "flat {} {}", p.x, p.y)?;
    }
    for stop in 1..=STOPS {
        let positions = opened(part, stop as f64 / STOPS as f64);
        for v in line {
            let p = positions[v.get()];
            writeln!(text, "stop {stop} {} {} {}", p.x, p.y, p.z)?;
        }
    }
    Ok(text)
}

/// The vertices of the surface with every crease opened to this share of its angle.
fn opened(part: &Part, share: f64) -> Vec<Point3> {
    let mesh = part.sheet.mesh();
    let triangles = mesh.triangles();
    let flat = |v: usize| part.flat.points[v];
    let mut positions: Vec<Point3> =
        part.flat.points.iter().map(|p| Point3::new(p.x, p.y, 0.0)).collect();
    let root = triangles.len() / 2;
    let mut normals: Vec<Option<Vec3>> = vec![None; triangles.len()];
    normals[root] = Some(Vec3::Z);
    let mut waiting = vec![root];
    while let Some(here) = waiting.pop() {
        let Some(normal) = normals[here] else { continue };
        for side in mesh.topology().edges_of(sheetwright::index::TriangleIndex::new(here)) {
            let beside = mesh.edges()[side].triangles.into_iter().flatten();
            let Some(next) = beside.map(|t| t.get()).find(|&t| normals[t].is_none()) else {
                continue;
            };
            let corners = triangles[here].map(|v| v.get());
            let k = (0..3).find(|&k| !triangles[next].iter().any(|v| v.get() == corners[k]));
            let Some(k) = k else { continue };
            let [a, b] = [corners[(k + 1) % 3], corners[(k + 2) % 3]];
            let Some(c) = triangles[next].map(|v| v.get()).into_iter().find(|&v| v != a && v != b)
            else {
                continue;
            };
            let angle = share * crease(mesh.positions(), [corners[k], a, b, c]);
            let along = unit(positions[b] - positions[a]).unwrap_or(Vec3::X);
            let outward = along.cross(normal);
            let way = outward * cos(angle) + normal * sin(angle);
            normals[next] = Some(normal * cos(angle) - outward * sin(angle));
            let [far, off] = across(flat(a), flat(b), flat(c));
            positions[c] = positions[a] + along * far + way * off;
            waiting.push(next);
        }
    }
    positions
}

/// How far a point lies along a line from `a` to `b`, and how far to its right.
fn across(a: Point2, b: Point2, c: Point2) -> [f64; 2] {
    let along = (b - a) / a.distance(b);
    [along.dot(c - a), -along.perp_dot(c - a)]
}

/// The angle by which the triangle `a b c` turns up out of the plane of `before a b`.
fn crease(positions: &[Point3], [before, a, b, c]: [usize; 4]) -> f64 {
    let [before, a, b, c] = [before, a, b, c].map(|v| positions[v]);
    let along = unit(b - a).unwrap_or(Vec3::X);
    let normal = unit((b - a).cross(before - a)).unwrap_or(Vec3::Z);
    let outward = along.cross(normal);
    atan2((c - a).dot(normal), (c - a).dot(outward))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests panic

    use super::*;

    #[test]
    fn lengths_stay_on_the_way_and_its_end_is_the_shape() {
        let made = make_judged(&bent::twisted(20.0), Judging::Quick, &mut Unwatched).unwrap();
        let part = &made.parts[0];
        let mesh = part.sheet.mesh();
        for share in [0.0, 0.3, 1.0] {
            let positions = opened(part, share);
            for edge in mesh.edges() {
                let [a, b] = edge.ends;
                let length = mesh.position(a).distance(mesh.position(b));
                let now = positions[a.get()].distance(positions[b.get()]);
                assert!((now / length - 1.0).abs() < 1e-9, "{share}");
            }
            if share == 1.0 {
                let ends = [0, mesh.positions().len() / 2];
                let apart = |at: &[Point3]| at[ends[0]].distance(at[ends[1]]);
                assert!((apart(&positions) / apart(mesh.positions()) - 1.0).abs() < 1e-9);
            }
        }
    }
}
