//! Patterns as SVG, and back.
//!
//! One unit is 1 mm. `width`, `height` and `viewBox` state this in the same digits, so that a
//! drawing keeps its size in every program. Nothing is transformed, nothing is filled, and letters
//! are strokes, so that no program looks for a font.

use crate::preset::{LAYERS, layers};
use crate::read_back::{Lines, MAX_BYTES, PatternReadError, ReadPattern, pattern};
use crate::shapes::{Shape, What, digits, extent, shapes};
use sheetwright::math::Point2;
use sheetwright::pattern::Piece;
use std::fmt::Write as _;
use svgtypes::{Length, LengthUnit, SimplePathSegment, SimplifyingPathParser, ViewBox};

/// The width of every line, mm: thin enough for every laser to follow rather than to fill.
const LINE_MM: f64 = 0.1;
/// Inkscape does not show lines thinner than a pixel. With this rule, which no other program knows,
/// it draws them one pixel wide at any zoom. The rule needs a style sheet of its own, since
/// Inkscape ignores a whole sheet that has a rule with `@supports`.
const IN_INKSCAPE: &str = "path{-inkscape-stroke:hairline}";
/// On a screen, lines are one pixel wide at any zoom: in a view of a whole plank of 4 m, a line of
/// 0.1 mm would be a small part of a pixel. Only browsers know `@supports`; programs that drive
/// machines ignore it, as CSS requires, and use [`LINE_MM`].
const ON_SCREENS: &str = "@supports (vector-effect:non-scaling-stroke){@media screen{\
path{vector-effect:non-scaling-stroke;stroke-width:1px}}}";
/// Mountain folds are dashed on paper, as paper models have them; machines follow the whole line.
const MOUNTAIN: &str = "stroke-dasharray=\"3 1.5\"";
/// Valley folds are drawn with dashes and dots.
const VALLEY: &str = "stroke-dasharray=\"4 1.5 0.3 1.5\"";
/// The gap between the drawing and the edge of the page, mm.
const EDGE_MM: f64 = 5.0;

/// The SVG file of a piece. `docs/outputs.md` specifies it for readers.
pub fn write_svg(piece: &Piece) -> Vec<u8> {
    let shapes = shapes(piece);
    let around = extent(&shapes);
    // Whole millimetres, so that only the last bits of coordinates are rounded.
    let (left, top) = ((around.min.x - EDGE_MM).floor(), (around.max.y + EDGE_MM).ceil());
    let width = digits((around.max.x + EDGE_MM).ceil() - left);
    let height = digits(top - (around.min.y - EDGE_MM).floor());
    let place = |p: &Point2| format!("{},{}", digits(p.x - left), digits(top - p.y));
    let name = escaped(&piece.name);
    let groups: Vec<String> =
        layers(&shapes).map(|layer| format!("{} ({})", layer.name, layer.words)).collect();
    let mut svg = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <svg xmlns=\"http://www.w3.org/2000/svg\" \
         xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" version=\"1.1\" \
         width=\"{width}mm\" height=\"{height}mm\" viewBox=\"0 0 {width} {height}\">\n\
         <title>{name}</title>\n\
         <desc>Flat pattern of {name}, {:.1} × {:.1} mm, by Sheetwright. Units: mm, true scale. \
         Groups: {}.</desc>\n\
         <style>{IN_INKSCAPE}</style>\n\
         <style>{ON_SCREENS}</style>\n",
        piece.size.x,
        piece.size.y,
        groups.join(", ")
    );
    for layer in layers(&shapes) {
        let (id, stroke) = (layer.name, layer.colour);
        // Writing to a string does not fail.
        let _ = writeln!(
            svg,
            "<g id=\"{id}\" inkscape:groupmode=\"layer\" inkscape:label=\"{id}\" fill=\"none\" \
             stroke=\"{stroke}\" stroke-width=\"{LINE_MM}\" stroke-linecap=\"round\" \
             stroke-linejoin=\"round\">"
        );
        for shape in layer.shapes(&shapes).filter(|s| !s.lines.is_empty()) {
            let _ = writeln!(svg, "<path {} d=\"{}\"/>", named(shape), drawn(shape, place));
        }
        svg.push_str("</g>\n");
    }
    svg.push_str("</svg>\n");
    svg.into_bytes()
}

/// The attributes that name the kind of a shape.
fn named(shape: &Shape) -> String {
    match &shape.what {
        What::Outline => "id=\"outline\" class=\"outline\"".to_owned(),
        What::Hole => "class=\"hole\"".to_owned(),
        What::Net => "class=\"net\"".to_owned(),
        What::Drill => "class=\"drill\"".to_owned(),
        What::Notch => "class=\"notch\"".to_owned(),
        What::TrimTick => "class=\"tick\"".to_owned(),
        What::Rung(rung) => {
            let [low, high] = rung.ends().map(|s| s.get());
            format!("class=\"rung\" data-rung=\"{low} {high}\"")
        }
        What::Crease => "class=\"crease\"".to_owned(),
        What::Fold { mountain: true } => format!("class=\"fold mountain\" {MOUNTAIN}"),
        What::Fold { mountain: false } => format!("class=\"fold valley\" {VALLEY}"),
        What::RulingTick => "class=\"tick\"".to_owned(),
        What::SeamTick => "class=\"seam-tick\"".to_owned(),
        What::Dimension => "class=\"dimension\"".to_owned(),
        What::Label(text) => format!("class=\"label\" data-text=\"{}\"", escaped(text)),
        What::Reference => "id=\"reference\" class=\"reference\"".to_owned(),
    }
}

fn drawn(shape: &Shape, place: impl Fn(&Point2) -> String) -> String {
    let lines = shape.lines.iter().map(|line| {
        let points: Vec<String> = line.iter().map(&place).collect();
        let close = if shape.closed { " Z" } else { "" };
        format!("M{}{close}", points.join(" L"))
    });
    lines.collect::<Vec<_>>().join(" ")
}

/// A text escaped for XML; a visible mark replaces characters that XML does not allow.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\u{FFFE}' | '\u{FFFF}' => out.push('\u{FFFD}'),
            c if c.is_control() => out.push('\u{FFFD}'),
            c => out.push(c),
        }
    }
    out
}

/// Reads back the outline, the holes and the rungs of a pattern that [`write_svg`] wrote: the
/// closed paths of `net`, or of `cut` where there is no net, and the segments of the other groups
/// between their corners. Ignores the names of the paths. `width`, `height` and `viewBox` give the unit.
///
/// # Errors
/// See [`PatternReadError`]. Transforms and curves are refused, since a pattern has none.
pub fn read_svg(bytes: &[u8]) -> Result<ReadPattern, PatternReadError> {
    pattern(svg_lines(bytes)?)
}

/// The lines of a pattern that [`write_svg`] wrote, not yet told apart into outline, holes and
/// rungs.
pub(crate) fn svg_lines(bytes: &[u8]) -> Result<Lines, PatternReadError> {
    if bytes.len() > MAX_BYTES {
        return Err(PatternReadError::TooLarge);
    }
    let text = std::str::from_utf8(bytes).map_err(|_| PatternReadError::NotText)?;
    let document =
        roxmltree::Document::parse(text).map_err(|e| PatternReadError::Xml(e.to_string()))?;
    let root = document.root_element();
    if !root.has_tag_name(("http://www.w3.org/2000/svg", "svg")) {
        return Err(PatternReadError::Missing("svg"));
    }
    let unit_mm = unit_mm(root)?;
    if let Some(node) = root.descendants().find(|n| n.has_attribute("transform")) {
        return Err(PatternReadError::Unexpected(format!(
            "transform on '{}'",
            node.tag_name().name()
        )));
    }
    let mut found = Lines::default();
    for layer in &LAYERS {
        let mut groups = root.children().filter(|n| n.has_tag_name("g"));
        let Some(group) = groups.find(|n| n.attribute("id") == Some(layer.name)) else {
            if layer.is_optional() {
                continue;
            }
            return Err(PatternReadError::Missing(layer.name));
        };
        for path in group.descendants().filter(|n| n.has_tag_name("path")) {
            for (points, closed) in lines(path.attribute("d").unwrap_or_default(), unit_mm)? {
                found.add(layer, points, closed);
            }
        }
    }
    Ok(found)
}

/// The size of a unit of the view box, mm.
fn unit_mm(root: roxmltree::Node<'_, '_>) -> Result<f64, PatternReadError> {
    let units = PatternReadError::Units;
    let view: ViewBox =
        root.attribute("viewBox").and_then(|v| v.parse().ok()).ok_or(units.clone())?;
    let size = |name: &str| {
        let length: Length = root.attribute(name)?.parse().ok()?;
        let mm = match length.unit {
            LengthUnit::Mm => 1.0,
            LengthUnit::Cm => 10.0,
            LengthUnit::In => 25.4,
            LengthUnit::Pt => 25.4 / 72.0,
            LengthUnit::Pc => 25.4 / 6.0,
            LengthUnit::Px | LengthUnit::None => 25.4 / 96.0,
            LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => return None,
        };
        Some(length.number * mm)
    };
    let (Some(width), Some(height)) = (size("width"), size("height")) else { return Err(units) };
    let (across, up) = (width / view.w, height / view.h);
    // The tolerance is for the rounding of two quotients; a larger difference distorts the drawing.
    let agree = (across - up).abs() <= 1e-12 * up;
    if agree && across > 0.0 && across.is_finite() { Ok(across) } else { Err(units) }
}

/// The polylines of path data with y turned upwards, mm, and whether each is closed.
fn lines(data: &str, unit_mm: f64) -> Result<Vec<(Vec<Point2>, bool)>, PatternReadError> {
    let at = |x: f64, y: f64| Point2::new(x * unit_mm, -y * unit_mm);
    let mut lines: Vec<(Vec<Point2>, bool)> = Vec::new();
    for segment in SimplifyingPathParser::from(data) {
        let segment = segment.map_err(|_| PatternReadError::Unexpected("such path".to_owned()))?;
        match (segment, lines.last_mut()) {
            (SimplePathSegment::MoveTo { x, y }, _) => lines.push((vec![at(x, y)], false)),
            (SimplePathSegment::LineTo { x, y }, Some((points, false))) => points.push(at(x, y)),
            (SimplePathSegment::ClosePath, Some((_, closed))) => *closed = true,
            _ => return Err(PatternReadError::Unexpected("curve".to_owned())),
        }
    }
    Ok(lines)
}
