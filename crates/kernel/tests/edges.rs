//! The edges of parts: every step of a border is of one edge, edges are called as what they lie on,
//! and those that lie on one another are mates, of one length.

#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::boundary::{Continuity, Within};
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{
    CurveUse, Design, DesignCurve, DesignPanel, Join, PanelMesh, PanelShape, Triangles,
};
use sheetwright::edge::{Edge, EdgePlace};
use sheetwright::index::VertexIndex;
use sheetwright::make::{Made, Part, make};
use sheetwright::math::{Point3, cos, from_deg, sin};
use sheetwright::template::{catalogue, template};
use sheetwright::watch::Unwatched;
use std::collections::BTreeMap;

fn drawn(name: &str) -> Design {
    template(name).unwrap().defaults().design().unwrap()
}

fn of_template(name: &str) -> Made {
    make(&drawn(name), &mut Unwatched).unwrap()
}

fn names(edges: &[Edge]) -> Vec<&str> {
    edges.iter().map(|edge| &edge.name[..]).collect()
}

/// Every step of each loop of a sheet is a step of one edge, once, and in that direction.
fn cover(edges: &[Edge], loops: impl Iterator<Item = Vec<usize>>) {
    let mut steps: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    for line in loops {
        let next = line.iter().cycle().skip(1);
        steps.extend(line.iter().zip(next).map(|(&a, &b)| ([a, b], 0)));
    }
    for pair in edges.iter().flat_map(|edge| edge.run.windows(2)) {
        *steps.get_mut(&[pair[0], pair[1]]).unwrap() += 1;
    }
    assert!(steps.values().all(|&count| count == 1), "{steps:?}");
}

/// Mates are mates of one another, and differ by no more than this share of their length.
fn agree(panels: &[&[Edge]], share: f64) -> usize {
    let mut pairs = 0;
    for (panel, edges) in panels.iter().enumerate() {
        for (edge, found) in edges.iter().enumerate() {
            assert_eq!(found.difference_mm.is_some(), !found.mates.is_empty(), "{}", found.name);
            for mate in &found.mates {
                let back = &panels[mate.part][mate.edge];
                assert!(back.mates.contains(&EdgePlace { part: panel, edge }), "{}", found.name);
                pairs += 1;
            }
            let difference = found.difference_mm.unwrap_or_default();
            assert!(difference <= share * found.length_flat_mm, "{} {difference:e}", found.name);
        }
    }
    pairs / 2
}

fn loops(part: &Part) -> impl Iterator<Item = Vec<usize>> {
    part.sheet.loops().iter().map(|line| line.iter().map(|v| v.get()).collect())
}

#[test]
fn edges_cover_the_borders_of_all_templates() {
    for one in catalogue() {
        let made = of_template(one.name);
        let mut panels = Vec::new();
        for panel in &made.parts {
            cover(&panel.edges, loops(panel));
            let mut all = names(&panel.edges);
            all.sort_unstable();
            let count = all.len();
            all.dedup();
            assert_eq!(all.len(), count, "{}: {all:?}", one.name);
            panels.push(&panel.edges[..]);
        }
        // Chords of curves that are sampled apart differ by what their sagittas do.
        agree(&panels, 1e-3);
    }
}

#[test]
fn shared_curves_with_equal_samples_have_mates_of_one_length() {
    let design = Design { match_seams: true, ..drawn("hull") };
    let made = make(&design, &mut Unwatched).unwrap();
    let panels: Vec<&[Edge]> = made.parts.iter().map(|panel| &panel.edges[..]).collect();
    assert!(agree(&panels, 1e-12) >= made.parts.len() - 1);
    let tent = of_template("tent");
    let bay = &tent.parts[0];
    assert_eq!(names(&bay.edges), ["middle-hoop", "end", "front-hoop", "start"]);
    let mate = bay.edges[0].mates[0];
    assert_eq!(tent.parts[mate.part].name, "rear-bay");
    let ends = bay.edges.iter().filter(|edge| edge.mates.is_empty());
    assert_eq!(names(&ends.cloned().collect::<Vec<_>>()), ["end", "start"]);
}

#[test]
fn edges_on_two_curves_that_lie_on_one_another_are_joined() {
    let mut design = drawn("elbow");
    let shared = design.curves.iter().find(|curve| curve.name == "cut-1b").unwrap();
    design.curves.push(DesignCurve { name: "own".into(), ..shared.clone() });
    let PanelShape::Rails(rails) = &mut design.panels[1].shape else { panic!("rails") };
    assert_eq!(rails[0].name, "cut-1b");
    rails[0].name = "own".into();
    // Sampled apart.
    (design.panels[0].samples, design.panels[1].samples) = (241, 190);
    let elbow = make(&design, &mut Unwatched).unwrap();
    let of = |part: usize, name: &str| {
        let edges = &elbow.parts[part].edges;
        let edge = edges.iter().position(|edge| edge.name == name).unwrap();
        (&edges[edge], EdgePlace { part, edge })
    };
    let ((upper, at), (lower, other)) = (of(0, "cut-1b"), of(1, "own"));
    assert_eq!((&upper.mates[..], &lower.mates[..]), (&[other][..], &[at][..]));
    assert!(upper.difference_mm.unwrap() < 0.1, "{:?}", upper.difference_mm);
    assert!(of(0, "cut-1a").0.mates.is_empty());
}

/// A hemisphere of 36 pieces between meridians and parallels.
#[test]
fn pieces_of_a_hemisphere_meet_on_every_side() {
    let gores = 12;
    let design = Design { match_seams: true, ..drawn("hemisphere") };
    let made = make(&design, &mut Unwatched).unwrap();
    assert_eq!(made.parts.len(), 36);
    let panels: Vec<&[Edge]> = made.parts.iter().map(|panel| &panel.edges[..]).collect();
    let pairs = agree(&panels, 1e-9);
    // Each piece has a neighbour on either side, and one above it but for the uppermost.
    let rows = made.parts.len() / gores;
    assert!(pairs >= rows * gores + (rows - 1) * gores, "{pairs}");
}

fn rail(name: &str, points: &[[f64; 3]]) -> DesignCurve {
    DesignCurve {
        name: name.into(),
        kind: Some(CurveKind::Spline),
        closed: false,
        points: points.iter().map(|p| CurvePoint::smooth(Point3::new(p[0], p[1], p[2]))).collect(),
    }
}

fn on(name: &str) -> CurveUse {
    CurveUse { name: name.into(), reversed: false }
}

#[test]
fn rails_that_run_on_keep_their_names() {
    let arc = |z: f64, turn: f64| -> Vec<[f64; 3]> {
        let at = |n: usize| from_deg(turn + 15.0 * n as f64);
        (0..7).map(|n| [300.0 * cos(at(n)), 300.0 * sin(at(n)), z]).collect()
    };
    // Rails on a cylinder, one turned against the other, so that rulings leave the strip.
    let design = Design {
        name: "strip".into(),
        curves: vec![rail("low", &arc(0.0, 0.0)), rail("high", &arc(200.0, 10.0))],
        panels: vec![DesignPanel {
            run_on: true,
            ..DesignPanel::new("strip", PanelShape::Rails([on("low"), on("high")]), 60)
        }],
        ..Design::default()
    };
    let made = make(&design, &mut Unwatched).unwrap();
    let edges = &made.parts[0].edges;
    cover(edges, loops(&made.parts[0]));
    assert_eq!(names(edges), ["low", "end", "high", "start"]);
    // The rails are as long as their arcs of 90°, and the new ends are no straight lines.
    let arc_mm = 300.0 * from_deg(90.0);
    assert!((edges[0].length_space_mm - arc_mm).abs() < 0.01 * arc_mm, "{edges:?}");
    assert!(edges.iter().any(|edge| edge.name == "end" && edge.run.len() > 2), "{edges:?}");
}

#[test]
fn joined_panels_have_the_edges_of_their_parts() {
    let keel = rail("keel", &[[0., 0., 0.], [500., 10., 0.], [1000., 0., 0.]]);
    let chine = rail("chine", &[[0., 200., 50.], [500., 230., 60.], [1000., 200., 50.]]);
    let sheer = rail("sheer", &[[0., 300., 250.], [500., 330., 260.], [1000., 300., 250.]]);
    let panel =
        |name: &str, rails: [&str; 2]| DesignPanel::new(name, PanelShape::Rails(rails.map(on)), 40);
    let join = Join {
        parts: vec!["bottom".into(), "side".into()],
        smooth: Continuity::G0,
        within: Within::default(),
        keep_parts: false,
    };
    let design = Design {
        name: "half".into(),
        curves: vec![keel, chine, sheer],
        panels: vec![
            panel("bottom", ["keel", "chine"]),
            panel("side", ["chine", "sheer"]),
            DesignPanel::new("half", PanelShape::Join(join), 120),
        ],
        ..Design::default()
    };
    let made = make(&design, &mut Unwatched).unwrap();
    let [half] = &made.parts[..] else { panic!() };
    cover(&half.edges, loops(half));
    let mut found = names(&half.edges);
    found.sort_unstable();
    // The chine lies inside; at each end the straight ends of both parts follow one another.
    assert_eq!(found, ["end", "keel", "sheer", "start"]);
}

/// A frustum between two circles is cut open, and each of its circles is one edge.
#[test]
fn a_cut_has_two_sides() {
    let circle = |name: &str, radius: f64, z: f64| {
        let at = |n: usize| from_deg(15.0 * n as f64);
        let points: Vec<[f64; 3]> =
            (0..24).map(|n| [radius * cos(at(n)), radius * sin(at(n)), z]).collect();
        DesignCurve { closed: true, ..rail(name, &points) }
    };
    let shape = PanelShape::Loops { outer: vec![on("bottom")], holes: vec![vec![on("top")]] };
    let design = Design {
        name: "frustum".into(),
        curves: vec![circle("bottom", 100.0, 0.0), circle("top", 60.0, 90.0)],
        panels: vec![DesignPanel::new("frustum", shape, 96)],
        ..Design::default()
    };
    let made = make(&design, &mut Unwatched).unwrap();
    let edges = &made.parts[0].edges;
    cover(edges, loops(&made.parts[0]));
    let mut found = names(edges);
    found.sort_unstable();
    assert_eq!(found, ["bottom", "cut-1a", "cut-1b", "top"]);
    let side = |name: &str| edges.iter().position(|edge| edge.name == name).unwrap();
    let [a, b] = [side("cut-1a"), side("cut-1b")];
    assert_eq!(edges[a].mates, [EdgePlace { part: 0, edge: b }]);
    assert!(edges[a].difference_mm.unwrap() < 1e-9);
}

#[test]
fn groups_of_a_mesh_are_mates_where_they_meet() {
    let at = [
        [0., 0., 0.],
        [100., 0., 0.],
        [100., 100., 0.],
        [0., 100., 0.],
        [0., 0., 80.],
        [100., 0., 80.],
        [0., 100., 70.],
        [100., 100., 70.],
    ];
    let group = |name: &str, quad: [usize; 4]| {
        let triangles = Triangles {
            positions: at.map(|p| Point3::new(p[0], p[1], p[2])).to_vec(),
            triangles: [[0, 1, 2], [0, 2, 3]]
                .map(|t| t.map(|k: usize| VertexIndex::new(quad[k])))
                .to_vec(),
            left_out: 0,
        };
        DesignPanel::new(name, PanelShape::Mesh(PanelMesh::new(triangles)), 3)
    };
    let design = Design {
        name: "tray".into(),
        panels: vec![
            group("floor", [0, 1, 2, 3]),
            group("front", [0, 4, 5, 1]),
            group("back", [3, 2, 7, 6]),
        ],
        ..Design::default()
    };
    let made = make(&design, &mut Unwatched).unwrap();
    let panels: Vec<&[Edge]> = made.parts.iter().map(|panel| &panel.edges[..]).collect();
    assert_eq!(agree(&panels, 1e-12), 2);
    assert_eq!(names(panels[0]), ["front", "border", "back", "border-2"]);
    assert_eq!(names(panels[1]), ["border", "floor"]);
    for part in &made.parts {
        cover(&part.edges, loops(part));
    }
}
