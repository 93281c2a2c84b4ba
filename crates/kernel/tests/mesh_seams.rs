//! Meshes that are cut along seams which their makers chose.

#![allow(clippy::unwrap_used, reason = "a test that can't go on fails")]

use sheetwright::check::{FindingKind, SeamCause};
use sheetwright::design::{Design, DesignPanel, PanelMesh, PanelShape, Triangles};
use sheetwright::index::VertexIndex;
use sheetwright::make::{Made, MakeCause, MakeError, make};
use sheetwright::math::Point3;
use sheetwright::mesh::{SeamFault, Skin};
use sheetwright::watch::Unwatched;
use std::sync::Arc;

/// The corners of a cube of 10 mm: bit 0 of the number is x, bit 1 y, bit 2 z.
fn corner(n: usize) -> Point3 {
    let at = |bit: usize| if n >> bit & 1 == 1 { 10.0 } else { 0.0 };
    Point3::new(at(0), at(1), at(2))
}

fn cube() -> Triangles {
    let squares =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = squares.iter().flat_map(|&[a, b, c, d]: &[usize; 4]| [[a, b, c], [a, c, d]]);
    Triangles {
        positions: (0..8).map(corner).collect(),
        triangles: halves.map(|t| t.map(VertexIndex::new)).collect(),
        left_out: 0,
    }
}

fn try_make(settings: PanelMesh) -> Result<Made, MakeError> {
    let panel = DesignPanel::new("box", PanelShape::Mesh(settings), 0);
    make(&Design { panels: vec![panel], ..Design::default() }, &mut Unwatched)
}

fn cube_cut(facets: bool, seams: &[&[usize]]) -> Made {
    let way = |way: &&[usize]| way.iter().map(|&n| corner(n)).collect();
    let seams = Arc::new(seams.iter().map(way).collect());
    try_make(PanelMesh { facets: Some(facets), seams, ..PanelMesh::new(cube()) }).unwrap()
}

/// The ends of all seams within the parts.
fn seams_of(made: &Made) -> Vec<[Point3; 2]> {
    let ends = |part: &sheetwright::make::Part| -> Vec<[Point3; 2]> {
        let seams = part.sheet.seams().iter();
        let lines = seams.map(|seam| &seam.sides[0]);
        let steps = lines.flat_map(|side| side.windows(2).collect::<Vec<_>>());
        steps.map(|step| [step[0], step[1]].map(|v| part.sheet.mesh().position(v))).collect()
    };
    made.parts.iter().flat_map(ends).collect()
}

/// Why the first part is cut open, as its finding says.
fn why(made: &Made) -> Option<SeamCause> {
    let mut found = made.parts[0].checked.findings.iter();
    found.find_map(|finding| match finding.kind {
        FindingKind::Seams { why, .. } => Some(why),
        _ => None,
    })
}

/// A T that a box is made of: the lid hangs at the back, the sides at the bottom.
const CROSS: [&[usize]; 4] = [&[6, 4, 5, 7], &[0, 4], &[1, 5], &[2, 6]];

#[test]
fn a_box_is_cut_where_its_seams_say_and_nowhere_else() {
    for facets in [false, true] {
        // Seven sides open a cube into a cross.
        let made = cube_cut(facets, &[CROSS[0], CROSS[1], CROSS[2], CROSS[3], &[3, 7]]);
        assert_eq!(made.parts.len(), 1, "{facets}");
        let cut = seams_of(&made);
        for ends in &cut {
            let has = |n: usize| ends.contains(&corner(n));
            let given = [[6, 4], [4, 5], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];
            assert!(given.iter().any(|&[m, n]| has(m) && has(n)), "{facets} {ends:?}");
        }
        assert_eq!(cut.len(), 7, "{facets}");
        let cause = if facets { SeamCause::Facets } else { SeamCause::Chosen };
        assert_eq!(why(&made), Some(cause));
        let part = &made.parts[0];
        assert_eq!(part.flat.overlap, None);
        assert!(part.measures.length_error_max < 1e-9);
        assert!((part.measures.area_flat_mm2 - 600.0).abs() < 1e-6);
    }
}

#[test]
fn seams_that_enclose_a_face_part_it_from_the_rest() {
    for facets in [false, true] {
        let made = cube_cut(facets, &[&[4, 5, 7, 6, 4]]);
        let areas: Vec<f64> = made.parts.iter().map(|part| part.measures.area_flat_mm2).collect();
        assert_eq!(areas.len(), 2, "{facets}");
        let lid = areas.iter().filter(|area| (**area - 100.0).abs() < 1e-9);
        assert_eq!(lid.count(), 1, "{facets} {areas:?}");
        // Both pieces say what they are joined to.
        for part in &made.parts {
            assert!(part.edges.iter().any(|edge| !edge.mates.is_empty()), "{facets}");
        }
    }
}

#[test]
fn seams_that_open_too_little_are_cut_on() {
    // A side by itself opens nothing: as a surface, the cube is cut as if it had no seam.
    let cut = cube_cut(false, &[&[0, 4]]);
    assert_eq!(seams_of(&cut).len(), seams_of(&cube_cut(false, &[])).len());
    assert_eq!(why(&cut), Some(SeamCause::Closed));
    // Three in a row open it too little, so that it is folded, and they stay cuts of its net.
    for facets in [None, Some(true)] {
        let seams = Arc::new(vec![[0, 4, 5, 7].map(corner).to_vec()]);
        let made = try_make(PanelMesh { facets, seams, ..PanelMesh::new(cube()) }).unwrap();
        let part = &made.parts[0];
        assert_eq!((made.parts.len(), part.flat.overlap), (1, None));
        assert!(part.measures.length_error_max < 1e-9);
        for pair in [[0, 4], [4, 5], [5, 7]].map(|pair| pair.map(corner)) {
            let mut cut = seams_of(&made).into_iter();
            assert!(cut.any(|[a, b]| pair.contains(&a) && pair.contains(&b)), "{pair:?}");
        }
    }
}

#[test]
fn a_flat_face_is_cut_across_where_a_seam_parts_it() {
    // Half of the lid, along its diagonal.
    for facets in [false, true] {
        let made = cube_cut(facets, &[&[4, 5, 7, 4]]);
        let halves = made.parts.iter().filter(|part| part.sheet.mesh().triangles().len() == 1);
        assert_eq!(halves.count(), 1, "{facets}");
    }
}

#[test]
fn a_pyramid_is_cut_along_the_line_that_is_given() {
    let (tip, foot) = (Point3::new(5.0, 5.0, 30.0), [0, 1, 3, 2]);
    let sides = (0..4).map(|n| [n, (n + 1) % 4, 4].map(VertexIndex::new));
    for from in 0..4 {
        let triangles = Triangles {
            positions: foot.map(corner).into_iter().chain([tip]).collect(),
            triangles: sides.clone().collect(),
            left_out: 0,
        };
        let seams = Arc::new(vec![vec![corner(foot[from]), tip]]);
        let made = try_make(PanelMesh { facets: Some(false), seams, ..PanelMesh::new(triangles) });
        let made = made.unwrap();
        let [[a, b]] = seams_of(&made)[..] else { panic!("{:?}", seams_of(&made)) };
        let ends = [corner(foot[from]), tip];
        assert!(ends.contains(&a) && ends.contains(&b) && a != b);
        assert_eq!(why(&made), Some(SeamCause::Chosen));
        assert!(made.parts[0].measures.length_error_max < 1e-9);
    }
}

#[test]
fn a_seam_off_the_mesh_is_refused() {
    let off = Point3::new(500.0, 0.0, 0.0);
    let seams = Arc::new(vec![vec![corner(0), off]]);
    let error = try_make(PanelMesh { seams, ..PanelMesh::new(cube()) }).unwrap_err();
    assert_eq!(error.cause, MakeCause::Seam(SeamFault::Off { at: off, distance_mm: 490.0 }));
}

/// A closed plate of 100 × 100 mm, so thick, each skin in four by four fields.
fn plate(thickness_mm: f64) -> Triangles {
    let at = |n: usize| {
        let (k, z) = (n % 25, thickness_mm * (n / 25) as f64);
        Point3::new(25.0 * (k % 5) as f64, 25.0 * (k / 5) as f64, z)
    };
    let field = |n: usize| {
        let low = n / 4 * 5 + n % 4;
        let upper = [low, low + 1, low + 6, low + 5].map(|v| v + 25);
        [upper, [low, low + 5, low + 6, low + 1]]
    };
    // Round the border, counter-clockwise as seen from above.
    let round = [0, 1, 2, 3, 4, 9, 14, 19, 24, 23, 22, 21, 20, 15, 10, 5];
    let band = (0..16).map(|n| {
        let [a, b] = [round[n], round[(n + 1) % 16]];
        [a, b, b + 25, a + 25]
    });
    let fields = (0..16).flat_map(field).chain(band);
    let halves = fields.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    Triangles {
        positions: (0..50).map(at).collect(),
        triangles: halves.map(|t| t.map(VertexIndex::new)).collect(),
        left_out: 0,
    }
}

#[test]
fn seams_on_the_other_skin_of_a_plate_go_with_it() {
    let way = |z: f64| [0.0, 25.0, 50.0].map(|y| Point3::new(50.0, y, z)).to_vec();
    // Up the band, and on across one skin.
    let [low, high] = [way(0.0), way(3.0)];
    let up: Vec<Point3> = low[..1].iter().chain(&high).copied().collect();
    for skin in [Skin::Outer, Skin::Inner] {
        let seams = Arc::new(vec![low.clone(), up.clone()]);
        let made = try_make(PanelMesh { skin: Some(skin), seams, ..PanelMesh::new(plate(3.0)) });
        let made = made.unwrap();
        assert_eq!(made.parts.len(), 1);
        let cut = seams_of(&made);
        let is_middle = |p: &Point3| p.x.to_bits() == 50f64.to_bits() && p.y <= 50.0;
        assert_eq!(cut.len(), 2, "{skin:?}");
        assert!(cut.iter().flatten().all(is_middle), "{skin:?} {cut:?}");
    }
    // A point that no skin ever had is still an error.
    let off = Point3::new(50.0, 50.0, 20.0);
    let seams = Arc::new(vec![vec![Point3::new(50.0, 25.0, 3.0), off]]);
    let settings = PanelMesh { skin: Some(Skin::Outer), seams, ..PanelMesh::new(plate(3.0)) };
    assert!(matches!(try_make(settings).unwrap_err().cause, MakeCause::Seam(_)));
}

/// The skins of a plate lie nearer to one another than points of seams must lie to vertices.
#[test]
fn seams_on_one_skin_of_thin_plate_cut_no_other() {
    let way = |z: f64| [25.0, 50.0, 75.0].map(|y| Point3::new(50.0, y, z)).to_vec();
    let count = |skin: Skin, z: f64| {
        let seams = Arc::new(vec![way(z)]);
        let settings = PanelMesh { skin: Some(skin), seams, ..PanelMesh::new(plate(1.0)) };
        seams_of(&try_make(settings).unwrap()).len()
    };
    for skin in [Skin::Outer, Skin::Inner] {
        let mut counts = [count(skin, 0.0), count(skin, 1.0)];
        counts.sort_unstable();
        assert_eq!(counts, [0, 2], "{skin:?}");
    }
}

#[test]
fn seams_on_specks_go_with_them() {
    let mut triangles = cube();
    let first = triangles.positions.len();
    let far = |x: f64, y: f64| Point3::new(500.0 + x, y, 0.0);
    triangles.positions.extend([far(0.0, 0.0), far(1e-9, 0.0), far(0.0, 1e-9)]);
    triangles.triangles.push([first, first + 1, first + 2].map(VertexIndex::new));
    let seams = Arc::new(vec![triangles.positions[first..].to_vec()]);
    let made = try_make(PanelMesh { seams, ..PanelMesh::new(triangles) }).unwrap();
    assert_eq!(made.parts.len(), 1);
}
