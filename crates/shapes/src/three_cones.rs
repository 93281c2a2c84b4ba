//! Three cones that touch one plane, and the sheet that they form.
//!
//! A sheet that only bends can branch: three wings, each a part of a cone, leave a flat middle
//! along three rulings. On the flat sheet those rulings are the sides of a triangle, and each wing
//! is rolled about its cone, which touches the plane along its side. So the development of the
//! whole is known: the flat outline itself.

use sheetwright::boundary::{Continuity, Within};
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{CurveUse, Design, DesignCurve, DesignPanel, Join, PanelShape};
use sheetwright::math::{Point2, Point3, Vec2, Vec3, atan2, cos, from_deg, sin};

/// The distance of each ruling that bounds the flat middle from the origin, mm.
const TO_RULING: f64 = 110.0;
/// The distance of each apex from the foot of that distance, along the ruling, mm.
const TO_APEX: f64 = 420.0;
/// The sine of the angle between the axis and the rulings of each cone.
const SIN_HALF_ANGLE: f64 = 0.32;
/// The outline of each wing is a circle of this radius about a middle this far out, mm.
const RADIUS: f64 = 150.0;
const TO_MIDDLE: f64 = 130.0;
/// Points of each wing's outline.
const POINTS: usize = 49;

/// Wing n of 0, 1, 2 lies in this direction, and its ruling runs along the second.
fn directions(wing: usize) -> [Vec2; 2] {
    let angle = from_deg(120.0 * wing as f64);
    let out = Vec2::new(cos(angle), sin(angle));
    [out, Vec2::new(-out.y, out.x)]
}

/// The place in space of a point of the flat sheet, whose origin is the middle.
pub fn space(flat: Point2) -> Point3 {
    for wing in 0..3 {
        let [out, along] = directions(wing);
        let p = flat.to_vec();
        let beyond = p.dot(out) - TO_RULING;
        if beyond > 0.0 {
            // Polar coordinates about the apex, the angle from the ruling outwards.
            let from_apex = p.dot(along) + TO_APEX;
            let (r, turn) =
                ((beyond * beyond + from_apex * from_apex).sqrt(), atan2(beyond, from_apex));
            let apex = (out * TO_RULING - along * TO_APEX).extend(0.0);
            return Point3::from_vec(apex + ruling(wing, turn / SIN_HALF_ANGLE) * r);
        }
    }
    Point3::new(flat.x, flat.y, 0.0)
}

/// The unit direction of a cone's ruling at an angle about its axis from the one in the plane.
fn ruling(wing: usize, angle: f64) -> Vec3 {
    let [out, along] = directions(wing).map(|v| v.extend(0.0));
    let (s, c) = (SIN_HALF_ANGLE, (1.0 - SIN_HALF_ANGLE * SIN_HALF_ANGLE).sqrt());
    // The axis lies below the plane.
    let (axis, up) = (along * c - Vec3::Z * s, along * s + Vec3::Z * c);
    axis * c + (up * cos(angle) + out * sin(angle)) * s
}

/// The corner of the flat outline between wing n − 1 and wing n, where their circles meet.
pub fn corner(wing: usize) -> Point2 {
    let angle = from_deg(120.0 * wing as f64 - 60.0);
    // On the ray half way between the two, at the distance where the circle crosses it.
    let half = 0.5 * TO_MIDDLE;
    let reach = half + (RADIUS * RADIUS - 3.0 * half * half).sqrt();
    Point2::new(reach * cos(angle), reach * sin(angle))
}

/// `count` points of the flat outline of a wing from corner to corner, evenly along its circle,
/// both ends included.
pub fn wing_outline(wing: usize, count: usize) -> Vec<Point2> {
    let [out, along] = directions(wing);
    let middle = out * TO_MIDDLE;
    let angle_of = |p: Point2| {
        let way = p.to_vec() - middle;
        atan2(way.dot(along), way.dot(out))
    };
    let [from, to] = [corner(wing), corner((wing + 1) % 3)].map(angle_of);
    (0..count)
        .map(|n| {
            let angle = from + (to - from) * n as f64 / (count - 1) as f64;
            let p = middle + (out * cos(angle) + along * sin(angle)) * RADIUS;
            Point2::new(p.x, p.y)
        })
        .collect()
}

/// The design of the three cones, each a panel, joined to one with smooth joints. Points are
/// rounded to a thousandth of a millimetre, as in files that are typed.
pub fn design(samples: usize) -> Design {
    let rounded = |p: Point3| {
        let thousandth = |x: f64| (x * 1e3).round() / 1e3 + 0.0;
        CurvePoint::smooth(Point3::new(thousandth(p.x), thousandth(p.y), thousandth(p.z)))
    };
    let curve = |name: String, kind: CurveKind, points: Vec<Point3>| DesignCurve {
        name,
        kind: Some(kind),
        closed: false,
        points: points.into_iter().map(rounded).collect(),
    };
    let mut curves = Vec::new();
    for wing in 0..3 {
        let points = wing_outline(wing, POINTS).into_iter().map(space).collect();
        curves.push(curve(format!("rim-{}", wing + 1), CurveKind::Spline, points));
    }
    for wing in 0..3 {
        let points = vec![Point3::default(), space(corner(wing))];
        curves.push(curve(format!("seam-{}", wing + 1), CurveKind::Polyline, points));
    }
    let used = |name: String, reversed: bool| CurveUse { name, reversed };
    let cone = |wing: usize| format!("cone-{}", wing + 1);
    let join = Join {
        parts: (0..3).map(cone).collect(),
        smooth: Continuity::G1,
        within: Within::Mm(30.0),
        keep_parts: false,
    };
    let mut panels: Vec<DesignPanel> = (0..3)
        .map(|wing| {
            let outer = vec![
                used(format!("seam-{}", wing + 1), false),
                used(format!("rim-{}", wing + 1), false),
                used(format!("seam-{}", (wing + 1) % 3 + 1), true),
            ];
            DesignPanel::new(cone(wing), PanelShape::Loops { outer, holes: Vec::new() }, samples)
        })
        .collect();
    panels.push(DesignPanel::new("whole", PanelShape::Join(join), samples));
    Design { name: "three cones".to_owned(), material: None, curves, panels, ..Design::default() }
}
