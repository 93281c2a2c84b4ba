use super::*;

fn v(n: usize) -> VertexIndex {
    VertexIndex::new(n)
}

fn mesh(positions: &[[f64; 3]], triangles: &[[usize; 3]]) -> Result<Mesh, MeshError> {
    let positions = positions.iter().map(|&[x, y, z]| Point3::new(x, y, z)).collect();
    Mesh::new(positions, triangles.iter().map(|t| t.map(v)).collect())
}

/// A grid of `columns` × `rows` vertices, column after column, in two triangles a cell; `name`
/// tells the vertex of a column and a row.
fn grid(columns: usize, rows: usize, name: impl Fn(usize, usize) -> usize) -> Vec<[usize; 3]> {
    let mut triangles = Vec::new();
    for i in 0..columns - 1 {
        for j in 0..rows - 1 {
            let [a, b, c, d] =
                [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| name(i, j));
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    triangles
}

/// Places in general position, so that no triangle over them is without area.
fn scattered(count: usize) -> Vec<[f64; 3]> {
    let mut random = 1u64;
    let mut next = || {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (random >> 40) as f64
    };
    (0..count).map(|_| [next(), next(), next()]).collect()
}

const SQUARE: [[f64; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];

#[test]
fn a_square_is_a_disk() {
    let m = mesh(&SQUARE, &[[0, 1, 2], [0, 2, 3]]).unwrap();
    assert_eq!(m.edges().len(), 5);
    assert_eq!(m.edges()[1].ends, [v(0), v(2)]);
    let sides = [TriangleIndex::new(1), TriangleIndex::new(0)].map(Some);
    assert_eq!(m.edges()[1].triangles, sides);
    assert_eq!(m.loops(), [[0, 1, 2, 3].map(v).to_vec()]);
    assert_eq!((m.euler(), m.components().len()), (1, 1));
    assert!(m.components()[0].is_disk());
    assert_eq!(m.lengths()[1], 2f64.sqrt());
}

#[test]
fn the_fewer_are_turned_round() {
    let strip = grid(2, 4, |i, j| 4 * i + j);
    let right = mesh(&scattered(8), &strip).unwrap();
    let mut wrong = strip.clone();
    for n in [0, 3] {
        wrong[n].swap(1, 2);
    }
    let mended = mesh(&scattered(8), &wrong).unwrap();
    assert_eq!(mended, right);
    for (n, corners) in mended.triangles().iter().enumerate() {
        let edges = mended.topology().edges_of(TriangleIndex::new(n));
        for at in 0..3 {
            let (a, b) = (corners[at], corners[(at + 1) % 3]);
            assert_eq!(mended.topology().edge_between(a, b), Some(edges[at]));
            let place = usize::from(a > b);
            assert_eq!(
                mended.edges()[edges[at]].triangles[place],
                Some(TriangleIndex::new(n)),
                "the side runs with its triangle"
            );
        }
    }
}

#[test]
fn what_is_no_mesh_is_refused_in_words() {
    let t = TriangleIndex::new;
    assert_eq!(mesh(&[], &[]), Err(MeshError::Empty));
    assert_eq!(mesh(&SQUARE, &[]), Err(MeshError::Empty));
    assert_eq!(mesh(&SQUARE, &[[0, 1, 4]]), Err(MeshError::BadCorner { triangle: t(0) }));
    assert_eq!(mesh(&SQUARE, &[[0, 1, 2]]), Err(MeshError::Unused { vertex: v(3) }));
    let nan = [[0., 0., 0.], [1., f64::NAN, 0.], [1., 1., 0.]];
    assert_eq!(mesh(&nan, &[[0, 1, 2]]), Err(MeshError::NotFinite { vertex: v(1) }));
    let on_a_line = [[0., 0., 0.], [1., 1., 1.], [3., 3., 3.]];
    let degenerate = Err(MeshError::Degenerate { triangle: t(0) });
    assert_eq!(mesh(&on_a_line, &[[0, 1, 2]]), degenerate);
    assert_eq!(mesh(&SQUARE, &[[0, 1, 1]]), degenerate);
    let far = [[0., 0., 0.], [1e200, 0., 0.], [0., 1e200, 0.]];
    assert_eq!(mesh(&far, &[[0, 1, 2]]), degenerate, "products out of range");
    let fin = [[0, 1, 2], [0, 1, 3], [0, 1, 4]];
    let refused = mesh(&scattered(5), &fin).unwrap_err();
    assert_eq!(refused, MeshError::NotManifold { from: v(0), to: v(1) });
    assert_eq!(refused.to_string(), "the side v0–v1 belongs to more than two triangles");
    let bow = [[0, 1, 2], [0, 3, 4]];
    assert_eq!(mesh(&scattered(5), &bow), Err(MeshError::PinchedVertex { vertex: v(0) }));
}

#[test]
fn surfaces_with_one_side_are_refused() {
    // Six columns; the seventh is the first, upside down.
    let moebius = grid(7, 3, |i, j| if i < 6 { 3 * i + j } else { 2 - j });
    let refused = mesh(&scattered(18), &moebius);
    assert!(matches!(refused, Err(MeshError::NotOrientable { .. })), "{refused:?}");
    // The rows close as well, and the columns with a reflection: a Klein bottle.
    let klein = grid(7, 6, |i, j| {
        let (i, j) = (i, j % 5);
        if i < 6 { 5 * i + j } else { (5 - j) % 5 }
    });
    let refused = mesh(&scattered(30), &klein);
    assert!(matches!(refused, Err(MeshError::NotOrientable { .. })), "{refused:?}");
}

#[test]
fn rings_spheres_and_tori_are_told_apart() {
    let tube = mesh(&scattered(18), &grid(7, 3, |i, j| 3 * (i % 6) + j)).unwrap();
    assert_eq!((tube.euler(), tube.loops().len()), (0, 2));
    assert_eq!(tube.components()[0].handles(), 0);
    let torus = mesh(&scattered(30), &grid(7, 6, |i, j| 5 * (i % 6) + j % 5)).unwrap();
    assert_eq!((torus.euler(), torus.loops().len()), (0, 0));
    assert_eq!(torus.components()[0].handles(), 1);
    let ball = mesh(&scattered(4), &[[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]).unwrap();
    assert_eq!(ball.euler(), 2);
    assert!(ball.components()[0].is_closed());
}

#[test]
fn components_come_apart_and_the_longest_loop_comes_first() {
    let mut positions = SQUARE.to_vec();
    positions.extend(SQUARE.map(|[x, y, z]| [3.0 * x, 3.0 * y, z + 1.0]));
    let both = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
    let m = mesh(&positions, &both).unwrap();
    assert_eq!(m.components().len(), 2);
    assert_eq!(m.loops()[0][0], v(4));
    assert_eq!(m.components()[0].loops, [1]);
    let (second, vertices) = m.part(&m.components()[1].triangles).unwrap();
    assert_eq!(vertices, [4, 5, 6, 7].map(v));
    assert_eq!(second.triangles(), m.part(&m.components()[0].triangles).unwrap().0.triangles());
    assert_eq!(second.lengths()[0], 3.0);
    assert_eq!(m.part(&[]), Err(MeshError::Empty));
}
