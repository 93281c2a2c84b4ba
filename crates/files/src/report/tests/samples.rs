//! Made designs that the tests of the report look at.

use sheetwright::boundary::PlaneChoice;
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{
    CurveUse, Design, DesignCurve, DesignPanel, PanelMethod, PanelShape, Vary,
};
use sheetwright::make::{Made, make};
use sheetwright::math::{Point3, cos, from_deg, sin};
use sheetwright::triangulate::{Goal, WhichSurface};
use sheetwright::watch::Unwatched;

pub(super) const ODD_NAME: &str = "<b>\"&é";

fn used(name: &str) -> CurveUse {
    CurveUse { name: name.to_owned(), reversed: false }
}

fn panel(name: &str, shape: PanelShape, samples: usize) -> DesignPanel {
    let (method, plane) = (PanelMethod::Optimal, PlaneChoice::Auto);
    DesignPanel {
        name: name.to_owned(),
        shape,
        samples,
        tolerance: None,
        method,
        plane,
        goal: Goal::Price,
        run_on: false,
        slides: false,
        fold: 0.1,
        effort: 1.0,
        cut: Vec::new(),
        which: WhichSurface::Cheapest,
        near: Vec::new(),
        bends: None,
        count: 1,
        mirrored: 0,
    }
}

fn design(
    name: &str,
    material: &str,
    curves: Vec<DesignCurve>,
    panels: Vec<DesignPanel>,
) -> Design {
    let material = crate::material_named(material, &[]);
    Design { name: name.to_owned(), material, curves, panels, ..Design::default() }
}

fn made(name: &str, material: &str, curves: Vec<DesignCurve>, panels: Vec<DesignPanel>) -> Made {
    make(&design(name, material, curves, panels), &mut Unwatched).unwrap()
}

/// The three planks of the fishing vessel, `samples` on a rail.
pub(super) fn hull(samples: usize, material: &str) -> Made {
    let table = include_str!("../../../../../examples/ubc-fishing-vessel.csv");
    let mut curves: Vec<DesignCurve> = Vec::new();
    for row in table.lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        let metres = |n: usize| cells[n].parse::<f64>().unwrap() * 1000.0;
        if curves.last().is_none_or(|c| c.name != cells[0]) {
            let kind = Some(CurveKind::Spline);
            let name = cells[0].to_owned();
            curves.push(DesignCurve { name, kind, closed: false, points: Vec::new() });
        }
        let at = Point3::new(metres(1), metres(2), metres(3));
        curves.last_mut().unwrap().points.push(CurvePoint::smooth(at));
    }
    let planks = [
        ("Topside", "Main deck", "Upper chine"),
        ("Bilge", "Upper chine", "Lower chine"),
        ("Bottom", "Lower chine", "Profile"),
    ];
    let panels = planks.map(|(name, a, b)| {
        let mut plank = panel(name, PanelShape::Rails([used(a), used(b)]), samples);
        plank.method = PanelMethod::Rails;
        plank
    });
    made("Fishing vessel", material, curves, panels.to_vec())
}

/// A panel inside one closed polyline.
fn polygon(name: &str, points: &[[f64; 3]], samples: usize, material: &str) -> Made {
    let points = points.iter().map(|p| CurvePoint::corner(Point3::new(p[0], p[1], p[2])));
    let curve = DesignCurve {
        name: "rim".to_owned(),
        kind: Some(CurveKind::Polyline),
        closed: true,
        points: points.collect(),
    };
    let shape = PanelShape::Loops { outer: vec![used("rim")], holes: Vec::new() };
    made(name, material, vec![curve], vec![panel(name, shape, samples)])
}

pub(super) fn concave() -> Made {
    let corners = [
        [0., 0., 0.],
        [300., 0., 0.],
        [300., 90., 0.],
        [110., 90., 0.],
        [110., 240., 0.],
        [0., 240., 0.],
    ];
    polygon(ODD_NAME, &corners, 60, "plywood-3mm")
}

/// Three samples: one triangle, no rungs.
pub(super) fn triangle() -> Made {
    polygon("gusset", &[[0., 0., 0.], [80., 0., 0.], [0., 60., 30.]], 3, "steel-1mm")
}

/// Two rails as points.
pub(super) fn between(
    name: &str,
    rails: [&dyn Fn(f64) -> [f64; 3]; 2],
    samples: usize,
    material: &str,
) -> Made {
    make(&strip(name, rails, samples, material), &mut Unwatched).unwrap()
}

fn strip(
    name: &str,
    rails: [&dyn Fn(f64) -> [f64; 3]; 2],
    samples: usize,
    material: &str,
) -> Design {
    let curve = |name: &str, rail: &dyn Fn(f64) -> [f64; 3]| {
        let at = |n: u32| {
            let p = rail(f64::from(n) / 24.0);
            CurvePoint::smooth(Point3::new(p[0], p[1], p[2]))
        };
        let points = (0..=24).map(at).collect();
        DesignCurve { name: name.to_owned(), kind: Some(CurveKind::Spline), closed: false, points }
    };
    let curves = vec![curve("a", rails[0]), curve("b", rails[1])];
    let shape = PanelShape::Rails([used("a"), used("b")]);
    let mut panel = panel(name, shape, samples);
    panel.plane = PlaneChoice::None;
    panel.method = PanelMethod::Rails;
    design(name, material, curves, vec![panel])
}

/// A quarter of a tube, 200 mm in radius, 500 mm long.
pub(super) fn quarter() -> Made {
    let arc = |y: f64| {
        move |t: f64| {
            let a = from_deg(90.0 * t);
            [200.0 * cos(a), y, 200.0 * sin(a)]
        }
    };
    between("quarter tube", [&arc(0.0), &arc(500.0)], 40, "plywood-4mm")
}

/// A quarter of a pipe of 10 mm, too tight for its sheet.
pub(super) fn tight() -> Made {
    let arc = |y: f64| {
        move |t: f64| {
            let a = from_deg(90.0 * t);
            [10.0 * cos(a), y, 10.0 * sin(a)]
        }
    };
    between("tight tube", [&arc(0.0), &arc(50.0)], 40, "plywood-4mm")
}

/// A wavy wall of many panels beside and above one another.
pub(super) fn facade(count: usize) -> Made {
    let columns = 60;
    let (mut curves, mut panels) = (Vec::new(), Vec::new());
    for n in 0..count {
        let (column, row) = ((n % columns) as f64, (n / columns) as f64);
        let names = ["a", "b"].map(|side| format!("{side}{n}"));
        for (name, height) in names.iter().zip([0.02, 0.98]) {
            let at = |step: u32| {
                let x = column + 0.02 + 0.24 * f64::from(step);
                let y = 400.0 * sin(0.2 * x) + 60.0 * sin(3.0 * (x - column));
                CurvePoint::smooth(Point3::new(1000.0 * x, y, 1500.0 * (row + height)))
            };
            let points = (0..=4).map(at).collect();
            let kind = Some(CurveKind::Spline);
            curves.push(DesignCurve { name: name.clone(), kind, closed: false, points });
        }
        let shape = PanelShape::Rails(names.map(|name| used(&name)));
        let mut made = panel(&format!("P{n}"), shape, 20);
        made.plane = PlaneChoice::None;
        made.method = PanelMethod::Rails;
        panels.push(made);
    }
    made("facade", "steel-1mm", curves, panels)
}

/// A quarter of a tube, 200 mm in radius and 500 mm long, in 8 samples a rail: too few to tell
/// bending from twist.
pub(super) fn coarse_quarter() -> Made {
    let arc = |y: f64| {
        move |t: f64| {
            let a = from_deg(90.0 * t);
            [200.0 * cos(a), y, 200.0 * sin(a)]
        }
    };
    between("coarse tube", [&arc(0.0), &arc(500.0)], 8, "steel-1mm")
}

/// A wide fan of a cone.
pub(super) fn cone() -> Made {
    let ring = |r: f64, z: f64| {
        move |t: f64| {
            let a = from_deg(300.0 * t);
            [r * cos(a), r * sin(a), z]
        }
    };
    between("cone", [&ring(60.0, 300.0), &ring(200.0, 0.0)], 80, "card-0.3mm")
}

/// A flight of stairs round a post: a helicoid, which warps, flat on more than a turn.
pub(super) fn helicoid() -> Made {
    let helix = |r: f64, turns: f64| {
        move |t: f64| {
            let a = from_deg(360.0 * turns * t);
            [r * cos(a), r * sin(a), 120.0 * t]
        }
    };
    between("ramp", [&helix(60.0, 1.6), &helix(150.0, 1.6)], 120, "steel-1mm")
}

/// A helicoid of 120° that climbs 40 mm round a post, with rails that may move by 5 mm.
pub(super) fn moved() -> Made {
    let helix = |r: f64| {
        move |t: f64| {
            let a = from_deg(120.0 * t);
            [r * cos(a), r * sin(a), 40.0 * t]
        }
    };
    let vary = vec![Vary { limit_mm: Some(5.0), ..Vary::default() }];
    let still = strip("turn", [&helix(60.0), &helix(150.0)], 30, "steel-1mm");
    make(&Design { vary, ..still }, &mut Unwatched).unwrap()
}
