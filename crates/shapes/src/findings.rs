//! A finding of each kind, with typical numbers and places.

use sheetwright::bend::Mitred;
use sheetwright::check::{
    Bend, BorderSide, CutWay, Division, Finding, FindingKind as Kind, Hindrance, LinePlace,
    MeshSetting, Movement, Place, PointReach, SeamCause, SeamPlace, TooTight, Verdict,
};
use sheetwright::design::{Axis, DivideJoint, ReadNote, Unused};
use sheetwright::divide::DivideFault;
use sheetwright::elastic::Basis;
use sheetwright::fair::Ended;
use sheetwright::index::SampleIndex;
use sheetwright::mark::MarkNote;
use sheetwright::math::{Point2, Point3, from_deg};
use sheetwright::mesh::{Damage, Skin};
use sheetwright::rung::Rung;
use sheetwright::trim::TrimNote;

/// A finding of each kind, and two of kinds with two sentences.
pub fn one_of_each() -> Vec<Finding> {
    let mut all = of_surfaces();
    all.extend(of_meshes());
    all.extend(of_boundaries());
    all.extend(of_files());
    all
}

fn whole(kinds: impl IntoIterator<Item = Kind>) -> impl Iterator<Item = Finding> {
    kinds.into_iter().map(Finding::of_whole)
}

fn sheet() -> Option<String> {
    Some("mild steel, 1 mm".to_owned())
}

fn samples<const N: usize>(numbers: [usize; N]) -> [SampleIndex; N] {
    numbers.map(SampleIndex::new)
}

fn rungs(numbers: &[usize]) -> Place {
    Place::Rungs { numbers: numbers.to_vec() }
}

fn of_surfaces() -> Vec<Finding> {
    let sharpest = from_deg(31.0);
    let too_large = |basis| Kind::StrainTooLarge {
        strain: 2.1e-3,
        limit: 1.2e-3,
        sheet: sheet(),
        thickest_mm: Some(0.634),
        basis,
    };
    let force = |outer_fibre, moment_n, is_formed| Kind::NeedsForce {
        strain: 5.1e-4,
        limit: 1.2e-3,
        outer_fibre,
        sheet: sheet(),
        moment_n,
        is_formed,
        basis: Basis::Computed,
    };
    let line = |lines: usize| {
        let point = |n: usize| Point3::new(n as f64, -3.5, 0.3);
        let line = |n: usize| LinePlace {
            at: (3 * n..3 * n + 3).map(point).collect(),
            on_part: (0..2).map(|n| (point(n), Point2::new(n as f64, 0.5))).collect(),
        };
        Place::Lines { lines: (0..lines).map(line).collect() }
    };
    let worst = || Place::Points { at: vec![Point3::new(12.0, -3.5, 0.3)] };
    let (stiff, too_tight) = (
        Some("plywood, 3 mm".to_owned()),
        TooTight { sheet: "plywood, 3 mm".to_owned(), limit_mm: 290.0, needed_mm: 12.5 },
    );
    let reach = Some(PointReach { reach_mm: 4.25, limit_mm: 1.0, folds: true });
    let corners = |sides: [usize; 2]| BorderSide { corners: sides, samples: samples(sides) };
    let seam = |number: usize| SeamPlace { number, ends: Some(samples([number, number + 7])) };
    let apexes = |count: usize| Place::Samples { numbers: samples([2, 4, 8])[..count].to_vec() };
    let mut all = vec![
        Finding::new(too_large(Basis::Computed), worst()),
        Finding::new(too_large(Basis::NoRest), Place::Whole),
        Finding::new(too_large(Basis::TooTight), Place::Whole),
        Finding::new(force(Some([2e-3, 0.5]), Some(83.0), false), worst()),
        Finding::new(force(Some([4e-3, 5e-3]), None, false), worst()),
        Finding::new(force(Some([4e-3, 5e-3]), Some(14.2), true), worst()),
        Finding::of_whole(Kind::Roll {
            radius_mm: 161.0,
            from_mm: 417.0,
            sheet: "mild steel, 1 mm".to_owned(),
        }),
        Finding::new(
            Kind::CantTell {
                strain: [9.4e-4, 1.3e-3],
                limit: 1.2e-3,
                sheet: None,
                basis: Basis::Computed,
            },
            worst(),
        ),
        Finding::new(
            Kind::CantTell {
                strain: [9e-4, 4.4e-3],
                limit: 1.2e-3,
                sheet: sheet(),
                basis: Basis::NoNet,
            },
            Place::Whole,
        ),
        Finding::new(
            Kind::CantTell {
                strain: [8e-4, 1.8e-3],
                limit: 1.2e-3,
                sheet: sheet(),
                basis: Basis::TooTight,
            },
            Place::Whole,
        ),
        Finding::new(
            Kind::RadiusUnsure {
                least_mm: 298.7,
                limit_mm: 290.0,
                is_coarse: true,
                sheet: "plywood".to_owned(),
            },
            rungs(&[3, 4]),
        ),
        Finding::new(
            Kind::RadiusUnsure {
                least_mm: 287.4,
                limit_mm: 290.0,
                is_coarse: false,
                sheet: "plywood".to_owned(),
            },
            rungs(&[5]),
        ),
        Finding::new(Kind::FoldsNotNeeded { count: 2, sharpest }, rungs(&[3, 4])),
        Finding::new(
            Kind::RadiusTooSmall {
                least_mm: 0.4,
                limit_mm: 1.0,
                sheet: "card".to_owned(),
                thickest_mm: Some(0.12),
            },
            rungs(&[3, 5]),
        ),
        Finding::new(
            Kind::SheetTooThick { drawn_mm: 1.25, inside_mm: 2.0, thickness_mm: 2.0 },
            rungs(&[3, 5]),
        ),
        Finding::new(Kind::Points { count: 1, turn: sharpest, reach, too_tight: None }, apexes(1)),
        Finding::new(
            Kind::Points { count: 3, turn: sharpest, reach, too_tight: Some(too_tight) },
            apexes(3),
        ),
        Finding::new(
            Kind::SelfCrossing,
            Place::Triangles { corners: vec![samples([0, 1, 9]), samples([4, 5, 6])] },
        ),
        Finding::new(Kind::Overlap, Place::Sides { sides: vec![corners([2, 3]), corners([9, 0])] }),
        Finding::new(Kind::RungWithoutPlane { count: 1 }, rungs(&[17])),
        Finding::new(Kind::Folds { count: 1, sharpest, stiff: stiff.clone() }, rungs(&[8])),
        Finding::new(Kind::Folds { count: 2, sharpest, stiff: None }, rungs(&[8, 10])),
        Finding::new(Kind::BendLines { count: 1, sharpest }, rungs(&[8])),
        Finding::new(Kind::BendLines { count: 2, sharpest }, rungs(&[8, 10])),
        Finding::new(
            Kind::BendsDivided {
                parts: 2,
                way: CutWay::Across,
                strain: 2.1e-4,
                verdict: Verdict::BendsAndFolds,
            },
            line(1),
        ),
        Finding::new(
            Kind::BendsDivided {
                parts: 3,
                way: CutWay::Lengthwise,
                strain: 2.1e-4,
                verdict: Verdict::Roll,
            },
            line(2),
        ),
        Finding::new(Kind::WindowGap { widest_mm: 0.25 }, Place::Seams { seams: vec![seam(1)] }),
        Finding::new(
            Kind::Seams { count: 8, length_mm: 120.0, why: SeamCause::NotFlat },
            Place::Seams { seams: (0..8).map(seam).collect() },
        ),
    ];
    all.extend(whole([
        Kind::BetterWithoutPlane { with: 4.0, without: 1.0 },
        Kind::TwoSurfaces { apart_mm: 12.5, is_one_pattern: false, other: Verdict::BendsWithForce },
        Kind::TwoSurfaces { apart_mm: 2.5, is_one_pattern: true, other: Verdict::Bends },
        Kind::DividedInVain { most: 4 },
        Kind::NoOtherSurface,
        Kind::StrainNotReached { wanted: 0.8, reached: 1.25 },
        Kind::NotProven { gap: Some(0.0125), cut_short: true },
        Kind::NotProven { gap: None, cut_short: false },
        Kind::LengthError { largest: 0.00004, closes_holes: true },
        Kind::LengthError { largest: 0.002, closes_holes: false },
        Kind::Creases { count: 4, sharpest, stiff },
    ]));
    all
}

fn of_meshes() -> Vec<Finding> {
    let (a, b) = (Point3::new(-0.01, 2.0, 3.25), Point3::new(7.0, 8.0, 9.0));
    let at = Place::Points { at: vec![a] };
    let divide = |cut, has_darts, has_creases| Kind::Divide { cut, has_darts, has_creases };
    let mesh_seams = |count: usize| Place::Seams {
        seams: (0..count).map(|number| SeamPlace { number, ends: None }).collect(),
    };
    let mut all = vec![
        Finding::new(divide(Some([a, b]), false, true), at.clone()),
        Finding::new(divide(None, true, false), Place::Whole),
        Finding::new(Kind::Stretch { stretch: 2.5, shrink: 0.047 }, at.clone()),
        Finding::new(Kind::Stretch { stretch: f64::INFINITY, shrink: 0.0 }, at.clone()),
        Finding::new(Kind::Overlap, Place::Points { at: vec![a, b] }),
        Finding::new(
            Kind::Seams { count: 1, length_mm: 55.0, why: SeamCause::Closed },
            mesh_seams(1),
        ),
        Finding::new(
            Kind::Seams { count: 2, length_mm: 55.0, why: SeamCause::Chosen },
            mesh_seams(2),
        ),
        Finding::new(
            Kind::Seams { count: 3, length_mm: 55.0, why: SeamCause::Darts },
            mesh_seams(3),
        ),
        Finding::new(
            Kind::Seams { count: 40, length_mm: 900.0, why: SeamCause::Facets },
            mesh_seams(40),
        ),
        Finding::new(Kind::PartsLeftOut { count: 1 }, at.clone()),
        Finding::new(Kind::PartsLeftOut { count: 2 }, at.clone()),
    ];
    let damages = [
        Damage::Filler,
        Damage::Doubled,
        Damage::Seam,
        Damage::OnSide,
        Damage::Branch,
        Damage::Turned,
        Damage::InsideOut,
    ];
    let healed =
        damages.into_iter().flat_map(|damage| [1, 12].map(|count| Kind::Healed { damage, count }));
    all.extend(healed.map(|kind| Finding::new(kind, at.clone())));
    all.extend(whole([
        Kind::Creases { count: 4, sharpest: from_deg(31.0), stiff: None },
        Kind::FoldedFacets { mountains: 41, valleys: 1, sharpest: from_deg(84.0), stiff: None },
        Kind::FoldedFacets { mountains: 1, valleys: 0, sharpest: from_deg(84.0), stiff: sheet() },
        Kind::FacetsMeant { facets: 450, turn: from_deg(22.0), overlaps: false },
        Kind::FacetsMeant { facets: 24, turn: from_deg(90.0), overlaps: true },
        Kind::FacetsFew { facets: 450 },
        Kind::BorderNotTrue { largest: 0.0001 },
        Kind::Flipped { count: 1 },
        Kind::TrianglesLeftOut { count: 1 },
        Kind::PointContacts { count: 2 },
        Kind::TwoSkins { count: 1, bodies: 1, thickness_mm: 3.0, laid: None },
        Kind::TwoSkins { count: 1, bodies: 2, thickness_mm: 3.0, laid: Some(Skin::Outer) },
        Kind::TwoSkins { count: 2, bodies: 2, thickness_mm: 3.0, laid: Some(Skin::Inner) },
        Kind::NotTwoSkins,
        Kind::NoEffect { settings: vec![MeshSetting::Darts], is_net: true },
        Kind::NoEffect {
            settings: vec![MeshSetting::Aim, MeshSetting::SplitCreases, MeshSetting::Darts],
            is_net: true,
        },
        Kind::NoEffect { settings: vec![MeshSetting::PiecesWithin], is_net: false },
        piece_too_large(true, false),
        piece_too_large(true, true),
        piece_too_large(false, true),
        piece_too_large(false, false),
    ]));
    all
}

fn piece_too_large(is_facet: bool, is_trimmed: bool) -> Kind {
    let (size_mm, within_mm) = ([300.0, 186.25], [277.0, 190.0]);
    Kind::PieceTooLarge { size_mm, within_mm, is_facet, is_trimmed }
}

fn of_boundaries() -> Vec<Finding> {
    let (curve, turn) = ("rim".to_owned(), from_deg(88.0));
    let movement = Movement {
        curves: vec!["rim".to_owned(), "chine".to_owned()],
        moved_max_mm: 1.5,
        moved_total_mm: 40.0,
        size_mm: 500.0,
        warp: [from_deg(9.0), from_deg(5.0)],
        twist: [0.3, 0.1],
    };
    let still = Movement { curves: Vec::new(), ..movement.clone() };
    let bends =
        [(3.0, 40.0), (2.0, 50.0)].map(|(deg, radius_mm)| Bend { warp: from_deg(deg), radius_mm });
    let flat = Bend { warp: 0.0, radius_mm: f64::INFINITY };
    let wanted = from_deg(4.0);
    let ended = Ended::Closest {
        wanted,
        before: from_deg(9.0),
        reached: from_deg(5.0),
        resisting: vec![(0, Rung::new(3, 9))],
    };
    let not_moved = |is_above, hindrance| Kind::NotMoved {
        movement: still.clone(),
        wanted: Some(wanted),
        is_above,
        hindrance,
    };
    let mut all = vec![
        Finding::new(
            Kind::RoundedCorner { curve: curve.clone(), turn },
            Place::CurvePoints { curve, numbers: vec![2, 5] },
        ),
        Finding::new(
            Kind::SplineBulge {
                curve: "keel".to_owned(),
                at: Point3::new(3400.0, 0.0, -12.0),
                by_mm: 12.0,
            },
            Place::CurvePoints { curve: "keel".to_owned(), numbers: vec![6, 7] },
        ),
        Finding::new(
            Kind::UnfairLine {
                curve: "sheer".to_owned(),
                at: Point3::new(1200.0, 640.0, 530.0),
                fair: Point3::new(1200.5, 640.2, 490.0),
            },
            Place::CurvePoints { curve: "sheer".to_owned(), numbers: vec![2] },
        ),
        Finding::new(
            Kind::JointsSmoothed { count: 2, deviation_mm: 0.2 },
            Place::Samples { numbers: samples([3, 9]).to_vec() },
        ),
        Finding::new(
            Kind::WarpNotReached { movement: movement.clone(), wanted, ended },
            rungs(&[3]),
        ),
    ];
    all.extend(whole([
        Kind::RanOn { bulges_mm: [Some(1.25), None], bends: Some(bends) },
        Kind::RanOn { bulges_mm: [Some(1.25), None], bends: Some([flat, bends[0]]) },
        Kind::RanOn { bulges_mm: [None; 2], bends: None },
        off_tolerance(false),
        off_tolerance(true),
        Kind::StayedStraight { cause: "the rails cross".to_owned() },
        Kind::TurnedRound { panels: vec!["b".to_owned(), "c".to_owned()], first: "a".to_owned() },
        Kind::Moved { movement, ended: Ended::Converged, hindrance: Some(Hindrance::Strain) },
        not_moved(false, None),
        not_moved(true, Some(Hindrance::Radius)),
        not_moved(false, Some(Hindrance::Other)),
    ]));
    all
}

fn of_files() -> Vec<Finding> {
    let edge = || "fox-1/J3".to_owned();
    let joint = |n: usize| [format!("fox-1/J{n}"), format!("fox-2/J{n}")];
    let seam = |n: usize| [format!("fox-1/S{n}"), format!("fox-1/S{n}")];
    let no_room = |joints| TrimNote::NoRoomForTabs { joints, covered: 0.2 };
    let all = (1..=9).map(seam).chain([joint(3)]).collect();
    let left_out = TrimNote::HolesLeftOut { edge: edge(), left_out: 2, of: 30 };
    let flange = |bent_mm| TrimNote::FlangeStretches { edge: edge(), flat_mm: 1000.0, bent_mm };
    let reduced =
        |sheets, is_full| Kind::PdfReduced { sheets, scale: 400.0, most: 20_000, is_full };
    let division = Division {
        pieces: 4,
        joints: 3,
        joint: DivideJoint::Scarf,
        lap_mm: Some(96.0),
        length_mm: 22_140.0,
        room_mm: [5980.0, 2380.0],
    };
    whole([
        Kind::Refold { error_mm: 0.5, limit_mm: 1e-4 },
        Kind::NotReadBack { cause: "the written pattern can't be read: no outline".to_owned() },
        Kind::QuadsOffBoundary { off_mm: 0.0123 },
        Kind::QuadsNotPlanar { uneven_mm: 0.5, off_mm: Some(12.0) },
        Kind::QuadsNotPlanar { uneven_mm: 0.5, off_mm: None },
        Kind::LinesClose { count: 1, nearest_mm: 0.0, least_mm: 4.0 },
        Kind::LinesClose { count: 23, nearest_mm: 3.25, least_mm: 4.0 },
        Kind::LinesLong { count: 1, longest_mm: 2613.0, most_mm: 2500.0 },
        Kind::LinesLong { count: 2, longest_mm: 2613.0, most_mm: 2500.0 },
        Kind::FlangeShort { count: 2, shortest_mm: 3.25, least_mm: 4.0 },
        Kind::FoldsMitred { count: 1, of: 5, why: Mitred::Meets },
        Kind::FoldsMitred { count: 2, of: 2, why: Mitred::NotFlat },
        Kind::FoldsMitred { count: 3, of: 5, why: Mitred::Narrow },
        Kind::FoldsMitred { count: 5, of: 5, why: Mitred::Untrue },
        reduced(2500, false),
        reduced(2500, true),
        reduced(30_000, false),
        Kind::TooLarge { size_mm: [22_140.0, 480.0], room_mm: [5980.0, 2380.0] },
        Kind::Divided { piece: 1, division },
        Kind::Divided { piece: 2, division },
        Kind::Divided {
            piece: 1,
            division: Division { joints: 1, joint: DivideJoint::Butt, lap_mm: None, ..division },
        },
        Kind::Strap { joint: "J2".to_owned(), width_mm: 144.0 },
        Kind::NoSheet { is_too_large: true },
        Kind::NoSheet { is_too_large: false },
        Kind::NotDivided { fault: DivideFault::NoThickness },
        Kind::Trimmed { note: no_room(vec![joint(3)]) },
        Kind::Trimmed { note: no_room(vec![seam(12)]) },
        Kind::Trimmed { note: no_room(all) },
        Kind::Trimmed { note: left_out },
        Kind::Trimmed { note: flange(1150.0) },
        Kind::Trimmed { note: flange(950.0) },
        Kind::Trimmed { note: TrimNote::Closes { of_net: 1, of_cut: 0 } },
        Kind::Trimmed { note: TrimNote::NotProved { outside_mm2: 0.25 } },
        Kind::Trimmed { note: TrimNote::Overlaps },
    ])
    .chain(of_marks())
    .chain(of_drawings())
    .collect()
}

fn of_drawings() -> impl Iterator<Item = Finding> {
    let at = Point3::new(12.0, -3.5, 0.0);
    let names = || vec!["path12".to_owned(), "path14".to_owned()];
    let pair = || ["rail-keel".to_owned(), "rail-chine".to_owned()];
    let not_used = |what, count, names, at| ReadNote::NotUsed { what, count, names, at };
    whole(
        [
            not_used(Unused::Open, 2, names(), Some(at)),
            not_used(Unused::Text, 1, Vec::new(), None),
            ReadNote::GapsClosed { count: 1, widest_mm: 0.0123, at },
            ReadNote::GapsClosed { count: 3, widest_mm: 0.5, at },
            ReadNote::TakenForRails { names: pair() },
            ReadNote::TakenForRing { names: pair() },
            ReadNote::Smoothed { names: names() },
            ReadNote::NoUnit { unit_mm: 1.0 },
        ]
        .map(|note| Kind::Read { note }),
    )
}

fn off_tolerance(is_usual: bool) -> Kind {
    Kind::OffTolerance {
        distance_mm: 0.00034,
        shorter_mm: 0.00071,
        tolerance_mm: 1e-4,
        samples: 2000,
        is_rails: true,
        is_usual,
        is_most: true,
    }
}

fn of_marks() -> impl Iterator<Item = Finding> {
    let missed = MarkNote::StationMissed {
        name: "frame 7".to_owned(),
        axis: Axis::X,
        at_mm: 5000.0,
        reach_mm: [90.0, 3311.0],
    };
    let far = MarkNote::PlaceFar {
        what: "drill".to_owned(),
        at: Point3::new(100.0, 250.0, 30.0),
        off_mm: 12.5,
        within_mm: 1.0,
    };
    let over = |radius_mm, what: &str| MarkNote::OverTheEdge {
        what: what.to_owned(),
        at: Point2::new(3.0, 40.0),
        radius_mm,
    };
    let square = MarkNote::SquareToPart { what: "face".to_owned() };
    let curved = MarkNote::CurvedFold { edge: "front/hem".to_owned(), off_mm: 7.25 };
    let frame =
        MarkNote::CurvedFrame { name: "station 3".to_owned(), off_mm: 4.5, length_mm: 620.0 };
    let notes = [missed, far, over(4.0, "drill"), over(0.0, "text"), square, curved, frame];
    whole(notes.map(|note| Kind::Marked { note }))
}
