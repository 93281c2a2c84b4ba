//! Patterns as SVG, and back.
//!
//! One unit is 1 mm. `width`, `height` and `viewBox` state this in the same digits, so that a
//! drawing keeps its size in every program. Nothing is transformed, nothing is filled, and letters
//! are strokes, so that no program looks for a font.

use crate::preset::{Layer, Preset};
use crate::read_back::{Lines, MAX_BYTES, PatternReadError, ReadLine, ReadPattern, pattern};
use crate::shapes::{FileLine, Form, Shape, What, digits, extent, shapes};
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
    write_svg_for(piece, Preset::generic())
}

/// The SVG file of a piece as a preset has it.
pub fn write_svg_for(piece: &Piece, preset: &Preset) -> Vec<u8> {
    let shapes = shapes(piece);
    let layers = preset.layers(&shapes);
    let around = extent(shapes.iter().filter(|shape| preset.shows(shape.role)));
    // Whole millimetres, so that only the last bits of coordinates are rounded.
    let (left, top) = ((around.min.x - EDGE_MM).floor(), (around.max.y + EDGE_MM).ceil());
    let width = digits((around.max.x + EDGE_MM).ceil() - left);
    let height = digits(top - (around.min.y - EDGE_MM).floor());
    let place = |p: &Point2| [digits(p.x - left), digits(top - p.y)];
    let name = escaped(&piece.name);
    let groups: Vec<String> =
        layers.iter().map(|layer| format!("{} ({})", layer.name, layer.words)).collect();
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
    let outlines = shapes.iter().filter(|shape| shape.what == What::Outline).count();
    for layer in layers {
        let id = layer.name;
        // Writing to a string does not fail.
        let _ = writeln!(
            svg,
            "<g id=\"{id}\" inkscape:groupmode=\"layer\" inkscape:label=\"{id}\" {}>",
            painted(layer)
        );
        for shape in layer.shapes(&shapes).filter(|s| !s.lines.is_empty()) {
            let is_one = outlines == 1;
            svg.push_str(&drawn(shape, is_one, &preset.drawn(layer, shape), place));
        }
        svg.push_str("</g>\n");
    }
    svg.push_str("</svg>\n");
    svg.into_bytes()
}

/// The attributes that say how the lines of a layer look.
fn painted(layer: &Layer) -> String {
    let colour = layer.colour;
    if layer.filled_mm.is_some() {
        return format!("fill=\"{colour}\" stroke=\"none\"");
    }
    format!(
        "fill=\"none\" stroke=\"{colour}\" stroke-width=\"{LINE_MM}\" stroke-linecap=\"round\" \
         stroke-linejoin=\"round\""
    )
}

/// The attributes that name the kind of a shape.
fn named(shape: &Shape) -> String {
    match &shape.what {
        What::Outline => "class=\"outline\"".to_owned(),
        What::Hole => "class=\"hole\"".to_owned(),
        What::Net => "class=\"net\"".to_owned(),
        What::Drill { .. } => "class=\"drill\"".to_owned(),
        What::Notch => "class=\"notch\"".to_owned(),
        What::TrimTick => "class=\"tick\"".to_owned(),
        What::Rung(rung) => {
            let [low, high] = rung.ends().map(|s| s.get());
            format!("class=\"rung\" data-rung=\"{low} {high}\"")
        }
        What::Crease => "class=\"crease\"".to_owned(),
        What::Fold { mountain: true } => format!("class=\"fold mountain\" {MOUNTAIN}"),
        What::Fold { mountain: false } => format!("class=\"fold valley\" {VALLEY}"),
        What::Bend { up: true } => "class=\"bend up\"".to_owned(),
        What::Bend { up: false } => "class=\"bend down\"".to_owned(),
        What::BendTick => "class=\"tick\"".to_owned(),
        What::SeamTick => "class=\"seam-tick\"".to_owned(),
        What::LapEnd => "class=\"lap-end\"".to_owned(),
        What::Dimension => "class=\"dimension\"".to_owned(),
        What::Station => "class=\"station\"".to_owned(),
        What::Grain => "class=\"grain\"".to_owned(),
        What::OnFold => format!("class=\"on-fold\" {VALLEY}"),
        What::Arrow => "class=\"arrow\"".to_owned(),
        What::Leader => "class=\"leader\"".to_owned(),
        What::SheetEdge => "class=\"sheet\"".to_owned(),
        What::Label(text) => format!("class=\"label\" data-text=\"{}\"", escaped(text)),
        What::Reference => "id=\"reference\" class=\"reference\"".to_owned(),
    }
}

/// The element of a shape that these lines draw; the only outline of a file has an `id`.
fn drawn(
    shape: &Shape,
    is_one: bool,
    lines: &[FileLine],
    place: impl Fn(&Point2) -> [String; 2],
) -> String {
    let name = match shape.what {
        What::Outline if is_one => format!("id=\"outline\" {}", named(shape)),
        _ => named(shape),
    };
    if let [FileLine { points, form: Form::Circle { radius_mm }, .. }] = lines {
        let [x, y] = place(&points[0]);
        let r = digits(*radius_mm);
        return format!("<circle {name} cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>\n");
    }
    let lines = lines.iter().map(|line| {
        let points: Vec<String> = line.points.iter().map(|p| place(p).join(",")).collect();
        let close = if line.form == Form::Closed { " Z" } else { "" };
        format!("M{}{close}", points.join(" L"))
    });
    format!("<path {name} d=\"{}\"/>\n", lines.collect::<Vec<_>>().join(" "))
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

/// Reads back the outline, the holes and the rungs of a pattern that [`write_svg`] wrote, or
/// [`write_svg_for`] for the generic preset: the closed paths of `net`, or of `cut` where there is
/// no net, and the segments of the other groups between their corners. Ignores the names of the
/// paths. `width`, `height` and `viewBox` give the unit.
///
/// # Errors
/// See [`PatternReadError`]. Transforms and curves are refused, since a pattern has none.
pub fn read_svg(bytes: &[u8]) -> Result<ReadPattern, PatternReadError> {
    pattern(Lines::of_layers(svg_lines(bytes, Preset::generic())?))
}

/// The lines of a pattern that [`write_svg_for`] wrote, in the order of the layers.
pub(crate) fn svg_lines(bytes: &[u8], preset: &Preset) -> Result<Vec<ReadLine>, PatternReadError> {
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
    let mut found = Vec::new();
    for layer in preset.all_layers() {
        let mut groups = root.children().filter(|n| n.has_tag_name("g"));
        let Some(group) = groups.find(|n| n.attribute("id") == Some(layer.name)) else {
            if layer.is_optional() {
                continue;
            }
            return Err(PatternReadError::Missing(layer.name));
        };
        for node in group.descendants() {
            let lines = match node.tag_name().name() {
                "path" => lines(node.attribute("d").unwrap_or_default(), unit_mm)?,
                "circle" => vec![circle(node, unit_mm)?],
                _ => continue,
            };
            found.extend(lines.into_iter().map(|line| ReadLine { layer, line }));
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

/// A circle with y turned upwards.
fn circle(node: roxmltree::Node<'_, '_>, unit_mm: f64) -> Result<FileLine, PatternReadError> {
    let length = |name: &str| {
        let number = node.attribute(name).and_then(|text| text.parse::<f64>().ok());
        let wrong = || PatternReadError::Unexpected(format!("circle without '{name}'"));
        number.map(|number| number * unit_mm).ok_or_else(wrong)
    };
    Ok(FileLine::circle(Point2::new(length("cx")?, -length("cy")?), length("r")?))
}

/// The polylines of path data with y turned upwards.
fn lines(data: &str, unit_mm: f64) -> Result<Vec<FileLine>, PatternReadError> {
    let at = |x: f64, y: f64| Point2::new(x * unit_mm, -y * unit_mm);
    let mut lines: Vec<FileLine> = Vec::new();
    for segment in SimplifyingPathParser::from(data) {
        let segment = segment.map_err(|_| PatternReadError::Unexpected("such path".to_owned()))?;
        match (segment, lines.last_mut()) {
            (SimplePathSegment::MoveTo { x, y }, _) => {
                lines.push(FileLine::polyline(vec![at(x, y)], false));
            }
            (SimplePathSegment::LineTo { x, y }, Some(line)) if line.form == Form::Open => {
                line.points.push(at(x, y));
            }
            (SimplePathSegment::ClosePath, Some(line)) => line.form = Form::Closed,
            _ => return Err(PatternReadError::Unexpected("curve".to_owned())),
        }
    }
    Ok(lines)
}
