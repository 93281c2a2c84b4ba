//! The basic shapes of SVG as strokes, in their own coordinates.

use super::super::drawn::MAX_SEGMENTS;
use super::super::segment::Segment;
use super::page::{Lengths, Side};
use super::path::{Stroke, strokes};
use roxmltree::Node;
use sheetwright::math::{Point3, Vec3};
use std::f64::consts::{FRAC_PI_2, PI};
use svgtypes::NumberListParser;

/// The shapes that are drawn.
pub(super) const SHAPES: [&str; 7] =
    ["path", "rect", "circle", "ellipse", "line", "polyline", "polygon"];

/// The strokes of a shape; none of one that SVG does not draw, such as a circle without a radius.
///
/// # Errors
/// What is wrong with its attributes, in words.
pub(super) fn drawn(node: Node<'_, '_>, lengths: &Lengths) -> Result<Vec<Stroke>, String> {
    let of = |name: &str, side| lengths.of(node, name, side);
    let at = |name: &str, side| Ok::<f64, String>(of(name, side)?.unwrap_or(0.0));
    let place = |x: &str, y: &str| {
        Ok::<Point3, String>(Point3::new(at(x, Side::Width)?, at(y, Side::Height)?, 0.0))
    };
    match node.tag_name().name() {
        "path" => strokes(node.attribute("d").unwrap_or_default()),
        "line" => Ok(vec![chain(&[place("x1", "y1")?, place("x2", "y2")?], false)]),
        "polyline" | "polygon" => {
            // One more than a drawing may have is refused. SVG leaves an odd number out.
            let numbers = NumberListParser::from(node.attribute("points").unwrap_or(""));
            let numbers = numbers.take(2 * (MAX_SEGMENTS + 2)).collect::<Result<Vec<f64>, _>>();
            let numbers = numbers.map_err(|error| format!("its points: {error}"))?;
            let points: Vec<Point3> =
                numbers.chunks_exact(2).map(|p| Point3::new(p[0], p[1], 0.0)).collect();
            Ok(vec![chain(&points, node.tag_name().name() == "polygon")])
        }
        "circle" => {
            let radius = at("r", Side::Diagonal)?;
            Ok(ellipse(place("cx", "cy")?, radius, radius))
        }
        "ellipse" => {
            let (rx, ry) = (of("rx", Side::Width)?, of("ry", Side::Height)?);
            let (rx, ry) = (rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0));
            Ok(ellipse(place("cx", "cy")?, rx, ry))
        }
        _ => {
            let (rx, ry) = (of("rx", Side::Width)?, of("ry", Side::Height)?);
            let radii = [rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0)];
            let size = [at("width", Side::Width)?, at("height", Side::Height)?];
            Ok(rectangle(place("x", "y")?, size, radii))
        }
    }
}

fn chain(points: &[Point3], closed: bool) -> Stroke {
    let mut segments: Vec<Segment> =
        points.windows(2).map(|pair| Segment::line(pair[0], pair[1])).collect();
    if let (true, [first, .., last]) = (closed, points) {
        segments.push(Segment::line(*last, *first));
    }
    Stroke { segments, closed }
}

fn ellipse(centre: Point3, rx: f64, ry: f64) -> Vec<Stroke> {
    if !(rx > 0.0 && ry > 0.0) {
        return Vec::new();
    }
    let arc = Segment::arc(centre, Vec3::X * rx, Vec3::Y * ry, [0.0, 2.0 * PI]);
    vec![Stroke { segments: vec![arc], closed: true }]
}

fn rectangle(corner: Point3, [width, height]: [f64; 2], [rx, ry]: [f64; 2]) -> Vec<Stroke> {
    if !(width > 0.0 && height > 0.0) {
        return Vec::new();
    }
    let (rx, ry) = (rx.clamp(0.0, 0.5 * width), ry.clamp(0.0, 0.5 * height));
    let at = |x: f64, y: f64| corner + Vec3::new(x, y, 0.0);
    let (w, h) = (width, height);
    if rx == 0.0 || ry == 0.0 {
        return vec![chain(&[at(0.0, 0.0), at(w, 0.0), at(w, h), at(0.0, h)], true)];
    }
    // Each side, and the arc round the corner that it leads to.
    let sides = [
        ([at(rx, 0.0), at(w - rx, 0.0)], at(w - rx, ry), -FRAC_PI_2),
        ([at(w, ry), at(w, h - ry)], at(w - rx, h - ry), 0.0),
        ([at(w - rx, h), at(rx, h)], at(rx, h - ry), FRAC_PI_2),
        ([at(0.0, h - ry), at(0.0, ry)], at(rx, ry), PI),
    ];
    let nexts = [sides[1].0[0], sides[2].0[0], sides[3].0[0], sides[0].0[0]];
    let pieces = sides.into_iter().zip(nexts).flat_map(|(([from, to], centre, angle), next)| {
        let angles = [angle, angle + FRAC_PI_2];
        let mut arc = Segment::arc(centre, Vec3::X * rx, Vec3::Y * ry, angles);
        arc.move_end(false, to);
        arc.move_end(true, next);
        [Segment::line(from, to), arc]
    });
    vec![Stroke { segments: pieces.collect(), closed: true }]
}
