//! Makes a design from the name of a template and `NAME=VALUE` texts.

use crate::design_json::{table_beside, trims_for, write_design, write_design_of_table};
use crate::materials::material_named;
use crate::meant::{material_meant, parameter_hint, template_question};
use crate::names::{did_you_mean, shown};
use crate::quantity::{LENGTH_EXAMPLES, Slip, angle, length, lengths, plain};
use crate::reading::InputError;
use crate::table::{TableCurve, points_named};
use crate::units::Units;
use sheetwright::design::{Design, DesignCurve, Dimensions, MarkKind, StationPlaces};
use sheetwright::material::Material;
use sheetwright::math::Point3;
use sheetwright::template::{
    Kind, NamedCurve, Parameter, Template, TemplateError, Value, Values, template,
};
use std::path::Path;

/// The settings that every template has beside its parameters.
pub(crate) const MATERIAL: &str = "material";
/// The face of the sheet that the sizes are of.
pub(crate) const DIMENSIONS: &str = "dimensions";
/// The parameter for the unit of a template's table.
const UNITS: &str = "units";

/// The design that a template draws with these settings, each a text `NAME=VALUE`; other parameters
/// have their defaults. Lengths are in millimetres unless they have a unit, angles in degrees.
/// `material` sets the sheet of any template, and `dimensions` the face of it that the sizes are
/// of.
///
/// # Errors
/// An unknown template or parameter, a value that can't be read or is out of range, a setting that
/// is set twice, values that do not go together.
pub fn design_from_template(name: &str, settings: &[String]) -> Result<Design, InputError> {
    called(name, settings, None).map(|new| new.design)
}

/// The design that a template draws with these settings, and its tables, for a file that is to lie
/// in `folder`: a setting that is a table names one in that folder or below.
///
/// # Errors
/// Those of [`design_from_template`]; a table that is not there or can't be read.
pub fn new_design(name: &str, settings: &[String], folder: &Path) -> Result<NewDesign, InputError> {
    called(name, settings, Some(folder))
}

/// A design from a template.
#[derive(Clone, Debug, PartialEq)]
pub struct NewDesign {
    /// The design.
    pub design: Design,
    table: Option<TableSetting>,
}

/// The table that a setting names.
#[derive(Clone, Debug, PartialEq)]
struct TableSetting {
    /// Its path from the design's folder.
    path: String,
    /// The unit of its numbers.
    units: Option<Units>,
    /// What it holds.
    curves: Vec<TableCurve>,
}

impl TableSetting {
    /// Whether a curve of the design is one of the table, or the mirror image of one.
    fn has(&self, curve: &DesignCurve) -> bool {
        let found = points_named(&self.curves, &curve.name, curve.closed);
        found.is_some_and(|points| points == curve.points)
    }

    /// Moves what the template adds, stations and points such as those of the edge of a transom, to
    /// the nearest numbers that a file in the unit of the table can hold.
    fn settle(&self, design: &mut Design) {
        let in_mm = self.units.unwrap_or_default().in_mm();
        let held = |mm: f64| (mm / in_mm) * in_mm;
        let added = design.curves.iter_mut().filter(|curve| !self.has(curve));
        for point in added.flat_map(|curve| &mut curve.points) {
            point.at = Point3::new(held(point.at.x), held(point.at.y), held(point.at.z));
        }
        for mark in &mut design.marks {
            if let MarkKind::Stations { at: StationPlaces::Listed { planes }, .. } = &mut mark.kind
            {
                planes.iter_mut().for_each(|plane| plane.at = held(plane.at));
            }
        }
    }
}

impl NewDesign {
    /// Makes it for a trade, if there is one of this name.
    pub fn make_for(&mut self, trade: &str) {
        let thickness_mm = self.design.sheet_thickness_mm();
        if let Some(trims) = trims_for(&self.design, Some(trade), [thickness_mm; 2]) {
            (self.design.trims, self.design.trade) = (trims, Some(trade.to_owned()));
        }
    }

    /// The bytes of its file. Points of a table stay there, and so do those of the mirror images of
    /// its lines, so that the design follows when the table is corrected; the edges of transoms
    /// have points of their own.
    pub fn bytes(&self) -> Vec<u8> {
        match &self.table {
            Some(table) => {
                let in_table = |curve: &DesignCurve| table.has(curve);
                write_design_of_table(&self.design, &table.path, table.units, in_table)
            }
            None => write_design(&self.design),
        }
    }
}

fn called(name: &str, settings: &[String], folder: Option<&Path>) -> Result<NewDesign, InputError> {
    let template = template(name).ok_or_else(|| InputError {
        message: format!("there is no template {}", shown(name)),
        place: None,
        hint: template_question(name) + "The catalogue describes all templates.",
    })?;
    let mut values = template.defaults();
    let mut seen: Vec<&str> = Vec::new();
    let mut tables: Vec<(&str, &str)> = Vec::new();
    let mut units = None;
    let (mut material, mut dimensions) = (None, None);
    for setting in settings {
        let Some((name, text)) = setting.split_once('=') else {
            let message = format!("the setting {} has no value", shown(setting));
            let hint = format!("Write NAME=VALUE, such as {}.", example(template));
            return Err(InputError::at(template.name, message, hint));
        };
        let (name, text) = (name.trim(), text.trim());
        if seen.contains(&name) {
            let message = format!("{} is set twice", shown(name));
            return Err(InputError::at(template.name, message, "Keep one of them."));
        }
        seen.push(name);
        match template.parameter(name).map(|parameter| parameter.kind) {
            // Read when its units are known.
            Some(Kind::Table) => tables.push((name, text)),
            None if name == MATERIAL => material = Some(material_set(template, text)?),
            None if name == DIMENSIONS => dimensions = Some(dimensions_set(template, text)?),
            _ => set(&mut values, name, text)?,
        }
        if let (UNITS, Some(unit)) = (name, Units::from_name(text)) {
            units = Some(unit);
        }
    }
    let mut table = None;
    for (name, path) in tables {
        let curves = set_table(&mut values, name, path, units, folder)?;
        table = Some(TableSetting { path: path.to_owned(), units, curves });
    }
    let mut design = values.design().map_err(|error| in_words(&error, template, ""))?;
    if let Some(table) = &table {
        table.settle(&mut design);
    }
    let usual = || material_named(values.usual_sheet()?, &[]);
    design.material = material.or_else(usual);
    design.dimensions = dimensions;
    if dimensions.is_some() && design.material.is_none() {
        let message = "the face is that of a sheet of which no thickness is known";
        let hint = "Set a material, too, such as material=steel-1mm.";
        return Err(InputError::at(place(template, DIMENSIONS), message, hint));
    }
    Ok(NewDesign { design, table })
}

/// Sets the table of a template, and gives what the table holds.
fn set_table(
    values: &mut Values,
    name: &str,
    path: &str,
    units: Option<Units>,
    folder: Option<&Path>,
) -> Result<Vec<TableCurve>, InputError> {
    let template = values.template();
    let place = place(template, name);
    let Some(folder) = folder else {
        let message = "without a folder, no table can be read";
        return Err(InputError::at(place, message, "Leave `table` out."));
    };
    let curves = table_beside(folder, path, units, &place)?;
    let named = |curve: &TableCurve| NamedCurve {
        name: curve.name.clone(),
        points: curve.curve_points(false),
    };
    let value = Value::Table(curves.iter().map(named).collect());
    values.set(name, value).map_err(|error| in_words(&error, template, path))?;
    Ok(curves)
}

fn material_set(template: &Template, name: &str) -> Result<Material, InputError> {
    material_meant(name, &[])
        .map_err(|(message, hint)| InputError::at(place(template, MATERIAL), message, hint))
}

fn dimensions_set(template: &Template, name: &str) -> Result<Dimensions, InputError> {
    let found = Dimensions::ALL.into_iter().find(|face| face.name() == name);
    found.ok_or_else(|| {
        let message = format!("{} is no face of a sheet", shown(name));
        let hint = "Write inside, mean or outside.";
        InputError::at(place(template, DIMENSIONS), message, hint)
    })
}

fn set(values: &mut Values, name: &str, text: &str) -> Result<(), InputError> {
    let template = values.template();
    let Some(parameter) = template.parameter(name) else {
        let message = format!("there is no parameter {}", shown(name));
        let hint = parameter_hint(name, template, &[MATERIAL, DIMENSIONS]);
        return Err(InputError::at(template.name, message, hint));
    };
    let value = read(&parameter.kind, text).map_err(|slip| {
        let what = what(&parameter.kind);
        let message = format!("{} is no {what}", shown(text));
        let hint = slip.and_then(|slip| slip.advice(what)).unwrap_or_else(|| how(&parameter.kind));
        InputError::at(place(template, parameter.name), message, hint)
    })?;
    values.set(parameter.name, value).map_err(|error| in_words(&error, template, text))
}

/// The value in a text. The error names the slip in a quantity, or is `None` for a table.
fn read(kind: &Kind, text: &str) -> Result<Value, Option<Slip>> {
    let mm = Units::Millimetres;
    let value = match kind {
        Kind::Length(_) => length(text, mm).map(Value::Number),
        Kind::Angle(_) => angle(text).map(Value::Number),
        Kind::Count(_) | Kind::Number(_) => plain(text).map(Value::Number),
        Kind::Lengths { .. } => lengths(text, mm).map(Value::Numbers),
        Kind::Choice(_) => Ok(Value::Choice(text.to_owned())),
        Kind::Table => return Err(None),
    };
    value.map_err(Some)
}

fn what(kind: &Kind) -> &'static str {
    match kind {
        Kind::Length(_) => "length",
        Kind::Angle(_) => "angle",
        Kind::Count(_) | Kind::Number(_) => "number",
        Kind::Lengths { .. } => "list of lengths",
        Kind::Choice(_) => "choice",
        Kind::Table => "table",
    }
}

fn how(kind: &Kind) -> String {
    match kind {
        Kind::Length(_) => format!("Write a length such as {LENGTH_EXAMPLES}."),
        Kind::Angle(_) => "Write an angle in degrees such as 45, 22.5deg or -30°.".to_owned(),
        Kind::Count(_) => "Write a whole number such as 12.".to_owned(),
        Kind::Number(_) => "Write a number such as 0.5, without a unit.".to_owned(),
        Kind::Lengths { .. } => {
            format!("Write lengths with commas between them, each such as {LENGTH_EXAMPLES}.")
        }
        Kind::Choice(_) => "Write one of the choices.".to_owned(),
        Kind::Table => {
            "Name a curve table or a table of offsets (.csv, .xlsx or .ods) in the design's folder."
                .to_owned()
        }
    }
}

fn place(template: &Template, parameter: &str) -> String {
    format!("{}: {parameter}", template.name)
}

/// The error of the kernel, with the value as typed and the range of the parameter.
fn in_words(error: &TemplateError, template: &Template, typed: &str) -> InputError {
    let parameter = error.parameter().and_then(|name| template.parameter(name));
    let Some(parameter) = parameter else {
        return InputError::at(template.name, error.to_string(), "Leave it out.");
    };
    let place = place(template, parameter.name);
    let takes = format!("It takes {}.", takes(&parameter.kind));
    let (message, hint) = match error {
        TemplateError::Together { message, hint, .. } => (message.clone(), hint.clone()),
        TemplateError::OutOfRange { value, .. } => {
            let value = with_unit(&parameter.kind, *value);
            // Shows the value with its unit, so that a forgotten unit is noticed.
            let typed = match typed {
                typed if typed.replace(' ', "") == value.replace(' ', "") => String::new(),
                typed if typed.contains(',') => String::new(),
                typed => format!(" ({})", shown(typed)),
            };
            (format!("{value}{typed} is out of range"), takes)
        }
        TemplateError::NotWhole { .. } => (format!("{} is no whole number", shown(typed)), takes),
        TemplateError::WrongCount { found: 1, .. } => ("there is 1 length".to_owned(), takes),
        TemplateError::WrongCount { found, .. } => (format!("there are {found} lengths"), takes),
        TemplateError::UnknownChoice { wanted, .. } => {
            let Kind::Choice(choices) = parameter.kind else {
                return InputError::at(place, error.to_string(), takes);
            };
            let known: Vec<&str> = choices.iter().map(|choice| choice.name).collect();
            (format!("{} can't be chosen", shown(wanted)), did_you_mean(wanted, &known))
        }
        TemplateError::WrongKind { .. } | TemplateError::UnknownParameter { .. } => {
            (error.to_string(), takes)
        }
    };
    InputError::at(place, message, hint)
}

/// The accepted values of a parameter, in words: `a length from 10 mm to 20 m`.
fn takes(kind: &Kind) -> String {
    let what = match kind {
        Kind::Length(_) => "a length from ",
        Kind::Angle(_) => "an angle from ",
        Kind::Count(_) => "a whole number from ",
        Kind::Number(_) => "a number from ",
        Kind::Lengths { .. } | Kind::Choice(_) | Kind::Table => "",
    };
    format!("{what}{}", range(kind))
}

/// The range of a parameter: `10 mm to 20 m`.
pub(crate) fn range(kind: &Kind) -> String {
    let between =
        |least: f64, most: f64| format!("{} to {}", with_unit(kind, least), with_unit(kind, most));
    match kind {
        Kind::Length(range) | Kind::Angle(range) | Kind::Count(range) | Kind::Number(range) => {
            between(range.least, range.most)
        }
        Kind::Lengths { least, most, fewest, longest, .. } => {
            format!("{fewest} to {longest} lengths from {}", between(*least, *most))
        }
        Kind::Table => {
            "a curve table or a table of offsets (.csv, .xlsx, .ods) in the design's folder"
                .to_owned()
        }
        Kind::Choice(choices) => {
            let names: Vec<&str> = choices.iter().map(|choice| choice.name).collect();
            match names.split_last() {
                Some((last, rest)) if !rest.is_empty() => {
                    format!("{} or {last}", rest.join(", "))
                }
                _ => names.concat(),
            }
        }
    }
}

/// The default of a parameter, as it could be typed.
pub(crate) fn default(kind: &Kind) -> String {
    match kind.default() {
        Value::Number(number) => with_unit(kind, number),
        Value::Numbers(list) => {
            let list: Vec<String> = list.iter().map(|&mm| with_unit(kind, mm)).collect();
            list.join(", ")
        }
        Value::Choice(name) => name,
        Value::Table(_) => "none".to_owned(),
    }
}

/// A number with its customary unit.
fn with_unit(kind: &Kind, number: f64) -> String {
    match kind {
        Kind::Length(_) | Kind::Lengths { .. } if number.abs() >= 1000.0 => {
            format!("{} m", short(number / 1000.0))
        }
        Kind::Length(_) | Kind::Lengths { .. } => format!("{} mm", short(number)),
        Kind::Angle(_) => format!("{}°", short(number)),
        Kind::Count(_) | Kind::Number(_) | Kind::Choice(_) | Kind::Table => short(number),
    }
}

/// A number in few digits, but enough to show why it is out of range.
fn short(number: f64) -> String {
    if number != 0.0 && !(1e-4..1e9).contains(&number.abs()) {
        return format!("{number:e}");
    }
    number.to_string()
}

/// A setting of the template as an example.
fn example(template: &Template) -> String {
    template.parameters.first().map_or_else(
        || format!("{MATERIAL}=paper"),
        |Parameter { name, kind, .. }| format!("{name}={}", default(kind).replace(' ', "")),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{InputFormat, read_bytes};
    use crate::reading::ReadOptions;
    use sheetwright::template::catalogue;

    fn settings(list: &[&str]) -> Vec<String> {
        list.iter().map(|&text| text.to_owned()).collect()
    }

    fn refused(list: &[&str]) -> String {
        let error = design_from_template("cone", &settings(list)).unwrap_err();
        format!("{error} / {}", error.hint)
    }

    #[test]
    fn settings_have_units() {
        let metric = settings(&["bottom=40,0cm", "top = 350 + 50", "height=0.4m"]);
        let metric = design_from_template("cone", &metric).unwrap();
        assert_eq!(metric, {
            let bare = settings(&["bottom=400", "top=400", "height=400"]);
            design_from_template("cone", &bare).unwrap()
        });
        let paper = design_from_template("cone", &settings(&["material=paper"])).unwrap();
        assert_eq!(paper.material.map(|m| m.name).as_deref(), Some("paper"));
    }

    #[test]
    fn errors_say_what_is_taken() {
        for (list, words) in [
            (&["bottom"][..], "cone: the setting 'bottom' has no value / Write NAME=VALUE,"),
            (&["botom=3"], "cone: there is no parameter 'botom' / Did you mean 'bottom'?"),
            (&["bottom=3kg"], "cone: bottom: '3kg' is no length / Write a length such as 400,"),
            (&["bottom=1mm"], "cone: bottom: 1 mm is out of range / It takes a length"),
            (&["bottom=20", "bottom=30"], "cone: 'bottom' is set twice / "),
            (&["bottom=1/4 in"], "cone: bottom: 6.35 mm ('1/4 in') is out of range / It takes a"),
            (&["pieces=1.5"], "cone: pieces: '1.5' is no whole number / It takes a whole number"),
            (
                &["bottom=1,250"],
                "cone: bottom: '1,250' is no length / ‘1,250’ can mean 1250 or 1.250",
            ),
            (&["material=papper"], "cone: material: the material 'papper' is not known / Did you"),
        ] {
            let said = refused(list);
            assert!(said.starts_with(words), "{said}");
        }
        let error = design_from_template("kone", &[]).unwrap_err();
        assert_eq!(error.message, "there is no template 'kone'");
        assert!(error.hint.starts_with("Did you mean 'cone'? The"), "{}", error.hint);
        // A search word leads to its template too.
        let hint = design_from_template("Zepelin", &[]).unwrap_err().hint;
        assert!(hint.starts_with("Did you mean 'airship'? The"), "{hint}");
    }

    /// The reader of tables knows the units that a template offers.
    #[test]
    fn units_of_tables_are_those_of_files() {
        for template in catalogue() {
            let tables = template.parameters.iter().any(|p| p.kind == Kind::Table);
            let names: Vec<&str> = match template.parameter(UNITS).map(|p| p.kind) {
                Some(Kind::Choice(choices)) => choices.iter().map(|choice| choice.name).collect(),
                _ => Vec::new(),
            };
            let known = if tables { Units::ALL.map(Units::name).to_vec() } else { Vec::new() };
            assert_eq!(names, known, "{}", template.name);
        }
    }

    #[test]
    fn every_template_is_written_and_read_back_equal() {
        for template in catalogue() {
            let design = design_from_template(template.name, &[]).unwrap();
            let written = write_design(&design);
            let options = ReadOptions::default();
            let read =
                read_bytes(InputFormat::Design, &written, "d.sheet.json", None, &options).unwrap();
            assert_eq!(read, design, "{}", template.name);
        }
    }
}
