//! The design of a table of offsets: a plank between each two edges, as the template `hull` draws
//! them, and the stations as marks.

use super::lines::{HullLine, HullTable};
use super::{GivenUnits, read_hull_table};
use crate::reading::{InputError, ReadOptions, display_name, named_after};
use sheetwright::curve::CurveKind;
use sheetwright::design::{
    Axis, Design, DesignCurve, Mark, MarkKind, MarkOn, StationPlaces, StationPlane,
};
use sheetwright::template::{NamedCurve, TemplateError, Value, template};

/// The template that draws planks.
const HULL: &str = "hull";

/// A table of offsets as a design.
///
/// # Errors
/// What is not understood of the table, or lines between which no planks can be drawn.
pub(crate) fn read_as_design(
    bytes: &[u8],
    name: &str,
    is_workbook: bool,
    options: &ReadOptions,
) -> Result<Design, InputError> {
    let units = GivenUnits { asked: options.units, usual: None };
    let second = options.second_table.as_ref();
    let table = read_hull_table(bytes, name, is_workbook, second, units)?;
    let called = named_after(name)?;
    let edges = downwards(&table);
    let mut design = match edges.len() {
        0 | 1 => Design::default(),
        _ => planked(&edges).map_err(|error| in_words(&error, name))?,
    };
    // A single edge bounds no plank.
    let left = table.lines.iter().filter(|line| edges.len() < 2 || !line.is_edge);
    design.curves.extend(left.map(curve));
    design.marks = stations(&design, &table);
    design.name = called;
    for panel in &mut design.panels {
        options.set_panel(panel);
    }
    design.vary = options.vary.applied(Vec::new());
    Ok(design)
}

/// The edges of planks, from the highest to the lowest; where two are equally high, as at a chine
/// that the table gives twice, the order of the table decides.
fn downwards(table: &HullTable) -> Vec<&HullLine> {
    let mut edges: Vec<&HullLine> = table.lines.iter().filter(|line| line.is_edge).collect();
    let height = |line: &HullLine| {
        let heights = line.points.iter().map(|point| point.at.z);
        heights.sum::<f64>() / line.points.len() as f64
    };
    // A table from the keel up has equal lines the other way round.
    if let [first, .., last] = edges[..]
        && height(first) < height(last)
    {
        edges.reverse();
    }
    edges.sort_by(|a, b| height(b).total_cmp(&height(a)));
    edges
}

fn planked(edges: &[&HullLine]) -> Result<Design, TemplateError> {
    let lines = edges
        .iter()
        .map(|line| NamedCurve { name: line.name.clone(), points: line.points.clone() })
        .collect();
    let Some(hull) = template(HULL) else { return Ok(Design::default()) };
    let mut values = hull.defaults();
    values.set("table", Value::Table(lines))?;
    values.set("transoms", Value::Choice("yes".to_owned()))?;
    values.design()
}

fn in_words(error: &TemplateError, name: &str) -> InputError {
    let (message, hint) = match error {
        TemplateError::Together { message, hint, .. } => (message.clone(), hint.clone()),
        error => (error.to_string(), "Give the table fewer lines.".to_owned()),
    };
    InputError::at(display_name(name), message, hint)
}

fn curve(line: &HullLine) -> DesignCurve {
    DesignCurve {
        name: line.name.clone(),
        kind: Some(CurveKind::Spline),
        closed: false,
        points: line.points.clone(),
    }
}

/// The stations between the ends of the hull, as marks on all planks.
fn stations(design: &Design, table: &HullTable) -> Vec<Mark> {
    if design.panels.is_empty() {
        return Vec::new();
    }
    let edges = table.lines.iter().filter(|line| line.is_edge);
    let places = edges.flat_map(|line| line.points.iter().map(|point| point.at.x));
    let [low, high] =
        places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
    let inside = table.stations.iter().filter(|(_, at)| low < *at && *at < high);
    let plane = |(name, at): &(String, f64)| {
        let is_number = name.starts_with(|c: char| c.is_ascii_digit());
        let name = if is_number { format!("station {name}") } else { name.clone() };
        StationPlane { at: *at, name: Some(name) }
    };
    let planes: Vec<StationPlane> = inside.map(plane).collect();
    if planes.is_empty() {
        return Vec::new();
    }
    let kind = MarkKind::Stations { axis: Axis::X, at: StationPlaces::Listed { planes } };
    vec![Mark { on: vec![MarkOn::All], kind }]
}
