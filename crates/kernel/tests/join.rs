//! P1 ⊕ P2 by hand, on random polygons, and around holes; joints made smooth.

#![allow(clippy::unwrap_used, reason = "a test that can't go on fails")]

use sheetwright::boundary::{
    Boundary, Continuity, JoinCause, JoinOptions, Joined, Within, join, join_all,
    samples_from_points,
};
use sheetwright::cost::PriceOptions;
use sheetwright::curve::{CurvePoint, Sample};
use sheetwright::math::{Point3, Vec3, angle_between, cos, from_deg, sin};
use sheetwright::triangulate::{TriangulateOptions, triangulate};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::developable::blobs;
use sheetwright_shapes::random::{Random, star};

fn corners(list: &[[f64; 3]]) -> Vec<Sample> {
    let points: Vec<CurvePoint> =
        list.iter().map(|p| CurvePoint::corner(Point3::new(p[0], p[1], p[2]))).collect();
    samples_from_points(&points)
}

fn polygon(list: &[[f64; 3]]) -> Boundary {
    Boundary::new(vec![corners(list)]).unwrap()
}

fn square(x: f64, y: f64) -> [[f64; 3]; 4] {
    [[x, y, 0.0], [x + 1.0, y, 0.0], [x + 1.0, y + 1.0, 0.0], [x, y + 1.0, 0.0]]
}

fn plain(first: &Boundary, second: &Boundary) -> Result<Joined, JoinCause> {
    join(first, second, &JoinOptions::default()).map_err(|error| error.cause)
}

fn together(parts: &[Boundary]) -> Result<Joined, JoinCause> {
    let parts: Vec<&Boundary> = parts.iter().collect();
    join_all(&parts, &JoinOptions::default()).map_err(|error| error.cause)
}

fn places(boundary: &Boundary) -> Vec<[f64; 3]> {
    boundary.positions().iter().map(|p| [p.x, p.y, p.z]).collect()
}

fn turned_to(list: &[[f64; 3]], first: [f64; 3]) -> Vec<[f64; 3]> {
    let mut list = list.to_vec();
    let place = list.iter().position(|p| *p == first).unwrap();
    list.rotate_left(place);
    list
}

/// The sum of the area vectors of all loops, mm².
fn area_vector(boundary: &Boundary) -> Vec3 {
    let at = |i: usize| boundary.samples()[i].position.to_vec();
    (0..boundary.len()).map(|i| at(i).cross(at(boundary.next(i))) * 0.5).sum()
}

#[test]
fn the_formula_for_one_shared_sample() {
    // b1_3 = b2_1 = (1, 1): … b1_2, b2_2, b2_3, b2_4, b1_4, b1_1.
    let joined = plain(&polygon(&square(0.0, 0.0)), &polygon(&square(1.0, 1.0))).unwrap();
    let wanted: [[f64; 3]; 6] =
        [[0., 0., 0.], [1., 0., 0.], [2., 1., 0.], [2., 2., 0.], [1., 2., 0.], [0., 1., 0.]];
    assert_eq!(places(&joined.boundary), wanted);
    let joints: Vec<usize> = joined.joints.iter().map(|joint| joint.sample.get()).collect();
    assert_eq!(joints, [1, 4]);
    // The edges of the neck are straight.
    let neck = Vec3::new(1.0, 1.0, 0.0) / 2f64.sqrt();
    assert!((joined.boundary.samples()[1].tangent_out - neck).length() < 1e-15);
    assert!((joined.boundary.samples()[2].tangent_in - neck).length() < 1e-15);
    assert_eq!(joined.boundary.samples()[2].tangent_out, Vec3::Y);
}

#[test]
fn a_shared_run_keeps_its_ends_and_loses_its_interior() {
    // An L and what fills it: they share (2,1) – (1,1) – (1,2).
    let ell = polygon(&[
        [0., 0., 0.],
        [2., 0., 0.],
        [2., 1., 0.],
        [1., 1., 0.],
        [1., 2., 0.],
        [0., 2., 0.],
    ]);
    let filling = polygon(&square(1.0, 1.0));
    let joined = plain(&ell, &filling).unwrap();
    let wanted: [[f64; 3]; 6] =
        [[0., 0., 0.], [2., 0., 0.], [2., 1., 0.], [2., 2., 0.], [1., 2., 0.], [0., 2., 0.]];
    assert_eq!(places(&joined.boundary), wanted);
    assert_eq!(joined.turned, [false, false]);
    let joints: Vec<usize> = joined.joints.iter().map(|joint| joint.sample.get()).collect();
    assert_eq!(joints, [2, 4]);
    // The edges run straight on, so that no corner is left.
    assert!(!joined.boundary.samples()[2].is_corner());
    assert_eq!(joined.joints[0].turn, 0.0);
    // The other way about the loop begins on the other, and is the same.
    let other = plain(&filling, &ell).unwrap();
    assert_eq!(turned_to(&places(&other.boundary), [0.; 3]), wanted);
}

#[test]
fn what_faces_the_other_way_is_turned_round() {
    let mut back = square(1.0, 0.0);
    back.reverse();
    let joined = plain(&polygon(&square(0.0, 0.0)), &polygon(&back)).unwrap();
    assert_eq!(joined.turned, [false, true]);
    assert!((area_vector(&joined.boundary) - Vec3::Z * 2.0).length() < 1e-15);
    let right = joined.boundary.samples().iter().find(|s| s.position.x == 2.0).unwrap();
    assert_eq!(right.tangent_out, Vec3::Y);
}

/// Whether joints of two random parts can be made smooth; then as many samples are left, with unit
/// tangents, and outside of the windows they are what they were.
fn stays_sound(parts: &[Boundary; 2], plain: &Joined, random: &mut Random) -> bool {
    let smooth = if random.unit() < 0.5 { Continuity::G1 } else { Continuity::G2 };
    let within = Within::Share(random.between(0.001, 0.5));
    let options = JoinOptions { smooth, within, ..JoinOptions::default() };
    let joined = match join(&parts[0], &parts[1], &options) {
        Ok(joined) => joined,
        // The curve may run into the rest of the loop, or have no room.
        Err(error) => {
            assert!(matches!(error.cause, JoinCause::NoRoom | JoinCause::Boundary(_)), "{error}");
            return false;
        }
    };
    let (m, b) = (plain.boundary.len(), &joined.boundary);
    assert_eq!(b.len(), m);
    assert!(joined.deviation_mm() < b.size());
    let mut inside = vec![false; m];
    for joint in &joined.joints {
        let Some([from, to]) = joint.window.map(|w| w.map(|s| s.get())) else { continue };
        let to = if to <= from { to + m } else { to };
        (from + 1..to).for_each(|i| inside[i % m] = true);
    }
    for (i, sample) in b.samples().iter().enumerate() {
        for tangent in [sample.tangent_in, sample.tangent_out] {
            assert!((tangent.length() - 1.0).abs() < 1e-12);
        }
        assert!(!inside[i] || !sample.is_corner());
        assert!(inside[i] || *sample == plain.boundary.samples()[i]);
    }
    true
}

#[test]
fn random_polygons_cut_along_a_chord_join_again() {
    let mut random = Random::new(7);
    let (mut tried, mut made_smooth) = (0, 0);
    for _ in 0..400 {
        let m = 4 + random.below(30);
        let Some(whole) = star(&mut random, m, 0.5) else { continue };
        let i = random.below(m);
        let apart = 2 + random.below(m - 3);
        let j = (i + apart) % m;
        // A chord over the middle of the star, with samples on it or none.
        let inner: Vec<Point3> = (0..random.below(4))
            .map(|n| Point3::new(random.unit(), random.unit(), f64::from(n as u32)))
            .collect();
        let at = |k: usize| whole.samples()[k % m].position;
        let half = |from: usize, steps: usize, chord: Vec<Point3>| {
            let mut list: Vec<Point3> = (from..=from + steps).map(at).collect();
            list.extend(chord);
            let points: Vec<CurvePoint> = list.into_iter().map(CurvePoint::corner).collect();
            Boundary::new(vec![samples_from_points(&points)]).ok()
        };
        let back: Vec<Point3> = inner.iter().rev().copied().collect();
        let (Some(first), Some(second)) = (half(i, apart, back), half(j, m - apart, inner)) else {
            continue;
        };
        tried += 1;
        let mut parts = [first, second];
        if random.unit() < 0.5 {
            parts.swap(0, 1);
        }
        let joined = plain(&parts[0], &parts[1]).unwrap();
        let wanted = places(&whole);
        assert_eq!(turned_to(&places(&joined.boundary), wanted[0]), wanted);
        let areas = area_vector(&parts[0]) + area_vector(&parts[1]);
        let off = (area_vector(&joined.boundary) - areas).length();
        assert!(off < 1e-9 * whole.size() * whole.size(), "{off}");
        assert_eq!(joined.deviation_mm(), 0.0);
        made_smooth += usize::from(stays_sound(&parts, &joined, &mut random));
    }
    assert!(tried > 150 && made_smooth > 100, "{tried} {made_smooth}");
}

#[test]
fn random_sheets_of_squares_keep_area_and_turning() {
    let mut random = Random::new(11);
    let mut with_holes = 0;
    for _ in 0..200 {
        let picked: Vec<[usize; 2]> =
            (0..25).map(|n| [n % 5, n / 5]).filter(|_| random.unit() < 0.75).collect();
        let squares: Vec<Boundary> =
            picked.iter().map(|[x, y]| polygon(&square(*x as f64, *y as f64))).collect();
        // Sheets that fall apart are refused, and so are some that hang together by corners alone.
        let Ok(joined) = together(&squares) else { continue };
        let b = &joined.boundary;
        // A neck is wider than the corner that it takes the place of.
        let neck = b.samples().iter().any(|s| s.tangent_in.x * s.tangent_in.y != 0.0);
        if !neck {
            assert!((area_vector(b) - Vec3::Z * picked.len() as f64).length() < 1e-12);
        }
        for (n, range) in b.loops().iter().enumerate() {
            let turning: f64 = range
                .clone()
                .map(|i| {
                    let Sample { tangent_in, tangent_out, .. } = b.samples()[i];
                    let angle = angle_between(tangent_in, tangent_out);
                    if tangent_in.cross(tangent_out).z < 0.0 { -angle } else { angle }
                })
                .sum();
            let wanted = if n == 0 { 360.0 } else { -360.0 };
            assert!((turning - from_deg(wanted)).abs() < 1e-9, "{n}: {turning}");
        }
        with_holes += usize::from(b.holes() > 0);
    }
    assert!(with_holes > 20, "{with_holes}");
}

#[test]
fn a_ring_gets_a_hole_and_a_filling_closes_it() {
    let around = [[0, 0], [1, 0], [2, 0], [2, 1], [2, 2], [1, 2], [0, 2], [0, 1]];
    let mut squares: Vec<Boundary> =
        around.iter().map(|[x, y]| polygon(&square(f64::from(*x), f64::from(*y)))).collect();
    let ring = together(&squares).unwrap().boundary;
    assert_eq!((ring.holes(), ring.loops()[0].len(), ring.loops()[1].len()), (1, 12, 4));
    // A smaller ring in the hole of a larger one, which runs either way.
    let hole = square(1.0, 1.0).to_vec();
    let outer = [[0., 0., 0.], [3., 0., 0.], [3., 3., 0.], [0., 3., 0.]];
    for reversed in [false, true] {
        let mut hole = hole.clone();
        if reversed {
            hole.reverse();
        }
        let frame = Boundary::new(vec![corners(&outer), corners(&hole)]).unwrap();
        let filled = plain(&frame, &polygon(&square(1.0, 1.0))).unwrap();
        assert_eq!((filled.boundary.holes(), filled.turned), (0, vec![false, false]));
        assert_eq!(places(&filled.boundary), outer);
        let filled = plain(&polygon(&square(1.0, 1.0)), &frame).unwrap();
        assert_eq!(places(&filled.boundary), outer);
        // A hole that nothing touches is carried along.
        let beside = polygon(&[[3., 0., 0.], [5., 0., 0.], [5., 3., 0.], [3., 3., 0.]]);
        let wide = plain(&frame, &beside).unwrap().boundary;
        assert_eq!((wide.holes(), wide.loops()[0].len()), (1, 6));
        assert_eq!(&places(&wide)[6..], hole);
    }
    squares.push(polygon(&square(1.0, 1.0)));
    assert_eq!(together(&squares).unwrap().boundary.holes(), 0);
}

#[test]
fn the_order_of_parts_does_not_matter() {
    // The two on the diagonal meet at one sample, which goes only if nothing else joins them.
    let of = |list: &[[f64; 2]]| {
        let squares: Vec<Boundary> = list.iter().map(|[x, y]| polygon(&square(*x, *y))).collect();
        turned_to(&places(&together(&squares).unwrap().boundary), [0.; 3])
    };
    let wanted = of(&[[0., 0.], [1., 0.], [1., 1.], [0., 1.]]);
    assert_eq!(wanted.len(), 8);
    assert_eq!(of(&[[0., 0.], [1., 1.], [0., 1.], [1., 0.]]), wanted);
    assert_eq!(of(&[[1., 1.], [0., 0.], [1., 0.], [0., 1.]]), wanted);
}

#[test]
fn what_is_no_sheet_is_refused() {
    let here = polygon(&square(0.0, 0.0));
    assert_eq!(plain(&here, &polygon(&square(5.0, 0.0))).unwrap_err(), JoinCause::Apart);
    assert_eq!(plain(&here, &here).unwrap_err(), JoinCause::Closed);
    assert_eq!(together(std::slice::from_ref(&here)).unwrap_err(), JoinCause::TooFew);
    // Two parts share a side; only the finer has a sample on it.
    let finer = polygon(&[[1., 0., 0.], [2., 0., 0.], [2., 1., 0.], [1., 1., 0.], [1., 0.5, 0.]]);
    assert_eq!(plain(&here, &finer).unwrap_err(), JoinCause::LooseSamples { count: 2 });
    let bad = JoinOptions { within: Within::Mm(-1.0), ..JoinOptions::default() };
    assert_eq!(join(&here, &finer, &bad).unwrap_err().cause, JoinCause::Within);
    // A third sheet on the seam of a tube that is cut open.
    let mut tube: Vec<[f64; 3]> = square(0.0, 0.0).to_vec();
    tube.push([0.0; 3]);
    tube.extend([4, 3, 2, 1, 0].map(|i: usize| {
        let [x, y, _] = square(0.0, 0.0)[i % 4];
        [x, y, 1.0]
    }));
    let fin = polygon(&[[0., 0., 0.], [0., 0., 1.], [-1., -1., 1.], [-1., -1., 0.]]);
    assert!(matches!(
        plain(&polygon(&tube), &fin).unwrap_err(),
        JoinCause::ManySheets | JoinCause::OneSided
    ));
}

/// Four-sided pieces of a band around a circle, turned about it by `half_turns` half turns in all.
fn band(pieces: usize, half_turns: f64) -> Vec<Boundary> {
    let at = |n: usize, across: f64| {
        let share = n as f64 / pieces as f64;
        let (a, twist) = (from_deg(360.0 * share), from_deg(180.0 * half_turns * share));
        let r = 10.0 + across * cos(twist);
        [r * cos(a), r * sin(a), across * sin(twist)]
    };
    // The last one ends on the very samples that the first begins with.
    let end = |n: usize, across: f64| match (n == pieces, half_turns % 2.0 == 1.0) {
        (false, _) => at(n, across),
        (true, false) => at(0, across),
        (true, true) => at(0, -across),
    };
    (0..pieces)
        .map(|n| polygon(&[at(n, 1.0), end(n + 1, 1.0), end(n + 1, -1.0), at(n, -1.0)]))
        .collect()
}

#[test]
fn a_band_closes_and_a_moebius_strip_does_not() {
    let closed = together(&band(12, 0.0)).unwrap().boundary;
    assert_eq!((closed.holes(), closed.len()), (1, 24));
    assert_eq!(together(&band(12, 2.0)).unwrap().boundary.holes(), 1);
    assert_eq!(together(&band(12, 1.0)).unwrap_err(), JoinCause::OneSided);
}

#[test]
fn a_handle_is_refused() {
    // Two bands over a square, from side to opposite side: a torus with a hole.
    let base = polygon(&square(0.0, 0.0));
    let arch = |a: [[f64; 3]; 2], b: [[f64; 3]; 2], z: f64| {
        // From a side of the square, walked back, over a height to the opposite side.
        let up = |p: [f64; 3]| [2.0 * p[0] - 0.5, 2.0 * p[1] - 0.5, z];
        polygon(&[a[1], a[0], up(a[0]), up(b[1]), b[1], b[0], up(b[0]), up(a[1])])
    };
    let s = square(0.0, 0.0);
    let first = arch([s[0], s[1]], [s[2], s[3]], 1.0);
    let ring = plain(&base, &first).unwrap().boundary;
    assert_eq!(ring.holes(), 1);
    let second = arch([s[1], s[2]], [s[3], s[0]], 2.0);
    assert_eq!(together(&[base, first, second]).unwrap_err(), JoinCause::Handle);
}

/// A blob on a developable surface cut in two along a wavy line, with tangents of its own.
#[test]
fn two_parts_of_one_cylinder_cost_what_the_whole_costs() {
    for blob in blobs() {
        let (whole, parameters) = blob.boundary(120);
        let m = whole.len();
        let (i, j) = (17, 71);
        let inner: Vec<Point3> = (1..20)
            .map(|n| {
                let share = f64::from(n) / 20.0;
                let mix = |k: usize| parameters[i][k] * (1.0 - share) + parameters[j][k] * share;
                let wave = 0.05 * sin(from_deg(360.0 * share));
                blob.surface.space(mix(0) + wave, mix(1))
            })
            .collect();
        let part = |from: usize, to: usize, chord: Vec<Point3>| {
            let mut samples: Vec<Sample> = (from..=to).map(|k| whole.samples()[k % m]).collect();
            let (start, end) = (samples[0], samples[samples.len() - 1]);
            let ends = [end.position, start.position];
            let line: Vec<CurvePoint> = [ends[0]]
                .into_iter()
                .chain(chord)
                .chain([ends[1]])
                .map(CurvePoint::smooth)
                .collect();
            let n = line.len();
            let seam = samples_from_points(&line);
            let last = samples.len() - 1;
            samples[last].tangent_out = (line[1].at - line[0].at) / line[1].at.distance(line[0].at);
            let way = line[n - 1].at - line[n - 2].at;
            samples[0].tangent_in = way / way.length();
            samples.extend(&seam[1..n - 1]);
            Boundary::new(vec![samples]).unwrap()
        };
        let back: Vec<Point3> = inner.iter().rev().copied().collect();
        let joined = plain(&part(i, j, back), &part(j, i + m, inner)).unwrap();
        let mut samples = whole.samples().to_vec();
        samples.rotate_left(i);
        assert_eq!(joined.boundary.samples(), samples, "{}", blob.name);
        for fold in [0.0, 1.0] {
            let price = PriceOptions { fold, ..PriceOptions::default() };
            let options = TriangulateOptions { price, ..TriangulateOptions::default() };
            let cost = |b: &Boundary| triangulate(b, None, &options, &mut Unwatched).unwrap().price;
            // The loop begins elsewhere, which changes nothing.
            assert_eq!(cost(&joined.boundary), cost(&whole), "{}", blob.name);
        }
    }
}

/// Two half discs with a notch where they meet: arcs of radius 100 about (±40, 0).
fn notched(m: usize) -> [Boundary; 2] {
    let half = |side: f64| {
        // From the lower end of the seam round to its upper end, counter-clockwise on the right.
        let open = from_deg(110.0);
        let mut samples: Vec<Sample> = (0..=m)
            .map(|n| {
                let a = -open + 2.0 * open * n as f64 / m as f64;
                let z = 20.0 * cos(2.0 * a);
                let slope = -40.0 * sin(2.0 * a);
                let position = Point3::new(40.0 + 100.0 * cos(a), 100.0 * sin(a), z);
                let way = Vec3::new(-100.0 * sin(a), 100.0 * cos(a), slope);
                let tangent = way / way.length();
                Sample { position, tangent_in: tangent, tangent_out: tangent }
            })
            .collect();
        let seam = 8;
        let (low, high) = (samples[0].position, samples[m].position);
        let along = (low - high) / low.distance(high);
        samples[0].tangent_in = along;
        samples[m].tangent_out = along;
        for n in 1..seam {
            let position = high.lerp(low, f64::from(n) / f64::from(seam));
            samples.push(Sample { position, tangent_in: along, tangent_out: along });
        }
        // The other half is this one turned by a half turn about z, its seam moved onto this one.
        let turn = |v: Vec3| Vec3::new(side * v.x, side * v.y, v.z);
        for s in &mut samples {
            let shift = Vec3::new(low.x, 0.0, 0.0);
            s.position = Point3::from_vec(turn(s.position.to_vec() - shift));
            (s.tangent_in, s.tangent_out) = (turn(s.tangent_in), turn(s.tangent_out));
        }
        Boundary::new(vec![samples]).unwrap()
    };
    [half(1.0), half(-1.0)]
}

/// The largest jump of the tangent, radians, and of the curvature, 1/mm, from sample to sample
/// around the first joint.
fn jumps(joined: &Joined) -> (f64, f64) {
    let samples = joined.boundary.samples();
    let m = samples.len();
    let at = |i: usize| samples[i % m];
    let [from, to] = joined.joints[0].window.unwrap().map(|s| s.get());
    let to = if to < from { to + m } else { to };
    let curvature = |i: usize| {
        let (a, b) = (at(i), at(i + 1));
        (b.tangent_in - a.tangent_out) / a.position.distance(b.position)
    };
    let (mut tangent, mut bend) = (0.0f64, 0.0f64);
    for i in from + m - 2..to + m + 2 {
        tangent = tangent.max(angle_between(at(i).tangent_out, at(i + 1).tangent_in));
        tangent = tangent.max(angle_between(at(i).tangent_in, at(i).tangent_out));
        bend = bend.max((curvature(i + 1) - curvature(i)).length());
    }
    (tangent, bend)
}

#[test]
fn joints_become_smooth() {
    let joined = |m: usize, smooth: Continuity| {
        let [a, b] = notched(m);
        let options = JoinOptions { smooth, within: Within::Mm(60.0), ..JoinOptions::default() };
        join(&a, &b, &options).unwrap()
    };
    let corner = joined(100, Continuity::G0);
    assert_eq!(corner.joints.len(), 2);
    assert!(corner.joints.iter().all(|j| j.turn > from_deg(30.0) && j.window.is_none()));
    assert_eq!(corner.deviation_mm(), 0.0);
    let count = corner.boundary.len();
    for smooth in [Continuity::G1, Continuity::G2] {
        let coarse = joined(100, smooth);
        assert_eq!(coarse.boundary.len(), count);
        let (tangent, bend) = jumps(&coarse);
        let (fine_tangent, fine_bend) = jumps(&joined(400, smooth));
        assert!(fine_tangent < 0.3 * tangent, "{smooth:?}: {tangent} {fine_tangent}");
        if smooth == Continuity::G2 {
            assert!(fine_bend < 0.35 * bend, "{bend} {fine_bend}");
        } else {
            // One tangent, but two curvatures.
            assert!(fine_bend > 0.7 * bend, "{bend} {fine_bend}");
        }
        // The corner is cut, by much less than the window is wide.
        let deviation = coarse.deviation_mm();
        assert!((1.0..30.0).contains(&deviation), "{deviation}");
        // What lies outside of the windows stays.
        let windows = coarse.joints.iter().map(|j| j.window.unwrap().map(|s| s.get()));
        let mut moved = vec![false; count];
        for [from, to] in windows {
            let to = if to < from { to + count } else { to };
            (from + 1..to).for_each(|i| moved[i % count] = true);
        }
        for i in (0..count).filter(|i| !moved[*i]) {
            assert_eq!(coarse.boundary.samples()[i], corner.boundary.samples()[i]);
        }
        assert!(moved.iter().filter(|m| **m).count() > 20);
        assert!(coarse.boundary.samples().iter().all(|s| !s.is_corner()));
    }
}

#[test]
fn a_neck_becomes_smooth_and_crowded_joints_are_refused() {
    let smooth = JoinOptions {
        smooth: Continuity::G1,
        within: Within::Share(0.1),
        ..JoinOptions::default()
    };
    // Two circles that touch at one sample.
    let circle = |x: f64, first: usize| {
        let points: Vec<CurvePoint> = (0..60)
            .map(|n| {
                let a = from_deg(6.0 * (n + first) as f64);
                CurvePoint::smooth(Point3::new(x + 50.0 * cos(a), 50.0 * sin(a), 0.0))
            })
            .collect();
        Boundary::new(vec![samples_from_points(&points)]).unwrap()
    };
    let joined = join(&circle(0.0, 0), &circle(100.0, 30), &smooth).unwrap();
    assert_eq!((joined.boundary.len(), joined.joints.len()), (118, 2));
    assert!(joined.boundary.samples().iter().all(|s| !s.is_corner()));
    // Squares of nothing but corners leave no sample between the joints of a short side.
    let strip = [square(0.0, 0.0), square(1.0, 0.0), square(2.0, 0.0)].map(|s| polygon(&s));
    let parts: Vec<&Boundary> = strip.iter().collect();
    // They run straight on, which has one tangent, but nothing is said of its curvature.
    assert!(join_all(&parts, &smooth).is_ok());
    let smoother = JoinOptions { smooth: Continuity::G2, ..smooth };
    assert_eq!(join_all(&parts, &smoother).unwrap_err().cause, JoinCause::NoRoom);
}
