//! Random closed and open meshes, damaged in every way there is: what is made of them is what is
//! made of the undamaged ones.
#![allow(clippy::unwrap_used)] // Whatever fails here is a failed test.

use sheetwright::check::{Finding, FindingKind, Severity};
use sheetwright::design::{Design, DesignPanel, PanelMesh, PanelShape, Triangles};
use sheetwright::make::{Judging, Part, make_judged};
use sheetwright::mesh::{Damage, Mesh};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::damage::{FAR, Kind, Soup, closed, damaged, open};
use sheetwright_shapes::random::Random;
use std::time::Instant;

/// How many meshes of each sort are damaged in each way.
const MESHES: u64 = 500;

fn parts((positions, triangles): Soup) -> Vec<Part> {
    let mesh = PanelMesh::new(Triangles { positions, triangles, left_out: 0 });
    let panel = DesignPanel::new("mesh", PanelShape::Mesh(mesh), 0);
    let design = Design { panels: vec![panel], ..Design::default() };
    // The pattern alone is looked at.
    make_judged(&design, Judging::Quick, &mut Unwatched).unwrap().parts
}

fn soup_of(mesh: &Mesh) -> Soup {
    (mesh.positions().to_vec(), mesh.triangles().to_vec())
}

fn damages(part: &Part) -> Vec<Damage> {
    let damage = |finding: &Finding| match finding.kind {
        FindingKind::Healed { damage, count } => {
            assert!(count > 0 && finding.severity() == Severity::Note);
            Some(damage)
        }
        _ => None,
    };
    let mut found: Vec<Damage> = part.checked.findings.iter().filter_map(damage).collect();
    found.sort_unstable();
    found
}

fn wanted(kind: Kind) -> &'static [Damage] {
    match kind {
        Kind::Seams | Kind::SeamsInDigits => &[Damage::Seam],
        Kind::OnSides => &[Damage::OnSide],
        Kind::Fillers => &[Damage::Filler, Damage::OnSide],
        Kind::Doubled => &[Damage::Doubled],
        Kind::Turned => &[Damage::Turned],
        Kind::InsideOut => &[Damage::InsideOut],
        Kind::Ribs => &[Damage::Branch],
        Kind::Far | Kind::Several => &[],
    }
}

/// How a healed part differs from the undamaged one, by more than `near` of the size.
fn difference(healed: &Part, whole: &Part, near: f64) -> Option<String> {
    let mesh = |part: &Part| part.given().unwrap().mesh.clone();
    let (a, b) = (mesh(healed), mesh(whole));
    let shape = |mesh: &Mesh| (mesh.components().len(), mesh.loops().len(), mesh.euler());
    let border = |part: &Part| -> f64 {
        let around = |points: &[sheetwright::math::Point2]| -> f64 {
            let next = points.iter().cycle().skip(1);
            points.iter().zip(next).map(|(a, b)| a.distance(*b)).sum()
        };
        part.piece.loops().map(around).sum()
    };
    // Of what is cut open, another division into triangles may have shorter ways for the cuts.
    let is_cut = |part: &Part| !part.sheet.seams().is_empty();
    let numbers = |part: &Part| {
        let m = &part.measures;
        let pattern = [m.area_flat_mm2, border(part), part.piece.size.length()];
        let told = if is_cut(part) { 0 } else { pattern.len() };
        [vec![m.area_space_mm2], pattern[..told].to_vec()].concat()
    };
    if shape(&a) != shape(&b) {
        return Some(format!("{:?} instead of {:?}", shape(&a), shape(&b)));
    }
    let off = numbers(healed).into_iter().zip(numbers(whole)).map(|(a, b)| (a / b - 1.0).abs());
    let off = off.fold(0.0, f64::max);
    (off > near).then(|| format!("off by {off}: {:?} {:?}", numbers(healed), numbers(whole)))
}

/// Whether the undamaged mesh is cut open so that its pattern keeps all lengths, and the healed one
/// is not. Cuts begin at vertices, of which the healed mesh may have more.
fn is_cut_worse(healed: &Part, whole: &Part, near: f64) -> bool {
    let is_exact = |part: &Part| part.measures.length_error_max < near.max(1e-6);
    !whole.sheet.seams().is_empty() && is_exact(whole) && !is_exact(healed)
}

#[test]
fn random_damage_is_healed_to_the_area_and_the_pattern_of_the_undamaged_mesh() {
    let (mut wrong, mut cut_worse) = (Vec::new(), 0);
    for kind in Kind::ALL {
        for sort in ["open", "closed"] {
            // An open sheet has no inside.
            if kind == Kind::InsideOut && sort == "open" {
                continue;
            }
            for seed in 0..MESHES {
                let mut random = Random::new(seed);
                let mesh = if sort == "open" { open(&mut random) } else { closed(&mut random) };
                let whole = parts(soup_of(&mesh));
                let healed = parts(damaged(kind, &mesh, &mut random));
                let near = match kind {
                    Kind::SeamsInDigits => 1e-4,
                    // Doubles lie 1e-6 mm apart there.
                    Kind::Far => 1e-6,
                    _ => 1e-9,
                };
                cut_worse += usize::from(is_cut_worse(&healed[0], &whole[0], near));
                let problem = if kind != Kind::Ribs && healed.len() != 1 {
                    Some(format!("{} parts", healed.len()))
                } else if !wanted(kind).iter().all(|d| damages(&healed[0]).contains(d)) {
                    Some(format!("{:?}", damages(&healed[0])))
                } else {
                    difference(&healed[0], &whole[0], near)
                };
                wrong.extend(problem.map(|what| format!("{kind:?}, {sort}, {seed}: {what}")));
            }
        }
    }
    let some: Vec<&String> = wrong.iter().step_by(1 + wrong.len() / 20).collect();
    assert_eq!(cut_worse, 0);
    assert!(wrong.is_empty(), "{} wrong, such as\n{some:#?}", wrong.len());
}

#[test]
fn a_mesh_far_away_is_given_back_in_its_place() {
    let mesh = open(&mut Random::new(7));
    let far = damaged(Kind::Far, &mesh, &mut Random::new(7));
    let [part] = &parts(far.clone())[..] else { panic!() };
    assert_eq!(part.given().unwrap().mesh.positions(), far.0);
    let near = mesh.positions().iter().zip(part.given().unwrap().mesh.positions());
    assert!(near.into_iter().all(|(p, far)| (*p + FAR).distance(*far) < 1e-5));
}

#[test]
fn a_mesh_that_needs_no_healing_stays_as_it_is() {
    for seed in 0..MESHES {
        let mut random = Random::new(seed);
        for mesh in [open(&mut random), closed(&mut random)] {
            let [part] = &parts(soup_of(&mesh))[..] else { panic!() };
            assert_eq!(part.given().unwrap().mesh, mesh);
            assert_eq!(damages(part), []);
        }
    }
}

/// A hundred thousand triangles, each with points of its own, are healed in well under a second;
/// the bound is for slow machines that do other work meanwhile.
#[test]
fn many_triangles_are_healed_in_a_moment() {
    const CELLS: usize = 224;
    let mesh = sheetwright_shapes::meshes::bumpy(CELLS);
    let points: Vec<_> = mesh.triangles().iter().flatten().map(|&v| mesh.position(v)).collect();
    let triangles = (0..mesh.triangles().len())
        .map(|n| [3 * n, 3 * n + 1, 3 * n + 2].map(sheetwright::index::VertexIndex::new))
        .collect();
    let soup: Soup = (points, triangles);
    let start = Instant::now();
    let healed = sheetwright::mesh::healed(&soup.0, &soup.1).unwrap();
    let seconds = start.elapsed().as_secs_f64();
    assert_eq!(healed.triangles.len(), 100_352);
    assert_eq!(healed.positions.len(), mesh.positions().len());
    assert!(seconds < 3.0, "{seconds}");
}
