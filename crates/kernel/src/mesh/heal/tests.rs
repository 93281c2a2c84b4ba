use super::*;
use crate::mesh::{Mesh, MeshError, separated};
use sheetwright_geometry::index::TriangleIndex;
use sheetwright_geometry::math::{cos, sin};

fn v(n: usize) -> VertexIndex {
    VertexIndex::new(n)
}

type Soup = (Vec<Point3>, Vec<[VertexIndex; 3]>);

fn soup(positions: &[[f64; 3]], triangles: &[[usize; 3]]) -> Soup {
    let positions = positions.iter().map(|&[x, y, z]| Point3::new(x, y, z)).collect();
    (positions, triangles.iter().map(|t| t.map(v)).collect())
}

/// Heals a mesh, checks that this makes a mesh that needs no more, and tells what was done.
fn heal((positions, triangles): &Soup) -> (Mesh, Vec<(Damage, usize)>) {
    let Some(healed) = healed(positions, triangles) else {
        return (Mesh::new(positions.clone(), triangles.clone()).unwrap(), Vec::new());
    };
    assert_eq!(super::healed(&healed.positions, &healed.triangles), None, "healed twice");
    let apart = separated(&healed.triangles, |_| false);
    let positions = apart.origin.iter().map(|v| healed.positions[v.get()]).collect();
    let mesh = Mesh::new(positions, apart.triangles).unwrap();
    (mesh, healed.healings.iter().map(|healing| (healing.damage, healing.count)).collect())
}

fn area(mesh: &Mesh) -> f64 {
    let numbers = 0..mesh.triangles().len();
    numbers.map(|n| mesh.area_vector(TriangleIndex::new(n)).length()).sum()
}

/// Components, loops of the border and area.
fn shape(mesh: &Mesh) -> (usize, usize, f64) {
    (mesh.components().len(), mesh.loops().len(), area(mesh))
}

/// Two quads that meet at x = 10, each with points of its own.
const SEAM: [[f64; 3]; 8] = [
    [0., 0., 0.],
    [10., 0., 0.],
    [10., 10., 0.],
    [0., 10., 0.],
    [10., 0., 0.],
    [10., 0., 10.],
    [10., 10., 10.],
    [10., 10., 0.],
];
const TWO_QUADS: [[usize; 3]; 4] = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];

#[test]
fn points_of_a_seam_are_one_also_where_their_last_digits_differ() {
    // The second quad runs the other way round, which does not show until they hang together.
    for off in [0.0, 1e-6, -3e-5] {
        let mut positions = SEAM;
        positions[4][1] += off;
        positions[7][0] += off;
        let (mesh, healings) = heal(&soup(&positions, &TWO_QUADS));
        assert_eq!(healings, [(Damage::Seam, 2)]);
        assert_eq!(shape(&mesh), (1, 1, 200.0));
    }
    // A hundredth of a millimetre apart, they are meant to be apart.
    let mut positions = SEAM;
    positions[7][0] += 0.01;
    assert_eq!(heal(&soup(&positions, &TWO_QUADS)).1, []);
}

#[test]
fn points_without_a_side_in_common_stay_apart() {
    let mut positions = SEAM;
    positions[7][1] = 20.0;
    positions[6][1] = 20.0;
    let touching = soup(&positions, &TWO_QUADS);
    // The side of the other quad is longer: it is divided where this one ends.
    assert_eq!(heal(&touching).1, [(Damage::Seam, 1), (Damage::OnSide, 1)]);
    positions[7] = [20.0, 10.0, 0.0];
    assert_eq!(heal(&soup(&positions, &TWO_QUADS)).1, [], "they meet in a point");
}

#[test]
fn sides_are_divided_where_points_lie_on_them() {
    let flat = [[0., 0., 0.], [10., 0., 0.], [10., 10., 0.], [0., 10., 0.], [10., 5., 0.]];
    let on = |z: f64| [[20., 0., z], [20., 5., z], [20., 10., z]];
    for z in [0.0, 7.0] {
        let t = soup(
            &[&flat[..], &on(z)].concat(),
            &[[0, 1, 2], [0, 2, 3], [1, 5, 6], [1, 6, 4], [4, 6, 7], [4, 7, 2]],
        );
        let (mesh, healings) = heal(&t);
        assert_eq!(healings, [(Damage::OnSide, 1)]);
        let (components, loops, found) = shape(&mesh);
        let wanted = 100.0 + 10.0 * (100.0 + z * z).sqrt();
        assert_eq!((components, loops), (1, 1));
        assert!((found - wanted).abs() < 1e-12 * wanted, "{found} {wanted}");
    }
}

#[test]
fn sides_that_overlap_in_part_are_divided_on_both_sides() {
    // Bricks: three below, two above, and none of their ends in line.
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for (from, to, y) in
        [(0., 10., 0.), (10., 20., 0.), (20., 30., 0.), (5., 15., 1.), (15., 25., 1.)]
    {
        let n = positions.len();
        positions.extend([[from, y, 0.], [to, y, 0.], [to, y + 1., 0.], [from, y + 1., 0.]]);
        triangles.extend([[n, n + 1, n + 2], [n, n + 2, n + 3]]);
    }
    let (mesh, healings) = heal(&soup(&positions, &triangles));
    assert_eq!(healings.iter().map(|h| h.0).collect::<Vec<_>>(), [Damage::Seam, Damage::OnSide]);
    assert_eq!(shape(&mesh), (1, 1, 50.0));
}

#[test]
fn a_filler_and_a_doubled_face_are_left_out() {
    let filled = soup(
        &[[0., 0., 0.], [10., 0., 0.], [10., 10., 0.], [0., 10., 0.], [5., 0., 0.], [5., -8., 2.]],
        &[[0, 2, 3], [0, 1, 2], [0, 4, 1], [0, 5, 4], [4, 5, 1], [2, 0, 3]],
    );
    let (mesh, healings) = heal(&filled);
    assert_eq!(healings, [(Damage::Filler, 1), (Damage::Doubled, 1), (Damage::OnSide, 1)]);
    let (components, loops, found) = shape(&mesh);
    assert_eq!((components, loops), (1, 1));
    assert!((found - 141.231056).abs() < 1e-6);
}

#[test]
fn fillers_within_fillers_divide_a_side_as_often() {
    // A square whose lower side is cut into eight below it, by fillers from the whole to the parts.
    let mut positions = vec![[0., 8., 0.], [8., 8., 0.]];
    positions.extend((0..=8).map(|n| [f64::from(n), 0., 0.]));
    positions.extend((0..=8).map(|n| [f64::from(n), -1., 0.]));
    let on = |n: usize| 2 + n;
    let mut triangles = vec![[0, on(0), on(8)], [0, on(8), 1]];
    for step in [8, 4, 2] {
        triangles.extend((0..8).step_by(step).map(|n| [on(n), on(n + step / 2), on(n + step)]));
    }
    for n in 0..8 {
        let [a, b, c, d] = [on(n), on(n + 1), on(n + 9), on(n + 10)];
        triangles.extend([[a, c, d], [a, d, b]]);
    }
    let (mesh, healings) = heal(&soup(&positions, &triangles));
    assert_eq!(healings, [(Damage::Filler, 7), (Damage::OnSide, 7)]);
    assert_eq!(shape(&mesh), (1, 1, 72.0));
}

/// A tilted square, its numbers rounded to three decimals, whose diagonal has a point in its middle
/// on one side, with a filler between that is as low as rounding makes it.
#[test]
fn a_filler_that_rounding_turned_is_left_out() {
    let positions = [
        [1.0, 2.0, 3.0],
        [-48.25, 45.309, 35.059],
        [-52.922, -1.393, 90.971],
        [-3.672, -44.702, 58.912],
        [-23.625, 23.654, 19.03],
        [-9.151, 68.15, -18.844],
    ];
    let triangles = [[0, 2, 3], [0, 1, 2], [0, 4, 1], [0, 5, 4], [4, 5, 1]];
    let (mesh, healings) = heal(&soup(&positions, &triangles));
    assert_eq!(healings, [(Damage::Filler, 1), (Damage::OnSide, 1)]);
    assert_eq!(shape(&mesh).0, 1);
}

/// The ears of a round face are as low, but lie in its plane.
#[test]
fn ears_of_a_round_face_are_no_fillers() {
    const COUNT: usize = 340;
    let rounded = |x: f64| (100.0 * x).round() / 100.0;
    let corner = |n: usize| {
        let angle = std::f64::consts::TAU * n as f64 / COUNT as f64;
        [50.0 * cos(angle), 50.0 * sin(angle), 0.0].map(rounded)
    };
    let positions: Vec<[f64; 3]> = (0..COUNT).map(corner).collect();
    let ears = (0..COUNT).step_by(2).map(|n| [n, n + 1, (n + 2) % COUNT]);
    let fan = (2..COUNT - 2).step_by(2).map(|n| [0, n, n + 2]);
    let triangles: Vec<[usize; 3]> = ears.chain(fan).collect();
    assert_eq!(heal(&soup(&positions, &triangles)).1, []);
}

#[test]
fn a_rib_is_parted_from_its_plate_which_stays_whole() {
    let positions = [[0., 0., 0.], [10., 0., 0.], [5., 8., 0.], [5., -8., 0.], [5., 0., 8.]];
    let (mesh, healings) = heal(&soup(&positions, &[[0, 1, 4], [0, 1, 2], [1, 0, 3]]));
    assert_eq!(healings, [(Damage::Branch, 1)]);
    let triangles: Vec<usize> = mesh.components().iter().map(|c| c.triangles.len()).collect();
    assert_eq!(triangles, [1, 2]);
}

/// The triangles of a box by its eight corners, x first, then y, then z.
fn cuboid(corner: impl Fn(usize) -> usize) -> Vec<[usize; 3]> {
    let quads =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).map(|t| t.map(&corner)).collect()
}

fn corner_of(n: usize, low: [f64; 3], size: f64) -> [f64; 3] {
    [0, 1, 2].map(|axis| low[axis] + if n >> axis & 1 == 1 { size } else { 0.0 })
}

#[test]
fn boxes_that_touch_along_an_edge_are_two_boxes() {
    // The second one's corners 0 and 4 are the first one's 3 and 7.
    let mut positions: Vec<[f64; 3]> = (0..8).map(|n| corner_of(n, [0.0; 3], 1.0)).collect();
    positions.extend((0..8).map(|n| corner_of(n, [1.0, 1.0, 0.0], 1.0)));
    let second = |n: usize| match n {
        0 => 3,
        4 => 7,
        _ => 8 + n,
    };
    let (mesh, healings) = heal(&soup(&positions, &[cuboid(|n| n), cuboid(second)].concat()));
    assert_eq!(healings, [(Damage::Branch, 1)]);
    assert_eq!(shape(&mesh), (2, 0, 12.0));
}

#[test]
fn a_closed_mesh_faces_outwards_and_its_turned_faces_with_it() {
    let positions: Vec<[f64; 3]> = (0..8).map(|n| corner_of(n, [5e6, 7e7, 0.0], 10.0)).collect();
    let outwards = soup(&positions, &cuboid(|n| n));
    assert_eq!(healed(&outwards.0, &outwards.1), None);
    let mut inwards = outwards.clone();
    inwards.1.iter_mut().for_each(|t| t.swap(1, 2));
    let (mesh, healings) = heal(&inwards);
    assert_eq!(healings, [(Damage::InsideOut, 1)]);
    assert_eq!(mesh, Mesh::new(outwards.0.clone(), outwards.1.clone()).unwrap());
    let mut turned = outwards.clone();
    turned.1[3].swap(1, 2);
    turned.1[7].swap(1, 2);
    assert_eq!(heal(&turned).1, [(Damage::Turned, 2)]);
    // A hollow body: its inner wall faces into the hollow.
    let inner: Vec<[f64; 3]> =
        (0..8).map(|n| corner_of(n, [5e6 + 3.0, 7e7 + 3.0, 3.0], 4.0)).collect();
    let mut hollow =
        soup(&[positions, inner].concat(), &[cuboid(|n| n), cuboid(|n| 8 + n)].concat());
    hollow.1[12..].iter_mut().for_each(|t| t.swap(1, 2));
    assert_eq!(healed(&hollow.0, &hollow.1), None);
}

#[test]
fn a_narrow_strip_is_not_joined_with_itself() {
    // 100 by 0.002 mm, its points opposite one another and staggered.
    let below = (0..=100).map(|n| [f64::from(n), 0.0, 0.0]);
    let above = (0..=100).map(|n| [f64::from(n) + 0.5, 0.002, 0.0]);
    let positions: Vec<[f64; 3]> = below.chain(above).collect();
    let cells = (0..100).flat_map(|n| [[n, n + 1, n + 101], [n + 1, n + 102, n + 101]]);
    let strip = soup(&positions, &cells.collect::<Vec<_>>());
    assert_eq!(heal(&strip).1, []);
}

#[test]
fn what_is_no_mesh_stays_as_it_is() {
    let line = soup(&[[0., 0., 0.], [1., 0., 0.], [2., 0., 0.]], &[[0, 1, 2]]);
    assert_eq!(healed(&line.0, &line.1), None);
    let degenerate = MeshError::Degenerate { triangle: TriangleIndex::new(0) };
    assert_eq!(Mesh::new(line.0, line.1), Err(degenerate));
    let nowhere = soup(&[[0., 0., f64::NAN], [1., 0., 0.], [2., 0., 0.]], &[[0, 1, 2]]);
    assert_eq!(healed(&nowhere.0, &nowhere.1), None);
    let small = soup(&SEAM, &[[0, 1, 99]]);
    assert_eq!(healed(&small.0, &small.1), None);
}

#[test]
fn a_filler_and_its_neighbours_may_have_points_of_their_own() {
    let at = [[0., 0., 0.], [10., 0., 0.], [10., 10., 0.], [4., 0., 0.], [4., -8., 2.]];
    let triangles = [[0, 1, 2], [0, 3, 1], [0, 4, 3], [3, 4, 1]];
    let positions: Vec<[f64; 3]> = triangles.iter().flatten().map(|&n| at[n]).collect();
    let own: Vec<[usize; 3]> = (0..4).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect();
    let (mesh, healings) = heal(&soup(&positions, &own));
    assert_eq!(healings[0], (Damage::Filler, 1));
    assert_eq!(healings[2], (Damage::OnSide, 1));
    assert_eq!((mesh.components().len(), mesh.loops().len()), (1, 1));
    assert_eq!(mesh.positions().len(), 5);
}

#[test]
fn what_ends_at_a_side_is_divided_there_if_it_hangs_with_the_others_round_both_ends() {
    // Two boxes, one on the other, with a lid and a floor between whose diagonals differ. A wall of
    // the lower one lacks the triangle below its rim, where wall, lid and floor meet now.
    let corners = [[0., 0.], [30., 0.], [30., 20.], [0., 20.]];
    let positions: Vec<[f64; 3]> =
        [0.0, 10.0, 20.0].iter().flat_map(|&z| corners.map(|[x, y]| [x, y, z])).collect();
    let walls = |low: usize| {
        let side = move |k: usize| [low + k, low + (k + 1) % 4, low + 4 + (k + 1) % 4, low + 4 + k];
        (0..4).flat_map(move |k| {
            let [a, b, c, d] = side(k);
            [[a, b, c], [a, c, d]]
        })
    };
    let level = [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [5, 4, 7], [5, 7, 6]];
    let top = [[8, 9, 10], [8, 10, 11]];
    for missing in [1, 3, 5, 7] {
        let lower = walls(0).enumerate().filter(|&(n, _)| n != missing).map(|(_, t)| t);
        let triangles: Vec<[usize; 3]> = lower.chain(walls(4)).chain(level).chain(top).collect();
        let (mesh, healings) = heal(&soup(&positions, &triangles));
        let lost = if missing % 4 == 1 { 150.0 } else { 100.0 };
        assert!((area(&mesh) - (4.0 * 600.0 + 2000.0 - lost)).abs() < 1e-9, "{}", area(&mesh));
        assert!(healings.iter().any(|healing| healing.0 == Damage::Branch), "{healings:?}");
    }
}
