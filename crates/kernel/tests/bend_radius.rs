//! Bend radii of surfaces where they are known.
#![allow(clippy::unwrap_used, clippy::print_stdout)] // tests panic and print what they measured

use sheetwright::boundary::{Boundary, PlaneChoice, samples_from_points, supporting_plane};
use sheetwright::check::{CheckedFrom, Subject, Verdict, check};
use sheetwright::cost::Prices;
use sheetwright::curve::CurvePoint;
use sheetwright::elastic::{Edges, predict, screen};
use sheetwright::flatten::lay_flat;
use sheetwright::material::Material;
use sheetwright::math::{Point3, cos, sin};
use sheetwright::measure::{CutFrom, Measures, measures};
use sheetwright::surface::{Connectivity, Surface};
use sheetwright::triangulate::{TriangulateOptions, triangulate};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::developable::{Blob, Cone, Developable, blobs};
use sheetwright_shapes::family::Family;
use sheetwright_shapes::materials::plywood;
use sheetwright_shapes::rings::{Loop, Pierced, pierced};

fn measured(boundary: &Boundary) -> Measures {
    checked(boundary, None).0
}

/// The measures of the surface through a boundary, and the verdict on it.
fn checked(boundary: &Boundary, material: Option<&Material>) -> (Measures, Verdict) {
    let plane = supporting_plane(boundary, PlaneChoice::Auto).unwrap();
    let options = TriangulateOptions::default();
    let found = triangulate(boundary, plane.as_ref(), &options, &mut Unwatched).unwrap();
    let triangles = found.triangles.clone();
    let connectivity = Connectivity::new(boundary.loops(), triangles).unwrap();
    let surface = Surface::new(connectivity, boundary.positions());
    let prices = Prices::new(boundary, plane.as_ref(), options.price);
    let (sheet, flat) = lay_flat(&surface, &[], &mut Unwatched).unwrap();
    let measures = measures(CutFrom::Surface(&surface, &prices), &sheet, &flat);
    let from = CheckedFrom::Boundary(boundary, &found);
    let screened = screen(&sheet, &flat, &measures, material);
    let predicted = predict(&sheet, &flat, &Edges::default(), &measures, &screened, &mut Unwatched);
    let part = Subject {
        sheet: &sheet,
        flat: &flat,
        measures: &measures,
        predicted: predicted.as_ref(),
        material,
        from,
    };
    let verdict = check(&part).verdict;
    (measures, verdict)
}

/// The share by which the bend radius of a boundary differs from the least on `border`, a list of
/// parameters on its surface.
fn error(surface: &dyn Developable, border: &[[f64; 2]], boundary: &Boundary) -> f64 {
    let radii = border.iter().map(|&[u, v]| surface.bend_radius(u, v));
    let truth = radii.fold(f64::INFINITY, f64::min);
    let found = measured(boundary);
    assert_eq!(found.apexes, [], "no rulings run together");
    found.bend_radius_min_mm / truth - 1.0
}

const STEPS: u32 = 2_000;

/// What plywood takes to 290 mm: a cylinder of 300 mm with windows bends with force, and a cone
/// that is 710 mm in its middle and 150 mm at its narrow end does not.
#[test]
fn the_verdict_goes_by_the_tightest_end() {
    let plywood = plywood();
    for shape in pierced().iter().filter(|shape| shape.name.starts_with("patch")) {
        for m in [200, 400] {
            let (found, verdict) = checked(&shape.sampled(m).boundary, Some(&plywood));
            println!("{} {m}: {:.1} mm", shape.name, found.bend_radius_min_mm);
            assert_eq!(verdict, Verdict::BendsWithForce, "{} {m}", shape.name);
        }
    }
    let (low, high) = ([-0.4, 260.0], [0.4, 2_200.0]);
    let cone = Pierced {
        name: "cone",
        surface: Box::new(Cone { half_angle: std::f64::consts::FRAC_PI_6 }),
        loops: vec![Loop::Patch {
            middle: [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])],
            half: [0.5 * (high[0] - low[0]), 0.5 * (high[1] - low[1])],
        }],
    };
    // With 100 samples its narrow end has two edges: too few to tell the radius there.
    let told = [Verdict::Undecided, Verdict::WillNotBend, Verdict::WillNotBend];
    for (m, told) in [100, 200, 400].into_iter().zip(told) {
        let (found, verdict) = checked(&cone.sampled(m).boundary, Some(&plywood));
        println!("cone {m}: {:.1} mm", found.bend_radius_min_mm);
        assert_eq!(verdict, told, "{m}");
    }
}

/// These outlines are concave in places, so that the surface is the only one through them: an
/// ellipse round a cylinder bounds a second cylinder across the first.
#[test]
fn the_tight_end_is_found_and_errors_fall() {
    for blob in blobs() {
        let border: Vec<[f64; 2]> =
            (0..STEPS).map(|n| blob.parameters(f64::from(n) / f64::from(STEPS))).collect();
        let errors =
            [50, 100, 200, 400].map(|m| error(blob.surface.as_ref(), &border, &blob.boundary(m).0));
        println!("{}: {errors:.4?}", blob.name);
        let [at_50, at_100, at_200, at_400] = errors.map(f64::abs);
        assert!(at_50 < 0.05 && at_100 < 0.015 && at_200 < 0.007, "{}: {errors:?}", blob.name);
        // A roll has a depth, so that where the radius changes along the border, a few thousandths
        // stay.
        assert!(at_400 < 0.006 && at_400 < 0.5 * at_50, "{}: {errors:?}", blob.name);
    }
}

/// At the tip of a window its edge runs along the rulings, and how far the sheet turns there is
/// known no better than rulings are.
#[test]
fn windows_hardly_change_it() {
    let mut shapes = pierced();
    shapes.push(Pierced {
        name: "cone, window",
        surface: Box::new(Cone { half_angle: std::f64::consts::FRAC_PI_6 }),
        loops: vec![
            Loop::Round(400.0),
            Loop::Back(900.0),
            Loop::Window { middle: [1.0, 540.0], half: [0.4, 100.0] },
        ],
    });
    for shape in shapes {
        let steps = |l: &Loop| {
            let l = *l;
            (0..STEPS).map(move |n| l.parameters(f64::from(n) / f64::from(STEPS)))
        };
        let border: Vec<[f64; 2]> = shape.loops.iter().flat_map(steps).collect();
        let errors = [100, 200, 400]
            .map(|m| error(shape.surface.as_ref(), &border, &shape.sampled(m).boundary));
        println!("{}: {errors:.4?}", shape.name);
        let [at_100, at_200, at_400] = errors.map(f64::abs);
        assert!(at_100 < 0.03 && at_200 < 0.02 && at_400 < 0.01, "{}: {errors:?}", shape.name);
    }
}

#[test]
fn a_radius_that_is_less_than_the_limit_by_some_per_cent_is_undecided() {
    let patch = Family::CylinderPatch.boundary(200);
    for (limit_mm, told) in [
        (98.0, Verdict::BendsWithForce),
        (102.0, Verdict::Undecided),
        (108.0, Verdict::WillNotBend),
    ] {
        let mut sheet = plywood();
        sheet.thickness_mm.value = 1.0;
        sheet.bend_radius_mm.value = limit_mm;
        assert_eq!(checked(&patch, Some(&sheet)).1, told, "100 mm of {limit_mm}");
    }
}

#[test]
fn straight_sides_and_flat_corners_do_not_change_it() {
    for m in [50, 100, 200, 400] {
        let radius = measured(&Family::CylinderPatch.boundary(m)).bend_radius_min_mm;
        println!("{m}: {radius}");
        assert!((radius / 100.0 - 1.0).abs() < 1e-3, "{m}: {radius}");
    }
}

/// A quarter of a cone with its point: 200 mm along the side, rulings 30° from the axis.
#[test]
fn a_point_is_named_and_the_radius_measured_apart_from_it() {
    let cone = Cone { half_angle: std::f64::consts::FRAC_PI_6 };
    for count in [20, 40, 80] {
        let at = |u: f64, v: f64| CurvePoint::smooth(cone.space(u, v));
        let corner = |u: f64, v: f64| CurvePoint::corner(cone.space(u, v));
        let turn = std::f64::consts::FRAC_PI_2;
        let share = |n: u32| f64::from(n) / f64::from(count);
        let mut points = vec![corner(0.0, 0.0)];
        points.extend((1..count).map(|n| at(0.0, 200.0 * share(n))));
        points.push(corner(0.0, 200.0));
        points.extend((1..count).map(|n| at(turn * share(n), 200.0)));
        points.push(corner(turn, 200.0));
        points.extend((1..count).rev().map(|n| at(turn, 200.0 * share(n))));
        let found = measured(&Boundary::new(vec![samples_from_points(&points)]).unwrap());
        println!("{count}: {} {:?}", found.bend_radius_min_mm, found.apexes);
        let [apex] = found.apexes[..] else { panic!("{count}: {:?}", found.apexes) };
        assert_eq!(apex.sample.get(), 0);
        // Normals run on a circle of the radius cos 30°, over a chord of which the fan turns.
        assert!((1.0..1.4).contains(&apex.turn), "{count}: {apex:?}");
        // The radius is the distance from the point times tan 30°: below 10 mm within 17.3 mm.
        let reach = apex.reach_mm(10.0);
        assert!((reach / (10.0 * 3f64.sqrt()) - 1.0).abs() < 0.02, "{count}: {reach}");
        let truth = cone.bend_radius(0.0, 200.0);
        assert!((found.bend_radius_min_mm / truth - 1.0).abs() < 0.02, "{count}: {found:?}");
    }
}

/// The round end of that quarter as a polygon, each side of five samples: between the hinges that
/// turn lie flat ones.
#[test]
fn a_point_of_flat_facets_reaches_as_far_as_that_of_the_cone() {
    let cone = Cone { half_angle: std::f64::consts::FRAC_PI_6 };
    let (sides, samples) = (24, 5);
    let turn = std::f64::consts::FRAC_PI_2;
    let corner = |n: u32| cone.space(turn * f64::from(n) / f64::from(sides), 200.0);
    let tip = cone.space(0.0, 0.0);
    let mut points = vec![CurvePoint::corner(tip)];
    let side = |from: Point3, to: Point3, n: u32, count: u32| {
        CurvePoint::smooth(from + (to - from) * (f64::from(n) / f64::from(count)))
    };
    points.extend((1..40).map(|n| side(tip, corner(0), n, 40)));
    for n in 0..sides {
        points.extend((0..samples).map(|k| side(corner(n), corner(n + 1), k, samples)));
    }
    points.extend((0..40).map(|n| side(corner(sides), tip, n, 40)));
    let found = measured(&Boundary::new(vec![samples_from_points(&points)]).unwrap());
    let [apex] = found.apexes[..] else { panic!("{:?}", found.apexes) };
    let reach = apex.reach_mm(10.0);
    assert!((reach / (10.0 * 3f64.sqrt()) - 1.0).abs() < 0.05, "{reach}");
}

/// A surface of 1000 × 400 mm with four corners, from flat coordinates: bent along its length, as
/// far along as `profile` says, its rulings askew by an angle.
struct Sheet {
    name: &'static str,
    profile: fn(f64) -> [f64; 2],
    askew: f64,
    /// Its least bend radius, mm.
    radius: f64,
}

/// A circle of 400 mm.
fn round(s: f64) -> [f64; 2] {
    [400.0 * sin(s / 400.0), 400.0 * cos(s / 400.0)]
}

/// Flat, rolled by 60° to 150 mm, flat.
fn rolled(s: f64) -> [f64; 2] {
    let third = std::f64::consts::FRAC_PI_3;
    let s = s - 500.0 + 75.0 * third;
    let (before, after) = (s.min(0.0), (s - 150.0 * third).max(0.0));
    let angle = (s / 150.0).clamp(0.0, third);
    let (x, z) = (150.0 * sin(angle) + before, 150.0 * (cos(angle) - 1.0));
    [x + after * cos(third), z - after * sin(third)]
}

/// Up and down, 12 mm each, every 200 mm.
fn waves(s: f64) -> [f64; 2] {
    [s, 12.0 * sin(std::f64::consts::PI * s / 200.0)]
}

fn sheets() -> [Sheet; 5] {
    let waviness = std::f64::consts::PI / 200.0;
    let flat: fn(f64) -> [f64; 2] = |s| [s, 0.0];
    let sheet = |name, profile, askew, radius| Sheet { name, profile, askew, radius };
    [
        sheet("flat", flat, 0.0, f64::INFINITY),
        sheet("round", round, 0.0, 400.0),
        sheet("round, askew", round, 0.5, 400.0),
        sheet("rolled", rolled, 0.0, 150.0),
        sheet("waves", waves, 0.0, 1.0 / (12.0 * waviness * waviness)),
    ]
}

impl Sheet {
    /// About m points round it, turned out of the axes so that rounding them bends it.
    fn points(&self, m: usize) -> Vec<CurvePoint> {
        let at = |u: f64, v: f64| {
            let (s, c) = (sin(self.askew), cos(self.askew));
            let [x, z] = (self.profile)(c * u - s * v);
            let y = s * u + c * v;
            let (x, z) = (0.8 * x - 0.6 * z, 0.6 * x + 0.8 * z);
            Point3::new(x, 0.8 * y - 0.6 * z, 0.6 * y + 0.8 * z)
        };
        let corners = [[0.0, 0.0], [1000.0, 0.0], [1000.0, 400.0], [0.0, 400.0]];
        let side = |n: usize| {
            let ([u, v], [to_u, to_v]) = (corners[n], corners[(n + 1) % 4]);
            let count = [5 * m / 14, m / 7][n % 2];
            (0..count).map(move |k| {
                let share = k as f64 / count as f64;
                let p = at(u + share * (to_u - u), v + share * (to_v - v));
                if k == 0 { CurvePoint::corner(p) } else { CurvePoint::smooth(p) }
            })
        };
        (0..4).flat_map(side).collect()
    }
}

fn bounded_by(points: &[CurvePoint]) -> Boundary {
    Boundary::new(vec![samples_from_points(points)]).unwrap()
}

#[test]
fn errors_fall_where_sheets_are_flat_in_places_and_where_they_turn_over() {
    for sheet in sheets() {
        let errors = [50, 100, 200, 400].map(|m| {
            let found = measured(&bounded_by(&sheet.points(m)));
            assert_eq!(found.apexes, [], "{}", sheet.name);
            if sheet.radius.is_finite() {
                found.bend_radius_min_mm / sheet.radius - 1.0
            } else {
                assert_eq!(found.bend_radius_min_mm, f64::INFINITY);
                0.0
            }
        });
        println!("{}: {errors:.4?}", sheet.name);
        let [at_50, at_100, at_200, at_400] = errors.map(f64::abs);
        assert!(at_50 < 0.5 && at_100 < 0.15 && at_200 < 0.05, "{}: {errors:?}", sheet.name);
        // Waves are averaged over the depth of a roll.
        assert!(at_400 < 0.03, "{}: {errors:?}", sheet.name);
    }
}

/// Tables of points have some digits, which bend a sheet by nothing that matters. The finer the
/// samples, the more they turn the edges; what is left of that is what a bend radius may read low
/// by.
#[test]
fn rounded_points_are_not_taken_for_bends() {
    for sheet in sheets() {
        for (digit, flattest, most) in [(0.01, 20_000.0, 0.05), (0.1, 2_000.0, 0.3)] {
            let rounded = |x: f64| (x / digit).round() * digit;
            let radii = [100, 200, 400].map(|m| {
                let points = sheet.points(m).into_iter().map(|point| {
                    let at = point.at;
                    let at = Point3::new(rounded(at.x), rounded(at.y), rounded(at.z));
                    CurvePoint { at, ..point }
                });
                measured(&bounded_by(&points.collect::<Vec<_>>())).bend_radius_min_mm
            });
            println!("{} to {digit} mm: {radii:.0?} of {:.0}", sheet.name, sheet.radius);
            let least = radii.into_iter().fold(f64::INFINITY, f64::min);
            assert!(least > (1.0 - most) * sheet.radius.min(flattest), "{}: {radii:?}", sheet.name);
        }
    }
}

/// Which sample is the first, where the sheet lies, which side is up and how large all is.
#[test]
fn it_does_not_depend_on_how_the_boundary_is_told() {
    let mut outlines: Vec<(&str, Vec<CurvePoint>)> =
        sheets().iter().skip(1).map(|sheet| (sheet.name, sheet.points(150))).collect();
    for blob in blobs() {
        let samples = blob.boundary(150).0;
        let points = samples.positions().into_iter().map(CurvePoint::smooth).collect();
        outlines.push((blob.name, points));
    }
    for (name, points) in outlines {
        let radius = |points: &[CurvePoint]| measured(&bounded_by(points)).bend_radius_min_mm;
        let as_told = radius(&points);
        let mut shifted = points.clone();
        shifted.rotate_left(61);
        let turned_by = |p: Point3| {
            let (s, c) = (sin(0.7), cos(0.7));
            Point3::new(c * p.x - s * p.y + 500.0, c * p.y + s * p.x - 70.0, p.z + 20.0)
        };
        let moved: Vec<CurvePoint> =
            points.iter().map(|point| CurvePoint { at: turned_by(point.at), ..*point }).collect();
        let doubled = |p: Point3| Point3::new(2.0 * p.x, 2.0 * p.y, 2.0 * p.z);
        let larger: Vec<CurvePoint> =
            points.iter().map(|point| CurvePoint { at: doubled(point.at), ..*point }).collect();
        let reversed: Vec<CurvePoint> = points.iter().rev().copied().collect();
        let told = [
            radius(&shifted) / as_told - 1.0,
            radius(&moved) / as_told - 1.0,
            0.5 * radius(&larger) / as_told - 1.0,
            radius(&reversed) / as_told - 1.0,
        ];
        println!("{name}: {as_told:.2} mm; {told:?}");
        let [shifted, moved, larger, reversed] = told.map(f64::abs);
        assert!(shifted < 1e-9 && moved < 1e-6 && larger < 1e-9, "{name}: {told:?}");
        // Rolls begin anywhere and end where they are deep enough, so that others are looked at.
        assert!(reversed < 0.05, "{name}: {told:?}");
    }
}

/// Outlines that come near to the point of a cone, to 60 and 40 mm, where a roll is one or two
/// samples wide at first: it reads wide, since nothing tells how much tighter it is, and comes
/// down.
#[test]
fn the_tight_end_is_found_near_the_point_of_a_cone() {
    for (reach, worst) in [(240.0, 0.1), (260.0, 0.25)] {
        let blob = Blob {
            surface: Box::new(Cone { half_angle: std::f64::consts::FRAC_PI_6 }),
            middle: [0.0, 300.0],
            half: [1.2, reach],
            wave: 0.1,
            name: "cone",
        };
        let border: Vec<[f64; 2]> =
            (0..STEPS).map(|n| blob.parameters(f64::from(n) / f64::from(STEPS))).collect();
        let errors =
            [50, 100, 200, 400].map(|m| error(blob.surface.as_ref(), &border, &blob.boundary(m).0));
        println!("{reach}: {errors:.4?}");
        assert!(errors.is_sorted_by(|more, less| less < more), "{reach}: {errors:?}");
        assert!((0.0..worst).contains(&errors[3]), "{reach}: {errors:?}");
    }
}

#[test]
fn a_plane_is_not_bent() {
    let points: Vec<CurvePoint> = (0..60)
        .map(|n| {
            let angle = std::f64::consts::TAU * f64::from(n) / 60.0;
            let r = 100.0 + 30.0 * cos(5.0 * angle);
            CurvePoint::smooth(Point3::new(
                r * cos(angle),
                0.6 * r * sin(angle),
                0.8 * r * sin(angle),
            ))
        })
        .collect();
    let found = measured(&Boundary::new(vec![samples_from_points(&points)]).unwrap());
    assert_eq!(found.bend_radius_min_mm, f64::INFINITY);
    assert_eq!(found.apexes, []);
}
