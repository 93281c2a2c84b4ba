//! Round pipes that bend and branch, from cylinders and cones that are cut where they meet.
//!
//! Two cylinders or cones of revolution that touch one sphere meet in plane curves (a theorem of
//! Monge's). So every cut here is plane, and every ruling runs from one plane to another.

use super::sketch::{Drawn, Sketch, SmoothPart};
use super::{Choice, Kind, Parameter, Template, TemplateError, Values, angle, count, length};
use sheetwright_geometry::math::{Point3, Vec3, atan2, cos, sin};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A pipe bend of straight segments.
pub(super) const ELBOW: Template = Template {
    name: "elbow",
    title: "Gored elbow",
    who: "Duct, stove-pipe and exhaust shops weld a bend from straight pieces of pipe.",
    words: &[
        "lobster back",
        "segmented bend",
        "mitre bend",
        "pipe bend",
        "stove pipe",
        "adjustable elbow",
        "HVAC",
    ],
    parameters: &[
        length("diameter", "diameter of the pipe", 20.0, 5_000.0, 200.0),
        length("radius", "radius of the bend, to the middle of the pipe", 20.0, 20_000.0, 300.0),
        angle("angle", "angle of the bend", 5.0, 180.0, 90.0),
        count("segments", "segments, the ends among them", 2, 24, 5),
        Parameter { name: "ends", meaning: "what the end segments are", kind: Kind::Choice(&ENDS) },
        length(
            "collar",
            "straight length that is added at both ends, for square ends",
            0.0,
            5_000.0,
            0.0,
        ),
        Parameter { name: "seam", meaning: "where the seams run", kind: Kind::Choice(&SEAMS) },
    ],
    sheet: None,
    trade: Some("duct"),
    build: elbow,
};

const ENDS: [Choice; 2] = [
    Choice { name: "half", meaning: "half segments, cut square to fit a round pipe" },
    Choice { name: "alike", meaning: "whole segments like all others, cut aslant" },
];

const SEAMS: [Choice; 3] = [
    Choice { name: "throat", meaning: "at the inside of the bend, where they are shortest" },
    Choice { name: "heel", meaning: "at the outside of the bend" },
    Choice { name: "staggered", meaning: "at the inside and the outside in turn" },
];

/// Samples of each rail: a ruling every 1.5°.
const SAMPLES: usize = 241;
/// The throat is at least this share of the radius of the bend.
const THROAT_SHARE: f64 = 0.02;

fn elbow(values: &Values) -> Drawn {
    let (r, bend) = (values.number("diameter") / 2.0, values.number("radius"));
    let (whole, segments) = (values.radians("angle"), values.count("segments"));
    let (square, collar) = (values.choice("ends") == "half", values.number("collar"));
    if bend - r < THROAT_SHARE * bend {
        let message = format!("the bend is as tight as the pipe of {} mm is wide", 2.0 * r);
        let hint = "Make the radius of the bend larger than half of the diameter.";
        return Err(TemplateError::together("radius", message, hint));
    }
    if collar > 0.0 && !square {
        let message = "ends that are cut aslant have no collar";
        let hint = "Leave the collar at 0, or set ends=half.";
        return Err(TemplateError::together("collar", message, hint));
    }
    // A half segment at each end turns half as far as one between them.
    let share = if square { segments as f64 - 1.0 } else { segments as f64 };
    let step = whole / share;
    if step >= MOST_STEP {
        let message = "these segments bend too sharply to meet";
        let hint = "Ask for more segments, or for a smaller angle.";
        return Err(TemplateError::together("segments", message, hint));
    }
    let cut = (sin(step / 2.0) / cos(step / 2.0)).abs();
    let shortest = (bend - r) * cut;
    if shortest < LEAST_THROAT * r {
        let message = format!("half a segment is only {shortest:.2} mm long at the throat");
        let hint = "Ask for fewer segments, or for a larger radius of the bend.";
        return Err(TemplateError::together("segments", message, hint));
    }
    let mut sketch = Sketch::default();
    for n in 0..segments {
        let (first, last) = (n == 0, n + 1 == segments);
        // Where the axis of the segment touches the circle of the bend; the ends' own planes lie
        // there if they are square.
        let at = match square {
            true => step * n as f64,
            false => step * (n as f64 + 0.5),
        };
        let out = Vec3::new(cos(at), 0.0, sin(at));
        let along = Vec3::new(-sin(at), 0.0, cos(at));
        let seam = match values.choice("seam") {
            "heel" => 0.0,
            "staggered" if n % 2 == 1 => 0.0,
            _ => PI,
        };
        // A point of the pipe, and the way along it to the cut.
        let rim = |angle: f64, side: f64, is_square: bool| {
            let reach = if is_square { collar } else { (bend + r * cos(angle)) * cut };
            Point3::default()
                + out * (bend + r * cos(angle))
                + Vec3::Y * (r * sin(angle))
                + along * (side * reach)
        };
        // Where the seams run on from one segment to the next, both have one curve between them.
        let is_shared = !first && values.choice("seam") != "staggered";
        let low = if is_shared { format!("cut-{n}b") } else { format!("cut-{}a", n + 1) };
        let high = format!("cut-{}b", n + 1);
        if !is_shared {
            sketch.along(&low, TAU, |t| rim(seam + TAU * t, -1.0, first && square));
        }
        sketch.along(&high, TAU, |t| rim(seam + TAU * t, 1.0, last && square));
        sketch.strip(format!("segment-{}", n + 1), [&low, &high], SAMPLES);
    }
    Ok(sketch)
}

/// Least length of half a segment at the throat, as a share of the radius of the pipe: a quarter of
/// the distance between two samples. On slimmer segments, rungs run along the edge.
const LEAST_THROAT: f64 = 0.0065;

/// From one segment to the next a pipe turns by less than this, radians (150°): beyond it the cuts
/// run away along the pipe.
const MOST_STEP: f64 = 150.0 * PI / 180.0;

/// A pipe that divides into two.
pub(super) const Y_BRANCH: Template = Template {
    name: "y-branch",
    title: "Y-branch",
    who: "Duct, dust-extraction and exhaust shops divide one pipe into two equal ones.",
    words: &["pants", "breeches", "wye", "Y piece", "bifurcation", "manifold", "HVAC", "trousers"],
    parameters: &[
        length("trunk", "diameter of the trunk", 20.0, 5_000.0, 250.0),
        length("branch", "diameter of each branch at its end", 20.0, 5_000.0, 180.0),
        angle("angle", "angle between the trunk's direction and each branch", 15.0, 80.0, 40.0),
        length(
            "branch-length",
            "length of a branch, from where the middle lines meet",
            20.0,
            20_000.0,
            450.0,
        ),
        length(
            "trunk-length",
            "length of the trunk, from where the middle lines meet",
            20.0,
            20_000.0,
            300.0,
        ),
    ],
    sheet: None,
    trade: Some("duct"),
    build: y_branch,
};

/// Least length of a ruling, as a share of the radius of the trunk.
const LEAST_RULING: f64 = 0.05;

fn y_branch(values: &Values) -> Drawn {
    let (big, small) = (values.number("trunk") / 2.0, values.number("branch") / 2.0);
    let lean = values.radians("angle");
    let (far, down) = (values.number("branch-length"), values.number("trunk-length"));
    // The sphere about the origin that the trunk touches; a branch is the cone that touches it and
    // has the branch's radius at its end.
    let reach = (far * far + small * small).sqrt();
    if reach <= (1.0 + LEAST_RULING) * big {
        let message = "the branch ends inside the trunk";
        let hint = format!("Make it longer than the trunk's diameter of {} mm.", 2.0 * big);
        return Err(TemplateError::together("branch-length", message, hint));
    }
    let taper = atan2(big, (reach * reach - big * big).sqrt()) - atan2(small, far);
    let cone = Branch { big, lean, taper };
    let Some([low, high]) = cone.mitre() else {
        let message = "the branch opens so fast that it does not leave the trunk";
        let hint = "Make the branch narrower or longer, or the angle larger.";
        return Err(TemplateError::together("branch", message, hint));
    };
    let slope = (high[1] - low[1]) / (high[0] - low[0]);
    let middle = low[1] - slope * low[0];
    // Where trunk and both branches meet: at x = 0, on either side.
    let meeting = cone.angle_of(Point3::new(0.0, big, middle));
    let crotch = cone.until_middle(PI);
    let tightest = crotch.max(cone.until_mitre(0.0, slope, middle));
    let clear = LEAST_RULING * big;
    if crotch.is_nan() || tightest + clear > far {
        let message = "the two branches have not parted where they end";
        let hint = format!(
            "Make the branch longer (about {:.0} mm), or the angle larger.",
            tightest + big
        );
        return Err(TemplateError::together("branch-length", message, hint));
    }
    if down < clear - low[1] {
        let message = "the trunk ends where the branches begin";
        let hint = format!("Make it longer than {:.0} mm.", (clear - low[1]).ceil());
        return Err(TemplateError::together("trunk-length", message, hint));
    }
    let mut sketch = Sketch::default();
    // The seam of the trunk runs at +x, where its upper edge is lowest and the seam shortest.
    let top = |angle: f64| {
        let x = big * cos(angle);
        Point3::new(x, big * sin(angle), middle + slope * x.abs())
    };
    let quarter = |from: f64, to: f64| move |t: f64| top(from + (to - from) * t);
    sketch.along("trunk-foot", TAU, |t| Point3::new(big * cos(TAU * t), big * sin(TAU * t), -down));
    sketch.jointed(
        "trunk-top",
        &[
            SmoothPart { turn: FRAC_PI_2, at: &quarter(0.0, FRAC_PI_2) },
            SmoothPart { turn: PI, at: &quarter(FRAC_PI_2, PI + FRAC_PI_2) },
            SmoothPart { turn: FRAC_PI_2, at: &quarter(PI + FRAC_PI_2, TAU) },
        ],
    );
    sketch.strip("trunk", ["trunk-foot", "trunk-top"], SAMPLES);
    for (name, mirror) in [("right", 1.0), ("left", -1.0)] {
        let turned = |p: Point3| Point3::new(mirror * p.x, mirror * p.y, p.z);
        // From the crotch, where a branch is shortest, round the outside and back.
        let to_middle = |from: f64, to: f64| {
            move |t: f64| {
                let angle = from + (to - from) * t;
                turned(cone.at(angle, cone.until_middle(angle)))
            }
        };
        let to_trunk = |t: f64| {
            let angle = PI + (PI - meeting) + 2.0 * meeting * t;
            turned(cone.at(angle, cone.until_mitre(angle, slope, middle)))
        };
        let (end, cut) = (format!("{name}-end"), format!("{name}-cut"));
        sketch.along(&end, TAU, |t| turned(cone.at(PI + TAU * t, far)));
        sketch.jointed(
            &cut,
            &[
                SmoothPart { turn: PI - meeting, at: &to_middle(PI, TAU - meeting) },
                SmoothPart { turn: 2.0 * meeting, at: &to_trunk },
                SmoothPart { turn: PI - meeting, at: &to_middle(TAU + meeting, TAU + PI) },
            ],
        );
        sketch.strip(name, [&cut, &end], SAMPLES);
    }
    Ok(sketch)
}

/// The branch on the side of +x: a cone about an axis through the origin that touches the sphere of
/// radius `big` there.
#[derive(Clone, Copy)]
struct Branch {
    big: f64,
    /// Angle between its axis and z, radians.
    lean: f64,
    /// Angle between its axis and its rulings, radians.
    taper: f64,
}

impl Branch {
    fn axis(self) -> Vec3 {
        Vec3::new(sin(self.lean), 0.0, cos(self.lean))
    }

    /// The direction from the axis to the ruling at `angle`, which is 0 on the outside.
    fn outward(self, angle: f64) -> Vec3 {
        Vec3::new(cos(self.lean), 0.0, -sin(self.lean)) * cos(angle) + Vec3::Y * sin(angle)
    }

    /// The beginning of the ruling beside the origin, and its direction for every mm along the
    /// axis.
    fn ruling(self, angle: f64) -> (Point3, Vec3) {
        let out = self.outward(angle);
        let slope = sin(self.taper) / cos(self.taper);
        let start = Point3::from_vec(out * (self.big / cos(self.taper)));
        (start, self.axis() - out * slope)
    }

    /// The point of a ruling that lies `s` mm along the axis.
    fn at(self, angle: f64, s: f64) -> Point3 {
        let (start, way) = self.ruling(angle);
        start + way * s
    }

    /// The length along the axis at which a ruling meets the plane between the branches, mm.
    fn until_middle(self, angle: f64) -> f64 {
        let (start, way) = self.ruling(angle);
        -start.x / way.x
    }

    /// The length along the axis at which a ruling meets the plane z = middle + slope · x, mm.
    fn until_mitre(self, angle: f64, slope: f64, middle: f64) -> f64 {
        let (start, way) = self.ruling(angle);
        (middle + slope * start.x - start.z) / (way.z - slope * way.x)
    }

    /// The angle of the ruling through a point of the cone.
    fn angle_of(self, point: Point3) -> f64 {
        let way = point.to_vec();
        atan2(way.y, way.dot(self.outward(0.0)))
    }

    /// The two points in the plane y = 0, as x and z, where the outlines of branch and trunk meet:
    /// the lower one at x = big, the upper one at x = −big. `None` if they do not.
    fn mitre(self) -> Option<[[f64; 2]; 2]> {
        let meet = |angle: f64, x: f64| {
            let (start, way) = self.ruling(angle);
            let s = (x - start.x) / way.x;
            let at = start + way * s;
            // Away from the trunk, not behind it; both outlines lead to +x.
            (way.x > LEAST_LEAN && at.z.is_finite()).then_some([at.x, at.z])
        };
        Some([meet(0.0, self.big)?, meet(PI, -self.big)?])
    }
}

/// The outlines of a branch lean away from the trunk by at least this, mm a mm of its axis.
const LEAST_LEAN: f64 = 0.02;
