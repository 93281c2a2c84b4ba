//! What is cut: equal parts once, from the pattern of the first.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::design::{
    Allowance, Corner, Design, DesignPanel, Holes, PanelMesh, PanelShape, Triangles, Trim,
    TrimKind, TrimOn,
};
use sheetwright::make::{CutItem, Made, make};
use sheetwright::math::{Point2, Point3, Vec2, cos, sin};
use sheetwright::mesh::Mesh;
use sheetwright::pattern::{PathKind, Piece, Role, alike};
use sheetwright::template::template;
use sheetwright::watch::Unwatched;
use sheetwright_shapes::low_poly::animal;
use sheetwright_shapes::random::Random;
use sheetwright_shapes::solids::prism;
use std::f64::consts::TAU;

fn design(name: &str) -> Design {
    template(name).unwrap().defaults().design().unwrap()
}

fn made(design: &Design) -> Made {
    make(design, &mut Unwatched).unwrap()
}

/// The patterns by their names, with their quantities.
fn list(made: &Made) -> Vec<(String, usize, usize)> {
    let of_item = |item: &CutItem| {
        let quantity = item.quantity();
        (made.parts[item.first()].name.clone(), quantity.count, quantity.mirrored)
    };
    made.cut_list().iter().map(of_item).collect()
}

fn named(list: &[(&str, usize, usize)]) -> Vec<(String, usize, usize)> {
    list.iter().map(|&(name, count, mirrored)| (name.to_owned(), count, mirrored)).collect()
}

#[test]
fn equal_parts_of_templates_are_cut_from_one_pattern() {
    let of = |name: &str| list(&made(&design(name)));
    assert_eq!(of("dome"), named(&[("gore-1", 12, 0)]));
    assert_eq!(of("elbow"), named(&[("segment-1", 2, 0), ("segment-2", 3, 0)]));
    // A piece of a ball has a surface and its mirror image, equally good, so some lie turned over.
    let bands = [("band-1-1", 12, 0), ("band-2-1", 12, 6), ("band-3-1", 12, 4)];
    assert_eq!(of("hemisphere"), named(&bands));
    assert_eq!(of("facade"), named(&[("panel-1", 2, 1), ("panel-2", 2, 1), ("panel-3", 2, 1)]));
    assert_eq!(of("bag"), named(&[("front", 2, 0), ("gusset", 1, 0)]));
    assert_eq!(of("dinghy"), named(&[("bottom", 2, 1), ("side", 2, 1), ("transom", 1, 0)]));
}

/// Meshes whose facets are folded, each a panel, in pieces of at most this size, mm.
fn nets(meshes: &[Mesh], within: [f64; 2]) -> Made {
    let panel = |(n, mesh): (usize, &Mesh)| {
        let (positions, triangles) = (mesh.positions().to_vec(), mesh.triangles().to_vec());
        let triangles = Triangles { positions, triangles, left_out: 0 };
        let settings = PanelMesh {
            facets: Some(true),
            pieces_within_mm: Some(within),
            ..PanelMesh::new(triangles)
        };
        DesignPanel::new(format!("net-{n}"), PanelShape::Mesh(settings), 0)
    };
    made(&Design { panels: meshes.iter().enumerate().map(panel).collect(), ..Design::default() })
}

/// A symmetric model has pieces that are the mirror images of others, but turned over their
/// mountains would be valleys, and marks say where each piece goes.
#[test]
fn pieces_of_one_net_do_not_replace_one_another() {
    let bear = nets(&[animal().mesh()], [150.0, 110.0]);
    assert!(bear.parts.len() > 4, "{}", bear.parts.len());
    assert!(bear.cut_list().iter().all(|item| item.instances.len() == 1));
    let prisms = nets(&[prism(6, 20.0).mesh(), prism(6, 20.0).mesh()], [1e4, 1e4]);
    assert_eq!(list(&prisms), named(&[("net-0", 2, 0)]));
    // Its lids are facets by themselves, which no fold tells from other panels.
    let prism = nets(&[prism(6, 20.0).mesh()], [102.0, 90.0]);
    let lids = prism.parts.iter().filter(|part| part.piece.bends.is_empty());
    assert!(lids.count() >= 2 && prism.parts.len() > 2);
    assert!(prism.cut_list().iter().all(|item| item.instances.len() == 1), "{:?}", list(&prism));
}

/// A piece turned, moved, and maybe turned over.
fn moved(piece: &Piece, angle: f64, by: Vec2, is_mirror: bool) -> Piece {
    let mut moved = piece.clone();
    let to = |p: Point2| {
        let y = if is_mirror { -p.y } else { p.y };
        Point2::new(cos(angle) * p.x - sin(angle) * y, sin(angle) * p.x + cos(angle) * y) + by
    };
    for path in &mut moved.paths {
        path.points.iter_mut().for_each(|p| *p = to(*p));
        // Loops run round the sheet one way.
        if is_mirror && path.closed {
            path.points.reverse();
        }
    }
    moved.labels.iter_mut().for_each(|label| label.at = to(label.at));
    for p in &mut moved.border {
        p.z *= if is_mirror { -1.0 } else { 1.0 };
    }
    if is_mirror {
        moved.border.reverse();
    }
    moved
}

/// An allowance all round with rows of holes inside.
fn trims() -> Vec<Trim> {
    let width = [8.0, 8.0];
    let allowance = Allowance { width, corner: Corner::ByLength };
    let holes = Holes {
        pitch: 40.0,
        end_pitch: 40.0,
        end_length: 0.0,
        ends: 20.0,
        inset: 5.0,
        diameter: 2.0,
    };
    [TrimKind::Allowance(allowance), TrimKind::Holes(holes)]
        .map(|kind| Trim::new([TrimOn::All], kind))
        .to_vec()
}

#[test]
fn pieces_are_equal_however_they_lie() {
    let random = &mut Random::new(40);
    for name in ["dome", "reducer", "hopper", "bag", "dinghy"] {
        let mut design = design(name);
        design.trims = trims();
        for part in made(&design).parts {
            for is_mirror in [false, true] {
                let by = Vec2::new(random.between(-500.0, 500.0), random.between(-500.0, 500.0));
                let other = moved(&part.piece, random.between(0.0, TAU), by, is_mirror);
                for (a, b) in [(&part.piece, &other), (&other, &part.piece)] {
                    let found = alike(a, b, 1e-6);
                    assert!(found.is_some(), "{}, turned over: {is_mirror}", part.name);
                }
            }
        }
    }
}

#[test]
fn what_is_not_the_same_part() {
    let gore = made(&design("dome")).parts[0].piece.clone();
    let turned = || moved(&gore, 0.9, Vec2::new(12.0, 0.0), false);
    let mut corner = turned();
    corner.paths[0].points[5].x += 0.05;
    assert!(alike(&gore, &corner, 0.01).is_none() && alike(&gore, &corner, 0.1).is_some());
    let mut holed = turned();
    let mut hole = holed.paths[0].clone();
    (hole.kind, hole.role) = (PathKind::Hole, Role::Inner);
    holed.paths.push(hole);
    assert!(alike(&gore, &holed, 0.01).is_none() && alike(&holed, &gore, 0.01).is_none());
    // Flat as it is, in place of bent.
    let mut flat = turned();
    flat.border = gore.outline().iter().map(|p| Point3::new(p.x, p.y, 0.0)).collect();
    assert!(alike(&gore, &flat, 0.01).is_none());
}
