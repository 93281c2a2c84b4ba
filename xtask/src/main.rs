//! Chores of the project.
#![allow(clippy::print_stdout, missing_docs)]
use sheetwright::boundary::*;
use sheetwright::cost::*;
use sheetwright::curve::*;
use sheetwright::flatten::*;
use sheetwright::math::*;
use sheetwright::measure::*;
use sheetwright::surface::*;
use sheetwright::triangulate::*;
use sheetwright::watch::Unwatched;
use sheetwright_shapes::{developable::*, family::Family, hemisphere};
fn run(name: &str, b: &Boundary, pc: PlaneChoice, prices: bool) {
    let plane = supporting_plane(b, pc).unwrap();
    print!("{name:18} plane {:5}", plane.is_some());
    let mut w0 = 0.0;
    for fold in [0.0, 0.001, 0.01, 0.1, 0.3, 1.0, 3.0] {
        let o = TriangulateOptions {
            price: PriceOptions { fold, ..Default::default() },
            ..Default::default()
        };
        let Ok(r) = triangulate(b, plane.as_ref(), &o, &mut Unwatched) else {
            print!(" none");
            continue;
        };
        let s =
            Surface::new(Connectivity::new(b.loops(), r.triangles.clone()).unwrap(), b.positions());
        let f = unroll(s.connectivity(), |a, c| s.length(a, c), &mut Unwatched).unwrap();
        let m = measures(&s, &f, &Prices::new(b, plane.as_ref(), o.price));
        if fold == 0.0 {
            w0 = m.twist_total;
        }
        print!(
            " | {:.5} {:+.1}% {:.1}° {:.1}",
            m.twist_total,
            ((m.twist_total / w0 - 1.0) * 100.0).min(9999.0),
            to_deg(m.crease_max),
            to_deg(m.warp_max)
        );
        if prices {}
    }
    println!();
}
fn main() {
    for pc in [PlaneChoice::Auto, PlaneChoice::None] {
        for band in 0..3 {
            let b = hemisphere::piece(200.0, 12, 3, band, 66);
            run(&format!("hemi {band}"), &b, pc, true);
            let pts: Vec<CurvePoint> = b.positions().into_iter().map(CurvePoint::smooth).collect();
            let c = Boundary::new(vec![samples_from_points(&pts)]).unwrap();
            run(&format!("hemi {band} smooth"), &c, pc, true);
        }
        for f in [Family::TwistedStrip, Family::CylinderPatch] {
            let b = f.boundary(400);
            let pts: Vec<CurvePoint> = b.positions().into_iter().map(CurvePoint::smooth).collect();
            let c = Boundary::new(vec![samples_from_points(&pts)]).unwrap();
            run(&format!("{} smooth", f.name()), &c, pc, true);
        }
        for wave in [0.0, 0.05, 0.1, 0.2] {
            let c = Blob {
                surface: Box::new(Cone { half_angle: 0.523 }),
                middle: [0.0, 600.0],
                half: [1.2, 250.0],
                wave,
                name: "",
            };
            run(&format!("cone {wave}"), &c.boundary(400).0, pc, true);
        }
        for w in [0.6, 0.9, 1.5] {
            let c = Blob {
                surface: Box::new(Cone { half_angle: 0.523 }),
                middle: [0.0, 600.0],
                half: [w, 250.0],
                wave: 0.0,
                name: "",
            };
            run(&format!("cone half {w}"), &c.boundary(400).0, pc, true);
        }
    }
}
