//! A hull with one chine, drawn so that its panels bend without twist whatever its dimensions are.
//!
//! Coordinates: x forward from the top of the stern, y to port from the middle, z up from the
//! lowest point of the keel; mm. Only the port half is drawn. Both of its surfaces are cylinders
//! (curves carried along a straight line), and so developable:
//!
//! - the side: a plan curve, carried along a line that leans outwards by the flare,
//!   y = plan(x) − (`bow_height` − z) · flare;
//! - the bottom: the keel's profile, carried outwards and aft along a line that rises by the
//!   deadrise, z = keel(x + sweep · y) + deadrise · y. The sweep brings the rise of the forefoot to
//!   the chine before it comes to the keel, which makes the bow sharper than amidships.
//!
//! The chine is the line where the two meet, the keel and the stems are the lines where they meet
//! the middle plane, and a transom is a plane that cuts both. Every curve is a spline through a few
//! points of these lines, closer together at the ends, where a natural spline is least exact;
//! neighbours share one curve.

use super::TemplateError;
use super::sketch::{Sketch, mirrored};
use sheetwright_geometry::math::{Point3, cos};
use std::f64::consts::PI;

/// The dimensions of a hull; lengths in mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dimensions {
    /// The length from the top of the stern to the top of the bow.
    pub length: f64,
    /// The width across the sheer at the widest station.
    pub beam: f64,
    /// The height from the lowest point of the keel to the sheer there.
    pub depth: f64,
    /// The outward slope of the sides, mm for each mm upwards.
    pub flare: f64,
    /// The rise of the bottom, mm for each mm outwards.
    pub deadrise: f64,
    /// The height of the sheer at the bow above the lowest point of the keel.
    pub bow_height: f64,
    /// The height of the sheer at the stern above that point.
    pub stern_height: f64,
    /// The height of the line of the keel, extended to the bow, above that point.
    pub bow_rise: f64,
    /// The height of the line of the keel, extended to the stern, above that point.
    pub stern_rise: f64,
    /// How the hull ends at the bow.
    pub bow: End,
    /// How it ends at the stern.
    pub stern: End,
    /// The properties that cannot be set.
    pub style: Style,
}

/// How a hull ends.
#[derive(Clone, Copy, Debug)]
pub(super) enum End {
    /// The sides meet.
    Stem,
    /// A flat board.
    Transom {
        /// Its width at the sheer, mm.
        width: f64,
        /// Its outward slope, mm for each mm upwards.
        lean: f64,
    },
}

/// The differences between kinds of boats of equal dimensions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    /// The place of the widest station, as a share of the length from the stern.
    pub widest: f64,
    /// The place where the keel is lowest, as a share of the length from the stern.
    pub lowest: f64,
    /// The exponents with which the keel rises towards the bow and the stern, as powers of the
    /// distance from there.
    pub keel_powers: [u32; 2],
    /// The run of the bottom's straight lines aft, as a share of their run outwards.
    pub sweep: f64,
    /// The fullness of the ends in plan beyond those of a parabola: the share of the half-breadth
    /// that falls off with the fourth power.
    pub fullness: f64,
}

/// A hull with its curves and panels so far.
#[derive(Debug)]
pub(super) struct Hull {
    /// Its curves and panels.
    pub sketch: Sketch,
    /// The points of the sheer, from the stern to the bow.
    pub sheer: Vec<Point3>,
}

/// Points of a long curve: a builder marks about as many stations.
const STATIONS: usize = 11;
/// Points of a stem.
const STEM_POINTS: usize = 7;
/// Points of an edge of a transom.
const TRANSOM_POINTS: usize = 5;
/// Samples of the loop of a long panel: one every 15 mm of a small boat.
pub(super) const LONG_SAMPLES: usize = 400;
/// Samples of the loop of a transom: it is flat, so few suffice.
const FLAT_SAMPLES: usize = 100;
/// Least height of a side, mm: a lower one can't be stitched or nailed.
const LEAST_SIDE: f64 = 20.0;
/// Least distance of the chines from the middle amidships, as a share of the beam: a narrower
/// bottom is a mistake.
const LEAST_BOTTOM: f64 = 0.1;
/// Least half-width of a transom at the chine, mm: a narrower one is a mistake, too.
const LEAST_HALF_WIDTH: f64 = 20.0;
/// Limit of the product of the slopes of the bottom and the sides, each against the other: at 1
/// they are parallel and never meet.
const STEEPEST: f64 = 0.9;
/// Largest rise of the line of the keel, as a share of the height of the sheer.
const HIGHEST_RISE: f64 = 0.8;
/// Largest lean of a transom, as a share of the length between it and the widest station.
const LONGEST_LEAN: f64 = 0.8;
/// Places at which the plan is checked to be fair.
const PLAN_CHECKS: usize = 32;
/// Halvings of an interval: from metres to below rounding.
const HALVINGS: usize = 64;
/// Largest distance of a point from the line where two surfaces meet, as a share of the length: far
/// above rounding, far below any measurement.
const MET: f64 = 1e-9;

/// The names of the curves, the panel and the parameters of an end.
struct EndNames {
    /// In words.
    end: &'static str,
    stem: &'static str,
    board: &'static str,
    bottom: [&'static str; 2],
    side: [&'static str; 2],
    top: &'static str,
    width: &'static str,
    rake: &'static str,
    rise: &'static str,
}

const BOW: EndNames = EndNames {
    end: "bow",
    stem: "stem",
    board: "bow-transom",
    bottom: ["bow-transom-bottom", "bow-transom-bottom-starboard"],
    side: ["bow-transom-side", "bow-transom-side-starboard"],
    top: "bow-transom-top",
    width: "bow-width",
    rake: "bow-rake",
    rise: "bow-rise",
};

const STERN: EndNames = EndNames {
    end: "stern",
    stem: "sternpost",
    board: "transom",
    bottom: ["transom-bottom", "transom-bottom-starboard"],
    side: ["transom-side", "transom-side-starboard"],
    top: "transom-top",
    width: "transom-width",
    rake: "transom-rake",
    rise: "stern-rise",
};

/// The surfaces of a hull.
#[derive(Debug)]
struct Form {
    of: Dimensions,
    /// Where the widest station lies, mm.
    widest: f64,
    /// Half-breadth at the height of the bow, at the widest station, mm.
    peak: f64,
    /// Factors of the second, third and fourth power of the distance from there.
    falls: [f64; 3],
}

/// The positions of one end of the keel, of the chine and of the sheer.
#[derive(Clone, Copy, Debug)]
struct Corners {
    keel: Point3,
    chine: Point3,
    sheer: Point3,
}

/// Draws the port half of a hull, and its transoms whole: the curves `keel`, `chine`, `sheer` and
/// those of the ends; the panels `bottom`, `side`, `transom` and `bow-transom`, as far as there are
/// such, each facing outwards.
///
/// # Errors
/// Dimensions that make no hull.
pub(super) fn hull(of: Dimensions) -> Result<Hull, TemplateError> {
    let form = Form::new(of)?;
    let mut sketch = Sketch::default();
    let stern = form.end(&mut sketch, of.stern, &STERN)?;
    let bow = form.end(&mut sketch, of.bow, &BOW)?;
    let keel = line(stern.keel, bow.keel, |x| Point3::new(x, 0.0, form.keel(x)));
    let chine = line(stern.chine, bow.chine, |x| form.chine(x));
    let sheer = line(stern.sheer, bow.sheer, |x| form.sheer(x));
    form.refuse_unfair([&keel, &chine, &sheer])?;
    for (name, points) in [("keel", &keel), ("chine", &chine), ("sheer", &sheer)] {
        sketch.spline(name, points);
    }
    sketch.patch("bottom", &bottom_edges(&of), LONG_SAMPLES);
    sketch.patch("side", &side_edges(&of), LONG_SAMPLES);
    for (end, names) in [(of.stern, &STERN), (of.bow, &BOW)] {
        if let End::Transom { .. } = end {
            let [port, starboard] = [0, 1].map(|side| (names.bottom[side], names.side[side]));
            // Seen from ahead, port is on the right; seen from astern, on the left.
            let edges = if names.board == BOW.board {
                board_edges(port, names.top.to_owned(), starboard)
            } else {
                board_edges(starboard, format!("-{}", names.top), port)
            };
            let edges: Vec<&str> = edges.iter().map(String::as_str).collect();
            sketch.patch(names.board, &edges, FLAT_SAMPLES);
        }
    }
    Ok(Hull { sketch, sheer })
}

/// The loop of the bottom, as seen from below.
fn bottom_edges(of: &Dimensions) -> Vec<&'static str> {
    let mut edges = vec!["-keel"];
    if let End::Transom { .. } = of.stern {
        edges.push("transom-bottom");
    }
    edges.push("chine");
    if let End::Transom { .. } = of.bow {
        edges.push("-bow-transom-bottom");
    }
    edges
}

/// The loop of the side, as seen from outside.
fn side_edges(of: &Dimensions) -> [&'static str; 4] {
    let bow = if matches!(of.bow, End::Stem) { "-stem" } else { "-bow-transom-side" };
    let stern = if matches!(of.stern, End::Stem) { "sternpost" } else { "transom-side" };
    ["sheer", bow, "-chine", stern]
}

/// The loop of a transom: along the bottom and up the side on the right, back on the left.
fn board_edges(right: (&str, &str), top: String, left: (&str, &str)) -> [String; 5] {
    let back = |name: &str| format!("-{name}");
    [right.0.to_owned(), right.1.to_owned(), top, back(left.1), back(left.0)]
}

impl Form {
    fn new(of: Dimensions) -> Result<Self, TemplateError> {
        refuse_dimensions(&of)?;
        let widest = of.style.widest * of.length;
        let half = |end: End| if let End::Transom { width, .. } = end { width / 2.0 } else { 0.0 };
        // Half-breadths of the side where it is carried to the height of the bow.
        let peak = of.beam / 2.0 + (of.bow_height - of.depth) * of.flare;
        let aft = half(of.stern) + (of.bow_height - of.stern_height) * of.flare;
        let fore = half(of.bow);
        for (width, names) in [(fore, &BOW), (aft, &STERN)] {
            if width > peak {
                return Err(unfair(names.end));
            }
        }
        let (to_stern, to_bow) = (widest, of.length - widest);
        let fourth = of.style.fullness * peak / power(to_stern.max(to_bow), 4);
        let fall = |width: f64, far: f64| (peak - width) / (far * far) - fourth * far * far;
        let third = (fall(fore, to_bow) - fall(aft, to_stern)) / (to_bow + to_stern);
        let second = fall(aft, to_stern) + third * to_stern;
        let form = Self { of, widest, peak, falls: [second, third, fourth] };
        form.refuse_shape()?;
        Ok(form)
    }

    /// Half-breadth of the side, carried to the height of the bow, mm.
    fn plan(&self, x: f64) -> f64 {
        let d = x - self.widest;
        let [second, third, fourth] = self.falls;
        self.peak - d * d * (second + d * (third + d * fourth))
    }

    /// Height of the keel, mm.
    fn keel(&self, x: f64) -> f64 {
        let Dimensions { length, bow_rise, stern_rise, style, .. } = self.of;
        let lowest = style.lowest * length;
        let [bow, stern] = style.keel_powers;
        if x < lowest {
            stern_rise * power((lowest - x) / lowest, stern)
        } else {
            bow_rise * power((x - lowest) / (length - lowest), bow)
        }
    }

    /// Half-breadth of the side, mm.
    fn side(&self, x: f64, z: f64) -> f64 {
        self.plan(x) - (self.of.bow_height - z) * self.of.flare
    }

    /// Height of the bottom, mm.
    fn bottom(&self, x: f64, y: f64) -> f64 {
        self.keel(x + self.of.style.sweep * y) + self.of.deadrise * y
    }

    /// Where the bottom and the side meet.
    fn chine(&self, x: f64) -> Point3 {
        let highest = self.of.bow_height.max(self.of.stern_height);
        let above = |z: f64| z - self.bottom(x, self.side(x, z));
        let z = turning_point(above, -self.of.depth, highest);
        Point3::new(x, self.side(x, z), z)
    }

    /// The sheer: in profile a parabola through its heights at the ends and the widest station.
    fn sheer(&self, x: f64) -> Point3 {
        let Dimensions { length, depth, bow_height, stern_height, .. } = self.of;
        let (a, b) = (self.widest, length);
        let z = stern_height * (x - a) * (x - b) / (a * b)
            + depth * x * (x - b) / (a * (a - b))
            + bow_height * x * (x - a) / (b * (b - a));
        Point3::new(x, self.side(x, z), z)
    }

    /// Draws the curves of one end.
    fn end(
        &self,
        sketch: &mut Sketch,
        end: End,
        names: &EndNames,
    ) -> Result<Corners, TemplateError> {
        let at_bow = names.board == BOW.board;
        let (x, top) =
            if at_bow { (self.of.length, self.of.bow_height) } else { (0.0, self.of.stern_height) };
        match end {
            End::Stem => Ok(self.stem(sketch, [x, top], names)),
            End::Transom { width, lean } => {
                let lean = if at_bow { -lean } else { lean };
                let room = LONGEST_LEAN * (x - self.widest).abs();
                if lean.abs() * top > room {
                    return Err(TemplateError::together(
                        names.rake,
                        format!("the transom leans over {:.0} mm of the boat", lean.abs() * top),
                        format!("{room:.0} mm are the most: let it stand more upright."),
                    ));
                }
                let sheer = Point3::new(x, width / 2.0, top);
                self.transom(sketch, sheer, lean, names)
            }
        }
    }

    /// A stem: the line where the side meets the middle, from the keel to the sheer at `[x, z]`.
    fn stem(&self, sketch: &mut Sketch, [x, top]: [f64; 2], names: &EndNames) -> Corners {
        let at = |z: f64| turning_point(|x| self.side(x, z), self.widest, x);
        let foot = turning_point(|z| z - self.keel(at(z)), 0.0, top);
        let points: Vec<Point3> =
            spread(foot, top, STEM_POINTS).map(|z| Point3::new(at(z), 0.0, z)).collect();
        sketch.spline(names.stem, &points);
        let (foot, head) = (points[0], points[STEM_POINTS - 1]);
        Corners { keel: foot, chine: foot, sheer: head }
    }

    /// A transom below `sheer`, in the plane that `lean` carries forward for each mm downwards.
    fn transom(
        &self,
        sketch: &mut Sketch,
        sheer: Point3,
        lean: f64,
        names: &EndNames,
    ) -> Result<Corners, TemplateError> {
        let plane = |z: f64| sheer.x + (sheer.z - z) * lean;
        let far = plane(0.0);
        let meets = |height: &dyn Fn(f64) -> f64| {
            turning_point(|x| (x - plane(height(x))) * (far - sheer.x).signum(), sheer.x, far)
        };
        let x = meets(&|x| self.keel(x));
        let keel = Point3::new(x, 0.0, self.keel(x));
        let chine = self.chine(meets(&|x| self.chine(x).z));
        if chine.y < LEAST_HALF_WIDTH {
            return Err(TemplateError::together(
                names.width,
                "the sides meet above the bottom of the transom",
                "Make the transom wider, or take less flare.",
            ));
        }
        let mut side: Vec<Point3> = spread(chine.z, sheer.z, TRANSOM_POINTS)
            .map(|z| Point3::new(plane(z), self.side(plane(z), z), z))
            .collect();
        let mut bottom: Vec<Point3> = spread(0.0, chine.y, TRANSOM_POINTS)
            .map(|y| {
                let z = turning_point(|z| z - self.bottom(plane(z), y), 0.0, sheer.z);
                Point3::new(plane(z), y, z)
            })
            .collect();
        let met = MET * self.of.length;
        let missed = |p: &Point3| (p.z - self.bottom(p.x, p.y)).abs() > met;
        if bottom.iter().any(missed) || bottom.iter().any(|p| p.z > sheer.z - LEAST_SIDE) {
            return Err(TemplateError::together(
                names.rise,
                format!("the bottom comes up to the top of the transom at the {}", names.end),
                "Let the keel rise less, or raise the sheer there.",
            ));
        }
        (side[0], side[TRANSOM_POINTS - 1]) = (chine, sheer);
        (bottom[0], bottom[TRANSOM_POINTS - 1]) = (keel, chine);
        for (points, [port, starboard]) in [(&bottom, names.bottom), (&side, names.side)] {
            sketch.spline(port, points);
            sketch
                .spline(starboard, &points.iter().copied().map(mirrored).collect::<Vec<Point3>>());
        }
        sketch.polyline(names.top, &[sheer, mirrored(sheer)]);
        Ok(Corners { keel, chine, sheer })
    }

    /// Refuses surfaces that do not meet in a chine, and plans that swell twice.
    fn refuse_shape(&self) -> Result<(), TemplateError> {
        let of = &self.of;
        let chine = self.chine(self.widest);
        if chine.y < LEAST_BOTTOM * of.beam {
            return Err(TemplateError::together(
                "flare",
                format!(
                    "the sides lean so far that they leave a bottom of {:.0} mm",
                    2.0 * chine.y.max(0.0)
                ),
                "Let the sides lean out less, or make the boat wider or not so deep.",
            ));
        }
        let lowest = of.style.lowest * of.length;
        let steepest = f64::from(of.style.keel_powers[0]) * of.bow_rise / (of.length - lowest);
        let slope = (of.style.sweep * steepest + of.deadrise).max(chine.z / chine.y);
        if of.flare * slope > STEEPEST {
            return Err(TemplateError::together(
                "flare",
                "the sides lean out as far as the bottom rises, so that there is no chine",
                "Take less flare or less deadrise, or let the keel rise less at the bow.",
            ));
        }
        for n in 0..=PLAN_CHECKS {
            let d = of.length * n as f64 / PLAN_CHECKS as f64 - self.widest;
            let [second, third, fourth] = self.falls;
            if 2.0 * second + d * (3.0 * third + d * 4.0 * fourth) < 0.0 {
                return Err(unfair(if d < 0.0 { STERN.end } else { BOW.end }));
            }
        }
        Ok(())
    }

    /// Refuses a chine that rises to the sheer, or curves that turn back.
    fn refuse_unfair(&self, [keel, chine, sheer]: [&[Point3]; 3]) -> Result<(), TemplateError> {
        let met = MET * self.of.length;
        let missed = |p: &Point3| (p.z - self.bottom(p.x, p.y)).abs() > met || p.y < -met;
        let back = |line: &[Point3]| line.windows(2).any(|p| p[1].x <= p[0].x);
        if chine.iter().any(missed) || [keel, chine, sheer].into_iter().any(back) {
            return Err(TemplateError::together(
                "flare",
                "the bottom and the sides do not meet all along",
                "Take less flare or less deadrise.",
            ));
        }
        let low = chine.iter().map(|p| self.sheer(p.x).z - p.z).fold(f64::INFINITY, f64::min);
        if low < LEAST_SIDE {
            return Err(TemplateError::together(
                "depth",
                format!("the sides come down to {low:.0} mm between chine and sheer"),
                format!(
                    "{LEAST_SIDE:.0} mm are the least: make the boat deeper, or take less deadrise."
                ),
            ));
        }
        Ok(())
    }
}

/// Refuses a keel that rises to the sheer, before anything is derived from it.
fn refuse_dimensions(of: &Dimensions) -> Result<(), TemplateError> {
    for (rise, height, names) in
        [(of.bow_rise, of.bow_height, &BOW), (of.stern_rise, of.stern_height, &STERN)]
    {
        if rise > HIGHEST_RISE * height {
            return Err(TemplateError::together(
                names.rise,
                format!(
                    "the keel rises to {rise} mm at the {}, the sheer to {height} mm",
                    names.end
                ),
                format!("Take {:.0} mm or less, or raise the sheer there.", HIGHEST_RISE * height),
            ));
        }
    }
    Ok(())
}

fn unfair(end: &str) -> TemplateError {
    TemplateError::together(
        "beam",
        format!("from its widest station to the {end} the hull would not get steadily narrower"),
        format!("Take a larger beam, or a narrower or higher {end}."),
    )
}

/// Points of a line between its ends, at stations closer together near them.
fn line(stern: Point3, bow: Point3, at: impl Fn(f64) -> Point3) -> Vec<Point3> {
    let mut points: Vec<Point3> = spread(stern.x, bow.x, STATIONS).map(at).collect();
    (points[0], points[STATIONS - 1]) = (stern, bow);
    points
}

/// `count` numbers between two, both included, closer together near the ends.
fn spread(from: f64, to: f64, count: usize) -> impl Iterator<Item = f64> {
    let last = (count - 1) as f64;
    (0..count).map(move |n| from + (to - from) * (1.0 - cos(PI * n as f64 / last)) / 2.0)
}

/// Where `f` changes its sign between two numbers, by halving; the second if it does not.
fn turning_point(f: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let positive = f(from) > 0.0;
    let (mut near, mut far) = (from, to);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (near + far);
        if (f(middle) > 0.0) == positive { near = middle } else { far = middle }
    }
    far
}

/// A power, the same bits on every platform.
fn power(base: f64, exponent: u32) -> f64 {
    (0..exponent).fold(1.0, |product, _| product * base)
}
