//! Makes curves in space of the stations and lines of a table: x is the place of the station, y the
//! half-breadth, z the height.

use super::bare::{Bare, GivenUnits, made_mm, number_of};
use super::label::{LineKind, Quantity};
use super::layout::{Layout, LineRow, Placed, Station};
use super::notation::{Cell, cell};
use super::said::{Refusal, at_station, listed};
use crate::names::shown;
use crate::units::Units;
use sheetwright::curve::CurvePoint;
use sheetwright::math::Point3;
use std::collections::{BTreeMap, BTreeSet};

/// Names of stations are their places where the largest number is at least this.
const PLAINLY_PLACES: f64 = 100.0;

/// The most stations and lines of a table; a hull has some tens of both.
const MOST: usize = 1000;
/// The most notes about rows that are not used.
const MOST_UNUSED: usize = 5;

/// A line of a hull.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct HullLine {
    /// Its name.
    pub(crate) name: String,
    /// Its points, mm, by their stations.
    pub(crate) points: Vec<CurvePoint>,
    /// Whether it is an edge of planks; else it lies on the skin, as waterlines and buttocks do.
    pub(crate) is_edge: bool,
}

/// The lines of a hull and the stations at which they were measured.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct HullTable {
    /// The lines, in the order of the table.
    pub(crate) lines: Vec<HullLine>,
    /// The name and the place of each station, mm, by their places.
    pub(crate) stations: Vec<(String, f64)>,
    /// What was understood that the table does not say in so many words.
    pub(crate) notes: Vec<String>,
}

/// The cells of one line at each station.
struct Line<'a> {
    name: String,
    kind: LineKind,
    place: String,
    /// For each quantity of [`OF_LINE`], the cells of the stations.
    cells: [Vec<Option<&'a Placed>>; 3],
    /// Whether breadths are whole.
    is_whole: bool,
}

/// The quantities of a line; the whole breadth counts as the half one.
const OF_LINE: [Quantity; 3] = [Quantity::Along, Quantity::HalfBreadth, Quantity::Height];
const ALONG: usize = 0;
const HALF: usize = 1;
const HEIGHT: usize = 2;

/// The lines of a table.
///
/// # Errors
/// The first thing that is not understood.
pub(super) fn lines(layout: &Layout, units: GivenUnits) -> Result<HullTable, Refusal> {
    refuse_wrong_cells(layout)?;
    let mut notes: Vec<String> = layout.unused.iter().take(MOST_UNUSED).cloned().collect();
    if layout.unused.len() > MOST_UNUSED {
        notes.push(format!("left out: {} more rows", layout.unused.len() - MOST_UNUSED));
    }
    let unit = Bare::of(layout, units, &mut notes);
    let places = places(layout, &unit, &mut notes)?;
    let grouped = grouped(layout)?;
    let mut lines = Vec::new();
    for line in &grouped {
        if line.kind == LineKind::Diagonal {
            notes.push(format!(
                "the diagonal {} is left out: no table gives its plane",
                shown(&line.name)
            ));
            continue;
        }
        let fixed = fixed(line, &grouped, layout, &unit, &mut notes)?;
        let points = points(line, layout, &places, &unit, fixed)?;
        if points.len() < 2 {
            notes.push(format!(
                "the line {} is left out: it has fewer than two points",
                shown(&line.name)
            ));
            continue;
        }
        let is_edge = matches!(line.kind, LineKind::Edge | LineKind::Middle);
        lines.push(HullLine { name: line.name.clone(), points, is_edge });
    }
    if lines.is_empty() {
        return Err(Refusal::of_table("no line of the table has two points or more"));
    }
    turn_up(&mut lines, &mut notes);
    let mut stations: Vec<(String, f64)> = layout
        .stations
        .iter()
        .zip(&places)
        .filter_map(|(station, at)| at.map(|at| (station.head.typed.clone(), at)))
        .collect();
    stations.sort_by(|a, b| a.1.total_cmp(&b.1));
    Ok(HullTable { lines, stations, notes })
}

/// Refuses cells that are no lengths, naming the first three.
fn refuse_wrong_cells(layout: &Layout) -> Result<(), Refusal> {
    if layout.stations.is_empty() {
        return Err(Refusal::of_table("the table names no stations"));
    }
    if layout.rows.is_empty() {
        return Err(Refusal::of_table("the table names no lines"));
    }
    let is_diagonal = |row: &&LineRow| row.label.kind == LineKind::Diagonal;
    let names: BTreeSet<String> = layout.rows.iter().map(|row| key(&row.label.name)).collect();
    let lines = names.len() + layout.rows.iter().filter(is_diagonal).count();
    for (count, what) in [(layout.stations.len(), "stations"), (lines, "lines")] {
        if count > MOST {
            let message = format!("the table names more than {MOST} {what}");
            return Err(Refusal::of_table(&message));
        }
    }
    let of_rows = layout.rows.iter().flat_map(|row| row.cells.iter().map(|(_, placed)| placed));
    let places = layout.stations.iter().filter_map(|station| station.at.as_ref());
    let why = |placed: &Placed| match &placed.cell {
        Cell::Wrong(why) => Some(why.clone()),
        Cell::Text => Some("is no length".to_owned()),
        _ => None,
    };
    let wrong: Vec<(&Placed, String)> =
        places.chain(of_rows).filter_map(|placed| Some((placed, why(placed)?))).collect();
    if let Some((first, why)) = wrong.first() {
        let more = match wrong.len() - 1 {
            0 => String::new(),
            1 => format!("; and {} at {}", shown(&wrong[1].0.typed), wrong[1].0.place),
            more => format!("; and {more} more cells"),
        };
        return Err(Refusal::at(&first.place, format!("{} {why}{more}", shown(&first.typed))));
    }
    match layout.astray.first() {
        Some(astray) => {
            let message = format!("{} stands under no station", shown(&astray.typed));
            Err(Refusal::at(&astray.place, message))
        }
        None => Ok(()),
    }
}

/// The places of the stations, mm; `None` of a station that no line needs.
fn places(
    layout: &Layout,
    unit: &Bare,
    notes: &mut Vec<String>,
) -> Result<Vec<Option<f64>>, Refusal> {
    let stations = &layout.stations;
    let numbers: Vec<Option<f64>> =
        stations.iter().map(|station| number_of(&station.name)).collect();
    let spacing = layout.spacing[0].as_ref().map(|placed| unit.mm(placed)).transpose()?.flatten();
    let is_given = stations.iter().any(|station| station.at.is_some());
    let are_lengths =
        stations.iter().all(|station| matches!(cell(&station.name, false), Cell::Length { .. }));
    let largest = numbers.iter().flatten().fold(0.0_f64, |most, n| most.max(n.abs()));
    let are_places = numbers.iter().all(Option::is_some) && largest >= PLAINLY_PLACES;
    let mut places = Vec::new();
    for (n, station) in stations.iter().enumerate() {
        let typed = Placed { cell: cell(&station.name, false), ..station.head.clone() };
        places.push(match (&station.at, spacing, numbers[n]) {
            (Some(at), ..) => unit.mm(at)?,
            (None, Some(spacing), Some(number)) if !is_given => {
                let Placed { typed, place, .. } = &station.head;
                Some(made_mm(number * spacing, typed, place)?)
            }
            (None, None, _) if !is_given && (are_lengths || are_places) => unit.mm(&typed)?,
            _ if !is_used(layout, n) => None,
            _ => return Err(without_place(station, is_given || spacing.is_some(), stations)),
        });
    }
    if !is_given && spacing.is_none() && are_places && !are_lengths {
        notes.push("the numbers of the stations are read as their places".to_owned());
    }
    for (n, at) in places.iter().enumerate() {
        if let (Some(at), Some(twin)) = (at, places[..n].iter().position(|other| other == at))
            && at.is_finite()
        {
            let [a, b] = [&stations[twin].head, &stations[n].head].map(|head| shown(&head.typed));
            let message = format!("the stations {a} and {b} are in one place, at {at} mm");
            return Err(Refusal::at(&stations[n].head.place, message));
        }
    }
    Ok(places)
}

/// Whether some line has a length at a station.
fn is_used(layout: &Layout, station: usize) -> bool {
    let is_length = |placed: &Placed| placed.cell != Cell::None;
    let mut cells = layout.rows.iter().flat_map(|row| &row.cells);
    cells.any(|(of, placed)| *of == station && is_length(placed))
}

fn without_place(station: &Station, has_others: bool, stations: &[Station]) -> Refusal {
    let name = shown(&station.head.typed);
    let message = if has_others {
        format!("the place of the station {name} is not known")
    } else {
        let names: Vec<String> = stations.iter().map(|station| station.name.clone()).collect();
        format!(
            "nothing says where the stations are: {} may be places or mere numbers",
            listed(&names)
        )
    };
    Refusal::at(&station.head.place, message).with(
        "Add a row or column 'Position' with the place of each station, or a line 'Station \
         spacing, 600 mm' above the table where all stations have numbers.",
    )
}

/// The rows by lines, in the order of the table.
fn grouped(layout: &Layout) -> Result<Vec<Line<'_>>, Refusal> {
    let count = layout.stations.len();
    let mut lines: Vec<Line<'_>> = Vec::new();
    let mut known: BTreeMap<String, usize> = BTreeMap::new();
    for row in &layout.rows {
        let name = row.label.name.clone();
        if row.label.kind == LineKind::Diagonal {
            lines.push(Line::new(name, row.label.kind, &row.place, count));
            continue;
        }
        let Some(quantity) = row.quantity else {
            let message =
                format!("nothing says whether {} are heights or half-breadths", shown(&name));
            return Err(Refusal::at(&row.place, message).with(
                "Write 'Heights' or 'Half-breadths' in a line above its block, or in the name, \
                 such as 'Chine half-breadth'.",
            ));
        };
        let next = lines.len();
        let n = *known.entry(key(&name)).or_insert(next);
        if n == next {
            lines.push(Line::new(name.clone(), row.label.kind, &row.place, count));
        }
        let line = &mut lines[n];
        line.is_whole |= quantity == Quantity::Breadth;
        let half = if quantity == Quantity::Breadth { Quantity::HalfBreadth } else { quantity };
        let of = OF_LINE.iter().position(|known| *known == half).unwrap_or(HEIGHT);
        for (station, placed) in row.cells.iter().filter(|(_, placed)| placed.cell != Cell::None) {
            if let Some(other) = line.cells[of][*station].replace(placed) {
                let what = said(half);
                let message = format!(
                    "{} of {} at station {} is given twice, first at {}",
                    what,
                    shown(&name),
                    shown(&layout.stations[*station].head.typed),
                    other.place
                );
                return Err(Refusal::at(&placed.place, message));
            }
        }
    }
    Ok(lines)
}

/// A name as its rows may write it: `W.L. 2` is `WL 2`, but `WL 2.5` is not `WL 25`.
fn key(name: &str) -> String {
    let lower: Vec<char> = name.to_lowercase().chars().collect();
    let is_digit =
        |n: Option<usize>| n.and_then(|n| lower.get(n)).is_some_and(char::is_ascii_digit);
    let is_kept = |n: &usize| match lower[*n] {
        ' ' => false,
        '-' | '.' => is_digit(n.checked_sub(1)) && is_digit(Some(n + 1)),
        _ => true,
    };
    (0..lower.len()).filter(is_kept).map(|n| lower[n]).collect()
}

impl Line<'_> {
    fn new(name: String, kind: LineKind, place: &str, stations: usize) -> Self {
        let cells = [vec![None; stations], vec![None; stations], vec![None; stations]];
        Self { name, kind, place: place.to_owned(), cells, is_whole: false }
    }

    fn has(&self, of: usize) -> bool {
        self.cells[of].iter().any(Option::is_some)
    }
}

fn said(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Along => "the place",
        Quantity::HalfBreadth | Quantity::Breadth => "the half-breadth",
        Quantity::Height => "the height",
    }
}

/// What a line has at every station: the quantity and its value, mm.
type Fixed = Option<(usize, f64)>;

fn fixed(
    line: &Line<'_>,
    lines: &[Line<'_>],
    layout: &Layout,
    unit: &Bare,
    notes: &mut Vec<String>,
) -> Result<Fixed, Refusal> {
    let (of, spacing, what) = match line.kind {
        LineKind::Waterline => (HEIGHT, &layout.spacing[1], "height"),
        LineKind::Buttock => (HALF, &layout.spacing[2], "half-breadth"),
        LineKind::Middle if !line.has(HALF) => {
            notes.push(format!(
                "{} has no half-breadths: it lies in the middle plane",
                shown(&line.name)
            ));
            return Ok(Some((HALF, 0.0)));
        }
        LineKind::Middle | LineKind::Edge | LineKind::Diagonal => return Ok(None),
    };
    if line.has(of) {
        return Ok(None);
    }
    let typed = name_behind_words(&line.name);
    let placed = |text: &str, place: &str| Placed {
        cell: cell(text, false),
        typed: text.to_owned(),
        place: place.to_owned(),
        unit: None,
    };
    let own = placed(&typed, &line.place);
    if matches!(own.cell, Cell::Length { .. }) {
        return Ok(unit.mm(&own)?.map(|mm| (of, mm)));
    }
    if let (Some(spacing), Some(number)) = (spacing, number_of(&typed)) {
        let Some(spacing) = unit.mm(spacing)? else { return Ok(None) };
        return Ok(Some((of, made_mm(number * spacing, &line.name, &line.place)?)));
    }
    // 1, 2, 3 are numbers of lines; 12, 18, 24 are lengths.
    let of_kind = lines.iter().filter(|other| other.kind == line.kind);
    let numbers: Vec<f64> =
        of_kind.filter_map(|other| number_of(&name_behind_words(&other.name))).collect();
    let apart =
        numbers.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(f64::INFINITY, f64::min);
    let are_lengths = numbers.len() > 1 && apart > 1.0 || numbers.iter().all(|n| *n > 10.0);
    let of_unit = unit.unit.or(unit.has_feet.then_some(Units::Inches));
    match (number_of(&typed), of_unit) {
        (Some(number), Some(of_unit)) if are_lengths => {
            notes.push(format!(
                "the {what} of {} is read from its name: {number} {}",
                shown(&line.name),
                of_unit.name()
            ));
            Ok(Some((of, made_mm(number * of_unit.in_mm(), &line.name, &line.place)?)))
        }
        _ => {
            let message = format!("nothing says which {what} {} has", shown(&line.name));
            let many = if of == HEIGHT { "Waterline" } else { "Buttock" };
            Err(Refusal::at(&line.place, message).with(format!(
                "Write it in the name, such as '{many} 300 mm', or add a line '{many} spacing, 100 \
                 mm' above the table where they have numbers."
            )))
        }
    }
}

/// The part of a name behind its words: `1-0-0` of `WL 1-0-0`.
fn name_behind_words(name: &str) -> String {
    let is_word = |word: &str| {
        word.starts_with(|c: char| c.is_alphabetic())
            && !word.contains(|c: char| c.is_ascii_digit())
    };
    let words: Vec<&str> = name.split(' ').filter(|word| !word.is_empty()).collect();
    let kept: Vec<&str> = words.into_iter().filter(|word| !is_word(word)).collect();
    let text = kept.join(" ");
    // WL12, B-1, W.L.3
    let digits = text.find(|c: char| c.is_ascii_digit()).unwrap_or(0);
    if text.starts_with(|c: char| c.is_alphabetic()) { text[digits..].to_owned() } else { text }
}

/// The points of a line, by the places of its stations.
fn points(
    line: &Line<'_>,
    layout: &Layout,
    places: &[Option<f64>],
    unit: &Bare,
    fixed: Fixed,
) -> Result<Vec<CurvePoint>, Refusal> {
    let name = shown(&line.name);
    for (of, what, other) in
        [(HALF, "half-breadths", "heights"), (HEIGHT, "heights", "half-breadths")]
    {
        if !line.has(of) && fixed.is_none_or(|(fixed, _)| fixed != of) {
            let message = format!("the line {name} has {other} and no {what}");
            return Err(Refusal::at(&line.place, message).with(
                "A table gives both of each line, in two blocks with the titles 'Heights' and \
                 'Half-breadths', or in two columns for each line.",
            ));
        }
    }
    let mut found: Vec<(f64, CurvePoint)> = Vec::new();
    for (station, place) in places.iter().enumerate() {
        let value = |of: usize| match (fixed, line.cells[of][station]) {
            (Some((fixed, mm)), _) if fixed == of => Ok(Some(mm)),
            (_, Some(placed)) => unit.mm(placed),
            (_, None) => Ok(None),
        };
        let (along, half, height) = (value(ALONG)?, value(HALF)?, value(HEIGHT)?);
        let (half, height) = match (half, height) {
            (Some(half), Some(height)) => (half, height),
            // A fixed coordinate alone is no point.
            (Some(_), None) if fixed.is_some_and(|(of, _)| of == HALF) => continue,
            (None, Some(_)) if fixed.is_some_and(|(of, _)| of == HEIGHT) => continue,
            (None, None) => continue,
            (half, _) => {
                let (has, lacks) = match half {
                    Some(_) => ("half-breadth", "height"),
                    None => ("height", "half-breadth"),
                };
                let given = line.cells[HALF][station].or(line.cells[HEIGHT][station]);
                let place = given.map_or(line.place.as_str(), |placed| &placed.place);
                let message = format!(
                    "{name} has a {has} and no {lacks} {}",
                    at_station(&layout.stations[station].head.typed)
                );
                return Err(Refusal::at(place, message)
                    .with("Write both, or '-' for both where the line has no point."));
            }
        };
        let Some(x) = along.or(*place) else { continue };
        let half = if line.is_whole { half / 2.0 } else { half };
        let order = place.unwrap_or(x);
        found.push((order, CurvePoint::smooth(Point3::new(x, half, height))));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(found.into_iter().map(|(_, point)| point).collect())
}

/// Names of the upper and the lower lines of a hull.
const UPPER: [&str; 5] = ["sheer", "gunwale", "gunnel", "deck", "rail"];
const LOWER: [&str; 5] = ["keel", "bottom", "chine", "rabbet", "garboard"];

/// Turns heights that were measured down from a base line above the boat into heights upwards.
fn turn_up(lines: &mut [HullLine], notes: &mut Vec<String>) {
    let mean = |words: &[&str]| {
        let is_of = |line: &&HullLine| {
            let name = line.name.to_lowercase();
            line.is_edge && words.iter().any(|word| name.contains(word))
        };
        let heights: Vec<f64> = lines
            .iter()
            .filter(is_of)
            .flat_map(|line| line.points.iter().map(|point| point.at.z))
            .collect();
        (!heights.is_empty()).then(|| heights.iter().sum::<f64>() / heights.len() as f64)
    };
    let (Some(upper), Some(lower)) = (mean(&UPPER), mean(&LOWER)) else { return };
    if upper < lower {
        // Adding 0 turns −0 into 0.
        let points = lines.iter_mut().flat_map(|line| &mut line.points);
        points.for_each(|point| point.at.z = 0.0 - point.at.z);
        notes.push("heights are measured downwards, from a base line above the boat".to_owned());
    }
}
