//! Pieces of nets beside the size that they may have, with all that is cut; and what is said where
//! a setting does nothing.

#![allow(clippy::unwrap_used, reason = "a test that can't go on fails")]

use sheetwright::check::{FindingKind, MeshSetting};
use sheetwright::design::{
    Allowance, Corner, Design, DesignPanel, PanelMesh, PanelShape, Tabs, Triangles, Trim, TrimKind,
    TrimOn,
};
use sheetwright::flatten::Aim;
use sheetwright::make::{Live, Made, Part, make};
use sheetwright::math::from_deg;
use sheetwright::mesh::Mesh;
use sheetwright::pattern::PathKind;
use sheetwright::watch::Unwatched;
use sheetwright_shapes::low_poly::{animal, helmet};
use sheetwright_shapes::solids::{icosphere, platonic, prism};

fn settings(mesh: &Mesh) -> PanelMesh {
    let (positions, triangles) = (mesh.positions().to_vec(), mesh.triangles().to_vec());
    PanelMesh::new(Triangles { positions, triangles, left_out: 0 })
}

fn folded(mesh: &Mesh, within: [f64; 2]) -> PanelMesh {
    PanelMesh { facets: Some(true), pieces_within_mm: Some(within), ..settings(mesh) }
}

fn design(settings: PanelMesh, trims: &[Trim]) -> Design {
    let panels = vec![DesignPanel::new("net", PanelShape::Mesh(settings), 0)];
    Design { panels, trims: trims.to_vec(), ..Design::default() }
}

fn made(settings: PanelMesh, trims: &[Trim]) -> Made {
    make(&design(settings, trims), &mut Unwatched).unwrap()
}

fn tabs(width: f64) -> Trim {
    let angle = from_deg(45.0);
    Trim::new([TrimOn::Joined], TrimKind::Tabs(Tabs { width, angle, tolerance: 0.3 }))
}

fn allowance(width: f64) -> Trim {
    let allowance = Allowance { width: [width; 2], corner: Corner::ByLength };
    Trim::new([TrimOn::All], TrimKind::Allowance(allowance))
}

fn is_within(part: &Part, within: [f64; 2]) -> bool {
    let size = part.piece.size;
    let [long, short] = [size.x.max(size.y), size.x.min(size.y)];
    long <= within[0].max(within[1]) + 1e-6 && short <= within[0].min(within[1]) + 1e-6
}

/// The findings on pieces that are too large: whether each is one facet, and whether it would be
/// small enough without trims.
fn too_large(made: &Made) -> Vec<[bool; 2]> {
    let findings = made.parts.iter().flat_map(|part| &part.checked.findings);
    let found = findings.filter_map(|finding| match finding.kind {
        FindingKind::PieceTooLarge { is_facet, is_trimmed, .. } => Some([is_facet, is_trimmed]),
        _ => None,
    });
    found.collect()
}

fn no_effect(made: &Made) -> Vec<(Vec<MeshSetting>, bool)> {
    let findings = made.parts.iter().flat_map(|part| &part.checked.findings);
    let found = findings.filter_map(|finding| match &finding.kind {
        FindingKind::NoEffect { settings, is_net } => Some((settings.clone(), *is_net)),
        _ => None,
    });
    found.collect()
}

#[test]
fn what_is_cut_of_a_piece_is_no_larger_than_it_may_be() {
    let within = [150.0, 110.0];
    for (name, model) in [("animal", animal()), ("helmet", helmet()), ("prism", prism(64, 80.0))] {
        let mesh = model.mesh();
        let with_tabs = made(folded(&mesh, within), &[tabs(5.0)]);
        for trims in [[tabs(5.0)], [allowance(4.0)], [tabs(12.0)]] {
            let made = made(folded(&mesh, within), &trims);
            let has_net = made.parts.iter().filter(|part| part.piece.has_net()).count();
            assert!(has_net > 0, "{name}: {trims:?}");
            for part in &made.parts {
                assert!(is_within(part, within), "{name}: {:?} {trims:?}", part.piece.size);
            }
            assert!(too_large(&made).is_empty(), "{name}");
        }
        // Nets that keep a tab's width free on all sides have no fewer pieces.
        let inset = made(folded(&mesh, within.map(|mm| mm - 2.0 * 5.3)), &[]);
        let counts = [&with_tabs, &inset].map(|made| made.parts.len());
        assert!(counts[0] <= counts[1], "{name}: {counts:?}");
    }
}

#[test]
fn a_facet_that_is_larger_by_itself_is_said_to_be() {
    let (_, cube) = platonic().into_iter().find(|(name, _)| *name == "cube").unwrap();
    let mesh = cube.mesh();
    let side = {
        let made = made(folded(&mesh, [1e6, 1e6]), &[]);
        assert!(made.parts.len() == 1 && too_large(&made).is_empty());
        let outline = made.parts[0].piece.outline();
        outline[0].distance(outline[1])
    };
    let alone = [side, side];
    assert!(too_large(&made(folded(&mesh, alone), &[])).is_empty());
    let small = alone.map(|mm| 0.9 * mm);
    assert_eq!(too_large(&made(folded(&mesh, small), &[])), [[true, false]; 6]);
    // Each joint has a tab on one side: some faces have none.
    let width = 0.05 * side;
    let with_tabs = made(folded(&mesh, alone), &[tabs(width)]);
    let tabbed = with_tabs.parts.iter().filter(|part| part.piece.has_net()).count();
    assert_eq!(too_large(&with_tabs), vec![[true, true]; tabbed]);
    assert!((4..=6).contains(&tabbed), "{tabbed}");
    // Two widths more, and all have room.
    let wide = alone.map(|mm| mm + 2.0 * width + 1e-6);
    assert!(too_large(&made(folded(&mesh, wide), &[tabs(width)])).is_empty());
}

#[test]
fn settings_that_do_nothing_are_named() {
    use MeshSetting::{Aim as AimSetting, Darts, PiecesWithin, SplitCreases};
    let animal = animal().mesh();
    let within = Some([300.0, 200.0]);
    let all = PanelMesh {
        aim: Aim::Max,
        split_creases: Some(from_deg(30.0)),
        darts: true,
        ..folded(&animal, [300.0, 200.0])
    };
    let said = no_effect(&made(all, &[]));
    assert_eq!(said, [(vec![AimSetting, SplitCreases, Darts], true)]);
    let darts = PanelMesh { darts: true, facets: Some(true), ..settings(&animal) };
    assert_eq!(no_effect(&made(darts, &[])), [(vec![Darts], true)]);
    // Folded because its facets are meant: the size has an effect.
    let by_itself = PanelMesh { pieces_within_mm: within, ..settings(&animal) };
    assert!(no_effect(&made(by_itself, &[])).is_empty());
    assert!(no_effect(&made(folded(&animal, [300.0, 200.0]), &[])).is_empty());
    let ball = icosphere(3).mesh();
    let smooth = PanelMesh { pieces_within_mm: within, ..settings(&ball) };
    assert_eq!(no_effect(&made(smooth, &[])), [(vec![PiecesWithin], false)]);
    let off = PanelMesh { facets: Some(false), pieces_within_mm: within, ..settings(&animal) };
    assert_eq!(no_effect(&made(off, &[])), [(vec![PiecesWithin], false)]);
    let smooth = PanelMesh { aim: Aim::Max, darts: true, ..settings(&ball) };
    assert!(no_effect(&made(smooth, &[])).is_empty());
}

#[test]
fn a_design_that_is_edited_keeps_room_for_the_tabs_that_it_gets() {
    let mesh = prism(12, 80.0).mesh();
    let within = [150.0, 110.0];
    let mut live = Live::new(design(folded(&mesh, within), &[]), &mut Unwatched);
    for trims in [vec![tabs(8.0)], vec![tabs(8.0), allowance(3.0)], vec![]] {
        let design = design(folded(&mesh, within), &trims);
        live.update(design.clone(), &mut Unwatched);
        let (edited, afresh) = (live.made().unwrap(), make(&design, &mut Unwatched).unwrap());
        assert_eq!(edited.parts, afresh.parts, "{trims:?}");
        assert!(edited.parts.iter().all(|part| is_within(part, within)));
        let is_fold = |kind: PathKind| matches!(kind, PathKind::TrimFold { .. });
        let folds = edited.parts.iter().flat_map(|part| &part.piece.paths);
        assert_eq!(folds.filter(|path| is_fold(path.kind)).count() > 0, trims.len() == 1);
    }
}
