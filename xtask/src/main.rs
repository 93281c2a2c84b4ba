//! Chores of the project.
#![allow(clippy::print_stdout, missing_docs)]
use sheetwright::boundary::*; use sheetwright::triangulate::*; use sheetwright::cost::*; use sheetwright::watch::Unwatched;
use sheetwright_shapes::{family::Family};
fn main() {
    let m: usize = std::env::args().nth(1).and_then(|a| a.parse().ok()).unwrap_or(400);
    for pc in [PlaneChoice::Auto, PlaneChoice::None] {
    for f in Family::ALL { 
    let b = f.boundary(m);
    let plane = supporting_plane(&b, pc).unwrap();
    print!("{:18} {:5}", f.name(), plane.is_some());
    for fold in [0.0, 0.1, 1.0] {
        let o = TriangulateOptions { price: PriceOptions { fold, ..Default::default() }, ..Default::default() };
        let t = std::time::Instant::now();
        let Ok(r) = triangulate(&b, plane.as_ref(), &o, &mut Unwatched) else { print!(" none"); continue };
        let dt = t.elapsed().as_secs_f64();
        print!(" | {:.12} {:.1}ms", r.price, dt*1e3);
    }
    println!();
    }}
}
