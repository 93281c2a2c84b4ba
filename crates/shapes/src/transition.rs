//! The square-to-round duct as duct shops have drawn it for a century, for comparison.
//!
//! The classical triangulation divides the round end evenly, a quarter for each corner of the
//! rectangle, and finds the true length of every line from a corner to the points of its quarter by
//! Pythagoras. The pattern is laid out triangle by triangle, with straight chords for the arcs.

use sheetwright::design::Design;
use sheetwright::make::{Found, Part, make};
use sheetwright::math::{Point2, Point3, Vec3, angle_between, cos, sin};
use sheetwright::template::{Value, template};
use sheetwright::watch::Unwatched;
use std::f64::consts::TAU;

/// A square-to-round duct with its round end in a parallel plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transition {
    /// Width and depth of the rectangle, mm.
    pub rectangle: [f64; 2],
    /// Diameter of the round end, mm.
    pub diameter: f64,
    /// Its height above the rectangle, mm.
    pub height: f64,
    /// The offset of its middle from that of the rectangle, mm.
    pub offset: [f64; 2],
    /// Its tilt towards x, degrees.
    pub tilt_deg: f64,
}

/// Lengths of a pattern by which two of them are compared, mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Lengths {
    /// From the first corner of the rectangle to the division points of its quarter, in order.
    pub elements: Vec<f64>,
    /// The developed round end.
    pub round: f64,
    /// Between the two ends of the developed round end, straight across the pattern.
    pub round_span: f64,
    /// Between the two ends of the developed rectangle, straight across the pattern.
    pub square_span: f64,
}

impl Transition {
    /// The design that the template draws.
    pub fn design(&self) -> Design {
        let mut values = template("square-to-round").expect("it is in the catalogue").defaults();
        for (name, value) in [
            ("width", self.rectangle[0]),
            ("depth", self.rectangle[1]),
            ("diameter", self.diameter),
            ("height", self.height),
            ("offset-x", self.offset[0]),
            ("offset-y", self.offset[1]),
            ("tilt", self.tilt_deg),
        ] {
            values.set(name, Value::Number(value)).expect("the duct takes it");
        }
        values.design().expect("the duct is drawn")
    }

    /// The lengths of the classical pattern with so many divisions, a multiple of four.
    pub fn classical(&self, divisions: usize) -> Lengths {
        assert!(self.tilt_deg == 0.0 && divisions.is_multiple_of(4));
        let (x, y) = (self.rectangle[0] / 2.0, self.rectangle[1] / 2.0);
        let on_round = |n: usize| {
            let angle = TAU * n as f64 / divisions as f64;
            let r = self.diameter / 2.0;
            Point3::new(
                self.offset[0] + r * cos(angle),
                self.offset[1] + r * sin(angle),
                self.height,
            )
        };
        let corners = [[x, y], [-x, y], [-x, -y], [x, -y]].map(|[x, y]| Point3::new(x, y, 0.0));
        let seam = Point3::new(x, 0.0, 0.0);
        // The strip from the seam round: every triangle adds a point, below or above.
        let quarter = divisions / 4;
        let mut strip = vec![(seam, false), (on_round(0), true)];
        for (q, corner) in corners.into_iter().enumerate() {
            strip.push((corner, false));
            strip.extend((1..=quarter).map(|n| (on_round(q * quarter + n), true)));
        }
        strip.push((seam, false));
        let flat = laid_out(&strip);
        let of = |high: bool| {
            let side = strip.iter().zip(&flat).filter(move |((_, is_high), _)| *is_high == high);
            side.map(|(_, &p)| p).collect::<Vec<Point2>>()
        };
        let (square, round) = (of(false), of(true));
        Lengths {
            elements: (0..=quarter).map(|n| corners[0].distance(on_round(n))).collect(),
            round: round.windows(2).map(|pair| pair[0].distance(pair[1])).sum(),
            round_span: round[0].distance(round[round.len() - 1]),
            square_span: square[0].distance(square[square.len() - 1]),
        }
    }

    /// The duct, made with so many samples of each rail (one more than a multiple of eight times
    /// the divisions that it is compared with).
    pub fn made(&self, samples: usize) -> Part {
        let mut design = self.design();
        design.panels[0].samples = samples;
        make(&design, &mut Unwatched).expect("the duct is made").parts.remove(0)
    }
}

/// Points of a strip laid flat: each new point keeps its distances to the last point below and the
/// last above.
fn laid_out(strip: &[(Point3, bool)]) -> Vec<Point2> {
    let first = strip[0].0.distance(strip[1].0);
    let mut flat = vec![Point2::new(0.0, 0.0), Point2::new(0.0, first)];
    let (mut low, mut high) = (0, 1);
    for (n, &(point, is_high)) in strip.iter().enumerate().skip(2) {
        let (from_low, from_high) = (point.distance(strip[low].0), point.distance(strip[high].0));
        let (a, b) = (flat[low], flat[high]);
        let base = a.distance(b);
        let along = (base * base + from_low * from_low - from_high * from_high) / (2.0 * base);
        let across = (from_low * from_low - along * along).max(0.0).sqrt();
        let way = (b - a) / base;
        // The strip grows to the right of the way up.
        flat.push(a + way * along + way.perp() * -across);
        if is_high { high = n } else { low = n }
    }
    flat
}

fn found(duct: &Part) -> &Found {
    duct.found().expect("a duct is bounded by curves")
}

/// The samples at the corners of the rectangle. The ends of the seam, corners of the loop, are
/// none.
fn corners(duct: &Part) -> [usize; 4] {
    let samples = found(duct).boundary.samples();
    let inner = 1..samples.len() / 2 - 1;
    let corners: Vec<usize> = inner.filter(|&i| samples[i].is_corner()).collect();
    corners.try_into().expect("a rectangle has four corners")
}

/// The lengths of a made duct at the same divisions of its round end.
pub fn lengths(duct: &Part, divisions: usize) -> Lengths {
    let flat = &duct.flat.points;
    let m = flat.len();
    let on_rail = m / 2;
    // The second rail runs back along the loop.
    let round: Vec<usize> = (on_rail..m).rev().collect();
    let step = (round.len() - 1) / divisions;
    let corner = corners(duct)[0];
    Lengths {
        elements: (0..=divisions / 4)
            .map(|n| flat[corner].distance(flat[round[n * step]]))
            .collect(),
        round: round.windows(2).map(|pair| flat[pair[0]].distance(flat[pair[1]])).sum(),
        round_span: flat[m - 1].distance(flat[on_rail]),
        square_span: flat[0].distance(flat[on_rail - 1]),
    }
}

/// The share of the area of a made duct that belongs neither to a flat triangle on a side of the
/// rectangle nor to a cone from one of its corners. What is on a side is flat where it leans by no
/// more than `flat`, radians, from what most of that side does: where a side touches the round end
/// between two samples, it goes to both, and leans by about half the turn from one to the next.
pub fn neither_flat_nor_conical(duct: &Part, flat: f64) -> f64 {
    let space = found(duct).boundary.positions();
    let on_rail = space.len() / 2;
    let corners = corners(duct);
    let area = |t: [usize; 3]| {
        let [a, b, c] = t.map(|i| space[i]);
        (b - a).cross(c - a) / 2.0
    };
    // The areas on each side of the rectangle that are not those of a cone.
    let mut sides: Vec<Vec<Vec3>> = vec![Vec::new(); 4];
    let mut whole = 0.0;
    for triangle in found(duct).surface.connectivity().triangles() {
        let triangle = triangle.map(|s| s.get());
        let area = area(triangle);
        whole += area.length();
        let low: Vec<usize> = triangle.into_iter().filter(|&i| i < on_rail).collect();
        if low.len() == 1 && corners.contains(&low[0]) {
            continue;
        }
        let from = low.iter().copied().min().unwrap_or(0);
        sides[corners.iter().filter(|&&c| c <= from).count() % 4].push(area);
    }
    let beside = sides.iter().flat_map(|side| {
        let mean: Vec3 = side.iter().sum();
        side.iter().filter(move |area| angle_between(**area, mean) > flat).map(|a| a.length())
    });
    // An empty sum is −0.
    (beside.sum::<f64>() + 0.0) / whole
}
