//! Surfaces with holes, triangulated by hand, as they are cut open and laid flat: tubes against
//! their analytic development, and what lies flat by itself, which stays closed.
#![allow(clippy::unwrap_used)] // Whatever fails here is a failed test.

use sheetwright::flatten::{Flattened, lay_flat, refold};
use sheetwright::index::{SampleIndex, VertexIndex};
use sheetwright::math::{Point2, Point3, angle_between, cos, sin};
use sheetwright::measure::{area_flat, area_space, length_errors};
use sheetwright::predicate::signed_area_doubled;
use sheetwright::rung::Rung;
use sheetwright::sheet::{Seam, Sheet};
use sheetwright::surface::{Connectivity, Surface};
use sheetwright::watch::Unwatched;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

fn at(x: f64, y: f64, z: f64) -> Point3 {
    Point3::new(x, y, z)
}

/// The surface of some triangles between loops of points. Corners are given by point.
fn surface(loops: &[Vec<Point3>], triangles: &[[Point3; 3]]) -> Surface {
    let key = |p: &Point3| [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits());
    let mut ranges = Vec::new();
    let mut positions: Vec<Point3> = Vec::new();
    for points in loops {
        ranges.push(positions.len()..positions.len() + points.len());
        positions.extend(points);
    }
    let numbers: BTreeMap<_, _> = positions.iter().enumerate().map(|(n, p)| (key(p), n)).collect();
    let triangles =
        triangles.iter().map(|t| t.map(|p| SampleIndex::new(numbers[&key(&p)]))).collect();
    Surface::new(Connectivity::new(&ranges, triangles).unwrap(), positions)
}

/// A band of rulings from `outer` to `inner`, which run side by side.
fn band(outer: &[Point3], inner: &[Point3]) -> Surface {
    let n = outer.len();
    let triangles: Vec<[Point3; 3]> = (0..n)
        .flat_map(|i| {
            let k = (i + 1) % n;
            [[outer[i], outer[k], inner[i]], [outer[k], inner[k], inner[i]]]
        })
        .collect();
    let hole = (0..n).map(|i| inner[(n - i) % n]).collect();
    surface(&[outer.to_vec(), hole], &triangles)
}

fn circle(n: usize, centre: Point3, radius: f64) -> Vec<Point3> {
    (0..n)
        .map(|i| {
            let a = TAU * i as f64 / n as f64;
            at(centre.x + radius * cos(a), centre.y + radius * sin(a), centre.z)
        })
        .collect()
}

fn laid(surface: &Surface, near: &[Point3]) -> (Sheet, Flattened) {
    let (sheet, flat) = lay_flat(surface, near, &mut Unwatched).unwrap();
    // What must hold of every sheet.
    let loops = sheet.loops();
    let at = |v: &VertexIndex| flat.points[v.get()];
    let twice = |n: usize| signed_area_doubled(&loops[n].iter().map(at).collect::<Vec<Point2>>());
    assert!(twice(0) > 0.0 && (1..loops.len()).all(|n| twice(n) < 0.0));
    let inside: f64 = 0.5 * (0..loops.len()).map(twice).sum::<f64>();
    assert!((inside / area_flat(&sheet, &flat) - 1.0).abs() < 1e-9);
    let samples = surface.positions().len() + 2 * sheet.seams().len();
    assert_eq!(flat.points.len(), samples);
    for seam in sheet.seams() {
        let [[a, b], [c, d]] = steps(seam);
        assert_eq!((sheet.origin(a), sheet.origin(b)), (sheet.origin(d), sheet.origin(c)));
        assert_eq!(Rung::new(sheet.origin(a).get(), sheet.origin(b).get()), sheet.seam_rung(seam));
    }
    (sheet, flat)
}

/// The one step of either side of a seam, the sheet to its left.
fn steps(seam: &Seam) -> [[VertexIndex; 2]; 2] {
    seam.steps().map(|side| side[0])
}

fn worst(errors: &[f64]) -> f64 {
    errors.iter().map(|error| error.abs()).fold(0.0, f64::max)
}

/// Exact in every length, and folded up it is the surface again.
fn assert_exact(surface: &Surface, sheet: &Sheet, flat: &Flattened) {
    let error = worst(&length_errors(sheet, flat));
    assert!(error < 1e-9, "{error}");
    assert!((area_flat(sheet, flat) / area_space(sheet) - 1.0).abs() < 1e-9);
    let miss = refold(sheet, &flat.points, &sheet.rungs()).unwrap();
    assert!(miss < 1e-9 * surface.positions().len() as f64, "{miss}");
}

#[test]
fn a_frustum_is_a_sector_of_an_annulus() {
    // 200 facets between a circle of radius 2 and one of radius 1, 1.5 above.
    let n = 200;
    let (low, high) = (circle(n, at(0., 0., 0.), 2.0), circle(n, at(0., 0., 1.5), 1.0));
    let frustum = band(&low, &high);
    let (sheet, flat) = laid(&frustum, &[]);
    assert_exact(&frustum, &sheet, &flat);
    assert_eq!(flat.overlap, None);
    let [seam] = sheet.seams() else { panic!("{:?}", sheet.seams()) };
    assert_eq!(sheet.seam_rung(seam), Rung::new(0, n), "the first of equals");
    assert_eq!(sheet.loops().len(), 1);
    // The apex of the flat sector, where the sides of the seam meet.
    let ends = steps(seam).map(|side| side.map(|s| flat.points[s.get()]));
    let [outer, other_outer] = [ends[0][0], ends[1][1]];
    let slant = (1.0f64 + 1.5 * 1.5).sqrt();
    let apex = outer + (ends[0][1] - outer) * (2.0 * slant / slant);
    for (n, p) in flat.points.iter().enumerate() {
        let on_low = sheet.origin(VertexIndex::new(n)).get() < 200;
        let radius = if on_low { 2.0 * slant } else { slant };
        assert!((apex.distance(*p) - radius).abs() < 1e-9);
    }
    // The angle of the sector: a full turn times radius over slant height, for infinitely many.
    let facet = 2.0 * (sin(0.5 * TAU / n as f64) * 2.0 / (2.0 * slant)).asin_of();
    let chord = outer.distance(other_outer);
    let exact = 2.0 * 2.0 * slant * sin(0.5 * (TAU - n as f64 * facet)).abs();
    assert!((chord - exact).abs() < 1e-9, "{chord} {exact}");
    let smooth = TAU / slant;
    let arc = n as f64 * facet;
    assert!((arc / smooth - 1.0).abs() < 5e-4, "{arc} {smooth}");
    let sector = 0.5 * smooth * (4.0 - 1.0) * slant * slant;
    assert!((area_flat(&sheet, &flat) / sector - 1.0).abs() < 5e-4);
}

trait ArcSine {
    fn asin_of(self) -> f64;
}

impl ArcSine for f64 {
    fn asin_of(self) -> f64 {
        sheetwright::math::atan2(self, (1.0 - self * self).sqrt())
    }
}

#[test]
fn an_oblique_cone_unrolls_about_its_apex() {
    // Rulings from a circle to the apex, cut half way: both rims are circles.
    let n = 200;
    let apex = at(0.8, 0.3, 2.0);
    let low = circle(n, at(0., 0., 0.), 1.0);
    let high: Vec<Point3> = low.iter().map(|p| p.lerp(apex, 0.5)).collect();
    let cone = band(&low, &high);
    let (sheet, flat) = laid(&cone, &[]);
    assert_exact(&cone, &sheet, &flat);
    let [seam] = sheet.seams() else { panic!("{:?}", sheet.seams()) };
    // Cut where it is shortest: on the side that the apex leans to.
    let [i, _] = sheet.seam_rung(seam).ends().map(SampleIndex::get);
    let shortest =
        (0..n).min_by(|&a, &b| low[a].distance(high[a]).total_cmp(&low[b].distance(high[b])));
    assert_eq!(Some(i), shortest);
    // Both sides of the seam lead to the flat apex, and every sample keeps its distance from it.
    let [[a, b], _] = steps(seam).map(|side| side.map(|s| flat.points[s.get()]));
    let flat_apex = b + (b - a);
    for (k, p) in flat.points.iter().enumerate() {
        let space = cone.position(sheet.sample(VertexIndex::new(k)));
        assert!((flat_apex.distance(*p) - apex.distance(space)).abs() < 1e-9);
    }
    // The angle at the apex, against that of the smooth cone.
    let angle = |points: &[Point3]| -> f64 {
        let m = points.len();
        (0..m).map(|k| angle_between(points[k] - apex, points[(k + 1) % m] - apex)).sum()
    };
    let (polyline, smooth) = (angle(&low), angle(&circle(100_000, at(0., 0., 0.), 1.0)));
    assert!((polyline / smooth - 1.0).abs() < 5e-4, "{polyline} {smooth}");
    let ends = steps(seam).map(|side| flat.points[side[0].get()]);
    let opened = angle_between(
        (flat.points[steps(seam)[0][0].get()] - flat_apex).extend(0.0),
        (flat.points[steps(seam)[1][1].get()] - flat_apex).extend(0.0),
    );
    assert!((opened - polyline.min(TAU - polyline)).abs() < 1e-9, "{opened} {ends:?}");
}

#[test]
fn a_cut_is_made_where_the_user_says() {
    let n = 64;
    let tube = band(&circle(n, at(0., 0., 0.), 1.0), &circle(n, at(0., 0., 3.0), 1.0));
    let (sheet, flat) = laid(&tube, &[at(-5.0, 0.1, 1.5)]);
    assert_exact(&tube, &sheet, &flat);
    assert_eq!(sheet.seams().len(), 1);
    let [low, _] = sheet.seam_rung(&sheet.seams()[0]).ends();
    assert!(tube.position(low).x < -0.99);
    // A tube unrolls to a rectangle, or a parallelogram where it is cut along a slanting rung.
    let around = 2.0 * n as f64 * sin(0.5 * TAU / n as f64);
    assert!((area_flat(&sheet, &flat) - 3.0 * around).abs() < 1e-9);
    assert!((sheet.seams()[0].gap_mm - around).abs() < 1e-9);
}

#[test]
fn a_planar_annulus_stays_closed() {
    let annulus = band(&circle(90, at(5., 5., 5.), 2.0), &circle(90, at(5.3, 5., 5.), 1.0));
    let (sheet, flat) = laid(&annulus, &[]);
    assert_exact(&annulus, &sheet, &flat);
    assert_eq!((sheet.seams().len(), flat.overlap), (0, None));
    assert_eq!(sheet, Sheet::whole(&annulus));
    // Congruent to itself: all distances are kept, also those that no rung spans.
    for i in (0..180).step_by(7) {
        for k in 0..i {
            let [space, flat] = [
                annulus.positions()[i].distance(annulus.positions()[k]),
                flat.points[i].distance(flat.points[k]),
            ];
            assert!((space - flat).abs() < 1e-11, "{i} {k}");
        }
    }
}

/// The facets of a prism of `columns`: at each, places along the ruling from the lower rim to the
/// upper; between two columns, the spans that both have are sheet. Rims, then windows, as loops.
struct Prism {
    foot: Vec<Point2>,
    closed: bool,
}

impl Prism {
    /// A window is the columns from its first to its last, and below and above it at each.
    fn surface(&self, height: f64, windows: &[(usize, Vec<[f64; 2]>)]) -> Surface {
        let n = self.foot.len();
        let place = |i: usize, z: f64| at(self.foot[i % n].x, self.foot[i % n].y, z);
        // The places on column i from one height to another.
        let chain = |i: usize, from: f64, to: f64| -> Vec<Point3> {
            let on =
                windows.iter().filter_map(|(first, sides)| sides.get((i % n).checked_sub(*first)?));
            let mut heights: Vec<f64> = on.flatten().copied().chain([from, to]).collect();
            heights.retain(|z| (from..=to).contains(z));
            heights.sort_by(f64::total_cmp);
            heights.dedup();
            heights.into_iter().map(|z| place(i, z)).collect()
        };
        let mut triangles = Vec::new();
        let mut quad = |i: usize, [a, b]: [f64; 2], [c, d]: [f64; 2]| {
            // Up column i from a to b and up the next from c to d, the lower of both first.
            let (left, right) = (chain(i, a, b), chain(i + 1, c, d));
            let (mut l, mut r) = (0, 0);
            while l + 1 < left.len() || r + 1 < right.len() {
                let on_left =
                    r + 1 == right.len() || (l + 1 < left.len() && left[l + 1].z < right[r + 1].z);
                let next = if on_left { left[l + 1] } else { right[r + 1] };
                triangles.push([left[l], right[r], next]);
                if on_left { l += 1 } else { r += 1 }
            }
        };
        let gap = |i: usize, k: usize| -> Option<[[f64; 2]; 2]> {
            let (first, sides) = windows.iter().find(|(first, sides)| {
                (*first..*first + sides.len()).contains(&i) && k < first + sides.len()
            })?;
            Some([sides[i - first], sides[k - first]])
        };
        for i in 0..(if self.closed { n } else { n - 1 }) {
            match gap(i, i + 1) {
                None => quad(i, [0.0, height], [0.0, height]),
                Some([[low, high], [next_low, next_high]]) => {
                    quad(i, [0.0, low], [0.0, next_low]);
                    quad(i, [high, height], [next_high, height]);
                }
            }
        }
        let upper: Vec<Point3> = (0..n).rev().map(|i| place(i, height)).collect();
        let lower: Vec<Point3> = (0..n).map(|i| place(i, 0.0)).collect();
        let mut loops =
            if self.closed { vec![lower, upper] } else { vec![[lower, upper].concat()] };
        for (first, sides) in windows {
            let columns = *first..*first + sides.len();
            let up = columns.clone().map(|i| place(i, sides[i - first][1]));
            let back = columns.rev().map(|i| place(i, sides[i - first][0]));
            let mut hole: Vec<Point3> = up.chain(back).collect();
            hole.dedup();
            if hole.first() == hole.last() {
                hole.pop();
            }
            loops.push(hole);
        }
        surface(&loops, &triangles)
    }
}

/// An arc of columns; a closed one is a whole tube.
fn columns(n: usize, radius: f64, degrees: f64) -> Prism {
    let closed = degrees == 360.0;
    let steps = if closed { n } else { n - 1 };
    let foot = (0..n)
        .map(|i| {
            let a = sheetwright::math::from_deg(degrees * i as f64 / steps as f64);
            Point2::new(radius * cos(a), radius * sin(a))
        })
        .collect();
    Prism { foot, closed }
}

/// A lens from column `first` on, pointed at both ends.
fn window(first: usize, count: usize, middle: f64, half: f64) -> (usize, Vec<[f64; 2]>) {
    let side = |k: usize| {
        let across = half * sin(0.5 * TAU * k as f64 / (count - 1) as f64);
        let across = if k == 0 || k + 1 == count { 0.0 } else { across };
        [middle - across, middle + across]
    };
    (first, (0..count).map(side).collect())
}

#[test]
fn windows_in_a_bent_panel_stay_closed() {
    let panel = columns(40, 2.0, 100.0);
    let windows = [window(5, 9, 1.0, 0.5), window(20, 12, 2.0, 0.8)];
    for count in 1..=2 {
        let patch = panel.surface(3.0, &windows[..count]);
        let (sheet, flat) = laid(&patch, &[]);
        assert_exact(&patch, &sheet, &flat);
        assert_eq!((sheet.seams().len(), flat.overlap), (0, None));
        assert_eq!(sheet.loops().len(), 1 + count);
    }
}

#[test]
fn a_plane_with_two_square_holes_stays_closed() {
    // Columns in one plane are a square plate.
    let foot = (0..11).map(|i| Point2::new(f64::from(i), 0.0)).collect();
    let plate = Prism { foot, closed: false };
    let square = |first: usize| (first, vec![[4.0, 6.0]; 3]);
    let panel = plate.surface(10.0, &[square(2), square(6)]);
    let (sheet, flat) = laid(&panel, &[]);
    assert_exact(&panel, &sheet, &flat);
    assert_eq!((sheet.seams().len(), flat.overlap), (0, None));
    assert!((area_flat(&sheet, &flat) - 92.0).abs() < 1e-9);
}

#[test]
fn a_tube_is_cut_clear_of_its_window() {
    // The ways from rim to window and on to the other rim are shorter than that from rim to rim,
    // and yet the seam is one, and the window whole.
    let tube = columns(60, 1.0, 360.0).surface(4.0, &[window(10, 21, 2.0, 1.2)]);
    let (sheet, flat) = laid(&tube, &[]);
    assert_exact(&tube, &sheet, &flat);
    let loops = sheet.loops();
    assert_eq!((sheet.seams().len(), loops.len()), (1, 2));
    assert_eq!(loops[1].len(), 40);
    let [low, high] = sheet.seam_rung(&sheet.seams()[0]).ends().map(SampleIndex::get);
    assert!(low < 60 && (60..120).contains(&high), "from rim to rim");
    assert_eq!(flat.overlap, None);
    // Where the user wants it through the window, both halves of the cut stay.
    let through = [at(-0.05, 1.0, 0.4), at(-0.05, 1.0, 3.6)];
    let (sheet, flat) = laid(&tube, &through);
    assert_exact(&tube, &sheet, &flat);
    let loops = sheet.loops();
    assert_eq!((sheet.seams().len(), loops.len()), (2, 1));
}

#[test]
fn a_gap_that_nobody_notices_is_closed_and_told() {
    // A washer that is dished by 0.5°: its sides would gape by 0.24 mm in a metre.
    let rise = |degrees: f64| sheetwright::math::from_deg(degrees);
    let washer = |degrees: f64| {
        let height = 500.0 * sin(rise(degrees)) / cos(rise(degrees));
        band(&circle(120, at(0., 0., 0.), 1000.0), &circle(120, at(0., 0., height), 500.0))
    };
    let slight = washer(0.5);
    let (sheet, flat) = laid(&slight, &[]);
    assert_eq!(sheet.seams().len(), 0);
    let error = worst(&length_errors(&sheet, &flat));
    // The rulings are longer than those of a flat washer by 1 / cos of the slope, which the outer
    // rim, the inner one and the rulings share about equally.
    let least = 0.5 * rise(0.5) * rise(0.5);
    assert!((0.25 * least..0.5 * least).contains(&error), "{error} {least}");
    // A steeper one keeps its seam and its lengths.
    let steep = washer(5.0);
    let (sheet, flat) = laid(&steep, &[]);
    assert_exact(&steep, &sheet, &flat);
    assert_eq!(sheet.seams().len(), 1);
}
