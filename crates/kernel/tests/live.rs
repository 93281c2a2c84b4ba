//! Designs that are edited: what is kept and what is made anew come to what making them afresh
//! does.
#![allow(clippy::unwrap_used)] // tests panic

use sheetwright::boundary::size_of;
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{
    CurveUse, Design, DesignCurve, DesignPanel, Join, PanelMesh, PanelMethod, PanelShape, Triangles,
};
use sheetwright::index::VertexIndex;
use sheetwright::make::{Judging, Live, LivePanel, Made, MakeError, Part, make, make_judged};
use sheetwright::math::{Point3, Vec3, cos, sin};
use sheetwright::triangulate::{
    Cheapest, Goal, TriangulateError, TriangulateOptions, triangulate_near,
};
use sheetwright::watch::{Stage, Unwatched, Watch};
use sheetwright_shapes::drag::{Drag, one_panel, outline};
use sheetwright_shapes::family::Family;
use sheetwright_shapes::hull::planks;
use sheetwright_shapes::random::Random;
use std::cell::Cell;
use std::f64::consts::TAU;

/// Compares with making afresh, to the last bit: what prints alike, with all digits and signs, is
/// alike. What is not settled, with following the design afresh; settled, with making it.
fn check(live: &Live, what: &str) {
    check_drawn(live, what);
    let mut settled = live.clone();
    settled.settle(&mut Unwatched);
    assert!(settled.panels().iter().all(LivePanel::is_settled), "{what}");
    compare(&settled.made(), &make(live.design(), &mut Unwatched), what);
}

/// Compares what is not settled with following the design afresh.
fn check_drawn(live: &Live, what: &str) {
    let mut afresh = Live::default();
    afresh.follow(live.design().clone(), &mut Unwatched);
    assert_eq!(live.panels().len(), afresh.panels().len(), "{what}");
    for (kept, afresh) in live.panels().iter().zip(afresh.panels()) {
        if !kept.is_settled() {
            assert!(kept.made == afresh.made, "{what}");
            assert_eq!(format!("{:?}", kept.made), format!("{:?}", afresh.made), "{what}");
        }
    }
}

fn compare(kept: &Result<Made, MakeError>, afresh: &Result<Made, MakeError>, what: &str) {
    assert!(kept == afresh, "{what}");
    assert_eq!(format!("{kept:?}"), format!("{afresh:?}"), "{what}");
}

fn random_point(random: &mut Random, design: &Design) -> [usize; 2] {
    let curve = random.below(design.curves.len());
    [curve, random.below(design.curves[curve].points.len())]
}

/// Drags some handles of a design, each a few steps, now and then by much.
fn drag(design: Design, reach: f64, steps: usize, seed: u64) -> usize {
    let mut random = Random::new(seed);
    let name = design.name.clone();
    let mut live = Live::new(design, &mut Unwatched);
    check(&live, &name);
    let mut refused = 0;
    for handle in 0..3 {
        let [c, p] = random_point(&mut random, live.design());
        let home = live.design().curves[c].points[p].at;
        let far = if random.unit() < 0.3 { 10.0 } else { 1.0 };
        let mut drag = Drag::new(home, far * reach, random.bits());
        for step in 0..steps {
            live.move_point(c, p, drag.step(), &mut Unwatched);
            if random.unit() < 0.3 {
                live.settle(&mut Unwatched);
            }
            let what = format!("{name}, seed {seed}, handle {handle}, step {step}");
            if step + 1 == steps {
                check(&live, &what);
            } else {
                check_drawn(&live, &what);
            }
            refused += usize::from(live.made().is_err());
        }
    }
    refused
}

#[test]
fn families_dragged_are_as_made_afresh() {
    for family in Family::ALL {
        for fold in [0.0, 0.1, 1.0] {
            for samples in [30, 100] {
                drag(one_panel(outline(family), samples, fold), 4.0, 3, samples as u64);
            }
        }
    }
}

/// A polygon on a coarse grid, flat or nearly, so that much ties, is in line or twice the same.
fn grid(random: &mut Random) -> DesignCurve {
    let m = 5 + random.below(12);
    let kinds =
        [None, Some(CurveKind::Polyline), Some(CurveKind::Spline), Some(CurveKind::BSpline)];
    let kind = kinds[random.below(4)];
    let points = (0..m).map(|i| {
        let angle = TAU * i as f64 / m as f64;
        let r = random.between(2.0, 6.0);
        let z = if random.unit() < 0.8 { 0.0 } else { 1.0 };
        CurvePoint {
            at: Point3::new((r * cos(angle)).round(), (r * sin(angle)).round(), z),
            corner: random.unit() < 0.5,
            move_mm: 0.0,
        }
    });
    DesignCurve { name: "grid".into(), kind, closed: true, points: points.collect() }
}

#[test]
fn polygons_that_tie_are_as_made_afresh() {
    let mut random = Random::new(3);
    let mut refused = 0;
    for seed in 0..120 {
        let curve = grid(&mut random);
        let fold = [0.0, 1.0][random.below(2)];
        let samples = 24 + random.below(80);
        let design = one_panel(curve, samples, fold);
        let mut live = Live::default();
        live.follow(design, &mut Unwatched);
        check_drawn(&live, &format!("{seed}"));
        for step in 0..6 {
            let [c, p] = random_point(&mut random, live.design());
            let at = live.design().curves[c].points[p].at;
            let mut whole = || random.below(3) as f64 - 1.0;
            let to = at + Vec3::new(whole(), whole(), whole());
            live.move_point(c, p, to, &mut Unwatched);
            let what = format!("{seed}, step {step}");
            if (seed + step) % 20 == 5 {
                check(&live, &what);
            } else {
                check_drawn(&live, &what);
            }
            refused += usize::from(live.made().is_err());
        }
    }
    // Some polygons cross themselves on the way.
    assert!(refused > 0 && refused < 600, "{refused}");
}

/// Two walls that share a side, of a box as wide as said.
fn walls(wide: f64) -> Triangles {
    let at = [[0., 0., 0.], [wide, 0., 0.], [0., 90., 0.], [0., 0., 70.]];
    Triangles {
        positions: at.map(|[x, y, z]| Point3::new(x, y, z)).to_vec(),
        triangles: [[0, 1, 2], [0, 3, 1]].map(|t| t.map(VertexIndex::new)).to_vec(),
        left_out: 0,
    }
}

#[test]
fn meshes_beside_a_panel_are_as_made_afresh() {
    let mut design = one_panel(outline(Family::TwistedStrip), 60, 1.0);
    let split = PanelMesh { split_creases: Some(0.5), ..PanelMesh::new(walls(80.0)) };
    let mesh = |name: &str, mesh: PanelMesh| DesignPanel::new(name, PanelShape::Mesh(mesh), 0);
    design.panels.insert(0, mesh("box", split.clone()));
    // It meets the second wall along a side, so that the name of that part is the name of its edge.
    let beside = Triangles {
        positions: [[0., 0., 0.], [0., 0., 70.], [-50., 0., 0.]]
            .map(|[x, y, z]| Point3::new(x, y, z))
            .to_vec(),
        triangles: vec![[0, 1, 2].map(VertexIndex::new)],
        left_out: 0,
    };
    design.panels.push(mesh("flap", PanelMesh::new(beside)));
    let mut live = Live::new(design.clone(), &mut Unwatched);
    check(&live, "made");
    let names = |live: &Live| -> Vec<String> {
        let made = live.made().unwrap();
        let of_part = |part: &Part| part.edges.iter().map(|edge| edge.name.clone()).collect();
        made.parts.last().map_or(Vec::new(), of_part)
    };
    assert_eq!(names(&live), ["box-2", "border"]);
    // A dragged handle leaves the meshes alone; their names reach one another.
    let home = live.design().curves[0].points[1].at;
    let moved = live.move_point(0, 1, home + Vec3::new(1.0, 2.0, 3.0), &mut Unwatched);
    assert_eq!(moved, [1]);
    check(&live, "dragged");
    live.settle(&mut Unwatched);
    design = live.design().clone();
    design.panels[0].name = "case".into();
    assert_eq!(live.update(design.clone(), &mut Unwatched), [0]);
    check(&live, "renamed");
    assert_eq!(names(&live), ["case-2", "border"]);
    design.panels[0] = mesh("case", PanelMesh::new(walls(80.0)));
    live.update(design.clone(), &mut Unwatched);
    check(&live, "in one piece");
    assert_eq!(
        (names(&live), live.panels()[0].made.as_ref().unwrap().len()),
        (vec!["case".into(), "border".into()], 1)
    );
    // A mesh that can't be made says so, and the others are made.
    design.panels[0] = mesh("case", PanelMesh::new(Triangles::default()));
    live.update(design, &mut Unwatched);
    assert!(live.panels()[0].made.is_err() && live.panels()[2].made.is_ok());
    check(&live, "empty");
}

fn curve(name: &str, closed: bool, points: Vec<Point3>) -> DesignCurve {
    let points = points.into_iter().map(CurvePoint::smooth).collect();
    DesignCurve { name: name.into(), kind: Some(CurveKind::Spline), closed, points }
}

fn on(name: &str) -> CurveUse {
    CurveUse { name: name.into(), reversed: false }
}

#[test]
fn what_bends_without_its_plane_is_as_made_afresh() {
    let (mut found, mut left) = (0, 0);
    for fold in [0.0, 1.0] {
        let mut live = Live::new(planks(30, fold), &mut Unwatched);
        for handle in 0..4 {
            let curve = handle % live.design().curves.len();
            let points = &live.design().curves[curve].points;
            let size = size_of(points.iter().map(|point| point.at));
            let mut drag = Drag::new(points[handle].at, 0.02 * size, handle as u64);
            for step in 0..6 {
                live.move_point(curve, handle, drag.step(), &mut Unwatched);
                check_drawn(&live, &format!("ν {fold}, handle {handle}, step {step}"));
                let before = live.clone();
                // One hand rests after each move, one at the end.
                if handle % 2 == 0 || step == 5 {
                    let changed = live.settle(&mut Unwatched);
                    left += changed.len();
                    for (n, panel) in live.panels().iter().enumerate() {
                        let is_same = panel.made == before.panels()[n].made;
                        assert_eq!(is_same, !changed.contains(&n), "{step}: {n}");
                    }
                    assert_eq!(live.settle(&mut Unwatched), [0; 0]);
                    check(&live, &format!("ν {fold}, handle {handle}, step {step}, settled"));
                }
                let panels = live.made().unwrap().parts;
                let findings = panels.iter().flat_map(|panel| &panel.checked.findings);
                found +=
                    findings.filter(|finding| finding.code() == "better-without-plane").count();
            }
        }
    }
    assert!(found > 20 && left > 10, "{found} {left}");
}

#[test]
fn what_is_known_from_before_changes_nothing() {
    let families = Family::ALL.into_iter().filter(|family| family.name().contains("patch"));
    for family in families {
        let mut design = one_panel(outline(family), 100, 0.0);
        for handle in (0..24).step_by(3) {
            let home = design.curves[0].points[handle].at;
            let mut drag = Drag::new(home, 0.03 * home.to_vec().length(), handle as u64);
            let mut known: Option<Cheapest> = None;
            for step in 0..40 {
                design.curves[0].points[handle].at = drag.step();
                let made = make_judged(&design, Judging::Quick, &mut Unwatched);
                let panel = made.unwrap().parts.remove(0);
                let mut options = TriangulateOptions::default();
                options.price.fold = 0.0;
                let found = panel.found().unwrap();
                let (boundary, plane) = (&found.boundary, found.plane.as_ref());
                let near = known.as_ref();
                let next = triangulate_near(boundary, plane, &options, near, &mut Unwatched);
                let next = next.unwrap();
                assert_eq!(next.triangulation, found.triangulation, "{handle}, {step}");
                known = Some(next);
            }
            design.curves[0].points[handle].at = home;
        }
    }
}

fn circle(name: &str, radius: f64, height: f64) -> DesignCurve {
    let at = |i: usize| {
        let t = TAU * i as f64 / 8.0;
        Point3::new(radius * cos(t), radius * sin(t), height + 0.05 * radius * cos(2.0 * t))
    };
    curve(name, true, (0..8).map(at).collect())
}

#[test]
fn panels_with_holes_are_as_made_afresh() {
    let holes = vec![vec![on("window")]];
    let lid = DesignPanel::new("lid", PanelShape::Loops { outer: vec![on("rim")], holes }, 40);
    let design = Design {
        name: "lid".into(),
        curves: vec![circle("rim", 100.0, 0.0), circle("window", 40.0, 5.0)],
        panels: vec![lid],
        ..Design::default()
    };
    drag(design, 3.0, 3, 5);
}

/// Three strips side by side between four rails.
fn strips(method: PanelMethod, goal: Goal, run_on: bool) -> Design {
    let rail = |n: usize| {
        let at = |i: usize| {
            let (x, y) = (100.0 * i as f64, 80.0 * n as f64);
            Point3::new(x, y + 10.0 * sin(0.01 * x), 20.0 * cos(0.005 * x + 0.3 * n as f64))
        };
        curve(&format!("rail {n}"), false, (0..5).map(at).collect())
    };
    let strip = |n: usize| {
        let rails = [n, n + 1].map(|n| on(&format!("rail {n}")));
        let strip = DesignPanel::new(format!("strip {n}"), PanelShape::Rails(rails), 30 + 5 * n);
        DesignPanel { method, goal, run_on, ..strip }
    };
    Design {
        name: "strips".into(),
        curves: (0..4).map(rail).collect(),
        panels: (0..3).map(strip).collect(),
        ..Design::default()
    }
}

#[test]
fn strips_of_all_kinds_are_as_made_afresh() {
    for method in [PanelMethod::Optimal, PanelMethod::Bridge, PanelMethod::Rails] {
        drag(strips(method, Goal::Price, false), 5.0, 2, 1);
    }
    drag(strips(PanelMethod::Optimal, Goal::WorstWarp, false), 5.0, 2, 2);
    drag(strips(PanelMethod::Optimal, Goal::Price, true), 5.0, 2, 3);
    let matched = Design { match_seams: true, ..strips(PanelMethod::Optimal, Goal::Price, false) };
    drag(matched, 5.0, 4, 4);
}

#[test]
fn only_what_depends_on_a_change_is_made_anew() {
    let mut live = Live::new(strips(PanelMethod::Optimal, Goal::Price, false), &mut Unwatched);
    let to = |x: f64| Point3::new(200.0, 85.0, x);
    assert_eq!(live.move_point(1, 2, to(1.0), &mut Unwatched), [0, 1]);
    assert_eq!(live.move_point(1, 2, to(1.0), &mut Unwatched), [0; 0]);
    assert_eq!(live.move_point(0, 2, Point3::new(200.0, 0.0, 9.0), &mut Unwatched), [0]);
    // What only says how points may move is not made at all.
    let mut design = live.design().clone();
    design.panels[2].samples = 33;
    design.panels.swap(0, 1);
    live.settle(&mut Unwatched);
    assert_eq!(live.update(design.clone(), &mut Unwatched), [2]);
    check(&live, "swapped");
    // A zero of the other sign is another number.
    design.curves[0].points[0].at.y = 0.0;
    live.update(design.clone(), &mut Unwatched);
    design.curves[0].points[0].at.y = -0.0;
    assert_eq!(live.update(design.clone(), &mut Unwatched), [1]);
    check(&live, "−0");
    // A join depends on its parts.
    let join = Join {
        parts: vec!["strip 1".into(), "strip 0".into()],
        smooth: Default::default(),
        within: Default::default(),
        keep_parts: true,
    };
    design.panels.push(DesignPanel::new("both", PanelShape::Join(join), 90));
    assert_eq!(live.update(design.clone(), &mut Unwatched), [3]);
    design.panels[1].samples += 1;
    assert_eq!(live.update(design, &mut Unwatched), [1, 3]);
    assert_eq!(live.move_point(3, 2, Point3::new(200.0, 240.0, 3.0), &mut Unwatched), [2]);
    check(&live, "joined");
    live.update(Design::default(), &mut Unwatched);
    check(&live, "empty");
}

#[test]
fn a_panel_that_can_not_be_made_does_not_hold_up_others() {
    let mut live = Live::new(strips(PanelMethod::Optimal, Goal::Price, false), &mut Unwatched);
    let home = live.design().curves[0].points[2].at;
    assert_eq!(live.move_point(0, 2, Point3::new(f64::NAN, 0.0, 0.0), &mut Unwatched), [0]);
    assert!(live.panels()[0].made.is_err() && live.panels()[1].made.is_ok());
    check(&live, "no number");
    assert_eq!(live.move_point(0, 2, home, &mut Unwatched), [0]);
    check(&live, "back");
}

/// Asks to stop from the n-th time on that it is asked, and listens to progress.
struct StopAt {
    left: Cell<usize>,
    told: Vec<f64>,
    begun: usize,
}

impl StopAt {
    fn new(left: usize) -> Self {
        Self { left: Cell::new(left), told: Vec::new(), begun: 0 }
    }
}

impl Watch for StopAt {
    fn begin(&mut self, _panels: &[&str], _stage: Stage) {
        self.begun += 1;
    }

    fn progress(&mut self, done: f64) {
        self.told.push(done);
    }

    fn stop(&self) -> bool {
        self.left.set(self.left.get().saturating_sub(1));
        self.left.get() == 0
    }
}

#[test]
fn work_that_is_stopped_is_taken_up_again() {
    let mut live = Live::new(strips(PanelMethod::Optimal, Goal::Price, false), &mut Unwatched);
    let mut counted = StopAt::new(usize::MAX);
    let home = live.design().curves[1].points[2].at;
    live.move_point(1, 2, home + Vec3::Z, &mut counted);
    let asked = usize::MAX - counted.left.get();
    assert!(asked > 30 && counted.begun == 8, "{asked} {}", counted.begun);
    assert!(counted.told.iter().all(|done| (0.0..=1.0).contains(done)) && !counted.told.is_empty());
    for n in 1..20 {
        let kept = live.clone();
        let to = home + Vec3::Z * (1.0 + n as f64);
        let mut counted = StopAt::new(usize::MAX);
        live.clone().move_point(1, 2, to, &mut counted);
        let asked = usize::MAX - counted.left.get();
        let mut watch = StopAt::new(1 + asked * n / 20);
        let changed = live.move_point(1, 2, to, &mut watch);
        assert!(changed.len() < 2, "{n}");
        for (panel, before) in live.panels().iter().zip(kept.panels()) {
            assert!(panel.is_current() || panel.made == before.made, "{n}");
        }
        assert!(live.panels().iter().any(|panel| !panel.is_current()), "{n}");
        // What is left is made by the next call, though nothing moves.
        let rest = live.move_point(1, 2, to, &mut Unwatched);
        assert_eq!(changed.len() + rest.len(), 2, "{n}");
        check(&live, &format!("stopped at {n}"));
    }
    // What waits until the hand rests is taken up again, too.
    let mut live = Live::new(planks(30, 0.0), &mut Unwatched);
    let home = live.design().curves[1].points[2].at;
    live.move_point(1, 2, home + Vec3::Z, &mut Unwatched);
    let mut counted = StopAt::new(usize::MAX);
    let changed = live.clone().settle(&mut counted);
    let asked = usize::MAX - counted.left.get();
    assert!(asked > 5 && counted.begun == 2 && !changed.is_empty(), "{asked}");
    for n in 0..5 {
        let mut live = live.clone();
        let first = live.settle(&mut StopAt::new(1 + asked * n / 5));
        assert!(!live.panels().iter().all(LivePanel::is_settled), "{n}");
        let rest = live.settle(&mut Unwatched);
        // A panel may change twice: it is judged, then the other surface is found.
        let mut both = [first, rest].concat();
        both.sort_unstable();
        both.dedup();
        assert_eq!(both, changed, "{n}");
        check(&live, &format!("stopped at {n} when at rest"));
    }
    let stopped = Live::new(live.design().clone(), &mut StopAt::new(1));
    let error = stopped.made().unwrap_err();
    assert_eq!(error.cause, TriangulateError::Stopped.into());
}
