//! Templates: whole designs from a few numbers.
//!
//! Most people who cut sheet want one of a few dozen shapes in their own size. A template is such a
//! shape: a name, who uses it, the words that people search for, its parameters with their ranges,
//! and a function that draws the design. [`catalogue`] lists them; one file a family draws them.
//!
//! [`Values::set`] checks values, so a function that draws gets only values within their ranges. It
//! refuses combinations that no range can exclude (a neck that is wider than the belly) itself, in
//! words.

mod bag;
mod boat;
mod cone;
mod dome;
mod duct;
mod elbow;
mod facade;
mod gores;
mod hopper;
mod hull;
mod hull_form;
mod ramp;
mod revolution;
mod sketch;
mod tent;

use crate::design::Design;
use sheetwright_geometry::curve::CurvePoint;
use sheetwright_geometry::math::from_deg;
use sketch::Drawn;
use std::fmt;

/// A shape with parameters.
#[derive(Clone, Copy, Debug)]
pub struct Template {
    /// The name in the command and in designs: lower-case words joined by `-`.
    pub name: &'static str,
    /// The name for people.
    pub title: &'static str,
    /// One sentence on who uses it and for what.
    pub who: &'static str,
    /// Words by which people search for it.
    pub words: &'static [&'static str],
    /// The parameters, in the order in which they are shown.
    pub parameters: &'static [Parameter],
    /// The material that it is usually made of, by its name in the catalogue; `None` where that
    /// differs from maker to maker.
    pub sheet: Option<&'static str>,
    /// The trade that it is usually made for, by its name in files; `None` where that differs from
    /// maker to maker.
    pub trade: Option<&'static str>,
    /// Draws it.
    build: fn(&Values) -> Drawn,
}

/// A parameter of a template.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// What the command calls it: lower-case words joined by `-`.
    pub name: &'static str,
    /// What it means, as a phrase without a full stop.
    pub meaning: &'static str,
    /// The values that it takes.
    pub kind: Kind,
}

/// The values that a parameter takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A length, mm.
    Length(Range),
    /// An angle, in degrees here because its ends and its default are what people type;
    /// the curves are drawn with radians.
    Angle(Range),
    /// A whole number.
    Count(Range),
    /// A plain number.
    Number(Range),
    /// Several lengths, mm.
    Lengths {
        /// The least value of each.
        least: f64,
        /// The largest value of each.
        most: f64,
        /// The least number of them.
        fewest: usize,
        /// The largest number of them.
        longest: usize,
        /// The lengths unless they are set.
        default: &'static [f64],
    },
    /// One of these; the first unless it is set.
    Choice(&'static [Choice]),
    /// The curves of a curve table, which the caller reads; none unless it is set.
    Table,
}

/// The numbers that a parameter takes, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The least.
    pub least: f64,
    /// The most.
    pub most: f64,
    /// The number unless it is set.
    pub default: f64,
}

/// One of the values of a choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// What the command calls it.
    pub name: &'static str,
    /// What it means, as a phrase without a full stop.
    pub meaning: &'static str,
}

/// The value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A length in mm, an angle in degrees, a count or a plain number.
    Number(f64),
    /// Several lengths, mm.
    Numbers(Vec<f64>),
    /// The name of a choice.
    Choice(String),
    /// The curves of a table, mm.
    Table(Vec<NamedCurve>),
}

/// A curve of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedCurve {
    /// Its name.
    pub name: String,
    /// Its points, mm.
    pub points: Vec<CurvePoint>,
}

/// A value for every parameter of a template.
#[derive(Clone, Debug)]
pub struct Values {
    template: &'static Template,
    /// In the order of the parameters.
    list: Vec<Value>,
}

/// Why a template can't be drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum TemplateError {
    /// The template has no parameter of this name.
    UnknownParameter {
        /// The name.
        wanted: String,
    },
    /// The parameter takes another kind of value.
    WrongKind {
        /// The parameter.
        parameter: &'static str,
    },
    /// The number is NaN, or outside of the range.
    OutOfRange {
        /// The parameter.
        parameter: &'static str,
        /// The number.
        value: f64,
    },
    /// The number should be whole.
    NotWhole {
        /// The parameter.
        parameter: &'static str,
        /// The number.
        value: f64,
    },
    /// Too few or too many lengths.
    WrongCount {
        /// The parameter.
        parameter: &'static str,
        /// How many there are.
        found: usize,
    },
    /// The parameter has no such choice.
    UnknownChoice {
        /// The parameter.
        parameter: &'static str,
        /// The name of the choice.
        wanted: String,
    },
    /// Values that do not go together.
    Together {
        /// The parameter to change.
        parameter: &'static str,
        /// What is wrong, as a sentence without a capital and a full stop.
        message: String,
        /// What to do, as a sentence.
        hint: String,
    },
}

impl TemplateError {
    /// The parameter at fault; `None` where there is no such parameter.
    pub fn parameter(&self) -> Option<&'static str> {
        match *self {
            Self::UnknownParameter { .. } => None,
            Self::WrongKind { parameter }
            | Self::OutOfRange { parameter, .. }
            | Self::NotWhole { parameter, .. }
            | Self::WrongCount { parameter, .. }
            | Self::UnknownChoice { parameter, .. }
            | Self::Together { parameter, .. } => Some(parameter),
        }
    }

    /// Values that do not go together.
    fn together(
        parameter: &'static str,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) -> Self {
        Self::Together { parameter, message: message.into(), hint: hint.into() }
    }
}

impl fmt::Display for TemplateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownParameter { wanted } => write!(f, "there is no parameter '{wanted}'"),
            Self::WrongKind { .. } => write!(f, "the value is of another kind"),
            Self::OutOfRange { value, .. } => write!(f, "{value} is out of range"),
            Self::NotWhole { value, .. } => write!(f, "{value} is no whole number"),
            Self::WrongCount { found, .. } => write!(f, "there are {found} lengths"),
            Self::UnknownChoice { wanted, .. } => write!(f, "'{wanted}' can't be chosen"),
            Self::Together { message, .. } => write!(f, "{message}"),
        }
    }
}

impl std::error::Error for TemplateError {}

/// Every template, one family after the other.
pub fn catalogue() -> &'static [Template] {
    &CATALOGUE
}

static CATALOGUE: [Template; 21] = [
    dome::DOME,
    dome::BALL,
    dome::BALLOON,
    dome::AIRSHIP,
    revolution::HEMISPHERE,
    revolution::REVOLUTION,
    duct::SQUARE_TO_ROUND,
    duct::REDUCER,
    elbow::ELBOW,
    elbow::Y_BRANCH,
    hopper::HOPPER,
    cone::CONE,
    cone::LAMPSHADE,
    boat::DINGHY,
    boat::PRAM,
    boat::KAYAK,
    hull::HULL,
    bag::BAG,
    tent::TENT,
    facade::FACADE,
    ramp::RAMP,
];

/// The template of a name.
pub fn template(name: &str) -> Option<&'static Template> {
    CATALOGUE.iter().find(|template| template.name == name)
}

impl Template {
    /// The parameter of a name.
    pub fn parameter(&self, name: &str) -> Option<&'static Parameter> {
        self.parameters.iter().find(|parameter| parameter.name == name)
    }

    /// Every parameter at its default.
    pub fn defaults(&'static self) -> Values {
        let list = self.parameters.iter().map(|parameter| parameter.kind.default()).collect();
        Values { template: self, list }
    }
}

impl Kind {
    /// The value of a parameter that is not set.
    pub fn default(&self) -> Value {
        match *self {
            Self::Length(range) | Self::Angle(range) | Self::Count(range) | Self::Number(range) => {
                Value::Number(range.default)
            }
            Self::Lengths { default, .. } => Value::Numbers(default.to_vec()),
            Self::Choice(choices) => Value::Choice(choices[0].name.to_owned()),
            Self::Table => Value::Table(Vec::new()),
        }
    }
}

impl Values {
    /// The template of these values.
    pub fn template(&self) -> &'static Template {
        self.template
    }

    /// Sets a parameter.
    ///
    /// # Errors
    /// No such parameter, a value of another kind, or one outside of the range.
    pub fn set(&mut self, name: &str, value: Value) -> Result<(), TemplateError> {
        let place = self.template.parameters.iter().position(|p| p.name == name);
        let place =
            place.ok_or_else(|| TemplateError::UnknownParameter { wanted: name.to_owned() })?;
        let parameter = self.template.parameters[place].name;
        let within = |value: f64, least: f64, most: f64| {
            let inside = (least..=most).contains(&value);
            if inside { Ok(()) } else { Err(TemplateError::OutOfRange { parameter, value }) }
        };
        match (&self.template.parameters[place].kind, &value) {
            (Kind::Count(_), &Value::Number(value))
                if value.is_finite() && value.fract() != 0.0 =>
            {
                return Err(TemplateError::NotWhole { parameter, value });
            }
            (
                Kind::Length(range) | Kind::Angle(range) | Kind::Count(range) | Kind::Number(range),
                &Value::Number(value),
            ) => within(value, range.least, range.most)?,
            (&Kind::Lengths { least, most, fewest, longest, .. }, Value::Numbers(list)) => {
                if !(fewest..=longest).contains(&list.len()) {
                    return Err(TemplateError::WrongCount { parameter, found: list.len() });
                }
                list.iter().try_for_each(|&value| within(value, least, most))?;
            }
            (Kind::Choice(choices), Value::Choice(wanted)) => {
                if !choices.iter().any(|choice| choice.name == wanted) {
                    let wanted = wanted.clone();
                    return Err(TemplateError::UnknownChoice { parameter, wanted });
                }
            }
            (Kind::Table, Value::Table(_)) => {}
            _ => return Err(TemplateError::WrongKind { parameter }),
        }
        self.list[place] = value;
        Ok(())
    }

    /// The material that the design is usually made of, by its name in the catalogue; `None` where
    /// that differs from maker to maker, and where the lines come from a table.
    pub fn usual_sheet(&self) -> Option<&'static str> {
        let is_own = |value: &Value| matches!(value, Value::Table(curves) if !curves.is_empty());
        self.template.sheet.filter(|_| !self.list.iter().any(is_own))
    }

    /// The design that the template draws with these values; it names no material.
    ///
    /// # Errors
    /// Values that do not go together.
    pub fn design(&self) -> Result<Design, TemplateError> {
        let sketch = (self.template.build)(self)?;
        Ok(sketch.design(self.template.name))
    }

    /// The value of a parameter.
    ///
    /// # Panics
    /// If the template has no such parameter. The functions below panic, too, also if it is of
    /// another kind: a fault of the template's own file, which drawing it once shows.
    fn value(&self, name: &str) -> &Value {
        let place = self.template.parameters.iter().position(|p| p.name == name);
        let Some(place) = place else { panic!("{} has no '{name}'", self.template.name) };
        &self.list[place]
    }

    /// A length, mm, or a plain number.
    fn number(&self, name: &str) -> f64 {
        match self.value(name) {
            Value::Number(number) => *number,
            _ => panic!("'{name}' of {} is no number", self.template.name),
        }
    }

    /// An angle, radians.
    fn radians(&self, name: &str) -> f64 {
        from_deg(self.number(name))
    }

    /// A whole number.
    fn count(&self, name: &str) -> usize {
        self.number(name) as usize
    }

    /// The curves of a table; none if it is not set.
    fn table(&self, name: &str) -> &[NamedCurve] {
        match self.value(name) {
            Value::Table(curves) => curves,
            _ => panic!("'{name}' of {} is no table", self.template.name),
        }
    }

    /// The name of the choice.
    fn choice(&self, name: &str) -> &str {
        match self.value(name) {
            Value::Choice(name) => name,
            _ => panic!("'{name}' of {} is no choice", self.template.name),
        }
    }
}

/// A length, mm.
const fn length(
    name: &'static str,
    meaning: &'static str,
    least: f64,
    most: f64,
    default: f64,
) -> Parameter {
    Parameter { name, meaning, kind: Kind::Length(Range { least, most, default }) }
}

/// A whole number.
const fn count(
    name: &'static str,
    meaning: &'static str,
    least: u32,
    most: u32,
    default: u32,
) -> Parameter {
    let range = Range { least: least as f64, most: most as f64, default: default as f64 };
    Parameter { name, meaning, kind: Kind::Count(range) }
}

/// An angle, degrees.
const fn angle(
    name: &'static str,
    meaning: &'static str,
    least: f64,
    most: f64,
    default: f64,
) -> Parameter {
    Parameter { name, meaning, kind: Kind::Angle(Range { least, most, default }) }
}

/// A plain number.
const fn number(
    name: &'static str,
    meaning: &'static str,
    least: f64,
    most: f64,
    default: f64,
) -> Parameter {
    Parameter { name, meaning, kind: Kind::Number(Range { least, most, default }) }
}
