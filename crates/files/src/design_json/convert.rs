//! A design from its file's types to the kernel's.

use super::bends;
use super::grammar::{
    CurveFile, DesignFile, GoalName, KindName, MethodName, PanelFile, PlaneFile, PlaneName,
    PointFile, SideName, Triple, VaryFile,
};
use super::join::{check_joins, join, points_of};
use super::marks;
use super::material;
use super::mesh::Meshes;
use super::sampling::{Sampling, tolerance_mm};
use super::source::Source;
use super::table_path::Tables;
use super::trims;
use super::vary::VaryReader;
use super::wrong_version;
use super::{sheets, thickness};
use crate::format::Format;
use crate::json::Object;
use crate::materials::material_named;
use crate::mesh::NO_SAMPLES;
use crate::names::{
    did_you_mean, folded, refused_anywhere, refused_for_curve, refused_for_file, shown,
};
use crate::preset::{DxfRelease, Preset};
use crate::reading::{EFFORTS, InputError, stem};
use crate::table::{MAX_CURVES, RANGE_HINT, in_range_mm};
use crate::units::Units;
use sheetwright::boundary::{MAX_SAMPLES, PlaneChoice};
use sheetwright::cost::{MAX_FOLD, PriceOptions};
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{
    CurveUse, Design, DesignCurve, DesignPanel, LEAST_EFFORT, MOST_EFFORT, PanelMethod, PanelShape,
    Vary,
};
use sheetwright::math::{Point3, Vec3};
use sheetwright::triangulate::{Goal, WhichSurface};
use std::collections::BTreeMap;

/// The smallest and the largest tolerance of arcs, mm.
const LEAST_ARCS_MM: f64 = 1e-4;
const MOST_ARCS_MM: f64 = 10.0;

/// The most panels of a design, and the most uses of curves of a panel.
const MAX_PANELS: usize = MAX_CURVES;

pub(super) fn design(file: DesignFile, source: &Source<'_>) -> Result<Design, InputError> {
    if let Some(error) = wrong_version(file.sheetwright, source.place) {
        return Err(error);
    }
    let name = match file.name {
        None => stem(source.name),
        Some(name) => match refused_anywhere(&name) {
            None => name,
            Some(why) => {
                let message = format!("the name {} {why}", shown(&name));
                return Err(source.error("name", message, "Give it a short name in one line."));
            }
        },
    };
    let units = file.units.unwrap_or_default();
    let (material, materials) = material::read(file.material, file.materials, source)?;
    let curves = curves(file.curves.0, file.units, source)?;
    let mut list = file.panels;
    let of_panels: Vec<Option<Object<VaryFile>>> =
        list.iter_mut().map(|panel| panel.0.vary.take()).collect();
    let tolerance = file.tolerance;
    let tolerance = tolerance.map(|it| tolerance_mm(it, units, "tolerance", source));
    let panels = panels(list, &curves, units, tolerance.transpose()?, source)?;
    let reader = VaryReader { units, curves: &curves, source };
    let mut vary = Vec::new();
    if let Some(Object(whole)) = file.vary {
        vary.push(reader.read(whole, "vary", None, &panels)?);
    }
    for (n, of_panel) in of_panels.into_iter().enumerate() {
        if let Some(Object(of_panel)) = of_panel {
            let path = format!("panels[{n}].vary");
            let own = reader.read(of_panel, &path, Some(&panels[n].name), &panels)?;
            if vary.iter().any(|other: &Vary| other.panels == own.panels) {
                let message = "the `vary` beside `panels` already names this panel alone";
                return Err(source.error(&path, message, "Keep one of the two."));
            }
            vary.push(own);
        }
    }
    // Entries for none or several panels come first, then those for one panel in the order of the
    // panels, so that the result does not depend on where the file has them.
    let place = |vary: &Vary| match vary.panels.as_slice() {
        [only] => 1 + panels.iter().position(|panel| panel.name == *only).unwrap_or_default(),
        _ => 0,
    };
    vary.sort_by_key(place);
    let vary = source.options.vary.applied(vary);
    let match_seams = file.match_seams;
    let trade = source.options.trade.clone().or(file.trade);
    // The material that the caller names takes the place of the design's own.
    let asked = source.options.material.as_ref();
    let asked = asked.and_then(|name| material_named(name, &materials));
    let of_sheet = asked.as_ref().or(material.as_ref()).map(|sheet| sheet.thickness_mm.value);
    let thickness_mm = thickness::thickness_mm(file.thickness, units, source)?;
    let reckoned_mm = source.options.thickness_mm.or(thickness_mm).or(of_sheet);
    let mut trims = trims::read(trade.as_deref(), file.trims, units, reckoned_mm, source)?;
    trims.extend(source.options.allowance());
    let marks = marks::read(file.marks, units, reckoned_mm, source)?;
    let (preset, dxf) = (preset(file.preset, source)?, dxf(file.dxf, source)?);
    let arcs_mm = arcs_mm(file.arcs, units, source)?;
    let formats = formats(file.formats, source)?;
    let bends = bends::read(file.bends, "bends", units, source)?.unwrap_or_default();
    let dimensions = thickness::dimensions(file.dimensions);
    let bend_radius_mm = thickness::bend_radius_mm(file.bend_radius, units, source)?;
    let sheets = file.sheets.map(|Object(sheets)| sheets);
    let stock = sheets::read(sheets, &panels, units, reckoned_mm, source)?;
    Ok(Design {
        notes: Vec::new(),
        name,
        material,
        materials,
        curves,
        panels,
        vary,
        match_seams,
        trade,
        trims,
        marks,
        preset,
        dxf,
        arcs_mm,
        formats,
        bends,
        dimensions,
        thickness_mm,
        bend_radius_mm,
        stock,
    })
}

/// The name of a preset, if there is such a one.
fn preset(name: Option<String>, source: &Source<'_>) -> Result<Option<String>, InputError> {
    let known: Vec<&str> = Preset::all().iter().map(|preset| preset.name).collect();
    match name {
        Some(name) if !known.contains(&name.as_str()) => {
            let message = format!("there is no preset {}", shown(&name));
            Err(source.error("preset", message, did_you_mean(&name, &known)))
        }
        name => Ok(name),
    }
}

/// The tolerance of arcs, mm.
fn arcs_mm(
    file: Option<f64>,
    units: Units,
    source: &Source<'_>,
) -> Result<Option<f64>, InputError> {
    let Some(tolerance) = file else { return Ok(None) };
    let mm = tolerance * units.in_mm();
    if (LEAST_ARCS_MM..=MOST_ARCS_MM).contains(&mm) {
        return Ok(Some(mm));
    }
    let hint = "Write how far arcs may lie from the pattern, 0.0001 to 10 mm, in the units of the \
                design.";
    Err(source.error("arcs", format!("the tolerance of arcs is {tolerance}"), hint))
}

/// The name of a release of DXF, if there is such a one.
fn dxf(name: Option<String>, source: &Source<'_>) -> Result<Option<String>, InputError> {
    match name {
        Some(name) if DxfRelease::from_name(&name).is_none() => {
            let known = DxfRelease::ALL.map(DxfRelease::name);
            let message = format!("there is no release {} of DXF", shown(&name));
            Err(source.error("dxf", message, did_you_mean(&name, &known)))
        }
        name => Ok(name),
    }
}

/// The names of formats, if there are such.
fn formats(names: Vec<String>, source: &Source<'_>) -> Result<Vec<String>, InputError> {
    match names.iter().position(|name| Format::from_name(name).is_none()) {
        Some(n) => {
            let known = Format::ALL.map(Format::name);
            let message = format!("there is no format {}", shown(&names[n]));
            let hint = did_you_mean(&names[n], &known);
            Err(source.error(&format!("formats[{n}]"), message, hint))
        }
        None => Ok(names),
    }
}

fn curves(
    list: Vec<(String, CurveFile)>,
    units: Option<Units>,
    source: &Source<'_>,
) -> Result<Vec<DesignCurve>, InputError> {
    if list.len() > MAX_CURVES {
        let message = format!("the design has {} curves", list.len());
        return Err(source.error("curves", message, format!("The limit is {MAX_CURVES} curves.")));
    }
    let mut tables = Tables::new(source, units);
    let mut curves = Vec::with_capacity(list.len());
    for (name, file) in list {
        if let Some(why) = refused_for_curve(&name) {
            let message = format!("the curve's name {} {why}", shown(&name));
            return Err(source.error("curves", message, "Give it a short name in one line."));
        }
        let path = format!("curves.{name}");
        let kind = match file.kind {
            KindName::Polyline => Some(CurveKind::Polyline),
            KindName::Spline => Some(CurveKind::Spline),
            KindName::BSpline => Some(CurveKind::BSpline),
            // With a number of samples set, the samples lie on a spline through the points.
            KindName::Samples if source.options.samples.is_some() => Some(CurveKind::Spline),
            KindName::Samples => None,
        };
        let points = match (file.points, file.table) {
            (Some(points), None) if file.curve.is_none() => points
                .0
                .into_iter()
                .enumerate()
                .map(|(n, point)| {
                    let path = || format!("{path}.points[{n}]");
                    curve_point(&point, units.unwrap_or_default(), source, &path)
                })
                .collect::<Result<Vec<CurvePoint>, InputError>>()?,
            (None, Some(table)) => {
                tables.points(&table, file.curve.as_deref(), file.closed, &path)?
            }
            (Some(_), None) => {
                let message = "`curve` names a curve of a table, and there is no `table`";
                let hint = "Leave `curve` out, or add a `table`.";
                return Err(source.error(&format!("{path}.curve"), message, hint));
            }
            (Some(_), Some(_)) => {
                let message = "the curve has both `points` and a `table`";
                return Err(source.error(&path, message, "Keep one of the two."));
            }
            (None, None) => {
                let message = "the curve has neither `points` nor a `table`";
                let hint = "Add \"points\": [[x, y, z], …] or \"table\": \"offsets.csv\".";
                return Err(source.error(&path, message, hint));
            }
        };
        curves.push(DesignCurve { name, kind, closed: file.closed, points });
    }
    Ok(curves)
}

fn curve_point(
    point: &PointFile,
    units: Units,
    source: &Source<'_>,
    path: &dyn Fn() -> String,
) -> Result<CurvePoint, InputError> {
    let (xyz, corner, movable) = match point {
        PointFile::Bare(xyz) => (xyz, false, 0.0),
        PointFile::Full(full) => (&full.at.0, full.corner, full.movable),
    };
    let at = point_mm(xyz, units, source, path)?;
    let Some(move_mm) = in_range_mm(movable, units).filter(|mm| *mm >= 0.0) else {
        let message = format!("the point may move by {movable} {}", units.name());
        let hint = "Write a distance above 0, or 0 to fix the point.";
        return Err(source.error(&format!("{}.move", path()), message, hint));
    };
    Ok(CurvePoint { at, corner, move_mm })
}

/// A point in the unit of the design.
fn point_mm(
    xyz: &[f64; 3],
    units: Units,
    source: &Source<'_>,
    path: &dyn Fn() -> String,
) -> Result<Point3, InputError> {
    let mut mm = [0.0; 3];
    for (n, &number) in xyz.iter().enumerate() {
        mm[n] = in_range_mm(number, units).ok_or_else(|| {
            let message = format!("the coordinate {number:e} {} is out of range", units.name());
            source.error(&path(), message, RANGE_HINT)
        })?;
    }
    Ok(Point3::new(mm[0], mm[1], mm[2]))
}

fn panels(
    list: Vec<Object<PanelFile>>,
    curves: &[DesignCurve],
    units: Units,
    tolerance_mm: Option<f64>,
    source: &Source<'_>,
) -> Result<Vec<DesignPanel>, InputError> {
    if list.len() > MAX_PANELS {
        let message = format!("the design has {} panels", list.len());
        return Err(source.error("panels", message, format!("The limit is {MAX_PANELS} panels.")));
    }
    let mut meshes = Meshes::new(source, units);
    let known: BTreeMap<&str, &DesignCurve> = curves.iter().map(|c| (c.name.as_str(), c)).collect();
    let mut earlier: BTreeMap<String, usize> = BTreeMap::new();
    let mut panels = Vec::with_capacity(list.len());
    for (n, Object(file)) in list.into_iter().enumerate() {
        let path = format!("panels[{n}]");
        if let Some(why) = refused_for_file(&file.name) {
            let message = format!("the panel's name {} {why}", shown(&file.name));
            let hint = "Its files are named after it, on every system: letters, digits, spaces, \
                        - and _ are safe.";
            return Err(source.error(&format!("{path}.name"), message, hint));
        }
        if let Some(other) = earlier.insert(folded(&file.name), n) {
            let message = format!("panels[{other}] has the name {} too", shown(&file.name));
            let hint = "Give each panel a name of its own; upper and lower case count as one, as \
                        on many disks.";
            return Err(source.error(&format!("{path}.name"), message, hint));
        }
        let mut file = file;
        let mesh = meshes.shape(&mut file, &path)?;
        let bends = bends::read(file.bends.take(), &format!("{path}.bends"), units, source)?;
        let (count, mirrored) = (file.count.unwrap_or(1), file.mirrored.unwrap_or(0));
        check_count(count, mirrored, &path, source)?;
        let panel = match mesh {
            Some(mesh) => DesignPanel::new(file.name, mesh, NO_SAMPLES),
            None => PanelReader { path: &path, known: &known, units, tolerance_mm, source }
                .panel(file)?,
        };
        panels.push(DesignPanel { bends, count, mirrored, ..panel });
    }
    check_joins(&panels, &known, &|path, message, hint| source.error(path, message, hint))?;
    Ok(panels)
}

/// The most of one panel that are cut.
const MOST_OF_A_PANEL: u32 = 100_000;

fn check_count(
    count: u32,
    mirrored: u32,
    path: &str,
    source: &Source<'_>,
) -> Result<(), InputError> {
    if !(1..=MOST_OF_A_PANEL).contains(&count) {
        let hint = format!("Write a number from 1 to {MOST_OF_A_PANEL}.");
        return Err(source.error(&format!("{path}.count"), format!("the count is {count}"), hint));
    }
    if mirrored > count {
        let message = format!("{mirrored} are turned over, of {count} that are cut");
        let hint = "`mirrored` says how many of `count` are turned over.";
        return Err(source.error(&format!("{path}.mirrored"), message, hint));
    }
    Ok(())
}

struct PanelReader<'a> {
    path: &'a str,
    known: &'a BTreeMap<&'a str, &'a DesignCurve>,
    units: Units,
    /// The tolerance of the design, mm.
    tolerance_mm: Option<f64>,
    source: &'a Source<'a>,
}

impl PanelReader<'_> {
    fn error(
        &self,
        field: &str,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) -> InputError {
        self.source.error(&format!("{}{field}", self.path), message, hint)
    }

    fn panel(&self, file: PanelFile) -> Result<DesignPanel, InputError> {
        let shape = match join(&file, self.units, self.path, self.source)? {
            Some(join) => join,
            None => self.shape(file.rails, file.boundary, file.holes)?,
        };
        self.refuse_many_points(&shape)?;
        let options = self.source.options;
        let method = options.method.unwrap_or(match file.method {
            None | Some(MethodName::Optimal) => PanelMethod::Optimal,
            Some(MethodName::Bridge) => PanelMethod::Bridge,
            Some(MethodName::Rails) => PanelMethod::Rails,
        });
        let goal = match file.goal {
            None | Some(GoalName::Price) => Goal::Price,
            Some(GoalName::WorstWarp) => Goal::WorstWarp,
        };
        let run_on = file.run_on.unwrap_or(false);
        if run_on && !matches!(shape, PanelShape::Rails(_)) {
            let hint = "Leave `run_on` out, or name two open curves as `rails`.";
            return Err(self.error(".run_on", "only rails can run on", hint));
        }
        let plane = match file.plane {
            None | Some(PlaneFile::Named(PlaneName::Auto)) => PlaneChoice::Auto,
            Some(PlaneFile::Named(PlaneName::None)) => PlaneChoice::None,
            Some(PlaneFile::Normal([x, y, z])) => PlaneChoice::Normal(Vec3::new(x, y, z)),
        };
        let panel = DesignPanel {
            cut: self.cut(&file.cut.unwrap_or_default(), &shape)?,
            near: self.points("near", &file.near.unwrap_or_default())?,
            which: options.which.unwrap_or(match file.side {
                None | Some(SideName::Cheapest) => WhichSurface::Cheapest,
                Some(SideName::Other) => WhichSurface::Other,
            }),
            method,
            goal,
            run_on,
            slides: options.slides.or(file.slide).unwrap_or(false),
            plane: self.source.options.plane.unwrap_or(plane),
            fold: self.fold(file.fold)?,
            effort: self.effort(file.effort)?,
            ..DesignPanel::usual(file.name, shape)
        };
        let given = Sampling { samples: file.samples, tolerance: file.tolerance };
        given.of(panel, self.tolerance_mm, self.units, self.path, self.source)
    }

    fn cut(&self, places: &[Triple], shape: &PanelShape) -> Result<Vec<Point3>, InputError> {
        let holes = match shape {
            PanelShape::Loops { holes, .. } => holes.len(),
            PanelShape::Rails(_) | PanelShape::Mesh(_) => 0,
            // The number of holes of a join is known only after joining; surplus points cut
            // nothing.
            PanelShape::Join(_) => places.len(),
        };
        if places.len() > holes {
            let (message, hint) = if holes == 0 {
                ("a panel without holes is not cut open".to_owned(), "Leave `cut` out.".to_owned())
            } else {
                let message = format!("the number of points in `cut` is {}", places.len());
                (message, format!("Write at most {holes}, one for each hole."))
            };
            return Err(self.error(".cut", message, hint));
        }
        self.points("cut", places)
    }

    /// The points of a field of the panel, mm.
    fn points(&self, field: &str, places: &[Triple]) -> Result<Vec<Point3>, InputError> {
        let point = |(n, place): (usize, &Triple)| {
            let path = || format!("{}.{field}[{n}]", self.path);
            point_mm(&place.0, self.units, self.source, &path)
        };
        places.iter().enumerate().map(point).collect()
    }

    fn shape(
        &self,
        rails: Option<Vec<String>>,
        boundary: Option<Vec<String>>,
        holes: Option<Vec<Vec<String>>>,
    ) -> Result<PanelShape, InputError> {
        match (rails, boundary, holes) {
            (Some(rails), None, None) => {
                let uses = self.uses(rails, ".rails")?;
                let found = uses.len();
                let rails = <[CurveUse; 2]>::try_from(uses).map_err(|_| {
                    let message = format!("the number of rails is {found}");
                    let hint = "Name two open curves; write a loop of more as `boundary`.";
                    self.error(".rails", message, hint)
                })?;
                Ok(PanelShape::Rails(rails))
            }
            (None, Some(outer), holes) => {
                let outer = self.loop_of(outer, ".boundary")?;
                let holes = holes
                    .unwrap_or_default()
                    .into_iter()
                    .enumerate()
                    .map(|(n, hole)| self.loop_of(hole, &format!(".holes[{n}]")))
                    .collect::<Result<Vec<_>, InputError>>()?;
                Ok(PanelShape::Loops { outer, holes })
            }
            (Some(_), None, Some(_)) => {
                let hint = "Write the rails and the curves between their ends as a `boundary`.";
                Err(self.error(".holes", "a panel with rails has no holes", hint))
            }
            (Some(_), Some(_), _) => {
                let message = "the panel has both `rails` and a `boundary`";
                Err(self.error("", message, "Keep one of the two."))
            }
            (None, None, _) => {
                let message = "the panel has neither `rails` nor a `boundary`, joins no others and \
                               is no `mesh`";
                let hint = "Add \"rails\": [\"keel\", \"chine\"], \"boundary\": [\"rim\"], \
                            \"join\": [\"left\", \"right\"] or \"mesh\": \"hood.stl\".";
                Err(self.error("", message, hint))
            }
        }
    }

    fn uses(&self, names: Vec<String>, field: &str) -> Result<Vec<CurveUse>, InputError> {
        if names.is_empty() {
            let hint = "Name the curves that make it, in order.";
            return Err(self.error(field, "the list of curves is empty", hint));
        }
        if names.len() > MAX_CURVES {
            let message = format!("the list names {} curves", names.len());
            return Err(self.error(field, message, format!("The limit is {MAX_CURVES} curves.")));
        }
        let mut uses = Vec::with_capacity(names.len());
        for (n, written) in names.into_iter().enumerate() {
            let (name, reversed) = match written.strip_prefix('-') {
                Some(name) => (name.to_owned(), true),
                None => (written, false),
            };
            if !self.known.contains_key(name.as_str()) {
                let known: Vec<&str> = self.known.keys().copied().collect();
                let message = format!("there is no curve {}", shown(&name));
                let hint = did_you_mean(&name, &known);
                return Err(self.error(&format!("{field}[{n}]"), message, hint));
            }
            uses.push(CurveUse { name, reversed });
        }
        Ok(uses)
    }

    /// The curves of a loop. A seam is in it once in each direction. A loop of seams alone encloses
    /// no sheet and is refused.
    fn loop_of(&self, names: Vec<String>, field: &str) -> Result<Vec<CurveUse>, InputError> {
        let uses = self.uses(names, field)?;
        let mut balance: BTreeMap<&str, i64> = BTreeMap::new();
        for part in &uses {
            *balance.entry(&part.name).or_default() += if part.reversed { -1 } else { 1 };
        }
        if balance.values().all(|&balance| balance == 0) {
            let message = "the loop runs along each curve there and back, and encloses nothing";
            let hint = "Name each curve of a loop once; only a seam is named twice.";
            return Err(self.error(field, message, hint));
        }
        Ok(uses)
    }

    fn refuse_many_points(&self, shape: &PanelShape) -> Result<(), InputError> {
        let count = points_of(shape, self.known);
        if count > MAX_SAMPLES {
            let message = format!("the curves of the panel have {count} points in total");
            return Err(self.error("", message, format!("The limit is {MAX_SAMPLES} points.")));
        }
        Ok(())
    }

    fn fold(&self, written: Option<f64>) -> Result<f64, InputError> {
        let fold = written.unwrap_or(PriceOptions::default().fold);
        if !(0.0..=MAX_FOLD).contains(&fold) {
            let message = format!("the fold price is {fold}");
            let hint = "Set a fold price from 0 (twist alone) to 10.";
            return Err(self.error(".fold", message, hint));
        }
        Ok(self.source.options.fold.unwrap_or(fold))
    }

    fn effort(&self, written: Option<f64>) -> Result<f64, InputError> {
        let effort = written.unwrap_or(1.0);
        if !(LEAST_EFFORT..=MOST_EFFORT).contains(&effort) {
            let message = format!("the effort is {effort}");
            return Err(self.error(".effort", message, EFFORTS));
        }
        Ok(self.source.options.effort.unwrap_or(effort))
    }
}
